//! Jobs of perceptual studies: plans, clips, questionnaires, answers and reports.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use chereme_corpus::Corpus;
use chereme_corpus::study::plan::Plan;
use chereme_corpus::study::report::Report;
use chereme_corpus::study::{AnswersOptions, QuestionnaireOptions};

use super::{About, Job, Lane, Outcome};
use crate::words::{Language, studies as words};

const REPORT: About = About {
    lane: Lane::Compare,
    task: words::TASK_REPORT,
    quiet: true,
    may_stop: true,
};

/// Writes of files, whose errors the pane shows.
const WRITE: About = About {
    quiet: true,
    ..About::WRITE
};

/// Changes of the corpus that may take long, whose errors the pane shows.
const CHANGE: About = About {
    quiet: true,
    may_stop: true,
    ..About::EDIT
};

/// Lists the studies.
pub(crate) fn list() -> Job {
    Job::new(REPORT, |corpus, _| {
        let found = corpus.studies()?;
        Ok(Outcome::Studies(Arc::new(found)))
    })
}

/// Makes the clip of a trial.
pub(crate) fn clip(text: String) -> Job {
    Job::new(About::PREVIEW, move |corpus, _| {
        let made = corpus.trial_clip(&text)?;
        Ok(Outcome::TrialClip(Arc::new(made)))
    })
}

/// Reads a file for the form of a study.
pub(crate) fn read(path: PathBuf) -> Job {
    Job::new(REPORT, move |_, _| {
        let text = Corpus::read_study_text(&path)?;
        Ok(Outcome::StudyText(text))
    })
}

/// Stores a plan, after each of its clips was made once, with the distances from a condition if one is given.
pub(crate) fn plan(plan: Plan, distance_from: Option<String>) -> Job {
    let about = About {
        task: words::TASK_PLAN,
        ..CHANGE
    };
    Job::new(about, move |corpus, progress| {
        let mut plan = plan;
        if let Some(condition) = &distance_from {
            corpus.measure_distances(&mut plan, condition, progress)?;
        }
        let done = corpus.plan_study(&plan, progress)?;
        Ok(Outcome::Planned(done.plan.name))
    })
}

/// Builds the questionnaire of a study in a folder.
pub(crate) fn build(name: String, to: PathBuf, options: QuestionnaireOptions) -> Job {
    let about = About {
        task: words::TASK_BUILD,
        ..WRITE
    };
    Job::new(about, move |corpus, progress| {
        let done = corpus.build_study(&name, &to, options, progress)?;
        Ok(Outcome::QuestionnaireBuilt(Box::new(done)))
    })
}

/// Writes the plan of a study as a file.
pub(crate) fn write_plan(name: String, to: PathBuf, force: bool) -> Job {
    Job::new(WRITE, move |corpus, _| {
        corpus.export_plan(&name, &to, force)?;
        Ok(Outcome::PlanWritten)
    })
}

/// Lists the answers to a study.
pub(crate) fn answers(name: String) -> Job {
    Job::new(REPORT, move |corpus, _| {
        let found = corpus.study_answers(&name)?;
        Ok(Outcome::AnswersListed(Arc::new(found)))
    })
}

/// Writes the answers to a study as a table.
pub(crate) fn write_answers(name: String, to: PathBuf, force: bool) -> Job {
    Job::new(WRITE, move |corpus, _| {
        corpus.export_answers(&name, &to, force)?;
        Ok(Outcome::AnswersWritten)
    })
}

/// Deletes a participant of a study with all answers.
pub(crate) fn forget(name: String, code: String) -> Job {
    Job::change(move |corpus, _| corpus.forget_participant(&name, &code))
}

/// Imports answers to a study, or tries it.
pub(crate) fn import(name: String, paths: Vec<PathBuf>, options: AnswersOptions) -> Job {
    let about = About {
        task: words::TASK_ANSWERS,
        ..CHANGE
    };
    Job::new(about, move |corpus, progress| {
        let done = corpus.import_answers_by(&name, &paths, &options, progress)?;
        Ok(Outcome::AnswersImported(Box::new(done)))
    })
}

/// Opens a page in the program that the desktop has for it.
pub(crate) fn open(path: PathBuf) -> Job {
    let about = About {
        task: words::TASK_OPEN,
        ..WRITE
    };
    Job::new(about, move |_, _| Ok(Outcome::Opened(open_page(&path))))
}

/// Opens a page with the program of the desktop for such files; returns whether there is one.
fn open_page(path: &Path) -> bool {
    let (program, reports) = match std::env::consts::OS {
        // The explorer ends with a failure even if it opened the file.
        "windows" => ("explorer", false),
        "macos" => ("open", true),
        _ => ("xdg-open", true),
    };
    let mut command = Command::new(program);
    command.arg(path).stdin(Stdio::null());
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut child) = command.spawn() else {
        return false;
    };
    // A program that fails does so at once; a browser may run until the user closes it.
    for _ in 0..10 {
        std::thread::sleep(Duration::from_millis(100));
        if let Ok(Some(status)) = child.try_wait() {
            return status.success() || !reports;
        }
    }
    std::thread::spawn(move || child.wait());
    true
}

/// Deletes a study with all answers.
pub(crate) fn delete(name: String) -> Job {
    Job::change(move |corpus, _| corpus.delete_study(&name))
}

/// Makes the report of a study.
pub(crate) fn report(name: String) -> Job {
    Job::new(REPORT, move |corpus, _| {
        let found = corpus.report_study(&name)?;
        Ok(Outcome::Reported(Arc::new(found)))
    })
}

/// Writes a report to a file.
pub(crate) fn write_report(
    report: Arc<Report>,
    to: PathBuf,
    force: bool,
    language: Language,
) -> Job {
    let about = About {
        task: words::TASK_SAVE,
        ..WRITE
    };
    Job::new(about, move |_, _| {
        let written = report.write(&to, force, language)?;
        Ok(Outcome::ReportWritten(written))
    })
}
