//! Tests of reading FBX: bones, blend shapes, files without movement, hostile bytes, and other people's files.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodyPart};
use proptest::prelude::*;

use super::*;

/// A body of three bones below an armature of scale 100 in centimetres with Z up: 25 frames a second, one blend
/// shape; the spine has a pre-rotation and turns by a right angle.
const PLAIN: &str = include_str!("plain.fbx");

#[test]
fn bones_move_with_their_pre_rotations_below_the_scale_of_their_armature() {
    let (scene, findings) = read_fbx(PLAIN.as_bytes()).expect("an ASCII FBX");
    let clip = &scene.clip;
    let names: Vec<&str> = clip
        .clip_skeleton()
        .skeleton_joints()
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    assert_eq!(names, ["Armature", "Hips", "Spine", "Head"]);
    assert_eq!(
        (clip.clip_frame_count(), clip.clip_frame_rate().per_second()),
        (6, 25.0)
    );
    assert_eq!(scene.take.as_deref(), Some("Take 001"));
    assert!((scene.convention.metres_per_unit - 0.01).abs() < 1e-12);
    assert_eq!(scene.convention.axes.to_string(), "+Z,+X");
    let at = |frame: usize, joint: usize| clip.model_pose(frame).model_joint_position(joint);
    let near = |a: DVec3, b: [f64; 3]| a.distance(b.into()) < 1e-9;
    // The armature's scale of 100 makes 1 to a metre of centimetres.
    assert!(near(at(0, 1), [0.0, 0.0, 100.0]), "{}", at(0, 1));
    assert!(near(at(5, 1), [10.0, 0.0, 100.0]), "{}", at(5, 1));
    assert!(near(at(0, 2), [0.0, 0.0, 130.0]), "{}", at(0, 2));
    // The pre-rotation lays the spine along +X; the movement turns it up again.
    assert!(near(at(0, 3), [20.0, 0.0, 130.0]), "{}", at(0, 3));
    assert!(near(at(5, 3), [10.0, 0.0, 150.0]), "{}", at(5, 3));
    let model = scene.convention.file_clip_to_model(clip);
    let anatomy = BodyAnatomy::detect_anatomy(model.clip_skeleton());
    assert_eq!(anatomy.part_joint(BodyPart::Hips), Some(1));
    let head = model.model_pose(5).model_joint_position(3);
    assert!((head.y - 1.5).abs() < 1e-9, "{head}");
    assert!(findings.iter().all(|finding| finding.remedy.is_none()), "{findings:?}");
}

#[test]
fn the_weight_of_a_blend_shape_is_a_curve_from_0_to_1() {
    let (scene, _) = read_fbx(PLAIN.as_bytes()).expect("an ASCII FBX");
    let morphs = scene.morphs.expect("a curve");
    let [curve] = morphs.track_curves() else {
        panic!("{morphs:?}")
    };
    assert_eq!(curve.name, "jawOpen");
    let ends = [0, 5].map(|frame| curve.values.column_value_at(frame));
    assert_eq!(ends, [Some(0.0), Some(0.5)]);
}

#[test]
fn a_file_without_movement_is_one_frame_at_rest() {
    let (before, after) = PLAIN.split_once("\tAnimationStack: ").expect("a take");
    let (_, links) = after.split_once("Connections:").expect("links");
    let links: Vec<&str> = links.lines().filter(|line| !line.contains(",400")).collect();
    let still = format!("{before}}}\nConnections:{}\n", links.join("\n"));
    let (scene, findings) = read_fbx(still.as_bytes()).expect("its nodes");
    assert_eq!(scene.clip.clip_frame_count(), 1);
    assert!(
        findings.iter().any(|it| it.message.contains("no animation")),
        "{findings:?}"
    );
}

#[test]
fn a_take_without_end_is_refused_or_ends_with_its_keys() {
    for stop in ["9223372036854775807", "-5"] {
        let text = PLAIN.replace("9237231600", stop);
        assert_ne!(text, PLAIN);
        match read_fbx(text.as_bytes()) {
            Ok((scene, _)) => assert!(scene.clip.clip_frame_count() < 1000, "{stop}"),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}

#[test]
fn files_that_are_no_fbx_are_refused() {
    let cases: [&[u8]; 4] = [
        b"",
        b"HIERARCHY\nROOT Hips",
        b"glTF\x02\0\0\0",
        b"Kaydara FBX Binary  \0\x1a\0",
    ];
    for bytes in cases {
        assert!(read_fbx(bytes).is_err(), "{bytes:?}");
    }
    let empty = "; FBX 7.4.0 project file\n";
    assert!(read_fbx(empty.as_bytes()).is_err());
}

/// A binary file whose one node claims properties and children without end.
fn hostile_binary(claims: u32) -> Vec<u8> {
    let mut bytes = b"Kaydara FBX Binary  \0\x1a\0".to_vec();
    bytes.extend(7400_u32.to_le_bytes());
    bytes.extend([claims; 3].iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend(b"\x07Objects");
    bytes.extend([b'd'; 64]);
    bytes
}

#[test]
fn hostile_bytes_are_refused_in_bounded_memory() {
    for claims in [1, 200, 0xffff, 0x7fff_ffff, 0xffff_ffff] {
        assert!(read_fbx(&hostile_binary(claims)).is_err(), "{claims}");
    }
    for end in (0..PLAIN.len()).step_by(211) {
        let _ = read_fbx(&PLAIN.as_bytes()[..end]);
    }
    let deep = "Model: 1, \"Model::a\", \"LimbNode\" {\n".repeat(5000);
    let _ = read_fbx(format!("; FBX 7.4.0 project file\nObjects: {{\n{deep}").as_bytes());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn no_change_of_bytes_makes_the_reader_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12)
    ) {
        let mut bytes = PLAIN.as_bytes().to_vec();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Ok((scene, _)) = read_fbx(&bytes) {
            prop_assert!(scene.clip.clip_frame_count() > 0);
        }
    }
}

/// Tests files by other people, if `CHEREME_SHARED_DATA` names their folder: positions are those that another reader
/// gives.
#[test]
fn files_of_other_people_are_read_as_other_programs_read_them() {
    let Some(data) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set: no file of other people was read");
        return;
    };
    let folder = std::path::Path::new(&data).join("motion/fbx/facebookincubator-momentum");
    type Place = (usize, &'static str, [f64; 3]);
    let cases: [(&str, usize, &[Place]); 2] = [
        (
            "animation_test.fbx",
            3,
            &[
                (0, "joint1", [0.0, 0.0, 4.0]),
                (0, "joint2", [4.0, 0.0, 4.0]),
                (0, "joint3", [4.0, 0.0, 8.0]),
                (4, "joint2", [3.05067, 0.0, 1.41284]),
                (4, "joint3", [5.63783, 0.0, 4.46351]),
                (9, "joint2", [0.0, 0.0, 0.0]),
            ],
        ),
        (
            "simple_anim.fbx",
            159,
            &[
                (0, "body_world", [-0.00576, 0.0, 0.20904]),
                (0, "b_root", [-0.00576, 91.53042, 0.20906]),
                (0, "b_spine0", [0.01019, 94.85957, 2.10395]),
                (2, "b_root", [-0.53206, 87.87226, -1.11966]),
                (5, "b_root", [0.05239, 89.53271, -0.77587]),
            ],
        ),
    ];
    for (name, joints, places) in cases {
        let bytes = std::fs::read(folder.join(name)).expect("the file");
        let (scene, findings) = read_fbx(&bytes).expect(name);
        let all = scene.clip.clip_skeleton().skeleton_joints();
        assert_eq!(all.len(), joints, "{name}: {findings:?}");
        for (frame, joint, place) in places {
            let index = all.iter().position(|it| it.name == *joint).expect("its joint");
            let at = scene.clip.model_pose(*frame).model_joint_position(index);
            let off = at.distance(DVec3::from(*place));
            assert!(off < 2e-5, "{name}: {joint} at {frame} is at {at}");
        }
    }
}

#[test]
fn golden_scene_of_fbx() {
    use crate::golden::{compare, put};
    let mut out = String::new();
    for (name, text) in [
        ("plain", PLAIN.to_owned()),
        (
            "another unit",
            PLAIN.replace(
                "UnitScaleFactor\", \"double\", \"Number\", \"\",1",
                "UnitScaleFactor\", \"double\", \"Number\", \"\",100",
            ),
        ),
    ] {
        put(&mut out, format!("## {name}"));
        let (scene, found) = read_fbx(text.as_bytes()).expect("an ASCII FBX");
        crate::tests::clip(&mut out, &scene.clip);
        put(
            &mut out,
            format!("{:?} {:?} {:?}", scene.convention, scene.take, scene.clock),
        );
        if let Some(morphs) = &scene.morphs {
            crate::tests::curves(&mut out, morphs);
        }
        crate::tests::findings(&mut out, &found);
    }
    compare("fbx", &out);
}
