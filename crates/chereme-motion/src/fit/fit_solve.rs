//! Damped least squares over the rotations of a skeleton's joints.

use glam::{DQuat, DVec3};

use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::Skeleton;

/// A point in a joint's space, and its target position.
#[derive(Debug, Clone, Copy)]
pub(super) struct MarkerTarget {
    pub(super) joint: usize,
    pub(super) place: DVec3,
    pub(super) at: DVec3,
}

/// Weight of the pull of every joint towards its rest, in square metres per square radian; it determines the joints
/// that no marker shows.
const REST_PULL_WEIGHT: f64 = 2e-4;
/// Damping of the first step.
const INITIAL_DAMPING: f64 = 1e-3;
/// The factor on the damping after a step that succeeds.
const DAMPING_DECREASE_FACTOR: f64 = 0.4;
/// The factor on the damping after a step that fails.
const DAMPING_INCREASE_FACTOR: f64 = 6.0;
/// A step with a relative gain below this ends the search.
const MIN_RELATIVE_GAIN: f64 = 1e-5;
/// The largest turn of a joint in a step, in radians.
const MAX_STEP_RADIANS: f64 = 0.6;

/// The solver, with the joints that it turns.
pub(super) struct FitSolver<'s> {
    skeleton: &'s Skeleton,
    /// The joints with markers on them or below, parents first.
    joints: Vec<usize>,
    /// For each joint of the skeleton, the indices in `joints` of itself and its ancestors.
    above: Vec<Vec<usize>>,
}

impl<'s> FitSolver<'s> {
    /// Returns the solver for markers on these joints.
    pub(super) fn new(skeleton: &'s Skeleton, carriers: impl Iterator<Item = usize>) -> Self {
        let mut turned = vec![false; skeleton.len()];
        for carrier in carriers {
            // A joint moves a marker as well if the marker hangs on one below it.
            for joint in skeleton.joint_ancestors(carrier) {
                turned[joint] = true;
            }
        }
        let joints: Vec<usize> = (0..skeleton.len()).filter(|&joint| turned[joint]).collect();
        let above = (0..skeleton.len())
            .map(|joint| {
                let joint_ancestors: Vec<usize> = skeleton.joint_ancestors(joint).collect();
                (0..joints.len())
                    .filter(|&n| joint_ancestors.contains(&joints[n]))
                    .collect()
            })
            .collect();
        Self {
            skeleton,
            joints,
            above,
        }
    }

    /// Turns the joints and moves the root until the points are as near to the targets as possible.
    pub(super) fn solve_fit_pose(&mut self, start: LocalPose, targets: &[MarkerTarget], steps: usize) -> LocalPose {
        let mut pose = start;
        let mut model = ModelPose::from_local_pose(self.skeleton, &pose);
        let mut cost = self.fit_pose_cost(&pose, &model, targets);
        let mut damping = INITIAL_DAMPING;
        for _ in 0..steps {
            let Some(step) = self.solve_fit_step(&pose, &model, targets, damping) else {
                break;
            };
            let moved = self.apply_fit_step(&pose, &model, &step);
            let now = ModelPose::from_local_pose(self.skeleton, &moved);
            let new = self.fit_pose_cost(&moved, &now, targets);
            if new < cost {
                // A cost of almost zero would turn rounding into gain.
                let gain = (cost - new) / cost.max(1e-12);
                (pose, model, cost) = (moved, now, new);
                damping *= DAMPING_DECREASE_FACTOR;
                if gain < MIN_RELATIVE_GAIN {
                    break;
                }
            } else {
                damping *= DAMPING_INCREASE_FACTOR;
            }
        }
        pose
    }

    fn fit_pose_cost(&self, pose: &LocalPose, model: &ModelPose, targets: &[MarkerTarget]) -> f64 {
        let off = |target: &MarkerTarget| {
            model
                .joint_point_to_model(target.joint, target.place)
                .distance_squared(target.at)
        };
        let far: f64 = targets.iter().map(off).sum();
        let turned: f64 = self
            .joints
            .iter()
            // The root has no rest: it may stand anywhere and face anywhere.
            .skip(1)
            .map(|&joint| self.off_rest(pose, joint).length_squared())
            .sum();
        far + REST_PULL_WEIGHT * turned
    }

    /// Returns the rotation of a joint from rest, as a rotation vector in its parent's space.
    fn off_rest(&self, pose: &LocalPose, joint: usize) -> DVec3 {
        // Both signs are one rotation; the one with w above zero is the shorter turn.
        let raw_turn = pose.rotations[joint] * self.skeleton.joint_at(joint).rest.inverse();
        let turn = if raw_turn.w < 0.0 { -raw_turn } else { raw_turn };
        turn.to_scaled_axis()
    }

    /// Returns the shift of the root and the rotations of the joints in one step, in model space.
    fn solve_fit_step(
        &self,
        pose: &LocalPose,
        model: &ModelPose,
        targets: &[MarkerTarget],
        damping: f64,
    ) -> Option<Vec<DVec3>> {
        let size = 3 + 3 * self.joints.len();
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        let mut columns: Vec<(usize, DVec3)> = Vec::new();
        for target in targets {
            let model_place = model.joint_point_to_model(target.joint, target.place);
            let off = target.at - model_place;
            columns.clear();
            columns.extend((0..3).map(|axis| (axis, DVec3::AXES[axis])));
            for &n in &self.above[target.joint] {
                let arm = model_place - model.model_joint_position(self.joints[n]);
                // A small turn about an axis moves a point by axis × arm: the Jacobian's column.
                columns.extend((0..3).map(|axis| (3 + 3 * n + axis, DVec3::AXES[axis].cross(arm))));
            }
            for &(row, a) in &columns {
                right[row] += a.dot(off);
                for &(column, b) in &columns {
                    // The matrix is symmetric, and only its lower half is read.
                    if column <= row {
                        matrix[row * size + column] += a.dot(b);
                    }
                }
            }
        }
        for (n, &joint) in self.joints.iter().enumerate().skip(1) {
            let parent = self.skeleton.joint_parent(joint)?;
            // The rest pull is given in the parent's space and solved for in model space.
            let back = model.model_joint_rotation(parent) * self.off_rest(pose, joint);
            for axis in 0..3 {
                let row = 3 + 3 * n + axis;
                right[row] -= REST_PULL_WEIGHT * back[axis];
                matrix[row * size + row] += REST_PULL_WEIGHT;
            }
        }
        for row in 0..size {
            // Marquardt's scaling of the diagonal, and a constant for unknowns that no marker moves.
            matrix[row * size + row] *= 1.0 + damping;
            matrix[row * size + row] += 1e-9 + damping * 1e-4;
        }
        let solution = solve_cholesky(&mut matrix, right, size)?;
        Some(solution.chunks(3).map(DVec3::from_slice).collect())
    }

    fn apply_fit_step(&self, pose: &LocalPose, model: &ModelPose, step: &[DVec3]) -> LocalPose {
        let mut moved = pose.clone();
        moved.translations[0] += step[0];
        for (&joint, turn) in self.joints.iter().zip(&step[1..]) {
            // Linearisation is good for small turns only; a wild step would land in another minimum.
            let turn = turn.clamp_length_max(MAX_STEP_RADIANS);
            let above = self
                .skeleton
                .joint_parent(joint)
                .map_or(DQuat::IDENTITY, |parent| model.model_joint_rotation(parent));
            // The step is in model space and local rotations are in the parent's, so it is conjugated.
            let local_turn = above.inverse() * DQuat::from_scaled_axis(turn) * above;
            moved.rotations[joint] = (local_turn * pose.rotations[joint]).normalize();
        }
        moved
    }
}

/// Solves a symmetric positive definite system whose lower half is in `matrix`; `None` if it is not positive definite.
fn solve_cholesky(matrix: &mut [f64], mut right: Vec<f64>, size: usize) -> Option<Vec<f64>> {
    for row in 0..size {
        for column in 0..=row {
            let mut sum = matrix[row * size + column];
            for k in 0..column {
                sum -= matrix[row * size + k] * matrix[column * size + k];
            }
            if row == column {
                // A pivot that is not positive means that more damping is needed or the data is broken.
                if sum <= 0.0 || !sum.is_finite() {
                    return None;
                }
                matrix[row * size + row] = sum.sqrt();
            } else {
                matrix[row * size + column] = sum / matrix[column * size + column];
            }
        }
    }
    // Forwards through the lower triangle, then backwards through its transpose.
    for row in 0..size {
        let solved_sum: f64 = (0..row).map(|k| matrix[row * size + k] * right[k]).sum();
        right[row] = (right[row] - solved_sum) / matrix[row * size + row];
    }
    for row in (0..size).rev() {
        let solved_sum: f64 = (row + 1..size).map(|k| matrix[k * size + row] * right[k]).sum();
        right[row] = (right[row] - solved_sum) / matrix[row * size + row];
    }
    right.iter().all(|value| value.is_finite()).then_some(right)
}
