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
                let values = places[3 * point..3 * point + 3]
                    .iter()
                    .chain([&sure[point]]);
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

fn markers(bytes: &[u8]) -> Markers {
    let (tracks, _) = read(bytes).unwrap_or_else(|error| panic!("{error}"));
    match tracks.tracks[0].content.clone() {
        Content::Markers(markers) => markers,
        Content::Curves(_) => panic!("markers"),
    }
}

#[test]
fn three_versions_read_to_equal_data() {
    let expected = markers(&file(0.2));
    assert_eq!(markers(&file(0.1)), expected);
    assert_eq!(markers(&file(0.0)), expected);
    assert_eq!(expected.space().name(), "image-2.5d");
    assert_eq!(expected.capture(), Capture::Estimated);
    assert_eq!(
        expected.limbs(),
        [[0, 1]],
        "a limb that is repeated counts once"
    );
    let tip = &expected.points()[1];
    assert_eq!(tip.at(0).map(|at| at.to_array()), Some([4.0, 5.0, 6.0]));
    assert_eq!(tip.at(1), None, "confidence 0 is a gap");
}

#[test]
fn damaged_files_are_refused() {
    for version in [0.0, 0.1, 0.2] {
        let whole = file(version);
        for end in 0..whole.len() {
            assert!(read(&whole[..end]).is_err(), "{version}: {end}");
            let mut changed = whole.clone();
            changed[end] ^= 0xff;
            let _ = read(&changed);
        }
    }
    assert_eq!(read(&7f32.to_le_bytes()), Err(Error::Version("7".into())));
}

#[test]
fn files_of_others_hold_the_known_values() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let (mut folders, mut files) = (
        vec![std::path::Path::new(&folder).join("motion/pose")],
        Vec::new(),
    );
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
        let (tracks, _) = read(&bytes).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        let stem = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let Content::Markers(markers) = &tracks.tracks[0].content else {
            panic!("markers");
        };
        if stem == "sample-data-example" {
            assert_eq!((markers.frames(), tracks.tracks.len()), (97, 2));
            let tip = markers
                .points()
                .iter()
                .find(|point| {
                    point.group.starts_with("RIGHT_HAND") && point.name == "INDEX_FINGER_TIP"
                })
                .expect("the tip");
            let at = tip.at(50).expect("a place");
            assert!(
                (at.x - 110.07).abs() < 1e-4 && (at.y - 90.55587).abs() < 1e-4,
                "{at}"
            );
            let Content::Markers(world) = &tracks.tracks[1].content else {
                panic!("markers");
            };
            let widest = world
                .shown(0)
                .into_iter()
                .flatten()
                .map(|at| at.length())
                .fold(0.0, f64::max);
            assert!(widest < 2.0, "metres from the hips: {widest}");
        }
        if stem == "openpose" {
            let wrist = markers
                .points()
                .iter()
                .find(|point| point.name == "RWrist")
                .expect("a wrist");
            let at = wrist.at(10).expect("a place");
            assert!(
                (at.x - 107.012).abs() < 1e-3 && (at.y - 233.02299).abs() < 1e-3,
                "{at}"
            );
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
            match read(&whole[..cut]) {
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
