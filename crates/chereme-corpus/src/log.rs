//! The history in detail: the rows that an operation changed, with their old and new values.

use std::collections::BTreeMap;

use chereme_motion::RecordingInstant;
use rusqlite::Connection;
use serde::Serialize;
use serde_json::{Value, json};

use crate::Corpus;
use crate::db::OperationRow;
use crate::db::stored_history::{self, RowChange};
use crate::error::{CorpusError, CorpusResult};
use crate::words::InterfaceLanguage;
use crate::words::history_words::described_value;

/// The tables that the user knows, each with the noun for a row and the column with its name.
const LOGGED_TABLE_NOUNS: [(&str, &str, &str); 17] = [
    ("annotation", "annotation", "value"),
    ("tier", "tier", "name"),
    ("recording", "recording", "name"),
    ("signer", "signer", "name"),
    ("person_alias", "other name", "name"),
    ("person_attribute", "attribute", "name"),
    ("lexicon", "lexicon", "name"),
    ("sign", "sign", "gloss"),
    ("sign_text", "translation", "text"),
    ("sign_relation", "relation", "kind"),
    ("inventory", "inventory", "key"),
    ("inventory_value", "value", "key"),
    ("kept_search", "search", "name"),
    ("study", "study", "name"),
    ("study_participant", "participant", "code"),
    ("recipe", "recipe", "text"),
    ("notation", "notation", "system"),
];

/// Columns that are of no interest to the user.
const UNREPORTED_COLUMNS: [&str; 8] = [
    "id",
    "uid",
    "source",
    "position",
    "file_start_ms",
    "file_end_ms",
    "document",
    "hash",
];

/// The changes of one operation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OperationDetail {
    /// The operation.
    pub operation: OperationRow,
    /// The number of changed rows in tables that the user knows, including those that are not listed.
    pub total: u64,
    /// The number of changed rows by table, including derived rows.
    pub tables: BTreeMap<String, u64>,
    /// The changes, in order.
    pub changes: Vec<ChangedRow>,
}

/// A row changed by an operation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChangedRow {
    /// The kind of thing, such as `annotation`.
    pub what: &'static str,
    /// Its row.
    pub id: Option<i64>,
    /// Its name: the value of an annotation, the name of a tier, the gloss of a sign.
    pub name: String,
    /// Its place, such as the tier and recording of an annotation.
    pub place: Option<String>,
    /// The names in its place, the inner one first.
    #[serde(skip)]
    pub place_names: Vec<String>,
    /// The kind of change.
    pub kind: ChangeKind,
    /// Its columns that differ; for an added or removed row, all its contents.
    pub fields: Vec<FieldChange>,
}

/// The kind of change of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ChangeKind {
    /// The row is new.
    Added,
    /// The row has other values.
    Changed,
    /// The row was removed.
    Removed,
}

/// A column of a row before and after.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldChange {
    /// The column, such as `start_us`; for a reference the kind of row that it refers to, such as `signer`.
    pub field: String,
    /// The value before.
    pub from: Value,
    /// The value after.
    pub to: Value,
}

impl Corpus {
    /// Returns the changes of an operation, at most `limit` of them.
    ///
    /// # Errors
    /// Fails if there is no such operation, or its changeset cannot be read.
    pub fn operation_detail(&self, id: i64, limit: usize) -> CorpusResult<OperationDetail> {
        let connection = self.store.read_connection();
        let operation = stored_history::load_newest_operations(connection, usize::MAX)?
            .into_iter()
            .find(|row| row.id == id)
            .ok_or_else(|| {
                CorpusError::from_wrong_message(format!("there is no operation {id}"))
                    .with_error_place(id.to_string())
                    .with_command_advice("`chereme log CORPUS` lists them")
            })?;
        let mut rows = OperationRows::default();
        stored_history::each_change(connection, id, |change| {
            rows.take_row_change(change);
            Ok(())
        })?;
        let mut changes = Vec::new();
        let mut total = 0;
        for (table, before, after) in rows.changed_known_rows() {
            total += 1;
            if changes.len() < limit {
                changes.push(describe_changed_row(connection, &rows, table, before, after)?);
            }
        }
        Ok(OperationDetail {
            operation,
            total,
            tables: rows.counts,
            changes,
        })
    }

    /// Returns the number of operations that are in effect and can be undone, and the number of those that can be
    /// redone.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn count_undo_steps(&self) -> CorpusResult<(usize, usize)> {
        stored_history::count_undo_redo_steps(self.store.read_connection())
    }
}

/// The rows of an operation, each as before its first change and after its last.
#[derive(Default)]
struct OperationRows {
    order: Vec<(usize, i64)>,
    images: BTreeMap<(usize, i64), (Value, Value)>,
    counts: BTreeMap<String, u64>,
}

impl OperationRows {
    fn take_row_change(&mut self, change: RowChange) {
        *self.counts.entry(change.table.clone()).or_default() += 1;
        // Derived rows are counted, but mean nothing to the user.
        let Some(table) = LOGGED_TABLE_NOUNS.iter().position(|known| known.0 == change.table) else {
            return;
        };
        let image = if change.after.is_null() {
            &change.before
        } else {
            &change.after
        };
        let key = (table, image.get("id").and_then(Value::as_i64).unwrap_or(-1));
        match self.images.get_mut(&key) {
            // Several changes of a row count as one, from its first state to its last.
            Some((_, after)) => *after = change.after,
            None => {
                self.order.push(key);
                self.images.insert(key, (change.before, change.after));
            }
        }
    }

    /// Returns the rows whose state at the end differs from that at the beginning, by table.
    fn changed_known_rows(&self) -> impl Iterator<Item = (usize, &Value, &Value)> {
        self.order.iter().filter_map(|key| {
            let (before, after) = self.images.get(key)?;
            // A row that ended as it began was not changed.
            (before != after).then_some((key.0, before, after))
        })
    }

    /// Returns the name of a row of `table` at the time of this operation, otherwise its present name.
    fn logged_row_name(&self, connection: &Connection, table: &str, id: i64) -> CorpusResult<Option<String>> {
        let table_index = LOGGED_TABLE_NOUNS.iter().position(|known| known.0 == table);
        let row_image = table_index.and_then(|known| {
            let (before, after) = self.images.get(&(known, id))?;
            // A removed row has only its former name.
            let image = if after.is_null() { before } else { after };
            Some(image.get(LOGGED_TABLE_NOUNS[known].2)?.as_str()?.to_owned())
        });
        match row_image {
            Some(name) => Ok(Some(name)),
            None => stored_history::name_of(connection, table, id),
        }
    }

    /// Returns the row that a row refers to, at the time of this operation, otherwise at present.
    fn refers(&self, connection: &Connection, table: &str, id: i64, column: &str) -> CorpusResult<Option<i64>> {
        let table_index = LOGGED_TABLE_NOUNS.iter().position(|known| known.0 == table);
        let row_image = table_index.and_then(|known| {
            let (before, after) = self.images.get(&(known, id))?;
            let image = if after.is_null() { before } else { after };
            image.get(column)?.as_i64()
        });
        match row_image {
            Some(id) => Ok(Some(id)),
            None => stored_history::reference_of(connection, table, id, column),
        }
    }
}

fn describe_changed_row(
    connection: &Connection,
    rows: &OperationRows,
    table: usize,
    before: &Value,
    after: &Value,
) -> CorpusResult<ChangedRow> {
    let (name_of_table, what, naming) = LOGGED_TABLE_NOUNS[table];
    let kind = match (before.is_null(), after.is_null()) {
        (true, _) => ChangeKind::Added,
        (_, true) => ChangeKind::Removed,
        _ => ChangeKind::Changed,
    };
    let image = if before.is_null() { after } else { before };
    let number = |column: &str| image.get(column).and_then(Value::as_i64);
    let text = |column: &str| image.get(column).and_then(Value::as_str).unwrap_or_default();
    let name = match text(naming) {
        // An annotation without a value is named by its state.
        "" => text("state").to_owned(),
        name => name.to_owned(),
    };
    let named = |table: &str, id: Option<i64>| match id {
        Some(id) => rows.logged_row_name(connection, table, id),
        None => Ok(None),
    };
    let place_names = match name_of_table {
        "annotation" => {
            let tier = number("tier_id");
            let recording = match tier {
                Some(tier) => rows.refers(connection, "tier", tier, "recording_id")?,
                None => None,
            };
            let (tier, recording) = (named("tier", tier)?, named("recording", recording)?);
            tier.zip(recording)
                .map_or_else(Vec::new, |(tier, recording)| vec![tier, recording])
        }
        "tier" | "recipe" => Vec::from_iter(named("recording", number("recording_id"))?),
        "sign_text" | "sign_relation" => Vec::from_iter(named("sign", number("sign_id"))?),
        "inventory_value" => Vec::from_iter(named("inventory", number("inventory_id"))?),
        _ => Vec::new(),
    };
    let mut fields = Vec::new();
    let both = [after, before].into_iter().filter_map(Value::as_object);
    // A removed row has columns only before, and an added one only after.
    let row_columns: Vec<&String> = both.take(1).flat_map(serde_json::Map::keys).collect();
    let columns = match row_columns.is_empty() {
        true => before.as_object().into_iter().flat_map(serde_json::Map::keys).collect(),
        false => row_columns,
    };
    for column in columns {
        let column_value = |image: &Value| image.get(column).cloned().unwrap_or(Value::Null);
        let (mut from, mut to) = (column_value(before), column_value(after));
        if from == to || UNREPORTED_COLUMNS.contains(&column.as_str()) {
            continue;
        }
        let mut field = column.clone();
        if let Some(other) = stored_history::refers_to(name_of_table, column) {
            for side in [&mut from, &mut to] {
                // The name says more to the user than the number of the row.
                if let Some(name) = named(other, side.as_i64())? {
                    *side = Value::from(name);
                }
            }
            field = column.trim_end_matches("_id").to_owned();
        }
        fields.push(FieldChange { field, from, to });
    }
    Ok(ChangedRow {
        what,
        id: image.get("id").and_then(Value::as_i64),
        name,
        place: (!place_names.is_empty()).then(|| place_names.join(" of ")),
        place_names,
        kind,
        fields,
    })
}

/// Returns the change of a row as a line of text.
#[must_use]
pub fn change_sentence(change: &ChangedRow, language: InterfaceLanguage) -> String {
    let time = |name: &str| {
        let field = change.fields.iter().find(|field| field.field == name)?;
        let micros = field.from.as_i64().or_else(|| field.to.as_i64())?;
        Some(RecordingInstant::from_micros(micros).to_string())
    };
    let place = match change.place_names.as_slice() {
        [] => Value::Null,
        [name] => json!({ "does": "row-place", "what": change.what, "name": name }),
        [name, whole, ..] => json!({ "does": "row-place-of", "name": name, "whole": whole }),
    };
    let span = match time("start_us").zip(time("end_us")) {
        Some((start, end)) => json!({ "does": "row-span", "start": start, "end": end }),
        None => Value::Null,
    };
    let fields = change.fields.iter().map(|field| described_field(field, language));
    let joined = |one: String, other: String| {
        let both = json!({ "does": "row-fields", "one": one, "other": other });
        described_value(&both, language)
    };
    let joined_fields = fields.reduce(joined);
    // If only columns without interest differ, the row got another place.
    let fields = joined_fields.map_or_else(|| json!({ "does": "row-order" }), Value::from);
    let does = match change.kind {
        ChangeKind::Added => "row-added",
        ChangeKind::Removed => "row-removed",
        ChangeKind::Changed => "row-changed",
    };
    let name = format!("{:?}", change.name);
    let row =
        json!({ "does": does, "what": change.what, "name": name, "place": place, "span": span, "fields": fields });
    described_value(&row, language)
}

/// Returns a field before and after.
fn described_field(change: &FieldChange, language: InterfaceLanguage) -> String {
    let is_time = change.field.ends_with("_us");
    let text = |value: &Value| match value {
        Value::Null => json!({ "does": "row-nothing" }),
        Value::String(text) => format!("{text:?}").into(),
        Value::Number(number) if is_time => {
            let micros = number.as_i64().unwrap_or_default();
            RecordingInstant::from_micros(micros).to_string().into()
        }
        other => other.to_string().into(),
    };
    let field = change.field.trim_end_matches("_us").replace('_', " ");
    let (from, to) = (text(&change.from), text(&change.to));
    let field = json!({ "does": "row-field", "field": field, "from": from, "to": to });
    described_value(&field, language)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::InterfaceLanguage;
    use crate::{
        AnnotateOptions, AnnotationAction, AnnotationName, NewTier, ProgressReceiver, RecordingChange, RowName,
        TierRequestName, TierRole, ignore_progress_step,
    };

    fn corpus(folder: &std::path::Path) -> Corpus {
        let file = folder.join("take.eaf");
        std::fs::write(&file, include_str!("export/tests.eaf")).expect("written");
        let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(
                &[file],
                &crate::ImportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("imported");
        let recording = RowName::Text("take".into());
        corpus
            .add_tier(&NewTier::new(recording, "Remarks", TierRole::Comment))
            .expect("added");
        corpus
    }

    fn annotate(corpus: &mut Corpus, actions: Vec<AnnotationAction>) -> i64 {
        let changes: Vec<_> = actions.into_iter().map(Into::into).collect();
        let mut hear = ignore_progress_step;
        let report = corpus
            .annotate_corpus(
                &changes,
                &AnnotateOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("annotated");
        report.annotations[0]
    }

    fn newest(corpus: &Corpus) -> Vec<String> {
        let id = corpus.operation_log(1).expect("log")[0].id;
        let detail = corpus.operation_detail(id, 10).expect("detail");
        assert_eq!(detail.total, detail.changes.len() as u64);
        let sentence = |change| change_sentence(change, InterfaceLanguage::English);
        detail.changes.iter().map(sentence).collect()
    }

    #[test]
    fn an_operation_shows_old_and_new_values() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        assert_eq!(newest(&corpus), ["added tier \"Remarks\" on take"]);
        let tier = TierRequestName::parse_tier_name("Remarks", Some(&RowName::Text("take".into()))).expect("a tier");
        let add = AnnotationAction::Add {
            tier,
            start: Some("0.1".parse().expect("a time")),
            end: Some("0.2".parse().expect("a time")),
            parent: None,
            order: None,
            value: "ja".into(),
            confidence: None,
        };
        let id = annotate(&mut corpus, vec![add]);
        assert_eq!(
            newest(&corpus),
            ["added annotation \"ja\" on Remarks of take, 0.100s to 0.200s"]
        );
        let set = AnnotationAction::Set {
            annotation: AnnotationName::Number(id),
            start: None,
            end: Some("0.3".parse().expect("a time")),
            value: Some("NUR".into()),
        };
        annotate(&mut corpus, vec![set]);
        assert_eq!(
            newest(&corpus),
            ["annotation \"ja\" on Remarks of take: end from 0.200s to 0.300s; value from \"ja\" to \"NUR\""]
        );
        corpus.undo_operation().expect("undone");
        assert_eq!(
            newest(&corpus),
            ["annotation \"NUR\" on Remarks of take: end from 0.300s to 0.200s; value from \"NUR\" to \"ja\""]
        );
        let remove = AnnotationAction::Remove {
            annotation: AnnotationName::Number(id),
        };
        annotate(&mut corpus, vec![remove]);
        assert_eq!(
            newest(&corpus),
            ["removed annotation \"ja\" on Remarks of take, 0.100s to 0.200s"]
        );
        let change = RecordingChange {
            name: Some("take two".into()),
            signer: Some(Some("Zoé".into())),
            ..RecordingChange::default()
        };
        corpus
            .change_recording(&RowName::Text("take".into()), &change)
            .expect("changed");
        let lines = newest(&corpus);
        assert!(lines.contains(&"added signer \"Zoé\"".to_owned()), "{lines:?}");
        assert!(
            lines.iter().any(|it| it
                .starts_with("recording \"take\": name from \"take\" to \"take two\"; signer from ")
                && it.ends_with(" to \"Zoé\"")),
            "{lines:?}"
        );
        assert!(corpus.operation_detail(99, 1).is_err());
        assert!(corpus.operation_detail(1, 1).expect("detail").changes.len() <= 1);
    }
}
