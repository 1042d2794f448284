//! The usual texts of questionnaires in English and French: questions, labels, and questions about the participant.

use std::collections::BTreeMap;

use super::study_plan::{ChoiceOption, LocalizedTexts, ProfileQuestion};

/// Returns a text in both languages.
pub(super) fn text_in_both_languages(english: &str, french: &str) -> LocalizedTexts {
    let pair = [("en", english), ("fr", french)];
    pair.map(|(language, text)| (language.to_owned(), text.to_owned()))
        .into()
}

/// A question with a scale: its name, the question, and the lowest, middle and highest label, in English and French.
type ScaleQuestionTexts = (&'static str, [&'static str; 2], [[&'static str; 2]; 3]);

/// The usual questions with a scale.
const DEFAULT_SCALE_QUESTIONS: [ScaleQuestionTexts; 4] = [
    (
        "realism",
        [
            "How realistic are the movements?",
            "Les mouvements sont-ils réalistes ?",
        ],
        [
            ["not at all", "pas du tout"],
            ["moderately", "moyennement"],
            ["entirely", "tout à fait"],
        ],
    ),
    (
        "naturalness",
        [
            "How natural does the signing look?",
            "La façon de signer paraît-elle naturelle ?",
        ],
        [
            ["not at all", "pas du tout"],
            ["moderately", "moyennement"],
            ["entirely", "tout à fait"],
        ],
    ),
    (
        "clarity",
        ["How easy is it to understand?", "Est-ce facile à comprendre ?"],
        [
            ["very hard", "très difficile"],
            ["moderately easy", "moyennement facile"],
            ["very easy", "très facile"],
        ],
    ),
    (
        "notice",
        [
            "Did the face express a question, a negation or an emotion?",
            "Le visage exprimait-il une question, une négation ou une émotion ?",
        ],
        [
            ["not at all", "pas du tout"],
            ["somewhat", "un peu"],
            ["very clearly", "très nettement"],
        ],
    ),
];

/// Usual choices by name: the question in English and French.
const DEFAULT_CHOICE_TEXTS: [(&str, [&str; 2]); 3] = [
    ("gloss", ["Which sign did you see?", "Quel signe avez-vous vu ?"]),
    (
        "place",
        ["Where is the thing that was shown?", "Où se trouve l’objet montré ?"],
    ),
    ("meaning", ["What does it mean?", "Qu’est-ce que cela veut dire ?"]),
];

/// Returns the usual text of a question; its name if it has none.
pub(super) fn default_question_text(name: &str) -> LocalizedTexts {
    let scale = DEFAULT_SCALE_QUESTIONS
        .iter()
        .find(|entry| entry.0 == name)
        .map(|entry| entry.1);
    let choice = DEFAULT_CHOICE_TEXTS
        .iter()
        .find(|entry| entry.0 == name)
        .map(|entry| entry.1);
    match scale.or(choice) {
        Some([english, french]) => text_in_both_languages(english, french),
        None => text_in_both_languages(name, name),
    }
}

/// Returns the usual labels of a scale: at its ends, and in the middle if one number is there.
pub(super) fn default_scale_labels(name: &str, low: i64, high: i64) -> BTreeMap<i64, LocalizedTexts> {
    let usual = DEFAULT_SCALE_QUESTIONS
        .iter()
        .find(|entry| entry.0 == name)
        .map(|entry| entry.2);
    let Some([least, middle, most]) = usual else {
        return BTreeMap::new();
    };
    let mut labels: BTreeMap<i64, LocalizedTexts> = [(low, least), (high, most)]
        .map(|(at, [english, french])| (at, text_in_both_languages(english, french)))
        .into();
    if (high - low) % 2 == 0 {
        labels.insert((low + high) / 2, text_in_both_languages(middle[0], middle[1]));
    }
    labels
}

/// Questions about the participant: name, question, options.
type ProfileQuestionTexts = (&'static str, [&'static str; 2], &'static [[&'static str; 3]]);

/// The usual questions about the participant; options by name, in English and in French.
const DEFAULT_PROFILE_TEXTS: [ProfileQuestionTexts; 4] = [
    (
        "age",
        ["How old are you?", "Quel âge avez-vous ?"],
        &[
            ["18-24", "18 to 24", "18 à 24 ans"],
            ["25-34", "25 to 34", "25 à 34 ans"],
            ["35-44", "35 to 44", "35 à 44 ans"],
            ["45-54", "45 to 54", "45 à 54 ans"],
            ["55-64", "55 to 64", "55 à 64 ans"],
            ["65+", "65 or older", "65 ans ou plus"],
        ],
    ),
    (
        "hearing",
        ["Are you …", "Êtes-vous …"],
        &[
            ["born-deaf", "deaf from birth", "sourd·e de naissance"],
            ["became-deaf", "became deaf later", "devenu·e sourd·e"],
            ["hard-of-hearing", "hard of hearing", "malentendant·e"],
            ["hearing", "hearing", "entendant·e"],
        ],
    ),
    (
        "signing-since",
        [
            "Since which age have you been signing?",
            "Depuis quel âge signez-vous ?",
        ],
        &[
            ["0-3", "before I was 4", "avant 4 ans"],
            ["4-8", "from 4 to 8", "entre 4 et 8 ans"],
            ["9-17", "from 9 to 17", "entre 9 et 17 ans"],
            ["18+", "as an adult", "à l’âge adulte"],
            ["never", "I do not sign", "je ne signe pas"],
        ],
    ),
    (
        "level",
        [
            "How well do you sign in the language of the films?",
            "Quel est votre niveau dans la langue des films ?",
        ],
        &[
            ["none", "not at all", "aucune connaissance"],
            ["beginner", "beginner", "débutant"],
            ["quite-good", "quite good", "assez bon"],
            ["good", "good", "bon"],
            ["very-good", "very good", "très bon"],
            ["native", "native", "langue maternelle"],
            ["interpreter", "interpreter", "interprète"],
        ],
    ),
];

/// Returns the usual questions about the participant.
pub(super) fn default_profile_questions() -> Vec<ProfileQuestion> {
    let option = |[name, english, french]: &[&str; 3]| ChoiceOption {
        name: (*name).to_owned(),
        text: text_in_both_languages(english, french),
        picture: None,
    };
    DEFAULT_PROFILE_TEXTS
        .iter()
        .map(|(name, [english, french], options)| ProfileQuestion {
            name: (*name).to_owned(),
            text: text_in_both_languages(english, french),
            options: options.iter().map(option).collect(),
        })
        .collect()
}
