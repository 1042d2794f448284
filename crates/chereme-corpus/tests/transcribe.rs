//! A token's movement in HamNoSys: told, kept as its notation, and taken back.

use chereme_corpus::{
    Address, Corpus, ImportOptions, PictureOptions, Progress, Staging, starter_files, unheard,
};
use chereme_sign::hamnosys::{Place, Sign, from_names, parse};

#[test]
fn what_is_transcribed_can_be_kept_and_taken_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut paths = Vec::new();
    for (name, bytes) in starter_files() {
        if name.file_stem().is_some_and(|stem| stem == "bol") {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).expect("written");
            paths.push(path);
        }
    }
    let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("made");
    let (options, mut unheard) = (ImportOptions::default(), unheard);
    let mut progress = Progress::new(&mut unheard);
    corpus
        .import(&paths, &options, &mut progress)
        .expect("taken in");

    let sign: Address = "BOL".parse().expect("an address");
    let told = corpus.transcribe(&sign).expect("told");
    assert!(!told.features.is_empty() && told.start_us < told.end_us);
    let text: String = told.stages.iter().map(|it| it.hamnosys.as_str()).collect();
    if told.stages.iter().all(|stage| stage.hand.is_none()) {
        assert_eq!(told.hamnosys, text, "stages in order are the whole");
    }
    for stage in &told.stages {
        assert!(told.start_us <= stage.start_us && stage.start_us < stage.end_us);
    }
    for feature in &told.features {
        let value = &feature.value;
        assert_eq!(value.symbols.len(), value.hamnosys.chars().count());
        assert!(feature.start_us <= feature.at_us && feature.at_us <= feature.end_us);
    }
    let read = parse(&told.hamnosys).expect("HamNoSys that reads");
    assert_eq!(read.sign, told.sign, "{:?}", told.findings);

    assert!(corpus.notation(&sign).is_err());
    let picture = folder.path().join("bol.svg");
    let drawn = corpus.draw(&sign, &picture, &PictureOptions::default(), &mut progress);
    let drawn = drawn.expect("drawn");
    assert!(drawn.transcribed && drawn.frames == told.symbols.len());
    corpus.store_transcription(&sign, false).expect("kept");
    let kept = corpus.notation(&sign).expect("a notation");
    assert_eq!(kept.text.as_ref(), Some(&told.hamnosys));
    assert_eq!(kept.document.sign, told.sign);
    corpus
        .store_transcription(&sign, false)
        .expect("the same again");
    assert_eq!(corpus.log(1).expect("a log")[0].name, "transcribe");
    corpus.undo().expect("taken back");
    assert!(corpus.notation(&sign).is_err());
}

/// Signs whose hands are not where they are meant to be: led out of the trunk, or by a part that looks away from it.
const LED_AWAY: [&str; 3] = [
    "hamfist hamextfingerul hampalmr hamneck hamtouch",
    "hamfinger2 hamextfingerul hampalmd hamneck hamtouch",
    "hamflathand hamthumboutmod hamextfingerul hampalmul hamchest hamlrat hambetween hamshoulders hamtouch",
];

#[test]
fn what_was_made_of_notation_is_told_to_be_where_it_was_written_to_be() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create(&folder.path().join("c.chereme"), "A").expect("made");
    for (n, names) in LED_AWAY.into_iter().enumerate() {
        let text = from_names(names.split(' ')).expect("names of symbols");
        let written = parse(&text).expect("HamNoSys").sign;
        let gloss = format!("S{n}");
        let done = corpus.animate(&[names], &Staging::default(), Some(&gloss));
        done.expect("made");
        let told = corpus.transcribe(&gloss.parse().expect("an address"));
        let told = told.expect("told");
        let sites = |sign: &Sign| match &sign.parts[0].posture.place {
            Some(Place::Body(place)) => (place.site, place.second, place.contact),
            other => panic!("{names}: {other:?}"),
        };
        assert_eq!(sites(&told.sign), sites(&written), "{names}");
        // The ways from and to rest are known, and left out.
        let nothing = told.sign.parts[0].actions.is_empty();
        assert!(
            nothing && told.start_us > 300_000,
            "{names}: {:?}",
            told.symbols
        );
    }
}
