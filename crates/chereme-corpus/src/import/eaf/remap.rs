//! Tiers that are in the corpus already, and what a mapping says of them later.

use std::collections::BTreeMap;

use chereme_formats::eaf::convert::Transcript;
use chereme_formats::roles::TierGuess;

use super::vocabulary::tier_inventory;
use super::{FileReport, Job, coded};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::Result;
use crate::import::report::ReportFinding;

/// Makes tiers that are there what the caller's mapping says, and returns how many it changed.
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
        let field = |row: &TierRow| (row.role.clone(), row.component.clone(), row.feature.clone());
        if field(&row) != field(old) {
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
            role_text(&row),
            role_text(old)
        )));
        changed += 1;
    }
    job.counts.changed("tiers", changed);
    Ok(changed)
}

/// Returns what a tier is, in the words of a mapping: `right.configuration`.
fn role_text(row: &TierRow) -> String {
    let role = row.role().name();
    let hand = row.hand.as_ref().map(|hand| format!("{hand}."));
    format!("{}{role}", hand.unwrap_or_default())
}

/// Writes how values are missing as the new role of a tier has it.
fn recode(job: &Job<'_>, tier: &TierRow, guess: &TierGuess) -> Result<()> {
    for old in tiers::annotations(job.connection, tier.id)? {
        let value = match old.state.as_str() {
            "not-applicable" => "n/a",
            "unclear" => "unclear",
            _ => &old.value,
        };
        let state = if value.is_empty() { "unset" } else { "value" };
        let row = AnnotationRow {
            state: state.to_owned(),
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

/// Writes down what a tier is taken for.
pub(super) fn set_role(row: &mut TierRow, guess: &TierGuess) {
    row.set_role(&guess.role.clone().unwrap_or_default());
    row.hand = guess.hand.map(|hand| hand.name().to_owned());
}
