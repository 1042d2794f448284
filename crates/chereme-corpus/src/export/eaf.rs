//! Exports a recording's tiers as an ELAN file.
//!
//! Unchanged parts of an imported file are written byte for byte; a changed annotation changes only its own lines, in
//! the layout of the file.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Write;
use std::path::Path;

use chereme_formats::eaf::convert::{
    Annotation, AnnotationAddress, EntryValue, Media, Tier, Timing, Transcript, Vocabulary,
    VocabularyEntry,
};
use chereme_formats::eaf::{decode, from_raw, patched, raw, to_raw};
use chereme_formats::roles::{self, Mapping};
use chereme_motion::{Instant, Span};
use chereme_sign::Stereotype;
use rusqlite::Connection;
use serde_json::{Map, Value};

use crate::db::columns::{AnnotationOrigin, Origin, ValueState};
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::db::{damaged, list};
use crate::error::{Error, Result};
use crate::import::eaf as properties;
use crate::import::readers::annotations_of;
use crate::inventories::{self, StoredInventory};

/// Writes the tiers of a recording to a file.
pub(super) fn write_file(
    connection: &Connection,
    recording: &RecordingRow,
    path: &Path,
) -> Result<()> {
    let mut file = File::create(path).map_err(|error| Error::file(path, error))?;
    write(connection, recording, &mut file)
}

/// Writes the tiers of a recording: the bytes of the file that they came from, except for the changes.
pub(super) fn write(
    connection: &Connection,
    recording: &RecordingRow,
    out: &mut dyn Write,
) -> Result<()> {
    let files = files(connection, recording)?;
    let texts = texts(&files, recording)?;
    let documents = documents(&texts, recording)?;
    let template = documents.first().cloned().unwrap_or_default();
    let transcript = transcript(connection, recording, &documents)?;
    let fault = |error| Error::wrong(format!("the file cannot be written: {error}"));
    if let Some((_, bytes)) = files.first()
        && let Ok(Some(patched)) = patched(bytes, &transcript)
    {
        return out.write_all(&patched).map_err(fault);
    }
    raw::write(&to_raw(&transcript, &template), out).map_err(fault)
}

/// Returns the tiers of a recording, for export to formats of other programs.
pub(crate) fn tiers_of(connection: &Connection, recording: &RecordingRow) -> Result<Transcript> {
    let files = files(connection, recording)?;
    let texts = texts(&files, recording)?;
    let documents = documents(&texts, recording)?;
    transcript(connection, recording, &documents)
}

/// Returns the annotation files that the recording's tiers came from, each in its newest version.
fn files(connection: &Connection, recording: &RecordingRow) -> Result<Vec<(String, Vec<u8>)>> {
    // A file that was edited and imported again replaces its earlier version.
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for file in recordings::source_files(connection, recording.id)? {
        if file.kind != "eaf" {
            continue;
        }
        let Some(bytes) = recordings::source_bytes(connection, file.id)? else {
            continue;
        };
        match files.iter_mut().find(|(name, _)| *name == file.name) {
            Some(known) => known.1 = bytes,
            None => files.push((file.name, bytes)),
        }
    }
    Ok(files)
}

/// Returns the texts of files in any encoding.
fn texts<'f>(
    files: &'f [(String, Vec<u8>)],
    recording: &RecordingRow,
) -> Result<Vec<Cow<'f, str>>> {
    let texts = files.iter().map(|(_, bytes)| decode(bytes));
    texts
        .map(|it| {
            it.map(|it| it.text)
                .map_err(|error| broken(recording, &error))
        })
        .collect()
}

fn documents<'t>(
    texts: &'t [Cow<'_, str>],
    recording: &RecordingRow,
) -> Result<Vec<raw::Document<'t>>> {
    let documents = texts.iter().map(|text| raw::read(text.as_bytes()));
    documents
        .map(|it| it.map(|it| it.0).map_err(|error| broken(recording, &error)))
        .collect()
}

fn broken(recording: &RecordingRow, error: &chereme_formats::eaf::Error) -> Error {
    let file = format!("a file of the recording {:?}", recording.name);
    damaged(file, error.to_string())
}

fn transcript(
    connection: &Connection,
    recording: &RecordingRow,
    documents: &[raw::Document<'_>],
) -> Result<Transcript> {
    let mut transcript = base(connection, recording, documents)?;
    Writing {
        connection,
        inventories: inventories::load_of(connection, recording.id)?,
        transcript: &mut transcript,
        places: BTreeMap::new(),
    }
    .tiers(recording)?;
    describe(connection, recording, &mut transcript)?;
    Ok(transcript)
}

/// Returns the document without tiers: that of the recording's first file, with the vocabularies of the others.
fn base(
    connection: &Connection,
    recording: &RecordingRow,
    documents: &[raw::Document<'_>],
) -> Result<Transcript> {
    let mut read = documents.iter().map(|document| from_raw(document).0);
    if let Some(mut first) = read.next() {
        for other in read {
            let new = |it: &Vocabulary| first.vocabularies.iter().all(|known| known.id != it.id);
            let more: Vec<Vocabulary> = other.vocabularies.into_iter().filter(new).collect();
            first.vocabularies.extend(more);
        }
        relink(connection, recording.id, &mut first)?;
        return Ok(first);
    }
    let media = recordings::media_tracks(connection, recording.id)?.into_iter();
    Ok(Transcript {
        media: media
            .map(|track| Media {
                url: track.url,
                mime_type: track.media_type.unwrap_or_default(),
                time_origin: (track.offset_us != 0).then_some(-track.offset_us / 1000),
                ..Media::default()
            })
            .collect(),
        properties: named_texts(connection, recording)?,
        ..Transcript::default()
    })
}

/// Returns the named texts of the newest annotation file of another program that a recording came from.
fn named_texts(connection: &Connection, recording: &RecordingRow) -> Result<Vec<(String, String)>> {
    for file in recordings::source_files(connection, recording.id)?
        .iter()
        .rev()
    {
        let Some(read) = annotations_of(&file.kind) else {
            continue;
        };
        if let Some(bytes) = recordings::source_bytes(connection, file.id)?
            && let Ok((transcript, _)) = read(&bytes)
        {
            return Ok(transcript.properties);
        }
    }
    Ok(Vec::new())
}

/// Updates the links of media that were linked again after the import; other links stay as in the file.
fn relink(connection: &Connection, recording: i64, transcript: &mut Transcript) -> Result<()> {
    let tracks = recordings::media_tracks(connection, recording)?;
    let before = std::mem::take(&mut transcript.media);
    transcript.media = tracks
        .into_iter()
        .map(|track| {
            let at = |it: &&Media| it.relative_url.as_ref().unwrap_or(&it.url) == &track.url;
            before.iter().find(at).cloned().unwrap_or_else(|| Media {
                url: track.url.clone(),
                mime_type: track.media_type.clone().unwrap_or_default(),
                time_origin: (track.offset_us != 0).then_some(-track.offset_us / 1000),
                ..Media::default()
            })
        })
        .collect();
    Ok(())
}

/// Adds the properties that a new import of the file would not guess.
fn describe(
    connection: &Connection,
    recording: &RecordingRow,
    transcript: &mut Transcript,
) -> Result<()> {
    let participants: BTreeSet<&str> = transcript
        .tiers
        .iter()
        .filter_map(|tier| tier.participant.as_deref())
        .collect();
    let guessed = participants.len() == 1
        && participants.contains(recording.signer.as_deref().unwrap_or_default());
    let signer = match recording.signer_id {
        Some(id) => recordings::signer(connection, id)?,
        None => None,
    };
    let handedness = signer.as_ref().and_then(|signer| signer.handedness.clone());
    let name = signer.map(|signer| signer.name);
    let mut say = |key: &str, value: Option<String>, is_default: bool| {
        let known = transcript
            .properties
            .iter()
            .position(|(name, _)| name == key);
        match (known, value) {
            (Some(at), Some(value)) => transcript.properties[at].1 = value,
            (Some(at), None) => {
                transcript.properties.remove(at);
            }
            (None, Some(value)) if !is_default => {
                transcript.properties.push((key.to_owned(), value));
            }
            (None, _) => {}
        }
    };
    say(
        properties::ORIGIN,
        Some(recording.origin.name().to_owned()),
        recording.origin == Origin::Captured,
    );
    say(properties::LICENCE, recording.licence.clone(), false);
    say(properties::SIGNER, name, guessed);
    say(properties::HANDEDNESS, handedness, false);
    let roles = roles_of_tiers(connection, recording, transcript)?;
    transcript
        .properties
        .retain(|(key, _)| key != properties::TIERS);
    if !roles.is_empty() {
        let text = Value::Object(roles).to_string();
        transcript
            .properties
            .push((properties::TIERS.to_owned(), text));
    }
    Ok(())
}

/// Returns the roles of tiers whose names alone would suggest others, in the format of a mapping.
fn roles_of_tiers(
    connection: &Connection,
    recording: &RecordingRow,
    transcript: &Transcript,
) -> Result<Map<String, Value>> {
    let guesses = roles::guess_tiers(transcript, &Mapping::default());
    let mut roles = Map::new();
    for (row, guess) in tiers::tiers(connection, recording.id)?.iter().zip(guesses) {
        if guess.role.unwrap_or_default() != row.role || guess.hand != row.hand {
            roles.insert(row.name.clone(), Value::from(row.topic().to_string()));
        }
    }
    Ok(roles)
}

struct Writing<'a> {
    connection: &'a Connection,
    inventories: Vec<StoredInventory>,
    transcript: &'a mut Transcript,
    /// The place of each annotation in the written file.
    places: BTreeMap<i64, AnnotationAddress>,
}

impl Writing<'_> {
    fn tiers(mut self, recording: &RecordingRow) -> Result<()> {
        let rows = tiers::tiers(self.connection, recording.id)?;
        let at: BTreeMap<i64, usize> = rows
            .iter()
            .enumerate()
            .map(|(at, row)| (row.id, at))
            .collect();
        let mut annotations = Vec::with_capacity(rows.len());
        for row in &rows {
            annotations.push(in_order(tiers::annotations(self.connection, row.id)?));
        }
        let changed = annotations
            .iter()
            .flatten()
            .any(|row| row.origin != AnnotationOrigin::File);
        if changed || self.transcript.date.is_empty() {
            self.transcript.date = list::last_change(self.connection)?.unwrap_or_default();
        }
        let mut ids = Ids::new(annotations.iter().flatten(), &self.transcript.properties);
        self.transcript.tiers = Vec::with_capacity(rows.len());
        for (row, annotations) in rows.iter().zip(&annotations) {
            let mut tier = tier(row, row.parent_id.and_then(|id| at.get(&id).copied()));
            tier.vocabulary = self.vocabulary(row, annotations);
            self.transcript.tiers.push(tier);
        }
        for place in parents_first(&rows, &at) {
            for (index, row) in annotations[place].iter().enumerate() {
                self.places
                    .insert(row.id, AnnotationAddress { tier: place, index });
                let annotation = self.annotation(&self.transcript.tiers[place], row, &mut ids);
                self.transcript.tiers[place].annotations.push(annotation);
            }
        }
        Ok(())
    }

    /// Returns the vocabulary of a tier, completed by all its values: that of its file, otherwise its inventory.
    fn vocabulary(&mut self, tier: &TierRow, annotations: &[AnnotationRow]) -> Option<String> {
        let source = source(tier.source.as_deref());
        let named = text(&source, "vocabulary");
        let id = match (&named, &tier.source) {
            (Some(named), _) if self.find_vocabulary(named).is_some() => named.clone(),
            (Some(named), None) => named.clone(),
            (_, Some(_)) => return named,
            (None, None) => {
                let stored = self
                    .inventories
                    .iter()
                    .find(|it| Some(it.id) == tier.inventory_id)?;
                let vocabulary = of_inventory(stored);
                let id = vocabulary.id.clone();
                if self.find_vocabulary(&id).is_none() {
                    self.transcript.vocabularies.push(vocabulary);
                }
                id
            }
        };
        let vocabulary = self.find_vocabulary(&id)?;
        if vocabulary.external.is_none() {
            complete(vocabulary, annotations);
        }
        Some(id)
    }

    fn find_vocabulary(&mut self, id: &str) -> Option<&mut Vocabulary> {
        self.transcript
            .vocabularies
            .iter_mut()
            .find(|it| it.id == id)
    }

    fn annotation(&self, tier: &Tier, row: &AnnotationRow, ids: &mut Ids) -> Annotation {
        let source = source(row.source.as_deref());
        let value = row.file_text().to_owned();
        // A value that had no vocabulary entry in its file gets none.
        let entry = match text(&source, "entry") {
            None if row.origin != AnnotationOrigin::File => tier
                .vocabulary
                .as_deref()
                .and_then(|vocabulary| self.entry(vocabulary, &value)),
            entry => entry,
        };
        Annotation {
            id: ids.take(row),
            span: Span::between(
                Instant::from_micros(row.start_us),
                Instant::from_micros(row.end_us),
            ),
            timing: timing(tier.stereotype, &source),
            parent: row.parent_id.and_then(|id| self.places.get(&id).copied()),
            order: u32::try_from(row.position).unwrap_or(u32::MAX),
            value,
            entry,
            language: text(&source, "language"),
            external_ref: text(&source, "external_ref"),
            millis: row
                .file_start_ms
                .zip(row.file_end_ms)
                .map(|(start, end)| [start, end]),
        }
    }

    fn entry(&self, vocabulary: &str, value: &str) -> Option<String> {
        let all = &self.transcript.vocabularies;
        let vocabulary = all.iter().find(|it| it.id == vocabulary)?;
        let says = |entry: &&VocabularyEntry| entry.values.iter().any(|it| it.value == value);
        let entry = vocabulary.entries.iter().find(says)?;
        Some(entry.id.clone()).filter(|id| !id.is_empty())
    }
}

fn tier(row: &TierRow, parent: Option<usize>) -> Tier {
    let source = source(row.source.as_deref());
    let kind = text(&source, "type").unwrap_or_else(|| row.role.name());
    Tier {
        name: row.name.clone(),
        parent,
        stereotype: row.stereotype,
        kind,
        participant: row.participant.clone(),
        annotator: row.annotator.clone(),
        language: row.language.clone(),
        locale: text(&source, "locale"),
        vocabulary: None,
        annotations: Vec::new(),
    }
}

/// Returns annotations by time, or in the order of their file if that differs.
fn in_order(rows: Vec<AnnotationRow>) -> Vec<AnnotationRow> {
    let time = |row: &AnnotationRow| (row.start_us, row.position);
    let mut by_row = rows.clone();
    by_row.sort_by_key(|row| row.id);
    let of_file = by_row.iter().filter(|row| row.external_id.is_some());
    if of_file.is_sorted_by_key(time) {
        rows
    } else {
        by_row
    }
}

fn parents_first(rows: &[TierRow], at: &BTreeMap<i64, usize>) -> Vec<usize> {
    let parent = |place: usize| rows[place].parent_id.and_then(|id| at.get(&id).copied());
    let depth = |place: usize| {
        std::iter::successors(Some(place), |place| parent(*place))
            .take(rows.len() + 1)
            .count()
    };
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(|place| (depth(*place), *place));
    order
}

fn timing(stereotype: Option<Stereotype>, source: &Value) -> Timing {
    let proposed = source
        .get("timing")
        .and_then(|timing| timing.get("proposed"));
    let open = |end: &str| {
        let end = proposed.and_then(|proposed| proposed.get(end));
        end.and_then(Value::as_bool).unwrap_or(false)
    };
    match stereotype {
        Some(Stereotype::SymbolicAssociation) => Timing::Parent,
        Some(Stereotype::SymbolicSubdivision) => Timing::Share,
        _ if proposed.is_some() => Timing::Proposed {
            start: open("start"),
            end: open("end"),
        },
        _ => Timing::Own,
    }
}

fn source(text: Option<&str>) -> Value {
    text.and_then(|text| serde_json::from_str(text).ok())
        .unwrap_or(Value::Null)
}

fn text(source: &Value, key: &str) -> Option<String> {
    source.get(key)?.as_str().map(str::to_owned)
}

fn of_inventory(stored: &StoredInventory) -> Vocabulary {
    let inventory = &stored.inventory;
    let entries = inventory.values.iter().enumerate().map(|(n, value)| {
        let name = value.name("en");
        VocabularyEntry {
            id: format!("cveid{n}"),
            values: vec![EntryValue {
                language: String::new(),
                value: value.id.clone(),
                description: (name != value.id).then(|| name.to_owned()),
            }],
            external_ref: None,
        }
    });
    let description = inventory.names.get("en").cloned().unwrap_or_default();
    Vocabulary {
        id: inventory.id.clone(),
        descriptions: vec![(String::new(), description)],
        entries: entries.collect(),
        external: None,
    }
}

/// Adds values that people have entered since the import to a vocabulary.
fn complete(vocabulary: &mut Vocabulary, annotations: &[AnnotationRow]) {
    let language = vocabulary
        .entries
        .iter()
        .flat_map(|entry| &entry.values)
        .next();
    let language = language
        .map(|value| value.language.clone())
        .unwrap_or_default();
    for row in annotations
        .iter()
        .filter(|row| row.origin != AnnotationOrigin::File && row.state == ValueState::Value)
    {
        let mut all = vocabulary.entries.iter().flat_map(|entry| &entry.values);
        if all.any(|known| known.value == row.value) {
            continue;
        }
        let taken = |id: &String| vocabulary.entries.iter().any(|entry| entry.id == *id);
        // In files of formats before 2.8 entries have no ids.
        let id = match taken(&String::new()) {
            true => None,
            false => (vocabulary.entries.len()..)
                .map(|n| format!("cveid{n}"))
                .find(|id| !taken(id)),
        };
        vocabulary.entries.push(VocabularyEntry {
            id: id.unwrap_or_default(),
            values: vec![EntryValue {
                language: language.clone(),
                value: row.value.clone(),
                description: None,
            }],
            external_ref: None,
        });
    }
}

/// Ids of annotations: those of the file, and fresh ones after the last one that it ever used.
struct Ids {
    taken: BTreeSet<String>,
    last: u64,
}

impl Ids {
    fn new<'r>(
        rows: impl Iterator<Item = &'r AnnotationRow>,
        properties: &[(String, String)],
    ) -> Self {
        let number = |id: &String| id.strip_prefix('a')?.parse::<u64>().ok();
        let used = properties
            .iter()
            .find(|(name, _)| name == "lastUsedAnnotationId");
        let used = used.and_then(|(_, value)| value.parse().ok()).unwrap_or(0);
        let last = rows
            .filter_map(|row| number(row.external_id.as_ref()?))
            .max()
            .unwrap_or(0);
        Self {
            taken: BTreeSet::new(),
            last: last.max(used),
        }
    }

    fn take(&mut self, row: &AnnotationRow) -> String {
        match &row.external_id {
            Some(id) if self.taken.insert(id.clone()) => id.clone(),
            _ => {
                self.last += 1;
                let id = format!("a{}", self.last);
                self.taken.insert(id.clone());
                id
            }
        }
    }
}
