//! Inverse kinematics of two bones in closed form, for arms.

use glam::{DQuat, DVec3};

use super::{IkError, finite};
use crate::interpolation::smooth_step;

/// The treatment of the ends of the reach in [`two_bone`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoBoneOptions {
    /// The share of the arm's length, before full extension, in which the end gradually lags behind a target that moves
    /// outwards, so that the elbow does not snap straight. At full extension the end lags by this share divided by e:
    /// 0.004 of a 52 cm arm are 2.1 mm, a lag of 0.77 mm. A source that is itself extended further is not pulled back.
    /// 0 means no softness.
    pub soft: f64,
    /// The direction of the middle joint if the source is too straight to show one; of any length.
    pub pole: Option<DVec3>,
}

impl Default for TwoBoneOptions {
    fn default() -> Self {
        Self {
            soft: 0.004,
            pole: None,
        }
    }
}

/// The resulting positions of two bones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoBone {
    /// The position of the joint between the bones.
    pub middle: DVec3,
    /// The position of the end; the target if it can be reached.
    pub end: DVec3,
    /// The distance from root to target as a share of both bones' length; above 1 the target is out of reach.
    pub extension: f64,
    /// Whether the end was held back a little because the limb is almost straight.
    pub soft: bool,
    /// Whether the target lies outside the reach, too far or too near.
    pub clamped: bool,
}

/// The distance of the middle from the line between root and end, as a share of the arm's length, from which the
/// source's swivel counts in full.
const CLEAR_SWIVEL_SHARE: f64 = 0.05;

/// Places the middle and the end of two bones so that the end reaches `target`.
///
/// `source` are root, middle and end of the posture to start from. With l₁, l₂ the bones' lengths and d the distance to
/// the target, the middle lies `x = (l₁² - l₂² + d²)/2d` along the line to the target and `√(l₁² - x²)` beside it. It
/// lies on the same side as in the source, carried along by the least rotation from the source's line to the new one:
/// that is the source's swivel. As a source becomes straight, its swivel loses its meaning; if the new arm is more bent
/// than the source, the pole takes over gradually, so that a source elbow that wavers about straight does not flip.
///
/// Lengths are kept; all positions are in the same space and unit.
///
/// # Errors
/// [`IkError`] if a number is not finite or a bone has no length.
pub fn two_bone(source: [DVec3; 3], target: DVec3, options: &TwoBoneOptions) -> Result<TwoBone, IkError> {
    let [root, middle, end] = source;
    finite("source", &source)?;
    finite("target", &[target])?;
    finite("pole", &[options.pole.unwrap_or(DVec3::ZERO)])?;
    if !options.soft.is_finite() {
        return Err(IkError::NotFinite("soft share"));
    }
    let (first, second) = (root.distance(middle), middle.distance(end));
    for (length, name) in [(first, "first bone"), (second, "second bone")] {
        // A bone without length leaves the elbow without a circle to lie on.
        if length <= 1e-9 * (first + second) || length < f64::MIN_POSITIVE {
            return Err(IkError::ZeroBone(name));
        }
    }
    let length = first + second;
    let line = source_line(source);
    let wanted = root.distance(target);
    let reached = limit_reach_distance(wanted, root.distance(end), [first, second], options.soft);
    // A target on the shoulder has no direction: the arm keeps that of the source.
    let towards = (target - root).try_normalize().unwrap_or(line);
    // Target on the root: every direction is right, so the first bone points beside the line.
    let (along, beside) = if reached < 1e-12 * length {
        (0.0, first)
    } else {
        let raw_x = (first * first - second * second + reached * reached) / (2.0 * reached);
        // Rounding at full extension may put the foot of the elbow beyond the first bone.
        let x = raw_x.clamp(-first, first);
        (x, (first * first - x * x).max(0.0).sqrt())
    };
    let bend_direction = swivel_direction(source, line, beside, options.pole);
    let out = least_turn(line, towards) * bend_direction;
    // After the turn the bend may lean along the line a little, which would change the lengths.
    let out = out.reject_from_normalized(towards).normalize_or(out);
    Ok(TwoBone {
        middle: root + towards * along + out * beside,
        end: root + towards * reached,
        extension: wanted / length,
        soft: reached < wanted,
        clamped: wanted > length * (1.0 + 1e-12) || wanted < (first - second).abs() - 1e-12 * length,
    })
}

/// Returns the unit vector from root to end, or along the first bone if they coincide.
pub(super) fn source_line([root, middle, end]: [DVec3; 3]) -> DVec3 {
    let line = end - root;
    let short = 1e-9 * (root.distance(middle) + middle.distance(end));
    if line.length() > short {
        line.normalize()
    } else {
        (middle - root).normalize_or(DVec3::X)
    }
}

/// Returns the least rotation from one unit vector to another.
pub(super) fn least_turn(from: DVec3, to: DVec3) -> DQuat {
    DQuat::from_rotation_arc(from, to).normalize()
}

/// Returns the distance to reach for a wanted one: at least the shortest that the bones allow, and at most their whole
/// length, which is approached softly in the last share `soft`, or beyond the source's distance.
fn limit_reach_distance(wanted: f64, source: f64, [first, second]: [f64; 2], soft: f64) -> f64 {
    let length = first + second;
    let near = (first - second).abs();
    // A source that is extended further than the soft range keeps its own extension.
    let from = (length * (1.0 - soft.clamp(0.0, 1.0))).max(source.min(length));
    let left = length - from;
    if wanted <= from {
        wanted.max(near)
    } else if left <= 1e-12 * length {
        length
    } else {
        // The exponential meets the identity with slope one and never passes the full length.
        length - left * (-(wanted - from) / left).exp()
    }
}

/// Returns the unit vector perpendicular to `line` in which the middle lies, from the swivel of the source.
fn swivel_direction(source: [DVec3; 3], line: DVec3, beside: f64, pole: Option<DVec3>) -> DVec3 {
    let [root, middle, end] = source;
    let clear = CLEAR_SWIVEL_SHARE * (root.distance(middle) + middle.distance(end));
    let middle_offset = (middle - root).reject_from_normalized(line);
    // A smooth step, so that trust in the source's swivel sets in without a kink.
    let trust = smooth_step(middle_offset.length() / clear);
    // The pole helps only an arm that bends more than its source did.
    let grown = ((beside - middle_offset.length()) / clear).clamp(0.0, 1.0);
    let raw_pole = pole.unwrap_or(DVec3::ZERO).normalize_or_zero();
    let pole = raw_pole.reject_from_normalized(line);
    let mixed = middle_offset + pole * (clear * (1.0 - trust) * grown);
    mixed
        .try_normalize()
        // Source and pole may cancel each other; then the pole alone decides.
        .filter(|_| mixed.length() > 1e-9 * clear)
        .or(pole.try_normalize().filter(|_| pole.length() > 1e-9))
        .unwrap_or_else(|| line.any_orthonormal_vector())
        .reject_from_normalized(line)
        .normalize_or(line.any_orthonormal_vector())
}
