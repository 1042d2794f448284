//! The hand: joint angles from markers, their components, markers from angles, and hidden markers restored.
//!
//! `markers = Xᵀ · [1, cos(angles), sin(angles)]` in the space of the forearm (section 3.2 of the paper): when one
//! joint turns, a point of the skin moves on an ellipse.

use glam::{DQuat, DVec3};

use super::ModelError;
use super::labels::{BACK, FOREARM, HAND, THUMB, finger};
use super::linear::Matrix;
use super::pca::Pca;
use super::rigid::Rigid;

/// The places of the hand's markers in one frame, in millimetres; nothing for a hidden one.
pub type Frame = Vec<Option<DVec3>>;

/// How many angles are read off the markers: 3 of the back of the hand, 4 of each finger, 6 of the thumb.
pub const ANGLES: usize = 25;
/// The numbers of `[1, cos, sin]`.
const TERMS: usize = 2 * ANGLES + 1;
/// The error of measurement with which markers are weighed against usual postures, in millimetres.
const SIGMA: f64 = 2.0;
/// Steps of Gauss and Newton from the posture of the frame before.
const STEPS: usize = 5;

/// A model of one person's hand.
#[derive(Debug, Clone)]
pub struct HandModel {
    /// The mean places of the forearm's markers.
    forearm: Vec<DVec3>,
    /// The mean places of the markers of the back, in the space of the forearm.
    back: Vec<DVec3>,
    /// Components of the angles.
    pub components: Pca,
    /// For each term the 150 coordinates that it moves.
    terms: Matrix,
    /// The error of each marker on the frames of the learning: mean square of an axis.
    missed: Vec<f64>,
}

/// A frame whose markers were all read off the model.
#[derive(Debug, Clone)]
pub struct Restored {
    /// Where the model has each marker.
    pub points: Vec<DVec3>,
    /// The standard deviation that is predicted for each, in millimetres along one axis.
    pub sd: Vec<f64>,
    /// Whether the marker was seen: a seen place is kept, this one only stands next to it.
    pub seen: Vec<bool>,
    /// The parameters of the components.
    pub parameters: Vec<f64>,
    /// The motion of the forearm.
    pub forearm: Rigid,
}

impl HandModel {
    /// Learns a model of `keep` components from frames of a hand that nothing hides, such as one in free space.
    ///
    /// # Errors
    /// [`ModelError`] if too few frames show the forearm, or a marker is seen in none.
    pub fn learn(frames: &[Frame], keep: usize) -> Result<Self, ModelError> {
        let forearm = mean_rigid(frames, FOREARM)?;
        let mut local: Vec<Frame> = Vec::new();
        for frame in frames {
            if frame.len() == HAND
                && let Ok(rigid) = Rigid::fit(&forearm, &frame[FOREARM])
            {
                local.push(frame.iter().map(|at| at.map(|at| rigid.undo(at))).collect());
            }
        }
        let back = mean_rigid(&local, BACK)?;
        let angles: Vec<Vec<f64>> = local.iter().map(|frame| angles(frame, &back)).collect();
        let components = Pca::fit(&angles, keep, 6)?;
        // Each coordinate is regressed on the frames in which it is seen.
        let inputs: Vec<Vec<f64>> = angles
            .iter()
            .map(|row| terms(&components.rebuild(&components.project(&whole(row, &components)))))
            .collect();
        let mut gram = Matrix::zeros(TERMS, TERMS);
        for row in &inputs {
            gram.add_outer(row, row, 1.0);
        }
        let diagonal = (0..TERMS).map(|i| gram[(i, i)]).sum::<f64>() / TERMS as f64;
        let mut found = Matrix::zeros(TERMS, 3 * HAND);
        let mut missed = Vec::with_capacity(HAND);
        for marker in 0..HAND {
            let seen: Vec<usize> = (0..local.len())
                .filter(|n| local[*n][marker].is_some())
                .collect();
            if seen.is_empty() {
                return Err(ModelError::NeverSeen(marker));
            }
            let mut own = Matrix::zeros(TERMS, TERMS);
            if seen.len() == local.len() {
                own = gram.clone();
            } else {
                for n in &seen {
                    own.add_outer(&inputs[*n], &inputs[*n], 1.0);
                }
            }
            for i in 0..TERMS {
                own[(i, i)] += 1e-3 * diagonal;
            }
            let factor = own.cholesky().ok_or(ModelError::Singular)?;
            for axis in 0..3 {
                let mut right = vec![0.0; TERMS];
                for n in &seen {
                    let x = local[*n][marker].map_or(0.0, |at| at[axis]);
                    for (right, term) in right.iter_mut().zip(&inputs[*n]) {
                        *right += term * x;
                    }
                }
                for (term, value) in factor.solve_factored(&right).into_iter().enumerate() {
                    found[(term, 3 * marker + axis)] = value;
                }
            }
            let error = |n: &usize| {
                let said = point(&found, &inputs[*n], marker);
                local[*n][marker].map_or(0.0, |at| at.distance_squared(said))
            };
            missed.push(seen.iter().map(error).sum::<f64>() / (3.0 * seen.len() as f64));
        }
        Ok(Self {
            forearm,
            back,
            components,
            terms: found,
            missed,
        })
    }

    /// Restores a frame from its visible markers, starting from the frame before; hidden places are not looked at.
    ///
    /// Nothing if fewer than three markers of the forearm are seen and no frame before gives its place.
    #[must_use]
    pub fn restore(&self, frame: &Frame, before: Option<&Restored>) -> Option<Restored> {
        if frame.len() != HAND {
            return None;
        }
        let keep = self.components.directions.len();
        let mut parameters = before.map_or_else(|| vec![0.0; keep], |it| it.parameters.clone());
        let mut forearm = match Rigid::fit(&self.forearm, &frame[FOREARM]) {
            Ok(rigid) => rigid,
            Err(_) => before?.forearm,
        };
        let size = 6 + keep;
        let mut factor = None;
        for _ in 0..STEPS {
            let (points, slopes) = self.linear(&parameters);
            let mut left = Matrix::zeros(size, size);
            let mut right = vec![0.0; size];
            for (marker, seen) in frame.iter().enumerate() {
                let Some(seen) = seen.filter(|seen| seen.is_finite()) else {
                    continue;
                };
                let turned = forearm.rotation * points[marker];
                let apart = seen - turned - forearm.translation;
                let weight = 1.0 / (SIGMA * SIGMA);
                for axis in 0..3 {
                    let row = self.row(&forearm, turned, &slopes, marker, axis, keep);
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
        }
        let factor = factor?;
        let (points, slopes) = self.linear(&parameters);
        let sd = (0..HAND).map(|marker| {
            let turned = forearm.rotation * points[marker];
            let spread: f64 = (0..3)
                .map(|axis| {
                    let row = self.row(&forearm, turned, &slopes, marker, axis, keep);
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

    /// Returns the seven numbers by which shapes are distinguished, of markers in any space.
    #[must_use]
    pub fn distances(points: &[DVec3]) -> Option<[f64; 7]> {
        if points.len() != HAND {
            return None;
        }
        let palm = (0..4).map(|n| points[BACK.start + n]).sum::<DVec3>() / 4.0;
        let tip = |n: usize| points[finger(n) + 7];
        let own = |n: usize| points[finger(n)].distance(tip(n));
        Some([
            points[THUMB].distance(points[THUMB + 5]),
            own(0),
            own(1),
            own(2),
            own(3),
            tip(0).distance(tip(1)),
            points[THUMB + 5].distance(palm),
        ])
    }

    /// Returns the tip that points: of the index finger for shapes 1 and 6, else of the middle finger.
    #[must_use]
    pub fn tip(points: &[DVec3], shape: u8) -> Option<DVec3> {
        let own = usize::from(!matches!(shape, 1 | 6));
        points.get(finger(own) + 7).copied()
    }

    /// Returns the points in the space of the forearm, and how each of their coordinates changes with each parameter.
    fn linear(&self, parameters: &[f64]) -> (Vec<DVec3>, Vec<Vec<f64>>) {
        let angles = self.components.rebuild(parameters);
        let input = terms(&angles);
        let points = (0..HAND)
            .map(|marker| point(&self.terms, &input, marker))
            .collect();
        let slopes = self
            .components
            .directions
            .iter()
            .map(|direction| {
                let mut slope = vec![0.0; 3 * HAND];
                for (n, (angle, turn)) in angles.iter().zip(direction).enumerate() {
                    let (down, up) = (-angle.sin() * turn, angle.cos() * turn);
                    let (cos, sin) = (self.terms.row(1 + n), self.terms.row(1 + ANGLES + n));
                    for ((slope, cos), sin) in slope.iter_mut().zip(cos).zip(sin) {
                        *slope += down * cos + up * sin;
                    }
                }
                slope
            })
            .collect();
        (points, slopes)
    }

    /// Returns how one coordinate of a marker changes with the forearm's turn and shift and with each parameter.
    fn row(
        &self,
        forearm: &Rigid,
        turned: DVec3,
        slopes: &[Vec<f64>],
        marker: usize,
        axis: usize,
        keep: usize,
    ) -> Vec<f64> {
        let mut row = vec![0.0; 6 + keep];
        for (k, unit) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
            row[k] = unit.cross(turned)[axis];
        }
        row[3 + axis] = 1.0;
        for (own, slope) in row[6..].iter_mut().zip(slopes) {
            let at = &slope[3 * marker..3 * marker + 3];
            *own = (forearm.rotation * DVec3::new(at[0], at[1], at[2]))[axis];
        }
        row
    }

    /// Returns the angles of a frame as the model reads them off visible markers; NaN if they cannot be read.
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

/// Fills what is missing of a row of angles with what the components say of the rest.
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
        let said = components.rebuild(&components.project(&own));
        for ((own, x), said) in own.iter_mut().zip(row).zip(said) {
            if !x.is_finite() {
                *own = said;
            }
        }
    }
    own
}

/// Returns the mean places of the markers of a rigid set: two rounds of fitting and averaging.
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

fn terms(angles: &[f64]) -> Vec<f64> {
    let mut row = Vec::with_capacity(TERMS);
    row.push(1.0);
    row.extend(angles.iter().map(|angle| angle.cos()));
    row.extend(angles.iter().map(|angle| angle.sin()));
    row
}

fn point(terms: &Matrix, input: &[f64], marker: usize) -> DVec3 {
    let mut at = DVec3::ZERO;
    for (term, value) in input.iter().enumerate() {
        let row = &terms.row(term)[3 * marker..3 * marker + 3];
        at += DVec3::new(row[0], row[1], row[2]) * *value;
    }
    at
}

/// Reads the angles off a frame in the space of the forearm; NaN if the markers for one are hidden.
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
        let way = (local[to]? - local[from]?).try_normalize()?;
        Some(DVec3::new(
            way.dot(axes[0]),
            way.dot(axes[1]),
            way.dot(axes[2]),
        ))
    };
    // Seen in the hand: forward is x, towards the thumb y, to the back z.
    let bend = |way: DVec3| (-way.z).atan2(way.x);
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
        if let Some(way) = along(THUMB + 2 * n, THUMB + 2 * n + 1) {
            row[19 + 2 * n] = way.y.atan2(way.x);
            row[20 + 2 * n] = way.z.clamp(-1.0, 1.0).asin();
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

/// Returns an angle from −90 to 270 degrees: fingers bend one way.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, TAU};
    (angle + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2
}
