//! Jobs of perceptual studies: plans, clips, questionnaires, answers and reports.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use chereme_corpus::Corpus;
use chereme_corpus::study::report::StudyReport;
use chereme_corpus::study::study_plan::StudyPlan;
use chereme_corpus::study::{AnswersOptions, QuestionnaireOptions};

use super::{CorpusJob, JobAbout, WorkLane, WorkOutcome};
use crate::words::{InterfaceLanguage, studies_words as words};

const STUDY_REPORT_JOB_ABOUT: JobAbout = JobAbout {
    lane: WorkLane::Compare,
    task: words::TASK_REPORT,
    quiet: true,
    may_stop: true,
};

/// Writes of files, whose errors the pane shows.
const STUDY_WRITE_JOB_ABOUT: JobAbout = JobAbout {
    quiet: true,
    ..JobAbout::WRITE_JOB_ABOUT
};

/// Changes of the corpus that may take long, whose errors the pane shows.
const STUDY_CHANGE_JOB_ABOUT: JobAbout = JobAbout {
    quiet: true,
    may_stop: true,
    ..JobAbout::EDIT_JOB_ABOUT
};

/// Lists the studies.
pub(crate) fn list_studies_job() -> CorpusJob {
    CorpusJob::new(STUDY_REPORT_JOB_ABOUT, |corpus, _| {
        let study_list = corpus.study_overviews()?;
        Ok(WorkOutcome::Studies(Arc::new(study_list)))
    })
}

/// Makes the clip of a trial.
pub(crate) fn make_trial_clip_job(text: String) -> CorpusJob {
    CorpusJob::new(JobAbout::PREVIEW_JOB_ABOUT, move |corpus, _| {
        let made = corpus.trial_clip(&text)?;
        Ok(WorkOutcome::TrialClip(Arc::new(made)))
    })
}

/// Reads a file for the form of a study.
pub(crate) fn read_study_file_job(path: PathBuf) -> CorpusJob {
    CorpusJob::new(STUDY_REPORT_JOB_ABOUT, move |_, _| {
        let text = Corpus::read_study_text(&path)?;
        Ok(WorkOutcome::StudyText(text))
    })
}

/// Stores a plan, after each of its clips was made once, with the distances from a condition if one is given.
pub(crate) fn store_study_plan_job(plan: StudyPlan, distance_from: Option<String>) -> CorpusJob {
    let about = JobAbout {
        task: words::TASK_PLAN,
        ..STUDY_CHANGE_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let mut plan = plan;
        if let Some(condition) = &distance_from {
            corpus.measure_distances(&mut plan, condition, progress)?;
        }
        let done = corpus.plan_study(&plan, progress)?;
        Ok(WorkOutcome::Planned(done.plan.name))
    })
}

/// Builds the questionnaire of a study in a folder.
pub(crate) fn build_questionnaire_job(name: String, to: PathBuf, options: QuestionnaireOptions) -> CorpusJob {
    let about = JobAbout {
        task: words::TASK_BUILD,
        ..STUDY_WRITE_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let done = corpus.build_study(&name, &to, options, progress)?;
        Ok(WorkOutcome::QuestionnaireBuilt(Box::new(done)))
    })
}

/// Writes the plan of a study as a file.
pub(crate) fn write_plan(name: String, to: PathBuf, force: bool) -> CorpusJob {
    CorpusJob::new(STUDY_WRITE_JOB_ABOUT, move |corpus, _| {
        corpus.export_plan(&name, &to, force)?;
        Ok(WorkOutcome::PlanWritten)
    })
}

/// Lists the answers to a study.
pub(crate) fn list_answers_job(name: String) -> CorpusJob {
    CorpusJob::new(STUDY_REPORT_JOB_ABOUT, move |corpus, _| {
        let answer_list = corpus.study_answers(&name)?;
        Ok(WorkOutcome::AnswersListed(Arc::new(answer_list)))
    })
}

/// Writes the answers to a study as a table.
pub(crate) fn write_answers(name: String, to: PathBuf, force: bool) -> CorpusJob {
    CorpusJob::new(STUDY_WRITE_JOB_ABOUT, move |corpus, _| {
        corpus.export_answers(&name, &to, force)?;
        Ok(WorkOutcome::AnswersWritten)
    })
}

/// Deletes a participant of a study with all answers.
pub(crate) fn forget_participant_job(name: String, code: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.forget_participant(&name, &code))
}

/// Imports answers to a study, or tries it.
pub(crate) fn import_answers_job(name: String, paths: Vec<PathBuf>, options: AnswersOptions) -> CorpusJob {
    let about = JobAbout {
        task: words::TASK_ANSWERS,
        ..STUDY_CHANGE_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let done = corpus.import_answers(&name, &paths, &options, progress)?;
        Ok(WorkOutcome::AnswersImported(Box::new(done)))
    })
}

/// Opens a page in the program that the desktop has for it.
pub(crate) fn open_page_job(path: PathBuf) -> CorpusJob {
    let about = JobAbout {
        task: words::TASK_OPEN,
        ..STUDY_WRITE_JOB_ABOUT
    };
    CorpusJob::new(about, move |_, _| Ok(WorkOutcome::Opened(open_page(&path))))
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
pub(crate) fn delete_study_job(name: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.delete_study(&name))
}

/// Makes the report of a study.
pub(crate) fn study_report_job(name: String) -> CorpusJob {
    CorpusJob::new(STUDY_REPORT_JOB_ABOUT, move |corpus, _| {
        let study_report = corpus.report_study(&name)?;
        Ok(WorkOutcome::Reported(Arc::new(study_report)))
    })
}

/// Writes a report to a file.
pub(crate) fn write_report(
    report: Arc<StudyReport>,
    to: PathBuf,
    force: bool,
    language: InterfaceLanguage,
) -> CorpusJob {
    let about = JobAbout {
        task: words::TASK_SAVE,
        ..STUDY_WRITE_JOB_ABOUT
    };
    CorpusJob::new(about, move |_, _| {
        let written = report.write_study_report(&to, force, language)?;
        Ok(WorkOutcome::ReportWritten(written))
    })
}
