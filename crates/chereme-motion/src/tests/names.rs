//! Golden tables of the parts that are found if names are missing, occur twice, or mean something else.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::anatomy::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION, fixture_body, rename_joints};
use crate::golden::{compare, put};
use crate::{BodyAnatomy, BodyPart, PartEvidence, Skeleton, SkeletonJoint};

type Found = BTreeMap<String, (usize, PartEvidence)>;

fn found(anatomy: &BodyAnatomy) -> Found {
    let all = anatomy.found_parts();
    all.map(|(part, joint, how)| (part.to_string(), (joint, how))).collect()
}

/// Writes down how the parts of a skeleton differ from the usual ones.
fn differing(out: &mut String, name: &str, usual: &Found, skeleton: &Skeleton) {
    let anatomy = BodyAnatomy::detect_anatomy(skeleton);
    let own = found(&anatomy);
    let mut words = Vec::new();
    for (part, joint) in &own {
        if usual.get(part) != Some(joint) {
            words.push(format!("{part} is {} by {:?}", joint.0, joint.1));
        }
    }
    let lost = usual.keys().filter(|part| !own.contains_key(*part));
    words.extend(lost.map(|part| format!("no {part}")));
    for it in anatomy.ambiguous_parts() {
        words.push(format!("{} at {} or {:?}", it.part, it.taken, it.others));
    }
    if !anatomy.marker_joints().is_empty() {
        words.push(format!("markers {:?}", anatomy.marker_joints()));
    }
    put(out, format!("{name}: {}", words.join(", ")));
}

/// Names that joints have in some captures, in usual and in misleading forms.
const NAMES: [&str; 24] = [
    "J",
    "RightHand",
    "Left Wrist",
    "Hips",
    "Head",
    "Neck1",
    "RightArm",
    "LeftShoulder",
    "LeftCollar",
    "RightLeg",
    "LeftHip",
    "RightFoot",
    "LeftAnkle",
    "RightToes",
    "LeftHandIndex2",
    "RightThumbProximal",
    "Right Middle Metacarpal",
    "Spine7",
    "Jaw",
    "Eye",
    "RightForeArmTwist",
    "HandPalm_L",
    "RFIN",
    "Finger12",
];

#[test]
fn golden_parts_of_skeletons_with_odd_names() {
    let mut out = String::new();
    for (kind, wear) in [
        ("plain", PLAIN_BODY_VARIATION),
        (
            "metacarpals",
            BodyVariation {
                metacarpals: true,
                lowered: 0.4,
                ..PLAIN_BODY_VARIATION
            },
        ),
    ] {
        let whole = fixture_body(wear);
        let usual = found(&BodyAnatomy::detect_anatomy(&whole));
        for name in NAMES {
            put(&mut out, format!("## {kind}, one joint called {name}"));
            // The right side and the middle; the left side is alike.
            for joint in 0..28.min(whole.len()) {
                let odd = rename_joints(&whole, |n, own| if n == joint { name } else { own }.to_owned());
                let was = &whole.joint_at(joint).name;
                differing(&mut out, &format!("{joint} {was}"), &usual, &odd);
            }
        }
        put(&mut out, format!("## {kind}, two joints without names"));
        for joint in 0..whole.len() - 1 {
            let odd = rename_joints(&whole, |n, own| match n == joint || n == joint + 1 {
                true => format!("J{n}"),
                false => own.to_owned(),
            });
            differing(&mut out, &joint.to_string(), &usual, &odd);
        }
        put(&mut out, format!("## {kind}, names of some parts alone"));
        for part in [
            "hips", "head", "hand", "arm", "thigh", "foot", "index", "thumb", "right", "left",
        ] {
            let odd = rename_joints(&whole, |n, own| match own.contains(part) {
                true => own.to_owned(),
                false => format!("J{n}"),
            });
            differing(&mut out, part, &usual, &odd);
        }
    }
    compare("odd_names", &out);
}

#[test]
fn golden_parts_of_skeletons_with_more_or_fewer_joints() {
    let mut out = String::new();
    let whole = fixture_body(PLAIN_BODY_VARIATION);
    let usual = found(&BodyAnatomy::detect_anatomy(&whole));
    let nameless = |skeleton: &Skeleton| rename_joints(skeleton, |n, _| format!("J{n}"));
    for cut in 1..whole.len() {
        // The joint and all below it are left out.
        let gone = whole.joint_subtree(cut);
        let kept: Vec<usize> = (0..whole.len()).filter(|n| !gone.contains(n)).collect();
        let moved = kept.iter().map(|&n| SkeletonJoint {
            parent: whole
                .joint_parent(n)
                .and_then(|parent| kept.iter().position(|&it| it == parent)),
            ..whole.joint_at(n).clone()
        });
        let Ok(smaller) = Skeleton::new(moved.collect()) else {
            continue;
        };
        let name = format!("without {}", whole.joint_at(cut).name);
        let own = found(&BodyAnatomy::detect_anatomy(&smaller));
        put(&mut out, format!("{name}: {} parts", own.len()));
        let shape = BodyAnatomy::detect_anatomy(&nameless(&smaller));
        let parts: Vec<String> = shape
            .found_parts()
            .map(|(part, joint, _)| format!("{part} {joint}"))
            .collect();
        put(&mut out, format!("  by shape {}", parts.join(", ")));
    }
    for above in 0..whole.len() {
        // A leaf more, as an optical marker or a helper.
        for (name, at) in [("Helper", 0.02), ("RFIN", 0.05), ("Prop", 0.4)] {
            let mut joints = whole.skeleton_joints().to_vec();
            joints.push(SkeletonJoint::new(
                name,
                Some(above),
                DVec3::new(at, 0.5 * at, 0.1 * at),
            ));
            let larger = Skeleton::new(joints).expect("a tree");
            let name = format!("{name} on {}", whole.joint_at(above).name);
            differing(&mut out, &name, &usual, &larger);
            let shape = BodyAnatomy::detect_anatomy(&nameless(&larger));
            let some = BodyPart::all_body_parts().len() - shape.missing_parts().len();
            put(&mut out, format!("  by shape {} {some}", shape.found_parts().count()));
        }
    }
    put(&mut out, "## limbs of different lengths, without names");
    for limb in ["right forearm", "left upper arm", "right thigh", "left shin"] {
        for size in [0.5, 0.8, 1.1, 1.3, 1.6, 2.5] {
            let mut joints = whole.skeleton_joints().to_vec();
            for joint in joints.iter_mut().filter(|it| it.name == limb) {
                joint.offset *= size;
            }
            let uneven = nameless(&Skeleton::new(joints).expect("a tree"));
            let anatomy = BodyAnatomy::detect_anatomy(&uneven);
            let parts: Vec<String> = anatomy
                .found_parts()
                .map(|(part, joint, _)| format!("{part} {joint}"))
                .collect();
            put(&mut out, format!("{limb} {size}: {}", parts.join(", ")));
        }
    }
    compare("odd_joints", &out);
}
