//! Rotation orders and angles, as motion files write them.

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

use crate::axes::SpaceAxis;

/// The order in which a joint's three angles are written and multiplied.
///
/// With the order abc and the angles α, β, γ the rotation is `A(α) · B(β) · C(γ)`: the axes rotate with the joint, and
/// the last written rotation is applied to a point first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct RotationOrder([SpaceAxis; 3]);

impl RotationOrder {
    /// The order that most exporters write.
    pub const ZXY_ORDER: Self = Self([SpaceAxis::Z, SpaceAxis::X, SpaceAxis::Y]);
    /// The order about Y, then X, then Z.
    pub const YXZ_ORDER: Self = Self([SpaceAxis::Y, SpaceAxis::X, SpaceAxis::Z]);
    /// The alphabetical order.
    pub const XYZ_ORDER: Self = Self([SpaceAxis::X, SpaceAxis::Y, SpaceAxis::Z]);

    /// Returns the order of three different axes; `None` if one occurs twice.
    #[must_use]
    pub fn new(axes: [SpaceAxis; 3]) -> Option<Self> {
        let [a, b, c] = axes;
        (a != b && b != c && a != c).then_some(Self(axes))
    }

    /// Returns the three axes as written.
    #[must_use]
    pub fn rotation_axes(self) -> [SpaceAxis; 3] {
        self.0
    }

    /// Returns the rotation of the three angles in radians.
    #[must_use]
    pub fn to_quat(self, angles: [f64; 3]) -> DQuat {
        let [a, b, c] = self.0;
        a.axis_rotation(angles[0]) * b.axis_rotation(angles[1]) * c.axis_rotation(angles[2])
    }

    /// Returns the three angles in radians whose rotation is `q`.
    ///
    /// There are two such triples, each up to whole turns. Returns the one nearest to `near`, so that a path of
    /// rotations gives a path of angles without jumps. If the middle angle is a right angle (gimbal lock), the first
    /// angle keeps the value of `near`.
    #[must_use]
    pub fn nearest_euler_angles(self, q: DQuat, near: [f64; 3]) -> [f64; 3] {
        let [i, j, k] = self.0.map(SpaceAxis::index);
        // An order against the cycle X, Y, Z flips the sign of the sine terms.
        let odd = (i + 1) % 3 != j;
        let sign = if odd { -1.0 } else { 1.0 };
        let m = DMat3::from_quat(q.normalize());
        let matrix_entry = |row: usize, col: usize| m.col(col)[row];
        // Rounding may push the sine beyond one.
        let sine = (sign * matrix_entry(i, k)).clamp(-1.0, 1.0);
        // At gimbal lock first and third angle turn about one axis, and only their sum is defined.
        if sine.abs() > 1.0 - 1e-12 {
            return self.locked(&m, sine, near);
        }
        let first = (-sign * matrix_entry(j, k)).atan2(matrix_entry(k, k));
        let third = (-sign * matrix_entry(i, j)).atan2(matrix_entry(i, i));
        // The second triple gives the same rotation with the middle joint turned over.
        let direct = [first, sine.asin(), third];
        let other = [first + PI, PI - direct[1], third + PI];
        let (direct, other) = (unwrap_euler_angles(direct, near), unwrap_euler_angles(other, near));
        if euler_angle_distance(direct, near) <= euler_angle_distance(other, near) {
            direct
        } else {
            other
        }
    }

    fn locked(self, m: &DMat3, sine: f64, near: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.0;
        let middle = sine.signum() * PI / 2.0;
        // Takes the first two rotations off; the rest turns about the third axis alone.
        let rest = b.axis_rotation(middle).inverse() * a.axis_rotation(near[0]).inverse();
        let left = (rest * DQuat::from_mat3(m)).normalize();
        let third = 2.0 * left.to_array()[c.index()].atan2(left.w);
        unwrap_euler_angles([near[0], middle, third], near)
    }
}

fn unwrap_euler_angles(angles: [f64; 3], near: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|n| angles[n] - ((angles[n] - near[n]) / TAU).round() * TAU)
}

fn euler_angle_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    DVec3::from(a).distance_squared(DVec3::from(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn orders() -> Vec<RotationOrder> {
        let axes = [SpaceAxis::X, SpaceAxis::Y, SpaceAxis::Z];
        let mut all = Vec::new();
        for a in axes {
            for b in axes {
                all.extend(axes.into_iter().filter_map(|c| RotationOrder::new([a, b, c])));
            }
        }
        all
    }

    #[test]
    fn there_are_six_orders_and_zxy_multiplies_left_to_right() {
        assert_eq!(orders().len(), 6);
        let q = RotationOrder::ZXY_ORDER.to_quat([0.3, -0.4, 0.9]);
        let m = DMat3::from_rotation_z(0.3) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_y(0.9);
        assert!(DMat3::from_quat(q).abs_diff_eq(m, 1e-12));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn angles_convert_back_to_their_rotation_and_stay_near_the_hint(angles in proptest::array::uniform3(-7.0f64..7.0)) {
            for order in orders() {
                let q = order.to_quat(angles);
                let same = order.nearest_euler_angles(q, angles);
                for n in 0..3 {
                    prop_assert!((same[n] - angles[n]).abs() < 1e-5, "{order:?} {angles:?} {same:?}");
                }
                let far = order.nearest_euler_angles(q, [0.0; 3]);
                prop_assert!(order.to_quat(far).angle_between(q) < 1e-7);
            }
        }

        #[test]
        fn gimbal_lock_keeps_the_first_angle(a in -3.0f64..3.0, c in -3.0f64..3.0, up in proptest::bool::ANY) {
            for order in orders() {
                let middle = if up { PI / 2.0 } else { -PI / 2.0 };
                let q = order.to_quat([a, middle, c]);
                let back = order.nearest_euler_angles(q, [0.5, 1.5, 0.0]);
                prop_assert!(order.to_quat(back).angle_between(q) < 2e-6, "{order:?}");
            }
        }
    }
}
