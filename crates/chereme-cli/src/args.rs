//! The words of the command line.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use chereme_corpus::Corpus;
use clap::Parser;

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
    /// Who does the work, for the history
    #[arg(long, global = true, env = "CHEREME_AUTHOR", value_name = "NAME")]
    pub(crate) author: Option<String>,
    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Cli {
    /// Returns who does the work: as given, else the user of the machine.
    pub(crate) fn author(&self) -> String {
        let user = || {
            ["USER", "USERNAME", "LOGNAME"]
                .iter()
                .find_map(|name| std::env::var(name).ok())
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

/// Reads a small text file that the user named.
pub(crate) fn read_text(path: &PathBuf) -> Result<String> {
    std::fs::read_to_string(path).with_context(|| path.display().to_string())
}
