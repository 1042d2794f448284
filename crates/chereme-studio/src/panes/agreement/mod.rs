//! Agreement: two annotators compared, the places where they differ, and a third tier to decide on.

mod data;
mod list;
mod tables;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{Adjudicated, AgreeOptions, Agreement, Contents, alike_tiers};
use eframe::egui::{
    Button, CollapsingHeader, DragValue, ProgressBar, Role, ScrollArea, Ui, WidgetInfo,
};

use self::data::{Choices, Key, Kinds, Order, Row};
use super::saved::SavedTo;
use super::{Acted, Pane, combo, reach_focus};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::overlay::remedy;
use crate::script::edit;
use crate::words::{Language, agreement as words, fill, shell, spoken};
use crate::work::{Ended, Outcome, WorkId, comparing};

/// The least height of the lists and tables below the measures, in points.
const LEAST: f32 = 220.0;

/// The inputs of a comparison.
#[derive(Debug, Clone, PartialEq)]
struct Asked {
    generation: i64,
    options: AgreeOptions,
    names: [String; 2],
}

/// The list or table below the measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum View {
    #[default]
    Disagreements,
    Values,
    Confusion,
    Measures,
    Recordings,
}

/// Why there is no result.
#[derive(Debug)]
struct Wrong {
    text: String,
    remedy: Option<chereme_corpus::remedy::Remedy>,
}

/// The pane.
#[derive(Default)]
pub(crate) struct AgreementPane {
    choices: Choices,
    /// The recording for which the tiers were chosen.
    of: Option<i64>,
    asked: Option<Asked>,
    asking: Option<WorkId>,
    /// The result, with the names of both tiers.
    found: Option<(Arc<Agreement>, [String; 2])>,
    wrong: Option<Wrong>,
    stopped: bool,
    view: View,
    kinds: Kinds,
    order: Order,
    /// The rows of the list, and the inputs that they were computed from.
    rows: Vec<Row>,
    rows_of: Option<(Arc<Agreement>, Kinds, Order, Language)>,
    /// The chosen disagreement, and its row.
    chosen: Option<Key>,
    at: Option<usize>,
    /// The row that takes the keyboard focus.
    reach: Option<usize>,
    scrolled: f32,
    into: String,
    /// The last proposed name; it is replaced by new proposals until the user types one.
    proposed: String,
    writing: Option<WorkId>,
    written: Option<Adjudicated>,
    /// The texts that name tiers, while they are typed.
    typing: [String; 2],
    /// The table of disagreements.
    saved: SavedTo,
}

impl AgreementPane {
    /// Keeps the tiers of the open recording: those of the same names in another one, else two that code the same.
    fn settle(&mut self, contents: &Contents) {
        let tier_of = |name: &String| {
            let found = contents.tiers.iter().find(|it| it.row.name == *name);
            found.map(|it| it.row.id)
        };
        let recording = contents.recording.id;
        if self.of != Some(recording) {
            self.of = Some(recording);
            let kept = self
                .asked
                .as_ref()
                .map(|it| it.names.each_ref().map(tier_of));
            self.choices.tiers = match kept {
                Some([Some(a), Some(b)]) => [Some(a), Some(b)],
                // The comparison over all recordings stays, wherever its list leads.
                Some(_) if self.choices.everywhere => [None; 2],
                _ => alike_tiers(&contents.tiers).map_or([None; 2], |it| it.map(Some)),
            };
        }
        for tier in &mut self.choices.tiers {
            let there = |id: &i64| contents.tiers.iter().any(|it| it.row.id == *id);
            *tier = tier.filter(there);
        }
    }

    /// Requests the comparison if its inputs changed.
    fn follow(&mut self, ui: &Ui, seen: &PaneInput<'_>, contents: &Contents, out: &mut Outbox) {
        let Some((options, names)) = self.choices.options(contents) else {
            if !self.choices.everywhere || self.choices.by_text {
                (self.found, self.asked, self.wrong) = (None, None, None);
            }
            return;
        };
        let asked = Asked {
            generation: seen.snapshot.overview.generation,
            options,
            names,
        };
        let dragging = ui.input(|input| input.pointer.any_down());
        if self.asked.as_ref() == Some(&asked) || dragging {
            return;
        }
        if let Some(old) = self.asking.take() {
            out.send(Command::Stop(old));
        }
        let taken: Vec<&str> = contents
            .tiers
            .iter()
            .map(|it| it.row.name.as_str())
            .collect();
        let proposed = data::third_name(&asked.names, &taken);
        if self.into.trim().is_empty() || self.into == self.proposed {
            self.into.clone_from(&proposed);
        }
        self.proposed = proposed;
        self.stopped = false;
        self.asking = Some(out.work(comparing::agree(asked.options.clone())));
        self.asked = Some(asked);
    }

    /// Computes the rows of the list again if their inputs changed; the chosen disagreement stays chosen.
    fn refresh(&mut self, language: Language) {
        let Some((found, names)) = &self.found else {
            return;
        };
        let same = self.rows_of.as_ref().is_some_and(|it| {
            Arc::ptr_eq(&it.0, found) && (it.1, it.2, it.3) == (self.kinds, self.order, language)
        });
        if same {
            return;
        }
        self.rows = data::rows(found, names, (self.kinds, self.order), language);
        self.at = self.chosen.and_then(|chosen| {
            let is = |row: &Row| data::key(&found.list[row.place]) == chosen;
            self.rows.iter().position(is)
        });
        self.rows_of = Some((found.clone(), self.kinds, self.order, language));
    }

    /// Shows the lists of tiers, and the settings.
    fn tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, contents: &Contents, out: &mut Outbox) {
        let named = |it: &chereme_corpus::TierContents| match it.row.annotator.as_deref() {
            Some(by) if !by.trim().is_empty() => format!("{} · {by}", it.row.name),
            _ => it.row.name.clone(),
        };
        let tiers = contents.tiers.iter();
        let tiers: Vec<(Option<i64>, String)> =
            tiers.map(|it| (Some(it.row.id), named(it))).collect();
        let [first, second] = &mut self.choices.tiers;
        match self.choices.by_text {
            true => self.typed(ui, seen),
            false => drop(ui.horizontal_wrapped(|ui| {
                combo::named(ui, seen.say(words::FIRST), first, &tiers);
                combo::named(ui, seen.say(words::SECOND), second, &tiers);
            })),
        }
        ui.horizontal_wrapped(|ui| {
            let swap = ui.button(seen.say(words::SWAP));
            if swap.on_hover_text(seen.say(words::SWAP_TIP)).clicked() {
                self.choices.tiers.reverse();
                self.choices.texts.reverse();
                self.typing.reverse();
            }
            for (on, text, tip) in [
                (
                    &mut self.choices.by_text,
                    words::BY_TEXT,
                    words::BY_TEXT_TIP,
                ),
                (
                    &mut self.choices.everywhere,
                    words::EVERYWHERE,
                    words::EVERYWHERE_TIP,
                ),
                (&mut self.choices.gamma, words::GAMMA, words::GAMMA_TIP),
            ] {
                ui.checkbox(on, seen.say(text)).on_hover_text(seen.say(tip));
            }
            self.running(ui, seen, out);
        });
        let header = CollapsingHeader::new(seen.say(words::SETTINGS)).id_salt("settings");
        header.show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                let label = ui.label(seen.say(words::TOLERANCE));
                let field = DragValue::new(&mut self.choices.tolerance_ms).range(0..=5000);
                ui.add(field.suffix(" ms")).labelled_by(label.id);
            });
            ui.horizontal_wrapped(|ui| {
                let label = ui.label(seen.say(words::OVERLAP));
                let field = DragValue::new(&mut self.choices.overlap).range(51..=100);
                ui.add(field.suffix(" %")).labelled_by(label.id);
            });
            ui.checkbox(&mut self.choices.whole, seen.say(words::WHOLE))
                .on_hover_text(seen.say(words::WHOLE_TIP));
            let Choices {
                draws,
                samples,
                seed,
                ..
            } = &mut self.choices;
            for (field, text) in [
                (
                    DragValue::new(draws).range(0..=100_000),
                    words::DRAWS_OF_INTERVALS,
                ),
                (
                    DragValue::new(samples).range(30..=10_000),
                    words::DRAWS_OF_GAMMA,
                ),
                (DragValue::new(seed), words::SEED),
            ] {
                ui.horizontal_wrapped(|ui| {
                    let label = ui.label(seen.say(text));
                    ui.add(field).labelled_by(label.id);
                });
            }
        });
    }

    /// Shows the lines of tiers that are named by texts; a text counts once it is complete.
    fn typed(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let lines = self.typing.iter_mut().zip(&mut self.choices.texts);
        for ((typed, counts), name) in lines.zip([words::FIRST, words::SECOND]) {
            let name = seen.say(name);
            ui.horizontal_wrapped(|ui| {
                ui.weak(name);
                let hint = seen.say(words::BY_TEXT_HINT);
                let shown = edit::line(ui, typed, |field| {
                    field.hint_text(hint).desired_width(240.0)
                });
                let response = shown.response.response;
                response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
                if response.lost_focus() {
                    counts.clone_from(typed);
                }
            });
        }
    }

    /// Takes the path of a file chooser.
    pub(crate) fn take_paths(&mut self, paths: Vec<PathBuf>) {
        if let Some(path) = paths.first() {
            self.saved.to = path.display().to_string();
        }
    }

    /// Shows the file for the table of disagreements, and the button that writes it.
    fn save(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        found: &Arc<Agreement>,
        out: &mut Outbox,
    ) {
        let header = CollapsingHeader::new(seen.say(words::SAVE_TABLE)).id_salt("table");
        header.show(ui, |ui| {
            let named = (words::TABLE_FILE, words::WRITE_TABLE, Choose::Disagreements);
            let to = self.saved.show(ui, seen, named, "disagreements.csv", out);
            if let Some((to, force)) = to {
                let job = comparing::write(found.clone(), to, force);
                self.saved.saving = Some(out.work(job));
            }
        });
    }

    /// Shows how far the comparison is, and the button that stops it.
    fn running(&self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some(id) = self.asking.filter(|id| seen.is_running(Some(*id))) else {
            return;
        };
        match seen.far(id).and_then(crate::work::Far::share) {
            Some(share) => drop(ui.add(ProgressBar::new(share).desired_width(80.0))),
            None => drop(ui.spinner()),
        }
        let stop = ui.button(seen.say(words::STOP));
        if stop.on_hover_text(seen.say(words::TASK)).clicked() {
            out.send(Command::Stop(id));
        }
    }

    /// Shows why there is no comparison.
    fn status(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if self.stopped {
            ui.horizontal_wrapped(|ui| {
                ui.strong(seen.say(words::STOPPED));
                if ui.button(seen.say(words::AGAIN)).clicked() {
                    self.asked = None;
                }
            });
        }
        if let Some(wrong) = &self.wrong {
            ui.colored_label(seen.colours().trouble, spoken(&wrong.text, seen.language));
            let helps = wrong.remedy.as_ref();
            if let Some(helps) = helps.and_then(|it| remedy::here(it, seen.language)) {
                ui.weak(helps);
            }
        }
    }

    /// Shows the name of the third tier, and the button that writes it.
    fn third(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        contents: Option<&Contents>,
        out: &mut Outbox,
    ) {
        ui.horizontal_wrapped(|ui| {
            let name = seen.say(words::INTO);
            ui.weak(name);
            let shown = edit::line(ui, &mut self.into, |field| {
                field.hint_text(name).desired_width(140.0)
            });
            let response = shown.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
            let is_named = !self.into.trim().is_empty();
            let locked = seen.snapshot.is_read_only();
            let busy = seen.is_running(self.writing) || seen.is_running(self.asking);
            let ready = is_named && !locked && !busy && self.found.is_some();
            let button = ui.add_enabled(ready, Button::new(seen.say(words::WRITE)));
            let why = match locked {
                true => shell::READ_ONLY_WHY,
                false => words::NEEDS_NAME,
            };
            let button = button
                .on_hover_text(seen.say(words::WRITE_TIP))
                .on_disabled_hover_text(seen.say(why));
            if button.clicked()
                && let Some(asked) = &self.asked
            {
                let into = self.into.trim().to_owned();
                self.written = None;
                let job = comparing::adjudicate(asked.options.clone(), into);
                self.writing = Some(out.work(job));
            }
        });
        // After an undo the third tier does not exist any more.
        let there = |it: &&Adjudicated| {
            contents.is_none_or(|open| {
                !it.recordings.contains(&open.recording.name)
                    || open.tiers.iter().any(|tier| tier.row.name == it.tier)
            })
        };
        let Some(done) = self.written.as_ref().filter(there) else {
            return;
        };
        ui.horizontal_wrapped(|ui| {
            let values: [(&str, &dyn std::fmt::Display); 3] = [
                ("tier", &done.tier),
                ("agreed", &done.agreed),
                ("conflicts", &done.conflicts),
            ];
            ui.label(fill(seen.say(words::WRITTEN), &values));
            if done.conflicts > 0 && ui.button(seen.say(words::DECIDE)).clicked() {
                out.send(Command::Do(Action::ShowHistory));
            }
        });
    }

    /// Opens the disagreement of a row: the place on the timeline and the stage, and the annotation.
    fn open(&mut self, at: usize, seen: &PaneInput<'_>, out: &mut Outbox) {
        let Some((found, _)) = &self.found else {
            return;
        };
        let Some(it) = self.rows.get(at).map(|row| &found.list[row.place]) else {
            return;
        };
        (self.chosen, self.at) = (Some(data::key(it)), Some(at));
        out.send(Command::Place(it.recording_id, data::span(it)));
        if let Some(side) = it.a.as_ref().or(it.b.as_ref()) {
            let id = side.annotation;
            let tier = seen.snapshot.annotation(id).map(|it| it.tier.row.id);
            if tier.is_some() {
                out.send(Command::Tier(tier));
            }
            out.send(Command::Annotations(BTreeSet::from([id])));
        }
        out.send(Command::Look);
    }

    /// Opens the next disagreement of the list, or the previous one.
    fn walk(&mut self, by: isize, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        self.refresh(seen.language);
        if self.found.is_none() {
            return Acted::Cannot(words::NEEDS_RESULT);
        }
        let Some(to) = data::step(self.at, by, self.rows.len()) else {
            return Acted::Cannot(words::NO_MORE);
        };
        self.view = View::Disagreements;
        self.open(to, seen, out);
        self.reach = Some(to);
        Acted::Yes
    }
}

impl Pane for AgreementPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let contents = seen
            .shown
            .recording
            .and_then(|id| seen.snapshot.contents(id));
        if let Some(contents) = contents {
            self.settle(contents);
            self.follow(ui, seen, contents, out);
        }
        let contents = seen.snapshot.contents_or_before(seen.shown.recording);
        self.refresh(seen.language);
        let area = ScrollArea::vertical()
            .id_salt("agreement")
            .auto_shrink(false);
        area.show(ui, |ui| {
            match contents {
                Some(contents) => self.tools(ui, seen, contents, out),
                None if seen.shown.recording.is_none() => {
                    drop(ui.label(seen.say(words::NO_RECORDING)));
                }
                None => {}
            }
            self.status(ui, seen);
            let Some((found, names)) = self.found.clone() else {
                if let Some(open) =
                    contents.filter(|_| self.asking.is_none() && self.wrong.is_none())
                {
                    let advice = match open.tiers.len() {
                        0 | 1 => words::NO_RECORDING,
                        _ => words::CHOOSE,
                    };
                    ui.label(seen.say(advice));
                }
                return;
            };
            tables::measures(ui, seen, &found);
            self.third(ui, seen, contents, out);
            self.save(ui, seen, &found, out);
            self.views(ui, seen, &found);
            let height = ui.available_height().max(LEAST);
            let width = ui.available_width();
            ui.allocate_ui(eframe::egui::vec2(width, height), |ui| match self.view {
                View::Disagreements => self.list(ui, seen, (&found, &names), out),
                View::Values => tables::values(ui, seen, &found),
                View::Confusion => tables::confusion(ui, seen, &found),
                View::Measures => tables::every_measure(ui, seen, &found),
                View::Recordings => tables::recordings(ui, seen, &found),
            });
            reach_focus(ui);
        });
    }

    fn act(&mut self, action: Action, seen: &PaneInput<'_>, out: &mut Outbox) -> Acted {
        match action {
            Action::NextDisagreement => self.walk(1, seen, out),
            Action::PreviousDisagreement => self.walk(-1, seen, out),
            _ => Acted::No,
        }
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.asking.take_if(|it| *it == id).is_some() {
            match ended {
                Ok(Outcome::Agreed(found)) => {
                    self.wrong = None;
                    if let Some(asked) = &self.asked {
                        self.found = Some((found.clone(), asked.names.clone()));
                    }
                }
                Err(chereme_corpus::Error::Stopped) => self.stopped = true,
                Err(error) => {
                    self.found = None;
                    self.wrong = Some(Wrong {
                        text: error.to_string(),
                        remedy: error.remedy(),
                    });
                }
                Ok(_) => {}
            }
        } else if self.saved.saving.take_if(|it| *it == id).is_some() {
            if matches!(ended, Ok(Outcome::DisagreementsWritten)) {
                self.saved.written();
            }
        } else if self.writing.take_if(|it| *it == id).is_some()
            && let Ok(Outcome::Adjudicated(done)) = ended
        {
            self.written = Some(done.clone());
        }
    }

    fn come(&mut self) {
        self.reach = self.at.or((!self.rows.is_empty()).then_some(0));
    }
}
