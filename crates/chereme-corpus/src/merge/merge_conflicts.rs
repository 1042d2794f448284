//! Conflicts of a merge: both candidates are kept, listed, and decided one by one.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::RecordingInstant;
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::rules;
use crate::Corpus;
use crate::db::stored_delete::{cite_another, delete_recording};
use crate::db::stored_history::refers_to;
use crate::db::stored_merge::{self as db, MergeSide, RowImage};
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::db::{edits, signs, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::tokens;
use crate::words::effect::{ConflictDecision, OperationEffect};

/// The prefix of the keys under which conflicts are stored.
const CONFLICT_KEY_PREFIX: &str = "conflict:";

/// Something on which two sides of a merge do not agree.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CorpusConflict {
    /// Its number, which a decision names.
    pub number: usize,
    /// The kind of thing: `annotation`, `tier`, `recording`, `signer`, `sign` and so on.
    pub what: String,
    /// The place: the tier and recording of an annotation, otherwise the name.
    pub place: String,
    /// The row of the recording that it belongs to, or that it is.
    pub recording: Option<i64>,
    /// The common state; nothing if the row did not exist then.
    pub base: Option<ConflictCandidate>,
    /// The candidate of this corpus, which is in place; nothing if it was removed here.
    pub mine: Option<ConflictCandidate>,
    /// The candidate of the other corpus; nothing if it was removed there.
    pub theirs: Option<ConflictCandidate>,
    /// The corpus or file that the other candidate comes from.
    pub from: String,
    /// The decision, if somebody has decided.
    pub decided: Option<ConflictDecision>,
}

/// One side of a conflict.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ConflictCandidate {
    /// The start in microseconds, if it is an annotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_us: Option<i64>,
    /// The first microsecond after it, if it is an annotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_us: Option<i64>,
    /// The value of an annotation; for other rows the fields that differ.
    pub text: String,
}

impl std::fmt::Display for ConflictCandidate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.text)?;
        if let Some((start, end)) = self.start_us.zip(self.end_us) {
            let [start, end] = [start, end].map(RecordingInstant::from_micros);
            write!(f, " from {start} to {end}")?;
        }
        Ok(())
    }
}

/// A conflict as it is stored.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct StoredConflict {
    pub(crate) table: String,
    pub(crate) uid: String,
    pub(crate) base: Option<RowImage>,
    pub(crate) mine: Option<RowImage>,
    pub(crate) theirs: Option<RowImage>,
    /// The annotation here that is in the way of the other candidate.
    pub(crate) other: Option<String>,
    pub(crate) from: String,
    pub(crate) decided: Option<ConflictDecision>,
    /// Whether this side removed it and it came back, because the other side changed something in it.
    #[serde(default)]
    pub(crate) came_back: bool,
}

/// Stores a conflict, unless the same one is stored already.
pub(crate) fn store_conflict(connection: &Connection, open: &StoredConflict) -> CorpusResult<()> {
    let all = db::list_corpus_notes(connection, CONFLICT_KEY_PREFIX)?;
    let same =
        |known: &StoredConflict| (&known.table, &known.uid, &known.theirs) == (&open.table, &open.uid, &open.theirs);
    if all
        .iter()
        .filter(|(_, text)| text.contains(&open.uid))
        .filter_map(|(_, text)| parse_stored_conflict(text))
        .any(|conflict| same(&conflict))
    {
        return Ok(());
    }
    // Conflicts are never deleted one by one, so that the count gives a free number.
    let number = all.len() + 1;
    let text = serde_json::to_string(open).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    db::set_note(connection, &format!("{CONFLICT_KEY_PREFIX}{number:06}"), &text)
}

/// Stores a conflict about an annotation between this corpus and a file that was imported again.
pub(crate) fn keep_annotation(
    connection: &Connection,
    from: &str,
    mine: Option<i64>,
    theirs: Option<&AnnotationRow>,
) -> CorpusResult<()> {
    let side = MergeSide::present_merge_side(connection);
    let mut other = None;
    let theirs = match theirs {
        Some(row) => {
            let near = stored_tiers::annotations_near(connection, row.tier_id, row.start_us, row.end_us)?;
            let over = near.iter().find(|neighbour| {
                Some(neighbour.id) != mine && neighbour.start_us < row.end_us && row.start_us < neighbour.end_us
            });
            if let Some(over) = over {
                other = db::uid_of(connection, "annotation", over.id)?;
            }
            Some(annotation_image(connection, row)?)
        }
        None => None,
    };
    let uid = match (mine, &theirs) {
        (Some(id), _) => db::uid_of(connection, "annotation", id)?,
        (None, Some(image)) => Some(made_uid(image)),
        (None, None) => None,
    };
    let Some(uid) = uid else { return Ok(()) };
    let theirs = theirs.map(|mut image| {
        image.insert("uid".into(), Value::from(uid.clone()));
        image
    });
    let open = StoredConflict {
        table: "annotation".to_owned(),
        mine: side.find_row_image("annotation", &uid)?,
        base: None,
        theirs,
        other,
        from: from.to_owned(),
        decided: None,
        came_back: false,
        uid,
    };
    store_conflict(connection, &open)
}

/// Returns an annotation with references by uid.
fn annotation_image(connection: &Connection, row: &AnnotationRow) -> CorpusResult<RowImage> {
    let value = serde_json::to_value(row).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let mut image = value.as_object().cloned().unwrap_or_default();
    // Numbers of rows hold in this corpus alone; uids hold in every copy.
    image.remove("id");
    let tier = db::uid_of(connection, "tier", row.tier_id)?;
    image.insert("tier_id".into(), tier.map_or(Value::Null, Value::String));
    let parent = match row.parent_id {
        Some(parent) => db::uid_of(connection, "annotation", parent)?,
        None => None,
    };
    image.insert("parent_id".into(), parent.map_or(Value::Null, Value::String));
    Ok(image)
}

/// Returns a uid for an annotation that only the other side has: the same one at every import of its file. Without an id
/// of a file the start and the value stand for it.
fn made_uid(image: &RowImage) -> String {
    let (tier, id) = (image.get("tier_id"), image.get("external_id"));
    let text = match id.filter(|id| !id.is_null()) {
        Some(_) => format!("{tier:?} {id:?}"),
        None => format!("{tier:?} {:?} {:?}", image.get("start_us"), image.get("value")),
    };
    crate::db::stored_motion::to_hex_text(&Sha256::digest(text.as_bytes())[..16]).to_uppercase()
}

fn parse_stored_conflict(text: &str) -> Option<StoredConflict> {
    serde_json::from_str(text).ok()
}

/// Returns all conflicts, including decided ones.
pub(crate) fn list_conflicts(connection: &Connection) -> CorpusResult<Vec<CorpusConflict>> {
    let side = MergeSide::present_merge_side(connection);
    let mut all = Vec::new();
    for (key, text) in db::list_corpus_notes(connection, CONFLICT_KEY_PREFIX)? {
        let Some(open) = parse_stored_conflict(&text) else {
            continue;
        };
        let number = key[CONFLICT_KEY_PREFIX.len()..].parse().unwrap_or(0);
        let known_row = open.mine.as_ref().or(open.base.as_ref()).or(open.theirs.as_ref());
        // The candidate in place is the annotation in the way, which need not be the same row.
        let mine = match &open.other {
            Some(other) => side.find_row_image("annotation", other)?.or(open.mine.clone()),
            None => open.mine.clone(),
        };
        let against = |own: &Option<RowImage>, other: &Option<RowImage>| {
            let candidate = |image| conflict_candidate(&side, &open.table, image, other.as_ref());
            own.as_ref().map(candidate).transpose()
        };
        all.push(CorpusConflict {
            number,
            what: open.table.replace('_', " "),
            place: match known_row {
                Some(known) => conflict_place(connection, &side, &open.table, known)?,
                None => String::new(),
            },
            recording: match known_row {
                Some(known) => recording_of_row(connection, &side, &open.table, &open.uid, known)?,
                None => None,
            },
            base: against(&open.base, &mine)?,
            mine: against(&mine, &open.theirs)?,
            theirs: against(&open.theirs, &mine)?,
            from: open.from,
            decided: open.decided,
        });
    }
    Ok(all)
}

/// Returns the conflicts that nobody has decided yet.
pub(crate) fn undecided_conflicts(connection: &Connection) -> CorpusResult<Vec<CorpusConflict>> {
    let mut all = list_conflicts(connection)?;
    all.retain(|conflict| conflict.decided.is_none());
    Ok(all)
}

/// A signer, recording or tier on which two corpora disagree.
pub(crate) struct MergeDispute {
    pub(crate) table: &'static str,
    /// The row here.
    pub(crate) id: i64,
    /// The row of the recording that a tier belongs to.
    pub(crate) recording: Option<i64>,
    /// The row as it is here now.
    pub(crate) mine: RowImage,
    /// The row of the other corpus; empty if it was removed there.
    pub(crate) theirs: RowImage,
}

/// Returns the signers, recordings and tiers on which nobody has decided yet.
pub(crate) fn undecided_disputes(connection: &Connection) -> CorpusResult<Vec<MergeDispute>> {
    let side = MergeSide::present_merge_side(connection);
    let mut all = Vec::new();
    for (_, text) in db::list_corpus_notes(connection, CONFLICT_KEY_PREFIX)? {
        let Some(open) = parse_stored_conflict(&text).filter(|conflict| conflict.decided.is_none()) else {
            continue;
        };
        let tables = ["signer", "recording", "tier"];
        let table = tables.into_iter().find(|name| *name == open.table);
        let Some((table, id)) = table.zip(side.find_row_id(&open.table, &open.uid)?) else {
            continue;
        };
        let mine = side.find_row_image(table, &open.uid)?.unwrap_or_default();
        all.push(MergeDispute {
            recording: recording_of_row(connection, &side, table, &open.uid, &mine)?,
            theirs: open.theirs.unwrap_or_default(),
            table,
            id,
            mine,
        });
    }
    Ok(all)
}

/// Returns a consent as words, such as `movement public, day 2026-11-27`.
fn in_words(json: &str) -> String {
    let Ok(all) = serde_json::from_str::<RowImage>(json) else {
        return json.to_owned();
    };
    let clauses = all
        .iter()
        .filter_map(|(key, value)| Some(format!("{key} {}", value.as_str()?)));
    clauses.collect::<Vec<String>>().join(", ")
}

fn conflict_candidate(
    side: &MergeSide<'_>,
    table: &str,
    own: &RowImage,
    other: Option<&RowImage>,
) -> CorpusResult<ConflictCandidate> {
    let text = |column: &str| own.get(column).and_then(Value::as_str).unwrap_or_default();
    if table == "annotation" {
        let value = match text("state") {
            "not-applicable" => "n/a",
            "unclear" => "unclear",
            _ => text("value"),
        };
        return Ok(ConflictCandidate {
            start_us: own.get("start_us").and_then(Value::as_i64),
            end_us: own.get("end_us").and_then(Value::as_i64),
            text: value.to_owned(),
        });
    }
    let differs = |column: &str, value: &Value| other.is_none_or(|image| image.get(column) != Some(value));
    let shown = |column: &str, value: &Value| match value {
        Value::String(json) if column == "consent" => in_words(json),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    // Nobody can choose between two hashes or documents by looking at them.
    let silent = ["uid", "data", "document", "source", "hash"];
    let mut clauses = Vec::new();
    for (column, value) in own
        .iter()
        .filter(|(column, value)| differs(column, value) && !value.is_null())
    {
        match refers_to(table, column) {
            // A row is chosen by its name, such as that of the signer.
            Some(referred) => {
                let uid = value.as_str().unwrap_or_default();
                let image = side.find_row_image(referred, uid)?.unwrap_or_default();
                if let Some(name) = row_image_name(&image) {
                    clauses.push(format!("{referred} {name}"));
                }
            }
            None if silent.contains(&column.as_str()) => {}
            None => clauses.push(format!("{column} {}", shown(column, value))),
        }
    }
    Ok(ConflictCandidate {
        start_us: None,
        end_us: None,
        text: clauses.join(", "),
    })
}

/// Returns the text by which people know a row.
fn row_image_name(row: &RowImage) -> Option<&str> {
    let columns = ["name", "gloss", "label", "key", "text"];
    columns.into_iter().find_map(|column| row.get(column)?.as_str())
}

fn conflict_place(connection: &Connection, side: &MergeSide<'_>, table: &str, row: &RowImage) -> CorpusResult<String> {
    let text = |column: &str| row.get(column).and_then(Value::as_str);
    if table == "annotation" {
        let tier = text("tier_id").map(|uid| side.find_row_id("tier", uid)).transpose()?;
        let Some(tier) = tier.flatten() else {
            return Ok("a tier that is gone".to_owned());
        };
        let tier = stored_tiers::load_tier_row(connection, tier)?;
        let recording = stored_recordings::load_recording_row(connection, tier.recording_id)?;
        return Ok(format!("{}: {}", recording.name, tier.name));
    }
    let name = row_image_name(row).unwrap_or_default();
    let above = text("recording_id").map(|uid| side.find_row_id("recording", uid));
    Ok(match above.transpose()?.flatten() {
        Some(above) => format!(
            "{}: {name}",
            stored_recordings::load_recording_row(connection, above)?.name
        ),
        None => name.to_owned(),
    })
}

/// Returns the recording that a row belongs to; nothing if it belongs to no recording, or its recording was removed.
fn recording_of_row(
    connection: &Connection,
    side: &MergeSide<'_>,
    table: &str,
    uid: &str,
    row: &RowImage,
) -> CorpusResult<Option<i64>> {
    let above = |column: &str| row.get(column).and_then(Value::as_str);
    if table == "recording" {
        return side.find_row_id("recording", uid);
    }
    if let Some(tier) = above("tier_id") {
        return match side.find_row_id("tier", tier)? {
            Some(tier) => Ok(Some(stored_tiers::load_tier_row(connection, tier)?.recording_id)),
            None => Ok(None),
        };
    }
    match above("recording_id") {
        Some(uid) => side.find_row_id("recording", uid),
        None => Ok(None),
    }
}

impl Corpus {
    /// Returns the conflicts of merges that nobody has decided yet, or all of them if `decided`.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn merge_conflicts(&self, decided: bool) -> CorpusResult<Vec<CorpusConflict>> {
        let mut all = list_conflicts(self.store.read_connection())?;
        all.retain(|conflict| decided || conflict.decided.is_none());
        Ok(all)
    }

    /// Decides conflicts as one operation, and returns them.
    ///
    /// # Errors
    /// Fails if there is no such open conflict, or if both candidates cannot stand: only annotations can exist twice.
    pub fn decide_conflicts(
        &mut self,
        numbers: &[usize],
        decision: ConflictDecision,
    ) -> CorpusResult<Vec<CorpusConflict>> {
        self.store.run_store_operation(|connection| {
            edits::defer_references(connection)?;
            let (mut open_by_number, mut decided) = (BTreeMap::new(), Vec::new());
            for number in numbers {
                let key = format!("{CONFLICT_KEY_PREFIX}{number:06}");
                let stored_notes = db::list_corpus_notes(connection, &key)?;
                let read_conflict = stored_notes.first().and_then(|(_, text)| parse_stored_conflict(text));
                let mut open = read_conflict
                    .filter(|conflict| conflict.decided.is_none())
                    .ok_or_else(|| {
                        CorpusError::from_wrong_message(format!("there is no open conflict {number}"))
                            .with_error_place(number.to_string())
                            .with_command_advice("`chereme conflicts CORPUS` lists them")
                    })?;
                // The rules that are broken already are noted before the decisions, so that only new ones
                // count.
                for recording in recordings_of(connection, &open)? {
                    if let Entry::Vacant(free) = open_by_number.entry(recording) {
                        free.insert(rules::broken_tier_rules(connection, recording)?);
                    }
                }
                let done = match decision {
                    ConflictDecision::Mine if open.came_back => remove_conflict_row(connection, &open),
                    ConflictDecision::Mine => Ok(()),
                    ConflictDecision::Theirs | ConflictDecision::Both if open.came_back => Ok(()),
                    ConflictDecision::Theirs => theirs(connection, &open),
                    ConflictDecision::Both => keep_both_candidates(connection, &open),
                };
                done.map_err(|error| error.with_error_place(format!("conflict {number}")))?;
                open.decided = Some(decision);
                let text =
                    serde_json::to_string(&open).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
                db::set_note(connection, &key, &text)?;
                decided.push(open);
            }
            update_conflict_tokens(connection, &decided)?;
            rules::check_new_violations(connection, &open_by_number)?;
            let all_conflicts = list_conflicts(connection)?.into_iter();
            let all: Vec<CorpusConflict> = all_conflicts
                .filter(|conflict| numbers.contains(&conflict.number))
                .collect();
            let conflicts = numbers.to_vec();
            Ok((all, OperationEffect::Decide { conflicts, decision }))
        })
    }
}

/// Returns a stored row with uids replaced by row numbers of this corpus.
fn localize_row_image(side: &MergeSide<'_>, table: &str, image: &RowImage) -> CorpusResult<RowImage> {
    let mut local = image.clone();
    for (column, value) in &mut local {
        let Some(other) = refers_to(table, column) else {
            continue;
        };
        let Some(uid) = value.as_str().map(str::to_owned) else {
            continue;
        };
        let id = side.find_row_id(other, &uid)?.ok_or_else(|| {
            CorpusError::from_wrong_message(format!("the {other} that it belongs to was removed here"))
                .with_advice("add by hand what the other side has, or decide for mine")
        })?;
        *value = Value::from(id);
    }
    Ok(local)
}

/// Returns whether an annotation still overlaps a candidate: an earlier decision may have moved it away.
fn still_overlaps(connection: &Connection, other: i64, theirs: Option<&RowImage>) -> CorpusResult<bool> {
    let time = |column: &str| theirs?.get(column)?.as_i64();
    // Removed or without a time: nothing can show that it moved away.
    let (Some(start), Some(end)) = (time("start_us"), time("end_us")) else {
        return Ok(true);
    };
    let row = stored_tiers::load_annotation_row(connection, other)?;
    Ok(row.start_us < end && start < row.end_us)
}

fn theirs(connection: &Connection, open: &StoredConflict) -> CorpusResult<()> {
    let side = MergeSide::present_merge_side(connection);
    let id = side.find_row_id(&open.table, &open.uid)?;
    if let Some(other) = &open.other
        && let Some(other) = side.find_row_id("annotation", other)?
        && Some(other) != id
        && still_overlaps(connection, other, open.theirs.as_ref())?
    {
        remove_annotation_tree(connection, other)?;
    }
    match (&open.theirs, id) {
        (Some(theirs), Some(id)) => {
            let mut image = localize_row_image(&side, &open.table, theirs)?;
            image.remove("uid");
            let mine = side.find_row_image(&open.table, &open.uid)?.unwrap_or_default();
            // Only what the other side changed replaces fields here; the rest may have been edited since the
            // merge.
            if open.table != "annotation" {
                let base = open.base.clone().unwrap_or_default();
                image.retain(|column, _| {
                    theirs.get(column) != base.get(column) && theirs.get(column) != mine.get(column)
                });
            }
            db::update_row_image(connection, &open.table, id, &image)?;
            let name = |image: &RowImage| image.get("name").and_then(Value::as_str).map(str::to_owned);
            // Participants of tiers are linked to signers by name, and follow a new one.
            if open.table == "signer"
                && let (Some(old), Some(new)) = (name(&mine), name(&image))
            {
                edits::rename_participant(connection, &old, &new)?;
            }
        }
        (Some(theirs), None) => {
            let image = localize_row_image(&side, &open.table, theirs)?;
            db::insert_row_image(connection, &open.table, &image)?;
        }
        (None, Some(_)) => return remove_conflict_row(connection, open),
        (None, None) => {}
    }
    Ok(())
}

/// Removes the row of a conflict with all of its parts.
fn remove_conflict_row(connection: &Connection, open: &StoredConflict) -> CorpusResult<()> {
    if let Some(id) = MergeSide::present_merge_side(connection).find_row_id(&open.table, &open.uid)? {
        remove_whole(connection, &open.table, id)?;
    }
    Ok(())
}

fn remove_whole(connection: &Connection, table: &str, id: i64) -> CorpusResult<()> {
    match table {
        "recording" => {
            let tokens = signs::tokens_of_recording(connection, id)?;
            delete_recording(connection, id)?;
            for token in tokens {
                cite_another(connection, token.sign_id)?;
                signs::delete_empty_sign(connection, token.sign_id)?;
            }
            return Ok(());
        }
        "annotation" => return remove_annotation_tree(connection, id),
        // It follows from its annotation, which stays.
        "token" if signs::load_token_row(connection, id)?.annotation_id.is_some() => {
            return Ok(());
        }
        _ => {}
    }
    // Parts go first, and each with its own parts.
    for (part, _, id) in db::find_owned_rows(connection, table, id)? {
        remove_whole(connection, part, id)?;
    }
    if db::is_referred_to(connection, table, id)? {
        return Err(CorpusError::from_wrong_message(format!(
            "the {} holds more than the other side removed",
            table.replace('_', " ")
        ))
        .with_advice("remove by hand what is in it, or decide for mine"));
    }
    db::delete_parts(connection, table, id)?;
    db::delete_table_row(connection, table, id)
}

/// Removes an annotation with those below it.
pub(super) fn remove_annotation_tree(connection: &Connection, id: i64) -> CorpusResult<()> {
    for child in stored_tiers::load_child_annotations(connection, id)? {
        remove_annotation_tree(connection, child.id)?;
    }
    stored_tiers::delete_annotation(connection, id)
}

fn keep_both_candidates(connection: &Connection, open: &StoredConflict) -> CorpusResult<()> {
    let side = MergeSide::present_merge_side(connection);
    let Some(theirs) = open.theirs.as_ref().filter(|_| open.table == "annotation") else {
        return match open.table.as_str() {
            // One side removed it: there is no second candidate to add.
            _ if open.theirs.is_none() || open.mine.is_none() => Ok(()),
            other => Err(
                CorpusError::from_wrong_message(format!("there can be one {} only", other.replace('_', " ")))
                    .with_advice("decide for mine or theirs"),
            ),
        };
    };
    let mut image = localize_row_image(&side, "annotation", theirs)?;
    let number = |image: &RowImage, column: &str| image.get(column).and_then(Value::as_i64).unwrap_or(0);
    let tier = stored_tiers::load_tier_row(connection, number(&image, "tier_id"))?;
    let (start, end) = (number(&image, "start_us"), number(&image, "end_us"));
    let near = stored_tiers::annotations_near(connection, tier.id, start, end)?;
    let meets = near
        .iter()
        .any(|neighbour| neighbour.start_us < end && start < neighbour.end_us);
    let symbolic = tier.stereotype.is_some_and(|stereotype| !stereotype.is_alignable());
    // Where there is no room, or order stands for time, the second candidate gets a tier of its own.
    if meets || symbolic {
        let next = next_to(connection, &tier)?;
        image.insert("tier_id".into(), Value::from(next));
        image.insert("parent_id".into(), Value::Null);
        image.insert("position".into(), Value::from(0));
    }
    // It is a second row beside the first, and needs a uid and an id of its own.
    image.remove("uid");
    image.insert("external_id".into(), Value::Null);
    db::insert_row_image(connection, "annotation", &image)?;
    Ok(())
}

/// Returns the tier for second candidates of a tier; creates it if it is missing.
fn next_to(connection: &Connection, tier: &TierRow) -> CorpusResult<i64> {
    let name = format!("{} (theirs)", tier.name);
    let all = stored_tiers::load_tier_rows(connection, tier.recording_id)?;
    if let Some(known) = all.iter().find(|row| row.name == name) {
        return Ok(known.id);
    }
    let last = all.iter().map(|row| row.position).max().unwrap_or(0);
    stored_tiers::insert_tier(
        connection,
        &TierRow {
            recording_id: tier.recording_id,
            name,
            position: last + 1,
            role: tier.role.clone(),
            hand: tier.hand,
            participant: tier.participant.clone(),
            annotator: tier.annotator.clone(),
            language: tier.language.clone(),
            inventory_id: tier.inventory_id,
            ..TierRow::default()
        },
    )
}

/// Returns the recordings whose tiers a conflict is about.
fn recordings_of(connection: &Connection, open: &StoredConflict) -> CorpusResult<BTreeSet<i64>> {
    let side = MergeSide::present_merge_side(connection);
    let images = [&open.theirs, &open.mine, &open.base].into_iter().flatten();
    let mut all = BTreeSet::new();
    for image in images {
        all.extend(recording_of_row(connection, &side, &open.table, &open.uid, image)?);
    }
    Ok(all)
}

/// Derives the tokens of the recordings of decided conflicts again: a decision counts as an adjudication, even if it changes
/// no annotation.
fn update_conflict_tokens(connection: &Connection, decided: &[StoredConflict]) -> CorpusResult<()> {
    let mut changed = BTreeSet::new();
    for conflict in decided
        .iter()
        .filter(|conflict| ["annotation", "tier"].contains(&conflict.table.as_str()))
    {
        changed.extend(recordings_of(connection, conflict)?);
    }
    for recording in changed {
        let inventories = inventories::load_of(connection, recording)?;
        tokens::update_recording_tokens(connection, recording, None, &inventories)?;
    }
    Ok(())
}
