//! Statistics of a lexicon: how much its fields say, which of them go together, and conditions on the two hands.

mod battison;
mod between;
mod fields;
mod findings;
mod table;
#[cfg(test)]
mod tests;

use chereme_analysis::statistics::Undefined;
use serde::Serialize;

pub use battison::{Battison, HandCondition, TwoHands};
pub use between::{Chance, CrossCell, FieldAssociation};
pub use fields::{FieldContrast, FieldInDepth, FieldStatistics, FieldValue};
pub use findings::StatsFinding;

use crate::Corpus;
use crate::error::{Error, Result};
use crate::forms::{Empty, Form, FormSource, Forms, named_fields, numbered};
use crate::progress::Progress;

/// The most shuffles for p.
const MOST_SAMPLES: usize = 100_000;
/// The level of all intervals.
const LEVEL: f64 = 0.95;

/// The fields to describe, and the statistics that are wanted besides an overview of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatsOptions {
    /// The fields that make a form, as in [`PairOptions`](crate::PairOptions). If empty, all coded fields: the columns
    /// that code components if [`of`](Self::of) or [`between`](Self::between) names columns, else the fields of queries.
    pub fields: Vec<String>,
    /// The treatment of an empty cell where forms are compared.
    pub empty: Empty,
    /// The tokens to count, as a query; without it every sign counts once.
    pub query: Option<String>,
    /// A field whose values and contrasts are wanted.
    pub of: Option<String>,
    /// Two fields whose association is wanted.
    pub between: Option<[String; 2]>,
    /// Whether Battison's conditions are wanted.
    pub battison: bool,
    /// The handshapes that a passive hand may have; Battison's seven if empty.
    pub unmarked: Vec<String>,
    /// The number of shuffles for p; 0: no p.
    pub samples: usize,
    /// The seed of the shuffles.
    pub seed: u64,
}

impl Default for StatsOptions {
    fn default() -> Self {
        Self {
            fields: Vec::new(),
            empty: Empty::Value,
            query: None,
            of: None,
            between: None,
            battison: false,
            unmarked: Vec::new(),
            samples: 1000,
            seed: 1,
        }
    }
}

/// The statistics of a lexicon.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LexiconStatistics {
    /// The place from which values come.
    pub source: FormSource,
    /// The number of signs, or of tokens found.
    pub entries: usize,
    /// The number of entries whose forms are compared: those without an empty field if empty cells are unknown.
    pub compared: usize,
    /// The number of different forms among them.
    pub forms: usize,
    /// The entropy of forms in bits, weighted by entries: H(L).
    pub entropy: Estimate,
    /// The fields that make a form, in the order asked for.
    pub fields: Vec<FieldStatistics>,
    /// One field in depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub of: Option<FieldInDepth>,
    /// The association of two fields.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub between: Option<FieldAssociation>,
    /// The conditions on the two hands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub battison: Option<Battison>,
    /// The oddities.
    pub findings: Vec<StatsFinding>,
}

/// A number, or the reason for its absence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimate {
    /// The number.
    pub value: Option<f64>,
    /// The reason why there is no number.
    pub why: Option<&'static str>,
    /// The interval of 95 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<Ends>,
}

/// The ends of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ends {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Estimate {
    fn new(value: std::result::Result<f64, Undefined>) -> Self {
        Self::because(value, why)
    }

    /// Returns an estimate about forms.
    fn of_forms(value: std::result::Result<f64, Undefined>) -> Self {
        Self::because(value, why_forms)
    }

    fn because(
        value: std::result::Result<f64, Undefined>,
        why: fn(Undefined) -> &'static str,
    ) -> Self {
        Self {
            value: value.ok(),
            why: value.err().map(why),
            interval: None,
        }
    }

    /// Returns the estimate with its interval, if it has one.
    fn within(self, interval: std::result::Result<[f64; 2], Undefined>) -> Self {
        Self {
            interval: interval.ok().map(Ends::from),
            ..self
        }
    }
}

impl From<[f64; 2]> for Ends {
    fn from([low, high]: [f64; 2]) -> Self {
        Self { low, high }
    }
}

/// Returns the reason why forms have no number, in the words of a lexicon.
fn why_forms(reason: Undefined) -> &'static str {
    match reason {
        Undefined::Empty => "no entry has a value in all of the fields",
        Undefined::NoSpread => "all entries have the same form",
        other => why(other),
    }
}

/// Returns the reason in the words of a lexicon.
fn why(reason: Undefined) -> &'static str {
    match reason {
        Undefined::Empty => "no entry has a value",
        Undefined::NoSpread => "all entries have the same value",
        Undefined::TooFew => "nothing was drawn",
        Undefined::TooMany => "there are too many pairs of values",
        _ => "the numbers do not allow it",
    }
}

/// The forms that are compared, as numbers.
struct Compared<'a> {
    /// The cells of each entry, equal numbers for equal texts; 0 is the empty cell.
    cells: Vec<Vec<u32>>,
    /// The text of each number.
    texts: Vec<&'a str>,
    /// The number of fields that make a form; further ones were only named.
    fields: usize,
}

impl Corpus {
    /// Returns statistics of the lexicon: entropy and functional load of its fields, and what the options ask for.
    ///
    /// # Errors
    /// [`Error::Wrong`] if a field does not exist, if Battison's conditions are asked of fields that do not say what the
    /// hands do, or for too many samples; the errors of [`search`](Self::search) for a query; [`Error::Stopped`].
    pub fn statistics(
        &mut self,
        options: &StatsOptions,
        progress: &mut Progress<'_>,
    ) -> Result<LexiconStatistics> {
        if options.samples > MOST_SAMPLES {
            let count = options.samples;
            let text =
                format!("{count} draws are more than the {MOST_SAMPLES} that are made at most");
            return Err(Error::wrong(text)
                .at(count.to_string())
                .advise("1000 are usual"));
        }
        let tokens = match &options.query {
            Some(query) => Some(self.tokens_found(query, progress)?),
            None => None,
        };
        let named: Vec<String> = options
            .of
            .iter()
            .chain(options.between.iter().flatten())
            .cloned()
            .collect();
        let mut wanted = named_fields(&options.fields);
        if wanted.is_empty() && !named.is_empty() {
            wanted = self.columns_with(&named)?.unwrap_or_default();
        }
        let set = wanted.len();
        if set > 0 {
            // The fields of an association need not be among those that make a form.
            let more = options.between.iter().flatten();
            let more = more.filter(|field| !wanted.iter().any(|it| same_name(it, field)));
            let more: Vec<String> = more.cloned().collect();
            wanted.extend(more);
        }
        let mut forms = self.forms(&wanted, tokens.as_deref(), progress)?;
        forms.rows.sort();
        let set = if set == 0 { forms.fields.len() } else { set };
        statistics(&forms, set, options, progress)
    }
}

/// Returns whether two names of fields are equal but for case and accents.
fn same_name(a: &str, b: &str) -> bool {
    chereme_sign::text::fold(a.trim()) == chereme_sign::text::fold(b.trim())
}

/// Returns the place of a field by its name.
fn place(forms: &Forms, name: &str) -> Result<usize> {
    let coding = name.parse::<chereme_sign::Field>();
    let coding = coding.ok().map(|it| crate::suggest::coding_name(&it));
    let exact = forms.fields.iter().position(|it| same_name(&it.name, name));
    let found = exact.or_else(|| {
        let wanted = coding?;
        let mut fields = forms.fields.iter();
        fields.position(|it| it.coding.as_ref() == Some(&wanted))
    });
    found.ok_or_else(|| {
        let names: Vec<&str> = forms.fields.iter().map(|it| it.name.as_str()).collect();
        Error::wrong(format!("the field {name:?} is not among the fields"))
            .at(name)
            .advise(format!("the fields are: {}", names.join(", ")))
    })
}

/// Returns the statistics of forms; the first `set` fields are compared.
fn statistics(
    forms: &Forms,
    set: usize,
    options: &StatsOptions,
    progress: &mut Progress<'_>,
) -> Result<LexiconStatistics> {
    let is_compared = |row: &&Form| {
        options.empty == Empty::Value || row.cells.iter().take(set).all(|cell| !cell.is_empty())
    };
    let rows: Vec<Form> = forms.rows.iter().filter(is_compared).cloned().collect();
    let (cells, texts) = numbered(&rows);
    let compared = Compared {
        cells,
        texts,
        fields: set,
    };
    let overview = fields::overview(forms, &compared);
    let of = match &options.of {
        Some(name) => {
            let at = place(forms, name)?;
            if at >= set {
                return Err(outside(name));
            }
            Some(fields::in_depth(forms, &compared, at, &overview.fields[at]))
        }
        None => None,
    };
    let between = match &options.between {
        Some([one, other]) => {
            let places = [place(forms, one)?, place(forms, other)?];
            Some(between::association(forms, places, options, progress)?)
        }
        None => None,
    };
    let battison = match options.battison {
        true => Some(battison::conditions(forms, options)?),
        false => None,
    };
    let is_overview = of.is_none() && between.is_none() && battison.is_none();
    let shown: Vec<usize> = match is_overview || battison.is_some() {
        true => (0..set).collect(),
        false => (options.of.iter())
            .chain(options.between.iter().flatten())
            .map(|name| place(forms, name))
            .collect::<Result<_>>()?,
    };
    let mut findings = findings::of_fields(forms, &shown);
    if is_overview || battison.is_some() {
        findings.extend(findings::of_hands(forms));
    }
    Ok(LexiconStatistics {
        source: forms.source,
        entries: forms.rows.len(),
        compared: rows.len(),
        forms: overview.forms,
        entropy: overview.entropy,
        fields: overview.fields,
        of,
        between,
        battison,
        findings,
    })
}

/// Returns the error for a field in depth that is not among those that make a form.
fn outside(name: &str) -> Error {
    Error::wrong(format!("the field {name:?} is not among the fields"))
        .at(name)
        .advise(crate::remedy::Remedy::command("name it in --fields, too"))
}
