//! Signs that have only a notation, animated one at a time for display.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use chereme_corpus::CorpusError;

use super::library::library_data::SignMovement;
use super::without_movement::MovementAbsence;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::model::generated::GeneratedClip;
use crate::work::{WorkId, WorkOutcome, WorkResult, recombining};

/// How many animated signs are kept.
const MAX_KEPT_ANIMATIONS: usize = 80;

/// Signs animated from their notation.
#[derive(Debug, Default)]
pub(crate) struct AnimatedNotations {
    /// The animation in progress: its work, its token, and its gloss.
    making: Option<(WorkId, i64, String)>,
    /// By token: the animated sign, or the reason why the animation failed.
    made: BTreeMap<i64, Result<Arc<GeneratedClip>, String>>,
    /// The tokens in the order of their animation.
    order: VecDeque<i64>,
    /// The token and gloss to show on the stage as soon as it is animated.
    wanted: Option<(i64, String)>,
    /// The corpus generation of the failures in `made`.
    generation: i64,
}

impl AnimatedNotations {
    /// Returns the movement of a token; if it is missing, requests it, one token at a time.
    pub(crate) fn notated_clip(&mut self, token: i64, gloss: &str, out: &CommandOutbox) -> Option<Arc<GeneratedClip>> {
        if let Some(made) = self.made.get(&token) {
            return made.as_ref().ok().cloned();
        }
        let first = self.wanted.as_ref().is_none_or(|(id, _)| *id == token);
        if self.making.is_none() && first {
            let recipe = format!("token:{token}");
            let work = out.request_work(recombining::preview_recipe_job(recipe));
            self.making = Some((work, token, gloss.to_owned()));
        }
        None
    }

    /// Opens a token, to be shown on the stage.
    pub(crate) fn open_notated_sign(&mut self, token: i64, gloss: &str, out: &CommandOutbox) {
        self.wanted = Some((token, gloss.to_owned()));
        self.notated_clip(token, gloss, out);
    }

    /// Chooses a sign: shows it in its recording, or animates its notation; a sign without either is shown in the
    /// inspector alone.
    pub(crate) fn choose_notated_sign(&mut self, moves: SignMovement, token: i64, gloss: &str, out: &CommandOutbox) {
        match moves {
            SignMovement::Recorded(recording, span) => {
                out.send_command(WindowCommand::Made(None));
                out.send_command(WindowCommand::Place(recording, span));
                out.send_command(WindowCommand::Look);
            }
            SignMovement::Notated => {
                out.send_command(WindowCommand::Note(InspectedThing::Token(token)));
                self.open_notated_sign(token, gloss, out);
            }
            SignMovement::Not => {
                out.send_command(WindowCommand::Made(None));
                out.send_command(WindowCommand::Inspect(InspectedThing::Token(token)));
            }
        }
    }

    /// Chooses the sign with this citation form.
    pub(crate) fn choose_citation_sign(&mut self, seen: &PaneInput<'_>, token: i64) {
        let signs = &seen.snapshot.overview.signs;
        match signs.iter().find(|sign| sign.citation == Some(token)) {
            Some(sign) => self.choose_notated_sign(SignMovement::movement_of_sign(sign), token, &sign.gloss, seen.out),
            None => seen.send_command(WindowCommand::Inspect(InspectedThing::Token(token))),
        }
    }

    /// Shows the opened token on the stage once it is animated.
    pub(crate) fn show_opened_notation(&mut self, out: &CommandOutbox) {
        if let Some(made) = self.take_requested_animation(out) {
            out.send_command(WindowCommand::Made(Some(made)));
            out.send_command(WindowCommand::Look);
        }
    }

    /// Returns the movement to show on the stage, once; requests it if another animation was in progress.
    fn take_requested_animation(&mut self, out: &CommandOutbox) -> Option<Arc<GeneratedClip>> {
        let (token, gloss) = self.wanted.clone()?;
        let is_made = self.made.contains_key(&token);
        let made = self.notated_clip(token, &gloss, out);
        if is_made {
            self.wanted = None;
        }
        made
    }

    /// Returns the state of an opened token.
    pub(crate) fn movement_absence(&self, token: i64) -> Option<MovementAbsence> {
        match self.made.get(&token) {
            Some(Ok(_)) => Some(MovementAbsence::Animated),
            Some(Err(why)) => Some(MovementAbsence::Failed(why.clone())),
            None => self.wanted.is_some().then_some(MovementAbsence::Making),
        }
    }

    /// Forgets the failures if the corpus changed, so that they are tried again.
    pub(crate) fn forget_animation_failures(&mut self, generation: i64) {
        if std::mem::replace(&mut self.generation, generation) != generation {
            self.made.retain(|_, made| made.is_ok());
            let made = &self.made;
            self.order.retain(|token| made.contains_key(token));
        }
    }

    pub(crate) fn receive_animation_result(&mut self, id: WorkId, ended: &WorkResult) {
        let Some((_, token, gloss)) = self.making.take_if(|(making, ..)| *making == id) else {
            return;
        };
        let made = match ended {
            Ok(WorkOutcome::Previewed(made)) => Ok(Arc::new(GeneratedClip {
                name: gloss,
                ..GeneratedClip::from_notated_token(made, token)
            })),
            Err(CorpusError::Stopped) | Ok(_) => Err(String::new()),
            Err(error) => Err(error.to_string()),
        };
        self.made.insert(token, made);
        self.order.push_back(token);
        if self.order.len() > MAX_KEPT_ANIMATIONS
            && let Some(oldest) = self.order.pop_front()
        {
            self.made.remove(&oldest);
        }
    }
}

#[cfg(test)]
mod tests {
    use chereme_corpus::{Corpus, ProgressReceiver, ignore_progress_step};

    use super::*;
    use crate::work::CorpusJob;

    /// Returns the requested animations, each with its error in an empty corpus, which names the token.
    fn asked(out: &CommandOutbox) -> Vec<(WorkId, String)> {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = Corpus::create_corpus(&folder.path().join("empty.chereme"), "A");
        let mut corpus = corpus.expect("created");
        let mut fail = |job: CorpusJob| {
            let mut hear = ignore_progress_step;
            let ended = job.carry_out_job(&mut corpus, &mut ProgressReceiver::new(&mut hear));
            ended.expect_err("no token").to_string()
        };
        let commands = out.take_commands().into_iter();
        let work = commands.filter_map(|command| match command {
            WindowCommand::Work(id, job) => Some((id, fail(job))),
            _ => None,
        });
        work.collect()
    }

    #[test]
    fn signs_are_animated_one_at_a_time_and_failures_are_not_requested_again() {
        let (mut notated, out) = (AnimatedNotations::default(), CommandOutbox::default());
        assert!(notated.notated_clip(3, "A", &out).is_none());
        assert!(notated.notated_clip(4, "B", &out).is_none());
        let first = asked(&out);
        assert_eq!(first.len(), 1);
        assert!(first[0].1.contains("token:3"), "{}", first[0].1);
        notated.open_notated_sign(4, "B", &out);
        assert_eq!(notated.movement_absence(4), Some(MovementAbsence::Making));
        notated.receive_animation_result(first[0].0, &Err(CorpusError::from_wrong_message("no hand")));
        assert!(notated.notated_clip(3, "A", &out).is_none() && asked(&out).is_empty());
        assert_eq!(
            notated.movement_absence(3),
            Some(MovementAbsence::Failed("no hand".into()))
        );
        assert!(notated.notated_clip(5, "C", &out).is_none() && asked(&out).is_empty());
        assert!(notated.take_requested_animation(&out).is_none());
        let next = &asked(&out)[0].1;
        assert!(next.contains("token:4"), "what is waited for goes first: {next}");
        notated.forget_animation_failures(7);
        assert!(notated.made.is_empty());
    }
}
