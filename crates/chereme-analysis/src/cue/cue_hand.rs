//! The hand model: joint angles from markers, their components, markers from angles, and restoration of hidden markers.
//!
//! `markers = Xᵀ · [1, cos(angles), sin(angles)]` (section 3.2 of the paper): if one joint rotates, a point of the skin
//! moves on an ellipse. The angles are those between each segment and the hand and between successive segments; the
//! wrist rotates the hand as a whole in the space of the forearm.

use glam::{DMat3, DQuat, DVec3};

use super::ModelError;
use super::cue_labels::{
    FIRST_THUMB_MARKER, FOREARM_MARKERS, HAND_BACK_MARKERS, HAND_MARKER_COUNT, first_finger_marker,
};
use super::cue_terms::HandTerms;
use super::linear::DenseMatrix;
use super::pca::PrincipalComponents;
use super::rigid::RigidMotion;

/// The positions of the hand's markers in one frame, in millimetres; nothing for a hidden marker.
pub type HandMarkerFrame = Vec<Option<DVec3>>;

/// The number of angles computed from the markers: 3 of the back of the hand, 4 of each finger, 6 of the thumb.
pub const MARKER_HAND_ANGLES: usize = 25;
/// The number of those angles that are bends of fingers and thumb.
pub const HAND_BEND_COUNT: usize = MARKER_HAND_ANGLES - 3;
/// The usual distance from the joint of each bend to the tip, in millimetres.
const JOINT_TIP_LENGTHS_MM: [f64; HAND_BEND_COUNT] = [
    90.0, 90.0, 50.0, 25.0, 90.0, 90.0, 50.0, 25.0, 90.0, 90.0, 50.0, 25.0, 90.0, 90.0, 50.0, 25.0, 40.0, 40.0, 30.0,
    30.0, 25.0, 25.0,
];
/// The smallest mean square error used to weight a marker, in square millimetres along one axis.
const LEAST_ERROR: f64 = 0.3;
/// The number of Gauss-Newton steps from the posture of the previous frame, and from one computed from the markers.
const GAUSS_NEWTON_STEPS: usize = 5;
const FIRST_STEPS: usize = 12;
/// The share of the mean diagonal that is added to the regression's equations.
const RIDGE_DIAGONAL_SHARE: f64 = 1e-4;
/// The first of the markers that rotate with the wrist.
const FIRST_TURNED_MARKER: usize = HAND_BACK_MARKERS.start;

/// A model of one person's hand.
#[derive(Debug, Clone)]
pub struct HandModel {
    /// The mean positions of the forearm's markers.
    forearm: Vec<DVec3>,
    /// The mean positions of the markers on the back of the hand, in the space of the forearm.
    back: Vec<DVec3>,
    /// The point about which the hand rotates, in the space of the forearm.
    wrist: DVec3,
    levers: AngleLevers,
    /// Components of the angles, which are converted to millimetres of displacement.
    pub components: PrincipalComponents,
    terms: HandTerms,
    /// The coefficients of the 150 marker coordinates for each term, in the space of the hand.
    moved: DenseMatrix,
    /// The error of each marker on the training frames: mean square along one axis.
    missed: Vec<f64>,
}

/// A frame with the positions of all markers computed by the model.
#[derive(Debug, Clone)]
pub struct RestoredHand {
    /// The model's position of each marker.
    pub points: Vec<DVec3>,
    /// The predicted standard deviation of each position, in millimetres along one axis.
    pub sd: Vec<f64>,
    /// Whether the marker was visible: then its captured position is used, and `points` serves only for comparison.
    pub seen: Vec<bool>,
    /// The parameters of the components.
    pub parameters: Vec<f64>,
    /// The motion of the forearm.
    pub forearm: RigidMotion,
}

/// The marker positions of a posture in the space of the forearm, and the derivative of each by each parameter.
type LinearHandPosture = (Vec<DVec3>, Vec<Vec<DVec3>>);

impl HandModel {
    /// Learns a model of `keep` components from frames of an unobstructed hand, such as one in free space.
    ///
    /// The components are those of the angles, in numbers whose differences are displacements of all markers: joints
    /// that move the same markers count together. The wrist rotates the hand as a whole, so that the regression contains
    /// no product of rotations.
    ///
    /// # Errors
    /// [`ModelError`] if too few frames show the forearm, or a marker is visible in none.
    pub fn learn_hand_model(frames: &[HandMarkerFrame], keep: usize) -> Result<Self, ModelError> {
        let forearm = mean_rigid(frames, FOREARM_MARKERS)?;
        let mut local: Vec<HandMarkerFrame> = Vec::new();
        for frame in frames {
            if frame.len() == HAND_MARKER_COUNT
                && let Ok(rigid) = RigidMotion::fit_rigid_motion(&forearm, &frame[FOREARM_MARKERS])
            {
                local.push(
                    frame
                        .iter()
                        .map(|at| at.filter(|at| at.is_finite()).map(|at| rigid.undo_rigid_motion(at)))
                        .collect(),
                );
            }
        }
        let back = mean_rigid(&local, HAND_BACK_MARKERS)?;
        let angles: Vec<Vec<f64>> = local.iter().map(|frame| compute_hand_angles(frame, &back)).collect();
        let wrist = find_wrist_centre(&local, &back)?;
        let terms = HandTerms::of_a_hand();
        // A first regression on the angles themselves shows how far each of them moves the markers.
        let first = PrincipalComponents::fit_principal_components(&angles, 12, 6)?;
        // Some 1,500 frames teach the levers; the regression that counts uses all of them.
        let step = (local.len() / 1500).max(1);
        let some: Vec<usize> = (0..local.len()).step_by(step).collect();
        let filled: Vec<Vec<f64>> = some.iter().map(|n| fill_missing_angles(&angles[*n], &first)).collect();
        let frames: Vec<HandMarkerFrame> = some.iter().map(|n| local[*n].clone()).collect();
        let moved = regress(&terms, &filled, &frames, wrist)?;
        let levers = AngleLevers::from_hand_terms(&terms, &moved, &filled, wrist)?;
        let scaled: Vec<Vec<f64>> = angles
            .iter()
            .map(|row| levers.scale_hand_angles(&fill_missing_angles(row, &first)))
            .collect();
        let components = PrincipalComponents::fit_principal_components(&scaled, keep, 6)?;
        let angles_of_frames: Vec<Vec<f64>> = scaled
            .iter()
            .map(|row| {
                levers.unscale_hand_angles(&components.rebuild_component_row(&components.project_component_row(row)))
            })
            .collect();
        let moved = regress(&terms, &angles_of_frames, &local, wrist)?;
        let mut missed = vec![(0.0, 0.0); HAND_MARKER_COUNT];
        for (angles, frame) in angles_of_frames.iter().zip(&local) {
            let input = terms.hand_term_values(angles);
            let turn = turn_of(angles);
            for (marker, at) in frame.iter().enumerate() {
                if let Some(at) = at {
                    let predicted =
                        hand_to_forearm_space(predict_marker_point(&moved, &input, marker), marker, turn, wrist);
                    missed[marker].0 += at.distance_squared(predicted);
                    missed[marker].1 += 3.0;
                }
            }
        }
        Ok(Self {
            forearm,
            back,
            wrist,
            levers,
            components,
            terms,
            moved,
            missed: missed
                .into_iter()
                .map(|(sum, count)| sum / f64::max(count, 1.0))
                .collect(),
        })
    }

    /// Returns the share of the angles' variance that the components explain, measured by how far the angles move the
    /// markers.
    #[must_use]
    pub fn explained_variance_share(&self) -> f64 {
        self.components.variances.iter().sum::<f64>() / self.components.total.max(1e-12)
    }

    /// Restores a frame from its visible markers, starting from the previous frame; hidden positions are not read.
    ///
    /// Returns nothing if fewer than three markers of the forearm are visible and no previous frame gives its position.
    #[must_use]
    pub fn restore_hand_markers(&self, frame: &HandMarkerFrame, before: Option<&RestoredHand>) -> Option<RestoredHand> {
        if frame.len() != HAND_MARKER_COUNT {
            return None;
        }
        let frame: HandMarkerFrame = frame.iter().map(|at| at.filter(|at| at.is_finite())).collect();
        let keep = self.components.directions.len();
        let (mut parameters, steps) = match before {
            Some(before) => (before.parameters.clone(), GAUSS_NEWTON_STEPS),
            None => (self.read_off(&frame), FIRST_STEPS),
        };
        let mut forearm = match RigidMotion::fit_rigid_motion(&self.forearm, &frame[FOREARM_MARKERS]) {
            Ok(rigid) => rigid,
            Err(_) => before?.forearm,
        };
        // Rotation and translation of the forearm stand before the parameters.
        let size = 6 + keep;
        let mut factor = None;
        for _ in 0..steps {
            let (points, slopes) = self.linearise_hand_posture(&parameters);
            let mut left = DenseMatrix::zero_matrix(size, size);
            let mut right = vec![0.0; size];
            let mut row = vec![0.0; size];
            for (marker, seen) in frame.iter().enumerate() {
                let Some(seen) = seen else { continue };
                let turned = forearm.rotation * points[marker];
                let apart = *seen - turned - forearm.translation;
                let weight = 1.0 / self.missed[marker].max(LEAST_ERROR);
                let derivatives = self.marker_parameter_derivatives(&forearm, turned, &slopes, marker);
                for axis in 0..3 {
                    for (own, derivative) in row.iter_mut().zip(&derivatives) {
                        *own = derivative[axis];
                    }
                    left.add_outer(&row, &row, weight);
                    for (right, value) in right.iter_mut().zip(&row) {
                        *right += weight * value * apart[axis];
                    }
                }
            }
            // The prior of each parameter is its variance in training, which holds hidden markers in place.
            for k in 0..keep {
                let variance = self.components.variances[k].max(1e-9);
                left[(6 + k, 6 + k)] += 1.0 / variance;
                right[6 + k] -= parameters[k] / variance;
            }
            for k in 0..6 {
                // The forearm is free; the trace only keeps the equations solvable.
                left[(k, k)] += 1e-9;
            }
            let normal_factor = left.cholesky_factor()?;
            let step = normal_factor.solve_factored(&right);
            let turn = DVec3::new(step[0], step[1], step[2]);
            forearm.rotation = (DQuat::from_scaled_axis(turn) * forearm.rotation).normalize();
            forearm.translation += DVec3::new(step[3], step[4], step[5]);
            for (own, step) in parameters.iter_mut().zip(&step[6..]) {
                *own += step;
            }
            factor = Some(normal_factor);
            // A hundredth of the unit of a component moves no marker visibly.
            if step[6..].iter().all(|step| step.abs() < 0.01) {
                break;
            }
        }
        let factor = factor?;
        let (points, slopes) = self.linearise_hand_posture(&parameters);
        let sd = (0..HAND_MARKER_COUNT).map(|marker| {
            let turned = forearm.rotation * points[marker];
            let derivatives = self.marker_parameter_derivatives(&forearm, turned, &slopes, marker);
            let spread: f64 = (0..3)
                .map(|axis| {
                    let row: Vec<f64> = derivatives.iter().map(|derivative| derivative[axis]).collect();
                    let solved = factor.solve_factored(&row);
                    row.iter().zip(&solved).map(|(a, b)| a * b).sum::<f64>()
                })
                .sum();
            (spread / 3.0 + self.missed[marker]).sqrt()
        });
        let sd = sd.collect();
        Some(RestoredHand {
            points: points.iter().map(|at| forearm.apply_rigid_motion(*at)).collect(),
            sd,
            seen: frame.iter().map(Option::is_some).collect(),
            parameters,
            forearm,
        })
    }

    /// Returns the component parameters of the angles that can be computed from a frame; hidden angles get their usual
    /// values.
    fn read_off(&self, frame: &HandMarkerFrame) -> Vec<f64> {
        let angles = self.angles_of(frame);
        let mut estimated_angles = self.levers.unscale_hand_angles(&self.components.mean);
        // Hidden angles follow from the components, which in turn depend on them.
        for _ in 0..6 {
            for (own, angle) in estimated_angles.iter_mut().zip(&angles) {
                if angle.is_finite() {
                    *own = *angle;
                }
            }
            let parameters = self
                .components
                .project_component_row(&self.levers.scale_hand_angles(&estimated_angles));
            if angles.iter().all(|angle| angle.is_finite()) {
                return parameters;
            }
            estimated_angles = self
                .levers
                .unscale_hand_angles(&self.components.rebuild_component_row(&parameters));
        }
        self.components
            .project_component_row(&self.levers.scale_hand_angles(&estimated_angles))
    }

    /// Returns the seven distances that distinguish shapes, from markers in any space.
    #[must_use]
    pub fn shape_distances(points: &[DVec3]) -> Option<[f64; 7]> {
        if points.len() != HAND_MARKER_COUNT {
            return None;
        }
        let frame: HandMarkerFrame = points.iter().copied().map(Some).collect();
        Self::distances_seen(&frame)
    }

    /// Returns the seven distances for a frame in which other markers may be hidden.
    #[must_use]
    pub fn distances_seen(frame: &HandMarkerFrame) -> Option<[f64; 7]> {
        let marker_point = |marker: usize| frame.get(marker).copied().flatten();
        let mut palm = DVec3::ZERO;
        for n in 0..4 {
            palm += marker_point(HAND_BACK_MARKERS.start + n)? / 4.0;
        }
        let tip = |n: usize| marker_point(first_finger_marker(n) + 7);
        let finger_extension = |n: usize| Some(marker_point(first_finger_marker(n))?.distance(tip(n)?));
        Some([
            marker_point(FIRST_THUMB_MARKER)?.distance(marker_point(FIRST_THUMB_MARKER + 5)?),
            finger_extension(0)?,
            finger_extension(1)?,
            finger_extension(2)?,
            finger_extension(3)?,
            tip(0)?.distance(tip(1)?),
            marker_point(FIRST_THUMB_MARKER + 5)?.distance(palm),
        ])
    }

    /// Returns the bends of fingers and thumb in each frame, in millimetres that their tips move; NaN for those whose
    /// markers are hidden.
    #[must_use]
    pub fn bends_seen(frames: &[HandMarkerFrame]) -> Vec<[f64; HAND_BEND_COUNT]> {
        let Ok(back) = mean_rigid(frames, HAND_BACK_MARKERS) else {
            return vec![[f64::NAN; HAND_BEND_COUNT]; frames.len()];
        };
        let scaled = |frame: &HandMarkerFrame| {
            let angles = compute_hand_angles(frame, &back);
            std::array::from_fn(|n| angles[MARKER_HAND_ANGLES - HAND_BEND_COUNT + n] * JOINT_TIP_LENGTHS_MM[n])
        };
        frames.iter().map(scaled).collect()
    }

    /// Returns the fingertip that points for a shape, if it is visible.
    #[must_use]
    pub fn tip_seen(frame: &HandMarkerFrame, shape: u8) -> Option<DVec3> {
        let finger_index = usize::from(!matches!(shape, 1 | 6));
        frame.get(first_finger_marker(finger_index) + 7).copied().flatten()
    }

    /// Returns the fingertip that points: that of the index finger for shapes 1 and 6, otherwise that of the middle
    /// finger.
    #[must_use]
    pub fn pointing_fingertip(points: &[DVec3], shape: u8) -> Option<DVec3> {
        let finger_index = usize::from(!matches!(shape, 1 | 6));
        points.get(first_finger_marker(finger_index) + 7).copied()
    }

    fn linearise_hand_posture(&self, parameters: &[f64]) -> LinearHandPosture {
        let angles = self
            .levers
            .unscale_hand_angles(&self.components.rebuild_component_row(parameters));
        let input = self.terms.hand_term_values(&angles);
        let turn = turn_of(&angles);
        let local: Vec<DVec3> = (0..HAND_MARKER_COUNT)
            .map(|marker| predict_marker_point(&self.moved, &input, marker))
            .collect();
        let points = local
            .iter()
            .enumerate()
            .map(|(marker, at)| hand_to_forearm_space(*at, marker, turn, self.wrist))
            .collect();
        let slopes = self
            .components
            .directions
            .iter()
            .map(|direction| {
                let rates = self.levers.unscale_hand_angles(direction);
                self.marker_position_slopes(&angles, &rates, turn, &local)
            })
            .collect();
        (points, slopes)
    }

    /// Returns the derivative of each marker's position if the angles change at the given `rates`.
    fn marker_position_slopes(&self, angles: &[f64], rates: &[f64], turn: DMat3, local: &[DVec3]) -> Vec<DVec3> {
        const ANGLE_DIFFERENCE_STEP: f64 = 1e-6;
        let later: Vec<f64> = (0..3).map(|k| angles[k] + ANGLE_DIFFERENCE_STEP * rates[k]).collect();
        let turning = (turn_of(&later) - turn) * (1.0 / ANGLE_DIFFERENCE_STEP);
        let change = self.terms.hand_term_slopes(angles, rates);
        (0..HAND_MARKER_COUNT)
            .map(|marker| {
                let marker_slope = predict_marker_point(&self.moved, &change, marker);
                if marker < FIRST_TURNED_MARKER {
                    return marker_slope;
                }
                turn * marker_slope + turning * (local[marker] - self.wrist)
            })
            .collect()
    }

    /// Returns the derivatives of a marker's position by the forearm's rotation and translation, and by each parameter.
    fn marker_parameter_derivatives(
        &self,
        forearm: &RigidMotion,
        turned: DVec3,
        slopes: &[Vec<DVec3>],
        marker: usize,
    ) -> Vec<DVec3> {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let mut derivatives: Vec<DVec3> = axes.iter().map(|unit| unit.cross(turned)).collect();
        derivatives.extend(axes);
        derivatives.extend(slopes.iter().map(|slope| forearm.rotation * slope[marker]));
        derivatives
    }

    /// Returns the angles of a frame computed from visible markers; NaN for those that cannot be computed.
    #[must_use]
    pub fn angles_of(&self, frame: &HandMarkerFrame) -> Vec<f64> {
        match RigidMotion::fit_rigid_motion(&self.forearm, &frame[FOREARM_MARKERS]) {
            Ok(rigid) => {
                let local: HandMarkerFrame = frame
                    .iter()
                    .map(|at| at.map(|at| rigid.undo_rigid_motion(at)))
                    .collect();
                compute_hand_angles(&local, &self.back)
            }
            Err(_) => vec![f64::NAN; MARKER_HAND_ANGLES],
        }
    }
}

/// Returns a row whose missing angles, which are not finite, have the values that the principal components predict from
/// the other angles.
fn fill_missing_angles(row: &[f64], components: &PrincipalComponents) -> Vec<f64> {
    let mut filled_row: Vec<f64> = row
        .iter()
        .zip(&components.mean)
        .map(|(x, mean)| if x.is_finite() { *x } else { *mean })
        .collect();
    if row.iter().all(|x| x.is_finite()) {
        return filled_row;
    }
    for _ in 0..6 {
        let predicted = components.rebuild_component_row(&components.project_component_row(&filled_row));
        for ((own, x), predicted) in filled_row.iter_mut().zip(row).zip(predicted) {
            if !x.is_finite() {
                *own = predicted;
            }
        }
    }
    filled_row
}

/// Returns the mean positions of the markers of a rigid set, by two rounds of fitting and averaging.
fn mean_rigid(frames: &[HandMarkerFrame], set: std::ops::Range<usize>) -> Result<Vec<DVec3>, ModelError> {
    let all =
        |frame: &&HandMarkerFrame| frame.len() == HAND_MARKER_COUNT && frame[set.clone()].iter().all(Option::is_some);
    let few = |found| ModelError::FewFrames { found, least: 2 };
    let first = frames.iter().find(all).ok_or(few(0))?;
    let mut mean: Vec<DVec3> = first[set.clone()].iter().flatten().copied().collect();
    for _ in 0..2 {
        let (mut sum, mut count) = (vec![DVec3::ZERO; mean.len()], 0);
        for frame in frames.iter().filter(all) {
            if let Ok(rigid) = RigidMotion::fit_rigid_motion(&mean, &frame[set.clone()]) {
                for (sum, at) in sum.iter_mut().zip(frame[set.clone()].iter().flatten()) {
                    *sum += rigid.undo_rigid_motion(*at);
                }
                count += 1;
            }
        }
        if count < 2 {
            return Err(few(count));
        }
        mean = sum.into_iter().map(|sum| sum / count as f64).collect();
    }
    Ok(mean)
}

/// Returns the rotation of the hand in the space of the forearm.
fn turn_of(angles: &[f64]) -> DMat3 {
    DMat3::from_quat(DQuat::from_scaled_axis(DVec3::new(angles[0], angles[1], angles[2])))
}

/// Converts a point from hand space to the space of the forearm.
fn hand_to_forearm_space(at: DVec3, marker: usize, turn: DMat3, wrist: DVec3) -> DVec3 {
    if marker < FIRST_TURNED_MARKER {
        at
    } else {
        turn * (at - wrist) + wrist
    }
}

/// Returns the point about which the back of the hand rotates: the least-squares solution of `t = c − R c`.
fn find_wrist_centre(local: &[HandMarkerFrame], back: &[DVec3]) -> Result<DVec3, ModelError> {
    let (mut left, mut right) = (DenseMatrix::zero_matrix(3, 3), vec![0.0; 3]);
    for frame in local {
        let Ok(hand) = RigidMotion::fit_rigid_motion(back, &frame[HAND_BACK_MARKERS]) else {
            continue;
        };
        let still = DMat3::IDENTITY - DMat3::from_quat(hand.rotation);
        for axis in 0..3 {
            let row = still.row(axis).to_array();
            left.add_outer(&row, &row, 1.0);
            for (right, value) in right.iter_mut().zip(row) {
                *right += value * hand.translation[axis];
            }
        }
    }
    for k in 0..3 {
        // If the wrist hardly rotates, the point stays near the origin of the forearm's space.
        left[(k, k)] += 1e-6 * local.len() as f64;
    }
    let solved = left
        .cholesky_factor()
        .ok_or(ModelError::Singular)?
        .solve_factored(&right);
    Ok(DVec3::new(solved[0], solved[1], solved[2]))
}

/// Returns the coefficients of the coordinates for each term, by ridge regression on the frames in which each marker is
/// visible.
fn regress(
    terms: &HandTerms,
    angles: &[Vec<f64>],
    frames: &[HandMarkerFrame],
    wrist: DVec3,
) -> Result<DenseMatrix, ModelError> {
    let inputs: Vec<Vec<f64>> = angles.iter().map(|row| terms.hand_term_values(row)).collect();
    let turns: Vec<DMat3> = angles.iter().map(|row| turn_of(row).transpose()).collect();
    let count = terms.len();
    let mut gram = DenseMatrix::zero_matrix(count, count);
    for row in &inputs {
        gram.add_outer(row, row, 1.0);
    }
    let mut coefficients = DenseMatrix::zero_matrix(count, 3 * HAND_MARKER_COUNT);
    let shared = ridged(gram.clone())?;
    for marker in 0..HAND_MARKER_COUNT {
        let mut marker_gram = None;
        let mut seen = 0;
        let mut right = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        for ((frame, input), turn) in frames.iter().zip(&inputs).zip(&turns) {
            let Some(at) = frame[marker] else {
                marker_gram
                    .get_or_insert_with(|| gram.clone())
                    .add_outer(input, input, -1.0);
                continue;
            };
            seen += 1;
            let local_point = if marker < FIRST_TURNED_MARKER {
                at
            } else {
                *turn * (at - wrist) + wrist
            };
            for (right, x) in right.iter_mut().zip(local_point.to_array()) {
                for (right, term) in right.iter_mut().zip(input) {
                    *right += term * x;
                }
            }
        }
        if seen == 0 {
            return Err(ModelError::NeverSeen(marker));
        }
        let marker_factor = marker_gram.map(ridged).transpose()?;
        let factor = marker_factor.as_ref().unwrap_or(&shared);
        for (axis, right) in right.iter().enumerate() {
            for (term, value) in factor.solve_factored(right).into_iter().enumerate() {
                coefficients[(term, 3 * marker + axis)] = value;
            }
        }
    }
    Ok(coefficients)
}

/// Returns the Cholesky factor of a matrix of inner products with the ridge added.
fn ridged(mut gram: DenseMatrix) -> Result<DenseMatrix, ModelError> {
    let count = gram.matrix_row_count();
    let diagonal = (0..count).map(|i| gram[(i, i)]).sum::<f64>() / count as f64;
    for i in 0..count {
        gram[(i, i)] += RIDGE_DIAGONAL_SHARE * diagonal;
    }
    gram.cholesky_factor().ok_or(ModelError::Singular)
}

/// Converts angles to numbers whose differences have the length of the displacement of all markers, in millimetres: the
/// root of the sum of squares.
#[derive(Debug, Clone)]
struct AngleLevers {
    /// The lower triangle `L` of the Cholesky factor of the mean of `Jᵀ J`, where `J` is the derivative of all markers by
    /// the angles; the numbers are `Lᵀ angles`.
    lower: DenseMatrix,
}

impl AngleLevers {
    fn from_hand_terms(
        terms: &HandTerms,
        moved: &DenseMatrix,
        angles: &[Vec<f64>],
        wrist: DVec3,
    ) -> Result<Self, ModelError> {
        let some: Vec<&Vec<f64>> = angles.iter().step_by((angles.len() / 60).max(1)).collect();
        let mut gram = DenseMatrix::zero_matrix(MARKER_HAND_ANGLES, MARKER_HAND_ANGLES);
        for row in &some {
            let input = terms.hand_term_values(row);
            let slopes: Vec<Vec<f64>> = (0..MARKER_HAND_ANGLES)
                .map(|n| {
                    let mut rates = vec![0.0; MARKER_HAND_ANGLES];
                    rates[n] = 1.0;
                    terms.hand_term_slopes(row, &rates)
                })
                .collect();
            for marker in 0..HAND_MARKER_COUNT {
                let offset = predict_marker_point(moved, &input, marker) - wrist;
                let derivative_vectors = (0..MARKER_HAND_ANGLES).map(|n| match n {
                    0..3 if marker >= FIRST_TURNED_MARKER => DVec3::AXES[n].cross(offset),
                    _ => predict_marker_point(moved, &slopes[n], marker),
                });
                let derivatives: Vec<DVec3> = derivative_vectors.collect();
                for axis in 0..3 {
                    let row: Vec<f64> = derivatives.iter().map(|derivative| derivative[axis]).collect();
                    gram.add_outer(&row, &row, 1.0 / some.len() as f64);
                }
            }
        }
        for n in 0..MARKER_HAND_ANGLES {
            // An angle that moves nothing still counts as a millimetre a radian.
            gram[(n, n)] += 1.0;
        }
        let lower = gram.cholesky_factor().ok_or(ModelError::Singular)?;
        Ok(Self { lower })
    }

    fn scale_hand_angles(&self, angles: &[f64]) -> Vec<f64> {
        (0..MARKER_HAND_ANGLES)
            .map(|k| (k..MARKER_HAND_ANGLES).map(|n| self.lower[(n, k)] * angles[n]).sum())
            .collect()
    }

    fn unscale_hand_angles(&self, scaled: &[f64]) -> Vec<f64> {
        let mut angles = scaled.to_vec();
        for k in (0..MARKER_HAND_ANGLES).rev() {
            let above: f64 = (k + 1..MARKER_HAND_ANGLES)
                .map(|n| self.lower[(n, k)] * angles[n])
                .sum();
            angles[k] = (angles[k] - above) / self.lower[(k, k)];
        }
        angles
    }
}

fn predict_marker_point(terms: &DenseMatrix, input: &[f64], marker: usize) -> DVec3 {
    let mut position = DVec3::ZERO;
    for (term, value) in input.iter().enumerate() {
        let row = &terms.matrix_row(term)[3 * marker..3 * marker + 3];
        position += DVec3::new(row[0], row[1], row[2]) * *value;
    }
    position
}

/// Computes the angles of a frame in the space of the forearm; NaN if the markers for an angle are hidden.
fn compute_hand_angles(frame: &HandMarkerFrame, back: &[DVec3]) -> Vec<f64> {
    let mut row = vec![f64::NAN; MARKER_HAND_ANGLES];
    let Ok(hand) = RigidMotion::fit_rigid_motion(back, &frame[HAND_BACK_MARKERS]) else {
        return row;
    };
    let turn = hand.rotation.to_scaled_axis();
    row[..3].copy_from_slice(&turn.to_array());
    let local: HandMarkerFrame = frame.iter().map(|at| at.map(|at| hand.undo_rigid_motion(at))).collect();
    let axes = palm_axes(back);
    let along = |from: usize, to: usize| -> Option<DVec3> {
        let direction = (local[to]? - local[from]?).try_normalize()?;
        Some(DVec3::new(
            direction.dot(axes[0]),
            direction.dot(axes[1]),
            direction.dot(axes[2]),
        ))
    };
    // In hand space: x is forward, y towards the thumb, z out of the back of the hand.
    let bend = |direction: DVec3| (-direction.z).atan2(direction.x);
    for n in 0..4 {
        let first = first_finger_marker(n);
        let angle_offset = 3 + 4 * n;
        let one = along(first, first + 2);
        let two = along(first + 3, first + 5);
        let three = along(first + 6, first + 7);
        if let Some(one) = one {
            row[angle_offset] = bend(one);
            row[angle_offset + 1] = one.y.clamp(-1.0, 1.0).asin();
        }
        if let (Some(one), Some(two)) = (one, two) {
            row[angle_offset + 2] = wrap_bend_angle(bend(two) - bend(one));
        }
        if let (Some(two), Some(three)) = (two, three) {
            row[angle_offset + 3] = wrap_bend_angle(bend(three) - bend(two));
        }
    }
    for n in 0..3 {
        if let Some(direction) = along(FIRST_THUMB_MARKER + 2 * n, FIRST_THUMB_MARKER + 2 * n + 1) {
            row[19 + 2 * n] = direction.y.atan2(direction.x);
            row[20 + 2 * n] = direction.z.clamp(-1.0, 1.0).asin();
        }
    }
    row
}

/// Returns the hand's axes from the mean markers of its back: forward, towards the thumb, out of the back.
fn palm_axes(back: &[DVec3]) -> [DVec3; 3] {
    let knuckles = (back[0] + back[1] + back[2] + back[3]) / 4.0;
    let wrist = (back[4] + back[5] + back[6]) / 3.0;
    let forward = (knuckles - wrist).normalize_or(DVec3::X);
    let thumb_offset = (back[0] - back[3]).reject_from_normalized(forward);
    let thumb = thumb_offset.normalize_or(DVec3::Y);
    [forward, thumb, forward.cross(thumb)]
}

/// Wraps an angle to the range from −90 to 270 degrees: fingers bend in one direction.
fn wrap_bend_angle(angle: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, TAU};
    (angle + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2
}

#[cfg(test)]
mod tests;
