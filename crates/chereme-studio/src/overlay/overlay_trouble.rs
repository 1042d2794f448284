//! Failures for people: a sentence and a remedy in their language, and the original message of the corpus.

use std::io::ErrorKind;

use chereme_corpus::remedy::ErrorRemedy;
use chereme_corpus::words::localized_message;
use chereme_corpus::{CorpusError, DatabaseFailureCause};

use crate::window_remedy;
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, trouble_words as words};

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
    error: &CorpusError,
    task: Option<InterfaceText>,
    language: InterfaceLanguage,
) -> FailureReport {
    let helps = |remedy: &str| {
        let text = crate::words::shell::REMEDY.text_in_language(language);
        fill_text_braces(text, &[("remedy", &remedy)])
    };
    let of_corpus = error.error_remedy();
    let remedy_text = of_corpus
        .as_ref()
        .and_then(|remedy| window_remedy::window_remedy_text(remedy, language));
    if language == InterfaceLanguage::English {
        return FailureReport {
            text: error.to_string(),
            remedy: remedy_text.map(|advice| helps(&advice)),
            detail: None,
        };
    }
    let (text, remedy) = failure_sentence(error, task, language);
    // The sentence is complete for a file error with a remedy, and for a translated message.
    let translated = localized_message(&error.to_string(), language).is_some_and(|translation| translation == text);
    let is_complete = matches!(error, CorpusError::File { .. }) && remedy.is_some() || translated;
    let in_language = translated || matches!(of_corpus, Some(ErrorRemedy::Choice(..)));
    let remedy = remedy
        .map(|advice| advice.text_in_language(language).to_owned())
        .or(remedy_text.clone().filter(|_| in_language));
    let original = match &remedy_text {
        Some(own) if remedy.is_none() => format!("{error}\n({own})"),
        _ => error.to_string(),
    };
    FailureReport {
        text,
        remedy: remedy.map(|advice| helps(&advice)),
        detail: (!is_complete).then_some(original),
    }
}

/// Returns one sentence about the failure, and a remedy.
fn failure_sentence(
    error: &CorpusError,
    task: Option<InterfaceText>,
    language: InterfaceLanguage,
) -> (String, Option<InterfaceText>) {
    let say = |text: InterfaceText| text.text_in_language(language).to_owned();
    match error {
        CorpusError::File { path, source } => {
            let (text, remedy) = match source.kind() {
                ErrorKind::NotFound => (words::NOT_FOUND, Some(words::CHECK_PATH)),
                ErrorKind::AlreadyExists => (words::THERE_ALREADY, Some(words::OTHER_NAME)),
                ErrorKind::PermissionDenied => (words::NOT_ALLOWED, Some(words::ASK_RIGHTS)),
                ErrorKind::StorageFull => (words::DISK_FULL, Some(words::MAKE_ROOM)),
                _ => (words::FILE_FAILED, None),
            };
            (fill_text_braces(&say(text), &[("path", &path.display())]), remedy)
        }
        CorpusError::NotACorpus { path, .. } => {
            let template = say(words::NOT_A_CORPUS);
            let text = fill_text_braces(&template, &[("path", &path.display())]);
            (text, None)
        }
        CorpusError::Database(_) => match error.database_failure_cause() {
            Some(DatabaseFailureCause::Busy) => (say(words::BUSY), Some(words::TRY_AGAIN)),
            Some(DatabaseFailureCause::Full) => (say(words::DISK_FULL), Some(words::MAKE_ROOM)),
            Some(DatabaseFailureCause::ReadOnly) => (say(words::READ_ONLY), Some(words::ASK_RIGHTS)),
            Some(DatabaseFailureCause::Damaged) => (say(words::DAMAGED), Some(words::CHECK_HERE)),
            None => (say(words::DATABASE), None),
        },
        CorpusError::Index(_) => (say(words::INDEX), None),
        CorpusError::Damaged { .. } => (say(words::DAMAGED), None),
        CorpusError::Several { errors, .. } => {
            let text = say(words::SEVERAL);
            (fill_text_braces(&text, &[("n", &errors.len())]), None)
        }
        _ => match localized_message(&error.to_string(), language) {
            Some(said) => (said, None),
            None => general_failure_sentence(task, language),
        },
    }
}

/// Returns a general sentence about a failure whose message has no translation.
fn general_failure_sentence(
    task: Option<InterfaceText>,
    language: InterfaceLanguage,
) -> (String, Option<InterfaceText>) {
    let say = |text: InterfaceText| text.text_in_language(language).to_owned();
    match task {
        Some(task) => {
            let task = say(task);
            let text = fill_text_braces(&say(words::TASK_FAILED), &[("task", &task)]);
            (text, None)
        }
        None => (say(words::FAILED), None),
    }
}

#[cfg(test)]
mod tests {
    use chereme_corpus::remedy::RemedyChoice;

    use super::*;
    use crate::words::shell;

    #[test]
    fn a_failure_is_shown_in_the_language_of_the_window_with_the_original_message() {
        let error = CorpusError::from_wrong_message("no such tier").with_advice("add it");
        let english = failure_report(&error, Some(shell::TASK_EDIT), InterfaceLanguage::English);
        assert_eq!(english.text, "no such tier");
        assert_eq!(english.remedy.as_deref(), Some("What helps: add it"));
        assert_eq!(english.detail, None);
        let french = failure_report(&error, Some(shell::TASK_IMPORT), InterfaceLanguage::French);
        assert_eq!(french.text, "Importation : cela n’a pas été possible.");
        assert_eq!(french.detail.as_deref(), Some("no such tier\n(add it)"));
        let known = CorpusError::from_wrong_message("the table asks for nothing");
        let french = failure_report(&known, None, InterfaceLanguage::French);
        assert_eq!(french.text, "la table ne demande rien");
        assert_eq!((french.remedy, french.detail), (None, None));
        let rubbish = CorpusError::NotACorpus {
            path: "a.chereme".into(),
            reason: "it is no database".into(),
            remedy: ErrorRemedy::choice_remedy(RemedyChoice::OtherCorpus, "choose a file that `chereme new` made"),
        };
        for language in [InterfaceLanguage::English, InterfaceLanguage::French] {
            let remedy = failure_report(&rubbish, None, language).remedy.expect("a remedy");
            assert!(!remedy.contains('`'), "{remedy}");
        }
        let gone = CorpusError::from_file_failure("a.bvh", ErrorKind::NotFound.into());
        let french = failure_report(&gone, None, InterfaceLanguage::French);
        assert_eq!(french.text, "a.bvh : rien ne porte ce nom.");
        assert!(french.remedy.is_some() && french.detail.is_none());
    }
}
