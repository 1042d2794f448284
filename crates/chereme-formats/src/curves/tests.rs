use super::*;

fn curves(text: &str) -> (Curves, Instant, Vec<Finding>) {
    let (tracks, findings) =
        read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let Content::Curves(curves) = tracks.tracks[0].content.clone() else {
        panic!("curves");
    };
    (curves, tracks.tracks[0].offset, findings)
}

fn values(curves: &Curves, name: &str) -> Vec<Option<f64>> {
    curves
        .curve(name)
        .unwrap_or_else(|| panic!("{name}"))
        .values
        .values()
        .collect()
}

#[test]
fn live_link_has_the_times_of_its_timecodes() {
    let text = "Timecode,BlendShapeCount,JawOpen,HeadYaw\n\
                23:59:59:58.500,61,0.25,-0.1473\n23:59:59:59.500,61,0.5,0.1\n00:00:00:00.500,61,,0.2\n";
    let (curves, offset, _) = curves(text);
    assert_eq!(values(&curves, "jawopen"), [Some(0.25), Some(0.5), None]);
    assert_eq!(curves.times().rate().map(|rate| rate.frames()), Some(60));
    assert_eq!(offset, Instant::ZERO);
    let yaw = curves.curve("HeadYaw").expect("a curve");
    assert_eq!(
        (yaw.unit.as_str(), yaw.values.text(0).as_deref()),
        ("rad", Some("-0.1473"))
    );
    let uneven = text.replace("00:00:00:00.500", "00:00:00:30.0");
    let (tracks, _) = read(uneven.as_bytes()).expect("curves");
    let Content::Curves(curves) = &tracks.tracks[0].content else {
        panic!("curves");
    };
    assert_eq!(curves.times().rate(), None, "rows have their own times");
}

#[test]
fn degrees_are_told_from_radians_by_their_size() {
    let text = "Timecode,BlendshapeCount,HeadRoll\n00:00:00:00.0,52,12.5\n00:00:00:01.0,52,1\n";
    assert_eq!(curves(text).0.curves()[1].unit, "deg");
}

#[test]
fn open_face_keeps_every_column_and_reports_lost_faces() {
    let text = "frame, timestamp, confidence, success, pose_Tx, AU01_r\n1, 0, 0.9, 1, 3.5, 0.1\n2, 0.04, 0.1, 0, 0, 0\n";
    let (curves, _, findings) = curves(text);
    assert_eq!(curves.curves().len(), 6);
    assert_eq!(curves.times().rate().map(|rate| rate.frames()), Some(25));
    assert_eq!(
        curves.curve("pose_Tx").map(|curve| curve.unit.as_str()),
        Some("mm")
    );
    assert!(
        findings[0].message.contains("in 1 rows no face was found"),
        "{findings:?}"
    );
}

#[test]
fn media_pipe_scores_become_curves_with_gaps() {
    let text = r#"[{"timestampMs": 0, "faceBlendshapes": [{"categories": [{"categoryName": "_neutral", "score": 1e-6}, {"categoryName": "jawOpen", "score": 0.5}]}]},
        {"timestampMs": 40, "faceBlendshapes": []},
        {"timestampMs": 80, "faceBlendshapes": [{"categories": [{"categoryName": "jawOpen", "score": 0.25}]}]}]"#;
    let (curves, _, findings) = curves(text);
    assert_eq!(findings, []);
    assert_eq!(values(&curves, "jawOpen"), [Some(0.5), None, Some(0.25)]);
    assert_eq!(values(&curves, "_neutral"), [Some(1e-6), None, None]);
    assert_eq!(curves.times().rate().map(|rate| rate.frames()), Some(25));
}

#[test]
fn fap_text_holds_what_its_masks_name() {
    let masks = |on: &[usize]| {
        let bits = (1..=68).map(|at| if on.contains(&at) { "1" } else { "0" });
        bits.collect::<Vec<_>>().join(" ")
    };
    let text = format!(
        "2.1 face 25 2\n{}\n0 120\n{}\n1 100 -7\n",
        masks(&[3]),
        masks(&[3, 31])
    );
    let (curves, _, _) = curves(&text);
    assert_eq!(values(&curves, "FAP3"), [Some(120.0), Some(100.0)]);
    assert_eq!(values(&curves, "FAP31"), [None, Some(-7.0)]);
    assert_eq!(curves.curves().len(), 2);
    let viseme = format!("2.1 face 25 1\n{}\n0 1 2 3\n", masks(&[1]));
    assert!(
        read(viseme.as_bytes())
            .expect_err("a viseme")
            .to_string()
            .contains("visemes")
    );
}

#[test]
fn plain_tables_come_back_as_they_were() {
    let text = "time [s],force [N],\"a,b\"\n0.500000,1.50,\n0.510000,,2e-3\n";
    let (curves, offset, _) = curves(text);
    assert_eq!(offset.millis(), 500);
    assert_eq!(curves.times().rate().map(|rate| rate.frames()), Some(100));
    assert_eq!(write(&curves, offset), text.replace("2e-3", "0.002"));
}

#[test]
fn scores_of_one_frame_are_read_from_their_text_form() {
    let text = "# proto-message: ClassificationList\nclassification {\n  index: 0\n  score: 2.9e-05\n  label: \"_neutral\"\n}\n\
                classification {\n  index: 1\n  score: 0.79\n  label: \"browDownLeft\"\n}\n";
    assert_eq!(Kind::of(text.as_bytes()), Some(Kind::MediaPipe));
    let (curves, _, findings) = curves(text);
    assert_eq!((curves.frames(), curves.curves().len()), (1, 2));
    let down = curves.curve("browDownLeft").expect("a score");
    assert_eq!(down.values.text(0).as_deref(), Some("0.79"));
    assert!(findings.iter().any(|it| it.message.contains("one frame")));
    assert!(read(b"classification {\n score: high\n}\n").is_err());
    assert!(read(b"classification {\n}\n").is_err());
}

#[test]
fn tables_that_mean_nothing_are_refused_with_the_line() {
    let cases = [
        ("gloss,handshape\nCHAT,U\n", "no table of channels"),
        ("time,a\n", "no numbers"),
        ("time,a\n0,1,2\n", "line 2: the row has 3 cells"),
        ("time,a\n0,x\n", "line 2: \"x\" is no number"),
        ("time,a\n1,0\n0,0\n", "is not later"),
        ("Timecode,BlendShapeCount,A\nnoon,1,2\n", "is no timecode"),
        ("2.1 face 25 1\n0 1\n", "68 masks"),
        ("{\"faceBlendshapes\": 3}", "no frame holds"),
    ];
    for (text, expected) in cases {
        let error = read(text.as_bytes()).expect_err(expected).to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
}

#[test]
fn faces_of_others_are_read_whole() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("face");
    let open = |path: &str| {
        let bytes = std::fs::read(folder.join(path)).expect("a file");
        let (tracks, _) = read(&bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
        match tracks.tracks[0].content.clone() {
            Content::Curves(curves) => curves,
            Content::Markers(_) => panic!("curves"),
        }
    };
    let link = open("alexdjulin-LiveLinkFace/alex_rom_4.csv");
    assert!(
        (link.span().seconds() - 127.0).abs() < 1.0,
        "{}",
        link.span().seconds()
    );
    assert_eq!(link.curves().len(), 62);
    let decoded = open("think-biq-LLV/dao_decoded.csv");
    assert!((decoded.span().seconds() - 3.0).abs() < 1.0);
    let open_face = open("cosanlab-py-feat/OpenFace_Test.csv");
    assert_eq!((open_face.curves().len(), open_face.frames()), (431, 100));
}
