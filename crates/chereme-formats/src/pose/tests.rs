//! Tests of reading `.pose` files of all versions, damaged ones, and other people's files.

use super::*;

/// A file of one component with two points of three dimensions, and two frames.
fn file(version: f32) -> Vec<u8> {
    let mut bytes = version.to_le_bytes().to_vec();
    let short = |bytes: &mut Vec<u8>, value: u16| bytes.extend(value.to_le_bytes());
    let text = |bytes: &mut Vec<u8>, text: &str| {
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.bytes());
    };
    for size in [100, 50, 0, 1] {
        short(&mut bytes, size);
    }
    text(&mut bytes, "HAND");
    text(&mut bytes, "XYZC");
    for count in [2, 2, 1] {
        short(&mut bytes, count);
    }
    text(&mut bytes, "WRIST");
    text(&mut bytes, "TIP");
    for limb in [0, 1, 0, 1] {
        short(&mut bytes, limb);
    }
    bytes.extend([0; 6]);
    let places: [f32; 12] = [1., 2., 3., 4., 5., 6., 7., 8., 9., f32::NAN, 0., 0.];
    let sure: [f32; 4] = [1.0, 0.5, 0.9, 0.0];
    if version < 0.05 {
        short(&mut bytes, 25);
        short(&mut bytes, 2);
        for frame in 0..2 {
            short(&mut bytes, 1);
            short(&mut bytes, 0);
            for point in 2 * frame..2 * frame + 2 {
                let values = places[3 * point..3 * point + 3].iter().chain([&sure[point]]);
                bytes.extend(values.flat_map(|value| value.to_le_bytes()));
            }
        }
        return bytes;
    }
    if version < 0.15 {
        short(&mut bytes, 25);
        short(&mut bytes, 2);
    } else {
        bytes.extend(25f32.to_le_bytes());
        bytes.extend(2u32.to_le_bytes());
    }
    short(&mut bytes, 1);
    let values = places.iter().chain(&sure);
    bytes.extend(values.flat_map(|value| value.to_le_bytes()));
    bytes
}

fn markers(bytes: &[u8]) -> MarkerTrack {
    let (tracks, _) = read_pose_file(bytes).unwrap_or_else(|error| panic!("{error}"));
    match tracks.tracks[0].content.clone() {
        CapturedTrackContent::Markers(markers) => markers,
        CapturedTrackContent::Curves(_) => panic!("markers"),
    }
}

#[test]
fn three_versions_read_to_equal_data() {
    let expected = markers(&file(0.2));
    assert_eq!(markers(&file(0.1)), expected);
    assert_eq!(markers(&file(0.0)), expected);
    assert_eq!(expected.marker_space().marker_space_name(), "image-2.5d");
    assert_eq!(expected.marker_capture(), CaptureMethod::Estimated);
    assert_eq!(expected.marker_limbs(), [[0, 1]], "a limb that is repeated counts once");
    let tip = &expected.marker_points()[1];
    assert_eq!(tip.marker_position(0).map(|at| at.to_array()), Some([4.0, 5.0, 6.0]));
    assert_eq!(tip.marker_position(1), None, "confidence 0 is a gap");
}

/// A film of people with one point each: their numbers and x in each frame; 0 is a point that is not seen.
fn crowd(version: f32, frames: &[&[(i16, f32)]]) -> Vec<u8> {
    let text = |text: &str| [&(text.len() as u16).to_le_bytes(), text.as_bytes()].concat();
    let shorts = |all: &[u16]| all.iter().flat_map(|it| it.to_le_bytes()).collect::<Vec<u8>>();
    let mut bytes = version.to_le_bytes().to_vec();
    bytes.extend(shorts(&[100, 50, 0, 1]));
    bytes.extend([text("HAND"), text("XYC"), shorts(&[1, 0, 0]), text("WRIST")].concat());
    let count = frames.len() as u16;
    if version < 0.05 {
        bytes.extend(shorts(&[25, count]));
        for people in frames {
            bytes.extend(shorts(&[people.len() as u16]));
            for (number, x) in *people {
                bytes.extend(number.to_le_bytes());
                bytes.extend([*x, 1.0, x.signum()].iter().flat_map(|it| it.to_le_bytes()));
            }
        }
        return bytes;
    }
    bytes.extend(shorts(&[25, count, frames[0].len() as u16]));
    let all = || frames.iter().flat_map(|it| it.iter());
    bytes.extend(all().flat_map(|(_, x)| [*x, 1.0]).flat_map(f32::to_le_bytes));
    let sure = all().map(|(_, x)| if *x == 0.0 { 0.0 } else { 1.0 });
    bytes.extend(sure.flat_map(f32::to_le_bytes));
    bytes
}

#[test]
fn every_person_is_a_track_and_keeps_its_number() {
    let across: &[&[(i16, f32)]] = &[&[(4, 10.0), (9, 50.0)], &[(9, 51.0), (4, 11.0)], &[(9, 52.0)]];
    let unnumbered: &[&[(i16, f32)]] = &[&[(-1, 10.0), (-1, 50.0)], &[(-1, 11.0)]];
    let beside: &[&[(i16, f32)]] = &[&[(0, 10.0), (1, 50.0)], &[(0, 0.0), (1, 51.0)]];
    let late: &[&[(i16, f32)]] = &[&[(0, 0.0), (1, 50.0)], &[(0, 0.0), (1, 51.0)]];
    let nobody: &[&[(i16, f32)]] = &[&[], &[]];
    /// A version, a film, and x of every track by frames.
    type Case<'c> = (f32, &'c [&'c [(i16, f32)]], Vec<Vec<Option<f64>>>);
    let cases: [Case<'_>; 5] = [
        (
            0.0,
            across,
            vec![
                vec![Some(10.0), Some(11.0), None],
                vec![Some(50.0), Some(51.0), Some(52.0)],
            ],
        ),
        (
            0.0,
            unnumbered,
            vec![vec![Some(10.0), Some(11.0)], vec![Some(50.0), None]],
        ),
        (0.0, nobody, vec![vec![None, None]]),
        (0.1, beside, vec![vec![Some(10.0), None], vec![Some(50.0), Some(51.0)]]),
        (0.1, late, vec![vec![Some(50.0), Some(51.0)]]),
    ];
    for (version, film, expected) in cases {
        let (tracks, findings) = read_pose_file(&crowd(version, film)).expect("people");
        let found = tracks.tracks.iter().map(|track| {
            let CapturedTrackContent::Markers(markers) = &track.content else {
                panic!("markers");
            };
            let point = &markers.marker_points()[0];
            (0..markers.marker_frame_count())
                .map(|frame| point.marker_position(frame).map(|at| at.x))
                .collect()
        });
        let found: Vec<Vec<Option<f64>>> = found.collect();
        assert_eq!(found, expected, "{version} {film:?}");
        assert!(findings.iter().all(|it| !it.message.contains("more people")));
        let names = ["landmarks", "landmarks 2"];
        assert!(tracks.tracks.iter().zip(names).all(|(track, name)| track.name == name));
    }
    let many: Vec<(i16, f32)> = (0..20).map(|at| (at, 1.0)).collect();
    for version in [0.0, 0.1] {
        let (tracks, findings) = read_pose_file(&crowd(version, &[&many])).expect("people");
        assert_eq!(tracks.tracks.len(), MAX_POSE_PEOPLE);
        let text = "4 more people are in the film; only the first 16 were read";
        assert_eq!(findings[0].message, text);
    }
}

#[test]
fn components_of_the_same_name_are_groups_of_their_own() {
    let mut bytes = crowd(0.1, &[&[(0, 10.0)]]);
    let component = bytes[12..bytes.len() - 18].to_vec();
    bytes[10] = 2;
    bytes.splice(12..12, component);
    let frames = bytes.len() - 12;
    let point = [10.0f32, 1.0, 20.0, 2.0, 1.0, 1.0];
    bytes.truncate(frames);
    bytes.extend(point.iter().flat_map(|it| it.to_le_bytes()));
    let found = markers(&bytes);
    let groups: Vec<&str> = found.marker_points().iter().map(|it| it.group.as_str()).collect();
    assert_eq!(groups, ["HAND", "HAND (2)"]);
    assert_eq!(found.marker_points()[1].marker_position(0).map(|at| at.x), Some(20.0));
}

#[test]
fn damaged_files_are_refused() {
    for version in [0.0, 0.1, 0.2] {
        let whole = file(version);
        for end in 0..whole.len() {
            assert!(read_pose_file(&whole[..end]).is_err(), "{version}: {end}");
            let mut changed = whole.clone();
            changed[end] ^= 0xff;
            let _ = read_pose_file(&changed);
        }
    }
    assert_eq!(
        read_pose_file(&7f32.to_le_bytes()),
        Err(PoseFileError::Version("7".into()))
    );
}

#[test]
fn files_of_others_hold_the_known_values() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let (mut folders, mut files) = (vec![std::path::Path::new(&folder).join("motion/pose")], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.push(path);
            }
        }
    }
    assert_eq!(files.len(), 11);
    for path in files {
        let bytes = std::fs::read(&path).expect("a file");
        let (tracks, _) = read_pose_file(&bytes).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let CapturedTrackContent::Markers(markers) = &tracks.tracks[0].content else {
            panic!("markers");
        };
        if stem == "sample-data-example" {
            assert_eq!((markers.marker_frame_count(), tracks.tracks.len()), (97, 2));
            let tip = markers
                .marker_points()
                .iter()
                .find(|point| point.group.starts_with("RIGHT_HAND") && point.name == "INDEX_FINGER_TIP")
                .expect("the tip");
            let at = tip.marker_position(50).expect("a place");
            assert!((at.x - 110.07).abs() < 1e-4 && (at.y - 90.55587).abs() < 1e-4, "{at}");
            let CapturedTrackContent::Markers(world) = &tracks.tracks[1].content else {
                panic!("markers");
            };
            let widest = world
                .displayed_markers(0)
                .into_iter()
                .flatten()
                .map(|at| at.length())
                .fold(0.0, f64::max);
            assert!(widest < 2.0, "metres from the hips: {widest}");
        }
        if stem == "openpose" {
            let wrist = markers
                .marker_points()
                .iter()
                .find(|point| point.name == "RWrist")
                .expect("a wrist");
            let at = wrist.marker_position(10).expect("a place");
            assert!((at.x - 107.012).abs() < 1e-3 && (at.y - 233.02299).abs() < 1e-3, "{at}");
        }
    }
}

#[test]
fn golden_points_of_pose_files() {
    use crate::golden::{compare, put};
    use crate::tests::{findings, tracks};
    let mut out = String::new();
    for version in [0.0, 0.1, 0.2] {
        let whole = file(version);
        for cut in [whole.len(), whole.len() - 1, 30, 3] {
            put(&mut out, format!("## version {version}, {cut} bytes"));
            match read_pose_file(&whole[..cut]) {
                Ok((read, found)) => {
                    tracks(&mut out, &read);
                    findings(&mut out, &found);
                }
                Err(error) => put(&mut out, format!("refused: {error}")),
            }
        }
    }
    compare("pose", &out);
}
