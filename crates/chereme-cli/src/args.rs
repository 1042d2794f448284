//! The options of all commands, and readers for arguments that several commands share.

use std::ffi::{OsStr, OsString};
use std::fmt::Display;
use std::path::{Path, PathBuf};

use anyhow::Result;
use chereme_corpus::words::{InterfaceLanguage, fill_text_braces, trouble_words};
use chereme_corpus::{Corpus, CorpusError};
use chereme_motion::BodySide;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};

use crate::commands::Command;
use crate::output::write_to_stderr;
use crate::streams;

/// A corpus database for signed movement: import, search, recombine, look at and export signs.
///
/// One file, NAME.chereme, holds recordings, the annotations of their tiers, and the new signs made
/// from them. Start with `chereme demo`, or import a folder of your own.
#[derive(Debug, Parser)]
#[command(name = "chereme", version, propagate_version = true, arg_required_else_help = true)]
pub(crate) struct CommandLine {
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

impl CommandLine {
    /// Returns the author for the history: the option's, otherwise the environment's, otherwise the machine's user.
    pub(crate) fn history_author(&self) -> String {
        chereme_corpus::determine_author(self.author.as_deref(), read_environment_variable)
    }

    /// Opens the corpus.
    pub(crate) fn open_cli_corpus(&self, path: &Path) -> Result<Corpus> {
        let corpus = Corpus::open_corpus(path, &self.history_author())?;
        if let Some(upgrade) = corpus.schema_upgrade() {
            let (path, kept) = (path.display(), upgrade.kept.display());
            let upgrade_message = trouble_words::UPGRADED.text_in_language(choose_language(self.language.as_deref()));
            write_to_stderr(&fill_text_braces(
                upgrade_message,
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

/// The sides of a body.
pub(crate) const BODY_SIDE_CHOICES: NamedChoices<BodySide> =
    NamedChoices(&[("right", "", BodySide::Right), ("left", "", BodySide::Left)]);

/// The values of an argument: the name of each, what it does, unless the name says it, and what it stands for in the library.
#[derive(Clone)]
pub(crate) struct NamedChoices<T: 'static>(pub(crate) &'static [(&'static str, &'static str, T)]);

impl<T: Clone + Send + Sync + 'static> TypedValueParser for NamedChoices<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let names = PossibleValuesParser::new(self.0.iter().map(|choice| choice.0));
        let name = names.parse_ref(command, argument, value)?;
        let choice = self.0.iter().find(|choice| choice.0 == name);
        choice
            .map(|choice| choice.2.clone())
            .ok_or_else(|| clap::Error::new(ErrorKind::InvalidValue))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.0.iter().map(|(name, effect, _)| match *effect {
            "" => PossibleValue::new(name),
            effect => PossibleValue::new(name).help(effect),
        })))
    }
}

/// Returns the codes of the languages that have a folder of words.
pub(crate) fn language_codes() -> impl Iterator<Item = &'static str> {
    let listed = InterfaceLanguage::all_listed().into_iter();
    listed.map(|(language, _)| language.language_code())
}

/// Removes `--language` with a language's code from any position in the words of the command line, and returns the code.
/// After a command with an option of this name, the option belongs to it, as other values do.
pub(crate) fn take_language(words: &mut Vec<OsString>) -> Option<String> {
    let code = |word: &OsString| Some(word.to_str().and_then(InterfaceLanguage::from_code)?.language_code());
    let root_command = CommandLine::command();
    let mut command = &root_command;
    let mut asked = None;
    let mut word_index = 1;
    while word_index < words.len() {
        let named = words[word_index].to_str();
        command = named.and_then(|word| command.find_subcommand(word)).unwrap_or(command);
        let mut options = command.get_arguments().map(clap::Arg::get_long);
        // `transcribe` and others have a `--language` of their own, for what they write.
        let is_own = command.get_name() != root_command.get_name() && options.any(|long| long == Some("language"));
        let joined = words[word_index]
            .to_str()
            .and_then(|word| word.strip_prefix("--language="));
        let taken = match (joined, words[word_index] == "--language") {
            // An option of the command itself is left where it is.
            _ if is_own => None,
            (Some(value), _) => code(&value.into()).map(|code| (code, 1)),
            (None, true) => words.get(word_index + 1).and_then(code).map(|code| (code, 2)),
            _ => None,
        };
        match taken {
            Some((code, length)) => {
                words.drain(word_index..word_index + length);
                asked = Some(code);
            }
            None => word_index += 1,
        }
    }
    asked.map(str::to_owned)
}

/// Returns the language of a code; without one the language of the locale.
pub(crate) fn choose_language(asked: Option<&str>) -> InterfaceLanguage {
    let known_language = asked.and_then(InterfaceLanguage::from_code);
    known_language.unwrap_or_else(|| InterfaceLanguage::of_environment(read_environment_variable))
}

/// Returns a variable of the environment.
pub(crate) fn read_environment_variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

/// Reads a small text file that the user named; `-` is standard input.
pub(crate) fn read_named_text(path: &PathBuf) -> Result<String> {
    if streams::is_standard(path) {
        return streams::read_stdin_text();
    }
    Ok(std::fs::read_to_string(path).map_err(|error| CorpusError::from_file_failure(path, error))?)
}

/// Returns the error for a text file of the user whose content cannot be used.
pub(crate) fn wrong_text(path: &Path, error: impl Display, remedy: &str) -> CorpusError {
    // The place stands in the message as well as in its field for JSON.
    let place = path.display().to_string();
    CorpusError::from_wrong_message(format!("{place}: {error}"))
        .with_error_place(place)
        .with_advice(remedy)
}
