//! Beside the query: what was asked before and what is kept, help by examples, facets, and what is
//! said where nothing is found.

use std::collections::BTreeMap;

use chereme_corpus::{Around, SearchOptions};
use chereme_sign::query::Query;
use chereme_sign::{Component, Field};
use eframe::egui::{
    Button, Key, Label, Popup, PopupCloseBehavior, Rect, RichText, Role, ScrollArea, Sense,
    TextEdit, Ui, WidgetInfo, vec2,
};

use super::builder::{self, with_value};
use super::rows::component_text;
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::pickers;
use crate::settings::Searches;
use crate::words::{Text, fill, search as words};
use crate::work::{Ended, Outcome, Work, WorkId};

/// What the help shows: a query, and what it finds.
const EXAMPLES: [(&str, Text); 9] = [
    ("right.configuration=U placement=chin", words::EXAMPLE_BOTH),
    ("gloss:BO*", words::EXAMPLE_GLOSS),
    ("movement=arc or movement=circle", words::EXAMPLE_OR),
    (
        "configuration=[index middle -thumb]",
        words::EXAMPLE_FEATURES,
    ),
    ("placement!=chest", words::EXAMPLE_NOT),
    ("duration<0.8s", words::EXAMPLE_TIME),
    ("movement=unset", words::EXAMPLE_UNSET),
    ("overlaps nonmanual.brows=raised", words::EXAMPLE_BESIDE),
    ("origin=made", words::EXAMPLE_MADE),
];

/// What stands beside the query.
#[derive(Debug, Default)]
pub(super) struct Aside {
    /// The name under which the query is to be kept, and the search that gets another name.
    name: String,
    /// The list was just opened: what is typed is a name.
    opened_list: bool,
    renaming: Option<(String, String)>,
    /// How many each kept search finds, where it was counted.
    counts: BTreeMap<String, Option<usize>>,
    counting: BTreeMap<WorkId, String>,
    /// Where nothing is found: what each condition left out would give.
    without: Option<Without>,
    leaving: BTreeMap<WorkId, usize>,
    /// A hit that is being opened, and where it turned out to be.
    pub(super) opening: Option<WorkId>,
    pub(super) opened: Option<Around>,
}

/// What a query that finds nothing would find without each of its conditions.
#[derive(Debug, Clone, PartialEq)]
struct Without {
    query: String,
    /// The condition, the query without it, and how many that finds.
    parts: Vec<(String, String, Option<usize>)>,
}

/// Returns each condition of a query with the query that is left without it.
pub(super) fn parts(query: &str) -> Vec<(String, String)> {
    let Ok(query) = Query::parse(query) else {
        return Vec::new();
    };
    let rows = builder::rows(&query);
    (0..rows.len())
        .map(|at| {
            let mut rest = rows.clone();
            let gone = rest.remove(at);
            (builder::text(&[gone]), builder::text(&rest))
        })
        .collect()
}

impl Aside {
    pub(super) fn forget_counts(&mut self) {
        self.counts.clear();
        self.without = None;
    }

    pub(super) fn forget_nothing(&mut self) {
        self.without = None;
    }

    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) {
        let total = match ended {
            Ok(Outcome::Found(answer)) => Some(answer.total),
            _ => None,
        };
        if let Some(query) = self.counting.remove(&id) {
            self.counts.insert(query, total);
        }
        if let Some(at) = self.leaving.remove(&id)
            && let Some(without) = &mut self.without
            && let Some(part) = without.parts.get_mut(at)
        {
            part.2 = total;
        }
        if self.opening == Some(id) {
            self.opening = None;
            if let Ok(Outcome::Around(around)) = ended {
                self.opened = around.first().cloned();
            }
        }
    }

    /// Keeps a query among those that were asked.
    pub(super) fn remember(&mut self, query: &str, seen: &Seen<'_>, out: &mut Outbox) {
        let mut searches = seen.settings.searches.clone();
        if Query::parse(query).is_ok() && searches.asked(query) {
            out.send(Command::Searches(searches));
        }
    }

    /// Draws the menus; returns the query that was chosen.
    pub(super) fn menus(
        &mut self,
        ui: &mut Ui,
        seen: &Seen<'_>,
        out: &mut Outbox,
        query: &str,
    ) -> Option<String> {
        let mut chosen = None;
        let saved = ui.button(seen.say(words::SAVED));
        self.opened_list |= saved.clicked();
        Popup::from_toggle_button_response(&saved)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .accessible_name(seen.say(words::SAVED))
            .show(|ui| {
                ui.set_min_width(300.0);
                chosen = self.saved(ui, seen, out, query);
            });
        let recent = ui.button(seen.say(words::RECENT));
        Popup::menu(&recent).show(|ui| {
            ui.set_min_width(260.0);
            if seen.settings.searches.recent.is_empty() {
                ui.weak(seen.say(words::NO_RECENT));
            }
            for query in &seen.settings.searches.recent {
                if ui.button(query).clicked() {
                    chosen = Some(query.clone());
                }
            }
        });
        let help = ui.button("?").on_hover_text(seen.say(words::HELP));
        help.widget_info(|| WidgetInfo::labeled(Role::Button, true, seen.say(words::HELP)));
        Popup::from_toggle_button_response(&help)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show(|ui| {
                ui.set_min_width(420.0);
                let by_example = examples(ui, seen);
                ui.collapsing(seen.say(words::WHOLE_HELP), |ui| {
                    ScrollArea::vertical().max_height(280.0).show(ui, |ui| {
                        let text = RichText::new(chereme_corpus::QUERY_HELP)
                            .monospace()
                            .small();
                        ui.add(Label::new(text).extend());
                    });
                });
                chosen = chosen.take().or(by_example);
            });
        chosen
    }

    /// Draws the kept searches; returns the one that was chosen.
    fn saved(
        &mut self,
        ui: &mut Ui,
        seen: &Seen<'_>,
        out: &mut Outbox,
        query: &str,
    ) -> Option<String> {
        let mut chosen = None;
        let mut next: Option<Searches> = None;
        ui.horizontal(|ui| {
            let hint = seen.say(words::SAVE_NAME);
            let before = self.name.clone();
            let field = TextEdit::singleline(&mut self.name)
                .hint_text(hint)
                .desired_width(170.0);
            let response = ui.add(field);
            let text = self.name.clone();
            response.widget_info(|| WidgetInfo {
                label: Some(hint.to_owned()),
                ..WidgetInfo::text_edit(true, &before, &text, hint)
            });
            if std::mem::take(&mut self.opened_list) {
                response.request_focus();
            }
            let named = !self.name.trim().is_empty() && Query::parse(query).is_ok();
            let save = Button::new(seen.say(words::SAVE));
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let pressed = ui.add_enabled(named, save).clicked();
            if named && (pressed || entered) {
                let mut searches = seen.settings.searches.clone();
                searches.save(self.name.trim(), query);
                self.name.clear();
                next = Some(searches);
            }
        });
        if seen.settings.searches.saved.is_empty() {
            ui.weak(seen.say(words::NO_SAVED));
        }
        ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
            for saved in &seen.settings.searches.saved {
                self.count(&saved.query, out);
                let known = self.counts.get(&saved.query).copied().flatten();
                ui.push_id(&saved.name, |ui| {
                    ui.horizontal(|ui| {
                        let mut change = |searches| next = Some(searches);
                        if self.rename(ui, seen, &saved.name, &mut change) {
                            return;
                        }
                        let number = known.map_or(String::new(), |it| it.to_string());
                        let button = Button::new(&saved.name).shortcut_text(number);
                        if ui.add(button).on_hover_text(&saved.query).clicked() {
                            chosen = Some(saved.query.clone());
                        }
                        let name = fill(seen.say(words::RENAME), &[("name", &saved.name)]);
                        if named(ui, seen.say(words::RENAME_SHORT), &name) {
                            self.renaming = Some((saved.name.clone(), saved.name.clone()));
                        }
                        let name = fill(seen.say(words::DELETE), &[("name", &saved.name)]);
                        if named(ui, "×", &name) {
                            let mut searches = seen.settings.searches.clone();
                            searches.delete(&saved.name);
                            change(searches);
                        }
                    });
                });
            }
        });
        if let Some(searches) = next {
            out.send(Command::Searches(searches));
        }
        chosen
    }

    /// Draws the field in which a kept search gets another name, where it is this one.
    fn rename(
        &mut self,
        ui: &mut Ui,
        seen: &Seen<'_>,
        name: &str,
        change: &mut impl FnMut(Searches),
    ) -> bool {
        let Some((of, text)) = self.renaming.as_mut().filter(|(of, _)| of == name) else {
            return false;
        };
        let hint = fill(seen.say(words::RENAME), &[("name", of)]);
        let before = text.clone();
        let response = ui.add(TextEdit::singleline(text).desired_width(200.0));
        let shown = text.clone();
        response.widget_info(|| WidgetInfo {
            label: Some(hint.clone()),
            ..WidgetInfo::text_edit(true, &before, &shown, &hint)
        });
        if response.lost_focus() {
            let mut searches = seen.settings.searches.clone();
            searches.rename(name, text.trim());
            change(searches);
            self.renaming = None;
        } else if !response.has_focus() {
            response.request_focus();
        }
        true
    }

    fn count(&mut self, query: &str, out: &mut Outbox) {
        if self.counts.contains_key(query) {
            return;
        }
        self.counts.insert(query.to_owned(), None);
        let id = out.work(Work::Search(query.to_owned(), only_counted()));
        self.counting.insert(id, query.to_owned());
    }

    /// Says that nothing was found, and which condition leaves everything out; returns the query that
    /// was chosen instead.
    pub(super) fn nothing(
        &mut self,
        ui: &mut Ui,
        seen: &Seen<'_>,
        out: &mut Outbox,
        query: &str,
    ) -> Option<String> {
        ui.strong(seen.say(words::NOTHING));
        if self.without.as_ref().is_none_or(|it| it.query != query) {
            self.leaving.clear();
            let parts = parts(query);
            for (at, (_, rest)) in parts.iter().enumerate() {
                let id = out.work(Work::Search(rest.clone(), only_counted()));
                self.leaving.insert(id, at);
            }
            self.without = Some(Without {
                query: query.to_owned(),
                parts: parts
                    .into_iter()
                    .map(|(part, rest)| (part, rest, None))
                    .collect(),
            });
        }
        let without = self.without.as_ref()?;
        if without.parts.is_empty() {
            return None;
        }
        let mut chosen = None;
        ui.label(seen.say(words::WITHOUT));
        for (part, rest, total) in &without.parts {
            let total = total.map_or("…".to_owned(), |it| it.to_string());
            let text = fill(
                seen.say(words::WITHOUT_ONE),
                &[("part", part), ("n", &total)],
            );
            if ui.link(text).clicked() {
                chosen = Some(rest.clone());
            }
        }
        if without.parts.iter().all(|(_, _, total)| *total == Some(0)) {
            ui.weak(seen.say(words::WITHOUT_NONE));
        }
        chosen
    }
}

fn only_counted() -> SearchOptions {
    SearchOptions {
        limit: Some(0),
        facets: false,
        ..SearchOptions::default()
    }
}

/// Draws a small button with a sign, called `name`; returns whether it was pressed.
fn named(ui: &mut Ui, sign: &str, name: &str) -> bool {
    let response = ui.small_button(sign).on_hover_text(name);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    response.clicked()
}

/// Draws queries to begin with; returns the one that was chosen.
pub(super) fn examples(ui: &mut Ui, seen: &Seen<'_>) -> Option<String> {
    let mut chosen = None;
    ui.label(RichText::new(seen.say(words::EXAMPLES)).strong());
    for (query, about) in EXAMPLES {
        ui.horizontal_wrapped(|ui| {
            if ui.link(RichText::new(query).monospace()).clicked() {
                chosen = Some(query.to_owned());
            }
            ui.label(RichText::new(seen.say(about)).small().weak());
        });
    }
    chosen
}

/// Draws how often each value occurs; returns the query that wants the one that was chosen too.
pub(super) fn facets(
    ui: &mut Ui,
    seen: &Seen<'_>,
    facets: &BTreeMap<String, Vec<(String, usize)>>,
    query: &str,
    height: f32,
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
                for (value, count) in values {
                    if facet(ui, seen, field, value, *count as f32 / most as f32, *count) {
                        chosen = Some(with_value(query, field, value));
                    }
                }
                ui.add_space(4.0);
            }
        });
    chosen
}

/// Returns the fields of facets in the order of the components, the others after them.
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

fn facet_name(field: &str, seen: &Seen<'_>) -> String {
    let Ok(known) = field.parse::<Field>() else {
        return field.to_owned();
    };
    let mut name = seen.say(component_text(known.component)).to_owned();
    for part in known.feature.iter() {
        name.push_str(&format!(" · {part}"));
    }
    let hand = known.hand.map(|hand| hand.to_string());
    let phase = known.phase.map(|phase| phase.to_string());
    for part in hand.into_iter().chain(phase) {
        name.push_str(&format!(" ({part})"));
    }
    name
}

/// Draws one value with its picture, its count, and a bar that is as long as it is frequent.
fn facet(ui: &mut Ui, seen: &Seen<'_>, field: &str, value: &str, share: f32, count: usize) -> bool {
    let parsed = field.parse::<Field>().ok();
    let inventory = parsed.as_ref().and_then(|field| {
        let all = seen.snapshot.overview.inventories.iter();
        all.map(|it| &it.inventory)
            .find(|it| it.component == field.component && it.feature == field.feature)
    });
    let size = vec2(ui.available_width() - 4.0, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let name = format!("{field}={value} ({count})");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    if ui.is_rect_visible(rect) {
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let colours = seen.colours();
        let bar = Rect::from_min_size(rect.min, vec2(rect.width() * share, rect.height()));
        painter.rect_filled(bar.shrink(1.0), 3.0, colours.selection.gamma_multiply(0.5));
        let picture = Rect::from_min_size(rect.min, vec2(26.0, 26.0));
        let mut left = rect.left() + 6.0;
        if let Some(inventory) = inventory
            && pickers::picture(ui, picture.shrink(1.0), seen, inventory, value)
        {
            left = picture.right() + 5.0;
        }
        let visuals = ui.style().interact(&response);
        let font = eframe::egui::TextStyle::Body.resolve(ui.style());
        let text = visuals.text_color();
        let at = eframe::egui::pos2(left, rect.center().y);
        painter.text(
            at,
            eframe::egui::Align2::LEFT_CENTER,
            value,
            font.clone(),
            text,
        );
        let at = rect.right_center() - vec2(6.0, 0.0);
        let weak = ui.visuals().weak_text_color();
        painter.text(at, eframe::egui::Align2::RIGHT_CENTER, count, font, weak);
        if response.has_focus() || response.hovered() {
            let stroke = eframe::egui::Stroke::new(1.0, colours.accent);
            painter.rect_stroke(rect, 3.0, stroke, eframe::egui::StrokeKind::Inside);
        }
    }
    let tip = fill(seen.say(words::FACET_TIP), &[("value", &value)]);
    response.on_hover_text(tip).clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_condition_is_left_out_in_turn() {
        let pair = |part: &str, rest: &str| (part.to_owned(), rest.to_owned());
        assert_eq!(
            parts("configuration=U placement=chin not gloss=A"),
            [
                pair("configuration=U", "placement=chin not gloss=A"),
                pair("placement=chin", "configuration=U not gloss=A"),
                pair("not gloss=A", "configuration=U placement=chin"),
            ]
        );
        assert!(parts("").is_empty());
        assert!(parts("a=(").is_empty());
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

    #[test]
    fn every_example_is_a_query() {
        for (query, _) in EXAMPLES {
            assert!(query.parse::<Query>().is_ok(), "{query}");
        }
    }
}
