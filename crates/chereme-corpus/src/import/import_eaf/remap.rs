//! Applies a mapping to tiers that are already in the corpus.

use std::collections::BTreeMap;

use chereme_formats::eaf::eaf_convert::AnnotationTranscript;
use chereme_formats::roles::TierGuess;

use super::eaf_vocabulary::tier_inventory;
use super::{FileReport, ImportJob, plain_state, with_coded_state};
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::CorpusResult;
use crate::report_finding::ReportFinding;

/// Gives existing tiers the roles of the caller's mapping, and returns the number of changed tiers.
pub(super) fn remap_tier_roles(
    job: &mut ImportJob<'_>,
    there: &BTreeMap<String, TierRow>,
    transcript: &AnnotationTranscript,
    guesses: &[TierGuess],
    report: &mut FileReport,
) -> CorpusResult<usize> {
    let mut changed = 0;
    for (tier, guess) in transcript.tiers.iter().zip(guesses) {
        let named = job.options.mapping.tier_mapping_entry(&tier.name).is_some();
        // Only what the mapping states may replace roles that the user may have set since.
        let Some(old) = there.get(&tier.name).filter(|_| named) else {
            continue;
        };
        let mut row = old.clone();
        set_role(&mut row, guess);
        if row.role != old.role {
            row.inventory_id = tier_inventory(job, transcript, tier, guess, report)?;
        }
        if row == *old {
            continue;
        }
        stored_tiers::update_tier(job.connection, &row)?;
        // Whether a text marks a missing value depends on the role of its tier.
        recode(job, &row, guess)?;
        report.findings.push(ReportFinding::finding_note(format!(
            "tier {:?}: {} (before: {})",
            row.name,
            row.tier_topic(),
            old.tier_topic()
        )));
        changed += 1;
    }
    job.counts.count_changed_rows("tiers", changed);
    Ok(changed)
}

/// Updates the states of missing values for the new role of a tier.
fn recode(job: &ImportJob<'_>, tier: &TierRow, guess: &TierGuess) -> CorpusResult<()> {
    for old in stored_tiers::load_tier_annotation_rows(job.connection, tier.id)? {
        let value = old.file_text();
        let uncoded_row = AnnotationRow {
            state: plain_state(value),
            value: value.to_owned(),
            ..old.clone()
        };
        let row = with_coded_state(uncoded_row, guess);
        if row != old {
            stored_tiers::update_annotation(job.connection, &row)?;
        }
    }
    Ok(())
}

/// Sets role and hand of a tier as guessed.
pub(super) fn set_role(row: &mut TierRow, guess: &TierGuess) {
    row.role = guess.role.clone().unwrap_or_default();
    row.hand = guess.hand;
}
