//! Tests of maps of small lexicons.

use super::*;
use crate::progress::ProgressStep;
use crate::{ImportOptions, ignore_progress_step};

/// Returns a corpus with two families of four signs each: fists at the chin, flat hands at the chest.
fn lexicon(folder: &Path) -> Corpus {
    let file = folder.join("t.csv");
    let mut table = "gloss,handshape,location,movement\n".to_owned();
    for (family, shape, place) in [("CHIN", "S", "chin"), ("CHEST", "flat", "chest")] {
        for (number, movement) in ["arc", "straight", "circle", "hold"].iter().enumerate() {
            let _ = writeln!(table, "{family}-{number},{shape},{place},{movement}");
        }
    }
    table.push_str("BARE,,,\n");
    std::fs::write(&file, table).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let options = ImportOptions::default();
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus.import_paths(&[file], &options, progress).expect("imported");
    corpus
}

fn map(corpus: &mut Corpus, options: &MapOptions) -> CorpusResult<SignMap> {
    let mut hear = ignore_progress_step;
    corpus.arrange_sign_map(options, &mut ProgressReceiver::new(&mut hear))
}

#[test]
fn signs_that_are_alike_lie_near_each_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = lexicon(folder.path());
    let options = MapOptions {
        components: vec![SignComponent::Configuration, SignComponent::Placement],
        query: None,
        ..MapOptions::default()
    };
    let found = map(&mut corpus, &options).expect("a map");
    assert_eq!((found.signs.len(), found.left_out), (8, 1));
    assert_eq!(found, map(&mut corpus, &options).expect("a map"));
    let family = |it: &MapPoint| it.gloss.split('-').next().map(str::to_owned);
    let by_id: BTreeMap<i64, &MapPoint> = found.signs.iter().map(|it| (it.token, it)).collect();
    for sign in &found.signs {
        for near in &sign.near[..3] {
            assert_eq!(family(by_id[near]), family(sign), "{sign:?}");
        }
    }
    let drawn = folder.path().join("map.svg");
    found.draw_sign_map(&drawn, false).expect("drawn");
    let text = std::fs::read_to_string(&drawn).expect("read");
    assert_eq!(text.matches("<circle").count(), 8);
    assert!(found.draw_sign_map(&drawn, false).is_err(), "nothing is written over");
}

#[test]
fn a_map_of_a_query_holds_its_tokens_and_one_sign_is_no_map() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = lexicon(folder.path());
    let of = |query: &str| MapOptions {
        components: vec![],
        query: Some(query.to_owned()),
        ..MapOptions::default()
    };
    let found = map(&mut corpus, &of("placement=chin")).expect("a map");
    assert_eq!(found.signs.len(), 4);
    let error = map(&mut corpus, &of("gloss=CHIN-1")).expect_err("one sign");
    assert!(error.to_string().starts_with("1 of 1 tokens"), "{error}");
    assert!(error.error_remedy().is_some());
}

#[test]
fn a_map_that_is_stopped_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = lexicon(folder.path());
    let mut hear = |_: ProgressStep<'_>| std::ops::ControlFlow::Break(());
    let stopped = corpus.arrange_sign_map(&MapOptions::default(), &mut ProgressReceiver::new(&mut hear));
    assert!(matches!(stopped, Err(CorpusError::Stopped)), "{stopped:?}");
}
