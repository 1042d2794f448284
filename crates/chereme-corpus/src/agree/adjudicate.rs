//! The adjudication of two tiers on a third one: agreements are written, disagreements wait for a decision.

use std::collections::BTreeMap;

use chereme_analysis::agreement::gamma::AlignmentCosts;
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use serde::Serialize;

use super::AgreeOptions;
use super::agree_figures::annotator_units;
use super::agree_tiers::{self, TierPair};
use super::disagreements::{ValueDistances, aligned_unit_groups};
use crate::Corpus;
use crate::address::RowName;
use crate::annotate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, NewTier, TierRequestName, TierValueSource, write_tiers,
};
use crate::db::edits;
use crate::db::people::ADJUDICATION_ANNOTATOR;
use crate::db::stored_tiers::{self as rows, AnnotationRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};
use crate::merge::keep_annotation;
use crate::progress::ProgressReceiver;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// The result of an adjudication.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct AdjudicationResult {
    /// The name of the third tier.
    pub tier: String,
    /// The recordings that got it.
    pub recordings: Vec<String>,
    /// The annotations on which both agree.
    pub agreed: u64,
    /// The disagreements that wait for a decision, as conflicts of a merge do.
    pub conflicts: u64,
}

/// One recording of an adjudication: the tier, its annotations, and the candidates.
struct AdjudicatedRecording {
    recording: i64,
    name: String,
    tier: NewTier,
    changes: Vec<AnnotationChange>,
    /// The place of a conflict: the start of the annotation of the first in the third tier, and that of the second.
    open: Vec<(Option<i64>, Option<AnnotationRow>)>,
    from: String,
}

impl Corpus {
    /// Writes a third tier below the others of each recording: aligned units with equal values whose starts and ends lie
    /// within the tolerance, with the span of the first annotator; and the first annotator's version of each
    /// disagreement, which stays until [`decide_conflicts`](Self::decide_conflicts) is called. Each disagreement is a conflict:
    /// `mine` is the first annotator's version, `theirs` the second's, whose boundaries are the first's where they lie within
    /// the tolerance. All of it is one operation.
    ///
    /// # Errors
    /// Those of [`agree`](Self::compare_annotators); fails if a recording has a tier of that name already.
    pub fn adjudicate_tiers(
        &mut self,
        options: &AgreeOptions,
        into: &str,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AdjudicationResult> {
        options.check_agree_options()?;
        let into = into.trim();
        let (all, mut report) = self.third_tiers(options, into)?;
        self.store.operation_with_progress(progress, |connection, progress| {
            edits::defer_references(connection)?;
            let inventories = inventories::load_all_inventories(connection)?;
            for third in &all {
                let written = AnnotateOptions::default();
                let new = std::slice::from_ref(&third.tier);
                write_tiers(connection, new, &third.changes, &written, progress)?;
                let tiers = rows::load_tier_rows(connection, third.recording)?;
                let Some(tier) = tiers.iter().find(|tier| tier.name == third.tier.name) else {
                    continue;
                };
                let placed = rows::load_tier_annotation_rows(connection, tier.id)?;
                let placed: BTreeMap<i64, i64> = placed
                    .iter()
                    .map(|annotation| (annotation.start_us, annotation.id))
                    .collect();
                for (mine, theirs) in &third.open {
                    let mine = mine.and_then(|start| placed.get(&start).copied());
                    let theirs = theirs.as_ref().map(|row| AnnotationRow {
                        tier_id: tier.id,
                        ..row.clone()
                    });
                    keep_annotation(connection, &third.from, mine, theirs.as_ref())?;
                }
                // The tokens were derived before their conflicts were stored, and a conflict counts only after its decision.
                tokens::update_recording_tokens(connection, third.recording, None, &inventories)?;
            }
            report.recordings = all.iter().map(|recording| recording.name.clone()).collect();
            let tier = into.to_owned();
            Ok((report, OperationEffect::Adjudicate { tier }))
        })
    }

    /// Returns the third tier of each recording, with the counts over all.
    fn third_tiers(
        &self,
        options: &AgreeOptions,
        into: &str,
    ) -> CorpusResult<(Vec<AdjudicatedRecording>, AdjudicationResult)> {
        let coded = agree_tiers::read_tier_pairs(self, options)?;
        let inventories = self.inventories_now()?;
        let distances = ValueDistances::distances_of_coded(&coded);
        let distance = |a: usize, b: usize| distances.distance_between_values(a, b);
        let costs = AlignmentCosts {
            distance: Some(&distance),
            ..AlignmentCosts::default()
        };
        let mut report = AdjudicationResult {
            tier: into.to_owned(),
            ..AdjudicationResult::default()
        };
        let mut all: Vec<AdjudicatedRecording> = Vec::new();
        for pair in &coded.pairs {
            check_adjudicated_pair(pair, &all, into)?;
            let mut third = AdjudicatedRecording {
                recording: pair.recording.id,
                name: pair.recording.name.clone(),
                tier: third_tier(pair, into, &inventories),
                changes: Vec::new(),
                open: Vec::new(),
                from: pair.b.name.clone(),
            };
            for group in aligned_unit_groups(pair, &costs).0 {
                let units = [group.first().copied().flatten(), group.get(1).copied().flatten()];
                match third.add_aligned_units(pair, units, options.tolerance_us) {
                    true => report.agreed += 1,
                    false => report.conflicts += 1,
                }
            }
            all.push(third);
        }
        Ok((all, report))
    }
}

/// Fails if the annotations of a pair of tiers cannot go onto a third one.
fn check_adjudicated_pair(pair: &TierPair, others: &[AdjudicatedRecording], into: &str) -> CorpusResult<()> {
    if pair.a.recording_id != pair.b.recording_id {
        return Err(
            CorpusError::from_wrong_message("the two tiers belong to different recordings")
                .with_error_place(format!("tier:{}", pair.b.id))
                .with_advice("copy one of them to the recording of the other, then adjudicate"),
        );
    }
    if others.iter().any(|other| other.recording == pair.recording.id) {
        return Err(CorpusError::from_wrong_message(format!(
            "several pairs of tiers of {:?} would go onto the tier {into:?}",
            pair.recording.name
        ))
        .with_error_place(pair.recording.name.as_str())
        .with_advice("name one pair of tiers"));
    }
    for (tier, rows) in [&pair.a, &pair.b].into_iter().zip(&pair.annotations) {
        if let Some(row) = rows.iter().find(|row| row.start_us >= row.end_us) {
            let message = format!(
                "the annotation {:?} at {:.3} s has no length, so it cannot go onto a third tier",
                row.value,
                row.start_us as f64 * 1e-6
            );
            return Err(CorpusError::from_wrong_message(message)
                .with_error_place(format!("{}, {}", pair.recording.name, tier.name))
                .with_advice("give it an end after its start, or delete it, then adjudicate"));
        }
    }
    Ok(())
}

/// Returns the third tier of a pair, with the properties of the first.
fn third_tier(pair: &TierPair, into: &str, inventories: &[StoredInventory]) -> NewTier {
    let stored = inventories
        .iter()
        .find(|candidate| Some(candidate.id) == pair.a.inventory_id);
    let has = |row: &AnnotationRow, stored: &StoredInventory| {
        !row.is_filled() || stored.inventory.find_inventory_value(&row.value).is_some()
    };
    // An inventory that lacks a value of either annotator would refuse the annotation.
    let complete = stored.filter(|stored| pair.annotations.iter().flatten().all(|row| has(row, stored)));
    NewTier {
        hand: pair.a.hand,
        values: complete.map_or(TierValueSource::Free, |stored| {
            TierValueSource::Inventory(stored.inventory.id.clone())
        }),
        participant: pair.a.participant.clone(),
        annotator: Some(ADJUDICATION_ANNOTATOR.to_owned()),
        language: pair.a.language.clone(),
        ..NewTier::new(RowName::Number(pair.recording.id), into, pair.a.role.clone())
    }
}

impl AdjudicatedRecording {
    /// Adds aligned units of both annotators, by their index; returns whether they agree. The first annotator's version
    /// goes onto the tier in either case.
    fn add_aligned_units(&mut self, pair: &TierPair, [a, b]: [Option<usize>; 2], tolerance: i64) -> bool {
        let mine = a.map(|at| &pair.annotations[0][at]);
        let theirs = b.map(|at| &pair.annotations[1][at]);
        if let Some(row) = mine {
            let name = TierRequestName::Of {
                recording: RowName::Number(self.recording),
                tier: self.tier.name.clone(),
            };
            self.changes.push(added_annotation_change(name, row));
        }
        let moved = match (mine, theirs) {
            (Some(mine), Some(theirs)) => annotation_boundary_gap(mine, theirs) > tolerance,
            _ => true,
        };
        let (first, second) = annotator_units(&pair.continuum);
        let is_equal = match (a, b) {
            (Some(a), Some(b)) => first[a].value == second[b].value,
            _ => false,
        };
        if is_equal && !moved {
            return true;
        }
        let span = |row: &AnnotationRow| match mine {
            Some(mine) if !moved => (mine.start_us, mine.end_us),
            _ => clip_second_annotation(row, &pair.annotations[0], a, tolerance),
        };
        let theirs = theirs.map(|row| {
            let (start_us, end_us) = span(row);
            disagreement_candidate(row, start_us, end_us)
        });
        self.open.push((mine.map(|annotation| annotation.start_us), theirs));
        false
    }
}

/// Returns how far the starts or the ends of two annotations lie apart, in microseconds.
fn annotation_boundary_gap(a: &AnnotationRow, b: &AnnotationRow) -> i64 {
    (a.start_us - b.start_us).abs().max((a.end_us - b.end_us).abs())
}

/// Returns the span of the second annotator's annotation, clipped where it reaches into an annotation of the first by no
/// more than the tolerance: their boundary counts as the same one. Its own counterpart does not clip it.
fn clip_second_annotation(
    row: &AnnotationRow,
    first: &[AnnotationRow],
    counterpart: Option<usize>,
    tolerance: i64,
) -> (i64, i64) {
    let (mut start, mut end) = (row.start_us, row.end_us);
    // Annotations that end before this one begins cannot reach into it.
    let from = first.partition_point(|other| other.end_us <= row.start_us);
    for (at, other) in first.iter().enumerate().skip(from) {
        if other.start_us >= row.end_us {
            break;
        }
        let shared = other.end_us.min(row.end_us) - other.start_us.max(row.start_us);
        // A larger overlap is a disagreement itself, and must stay visible.
        if Some(at) == counterpart || shared > tolerance {
            continue;
        }
        match other.start_us <= row.start_us {
            true => start = start.max(other.end_us),
            false => end = end.min(other.start_us),
        }
    }
    if start < end {
        (start, end)
    } else {
        (row.start_us, row.end_us)
    }
}

/// Returns the second annotator's version of a disagreement, without its ties to its own tier.
fn disagreement_candidate(row: &AnnotationRow, start_us: i64, end_us: i64) -> AnnotationRow {
    AnnotationRow {
        start_us,
        end_us,
        external_id: None,
        file_start_ms: None,
        file_end_ms: None,
        parent_id: None,
        source: None,
        position: 0,
        ..row.clone()
    }
}

fn added_annotation_change(tier: TierRequestName, row: &AnnotationRow) -> AnnotationChange {
    let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
    AnnotationAction::Add {
        tier,
        start: time(row.start_us),
        end: time(row.end_us),
        parent: None,
        order: None,
        value: row.file_text().to_owned(),
        confidence: None,
    }
    .into()
}
