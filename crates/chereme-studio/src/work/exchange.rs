//! Jobs that read and write files: imports, exports, and films and pictures of the stage.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{
    CorpusAddress, DrawablePerformance, ExportOptions, ExportWhat, ImportOptions, PictureOptions, SearchOptions,
    draw_clip,
};

use super::{CorpusJob, JobAbout, WorkOutcome};
use crate::model::generated::GeneratedClip;
use crate::words::shell;

/// Movement that the user shares as a file: stored in the corpus, or only generated.
#[derive(Debug, Clone)]
pub(crate) enum SharedMovement {
    /// Something stored in the corpus.
    Stored(CorpusAddress),
    /// Generated movement that is not stored.
    Made(Arc<GeneratedClip>),
}

/// Exports show their errors in their box.
const EXPORT_JOB_ABOUT: JobAbout = JobAbout {
    quiet: true,
    ..JobAbout::WRITE_JOB_ABOUT
};

/// Imports files, or only reports what an import would do.
pub(crate) fn import_files_job(paths: Vec<PathBuf>, options: ImportOptions) -> CorpusJob {
    let task = if options.dry_run {
        shell::TASK_LOOKING
    } else {
        shell::TASK_IMPORT
    };
    let about = JobAbout {
        task,
        quiet: true,
        may_stop: true,
        ..JobAbout::EDIT_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let report = corpus.import_paths(&paths, &options, progress);
        report.map(WorkOutcome::Imported)
    })
}

/// Writes something stored in the corpus to files.
pub(crate) fn export_files_job(what: ExportWhat, to: PathBuf, options: ExportOptions) -> CorpusJob {
    CorpusJob::new(EXPORT_JOB_ABOUT, move |corpus, progress| {
        let report = corpus.export_corpus(&what, &to, &options, progress);
        report.map(WorkOutcome::Exported)
    })
}

/// Writes the tokens that a query finds to files.
pub(crate) fn export_found(query: String, to: PathBuf, options: ExportOptions) -> CorpusJob {
    CorpusJob::new(EXPORT_JOB_ABOUT, move |corpus, progress| {
        let all = SearchOptions {
            limit: None,
            facets: false,
            ..SearchOptions::default()
        };
        let answer = corpus.search_until(&query, &all, progress)?;
        let tokens = answer.hits.iter().map(|hit| hit.token).collect();
        let what = ExportWhat::Tokens(tokens);
        let report = corpus.export_corpus(&what, &to, &options, progress);
        report.map(WorkOutcome::Exported)
    })
}

/// Writes the contents of the stage to a file: a film, an animation, a picture or, for stored movement, a body.
pub(crate) fn share_movement_job(what: SharedMovement, to: PathBuf, options: PictureOptions) -> CorpusJob {
    let is_body = to.extension().is_some_and(|ending| ending == "glb");
    CorpusJob::new(JobAbout::WRITE_JOB_ABOUT, move |corpus, progress| {
        let (title, notes) = match what {
            SharedMovement::Stored(address) if is_body => {
                let what = ExportWhat::Address(address);
                let report = corpus.export_corpus(&what, &to, &ExportOptions::default(), progress)?;
                let title = to.file_stem().unwrap_or_default().display().to_string();
                (title, report.notes)
            }
            SharedMovement::Stored(address) => {
                let picture = corpus.draw_together(&[address], &to, &options, progress)?;
                (picture.title, picture.for_me.into_iter().collect())
            }
            SharedMovement::Made(made) => {
                let performance = DrawablePerformance {
                    clip: &made.clip,
                    anatomy: &made.anatomy,
                    faces: &made.faces,
                };
                let picture = draw_clip(performance, &made.name, &to, &options, progress)?;
                let sentence = corpus.recipe_consent_sentence(&made.recipe)?;
                (picture.title, sentence.into_iter().collect())
            }
        };
        Ok(WorkOutcome::Shared { title, path: to, notes })
    })
}
