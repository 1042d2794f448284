//! The arguments of the program: read from words into a request.

use std::ffi::{OsStr, OsString};
use std::fmt::Display;
use std::path::PathBuf;

use chereme_corpus::words::{Language, fill};

use crate::words;

/// The request that the arguments make.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Request {
    /// Open the window.
    Open(Asked),
    /// Print the help.
    Help,
    /// Print the version.
    Version,
}

/// The arguments for the window.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Asked {
    /// The corpus to open.
    pub(crate) corpus: Option<PathBuf>,
    /// The folder for settings and the starter corpus.
    pub(crate) folder: Option<PathBuf>,
    /// The name for the history.
    pub(crate) author: Option<String>,
    /// The language of the window, which is stored in the settings.
    pub(crate) language: Option<Language>,
}

/// A reason why arguments cannot be used.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Wrong {
    /// An option that the program does not have.
    Unknown(String),
    /// An option without its value.
    Valueless(String),
    /// A value of an option that it does not take: option, value.
    Value(String, String),
    /// A second corpus.
    Second(String),
}

impl Wrong {
    /// Returns the message.
    pub(crate) fn text(&self, language: Language) -> String {
        let (text, option, value) = match self {
            Self::Unknown(option) => (words::UNKNOWN, option, ""),
            Self::Valueless(option) => (words::VALUELESS, option, ""),
            Self::Value(option, value) => (words::VALUE, option, value.as_str()),
            Self::Second(corpus) => (words::SECOND, corpus, ""),
        };
        let listed = Language::all_listed().into_iter();
        let codes: Vec<&str> = listed.map(|(language, _)| language.code()).collect();
        let codes = codes.join(", ");
        let values: [(&str, &dyn Display); 3] =
            [("option", option), ("value", &value), ("codes", &codes)];
        fill(text.of(language), &values)
    }
}

/// Returns the language that the words ask for, also if something else in them is wrong.
pub(crate) fn language(given: &[OsString]) -> Option<Language> {
    let joined = given
        .iter()
        .filter_map(|word| word.to_str()?.strip_prefix("--language="));
    let parted = given
        .windows(2)
        .filter(|pair| pair[0] == "--language")
        .filter_map(|pair| pair[1].to_str());
    joined.chain(parted).find_map(Language::from_code)
}

/// Reads the words after the name of the program.
pub(crate) fn read(given: Vec<OsString>) -> Result<Request, Wrong> {
    let mut asked = Asked::default();
    let mut rest = given.into_iter();
    let mut options = true;
    while let Some(word) = rest.next() {
        let text = word.to_str().filter(|_| options).unwrap_or_default();
        let (option, joined) = match text.split_once('=') {
            Some((option, value)) => (option, Some(OsString::from(value))),
            None => (text, None),
        };
        let mut value = || joined.clone().or_else(|| rest.next());
        let mut needed = || value().ok_or_else(|| Wrong::Valueless(option.to_owned()));
        match option {
            "--" => options = false,
            "-h" | "--help" => return Ok(Request::Help),
            "-V" | "--version" => return Ok(Request::Version),
            "--json" => {}
            "--folder" => asked.folder = Some(needed()?.into()),
            "--author" => asked.author = Some(shown(&needed()?)),
            "--language" => {
                let code = shown(&needed()?);
                let language = Language::from_code(&code);
                let wrong = || Wrong::Value(option.to_owned(), code);
                asked.language = Some(language.ok_or_else(wrong)?);
            }
            _ if option.starts_with('-') => return Err(Wrong::Unknown(option.to_owned())),
            _ if asked.corpus.is_some() => return Err(Wrong::Second(shown(&word))),
            _ => asked.corpus = Some(word.into()),
        }
    }
    Ok(Request::Open(asked))
}

fn shown(word: &OsStr) -> String {
    word.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<OsString> {
        line.split_whitespace().map(OsString::from).collect()
    }

    fn asked(line: &str) -> Asked {
        match read(words(line)) {
            Ok(Request::Open(asked)) => asked,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn options_and_corpus_come_in_any_order() {
        let whole = Asked {
            corpus: Some("a=b.chereme".into()),
            folder: Some("here".into()),
            author: Some("--Camille".into()),
            language: Some(Language::French),
        };
        let first = "--json --folder here --author --Camille --language fr a=b.chereme";
        assert_eq!(asked(first), whole);
        let last = "a=b.chereme --language=fr --author=--Camille --folder=here";
        assert_eq!(asked(last), whole);
        assert_eq!(asked(""), Asked::default());
        assert_eq!(asked("-- --help").corpus, Some("--help".into()));
    }

    #[test]
    fn help_and_version_are_requests() {
        for (line, want) in [
            ("--help", Request::Help),
            ("a.chereme -h", Request::Help),
            ("-V", Request::Version),
            ("--language fr --version", Request::Version),
        ] {
            assert_eq!(read(words(line)), Ok(want), "{line}");
        }
    }

    #[test]
    fn wrong_words_are_named() {
        for (line, named, want) in [
            ("--thme dark", "--thme", Wrong::Unknown("--thme".into())),
            ("-x", "-x", Wrong::Unknown("-x".into())),
            (
                "a --folder",
                "--folder",
                Wrong::Valueless("--folder".into()),
            ),
            (
                "--language tlh",
                "tlh",
                Wrong::Value("--language".into(), "tlh".into()),
            ),
            ("a b", " b ", Wrong::Second("b".into())),
        ] {
            let wrong = read(words(line)).expect_err(line);
            assert_eq!(wrong, want, "{line}");
            for (language, _) in Language::ALL {
                let text = wrong.text(language);
                assert!(!text.contains('{') && text.contains(named), "{text}");
            }
        }
    }

    #[test]
    fn the_language_is_known_though_other_words_are_wrong() {
        assert_eq!(
            language(&words("--x --language fr")),
            Some(Language::French)
        );
        assert_eq!(
            language(&words("--language=en --x")),
            Some(Language::English)
        );
        assert_eq!(language(&words("--language tlh")), None);
    }
}
