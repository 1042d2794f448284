//! The overview of all fields, and one field in depth.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use chereme_analysis::statistics::{
    EqualityClasses, find_value_contrasts, functional_load, functional_load_interval, wilson_interval,
};
use serde::Serialize;

use super::{ComparedForms, IntervalEnds, STATS_INTERVAL_LEVEL, StatsEstimate, why_forms};
use crate::forms::SignForms;

/// The number of values that an overview names of each field.
const OVERVIEW_VALUE_COUNT: usize = 5;

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
    pub entropy: StatsEstimate,
    /// The entropy in bits of the entries with a value.
    pub entropy_given: StatsEstimate,
    /// The functional load: the share of the entropy of forms that is lost without this field.
    pub load: StatsEstimate,
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
    pub interval: Option<IntervalEnds>,
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
    pub(super) entropy: StatsEstimate,
    pub(super) fields: Vec<FieldStatistics>,
}

/// Returns the number of entries with each value of a field, the most frequent first, without the empty cell.
pub(super) fn count_field_values(forms: &SignForms, field: usize) -> Vec<(&str, usize)> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in &forms.rows {
        *counts.entry(&row.cells[field]).or_default() += 1;
    }
    counts.remove("");
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    // The sort is stable, so that equal counts stay in the order of their values.
    counts.sort_by_key(|(_, count)| Reverse(*count));
    counts
}

/// Returns the overview of the fields that make a form.
pub(super) fn fields_overview(forms: &SignForms, compared: &ComparedForms<'_>) -> FieldsAtAGlance {
    let cells = &compared.cells;
    let all_classes = EqualityClasses::sort_by_keys(cells.iter().map(|row| &row[..compared.fields]));
    let fields = (0..compared.fields).map(|at| {
        let without = sort_without_field(compared, at);
        let load = StatsEstimate::of_forms(functional_load(&all_classes, &without));
        let interval = functional_load_interval(&all_classes, &without, STATS_INTERVAL_LEVEL);
        glance(forms, at, load.with_interval(interval))
    });
    FieldsAtAGlance {
        fields: fields.collect(),
        forms: all_classes.class_sizes().len(),
        entropy: StatsEstimate::of_forms(all_classes.class_entropy())
            .with_interval(all_classes.entropy_interval(STATS_INTERVAL_LEVEL)),
    }
}

/// Returns the entries that are compared, sorted by all fields but one.
fn sort_without_field(compared: &ComparedForms<'_>, field: usize) -> EqualityClasses {
    let rest = |row: &Vec<u32>| {
        let mut rest = row[..compared.fields].to_vec();
        rest.remove(field);
        rest
    };
    EqualityClasses::sort_by_keys(compared.cells.iter().map(rest))
}

fn glance(forms: &SignForms, at: usize, load: StatsEstimate) -> FieldStatistics {
    let cells = || forms.rows.iter().map(|row| row.cells[at].as_str());
    let all = EqualityClasses::sort_by_keys(cells());
    let given = EqualityClasses::sort_by_keys(cells().filter(|cell| !cell.is_empty()));
    let entropy = |of: &EqualityClasses| {
        StatsEstimate::new(of.class_entropy()).with_interval(of.entropy_interval(STATS_INTERVAL_LEVEL))
    };
    let mut frequent = field_value_shares(forms, at);
    frequent.truncate(OVERVIEW_VALUE_COUNT);
    FieldStatistics {
        field: forms.fields[at].name.clone(),
        values: given.class_sizes().len(),
        given: given.class_thing_count(),
        empty: all.class_thing_count() - given.class_thing_count(),
        successive: cells().filter(|cell| cell.contains('>')).count(),
        entropy: entropy(&all),
        entropy_given: entropy(&given),
        load,
        frequent,
    }
}

/// Returns the values of a field with their shares, the most frequent first.
pub(super) fn field_value_shares(forms: &SignForms, at: usize) -> Vec<FieldValue> {
    let counts = count_field_values(forms, at);
    let given: usize = counts.iter().map(|(_, count)| count).sum();
    let value = |(value, count): (&str, usize)| FieldValue {
        value: value.to_owned(),
        count,
        share: count as f64 / given as f64,
        interval: wilson_interval(count as u64, given as u64, STATS_INTERVAL_LEVEL)
            .ok()
            .map(IntervalEnds::from),
    };
    counts.into_iter().map(value).collect()
}

/// Returns a field with all of its values and contrasts.
pub(super) fn in_depth(
    forms: &SignForms,
    compared: &ComparedForms<'_>,
    at: usize,
    statistics: &FieldStatistics,
) -> FieldInDepth {
    let column: Vec<u32> = compared.cells.iter().map(|row| row[at]).collect();
    let contrast_result = find_value_contrasts(&sort_without_field(compared, at), &column);
    let reason = contrast_result.as_ref().err().copied().map(why_forms);
    let text = |number: u32| compared.texts[number as usize].to_owned();
    let contrast = |pair: chereme_analysis::statistics::ValueContrast| {
        // Numbers follow the order of entries, and texts give one order in every lexicon.
        let mut sides = pair.values.map(text);
        sides.sort();
        let [a, b] = sides;
        FieldContrast {
            a,
            b,
            pairs: pair.pairs,
            load: pair.load,
        }
    };
    FieldInDepth {
        field: statistics.field.clone(),
        statistics: statistics.clone(),
        values: field_value_shares(forms, at),
        contrasts: contrast_result.unwrap_or_default().into_iter().map(contrast).collect(),
        why: reason,
    }
}
