//! Tests of merges of two corpora: copies that diverged, conflicts and their decisions, signers, repeated merges.

use std::fs;
use std::path::{Path, PathBuf};

use super::MergeReport;
use crate::ConflictDecision;
use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;

use crate::{
    AnnotateOptions, AnnotationAction, AnnotationName, Corpus, CorpusAddress, ExportOptions, ExportWhat, ImportOptions,
    ProgressReceiver, RowName, SignerChange, TierRequestName, ignore_progress_step,
};

const EAF: &str = include_str!("tests.eaf");

struct Desk {
    folder: tempfile::TempDir,
}

impl Desk {
    /// Returns two copies of a corpus with one annotated film.
    fn new() -> (Self, Corpus, Corpus) {
        let desk = Self {
            folder: tempfile::tempdir().expect("a folder"),
        };
        let file = desk.path("film.eaf");
        fs::write(&file, EAF).expect("written");
        let mut corpus = Corpus::create_corpus(&desk.path("base.chereme"), "A").expect("made");
        corpus
            .import_paths(&[file], &ImportOptions::default(), progress())
            .expect("imported");
        drop(corpus);
        for copy in ["mine.chereme", "theirs.chereme"] {
            fs::copy(desk.path("base.chereme"), desk.path(copy)).expect("copied");
        }
        let open = |name: &str| Corpus::open_corpus(&desk.path(name), name).expect("opened");
        let (mine, theirs) = (open("mine.chereme"), open("theirs.chereme"));
        (desk, mine, theirs)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn merge(&self, mine: &mut Corpus) -> MergeReport {
        let other = if mine.corpus_file_path().ends_with("mine.chereme") {
            "theirs.chereme"
        } else {
            "mine.chereme"
        };
        mine.merge_corpus(&self.path(other), None, progress()).expect("merged")
    }
}

fn progress() -> &'static mut ProgressReceiver<'static> {
    Box::leak(Box::new(ProgressReceiver::new(Box::leak(Box::new(
        ignore_progress_step,
    )))))
}

fn act(corpus: &mut Corpus, action: AnnotationAction) {
    corpus
        .annotate_corpus(&[action.into()], &AnnotateOptions::default(), progress())
        .expect("annotated");
}

/// Returns the annotations as `tier start-end value` in milliseconds.
fn said(corpus: &Corpus) -> Vec<String> {
    let mut out = Vec::new();
    let what = ExportWhat::Address(CorpusAddress::Recording(RowName::Text("film".into())));
    corpus
        .export_stream(&what, "eaf", &mut out, progress())
        .expect("exported");
    let (transcript, _) = chereme_formats::eaf::read_eaf(&out).expect("an EAF file");
    let mut all = Vec::new();
    for tier in &transcript.tiers {
        for it in &tier.annotations {
            let (start, end) = (
                it.span.span_start_instant().instant_millis(),
                it.span.span_end_instant().instant_millis(),
            );
            all.push(format!("{} {start}-{end} {}", tier.name, it.value));
        }
    }
    all.sort();
    all
}

fn named(corpus: &Corpus, value: &str) -> AnnotationName {
    let sql = "SELECT id FROM annotation WHERE value = ?1";
    let id = corpus.store.read_connection().query_row(sql, [value], |row| row.get(0));
    AnnotationName::Number(id.expect("an annotation"))
}

fn set(corpus: &mut Corpus, value: &str, new: Option<&str>, times: Option<[i64; 2]>) {
    let annotation = named(corpus, value);
    let moment = |at: i64| TableMoment::Time(RecordingInstant::from_millis(at));
    act(
        corpus,
        AnnotationAction::Set {
            annotation,
            start: times.map(|it| moment(it[0])),
            end: times.map(|it| moment(it[1])),
            value: new.map(str::to_owned),
        },
    );
}

fn add(corpus: &mut Corpus, start: i64, end: i64, value: &str) {
    let tiers = crate::db::stored_tiers::load_tier_rows(corpus.store.read_connection(), 1).expect("tiers");
    let moment = |at: i64| Some(TableMoment::Time(RecordingInstant::from_millis(at)));
    act(
        corpus,
        AnnotationAction::Add {
            tier: TierRequestName::Number(tiers[0].id),
            start: moment(start),
            end: moment(end),
            parent: None,
            order: None,
            value: value.into(),
            confidence: None,
        },
    );
}

fn remove(corpus: &mut Corpus, value: &str) {
    let annotation = named(corpus, value);
    act(corpus, AnnotationAction::Remove { annotation });
}

fn is_whole(corpus: &mut Corpus) {
    let report = corpus.check_corpus(false, progress()).expect("checked");
    assert_eq!(report.all_findings().next(), None);
}

/// A BVH file of one joint and two frames.
const MOVEMENT: &str = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n\
     End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0\n0 0 1\n";

#[test]
fn a_capture_that_both_sides_imported_is_one_recording() {
    let (desk, mut mine, mut theirs) = Desk::new();
    for (side, corpus) in [("a", &mut mine), ("b", &mut theirs)] {
        let folder = desk.path(side);
        fs::create_dir(&folder).expect("made");
        fs::write(folder.join("c1.bvh"), MOVEMENT).expect("written");
        fs::write(folder.join("c1.eaf"), EAF).expect("written");
        corpus
            .import_paths(&[folder], &ImportOptions::default(), progress())
            .expect("imported");
    }
    let counts = |corpus: &Corpus| {
        let mut counts = corpus.load_corpus_info().expect("info").counts;
        counts.remove("operations");
        counts
    };
    let before = counts(&mine);
    let report = desk.merge(&mut mine);
    assert_eq!(counts(&mine), before, "{report:?}");
    assert!(
        report
            .notes
            .iter()
            .any(|note| note.contains("\"c1\" from the same file")),
        "{report:?}"
    );
    assert!(report.conflicts.is_empty(), "{report:?}");
    is_whole(&mut mine);
    drop(theirs);
    let mut theirs = Corpus::open_corpus(&desk.path("theirs.chereme"), "theirs").expect("opened");
    // The next merges, in both directions, leave it one recording.
    for _ in 0..2 {
        desk.merge(&mut theirs);
        assert_eq!(counts(&theirs), before);
        desk.merge(&mut mine);
        assert_eq!(counts(&mine), before);
    }
    is_whole(&mut theirs);
}

#[test]
fn captures_with_other_bytes_stay_two_recordings() {
    let (desk, mut mine, mut theirs) = Desk::new();
    for (side, turn, corpus) in [("a", "0 0 1", &mut mine), ("b", "0 0 2", &mut theirs)] {
        let folder = desk.path(side);
        fs::create_dir(&folder).expect("made");
        fs::write(folder.join("c1.bvh"), MOVEMENT.replace("0 0 1", turn)).expect("written");
        corpus
            .import_paths(&[folder], &ImportOptions::default(), progress())
            .expect("imported");
    }
    let report = desk.merge(&mut mine);
    assert_eq!(mine.load_corpus_info().expect("info").counts["recordings"], 3);
    assert!(
        report.notes.iter().any(|note| note.contains("\"c1 (2)\"")),
        "{report:?}"
    );
}

#[test]
fn diverged_copies_are_merged() {
    let (desk, mut mine, mut theirs) = Desk::new();
    set(&mut mine, "CHAT", Some("CHATON"), None);
    add(&mut mine, 600, 700, "M");
    set(&mut theirs, "CHAT", None, Some([0, 550]));
    add(&mut theirs, 600, 700, "M");
    add(&mut theirs, 1600, 1700, "T");
    remove(&mut theirs, "LION");
    theirs
        .change_recording(
            &RowName::Text("film".into()),
            &crate::RecordingChange {
                notes: Some(Some("seen".into())),
                ..Default::default()
            },
        )
        .expect("changed");
    let report = desk.merge(&mut mine);
    assert_eq!(report.conflicts, []);
    let want = [
        "Gloss RH 0-550 CHATON",
        "Gloss RH 1000-1500 CHIEN",
        "Gloss RH 1600-1700 T",
        "Gloss RH 2000-2500 VACHE",
        "Gloss RH 600-700 M",
        "Notes 0-3500 film",
    ];
    assert_eq!(said(&mine), want);
    is_whole(&mut mine);
    let found = mine.search_tokens("gloss:T", &Default::default()).expect("searched");
    assert_eq!(found.hits.len(), 1);
    // A second merge has nothing to do, and one undo reverts the whole merge.
    let again = desk.merge(&mut mine);
    assert!(again.added.is_empty() && again.changed.is_empty(), "{again:?}");
    mine.undo_operation().expect("undone");
    assert!(said(&mine).contains(&"Gloss RH 3000-3500 LION".to_owned()));
    is_whole(&mut mine);
    // The other copy merges this one, and then has the same contents.
    mine.redo_operation().expect("redone");
    desk.merge(&mut theirs);
    assert_eq!(said(&theirs), want);
    is_whole(&mut theirs);
}

#[test]
fn conflicts_keep_both_candidates_and_are_decided_one_by_one() {
    let (desk, mut mine, mut theirs) = Desk::new();
    set(&mut mine, "CHAT", Some("M1"), None);
    set(&mut theirs, "CHAT", Some("T1"), None);
    remove(&mut mine, "CHIEN");
    set(&mut theirs, "CHIEN", Some("T2"), None);
    set(&mut mine, "VACHE", Some("M3"), None);
    remove(&mut theirs, "VACHE");
    add(&mut mine, 600, 700, "M4");
    add(&mut theirs, 650, 750, "T4");
    let before = said(&mine);
    let report = desk.merge(&mut mine);
    assert_eq!(said(&mine), before, "mine stands");
    assert_eq!(report.conflicts.len(), 4, "{:?}", report.conflicts);
    let find = |corpus: &Corpus, text: &str| {
        let all = corpus.merge_conflicts(false).expect("listed").into_iter();
        let mut all = all.filter(|it| [&it.mine, &it.theirs].into_iter().flatten().any(|it| it.text == text));
        all.next().map(|it| it.number)
    };
    let numbers = ["T1", "T2", "M3", "T4"].map(|text| find(&mine, text).expect("there"));
    mine.decide_conflicts(&numbers[..2], ConflictDecision::Theirs)
        .expect("decided");
    mine.decide_conflicts(&numbers[2..3], ConflictDecision::Mine)
        .expect("decided");
    mine.decide_conflicts(&numbers[3..], ConflictDecision::Both)
        .expect("decided");
    assert!(mine.decide_conflicts(&numbers[..1], ConflictDecision::Mine).is_err());
    let want = [
        "Gloss RH (theirs) 650-750 T4",
        "Gloss RH 0-500 T1",
        "Gloss RH 1000-1500 T2",
        "Gloss RH 2000-2500 M3",
        "Gloss RH 3000-3500 LION",
        "Gloss RH 600-700 M4",
        "Notes 0-3500 film",
    ];
    assert_eq!(said(&mine), want);
    is_whole(&mut mine);
    assert!(mine.merge_conflicts(false).expect("listed").is_empty());
    // Decided conflicts are not listed again.
    let again = desk.merge(&mut mine);
    assert_eq!(again.conflicts, []);
    for _ in 0..3 {
        mine.undo_operation().expect("undone");
    }
    assert_eq!(mine.merge_conflicts(false).expect("listed").len(), 4);
    assert_eq!(said(&mine), before);
}

#[test]
fn new_recordings_signs_and_signers_are_merged() {
    let (desk, mut mine, mut theirs) = Desk::new();
    let file = desk.path("second.eaf");
    fs::write(&file, EAF.replace("CHAT", "NEUF")).expect("written");
    theirs
        .import_paths(&[file], &ImportOptions::default(), progress())
        .expect("imported");
    let table = desk.path("signs.csv");
    fs::write(&table, "gloss,handshape\nLUNE,U\n").expect("written");
    theirs
        .import_paths(&[table], &ImportOptions::default(), progress())
        .expect("imported");
    let report = desk.merge(&mut mine);
    assert_eq!(report.added.get("recording"), Some(&1), "{report:?}");
    is_whole(&mut mine);
    for query in ["gloss:NEUF", "gloss:LUNE"] {
        let found = mine.search_tokens(query, &Default::default()).expect("searched");
        assert_eq!(found.hits.len(), 1, "{query}");
    }
    let to = desk.path("second-out.eaf");
    let what = ExportWhat::Address(CorpusAddress::Recording(RowName::Text("second".into())));
    mine.export_corpus(&what, &to, &ExportOptions::default(), progress())
        .expect("exported");
    assert_eq!(fs::read_to_string(to).expect("read"), EAF.replace("CHAT", "NEUF"));
}

#[test]
fn corpora_without_a_common_history_need_a_base() {
    let (desk, mut mine, mut theirs) = Desk::new();
    drop(Corpus::create_corpus(&desk.path("else.chereme"), "A").expect("made"));
    let refused = mine.merge_corpus(&desk.path("else.chereme"), None, progress());
    assert!(refused.expect_err("refused").error_remedy().is_some());
    set(&mut theirs, "CHAT", Some("T"), None);
    let base: &Path = &desk.path("base.chereme");
    let report = mine.merge_corpus(&desk.path("theirs.chereme"), Some(base), progress());
    assert_eq!(report.expect("merged").changed.get("annotation"), Some(&1));
    assert!(said(&mine).contains(&"Gloss RH 0-500 T".to_owned()));
}

#[test]
fn a_signer_is_merged_field_by_field() {
    let (desk, mut mine, mut theirs) = Desk::new();
    let film = RowName::Text("film".into());
    let change = crate::RecordingChange {
        signer: Some(Some("Anna".into())),
        ..Default::default()
    };
    for corpus in [&mut mine, &mut theirs] {
        corpus.change_recording(&film, &change).expect("changed");
    }
    let left = SignerChange {
        handedness: Some(Some(chereme_motion::BodySide::Left)),
        ..Default::default()
    };
    theirs
        .change_signer(&RowName::Text("Anna".into()), &left)
        .expect("changed");
    let report = desk.merge(&mut mine);
    is_whole(&mut mine);
    assert_eq!(
        crate::db::stored_recordings::load_signer_rows(mine.store.read_connection())
            .expect("read")
            .len(),
        1
    );
    assert!(report.conflicts.is_empty(), "{:?}", report.conflicts);
}

#[test]
fn copies_are_merged_again_and_again_in_both_directions() {
    let (desk, mut mine, mut theirs) = Desk::new();
    set(&mut theirs, "CHAT", Some("T1"), None);
    add(&mut theirs, 600, 700, "T2");
    desk.merge(&mut mine);
    // A row from the other copy is changed here; a second merge keeps the change.
    set(&mut mine, "T1", Some("M1"), None);
    set(&mut mine, "T2", Some("M2"), None);
    set(&mut theirs, "LION", Some("T3"), None);
    let report = desk.merge(&mut mine);
    assert_eq!(report.conflicts, []);
    for value in ["0-500 M1", "600-700 M2", "3000-3500 T3"] {
        assert!(said(&mine).contains(&format!("Gloss RH {value}")), "{value}");
    }
    // The other copy merges too, and continues from there.
    let report = desk.merge(&mut theirs);
    assert_eq!(report.conflicts, []);
    assert_eq!(said(&theirs), said(&mine));
    set(&mut theirs, "M1", Some("T4"), None);
    let report = desk.merge(&mut mine);
    assert_eq!(report.conflicts, []);
    assert_eq!(said(&theirs), said(&mine));
    is_whole(&mut mine);
    is_whole(&mut theirs);
}

#[test]
fn a_deletion_is_merged_unless_the_other_copy_changed_the_recording() {
    let film = [CorpusAddress::Recording(RowName::Text("film".into()))];
    let options = crate::DeleteOptions::default();
    let (desk, mut mine, mut theirs) = Desk::new();
    theirs.delete_objects(&film, options, progress()).expect("deleted");
    let report = desk.merge(&mut mine);
    assert_eq!(report.conflicts, []);
    assert_eq!(report.removed.get("recording"), Some(&1), "{report:?}");
    assert!(mine.load_corpus_overview(1).expect("read").recordings.is_empty());
    is_whole(&mut mine);
    mine.undo_operation().expect("undone");
    assert!(!said(&mine).is_empty());

    let (desk, mut mine, mut theirs) = Desk::new();
    set(&mut mine, "CHAT", Some("NEW"), None);
    theirs.delete_objects(&film, options, progress()).expect("deleted");
    let report = desk.merge(&mut mine);
    assert!(!report.conflicts.is_empty(), "{report:?}");
    assert!(said(&mine).iter().any(|it| it.ends_with("NEW")));
    is_whole(&mut mine);
}

#[test]
fn entries_that_both_copies_imported_are_matched_by_their_rows() {
    let (desk, mut mine, mut theirs) = Desk::new();
    let folder = tempfile::tempdir().expect("a folder");
    let import = |corpus: &mut Corpus, text: &str| {
        let path = folder.path().join("lex.csv");
        std::fs::write(&path, text).expect("written");
        let report = corpus.import_paths(&[path], &crate::ImportOptions::default(), progress());
        report.expect("imported");
    };
    let head = "Signbank ID,Gloss,Handshape,Frequency";
    import(&mut mine, &format!("{head}\n7,BANK,B,1\n3,BANK,5,2\n9,EAU,A,3\n"));
    import(&mut theirs, &format!("{head}\n3,BANK,5,2\n5,BANK,S,4\n9,EAU,V,3\n"));
    let report = desk.merge(&mut mine);
    assert_eq!(report.conflicts, []);
    let notes = report.notes.join("\n");
    assert!(
        notes.contains("\"BANK#3\" here") && notes.contains("\"EAU\" is coded differently"),
        "{notes}"
    );
    let mut found = |query: &str| {
        let answer = mine.search_tokens(query, &crate::SearchOptions::default());
        answer
            .expect(query)
            .hits
            .into_iter()
            .map(|hit| hit.gloss)
            .collect::<Vec<_>>()
    };
    for (query, wanted) in [
        ("gloss=BANK", ["BANK", "BANK#2", "BANK#3"].as_slice()),
        ("sign=BANK#2 configuration=5", &["BANK#2"]),
        ("sign=BANK#3 configuration=S frequency=4", &["BANK#3"]),
        ("gloss=EAU", &["EAU", "EAU"]),
    ] {
        let mut glosses = found(query);
        glosses.sort();
        assert_eq!(glosses, wanted, "{query}");
    }
    is_whole(&mut mine);
    // The same merge again adds nothing.
    let again = desk.merge(&mut mine);
    assert_eq!((again.conflicts.len(), again.added.len()), (0, 0), "{again:?}");
}
