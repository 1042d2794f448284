//! The examples that operators give of themselves: they work on the starter corpus, and their reports are in French, too.

use chereme_corpus::recipe::Step;
use chereme_corpus::words::{InterfaceLanguage, localized_message};
use chereme_corpus::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};

/// Returns a sentence in French; itself if it has no words.
fn in_french(text: &str) -> Option<String> {
    let has_words = text.chars().filter(|c| c.is_alphabetic()).count() > 3;
    if !has_words {
        return Some(text.to_owned());
    }
    localized_message(text, InterfaceLanguage::French)
}

#[test]
fn the_reports_of_examples_are_french_if_french_is_requested() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = unpack_starter(&folder.path().join("files")).expect("unpacked");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    let (mut done, mut refused, mut english) = (0, Vec::new(), Vec::new());
    for (example, _) in Step::DESCRIPTIONS.iter().flat_map(|it| it.examples) {
        let made = match corpus.preview_recipe(&format!("BOL | {example}")) {
            Ok(made) => made,
            Err(error) => {
                refused.push(format!("{example}: {error}"));
                continue;
            }
        };
        done += 1;
        let steps = made.report.steps.iter();
        let sentences = steps.flat_map(|it| &it.did).chain(&made.report.warnings);
        let missing = sentences.filter(|text| in_french(text).is_none());
        english.extend(missing.map(|text| format!("{example}: {text}")));
    }
    assert!(english.is_empty(), "{}", english.join("\n"));
    assert!(done >= 18, "{done}; refused:\n{}", refused.join("\n"));
}
