//! Jobs on the whole corpus: its history, merging and checking.

use std::path::PathBuf;

use chereme_corpus::{ConflictDecision, ProgressStep, ProgressUnit};

use super::{CorpusJob, JobAbout, WorkOutcome};
use crate::words::shell;

/// Undoes the newest operation (`back`), or redoes the last undone one.
pub(crate) fn undo_or_redo(back: bool) -> CorpusJob {
    CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |corpus, _| {
        if back {
            corpus.undo_operation().map(WorkOutcome::Undone)
        } else {
            corpus.redo_operation().map(WorkOutcome::Redone)
        }
    })
}

/// Undoes (`back`) or redoes several operations one after the other; if it is stopped, the finished ones stay.
pub(crate) fn walk_operations_job(back: bool, steps: usize) -> CorpusJob {
    CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |corpus, progress| {
        for done in 0..steps {
            progress.report_step(ProgressStep {
                task: "",
                done: done as u64,
                total: Some(steps as u64),
                unit: ProgressUnit::Items,
            })?;
            if back {
                corpus.undo_operation()?;
            } else {
                corpus.redo_operation()?;
            }
        }
        Ok(WorkOutcome::Walked { back, steps })
    })
}

/// Merges another corpus into this one.
pub(crate) fn merge_corpus_job(other: PathBuf) -> CorpusJob {
    let about = JobAbout {
        task: shell::TASK_MERGE,
        quiet: true,
        may_stop: true,
        ..JobAbout::EDIT_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        corpus.merge_corpus(&other, None, progress).map(WorkOutcome::Merged)
    })
}

/// Decides the conflict of a merge with that number.
pub(crate) fn decide_conflict_job(number: usize, decision: ConflictDecision) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.decide_conflicts(&[number], decision))
}

/// Checks the corpus, and mends what can be mended if `mend` is set.
pub(crate) fn check_corpus_job(mend: bool) -> CorpusJob {
    CorpusJob::new_long_job(shell::TASK_CHECK, move |corpus, progress| {
        let report = corpus.check_corpus(false, progress)?;
        let mended = match mend && !report.ok {
            true => corpus.check_corpus(true, progress)?,
            false => report,
        };
        Ok(WorkOutcome::Checked(mended))
    })
}
