//! Recognisers with one Gaussian for each class, and their confusion tables.

use super::ModelError;
use super::linear::DenseMatrix;
use super::pca::row_covariance;

/// A recogniser with one Gaussian for each class.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianRecogniser {
    classes: Vec<GaussianClass>,
}

#[derive(Debug, Clone, PartialEq)]
struct GaussianClass {
    number: u8,
    mean: Vec<f64>,
    factor: DenseMatrix,
    log_norm: f64,
}

/// The fewest examples for which a class gets a covariance of its own; other classes share one.
const MIN_OWN_COVARIANCE_EXAMPLES: usize = 20;

impl GaussianRecogniser {
    /// Learns a Gaussian for each class that has an example; `floor` is added to every variance.
    ///
    /// # Errors
    /// [`ModelError`] if there are fewer than two examples, or their rows differ in length.
    pub fn learn_gaussian_classes(examples: &[(u8, Vec<f64>)], floor: f64) -> Result<Self, ModelError> {
        let width = examples.first().map_or(0, |(_, row)| row.len());
        let legal = |row: &Vec<f64>| row.len() == width && row.iter().all(|x| x.is_finite());
        if examples.len() < 2 || width == 0 || !examples.iter().all(|(_, row)| legal(row)) {
            return Err(ModelError::FewFrames {
                found: examples.len(),
                least: 2,
            });
        }
        let mut numbers: Vec<u8> = examples.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let of = |number: u8| -> Vec<Vec<f64>> {
            let class_examples = examples.iter().filter(|(own, _)| *own == number);
            class_examples.map(|(_, row)| row.clone()).collect()
        };
        let mut pooled = DenseMatrix::zero_matrix(width, width);
        let each: Vec<_> = numbers
            .iter()
            .map(|number| (*number, of(*number)))
            .map(|(number, rows)| (number, rows.len(), row_covariance(&rows)))
            .collect();
        for (_, count, (_, matrix)) in &each {
            let share = *count as f64 / examples.len() as f64;
            for i in 0..width {
                for j in 0..width {
                    pooled[(i, j)] += share * matrix[(i, j)];
                }
            }
        }
        let mut classes = Vec::with_capacity(each.len());
        for (number, count, (mean, matrix)) in each {
            let mut class_covariance = if count >= MIN_OWN_COVARIANCE_EXAMPLES {
                matrix
            } else {
                pooled.clone()
            };
            for i in 0..width {
                class_covariance[(i, i)] += floor;
            }
            let factor = class_covariance.cholesky_factor().ok_or(ModelError::Singular)?;
            let log_norm = (0..width).map(|i| factor[(i, i)].ln()).sum::<f64>();
            classes.push(GaussianClass {
                number,
                mean,
                factor,
                log_norm,
            });
        }
        Ok(Self { classes })
    }

    /// Returns the logarithm of the posterior probability of each class, with equal priors, in order of their numbers.
    #[must_use]
    pub fn class_log_posteriors(&self, row: &[f64]) -> Vec<(u8, f64)> {
        let score = |class: &GaussianClass| {
            let apart: Vec<f64> = row.iter().zip(&class.mean).map(|(x, m)| x - m).collect();
            let solved = class.factor.solve_factored(&apart);
            let distance: f64 = apart.iter().zip(&solved).map(|(a, s)| a * s).sum();
            -0.5 * distance - class.log_norm
        };
        let scores: Vec<f64> = self.classes.iter().map(score).collect();
        let most = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum = scores.iter().map(|s| (s - most).exp()).sum::<f64>().ln() + most;
        let numbers = self.classes.iter().map(|class| class.number);
        numbers.zip(scores).map(|(n, s)| (n, s - sum)).collect()
    }

    /// Returns the most probable class; in a tie that with the lower number.
    #[must_use]
    pub fn most_probable_class(&self, row: &[f64]) -> u8 {
        let all = self.class_log_posteriors(row).into_iter();
        all.reduce(|best, next| if next.1 > best.1 { next } else { best })
            .map_or(0, |(number, _)| number)
    }

    /// Returns the logarithm of the probability of one class; minus infinity if it was never learned.
    #[must_use]
    pub fn log_of(&self, row: &[f64], number: u8) -> f64 {
        let posterior = self
            .class_log_posteriors(row)
            .into_iter()
            .find(|(own, _)| *own == number);
        posterior.map_or(f64::NEG_INFINITY, |(_, log)| log)
    }
}

/// Confusion table: how often each class was recognised as each.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecognitionConfusion {
    /// The number of examples by produced and recognised class, in order.
    pub counts: std::collections::BTreeMap<(u8, u8), usize>,
}

impl RecognitionConfusion {
    /// Recognises examples and counts the results.
    #[must_use]
    pub fn count_confusions(recogniser: &GaussianRecogniser, examples: &[(u8, Vec<f64>)]) -> Self {
        let mut confusion = Self::default();
        for (number, row) in examples {
            *confusion
                .counts
                .entry((*number, recogniser.most_probable_class(row)))
                .or_default() += 1;
        }
        confusion
    }

    /// Returns the share of correct recognitions.
    #[must_use]
    pub fn correct_recognition_rate(&self) -> f64 {
        let all: usize = self.counts.values().sum();
        let right: usize = self.counts.iter().filter(|((a, b), _)| a == b).map(|(_, n)| n).sum();
        right as f64 / all.max(1) as f64
    }
}

impl std::fmt::Display for RecognitionConfusion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut classes: Vec<u8> = self.counts.keys().flat_map(|(a, b)| [*a, *b]).collect();
        classes.sort_unstable();
        classes.dedup();
        write!(f, "     ")?;
        classes.iter().try_for_each(|class| write!(f, "{class:>6}"))?;
        for own in &classes {
            write!(f, "\n{own:>5}")?;
            for other in &classes {
                let count = self.counts.get(&(*own, *other)).copied().unwrap_or(0);
                write!(f, "{count:>6}")?;
            }
        }
        Ok(())
    }
}
