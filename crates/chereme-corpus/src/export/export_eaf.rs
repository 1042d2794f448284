//! Exports a recording's tiers as an ELAN file.
//!
//! Unchanged parts of an imported file are written byte for byte; a changed annotation changes only its own lines, in
//! the layout of the file.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Write;
use std::path::Path;

use chereme_formats::eaf::eaf_convert::{
    AnnotationAddress, AnnotationTiming, AnnotationTranscript, ControlledVocabulary, TranscriptAnnotation,
    TranscriptMedia, TranscriptTier, VocabularyEntry, VocabularyEntryValue,
};
use chereme_formats::eaf::{decode_eaf, eaf_document_from_transcript, eaf_raw, patch_eaf, transcript_from_eaf};
use chereme_formats::roles::{self, TierMapping};
use chereme_sign::TierStereotype;
use rusqlite::Connection;
use serde_json::{Map, Value};

use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin, ValueState};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::db::{damaged_row_error, stored_list};
use crate::error::{CorpusError, CorpusResult};
use crate::import::import_eaf as properties;
use crate::import::readers::annotations_of;
use crate::inventories::{self, StoredInventory};

/// Writes the tiers of a recording to a file.
pub(super) fn write_file(connection: &Connection, recording: &RecordingRow, path: &Path) -> CorpusResult<()> {
    let mut file = File::create(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    write_recording_eaf(connection, recording, &mut file)
}

/// Writes the tiers of a recording: the bytes of the file that they came from, except for the changes.
pub(super) fn write_recording_eaf(
    connection: &Connection,
    recording: &RecordingRow,
    out: &mut dyn Write,
) -> CorpusResult<()> {
    let files = load_source_eaf_files(connection, recording)?;
    let texts = decode_eaf_texts(&files, recording)?;
    let documents = parse_eaf_documents(&texts, recording)?;
    let template = documents.first().cloned().unwrap_or_default();
    let transcript = build_eaf_transcript(connection, recording, &documents)?;
    let fault = |error| CorpusError::from_wrong_message(format!("the file cannot be written: {error}"));
    if let Some((_, bytes)) = files.first()
        // Only the file itself shows what this program does not understand, so it is patched where possible.
        && let Ok(Some(patched)) = patch_eaf(bytes, &transcript)
    {
        return out.write_all(&patched).map_err(fault);
    }
    eaf_raw::write_eaf_document(&eaf_document_from_transcript(&transcript, &template), out).map_err(fault)
}

/// Returns the tiers of a recording, for export to formats of other programs.
pub(crate) fn tiers_of(connection: &Connection, recording: &RecordingRow) -> CorpusResult<AnnotationTranscript> {
    let files = load_source_eaf_files(connection, recording)?;
    let texts = decode_eaf_texts(&files, recording)?;
    let documents = parse_eaf_documents(&texts, recording)?;
    build_eaf_transcript(connection, recording, &documents)
}

/// Returns the annotation files that the recording's tiers came from, each in its newest version.
fn load_source_eaf_files(connection: &Connection, recording: &RecordingRow) -> CorpusResult<Vec<(String, Vec<u8>)>> {
    // A file that was edited and imported again replaces its earlier version.
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for file in stored_recordings::source_files(connection, recording.id)? {
        if file.kind != "eaf" {
            continue;
        }
        let Some(bytes) = stored_recordings::source_bytes(connection, file.id)? else {
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
fn decode_eaf_texts<'f>(files: &'f [(String, Vec<u8>)], recording: &RecordingRow) -> CorpusResult<Vec<Cow<'f, str>>> {
    let texts = files.iter().map(|(_, bytes)| decode_eaf(bytes));
    texts
        .map(|result| {
            result
                .map(|decoded| decoded.text)
                .map_err(|error| broken_eaf_error(recording, &error))
        })
        .collect()
}

fn parse_eaf_documents<'t>(
    texts: &'t [Cow<'_, str>],
    recording: &RecordingRow,
) -> CorpusResult<Vec<eaf_raw::EafDocument<'t>>> {
    let documents = texts.iter().map(|text| eaf_raw::read_eaf_document(text.as_bytes()));
    documents
        .map(|result| {
            result
                .map(|parsed| parsed.0)
                .map_err(|error| broken_eaf_error(recording, &error))
        })
        .collect()
}

fn broken_eaf_error(recording: &RecordingRow, error: &chereme_formats::eaf::EafError) -> CorpusError {
    let file = format!("a file of the recording {:?}", recording.name);
    damaged_row_error(file, error.to_string())
}

fn build_eaf_transcript(
    connection: &Connection,
    recording: &RecordingRow,
    documents: &[eaf_raw::EafDocument<'_>],
) -> CorpusResult<AnnotationTranscript> {
    let mut transcript = base_eaf_transcript(connection, recording, documents)?;
    EafTierWriter {
        connection,
        inventories: inventories::load_of(connection, recording.id)?,
        transcript: &mut transcript,
        places: BTreeMap::new(),
    }
    .write_eaf_tiers(recording)?;
    add_recording_properties(connection, recording, &mut transcript)?;
    Ok(transcript)
}

/// Returns the document without tiers: that of the recording's first file, with the vocabularies of the others.
fn base_eaf_transcript(
    connection: &Connection,
    recording: &RecordingRow,
    documents: &[eaf_raw::EafDocument<'_>],
) -> CorpusResult<AnnotationTranscript> {
    let mut read = documents.iter().map(|document| transcript_from_eaf(document).0);
    if let Some(mut first) = read.next() {
        for other in read {
            let new =
                |vocabulary: &ControlledVocabulary| first.vocabularies.iter().all(|known| known.id != vocabulary.id);
            let more: Vec<ControlledVocabulary> = other.vocabularies.into_iter().filter(new).collect();
            first.vocabularies.extend(more);
        }
        relink(connection, recording.id, &mut first)?;
        return Ok(first);
    }
    let media = stored_recordings::media_tracks(connection, recording.id)?.into_iter();
    Ok(AnnotationTranscript {
        media: media
            .map(|track| TranscriptMedia {
                url: track.url,
                mime_type: track.media_type.unwrap_or_default(),
                time_origin: (track.offset_us != 0).then_some(-track.offset_us / 1000),
                ..TranscriptMedia::default()
            })
            .collect(),
        properties: named_texts(connection, recording)?,
        ..AnnotationTranscript::default()
    })
}

/// Returns the named texts of the newest annotation file of another program that a recording came from.
fn named_texts(connection: &Connection, recording: &RecordingRow) -> CorpusResult<Vec<(String, String)>> {
    for file in stored_recordings::source_files(connection, recording.id)?.iter().rev() {
        let Some(read) = annotations_of(&file.kind) else {
            continue;
        };
        if let Some(bytes) = stored_recordings::source_bytes(connection, file.id)?
            && let Ok((transcript, _)) = read(&bytes)
        {
            return Ok(transcript.properties);
        }
    }
    Ok(Vec::new())
}

/// Updates the links of media that were linked again after the import; other links stay as in the file.
fn relink(connection: &Connection, recording: i64, transcript: &mut AnnotationTranscript) -> CorpusResult<()> {
    let tracks = stored_recordings::media_tracks(connection, recording)?;
    let before = std::mem::take(&mut transcript.media);
    transcript.media = tracks
        .into_iter()
        .map(|track| {
            let is_same = |media: &&TranscriptMedia| media.relative_url.as_ref().unwrap_or(&media.url) == &track.url;
            before.iter().find(is_same).cloned().unwrap_or_else(|| TranscriptMedia {
                url: track.url.clone(),
                mime_type: track.media_type.clone().unwrap_or_default(),
                time_origin: (track.offset_us != 0).then_some(-track.offset_us / 1000),
                ..TranscriptMedia::default()
            })
        })
        .collect();
    Ok(())
}

/// Adds the properties that a new import of the file would not guess.
fn add_recording_properties(
    connection: &Connection,
    recording: &RecordingRow,
    transcript: &mut AnnotationTranscript,
) -> CorpusResult<()> {
    let participants: BTreeSet<&str> = transcript
        .tiers
        .iter()
        .filter_map(|tier| tier.participant.as_deref())
        .collect();
    // An import takes the only participant for the signer, so it need not be stated again.
    let guessed = participants.len() == 1 && participants.contains(recording.signer.as_deref().unwrap_or_default());
    let signer = match recording.signer_id {
        Some(id) => stored_recordings::find_signer_row(connection, id)?,
        None => None,
    };
    let handedness = signer.as_ref().and_then(|signer| signer.handedness.clone());
    let name = signer.map(|signer| signer.name);
    let mut say = |key: &str, value: Option<String>, is_default: bool| {
        let known_property = transcript.properties.iter().position(|(name, _)| name == key);
        match (known_property, value) {
            (Some(at), Some(value)) => transcript.properties[at].1 = value,
            // A property of the file that no longer holds must not come back with the next import.
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
        properties::ORIGIN_PROPERTY,
        Some(recording.origin.record_origin_name().to_owned()),
        recording.origin == RecordOrigin::Captured,
    );
    say(properties::LICENCE_PROPERTY, recording.licence.clone(), false);
    say(properties::SIGNER_PROPERTY, name, guessed);
    say(properties::HANDEDNESS_PROPERTY, handedness, false);
    let roles = roles_of_tiers(connection, recording, transcript)?;
    transcript
        .properties
        .retain(|(key, _)| key != properties::TIER_ROLES_PROPERTY);
    if !roles.is_empty() {
        let text = Value::Object(roles).to_string();
        transcript
            .properties
            .push((properties::TIER_ROLES_PROPERTY.to_owned(), text));
    }
    Ok(())
}

/// Returns the roles of tiers whose names alone would suggest others, in the format of a mapping.
fn roles_of_tiers(
    connection: &Connection,
    recording: &RecordingRow,
    transcript: &AnnotationTranscript,
) -> CorpusResult<Map<String, Value>> {
    let guesses = roles::guess_tiers(transcript, &TierMapping::default());
    let mut roles = Map::new();
    for (row, guess) in stored_tiers::load_tier_rows(connection, recording.id)?
        .iter()
        .zip(guesses)
    {
        // Only what an import would guess wrongly is stated, so that files of others stay as they are.
        if guess.role.unwrap_or_default() != row.role || guess.hand != row.hand {
            roles.insert(row.name.clone(), Value::from(row.tier_topic().to_string()));
        }
    }
    Ok(roles)
}

struct EafTierWriter<'a> {
    connection: &'a Connection,
    inventories: Vec<StoredInventory>,
    transcript: &'a mut AnnotationTranscript,
    /// The place of each annotation in the written file.
    places: BTreeMap<i64, AnnotationAddress>,
}

impl EafTierWriter<'_> {
    fn write_eaf_tiers(mut self, recording: &RecordingRow) -> CorpusResult<()> {
        let rows = stored_tiers::load_tier_rows(self.connection, recording.id)?;
        let index_by_id: BTreeMap<i64, usize> = rows.iter().enumerate().map(|(at, row)| (row.id, at)).collect();
        let mut annotations = Vec::with_capacity(rows.len());
        for row in &rows {
            annotations.push(order_as_in_file(stored_tiers::load_tier_annotation_rows(
                self.connection,
                row.id,
            )?));
        }
        let changed = annotations
            .iter()
            .flatten()
            .any(|row| row.origin != AnnotationOrigin::File);
        // An unchanged file keeps its date, so that it stays the same byte for byte.
        if changed || self.transcript.date.is_empty() {
            self.transcript.date = stored_list::last_change(self.connection)?.unwrap_or_default();
        }
        let mut ids = AnnotationIdPool::new(annotations.iter().flatten(), &self.transcript.properties);
        self.transcript.tiers = Vec::with_capacity(rows.len());
        for (row, annotations) in rows.iter().zip(&annotations) {
            let mut tier = eaf_tier_from_row(row, row.parent_id.and_then(|id| index_by_id.get(&id).copied()));
            tier.vocabulary = self.complete_tier_vocabulary(row, annotations);
            self.transcript.tiers.push(tier);
        }
        // An annotation refers to the place of its parent, which must be known by then.
        for place in tier_indices_parents_first(&rows, &index_by_id) {
            for (index, row) in annotations[place].iter().enumerate() {
                self.places.insert(row.id, AnnotationAddress { tier: place, index });
                let annotation = self.eaf_annotation_from_row(&self.transcript.tiers[place], row, &mut ids);
                self.transcript.tiers[place].annotations.push(annotation);
            }
        }
        Ok(())
    }

    /// Returns the vocabulary of a tier, completed by all its values: that of its file, otherwise its inventory.
    fn complete_tier_vocabulary(&mut self, tier: &TierRow, annotations: &[AnnotationRow]) -> Option<String> {
        let source = parse_source_properties(tier.source.as_deref());
        let named = source_property_text(&source, "vocabulary");
        let id = match (&named, &tier.source) {
            (Some(named), _) if self.find_vocabulary(named).is_some() => named.clone(),
            (Some(named), None) => named.clone(),
            // The tier came from a file without this vocabulary, and gets none that it did not have.
            (_, Some(_)) => return named,
            (None, None) => {
                let stored = self
                    .inventories
                    .iter()
                    .find(|inventory| Some(inventory.id) == tier.inventory_id)?;
                let vocabulary = of_inventory(stored);
                let id = vocabulary.id.clone();
                if self.find_vocabulary(&id).is_none() {
                    self.transcript.vocabularies.push(vocabulary);
                }
                id
            }
        };
        let vocabulary = self.find_vocabulary(&id)?;
        // The values of an external vocabulary lie in another file, which is not ours to change.
        if vocabulary.external.is_none() {
            add_missing_vocabulary_values(vocabulary, annotations);
        }
        Some(id)
    }

    fn find_vocabulary(&mut self, id: &str) -> Option<&mut ControlledVocabulary> {
        self.transcript
            .vocabularies
            .iter_mut()
            .find(|vocabulary| vocabulary.id == id)
    }

    fn eaf_annotation_from_row(
        &self,
        tier: &TranscriptTier,
        row: &AnnotationRow,
        ids: &mut AnnotationIdPool,
    ) -> TranscriptAnnotation {
        let source = parse_source_properties(row.source.as_deref());
        let value = row.file_text().to_owned();
        // A value that had no vocabulary entry in its file gets none.
        let entry = match source_property_text(&source, "entry") {
            None if row.origin != AnnotationOrigin::File => tier
                .vocabulary
                .as_deref()
                .and_then(|vocabulary| self.vocabulary_entry_id(vocabulary, &value)),
            entry => entry,
        };
        TranscriptAnnotation {
            id: ids.take_annotation_id(row),
            span: row.annotation_row_span(),
            timing: source_tier_timing(tier.stereotype, &source),
            parent: row.parent_id.and_then(|id| self.places.get(&id).copied()),
            order: u32::try_from(row.position).unwrap_or(u32::MAX),
            value,
            entry,
            language: source_property_text(&source, "language"),
            external_ref: source_property_text(&source, "external_ref"),
            millis: row.file_start_ms.zip(row.file_end_ms).map(|(start, end)| [start, end]),
        }
    }

    fn vocabulary_entry_id(&self, vocabulary: &str, value: &str) -> Option<String> {
        let all = &self.transcript.vocabularies;
        let vocabulary = all.iter().find(|candidate| candidate.id == vocabulary)?;
        let says = |entry: &&VocabularyEntry| entry.values.iter().any(|entry_value| entry_value.value == value);
        let entry = vocabulary.entries.iter().find(says)?;
        Some(entry.id.clone()).filter(|id| !id.is_empty())
    }
}

fn eaf_tier_from_row(row: &TierRow, parent: Option<usize>) -> TranscriptTier {
    let source = parse_source_properties(row.source.as_deref());
    let kind = source_property_text(&source, "type").unwrap_or_else(|| row.role.role_name());
    TranscriptTier {
        name: row.name.clone(),
        parent,
        stereotype: row.stereotype,
        kind,
        participant: row.participant.clone(),
        annotator: row.annotator.clone(),
        language: row.language.clone(),
        locale: source_property_text(&source, "locale"),
        vocabulary: None,
        annotations: Vec::new(),
    }
}

/// Returns annotations by time, or in the order of their file if that differs.
fn order_as_in_file(rows: Vec<AnnotationRow>) -> Vec<AnnotationRow> {
    let time = |row: &AnnotationRow| (row.start_us, row.position);
    let mut by_row = rows.clone();
    by_row.sort_by_key(|row| row.id);
    let of_file = by_row.iter().filter(|row| row.external_id.is_some());
    // A file that is not sorted by time would otherwise differ in every line.
    if of_file.is_sorted_by_key(time) { rows } else { by_row }
}

fn tier_indices_parents_first(rows: &[TierRow], at: &BTreeMap<i64, usize>) -> Vec<usize> {
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

fn source_tier_timing(stereotype: Option<TierStereotype>, source: &Value) -> AnnotationTiming {
    let proposed = source.get("timing").and_then(|timing| timing.get("proposed"));
    let open = |end: &str| {
        let end = proposed.and_then(|proposed| proposed.get(end));
        end.and_then(Value::as_bool).unwrap_or(false)
    };
    match stereotype {
        Some(TierStereotype::SymbolicAssociation) => AnnotationTiming::Parent,
        Some(TierStereotype::SymbolicSubdivision) => AnnotationTiming::Share,
        _ if proposed.is_some() => AnnotationTiming::Proposed {
            start: open("start"),
            end: open("end"),
        },
        _ => AnnotationTiming::Own,
    }
}

fn parse_source_properties(text: Option<&str>) -> Value {
    text.and_then(|text| serde_json::from_str(text).ok())
        .unwrap_or(Value::Null)
}

fn source_property_text(source: &Value, key: &str) -> Option<String> {
    source.get(key)?.as_str().map(str::to_owned)
}

fn of_inventory(stored: &StoredInventory) -> ControlledVocabulary {
    let inventory = &stored.inventory;
    let entries = inventory.values.iter().enumerate().map(|(n, value)| {
        let name = value.value_name_in("en");
        VocabularyEntry {
            id: format!("cveid{n}"),
            values: vec![VocabularyEntryValue {
                language: String::new(),
                value: value.id.clone(),
                // A description that repeats the value says nothing.
                description: (name != value.id).then(|| name.to_owned()),
            }],
            external_ref: None,
        }
    });
    let description = inventory.names.get("en").cloned().unwrap_or_default();
    ControlledVocabulary {
        id: inventory.id.clone(),
        descriptions: vec![(String::new(), description)],
        entries: entries.collect(),
        external: None,
    }
}

/// Adds values that people have entered since the import to a vocabulary.
fn add_missing_vocabulary_values(vocabulary: &mut ControlledVocabulary, annotations: &[AnnotationRow]) {
    let entry_language = vocabulary.entries.iter().flat_map(|entry| &entry.values).next();
    // A new value without the language of the others would not be shown beside them.
    let language = entry_language.map(|value| value.language.clone()).unwrap_or_default();
    for row in annotations
        .iter()
        // Values that the file itself has outside of its vocabulary were meant so by its authors.
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
            values: vec![VocabularyEntryValue {
                language: language.clone(),
                value: row.value.clone(),
                description: None,
            }],
            external_ref: None,
        });
    }
}

/// Ids of annotations: those of the file, and fresh ones after the last one that it ever used.
struct AnnotationIdPool {
    taken: BTreeSet<String>,
    last: u64,
}

impl AnnotationIdPool {
    fn new<'r>(rows: impl Iterator<Item = &'r AnnotationRow>, properties: &[(String, String)]) -> Self {
        let number = |id: &String| id.strip_prefix('a')?.parse::<u64>().ok();
        let used_property = properties.iter().find(|(name, _)| name == "lastUsedAnnotationId");
        let used = used_property.and_then(|(_, value)| value.parse().ok()).unwrap_or(0);
        let last = rows
            .filter_map(|row| number(row.external_id.as_ref()?))
            .max()
            .unwrap_or(0);
        Self {
            taken: BTreeSet::new(),
            // The id of a removed annotation is not given to another one.
            last: last.max(used),
        }
    }

    fn take_annotation_id(&mut self, row: &AnnotationRow) -> String {
        match &row.external_id {
            // Tiers from several files may bring the same id twice.
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
