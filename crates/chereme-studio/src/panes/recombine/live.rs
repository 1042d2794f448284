//! The preview: evaluates the current recipe, one evaluation at a time, the newest next. Slow evaluations that are
//! outdated are stopped, but never twice in a row, so that the user sees results during a drag.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::recipe::GenerationReport;
use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::{CorpusError, MeantName, RecombinationResult};

use super::stack::CardStack;
use crate::command::{CommandOutbox, WindowCommand};
use crate::work::recombining::{self, OpenRecipeDraft};
use crate::work::{WorkId, WorkOutcome, WorkResult};

/// The input of an evaluation.
#[derive(Debug, Clone, PartialEq)]
struct EvaluationRequest {
    text: String,
    /// The generation of the corpus, as the sources may change.
    generation: i64,
}

/// The part of the report about one card.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct CardNote {
    pub(super) did: Vec<String>,
    /// The largest distance between the intended and the actual position of a wrist, in metres.
    pub(super) residual: Option<f64>,
    /// The offset by which a placement moved the hands, in metres to the left, up and forward.
    pub(super) moved: Option<[f64; 3]>,
}

/// Why the recipe cannot be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecipeTrouble {
    pub(super) text: String,
    pub(super) remedy: Option<ErrorRemedy>,
    /// The name that was meant, if one near to a known one was written.
    pub(super) meant: Option<MeantName>,
    /// The card with the problem.
    pub(super) card: Option<u64>,
}

/// How long an outdated evaluation may still take, in seconds.
const EVALUATION_PATIENCE_SECONDS: f64 = 0.15;

/// The preview.
#[derive(Default)]
pub(super) struct RecipePreview {
    /// Whether to look everything up again.
    again: bool,
    /// Whether the running evaluation was stopped, and whether the one before it was.
    stopped: [bool; 2],
    /// The running evaluation, with the stack that maps the paths of its report to cards.
    running: Option<(WorkId, EvaluationRequest, CardStack)>,
    /// When it was requested, in seconds of the window's clock.
    since: f64,
    /// Whether it ended and its result has not been followed up yet.
    fresh: bool,
    /// How long the last one took until it was followed up, in seconds.
    pub(super) took: f64,
    /// The last evaluation, which may have failed.
    of: Option<EvaluationRequest>,
    pub(super) made: Option<Arc<RecombinationResult>>,
    pub(super) notes: BTreeMap<u64, CardNote>,
    pub(super) trouble: Option<RecipeTrouble>,
}

impl RecipePreview {
    /// Evaluates the recipe if it differs from the last evaluated one and no evaluation is running.
    ///
    /// `generation` is that of the corpus, `now` the time on the window's clock.
    pub(super) fn evaluate_changed_recipe(
        &mut self,
        stack: &CardStack,
        text: &str,
        generation: i64,
        now: f64,
        out: &CommandOutbox,
    ) {
        if std::mem::take(&mut self.fresh) {
            self.took = now - self.since;
        }
        let wish = EvaluationRequest {
            text: text.to_owned(),
            generation,
        };
        if wish.text.is_empty() {
            (self.of, self.made, self.trouble) = (None, None, None);
            self.notes.clear();
            return;
        }
        if let Some((id, running, _)) = &self.running {
            // A running evaluation is soon done and shows something; only a long one is stopped for a newer recipe.
            let overtaken = *running != wish && now - self.since > EVALUATION_PATIENCE_SECONDS;
            if overtaken && self.stopped == [false; 2] {
                out.send_command(WindowCommand::Stop(*id));
                self.stopped[0] = true;
            }
            return;
        }
        let Some(draft) = self.next(&wish) else {
            return;
        };
        let id = out.request_work(recombining::evaluate_draft_job(draft));
        self.running = Some((id, wish, stack.clone()));
        self.since = now;
    }

    /// Returns the evaluation to request; `None` if the last one had the same input.
    fn next(&mut self, wish: &EvaluationRequest) -> Option<OpenRecipeDraft> {
        let is_repeated = std::mem::take(&mut self.again);
        (is_repeated || self.of.as_ref() != Some(wish)).then(|| OpenRecipeDraft {
            recipe: wish.text.clone(),
            again: is_repeated,
        })
    }

    /// Makes the next evaluation look everything up again, even if the recipe is the same.
    pub(super) fn reload_recipe_preview(&mut self) {
        self.again = true;
    }

    /// Returns whether an evaluation ended that has not been followed up yet.
    pub(super) fn has_news(&self) -> bool {
        self.fresh
    }

    /// Returns whether an evaluation is running.
    pub(super) fn is_making(&self) -> bool {
        self.running.is_some()
    }

    /// Handles the result of work; returns whether it was the preview.
    pub(super) fn receive_preview_result(&mut self, id: WorkId, ended: &WorkResult) -> bool {
        let Some((_, wish, stack)) = self.running.take_if(|(running, ..)| *running == id) else {
            return false;
        };
        self.fresh = true;
        self.stopped = [false, self.stopped[0]];
        if matches!(ended, Err(CorpusError::Stopped)) {
            return true;
        }
        self.of = Some(wish);
        match ended {
            Ok(WorkOutcome::Previewed(made)) => {
                self.notes = card_notes_by_id(&made.report, &stack);
                (self.made, self.trouble) = (Some(made.clone()), None);
            }
            Err(error) => {
                self.notes.clear();
                self.trouble = Some(locate_recipe_trouble(error, &stack));
            }
            Ok(_) => {}
        }
        true
    }
}

/// Returns the report's note about each card, by the card's id.
pub(super) fn card_notes_by_id(report: &GenerationReport, stack: &CardStack) -> BTreeMap<u64, CardNote> {
    let mut notes: BTreeMap<u64, CardNote> = BTreeMap::new();
    for step in &report.steps {
        let Some(at) = stack.card_at(&step.path) else {
            continue;
        };
        let note = notes.entry(stack.stack_cards()[at].id).or_default();
        note.did.extend(step.did.iter().cloned());
        note.moved = step.moved.or(note.moved);
        note.residual = match (note.residual, step.residual) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
    }
    notes
}

fn locate_recipe_trouble(error: &CorpusError, stack: &CardStack) -> RecipeTrouble {
    let step = match error {
        CorpusError::Step(step) => Some(&**step),
        _ => None,
    };
    let text = step.map(|failure| format!("{}: {}", failure.step, failure.cause));
    let card_index = step.and_then(|failure| stack.card_at(&failure.path));
    RecipeTrouble {
        text: text.unwrap_or_else(|| error.to_string()),
        remedy: error.error_remedy(),
        meant: error.meant_name().cloned(),
        card: card_index.map(|at| stack.stack_cards()[at].id),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::FailedStep;
    use chereme_corpus::recipe::StepReport;

    fn stack(text: &str) -> CardStack {
        CardStack::from_stack_recipe(&text.parse().expect("a recipe"))
    }

    #[test]
    fn each_step_report_is_shown_on_its_card() {
        let stack = stack("A | swap then B");
        let step = |path: &str, did: &str, residual| StepReport {
            path: path.into(),
            step: String::new(),
            did: vec![did.into()],
            residual,
            moved: None,
            language: None,
            hands: Vec::new(),
            touches: Vec::new(),
        };
        let report = GenerationReport {
            steps: vec![
                step("/then/first/pipe/of", "read", None),
                step("/then/first/pipe/steps/0", "swapped", Some(0.002)),
                step("/then/next/0/node", "read too", None),
                step("/then/next/0", "joined", Some(0.001)),
            ],
            ..GenerationReport::default()
        };
        let notes = card_notes_by_id(&report, &stack);
        let of = |at: usize| &notes[&stack.stack_cards()[at].id];
        assert_eq!(of(1).did, ["swapped"]);
        assert_eq!(of(2).did, ["read too", "joined"]);
        assert_eq!((of(1).residual, of(2).residual), (Some(0.002), Some(0.001)));
    }

    #[test]
    fn an_outdated_evaluation_is_stopped_once_and_an_equal_recipe_can_be_repeated() {
        let (mut live, out) = (RecipePreview::default(), CommandOutbox::default());
        let stack = stack("A");
        let stops = |out: &CommandOutbox| {
            let all = out.take_commands().into_iter();
            all.filter(|it| matches!(it, WindowCommand::Stop(_))).count()
        };
        live.evaluate_changed_recipe(&stack, "A", 1, 0.0, &out);
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 0.1, &out);
        assert_eq!(stops(&out), 0, "it may be ready soon");
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 0.2, &out);
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 0.3, &out);
        assert_eq!(stops(&out), 1);
        assert!(live.receive_preview_result(WorkId(1), &Err(CorpusError::Stopped)));
        assert!(live.trouble.is_none());
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 0.3, &out);
        live.evaluate_changed_recipe(&stack, "A | reverse", 1, 0.9, &out);
        assert_eq!(stops(&out), 0, "not twice in a row");
        assert!(live.receive_preview_result(WorkId(2), &Err(CorpusError::from_wrong_message("no A"))));
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 1.0, &out);
        assert!(out.take_commands().is_empty(), "it is known already");
        live.reload_recipe_preview();
        let recipe = "A | swap".to_owned();
        let wish = EvaluationRequest {
            text: recipe.clone(),
            generation: 1,
        };
        let again = true;
        assert_eq!(live.next(&wish), Some(OpenRecipeDraft { recipe, again }));
        live.reload_recipe_preview();
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 1.0, &out);
        assert!(matches!(out.take_commands()[..], [WindowCommand::Work(..)]));
    }

    #[test]
    fn one_recipe_is_evaluated_at_a_time_and_the_newest_next() {
        let (mut live, out) = (RecipePreview::default(), CommandOutbox::default());
        let stack = stack("A");
        live.evaluate_changed_recipe(&stack, "A", 1, 0.0, &out);
        live.evaluate_changed_recipe(&stack, "A | swap", 1, 0.0, &out);
        live.evaluate_changed_recipe(&stack, "A | swap | reverse", 1, 0.0, &out);
        assert_eq!(out.take_commands().len(), 1);
        let failed = Err(CorpusError::Step(Box::new(FailedStep {
            step: "A".to_owned(),
            path: "/pipe/of".to_owned(),
            cause: "there is none".to_owned(),
            remedy: "name another".into(),
            meant: None,
        })));
        assert!(!live.receive_preview_result(WorkId(99), &failed));
        assert!(live.receive_preview_result(WorkId(1), &failed));
        let trouble = live.trouble.clone().expect("trouble");
        assert_eq!(trouble.text, "A: there is none");
        live.evaluate_changed_recipe(&stack, "A | swap | reverse", 1, 0.0, &out);
        assert_eq!(out.take_commands().len(), 1);
        live.evaluate_changed_recipe(&stack, "", 1, 0.0, &out);
        assert!(live.trouble.is_none());
    }
}
