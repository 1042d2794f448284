//! The page: the query, the number of results and their form, the results, and facets.

use chereme_corpus::meant_query_text;
use chereme_sign::query::TokenQuery;
use eframe::egui::{RichText, Ui, vec2};

use super::{
    ResultsView, SEARCH_PAUSE_SECONDS, SearchPane, panes_search_facets, results, search_order, search_rows,
    search_suggest, search_symbols, side_column,
};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::window_remedy;
use crate::words::{InterfaceLanguage, fill_text_braces, search_words as words, translate_library_message};

/// A pane wider than this, in points, has room for facets beside its results.
const FACETS_BESIDE_WIDTH_POINTS: f32 = 520.0;
/// If this much of the line is left, in points, all switches fit beside the number of results.
const FULL_SWITCHES_WIDTH_POINTS: f32 = 430.0;
/// If this much of the line is left, in points, the order fits beside the number of results.
const ORDER_WIDTH_POINTS: f32 = 260.0;

impl SearchPane {
    /// Draws the page, with the results `high` points high.
    pub(super) fn draw_search_page(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, high: f32) {
        let top = ui.cursor().top();
        self.draw_search_question(ui, seen);
        self.head = ui.cursor().top() - top + ui.spacing().interact_size.y;
        if self.field.text.trim().is_empty() {
            if let Some(query) = self.tiles.show_component_tiles(ui, seen) {
                self.turn_to_query(query, seen.out);
            }
            // The wall of all signs is shown below.
            if self.found.is_none() && self.asked.is_none() && self.wrong.is_none() && !self.stopped {
                self.search_present_text(seen.out);
            }
        } else if self.found.is_none() && self.asked.is_none() {
            return;
        }
        self.draw_search_status(ui, seen);
        self.head = ui.cursor().top() - top;
        let size = vec2(ui.available_width(), high);
        ui.allocate_ui(size, |ui| {
            ui.set_width(size.x);
            ui.set_max_height(size.y);
            self.show_movement_hint(ui, seen);
            self.draw_search_answer(ui, seen);
        });
    }

    /// Draws the query: its text, its rows, and the buttons for it.
    fn draw_search_question(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let now = ui.input(|input| input.time);
        let wrong_from = self.wrong.as_ref().and_then(|wrong| wrong.from);
        let wrong = wrong_from.filter(|_| self.query == self.field.text);
        if std::mem::take(&mut self.come) {
            self.field.take_focus();
        }
        let typed = self.field.ui(ui, seen, wrong);
        if typed.changed {
            self.changed = Some(now);
            self.rows = search_rows::ConditionRows::default();
        }
        if typed.entered {
            if let Some(query) = search_suggest::kept_query(&self.field.text, seen.snapshot) {
                self.field.set_query_text(query.to_owned());
                self.rows = search_rows::ConditionRows::default();
            } else if let Some(query) = meant_query_text(&self.field.text, &seen.snapshot.overview.inventories) {
                self.field.set_query_text(query);
                self.rows = search_rows::ConditionRows::default();
            }
            self.field.take_focus();
            // Entering a text hides the rows if there is not enough room for them and the results.
            self.built &= !self.low;
            self.aside.remember_recent_query(&self.field.text, seen);
            self.search_present_text(seen.out);
        }
        if typed.down && self.found.as_ref().is_some_and(|found| found.total > 0) {
            self.move_cursor_to_hit(self.at);
        }
        // The field itself reports text that is not a valid query.
        let text = &self.field.text;
        let faulty = TokenQuery::parse_query(text).is_err() || search_suggest::is_unkept(text, seen.snapshot);
        if let Some(wrong) = self.wrong.as_ref().filter(|_| self.query == self.field.text && !faulty) {
            let trouble = seen.pane_colours().trouble;
            let translation = translate_library_message(&wrong.error, seen.language);
            if seen.language != InterfaceLanguage::English && translation == wrong.error {
                ui.label(seen.say_text(crate::words::trouble_words::QUERY_WRONG));
            }
            ui.label(RichText::new(translation).small().color(trouble));
            let remedy = wrong.remedy.as_ref();
            if let Some(remedy) = remedy.and_then(|remedy| window_remedy::window_remedy_text(remedy, seen.language)) {
                ui.label(RichText::new(remedy).small());
            }
            let mended = wrong.mended.clone();
            if let Some((meant, query)) = mended {
                let text = fill_text_braces(seen.say_text(words::MEND), &[("text", &meant)]);
                if ui.small_button(text).clicked() {
                    self.turn_to_query(query, seen.out);
                }
            }
        }
        self.draw_search_tools(ui, seen);
        self.examples.look_up_unknown_examples(&self.field.text, seen);
        let text = &mut self.field.text;
        if self.built && search_rows::show_condition_rows(ui, &mut self.rows, seen, text, &self.examples) {
            self.search_present_text(seen.out);
        }
        for picker in self.rows.pickers.values_mut() {
            picker.inspect_requested_value(seen);
        }
        let settled = self.changed.is_some_and(|when| now - when >= SEARCH_PAUSE_SECONDS);
        let error = TokenQuery::parse_query(&self.field.text).err();
        let end = self.field.text.trim_end().chars().count();
        if settled && !typed.unfinished && error.is_none() {
            self.search_present_text(seen.out);
        } else if settled && error.is_some_and(|error| error.at.start < end) {
            // The old answer does not belong to the new query.
            (self.found, self.changed) = (None, None);
        } else if self.changed.is_some() {
            ui.ctx().request_repaint_after_secs(SEARCH_PAUSE_SECONDS as f32);
        }
    }

    fn draw_search_tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal_wrapped(|ui| {
            if ui.available_width() < FACETS_BESIDE_WIDTH_POINTS {
                // In a narrow pane the buttons are narrower, so that all of them fit into one line.
                ui.spacing_mut().item_spacing.x = 3.0;
                ui.spacing_mut().button_padding.x = 5.0;
            }
            let rows = ui.selectable_label(self.built, seen.say_text(words::ROWS));
            if rows.clicked() {
                self.built = !self.built;
            }
            let turned = self.aside.draw_query_menus(ui, seen, &self.field.text);
            let asked = search_symbols::show_symbol_search(ui, seen, &mut self.symbols);
            if let Some(query) = turned.or(asked) {
                self.turn_to_query(query, seen.out);
            }
        });
    }

    /// Draws the number of results, and the switches for their form.
    fn draw_search_status(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let mut counted = self.is_showing_facets(ui);
        ui.horizontal_wrapped(|ui| {
            if let Some(running) = self.asked.filter(|id| seen.is_running(Some(*id))) {
                ui.spinner();
                ui.label(seen.say_text(words::SEARCHING));
                if let Some(far) = seen.work_progress(running).filter(|far| far.done > 0) {
                    ui.weak(fill_text_braces(seen.say_text(words::LOOKED_AT), &[("n", &far.done)]));
                }
                if ui.button(seen.say_text(words::STOP)).clicked() {
                    seen.send_command(WindowCommand::Stop(running));
                }
            } else if self.stopped {
                ui.strong(seen.say_text(words::STOPPED));
                if ui.button(seen.say_text(words::SEARCH_AGAIN)).clicked() {
                    self.search_present_text(seen.out);
                }
            } else if let Some(found) = &self.found {
                ui.strong(fill_text_braces(seen.say_text(words::FOUND), &[("n", &found.total)]));
            }
            for (view, name) in [(ResultsView::Grid, words::GRID), (ResultsView::Table, words::TABLE)] {
                if ui
                    .selectable_label(self.view == view, seen.say_text(name))
                    .on_hover_text(seen.keys.action_keys_text(Action::SearchView))
                    .clicked()
                {
                    self.view = view;
                }
            }
            let room = ui.available_size_before_wrap().x;
            let is_order_beside = room > ORDER_WIDTH_POINTS;
            if is_order_beside {
                self.choose_order(ui, seen);
            }
            if room > FULL_SWITCHES_WIDTH_POINTS {
                self.form_switches(ui, seen, &mut counted);
            } else {
                // A second line would take its height from the results.
                ui.menu_button(seen.say_text(words::DISPLAY), |ui| {
                    if !is_order_beside {
                        self.choose_order(ui, seen);
                    }
                    self.form_switches(ui, seen, &mut counted);
                });
            }
        });
    }

    fn choose_order(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if let Some(sort) = search_order::show_order_menu(ui, seen, &self.sort, &mut self.descending) {
            self.sort_by(sort, seen.out);
        }
    }

    /// Draws the switches for the form of the results.
    fn form_switches(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, counted: &mut bool) {
        if self.view == ResultsView::Grid {
            ui.checkbox(&mut self.playing, seen.say_text(words::LOOPING));
            ui.checkbox(&mut self.close, seen.say_text(words::CLOSE_UP));
        }
        let facets = ui.checkbox(counted, seen.say_text(words::FACETS));
        if facets.on_hover_text(seen.say_text(words::FACETS_TIP)).changed() {
            self.counted = Some(*counted);
        }
    }

    /// Returns whether facets are shown: by default beside the results if there is room, above them only on request.
    fn is_showing_facets(&self, ui: &Ui) -> bool {
        self.counted
            .unwrap_or(ui.available_width() > FACETS_BESIDE_WIDTH_POINTS)
    }

    fn draw_search_answer(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let Some(found) = &self.found else { return };
        for note in &found.notes {
            ui.label(
                RichText::new(translate_library_message(note, seen.language))
                    .small()
                    .weak(),
            );
        }
        if let Some(query) = side_column::show_answer_findings(ui, seen, found, &self.query) {
            return self.turn_to_query(query, seen.out);
        }
        if found.total == 0 {
            if let Some(query) = self.aside.report_empty_results(ui, seen, &self.query) {
                self.turn_to_query(query, seen.out);
            }
            return;
        }
        if !self.is_showing_facets(ui) {
            return results::show_search_results(self, ui, seen);
        }
        let wide = ui.available_width() > FACETS_BESIDE_WIDTH_POINTS;
        self.counted_attribute.request_attribute_counts(&self.query, seen.out);
        let facets = found.facets.clone();
        let query = self.field.text.clone();
        let mut wanted = self.cross_table.show_cross_table(ui, seen, &self.query);
        if wide {
            let room = ui.available_size();
            ui.horizontal_top(|ui| {
                let side = (room.x * 0.28).clamp(150.0, 220.0);
                ui.allocate_ui(vec2(room.x - side - 10.0, room.y), |ui| {
                    ui.set_width(room.x - side - 10.0);
                    ui.vertical(|ui| results::show_search_results(self, ui, seen));
                });
                ui.vertical(|ui| {
                    self.show_count_menu(ui, seen);
                    let (conditions, high) = (&mut self.conditions, ui.available_height());
                    let facet = panes_search_facets::show_search_facets(ui, seen, &facets, &query, conditions, high);
                    wanted = wanted.take().or(facet);
                });
            });
        } else {
            let high = (ui.available_height() * 0.35).min(150.0);
            ui.allocate_ui(vec2(ui.available_width(), high), |ui| {
                self.show_count_menu(ui, seen);
                let conditions = &mut self.conditions;
                let facet = panes_search_facets::show_search_facets(ui, seen, &facets, &query, conditions, high);
                wanted = wanted.take().or(facet);
            });
            results::show_search_results(self, ui, seen);
        }
        if let Some(query) = wanted {
            self.turn_to_query(query, seen.out);
        }
    }
}
