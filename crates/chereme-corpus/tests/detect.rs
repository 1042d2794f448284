//! Detectors run by name: their proposals are annotations of a detector, replaced by the next run, and undone as one.

use std::path::Path;

use chereme_corpus::words::{InterfaceLanguage, localized_message};
use chereme_corpus::{
    ALL_DETECTORS, AnnotateOptions, AnnotationAction, AnnotationOrigin, Corpus, CorpusError, DetectOptions,
    DetectionReport, ImportOptions, ListFilter, ListKind, NewTier, ProgressReceiver, ProposeScope, RowName,
    TableMoment, TierRequestName, TierRole, ignore_progress_step, starter_files,
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
    let path = folder.join("bol.bvh");
    std::fs::write(&path, bvh).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(
            &[path],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("imported");
    corpus
}

fn detect(corpus: &mut Corpus, detector: &str, scope: ProposeScope) -> chereme_corpus::CorpusResult<DetectionReport> {
    let options = DetectOptions {
        detector: detector.to_owned(),
        scope,
    };
    let mut hear = ignore_progress_step;
    corpus.run_detection(&options, &mut ProgressReceiver::new(&mut hear))
}

/// Returns the value of a column for each row of a listing.
fn column(corpus: &Corpus, kind: ListKind, name: &str) -> Vec<String> {
    let listing = corpus.list_rows(kind, &ListFilter::default()).expect("listed");
    let rows = listing.rows.iter();
    rows.map(|row| row[name].as_str().unwrap_or_default().to_owned())
        .collect()
}

#[test]
fn strokes_become_proposals_that_another_run_replaces_and_undo_removes() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = bowl(folder.path());
    let found = detect(&mut corpus, "strokes", ProposeScope::All).expect("detected");
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

    let again = detect(&mut corpus, "strokes", ProposeScope::All).expect("detected");
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
    let bvh = bowl_file();
    let mut lines: Vec<&str> = bvh.lines().collect();
    let time = lines.iter().position(|it| it.starts_with("Frame Time"));
    let first = time.expect("a frame time") + 1;
    let still = lines[first];
    lines[first..].fill(still);
    let mut corpus = recorded(folder.path(), &lines.join("\n"));
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
    let found = detect(&mut corpus, "strokes", ProposeScope::All).expect("detected");
    assert_eq!((found.annotations, found.found.len()), (0, 0), "{found:?}");
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
    let all = detect(&mut corpus, "strokes", ProposeScope::All).expect("detected");
    let all = &all.found[0].proposals;
    corpus.undo_operation().expect("undone");
    let first = &all[0];
    let at = RecordingInstant::from_micros(first.start_us);
    let span = TimeSpan::span_between(at, RecordingInstant::from_micros(first.start_us + 1));
    let scope = ProposeScope::Span(RowName::Text("bol".into()), span);
    let found = detect(&mut corpus, "strokes", scope).expect("detected");
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
    let options = DetectOptions {
        detector: "strokes".to_owned(),
        scope: ProposeScope::All,
    };
    let stopped = corpus.run_detection(&options, &mut ProgressReceiver::new(&mut stop));
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
    assert_eq!(corpus.corpus_generation().expect("a generation"), before);
    let scope = ProposeScope::Recording(RowName::Text("bol".into()));
    let found = detect(&mut corpus, "strokes", scope).expect("detected");
    for it in &found.found[0].proposals {
        let french = localized_message(&it.why, InterfaceLanguage::French);
        assert!(french.is_some_and(|french| french != it.why), "{}", it.why);
    }
}
