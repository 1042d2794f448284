//! `chereme studio`: opens the window.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::Error;
use chereme_studio::{Folders, Language, Options};

use crate::args::{self, Cli};

/// Open the workbench: annotate, search and recombine in a window
///
/// Without a corpus the window offers the starter corpus, recent corpora, and the import of a folder. The settings are
/// in the file chereme/studio.json of the platform's settings folder; --language changes the language there. F1 shows
/// the keys: ELAN's, Praat's or a video editor's.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus to open
    corpus: Option<PathBuf>,
    /// The folder for the settings and the starter corpus, instead of the platform's
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

pub(super) fn run(cli: &Cli, args: &Args) -> Result<()> {
    let variable = |name: &str| std::env::var(name).ok();
    let folders = match &args.folder {
        Some(folder) => Folders {
            config: Some(folder.clone()),
            data: Some(folder.clone()),
        },
        None => Folders::of_platform(variable),
    };
    let options = Options {
        corpus: args.corpus.clone(),
        author: cli.author(),
        folders,
        language: args::language(None),
        asked_language: cli.language.as_deref().map(Language::of_locale),
    };
    chereme_studio::run(options).map_err(|error| {
        let remedy = error.remedy().to_owned();
        Error::wrong(error.to_string()).advise(remedy).into()
    })
}
