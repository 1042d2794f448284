//! The face model: the head's motion, guided components of the remaining motion, and the share of the head's motion
//! that each marker of the throat follows (section 3.1 of the paper).

use glam::{DQuat, DVec3};

use super::ModelError;
use super::cue_labels::{
    CHEEK_MARKERS, FACE_MARKER_COUNT, JAW_MARKERS, LIP_MARKERS, RIGID_HEAD_MARKERS, THROAT_MARKERS,
};
use super::linear::DenseMatrix;
use super::pca::find_guided_components;
use super::rigid::RigidMotion;

/// The positions of the face's markers in one frame, in millimetres; nothing for a hidden marker.
pub type FaceMarkerFrame = Vec<Option<DVec3>>;

/// The number of rounds in which the weights of the throat and the components are determined.
const FACE_FITTING_ROUNDS: usize = 5;

/// A model of one person's face.
#[derive(Debug, Clone)]
pub struct FaceModel {
    rigid: Vec<DVec3>,
    mean: Vec<DVec3>,
    /// The change of all 189 coordinates by one unit of each component.
    pub directions: Vec<Vec<f64>>,
    /// The share of the head's motion that each marker follows: 1 except for the throat.
    pub weights: Vec<f64>,
    /// The error of each marker on the training frames: mean square along one axis.
    missed: Vec<f64>,
}

/// Returns the coordinates that lead each component: jaw, rounding, upper lip, lower lip, corners, throat, and the rest
/// of the cheeks.
#[must_use]
pub fn face_component_subsets() -> Vec<Vec<usize>> {
    let of = |markers: std::ops::Range<usize>, axes: &[usize]| -> Vec<usize> {
        markers
            .flat_map(|marker| axes.iter().map(move |axis| 3 * marker + axis))
            .collect()
    };
    let corners = [LIP_MARKERS.start, LIP_MARKERS.start + 8].map(|marker| 3 * marker + 1);
    vec![
        of(JAW_MARKERS, &[1, 2]),
        of(LIP_MARKERS, &[0, 2]),
        of(LIP_MARKERS.start + 1..LIP_MARKERS.start + 8, &[1]),
        of(LIP_MARKERS.start + 9..LIP_MARKERS.end, &[1]),
        corners.to_vec(),
        of(THROAT_MARKERS, &[0, 1, 2]),
        of(CHEEK_MARKERS, &[0, 1, 2]),
    ]
}

/// Returns a share of a motion: of the rotation about its own axis, and of the translation.
#[must_use]
pub fn share_of(motion: &RigidMotion, weight: f64) -> RigidMotion {
    if weight == 1.0 {
        return *motion;
    }
    RigidMotion {
        rotation: DQuat::from_scaled_axis(motion.rotation.to_scaled_axis() * weight),
        translation: motion.translation * weight,
    }
}

impl FaceModel {
    /// Learns a model; frames with a hidden marker count only for the head's motion.
    ///
    /// # Errors
    /// [`ModelError`] if fewer than 20 frames show every marker.
    pub fn learn_face_model(frames: &[FaceMarkerFrame]) -> Result<Self, ModelError> {
        const MIN_COMPLETE_FACE_FRAMES: usize = 20;
        let complete_frames: Vec<Vec<DVec3>> = frames
            .iter()
            .filter(|frame| frame.len() == FACE_MARKER_COUNT)
            .filter_map(|frame| frame.iter().copied().collect::<Option<Vec<DVec3>>>())
            .filter(|frame| frame.iter().all(|at| at.is_finite()))
            .collect();
        if complete_frames.len() < MIN_COMPLETE_FACE_FRAMES {
            return Err(ModelError::FewFrames {
                found: complete_frames.len(),
                least: MIN_COMPLETE_FACE_FRAMES,
            });
        }
        let mut rigid: Vec<DVec3> = complete_frames[0][RIGID_HEAD_MARKERS].to_vec();
        let mut motions = Vec::new();
        // Each round fits to the mean of the last, which no single frame's shape distorts.
        for _ in 0..3 {
            motions.clear();
            let mut sum = vec![DVec3::ZERO; rigid.len()];
            let mut mean_turn = DVec3::ZERO;
            let mut mean_shift = DVec3::ZERO;
            for frame in &complete_frames {
                let seen: Vec<Option<DVec3>> = frame[RIGID_HEAD_MARKERS].iter().copied().map(Some).collect();
                let motion = RigidMotion::fit_rigid_motion(&rigid, &seen).map_err(|_| ModelError::Singular)?;
                for (sum, at) in sum.iter_mut().zip(&frame[RIGID_HEAD_MARKERS]) {
                    *sum += motion.undo_rigid_motion(*at);
                }
                mean_turn += motion.rotation.to_scaled_axis();
                mean_shift += motion.translation;
                motions.push(motion);
            }
            // The rigid set takes its mean position, so that motions are relative to the session's mean.
            let count = complete_frames.len() as f64;
            let usual = RigidMotion {
                rotation: DQuat::from_scaled_axis(mean_turn / count),
                translation: mean_shift / count,
            };
            rigid = sum
                .into_iter()
                .map(|sum| usual.apply_rigid_motion(sum / count))
                .collect();
        }
        // The last round has moved the rigid set once more.
        for (motion, frame) in motions.iter_mut().zip(&complete_frames) {
            let seen: Vec<Option<DVec3>> = frame[RIGID_HEAD_MARKERS].iter().copied().map(Some).collect();
            *motion = RigidMotion::fit_rigid_motion(&rigid, &seen).map_err(|_| ModelError::Singular)?;
        }
        Self::learn_face_shapes(rigid, &complete_frames, &motions)
    }

    fn learn_face_shapes(rigid: Vec<DVec3>, whole: &[Vec<DVec3>], motions: &[RigidMotion]) -> Result<Self, ModelError> {
        let mut weights = vec![1.0; FACE_MARKER_COUNT];
        // Half of the head's motion is where the search for each weight starts.
        weights[THROAT_MARKERS].fill(0.5);
        let mut directions = Vec::new();
        let mut mean = Vec::new();
        for _ in 0..FACE_FITTING_ROUNDS {
            let free: Vec<Vec<f64>> = whole
                .iter()
                .zip(motions)
                .map(|(frame, motion)| {
                    let markers = frame.iter().zip(&weights);
                    markers
                        .flat_map(|(at, weight)| share_of(motion, *weight).undo_rigid_motion(*at).to_array())
                        .collect()
                })
                .collect();
            let components = find_guided_components(&free, &face_component_subsets())?;
            mean = row_to_points(&components.mean);
            directions = components.directions;
            // The weight of each marker of the throat: its motion projected onto the effect of the whole head motion.
            let factor = products(&directions).ok_or(ModelError::Singular)?;
            let parameters: Vec<Vec<f64>> = free
                .iter()
                .map(|row| fit_face_parameters(&components.mean, &directions, &factor, row))
                .collect();
            for marker in THROAT_MARKERS {
                let (mut along, mut square) = (0.0, 0.0);
                for ((frame, motion), own) in whole.iter().zip(motions).zip(&parameters) {
                    let mut still = mean[marker];
                    for (direction, parameter) in directions.iter().zip(own) {
                        let marker_direction = &direction[3 * marker..3 * marker + 3];
                        still += DVec3::new(marker_direction[0], marker_direction[1], marker_direction[2]) * *parameter;
                    }
                    let displacement = motion.apply_rigid_motion(still) - still;
                    along += displacement.dot(frame[marker] - still);
                    square += displacement.length_squared();
                }
                // A head that never moves says nothing about the throat.
                if square > 1e-9 {
                    weights[marker] = (along / square).clamp(0.0, 1.0);
                }
            }
        }
        let mut model = Self {
            rigid,
            mean,
            directions,
            weights,
            missed: vec![0.0; FACE_MARKER_COUNT],
        };
        // Some 500 frames give the error well enough.
        let step = (whole.len() / 500).max(1);
        let mut count: f64 = 0.0;
        for frame in whole.iter().step_by(step) {
            let seen: FaceMarkerFrame = frame.iter().copied().map(Some).collect();
            if let Some((motion, own)) = model.estimate_face_parameters(&seen) {
                // Three coordinates, so that the error is that along one axis.
                count += 3.0;
                let predicted = model.place_face_markers(&motion, &own);
                for ((missed, at), predicted) in model.missed.iter_mut().zip(frame).zip(predicted) {
                    *missed += at.distance_squared(predicted);
                }
            }
        }
        model.missed.iter_mut().for_each(|miss| *miss /= count.max(1.0));
        Ok(model)
    }

    /// Returns the head's motion and the parameters of a frame, estimated from its visible markers; nothing if fewer
    /// than three markers of the rigid set are visible.
    #[must_use]
    pub fn estimate_face_parameters(&self, frame: &FaceMarkerFrame) -> Option<(RigidMotion, Vec<f64>)> {
        let motion = RigidMotion::fit_rigid_motion(&self.rigid, frame.get(RIGID_HEAD_MARKERS)?).ok()?;
        let keep = self.directions.len();
        let mut left = DenseMatrix::zero_matrix(keep, keep);
        let mut right = vec![0.0; keep];
        for (marker, at) in frame.iter().enumerate() {
            let Some(at) = at.filter(|at| at.is_finite()) else {
                continue;
            };
            let free = share_of(&motion, self.weights[marker]).undo_rigid_motion(at) - self.mean[marker];
            for axis in 0..3 {
                let row: Vec<f64> = self.directions.iter().map(|d| d[3 * marker + axis]).collect();
                left.add_outer(&row, &row, 1.0);
                for (right, value) in right.iter_mut().zip(&row) {
                    *right += value * free[axis];
                }
            }
        }
        for k in 0..keep {
            // Parameters have variance 1; markers are weighted as if their error were 1 mm.
            left[(k, k)] += 1.0;
        }
        Some((motion, left.cholesky_factor()?.solve_factored(&right)))
    }

    /// Returns the head's motion, the model's position of each marker in a frame, and its predicted standard deviation
    /// in millimetres along one axis; nothing if fewer than three markers of the rigid set are visible.
    #[must_use]
    pub fn restore_face_markers(&self, frame: &FaceMarkerFrame) -> Option<(RigidMotion, Vec<DVec3>, Vec<f64>)> {
        let (motion, parameters) = self.estimate_face_parameters(frame)?;
        let keep = self.directions.len();
        let mut left = DenseMatrix::zero_matrix(keep, keep);
        for (marker, at) in frame.iter().enumerate() {
            if at.is_none_or(|at| !at.is_finite()) {
                continue;
            }
            for axis in 0..3 {
                let row = self.coordinate_parameter_row(3 * marker + axis);
                left.add_outer(&row, &row, 1.0);
            }
        }
        for k in 0..keep {
            // The prior of the parameters, as in the estimate.
            left[(k, k)] += 1.0;
        }
        let factor = left.cholesky_factor()?;
        let sd = (0..FACE_MARKER_COUNT).map(|marker| {
            let spread: f64 = (0..3)
                .map(|axis| {
                    let row = self.coordinate_parameter_row(3 * marker + axis);
                    let solved = factor.solve_factored(&row);
                    row.iter().zip(&solved).map(|(a, b)| a * b).sum::<f64>()
                })
                .sum();
            (spread / 3.0 + self.missed[marker]).sqrt()
        });
        let sd = sd.collect();
        Some((motion, self.place_face_markers(&motion, &parameters), sd))
    }

    /// Returns how one coordinate changes with each parameter.
    fn coordinate_parameter_row(&self, coordinate: usize) -> Vec<f64> {
        self.directions.iter().map(|d| d[coordinate]).collect()
    }

    /// Returns the positions of a face's markers.
    #[must_use]
    pub fn place_face_markers(&self, motion: &RigidMotion, parameters: &[f64]) -> Vec<DVec3> {
        (0..FACE_MARKER_COUNT)
            .map(|marker| {
                let mut point = self.mean[marker];
                for (direction, parameter) in self.directions.iter().zip(parameters) {
                    let d = &direction[3 * marker..3 * marker + 3];
                    point += DVec3::new(d[0], d[1], d[2]) * *parameter;
                }
                share_of(motion, self.weights[marker]).apply_rigid_motion(point)
            })
            .collect()
    }
}

fn row_to_points(row: &[f64]) -> Vec<DVec3> {
    row.chunks_exact(3).map(|at| DVec3::new(at[0], at[1], at[2])).collect()
}

/// Returns the Cholesky factor of the directions' inner products.
fn products(directions: &[Vec<f64>]) -> Option<DenseMatrix> {
    let keep = directions.len();
    let mut left = DenseMatrix::zero_matrix(keep, keep);
    for (i, one) in directions.iter().enumerate() {
        for (j, other) in directions.iter().enumerate() {
            left[(i, j)] = one.iter().zip(other).map(|(a, b)| a * b).sum();
        }
        left[(i, i)] += 1e-6;
    }
    left.cholesky_factor()
}

/// Returns the parameters of a complete row by least squares; `factor` is that of [`products`].
fn fit_face_parameters(mean: &[f64], directions: &[Vec<f64>], factor: &DenseMatrix, row: &[f64]) -> Vec<f64> {
    let apart: Vec<f64> = row.iter().zip(mean).map(|(x, m)| x - m).collect();
    let right: Vec<f64> = directions
        .iter()
        .map(|one| one.iter().zip(&apart).map(|(a, b)| a * b).sum())
        .collect();
    factor.solve_factored(&right)
}
