//! Draws directions, palms, movements, and their marks.

use super::super::direction::{CompassDirection, SpatialDirection};
use super::super::sites::unit_vector_of;
use super::super::symbol::SymbolKind;
use super::super::tree::{EllipseAxis, MotionSize, WristMotion};
use super::{DrawingPoint, SymbolDrawing, arc_points, oval, page_point};

const DRAWING_MIDDLE: DrawingPoint = [0.4, 0.5];

/// Draws a direction, a palm, a movement, or a mark of one.
pub(super) fn draw_movement_symbol(kind: SymbolKind) -> SymbolDrawing {
    match kind {
        SymbolKind::Extended(to) => draw_finger_direction(to),
        SymbolKind::Move(to) => {
            let (drawing, right, up, middle) = draw_plane_direction(to);
            let end = |share: f32| page_point(middle, right * 0.34 * share, up * 0.34 * share);
            drawing.with_arrow([end(-1.0), end(1.0)])
        }
        SymbolKind::Palm(to) => SymbolDrawing::new(0.6)
            .with_line(oval([0.3, 0.5], [0.26, 0.26]))
            .solid(half_arc_points(to, [0.3, 0.5], 0.26)),
        SymbolKind::Circle(axis) => draw_axis_circle(axis),
        SymbolKind::Clock(at) => {
            let (right, up) = on_page(at);
            SymbolDrawing::new(0.8)
                .thin(oval(DRAWING_MIDDLE, [0.28, 0.28]))
                .with_line([DRAWING_MIDDLE, page_point(DRAWING_MIDDLE, right * 0.28, up * 0.28)])
                .with_dot(page_point(DRAWING_MIDDLE, right * 0.28, up * 0.28))
        }
        SymbolKind::ClockFull => SymbolDrawing::new(0.8)
            .with_line(oval(DRAWING_MIDDLE, [0.28, 0.28]))
            .with_dot(DRAWING_MIDDLE),
        SymbolKind::Arc(to) => {
            let (right, up) = on_page(to);
            let ends = [0.32, -0.32].map(|share| page_point(DRAWING_MIDDLE, -up * share, right * share));
            let drawing = SymbolDrawing::new(0.8).thin(ends);
            drawing.with_line(half_arc_points(to, DRAWING_MIDDLE, 0.32))
        }
        SymbolKind::Zigzag { wavy: true } => SymbolDrawing::new(0.9).with_line(wave_points()),
        SymbolKind::Zigzag { wavy: false } => SymbolDrawing::new(0.9).with_line([
            [0.06, 0.66],
            [0.2, 0.34],
            [0.34, 0.66],
            [0.48, 0.34],
            [0.62, 0.66],
            [0.76, 0.34],
            [0.84, 0.52],
        ]),
        SymbolKind::Ellipse(axis) => SymbolDrawing::new(0.8).with_line(ellipse_points(axis)),
        SymbolKind::Growth { increasing } => {
            let (narrow, wide) = if increasing { (0.06, 0.74) } else { (0.74, 0.06) };
            SymbolDrawing::new(0.8).with_line([[wide, 0.26], [narrow, 0.5], [wide, 0.74]])
        }
        SymbolKind::Size(size) => {
            let (out, back) = match size {
                MotionSize::Small => (0.22, 0.04),
                MotionSize::Big => (0.04, 0.22),
            };
            SymbolDrawing::new(0.7)
                .with_line([[back, 0.34], [out, 0.5], [back, 0.66]])
                .with_line([[0.7 - back, 0.34], [0.7 - out, 0.5], [0.7 - back, 0.66]])
        }
        SymbolKind::FingerPlay => {
            let up = |x: f32, top: f32| [[x, 0.94], [x, top]];
            SymbolDrawing::new(0.8)
                .with_line(up(0.1, 0.2))
                .with_line(up(0.3, 0.44))
                .with_line(up(0.5, 0.2))
                .with_line(up(0.7, 0.44))
                .thin(arc_points([0.4, 0.22], [0.26, 0.16], 0.58, 0.92))
        }
        SymbolKind::Wrist(motion) => draw_wrist_motion(motion),
        SymbolKind::Replace => SymbolDrawing::new(0.9)
            .with_line([[0.06, 0.4], [0.68, 0.4]])
            .with_line([[0.06, 0.6], [0.68, 0.6]])
            .with_line([[0.58, 0.22], [0.84, 0.5], [0.58, 0.78]]),
        SymbolKind::Cross { diagonal } => draw_crossing_arrows(diagonal),
        SymbolKind::Still => SymbolDrawing::new(0.8)
            .with_line(oval(DRAWING_MIDDLE, [0.28, 0.28]))
            .with_line([[0.2, 0.7], [0.6, 0.3]]),
        SymbolKind::Mime => SymbolDrawing::new(0.8)
            .with_line(oval(DRAWING_MIDDLE, [0.3, 0.42]))
            .with_dot([0.28, 0.38])
            .with_dot([0.52, 0.38])
            .with_line(arc_points([0.4, 0.6], [0.16, 0.14], 0.02, 0.48)),
        _ => SymbolDrawing::default(),
    }
}

/// Draws the direction of the fingers as the tip of an arrow.
fn draw_finger_direction(to: SpatialDirection) -> SymbolDrawing {
    let (drawing, right, up, middle) = draw_plane_direction(to);
    let (tip, back) = (0.3, 0.14);
    let side = |to: f32| {
        let (x, y) = (-right * back - up * 0.3 * to, -up * back + right * 0.3 * to);
        page_point(middle, x, y)
    };
    drawing.with_line([side(1.0), page_point(middle, right * tip, up * tip), side(-1.0)])
}

/// Returns the half of a circle that lies in a direction.
fn half_arc_points(to: CompassDirection, middle: DrawingPoint, radius: f32) -> Vec<DrawingPoint> {
    let (right, up) = on_page(to);
    // Arcs count turns clockwise from the right, as y goes down the page.
    let turn = (-up).atan2(right) / std::f32::consts::TAU;
    arc_points(middle, [radius, radius], turn - 0.25, turn + 0.25)
}

/// Returns two waves across the page.
fn wave_points() -> Vec<DrawingPoint> {
    let point = |step: u8| {
        let t = f32::from(step) / 40.0;
        [0.06 + 0.78 * t, 0.5 - 0.2 * (t * 2.0 * std::f32::consts::TAU).sin()]
    };
    (0..=40).map(point).collect()
}

fn ellipse_points(axis: EllipseAxis) -> Vec<DrawingPoint> {
    let turned: f32 = match axis {
        EllipseAxis::Horizontal => 0.0,
        EllipseAxis::UpRight => -45.0,
        EllipseAxis::Vertical => 90.0,
        EllipseAxis::UpLeft => 45.0,
    };
    let (sin, cos) = turned.to_radians().sin_cos();
    let turn = |[x, y]: DrawingPoint| [0.4 + x * cos - y * sin, 0.5 + x * sin + y * cos];
    oval([0.0, 0.0], [0.36, 0.17]).into_iter().map(turn).collect()
}

fn draw_crossing_arrows(diagonal: bool) -> SymbolDrawing {
    let at = |x: f32, y: f32| match diagonal {
        true => page_point(DRAWING_MIDDLE, (x - y) * 0.7, (x + y) * 0.7),
        false => page_point(DRAWING_MIDDLE, x, y),
    };
    SymbolDrawing::new(0.8)
        .with_arrow([at(-0.34, 0.0), at(0.34, 0.0)])
        .with_arrow([at(0.0, 0.34), at(0.0, -0.34)])
}

/// Returns the direction of a compass on the page: to the right, and up.
fn on_page(compass: CompassDirection) -> (f32, f32) {
    let (horizontal, vertical) = match compass {
        CompassDirection::U => (0.0, 1.0),
        CompassDirection::Ur => (1.0, 1.0),
        CompassDirection::R => (1.0, 0.0),
        CompassDirection::Dr => (1.0, -1.0),
        CompassDirection::D => (0.0, -1.0),
        CompassDirection::Dl => (-1.0, -1.0),
        CompassDirection::L => (-1.0, 0.0),
        CompassDirection::Ul => (-1.0, 1.0),
    };
    let length = f32::hypot(horizontal, vertical);
    (horizontal / length, vertical / length)
}

/// Returns the view of a direction with its bar, the direction on the page, and the middle.
fn draw_plane_direction(to: SpatialDirection) -> (SymbolDrawing, f32, f32, DrawingPoint) {
    let [left, up, out] = to.spatial_direction_vector().map(|part| part as f32);
    if out == 0.0 {
        return (SymbolDrawing::new(0.8), -left, up, DRAWING_MIDDLE);
    }
    if up == 0.0 {
        let bar = SymbolDrawing::new(0.8).thin([[0.06, 0.97], [0.74, 0.97]]);
        return (bar, -left, out, [0.4, 0.46]);
    }
    let bar = SymbolDrawing::new(0.86).thin([[0.03, 0.08], [0.03, 0.92]]);
    (bar, out, up, [0.48, 0.5])
}

/// The line of sight for circles (left, up, out), chosen so that no circle is seen on its edge.
const CIRCLE_SIGHT_LINE: [f64; 3] = [0.2157, -0.52, 0.826];

fn cross_product(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot_product(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A circle about an axis, seen from behind, above and a little from the right.
fn draw_axis_circle(axis: SpatialDirection) -> SymbolDrawing {
    let axis = axis.spatial_direction_vector();
    let right = unit_vector_of(cross_product(CIRCLE_SIGHT_LINE, [0.0, 1.0, 0.0]));
    let up = unit_vector_of(cross_product(right, CIRCLE_SIGHT_LINE));
    // The circle begins at its farthest point along the page.
    let side = unit_vector_of(cross_product(axis, CIRCLE_SIGHT_LINE));
    let across = cross_product(axis, side);
    let points: Vec<DrawingPoint> = (0..=30u8)
        .map(|step| {
            let (sin, cos) = (f64::from(step) / 36.0 * std::f64::consts::TAU).sin_cos();
            let point = [0, 1, 2].map(|part| side[part] * cos + across[part] * sin);
            page_point(
                [0.45, 0.5],
                0.33 * dot_product(point, right) as f32,
                0.33 * dot_product(point, up) as f32,
            )
        })
        .collect();
    let drawing = SymbolDrawing::new(0.9).with_line(points.clone());
    drawing.with_arrow_head(&points, 0.14)
}

fn draw_wrist_motion(motion: WristMotion) -> SymbolDrawing {
    // The forearm from below, with the hand moving to and fro about its end.
    let stick = SymbolDrawing::new(0.8).thin([[0.4, 1.0], [0.4, 0.62]]);
    match motion {
        WristMotion::Nodding => SymbolDrawing::new(0.8)
            .thin([[0.04, 0.6], [0.34, 0.6]])
            .with_line([[0.34, 0.6], [0.62, 0.6]])
            .with_arrow(arc_points([0.36, 0.6], [0.36, 0.36], -0.02, -0.2))
            .with_arrow(arc_points([0.36, 0.6], [0.36, 0.36], 0.02, 0.18)),
        WristMotion::Swinging => {
            let path = |sign: f32| arc_points([0.4, 0.62], [0.3, 0.42], -0.25 + sign * 0.03, -0.25 + sign * 0.2);
            stick
                .with_line([[0.4, 0.62], [0.4, 0.34]])
                .with_arrow(path(1.0))
                .with_arrow(path(-1.0))
        }
        WristMotion::Twisting => SymbolDrawing::new(0.8)
            .thin([[0.4, 1.0], [0.4, 0.06]])
            .with_arrow(arc_points([0.4, 0.52], [0.32, 0.16], -0.4, 0.4)),
        WristMotion::StirCw => stick.with_arrow(arc_points([0.4, 0.36], [0.22, 0.22], -0.25, 0.62)),
        WristMotion::StirCcw => stick.with_arrow(arc_points([0.4, 0.36], [0.22, 0.22], -0.25, -1.12)),
    }
}
