//! Draws directions, palms, movements, and their marks.

use super::super::direction::{Compass, Direction};
use super::super::symbol::Kind;
use super::super::tree::{Ellipse, Size, WristMotion};
use super::{Drawing, Point, arc, oval, seen};

const MIDDLE: Point = [0.4, 0.5];

/// Draws a direction, a palm, a movement, or a mark of one.
pub(super) fn draw(kind: Kind) -> Drawing {
    match kind {
        Kind::Extended(to) => {
            let (drawing, right, up, middle) = plane(to);
            let (tip, back) = (0.3, 0.14);
            let side = |to: f32| {
                let (x, y) = (-right * back - up * 0.3 * to, -up * back + right * 0.3 * to);
                seen(middle, x, y)
            };
            drawing.line([side(1.0), seen(middle, right * tip, up * tip), side(-1.0)])
        }
        Kind::Move(to) => {
            let (drawing, right, up, middle) = plane(to);
            let end = |share: f32| seen(middle, right * 0.34 * share, up * 0.34 * share);
            drawing.arrow([end(-1.0), end(1.0)])
        }
        Kind::Palm(to) => {
            let (right, up) = on_page(to);
            let turn = (-up).atan2(right) / std::f32::consts::TAU;
            Drawing::new(0.6)
                .line(oval([0.3, 0.5], [0.26, 0.26]))
                .solid(arc([0.3, 0.5], [0.26, 0.26], turn - 0.25, turn + 0.25))
        }
        Kind::Circle(axis) => circle(axis),
        Kind::Clock(at) => {
            let (right, up) = on_page(at);
            Drawing::new(0.8)
                .thin(oval(MIDDLE, [0.28, 0.28]))
                .line([MIDDLE, seen(MIDDLE, right * 0.28, up * 0.28)])
                .dot(seen(MIDDLE, right * 0.28, up * 0.28))
        }
        Kind::ClockFull => Drawing::new(0.8)
            .line(oval(MIDDLE, [0.28, 0.28]))
            .dot(MIDDLE),
        Kind::Arc(to) => {
            let (right, up) = on_page(to);
            let turn = (-up).atan2(right) / std::f32::consts::TAU;
            let ends = [0.32, -0.32].map(|share| seen(MIDDLE, -up * share, right * share));
            Drawing::new(0.8)
                .thin(ends)
                .line(arc(MIDDLE, [0.32, 0.32], turn - 0.25, turn + 0.25))
        }
        Kind::Zigzag { wavy: true } => Drawing::new(0.9).line(
            (0..=40u8)
                .map(|step| {
                    let t = f32::from(step) / 40.0;
                    [
                        0.06 + 0.78 * t,
                        0.5 - 0.2 * (t * 2.0 * std::f32::consts::TAU).sin(),
                    ]
                })
                .collect::<Vec<_>>(),
        ),
        Kind::Zigzag { wavy: false } => Drawing::new(0.9).line([
            [0.06, 0.66],
            [0.2, 0.34],
            [0.34, 0.66],
            [0.48, 0.34],
            [0.62, 0.66],
            [0.76, 0.34],
            [0.84, 0.52],
        ]),
        Kind::Ellipse(ellipse) => {
            let turned: f32 = match ellipse {
                Ellipse::Horizontal => 0.0,
                Ellipse::UpRight => -45.0,
                Ellipse::Vertical => 90.0,
                Ellipse::UpLeft => 45.0,
            };
            let (sin, cos) = turned.to_radians().sin_cos();
            let points = oval([0.0, 0.0], [0.36, 0.17]);
            let turn = |[x, y]: Point| [0.4 + x * cos - y * sin, 0.5 + x * sin + y * cos];
            Drawing::new(0.8).line(points.into_iter().map(turn).collect::<Vec<_>>())
        }
        Kind::Growth { increasing } => {
            let (narrow, wide) = if increasing {
                (0.06, 0.74)
            } else {
                (0.74, 0.06)
            };
            Drawing::new(0.8).line([[wide, 0.26], [narrow, 0.5], [wide, 0.74]])
        }
        Kind::Size(size) => {
            let (out, back) = match size {
                Size::Small => (0.22, 0.04),
                Size::Big => (0.04, 0.22),
            };
            Drawing::new(0.7)
                .line([[back, 0.34], [out, 0.5], [back, 0.66]])
                .line([[0.7 - back, 0.34], [0.7 - out, 0.5], [0.7 - back, 0.66]])
        }
        Kind::FingerPlay => {
            let up = |x: f32, top: f32| [[x, 0.94], [x, top]];
            Drawing::new(0.8)
                .line(up(0.1, 0.2))
                .line(up(0.3, 0.44))
                .line(up(0.5, 0.2))
                .line(up(0.7, 0.44))
                .thin(arc([0.4, 0.22], [0.26, 0.16], 0.58, 0.92))
        }
        Kind::Wrist(motion) => wrist(motion),
        Kind::Replace => Drawing::new(0.9)
            .line([[0.06, 0.4], [0.68, 0.4]])
            .line([[0.06, 0.6], [0.68, 0.6]])
            .line([[0.58, 0.22], [0.84, 0.5], [0.58, 0.78]]),
        Kind::Cross { diagonal } => {
            let at = |x: f32, y: f32| {
                if diagonal {
                    seen(MIDDLE, (x - y) * 0.7, (x + y) * 0.7)
                } else {
                    seen(MIDDLE, x, y)
                }
            };
            Drawing::new(0.8)
                .arrow([at(-0.34, 0.0), at(0.34, 0.0)])
                .arrow([at(0.0, 0.34), at(0.0, -0.34)])
        }
        Kind::Still => Drawing::new(0.8)
            .line(oval(MIDDLE, [0.28, 0.28]))
            .line([[0.2, 0.7], [0.6, 0.3]]),
        Kind::Mime => Drawing::new(0.8)
            .line(oval(MIDDLE, [0.3, 0.42]))
            .dot([0.28, 0.38])
            .dot([0.52, 0.38])
            .line(arc([0.4, 0.6], [0.16, 0.14], 0.02, 0.48)),
        _ => Drawing::default(),
    }
}

/// Returns the direction of a compass on the page: to the right, and up.
fn on_page(compass: Compass) -> (f32, f32) {
    let (horizontal, vertical) = match compass {
        Compass::U => (0.0, 1.0),
        Compass::Ur => (1.0, 1.0),
        Compass::R => (1.0, 0.0),
        Compass::Dr => (1.0, -1.0),
        Compass::D => (0.0, -1.0),
        Compass::Dl => (-1.0, -1.0),
        Compass::L => (-1.0, 0.0),
        Compass::Ul => (-1.0, 1.0),
    };
    let length = f32::hypot(horizontal, vertical);
    (horizontal / length, vertical / length)
}

/// Returns the view of a direction with its bar, the direction on the page, and the middle.
fn plane(to: Direction) -> (Drawing, f32, f32, Point) {
    let [left, up, out] = to.vector().map(|part| part as f32);
    if out == 0.0 {
        return (Drawing::new(0.8), -left, up, MIDDLE);
    }
    if up == 0.0 {
        let bar = Drawing::new(0.8).thin([[0.06, 0.97], [0.74, 0.97]]);
        return (bar, -left, out, [0.4, 0.46]);
    }
    let bar = Drawing::new(0.86).thin([[0.03, 0.08], [0.03, 0.92]]);
    (bar, out, up, [0.48, 0.5])
}

/// The line of sight for circles (left, up, out), chosen so that no circle is seen on its edge.
const LOOK: [f64; 3] = [0.2157, -0.52, 0.826];

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    v.map(|part| part / dot(v, v).sqrt())
}

/// A circle about an axis, seen from behind, above and a little from the right.
fn circle(axis: Direction) -> Drawing {
    let axis = axis.vector();
    let right = unit(cross(LOOK, [0.0, 1.0, 0.0]));
    let up = unit(cross(right, LOOK));
    // The circle begins at its farthest point along the page.
    let side = unit(cross(axis, LOOK));
    let across = cross(axis, side);
    let points: Vec<Point> = (0..=30u8)
        .map(|step| {
            let (sin, cos) = (f64::from(step) / 36.0 * std::f64::consts::TAU).sin_cos();
            let at = [0, 1, 2].map(|part| side[part] * cos + across[part] * sin);
            seen(
                [0.45, 0.5],
                0.33 * dot(at, right) as f32,
                0.33 * dot(at, up) as f32,
            )
        })
        .collect();
    let drawing = Drawing::new(0.9).line(points.clone());
    drawing.head(&points, 0.14)
}

fn wrist(motion: WristMotion) -> Drawing {
    // The forearm from below, with the hand moving to and fro about its end.
    let stick = Drawing::new(0.8).thin([[0.4, 1.0], [0.4, 0.62]]);
    match motion {
        WristMotion::Nodding => Drawing::new(0.8)
            .thin([[0.04, 0.6], [0.34, 0.6]])
            .line([[0.34, 0.6], [0.62, 0.6]])
            .arrow(arc([0.36, 0.6], [0.36, 0.36], -0.02, -0.2))
            .arrow(arc([0.36, 0.6], [0.36, 0.36], 0.02, 0.18)),
        WristMotion::Swinging => {
            let path = |sign: f32| {
                arc(
                    [0.4, 0.62],
                    [0.3, 0.42],
                    -0.25 + sign * 0.03,
                    -0.25 + sign * 0.2,
                )
            };
            stick
                .line([[0.4, 0.62], [0.4, 0.34]])
                .arrow(path(1.0))
                .arrow(path(-1.0))
        }
        WristMotion::Twisting => Drawing::new(0.8).thin([[0.4, 1.0], [0.4, 0.06]]).arrow(arc(
            [0.4, 0.52],
            [0.32, 0.16],
            -0.4,
            0.4,
        )),
        WristMotion::StirCw => stick.arrow(arc([0.4, 0.36], [0.22, 0.22], -0.25, 0.62)),
        WristMotion::StirCcw => stick.arrow(arc([0.4, 0.36], [0.22, 0.22], -0.25, -1.12)),
    }
}
