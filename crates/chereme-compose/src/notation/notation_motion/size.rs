//! Sizes of motions, numbers of turns, and directions across a path.

use std::f64::consts::TAU;

use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::{
    CircularPath, MotionGrowth, MotionKind, MotionSize, NotatedMotion, SizeAmount, WristMotion,
};

/// Returns whether a motion repeats by continuing: circles, wrist movements, playing fingers.
pub(super) fn is_round(motion: &NotatedMotion) -> bool {
    match &motion.kind {
        MotionKind::Circular(circular) => circular.growth.is_none() && (circle_turn_count(circular).fract() < 1e-9),
        MotionKind::Wrist { .. } | MotionKind::FingerPlay(_) => true,
        MotionKind::Parallel(all) => all.iter().all(is_round),
        _ => false,
    }
}

/// Returns the number of turns of a circle.
pub(super) fn circle_turn_count(circular: &CircularPath) -> f64 {
    let clock = &circular.clock;
    let full = f64::from(clock.full);
    match (clock.start, clock.end) {
        (Some(start), Some(end)) if start != end => {
            // About forward, the right-hand rule leads from down over left.
            let part = (start.compass_angle() - end.compass_angle()).rem_euclid(TAU) / TAU;
            full + part
        }
        _ => full + 1.0,
    }
}

pub(super) fn amount_from_sizes(amount: &SizeAmount, sizes: [f64; 3]) -> f64 {
    let first = length_for_size(amount.first, sizes);
    amount
        .second
        .map_or(first, |second| (first + length_for_size(Some(second), sizes)) / 2.0)
}

pub(super) fn length_for_size(size: Option<MotionSize>, [small, normal, big]: [f64; 3]) -> f64 {
    match size {
        Some(MotionSize::Small) => small,
        None => normal,
        Some(MotionSize::Big) => big,
    }
}

pub(super) fn grow_length(growth: Option<MotionGrowth>, by: f64) -> f64 {
    match growth {
        Some(MotionGrowth { increasing: true, .. }) => 1.0 + by,
        Some(_) => 1.0 / (1.0 + by),
        None => 1.0,
    }
}

/// Returns a direction across a path: level, or to the left of an upright one.
pub(super) fn direction_across_path(direction: DVec3) -> DVec3 {
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
