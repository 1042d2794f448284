//! Keeps the annotations that a file does not have in agreement with the annotations above them.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::{self, AnnotationId, TierViolation};
use chereme_sign::{ErrorRemedy, RemedyChoice, TierStereotype};
use rusqlite::Connection;

use crate::address::message_names;
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// A recording before an update: the times of its annotations, and the tier rules that it violates.
pub(super) struct RecordingBeforeUpdate {
    recording: i64,
    times: BTreeMap<i64, [i64; 2]>,
    broken: BTreeSet<String>,
}

impl RecordingBeforeUpdate {
    pub(super) fn read_before_update(connection: &Connection, recording: i64) -> CorpusResult<Self> {
        let mut times = BTreeMap::new();
        for tier in stored_tiers::load_tier_rows(connection, recording)? {
            for row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
                times.insert(row.id, [row.start_us, row.end_us]);
            }
        }
        let broken = list_tier_violations(connection, recording)?.into_iter();
        Ok(Self {
            recording,
            times,
            broken: broken.map(|violation| violation.to_string()).collect(),
        })
    }

    /// Moves each annotation that the file does not have with the annotation above it; `written` are the rows of the
    /// file's annotations. Returns a note if any moved.
    pub(super) fn settle_moved_annotations(
        &self,
        connection: &Connection,
        written: &BTreeSet<i64>,
    ) -> CorpusResult<Option<String>> {
        let mut moved = 0;
        let mut times: BTreeMap<i64, [i64; 2]> = BTreeMap::new();
        for tier in tier_rows_parents_first(stored_tiers::load_tier_rows(connection, self.recording)?) {
            let mut kept: BTreeMap<i64, Vec<AnnotationRow>> = BTreeMap::new();
            for row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
                times.insert(row.id, [row.start_us, row.end_us]);
                if let Some(parent) = row.parent_id.filter(|_| !written.contains(&row.id)) {
                    kept.entry(parent).or_default().push(row);
                }
            }
            for (parent, children) in kept {
                let (Some(old), Some(new)) = (self.times.get(&parent), times.get(&parent)) else {
                    continue;
                };
                let (old, new) = (*old, *new);
                if old == new {
                    continue;
                }
                let mut children = children;
                children.sort_by_key(|row| (row.position, row.start_us));
                let count = children.len();
                for (place, mut row) in children.into_iter().enumerate() {
                    let row_times = [row.start_us, row.end_us];
                    let placed = match tier.stereotype {
                        Some(TierStereotype::SymbolicAssociation) => new,
                        Some(TierStereotype::SymbolicSubdivision) => share_of_times(new, place, count),
                        other => place_in_moved_parent(row_times, old, new, other),
                    };
                    if placed == row_times {
                        continue;
                    }
                    [row.start_us, row.end_us] = placed;
                    // The times of the file no longer apply to a moved annotation.
                    (row.file_start_ms, row.file_end_ms) = (None, None);
                    stored_tiers::update_annotation(connection, &row)?;
                    times.insert(row.id, placed);
                    moved += 1;
                }
            }
        }
        Ok((moved > 0)
            .then(|| format!("annotations that the file does not have moved with the annotations above them: {moved}")))
    }

    /// Fails if a tier rule is broken that was not broken before. A fault of the file alone does not count, unless edits
    /// were merged.
    pub(super) fn check_broken_tier_rules(
        &self,
        connection: &Connection,
        written: &BTreeSet<i64>,
        merge: bool,
    ) -> CorpusResult<()> {
        let all_violations = list_tier_violations(connection, self.recording)?.into_iter();
        // After a merge, faults may arise where both sides meet, even in annotations of the file.
        let mut new_violations = all_violations.filter(|violation| merge || !is_of_file(violation, written));
        // Rules that were broken before are no reason to refuse the file.
        let Some(rule) = new_violations.find(|violation| !self.broken.contains(&violation.to_string())) else {
            return Ok(());
        };
        if merge {
            return Err(CorpusError::from_wrong_message(format!(
                "the file and your edits contradict each other: {rule}"
            ))
            .with_advice(ErrorRemedy::choice_remedy(
                RemedyChoice::Side,
                "import it with --theirs (the file as it is) or --mine (your edits)",
            )));
        }
        let rule = message_names::name_message_ids(connection, &rule.to_string());
        Err(CorpusError::from_wrong_message(format!(
            "with this file, an annotation that it does not have would break a rule: {rule}"
        ))
        .with_advice("add that annotation to the file, or remove it from the corpus, then import the file again"))
    }
}

fn list_tier_violations(connection: &Connection, recording: i64) -> CorpusResult<Vec<TierViolation>> {
    let set = stored_tiers::load_tier_set(connection, recording)?;
    Ok(chereme_sign::tier::check_tier_set(&set))
}

/// Reports whether a violation concerns annotations of the file alone.
fn is_of_file(violation: &TierViolation, written: &BTreeSet<i64>) -> bool {
    let of_file = |id: &AnnotationId| i64::try_from(id.0).is_ok_and(|id| written.contains(&id));
    match violation {
        TierViolation::ZeroLength { annotation, .. } => annotation.0.iter().all(of_file),
        TierViolation::Overlap { annotation, other, .. }
        | TierViolation::SecondAssociation { annotation, other, .. } => annotation.0.iter().chain([other]).all(of_file),
        TierViolation::MissingParent { annotation, .. }
        | TierViolation::ParentOfRoot { annotation, .. }
        | TierViolation::OutsideParent { annotation, .. }
        | TierViolation::Order { annotation, .. }
        | TierViolation::DerivedSpan { annotation, .. } => of_file(annotation),
        TierViolation::Gap { parent, .. } => of_file(parent),
        _ => false,
    }
}

fn share_of_times(times: [i64; 2], place: usize, count: usize) -> [i64; 2] {
    let [start, end] = times.map(RecordingInstant::from_micros);
    let span = tier::subdivision_share(TimeSpan::span_between(start, end), place, count);
    [
        span.span_start_instant().instant_micros(),
        span.span_end_instant().instant_micros(),
    ]
}

/// Returns the new times of an annotation with times of its own whose parent has new times. It moves with its parent. If
/// the parent became longer or shorter, an annotation that the parent includes stays, but not outside of it; the parts
/// of a time subdivision keep their shares.
fn place_in_moved_parent(
    [start, end]: [i64; 2],
    old: [i64; 2],
    new: [i64; 2],
    stereotype: Option<TierStereotype>,
) -> [i64; 2] {
    let by = new[0].saturating_sub(old[0]);
    if by == new[1].saturating_sub(old[1]) {
        // The parent only moved, so everything below it moves by the same time.
        return [start.saturating_add(by), end.saturating_add(by)];
    }
    if stereotype == Some(TierStereotype::IncludedIn) {
        let inside = [start.max(new[0]), end.min(new[1])];
        // An annotation that lies wholly outside is left for the check of the rules to report.
        return if inside[0] < inside[1] { inside } else { [start, end] };
    }
    // The product of two times in microseconds may exceed 64 bits.
    let length = |span: [i64; 2]| i128::from(span[1]) - i128::from(span[0]);
    let scaled = |at: i64| {
        // A parent without length would otherwise divide by zero.
        let part = (i128::from(at) - i128::from(old[0])) * length(new) / length(old).max(1);
        let new_time = i128::from(new[0]) + part;
        i64::try_from(new_time).unwrap_or(i64::MAX)
    };
    [scaled(start), scaled(end)]
}

fn tier_rows_parents_first(all: Vec<TierRow>) -> Vec<TierRow> {
    let parents: BTreeMap<i64, i64> = all.iter().filter_map(|row| Some((row.id, row.parent_id?))).collect();
    let depth = |row: &TierRow| {
        std::iter::successors(Some(row.id), |id| parents.get(id).copied())
            .take(all.len() + 1)
            .count()
    };
    let depths: BTreeMap<i64, usize> = all.iter().map(|row| (row.id, depth(row))).collect();
    let mut all = all;
    all.sort_by_key(|row| (depths[&row.id], row.position));
    all
}
