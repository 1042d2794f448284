//! Tests of exported Parquet tables: rows, columns, units, and identical bytes for the same corpus.

use std::fs::File as OnDisk;
use std::path::{Path, PathBuf};

use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::{Field, Row};

use crate::export::{ExportOptions, ExportWhat};
use crate::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step};

const EAF: &str = include_str!("../tests.eaf");
const BVH: &str = "HIERARCHY\nROOT Hips\n{\n OFFSET 0 1 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n JOINT Chest\n {\n  OFFSET 0 0.5 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n  End Site\n  {\n   OFFSET 0 0.2 0\n  }\n }\n}\nMOTION\nFrames: 3\nFrame Time: 0.04\n0 1 0 0 0 0 0 0 0\n0 1 0 90 0 0 0 0 0\n0 2 0 0 0 0 0 0 0\n";

struct Desk {
    folder: tempfile::TempDir,
    corpus: Corpus,
}

impl Desk {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let mut paths: Vec<PathBuf> = Vec::new();
        for (name, text) in files {
            let path = folder.path().join(name);
            std::fs::write(&path, text).expect("written");
            paths.push(path);
        }
        let path = folder.path().join("c.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        corpus
            .import_paths(&paths, &ImportOptions::default(), progress)
            .expect("imported");
        Self { folder, corpus }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Exports, and reads the rows back with an independent reader.
    fn rows(&self, what: &ExportWhat, name: &str) -> Vec<Row> {
        let path = self.path(name);
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        let options = ExportOptions {
            force: true,
            ..ExportOptions::default()
        };
        self.corpus
            .export_corpus(what, &path, &options, progress)
            .expect("exported");
        rows(&path)
    }
}

fn rows(path: &Path) -> Vec<Row> {
    let file = OnDisk::open(path).expect("a file");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let rows = reader.get_row_iter(None).expect("rows");
    rows.map(|row| row.expect("a row")).collect()
}

fn cell<'r>(row: &'r Row, name: &str) -> &'r Field {
    let mut columns = row.get_column_iter();
    columns.find(|it| it.0 == name).expect(name).1
}

fn text(row: &Row, name: &str) -> String {
    match cell(row, name) {
        Field::Str(text) => text.clone(),
        Field::Null => String::new(),
        other => panic!("{name}: {other:?}"),
    }
}

fn number(row: &Row, name: &str) -> f64 {
    match cell(row, name) {
        Field::Double(number) => *number,
        Field::Float(number) => f64::from(*number),
        Field::Long(number) => *number as f64,
        other => panic!("{name}: {other:?}"),
    }
}

#[test]
fn annotations_are_rows_with_their_tiers_and_times() {
    let desk = Desk::new(&[("film.eaf", EAF)]);
    let rows = desk.rows(&ExportWhat::All, "all.annotations.parquet");
    let (transcript, _) = chereme_formats::eaf::read_eaf(EAF.as_bytes()).expect("an EAF file");
    let tiers = transcript.tiers.iter();
    let mut want: Vec<String> = tiers
        .flat_map(|tier| {
            let said = tier.annotations.iter();
            said.map(|it| format!("{} {} {}", tier.name, it.id, it.value))
        })
        .collect();
    let said = |row: &Row| {
        let [tier, id, value] = ["tier", "file_id", "value"].map(|name| text(row, name));
        format!("{tier} {id} {value}")
    };
    let mut found: Vec<String> = rows.iter().map(said).collect();
    want.sort();
    found.sort();
    assert_eq!(found, want);
    for row in &rows {
        assert!(number(row, "start_s") <= number(row, "end_s"));
        assert_eq!(text(row, "recording"), "film");
    }
}

/// Two signs; two annotators agree on the handshape of the first and not on that of the second.
fn eaf_of_two_annotators() -> String {
    let tier = |attributes: &str, values: [&str; 2]| {
        let place = |nth: usize| format!("TIME_SLOT_REF1=\"t{}\" TIME_SLOT_REF2=\"t{}\"", 2 * nth, 2 * nth + 1);
        let notes = values.iter().enumerate().map(|(nth, value)| {
            let id = format!("{}{nth}", attributes.len());
            let times = place(nth);
            format!("<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{id}\" {times}><ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>")
        });
        let notes: String = notes.collect();
        format!("<TIER LINGUISTIC_TYPE_REF=\"x\" {attributes}>{notes}</TIER>")
    };
    let slots = (0..4).map(|nth| format!("<TIME_SLOT TIME_SLOT_ID=\"t{nth}\" TIME_VALUE=\"{}\"/>", nth * 100));
    let slots: String = slots.collect();
    let tiers = [
        tier("TIER_ID=\"Gloss RH\"", ["BOL", "LUNE"]),
        tier("TIER_ID=\"RH handshape\" ANNOTATOR=\"anna\"", ["U", "U"]),
        tier("TIER_ID=\"RH handshape 2\" ANNOTATOR=\"ben\"", ["U", "B"]),
    ];
    let tiers = tiers.concat();
    format!(
        "<ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2024-05-06T07:08:09+01:00\" FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/><TIME_ORDER>{slots}</TIME_ORDER>{tiers}<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"x\" TIME_ALIGNABLE=\"true\"/></ANNOTATION_DOCUMENT>"
    )
}

#[test]
fn values_that_count_have_their_annotator_and_all_annotations_their_standing() {
    let desk = Desk::new(&[("film.eaf", &eaf_of_two_annotators())]);
    let said = |rows: Vec<Row>, names: &[&str]| {
        let words = rows.iter().map(|row| {
            let cells: Vec<String> = names.iter().map(|name| text(row, name)).collect();
            cells.join(" ")
        });
        let mut words: Vec<String> = words.collect();
        words.sort();
        words
    };
    let values = desk.rows(&ExportWhat::All, "all.components.parquet");
    assert!(values.iter().all(|row| *cell(row, "confidence") == Field::Null));
    assert_eq!(
        said(values, &["gloss", "component", "value", "by"]),
        ["BOL configuration U anna"]
    );
    let annotations = desk.rows(&ExportWhat::All, "all.annotations.parquet");
    let wanted = [
        " BOL coded",
        " LUNE coded",
        "anna U coded",
        "anna U disputed",
        "ben B disputed",
        "ben U coded",
    ];
    assert_eq!(said(annotations, &["annotator", "value", "standing"]), wanted);
}

#[test]
fn tokens_have_their_codings_and_numbers_are_numbers() {
    let table = "gloss,handshape,frequency,first page\nLUNE,U,3.5,a\nSOLEIL,B,4,\nTERRE,n/a,,c\n";
    let desk = Desk::new(&[("signs.csv", table)]);
    let rows = desk.rows(&ExportWhat::All, "all.parquet");
    assert_eq!(rows.len(), 3);
    let find = |gloss: &str| {
        let mut all = rows.iter();
        all.find(|row| text(row, "gloss") == gloss).expect("a row")
    };
    assert_eq!(number(find("LUNE"), "frequency"), 3.5);
    assert_eq!(*cell(find("TERRE"), "frequency"), Field::Null);
    assert_eq!(*cell(find("LUNE"), "citation"), Field::Bool(true));
    assert_eq!(text(find("SOLEIL"), "first_page"), "");
    let shape = find("LUNE").get_column_iter();
    let shape = shape.filter(|it| it.0.contains("configuration")).count();
    assert_eq!(shape, 1, "{:?}", rows[0]);
    let values = desk.rows(&ExportWhat::All, "all.components.parquet");
    let said: Vec<String> = values
        .iter()
        .map(|row| {
            let [gloss, state, value] = ["gloss", "state", "value"].map(|name| text(row, name));
            format!("{gloss} {state} {value}")
        })
        .collect();
    let want = ["LUNE value U", "SOLEIL value B", "TERRE not-applicable "];
    assert_eq!(said, want);
}

#[test]
fn frames_are_in_metres_below_the_parent_and_in_the_room() {
    let desk = Desk::new(&[("take.bvh", BVH)]);
    let rows = desk.rows(&ExportWhat::All, "all.frames.parquet");
    assert_eq!(rows.len(), 6);
    let take = &rows[3];
    assert_eq!((text(take, "joint").as_str(), number(take, "frame")), ("Chest", 1.0));
    assert!((number(take, "t_s") - 0.04).abs() < 1e-9);
    let clip = desk
        .corpus
        .movement_at_address(&"recording:take".parse().expect("an address"))
        .expect("movement")
        .clip;
    for row in &rows {
        let (frame, name) = (number(row, "frame") as usize, text(row, "joint"));
        let joints = clip.clip_skeleton().skeleton_joints().iter();
        let joint = joints.clone().position(|it| it.name == name).expect("a joint");
        let pose = clip.clip_pose_at(frame);
        let (turn, room) = (
            pose.rotations[joint],
            clip.model_pose(frame).model_joint_position(joint),
        );
        for (name, value) in [
            ("tx", pose.translations[joint].x),
            ("ty", pose.translations[joint].y),
            ("qz", turn.z),
            ("qw", turn.w),
            ("wx", room.x),
            ("wy", room.y),
        ] {
            assert!((number(row, name) - value).abs() < 1e-6, "{name}");
        }
    }
}

#[test]
fn frames_beyond_a_jump_of_the_body_are_not_usable() {
    let (head, _) = BVH.split_once("Frames:").expect("frames");
    let frames = (0..20).map(|frame| {
        let x = if frame < 5 { 6.0 } else { 0.0 };
        format!("{x} 1 0 0 0 0 0 {frame} 0\n")
    });
    let frames: String = frames.collect();
    let text = format!("{head}Frames: 20\nFrame Time: 0.04\n{frames}");
    let desk = Desk::new(&[("take.bvh", &text)]);
    let rows = desk.rows(&ExportWhat::All, "all.frames.parquet");
    assert_eq!(rows.len(), 40);
    for row in &rows {
        let usable = number(row, "frame") >= 5.0;
        assert_eq!(*cell(row, "usable"), Field::Bool(usable));
    }
}

#[test]
fn the_same_corpus_gives_the_same_bytes() {
    let desk = Desk::new(&[("film.eaf", EAF), ("take.bvh", BVH)]);
    for name in ["all.parquet", "all.annotations.parquet", "all.frames.parquet"] {
        desk.rows(&ExportWhat::All, name);
        let first = std::fs::read(desk.path(name)).expect("a file");
        desk.rows(&ExportWhat::All, name);
        assert!(first == std::fs::read(desk.path(name)).expect("a file"), "{name}");
    }
}

#[test]
fn an_empty_corpus_gives_empty_tables_with_their_columns() {
    let desk = Desk::new(&[]);
    for (name, column) in [
        ("all.parquet", "gloss"),
        ("all.components.parquet", "value"),
        ("all.annotations.parquet", "tier"),
        ("all.frames.parquet", "joint"),
    ] {
        assert_eq!(desk.rows(&ExportWhat::All, name).len(), 0);
        let file = OnDisk::open(desk.path(name)).expect("a file");
        let reader = SerializedFileReader::new(file).expect("Parquet");
        let schema = reader.metadata().file_metadata().schema().get_fields();
        assert!(schema.iter().any(|it| it.name() == column), "{name}");
    }
}
