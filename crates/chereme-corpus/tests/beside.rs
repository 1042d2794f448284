//! Files beside captures and annotation files: vocabularies, templates and settings of ELAN, points as JSON, exports of
//! signs, and files that belong together by timecode or by folder.

use std::fs;
use std::path::PathBuf;

use chereme_corpus::{
    Corpus, CorpusAddress, ExportOptions, ExportWhat, FileJoining, ImportOptions, ImportReport, JoinReason, ListFilter,
    ListKind, ProgressReceiver, RowName, SearchOptions, TrackKind, ignore_progress_step, time_of_day,
};
use chereme_motion::FrameRate;

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

    fn corpus(&self, name: &str) -> Corpus {
        Corpus::create_corpus(&self.folder.path().join(name), "A").expect("made")
    }
}

fn assert_whole(corpus: &mut Corpus) {
    let mut hear = ignore_progress_step;
    let report = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut hear));
    let report = report.expect("checked");
    assert_eq!(report.all_findings().next(), None);
}

const TEMPLATE: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?><ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2024-01-01T00:00:00Z\" \
FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/><TIME_ORDER/>\
<TIER TIER_ID=\"Gloss RH\" LINGUISTIC_TYPE_REF=\"t\"/><TIER TIER_ID=\"Handshape RH\" PARENT_REF=\"Gloss RH\" LINGUISTIC_TYPE_REF=\"h\"/>\
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"t\" TIME_ALIGNABLE=\"true\"/>\
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"h\" TIME_ALIGNABLE=\"true\" CONSTRAINTS=\"Included_In\" CONTROLLED_VOCABULARY_REF=\"shapes\"/>\
<CONTROLLED_VOCABULARY CV_ID=\"shapes\" EXT_REF=\"er1\"/><EXTERNAL_REF EXT_REF_ID=\"er1\" TYPE=\"ecv\" \
VALUE=\"file:///media/shapes.ecv\"/></ANNOTATION_DOCUMENT>";
const VOCABULARY: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?><CV_RESOURCE AUTHOR=\"\" DATE=\"2021-05-11T16:48:01+08:00\" \
VERSION=\"0.2\"><LANGUAGE LANG_DEF=\"x\" LANG_ID=\"und\" LANG_LABEL=\"u\"/><CONTROLLED_VOCABULARY CV_ID=\"shapes\">\
<DESCRIPTION LANG_REF=\"und\"/><CV_ENTRY_ML CVE_ID=\"c1\"><CVE_VALUE LANG_REF=\"und\">bunny</CVE_VALUE></CV_ENTRY_ML>\
<CV_ENTRY_ML CVE_ID=\"c2\"><CVE_VALUE LANG_REF=\"und\">moose</CVE_VALUE></CV_ENTRY_ML></CONTROLLED_VOCABULARY></CV_RESOURCE>";
const SETTINGS: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?><preferences version=\"1.1\"><prefGroup key=\"TierColors\">\
<pref key=\"B\"><Object class=\"java.awt.Color\">0,160,255</Object></pref></prefGroup><prefList key=\"MultiTierViewer.TierOrder\">\
<String>B</String><String>A</String></prefList></preferences>";

fn import_all(corpus: &mut Corpus, paths: &[PathBuf], options: &ImportOptions) -> ImportReport {
    let mut hear = ignore_progress_step;
    let report = corpus.import_paths(paths, options, &mut ProgressReceiver::new(&mut hear));
    let report = report.expect("imported");
    assert!(!report.has_refusals(), "{:?}", report.files);
    report
}

fn folder(desk: &Desk, files: &[(&str, &str)]) -> PathBuf {
    let inbox = desk.folder.path().join("in");
    for (name, text) in files {
        let path = inbox.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
    inbox
}

fn recordings(corpus: &Corpus) -> Vec<String> {
    let listing = corpus.list_rows(ListKind::Recordings, &ListFilter::default());
    let rows = listing.expect("listed").rows;
    rows.iter()
        .map(|row| row["name"].as_str().unwrap_or_default().to_owned())
        .collect()
}

fn kinds(corpus: &Corpus, name: &str) -> Vec<(TrackKind, i64)> {
    let tracks = corpus
        .recording_tracks(&RowName::Text(name.to_owned()))
        .expect("tracks");
    tracks.iter().map(|it| (it.kind, it.offset_us)).collect()
}

#[test]
fn a_template_gives_its_tiers_to_recordings_without_tiers_and_its_vocabulary_comes_from_its_own_file() {
    let desk = Desk::new();
    let other = MOVEMENT.replace("0 0 1", "0 0 2");
    let inbox = folder(
        &desk,
        &[
            ("a.bvh", MOVEMENT),
            ("b.bvh", &other),
            ("b.eaf", &eaf(&[("Gloss", 0, 100, "CAT")])),
            ("project.etf", TEMPLATE),
            ("shapes.ecv", VOCABULARY),
        ],
    );
    let mut corpus = desk.corpus("c.chereme");
    import_all(&mut corpus, std::slice::from_ref(&inbox), &ImportOptions::default());
    let tiers = |corpus: &Corpus| {
        let listing = corpus
            .list_rows(ListKind::Tiers, &ListFilter::default())
            .expect("listed");
        let text = |row: &serde_json::Map<String, serde_json::Value>| {
            format!(
                "{} {}",
                row["recording"].as_str().unwrap_or_default(),
                row["name"].as_str().unwrap_or_default()
            )
        };
        listing.rows.iter().map(text).collect::<Vec<_>>()
    };
    assert_eq!(tiers(&corpus), ["a Gloss RH", "a Handshape RH", "b Gloss"]);
    let shapes = corpus
        .list_rows(ListKind::Inventories, &ListFilter::default())
        .expect("listed")
        .rows;
    let shapes = shapes
        .iter()
        .map(|row| serde_json::Value::Object(row.clone()).to_string());
    assert_eq!(
        shapes.filter(|text| text.contains("shapes/")).count(),
        1,
        "a vocabulary of handshapes"
    );
    assert_whole(&mut corpus);
    let again = import_all(&mut corpus, &[inbox], &ImportOptions::default());
    assert!(again.created.is_empty(), "{:?}", again.created);
    corpus.undo_operation().expect("taken back");
    assert_eq!(tiers(&corpus), Vec::<String>::new());
}

#[test]
fn settings_of_elan_show_tiers_in_their_order_and_leave_the_file_as_it_was() {
    let desk = Desk::new();
    let text = eaf(&[("A", 0, 100, "x"), ("B", 0, 100, "y")]);
    let inbox = folder(
        &desk,
        &[("a.eaf", &text), ("a.pfsx", SETTINGS), ("lone.pfsx", SETTINGS)],
    );
    let mut corpus = desk.corpus("c.chereme");
    let report = import_all(&mut corpus, &[inbox], &ImportOptions::default());
    assert_eq!(report.unread_file_kinds().len(), 1, "{:?}", report.unread_file_kinds());
    let contents = corpus.load_recording_contents(1).expect("contents");
    let shown: Vec<_> = contents.tiers.iter().map(|it| it.row.elan_display_settings()).collect();
    assert_eq!([shown[0].order, shown[1].order], [Some(1), Some(0)]);
    assert_eq!(shown[1].colour.as_deref(), Some("#00a0ff"));
    let to = desk.folder.path().join("out.eaf");
    let mut hear = ignore_progress_step;
    corpus
        .export_corpus(
            &ExportWhat::Address(CorpusAddress::Recording(RowName::Number(1))),
            &to,
            &ExportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("exported");
    assert_eq!(fs::read_to_string(to).expect("read"), text);
}

fn frame(x: u32) -> String {
    format!("{{\"version\":1.3,\"people\":[{{\"pose_keypoints_2d\":[{x},20.5,0.9,30,40,0.5]}}]}}")
}

#[test]
fn files_of_single_frames_become_one_track_next_to_the_movement_of_their_name() {
    let desk = Desk::new();
    let frames: Vec<(String, String)> = (0..5)
        .map(|at| (format!("take_{at:012}_keypoints.json"), frame(100 + at)))
        .collect();
    let mut files: Vec<(&str, &str)> = frames
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    files.push(("take.bvh", MOVEMENT));
    let inbox = folder(&desk, &files);
    let mut corpus = desk.corpus("c.chereme");
    let options = ImportOptions {
        rate: FrameRate::new(50, 1).ok(),
        ..ImportOptions::default()
    };
    let report = import_all(&mut corpus, std::slice::from_ref(&inbox), &options);
    assert_eq!(report.files.len(), 2, "{:?}", report.files);
    assert_eq!(recordings(&corpus), ["take"]);
    let tracks = corpus.recording_tracks(&RowName::Number(1)).expect("tracks");
    let points = tracks.iter().find(|it| it.kind == TrackKind::Markers).expect("points");
    assert_eq!((points.frames, points.duration_us), (Some(5), Some(100_000)));
    let again = import_all(&mut corpus, &[inbox], &options);
    assert_eq!(again.created.get("tracks"), None, "{:?}", again.created);
}

#[test]
fn an_export_of_signs_is_a_lexicon_despite_its_text_extension() {
    let desk = Desk::new();
    let text = "{\"name\":\"c\",\"signs\":[{\"signlevel\":{\"entryid\":1,\"gloss\":[\"DOG\"]},\"loc modules\":{\"x\":{\"locationtree\":\
                {\"checkstates\":{\"Body>Chin\":2}}}}}]}";
    let inbox = folder(&desk, &[("export.txt", text), ("notes.txt", "buy milk")]);
    let mut corpus = desk.corpus("c.chereme");
    import_all(&mut corpus, &[inbox], &ImportOptions::default());
    let answer = corpus.search_tokens("gloss:DOG", &SearchOptions::default());
    assert_eq!(answer.expect("an answer").total, 1);
}

const FACE: &str =
    "Timecode,BlendShapeCount,JawOpen\n10:00:02:00.0,61,0.25\n10:00:02:01.0,61,0.5\n10:00:02:02.0,61,0.5\n";

#[test]
fn tracks_with_overlapping_timecodes_are_one_take_aligned_by_timecode() {
    let desk = Desk::new();
    let long = MOVEMENT
        .replace("Frames: 2", "Frames: 40")
        .replace("0 0 0\n0 0 1\n", &"0 0 1\n".repeat(40));
    let inbox = folder(&desk, &[("a/body.bvh", &long), ("b/phone_7.csv", FACE)]);
    let mut corpus = desk.corpus("c.chereme");
    let at = |text: &str| ImportOptions {
        clock: time_of_day(text),
        ..ImportOptions::default()
    };
    import_all(&mut corpus, &[inbox.join("a")], &at("10:00:00:00"));
    // Another folder, a conventional start and unlike lengths: a question.
    let report = import_all(&mut corpus, &[inbox.join("b")], &ImportOptions::default());
    assert_eq!(recordings(&corpus), ["body", "phone_7"]);
    let reported = report.files[0].findings.iter();
    let reported = reported.filter(|it| {
        it.message
            .starts_with("its timecodes are those of the recording \"body\"")
    });
    assert_eq!(reported.count(), 1, "{report:?}");
    corpus.undo_operation().expect("taken back");
    let by_timecode = ImportOptions {
        joining: FileJoining::Timecode,
        ..ImportOptions::default()
    };
    let report = import_all(&mut corpus, &[inbox.join("b")], &by_timecode);
    assert_eq!(report.joined[0].files[0].by, JoinReason::Timecode, "{report:?}");
    assert_eq!(recordings(&corpus), ["body"]);
    assert_eq!(
        kinds(&corpus, "body"),
        [(TrackKind::Skeleton, 0), (TrackKind::Curves, 2_000_000)]
    );
    corpus.undo_operation().expect("taken back");
    assert_eq!(kinds(&corpus, "body").len(), 1);
    let far = FACE.replace("10:00", "17:00");
    fs::write(inbox.join("b/phone_7.csv"), far).expect("written");
    import_all(&mut corpus, &[inbox.join("b")], &by_timecode);
    assert_eq!(recordings(&corpus), ["body", "phone_7"]);
}

#[test]
fn a_folder_with_one_file_of_movement_and_one_of_a_face_is_one_take() {
    let desk = Desk::new();
    let other = MOVEMENT.replace("0 0 1", "0 0 2");
    // As long as the movement: a sixth of a second, as phones count 60 frames.
    let later = (3..10).map(|frame| format!("10:00:02:0{frame}.0,61,0.5\n"));
    let phone = FACE.to_owned() + &later.collect::<String>();
    let inbox = folder(
        &desk,
        &[
            ("one/body.bvh", MOVEMENT),
            ("one/phone.csv", &phone),
            ("long/body2.bvh", &MOVEMENT.replace("0 0 1", "0 0 4")),
            (
                "long/points.trc",
                "PathFileType\t4\t(X/Y/Z)\ta\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
                 1\t1\t2\t1\tmm\t1\t1\t2\nFrame#\tTime\tLWRA\n\t\tX1\tY1\tZ1\n\n1\t0\t1\t2\t3\n2\t1\t1\t2\t3\n",
            ),
            ("two/x.bvh", &other),
            ("two/y.bvh", &MOVEMENT.replace("0 0 1", "0 0 3")),
            ("two/z.csv", &FACE.replace("0.25", "0.75").replace("10:00", "15:00")),
        ],
    );
    let mut corpus = desk.corpus("c.chereme");
    let report = import_all(&mut corpus, &[inbox], &ImportOptions::default());
    let mut names = recordings(&corpus);
    names.sort();
    assert_eq!(names, ["body", "body2", "points", "x", "y", "z"]);
    assert_eq!(kinds(&corpus, "body").len(), 2);
    let reported = report.files.iter().flat_map(|it| &it.findings);
    let reported = reported.filter(|it| it.message.contains("taken for the take"));
    assert_eq!(reported.count(), 1);
}
