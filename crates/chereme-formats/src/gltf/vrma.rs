//! A clip as VRMA: movement of a humanoid for avatars (VRMC_vrm_animation 1.0).
//!
//! The file's rest pose is the T-pose without rotations, and a frame's rotations count from there, so that every avatar
//! can use them. Source: the VRM specification of the VRM Consortium.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Anatomy, Clip, Finger, ModelPose, Part, Side};
use serde_json::{Map, Value, json};

use crate::reach::{self, TooFar};
use crate::tracks::unique;

use super::avatar_face;
use super::write::{About, Parts, container, plain, turn, vector};

pub use super::avatar_face::{AvatarFace, Expression};

/// The place of the eyes from the joint of the head, in metres.
const EYES: [f64; 3] = [0.0, 0.06, 0.0];

/// The names of presets that VRM defines; other expressions are custom ones.
const PRESETS: [&str; 14] = [
    "happy",
    "angry",
    "sad",
    "relaxed",
    "surprised",
    "aa",
    "ih",
    "ou",
    "ee",
    "oh",
    "blink",
    "blinkLeft",
    "blinkRight",
    "neutral",
];

/// A reason why a clip cannot be written as VRMA.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum WriteError {
    /// The skeleton is not that of an avatar, or does not move.
    #[error("{0}")]
    NoAvatar(String),
    /// A place does not fit into 32-bit numbers.
    #[error(transparent)]
    TooFar(#[from] TooFar),
}

/// Returns a clip in metres of model space as VRMA.
///
/// Rotations of joints that VRM does not know are added to those of the bones below them. Only the hips change their
/// position. Expressions and gaze without a value in each frame are left out. Feet of the rest pose stand at height 0. A
/// node's `extras.tip` is the end of a bone without a further joint.
///
/// # Errors
/// [`WriteError`] if the skeleton lacks hips or arms, the clip has no frame, or a place does not fit into the file.
pub fn write(
    clip: &Clip,
    anatomy: &Anatomy,
    face: &AvatarFace,
    about: &About,
) -> Result<Vec<u8>, WriteError> {
    let skeleton = clip.skeleton();
    if clip.frames() == 0 {
        return Err(WriteError::NoAvatar(
            "the movement has no frames".to_owned(),
        ));
    }
    let mut bones: Vec<(String, usize)> = Vec::new();
    for (part, joint, _) in anatomy.found() {
        let known = bones.iter().any(|(_, taken)| *taken == joint);
        if let Some(name) = name(part).filter(|_| !known) {
            bones.push((name, joint));
        }
    }
    for needed in ["hips", "leftUpperArm", "rightUpperArm"] {
        if !bones.iter().any(|(name, _)| name == needed) {
            let reason = format!("the skeleton has no {needed}, which avatars need");
            return Err(WriteError::NoAvatar(reason));
        }
    }
    reach::check(clip)?;
    bones.sort_by_key(|(_, joint)| *joint);
    let rest = anatomy.clone().with_clip(clip).t_pose(skeleton);
    let parents: Vec<Option<usize>> = bones
        .iter()
        .map(|(_, joint)| {
            let above = skeleton.ancestors(*joint);
            let mut above = above.filter(|it| it != joint);
            above.find_map(|it| bones.iter().position(|(_, bone)| *bone == it))
        })
        .collect();
    // The hips come first: other roots hang below them.
    let hips = bones
        .iter()
        .position(|(name, _)| name == "hips")
        .unwrap_or(0);
    let parent = |at: usize| parents[at].or((at != hips).then_some(hips));
    let lowest = bones.iter().map(|(_, joint)| rest.position(*joint).y);
    let lift = -lowest.fold(f64::INFINITY, f64::min);
    let place = |at: usize| rest.position(bones[at].1) + DVec3::Y * lift;
    let mut nodes: Vec<Value> = Vec::new();
    for (at, (name, joint)) in bones.iter().enumerate() {
        let from = parent(at).map_or(DVec3::ZERO, place);
        let children: Vec<usize> = (0..bones.len())
            .filter(|it| parent(*it) == Some(at))
            .collect();
        let mut node = json!({"name": name, "translation": vector(place(at) - from),
            "extras": {"name": skeleton.joint(*joint).name}});
        if let Some(tip) = skeleton.joint(*joint).tip {
            node["extras"]["tip"] = json!(vector(rest.rotation(*joint) * tip));
        }
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        nodes.push(node);
    }
    let mut parts = Parts::default();
    let rate = clip.rate();
    let times: Vec<f32> = (0..clip.frames())
        .map(|frame| (frame as f64 * rate.frame_time()) as f32)
        .collect();
    let input = parts.floats(&times, "SCALAR", 1, None);
    parts.bounds(input, &times, 1);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut add = |node: usize, path: &str, output: usize| {
        channels.push(json!({"sampler": samplers.len(), "target": {"node": node, "path": path}}));
        samplers.push(json!({"input": input, "output": output, "interpolation": "LINEAR"}));
    };
    let poses: Vec<ModelPose> = (0..clip.frames()).map(|it| clip.model_pose(it)).collect();
    for (at, (_, joint)) in bones.iter().enumerate() {
        let from_rest = |pose: &ModelPose, at: usize| {
            let joint = bones[at].1;
            pose.rotation(joint) * rest.rotation(joint).inverse()
        };
        let mut before = DQuat::IDENTITY;
        let mut turns = Vec::with_capacity(4 * poses.len());
        for pose in &poses {
            let above = parent(at).map_or(DQuat::IDENTITY, |parent| from_rest(pose, parent));
            let own = above.inverse() * from_rest(pose, at);
            let near = if before.dot(own) < 0.0 { -own } else { own };
            turns.extend(turn(near));
            before = near;
        }
        let output = parts.floats(&turns, "VEC4", 4, None);
        add(at, "rotation", output);
        if at == hips {
            let places = poses.iter().flat_map(|pose| vector(pose.position(*joint)));
            let places: Vec<f32> = places.collect();
            let output = parts.floats(&places, "VEC3", 3, None);
            add(at, "translation", output);
        }
    }
    let (mut presets, mut customs) = (Map::new(), Map::new());
    let mut roots = vec![hips];
    let expressions: Vec<&Expression> = face
        .expressions
        .iter()
        .filter(|it| it.weights.len() == poses.len())
        .collect();
    let names: Vec<String> = expressions.iter().map(|it| plain(&it.name)).collect();
    let names = unique(names.iter().map(String::as_str), "expression");
    for (expression, name) in expressions.into_iter().zip(names) {
        let node = nodes.len();
        let name = plain(&name);
        let mut made = json!({"name": format!("expression_{name}")});
        if name != expression.name {
            made["extras"] = json!({"name": expression.name});
        }
        nodes.push(made);
        roots.push(node);
        let weights = expression.weights.iter();
        let weights: Vec<f32> = weights
            .flat_map(|weight| [weight.clamp(0.0, 1.0) as f32, 0.0, 0.0])
            .collect();
        let output = parts.floats(&weights, "VEC3", 3, None);
        add(node, "translation", output);
        let preset = PRESETS.contains(&name.as_str());
        let all = if preset { &mut presets } else { &mut customs };
        all.insert(name, json!({"node": node}));
    }
    let look = (face.gaze.len() == poses.len()).then(|| {
        nodes.push(json!({"name": "look_at"}));
        roots.push(nodes.len() - 1);
        let turns = face.gaze.iter().map(|it| avatar_face::rotation(*it));
        let turns: Vec<f32> = turns.flat_map(turn).collect();
        let output = parts.floats(&turns, "VEC4", 4, None);
        add(nodes.len() - 1, "rotation", output);
        nodes.len() - 1
    });
    let human: Map<String, Value> = bones
        .iter()
        .enumerate()
        .map(|(at, (name, _))| (name.clone(), json!({"node": at})))
        .collect();
    let mut extension = json!({"specVersion": "1.0", "humanoid": {"humanBones": human}});
    if !presets.is_empty() || !customs.is_empty() {
        extension["expressions"] = json!({"preset": presets, "custom": customs});
    }
    if let Some(node) = look {
        extension["lookAt"] = json!({"node": node, "offsetFromHeadBone": EYES});
    }
    let mut document = json!({
        "asset": {"version": "2.0", "generator": format!("Chereme {}", env!("CARGO_PKG_VERSION"))},
        "extensionsUsed": ["VRMC_vrm_animation"],
        "extensions": {"VRMC_vrm_animation": extension},
        "scene": 0,
        "scenes": [{"name": about.scene(), "nodes": roots}],
        "nodes": nodes,
        "animations": [{
            "name": about.name,
            "channels": channels,
            "samplers": samplers,
            "extras": {"annotations": about.notes, "frames_per_second": rate.per_second()},
        }],
        "buffers": [{"byteLength": parts.bytes.len()}],
        "bufferViews": parts.views,
        "accessors": parts.accessors,
    });
    if let Some(licence) = &about.licence {
        document["asset"]["copyright"] = licence.as_str().into();
    }
    Ok(container(&document, parts.bytes))
}

/// The bones that VRM requires.
const REQUIRED: [&str; 15] = [
    "hips",
    "spine",
    "head",
    "leftUpperArm",
    "leftLowerArm",
    "leftHand",
    "rightUpperArm",
    "rightLowerArm",
    "rightHand",
    "leftUpperLeg",
    "leftLowerLeg",
    "leftFoot",
    "rightUpperLeg",
    "rightLowerLeg",
    "rightFoot",
];

/// Returns the bones that VRM requires and a skeleton lacks.
#[must_use]
pub fn missing(anatomy: &Anatomy) -> Vec<&'static str> {
    let found: Vec<String> = anatomy
        .found()
        .filter_map(|(part, ..)| name(part))
        .collect();
    let lacks = |bone: &&str| !found.iter().any(|it| it == bone);
    REQUIRED.into_iter().filter(lacks).collect()
}

/// Returns whether an expression is one that VRM defines.
#[must_use]
pub fn is_preset(name: &str) -> bool {
    PRESETS.contains(&name)
}

/// Returns the name of a part in VRM 1.0.
fn name(part: Part) -> Option<String> {
    let sided = |side: Side, name: &str| match side {
        Side::Left => format!("left{name}"),
        Side::Right => format!("right{name}"),
    };
    Some(match part {
        Part::Hips => "hips".to_owned(),
        Part::Spine => "spine".to_owned(),
        Part::Chest => "chest".to_owned(),
        Part::Neck => "neck".to_owned(),
        Part::Head => "head".to_owned(),
        Part::Clavicle(side) => sided(side, "Shoulder"),
        Part::UpperArm(side) => sided(side, "UpperArm"),
        Part::Forearm(side) => sided(side, "LowerArm"),
        Part::Hand(side) => sided(side, "Hand"),
        Part::Thigh(side) => sided(side, "UpperLeg"),
        Part::Shin(side) => sided(side, "LowerLeg"),
        Part::Foot(side) => sided(side, "Foot"),
        Part::Toes(side) => sided(side, "Toes"),
        Part::Thumb(side, at) => {
            let end = ["Metacarpal", "Proximal", "Distal"].get(usize::from(at))?;
            sided(side, &format!("Thumb{end}"))
        }
        Part::Finger(side, finger, at) => {
            let end =
                ["Proximal", "Intermediate", "Distal"].get(usize::from(at).checked_sub(1)?)?;
            let finger = match finger {
                Finger::Index => "Index",
                Finger::Middle => "Middle",
                Finger::Ring => "Ring",
                Finger::Little => "Little",
            };
            sided(side, &format!("{finger}{end}"))
        }
        Part::Jaw | Part::Eye(_) => return None,
    })
}
