//! A smooth path through points, as `travel … through` uses it and as pictures show it.
//!
//! The curve is a centripetal Catmull-Rom spline: it passes through every point, without loops or cusps that the points
//! do not require (Yuksel, Schaefer and Keyser, *Parameterization and applications of Catmull-Rom curves*, 2011).

use chereme_motion::glam::DVec3;

/// The number of straight pieces between two points, in the table of lengths.
const SPLINE_PIECE_COUNT: usize = 24;
/// The distance, in metres, below which two points count as one.
const SAME_POINT_DISTANCE_M: f64 = 1e-6;

/// A spline from the origin through points, measured along its length.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSpline {
    /// Places along the curve; the first is the origin.
    places: Vec<DVec3>,
    /// The length of the curve up to each place.
    lengths: Vec<f64>,
}

impl MeasuredSpline {
    /// Returns the curve from the origin through `points`, in metres; repeated points count once.
    #[must_use]
    pub fn new(points: &[DVec3]) -> Self {
        let mut knots = vec![DVec3::ZERO];
        for &point in points {
            // Between equal points the spline would divide by zero.
            if knots
                .last()
                .is_none_or(|last| last.distance(point) > SAME_POINT_DISTANCE_M)
            {
                knots.push(point);
            }
        }
        let last = knots.len() - 1;
        let mut places = vec![DVec3::ZERO];
        for at in 0..last {
            let (from, to) = (knots[at], knots[at + 1]);
            // Beyond an end the curve continues straight.
            let before = if at > 0 { knots[at - 1] } else { from * 2.0 - to };
            let after = knots.get(at + 2).copied().unwrap_or(to * 2.0 - from);
            let piece = [before, from, to, after];
            places.extend(
                (1..=SPLINE_PIECE_COUNT).map(|n| spline_point_between(piece, n as f64 / SPLINE_PIECE_COUNT as f64)),
            );
        }
        let mut lengths = vec![0.0];
        for pair in places.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
        }
        Self { places, lengths }
    }

    /// Returns the length of the curve, in metres.
    #[must_use]
    pub fn spline_length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Returns the place at a share of the length; beyond 0 and 1 the curve continues straight, for courses that
    /// overshoot.
    #[must_use]
    pub fn spline_point_at(&self, share: f64) -> DVec3 {
        let last = self.places.len() - 1;
        let wanted = share * self.spline_length();
        if last == 0 {
            return self.places[0];
        }
        let upper_index = self.lengths.partition_point(|length| *length < wanted);
        let next = upper_index.clamp(1, last);
        let (from, to) = (self.lengths[next - 1], self.lengths[next]);
        let part = (wanted - from) / (to - from).max(1e-12);
        let (a, b) = (self.places[next - 1], self.places[next]);
        a + (b - a) * part
    }

    /// Returns places along the curve for drawing, from the origin to the last point.
    #[must_use]
    pub fn spline_drawing_points(&self) -> &[DVec3] {
        &self.places
    }

    /// Returns the shape of the curve, in the words of inventories of movements: `straight`, `arc`, `circle`, else
    /// `path`.
    #[must_use]
    pub fn spline_shape_name(&self) -> &'static str {
        let end = self.places[self.places.len() - 1];
        let (chord, length) = (end.length(), self.spline_length());
        if length < SAME_POINT_DISTANCE_M || chord > 0.97 * length {
            return "straight";
        }
        let turned = self.total_spline_turn();
        if chord < 0.3 * length && turned > 4.5 {
            "circle"
        } else if chord > 0.3 * length && self.bends_to_one_side() {
            "arc"
        } else {
            "path"
        }
    }

    /// Returns the sum of all rotations along the curve in radians; opposite ones cancel.
    fn total_spline_turn(&self) -> f64 {
        let steps: Vec<DVec3> = self.places.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let sum = |axis: DVec3| -> f64 {
            let pairs = steps.windows(2);
            pairs
                .map(|pair| pair[0].angle_between(pair[1]) * pair[0].cross(pair[1]).dot(axis).signum())
                .sum()
        };
        // The mean axis of all turns gives opposite ones opposite signs.
        let axis: DVec3 = steps.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
        sum(axis).abs()
    }

    /// Returns whether the curve stays on one side of the line between its ends.
    fn bends_to_one_side(&self) -> bool {
        let end = self.places[self.places.len() - 1];
        let along = end.normalize_or(DVec3::X);
        let off = |at: &DVec3| *at - along * at.dot(along);
        let offsets = self.places.iter().map(off);
        let farthest = offsets.fold(DVec3::ZERO, |a, b| if b.length() > a.length() { b } else { a });
        // A tenth of the bulge on the other side still counts as one side.
        let least = -0.1 * farthest.length();
        let aside = farthest.normalize_or(DVec3::Y);
        self.places.iter().all(|at| off(at).dot(aside) >= least)
    }
}

/// Returns the point at the share `u` of the curve from the second to the third of four points.
fn spline_point_between(points: [DVec3; 4], u: f64) -> DVec3 {
    // Centripetal knots leave no loops or cusps between points at unequal distances.
    let knot = |a: DVec3, b: DVec3| a.distance(b).sqrt().max(1e-9);
    let [p0, p1, p2, p3] = points;
    let t1 = knot(p0, p1);
    let t2 = t1 + knot(p1, p2);
    let t3 = t2 + knot(p2, p3);
    let t = t1 + (t2 - t1) * u;
    let mix = |a: DVec3, b: DVec3, from: f64, to: f64| a.lerp(b, (t - from) / (to - from));
    let (a, b, c) = (mix(p0, p1, 0.0, t1), mix(p1, p2, t1, t2), mix(p2, p3, t2, t3));
    mix(mix(a, b, 0.0, t2), mix(b, c, t1, t3), t1, t2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(all: &[[f64; 2]]) -> Vec<DVec3> {
        all.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect()
    }

    #[test]
    fn the_curve_goes_through_every_point_at_even_speed() {
        let points = points(&[[0.1, 0.05], [0.15, 0.2], [-0.1, 0.22], [-0.12, 0.0]]);
        let spline = MeasuredSpline::new(&points);
        for point in &points {
            let near = spline.spline_drawing_points().iter().map(|it| it.distance(*point));
            assert!(near.fold(f64::INFINITY, f64::min) < 1e-9, "{point}");
        }
        let steps: Vec<DVec3> = (0..=200)
            .map(|n| spline.spline_point_at(f64::from(n) / 200.0))
            .collect();
        let each: Vec<f64> = steps.windows(2).map(|it| it[0].distance(it[1])).collect();
        let mean = spline.spline_length() / 200.0;
        // A chord of a bend is a little shorter than the bend.
        assert!(each.iter().all(|step| (step / mean - 1.0).abs() < 0.03));
        assert_eq!(spline.spline_point_at(0.0), DVec3::ZERO);
        assert!(spline.spline_point_at(1.0).distance(points[3]) < 1e-9);
    }

    #[test]
    fn curves_are_named_by_their_shape() {
        let circle: Vec<[f64; 2]> = (1..=8)
            .map(|n| f64::from(n) * std::f64::consts::FRAC_PI_4)
            .map(|a| [0.1 * a.sin(), 0.1 - 0.1 * a.cos()])
            .collect();
        for (all, want) in [
            (&[[0.2, 0.0]][..], "straight"),
            (&[[0.1, 0.002], [0.2, 0.0]], "straight"),
            (&[[0.1, 0.08], [0.2, 0.0]], "arc"),
            (&circle, "circle"),
            (&[[0.1, 0.08], [0.2, -0.08], [0.3, 0.08], [0.4, 0.0]], "path"),
        ] {
            assert_eq!(MeasuredSpline::new(&points(all)).spline_shape_name(), want, "{all:?}");
        }
    }

    #[test]
    fn coincident_points_give_a_finite_curve() {
        for all in [&[][..], &[[0.0, 0.0]], &[[0.1, 0.0], [0.1, 0.0], [0.1, 0.0]]] {
            let spline = MeasuredSpline::new(&points(all));
            assert!(spline.spline_point_at(0.5).is_finite() && spline.spline_length().is_finite());
            assert!(spline.spline_point_at(1.2).is_finite() && spline.spline_point_at(-0.2).is_finite());
        }
    }
}
