//! Laws of merges, on corpora that random changes drive apart, and on one hour annotated by two people.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use proptest::prelude::*;

use super::MergeReport;
use crate::ConflictDecision;
use crate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, Corpus, ImportOptions, ProgressReceiver,
    TierRequestName, ignore_progress_step,
};

const EAF: &str = include_str!("../tests.eaf");

/// Imports a text of EAF into a new corpus, and returns the bytes of the corpus.
fn corpus_of(eaf: &str) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, path) = (folder.path().join("film.eaf"), folder.path().join("c.chereme"));
    fs::write(&file, eaf).expect("written");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&[file], &ImportOptions::default(), progress)
        .expect("imported");
    drop(corpus);
    fs::read(path).expect("a corpus")
}

/// A folder with copies of one corpus.
struct Copies(tempfile::TempDir);

impl Copies {
    fn of(bytes: &[u8], names: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        for name in names {
            fs::write(folder.path().join(name), bytes).expect("written");
        }
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn open(&self, name: &str) -> Corpus {
        Corpus::open_corpus(&self.path(name), name).expect("opened")
    }
}

fn merge(mine: &mut Corpus, other: &Path) -> MergeReport {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    mine.merge_corpus(other, None, progress).expect("merged")
}

/// An annotation: its row, tier, start, end and value, times in milliseconds.
type Said = (i64, String, i64, i64, String);

fn annotations(corpus: &Corpus) -> Vec<Said> {
    let sql = "SELECT a.id, t.name, a.start_us / 1000, a.end_us / 1000, a.value FROM annotation a
         JOIN tier t ON t.id = a.tier_id ORDER BY t.name, a.start_us, a.end_us, a.value";
    let connection = corpus.store.read_connection();
    let mut statement = connection.prepare(sql).expect("a query");
    let rows = statement
        .query_map([], |row| {
            let (id, tier, start) = (row.get(0)?, row.get(1)?, row.get(2)?);
            Ok((id, tier, start, row.get(3)?, row.get(4)?))
        })
        .expect("rows");
    rows.map(|row| row.expect("a row")).collect()
}

/// Returns the annotations without their rows, which differ from copy to copy.
fn said(corpus: &Corpus) -> Vec<(String, i64, i64, String)> {
    let all = annotations(corpus).into_iter();
    all.map(|it| (it.1, it.2, it.3, it.4)).collect()
}

/// Changes a corpus in one operation; returns whether its rules allowed that.
fn change(corpus: &mut Corpus, actions: Vec<AnnotationAction>) -> bool {
    let changes: Vec<AnnotationChange> = actions.into_iter().map(Into::into).collect();
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let done = corpus.annotate_corpus(&changes, &AnnotateOptions::default(), progress);
    done.is_ok()
}

fn moment(millis: i64) -> Option<TableMoment> {
    Some(TableMoment::Time(RecordingInstant::from_millis(millis)))
}

fn set(id: i64, [start, end]: [Option<i64>; 2], value: Option<String>) -> AnnotationAction {
    AnnotationAction::Set {
        annotation: AnnotationName::Number(id),
        start: start.and_then(moment),
        end: end.and_then(moment),
        value,
    }
}

fn add(tier: i64, start: i64, end: i64, value: String) -> AnnotationAction {
    AnnotationAction::Add {
        tier: TierRequestName::Number(tier),
        start: moment(start),
        end: moment(end),
        parent: None,
        order: None,
        value,
        confidence: None,
    }
}

/// A change: the index of the annotation, the kind, and the amount.
type Deed = (usize, u8, i64);

fn work(corpus: &mut Corpus, deeds: &[Deed], name: &str) {
    for (at, what, far) in deeds {
        let all: Vec<Said> = annotations(corpus)
            .into_iter()
            .filter(|it| it.1 == "Gloss RH")
            .collect();
        let Some((id, _, start, end, _)) = all.get(at % all.len().max(1)).cloned() else {
            return;
        };
        let action = match what % 5 {
            0 => set(id, [None, None], Some(format!("{name}{far}"))),
            1 => set(id, [None, Some((end + far).max(start + 1))], None),
            2 => set(id, [Some((start + far).clamp(0, end - 1)), None], None),
            3 => {
                let start = 4000 + far.abs() * 300;
                add(1, start, start + 200, format!("{name}+{far}"))
            }
            _ => AnnotationAction::Remove {
                annotation: AnnotationName::Number(id),
            },
        };
        change(corpus, vec![action]);
    }
}

fn start() -> &'static [u8] {
    static START: OnceLock<Vec<u8>> = OnceLock::new();
    START.get_or_init(|| corpus_of(EAF))
}

fn operations(corpus: &Corpus) -> i64 {
    let sql = "SELECT count(*) FROM operation";
    let count = corpus.store.read_connection().query_row(sql, [], |row| row.get(0));
    count.expect("a count")
}

fn is_whole(corpus: &mut Corpus) -> bool {
    let mut hear = ignore_progress_step;
    let report = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut hear));
    report.expect("checked").all_findings().next().is_none()
}

fn deeds() -> impl Strategy<Value = Vec<Deed>> {
    proptest::collection::vec((0usize..20, 0u8..5, -50i64..50), 0..5)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(20) })]

    #[test]
    fn merging_an_unchanged_copy_changes_nothing_and_it_receives_every_change(theirs in deeds()) {
        let copies = Copies::of(start(), &["mine", "theirs"]);
        let (mut mine, mut other) = (copies.open("mine"), copies.open("theirs"));
        work(&mut other, &theirs, "t");
        let want = said(&other);
        let report = merge(&mut other, &copies.path("mine"));
        prop_assert!(report.conflicts.is_empty() && report.added.is_empty(), "{report:?}");
        prop_assert_eq!(said(&other), want.clone());
        let report = merge(&mut mine, &copies.path("theirs"));
        prop_assert!(report.conflicts.is_empty(), "{report:?}");
        prop_assert_eq!(said(&mine), want);
        prop_assert!(is_whole(&mut mine));
    }

    #[test]
    fn two_copies_merge_to_the_same_contents_in_either_direction_without_loss(a in deeds(), b in deeds()) {
        let copies = Copies::of(start(), &["mine", "theirs", "mine 2"]);
        let (mut mine, mut theirs) = (copies.open("mine"), copies.open("theirs"));
        let base = said(&mine);
        work(&mut mine, &a, "m");
        work(&mut theirs, &b, "t");
        drop((mine, theirs));
        fs::copy(copies.path("theirs"), copies.path("theirs 2")).expect("copied");
        fs::copy(copies.path("mine"), copies.path("mine 2")).expect("copied");
        let (mut mine, mut theirs) = (copies.open("mine"), copies.open("theirs 2"));
        let (own, other) = (said(&mine), said(&theirs));
        let before = operations(&mine);
        let one = merge(&mut mine, &copies.path("theirs"));
        let two = merge(&mut theirs, &copies.path("mine 2"));
        prop_assert!(is_whole(&mut mine) && is_whole(&mut theirs));
        if one.conflicts.is_empty() && two.conflicts.is_empty() {
            prop_assert_eq!(said(&mine), said(&theirs));
        }
        // Every value that either side wrote is in the corpus, or in a conflict as a candidate.
        let is_new = |it: &&(String, i64, i64, String)| base.iter().all(|old| old.3 != it.3);
        for (merged, report) in [(said(&mine), &one), (said(&theirs), &two)] {
            for row in own.iter().chain(&other).filter(is_new) {
                let stands = merged.iter().any(|it| it.3 == row.3);
                let waits = report.conflicts.iter().any(|it| {
                    [&it.mine, &it.theirs].into_iter().flatten().any(|it| it.text == row.3)
                });
                prop_assert!(stands || waits, "{row:?} {report:?}");
            }
        }
        // A conflict changes nothing here, and a second merge has nothing to do.
        let merged = said(&mine);
        let again = merge(&mut mine, &copies.path("theirs"));
        prop_assert!(again.added.is_empty() && again.changed.is_empty() && again.removed.is_empty(), "{again:?}");
        prop_assert_eq!(said(&mine), merged);
        for _ in before..operations(&mine) {
            mine.undo_operation().expect("undone");
        }
        prop_assert_eq!(said(&mine), own);
    }

    #[test]
    fn conflicts_decided_for_theirs_take_the_contents_of_the_other_copy(a in deeds(), b in deeds()) {
        let copies = Copies::of(start(), &["mine", "theirs"]);
        let (mut mine, mut theirs) = (copies.open("mine"), copies.open("theirs"));
        work(&mut mine, &a, "m");
        work(&mut theirs, &b, "t");
        let report = merge(&mut mine, &copies.path("theirs"));
        let before = said(&mine);
        for conflict in &report.conflicts {
            mine.decide_conflicts(&[conflict.number], ConflictDecision::Theirs).expect("decided");
            let there = said(&mine);
            match &conflict.theirs {
                Some(side) => prop_assert!(there.iter().any(|it| it.3 == side.text), "{conflict:?}"),
                None => prop_assert!(there.len() <= before.len()),
            }
        }
        prop_assert!(mine.merge_conflicts(false).expect("listed").is_empty());
        prop_assert!(is_whole(&mut mine));
        for _ in &report.conflicts {
            mine.undo_operation().expect("undone");
        }
        prop_assert_eq!(said(&mine), before);
    }
}

/// The number of annotations in an hour, one every three seconds.
const HOUR: i64 = 1200;

fn hour() -> String {
    let (mut slots, mut annotations) = (String::new(), String::new());
    for at in 0..HOUR {
        let (a, b) = (2 * at + 1, 2 * at + 2);
        let (start, end) = (3000 * at, 3000 * at + 1500);
        slots += &format!(
            r#"<TIME_SLOT TIME_SLOT_ID="ts{a}" TIME_VALUE="{start}"/><TIME_SLOT TIME_SLOT_ID="ts{b}" TIME_VALUE="{end}"/>"#
        );
        annotations += &format!(
            r#"<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a{at}" TIME_SLOT_REF1="ts{a}" TIME_SLOT_REF2="ts{b}"><ANNOTATION_VALUE>S{at}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"#
        );
    }
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="2024-01-01T00:00:00+00:00" FORMAT="3.0" VERSION="3.0">
<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"/><TIME_ORDER>{slots}</TIME_ORDER>
<TIER LINGUISTIC_TYPE_REF="gloss" TIER_ID="Gloss RH">{annotations}</TIER>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true"/>
</ANNOTATION_DOCUMENT>"#
    )
}

/// An annotator's change of an annotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Edit {
    Value,
    End,
    Start,
    Remove,
    Add,
    Nothing,
}

fn mine_does(at: i64) -> Edit {
    match at % 7 {
        0 => Edit::Value,
        1 => Edit::End,
        2 => Edit::Remove,
        3 => Edit::Add,
        _ => Edit::Nothing,
    }
}

fn theirs_does(at: i64) -> Edit {
    match at % 5 {
        0 => Edit::Value,
        1 => Edit::Start,
        2 => Edit::Remove,
        3 => Edit::Add,
        _ => Edit::Nothing,
    }
}

fn actions(corpus: &Corpus, name: &str, gap: i64, does: fn(i64) -> Edit) -> Vec<AnnotationAction> {
    let all = annotations(corpus).into_iter().enumerate();
    all.filter_map(|(at, (id, _, start, end, _))| {
        let at = i64::try_from(at).expect("few");
        Some(match does(at) {
            Edit::Value => set(id, [None, None], Some(format!("{name}{at}"))),
            Edit::End => set(id, [None, Some(end + 100)], None),
            Edit::Start => set(id, [Some(start + 50), None], None),
            Edit::Remove => AnnotationAction::Remove {
                annotation: AnnotationName::Number(id),
            },
            Edit::Add => add(1, start + gap, start + gap + 200, format!("{name}+{at}")),
            Edit::Nothing => return None,
        })
    })
    .collect()
}

/// Returns the expected result of both changes, computed only from the rules of a merge, and whether they conflict.
fn expected(at: i64) -> (Vec<(i64, i64, String)>, bool) {
    let (start, end) = (3000 * at, 3000 * at + 1500);
    let (mine, theirs) = (mine_does(at), theirs_does(at));
    let mut all = Vec::new();
    let mut own = Some((start, end, format!("S{at}")));
    let mut disagree = false;
    match theirs {
        Edit::Value => own = Some((start, end, format!("T{at}"))),
        Edit::Start => own = Some((start + 50, end, format!("S{at}"))),
        Edit::Remove => own = None,
        Edit::Add => all.push((start + 2200, start + 2400, format!("T+{at}"))),
        Edit::End | Edit::Nothing => {}
    }
    match (mine, theirs) {
        (Edit::Value, Edit::Value | Edit::Remove) => {
            disagree = true;
            own = Some((start, end, format!("M{at}")));
        }
        (Edit::End, Edit::Remove) => {
            disagree = true;
            own = Some((start, end + 100, format!("S{at}")));
        }
        (Edit::Remove, Edit::Value | Edit::Start) => {
            disagree = true;
            own = None;
        }
        (Edit::Remove, _) => own = None,
        (Edit::Value, _) => own = own.map(|it| (it.0, it.1, format!("M{at}"))),
        (Edit::End, _) => own = own.map(|it| (it.0, it.1 + 100, it.2)),
        (Edit::Add, _) => all.push((start + 1700, start + 1900, format!("M+{at}"))),
        _ => {}
    }
    all.extend(own);
    (all, disagree)
}

#[test]
fn an_hour_of_two_annotators_in_two_corpora_is_merged_without_loss() {
    let copies = Copies::of(&corpus_of(&hour()), &["mine", "theirs"]);
    let (mut mine, mut theirs) = (copies.open("mine"), copies.open("theirs"));
    let own = actions(&mine, "M", 1700, mine_does);
    let other = actions(&theirs, "T", 2200, theirs_does);
    assert!(own.len() > 600 && other.len() > 900);
    assert!(change(&mut mine, own) && change(&mut theirs, other));
    let report = merge(&mut mine, &copies.path("theirs"));
    let (mut want, mut disagree) = (BTreeSet::new(), 0);
    for at in 0..HOUR {
        let (all, no) = expected(at);
        want.extend(all);
        disagree += usize::from(no);
    }
    let found: BTreeSet<(i64, i64, String)> = said(&mine).into_iter().map(|it| (it.1, it.2, it.3)).collect();
    let lost: Vec<_> = want.difference(&found).collect();
    let strange: Vec<_> = found.difference(&want).collect();
    assert!(lost.is_empty() && strange.is_empty(), "{lost:?} {strange:?}");
    assert_eq!(report.conflicts.len(), disagree);
    assert!(disagree > 100);
    let candidates: BTreeSet<&str> = report
        .conflicts
        .iter()
        .filter_map(|it| it.theirs.as_ref())
        .map(|it| it.text.as_str())
        .collect();
    for at in (0..HOUR).filter(|at| theirs_does(*at) == Edit::Value && expected(*at).1) {
        assert!(candidates.contains(format!("T{at}").as_str()), "T{at}");
    }
    assert!(is_whole(&mut mine));
}
