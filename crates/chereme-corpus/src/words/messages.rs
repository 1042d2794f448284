//! Messages of the library in another language, looked up by their English form.
//!
//! The library writes its messages in English. The files of words hold each message and its form in another language; a
//! variable part is put into that language as well if the files have it, and copied otherwise.

use chereme_analysis::detect::DETECTORS;
use chereme_compose::recipe::Step;

use super::Language;
use super::count::counted_in_french;
use super::parts::{by_lines, is_quoted, placed_in_french, side_in_french};
use super::phrases::{Phrase, PhraseBook, PhrasePair, phrase_book};
use crate::import::readers::endings;

/// Returns a message in `language`; nothing if the files of words lack it.
#[must_use]
pub(super) fn message(text: &str, language: Language) -> Option<String> {
    match phrase_book(language) {
        None => Some(text.to_owned()),
        Some(book) => translated_message(text, book),
    }
}

/// Returns the messages that stand beside the code of operators and detectors.
pub(super) fn described_messages() -> impl Iterator<Item = PhrasePair> {
    let operators = Step::DESCRIPTIONS.iter().flat_map(|it| it.messages);
    let detectors = DETECTORS.iter().flat_map(|it| it.description().messages);
    operators.chain(detectors).map(|text| PhrasePair {
        english: Phrase::from_form(text.en),
        other: Phrase::from_form(text.fr),
    })
}

fn translated_message(text: &str, book: &PhraseBook) -> Option<String> {
    let part = |blank: &str, part: &str| {
        if blank == "list" {
            let each = part.split("; ");
            let each =
                each.map(|item| translated_message(item, book).unwrap_or_else(|| item.to_owned()));
            return each.collect::<Vec<_>>().join(" ; ");
        }
        let side = side_in_french(blank, part).map(str::to_owned);
        let spoken = || translated_message(part, book).filter(|_| !is_quoted(part));
        side.or_else(spoken).unwrap_or_else(|| part.to_owned())
    };
    if text.starts_with('.') && text == endings(Language::English) {
        return Some(endings(Language::French));
    }
    let mut pairs = book.messages.iter();
    let translated = pairs.find_map(|pair| pair.translate(text, &part));
    translated
        .or_else(|| counted_in_french(text))
        .or_else(|| placed_in_french(text, &|inner| part("", inner)))
        .or_else(|| by_lines(text, &|line| part("", line)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_failures_have_french_messages() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let mut corpus = crate::Corpus::create(&path, "A").expect("made");
        let mut hear = crate::unheard;
        let progress = &mut crate::Progress::new(&mut hear);
        let failures = [
            corpus.undo().map(drop),
            corpus.redo().map(drop),
            corpus.recombine("NONE | swap", "X").map(drop),
            corpus.preview("| ").map(drop),
            corpus
                .suggest(&"NONE".parse().expect("an address"))
                .map(drop),
            corpus.operation(99, 1).map(drop),
            crate::Corpus::open(&folder.path().join("none"), "A").map(drop),
            crate::Corpus::create(&path, "A").map(drop),
            corpus
                .export(
                    &crate::ExportWhat::All,
                    &folder.path().join("x.xyz"),
                    &crate::ExportOptions::default(),
                    progress,
                )
                .map(drop),
        ];
        for failure in failures {
            let text = failure.expect_err("a failure").to_string();
            let french = message(&text, Language::French);
            assert!(french.is_some_and(|it| it != text), "{text}");
        }
        assert_eq!(message("no such words", Language::French), None);
        for (english, french) in [
            (
                "a.png cannot be opened as a corpus: there is nothing of this name",
                "a.png ne s’ouvre pas comme corpus : rien ne porte ce nom",
            ),
            (
                "lines end with CR LF, as on Windows",
                "les lignes finissent par CR LF, comme sous Windows",
            ),
            (
                "<eye_gaze> belongs into <eyegaze_tier>; it was kept in <facialexpr_tier>",
                "<eye_gaze> a sa place dans <eyegaze_tier> ; gardé dans <facialexpr_tier>",
            ),
        ] {
            let said = message(english, Language::French);
            assert_eq!(said.as_deref(), Some(french));
        }
        let inside = "gloss=ESC finds nothing: no sign has such a gloss; there are: ESCARGOT";
        assert_eq!(
            message(inside, Language::French).as_deref(),
            Some("gloss=ESC ne trouve rien : aucun signe n’a une telle glose ; il y a : ESCARGOT")
        );
        assert_eq!(message("x", Language::English).as_deref(), Some("x"));
        assert_eq!(
            message(
                "no sign is called \"BOLL\"; did you mean \"BOL\"?",
                Language::French
            )
            .as_deref(),
            Some("aucun signe ne s’appelle \"BOLL\" ; vouliez-vous dire \"BOL\" ?")
        );
    }
}
