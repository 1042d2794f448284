//! The overview of all fields, and one field in depth.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use chereme_analysis::statistics::{
    Classes, contrasts, functional_load, functional_load_interval, wilson,
};
use serde::Serialize;

use super::{Compared, Ends, Estimate, LEVEL, why_forms};
use crate::forms::Forms;

/// The number of values that an overview names of each field.
const FREQUENT: usize = 5;

/// A field at a glance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldStatistics {
    /// The field.
    pub field: String,
    /// The number of different values.
    pub values: usize,
    /// The number of entries with a value.
    pub given: usize,
    /// The number of entries without value.
    pub empty: usize,
    /// The number of entries with several values one after another, such as `chin > chest`.
    pub successive: usize,
    /// The entropy in bits with the empty cell as a value.
    pub entropy: Estimate,
    /// The entropy in bits of the entries with a value.
    pub entropy_given: Estimate,
    /// The functional load: the share of the entropy of forms that is lost without this field.
    pub load: Estimate,
    /// The most frequent values.
    pub frequent: Vec<FieldValue>,
}

/// A value of a field.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldValue {
    /// The value.
    pub value: String,
    /// The number of entries with it.
    pub count: usize,
    /// Its share of the entries with a value.
    pub share: f64,
    /// Wilson's interval of the share, 95 %.
    pub interval: Option<Ends>,
}

/// A field with all of its values, and the contrasts between them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldInDepth {
    /// The field.
    pub field: String,
    /// The field at a glance.
    pub statistics: FieldStatistics,
    /// All values, the most frequent first.
    pub values: Vec<FieldValue>,
    /// Two values each that distinguish at least one pair of entries, the largest load first.
    pub contrasts: Vec<FieldContrast>,
    /// The reason why there are no contrasts.
    pub why: Option<&'static str>,
}

/// Two values that distinguish signs; an empty text is the empty cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldContrast {
    /// One value.
    pub a: String,
    /// The other value.
    pub b: String,
    /// The number of minimal pairs of this contrast.
    pub pairs: usize,
    /// The functional load: the share of the entropy of forms that is lost if the two are one value.
    pub load: f64,
}

/// The overview of all fields.
pub(super) struct FieldsAtAGlance {
    pub(super) forms: usize,
    pub(super) entropy: Estimate,
    pub(super) fields: Vec<FieldStatistics>,
}

/// Returns the number of entries with each value of a field, the most frequent first, without the empty cell.
pub(super) fn counts(forms: &Forms, field: usize) -> Vec<(&str, usize)> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in &forms.rows {
        *counts.entry(&row.cells[field]).or_default() += 1;
    }
    counts.remove("");
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| Reverse(*count));
    counts
}

/// Returns the overview of the fields that make a form.
pub(super) fn overview(forms: &Forms, compared: &Compared<'_>) -> FieldsAtAGlance {
    let cells = &compared.cells;
    let whole = Classes::by(cells.iter().map(|row| &row[..compared.fields]));
    let fields = (0..compared.fields).map(|at| {
        let without = without(compared, at);
        let load = Estimate::of_forms(functional_load(&whole, &without));
        let interval = functional_load_interval(&whole, &without, LEVEL);
        glance(forms, at, load.within(interval))
    });
    FieldsAtAGlance {
        fields: fields.collect(),
        forms: whole.sizes().len(),
        entropy: Estimate::of_forms(whole.entropy()).within(whole.entropy_interval(LEVEL)),
    }
}

/// Returns the entries that are compared, sorted by all fields but one.
fn without(compared: &Compared<'_>, field: usize) -> Classes {
    let rest = |row: &Vec<u32>| {
        let mut rest = row[..compared.fields].to_vec();
        rest.remove(field);
        rest
    };
    Classes::by(compared.cells.iter().map(rest))
}

fn glance(forms: &Forms, at: usize, load: Estimate) -> FieldStatistics {
    let cells = || forms.rows.iter().map(|row| row.cells[at].as_str());
    let all = Classes::by(cells());
    let given = Classes::by(cells().filter(|cell| !cell.is_empty()));
    let entropy = |of: &Classes| Estimate::new(of.entropy()).within(of.entropy_interval(LEVEL));
    let mut frequent = values(forms, at);
    frequent.truncate(FREQUENT);
    FieldStatistics {
        field: forms.fields[at].name.clone(),
        values: given.sizes().len(),
        given: given.things(),
        empty: all.things() - given.things(),
        successive: cells().filter(|cell| cell.contains('>')).count(),
        entropy: entropy(&all),
        entropy_given: entropy(&given),
        load,
        frequent,
    }
}

/// Returns the values of a field with their shares, the most frequent first.
pub(super) fn values(forms: &Forms, at: usize) -> Vec<FieldValue> {
    let counts = counts(forms, at);
    let given: usize = counts.iter().map(|(_, count)| count).sum();
    let value = |(value, count): (&str, usize)| FieldValue {
        value: value.to_owned(),
        count,
        share: count as f64 / given as f64,
        interval: wilson(count as u64, given as u64, LEVEL)
            .ok()
            .map(Ends::from),
    };
    counts.into_iter().map(value).collect()
}

/// Returns a field with all of its values and contrasts.
pub(super) fn in_depth(
    forms: &Forms,
    compared: &Compared<'_>,
    at: usize,
    statistics: &FieldStatistics,
) -> FieldInDepth {
    let own: Vec<u32> = compared.cells.iter().map(|row| row[at]).collect();
    let found = contrasts(&without(compared, at), &own);
    let reason = found.as_ref().err().copied().map(why_forms);
    let text = |number: u32| compared.texts[number as usize].to_owned();
    let contrast = |it: chereme_analysis::statistics::Contrast| {
        let mut sides = it.values.map(text);
        sides.sort();
        let [a, b] = sides;
        FieldContrast {
            a,
            b,
            pairs: it.pairs,
            load: it.load,
        }
    };
    FieldInDepth {
        field: statistics.field.clone(),
        statistics: statistics.clone(),
        values: values(forms, at),
        contrasts: found
            .unwrap_or_default()
            .into_iter()
            .map(contrast)
            .collect(),
        why: reason,
    }
}
