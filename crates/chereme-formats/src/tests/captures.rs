//! Golden tables of captures: BVH read and written, curves of faces, and faces of every system.

use chereme_motion::{
    CurveTrack, FacePosture, FrameNumberColumn, FrameRate, FrameTimes, RecordingInstant, ScalarCurve,
};

use super::{clip, curves, findings, tracks};
use crate::bvh::bones::BonePositions;
use crate::bvh::bvh_convert::{self, ClipBuilder};
use crate::bvh::raw::{BvhError, BvhReadOptions, BvhReader, BvhWriter, MotionBlock};
use crate::faces::{FaceCalibration, FaceSystem};
use crate::golden::{compare, put};
use crate::tracks::CapturedTrackContent;

const HEAD: &str = "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 90.50 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation \
Xrotation Yrotation\n\tJOINT Left Arm\n\t{\n\t\tOFFSET 10.5 0 -1e-1\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n\
\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 5 0 0\n\t\t}\n\t}\n\tJOINT Leg\n\t{\n\t\tOFFSET 1 -40 0\n\
\t\tCHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -30 0\n\
\t\t}\n\t}\n}\n";

const ROWS: &str = "MOTION\nFrames: 4\nFrame Time: 0.0083333\n\
1 92 3 4 5 6 7 8 9 60 -3 1 2 3 4\n1.5 -2.25 3e-3 0 -0 6 7.125 8 9 60 -3 1 80 -3 4\n\
-1 2 3.75 14 -25 170 7 80.5 9 60 -3 1 2 90 4\n1 2 3 -400 5 6 7 8 9.0001 60 -3 1 2 3 -4\n";

/// Reads a file in blocks of three frames and writes down its contents; also its movement, if `moving`.
fn captured(out: &mut String, text: &str, moving: bool) -> Result<(), BvhError> {
    let mut reader = BvhReader::open_with(text.as_bytes(), BvhReadOptions { block_frames: 3 })?;
    let hierarchy = reader.bvh_hierarchy().clone();
    for joint in &hierarchy.joints {
        put(out, format!("{joint:?}"));
    }
    put(out, format!("{:?}", reader.bvh_motion_header()));
    let (mut blocks, mut block) = (Vec::new(), MotionBlock::default());
    while reader.next_block(&mut block)? {
        put(out, format!("{block:?}"));
        blocks.push(block.clone());
    }
    let (time, read) = (reader.bvh_motion_header().frame_time.clone(), reader.bytes_read());
    let summary = reader.finish_bvh_reading();
    put(
        out,
        format!("{} frames, {read} bytes, fix {:?}", summary.frames, summary.root_fix),
    );
    findings(out, &summary.findings);
    let mut bones = BonePositions::new(&hierarchy);
    blocks.iter().for_each(|block| bones.sample_motion_block(block));
    put(out, format!("{bones:?}"));
    let rate = bvh_convert::rate_from_frame_time(time.as_ref());
    put(out, format!("rate {rate:?}"));
    let builder = ClipBuilder::new(&hierarchy, summary.root_fix);
    if let (Ok(mut builder), Ok(rate), true) = (builder, rate, moving) {
        for block in &blocks {
            builder.push_block_rows(0..block.frames, |column| block.columns.get(column));
        }
        let made = builder.finish_bvh_clip(rate).expect("a clip");
        clip(out, &made);
        let own = bvh_convert::hierarchy_from_skeleton(made.clip_skeleton(), 4);
        let wide = bvh_convert::widen_hierarchy(&own, &made);
        for hierarchy in [&hierarchy, &own, &wide] {
            put(
                out,
                format!("{:?}", bvh_convert::columns_from_clip(&made, hierarchy, 3)),
            );
        }
    }
    let mut copy = Vec::new();
    let motion = Some((time.as_ref(), summary.frames));
    let mut writer = BvhWriter::new(&mut copy, &hierarchy, motion).expect("a vector");
    blocks
        .iter()
        .for_each(|block| writer.write_motion_block(block).expect("a vector"));
    writer.finish_bvh_writing().expect("all frames");
    put(out, String::from_utf8_lossy(&copy));
    Ok(())
}

#[test]
fn golden_bvh_read_and_written() {
    let mut out = String::new();
    let good = format!("{HEAD}{ROWS}");
    let rows = |more: &str| format!("{HEAD}MOTION\nFrames: 4\nFrame Time: 0.01\n{more}");
    let row = "1 2 3 4 5 6 7 8 9 1 2 3 4 5 6";
    let cases = [
        ("plain", good.clone()),
        ("carriage returns", good.replace('\n', "\r\n")),
        ("old carriage returns", good.replace('\n', "\r")),
        (
            "byte-order mark, lower case",
            format!("\u{feff}{}", good.to_lowercase()),
        ),
        ("no HIERARCHY", good.replace("HIERARCHY\n", "")),
        (
            "braces on the line of the name",
            good.replace("\n{", " {").replace("\n\t{", " {"),
        ),
        (
            "a leaf without end",
            good.replace("\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 5 0 0\n\t\t}\n", ""),
        ),
        ("a named end", good.replace("End Site", "End Site Tip")),
        ("no offset", good.replace("\t\tOFFSET 10.5 0 -1e-1\n", "")),
        (
            "scale channels",
            good.replace("3 Zrotation Xrotation Yrotation", "3 Xscale Xrotation Yrotation"),
        ),
        ("a count that differs", good.replace("CHANNELS 3", "CHANNELS 4")),
        ("wrong frames", good.replace("Frames: 4", "Frames: 400")),
        ("no frames", good.replace("Frames: 4\n", "")),
        ("no colon", good.replace("Frame Time:", "Frame Time")),
        ("a long frame time", good.replace("0.0083333", "2.5")),
        ("zero frame time", good.replace("0.0083333", "0")),
        ("no motion", HEAD.to_owned()),
        ("all on one line", rows(&format!("{row} {row} {row}\n"))),
        ("a row broken off", rows(&format!("{row}\n1 2 3 4\n"))),
        ("text after the last frame", rows(&format!("{row}\nend of file\n"))),
        (
            "long numbers",
            rows(&format!(
                "{}\n{}\n",
                row.replace('9', "0.12345678901234567890"),
                row.replace('4', "1e-30")
            )),
        ),
        (
            "rotations first",
            rows(&format!(
                "{}\n",
                (0..5)
                    .map(|n| format!("{n} -{n} {n} 0.1 93.{n} 4 7 8 9 1 2 3 4 5 6"))
                    .collect::<Vec<_>>()
                    .join("\n")
            )),
        ),
        ("too few numbers", rows("1 2 3\n4 5\n")),
        ("a word", rows(&row.replace('7', "x7"))),
        ("not a number", rows(&row.replace('7', "nan"))),
        ("a decimal comma", rows(&row.replace('7', "7,5"))),
        ("too large", rows(&row.replace('7', "1e400"))),
        ("no frame time", good.replace("Frame Time: 0.0083333\n", "")),
        ("a brace too few", good.replacen("\t}\n", "", 1)),
        ("a brace too many", good.replacen("\t}\n", "\t}\n\t}\n", 1)),
        ("two roots", good.replace("\tJOINT Leg", "ROOT Leg")),
        ("unknown channel", good.replace("Zposition Y", "Wposition Y")),
        (
            "two offsets",
            good.replace("\t\tOFFSET 1 -40 0\n", "\t\tOFFSET 1 -40 0\n\t\tOFFSET 1 2 3\n"),
        ),
        ("a short offset", good.replace("OFFSET 1 -40 0", "OFFSET 1 -40")),
        ("empty", String::new()),
        ("other text", "ROOT\n".to_owned()),
        ("a table", "a,b\n1,2\n".to_owned()),
    ];
    for (name, text) in &cases {
        put(&mut out, format!("## {name}"));
        let moving = [
            "plain",
            "a leaf without end",
            "no offset",
            "scale channels",
            "rotations first",
        ];
        if let Err(error) = captured(&mut out, text, moving.contains(name)) {
            put(&mut out, format!("refused: {error}"));
        }
    }
    compare("bvh", &out);
}

#[test]
fn golden_files_of_curves() {
    let mut out = String::new();
    let masks = |on: &[usize]| {
        let bits = (1..=68).map(|at| if on.contains(&at) { "1" } else { "0" });
        bits.collect::<Vec<_>>().join(" ")
    };
    let fap = format!("2.1 face 25 2\n{}\n0 120\n{}\n1 100 -7\n", masks(&[3]), masks(&[3, 31]));
    let texts = [
        "Timecode,BlendShapeCount,JawOpen,HeadYaw\n23:59:59:58.500,61,0.25,-0.1473\n23:59:59:59.500,61,0.5,0.1\n\
         00:00:00:00.500,61,,0.2\n",
        "Timecode,BlendshapeCount,HeadRoll\n00:00:00:00.0,52,12.5\n00:00:00:01.0,52,1\n00:00:01:30.0,52,1\n",
        "frame, timestamp, confidence, success, pose_Tx, AU01_r\n1, 0, 0.9, 1, 3.5, 0.1\n2, 0.04, 0.1, 0, 0, 0\n",
        r#"[{"timestampMs": 0, "faceBlendshapes": [{"categories": [{"categoryName": "_neutral", "score": 1e-6}, {"categoryName": "jawOpen", "score": 0.5}]}]},
        {"timestampMs": 40, "faceBlendshapes": []},
        {"timestampMs": 80, "faceBlendshapes": [{"categories": [{"categoryName": "jawOpen", "score": 0.25}]}]}]"#,
        fap.as_str(),
        "time [s],force [N],\"a,b\"\n0.500000,1.50,\n0.510000,,2e-3\n0.53,1,2\n",
        "frame;x\n1;0,5\n2;0,75\n",
        "time,x\n0,1\n0,2\n",
        "a,b\nx,y\n",
        "# proto-message: ClassificationList\nclassification {\n  index: 0\n  score: 2.9e-05\n  label: \"_neutral\"\n}\n\
         classification {\n  index: 1\n  score: 0.79\n  label: \"browDownLeft\"\n}\n",
        "",
    ];
    for text in texts {
        let head: String = text.chars().take(60).collect();
        put(
            &mut out,
            format!(
                "## {head:?}: {:?}",
                crate::curves::CurveFile::detect_curve_file(text.as_bytes())
            ),
        );
        match crate::curves::read_curves(text.as_bytes()) {
            Ok((read, found)) => {
                tracks(&mut out, &read);
                findings(&mut out, &found);
                for track in &read.tracks {
                    if let CapturedTrackContent::Curves(it) = &track.content {
                        put(&mut out, crate::curves::tests::write_curves_csv(it, track.offset));
                        put(
                            &mut out,
                            crate::curves::tests::write_curves_csv(it, RecordingInstant::from_millis(250)),
                        );
                    }
                }
            }
            Err(error) => put(&mut out, format!("refused: {error}")),
        }
    }
    compare("curve_files", &out);
}

#[test]
fn golden_faces_of_every_system() {
    let mut out = String::new();
    let rate = FrameRate::new(30, 1).expect("a rate");
    for system in FaceSystem::all_face_systems() {
        put(&mut out, format!("## {} {} {}", system.id, system.version, system.name));
        // Each channel rises and falls at its own time, and has a gap.
        let scale = if system.id == "fap" { 400.0 } else { 1.0 };
        let channel = |(n, name): (usize, &String)| {
            let value = |frame: i32| match frame == n as i32 % 7 + 20 {
                true => f64::NAN,
                false => scale * (0.5 + 0.5 * (0.3 * f64::from(frame) + 0.9 * n as f64).sin()),
            };
            ScalarCurve::new(
                name.clone(),
                FrameNumberColumn::from_double_floats((0..40).map(value).collect()),
            )
        };
        let all = system.channels.iter().enumerate().map(channel);
        let all: Vec<ScalarCurve> = all.filter(|it| !it.name.is_empty()).collect();
        let Ok(captured) = CurveTrack::new(FrameTimes::Even(rate), all) else {
            put(&mut out, "no channels of its own");
            continue;
        };
        let found = FaceSystem::system_of_curves(&captured).map(|it| it.id.as_str());
        put(&mut out, format!("recognised as {found:?}"));
        let mut view = system.derive_face_view(&captured);
        put(&mut out, format!("known {:?} bridged {}", view.known, view.bridged));
        findings(&mut out, &view.findings);
        let shown = |out: &mut String, faces: &[FacePosture]| {
            for face in faces.iter().step_by(6) {
                put(out, format!("{:?}", face.face_numbers()));
            }
        };
        shown(&mut out, &view.faces);
        for (name, all) in [("head", &view.head), ("place", &view.place)] {
            let some: Option<Vec<[f64; 3]>> = all.as_ref().map(|it| it.iter().copied().step_by(9).collect());
            put(&mut out, format!("{name} {some:?}"));
        }
        let Some(fit) = FaceCalibration::calibration_from_view(&view) else {
            put(&mut out, "nothing to fit");
            continue;
        };
        put(&mut out, format!("{fit:?} suits {}", fit.is_calibration_for(&view)));
        put(
            &mut out,
            format!("untried {:?}", fit.untried_number_names().collect::<Vec<_>>()),
        );
        fit.apply_face_calibration(&mut view);
        shown(&mut out, &view.faces);
        let first = CurveTrack::new(FrameTimes::Even(rate), captured.track_curves()[..1].to_vec());
        curves(&mut out, &first.expect("a curve"));
    }
    compare("faces", &out);
}
