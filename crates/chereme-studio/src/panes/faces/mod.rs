//! Faces: the recorded performances of an expression ranked for a sentence, played side by side, explained, and put on it.

mod choice;
mod data;
mod onsets;

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::{
    Address, Choice, DetectOptions, Detector, Expressions, FoundExpression, Function, Name,
    Nonmanuals, Onsets, ProposeScope, Rank, Ranked,
};
use eframe::egui::{Button, ScrollArea, Ui};

use self::data::Compared;
use super::{Pane, combo};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::generated::GeneratedClip;
use crate::words::{Text, faces as words, fill, spoken};
use crate::work::{Ended, Outcome, WorkId, analysis, faces};

/// How many candidates are shown.
const CANDIDATES: usize = 12;

/// The inputs of the displayed answer.
#[derive(Debug, Clone, PartialEq)]
struct Asked {
    generation: i64,
    function: Function,
    target: Address,
    rank: Rank,
    compared: Compared,
    lengths: bool,
}

/// The pane.
#[derive(Default)]
pub(crate) struct Faces {
    /// The corpus generation of the last request for expressions.
    of: Option<i64>,
    finding: Option<WorkId>,
    found: Option<Arc<Expressions>>,
    function: Option<Function>,
    /// The address of the sentence.
    sentence: Option<String>,
    rank: Rank,
    compared: Compared,
    lengths: bool,
    in_step: bool,
    carried: bool,
    wide: bool,
    asked: Option<Asked>,
    choosing: Option<WorkId>,
    choice: Option<Arc<Choice>>,
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
    onsets: Option<Arc<Onsets>>,
    begun: bool,
}

impl Faces {
    /// Requests the expressions, or the ranking, if their inputs changed.
    fn follow(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) {
        if !std::mem::replace(&mut self.begun, true) {
            (self.lengths, self.in_step) = (true, true);
        }
        let generation = seen.snapshot.overview.generation;
        if self.of != Some(generation) && !seen.is_running(self.finding) {
            self.of = Some(generation);
            self.finding = Some(out.work(faces::expressions()));
        }
        let Some(asked) = self.question(generation) else {
            return;
        };
        if self.asked.as_ref() == Some(&asked) || seen.is_running(self.choosing) {
            return;
        }
        let options = data::options(asked.rank, asked.compared, asked.lengths, CANDIDATES);
        let job = faces::choose(asked.function.clone(), asked.target.clone(), options);
        self.choosing = Some(out.work(job));
        self.made.clear();
        self.asked = Some(asked);
    }

    fn question(&self, generation: i64) -> Option<Asked> {
        Some(Asked {
            generation,
            function: self.function.clone()?,
            target: self.sentence.as_ref()?.parse().ok()?,
            rank: self.rank,
            compared: self.compared,
            lengths: self.lengths,
        })
    }

    fn expressions(&self) -> &[FoundExpression] {
        self.found.as_ref().map_or(&[], |it| &it.expressions)
    }

    /// Returns the sentences that can get a face: those with an expression of the function.
    fn sentences(&self) -> impl Iterator<Item = &FoundExpression> {
        let of = self.function.as_ref();
        self.expressions()
            .iter()
            .filter(move |it| Some(&it.function) == of)
    }

    /// Keeps function and sentence as long as they exist; otherwise chooses the displayed recording's, else the first.
    fn settle(&mut self, seen: &PaneInput<'_>) {
        let there = |it: &FoundExpression| Some(&it.function) == self.function.as_ref();
        if !self.expressions().iter().any(there) {
            self.function = self.expressions().first().map(|it| it.function.clone());
        }
        let sentence = self.sentence.as_deref();
        if self
            .sentences()
            .any(|it| Some(it.address.as_str()) == sentence)
        {
            return;
        }
        let shown = seen
            .shown
            .recording
            .and_then(|id| seen.snapshot.recording(id));
        let own = |it: &&FoundExpression| shown.is_some_and(|own| own.row.name == it.recording);
        let found = self.sentences().find(own).or(self.sentences().next());
        self.sentence = found.map(|it| it.address.clone());
    }

    fn tools(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        let functions: Vec<Function> = {
            let all = self.found.iter().flat_map(|it| it.functions.keys());
            all.map(|name| Function::of(name)).collect()
        };
        ui.horizontal_wrapped(|ui| {
            let names: Vec<(Option<Function>, String)> = functions
                .into_iter()
                .map(|it| (Some(it.clone()), it.to_string()))
                .collect();
            combo::named(ui, seen.say(words::FUNCTION), &mut self.function, &names);
            let sentences: Vec<(Option<String>, String)> = self
                .sentences()
                .map(|it| (Some(it.address.clone()), data::named(it)))
                .collect();
            combo::named(
                ui,
                seen.say(words::SENTENCE),
                &mut self.sentence,
                &sentences,
            );
            let ranks = [
                (Rank::Nearest, words::NEAREST),
                (Rank::Farthest, words::FARTHEST),
                (Rank::Medoid, words::MEDOID),
            ]
            .map(|(it, text)| (it, seen.say(text).to_owned()));
            combo::named(ui, seen.say(words::FIRST), &mut self.rank, &ranks);
            let compared = Compared::ALL.map(|it| (it, seen.say(name(it)).to_owned()));
            combo::named(ui, seen.say(words::COMPARED), &mut self.compared, &compared);
            for (on, text, tip) in [
                (&mut self.lengths, words::LENGTHS, words::LENGTHS_TIP),
                (&mut self.in_step, words::IN_STEP, words::IN_STEP_TIP),
                (&mut self.carried, words::CARRIED, words::CARRIED_TIP),
            ] {
                ui.checkbox(on, seen.say(text)).on_hover_text(seen.say(tip));
            }
            let mut close = !self.wide;
            ui.checkbox(&mut close, seen.say(words::CLOSE))
                .on_hover_text(seen.say(words::CLOSE_TIP));
            self.wide = !close;
            if seen.is_running(self.choosing) || seen.is_running(self.finding) {
                ui.spinner();
            }
        });
    }

    /// Shows the milestones of the sentence, and the button that writes them onto a tier.
    fn milestones(&self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let sentence = self.sentence.as_deref();
        let found = self
            .sentences()
            .find(|it| Some(it.address.as_str()) == sentence);
        let Some(it) = found else { return };
        ui.horizontal_wrapped(|ui| {
            ui.strong(seen.say(words::MILESTONES));
            let times = it.milestones.times();
            for (n, at) in times.into_iter().enumerate() {
                let text = match (n, it.milestones.m3) {
                    (2, None) => "M3 –".to_owned(),
                    _ => format!("M{} {:.3}", n + 1, at.seconds()),
                };
                ui.monospace(text);
            }
            ui.weak(seen.say(match it.corrected {
                true => words::CORRECTED,
                false => words::DERIVED,
            }));
            let recording = seen.snapshot.recording_named(&it.recording);
            if ui.small_button(seen.say(words::SHOW)).clicked()
                && let Some(recording) = recording
            {
                out.send(Command::Place(
                    recording.row.id,
                    data::seen_span(&it.milestones),
                ));
                out.send(Command::Look);
            }
            let open = !seen.snapshot.is_read_only();
            let write = ui.add_enabled(open, Button::new(seen.say(words::WRITE)).small());
            if write.on_hover_text(seen.say(words::WRITE_TIP)).clicked() {
                out.work(faces::milestones(it.function.clone()));
            }
        });
        for finding in &it.findings {
            ui.weak(crate::words::spoken(finding, seen.language));
        }
    }

    fn proposing(&self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        let recording = seen.shown.recording;
        let open = recording.is_some() && !seen.snapshot.is_read_only();
        let button = ui.add_enabled(open, Button::new(seen.say(words::PROPOSE)));
        if button.on_hover_text(seen.say(words::PROPOSE_TIP)).clicked()
            && let Some(id) = recording
        {
            out.work(analysis::detect(
                DetectOptions {
                    detector: Nonmanuals.name().to_owned(),
                    scope: ProposeScope::Recording(Name::Number(id)),
                },
                seen.language,
            ));
        }
    }

    /// Chooses a performance and proposes a gloss for the sentence with its face.
    fn choose(&mut self, it: &Ranked) {
        self.chosen = Some(it.token.clone());
        let Some(choice) = self.choice.clone() else {
            return;
        };
        let sentence = self.sentence_name(&choice);
        let proposed = data::proposed_gloss(&choice, &sentence, &it.recording);
        if self.gloss.trim().is_empty() || self.gloss == self.proposed {
            self.gloss.clone_from(&proposed);
        }
        self.proposed = proposed;
    }

    fn sentence_name(&self, choice: &Choice) -> String {
        let own = self
            .expressions()
            .iter()
            .find(|it| it.address == choice.target);
        own.map_or_else(|| choice.target.clone(), |it| it.recording.clone())
    }

    fn chosen<'a>(&self, choice: &'a Choice) -> Option<&'a Ranked> {
        let chosen = self.chosen.as_deref()?;
        choice.ranking.iter().find(|it| it.token == chosen)
    }
}

fn name(compared: Compared) -> Text {
    match compared {
        Compared::Usual => words::USUAL,
        Compared::Head => words::HEAD,
        Compared::Brows => words::BROWS,
        Compared::All => words::WHOLE,
    }
}

impl Pane for Faces {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.settle(seen);
        self.follow(seen, out);
        // Without an expression there is nothing to choose from.
        let nothing = |it: &Arc<Expressions>| it.expressions.is_empty();
        if !self.found.as_ref().is_some_and(nothing) {
            self.tools(ui, seen);
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if let Some(found) = &self.found
                && found.expressions.is_empty()
            {
                ui.label(seen.say(words::NONE));
                self.proposing(ui, seen, out);
                return;
            }
            self.milestones(ui, seen, out);
            if let Some(wrong) = &self.wrong {
                ui.colored_label(seen.colours().warning, spoken(wrong, seen.language));
            }
            if let Some(choice) = self.choice.clone() {
                self.candidates(ui, seen, &choice, out);
                self.show_counts(ui, seen, &choice);
                self.reasons(ui, seen, &choice);
                self.putting(ui, seen, &choice, out);
            }
            ui.separator();
            self.timing(ui, seen, out);
            self.proposing(ui, seen, out);
        });
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.finding.take_if(|it| *it == id).is_some() {
            if let Ok(Outcome::Expressions(found)) = ended {
                self.found = Some(found.clone());
            }
        } else if self.choosing.take_if(|it| *it == id).is_some() {
            match ended {
                Ok(Outcome::Chosen(choice)) => {
                    self.wrong = None;
                    let kept = self.chosen(choice).or(choice.ranking.first()).cloned();
                    self.choice = Some(choice.clone());
                    if let Some(first) = kept {
                        self.choose(&first);
                    }
                }
                Err(error) => {
                    self.choice = None;
                    self.wrong = Some(error.to_string());
                }
                Ok(_) => {}
            }
        } else if self.storing.take_if(|it| *it == id).is_some() {
            if let Ok(Outcome::Recombined(made)) = ended {
                self.stored = made.recording.map(|it| (made.gloss.clone(), it));
            }
        } else if self.measuring.take_if(|it| *it == id).is_some() {
            match ended {
                Ok(Outcome::Onsets(onsets)) => self.onsets = Some(onsets.clone()),
                Err(error) => self.wrong = Some(error.to_string()),
                Ok(_) => {}
            }
        } else if let Some(recipe) = self.carrying.remove(&id) {
            let made = match ended {
                Ok(Outcome::Previewed(made)) => Some(Arc::new(GeneratedClip::of(made))),
                _ => None,
            };
            self.made.insert(recipe, made);
        }
    }
}

/// Returns a text with a count, or `None` if the count is 0.
fn counted(seen: &PaneInput<'_>, text: Text, n: u64) -> Option<String> {
    (n > 0).then(|| fill(seen.say(text), &[("n", &n)]))
}
