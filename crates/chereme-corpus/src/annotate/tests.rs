//! Tests of the tier rules through the store, and of derived changes.

mod arrange;
mod copies;
mod laws;
mod paste;
mod replace;
mod scheme;
mod summaries;
mod tables;
mod tier_rounds;
mod tiers;

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::RecordingInstant;
use chereme_sign::{SignComponent, TierRole, TierStereotype};
use rusqlite::Connection;
use rusqlite::types::Value;

use super::*;
use crate::address::RowName;
use crate::db::stored_recordings::{self, MotionTrackRow, RecordingRow};
use crate::progress::ignore_progress_step;

const RECORDING: &str = "Take 1";

/// Returns a corpus with a recording of ten seconds at 100 frames per second that has these tiers: `G` and `H` for
/// glosses of the right and left hand, `C` for configurations, `L` for places with any text, and below `G`, with the
/// four stereotypes, `T`, `I`, `S` and `A`.
fn corpus() -> (tempfile::TempDir, Corpus) {
    static MADE: std::sync::LazyLock<Vec<u8>> = std::sync::LazyLock::new(|| {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        make(&path);
        std::fs::read(path).expect("a file")
    });
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("c.chereme");
    std::fs::write(&path, &*MADE).expect("written");
    let corpus = Corpus::open_corpus(&path, "A").expect("opened");
    (folder, corpus)
}

fn make(path: &std::path::Path) {
    let mut corpus = Corpus::create_corpus(path, "A").expect("made");
    corpus
        .store
        .named_operation("fill", |connection| Ok((fill(connection)?, String::new())))
        .expect("filled");
    let component = |component| TierRole::Component {
        component,
        feature: None,
    };
    let tiers = [
        ("G", TierRole::Gloss, Some("right"), None),
        ("H", TierRole::Gloss, Some("left"), None),
        ("C", component(SignComponent::Configuration), Some("right"), None),
        ("L", component(SignComponent::Placement), None, None),
        ("T", TierRole::Free, None, Some(TierStereotype::TimeSubdivision)),
        ("I", TierRole::Translation, None, Some(TierStereotype::IncludedIn)),
        ("S", TierRole::Free, None, Some(TierStereotype::SymbolicSubdivision)),
        ("A", TierRole::Comment, None, Some(TierStereotype::SymbolicAssociation)),
    ];
    for (name, role, hand, below) in tiers {
        let mut tier = NewTier::new(RowName::Text(RECORDING.into()), name, role);
        tier.hand = hand.map(|hand| chereme_formats::roles::AnnotatedHands::One(hand.parse().expect("a hand")));
        tier.parent = below.map(|stereotype| ("G".to_owned(), stereotype));
        if name == "L" {
            tier.values = TierValueSource::Free;
        }
        corpus.add_tier(&tier).expect("added");
    }
}

fn fill(connection: &Connection) -> CorpusResult<()> {
    let signer = stored_recordings::signer_named(connection, "Anna", Some("right"))?;
    let recording = RecordingRow {
        id: 0,
        name: RECORDING.into(),
        signer_id: Some(signer),
        signer: None,
        origin: crate::RecordOrigin::Captured,
        duration_us: 10_000_000,
        licence: None,
        notes: None,
    };
    let recording_id = stored_recordings::insert_recording(connection, &recording)?;
    let skeleton_id = stored_recordings::skeleton_stored(connection, "x", 1, "{}")?;
    let track = MotionTrackRow {
        id: 0,
        recording_id,
        name: "skeleton".into(),
        offset_us: 0,
        skeleton_id,
        frames: 1000,
        rate_frames: 100,
        rate_seconds: 1,
        frame_time: None,
        metres_per_unit: 1.0,
        axes: "y,x".into(),
        root_order: None,
        root_scale: None,
        roles: None,
        channel_groups: "{}".into(),
    };
    stored_recordings::insert_motion_track(connection, &track)?;
    Ok(())
}

/// Reads `add G 0-100 BOL`, `below S 1 x @0`, `set 1 0-50`, `set 1 = CHAT`, `split 1 50`,
/// `merge 1 2 = CHAT`, `order 3 0` or `remove 1`; times are milliseconds.
fn action(text: &str) -> AnnotationAction {
    let (text, value) = match text.split_once(" = ") {
        Some((text, value)) => (text, Some(value.to_owned())),
        None => (text, None),
    };
    let words: Vec<&str> = text.split(' ').collect();
    let name = |at: usize| AnnotationName::parse_annotation_name(words[at], None);
    let tier = |at: usize| {
        TierRequestName::parse_tier_name(words[at], Some(&RowName::Text(RECORDING.into()))).expect("a tier")
    };
    let at = |text: &str| match text.strip_prefix('f') {
        Some(_) => text.parse().expect("a frame"),
        None => TableMoment::Time(RecordingInstant::from_millis(text.parse().expect("milliseconds"))),
    };
    let times = |place: usize| words.get(place).and_then(|text| text.split_once('-'));
    let number = |text: &str| text.parse().expect("a number");
    match words[0] {
        "add" | "below" => AnnotationAction::Add {
            tier: tier(1),
            start: times(2).map(|(start, _)| at(start)),
            end: times(2).map(|(_, end)| at(end)),
            parent: (words[0] == "below").then(|| name(2)),
            value: (*words.get(3).unwrap_or(&"")).to_owned(),
            order: words.get(4).map(|text| number(&text[1..])),
            confidence: None,
        },
        "set" => AnnotationAction::Set {
            annotation: name(1),
            start: times(2).map(|(start, _)| at(start)),
            end: times(2).map(|(_, end)| at(end)),
            value,
        },
        "split" => AnnotationAction::Split {
            annotation: name(1),
            at: at(words[2]),
        },
        "merge" => AnnotationAction::Merge {
            first: name(1),
            second: name(2),
            value,
            join: true,
        },
        "order" => AnnotationAction::Reorder {
            annotation: name(1),
            order: number(words[2]),
        },
        "remove" => AnnotationAction::Remove { annotation: name(1) },
        other => panic!("{other} is no action"),
    }
}

fn annotate(corpus: &mut Corpus, text: &str) -> CorpusResult<AnnotateReport> {
    let changes: Vec<AnnotationChange> = text.split("; ").map(|text| action(text).into()).collect();
    let mut hear = ignore_progress_step;
    corpus.annotate_corpus(
        &changes,
        &AnnotateOptions::default(),
        &mut ProgressReceiver::new(&mut hear),
    )
}

/// Returns the annotations as `G 1 0-100 BOL`, those with a parent as `T 2<1 0-50 x`, in milliseconds.
fn shown(corpus: &Corpus) -> String {
    let sql = "SELECT t.name || ' ' || a.id || coalesce('<' || a.parent_id, '') || ' '
                   || (a.start_us / 1000) || '-' || (a.end_us / 1000) || ' '
                   || CASE a.state WHEN 'value' THEN a.value ELSE a.state END
               FROM annotation a JOIN tier t ON t.id = a.tier_id
               ORDER BY t.id, a.start_us, a.position, a.id";
    strings(corpus.store.read_connection(), sql).join("; ")
}

/// Returns the tokens as `BOL 0-100: right.configuration=5`.
fn tokens_shown(corpus: &Corpus) -> String {
    let sql = "SELECT s.gloss || ' ' || (t.start_us / 1000) || '-' || (t.end_us / 1000)
                   || coalesce((SELECT ': ' || group_concat(coalesce(v.phase || '.', '') || coalesce(v.hand || '.', '')
                          || v.component || '=' || coalesce(v.value, v.state), ' ' ORDER BY v.id)
                      FROM token_value v WHERE v.token_id = t.id), '')
               FROM token t JOIN sign s ON s.id = t.sign_id ORDER BY t.start_us, t.id";
    strings(corpus.store.read_connection(), sql).join("; ")
}

fn strings(connection: &Connection, sql: &str) -> Vec<String> {
    let mut statement = connection.prepare(sql).expect("sql");
    let rows = statement.query_map([], |row| row.get(0)).expect("rows");
    rows.collect::<rusqlite::Result<_>>().expect("rows")
}

/// Returns every row of the tables that annotations affect.
fn rows(connection: &Connection) -> Vec<Vec<Value>> {
    let mut all = Vec::new();
    for table in [
        "recording",
        "tier",
        "annotation",
        "sign",
        "sign_text",
        "token",
        "token_value",
    ] {
        let mut statement = connection
            .prepare(&format!("SELECT * FROM {table} ORDER BY id"))
            .expect("sql");
        let width = statement.column_count();
        let rows = statement
            .query_map([], |row| {
                (0..width)
                    .map(|at| row.get(at))
                    .collect::<rusqlite::Result<Vec<Value>>>()
            })
            .expect("rows");
        all.extend(rows.map(|row| row.expect("a row")));
    }
    all
}

#[test]
fn the_rules_of_the_tiers_hold_through_the_store() {
    for (before, change, want) in [
        // Roots.
        ("", "add G 0-100 BOL", "G 1 0-100 BOL"),
        ("add G 0-100 BOL", "add G 50-150 CHAT", "overlaps \"BOL\""),
        (
            "add G 0-100 BOL",
            "add G 100-100 CHAT",
            "must last at least a microsecond",
        ),
        (
            "add G 0-100 BOL",
            "add G 9900-10100 CHAT",
            "after the end of the recording",
        ),
        ("add G 0-100 BOL", "below G 1 x", "needs a start and an end"),
        (
            "add G 0-100 BOL; add G 200-300 CHAT",
            "set 1 250-350",
            "overlaps \"CHAT\"",
        ),
        ("add G 0-100 BOL", "set 1 50-150 = CHAT", "G 1 50-150 CHAT"),
        ("add G 0-100 BOL", "split 1 40", "G 1 0-40 BOL; G 2 40-100 BOL"),
        ("add G 0-100 BOL", "split 1 100", "cannot be cut at"),
        ("add G 0-100 BOL; add G 100-150 CHAT", "merge 1 2", "say"),
        (
            "add G 0-100 BOL; add G 100-150 CHAT",
            "merge 1 2 = CHIEN",
            "G 1 0-150 CHIEN",
        ),
        ("add G 0-100 BOL; add H 100-150 BOL", "merge 1 2", "not neighbours"),
        ("add G 0-100 BOL", "order 1 0", "no Symbolic_Subdivision"),
        ("add G 0-100 BOL", "remove 7", "there is no annotation:7"),
        ("add G 0-100 BOL", "set 1 f5-f20", "G 1 50-200 BOL"),
        ("add G 0-100 BOL", "set 1 f5-f2000", "has 1000 frames"),
        // Time_Subdivision.
        ("add G 0-100 BOL", "add T 0-50 x", "must last from"),
        ("add G 0-100 BOL", "add T 200-300 x", "must lie inside one annotation"),
        (
            "add G 0-100 BOL; add T 0-100 x",
            "add T 60-100 y",
            "G 1 0-100 BOL; T 2<1 0-60 x; T 3<1 60-100 y",
        ),
        (
            "add G 0-100 BOL; add T 0-100 x; split 2 50",
            "set 2 0-70",
            "G 1 0-100 BOL; T 2<1 0-70 x; T 3<1 70-100 x",
        ),
        (
            "add G 0-100 BOL; add T 0-100 x; split 2 50",
            "set 2 10-50",
            "cannot have a boundary",
        ),
        (
            "add G 0-100 BOL; add T 0-100 x; split 2 50",
            "remove 3",
            "G 1 0-100 BOL; T 2<1 0-100 x",
        ),
        (
            "add G 0-100 BOL; add T 0-100 x; split 2 50",
            "set 1 0-200",
            "G 1 0-200 BOL; T 2<1 0-50 x; T 3<1 50-200 x",
        ),
        // Included_In.
        (
            "add G 0-100 BOL; add I 10-50 x",
            "set 2 10-150",
            "must lie inside one annotation",
        ),
        (
            "add G 0-100 BOL; add I 10-50 x",
            "set 1 500-600",
            "G 1 500-600 BOL; I 2<1 510-550 x",
        ),
        (
            "add G 0-100 BOL; add I 10-50 x",
            "set 1 30-100",
            "G 1 30-100 BOL; I 2<1 30-50 x",
        ),
        ("add G 0-100 BOL; add I 10-50 x", "set 1 60-100", "G 1 60-100 BOL"),
        (
            "add G 0-100 BOL; add I 10-50 x",
            "split 1 30",
            "G 1 0-30 BOL; G 3 30-100 BOL; I 2<1 10-30 x; I 4<3 30-50 x",
        ),
        (
            "add G 0-100 BOL; add I 10-50 x; split 1 30",
            "merge 1 3",
            "G 1 0-100 BOL; I 2<1 10-50 x",
        ),
        // Symbolic_Subdivision.
        ("add G 0-90 BOL", "add S 0-90 x", "G 1 0-90 BOL; S 2<1 0-90 x"),
        (
            "add G 0-90 BOL; below S 1 x; below S 1 y",
            "below S 1 z @1",
            "G 1 0-90 BOL; S 2<1 0-30 x; S 4<1 30-60 z; S 3<1 60-90 y",
        ),
        (
            "add G 0-90 BOL; below S 1 x; below S 1 y",
            "order 3 0",
            "G 1 0-90 BOL; S 3<1 0-45 y; S 2<1 45-90 x",
        ),
        (
            "add G 0-90 BOL; below S 1 x; below S 1 y",
            "set 2 0-20",
            "no times of their own",
        ),
        (
            "add G 0-90 BOL; below S 1 x; below S 1 y",
            "remove 2",
            "G 1 0-90 BOL; S 3<1 0-90 y",
        ),
        (
            "add G 0-90 BOL; below S 1 x; below S 1 y",
            "set 1 0-180",
            "G 1 0-180 BOL; S 2<1 0-90 x; S 3<1 90-180 y",
        ),
        ("add G 0-90 BOL", "add S 50-150 x", "holds the time"),
        // Symbolic_Association.
        (
            "add G 0-90 BOL; below A 1 x",
            "below A 1 y",
            "on the Symbolic_Association",
        ),
        (
            "add G 0-90 BOL; below A 1 x",
            "set 1 5-95",
            "G 1 5-95 BOL; A 2<1 5-95 x",
        ),
        ("add G 0-90 BOL; below A 1 x; below S 1 y; add I 0-90 z", "remove 1", ""),
        ("add G 0-90 BOL; below A 1 x", "below A 2 y", "is not on"),
        // Values.
        ("add C 0-90 U", "set 1 = h", "C 1 0-90 H"),
        ("", "add C 0-90 unclear", "C 1 0-90 unclear"),
        ("", "add C 0-90 N/A", "C 1 0-90 not-applicable"),
        ("add C 0-90 U", "set 1 = unset", "C 1 0-90 unset"),
        ("", "add C 0-90 XYZ", "is no value of the inventory"),
        ("", "add L 0-90 anywhere", "L 1 0-90 anywhere"),
        ("", "add G 0-90 NA", "G 1 0-90 NA"),
        (
            "add G 0-90 BOL; below A 1 x",
            "set 2 = n/a",
            "G 1 0-90 BOL; A 2<1 0-90 n/a",
        ),
        // Tiers.
        ("", "add X 0-90 BOL", "its tiers are"),
        ("", "add g 0-90 BOL", "G 1 0-90 BOL"),
    ] {
        let (_folder, mut corpus) = corpus();
        for text in before.split("; ").filter(|text| !text.is_empty()) {
            annotate(&mut corpus, text).expect(text);
        }
        let unchanged = rows(corpus.store.read_connection());
        match annotate(&mut corpus, change) {
            Ok(_) => assert_eq!(shown(&corpus), want, "{before} | {change}"),
            Err(error) => {
                let message = format!("{error} {}", error.error_remedy().unwrap_or_default());
                assert!(
                    message.contains(want) && !want.is_empty(),
                    "{before} | {change}: {message}"
                );
                assert_eq!(rows(corpus.store.read_connection()), unchanged, "{change}");
            }
        }
    }
}

#[test]
fn tokens_signs_and_search_follow() {
    let (_folder, mut corpus) = corpus();
    for (change, want) in [
        ("add G 0-100 BOL", "BOL 0-100"),
        (
            "add C 0-90 U; add L 0-50 chin",
            "BOL 0-100: right.configuration=U right.placement=chin",
        ),
        (
            "add L 50-100 chest",
            "BOL 0-100: right.configuration=U initial.right.placement=chin final.right.placement=chest",
        ),
        (
            "set 1 = LION",
            "LION 0-100: right.configuration=U initial.right.placement=chin final.right.placement=chest",
        ),
        (
            "split 1 50",
            "LION 0-50: right.configuration=U right.placement=chin; LION 50-100: right.placement=chest",
        ),
        (
            "remove 4",
            "LION 0-50: right.configuration=U right.placement=chin; LION 50-100",
        ),
        ("set 1 = unset", "LION 50-100: right.configuration=U"),
        ("remove 5", ""),
    ] {
        annotate(&mut corpus, change).expect(change);
        assert_eq!(tokens_shown(&corpus), want, "{change}");
        let tokens = strings(corpus.store.read_connection(), "SELECT CAST(id AS TEXT) FROM token").len();
        let (_, index) = corpus.store.searchable_connection().expect("index");
        assert_eq!(index.indexed_document_count(), tokens as u64, "{change}");
        assert!(!index.was_rebuilt(), "{change}");
    }
    assert!(strings(corpus.store.read_connection(), "SELECT gloss FROM sign").is_empty());
}

#[test]
fn components_move_to_another_gloss_if_the_glosses_change() {
    for (before, change, want) in [
        // A component that extends beyond the changed time stays with the gloss that contains most of it.
        (
            "add G 0-40 BOL; add G 50-200 CHAT; add C 10-200 U",
            "set 1 = LION",
            "LION 0-40; CHAT 50-200: right.configuration=U",
        ),
        // If that gloss is removed, the one before it takes over, although it lies outside the change.
        (
            "add G 0-40 BOL; add G 50-200 CHAT; add C 10-200 U",
            "remove 2",
            "BOL 0-40: right.configuration=U",
        ),
        (
            "add G 0-40 BOL; add C 10-200 U",
            "add G 50-200 CHAT",
            "BOL 0-40; CHAT 50-200: right.configuration=U",
        ),
        (
            "add G 0-40 BOL; add G 300-400 CHAT; add C 300-400 U",
            "set 3 0-50",
            "BOL 0-40: right.configuration=U; CHAT 300-400",
        ),
    ] {
        let (_folder, mut corpus) = corpus();
        for text in before.split("; ").chain([change]) {
            annotate(&mut corpus, text).expect(text);
        }
        assert_eq!(tokens_shown(&corpus), want, "{before} | {change}");
    }
}

#[test]
fn an_edited_annotation_belongs_to_the_user_and_loses_its_file_times() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add G 0-100 BOL; add I 10-50 x; add G 200-300 CHAT").expect("added");
    let as_file = |corpus: &mut Corpus| {
        let from_file = "UPDATE annotation SET origin = 'file', external_id = 'a' || id, file_start_ms = start_us / 1000,
             file_end_ms = end_us / 1000, source = '{\"entry\":\"e1\",\"timing\":{\"proposed\":{\"start\":true,\"end\":false}}}'";
        let work = |connection: &Connection| Ok((connection.execute(from_file, [])?, String::new()));
        corpus.store.named_operation("file", work).expect("written");
    };
    let sql = "SELECT id || ' ' || origin || ' ' || coalesce(file_start_ms, '-') || ' ' || coalesce(external_id, '-') || ' '
                   || coalesce(source ->> '$.entry', '-') || ' ' || (source ->> '$.timing') FROM annotation ORDER BY id";
    let proposed = "{\"proposed\":{\"start\":true,\"end\":false}}";
    for (change, want) in [
        (
            "set 1 5-105",
            [
                "1 human - a1 e1 own".to_owned(),
                "2 file - a2 e1 own".to_owned(),
                format!("3 file 200 a3 e1 {proposed}"),
            ],
        ),
        (
            "set 3 = CHIEN",
            [
                format!("1 file 5 a1 e1 {proposed}"),
                format!("2 file 15 a2 e1 {proposed}"),
                format!("3 human 200 a3 - {proposed}"),
            ],
        ),
    ] {
        as_file(&mut corpus);
        annotate(&mut corpus, change).expect(change);
        assert_eq!(strings(corpus.store.read_connection(), sql), want, "{change}");
    }
}

#[test]
fn a_list_of_changes_is_applied_whole_or_not_at_all() {
    let (_folder, mut corpus) = corpus();
    let before = rows(corpus.store.read_connection());
    let text = "add G 0-100 BOL; add G 50-150 CHAT; add G 200-300 OR; add C 0-90 XYZ";
    let error = annotate(&mut corpus, text).expect_err("two faults");
    assert!(
        matches!(&error, CorpusError::Several { errors, .. } if errors.len() == 2),
        "{error}"
    );
    assert_eq!(rows(corpus.store.read_connection()), before);
    let report = annotate(&mut corpus, "add G 0-100 BOL; split 1 50; remove 1").expect("made");
    assert_eq!((report.added, report.changed, report.removed), (2, 1, 1));
    assert_eq!(report.annotations, [1, 2, 1]);
    assert_eq!(
        corpus.operation_log(1).expect("log")[0].summary,
        "2 added, 1 changed, 1 removed in Take 1"
    );
}

#[test]
fn tables_are_applied_or_refused_row_by_row() {
    let good = "tier,start,end,value,action,id,parent\n\
                G,0,1,BOL,,g1,\n\
                S,,,first,,,g1\n\
                S,0,1,second,,,\n\
                tier:1,f150,f200,CHAT,add,g2,\n\
                G,,,CHIEN,set,g2,\n\
                G,1.5,1.8,,set,,\n\
                C,0,900ms,Y,,c,\n\
                C,0,,,remove,,\n";
    let (_folder, mut corpus) = corpus();
    let mut hear = ignore_progress_step;
    let options = AnnotateOptions::default();
    let mut progress = ProgressReceiver::new(&mut hear);
    let (report, findings) = corpus
        .annotate_table(good.as_bytes(), "good.csv", None, &options, &mut progress)
        .expect("carried out");
    assert!(findings.is_empty(), "{findings:?}");
    assert_eq!(report.annotations.len(), 8);
    let want = "G 1 0-1000 BOL; G 4 1500-1800 CHIEN; S 2<1 0-500 first; S 3<1 500-1000 second";
    assert_eq!(shown(&corpus), want);
    let bad = "recording,tier,start,end,value,action,id,parent\n\
               ,G,0,0.5,CHAT,,,\n\
               Take 2,G,3,4,CHAT,,,\n\
               ,G,3,x,CHAT,,,\n\
               ,G,3,4,CHAT,,fine,\n\
               ,G,,,,remove,a99,\n\
               ,G,1.6,,,remove,,\n\
               ,C,3,4,UU,,late,\n\
               ,C,,,U,set,late,\n";
    let before = rows(corpus.store.read_connection());
    let error = corpus
        .annotate_table(bad.as_bytes(), "bad.csv", None, &options, &mut progress)
        .expect_err("faults");
    let message = error.to_string();
    for want in [
        "6 changes cannot be made, and none was:\nbad.csv, line 2: ",
        "bad.csv, line 4: end: \"x\" is no time",
        "bad.csv, line 2: a new annotation from 0.000s to 0.500s overlaps \"BOL\"",
        "bad.csv, line 3: no recording is called \"Take 2\"",
        "bad.csv, line 6: no annotation is called \"a99\"",
        "bad.csv, line 7: no annotation of the tier \"G\" starts at 1.600s",
        "bad.csv, line 8: \"UU\" is no value",
    ] {
        assert!(message.contains(want), "{want} in\n{message}");
    }
    assert_eq!(rows(corpus.store.read_connection()), before);
}

#[test]
fn times_snap_to_frames() {
    let (_folder, mut corpus) = corpus();
    let options = AnnotateOptions {
        snap: true,
        ..AnnotateOptions::default()
    };
    let mut hear = ignore_progress_step;
    let changes = [action("add G 14-106 BOL").into()];
    corpus
        .annotate_corpus(&changes, &options, &mut ProgressReceiver::new(&mut hear))
        .expect("added");
    assert_eq!(shown(&corpus), "G 1 10-110 BOL");
}

#[test]
fn a_change_of_one_annotation_among_thousands_touches_few_rows() {
    let (_folder, mut corpus) = corpus();
    let add: Vec<AnnotationChange> = (0..2000)
        .map(|n| action(&format!("add {} {}-{} BOL{}", ["G", "H"][n % 2], n * 4, n * 4 + 4, n)).into())
        .collect();
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(&add, &AnnotateOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("added");
    annotate(&mut corpus, "add C 4000-4004 U").expect("added");
    for (change, most) in [
        ("set 1001 4001-4004", 4),
        ("set 1001 = NEW", 6),
        ("split 1001 4002", 6),
        ("remove 1001", 6),
    ] {
        annotate(&mut corpus, change).expect(change);
        let changes = corpus.operation_log(1).expect("log")[0].changes;
        assert!(changes <= most, "{change} changed {changes} rows");
    }
}
