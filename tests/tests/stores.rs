//! Corpora that earlier versions wrote: the newest code opens them, whole, with all that they hold.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use chereme_corpus::words::InterfaceLanguage;
use chereme_corpus::words::history_words::operation_sentence;
use chereme_corpus::{
    ConsentAudience, Corpus, ExportOptions, ExportWhat, ListFilter, ListKind, ProgressReceiver, RowName, SearchOptions,
    ignore_progress_step,
};
use chereme_tests::{files, repository};
use rusqlite::Connection;
use rusqlite::types::Value;

/// Returns the stored corpora by their version of the schema.
fn stores() -> BTreeMap<usize, PathBuf> {
    let folder = repository::root().join("tests/stores");
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    files
        .filter_map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            let version = name.strip_suffix(".chereme.zst")?.parse().ok()?;
            Some((version, entry.path()))
        })
        .collect()
}

#[test]
fn there_is_a_corpus_of_every_version_of_the_schema() {
    let steps = repository::schema_steps().len();
    let versions: Vec<usize> = stores().into_keys().collect();
    let wanted: Vec<usize> = (1..=steps).collect();
    assert_eq!(
        versions, wanted,
        "write what is missing: cargo run -p chereme-tests --bin chereme-store -- tests/stores"
    );
}

#[test]
fn corpora_of_earlier_versions_open_without_loss() {
    for (version, store) in stores() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("old.chereme");
        let packed = fs::read(&store).expect("read");
        let bytes = zstd::decode_all(packed.as_slice()).expect("unpacked");
        fs::write(&path, bytes).expect("written");
        let mut corpus = Corpus::open_corpus(&path, "reader").expect("opened");
        let check = corpus
            .check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("checked");
        assert_eq!(check.all_findings().next(), None, "version {version}");
        for (query, total) in [
            ("gloss=BOL", 1),
            ("right.configuration=S placement=chin", 2),
            ("origin=made", 1),
            ("\"slug\"", 1),
        ] {
            let answer = corpus.search_tokens(query, &SearchOptions::default()).expect(query);
            assert_eq!(answer.total, total, "version {version}: {query}");
        }
        let bowl = "recording:\"bowl and cat\"".parse().expect("an address");
        let moving = corpus.movement_at_address(&bowl).expect("movement");
        assert_eq!(moving.clip.clip_frame_count(), 200, "version {version}");
        lists(&corpus, version);
        exports(&corpus, folder.path(), version);
        if version >= 2 {
            let thanks = corpus.notation_at(&"MERCI".parse().expect("an address"));
            let thanks = thanks.expect("a notation").document;
            assert_eq!(thanks.sign.parts[0].actions.len(), 1, "version {version}");
        }
        let kept = usize::from(version >= 3);
        if kept > 0 {
            let found = corpus.search_tokens("@chin", &SearchOptions::default());
            assert_eq!(found.expect("a kept search").total, 2, "version {version}");
        }
        let tracks = usize::from(version >= 7);
        if tracks > 0 {
            let all = corpus
                .recording_tracks(&RowName::Text("bowl and cat".to_owned()))
                .expect("tracks");
            let kinds: Vec<&str> = all.iter().map(|track| track.kind.track_kind_name()).collect();
            assert_eq!(kinds, ["skeleton", "markers", "curves"], "version {version}");
        }
        let studies = if version >= 10 { 2 } else { 0 };
        if studies > 0 {
            let study = corpus.study_with_answers("bowls").expect("a study");
            let right: Vec<Option<bool>> = study.participants[0].answers.iter().map(|it| it.right).collect();
            assert_eq!(study.plan.trials.len(), 2, "version {version}");
            assert_eq!(right, [None, Some(true)], "version {version}");
        }
        let consents = usize::from(version >= 11);
        if consents > 0 {
            let stored = corpus.list_consents().expect("consents");
            let own = stored.iter().find(|it| it.of == "recording");
            let movement = own.and_then(|it| it.consent.movement);
            assert_eq!(movement, Some(ConsentAudience::Research), "version {version}");
        }
        let more = kept + tracks + studies + consents;
        let operations = corpus.operation_log(usize::MAX).expect("log").len();
        assert_eq!(operations, 6 + more, "version {version}");
        histories(&corpus, version);
        corpus.redo_operation().expect("what was undone is done again");
        corpus.undo_operation().expect("and taken back");
        corpus.undo_operation().expect("the made sign is taken back");
        for _ in 0..more {
            corpus
                .undo_operation()
                .expect("kept search, tracks, study and consent are taken back");
        }
        corpus.undo_operation().expect("the import is taken back");
        assert!(corpus.undo_operation().is_err(), "version {version}");
    }
}

/// Operations are described in all languages, also those that were stored with a summary alone.
fn histories(corpus: &Corpus, version: usize) {
    for row in corpus.operation_log(usize::MAX).expect("log") {
        let french = operation_sentence(&row.effect, InterfaceLanguage::French);
        let start = match row.name.as_str() {
            "import" => "Importé : ",
            "recombine" if row.summary.starts_with("LOB") => "LOB composé : BOL | reverse",
            "recombine" => "TAHC composé : CHAT | reverse",
            "keep search" => "Recherche enregistrée : chin",
            "add tracks" => "Pistes ajoutées à bowl and cat : markers, face",
            "change consent" => "Consentement modifié : bowl and cat",
            "plan study" => "Étude préparée : bowls",
            "import answers" => "Réponses importées : bowls, 1 participant",
            other => other,
        };
        assert!(french.starts_with(start), "version {version}: {french}");
    }
}

/// Up to version 4, scalar curves were rows next to a skeleton's track. The corpus is of that version; it holds a sign
/// that lost its curves when it was generated again, and got them back by undo.
#[test]
fn curves_stored_with_movement_become_tracks_with_their_history() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("old.chereme");
    let packed = fs::read(repository::root().join("tests/stores/0004-curves.chereme.zst"));
    let bytes = zstd::decode_all(packed.expect("read").as_slice()).expect("unpacked");
    fs::write(&path, bytes).expect("written");
    let mut corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let sound = |corpus: &mut Corpus| {
        let check = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step));
        let check = check.expect("checked");
        assert!(check.ok, "{:?}", check.faults);
    };
    sound(&mut corpus);
    let tracks = |corpus: &Corpus| {
        let filter = ListFilter::default();
        let listing = corpus.list_rows(ListKind::Tracks, &filter).expect("listed");
        let text = |row: &serde_json::Map<String, serde_json::Value>| {
            format!("{} {} {}", row["kind"], row["name"], row["frames"])
        };
        listing.rows.iter().map(text).collect::<Vec<_>>()
    };
    let both = tracks(&corpus);
    assert_eq!(both.len(), 2, "{both:?}");
    assert!(both[1].starts_with("\"curves\" \"nonmanuals\""), "{both:?}");
    let sign = "VRAAG".parse().expect("an address");
    let curves = corpus.curves_of(&sign).expect("curves");
    assert_eq!(curves[0].name, "brows.RB");
    let most = curves[0].values.iter().copied().fold(0.0, f64::max);
    assert!(curves[0].values.len() > 512 && most > 0.9);
    corpus.redo_operation().expect("made again without curves");
    assert_eq!(tracks(&corpus).len(), 1);
    sound(&mut corpus);
    corpus.undo_operation().expect("taken back");
    assert_eq!(
        (tracks(&corpus), corpus.curves_of(&sign).expect("curves")),
        (both, curves)
    );
    corpus.undo_operation().expect("the sign is taken back");
    assert_eq!(tracks(&corpus), Vec::<String>::new());
    sound(&mut corpus);
    corpus.redo_operation().expect("and made again");
    assert_eq!(tracks(&corpus).len(), 2);
    assert!(corpus.undo_operation().is_ok() && corpus.undo_operation().is_err());
}

/// Up to version 11, a value of a table had no phase beside a final one. The corpus is of that version; its rows and its
/// history get that form.
#[test]
fn values_of_tables_become_initial_beside_final_ones_with_their_history() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("old.chereme");
    let packed = fs::read(repository::root().join("tests/stores/0011.chereme.zst"));
    let bytes = zstd::decode_all(packed.expect("read").as_slice()).expect("unpacked");
    fs::write(&path, bytes).expect("written");
    let old = Connection::open(&path).expect("opened");
    let data = |sql: &str| old.query_row(sql, [], |row| row.get::<_, Vec<u8>>(0));
    let lines = data("SELECT data FROM changeset WHERE operation_id = 1").expect("an import");
    let lines = zstd::decode_all(lines.as_slice()).expect("unpacked");
    let lines = String::from_utf8(lines).expect("text");
    let (begun, phaseless) = ("\"phase\":\"initial\"", "\"phase\":null");
    assert_eq!(lines.matches(begun).count(), 1);
    let lines = zstd::encode_all(lines.replace(begun, phaseless).as_bytes(), 3).expect("packed");
    let sql = "UPDATE changeset SET data = ?1 WHERE operation_id = 1";
    assert_eq!(old.execute(sql, [lines]).ok(), Some(1));
    let sql = "UPDATE token_value SET phase = NULL WHERE phase = 'initial'";
    assert_eq!(old.execute(sql, []).ok(), Some(1));
    drop(old);
    let mut corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let totals = |corpus: &mut Corpus| {
        [
            "placement=neutral > head",
            "final.placement=neutral",
            "initial.placement=neutral",
        ]
        .map(|query| {
            let answer = corpus.search_tokens(query, &SearchOptions::default());
            answer.expect(query).total
        })
    };
    // JOUR goes from neutral space to the head; OUI begins and ends in neutral space.
    assert_eq!(totals(&mut corpus), [1, 1, 2]);
    let check = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step));
    assert_eq!(check.expect("checked").all_findings().next(), None);
    let mut undone = 0;
    while corpus.undo_operation().is_ok() {
        undone += 1;
    }
    for _ in 0..undone {
        corpus.redo_operation().expect("done again");
    }
    assert_eq!(totals(&mut corpus), [1, 1, 2]);
}

/// Returns every row of tiers and annotations as text, and the number of references to rows that do not exist.
fn tiers_and_annotations(path: &Path) -> (Vec<String>, i64) {
    let connection = Connection::open(path).expect("opened");
    let mut rows = Vec::new();
    for table in ["tier", "annotation"] {
        let mut statement = connection
            .prepare(&format!("SELECT * FROM {table} ORDER BY id"))
            .expect("a table");
        let columns = statement.column_count();
        let found = statement.query_map([], |row| {
            let cells: rusqlite::Result<Vec<Value>> = (0..columns).map(|at| row.get(at)).collect();
            Ok(format!("{table} {:?}", cells?))
        });
        rows.extend(found.expect("rows").map(|row| row.expect("a row")));
    }
    let sql = "SELECT count(*) FROM pragma_foreign_key_check";
    let broken = connection.query_row(sql, [], |row| row.get(0));
    (rows, broken.expect("checked"))
}

#[test]
fn an_upgrade_keeps_every_tier_and_undo_and_redo_of_earlier_work_restore_them() {
    for (version, store) in stores() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("old.chereme");
        let packed = fs::read(&store).expect("read");
        let bytes = zstd::decode_all(packed.as_slice()).expect("unpacked");
        fs::write(&path, bytes).expect("written");
        let before = tiers_and_annotations(&path);
        assert!(before.0.len() > 20 && before.1 == 0, "version {version}");
        drop(Corpus::open_corpus(&path, "reader").expect("opened"));
        assert!(tiers_and_annotations(&path) == before, "version {version}");
        let mut corpus = Corpus::open_corpus(&path, "reader").expect("opened");
        let mut undone = 0;
        while corpus.undo_operation().is_ok() {
            undone += 1;
        }
        drop(corpus);
        let (rows, broken) = tiers_and_annotations(&path);
        assert!(rows.is_empty() && broken == 0, "version {version}: {rows:?}");
        let mut corpus = Corpus::open_corpus(&path, "reader").expect("opened");
        for _ in 0..undone {
            corpus.redo_operation().expect("done again");
        }
        drop(corpus);
        assert!(tiers_and_annotations(&path) == before, "version {version}");
    }
}

fn lists(corpus: &Corpus, version: usize) {
    // Corpora from version 2 on hold two signs with notation.
    let notated = if version >= 2 { 2 } else { 0 };
    for (kind, total) in [
        (ListKind::Recordings, 2),
        (ListKind::Signs, 6 + notated),
        (ListKind::Tokens, 7 + notated),
        (ListKind::Tiers, 11),
        (ListKind::Annotations, 14),
        (ListKind::Signers, 1),
    ] {
        let listing = corpus.list_rows(kind, &ListFilter::default()).expect("listed");
        assert_eq!(listing.total, total, "version {version}: {kind:?}");
    }
}

/// The folder of everything, and the movement number by number as it was.
fn exports(corpus: &Corpus, folder: &Path, version: usize) {
    let options = ExportOptions::default();
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let all = folder.join("all");
    let report = corpus
        .export_corpus(&ExportWhat::All, &all, &options, progress)
        .expect("exported");
    assert!(report.files.iter().all(|file| file.bytes > 0), "version {version}");
    let moved = fs::read_to_string(all.join("recordings/bowl and cat.bvh")).expect("movement");
    let numbers = |text: &str| -> Vec<f64> {
        let rows = text.lines().skip_while(|line| !line.starts_with("Frame Time"));
        rows.skip(1)
            .flat_map(str::split_whitespace)
            .filter_map(|it| it.parse().ok())
            .collect()
    };
    assert_eq!(numbers(&moved), numbers(&files::bvh(200, 1)), "version {version}");
}
