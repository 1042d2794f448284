//! Facets: how often each value occurs among the results.

use std::collections::BTreeMap;

use chereme_corpus::StoredInventory;
use chereme_sign::query::{add_query_condition, facet_condition, has_query_condition, remove_query_condition};
use chereme_sign::{ComponentField, SignComponent};
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, pos2,
    vec2,
};

use super::hits::attribute_name_text;
use super::search_rows::{component_text, feature_text};
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::panes::library::library_data::origin_named;
use crate::pickers;
use crate::words::{InterfaceText, fill_text_braces, library, recombine_words, search_words as words};

/// The words of fields for hands and phases.
const FACET_PART_WORDS: [(&str, InterfaceText); 6] = [
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
pub(super) struct FacetConditions {
    query: String,
    known: BTreeMap<String, BTreeMap<String, bool>>,
}

impl FacetConditions {
    /// Returns whether `query` has a facet's value as a condition.
    fn has_facet_condition(&mut self, query: &str, field: &str, value: &str) -> bool {
        if self.query != query {
            query.clone_into(&mut self.query);
            self.known.clear();
        }
        if let Some(on) = self.known.get(field).and_then(|values| values.get(value)) {
            return *on;
        }
        let on = facet_condition(field, value).is_some_and(|condition| has_query_condition(query, &condition));
        let of_field = self.known.entry(field.to_owned()).or_default();
        of_field.insert(value.to_owned(), on);
        on
    }
}

/// Returns the query after a click on a facet's value: narrowed by the value as a whole, or without that condition.
/// Returns `None` for a field that queries cannot name.
fn toggle_facet_condition(query: &str, field: &str, value: &str) -> Option<String> {
    let condition = facet_condition(field, value)?;
    Some(match has_query_condition(query, &condition) {
        true => remove_query_condition(query, &condition),
        false => add_query_condition(query, &condition),
    })
}

/// Draws how often each value occurs; a click returns the query with a condition for that value, or without it if the
/// query has it already.
pub(super) fn show_search_facets(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    facets: &BTreeMap<String, Vec<(String, usize)>>,
    query: &str,
    conditions: &mut FacetConditions,
    height: f32,
) -> Option<String> {
    let mut chosen = None;
    ScrollArea::vertical()
        .id_salt("facets")
        .max_height(height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for field in order_facet_fields(facets.keys()) {
                let values = &facets[field];
                let name = facet_name(field, seen);
                ui.label(RichText::new(name).small().weak());
                let most = values.iter().map(|(_, count)| *count).max().unwrap_or(1);
                for (value, count) in values {
                    let stored = find_facet_inventory(field, value, seen);
                    let drawn = DrawnFacetValue {
                        field,
                        stored,
                        value,
                        count: *count,
                        share: *count as f32 / most as f32,
                        on: conditions.has_facet_condition(query, field, value),
                    };
                    let response = draw_facet_value(ui, seen, &drawn);
                    let holding_inventory = stored.filter(|stored| stored.inventory.value_by_id(value).is_some());
                    let thing = holding_inventory.map(|stored| InspectedThing::Value(stored.id, value.clone()));
                    let asks = ui.input(|input| input.modifiers.command);
                    match thing {
                        Some(thing) if response.clicked() && asks => {
                            seen.send_command(WindowCommand::Inspect(thing));
                        }
                        _ if response.clicked() => {
                            chosen = toggle_facet_condition(query, field, value);
                        }
                        Some(thing) => show_facet_menu(seen, &response, thing),
                        None => {}
                    }
                }
                ui.add_space(4.0);
            }
        });
    chosen
}

/// Returns the name of an attribute that a query spells so, such as `attribute.frequency`.
fn attribute_of_field(field: &str) -> Option<&str> {
    let rest = field.strip_prefix("attribute")?;
    let quoted = rest.strip_prefix("(\"").and_then(|rest| rest.strip_suffix("\")"));
    quoted.or_else(|| rest.strip_prefix('.'))
}

/// Returns the fields of facets: an attribute, which the user asked for, the components in their order, other fields.
pub(super) fn order_facet_fields<'a>(fields: impl Iterator<Item = &'a String>) -> Vec<&'a String> {
    let mut all: Vec<&String> = fields.collect();
    let place = |field: &&String| {
        let component = field.parse::<ComponentField>().ok().map(|parsed| parsed.component);
        let place = SignComponent::ALL_COMPONENTS
            .iter()
            .position(|other| Some(*other) == component)
            .unwrap_or(SignComponent::ALL_COMPONENTS.len());
        (attribute_of_field(field).is_none(), place)
    };
    all.sort_by_key(place);
    all
}

/// The words of fields that are no component.
const OTHER_FACET_WORDS: [(&str, InterfaceText); 6] = [
    ("disputed", words::DISPUTED),
    ("gloss", words::GLOSS),
    ("hand", words::HAND),
    ("proposed", words::PROPOSED),
    ("recording", words::RECORDING),
    ("signer", words::SIGNER),
];

/// The words of the hands of a sign.
const FACET_HAND_WORDS: [(&str, InterfaceText); 3] = [
    ("both", recombine_words::BOTH_HANDS),
    ("dominant", words::DOMINANT),
    ("weak", words::WEAK),
];

/// Returns the name of a field in the words of the window.
pub(crate) fn facet_name(field: &str, seen: &PaneInput<'_>) -> String {
    if let Some(name) = attribute_of_field(field) {
        return attribute_name_text(name, seen.language).to_owned();
    }
    let Ok(known) = field.parse::<ComponentField>() else {
        let entry = OTHER_FACET_WORDS.iter().find(|(word, _)| *word == field);
        return entry.map_or(field, |(_, text)| seen.say_text(*text)).to_owned();
    };
    let mut name = seen.say_text(component_text(known.component)).to_owned();
    for part in known.feature.iter() {
        name.push_str(&format!(" · {}", feature_text(part, seen)));
    }
    let hand = known.hand.map(|hand| hand.to_string());
    let phase = known.phase.map(|phase| phase.to_string());
    for part in hand.into_iter().chain(phase) {
        let entry = FACET_PART_WORDS.iter().find(|(word, _)| *word == part);
        let part = entry.map_or(part.as_str(), |(_, text)| seen.say_text(*text));
        name.push_str(&format!(" ({part})"));
    }
    name
}

/// Offers the details of a value in a context menu.
fn show_facet_menu(seen: &PaneInput<'_>, response: &Response, thing: InspectedThing) {
    response.context_menu(|ui| {
        if ui.button(seen.say_text(library::INSPECT)).clicked() {
            seen.send_command(WindowCommand::Inspect(thing));
            ui.close();
        }
    });
}

/// Returns the inventory of a field that has a value, otherwise the first of the field.
fn find_facet_inventory<'a>(field: &str, value: &str, seen: &PaneInput<'a>) -> Option<&'a StoredInventory> {
    let field = field.parse::<ComponentField>().ok()?;
    let all = seen.snapshot.overview.inventories.iter();
    let of_field = all.filter(|stored| {
        let inventory = &stored.inventory;
        inventory.component == field.component && inventory.feature == field.feature
    });
    let has_value = |stored: &&StoredInventory| stored.inventory.value_by_id(value).is_some();
    of_field.clone().find(has_value).or_else(|| of_field.clone().next())
}

/// A value of a facet as it is drawn.
struct DrawnFacetValue<'a> {
    field: &'a str,
    stored: Option<&'a StoredInventory>,
    value: &'a str,
    count: usize,
    /// The count as a share of the greatest one of the field.
    share: f32,
    /// Whether the query has a condition for it.
    on: bool,
}

/// Draws one value with its picture, its count, and a bar of a length proportional to the count.
fn draw_facet_value(ui: &mut Ui, seen: &PaneInput<'_>, drawn: &DrawnFacetValue<'_>) -> Response {
    let DrawnFacetValue {
        field,
        stored,
        value,
        count,
        share,
        on,
    } = *drawn;
    let inventory = stored.map(|stored| &stored.inventory);
    let size = vec2(ui.available_width() - 4.0, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let name = format!("{field}={value} ({count})");
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, &name));
    if ui.is_rect_visible(rect) {
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let colours = seen.pane_colours();
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
            && pickers::paint_inventory_value(ui, picture.shrink(1.0), seen, inventory, value)
        {
            left = picture.right() + 5.0;
        }
        let visuals = ui.style().interact(&response);
        let font = TextStyle::Body.resolve(ui.style());
        let text = visuals.text_color();
        let hand = FACET_HAND_WORDS
            .iter()
            .find(|entry| field == "hand" && entry.0 == value);
        let origin = origin_named(value).filter(|_| field == "origin");
        let fixed_text = hand.map(|(_, text)| *text).or(origin);
        let coded = inventory.and_then(|inventory| inventory.value_by_id(value));
        let value_text = fixed_text
            .map(|text| seen.say_text(text))
            .or_else(|| coded.map(|coded_value| pickers::pickers_data::short_name(coded_value, seen.language)))
            .unwrap_or(value);
        let range = attribute_of_field(field).and_then(|_| value.split_once(" to "));
        let value_text = range.map_or(value_text.to_owned(), |(from, to)| format!("{from} – {to}"));
        let count_position = rect.right_center() - vec2(6.0, 0.0);
        let weak = ui.visuals().weak_text_color();
        let counted = painter.text(count_position, Align2::RIGHT_CENTER, count, font.clone(), weak);
        // A long value is shortened before its count.
        let mut job = LayoutJob::simple_singleline(value_text, font, text);
        job.wrap = TextWrapping::truncate_at_width((counted.left() - 6.0 - left).max(0.0));
        let line = painter.layout_job(job);
        let text_position = pos2(left, rect.center().y - line.size().y * 0.5);
        painter.galley(text_position, line, text);
        if response.has_focus() || response.hovered() {
            let stroke = Stroke::new(1.0, colours.accent);
            painter.rect_stroke(rect, 3.0, stroke, StrokeKind::Inside);
        }
    }
    let tip_text = if on { words::FACET_OFF } else { words::FACET_TIP };
    let tip = fill_text_braces(seen.say_text(tip_text), &[("value", &value)]);
    response.on_hover_text(tip)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_facet_narrows_the_whole_query_and_is_switched_off_again() {
        let query = "movement=arc or movement=circle";
        let (field, value) = ("dominant.configuration", "5_folded");
        let mut conditions = FacetConditions::default();
        assert!(!conditions.has_facet_condition(query, field, value));
        let narrowed = toggle_facet_condition(query, field, value).expect("a facet");
        assert_eq!(
            narrowed,
            "(movement=arc or movement=circle) dominant.configuration==5_folded"
        );
        // The answer for another query is not remembered.
        assert!(conditions.has_facet_condition(&narrowed, field, value));
        assert!(conditions.has_facet_condition(&narrowed, field, value));
        assert!(!conditions.has_facet_condition(query, field, value));
        let again = toggle_facet_condition(&narrowed, field, value).expect("a facet");
        assert_eq!(again, query);
    }

    #[test]
    fn facets_stand_in_the_order_of_the_components() {
        let fields = [
            "signer",
            "right.placement",
            "origin",
            "configuration",
            "attribute.frequency",
        ]
        .map(str::to_owned);
        let order: Vec<&str> = order_facet_fields(fields.iter())
            .into_iter()
            .map(String::as_str)
            .collect();
        let wanted = [
            "attribute.frequency",
            "configuration",
            "right.placement",
            "signer",
            "origin",
        ];
        assert_eq!(order, wanted);
    }

    #[test]
    fn an_attribute_is_a_facet_by_the_name_that_queries_give_it() {
        for name in ["frequency", "measure.density", "Sign Frequency"] {
            let field = chereme_sign::query::attribute_field_text(name);
            assert_eq!(attribute_of_field(&field), Some(name));
            let narrowed = toggle_facet_condition("gloss=A", &field, "12").expect("a condition");
            assert_eq!(
                toggle_facet_condition(&narrowed, &field, "12").as_deref(),
                Some("gloss=A")
            );
        }
        assert_eq!(attribute_of_field("configuration"), None);
    }
}
