//! Detectors run by name: their proposals are annotations of a detector, replaced by the next run, and undone as one.

use std::path::Path;

use chereme_corpus::words::{InterfaceLanguage, localized_message};
use chereme_corpus::{
    ALL_DETECTORS, AnnotateOptions, AnnotationAction, AnnotationOrigin, Corpus, CorpusError, DetectOptions,
    DetectionReport, DetectionUse, ImportOptions, ImportReport, ListFilter, ListKind, NewTier, ProgressReceiver,
    ProposalChoice, ProposeOptions, ProposeScope, RowName, TableMoment, TierRequestName, TierRole,
    ignore_progress_step, starter_files,
};
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::SignComponent;

/// Returns a corpus with one recording without annotations.
fn bowl(folder: &Path) -> Corpus {
    recorded(folder, &bowl_file())
}

/// Returns a movement file of the starter corpus.
fn bowl_file() -> String {
    let mut files = starter_files();
    let (_, bytes) = files
        .find(|(name, _)| *name == Path::new("bol.bvh"))
        .expect("in the starter corpus");
    String::from_utf8_lossy(bytes).into_owned()
}

/// Returns a corpus with one recording from a movement file, without annotations.
fn recorded(folder: &Path, bvh: &str) -> Corpus {
    recorded_with(folder, bvh, &ImportOptions::default()).0
}

/// Returns a corpus with one recording that was imported with these options, and the import's report.
fn recorded_with(folder: &Path, bvh: &str, options: &ImportOptions) -> (Corpus, ImportReport) {
    let path = folder.join("bol.bvh");
    std::fs::write(&path, bvh).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(&[path], options, &mut ProgressReceiver::new(&mut hear));
    (corpus, report.expect("imported"))
}

/// Returns a movement file whose frames are all the first one.
fn still_file() -> String {
    let bvh = bowl_file();
    let mut lines: Vec<&str> = bvh.lines().collect();
    let time = lines.iter().position(|line| line.starts_with("Frame Time"));
    let first = time.expect("a frame time") + 1;
    let still = lines[first];
    lines[first..].fill(still);
    lines.join("\n")
}

fn detect(corpus: &mut Corpus, detector: &str, scope: ProposeScope) -> chereme_corpus::CorpusResult<DetectionReport> {
    detect_with(corpus, &DetectOptions::propose_with(detector, scope))
}

fn detect_with(corpus: &mut Corpus, options: &DetectOptions) -> chereme_corpus::CorpusResult<DetectionReport> {
    let mut hear = ignore_progress_step;
    corpus.run_detection(options, &mut ProgressReceiver::new(&mut hear))
}

/// Returns the value of a column for each row of a listing.
fn column(corpus: &Corpus, kind: ListKind, name: &str) -> Vec<String> {
    let listing = corpus.list_rows(kind, &ListFilter::default()).expect("listed");
    let rows = listing.rows.iter();
    rows.map(|row| row[name].as_str().unwrap_or_default().to_owned())
        .collect()
}

#[test]
fn signs_become_proposals_that_another_run_replaces_and_undo_removes() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let found = detect(&mut corpus, "signs", ProposeScope::All).expect("detected");
    assert!(found.annotations >= 2, "{found:?}");
    assert_eq!((found.recordings.len(), found.unobserved), (1, 0));
    let proposals = &found.found[0].proposals;
    assert_eq!(proposals.len() as u64, found.annotations);
    let tiers = column(&corpus, ListKind::Tiers, "name");
    assert!(
        tiers.contains(&"movement.phase right (proposed)".to_owned()),
        "{tiers:?}"
    );
    let origins = column(&corpus, ListKind::Annotations, "origin");
    assert_eq!(origins.len(), proposals.len());
    assert!(origins.iter().all(|it| it == "detector"), "{origins:?}");
    let faults = corpus
        .check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step))
        .expect("checked");
    assert_eq!(faults.all_findings().next(), None);

    let again = detect(&mut corpus, "signs", ProposeScope::All).expect("detected");
    assert_eq!(again.found, found.found);
    let after = column(&corpus, ListKind::Annotations, "origin").len();
    assert_eq!(after, proposals.len(), "earlier ones are replaced");
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.undo_operation().expect("undone").name, "propose");
    assert!(column(&corpus, ListKind::Tiers, "name").is_empty());
}

#[test]
fn a_run_that_finds_nothing_removes_earlier_proposals_of_its_own_fields_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = recorded(folder.path(), &still_file());
    let recording = || RowName::Text("bol".into());
    let (phase, brows) = ("movement.phase right (proposed)", "nonmanual.brows (proposed)");
    for (tier, component, feature) in [
        (phase, SignComponent::Movement, "phase"),
        (brows, SignComponent::NonManual, "brows"),
    ] {
        let feature = Some(feature.to_owned());
        let role = TierRole::Component { component, feature };
        let tier = NewTier::new(recording(), tier, role);
        corpus.add_tier(&tier).expect("added");
    }
    let mut add = |tier: &str, start: f64, value: &str, origin| {
        let time = |seconds| Some(TableMoment::Time(RecordingInstant::from_seconds(seconds)));
        let change = AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording: recording(),
                tier: tier.to_owned(),
            },
            start: time(start),
            end: time(start + 0.2),
            parent: None,
            order: None,
            value: value.to_owned(),
            confidence: None,
        };
        let options = AnnotateOptions {
            origin,
            ..AnnotateOptions::default()
        };
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        corpus
            .annotate_corpus(&[change.into()], &options, progress)
            .expect("added");
    };
    add(phase, 0.1, "stroke", AnnotationOrigin::Detector);
    add(phase, 0.5, "stroke", AnnotationOrigin::Human);
    add(brows, 0.1, "raised", AnnotationOrigin::Detector);
    let found = detect(&mut corpus, "signs", ProposeScope::All).expect("detected");
    assert_eq!((found.annotations, found.found.len()), (0, 0), "{found:?}");
    assert!(found.without[0].why.starts_with("no hand moves"), "{found:?}");
    let french = localized_message(&found.without[0].why, InterfaceLanguage::French);
    assert!(french.is_some_and(|french| french.starts_with("aucune main ne bouge")));
    assert_eq!(found.recordings, ["bol"]);
    let mut left = column(&corpus, ListKind::Annotations, "value");
    left.sort_unstable();
    assert_eq!(left, ["raised", "stroke"]);
    let mut origins = column(&corpus, ListKind::Annotations, "origin");
    origins.sort_unstable();
    assert_eq!(origins, ["detector", "human"]);
    assert_eq!(corpus.undo_operation().expect("undone").name, "propose");
    assert_eq!(column(&corpus, ListKind::Annotations, "value").len(), 3);
}

#[test]
fn a_span_gets_only_the_detections_that_overlap_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let all = detect(&mut corpus, "signs", ProposeScope::All).expect("detected");
    let all = &all.found[0].proposals;
    corpus.undo_operation().expect("undone");
    let first = &all[0];
    let at = RecordingInstant::from_micros(first.start_us);
    let span = TimeSpan::span_between(at, RecordingInstant::from_micros(first.start_us + 1));
    let scope = ProposeScope::Span(RowName::Text("bol".into()), span);
    let found = detect(&mut corpus, "signs", scope).expect("detected");
    let overlapping = all
        .iter()
        .filter(|it| it.start_us <= first.start_us && it.end_us > first.start_us);
    let overlapping: Vec<_> = overlapping.cloned().collect();
    assert!(!overlapping.is_empty() && overlapping.len() < all.len());
    assert_eq!(found.found[0].proposals, overlapping);
}

#[test]
fn an_unknown_detector_is_refused_with_the_names_of_all_in_both_languages() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let error = detect(&mut corpus, "waves", ProposeScope::All).expect_err("refused");
    let remedy = error.error_remedy().expect("a remedy").remedy_text().to_owned();
    for detector in ALL_DETECTORS {
        assert!(remedy.contains(detector.detector_name()), "{remedy}");
    }
    let french = |text: &str| localized_message(text, InterfaceLanguage::French).expect("French");
    assert_eq!(french(&error.to_string()), "aucun détecteur ne s’appelle \"waves\"");
    assert!(french(&remedy).starts_with("les détecteurs sont"));
}

#[test]
fn a_stop_leaves_the_corpus_and_evidence_has_french_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let before = corpus.corpus_generation().expect("a generation");
    let mut stop = |_: chereme_corpus::ProgressStep<'_>| std::ops::ControlFlow::Break(());
    let options = DetectOptions::propose_with("signs", ProposeScope::All);
    let stopped = corpus.run_detection(&options, &mut ProgressReceiver::new(&mut stop));
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
    assert_eq!(corpus.corpus_generation().expect("a generation"), before);
    let scope = ProposeScope::Recording(RowName::Text("bol".into()));
    let found = detect(&mut corpus, "signs", scope).expect("detected");
    for it in &found.found[0].proposals {
        let french = localized_message(&it.why, InterfaceLanguage::French);
        assert!(french.is_some_and(|french| french != it.why), "{}", it.why);
    }
}

#[test]
fn signs_are_shown_proposed_or_coded_and_proposals_are_no_tokens() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let mut options = DetectOptions::propose_with("signs", ProposeScope::All);
    options.use_as = DetectionUse::Shown;
    let before = corpus.corpus_generation().expect("a generation");
    let shown = detect_with(&mut corpus, &options).expect("detected");
    assert_eq!(corpus.corpus_generation().expect("a generation"), before);
    let signs = |report: &DetectionReport| {
        let proposals = report.found.iter().flat_map(|take| &take.proposals);
        proposals.filter(|proposal| proposal.tier == "gloss (proposed)").count()
    };
    assert_eq!((signs(&shown), shown.annotations), (1, 0));

    options.use_as = DetectionUse::Proposed;
    assert!(detect_with(&mut corpus, &options).expect("detected").annotations > 2);
    assert!(
        column(&corpus, ListKind::Tokens, "gloss").is_empty(),
        "a proposal is no token"
    );
    let choice = ProposalChoice {
        scope: ProposeScope::All,
        tiers: vec!["gloss".to_owned()],
        components: Vec::new(),
        least_confidence: None,
    };
    let mut hear = ignore_progress_step;
    let accepted = corpus.accept_chosen_proposals(&choice, &mut ProgressReceiver::new(&mut hear));
    assert_eq!(accepted.expect("accepted").report.added, 1);
    assert_eq!(column(&corpus, ListKind::Tokens, "gloss"), ["UNGLOSSED"]);
    corpus.undo_operation().expect("undone");
    corpus.undo_operation().expect("undone");

    options.use_as = DetectionUse::Coded;
    detect_with(&mut corpus, &options).expect("detected");
    assert_eq!(column(&corpus, ListKind::Tokens, "gloss"), ["UNGLOSSED"]);
    let origins = column(&corpus, ListKind::Annotations, "origin");
    assert!(origins.iter().all(|origin| origin == "human"), "{origins:?}");
    let again = detect_with(&mut corpus, &options).expect("detected");
    assert_eq!(again.annotations, 0, "codings are not written twice");
    assert_eq!(corpus.undo_operation().expect("undone").name, "annotate");
}

#[test]
fn codings_proposed_for_an_uncut_take_say_that_it_has_no_signs() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let options = ProposeOptions {
        components: vec![SignComponent::Configuration],
        scope: ProposeScope::All,
    };
    let mut hear = ignore_progress_step;
    let proposed = corpus.propose_components(&options, &mut ProgressReceiver::new(&mut hear));
    let proposed = proposed.expect("proposed");
    let findings = proposed.findings;
    assert_eq!(
        findings,
        [format!(
            "no signs are marked yet, so nothing is proposed for them: {}",
            proposed.uncut[0]
        )]
    );
    let french = localized_message(&findings[0], InterfaceLanguage::French).expect("French");
    assert!(french.starts_with("aucun signe n’est encore marqué"), "{french}");
}

#[test]
fn a_take_named_by_its_gloss_gets_one_token_over_its_sign_or_over_the_whole() {
    let options = ImportOptions {
        completion: Some(chereme_corpus::GLOSSES_FROM_NAMES),
        ..ImportOptions::default()
    };
    for (bvh, is_whole) in [(bowl_file(), false), (still_file(), true)] {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut corpus, report) = recorded_with(folder.path(), &bvh, &options);
        assert_eq!(column(&corpus, ListKind::Tokens, "gloss"), ["bol"]);
        let listing = corpus
            .list_rows(ListKind::Tokens, &ListFilter::default())
            .expect("listed");
        let start = listing.rows[0]["start_us"].as_i64().expect("a time");
        assert_eq!(start == 0, is_whole);
        assert_eq!(report.created.get("annotations"), Some(&1));
        let notes = &report.files[0].findings;
        let note = notes.iter().find(|note| note.message.starts_with("no sign was found"));
        assert_eq!(note.is_some(), is_whole, "{notes:?}");
        corpus.undo_operation().expect("undone");
        assert!(column(&corpus, ListKind::Tokens, "gloss").is_empty());
    }
}
