//! Jobs of perceptual studies: plans, clips, questionnaires, answers and reports.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use chereme_corpus::study::QuestionnaireOptions;
use chereme_corpus::study::plan::Plan;
use chereme_corpus::study::report::Report;

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

/// Stores a plan, after each of its clips was made once.
pub(crate) fn plan(plan: Plan) -> Job {
    let about = About {
        task: words::TASK_PLAN,
        ..CHANGE
    };
    Job::new(about, move |corpus, progress| {
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

/// Imports answers to a study.
pub(crate) fn import(name: String, paths: Vec<PathBuf>) -> Job {
    let about = About {
        task: words::TASK_ANSWERS,
        ..CHANGE
    };
    Job::new(about, move |corpus, progress| {
        let done = corpus.import_answers(&name, &paths, progress)?;
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
