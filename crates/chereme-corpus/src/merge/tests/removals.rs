//! Tests of things that one copy removed and the other changed, and of tier rules, on recordings with movement.

use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use proptest::prelude::*;
use rusqlite::types::Value as Cell;

use super::MergeReport;
use crate::ConflictDecision;
use crate::{
    AnnotateOptions, AnnotationAction, AnnotationName, Corpus, CorpusAddress, DeleteOptions, ImportOptions,
    ProgressReceiver, RowName, TierRequestName, ignore_progress_step,
};

/// Two copies of a corpus with two captured signs and a lexicon.
struct Copies {
    folder: tempfile::TempDir,
    mine: Corpus,
    theirs: Corpus,
}

/// Returns the bytes of the corpus that is copied.
fn base() -> &'static [u8] {
    static BASE: OnceLock<Vec<u8>> = OnceLock::new();
    BASE.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let mut files: Vec<PathBuf> = Vec::new();
        for (name, bytes) in crate::starter_files() {
            let stem = name.file_stem().and_then(|it| it.to_str());
            if stem.is_some_and(|it| ["chat", "bol", "lexicon"].contains(&it)) {
                files.push(path(&name.to_string_lossy()));
                fs::write(path(&name.to_string_lossy()), bytes).expect("written");
            }
        }
        let mut corpus = Corpus::create_corpus(&path("base.chereme"), "A").expect("made");
        let options = ImportOptions::default();
        corpus
            .import_paths(&files, &options, &mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("imported");
        drop(corpus);
        fs::read(path("base.chereme")).expect("read")
    })
}

impl Copies {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let open = |name: &str| {
            let path = folder.path().join(name);
            fs::write(&path, base()).expect("written");
            Corpus::open_corpus(&path, name).expect("opened")
        };
        let (mine, theirs) = (open("mine.chereme"), open("theirs.chereme"));
        Self { folder, mine, theirs }
    }

    fn merge(&mut self) -> MergeReport {
        let other = self.folder.path().join("theirs.chereme");
        let mut hear = ignore_progress_step;
        let report = self
            .mine
            .merge_corpus(&other, None, &mut ProgressReceiver::new(&mut hear));
        report.expect("merged")
    }
}

/// Returns the rows of recordings: movement, tiers, annotations and values of tokens.
fn rows(corpus: &Corpus) -> Vec<String> {
    let mut all = Vec::new();
    for sql in [
        "SELECT name, notes FROM recording",
        "SELECT gloss, notes FROM sign",
        "SELECT r.name, t.kind, b.first_frame, hex(b.hash) FROM track t
         JOIN recording r ON r.id = t.recording_id JOIN track_block b ON b.track_id = t.id",
        "SELECT r.name, t.name, t.role, a.start_us, a.end_us, a.value, a.origin, p.value FROM annotation a
         JOIN tier t ON t.id = a.tier_id JOIN recording r ON r.id = t.recording_id
         LEFT JOIN annotation p ON p.id = a.parent_id",
        "SELECT r.name, t.name FROM tier t JOIN recording r ON r.id = t.recording_id",
        "SELECT r.name, f.kind FROM source_file f JOIN recording r ON r.id = f.recording_id",
        "SELECT s.gloss, v.component, v.value FROM token k JOIN sign s ON s.id = k.sign_id
         JOIN token_value v ON v.token_id = k.id",
    ] {
        let mut statement = corpus.store.read_connection().prepare(sql).expect("a query");
        let count = statement.column_count();
        let found = statement.query_map([], |row| {
            let cells = (0..count).map(|at| row.get::<_, Cell>(at));
            Ok(format!("{:?}", cells.collect::<rusqlite::Result<Vec<_>>>()?))
        });
        all.extend(found.expect("rows").map(|row| row.expect("a row")));
    }
    all.sort();
    all
}

fn annotation(corpus: &Corpus, recording: &str, value: &str) -> AnnotationName {
    let sql = "SELECT a.id FROM annotation a JOIN tier t ON t.id = a.tier_id
               JOIN recording r ON r.id = t.recording_id WHERE r.name = ?1 AND a.value = ?2";
    let id = corpus
        .store
        .read_connection()
        .query_row(sql, [recording, value], |row| row.get(0));
    AnnotationName::Number(id.expect("an annotation"))
}

fn act(corpus: &mut Corpus, action: AnnotationAction) {
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(
            &[action.into()],
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("annotated");
}

fn moment(millis: i64) -> Option<TableMoment> {
    Some(TableMoment::Time(RecordingInstant::from_millis(millis)))
}

fn set(corpus: &mut Corpus, value: &str, new: Option<&str>, start: Option<i64>) {
    let annotation = annotation(corpus, "bol", value);
    let action = AnnotationAction::Set {
        annotation,
        start: start.and_then(moment),
        end: None,
        value: new.map(str::to_owned),
    };
    act(corpus, action);
}

fn add(corpus: &mut Corpus, tier: &str, value: &str, [start, end]: [i64; 2]) {
    let sql = "SELECT t.id FROM tier t JOIN recording r ON r.id = t.recording_id
               WHERE r.name = 'bol' AND t.name = ?1";
    let id = corpus.store.read_connection().query_row(sql, [tier], |row| row.get(0));
    let action = AnnotationAction::Add {
        tier: TierRequestName::Number(id.expect("a tier")),
        start: moment(start),
        end: moment(end),
        parent: None,
        order: None,
        value: value.into(),
        confidence: None,
    };
    act(corpus, action);
}

fn delete(corpus: &mut Corpus, address: CorpusAddress) {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .delete_objects(&[address], DeleteOptions::default(), progress)
        .expect("deleted");
}

fn delete_bol(corpus: &mut Corpus) {
    delete(corpus, CorpusAddress::Recording(RowName::Text("bol".into())));
}

fn remove_tier(corpus: &mut Corpus, name: &str) {
    let recording = RowName::Text("bol".into());
    corpus
        .remove_tier(&TierRequestName::Of {
            recording,
            tier: name.into(),
        })
        .expect("removed");
}

fn assert_whole(corpus: &mut Corpus) {
    let mut hear = ignore_progress_step;
    let report = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut hear));
    let report = report.expect("checked");
    assert_eq!(report.all_findings().next(), None);
}

fn conflicts(corpus: &Corpus) -> Vec<(usize, String)> {
    let all = corpus.merge_conflicts(false).expect("listed").into_iter();
    all.map(|it| (it.number, it.what)).collect()
}

type Act = fn(&mut Corpus);

/// The removals of one copy, each with changes of the other copy in what is removed, and the kind of the conflict.
fn cases() -> Vec<(Act, Act, &'static str)> {
    let renamed: Act = |corpus| set(corpus, "BOL", Some("BOL2"), None);
    let added: Act = |corpus| add(corpus, "Brows", "raised", [1160, 1250]);
    let noted: Act = |corpus| {
        let notes = crate::RecordingChange {
            notes: Some(Some("seen".into())),
            ..Default::default()
        };
        let bol = RowName::Text("bol".into());
        corpus.change_recording(&bol, &notes).expect("changed");
    };
    let without_slug: Act = |corpus| delete(corpus, CorpusAddress::Sign(RowName::Text("LIMACE".into())));
    let slug_noted: Act = |corpus| {
        let notes = crate::SignChange {
            notes: Some(Some("seen".into())),
            ..Default::default()
        };
        let slug = RowName::Text("LIMACE".into());
        corpus.change_sign(&slug, &notes).expect("changed");
    };
    let without_gloss: Act = |corpus| {
        let annotation = annotation(corpus, "bol", "BOL");
        act(corpus, AnnotationAction::Remove { annotation });
    };
    let without_brows: Act = |corpus| remove_tier(corpus, "Brows");
    vec![
        (delete_bol, renamed, "recording"),
        (delete_bol, added, "recording"),
        (delete_bol, noted, "recording"),
        (without_brows, added, "tier"),
        (without_gloss, added, "annotation"),
        (without_slug, slug_noted, "sign"),
    ]
}

#[test]
fn a_thing_that_is_removed_there_and_changed_here_stays_whole_until_somebody_decides() {
    for (removes, changes, what) in cases() {
        let mut copies = Copies::new();
        removes(&mut copies.theirs);
        let without = rows(&copies.theirs);
        changes(&mut copies.mine);
        let before = rows(&copies.mine);
        let report = copies.merge();
        assert_eq!(rows(&copies.mine), before, "{what}");
        assert_eq!(report.removed.len(), 0, "{report:?}");
        assert_eq!(conflicts(&copies.mine), [(1, what.to_owned())]);
        assert_whole(&mut copies.mine);
        for (decision, after) in [
            (ConflictDecision::Mine, &before),
            (ConflictDecision::Both, &before),
            (ConflictDecision::Theirs, &without),
        ] {
            copies.mine.decide_conflicts(&[1], decision).expect("decided");
            assert_eq!(&rows(&copies.mine), after, "{what} {decision:?}");
            assert_whole(&mut copies.mine);
            copies.mine.undo_operation().expect("undone");
            assert_eq!(rows(&copies.mine), before, "{what} {decision:?}");
        }
    }
}

#[test]
fn a_thing_that_is_removed_here_and_changed_there_comes_back_whole_until_somebody_decides() {
    for (removes, changes, what) in cases() {
        let mut copies = Copies::new();
        removes(&mut copies.mine);
        let without = rows(&copies.mine);
        changes(&mut copies.theirs);
        let changed = rows(&copies.theirs);
        copies.merge();
        assert_eq!(rows(&copies.mine), changed, "{what}");
        assert_eq!(conflicts(&copies.mine), [(1, what.to_owned())]);
        assert_whole(&mut copies.mine);
        for (decision, after) in [
            (ConflictDecision::Mine, &without),
            (ConflictDecision::Both, &changed),
            (ConflictDecision::Theirs, &changed),
        ] {
            copies.mine.decide_conflicts(&[1], decision).expect("decided");
            assert_eq!(&rows(&copies.mine), after, "{what} {decision:?}");
            assert_whole(&mut copies.mine);
            copies.mine.undo_operation().expect("undone");
        }
        let again = copies.merge();
        assert_eq!(rows(&copies.mine), changed, "{what}");
        assert_eq!((again.added.len(), again.removed.len()), (0, 0), "{again:?}");
    }
}

#[test]
fn a_thing_that_nobody_changed_is_removed_without_a_question() {
    for (removes, ..) in cases() {
        let mut copies = Copies::new();
        removes(&mut copies.theirs);
        let report = copies.merge();
        assert_eq!(report.conflicts, []);
        assert_eq!(rows(&copies.mine), rows(&copies.theirs));
        assert_whole(&mut copies.mine);
    }
}

#[test]
fn a_change_that_would_break_a_tier_rule_waits_for_a_decision() {
    let mut copies = Copies::new();
    set(&mut copies.mine, "BOL", None, Some(1300));
    let before = rows(&copies.mine);
    add(&mut copies.theirs, "Brows", "raised", [1160, 1250]);
    let report = copies.merge();
    assert_eq!(report.conflicts.len(), 1, "{report:?}");
    assert_eq!(rows(&copies.mine), before);
    assert_whole(&mut copies.mine);
    let refused = copies.mine.decide_conflicts(&[1], ConflictDecision::Theirs);
    let message = refused.expect_err("a broken rule").to_string();
    assert!(message.contains("must lie inside"), "{message}");
    assert_eq!(rows(&copies.mine), before);
    set(&mut copies.mine, "BOL", None, Some(1150));
    copies
        .mine
        .decide_conflicts(&[1], ConflictDecision::Theirs)
        .expect("decided");
    assert_whole(&mut copies.mine);
    assert!(rows(&copies.mine).iter().any(|row| row.contains("1160000")));
}

#[test]
fn the_origin_of_a_moved_annotation_is_merged_and_both_glosses_make_tokens() {
    let mut copies = Copies::new();
    set(&mut copies.theirs, "BOL", None, Some(1100));
    copies.merge();
    let moved = |row: &&String| row.contains("\"Gloss\"") && row.contains("\"BOL\"");
    let rows_now = rows(&copies.mine);
    let gloss: Vec<&String> = rows_now.iter().filter(moved).collect();
    assert!(gloss.iter().any(|row| row.contains("human")), "{gloss:?}");

    let mut copies = Copies::new();
    set(&mut copies.mine, "BOL", Some("M"), None);
    set(&mut copies.theirs, "BOL", Some("T"), None);
    copies.merge();
    copies
        .mine
        .decide_conflicts(&[1], ConflictDecision::Both)
        .expect("decided");
    let found = copies.mine.search_tokens("gloss:T", &Default::default());
    assert_eq!(found.expect("searched").hits.len(), 1);
    assert_whole(&mut copies.mine);
}

#[test]
fn a_signer_whom_both_renamed_is_one_conflict() {
    let mut copies = Copies::new();
    let rename = |corpus: &mut Corpus, name: &str| {
        let change = crate::SignerChange {
            name: Some(name.to_owned()),
            ..Default::default()
        };
        let signer = RowName::Text("Camille (made)".into());
        corpus.change_signer(&signer, &change).expect("changed");
    };
    let participants = |corpus: &Corpus, name: &str| -> i64 {
        let sql = "SELECT count(*) FROM tier WHERE participant = ?1";
        let count = corpus.store.read_connection().query_row(sql, [name], |row| row.get(0));
        count.expect("a number")
    };
    let all = participants(&copies.mine, "Camille (made)");
    rename(&mut copies.mine, "Mina");
    rename(&mut copies.theirs, "Thea");
    copies.merge();
    assert_eq!(conflicts(&copies.mine), [(1, "signer".to_owned())]);
    assert_eq!(participants(&copies.mine, "Mina"), all);
    copies
        .mine
        .decide_conflicts(&[1], ConflictDecision::Theirs)
        .expect("decided");
    assert_eq!(participants(&copies.mine, "Thea"), all);
    assert_whole(&mut copies.mine);
}

#[test]
fn tiers_keep_the_new_name_of_a_signer_if_the_decision_is_about_something_else() {
    let mut copies = Copies::new();
    let change = |corpus: &mut Corpus, name: Option<&str>, notes: &str| {
        let change = crate::SignerChange {
            name: name.map(str::to_owned),
            notes: Some(Some(notes.to_owned())),
            ..Default::default()
        };
        let signer = RowName::Text("Camille (made)".into());
        corpus.change_signer(&signer, &change).expect("changed");
    };
    change(&mut copies.mine, Some("Mina"), "mine");
    change(&mut copies.theirs, None, "theirs");
    copies.merge();
    copies
        .mine
        .decide_conflicts(&[1], ConflictDecision::Theirs)
        .expect("decided");
    let sql = "SELECT DISTINCT s.name, t.participant FROM tier t, signer s";
    let row = copies
        .mine
        .store
        .read_connection()
        .query_row(sql, [], |row| Ok((row.get::<_, String>(0)?, row.get::<_, String>(1)?)));
    assert_eq!(row.expect("a row"), ("Mina".to_owned(), "Mina".to_owned()));
}

/// Tries a change of one copy, named by a number and a time; one that is refused changes nothing.
fn tries(corpus: &mut Corpus, (deed, at): (u8, i64)) {
    let id = |sql: &str| corpus.store.read_connection().query_row(sql, [], |row| row.get(0));
    let of = |tier: &str| {
        format!(
            "JOIN tier t ON t.id = a.tier_id JOIN recording r ON r.id = t.recording_id WHERE r.name = 'bol' AND t.name = '{tier}'"
        )
    };
    let annotation = |tier: &str| {
        let sql = format!("SELECT a.id FROM annotation a {} LIMIT 1", of(tier));
        id(&sql).ok().map(AnnotationName::Number)
    };
    let tier = |name: &str| TierRequestName::Of {
        recording: RowName::Text("bol".into()),
        tier: name.to_owned(),
    };
    let set = |tier: &str, start: Option<i64>, end: Option<i64>, value: Option<&str>| {
        Some(AnnotationAction::Set {
            annotation: annotation(tier)?,
            start: start.and_then(moment),
            end: end.and_then(moment),
            value: value.map(str::to_owned),
        })
    };
    let add = |name: &str, value: &str| {
        Some(AnnotationAction::Add {
            tier: tier(name),
            start: moment(at),
            end: moment(at + 90),
            parent: None,
            order: None,
            value: value.into(),
            confidence: None,
        })
    };
    let removed = |tier: &str| {
        let annotation = annotation(tier)?;
        Some(AnnotationAction::Remove { annotation })
    };
    let action = match deed {
        0 => set("Gloss", Some(at), None, None),
        1 => set("Gloss", None, Some(at), None),
        2 => set("Gloss", Some(at), Some(at + 400), None),
        3 => set("Gloss", None, None, Some("BOL2")),
        4 => set("Phase RH", None, Some(at), None),
        5 => set("Configuration RH", Some(at), None, Some("5")),
        6 => add("Brows", "raised"),
        7 => add("Gloss", "NEW"),
        8 => removed("Gloss"),
        9 => removed("Configuration RH"),
        10 => {
            let _ = corpus.remove_tier(&tier("Brows"));
            None
        }
        _ => {
            let bol = [CorpusAddress::Recording(RowName::Text("bol".into()))];
            let mut hear = ignore_progress_step;
            let progress = &mut ProgressReceiver::new(&mut hear);
            let _ = corpus.delete_objects(&bol, DeleteOptions::default(), progress);
            None
        }
    };
    if let Some(action) = action {
        let options = AnnotateOptions::default();
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let _ = corpus.annotate_corpus(&[action.into()], &options, progress);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn a_merge_and_every_decision_keep_a_corpus_whole(
        mine in proptest::collection::vec((0..12_u8, 1000..1800_i64), 0..5),
        theirs in proptest::collection::vec((0..12_u8, 1000..1800_i64), 0..5),
        decision in prop_oneof![Just(ConflictDecision::Mine), Just(ConflictDecision::Theirs), Just(ConflictDecision::Both)],
    ) {
        let mut copies = Copies::new();
        mine.into_iter().for_each(|deed| tries(&mut copies.mine, deed));
        theirs.into_iter().for_each(|deed| tries(&mut copies.theirs, deed));
        copies.merge();
        assert_whole(&mut copies.mine);
        for (number, _) in conflicts(&copies.mine) {
            let before = rows(&copies.mine);
            match copies.mine.decide_conflicts(&[number], decision) {
                Ok(_) => assert_whole(&mut copies.mine),
                Err(error) => {
                    prop_assert!(error.error_remedy().is_some(), "{}", error);
                    prop_assert_eq!(rows(&copies.mine), before);
                }
            }
        }
    }
}
