//! Inputs of recipes that earlier versions of the program left out: bodies, postures and places.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::bvh::bvh_convert;
use chereme_motion::Skeleton;
use rusqlite::Connection;

use crate::db::consents;
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::error::CorpusResult;
use crate::movement::MotionTrack;
use crate::starter;

/// The recordings that generated ones take movement from; `None` if one of them is gone or not known.
type RecordingInputs = BTreeMap<i64, Option<BTreeSet<i64>>>;

/// The greatest difference between a bone and its stored copy, in metres: rounding to six decimals, in any unit.
const SAME_BONE_TOLERANCE_M: f64 = 1e-4;

/// Adds the recordings that generated signs do not name: those that gave a posture or a place, and those whose bodies
/// move, found by the skeleton.
///
/// If several recordings have that skeleton, each of them may have provided the body, and all are added. If none has
/// it, and it is not that of the program's own body, the sign's inputs are not known.
pub(super) fn complete_unnamed_inputs(
    connection: &Connection,
    rows: &[RecordingRow],
    inputs: &mut RecordingInputs,
) -> CorpusResult<()> {
    for (made, giver) in consents::unnamed_givers(connection)? {
        let made_inputs = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new()));
        match giver {
            Some(giver) => drop(made_inputs.as_mut().map(|givers| givers.insert(giver))),
            // A giver that is gone may have been anybody.
            None => *made_inputs = None,
        }
    }
    let unnamed = consents::without_body(connection)?;
    // Reading all skeletons is slow, and only needed for recipes of earlier versions.
    if unnamed.is_empty() {
        return Ok(());
    }
    let captured = rows.iter().filter(|row| row.origin != RecordOrigin::Made);
    let mut bodies: Vec<(i64, Skeleton)> = Vec::new();
    for row in captured {
        bodies.extend(load_moving_skeleton(connection, row.id)?.map(|body| (row.id, body)));
    }
    let own_skeleton = starter::own_body()?.clip.clip_skeleton().clone();
    for made in unnamed {
        let Some(moving) = load_moving_skeleton(connection, made)? else {
            continue;
        };
        let of: BTreeSet<i64> = bodies
            .iter()
            .filter(|(_, body)| is_same(body, &moving))
            .map(|(recording, _)| *recording)
            .collect();
        // The program's own body belongs to nobody, so it adds no source.
        if of.is_empty() && !is_same(&own_skeleton, &moving) {
            inputs.insert(made, None);
        } else if let Some(known) = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new())) {
            known.extend(of);
        }
    }
    Ok(())
}

/// Returns the skeleton of a recording's body in model space; `None` if nothing moves in it.
fn load_moving_skeleton(connection: &Connection, recording: i64) -> CorpusResult<Option<Skeleton>> {
    if stored_recordings::body_track(connection, recording)?.is_none() {
        return Ok(None);
    }
    let track = MotionTrack::open_motion_track(connection, recording)?;
    let skeleton = bvh_convert::skeleton_from_hierarchy(&track.hierarchy).ok();
    Ok(skeleton.map(|raw_skeleton| track.convention.file_skeleton_to_model(&raw_skeleton)))
}

/// Returns whether two skeletons are one body: the same bones in the same tree, of the same lengths. Names and the
/// place of the root may be written differently.
fn is_same(one: &Skeleton, other: &Skeleton) -> bool {
    let joints = one.skeleton_joints().iter().zip(other.skeleton_joints());
    one.len() == other.len()
        && joints
            // The offset of the root is its place in the room, and no bone.
            .skip(1)
            .all(|(a, b)| a.parent == b.parent && (a.offset - b.offset).length() < SAME_BONE_TOLERANCE_M)
}
