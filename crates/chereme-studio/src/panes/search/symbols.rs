//! The query for a notation: signs with the same values.

use chereme_sign::hamnosys::components::{Mapped, Mapper};
use chereme_sign::hamnosys::{Class, Notated, Symbol, parse_lenient, to_names};
use chereme_sign::query::{Pattern, Property};
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
    let query = changed.then(|| query(text, inventories(seen), &left_handed(seen)))?;
    if query.is_empty() && !text.is_empty() {
        ui.label(RichText::new(seen.say(words::NOTATION_NOTHING)).small());
    }
    Some(query)
}

fn inventories<'a>(seen: &PaneInput<'a>) -> impl Iterator<Item = &'a Inventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|it| &it.inventory)
}

/// Returns the names of the left-handed signers.
fn left_handed<'a>(seen: &PaneInput<'a>) -> Vec<&'a str> {
    let all = seen.snapshot.overview.signers.iter();
    let left = all.filter(|it| it.handedness.as_deref() == Some("left"));
    left.map(|it| it.name.as_str()).collect()
}

/// Returns the query for signs with the values of a notation; empty if it has none yet. A notation is that of a
/// right-handed signer: left and right are exchanged for the signers who are left-handed.
fn query<'i>(
    text: &str,
    inventories: impl Iterator<Item = &'i Inventory>,
    left_handed: &[&str],
) -> String {
    let sign = Notated {
        text: Some(text.to_owned()),
        sign: parse_lenient(text).sign,
        ..Notated::default()
    };
    let mapper = Mapper::new(inventories);
    let right = rows(text, mapper.map(&sign));
    let left = rows(text, mapper.of_left_handed(true).map(&sign));
    if right.is_empty() {
        return String::new();
    }
    if left_handed.is_empty() || left == right {
        return builder::text(&right);
    }
    let signer = |how: How| {
        let names = left_handed.iter().map(|name| Pattern::literal(*name));
        Condition::Values(Subject::Property(Property::Signer), how, names.collect())
    };
    let of = |rows: Vec<Condition>, how: How| {
        let signer = std::iter::once(signer(how));
        rows.into_iter().chain(signer).collect::<Vec<_>>()
    };
    builder::either(&[of(right, How::NotAtAll), of(left, How::Is)])
}

/// Returns the conditions for the values that a notation writes.
fn rows(text: &str, mapped: Mapped) -> Vec<Condition> {
    let values = mapped.values.into_iter();
    values
        .filter(|it| is_written(text, it.field.component))
        .map(|it| {
            let value = vec![Pattern::literal(it.value)];
            Condition::Values(Subject::Component(it.field), How::Is, value)
        })
        .collect()
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
        let found = query(
            "hamfinger23 hamextfingeru hampalml hamchin",
            all.iter(),
            &[],
        );
        assert!(found.contains("configuration=U"), "{found}");
        assert!(found.contains("placement=chin"), "{found}");
        let shape = query("hamfinger23", all.iter(), &[]);
        assert!(shape.contains("configuration=U"), "{shape}");
        assert!(
            !shape.contains("placement") && !shape.contains("movement"),
            "{shape}"
        );
        assert_eq!(query("", all.iter(), &[]), "");
    }

    #[test]
    fn left_and_right_of_a_notation_are_exchanged_for_left_handed_signers() {
        let all = chereme_sign::inventory::builtin();
        let query = |text: &str, left: &[&str]| query(text, all.iter(), left);
        let palm = "hamfinger23 hamextfingeru hampalml";
        let both = query(palm, &["Ada", "Bo B"]);
        let (right, left) = both.split_once(" or ").expect("two alternatives");
        assert!(right.contains("orientation.palm=left"), "{both}");
        assert!(left.contains("orientation.palm=right"), "{both}");
        assert!(
            right.contains("not signer=") && left.contains("signer="),
            "{both}"
        );
        assert!(left.contains("Ada") && left.contains("Bo B"), "{both}");
        let read: chereme_sign::query::Query = both.parse().expect("a query");
        assert_eq!(read.to_string(), both);
        // Nothing is exchanged without such signers, or without a direction to the side.
        assert!(!query(palm, &[]).contains("signer"));
        assert!(!query("hamfinger23 hamextfingeru hampalmu", &["Ada"]).contains("signer"));
    }
}
