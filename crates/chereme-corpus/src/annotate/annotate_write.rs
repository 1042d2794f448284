//! Writes the edits of a change to rows.

use std::collections::BTreeMap;

use chereme_motion::TimeSpan;
use chereme_sign::tier::{AnnotationId, TierAnnotation, TierEdit};
use rusqlite::Connection;
use serde_json::{Value, json};

use super::annotation_row_id;
use crate::address::message_names::FIRST_FRESH_HANDLE;
use crate::db::stored_columns::{AnnotationOrigin, ValueState};
use crate::db::stored_tiers::{self as tier_rows, AnnotationRow};
use crate::error::CorpusResult;

/// The source of a change.
pub(super) struct EditSource<'a> {
    pub(super) origin: AnnotationOrigin,
    /// The detector that found added annotations.
    pub(super) detector: Option<&'a str>,
    pub(super) confidence: Option<f64>,
    /// The annotations named by the change, without those that merely follow.
    pub(super) named: &'a [i64],
}

/// The result of writing edits.
#[derive(Default)]
pub(super) struct WrittenEdits {
    pub(super) added: Vec<i64>,
    pub(super) changed: u64,
    pub(super) removed: u64,
    pub(super) touched: Option<TimeSpan>,
}

/// Writes edits in their order; `rows` are the present annotations.
pub(super) fn write_annotation_edits(
    connection: &Connection,
    edits: &[TierEdit],
    rows: &BTreeMap<i64, AnnotationRow>,
    says: &EditSource<'_>,
) -> CorpusResult<WrittenEdits> {
    let mut written = WrittenEdits::default();
    let mut fresh: BTreeMap<AnnotationId, i64> = BTreeMap::new();
    for edit in edits {
        match edit {
            TierEdit::Put(new) => {
                written.extend_written_span(new.span);
                let parent = new.parent.map(|id| row_id(id, &fresh));
                match rows.get(&row_id(new.id, &fresh)) {
                    Some(old) => {
                        written.extend_written_span(old.annotation_row_span());
                        let row = changed_annotation_row(old, new, parent, says);
                        tier_rows::update_annotation(connection, &row)?;
                        written.changed += 1;
                    }
                    None => {
                        let id = tier_rows::insert_annotation(connection, &added_annotation_row(new, parent, says))?;
                        fresh.insert(new.id, id);
                        written.added.push(id);
                    }
                }
            }
            TierEdit::Remove(id) => {
                let id = row_id(*id, &fresh);
                if let Some(old) = rows.get(&id) {
                    written.extend_written_span(old.annotation_row_span());
                }
                tier_rows::delete_annotation(connection, id)?;
                written.removed += 1;
            }
        }
    }
    Ok(written)
}

impl WrittenEdits {
    fn extend_written_span(&mut self, span: TimeSpan) {
        self.touched = Some(self.touched.map_or(span, |touched| touched.enclosing_span(span)));
    }
}

fn row_id(id: AnnotationId, fresh: &BTreeMap<AnnotationId, i64>) -> i64 {
    match fresh.get(&id) {
        Some(row) => *row,
        None if id.0 > FIRST_FRESH_HANDLE => 0,
        None => annotation_row_id(id),
    }
}

fn added_annotation_row(new: &TierAnnotation, parent_id: Option<i64>, says: &EditSource<'_>) -> AnnotationRow {
    let row = AnnotationRow {
        origin: says.origin,
        confidence: says.confidence,
        source: says.detector.map(|name| detector_source_document(name).to_string()),
        ..AnnotationRow::default()
    };
    place_annotation_row(row, new, parent_id)
}

fn changed_annotation_row(
    old: &AnnotationRow,
    new: &TierAnnotation,
    parent_id: Option<i64>,
    says: &EditSource<'_>,
) -> AnnotationRow {
    let mut row = place_annotation_row(old.clone(), new, parent_id);
    let moved = (row.start_us, row.end_us) != (old.start_us, old.end_us);
    let renamed = (&row.state, &row.value) != (&old.state, &old.value);
    if moved {
        row.file_start_ms = None;
        row.file_end_ms = None;
    }
    if moved || renamed {
        row.source = updated_source_properties(old.source.as_deref(), moved, renamed);
    }
    if (moved || renamed) && says.named.contains(&old.id) {
        let is_corrected = old.origin == AnnotationOrigin::Detector && says.origin != old.origin;
        // A person who only moves a proposal takes its value over, with the confidence of the detector.
        row.confidence = says.confidence.or(old.confidence.filter(|_| is_corrected && !renamed));
        if is_corrected && renamed {
            row.source = Some(corrected_proposal_source(old, row.source));
        }
        row.origin = says.origin;
    }
    row
}

/// Returns the properties of an annotation that a detector found: the name of the detector, with the version of the program.
fn detector_source_document(name: &str) -> Value {
    json!({ "detector": name, "version": env!("CARGO_PKG_VERSION") })
}

/// Returns the properties of a proposal to which a person gave another value: those that it has, and what was proposed.
fn corrected_proposal_source(old: &AnnotationRow, source: Option<String>) -> String {
    let properties = source.and_then(|text| serde_json::from_str(&text).ok());
    let mut properties: Value = properties.unwrap_or_else(|| json!({}));
    properties["proposed"] = Value::from(old.value.clone());
    properties["confidence"] = Value::from(old.confidence);
    properties.to_string()
}

fn place_annotation_row(row: AnnotationRow, new: &TierAnnotation, parent_id: Option<i64>) -> AnnotationRow {
    AnnotationRow {
        tier_id: i64::try_from(new.tier.0).unwrap_or_default(),
        start_us: new.span.span_start_instant().instant_micros(),
        end_us: new.span.span_end_instant().instant_micros(),
        state: ValueState::state_of_reading(&new.value),
        value: new.value.reading_value().unwrap_or_default().to_owned(),
        parent_id,
        position: i64::from(new.order),
        ..row
    }
}

/// Returns the properties from the file that the row does not hold, without those that a change made wrong: the
/// vocabulary entry of another value, and the mark of ends that were never set.
fn updated_source_properties(source: Option<&str>, moved: bool, renamed: bool) -> Option<String> {
    let mut source: Value = serde_json::from_str(source?).ok()?;
    let map = source.as_object_mut()?;
    if renamed {
        map.insert("entry".to_owned(), Value::Null);
    }
    if moved && map.get("timing").is_some_and(Value::is_object) {
        map.insert("timing".to_owned(), Value::from("own"));
    }
    Some(source.to_string())
}
