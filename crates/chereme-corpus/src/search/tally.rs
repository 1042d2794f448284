//! Frequency tables: the number of tokens found that have each value of one field, or of two.

use std::collections::BTreeMap;

use chereme_sign::query::{Property, Query, TextField, What};
use chereme_sign::{Field, Reading};
use serde::Serialize;

use super::compile::{Ask, Asked, Failure};
use super::docs::{self, Docs};
use super::known::KnownReading;
use super::probe::{Doc, Probe, RowField, Text};
use super::{compile, plan, wrong};
use crate::Corpus;
use crate::db::search::answers::{self, Named};
use crate::db::search::terms::{TokenProperty, hands_of, phase_counts, text_of};
use crate::error::{Error, Result};
use crate::progress::Progress;

/// The largest number of cells in a cross table.
const MOST_CELLS: usize = 1_000_000;

/// The row or column of the tokens that have no value of a field.
pub const NO_VALUE: &str = "unset";
/// The row or column of the tokens for which a field is coded as not applicable.
const NOT_APPLICABLE: &str = "n/a";
/// The row or column of the tokens for which a field is coded as unclear.
const UNCLEAR: &str = "unclear";

/// Number of tokens for each value of one field, or each pair of values of two fields.
///
/// A token with several values of a field is counted for each of them, as a query for each would match it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tally {
    /// The query in its canonical form.
    pub query: String,
    /// How many tokens it finds.
    pub total: usize,
    /// The fields, one or two, by their house names.
    pub fields: Vec<String>,
    /// The values of the second field, the most frequent first; empty if there is one field.
    pub columns: Vec<String>,
    /// A row for each value of the first field, the most frequent first; then those of `n/a` and `unclear`, and
    /// [`NO_VALUE`] last. A value that is spelled like one of these is in quotation marks, as in a query.
    pub rows: Vec<TallyRow>,
}

/// A row of a [`Tally`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TallyRow {
    /// The value of the first field.
    pub value: String,
    /// How many tokens have it.
    pub total: usize,
    /// How many of them have each value of the second field.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub counts: Vec<usize>,
}

impl Corpus {
    /// Counts the values of one or two fields among the tokens that a query finds.
    ///
    /// A field is a component (`placement`, `weak.configuration`), `gloss`, or a property such as
    /// `signer`, `origin` or `recording`.
    ///
    /// # Errors
    /// Those of [`search`](Self::search), [`Error::Wrong`] if a field has no values to count, or the
    /// table would be too large, and [`Error::Stopped`].
    pub fn tally(
        &mut self,
        query: &str,
        fields: &[String],
        progress: &mut Progress<'_>,
    ) -> Result<Tally> {
        let subjects = fields.iter().map(|field| subject(field));
        let subjects: Vec<Subject> = subjects.collect::<Result<_>>()?;
        if subjects.is_empty() || subjects.len() > 2 {
            return Err(Error::wrong("values of one field or of two are counted")
                .advise("name for example placement, or placement and signer"));
        }
        self.asked(query, progress, &mut |ask, query| {
            tally(ask, query, &subjects)
        })
    }
}

/// The subject of a count.
enum Subject {
    Component(Field),
    Property(Property),
    Gloss,
}

impl Subject {
    fn name(&self) -> String {
        match self {
            Self::Component(field) => field.to_string(),
            Self::Property(property) => property.name().to_owned(),
            Self::Gloss => TextField::Gloss.name().to_owned(),
        }
    }
}

fn subject(name: &str) -> Result<Subject> {
    let asked = format!("{}=*", name.trim());
    let query = Query::parse(&asked).map_err(|error| {
        // A time compares with times only, and has no values to count.
        match Query::parse(&format!("{}>0s", name.trim())) {
            Ok(_) => uncounted(name),
            Err(_) => wrong(&asked, &error),
        }
    })?;
    match query.tests()[..] {
        [test] => match &test.what {
            What::Component(field, _) => Ok(Subject::Component(field.clone())),
            What::Property(property, _) => Ok(Subject::Property(*property)),
            What::Whole(TextField::Gloss, _) => Ok(Subject::Gloss),
            What::Attribute(own, _) if own == name.trim() => Err(Error::wrong(format!(
                "there is no field {name:?}, and attributes are not counted"
            ))
            .at(name)
            .advise(COUNTED)),
            _ => Err(uncounted(name)),
        },
        _ => Err(uncounted(name)),
    }
}

/// The remedy for a field whose values are not counted.
const COUNTED: &str =
    "count a component such as placement, or gloss, signer, recording, origin, hand";

fn uncounted(name: &str) -> Error {
    Error::wrong(format!("values of {name:?} are not counted"))
        .at(name)
        .advise(COUNTED)
}

fn tally(ask: &Ask<'_>, query: &Query, subjects: &[Subject]) -> Asked<Tally> {
    let plan = compile::plan(ask, &query.root)?;
    let found = plan::evaluate(ask, &plan, None)?;
    let mut groups = subjects
        .iter()
        .map(|subject| groups(ask, &found, subject))
        .collect::<Asked<Vec<_>>>()?
        .into_iter();
    let rows = groups.next().unwrap_or_default();
    let columns = groups.next().unwrap_or_default();
    if rows.len().saturating_mul(columns.len()) > MOST_CELLS {
        let message = format!(
            "the table would have {} rows and {} columns",
            rows.len(),
            columns.len()
        );
        let remedy = "count fields of fewer values, or one field";
        return Err(Failure::Other(Error::wrong(message).advise(remedy)));
    }
    let mut of_doc: BTreeMap<Doc, Vec<usize>> = BTreeMap::new();
    for (number, (_, docs)) in columns.iter().enumerate() {
        for doc in docs {
            of_doc.entry(*doc).or_default().push(number);
        }
    }
    let row = |(value, docs): (String, Docs)| {
        let mut counts = vec![0; columns.len()];
        for number in docs.iter().filter_map(|doc| of_doc.get(doc)).flatten() {
            counts[*number] += 1;
        }
        TallyRow {
            value,
            total: docs.len(),
            counts,
        }
    };
    Ok(Tally {
        query: query.to_string(),
        total: found.len(),
        fields: subjects.iter().map(Subject::name).collect(),
        rows: rows.into_iter().map(row).collect(),
        columns: columns.into_iter().map(|(value, _)| value).collect(),
    })
}

/// Returns the values of a field with the documents that have each, the most frequent first.
fn groups(ask: &Ask<'_>, found: &[Doc], subject: &Subject) -> Asked<Vec<(String, Docs)>> {
    let mut groups = match subject {
        Subject::Component(field) => of_component(ask, found, field)?,
        Subject::Gloss => of_rows(ask, found, RowField::Sign, Named::Sign)?,
        Subject::Property(property) => match property {
            Property::Signer => of_rows(ask, found, RowField::Signer, Named::Signer)?,
            Property::Recording => of_rows(ask, found, RowField::Recording, Named::Recording)?,
            Property::Sign => of_rows(ask, found, RowField::Sign, Named::Sign)?,
            Property::Origin => of_mark(ask, found, TokenProperty::Origin)?,
            Property::Hand => of_mark(ask, found, TokenProperty::Hand)?,
            Property::Tier => of_mark(ask, found, TokenProperty::Tier)?,
            Property::Inventory => of_mark(ask, found, TokenProperty::Inventory)?,
            _ => return Err(Failure::Other(uncounted(property.name()))),
        },
    };
    groups.retain(|(_, docs)| !docs.is_empty());
    groups.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then_with(|| a.0.cmp(&b.0)));
    for (value, _) in &mut groups {
        if [NOT_APPLICABLE, UNCLEAR, NO_VALUE].contains(&value.as_str()) {
            *value = format!("\"{value}\"");
        }
    }
    let mut unset = Docs::new();
    if let Subject::Component(field) = subject {
        for (name, reading) in [
            (NOT_APPLICABLE, Reading::NotApplicable),
            (UNCLEAR, Reading::Unclear),
        ] {
            groups.push((name.to_owned(), missing(ask, found, field, &reading)?));
        }
        unset = missing(ask, found, field, &Reading::Unset)?;
    }
    let mut all: Docs = groups.iter().flat_map(|(_, docs)| docs).copied().collect();
    all.sort_unstable();
    all.dedup();
    unset.extend(docs::difference(found, &all));
    unset.sort_unstable();
    unset.dedup();
    groups.push((NO_VALUE.to_owned(), unset));
    groups.retain(|(_, docs)| !docs.is_empty());
    Ok(groups)
}

fn of_component(ask: &Ask<'_>, found: &[Doc], field: &Field) -> Asked<Vec<(String, Docs)>> {
    let known = ask.readings(field.component)?;
    let mut groups = Vec::new();
    let values = known.parts.get(&field.feature).into_iter();
    for known in values.flat_map(|values| values.values()).flatten() {
        if let Reading::Value(value) = &known.reading {
            groups.push((value.clone(), having(ask, found, field, known)?));
        }
    }
    Ok(groups)
}

/// Returns the documents for which a field is coded as one of the readings without a value.
fn missing(ask: &Ask<'_>, found: &[Doc], field: &Field, reading: &Reading) -> Asked<Docs> {
    let known = ask.readings(field.component)?;
    let values = known.parts.get(&field.feature);
    let alike = values.and_then(|values| values.get(text_of(reading)));
    let known = alike.and_then(|alike| alike.iter().find(|it| it.reading == *reading));
    known.map_or(Ok(Docs::new()), |known| having(ask, found, field, known))
}

/// Returns the documents that have a reading with the hand and the phase of a field.
fn having(ask: &Ask<'_>, found: &[Doc], field: &Field, known: &KnownReading) -> Asked<Docs> {
    let hands = hands_of(field.hand);
    let terms = known.terms.iter();
    let own =
        terms.filter(|(hand, phase, _)| hands.contains(hand) && phase_counts(field.phase, phase));
    let texts: Vec<&str> = own.map(|(_, _, term)| term.as_str()).collect();
    let docs = ask.run(&Probe::readings(texts))?;
    Ok(docs::intersection(&docs, found))
}

fn of_mark(ask: &Ask<'_>, found: &[Doc], mark: TokenProperty) -> Asked<Vec<(String, Docs)>> {
    let prefix = mark.prefix();
    let mut groups = Vec::new();
    for term in ask.now.terms(Text::Reading, &prefix, &|_| true)? {
        let docs = ask.run(&Probe::readings([&term]))?;
        let value = term[prefix.len()..].to_owned();
        groups.push((value, docs::intersection(&docs, found)));
    }
    Ok(groups)
}

fn of_rows(
    ask: &Ask<'_>,
    found: &[Doc],
    field: RowField,
    named: Named,
) -> Asked<Vec<(String, Docs)>> {
    let rows = ask.now.rows(field)?;
    let mut by_row: BTreeMap<i64, Docs> = BTreeMap::new();
    for doc in found {
        if let Some(row) = rows.get(*doc) {
            by_row.entry(row).or_default().push(*doc);
        }
    }
    let mut groups = Vec::with_capacity(by_row.len());
    for (row, docs) in by_row {
        let name = answers::name(ask.connection, named, row)?;
        groups.push((name.unwrap_or_default(), docs));
    }
    Ok(groups)
}
