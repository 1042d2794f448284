//! Tests that damaged rows are named, and that the rest of the file is checked all the same.

use super::*;
use crate::progress::ProgressStep;
use crate::{
    CorpusError, ExportWhat, ImportOptions, SearchOptions, TierSelection, ValueSearch, ignore_progress_step,
    unpack_starter,
};

/// Returns the file of a corpus with one recording that has movement, tiers and tokens.
fn whole(folder: &std::path::Path) -> std::path::PathBuf {
    made_of(folder, "bol.")
}

/// Returns the file of a corpus of the starter files whose names begin so.
fn made_of(folder: &std::path::Path, start: &str) -> std::path::PathBuf {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let is_wanted = |path: &std::path::PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(start)
    };
    let files: Vec<_> = files.into_iter().filter(is_wanted).collect();
    let path = folder.join("whole.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    path
}

#[test]
fn every_damaged_row_is_named_and_the_check_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = whole(folder.path());
    let path = folder.path().join("damaged.chereme");
    let no_frame_time = ("track 1 of recording:1", "the stored frame time is no number");
    // The last damage of each is in another part than the first; both are found.
    for (damage, wanted) in [
        ("UPDATE track SET frame_time = 'null' WHERE id = 1", vec![]),
        (
            "UPDATE annotation SET state = 'x' WHERE id IN (1, 3);
             UPDATE track SET frame_time = 'null' WHERE id = 1",
            vec![
                ("row 1 of annotation", "rule of its table: state IN"),
                ("row 3 of annotation", "rule of its table: state IN"),
                ("recording \"bol\"", "is no word of this column"),
            ],
        ),
        (
            "UPDATE token_value SET component = 'x' WHERE id = 1;
             UPDATE track SET frame_time = 'null' WHERE id = 1",
            vec![("row 1 of token_value", "rule of its table: component IN")],
        ),
        (
            "UPDATE recording SET origin = 'x', duration_us = -1;
             UPDATE track SET frame_time = 'null' WHERE id = 1",
            vec![
                ("row 1 of recording", "rule of its table: "),
                ("recordings", "this part cannot be read: "),
            ],
        ),
        (
            "DELETE FROM search_state;
             UPDATE track SET frame_time = 'null' WHERE id = 1",
            vec![("search index", "this part cannot be read: ")],
        ),
    ] {
        std::fs::copy(&whole, &path).expect("copied");
        let foreign = Connection::open(&path).expect("opened");
        foreign
            .execute_batch("PRAGMA ignore_check_constraints = ON")
            .and_then(|()| foreign.execute_batch(damage))
            .expect(damage);
        drop(foreign);
        for mend in [false, true] {
            let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
            let mut hear = ignore_progress_step;
            let report = corpus
                .check_corpus(mend, &mut ProgressReceiver::new(&mut hear))
                .expect(damage);
            assert!(!report.ok, "{damage}");
            for (place, text) in wanted.iter().chain([&no_frame_time]) {
                let is_wanted = |it: &&CorpusFault| it.place == *place && it.message.contains(text);
                let found = report.faults.iter().filter(is_wanted).count();
                assert_eq!(found, 1, "{damage}: {place}: {text}: {:#?}", report.faults);
            }
            let rows = report
                .faults
                .iter()
                .filter(|it| it.place.starts_with("row ") && it.kind != "row");
            let rows_wanted = wanted.iter().filter(|it| it.0.starts_with("row "));
            assert_eq!(rows.count(), rows_wanted.count(), "{damage}");
            for what in ["blocks", "tracks", "inventories", "skeletons"] {
                assert!(report.checked.contains_key(what), "{damage}: {what}");
            }
        }
    }
}

fn checked(corpus: &mut Corpus, mend: bool) -> CheckReport {
    let mut hear = ignore_progress_step;
    corpus
        .check_corpus(mend, &mut ProgressReceiver::new(&mut hear))
        .expect("checked")
}

#[test]
fn a_changed_cell_of_any_table_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = whole(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let query = crate::KeptSearch {
        name: "mine".into(),
        query: "configuration=U".into(),
    };
    corpus.keep_searches(&[query]).expect("kept");
    corpus.recombine_recipe("BOL | reverse", "LOB").expect("made");
    assert_eq!(checked(&mut corpus, false).faults, []);
    drop(corpus);
    let foreign = Connection::open(&path).expect("opened");
    foreign
        .execute_batch("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF")
        .expect("set");
    let mut cells = 0;
    for table in seals::sealed_tables() {
        let columns: Vec<String> = foreign
            .prepare("SELECT name FROM pragma_table_info(?1) WHERE pk = 0 AND name <> 'uid'")
            .and_then(|mut rows| rows.query_map([table], |row| row.get(0))?.collect())
            .expect("columns");
        let key = match table {
            "changeset" => "operation_id",
            _ => "rowid",
        };
        for column in columns {
            // The last bit of a number, the last letter of a text, the last byte of a blob.
            let damage = format!(
                "UPDATE {table} SET {column} = CASE typeof({column})
                     WHEN 'integer' THEN {column} + 1 WHEN 'real' THEN {column} * 1.000001
                     WHEN 'text' THEN substr({column}, 1, length({column}) - 1) || '~'
                     ELSE CAST(substr({column}, 1, length({column}) - 1) || x'7e' AS BLOB) END
                 WHERE {key} = (SELECT max({key}) FROM {table} WHERE {column} IS NOT NULL)"
            );
            foreign.execute_batch("BEGIN").expect("begun");
            // A rule of the table, such as a unique name, may refuse the change.
            let changed = foreign.execute(&damage, []).unwrap_or_default();
            let broken = seals::broken_seals(&foreign, table).expect("read");
            foreign.execute_batch("ROLLBACK").expect("rolled back");
            assert_eq!(broken.len(), changed, "{table}.{column}");
            cells += changed;
        }
        assert_eq!(seals::broken_seals(&foreign, table).expect("read"), []);
    }
    assert!(cells > 80, "{cells}");
}

#[test]
fn seals_follow_edits_undo_and_redo_and_damage_stays_visible_beside_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = whole(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let find = ValueSearch::Text("BOL".into());
    let replace = |corpus: &mut Corpus, with: &str| {
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let done = corpus.replace_values(&find, with, &TierSelection::default(), false, progress);
        done.expect("replaced").changed
    };
    assert!(replace(&mut corpus, "BOL-2H") > 0);
    assert_eq!(checked(&mut corpus, false).faults, []);
    corpus.undo_operation().expect("undone");
    assert_eq!(checked(&mut corpus, false).faults, []);
    corpus.redo_operation().expect("redone");
    assert_eq!(checked(&mut corpus, false).faults, []);
    let foreign = Connection::open(&path).expect("opened");
    let flip = || {
        let sql = "SELECT operation_id, data FROM changeset";
        let all: Vec<(i64, Vec<u8>)> = foreign
            .prepare(sql)
            .and_then(|mut rows| rows.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect())
            .expect("read");
        for (row, mut data) in all {
            let middle = data.len() / 2;
            data[middle] ^= 1;
            foreign
                .execute(
                    "UPDATE changeset SET data = ?2 WHERE operation_id = ?1",
                    rusqlite::params![row, data],
                )
                .expect("damaged");
        }
    };
    flip();
    let refused = corpus.undo_operation().expect_err("damaged").to_string();
    assert!(refused.contains("of changeset is damaged"), "{refused}");
    flip();
    assert_eq!(checked(&mut corpus, false).faults, []);
    let damage = "UPDATE annotation SET value = 'DAMAGED' WHERE id = (SELECT max(id) FROM annotation)";
    foreign.execute_batch(damage).expect("damaged");
    assert!(replace(&mut corpus, "CAT") > 0, "another row of the bucket");
    let is_row = |fault: &&CorpusFault| fault.kind == "row";
    let report = checked(&mut corpus, true);
    let found: Vec<&CorpusFault> = report.faults.iter().filter(is_row).collect();
    assert_eq!(found.len(), 1, "{:#?}", report.faults);
    assert!(found[0].place.ends_with("of annotation"), "{:?}", found[0]);
    corpus.accept_rows().expect("accepted");
    assert_eq!(checked(&mut corpus, true).faults, []);
}

#[test]
fn a_flipped_bit_in_a_stored_file_is_found_and_never_exported() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = whole(folder.path());
    let corpus = Corpus::open_corpus(&whole, "A").expect("opened");
    let sql = "SELECT id, data, recording_id FROM source_file WHERE data IS NOT NULL AND kind = 'eaf'";
    let (id, data, recording): (i64, Vec<u8>, i64) = corpus
        .store
        .read_connection()
        .query_row(sql, [], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))
        .expect("a file");
    drop(corpus);
    let path = folder.path().join("damaged.chereme");
    for trial in 0..60 {
        std::fs::copy(&whole, &path).expect("copied");
        let mut bytes = data.clone();
        let bit = trial * (bytes.len() * 8 - 1) / 59;
        bytes[bit / 8] ^= 1 << (bit % 8);
        let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
        // Only the hash of the file itself can show it once the rows are taken for right.
        let connection = corpus.store.read_connection();
        let change = "UPDATE source_file SET data = ?2 WHERE id = ?1";
        connection
            .execute(change, rusqlite::params![id, bytes])
            .expect("damaged");
        for accepted in [false, true] {
            if accepted {
                corpus.accept_rows().expect("accepted");
            }
            let mut out = Vec::new();
            let what = ExportWhat::Address(crate::CorpusAddress::Recording(crate::RowName::Number(recording)));
            let mut hear = ignore_progress_step;
            let done = corpus.export_stream(&what, "eaf", &mut out, &mut ProgressReceiver::new(&mut hear));
            assert!(matches!(done, Err(CorpusError::Damaged { .. })), "bit {bit}: {done:?}");
            assert!(out.is_empty(), "bit {bit}");
        }
        let report = checked(&mut corpus, true);
        let is_file = |fault: &&CorpusFault| fault.kind == "file";
        assert_eq!(report.faults.iter().filter(is_file).count(), 1, "bit {bit}");
    }
}

#[test]
fn a_flipped_bit_in_the_index_is_found_and_changes_no_answer() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = made_of(folder.path(), "bol.eaf");
    let queries = ["text:bol", "duration>0.1s gloss=/^[A-Z]/", "", "\"bowl\""];
    let answer = |corpus: &mut Corpus, query: &str| {
        let found = corpus.search_tokens(query, &SearchOptions::default()).ok()?;
        let hits: Vec<i64> = found.hits.iter().map(|hit| hit.token).collect();
        Some((found.total, hits))
    };
    let mut corpus = Corpus::open_corpus(&whole, "A").expect("opened");
    let right: Vec<_> = queries.iter().map(|query| answer(&mut corpus, query)).collect();
    let sql = "SELECT path, data FROM search_file ORDER BY path";
    let files: Vec<(String, Vec<u8>)> = corpus
        .store
        .read_connection()
        .prepare(sql)
        .and_then(|mut rows| rows.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect())
        .expect("files");
    drop(corpus);
    let path = folder.path().join("damaged.chereme");
    for trial in 0..30 {
        std::fs::copy(&whole, &path).expect("copied");
        let (name, data) = &files[trial % files.len()];
        let mut bytes = data.clone();
        let bit = (trial * 7919 + 13) % (bytes.len() * 8);
        bytes[bit / 8] ^= 1 << (bit % 8);
        let foreign = Connection::open(&path).expect("opened");
        let change = "UPDATE search_file SET data = ?2 WHERE path = ?1";
        // With a checksum that fits, the seal of all files shows it.
        let hidden = "UPDATE search_file SET data = ?2, checksum = ?3 WHERE path = ?1";
        match trial % 2 == 1 {
            true => foreign.execute(hidden, rusqlite::params![name, bytes, crc32fast::hash(&bytes)]),
            false => foreign.execute(change, rusqlite::params![name, bytes]),
        }
        .expect("damaged");
        drop(foreign);
        let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
        if trial % 4 < 2 {
            let report = checked(&mut corpus, false);
            let kinds: Vec<_> = report.faults.iter().map(|fault| fault.kind).collect();
            assert_eq!(kinds, ["index"], "{name}, bit {bit}");
        }
        let answers: Vec<_> = queries.iter().map(|query| answer(&mut corpus, query)).collect();
        assert_eq!(answers, right, "{name}, bit {bit}");
        assert!(checked(&mut corpus, true).ok);
        let answers: Vec<_> = queries.iter().map(|query| answer(&mut corpus, query)).collect();
        assert_eq!(answers, right, "{name}, bit {bit}: mended");
    }
}

#[test]
fn a_check_reads_one_state_while_others_write() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = whole(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    let find = ValueSearch::Text("O".into());
    let mut edits = 0;
    let mut hear = |_: ProgressStep<'_>| {
        edits += 1;
        let with = format!("O{edits}");
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let done = other.replace_values(&find, &with, &TierSelection::default(), false, progress);
        assert!(done.is_ok_and(|done| done.changed > 0));
        if edits == 3 {
            other.recombine_recipe("BOL1 | reverse", "LOB").ok();
        }
        std::ops::ControlFlow::Continue(())
    };
    let report = corpus
        .check_corpus(false, &mut ProgressReceiver::new(&mut hear))
        .expect("checked");
    assert!(edits > 3, "{edits}");
    assert_eq!(report.faults, []);
}

#[test]
fn annotations_that_hang_below_themselves_end_no_loop() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = whole(folder.path());
    let path = folder.path().join("damaged.chereme");
    for tiers in 1..=4 {
        std::fs::copy(&whole, &path).expect("copied");
        let foreign = Connection::open(&path).expect("opened");
        // The first tiers hang below each other in a circle, and so do their first annotations.
        let circle = format!(
            "PRAGMA ignore_check_constraints = ON;
             CREATE TEMP TABLE ring AS SELECT id FROM tier ORDER BY id LIMIT {tiers};
             UPDATE tier SET stereotype = 'Included_In', parent_id = coalesce(
                 (SELECT min(id) FROM ring WHERE ring.id > tier.id), (SELECT min(id) FROM ring))
             WHERE id IN (SELECT id FROM ring);
             UPDATE annotation SET parent_id = (SELECT min(id) FROM annotation AS other
                 WHERE other.tier_id = (SELECT parent_id FROM tier WHERE id = annotation.tier_id))
             WHERE tier_id IN (SELECT id FROM ring)"
        );
        foreign.execute_batch(&circle).expect("damaged");
        drop(foreign);
        let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        // They may be refused, and must end.
        let find = ValueSearch::Text("BOL".into());
        drop(corpus.replace_values(&find, "CAT", &TierSelection::default(), false, progress));
        drop(corpus.load_recording_contents(1));
        drop(corpus.search_tokens("overlaps gloss=BOL", &SearchOptions::default()));
        corpus.accept_rows().expect("accepted");
        for format in ["eaf", "textgrid", "csv"] {
            let what = ExportWhat::Address("recording:1".parse().expect("named"));
            drop(corpus.export_stream(&what, format, &mut Vec::new(), progress));
        }
        let trial = crate::DeleteOptions {
            dry_run: true,
            ..crate::DeleteOptions::default()
        };
        drop(corpus.delete_objects(&["recording:1".parse().expect("named")], trial, progress));
        let report = checked(&mut Corpus::open_corpus(&path, "A").expect("opened"), false);
        let is_cycle = |fault: &CorpusFault| fault.message.contains("hangs below itself");
        assert!(
            report.questions.iter().any(is_cycle),
            "{tiers}: {:#?}",
            report.questions
        );
    }
}

#[test]
fn pictures_and_films_of_damaged_rows_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = whole(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let foreign = Connection::open(&path).expect("opened");
    let names = ["token:1", "recording:1"].map(|it| it.parse::<crate::CorpusAddress>().expect("named"));
    let small = crate::PictureOptions {
        frames: 2,
        height: Some(48),
        captions: true,
        ..crate::PictureOptions::default()
    };
    for damage in [
        "UPDATE track SET metres_per_unit = metres_per_unit * 1.5 WHERE kind = 'skeleton'",
        "UPDATE sign SET gloss = 'CAT'",
    ] {
        foreign.execute_batch(damage).expect(damage);
        for (name, ending) in names.iter().zip(["png", "gif"]) {
            let to = folder.path().join(format!("damaged.{ending}"));
            let drawn = corpus.draw_movement_file(name, &to, &small, progress);
            assert!(matches!(drawn, Err(CorpusError::Damaged { .. })), "{damage}: {drawn:?}");
            assert!(!to.exists(), "{damage}");
        }
        corpus.accept_rows().expect("accepted");
        let to = folder.path().join("accepted.png");
        let drawn = corpus.draw_movement_file(&names[0], &to, &small, progress);
        assert!(drawn.is_ok() && std::fs::remove_file(&to).is_ok(), "{drawn:?}");
    }
}
