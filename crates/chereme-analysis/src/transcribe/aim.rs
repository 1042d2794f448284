//! Directions: where the hand's axis points, and where its palm faces about that axis.

use std::f64::consts::FRAC_PI_4;

use chereme_sign::hamnosys::{Aim, Compass, Direction, Frame, orientation};
use glam::{DQuat, DVec3};

use super::Found;

/// By how much half-way between two directions must be nearer than one of them, in radians.
const PLAIN: f64 = 0.035;
/// Two directions may be joined that are at most so far apart, in radians: a right angle.
const APART: f64 = 1.58;

/// Returns the unit vector of an aim: left, up, forward.
pub(super) fn vector(aim: &Aim<Direction>) -> DVec3 {
    let of = |direction: Direction| DVec3::from(direction.vector());
    match aim.second {
        None => of(aim.first),
        Some(second) => (of(aim.first) + of(second)).normalize_or(of(aim.first)),
    }
}

/// Returns an angle from -π to π.
pub(super) fn wrapped(angle: f64) -> f64 {
    (angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

/// Returns the shortest turn from pointing out to a direction; to pointing in it goes over up.
pub(super) fn from_out(direction: DVec3) -> DQuat {
    if direction.z < -1.0 + 1e-9 {
        return DQuat::from_rotation_x(std::f64::consts::PI);
    }
    DQuat::from_rotation_arc(DVec3::Z, direction)
}

/// Returns the direction nearest to a unit vector (left, up, forward): one of the 26, or half-way
/// between two that have symbols and are neighbours. Residuals are in degrees.
pub(super) fn nearest(direction: DVec3, between: bool) -> Found<Aim<Direction>> {
    let mut found: Vec<(Aim<Direction>, f64, f64)> = Direction::all()
        .map(|d| {
            let off = DVec3::from(d.vector()).angle_between(direction);
            (Aim::at(d), off, off)
        })
        .collect();
    if between {
        let mut near = found.clone();
        near.retain(|(aim, ..)| aim.first.has_symbol());
        for (n, (a, off_a, _)) in near.iter().enumerate() {
            for (b, off_b, _) in &near[n + 1..] {
                let (va, vb) = (vector(a), vector(b));
                if va.angle_between(vb) > APART {
                    continue;
                }
                let (first, second) = if off_a <= off_b { (a, b) } else { (b, a) };
                let aim = Aim {
                    first: first.first,
                    second: Some(second.first),
                    approx: false,
                    frame: Frame::Plain,
                };
                let off = vector(&aim).angle_between(direction);
                // Those next to each other say the same more plainly.
                let wide = va.angle_between(vb) / APART;
                found.push((aim, off, off + PLAIN * (1.0 + wide)));
            }
        }
    }
    Found::of(found).degrees()
}

/// Returns the palm's direction: the angle about the hand's axis, as
/// [`orientation`](chereme_sign::hamnosys::orientation) counts it. Residuals are in degrees.
///
/// `along` and `normal` are as measured; `aim` is what the axis was told to be.
pub(super) fn palm(
    along: DVec3,
    normal: DVec3,
    aim: &Aim<Direction>,
    between: bool,
) -> Found<Aim<Compass>> {
    let told = vector(aim);
    let onto = DQuat::from_rotation_arc(along, told);
    let angle_of = orientation::palm_angle(told.to_array(), (onto * normal).to_array());
    let off = |angle: f64| wrapped(angle_of - angle).abs();
    let mut found: Vec<(Aim<Compass>, f64, f64)> = Compass::ALL
        .iter()
        .map(|&palm| (Aim::at(palm), off(palm.angle()), off(palm.angle())))
        .collect();
    if between {
        for (n, &first) in Compass::ALL.iter().enumerate() {
            let next = Compass::ALL[(n + 1) % 8];
            let off = off(first.angle() + FRAC_PI_4 / 2.0);
            let (first, second) =
                if matches!(first, Compass::D | Compass::R | Compass::U | Compass::L) {
                    (first, next)
                } else {
                    (next, first)
                };
            let aim = Aim {
                second: Some(second),
                ..Aim::at(first)
            };
            found.push((aim, off, off + PLAIN));
        }
    }
    Found::of(found).degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_with_a_symbol_and_its_neighbours_are_found_again() {
        let all: Vec<Direction> = Direction::all().collect();
        for &a in &all {
            let found = nearest(a.vector().into(), true);
            assert_eq!(found.best, Aim::at(a));
            assert!(found.residual < 1e-6);
            for &b in all.iter().filter(|b| a.has_symbol() && b.has_symbol()) {
                let aim = Aim {
                    second: Some(b),
                    ..Aim::at(a)
                };
                let apart = DVec3::from(a.vector()).angle_between(b.vector().into());
                if (0.1..1.06).contains(&apart) {
                    let found = nearest(vector(&aim), true).best;
                    let apart = vector(&found).angle_between(vector(&aim));
                    assert!(apart < 1e-6, "{a} {b}: {apart}");
                }
            }
        }
    }

    #[test]
    fn palms_are_found_again_for_every_axis_also_a_little_off() {
        let tilt = DQuat::from_euler(glam::EulerRot::XYZ, 0.05, -0.06, 0.04);
        for direction in Direction::all() {
            for palm_of in Compass::ALL {
                let along = DVec3::from(direction.vector());
                let normal = orientation::palm(along.to_array(), palm_of.angle());
                let aim = Aim::at(direction);
                let found = palm(tilt * along, tilt * DVec3::from(normal), &aim, false);
                assert_eq!(found.best, Aim::at(palm_of), "{direction} {palm_of}");
                assert!(found.residual < 8.0);
            }
        }
        // The palm of a hand that points up with `d` faces away from the signer.
        let out = palm(DVec3::Y, DVec3::Z, &Aim::at(Direction::UP), true);
        assert_eq!(out.best, Aim::at(Compass::D));
    }
}
