//! Damped least squares over the rotations of a skeleton's joints.

use glam::{DQuat, DVec3};

use crate::pose::{ModelPose, Pose};
use crate::skeleton::Skeleton;

/// A point in a joint's space, and its target position.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target {
    pub(super) joint: usize,
    pub(super) place: DVec3,
    pub(super) at: DVec3,
}

/// Weight of the pull of every joint towards its rest, in square metres per square radian; it determines the joints
/// that no marker shows.
const PULL: f64 = 2e-4;
/// Damping of the first step.
const DAMPING: f64 = 1e-3;
/// The factor on the damping after a step that succeeds.
const EASIER: f64 = 0.4;
/// The factor on the damping after a step that fails.
const HARDER: f64 = 6.0;
/// A step with a relative gain below this ends the search.
const ENOUGH: f64 = 1e-5;
/// The largest turn of a joint in a step, in radians.
const LARGEST: f64 = 0.6;

/// The solver, with the joints that it turns.
pub(super) struct Solver<'s> {
    skeleton: &'s Skeleton,
    /// The joints with markers on them or below, parents first.
    joints: Vec<usize>,
    /// For each joint of the skeleton, the indices in `joints` of itself and its ancestors.
    above: Vec<Vec<usize>>,
}

impl<'s> Solver<'s> {
    /// Returns the solver for markers on these joints.
    pub(super) fn new(skeleton: &'s Skeleton, carriers: impl Iterator<Item = usize>) -> Self {
        let mut turned = vec![false; skeleton.len()];
        for carrier in carriers {
            for joint in skeleton.ancestors(carrier) {
                turned[joint] = true;
            }
        }
        let joints: Vec<usize> = (0..skeleton.len()).filter(|&joint| turned[joint]).collect();
        let above = (0..skeleton.len())
            .map(|joint| {
                let own: Vec<usize> = skeleton.ancestors(joint).collect();
                (0..joints.len())
                    .filter(|&n| own.contains(&joints[n]))
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
    pub(super) fn solve(&mut self, start: Pose, targets: &[Target], steps: usize) -> Pose {
        let mut pose = start;
        let mut model = ModelPose::of(self.skeleton, &pose);
        let mut cost = self.cost(&pose, &model, targets);
        let mut damping = DAMPING;
        for _ in 0..steps {
            let Some(step) = self.step(&pose, &model, targets, damping) else {
                break;
            };
            let moved = self.moved(&pose, &model, &step);
            let now = ModelPose::of(self.skeleton, &moved);
            let new = self.cost(&moved, &now, targets);
            if new < cost {
                let gain = (cost - new) / cost.max(1e-12);
                (pose, model, cost) = (moved, now, new);
                damping *= EASIER;
                if gain < ENOUGH {
                    break;
                }
            } else {
                damping *= HARDER;
            }
        }
        pose
    }

    fn cost(&self, pose: &Pose, model: &ModelPose, targets: &[Target]) -> f64 {
        let off = |target: &Target| {
            model
                .point(target.joint, target.place)
                .distance_squared(target.at)
        };
        let far: f64 = targets.iter().map(off).sum();
        let turned: f64 = self
            .joints
            .iter()
            .skip(1)
            .map(|&joint| self.off_rest(pose, joint).length_squared())
            .sum();
        far + PULL * turned
    }

    /// Returns the rotation of a joint from rest, as a rotation vector in its parent's space.
    fn off_rest(&self, pose: &Pose, joint: usize) -> DVec3 {
        let turn = pose.rotations[joint] * self.skeleton.joint(joint).rest.inverse();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        turn.to_scaled_axis()
    }

    /// Returns the shift of the root and the rotations of the joints in one step, in model space.
    fn step(
        &self,
        pose: &Pose,
        model: &ModelPose,
        targets: &[Target],
        damping: f64,
    ) -> Option<Vec<DVec3>> {
        let size = 3 + 3 * self.joints.len();
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        let mut columns: Vec<(usize, DVec3)> = Vec::new();
        for target in targets {
            let at = model.point(target.joint, target.place);
            let off = target.at - at;
            columns.clear();
            columns.extend((0..3).map(|axis| (axis, DVec3::AXES[axis])));
            for &n in &self.above[target.joint] {
                let arm = at - model.position(self.joints[n]);
                columns.extend((0..3).map(|axis| (3 + 3 * n + axis, DVec3::AXES[axis].cross(arm))));
            }
            for &(row, a) in &columns {
                right[row] += a.dot(off);
                for &(column, b) in &columns {
                    if column <= row {
                        matrix[row * size + column] += a.dot(b);
                    }
                }
            }
        }
        for (n, &joint) in self.joints.iter().enumerate().skip(1) {
            let parent = self.skeleton.parent(joint)?;
            let back = model.rotation(parent) * self.off_rest(pose, joint);
            for axis in 0..3 {
                let row = 3 + 3 * n + axis;
                right[row] -= PULL * back[axis];
                matrix[row * size + row] += PULL;
            }
        }
        for row in 0..size {
            matrix[row * size + row] *= 1.0 + damping;
            matrix[row * size + row] += 1e-9 + damping * 1e-4;
        }
        let found = cholesky(&mut matrix, right, size)?;
        Some(found.chunks(3).map(DVec3::from_slice).collect())
    }

    fn moved(&self, pose: &Pose, model: &ModelPose, step: &[DVec3]) -> Pose {
        let mut moved = pose.clone();
        moved.translations[0] += step[0];
        for (&joint, turn) in self.joints.iter().zip(&step[1..]) {
            let turn = turn.clamp_length_max(LARGEST);
            let above = self
                .skeleton
                .parent(joint)
                .map_or(DQuat::IDENTITY, |parent| model.rotation(parent));
            let own = above.inverse() * DQuat::from_scaled_axis(turn) * above;
            moved.rotations[joint] = (own * pose.rotations[joint]).normalize();
        }
        moved
    }
}

/// Solves a symmetric positive definite system whose lower half is in `matrix`; `None` if it is not positive definite.
fn cholesky(matrix: &mut [f64], mut right: Vec<f64>, size: usize) -> Option<Vec<f64>> {
    for row in 0..size {
        for column in 0..=row {
            let mut sum = matrix[row * size + column];
            for k in 0..column {
                sum -= matrix[row * size + k] * matrix[column * size + k];
            }
            if row == column {
                if sum <= 0.0 || !sum.is_finite() {
                    return None;
                }
                matrix[row * size + row] = sum.sqrt();
            } else {
                matrix[row * size + column] = sum / matrix[column * size + column];
            }
        }
    }
    for row in 0..size {
        let known: f64 = (0..row).map(|k| matrix[row * size + k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row * size + row];
    }
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size)
            .map(|k| matrix[k * size + row] * right[k])
            .sum();
        right[row] = (right[row] - known) / matrix[row * size + row];
    }
    right.iter().all(|it| it.is_finite()).then_some(right)
}
