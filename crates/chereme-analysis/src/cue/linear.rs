//! Small dense matrices for the models of face and hand.

use std::ops::{Index, IndexMut};

/// A matrix, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct DenseMatrix {
    rows: usize,
    cols: usize,
    data: Vec<f64>,
}

impl Index<(usize, usize)> for DenseMatrix {
    type Output = f64;
    fn index(&self, (row, col): (usize, usize)) -> &f64 {
        &self.data[row * self.cols + col]
    }
}

impl IndexMut<(usize, usize)> for DenseMatrix {
    fn index_mut(&mut self, (row, col): (usize, usize)) -> &mut f64 {
        &mut self.data[row * self.cols + col]
    }
}

impl DenseMatrix {
    /// Returns a matrix of zeros.
    #[must_use]
    pub fn zero_matrix(rows: usize, cols: usize) -> Self {
        Self {
            rows,
            cols,
            data: vec![0.0; rows * cols],
        }
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn matrix_row_count(&self) -> usize {
        self.rows
    }

    /// Returns a row.
    #[must_use]
    pub fn matrix_row(&self, row: usize) -> &[f64] {
        &self.data[row * self.cols..(row + 1) * self.cols]
    }

    /// Adds `weight · x yᵀ`; `x` has as many numbers as rows, `y` as columns.
    pub fn add_outer(&mut self, x: &[f64], y: &[f64], weight: f64) {
        for (row, x) in self.data.chunks_exact_mut(self.cols.max(1)).zip(x) {
            let factor = weight * x;
            // Rows with many zeros are common, and skipping them costs one comparison.
            if factor != 0.0 {
                for (own, y) in row.iter_mut().zip(y) {
                    *own += factor * y;
                }
            }
        }
    }

    /// Returns the lower triangle of the Cholesky factor; nothing if the matrix is not positive definite.
    #[must_use]
    pub fn cholesky_factor(&self) -> Option<Self> {
        let n = self.rows;
        let mut lower = Self::zero_matrix(n, n);
        for i in 0..n {
            for j in 0..=i {
                let below: f64 = (0..j).map(|k| lower[(i, k)] * lower[(j, k)]).sum();
                let value = self[(i, j)] - below;
                if i == j {
                    if value.is_nan() || value <= 0.0 {
                        return None;
                    }
                    lower[(i, i)] = value.sqrt();
                } else {
                    lower[(i, j)] = value / lower[(j, j)];
                }
            }
        }
        Some(lower)
    }

    /// Solves `L Lᵀ x = b` for a factor of [`cholesky_factor`](Self::cholesky_factor).
    #[must_use]
    pub fn solve_factored(&self, b: &[f64]) -> Vec<f64> {
        let n = self.rows;
        let mut x = b.to_vec();
        // Forwards with the lower triangle, then backwards with its transpose.
        for i in 0..n {
            let below: f64 = (0..i).map(|k| self[(i, k)] * x[k]).sum();
            x[i] = (x[i] - below) / self[(i, i)];
        }
        for i in (0..n).rev() {
            let above: f64 = (i + 1..n).map(|k| self[(k, i)] * x[k]).sum();
            x[i] = (x[i] - above) / self[(i, i)];
        }
        x
    }
}

/// Returns the eigenvalues of a symmetric matrix, greatest first, and their unit eigenvectors as rows.
///
/// Uses cyclic Jacobi rotations. The largest entry of each vector is positive; in a tie the first counts.
#[must_use]
pub fn symmetric_eigenvectors(symmetric: &DenseMatrix) -> (Vec<f64>, DenseMatrix) {
    let n = symmetric.rows;
    let mut a = symmetric.clone();
    let mut v = DenseMatrix::zero_matrix(n, n);
    for i in 0..n {
        v[(i, i)] = 1.0;
    }
    const MAX_JACOBI_SWEEPS: usize = 40;
    for _ in 0..MAX_JACOBI_SWEEPS {
        let off: f64 = (0..n)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|at| a[at] * a[at])
            .sum();
        let size: f64 = (0..n).map(|i| a[(i, i)] * a[(i, i)]).sum();
        // NaNs would never converge.
        if off.is_nan() || off <= 1e-24 * size {
            break;
        }
        for p in 0..n {
            for q in p + 1..n {
                rotate(&mut a, &mut v, p, q);
            }
        }
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|x, y| a[(*y, *y)].total_cmp(&a[(*x, *x)]).then(x.cmp(y)));
    let mut vectors = DenseMatrix::zero_matrix(n, n);
    let mut values = Vec::with_capacity(n);
    for (row, own) in order.into_iter().enumerate() {
        values.push(a[(own, own)]);
        let largest = v.matrix_row(own).iter().copied().fold(
            0.0,
            |most: f64, x| {
                if x.abs() > most.abs() + 1e-12 { x } else { most }
            },
        );
        let sign = if largest < 0.0 { -1.0 } else { 1.0 };
        for col in 0..n {
            vectors[(row, col)] = sign * v[(own, col)];
        }
    }
    (values, vectors)
}

/// Rotates rows and columns `p` and `q` so that their off-diagonal entry vanishes; the rows of `v` are rotated too.
fn rotate(a: &mut DenseMatrix, v: &mut DenseMatrix, p: usize, q: usize) {
    // A Jacobi rotation; below this the division would overflow.
    let mixed = a[(p, q)];
    if mixed.abs() < 1e-300 {
        return;
    }
    let theta = (a[(q, q)] - a[(p, p)]) / (2.0 * mixed);
    let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    // Equal diagonal entries take a turn of 45 degrees, where `signum` of -0 would turn the other way.
    let t = if theta == 0.0 { 1.0 } else { tangent };
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    let n = a.rows;
    for k in 0..n {
        let (x, y) = (a[(k, p)], a[(k, q)]);
        a[(k, p)] = c * x - s * y;
        a[(k, q)] = s * x + c * y;
    }
    for k in 0..n {
        let (x, y) = (a[(p, k)], a[(q, k)]);
        a[(p, k)] = c * x - s * y;
        a[(q, k)] = s * x + c * y;
        let (x, y) = (v[(p, k)], v[(q, k)]);
        v[(p, k)] = c * x - s * y;
        v[(q, k)] = s * x + c * y;
    }
}
