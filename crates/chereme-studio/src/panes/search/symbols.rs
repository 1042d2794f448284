//! The query for a notation: signs with the same values.

use chereme_sign::hamnosys::components::Mapper;
use chereme_sign::hamnosys::{Class, Notated, Symbol, parse_lenient, to_names};
use chereme_sign::query::Pattern;
use chereme_sign::{Component, Inventory};
use eframe::egui::{RichText, Ui};

use super::builder::{self, Condition, How, Subject};
use crate::context::PaneInput;
use crate::pickers::{board, hamnosys};
use crate::words::search as words;

/// Height of the symbols, in points.
const EM: f32 = 22.0;

/// Draws the board and the picked symbols; returns the corresponding query if it changed.
pub(super) fn show(ui: &mut Ui, seen: &PaneInput<'_>, text: &mut String) -> Option<String> {
    let mut changed = board::button(ui, seen, text);
    if !text.is_empty() {
        hamnosys::of_text(ui, seen, text, EM);
        if ui.small_button(seen.say(words::NOTATION_CLEAR)).clicked() {
            text.clear();
            changed = true;
        }
    }
    let query = changed.then(|| query(text, inventories(seen)))?;
    if query.is_empty() && !text.is_empty() {
        ui.label(RichText::new(seen.say(words::NOTATION_NOTHING)).small());
    }
    Some(query)
}

fn inventories<'a>(seen: &PaneInput<'a>) -> impl Iterator<Item = &'a Inventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|it| &it.inventory)
}

/// Returns the query for signs with the values of a notation; empty if it has none yet.
fn query<'i>(text: &str, inventories: impl Iterator<Item = &'i Inventory>) -> String {
    let sign = Notated {
        text: Some(text.to_owned()),
        sign: parse_lenient(text).sign,
        ..Notated::default()
    };
    let mapped = Mapper::new(inventories).map(&sign);
    let rows: Vec<Condition> = mapped
        .values
        .into_iter()
        .filter(|it| is_written(text, it.field.component))
        .map(|it| {
            let value = vec![Pattern::literal(it.value)];
            Condition::Values(Subject::Component(it.field), How::Is, value)
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    builder::text(&rows)
}

/// Returns whether a notation writes a component explicitly; defaults are not searched for.
fn is_written(text: &str, component: Component) -> bool {
    let classes: &[Class] = match component {
        Component::Placement => &[Class::Location],
        Component::Movement => &[Class::Movement, Class::Repetition, Class::Manner],
        _ => return true,
    };
    let names = to_names(text).unwrap_or_default();
    let mut symbols = names.into_iter().filter_map(Symbol::from_name);
    symbols.any(|symbol| classes.contains(&symbol.class()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_notation_becomes_a_query_for_its_components() {
        let all = chereme_sign::inventory::builtin();
        let found = query("hamfinger23 hamextfingeru hampalml hamchin", all.iter());
        assert!(found.contains("configuration=U"), "{found}");
        assert!(found.contains("placement=chin"), "{found}");
        let shape = query("hamfinger23", all.iter());
        assert!(shape.contains("configuration=U"), "{shape}");
        assert!(
            !shape.contains("placement") && !shape.contains("movement"),
            "{shape}"
        );
        assert_eq!(query("", all.iter()), "");
    }
}
