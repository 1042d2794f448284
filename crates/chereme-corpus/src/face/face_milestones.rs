//! Derives milestones from glosses and functions, and writes them as tiers that can be corrected.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::TierRole;
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones, ExpressionPhase};
use serde::Serialize;

use super::expressions::{self, FaceExpression, MILESTONE_TIER_PREFIX};
use crate::Corpus;
use crate::address::{CorpusAddress, RowName, find_addressed_recording};
use crate::annotate::{AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, NewTier, TierRequestName};
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::stored_recordings;
use crate::db::stored_tiers;
use crate::error::CorpusResult;
use crate::progress::ProgressReceiver;

/// Options for the derivation of milestones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MilestoneOptions {
    /// The function; `None` for every function that a tier names.
    pub function: Option<ExpressionFunction>,
    /// The name of the function tier; `None` for tiers named function, construction, clause type and so on.
    pub tier: Option<String>,
    /// The recording; `None` for all.
    pub recording: Option<CorpusAddress>,
    /// Whether the call leaves the corpus unchanged.
    pub dry_run: bool,
}

/// The expressions that were found, and what was written.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct FoundExpressions {
    /// How many annotations of phases were written.
    pub written: u64,
    /// The number of expressions whose milestones a person wrote or corrected; these remain.
    pub kept: u64,
    /// The expressions, by recording and time.
    pub expressions: Vec<FoundExpression>,
    /// The number of expressions of each function that tiers name.
    pub functions: BTreeMap<String, u64>,
}

/// An expression of the face with its milestones.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundExpression {
    /// The recording's name.
    pub recording: String,
    /// The address of the expression in other commands.
    pub address: String,
    /// Its function over the signs that it spans.
    pub function: ExpressionFunction,
    /// The glosses that it spans.
    pub signs: Vec<String>,
    /// The milestones on the recording's clock.
    #[serde(flatten)]
    pub milestones: ExpressionMilestones,
    /// Whether its milestones are those that a person wrote or corrected.
    pub corrected: bool,
    /// Findings about the expression.
    pub findings: Vec<String>,
}

impl Corpus {
    /// Finds expressions of the face on function tiers, derives their milestones from the glosses that they span, and
    /// writes the phases of each onto a tier such as `milestones wh`.
    ///
    /// Phases that a person wrote or corrected remain, and are the expression's milestones from then on. An end outside
    /// of the recording is stored in the value, as in `M1-M2 from -0.300s`.
    ///
    /// # Errors
    /// Fails if the recording does not exist, if the corpus cannot be written, or if `progress` stops the work before
    /// anything is written.
    pub fn derive_face_milestones(
        &mut self,
        options: &MilestoneOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<FoundExpressions> {
        let connection = self.store.read_connection();
        let wanted = match &options.recording {
            Some(address) => Some(find_addressed_recording(connection, address)?),
            None => None,
        };
        let mut all = stored_recordings::load_recording_rows(connection)?;
        all.retain(|row| wanted.is_none_or(|id| row.id == id));
        let mut report = FoundExpressions::default();
        let mut fresh: Vec<(String, i64, FaceExpression)> = Vec::new();
        for (done, row) in all.iter().enumerate() {
            progress.report_items(&row.name, done, all.len())?;
            let expressions =
                expressions::load_recording_expressions(connection, row.id, None, options.tier.as_deref())?;
            // All functions are counted, so that people see which others they could ask for.
            for it in &expressions {
                *report
                    .functions
                    .entry(it.function.function_name().to_owned())
                    .or_default() += 1;
            }
            let chosen =
                |expression: &&FaceExpression| options.function.as_ref().is_none_or(|own| *own == expression.function);
            for it in expressions.iter().filter(chosen) {
                report.kept += u64::from(it.corrected);
                report.expressions.push(FoundExpression {
                    recording: row.name.clone(),
                    address: address_of(it, &expressions),
                    function: it.function.clone(),
                    signs: it.signs.clone(),
                    milestones: it.milestones,
                    corrected: it.corrected,
                    findings: it.odd.clone(),
                });
                if !it.corrected {
                    fresh.push((row.name.clone(), row.duration_us, it.clone()));
                }
            }
        }
        if !options.dry_run {
            report.written = self.write_milestones(&fresh, progress)?;
        }
        Ok(report)
    }

    fn write_milestones(
        &mut self,
        fresh: &[(String, i64, FaceExpression)],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<u64> {
        let mut changes: Vec<AnnotationChange> = Vec::new();
        let mut written = 0;
        let mut taken: BTreeMap<(i64, String), i64> = BTreeMap::new();
        let mut derived: Vec<(&String, i64, FaceExpression)> = Vec::new();
        // All removals come before the additions, as a new phase may lie where an old one goes.
        for (name, duration, it) in fresh {
            let connection = self.store.read_connection();
            let new_expression = rederived(connection, it)?;
            let remove = it.stored.iter().map(|id| AnnotationAction::Remove {
                annotation: AnnotationName::Number(*id),
            });
            changes.extend(remove.map(AnnotationChange::from));
            derived.push((name, *duration, new_expression));
        }
        for (name, duration, it) in &derived {
            let parts = milestone_phase_annotations(&it.milestones, *duration);
            let (Some(first), Some(last)) = (parts.first(), parts.last()) else {
                continue;
            };
            // Expressions of one function may overlap, and the annotations of a tier may not: others go to
            // another tier.
            let mut number = 1;
            let tier = loop {
                let tier = tier_name(&it.function, number);
                let end = taken.get(&(it.recording, tier.clone())).copied();
                let free = end.is_none_or(|end| end <= first.1)
                    && !self.is_occupied(it.recording, &tier, first.1, last.2, fresh)?;
                if free {
                    break tier;
                }
                number += 1;
            };
            self.ensure_tier(it.recording, name, &tier)?;
            taken.insert((it.recording, tier.clone()), last.2);
            for (value, start, end) in parts {
                let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
                changes.push(
                    AnnotationAction::Add {
                        tier: TierRequestName::Of {
                            recording: RowName::Number(it.recording),
                            tier: tier.clone(),
                        },
                        start: time(start),
                        end: time(end),
                        parent: None,
                        order: None,
                        value,
                        confidence: None,
                    }
                    .into(),
                );
                written += 1;
            }
        }
        if !changes.is_empty() {
            let options = AnnotateOptions {
                origin: AnnotationOrigin::Detector,
                detector: Some("milestones"),
                ..AnnotateOptions::default()
            };
            self.annotate_corpus(&changes, &options, progress)?;
        }
        Ok(written)
    }

    /// Returns whether a tier has annotations in the way of new ones, apart from those that are about to be removed.
    fn is_occupied(
        &self,
        recording: i64,
        tier: &str,
        start: i64,
        end: i64,
        fresh: &[(String, i64, FaceExpression)],
    ) -> CorpusResult<bool> {
        let connection = self.store.read_connection();
        let all = stored_tiers::load_tier_rows(connection, recording)?;
        let Some(row) = all.into_iter().find(|row| row.name == tier) else {
            return Ok(false);
        };
        let going: BTreeSet<i64> = fresh.iter().flat_map(|(.., it)| it.stored.clone()).collect();
        let near = stored_tiers::annotations_near(connection, row.id, start, end)?;
        Ok(near.iter().any(|annotation| {
            !going.contains(&annotation.id) && annotation.start_us < end && annotation.end_us > start
        }))
    }

    fn ensure_tier(&mut self, recording: i64, name: &str, tier: &str) -> CorpusResult<()> {
        let all = stored_tiers::load_tier_rows(self.store.read_connection(), recording)?;
        if all.iter().any(|row| row.name == tier) {
            return Ok(());
        }
        let new = NewTier::new(RowName::Text(name.to_owned()), tier, TierRole::Free);
        self.add_tier(&new).map(drop)
    }
}

fn tier_name(function: &ExpressionFunction, number: usize) -> String {
    match number {
        1 => format!("{MILESTONE_TIER_PREFIX}{function}"),
        number => format!("{MILESTONE_TIER_PREFIX}{function} {number}"),
    }
}

/// Returns an expression with milestones that follow from the present glosses, ignoring earlier ones.
fn rederived(connection: &rusqlite::Connection, it: &FaceExpression) -> CorpusResult<FaceExpression> {
    // Nothing to derive from: no old phases, or phases that no annotation of a function stands behind.
    if it.stored.is_empty() || it.stored.contains(&it.annotation) {
        return Ok(it.clone());
    }
    expressions::derive_expression_milestones(connection, it)
}

/// Returns the address that identifies an expression among all of its recording.
pub(super) fn address_of(it: &FaceExpression, all: &[FaceExpression]) -> String {
    let alike = all.iter().filter(|other| other.function == it.function).count();
    match alike {
        0 | 1 => CorpusAddress::Recording(RowName::Number(it.recording)).to_string(),
        _ => CorpusAddress::Annotation(it.annotation).to_string(),
    }
}

/// Returns the annotations of an expression: their values and times, cut to the recording.
fn milestone_phase_annotations(marks: &ExpressionMilestones, duration: i64) -> Vec<(String, i64, i64)> {
    let mut parts = Vec::new();
    for (phase, span) in ExpressionPhase::ALL_EXPRESSION_PHASES
        .into_iter()
        .zip(marks.phase_spans())
    {
        let (from, to) = span.span_bounds_micros();
        let (start, end) = (from.clamp(0, duration), to.clamp(0, duration));
        if start >= end {
            continue;
        }
        let mut value = match (phase, marks.m3) {
            (ExpressionPhase::Rest, None) => "M2-M4".to_owned(),
            _ => phase.milestone_range_name().to_owned(),
        };
        // Milestones may lie outside of the recording, where no annotation can; the value keeps them.
        if start > from {
            value.push_str(&format!(" from {}", span.span_start_instant()));
        }
        if end < to {
            value.push_str(&format!(" to {}", span.span_end_instant()));
        }
        parts.push((value, start, end));
    }
    parts
}
