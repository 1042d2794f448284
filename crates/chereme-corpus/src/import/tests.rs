//! Tests of the import of annotation files.

mod again;
mod captured;
mod changes;
mod film;
mod foreign;
mod joining;
mod lexicon;
mod lexicon_again;
mod lexicon_whose;
mod points;
mod reading;
mod renamed;
#[cfg(target_os = "linux")]
mod unusual;

use std::path::{Path, PathBuf};

use super::*;
use crate::export::{ExportOptions, ExportWhat};
use crate::progress::{ProgressStep, ignore_progress_step};
use crate::{ListFilter, ListKind, SearchOptions};

/// A BVH file of one joint and two frames, 0.2 s long.
const MOVEMENT: &str = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n\
     End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0\n0 0 1\n";

/// Returns an annotation file of root tiers with one annotation each: tier, start and end in ms, value.
fn eaf(tiers: &[(&str, i64, i64, &str)]) -> String {
    let (mut slots, mut body) = (String::new(), String::new());
    for (at, (tier, start, end, value)) in tiers.iter().enumerate() {
        slots += &format!(
            "<TIME_SLOT TIME_SLOT_ID=\"s{at}\" TIME_VALUE=\"{start}\"/><TIME_SLOT TIME_SLOT_ID=\"e{at}\" TIME_VALUE=\"{end}\"/>"
        );
        body += &format!(
            "<TIER TIER_ID=\"{tier}\" LINGUISTIC_TYPE_REF=\"t\"><ANNOTATION><ALIGNABLE_ANNOTATION \
             ANNOTATION_ID=\"a{at}\" TIME_SLOT_REF1=\"s{at}\" TIME_SLOT_REF2=\"e{at}\"><ANNOTATION_VALUE>{value}\
             </ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>"
        );
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><ANNOTATION_DOCUMENT AUTHOR=\"\" \
         DATE=\"2024-01-01T00:00:00Z\" FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" \
         TIME_UNITS=\"milliseconds\"/><TIME_ORDER>{slots}</TIME_ORDER>{body}\
         <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"t\" TIME_ALIGNABLE=\"true\"/></ANNOTATION_DOCUMENT>"
    )
}

struct Desk {
    folder: tempfile::TempDir,
}

impl Desk {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        Self { folder }
    }

    fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        fs::write(&path, text).expect("written");
        path
    }

    fn corpus(&self, name: &str) -> Corpus {
        Corpus::create_corpus(&self.folder.path().join(name), "A").expect("made")
    }
}

fn import(corpus: &mut Corpus, file: &Path, mapping: &str) -> FileReport {
    let options = ImportOptions {
        mapping: TierMapping::from_json(mapping).expect("a mapping"),
        ..ImportOptions::default()
    };
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(&[file.to_owned()], &options, &mut ProgressReceiver::new(&mut hear));
    report.expect("imported").files.remove(0)
}

fn assert_whole(corpus: &mut Corpus) {
    let mut hear = ignore_progress_step;
    let report = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut hear));
    let report = report.expect("checked");
    assert_eq!(report.all_findings().next(), None);
}

/// Returns role and hand of each tier, by recording and position.
fn roles(corpus: &Corpus) -> Vec<String> {
    let recordings = recordings_of(corpus);
    let tiers = recordings
        .into_iter()
        .flat_map(|id| crate::db::stored_tiers::load_tier_rows(corpus.store.read_connection(), id).expect("tiers"));
    tiers
        .map(|row| {
            let hand = row.hand.map_or("", crate::AnnotatedHands::annotated_hands_name);
            format!("{}: {hand} {}", row.name, row.role.role_name())
        })
        .collect()
}

fn recordings_of(corpus: &Corpus) -> Vec<i64> {
    let all = crate::db::stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("recordings");
    all.iter().map(|row| row.id).collect()
}

/// Returns tiers as EAF: the first with times, the others one to one below it.
fn eaf_of_children(first: (&str, &[&str]), children: &[(&str, &[&str])]) -> String {
    let times: Vec<_> = (0_i64..)
        .map(|at| (at * 1000, at * 1000 + 500))
        .take(first.1.len())
        .collect();
    let (slots, mut body) = times.iter().enumerate().fold((String::new(), String::new()), |(slots, body), (at, time)| {
        let slot = |name: &str, time: i64| format!("<TIME_SLOT TIME_SLOT_ID=\"{name}{at}\" TIME_VALUE=\"{time}\"/>");
        let value = first.1[at];
        let annotation = format!(
            "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"p{at}\" TIME_SLOT_REF1=\"s{at}\" TIME_SLOT_REF2=\"e{at}\">\
             <ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"
        );
        (slots + &slot("s", time.0) + &slot("e", time.1), body + &annotation)
    });
    body = format!("<TIER TIER_ID=\"{}\" LINGUISTIC_TYPE_REF=\"t\">{body}</TIER>", first.0);
    for (place, (tier, values)) in children.iter().enumerate() {
        body += &format!(
            "<TIER TIER_ID=\"{tier}\" PARENT_REF=\"{}\" LINGUISTIC_TYPE_REF=\"one\">",
            first.0
        );
        for (at, value) in values.iter().enumerate() {
            body += &format!(
                "<ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"c{place}{at}\" ANNOTATION_REF=\"p{at}\">\
                 <ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>"
            );
        }
        body += "</TIER>";
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><ANNOTATION_DOCUMENT AUTHOR=\"\" \
         DATE=\"2024-01-01T00:00:00Z\" FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" \
         TIME_UNITS=\"milliseconds\"/><TIME_ORDER>{slots}</TIME_ORDER>{body}\
         <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"t\" TIME_ALIGNABLE=\"true\"/>\
         <LINGUISTIC_TYPE CONSTRAINTS=\"Symbolic_Association\" LINGUISTIC_TYPE_ID=\"one\" TIME_ALIGNABLE=\"false\"/>\
         <CONSTRAINT STEREOTYPE=\"Symbolic_Association\"/></ANNOTATION_DOCUMENT>"
    )
}

#[test]
fn roles_that_no_name_states_are_asked_for_and_second_glosses_are_no_tokens() {
    let desk = Desk::new();
    let take = desk.file(
        "one.eaf",
        &eaf_of_children(
            ("Gloss-dom", &["CAT", "DOG"]),
            &[
                ("MG-dom", &["B", "S"]),
                ("MG-weak", &["see below", "S"]),
                ("Sign-dom", &["CAT1", "DOG1"]),
            ],
        ),
    );
    let mut corpus = desk.corpus("a.chereme");
    let report = import(&mut corpus, &take, "{}");
    let wanted = [
        "Gloss-dom: dominant gloss",
        "MG-dom: dominant configuration",
        "MG-weak: weak free",
        "Sign-dom: dominant gloss",
    ];
    let mut roles_now = roles(&corpus);
    roles_now.sort();
    assert_eq!(roles_now, wanted);
    let glosses = corpus
        .search_tokens("gloss=*", &crate::SearchOptions::default())
        .expect("found");
    assert_eq!(glosses.total, 2, "Sign-dom says the same signs again");
    let found = corpus.search_tokens("dominant.configuration=B", &crate::SearchOptions::default());
    assert_eq!(found.expect("found").total, 1);
    let asked = report
        .findings
        .iter()
        .find(|it| it.message.contains("do not state their roles"));
    let asked = asked.expect("a finding");
    assert!(
        asked
            .message
            .ends_with("guesses: \"MG-dom\" (dominant.configuration), \"MG-weak\" (free)"),
        "{asked:?}"
    );
    let remedy = asked.remedy.as_ref().expect("a remedy").remedy_text();
    let stated = r#"{"tiers":{"MG-dom":"dominant.configuration","MG-weak":"free"}}"#;
    assert!(remedy.ends_with(stated), "{remedy}");
    // The mapping that is proposed states the roles, so that nothing is asked any more.
    let mut corpus = desk.corpus("b.chereme");
    let report = import(&mut corpus, &take, stated);
    assert_eq!(report.findings, []);
    assert_whole(&mut corpus);
}

#[test]
fn roles_given_to_oddly_named_tiers_are_remembered() {
    let desk = Desk::new();
    let odd = [("QX1", 0, 500, "BOL"), ("QX2", 0, 500, "S"), ("Gloss", 0, 500, "x")];
    let take = desk.file("one.eaf", &eaf(&odd));
    let mapping = r#"{"tiers": {"QX1": "right.gloss", "QX2": "left.configuration", "Gloss": "comment"}}"#;
    let mut corpus = desk.corpus("a.chereme");
    import(&mut corpus, &take, mapping);
    let known = ["QX1: right gloss", "QX2: left configuration", "Gloss:  comment"];
    assert_eq!(roles(&corpus), known);

    let out = desk.folder.path().join("out.eaf");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let options = ExportOptions::default();
    corpus
        .export_corpus(&ExportWhat::All, &out, &options, progress)
        .expect("exported");
    let mut elsewhere = desk.corpus("b.chereme");
    import(&mut elsewhere, &out, "{}");
    assert_eq!(roles(&elsewhere), known, "the file says so itself");
    let mut otherwise = desk.corpus("c.chereme");
    import(&mut otherwise, &out, r#"{"tiers": {"QX*": "free"}}"#);
    assert_eq!(
        roles(&otherwise),
        ["QX1:  free", "QX2:  free", "Gloss:  comment"],
        "the caller knows better"
    );

    let next = desk.file("two.eaf", &eaf(&[("QX2", 0, 400, "S"), ("QX3", 0, 400, "S")]));
    let report = import(&mut corpus, &next, "{}");
    assert_eq!(
        roles(&corpus)[3..],
        ["QX2: left configuration", "QX3:  free"],
        "names known from another recording: {:?}",
        report.understood
    );
}

#[test]
fn a_malformed_property_is_reported() {
    let desk = Desk::new();
    let text = eaf(&[("Gloss", 0, 500, "BOL")]).replace(
        "TIME_UNITS=\"milliseconds\"/>",
        "TIME_UNITS=\"milliseconds\"><PROPERTY NAME=\"chereme.tiers\">{\"Gloss\": 3</PROPERTY></HEADER>",
    );
    let mut corpus = desk.corpus("a.chereme");
    let report = import(&mut corpus, &desk.file("one.eaf", &text), "{}");
    assert!(report.findings.iter().any(|it| it.message.contains("chereme.tiers")));
    assert_eq!(roles(&corpus), ["Gloss:  gloss"]);
}

#[test]
fn annotations_long_after_the_movement_are_reported() {
    let desk = Desk::new();
    for (name, end, reported) in [("short", 1100, false), ("long", 1300, true)] {
        let mut corpus = desk.corpus(&format!("{name}.chereme"));
        import(&mut corpus, &desk.file(&format!("{name}.bvh"), MOVEMENT), "{}");
        let file = desk.file(&format!("{name}.eaf"), &eaf(&[("Gloss", 0, end, "BOL")]));
        let report = import(&mut corpus, &file, "{}");
        let warned = report
            .findings
            .iter()
            .any(|it| it.message.contains("annotations end at"));
        assert_eq!(warned, reported, "{name}: {:?}", report.findings);
    }
}

#[test]
fn movement_phases_divide_time_and_are_no_values_of_a_token() {
    let desk = Desk::new();
    let text = eaf(&[
        ("Gloss", 0, 500, "BOL"),
        ("Handshape RH", 0, 500, "S"),
        ("Phase RH", 0, 500, "stroke"),
    ]);
    let mut corpus = desk.corpus("a.chereme");
    import(&mut corpus, &desk.file("one.eaf", &text), "{}");
    assert_eq!(roles(&corpus)[2], "Phase RH: right movement.phase");
    let options = SearchOptions::default();
    let answer = corpus.search_tokens("gloss=BOL", &options).expect("answered");
    let fields: Vec<&String> = answer.hits[0].components.keys().collect();
    assert_eq!(fields, ["right.configuration"]);
    let beside = corpus.search_tokens("equals right.movement.phase=stroke", &options);
    assert_eq!(beside.expect("answered").total, 1);
    let alone = corpus.search_tokens("movement.phase=stroke", &options);
    assert!(alone.is_err_and(|error| {
        error
            .error_remedy()
            .is_some_and(|it| it.remedy_text().contains("overlaps"))
    }));
    let all = corpus.list_rows(ListKind::Annotations, &ListFilter::default());
    assert_eq!(all.expect("listed").total, 3);
}

/// Returns the annotations: tier, start in ms, value.
fn said(corpus: &Corpus) -> Vec<String> {
    let connection = corpus.store.read_connection();
    let tiers = recordings_of(corpus)
        .into_iter()
        .flat_map(|id| crate::db::stored_tiers::load_tier_rows(connection, id).expect("tiers"));
    tiers
        .flat_map(|tier| {
            let rows = crate::db::stored_tiers::load_tier_annotation_rows(connection, tier.id).expect("annotations");
            rows.into_iter()
                .map(move |row| format!("{} {} {}", tier.name, row.start_us / 1000, row.value))
        })
        .collect()
}

#[test]
fn an_edited_file_updates_its_annotations_and_one_undo_takes_it_back() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("a.chereme");
    let tiers = [
        ("Gloss", 0, 500, "BOL"),
        ("Notes", 0, 500, "fine"),
        ("Mood", 0, 500, "glad"),
    ];
    import(&mut corpus, &desk.file("one.eaf", &eaf(&tiers)), "{}");
    let before = said(&corpus);

    let edited = eaf(&[
        ("Gloss", 0, 500, "BALLE"),
        ("Notes", 100, 500, "fine"),
        ("Mood", 0, 500, "glad"),
    ]);
    let start = edited.find("<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a2\"");
    let start = start.expect("the third");
    let end = start + edited[start..].find("</TIER>").expect("its end");
    let edited = format!("{}{}", &edited[..start], &edited[end..]);
    let file = desk.file("one.eaf", &edited);
    let options = ImportOptions {
        dry_run: true,
        ..ImportOptions::default()
    };
    let mut hear = ignore_progress_step;
    let dry = corpus
        .import_paths(
            std::slice::from_ref(&file),
            &options,
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("looked at");
    assert_eq!(dry.files[0].status, FileStatus::Updated);
    assert_eq!(said(&corpus), before, "a dry run writes nothing");

    let report = import(&mut corpus, &file, "{}");
    assert_eq!(report.findings, dry.files[0].findings);
    let messages: Vec<&str> = report.findings.iter().map(|it| it.message.as_str()).collect();
    assert!(
        messages[0].contains("2 changed, 0 added, 1 removed, 0 as they were"),
        "{messages:?}"
    );
    assert!(
        messages.iter().any(|line| line.contains("\"BOL\" became \"BALLE\"")),
        "{messages:?}"
    );
    assert!(
        messages.iter().any(|line| line.contains("\"glad\" removed")),
        "{messages:?}"
    );
    assert_eq!(said(&corpus), ["Gloss 0 BALLE", "Notes 100 fine"]);
    let hits = |corpus: &mut Corpus, gloss: &str| {
        let found = corpus.search_tokens(&format!("gloss={gloss}"), &SearchOptions::default());
        found.expect("searched").total
    };
    assert_eq!((hits(&mut corpus, "BALLE"), hits(&mut corpus, "BOL")), (1, 0));
    assert_eq!(import(&mut corpus, &file, "{}").status, FileStatus::Unchanged);

    corpus.undo_operation().expect("taken back");
    assert_eq!(said(&corpus), before);
    assert_eq!((hits(&mut corpus, "BALLE"), hits(&mut corpus, "BOL")), (0, 1));
}

#[test]
fn own_annotations_are_kept_and_a_file_of_another_take_is_refused() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("a.chereme");
    let first = eaf(&[("Gloss", 0, 500, "BOL")]);
    import(&mut corpus, &desk.file("one.eaf", &first), "{}");
    let tier = crate::db::stored_tiers::load_tier_rows(corpus.store.read_connection(), 1).expect("tiers")[0].id;
    let added = crate::db::stored_tiers::AnnotationRow {
        tier_id: tier,
        start_us: 700_000,
        end_us: 900_000,
        state: crate::ValueState::Value,
        value: "CHAT".to_owned(),
        origin: crate::AnnotationOrigin::Human,
        ..Default::default()
    };
    corpus
        .store
        .named_operation("annotate", |connection| {
            crate::db::stored_tiers::insert_annotation(connection, &added)?;
            Ok(((), String::new()))
        })
        .expect("added");
    let file = desk.file("one.eaf", &first.replace("BOL", "BALLE"));
    let report = import(&mut corpus, &file, "{}");
    assert_eq!(said(&corpus), ["Gloss 0 BALLE", "Gloss 700 CHAT"]);
    assert!(
        report
            .findings
            .iter()
            .any(|it| { it.message.contains("1 annotation that the file does not have is kept") })
    );

    let other = first.replace("\"a0\"", "\"z9\"");
    let report = import(&mut corpus, &desk.file("one.eaf", &other), "{}");
    assert_eq!(report.status, FileStatus::Refused);
}

#[test]
fn a_table_imported_again_keeps_the_spellings_of_its_values() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let first = desk.file("lex.tsv", "gloss\tHandshape\nA\tB-spread\nC\tnew one\n");
    import(&mut corpus, &first, "{}");
    let second = desk.file(
        "lex.tsv",
        "gloss\tHandshape\nA\tb-SPREAD\nC\tnew one\nD\tNew One\nE\tfifth\n",
    );
    import(&mut corpus, &second, "{}");
    assert_whole(&mut corpus);
    let options = SearchOptions::default();
    let mut found = |query: &str| corpus.search_tokens(query, &options).expect(query).total;
    assert_eq!(found("configuration=b-spread"), 1);
    assert_eq!(found("configuration=\"new one\""), 2);
    assert_eq!(found("configuration=*"), 4);
}

#[test]
fn an_inventory_that_contradicts_the_corpus_is_refused() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let inventory = |id: &str| {
        format!(
            r#"{{"id": "mine", "component": "placement", "version": 1, "names": {{"en": "mine"}},
               "values": [{{"id": "{id}", "names": {{"en": "the cap"}}}}]}}"#
        )
    };
    import(&mut corpus, &desk.file("one.json", &inventory("cap")), "{}");
    let again = desk.file("two.json", &inventory("hat"));
    let report = import(&mut corpus, &again, "{}");
    assert_eq!(report.status, FileStatus::Refused);
    let message = &report.findings[0].message;
    assert!(message.contains("the cap") && message.contains("\"cap\""), "{message}");
    assert_whole(&mut corpus);
}

#[test]
fn signs_in_json_are_a_lexicon() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let json = desk.file(
        "signs.json",
        r#"{"PET": {"hamnosys": "hamflathand hamextfingeru hampalml hamhead hamtouch"}}"#,
    );
    let report = import(&mut corpus, &json, "{}");
    assert_eq!(report.status, FileStatus::Imported);
    let hits = corpus
        .search_tokens("placement=head", &SearchOptions::default())
        .expect("a query");
    assert_eq!(hits.total, 1);
}

#[test]
fn a_body_that_faces_away_from_its_toes_is_reported() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let whole = chereme_data::starter_text("bol.bvh");
    let (left, right) = ("Left", "Right");
    let exchanged = whole
        .replace(left, "Other")
        .replace(right, left)
        .replace("Other", right);
    for (text, reported) in [(whole, false), (&exchanged, true)] {
        let report = import(&mut corpus, &desk.file("take.bvh", text), "{}");
        let doubt = |it: &ReportFinding| it.message.contains("the toes point away");
        assert_eq!(report.findings.iter().any(doubt), reported, "{:?}", report.findings);
    }
}
