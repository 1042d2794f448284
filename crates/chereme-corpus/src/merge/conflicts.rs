//! Conflicts of a merge: both candidates are kept, listed, and decided one by one.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::Instant;
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::rules;
use crate::Corpus;
use crate::db::delete::{cite_another, delete_recording};
use crate::db::history::refers_to;
use crate::db::merge::{self as db, Image, Side};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::db::{edits, recordings, signs};
use crate::error::{Error, Result};
use crate::inventories;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// The prefix of the keys under which conflicts are stored.
const PREFIX: &str = "conflict:";

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
    pub base: Option<Candidate>,
    /// The candidate of this corpus, which is in place; nothing if it was removed here.
    pub mine: Option<Candidate>,
    /// The candidate of the other corpus; nothing if it was removed there.
    pub theirs: Option<Candidate>,
    /// The corpus or file that the other candidate comes from.
    pub from: String,
    /// The decision, if somebody has decided.
    pub decided: Option<Decision>,
}

/// One side of a conflict.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Candidate {
    /// The start in microseconds, if it is an annotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_us: Option<i64>,
    /// The first microsecond after it, if it is an annotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_us: Option<i64>,
    /// The value of an annotation; for other rows the fields that differ.
    pub text: String,
}

impl std::fmt::Display for Candidate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.text)?;
        if let Some((start, end)) = self.start_us.zip(self.end_us) {
            let [start, end] = [start, end].map(Instant::from_micros);
            write!(f, " from {start} to {end}")?;
        }
        Ok(())
    }
}

/// The decision on a conflict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Decision {
    /// This corpus stays as it is.
    Mine,
    /// The other candidate replaces that of this corpus.
    Theirs,
    /// Both stay: the other annotation goes on its own tier if there is room, otherwise on a tier next to it.
    Both,
}

/// A conflict as it is stored.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Open {
    pub(crate) table: String,
    pub(crate) uid: String,
    pub(crate) base: Option<Image>,
    pub(crate) mine: Option<Image>,
    pub(crate) theirs: Option<Image>,
    /// The annotation here that is in the way of the other candidate.
    pub(crate) other: Option<String>,
    pub(crate) from: String,
    pub(crate) decided: Option<Decision>,
    /// Whether this side removed it and it came back, because the other side changed something in it.
    #[serde(default)]
    pub(crate) came_back: bool,
}

/// Stores a conflict, unless the same one is stored already.
pub(crate) fn keep(connection: &Connection, open: &Open) -> Result<()> {
    let all = db::notes(connection, PREFIX)?;
    let same = |known: &Open| {
        (&known.table, &known.uid, &known.theirs) == (&open.table, &open.uid, &open.theirs)
    };
    if all
        .iter()
        .filter(|(_, text)| text.contains(&open.uid))
        .filter_map(|(_, text)| read(text))
        .any(|it| same(&it))
    {
        return Ok(());
    }
    let number = all.len() + 1;
    let text = serde_json::to_string(open).map_err(|error| Error::wrong(error.to_string()))?;
    db::set_note(connection, &format!("{PREFIX}{number:06}"), &text)
}

/// Stores a conflict about an annotation between this corpus and a file that was imported again.
pub(crate) fn keep_annotation(
    connection: &Connection,
    from: &str,
    mine: Option<i64>,
    theirs: Option<&AnnotationRow>,
) -> Result<()> {
    let side = Side::now(connection);
    let mut other = None;
    let theirs = match theirs {
        Some(row) => {
            let near = tiers::annotations_near(connection, row.tier_id, row.start_us, row.end_us)?;
            let over = near.iter().find(|it| {
                Some(it.id) != mine && it.start_us < row.end_us && row.start_us < it.end_us
            });
            if let Some(over) = over {
                other = db::uid_of(connection, "annotation", over.id)?;
            }
            Some(image(connection, row)?)
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
    let open = Open {
        table: "annotation".to_owned(),
        mine: side.row("annotation", &uid)?,
        base: None,
        theirs,
        other,
        from: from.to_owned(),
        decided: None,
        came_back: false,
        uid,
    };
    keep(connection, &open)
}

/// Returns an annotation with references by uid.
fn image(connection: &Connection, row: &AnnotationRow) -> Result<Image> {
    let value = serde_json::to_value(row).map_err(|error| Error::wrong(error.to_string()))?;
    let mut image = value.as_object().cloned().unwrap_or_default();
    image.remove("id");
    let tier = db::uid_of(connection, "tier", row.tier_id)?;
    image.insert("tier_id".into(), tier.map_or(Value::Null, Value::String));
    let parent = match row.parent_id {
        Some(parent) => db::uid_of(connection, "annotation", parent)?,
        None => None,
    };
    image.insert(
        "parent_id".into(),
        parent.map_or(Value::Null, Value::String),
    );
    Ok(image)
}

/// Returns a uid for an annotation that only the other side has: the same one at every import of its file. Without an id
/// of a file the start and the value stand for it.
fn made_uid(image: &Image) -> String {
    let (tier, id) = (image.get("tier_id"), image.get("external_id"));
    let text = match id.filter(|id| !id.is_null()) {
        Some(_) => format!("{tier:?} {id:?}"),
        None => format!(
            "{tier:?} {:?} {:?}",
            image.get("start_us"),
            image.get("value")
        ),
    };
    crate::db::motion::hex(&Sha256::digest(text.as_bytes())[..16]).to_uppercase()
}

fn read(text: &str) -> Option<Open> {
    serde_json::from_str(text).ok()
}

/// Returns all conflicts, including decided ones.
pub(crate) fn list(connection: &Connection) -> Result<Vec<CorpusConflict>> {
    let side = Side::now(connection);
    let mut all = Vec::new();
    for (key, text) in db::notes(connection, PREFIX)? {
        let Some(open) = read(&text) else { continue };
        let number = key[PREFIX.len()..].parse().unwrap_or(0);
        let known = open
            .mine
            .as_ref()
            .or(open.base.as_ref())
            .or(open.theirs.as_ref());
        let mine = match &open.other {
            Some(other) => side.row("annotation", other)?.or(open.mine.clone()),
            None => open.mine.clone(),
        };
        let against = |own: &Option<Image>, other: &Option<Image>| {
            own.as_ref()
                .map(|it| candidate(&open.table, it, other.as_ref()))
        };
        all.push(CorpusConflict {
            number,
            what: open.table.replace('_', " "),
            place: match known {
                Some(known) => place(connection, &side, &open.table, known)?,
                None => String::new(),
            },
            recording: match known {
                Some(known) => recording(connection, &side, (&open.table, &open.uid), known)?,
                None => None,
            },
            base: against(&open.base, &mine),
            mine: against(&mine, &open.theirs),
            theirs: against(&open.theirs, &mine),
            from: open.from,
            decided: open.decided,
        });
    }
    Ok(all)
}

/// Returns the conflicts that nobody has decided yet.
pub(crate) fn waiting(connection: &Connection) -> Result<Vec<CorpusConflict>> {
    let mut all = list(connection)?;
    all.retain(|it| it.decided.is_none());
    Ok(all)
}

/// A signer, recording or tier on which two corpora disagree.
pub(crate) struct Dispute {
    pub(crate) table: &'static str,
    /// The row here.
    pub(crate) id: i64,
    /// The row of the recording that a tier belongs to.
    pub(crate) recording: Option<i64>,
    /// The row as it is here now.
    pub(crate) mine: Image,
    /// The row of the other corpus; empty if it was removed there.
    pub(crate) theirs: Image,
}

/// Returns the signers, recordings and tiers on which nobody has decided yet.
pub(crate) fn disputes(connection: &Connection) -> Result<Vec<Dispute>> {
    let side = Side::now(connection);
    let mut all = Vec::new();
    for (_, text) in db::notes(connection, PREFIX)? {
        let Some(open) = read(&text).filter(|it| it.decided.is_none()) else {
            continue;
        };
        let tables = ["signer", "recording", "tier"];
        let table = tables.into_iter().find(|it| *it == open.table);
        let Some((table, id)) = table.zip(side.id(&open.table, &open.uid)?) else {
            continue;
        };
        let mine = side.row(table, &open.uid)?.unwrap_or_default();
        all.push(Dispute {
            recording: recording(connection, &side, (table, &open.uid), &mine)?,
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
    let Ok(all) = serde_json::from_str::<Image>(json) else {
        return json.to_owned();
    };
    let said = all
        .iter()
        .filter_map(|(key, value)| Some(format!("{key} {}", value.as_str()?)));
    said.collect::<Vec<String>>().join(", ")
}

fn candidate(table: &str, own: &Image, other: Option<&Image>) -> Candidate {
    let text = |column: &str| own.get(column).and_then(Value::as_str).unwrap_or_default();
    if table == "annotation" {
        let value = match text("state") {
            "not-applicable" => "n/a",
            "unclear" => "unclear",
            _ => text("value"),
        };
        return Candidate {
            start_us: own.get("start_us").and_then(Value::as_i64),
            end_us: own.get("end_us").and_then(Value::as_i64),
            text: value.to_owned(),
        };
    }
    let differs =
        |column: &str, value: &Value| other.is_none_or(|it| it.get(column) != Some(value));
    let shown = |column: &str, value: &Value| match value {
        Value::String(json) if column == "consent" => in_words(json),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let silent = ["uid", "data", "document", "source", "hash"];
    let said: Vec<String> = own
        .iter()
        .filter(|(column, value)| differs(column, value) && !value.is_null())
        .filter(|(column, _)| {
            !silent.contains(&column.as_str()) && refers_to(table, column).is_none()
        })
        .map(|(column, value)| format!("{column} {}", shown(column, value)))
        .collect();
    Candidate {
        start_us: None,
        end_us: None,
        text: said.join(", "),
    }
}

fn place(connection: &Connection, side: &Side<'_>, table: &str, row: &Image) -> Result<String> {
    let text = |column: &str| row.get(column).and_then(Value::as_str);
    if table == "annotation" {
        let tier = text("tier_id")
            .map(|uid| side.id("tier", uid))
            .transpose()?;
        let Some(tier) = tier.flatten() else {
            return Ok("a tier that is gone".to_owned());
        };
        let tier = tiers::tier(connection, tier)?;
        let recording = recordings::recording(connection, tier.recording_id)?;
        return Ok(format!("{}: {}", recording.name, tier.name));
    }
    let name = ["name", "gloss", "key", "text"].into_iter().find_map(text);
    let name = name.unwrap_or_default();
    let above = text("recording_id").map(|uid| side.id("recording", uid));
    Ok(match above.transpose()?.flatten() {
        Some(above) => format!("{}: {name}", recordings::recording(connection, above)?.name),
        None => name.to_owned(),
    })
}

/// Returns the recording that a row belongs to; nothing if it belongs to no recording, or its recording was removed.
fn recording(
    connection: &Connection,
    side: &Side<'_>,
    (table, uid): (&str, &str),
    row: &Image,
) -> Result<Option<i64>> {
    let above = |column: &str| row.get(column).and_then(Value::as_str);
    if table == "recording" {
        return side.id("recording", uid);
    }
    if let Some(tier) = above("tier_id") {
        return match side.id("tier", tier)? {
            Some(tier) => Ok(Some(tiers::tier(connection, tier)?.recording_id)),
            None => Ok(None),
        };
    }
    match above("recording_id") {
        Some(uid) => side.id("recording", uid),
        None => Ok(None),
    }
}

impl Corpus {
    /// Returns the conflicts of merges that nobody has decided yet, or all of them if `decided`.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn conflicts(&self, decided: bool) -> Result<Vec<CorpusConflict>> {
        let mut all = list(self.store.read())?;
        all.retain(|it| decided || it.decided.is_none());
        Ok(all)
    }

    /// Decides conflicts as one operation, and returns them.
    ///
    /// # Errors
    /// Fails if there is no such open conflict, or if both candidates cannot stand: only annotations can exist twice.
    pub fn decide(&mut self, numbers: &[usize], decision: Decision) -> Result<Vec<CorpusConflict>> {
        self.store.operation(|connection| {
            edits::defer_references(connection)?;
            let mut known = BTreeMap::new();
            for number in numbers {
                let key = format!("{PREFIX}{number:06}");
                let found = db::notes(connection, &key)?;
                let open = found.first().and_then(|(_, text)| read(text));
                let mut open = open.filter(|it| it.decided.is_none()).ok_or_else(|| {
                    Error::wrong(format!("there is no open conflict {number}"))
                        .at(number.to_string())
                        .advise(Remedy::command("`chereme conflicts CORPUS` lists them"))
                })?;
                for recording in recordings_of(connection, &open)? {
                    if let Entry::Vacant(free) = known.entry(recording) {
                        free.insert(rules::broken(connection, recording)?);
                    }
                }
                let done = match decision {
                    Decision::Mine if open.came_back => without(connection, &open),
                    Decision::Mine => Ok(()),
                    Decision::Theirs | Decision::Both if open.came_back => Ok(()),
                    Decision::Theirs => theirs(connection, &open),
                    Decision::Both => both(connection, &open),
                };
                done.map_err(|error| error.at(format!("conflict {number}")))?;
                open.decided = Some(decision);
                let text = serde_json::to_string(&open)
                    .map_err(|error| Error::wrong(error.to_string()))?;
                db::set_note(connection, &key, &text)?;
            }
            rules::check(connection, &known)?;
            let all = list(connection)?.into_iter();
            let all: Vec<CorpusConflict> = all.filter(|it| numbers.contains(&it.number)).collect();
            let conflicts = numbers.to_vec();
            Ok((
                all,
                OperationEffect::Decide {
                    conflicts,
                    decision,
                },
            ))
        })
    }
}

/// Returns a stored row with uids replaced by row numbers of this corpus.
fn local(side: &Side<'_>, table: &str, image: &Image) -> Result<Image> {
    let mut local = image.clone();
    for (column, value) in &mut local {
        let Some(other) = refers_to(table, column) else {
            continue;
        };
        let Some(uid) = value.as_str().map(str::to_owned) else {
            continue;
        };
        let id = side.id(other, &uid)?.ok_or_else(|| {
            Error::wrong(format!("the {other} that it belongs to was removed here"))
                .advise("add by hand what the other side has, or decide for mine")
        })?;
        *value = Value::from(id);
    }
    Ok(local)
}

/// Returns whether an annotation still overlaps a candidate: an earlier decision may have moved it away.
fn still_overlaps(connection: &Connection, other: i64, theirs: Option<&Image>) -> Result<bool> {
    let time = |column: &str| theirs?.get(column)?.as_i64();
    let (Some(start), Some(end)) = (time("start_us"), time("end_us")) else {
        return Ok(true);
    };
    let row = tiers::annotation(connection, other)?;
    Ok(row.start_us < end && start < row.end_us)
}

fn theirs(connection: &Connection, open: &Open) -> Result<()> {
    let side = Side::now(connection);
    let id = side.id(&open.table, &open.uid)?;
    if let Some(other) = &open.other
        && let Some(other) = side.id("annotation", other)?
        && Some(other) != id
        && still_overlaps(connection, other, open.theirs.as_ref())?
    {
        remove(connection, other)?;
    }
    match (&open.theirs, id) {
        (Some(theirs), Some(id)) => {
            let mut image = local(&side, &open.table, theirs)?;
            image.remove("uid");
            let mine = side.row(&open.table, &open.uid)?.unwrap_or_default();
            if open.table != "annotation" {
                let base = open.base.clone().unwrap_or_default();
                image.retain(|column, _| {
                    theirs.get(column) != base.get(column) && theirs.get(column) != mine.get(column)
                });
            }
            db::update(connection, &open.table, id, &image)?;
            let name = |image: &Image| image.get("name").and_then(Value::as_str).map(str::to_owned);
            if open.table == "signer"
                && let (Some(old), Some(new)) = (name(&mine), name(&image))
            {
                edits::rename_participant(connection, &old, &new)?;
            }
        }
        (Some(theirs), None) => {
            let image = local(&side, &open.table, theirs)?;
            db::insert(connection, &open.table, &image)?;
        }
        (None, Some(_)) => return without(connection, open),
        (None, None) => {}
    }
    follow(connection, open)
}

/// Removes the row of a conflict with all of its parts.
fn without(connection: &Connection, open: &Open) -> Result<()> {
    if let Some(id) = Side::now(connection).id(&open.table, &open.uid)? {
        remove_whole(connection, &open.table, id)?;
    }
    follow(connection, open)
}

fn remove_whole(connection: &Connection, table: &str, id: i64) -> Result<()> {
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
        "annotation" => return remove(connection, id),
        // It follows from its annotation, which stays.
        "token" if signs::token(connection, id)?.annotation_id.is_some() => return Ok(()),
        _ => {}
    }
    for (part, _, id) in db::owned(connection, table, id)? {
        remove_whole(connection, part, id)?;
    }
    if db::is_referred_to(connection, table, id)? {
        return Err(Error::wrong(format!(
            "the {} holds more than the other side removed",
            table.replace('_', " ")
        ))
        .advise("remove by hand what is in it, or decide for mine"));
    }
    db::delete_parts(connection, table, id)?;
    db::delete(connection, table, id)
}

/// Removes an annotation with those below it.
pub(super) fn remove(connection: &Connection, id: i64) -> Result<()> {
    for child in tiers::children(connection, id)? {
        remove(connection, child.id)?;
    }
    tiers::delete_annotation(connection, id)
}

fn both(connection: &Connection, open: &Open) -> Result<()> {
    let side = Side::now(connection);
    let Some(theirs) = open.theirs.as_ref().filter(|_| open.table == "annotation") else {
        return match open.table.as_str() {
            // One side removed it: there is no second candidate to add.
            _ if open.theirs.is_none() || open.mine.is_none() => Ok(()),
            other => Err(Error::wrong(format!(
                "there can be one {} only",
                other.replace('_', " ")
            ))
            .advise("decide for mine or theirs")),
        };
    };
    let mut image = local(&side, "annotation", theirs)?;
    let number =
        |image: &Image, column: &str| image.get(column).and_then(Value::as_i64).unwrap_or(0);
    let tier = tiers::tier(connection, number(&image, "tier_id"))?;
    let (start, end) = (number(&image, "start_us"), number(&image, "end_us"));
    let near = tiers::annotations_near(connection, tier.id, start, end)?;
    let meets = near.iter().any(|it| it.start_us < end && start < it.end_us);
    let symbolic = tier.stereotype.is_some_and(|it| !it.is_alignable());
    if meets || symbolic {
        let next = next_to(connection, &tier)?;
        image.insert("tier_id".into(), Value::from(next));
        image.insert("parent_id".into(), Value::Null);
        image.insert("position".into(), Value::from(0));
    }
    image.remove("uid");
    image.insert("external_id".into(), Value::Null);
    db::insert(connection, "annotation", &image)?;
    follow(connection, open)
}

/// Returns the tier for second candidates of a tier; creates it if it is missing.
fn next_to(connection: &Connection, tier: &TierRow) -> Result<i64> {
    let name = format!("{} (theirs)", tier.name);
    let all = tiers::tiers(connection, tier.recording_id)?;
    if let Some(known) = all.iter().find(|it| it.name == name) {
        return Ok(known.id);
    }
    let last = all.iter().map(|it| it.position).max().unwrap_or(0);
    tiers::insert_tier(
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
fn recordings_of(connection: &Connection, open: &Open) -> Result<BTreeSet<i64>> {
    let side = Side::now(connection);
    let images = [&open.theirs, &open.mine, &open.base].into_iter().flatten();
    let mut all = BTreeSet::new();
    for image in images {
        let name = (open.table.as_str(), open.uid.as_str());
        all.extend(recording(connection, &side, name, image)?);
    }
    Ok(all)
}

/// Derives the tokens of the conflict's recording again.
fn follow(connection: &Connection, open: &Open) -> Result<()> {
    if !["annotation", "tier"].contains(&open.table.as_str()) {
        return Ok(());
    }
    for recording in recordings_of(connection, open)? {
        let inventories = inventories::load_of(connection, recording)?;
        tokens::derive(connection, recording, None, &inventories)?;
    }
    Ok(())
}
