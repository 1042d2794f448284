//! The rigid motion that carries one set of points onto another.

use glam::{DMat3, DQuat, DVec3};

use super::linear::{DenseMatrix, symmetric_eigenvectors};

/// A rotation and a translation: `x` is moved to `rotation · x + translation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// The rotation.
    pub rotation: DQuat,
    /// The translation, in the unit of the points.
    pub translation: DVec3,
}

impl Default for RigidMotion {
    fn default() -> Self {
        Self {
            rotation: DQuat::IDENTITY,
            translation: DVec3::ZERO,
        }
    }
}

/// The reason why no motion can be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum RigidError {
    /// Fewer than three points are visible.
    #[error("{0} points are seen; a rigid motion needs 3")]
    Few(usize),
    /// All points lie on one line, or coincide.
    #[error("the points lie on one line: their turn about it is unknown")]
    Line,
}

impl RigidMotion {
    /// Returns the moved position of a point.
    #[must_use]
    pub fn apply_rigid_motion(&self, x: DVec3) -> DVec3 {
        self.rotation * x + self.translation
    }

    /// Returns the original position of a moved point.
    #[must_use]
    pub fn undo_rigid_motion(&self, x: DVec3) -> DVec3 {
        self.rotation.inverse() * (x - self.translation)
    }

    /// Returns the motion that brings `from` nearest to `to` by least squares; hidden points are ignored.
    ///
    /// Uses Horn's method: the rotation is the eigenvector of the greatest eigenvalue of a 4 × 4 matrix, so that it is
    /// never a reflection.
    ///
    /// # Errors
    /// [`RigidError`] if fewer than three points are visible, or all of them lie on one line.
    pub fn fit_rigid_motion(from: &[DVec3], to: &[Option<DVec3>]) -> Result<Self, RigidError> {
        let seen: Vec<(DVec3, DVec3)> = from
            .iter()
            .zip(to)
            .filter_map(|(from, to)| Some((*from, to.filter(|to| to.is_finite())?)))
            .collect();
        if seen.len() < 3 {
            return Err(RigidError::Few(seen.len()));
        }
        let count = seen.len() as f64;
        let middle = |of: fn(&(DVec3, DVec3)) -> DVec3| seen.iter().map(of).sum::<DVec3>() / count;
        let (a, b) = (middle(|pair| pair.0), middle(|pair| pair.1));
        let mut covariance = DMat3::ZERO;
        let mut s = [[0.0; 3]; 3];
        for (from, to) in &seen {
            let (x, y) = (*from - a, *to - b);
            covariance += DMat3::from_cols(x * x.x, x * x.y, x * x.z);
            for (i, row) in s.iter_mut().enumerate() {
                for (j, value) in row.iter_mut().enumerate() {
                    *value += x[i] * y[j];
                }
            }
        }
        // About a line any rotation fits as well as any other.
        if is_line(&covariance) {
            return Err(RigidError::Line);
        }
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = s;
        let horn = [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, yy - xx - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, zz - xx - yy],
        ];
        let mut matrix = DenseMatrix::zero_matrix(4, 4);
        for (i, row) in horn.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                matrix[(i, j)] = *value;
            }
        }
        let (_, vectors) = symmetric_eigenvectors(&matrix);
        let q = vectors.matrix_row(0);
        // A quaternion and its negative rotate alike; the one with a positive real part has the smaller angle;
        // callers take shares of it.
        let sign = if q[0] < 0.0 { -1.0 } else { 1.0 };
        let raw_rotation = DQuat::from_xyzw(q[1] * sign, q[2] * sign, q[3] * sign, q[0] * sign);
        let rotation = raw_rotation.normalize();
        Ok(Self {
            rotation,
            translation: b - rotation * a,
        })
    }
}

/// Returns whether points with this scatter lie on one line: the second eigenvalue is nearly zero.
fn is_line(scatter: &DMat3) -> bool {
    let mut matrix = DenseMatrix::zero_matrix(3, 3);
    for i in 0..3 {
        for j in 0..3 {
            matrix[(i, j)] = scatter.col(j)[i];
        }
    }
    let (values, _) = symmetric_eigenvectors(&matrix);
    values[1] <= 1e-9 * values[0] || values[0] <= 0.0
}
