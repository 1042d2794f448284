//! Notated signs in a corpus: imported, found, listed, exported, and imported again.

use std::fs;
use std::path::PathBuf;

use chereme_corpus::{
    Corpus, ExportOptions, ExportWhat, FileStatus, ImportOptions, ImportReport, ListFilter, ListKind, NotationStaging,
    PictureOptions, ProgressReceiver, SearchOptions, ignore_progress_step, read_notation,
};
use chereme_motion::BodySide;
use chereme_sign::hamnosys::{MotionKind, from_names};

const TWO: &str = r#"<sigml>
<hamgestural_sign gloss="MERCI">
  <sign_nonmanual><facialexpr_tier><eye_brows movement="RB"/></facialexpr_tier></sign_nonmanual>
  <sign_manual both_hands="true" lr_symm="true">
    <handconfig handshape="flat"/><handconfig extfidir="uuo"/><handconfig palmor="u" second_palmor="ul"/>
    <location_bodyarm location="chin" contact="touch"/>
    <directedmotion direction="o" curve="u"/>
  </sign_manual>
</hamgestural_sign>
<hns_sign gloss="OUI"><hamnosys_manual>
  <hamfist/><hamthumbacrossmod/><hamextfingero/><hampalmd/><hamnodding/>
</hamnosys_manual></hns_sign>
</sigml>
"#;

struct Desk {
    folder: tempfile::TempDir,
    corpus: Corpus,
}

impl Desk {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        Self { folder, corpus }
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        fs::write(&path, text).expect("written");
        path
    }

    fn import(&mut self, name: &str, text: &str) -> ImportReport {
        let path = self.write(name, text);
        let options = ImportOptions::default();
        let mut progress = ignore_progress_step;
        let report = self
            .corpus
            .import_paths(&[path], &options, &mut ProgressReceiver::new(&mut progress))
            .expect("taken in");
        assert!(!report.has_refusals(), "{report:?}");
        report
    }

    fn glosses(&mut self, query: &str) -> Vec<String> {
        let answer = self.corpus.search_tokens(query, &SearchOptions::default());
        let hits = answer.expect(query).hits;
        hits.into_iter().map(|hit| hit.gloss).collect()
    }

    fn export(&self, what: &ExportWhat, name: &str) -> (Vec<u8>, Vec<String>) {
        let path = self.folder.path().join(name);
        let mut progress = ignore_progress_step;
        let report = self
            .corpus
            .export_corpus(
                what,
                &path,
                &ExportOptions {
                    force: true,
                    ..ExportOptions::default()
                },
                &mut ProgressReceiver::new(&mut progress),
            )
            .expect("written");
        (fs::read(path).expect("there"), report.notes)
    }

    fn check(&mut self) {
        let report = self
            .corpus
            .check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step));
        let report = report.expect("checked");
        assert_eq!(report.all_findings().next(), None);
    }

    fn notations(&self) -> u64 {
        self.corpus.load_corpus_info().expect("told").counts["notations"]
    }
}

#[test]
fn a_file_of_notation_becomes_signs_that_are_found_by_their_components() {
    let mut desk = Desk::new();
    let report = desk.import("two.sigml", TWO);
    assert_eq!(report.created["signs"], 2);
    assert_eq!(report.created["notations"], 2);
    let reported: Vec<_> = report.files[0]
        .findings
        .iter()
        .map(|finding| (finding.line, finding.message.as_str()))
        .collect();
    assert_eq!(
        reported,
        [
            (Some(5), "extfidir=\"uuo\" was read as \"uo\""),
            (
                Some(2),
                "MERCI: the components come near the notation, but leave out orientation.palm: half-way between two"
            ),
        ]
    );
    for (query, found) in [
        ("configuration=flat placement=chin", &["MERCI"][..]),
        ("weak.configuration=flat", &["MERCI"]),
        ("movement=arc movement.direction=out", &["MERCI"]),
        ("nonmanual.brows=raised", &["MERCI"]),
        ("movement=nodding", &["OUI"]),
        ("placement=neutral", &["OUI"]),
        ("origin=lexicon", &["MERCI", "OUI"]),
    ] {
        assert_eq!(desk.glosses(query), found, "{query}");
    }
    let thanks = desk
        .corpus
        .notation_at(&"MERCI".parse().expect("an address"))
        .expect("notated");
    assert_eq!(
        (thanks.system.as_str(), thanks.file.as_deref(), thanks.line),
        ("sigml", Some("two.sigml"), Some(2))
    );
    let motion = &thanks.document.sign.parts[0].actions[0].kind;
    assert!(matches!(motion, MotionKind::Directed(directed) if directed.curve.is_some()));
    assert!(!thanks.document.nonmanual.is_empty());
    for (name, count) in [("two.sigml", 2), ("two", 2), ("OUI", 1)] {
        let found = desk.corpus.notations_named(name).expect(name);
        assert_eq!(found.len(), count, "{name}");
    }
    assert!(desk.corpus.notations_named("three.sigml").is_err());
    let (outside, _) = read_notation(&desk.folder.path().join("two.sigml")).expect("read");
    assert_eq!(outside[0], thanks.document);
    let listed = desk
        .corpus
        .list_rows(ListKind::Signs, &ListFilter::default())
        .expect("listed");
    assert_eq!(listed.rows[0]["notation"]["document"]["gloss"], "MERCI");
    assert_eq!(
        listed.rows[1]["notation"]["text"]
            .as_str()
            .map(|text| text.chars().count()),
        Some(5)
    );
    desk.check();
}

#[test]
fn a_name_means_the_sign_if_a_file_with_several_signs_has_the_same_name() {
    let mut desk = Desk::new();
    desk.import("MERCI.sigml", TWO);
    for (name, count) in [("MERCI", 1), ("MERCI.sigml", 2), ("OUI", 1)] {
        let found = desk.corpus.notations_named(name).expect(name);
        assert_eq!(found.len(), count, "{name}");
    }
}

#[test]
fn notation_is_undone_and_done_again() {
    let mut desk = Desk::new();
    desk.import("two.sigml", TWO);
    desk.corpus.undo_operation().expect("taken back");
    assert_eq!(desk.notations(), 0);
    assert!(desk.glosses("configuration=flat").is_empty());
    desk.check();
    desk.corpus.redo_operation().expect("done again");
    assert_eq!(desk.notations(), 2);
    assert_eq!(desk.glosses("configuration=flat"), ["MERCI"]);
    desk.check();
}

#[test]
fn a_file_imported_again_updates_its_signs() {
    let mut desk = Desk::new();
    desk.import("two.sigml", TWO);
    let again = desk.import("two.sigml", TWO);
    assert_eq!(again.files[0].status, FileStatus::Unchanged);
    let changed = TWO.replace("chin", "forehead").replace("OUI", "NON");
    let report = desk.import("two.sigml", &changed);
    assert_eq!((report.created["signs"], report.created["tokens"]), (1, 1));
    let reported = report.files[0].findings.iter();
    let reported: Vec<_> = reported
        .filter(|finding| finding.message.contains("earlier file"))
        .collect();
    assert_eq!(reported.len(), 1, "OUI is no more in it");
    assert!(desk.glosses("placement=chin").is_empty());
    assert_eq!(desk.glosses("placement=forehead"), ["MERCI"]);
    assert_eq!(desk.notations(), 3);
    desk.import("other.sigml", &TWO.replace("chin", "nose"));
    let all = desk
        .corpus
        .list_rows(ListKind::Tokens, &ListFilter::default())
        .expect("listed");
    assert_eq!(all.total, 5, "the signs of another file are entries of their own");
    desk.check();
}

#[test]
fn notation_is_exported_in_each_of_its_forms() {
    let mut desk = Desk::new();
    desk.import("two.sigml", TWO);
    let (whole, notes) = desk.export(&ExportWhat::All, "all.sigml");
    assert!(notes.is_empty(), "{notes:?}");
    let (symbols, notes) = desk.export(&ExportWhat::All, "all.hsigml");
    assert!(notes.is_empty(), "{notes:?}");
    for (name, bytes) in [("whole.sigml", whole), ("symbols.sigml", symbols)] {
        let path = desk.folder.path().join(name);
        fs::write(&path, bytes).expect("written");
        let (signs, findings) = read_notation(&path).expect("we wrote it");
        assert!(findings.is_empty(), "{findings:?}");
        for sign in signs {
            let own = desk.corpus.notation_at(&sign.gloss.parse().expect("an address"));
            let own = own.expect("notated").document;
            assert_eq!((&sign.sign, &sign.nonmanual), (&own.sign, &own.nonmanual), "{name}");
        }
    }
    let (text, notes) = desk.export(&ExportWhat::All, "all.hns");
    assert_eq!(notes, ["left out of 1 sign, the first MERCI: what face and body do"]);
    let text = String::from_utf8(text).expect("text");
    let glosses: Vec<_> = text.lines().filter_map(|line| line.split('\t').next()).collect();
    assert_eq!(glosses, ["MERCI", "OUI"]);
    for name in ["all.hns", "all.txt"] {
        let mut other = Desk::new();
        let report = other.import(name, &text);
        assert_eq!(report.created["notations"], 2, "{name}");
        assert_eq!(other.glosses("placement=chin"), ["MERCI"], "{name}");
        let (again, _) = other.export(&ExportWhat::All, "again.hns");
        assert_eq!(again, text.as_bytes(), "{name}");
        let path = other.folder.path().join(name);
        let both = other
            .corpus
            .animate_notation(&[&path.to_string_lossy()], &NotationStaging::default(), None)
            .expect("both signs in a row");
        let one = other
            .corpus
            .animate_notation(&["MERCI"], &NotationStaging::default(), None)
            .expect("one");
        assert!(both.duration_us > one.duration_us);
    }
    let (table, _) = desk.export(&ExportWhat::All, "all.csv");
    let mut other = Desk::new();
    other.import("all.csv", &String::from_utf8(table).expect("text"));
    assert_eq!(other.notations(), 2);
    assert_eq!(other.glosses("configuration=flat placement=chin"), ["MERCI"]);
}

#[test]
fn symbols_are_exported_however_their_notation_is_stored() {
    let mut desk = Desk::new();
    let names = "hamflathand hamextfingeru hampalmd";
    let tabs = names.replace(' ', "\t");
    desk.import("own.hns", &format!("A\t{names}\nB\t{tabs}\n"));
    let made = desk
        .corpus
        .animate_notation(&[names], &NotationStaging::default(), Some("C"));
    made.expect("stored");
    let (symbols, notes) = desk.export(&ExportWhat::All, "all.hsigml");
    assert!(notes.is_empty(), "{notes:?}");
    let text = String::from_utf8(symbols).expect("text");
    for name in names.split(' ') {
        assert_eq!(text.matches(&format!("<{name}/>")).count(), 3, "{text}");
    }
}

#[test]
fn a_notation_is_drawn_symbol_by_symbol() {
    let mut desk = Desk::new();
    desk.import("two.sigml", TWO);
    let path = desk.folder.path().join("oui.svg");
    let address = "OUI".parse().expect("an address");
    let mut progress = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut progress);
    let options = PictureOptions::default();
    let picture = desk.corpus.draw_movement_file(&address, &path, &options, &mut progress);
    assert_eq!(picture.expect("drawn").frames, 5);
    let text = fs::read_to_string(&path).expect("there");
    assert!(text.contains("<title>hamnodding</title>"), "{text}");
    let again = desk.corpus.draw_movement_file(&address, &path, &options, &mut progress);
    assert!(again.is_err(), "it is not written over");
    let all = desk.folder.path().join("all.svg");
    let drawn = desk
        .corpus
        .draw_handshapes("hamnosys", None, BodySide::Right, &all, &options);
    assert_eq!(drawn.expect("drawn").frames, 209);
}

#[test]
fn files_are_recognised_as_notation_by_their_contents() {
    let mut desk = Desk::new();
    desk.write("notes.txt", "nothing of the kind");
    desk.write("other.xml", "<html/>");
    desk.write("two.xml", TWO);
    desk.write(
        "own.txt",
        "hamflathand hamextfingeru hampalml\nhamfist hamextfingeru hampalml",
    );
    let mut progress = ignore_progress_step;
    let report = desk
        .corpus
        .import_paths(
            &[desk.folder.path().to_path_buf()],
            &ImportOptions::default(),
            &mut ProgressReceiver::new(&mut progress),
        )
        .expect("taken in");
    assert_eq!(report.created["notations"], 4, "{report:?}");
    assert_eq!(desk.glosses("gloss:own"), ["own-1", "own-2"]);
}

#[test]
fn a_column_of_hamnosys_is_recognised_by_its_title_or_its_characters() {
    let yes = from_names(["hamfist", "hamextfingero", "hampalmd", "hamnodding"]).expect("names");
    let end = from_names(["hamparend"]).expect("a name");
    for title in ["HamNoSys", "x1"] {
        let mut desk = Desk::new();
        let table = format!("gloss\t{title}\tHandshape strong\nOUI\t{yes}\tS\nPEUT\t{yes}{end}\t\nRIEN\t\t\n");
        let report = desk.import("words.tsv", &table);
        assert_eq!(report.created["notations"], 2, "{title}");
        let odd = report.files[0].findings.iter().any(|finding| finding.line == Some(3));
        assert!(odd, "what cannot be read is told with its line: {report:?}");
        let oui = desk
            .corpus
            .notation_at(&"OUI".parse().expect("an address"))
            .expect("notated");
        assert_eq!(
            (oui.system.as_str(), oui.text.as_deref()),
            ("hamnosys", Some(yes.as_str()))
        );
        assert_eq!(
            desk.glosses("dominant.configuration=S"),
            ["OUI"],
            "the table's own coding counts"
        );
        assert_eq!(desk.glosses("movement=nodding"), ["OUI", "PEUT"]);
        assert!(desk.corpus.notation_at(&"RIEN".parse().expect("an address")).is_err());
        let again = desk.import("words.tsv", &table.replace("PEUT", "PEUX"));
        assert_eq!(again.created["notations"], 1);
        desk.check();
    }
}
