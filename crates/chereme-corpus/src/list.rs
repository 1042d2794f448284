//! Lists of rows of the corpus, filtered and sorted.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use chereme_sign::ComponentField;
use chereme_sign::hamnosys::to_names;
use chereme_sign::text::{did_you_mean, nearest_candidate};
use chereme_sign::tier::AnnotatedHands;
use rusqlite::Connection;
use serde::Serialize;
use serde_json::{Map, Value};

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::signs::{self, TokenValueRow};
use crate::db::stored_list::{self as rows, ColumnCondition, ListColumnContent, ListRequest, ListTable};
use crate::db::stored_tiers;
use crate::error::{CorpusError, CorpusResult};
use crate::notation;

/// The kind of rows in a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListKind {
    /// Recordings.
    Recordings,
    /// Tracks of recordings.
    Tracks,
    /// Signs.
    Signs,
    /// Tokens.
    Tokens,
    /// Tiers.
    Tiers,
    /// Annotations.
    Annotations,
    /// Inventories.
    Inventories,
    /// Values of inventories.
    Values,
    /// Signers.
    Signers,
    /// Saved searches.
    Searches,
    /// Perceptual studies.
    Studies,
    /// Operations, newest first.
    Operations,
}

impl ListKind {
    /// Every kind.
    pub const ALL_LIST_KINDS: [Self; 12] = [
        Self::Recordings,
        Self::Tracks,
        Self::Signs,
        Self::Tokens,
        Self::Tiers,
        Self::Annotations,
        Self::Inventories,
        Self::Values,
        Self::Signers,
        Self::Searches,
        Self::Studies,
        Self::Operations,
    ];

    /// Returns the name, such as `recordings`.
    #[must_use]
    pub fn list_kind_name(self) -> &'static str {
        match self {
            Self::Recordings => "recordings",
            Self::Tracks => "tracks",
            Self::Signs => "signs",
            Self::Tokens => "tokens",
            Self::Tiers => "tiers",
            Self::Annotations => "annotations",
            Self::Inventories => "inventories",
            Self::Values => "values",
            Self::Signers => "signers",
            Self::Searches => "searches",
            Self::Studies => "studies",
            Self::Operations => "operations",
        }
    }

    /// Returns the names of the columns, in order.
    #[must_use]
    pub fn list_column_names(self) -> Vec<&'static str> {
        self.list_kind_table()
            .columns
            .iter()
            .map(|column| column.name)
            .collect()
    }

    fn singular(self) -> &'static str {
        match self {
            Self::Inventories => "inventory",
            Self::Searches => "search",
            Self::Studies => "study",
            other => other.list_kind_name().trim_end_matches('s'),
        }
    }

    fn list_kind_table(self) -> &'static ListTable {
        match self {
            Self::Recordings => &rows::RECORDINGS_LIST,
            Self::Tracks => &rows::TRACKS_LIST,
            Self::Signs => &rows::SIGNS_LIST,
            Self::Tokens => &rows::TOKENS_LIST,
            Self::Tiers => &rows::TIERS_LIST,
            Self::Annotations => &rows::ANNOTATIONS_LIST,
            Self::Inventories => &rows::INVENTORIES_LIST,
            Self::Values => &rows::INVENTORY_VALUES_LIST,
            Self::Signers => &rows::SIGNERS_LIST,
            Self::Searches => &rows::SEARCHES_LIST,
            Self::Studies => &rows::STUDIES_LIST,
            Self::Operations => &rows::OPERATIONS_LIST,
        }
    }

    /// Returns the column of that name; for recordings `recording` means their name, and so on.
    fn find_list_column(self, name: &str) -> CorpusResult<usize> {
        let columns = self.list_kind_table().columns;
        let name = name.trim();
        let is_singular = self.singular() == name;
        let index = columns
            .iter()
            // Users name the column by the kind of row, as queries do.
            .position(|column| column.name == name || (is_singular && matches!(column.name, "name" | "gloss" | "key")));
        index.ok_or_else(|| {
            let names = columns.iter().map(|column| column.name);
            let suggestion = did_you_mean(nearest_candidate(name, names.clone()));
            let all: Vec<&str> = names.collect();
            CorpusError::from_wrong_message(format!("{} have no column {name:?}{suggestion}", self.list_kind_name()))
                .with_error_place(name)
                .with_advice(format!("the columns are: {}", all.join(", ")))
        })
    }
}

impl fmt::Display for ListKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.list_kind_name())
    }
}

impl FromStr for ListKind {
    type Err = CorpusError;

    fn from_str(text: &str) -> CorpusResult<Self> {
        let names = Self::ALL_LIST_KINDS.map(Self::list_kind_name);
        Self::ALL_LIST_KINDS
            .into_iter()
            .find(|kind| kind.list_kind_name() == text)
            .ok_or_else(|| {
                let suggestion = did_you_mean(nearest_candidate(text, names));
                CorpusError::from_wrong_message(format!("{text:?} cannot be listed{suggestion}"))
                    .with_error_place(text)
                    .with_advice(format!("what can be listed: {}", names.join(", ")))
            })
    }
}

/// Filter and order of a list.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ListFilter {
    /// Columns and their conditions.
    ///
    /// The condition of a text column is a pattern such as `BO*`, ignoring case and accents; of a number a number,
    /// `>5`, `>=5`, `<5`, `<=5` or `2..5`; of a flag `yes` or `no`. `none` means an empty cell in any column.
    /// `recording`, `signer` and `tier` also accept addresses such as `recording:3`.
    pub columns: Vec<(String, String)>,
    /// The column to sort by.
    pub sort: Option<String>,
    /// Whether the greatest value comes first.
    pub descending: bool,
    /// The most rows to list; all by default.
    pub limit: Option<usize>,
    /// The number of rows to skip.
    pub offset: usize,
}

impl ListFilter {}

/// Rows for display.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListedRows {
    /// The number of rows that meet the conditions, including those that are not listed.
    pub total: u64,
    /// The rows, each with every column of [`ListKind::list_column_names`] in that order.
    pub rows: Vec<Map<String, Value>>,
}

impl Corpus {
    /// Lists rows of one kind.
    ///
    /// # Errors
    /// Fails if a column does not exist or a pattern does not suit its type.
    pub fn list_rows(&self, kind: ListKind, filter: &ListFilter) -> CorpusResult<ListedRows> {
        let connection = self.store.read_connection();
        let mut wanted = ListRequest {
            limit: filter.limit,
            offset: filter.offset,
            ..ListRequest::default()
        };
        for (name, pattern) in &filter.columns {
            let column = kind.find_list_column(name)?;
            let test = self.parse_column_condition(kind, column, pattern.trim())?;
            wanted.tests.push((column, test));
        }
        if let Some(name) = &filter.sort {
            wanted.sort = Some((kind.find_list_column(name)?, filter.descending));
        }
        let (total, mut listed) = rows::query_list_rows(connection, kind.list_kind_table(), &wanted)?;
        // These columns are not in the rows themselves, so they are filled in for the listed rows alone.
        if matches!(kind, ListKind::Tokens | ListKind::Signs) {
            add_notations(connection, &mut listed)?;
        }
        if kind == ListKind::Tokens {
            for row in &mut listed {
                let token = row.get("id").and_then(Value::as_i64).unwrap_or_default();
                let values = signs::load_token_values(connection, token)?;
                row.insert("components".to_owned(), token_values_by_field(&values));
            }
        }
        Ok(ListedRows { total, rows: listed })
    }

    fn parse_column_condition(&self, kind: ListKind, at: usize, pattern: &str) -> CorpusResult<ColumnCondition> {
        let column = &kind.list_kind_table().columns[at];
        if pattern.eq_ignore_ascii_case("none") || pattern.is_empty() {
            return Ok(ColumnCondition::Nothing);
        }
        let unfit = |right: &str| {
            CorpusError::from_wrong_message(format!("the column {:?} cannot be {pattern:?}", column.name))
                .with_error_place(pattern)
                .with_advice(right)
        };
        match column.holds {
            ListColumnContent::Text => Ok(match self.find_addressed_row(kind, column.name, pattern)? {
                Some(row) => ColumnCondition::Row(row),
                None => ColumnCondition::Like(pattern.to_owned()),
            }),
            ListColumnContent::Json(_) | ListColumnContent::Notation(_) => {
                // The cell is shown as a list, and a pattern is meant for one of its parts.
                Ok(ColumnCondition::Like(format!("*{pattern}*")))
            }
            ListColumnContent::Number => {
                parse_between_condition(pattern).ok_or_else(|| unfit("write a number, >5, >=5, <5, <=5, 2..5, or none"))
            }
            ListColumnContent::Flag => match pattern.to_lowercase().as_str() {
                "yes" | "true" | "1" => Ok(ColumnCondition::Is(true)),
                "no" | "false" | "0" => Ok(ColumnCondition::Is(false)),
                _ => Err(unfit("write yes or no")),
            },
            ListColumnContent::Components => Err(CorpusError::from_wrong_message(
                "tokens are filtered by their components with a query",
            )
            .with_error_place(pattern)
            .with_command_advice("`chereme search CORPUS 'right.configuration=U'`")),
        }
    }

    /// Returns the row that an address such as `recording:3` names, if the column holds such rows.
    fn find_addressed_row(&self, kind: ListKind, column: &str, pattern: &str) -> CorpusResult<Option<i64>> {
        let connection = self.store.read_connection();
        let of = |what: &str| column == what || (column == "name" && kind.singular() == what);
        Ok(match pattern.parse() {
            Ok(CorpusAddress::Recording(name)) if of("recording") => {
                Some(address::find_recording_by_name(connection, &name)?.id)
            }
            Ok(CorpusAddress::Signer(name)) if of("signer") => {
                Some(address::find_signer_by_name(connection, &name)?.id)
            }
            // A column of parents holds tiers, too.
            Ok(CorpusAddress::Tier(tier)) if of("tier") || column == "parent" => {
                Some(stored_tiers::load_tier_row(connection, tier)?.id)
            }
            Ok(CorpusAddress::Sign(RowName::Number(sign))) if column == "gloss" => Some(sign),
            Ok(CorpusAddress::Sign(RowName::Text(gloss))) if column == "gloss" => {
                Some(address::find_sign_by_gloss(connection, &gloss)?)
            }
            _ => None,
        })
    }
}

fn parse_between_condition(pattern: &str) -> Option<ColumnCondition> {
    // No number lies between bounds that are no numbers.
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| !number.is_nan());
    let (low, high) = (f64::MIN, f64::MAX);
    if let Some((least, most)) = pattern.split_once("..") {
        let least = if least.trim().is_empty() { low } else { number(least)? };
        let most = if most.trim().is_empty() { high } else { number(most)? };
        return Some(ColumnCondition::Between(least, most));
    }
    let (least, most) = if let Some(text) = pattern.strip_prefix(">=") {
        (number(text)?, high)
    } else if let Some(text) = pattern.strip_prefix("<=") {
        (low, number(text)?)
    } else if let Some(text) = pattern.strip_prefix('>') {
        // The bounds are inclusive, so the least number above stands for an open bound.
        (number(text)?.next_up(), high)
    } else if let Some(text) = pattern.strip_prefix('<') {
        (low, number(text)?.next_down())
    } else {
        (number(pattern)?, number(pattern)?)
    };
    Some(ColumnCondition::Between(least, most))
}

/// Returns the values of a token by field, such as `initial.right.placement`; a list if a field has several. A value
/// that does not apply is `n/a`, an unclear one `unclear`.
fn token_values_by_field(values: &[TokenValueRow]) -> Value {
    let mut map = Map::new();
    for row in values {
        let phase = row.phase.map(|phase| phase.to_string());
        let parts = [
            phase.as_deref(),
            row.hand.map(AnnotatedHands::annotated_hands_name),
            Some(row.component.component_name()),
            row.feature.as_deref(),
        ];
        let field: Vec<&str> = parts.into_iter().flatten().collect();
        let value_text = row.state.missing_text().or(row.value.as_deref());
        let value = Value::from(value_text.unwrap_or_default());
        match map.get_mut(&field.join(".")) {
            Some(Value::Array(several)) => several.push(value),
            // A field gets a list only when it has a second value, so that one value stays plain.
            Some(one) => *one = Value::Array(vec![one.take(), value]),
            None => {
                map.insert(field.join("."), value);
            }
        }
    }
    Value::Object(map)
}

/// Replaces each token in the column `notation` by its notation as JSON: `{"token", "system", "file", "line", "text",
/// "document"}`.
fn add_notations(connection: &Connection, rows: &mut [Map<String, Value>]) -> CorpusResult<()> {
    let token = |row: &Map<String, Value>| row.get("notation").and_then(Value::as_i64);
    let tokens: Vec<i64> = rows.iter().filter_map(token).collect();
    let mut notations = notation::of_tokens(connection, &tokens)?;
    for row in rows {
        let row_notation = token(row).and_then(|token| notations.remove(&token));
        let json_value =
            serde_json::to_value(row_notation).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
        row.insert("notation".to_owned(), json_value);
    }
    Ok(())
}

/// Returns a cell of a row as text for a table.
#[must_use]
pub fn cell_text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Bool(yes) => if *yes { "yes" } else { "no" }.to_owned(),
        Value::Array(all) => all.iter().map(cell_text).collect::<Vec<_>>().join(", "),
        // An object with these keys is a notation, which is shown by the names of its symbols.
        Value::Object(map) if map.contains_key("system") && map.contains_key("document") => {
            let text = map.get("text").and_then(Value::as_str);
            let names = text.and_then(|text| to_names(text).ok());
            match names.map(|names| names.join(" ")) {
                Some(names) => names,
                None => text.map_or_else(|| cell_text(&map["system"]), str::to_owned),
            }
        }
        Value::Object(map) => match (map.get("language"), map.get("text")) {
            // An object of just these two is a translation.
            (Some(Value::String(language)), Some(Value::String(text))) if map.len() == 2 => {
                if language.is_empty() {
                    text.clone()
                } else {
                    format!("{text} ({language})")
                }
            }
            _ => components_text(map),
        },
        other => other.to_string(),
    }
}

/// Returns fields with their values as text for a table: successive values of a component together, such as
/// `right.configuration=S>C`, simultaneous values as `arc+twisting`.
#[must_use]
pub fn components_text<'v>(fields: impl IntoIterator<Item = (&'v String, &'v Value)>) -> String {
    let mut cells: Vec<(String, BTreeMap<_, String>)> = Vec::new();
    for (name, value) in fields {
        // Values of successive phases belong to one field.
        let (field, phase) = match name.parse::<ComponentField>() {
            Ok(field @ ComponentField { phase: Some(_), .. }) => {
                let plain_field = ComponentField {
                    phase: None,
                    ..field.clone()
                };
                (plain_field.to_string(), field.phase)
            }
            _ => (name.clone(), None),
        };
        let text = match value {
            Value::Array(all) => all.iter().map(cell_text).collect::<Vec<_>>().join("+"),
            one => cell_text(one),
        };
        match cells.iter_mut().find(|(known, _)| *known == field) {
            Some((_, phases)) => {
                phases.insert(phase, text);
            }
            None => cells.push((field, BTreeMap::from([(phase, text)]))),
        }
    }
    let texts = cells.into_iter().map(|(field, phases)| {
        let values: Vec<_> = phases.into_values().collect();
        format!("{field}={}", values.join(">"))
    });
    texts.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin, ValueState};
    use crate::db::stored_tiers::{AnnotationRow, TierRow};
    use crate::db::{signs as sign_rows, stored_recordings};
    use crate::{inventories, tokens};
    use chereme_sign::TierRole;
    use serde_json::json;

    fn corpus() -> (tempfile::TempDir, Corpus) {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        corpus
            .store
            .named_operation("fill", |connection| {
                let signer = stored_recordings::signer_named(connection, "Anna", Some("left"))?;
                for (name, gloss) in [("One", "BOL"), ("Two", "Écœuré")] {
                    let recording = stored_recordings::RecordingRow {
                        id: 0,
                        name: name.into(),
                        signer_id: (name == "One").then_some(signer),
                        signer: None,
                        origin: RecordOrigin::Captured,
                        duration_us: 1_000_000,
                        licence: None,
                        notes: None,
                    };
                    let recording_id = stored_recordings::insert_recording(connection, &recording)?;
                    let tier = TierRow {
                        recording_id,
                        name: "Gloss".into(),
                        role: TierRole::Gloss,
                        ..TierRow::default()
                    };
                    let tier_id = stored_tiers::insert_tier(connection, &tier)?;
                    let row = |start_us, value: &str| AnnotationRow {
                        tier_id,
                        start_us,
                        end_us: start_us + 100_000,
                        state: ValueState::Value,
                        value: value.into(),
                        origin: AnnotationOrigin::File,
                        ..AnnotationRow::default()
                    };
                    stored_tiers::insert_annotation(connection, &row(0, gloss))?;
                    stored_tiers::insert_annotation(connection, &row(200_000, "CHAT"))?;
                    tokens::update_recording_tokens(
                        connection,
                        recording_id,
                        None,
                        &inventories::load_all_inventories(connection)?,
                    )?;
                }
                let sign = sign_rows::sign_of_annotation(connection, None, "BOL")?;
                sign_rows::add_text(connection, sign, "en", "bowl")?;
                sign_rows::add_text(connection, sign, "", "schaal")?;
                Ok(((), String::new()))
            })
            .expect("filled");
        (folder, corpus)
    }

    #[test]
    fn rows_are_filtered_and_sorted() {
        let (_folder, corpus) = corpus();
        for (kind, filter, sort, column, want) in [
            ("recordings", "", "", "name", "One Two"),
            ("recordings", "", "-name", "name", "Two One"),
            ("recordings", "recording=recording:2", "", "name", "Two"),
            ("recordings", "signer=none", "", "name", "Two"),
            ("recordings", "signer=ANNA", "", "name", "One"),
            ("tokens", "", "gloss", "gloss", "BOL CHAT CHAT Écœuré"),
            ("tokens", "", "-gloss", "gloss", "Écœuré CHAT CHAT BOL"),
            ("tokens", "gloss=ec*", "", "gloss", "Écœuré"),
            ("tokens", "gloss=C*; recording=Two", "", "id", "4"),
            ("tokens", "recording=recording:1", "", "gloss", "BOL CHAT"),
            ("tokens", "signer=signer:Anna", "", "id", "1 2"),
            ("tokens", "citation=no", "", "id", "4"),
            ("tokens", "start_us=>0", "", "id", "2 4"),
            ("tokens", "start_us=0..100", "-id", "id", "3 1"),
            ("signs", "translations=bow", "", "gloss", "BOL"),
            ("signs", "tokens=>=2", "", "gloss", "CHAT"),
            ("signs", "gloss=sign:chat", "", "gloss", "CHAT"),
            ("tiers", "role=gloss", "", "recording", "One Two"),
            ("annotations", "tier=tier:2; value=CHAT", "", "start_us", "200000"),
            ("inventories", "component=placement", "", "key", "placements"),
            ("values", "inventory=configurations; value=U", "", "value", "U"),
            ("values", "component=configuration; names=victory", "", "inventory", ""),
            ("signers", "", "", "handedness", "left"),
            ("operations", "", "", "name", "fill"),
            ("operations", "stands=yes", "", "id", "1"),
        ] {
            let mut list = ListFilter::default();
            for part in filter.split("; ").filter(|part| !part.is_empty()) {
                let (column, pattern) = part.split_once('=').expect("a filter");
                list.columns.push((column.to_owned(), pattern.to_owned()));
            }
            list.descending = sort.starts_with('-');
            list.sort = Some(sort.trim_start_matches('-').to_owned()).filter(|sort| !sort.is_empty());
            let kind: ListKind = kind.parse().expect("a kind");
            let listing = corpus.list_rows(kind, &list).expect(filter);
            let cells: Vec<String> = listing.rows.iter().map(|row| cell_text(&row[column])).collect();
            assert_eq!(cells.join(" "), want, "{kind} {filter} {sort}");
            assert_eq!(listing.total, listing.rows.len() as u64);
            for row in &listing.rows {
                assert!(row.keys().eq(kind.list_column_names()), "{kind}");
            }
        }
    }

    #[test]
    fn pages_report_the_total_number_of_rows() {
        let (_folder, corpus) = corpus();
        let filter = ListFilter {
            limit: Some(2),
            offset: 1,
            ..ListFilter::default()
        };
        let listing = corpus.list_rows(ListKind::Tokens, &filter).expect("listed");
        assert_eq!((listing.total, listing.rows.len()), (4, 2));
        assert_eq!(listing.rows[0]["id"], 2);
        let texts = corpus
            .list_rows(ListKind::Signs, &ListFilter::default())
            .expect("listed");
        assert_eq!(cell_text(&texts.rows[0]["translations"]), "bowl (en), schaal");
    }

    #[test]
    fn components_are_read_in_the_order_of_their_phases() {
        let row = json!({
            "final.right.configuration": "A", "initial.right.configuration": "S",
            "middle.right.configuration": "C", "middle2.right.configuration": ["1", "U"],
            "right.movement": ["arc", "wrist"], "initial.weak.placement": "chin",
        });
        assert_eq!(
            cell_text(&row),
            "right.configuration=S>C>1+U>A right.movement=arc+wrist weak.placement=chin"
        );
        let notation = json!({ "system": "hamnosys", "text": "\u{e000}\u{e020}", "document": {} });
        assert_eq!(cell_text(&notation), "hamfist hamextfingeru");
        let notation = json!({ "system": "sigml", "text": null, "document": {} });
        assert_eq!(cell_text(&notation), "sigml");
    }

    #[test]
    fn invalid_columns_and_patterns_are_refused_with_a_remedy() {
        let (_folder, corpus) = corpus();
        for (column, pattern, want) in [
            ("glos", "x", "did you mean \"gloss\"?"),
            ("start_us", "soon", "cannot be \"soon\""),
            ("citation", "perhaps", "cannot be \"perhaps\""),
            ("components", "U", "with a query"),
            ("recording", "recording:9", "no recording:9"),
        ] {
            let filter = ListFilter {
                columns: vec![(column.to_owned(), pattern.to_owned())],
                ..ListFilter::default()
            };
            let error = corpus.list_rows(ListKind::Tokens, &filter).expect_err(column);
            assert!(error.to_string().contains(want), "{error}");
            assert!(error.error_remedy().is_some());
        }
        assert!(
            "tokns"
                .parse::<ListKind>()
                .is_err_and(|error| error.to_string().contains("\"tokens\""))
        );
    }
}
