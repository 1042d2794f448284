//! Tests that damaged rows are named, and that the rest of the file is checked all the same.

use super::*;
use crate::{ImportOptions, unheard, unpack_starter};

/// Returns the file of a corpus with one recording that has movement, tiers and tokens.
fn whole(folder: &std::path::Path) -> std::path::PathBuf {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let is_wanted = |path: &std::path::PathBuf| path.file_stem().is_some_and(|stem| stem == "bol");
    let files: Vec<_> = files.into_iter().filter(is_wanted).collect();
    let path = folder.join("whole.chereme");
    let mut corpus = Corpus::create(&path, "A").expect("made");
    let mut hear = unheard;
    corpus
        .import(
            &files,
            &ImportOptions::default(),
            &mut Progress::new(&mut hear),
        )
        .expect("imported");
    path
}

#[test]
fn every_damaged_row_is_named_and_the_check_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = whole(folder.path());
    let path = folder.path().join("damaged.chereme");
    let no_frame_time = (
        "track 1 of recording:1",
        "the stored frame time is no number",
    );
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
            let mut corpus = Corpus::open(&path, "A").expect("opened");
            let mut hear = unheard;
            let report = corpus
                .check(mend, &mut Progress::new(&mut hear))
                .expect(damage);
            assert!(!report.ok, "{damage}");
            for (place, text) in wanted.iter().chain([&no_frame_time]) {
                let is_wanted = |it: &&Fault| it.place == *place && it.message.contains(text);
                let found = report.faults.iter().filter(is_wanted).count();
                assert_eq!(found, 1, "{damage}: {place}: {text}: {:#?}", report.faults);
            }
            let rows = report
                .faults
                .iter()
                .filter(|it| it.place.starts_with("row "));
            let rows_wanted = wanted.iter().filter(|it| it.0.starts_with("row "));
            assert_eq!(rows.count(), rows_wanted.count(), "{damage}");
            for what in ["blocks", "tracks", "inventories", "skeletons"] {
                assert!(report.checked.contains_key(what), "{damage}: {what}");
            }
        }
    }
}
