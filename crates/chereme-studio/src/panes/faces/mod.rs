//! Faces: the recorded performances of an expression ranked for a sentence, played side by side, explained, and put on it.

mod faces_choice;
mod faces_data;
mod faces_onsets;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::{
    AnnotationDetector, CorpusAddress, DetectOptions, ExpressionFunction, FoundExpression, FoundExpressions,
    NonmanualDetector, NonmanualOnsets, PerformanceChoice, ProposeScope, RankedPerformance, RankingCriterion, RowName,
};
use eframe::egui::{Button, ScrollArea, Ui};

use self::faces_data::ComparedChannels;
use super::{PaneInterface, combo};
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::generated::GeneratedClip;
use crate::words::{InterfaceText, faces_words as words, fill_text_braces, translate_library_message};
use crate::work::{WorkId, WorkOutcome, WorkResult, analysis, faces_jobs};

/// How many candidates are shown.
const MAX_SHOWN_CANDIDATES: usize = 12;

/// The inputs of the displayed answer.
#[derive(Debug, Clone, PartialEq)]
struct FaceChoiceInputs {
    generation: i64,
    function: ExpressionFunction,
    target: CorpusAddress,
    rank: RankingCriterion,
    compared: ComparedChannels,
    lengths: bool,
}

/// The pane.
#[derive(Default)]
pub(crate) struct FacesPane {
    /// The corpus generation of the last request for expressions.
    of: Option<i64>,
    finding: Option<WorkId>,
    found: Option<Arc<FoundExpressions>>,
    function: Option<ExpressionFunction>,
    /// The address of the sentence.
    sentence: Option<String>,
    rank: RankingCriterion,
    compared: ComparedChannels,
    lengths: bool,
    in_step: bool,
    carried: bool,
    wide: bool,
    asked: Option<FaceChoiceInputs>,
    choosing: Option<WorkId>,
    choice: Option<Arc<PerformanceChoice>>,
    wrong: Option<String>,
    /// The token of the chosen performance.
    chosen: Option<String>,
    gloss: String,
    /// The last proposed gloss; it is replaced by new proposals until the user types one.
    proposed: String,
    storing: Option<WorkId>,
    stored: Option<(String, i64)>,
    /// The recipes whose movement is being generated: the sentence with the face of a performance.
    carrying: BTreeMap<WorkId, String>,
    made: BTreeMap<String, Option<Arc<GeneratedClip>>>,
    measuring: Option<WorkId>,
    onsets: Option<Arc<NonmanualOnsets>>,
    begun: bool,
}

impl FacesPane {
    /// Requests the expressions, or the ranking, if their inputs changed.
    fn request_face_answers(&mut self, seen: &PaneInput<'_>) {
        if !std::mem::replace(&mut self.begun, true) {
            (self.lengths, self.in_step) = (true, true);
        }
        let generation = seen.snapshot.overview.generation;
        if self.of != Some(generation) && !seen.is_running(self.finding) {
            self.of = Some(generation);
            self.finding = Some(seen.request_work(faces_jobs::find_expressions_job()));
        }
        let Some(asked) = self.face_question(generation) else {
            return;
        };
        if self.asked.as_ref() == Some(&asked) || seen.is_running(self.choosing) {
            return;
        }
        let options = faces_data::face_choice_options(asked.rank, asked.compared, asked.lengths, MAX_SHOWN_CANDIDATES);
        let job = faces_jobs::choose_performance_job(asked.function.clone(), asked.target.clone(), options);
        self.choosing = Some(seen.request_work(job));
        self.made.clear();
        self.asked = Some(asked);
    }

    fn face_question(&self, generation: i64) -> Option<FaceChoiceInputs> {
        Some(FaceChoiceInputs {
            generation,
            function: self.function.clone()?,
            target: self.sentence.as_ref()?.parse().ok()?,
            rank: self.rank,
            compared: self.compared,
            lengths: self.lengths,
        })
    }

    fn found_expressions(&self) -> &[FoundExpression] {
        self.found.as_ref().map_or(&[], |list| &list.expressions)
    }

    /// Returns the sentences that can get a face: those with an expression of the function.
    fn face_target_sentences(&self) -> impl Iterator<Item = &FoundExpression> {
        let of = self.function.as_ref();
        self.found_expressions()
            .iter()
            .filter(move |expression| Some(&expression.function) == of)
    }

    /// Keeps function and sentence as long as they exist; otherwise chooses the displayed recording's, else the first.
    fn settle_function_and_sentence(&mut self, seen: &PaneInput<'_>) {
        let there = |expression: &FoundExpression| Some(&expression.function) == self.function.as_ref();
        if !self.found_expressions().iter().any(there) {
            self.function = self
                .found_expressions()
                .first()
                .map(|expression| expression.function.clone());
        }
        let sentence = self.sentence.as_deref();
        if self
            .face_target_sentences()
            .any(|expression| Some(expression.address.as_str()) == sentence)
        {
            return;
        }
        let shown = seen.shown.recording.and_then(|id| seen.snapshot.recording_glance(id));
        let is_shown = |expression: &&FoundExpression| shown.is_some_and(|own| own.row.name == expression.recording);
        let expression = self
            .face_target_sentences()
            .find(is_shown)
            .or(self.face_target_sentences().next());
        self.sentence = expression.map(|it| it.address.clone());
    }

    fn show_face_tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let functions: Vec<ExpressionFunction> = {
            let all = self.found.iter().flat_map(|list| list.functions.keys());
            all.map(|name| ExpressionFunction::from_function_name(name)).collect()
        };
        ui.horizontal_wrapped(|ui| {
            let names: Vec<(Option<ExpressionFunction>, String)> = functions
                .into_iter()
                .map(|function| (Some(function.clone()), function.to_string()))
                .collect();
            combo::show_named_combo(ui, seen.say_text(words::FUNCTION), &mut self.function, &names);
            let sentences: Vec<(Option<String>, String)> = self
                .face_target_sentences()
                .map(|expression| {
                    (
                        Some(expression.address.clone()),
                        faces_data::found_sentence_name(expression),
                    )
                })
                .collect();
            combo::show_named_combo(ui, seen.say_text(words::SENTENCE), &mut self.sentence, &sentences);
            let ranks = [
                (RankingCriterion::Nearest, words::NEAREST),
                (RankingCriterion::Farthest, words::FARTHEST),
                (RankingCriterion::Medoid, words::MEDOID),
            ]
            .map(|(rank, text)| (rank, seen.say_text(text).to_owned()));
            combo::show_named_combo(ui, seen.say_text(words::FIRST), &mut self.rank, &ranks);
            let compared = ComparedChannels::ALL_COMPARED_CHANNELS
                .map(|kind| (kind, seen.say_text(compared_channels_name(kind)).to_owned()));
            combo::show_named_combo(ui, seen.say_text(words::COMPARED), &mut self.compared, &compared);
            for (on, text, tip) in [
                (&mut self.lengths, words::LENGTHS, words::LENGTHS_TIP),
                (&mut self.in_step, words::IN_STEP, words::IN_STEP_TIP),
                (&mut self.carried, words::CARRIED, words::CARRIED_TIP),
            ] {
                ui.checkbox(on, seen.say_text(text)).on_hover_text(seen.say_text(tip));
            }
            let mut close = !self.wide;
            ui.checkbox(&mut close, seen.say_text(words::CLOSE))
                .on_hover_text(seen.say_text(words::CLOSE_TIP));
            self.wide = !close;
            if seen.is_running(self.choosing) || seen.is_running(self.finding) {
                ui.spinner();
            }
        });
    }

    /// Shows the milestones of the sentence, and the button that writes them onto a tier.
    fn show_sentence_milestones(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let sentence = self.sentence.as_deref();
        let found_sentence = self
            .face_target_sentences()
            .find(|expression| Some(expression.address.as_str()) == sentence);
        let Some(it) = found_sentence else { return };
        ui.horizontal_wrapped(|ui| {
            ui.strong(seen.say_text(words::MILESTONES));
            let times = it.milestones.milestone_times();
            for (n, at) in times.into_iter().enumerate() {
                let text = match (n, it.milestones.m3) {
                    (2, None) => "M3 –".to_owned(),
                    _ => format!("M{} {:.3}", n + 1, at.instant_seconds()),
                };
                ui.monospace(text);
            }
            ui.weak(seen.say_text(match it.corrected {
                true => words::CORRECTED,
                false => words::DERIVED,
            }));
            let recording = seen.snapshot.recording_named(&it.recording);
            if ui.small_button(seen.say_text(words::SHOW)).clicked()
                && let Some(recording) = recording
            {
                seen.send_command(WindowCommand::Place(
                    recording.row.id,
                    faces_data::seen_span(&it.milestones),
                ));
                seen.send_command(WindowCommand::Look);
            }
            let open = !seen.snapshot.is_read_only();
            let write = ui.add_enabled(open, Button::new(seen.say_text(words::WRITE)).small());
            if write.on_hover_text(seen.say_text(words::WRITE_TIP)).clicked() {
                seen.request_work(faces_jobs::write_milestones_job(it.function.clone()));
            }
        });
        for finding in &it.findings {
            ui.weak(crate::words::translate_library_message(finding, seen.language));
        }
    }

    fn proposing(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let recording = seen.shown.recording;
        let open = recording.is_some() && !seen.snapshot.is_read_only();
        let button = ui.add_enabled(open, Button::new(seen.say_text(words::PROPOSE)));
        if button.on_hover_text(seen.say_text(words::PROPOSE_TIP)).clicked()
            && let Some(id) = recording
        {
            seen.request_work(analysis::run_detector_job(
                DetectOptions::propose_with(
                    NonmanualDetector.detector_name(),
                    ProposeScope::Recording(RowName::Number(id)),
                ),
                seen.language,
            ));
        }
    }

    /// Chooses a performance and proposes a gloss for the sentence with its face.
    fn choose_performance(&mut self, it: &RankedPerformance) {
        self.chosen = Some(it.token.clone());
        let Some(choice) = self.choice.clone() else {
            return;
        };
        let sentence = self.sentence_name(&choice);
        let proposed = faces_data::proposed_gloss(&choice, &sentence, &it.recording);
        if self.gloss.trim().is_empty() || self.gloss == self.proposed {
            self.gloss.clone_from(&proposed);
        }
        self.proposed = proposed;
    }

    fn sentence_name(&self, choice: &PerformanceChoice) -> String {
        let target_sentence = self
            .found_expressions()
            .iter()
            .find(|expression| expression.address == choice.target);
        target_sentence.map_or_else(|| choice.target.clone(), |expression| expression.recording.clone())
    }

    fn chosen_performance<'a>(&self, choice: &'a PerformanceChoice) -> Option<&'a RankedPerformance> {
        let chosen = self.chosen.as_deref()?;
        choice.ranking.iter().find(|ranked| ranked.token == chosen)
    }
}

fn compared_channels_name(compared: ComparedChannels) -> InterfaceText {
    match compared {
        ComparedChannels::Usual => words::USUAL,
        ComparedChannels::Head => words::HEAD,
        ComparedChannels::Brows => words::BROWS,
        ComparedChannels::All => words::WHOLE,
    }
}

impl PaneInterface for FacesPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.settle_function_and_sentence(seen);
        self.request_face_answers(seen);
        // Without an expression there is nothing to choose from.
        let nothing = |list: &Arc<FoundExpressions>| list.expressions.is_empty();
        if !self.found.as_ref().is_some_and(nothing) {
            self.show_face_tools(ui, seen);
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if let Some(found) = &self.found
                && found.expressions.is_empty()
            {
                ui.label(seen.say_text(words::NONE));
                self.proposing(ui, seen);
                return;
            }
            self.show_sentence_milestones(ui, seen);
            if let Some(wrong) = &self.wrong {
                ui.colored_label(
                    seen.pane_colours().warning,
                    translate_library_message(wrong, seen.language),
                );
            }
            if let Some(choice) = self.choice.clone() {
                self.show_face_candidates(ui, seen, &choice);
                self.show_counts(ui, seen, &choice);
                self.show_score_reasons(ui, seen, &choice);
                self.show_face_sign_form(ui, seen, &choice);
            }
            ui.separator();
            self.show_channel_timing(ui, seen);
            self.proposing(ui, seen);
        });
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        if self.finding.take_if(|work| *work == id).is_some() {
            if let Ok(WorkOutcome::Expressions(found)) = ended {
                self.found = Some(found.clone());
            }
        } else if self.choosing.take_if(|work| *work == id).is_some() {
            match ended {
                Ok(WorkOutcome::Chosen(choice)) => {
                    self.wrong = None;
                    // Another criterion keeps the performance that the user looks at, as long as it is in the list.
                    let kept = self.chosen_performance(choice).or(choice.ranking.first()).cloned();
                    self.choice = Some(choice.clone());
                    if let Some(first) = kept {
                        self.choose_performance(&first);
                    }
                }
                Err(error) => {
                    self.choice = None;
                    self.wrong = Some(error.to_string());
                }
                Ok(_) => {}
            }
        } else if self.storing.take_if(|work| *work == id).is_some() {
            if let Ok(WorkOutcome::Recombined(made)) = ended {
                self.stored = made.recording.map(|recording| (made.gloss.clone(), recording));
            }
        } else if self.measuring.take_if(|work| *work == id).is_some() {
            match ended {
                Ok(WorkOutcome::Onsets(onsets)) => self.onsets = Some(onsets.clone()),
                Err(error) => self.wrong = Some(error.to_string()),
                Ok(_) => {}
            }
        } else if let Some(recipe) = self.carrying.remove(&id) {
            let made = match ended {
                Ok(WorkOutcome::Previewed(made)) => Some(Arc::new(GeneratedClip::clip_from_recipe_result(made))),
                _ => None,
            };
            self.made.insert(recipe, made);
        }
    }
}

/// Returns a text with a count, or `None` if the count is 0.
fn counted_face_text(seen: &PaneInput<'_>, text: InterfaceText, n: u64) -> Option<String> {
    (n > 0).then(|| fill_text_braces(seen.say_text(text), &[("n", &n)]))
}
