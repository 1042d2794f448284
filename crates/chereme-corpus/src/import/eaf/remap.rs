//! Applies a mapping to tiers that are already in the corpus.

use std::collections::BTreeMap;

use chereme_formats::eaf::convert::Transcript;
use chereme_formats::roles::TierGuess;

use super::vocabulary::tier_inventory;
use super::{FileReport, Job, coded, plain_state};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::Result;
use crate::import::report::ReportFinding;

/// Gives existing tiers the roles of the caller's mapping, and returns the number of changed tiers.
pub(super) fn remap(
    job: &mut Job<'_>,
    there: &BTreeMap<String, TierRow>,
    transcript: &Transcript,
    guesses: &[TierGuess],
    report: &mut FileReport,
) -> Result<usize> {
    let mut changed = 0;
    for (tier, guess) in transcript.tiers.iter().zip(guesses) {
        let named = job.options.mapping.tier(&tier.name).is_some();
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
        tiers::update_tier(job.connection, &row)?;
        recode(job, &row, guess)?;
        report.findings.push(ReportFinding::note(format!(
            "tier {:?}: {} (before: {})",
            row.name,
            row.topic(),
            old.topic()
        )));
        changed += 1;
    }
    job.counts.changed("tiers", changed);
    Ok(changed)
}

/// Updates the states of missing values for the new role of a tier.
fn recode(job: &Job<'_>, tier: &TierRow, guess: &TierGuess) -> Result<()> {
    for old in tiers::annotations(job.connection, tier.id)? {
        let value = old.file_text();
        let row = AnnotationRow {
            state: plain_state(value),
            value: value.to_owned(),
            ..old.clone()
        };
        let row = coded(row, guess);
        if row != old {
            tiers::update_annotation(job.connection, &row)?;
        }
    }
    Ok(())
}

/// Sets role and hand of a tier as guessed.
pub(super) fn set_role(row: &mut TierRow, guess: &TierGuess) {
    row.role = guess.role.clone().unwrap_or_default();
    row.hand = guess.hand;
}
