//! The program `chereme-studio`: reads its arguments, opens the window, and reports why it cannot.
//!
//! `chereme studio` starts it with the same arguments.

mod arguments;
mod studio_words;

use std::io::{self, Write};
use std::process::ExitCode;

use chereme_corpus::use_word_folder;
use chereme_corpus::words::{InterfaceLanguage, fill_text_braces, localized_message, trouble_words};
use chereme_studio::{StudioFolders, StudioOptions};
use serde_json::json;

use arguments::{ArgumentRequest, WindowArguments};

/// Exit code for wrong usage.
const USAGE_EXIT_CODE: u8 = 2;

fn main() -> ExitCode {
    chereme_corpus::hide_handled_panics();
    let given: Vec<_> = std::env::args_os().skip(1).collect();
    let json = given.iter().any(|word| word == "--json");
    let system = InterfaceLanguage::of_environment(environment_variable);
    let word_folder = std::env::var_os("CHEREME_WORDS").filter(|folder| !folder.is_empty());
    let words = word_folder.map_or(Ok(()), |folder| use_word_folder(folder.as_ref()));
    let language = arguments::requested_language(&given).unwrap_or(system);
    if let Err(error) = words {
        return FailureReporter { json, language }.report_library_error(
            &error.to_string(),
            &error
                .error_remedy()
                .map_or_else(String::new, |remedy| remedy.to_string()),
        );
    }
    match arguments::read_window_arguments(given) {
        Ok(ArgumentRequest::Help) => print_to_stdout(studio_words::studio_help_text(language).trim_end()),
        Ok(ArgumentRequest::Version) => print_to_stdout(concat!("chereme-studio ", env!("CARGO_PKG_VERSION"))),
        Ok(ArgumentRequest::Open(asked)) => open_studio_window(asked, system, &FailureReporter { json, language }),
        Err(wrong) => FailureReporter { json, language }.report_failure(
            &wrong.argument_error_text(InterfaceLanguage::English),
            &wrong.argument_error_text(language),
            studio_words::SEE_HELP.text_in_language(if json { InterfaceLanguage::English } else { language }),
            ExitCode::from(USAGE_EXIT_CODE),
        ),
    }
}

fn environment_variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

fn print_to_stdout(text: &str) -> ExitCode {
    // A closed output is not an error.
    let _ = writeln!(io::stdout(), "{text}");
    ExitCode::SUCCESS
}

/// Opens the window, and returns after it is closed.
fn open_studio_window(asked: WindowArguments, system: InterfaceLanguage, report: &FailureReporter) -> ExitCode {
    let folders = match asked.folder {
        Some(folder) => StudioFolders {
            config: Some(folder.clone()),
            data: Some(folder),
        },
        None => StudioFolders::of_platform(environment_variable),
    };
    let options = StudioOptions {
        corpus: asked.corpus,
        author: chereme_corpus::determine_author(asked.author.as_deref(), environment_variable),
        folders,
        language: system,
        asked_language: asked.language,
    };
    let Err(error) = chereme_studio::run(options) else {
        return ExitCode::SUCCESS;
    };
    report.report_library_error(&error.to_string(), error.studio_error_remedy())
}

/// The form in which failures are reported.
struct FailureReporter {
    /// One JSON document on standard output, in English, instead of lines on standard error.
    json: bool,
    language: InterfaceLanguage,
}

impl FailureReporter {
    /// Reports an error of the library.
    fn report_library_error(&self, english: &str, remedy: &str) -> ExitCode {
        let spoken = |text: &str| {
            let translation = localized_message(text, self.language).filter(|_| !self.json);
            translation.unwrap_or_else(|| text.to_owned())
        };
        self.report_failure(english, &spoken(english), &spoken(remedy), ExitCode::FAILURE)
    }

    /// Reports a failure with its message in English and in the language of the user, and returns `code`.
    fn report_failure(&self, english: &str, spoken: &str, remedy: &str, code: ExitCode) -> ExitCode {
        // A closed output is not an error.
        let _ = if self.json {
            let error = json!({ "message": english, "where": null, "remedy": remedy });
            writeln!(io::stdout(), "{}", json!({ "error": error }))
        } else {
            let line = |text: chereme_corpus::words::InterfaceText, what: &str| {
                fill_text_braces(text.text_in_language(self.language), &[("what", &what)])
            };
            let first = line(trouble_words::ERROR, spoken);
            writeln!(io::stderr(), "{first}\n{}", line(trouble_words::WHAT_TO_DO, remedy))
        };
        code
    }
}
