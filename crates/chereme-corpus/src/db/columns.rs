//! Columns that hold one of a few fixed words, read and written as Rust enums.
//!
//! The schema checks each of these columns against its list of words, or a table of them, so that reading fails only on
//! a damaged file.

use std::fmt;

use chereme_sign::tier::Hands;
use chereme_sign::{Component, Phase, Reading, Stereotype, TierRole};
use rusqlite::Row;
use rusqlite::types::{FromSql, FromSqlError, FromSqlResult, ToSql, ToSqlOutput, Type, ValueRef};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::error::Error;

/// A type whose values are stored by name.
pub(crate) trait Named: Copy + 'static {
    /// Every value.
    const ALL: &'static [Self];

    /// Returns the name under which the value is stored.
    fn stored(self) -> &'static str;

    /// Returns the value of that name, letter by letter.
    fn of_stored(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|it| it.stored() == name)
    }
}

/// A named value as a column holds it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Col<T>(pub(crate) T);

impl<T: Named> FromSql for Col<T> {
    fn column_result(value: ValueRef<'_>) -> FromSqlResult<Self> {
        let name = value.as_str()?;
        let found = T::of_stored(name).map(Self);
        found.ok_or_else(|| {
            FromSqlError::Other(format!("{name:?} is no word of this column").into())
        })
    }
}

impl<T: Named> ToSql for Col<T> {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        Ok(ToSqlOutput::from(self.0.stored()))
    }
}

/// Reads a column that always holds a word.
pub(crate) fn word<T: Named>(row: &Row<'_>, column: usize) -> rusqlite::Result<T> {
    row.get(column).map(|Col(value)| value)
}

/// Reads a column that may hold nothing.
pub(crate) fn word_or_null<T: Named>(row: &Row<'_>, column: usize) -> rusqlite::Result<Option<T>> {
    Ok(row
        .get::<_, Option<Col<T>>>(column)?
        .map(|Col(value)| value))
}

/// Reads the role of a tier from three columns, beginning at `column`.
pub(crate) fn role(row: &Row<'_>, column: usize) -> rusqlite::Result<TierRole> {
    let text = |column: usize| Ok::<_, rusqlite::Error>(row.get_ref(column)?.as_str_or_null()?);
    let (kind, component, feature) = (text(column)?, text(column + 1)?, text(column + 2)?);
    let kind = kind.unwrap_or_default();
    let role = TierRole::of_parts(kind, component, feature);
    if role.kind() != kind {
        let reason = format!("{kind:?} is no role of a tier").into();
        return Err(rusqlite::Error::FromSqlConversionFailure(
            column,
            Type::Text,
            reason,
        ));
    }
    Ok(role)
}

/// Returns the values of the three columns of a tier's role: its kind, its component and its feature.
pub(super) fn role_parts(role: &TierRole) -> (&'static str, Option<&'static str>, Option<&str>) {
    let (component, feature) = role.component().unzip();
    (
        role.kind(),
        component.map(Component::name),
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
pub(crate) fn phase(row: &Row<'_>, column: usize) -> rusqlite::Result<Option<Phase>> {
    let name = row.get_ref(column)?.as_str_or_null()?;
    let place: i64 = row.get(column + 1)?;
    Ok(match name {
        Some("initial") => Some(Phase::Initial),
        Some("middle") => Some(Phase::Middle(u8::try_from(place.max(1)).unwrap_or(u8::MAX))),
        Some("final") => Some(Phase::Final),
        _ => None,
    })
}

/// Returns the name under which a phase is stored; all middle phases have the same name.
pub(crate) fn phase_name(phase: Phase) -> &'static str {
    match phase {
        Phase::Initial => "initial",
        Phase::Middle(_) => "middle",
        Phase::Final => "final",
    }
}

/// Returns the number of a phase among those of its name: middle phases are counted from 1, the others are 0.
pub(crate) fn phase_place(phase: Option<Phase>) -> i64 {
    match phase {
        Some(Phase::Middle(place)) => i64::from(place),
        _ => 0,
    }
}

/// The way in which a recording or a token came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
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

impl Origin {
    /// Returns the name under which it is stored, such as `captured`.
    #[must_use]
    pub fn name(self) -> &'static str {
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
    /// [`Error::Wrong`] if no recording can have it.
    pub fn of_recording(name: &str) -> Result<Self, Error> {
        let found = Self::of_stored(name).filter(|it| *it != Self::Lexicon);
        found.ok_or_else(|| {
            Error::wrong(format!("{name:?} is no origin of a recording"))
                .at(name)
                .advise("write captured, made or generated")
        })
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
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
    pub fn name(self) -> &'static str {
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
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Unset => "unset",
            Self::NotApplicable => "not-applicable",
            Self::Unclear => "unclear",
        }
    }

    /// Returns the state of a reading.
    #[must_use]
    pub fn of(reading: &Reading) -> Self {
        match reading {
            Reading::Value(_) => Self::Value,
            Reading::Unset => Self::Unset,
            Reading::NotApplicable => Self::NotApplicable,
            Reading::Unclear => Self::Unclear,
        }
    }

    /// Returns the reading of a value in this state.
    #[must_use]
    pub fn reading(self, value: &str) -> Reading {
        match self {
            Self::Value => Reading::Value(value.to_owned()),
            Self::Unset => Reading::Unset,
            Self::NotApplicable => Reading::NotApplicable,
            Self::Unclear => Reading::Unclear,
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

impl Named for Origin {
    const ALL: &'static [Self] = &[Self::Captured, Self::Made, Self::Generated, Self::Lexicon];

    fn stored(self) -> &'static str {
        self.name()
    }
}

impl Named for AnnotationOrigin {
    const ALL: &'static [Self] = &[Self::File, Self::Human, Self::Detector, Self::Made];

    fn stored(self) -> &'static str {
        self.name()
    }
}

impl Named for ValueState {
    const ALL: &'static [Self] = &[Self::Value, Self::Unset, Self::NotApplicable, Self::Unclear];

    fn stored(self) -> &'static str {
        self.name()
    }
}

impl Named for Stereotype {
    const ALL: &'static [Self] = &Self::ALL;

    fn stored(self) -> &'static str {
        self.elan_name()
    }
}

impl Named for Component {
    const ALL: &'static [Self] = &Self::ALL;

    fn stored(self) -> &'static str {
        self.name()
    }
}

impl Named for Hands {
    const ALL: &'static [Self] = &Self::ALL;

    fn stored(self) -> &'static str {
        self.name()
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
            .query_row(
                "SELECT sql FROM sqlite_schema WHERE name = ?1",
                [table],
                |row| row.get(0),
            )
            .expect("a table");
        let list = format!("CHECK ({column} IN");
        let from = sql.find(&list).expect(column) + list.len();
        let words = sql[from..].split(')').next().expect("a list");
        words
            .split('\'')
            .skip(1)
            .step_by(2)
            .map(str::to_owned)
            .collect()
    }

    fn check<T: Named>(connection: &Connection, place: (&str, &str), without: &[&str]) {
        let own: BTreeSet<String> = T::ALL.iter().map(|it| it.stored().to_owned()).collect();
        let mut own = own;
        own.retain(|it| !without.contains(&it.as_str()));
        assert_eq!(own, allowed(connection, place.0, place.1), "{place:?}");
        for value in T::ALL {
            assert_eq!(
                T::of_stored(value.stored()).map(Named::stored),
                Some(value.stored())
            );
        }
    }

    #[test]
    fn every_word_that_the_schema_allows_has_its_value() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.chereme");
        drop(crate::Corpus::create(&path, "t").expect("created"));
        let connection = Connection::open(&path).expect("opened");
        check::<Stereotype>(&connection, ("tier", "stereotype"), &[]);
        check::<Component>(&connection, ("tier", "component"), &[]);
        check::<Hands>(&connection, ("tier", "hand"), &[]);
        check::<ValueState>(&connection, ("annotation", "state"), &[]);
        check::<AnnotationOrigin>(&connection, ("annotation", "origin"), &[]);
        check::<Origin>(&connection, ("recording", "origin"), &["lexicon"]);
        check::<Origin>(&connection, ("token", "origin"), &[]);
        check::<Hands>(&connection, ("token", "hand"), &[]);
        check::<Component>(&connection, ("token_value", "component"), &[]);
        check::<ValueState>(&connection, ("token_value", "state"), &[]);
        let read = |sql: &str| connection.query_row(sql, [], |row| self::role(row, 0));
        for words in TierRole::all_words() {
            let kind = words.kind();
            let component = (kind == "component").then_some("placement");
            let sql = format!(
                "SELECT '{kind}', {}, NULL",
                component.map_or("NULL", |_| "'placement'")
            );
            assert_eq!(read(&sql), Ok(TierRole::of_parts(kind, component, None)));
            assert_eq!(TierRole::of_parts(kind, component, None).kind(), kind);
        }
        assert!(read("SELECT 'unheard', NULL, NULL").is_err());
        assert!(read("SELECT 'component', NULL, NULL").is_err());
    }
}
