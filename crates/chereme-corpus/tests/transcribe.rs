//! A token's movement in HamNoSys: transcribed, stored as its notation, and undone.

use std::collections::BTreeSet;
use std::ops::ControlFlow::Break;

use chereme_corpus::{
    Corpus, CorpusAddress, CorpusError, ImportOptions, NotationStaging, PictureOptions, ProgressReceiver, ProgressStep,
    SignTranscription, ignore_progress_step, starter_files,
};
use chereme_sign::hamnosys::{BodyLocation, HamnosysSign, HandPlace, NonmanualActs, from_names, parse_hamnosys};

#[test]
fn a_transcription_is_stored_and_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut paths = Vec::new();
    for (name, bytes) in starter_files() {
        if name.file_stem().is_some_and(|stem| stem == "bol") {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).expect("written");
            paths.push(path);
        }
    }
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let (options, mut unheard) = (ImportOptions::default(), ignore_progress_step);
    let mut progress = ProgressReceiver::new(&mut unheard);
    corpus.import_paths(&paths, &options, &mut progress).expect("taken in");

    let sign: CorpusAddress = "BOL".parse().expect("an address");
    let transcribed = corpus.transcribe_movement(&sign, &mut progress).expect("told");
    assert!(!transcribed.features.is_empty() && transcribed.start_us < transcribed.end_us);
    let text: String = transcribed.stages.iter().map(|it| it.hamnosys.as_str()).collect();
    if transcribed.stages.iter().all(|stage| stage.hand.is_none()) {
        assert_eq!(transcribed.hamnosys, text, "stages in order are the whole");
    }
    for stage in &transcribed.stages {
        assert!(transcribed.start_us <= stage.start_us && stage.start_us < stage.end_us);
    }
    for feature in &transcribed.features {
        let value = &feature.value;
        assert_eq!(value.symbols.len(), value.hamnosys.chars().count());
        assert!(feature.start_us <= feature.at_us && feature.at_us <= feature.end_us);
    }
    let read = parse_hamnosys(&transcribed.hamnosys).expect("HamNoSys that reads");
    assert_eq!(read.sign, transcribed.sign, "{:?}", transcribed.findings);

    assert!(corpus.notation_at(&sign).is_err());
    let picture = folder.path().join("bol.svg");
    let drawn = corpus.draw_movement_file(&sign, &picture, &PictureOptions::default(), &mut progress);
    let drawn = drawn.expect("drawn");
    assert!(drawn.transcribed && drawn.frames == transcribed.symbols.len());
    corpus.store_transcription(&sign, false, &mut progress).expect("kept");
    let kept = corpus.notation_at(&sign).expect("a notation");
    assert_eq!(kept.text.as_ref(), Some(&transcribed.hamnosys));
    assert_eq!(kept.document.sign, transcribed.sign);
    corpus
        .store_transcription(&sign, false, &mut progress)
        .expect("the same again");
    assert_eq!(corpus.operation_log(1).expect("a log")[0].name, "transcribe");
    corpus.undo_operation().expect("taken back");
    assert!(corpus.notation_at(&sign).is_err());
}

/// Signs whose hands miss their place: they are pushed out of the trunk, or refer to a part that faces away from it.
const LED_AWAY: [&str; 2] = [
    "hamfinger2 hamextfingerul hampalmd hamneck hamtouch",
    "hamflathand hamthumboutmod hamextfingerul hampalmul hamchest hamlrat hambetween hamshoulders hamtouch",
];

#[test]
fn animated_notation_is_transcribed_with_its_written_locations() {
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    check_transcribed_locations(corpus);
}

#[test]
fn locations_are_transcribed_on_a_body_with_an_impossible_rest_pose() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bol.bvh");
    let mut files = starter_files();
    let bol = files.find(|(name, _)| name.ends_with("bol.bvh"));
    let (_, bytes) = bol.expect("a recording");
    let text = std::str::from_utf8(bytes).expect("text");
    std::fs::write(&path, arm_turned_round(text)).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let (options, mut unheard) = (ImportOptions::default(), ignore_progress_step);
    let mut progress = ProgressReceiver::new(&mut unheard);
    let done = corpus.import_paths(&[path], &options, &mut progress);
    done.expect("taken in");
    check_transcribed_locations(corpus);
}

/// Generates a sign, stores it as S and its number, and returns its notation and its transcription.
fn there_and_back(corpus: &mut Corpus, n: usize, names: &str) -> (HamnosysSign, SignTranscription) {
    let text = from_names(names.split(' ')).expect("names of symbols");
    let written = parse_hamnosys(&text).expect("HamNoSys").sign;
    let gloss = format!("S{n}");
    // A body that sways shifts the hand by millimetres, as much as the distance between the neck and the underside of
    // the chin.
    let staging = NotationStaging {
        language: Some("quiet"),
        ..NotationStaging::default()
    };
    let done = corpus.animate_notation(&[names], &staging, Some(&gloss));
    done.expect("made");
    let address = gloss.parse().expect("an address");
    let transcribed = corpus.transcribe_movement(&address, &mut ProgressReceiver::new(&mut { ignore_progress_step }));
    (written, transcribed.expect("told"))
}

/// Generates each of those signs on the body that the corpus chooses, and checks its transcription.
fn check_transcribed_locations(mut corpus: Corpus) {
    for (n, names) in LED_AWAY.into_iter().enumerate() {
        let (written, transcribed) = there_and_back(&mut corpus, n, names);
        let address = format!("S{n}").parse().expect("an address");
        let stopped = corpus.transcribe_movement(
            &address,
            &mut ProgressReceiver::new(&mut |_: ProgressStep<'_>| Break(())),
        );
        assert!(matches!(stopped, Err(CorpusError::Stopped)), "{names}");
        let sites = |sign: &HamnosysSign| match &sign.parts[0].posture.place {
            Some(HandPlace::Body(place)) => (place.site, place.second, place.contact),
            other => panic!("{names}: {other:?}"),
        };
        assert_eq!(sites(&transcribed.sign), sites(&written), "{names}");
        // The transitions from and to rest are known, and left out.
        let nothing = transcribed.sign.parts[0].actions.is_empty();
        assert!(
            nothing && transcribed.start_us > 300_000,
            "{names}: {:?}",
            transcribed.symbols
        );
    }
}

/// Constellations of hands that the animator keeps clear of each other: the parts that are close lie apart by the flesh
/// of other parts.
const CLOSE: [&str; 2] = [
    "hamparbegin hamflathand hamextfingerl hampalml hamplus hamflathand hamextfingeror hampalmr hamparend \
     hamparbegin hampinkyside hamplus hamthumbside hamparend hamclose hamshoulders hambetween hamchest hammoved",
    "hamparbegin hamfinger2 hamextfingerl hampalmd hamplus hamfinger2 hamextfingeror hampalmd hamparend \
     hamparbegin hamfingermidjoint hamindexfinger hampalm hamplus hamfingermidjoint hamindexfinger hamhandback \
     hamparend hamtouch hamchest hammoveu",
];

#[test]
fn constellations_of_hands_that_are_kept_clear_are_transcribed_as_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    for (n, names) in CLOSE.into_iter().enumerate() {
        let (written, transcribed) = there_and_back(&mut corpus, n, names);
        let hands = |sign: &HamnosysSign| match &sign.parts[0].posture.place {
            Some(HandPlace::Hands(hands)) => {
                let at = hands.at.iter().flat_map(|at| [at.site, at.second]);
                let mut at: Vec<_> = at.flatten().map(|site| site.at).collect();
                at.sort();
                (hands.dominant.clone(), hands.other.clone(), hands.contact, at)
            }
            other => panic!("{names}: {other:?}"),
        };
        assert_eq!(hands(&transcribed.sign), hands(&written), "{names}");
    }
}

/// Signs whose places alone would be read differently: one is written without a place, and in one a hand stays still.
const BEGINNINGS: [&str; 2] = [
    "hamflathand hamextfingero hampalmd hammovel",
    "hamsymmlr hamfinger2 hamthumbacrossmod hamextfingeruo hampalml hamchest hamparbegin hammovel hamsmallmod hamplus \
     hamnomotion hamparend",
];

#[test]
fn initial_postures_are_transcribed_as_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    for (n, names) in BEGINNINGS.into_iter().enumerate() {
        let (written, transcribed) = there_and_back(&mut corpus, n, names);
        let [transcribed, written] = [transcribed.sign, written].map(|mut sign| sign.parts.remove(0));
        assert_eq!(transcribed.hands, written.hands, "{names}");
        assert_eq!(transcribed.posture.place, written.posture.place, "{names}");
        assert_eq!(transcribed.actions, written.actions, "{names}");
    }
}

/// Non-manual tiers in SiGML, with the names of the acts that are read and of those that are stored with them.
const LEANING: [(&str, &[&str], &[&str]); 4] = [
    (
        r#"<body_tier><body_movement movement="TF"/></body_tier>
<shoulder_tier><shoulder_movement movement="UR"/></shoulder_tier>
<head_tier><head_movement movement="SR"/></head_tier>"#,
        &["shoulders.UR", "body.TF", "head.SR"],
        &[],
    ),
    (
        r#"<body_tier><body_movement movement="ST"/></body_tier><head_tier><head_movement movement="NB"/></head_tier>"#,
        &["body.ST", "head.NB"],
        &[],
    ),
    (
        r#"<body_tier><body_movement movement="RL"/></body_tier><facialexpr_tier><eye_brows movement="RB"/></facialexpr_tier>"#,
        &["body.RL"],
        &["brows.RB"],
    ),
    ("", &[], &[]),
];

#[test]
fn acts_of_trunk_head_and_shoulders_are_read_and_stored() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let file = folder.path().join("s.sigml");
    for (n, (tiers, acts, kept)) in LEANING.into_iter().enumerate() {
        let sigml = format!(
            r#"<sigml><hamgestural_sign gloss="S"><sign_nonmanual>{tiers}</sign_nonmanual><sign_manual>
<handconfig handshape="finger2"/><handconfig extfidir="ul" palmor="l"/>
<location_bodyarm location="chin" contact="close"/><directedmotion direction="o"/>
</sign_manual></hamgestural_sign></sigml>"#
        );
        std::fs::write(&file, sigml).expect("written");
        let gloss = format!("S{n}");
        let path = file.to_str().expect("a path");
        let made = corpus.animate_notation(&[path], &NotationStaging::default(), Some(&gloss));
        made.expect("made");
        let address = gloss.parse().expect("an address");
        let mut unheard = ignore_progress_step;
        let mut progress = ProgressReceiver::new(&mut unheard);
        let transcribed = corpus.store_transcription(&address, true, &mut progress);
        let transcribed = transcribed.expect("stored");
        let names =
            |sign: &NonmanualActs| -> Vec<String> { sign.acts_by_tier().map(|it| it.1.act_curve_name()).collect() };
        assert_eq!(names(&transcribed.nonmanual), acts, "{tiers}");
        let Some(HandPlace::Body(place)) = &transcribed.sign.parts[0].posture.place else {
            panic!("{tiers}: {:?}", transcribed.symbols);
        };
        assert_eq!(place.site.map(|it| it.at), Some(BodyLocation::Chin), "{tiers}");
        let stored = corpus.notation_at(&address).expect("a notation").document;
        assert_eq!(names(&stored.nonmanual), [acts, kept].concat(), "{tiers}");
    }
}

/// Rotates the axes of the left arm's joints by half a turn about up, so that in the rest pose both arms stick out to
/// the right; the movement stays the same.
fn arm_turned_round(bvh: &str) -> String {
    let turned = |text: &str, by: f64| text.parse::<f64>().expect("a number") * by;
    let (mut depth, mut arm, mut lines) = (0, None, Vec::new());
    // The factor and the addend of each channel.
    let mut channels = Vec::new();
    for line in bvh.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let below = arm.is_some_and(|arm| depth > arm + 1);
        match words.as_slice() {
            ["JOINT", "LeftArm"] => arm = Some(depth),
            ["{"] => depth += 1,
            ["}"] => {
                depth -= 1;
                arm = arm.filter(|arm| depth > *arm);
            }
            ["OFFSET", x, y, z] if below => {
                let [x, z] = [x, z].map(|text| turned(text, -1.0));
                lines.push(format!("OFFSET {x} {y} {z}"));
                continue;
            }
            ["CHANNELS", _, all @ ..] => channels.extend(all.iter().map(|name| match *name {
                "Xrotation" | "Zrotation" if below => (-1.0, 0.0),
                "Yrotation" if arm.is_some() && !below => (1.0, 180.0),
                _ => (1.0, 0.0),
            })),
            row if row.len() == channels.len() => {
                let row = row.iter().zip(&channels);
                let row = row.map(|(text, (by, more))| (turned(text, *by) + more).to_string());
                lines.push(row.collect::<Vec<_>>().join(" "));
                continue;
            }
            _ => {}
        }
        lines.push(line.to_owned());
    }
    lines.join("\n")
}

#[test]
fn a_component_that_is_not_coded_is_proposed_from_movement_and_a_stop_leaves_the_corpus() {
    use chereme_corpus::SearchOptions;
    use chereme_sign::SignComponent;
    let folder = tempfile::tempdir().expect("a folder");
    let mut unheard = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut unheard);
    let mut corpus = uncoded(folder.path(), "bol", (0.0, 1.0), None);
    let count = |corpus: &mut Corpus, query: &str| {
        let options = SearchOptions::default();
        corpus.search_tokens(query, &options).expect("found").total
    };
    let (coded, proposals) = ("configuration=*", "configuration=* proposed:yes");
    assert_eq!((count(&mut corpus, coded), count(&mut corpus, proposals)), (0, 0));

    let before = corpus.corpus_generation().expect("a moment");
    let mut stop = |_: chereme_corpus::ProgressStep<'_>| Break(());
    let stopped = corpus.propose_coding(SignComponent::Configuration, &mut ProgressReceiver::new(&mut stop));
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
    assert_eq!(corpus.corpus_generation().expect("a moment"), before);

    let proposed = corpus
        .propose_coding(SignComponent::Configuration, &mut progress)
        .expect("proposed");
    assert_eq!((proposed.tokens, proposed.unread), (1, 0));
    assert!(proposed.annotations >= 1);
    assert_eq!(proposed.recordings, ["bol"]);
    // A proposal is no coding: only who asks for it finds it.
    assert_eq!((count(&mut corpus, coded), count(&mut corpus, proposals)), (0, 1));
    // A field with a value is not read again.
    let again = corpus
        .propose_coding(SignComponent::Configuration, &mut progress)
        .expect("proposed");
    assert_eq!(again.tokens, 0);
    // The tiers and their values are one operation.
    let undone = corpus.undo_operation().expect("undone");
    assert_eq!(undone.name, "propose");
    assert_eq!(count(&mut corpus, proposals), 0);
    let tiers = corpus.list_rows(chereme_corpus::ListKind::Tiers, &Default::default());
    let tiers = tiers.expect("tiers").total;
    assert_eq!(tiers, 1, "the proposed tiers go with their values");
    let refused = corpus.propose_coding(SignComponent::NonManual, &mut progress);
    assert!(refused.expect_err("refused").error_remedy().is_some());
}

/// Returns a corpus with a starter recording and a gloss on it, without codings.
fn uncoded(folder: &std::path::Path, name: &str, (start, end): (f64, f64), handedness: Option<&str>) -> Corpus {
    let mut paths = Vec::new();
    for (file, bytes) in starter_files() {
        if file.to_string_lossy().ends_with(&format!("{name}.bvh")) {
            let path = folder.join(format!("{name}.bvh"));
            std::fs::write(&path, bytes).expect("written");
            paths.push(path);
        }
    }
    let file = format!("{}.chereme", handedness.unwrap_or("c"));
    let mut corpus = Corpus::create_corpus(&folder.join(file), "A").expect("made");
    let options = ImportOptions {
        signer: handedness.map(|_| "Ada".to_owned()),
        handedness: handedness.map(str::to_owned),
        ..ImportOptions::default()
    };
    let mut unheard = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut unheard);
    corpus.import_paths(&paths, &options, &mut progress).expect("taken in");
    let gloss = chereme_corpus::NewTier::new(
        chereme_corpus::RowName::Text(name.into()),
        "gloss",
        chereme_corpus::TierRole::Gloss,
    );
    let tier = corpus.add_tier(&gloss).expect("a tier");
    let seconds = |at: f64| {
        Some(chereme_corpus::TableMoment::Time(
            chereme_motion::RecordingInstant::from_micros((at * 1e6) as i64),
        ))
    };
    let add = chereme_corpus::AnnotationAction::Add {
        tier: chereme_corpus::TierRequestName::Number(tier.id),
        start: seconds(start),
        end: seconds(end),
        parent: None,
        order: None,
        value: name.to_uppercase(),
        confidence: None,
    };
    corpus
        .annotate_corpus(&[add.into()], &Default::default(), &mut progress)
        .expect("annotated");
    corpus
}

#[test]
fn directions_and_sides_of_proposals_do_not_depend_on_the_signers_handedness() {
    use chereme_corpus::{ProposeOptions, ProposeScope, SearchOptions};
    use chereme_sign::SignComponent;
    let folder = tempfile::tempdir().expect("a folder");
    let mut unheard = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut unheard);
    let mut read = |handedness: Option<&str>| {
        let mut corpus = uncoded(folder.path(), "chat", (1.05, 2.97), handedness);
        let options = ProposeOptions {
            components: vec![SignComponent::Placement, SignComponent::Orientation],
            scope: ProposeScope::All,
        };
        let proposed = corpus.propose_components(&options, &mut progress).expect("proposed");
        assert_eq!((proposed.tokens, proposed.unread), (1, 0));
        let found = corpus.search_tokens("CHAT proposed:yes", &SearchOptions::default());
        let hit = found.expect("found").hits.remove(0);
        assert!(hit.components.is_empty(), "nobody accepted them: {hit:?}");
        let opinions = hit.opinions.into_iter();
        let values: BTreeSet<String> = opinions.map(|one| format!("{}={}", one.field, one.value)).collect();
        values
    };
    let right_handed = read(Some("right"));
    assert_eq!(read(Some("left")), right_handed);
    assert_eq!(read(None), right_handed);
    for side in ["right", "left"] {
        let placement = format!("{side}.placement={side}");
        assert!(right_handed.contains(&placement), "{right_handed:?}");
    }
}
