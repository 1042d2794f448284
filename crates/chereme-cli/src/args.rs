//! The words of the command line.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::{Corpus, Error};
use chereme_motion::Side;
use clap::{Parser, ValueEnum};

use crate::commands::Command;

/// A corpus database for signed movement: import, search, recombine, look at and export signs.
///
/// One file, NAME.chereme, holds recordings, what is said about them on tiers, and the new signs made
/// from them. Start with `chereme demo`.
#[derive(Debug, Parser)]
#[command(
    name = "chereme",
    version,
    propagate_version = true,
    arg_required_else_help = true
)]
pub(crate) struct Cli {
    /// Print one JSON document on standard output instead of tables
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Who does the work, for the history; else CHEREME_AUTHOR of the environment, or the user
    #[arg(long, global = true, value_name = "NAME")]
    pub(crate) author: Option<String>,
    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Cli {
    /// Returns who does the work: as given, else as the environment says, else the user of the machine.
    pub(crate) fn author(&self) -> String {
        let user = || {
            ["CHEREME_AUTHOR", "USER", "USERNAME", "LOGNAME"]
                .iter()
                .filter_map(|name| std::env::var(name).ok())
                .find(|name| !name.trim().is_empty())
        };
        self.author
            .clone()
            .or_else(user)
            .unwrap_or_else(|| "unknown".to_owned())
    }

    /// Opens the corpus.
    pub(crate) fn open(&self, path: &Path) -> Result<Corpus> {
        Ok(Corpus::open(path, &self.author())?)
    }
}

/// One of the two sides, as a word of the command line.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum SideWord {
    Right,
    Left,
}

impl SideWord {
    pub(crate) fn side(self) -> Side {
        match self {
            Self::Right => Side::Right,
            Self::Left => Side::Left,
        }
    }
}

/// Reads a small text file that the user named.
pub(crate) fn read_text(path: &PathBuf) -> Result<String> {
    Ok(std::fs::read_to_string(path).map_err(|error| Error::file(path, error))?)
}

/// Returns the failure that a small file of the user does not say what it should.
pub(crate) fn wrong_text(path: &Path, error: impl Display, remedy: &str) -> Error {
    let place = path.display().to_string();
    Error::wrong(format!("{place}: {error}"))
        .at(place)
        .advise(remedy)
}
