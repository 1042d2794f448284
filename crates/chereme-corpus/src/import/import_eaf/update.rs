//! Updates the corpus from an annotation file that was imported before and edited since.
//!
//! The corpus, the file and the file's earlier version are compared annotation by annotation, by the ids in the file. A
//! change that only one side made is taken over. If the corpus was edited and the file would revert the edit, the edit
//! is lost; a merge preserves it.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::compare::renamed_tiers;
use chereme_formats::eaf::eaf_convert::{AnnotationAddress, AnnotationTranscript, TranscriptAnnotation};
use chereme_formats::roles::TierGuess;
use chereme_motion::RecordingInstant;
use chereme_sign::TierStereotype;

use super::{FileReport, ImportJob, annotation_row, with_coded_state};
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::CorpusResult;
use crate::import::import_report::{AnnotationSide, EditOutcome, OwnEdit, pass_first_lines};
use crate::import::understood::ReimportChanges;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;

/// The result of an update.
pub(super) struct EafUpdateResult {
    pub(super) changes: ReimportChanges,
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
pub(super) struct UpdateSides<'a> {
    pub(super) transcript: &'a AnnotationTranscript,
    pub(super) guesses: &'a [TierGuess],
    /// The earlier version of the file, if the corpus has it.
    pub(super) base: Option<&'a AnnotationTranscript>,
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
    job: &ImportJob<'_>,
    transcript: &AnnotationTranscript,
    there: &BTreeMap<String, TierRow>,
) -> CorpusResult<bool> {
    for tier in &transcript.tiers {
        let Some(row) = there.get(&tier.name) else {
            continue;
        };
        let ids: BTreeSet<&str> = tier
            .annotations
            .iter()
            .map(|annotation| annotation.id.as_str())
            .collect();
        let rows = stored_tiers::load_tier_annotation_rows(job.connection, row.id)?;
        let is_known = |row: &AnnotationRow| {
            let id = row.external_id.as_deref();
            id.is_some_and(|id| ids.contains(id))
        };
        // An emptied tier has no ids left that could contradict the file.
        if rows.is_empty() || rows.iter().any(is_known) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Returns the tiers of a file that were renamed in the corpus: the name in the file, and the present name. The earlier
/// version of the file has the tier, and most of its annotations lie on the other tier with their ids.
pub(super) fn find_renamed_tiers(
    job: &ImportJob<'_>,
    transcript: &AnnotationTranscript,
    base: &AnnotationTranscript,
    there: &BTreeMap<String, TierRow>,
) -> CorpusResult<Vec<(String, String)>> {
    let in_file = |name: &str| {
        let mut both = transcript.tiers.iter().chain(&base.tiers);
        both.any(|tier| tier.name == name)
    };
    let mut free: Vec<(&String, Vec<AnnotationRow>)> = Vec::new();
    for (name, row) in there.iter().filter(|(name, _)| !in_file(name)) {
        free.push((name, stored_tiers::load_tier_annotation_rows(job.connection, row.id)?));
    }
    let mut renames = Vec::new();
    for tier in &transcript.tiers {
        let before = base.tiers.iter().find(|candidate| candidate.name == tier.name);
        let Some(before) = before.filter(|_| !there.contains_key(&tier.name)) else {
            continue;
        };
        let ids: BTreeSet<&str> = before
            .annotations
            .iter()
            .map(|annotation| annotation.id.as_str())
            .collect();
        let shared = |rows: &[AnnotationRow]| {
            let named = rows.iter().filter_map(|row| row.external_id.as_deref());
            named.filter(|id| ids.contains(id)).count()
        };
        let counts = free.iter().map(|(_, rows)| shared(rows));
        let Some((at, most)) = counts.enumerate().max_by_key(|(_, count)| *count) else {
            break;
        };
        // Fewer shared ids do not show that it is the same tier.
        if most > 0 && 2 * most >= ids.len() {
            // No other tier of the file can be the same tier of the corpus.
            let (name, _) = free.remove(at);
            renames.push((tier.name.clone(), name.clone()));
        }
    }
    Ok(renames)
}

/// Returns the number of annotations that are the same in two files (id, time and value), and that of the file with
/// more.
pub(super) fn count_same_annotations(a: &AnnotationTranscript, b: &AnnotationTranscript) -> (usize, usize) {
    let parts_of = |transcript: &'_ AnnotationTranscript| -> BTreeMap<(String, String), ComparedParts> {
        let base = EarlierFileAnnotations::base_from_transcript(transcript);
        base.parts
    };
    let mut a = a.clone();
    // The annotations of a tier that was only renamed are still the same.
    for (from, to) in renamed_tiers(&a, b) {
        for tier in a.tiers.iter_mut().filter(|tier| tier.name == from) {
            tier.name.clone_from(&to);
        }
    }
    let (a, b) = (parts_of(&a), parts_of(b));
    let same = a.iter().filter(|(key, parts)| b.get(*key) == Some(*parts));
    (same.count(), a.len().max(b.len()))
}

/// Updates annotations from an edited file. They are matched by id; those that the corpus added since are matched by
/// time. Annotations that the file no longer has are removed, unless it never had them.
pub(super) fn update_annotations(
    job: &mut ImportJob<'_>,
    sides: &UpdateSides<'_>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<EafUpdateResult> {
    let mut work = AnnotationUpdate {
        sides,
        base: sides.base.map(EarlierFileAnnotations::base_from_transcript),
        rows: BTreeMap::new(),
        names: BTreeMap::new(),
        left: Vec::new(),
        done: EafUpdateResult {
            changes: ReimportChanges::default(),
            edits: Vec::new(),
            conflicts: Vec::new(),
            listed: Vec::new(),
            kept: 0,
            written: BTreeSet::new(),
        },
    };
    // Annotations of the file may lie below a tier that the file no longer has.
    let file_tiers = &sides.transcript.tiers;
    for (_, row) in sides
        .known
        .iter()
        .filter(|(name, _)| file_tiers.iter().all(|tier| tier.name != **name))
    {
        for row in stored_tiers::load_tier_annotation_rows(job.connection, row.id)? {
            work.note_row_id(&row);
        }
    }
    // The row of a parent must be known before the annotations below it are written.
    let order = sides.transcript.tiers_parents_first();
    for &tier in &order {
        job.report_progress(progress)?;
        let name = &sides.transcript.tiers[tier].name;
        let old = match sides.known.get(name) {
            Some(row) => stored_tiers::load_tier_annotation_rows(job.connection, row.id)?,
            None => Vec::new(),
        };
        work.update_tier_annotations(job, tier, old, progress)?;
    }
    // Children go before their parents.
    for (tier, row) in std::mem::take(&mut work.left).into_iter().rev() {
        work.remove_missing_annotation(job, &tier, &row)?;
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

/// An annotation on one side of an update: its row, and what is compared of it.
#[derive(Clone, Copy)]
struct VersionedAnnotation<'a> {
    /// The row.
    row: &'a AnnotationRow,
    /// Its parts that are compared.
    parts: &'a ComparedParts,
}

impl ComparedParts {
    fn in_file(transcript: &AnnotationTranscript, annotation: &TranscriptAnnotation) -> Self {
        let above = annotation.parent.and_then(|place| {
            let tier = transcript.tiers.get(place.tier)?;
            Some(tier.annotations.get(place.index)?.id.clone())
        });
        Self {
            time: [annotation.span.span_start_instant(), annotation.span.span_end_instant()]
                .map(RecordingInstant::instant_millis),
            value: annotation.value.clone(),
            above,
        }
    }

    /// Returns the content of a row; missing values are written as in files.
    fn in_corpus(row: &AnnotationRow, names: &BTreeMap<i64, String>) -> Self {
        Self {
            time: row_times_millis(row),
            value: row.file_text().to_owned(),
            above: row.parent_id.and_then(|id| names.get(&id).cloned()),
        }
    }

    fn saying(&self) -> AnnotationSide {
        let [start_us, end_us] = self.time.map(|millis| millis.saturating_mul(1000));
        AnnotationSide {
            start_us,
            end_us,
            value: self.value.clone(),
        }
    }

    /// Reports whether `theirs` would overwrite a change from `base` to `mine`.
    fn is_lost(mine: &Self, base: Option<&Self>, theirs: &Self) -> bool {
        // Without the earlier version, any difference may be an edit of the user.
        let Some(base) = base else {
            return mine != theirs;
        };
        (mine.time != base.time && mine.time != theirs.time)
            || (mine.value != base.value && mine.value != theirs.value)
            || (mine.above != base.above && mine.above != theirs.above)
    }
}

fn row_times_millis(row: &AnnotationRow) -> [i64; 2] {
    [row.start_us, row.end_us].map(|micros| RecordingInstant::from_micros(micros).instant_millis())
}

/// The annotations of the earlier file, by tier and id.
struct EarlierFileAnnotations {
    parts: BTreeMap<(String, String), ComparedParts>,
}

impl EarlierFileAnnotations {
    fn base_from_transcript(transcript: &AnnotationTranscript) -> Self {
        let all = transcript.tiers.iter().flat_map(|tier| {
            tier.annotations.iter().map(|annotation| {
                let key = (tier.name.clone(), annotation.id.clone());
                (key, ComparedParts::in_file(transcript, annotation))
            })
        });
        Self { parts: all.collect() }
    }
}

/// Returns the three-way merge of a value, and whether both sides changed it in different ways; `mine` stays then.
fn merge_three_ways<'t, T: PartialEq>(base: Option<&T>, mine: &'t T, theirs: &'t T) -> (&'t T, bool) {
    if mine == theirs || base == Some(theirs) {
        (mine, false)
    } else if base == Some(mine) {
        (theirs, false)
    } else {
        (mine, true)
    }
}

struct AnnotationUpdate<'s> {
    sides: &'s UpdateSides<'s>,
    base: Option<EarlierFileAnnotations>,
    /// The rows of annotations by their place in the file.
    rows: BTreeMap<AnnotationAddress, i64>,
    /// The ids of rows in the file.
    names: BTreeMap<i64, String>,
    /// Annotations that the file no longer has, with the names of their tiers.
    left: Vec<(String, AnnotationRow)>,
    done: EafUpdateResult,
}

impl AnnotationUpdate<'_> {
    fn parts_before(&self, tier: &str, id: &str) -> Option<&ComparedParts> {
        let key = (tier.to_owned(), id.to_owned());
        self.base.as_ref()?.parts.get(&key)
    }

    /// Notes the id of a row in the file.
    fn note_row_id(&mut self, row: &AnnotationRow) {
        let name = row.external_id.clone();
        self.names
            // An annotation that was made here has no id in files, and must still differ from all others.
            .insert(row.id, name.unwrap_or_else(|| format!("#{}", row.id)));
    }

    /// Reports whether a row was added or edited in the corpus.
    fn is_own(&self, tier: &str, row: &AnnotationRow) -> bool {
        let external_id = row.external_id.as_deref();
        match external_id.and_then(|id| self.parts_before(tier, id)) {
            Some(before) => ComparedParts::in_corpus(row, &self.names) != *before,
            None => external_id.is_none() || self.base.is_some(),
        }
    }

    fn update_tier_annotations(
        &mut self,
        job: &mut ImportJob<'_>,
        tier: usize,
        old: Vec<AnnotationRow>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let sides = self.sides;
        let it = &sides.transcript.tiers[tier];
        for row in &old {
            self.note_row_id(row);
        }
        let symbolic = it.stereotype.is_some_and(|stereotype| {
            matches!(
                stereotype,
                TierStereotype::SymbolicAssociation | TierStereotype::SymbolicSubdivision
            )
        });
        let edited_rows: Vec<(i64, [i64; 2])> = old
            .iter()
            // The times on symbolic tiers follow from the parent, so they never take room from others.
            .filter(|row| sides.merge && !symbolic && self.is_own(&it.name, row))
            .map(|row| (row.id, row_times_millis(row)))
            .collect();
        let meets_own = |row: i64, time: [i64; 2]| {
            let meets = |span: &(i64, [i64; 2])| span.0 != row && span.1[0] < time[1] && time[0] < span.1[1];
            edited_rows.iter().any(meets)
        };
        let mut old = StandingAnnotations::index_standing_rows(old);
        for (index, annotation) in it.annotations.iter().enumerate() {
            if index % 256 == 255 {
                job.report_progress(progress)?;
            }
            let above = annotation.parent.and_then(|place| self.rows.get(&place));
            let parent = above.copied();
            let plain_row = annotation_row(annotation, sides.tier_rows[tier], parent);
            let new = with_coded_state(plain_row, &sides.guesses[tier]);
            let theirs = ComparedParts::in_file(sides.transcript, annotation);
            let row = match old.take_matching_row(annotation, &new) {
                Some(before) => {
                    // Annotations below it are compared by the id of their parent, which is now the one in
                    // the file.
                    self.names.insert(before.id, annotation.id.clone());
                    let free = !meets_own(before.id, theirs.time);
                    Some(self.update_existing_annotation(job, tier, before, new, &theirs, free)?)
                }
                None => {
                    // In a merge the parent may have been left out, and nothing can hang below it then.
                    let orphan = annotation.parent.is_some() && parent.is_none();
                    let free = !orphan && !meets_own(0, theirs.time);
                    self.add_file_annotation(job, &it.name, new, &theirs, free)?
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
            .map(|annotation| {
                [
                    annotation.span.span_start_instant().instant_micros(),
                    annotation.span.span_end_instant().instant_micros(),
                ]
            })
            .collect();
        for row in old.rows.into_values() {
            let meets = |span: &[i64; 2]| row.start_us < span[1] && span[0] < row.end_us;
            // An annotation made here that overlaps nothing of the file stays, since the file cannot have removed
            // it.
            if row.external_id.is_some() || spans.iter().any(meets) {
                self.left.push((it.name.clone(), row));
            } else {
                self.done.kept += 1;
            }
        }
        Ok(())
    }

    /// Adds an annotation that the corpus lacks. A merge leaves it out if it was removed here or has no room.
    fn add_file_annotation(
        &mut self,
        job: &ImportJob<'_>,
        tier: &str,
        new: AnnotationRow,
        theirs: &ComparedParts,
        free: bool,
    ) -> CorpusResult<Option<i64>> {
        let name = new.external_id.clone().unwrap_or_default();
        let before = self.parts_before(tier, &name).cloned();
        if self.sides.merge {
            if before.as_ref() == Some(theirs) {
                return Ok(None);
            }
            // Both sides changed it: it was removed here and edited in the file.
            if before.is_some() || !free {
                self.record_own_edit(tier, None, Some(theirs), EditOutcome::Conflict);
                self.done.conflicts.push((None, Some(new)));
                return Ok(None);
            }
        } else if before.is_some() {
            self.record_own_edit(tier, None, Some(theirs), EditOutcome::Lost);
        }
        self.done.changes.added += 1;
        self.list_update_change(tier, &new, format!("{:?} added", new.value));
        Ok(Some(stored_tiers::insert_annotation(job.connection, &new)?))
    }

    /// Updates an annotation that exists in the corpus.
    fn update_existing_annotation(
        &mut self,
        job: &ImportJob<'_>,
        tier: usize,
        before: AnnotationRow,
        new: AnnotationRow,
        theirs: &ComparedParts,
        free: bool,
    ) -> CorpusResult<i64> {
        let (id, tier) = (before.id, &self.sides.transcript.tiers[tier].name);
        let mine = ComparedParts::in_corpus(&before, &self.names);
        let named = before.external_id.is_some();
        if mine == *theirs {
            self.done.changes.unchanged += 1;
            // The next version of the file can then be matched by this id.
            if !named {
                let row = AnnotationRow {
                    external_id: new.external_id,
                    ..before
                };
                stored_tiers::update_annotation(job.connection, &row)?;
            }
            return Ok(id);
        }
        let base_parts = self.parts_before(tier, new.external_id.as_deref().unwrap_or_default());
        let base = base_parts.cloned();
        let lost = ComparedParts::is_lost(&mine, base.as_ref(), theirs);
        let mut take = [true; 3];
        if self.sides.merge {
            let base = base.as_ref();
            let time = merge_three_ways(base.map(|parts| &parts.time), &mine.time, &theirs.time);
            let value = merge_three_ways(base.map(|parts| &parts.value), &mine.value, &theirs.value);
            let above = merge_three_ways(base.map(|parts| &parts.above), &mine.above, &theirs.above);
            // A time that stays as it is cannot newly overlap an edit.
            let room = free || *time.0 == mine.time;
            if time.1 || value.1 || above.1 || !room {
                self.record_own_edit(tier, Some(&mine), Some(theirs), EditOutcome::Conflict);
                self.done.conflicts.push((Some(id), Some(new.clone())));
            } else if lost {
                self.record_own_edit(tier, Some(&mine), Some(theirs), EditOutcome::Kept);
            }
            take = [
                *time.0 == theirs.time && room,
                *value.0 == theirs.value,
                *above.0 == theirs.above,
            ];
        } else if lost {
            self.record_own_edit(tier, Some(&mine), Some(theirs), EditOutcome::Lost);
        }
        let before = VersionedAnnotation {
            row: &before,
            parts: &mine,
        };
        let new = VersionedAnnotation {
            row: &new,
            parts: theirs,
        };
        self.write_annotation_parts(job, tier, before, new, take)?;
        Ok(id)
    }

    /// Writes the parts taken from a file's annotation: time, value and parent, as the flags say.
    fn write_annotation_parts(
        &mut self,
        job: &ImportJob<'_>,
        tier: &str,
        before: VersionedAnnotation<'_>,
        new: VersionedAnnotation<'_>,
        [time, value, above]: [bool; 3],
    ) -> CorpusResult<()> {
        let (mine, theirs) = (before.parts, new.parts);
        let (before, new) = (before.row, new.row);
        let moved = time && mine.time != theirs.time;
        let renamed = value && mine.value != theirs.value;
        let elsewhere = above && before.parent_id != new.parent_id;
        // The state and the source belong to the value, so they are taken together with it.
        let mut row = if renamed { new.clone() } else { before.clone() };
        row.id = before.id;
        row.external_id.clone_from(&new.external_id);
        row.parent_id = if above { new.parent_id } else { before.parent_id };
        let times = if moved { new } else { before };
        (row.start_us, row.end_us) = (times.start_us, times.end_us);
        (row.file_start_ms, row.file_end_ms) = (times.file_start_ms, times.file_end_ms);
        row.position = if above { new.position } else { before.position };
        if row != *before {
            stored_tiers::update_annotation(job.connection, &row)?;
        }
        // A new id or position alone is no change that the user would recognise.
        if !(moved || renamed || elsewhere) {
            self.done.changes.unchanged += 1;
            return Ok(());
        }
        self.done.changes.changed += 1;
        let what = match (renamed, moved) {
            (true, true) => format!("{:?} became {:?}, and moved", mine.value, new.value),
            (true, false) => format!("{:?} became {:?}", mine.value, new.value),
            (false, true) => format!("{:?} moved from {}", row.value, update_instant(before.start_us)),
            (false, false) => format!("{:?} hangs below another", row.value),
        };
        self.list_update_change(tier, &row, what);
        Ok(())
    }

    /// Removes an annotation that the file no longer has, together with its children.
    fn remove_missing_annotation(&mut self, job: &ImportJob<'_>, tier: &str, row: &AnnotationRow) -> CorpusResult<()> {
        let external_id = row.external_id.as_deref();
        let before = external_id.and_then(|id| self.parts_before(tier, id)).cloned();
        let mine = ComparedParts::in_corpus(row, &self.names);
        let is_edited = match &before {
            Some(before) => mine != *before,
            // Without an earlier state of it, only what came from a file counts as unedited.
            None => row.external_id.is_none() || row.origin != AnnotationOrigin::File,
        };
        let below = stored_tiers::load_child_annotations(job.connection, row.id)?;
        // Annotations of the user may hang below it, and would go with it.
        if self.sides.merge && (is_edited || !below.is_empty()) {
            if is_edited && before.is_some() {
                self.record_own_edit(tier, Some(&mine), None, EditOutcome::Conflict);
                self.done.conflicts.push((Some(row.id), None));
            } else {
                self.done.kept += 1;
            }
            return Ok(());
        }
        for row in &below {
            let name = stored_tiers::load_tier_row(job.connection, row.tier_id)?.name;
            self.remove_missing_annotation(job, &name, row)?;
        }
        if is_edited {
            self.record_own_edit(tier, Some(&mine), None, EditOutcome::Lost);
        }
        self.list_update_change(tier, row, format!("{:?} removed", row.value));
        stored_tiers::delete_annotation(job.connection, row.id)?;
        self.done.changes.removed += 1;
        Ok(())
    }

    fn record_own_edit(
        &mut self,
        tier: &str,
        mine: Option<&ComparedParts>,
        theirs: Option<&ComparedParts>,
        outcome: EditOutcome,
    ) {
        self.done.edits.push(OwnEdit {
            tier: tier.to_owned(),
            mine: mine.map(ComparedParts::saying),
            theirs: theirs.map(ComparedParts::saying),
            outcome,
        });
    }

    fn list_update_change(&mut self, tier: &str, row: &AnnotationRow, what: String) {
        self.done
            .listed
            .push(format!("tier {tier:?} at {}: {what}", update_instant(row.start_us)));
    }
}

fn update_instant(micros: i64) -> RecordingInstant {
    RecordingInstant::from_micros(micros)
}

impl EafUpdateResult {
    /// Adds the file's changes to the report.
    pub(super) fn report_update_changes(self, sides: &UpdateSides<'_>, report: &mut FileReport) {
        let ReimportChanges {
            added,
            changed,
            removed,
            unchanged,
        } = self.changes;
        let mut note = |text: String| report.findings.push(ReportFinding::finding_note(text));
        note(format!(
            "its annotations were there before: {changed} changed, {added} added, {removed} removed, \
             {unchanged} as they were"
        ));
        pass_first_lines(&self.listed, &mut note);
        if self.kept > 0 {
            let (many, is) = if self.kept == 1 {
                ("annotation", "is")
            } else {
                ("annotations", "are")
            };
            note(format!("{} {many} that the file does not have {is} kept", self.kept));
        }
        let file_tiers = &sides.transcript.tiers;
        let names: BTreeSet<&str> = file_tiers.iter().map(|tier| tier.name.as_str()).collect();
        for name in sides.known.keys().filter(|name| !names.contains(name.as_str())) {
            note(format!("the tier {name:?}, which the file has not, is kept"));
        }
        report.understood.changes = Some(self.changes);
        report.add_own_edits(self.edits);
    }
}

/// The annotations of a tier that are not matched with one of the file yet.
struct StandingAnnotations {
    rows: BTreeMap<i64, AnnotationRow>,
    by_name: BTreeMap<String, i64>,
    by_time: BTreeMap<[i64; 2], i64>,
}

impl StandingAnnotations {
    fn index_standing_rows(rows: Vec<AnnotationRow>) -> Self {
        let mut standing = Self {
            rows: BTreeMap::new(),
            by_name: BTreeMap::new(),
            by_time: BTreeMap::new(),
        };
        for row in rows {
            match &row.external_id {
                Some(name) => standing.by_name.insert(name.clone(), row.id),
                None => standing.by_time.insert(row_times_millis(&row), row.id),
            };
            standing.rows.insert(row.id, row);
        }
        standing
    }

    /// Removes and returns the row for an annotation: the one with its id, otherwise one without an id at the same
    /// time.
    fn take_matching_row(&mut self, annotation: &TranscriptAnnotation, new: &AnnotationRow) -> Option<AnnotationRow> {
        let named_id = self.by_name.remove(&annotation.id);
        let id = named_id.or_else(|| self.by_time.remove(&row_times_millis(new)))?;
        self.rows.remove(&id)
    }
}
