//! Cued speech through the public API: keys of alignments; a cuer that is stored, found and undone.

use std::fs;
use std::path::PathBuf;

use chereme_corpus::{Corpus, CueOptions, KeysOptions, SearchOptions, cue_keys_of_file, cue_phones_of_file};
use chereme_sign::cue::PhoneAlphabet;

fn glosses(corpus: &mut Corpus, query: &str) -> Vec<String> {
    let answer = corpus.search_tokens(query, &SearchOptions::default());
    let hits = answer.expect(query).hits;
    hits.into_iter().map(|hit| hit.gloss).collect()
}

/// Returns a TextGrid with one tier, in Praat's short form.
fn grid(name: &str, phones: &[(&str, f64, f64)]) -> String {
    let end = phones.last().map_or(0.0, |phone| phone.2);
    let mut text = format!(
        "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n{end}\n<exists>\n1\n\"IntervalTier\"\n\"{name}\"\n0\n{end}\n{}\n",
        phones.len()
    );
    for (label, from, to) in phones {
        text += &format!("{from}\n{to}\n\"{label}\"\n");
    }
    text
}

fn file(folder: &tempfile::TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).expect("written");
    path
}

#[test]
fn a_cued_sentence_is_found_by_its_keys_and_works_with_operators() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let options = CueOptions::default();
    let done = corpus.generate_cued_speech("le chat dort bien", &options, Some("CHAT_DORT"));
    let done = done.expect("the program has a body");
    assert!(done.report.warnings.is_empty(), "{:?}", done.report.warnings);
    assert!(!done.faces.is_empty(), "the mouth speaks");
    let keys: Vec<String> = done
        .notes
        .iter()
        .filter(|note| note.feature.as_deref() == Some("Keys"))
        .filter_map(|note| note.value.clone())
        .collect();
    let expected = [
        "cue:side-6",
        "cue:side-6",
        "cue:chin-1",
        "cue:side-3",
        "cue:side-4",
        "cue:cheek-8",
    ];
    assert_eq!(keys, expected);
    assert_eq!(glosses(&mut corpus, "cue.shape=1 cue.placement=chin"), ["cue:chin-1"]);
    assert_eq!(glosses(&mut corpus, "cue=16 meets cue=31"), ["cue:side-6"]);
    assert!(glosses(&mut corpus, "cue=31 meets cue=16").is_empty());
    assert_eq!(glosses(&mut corpus, "configuration=V placement=cheek"), ["CHAT_DORT"]);
    let late = glosses(&mut corpus, "cue.phase>10");
    assert!(
        late.contains(&"cue:side-6".to_owned()) && !late.contains(&"cue:side-3".to_owned()),
        "{late:?}"
    );
    let moved = corpus.preview_recipe("cue \"le chat\" | place right by up 3cm");
    assert!(moved.is_ok(), "{:?}", moved.err());
    let again = corpus.preview_recipe(&done.recipe).expect("the recipe is a recipe");
    assert_eq!(again.clip, done.clip, "the same recipe gives the same movement");
    corpus.undo_operation().expect("undone");
    assert!(glosses(&mut corpus, "cue=*").is_empty());
}

#[test]
fn a_text_without_keys_and_one_without_end_are_refused_in_few_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let options = CueOptions::default();
    for text in ["", "###", "! ? …"] {
        let error = corpus.generate_cued_speech(text, &options, Some("A")).expect_err(text);
        assert!(error.to_string().contains("nothing to cue"), "{error}");
    }
    for text in ["#".repeat(2000), "le chat dort ".repeat(100_000)] {
        let error = corpus.generate_cued_speech(&text, &options, None).expect_err("refused");
        assert!(error.to_string().len() < 200, "{}", error.to_string().len());
        assert!(error.error_remedy().is_some());
    }
}

#[test]
fn phones_of_an_alignment_are_the_clock_in_every_alphabet() {
    let folder = tempfile::tempdir().expect("a folder");
    let times = [(0.3, 0.36), (0.36, 0.53), (0.53, 0.65), (0.65, 0.8)];
    let of = |labels: [&'static str; 4]| -> Vec<(&str, f64, f64)> {
        labels
            .iter()
            .zip(times)
            .map(|(label, (from, to))| (*label, from, to))
            .collect()
    };
    let mut all = Vec::new();
    for (name, tier, labels) in [
        ("sampa.TextGrid", "PhonAlign", ["b", "O~", "Z", "u"]),
        ("ipa.TextGrid", "speaker - phones", ["b", "ɔ̃", "ʒ", "u"]),
        ("mfa.TextGrid", "phones", ["b", "ɔ̃", "ʒ", "u"]),
    ] {
        let path = file(&folder, name, &grid(tier, &of(labels)));
        let found = cue_keys_of_file(&path, None, &KeysOptions::default()).expect(name);
        assert_eq!(found.tier.as_deref(), Some(tier));
        let keys = found
            .keys
            .iter()
            .map(|key| (key.shape, key.placement.clone(), key.start_us, key.vowel_us, key.end_us));
        all.push(keys.collect::<Vec<_>>());
    }
    assert_eq!(all[0], all[1]);
    assert_eq!(all[1], all[2]);
    assert_eq!(
        all[0][0],
        (4, "mouth".to_owned(), Some(300_000), Some(360_000), Some(530_000))
    );
    let path = folder.path().join("sampa.TextGrid");
    let phones = cue_phones_of_file(&path, None, &KeysOptions::default()).expect("phones");
    let (phones, findings) = phones;
    assert_eq!(phones, "#=300 b=60 O~=170 Z=120 u=150");
    assert_eq!(findings, [""; 0]);
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let mut options = CueOptions::default();
    options.reading.phones = Some(PhoneAlphabet::Sampa);
    let done = corpus.generate_cued_speech(&phones, &options, None).expect("cued");
    assert!(done.duration_us > 800_000);
}

#[test]
fn phones_of_a_file_without_a_key_are_named_and_become_pauses() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = grid("phones", &[("b", 0.0, 0.06), ("Q9", 0.06, 0.12), ("O~", 0.12, 0.3)]);
    let path = file(&folder, "odd.TextGrid", &text);
    let read = cue_phones_of_file(&path, None, &KeysOptions::default());
    let (phones, findings) = read.expect("read");
    assert_eq!(phones, "b=60 #=60 O~=180");
    assert_eq!(findings.len(), 1, "{findings:?}");
    assert!(findings[0].contains("phone 2 \"Q9\""), "{findings:?}");
}

#[test]
fn a_long_text_is_named_in_short_and_a_longer_one_is_refused_by_its_length() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let text = "le chat dort,\n".repeat(30);
    let done = corpus.generate_cued_speech(&text, &CueOptions::default(), Some("LONG"));
    let done = done.expect("cued");
    let longest = done.notes.iter().map(|note| note.from.chars().count());
    assert!(longest.max() <= Some(163));
    assert!(!done.explanation.contains("dort,\n"), "{}", done.explanation);
    assert_eq!(done.recipe.matches("chat").count(), 30, "the recipe is whole");
    let longer = "le chat dort, ".repeat(20_000);
    let error = corpus.generate_cued_speech(&longer, &CueOptions::default(), None);
    let error = error.expect_err("an hour and more");
    assert_eq!(error.to_string(), "the text has 280000 bytes");
    assert!(
        error
            .error_remedy()
            .is_some_and(|it| it.remedy_text().contains("256 KiB"))
    );
}

#[test]
fn invalid_alignments_are_refused_or_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let read = |text: &str, tier: Option<&str>| {
        let path = file(&folder, "x.TextGrid", text);
        cue_keys_of_file(&path, tier, &KeysOptions::default())
    };
    assert!(read("", None).is_err());
    assert!(read("not a grid", None).is_err());
    // A tier of words without one of phones is pronounced by the rules.
    let words = grid("words", &[("le", 0.0, 1.0)]);
    let pronounced = read(&words, None).expect("words");
    assert_eq!(pronounced.tier.as_deref(), Some("words"));
    let keys: Vec<_> = pronounced
        .keys
        .iter()
        .map(|key| (key.shape, key.placement.clone()))
        .collect();
    assert_eq!(keys.len(), 1);
    assert_eq!(format!("{}-{}", keys[0].0, keys[0].1), "6-side");
    let odd = grid("phones", &[("b", 0.0, 1.0), ("??", 1.0, 2.0), ("", 2.0, 3.0)]);
    let found = read(&odd, Some("phones")).expect("read");
    assert_eq!(found.keys.len(), 1);
    assert!(
        found.findings.iter().any(|finding| finding.contains("??")),
        "{:?}",
        found.findings
    );
    assert!(cue_keys_of_file(&folder.path().join("none"), None, &KeysOptions::default()).is_err());
}
