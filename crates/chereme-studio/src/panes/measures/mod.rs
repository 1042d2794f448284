//! The measures of signs: neighbours, minimal pairs, homonyms, families and uses, as a table that opens signs.
//!
//! | module | holds |
//! |---|---|
//! | `table` | the columns, and the order of signs |
//! | `rows` | the table as it is drawn |

mod measures_rows;
mod measures_table;

use std::sync::Arc;

use chereme_corpus::{
    CorpusError, EmptyCellTreatment, FIELD_SETS, LexiconScope, NeighbourDefinition, SignMeasureOptions, SignMeasures,
};
use eframe::egui::{Button, Key, Popup, PopupCloseBehavior, Role, ScrollArea, Ui, WidgetInfo};

use self::measures_table::MeasureOrder;
use super::notated_pane::AnimatedNotations;
use super::search::facet_name;
use super::{PaneInterface, combo};
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::script::script_edit;
use crate::window_remedy::ShownFailure;
use crate::words::{InterfaceText, fill_text_braces, measures_words as words};
use crate::work::{WorkId, WorkOutcome, WorkResult, comparing};

/// The most fields in which neighbours may differ; there are too many combinations of more.
const MAX_DIFFERING_FIELDS: usize = 8;
/// An attribute that every sign with stored measures has.
const STORED_ATTRIBUTE: &str = "measure.density";
const FIELD_LIST_HEIGHT_POINTS: f32 = 260.0;

/// The pane.
#[derive(Default)]
pub(crate) struct MeasuresPane {
    options: SignMeasureOptions,
    /// The options of the measures that were requested last.
    requested: Option<SignMeasureOptions>,
    asked: Option<WorkId>,
    found: Option<Arc<SignMeasures>>,
    failure: Option<ShownFailure>,
    stopped: bool,
    /// The fields that are offered: those of the last measures by all coded fields, and those that were added.
    known: Vec<String>,
    query: String,
    other_field: String,
    storing: Option<WorkId>,
    stored: bool,
    order: MeasureOrder,
    /// The places of signs in their order.
    rows: Vec<usize>,
    /// The row at the keyboard cursor, and the one to give the focus.
    at: usize,
    reach: Option<usize>,
    /// The scroll offset of the table, in points.
    scrolled: f32,
    /// Signs animated from their notation.
    notated: AnimatedNotations,
}

impl MeasuresPane {
    /// Shows the opened notated sign on the stage once it is animated, even if another pane covers this one.
    pub(crate) fn show_animated_measured_sign(&mut self, out: &CommandOutbox) {
        self.notated.show_opened_notation(out);
    }

    /// Requests measures by the present options. After changes of the corpus the user asks for them, since annotating would
    /// begin them with every step.
    fn request_measures(&mut self, out: &CommandOutbox) {
        if let Some(old) = self.asked.take() {
            out.send_command(WindowCommand::Stop(old));
        }
        self.requested = Some(self.options.clone());
        (self.failure, self.stopped, self.stored) = (None, false, false);
        self.asked = Some(out.request_work(comparing::measure_signs_job(self.options.clone())));
    }

    fn take_measures(&mut self, measures: &Arc<SignMeasures>) {
        if self.options.fields.is_empty() {
            self.known.clone_from(&measures.fields);
        }
        self.found = Some(measures.clone());
        (self.at, self.scrolled) = (0, 0.0);
        self.sort_rows();
    }

    fn sort_rows(&mut self) {
        let found = self.found.as_ref();
        self.rows = found.map_or(Vec::new(), |found| self.order.sort_measured_signs(&found.signs));
    }

    /// Shows the definitions: of neighbours, empty fields and lexicons.
    fn show_definitions(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let say = |text: InterfaceText| seen.say_text(text).to_owned();
        let definitions = [
            (NeighbourDefinition::AslLex, say(words::ASL_LEX)),
            (NeighbourDefinition::Signbank, say(words::SIGNBANK)),
            (NeighbourDefinition::CorpusTools, say(words::CORPUS_TOOLS)),
        ];
        let numbers: Vec<(usize, String)> = (1..=MAX_DIFFERING_FIELDS)
            .map(|n| (n, fill_text_braces(seen.say_text(words::WITHIN_FIELDS), &[("n", &n)])))
            .collect();
        let treatments = [
            (EmptyCellTreatment::Value, say(words::EMPTY_VALUE)),
            (EmptyCellTreatment::Unknown, say(words::EMPTY_UNKNOWN)),
        ];
        let options = &mut self.options;
        combo::show_named_combo(
            ui,
            seen.say_text(words::NEIGHBOURS),
            &mut options.definition,
            &definitions,
        );
        combo::show_named_combo(ui, seen.say_text(words::WITHIN), &mut options.within, &numbers);
        combo::show_named_combo(ui, seen.say_text(words::EMPTY_CELLS), &mut options.empty, &treatments);
        let lexicons = &seen.snapshot.overview.lexicons;
        if lexicons.len() > 1 {
            let fixed = [
                (LexiconScope::Single, say(words::ONLY_LEXICON)),
                (LexiconScope::Across, say(words::ACROSS)),
            ];
            let named = lexicons
                .iter()
                .map(|row| (LexiconScope::Named(row.name.clone()), row.name.clone()));
            let scopes: Vec<(LexiconScope, String)> = fixed.into_iter().chain(named).collect();
            combo::show_named_combo(ui, seen.say_text(words::LEXICON), &mut options.scope, &scopes);
        }
    }

    /// Shows the menu of the fields that make a form.
    fn show_field_menu(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let chosen = match self.options.fields.as_slice() {
            [] => seen.say_text(words::ALL_CODED).to_owned(),
            [one] => one.clone(),
            several => several.len().to_string(),
        };
        let title = fill_text_braces(seen.say_text(words::FIELDS), &[("fields", &chosen)]);
        let popup = Popup::from_toggle_button_response(&ui.button(title))
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .accessible_name(seen.say_text(words::OTHER_FIELD));
        popup.show(|ui| {
            let fields = &mut self.options.fields;
            if ui.radio(fields.is_empty(), seen.say_text(words::ALL_CODED)).clicked() {
                fields.clear();
            }
            ScrollArea::vertical()
                .max_height(FIELD_LIST_HEIGHT_POINTS)
                .show(ui, |ui| {
                    for field in &self.known {
                        let mut is_chosen = fields.contains(field);
                        if ui.checkbox(&mut is_chosen, facet_name(field, seen)).changed() {
                            let is_set = FIELD_SETS.iter().any(|set| fields[..] == [set.name.as_str()]);
                            fields.retain(|other| other != field && !is_set);
                            fields.extend(is_chosen.then(|| field.clone()));
                        }
                    }
                });
            let line = script_edit::draw_text_line(ui, &mut self.other_field, |field| {
                field.hint_text(seen.say_text(words::OTHER_HINT))
            });
            let response = line.response.response.on_hover_text(seen.say_text(words::OTHER_FIELD));
            let name = seen.say_text(words::OTHER_FIELD);
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let typed = self.other_field.trim().to_owned();
            if entered && !typed.is_empty() {
                self.other_field.clear();
                if !self.known.contains(&typed) {
                    self.known.push(typed.clone());
                }
                fields.push(typed);
            }
            ui.small(seen.say_text(words::COLUMN_SETS));
            ui.horizontal(|ui| {
                for set in FIELD_SETS.iter() {
                    let is_chosen = fields[..] == [set.name.as_str()];
                    if ui.selectable_label(is_chosen, &set.name).clicked() {
                        *fields = vec![set.name.clone()];
                    }
                }
            });
        });
    }

    fn show_query_line(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let name = seen.say_text(words::AMONG);
        let line = script_edit::draw_text_line(ui, &mut self.query, |field| {
            field.hint_text(seen.say_text(words::AMONG_HINT)).desired_width(160.0)
        });
        let response = line.response.response.on_hover_text(name);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
        if response.lost_focus() {
            let query = self.query.trim();
            self.options.query = (!query.is_empty()).then(|| query.to_owned());
        }
    }

    fn show_progress_or_tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if super::show_running_work(ui, seen, self.asked) {
            return;
        }
        if ui.button(seen.say_text(words::AGAIN)).clicked() {
            self.request_measures(seen.out);
        }
        let Some(found) = self.found.as_ref().filter(|found| !found.signs.is_empty()) else {
            return;
        };
        // An undo takes the stored measures away.
        let is_stored = self.stored
            && seen
                .snapshot
                .overview
                .attributes
                .iter()
                .any(|name| name == STORED_ATTRIBUTE);
        let may_store = !(seen.snapshot.is_read_only() || self.storing.is_some() || is_stored);
        let store = ui.add_enabled(may_store, Button::new(seen.say_text(words::STORE)));
        if store.on_hover_text(seen.say_text(words::STORE_TIP)).clicked() {
            self.storing = Some(seen.request_work(comparing::store_measures_job(found.clone())));
        }
    }

    fn show_failure_or_stop(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if self.stopped {
            ui.label(seen.say_text(words::STOPPED));
        }
        if let Some(failure) = &self.failure {
            failure.show_failure(ui, seen.language, seen.pane_colours().trouble);
        }
    }
}

impl PaneInterface for MeasuresPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if seen.snapshot.overview.signs.is_empty() {
            ui.label(seen.say_text(crate::words::search_words::EMPTY));
            return;
        }
        self.notated
            .forget_animation_failures(seen.snapshot.overview.generation);
        ui.horizontal_wrapped(|ui| self.show_definitions(ui, seen));
        ui.horizontal_wrapped(|ui| {
            self.show_field_menu(ui, seen);
            self.show_query_line(ui, seen);
            self.show_progress_or_tools(ui, seen);
        });
        if self.requested.as_ref() != Some(&self.options) {
            self.request_measures(seen.out);
        }
        self.show_failure_or_stop(ui, seen);
        let Some(found) = self.found.clone() else {
            return;
        };
        if found.signs.is_empty() {
            ui.label(seen.say_text(words::NONE));
            return;
        }
        let summary = fill_text_braces(
            seen.say_text(words::SUMMARY),
            &[
                ("n", &found.signs.len()),
                ("all", &found.entries),
                ("mean", &format!("{:.2}", found.mean_density)),
                ("median", &found.median_density),
                ("alone", &found.without_neighbour),
            ],
        );
        ui.small(summary);
        self.show_measure_table(ui, seen, &found);
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        self.notated.receive_animation_result(id, ended);
        if self.storing.take_if(|storing| *storing == id).is_some() {
            self.stored = ended.is_ok();
        }
        if self.asked.take_if(|asked| *asked == id).is_none() {
            return;
        }
        match ended {
            Ok(WorkOutcome::SignsMeasured(measures)) => self.take_measures(measures),
            Ok(_) => {}
            Err(CorpusError::Stopped) => self.stopped = true,
            Err(error) => {
                self.found = None;
                self.failure = Some(ShownFailure::from_error(error));
            }
        }
    }
}
