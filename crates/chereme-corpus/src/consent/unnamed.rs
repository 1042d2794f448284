//! Inputs of recipes that earlier versions of the program left out: bodies, postures and places.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::bvh::convert;
use chereme_motion::Skeleton;
use rusqlite::Connection;

use crate::db::columns::Origin;
use crate::db::consents;
use crate::db::recordings::{self, RecordingRow};
use crate::error::Result;
use crate::movement::MotionTrack;
use crate::sources::notation;

/// The recordings that generated ones take movement from; `None` if one of them is gone or not known.
type Inputs = BTreeMap<i64, Option<BTreeSet<i64>>>;

/// The greatest difference between a bone and its stored copy, in metres: rounding to six decimals, in any unit.
const SAME: f64 = 1e-4;

/// Adds the recordings that generated signs do not name: those that gave a posture or a place, and those whose bodies
/// move, found by the skeleton.
///
/// If several recordings have that skeleton, each of them may have provided the body, and all are added. If none has
/// it, and it is not that of the program's own body, the sign's inputs are not known.
pub(super) fn complete(
    connection: &Connection,
    rows: &[RecordingRow],
    inputs: &mut Inputs,
) -> Result<()> {
    for (made, giver) in consents::unnamed_givers(connection)? {
        let known = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new()));
        match giver {
            Some(giver) => drop(known.as_mut().map(|it| it.insert(giver))),
            None => *known = None,
        }
    }
    let unnamed = consents::without_body(connection)?;
    if unnamed.is_empty() {
        return Ok(());
    }
    let captured = rows.iter().filter(|row| row.origin != Origin::Made);
    let mut bodies: Vec<(i64, Skeleton)> = Vec::new();
    for row in captured {
        bodies.extend(skeleton(connection, row.id)?.map(|it| (row.id, it)));
    }
    let own = notation::own_body()?.clip.skeleton().clone();
    for made in unnamed {
        let Some(moving) = skeleton(connection, made)? else {
            continue;
        };
        let of: BTreeSet<i64> = bodies
            .iter()
            .filter(|(_, body)| is_same(body, &moving))
            .map(|(recording, _)| *recording)
            .collect();
        if of.is_empty() && !is_same(&own, &moving) {
            inputs.insert(made, None);
        } else if let Some(known) = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new())) {
            known.extend(of);
        }
    }
    Ok(())
}

/// Returns the skeleton of a recording's body in model space; `None` if nothing moves in it.
fn skeleton(connection: &Connection, recording: i64) -> Result<Option<Skeleton>> {
    if recordings::body_track(connection, recording)?.is_none() {
        return Ok(None);
    }
    let track = MotionTrack::of(connection, recording)?;
    let skeleton = convert::skeleton(&track.hierarchy).ok();
    Ok(skeleton.map(|it| track.convention.skeleton(&it)))
}

/// Returns whether two skeletons are one body: the same bones in the same tree, of the same lengths. Names and the
/// place of the root may be written differently.
fn is_same(one: &Skeleton, other: &Skeleton) -> bool {
    let joints = one.joints().iter().zip(other.joints());
    one.len() == other.len()
        && joints
            .skip(1)
            .all(|(a, b)| a.parent == b.parent && (a.offset - b.offset).length() < SAME)
}
