//! The page: the query, the number of results and their form, the results, and facets.

use chereme_corpus::meant;
use chereme_sign::query::Query;
use eframe::egui::{RichText, Ui, vec2};

use super::{PAUSE, Search, View, facets, results, rows, side_column, suggest, symbols};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::overlay::remedy;
use crate::words::{Language, fill, search as words, spoken};

/// A pane wider than this, in points, has room for facets beside its results.
const WIDE: f32 = 520.0;
/// If this much of the line is left, in points, all switches fit beside the number of results.
const SPACIOUS: f32 = 340.0;

impl Search {
    /// Draws the page, with the results `high` points high.
    pub(super) fn page(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, high: f32) {
        let top = ui.cursor().top();
        self.question(ui, seen, out);
        self.head = ui.cursor().top() - top + ui.spacing().interact_size.y;
        if self.field.text.trim().is_empty() {
            if let Some(query) = self.tiles.show(ui, seen, out) {
                self.turn_to(query, out);
            }
            // The wall of all signs is shown below.
            if self.found.is_none() && self.asked.is_none() && self.wrong.is_none() && !self.stopped
            {
                self.ask(out);
            }
        } else if self.found.is_none() && self.asked.is_none() {
            return;
        }
        self.status(ui, seen, out);
        self.head = ui.cursor().top() - top;
        let size = vec2(ui.available_width(), high);
        ui.allocate_ui(size, |ui| {
            ui.set_width(size.x);
            ui.set_max_height(size.y);
            self.hint(ui, seen, out);
            self.answer(ui, seen, out);
        });
    }

    /// Draws the query: its text, its rows, and the buttons for it.
    fn question(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let now = ui.input(|input| input.time);
        let wrong = self.wrong.as_ref().and_then(|wrong| wrong.from);
        let wrong = wrong.filter(|_| self.query == self.field.text);
        if std::mem::take(&mut self.come) {
            self.field.take_focus();
        }
        let typed = self.field.ui(ui, seen, wrong);
        if typed.changed {
            self.changed = Some(now);
            self.rows = rows::Rows::default();
        }
        if typed.entered {
            if let Some(query) = suggest::kept_query(&self.field.text, seen.snapshot) {
                self.field.set(query.to_owned());
                self.rows = rows::Rows::default();
            } else if let Some(query) = meant(&self.field.text, &seen.snapshot.overview.inventories)
            {
                self.field.set(query);
                self.rows = rows::Rows::default();
            }
            self.field.take_focus();
            // Entering a text hides the rows if there is not enough room for them and the results.
            self.built &= !self.low;
            self.aside.remember(&self.field.text, seen, out);
            self.ask(out);
        }
        if typed.down && self.found.as_ref().is_some_and(|found| found.total > 0) {
            self.reach(self.at);
        }
        // The field itself reports text that is not a valid query.
        let text = &self.field.text;
        let faulty = Query::parse(text).is_err() || suggest::is_unkept(text, seen.snapshot);
        if let Some(wrong) = self
            .wrong
            .as_ref()
            .filter(|_| self.query == self.field.text && !faulty)
        {
            let trouble = seen.colours().trouble;
            let said = spoken(&wrong.error, seen.language);
            if seen.language != Language::English && said == wrong.error {
                ui.label(seen.say(crate::words::trouble::QUERY_WRONG));
            }
            ui.label(RichText::new(said).small().color(trouble));
            let remedy = wrong.remedy.as_ref();
            if let Some(remedy) = remedy.and_then(|it| remedy::here(it, seen.language)) {
                ui.label(RichText::new(remedy).small());
            }
            let mended = wrong.mended.clone();
            if let Some((meant, query)) = mended {
                let text = fill(seen.say(words::MEND), &[("text", &meant)]);
                if ui.small_button(text).clicked() {
                    self.turn_to(query, out);
                }
            }
        }
        self.tools(ui, seen, out);
        self.examples.follow(&self.field.text, seen, out);
        let with = (&self.examples, &mut *out);
        if self.built && rows::show(ui, &mut self.rows, seen, &mut self.field.text, with) {
            self.ask(out);
        }
        for picker in self.rows.pickers.values_mut() {
            picker.inspect(seen, out);
        }
        let settled = self.changed.is_some_and(|when| now - when >= PAUSE);
        let error = Query::parse(&self.field.text).err();
        let end = self.field.text.trim_end().chars().count();
        if settled && !typed.unfinished && error.is_none() {
            self.ask(out);
        } else if settled && error.is_some_and(|error| error.at.start < end) {
            // The old answer does not belong to the new query.
            (self.found, self.changed) = (None, None);
        } else if self.changed.is_some() {
            ui.ctx().request_repaint_after_secs(PAUSE as f32);
        }
    }

    fn tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        ui.horizontal_wrapped(|ui| {
            if ui.available_width() < WIDE {
                // In a narrow pane the buttons are narrower, so that all of them fit into one line.
                ui.spacing_mut().item_spacing.x = 3.0;
                ui.spacing_mut().button_padding.x = 5.0;
            }
            let rows = ui.selectable_label(self.built, seen.say(words::ROWS));
            if rows.clicked() {
                self.built = !self.built;
            }
            let turned = self.aside.menus(ui, seen, out, &self.field.text);
            let asked = symbols::show(ui, seen, &mut self.symbols);
            if let Some(query) = turned.or(asked) {
                self.turn_to(query, out);
            }
        });
    }

    /// Draws the number of results, and the switches for their form.
    fn status(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let mut counted = self.counts(ui);
        ui.horizontal_wrapped(|ui| {
            if let Some(running) = self.asked.filter(|id| seen.is_running(Some(*id))) {
                ui.spinner();
                ui.label(seen.say(words::SEARCHING));
                if let Some(far) = seen.far(running).filter(|far| far.done > 0) {
                    ui.weak(fill(seen.say(words::LOOKED_AT), &[("n", &far.done)]));
                }
                if ui.button(seen.say(words::STOP)).clicked() {
                    out.send(Command::Stop(running));
                }
            } else if self.stopped {
                ui.strong(seen.say(words::STOPPED));
                if ui.button(seen.say(words::SEARCH_AGAIN)).clicked() {
                    self.ask(out);
                }
            } else if let Some(found) = &self.found {
                ui.strong(fill(seen.say(words::FOUND), &[("n", &found.total)]));
            }
            for (view, name) in [(View::Grid, words::GRID), (View::Table, words::TABLE)] {
                if ui
                    .selectable_label(self.view == view, seen.say(name))
                    .on_hover_text(seen.keys.text(Action::SearchView))
                    .clicked()
                {
                    self.view = view;
                }
            }
            let wide = ui.available_size_before_wrap().x > SPACIOUS;
            if wide {
                self.form_switches(ui, seen, &mut counted);
            } else {
                // A second line would take its height from the results.
                ui.menu_button(seen.say(words::DISPLAY), |ui| {
                    self.form_switches(ui, seen, &mut counted)
                });
            }
        });
    }

    /// Draws the switches for the form of the results.
    fn form_switches(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, counted: &mut bool) {
        if self.view == View::Grid {
            ui.checkbox(&mut self.playing, seen.say(words::LOOPING));
            ui.checkbox(&mut self.close, seen.say(words::CLOSE_UP));
        }
        let facets = ui.checkbox(counted, seen.say(words::FACETS));
        if facets.on_hover_text(seen.say(words::FACETS_TIP)).changed() {
            self.counted = Some(*counted);
        }
    }

    /// Returns whether facets are shown: by default beside the results if there is room, above them only on request.
    fn counts(&self, ui: &Ui) -> bool {
        self.counted.unwrap_or(ui.available_width() > WIDE)
    }

    fn answer(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some(found) = &self.found else { return };
        for note in &found.notes {
            ui.label(RichText::new(spoken(note, seen.language)).small().weak());
        }
        if let Some(query) = side_column::findings(ui, seen, found, &self.query) {
            return self.turn_to(query, out);
        }
        if found.total == 0 {
            if let Some(query) = self.aside.nothing(ui, seen, out, &self.query) {
                self.turn_to(query, out);
            }
            return;
        }
        if !self.counts(ui) {
            return results::show(self, ui, seen, out);
        }
        let wide = ui.available_width() > WIDE;
        let facets = found.facets.clone();
        let query = self.field.text.clone();
        let mut wanted = None;
        if wide {
            let room = ui.available_size();
            ui.horizontal_top(|ui| {
                let side = (room.x * 0.28).clamp(150.0, 220.0);
                ui.allocate_ui(vec2(room.x - side - 10.0, room.y), |ui| {
                    ui.set_width(room.x - side - 10.0);
                    ui.vertical(|ui| results::show(self, ui, seen, out));
                });
                let of = (query.as_str(), &mut self.conditions);
                ui.vertical(|ui| wanted = facets::show(ui, seen, &facets, of, room.y, out));
            });
        } else {
            let high = (ui.available_height() * 0.35).min(150.0);
            ui.allocate_ui(vec2(ui.available_width(), high), |ui| {
                let of = (query.as_str(), &mut self.conditions);
                wanted = facets::show(ui, seen, &facets, of, high, out);
            });
            results::show(self, ui, seen, out);
        }
        if let Some(query) = wanted {
            self.turn_to(query, out);
        }
    }
}
