//! Renames tiers of the corpus as a file did since its earlier version, and hangs them below the file's parents.

use std::collections::BTreeMap;

use chereme_formats::compare::renamed_tiers;
use chereme_formats::eaf::eaf_convert::AnnotationTranscript;
use rusqlite::Connection;

use super::ImportJob;
use crate::db::stored_tiers::{self, TierRow};
use crate::error::CorpusResult;

/// A tier that the file has under another name than its earlier version.
pub(super) struct TierRename {
    pub(super) from: String,
    pub(super) to: String,
}

/// Gives tiers of the earlier version the names that they have in the file, and returns these tiers. A name that
/// another tier of the recording has stays free for that tier.
pub(super) fn take_names(
    job: &ImportJob<'_>,
    recording: i64,
    base: &mut AnnotationTranscript,
    transcript: &AnnotationTranscript,
) -> CorpusResult<Vec<TierRename>> {
    let there = stored_tiers::load_tier_rows(job.connection, recording)?;
    let name_pairs = renamed_tiers(base, transcript).into_iter();
    let renames: Vec<TierRename> = name_pairs
        .map(|(from, to)| TierRename { from, to })
        .filter(|rename| there.iter().all(|row| row.name != rename.to))
        .collect();
    for tier in &mut base.tiers {
        if let Some(rename) = renames.iter().find(|rename| rename.from == tier.name) {
            tier.name.clone_from(&rename.to);
        }
    }
    Ok(renames)
}

/// Renames the tiers that still have the name of the earlier version; returns notes about them.
pub(super) fn write_tier_renames(
    connection: &Connection,
    renames: &[TierRename],
    there: &mut BTreeMap<String, TierRow>,
) -> CorpusResult<Vec<String>> {
    let mut notes = Vec::new();
    for TierRename { from, to } in renames {
        // A tier that was renamed in the corpus as well keeps the user's name.
        let Some(row) = there.get_mut(to).filter(|row| row.name == *from) else {
            continue;
        };
        row.name.clone_from(to);
        stored_tiers::update_tier(connection, row)?;
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
    transcript: &AnnotationTranscript,
    base: Option<&AnnotationTranscript>,
    there: &mut BTreeMap<String, TierRow>,
    tier_rows: &[i64],
) -> CorpusResult<()> {
    for tier in &transcript.tiers {
        let Some(row) = there.get_mut(&tier.name) else {
            continue;
        };
        let above = |document: &AnnotationTranscript, parent: Option<usize>| {
            parent.and_then(|at| Some(document.tiers.get(at)?.name.clone()))
        };
        let before = base.and_then(|base| {
            let old = base.tiers.iter().find(|base_tier| base_tier.name == tier.name)?;
            Some((above(base, old.parent), old.stereotype))
        });
        if before == Some((above(transcript, tier.parent), tier.stereotype)) {
            continue;
        }
        let parent = tier.parent.and_then(|at| tier_rows.get(at).copied());
        if (row.parent_id, row.stereotype) != (parent, tier.stereotype) {
            (row.parent_id, row.stereotype) = (parent, tier.stereotype);
            stored_tiers::update_tier(connection, row)?;
        }
    }
    Ok(())
}
