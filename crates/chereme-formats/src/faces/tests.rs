//! Face systems as data, and the meaning of captures of each.

use chereme_motion::{CurveTrack, FacePosture, FrameNumberColumn, FrameRate, FrameTimes, ScalarCurve};

use super::formula::FaceFormula;
use super::{DerivedFaceView, FaceSystem};
use crate::tracks::CapturedTrackContent;

fn curves(channels: &[(&str, &[f64])]) -> CurveTrack {
    let curve = |(name, values): &(&str, &[f64])| {
        ScalarCurve::new(*name, FrameNumberColumn::from_double_floats(values.to_vec()))
    };
    let rate = FrameTimes::Even(FrameRate::new(30, 1).expect("a rate"));
    CurveTrack::new(rate, channels.iter().map(curve).collect()).expect("a track")
}

fn view(channels: &[(&str, &[f64])]) -> DerivedFaceView {
    let curves = curves(channels);
    FaceSystem::system_of_curves(&curves)
        .expect("a system")
        .derive_face_view(&curves)
}

fn says(view: &DerivedFaceView, text: &str) -> bool {
    view.findings.iter().any(|it| it.message.contains(text))
}

#[test]
fn every_face_system_is_complete() {
    let ids: Vec<&str> = FaceSystem::all_face_systems().iter().map(|it| it.id.as_str()).collect();
    assert_eq!(ids, ["house", "mediapipe", "arkit", "openface", "fap", "sigml", "mesh"]);
    for system in FaceSystem::all_face_systems() {
        let id = &system.id;
        let formulas = system.house.iter().chain(&system.head).chain(&system.place);
        for (name, text) in formulas {
            let formula = FaceFormula::parse_face_formula(text).unwrap_or_else(|error| panic!("{id} {name}: {error}"));
            for channel in formula.formula_channel_names() {
                let older = ["gaze_0_", "gaze_1_"].iter().any(|start| channel.starts_with(start));
                let known = system.channels.iter().any(|it| it.eq_ignore_ascii_case(channel)) || older;
                assert!(known, "{id} {name}: {channel}");
            }
        }
        for name in system.house.keys().chain(&system.unknown) {
            assert!(FacePosture::face_number_position(name).is_some(), "{id}: {name}");
        }
        for name in FacePosture::FACE_NUMBER_NAMES {
            let listed = system.house.contains_key(name) ^ system.unknown.iter().any(|it| it == name);
            assert!(listed || system.expressions, "{id} says nothing about {name}, or both");
        }
        for loss in &system.loses {
            let known = |it: &String| it == "head" || FacePosture::face_number_position(it).is_some();
            assert!(loss.channels.iter().all(known), "{id}: {:?}", loss.channels);
        }
    }
    let count = |id: &str| FaceSystem::find_face_system(id).map(|it| it.channels.len());
    assert_eq!(
        [count("arkit"), count("mediapipe"), count("fap")],
        [Some(61), Some(52), Some(68)]
    );
}

#[test]
fn captures_are_recognised_by_their_channels() {
    let cases: [(&[&str], Option<&str>); 7] = [
        (&["jawopen", "BrowInnerUp", "eyeBlinkLeft"], Some("arkit")),
        (
            &["_neutral", "jawOpen", "browInnerUp", "eyeBlinkLeft"],
            Some("mediapipe"),
        ),
        (&["AU01_r", "AU04_r", "AU12_r"], Some("openface")),
        (&["FAP31", "FAP32"], Some("fap")),
        (&["raise_l_i_eyebrow"], Some("fap")),
        (&["brow_raise_right", "jaw_open"], Some("house")),
        (&["force", "moment"], None),
    ];
    for (names, id) in cases {
        let channels: Vec<(&str, &[f64])> = names.iter().map(|name| (*name, &[0.0][..])).collect();
        let found = FaceSystem::system_of_curves(&curves(&channels)).map(|it| it.id.as_str());
        assert_eq!(found, id, "{names:?}");
    }
}

#[test]
fn shapes_of_arkit_are_a_face_and_its_brows_have_no_side() {
    let it = view(&[
        ("JawOpen", &[0.6, 0.6]),
        ("MouthClose", &[0.6, 0.0]),
        ("BrowInnerUp", &[1.0, 0.0]),
        ("BrowOuterUpLeft", &[1.0, 0.0]),
        ("BrowOuterUpRight", &[1.0, 0.0]),
        ("BrowDownLeft", &[0.0, 1.0]),
        ("BrowDownRight", &[0.0, 1.0]),
        ("EyeBlinkLeft", &[1.0, 0.0]),
        ("EyeSquintLeft", &[1.0, 0.5]),
        ("EyeWideLeft", &[0.0, 0.0]),
        ("MouthUpperUpLeft", &[0.0, 0.0]),
        ("MouthUpperUpRight", &[0.0, 0.0]),
        ("MouthLowerDownLeft", &[0.0, 0.0]),
        ("MouthLowerDownRight", &[0.0, 0.0]),
    ]);
    assert_eq!((it.faces[0].brows, it.faces[0].lids[1]), ([1.0, 1.0], 1.0));
    assert_eq!((it.faces[1].brows, it.faces[1].frown), ([-0.5, -0.5], 1.0));
    assert_eq!(
        (it.faces[1].lids[1], it.faces[0].parted, it.faces[1].parted),
        (0.25, 0.0, 0.3)
    );
    assert!(says(&it, "single raised brow cannot be seen"));
    assert!(says(&it, "lacks channels for eye_close_right"));
    assert_eq!(it.face_number_values("eye_close_right"), None, "unknown is not at rest");
    assert_eq!(it.face_number_values("jaw_open"), Some(vec![0.6, 0.6]));
}

#[test]
fn shapes_are_known_by_short_sides_and_as_percent() {
    let usual = view(&[
        ("JawOpen", &[0.0, 0.5]),
        ("BrowInnerUp", &[0.0, 0.8]),
        ("EyeBlinkLeft", &[0.1, 1.0]),
        ("EyeBlinkRight", &[0.1, 1.0]),
        ("HeadYaw", &[0.0, 0.4]),
        ("HeadPitch", &[0.0, 0.1]),
        ("HeadRoll", &[0.0, 0.1]),
    ]);
    let short = view(&[
        ("jawOpen", &[0.0, 50.0]),
        ("browInnerUp", &[0.0, 80.0]),
        ("eyeBlink_L", &[10.0, 100.0]),
        ("EYEBLINK_R", &[10.0, 100.0]),
        ("HeadYaw", &[0.0, 0.4]),
        ("HeadPitch", &[0.0, 0.1]),
        ("HeadRoll", &[0.0, 0.1]),
    ]);
    assert_eq!(short.known, usual.known);
    for (a, b) in short.faces.iter().zip(&usual.faces) {
        let pairs = a.face_numbers().into_iter().zip(b.face_numbers());
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12));
    }
    assert_eq!(short.head, usual.head);
    assert!(says(&short, "percent") && !says(&usual, "percent"));
}

#[test]
fn parameters_of_mpeg_4_keep_both_sides_and_the_head() {
    let it = view(&[
        ("FAP31", &[300.0]),
        ("FAP33", &[300.0]),
        ("FAP35", &[300.0]),
        ("raise_r_i_eyebrow", &[0.0]),
        ("FAP34", &[0.0]),
        ("FAP36", &[-150.0]),
        ("FAP23", &[61_087.0]),
        ("FAP24", &[61_087.0]),
        ("FAP48", &[10_000.0]),
        ("FAP49", &[-20_000.0]),
        ("FAP50", &[0.0]),
    ]);
    let face = it.faces[0];
    assert_eq!(face.brows[1], 1.0);
    assert!((face.brows[0] + 1.0 / 6.0).abs() < 1e-12, "{:?}", face.brows);
    assert_eq!(face.gaze[0], 1.0);
    assert_eq!(it.head, Some(vec![[0.1, -0.2, 0.0]]));
    assert!(!says(&it, "single raised brow"));
}

#[test]
fn scores_of_mediapipe_leave_cheeks_nose_and_tongue_unknown() {
    let channels = [
        ("_neutral", &[0.0][..]),
        ("jawOpen", &[0.3]),
        ("browInnerUp", &[0.0]),
        ("cheekPuff", &[0.0]),
    ];
    let it = view(&channels);
    for name in ["cheek_puff_left", "nose_wrinkle", "tongue_out"] {
        assert_eq!(it.face_number_values(name), None, "{name}");
    }
    assert!(says(&it, "there is no tongue") && says(&it, "cheeks and nose hardly react"));
}

#[test]
fn gaps_are_bridged_and_counted_and_a_still_head_is_reported() {
    let gap = f64::NAN;
    let it = view(&[
        ("brow_raise_right", &[0.0, gap, 1.0, gap]),
        ("jaw_open", &[gap, 0.5, gap, 0.5]),
        ("head_pitch", &[0.0; 4]),
        ("head_yaw", &[0.0; 4]),
        ("head_roll", &[0.0; 4]),
    ]);
    assert_eq!(
        it.face_number_values("brow_raise_right"),
        Some(vec![0.0, 0.5, 1.0, 1.0])
    );
    assert_eq!((it.bridged, it.face_number_values("jaw_open")), (4, Some(vec![0.5; 4])));
    assert_eq!(it.head, None);
    assert!(says(&it, "turns of the head are all 0"));
}

#[test]
fn sides_that_were_exchanged_are_reported() {
    let up: Vec<f64> = (0..40).map(|n| (f64::from(n) * 0.3).sin().max(0.0)).collect();
    let down: Vec<f64> = (0..40).map(|n| (-f64::from(n) * 0.3).sin().max(0.0)).collect();
    let base = |left: &[f64]| {
        let still = vec![0.0; 40];
        let names = [
            ("JawOpen", &still[..]),
            ("BrowInnerUp", &still),
            ("EyeBlinkLeft", &still),
            ("JawLeft", &up),
            ("MouthLeft", left),
        ];
        says(&view(&names), "move against each other")
    };
    assert!(base(&down) && !base(&up));
}

#[test]
fn faces_of_others_are_seen_as_faces() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let folder = std::path::Path::new(&folder).join("face");
    for (path, id) in [
        ("alexdjulin-LiveLinkFace/alex_rom_4.csv", "arkit"),
        ("think-biq-LLV/dao_decoded.csv", "arkit"),
        ("cosanlab-py-feat/OpenFace_Test.csv", "openface"),
    ] {
        let bytes = std::fs::read(folder.join(path)).expect("a file");
        let (tracks, _) = crate::curves::read_curves(&bytes).expect("read");
        let CapturedTrackContent::Curves(curves) = &tracks.tracks[0].content else {
            panic!("curves");
        };
        let system = FaceSystem::system_of_curves(curves).expect("a system");
        let view = system.derive_face_view(curves);
        assert_eq!((system.id.as_str(), view.faces.len()), (id, curves.curve_frame_count()));
        let moves = |name: &str| {
            let values = view.face_number_values(name).expect(name);
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            most - values.iter().copied().fold(f64::INFINITY, f64::min)
        };
        let mouth = (id == "arkit").then_some("lips_part");
        let upper = ["brow_raise_right", "eye_close_left", "gaze_left"];
        for name in upper.into_iter().chain(mouth) {
            assert!(moves(name) > 0.005, "{path}: {name} {}", moves(name));
        }
        // In one of the takes the jaw's left moves with the mouth's right (r = 0.98): one pair is exchanged.
        let exchanged = path.starts_with("think-biq");
        assert_eq!(says(&view, "move against each other"), exchanged, "{path}");
    }
    let path = "google-ai-edge-mediapipe/portrait_expected_blendshapes.pbtxt";
    let bytes = std::fs::read(folder.join(path)).expect("a file");
    let (tracks, _) = crate::curves::read_curves(&bytes).expect("read");
    let CapturedTrackContent::Curves(scores) = &tracks.tracks[0].content else {
        panic!("curves");
    };
    let system = FaceSystem::system_of_curves(scores).map(|it| (it.id.as_str(), scores.track_curves().len()));
    assert_eq!(system, Some(("mediapipe", 52)));
}
