//! Agreement: two annotators compared, the places where they differ, and a third tier to decide on.

mod agreement_data;
mod agreement_list;
mod agreement_tables;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{AdjudicationResult, AgreeOptions, AnnotatorAgreement, RecordingContents, alike_tiers};
use eframe::egui::{Button, CollapsingHeader, DragValue, Role, ScrollArea, Ui, WidgetInfo};

use self::agreement_data::{AgreementChoices, DisagreementKey, DisagreementKinds, DisagreementOrder, DisagreementRow};
use super::saved_pane::{SavedFile, SavedTo};
use super::{ActionOutcome, PaneInterface, combo, reach_focus, show_running_work};
use crate::action::Action;
use crate::command::{ChooserPurpose, WindowCommand};
use crate::context::PaneInput;
use crate::script::script_edit;
use crate::window_remedy;
use crate::words::{InterfaceLanguage, agreement as words, fill_text_braces, shell, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, comparing};

/// The least height of the lists and tables below the measures, in points.
const MIN_AGREEMENT_LIST_HEIGHT: f32 = 220.0;

/// The inputs of a comparison.
#[derive(Debug, Clone, PartialEq)]
struct ComparisonInputs {
    generation: i64,
    options: AgreeOptions,
    names: [String; 2],
}

/// The list or table below the measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum AgreementView {
    #[default]
    Disagreements,
    Values,
    Confusion,
    Measures,
    Recordings,
}

/// Why there is no result.
#[derive(Debug)]
struct ComparisonFailure {
    text: String,
    remedy: Option<chereme_corpus::remedy::ErrorRemedy>,
}

/// The pane.
#[derive(Default)]
pub(crate) struct AgreementPane {
    choices: AgreementChoices,
    /// The recording for which the tiers were chosen.
    of: Option<i64>,
    asked: Option<ComparisonInputs>,
    asking: Option<WorkId>,
    /// The result, with the names of both tiers.
    found: Option<(Arc<AnnotatorAgreement>, [String; 2])>,
    wrong: Option<ComparisonFailure>,
    stopped: bool,
    view: AgreementView,
    kinds: DisagreementKinds,
    order: DisagreementOrder,
    /// The rows of the list, and the inputs that they were computed from.
    rows: Vec<DisagreementRow>,
    rows_of: Option<(
        Arc<AnnotatorAgreement>,
        DisagreementKinds,
        DisagreementOrder,
        InterfaceLanguage,
    )>,
    /// The chosen disagreement, and its row.
    chosen: Option<DisagreementKey>,
    at: Option<usize>,
    /// The row that takes the keyboard focus.
    reach: Option<usize>,
    scrolled: f32,
    into: String,
    /// The last proposed name; it is replaced by new proposals until the user types one.
    proposed: String,
    writing: Option<WorkId>,
    written: Option<AdjudicationResult>,
    /// The texts that name tiers, while they are typed.
    typing: [String; 2],
    /// The table of disagreements.
    saved: SavedTo,
}

impl AgreementPane {
    /// Keeps the tiers of the open recording: those of the same names in another one, else two that code the same.
    fn settle_compared_tiers(&mut self, contents: &RecordingContents) {
        let tier_of = |name: &String| {
            let tier = contents.tiers.iter().find(|it| it.row.name == *name);
            tier.map(|it| it.row.id)
        };
        let recording = contents.recording.id;
        if self.of != Some(recording) {
            self.of = Some(recording);
            let kept = self
                .asked
                .as_ref()
                .map(|agreement| agreement.names.each_ref().map(tier_of));
            self.choices.tiers = match kept {
                Some([Some(a), Some(b)]) => [Some(a), Some(b)],
                // The comparison over all recordings stays, wherever its list leads.
                Some(_) if self.choices.everywhere => [None; 2],
                _ => alike_tiers(&contents.tiers).map_or([None; 2], |pair| pair.map(Some)),
            };
        }
        for tier in &mut self.choices.tiers {
            let there = |id: &i64| contents.tiers.iter().any(|other_tier| other_tier.row.id == *id);
            *tier = tier.filter(there);
        }
    }

    /// Requests the comparison if its inputs changed.
    fn request_comparison(&mut self, ui: &Ui, seen: &PaneInput<'_>, contents: &RecordingContents) {
        let Some((options, names)) = self.choices.agree_options(contents) else {
            if !self.choices.everywhere || self.choices.by_text {
                (self.found, self.asked, self.wrong) = (None, None, None);
            }
            return;
        };
        let asked = ComparisonInputs {
            generation: seen.snapshot.overview.generation,
            options,
            names,
        };
        // A slider passes many values that nobody wants compared.
        let dragging = ui.input(|input| input.pointer.any_down());
        if self.asked.as_ref() == Some(&asked) || dragging {
            return;
        }
        if let Some(old) = self.asking.take() {
            seen.send_command(WindowCommand::Stop(old));
        }
        let taken: Vec<&str> = contents.tiers.iter().map(|tier| tier.row.name.as_str()).collect();
        let proposed = agreement_data::third_name(&asked.names, &taken);
        // A name that the user typed stays.
        if self.into.trim().is_empty() || self.into == self.proposed {
            self.into.clone_from(&proposed);
        }
        self.proposed = proposed;
        self.stopped = false;
        self.asking = Some(seen.request_work(comparing::compare_tiers_job(asked.options.clone())));
        self.asked = Some(asked);
    }

    /// Computes the rows of the list again if their inputs changed; the chosen disagreement stays chosen.
    fn refresh_disagreement_rows(&mut self, language: InterfaceLanguage) {
        let Some((found, names)) = &self.found else {
            return;
        };
        let same = self.rows_of.as_ref().is_some_and(|source| {
            Arc::ptr_eq(&source.0, found) && (source.1, source.2, source.3) == (self.kinds, self.order, language)
        });
        if same {
            return;
        }
        self.rows = agreement_data::disagreement_rows(found, names, self.kinds, self.order, language);
        self.at = self.chosen.and_then(|chosen| {
            let is = |row: &DisagreementRow| agreement_data::disagreement_key(&found.list[row.place]) == chosen;
            self.rows.iter().position(is)
        });
        self.rows_of = Some((found.clone(), self.kinds, self.order, language));
    }

    /// Shows the lists of tiers, and the settings.
    fn show_comparison_tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, contents: &RecordingContents) {
        let named = |tier: &chereme_corpus::TierContents| match tier.row.annotator.as_deref() {
            Some(by) if !by.trim().is_empty() => format!("{} · {by}", tier.row.name),
            _ => tier.row.name.clone(),
        };
        let tiers = contents.tiers.iter();
        let tiers: Vec<(Option<i64>, String)> = tiers.map(|tier| (Some(tier.row.id), named(tier))).collect();
        let [first, second] = &mut self.choices.tiers;
        match self.choices.by_text {
            true => self.show_typed_tiers(ui, seen),
            false => drop(ui.horizontal_wrapped(|ui| {
                combo::show_named_combo(ui, seen.say_text(words::FIRST), first, &tiers);
                combo::show_named_combo(ui, seen.say_text(words::SECOND), second, &tiers);
            })),
        }
        ui.horizontal_wrapped(|ui| {
            let swap = ui.button(seen.say_text(words::SWAP));
            if swap.on_hover_text(seen.say_text(words::SWAP_TIP)).clicked() {
                self.choices.tiers.reverse();
                self.choices.texts.reverse();
                self.typing.reverse();
            }
            for (on, text, tip) in [
                (&mut self.choices.by_text, words::BY_TEXT, words::BY_TEXT_TIP),
                (&mut self.choices.everywhere, words::EVERYWHERE, words::EVERYWHERE_TIP),
                (&mut self.choices.gamma, words::GAMMA, words::GAMMA_TIP),
            ] {
                ui.checkbox(on, seen.say_text(text)).on_hover_text(seen.say_text(tip));
            }
            show_running_work(ui, seen, self.asking);
        });
        let header = CollapsingHeader::new(seen.say_text(words::SETTINGS)).id_salt("settings");
        header.show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                let label = ui.label(seen.say_text(words::TOLERANCE));
                let field = DragValue::new(&mut self.choices.tolerance_ms).range(0..=5000);
                ui.add(field.suffix(" ms")).labelled_by(label.id);
            });
            ui.horizontal_wrapped(|ui| {
                let label = ui.label(seen.say_text(words::OVERLAP));
                let field = DragValue::new(&mut self.choices.overlap).range(51..=100);
                ui.add(field.suffix(" %")).labelled_by(label.id);
            });
            ui.checkbox(&mut self.choices.whole, seen.say_text(words::WHOLE))
                .on_hover_text(seen.say_text(words::WHOLE_TIP));
            let AgreementChoices {
                draws, samples, seed, ..
            } = &mut self.choices;
            for (field, text) in [
                (DragValue::new(draws).range(0..=100_000), words::DRAWS_OF_INTERVALS),
                (DragValue::new(samples).range(30..=10_000), words::DRAWS_OF_GAMMA),
                (DragValue::new(seed), words::SEED),
            ] {
                ui.horizontal_wrapped(|ui| {
                    let label = ui.label(seen.say_text(text));
                    ui.add(field).labelled_by(label.id);
                });
            }
        });
    }

    /// Shows the lines of tiers that are named by texts; a text counts once it is complete.
    fn show_typed_tiers(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let lines = self.typing.iter_mut().zip(&mut self.choices.texts);
        for ((typed, counts), name) in lines.zip([words::FIRST, words::SECOND]) {
            let name = seen.say_text(name);
            ui.horizontal_wrapped(|ui| {
                ui.weak(name);
                let hint = seen.say_text(words::BY_TEXT_HINT);
                let shown = script_edit::draw_text_line(ui, typed, |field| field.hint_text(hint).desired_width(240.0));
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
    fn show_disagreement_export(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, found: &Arc<AnnotatorAgreement>) {
        let header = CollapsingHeader::new(seen.say_text(words::SAVE_TABLE)).id_salt("table");
        header.show(ui, |ui| {
            let file = SavedFile {
                name: words::TABLE_FILE,
                button: words::WRITE_TABLE,
                chooser: ChooserPurpose::Disagreements,
            };
            let to = self.saved.show_save_path(ui, seen, file, "disagreements.csv");
            if let Some((to, force)) = to {
                let job = comparing::write_disagreements_job(found.clone(), to, force);
                self.saved.saving = Some(seen.request_work(job));
            }
        });
    }

    /// Shows why there is no comparison.
    fn show_comparison_status(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if self.stopped {
            ui.horizontal_wrapped(|ui| {
                ui.strong(seen.say_text(words::STOPPED));
                if ui.button(seen.say_text(words::AGAIN)).clicked() {
                    self.asked = None;
                }
            });
        }
        if let Some(wrong) = &self.wrong {
            ui.colored_label(
                seen.pane_colours().trouble,
                translate_library_message(&wrong.text, seen.language),
            );
            let helps = wrong.remedy.as_ref();
            if let Some(helps) = helps.and_then(|remedy| window_remedy::window_remedy_text(remedy, seen.language)) {
                ui.weak(helps);
            }
        }
    }

    /// Shows the name of the third tier, and the button that writes it.
    fn third(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, contents: Option<&RecordingContents>) {
        ui.horizontal_wrapped(|ui| {
            let name = seen.say_text(words::INTO);
            ui.weak(name);
            let shown =
                script_edit::draw_text_line(ui, &mut self.into, |field| field.hint_text(name).desired_width(140.0));
            let response = shown.response.response;
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
            let is_named = !self.into.trim().is_empty();
            let locked = seen.snapshot.is_read_only();
            let busy = seen.is_running(self.writing) || seen.is_running(self.asking);
            let ready = is_named && !locked && !busy && self.found.is_some();
            let button = ui.add_enabled(ready, Button::new(seen.say_text(words::WRITE)));
            let why = match locked {
                true => shell::READ_ONLY_WHY,
                false => words::NEEDS_NAME,
            };
            let button = button
                .on_hover_text(seen.say_text(words::WRITE_TIP))
                .on_disabled_hover_text(seen.say_text(why));
            if button.clicked()
                && let Some(asked) = &self.asked
            {
                let into = self.into.trim().to_owned();
                self.written = None;
                let job = comparing::adjudicate_tiers_job(asked.options.clone(), into);
                self.writing = Some(seen.request_work(job));
            }
        });
        // After an undo the third tier does not exist any more.
        let there = |adjudicated: &&AdjudicationResult| {
            contents.is_none_or(|open| {
                !adjudicated.recordings.contains(&open.recording.name)
                    || open.tiers.iter().any(|tier| tier.row.name == adjudicated.tier)
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
            ui.label(fill_text_braces(seen.say_text(words::WRITTEN), &values));
            if done.conflicts > 0 && ui.button(seen.say_text(words::DECIDE)).clicked() {
                seen.send_command(WindowCommand::Do(Action::ShowHistory));
            }
        });
    }

    /// Opens the disagreement of a row: the place on the timeline and the stage, and the annotation.
    fn open_disagreement(&mut self, at: usize, seen: &PaneInput<'_>) {
        let Some((found, _)) = &self.found else {
            return;
        };
        let Some(it) = self.rows.get(at).map(|row| &found.list[row.place]) else {
            return;
        };
        (self.chosen, self.at) = (Some(agreement_data::disagreement_key(it)), Some(at));
        seen.send_command(WindowCommand::Place(
            it.recording_id,
            agreement_data::disagreement_span(it),
        ));
        if let Some(side) = it.a.as_ref().or(it.b.as_ref()) {
            let id = side.annotation;
            let tier = seen
                .snapshot
                .find_open_annotation(id)
                .map(|annotation| annotation.tier.row.id);
            if tier.is_some() {
                seen.send_command(WindowCommand::Tier(tier));
            }
            seen.send_command(WindowCommand::Annotations(BTreeSet::from([id])));
        }
        seen.send_command(WindowCommand::Look);
    }

    /// Opens the next disagreement of the list, or the previous one.
    fn walk_disagreements(&mut self, by: isize, seen: &PaneInput<'_>) -> ActionOutcome {
        self.refresh_disagreement_rows(seen.language);
        if self.found.is_none() {
            return ActionOutcome::Cannot(words::NEEDS_RESULT);
        }
        let Some(to) = agreement_data::step_disagreement_row(self.at, by, self.rows.len()) else {
            return ActionOutcome::Cannot(words::NO_MORE);
        };
        self.view = AgreementView::Disagreements;
        self.open_disagreement(to, seen);
        self.reach = Some(to);
        ActionOutcome::Yes
    }
}

impl PaneInterface for AgreementPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let contents = seen.shown.recording.and_then(|id| seen.snapshot.recording_contents(id));
        if let Some(contents) = contents {
            self.settle_compared_tiers(contents);
            self.request_comparison(ui, seen, contents);
        }
        let contents = seen.snapshot.contents_or_before(seen.shown.recording);
        self.refresh_disagreement_rows(seen.language);
        let area = ScrollArea::vertical().id_salt("agreement").auto_shrink(false);
        area.show(ui, |ui| {
            match contents {
                Some(contents) => self.show_comparison_tools(ui, seen, contents),
                None if seen.shown.recording.is_none() => {
                    drop(ui.label(seen.say_text(words::NO_RECORDING)));
                }
                None => {}
            }
            self.show_comparison_status(ui, seen);
            let Some((found, names)) = self.found.clone() else {
                if let Some(open) = contents.filter(|_| self.asking.is_none() && self.wrong.is_none()) {
                    let advice = match open.tiers.len() {
                        0 | 1 => words::NO_RECORDING,
                        _ => words::CHOOSE,
                    };
                    ui.label(seen.say_text(advice));
                }
                return;
            };
            agreement_tables::show_agreement_measures(ui, seen, &found);
            self.third(ui, seen, contents);
            self.show_disagreement_export(ui, seen, &found);
            self.show_agreement_views(ui, seen, &found);
            let height = ui.available_height().max(MIN_AGREEMENT_LIST_HEIGHT);
            let width = ui.available_width();
            ui.allocate_ui(eframe::egui::vec2(width, height), |ui| match self.view {
                AgreementView::Disagreements => self.show_disagreement_list(ui, seen, &found, &names),
                AgreementView::Values => agreement_tables::show_value_agreement(ui, seen, &found),
                AgreementView::Confusion => agreement_tables::show_value_confusion(ui, seen, &found),
                AgreementView::Measures => agreement_tables::every_measure(ui, seen, &found),
                AgreementView::Recordings => agreement_tables::show_recording_agreement(ui, seen, &found),
            });
            reach_focus(ui);
        });
    }

    fn carry_out_pane_action(&mut self, action: Action, seen: &PaneInput<'_>) -> ActionOutcome {
        match action {
            Action::NextDisagreement => self.walk_disagreements(1, seen),
            Action::PreviousDisagreement => self.walk_disagreements(-1, seen),
            _ => ActionOutcome::No,
        }
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        if self.asking.take_if(|work| *work == id).is_some() {
            match ended {
                Ok(WorkOutcome::Agreed(found)) => {
                    self.wrong = None;
                    if let Some(asked) = &self.asked {
                        self.found = Some((found.clone(), asked.names.clone()));
                    }
                }
                Err(chereme_corpus::CorpusError::Stopped) => self.stopped = true,
                Err(error) => {
                    self.found = None;
                    self.wrong = Some(ComparisonFailure {
                        text: error.to_string(),
                        remedy: error.error_remedy(),
                    });
                }
                Ok(_) => {}
            }
        } else if self.saved.saving.take_if(|work| *work == id).is_some() {
            if matches!(ended, Ok(WorkOutcome::DisagreementsWritten)) {
                self.saved.mark_file_written();
            }
        } else if self.writing.take_if(|work| *work == id).is_some()
            && let Ok(WorkOutcome::Adjudicated(done)) = ended
        {
            self.written = Some(done.clone());
        }
    }

    fn come(&mut self) {
        self.reach = self.at.or((!self.rows.is_empty()).then_some(0));
    }
}
