//! Words of the pages in every language that has some, from the ids `page-…` of the folders of words.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use chereme_sign::tier::AnnotatedHands;
use chereme_sign::words::folders::{language_files, own_english, phrase_text};
use chereme_sign::{HandRef, SignComponent, SignPhase};

use crate::map::escape_markup;
use crate::words::{InterfaceLanguage, fill_text_braces};

/// Ids of the texts of the script, which knows the rest of them.
const SCRIPT_IDS: &str = "page-script-";

/// Returns the languages of the pages with their own names for themselves: those whose folders speak of pages.
fn page_languages() -> Vec<(InterfaceLanguage, &'static str)> {
    let mut languages = InterfaceLanguage::all_listed();
    languages.retain(|(language, _)| {
        let files = language_files().get(language.language_code());
        files.is_some_and(|files| files.word_book().keys().any(|id| id.starts_with("page-")))
    });
    languages
}

/// Returns a text of the pages in `language`.
pub(super) fn page_text(name: &str, language: InterfaceLanguage) -> &'static str {
    phrase_text(&format!("page-{name}"), language).unwrap_or_default()
}

/// Returns a text of the pages in every language.
pub(super) fn page_text_all_languages(name: &str) -> String {
    in_all(|language| page_text(name, language).to_owned())
}

/// Returns a text in every language for a page: with a script one of them is shown, without one all.
pub(super) fn in_all(text: impl Fn(InterfaceLanguage) -> String) -> String {
    let mut texts: Vec<(String, Vec<&str>)> = Vec::new();
    for (language, _) in page_languages() {
        let text = text(language);
        match texts.iter_mut().find(|(known, _)| *known == text) {
            Some((_, codes)) => codes.push(language.language_code()),
            None => texts.push((text, vec![language.language_code()])),
        }
    }
    if let [(text, _)] = &texts[..] {
        return escape_markup(text);
    }
    let span = |(text, codes): &(String, Vec<&str>)| {
        let (lang, codes, text) = (codes[0], codes.join(" "), escape_markup(text));
        format!("<span lang=\"{lang}\" data-in=\"{codes}\">{text}</span>")
    };
    let spans: String = texts.iter().map(span).collect();
    format!("<span class=\"t\">{spans}</span>")
}

/// Returns the styles that show the chosen language only.
pub(super) fn language_styles() -> String {
    let mut styles = String::new();
    for (language, _) in page_languages() {
        let code = language.language_code();
        let _ = writeln!(
            styles,
            "[data-lang={code}] .t > :not([data-in~={code}]) {{ display: none; }}"
        );
    }
    styles
}

/// Returns the texts of the script in every language, as JSON.
pub(super) fn script_texts() -> Value {
    let mut languages = Map::new();
    for (language, own_name) in page_languages() {
        let mut texts = Map::from_iter([("language".to_owned(), json!(own_name))]);
        for id in own_english().keys() {
            if let Some(name) = id.strip_prefix(SCRIPT_IDS) {
                texts.insert(name.to_owned(), json!(phrase_text(id, language)));
            }
        }
        languages.insert(language.language_code().to_owned(), Value::Object(texts));
    }
    Value::Object(languages)
}

/// Returns the texts of what is shown instead of a page without a connection, in every language below each other, as JSON.
pub(super) fn offline_texts(days: &str) -> Value {
    let in_lines = |name: &str, tag: &str, between: &str| {
        let line = |(language, _): &(InterfaceLanguage, &str)| {
            let text = fill_text_braces(page_text(name, *language), &[("days", &days)]);
            let (code, text) = (language.language_code(), escape_markup(&text));
            format!("<{tag} lang=\"{code}\">{text}</{tag}>")
        };
        let lines: Vec<String> = page_languages().iter().map(line).collect();
        lines.join(between)
    };
    json!({
        "name": page_text("offline-title", InterfaceLanguage::English),
        "title": in_lines("offline-title", "span", " · "),
        "missing": in_lines("offline-missing", "p", ""),
        "old": in_lines("offline-old", "p", ""),
        "search": in_lines("offline-search", "span", " · "),
    })
}

fn page_name_word(word: &str, language: InterfaceLanguage) -> String {
    let phrase = phrase_text(&format!("page-name-{word}"), language);
    phrase.unwrap_or(word).to_owned()
}

/// Returns the words for a field of a value.
pub(super) fn value_field_words(
    component: SignComponent,
    feature: Option<&str>,
    hand: Option<AnnotatedHands>,
    phase: Option<SignPhase>,
    language: InterfaceLanguage,
) -> String {
    let named = |word: &str| page_name_word(word, language);
    let mut text = named(&component.to_string());
    if let Some(feature) = feature.map(named) {
        let values: [(&str, &dyn std::fmt::Display); 2] = [("field", &text), ("feature", &feature)];
        text = fill_text_braces(page_text("field-feature", language), &values);
    }
    let hand = hand.map(|value| named(value.annotated_hands_name()));
    let phase = phase.map(|value| named(crate::db::stored_columns::phase_name(value)));
    let more: Vec<String> = hand.into_iter().chain(phase).collect();
    match more.is_empty() {
        true => text,
        false => format!("{text} ({})", more.join(", ")),
    }
}

/// Returns the words for the name of a coded field, such as `weak.configuration`.
pub(super) fn coded_field(name: &str, language: InterfaceLanguage) -> String {
    let parsed_field = name.parse::<chereme_sign::ComponentField>();
    parsed_field.map_or_else(
        |_| name.to_owned(),
        |parsed| {
            // Without a hand in the name, the dominant one is meant.
            let hand = parsed
                .hand
                .filter(|hand| *hand != HandRef::Dominant)
                .map(AnnotatedHands::One);
            value_field_words(
                parsed.component,
                parsed.feature.as_deref(),
                hand,
                parsed.phase,
                language,
            )
        },
    )
}

#[cfg(test)]
mod tests {
    use chereme_sign::inventory;

    use super::*;

    #[test]
    fn features_of_inventories_and_of_known_tables_have_words() {
        let own = inventory::builtin_inventories()
            .iter()
            .filter_map(|it| it.feature.as_deref());
        let tables = [
            "handedness",
            "shape",
            "repeated",
            "alternating",
            "change",
            "relative-movement",
            "relative-location",
        ];
        let missing: Vec<&str> = own
            .chain(tables)
            .filter(|word| !own_english().contains_key(&format!("page-name-{word}")))
            .collect();
        assert!(missing.is_empty(), "{missing:?}");
        let repeated = |language| value_field_words(SignComponent::Movement, Some("repeated"), None, None, language);
        assert_eq!(repeated(InterfaceLanguage::French), "mouvement\u{a0}: répété");
        let german = InterfaceLanguage::from_code("de").expect("German");
        assert_eq!(repeated(german), "Bewegung: wiederholt");
    }

    #[test]
    fn every_text_that_the_pages_name_exists() {
        let source = include_str!("pages.rs");
        let names = source.split("page_text_all_languages(\"").skip(1);
        let names: Vec<&str> = names.filter_map(|rest| rest.split('"').next()).collect();
        assert!(names.len() > 8, "{names:?}");
        for name in names {
            assert_ne!(page_text(name, InterfaceLanguage::English), "", "{name}");
        }
    }

    #[test]
    fn pages_speak_every_language_and_fall_back_to_english() {
        let form = page_text_all_languages("form");
        assert!(form.contains("<span lang=\"fr\" data-in=\"fr\">Forme</span>"), "{form}");
        let texts = script_texts();
        assert_eq!(texts["de"]["language"], "Deutsch");
        assert_eq!(texts["de"]["clear"], "Neu beginnen");
        let same = in_all(|language| match language {
            InterfaceLanguage::French => "b".to_owned(),
            _ => "a<".to_owned(),
        });
        assert!(
            same.contains("<span lang=\"en\" data-in=\"en de\">a&lt;</span>"),
            "{same}"
        );
        assert_eq!(page_text("form", InterfaceLanguage::Other("tlh")), "Form");
        assert!(language_styles().contains("[data-lang=de] .t > :not([data-in~=de])"));
    }
}
