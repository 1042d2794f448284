//! Failures for people: a sentence and a remedy in their language, and the original message of the corpus.

use std::io::ErrorKind;

use chereme_corpus::remedy::Remedy;
use chereme_corpus::words::message;
use chereme_corpus::{Cause, Error};

use super::remedy;
use crate::words::{Language, Text, fill, trouble as words};

/// The report of a failure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FailureReport {
    pub(crate) text: String,
    pub(crate) remedy: Option<String>,
    /// The original message of the corpus, if the sentence does not contain all of it.
    pub(crate) detail: Option<String>,
}

/// Returns the report of a failure of `task`, which is a noun such as `Import`.
pub(crate) fn failure_report(
    error: &Error,
    task: Option<Text>,
    language: Language,
) -> FailureReport {
    let helps = |remedy: &str| {
        let text = crate::words::shell::REMEDY.of(language);
        fill(text, &[("remedy", &remedy)])
    };
    let of_corpus = error.remedy();
    let own = of_corpus.as_ref().and_then(|it| remedy::here(it, language));
    if language == Language::English {
        return FailureReport {
            text: error.to_string(),
            remedy: own.map(|it| helps(&it)),
            detail: None,
        };
    }
    let (text, remedy) = sentence(error, task, language);
    // The sentence is complete for a file error with a remedy, and for a translated message.
    let translated = message(&error.to_string(), language).is_some_and(|it| it == text);
    let whole = matches!(error, Error::File { .. }) && remedy.is_some() || translated;
    let in_language = translated || matches!(of_corpus, Some(Remedy::Choice(..)));
    let remedy = remedy
        .map(|it| it.of(language).to_owned())
        .or(own.clone().filter(|_| in_language));
    let original = match &own {
        Some(own) if remedy.is_none() => format!("{error}\n({own})"),
        _ => error.to_string(),
    };
    FailureReport {
        text,
        remedy: remedy.map(|it| helps(&it)),
        detail: (!whole).then_some(original),
    }
}

/// Returns one sentence about the failure, and a remedy.
fn sentence(error: &Error, task: Option<Text>, language: Language) -> (String, Option<Text>) {
    let say = |text: Text| text.of(language).to_owned();
    match error {
        Error::File { path, source } => {
            let (text, remedy) = match source.kind() {
                ErrorKind::NotFound => (words::NOT_FOUND, Some(words::CHECK_PATH)),
                ErrorKind::AlreadyExists => (words::THERE_ALREADY, Some(words::OTHER_NAME)),
                ErrorKind::PermissionDenied => (words::NOT_ALLOWED, Some(words::ASK_RIGHTS)),
                ErrorKind::StorageFull => (words::DISK_FULL, Some(words::MAKE_ROOM)),
                _ => (words::FILE_FAILED, None),
            };
            (fill(&say(text), &[("path", &path.display())]), remedy)
        }
        Error::NotACorpus { path, .. } => {
            let text = say(words::NOT_A_CORPUS);
            let text = fill(&text, &[("path", &path.display())]);
            (text, None)
        }
        Error::Database(_) => match error.cause() {
            Some(Cause::Busy) => (say(words::BUSY), Some(words::TRY_AGAIN)),
            Some(Cause::Full) => (say(words::DISK_FULL), Some(words::MAKE_ROOM)),
            Some(Cause::ReadOnly) => (say(words::READ_ONLY), Some(words::ASK_RIGHTS)),
            Some(Cause::Damaged) => (say(words::DAMAGED), Some(words::CHECK_HERE)),
            None => (say(words::DATABASE), None),
        },
        Error::Index(_) => (say(words::INDEX), None),
        Error::Damaged { .. } => (say(words::DAMAGED), None),
        Error::Several { errors } => {
            let text = say(words::SEVERAL);
            (fill(&text, &[("n", &errors.len())]), None)
        }
        _ => match message(&error.to_string(), language) {
            Some(said) => (said, None),
            None => failed(task, language),
        },
    }
}

/// Returns a general sentence about a failure whose message has no translation.
fn failed(task: Option<Text>, language: Language) -> (String, Option<Text>) {
    let say = |text: Text| text.of(language).to_owned();
    match task {
        Some(task) => {
            let task = say(task);
            let text = fill(&say(words::TASK_FAILED), &[("task", &task)]);
            (text, None)
        }
        None => (say(words::FAILED), None),
    }
}

#[cfg(test)]
mod tests {
    use chereme_corpus::remedy::Choice;

    use super::*;
    use crate::words::shell;

    #[test]
    fn a_failure_is_shown_in_the_language_of_the_window_with_the_original_message() {
        let error = Error::wrong("no such tier").advise("add it");
        let english = failure_report(&error, Some(shell::TASK_EDIT), Language::English);
        assert_eq!(english.text, "no such tier");
        assert_eq!(english.remedy.as_deref(), Some("What helps: add it"));
        assert_eq!(english.detail, None);
        let french = failure_report(&error, Some(shell::TASK_IMPORT), Language::French);
        assert_eq!(french.text, "Importation : cela n’a pas été possible.");
        assert_eq!(french.detail.as_deref(), Some("no such tier\n(add it)"));
        let known = Error::wrong("the table asks for nothing");
        let french = failure_report(&known, None, Language::French);
        assert_eq!(french.text, "la table ne demande rien");
        assert_eq!((french.remedy, french.detail), (None, None));
        let rubbish = Error::NotACorpus {
            path: "a.chereme".into(),
            reason: "it is no database".into(),
            remedy: Remedy::choice(Choice::OtherCorpus, "choose a file that `chereme new` made"),
        };
        for language in [Language::English, Language::French] {
            let remedy = failure_report(&rubbish, None, language)
                .remedy
                .expect("a remedy");
            assert!(!remedy.contains('`'), "{remedy}");
        }
        let gone = Error::file("a.bvh", ErrorKind::NotFound.into());
        let french = failure_report(&gone, None, Language::French);
        assert_eq!(french.text, "a.bvh : rien ne porte ce nom.");
        assert!(french.remedy.is_some() && french.detail.is_none());
    }
}
