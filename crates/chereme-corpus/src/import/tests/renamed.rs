//! Tests of files whose tiers were renamed, removed or moved since they were imported.

use super::*;

/// Returns a file of glosses from `start`, with words below them, a class below each word, and hands inside the gloss.
/// The tiers have the given names; one without a name is left out.
fn file([gloss, word, class, hand]: [&str; 4], start: i64) -> String {
    let (mut slots, mut tiers) = (String::new(), [const { String::new() }; 4]);
    let aligned = |id: &str, from: &str, to: &str, value: &str| {
        format!(
            "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"{id}\" TIME_SLOT_REF1=\"{from}\" \
             TIME_SLOT_REF2=\"{to}\"><ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"
        )
    };
    let below = |id: &str, above: &str, before: &str, value: &str| {
        format!(
            "<ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"{id}\" ANNOTATION_REF=\"{above}\"{before}>\
             <ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>"
        )
    };
    for at in 0..3 {
        let from = start + 1000 * at;
        for (name, time) in [("s", from), ("h", from + 200), ("i", from + 600), ("e", from + 900)] {
            slots += &format!("<TIME_SLOT TIME_SLOT_ID=\"{name}{at}\" TIME_VALUE=\"{time}\"/>");
        }
        let [g, w, v, c, h] = ["g", "w", "v", "c", "h"].map(|name| format!("{name}{at}"));
        let before = format!(" PREVIOUS_ANNOTATION=\"{w}\"");
        tiers[0] += &aligned(&g, &format!("s{at}"), &format!("e{at}"), &format!("G{at}"));
        tiers[1] += &below(&w, &g, "", &format!("W{at}"));
        tiers[1] += &below(&v, &g, &before, &format!("V{at}"));
        tiers[2] += &below(&c, &w, "", &format!("C{at}"));
        tiers[3] += &aligned(&h, &format!("h{at}"), &format!("i{at}"), &format!("H{at}"));
    }
    let names = [gloss, word, class, hand];
    let kinds = [("g", ""), ("w", gloss), ("c", word), ("h", gloss)];
    let mut body = String::new();
    for ((name, tier), (kind, parent)) in names.iter().zip(&tiers).zip(kinds) {
        let parent = match parent {
            "" => String::new(),
            parent => format!(" PARENT_REF=\"{parent}\""),
        };
        if !name.is_empty() {
            body += &format!("<TIER TIER_ID=\"{name}\" LINGUISTIC_TYPE_REF=\"{kind}\"{parent}>{tier}</TIER>");
        }
    }
    let types = [
        ("g", "true", ""),
        ("w", "false", " CONSTRAINTS=\"Symbolic_Subdivision\""),
        ("c", "false", " CONSTRAINTS=\"Symbolic_Association\""),
        ("h", "true", " CONSTRAINTS=\"Included_In\""),
    ];
    let types = types.map(|(name, aligned, rule)| {
        format!("<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"{name}\" TIME_ALIGNABLE=\"{aligned}\"{rule}/>")
    });
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><ANNOTATION_DOCUMENT AUTHOR=\"\" \
         DATE=\"2024-01-01T00:00:00Z\" FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" \
         TIME_UNITS=\"milliseconds\"/><TIME_ORDER>{slots}</TIME_ORDER>{body}{}</ANNOTATION_DOCUMENT>",
        types.concat()
    )
}

const NAMES: [&str; 4] = ["Gloss", "Word", "Class", "Hand"];

/// Returns each tier with the ids of its rows.
fn rows(corpus: &Corpus) -> Vec<(String, Vec<i64>)> {
    let connection = corpus.store.read_connection();
    let all = crate::db::stored_tiers::load_tier_rows(connection, 1).expect("tiers");
    all.into_iter()
        .map(|tier| {
            let rows = crate::db::stored_tiers::load_tier_annotation_rows(connection, tier.id).expect("annotations");
            (tier.name, rows.into_iter().map(|row| row.id).collect())
        })
        .collect()
}

#[test]
fn a_tier_that_the_file_renamed_keeps_its_annotations_and_edits() {
    for (names, own_edits) in [
        (["Gloss", "Words", "Class", "Hand"], OwnEdits::Ask),
        (["Gloss", "Words", "Class", "Hand"], OwnEdits::Merge),
        (["Gloss", "Word", "Wort", "Hand"], OwnEdits::Theirs),
        (["Glosses", "Word", "Class", "Hand"], OwnEdits::Ask),
        (["Glosses", "Words", "Wort", "Hands"], OwnEdits::Ask),
    ] {
        let desk = Desk::new();
        let paths = [desk.file("one.eaf", &file(NAMES, 0))];
        let mut corpus = desk.corpus("c.chereme");
        again::take(&mut corpus, &paths, &ImportOptions::default());
        let tokens = corpus.load_corpus_info().expect("info").counts["tokens"];
        let before = rows(&corpus);
        if own_edits == OwnEdits::Merge {
            again::edit(&mut corpus, "W1", Some("mine"));
        }
        desk.file("one.eaf", &file(names, 0));
        let report = again::take(&mut corpus, &paths, &again::choose(own_edits));
        assert_eq!(report.files[0].status, FileStatus::Updated, "{report:?}");
        let edits = &report.files[0].edits;
        let kept = edits.iter().filter(|it| it.outcome == EditOutcome::Kept).count();
        assert_eq!(kept, edits.len(), "{report:?}");
        let ids = |all: &[(String, Vec<i64>)]| all.iter().map(|it| it.1.clone()).collect::<Vec<_>>();
        let after = rows(&corpus);
        assert_eq!(ids(&after), ids(&before), "the rows are the same");
        let found: Vec<&str> = after.iter().map(|it| it.0.as_str()).collect();
        assert_eq!(found, names);
        let kept = said(&corpus).iter().any(|it| it.ends_with(" mine"));
        assert_eq!(kept, own_edits == OwnEdits::Merge, "{:?}", said(&corpus));
        assert_eq!(corpus.load_corpus_info().expect("info").counts["tokens"], tokens);
        assert!(
            again::has(&report.files[0].findings, "it has the new name here, too"),
            "{report:?}"
        );
        assert_whole(&mut corpus);
        let again = again::take(&mut corpus, &paths, &ImportOptions::default());
        assert_eq!(again.files[0].status, FileStatus::Unchanged);
    }
}

#[test]
fn a_tier_that_the_file_lost_moves_with_the_annotations_above() {
    for names in [
        ["Gloss", "Word", "Class", ""],
        ["Gloss", "Word", "", "Hand"],
        ["Gloss", "", "", ""],
    ] {
        let desk = Desk::new();
        let paths = [desk.file("one.eaf", &file(NAMES, 0))];
        let mut corpus = desk.corpus("c.chereme");
        again::take(&mut corpus, &paths, &ImportOptions::default());
        desk.file("one.eaf", &file(names, 100));
        let report = again::take(&mut corpus, &paths, &ImportOptions::default());
        assert_eq!(report.files[0].status, FileStatus::Updated, "{report:?}");
        let mut moved = desk.corpus("d.chereme");
        let other = [desk.file("two.eaf", &file(NAMES, 100))];
        again::take(&mut moved, &other, &ImportOptions::default());
        assert_eq!(said(&corpus), said(&moved));
        assert!(
            again::has(&report.files[0].findings, "moved with the annotations above them"),
            "{report:?}"
        );
        assert_whole(&mut corpus);
    }
}
