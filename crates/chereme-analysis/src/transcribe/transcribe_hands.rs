//! Relation of the two hands: one alone, both alike by a symmetry, or each for itself.

use std::ops::RangeInclusive;

use chereme_sign::hamnosys::{HandSymmetry, SpatialDirection, orientation};
use glam::{DQuat, DVec3};

use super::transcribe_scene::{HandTrajectory, SignerScene};
use crate::transcribe::transcribe_tuned::tuned;

/// The relation of the other hand to the dominant one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HandRelation {
    pub(super) kind: RelationKind,
    /// The part of the movement that the relation does not explain, as a share of the whole.
    pub(super) residual: f64,
    /// The second best relation, with its residual.
    pub(super) runner_up: Option<(RelationKind, f64)>,
}

/// The kinds of relations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum RelationKind {
    /// The other hand rests.
    Alone,
    /// The other hand follows by a symmetry.
    Alike(HandSymmetry),
    /// The other hand is held, or moves for itself.
    Unlike { moves: bool },
}

impl RelationKind {
    /// Returns a short description.
    pub(super) fn describe_relation(&self) -> String {
        match self {
            Self::Alone => "one hand".to_owned(),
            Self::Unlike { moves: false } => "the other is held".to_owned(),
            Self::Unlike { moves: true } => "each for itself".to_owned(),
            Self::Alike(symmetry) => {
                let marks = [
                    (symmetry.left_right, "left-right"),
                    (symmetry.up_down, "up-down"),
                    (symmetry.out_in, "out-in"),
                ];
                let mut words: Vec<&str> = marks.iter().filter_map(|(is, word)| is.then_some(*word)).collect();
                if words.is_empty() {
                    words.push("parallel");
                }
                if symmetry.out_of_phase {
                    words.push("alternating");
                }
                words.join(" ")
            }
        }
    }
}

/// Returns the factors (1 or -1) that a symmetry applies to left, up and forward.
pub(super) fn symmetry_axis_signs(symmetry: &HandSymmetry) -> DVec3 {
    let sign = |mirrored: bool| if mirrored { -1.0 } else { 1.0 };
    DVec3::new(sign(symmetry.left_right), sign(symmetry.up_down), sign(symmetry.out_in))
}

/// Returns the directions of fingers and palm that the other hand takes by a symmetry. Hands that do not mirror each other
/// from left to right mirror the palm's letter, which counts for fingers in the direction `written`.
pub(super) fn symmetric_hand_orientation(
    written: DVec3,
    [along, normal]: [DVec3; 2],
    symmetry: &HandSymmetry,
) -> [DVec3; 2] {
    let signs = symmetry_axis_signs(symmetry);
    let palm_signs = signs.with_x(-1.0);
    let facing = DQuat::from_rotation_arc(along, written) * normal;
    let angle = orientation::palm_angle(written.into(), facing.into());
    let in_palm_frame = written * signs * palm_signs;
    let palm = DVec3::from(orientation::palm_direction_vector(in_palm_frame.into(), angle)) * palm_signs;
    let led = along * signs;
    [led, DQuat::from_rotation_arc(written * signs, led) * palm]
}

/// The candidate symmetries, the more common first.
fn symmetries() -> impl Iterator<Item = HandSymmetry> {
    let of = |left_right, up_down, out_in| HandSymmetry {
        left_right,
        up_down,
        out_in,
        ..HandSymmetry::default()
    };
    [
        of(true, false, false),
        of(false, false, false),
        of(true, true, false),
        of(true, false, true),
        of(true, true, true),
        of(false, true, false),
        of(false, false, true),
    ]
    .into_iter()
    .flat_map(|plain| {
        let behind = HandSymmetry {
            out_of_phase: true,
            ..plain
        };
        [plain, behind]
    })
}

/// Returns the index of the hand that signs if only one does: 1, the other one, if the dominant arm is
/// missing or rests all the time; 0 otherwise.
pub(super) fn leading_hand_index(scene: &SignerScene<'_>) -> usize {
    let rests = scene.hands.each_ref().map(|track| {
        let track = track.as_ref();
        track.is_none_or(|track| track.rests.iter().all(|rests| *rests))
    });
    usize::from(scene.hands[0].is_none() || rests == [true, false])
}

/// Returns the relation of the other hand to the dominant one in a stretch of frames.
pub(super) fn find_hand_relation(scene: &SignerScene<'_>, frames: &RangeInclusive<usize>) -> HandRelation {
    let alone = HandRelation {
        kind: RelationKind::Alone,
        residual: 0.0,
        runner_up: None,
    };
    let [Some(dominant), Some(other)] = &scene.hands else {
        return alone;
    };
    if leading_hand_index(scene) == 1 {
        return alone;
    }
    let (first, last) = (*frames.start(), *frames.end());
    let middle = first + (last - first) / 2;
    let still = |track: &HandTrajectory| {
        let mut positions = track.palm[first..=last].iter();
        positions.all(|at| at.distance(track.palm[first]) < tuned().hands.stays * scene.arm)
    };
    let lies = still(other) && other.palm[middle].y < tuned().cuts.lap * scene.arm;
    let resting = [first, middle, last]
        .iter()
        .filter(|&&frame| other.rests[frame])
        .count();
    // One of the three frames may lie on the way from rest or to it.
    if resting >= 2 || (lies && !still(dominant)) {
        return alone;
    }
    let stays = [dominant, other].map(still);
    let mut best: Vec<(HandSymmetry, f64)> = symmetries()
        .filter_map(|symmetry| {
            // A hand that moves beside one that stays has no symmetry with it.
            let off = if stays == [true, true] {
                held_alike(scene, [dominant, other], first, &symmetry)
            } else if stays[0] == stays[1] {
                moved_alike([dominant, other], first, last, &symmetry)
            } else {
                None
            };
            Some((symmetry, off?))
        })
        .collect();
    best.sort_by(|a, b| a.1.total_cmp(&b.1));
    let unlike = RelationKind::Unlike { moves: !stays[1] };
    match best.first() {
        Some(&(symmetry, off)) if off < tuned().hands.alike => HandRelation {
            kind: RelationKind::Alike(symmetry),
            residual: off,
            runner_up: best.get(1).map(|&(symmetry, off)| (RelationKind::Alike(symmetry), off)),
        },
        other => HandRelation {
            kind: unlike,
            residual: 0.0,
            runner_up: other.map(|&(symmetry, off)| (RelationKind::Alike(symmetry), off)),
        },
    }
}

/// Returns the difference of two still hands from a symmetry; 0 if they mirror each other.
fn held_alike(
    scene: &SignerScene<'_>,
    [a, b]: [&HandTrajectory; 2],
    frame: usize,
    symmetry: &HandSymmetry,
) -> Option<f64> {
    if symmetry.out_of_phase || symmetry.up_down || symmetry.out_in {
        return None;
    }
    let off = posture_off([a, b], frame, symmetry)?;
    let place = a.palm[frame] * DVec3::new(-1.0, 1.0, 1.0);
    let apart = place.distance(b.palm[frame]) / (tuned().hands.placed * scene.arm);
    (apart < 1.0).then_some(off.max(0.25 * apart) + parallel_hands_penalty(symmetry))
}

/// Returns the difference of two postures from a symmetry; `None` if they are unlike.
fn posture_off([a, b]: [&HandTrajectory; 2], frame: usize, symmetry: &HandSymmetry) -> Option<f64> {
    let written = SpatialDirection::nearest_spatial_direction(a.along[frame].into())?;
    let orientation = [a.along[frame], a.normal[frame]];
    let expected = symmetric_hand_orientation(written.spatial_direction_vector().into(), orientation, symmetry);
    let along = expected[0].angle_between(b.along[frame]);
    let normal = expected[1].angle_between(b.normal[frame]);
    let shaped = a.known.known_angle_difference(&a.angles[frame], &b.angles[frame]);
    let off = (along / tuned().hands.points)
        .max(normal / tuned().hands.points)
        .max(shaped / tuned().hands.shaped);
    (off < 1.0).then_some(tuned().hands.alike * off)
}

/// Returns the difference of two hands' movements from a symmetry, as a share of them. If the movements
/// fit several symmetries, the postures decide.
fn moved_alike([a, b]: [&HandTrajectory; 2], first: usize, last: usize, symmetry: &HandSymmetry) -> Option<f64> {
    // Hands out of phase move oppositely at each moment.
    let signs = symmetry_axis_signs(symmetry) * if symmetry.out_of_phase { -1.0 } else { 1.0 };
    let (mut off, mut all) = (0.0, 0.0);
    for n in first..last {
        let (da, db) = (a.palm[n + 1] - a.palm[n], b.palm[n + 1] - b.palm[n]);
        off += (da * signs - db).length_squared();
        all += da.length_squared() + db.length_squared();
    }
    let off = off / all.max(1e-12);
    let posture = posture_off([a, b], first, symmetry).unwrap_or(tuned().hands.alike);
    // Of symmetries that fit the movements equally well, the simplest one that the postures have.
    let mark_flags = [symmetry.up_down, symmetry.out_in, symmetry.out_of_phase];
    let marks = mark_flags.iter().filter(|mark| **mark).count() as f64;
    Some(off + 0.1 * posture + 0.01 * marks + parallel_hands_penalty(symmetry))
}

/// Returns the penalty for hands that do not mirror each other; if both relations fit, mirroring is meant.
fn parallel_hands_penalty(symmetry: &HandSymmetry) -> f64 {
    if symmetry.left_right {
        0.0
    } else {
        tuned().hands.parallel
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::CompassDirection;

    #[test]
    fn parallel_hands_are_expected_with_the_mirrored_letter_of_the_palm() {
        for direction in SpatialDirection::all_spatial_directions() {
            let written = DVec3::from(direction.spatial_direction_vector());
            for palm in CompassDirection::ALL_COMPASS_DIRECTIONS {
                let facing = |palm: CompassDirection| {
                    DVec3::from(orientation::palm_direction_vector(written.into(), palm.compass_angle()))
                };
                let parallel = HandSymmetry::default();
                let [along, normal] = symmetric_hand_orientation(written, [written, facing(palm)], &parallel);
                assert!(along.distance(written) < 1e-9);
                let mirrored = facing(palm.mirrored_compass_direction());
                assert!(normal.distance(mirrored) < 1e-9, "{direction} {palm}: {normal}");
            }
        }
    }
}
