//! Attributes of signs in the search: the order of hits by one, and the counts of the values of one.

use std::sync::Arc;

use chereme_corpus::{FACET_VALUES, NO_VALUE};
use chereme_sign::query::attribute_field_text;
use eframe::egui::{ScrollArea, Ui};

use super::SearchPane;
use super::hits::{HitSort, QueryAnswer, attribute_name_text};
use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::words::{InterfaceText, fill_text_braces, search_words as words};
use crate::work::{WorkId, WorkOutcome, WorkResult, searching};

/// The orders that every corpus has.
const USUAL_ORDERS: [(HitSort, InterfaceText); 4] = [
    (HitSort::Rank, words::ORDER_RANK),
    (HitSort::Place, words::PLACE),
    (HitSort::Gloss, words::GLOSS),
    (HitSort::Duration, words::DURATION),
];
/// The greatest height of a list of attributes, in points.
const ATTRIBUTE_LIST_HEIGHT_POINTS: f32 = 260.0;

/// Shows the menu of the orders of hits; returns the chosen one.
pub(super) fn show_order_menu(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    sort: &HitSort,
    descending: &mut bool,
) -> Option<HitSort> {
    let mut chosen = None;
    let title = fill_text_braces(seen.say_text(words::ORDER), &[("order", &order_text(sort, seen))]);
    ui.menu_button(title, |ui| {
        for (order, text) in USUAL_ORDERS {
            if ui.selectable_label(*sort == order, seen.say_text(text)).clicked() {
                chosen = Some(order);
                ui.close();
            }
        }
        if seen.snapshot.overview.attributes.is_empty() {
            return;
        }
        ui.separator();
        let greatest = ui.checkbox(descending, seen.say_text(words::GREATEST_FIRST));
        let by = |name: &str, descending: bool| HitSort::Attribute {
            name: name.to_owned(),
            descending,
        };
        if greatest.changed() {
            chosen = sort.sort_attribute().map(|name| by(name, *descending));
        }
        if let Some(name) = choose_attribute(ui, seen, sort.sort_attribute()) {
            chosen = Some(by(&name, *descending));
            ui.close();
        }
    });
    chosen
}

/// Lists attributes; returns the one that is pressed.
fn choose_attribute(ui: &mut Ui, seen: &PaneInput<'_>, now: Option<&str>) -> Option<String> {
    let mut chosen = None;
    let area = ScrollArea::vertical().max_height(ATTRIBUTE_LIST_HEIGHT_POINTS);
    area.show(ui, |ui| {
        // The origin of the measures is the same for all signs, and orders nothing.
        let listed = seen.snapshot.overview.attributes.iter();
        for name in listed.filter(|name| *name != "measure.origin") {
            let label = ui.selectable_label(now == Some(name), attribute_name_text(name, seen.language));
            if label.clicked() {
                chosen = Some(name.clone());
            }
        }
    });
    chosen
}

fn order_text(sort: &HitSort, seen: &PaneInput<'_>) -> String {
    let usual = USUAL_ORDERS.iter().find(|(order, _)| order == sort);
    match sort {
        HitSort::Before => seen.say_text(words::BEFORE).to_owned(),
        HitSort::After => seen.say_text(words::AFTER).to_owned(),
        HitSort::Attribute { name, .. } => attribute_name_text(name, seen.language).to_owned(),
        _ => usual.map_or("", |(_, text)| seen.say_text(*text)).to_owned(),
    }
}

/// An attribute whose values are counted among the hits, as one more facet.
#[derive(Debug, Default)]
pub(super) struct CountedAttribute {
    name: Option<String>,
    asked: Option<WorkId>,
    /// Whether the counts of the present answer were requested.
    is_requested: bool,
}

impl CountedAttribute {
    /// Forgets the counts: there is another answer.
    pub(super) fn forget_attribute_counts(&mut self) {
        (self.asked, self.is_requested) = (None, false);
    }

    /// Requests the counts of an answer that lacks them.
    pub(super) fn request_attribute_counts(&mut self, query: &str, out: &CommandOutbox) {
        if let Some(name) = self.name.as_ref().filter(|_| !self.is_requested) {
            let field = attribute_field_text(name);
            self.asked = Some(out.request_work(searching::tally_values_job(query.to_owned(), vec![field])));
            self.is_requested = true;
        }
    }

    /// Puts requested counts among the facets of the answer.
    pub(super) fn receive_attribute_counts(&mut self, id: WorkId, ended: &WorkResult, found: &mut QueryAnswer) {
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        if let (Some(name), Ok(WorkOutcome::Tallied(tally))) = (&self.name, ended) {
            let valued = tally.rows.iter().filter(|row| row.value != NO_VALUE);
            let counts = valued.take(FACET_VALUES).map(|row| (row.value.clone(), row.total));
            Arc::make_mut(&mut found.facets).insert(attribute_field_text(name), counts.collect());
        }
    }
}

impl SearchPane {
    /// Shows the button of the cross table above the facets, and the menu of the attributes to count if signs have any.
    pub(super) fn show_count_menu(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.cross_table.show_cross_button(ui, seen);
        if seen.snapshot.overview.attributes.is_empty() {
            return;
        }
        let counted = self.counted_attribute.name.clone();
        ui.menu_button(seen.say_text(words::COUNT), |ui| {
            let Some(name) = choose_attribute(ui, seen, counted.as_deref()) else {
                return;
            };
            if let (Some(old), Some(found)) = (&counted, &mut self.found) {
                Arc::make_mut(&mut found.facets).remove(&attribute_field_text(old));
            }
            self.counted_attribute = CountedAttribute {
                name: Some(name).filter(|name| counted.as_ref() != Some(name)),
                ..CountedAttribute::default()
            };
            ui.close();
        });
    }
}
