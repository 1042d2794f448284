//! Updates the corpus from an annotation file that was imported before and edited since.
//!
//! The corpus, the file and the file's earlier version are compared annotation by annotation, by the ids in the file. A
//! change that only one side made is taken over. If the corpus was edited and the file would revert the edit, the edit
//! is lost; a merge preserves it.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::compare::renamed_tiers;
use chereme_formats::eaf::convert::{Annotation, AnnotationAddress, Transcript};
use chereme_formats::roles::TierGuess;
use chereme_motion::Instant;
use chereme_sign::Remedy;
use chereme_sign::Stereotype;

use super::{FileReport, Job, annotation_row, coded, parents_first};
use crate::db::columns::AnnotationOrigin;
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::Result;
use crate::import::report::{Outcome, OwnEdit, ReportFinding, Saying};
use crate::import::understood::Changes;
use crate::progress::Progress;

/// The largest number of changes that are listed one by one.
const LISTED: usize = 20;

/// The result of an update.
pub(super) struct Updated {
    pub(super) changes: Changes,
    pub(super) edits: Vec<OwnEdit>,
    /// The conflicts: the row of the corpus, and the annotation of the file.
    pub(super) conflicts: Vec<(Option<i64>, Option<AnnotationRow>)>,
    /// The changes of the file as texts for the user.
    listed: Vec<String>,
    /// The number of annotations in the corpus that stay although the file never had them.
    kept: usize,
    /// The rows of the file's annotations.
    pub(super) written: BTreeSet<i64>,
}

/// The files that an update compares, and the affected tiers.
pub(super) struct Sides<'a> {
    pub(super) transcript: &'a Transcript,
    pub(super) guesses: &'a [TierGuess],
    /// The earlier version of the file, if the corpus has it.
    pub(super) base: Option<&'a Transcript>,
    /// The tiers of the recording, by name.
    pub(super) known: &'a BTreeMap<String, TierRow>,
    /// The row of each tier of the file.
    pub(super) tier_rows: &'a [i64],
    /// Whether edits of the corpus survive.
    pub(super) merge: bool,
}

/// Reports whether a file is a version of one that the tiers came from: for some tier of both, annotations share ids,
/// or the corpus has no annotations.
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

/// Returns the tiers of a file that were renamed in the corpus: the name in the file, and the present name. The earlier
/// version of the file has the tier, and most of its annotations lie on the other tier with their ids.
pub(super) fn renamed(
    job: &Job<'_>,
    transcript: &Transcript,
    base: &Transcript,
    there: &BTreeMap<String, TierRow>,
) -> Result<Vec<(String, String)>> {
    let in_file = |name: &str| {
        let mut both = transcript.tiers.iter().chain(&base.tiers);
        both.any(|tier| tier.name == name)
    };
    let mut free: Vec<(&String, Vec<AnnotationRow>)> = Vec::new();
    for (name, row) in there.iter().filter(|(name, _)| !in_file(name)) {
        free.push((name, tiers::annotations(job.connection, row.id)?));
    }
    let mut found = Vec::new();
    for tier in &transcript.tiers {
        let before = base.tiers.iter().find(|it| it.name == tier.name);
        let Some(before) = before.filter(|_| !there.contains_key(&tier.name)) else {
            continue;
        };
        let ids: BTreeSet<&str> = before.annotations.iter().map(|it| it.id.as_str()).collect();
        let shared = |rows: &[AnnotationRow]| {
            let named = rows.iter().filter_map(|row| row.external_id.as_deref());
            named.filter(|id| ids.contains(id)).count()
        };
        let counts = free.iter().map(|(_, rows)| shared(rows));
        let Some((at, most)) = counts.enumerate().max_by_key(|(_, count)| *count) else {
            break;
        };
        if most > 0 && 2 * most >= ids.len() {
            let (name, _) = free.remove(at);
            found.push((tier.name.clone(), name.clone()));
        }
    }
    Ok(found)
}

/// Returns the number of annotations that are the same in two files (id, time and value), and that of the file with
/// more.
pub(super) fn alike(a: &Transcript, b: &Transcript) -> (usize, usize) {
    let parts_of = |transcript: &'_ Transcript| -> BTreeMap<(String, String), ComparedParts> {
        let own = Base::of(transcript);
        own.parts
    };
    let mut a = a.clone();
    for (from, to) in renamed_tiers(&a, b) {
        for tier in a.tiers.iter_mut().filter(|it| it.name == from) {
            tier.name.clone_from(&to);
        }
    }
    let (a, b) = (parts_of(&a), parts_of(b));
    let same = a.iter().filter(|(key, parts)| b.get(*key) == Some(*parts));
    (same.count(), a.len().max(b.len()))
}

/// Updates annotations from an edited file. They are matched by id; those that the corpus added since are matched by
/// time. Annotations that the file no longer has are removed, unless it never had them.
pub(super) fn annotations(
    job: &mut Job<'_>,
    sides: &Sides<'_>,
    progress: &mut Progress<'_>,
) -> Result<Updated> {
    let mut work = Update {
        sides,
        base: sides.base.map(Base::of),
        rows: BTreeMap::new(),
        names: BTreeMap::new(),
        left: Vec::new(),
        done: Updated {
            changes: Changes::default(),
            edits: Vec::new(),
            conflicts: Vec::new(),
            listed: Vec::new(),
            kept: 0,
            written: BTreeSet::new(),
        },
    };
    // Annotations of the file may lie below a tier that the file no longer has.
    let own = &sides.transcript.tiers;
    for (_, row) in sides
        .known
        .iter()
        .filter(|(name, _)| own.iter().all(|tier| tier.name != **name))
    {
        for row in tiers::annotations(job.connection, row.id)? {
            work.know(&row);
        }
    }
    let order = parents_first(sides.transcript);
    for &tier in &order {
        job.report_progress(progress)?;
        let name = &sides.transcript.tiers[tier].name;
        let old = match sides.known.get(name) {
            Some(row) => tiers::annotations(job.connection, row.id)?,
            None => Vec::new(),
        };
        work.tier(job, tier, old, progress)?;
    }
    // Children go before their parents.
    for (tier, row) in std::mem::take(&mut work.left).into_iter().rev() {
        work.remove(job, &tier, &row)?;
    }
    work.done.written = work.rows.into_values().collect();
    Ok(work.done)
}

/// The parts of an annotation that are compared.
#[derive(Debug, Clone, PartialEq, Eq)]
struct ComparedParts {
    /// Start and end in milliseconds, as in files.
    time: [i64; 2],
    value: String,
    /// The id of the parent annotation.
    above: Option<String>,
}

impl ComparedParts {
    fn in_file(transcript: &Transcript, annotation: &Annotation) -> Self {
        let above = annotation.parent.and_then(|place| {
            let tier = transcript.tiers.get(place.tier)?;
            Some(tier.annotations.get(place.index)?.id.clone())
        });
        Self {
            time: [annotation.span.start(), annotation.span.end()].map(Instant::millis),
            value: annotation.value.clone(),
            above,
        }
    }

    /// Returns the content of a row; missing values are written as in files.
    fn in_corpus(row: &AnnotationRow, names: &BTreeMap<i64, String>) -> Self {
        Self {
            time: millis(row),
            value: row.file_text().to_owned(),
            above: row.parent_id.and_then(|id| names.get(&id).cloned()),
        }
    }

    fn saying(&self) -> Saying {
        let [start_us, end_us] = self.time.map(|millis| millis.saturating_mul(1000));
        Saying {
            start_us,
            end_us,
            value: self.value.clone(),
        }
    }

    /// Reports whether `theirs` would overwrite a change from `base` to `mine`.
    fn is_lost(mine: &Self, base: Option<&Self>, theirs: &Self) -> bool {
        let Some(base) = base else {
            return mine != theirs;
        };
        (mine.time != base.time && mine.time != theirs.time)
            || (mine.value != base.value && mine.value != theirs.value)
            || (mine.above != base.above && mine.above != theirs.above)
    }
}

fn millis(row: &AnnotationRow) -> [i64; 2] {
    [row.start_us, row.end_us].map(|micros| Instant::from_micros(micros).millis())
}

/// The annotations of the earlier file, by tier and id.
struct Base {
    parts: BTreeMap<(String, String), ComparedParts>,
}

impl Base {
    fn of(transcript: &Transcript) -> Self {
        let all = transcript.tiers.iter().flat_map(|tier| {
            tier.annotations.iter().map(|it| {
                let key = (tier.name.clone(), it.id.clone());
                (key, ComparedParts::in_file(transcript, it))
            })
        });
        Self {
            parts: all.collect(),
        }
    }
}

/// Returns the three-way merge of a value, and whether both sides changed it in different ways; `mine` stays then.
fn merged<'t, T: PartialEq>(base: Option<&T>, mine: &'t T, theirs: &'t T) -> (&'t T, bool) {
    if mine == theirs || base == Some(theirs) {
        (mine, false)
    } else if base == Some(mine) {
        (theirs, false)
    } else {
        (mine, true)
    }
}

struct Update<'s> {
    sides: &'s Sides<'s>,
    base: Option<Base>,
    /// The rows of annotations by their place in the file.
    rows: BTreeMap<AnnotationAddress, i64>,
    /// The ids of rows in the file.
    names: BTreeMap<i64, String>,
    /// Annotations that the file no longer has, with the names of their tiers.
    left: Vec<(String, AnnotationRow)>,
    done: Updated,
}

impl Update<'_> {
    fn parts_before(&self, tier: &str, id: &str) -> Option<&ComparedParts> {
        let key = (tier.to_owned(), id.to_owned());
        self.base.as_ref()?.parts.get(&key)
    }

    /// Notes the id of a row in the file.
    fn know(&mut self, row: &AnnotationRow) {
        let name = row.external_id.clone();
        self.names
            .insert(row.id, name.unwrap_or_else(|| format!("#{}", row.id)));
    }

    /// Reports whether a row was added or edited in the corpus.
    fn is_own(&self, tier: &str, row: &AnnotationRow) -> bool {
        let known = row.external_id.as_deref();
        match known.and_then(|id| self.parts_before(tier, id)) {
            Some(before) => ComparedParts::in_corpus(row, &self.names) != *before,
            None => known.is_none() || self.base.is_some(),
        }
    }

    fn tier(
        &mut self,
        job: &mut Job<'_>,
        tier: usize,
        old: Vec<AnnotationRow>,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        let sides = self.sides;
        let it = &sides.transcript.tiers[tier];
        for row in &old {
            self.know(row);
        }
        let symbolic = it.stereotype.is_some_and(|it| {
            matches!(
                it,
                Stereotype::SymbolicAssociation | Stereotype::SymbolicSubdivision
            )
        });
        let own: Vec<(i64, [i64; 2])> = old
            .iter()
            .filter(|row| sides.merge && !symbolic && self.is_own(&it.name, row))
            .map(|row| (row.id, millis(row)))
            .collect();
        let meets_own = |row: i64, time: [i64; 2]| {
            let meets = |span: &(i64, [i64; 2])| {
                span.0 != row && span.1[0] < time[1] && time[0] < span.1[1]
            };
            own.iter().any(meets)
        };
        let mut old = Standing::of(old);
        for (index, annotation) in it.annotations.iter().enumerate() {
            if index % 256 == 255 {
                job.report_progress(progress)?;
            }
            let above = annotation.parent.and_then(|place| self.rows.get(&place));
            let parent = above.copied();
            let new = annotation_row(annotation, sides.tier_rows[tier], parent);
            let new = coded(new, &sides.guesses[tier]);
            let theirs = ComparedParts::in_file(sides.transcript, annotation);
            let row = match old.take(annotation, &new) {
                Some(before) => {
                    self.names.insert(before.id, annotation.id.clone());
                    let free = !meets_own(before.id, theirs.time);
                    Some(self.put(job, tier, before, (new, &theirs), free)?)
                }
                None => {
                    let orphan = annotation.parent.is_some() && parent.is_none();
                    let free = !orphan && !meets_own(0, theirs.time);
                    self.add(job, &it.name, new, &theirs, free)?
                }
            };
            if let Some(row) = row {
                self.names.insert(row, annotation.id.clone());
                self.rows.insert(AnnotationAddress { tier, index }, row);
            }
        }
        let spans: Vec<[i64; 2]> = it
            .annotations
            .iter()
            .map(|it| [it.span.start().micros(), it.span.end().micros()])
            .collect();
        for row in old.rows.into_values() {
            let meets = |span: &[i64; 2]| row.start_us < span[1] && span[0] < row.end_us;
            if row.external_id.is_some() || spans.iter().any(meets) {
                self.left.push((it.name.clone(), row));
            } else {
                self.done.kept += 1;
            }
        }
        Ok(())
    }

    /// Adds an annotation that the corpus lacks. A merge leaves it out if it was removed here or has no room.
    fn add(
        &mut self,
        job: &Job<'_>,
        tier: &str,
        new: AnnotationRow,
        theirs: &ComparedParts,
        free: bool,
    ) -> Result<Option<i64>> {
        let name = new.external_id.clone().unwrap_or_default();
        let before = self.parts_before(tier, &name).cloned();
        if self.sides.merge {
            if before.as_ref() == Some(theirs) {
                return Ok(None);
            }
            if before.is_some() || !free {
                self.edit(tier, None, Some(theirs), Outcome::Conflict);
                self.done.conflicts.push((None, Some(new)));
                return Ok(None);
            }
        } else if before.is_some() {
            self.edit(tier, None, Some(theirs), Outcome::Lost);
        }
        self.done.changes.added += 1;
        self.list(tier, &new, format!("{:?} added", new.value));
        Ok(Some(tiers::insert_annotation(job.connection, &new)?))
    }

    /// Updates an annotation that exists in the corpus.
    fn put(
        &mut self,
        job: &Job<'_>,
        tier: usize,
        before: AnnotationRow,
        (new, theirs): (AnnotationRow, &ComparedParts),
        free: bool,
    ) -> Result<i64> {
        let (id, tier) = (before.id, &self.sides.transcript.tiers[tier].name);
        let mine = ComparedParts::in_corpus(&before, &self.names);
        let named = before.external_id.is_some();
        if mine == *theirs {
            self.done.changes.unchanged += 1;
            if !named {
                let row = AnnotationRow {
                    external_id: new.external_id,
                    ..before
                };
                tiers::update_annotation(job.connection, &row)?;
            }
            return Ok(id);
        }
        let base = self.parts_before(tier, new.external_id.as_deref().unwrap_or_default());
        let base = base.cloned();
        let lost = ComparedParts::is_lost(&mine, base.as_ref(), theirs);
        let mut take = [true; 3];
        if self.sides.merge {
            let base = base.as_ref();
            let time = merged(base.map(|it| &it.time), &mine.time, &theirs.time);
            let value = merged(base.map(|it| &it.value), &mine.value, &theirs.value);
            let above = merged(base.map(|it| &it.above), &mine.above, &theirs.above);
            let room = free || *time.0 == mine.time;
            if time.1 || value.1 || above.1 || !room {
                self.edit(tier, Some(&mine), Some(theirs), Outcome::Conflict);
                self.done.conflicts.push((Some(id), Some(new.clone())));
            } else if lost {
                self.edit(tier, Some(&mine), Some(theirs), Outcome::Kept);
            }
            take = [
                *time.0 == theirs.time && room,
                *value.0 == theirs.value,
                *above.0 == theirs.above,
            ];
        } else if lost {
            self.edit(tier, Some(&mine), Some(theirs), Outcome::Lost);
        }
        self.write(job, tier, (before, mine), (new, theirs), take)?;
        Ok(id)
    }

    /// Writes the parts taken from a file's annotation: time, value and parent, as the flags say.
    fn write(
        &mut self,
        job: &Job<'_>,
        tier: &str,
        (before, mine): (AnnotationRow, ComparedParts),
        (new, theirs): (AnnotationRow, &ComparedParts),
        [time, value, above]: [bool; 3],
    ) -> Result<()> {
        let moved = time && mine.time != theirs.time;
        let renamed = value && mine.value != theirs.value;
        let elsewhere = above && before.parent_id != new.parent_id;
        let mut row = if renamed { new.clone() } else { before.clone() };
        row.id = before.id;
        row.external_id.clone_from(&new.external_id);
        row.parent_id = if above {
            new.parent_id
        } else {
            before.parent_id
        };
        let times = if moved { &new } else { &before };
        (row.start_us, row.end_us) = (times.start_us, times.end_us);
        (row.file_start_ms, row.file_end_ms) = (times.file_start_ms, times.file_end_ms);
        row.position = if above { new.position } else { before.position };
        if row != before {
            tiers::update_annotation(job.connection, &row)?;
        }
        if !(moved || renamed || elsewhere) {
            self.done.changes.unchanged += 1;
            return Ok(());
        }
        self.done.changes.changed += 1;
        let what = match (renamed, moved) {
            (true, true) => format!("{:?} became {:?}, and moved", mine.value, new.value),
            (true, false) => format!("{:?} became {:?}", mine.value, new.value),
            (false, true) => format!("{:?} moved from {}", row.value, at(before.start_us)),
            (false, false) => format!("{:?} hangs below another", row.value),
        };
        self.list(tier, &row, what);
        Ok(())
    }

    /// Removes an annotation that the file no longer has, together with its children.
    fn remove(&mut self, job: &Job<'_>, tier: &str, row: &AnnotationRow) -> Result<()> {
        let before = row.external_id.as_deref();
        let before = before.and_then(|id| self.parts_before(tier, id)).cloned();
        let mine = ComparedParts::in_corpus(row, &self.names);
        let own = match &before {
            Some(before) => mine != *before,
            None => row.external_id.is_none() || row.origin != AnnotationOrigin::File,
        };
        let below = tiers::children(job.connection, row.id)?;
        if self.sides.merge && (own || !below.is_empty()) {
            if own && before.is_some() {
                self.edit(tier, Some(&mine), None, Outcome::Conflict);
                self.done.conflicts.push((Some(row.id), None));
            } else {
                self.done.kept += 1;
            }
            return Ok(());
        }
        for row in &below {
            let name = tiers::tier(job.connection, row.tier_id)?.name;
            self.remove(job, &name, row)?;
        }
        if own {
            self.edit(tier, Some(&mine), None, Outcome::Lost);
        }
        self.list(tier, row, format!("{:?} removed", row.value));
        tiers::delete_annotation(job.connection, row.id)?;
        self.done.changes.removed += 1;
        Ok(())
    }

    fn edit(
        &mut self,
        tier: &str,
        mine: Option<&ComparedParts>,
        theirs: Option<&ComparedParts>,
        outcome: Outcome,
    ) {
        self.done.edits.push(OwnEdit {
            tier: tier.to_owned(),
            mine: mine.map(ComparedParts::saying),
            theirs: theirs.map(ComparedParts::saying),
            outcome,
        });
    }

    fn list(&mut self, tier: &str, row: &AnnotationRow, what: String) {
        self.done
            .listed
            .push(format!("tier {tier:?} at {}: {what}", at(row.start_us)));
    }
}

fn at(micros: i64) -> Instant {
    Instant::from_micros(micros)
}

impl Updated {
    /// Adds the file's changes to the report.
    pub(super) fn report(self, sides: &Sides<'_>, report: &mut FileReport) {
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
        some(&self.listed, &mut note);
        if self.kept > 0 {
            let (many, is) = if self.kept == 1 {
                ("annotation", "is")
            } else {
                ("annotations", "are")
            };
            note(format!(
                "{} {many} that the file does not have {is} kept",
                self.kept
            ));
        }
        let own = &sides.transcript.tiers;
        let names: BTreeSet<&str> = own.iter().map(|it| it.name.as_str()).collect();
        for name in sides
            .known
            .keys()
            .filter(|name| !names.contains(name.as_str()))
        {
            note(format!(
                "the tier {name:?}, which the file has not, is kept"
            ));
        }
        let outcomes = |outcome| {
            let edits = self.edits.iter().filter(move |it| it.outcome == outcome);
            edits.map(ToString::to_string).collect::<Vec<_>>()
        };
        let warn =
            |remedy: Remedy| move |text: String| ReportFinding::warning(text, remedy.clone());
        let lost = warn(Remedy::command("`chereme undo` takes the import back"));
        some(&outcomes(Outcome::Lost), &mut |text| {
            report.findings.push(lost(text))
        });
        let conflict = warn(Remedy::command(
            "`chereme conflicts CORPUS` lists both candidates; decide there",
        ));
        some(&outcomes(Outcome::Conflict), &mut |text| {
            report.findings.push(conflict(text))
        });
        let mut note = |text: String| report.findings.push(ReportFinding::note(text));
        some(&outcomes(Outcome::Kept), &mut note);
        report.understood.changes = Some(self.changes);
        report.edits = self.edits;
    }
}

/// Passes on the first lines of many, and the number of remaining ones.
pub(super) fn some(lines: &[String], take: &mut dyn FnMut(String)) {
    for line in lines.iter().take(LISTED) {
        take(line.clone());
    }
    let more = lines.len().saturating_sub(LISTED);
    if more > 0 {
        take(format!("and {more} more"));
    }
}

/// The annotations of a tier that are not matched with one of the file yet.
struct Standing {
    rows: BTreeMap<i64, AnnotationRow>,
    by_name: BTreeMap<String, i64>,
    by_time: BTreeMap<[i64; 2], i64>,
}

impl Standing {
    fn of(rows: Vec<AnnotationRow>) -> Self {
        let mut standing = Self {
            rows: BTreeMap::new(),
            by_name: BTreeMap::new(),
            by_time: BTreeMap::new(),
        };
        for row in rows {
            match &row.external_id {
                Some(name) => standing.by_name.insert(name.clone(), row.id),
                None => standing.by_time.insert(millis(&row), row.id),
            };
            standing.rows.insert(row.id, row);
        }
        standing
    }

    /// Removes and returns the row for an annotation: the one with its id, otherwise one without an id at the same
    /// time.
    fn take(&mut self, annotation: &Annotation, new: &AnnotationRow) -> Option<AnnotationRow> {
        let id = self.by_name.remove(&annotation.id);
        let id = id.or_else(|| self.by_time.remove(&millis(new)))?;
        self.rows.remove(&id)
    }
}
