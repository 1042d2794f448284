//! Tests of reading OpenPose and MediaPipe JSON: people followed over frames, gaps, units, and refused files.

use chereme_motion::{Capture, Space};

use super::*;
use crate::tracks::Content;

fn person(x: f64) -> String {
    format!(
        "{{\"person_id\":[-1],\"pose_keypoints_2d\":[{x},20.25,0.9,0,0,0],\"hand_left_keypoints_2d\":[]}}"
    )
}

fn frame(people: &[f64]) -> String {
    let people: Vec<String> = people.iter().map(|x| person(*x)).collect();
    format!("{{\"version\":1.3,\"people\":[{}]}}", people.join(","))
}

fn points(track: &FileTrack) -> &chereme_motion::Markers {
    match &track.content {
        Content::Markers(markers) => markers,
        Content::Curves(_) => panic!("points"),
    }
}

#[test]
fn frame_files_are_named_by_a_prefix_and_a_number() {
    let name = "my_take_000000000012_keypoints.json";
    assert_eq!(frame_of_name(name), Some(("my_take", 12)));
    for other in [
        "_1_keypoints.json",
        "take_keypoints.json",
        "take_x_keypoints.json",
        "take_1.json",
    ] {
        assert_eq!(frame_of_name(other), None, "{other}");
    }
}

#[test]
fn people_are_tracked_if_their_order_changes_and_missing_frames_are_gaps() {
    let mut reader = Reader::default();
    for (number, people) in [
        (7, vec![100.0, 500.0]),
        (8, vec![505.0, 101.0]),
        (10, vec![102.0]),
    ] {
        reader
            .push(Some(number), frame(&people).as_bytes())
            .expect("read");
    }
    let (tracks, findings) = reader.finish(None).expect("points");
    assert_eq!(tracks.tracks.len(), 2);
    let first = points(&tracks.tracks[0]);
    let x = |frame: usize| first.points()[0].at(frame).map(|at| at.x);
    assert_eq!(
        (0..4).map(x).collect::<Vec<_>>(),
        [Some(100.0), Some(101.0), None, Some(102.0)]
    );
    assert_eq!(
        points(&tracks.tracks[1]).points()[0].at(1).map(|at| at.x),
        Some(505.0)
    );
    assert_eq!(points(&tracks.tracks[1]).frames(), 4);
    assert_eq!(first.points()[1].at(0), None, "0, 0, 0 is a gap");
    assert_eq!(
        (first.capture(), first.space().name()),
        (Capture::Estimated, "image-2d")
    );
    assert!(
        findings
            .iter()
            .any(|it| it.message.contains("25 frames a second"))
    );
}

#[test]
fn a_film_of_several_cameras_keeps_their_sizes() {
    let frames = format!(
        "\"frames\":{{\"0\":{},\"1\":{}}}",
        frame(&[1.5]),
        frame(&[2.5])
    );
    let text = format!(
        "[{{\"camera\":\"a1\",\"width\":1280,\"height\":720,{frames}}},{{\"camera\":\"b1\",\"width\":640,\"height\":360,{frames}}}]"
    );
    assert!(is_keypoints(text.as_bytes()));
    let mut reader = Reader::default();
    reader.push(None, text.as_bytes()).expect("read");
    let (tracks, _) = reader
        .finish(chereme_motion::Rate::new(50, 1).ok())
        .expect("points");
    let names: Vec<&str> = tracks.tracks.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["a1 landmarks", "b1 landmarks"]);
    let Space::Image(size) = points(&tracks.tracks[1]).space() else {
        panic!("a picture")
    };
    assert_eq!((size.width, size.height), (640.0, 360.0));
}

#[test]
fn landmarks_of_mediapipe_are_shares_of_the_picture_and_metres() {
    let mark = r#"{"x":0.25,"y":0.5,"z":-0.125,"visibility":0.75}"#;
    let marks = vec![mark; 33].join(",");
    let text = format!(
        "[{{\"timestampMs\":0,\"poseLandmarks\":[{marks}],\"poseWorldLandmarks\":[{marks}]}},\
          {{\"timestampMs\":40,\"poseLandmarks\":[{marks}]}}]"
    );
    assert!(is_keypoints(text.as_bytes()));
    for (asked, reported) in [(25, 0), (50, 1)] {
        let mut reader = Reader::default();
        reader.push(None, text.as_bytes()).expect("read");
        let rate = chereme_motion::Rate::new(asked, 1).expect("a rate");
        let (tracks, findings) = reader.finish(Some(rate)).expect("points");
        assert_eq!(points(&tracks.tracks[0]).times().rate(), Some(rate));
        let found = findings.iter().filter(|it| it.message.contains("25 fps"));
        assert_eq!(found.count(), reported, "{findings:?}");
    }
    let mut reader = Reader::default();
    reader.push(None, text.as_bytes()).expect("read");
    let (tracks, findings) = reader.finish(None).expect("points");
    let kinds: Vec<&str> = tracks
        .tracks
        .iter()
        .map(|it| points(it).space().name())
        .collect();
    assert_eq!(kinds, ["image-2.5d", "world-3d"]);
    let world = points(&tracks.tracks[1]);
    assert_eq!(world.frames(), 2);
    assert_eq!(world.points()[16].name, "RIGHT_WRIST");
    assert_eq!(world.points()[16].at(1), None);
    assert_eq!(world.times().rate().map(|it| it.per_second()), Some(25.0));
    assert!(!findings.iter().any(|it| it.message.contains("rate")));
}

#[test]
fn files_without_points_are_refused() {
    for text in [
        "{",
        "[]",
        "{\"people\":[]}",
        "{\"people\":3}",
        "[{\"frames\":{\"x\":{}}}]",
        "{\"frames\":{\"99999999999\":{\"people\":[]},\"1\":{}}}",
    ] {
        let mut reader = Reader::default();
        let pushed = reader.push(None, text.as_bytes());
        let done = pushed.and_then(|()| reader.finish(None));
        assert!(done.is_err(), "{text}");
    }
}

/// The number of a frame and the text of its file.
type File = (Option<u64>, String);

#[test]
fn golden_points_of_people_on_film() {
    use crate::golden::{compare, put};
    use crate::tests::{findings, tracks};
    let mut out = String::new();
    let mark = |n: usize| {
        format!(
            r#"{{"x":{},"y":{},"z":-0.125,"visibility":0.{n}5}}"#,
            0.01 * n as f64,
            0.5 - 0.02 * n as f64
        )
    };
    let marks: Vec<String> = (0..33).map(mark).collect();
    let marks = marks.join(",");
    let frames = format!(
        "\"frames\":{{\"0\":{},\"1\":{}}}",
        frame(&[1.5]),
        frame(&[2.5, 90.0])
    );
    let cases: [(&str, Vec<File>); 5] = [
        (
            "people who change places",
            vec![
                (Some(7), frame(&[100.0, 500.0])),
                (Some(8), frame(&[505.0, 101.0])),
                (Some(10), frame(&[102.0])),
                (Some(11), frame(&[700.0, 103.0, 498.0])),
            ],
        ),
        (
            "cameras",
            vec![(
                None,
                format!(
                    "[{{\"camera\":\"a1\",\"width\":1280,\"height\":720,{frames}}},{{\"camera\":\"b1\",{frames}}}]"
                ),
            )],
        ),
        (
            "landmarks",
            vec![(
                None,
                format!(
                    "[{{\"timestampMs\":0,\"poseLandmarks\":[{marks}],\"poseWorldLandmarks\":[{marks}]}},{{\"timestampMs\":40,\"leftHandLandmarks\":[{marks}]}}]"
                ),
            )],
        ),
        ("nobody", vec![(Some(1), "{\"people\":[]}".to_owned())]),
        ("no JSON", vec![(Some(1), "{".to_owned())]),
    ];
    for (name, files) in cases {
        for rate in [None, chereme_motion::Rate::new(50, 1).ok()] {
            put(&mut out, format!("## {name} {rate:?}"));
            let mut reader = Reader::default();
            let pushed = files
                .iter()
                .try_for_each(|(number, text)| reader.push(*number, text.as_bytes()));
            match pushed.and_then(|()| reader.finish(rate)) {
                Ok((read, found)) => {
                    tracks(&mut out, &read);
                    findings(&mut out, &found);
                }
                Err(error) => put(&mut out, format!("refused: {error}")),
            }
        }
    }
    compare("keypoints", &out);
}
