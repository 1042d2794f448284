//! Messages of the library in another language, looked up by their English form.
//!
//! The library writes its messages in English. The files of words hold each message and its form in another language; a
//! variable part is put into that language as well if the files have it, and copied otherwise.

use chereme_analysis::detect::ALL_DETECTORS;

use super::InterfaceLanguage;
use super::count::counted_in_french;
use super::parts_words::{by_lines, is_quoted, placed_in_french, side_in_french};
use super::phrases::{BlankedPhrase, PhraseBook, PhrasePair, phrase_book};

/// Returns a message in `language`; nothing if the files of words lack it.
#[must_use]
pub(super) fn translate_message_text(text: &str, language: InterfaceLanguage) -> Option<String> {
    match phrase_book(language) {
        None => Some(text.to_owned()),
        Some(book) => translated_message(text, book),
    }
}

/// Returns the messages that stand beside the code of detectors.
pub(super) fn described_messages() -> impl Iterator<Item = PhrasePair> {
    let detectors = ALL_DETECTORS
        .iter()
        .flat_map(|detector| detector.detector_description().messages);
    detectors.map(|text| PhrasePair {
        english: BlankedPhrase::from_form(text.text_in_language(InterfaceLanguage::English)),
        other: BlankedPhrase::from_form(text.text_in_language(InterfaceLanguage::French)),
    })
}

fn translated_message(text: &str, book: &PhraseBook) -> Option<String> {
    let part = |blank: &str, part: &str| {
        if blank == "list" {
            let each = part.split("; ");
            let each = each.map(|item| translated_message(item, book).unwrap_or_else(|| item.to_owned()));
            return each.collect::<Vec<_>>().join(" ; ");
        }
        let side = side_in_french(blank, part).map(str::to_owned);
        let spoken = || translated_message(part, book).filter(|_| !is_quoted(part));
        side.or_else(spoken).unwrap_or_else(|| part.to_owned())
    };
    if text.starts_with('.')
        && let Some(endings) = translated_endings(text, book)
    {
        return Some(endings);
    }
    let mut pairs = book.messages.iter();
    let translated = pairs.find_map(|pair| pair.translate_phrase(text, &part));
    translated
        .or_else(|| counted_in_french(text))
        .or_else(|| placed_in_french(text, &|inner| part("", inner)))
        .or_else(|| by_lines(text, &|line| part("", line)))
}

/// Returns a list of endings with what such files hold, such as `.bvh, .glb (movement), .c3d (markers)`, in the other language.
fn translated_endings(text: &str, book: &PhraseBook) -> Option<String> {
    let groups = text.strip_suffix(')')?.split("), ").map(|group| {
        let (endings, holds) = group.split_once(" (")?;
        Some(format!("{endings} ({})", book.fixed_text("line", holds)?))
    });
    Some(groups.collect::<Option<Vec<_>>>()?.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_failures_have_french_messages() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let mut corpus = crate::Corpus::create_corpus(&path, "A").expect("made");
        let mut hear = crate::ignore_progress_step;
        let progress = &mut crate::ProgressReceiver::new(&mut hear);
        let failures = [
            corpus.undo_operation().map(drop),
            corpus.redo_operation().map(drop),
            corpus.recombine_recipe("NONE | swap", "X").map(drop),
            corpus.preview_recipe("| ").map(drop),
            corpus
                .suggest_new_signs(&"NONE".parse().expect("an address"), false)
                .map(drop),
            corpus.operation_detail(99, 1).map(drop),
            crate::Corpus::open_corpus(&folder.path().join("none"), "A").map(drop),
            crate::Corpus::create_corpus(&path, "A").map(drop),
            corpus
                .export_corpus(
                    &crate::ExportWhat::All,
                    &folder.path().join("x.xyz"),
                    &crate::ExportOptions::default(),
                    progress,
                )
                .map(drop),
        ];
        for failure in failures {
            let text = failure.expect_err("a failure").to_string();
            let french = translate_message_text(&text, InterfaceLanguage::French);
            assert!(french.is_some_and(|it| it != text), "{text}");
        }
        assert_eq!(translate_message_text("no such words", InterfaceLanguage::French), None);
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
            let said = translate_message_text(english, InterfaceLanguage::French);
            assert_eq!(said.as_deref(), Some(french));
        }
        let inside = "gloss=ESC finds nothing: no sign has such a gloss; there are: ESCARGOT";
        assert_eq!(
            translate_message_text(inside, InterfaceLanguage::French).as_deref(),
            Some("gloss=ESC ne trouve rien : aucun signe n’a une telle glose ; il y a : ESCARGOT")
        );
        assert_eq!(
            translate_message_text("x", InterfaceLanguage::English).as_deref(),
            Some("x")
        );
        assert_eq!(
            translate_message_text(
                "no sign is called \"BOLL\"; did you mean \"BOL\"?",
                InterfaceLanguage::French
            )
            .as_deref(),
            Some("aucun signe ne s’appelle \"BOLL\" ; vouliez-vous dire \"BOL\" ?")
        );
    }
}
