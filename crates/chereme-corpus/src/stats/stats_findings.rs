//! Oddities of a lexicon that statistics show.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use chereme_formats::lexicon::is_value;
use chereme_sign::inventory;
use chereme_sign::text::fold_text;
use serde::Serialize;

use super::battison::{HandFieldRoles, SignType, sign_type};
use super::stats_fields::count_field_values;
use crate::forms::{FormSource, SignForm, SignForms};
use crate::remedy::ErrorRemedy;
use crate::suggest::single_values;

/// A value is a slip of a common one that is so many times as frequent.
const SLIP_FREQUENCY_RATIO: usize = 10;

/// An oddity of the lexicon.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StatsFinding {
    /// The oddity.
    pub message: String,
    /// The remedy.
    pub remedy: Option<ErrorRemedy>,
    /// The first line of the table that shows it.
    pub line: Option<u64>,
    /// The entries that it is about, by gloss; none if it is about fields.
    pub glosses: Vec<String>,
}

impl StatsFinding {
    fn of_fields(message: String, remedy: impl Into<ErrorRemedy>) -> Self {
        Self {
            message,
            remedy: Some(remedy.into()),
            line: None,
            glosses: Vec::new(),
        }
    }

    /// Returns a finding about entries; nothing without entries.
    fn of_entries(
        rows: &[&SignForm],
        message: impl FnOnce(usize) -> String,
        remedy: impl Into<ErrorRemedy>,
    ) -> Option<Self> {
        if rows.is_empty() {
            return None;
        }
        Some(Self {
            message: message(rows.len()),
            remedy: Some(remedy.into()),
            line: rows.iter().filter_map(|row| row.line).min(),
            glosses: rows.iter().map(|row| row.gloss.clone()).collect(),
        })
    }
}

/// A rare value that differs from a common one by case or accents alone.
pub(super) struct ValueSlip<'a> {
    pub(super) value: &'a str,
    count: usize,
    common: &'a str,
    uses: usize,
}

/// Returns the slips of a field.
pub(super) fn field_slips(forms: &SignForms, at: usize) -> Vec<ValueSlip<'_>> {
    // The most frequent spelling comes first.
    let mut common: BTreeMap<String, (&str, usize)> = BTreeMap::new();
    let mut slip_list = Vec::new();
    for (value, count) in count_field_values(forms, at) {
        let (spelling, uses) = *common.entry(fold_text(value)).or_insert((value, count));
        // The common spelling itself has a ratio of 1, and is never its own slip.
        if uses >= SLIP_FREQUENCY_RATIO * count {
            slip_list.push(ValueSlip {
                value,
                count,
                common: spelling,
                uses,
            });
        }
    }
    slip_list
}

/// Returns the oddities of fields: slips, many empty cells, several values in a cell.
pub(super) fn of_fields(forms: &SignForms, shown: &[usize]) -> Vec<StatsFinding> {
    let mut findings = Vec::new();
    let remedy = || match forms.source {
        FormSource::Columns => ErrorRemedy::from("if they are one value, correct the table and import it again"),
        _ => ErrorRemedy::command_remedy(
            "if they are one value: `chereme inventory CORPUS merge-value INVENTORY VALUE INTO`",
        ),
    };
    for at in shown {
        let name = &forms.fields[*at].name;
        findings.extend(field_slips(forms, *at).into_iter().map(|slip| {
            let message = format!(
                "{name}: {:?} ({}) and {:?} ({}) differ only in case or accents, and count as two values",
                slip.value, slip.count, slip.common, slip.uses
            );
            let rows = forms.rows.iter().filter(|row| row.cells[*at] == slip.value);
            StatsFinding {
                line: rows.clone().filter_map(|row| row.line).min(),
                glosses: rows.map(|row| row.gloss.clone()).collect(),
                ..StatsFinding::of_fields(message, remedy())
            }
        }));
    }
    let count = |at: usize, test: &dyn Fn(&str) -> bool| {
        let cells = forms.rows.iter().map(|row| row.cells[at].as_str());
        cells.filter(|cell| test(cell)).count()
    };
    let named = |test: &dyn Fn(&str) -> bool, least: usize| -> Vec<String> {
        let field_counts = shown.iter().map(|at| (*at, count(*at, test)));
        let mut counts: Vec<(usize, usize)> = field_counts.filter(|(_, count)| *count > least).collect();
        counts.sort_by_key(|(_, count)| Reverse(*count));
        let named = counts.into_iter();
        named
            .map(|(at, count)| format!("{} {count}", forms.fields[at].name))
            .collect()
    };
    let empty = named(&str::is_empty, forms.rows.len() / 2);
    if !empty.is_empty() {
        let message = format!(
            "most entries have no value in some fields ({}, of {} entries): entropy, load and dense places of the lexicon there mirror how completely entries are coded",
            empty.join(", "),
            forms.rows.len()
        );
        findings.push(StatsFinding::of_fields(
            message,
            ErrorRemedy::command_remedy("compare with --empty unknown, or leave these fields out with --fields"),
        ));
    }
    let successive = named(&|cell| cell.contains('>'), 0);
    if !successive.is_empty() {
        let message = format!(
            "cells with successive values, such as a > b, count as one value each: {}",
            successive.join(", ")
        );
        findings.push(StatsFinding {
            remedy: None,
            ..StatsFinding::of_fields(message, "")
        });
    }
    findings
}

/// Returns the oddities of what the hands do, as far as fields say it.
pub(super) fn of_hands(forms: &SignForms) -> Vec<StatsFinding> {
    let roles = HandFieldRoles::find_hand_fields(forms);
    let Some(types) = roles.sign_type else {
        return Vec::new();
    };
    let rows = |test: &dyn Fn(&SignForm, Option<SignType>) -> bool| -> Vec<&SignForm> {
        let rows = forms.rows.iter();
        rows.filter(|row| test(row, roles.type_of(row))).collect()
    };
    let given = |row: &SignForm, at: Option<usize>| at.is_some_and(|at| is_value(&row.cells[at]));
    let one_handed = Some(SignType::OneHanded);
    let mut findings = Vec::new();
    let slips = field_slips(forms, types);
    for (value, count) in count_field_values(forms, types) {
        let is_slip = slips.iter().any(|slip| slip.value == value);
        if sign_type(value).is_none() && !is_slip {
            let value_rows = rows(&|row, _| row.cells[types] == value);
            let name = &forms.fields[types].name;
            let message = |_| format!("{name}: {value:?} ({count}) is no known type of sign");
            findings.extend(StatsFinding::of_entries(
                &value_rows,
                message,
                "the types are 1, 2s and 2a, or words such as one-handed, symmetrical, asymmetrical",
            ));
        }
    }
    let weak = rows(&|row, of| of == one_handed && given(row, roles.weak));
    findings.extend(StatsFinding::of_entries(
        &weak,
        |count| format!("one-handed entries with a handshape of the weak hand: {count}"),
        "look at them: either the type or the handshape of the weak hand is wrong",
    ));
    let on_hand =
        rows(&|row, of| of == one_handed && roles.placement.is_some_and(|at| is_on_weak_hand(&row.cells[at])));
    findings.extend(StatsFinding::of_entries(
        &on_hand,
        |count| format!("one-handed entries whose place is the weak hand: {count}"),
        "look at them: a weak hand that is touched is part of the sign",
    ));
    let alternating = rows(&|row, of| given(row, roles.alternating) && of != Some(SignType::Symmetrical));
    findings.extend(StatsFinding::of_entries(
        &alternating,
        |count| format!("alternating entries that are not symmetrical: {count}"),
        "look at them: hands that alternate both move",
    ));
    findings
}

/// Returns whether a placement is the weak hand or a part of it.
fn is_on_weak_hand(cell: &str) -> bool {
    let Some(inventory) = inventory::builtin_by_id("placements") else {
        return false;
    };
    single_values(cell).any(|value| {
        let known_value = inventory.find_inventory_value(value);
        known_value.is_some_and(|place| {
            inventory
                .broader_value_chain(&place.id)
                .any(|wider| wider.id == "weak-hand")
        })
    })
}
