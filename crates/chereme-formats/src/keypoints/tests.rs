//! Tests of reading OpenPose and MediaPipe JSON: people followed over frames, gaps, units, and refused files.

use chereme_motion::{CaptureMethod, MarkerSpace};

use super::*;
use crate::tracks::CapturedTrackContent;

fn person(x: f64) -> String {
    format!("{{\"person_id\":[-1],\"pose_keypoints_2d\":[{x},20.25,0.9,0,0,0],\"hand_left_keypoints_2d\":[]}}")
}

fn frame(people: &[f64]) -> String {
    let people: Vec<String> = people.iter().map(|x| person(*x)).collect();
    format!("{{\"version\":1.3,\"people\":[{}]}}", people.join(","))
}

fn points(track: &FileTrack) -> &chereme_motion::MarkerTrack {
    match &track.content {
        CapturedTrackContent::Markers(markers) => markers,
        CapturedTrackContent::Curves(_) => panic!("points"),
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
    let mut reader = KeypointReader::default();
    for (number, people) in [(7, vec![100.0, 500.0]), (8, vec![505.0, 101.0]), (10, vec![102.0])] {
        reader
            .push_keypoint_document(Some(number), frame(&people).as_bytes())
            .expect("read");
    }
    let (tracks, findings) = reader.finish_keypoint_tracks(None).expect("points");
    assert_eq!(tracks.tracks.len(), 2);
    let first = points(&tracks.tracks[0]);
    let x = |frame: usize| first.marker_points()[0].marker_position(frame).map(|at| at.x);
    assert_eq!(
        (0..4).map(x).collect::<Vec<_>>(),
        [Some(100.0), Some(101.0), None, Some(102.0)]
    );
    assert_eq!(
        points(&tracks.tracks[1]).marker_points()[0]
            .marker_position(1)
            .map(|at| at.x),
        Some(505.0)
    );
    assert_eq!(points(&tracks.tracks[1]).marker_frame_count(), 4);
    assert_eq!(first.marker_points()[1].marker_position(0), None, "0, 0, 0 is a gap");
    assert_eq!(
        (first.marker_capture(), first.marker_space().marker_space_name()),
        (CaptureMethod::Estimated, "image-2d")
    );
    assert!(findings.iter().any(|it| it.message.contains("25 frames a second")));
}

fn read(document: &str) -> (CapturedTracks, Vec<String>) {
    let mut reader = KeypointReader::default();
    reader
        .push_keypoint_document(None, document.as_bytes())
        .unwrap_or_else(|error| panic!("{error}\n{document}"));
    let (tracks, findings) = reader.finish_keypoint_tracks(None).expect("points");
    (tracks, findings.into_iter().map(|it| it.message).collect())
}

/// Returns x of the first point of a group in each frame of a track.
fn xs(track: &FileTrack, group: &str) -> Vec<Option<f64>> {
    let markers = points(track);
    let found = markers.marker_points().iter().find(|it| it.group == group);
    let point = found.unwrap_or_else(|| panic!("{group}"));
    (0..markers.marker_frame_count())
        .map(|frame| point.marker_position(frame).map(|at| at.x))
        .collect()
}

#[test]
fn people_with_numbers_keep_them_when_they_cross_and_leaps_are_reported() {
    let numbered = |people: &[(i64, f64)]| {
        let people = people
            .iter()
            .map(|(number, x)| person(*x).replace("[-1]", &format!("[{number}]")));
        format!("{{\"people\":[{}]}}", people.collect::<Vec<_>>().join(","))
    };
    let frames = [
        numbered(&[(7, 100.0), (3, 300.0)]),
        numbered(&[(3, 190.0), (7, 210.0)]),
        numbered(&[(7, 300.0)]),
    ];
    let (tracks, _) = read(&format!("[{}]", frames.join(",")));
    let group = "pose_keypoints_2d";
    assert_eq!(xs(&tracks.tracks[0], group), [Some(100.0), Some(210.0), Some(300.0)]);
    assert_eq!(xs(&tracks.tracks[1], group), [Some(300.0), Some(190.0), None]);
    let (tracks, _) = read(&format!("[{}]", frame(&[1.0, 200.0, 500.0])));
    let order: Vec<_> = tracks.tracks.iter().map(|it| xs(it, group)[0]).collect();
    assert_eq!(order, [Some(1.0), Some(200.0), Some(500.0)]);
    let wide = |x: f64| {
        format!(
            "{{\"people\":[{{\"pose_keypoints_2d\":[{x},20,0.9,{},20,0.9]}}]}}",
            x + 50.0
        )
    };
    for (next, is_said) in [(160.0, false), (900.0, true)] {
        let (_, findings) = read(&format!("[{},{}]", wide(100.0), wide(next)));
        let said = findings.iter().any(|it| it.contains("may be another one"));
        assert_eq!(said, is_said, "{findings:?}");
    }
}

#[test]
fn frames_have_the_numbers_and_times_that_the_file_states() {
    let pose = |more: &str, x: f64| format!("{{{more}\"poseLandmarks\":[{{\"x\":{x},\"y\":0.5}}]}}");
    let group = "poseLandmarks";
    let (tracks, findings) = read(&format!(
        "[{},{}]",
        pose("\"frame\":3,", 0.1),
        pose("\"frame\":5,", 0.2)
    ));
    assert_eq!(xs(&tracks.tracks[0], group), [Some(0.1), None, Some(0.2)]);
    assert!(
        findings
            .iter()
            .any(|it| it.starts_with("it begins with frame 3 of its film"))
    );
    let rates = [
        (
            format!("{{\"fps\":50,\"frames\":[{},{}]}}", pose("", 0.1), pose("", 0.2)),
            Some(50),
            0,
        ),
        (
            format!(
                "[{},{}]",
                pose("\"timestampMs\":2000,", 0.1),
                pose("\"timestampMs\":2040,", 0.2)
            ),
            Some(25),
            2000,
        ),
        (
            format!("[{},{}]", pose("\"timestamp\":0,", 0.1), pose("\"timestamp\":20,", 0.2)),
            Some(50),
            0,
        ),
        (
            format!(
                "[{},{}]",
                pose("\"timestamp\":0.5,", 0.1),
                pose("\"timestamp\":0.52,", 0.2)
            ),
            Some(50),
            500,
        ),
        (
            format!(
                "{{\"results\":[{},{},{}]}}",
                pose("\"time\":0,", 0.1),
                pose("\"time\":0.04,", 0.2),
                pose("\"time\":0.2,", 0.2)
            ),
            None,
            0,
        ),
    ];
    for (text, rate, offset) in rates {
        let (tracks, findings) = read(&text);
        let times = points(&tracks.tracks[0]).marker_times();
        assert_eq!(
            times.even_times_rate().map(|it| it.rate_numerator()),
            rate,
            "{text}: {findings:?}"
        );
        assert_eq!(tracks.tracks[0].offset.instant_millis(), offset, "{text}");
        if rate.is_none() {
            assert_eq!(times.frame_time_instant(2).instant_millis(), 200);
        }
    }
    let camera = |name: &str, begin: u32| {
        let frames: Vec<String> = (begin..12)
            .map(|at| format!("\"{at}\":{}", frame(&[f64::from(at)])))
            .collect();
        format!("{{\"camera\":\"{name}\",\"frames\":{{{}}}}}", frames.join(","))
    };
    let (tracks, _) = read(&format!("[{},{}]", camera("a", 10), camera("b", 8)));
    let group = "pose_keypoints_2d";
    assert_eq!(xs(&tracks.tracks[0], group), [None, None, Some(10.0), Some(11.0)]);
    assert_eq!(
        xs(&tracks.tracks[1], group),
        [Some(8.0), Some(9.0), Some(10.0), Some(11.0)]
    );
}

#[test]
fn hands_go_by_their_side_and_landmarks_may_be_lists_of_numbers() {
    let hand = |x: f64| {
        let marks: Vec<String> = (0..21).map(|_| format!("{{\"x\":{x},\"y\":0.5,\"z\":0}}")).collect();
        format!("[{}]", marks.join(","))
    };
    let both = |hands: [f64; 2], sides: [&str; 2]| {
        let [first, second] = hands.map(hand);
        let [one, other] = sides;
        [
            format!(
                "{{\"multiHandLandmarks\":[{first},{second}],\"multiHandedness\":[{{\"label\":\"{one}\"}},{{\"label\":\"{other}\"}}]}}"
            ),
            format!(
                "{{\"landmarks\":[{first},{second}],\"handedness\":[[{{\"categoryName\":\"{one}\"}}],[{{\"categoryName\":\"{other}\"}}]]}}"
            ),
        ]
    };
    for form in 0..2 {
        let frames = [
            both([0.25, 0.75], ["Left", "Right"]),
            both([0.75, 0.25], ["Right", "Left"]),
        ];
        let (tracks, findings) = read(&format!("[{},{}]", frames[0][form], frames[1][form]));
        assert_eq!(xs(&tracks.tracks[0], "leftHandLandmarks"), [Some(0.25); 2]);
        assert_eq!(xs(&tracks.tracks[0], "rightHandLandmarks"), [Some(0.75); 2]);
        let said = findings.iter().filter(|it| it.contains("takes the film for mirrored"));
        assert_eq!(said.count(), 1);
    }
    let (_, findings) = read(&format!("{{\"multiHandLandmarks\":[{},{}]}}", hand(0.25), hand(0.75)));
    assert!(
        findings[0].contains("does not state the sides of its hands"),
        "{findings:?}"
    );
    let numbers: Vec<String> = (0..33).map(|at| format!("[0.{at:02},0.5,-0.1,0.9]")).collect();
    let (tracks, _) = read(&format!("{{\"pose_landmarks\":[{}]}}", numbers.join(",")));
    let nose = &points(&tracks.tracks[0]).marker_points()[32];
    assert_eq!(
        (nose.name.as_str(), nose.marker_position(0).map(|at| at.x)),
        ("RIGHT_FOOT_INDEX", Some(0.32))
    );
}

#[test]
fn places_within_the_first_pixel_are_shares_of_the_picture() {
    for (x, begin) in [(0.5, "places are shares"), (-0.5, "places are from -1 to 1")] {
        let text = format!("{{\"people\":[{{\"pose_keypoints_2d\":[{x},0.2,0.9]}}]}}");
        let (_, findings) = read(&text);
        assert!(findings.iter().any(|it| it.starts_with(begin)), "{findings:?}");
    }
}

#[test]
fn a_film_of_several_cameras_keeps_their_sizes() {
    let frames = format!("\"frames\":{{\"0\":{},\"1\":{}}}", frame(&[1.5]), frame(&[2.5]));
    let text = format!(
        "[{{\"camera\":\"a1\",\"width\":1280,\"height\":720,{frames}}},{{\"camera\":\"b1\",\"width\":640,\"height\":360,{frames}}}]"
    );
    assert!(is_keypoints(text.as_bytes()));
    let mut reader = KeypointReader::default();
    reader.push_keypoint_document(None, text.as_bytes()).expect("read");
    let (tracks, _) = reader
        .finish_keypoint_tracks(chereme_motion::FrameRate::new(50, 1).ok())
        .expect("points");
    let names: Vec<&str> = tracks.tracks.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["a1 landmarks", "b1 landmarks"]);
    let MarkerSpace::Image(size) = points(&tracks.tracks[1]).marker_space() else {
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
        let mut reader = KeypointReader::default();
        reader.push_keypoint_document(None, text.as_bytes()).expect("read");
        let rate = chereme_motion::FrameRate::new(asked, 1).expect("a rate");
        let (tracks, findings) = reader.finish_keypoint_tracks(Some(rate)).expect("points");
        assert_eq!(points(&tracks.tracks[0]).marker_times().even_times_rate(), Some(rate));
        let found = findings.iter().filter(|it| it.message.contains("25 fps"));
        assert_eq!(found.count(), reported, "{findings:?}");
    }
    let mut reader = KeypointReader::default();
    reader.push_keypoint_document(None, text.as_bytes()).expect("read");
    let (tracks, findings) = reader.finish_keypoint_tracks(None).expect("points");
    let kinds: Vec<&str> = tracks
        .tracks
        .iter()
        .map(|it| points(it).marker_space().marker_space_name())
        .collect();
    assert_eq!(kinds, ["image-2.5d", "world-3d"]);
    let world = points(&tracks.tracks[1]);
    assert_eq!(world.marker_frame_count(), 2);
    assert_eq!(world.marker_points()[16].name, "RIGHT_WRIST");
    assert_eq!(world.marker_points()[16].marker_position(1), None);
    assert_eq!(
        world.marker_times().even_times_rate().map(|it| it.per_second()),
        Some(25.0)
    );
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
        let mut reader = KeypointReader::default();
        let pushed = reader.push_keypoint_document(None, text.as_bytes());
        let done = pushed.and_then(|()| reader.finish_keypoint_tracks(None));
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
    let frames = format!("\"frames\":{{\"0\":{},\"1\":{}}}", frame(&[1.5]), frame(&[2.5, 90.0]));
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
        for rate in [None, chereme_motion::FrameRate::new(50, 1).ok()] {
            put(&mut out, format!("## {name} {rate:?}"));
            let mut reader = KeypointReader::default();
            let pushed = files
                .iter()
                .try_for_each(|(number, text)| reader.push_keypoint_document(*number, text.as_bytes()));
            match pushed.and_then(|()| reader.finish_keypoint_tracks(rate)) {
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
