//! Jobs on the whole corpus: its history and merging.

use std::path::PathBuf;

use chereme_corpus::{Decision, Step, Unit};

use super::{About, Job, Outcome};
use crate::words::shell;

/// Undoes the newest operation (`back`), or redoes the last undone one.
pub(crate) fn undo_or_redo(back: bool) -> Job {
    Job::new(About::EDIT, move |corpus, _| {
        if back {
            corpus.undo().map(Outcome::Undone)
        } else {
            corpus.redo().map(Outcome::Redone)
        }
    })
}

/// Undoes (`back`) or redoes several operations one after the other; if it is stopped, the finished ones stay.
pub(crate) fn walk(back: bool, steps: usize) -> Job {
    Job::new(About::EDIT, move |corpus, progress| {
        for done in 0..steps {
            progress.report(Step {
                task: "",
                done: done as u64,
                total: Some(steps as u64),
                unit: Unit::Items,
            })?;
            if back {
                corpus.undo()?;
            } else {
                corpus.redo()?;
            }
        }
        Ok(Outcome::Walked { back, steps })
    })
}

/// Merges another corpus into this one.
pub(crate) fn merge(other: PathBuf) -> Job {
    let about = About {
        task: shell::TASK_MERGE,
        quiet: true,
        may_stop: true,
        ..About::EDIT
    };
    Job::new(about, move |corpus, progress| {
        corpus.merge(&other, None, progress).map(Outcome::Merged)
    })
}

/// Decides the conflict of a merge with that number.
pub(crate) fn decide(number: usize, decision: Decision) -> Job {
    Job::change(move |corpus, _| corpus.decide(&[number], decision))
}
