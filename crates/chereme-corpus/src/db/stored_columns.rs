//! Columns that hold one of a few fixed words, read and written as Rust enums.
//!
//! The schema checks each of these columns against its list of words, or a table of them, so that reading fails only on
//! a damaged file.

use std::fmt;

use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentReading, SignComponent, SignPhase, TierRole, TierStereotype};
use rusqlite::Row;
use rusqlite::types::{FromSql, FromSqlError, FromSqlResult, ToSql, ToSqlOutput, Type, ValueRef};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::error::CorpusError;

/// A type whose values are stored by name.
pub(crate) trait NamedValue: Copy + 'static {
    /// Every value.
    const ALL_NAMED_VALUES: &'static [Self];

    /// Returns the name under which the value is stored.
    fn stored_value_name(self) -> &'static str;

    /// Returns the value of that name, letter by letter.
    fn of_stored(name: &str) -> Option<Self> {
        Self::ALL_NAMED_VALUES
            .iter()
            .copied()
            .find(|candidate| candidate.stored_value_name() == name)
    }
}

/// A named value as a column holds it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NamedColumn<T>(pub(crate) T);

impl<T: NamedValue> FromSql for NamedColumn<T> {
    fn column_result(value: ValueRef<'_>) -> FromSqlResult<Self> {
        let name = value.as_str()?;
        let stored_value = T::of_stored(name).map(Self);
        stored_value.ok_or_else(|| FromSqlError::Other(format!("{name:?} is no word of this column").into()))
    }
}

impl<T: NamedValue> ToSql for NamedColumn<T> {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        Ok(ToSqlOutput::from(self.0.stored_value_name()))
    }
}

/// Reads a column that always holds a word.
pub(crate) fn read_word_column<T: NamedValue>(row: &Row<'_>, column: usize) -> rusqlite::Result<T> {
    row.get(column).map(|NamedColumn(value)| value)
}

/// Reads a column that may hold nothing.
pub(crate) fn word_or_null<T: NamedValue>(row: &Row<'_>, column: usize) -> rusqlite::Result<Option<T>> {
    Ok(row
        .get::<_, Option<NamedColumn<T>>>(column)?
        .map(|NamedColumn(value)| value))
}

/// Reads the role of a tier from three columns, beginning at `column`.
pub(crate) fn read_role_columns(row: &Row<'_>, column: usize) -> rusqlite::Result<TierRole> {
    let text = |column: usize| Ok::<_, rusqlite::Error>(row.get_ref(column)?.as_str_or_null()?);
    let (kind, component, feature) = (text(column)?, text(column + 1)?, text(column + 2)?);
    let kind = kind.unwrap_or_default();
    let role = TierRole::of_parts(kind, component, feature);
    // An unknown word is read as a free tier, which a damaged file must not turn into.
    if role.role_kind_name() != kind {
        let reason = format!("{kind:?} is no role of a tier").into();
        return Err(rusqlite::Error::FromSqlConversionFailure(column, Type::Text, reason));
    }
    Ok(role)
}

/// Returns the values of the three columns of a tier's role: its kind, its component and its feature.
pub(super) fn role_parts(role: &TierRole) -> (&'static str, Option<&'static str>, Option<&str>) {
    let (component, feature) = role.role_component().unzip();
    (
        role.role_kind_name(),
        component.map(SignComponent::component_name),
        feature.flatten(),
    )
}

/// Writes a role as the keys `role`, `component` and `feature` of the enclosing object.
pub(super) fn serialize_role<S: Serializer>(role: &TierRole, out: S) -> Result<S::Ok, S::Error> {
    let (kind, component, feature) = role_parts(role);
    let mut map = out.serialize_map(Some(3))?;
    map.serialize_entry("role", kind)?;
    map.serialize_entry("component", &component)?;
    map.serialize_entry("feature", &feature)?;
    map.end()
}

/// Reads a phase from its two columns: the name, and the number among several middle phases.
pub(crate) fn read_phase_columns(row: &Row<'_>, column: usize) -> rusqlite::Result<Option<SignPhase>> {
    let name = row.get_ref(column)?.as_str_or_null()?;
    let place: i64 = row.get(column + 1)?;
    Ok(match name {
        Some("initial") => Some(SignPhase::Initial),
        Some("middle") => Some(SignPhase::Middle(u8::try_from(place.max(1)).unwrap_or(u8::MAX))),
        Some("final") => Some(SignPhase::Final),
        _ => None,
    })
}

/// Returns the name under which a phase is stored; all middle phases have the same name.
pub(crate) fn phase_name(phase: SignPhase) -> &'static str {
    match phase {
        SignPhase::Initial => "initial",
        SignPhase::Middle(_) => "middle",
        SignPhase::Final => "final",
    }
}

/// Returns the number of a phase among those of its name: middle phases are counted from 1, the others are 0.
pub(crate) fn phase_place(phase: Option<SignPhase>) -> i64 {
    match phase {
        Some(SignPhase::Middle(place)) => i64::from(place),
        _ => 0,
    }
}

/// The way in which a recording or a token came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RecordOrigin {
    /// Captured from a signer.
    #[default]
    Captured,
    /// Built by a recipe of this program.
    Made,
    /// Synthesised by another program.
    Generated,
    /// An entry of a lexicon, without a recording; only for tokens.
    Lexicon,
}

impl RecordOrigin {
    /// Returns the name under which it is stored, such as `captured`.
    #[must_use]
    pub fn record_origin_name(self) -> &'static str {
        match self {
            Self::Captured => "captured",
            Self::Made => "made",
            Self::Generated => "generated",
            Self::Lexicon => "lexicon",
        }
    }

    /// Returns the origin of this name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::of_stored(name)
    }

    /// Returns the origin of that name for a recording.
    ///
    /// # Errors
    /// [`CorpusError::Wrong`] if no recording can have it.
    pub fn parse_recording_origin(name: &str) -> Result<Self, CorpusError> {
        let stored_origin = Self::of_stored(name).filter(|origin| *origin != Self::Lexicon);
        stored_origin.ok_or_else(|| {
            CorpusError::from_wrong_message(format!("{name:?} is no origin of a recording"))
                .with_error_place(name)
                .with_advice("write captured, made or generated")
        })
    }
}

impl fmt::Display for RecordOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.record_origin_name())
    }
}

/// The source of an annotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum AnnotationOrigin {
    /// An annotation file.
    File,
    /// A person.
    #[default]
    Human,
    /// A detector.
    Detector,
    /// The maker of a sign.
    Made,
}

impl AnnotationOrigin {
    /// Returns the name under which it is stored.
    #[must_use]
    pub fn annotation_origin_name(self) -> &'static str {
        match self {
            Self::File => "file",
            Self::Human => "human",
            Self::Detector => "detector",
            Self::Made => "made",
        }
    }
}

/// State of the value of an annotation, or of a component of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ValueState {
    /// It has a value.
    Value,
    /// Nobody has coded it.
    #[default]
    Unset,
    /// The field does not apply.
    NotApplicable,
    /// Somebody looked and could not decide.
    Unclear,
}

impl ValueState {
    /// Returns the name under which it is stored: `value`, `unset`, `not-applicable` or `unclear`.
    #[must_use]
    pub fn value_state_name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Unset => "unset",
            Self::NotApplicable => "not-applicable",
            Self::Unclear => "unclear",
        }
    }

    /// Returns the state of a reading.
    #[must_use]
    pub fn state_of_reading(reading: &ComponentReading) -> Self {
        match reading {
            ComponentReading::Value(_) => Self::Value,
            ComponentReading::Unset => Self::Unset,
            ComponentReading::NotApplicable => Self::NotApplicable,
            ComponentReading::Unclear => Self::Unclear,
        }
    }

    /// Returns the reading of a value in this state.
    #[must_use]
    pub fn reading_with_value(self, value: &str) -> ComponentReading {
        match self {
            Self::Value => ComponentReading::Value(value.to_owned()),
            Self::Unset => ComponentReading::Unset,
            Self::NotApplicable => ComponentReading::NotApplicable,
            Self::Unclear => ComponentReading::Unclear,
        }
    }

    /// Returns the text that stands for a missing value in files, tables and commands: `n/a`, `unclear`, or `unset`.
    #[must_use]
    pub fn missing_text(self) -> Option<&'static str> {
        match self {
            Self::Value => None,
            Self::Unset => Some("unset"),
            Self::NotApplicable => Some("n/a"),
            Self::Unclear => Some("unclear"),
        }
    }

    /// Returns the text that an annotation file has for a value in this state; the empty text if nothing was coded.
    #[must_use]
    pub fn file_text(self, value: &str) -> &str {
        match self {
            Self::Value => value,
            Self::Unset => "",
            Self::NotApplicable | Self::Unclear => self.missing_text().unwrap_or_default(),
        }
    }

    /// Returns the state that a text in an annotation file stands for, on a tier of glosses or components.
    #[must_use]
    pub fn of_file_text(text: &str) -> Self {
        match text {
            "" => Self::Unset,
            "n/a" => Self::NotApplicable,
            "unclear" => Self::Unclear,
            _ => Self::Value,
        }
    }
}

/// Why something that is said of a token does not count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum OpinionStanding {
    /// A detector proposes it, and nobody has accepted it.
    Proposed,
    /// A detector proposed it, and a person rejected it.
    Rejected,
    /// Annotators say different things, and nothing decides between them.
    Disputed,
    /// It is the value that counts, said by one more annotator.
    Agreed,
    /// The value of an adjudication or of the preferred annotator counts in its place.
    Replaced,
}

impl OpinionStanding {
    /// Returns whether rows of tokens leave it out: a detector's annotation is proposed, and others are disputed.
    pub(crate) fn is_usual(self) -> bool {
        matches!(self, Self::Proposed | Self::Disputed)
    }

    /// Returns the name in queries and answers.
    #[must_use]
    pub fn standing_name(self) -> &'static str {
        match self {
            Self::Proposed => "proposed",
            Self::Rejected => "rejected",
            Self::Disputed => "disputed",
            Self::Agreed => "agreed",
            Self::Replaced => "replaced",
        }
    }
}

impl NamedValue for OpinionStanding {
    const ALL_NAMED_VALUES: &'static [Self] = &[
        Self::Proposed,
        Self::Rejected,
        Self::Disputed,
        Self::Agreed,
        Self::Replaced,
    ];

    fn stored_value_name(self) -> &'static str {
        self.standing_name()
    }
}

impl NamedValue for RecordOrigin {
    const ALL_NAMED_VALUES: &'static [Self] = &[Self::Captured, Self::Made, Self::Generated, Self::Lexicon];

    fn stored_value_name(self) -> &'static str {
        self.record_origin_name()
    }
}

impl NamedValue for AnnotationOrigin {
    const ALL_NAMED_VALUES: &'static [Self] = &[Self::File, Self::Human, Self::Detector, Self::Made];

    fn stored_value_name(self) -> &'static str {
        self.annotation_origin_name()
    }
}

impl NamedValue for ValueState {
    const ALL_NAMED_VALUES: &'static [Self] = &[Self::Value, Self::Unset, Self::NotApplicable, Self::Unclear];

    fn stored_value_name(self) -> &'static str {
        self.value_state_name()
    }
}

impl NamedValue for TierStereotype {
    const ALL_NAMED_VALUES: &'static [Self] = &Self::ALL_TIER_STEREOTYPES;

    fn stored_value_name(self) -> &'static str {
        self.elan_name()
    }
}

impl NamedValue for SignComponent {
    const ALL_NAMED_VALUES: &'static [Self] = &Self::ALL_COMPONENTS;

    fn stored_value_name(self) -> &'static str {
        self.component_name()
    }
}

impl NamedValue for AnnotatedHands {
    const ALL_NAMED_VALUES: &'static [Self] = &Self::ALL_ANNOTATED_HANDS;

    fn stored_value_name(self) -> &'static str {
        self.annotated_hands_name()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use rusqlite::Connection;

    use super::*;

    /// Returns the words that the schema allows in a column, as the newest table of that name lists them.
    fn allowed(connection: &Connection, table: &str, column: &str) -> BTreeSet<String> {
        let sql: String = connection
            .query_row("SELECT sql FROM sqlite_schema WHERE name = ?1", [table], |row| {
                row.get(0)
            })
            .expect("a table");
        let list = format!("CHECK ({column} IN");
        let from = sql.find(&list).expect(column) + list.len();
        let words = sql[from..].split(')').next().expect("a list");
        words.split('\'').skip(1).step_by(2).map(str::to_owned).collect()
    }

    fn check<T: NamedValue>(connection: &Connection, place: (&str, &str), without: &[&str]) {
        let own: BTreeSet<String> = T::ALL_NAMED_VALUES
            .iter()
            .map(|it| it.stored_value_name().to_owned())
            .collect();
        let mut own = own;
        own.retain(|it| !without.contains(&it.as_str()));
        assert_eq!(own, allowed(connection, place.0, place.1), "{place:?}");
        for value in T::ALL_NAMED_VALUES {
            assert_eq!(
                T::of_stored(value.stored_value_name()).map(NamedValue::stored_value_name),
                Some(value.stored_value_name())
            );
        }
    }

    #[test]
    fn every_word_that_the_schema_allows_has_its_value() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.chereme");
        drop(crate::Corpus::create_corpus(&path, "t").expect("created"));
        let connection = Connection::open(&path).expect("opened");
        check::<TierStereotype>(&connection, ("tier", "stereotype"), &[]);
        check::<SignComponent>(&connection, ("tier", "component"), &[]);
        check::<AnnotatedHands>(&connection, ("tier", "hand"), &[]);
        check::<ValueState>(&connection, ("annotation", "state"), &[]);
        check::<AnnotationOrigin>(&connection, ("annotation", "origin"), &[]);
        check::<RecordOrigin>(&connection, ("recording", "origin"), &["lexicon"]);
        check::<RecordOrigin>(&connection, ("token", "origin"), &[]);
        check::<AnnotatedHands>(&connection, ("token", "hand"), &[]);
        check::<SignComponent>(&connection, ("token_value", "component"), &[]);
        check::<ValueState>(&connection, ("token_value", "state"), &[]);
        let read = |sql: &str| connection.query_row(sql, [], |row| self::read_role_columns(row, 0));
        for words in TierRole::all_words() {
            let kind = words.usual_kind_name();
            let component = (kind == "component").then_some("placement");
            let sql = format!("SELECT '{kind}', {}, NULL", component.map_or("NULL", |_| "'placement'"));
            assert_eq!(read(&sql), Ok(TierRole::of_parts(kind, component, None)));
            assert_eq!(TierRole::of_parts(kind, component, None).role_kind_name(), kind);
        }
        assert!(read("SELECT 'unheard', NULL, NULL").is_err());
        assert!(read("SELECT 'component', NULL, NULL").is_err());
    }
}
