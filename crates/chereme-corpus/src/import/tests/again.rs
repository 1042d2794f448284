//! Tests of files that are imported again, files of one name, and files without content for a corpus.

use super::*;

/// Imports paths and returns the complete report.
pub(super) fn take(corpus: &mut Corpus, paths: &[PathBuf], options: &ImportOptions) -> ImportReport {
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(paths, options, &mut ProgressReceiver::new(&mut hear));
    report.expect("imported")
}

pub(super) fn choose(own_edits: OwnEdits) -> ImportOptions {
    ImportOptions {
        own_edits,
        ..ImportOptions::default()
    }
}

fn names(corpus: &Corpus) -> Vec<String> {
    let all = crate::db::stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("recordings");
    all.into_iter().map(|row| row.name).collect()
}

pub(super) fn has(findings: &[ReportFinding], what: &str) -> bool {
    findings.iter().any(|it| it.message.contains(what))
}

/// Changes the annotation with this value.
pub(super) fn edit(corpus: &mut Corpus, from: &str, to: Option<&str>) {
    use crate::db::stored_tiers;
    let done = corpus.store.named_operation("annotate", |connection| {
        let mut all = Vec::new();
        for recording in crate::db::stored_recordings::load_recording_rows(connection)? {
            for tier in stored_tiers::load_tier_rows(connection, recording.id)? {
                all.extend(stored_tiers::load_tier_annotation_rows(connection, tier.id)?);
            }
        }
        let mut row = all.into_iter().find(|row| row.value == from).expect("it is there");
        match to {
            Some(to) => {
                to.clone_into(&mut row.value);
                stored_tiers::update_annotation(connection, &row)?;
            }
            None => stored_tiers::delete_annotation(connection, row.id)?,
        }
        Ok(((), String::new()))
    });
    done.expect("edited");
}

/// Returns four free annotations of 0.5 s, one per tier.
fn four(values: [&str; 4]) -> String {
    let tiers: Vec<(String, &str)> = values
        .iter()
        .enumerate()
        .map(|(at, value)| (format!("T{at}"), *value))
        .collect();
    let rows: Vec<(&str, i64, i64, &str)> = tiers
        .iter()
        .map(|(tier, value)| (tier.as_str(), 0, 500, *value))
        .collect();
    eaf(&rows)
}

#[test]
fn files_of_one_name_in_two_folders_are_two_recordings() {
    let desk = Desk::new();
    for (folder, value) in [("A", "CHAT"), ("B", "CHIEN")] {
        fs::create_dir(desk.folder.path().join(folder)).expect("made");
        desk.file(&format!("{folder}/x.eaf"), &eaf(&[("Gloss", 0, 500, value)]));
    }
    let folders = ["A", "B"].map(|folder| desk.folder.path().join(folder));
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, &folders, &ImportOptions::default());
    assert_eq!(names(&corpus), ["x", "x (B)"]);
    assert_eq!(said(&corpus), ["Gloss 0 CHAT", "Gloss 0 CHIEN"]);
    assert!(has(&report.files[1].findings, "A/x.eaf"), "{report:?}");
    assert!(has(&report.files[1].findings, "\"x (B)\""), "{report:?}");
    let again = take(&mut corpus, &folders, &ImportOptions::default());
    let unchanged = |it: &FileReport| it.status == FileStatus::Unchanged;
    assert!(again.files.iter().all(unchanged), "{again:?}");
    // Importing them one at a time has the same effect.
    let mut apart = desk.corpus("d.chereme");
    for folder in folders {
        take(&mut apart, &[folder], &ImportOptions::default());
    }
    assert_eq!(names(&apart), ["x", "x (B)"]);
}

#[test]
fn movement_and_annotations_of_one_name_in_two_folders_stay_together() {
    let desk = Desk::new();
    for (folder, value) in [("A", "CHAT"), ("B", "CHIEN")] {
        fs::create_dir(desk.folder.path().join(folder)).expect("made");
        desk.file(&format!("{folder}/Take.BVH"), MOVEMENT);
        desk.file(&format!("{folder}/TAKE.eaf"), &eaf(&[("Gloss", 0, 200, value)]));
    }
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &[desk.folder.path().join("A")], &ImportOptions::default());
    assert_eq!(names(&corpus), ["Take"], "whatever the case of their names");
    let mut corpus = desk.corpus("d.chereme");
    let both = ["A", "B"].map(|folder| desk.folder.path().join(folder));
    take(&mut corpus, &both, &ImportOptions::default());
    assert_eq!(names(&corpus), ["Take", "Take (B)"]);
    for id in recordings_of(&corpus) {
        let connection = corpus.store.read_connection();
        assert_eq!(
            crate::db::stored_tiers::load_tier_rows(connection, id)
                .expect("tiers")
                .len(),
            1
        );
        assert!(stored_recordings::body_track(connection, id).expect("read").is_some());
    }
}

#[test]
fn a_file_belongs_to_its_take_and_not_to_its_bytes() {
    let desk = Desk::new();
    let text = eaf(&[("Gloss", 0, 200, "BOL")]);
    for take in ["take1", "take2"] {
        desk.file(
            &format!("{take}.bvh"),
            &format!("{MOVEMENT}{}", if take == "take1" { "" } else { "\n" }),
        );
        desk.file(&format!("{take}.eaf"), &text);
    }
    let folder = [desk.folder.path().to_owned()];
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &folder, &ImportOptions::default());
    assert_eq!(names(&corpus), ["take1", "take2"]);
    assert_eq!(said(&corpus), ["Gloss 0 BOL", "Gloss 0 BOL"]);
    assert_whole(&mut corpus);
}

#[test]
fn signs_of_one_gloss_in_files_of_one_name_are_two() {
    let desk = Desk::new();
    for (folder, shape) in [("A", "finger2"), ("B", "flat")] {
        fs::create_dir(desk.folder.path().join(folder)).expect("made");
        desk.file(
            &format!("{folder}/x.sigml"),
            &format!(
                "<sigml><hamgestural_sign gloss=\"TWO\"><sign_manual><handconfig handshape=\"{shape}\"/>\
                 <handconfig extfidir=\"u\"/><handconfig palmor=\"u\"/></sign_manual></hamgestural_sign></sigml>"
            ),
        );
    }
    let mut corpus = desk.corpus("c.chereme");
    let all = [desk.folder.path().to_owned()];
    let report = take(&mut corpus, &all, &ImportOptions::default());
    let tokens = corpus.list_rows(ListKind::Tokens, &ListFilter::default());
    assert_eq!(tokens.expect("listed").total, 2, "{report:?}");
    assert!(
        report.files.iter().any(|it| has(&it.findings, "A/x.sigml")),
        "{report:?}"
    );
}

#[test]
fn own_edits_that_conflict_with_a_changed_file_are_asked_about() {
    let desk = Desk::new();
    let path = desk.file("one.eaf", &four(["A", "B", "C", "D"]));
    let paths = [path];
    let theirs = four(["A2", "B", "C2", "D"]);
    // The corpus changed B and C; the file changed A and C.
    for (choice, after) in [
        (OwnEdits::Ask, ["A", "mine B", "mine C", "D"]),
        (OwnEdits::Mine, ["A", "mine B", "mine C", "D"]),
        (OwnEdits::Theirs, ["A2", "B", "C2", "D"]),
        (OwnEdits::Merge, ["A2", "mine B", "mine C", "D"]),
    ] {
        let mut corpus = desk.corpus(&format!("{choice:?}.chereme"));
        desk.file("one.eaf", &four(["A", "B", "C", "D"]));
        take(&mut corpus, &paths, &ImportOptions::default());
        edit(&mut corpus, "B", Some("mine B"));
        edit(&mut corpus, "C", Some("mine C"));
        desk.file("one.eaf", &theirs);
        let report = take(&mut corpus, &paths, &choose(choice));
        let after: Vec<String> = (0..4).map(|at| format!("T{at} 0 {}", after[at])).collect();
        assert_eq!(said(&corpus), after, "{choice:?}: {report:?}");
        let file = &report.files[0];
        assert_eq!(report.has_refusals(), choice == OwnEdits::Ask);
        let edits: Vec<_> = file.edits.iter().map(|it| (it.tier.as_str(), it.outcome)).collect();
        match choice {
            OwnEdits::Ask => {
                assert_eq!(edits, [("T1", EditOutcome::Lost), ("T2", EditOutcome::Lost)]);
                assert!(
                    has(
                        &file.findings,
                        "tier \"T1\" at 0.000s: your \"mine B\" gives way to the file's \"B\""
                    ),
                    "{file:?}"
                );
                assert!(
                    file.findings[0]
                        .remedy
                        .as_ref()
                        .is_some_and(|it| it.remedy_text().contains("--merge"))
                );
            }
            OwnEdits::Mine => {
                assert!(has(&file.findings, "stays as it is"), "{file:?}");
                assert_eq!(file.status, FileStatus::Unchanged);
            }
            OwnEdits::Theirs => {
                assert!(has(&file.findings, "your \"mine C\" gives way to the file's \"C2\""));
                assert_eq!(report.changed.get("annotations"), Some(&3));
            }
            OwnEdits::Merge => {
                assert_eq!(edits, [("T1", EditOutcome::Kept), ("T2", EditOutcome::Conflict)]);
                assert!(
                    has(
                        &file.findings,
                        "both were changed: your \"mine C\" stays, the file says \"C2\""
                    ),
                    "{file:?}"
                );
            }
        }
        assert_whole(&mut corpus);
        if choice != OwnEdits::Ask {
            let again = take(&mut corpus, &paths, &ImportOptions::default());
            assert_eq!(again.files[0].status, FileStatus::Unchanged, "{choice:?}");
        }
    }
}

#[test]
fn own_removals_and_additions_are_merged_too() {
    let desk = Desk::new();
    let paths = [desk.file("one.eaf", &four(["A", "B", "C", "D"]))];
    let without = |text: String, id: &str| {
        let start = text
            .find(&format!("<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"{id}\""))
            .expect("there");
        let end = start + text[start..].find("</TIER>").expect("its end");
        format!("{}{}", &text[..start], &text[end..])
    };
    let theirs = without(four(["A", "B", "C2", "D"]), "a3");
    for (choice, after, edits) in [
        (OwnEdits::Merge, vec!["T0 0 A"], 2),
        (OwnEdits::Theirs, vec!["T0 0 A", "T1 0 B", "T2 0 C2"], 2),
    ] {
        let mut corpus = desk.corpus(&format!("{choice:?}.chereme"));
        desk.file("one.eaf", &four(["A", "B", "C", "D"]));
        take(&mut corpus, &paths, &ImportOptions::default());
        // B is removed only here; C is removed here and changed there; D is removed only there.
        edit(&mut corpus, "B", None);
        edit(&mut corpus, "C", None);
        desk.file("one.eaf", &theirs);
        let refused = take(&mut corpus, &paths, &ImportOptions::default());
        assert!(refused.has_refusals() && has(&refused.files[0].findings, "which you removed"));
        let report = take(&mut corpus, &paths, &choose(choice));
        assert_eq!(said(&corpus), after, "{report:?}");
        let wanted = if choice == OwnEdits::Merge { 1 } else { edits };
        assert_eq!(report.files[0].edits.len(), wanted, "{report:?}");
        assert_eq!(report.removed.get("annotations"), Some(&1));
        assert_whole(&mut corpus);
    }
}

#[test]
fn movement_of_another_folder_takes_annotations_only_by_name_and_if_they_fit() {
    for (end, joining, wanted, question) in [
        (200, FileJoining::Name, &["Take"][..], false),
        (200, FileJoining::Certain, &["Take", "Take (B)"][..], true),
        (200, FileJoining::None, &["Take", "Take (B)"][..], false),
        (9000, FileJoining::Name, &["Take", "Take (B)"][..], false),
    ] {
        let desk = Desk::new();
        for folder in ["A", "B"] {
            fs::create_dir(desk.folder.path().join(folder)).expect("made");
        }
        let tiers = desk.file("A/Take.eaf", &eaf(&[("Gloss", 0, end, "CHAT")]));
        let movement = desk.file("B/Take.bvh", MOVEMENT);
        let mut corpus = desk.corpus("c.chereme");
        let options = ImportOptions {
            joining,
            ..ImportOptions::default()
        };
        take(&mut corpus, &[tiers], &options);
        let report = take(&mut corpus, &[movement], &options);
        assert_eq!(names(&corpus), wanted, "annotations until {end} ms, {joining:?}");
        let asked = has(
            &report.files[0].findings,
            "the recording \"Take\" (A/Take.eaf) has its name in another folder",
        );
        assert_eq!(asked, question, "{report:?}");
    }
}

#[test]
fn a_gloss_that_a_colleague_removed_goes_with_its_token() {
    let desk = Desk::new();
    let whole = eaf(&[("Gloss", 0, 500, "BOL"), ("Handshape right", 0, 500, "S")]);
    let start = whole.find("<ANNOTATION><ALIGNABLE").expect("there");
    let end = start + whole[start..].find("</TIER>").expect("its end");
    let without = format!("{}{}", &whole[..start], &whole[end..]);
    for own_edits in [OwnEdits::Ask, OwnEdits::Merge, OwnEdits::Theirs] {
        let mut corpus = desk.corpus(&format!("{own_edits:?}.chereme"));
        let paths = [desk.file("one.eaf", &whole)];
        take(&mut corpus, &paths, &ImportOptions::default());
        assert_eq!(corpus.load_corpus_info().expect("info").counts["tokens"], 1);
        desk.file("one.eaf", &without);
        let report = take(&mut corpus, &paths, &choose(own_edits));
        assert_eq!(report.files[0].status, FileStatus::Updated, "{report:?}");
        assert_eq!(said(&corpus), ["Handshape right 0 S"]);
        let counts = corpus.load_corpus_info().expect("info").counts;
        assert_eq!((counts["tokens"], counts["signs"]), (0, 0));
        assert_whole(&mut corpus);
    }
}

#[test]
fn a_tier_that_was_renamed_in_the_corpus_is_updated_by_the_file() {
    let desk = Desk::new();
    let file = |value: &str| eaf(&[("Gloss", 0, 500, value), ("Notes", 0, 500, "fine")]);
    let paths = [desk.file("one.eaf", &file("BOL"))];
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &paths, &ImportOptions::default());
    let renamed = corpus.store.named_operation("change tier", |connection| {
        let all = crate::db::stored_tiers::load_tier_rows(connection, 1)?;
        for mut row in all.into_iter().filter(|row| row.name == "Gloss") {
            row.name = "GL".to_owned();
            crate::db::stored_tiers::update_tier(connection, &row)?;
        }
        Ok(((), String::new()))
    });
    renamed.expect("renamed");
    desk.file("one.eaf", &file("BALLE"));
    let report = take(&mut corpus, &paths, &ImportOptions::default());
    assert_eq!(said(&corpus), ["GL 0 BALLE", "Notes 0 fine"]);
    assert!(
        has(&report.files[0].findings, "\"Gloss\" of the file is \"GL\""),
        "{report:?}"
    );
    assert_eq!(report.changed.get("annotations"), Some(&1));
}

#[test]
fn a_colleagues_copy_from_another_folder_is_a_version_of_the_file() {
    let desk = Desk::new();
    let first = desk.file("one.eaf", &four(["A", "B", "C", "D"]));
    fs::create_dir(desk.folder.path().join("post")).expect("made");
    let other = desk.file("post/one.eaf", &four(["A", "B", "C", "D2"]));
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &[first], &ImportOptions::default());
    let report = take(&mut corpus, &[other], &ImportOptions::default());
    assert_eq!(report.files[0].status, FileStatus::Updated);
    assert!(
        has(&report.files[0].findings, "new version of one.eaf: 3 of 4"),
        "{report:?}"
    );
    assert_eq!(names(&corpus), ["one"]);
}

#[test]
fn a_mapping_changes_the_tiers_of_an_imported_file() {
    let desk = Desk::new();
    let tiers = [("QX1", 0, 500, "BOL"), ("QX2", 0, 500, "S"), ("QX3", 0, 500, "n/a")];
    let path = desk.file("one.eaf", &eaf(&tiers));
    let mut corpus = desk.corpus("c.chereme");
    import(&mut corpus, &path, "{}");
    let map = r#"{"tiers": {"QX1": "gloss", "QX2": "right.configuration", "nosuch": "gloss"}}"#;
    let options = ImportOptions {
        mapping: TierMapping::from_json(map).expect("a mapping"),
        ..ImportOptions::default()
    };
    let report = take(&mut corpus, std::slice::from_ref(&path), &options);
    assert_eq!(
        roles(&corpus),
        ["QX1:  gloss", "QX2: right configuration", "QX3:  free"]
    );
    assert_eq!(report.files[0].status, FileStatus::Updated);
    assert_eq!(report.changed.get("tiers"), Some(&2));
    assert!(
        has(
            &report.files[0].findings,
            "tier \"QX2\": right.configuration (before: free)"
        ),
        "{report:?}"
    );
    assert!(has(&report.findings, "\"nosuch\""), "{report:?}");
    let found = corpus.search_tokens("right.configuration=S", &SearchOptions::default());
    assert_eq!(found.expect("searched").total, 1);
    assert_whole(&mut corpus);
    let again = take(&mut corpus, &[path], &options);
    assert_eq!(again.files[0].status, FileStatus::Unchanged);
    corpus.undo_operation().expect("taken back");
    assert_eq!(roles(&corpus), ["QX1:  free", "QX2:  free", "QX3:  free"]);
}

#[test]
fn a_mapping_changes_the_columns_of_an_imported_table() {
    let desk = Desk::new();
    let path = desk.file("lex.tsv", "gloss\tqx\nA\tchin\nC\tchest\n");
    let mut corpus = desk.corpus("c.chereme");
    import(&mut corpus, &path, "{}");
    let map = r#"{"columns": {"qx": "placement"}}"#;
    let report = import(&mut corpus, &path, map);
    assert_eq!(report.status, FileStatus::Updated, "{report:?}");
    let found = corpus.search_tokens("placement=chin", &SearchOptions::default());
    assert_eq!(found.expect("searched").total, 1);
    let tokens = corpus.list_rows(ListKind::Tokens, &ListFilter::default());
    assert_eq!(tokens.expect("listed").total, 2);
}

/// Each reader whose newest file takes the place of earlier ones, with two versions of a file.
#[test]
fn a_file_that_is_again_its_earlier_version_is_a_new_version() {
    let sigml = |shape: &str| {
        format!(
            "<sigml><hamgestural_sign gloss=\"TWO\"><sign_manual><handconfig handshape=\"{shape}\"/>\
             <handconfig extfidir=\"u\"/><handconfig palmor=\"u\"/></sign_manual></hamgestural_sign></sigml>"
        )
    };
    let shapes = |name: &str| {
        format!(
            "{{\"id\":\"own\",\"component\":\"configuration\",\"version\":1,\"names\":{{\"en\":\"{name}\"}},\
             \"values\":[{{\"id\":\"B\"}}]}}"
        )
    };
    let words = |word: &str| {
        format!(
            "<CV_RESOURCE><LANGUAGE LANG_ID=\"und\" LANG_LABEL=\"undetermined\"/><CONTROLLED_VOCABULARY CV_ID=\"v\">\
             <CV_ENTRY_ML CVE_ID=\"c1\"><CVE_VALUE LANG_REF=\"und\">{word}</CVE_VALUE></CV_ENTRY_ML>\
             </CONTROLLED_VOCABULARY></CV_RESOURCE>"
        )
    };
    let hns = |shape: &str| format!("TWO\tham{shape} hamextfingeru hampalmd\n");
    for (name, [one, two]) in [
        (
            "a.csv",
            ["flat", "fist"].map(|it| format!("gloss,handshape\nTWO,{it}\n")),
        ),
        ("a.sigml", ["flat", "fist"].map(sigml)),
        ("a.hns", ["flathand", "fist"].map(hns)),
        ("a.json", ["Mine", "Ours"].map(shapes)),
        ("a.ecv", ["B", "S"].map(words)),
    ] {
        let desk = Desk::new();
        let mut corpus = desk.corpus("c.chereme");
        let mut status = |text: &str| import(&mut corpus, &desk.file(name, text), "{}").status;
        let first = status(&one);
        assert_eq!(first, FileStatus::Imported, "{name}");
        assert_ne!(status(&two), FileStatus::Unchanged, "{name}");
        assert_ne!(status(&one), FileStatus::Unchanged, "{name}");
        assert_eq!(status(&one), FileStatus::Unchanged, "{name}");
        let shown = |corpus: &mut Corpus, query: &str| {
            let answer = corpus.search_tokens(query, &SearchOptions::default());
            answer.map_or(0, |answer| answer.total)
        };
        if ["a.csv", "a.sigml", "a.hns"].contains(&name) {
            let shapes = ["flat", "fist"].map(|it| format!("configuration={it}"));
            let found = shapes.map(|query| shown(&mut corpus, &query));
            assert_eq!(found, [1, 0], "{name}");
        }
    }
}

#[test]
fn one_unreadable_file_does_not_block_the_others() {
    let desk = Desk::new();
    let good = desk.file("good.eaf", &eaf(&[("Gloss", 0, 500, "BOL")]));
    let paths = [
        desk.file("bad.eaf", "<ANNOTATION_DOCUMENT>"),
        desk.file("notes.docx", "x"),
        desk.folder.path().join("none.bvh"),
        good,
    ];
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, &paths, &ImportOptions::default());
    let refused = |it: &&FileReport| it.status == FileStatus::Refused;
    assert_eq!(report.files.iter().filter(refused).count(), 3, "{report:?}");
    assert!(report.has_refusals());
    assert_eq!(said(&corpus), ["Gloss 0 BOL"]);
}

#[test]
fn files_that_are_no_lexicon_create_nothing_and_are_named() {
    let desk = Desk::new();
    desk.file(
        "package.json",
        r#"{"name": "x", "version": "1.0.0", "scripts": {"start": "node a.js"}, "private": true, "license": "MIT"}"#,
    );
    desk.file("prices.csv", "item,price\nbread,2\n");
    desk.file("take.etf", &eaf(&[]));
    desk.file("take.pfsx", "<preferences/>");
    desk.file("more.pfsx", "<preferences/>");
    desk.file("good.eaf", &eaf(&[("Gloss", 0, 500, "BOL")]));
    let mut corpus = desk.corpus("c.chereme");
    let folder = [desk.folder.path().to_owned()];
    let report = take(&mut corpus, &folder, &ImportOptions::default());
    assert!(!report.has_refusals(), "{report:?}");
    let unread = report.unread_file_kinds();
    let kinds: Vec<(&str, usize)> = unread
        .iter()
        .map(|it| (it.ending.as_deref().unwrap_or_default(), it.files.len()))
        .collect();
    for kind in [("etf", 1), ("pfsx", 2), ("json", 1), ("csv", 1)] {
        assert!(kinds.contains(&kind), "{kind:?}: {unread:?}");
    }
    let tokens = corpus.list_rows(ListKind::Tokens, &ListFilter::default());
    assert_eq!(tokens.expect("listed").total, 1);
    let named = take(&mut corpus, &[folder[0].join("prices.csv")], &ImportOptions::default());
    assert!(named.has_refusals(), "a file that was named is refused");
}

#[test]
fn signs_without_a_gloss_get_the_name_of_their_file_with_a_finding() {
    let desk = Desk::new();
    let sign = "<hamgestural_sign><sign_manual><handconfig handshape=\"flat\"/></sign_manual></hamgestural_sign>";
    let one = desk.file("one.sigml", &format!("<sigml>{sign}</sigml>"));
    let two = desk.file(
        "two.xml",
        &format!("<collection>\n<sigml>{sign}</sigml>\n<sigml>{sign}</sigml></collection>"),
    );
    let mut corpus = desk.corpus("c.chereme");
    let first = import(&mut corpus, &one, "{}");
    assert!(has(&first.findings, "it is called \"one\""), "{first:?}");
    assert!(!has(&first.findings, "has no gloss;"), "{first:?}");
    let second = import(&mut corpus, &two, "{}");
    assert!(has(&second.findings, "\"two-2\" to \"two-3\""), "{second:?}");
    assert!(
        has(&second.findings, "<collection> was read as a wrapper"),
        "{second:?}"
    );
    let signs = corpus.list_rows(ListKind::Signs, &ListFilter::default());
    assert_eq!(signs.expect("listed").total, 3);
}

#[test]
fn stopping_an_import_of_any_kind_leaves_the_corpus_as_it_was() {
    use std::ops::ControlFlow;
    let desk = Desk::new();
    let many: Vec<(String, i64)> = (0..600).map(|at| (format!("G{}", at % 7), at * 10)).collect();
    let rows: Vec<(&str, i64, i64, &str)> = many
        .iter()
        .map(|(value, at)| ("Gloss", *at, at + 10, value.as_str()))
        .collect();
    let one_tier = eaf(&rows).replace("</TIER><TIER TIER_ID=\"Gloss\" LINGUISTIC_TYPE_REF=\"t\">", "");
    let lexicon: String = (0..600).map(|at| format!("S{at}\tflat\n")).collect();
    let signs: String = (0..300)
        .map(|at| format!("<hamgestural_sign gloss=\"N{at}\"><sign_manual><handconfig handshape=\"flat\"/></sign_manual></hamgestural_sign>\n"))
        .collect();
    for path in [
        desk.file("big.eaf", &one_tier),
        desk.file("big.tsv", &format!("gloss\tHandshape\n{lexicon}")),
        desk.file("big.sigml", &format!("<sigml>{signs}</sigml>")),
    ] {
        let mut corpus = desk.corpus(&format!("{}.chereme", path.file_name().expect("a name").display()));
        let mut steps = Vec::new();
        let mut hear = |step: ProgressStep<'_>| {
            steps.push(step.task.to_owned());
            ControlFlow::Continue(())
        };
        let options = ImportOptions::default();
        let all = [path.clone()];
        let done = corpus.import_paths(&all, &options, &mut ProgressReceiver::new(&mut hear));
        done.expect("imported");
        for task in ["history", "search index"] {
            assert!(steps.iter().any(|it| it == task), "{task}: {}", path.display());
        }
        corpus.undo_operation().expect("taken back");
        let before = corpus.operation_log(9).expect("log").len();
        // Wherever it is stopped, nothing is stored.
        for at in [0, steps.len() / 3, steps.len() / 2, steps.len() - 1] {
            let mut reported = 0;
            let mut hear = |_: ProgressStep<'_>| {
                reported += 1;
                if reported > at {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let stopped = corpus.import_paths(&all, &options, &mut ProgressReceiver::new(&mut hear));
            assert!(matches!(stopped, Err(CorpusError::Stopped)), "{at}: {stopped:?}");
            assert_eq!(corpus.operation_log(9).expect("log").len(), before);
            let tokens = corpus.list_rows(ListKind::Tokens, &ListFilter::default());
            assert_eq!(tokens.expect("listed").total, 0);
        }
        let mut stop = |_: ProgressStep<'_>| ControlFlow::Break(());
        let redone = corpus.redo_with_progress(&mut ProgressReceiver::new(&mut stop));
        assert!(matches!(redone, Err(CorpusError::Stopped)), "{redone:?}");
        assert_eq!(corpus.operation_log(9).expect("log").len(), before);
        assert_whole(&mut corpus);
    }
}

#[test]
fn an_exported_folder_is_imported_without_the_copies_of_its_tables() {
    let desk = Desk::new();
    let lexicon = desk.file("lexicon.csv", "gloss,handshape\nBOL,U\nCHAT,V\n");
    let movement = desk.file("take.bvh", MOVEMENT);
    let tiers = desk.file("take.eaf", &eaf(&[("Gloss", 0, 200, "BOL")]));
    let mut corpus = desk.corpus("c.chereme");
    take(&mut corpus, &[lexicon, movement, tiers], &ImportOptions::default());
    let all = desk.folder.path().join("all");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let exported = corpus.export_corpus(&ExportWhat::All, &all, &ExportOptions::default(), &mut progress);
    exported.expect("exported");
    let mut number = 0;
    let mut imported = |folder: PathBuf| {
        number += 1;
        let mut corpus = desk.corpus(&format!("{number}.chereme"));
        let report = take(&mut corpus, &[folder], &ImportOptions::default());
        let counts = [ListKind::Signs, ListKind::Tokens, ListKind::Recordings].map(|kind| {
            let list = corpus.list_rows(kind, &ListFilter::default());
            list.expect("listed").total
        });
        (counts, report)
    };
    let (alone, _) = imported(all.join("recordings"));
    let (whole, report) = imported(all.clone());
    assert_eq!(whole, alone, "{report:?}");
    assert!(!report.has_refusals(), "{report:?}");
    let unread = report.unread_file_kinds();
    let copies = unread.iter().find(|it| it.ending.as_deref() == Some("csv"));
    let copies = copies.expect("the tables");
    assert!(copies.files.len() > 10 && copies.why.contains("corpus.chereme"));
    let remedy = copies.remedy.as_ref().map(|it| it.remedy_text().to_owned());
    assert!(remedy.is_some_and(|it| it.contains("chereme merge")));
    // The same tables elsewhere are tables like others.
    fs::remove_file(all.join("SHA256SUMS")).expect("removed");
    let (whole, _) = imported(all);
    assert!(whole[0] > alone[0], "{whole:?}");
}
