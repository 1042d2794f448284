//! The program `chereme-studio`: reads its arguments, opens the window, and reports why it cannot.
//!
//! `chereme studio` starts it with the same arguments.

mod arguments;
mod words;

use std::io::{self, Write};
use std::process::ExitCode;

use chereme_corpus::words::coverage::use_word_folder;
use chereme_corpus::words::{Language, fill, message, trouble};
use chereme_studio::{Folders, Options};
use serde_json::json;

use arguments::{Asked, Request};

/// Exit code for wrong usage.
const USAGE: u8 = 2;

fn main() -> ExitCode {
    chereme_corpus::hide_handled_panics();
    let given: Vec<_> = std::env::args_os().skip(1).collect();
    let json = given.iter().any(|word| word == "--json");
    let system = Language::of_environment(variable);
    let words = std::env::var_os("CHEREME_WORDS").filter(|folder| !folder.is_empty());
    let words = words.map_or(Ok(()), |folder| use_word_folder(folder.as_ref()));
    let language = arguments::language(&given).unwrap_or(system);
    if let Err(error) = words {
        return Report { json, language }.error(
            &error.to_string(),
            &error
                .remedy()
                .map_or_else(String::new, |remedy| remedy.to_string()),
        );
    }
    match arguments::read(given) {
        Ok(Request::Help) => print(words::HELP.of(language).trim_end()),
        Ok(Request::Version) => print(concat!("chereme-studio ", env!("CARGO_PKG_VERSION"))),
        Ok(Request::Open(asked)) => open(asked, system, &Report { json, language }),
        Err(wrong) => Report { json, language }.failure(
            &wrong.text(Language::English),
            &wrong.text(language),
            words::SEE_HELP.of(if json { Language::English } else { language }),
            ExitCode::from(USAGE),
        ),
    }
}

fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

fn print(text: &str) -> ExitCode {
    // A closed output is not an error.
    let _ = writeln!(io::stdout(), "{text}");
    ExitCode::SUCCESS
}

/// Opens the window, and returns after it is closed.
fn open(asked: Asked, system: Language, report: &Report) -> ExitCode {
    let folders = match asked.folder {
        Some(folder) => Folders {
            config: Some(folder.clone()),
            data: Some(folder),
        },
        None => Folders::of_platform(variable),
    };
    let options = Options {
        corpus: asked.corpus,
        author: chereme_corpus::author(asked.author.as_deref(), variable),
        folders,
        language: system,
        asked_language: asked.language,
    };
    let Err(error) = chereme_studio::run(options) else {
        return ExitCode::SUCCESS;
    };
    report.error(&error.to_string(), error.remedy())
}

/// The form in which failures are reported.
struct Report {
    /// One JSON document on standard output, in English, instead of lines on standard error.
    json: bool,
    language: Language,
}

impl Report {
    /// Reports an error of the library.
    fn error(&self, english: &str, remedy: &str) -> ExitCode {
        let spoken = |text: &str| {
            let known = message(text, self.language).filter(|_| !self.json);
            known.unwrap_or_else(|| text.to_owned())
        };
        self.failure(
            english,
            &spoken(english),
            &spoken(remedy),
            ExitCode::FAILURE,
        )
    }

    /// Reports a failure with its message in English and in the language of the user, and returns `code`.
    fn failure(&self, english: &str, spoken: &str, remedy: &str, code: ExitCode) -> ExitCode {
        // A closed output is not an error.
        let _ = if self.json {
            let error = json!({ "message": english, "where": null, "remedy": remedy });
            writeln!(io::stdout(), "{}", json!({ "error": error }))
        } else {
            let line = |text: chereme_corpus::words::Text, what: &str| {
                fill(text.of(self.language), &[("what", &what)])
            };
            let first = line(trouble::ERROR, spoken);
            writeln!(
                io::stderr(),
                "{first}\n{}",
                line(trouble::WHAT_TO_DO, remedy)
            )
        };
        code
    }
}
