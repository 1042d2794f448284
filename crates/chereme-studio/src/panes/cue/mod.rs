//! Cued speech: a text, its phones and keys with corrections, the cuer on the stage, practice, and slips of a take.

mod data;

use std::sync::Arc;

use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{CueSlips, Recombination, cue_recipe};
use chereme_motion::Instant;
use chereme_sign::cue::codes;
use eframe::egui::{
    Button, CollapsingHeader, DragValue, Response, RichText, Role, ScrollArea, Ui, WidgetInfo,
};

use super::{Pane, combo};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::generated::GeneratedClip;
use crate::script::edit;
use crate::words::{Text, cue as words, fill, spoken};
use crate::work::{Ended, Outcome, WorkId, analysis, recombining};
use data::{Choices, Corrections, Exercise, Reading, key_name};

/// Time without changes, in seconds, after which a text is shown on the stage.
const SETTLES: f64 = 0.5;

/// The pane.
#[derive(Default)]
pub(crate) struct CuePane {
    text: String,
    choices: Choices,
    corrections: Corrections,
    /// The last analysed text with its settings, and the analysis.
    read: Option<(String, Choices, Corrections, Arc<Reading>)>,
    /// The time of the last change, in seconds of the window's clock.
    changed: f64,
    /// Whether to show a settled text on the stage automatically.
    shows: bool,
    making: Option<WorkId>,
    /// The recipe of the movement that is shown or being generated.
    of: String,
    made: Option<Arc<Recombination>>,
    /// Whether that movement is a word to guess, which the window must not name.
    hidden: bool,
    /// The movement as it was given to the stage.
    given: Option<Arc<GeneratedClip>>,
    wrong: Option<String>,
    /// The index of the word whose phones are being changed, and the typed phones.
    editing: Option<(usize, String)>,
    gloss: String,
    storing: Option<WorkId>,
    stored: Option<String>,
    exercise: Option<Exercise>,
    own_words: String,
    speed: Option<f64>,
    comparing: Option<WorkId>,
    slips: Option<CueSlips>,
    slips_wrong: Option<String>,
}

impl CuePane {
    fn reading(&mut self, now: f64) -> Arc<Reading> {
        let same = self
            .read
            .as_ref()
            .is_some_and(|(text, choices, corrections, _)| {
                *text == self.text && *choices == self.choices && *corrections == self.corrections
            });
        if !same {
            let reading = Arc::new(data::read(&self.text, &self.choices, &self.corrections));
            self.changed = now;
            self.read = Some((
                self.text.clone(),
                self.choices.clone(),
                self.corrections.clone(),
                reading,
            ));
        }
        self.read
            .as_ref()
            .map_or_else(Arc::default, |it| Arc::clone(&it.3))
    }

    /// Requests the movement of a reading, unless it is the one that is shown; if `hidden`, the window does not name it.
    fn show(&mut self, reading: &Reading, hidden: bool, out: &mut Outbox) {
        if reading.keys.is_empty() {
            return;
        }
        self.hidden = hidden;
        let recipe = cue_recipe(&reading.input, &self.choices.options(reading), None);
        if self.of == recipe && (self.made.is_some() || self.making.is_some()) {
            self.given = None;
            return;
        }
        self.of.clone_from(&recipe);
        (self.made, self.given, self.wrong) = (None, None, None);
        self.making = Some(out.work(recombining::preview(recipe)));
    }

    fn settings(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal_wrapped(|ui| {
            let french = seen.language == crate::words::Language::French;
            let name = |at: usize| {
                let names = codes().get(at).map(|code| &code.names);
                let own = names.and_then(|names| names.get(if french { "fr" } else { "en" }));
                own.cloned().unwrap_or_default()
            };
            let all: Vec<(usize, String)> = (0..codes().len()).map(|at| (at, name(at))).collect();
            combo::named(ui, seen.say(words::CODE), &mut self.choices.code, &all);
            let rules = PhaseRule::ALL.map(|rule| {
                let name = match rule {
                    PhaseRule::Paper => seen.say(words::BY_PAPER),
                    PhaseRule::Attina => "Attina",
                    PhaseRule::Sppas => "SPPAS",
                    PhaseRule::Duchnowski => "Duchnowski",
                    PhaseRule::Measured => seen.say(words::BY_MEASURED),
                };
                (rule, name.to_owned())
            });
            combo::named(ui, seen.say(words::RULE), &mut self.choices.rule, &rules);
            let label = ui.label(seen.say(words::PACE));
            let field = DragValue::new(&mut self.choices.pace)
                .range(0.5..=4.0)
                .speed(0.02);
            ui.add(field.max_decimals(2).prefix("× "))
                .labelled_by(label.id);
            if self.choices.spells() {
                ui.checkbox(&mut self.choices.liaison, seen.say(words::LIAISON));
                ui.checkbox(&mut self.choices.schwa, seen.say(words::SCHWA));
            }
            ui.checkbox(&mut self.choices.left, seen.say(words::LEFT));
        });
    }

    fn typed(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let hint = if self.choices.spells() {
            words::TEXT_HINT
        } else {
            words::PHONES_HINT
        };
        let label = ui.label(RichText::new(seen.say(words::TEXT)).small());
        let field = edit::block(ui, &mut self.text, |field| {
            field
                .hint_text(seen.say(hint))
                .desired_rows(2)
                .desired_width(f32::INFINITY)
        });
        let response = field.response.response.labelled_by(label.id);
        if response.changed() {
            self.shows = true;
            self.stored = None;
        }
    }

    /// Shows the words with their phones; a click lets the user change the phones of one.
    fn words_of(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, reading: &Reading) {
        ui.label(RichText::new(seen.say(words::WORDS)).small());
        let mut changed = None;
        ui.horizontal_wrapped(|ui| {
            for (at, word) in reading.words.iter().enumerate() {
                if word.text.is_empty() {
                    ui.weak("·");
                    continue;
                }
                let phones = word.phones.join(" ");
                if let Some((_, typed)) = self.editing.as_mut().filter(|(own, _)| *own == at) {
                    let name = fill(seen.say(words::SAID), &[("word", &word.text)]);
                    let field = edit::line(ui, typed, |field| field.desired_width(90.0));
                    let response = field.response.response;
                    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, &name));
                    if response.lost_focus() {
                        let own = typed.split_whitespace().map(str::to_owned).collect();
                        changed = Some((at, word.text.clone(), Some(own)));
                    } else {
                        response.request_focus();
                    }
                    if ui.small_button(seen.say(words::USUAL)).clicked() {
                        changed = Some((at, word.text.clone(), None));
                    }
                    continue;
                }
                let text = RichText::new(format!("{}\n{phones}", word.text));
                let text = if word.corrected { text.strong() } else { text };
                let values: [(&str, &dyn std::fmt::Display); 2] =
                    [("word", &word.text), ("phones", &phones)];
                let name = fill(seen.say(words::WORD), &values);
                let button = ui.add(Button::new(text));
                named(&button, &name);
                if button.on_hover_text(&name).clicked() {
                    self.editing = Some((at, phones));
                }
            }
        });
        if let Some((at, text, phones)) = changed {
            self.editing = None;
            self.shows = true;
            match phones {
                Some(phones) if phones == reading.words[at].phones => {}
                Some(phones) => drop(self.corrections.insert((at, text), phones)),
                None => drop(self.corrections.remove(&(at, text))),
            }
        }
    }

    /// Shows the keys, with a mark on the key at the playhead; a click on one with an uncertain vowel switches the
    /// vowel.
    fn keys(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, reading: &Reading) {
        ui.label(RichText::new(seen.say(words::KEYS)).small());
        let now = self.current(seen);
        let mut toggled = None;
        ui.horizontal_wrapped(|ui| {
            for (at, key) in reading.keys.iter().enumerate() {
                let own = key_name(&key.placement, key.shape, seen.language);
                let mut text = RichText::new(match key.other {
                    Some(_) => format!("{own} ?\n{}", key.phones),
                    None => format!("{own}\n{}", key.phones),
                });
                if now == Some(at) {
                    text = text.strong().color(seen.colours().accent);
                }
                let name = match &key.other {
                    Some((.., place)) => {
                        let other = key_name(place, key.shape, seen.language);
                        let values: [(&str, &dyn std::fmt::Display); 3] =
                            [("key", &own), ("phones", &key.phones), ("other", &other)];
                        fill(seen.say(words::DOUBT), &values)
                    }
                    None => {
                        let values: [(&str, &dyn std::fmt::Display); 2] =
                            [("key", &own), ("phones", &key.phones)];
                        fill(seen.say(words::KEY), &values)
                    }
                };
                let button = ui.add(Button::selectable(now == Some(at), text));
                named(&button, &name);
                if button.on_hover_text(&name).clicked() {
                    match &key.other {
                        Some(other) => toggled = Some(other.clone()),
                        None => self.go_to(at, ui),
                    }
                }
            }
        });
        if let Some((word, at, vowel, _)) = toggled {
            let mut phones = reading.words[word].phones.clone();
            phones[at] = vowel;
            let text = reading.words[word].text.clone();
            self.corrections.insert((word, text), phones);
            self.shows = true;
        }
    }

    /// Returns the spans of the keys in the generated movement.
    fn spans(&self) -> impl Iterator<Item = (i64, i64)> {
        let notes = self.made.iter().flat_map(|made| made.notes.iter());
        let keys = notes.filter(|note| note.feature.as_deref() == Some("Keys"));
        keys.map(|note| (note.start_us, note.end_us))
    }

    fn current(&self, seen: &PaneInput<'_>) -> Option<usize> {
        let showing = seen.shown.made.as_ref()?;
        if self.hidden || !Arc::ptr_eq(&showing.made, self.given.as_ref()?) {
            return None;
        }
        let at = showing.player.playhead().micros();
        self.spans()
            .position(|(start, end)| (start..end).contains(&at))
    }

    fn go_to(&self, key: usize, ui: &Ui) {
        if let Some((start, _)) = self.spans().nth(key) {
            ui.ctx().data_mut(|data| data.insert_temp(seek_id(), start));
        }
    }

    fn cuer(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, reading: &Reading, out: &mut Outbox) {
        ui.horizontal_wrapped(|ui| {
            let ready = !reading.keys.is_empty();
            if ui
                .add_enabled(ready, Button::new(seen.say(words::SHOW)))
                .clicked()
            {
                self.shows = true;
                self.changed = f64::NEG_INFINITY;
                out.send(Command::Look);
            }
            if seen.is_running(self.making) {
                ui.spinner();
                ui.weak(seen.say(words::MAKING));
            }
        });
        if let Some(wrong) = &self.wrong {
            let wrong = spoken(wrong, seen.language);
            ui.label(RichText::new(wrong).color(seen.colours().trouble));
        }
        if let Some(made) = &self.made {
            for warning in &made.report.warnings {
                let warning = spoken(warning, seen.language);
                ui.label(RichText::new(warning).small().color(seen.colours().trouble));
            }
        }
        ui.horizontal(|ui| {
            let field = edit::line(ui, &mut self.gloss, |field| {
                field.hint_text(seen.say(words::GLOSS)).desired_width(160.0)
            });
            let response = field.response.response;
            response
                .widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say(words::GLOSS)));
            let ready = self.made.is_some()
                && !self.gloss.trim().is_empty()
                && !seen.snapshot.is_read_only()
                && !seen.is_running(self.storing);
            if ui
                .add_enabled(ready, Button::new(seen.say(words::STORE)))
                .clicked()
            {
                let gloss = self.gloss.trim().to_owned();
                self.storing = Some(out.work(recombining::store(self.of.clone(), gloss)));
            }
        });
        // After an undo the stored sign does not exist any more.
        let stored = self.stored.as_ref();
        let stored = stored.filter(|name| seen.snapshot.recording_named(name).is_some());
        if let Some(name) = stored {
            let key = seen.keys.text(Action::Export);
            let values: [(&str, &dyn std::fmt::Display); 2] = [("name", name), ("key", &key)];
            ui.weak(fill(seen.say(words::STORED), &values));
        }
    }

    fn practise(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let seed = (ui.input(|input| input.time) * 1e6) as u64;
        let mut begun = None;
        ui.horizontal_wrapped(|ui| {
            ui.label(seen.say(words::KEY_SET));
            for (title, set) in data::key_sets(&self.choices, seen.language) {
                if set.len() > 1 && ui.button(seen.say(title)).clicked() {
                    begun = Some(set);
                }
            }
        });
        ui.label(seen.say(words::SET));
        ui.horizontal_wrapped(|ui| {
            for set in data::sets(&self.choices) {
                let names: Vec<&str> = set.iter().map(|item| item.word.as_str()).collect();
                if ui.button(names.join(", ")).clicked() {
                    begun = Some(set);
                }
            }
        });
        ui.horizontal(|ui| {
            let name = seen.say(words::OWN_SET);
            let field = edit::line(ui, &mut self.own_words, |field| {
                field.hint_text(name).desired_width(200.0)
            });
            let response = field.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
            let own = data::own_set(&self.own_words);
            if ui
                .add_enabled(own.is_some(), Button::new(seen.say(words::PRACTISE)))
                .clicked()
            {
                begun = own;
            }
        });
        let mut cue_now = false;
        if let Some(items) = begun {
            self.exercise = Some(Exercise::of(items, seed));
            cue_now = true;
        }
        let Some(mut exercise) = self.exercise.take() else {
            return;
        };
        ui.separator();
        ui.strong(seen.say(words::WHICH));
        ui.horizontal_wrapped(|ui| {
            for (at, item) in exercise.items.clone().into_iter().enumerate() {
                let chosen = exercise.answered == Some(at);
                if ui.add(Button::selectable(chosen, item.word)).clicked() {
                    exercise.answer(at);
                }
            }
        });
        let word = exercise
            .item()
            .map(|item| item.word.clone())
            .unwrap_or_default();
        match exercise.answered {
            Some(answer) if answer == exercise.now => {
                ui.label(fill(seen.say(words::RIGHT), &[("word", &word)]));
            }
            Some(_) => {
                ui.label(fill(seen.say(words::WRONG), &[("word", &word)]));
            }
            None if exercise.revealed => {
                ui.label(&word);
            }
            None => {}
        }
        ui.horizontal_wrapped(|ui| {
            if ui.button(seen.say(words::NEXT)).clicked() {
                exercise.next();
                cue_now = true;
            }
            cue_now |= ui.button(seen.say(words::AGAIN)).clicked();
            if ui.button(seen.say(words::REVEAL)).clicked() {
                exercise.revealed = true;
            }
            let values: [(&str, &dyn std::fmt::Display); 2] =
                [("right", &exercise.right), ("all", &exercise.all)];
            ui.weak(fill(seen.say(words::SCORE), &values));
        });
        ui.horizontal_wrapped(|ui| {
            let label = ui.label(seen.say(words::SPEED));
            let mut speed = self.speed.unwrap_or(1.0);
            let field = DragValue::new(&mut speed)
                .range(0.25..=2.0)
                .speed(0.01)
                .max_decimals(2)
                .suffix(" ×");
            if ui.add(field).labelled_by(label.id).changed() {
                self.speed = Some(speed);
                out.send(Command::Speed(speed));
            }
            if ui.button(seen.say(words::FROM_SIDE)).clicked() {
                out.send(Command::Do(Action::ViewRight));
            }
            if ui.button(seen.say(words::FROM_FRONT)).clicked() {
                out.send(Command::Do(Action::ViewFront));
            }
        });
        if cue_now && let Some(item) = exercise.item() {
            let reading = data::read(&item.input, &self.choices, &Corrections::new());
            self.shows = false;
            self.show(&reading, true, out);
            out.send(Command::Look);
        }
        self.exercise = Some(exercise);
    }

    fn slips(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        ui.weak(seen.say(words::SLIPS_HINT));
        let recording = seen.shown.recording;
        ui.horizontal(|ui| {
            let ready = recording.is_some() && !seen.is_running(self.comparing);
            let button = ui.add_enabled(ready, Button::new(seen.say(words::COMPARE)));
            let button = button.on_disabled_hover_text(seen.say(words::NEEDS_RECORDING));
            if let Some(recording) = recording.filter(|_| button.clicked()) {
                let code = codes()
                    .get(self.choices.code)
                    .map_or("french", |code| code.id.as_str());
                (self.slips, self.slips_wrong) = (None, None);
                self.comparing = Some(out.work(analysis::cue_slips(recording, code.to_owned())));
            }
            if seen.is_running(self.comparing) {
                ui.spinner();
            }
        });
        if let Some(wrong) = &self.slips_wrong {
            let wrong = spoken(wrong, seen.language);
            ui.label(RichText::new(wrong).color(seen.colours().trouble));
        }
        let Some(found) = &self.slips else { return };
        let values: [(&str, &dyn std::fmt::Display); 2] =
            [("right", &found.right), ("all", &found.predicted)];
        ui.label(fill(seen.say(words::SLIPS_FOUND), &values));
        for slip in &found.slips {
            let (text, at) = data::slip(slip, seen.language);
            if ui.link(text).clicked()
                && let Some(at) = at
            {
                out.seek(Instant::from_micros(at));
            }
        }
    }
}

/// Gives a button with several lines one name for assistive technology and tests.
fn named(button: &Response, name: &str) {
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
}

/// Returns the key under which the time of a clicked key waits for the end of the frame.
fn seek_id() -> eframe::egui::Id {
    eframe::egui::Id::unique("cue-seek")
}

/// Shows a foldable part of the pane.
fn part(ui: &mut Ui, seen: &PaneInput<'_>, title: Text, show: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(seen.say(title))
        .id_salt(title.en)
        .show(ui, show);
}

impl Pane for CuePane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let now = ui.input(|input| input.time);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            self.typed(ui, seen);
            self.settings(ui, seen);
            let reading = self.reading(now);
            if !reading.keys.is_empty() {
                if self.choices.spells() {
                    self.words_of(ui, seen, &reading);
                }
                self.keys(ui, seen, &reading);
            }
            for finding in &reading.findings {
                ui.label(
                    RichText::new(crate::words::spoken(finding, seen.language))
                        .small()
                        .weak(),
                );
            }
            ui.separator();
            self.cuer(ui, seen, &reading, out);
            part(ui, seen, words::PRACTISE, |ui| self.practise(ui, seen, out));
            part(ui, seen, words::SLIPS, |ui| self.slips(ui, seen, out));
            // The newest text is shown once it has settled.
            let reading = self.reading(now);
            let rest = self.changed + SETTLES - now;
            if self.shows && rest > 0.0 {
                ui.ctx()
                    .request_repaint_after(std::time::Duration::from_secs_f64(rest));
            } else if self.shows && !seen.is_running(self.making) {
                self.shows = false;
                self.show(&reading, false, out);
            }
        });
        if let Some(at) = ui.ctx().data_mut(|data| data.remove_temp::<i64>(seek_id())) {
            out.send(Command::Cue(Instant::from_micros(at)));
        }
        if let Some(made) = self.made.as_ref().filter(|_| self.given.is_none()) {
            let made = Arc::new(match self.hidden {
                true => GeneratedClip {
                    name: seen.say(words::HIDDEN).to_owned(),
                    parts: Vec::new(),
                    ..GeneratedClip::of(made)
                },
                false => GeneratedClip::of(made),
            });
            self.given = Some(Arc::clone(&made));
            out.send(Command::Made(Some(made)));
            if let Some(speed) = self.speed {
                out.send(Command::Speed(speed));
            }
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.making.take_if(|own| *own == id).is_some() {
            match ended {
                Ok(Outcome::Previewed(made)) => self.made = Some(Arc::clone(made)),
                Err(error) => self.wrong = Some(error.to_string()),
                Ok(_) => {}
            }
        }
        if self.storing.take_if(|own| *own == id).is_some()
            && let Ok(Outcome::Recombined(made)) = ended
        {
            self.stored.clone_from(&made.name);
        }
        if self.comparing.take_if(|own| *own == id).is_some() {
            match ended {
                Ok(Outcome::CueSlips(found)) => self.slips = Some(CueSlips::clone(found)),
                Err(error) => self.slips_wrong = Some(error.to_string()),
                Ok(_) => {}
            }
        }
    }
}
