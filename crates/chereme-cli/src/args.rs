//! The options of all commands, and readers for arguments that several commands share.

use std::ffi::OsString;
use std::fmt::Display;
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::words::{Language, fill, trouble};
use chereme_corpus::{Corpus, Error};
use chereme_motion::Side;
use clap::builder::PossibleValuesParser;
use clap::{CommandFactory, Parser, ValueEnum};

use crate::commands::Command;
use crate::output::write_to_stderr;
use crate::streams;

/// A corpus database for signed movement: import, search, recombine, look at and export signs.
///
/// One file, NAME.chereme, holds recordings, the annotations of their tiers, and the new signs made
/// from them. Start with `chereme demo`, or import a folder of your own.
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
    /// Your name in the history; without it the environment variable CHEREME_AUTHOR, or the name of the machine's user
    #[arg(long, global = true, value_name = "NAME")]
    pub(crate) author: Option<String>,
    /// The width of tables in letters, 0 for their full width; without it the width of the terminal, or the full width
    /// if the output goes to a file or another program
    #[arg(long, global = true, value_name = "LETTERS")]
    pub(crate) width: Option<usize>,
    /// The language of help, tables and messages; without it English or French, as the system. Words that a language
    /// lacks are English, as JSON always is. The environment variable CHEREME_WORDS names a folder with languages of
    /// your own: `chereme words --help`
    #[arg(long, value_name = "LANGUAGE", value_parser = PossibleValuesParser::new(language_codes()))]
    pub(crate) language: Option<String>,
    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Cli {
    /// Returns the author for the history: the option's, otherwise the environment's, otherwise the machine's user.
    pub(crate) fn author(&self) -> String {
        chereme_corpus::author(self.author.as_deref(), variable)
    }

    /// Opens the corpus.
    pub(crate) fn open(&self, path: &Path) -> Result<Corpus> {
        let corpus = Corpus::open(path, &self.author())?;
        if let Some(upgrade) = corpus.upgrade() {
            let (path, kept) = (path.display(), upgrade.kept.display());
            let said = trouble::UPGRADED.of(language(self.language.as_deref()));
            write_to_stderr(&fill(
                said,
                &[
                    ("path", &path),
                    ("from", &upgrade.from),
                    ("to", &upgrade.to),
                    ("kept", &kept),
                ],
            ));
        }
        Ok(corpus)
    }
}

/// A side, as the word for it in an argument.
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

/// Returns the codes of the languages that have a folder of words.
pub(crate) fn language_codes() -> impl Iterator<Item = &'static str> {
    let listed = Language::all_listed().into_iter();
    listed.map(|(language, _)| language.code())
}

/// Removes `--language` with a language's code from any position in the words of the command line, and returns the code.
/// After a command with an option of this name, the option belongs to it, as other values do.
pub(crate) fn take_language(words: &mut Vec<OsString>) -> Option<String> {
    let code = |word: &OsString| Some(word.to_str().and_then(Language::from_code)?.code());
    let whole = Cli::command();
    let mut command = &whole;
    let mut asked = None;
    let mut at = 1;
    while at < words.len() {
        let named = words[at].to_str();
        command = named
            .and_then(|word| command.find_subcommand(word))
            .unwrap_or(command);
        let mut options = command.get_arguments().map(clap::Arg::get_long);
        let is_own =
            command.get_name() != whole.get_name() && options.any(|long| long == Some("language"));
        let joined = words[at]
            .to_str()
            .and_then(|word| word.strip_prefix("--language="));
        let taken = match (joined, words[at] == "--language") {
            _ if is_own => None,
            (Some(value), _) => code(&value.into()).map(|code| (code, 1)),
            (None, true) => words.get(at + 1).and_then(code).map(|code| (code, 2)),
            _ => None,
        };
        match taken {
            Some((code, length)) => {
                words.drain(at..at + length);
                asked = Some(code);
            }
            None => at += 1,
        }
    }
    asked.map(str::to_owned)
}

/// Returns the language of a code; without one the language of the locale.
pub(crate) fn language(asked: Option<&str>) -> Language {
    let known = asked.and_then(Language::from_code);
    known.unwrap_or_else(|| Language::of_environment(variable))
}

/// Returns a variable of the environment.
pub(crate) fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

/// Reads a small text file that the user named; `-` is standard input.
pub(crate) fn read_text(path: &PathBuf) -> Result<String> {
    if streams::is_standard(path) {
        return streams::read_text();
    }
    Ok(std::fs::read_to_string(path).map_err(|error| Error::file(path, error))?)
}

/// Returns the error for a text file of the user whose content cannot be used.
pub(crate) fn wrong_text(path: &Path, error: impl Display, remedy: &str) -> Error {
    let place = path.display().to_string();
    Error::wrong(format!("{place}: {error}"))
        .at(place)
        .advise(remedy)
}
