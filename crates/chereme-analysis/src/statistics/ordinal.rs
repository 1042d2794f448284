//! The cumulative link model: answers on an ordered scale explained by conditions and items.
//!
//! logit P(Y <= k) = θ_k - xβ: a positive β moves answers up. Its logarithmic likelihood is concave (Pratt 1981), so
//! Newton's method with halved steps finds the one maximum, or none exists. Source: McCullagh 1980.

use serde::{Deserialize, Serialize};

use super::{UndefinedStatistic, normal_tail_share};
use crate::cue::linear::DenseMatrix;

/// The most steps of Newton's method; convergence takes about six.
const MAX_NEWTON_STEPS: usize = 60;
/// The standard error, times the range of its column, from which an estimate counts as infinite.
const INFINITE_ESTIMATE_ERROR: f64 = 50.0;
/// The most numbers that a model estimates.
const MAX_MODEL_NUMBERS: usize = 200;

/// A fitted model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OrdinalModel {
    /// The answers that occur, in order; `thresholds` lie between them.
    pub levels: Vec<i64>,
    /// θ: one less than levels.
    pub thresholds: Vec<f64>,
    /// β, one for each column.
    pub coefficients: Vec<OrdinalCoefficient>,
    /// The logarithm of the likelihood.
    pub log_likelihood: f64,
}

/// The estimate of one column.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OrdinalCoefficient {
    /// β: the change of the logarithmic odds of a higher answer for one unit of the column.
    pub estimate: f64,
    /// Its standard error, from the observed information.
    pub se: f64,
    /// The two-sided p of Wald's test.
    pub p: f64,
}

/// Fits a model with fixed effects: an answer and a row of columns for each observation.
///
/// # Errors
/// [`UndefinedStatistic::Unequal`]; [`UndefinedStatistic::NotANumber`]; [`UndefinedStatistic::NoSpread`] if all answers are equal;
/// [`UndefinedStatistic::TooMany`] for more than 200 estimates; [`UndefinedStatistic::Dependent`] if a column is constant or follows from
/// others; [`UndefinedStatistic::Separated`] if the columns separate the answers, so that an estimate would be infinite.
pub fn fit_ordinal_model(answers: &[i64], rows: &[Vec<f64>]) -> Result<OrdinalModel, UndefinedStatistic> {
    let width = rows.first().map_or(0, Vec::len);
    if answers.len() != rows.len() || rows.iter().any(|row| row.len() != width) {
        return Err(UndefinedStatistic::Unequal);
    }
    if rows.iter().flatten().any(|x| !x.is_finite()) {
        return Err(UndefinedStatistic::NotANumber);
    }
    let mut levels = answers.to_vec();
    levels.sort_unstable();
    levels.dedup();
    let cuts = levels.len().saturating_sub(1);
    if cuts == 0 {
        return Err(UndefinedStatistic::NoSpread);
    }
    if cuts + width > MAX_MODEL_NUMBERS {
        return Err(UndefinedStatistic::TooMany);
    }
    let places = answers
        .iter()
        .map(|answer| levels.partition_point(|level| level < answer));
    let data = OrdinalData {
        places: places.collect(),
        rows,
        cuts,
        width,
    };
    let optimum = data.maximum()?;
    let (thresholds, slopes) = optimum.point.split_at(cuts);
    let mut coefficients = Vec::with_capacity(width);
    for (column, estimate) in slopes.iter().enumerate() {
        let mut unit = vec![0.0; cuts + width];
        unit[cuts + column] = 1.0;
        let se = optimum.factor.solve_factored(&unit)[cuts + column].sqrt();
        let values = rows.iter().map(|row| row[column]);
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        if !se.is_finite() || se * (high - low) > INFINITE_ESTIMATE_ERROR {
            return Err(UndefinedStatistic::Separated);
        }
        coefficients.push(OrdinalCoefficient {
            estimate: *estimate,
            se,
            p: (2.0 * normal_tail_share((estimate / se).abs())).min(1.0),
        });
    }
    Ok(OrdinalModel {
        levels,
        thresholds: thresholds.to_vec(),
        coefficients,
        log_likelihood: optimum.likelihood,
    })
}

struct OrdinalData<'a> {
    /// The place of each answer among the levels.
    places: Vec<usize>,
    rows: &'a [Vec<f64>],
    cuts: usize,
    width: usize,
}

struct LikelihoodMaximum {
    /// Thresholds, then coefficients.
    point: Vec<f64>,
    /// The Cholesky factor of the observed information there.
    factor: DenseMatrix,
    likelihood: f64,
}

impl OrdinalData<'_> {
    fn maximum(&self) -> Result<LikelihoodMaximum, UndefinedStatistic> {
        let mut point = self.initial_ordinal_point();
        let mut likelihood = self.likelihood(&point);
        for step in 0..MAX_NEWTON_STEPS {
            let (gradient, information) = self.likelihood_derivatives(&point);
            let factor = information.cholesky_factor().ok_or(UndefinedStatistic::Separated);
            // At the start only dependent columns make the information singular; later separation does, too.
            if step == 0
                && !factor
                    .as_ref()
                    .is_ok_and(|decomposition| is_full(&information, decomposition))
            {
                return Err(UndefinedStatistic::Dependent);
            }
            let factor = factor?;
            let change = factor.solve_factored(&gradient);
            // Newton's decrement, which is in proportion to the gain that is left.
            let gain: f64 = change.iter().zip(&gradient).map(|(a, b)| a * b).sum();
            if gain < 1e-18 * (1.0 + likelihood.abs()) {
                return Ok(LikelihoodMaximum {
                    point,
                    factor,
                    likelihood,
                });
            }
            // A full step may go too far; it is halved until the likelihood does not fall.
            let (mut share, mut next) = (1.0, point.clone());
            loop {
                for ((own, from), by) in next.iter_mut().zip(&point).zip(&change) {
                    *own = from + share * by;
                }
                let value = self.likelihood(&next);
                if value >= likelihood - 1e-12 * likelihood.abs() {
                    likelihood = value;
                    break;
                }
                share /= 2.0;
                if share < 1e-9 {
                    return Err(UndefinedStatistic::Separated);
                }
            }
            point = next;
        }
        Err(UndefinedStatistic::Separated)
    }

    /// Returns thresholds at the logits of the pooled answers, and coefficients of 0.
    fn initial_ordinal_point(&self) -> Vec<f64> {
        let n = self.places.len() as f64;
        let logit = |cut: usize| {
            let below = self.places.iter().filter(|place| **place <= cut).count() as f64;
            (below / (n - below)).ln()
        };
        let mut point: Vec<f64> = (0..self.cuts).map(logit).collect();
        point.resize(self.cuts + self.width, 0.0);
        point
    }

    /// Returns the two thresholds around an answer, minus its linear predictor; infinite at the ends of the scale.
    fn answer_threshold_ends(&self, at: usize, point: &[f64]) -> [f64; 2] {
        let slopes = self.rows[at].iter().zip(&point[self.cuts..]);
        let shift: f64 = slopes.map(|(x, slope)| x * slope).sum();
        let place = self.places[at];
        let below = place.checked_sub(1).map_or(f64::NEG_INFINITY, |index| point[index]);
        let over = point[..self.cuts].get(place).copied().unwrap_or(f64::INFINITY);
        [below - shift, over - shift]
    }

    fn likelihood(&self, point: &[f64]) -> f64 {
        let each = (0..self.places.len()).map(|at| {
            let share = share_between(self.answer_threshold_ends(at, point));
            if share > 0.0 { share.ln() } else { f64::NEG_INFINITY }
        });
        each.sum()
    }

    /// Returns the gradient of the logarithmic likelihood, and the observed information (minus its second derivatives).
    fn likelihood_derivatives(&self, point: &[f64]) -> (Vec<f64>, DenseMatrix) {
        let size = self.cuts + self.width;
        let mut gradient = vec![0.0; size];
        let mut information = DenseMatrix::zero_matrix(size, size);
        for (at, place) in self.places.iter().enumerate() {
            let ends = self.answer_threshold_ends(at, point);
            // An answer that the model takes for impossible must not divide by zero.
            let share = share_between(ends).max(f64::MIN_POSITIVE);
            let [low, high] = ends.map(|x| logistic_density(x) / share);
            let [low_slope, high_slope] = ends.map(|x| density_slope(x) / share);
            let direction = |cut: Option<usize>| {
                let mut all = vec![0.0; size];
                if let Some(cut) = cut {
                    all[cut] = 1.0;
                }
                for (own, x) in all[self.cuts..].iter_mut().zip(&self.rows[at]) {
                    *own = -x;
                }
                all
            };
            let over = direction(Some(*place).filter(|cut| *cut < self.cuts));
            let below = direction(place.checked_sub(1));
            for ((own, over), below) in gradient.iter_mut().zip(&over).zip(&below) {
                *own += high * over - low * below;
            }
            information.add_outer(&over, &over, high * high - high_slope);
            information.add_outer(&below, &below, low * low + low_slope);
            information.add_outer(&over, &below, -high * low);
            information.add_outer(&below, &over, -high * low);
        }
        (gradient, information)
    }
}

/// Returns whether no column follows from earlier ones: whether each keeps some of its own information beside them.
fn is_full(information: &DenseMatrix, factor: &DenseMatrix) -> bool {
    let share = |at| factor[(at, at)].powi(2) / information[(at, at)];
    (0..information.matrix_row_count()).all(|at| share(at) > 1e-9)
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

/// Returns the share of the logistic distribution between two points; computed in the tail that is nearer.
fn share_between([low, high]: [f64; 2]) -> f64 {
    if low > 0.0 {
        logistic(-low) - logistic(-high)
    } else {
        logistic(high) - logistic(low)
    }
}

fn logistic_density(x: f64) -> f64 {
    logistic(x) * logistic(-x)
}

fn density_slope(x: f64) -> f64 {
    logistic_density(x) * (logistic(-x) - logistic(x))
}
