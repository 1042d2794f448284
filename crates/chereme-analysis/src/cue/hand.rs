//! The hand model: joint angles from markers, their components, markers from angles, and restoration of hidden markers.
//!
//! `markers = Xᵀ · [1, cos(angles), sin(angles)]` (section 3.2 of the paper): if one joint rotates, a point of the skin
//! moves on an ellipse. The angles are those between each segment and the hand and between successive segments; the
//! wrist rotates the hand as a whole in the space of the forearm.

use glam::{DMat3, DQuat, DVec3};

use super::ModelError;
use super::labels::{BACK, FOREARM, HAND, THUMB, finger};
use super::linear::Matrix;
use super::pca::Pca;
use super::rigid::Rigid;
use super::terms::Terms;

/// The positions of the hand's markers in one frame, in millimetres; nothing for a hidden marker.
pub type Frame = Vec<Option<DVec3>>;

/// The number of angles computed from the markers: 3 of the back of the hand, 4 of each finger, 6 of the thumb.
pub const ANGLES: usize = 25;
/// The number of those angles that are bends of fingers and thumb.
pub const BENDS: usize = ANGLES - 3;
/// The usual distance from the joint of each bend to the tip, in millimetres.
const LENGTHS: [f64; BENDS] = [
    90.0, 90.0, 50.0, 25.0, 90.0, 90.0, 50.0, 25.0, 90.0, 90.0, 50.0, 25.0, 90.0, 90.0, 50.0, 25.0,
    40.0, 40.0, 30.0, 30.0, 25.0, 25.0,
];
/// The smallest mean square error used to weight a marker, in square millimetres along one axis.
const LEAST_ERROR: f64 = 0.3;
/// The number of Gauss-Newton steps from the posture of the previous frame, and from one computed from the markers.
const STEPS: usize = 5;
const FIRST_STEPS: usize = 12;
/// The share of the mean diagonal that is added to the regression's equations.
const RIDGE: f64 = 1e-4;
/// The first of the markers that rotate with the wrist.
const TURNED: usize = BACK.start;

/// A model of one person's hand.
#[derive(Debug, Clone)]
pub struct HandModel {
    /// The mean positions of the forearm's markers.
    forearm: Vec<DVec3>,
    /// The mean positions of the markers on the back of the hand, in the space of the forearm.
    back: Vec<DVec3>,
    /// The point about which the hand rotates, in the space of the forearm.
    wrist: DVec3,
    levers: Levers,
    /// Components of the angles, which are converted to millimetres of displacement.
    pub components: Pca,
    terms: Terms,
    /// The coefficients of the 150 marker coordinates for each term, in the space of the hand.
    moved: Matrix,
    /// The error of each marker on the training frames: mean square along one axis.
    missed: Vec<f64>,
}

/// A frame with the positions of all markers computed by the model.
#[derive(Debug, Clone)]
pub struct Restored {
    /// The model's position of each marker.
    pub points: Vec<DVec3>,
    /// The predicted standard deviation of each position, in millimetres along one axis.
    pub sd: Vec<f64>,
    /// Whether the marker was visible: then its captured position is used, and `points` serves only for comparison.
    pub seen: Vec<bool>,
    /// The parameters of the components.
    pub parameters: Vec<f64>,
    /// The motion of the forearm.
    pub forearm: Rigid,
}

/// The marker positions of a posture in the space of the forearm, and the derivative of each by each parameter.
type Linear = (Vec<DVec3>, Vec<Vec<DVec3>>);

impl HandModel {
    /// Learns a model of `keep` components from frames of an unobstructed hand, such as one in free space.
    ///
    /// The components are those of the angles, in numbers whose differences are displacements of all markers: joints
    /// that move the same markers count together. The wrist rotates the hand as a whole, so that the regression contains
    /// no product of rotations.
    ///
    /// # Errors
    /// [`ModelError`] if too few frames show the forearm, or a marker is visible in none.
    pub fn learn(frames: &[Frame], keep: usize) -> Result<Self, ModelError> {
        let forearm = mean_rigid(frames, FOREARM)?;
        let mut local: Vec<Frame> = Vec::new();
        for frame in frames {
            if frame.len() == HAND
                && let Ok(rigid) = Rigid::fit(&forearm, &frame[FOREARM])
            {
                local.push(
                    frame
                        .iter()
                        .map(|at| at.filter(|at| at.is_finite()).map(|at| rigid.undo(at)))
                        .collect(),
                );
            }
        }
        let back = mean_rigid(&local, BACK)?;
        let angles: Vec<Vec<f64>> = local.iter().map(|frame| angles(frame, &back)).collect();
        let wrist = wrist(&local, &back)?;
        let terms = Terms::of_a_hand();
        // A first regression on the angles themselves shows how far each of them moves the markers.
        let first = Pca::fit(&angles, 12, 6)?;
        let step = (local.len() / 1500).max(1);
        let some: Vec<usize> = (0..local.len()).step_by(step).collect();
        let filled: Vec<Vec<f64>> = some.iter().map(|n| whole(&angles[*n], &first)).collect();
        let frames: Vec<Frame> = some.iter().map(|n| local[*n].clone()).collect();
        let moved = regress(&terms, &filled, &frames, wrist)?;
        let levers = Levers::of(&terms, &moved, &filled, wrist)?;
        let scaled: Vec<Vec<f64>> = angles
            .iter()
            .map(|row| levers.scaled(&whole(row, &first)))
            .collect();
        let components = Pca::fit(&scaled, keep, 6)?;
        let angles_of_frames: Vec<Vec<f64>> = scaled
            .iter()
            .map(|row| levers.angles(&components.rebuild(&components.project(row))))
            .collect();
        let moved = regress(&terms, &angles_of_frames, &local, wrist)?;
        let mut missed = vec![(0.0, 0.0); HAND];
        for (angles, frame) in angles_of_frames.iter().zip(&local) {
            let input = terms.of(angles);
            let turn = turn_of(angles);
            for (marker, at) in frame.iter().enumerate() {
                if let Some(at) = at {
                    let predicted = placed(point(&moved, &input, marker), marker, turn, wrist);
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
    pub fn explained(&self) -> f64 {
        self.components.variances.iter().sum::<f64>() / self.components.total.max(1e-12)
    }

    /// Restores a frame from its visible markers, starting from the previous frame; hidden positions are not read.
    ///
    /// Returns nothing if fewer than three markers of the forearm are visible and no previous frame gives its position.
    #[must_use]
    pub fn restore(&self, frame: &Frame, before: Option<&Restored>) -> Option<Restored> {
        if frame.len() != HAND {
            return None;
        }
        let frame: Frame = frame
            .iter()
            .map(|at| at.filter(|at| at.is_finite()))
            .collect();
        let keep = self.components.directions.len();
        let (mut parameters, steps) = match before {
            Some(before) => (before.parameters.clone(), STEPS),
            None => (self.read_off(&frame), FIRST_STEPS),
        };
        let mut forearm = match Rigid::fit(&self.forearm, &frame[FOREARM]) {
            Ok(rigid) => rigid,
            Err(_) => before?.forearm,
        };
        let size = 6 + keep;
        let mut factor = None;
        for _ in 0..steps {
            let (points, slopes) = self.linear(&parameters);
            let mut left = Matrix::zeros(size, size);
            let mut right = vec![0.0; size];
            let mut row = vec![0.0; size];
            for (marker, seen) in frame.iter().enumerate() {
                let Some(seen) = seen else { continue };
                let turned = forearm.rotation * points[marker];
                let apart = *seen - turned - forearm.translation;
                let weight = 1.0 / self.missed[marker].max(LEAST_ERROR);
                let derivatives = self.derivatives(&forearm, turned, &slopes, marker);
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
            for k in 0..keep {
                let variance = self.components.variances[k].max(1e-9);
                left[(6 + k, 6 + k)] += 1.0 / variance;
                right[6 + k] -= parameters[k] / variance;
            }
            for k in 0..6 {
                left[(k, k)] += 1e-9;
            }
            let own = left.cholesky()?;
            let step = own.solve_factored(&right);
            let turn = DVec3::new(step[0], step[1], step[2]);
            forearm.rotation = (DQuat::from_scaled_axis(turn) * forearm.rotation).normalize();
            forearm.translation += DVec3::new(step[3], step[4], step[5]);
            for (own, step) in parameters.iter_mut().zip(&step[6..]) {
                *own += step;
            }
            factor = Some(own);
            if step[6..].iter().all(|step| step.abs() < 0.01) {
                break;
            }
        }
        let factor = factor?;
        let (points, slopes) = self.linear(&parameters);
        let sd = (0..HAND).map(|marker| {
            let turned = forearm.rotation * points[marker];
            let derivatives = self.derivatives(&forearm, turned, &slopes, marker);
            let spread: f64 = (0..3)
                .map(|axis| {
                    let row: Vec<f64> = derivatives
                        .iter()
                        .map(|derivative| derivative[axis])
                        .collect();
                    let solved = factor.solve_factored(&row);
                    row.iter().zip(&solved).map(|(a, b)| a * b).sum::<f64>()
                })
                .sum();
            (spread / 3.0 + self.missed[marker]).sqrt()
        });
        let sd = sd.collect();
        Some(Restored {
            points: points.iter().map(|at| forearm.apply(*at)).collect(),
            sd,
            seen: frame.iter().map(Option::is_some).collect(),
            parameters,
            forearm,
        })
    }

    /// Returns the component parameters of the angles that can be computed from a frame; hidden angles get their usual
    /// values.
    fn read_off(&self, frame: &Frame) -> Vec<f64> {
        let angles = self.angles_of(frame);
        let mut own = self.levers.angles(&self.components.mean);
        for _ in 0..6 {
            for (own, angle) in own.iter_mut().zip(&angles) {
                if angle.is_finite() {
                    *own = *angle;
                }
            }
            let parameters = self.components.project(&self.levers.scaled(&own));
            if angles.iter().all(|angle| angle.is_finite()) {
                return parameters;
            }
            own = self.levers.angles(&self.components.rebuild(&parameters));
        }
        self.components.project(&self.levers.scaled(&own))
    }

    /// Returns the seven distances that distinguish shapes, from markers in any space.
    #[must_use]
    pub fn distances(points: &[DVec3]) -> Option<[f64; 7]> {
        if points.len() != HAND {
            return None;
        }
        let frame: Frame = points.iter().copied().map(Some).collect();
        Self::distances_seen(&frame)
    }

    /// Returns the seven distances for a frame in which other markers may be hidden.
    #[must_use]
    pub fn distances_seen(frame: &Frame) -> Option<[f64; 7]> {
        let at = |marker: usize| frame.get(marker).copied().flatten();
        let mut palm = DVec3::ZERO;
        for n in 0..4 {
            palm += at(BACK.start + n)? / 4.0;
        }
        let tip = |n: usize| at(finger(n) + 7);
        let own = |n: usize| Some(at(finger(n))?.distance(tip(n)?));
        Some([
            at(THUMB)?.distance(at(THUMB + 5)?),
            own(0)?,
            own(1)?,
            own(2)?,
            own(3)?,
            tip(0)?.distance(tip(1)?),
            at(THUMB + 5)?.distance(palm),
        ])
    }

    /// Returns the bends of fingers and thumb in each frame, in millimetres that their tips move; NaN for those whose
    /// markers are hidden.
    #[must_use]
    pub fn bends_seen(frames: &[Frame]) -> Vec<[f64; BENDS]> {
        let Ok(back) = mean_rigid(frames, BACK) else {
            return vec![[f64::NAN; BENDS]; frames.len()];
        };
        let scaled = |frame: &Frame| {
            let angles = angles(frame, &back);
            std::array::from_fn(|n| angles[ANGLES - BENDS + n] * LENGTHS[n])
        };
        frames.iter().map(scaled).collect()
    }

    /// Returns the fingertip that points for a shape, if it is visible.
    #[must_use]
    pub fn tip_seen(frame: &Frame, shape: u8) -> Option<DVec3> {
        let own = usize::from(!matches!(shape, 1 | 6));
        frame.get(finger(own) + 7).copied().flatten()
    }

    /// Returns the fingertip that points: that of the index finger for shapes 1 and 6, otherwise that of the middle
    /// finger.
    #[must_use]
    pub fn tip(points: &[DVec3], shape: u8) -> Option<DVec3> {
        let own = usize::from(!matches!(shape, 1 | 6));
        points.get(finger(own) + 7).copied()
    }

    fn linear(&self, parameters: &[f64]) -> Linear {
        let angles = self.levers.angles(&self.components.rebuild(parameters));
        let input = self.terms.of(&angles);
        let turn = turn_of(&angles);
        let local: Vec<DVec3> = (0..HAND)
            .map(|marker| point(&self.moved, &input, marker))
            .collect();
        let points = local
            .iter()
            .enumerate()
            .map(|(marker, at)| placed(*at, marker, turn, self.wrist))
            .collect();
        let slopes = self
            .components
            .directions
            .iter()
            .map(|direction| {
                let rates = self.levers.angles(direction);
                self.slope(&angles, &rates, (turn, &local))
            })
            .collect();
        (points, slopes)
    }

    /// Returns the derivative of each marker's position if the angles change at the given `rates`.
    fn slope(&self, angles: &[f64], rates: &[f64], (turn, local): (DMat3, &[DVec3])) -> Vec<DVec3> {
        const STEP: f64 = 1e-6;
        let later: Vec<f64> = (0..3).map(|k| angles[k] + STEP * rates[k]).collect();
        let turning = (turn_of(&later) - turn) * (1.0 / STEP);
        let change = self.terms.slopes(angles, rates);
        (0..HAND)
            .map(|marker| {
                let own = point(&self.moved, &change, marker);
                if marker < TURNED {
                    return own;
                }
                turn * own + turning * (local[marker] - self.wrist)
            })
            .collect()
    }

    /// Returns the derivatives of a marker's position by the forearm's rotation and translation, and by each parameter.
    fn derivatives(
        &self,
        forearm: &Rigid,
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
    pub fn angles_of(&self, frame: &Frame) -> Vec<f64> {
        match Rigid::fit(&self.forearm, &frame[FOREARM]) {
            Ok(rigid) => {
                let local: Frame = frame.iter().map(|at| at.map(|at| rigid.undo(at))).collect();
                angles(&local, &self.back)
            }
            Err(_) => vec![f64::NAN; ANGLES],
        }
    }
}

/// Returns a row whose missing angles, which are not finite, have the values that the principal components predict from
/// the other angles.
fn whole(row: &[f64], components: &Pca) -> Vec<f64> {
    let mut own: Vec<f64> = row
        .iter()
        .zip(&components.mean)
        .map(|(x, mean)| if x.is_finite() { *x } else { *mean })
        .collect();
    if row.iter().all(|x| x.is_finite()) {
        return own;
    }
    for _ in 0..6 {
        let predicted = components.rebuild(&components.project(&own));
        for ((own, x), predicted) in own.iter_mut().zip(row).zip(predicted) {
            if !x.is_finite() {
                *own = predicted;
            }
        }
    }
    own
}

/// Returns the mean positions of the markers of a rigid set, by two rounds of fitting and averaging.
fn mean_rigid(frames: &[Frame], set: std::ops::Range<usize>) -> Result<Vec<DVec3>, ModelError> {
    let all =
        |frame: &&Frame| frame.len() == HAND && frame[set.clone()].iter().all(Option::is_some);
    let few = |found| ModelError::FewFrames { found, least: 2 };
    let first = frames.iter().find(all).ok_or(few(0))?;
    let mut mean: Vec<DVec3> = first[set.clone()].iter().flatten().copied().collect();
    for _ in 0..2 {
        let (mut sum, mut count) = (vec![DVec3::ZERO; mean.len()], 0);
        for frame in frames.iter().filter(all) {
            if let Ok(rigid) = Rigid::fit(&mean, &frame[set.clone()]) {
                for (sum, at) in sum.iter_mut().zip(frame[set.clone()].iter().flatten()) {
                    *sum += rigid.undo(*at);
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
    DMat3::from_quat(DQuat::from_scaled_axis(DVec3::new(
        angles[0], angles[1], angles[2],
    )))
}

/// Converts a point from hand space to the space of the forearm.
fn placed(at: DVec3, marker: usize, turn: DMat3, wrist: DVec3) -> DVec3 {
    if marker < TURNED {
        at
    } else {
        turn * (at - wrist) + wrist
    }
}

/// Returns the point about which the back of the hand rotates: the least-squares solution of `t = c − R c`.
fn wrist(local: &[Frame], back: &[DVec3]) -> Result<DVec3, ModelError> {
    let (mut left, mut right) = (Matrix::zeros(3, 3), vec![0.0; 3]);
    for frame in local {
        let Ok(hand) = Rigid::fit(back, &frame[BACK]) else {
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
        .cholesky()
        .ok_or(ModelError::Singular)?
        .solve_factored(&right);
    Ok(DVec3::new(solved[0], solved[1], solved[2]))
}

/// Returns the coefficients of the coordinates for each term, by ridge regression on the frames in which each marker is
/// visible.
fn regress(
    terms: &Terms,
    angles: &[Vec<f64>],
    frames: &[Frame],
    wrist: DVec3,
) -> Result<Matrix, ModelError> {
    let inputs: Vec<Vec<f64>> = angles.iter().map(|row| terms.of(row)).collect();
    let turns: Vec<DMat3> = angles.iter().map(|row| turn_of(row).transpose()).collect();
    let count = terms.len();
    let mut gram = Matrix::zeros(count, count);
    for row in &inputs {
        gram.add_outer(row, row, 1.0);
    }
    let mut found = Matrix::zeros(count, 3 * HAND);
    let shared = ridged(gram.clone())?;
    for marker in 0..HAND {
        let mut own = None;
        let mut seen = 0;
        let mut right = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        for ((frame, input), turn) in frames.iter().zip(&inputs).zip(&turns) {
            let Some(at) = frame[marker] else {
                own.get_or_insert_with(|| gram.clone())
                    .add_outer(input, input, -1.0);
                continue;
            };
            seen += 1;
            let at = if marker < TURNED {
                at
            } else {
                *turn * (at - wrist) + wrist
            };
            for (right, x) in right.iter_mut().zip(at.to_array()) {
                for (right, term) in right.iter_mut().zip(input) {
                    *right += term * x;
                }
            }
        }
        if seen == 0 {
            return Err(ModelError::NeverSeen(marker));
        }
        let own = own.map(ridged).transpose()?;
        let factor = own.as_ref().unwrap_or(&shared);
        for (axis, right) in right.iter().enumerate() {
            for (term, value) in factor.solve_factored(right).into_iter().enumerate() {
                found[(term, 3 * marker + axis)] = value;
            }
        }
    }
    Ok(found)
}

/// Returns the Cholesky factor of a matrix of inner products with the ridge added.
fn ridged(mut gram: Matrix) -> Result<Matrix, ModelError> {
    let count = gram.rows();
    let diagonal = (0..count).map(|i| gram[(i, i)]).sum::<f64>() / count as f64;
    for i in 0..count {
        gram[(i, i)] += RIDGE * diagonal;
    }
    gram.cholesky().ok_or(ModelError::Singular)
}

/// Converts angles to numbers whose differences have the length of the displacement of all markers, in millimetres: the
/// root of the sum of squares.
#[derive(Debug, Clone)]
struct Levers {
    /// The lower triangle `L` of the Cholesky factor of the mean of `Jᵀ J`, where `J` is the derivative of all markers by
    /// the angles; the numbers are `Lᵀ angles`.
    lower: Matrix,
}

impl Levers {
    fn of(
        terms: &Terms,
        moved: &Matrix,
        angles: &[Vec<f64>],
        wrist: DVec3,
    ) -> Result<Self, ModelError> {
        let some: Vec<&Vec<f64>> = angles.iter().step_by((angles.len() / 60).max(1)).collect();
        let mut gram = Matrix::zeros(ANGLES, ANGLES);
        for row in &some {
            let input = terms.of(row);
            let slopes: Vec<Vec<f64>> = (0..ANGLES)
                .map(|n| {
                    let mut rates = vec![0.0; ANGLES];
                    rates[n] = 1.0;
                    terms.slopes(row, &rates)
                })
                .collect();
            for marker in 0..HAND {
                let at = point(moved, &input, marker) - wrist;
                let derivatives = (0..ANGLES).map(|n| match n {
                    0..3 if marker >= TURNED => DVec3::AXES[n].cross(at),
                    _ => point(moved, &slopes[n], marker),
                });
                let derivatives: Vec<DVec3> = derivatives.collect();
                for axis in 0..3 {
                    let row: Vec<f64> = derivatives
                        .iter()
                        .map(|derivative| derivative[axis])
                        .collect();
                    gram.add_outer(&row, &row, 1.0 / some.len() as f64);
                }
            }
        }
        for n in 0..ANGLES {
            // An angle that moves nothing still counts as a millimetre a radian.
            gram[(n, n)] += 1.0;
        }
        let lower = gram.cholesky().ok_or(ModelError::Singular)?;
        Ok(Self { lower })
    }

    fn scaled(&self, angles: &[f64]) -> Vec<f64> {
        (0..ANGLES)
            .map(|k| (k..ANGLES).map(|n| self.lower[(n, k)] * angles[n]).sum())
            .collect()
    }

    fn angles(&self, scaled: &[f64]) -> Vec<f64> {
        let mut angles = scaled.to_vec();
        for k in (0..ANGLES).rev() {
            let above: f64 = (k + 1..ANGLES)
                .map(|n| self.lower[(n, k)] * angles[n])
                .sum();
            angles[k] = (angles[k] - above) / self.lower[(k, k)];
        }
        angles
    }
}

fn point(terms: &Matrix, input: &[f64], marker: usize) -> DVec3 {
    let mut at = DVec3::ZERO;
    for (term, value) in input.iter().enumerate() {
        let row = &terms.row(term)[3 * marker..3 * marker + 3];
        at += DVec3::new(row[0], row[1], row[2]) * *value;
    }
    at
}

/// Computes the angles of a frame in the space of the forearm; NaN if the markers for an angle are hidden.
fn angles(frame: &Frame, back: &[DVec3]) -> Vec<f64> {
    let mut row = vec![f64::NAN; ANGLES];
    let Ok(hand) = Rigid::fit(back, &frame[BACK]) else {
        return row;
    };
    let turn = hand.rotation.to_scaled_axis();
    row[..3].copy_from_slice(&turn.to_array());
    let local: Frame = frame.iter().map(|at| at.map(|at| hand.undo(at))).collect();
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
        let first = finger(n);
        let at = 3 + 4 * n;
        let one = along(first, first + 2);
        let two = along(first + 3, first + 5);
        let three = along(first + 6, first + 7);
        if let Some(one) = one {
            row[at] = bend(one);
            row[at + 1] = one.y.clamp(-1.0, 1.0).asin();
        }
        if let (Some(one), Some(two)) = (one, two) {
            row[at + 2] = wrapped(bend(two) - bend(one));
        }
        if let (Some(two), Some(three)) = (two, three) {
            row[at + 3] = wrapped(bend(three) - bend(two));
        }
    }
    for n in 0..3 {
        if let Some(direction) = along(THUMB + 2 * n, THUMB + 2 * n + 1) {
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
    let thumb = (back[0] - back[3]).reject_from_normalized(forward);
    let thumb = thumb.normalize_or(DVec3::Y);
    [forward, thumb, forward.cross(thumb)]
}

/// Wraps an angle to the range from −90 to 270 degrees: fingers bend in one direction.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, TAU};
    (angle + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2
}

#[cfg(test)]
mod tests;
