//! Guides with examples in French, line by line, such as the help of queries.

use chereme_analysis::detect::ALL_DETECTORS;

use super::InterfaceLanguage;
use super::phrases::{PhraseBook, phrase_book};

/// Returns a guide in `language`: its headings, and the notes two blanks or more behind an example; examples stay.
#[must_use]
pub fn translate_guide(text: &str, language: InterfaceLanguage) -> String {
    let Some(book) = phrase_book(language) else {
        return text.to_owned();
    };
    let lines = text.split('\n').map(|line| translated_line(line, book, language));
    lines.collect::<Vec<_>>().join("\n")
}

fn translated_line(line: &str, book: &PhraseBook, language: InterfaceLanguage) -> String {
    let words = line.trim_start();
    let note = words.rsplit("  ").next().unwrap_or(words);
    let in_book = |text: &str| {
        let translations = ["guide", "help"].into_iter();
        let mut written = translations.filter_map(|kind| book.fixed_text(kind, text));
        written.next().or_else(|| described_effect(text, language))
    };
    for english in [words, note] {
        if let Some(french) = in_book(english) {
            return format!("{}{french}", &line[..line.len() - english.len()]);
        }
    }
    line.to_owned()
}

/// Returns in `language` what a detector finds.
fn described_effect(english: &str, language: InterfaceLanguage) -> Option<&'static str> {
    let mut detectors = ALL_DETECTORS
        .iter()
        .map(|detector| detector.detector_description().finds);
    let matched_detector = detectors.find(|finds| finds.text_in_language(InterfaceLanguage::English) == english);
    matched_detector.map(|finds| finds.text_in_language(language))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_of_queries_is_french_and_keeps_its_examples() {
        let english = crate::QUERY_HELP;
        assert_eq!(translate_guide(english, InterfaceLanguage::English), english);
        let french = translate_guide(english, InterfaceLanguage::French);
        assert_eq!(french.lines().count(), english.lines().count());
        assert!(
            french.starts_with("Une requête est") && !french.contains(" the "),
            "{french}"
        );
        for line in [
            "  right.configuration=U placement=chin    U à la main droite, près du menton",
            "  placement=*                             a une valeur principale ; les parties ne comptent pas",
            "  placement=unset   =n/a   =unclear       sa valeur principale manque : trois sortes",
            "  gloss~ESCARGO   gloss~ESCRGO~2          à une faute près, ou deux",
            "  overlaps  not-overlaps  inside  not-inside  overlaps-begin  overlaps-end",
        ] {
            assert!(french.lines().any(|it| it == line), "{line}");
        }
    }
}
