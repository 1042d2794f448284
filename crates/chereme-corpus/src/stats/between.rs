//! The association of two fields.

use std::collections::BTreeMap;

use chereme_analysis::statistics::{Association, Shuffled, Undefined};
use serde::Serialize;

use super::fields::FieldValue;
use super::{Estimate, StatsOptions};
use crate::error::{Error, Result};
use crate::forms::{Form, FormSource, Forms, numbered};
use crate::progress::{Progress, Step, Unit};

/// The number of shuffles between two reports of progress.
const STEP: usize = 16;

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
    pub bits: Estimate,
    /// Pearson's chi-square.
    pub chi_square: Estimate,
    /// Its degrees of freedom.
    pub df: usize,
    /// Cramér's V.
    pub cramers_v: Estimate,
    /// The probability of such a chi-square if the fields have nothing to do with each other, from shuffled values.
    pub p: Estimate,
    /// The probability of such mutual information, from the same shuffles.
    pub p_bits: Estimate,
    /// The shuffles.
    pub chance: Option<Chance>,
    /// The values of the first field, the most frequent first.
    pub rows: Vec<FieldValue>,
    /// The values of the second field, the most frequent first.
    pub columns: Vec<FieldValue>,
    /// The cells that are not 0, in the order of rows and columns.
    pub cells: Vec<CrossCell>,
}

/// The association of shuffled values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Chance {
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
enum Halt {
    Undefined(Undefined),
    Failed(Error),
}

impl From<Undefined> for Halt {
    fn from(reason: Undefined) -> Self {
        Self::Undefined(reason)
    }
}

/// Returns the association of two fields.
pub(super) fn association(
    forms: &Forms,
    [one, other]: [usize; 2],
    options: &StatsOptions,
    progress: &mut Progress<'_>,
) -> Result<FieldAssociation> {
    let pair = |row: &Form| Form {
        gloss: String::new(),
        cells: vec![row.cells[one].clone(), row.cells[other].clone()],
        line: None,
    };
    let both = Forms {
        fields: vec![forms.fields[one].clone(), forms.fields[other].clone()],
        rows: forms
            .rows
            .iter()
            .map(pair)
            .filter(Form::is_complete)
            .collect(),
        source: FormSource::Columns,
    };
    let (cells, _) = numbered(&both.rows);
    let side = |at: usize| -> Vec<u32> { cells.iter().map(|row| row[at]).collect() };
    let (first, second) = (side(0), side(1));
    let found = Association::of(&first, &second);
    let estimate = |of: fn(&Association) -> std::result::Result<f64, Undefined>| {
        Estimate::new(found.as_ref().map_err(|it| *it).and_then(of))
    };
    let hear = |done: usize| match done % STEP {
        0 => progress
            .report(Step {
                task: "shuffles",
                done: done as u64,
                total: Some(options.samples as u64),
                unit: Unit::Items,
            })
            .map_err(Halt::Failed),
        _ => Ok(()),
    };
    let shuffled = match Shuffled::of(&first, &second, options.samples, options.seed, hear) {
        Ok(it) => Ok(it),
        Err(Halt::Undefined(reason)) => Err(reason),
        Err(Halt::Failed(error)) => return Err(error),
    };
    let (rows, columns) = (
        super::fields::values(&both, 0),
        super::fields::values(&both, 1),
    );
    Ok(FieldAssociation {
        n: both.rows.len(),
        left_out: forms.rows.len() - both.rows.len(),
        bits: estimate(|it| Ok(it.bits)),
        chi_square: estimate(|it| Ok(it.chi_square)),
        df: found.map_or(0, |it| it.df),
        cramers_v: estimate(Association::cramers_v),
        p: Estimate::new(shuffled.map(|it| it.p_chi_square)),
        p_bits: Estimate::new(shuffled.map(|it| it.p_bits)),
        chance: shuffled.ok().map(|it| Chance {
            samples: it.samples,
            seed: options.seed,
            bits: it.bits,
            chi_square: it.chi_square,
        }),
        cells: cross(&both, &rows, &columns),
        fields: [0, 1].map(|at| both.fields[at].name.clone()),
        rows,
        columns,
    })
}

/// Returns the cells of the cross table that are not 0.
fn cross(both: &Forms, rows: &[FieldValue], columns: &[FieldValue]) -> Vec<CrossCell> {
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
        expected: rows[row].count as f64 * columns[column].count as f64 / n,
        row: rows[row].value.clone(),
        column: columns[column].value.clone(),
        count,
    };
    counts.into_iter().map(cell).collect()
}
