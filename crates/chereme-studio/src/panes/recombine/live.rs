//! The preview: evaluates the current recipe, one evaluation at a time, the newest next. Slow evaluations that are
//! outdated are stopped, but never twice in a row, so that the user sees results during a drag.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::recipe::Report;
use chereme_corpus::remedy::Remedy;
use chereme_corpus::{Error, Meant, Recombination};

use super::stack::Stack;
use crate::command::Command;
use crate::context::Outbox;
use crate::work::recombining::{self, Draft};
use crate::work::{Ended, Outcome, WorkId};

/// The input of an evaluation.
#[derive(Debug, Clone, PartialEq)]
struct EvaluationRequest {
    text: String,
    /// The generation of the corpus, as the sources may change.
    generation: i64,
}

/// The part of the report about one card.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Note {
    pub(super) did: Vec<String>,
    /// The largest distance between the intended and the actual position of a wrist, in metres.
    pub(super) residual: Option<f64>,
    /// The offset by which a placement moved the hands, in metres to the left, up and forward.
    pub(super) moved: Option<[f64; 3]>,
}

/// Why the recipe cannot be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Trouble {
    pub(super) text: String,
    pub(super) remedy: Option<Remedy>,
    /// The name that was meant, if one near to a known one was written.
    pub(super) meant: Option<Meant>,
    /// The card with the problem.
    pub(super) card: Option<u64>,
}

/// How long an outdated evaluation may still take, in seconds.
const PATIENCE: f64 = 0.15;

/// The preview.
#[derive(Default)]
pub(super) struct Live {
    /// Whether to look everything up again.
    again: bool,
    /// Whether the running evaluation was stopped, and whether the one before it was.
    stopped: [bool; 2],
    /// The running evaluation, with the stack that maps the paths of its report to cards.
    running: Option<(WorkId, EvaluationRequest, Stack)>,
    /// When it was requested, in seconds of the window's clock.
    since: f64,
    /// Whether it ended and its result has not been followed up yet.
    fresh: bool,
    /// How long the last one took until it was followed up, in seconds.
    pub(super) took: f64,
    /// The last evaluation, which may have failed.
    of: Option<EvaluationRequest>,
    pub(super) made: Option<Arc<Recombination>>,
    pub(super) notes: BTreeMap<u64, Note>,
    pub(super) trouble: Option<Trouble>,
}

impl Live {
    /// Evaluates the recipe if it differs from the last evaluated one and no evaluation is running.
    ///
    /// `generation` is that of the corpus, `now` the time on the window's clock.
    pub(super) fn follow(
        &mut self,
        stack: &Stack,
        text: &str,
        (generation, now): (i64, f64),
        out: &mut Outbox,
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
            let overtaken = *running != wish && now - self.since > PATIENCE;
            if overtaken && self.stopped == [false; 2] {
                out.send(Command::Stop(*id));
                self.stopped[0] = true;
            }
            return;
        }
        let Some(draft) = self.next(&wish) else {
            return;
        };
        let id = out.work(recombining::draft(draft));
        self.running = Some((id, wish, stack.clone()));
        self.since = now;
    }

    /// Returns the evaluation to request; `None` if the last one had the same input.
    fn next(&mut self, wish: &EvaluationRequest) -> Option<Draft> {
        let again = std::mem::take(&mut self.again);
        (again || self.of.as_ref() != Some(wish)).then(|| Draft {
            recipe: wish.text.clone(),
            again,
        })
    }

    /// Makes the next evaluation look everything up again, even if the recipe is the same.
    pub(super) fn reload(&mut self) {
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
    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) -> bool {
        let Some((_, wish, stack)) = self.running.take_if(|(running, ..)| *running == id) else {
            return false;
        };
        self.fresh = true;
        self.stopped = [false, self.stopped[0]];
        if matches!(ended, Err(Error::Stopped)) {
            return true;
        }
        self.of = Some(wish);
        match ended {
            Ok(Outcome::Previewed(made)) => {
                self.notes = notes(&made.report, &stack);
                (self.made, self.trouble) = (Some(made.clone()), None);
            }
            Err(error) => {
                self.notes.clear();
                self.trouble = Some(trouble(error, &stack));
            }
            Ok(_) => {}
        }
        true
    }
}

/// Returns the report's note about each card, by the card's id.
pub(super) fn notes(report: &Report, stack: &Stack) -> BTreeMap<u64, Note> {
    let mut notes: BTreeMap<u64, Note> = BTreeMap::new();
    for step in &report.steps {
        let Some(at) = stack.card_at(&step.path) else {
            continue;
        };
        let note = notes.entry(stack.cards()[at].id).or_default();
        note.did.extend(step.did.iter().cloned());
        note.moved = step.moved.or(note.moved);
        note.residual = match (note.residual, step.residual) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
    }
    notes
}

fn trouble(error: &Error, stack: &Stack) -> Trouble {
    let step = match error {
        Error::Step(step) => Some(&**step),
        _ => None,
    };
    let text = step.map(|it| format!("{}: {}", it.step, it.cause));
    let at = step.and_then(|it| stack.card_at(&it.path));
    Trouble {
        text: text.unwrap_or_else(|| error.to_string()),
        remedy: error.remedy(),
        meant: error.meant().cloned(),
        card: at.map(|at| stack.cards()[at].id),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::FailedStep;
    use chereme_corpus::recipe::StepReport;

    fn stack(text: &str) -> Stack {
        Stack::of(&text.parse().expect("a recipe"))
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
        };
        let report = Report {
            steps: vec![
                step("/then/first/pipe/of", "read", None),
                step("/then/first/pipe/steps/0", "swapped", Some(0.002)),
                step("/then/next/0/node", "read too", None),
                step("/then/next/0", "joined", Some(0.001)),
            ],
            ..Report::default()
        };
        let notes = notes(&report, &stack);
        let of = |at: usize| &notes[&stack.cards()[at].id];
        assert_eq!(of(1).did, ["swapped"]);
        assert_eq!(of(2).did, ["read too", "joined"]);
        assert_eq!((of(1).residual, of(2).residual), (Some(0.002), Some(0.001)));
    }

    #[test]
    fn an_outdated_evaluation_is_stopped_once_and_an_equal_recipe_can_be_repeated() {
        let (mut live, mut out) = (Live::default(), Outbox::default());
        let stack = stack("A");
        let stops = |out: &mut Outbox| {
            let all = out.take().into_iter();
            all.filter(|it| matches!(it, Command::Stop(_))).count()
        };
        live.follow(&stack, "A", (1, 0.0), &mut out);
        live.follow(&stack, "A | swap", (1, 0.1), &mut out);
        assert_eq!(stops(&mut out), 0, "it may be ready soon");
        live.follow(&stack, "A | swap", (1, 0.2), &mut out);
        live.follow(&stack, "A | swap", (1, 0.3), &mut out);
        assert_eq!(stops(&mut out), 1);
        assert!(live.hear(WorkId(1), &Err(Error::Stopped)));
        assert!(live.trouble.is_none());
        live.follow(&stack, "A | swap", (1, 0.3), &mut out);
        live.follow(&stack, "A | reverse", (1, 0.9), &mut out);
        assert_eq!(stops(&mut out), 0, "not twice in a row");
        assert!(live.hear(WorkId(2), &Err(Error::wrong("no A"))));
        live.follow(&stack, "A | swap", (1, 1.0), &mut out);
        assert!(out.take().is_empty(), "it is known already");
        live.reload();
        let recipe = "A | swap".to_owned();
        let wish = EvaluationRequest {
            text: recipe.clone(),
            generation: 1,
        };
        let again = true;
        assert_eq!(live.next(&wish), Some(Draft { recipe, again }));
        live.reload();
        live.follow(&stack, "A | swap", (1, 1.0), &mut out);
        assert!(matches!(out.take()[..], [Command::Work(..)]));
    }

    #[test]
    fn one_recipe_is_evaluated_at_a_time_and_the_newest_next() {
        let (mut live, mut out) = (Live::default(), Outbox::default());
        let stack = stack("A");
        live.follow(&stack, "A", (1, 0.0), &mut out);
        live.follow(&stack, "A | swap", (1, 0.0), &mut out);
        live.follow(&stack, "A | swap | reverse", (1, 0.0), &mut out);
        assert_eq!(out.take().len(), 1);
        let failed = Err(Error::Step(Box::new(FailedStep {
            step: "A".to_owned(),
            path: "/pipe/of".to_owned(),
            cause: "there is none".to_owned(),
            remedy: "name another".into(),
            meant: None,
        })));
        assert!(!live.hear(WorkId(99), &failed));
        assert!(live.hear(WorkId(1), &failed));
        let trouble = live.trouble.clone().expect("trouble");
        assert_eq!(trouble.text, "A: there is none");
        live.follow(&stack, "A | swap | reverse", (1, 0.0), &mut out);
        assert_eq!(out.take().len(), 1);
        live.follow(&stack, "", (1, 0.0), &mut out);
        assert!(live.trouble.is_none());
    }
}
