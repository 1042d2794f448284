//! Recordings that show the movement of another one unchanged: byte-equal copies, and results of recipes that leave it
//! as it is.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::Clip;
use chereme_motion::glam::DQuat;
use rusqlite::Connection;

use crate::db::{consents, stored_recordings};
use crate::error::CorpusResult;
use crate::movement::{ChannelGroup, MotionTrack};

/// The channels that carry movement.
const ARM_GROUPS: [ChannelGroup; 2] = [ChannelGroup::RightArm, ChannelGroup::LeftArm];
/// For how long the arms of a result have the rotations of those of a source before it counts as the movement of that source, in seconds.
const KEPT_MOVEMENT_SECONDS: f64 = 0.4;
/// The least cosine of half the angle between two rotations that count as the same: both were rounded when they were
/// stored.
const SAME_ROTATION_COSINE: f64 = 1.0 - 1e-8;
/// The cosine of half an angle of one degree: arms that turn less than that are at rest.
const MOVING_COSINE: f64 = 1.0 - 3.8e-5;

/// Returns the groups of recordings whose arms have equal blocks at the same frames.
pub(super) fn equal_movement_groups(connection: &Connection) -> CorpusResult<Vec<BTreeSet<i64>>> {
    let mut by_blocks: BTreeMap<(i64, Vec<Vec<u8>>), BTreeSet<i64>> = BTreeMap::new();
    for arms in consents::list_arm_blocks(connection)? {
        let recordings = by_blocks.entry((arms.first_frame, arms.hashes)).or_default();
        recordings.insert(arms.recording);
    }
    Ok(by_blocks.into_values().filter(|group| group.len() > 1).collect())
}

/// Returns those sources of a generated recording whose movement it shows unchanged.
pub(super) fn sources_kept_by(
    connection: &Connection,
    generated: i64,
    sources: &BTreeSet<i64>,
) -> CorpusResult<BTreeSet<i64>> {
    let mut kept_sources = BTreeSet::new();
    let Some(generated_body) = load_body_movement(connection, generated)? else {
        return Ok(kept_sources);
    };
    for &source in sources {
        if let Some(source_body) = load_body_movement(connection, source)?
            && is_movement_kept(&generated_body, &source_body)
        {
            kept_sources.insert(source);
        }
    }
    Ok(kept_sources)
}

/// The movement of a body, and the joints of its arms.
struct BodyMovement {
    clip: Clip,
    arm_joints: Vec<usize>,
}

fn load_body_movement(connection: &Connection, recording: i64) -> CorpusResult<Option<BodyMovement>> {
    if stored_recordings::body_track(connection, recording)?.is_none() {
        return Ok(None);
    }
    let track = MotionTrack::open_motion_track(connection, recording)?;
    let clip = track.read_motion_clip(connection, 0..track.motion_frame_count(), &ARM_GROUPS)?;
    let joints_of = |group: &ChannelGroup| track.groups.get(group).into_iter().flatten();
    let arm_joints = ARM_GROUPS.iter().flat_map(joints_of).copied();
    let arm_joints = arm_joints
        .filter(|joint| *joint < clip.joint_channels().len())
        .collect();
    Ok(Some(BodyMovement { clip, arm_joints }))
}

/// Reports whether the arms do in successive frames what those of the source do, and move meanwhile. Fingers, face and
/// the way somebody stands may be others: the movement, by which people are recognised, is the same.
fn is_movement_kept(generated: &BodyMovement, source: &BodyMovement) -> bool {
    let name_of = |body: &BodyMovement, joint: usize| body.clip.clip_skeleton().joint_at(joint).name.clone();
    // The skeletons may order their joints differently, so these are found by name.
    let source_joints: BTreeMap<String, usize> =
        (source.arm_joints.iter().map(|&joint| (name_of(source, joint), joint))).collect();
    let own_joints = generated.arm_joints.iter();
    let joints: Vec<[usize; 2]> = own_joints
        .filter_map(|&joint| Some([joint, *source_joints.get(&name_of(generated, joint))?]))
        .collect();
    // Few common joints could be alike by chance.
    if joints.is_empty() || joints.len() * 2 < generated.arm_joints.len() {
        return false;
    }
    let (own, other) = (&generated.clip, &source.clip);
    // A quaternion and its negative are the same rotation.
    let cosine = |one: DQuat, two: DQuat| one.dot(two).abs();
    let is_same_frame = |frame: usize, of_source: usize| {
        joints.iter().all(|&[own_joint, other_joint]| {
            let own_rotation = own.joint_channel(own_joint).rotations[frame];
            cosine(own_rotation, other.joint_channel(other_joint).rotations[of_source]) >= SAME_ROTATION_COSINE
        })
    };
    let moves_between = |first: usize, last: usize| {
        joints.iter().any(|&[_, joint]| {
            let rotations = &other.joint_channel(joint).rotations;
            cosine(rotations[first], rotations[last]) < MOVING_COSINE
        })
    };
    let enough = (KEPT_MOVEMENT_SECONDS / own.clip_frame_rate().frame_time()).ceil() as usize;
    // A clip that is shorter than the span counts as kept if all of it is.
    let enough = enough.min(own.clip_frame_count()).min(other.clip_frame_count()).max(2);
    // How many frames up to one of the source follow each other in both.
    let mut runs = vec![0; other.clip_frame_count() + 1];
    for frame in 0..own.clip_frame_count() {
        // Going backwards, the runs of the former frame are still there to be continued.
        for of_source in (0..other.clip_frame_count()).rev() {
            let run = match is_same_frame(frame, of_source) {
                true => runs[of_source] + 1,
                false => 0,
            };
            runs[of_source + 1] = run;
            // At rest, the arms of all people are alike.
            if run >= enough && moves_between(of_source + 1 - enough, of_source) {
                return true;
            }
        }
    }
    false
}
