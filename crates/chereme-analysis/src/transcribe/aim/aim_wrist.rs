//! Limits of wrist and forearm: a hand that should turn farther stops there.

use chereme_motion::{WristAngles, WristLimits};
use chereme_sign::hamnosys::BodyLanguage;
use glam::{DQuat, DVec3};

/// A forearm with the limits of its hand's orientation.
#[derive(Debug, Clone, Copy)]
pub(in crate::transcribe) struct ForearmWristLimits {
    /// Unit vector from elbow to wrist.
    forearm: DVec3,
    /// Unit vector that the palm faces while the thumb is up.
    inner: DVec3,
    /// Factors that turn a left hand into a right one.
    mirror: DVec3,
    /// The limits of the hand's angles on it.
    limits: WristLimits,
}

/// A hand's axis and the direction of its palm: unit vectors at right angles.
pub(super) type PalmAxes = [DVec3; 2];

impl ForearmWristLimits {
    /// Takes the positions of shoulder, elbow and wrist (left, up, forward); `left` for a left hand.
    /// Returns `None` if the arm is too straight to show how the forearm is turned.
    pub(in crate::transcribe) fn from_arm_positions(
        [shoulder, elbow, wrist]: [DVec3; 3],
        left: bool,
        language: &BodyLanguage,
    ) -> Option<Self> {
        // Smallest distance of the elbow from the line, as a share of the arm: below it the arm is straight.
        const MIN_ELBOW_BEND: f64 = 0.02;
        let mirror = DVec3::new(if left { -1.0 } else { 1.0 }, 1.0, 1.0);
        let [upper, lower] = [elbow - shoulder, wrist - elbow].map(|bone| bone * mirror);
        let forearm = lower.try_normalize()?;
        let aside = upper.reject_from((upper + lower).try_normalize()?);
        let across = (upper + lower).cross(aside).try_normalize()?;
        if aside.length() < MIN_ELBOW_BEND * (upper.length() + lower.length()) {
            return None;
        }
        Some(Self {
            forearm,
            inner: forearm.cross(across.cross(forearm)).try_normalize()?,
            mirror,
            limits: language.wrist_limits(),
        })
    }

    /// Returns the orientations that a hand takes if it cannot reach `asked`: the wrist bends to its limit, in the same
    /// proportion or at the nearest point, and the forearm turns to either end of its range. Empty if the hand can
    /// reach `asked`.
    pub(super) fn limited_palm_axes(&self, asked: PalmAxes) -> Vec<PalmAxes> {
        let asked = self.palm_wrist_angles(asked.map(|axis| axis * self.mirror));
        let [less, more] = self.limits.turn;
        let bend = asked.wrist_bend_share(&self.limits);
        let turned = !(-less..=more).contains(&asked.turn);
        if bend <= 1.0 && !turned {
            return Vec::new();
        }
        let bends = match bend > 1.0 {
            true => vec![
                [asked.flexion / bend, asked.deviation / bend],
                asked.nearest_bend(&self.limits),
            ],
            false => vec![[asked.flexion, asked.deviation]],
        };
        let turns = match turned {
            true => vec![more, -less],
            false => vec![asked.turn],
        };
        let all = turns.iter().flat_map(|&turn| {
            bends.iter().map(move |&[flexion, deviation]| WristAngles {
                flexion,
                deviation,
                turn,
            })
        });
        all.map(|angles| self.palm_axes_from_angles(angles).map(|axis| axis * self.mirror))
            .collect()
    }

    /// Returns the angles of a hand on the forearm.
    fn palm_wrist_angles(&self, [along, palm]: PalmAxes) -> WristAngles {
        let forearm = self.forearm;
        let radial = along.cross(palm);
        let deviation = (-forearm.dot(radial)).clamp(-1.0, 1.0).asin();
        let flexion = (-forearm.dot(palm)).atan2(forearm.dot(along));
        let aligned = DQuat::from_rotation_arc(along, forearm) * palm;
        let turn = forearm.dot(self.inner.cross(aligned)).atan2(self.inner.dot(aligned));
        WristAngles {
            flexion,
            deviation,
            turn,
        }
    }

    /// Returns the axes of a hand with these angles: the inverse of [`angles`](Self::angles).
    fn palm_axes_from_angles(&self, angles: WristAngles) -> PalmAxes {
        let WristAngles {
            flexion,
            deviation,
            turn,
        } = angles;
        let palm = DQuat::from_axis_angle(self.forearm, turn) * self.inner;
        let radial = self.forearm.cross(palm);
        let across = deviation.cos();
        let seen = self.forearm * (across * flexion.cos()) - palm * (across * flexion.sin()) - radial * deviation.sin();
        let bent = DQuat::from_rotation_arc(seen.normalize(), self.forearm);
        [self.forearm, palm].map(|axis| bent * axis)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrist(left: bool) -> ForearmWristLimits {
        let arm = [
            DVec3::new(-0.2, 0.0, 0.0),
            DVec3::new(-0.25, -0.3, 0.05),
            DVec3::new(-0.15, -0.2, 0.3),
        ];
        let flip = DVec3::new(if left { -1.0 } else { 1.0 }, 1.0, 1.0);
        let arm = arm.map(|at| at * flip);
        ForearmWristLimits::from_arm_positions(arm, left, BodyLanguage::default_body_language()).expect("a bent arm")
    }

    #[test]
    fn wrist_angles_within_range_are_kept_and_others_stop_at_the_limit() {
        let wrist = wrist(false);
        for ([flexion, deviation, turn], free) in [
            ([0.3, -0.2, 0.5], true),
            ([-1.0, 0.2, -1.2], true),
            ([0.4, 0.7, 0.0], false),
            ([0.0, 0.0, 2.2], false),
        ] {
            let angles = WristAngles {
                flexion,
                deviation,
                turn,
            };
            let hung = wrist.palm_axes_from_angles(angles);
            let again = wrist.palm_wrist_angles(hung);
            assert!(angles.largest_angle_difference(&again) < 1e-2, "{angles:?} {again:?}");
            let stopped = wrist.limited_palm_axes(hung);
            assert_eq!(stopped.is_empty(), free, "{angles:?}");
            for at in stopped {
                let again = wrist.limited_palm_axes(at);
                let off = again.first().map_or(0.0, |again| again[0].angle_between(at[0]));
                assert!(off < 1e-2, "{angles:?} {off}");
            }
        }
    }

    #[test]
    fn a_left_wrist_has_the_mirrored_limits_of_a_right_one() {
        let flip = DVec3::new(-1.0, 1.0, 1.0);
        let asked = [DVec3::Y, DVec3::Z];
        let right = wrist(false).limited_palm_axes(asked);
        let left = wrist(true).limited_palm_axes(asked.map(|axis| axis * flip));
        assert!(!right.is_empty() && right.len() == left.len());
        for (a, b) in right.iter().flatten().zip(left.iter().flatten()) {
            assert!((*a * flip).distance(*b) < 1e-9);
        }
    }

    #[test]
    fn the_wrist_of_a_straight_arm_has_no_angles() {
        let arm = [DVec3::ZERO, DVec3::Z, DVec3::Z * 2.0];
        assert!(ForearmWristLimits::from_arm_positions(arm, false, BodyLanguage::default_body_language()).is_none());
    }
}
