//! Solves the arm for one frame: the hand's reference point at its goal, the wrist at its given angles.

use chereme_motion::glam::{DMat3, DQuat, DVec3};

use super::notation_arm::{ArmBearing, ArmPosture};
use super::notation_solve::{ArmFrame, ArmSolver, SolvedArmFrame};
use super::notation_stage::HandOutline;

/// Distance (m) from the goal above which a point is not settled.
const UNSETTLED_DISTANCE_M: f64 = 1e-3;
/// The number of attempts to bring an unsettled point nearer.
const MAX_NEARING_ATTEMPTS: usize = 8;
/// Largest step of one attempt, in metres.
const MAX_NEARING_STEP_M: f64 = 0.03;
/// Damping of the least-squares steps.
const LEAST_SQUARES_DAMPING: f64 = 1e-3;

impl ArmSolver<'_> {
    /// Solves the arm so that the hand's reference point is at its goal with the given wrist angles;
    /// pushes the hand out of the trunk.
    pub(crate) fn settle_arm_frame(
        &self,
        row: &ArmFrame,
        outlines: [&HandOutline; 2],
        before: Option<&SolvedArmFrame>,
    ) -> SolvedArmFrame {
        let rig = self.solver_arm_rig();
        let posed_wrist = |wrist: DVec3| {
            let posed = rig.reach_wrist_position(wrist, row.bearing, self.limits);
            let rotation = rig.hand_rotation_from_angles(&posed, &row.angles, &self.held);
            (posed, rotation)
        };
        if row.kept {
            let wrist = row.point - row.turned * row.offset;
            let posed = rig.reach_wrist_position(wrist, row.bearing, self.limits);
            let asked = rig.wrist_angles(&posed, row.turned, &self.held);
            let bent = asked
                .wrist_bend_share(&self.limits.wrist)
                .max(asked.forearm_turn_share(&self.limits.wrist));
            if posed.wrist.distance(wrist) < 1e-4 && bent < 1.0 + 1e-6 {
                return SolvedArmFrame {
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
        let (mut posed, mut rotation) = posed_wrist(wrist);
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
                    let raw_share = miss.dot(turned) / turned.length_squared().max(1e-18);
                    let share = raw_share.clamp(-2.0, 0.8);
                    asked - (asked - before) * share
                }
                None => asked,
            };
            last = Some((asked, miss));
            wrist = next;
            (posed, rotation) = posed_wrist(wrist);
        }
        if (posed.wrist + rotation * row.offset).distance(goal) > best.0 {
            (_, posed, rotation) = best;
        }
        if let Some(before) = before.filter(|_| best.0 > UNSETTLED_DISTANCE_M) {
            // With a folded forearm a small step of the wrist turns the hand far: stay near the last
            // position.
            (posed, rotation) = self.move_point_nearer(row, goal, before.posed.wrist);
        }
        let mut pushed = row.push.length();
        let mut within = self.offset_hand_out(posed.wrist, rotation, outlines).0;
        for _ in 0..4 {
            if within.length() < 2e-4 {
                break;
            }
            pushed += within.length();
            (posed, rotation) = posed_wrist(posed.wrist + within);
            within = self.offset_hand_out(posed.wrist, rotation, outlines).0;
        }
        SolvedArmFrame {
            residual: (posed.wrist + rotation * row.offset).distance(row.point),
            posed,
            rotation,
            pushed,
            within,
        }
    }

    /// Interpolates a hand between the results of two frames.
    pub(crate) fn carry_hand_between(
        &self,
        [from, to]: [&SolvedArmFrame; 2],
        bearing: ArmBearing,
        share: f64,
    ) -> (ArmPosture, DQuat) {
        let turned = from.rotation.slerp(to.rotation, share).normalize();
        let wrist = from.posed.wrist.lerp(to.posed.wrist, share);
        let posed = self.solver_arm_rig().reach_wrist_position(wrist, bearing, self.limits);
        (posed, self.within_range(&posed, turned))
    }

    /// Returns the nearest orientation of a hand within the limits of wrist and forearm.
    pub(super) fn within_range(&self, posed: &ArmPosture, turned: DQuat) -> DQuat {
        let asked = self.solver_arm_rig().wrist_angles(posed, turned, &self.held);
        let angles = asked.clamp_to_limits(&self.limits.wrist, asked.turn > 0.0);
        if angles == asked {
            return turned;
        }
        self.solver_arm_rig()
            .hand_rotation_from_angles(posed, &angles, &self.held)
    }

    /// Moves a hand's reference point towards its goal from the last wrist position, by damped
    /// least-squares steps.
    fn move_point_nearer(&self, row: &ArmFrame, goal: DVec3, from: DVec3) -> (ArmPosture, DQuat) {
        let posed_wrist = |wrist: DVec3| {
            let posed = self
                .solver_arm_rig()
                .reach_wrist_position(wrist, row.bearing, self.limits);
            let rotation = self
                .solver_arm_rig()
                .hand_rotation_from_angles(&posed, &row.angles, &self.held);
            (posed.wrist + rotation * row.offset, posed, rotation)
        };
        let mut wrist = from;
        let mut now = posed_wrist(wrist);
        let mut damping = LEAST_SQUARES_DAMPING;
        for _ in 0..MAX_NEARING_ATTEMPTS {
            let miss = goal - now.0;
            if miss.length() < 1e-4 {
                break;
            }
            let far = 1e-4;
            let slopes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (posed_wrist(wrist + axis * far).0 - now.0) / far);
            let slope = DMat3::from_cols(slopes[0], slopes[1], slopes[2]);
            let turned = slope.transpose();
            let square = turned * slope + DMat3::from_diagonal(DVec3::splat(damping));
            let step = (square.inverse() * (turned * miss)).clamp_length_max(MAX_NEARING_STEP_M);
            let next = posed_wrist(wrist + step);
            if step.is_finite() && next.0.distance(goal) < miss.length() {
                (wrist, now) = (wrist + step, next);
                damping = (0.3 * damping).max(LEAST_SQUARES_DAMPING);
            } else {
                damping = 10.0 * damping.max(0.01);
            }
        }
        (now.1, now.2)
    }
}
