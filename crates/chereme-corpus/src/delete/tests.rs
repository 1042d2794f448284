use std::path::PathBuf;

use chereme_motion::RecordingInstant;
use rusqlite::types::Value;

use super::*;
use crate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, ImportOptions, SearchOptions, SignChange, TableMoment,
    ignore_progress_step, unpack_starter,
};

/// Returns a new corpus in `folder` with the content of `files`.
fn imported(folder: &tempfile::TempDir, files: &[PathBuf]) -> Corpus {
    let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("created");
    corpus
        .import_paths(
            files,
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("imported");
    corpus
}

/// Returns a corpus with two captured takes and a small lexicon, and LIMACE, which is generated from one of them.
fn corpus() -> (tempfile::TempDir, Corpus) {
    let folder = tempfile::tempdir().expect("a folder");
    let files = unpack_starter(&folder.path().join("files")).expect("unpacked");
    let wanted = ["escargot", "bol", "lexicon"];
    let named = |path: &PathBuf| path.file_stem().is_some_and(|it| wanted.iter().any(|w| it == *w));
    let files: Vec<PathBuf> = files.into_iter().filter(named).collect();
    let mut corpus = imported(&folder, &files);
    corpus
        .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
        .expect("generated");
    (folder, corpus)
}

fn delete(corpus: &mut Corpus, what: &str, dependents: DependentsPolicy) -> CorpusResult<DeletionReport> {
    let what: Vec<CorpusAddress> = what
        .split_whitespace()
        .map(|it| it.parse().expect("an address"))
        .collect();
    let options = DeleteOptions {
        dependents,
        dry_run: false,
    };
    corpus.delete_objects(&what, options, &mut ProgressReceiver::new(&mut ignore_progress_step))
}

/// Every row of every table, except the history and the search index.
fn state(corpus: &Corpus) -> Vec<(String, Vec<Value>)> {
    let connection = corpus.store.read_connection();
    let tables = "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'search_%'
                  AND name NOT IN ('operation', 'changeset', 'search_file') ORDER BY name";
    let mut tables = connection.prepare(tables).expect("a schema");
    let tables = tables.query_map([], |row| row.get::<_, String>(0));
    let mut all = Vec::new();
    for table in tables.expect("tables").map(|it| it.expect("a name")) {
        let kept = match &*table {
            "row_seal" => "WHERE tbl NOT IN ('operation', 'changeset', 'search_file')",
            _ => "",
        };
        let sql = format!("SELECT * FROM {table} {kept} ORDER BY 1, 2");
        let mut statement = connection.prepare(&sql).expect("a table");
        let width = statement.column_count();
        let rows = statement.query_map([], |row| (0..width).map(|at| row.get(at)).collect());
        for row in rows.expect("rows") {
            all.push((table.clone(), row.expect("a row")));
        }
    }
    all
}

/// Fails with the rows that are not as they were.
fn same(corpus: &Corpus, before: &[(String, Vec<Value>)], what: &str) {
    let now = state(corpus);
    let missing: Vec<_> = before.iter().filter(|row| !now.contains(row)).collect();
    let new: Vec<_> = now.iter().filter(|row| !before.contains(row)).collect();
    assert!(now == before, "{what}: {missing:?} became {new:?}");
}

fn found(corpus: &mut Corpus, query: &str) -> usize {
    corpus
        .search_tokens(query, &SearchOptions::default())
        .expect("an answer")
        .total
}

fn blocks(corpus: &Corpus) -> i64 {
    let sql = "SELECT count(*) FROM block";
    corpus
        .store
        .read_connection()
        .query_row(sql, [], |row| row.get(0))
        .expect("a number")
}

fn faultless(corpus: &mut Corpus) {
    let checked = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step));
    assert_eq!(checked.expect("checked").all_findings().next(), None);
}

#[test]
fn a_recording_is_deleted_with_its_rows_and_undo_restores_them_all() {
    let (_folder, mut corpus) = corpus();
    let (before, stored) = (state(&corpus), blocks(&corpus));
    assert_eq!(found(&mut corpus, "gloss=BOL"), 1);
    let done = delete(&mut corpus, "recording:bol", DependentsPolicy::Refuse).expect("deleted");
    assert_eq!(done.recordings.len(), 1);
    let own = done.recordings[0].belongings;
    assert!(
        own.tracks > 0 && own.tiers > 1 && own.annotations > 1 && own.tokens == 1,
        "{own:?}"
    );
    assert_eq!(found(&mut corpus, "gloss=BOL"), 0);
    assert!(
        corpus
            .movement_at_address(&"recording:bol".parse().expect("an address"))
            .is_err()
    );
    let connection = corpus.store.read_connection();
    for (table, condition) in [
        ("tier", "recording_id NOT IN (SELECT id FROM recording)"),
        ("annotation", "tier_id NOT IN (SELECT id FROM tier)"),
        ("track_block", "track_id NOT IN (SELECT id FROM track)"),
        ("token_value", "token_id NOT IN (SELECT id FROM token)"),
    ] {
        let sql = format!("SELECT count(*) FROM {table} WHERE {condition}");
        let left: i64 = connection.query_row(&sql, [], |row| row.get(0)).expect("a number");
        assert_eq!(left, 0, "{table}");
    }
    assert_eq!(blocks(&corpus), stored, "undo needs the blocks");
    faultless(&mut corpus);
    let after = state(&corpus);
    corpus.undo_operation().expect("undone");
    same(&corpus, &before, "undone");
    assert_eq!(found(&mut corpus, "gloss=BOL"), 1);
    assert!(
        corpus
            .movement_at_address(&"recording:bol".parse().expect("an address"))
            .is_ok()
    );
    faultless(&mut corpus);
    corpus.redo_operation().expect("done again");
    same(&corpus, &after, "done again");
}

#[test]
fn a_source_is_deleted_only_if_the_fate_of_its_generated_signs_is_given() {
    let (_folder, mut corpus) = corpus();
    let before = state(&corpus);
    let limace: CorpusAddress = "LIMACE".parse().expect("an address");
    let movement = |corpus: &Corpus| corpus.movement_at_address(&limace).map(|it| it.clip);
    let own = movement(&corpus).expect("it moves");
    let refused = delete(&mut corpus, "recording:escargot", DependentsPolicy::Refuse);
    let refused = refused.expect_err("LIMACE depends on it");
    assert!(refused.to_string().ends_with("from escargot: LIMACE"), "{refused}");
    same(&corpus, &before, "refused");
    let seen = corpus.delete_objects(
        &["recording:escargot".parse().expect("an address")],
        DeleteOptions {
            dry_run: true,
            ..DeleteOptions::default()
        },
        &mut ProgressReceiver::new(&mut ignore_progress_step),
    );
    let seen = seen.expect("a report");
    assert!(seen.dry_run && seen.dependents.len() == 1, "{seen:?}");
    same(&corpus, &before, "tried");

    let kept = delete(&mut corpus, "recording:escargot", DependentsPolicy::Keep).expect("deleted");
    assert_eq!((kept.recordings.len(), kept.dependents.len()), (1, 1));
    assert_eq!(movement(&corpus).expect("it moves"), own, "it keeps its movement");
    assert_eq!(found(&mut corpus, "gloss=LIMACE origin=made"), 1);
    faultless(&mut corpus);
    corpus.undo_operation().expect("undone");
    same(&corpus, &before, "undone");

    let both = delete(&mut corpus, "recording:escargot", DependentsPolicy::Delete).expect("deleted");
    let names: Vec<&str> = both.recordings.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["escargot", "LIMACE"]);
    assert!(movement(&corpus).is_err());
    faultless(&mut corpus);
    corpus.undo_operation().expect("undone");
    same(&corpus, &before, "undone");
}

#[test]
fn a_sign_is_deleted_with_its_entry_and_its_generated_recording() {
    let (_folder, mut corpus) = corpus();
    let before = state(&corpus);
    let done = delete(&mut corpus, "sign:LIMACE", DependentsPolicy::Refuse).expect("deleted");
    assert_eq!(done.signs, ["LIMACE"]);
    let names: Vec<&str> = done.recordings.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["LIMACE"]);
    assert_eq!(found(&mut corpus, "gloss=LIMACE"), 0);
    faultless(&mut corpus);
    corpus.undo_operation().expect("undone");
    same(&corpus, &before, "undone");
}

#[test]
fn an_annotated_sign_is_deleted_with_its_annotations_only_on_request() {
    let (_folder, mut corpus) = corpus();
    let before = state(&corpus);
    let refused = delete(&mut corpus, "sign:BOL", DependentsPolicy::Keep).expect_err("it is annotated");
    assert!(
        refused.to_string().contains("BOL has 1 token in recordings that stay"),
        "{refused}"
    );
    let done = delete(&mut corpus, "sign:BOL", DependentsPolicy::Delete).expect("deleted");
    assert!(done.recordings.is_empty() && done.annotations > 0, "{done:?}");
    assert!(
        corpus
            .movement_at_address(&"recording:bol".parse().expect("an address"))
            .is_ok()
    );
    assert_eq!(found(&mut corpus, "gloss=BOL"), 0);
    faultless(&mut corpus);
    corpus.undo_operation().expect("undone");
    same(&corpus, &before, "undone");
}

#[test]
fn deleting_a_citation_form_promotes_another_token_and_keeps_a_described_sign() {
    let (_folder, mut corpus) = corpus();
    let bol = RowName::Text("BOL".into());
    let note = SignChange {
        notes: Some(Some("rare".into())),
        ..SignChange::default()
    };
    corpus.change_sign(&bol, &note).expect("changed");
    let copy = corpus.recombine_recipe("BOL", "ESCARGOT").expect("generated");
    let add = AnnotationChange::from(AnnotationAction::Set {
        annotation: crate::AnnotationName::Number(
            signs::load_token_row(corpus.store.read_connection(), copy.token.expect("a token"))
                .expect("read")
                .annotation_id
                .expect("an annotation"),
        ),
        start: None,
        end: Some(TableMoment::Time(RecordingInstant::from_micros(400_000))),
        value: Some("BOL".into()),
    });
    corpus
        .annotate_corpus(
            &[add],
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("changed");
    delete(&mut corpus, "recording:bol", DependentsPolicy::Keep).expect("deleted");
    let cited = address::find_addressed_token(corpus.store.read_connection(), &CorpusAddress::Gloss("BOL".into()));
    assert_eq!(cited.expect("a token").recording_id, copy.recording);
    faultless(&mut corpus);
    delete(&mut corpus, "recording:ESCARGOT", DependentsPolicy::Refuse).expect("deleted");
    assert!(
        corpus
            .sign_details(&bol)
            .expect("it has a remark")
            .tokens
            .iter()
            .all(|it| it.recording_id.is_none())
    );
}

#[test]
fn only_recordings_and_signs_are_deleted_here() {
    let (_folder, mut corpus) = corpus();
    for (what, remedy) in [
        ("token:1", "annotate CORPUS remove"),
        ("tier:1", "remove-tier"),
        ("LIMACE", "sign:\"LIMACE\" or recording:\"LIMACE\""),
        ("nobody", "list CORPUS signs"),
        ("recording:nobody", "list CORPUS recordings"),
        ("sign:9999", "list CORPUS signs"),
    ] {
        let refused = delete(&mut corpus, what, DependentsPolicy::Delete).expect_err(what);
        let said = refused.error_remedy().unwrap_or_default();
        assert!(said.remedy_text().contains(remedy), "{what}: {said}");
    }
}

#[test]
fn a_bare_name_deletes_a_recording_but_no_sign() {
    let (_folder, mut corpus) = corpus();
    corpus
        .change_recording(
            &RowName::Text("bol".into()),
            &crate::RecordingChange {
                name: Some("take one".into()),
                ..Default::default()
            },
        )
        .expect("renamed");
    let mut delete = |name: &str| {
        let what = [name.parse().expect("an address")];
        let options = DeleteOptions {
            dependents: DependentsPolicy::Delete,
            dry_run: true,
        };
        corpus.delete_objects(&what, options, &mut ProgressReceiver::new(&mut ignore_progress_step))
    };
    let deleted = delete("\"take one\"").expect("a recording");
    assert_eq!(
        (deleted.recordings.len(), &*deleted.signs),
        (1, &["BOL".to_owned()][..])
    );
    let refused = delete("BOL").expect_err("a sign with all its tokens").to_string();
    assert!(refused.contains("with all its tokens"), "{refused}");
}

/// Returns a corpus with a recording of each kind of track.
fn kinds() -> (tempfile::TempDir, Corpus) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path
    };
    let files = [
        file(
            "body.bvh",
            "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n\
             OFFSET 0 1 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0\n0 0 1\n",
        ),
        file(
            "points.trc",
            "PathFileType\t4\t(X/Y/Z)\tpoints.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n\
             100\t100\t2\t1\tmm\nFrame#\tTime\tLWRA\n\t\tX1\tY1\tZ1\n\n1\t0.00\t1.5\t9\t3\n2\t0.01\t1.6\t\t3\n",
        ),
        file(
            "face.csv",
            "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.25\n00:00:00:01.0,61,0.5\n",
        ),
        crate::film::tests::film(folder.path(), [64, 48], 25),
    ];
    let corpus = imported(&folder, &files);
    (folder, corpus)
}

#[test]
fn tracks_of_every_kind_are_listed_counted_exported_deleted_and_restored() {
    let (folder, mut corpus) = kinds();
    let all = ["curves", "markers", "media", "skeleton"];
    let counted = |corpus: &Corpus| {
        let info = corpus.load_corpus_info().expect("information");
        let counts = all.map(|kind| info.tracks.get(kind).copied().unwrap_or_default());
        let listed = corpus.list_rows(crate::ListKind::Tracks, &crate::ListFilter::default());
        assert_eq!(listed.expect("a list").total, counts.iter().sum::<u64>());
        counts
    };
    assert_eq!(counted(&corpus), [1; 4]);
    faultless(&mut corpus);
    let out = folder.path().join("all");
    let options = crate::ExportOptions::default();
    corpus
        .export_corpus(
            &crate::ExportWhat::All,
            &out,
            &options,
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("exported");
    for name in ["body.bvh", "points.markers.csv", "face.face.csv"] {
        assert!(out.join("recordings").join(name).is_file(), "{name}");
    }
    let before = state(&corpus);
    let rows = crate::db::stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("recordings");
    let names: Vec<i64> = rows.iter().map(|it| it.id).collect();
    for id in &names {
        let done = delete(&mut corpus, &format!("recording:{id}"), DependentsPolicy::Refuse);
        assert_eq!(done.expect("deleted").recordings[0].belongings.tracks, 1);
        faultless(&mut corpus);
    }
    assert_eq!(counted(&corpus), [0; 4]);
    for _ in &names {
        corpus.undo_operation().expect("undone");
    }
    same(&corpus, &before, "restored");
    faultless(&mut corpus);
    corpus.undo_operation().expect("the import undone");
    assert_eq!(counted(&corpus), [0; 4]);
    faultless(&mut corpus);
}
