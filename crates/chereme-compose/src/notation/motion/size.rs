//! Sizes of motions, numbers of turns, and directions across a path.

use std::f64::consts::TAU;

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::{Amount, Circular, Growth, Motion, MotionKind, Size, WristMotion};

/// Returns whether a motion repeats by continuing: circles, wrist movements, playing fingers.
pub(super) fn is_round(motion: &Motion) -> bool {
    match &motion.kind {
        MotionKind::Circular(circular) => {
            circular.growth.is_none() && (turns(circular).fract() < 1e-9)
        }
        MotionKind::Wrist { .. } | MotionKind::FingerPlay(_) => true,
        MotionKind::Parallel(all) => all.iter().all(is_round),
        _ => false,
    }
}

/// Returns the number of turns of a circle.
pub(super) fn turns(circular: &Circular) -> f64 {
    let clock = &circular.clock;
    let full = f64::from(clock.full);
    match (clock.start, clock.end) {
        (Some(start), Some(end)) if start != end => {
            // About forward, the right-hand rule leads from down over left.
            let part = (start.angle() - end.angle()).rem_euclid(TAU) / TAU;
            full + part
        }
        _ => full + 1.0,
    }
}

pub(super) fn amount(amount: &Amount, sizes: [f64; 3]) -> f64 {
    let first = sized(amount.first, sizes);
    amount
        .second
        .map_or(first, |second| (first + sized(Some(second), sizes)) / 2.0)
}

pub(super) fn sized(size: Option<Size>, [small, normal, big]: [f64; 3]) -> f64 {
    match size {
        Some(Size::Small) => small,
        None => normal,
        Some(Size::Big) => big,
    }
}

pub(super) fn grown(growth: Option<Growth>, by: f64) -> f64 {
    match growth {
        Some(Growth {
            increasing: true, ..
        }) => 1.0 + by,
        Some(_) => 1.0 / (1.0 + by),
        None => 1.0,
    }
}

/// Returns a direction across a path: level, or to the left of an upright one.
pub(super) fn across(direction: DVec3) -> DVec3 {
    if direction.y.abs() > 0.9 {
        DVec3::X
    } else {
        DVec3::Y.cross(direction).normalize_or(DVec3::X)
    }
}

pub(super) fn wrist_name(motion: WristMotion) -> &'static str {
    match motion {
        WristMotion::Nodding => "nodding",
        WristMotion::Swinging => "swinging",
        WristMotion::Twisting => "twisting",
        WristMotion::StirCw => "stirring clockwise",
        WristMotion::StirCcw => "stirring counter-clockwise",
    }
}
