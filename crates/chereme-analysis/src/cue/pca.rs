//! Principal components: plain, with missing values, and guided by subsets of the numbers.

use super::ModelError;
use super::linear::{DenseMatrix, symmetric_eigenvectors};

/// A mean and the directions of greatest variance.
#[derive(Debug, Clone, PartialEq)]
pub struct PrincipalComponents {
    /// The mean of each number.
    pub mean: Vec<f64>,
    /// Unit vectors, the greatest variance first; the largest entry of each is positive.
    pub directions: Vec<Vec<f64>>,
    /// The variance along each direction.
    pub variances: Vec<f64>,
    /// The variance of all numbers together.
    pub total: f64,
}

impl PrincipalComponents {
    /// Finds the first `keep` components of rows of equal length; a NaN is a missing number.
    ///
    /// Missing numbers are filled with the mean, then with the values predicted by the components, in `rounds` rounds.
    ///
    /// # Errors
    /// [`ModelError`] if there are fewer than two rows, or a number is missing in all of them.
    pub fn fit_principal_components(rows: &[Vec<f64>], keep: usize, rounds: usize) -> Result<Self, ModelError> {
        let width = rows.first().map_or(0, Vec::len);
        if rows.len() < 2 || width == 0 || rows.iter().any(|row| row.len() != width) {
            return Err(ModelError::FewFrames {
                found: rows.len(),
                least: 2,
            });
        }
        let mut mean = vec![0.0; width];
        for (n, mean) in mean.iter_mut().enumerate() {
            let seen: Vec<f64> = rows.iter().map(|row| row[n]).filter(|x| x.is_finite()).collect();
            if seen.is_empty() {
                return Err(ModelError::NeverSeen(n));
            }
            *mean = seen.iter().sum::<f64>() / seen.len() as f64;
        }
        let is_complete = rows.iter().flatten().all(|x| x.is_finite());
        let mut filled: Vec<Vec<f64>> = rows
            .iter()
            .map(|row| {
                let numbers = row.iter().zip(&mean);
                numbers
                    .map(|(x, mean)| if x.is_finite() { *x } else { *mean })
                    .collect()
            })
            .collect();
        let mut model = Self::of_whole(&filled, keep);
        // Without missing numbers the first components are final.
        for _ in 0..if is_complete { 0 } else { rounds } {
            for (own, row) in filled.iter_mut().zip(rows) {
                let predicted = model.rebuild_component_row(&model.project_component_row(own));
                for ((own, row), predicted) in own.iter_mut().zip(row).zip(predicted) {
                    if !row.is_finite() {
                        *own = predicted;
                    }
                }
            }
            model = Self::of_whole(&filled, keep);
        }
        Ok(model)
    }

    fn of_whole(rows: &[Vec<f64>], keep: usize) -> Self {
        let (mean, covariance) = row_covariance(rows);
        let (values, vectors) = symmetric_eigenvectors(&covariance);
        let keep = keep.min(values.len());
        Self {
            total: values.iter().map(|value| value.max(0.0)).sum(),
            directions: (0..keep).map(|n| vectors.matrix_row(n).to_vec()).collect(),
            variances: values[..keep].iter().map(|value| value.max(0.0)).collect(),
            mean,
        }
    }

    /// Returns the coordinates of a row along each direction.
    #[must_use]
    pub fn project_component_row(&self, row: &[f64]) -> Vec<f64> {
        let along = |direction: &Vec<f64>| {
            let numbers = direction.iter().zip(row).zip(&self.mean);
            numbers.map(|((d, x), mean)| d * (x - mean)).sum()
        };
        self.directions.iter().map(along).collect()
    }

    /// Returns the row with these coordinates along the directions.
    #[must_use]
    pub fn rebuild_component_row(&self, parameters: &[f64]) -> Vec<f64> {
        let mut row = self.mean.clone();
        for (direction, parameter) in self.directions.iter().zip(parameters) {
            for (own, d) in row.iter_mut().zip(direction) {
                *own += d * parameter;
            }
        }
        row
    }
}

/// Returns the mean and the covariance of complete rows; the covariance is divided by their number.
#[must_use]
pub fn row_covariance(rows: &[Vec<f64>]) -> (Vec<f64>, DenseMatrix) {
    let width = rows.first().map_or(0, Vec::len);
    let count = rows.len().max(1) as f64;
    let mut mean = vec![0.0; width];
    for row in rows {
        for (mean, x) in mean.iter_mut().zip(row) {
            *mean += x / count;
        }
    }
    let mut matrix = DenseMatrix::zero_matrix(width, width);
    let mut centred = vec![0.0; width];
    for row in rows {
        for ((own, x), mean) in centred.iter_mut().zip(row).zip(&mean) {
            *own = x - mean;
        }
        matrix.add_outer(&centred, &centred, 1.0 / count);
    }
    (mean, matrix)
}

/// Components that are each led by a subset of the numbers, one after another (section 3.1 of the paper).
#[derive(Debug, Clone, PartialEq)]
pub struct GuidedComponents {
    /// The mean of each number.
    pub mean: Vec<f64>,
    /// The change of all numbers by one standard deviation of each predictor.
    pub directions: Vec<Vec<f64>>,
}

/// Finds guided components: each predictor is the first principal component of its subset of the residual, and its
/// contribution to all numbers is subtracted before the next.
///
/// # Errors
/// [`ModelError`] if there are fewer than two rows, or a subset contains an index that rows do not have.
pub fn find_guided_components(rows: &[Vec<f64>], subsets: &[Vec<usize>]) -> Result<GuidedComponents, ModelError> {
    let width = rows.first().map_or(0, Vec::len);
    if rows.len() < 2 || rows.iter().flatten().any(|x| !x.is_finite()) {
        return Err(ModelError::FewFrames {
            found: rows.len(),
            least: 2,
        });
    }
    if let Some(wrong) = subsets.iter().flatten().find(|n| **n >= width) {
        return Err(ModelError::NeverSeen(*wrong));
    }
    let (mean, _) = row_covariance(rows);
    let mut left: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| row.iter().zip(&mean).map(|(x, mean)| x - mean).collect())
        .collect();
    let mut directions = Vec::with_capacity(subsets.len());
    for subset in subsets {
        let part: Vec<Vec<f64>> = left
            .iter()
            .map(|row| subset.iter().map(|n| row[*n]).collect())
            .collect();
        let first = PrincipalComponents::of_whole(&part, 1);
        let mut p: Vec<f64> = part.iter().map(|row| first.project_component_row(row)[0]).collect();
        let sd = (p.iter().map(|x| x * x).sum::<f64>() / p.len() as f64).sqrt();
        // A subset without variance that is left leads nothing.
        if sd < 1e-12 {
            directions.push(vec![0.0; width]);
            continue;
        }
        p.iter_mut().for_each(|x| *x /= sd);
        let squares: f64 = p.iter().map(|x| x * x).sum();
        let mut b = vec![0.0; width];
        for (row, p) in left.iter().zip(&p) {
            for (b, x) in b.iter_mut().zip(row) {
                *b += p * x / squares;
            }
        }
        // The next predictors see only what this one leaves unexplained.
        for (row, p) in left.iter_mut().zip(&p) {
            for (x, b) in row.iter_mut().zip(&b) {
                *x -= p * b;
            }
        }
        directions.push(b);
    }
    Ok(GuidedComponents { mean, directions })
}
