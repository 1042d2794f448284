//! Signs that are only notated, made one at a time so that they can be looked at.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use crate::context::Outbox;
use crate::model::made::Made;
use crate::work::{Ended, Outcome, Work, WorkId};

/// How many made signs are kept.
const KEPT: usize = 60;

/// Signs made of their notation.
#[derive(Debug, Default)]
pub(super) struct Notated {
    /// What is being made, of which token.
    making: Option<(WorkId, i64)>,
    /// By token; nothing where it could not be made.
    made: BTreeMap<i64, Option<Arc<Made>>>,
    /// The tokens in the order in which they were made.
    order: VecDeque<i64>,
    /// The token that is to be shown on the stage as soon as it is there.
    wanted: Option<i64>,
}

impl Notated {
    /// Returns the movement of a token; where it is not there it is made, one at a time.
    pub(super) fn get(&mut self, token: i64, out: &mut Outbox) -> Option<Arc<Made>> {
        if let Some(made) = self.made.get(&token) {
            return made.clone();
        }
        if self.making.is_none() {
            let recipe = format!("sigml \"token:{token}\"");
            self.making = Some((out.work(Work::Preview(recipe)), token));
        }
        None
    }

    /// Has a token shown on the stage.
    pub(super) fn open(&mut self, token: i64, out: &mut Outbox) {
        self.wanted = Some(token);
        self.get(token, out);
    }

    /// Returns what is to be shown on the stage now, once; asks for it where another was being made.
    pub(super) fn wanted(&mut self, out: &mut Outbox) -> Option<Arc<Made>> {
        let token = self.wanted?;
        let known = self.made.contains_key(&token);
        let made = self.get(token, out);
        if known {
            self.wanted = None;
        }
        made
    }

    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) {
        let Some((_, token)) = self.making.filter(|(making, _)| *making == id) else {
            return;
        };
        self.making = None;
        let made = match ended {
            Ok(Outcome::Previewed(made)) => Some(Arc::new(Made::notated(made, token))),
            _ => None,
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
    use super::*;
    use crate::command::Command;
    use chereme_corpus::Error;

    fn asked(out: &mut Outbox) -> Vec<(WorkId, String)> {
        let commands = out.take().into_iter();
        let work = commands.filter_map(|command| match command {
            Command::Work(id, Work::Preview(recipe)) => Some((id, recipe)),
            _ => None,
        });
        work.collect()
    }

    #[test]
    fn signs_are_made_one_at_a_time_and_what_cannot_be_made_is_not_asked_for_again() {
        let (mut notated, mut out) = (Notated::default(), Outbox::default());
        assert!(notated.get(3, &mut out).is_none());
        assert!(notated.get(4, &mut out).is_none());
        let first = asked(&mut out);
        assert_eq!(first.len(), 1);
        assert_eq!(first[0].1, "sigml \"token:3\"");
        notated.open(4, &mut out);
        notated.hear(first[0].0, &Err(Error::Stopped));
        assert!(notated.get(3, &mut out).is_none() && asked(&mut out).is_empty());
        assert!(notated.wanted(&mut out).is_none());
        assert_eq!(asked(&mut out)[0].1, "sigml \"token:4\"");
        assert_eq!(notated.wanted, Some(4));
    }
}
