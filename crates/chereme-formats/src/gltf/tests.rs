//! Tests of glTF: written clips read back, animations of every kind, refused documents.

use std::sync::Arc;

use chereme_motion::glam::{DMat4, DQuat, DVec3};
use chereme_motion::{Clip, FrameRate, JointChannel, Skeleton, SkeletonJoint};
use serde_json::json;

use super::avatar_tests::figure;
use super::*;
use crate::ImportFinding;

fn clip() -> Clip {
    let turned = DQuat::from_rotation_z(0.3);
    let joints = vec![
        SkeletonJoint::new("Hips root", None, DVec3::new(0.0, 0.9, 0.0)),
        SkeletonJoint {
            rest: turned,
            ..SkeletonJoint::new("Arm.L", Some(0), DVec3::new(0.2, 0.4, 0.0))
        },
        SkeletonJoint::new("Arm.L", Some(1), DVec3::new(0.3, 0.0, 0.0)).with_tip(DVec3::new(0.1, 0.0, 0.0)),
    ];
    let skeleton = Arc::new(Skeleton::new(joints).expect("a skeleton"));
    let turns = |speed: f64| {
        (0..20)
            .map(|frame| DQuat::from_rotation_y(speed * f64::from(frame)))
            .collect()
    };
    let channels = vec![
        JointChannel {
            rotations: turns(0.4),
            translations: Some(
                (0..20)
                    .map(|frame| DVec3::new(0.01 * f64::from(frame), 0.9, 0.0))
                    .collect(),
            ),
        },
        JointChannel {
            rotations: turns(-0.2),
            translations: None,
        },
        JointChannel {
            rotations: turns(0.0),
            translations: None,
        },
    ];
    Clip::new(skeleton, FrameRate::new(25, 1).expect("a rate"), channels).expect("a clip")
}

pub(super) fn parse(bytes: &[u8]) -> Result<(BodyScene, Vec<ImportFinding>), GltfError> {
    read_gltf(bytes, &|_| None)
}

/// Returns the largest distance between joints of two clips, in metres.
fn apart(a: &Clip, b: &Clip) -> f64 {
    assert_eq!(
        (a.clip_frame_count(), a.clip_skeleton().len()),
        (b.clip_frame_count(), b.clip_skeleton().len())
    );
    let frames = (0..a.clip_frame_count()).flat_map(|frame| {
        let (a, b) = (a.model_pose(frame), b.model_pose(frame));
        let pairs: Vec<f64> = a
            .model_joint_positions()
            .iter()
            .zip(b.model_joint_positions())
            .map(|(a, b)| a.distance(*b))
            .collect();
        pairs
    });
    frames.fold(0.0, f64::max)
}

#[test]
fn movement_reads_back_to_a_hundredth_of_a_millimetre() {
    let clip = clip();
    let about = GlbDescription {
        name: "CHAT".into(),
        ..GlbDescription::default()
    };
    let (scene, findings) = parse(&write_glb(&clip, &about).expect("written")).expect("a GLB");
    assert_eq!(findings, []);
    assert!(apart(&clip, &scene.clip) < 1e-5);
    assert_eq!(scene.clip.clip_frame_rate(), clip.clip_frame_rate());
    assert_eq!(scene.take.as_deref(), Some("CHAT"));
    let names: Vec<&str> = scene
        .clip
        .clip_skeleton()
        .skeleton_joints()
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    assert_eq!(names, ["Hips root", "Arm.L", "Arm.L (2)"]);
    let tips: Vec<Option<DVec3>> = scene
        .clip
        .clip_skeleton()
        .skeleton_joints()
        .iter()
        .map(|it| it.tip)
        .collect();
    let tip = tips[2].expect("the end of the arm");
    assert_eq!(tips[..2], [None, None]);
    assert!(tip.distance(DVec3::X * 0.1) < 1e-7, "{tip}");
}

#[test]
fn nodes_that_mark_the_end_of_a_bone_become_its_tip() {
    for (name, want) in [
        ("Hand_end", Some(DVec3::Y * 0.2)),
        ("End Site", Some(DVec3::Y * 0.2)),
        ("Watch", None),
    ] {
        let document = serde_json::json!({
            "asset": {"version": "2.0"},
            "nodes": [
                {"name": "Arm", "children": [1], "scale": [2, 2, 2]},
                {"name": "Hand", "children": [2], "translation": [0, 0.3, 0]},
                {"name": name, "translation": [0, 0.1, 0]},
            ],
            "skins": [{"joints": [0, 1]}],
        });
        let (scene, _) = parse(document.to_string().as_bytes()).expect("glTF");
        let joints = scene.clip.clip_skeleton().skeleton_joints();
        assert_eq!(joints.len(), 2, "{name}");
        assert_eq!(joints[1].tip, want, "{name}");
    }
}

#[test]
fn nodes_have_exactly_the_names_of_the_joints() {
    for (names, written) in [
        (
            ["mixamorig:Hips", "Arm.L", "Hand l"],
            ["mixamorig:Hips", "Arm.L", "Hand l"],
        ),
        (["a/b", "jambe gauche é", "[2]"], ["a/b", "jambe gauche é", "[2]"]),
        (["a", "a", ""], ["a", "a (2)", "joint 3"]),
    ] {
        let joints = names.iter().enumerate();
        let joints = joints.map(|(at, name)| SkeletonJoint::new(*name, at.checked_sub(1), DVec3::Y));
        let skeleton = Skeleton::new(joints.collect()).expect("a tree");
        let clip = Clip::from_rest_pose(Arc::new(skeleton), FrameRate::new(30, 1).expect("a rate"), 2);
        let bytes = write_glb(&clip, &GlbDescription::default()).expect("written");
        let document = json_of(&bytes);
        let nodes = (0..3).map(|at| document["nodes"][at]["name"].clone());
        assert_eq!(nodes.collect::<Vec<_>>(), written);
        for (at, (name, written)) in names.iter().zip(written).enumerate() {
            let original = document["nodes"][at]["extras"]["name"].as_str();
            assert_eq!(original, (*name != written).then_some(*name));
        }
    }
}

#[test]
fn an_animation_and_its_scene_have_their_own_names() {
    for (source, scene) in [(None, "CHAT"), (Some("take 1.2s"), "take 1.2s")] {
        let about = GlbDescription {
            name: "CHAT".into(),
            source: source.map(str::to_owned),
            ..GlbDescription::default()
        };
        let document = json_of(&write_glb(&clip(), &about).expect("written"));
        assert_eq!(document["animations"][0]["name"], "CHAT");
        assert_eq!(document["scenes"][0]["name"], scene);
    }
}

/// Returns the JSON of a GLB.
fn json_of(bytes: &[u8]) -> serde_json::Value {
    let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).expect("JSON")
}

#[test]
fn annotations_are_stored_where_blender_and_three_js_keep_them() {
    let note = MovementNote {
        tier: "gloss".into(),
        begin: 0.0,
        end: 0.4,
        value: "CHAT \"x\"".into(),
    };
    let about = GlbDescription {
        licence: Some("CC0".into()),
        notes: vec![note],
        ..GlbDescription::default()
    };
    let bytes = write_glb(&clip(), &about).expect("written");
    let document = json_of(&bytes);
    let text = document["scenes"][0]["extras"]["chereme_annotations"]
        .as_str()
        .expect("a string");
    let notes: serde_json::Value = serde_json::from_str(text).expect("JSON in it");
    assert_eq!(notes[0]["value"], "CHAT \"x\"");
    assert_eq!(document["animations"][0]["extras"]["annotations"][0]["end"], 0.4);
    assert_eq!(document["asset"]["copyright"], "CC0");
    assert_eq!(bytes.len() % 4, 0);
}

/// A document of one joint `a` whose rotation has these keys and accessor.
fn document(extra: serde_json::Value, binary: &[u8]) -> Vec<u8> {
    let mut document = json!({
        "asset": {"version": "2.0"},
        "nodes": [{"name": "top", "scale": [0.01, 0.01, 0.01], "children": [1]}, {"name": "a", "translation": [100.0, 0.0, 0.0], "children": [2]}, {"name": "b", "translation": [0.0, 50.0, 0.0]}],
        "skins": [{"joints": [1, 2]}],
        "buffers": [{"byteLength": binary.len()}],
        "bufferViews": [{"buffer": 0, "byteLength": binary.len()}],
    });
    for (key, value) in extra.as_object().expect("an object") {
        document[key] = value.clone();
    }
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn animated(interpolation: &str, output: serde_json::Value, binary: &[u8]) -> Result<Clip, GltfError> {
    let extra = json!({
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}],
            "samplers": [{"input": 0, "output": 1, "interpolation": interpolation}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 2}, output],
    });
    parse(&document(extra, binary)).map(|(scene, _)| scene.clip)
}

#[test]
fn a_scale_above_the_joints_is_applied_to_their_offsets() {
    let (scene, findings) = parse(&document(json!({}), &[])).expect("a skeleton");
    let pose = scene.clip.model_pose(0);
    assert!(pose.model_joint_position(1).distance(DVec3::new(1.0, 0.0, 0.0)) < 1e-9);
    assert!(pose.model_joint_position(2).distance(DVec3::new(1.0, 0.5, 0.0)) < 1e-9);
    assert!(findings.iter().any(|finding| finding.message.contains("no animation")));
}

#[test]
fn keys_of_every_kind_are_read() {
    let half = 0.5f32.sqrt();
    let times = [0.0, 0.04];
    let turn = [0.0, 0.0, 0.0, 1.0, 0.0, half, 0.0, half];
    let angle = |clip: &Clip, frame: usize| clip.joint_channels()[1].rotations[frame].to_axis_angle().1;
    let right = std::f64::consts::FRAC_PI_2;
    let binary = floats(&[&times[..], &turn[..]].concat());
    let plain = json!({"bufferView": 0, "byteOffset": 8, "componentType": 5126, "type": "VEC4", "count": 2});
    for interpolation in ["LINEAR", "STEP"] {
        let clip = animated(interpolation, plain.clone(), &binary).expect("a clip");
        assert_eq!(clip.clip_frame_count(), 2);
        assert!((angle(&clip, 1) - right).abs() < 1e-6);
    }
    let none = [0.0f32; 4];
    let cubic = floats(&[&times[..], &none, &turn[..4], &none, &none, &turn[4..], &none].concat());
    let output = json!({"bufferView": 0, "byteOffset": 8, "componentType": 5126, "type": "VEC4", "count": 6});
    assert!((angle(&animated("CUBICSPLINE", output, &cubic).expect("a clip"), 1) - right).abs() < 1e-6);
    let mut small = floats(&times);
    let shorts = turn
        .iter()
        .flat_map(|value| ((value * 32_767.0).round() as i16).to_le_bytes());
    small.extend(shorts);
    let output = json!({"bufferView": 0, "byteOffset": 8, "componentType": 5122, "normalized": true, "type": "VEC4", "count": 2});
    assert!((angle(&animated("LINEAR", output, &small).expect("a clip"), 1) - right).abs() < 1e-4);
    let mut sparse = floats(&[&times[..], &turn[4..]].concat());
    sparse.extend([1u8, 0, 0, 0]);
    let output = json!({"componentType": 5126, "type": "VEC4", "count": 2, "sparse": {"count": 1,
        "indices": {"bufferView": 0, "byteOffset": 24, "componentType": 5121}, "values": {"bufferView": 0, "byteOffset": 8}}});
    let clip = animated("LINEAR", output, &sparse).expect("a clip");
    assert!(angle(&clip, 0).abs() < 1e-9 && (angle(&clip, 1) - right).abs() < 1e-6);
}

#[test]
fn documents_that_mean_nothing_are_refused() {
    let output = |view: usize| json!({"bufferView": view, "componentType": 5126, "type": "VEC4", "count": 2});
    let short = floats(&[0.0, 0.04]);
    assert!(
        animated("LINEAR", output(7), &short)
            .expect_err("no view")
            .to_string()
            .contains("bufferViews 7")
    );
    assert!(
        animated("LINEAR", output(0), &short)
            .expect_err("short")
            .to_string()
            .contains("beyond its view")
    );
    let loops = json!({"nodes": [{"children": [1]}, {"children": [0]}], "skins": [{"joints": [0]}]});
    let own_child = json!({"nodes": [{"children": [0]}, {}], "skins": [{"joints": [1]}]});
    for cycle in [loops, own_child] {
        let error = parse(&document(cycle, &[])).expect_err("a cycle");
        assert!(error.to_string().contains("is below itself"), "{error}");
    }
    let far = json!({"buffers": [{"byteLength": 1, "uri": "../secret.bin"}]});
    assert!(matches!(parse(&document(far, &[])), Err(GltfError::Elsewhere(_))));
    let net = json!({"buffers": [{"byteLength": 1, "uri": "https://x.org/a.bin"}]});
    assert!(matches!(parse(&document(net, &[])), Err(GltfError::Elsewhere(_))));
    assert_eq!(parse(b"hello").err(), Some(GltfError::NoGltf));
    assert!(matches!(
        parse(&document(json!({"skins": []}), &[])),
        Err(GltfError::NoSkeleton)
    ));
    let whole = write_glb(&clip(), &GlbDescription::default()).expect("written");
    for end in (0..whole.len()).step_by(7) {
        let _ = parse(&whole[..end]);
        let mut changed = whole.clone();
        changed[end] ^= 0xff;
        let _ = parse(&changed);
    }
}

#[test]
fn the_text_form_reads_embedded_and_neighbouring_buffers() {
    let text = r#"{"asset":{"version":"2.0"},"nodes":[{"name":"a"}],"skins":[{"joints":[0]}],"buffers":[{"byteLength":4,"uri":"URI"}]}"#;
    let inside = text.replace("URI", "data:application/octet-stream;base64,AAAAAA==");
    assert!(parse(inside.as_bytes()).is_ok());
    let outside = text.replace("URI", "a%20b.bin");
    assert!(read_gltf(outside.as_bytes(), &|name| (name == "a b.bin").then(|| vec![0; 4])).is_ok());
    assert!(matches!(parse(outside.as_bytes()), Err(GltfError::Elsewhere(_))));
}

#[test]
fn base64_is_decoded_as_in_its_standard() {
    // RFC 4648, section 10, and every digit of both alphabets.
    for (text, bytes) in [
        ("", &b""[..]),
        ("Zg==", b"f"),
        ("Zm8=", b"fo"),
        ("Zm9v", b"foo"),
        ("Zm9vYg==", b"foob"),
        ("Zm9v YmE=", b"fooba"),
        ("Zm9vYmFy", b"foobar"),
    ] {
        assert_eq!(container::decode_base64(text).as_deref(), Some(bytes), "{text}");
    }
    let letters: String = ('A'..='Z').chain('a'..='z').chain('0'..='9').collect();
    for (last, letters) in [("+/", &letters), ("-_", &letters)] {
        let bytes = container::decode_base64(&format!("{letters}{last}")).expect("digits");
        let bits: String = bytes.iter().map(|byte| format!("{byte:08b}")).collect();
        let digits: String = (0..64).map(|digit| format!("{digit:06b}")).collect();
        assert_eq!(bits, digits);
    }
    assert_eq!(container::decode_base64("Zm9v!"), None);
}

#[test]
fn files_of_others_are_read_or_refused_with_the_reason() {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return;
    };
    let (mut folders, mut seen) = (vec![std::path::Path::new(&folder).join("motion/gltf")], 0);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            seen += 1;
            let bytes = std::fs::read(&path).expect("a file");
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let scene = parse(&bytes);
            if stem == "mesh-without-skinning" {
                assert_eq!(scene.err(), Some(GltfError::NoSkeleton));
                continue;
            }
            let (scene, _) = scene.unwrap_or_else(|error| panic!("{stem}: {error}"));
            if stem == "model_with_motion" {
                let clip = &scene.clip;
                let find = |name: &str| {
                    clip.clip_skeleton()
                        .skeleton_joints()
                        .iter()
                        .position(|joint| joint.name == name)
                };
                let root = find("root").expect("a joint root");
                assert!(clip.clip_frame_count() >= 5, "{}", clip.clip_frame_count());
                assert!(clip.clip_skeleton().skeleton_joints()[root].offset.is_finite());
            }
            if stem == "sort_joints" {
                assert!(scene.clip.clip_skeleton().len() >= 297);
            }
        }
    }
    assert_eq!(seen, 6);
}

#[test]
fn golden_scenes_and_avatars() {
    use crate::golden::{compare, put};
    use crate::tests::{clip as clip_of, scene_file};
    let mut out = String::new();
    let about = GlbDescription {
        name: "CHAT".into(),
        licence: Some("CC0".into()),
        notes: vec![MovementNote {
            tier: "gloss".into(),
            begin: 0.1,
            end: 0.4,
            value: "CHAT".into(),
        }],
        ..GlbDescription::default()
    };
    let bytes = write_glb(&clip(), &about).expect("written");
    scene_file(&mut out, &bytes);
    let (scene, found) = parse(&bytes).expect("a GLB");
    clip_of(&mut out, &scene.clip);
    put(&mut out, format!("{:?} {:?} {found:?}", scene.convention, scene.take));
    put(&mut out, "## an avatar");
    let skeleton = Arc::new(figure());
    let anatomy = chereme_motion::BodyAnatomy::detect_anatomy(&skeleton);
    let channel = |joint: usize| JointChannel {
        rotations: (0..6)
            .map(|frame| DQuat::from_rotation_x(0.07 * f64::from(frame) * (joint % 4) as f64))
            .collect(),
        translations: (joint == 0).then(|| {
            let at = |frame: i32| DVec3::new(0.02 * f64::from(frame), 0.9, -0.01);
            (0..6).map(at).collect()
        }),
    };
    let channels = (0..skeleton.len()).map(channel).collect();
    let rate = FrameRate::new(30, 1).expect("a rate");
    let moving = Clip::new(skeleton, rate, channels).expect("a clip");
    let expressions = ["happy", "brow_raise"].map(|name| vrma::ExpressionTrack {
        name: name.into(),
        weights: (0..6).map(|frame| 0.2 * f64::from(frame)).collect(),
    });
    let face = vrma::AvatarFace {
        expressions: expressions.into(),
        gaze: vec![],
    };
    let bytes = vrma::write_vrma(&moving, &anatomy, &face, &about).expect("written");
    scene_file(&mut out, &bytes);
    compare("gltf", &out);
}

#[test]
fn places_beyond_32_bits_are_refused_by_joint_and_frame() {
    let at_rest = |joint: usize, offset: f64, tip: f64| {
        let clip = clip();
        let mut joints = clip.clip_skeleton().skeleton_joints().to_vec();
        joints[joint].offset.y = offset;
        joints[2].tip = Some(DVec3::X * tip);
        let skeleton = Arc::new(Skeleton::new(joints).expect("a skeleton"));
        Clip::new(skeleton, clip.clip_frame_rate(), clip.into_channels()).expect("a clip")
    };
    let moving = |joint: usize, frame: usize, place: f64| {
        let clip = clip();
        let (skeleton, rate) = (clip.clip_skeleton().clone(), clip.clip_frame_rate());
        let mut channels = clip.into_channels();
        let mut places = vec![DVec3::ZERO; 20];
        places[frame].z = place;
        channels[joint].translations = Some(places);
        Clip::new(skeleton, rate, channels).expect("a clip")
    };
    for (clip, want) in [
        (at_rest(1, 1e8, 0.1), None),
        (
            at_rest(1, 1e38, 0.1),
            Some("joint \"Arm.L\" is too far away to be written in its rest pose"),
        ),
        (
            at_rest(0, -1e308, 0.1),
            Some("joint \"Hips root\" is too far away to be written in its rest pose"),
        ),
        (
            at_rest(0, 0.9, 1e300),
            Some("joint \"Arm.L\" is too far away to be written in its rest pose"),
        ),
        (moving(0, 7, 1e8), None),
        (
            moving(0, 7, 1e39),
            Some("joint \"Hips root\" is too far away to be written in frame 7"),
        ),
        (
            moving(2, 19, 1e308),
            Some("joint \"Arm.L\" is too far away to be written in frame 19"),
        ),
    ] {
        let written = write_glb(&clip, &GlbDescription::default());
        assert_eq!(written.as_ref().err().map(ToString::to_string).as_deref(), want);
        if let Ok(bytes) = written {
            let text = String::from_utf8_lossy(&bytes);
            assert!(!text.contains("null"), "{want:?}");
            assert!(parse(&bytes).is_ok());
        }
    }
    let skeleton = Arc::new(figure());
    let anatomy = chereme_motion::BodyAnatomy::detect_anatomy(&skeleton);
    let still = JointChannel {
        rotations: vec![DQuat::IDENTITY; 2],
        translations: None,
    };
    let mut channels = vec![still; skeleton.len()];
    channels[0].translations = Some(vec![DVec3::Y, DVec3::Y * 1e40]);
    let rate = FrameRate::new(30, 1).expect("a rate");
    let clip = Clip::new(Arc::clone(&skeleton), rate, channels).expect("a clip");
    let refused = vrma::write_vrma(
        &clip,
        &anatomy,
        &vrma::AvatarFace::default(),
        &GlbDescription::default(),
    );
    let want = crate::TooFar {
        kind: "joint",
        name: skeleton.joint_at(0).name.clone(),
        frame: Some(1),
    };
    assert_eq!(refused, Err(vrma::VrmaWriteError::TooFar(want)));
}

/// Returns a body of two vertices: one on a bone that goes with a joint, one between that and a bone of its own.
fn small_figure(clip: &Clip) -> GlbFigure {
    let frames = 0..clip.clip_frame_count();
    let vertex = |place: [f32; 3], weights: [f32; 4]| GlbVertex {
        place,
        normal: [0.0, 1.0, 0.0],
        colour: [255, 128, 0],
        bones: [0, 1, 0, 0],
        weights,
    };
    let poses: Vec<_> = frames.clone().map(|frame| clip.model_pose(frame)).collect();
    GlbFigure {
        vertices: vec![
            vertex([0.1, 1.2, 0.0], [1.0, 0.0, 0.0, 0.0]),
            vertex([0.3, 1.3, 0.1], [0.25, 0.75, 0.0, 0.0]),
            vertex([0.3, 1.1, 0.1], [0.5, 0.5, 0.0, 0.0]),
        ],
        triangles: vec![[0, 1, 2]],
        bones: vec![
            GlbFigureBone {
                joint: 1,
                bind: [0.2, 1.3, 0.0],
                turns: poses.iter().map(|pose| pose.model_joint_rotation(1)).collect(),
                places: poses.iter().map(|pose| pose.model_joint_position(1)).collect(),
            },
            GlbFigureBone {
                joint: 2,
                bind: [0.4, 1.4, 0.0],
                turns: frames
                    .clone()
                    .map(|frame| DQuat::from_rotation_x(0.1 * frame as f64))
                    .collect(),
                places: frames
                    .clone()
                    .map(|frame| DVec3::new(0.5, 1.0, 0.02 * frame as f64))
                    .collect(),
            },
        ],
        morphs: vec![GlbFigureMorph {
            name: "jaw_open".into(),
            vertices: vec![2],
            offsets: vec![[0.0, -0.1, 0.0]],
            shares: frames.map(|frame| frame as f32 / 20.0).collect(),
        }],
    }
}

#[test]
fn a_visible_body_is_valid_moves_as_given_and_leaves_the_movement_as_it_is() {
    let clip = clip();
    let figure = small_figure(&clip);
    let about = GlbDescription::default();
    let bytes = write_glb_with_figure(&clip, &about, Some(&figure)).expect("written");
    let (plain, _) = parse(&write_glb(&clip, &about).expect("written")).expect("a GLB");
    let (scene, _) = parse(&bytes).expect("a GLB");
    assert_eq!(scene.clip, plain.clip);
    // Another reader checks the file and skins the vertices.
    let document = gltf::Gltf::from_slice(&bytes).expect("valid");
    let blob = document.blob.clone().expect("numbers");
    let data = |_: gltf::Buffer<'_>| Some(blob.as_slice());
    let skin = document.skins().next().expect("a skin");
    let joints: Vec<usize> = skin.joints().map(|joint| joint.index()).collect();
    let binds: Vec<DMat4> = skin
        .reader(data)
        .read_inverse_bind_matrices()
        .expect("binds")
        .map(|bind| DMat4::from_cols_array_2d(&bind.map(|column| column.map(f64::from))))
        .collect();
    let mesh = document.meshes().next().expect("a mesh");
    let primitive = mesh.primitives().next().expect("a surface");
    let reader = primitive.reader(data);
    let positions: Vec<[f32; 3]> = reader.read_positions().expect("places").collect();
    let bones: Vec<[u16; 4]> = reader.read_joints(0).expect("bones").into_u16().collect();
    let weights: Vec<[f32; 4]> = reader.read_weights(0).expect("weights").into_f32().collect();
    let colours: Vec<[u8; 3]> = reader.read_colors(0).expect("colours").into_rgb_u8().collect();
    assert_eq!(colours[0], [255, 55, 0], "128 of 255 gives 22 % of the light");
    let target = reader.read_morph_targets().next().expect("a target").0.expect("places");
    assert_eq!(target.collect::<Vec<_>>(), [[0.0; 3], [0.0; 3], [0.0, -0.1, 0.0]]);
    for frame in [0, 7, 19] {
        let mut local: Vec<DMat4> = document
            .nodes()
            .map(|node| DMat4::from_cols_array_2d(&node.transform().matrix().map(|column| column.map(f64::from))))
            .collect();
        for channel in document
            .animations()
            .flat_map(|animation| animation.channels().collect::<Vec<_>>())
        {
            let node = channel.target().node().index();
            let (scale, rotation, translation) = local[node].to_scale_rotation_translation();
            let outputs = channel.reader(data).read_outputs().expect("values");
            local[node] = match outputs {
                gltf::animation::util::ReadOutputs::Rotations(all) => {
                    let turn = all.into_f32().nth(frame).expect("a key").map(f64::from);
                    DMat4::from_scale_rotation_translation(scale, DQuat::from_array(turn), translation)
                }
                gltf::animation::util::ReadOutputs::Translations(mut all) => {
                    let place = DVec3::from_array(all.nth(frame).expect("a key").map(f64::from));
                    DMat4::from_scale_rotation_translation(scale, rotation, place)
                }
                _ => continue,
            };
        }
        let mut model = vec![DMat4::IDENTITY; local.len()];
        for root in document.default_scene().expect("a scene").nodes() {
            let mut open = vec![(root, DMat4::IDENTITY)];
            while let Some((node, above)) = open.pop() {
                model[node.index()] = above * local[node.index()];
                open.extend(node.children().map(|child| (child, model[node.index()])));
            }
        }
        for (vertex, at) in positions.iter().enumerate() {
            let at = DVec3::from_array(at.map(f64::from));
            let shares = bones[vertex].iter().zip(weights[vertex]);
            let moved: DVec3 = shares
                .map(|(bone, weight)| {
                    let joint = usize::from(*bone);
                    (model[joints[joint]] * binds[joint]).transform_point3(at) * f64::from(weight)
                })
                .sum();
            let given = figure.vertices[vertex]
                .bones
                .iter()
                .zip(figure.vertices[vertex].weights);
            let wanted: DVec3 = given
                .map(|(bone, weight)| {
                    let bone = &figure.bones[usize::from(*bone)];
                    let from = at - DVec3::from_array(bone.bind.map(f64::from));
                    (bone.turns[frame] * from + bone.places[frame]) * f64::from(weight)
                })
                .sum();
            assert!(
                moved.distance(wanted) < 1e-5,
                "frame {frame}, vertex {vertex}: {moved} {wanted}"
            );
        }
    }
}
