//! Renames tiers of the corpus as a file did since its earlier version, and hangs them below the file's parents.

use std::collections::BTreeMap;

use chereme_formats::compare::renamed_tiers;
use chereme_formats::eaf::convert::Transcript;
use rusqlite::Connection;

use super::Job;
use crate::db::tiers::{self, TierRow};
use crate::error::Result;

/// A tier that the file has under another name than its earlier version.
pub(super) struct Rename {
    pub(super) from: String,
    pub(super) to: String,
}

/// Gives tiers of the earlier version the names that they have in the file, and returns these tiers. A name that
/// another tier of the recording has stays free for that tier.
pub(super) fn take_names(
    job: &Job<'_>,
    recording: i64,
    base: &mut Transcript,
    transcript: &Transcript,
) -> Result<Vec<Rename>> {
    let there = tiers::tiers(job.connection, recording)?;
    let renames = renamed_tiers(base, transcript).into_iter();
    let renames: Vec<Rename> = renames
        .map(|(from, to)| Rename { from, to })
        .filter(|it| there.iter().all(|row| row.name != it.to))
        .collect();
    for tier in &mut base.tiers {
        if let Some(rename) = renames.iter().find(|it| it.from == tier.name) {
            tier.name.clone_from(&rename.to);
        }
    }
    Ok(renames)
}

/// Renames the tiers that still have the name of the earlier version; returns notes about them.
pub(super) fn write(
    connection: &Connection,
    renames: &[Rename],
    there: &mut BTreeMap<String, TierRow>,
) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    for Rename { from, to } in renames {
        let Some(row) = there.get_mut(to).filter(|row| row.name == *from) else {
            continue;
        };
        row.name.clone_from(to);
        tiers::update_tier(connection, row)?;
        notes.push(format!(
            "the tier {from:?} is called {to:?} in the file: it has the new name here, too"
        ));
    }
    Ok(notes)
}

/// Hangs tiers below the parents that they have in the file: annotations have their parents there. If there is an
/// earlier version, only those whose parents differ between the two.
pub(super) fn write_parents(
    connection: &Connection,
    (transcript, base): (&Transcript, Option<&Transcript>),
    there: &mut BTreeMap<String, TierRow>,
    tier_rows: &[i64],
) -> Result<()> {
    for tier in &transcript.tiers {
        let Some(row) = there.get_mut(&tier.name) else {
            continue;
        };
        let above = |it: &Transcript, parent: Option<usize>| {
            parent.and_then(|at| Some(it.tiers.get(at)?.name.clone()))
        };
        let before = base.and_then(|base| {
            let old = base.tiers.iter().find(|it| it.name == tier.name)?;
            Some((above(base, old.parent), old.stereotype))
        });
        if before == Some((above(transcript, tier.parent), tier.stereotype)) {
            continue;
        }
        let parent = tier.parent.and_then(|at| tier_rows.get(at).copied());
        if (row.parent_id, row.stereotype) != (parent, tier.stereotype) {
            (row.parent_id, row.stereotype) = (parent, tier.stereotype);
            tiers::update_tier(connection, row)?;
        }
    }
    Ok(())
}
