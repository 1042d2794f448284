//! The arguments of the program: read from words into a request.

use std::ffi::{OsStr, OsString};
use std::fmt::Display;
use std::path::PathBuf;

use chereme_corpus::words::{InterfaceLanguage, fill_text_braces};

use crate::studio_words;

/// The request that the arguments make.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum ArgumentRequest {
    /// Open the window.
    Open(WindowArguments),
    /// Print the help.
    Help,
    /// Print the version.
    Version,
}

/// The arguments for the window.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct WindowArguments {
    /// The corpus to open.
    pub(crate) corpus: Option<PathBuf>,
    /// The folder for settings and the starter corpus.
    pub(crate) folder: Option<PathBuf>,
    /// The name for the history.
    pub(crate) author: Option<String>,
    /// The language of the window, which is stored in the settings.
    pub(crate) language: Option<InterfaceLanguage>,
}

/// A reason why arguments cannot be used.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum ArgumentError {
    /// An option that the program does not have.
    Unknown(String),
    /// An option without its value.
    Valueless(String),
    /// A value of an option that it does not take: option, value.
    Value(String, String),
    /// A second corpus.
    Second(String),
}

impl ArgumentError {
    /// Returns the message.
    pub(crate) fn argument_error_text(&self, language: InterfaceLanguage) -> String {
        let (text, option, value) = match self {
            Self::Unknown(option) => (studio_words::UNKNOWN_OPTION_TEXT, option, ""),
            Self::Valueless(option) => (studio_words::MISSING_VALUE_TEXT, option, ""),
            Self::Value(option, value) => (studio_words::UNWANTED_VALUE_TEXT, option, value.as_str()),
            Self::Second(corpus) => (studio_words::SECOND_CORPUS_TEXT, corpus, ""),
        };
        let listed = InterfaceLanguage::all_listed().into_iter();
        let code_list: Vec<&str> = listed.map(|(language, _)| language.language_code()).collect();
        let codes = code_list.join(", ");
        let values: [(&str, &dyn Display); 3] = [("option", option), ("value", &value), ("codes", &codes)];
        fill_text_braces(text.text_in_language(language), &values)
    }
}

/// Returns the language that the words ask for, also if something else in them is wrong.
pub(crate) fn requested_language(given: &[OsString]) -> Option<InterfaceLanguage> {
    let joined = given
        .iter()
        .filter_map(|word| word.to_str()?.strip_prefix("--language="));
    let parted = given
        .windows(2)
        .filter(|pair| pair[0] == "--language")
        .filter_map(|pair| pair[1].to_str());
    joined.chain(parted).find_map(InterfaceLanguage::from_code)
}

/// Reads the words after the name of the program.
pub(crate) fn read_window_arguments(given: Vec<OsString>) -> Result<ArgumentRequest, ArgumentError> {
    let mut asked = WindowArguments::default();
    let mut rest = given.into_iter();
    let mut options = true;
    while let Some(word) = rest.next() {
        let text = word.to_str().filter(|_| options).unwrap_or_default();
        let (option, joined) = match text.split_once('=') {
            Some((option, value)) => (option, Some(OsString::from(value))),
            None => (text, None),
        };
        let mut value = || joined.clone().or_else(|| rest.next());
        let mut needed = || value().ok_or_else(|| ArgumentError::Valueless(option.to_owned()));
        match option {
            "--" => options = false,
            "-h" | "--help" => return Ok(ArgumentRequest::Help),
            "-V" | "--version" => return Ok(ArgumentRequest::Version),
            "--json" => {}
            "--folder" => asked.folder = Some(needed()?.into()),
            "--author" => asked.author = Some(shown_argument(&needed()?)),
            "--language" => {
                let code = shown_argument(&needed()?);
                let language = InterfaceLanguage::from_code(&code);
                let wrong = || ArgumentError::Value(option.to_owned(), code);
                asked.language = Some(language.ok_or_else(wrong)?);
            }
            _ if option.starts_with('-') => return Err(ArgumentError::Unknown(option.to_owned())),
            _ if asked.corpus.is_some() => {
                return Err(ArgumentError::Second(shown_argument(&word)));
            }
            _ => asked.corpus = Some(word.into()),
        }
    }
    Ok(ArgumentRequest::Open(asked))
}

fn shown_argument(word: &OsStr) -> String {
    word.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<OsString> {
        line.split_whitespace().map(OsString::from).collect()
    }

    fn asked(line: &str) -> WindowArguments {
        match read_window_arguments(words(line)) {
            Ok(ArgumentRequest::Open(asked)) => asked,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn options_and_corpus_come_in_any_order() {
        let whole = WindowArguments {
            corpus: Some("a=b.chereme".into()),
            folder: Some("here".into()),
            author: Some("--Camille".into()),
            language: Some(InterfaceLanguage::French),
        };
        let first = "--json --folder here --author --Camille --language fr a=b.chereme";
        assert_eq!(asked(first), whole);
        let last = "a=b.chereme --language=fr --author=--Camille --folder=here";
        assert_eq!(asked(last), whole);
        assert_eq!(asked(""), WindowArguments::default());
        assert_eq!(asked("-- --help").corpus, Some("--help".into()));
    }

    #[test]
    fn help_and_version_are_requests() {
        for (line, want) in [
            ("--help", ArgumentRequest::Help),
            ("a.chereme -h", ArgumentRequest::Help),
            ("-V", ArgumentRequest::Version),
            ("--language fr --version", ArgumentRequest::Version),
        ] {
            assert_eq!(read_window_arguments(words(line)), Ok(want), "{line}");
        }
    }

    #[test]
    fn wrong_words_are_named() {
        for (line, named, want) in [
            ("--thme dark", "--thme", ArgumentError::Unknown("--thme".into())),
            ("-x", "-x", ArgumentError::Unknown("-x".into())),
            ("a --folder", "--folder", ArgumentError::Valueless("--folder".into())),
            (
                "--language tlh",
                "tlh",
                ArgumentError::Value("--language".into(), "tlh".into()),
            ),
            ("a b", " b ", ArgumentError::Second("b".into())),
        ] {
            let wrong = read_window_arguments(words(line)).expect_err(line);
            assert_eq!(wrong, want, "{line}");
            for (language, _) in InterfaceLanguage::BUILTIN_LANGUAGES {
                let text = wrong.argument_error_text(language);
                assert!(!text.contains('{') && text.contains(named), "{text}");
            }
        }
    }

    #[test]
    fn the_language_is_known_though_other_words_are_wrong() {
        assert_eq!(
            requested_language(&words("--x --language fr")),
            Some(InterfaceLanguage::French)
        );
        assert_eq!(
            requested_language(&words("--language=en --x")),
            Some(InterfaceLanguage::English)
        );
        assert_eq!(requested_language(&words("--language tlh")), None);
    }
}
