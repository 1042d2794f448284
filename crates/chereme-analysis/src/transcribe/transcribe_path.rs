//! Paths through space: straight, curved, waves, circles.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::transcribe_scene::polyline_length;
use crate::transcribe::transcribe_tuned::tuned;

/// Returns the expected error of a path in synthesised movement, in metres.
pub(crate) fn synthesised_path_error() -> f64 {
    tuned().path.exact
}

/// The path of a hand; lengths in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PathForm {
    /// Straight.
    Straight {
        /// From start to end.
        chord: DVec3,
    },
    /// Part of a circle.
    Arc {
        /// From start to end.
        chord: DVec3,
        /// From the chord's middle to the arc's.
        bow: DVec3,
    },
    /// Zigzag or wave across the direction of movement.
    Wave {
        /// From start to end.
        chord: DVec3,
        /// Half the width.
        width: f64,
        /// Whether it runs in waves; zigzag otherwise.
        wavy: bool,
    },
    /// A circle or ellipse.
    Circle {
        /// The unit vector it turns about by the right-hand rule.
        axis: DVec3,
        /// The number of turns.
        turns: f64,
        /// The longer radius and its direction.
        long: DVec3,
        /// The ratio of the shorter radius to the longer one.
        narrow: f64,
        /// Unit vector from the centre to its start.
        start: DVec3,
        /// Unit vector from the centre to its end.
        end: DVec3,
    },
}

/// A fitted path, with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FittedPath {
    pub(crate) path: PathForm,
    /// The root of the mean square of the distance, in metres.
    pub(super) residual: f64,
    /// The next simpler or deeper kind, with its residual.
    pub(super) runner_up: Option<(PathForm, f64)>,
}

impl PathForm {
    /// Returns the name of its kind.
    pub(super) fn path_kind_name(&self) -> &'static str {
        match self {
            Self::Straight { .. } => "straight",
            Self::Arc { .. } => "arc",
            Self::Wave { wavy: false, .. } => "zigzag",
            Self::Wave { wavy: true, .. } => "waves",
            Self::Circle { .. } => "circle",
        }
    }

    /// Returns its direction: that of its chord, or the axis of a circle.
    pub(super) fn path_direction(&self) -> DVec3 {
        match *self {
            Self::Circle { axis, .. } => axis,
            _ => self.path_chord(),
        }
    }

    /// Returns the vector from its start to its end.
    pub(super) fn path_chord(&self) -> DVec3 {
        match *self {
            Self::Straight { chord } | Self::Arc { chord, .. } | Self::Wave { chord, .. } => chord,
            Self::Circle { .. } => DVec3::ZERO,
        }
    }
}

/// Fits every kind of path to points in order of time and returns the best one. Hands may be off by
/// `exact` metres: smaller bows and waves are ignored.
pub(crate) fn fit_path_form(points: &[DVec3], exact: f64) -> FittedPath {
    let points = evenly_spaced_points(points, tuned().path.points);
    let (first, last) = (points[0], points[points.len() - 1]);
    let chord = last - first;
    let straight = PathForm::Straight { chord };
    let off_straight = path_point_deviation(&points, |s| first + chord * s);
    if let Some((circle, residual)) = fit_path_circle(&points, exact) {
        return FittedPath {
            path: circle,
            residual,
            runner_up: Some((straight, off_straight)),
        };
    }
    if let Some((wave, residual)) = wave(&points, exact) {
        return FittedPath {
            path: wave,
            residual,
            runner_up: Some((straight, off_straight)),
        };
    }
    let middle = points[points.len() / 2].midpoint(points[(points.len() - 1) / 2]);
    let bow = (middle - first - chord / 2.0).reject_from(chord.normalize_or(DVec3::X));
    let arc = PathForm::Arc { chord, bow };
    let off_arc = path_point_deviation(&points, |s| first + along_arc(chord, bow, s));
    let (deep, wide) = (bow.length(), chord.length());
    let sure = deep > tuned().path.shallow.0
        && deep > tuned().path.shallow.1 * wide
        && off_arc < tuned().path.shallow.2 * off_straight;
    let curved = sure || (deep > tuned().path.curved * wide && off_arc < off_straight);
    let (path, residual, other) = if curved && deep > exact {
        (arc, off_arc, (straight, off_straight))
    } else {
        (straight, off_straight, (arc, off_arc))
    };
    FittedPath {
        path,
        residual,
        runner_up: Some(other),
    }
}

/// Returns `count` points evenly spaced along a polyline.
pub(crate) fn evenly_spaced_points(points: &[DVec3], count: usize) -> Vec<DVec3> {
    let total_length = polyline_length(points);
    if points.len() < 2 || total_length <= 0.0 {
        return vec![points.first().copied().unwrap_or_default(); count];
    }
    let mut even = Vec::with_capacity(count);
    let (mut done, mut n) = (0.0, 0);
    for k in 0..count {
        let goal = total_length * k as f64 / (count - 1) as f64;
        while n + 2 < points.len() && done + points[n].distance(points[n + 1]) < goal {
            done += points[n].distance(points[n + 1]);
            n += 1;
        }
        let step = points[n].distance(points[n + 1]);
        let share = if step > 0.0 {
            ((goal - done) / step).clamp(0.0, 1.0)
        } else {
            0.0
        };
        even.push(points[n].lerp(points[n + 1], share));
    }
    even
}

/// Returns the root of the mean square of the distance between the points and `at` (share of the path).
fn path_point_deviation(points: &[DVec3], at: impl Fn(f64) -> DVec3) -> f64 {
    let last = (points.len() - 1) as f64;
    let squares = points
        .iter()
        .enumerate()
        .map(|(n, point)| point.distance_squared(at(n as f64 / last)));
    (squares.sum::<f64>() / points.len() as f64).sqrt()
}

/// Returns the point of the arc over a chord at the share `s` of its length.
fn along_arc(chord: DVec3, bow: DVec3, s: f64) -> DVec3 {
    let (width, depth) = (chord.length(), bow.length());
    if depth < 1e-9 || width < 1e-9 {
        return chord * s;
    }
    let radius = (width * width / 4.0 + depth * depth) / (2.0 * depth);
    // The tangent of a quarter of the arc's angle is its depth over half of the chord.
    let angle = 2.0 * (2.0 * depth / width).atan() * (2.0 * s - 1.0);
    let along = 0.5 + radius * angle.sin() / width;
    chord * along + bow * ((radius * angle.cos() - (radius - depth)) / depth)
}

/// Fits a circle or ellipse; `None` if the path does not go round.
fn fit_path_circle(points: &[DVec3], exact: f64) -> Option<(PathForm, f64)> {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let area: DVec3 = points
        .windows(2)
        .map(|pair| (pair[0] - mean).cross(pair[1] - mean))
        .sum();
    // About the normal of the enclosed area the path turns in the positive sense.
    let axis = area.try_normalize()?;
    let centre = fitted_circle_centre(points, axis)?;
    let [x, y] = {
        let x = axis.any_orthonormal_vector();
        [x, axis.cross(x)]
    };
    let flat: Vec<(f64, f64)> = points
        .iter()
        .map(|&point| ((point - centre).dot(x), (point - centre).dot(y)))
        .collect();
    let swept: f64 = flat
        .windows(2)
        .map(|pair| {
            let ((a, b), (c, d)) = (pair[0], pair[1]);
            (a * d - b * c).atan2(a * c + b * d)
        })
        .sum();
    if swept < TAU * tuned().path.part {
        return None;
    }
    let [sxx, sxy, syy] = flat
        .iter()
        .fold([0.0; 3], |[a, b, c], &(x, y)| [a + x * x, b + x * y, c + y * y]);
    // The principal axis of the points, along which an ellipse is longest.
    let lean = 0.5 * (2.0 * sxy).atan2(sxx - syy);
    let (sin, cos) = lean.sin_cos();
    let along = |&(x, y): &(f64, f64)| (x * cos + y * sin, y * cos - x * sin);
    let most = |pick: fn((f64, f64)) -> f64| flat.iter().map(|point| pick(along(point)).abs()).fold(0.0, f64::max);
    let (long, short) = (most(|p| p.0), most(|p| p.1));
    let narrow = if swept < TAU * tuned().path.round {
        tuned().path.wide
    } else {
        tuned().path.narrow
    };
    if short < narrow * long || short <= exact {
        return None;
    }
    let squares = flat.iter().map(|point| {
        let (u, v) = along(point);
        let round = (u / long).hypot(v / short);
        ((round - 1.0) * short).powi(2)
    });
    let lift = points.iter().map(|&point| (point - centre).dot(axis).powi(2));
    let residual = ((squares.sum::<f64>() + lift.sum::<f64>()) / points.len() as f64).sqrt();
    let most = if swept < TAU * tuned().path.round {
        tuned().path.part_off
    } else {
        0.3
    };
    (residual < most * long).then(|| {
        let spoke = |point: DVec3| (point - centre).reject_from_normalized(axis);
        let path = PathForm::Circle {
            axis,
            turns: swept / TAU,
            long: (x * cos + y * sin) * long,
            narrow: short / long,
            start: spoke(points[0]).normalize_or(x),
            end: spoke(points[points.len() - 1]).normalize_or(x),
        };
        (path, residual)
    })
}

/// Returns the centre of the circle nearest to points (Kåsa's fit), in the plane through their mean that is
/// perpendicular to `axis`; `None` if they determine no circle.
fn fitted_circle_centre(points: &[DVec3], axis: DVec3) -> Option<DVec3> {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let x = axis.any_orthonormal_vector();
    let y = axis.cross(x);
    let mut normal = DMat3::ZERO;
    let mut right = DVec3::ZERO;
    for &point in points {
        let (u, v) = ((point - mean).dot(x), (point - mean).dot(y));
        let row = DVec3::new(u, v, 1.0);
        normal += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        right += row * (u * u + v * v);
    }
    let solved = (normal.determinant().abs() > 1e-18).then(|| normal.inverse() * right)?;
    let centre = mean + x * (solved.x / 2.0) + y * (solved.y / 2.0);
    centre.is_finite().then_some(centre)
}

/// Fits a zigzag or wave; `None` if the path does not advance along its chord or crosses it too rarely.
fn wave(points: &[DVec3], exact: f64) -> Option<(PathForm, f64)> {
    let first = points[0];
    let chord = points[points.len() - 1] - first;
    let line = chord.try_normalize()?;
    let aside: Vec<DVec3> = points
        .iter()
        .map(|&point| (point - first).reject_from_normalized(line))
        .collect();
    let widest = aside.iter().copied().max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let side = widest.try_normalize()?;
    let across: Vec<f64> = aside.iter().map(|v| v.dot(side)).collect();
    let width =
        (across.iter().copied().fold(f64::MIN, f64::max) - across.iter().copied().fold(f64::MAX, f64::min)) / 2.0;
    let mut crossings = 0;
    let mut was = 0.0_f64;
    // Only clear crossings count: trembling about the chord is none.
    for &x in across.iter().filter(|x| x.abs() > 0.35 * width) {
        crossings += usize::from(was * x < 0.0);
        was = x;
    }
    let along: Vec<f64> = points.iter().map(|&p| (p - first).dot(line)).collect();
    let back = along.windows(2).map(|pair| (pair[0] - pair[1]).max(0.0)).sum::<f64>();
    if crossings < 2 || width < exact || width < 0.06 * chord.length() || back > 0.2 * chord.length() {
        return None;
    }
    let lift = aside.iter().map(|v| (*v - side * v.dot(side)).length_squared());
    let residual = (lift.sum::<f64>() / points.len() as f64).sqrt();
    // A sine spends more of its path near its turns than corners do.
    let far = across.iter().filter(|x| x.abs() > 0.8 * width).count();
    let wavy = far as f64 / points.len() as f64 > 0.26;
    Some((PathForm::Wave { chord, width, wavy }, residual))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(count: usize, at: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
        (0..count).map(|n| at(n as f64 / (count - 1) as f64)).collect()
    }

    #[test]
    fn each_kind_of_path_is_recognised_at_any_speed() {
        let ease = |s: f64| s * s * (3.0 - 2.0 * s);
        let line = fit_path_form(&along(30, |s| DVec3::new(0.2, 0.1, 0.0) * ease(s)), tuned().path.exact);
        assert_eq!(line.path.path_kind_name(), "straight");
        assert!(line.residual < 1e-9);
        let arc = fit_path_form(
            &along(30, |s| along_arc(DVec3::X * 0.2, DVec3::Z * 0.06, ease(s))),
            tuned().path.exact,
        );
        let PathForm::Arc { bow, .. } = arc.path else {
            panic!("{arc:?}");
        };
        assert!(bow.distance(DVec3::Z * 0.06) < 1e-3, "{bow}");
        let wave = |wavy: bool| {
            fit_path_form(
                &along(120, |s| {
                    let turn = (TAU * 2.0 * s).sin();
                    let side = if wavy { turn } else { turn.asin() / 1.571 };
                    DVec3::new(0.2 * s, 0.04 * side, 0.0)
                }),
                tuned().path.exact,
            )
        };
        for wavy in [true, false] {
            let PathForm::Wave { width, wavy: is, .. } = wave(wavy).path else {
                panic!("{:?}", wave(wavy));
            };
            assert!((width - 0.04).abs() < 4e-3 && is == wavy, "{width} {wavy}");
        }
    }

    #[test]
    fn circles_and_ellipses_give_their_axis_turns_and_size() {
        for (turns, narrow) in [(1.0, 1.0), (2.0, 1.0), (1.0, 0.5), (3.0, 0.75)] {
            let found = fit_path_form(
                &along(60 * turns as usize, |s| {
                    let (sin, cos) = (TAU * turns * s).sin_cos();
                    DVec3::new(0.1 * cos, 0.1 * narrow * sin, 0.3)
                }),
                tuned().path.exact,
            );
            let PathForm::Circle {
                axis,
                turns: is,
                long,
                narrow: shape,
                ..
            } = found.path
            else {
                panic!("{found:?}");
            };
            assert!(axis.distance(DVec3::Z) < 1e-6, "{axis}");
            assert!((is - turns).abs() < 0.05, "{is}");
            assert!((long.length() - 0.1).abs() < 6e-3, "{long}");
            assert!((shape - narrow).abs() < 0.08, "{shape}");
        }
    }

    #[test]
    fn most_of_a_circle_reads_as_a_circle_and_half_of_one_as_an_arc() {
        let turn = |share: f64| {
            fit_path_form(
                &along(40, |s| {
                    let (sin, cos) = (TAU * share * s).sin_cos();
                    DVec3::new(0.1 * cos, 0.1 * sin, 0.3)
                }),
                tuned().path.exact,
            )
        };
        assert_eq!(turn(0.5).path.path_kind_name(), "arc");
        let PathForm::Circle { end, turns, .. } = turn(0.79).path else {
            panic!("{:?}", turn(0.79));
        };
        let (sin, cos) = (TAU * 0.79).sin_cos();
        assert!(end.distance(DVec3::new(cos, sin, 0.0)) < 0.1, "{end}");
        assert!((turns - 0.79).abs() < 0.03, "{turns}");
    }

    #[test]
    fn paths_of_almost_no_length_are_fitted_without_an_error() {
        for points in [vec![DVec3::ONE], vec![DVec3::ONE; 9], vec![DVec3::ZERO, DVec3::X]] {
            assert!(fit_path_form(&points, tuned().path.exact).residual.is_finite());
        }
    }

    #[test]
    fn points_are_spaced_evenly_along_a_corner() {
        let corner = [DVec3::ZERO, DVec3::X * 3.0, DVec3::X * 3.0, DVec3::new(3.0, 1.0, 0.0)];
        let even = evenly_spaced_points(&corner, 5);
        for (n, at) in even.into_iter().enumerate() {
            let want = match n {
                0..=3 => DVec3::X * n as f64,
                _ => DVec3::new(3.0, 1.0, 0.0),
            };
            assert!(at.distance(want) < 1e-12, "{n}: {at}");
        }
    }

    #[test]
    fn circles_in_any_plane_give_axis_start_and_end_and_their_distance() {
        for (axis, lift) in [
            (DVec3::X, 0.0),
            (DVec3::new(1.0, 2.0, -2.0) / 3.0, 0.0),
            (DVec3::NEG_Z, 0.01),
        ] {
            let x = axis.any_orthonormal_vector();
            let y = axis.cross(x);
            let points = along(120, |s| {
                let (sin, cos) = (TAU * 1.125 * s).sin_cos();
                // The radius oscillates, and so does the height above the plane.
                let up = axis * (lift * (TAU * 9.0 * s).sin());
                DVec3::new(0.1, 0.2, 0.3) + (x * cos + y * sin) * 0.1 + up
            });
            let found = fit_path_form(&points, tuned().path.exact);
            let PathForm::Circle {
                axis: is,
                turns,
                start,
                end,
                narrow,
                long,
            } = found.path
            else {
                panic!("{found:?}");
            };
            assert!(is.distance(axis) < 0.02, "{is}");
            assert!((turns - 1.125).abs() < 0.02, "{turns}");
            assert!(start.distance(x) < 0.1, "{start}");
            let half = std::f64::consts::FRAC_1_SQRT_2;
            assert!(end.distance((x + y) * half) < 0.1, "{end}");
            assert!((narrow - 1.0).abs() < 0.03 && (long.length() - 0.1).abs() < 3e-3);
            // The root of the mean square of a sine is 1/√2 of its height.
            assert!((found.residual - lift * half).abs() < 2e-3, "{}", found.residual);
            let Some((PathForm::Straight { chord }, off)) = found.runner_up else {
                panic!("{found:?}");
            };
            assert!(chord.distance(points[119] - points[0]) < 1e-9 && off > 0.05);
        }
    }

    #[test]
    fn the_distance_from_a_path_is_the_root_of_the_mean_square() {
        let points = [DVec3::ZERO, DVec3::new(1.0, 0.3, 0.0), DVec3::new(2.0, 0.0, 0.4)];
        let is = path_point_deviation(&points, |s| DVec3::X * (2.0 * s));
        assert!((is - (0.25_f64 / 3.0).sqrt()).abs() < 1e-12, "{is}");
    }
}
