//! Tests of exports of recordings of different kinds: movement, markers, faces, tokens, translations.

use std::path::{Path, PathBuf};

use super::tests::{Place, address, export};
use super::*;
use crate::{ListFilter, ListKind, ignore_progress_step};

/// A recording that moves, with tokens, translations in two languages and markers; each is left out of
/// the formats that only another one has something for.
fn mixed(place: &mut Place) -> Corpus {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus");
    let points = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n\
                  100\t100\t2\t1\tmm\nFrame#\tTime\tLWRA\n\t\tX1\tY1\tZ1\n\n1\t0.00\t1\t9\t3\n2\t0.01\t2\t9\t3\n";
    let face = "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.25\n00:00:00:01.0,61,0.5\n";
    let still = "HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n\
                 OFFSET 0 1 0\n}\n}\nMOTION\nFrames: 0\nFrame Time: 0.04\n";
    let lexicon = "gloss,Handshape\nCHAT,B\nLION,5\n";
    let files = [
        ("a-still.bvh", still),
        ("b-points.trc", points),
        ("c-face.csv", face),
        ("lexicon.csv", lexicon),
    ];
    let mut files: Vec<PathBuf> = files
        .iter()
        .map(|(name, text)| place.file(name, text.as_bytes()))
        .collect();
    files.extend([own.join("bol.bvh"), own.join("bol.eaf")]);
    place.corpus(&files)
}

#[test]
fn a_folder_of_files_has_each_recording_that_holds_something_for_the_format() {
    let mut place = Place::new();
    let corpus = mixed(&mut place);
    let folder = |format: &str| {
        let options = ExportOptions {
            format: Some(format.to_owned()),
            ..ExportOptions::default()
        };
        let to = place.path(&format.replace('.', "-"));
        let mut hear = ignore_progress_step;
        let progress = &mut ProgressReceiver::new(&mut hear);
        (corpus.export_corpus(&ExportWhat::All, &to, &options, progress), to)
    };
    for (format, expected, left_out) in [
        ("csv", &["bol.csv", "lexicon.csv"][..], 3),
        ("bvh", &["a-still.bvh", "bol.bvh"], 2),
        ("glb", &["a-still.glb", "annotations_to_markers.py", "bol.glb"], 2),
        ("vrma", &["bol.vrma"], 3),
        ("trc", &["b-points.trc"], 3),
        ("c3d", &["b-points.c3d"], 3),
        ("markers.csv", &["b-points.markers.csv"], 3),
        ("curves.csv", &["c-face.curves.csv"], 3),
        ("srt", &["bol.Translation EN.srt", "bol.Translation FR.srt"], 3),
        ("TextGrid", &["bol.textgrid"], 3),
        ("xra", &["bol.xra"], 3),
    ] {
        let (report, to) = folder(format);
        let report = report.unwrap_or_else(|error| panic!("{format}: {error}"));
        let mut names: Vec<String> = std::fs::read_dir(&to)
            .expect("a folder")
            .map(|it| it.expect("an entry").file_name().display().to_string())
            .collect();
        names.sort();
        assert_eq!(names, expected, "{format}");
        assert_eq!(report.files.len(), names.len(), "{format}");
        assert_eq!(report.left_out.len(), left_out, "{format}: {report:?}");
        let note = format!("and left out: {left_out} of ");
        let said = report.notes.iter().any(|it| it.contains(&note));
        assert!(said, "{format}: {:?}", report.notes);
    }
    let table = std::fs::read_to_string(place.path("csv/bol.csv")).expect("text");
    assert!(table.lines().count() > 1, "{table}");
    let table = std::fs::read_to_string(place.path("csv/lexicon.csv")).expect("text");
    assert_eq!(table.lines().count(), 3, "{table}");
    let (refused, to) = folder("sigml");
    let error = refused.expect_err("nothing is notated");
    assert!(error.to_string().contains("none of the 6"), "{error}");
    assert!(error.error_remedy().is_some());
    assert!(!to.exists(), "nothing is left behind");
}

#[test]
fn subtitles_hold_one_language_and_name_the_others() {
    let mut place = Place::new();
    let corpus = mixed(&mut place);
    let text = |what: &str, name: &str| {
        let to = place.path(name);
        let report = export(&corpus, &address(what), &to).expect("written");
        (std::fs::read_to_string(to).expect("text"), report.notes)
    };
    let (first, notes) = text("recording:bol", "first.srt");
    let [(fr, fr_id), (en, en_id)] = ["Translation FR", "Translation EN"].map(|name| {
        let rows = corpus
            .list_rows(ListKind::Tiers, &ListFilter::default())
            .expect("listed")
            .rows;
        let row = rows.iter().find(|row| row["name"] == name).expect(name);
        let id = row["id"].as_i64().expect("a number");
        (text(&format!("tier:{id}"), &format!("{id}.srt")).0, id)
    });
    assert_ne!(fr, en);
    let (written, other) = match first == fr {
        true => (fr_id, en_id),
        false => (en_id, fr_id),
    };
    assert!(first == fr || first == en, "{first}");
    let [note, _for_whom] = &notes[..] else {
        panic!("{notes:?}");
    };
    let (kept, left) = note.split_once("not written").expect("both");
    assert!(kept.contains(&format!("(tier:{written})")), "{note}");
    assert!(left.contains(&format!("(tier:{other})")), "{note}");
}

#[test]
fn exported_curves_are_read_again_with_their_names_times_and_numbers() {
    let mut place = Place::new();
    let mut text = String::from("time [s],JawOpen,HeadYaw [rad],\"odd, name\"\n");
    for frame in 0..90_u32 {
        let time = f64::from(frame) * 1000.0 / 29988.0;
        text += &format!("{time},0.{frame:02}5,-1.{frame:03},\n");
    }
    let first = place.corpus(&[place.file("face.csv", text.as_bytes())]);
    let rate = |corpus: &Corpus| corpus.recording_tracks(&RowName::Number(1)).expect("tracks")[0].rate;
    let expected = chereme_motion::FrameRate::new(29988, 1000).expect("a rate");
    assert_eq!(rate(&first), Some(expected));
    for name in ["out/take.curves.csv", "out/take.curves.tsv"] {
        let out = place.file(name, b"");
        std::fs::remove_file(&out).expect("removed");
        export(&first, &address("recording:1"), &out).expect("exported");
        let again = place.corpus(std::slice::from_ref(&out));
        let of = |corpus: &Corpus| {
            let row = corpus
                .recording_tracks(&RowName::Number(1))
                .expect("tracks")
                .swap_remove(0);
            corpus.read_track_content(row.id, None).expect("a track")
        };
        assert_eq!(of(&again), of(&first), "{name}");
        let recordings = again.list_rows(ListKind::Recordings, &ListFilter::default());
        assert_eq!(recordings.expect("listed").rows[0]["name"], "take");
    }
}

#[test]
fn a_take_of_live_link_goes_back_with_its_times_of_day() {
    let mut place = Place::new();
    let mut text = String::from("Timecode,BlendShapeCount,JawOpen,BrowInnerUp,EyeBlinkLeft,HeadYaw\n");
    for frame in [10, 12, 15, 58, 59] {
        text += &format!("10:20:30:{frame:02}.250,61,0.{frame}0,1.05,0.0,-0.3\n");
    }
    let corpus = place.corpus(&[place.file("take.csv", text.as_bytes())]);
    let out = place.path("take.livelink.csv");
    let report = export(&corpus, &address("recording:take"), &out).expect("exported");
    let said = |words: &str| report.notes.iter().any(|note| note.contains(words));
    assert!(
        said("does not have are 0: ") && !said("time of day"),
        "{:?}",
        report.notes
    );
    let written = std::fs::read_to_string(&out).expect("text");
    let cells = |line: &str, titles: [&str; 6]| {
        let header: Vec<&str> = written.lines().next().unwrap_or_default().split(',').collect();
        let cells: Vec<&str> = line.split(',').collect();
        titles.map(|title| cells[header.iter().position(|known| *known == title).expect("a column")].to_owned())
    };
    let titles = [
        "Timecode",
        "BlendShapeCount",
        "JawOpen",
        "BrowInnerUp",
        "EyeBlinkLeft",
        "HeadYaw",
    ];
    for (expected, line) in text.lines().zip(written.lines()) {
        assert_eq!(cells(line, titles).join(","), expected);
    }
    let plain = place.corpus(&[place.file("jaw.csv", b"time,jaw,lip\n0,1,2\n0.1,1,2\n")]);
    let error = export(&plain, &address("recording:jaw"), &place.path("x.livelink.csv")).expect_err("no shapes");
    assert!(error.to_string().contains("no face in the shapes of ARKit"), "{error}");
}

#[test]
fn cells_that_spreadsheets_take_for_formulas_get_an_apostrophe_on_request() {
    let mut place = Place::new();
    let lexicon = "gloss,Handshape,Remark\n=HYPERLINK(1),B,-0.5\n@SUM(A1),5,+1\n-x,S,plain\nCHAT,V,\"\t=1\"\n";
    let file = place.file("lexicon.csv", lexicon.as_bytes());
    let corpus = place.corpus(&[file]);
    let table = |spreadsheet_safe: bool, format: &str| {
        let options = ExportOptions {
            spreadsheet_safe,
            ..ExportOptions::from(format)
        };
        let (mut out, mut hear) = (Vec::new(), ignore_progress_step);
        let progress = &mut ProgressReceiver::new(&mut hear);
        let done = corpus.export_stream(&ExportWhat::All, options, &mut out, progress);
        done.map(|_| String::from_utf8(out).expect("text"))
    };
    let plain = table(false, "csv").expect("exported");
    assert!(plain.contains(",=HYPERLINK(1),") && !plain.contains('\''), "{plain}");
    let safe = table(true, "csv").expect("exported");
    for cell in [",'=HYPERLINK(1),", ",'@SUM(A1),", ",'-x,", ",-0.5", ",+1"] {
        assert!(safe.contains(cell), "{cell} in {safe}");
    }
    let error = table(true, "hns").expect_err("no table").to_string();
    assert!(error.contains("only a table"), "{error}");
}
