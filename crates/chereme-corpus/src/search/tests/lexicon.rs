//! Counts of a real lexicon, made independently of this program.

use crate::{Corpus, ImportOptions, ProgressReceiver, SearchOptions, ignore_progress_step};

/// Queries with the number of tokens that they find in the table of the lexicon.
const COUNTS: &[(&str, usize)] = &[
    ("", 2145),
    ("configuration=B", 446),
    ("dominant.configuration=B", 358),
    ("weak.configuration=B", 291),
    ("placement=head", 440),
    ("placement==head", 84),
    ("placement==chin", 96),
    ("not placement==chin", 2049),
    ("placement==\"neutral space\"", 1201),
    ("placement=\"neutral space\"", 1213),
    ("placement==\"weak hand\"", 214),
    ("placement=\"weak hand\"", 224),
    ("placement=*", 2145),
    ("weak.configuration=*", 990),
    ("weak.configuration=unset", 1155),
    ("dominant.configuration==B*", 433),
    ("dominant.configuration=B*", 612),
    ("gloss=BO*", 25),
    ("gloss=/^BO.*/", 25),
    ("gloss~/^BO/", 25),
    ("gloss:BO*", 26),
    ("gloss=*-B", 469),
    ("gloss=/-B$/", 469),
    ("movement.repeated=*", 614),
    ("movement.shape=*", 818),
    ("movement.shape=arc*", 169),
    ("placement=* > chest", 3),
    ("placement==head > *", 1),
    ("dominant.configuration=* > S", 9),
    ("hand=both", 990),
    ("@chin", 96),
    ("not @chin", 2049),
    ("@chin dominant.configuration=B", 14),
];

#[test]
fn counts_in_the_shared_lexicon_equal_independent_ones() {
    let Ok(shared) = std::env::var("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set: the lexicon was not counted");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let file = std::path::Path::new(&shared).join("phonology/ngt_lexicon.tsv");
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(
            &[file],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("imported");
    let chin = crate::KeptSearch {
        name: "chin".into(),
        query: "placement==chin".into(),
    };
    corpus.keep_searches(&[chin]).expect("kept");
    let mut wrong = Vec::new();
    for (query, wanted) in COUNTS {
        let options = SearchOptions {
            limit: Some(0),
            facets: false,
            ..SearchOptions::default()
        };
        match corpus.search_tokens(query, &options) {
            Ok(answer) if answer.total == *wanted => {}
            Ok(answer) => wrong.push(format!("{query}: {}, not {wanted}", answer.total)),
            Err(error) => wrong.push(format!("{query}: {error}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // No sign is offered as a minimal pair if a second column of the table differs, too.
    let found = corpus
        .suggest_new_signs(&"JAM-A".parse().expect("an address"), false)
        .expect("a sign");
    assert!(found.partners.iter().all(|it| it.one_sided == 0));
    assert!(found.partners.iter().all(|it| it.gloss != "UUR-D"));
    assert!(found.possible.iter().any(|it| it.gloss == "UUR-D" && it.one_sided > 0));
}
