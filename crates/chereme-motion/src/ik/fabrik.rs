//! Inverse kinematics of a chain of points by forward and backward reaching (FABRIK).

use glam::DVec3;

use super::{IkError, finite};

/// The conditions that stop [`solve_fabrik`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FabrikOptions {
    /// The distance of the end from the target that is near enough, in the unit of the points.
    pub tolerance: f64,
    /// The greatest number of passes.
    pub passes: u32,
    /// The direction of the first bend of a straight chain if the target lies on its line; without it, such a chain
    /// would only slide along the line and never bend.
    pub pole: Option<DVec3>,
}

impl Default for FabrikOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            passes: 200,
            pole: None,
        }
    }
}

/// The resulting chain.
#[derive(Debug, Clone, PartialEq)]
pub struct FabrikChain {
    /// The positions of the chain's points; the first is unchanged.
    pub points: Vec<DVec3>,
    /// The distance of the last point from the target.
    pub residual: f64,
    /// The number of passes.
    pub passes: u32,
}

/// Moves a chain of points, the first fixed, so that the last reaches `target`.
///
/// Each pass sets the last point on the target and pulls the others after it at their distances, then sets the first
/// point back and pulls the others again. A target out of reach gives a straight chain that points at it. Distances are
/// kept; the start decides which of the many solutions is found, so the swivel of an arm is not controlled.
///
/// # Errors
/// [`IkError`] if a number is not finite, a bone has no length, or there is no bone.
pub fn solve_fabrik(points: &[DVec3], target: DVec3, options: &FabrikOptions) -> Result<FabrikChain, IkError> {
    finite("source", points)?;
    finite("target", &[target])?;
    finite("pole", &[options.pole.unwrap_or(DVec3::ZERO)])?;
    if !options.tolerance.is_finite() {
        return Err(IkError::NotFinite("tolerance"));
    }
    let [root, .., _] = *points else {
        return Err(IkError::Short(points.len()));
    };
    let lengths: Vec<f64> = points.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let full_length: f64 = lengths.iter().sum();
    // A bone without length has no direction to keep.
    if lengths
        .iter()
        .any(|&l| l <= 1e-9 * full_length || l < f64::MIN_POSITIVE)
    {
        return Err(IkError::ZeroBone("bone"));
    }
    let mut points = points.to_vec();
    let mut passes = 0;
    // Out of reach the passes would converge slowly to the straight chain, which is known at once.
    if root.distance(target) >= full_length {
        let direction = (target - root).normalize_or(DVec3::X);
        stretch_chain(&mut points, &lengths, direction);
    } else {
        // Inside of reach only: a straight chain would slide along its line and never bend.
        unbend_line(&mut points, target, full_length, options.pole);
        while passes < options.passes && residual(&points, target) > options.tolerance {
            pull(points.iter_mut().rev(), lengths.iter().rev(), target);
            pull(points.iter_mut(), lengths.iter(), root);
            passes += 1;
        }
    }
    Ok(FabrikChain {
        residual: residual(&points, target),
        points,
        passes,
    })
}

fn residual(points: &[DVec3], target: DVec3) -> f64 {
    points.last().map_or(0.0, |end| end.distance(target))
}

fn stretch_chain(points: &mut [DVec3], lengths: &[f64], direction: DVec3) {
    let mut joint_place = points[0];
    for (point, length) in points[1..].iter_mut().zip(lengths) {
        joint_place += direction * *length;
        *point = joint_place;
    }
}

/// Sets the first of `points` on `anchor`, and the others at their lengths in the direction of their old positions.
fn pull<'a>(points: impl Iterator<Item = &'a mut DVec3>, lengths: impl Iterator<Item = &'a f64>, anchor: DVec3) {
    let mut before = anchor;
    // The first point goes onto the anchor itself, at no distance.
    for (point, length) in points.zip(std::iter::once(&0.0).chain(lengths)) {
        *point = before + (*point - before).normalize_or(DVec3::X) * *length;
        before = *point;
    }
}

/// Bends a chain that lies on one line with its target by a hundredth of its length.
fn unbend_line(points: &mut [DVec3], target: DVec3, whole: f64, pole: Option<DVec3>) {
    let root = points[0];
    let Some(line) = (points[1] - root).try_normalize() else {
        return;
    };
    let off = |point: &DVec3| (*point - root).reject_from_normalized(line).length();
    // A point off the line by a millionth of the length is enough for the passes to bend the chain.
    if points.iter().chain([&target]).any(|point| off(point) > 1e-6 * whole) {
        return;
    }
    let pole = pole.unwrap_or(DVec3::ZERO).reject_from_normalized(line);
    let out = pole.try_normalize().unwrap_or_else(|| line.any_orthonormal_vector());
    let last = points.len() - 1;
    for point in &mut points[1..last.max(1)] {
        *point += out * (0.01 * whole);
    }
}
