//! Limits of wrist and forearm: a hand that should turn farther stops there.

use chereme_sign::hamnosys::BodyLanguage;
use glam::{DQuat, DVec3};

/// A forearm with the limits of its hand's orientation.
#[derive(Debug, Clone, Copy)]
pub(in crate::transcribe) struct Wrist {
    /// Unit vector from elbow to wrist.
    forearm: DVec3,
    /// Unit vector that the palm faces while the thumb is up.
    inner: DVec3,
    /// Factors that turn a left hand into a right one.
    mirror: DVec3,
    /// Limits of bending, backward and forward (rad).
    flexion: [f64; 2],
    /// Limits of bending towards the little finger and towards the thumb (rad).
    deviation: [f64; 2],
    /// Limits of turning palm down and palm up (rad).
    turn: [f64; 2],
}

/// A hand's axis and the direction of its palm: unit vectors at right angles.
pub(super) type Axes = [DVec3; 2];

impl Wrist {
    /// Takes the positions of shoulder, elbow and wrist (left, up, forward); `left` for a left hand.
    /// Returns `None` if the arm is too straight to show how the forearm is turned.
    pub(in crate::transcribe) fn of(
        [shoulder, elbow, wrist]: [DVec3; 3],
        left: bool,
        language: &BodyLanguage,
    ) -> Option<Self> {
        // Smallest distance of the elbow from the line, as a share of the arm: below it the arm is straight.
        const BENT: f64 = 0.02;
        let mirror = DVec3::new(if left { -1.0 } else { 1.0 }, 1.0, 1.0);
        let [upper, lower] = [elbow - shoulder, wrist - elbow].map(|bone| bone * mirror);
        let forearm = lower.try_normalize()?;
        let aside = upper.reject_from((upper + lower).try_normalize()?);
        let across = (upper + lower).cross(aside).try_normalize()?;
        if aside.length() < BENT * (upper.length() + lower.length()) {
            return None;
        }
        let angles = |less: f64, more: f64| [less.to_radians(), more.to_radians()];
        Some(Self {
            forearm,
            inner: forearm.cross(across.cross(forearm)).try_normalize()?,
            mirror,
            flexion: angles(language.limit_extension, language.limit_flexion),
            deviation: angles(language.limit_ulnar, language.limit_radial),
            turn: angles(language.limit_pronation, language.limit_supination),
        })
    }

    /// Returns the orientations at which a hand stops that cannot reach the `asked` one: at the limits of
    /// wrist and forearm, with both bends reduced in proportion or to the nearest point of the limit, and
    /// turned to either end. Empty if the hand can reach it.
    pub(super) fn stopped(&self, asked: Axes) -> Vec<Axes> {
        let [flexion, deviation, turn] = self.angles(asked.map(|axis| axis * self.mirror));
        let ends = [(flexion, self.flexion), (deviation, self.deviation)];
        let ends = ends.map(|(angle, range)| range[usize::from(angle > 0.0)]);
        let bend = (flexion / ends[0]).hypot(deviation / ends[1]);
        let turned = !(-self.turn[0]..=self.turn[1]).contains(&turn);
        let bends = if bend > 1.0 {
            let nearest = nearest_on_ellipse([flexion, deviation], ends);
            vec![[flexion / bend, deviation / bend], nearest]
        } else {
            vec![[flexion, deviation]]
        };
        let turns = if turned {
            vec![self.turn[1], -self.turn[0]]
        } else {
            vec![turn]
        };
        if bend <= 1.0 && !turned {
            return Vec::new();
        }
        let all = turns.iter().flat_map(|&turn| {
            bends
                .iter()
                .map(move |[flexion, deviation]| [*flexion, *deviation, turn])
        });
        all.map(|angles| self.hung(angles).map(|axis| axis * self.mirror))
            .collect()
    }

    /// Returns the angles of a hand on the forearm (rad): towards its palm, towards its thumb, and the
    /// turn from thumb up to palm up.
    fn angles(&self, [along, palm]: Axes) -> [f64; 3] {
        let forearm = self.forearm;
        let radial = along.cross(palm);
        let deviation = (-forearm.dot(radial)).clamp(-1.0, 1.0).asin();
        let flexion = (-forearm.dot(palm)).atan2(forearm.dot(along));
        let aligned = DQuat::from_rotation_arc(along, forearm) * palm;
        let turn = forearm
            .dot(self.inner.cross(aligned))
            .atan2(self.inner.dot(aligned));
        [flexion, deviation, turn]
    }

    /// Returns the axes of a hand with these angles: the inverse of [`angles`](Self::angles).
    fn hung(&self, [flexion, deviation, turn]: [f64; 3]) -> Axes {
        let palm = DQuat::from_axis_angle(self.forearm, turn) * self.inner;
        let radial = self.forearm.cross(palm);
        let across = deviation.cos();
        let seen = self.forearm * (across * flexion.cos())
            - palm * (across * flexion.sin())
            - radial * deviation.sin();
        let bent = DQuat::from_rotation_arc(seen.normalize(), self.forearm);
        [self.forearm, palm].map(|axis| bent * axis)
    }
}

/// Returns the point of an ellipse about the origin with these half axes that is nearest to a point
/// outside. Newton's method for the foot of the normal (Eberly, *Distance from a point to an ellipse*).
fn nearest_on_ellipse(point: [f64; 2], ends: [f64; 2]) -> [f64; 2] {
    let at = |t: f64| -> [f64; 2] {
        std::array::from_fn(|n| ends[n] * point[n] / (t + ends[n] * ends[n]))
    };
    let from = |n: usize| ends[n] * point[n].abs() - ends[n] * ends[n];
    let mut t = from(0).max(from(1)).max(0.0);
    for _ in 0..8 {
        let shares = at(t);
        let over = shares.iter().map(|share| share * share).sum::<f64>() - 1.0;
        let slope: f64 = (0..2)
            .map(|n| shares[n] * shares[n] / (t + ends[n] * ends[n]))
            .sum();
        t += over / (2.0 * slope).max(1e-12);
    }
    let shares = at(t);
    std::array::from_fn(|n| ends[n] * shares[n])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrist(left: bool) -> Wrist {
        let arm = [
            DVec3::new(-0.2, 0.0, 0.0),
            DVec3::new(-0.25, -0.3, 0.05),
            DVec3::new(-0.15, -0.2, 0.3),
        ];
        let flip = DVec3::new(if left { -1.0 } else { 1.0 }, 1.0, 1.0);
        let arm = arm.map(|at| at * flip);
        Wrist::of(arm, left, BodyLanguage::usual()).expect("a bent arm")
    }

    #[test]
    fn what_hangs_within_its_range_hangs_so_and_what_does_not_stops_at_its_end() {
        let wrist = wrist(false);
        for (angles, free) in [
            ([0.3, -0.2, 0.5], true),
            ([-1.0, 0.2, -1.2], true),
            ([0.4, 0.7, 0.0], false),
            ([0.0, 0.0, 2.2], false),
        ] {
            let hung = wrist.hung(angles);
            let again = wrist.angles(hung);
            for (a, b) in angles.iter().zip(again) {
                assert!((a - b).abs() < 1e-2, "{angles:?} {again:?}");
            }
            let stopped = wrist.stopped(hung);
            assert_eq!(stopped.is_empty(), free, "{angles:?}");
            for at in stopped {
                let again = wrist.stopped(at);
                let off = again
                    .first()
                    .map_or(0.0, |again| again[0].angle_between(at[0]));
                assert!(off < 1e-2, "{angles:?} {off}");
            }
        }
    }

    #[test]
    fn a_left_hand_stops_where_the_mirrored_right_one_does() {
        let flip = DVec3::new(-1.0, 1.0, 1.0);
        let asked = [DVec3::Y, DVec3::Z];
        let right = wrist(false).stopped(asked);
        let left = wrist(true).stopped(asked.map(|axis| axis * flip));
        assert!(!right.is_empty() && right.len() == left.len());
        for (a, b) in right.iter().flatten().zip(left.iter().flatten()) {
            assert!((*a * flip).distance(*b) < 1e-9);
        }
    }

    #[test]
    fn an_ellipse_is_met_where_no_other_point_of_it_is_nearer() {
        for (point, ends) in [
            ([1.0, 1.0], [1.4, 0.4]),
            ([0.1, -0.9], [1.3, 0.7]),
            ([-2.0, 0.0], [1.0, 0.5]),
        ] {
            let [x, y] = nearest_on_ellipse(point, ends);
            assert!(((x / ends[0]).hypot(y / ends[1]) - 1.0).abs() < 1e-6);
            let own = (x - point[0]).hypot(y - point[1]);
            for n in 0..360 {
                let (sin, cos) = f64::from(n).to_radians().sin_cos();
                let other = (ends[0] * cos - point[0]).hypot(ends[1] * sin - point[1]);
                assert!(own <= other + 1e-9, "{point:?} {n}");
            }
        }
    }

    #[test]
    fn a_straight_arm_does_not_tell_how_it_is_turned() {
        let arm = [DVec3::ZERO, DVec3::Z, DVec3::Z * 2.0];
        assert!(Wrist::of(arm, false, BodyLanguage::usual()).is_none());
    }
}
