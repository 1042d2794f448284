//! The usual texts of questionnaires: questions, labels, and questions about the participant. They are data, in
//! `schema/studies/usual_questions.json`.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

use super::study_plan::{LocalizedTexts, ProfileQuestion};

/// The usual questions.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct UsualQuestions {
    /// Questions with a scale, by name.
    scales: BTreeMap<String, ScaleQuestion>,
    /// Questions with a choice, by name.
    choices: BTreeMap<String, LocalizedTexts>,
    /// Questions about the participant.
    profile: Vec<ProfileQuestion>,
}

/// A question with a scale, and its lowest, middle and highest label.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScaleQuestion {
    question: LocalizedTexts,
    labels: [LocalizedTexts; 3],
}

static USUAL_QUESTIONS: LazyLock<UsualQuestions> = LazyLock::new(|| {
    let text = chereme_data::schema_text("studies/usual_questions.json");
    serde_json::from_str(text).expect("the usual questions are well formed")
});

/// Returns a text in both languages.
pub(super) fn text_in_both_languages(english: &str, french: &str) -> LocalizedTexts {
    let pair = [("en", english), ("fr", french)];
    pair.map(|(language, text)| (language.to_owned(), text.to_owned()))
        .into()
}

/// Returns the usual text of a question; its name if it has none.
pub(super) fn default_question_text(name: &str) -> LocalizedTexts {
    let scale = USUAL_QUESTIONS.scales.get(name).map(|scale| &scale.question);
    let usual = scale.or_else(|| USUAL_QUESTIONS.choices.get(name));
    usual.map_or_else(|| text_in_both_languages(name, name), Clone::clone)
}

/// Returns the usual labels of a scale: at its ends, and in the middle if one number is there.
pub(super) fn default_scale_labels(name: &str, low: i64, high: i64) -> BTreeMap<i64, LocalizedTexts> {
    let Some(scale) = USUAL_QUESTIONS.scales.get(name) else {
        return BTreeMap::new();
    };
    let [least, middle, most] = scale.labels.clone();
    let mut labels = BTreeMap::from([(low, least), (high, most)]);
    if (high - low) % 2 == 0 {
        labels.insert((low + high) / 2, middle);
    }
    labels
}

/// Returns the usual questions about the participant.
pub(super) fn default_profile_questions() -> Vec<ProfileQuestion> {
    USUAL_QUESTIONS.profile.clone()
}
