//! An annotation file that was imported before, edited since, and comes again.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::eaf::convert::{Annotation, Place, Transcript};
use chereme_formats::roles::TierGuess;
use chereme_motion::Instant;
use serde::Serialize;

use super::{FileReport, Job, annotation_row, coded, parents_first};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::Result;
use crate::import::report::ReportFinding;

/// So many changes are told one by one.
const TOLD: usize = 20;

/// The rows of annotations by their place in the file.
type Rows = BTreeMap<Place, i64>;

/// How many annotations of a file differ from those of the corpus.
#[derive(Debug, Default, Serialize)]
pub(super) struct Changes {
    added: usize,
    changed: usize,
    removed: usize,
    unchanged: usize,
}

/// Tells whether a file is one of those that the tiers came from: of a tier that both have, it knows
/// annotations by their names, or the corpus has none.
pub(super) fn is_edited(
    job: &Job<'_>,
    transcript: &Transcript,
    there: &BTreeMap<String, TierRow>,
) -> Result<bool> {
    for tier in &transcript.tiers {
        let Some(row) = there.get(&tier.name) else {
            continue;
        };
        let ids: BTreeSet<&str> = tier.annotations.iter().map(|it| it.id.as_str()).collect();
        let rows = tiers::annotations(job.connection, row.id)?;
        let known = |row: &AnnotationRow| {
            let id = row.external_id.as_deref();
            id.is_some_and(|id| ids.contains(id))
        };
        if rows.is_empty() || rows.iter().any(known) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Brings annotations to what an edited file says: by their names in the file; those that the corpus
/// added since by their time. What the file has no more is removed, but for what it never had.
pub(super) fn annotations(
    job: &mut Job<'_>,
    transcript: &Transcript,
    guesses: &[TierGuess],
    (tier_rows, known): (&[i64], &BTreeMap<String, TierRow>),
    report: &mut FileReport,
) -> Result<()> {
    let mut work = Update {
        rows: Rows::new(),
        changes: Changes::default(),
        told: Vec::new(),
        kept: 0,
        left: Vec::new(),
    };
    let order = parents_first(transcript);
    for &tier in &order {
        let name = &transcript.tiers[tier].name;
        let old = match known.get(name) {
            Some(row) => tiers::annotations(job.connection, row.id)?,
            None => Vec::new(),
        };
        work.tier(job, transcript, (tier, tier_rows[tier]), guesses, old)?;
    }
    // Those below go before those above.
    for (name, row) in std::mem::take(&mut work.left).into_iter().rev() {
        work.tell(&name, &row, format!("{:?} removed", row.value));
        tiers::delete_annotation(job.connection, row.id)?;
        work.changes.removed += 1;
    }
    job.count("annotations", work.changes.added);
    work.report(known, transcript, report);
    Ok(())
}

struct Update {
    rows: Rows,
    changes: Changes,
    told: Vec<String>,
    /// How many are kept that the file never had.
    kept: usize,
    /// What the file has no more, with the tier's name.
    left: Vec<(String, AnnotationRow)>,
}

impl Update {
    fn tier(
        &mut self,
        job: &Job<'_>,
        transcript: &Transcript,
        (tier, tier_row): (usize, i64),
        guesses: &[TierGuess],
        old: Vec<AnnotationRow>,
    ) -> Result<()> {
        let name = &transcript.tiers[tier].name;
        let mut old = Standing::of(old);
        for (index, annotation) in transcript.tiers[tier].annotations.iter().enumerate() {
            let parent = annotation
                .parent
                .and_then(|parent| self.rows.get(&parent).copied());
            let new = coded(annotation_row(annotation, tier_row, parent), &guesses[tier]);
            let id = match old.take(annotation, &new) {
                Some(before) => self.put(job, name, before, new)?,
                None => {
                    self.changes.added += 1;
                    self.tell(name, &new, format!("{:?} added", new.value));
                    tiers::insert_annotation(job.connection, &new)?
                }
            };
            self.rows.insert(Place { tier, index }, id);
        }
        let spans: Vec<[i64; 2]> = transcript.tiers[tier]
            .annotations
            .iter()
            .map(|it| [it.span.start().micros(), it.span.end().micros()])
            .collect();
        for row in old.rows.into_values() {
            let meets = |span: &[i64; 2]| row.start_us < span[1] && span[0] < row.end_us;
            if row.external_id.is_some() || spans.iter().any(meets) {
                self.left.push((name.clone(), row));
            } else {
                self.kept += 1;
            }
        }
        Ok(())
    }

    /// Writes an annotation that was there before.
    fn put(
        &mut self,
        job: &Job<'_>,
        tier: &str,
        before: AnnotationRow,
        new: AnnotationRow,
    ) -> Result<i64> {
        let millis = |micros: i64| Instant::from_micros(micros).millis();
        let old = [before.start_us, before.end_us];
        let moved = old.map(millis) != [new.start_us, new.end_us].map(millis);
        let renamed = (&before.state, &before.value) != (&new.state, &new.value);
        let elsewhere = before.parent_id != new.parent_id;
        let id = before.id;
        if !(moved || renamed || elsewhere) {
            self.changes.unchanged += 1;
            if before.external_id.is_none() {
                let row = AnnotationRow {
                    external_id: new.external_id,
                    ..before
                };
                tiers::update_annotation(job.connection, &row)?;
            }
            return Ok(id);
        }
        self.changes.changed += 1;
        let what = match (renamed, moved) {
            (true, true) => format!("{:?} is {:?}, and moved", before.value, new.value),
            (true, false) => format!("{:?} is {:?}", before.value, new.value),
            (false, true) => format!("{:?} moved", new.value),
            (false, false) => format!("{:?} hangs below another", new.value),
        };
        self.tell(tier, &new, what);
        let [start_us, end_us] = if moved {
            [new.start_us, new.end_us]
        } else {
            old
        };
        let row = AnnotationRow {
            id,
            start_us,
            end_us,
            ..new
        };
        tiers::update_annotation(job.connection, &row)?;
        Ok(id)
    }

    fn tell(&mut self, tier: &str, row: &AnnotationRow, what: String) {
        let at = Instant::from_micros(row.start_us);
        self.told.push(format!("tier {tier:?} at {at}: {what}"));
    }

    fn report(
        self,
        known: &BTreeMap<String, TierRow>,
        transcript: &Transcript,
        report: &mut FileReport,
    ) {
        let Changes {
            added,
            changed,
            removed,
            unchanged,
        } = self.changes;
        let mut note = |text: String| report.findings.push(ReportFinding::note(text));
        note(format!(
            "its annotations were there before: {changed} changed, {added} added, {removed} removed, \
             {unchanged} as they were"
        ));
        let more = self.told.len().saturating_sub(TOLD);
        for line in self.told.into_iter().take(TOLD) {
            note(line);
        }
        if more > 0 {
            note(format!("and {more} more"));
        }
        if self.kept > 0 {
            note(format!(
                "{} annotations that the file never had are kept",
                self.kept
            ));
        }
        let names: BTreeSet<&str> = transcript.tiers.iter().map(|it| it.name.as_str()).collect();
        for name in known.keys().filter(|name| !names.contains(name.as_str())) {
            note(format!(
                "the tier {name:?}, which the file has not, is kept"
            ));
        }
        report.understand("changes", self.changes);
    }
}

/// The annotations of a tier that no annotation of the file was matched with yet.
struct Standing {
    rows: BTreeMap<i64, AnnotationRow>,
    by_name: BTreeMap<String, i64>,
    by_time: BTreeMap<[i64; 2], i64>,
}

impl Standing {
    fn of(rows: Vec<AnnotationRow>) -> Self {
        let millis = |micros: i64| Instant::from_micros(micros).millis();
        let mut standing = Self {
            rows: BTreeMap::new(),
            by_name: BTreeMap::new(),
            by_time: BTreeMap::new(),
        };
        for row in rows {
            match &row.external_id {
                Some(name) => standing.by_name.insert(name.clone(), row.id),
                None => standing
                    .by_time
                    .insert([row.start_us, row.end_us].map(millis), row.id),
            };
            standing.rows.insert(row.id, row);
        }
        standing
    }

    /// Takes the row of an annotation: that of its name, else one without a name at its time.
    fn take(&mut self, annotation: &Annotation, new: &AnnotationRow) -> Option<AnnotationRow> {
        let millis = |micros: i64| Instant::from_micros(micros).millis();
        let time = [new.start_us, new.end_us].map(millis);
        let id = self.by_name.remove(&annotation.id);
        let id = id.or_else(|| self.by_time.remove(&time))?;
        self.rows.remove(&id)
    }
}
