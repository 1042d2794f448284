//! Movement generated from notation: in a corpus without movement, on the built-in body, and found by search.

use std::fs;

use chereme_corpus::{Corpus, ImportOptions, NotationStaging, ProgressReceiver, SearchOptions, ignore_progress_step};

const CHIN: &str = r#"<sigml><hamgestural_sign gloss="MERCI"><sign_manual>
  <handconfig handshape="flat"/><handconfig extfidir="u"/><handconfig palmor="u"/>
  <location_bodyarm location="chin" contact="touch"/>
  <directedmotion direction="o"/>
</sign_manual></hamgestural_sign></sigml>"#;

fn glosses(corpus: &mut Corpus, query: &str) -> Vec<String> {
    let answer = corpus.search_tokens(query, &SearchOptions::default());
    let hits = answer.expect(query).hits;
    hits.into_iter().map(|hit| hit.gloss).collect()
}

#[test]
fn a_notated_sign_is_animated_found_by_its_components_and_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let file = folder.path().join("merci.sigml");
    fs::write(&file, CHIN).expect("written");
    let preview = corpus.animate_notation(&[&file.display().to_string()], &NotationStaging::default(), None);
    assert!(preview.expect("a file that no corpus holds").token.is_none());
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(
            std::slice::from_ref(&file),
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("taken in");

    let done = corpus.animate_notation(&["MERCI"], &NotationStaging::default(), Some("THANKS"));
    let done = done.expect("the corpus has it, and the program a body");
    assert!(done.duration_us > 500_000, "{}", done.duration_us);
    let found = glosses(&mut corpus, "configuration=flat placement=chin origin=made");
    assert_eq!(found, ["THANKS"]);

    let twice = corpus.animate_notation(&["MERCI", "MERCI"], &NotationStaging::default(), None);
    assert!(twice.expect("one after the other").duration_us > done.duration_us);
    let near = corpus.preview_recipe("THANKS | reverse | place right near MERCI");
    assert!(near.is_ok(), "{:?}", near.err());
    corpus.undo_operation().expect("undone");
    assert!(glosses(&mut corpus, "origin=made").is_empty());
}

#[test]
fn unreadable_notation_is_reported_and_nothing_is_stored() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    for (notation, signer, said) in [
        ("NONE", None, "NONE"),
        ("hamflathand hamparbegin", None, "symbol"),
        ("hamflathand hamextfingeru", Some("signer:nobody"), "nobody"),
        ("hamflathand hamextfingeru", Some("nobody"), "nobody"),
    ] {
        let staging = NotationStaging { signer, language: None };
        let error = corpus
            .animate_notation(&[notation], &staging, Some("X"))
            .map(|done| done.recipe)
            .expect_err(notation);
        assert!(error.to_string().contains(said), "{notation}: {error}");
    }
    assert!(glosses(&mut corpus, "gloss=X").is_empty());
}
