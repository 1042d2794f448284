//! Writes the edits of a change to rows.

use std::collections::BTreeMap;

use chereme_motion::Span;
use chereme_sign::tier::{Annotation, AnnotationId, Edit};
use rusqlite::Connection;
use serde_json::Value;

use super::scope::hull;
use super::{FRESH, signed, span_of};
use crate::db::columns::{AnnotationOrigin, ValueState};
use crate::db::tiers::{self as tier_rows, AnnotationRow};
use crate::error::Result;

/// The source of a change.
pub(super) struct Says<'a> {
    pub(super) origin: AnnotationOrigin,
    pub(super) confidence: Option<f64>,
    /// The annotations named by the change, without those that merely follow.
    pub(super) named: &'a [i64],
}

/// The result of writing edits.
#[derive(Default)]
pub(super) struct Written {
    pub(super) added: Vec<i64>,
    pub(super) changed: u64,
    pub(super) removed: u64,
    pub(super) touched: Option<Span>,
}

/// Writes edits in their order; `rows` are the present annotations.
pub(super) fn write(
    connection: &Connection,
    edits: &[Edit],
    rows: &BTreeMap<i64, AnnotationRow>,
    says: &Says<'_>,
) -> Result<Written> {
    let mut written = Written::default();
    let mut fresh: BTreeMap<AnnotationId, i64> = BTreeMap::new();
    for edit in edits {
        match edit {
            Edit::Put(new) => {
                written.touch(new.span);
                let parent = new.parent.map(|id| row_id(id, &fresh));
                match rows.get(&row_id(new.id, &fresh)) {
                    Some(old) => {
                        written.touch(span_of(old));
                        let row = changed(old, new, parent, says);
                        tier_rows::update_annotation(connection, &row)?;
                        written.changed += 1;
                    }
                    None => {
                        let id =
                            tier_rows::insert_annotation(connection, &added(new, parent, says))?;
                        fresh.insert(new.id, id);
                        written.added.push(id);
                    }
                }
            }
            Edit::Remove(id) => {
                let id = row_id(*id, &fresh);
                if let Some(old) = rows.get(&id) {
                    written.touch(span_of(old));
                }
                tier_rows::delete_annotation(connection, id)?;
                written.removed += 1;
            }
            Edit::Vocabulary { .. } => {}
        }
    }
    Ok(written)
}

impl Written {
    fn touch(&mut self, span: Span) {
        self.touched = Some(self.touched.map_or(span, |touched| hull(touched, span)));
    }
}

fn row_id(id: AnnotationId, fresh: &BTreeMap<AnnotationId, i64>) -> i64 {
    match fresh.get(&id) {
        Some(row) => *row,
        None if id.0 > FRESH => 0,
        None => signed(id),
    }
}

fn added(new: &Annotation, parent_id: Option<i64>, says: &Says<'_>) -> AnnotationRow {
    let row = AnnotationRow {
        origin: says.origin,
        confidence: says.confidence,
        ..AnnotationRow::default()
    };
    placed(row, new, parent_id)
}

fn changed(
    old: &AnnotationRow,
    new: &Annotation,
    parent_id: Option<i64>,
    says: &Says<'_>,
) -> AnnotationRow {
    let mut row = placed(old.clone(), new, parent_id);
    let moved = (row.start_us, row.end_us) != (old.start_us, old.end_us);
    let renamed = (&row.state, &row.value) != (&old.state, &old.value);
    if moved {
        row.file_start_ms = None;
        row.file_end_ms = None;
    }
    if (moved || renamed) && says.named.contains(&old.id) {
        row.origin = says.origin;
        row.confidence = says.confidence;
    }
    if moved || renamed {
        row.source = source(old.source.as_deref(), moved, renamed);
    }
    row
}

fn placed(row: AnnotationRow, new: &Annotation, parent_id: Option<i64>) -> AnnotationRow {
    AnnotationRow {
        tier_id: i64::try_from(new.tier.0).unwrap_or_default(),
        start_us: new.span.start().micros(),
        end_us: new.span.end().micros(),
        state: ValueState::of(&new.value),
        value: new.value.value().unwrap_or_default().to_owned(),
        parent_id,
        position: i64::from(new.order),
        ..row
    }
}

/// Returns the properties from the file that the row does not hold, without those that a change made wrong: the
/// vocabulary entry of another value, and the mark of ends that were never set.
fn source(source: Option<&str>, moved: bool, renamed: bool) -> Option<String> {
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
