//! Solves the arm for one frame: the hand's reference point at its goal, the wrist at its given angles.

use chereme_motion::glam::{DMat3, DQuat, DVec3};

use super::arm::{Bearing, Posed};
use super::solve::{Arm, ArmFrame, Got};
use super::stage::HandOutline;

/// Distance (m) from the goal above which a point is not settled.
const UNSETTLED: f64 = 1e-3;
/// The number of attempts to bring an unsettled point nearer.
const NEARER: usize = 8;
/// Largest step of one attempt, in metres.
const STEP: f64 = 0.03;
/// Damping of the least-squares steps.
const DAMPING: f64 = 1e-3;

impl Arm<'_> {
    /// Solves the arm so that the hand's reference point is at its goal with the given wrist angles;
    /// pushes the hand out of the trunk.
    pub(crate) fn settle(
        &self,
        row: &ArmFrame,
        outlines: [&HandOutline; 2],
        before: Option<&Got>,
    ) -> Got {
        let rig = self.rig();
        let at = |wrist: DVec3| {
            let posed = rig.reach(wrist, row.bearing, self.limits);
            let rotation = rig.hung(&posed, &row.angles, &self.held);
            (posed, rotation)
        };
        if row.kept {
            let wrist = row.point - row.turned * row.offset;
            let posed = rig.reach(wrist, row.bearing, self.limits);
            let asked = rig.wrist(&posed, row.turned, &self.held);
            let bent = asked
                .bend(&self.limits.wrist)
                .max(asked.turned(&self.limits.wrist));
            if posed.wrist.distance(wrist) < 1e-4 && bent < 1.0 + 1e-6 {
                return Got {
                    residual: posed.wrist.distance(wrist),
                    posed,
                    rotation: row.turned,
                    pushed: 0.0,
                    within: DVec3::ZERO,
                };
            }
        }
        let goal = row.point + row.push;
        let start = before.map_or(row.turned, |got| got.rotation);
        let mut wrist = goal - start * row.offset;
        let mut last: Option<(DVec3, DVec3)> = None;
        let (mut posed, mut rotation) = at(wrist);
        let mut best = (f64::INFINITY, posed, rotation);
        for _ in 0..12 {
            let asked = goal - rotation * row.offset;
            let miss = asked - wrist;
            let off = (posed.wrist + rotation * row.offset).distance(goal);
            if off < best.0 {
                best = (off, posed, rotation);
            }
            if miss.length() < 5e-5 {
                break;
            }
            // Anderson's acceleration with one step of memory.
            let next = match last {
                Some((before, missed)) => {
                    let turned = miss - missed;
                    let share = miss.dot(turned) / turned.length_squared().max(1e-18);
                    let share = share.clamp(-2.0, 0.8);
                    asked - (asked - before) * share
                }
                None => asked,
            };
            last = Some((asked, miss));
            wrist = next;
            (posed, rotation) = at(wrist);
        }
        if (posed.wrist + rotation * row.offset).distance(goal) > best.0 {
            (_, posed, rotation) = best;
        }
        if let Some(before) = before.filter(|_| best.0 > UNSETTLED) {
            // With a folded forearm a small step of the wrist turns the hand far: stay near the last
            // position.
            (posed, rotation) = self.near(row, goal, before.posed.wrist);
        }
        let mut pushed = row.push.length();
        let mut within = self.offset_out(posed.wrist, rotation, outlines).0;
        for _ in 0..4 {
            if within.length() < 2e-4 {
                break;
            }
            pushed += within.length();
            (posed, rotation) = at(posed.wrist + within);
            within = self.offset_out(posed.wrist, rotation, outlines).0;
        }
        Got {
            residual: (posed.wrist + rotation * row.offset).distance(row.point),
            posed,
            rotation,
            pushed,
            within,
        }
    }

    /// Interpolates a hand between the results of two frames.
    pub(crate) fn carried(
        &self,
        [from, to]: [&Got; 2],
        bearing: Bearing,
        share: f64,
    ) -> (Posed, DQuat) {
        let turned = from.rotation.slerp(to.rotation, share).normalize();
        let wrist = from.posed.wrist.lerp(to.posed.wrist, share);
        let posed = self.rig().reach(wrist, bearing, self.limits);
        (posed, self.within_range(&posed, turned))
    }

    /// Returns the nearest orientation of a hand within the limits of wrist and forearm.
    pub(super) fn within_range(&self, posed: &Posed, turned: DQuat) -> DQuat {
        let asked = self.rig().wrist(posed, turned, &self.held);
        let angles = asked.allowed(&self.limits.wrist, asked.turn > 0.0);
        if angles == asked {
            return turned;
        }
        self.rig().hung(posed, &angles, &self.held)
    }

    /// Moves a hand's reference point towards its goal from the last wrist position, by damped
    /// least-squares steps.
    fn near(&self, row: &ArmFrame, goal: DVec3, from: DVec3) -> (Posed, DQuat) {
        let at = |wrist: DVec3| {
            let posed = self.rig().reach(wrist, row.bearing, self.limits);
            let rotation = self.rig().hung(&posed, &row.angles, &self.held);
            (posed.wrist + rotation * row.offset, posed, rotation)
        };
        let mut wrist = from;
        let mut now = at(wrist);
        let mut damping = DAMPING;
        for _ in 0..NEARER {
            let miss = goal - now.0;
            if miss.length() < 1e-4 {
                break;
            }
            let far = 1e-4;
            let slopes =
                [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (at(wrist + axis * far).0 - now.0) / far);
            let slope = DMat3::from_cols(slopes[0], slopes[1], slopes[2]);
            let turned = slope.transpose();
            let square = turned * slope + DMat3::from_diagonal(DVec3::splat(damping));
            let step = (square.inverse() * (turned * miss)).clamp_length_max(STEP);
            let next = at(wrist + step);
            if step.is_finite() && next.0.distance(goal) < miss.length() {
                (wrist, now) = (wrist + step, next);
                damping = (0.3 * damping).max(DAMPING);
            } else {
                damping = 10.0 * damping.max(0.01);
            }
        }
        (now.1, now.2)
    }
}
