//! Paths through space: offsets of a hand from its start.

use std::f64::consts::{PI, TAU};

use chereme_motion::glam::{DQuat, DVec3};

/// A path from the origin; lengths in metres.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum HandPath {
    /// A straight line.
    Line(DVec3),
    /// A straight line whose speed grows with the square: added to a line, it bends that line away from its start.
    Late(DVec3),
    /// A circular arc over a chord; `bow` is the offset of its middle.
    Arc { chord: DVec3, bow: DVec3 },
    /// To and fro across the path by the vector `side`, in corners or waves, growing from 1 to `grown`.
    Wave {
        side: DVec3,
        waves: f64,
        wavy: bool,
        grown: f64,
    },
    /// Round a circle or ellipse by an angle: the vectors from its centre to the start and a quarter turn
    /// on, growing from 1 to `grown`.
    Circle {
        start: DVec3,
        quarter: DVec3,
        angle: f64,
        grown: f64,
    },
    /// Straight lines through points.
    Through(Vec<DVec3>),
    /// Out to a point and back.
    Spring(DVec3),
}

impl HandPath {
    /// Returns the point at the share `s` of the length.
    pub(crate) fn path_point_at(&self, s: f64) -> DVec3 {
        match self {
            Self::Line(displacement) => *displacement * s,
            Self::Late(displacement) => *displacement * (s * s * s),
            Self::Arc { chord, bow } => arc_point_at(*chord, *bow, s),
            Self::Wave {
                side,
                waves,
                wavy,
                grown,
            } => {
                let turn = s * waves;
                let wave = if *wavy {
                    (TAU * turn).sin()
                } else {
                    // A triangle wave in phase with the sine.
                    (2.0 / PI) * (TAU * turn).sin().asin()
                };
                // Both ends lie on the axis of the wave.
                let ends = (8.0 * s.min(1.0 - s)).clamp(0.0, 1.0);
                *side * (wave * (1.0 + (grown - 1.0) * s) * ends)
            }
            Self::Circle {
                start,
                quarter,
                angle,
                grown,
            } => {
                let (sin, cos) = (angle * s).sin_cos();
                let size = 1.0 + (grown - 1.0) * s;
                (*start * cos + *quarter * sin) * size - *start
            }
            Self::Through(points) => point_through_points(points, s),
            Self::Spring(displacement) => *displacement * (PI * s).sin(),
        }
    }

    /// Returns the end of the path.
    pub(crate) fn path_end(&self) -> DVec3 {
        self.path_point_at(1.0)
    }

    /// Returns its approximate length.
    pub(crate) fn path_length(&self) -> f64 {
        let path_point = |n: i32| self.path_point_at(f64::from(n) / 16.0);
        (0..16).map(|n| path_point(n).distance(path_point(n + 1))).sum()
    }

    /// Returns the unit tangent at the share `s`; `None` if the path does not move.
    pub(crate) fn path_heading(&self, s: f64) -> Option<DVec3> {
        let by = 1e-4;
        let from = s.clamp(0.0, 1.0 - by);
        (self.path_point_at(from + by) - self.path_point_at(from)).try_normalize()
    }

    /// Returns the rotation of an object that follows the path up to the share `s`: with its bends, but
    /// without twist.
    pub(crate) fn path_rotation_at(&self, s: f64) -> DQuat {
        const PATH_ROTATION_STEPS: i32 = 32;
        let mut turned = DQuat::IDENTITY;
        let mut before = self.path_heading(0.0);
        for n in 1..=PATH_ROTATION_STEPS {
            let now = self.path_heading(s * f64::from(n) / f64::from(PATH_ROTATION_STEPS));
            if let (Some(before), Some(now)) = (before, now) {
                turned = DQuat::from_rotation_arc(before, now) * turned;
            }
            before = now.or(before);
        }
        turned.normalize()
    }

    /// Returns the path with the linear map `f` applied to every vector.
    pub(crate) fn map_path_vectors(&self, f: impl Fn(DVec3) -> DVec3) -> Self {
        match self {
            Self::Line(displacement) => Self::Line(f(*displacement)),
            Self::Late(displacement) => Self::Late(f(*displacement)),
            Self::Arc { chord, bow } => Self::Arc {
                chord: f(*chord),
                bow: f(*bow),
            },
            Self::Wave {
                side,
                waves,
                wavy,
                grown,
            } => Self::Wave {
                side: f(*side),
                waves: *waves,
                wavy: *wavy,
                grown: *grown,
            },
            Self::Circle {
                start,
                quarter,
                angle,
                grown,
            } => Self::Circle {
                start: f(*start),
                quarter: f(*quarter),
                angle: *angle,
                grown: *grown,
            },
            Self::Through(points) => Self::Through(points.iter().map(|&point| f(point)).collect()),
            Self::Spring(displacement) => Self::Spring(f(*displacement)),
        }
    }
}

fn arc_point_at(chord: DVec3, bow: DVec3, s: f64) -> DVec3 {
    let (length, depth) = (chord.length(), bow.length());
    if depth < 1e-9 || length < 1e-9 {
        return chord * s;
    }
    let radius = (length * length / 4.0 + depth * depth) / (2.0 * depth);
    let half = 2.0 * (2.0 * depth / length).atan();
    let angle = half * (2.0 * s - 1.0);
    let along = 0.5 + radius * angle.sin() / length;
    let up = (radius * angle.cos() - (radius - depth)) / depth;
    chord * along + bow * up
}

fn point_through_points(points: &[DVec3], s: f64) -> DVec3 {
    let mut from = DVec3::ZERO;
    let starts = std::iter::once(DVec3::ZERO).chain(points.iter().copied());
    let total_length: f64 = starts.zip(points).map(|(a, b)| a.distance(*b)).sum();
    let mut left = s * total_length;
    for &to in points {
        let length = from.distance(to);
        if left <= length {
            return from.lerp(to, if length > 0.0 { left / length } else { 1.0 });
        }
        left -= length;
        from = to;
    }
    from
}

#[cfg(test)]
mod tests {
    use super::super::notation_plan::{HandAct, HandEvent, HandState};
    use super::super::notation_track::follow_hand_events;
    use super::super::pace::MovementPace;
    use super::super::wrist_cycle::WristCycle;
    use super::*;

    #[test]
    fn paths_begin_at_zero_and_arcs_lie_on_a_circle() {
        let (chord, bow) = (DVec3::new(0.2, 0.0, 0.0), DVec3::new(0.0, 0.06, 0.0));
        let arc = HandPath::Arc { chord, bow };
        assert!(arc.path_point_at(0.0).length() < 1e-12 && arc.path_end().distance(chord) < 1e-12);
        assert!(arc.path_point_at(0.5).distance(chord / 2.0 + bow) < 1e-12);
        let centre = DVec3::new(0.1, 0.06 - (0.01 + 0.0036) / 0.12, 0.0);
        for n in 0..=10 {
            let at = arc.path_point_at(f64::from(n) / 10.0);
            assert!((at.distance(centre) - (0.01 + 0.0036) / 0.12).abs() < 1e-9);
        }
        let steps: Vec<f64> = (0..10)
            .map(|n| {
                arc.path_point_at(f64::from(n) / 10.0)
                    .distance(arc.path_point_at(f64::from(n + 1) / 10.0))
            })
            .collect();
        assert!(steps.iter().all(|step| (step - steps[0]).abs() < 1e-12), "even speed");
    }

    #[test]
    fn a_hand_that_follows_a_path_turns_with_its_tangent() {
        let (chord, bow) = (DVec3::X * 0.2, DVec3::Y * 0.1);
        let half = HandPath::Arc { chord, bow };
        assert!((half.path_rotation_at(1.0) * DVec3::Y).distance(DVec3::NEG_Y) < 1e-3);
        assert!((half.path_rotation_at(0.5) * DVec3::Y).distance(DVec3::X) < 1e-3);
        assert!(half.path_rotation_at(1.0).mul_vec3(DVec3::Z).distance(DVec3::Z) < 1e-9);
        let straight = HandPath::Line(chord);
        assert!(straight.path_rotation_at(1.0).angle_between(DQuat::IDENTITY) < 1e-9);
    }

    #[test]
    fn circles_close_and_waves_end_on_their_line() {
        let circle = HandPath::Circle {
            start: DVec3::Y * 0.1,
            quarter: DVec3::X * 0.05,
            angle: TAU,
            grown: 1.0,
        };
        assert!(circle.path_end().length() < 1e-12);
        assert!(circle.path_point_at(0.25).distance(DVec3::new(0.05, -0.1, 0.0)) < 1e-12);
        for wavy in [true, false] {
            let wave = HandPath::Wave {
                side: DVec3::X,
                waves: 2.0,
                wavy,
                grown: 1.5,
            };
            assert!(wave.path_point_at(0.0).length() < 1e-12 && wave.path_end().length() < 1e-9);
        }
        let cross = HandPath::Through(vec![DVec3::X, DVec3::new(1.0, 1.0, 0.0)]);
        assert!(cross.path_point_at(0.75).distance(DVec3::new(1.0, 0.5, 0.0)) < 1e-12);
        let mirrored = circle.map_path_vectors(|v| DVec3::new(-v.x, v.y, v.z));
        let at = circle.path_point_at(0.3);
        assert!(mirrored.path_point_at(0.3).distance(DVec3::new(-at.x, at.y, at.z)) < 1e-12);
    }

    #[test]
    fn goals_follow_the_events_of_a_hand() {
        let event = |from: f64, to: f64, act: HandAct| HandEvent {
            from,
            to,
            pace: MovementPace::Linear,
            act,
        };
        let turn = |degrees: f64| DQuat::from_rotation_y(degrees.to_radians());
        let start = HandState {
            point: DVec3::Y,
            rotation: turn(10.0),
            leaned: DQuat::IDENTITY,
            offset: DVec3::Z * 0.1,
            shape: 0,
            handshape: Default::default(),
            direction: DVec3::Z,
            palm: 0.0,
            axes: [DVec3::ONE; 2],
            follows: false,
            heading: None,
            used: true,
        };
        let events = [
            event(1.0, 2.0, HandAct::Move(HandPath::Line(DVec3::X))),
            event(1.5, 2.0, HandAct::Move(HandPath::Line(DVec3::Z * 2.0))),
            event(0.0, 1.0, HandAct::Turn(turn(90.0))),
            event(0.0, 1.0, HandAct::Lean(turn(6.0))),
            // The next turn begins before this one ends.
            event(2.0, 3.0, HandAct::Turn(turn(90.0))),
            event(
                2.5,
                3.5,
                HandAct::Follow {
                    path: HandPath::Line(DVec3::X),
                    corner: turn(-80.0),
                    to: turn(10.0),
                },
            ),
            event(0.5, 1.5, HandAct::Point(DVec3::Z * 0.2)),
            event(
                0.0,
                2.0,
                HandAct::Wrist(WristCycle {
                    axes: [DVec3::X * 0.2, DVec3::Z * 0.1],
                    cycles: 2.0,
                    one_sided: false,
                }),
            ),
        ];
        let goals = follow_hand_events(&start, &events, 100.0, 401, |_, share| share);
        for (seconds, point) in [
            (0.9, DVec3::Y),
            (1.25, DVec3::new(0.25, 1.0, 0.0)),
            (1.75, DVec3::new(0.75, 1.0, 1.0)),
            (4.0, DVec3::new(1.0, 1.0, 2.0)),
        ] {
            let is = goals.points[(seconds * 100.0) as usize];
            assert!(is.distance(point) < 1e-9, "{is} after {seconds} s");
        }
        for (seconds, degrees) in [
            (0.0, 10.0),
            (0.25, 30.0),
            (0.5, 50.0),
            (1.5, 90.0),
            (2.5, 90.0),
            // Round the corner within the first quarter.
            (2.55, 74.0),
            (2.65, 42.0),
            (2.75, 10.0),
            (3.25, 10.0),
            (4.0, 10.0),
        ] {
            let is = goals.turns[(seconds * 100.0_f64).round() as usize];
            let off = is.angle_between(turn(degrees)).to_degrees();
            assert!(off < 1e-5, "{off} degrees off after {seconds} s");
        }
        for (seconds, degrees) in [(0.0, 0.0), (0.5, 3.0), (1.0, 6.0), (3.0, 6.0)] {
            let is = goals.leans[(seconds * 100.0_f64).round() as usize];
            let off = is.angle_between(turn(degrees)).to_degrees();
            assert!(off < 1e-5, "{off} degrees off after {seconds} s");
        }
        for (seconds, offset) in [(0.5, 0.1), (1.0, 0.15), (1.5, 0.2), (4.0, 0.2)] {
            let is = goals.offsets[(seconds * 100.0) as usize];
            assert!(is.distance(DVec3::Z * offset) < 1e-9, "{is} after {seconds} s");
        }
        // Two cycles in two seconds, with soft ends: an eighth of the time in, they are at full size.
        for (frame, about) in [
            (0, DVec3::ZERO),
            (25, DVec3::X * 0.2),
            (50, DVec3::Z * -0.1),
            (75, DVec3::X * -0.2),
            (100, DVec3::Z * 0.1),
            (175, DVec3::X * -0.2),
        ] {
            let is = goals.wrist[frame].expect("a movement about the wrist");
            assert!(is.to_scaled_axis().distance(about) < 1e-9, "{is} at {frame}");
        }
        assert_eq!(goals.wrist[201], None);
        let rising = goals.wrist[12].expect("there").to_scaled_axis();
        let usual = DVec3::X * 0.2 * (0.12 * TAU).sin() + DVec3::Z * 0.1 * (0.12 * TAU).cos();
        let share: f64 = 0.48;
        let soft = share * share * (3.0 - 2.0 * share);
        assert!(rising.distance(usual * soft) < 1e-9, "{rising}");
        let wrists: Vec<DVec3> = goals.goal_wrist_positions().collect();
        assert!(wrists[0].distance(DVec3::Y - turn(10.0) * DVec3::Z * 0.1) < 1e-9);
        let (frames, shares) = &goals.transitions[0];
        assert_eq!((frames.clone(), shares.len()), (0..100, 100));
        assert!((shares[25] - 0.25).abs() < 1e-9);
    }
}
