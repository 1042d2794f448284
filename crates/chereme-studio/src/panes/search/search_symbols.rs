//! The query for a notation: signs with the same values.

use chereme_sign::hamnosys::components::{MappedSign, SignMapper};
use chereme_sign::hamnosys::{HamnosysSymbol, NotatedSign, SymbolClass, parse_lenient, to_names};
use chereme_sign::query::{TextPattern, WholeTokenProperty};
use chereme_sign::{ComponentInventory, SignComponent};
use eframe::egui::{RichText, Ui};

use super::search_builder::{self, ConditionRelation, ConditionSubject, QueryCondition};
use crate::context::PaneInput;
use crate::pickers::{board, pickers_hamnosys};
use crate::words::search_words as words;

/// Height of the symbols, in points.
const SYMBOL_BOARD_HEIGHT_POINTS: f32 = 22.0;

/// Draws the board and the picked symbols; returns the corresponding query if it changed.
pub(super) fn show_symbol_search(ui: &mut Ui, seen: &PaneInput<'_>, text: &mut String) -> Option<String> {
    let mut changed = board::draw_symbol_board_button(ui, seen, text);
    if !text.is_empty() {
        pickers_hamnosys::of_text(ui, seen, text, SYMBOL_BOARD_HEIGHT_POINTS);
        if ui.small_button(seen.say_text(words::NOTATION_CLEAR)).clicked() {
            text.clear();
            changed = true;
        }
    }
    let query = changed.then(|| query_from_notation(text, symbol_inventories(seen), &left_handed(seen)))?;
    if query.is_empty() && !text.is_empty() {
        ui.label(RichText::new(seen.say_text(words::NOTATION_NOTHING)).small());
    }
    Some(query)
}

fn symbol_inventories<'a>(seen: &PaneInput<'a>) -> impl Iterator<Item = &'a ComponentInventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|stored| &stored.inventory)
}

/// Returns the names of the left-handed signers.
fn left_handed<'a>(seen: &PaneInput<'a>) -> Vec<&'a str> {
    let all = seen.snapshot.overview.signers.iter();
    let left = all.filter(|signer| signer.handedness.as_deref() == Some("left"));
    left.map(|signer| signer.name.as_str()).collect()
}

/// Returns the query for signs with the values of a notation; empty if it has none yet. A notation is that of a
/// right-handed signer: left and right are exchanged for the signers who are left-handed.
fn query_from_notation<'i>(
    text: &str,
    inventories: impl Iterator<Item = &'i ComponentInventory>,
    left_handed: &[&str],
) -> String {
    let sign = NotatedSign {
        text: Some(text.to_owned()),
        sign: parse_lenient(text).sign,
        ..NotatedSign::default()
    };
    let mapper = SignMapper::new(inventories);
    let right = conditions_from_notation(text, mapper.map_sign_components(&sign));
    let left = conditions_from_notation(text, mapper.of_left_handed(true).map_sign_components(&sign));
    if right.is_empty() {
        return String::new();
    }
    if left_handed.is_empty() || left == right {
        return search_builder::query_text_from_rows(&right);
    }
    let signer = |how: ConditionRelation| {
        let names = left_handed.iter().map(|name| TextPattern::literal_pattern(*name));
        QueryCondition::Values(
            ConditionSubject::Property(WholeTokenProperty::Signer),
            how,
            names.collect(),
        )
    };
    let of = |rows: Vec<QueryCondition>, how: ConditionRelation| {
        let signer = std::iter::once(signer(how));
        rows.into_iter().chain(signer).collect::<Vec<_>>()
    };
    search_builder::query_text_from_alternatives(&[
        of(right, ConditionRelation::NotAtAll),
        of(left, ConditionRelation::Is),
    ])
}

/// Returns the conditions for the values that a notation writes.
fn conditions_from_notation(text: &str, mapped: MappedSign) -> Vec<QueryCondition> {
    let values = mapped.values.into_iter();
    values
        .filter(|entry| is_written(text, entry.field.component))
        .map(|entry| {
            let value = vec![TextPattern::literal_pattern(entry.value)];
            QueryCondition::Values(ConditionSubject::Component(entry.field), ConditionRelation::Is, value)
        })
        .collect()
}

/// Returns whether a notation writes a component explicitly; defaults are not searched for.
fn is_written(text: &str, component: SignComponent) -> bool {
    let classes: &[SymbolClass] = match component {
        SignComponent::Placement => &[SymbolClass::Location],
        SignComponent::Movement => &[SymbolClass::Movement, SymbolClass::Repetition, SymbolClass::Manner],
        _ => return true,
    };
    let names = to_names(text).unwrap_or_default();
    let mut symbols = names.into_iter().filter_map(HamnosysSymbol::from_symbol_name);
    symbols.any(|symbol| classes.contains(&symbol.symbol_class()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_notation_becomes_a_query_for_its_components() {
        let all = chereme_sign::inventory::builtin_inventories();
        let found = query_from_notation("hamfinger23 hamextfingeru hampalml hamchin", all.iter(), &[]);
        assert!(found.contains("configuration=U"), "{found}");
        assert!(found.contains("placement=chin"), "{found}");
        let shape = query_from_notation("hamfinger23", all.iter(), &[]);
        assert!(shape.contains("configuration=U"), "{shape}");
        assert!(!shape.contains("placement") && !shape.contains("movement"), "{shape}");
        assert_eq!(query_from_notation("", all.iter(), &[]), "");
    }

    #[test]
    fn left_and_right_of_a_notation_are_exchanged_for_left_handed_signers() {
        let all = chereme_sign::inventory::builtin_inventories();
        let query = |text: &str, left: &[&str]| query_from_notation(text, all.iter(), left);
        let palm = "hamfinger23 hamextfingeru hampalml";
        let both = query(palm, &["Ada", "Bo B"]);
        let (right, left) = both.split_once(" or ").expect("two alternatives");
        assert!(right.contains("orientation.palm=left"), "{both}");
        assert!(left.contains("orientation.palm=right"), "{both}");
        assert!(right.contains("not signer=") && left.contains("signer="), "{both}");
        assert!(left.contains("Ada") && left.contains("Bo B"), "{both}");
        let read: chereme_sign::query::TokenQuery = both.parse().expect("a query");
        assert_eq!(read.to_string(), both);
        // Nothing is exchanged without such signers, or without a direction to the side.
        assert!(!query(palm, &[]).contains("signer"));
        assert!(!query("hamfinger23 hamextfingeru hampalmu", &["Ada"]).contains("signer"));
    }
}
