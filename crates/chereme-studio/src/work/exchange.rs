//! Jobs that read and write files: imports, exports, and films and pictures of the stage.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{
    Address, ExportOptions, ExportWhat, ImportOptions, Performance, PictureOptions, SearchOptions,
    draw_clip,
};

use super::{About, Job, Outcome};
use crate::model::generated::GeneratedClip;
use crate::words::shell;

/// Movement that the user shares as a file: stored in the corpus, or only generated.
#[derive(Debug, Clone)]
pub(crate) enum Shared {
    /// Something stored in the corpus.
    Stored(Address),
    /// Generated movement that is not stored.
    Made(Arc<GeneratedClip>),
}

/// Exports show their errors in their box.
const EXPORT: About = About {
    quiet: true,
    ..About::WRITE
};

/// Imports files, or only reports what an import would do.
pub(crate) fn import(paths: Vec<PathBuf>, options: ImportOptions) -> Job {
    let task = if options.dry_run {
        shell::TASK_LOOKING
    } else {
        shell::TASK_IMPORT
    };
    let about = About {
        task,
        quiet: true,
        may_stop: true,
        ..About::EDIT
    };
    Job::new(about, move |corpus, progress| {
        let report = corpus.import(&paths, &options, progress);
        report.map(Outcome::Imported)
    })
}

/// Writes something stored in the corpus to files.
pub(crate) fn export(what: ExportWhat, to: PathBuf, options: ExportOptions) -> Job {
    Job::new(EXPORT, move |corpus, progress| {
        let report = corpus.export(&what, &to, &options, progress);
        report.map(Outcome::Exported)
    })
}

/// Writes the tokens that a query finds to files.
pub(crate) fn export_found(query: String, to: PathBuf, options: ExportOptions) -> Job {
    Job::new(EXPORT, move |corpus, progress| {
        let all = SearchOptions {
            limit: None,
            facets: false,
            ..SearchOptions::default()
        };
        let found = corpus.search_until(&query, &all, progress)?;
        let tokens = found.hits.iter().map(|hit| hit.token).collect();
        let what = ExportWhat::Tokens(tokens);
        let report = corpus.export(&what, &to, &options, progress);
        report.map(Outcome::Exported)
    })
}

/// Draws the contents of the stage to a film, an animation or a picture.
pub(crate) fn share(what: Shared, to: PathBuf, options: PictureOptions) -> Job {
    Job::new(About::WRITE, move |corpus, progress| {
        let picture = match what {
            Shared::Stored(address) => corpus.draw(&address, &to, &options, progress),
            Shared::Made(made) => {
                let performance = Performance {
                    clip: &made.clip,
                    anatomy: &made.anatomy,
                    faces: &made.faces,
                };
                draw_clip(performance, &made.name, &to, &options, progress)
            }
        };
        picture.map(Outcome::Shared)
    })
}
