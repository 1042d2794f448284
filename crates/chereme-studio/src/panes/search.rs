//! The search: a query, what answers it, and how often each value occurs.

use std::collections::BTreeMap;

use chereme_corpus::{Answer, Hit, SearchOptions};
use chereme_motion::{Instant, Span};
use chereme_sign::Component;
use eframe::egui::{Grid, Key, RichText, ScrollArea, TextEdit, Ui};

use super::timeline::data::time_text;
use super::{Pane, list_row};
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::pickers::{self, Picker};
use crate::words::{fill, search as words};
use crate::work::{Ended, Outcome, Work, WorkId};

/// How many hits are shown at most.
const SHOWN: usize = 500;

/// A hit as the list shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) gloss: String,
    /// Where it is.
    pub(crate) place: String,
    /// The recording's name and the span, where it was recorded.
    pub(crate) at: Option<(String, Span)>,
}

/// Returns the hits as rows; `lexicon` is what an entry without movement is called.
pub(crate) fn rows(hits: &[Hit], lexicon: &str) -> Vec<Row> {
    let row = |hit: &Hit| {
        let span = hit.start_us.zip(hit.end_us).map(|(start, end)| {
            Span::between(Instant::from_micros(start), Instant::from_micros(end))
        });
        let at = hit.recording.clone().zip(span);
        let place = match &at {
            Some((name, span)) => format!("{name} · {}", time_text(span.start())),
            None => lexicon.to_owned(),
        };
        Row {
            gloss: hit.gloss.clone(),
            place,
            at,
        }
    };
    hits.iter().map(row).collect()
}

/// Returns the query that wants `value` of `field` too.
pub(crate) fn with_value(query: &str, field: &str, value: &str) -> String {
    let quoted = if value.contains(char::is_whitespace) {
        format!("\"{value}\"")
    } else {
        value.to_owned()
    };
    format!("{} {field}={quoted}", query.trim())
        .trim()
        .to_owned()
}

/// The pane.
#[derive(Default)]
pub(crate) struct Search {
    query: String,
    asked: Option<WorkId>,
    answer: Option<Answer>,
    /// What is wrong with the query.
    wrong: Option<String>,
    come: bool,
    /// By component, what its value is picked with.
    pickers: BTreeMap<String, Picker>,
}

impl Search {
    /// Finds what this query asks for.
    pub(crate) fn find(&mut self, query: String, out: &mut Outbox) {
        self.query = query;
        self.ask(out);
    }

    fn ask(&mut self, out: &mut Outbox) {
        if let Some(old) = self.asked.take() {
            out.send(Command::Stop(old));
        }
        let options = SearchOptions {
            limit: Some(SHOWN),
            ..SearchOptions::default()
        };
        self.asked = Some(out.work(Work::Search(self.query.clone(), options)));
    }

    /// Offers to want a value that is picked by looking.
    fn pick(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let mut wanted = None;
        Grid::new("values to pick").num_columns(2).show(ui, |ui| {
            for stored in &seen.snapshot.overview.inventories {
                let inventory = &stored.inventory;
                let drawn = pickers::data::kind(inventory) != pickers::data::Kind::Names;
                if !drawn || inventory.component == Component::NonManual {
                    continue;
                }
                let field = inventory.field().to_string();
                let picker = self.pickers.entry(inventory.id.clone()).or_default();
                let name = fill(seen.say(words::PICK), &[("field", &field)]);
                ui.label(RichText::new(&field).small());
                let picked = pickers::button(ui, picker, seen, inventory, None, &name);
                if let Some(value) = picked {
                    wanted = Some(with_value(&self.query, &field, &value));
                }
                ui.end_row();
            }
        });
        if let Some(query) = wanted {
            self.query = query;
            self.ask(out);
        }
    }

    fn facets(&mut self, ui: &mut Ui, out: &mut Outbox) {
        let Some(answer) = &self.answer else { return };
        let mut wanted = None;
        for (field, values) in &answer.facets {
            ui.collapsing(field.as_str(), |ui| {
                for (value, count) in values {
                    if ui.link(format!("{value} ({count})")).clicked() {
                        wanted = Some(with_value(&self.query, field, value));
                    }
                }
            });
        }
        if let Some(query) = wanted {
            self.query = query;
            self.ask(out);
        }
    }
}

impl Pane for Search {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        let label = ui.label(RichText::new(seen.say(words::QUERY)).small());
        let field = TextEdit::singleline(&mut self.query)
            .hint_text(seen.say(words::HINT))
            .desired_width(f32::INFINITY);
        let response = ui.add(field).labelled_by(label.id);
        if std::mem::take(&mut self.come) {
            response.request_focus();
        }
        let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let pressed = ui.horizontal(|ui| {
            let pressed = ui.button(seen.say(words::RUN)).clicked();
            if seen.is_running(self.asked) {
                ui.spinner();
            } else if let Some(answer) = &self.answer {
                ui.label(fill(seen.say(words::FOUND), &[("n", &answer.total)]));
            }
            pressed
        });
        if entered || pressed.inner {
            self.ask(out);
        }
        if let Some(wrong) = &self.wrong {
            ui.label(
                RichText::new(wrong)
                    .monospace()
                    .color(seen.colours().trouble),
            );
        }
        self.pick(ui, seen, out);
        let Some(answer) = &self.answer else { return };
        if answer.total == 0 {
            ui.label(seen.say(words::NOTHING));
            return;
        }
        let rows = rows(&answer.hits, seen.say(words::LEXICON));
        let height = ui.spacing().interact_size.y * 1.7;
        let list = ui.available_height() * 0.6;
        ScrollArea::vertical()
            .id_salt("hits")
            .max_height(list)
            .auto_shrink(false)
            .show_rows(ui, height, rows.len(), |ui, range| {
                for (at, row) in rows.iter().enumerate().take(range.end).skip(range.start) {
                    ui.push_id(at, |ui| {
                        if list_row(ui, height, false, &row.gloss, &row.place).clicked() {
                            open(row, seen, out);
                        }
                    });
                }
            });
        ui.separator();
        ui.strong(seen.say(words::FACETS));
        ScrollArea::vertical()
            .id_salt("facets")
            .auto_shrink(false)
            .show(ui, |ui| self.facets(ui, out));
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.asked != Some(id) {
            return;
        }
        self.wrong = None;
        match ended {
            Ok(Outcome::Found(answer)) => self.answer = Some(answer.clone()),
            Err(error) => self.wrong = Some(error.to_string()),
            _ => {}
        }
    }

    fn come(&mut self) {
        self.come = true;
    }
}

/// Opens a hit at its place.
fn open(row: &Row, seen: &Seen<'_>, out: &mut Outbox) {
    if let Some((name, span)) = &row.at
        && let Some(recording) = seen.snapshot.recording_named(name)
    {
        out.send(Command::Place(recording.row.id, *span));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_added_to_the_query() {
        assert_eq!(with_value("", "placement", "chin"), "placement=chin");
        assert_eq!(
            with_value("gloss:BO* ", "right.placement", "neutral space"),
            "gloss:BO* right.placement=\"neutral space\""
        );
    }

    #[test]
    fn hits_say_where_they_are() {
        let mut hit = Hit {
            token: 1,
            gloss: "BOL".into(),
            recording: Some("Un".into()),
            start_us: Some(1_250_000),
            end_us: Some(2_000_000),
            origin: "captured".into(),
            score: None,
            components: Default::default(),
        };
        assert_eq!(rows(&[hit.clone()], "lexicon")[0].place, "Un · 0:01.250");
        (hit.recording, hit.start_us) = (None, None);
        let row = &rows(&[hit], "lexicon")[0];
        assert_eq!((row.place.as_str(), &row.at), ("lexicon", &None));
    }
}
