//! Remedies in the words of the window.

use chereme_corpus::CorpusError;
use chereme_corpus::remedy::{ErrorRemedy, RemedyChoice};
use eframe::egui::{Color32, RichText, Ui};

use crate::words::{
    InterfaceLanguage, InterfaceText, export_words, import_words as words, shell, translate_library_message,
    trouble_words,
};

/// A failure that is shown beside the work that failed.
#[derive(Debug)]
pub(crate) struct ShownFailure {
    message: String,
    remedy: Option<ErrorRemedy>,
}

impl ShownFailure {
    pub(crate) fn from_error(error: &CorpusError) -> Self {
        // The query stands beside the failure, so that it is not drawn once more.
        let message = match error {
            CorpusError::Query(wrong) => wrong.message.clone(),
            other => other.to_string(),
        };
        let remedy = error.error_remedy();
        Self { message, remedy }
    }

    /// Shows the message in a colour, and the remedy below it.
    pub(crate) fn show_failure(&self, ui: &mut Ui, language: InterfaceLanguage, colour: Color32) {
        let lines = self
            .message
            .lines()
            .map(|line| translate_library_message(line, language));
        let text = lines.collect::<Vec<String>>().join("\n");
        ui.label(RichText::new(text).color(colour));
        let remedy = self.remedy.as_ref();
        if let Some(remedy) = remedy.and_then(|remedy| window_remedy_text(remedy, language)) {
            ui.small(remedy);
        }
    }
}

/// Returns the remedy in the words of the window; `None` if only the command line offers one.
pub(crate) fn window_remedy_text(remedy: &ErrorRemedy, language: InterfaceLanguage) -> Option<String> {
    match remedy {
        ErrorRemedy::Advice(text) => Some(translate_library_message(text, language)),
        ErrorRemedy::Choice(choice, _) => Some(offered_choice_text(*choice).text_in_language(language).to_owned()),
        ErrorRemedy::Command(_) => None,
    }
}

/// Returns the text for a choice, which names its place in the window.
fn offered_choice_text(choice: RemedyChoice) -> InterfaceText {
    match choice {
        RemedyChoice::JointRoles => words::HELP_ROLES,
        RemedyChoice::RootOrder => words::HELP_ROOT,
        RemedyChoice::Unit => words::HELP_UNIT,
        RemedyChoice::Axes => words::HELP_AXES,
        RemedyChoice::TierRoles => words::HELP_TIERS,
        RemedyChoice::TiersLike => words::HELP_TEMPLATE,
        RemedyChoice::CommonAncestor => words::HELP_MERGE,
        RemedyChoice::Side => words::HELP_CHANGED,
        RemedyChoice::Joining => words::HELP_JOINING,
        RemedyChoice::OtherCorpus => trouble_words::OTHER_CORPUS,
        RemedyChoice::Check => trouble_words::CHECK_HERE,
        RemedyChoice::Consent => export_words::HELP_CONSENT,
        RemedyChoice::Notation => shell::HELP_NOTATION,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_says_in_its_own_words_where_a_choice_is_offered() {
        let unit = ErrorRemedy::choice_remedy(RemedyChoice::Unit, "say the unit with --unit, such as --unit cm");
        for (language, begins) in [
            (InterfaceLanguage::English, "Choose the unit"),
            (InterfaceLanguage::French, "Choisissez l’unité"),
        ] {
            let shown = window_remedy_text(&unit, language).expect("a choice of the window");
            assert!(shown.starts_with(begins), "{shown}");
        }
    }

    #[test]
    fn advice_is_shown_as_it_is_and_commands_are_not() {
        let advice = ErrorRemedy::from("correct the number in the file");
        assert_eq!(
            window_remedy_text(&advice, InterfaceLanguage::English).as_deref(),
            Some(advice.remedy_text())
        );
        let command = ErrorRemedy::command_remedy("`chereme list CORPUS tokens`");
        assert_eq!(window_remedy_text(&command, InterfaceLanguage::English), None);
    }
}
