//! Merges two corpora that have diverged: a change that only one side made is taken over; conflicting changes of both
//! sides wait for a decision.

#[cfg(test)]
#[path = "tests/laws.rs"]
mod laws;
mod merge_captures;
mod merge_conflicts;
mod merge_entries;
mod merge_rows;
mod merge_studies;
mod merge_whole;
#[cfg(test)]
#[path = "tests/removals.rs"]
mod removals;
mod rules;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use rusqlite::Connection;
use serde::Serialize;
use serde_json::Value;

pub use merge_conflicts::{ConflictCandidate, CorpusConflict};
use merge_conflicts::{StoredConflict, remove_annotation_tree, store_conflict};
pub(crate) use merge_conflicts::{keep_annotation, undecided_conflicts, undecided_disputes};

use crate::Corpus;
use crate::db::stored_merge::{self as db, MergeSide, RowImage, TableRowKey};
use crate::db::{edits, signs, stored_recordings, stored_studies as study_rows, stored_tiers, stored_tracks};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::tokens;
use crate::words::effect::OperationEffect;

/// The result of a merge of corpora.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct MergeReport {
    /// Number of rows of each kind that were added from the other corpus.
    pub added: BTreeMap<String, u64>,
    /// Number of rows of each kind that were changed as in the other corpus.
    pub changed: BTreeMap<String, u64>,
    /// Number of rows of each kind that were removed because the other corpus removed them.
    pub removed: BTreeMap<String, u64>,
    /// The rows that both corpora changed in different ways; this corpus's version stays in place until somebody
    /// decides.
    pub conflicts: Vec<CorpusConflict>,
    /// Remarks about the merge for the user.
    pub notes: Vec<String>,
}

/// The tables that are merged; a table comes after those it refers to. Tokens of annotations are not merged but
/// derived.
const MERGED_TABLE_ORDER: [&str; 23] = [
    "lexicon",
    "signer",
    "person_alias",
    "person_attribute",
    "skeleton",
    "inventory",
    "inventory_value",
    "recording",
    "source_file",
    "track",
    "channel",
    "tier",
    "annotation",
    "sign",
    "sign_relation",
    "token",
    "recipe",
    "kept_search",
    "attribute",
    "notation",
    "study",
    "study_participant",
    "study_answer",
];

impl Corpus {
    /// Merges another corpus into this one as one operation. One of them is a copy of the other, or both are copies of
    /// a third.
    ///
    /// Rows correspond if they have the same uid. A change that only one side made is taken over, field by field. Three
    /// kinds of change are conflicts: different changes of both sides, a change of a row that the other side removed,
    /// and an annotation that would break a rule of its tier, such as one without room. In a conflict this corpus stays as
    /// it is, and the other candidate is stored until [`decide_conflicts`](Self::decide_conflicts) is called; a recording or tier that one
    /// side removed and in which the other changed something stays whole, or comes back whole, until then. The common state
    /// of the two is that after the last operation that their histories share, or `base`.
    ///
    /// # Errors
    /// Fails if the corpora have no common beginning and there is no `base`.
    pub fn merge_corpus(
        &mut self,
        other: &Path,
        base: Option<&Path>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<MergeReport> {
        let author = "merge";
        let open = |path: &Path| Self::open_unchanged(path, self.corpus_file_path(), author);
        let theirs = open(other)?;
        let base = base.map(open).transpose()?;
        let from = other
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default();
        self.store.operation_with_progress(progress, |connection, progress| {
            edits::defer_references(connection)?;
            let there = theirs.store.read_connection();
            let (mine, theirs, back) = match &base {
                Some(base) => {
                    let base = base.store.read_connection();
                    let theirs = MergeSide::merge_side_against(there, base)?;
                    (MergeSide::merge_side_against(connection, base)?, theirs, None)
                }
                None => {
                    let (own, fork) =
                        db::find_common_operation(connection, there)?.ok_or_else(|| no_beginning(other))?;
                    // An earlier merge, in either direction, gives a later common state.
                    let last_merge = db::merged_before(there, fork, connection)?;
                    let back_start = db::merged_before(connection, own, there)?;
                    let back = back_start
                        .map(|own| MergeSide::merge_side_since(connection, own))
                        .transpose()?;
                    let theirs = MergeSide::merge_side_since(there, last_merge.unwrap_or(fork))?;
                    (MergeSide::merge_side_since(connection, own)?, theirs, back)
                }
            };
            let mut work = MergeWork {
                connection,
                mine,
                theirs,
                back,
                from: from.clone(),
                report: MergeReport::default(),
                recordings: BTreeSet::new(),
                looked_at: BTreeSet::new(),
                came: BTreeMap::new(),
                back_again: BTreeSet::new(),
                roots: BTreeSet::new(),
                renamed: BTreeSet::new(),
                signs: Vec::new(),
                joined_captures: BTreeSet::new(),
            };
            work.merge_all_rows(progress)?;
            db::note_merged(connection, there)?;
            let report = work.report;
            let effect = merge_effect(from, &report);
            Ok((report, effect))
        })
    }
}

fn no_beginning(other: &Path) -> CorpusError {
    CorpusError::from_wrong_message("the two corpora have no common beginning: neither is a copy of the other")
        .with_error_place(other.display().to_string())
        .with_advice(
            "name the copy that both come from with --base; else export its recordings as .eaf \
             and import these with --merge",
        )
}

fn merge_effect(from: String, report: &MergeReport) -> OperationEffect {
    let total = |all: &BTreeMap<String, u64>| all.values().sum::<u64>();
    let [added, changed, removed] = [&report.added, &report.changed, &report.removed].map(total);
    let conflicts = report.conflicts.len() as u64;
    OperationEffect::Merge {
        from,
        added,
        changed,
        removed,
        conflicts,
    }
}

struct MergeWork<'c> {
    connection: &'c Connection,
    mine: MergeSide<'c>,
    theirs: MergeSide<'c>,
    /// The changes of this side since the other side merged it.
    back: Option<MergeSide<'c>>,
    from: String,
    report: MergeReport,
    /// The recordings whose tokens must be derived again.
    recordings: BTreeSet<i64>,
    /// The recordings whose tiers must keep their rules.
    looked_at: BTreeSet<i64>,
    /// The annotations that were added or moved as on the other side, with their row before; nothing if they were added.
    came: BTreeMap<String, Option<RowImage>>,
    /// The rows that this side removed and that come back, because the other side changed something in them.
    back_again: BTreeSet<TableRowKey>,
    /// The topmost of these rows.
    roots: BTreeSet<TableRowKey>,
    /// The names of signers whom both sides renamed: that of this side and that of the other. Their tiers follow.
    renamed: BTreeSet<[String; 2]>,
    /// The signs that were added from the other side.
    signs: Vec<i64>,
    /// The recordings of this side that the other side imported from the same bytes.
    joined_captures: BTreeSet<i64>,
}

impl MergeWork<'_> {
    fn merge_all_rows(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()> {
        self.leave_out_forgotten()?;
        self.bring_back()?;
        let touched: Vec<TableRowKey> = self.theirs.touched.keys().cloned().collect();
        let mut gone: Vec<TableRowKey> = Vec::new();
        let mut done = 0u64;
        for table in MERGED_TABLE_ORDER {
            if table == "attribute" {
                self.rederive_touched_tokens()?;
            }
            let mut waiting: Vec<TableRowKey> = touched.iter().filter(|key| key.0 == table).cloned().collect();
            // Rows of one table may refer to each other: those higher up go first.
            loop {
                let before = waiting.len();
                let mut later = Vec::new();
                for key in waiting {
                    done += 1;
                    if done.is_multiple_of(256) {
                        progress.report_amount(ProgressUnit::Items, "merging", done, Some(touched.len() as u64))?;
                    }
                    if self.theirs.find_row_image(table, &key.1)?.is_none() {
                        gone.push(key);
                    } else if !self.merge_row(&key)? {
                        later.push(key);
                    }
                }
                if later.is_empty() || later.len() == before {
                    for key in later {
                        self.homeless(&key)?;
                    }
                    break;
                }
                waiting = later;
            }
        }
        let contested = self.contested_removed_rows(&gone.iter().cloned().collect())?;
        let mut above = BTreeMap::new();
        let mut removed = Vec::new();
        for key in gone {
            if !self.is_contested_row(&key, &contested, &mut above)? {
                removed.push(key);
            }
        }
        for key in &contested {
            self.store_row_disagreement(key, None)?;
        }
        // Rows that refer to others go before these.
        for table in MERGED_TABLE_ORDER.iter().rev() {
            let of_table = removed.iter().filter(|key| key.0 == *table);
            let mut waiting: Vec<TableRowKey> = of_table.cloned().collect();
            loop {
                let before = waiting.len();
                let mut later = Vec::new();
                for key in waiting {
                    if !self.remove_merged_row(&key)? {
                        later.push(key);
                    }
                }
                // A round that removes nothing shows that something here still needs the rest.
                if later.is_empty() || later.len() == before {
                    for key in later {
                        self.store_row_disagreement(&key, None)?;
                    }
                    break;
                }
                waiting = later;
            }
        }
        for key in std::mem::take(&mut self.roots) {
            self.came_back(&key)?;
        }
        let looked_at = std::mem::take(&mut self.looked_at);
        self.keep_rules(&looked_at)?;
        self.recordings.extend(looked_at);
        self.rederive_touched_tokens()?;
        // A sign that only a conflict's candidate names is created again when that candidate is taken.
        for sign in std::mem::take(&mut self.signs) {
            signs::delete_empty_sign(self.connection, sign)?;
        }
        self.report.conflicts = merge_conflicts::list_conflicts(self.connection)?
            .into_iter()
            .filter(|conflict| conflict.decided.is_none() && conflict.from == self.from)
            .collect();
        Ok(())
    }

    /// Derives the tokens of the touched recordings again from their tiers.
    fn rederive_touched_tokens(&mut self) -> CorpusResult<()> {
        for recording in std::mem::take(&mut self.recordings) {
            self.looked_at.insert(recording);
            let inventories = inventories::load_of(self.connection, recording)?;
            tokens::update_recording_tokens(self.connection, recording, None, &inventories)?;
        }
        Ok(())
    }

    /// Merges a row of the other side. Returns false if the row refers to one that has not been merged yet.
    fn merge_row(&mut self, key: &TableRowKey) -> CorpusResult<bool> {
        let (table, uid) = (key.0.as_str(), key.1.as_str());
        let Some(theirs) = self.theirs.find_row_image(table, uid)? else {
            return Ok(true);
        };
        let bases = self.common_base_images(key)?;
        let follows = theirs.get("annotation_id").is_some_and(|value| !value.is_null());
        if bases.contains(&theirs) || (table == "token" && follows) {
            return Ok(true);
        }
        let Some(local) = self.resolve_row_image(table, &theirs)? else {
            return Ok(false);
        };
        // A row that both sides created separately has the uid of this side from now on.
        let theirs = self.mine.image_with_uid_references(table, local.clone())?;
        match self.mine.find_row_image(table, uid)? {
            Some(mine) if table == "study" && self.is_other_plan(&bases, &mine, &theirs)? => {
                self.study_with_other_plan(&theirs)?;
            }
            Some(mine) => self.merge_changed_row(key, &bases, &mine, &theirs)?,
            None if bases.is_empty() => self.add_merged_row(key, &theirs, local)?,
            // A signer that both sides created separately has another uid here, also at the next merge.
            None if table == "signer" => match db::find_namesake_row(self.connection, table, &local)? {
                Some(there) => self.join_same_named_row(key, &bases, &theirs, there)?,
                None => self.store_row_disagreement(key, Some(&theirs))?,
            },
            None => self.store_row_disagreement(key, Some(&theirs))?,
        }
        Ok(true)
    }

    /// Returns the common states of a row: its state before the other side changed it, and its state on this side when
    /// the other side merged it.
    fn common_base_images(&self, key: &TableRowKey) -> CorpusResult<Vec<RowImage>> {
        if self.back_again.contains(key) {
            return Ok(Vec::new());
        }
        let mut bases: Vec<RowImage> = self.theirs.touched.get(key).cloned().flatten().into_iter().collect();
        if let Some(back) = &self.back {
            let known_row = match back.touched.get(key) {
                Some(before) => before.clone(),
                None => self.mine.find_row_image(&key.0, &key.1)?,
            };
            bases.extend(known_row);
        }
        Ok(bases)
    }

    /// Returns a row with uids replaced by row numbers of this corpus, or nothing if a row that it refers to does not
    /// exist here.
    fn resolve_row_image(&self, table: &str, image: &RowImage) -> CorpusResult<Option<RowImage>> {
        let mut local = image.clone();
        for (column, value) in &mut local {
            let Some(other) = crate::db::stored_history::refers_to(table, column) else {
                continue;
            };
            let Some(uid) = value.as_str().map(str::to_owned) else {
                continue;
            };
            let mut id = self.mine.find_row_id(other, &uid)?;
            // Tokens of annotations are derived on each side, and have other uids there.
            if id.is_none() && other == "token" {
                id = self.corresponding_token_row(&uid)?;
            }
            let Some(id) = id else { return Ok(None) };
            *value = Value::from(id);
        }
        Ok(Some(local))
    }

    /// Returns the row of this corpus's token that corresponds to the other corpus's token `uid`, if there is one: both
    /// belong to the same annotation.
    fn corresponding_token_row(&self, uid: &str) -> CorpusResult<Option<i64>> {
        let there = self.theirs.find_row_image("token", uid)?;
        let annotation = there.and_then(|row| Some(row.get("annotation_id")?.as_str()?.to_owned()));
        let Some(annotation) = annotation else {
            return Ok(None);
        };
        match self.mine.find_row_id("annotation", &annotation)? {
            Some(annotation) => db::token_of(self.connection, annotation),
            None => Ok(None),
        }
    }

    fn add_merged_row(&mut self, key: &TableRowKey, theirs: &RowImage, mut local: RowImage) -> CorpusResult<()> {
        let (table, uid) = (key.0.as_str(), key.1.as_str());
        if self.join_same_capture(key, theirs, &local)? || self.join_same_entry(key, theirs, &mut local)? {
            return Ok(());
        }
        let placed;
        let theirs = match table {
            "study_participant" if self.answered_another(uid, &mut local)? => {
                placed = self.mine.image_with_uid_references(table, local.clone())?;
                &placed
            }
            _ => theirs,
        };
        if let Some(there) = db::find_namesake_row(self.connection, table, &local)? {
            let text = |column: &str| local[column].as_str().unwrap_or_default().to_owned();
            match table {
                "recording" => {
                    let name = stored_recordings::free_recording_name(self.connection, &text("name"))?;
                    self.report.notes.push(format!(
                        "both have a recording {:?}: that of {} is {name:?} here",
                        text("name"),
                        self.from
                    ));
                    local.insert("name".into(), Value::from(name));
                }
                "track" => {
                    let recording = local["recording_id"].as_i64().unwrap_or_default();
                    let name = stored_tracks::free_track_name(self.connection, recording, &text("name"))?;
                    local.insert("name".into(), Value::from(name));
                }
                // Answers belong to their plan, and to the person whose order of trials the seed decided.
                "study" if self.differs(table, there, &local, "plan_sha256")? => {
                    let name = study_rows::free_study_name(self.connection, &text("name"))?;
                    self.report.notes.push(format!(
                        "both have a study {:?} with another plan: that of {} is {name:?} here",
                        text("name"),
                        self.from
                    ));
                    local.insert("name".into(), Value::from(name));
                }
                "study_participant" if self.differs(table, there, &local, "seed")? => {
                    let study = local["study_id"].as_i64().unwrap_or_default();
                    let code = study_rows::free_code(self.connection, study, &text("code"))?;
                    self.report.notes.push(format!(
                        "both have a participant {:?}, two people: that of {} is {code:?} here",
                        text("code"),
                        self.from
                    ));
                    local.insert("code".into(), Value::from(code));
                }
                _ => return self.join_same_named_row(key, &[], theirs, there),
            }
        }
        if table == "annotation" {
            // Both sides made the same annotation, for example by the same import.
            if let Some(twin) = merge_rows::find_twin_annotation(self.connection, &local)? {
                return self.mine.remember_row_uid(table, uid, Some(twin));
            }
            if let Some(other) = self.overlapped(None, &local)? {
                return self.store_row_conflict(key, None, Some(theirs), Some(other));
            }
            self.came.insert(uid.to_owned(), None);
        }
        let id = db::insert_row_image(self.connection, table, &local)?;
        if table == "sign" {
            self.signs.push(id);
        }
        self.mine.remember_row_uid(table, uid, Some(id))?;
        self.copy_row_parts(table, uid, id)?;
        self.mark_touched_recordings(table, &local, id)?;
        *self.report.added.entry(table.to_owned()).or_default() += 1;
        Ok(())
    }

    /// Returns whether a row of this side has another value in a column.
    fn differs(&self, table: &str, row: i64, image: &RowImage, column: &str) -> CorpusResult<bool> {
        let uid = db::uid_of(self.connection, table, row)?;
        let own_result = uid.map(|uid| self.mine.find_row_image(table, &uid)).transpose()?;
        let own_row = own_result.flatten();
        Ok(own_row.is_some_and(|own| own.get(column) != image.get(column)))
    }

    /// Merges a row with the row of the same name here: both sides created it separately.
    fn join_same_named_row(
        &mut self,
        key: &TableRowKey,
        bases: &[RowImage],
        theirs: &RowImage,
        there: i64,
    ) -> CorpusResult<()> {
        let (table, uid) = (key.0.as_str(), key.1.as_str());
        self.mine.remember_row_uid(table, uid, Some(there))?;
        self.copy_row_parts(table, uid, there)?;
        let Some(own) = db::uid_of(self.connection, table, there)? else {
            return Ok(());
        };
        let mut theirs = theirs.clone();
        theirs.insert("uid".into(), Value::from(own.clone()));
        match self.mine.find_row_image(table, &own)? {
            Some(mine) => self.merge_changed_row(&(table.to_owned(), own), bases, &mine, &theirs),
            None => Ok(()),
        }
    }

    fn copy_row_parts(&self, table: &str, uid: &str, id: i64) -> CorpusResult<()> {
        let Some(old) = self.theirs.find_row_id(table, uid)? else {
            return Ok(());
        };
        let original = db::StoredRowPlace {
            connection: self.theirs.connection,
            id: old,
        };
        let connection = self.connection;
        // The blocks of one capture are equal on both sides, and one copy of them suffices.
        if table == "track" && db::has_blocks(self.connection, id)? {
            return Ok(());
        }
        db::copy_parts(original, db::StoredRowPlace { connection, id }, table)
    }

    fn merge_changed_row(
        &mut self,
        key: &TableRowKey,
        bases: &[RowImage],
        mine: &RowImage,
        theirs: &RowImage,
    ) -> CorpusResult<()> {
        let (table, uid) = (key.0.as_str(), key.1.as_str());
        let Some(id) = self.mine.find_row_id(table, uid)? else {
            return Ok(());
        };
        // Two rows that were created separately have no common state: every column counts as changed.
        let nothing = [RowImage::new()];
        let bases = if bases.is_empty() { &nothing[..] } else { bases };
        let mut merges = bases
            .iter()
            .map(|base| merge_rows::merge_row_columns(table, base, mine, theirs));
        let first = merges.next().unwrap_or_default();
        // The state that explains the changes without a disagreement is the truly common one.
        let (taken, disagree) = match merges.next() {
            Some(second) if first.1 && !second.1 => second,
            _ => first,
        };
        let disagree = disagree && !self.only_renamed(table, bases, mine, theirs);
        let Some(local) = self.resolve_row_image(table, &taken)? else {
            return self.store_row_conflict(key, Some(mine), Some(theirs), None);
        };
        // Translations are parts of a sign, and those of both sides are kept.
        if table == "sign" {
            self.copy_row_parts(table, uid, id)?;
        }
        if !local.is_empty() {
            if merge_rows::is_backwards(mine, &local) {
                return self.store_row_conflict(key, Some(mine), Some(theirs), None);
            }
            if table == "annotation" && (local.contains_key("start_us") || local.contains_key("end_us")) {
                let mut full_row = self.resolve_row_image(table, mine)?.unwrap_or_default();
                full_row.extend(local.clone());
                if let Some(other) = self.overlapped(Some(id), &full_row)? {
                    return self.store_row_conflict(key, Some(mine), Some(theirs), Some(other));
                }
                let before = self.resolve_row_image(table, mine)?;
                self.came.insert(uid.to_owned(), before);
            }
            db::update_row_image(self.connection, table, id, &local)?;
            let mut full_row = mine.clone();
            full_row.extend(taken);
            if let Some(whole) = self.resolve_row_image(table, &full_row)? {
                self.mark_touched_recordings(table, &whole, id)?;
            }
            *self.report.changed.entry(table.to_owned()).or_default() += 1;
        }
        if disagree {
            self.store_row_conflict(key, Some(mine), Some(theirs), None)?;
        }
        Ok(())
    }

    /// Returns whether both sides disagree about nothing but the name of a signer, which is a conflict of its own.
    fn only_renamed(&mut self, table: &str, bases: &[RowImage], mine: &RowImage, theirs: &RowImage) -> bool {
        let both = |column: &str| {
            let text = |image: &RowImage| image.get(column).and_then(Value::as_str).unwrap_or_default().to_owned();
            [mine, theirs].map(text)
        };
        if table == "signer" && mine.get("name") != theirs.get("name") {
            self.renamed.insert(both("name"));
        }
        let names = both("participant");
        if table != "tier" || !self.renamed.contains(&names) {
            return false;
        }
        let mut same = mine.clone();
        let [_, name] = names;
        // With the other side's name in place, what still differs is a disagreement of its own.
        same.insert("participant".to_owned(), Value::from(name));
        bases
            .iter()
            .any(|base| !merge_rows::merge_row_columns(table, base, &same, theirs).1)
    }

    /// Returns the annotation created or changed on this side that a row of the other side would overlap.
    fn overlapped(&self, own: Option<i64>, row: &RowImage) -> CorpusResult<Option<i64>> {
        let number = |column: &str| row.get(column).and_then(Value::as_i64).unwrap_or_default();
        let (tier, start, end) = (number("tier_id"), number("start_us"), number("end_us"));
        let symbolic = stored_tiers::load_tier_row(self.connection, tier)?.stereotype;
        // Symbolic annotations have no times of their own, and share those of the ones above.
        if symbolic.is_some_and(|stereotype| !stereotype.is_alignable()) {
            return Ok(None);
        }
        for near in stored_tiers::annotations_near(self.connection, tier, start, end)? {
            let over = near.start_us < end && start < near.end_us && Some(near.id) != own;
            if !over {
                continue;
            }
            let uid = db::uid_of(self.connection, "annotation", near.id)?.unwrap_or_default();
            let key = ("annotation".to_owned(), uid);
            // Annotations that both sides had, or that came from there, fit each other on the other side.
            if !self.came.contains_key(&key.1) && self.mine.touched.contains_key(&key) {
                return Ok(Some(near.id));
            }
        }
        Ok(None)
    }

    /// Removes a row that the other side removed. Returns false if other rows here still refer to it.
    fn remove_merged_row(&mut self, key: &TableRowKey) -> CorpusResult<bool> {
        let (table, uid) = (key.0.as_str(), key.1.as_str());
        let bases = self.common_base_images(key)?;
        let Some(base) = bases.first() else {
            return Ok(true);
        };
        let Some(mine) = self.mine.find_row_image(table, uid)? else {
            return Ok(true);
        };
        let Some(id) = self.mine.find_row_id(table, uid)? else {
            return Ok(true);
        };
        if table == "token" && base.get("annotation_id").is_some_and(|value| !value.is_null()) {
            return Ok(true);
        }
        if table == "sign" && db::sign_is_used(self.connection, id)? {
            return Ok(true);
        }
        if bases
            .iter()
            .all(|base| merge_rows::has_row_content_changed(table, base, &mine))
        {
            self.store_row_disagreement(key, None)?;
            return Ok(true);
        }
        if table == "annotation" && !stored_tiers::load_child_annotations(self.connection, id)?.is_empty() {
            return Ok(false);
        }
        if let Some(local) = self.resolve_row_image(table, &mine)? {
            self.mark_touched_recordings(table, &local, id)?;
        }
        // Its derived tokens go with their annotations first, so that nothing refers to it.
        if table == "recording" {
            self.recordings.insert(id);
            self.rederive_touched_tokens()?;
            self.looked_at.remove(&id);
        }
        if db::is_referred_to(self.connection, table, id)? {
            // A skeleton goes with the last track that has it.
            return Ok(table == "skeleton");
        }
        db::delete_parts(self.connection, table, id)?;
        db::delete_table_row(self.connection, table, id)?;
        self.mine.remember_row_uid(table, uid, None)?;
        *self.report.removed.entry(table.to_owned()).or_default() += 1;
        Ok(true)
    }

    /// Stores a conflict about a row that both sides changed, or one changed and the other removed.
    fn store_row_disagreement(&mut self, key: &TableRowKey, theirs: Option<&RowImage>) -> CorpusResult<()> {
        let mine = self.mine.find_row_image(&key.0, &key.1)?;
        self.store_row_conflict(key, mine.as_ref(), theirs, None)
    }

    /// Stores a conflict about a row that refers to a row which this side removed.
    fn homeless(&mut self, key: &TableRowKey) -> CorpusResult<()> {
        let theirs = self.theirs.find_row_image(&key.0, &key.1)?;
        self.store_row_conflict(key, None, theirs.as_ref(), None)
    }

    fn store_row_conflict(
        &mut self,
        key: &TableRowKey,
        mine: Option<&RowImage>,
        theirs: Option<&RowImage>,
        other: Option<i64>,
    ) -> CorpusResult<()> {
        if key.0 == "token" || (mine.is_none() && theirs.is_none()) {
            return Ok(());
        }
        let base = self.theirs.touched.get(key).cloned().flatten();
        let open = StoredConflict {
            table: key.0.clone(),
            uid: key.1.clone(),
            base,
            mine: mine.cloned(),
            theirs: theirs.cloned(),
            other: match other {
                Some(id) => db::uid_of(self.connection, "annotation", id)?,
                None => None,
            },
            from: self.from.clone(),
            decided: None,
            came_back: mine.is_none() && self.back_again.contains(key),
        };
        store_conflict(self.connection, &open)
    }

    /// Marks the recordings whose tokens depend on a row.
    fn mark_touched_recordings(&mut self, table: &str, local: &RowImage, id: i64) -> CorpusResult<()> {
        let number = |column: &str| local.get(column).and_then(Value::as_i64);
        match table {
            "recording" => {
                self.recordings.insert(id);
            }
            "tier" => self.recordings.extend(number("recording_id")),
            "annotation" => {
                if let Some(tier) = number("tier_id") {
                    self.recordings
                        .insert(stored_tiers::load_tier_row(self.connection, tier)?.recording_id);
                }
            }
            "signer" => {
                let all = edits::recordings_of_signer(self.connection, id)?;
                self.recordings.extend(all);
            }
            _ => {}
        }
        Ok(())
    }
}
