//! Keeps the annotations that a file does not have in agreement with the annotations above them.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::{Instant, Span};
use chereme_sign::tier::{self, AnnotationId, Violation};
use chereme_sign::{Choice, Remedy, Stereotype};
use rusqlite::Connection;

use crate::annotate::messages;
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::{Error, Result};

/// A recording before an update: the times of its annotations, and the tier rules that it violates.
pub(super) struct Before {
    recording: i64,
    times: BTreeMap<i64, [i64; 2]>,
    broken: BTreeSet<String>,
}

impl Before {
    pub(super) fn of(connection: &Connection, recording: i64) -> Result<Self> {
        let mut times = BTreeMap::new();
        for tier in tiers::tiers(connection, recording)? {
            for row in tiers::annotations(connection, tier.id)? {
                times.insert(row.id, [row.start_us, row.end_us]);
            }
        }
        let broken = violations(connection, recording)?.into_iter();
        Ok(Self {
            recording,
            times,
            broken: broken.map(|it| it.to_string()).collect(),
        })
    }

    /// Moves each annotation that the file does not have with the annotation above it; `written` are the rows of the
    /// file's annotations. Returns a note if any moved.
    pub(super) fn settle(
        &self,
        connection: &Connection,
        written: &BTreeSet<i64>,
    ) -> Result<Option<String>> {
        let mut moved = 0;
        let mut times: BTreeMap<i64, [i64; 2]> = BTreeMap::new();
        for tier in parents_first(tiers::tiers(connection, self.recording)?) {
            let mut kept: BTreeMap<i64, Vec<AnnotationRow>> = BTreeMap::new();
            for row in tiers::annotations(connection, tier.id)? {
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
                    let own = [row.start_us, row.end_us];
                    let placed = match tier.stereotype {
                        Some(Stereotype::SymbolicAssociation) => new,
                        Some(Stereotype::SymbolicSubdivision) => share(new, place, count),
                        other => placed(own, (old, new), other),
                    };
                    if placed == own {
                        continue;
                    }
                    [row.start_us, row.end_us] = placed;
                    (row.file_start_ms, row.file_end_ms) = (None, None);
                    tiers::update_annotation(connection, &row)?;
                    times.insert(row.id, placed);
                    moved += 1;
                }
            }
        }
        Ok((moved > 0).then(|| {
            format!(
                "annotations that the file does not have moved with the annotations above them: {moved}"
            )
        }))
    }

    /// Fails if a tier rule is broken that was not broken before. A fault of the file alone does not count, unless edits
    /// were merged.
    pub(super) fn check(
        &self,
        connection: &Connection,
        written: &BTreeSet<i64>,
        merge: bool,
    ) -> Result<()> {
        let found = violations(connection, self.recording)?.into_iter();
        let mut found = found.filter(|it| merge || !is_of_file(it, written));
        let Some(rule) = found.find(|it| !self.broken.contains(&it.to_string())) else {
            return Ok(());
        };
        if merge {
            return Err(Error::wrong(format!(
                "the file and your edits contradict each other: {rule}"
            ))
            .advise(Remedy::choice(
                Choice::Side,
                "import it with --theirs (the file as it is) or --mine (your edits)",
            )));
        }
        let rule = messages::named(connection, &rule.to_string());
        Err(Error::wrong(format!(
            "with this file, an annotation that it does not have would break a rule: {rule}"
        ))
        .advise(
            "add that annotation to the file, or remove it from the corpus, then import the file again",
        ))
    }
}

fn violations(connection: &Connection, recording: i64) -> Result<Vec<Violation>> {
    let set = crate::check::tier_set(connection, recording)?;
    Ok(chereme_sign::tier::check(&set))
}

/// Reports whether a violation concerns annotations of the file alone.
fn is_of_file(violation: &Violation, written: &BTreeSet<i64>) -> bool {
    let of_file = |id: &AnnotationId| i64::try_from(id.0).is_ok_and(|id| written.contains(&id));
    match violation {
        Violation::ZeroLength { annotation, .. } => annotation.0.iter().all(of_file),
        Violation::Overlap {
            annotation, other, ..
        }
        | Violation::SecondAssociation {
            annotation, other, ..
        } => annotation.0.iter().chain([other]).all(of_file),
        Violation::MissingParent { annotation, .. }
        | Violation::ParentOfRoot { annotation, .. }
        | Violation::OutsideParent { annotation, .. }
        | Violation::Order { annotation, .. }
        | Violation::DerivedSpan { annotation, .. } => of_file(annotation),
        Violation::Gap { parent, .. } => of_file(parent),
        _ => false,
    }
}

fn share(times: [i64; 2], place: usize, count: usize) -> [i64; 2] {
    let [start, end] = times.map(Instant::from_micros);
    let span = tier::share(Span::between(start, end), place, count);
    [span.start().micros(), span.end().micros()]
}

/// Returns the new times of an annotation with times of its own whose parent has new times. It moves with its parent. If
/// the parent became longer or shorter, an annotation that the parent includes stays, but not outside of it; the parts
/// of a time subdivision keep their shares.
fn placed(
    [start, end]: [i64; 2],
    (old, new): ([i64; 2], [i64; 2]),
    stereotype: Option<Stereotype>,
) -> [i64; 2] {
    let by = new[0].saturating_sub(old[0]);
    if by == new[1].saturating_sub(old[1]) {
        return [start.saturating_add(by), end.saturating_add(by)];
    }
    if stereotype == Some(Stereotype::IncludedIn) {
        let inside = [start.max(new[0]), end.min(new[1])];
        return if inside[0] < inside[1] {
            inside
        } else {
            [start, end]
        };
    }
    let length = |it: [i64; 2]| i128::from(it[1]) - i128::from(it[0]);
    let scaled = |at: i64| {
        let part = (i128::from(at) - i128::from(old[0])) * length(new) / length(old).max(1);
        let at = i128::from(new[0]) + part;
        i64::try_from(at).unwrap_or(i64::MAX)
    };
    [scaled(start), scaled(end)]
}

fn parents_first(all: Vec<TierRow>) -> Vec<TierRow> {
    let parents: BTreeMap<i64, i64> = all
        .iter()
        .filter_map(|row| Some((row.id, row.parent_id?)))
        .collect();
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
