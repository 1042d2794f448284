//! The association of two fields.

use std::collections::BTreeMap;

use chereme_analysis::statistics::{ShuffledAssociation, UndefinedStatistic, ValueAssociation};
use serde::Serialize;

use super::stats_fields::FieldValue;
use super::{StatsEstimate, StatsOptions};
use crate::error::{CorpusError, CorpusResult};
use crate::forms::{FormSource, SignForm, SignForms, number_form_cells};
use crate::progress::ProgressReceiver;

/// The number of shuffles between two reports of progress.
const SHUFFLES_PER_REPORT: usize = 16;

/// How far two fields go together, among the entries that have both.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldAssociation {
    /// The two fields: rows and columns.
    pub fields: [String; 2],
    /// The number of entries with both.
    pub n: usize,
    /// The number of entries without one of them, or both.
    pub left_out: usize,
    /// The mutual information in bits.
    pub bits: StatsEstimate,
    /// Pearson's chi-square.
    pub chi_square: StatsEstimate,
    /// Its degrees of freedom.
    pub df: usize,
    /// Cramér's V.
    pub cramers_v: StatsEstimate,
    /// The probability of such a chi-square if the fields have nothing to do with each other, from shuffled values.
    pub p: StatsEstimate,
    /// The probability of such mutual information, from the same shuffles.
    pub p_bits: StatsEstimate,
    /// The shuffles.
    pub chance: Option<ChanceAssociation>,
    /// The values of the first field, the most frequent first.
    pub rows: Vec<FieldValue>,
    /// The values of the second field, the most frequent first.
    pub columns: Vec<FieldValue>,
    /// The cells that are not 0, in the order of rows and columns.
    pub cells: Vec<CrossCell>,
}

/// The association of shuffled values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ChanceAssociation {
    /// The number of shuffles.
    pub samples: usize,
    /// Their seed.
    pub seed: u64,
    /// The mean mutual information in bits: with many rare values it is far from 0.
    pub bits: f64,
    /// The mean chi-square.
    pub chi_square: f64,
}

/// A cell of the cross table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CrossCell {
    /// The value of the first field.
    pub row: String,
    /// The value of the second field.
    pub column: String,
    /// The number of entries with both.
    pub count: usize,
    /// The number that is expected if the fields have nothing to do with each other.
    pub expected: f64,
}

/// The end of shuffling before its time.
enum ShuffleHalt {
    Undefined(UndefinedStatistic),
    Failed(CorpusError),
}

impl From<UndefinedStatistic> for ShuffleHalt {
    fn from(reason: UndefinedStatistic) -> Self {
        Self::Undefined(reason)
    }
}

/// Returns the association of two fields.
pub(super) fn associate_fields(
    forms: &SignForms,
    [one, other]: [usize; 2],
    options: &StatsOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FieldAssociation> {
    let pair = |row: &SignForm| SignForm {
        gloss: String::new(),
        cells: vec![row.cells[one].clone(), row.cells[other].clone()],
        line: None,
        token: None,
    };
    let both = SignForms {
        fields: vec![forms.fields[one].clone(), forms.fields[other].clone()],
        rows: forms.rows.iter().map(pair).filter(SignForm::is_complete).collect(),
        source: FormSource::Columns,
    };
    let (cells, _) = number_form_cells(&both.rows);
    let side = |at: usize| -> Vec<u32> { cells.iter().map(|row| row[at]).collect() };
    let (first, second) = (side(0), side(1));
    let association_result = ValueAssociation::from_field_values(&first, &second);
    let estimate = |of: fn(&ValueAssociation) -> std::result::Result<f64, UndefinedStatistic>| {
        StatsEstimate::new(association_result.as_ref().map_err(|error| *error).and_then(of))
    };
    let hear = |done: usize| match done % SHUFFLES_PER_REPORT {
        0 => progress
            .report_items("shuffles", done, options.samples)
            .map_err(ShuffleHalt::Failed),
        _ => Ok(()),
    };
    let shuffled = match ShuffledAssociation::from_shuffled_values(&first, &second, options.samples, options.seed, hear)
    {
        Ok(it) => Ok(it),
        Err(ShuffleHalt::Undefined(reason)) => Err(reason),
        Err(ShuffleHalt::Failed(error)) => return Err(error),
    };
    let (rows, columns) = (
        super::stats_fields::field_value_shares(&both, 0),
        super::stats_fields::field_value_shares(&both, 1),
    );
    Ok(FieldAssociation {
        n: both.rows.len(),
        left_out: forms.rows.len() - both.rows.len(),
        bits: estimate(|association| Ok(association.bits)),
        chi_square: estimate(|association| Ok(association.chi_square)),
        df: association_result.map_or(0, |association| association.df),
        cramers_v: estimate(ValueAssociation::cramers_v),
        p: StatsEstimate::new(shuffled.map(|outcome| outcome.p_chi_square)),
        p_bits: StatsEstimate::new(shuffled.map(|outcome| outcome.p_bits)),
        chance: shuffled.ok().map(|outcome| ChanceAssociation {
            samples: outcome.samples,
            seed: options.seed,
            bits: outcome.bits,
            chi_square: outcome.chi_square,
        }),
        cells: cross_table_cells(&both, &rows, &columns),
        fields: [0, 1].map(|at| both.fields[at].name.clone()),
        rows,
        columns,
    })
}

/// Returns the cells of the cross table that are not 0.
fn cross_table_cells(both: &SignForms, rows: &[FieldValue], columns: &[FieldValue]) -> Vec<CrossCell> {
    let place = |values: &[FieldValue]| -> BTreeMap<String, usize> {
        let values = values.iter().enumerate();
        values.map(|(at, it)| (it.value.clone(), at)).collect()
    };
    let (row_of, column_of) = (place(rows), place(columns));
    let mut counts: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for form in &both.rows {
        let cell = (row_of[&form.cells[0]], column_of[&form.cells[1]]);
        *counts.entry(cell).or_default() += 1;
    }
    let n = both.rows.len() as f64;
    let cell = |((row, column), count): ((usize, usize), usize)| CrossCell {
        // The product of both shares, as if the fields had nothing to do with each other.
        expected: rows[row].count as f64 * columns[column].count as f64 / n,
        row: rows[row].value.clone(),
        column: columns[column].value.clone(),
        count,
    };
    counts.into_iter().map(cell).collect()
}
