//! Work on other threads: each use case of the corpus is a [`CorpusJob`], a value that a thread carries out.
//!
//! Each use case is one function in a module by theme, which states its [`JobAbout`] and the call of the corpus; one that
//! needs only the selection is a closure in its row of the table of actions. The call is a
//! boxed closure, as a closure owns its arguments without naming them again; a trait would need a struct, its fields and
//! an `impl` for each use case. Nothing can look into a job: a pane that needs its request later remembers it beside the
//! [`WorkId`].
//!
//! [`WorkOutcome`] is an enum, as it has many readers: the notices match on a dozen of its variants, and each pane takes its own.

pub(crate) mod analysis;
pub(crate) mod begin;
pub(crate) mod comparing;
pub(crate) mod desk;
pub(crate) mod editing;
pub(crate) mod exchange;
pub(crate) mod faces_jobs;
pub(crate) mod movement_jobs;
mod outcome_jobs;
pub(crate) mod recombining;
pub(crate) mod recordings_jobs;
pub(crate) mod searching;
pub(crate) mod studying;
pub(crate) mod whole_corpus;

use std::fmt;

use chereme_corpus::{Corpus, CorpusResult, ProgressReceiver, ProgressUnit};

pub(crate) use outcome_jobs::WorkOutcome;

use crate::words::{InterfaceText, shell};

/// Serial number of a piece of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct WorkId(pub(crate) u64);

/// A use case of the corpus with its arguments, to be carried out once.
pub(crate) struct CorpusJob {
    about: JobAbout,
    call: Box<JobCall>,
}

type JobCall = dyn FnOnce(&mut Corpus, &mut ProgressReceiver<'_>) -> CorpusResult<WorkOutcome> + Send;

/// The properties of a job that the window needs while it waits, runs and ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JobAbout {
    pub(crate) lane: WorkLane,
    /// The title of the job while it runs.
    pub(crate) task: InterfaceText,
    /// Whether the pane that requested it shows errors itself.
    pub(crate) quiet: bool,
    /// Whether the job may be stopped when the window closes; edits must be stored.
    pub(crate) may_stop: bool,
}

impl JobAbout {
    /// A change of the corpus.
    const EDIT_JOB_ABOUT: Self = Self {
        lane: WorkLane::Edit,
        task: shell::TASK_EDIT,
        quiet: false,
        may_stop: false,
    };
    /// A query that the user waits for.
    const ASK_JOB_ABOUT: Self = Self {
        lane: WorkLane::Ask,
        task: shell::TASK_SEARCH,
        quiet: true,
        may_stop: true,
    };
    /// The evaluation of a recipe that stores nothing.
    const PREVIEW_JOB_ABOUT: Self = Self {
        lane: WorkLane::Make,
        task: shell::TASK_RECOMBINE,
        quiet: true,
        may_stop: true,
    };
    /// Movement for little figures.
    const LITTLE_FIGURE_JOB_ABOUT: Self = Self {
        lane: WorkLane::Little,
        task: shell::TASK_MOVEMENT,
        quiet: false,
        may_stop: true,
    };
    /// The writing of files.
    const WRITE_JOB_ABOUT: Self = Self {
        lane: WorkLane::Export,
        task: shell::TASK_EXPORT,
        quiet: false,
        may_stop: true,
    };
}

impl CorpusJob {
    fn new(
        about: JobAbout,
        call: impl FnOnce(&mut Corpus, &mut ProgressReceiver<'_>) -> CorpusResult<WorkOutcome> + Send + 'static,
    ) -> Self {
        let call = Box::new(call);
        Self { about, call }
    }

    /// Returns an edit whose whole result is in the next snapshot.
    pub(crate) fn new_change_job<T>(
        call: impl FnOnce(&mut Corpus, &mut ProgressReceiver<'_>) -> CorpusResult<T> + Send + 'static,
    ) -> Self {
        Self::new(JobAbout::EDIT_JOB_ABOUT, |corpus, progress| {
            call(corpus, progress).map(|_| WorkOutcome::Changed)
        })
    }

    /// Returns an edit that may take long: its title is shown while it runs, and it may be stopped.
    pub(crate) fn new_long_job(
        task: InterfaceText,
        call: impl FnOnce(&mut Corpus, &mut ProgressReceiver<'_>) -> CorpusResult<WorkOutcome> + Send + 'static,
    ) -> Self {
        let about = JobAbout {
            task,
            may_stop: true,
            ..JobAbout::EDIT_JOB_ABOUT
        };
        Self::new(about, call)
    }

    /// Carries out the job.
    pub(crate) fn carry_out_job(self, corpus: &mut Corpus, progress: &mut ProgressReceiver<'_>) -> WorkResult {
        (self.call)(corpus, progress)
    }
}

impl fmt::Debug for CorpusJob {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Job")
            .field("about", &self.about)
            .finish_non_exhaustive()
    }
}

/// A thread with its own connection to the corpus; the work of one lane is done in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum WorkLane {
    /// Changes of the corpus.
    Edit,
    /// Queries that the user waits for.
    Ask,
    /// Movement generated from notation, one sign after the other; it never waits for a search.
    Make,
    /// The open recipe; no other work shares this lane.
    Draft,
    /// Movement for the stage.
    Movement,
    /// Movement of little figures; the stage does not wait for it.
    Little,
    /// Movement for measurement.
    Measure,
    /// Comparisons of annotators and reports of studies; a search does not wait for them.
    Compare,
    /// Writing of files.
    Export,
}

impl WorkLane {
    pub(crate) const ALL_WORK_LANES: [Self; 9] = [
        Self::Edit,
        Self::Ask,
        Self::Make,
        Self::Draft,
        Self::Movement,
        Self::Little,
        Self::Measure,
        Self::Compare,
        Self::Export,
    ];
}

/// The progress of a piece of work.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct WorkProgress {
    /// The current task, such as a file's name.
    pub(crate) task: String,
    pub(crate) done: u64,
    pub(crate) total: Option<u64>,
}

impl WorkProgress {
    fn progress_from_step(step: &chereme_corpus::ProgressStep<'_>) -> Self {
        // Bytes are counted in kibibytes, which keeps the numbers short.
        let scale = if step.unit == ProgressUnit::Bytes { 1024 } else { 1 };
        Self {
            task: step.task.to_owned(),
            done: step.done / scale,
            total: step.total.map(|total| total / scale),
        }
    }

    /// Returns the share that is done, if the total is known.
    pub(crate) fn finished_share(&self) -> Option<f32> {
        let total = self.total.filter(|total| *total > 0)?;
        Some((self.done as f64 / total as f64).min(1.0) as f32)
    }
}

/// The result of a piece of work.
pub(crate) type WorkResult = CorpusResult<WorkOutcome>;
