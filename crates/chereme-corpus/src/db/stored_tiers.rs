//! Rows of tiers and annotations.

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::{AnnotatedHands, AnnotationId, Tier, TierAnnotation, TierId, TierSet};
use chereme_sign::{ComponentReading, SignComponent, TierRole, TierStereotype, TierTopic};
use rusqlite::{Connection, Row, params};
use serde::Serialize;

use super::stored_columns::{
    AnnotationOrigin, NamedColumn, ValueState, read_role_columns, read_word_column, role_parts, serialize_role,
    word_or_null,
};
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

/// The longest value of an annotation and the longest gloss, in bytes.
const LONGEST_VALUE: usize = 1 << 20;

/// A tier of a recording.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TierRow {
    /// The row.
    pub id: i64,
    /// The recording's row.
    pub recording_id: i64,
    /// The name, which no other tier of the recording has.
    pub name: String,
    /// Its place among the recording's tiers.
    pub position: i64,
    /// The tier above.
    pub parent_id: Option<i64>,
    /// The relation to the tier above.
    pub stereotype: Option<TierStereotype>,
    /// The subject of its annotations; in JSON the keys `role`, `component` and `feature`.
    #[serde(flatten, serialize_with = "serialize_role")]
    pub role: TierRole,
    /// The hand or hands that it describes.
    pub hand: Option<AnnotatedHands>,
    /// The person who is annotated.
    pub participant: Option<String>,
    /// The annotator.
    pub annotator: Option<String>,
    /// The language of its values.
    pub language: Option<String>,
    /// The inventory its values come from.
    pub inventory_id: Option<i64>,
    /// Properties from its file that have no column, as JSON.
    pub source: Option<String>,
}

/// Display settings of a tier, read from the ELAN settings file beside its annotation file.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(default)]
pub struct TierShown {
    /// Its place among the tiers, from 0.
    pub order: Option<usize>,
    /// Its colour, such as `#00a0ff`.
    pub colour: Option<String>,
    /// Whether it is hidden.
    pub hidden: bool,
}

/// The suffix of the names of tiers with proposals.
pub(crate) const PROPOSAL_TIER_SUFFIX: &str = " (proposed)";

/// The suffix of the names of tiers with proposals that a person rejected.
pub(crate) const REJECTED_TIER_SUFFIX: &str = " (rejected)";

/// Returns the name of the tier that accepted values from a tier with proposals are moved to; `None` for other tiers.
#[must_use]
pub fn proposed_for(tier: &str) -> Option<&str> {
    tier.strip_suffix(PROPOSAL_TIER_SUFFIX)
}

/// Returns whether a tier of this name holds what a detector says, whether nobody has decided on it or a person rejected it.
#[must_use]
pub fn is_detector_tier(tier: &str) -> bool {
    proposed_for(tier).is_some() || tier.ends_with(REJECTED_TIER_SUFFIX)
}

/// Distinguishes what a detector says, and no person accepted or corrected, for an annotation `a` on a tier `t`: also where a file
/// brought a tier of proposals.
macro_rules! is_proposal_sql {
    () => {
        "(a.origin = 'detector' OR a.origin = 'file' AND (t.name LIKE '% (proposed)' OR t.name LIKE '% (rejected)'))"
    };
}
pub(crate) use is_proposal_sql;

impl TierRow {
    /// Returns whether an annotation of this tier is what a detector says, and no person accepted or corrected.
    pub(crate) fn is_proposal(&self, row: &AnnotationRow) -> bool {
        match row.origin {
            AnnotationOrigin::Detector => true,
            AnnotationOrigin::File => is_detector_tier(&self.name),
            AnnotationOrigin::Human | AnnotationOrigin::Made => false,
        }
    }

    /// Returns the tier's display settings from ELAN.
    #[must_use]
    pub fn elan_display_settings(&self) -> TierShown {
        // Most tiers have a source without settings, and parsing JSON for each is slow.
        let parsed_source = self.source.as_deref().filter(|text| text.contains("\"shown\""));
        let source = parsed_source.and_then(|text| serde_json::from_str::<serde_json::Value>(text).ok());
        let shown = source.and_then(|mut object| object.get_mut("shown").map(serde_json::Value::take));
        shown
            .and_then(|shown| serde_json::from_value(shown).ok())
            .unwrap_or_default()
    }

    /// Returns the role with the hands, such as `right.configuration`.
    pub(crate) fn tier_topic(&self) -> TierTopic {
        TierTopic {
            role: self.role.clone(),
            hand: self.hand,
        }
    }

    /// Returns whether the tier holds glosses of signs, rather than proposals for some.
    pub(crate) fn holds_glosses(&self) -> bool {
        self.role == TierRole::Gloss && !is_detector_tier(&self.name)
    }

    /// Returns whether the tier divides movement into phases, which belong to a stretch of signing rather than to a
    /// sign.
    pub(crate) fn is_of_phases(&self) -> bool {
        self.role.role_component() == Some((SignComponent::Movement, Some("phase")))
    }
}

/// Returns those tiers of a recording whose annotations are tokens: those of glosses, but not one that says the signs of
/// the glosses above it once more, one to one.
pub(crate) fn token_tiers(tiers: &[TierRow]) -> impl Iterator<Item = &TierRow> {
    let parent_of = |tier: &TierRow| tiers.iter().find(|above| Some(above.id) == tier.parent_id);
    tiers.iter().filter(move |tier| {
        let repeats = tier.stereotype == Some(TierStereotype::SymbolicAssociation)
            && parent_of(tier).is_some_and(|above| above.role == TierRole::Gloss);
        tier.holds_glosses() && !repeats
    })
}

/// An annotation.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub(crate) struct AnnotationRow {
    /// The row.
    pub id: i64,
    /// The tier's row.
    pub tier_id: i64,
    /// Where it starts, in microseconds.
    pub start_us: i64,
    /// The first microsecond after it.
    pub end_us: i64,
    /// Whether it has a value.
    pub state: ValueState,
    /// The value.
    pub value: String,
    /// The annotation above.
    pub parent_id: Option<i64>,
    /// Its place in a symbolic subdivision, from 0; 0 elsewhere.
    pub position: i64,
    /// Its source.
    pub origin: AnnotationOrigin,
    /// The confidence of its source, from 0 to 1.
    pub confidence: Option<f64>,
    /// Its id in the file it came from.
    pub external_id: Option<String>,
    /// Its start in that file, in milliseconds, as long as it has not been moved.
    pub file_start_ms: Option<i64>,
    /// Its end in that file, in milliseconds, as long as it has not been moved.
    pub file_end_ms: Option<i64>,
    /// Properties from its file that have no column, as JSON.
    pub source: Option<String>,
}

impl AnnotationRow {
    fn check_length(&self) -> CorpusResult<()> {
        let place = || match &self.external_id {
            Some(id) => format!("annotation {id:?}"),
            None => format!("annotation at {}", RecordingInstant::from_micros(self.start_us)),
        };
        check_text(place, &self.value)
    }

    /// Returns its span on the clock of the recording.
    pub(crate) fn annotation_row_span(&self) -> TimeSpan {
        TimeSpan::from_span_micros(self.start_us, self.end_us)
    }

    /// Returns the state with the value.
    pub(crate) fn annotation_reading(&self) -> ComponentReading {
        self.state.reading_with_value(&self.value)
    }

    /// Returns whether it has a value that is not blank.
    pub(crate) fn is_filled(&self) -> bool {
        self.state == ValueState::Value && !self.value.trim().is_empty()
    }

    /// Returns the text that an annotation file has for it.
    pub(crate) fn file_text(&self) -> &str {
        self.state.file_text(&self.value)
    }
}

const SELECT_TIER_SQL: &str = "SELECT id, recording_id, name, position, parent_id, stereotype, role, component,
    feature, hand, participant, annotator, language, inventory_id, source FROM tier";

fn tier_row(row: &Row<'_>) -> rusqlite::Result<TierRow> {
    Ok(TierRow {
        id: row.get(0)?,
        recording_id: row.get(1)?,
        name: row.get(2)?,
        position: row.get(3)?,
        parent_id: row.get(4)?,
        stereotype: word_or_null(row, 5)?,
        role: read_role_columns(row, 6)?,
        hand: word_or_null(row, 9)?,
        participant: row.get(10)?,
        annotator: row.get(11)?,
        language: row.get(12)?,
        inventory_id: row.get(13)?,
        source: row.get(14)?,
    })
}

const SELECT_ANNOTATION_SQL: &str = "SELECT id, tier_id, start_us, end_us, state, value, parent_id, position,
    origin, confidence, external_id, file_start_ms, file_end_ms, source FROM annotation";

fn annotation_row(row: &Row<'_>) -> rusqlite::Result<AnnotationRow> {
    Ok(AnnotationRow {
        id: row.get(0)?,
        tier_id: row.get(1)?,
        start_us: row.get(2)?,
        end_us: row.get(3)?,
        state: read_word_column(row, 4)?,
        value: row.get(5)?,
        parent_id: row.get(6)?,
        position: row.get(7)?,
        origin: read_word_column(row, 8)?,
        confidence: row.get(9)?,
        external_id: row.get(10)?,
        file_start_ms: row.get(11)?,
        file_end_ms: row.get(12)?,
        source: row.get(13)?,
    })
}

/// Writes a tier and returns its row; its `id` is not used.
pub(crate) fn insert_tier(connection: &Connection, row: &TierRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO tier (recording_id, name, position, parent_id, stereotype, role, component,
                 feature, hand, participant, annotator, language, inventory_id, source)
             VALUES (?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15)";
    write_tier(connection, sql, row)?;
    Ok(connection.last_insert_rowid())
}

/// Writes a tier's row again.
pub(crate) fn update_tier(connection: &Connection, row: &TierRow) -> CorpusResult<()> {
    let sql = "UPDATE tier SET name = ?3, position = ?4, parent_id = ?5, stereotype = ?6, role = ?7,
                 component = ?8, feature = ?9, hand = ?10, participant = ?11, annotator = ?12,
                 language = ?13, inventory_id = ?14, source = ?15 WHERE id = ?1";
    write_tier(connection, sql, row)
}

/// Runs a statement with the columns of a tier in their order as parameters.
fn write_tier(connection: &Connection, sql: &str, row: &TierRow) -> CorpusResult<()> {
    let (role, component, feature) = role_parts(&row.role);
    let values = params![
        row.id,
        row.recording_id,
        row.name,
        row.position,
        row.parent_id,
        row.stereotype.map(NamedColumn),
        role,
        component,
        feature,
        row.hand.map(NamedColumn),
        row.participant,
        row.annotator,
        row.language,
        row.inventory_id,
        row.source
    ];
    connection.change_rows(sql, values)
}

/// Deletes a tier that has no annotations any more.
pub(crate) fn delete_tier(connection: &Connection, id: i64) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM tier WHERE id = ?1", [id])
}

/// Returns the tier of that row.
pub(crate) fn load_tier_row(connection: &Connection, id: i64) -> CorpusResult<TierRow> {
    connection
        .find_row(&format!("{SELECT_TIER_SQL} WHERE id = ?1"), [id], tier_row)?
        .ok_or_else(|| {
            CorpusError::from_wrong_message(format!("there is no tier:{id}"))
                .with_error_place(format!("tier:{id}"))
                .with_command_advice("`chereme list CORPUS tiers` lists them")
        })
}

/// Returns the tiers of a recording in their order.
pub(crate) fn load_tier_rows(connection: &Connection, recording: i64) -> CorpusResult<Vec<TierRow>> {
    let sql = format!("{SELECT_TIER_SQL} WHERE recording_id = ?1 ORDER BY position, id");
    connection.read_rows(&sql, [recording], tier_row)
}

/// Returns the recording of a tier; `None` if the tier no longer exists.
pub(crate) fn find_tier_recording(connection: &Connection, tier: i64) -> CorpusResult<Option<i64>> {
    let mut statement = connection.prepare_cached("SELECT recording_id FROM tier WHERE id = ?1")?;
    let mut rows = statement.query_map([tier], |row| row.get(0))?;
    Ok(rows.next().transpose()?)
}

/// Returns one tier for each role and hand among the tiers of a name, except tiers without a role.
pub(crate) fn roles_named(connection: &Connection, name: &str) -> CorpusResult<Vec<TierRow>> {
    // SQLite fills the other columns from one row of each group, and any of them will do.
    let sql = format!(
        "{SELECT_TIER_SQL} WHERE name = ?1 AND role <> 'free' GROUP BY role, component, feature, hand ORDER BY id"
    );
    connection.read_rows(&sql, [name], tier_row)
}

/// Writes an annotation and returns its row; its `id` is not used.
pub(crate) fn insert_annotation(connection: &Connection, row: &AnnotationRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO annotation (tier_id, start_us, end_us, state, value, parent_id, position,
                 origin, confidence, external_id, file_start_ms, file_end_ms, source)
             VALUES (?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)";
    write_annotation(connection, sql, row)?;
    Ok(connection.last_insert_rowid())
}

/// Refuses a text that is longer than any value.
pub(crate) fn check_text(place: impl FnOnce() -> String, text: &str) -> CorpusResult<()> {
    let length = text.len();
    if length <= LONGEST_VALUE {
        return Ok(());
    }
    Err(CorpusError::from_wrong_message(format!(
        "the value has {length} bytes, and a value has at most {LONGEST_VALUE}"
    ))
    .with_error_place(place())
    .with_advice("shorten it in the file that it comes from"))
}

/// Writes an annotation's row again.
pub(crate) fn update_annotation(connection: &Connection, row: &AnnotationRow) -> CorpusResult<()> {
    let sql = "UPDATE annotation SET tier_id = ?2, start_us = ?3, end_us = ?4, state = ?5, value = ?6,
                 parent_id = ?7, position = ?8, origin = ?9, confidence = ?10, external_id = ?11,
                 file_start_ms = ?12, file_end_ms = ?13, source = ?14 WHERE id = ?1";
    write_annotation(connection, sql, row)
}

/// Runs a statement with the columns of an annotation in their order as parameters.
fn write_annotation(connection: &Connection, sql: &str, row: &AnnotationRow) -> CorpusResult<()> {
    row.check_length()?;
    let values = params![
        row.id,
        row.tier_id,
        row.start_us,
        row.end_us,
        NamedColumn(row.state),
        row.value,
        row.parent_id,
        row.position,
        NamedColumn(row.origin),
        row.confidence,
        row.external_id,
        row.file_start_ms,
        row.file_end_ms,
        row.source
    ];
    connection.change_rows(sql, values)
}

/// Deletes an annotation that no row refers to any more.
pub(crate) fn delete_annotation(connection: &Connection, id: i64) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM annotation WHERE id = ?1", [id])
}

/// Returns the annotation of that row.
pub(crate) fn load_annotation_row(connection: &Connection, id: i64) -> CorpusResult<AnnotationRow> {
    connection
        .find_row(&format!("{SELECT_ANNOTATION_SQL} WHERE id = ?1"), [id], annotation_row)?
        .ok_or_else(|| {
            CorpusError::from_wrong_message(format!("there is no annotation:{id}"))
                .with_error_place(format!("annotation:{id}"))
                .with_command_advice("`chereme list CORPUS annotations` lists them")
        })
}

/// Returns the annotations of a tier, by time.
pub(crate) fn load_tier_annotation_rows(connection: &Connection, tier: i64) -> CorpusResult<Vec<AnnotationRow>> {
    let sql = format!("{SELECT_ANNOTATION_SQL} WHERE tier_id = ?1 ORDER BY start_us, position, id");
    query_annotation_rows(connection, &sql, params![tier])
}

/// An annotated handshape.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ConfigurationSpan {
    pub(crate) tier_id: i64,
    pub(crate) start_us: i64,
    pub(crate) end_us: i64,
    pub(crate) value: String,
}

/// Returns up to `most` annotated handshapes of movement that was not generated by a recipe, by tier and time.
pub(crate) fn configuration_spans(connection: &Connection, most: usize) -> CorpusResult<Vec<ConfigurationSpan>> {
    let sql = "SELECT a.tier_id, a.start_us, a.end_us, a.value
         FROM tier t JOIN recording r ON r.id = t.recording_id JOIN annotation a ON a.tier_id = t.id
         WHERE t.component = 'configuration' AND t.feature IS NULL AND r.origin <> 'made'
           AND a.state = 'value' AND a.origin <> 'detector'
         ORDER BY a.tier_id, a.start_us, a.id LIMIT ?1";
    connection.read_rows(sql, [i64::try_from(most).unwrap_or(i64::MAX)], |row| {
        Ok(ConfigurationSpan {
            tier_id: row.get(0)?,
            start_us: row.get(1)?,
            end_us: row.get(2)?,
            value: row.get(3)?,
        })
    })
}

/// Returns the annotations of a tier that overlap or touch a span, by time.
///
/// No annotation that starts earlier than the span by more than the length of the tier's longest annotation can reach
/// it, so that few rows are read even on a long tier.
pub(crate) fn annotations_near(
    connection: &Connection,
    tier: i64,
    start_us: i64,
    end_us: i64,
) -> CorpusResult<Vec<AnnotationRow>> {
    // An index orders annotations by length, so that the longest is found at once.
    let sql = format!(
        "{SELECT_ANNOTATION_SQL} WHERE tier_id = ?1 AND end_us >= ?2 AND start_us <= ?3
             AND start_us >= ?2 - (SELECT a.end_us - a.start_us FROM annotation a WHERE a.tier_id = ?1
                                   ORDER BY a.end_us - a.start_us DESC LIMIT 1)
         ORDER BY start_us, position, id"
    );
    query_annotation_rows(connection, &sql, params![tier, start_us, end_us])
}

/// Returns the annotations that hang below one, by tier and time.
pub(crate) fn load_child_annotations(connection: &Connection, parent: i64) -> CorpusResult<Vec<AnnotationRow>> {
    let sql = format!("{SELECT_ANNOTATION_SQL} WHERE parent_id = ?1 ORDER BY tier_id, start_us, position, id");
    query_annotation_rows(connection, &sql, params![parent])
}

fn query_annotation_rows(
    connection: &Connection,
    sql: &str,
    params: impl rusqlite::Params,
) -> CorpusResult<Vec<AnnotationRow>> {
    connection.read_rows(sql, params, annotation_row)
}

/// Returns the tiers of a recording with all their annotations, for a check of the tier rules.
pub(crate) fn load_tier_set(connection: &Connection, recording: i64) -> CorpusResult<TierSet> {
    let mut annotations = Vec::new();
    let mut all = Vec::new();
    for row in load_tier_rows(connection, recording)? {
        for annotation in load_tier_annotation_rows(connection, row.id)? {
            annotations.push(TierAnnotation {
                id: AnnotationId(annotation.id as u64),
                tier: TierId(row.id as u64),
                parent: annotation.parent_id.map(|id| AnnotationId(id as u64)),
                order: u32::try_from(annotation.position).unwrap_or(u32::MAX),
                span: annotation.annotation_row_span(),
                value: ComponentReading::from(annotation.value.as_str()),
            });
        }
        all.push(Tier {
            id: TierId(row.id as u64),
            name: row.name,
            role: row.role,
            hand: row.hand.and_then(AnnotatedHands::single_hand),
            parent: row.parent_id.map(|id| TierId(id as u64)).zip(row.stereotype),
            vocabulary: None,
        });
    }
    Ok(TierSet::new(all, annotations))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn tier_of(spans: &[(i64, i64)]) -> Connection {
        let connection = Connection::open_in_memory().expect("opened");
        connection
            .execute_batch(chereme_data::schema_text("sql/0001_corpus.sql"))
            .and_then(|()| {
                connection.execute_batch(
                    "INSERT INTO recording (id, name, origin) VALUES (1, 'R', 'captured');
                     INSERT INTO tier (id, recording_id, name, position, role)
                         VALUES (1, 1, 'A', 0, 'free'), (2, 1, 'B', 1, 'free')",
                )
            })
            .expect("made");
        for &(start_us, end_us) in spans {
            let row = AnnotationRow {
                tier_id: 1,
                start_us,
                end_us,
                state: ValueState::Value,
                origin: AnnotationOrigin::File,
                ..AnnotationRow::default()
            };
            insert_annotation(&connection, &row).expect("written");
        }
        connection
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn near_annotations_are_those_that_touch_the_span(
            spans in proptest::collection::vec((-50i64..50, 0i64..40), 0..20),
            (start, length) in (-60i64..60, 0i64..30),
        ) {
            let spans: Vec<_> = spans.iter().map(|(from, long)| (*from, from + long)).collect();
            let connection = tier_of(&spans);
            let end = start + length;
            let near = annotations_near(&connection, 1, start, end).expect("read");
            let mut near: Vec<_> = near.iter().map(|row| (row.start_us, row.end_us)).collect();
            let touches = |span: &&(i64, i64)| span.0 <= end && span.1 >= start;
            let mut want: Vec<_> = spans.iter().filter(touches).copied().collect();
            near.sort_unstable();
            want.sort_unstable();
            prop_assert_eq!(near, want);
            prop_assert!(annotations_near(&connection, 2, start, end).expect("read").is_empty());
        }
    }
}
