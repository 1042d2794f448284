//! Signs that have only a notation, animated one at a time for display.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use chereme_corpus::Error;

use super::inspector::Thing;
use super::library::data::Moves;
use super::without_movement::Bare;
use crate::command::Command;
use crate::context::Outbox;
use crate::model::generated::GeneratedClip;
use crate::work::{Ended, Outcome, WorkId, recombining};

/// How many animated signs are kept.
const KEPT: usize = 80;

/// Signs animated from their notation.
#[derive(Debug, Default)]
pub(crate) struct Notated {
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

impl Notated {
    /// Returns the movement of a token; if it is missing, requests it, one token at a time.
    pub(crate) fn get(
        &mut self,
        token: i64,
        gloss: &str,
        out: &mut Outbox,
    ) -> Option<Arc<GeneratedClip>> {
        if let Some(made) = self.made.get(&token) {
            return made.as_ref().ok().cloned();
        }
        let first = self.wanted.as_ref().is_none_or(|(id, _)| *id == token);
        if self.making.is_none() && first {
            let recipe = format!("token:{token}");
            let work = out.work(recombining::preview(recipe));
            self.making = Some((work, token, gloss.to_owned()));
        }
        None
    }

    /// Opens a token, to be shown on the stage.
    pub(crate) fn open(&mut self, token: i64, gloss: &str, out: &mut Outbox) {
        self.wanted = Some((token, gloss.to_owned()));
        self.get(token, gloss, out);
    }

    /// Chooses a sign: shows it in its recording, or animates its notation; a sign without either is shown in the
    /// inspector alone.
    pub(crate) fn choose(&mut self, moves: Moves, (token, gloss): (i64, &str), out: &mut Outbox) {
        match moves {
            Moves::Recorded(recording, span) => {
                out.send(Command::Made(None));
                out.send(Command::Place(recording, span));
                out.send(Command::Look);
            }
            Moves::Notated => {
                out.send(Command::Note(Thing::Token(token)));
                self.open(token, gloss, out);
            }
            Moves::Not => {
                out.send(Command::Made(None));
                out.send(Command::Inspect(Thing::Token(token)));
            }
        }
    }

    /// Shows the opened token on the stage once it is animated.
    pub(crate) fn show(&mut self, out: &mut Outbox) {
        if let Some(made) = self.wanted(out) {
            out.send(Command::Made(Some(made)));
            out.send(Command::Look);
        }
    }

    /// Returns the movement to show on the stage, once; requests it if another animation was in progress.
    fn wanted(&mut self, out: &mut Outbox) -> Option<Arc<GeneratedClip>> {
        let (token, gloss) = self.wanted.clone()?;
        let known = self.made.contains_key(&token);
        let made = self.get(token, &gloss, out);
        if known {
            self.wanted = None;
        }
        made
    }

    /// Returns the state of an opened token.
    pub(crate) fn bare(&self, token: i64) -> Option<Bare> {
        match self.made.get(&token) {
            Some(Ok(_)) => Some(Bare::Animated),
            Some(Err(why)) => Some(Bare::Failed(why.clone())),
            None => self.wanted.is_some().then_some(Bare::Making),
        }
    }

    /// Forgets the failures if the corpus changed, so that they are tried again.
    pub(crate) fn follow(&mut self, generation: i64) {
        if std::mem::replace(&mut self.generation, generation) != generation {
            self.made.retain(|_, made| made.is_ok());
            let made = &self.made;
            self.order.retain(|token| made.contains_key(token));
        }
    }

    pub(crate) fn hear(&mut self, id: WorkId, ended: &Ended) {
        let Some((_, token, gloss)) = self.making.take_if(|(making, ..)| *making == id) else {
            return;
        };
        let made = match ended {
            Ok(Outcome::Previewed(made)) => Ok(Arc::new(GeneratedClip {
                name: gloss,
                ..GeneratedClip::notated(made, token)
            })),
            Err(Error::Stopped) | Ok(_) => Err(String::new()),
            Err(error) => Err(error.to_string()),
        };
        self.made.insert(token, made);
        self.order.push_back(token);
        if self.order.len() > KEPT
            && let Some(oldest) = self.order.pop_front()
        {
            self.made.remove(&oldest);
        }
    }
}

#[cfg(test)]
mod tests {
    use chereme_corpus::{Corpus, Progress, unheard};

    use super::*;
    use crate::work::Job;

    /// Returns the requested animations, each with its error in an empty corpus, which names the token.
    fn asked(out: &mut Outbox) -> Vec<(WorkId, String)> {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = Corpus::create(&folder.path().join("empty.chereme"), "A");
        let mut corpus = corpus.expect("created");
        let mut fail = |job: Job| {
            let mut hear = unheard;
            let ended = job.carry_out(&mut corpus, &mut Progress::new(&mut hear));
            ended.expect_err("no token").to_string()
        };
        let commands = out.take().into_iter();
        let work = commands.filter_map(|command| match command {
            Command::Work(id, job) => Some((id, fail(job))),
            _ => None,
        });
        work.collect()
    }

    #[test]
    fn signs_are_animated_one_at_a_time_and_failures_are_not_requested_again() {
        let (mut notated, mut out) = (Notated::default(), Outbox::default());
        assert!(notated.get(3, "A", &mut out).is_none());
        assert!(notated.get(4, "B", &mut out).is_none());
        let first = asked(&mut out);
        assert_eq!(first.len(), 1);
        assert!(first[0].1.contains("token:3"), "{}", first[0].1);
        notated.open(4, "B", &mut out);
        assert_eq!(notated.bare(4), Some(Bare::Making));
        notated.hear(first[0].0, &Err(Error::wrong("no hand")));
        assert!(notated.get(3, "A", &mut out).is_none() && asked(&mut out).is_empty());
        assert_eq!(notated.bare(3), Some(Bare::Failed("no hand".into())));
        assert!(notated.get(5, "C", &mut out).is_none() && asked(&mut out).is_empty());
        assert!(notated.wanted(&mut out).is_none());
        let next = &asked(&mut out)[0].1;
        assert!(
            next.contains("token:4"),
            "what is waited for goes first: {next}"
        );
        notated.follow(7);
        assert!(notated.made.is_empty());
    }
}
