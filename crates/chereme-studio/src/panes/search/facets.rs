//! Facets: how often each value occurs among the results.

use std::collections::BTreeMap;

use chereme_corpus::StoredInventory;
use chereme_sign::query::{facet_condition, narrow, wants, without};
use chereme_sign::{Component, Field};
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};

use super::rows::{component_text, feature_text};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::panes::inspector::Thing;
use crate::panes::library::data::origin_named;
use crate::pickers;
use crate::words::{Text, fill, library, recombine, search as words};

/// The words of fields for hands and phases.
const PARTS: [(&str, Text); 6] = [
    ("right", words::RIGHT),
    ("left", words::LEFT),
    ("dominant", words::DOMINANT),
    ("weak", words::WEAK),
    ("initial", words::INITIAL),
    ("final", words::FINAL),
];

/// The facets' values that a query has as conditions. Each is determined once, as that takes several times as long as
/// drawing the value.
#[derive(Debug, Default)]
pub(super) struct Conditions {
    query: String,
    known: BTreeMap<String, BTreeMap<String, bool>>,
}

impl Conditions {
    /// Returns whether `query` has a facet's value as a condition.
    fn has(&mut self, query: &str, field: &str, value: &str) -> bool {
        if self.query != query {
            query.clone_into(&mut self.query);
            self.known.clear();
        }
        if let Some(on) = self.known.get(field).and_then(|it| it.get(value)) {
            return *on;
        }
        let on = facet_condition(field, value).is_some_and(|it| wants(query, &it));
        let of_field = self.known.entry(field.to_owned()).or_default();
        of_field.insert(value.to_owned(), on);
        on
    }
}

/// Returns the query after a click on a facet's value: narrowed by the value as a whole, or without that condition.
/// Returns `None` for a field that queries cannot name.
fn clicked(query: &str, field: &str, value: &str) -> Option<String> {
    let condition = facet_condition(field, value)?;
    Some(match wants(query, &condition) {
        true => without(query, &condition),
        false => narrow(query, &condition),
    })
}

/// Draws how often each value occurs; a click returns the query with a condition for that value, or without it if the
/// query has it already.
pub(super) fn show(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    facets: &BTreeMap<String, Vec<(String, usize)>>,
    (query, conditions): (&str, &mut Conditions),
    height: f32,
    out: &mut Outbox,
) -> Option<String> {
    let mut chosen = None;
    ScrollArea::vertical()
        .id_salt("facets")
        .max_height(height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for field in order(facets.keys()) {
                let values = &facets[field];
                let name = facet_name(field, seen);
                ui.label(RichText::new(name).small().weak());
                let most = values.iter().map(|(_, count)| *count).max().unwrap_or(1);
                let stored = inventory(field, seen);
                for (value, count) in values {
                    let share = *count as f32 / most as f32;
                    let on = conditions.has(query, field, value);
                    let of = (field.as_str(), stored);
                    let response = facet(ui, seen, of, value, (share, *count), on);
                    let known = stored.filter(|it| it.inventory.get(value).is_some());
                    let thing = known.map(|it| Thing::Value(it.id, value.clone()));
                    let asks = ui.input(|input| input.modifiers.command);
                    match thing {
                        Some(thing) if response.clicked() && asks => {
                            out.send(Command::Inspect(thing));
                        }
                        _ if response.clicked() => {
                            chosen = clicked(query, field, value);
                        }
                        Some(thing) => menu(seen, &response, thing, out),
                        None => {}
                    }
                }
                ui.add_space(4.0);
            }
        });
    chosen
}

/// Returns the fields of facets in the order of the components; other fields come last.
pub(super) fn order<'a>(fields: impl Iterator<Item = &'a String>) -> Vec<&'a String> {
    let mut all: Vec<&String> = fields.collect();
    let place = |field: &&String| {
        let component = field.parse::<Field>().ok().map(|it| it.component);
        Component::ALL
            .iter()
            .position(|it| Some(*it) == component)
            .unwrap_or(Component::ALL.len())
    };
    all.sort_by_key(place);
    all
}

/// The words of fields that are no component.
const OTHERS: [(&str, Text); 4] = [
    ("gloss", words::GLOSS),
    ("hand", words::HAND),
    ("recording", words::RECORDING),
    ("signer", words::SIGNER),
];

/// The words of the hands of a sign.
const HANDS: [(&str, Text); 3] = [
    ("both", recombine::BOTH_HANDS),
    ("dominant", words::DOMINANT),
    ("weak", words::WEAK),
];

fn facet_name(field: &str, seen: &PaneInput<'_>) -> String {
    let Ok(known) = field.parse::<Field>() else {
        let known = OTHERS.iter().find(|(word, _)| *word == field);
        return known.map_or(field, |(_, text)| seen.say(*text)).to_owned();
    };
    let mut name = seen.say(component_text(known.component)).to_owned();
    for part in known.feature.iter() {
        name.push_str(&format!(" · {}", feature_text(part, seen)));
    }
    let hand = known.hand.map(|hand| hand.to_string());
    let phase = known.phase.map(|phase| phase.to_string());
    for part in hand.into_iter().chain(phase) {
        let known = PARTS.iter().find(|(word, _)| *word == part);
        let part = known.map_or(part.as_str(), |(_, text)| seen.say(*text));
        name.push_str(&format!(" ({part})"));
    }
    name
}

/// Offers the details of a value in a context menu.
fn menu(seen: &PaneInput<'_>, response: &Response, thing: Thing, out: &mut Outbox) {
    response.context_menu(|ui| {
        if ui.button(seen.say(library::INSPECT)).clicked() {
            out.send(Command::Inspect(thing));
            ui.close();
        }
    });
}

/// Returns the inventory with the values of a field.
fn inventory<'a>(field: &str, seen: &PaneInput<'a>) -> Option<&'a StoredInventory> {
    let field = field.parse::<Field>().ok()?;
    let mut all = seen.snapshot.overview.inventories.iter();
    all.find(|it| {
        let inventory = &it.inventory;
        inventory.component == field.component && inventory.feature == field.feature
    })
}

/// Draws one value with its picture, its count, and a bar of a length proportional to the count.
fn facet(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (field, stored): (&str, Option<&StoredInventory>),
    value: &str,
    (share, count): (f32, usize),
    on: bool,
) -> Response {
    let inventory = stored.map(|it| &it.inventory);
    let size = vec2(ui.available_width() - 4.0, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let name = format!("{field}={value} ({count})");
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, &name));
    if ui.is_rect_visible(rect) {
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let colours = seen.colours();
        let bar = Rect::from_min_size(rect.min, vec2(rect.width() * share, rect.height()));
        painter.rect_filled(bar.shrink(1.0), 3.0, colours.selection.gamma_multiply(0.5));
        if on {
            painter.rect_filled(rect.shrink(1.0), 3.0, colours.selection);
            let stroke = Stroke::new(1.5, colours.accent);
            painter.rect_stroke(rect.shrink(1.0), 3.0, stroke, StrokeKind::Inside);
        }
        let picture = Rect::from_min_size(rect.min, vec2(26.0, 26.0));
        let mut left = rect.left() + 6.0;
        if let Some(inventory) = inventory
            && pickers::picture(ui, picture.shrink(1.0), seen, inventory, value)
        {
            left = picture.right() + 5.0;
        }
        let visuals = ui.style().interact(&response);
        let font = TextStyle::Body.resolve(ui.style());
        let text = visuals.text_color();
        let hand = HANDS.iter().find(|it| field == "hand" && it.0 == value);
        let origin = origin_named(value).filter(|_| field == "origin");
        let said = hand.map(|(_, text)| *text).or(origin);
        let coded = inventory.and_then(|it| it.get(value));
        let said = said
            .map(|text| seen.say(text))
            .or_else(|| coded.map(|it| pickers::data::short_name(it, seen.language)))
            .unwrap_or(value);
        let at = rect.right_center() - vec2(6.0, 0.0);
        let weak = ui.visuals().weak_text_color();
        let counted = painter.text(at, Align2::RIGHT_CENTER, count, font.clone(), weak);
        // A long value is shortened before its count.
        let mut job = LayoutJob::simple_singleline(said.to_owned(), font, text);
        job.wrap = TextWrapping::truncate_at_width((counted.left() - 6.0 - left).max(0.0));
        let line = painter.layout_job(job);
        let at = pos2(left, rect.center().y - line.size().y * 0.5);
        painter.galley(at, line, text);
        if response.has_focus() || response.hovered() {
            let stroke = Stroke::new(1.0, colours.accent);
            painter.rect_stroke(rect, 3.0, stroke, StrokeKind::Inside);
        }
    }
    let tip = if on {
        words::FACET_OFF
    } else {
        words::FACET_TIP
    };
    let tip = fill(seen.say(tip), &[("value", &value)]);
    response.on_hover_text(tip)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_facet_narrows_the_whole_query_and_is_switched_off_again() {
        let query = "movement=arc or movement=circle";
        let (field, value) = ("dominant.configuration", "5_folded");
        let mut conditions = Conditions::default();
        assert!(!conditions.has(query, field, value));
        let narrowed = clicked(query, field, value).expect("a facet");
        assert_eq!(
            narrowed,
            "(movement=arc or movement=circle) dominant.configuration==5_folded"
        );
        // The answer for another query is not remembered.
        assert!(conditions.has(&narrowed, field, value));
        assert!(conditions.has(&narrowed, field, value));
        assert!(!conditions.has(query, field, value));
        let again = clicked(&narrowed, field, value).expect("a facet");
        assert_eq!(again, query);
    }

    #[test]
    fn facets_stand_in_the_order_of_the_components() {
        let fields = ["signer", "right.placement", "origin", "configuration"].map(str::to_owned);
        let order: Vec<&str> = order(fields.iter())
            .into_iter()
            .map(String::as_str)
            .collect();
        assert_eq!(
            order,
            ["configuration", "right.placement", "signer", "origin"]
        );
    }
}
