//! Cued speech: a text, its phones and keys with corrections, the cuer on the stage, practice, and slips of a take.

mod cue_data;

use std::sync::Arc;

use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{CueSlips, RecombinationResult, cue_recipe};
use chereme_motion::RecordingInstant;
use chereme_sign::cue::all_cue_codes;
use eframe::egui::{Button, CollapsingHeader, DragValue, Response, RichText, Role, ScrollArea, Ui, WidgetInfo};

use super::{PaneInterface, combo};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::model::generated::GeneratedClip;
use crate::script::script_edit;
use crate::words::{InterfaceText, cue_words as words, fill_text_braces, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, analysis, recombining};
use cue_data::{CueChoices, CueExercise, CuedReading, PhoneCorrections, PracticeItem, translated_cue_key_name};

/// Time without changes, in seconds, after which a text is shown on the stage.
const CUE_SETTLE_SECONDS: f64 = 0.5;

/// The pane.
#[derive(Default)]
pub(crate) struct CuePane {
    text: String,
    choices: CueChoices,
    corrections: PhoneCorrections,
    /// The last analysed text with its settings, and the analysis.
    read: Option<(String, CueChoices, PhoneCorrections, Arc<CuedReading>)>,
    /// The time of the last change, in seconds of the window's clock.
    changed: f64,
    /// Whether to show a settled text on the stage automatically.
    shows: bool,
    making: Option<WorkId>,
    /// The recipe of the movement that is shown or being generated.
    of: String,
    made: Option<Arc<RecombinationResult>>,
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
    exercise: Option<CueExercise>,
    own_words: String,
    speed: Option<f64>,
    comparing: Option<WorkId>,
    slips: Option<CueSlips>,
    slips_wrong: Option<String>,
}

impl CuePane {
    fn current_cued_reading(&mut self, now: f64) -> Arc<CuedReading> {
        let same = self.read.as_ref().is_some_and(|(text, choices, corrections, _)| {
            *text == self.text && *choices == self.choices && *corrections == self.corrections
        });
        if !same {
            let reading = Arc::new(cue_data::read_cued_text(&self.text, &self.choices, &self.corrections));
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
            .map_or_else(Arc::default, |cached| Arc::clone(&cached.3))
    }

    /// Requests the movement of a reading, unless it is the one that is shown; if `hidden`, the window does not name it.
    fn show_cued_movement(&mut self, reading: &CuedReading, hidden: bool, out: &CommandOutbox) {
        if reading.keys.is_empty() {
            return;
        }
        self.hidden = hidden;
        let recipe = cue_recipe(&reading.input, &self.choices.cue_options_for(reading), None);
        if self.of == recipe && (self.made.is_some() || self.making.is_some()) {
            self.given = None;
            return;
        }
        self.of.clone_from(&recipe);
        (self.made, self.given, self.wrong) = (None, None, None);
        self.making = Some(out.request_work(recombining::preview_recipe_job(recipe)));
    }

    fn show_cueing_settings(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal_wrapped(|ui| {
            let french = seen.language == crate::words::InterfaceLanguage::French;
            let name = |at: usize| {
                let names = all_cue_codes().get(at).map(|code| &code.names);
                let language_name = names.and_then(|names| names.get(if french { "fr" } else { "en" }));
                language_name.cloned().unwrap_or_default()
            };
            let all: Vec<(usize, String)> = (0..all_cue_codes().len()).map(|at| (at, name(at))).collect();
            combo::show_named_combo(ui, seen.say_text(words::CODE), &mut self.choices.code, &all);
            let rules = PhaseRule::ALL_PHASE_RULES.map(|rule| {
                let name = match rule {
                    PhaseRule::Paper => seen.say_text(words::BY_PAPER),
                    PhaseRule::Attina => "Attina",
                    PhaseRule::Sppas => "SPPAS",
                    PhaseRule::Duchnowski => "Duchnowski",
                    PhaseRule::Measured => seen.say_text(words::BY_MEASURED),
                };
                (rule, name.to_owned())
            });
            combo::show_named_combo(ui, seen.say_text(words::RULE), &mut self.choices.rule, &rules);
            let label = ui.label(seen.say_text(words::PACE));
            let field = DragValue::new(&mut self.choices.pace).range(0.5..=4.0).speed(0.02);
            ui.add(field.max_decimals(2).prefix("× ")).labelled_by(label.id);
            if self.choices.has_spelling_rules() {
                ui.checkbox(&mut self.choices.liaison, seen.say_text(words::LIAISON));
                ui.checkbox(&mut self.choices.schwa, seen.say_text(words::SCHWA));
            }
            ui.checkbox(&mut self.choices.left, seen.say_text(words::LEFT));
        });
    }

    fn show_typed_cue_text(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let hint = if self.choices.has_spelling_rules() {
            words::TEXT_HINT
        } else {
            words::PHONES_HINT
        };
        let label = ui.label(RichText::new(seen.say_text(words::TEXT)).small());
        let field = script_edit::draw_text_block(ui, &mut self.text, |field| {
            field
                .hint_text(seen.say_text(hint))
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
    fn words_of(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, reading: &CuedReading) {
        ui.label(RichText::new(seen.say_text(words::WORDS)).small());
        let mut changed = None;
        ui.horizontal_wrapped(|ui| {
            for (at, word) in reading.words.iter().enumerate() {
                if word.text.is_empty() {
                    ui.weak("·");
                    continue;
                }
                let phones = word.phones.join(" ");
                if let Some((_, typed)) = self.editing.as_mut().filter(|(own, _)| *own == at) {
                    let name = fill_text_braces(seen.say_text(words::SAID), &[("word", &word.text)]);
                    let field = script_edit::draw_text_line(ui, typed, |field| field.desired_width(90.0));
                    let response = field.response.response;
                    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, &name));
                    if response.lost_focus() {
                        let typed_phones = typed.split_whitespace().map(str::to_owned).collect();
                        changed = Some((at, word.text.clone(), Some(typed_phones)));
                    } else {
                        response.request_focus();
                    }
                    if ui.small_button(seen.say_text(words::USUAL)).clicked() {
                        changed = Some((at, word.text.clone(), None));
                    }
                    continue;
                }
                let plain_text = RichText::new(format!("{}\n{phones}", word.text));
                let text = if word.corrected {
                    plain_text.strong()
                } else {
                    plain_text
                };
                let values: [(&str, &dyn std::fmt::Display); 2] = [("word", &word.text), ("phones", &phones)];
                let name = fill_text_braces(seen.say_text(words::WORD), &values);
                let button = ui.add(Button::new(text));
                name_cue_button(&button, &name);
                if button.on_hover_text(&name).clicked() {
                    self.editing = Some((at, phones));
                }
            }
        });
        if let Some((at, text, phones)) = changed {
            self.editing = None;
            self.shows = true;
            match phones {
                // A word that was only looked at is no correction.
                Some(phones) if phones == reading.words[at].phones => {}
                Some(phones) => drop(self.corrections.insert((at, text), phones)),
                None => drop(self.corrections.remove(&(at, text))),
            }
        }
    }

    /// Shows the keys, with a mark on the key at the playhead; a click on one with an uncertain vowel switches the
    /// vowel.
    fn show_cue_keys(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, reading: &CuedReading) {
        ui.label(RichText::new(seen.say_text(words::KEYS)).small());
        let now = self.current(seen);
        let mut toggled = None;
        ui.horizontal_wrapped(|ui| {
            for (at, key) in reading.keys.iter().enumerate() {
                let key_label = translated_cue_key_name(&key.placement, key.shape, seen.language);
                let mut text = RichText::new(match key.other {
                    Some(_) => format!("{key_label} ?\n{}", key.phones),
                    None => format!("{key_label}\n{}", key.phones),
                });
                if now == Some(at) {
                    text = text.strong().color(seen.pane_colours().accent);
                }
                let name = match &key.other {
                    Some((.., place)) => {
                        let other = translated_cue_key_name(place, key.shape, seen.language);
                        let values: [(&str, &dyn std::fmt::Display); 3] =
                            [("key", &key_label), ("phones", &key.phones), ("other", &other)];
                        fill_text_braces(seen.say_text(words::DOUBT), &values)
                    }
                    None => {
                        let values: [(&str, &dyn std::fmt::Display); 2] =
                            [("key", &key_label), ("phones", &key.phones)];
                        fill_text_braces(seen.say_text(words::KEY), &values)
                    }
                };
                let button = ui.add(Button::selectable(now == Some(at), text));
                name_cue_button(&button, &name);
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
    fn cue_key_spans(&self) -> impl Iterator<Item = (i64, i64)> {
        let notes = self.made.iter().flat_map(|made| made.notes.iter());
        let keys = notes.filter(|note| note.feature.as_deref() == Some("Keys"));
        keys.map(|note| (note.start_us, note.end_us))
    }

    fn current(&self, seen: &PaneInput<'_>) -> Option<usize> {
        let showing = seen.shown.made.as_ref()?;
        if self.hidden || !Arc::ptr_eq(&showing.made, self.given.as_ref()?) {
            return None;
        }
        let playhead_micros = showing.player.player_playhead().instant_micros();
        self.cue_key_spans()
            .position(|(start, end)| (start..end).contains(&playhead_micros))
    }

    fn go_to(&self, key: usize, ui: &Ui) {
        if let Some((start, _)) = self.cue_key_spans().nth(key) {
            ui.ctx().data_mut(|data| data.insert_temp(seek_id(), start));
        }
    }

    fn cuer(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, reading: &CuedReading) {
        ui.horizontal_wrapped(|ui| {
            let ready = !reading.keys.is_empty();
            if ui.add_enabled(ready, Button::new(seen.say_text(words::SHOW))).clicked() {
                self.shows = true;
                self.changed = f64::NEG_INFINITY;
                seen.send_command(WindowCommand::Look);
            }
            if seen.is_running(self.making) {
                ui.spinner();
                ui.weak(seen.say_text(words::MAKING));
            }
        });
        if let Some(wrong) = &self.wrong {
            let wrong = translate_library_message(wrong, seen.language);
            ui.label(RichText::new(wrong).color(seen.pane_colours().trouble));
        }
        if let Some(made) = &self.made {
            for warning in &made.report.warnings {
                let warning = translate_library_message(warning, seen.language);
                ui.label(RichText::new(warning).small().color(seen.pane_colours().trouble));
            }
        }
        ui.horizontal(|ui| {
            let field = script_edit::draw_text_line(ui, &mut self.gloss, |field| {
                field.hint_text(seen.say_text(words::GLOSS)).desired_width(160.0)
            });
            let response = field.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say_text(words::GLOSS)));
            let ready = self.made.is_some()
                && !self.gloss.trim().is_empty()
                && !seen.snapshot.is_read_only()
                && !seen.is_running(self.storing);
            if ui
                .add_enabled(ready, Button::new(seen.say_text(words::STORE)))
                .clicked()
            {
                let gloss = self.gloss.trim().to_owned();
                self.storing = Some(seen.request_work(recombining::store_recipe_job(self.of.clone(), gloss)));
            }
        });
        // After an undo the stored sign does not exist any more.
        let stored_name = self.stored.as_ref();
        let stored = stored_name.filter(|name| seen.snapshot.recording_named(name).is_some());
        if let Some(name) = stored {
            let key = seen.keys.action_keys_text(Action::Export);
            let values: [(&str, &dyn std::fmt::Display); 2] = [("name", name), ("key", &key)];
            ui.weak(fill_text_braces(seen.say_text(words::STORED), &values));
        }
    }

    fn practise(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let seed = (ui.input(|input| input.time) * 1e6) as u64;
        let begun = self.choose_practice_set(ui, seen);
        let mut cue_now = begun.is_some();
        if let Some(items) = begun {
            self.exercise = Some(CueExercise::from_practice_items(items, seed));
        }
        // It is taken out while the pane itself is used to show the word.
        let Some(mut exercise) = self.exercise.take() else {
            return;
        };
        ui.separator();
        cue_now |= show_exercise(ui, seen, &mut exercise);
        self.show_practice_view(ui, seen);
        if cue_now && let Some(item) = exercise.cued_item() {
            let reading = cue_data::read_cued_text(&item.input, &self.choices, &PhoneCorrections::new());
            self.shows = false;
            self.show_cued_movement(&reading, true, seen.out);
            seen.send_command(WindowCommand::Look);
        }
        self.exercise = Some(exercise);
    }

    /// Shows the sets of keys and words; returns the one that the user begins with.
    fn choose_practice_set(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) -> Option<Vec<PracticeItem>> {
        let mut begun = None;
        ui.horizontal_wrapped(|ui| {
            ui.label(seen.say_text(words::KEY_SET));
            for (title, set) in cue_data::key_sets(&self.choices, seen.language) {
                if set.len() > 1 && ui.button(seen.say_text(title)).clicked() {
                    begun = Some(set);
                }
            }
        });
        ui.label(seen.say_text(words::SET));
        ui.horizontal_wrapped(|ui| {
            for set in cue_data::practice_sets(&self.choices) {
                let names: Vec<&str> = set.iter().map(|item| item.word.as_str()).collect();
                if ui.button(names.join(", ")).clicked() {
                    begun = Some(set);
                }
            }
        });
        ui.horizontal(|ui| {
            let name = seen.say_text(words::OWN_SET);
            let field = script_edit::draw_text_line(ui, &mut self.own_words, |field| {
                field.hint_text(name).desired_width(200.0)
            });
            let response = field.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
            let word_set = cue_data::own_set(&self.own_words);
            if ui
                .add_enabled(word_set.is_some(), Button::new(seen.say_text(words::PRACTISE)))
                .clicked()
            {
                begun = word_set;
            }
        });
        begun
    }

    /// Shows the speed of the movement and the sides from which it is seen.
    fn show_practice_view(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.horizontal_wrapped(|ui| {
            let label = ui.label(seen.say_text(words::SPEED));
            let mut speed = self.speed.unwrap_or(1.0);
            let field = DragValue::new(&mut speed)
                .range(0.25..=2.0)
                .speed(0.01)
                .max_decimals(2)
                .suffix(" ×");
            if ui.add(field).labelled_by(label.id).changed() {
                self.speed = Some(speed);
                seen.send_command(WindowCommand::Speed(speed));
            }
            if ui.button(seen.say_text(words::FROM_SIDE)).clicked() {
                seen.send_command(WindowCommand::Do(Action::ViewRight));
            }
            if ui.button(seen.say_text(words::FROM_FRONT)).clicked() {
                seen.send_command(WindowCommand::Do(Action::ViewFront));
            }
        });
    }

    fn show_cue_slips(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        ui.weak(seen.say_text(words::SLIPS_HINT));
        let recording = seen.shown.recording;
        ui.horizontal(|ui| {
            let ready = recording.is_some() && !seen.is_running(self.comparing);
            let compare_button = ui.add_enabled(ready, Button::new(seen.say_text(words::COMPARE)));
            let button = compare_button.on_disabled_hover_text(seen.say_text(words::NEEDS_RECORDING));
            if let Some(recording) = recording.filter(|_| button.clicked()) {
                let code = all_cue_codes()
                    .get(self.choices.code)
                    .map_or("french", |code| code.id.as_str());
                (self.slips, self.slips_wrong) = (None, None);
                self.comparing = Some(seen.request_work(analysis::cue_slips(recording, code.to_owned())));
            }
            if seen.is_running(self.comparing) {
                ui.spinner();
            }
        });
        if let Some(wrong) = &self.slips_wrong {
            let wrong = translate_library_message(wrong, seen.language);
            ui.label(RichText::new(wrong).color(seen.pane_colours().trouble));
        }
        let Some(found) = &self.slips else { return };
        let values: [(&str, &dyn std::fmt::Display); 2] = [("right", &found.right), ("all", &found.predicted)];
        ui.label(fill_text_braces(seen.say_text(words::SLIPS_FOUND), &values));
        for slip in &found.slips {
            let (text, at) = cue_data::describe_cue_slip(slip, seen.language);
            if ui.link(text).clicked()
                && let Some(at) = at
            {
                seen.send_seek(RecordingInstant::from_micros(at));
            }
        }
    }
}

/// Gives a button with several lines one name for assistive technology and tests.
fn name_cue_button(button: &Response, name: &str) {
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
}

/// Returns the key under which the time of a clicked key waits for the end of the frame.
fn seek_id() -> eframe::egui::Id {
    eframe::egui::Id::unique("cue-seek")
}

/// Shows a foldable part of the pane.
fn show_cue_part(ui: &mut Ui, seen: &PaneInput<'_>, title: InterfaceText, show: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(seen.say_text(title))
        .id_salt(title.text_id())
        .show(ui, show);
}

impl PaneInterface for CuePane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let now = ui.input(|input| input.time);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            self.show_typed_cue_text(ui, seen);
            self.show_cueing_settings(ui, seen);
            let reading = self.current_cued_reading(now);
            if !reading.keys.is_empty() {
                if self.choices.has_spelling_rules() {
                    self.words_of(ui, seen, &reading);
                }
                self.show_cue_keys(ui, seen, &reading);
            }
            for finding in &reading.findings {
                ui.label(
                    RichText::new(crate::words::translate_library_message(finding, seen.language))
                        .small()
                        .weak(),
                );
            }
            ui.separator();
            self.cuer(ui, seen, &reading);
            show_cue_part(ui, seen, words::PRACTISE, |ui| self.practise(ui, seen));
            show_cue_part(ui, seen, words::SLIPS, |ui| self.show_cue_slips(ui, seen));
            // The newest text is shown once it has settled.
            let reading = self.current_cued_reading(now);
            let rest = self.changed + CUE_SETTLE_SECONDS - now;
            if self.shows && rest > 0.0 {
                ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(rest));
            } else if self.shows && !seen.is_running(self.making) {
                self.shows = false;
                self.show_cued_movement(&reading, false, seen.out);
            }
        });
        if let Some(at) = ui.ctx().data_mut(|data| data.remove_temp::<i64>(seek_id())) {
            seen.send_command(WindowCommand::Cue(RecordingInstant::from_micros(at)));
        }
        if let Some(made) = self.made.as_ref().filter(|_| self.given.is_none()) {
            let made = Arc::new(match self.hidden {
                true => GeneratedClip {
                    name: seen.say_text(words::HIDDEN).to_owned(),
                    parts: Vec::new(),
                    ..GeneratedClip::clip_from_recipe_result(made)
                },
                false => GeneratedClip::clip_from_recipe_result(made),
            });
            self.given = Some(Arc::clone(&made));
            seen.send_command(WindowCommand::Made(Some(made)));
            if let Some(speed) = self.speed {
                seen.send_command(WindowCommand::Speed(speed));
            }
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        if self.making.take_if(|own| *own == id).is_some() {
            match ended {
                Ok(WorkOutcome::Previewed(made)) => self.made = Some(Arc::clone(made)),
                Err(error) => self.wrong = Some(error.to_string()),
                Ok(_) => {}
            }
        }
        if self.storing.take_if(|own| *own == id).is_some()
            && let Ok(WorkOutcome::Recombined(made)) = ended
        {
            self.stored.clone_from(&made.name);
        }
        if self.comparing.take_if(|own| *own == id).is_some() {
            match ended {
                Ok(WorkOutcome::CueSlips(found)) => self.slips = Some(CueSlips::clone(found)),
                Err(error) => self.slips_wrong = Some(error.to_string()),
                Ok(_) => {}
            }
        }
    }
}

/// Shows the words of an exercise, the answer and the score; returns whether a word is to be cued.
fn show_exercise(ui: &mut Ui, seen: &PaneInput<'_>, exercise: &mut CueExercise) -> bool {
    let mut cue_now = false;
    ui.strong(seen.say_text(words::WHICH));
    ui.horizontal_wrapped(|ui| {
        for (at, item) in exercise.items.clone().into_iter().enumerate() {
            let chosen = exercise.answered == Some(at);
            if ui.add(Button::selectable(chosen, item.word)).clicked() {
                exercise.record_answer(at);
            }
        }
    });
    let word = exercise.cued_item().map(|item| item.word.clone()).unwrap_or_default();
    match exercise.answered {
        Some(answer) if answer == exercise.now => {
            ui.label(fill_text_braces(seen.say_text(words::RIGHT), &[("word", &word)]));
        }
        Some(_) => {
            ui.label(fill_text_braces(seen.say_text(words::WRONG), &[("word", &word)]));
        }
        None if exercise.revealed => {
            ui.label(&word);
        }
        None => {}
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button(seen.say_text(words::NEXT)).clicked() {
            exercise.next();
            cue_now = true;
        }
        cue_now |= ui.button(seen.say_text(words::AGAIN)).clicked();
        if ui.button(seen.say_text(words::REVEAL)).clicked() {
            exercise.revealed = true;
        }
        let values: [(&str, &dyn std::fmt::Display); 2] = [("right", &exercise.right), ("all", &exercise.all)];
        ui.weak(fill_text_braces(seen.say_text(words::SCORE), &values));
    });
    cue_now
}
