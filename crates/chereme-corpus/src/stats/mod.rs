//! Statistics of a lexicon: how much its fields say, which of them go together, and conditions on the two hands.

mod battison;
mod between;
mod sign_measures;
mod stats_fields;
mod stats_findings;
mod stats_table;
#[cfg(test)]
mod tests;

use chereme_analysis::statistics::UndefinedStatistic;
use serde::Serialize;

pub use battison::{BattisonConditions, HandCondition, TwoHands};
pub use between::{ChanceAssociation, CrossCell, FieldAssociation};
pub use sign_measures::{MeasuredSign, NeighbourDefinition, SignMeasureOptions, SignMeasures};
pub use stats_fields::{FieldContrast, FieldInDepth, FieldStatistics, FieldValue};
pub use stats_findings::StatsFinding;

use crate::Corpus;
use crate::error::{CorpusError, CorpusResult};
use crate::forms::{EmptyCellTreatment, FormSource, SignForm, SignForms, named_fields, number_form_cells};
use crate::lexicon::LexiconScope;
use crate::progress::ProgressReceiver;

/// The most shuffles for p.
const MAX_SHUFFLES: usize = 100_000;
/// The level of all intervals.
const STATS_INTERVAL_LEVEL: f64 = 0.95;

/// The fields to describe, and the statistics that are wanted besides an overview of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatsOptions {
    /// The fields that make a form, as in [`PairOptions`](crate::PairOptions). If empty, all coded fields: the columns
    /// that code components if [`of`](Self::of) or [`between`](Self::between) names columns, else the fields of queries.
    pub fields: Vec<String>,
    /// The treatment of an empty cell where forms are compared.
    pub empty: EmptyCellTreatment,
    /// The tokens to count, as a query; without it every sign counts once.
    pub query: Option<String>,
    /// The lexicons whose signs count.
    pub scope: LexiconScope,
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
            empty: EmptyCellTreatment::Value,
            query: None,
            scope: LexiconScope::Single,
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
    pub entropy: StatsEstimate,
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
    pub battison: Option<BattisonConditions>,
    /// The oddities.
    pub findings: Vec<StatsFinding>,
}

/// A number, or the reason for its absence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StatsEstimate {
    /// The number.
    pub value: Option<f64>,
    /// The reason why there is no number.
    pub why: Option<&'static str>,
    /// The interval of 95 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<IntervalEnds>,
}

/// The ends of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IntervalEnds {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl StatsEstimate {
    fn new(value: std::result::Result<f64, UndefinedStatistic>) -> Self {
        Self::estimate_or_reason(value, undefined_reason)
    }

    /// Returns an estimate about forms.
    fn of_forms(value: std::result::Result<f64, UndefinedStatistic>) -> Self {
        Self::estimate_or_reason(value, why_forms)
    }

    fn estimate_or_reason(
        value: std::result::Result<f64, UndefinedStatistic>,
        why: fn(UndefinedStatistic) -> &'static str,
    ) -> Self {
        Self {
            value: value.ok(),
            why: value.err().map(why),
            interval: None,
        }
    }

    /// Returns the estimate with its interval, if it has one.
    fn with_interval(self, interval: std::result::Result<[f64; 2], UndefinedStatistic>) -> Self {
        Self {
            interval: interval.ok().map(IntervalEnds::from),
            ..self
        }
    }
}

impl From<[f64; 2]> for IntervalEnds {
    fn from([low, high]: [f64; 2]) -> Self {
        Self { low, high }
    }
}

/// Returns the reason why forms have no number, in the words of a lexicon.
fn why_forms(reason: UndefinedStatistic) -> &'static str {
    match reason {
        UndefinedStatistic::Empty => "no entry has a value in all of the fields",
        UndefinedStatistic::NoSpread => "all entries have the same form",
        other => undefined_reason(other),
    }
}

/// Returns the reason in the words of a lexicon.
fn undefined_reason(reason: UndefinedStatistic) -> &'static str {
    match reason {
        UndefinedStatistic::Empty => "no entry has a value",
        UndefinedStatistic::NoSpread => "all entries have the same value",
        UndefinedStatistic::TooFew => "nothing was drawn",
        UndefinedStatistic::TooMany => "there are too many pairs of values",
        _ => "the numbers do not allow it",
    }
}

/// The forms that are compared, as numbers.
struct ComparedForms<'a> {
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
    /// [`CorpusError::Wrong`] if a field does not exist, if Battison's conditions are asked of fields that do not say what the
    /// hands do, or for too many samples; the errors of [`search`](Self::search_tokens) for a query; [`CorpusError::Stopped`].
    pub fn lexicon_statistics(
        &mut self,
        options: &StatsOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<LexiconStatistics> {
        if options.samples > MAX_SHUFFLES {
            let count = options.samples;
            let text = format!("{count} draws are more than the {MAX_SHUFFLES} that are made at most");
            return Err(CorpusError::from_wrong_message(text)
                .with_error_place(count.to_string())
                .with_advice("1000 are usual"));
        }
        let selection = self.select_forms(options.query.as_deref(), progress)?;
        let named: Vec<String> = options
            .of
            .iter()
            .chain(options.between.iter().flatten())
            .cloned()
            .collect();
        let mut wanted = named_fields(&options.fields);
        // A title of a column alone shows that the columns of the table are meant, not the fields of queries.
        if wanted.is_empty() && !named.is_empty() {
            wanted = self.columns_with(&named)?.unwrap_or_default();
        }
        // Fields behind this number are only associated, and make no form.
        let set = wanted.len();
        if set > 0 {
            // The fields of an association need not be among those that make a form.
            let more_fields = options.between.iter().flatten();
            let more = more_fields.filter(|field| !wanted.iter().any(|other| same_name(other, field)));
            let more: Vec<String> = more.cloned().collect();
            wanted.extend(more);
        }
        let mut forms = self.load_sign_forms(&wanted, &selection, &options.scope, progress)?;
        // Shuffles with one seed give one result only if the entries are always in one order.
        forms.rows.sort();
        // Without named fields, all that were loaded make a form.
        let set = if set == 0 { forms.fields.len() } else { set };
        compute_form_statistics(&forms, set, options, progress)
    }
}

/// Returns whether two names of fields are equal but for case and accents.
fn same_name(a: &str, b: &str) -> bool {
    chereme_sign::text::fold_text(a.trim()) == chereme_sign::text::fold_text(b.trim())
}

/// Returns the place of a field by its name.
fn field_place(forms: &SignForms, name: &str) -> CorpusResult<usize> {
    let parsed_field = name.parse::<chereme_sign::ComponentField>();
    let coding = parsed_field.ok().map(|field| crate::suggest::coding_name(&field));
    let exact = forms.fields.iter().position(|field| same_name(&field.name, name));
    let index = exact.or_else(|| {
        let wanted = coding?;
        let mut fields = forms.fields.iter();
        fields.position(|field| field.coding.as_ref() == Some(&wanted))
    });
    index.ok_or_else(|| {
        let names: Vec<&str> = forms.fields.iter().map(|field| field.name.as_str()).collect();
        CorpusError::from_wrong_message(format!("the field {name:?} is not among the fields"))
            .with_error_place(name)
            .with_advice(format!("the fields are: {}", names.join(", ")))
    })
}

/// Returns the statistics of forms; the first `set` fields are compared.
fn compute_form_statistics(
    forms: &SignForms,
    set: usize,
    options: &StatsOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<LexiconStatistics> {
    let is_compared = |row: &&SignForm| {
        options.empty == EmptyCellTreatment::Value || row.cells.iter().take(set).all(|cell| !cell.is_empty())
    };
    let rows: Vec<SignForm> = forms.rows.iter().filter(is_compared).cloned().collect();
    let (cells, texts) = number_form_cells(&rows);
    let compared = ComparedForms {
        cells,
        texts,
        fields: set,
    };
    let overview = stats_fields::fields_overview(forms, &compared);
    let of = match &options.of {
        Some(name) => {
            let field_index = field_place(forms, name)?;
            if field_index >= set {
                return Err(outside_form_error(name));
            }
            Some(stats_fields::in_depth(
                forms,
                &compared,
                field_index,
                &overview.fields[field_index],
            ))
        }
        None => None,
    };
    let between = match &options.between {
        Some([one, other]) => {
            let places = [field_place(forms, one)?, field_place(forms, other)?];
            Some(between::associate_fields(forms, places, options, progress)?)
        }
        None => None,
    };
    let battison = match options.battison {
        true => Some(battison::battison_conditions(forms, options)?),
        false => None,
    };
    let is_overview = of.is_none() && between.is_none() && battison.is_none();
    // Oddities of fields that nobody asked about would hide those that matter here.
    let shown: Vec<usize> = match is_overview || battison.is_some() {
        true => (0..set).collect(),
        false => (options.of.iter())
            .chain(options.between.iter().flatten())
            .map(|name| field_place(forms, name))
            .collect::<CorpusResult<_>>()?,
    };
    let mut findings = stats_findings::of_fields(forms, &shown);
    if is_overview || battison.is_some() {
        findings.extend(stats_findings::of_hands(forms));
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
fn outside_form_error(name: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("the field {name:?} is not among the fields"))
        .with_error_place(name)
        .with_advice(crate::remedy::ErrorRemedy::command_remedy("name it in --fields, too"))
}
