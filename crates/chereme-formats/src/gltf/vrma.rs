//! A clip as VRMA: movement of a humanoid for avatars (VRMC_vrm_animation 1.0).
//!
//! The file's rest pose is the T-pose without rotations, and a frame's rotations count from there, so that every avatar
//! can use them. Source: the VRM specification of the VRM Consortium.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, HandFinger, ModelPose};
use serde_json::{Map, Value, json};

use crate::reach::{self, TooFar};
use crate::tracks::unique_track_names;

use super::avatar_face;
use super::gltf_write::{
    GlbDescription, GlbParts, pack_glb_container, plain_node_name, to_gltf_rotation, to_gltf_vector,
};

pub use super::avatar_face::{AvatarFace, ExpressionTrack};

/// The place of the eyes from the joint of the head, in metres.
const EYE_OFFSET_METRES: [f64; 3] = [0.0, 0.06, 0.0];

/// The names of presets that VRM defines; other expressions are custom ones.
const VRM_PRESET_NAMES: [&str; 14] = [
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
pub enum VrmaWriteError {
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
/// [`VrmaWriteError`] if the skeleton lacks hips or arms, the clip has no frame, or a place does not fit into the file.
pub fn write_vrma(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    face: &AvatarFace,
    about: &GlbDescription,
) -> Result<Vec<u8>, VrmaWriteError> {
    let skeleton = clip.clip_skeleton();
    if clip.clip_frame_count() == 0 {
        return Err(VrmaWriteError::NoAvatar("the movement has no frames".to_owned()));
    }
    let mut bones: Vec<(String, usize)> = Vec::new();
    for (part, joint, _) in anatomy.found_parts() {
        let is_taken = bones.iter().any(|(_, taken)| *taken == joint);
        if let Some(name) = vrm_bone_name(part).filter(|_| !is_taken) {
            bones.push((name, joint));
        }
    }
    for needed in ["hips", "leftUpperArm", "rightUpperArm"] {
        if !bones.iter().any(|(name, _)| name == needed) {
            let reason = format!("the skeleton has no {needed}, which avatars need");
            return Err(VrmaWriteError::NoAvatar(reason));
        }
    }
    reach::check_clip_reach(clip)?;
    bones.sort_by_key(|(_, joint)| *joint);
    let rest = anatomy.clone().with_clip(clip).t_pose(skeleton);
    let parents: Vec<Option<usize>> = bones
        .iter()
        .map(|(_, joint)| {
            let ancestor_joints = skeleton.joint_ancestors(*joint);
            let mut above = ancestor_joints.filter(|ancestor| ancestor != joint);
            above.find_map(|ancestor| bones.iter().position(|(_, bone)| *bone == ancestor))
        })
        .collect();
    // The hips come first: other roots hang below them.
    let hips = bones.iter().position(|(name, _)| name == "hips").unwrap_or(0);
    let parent = |at: usize| parents[at].or((at != hips).then_some(hips));
    let lowest = bones.iter().map(|(_, joint)| rest.model_joint_position(*joint).y);
    let lift = -lowest.fold(f64::INFINITY, f64::min);
    let place = |at: usize| rest.model_joint_position(bones[at].1) + DVec3::Y * lift;
    let mut nodes: Vec<Value> = Vec::new();
    for (at, (name, joint)) in bones.iter().enumerate() {
        let from = parent(at).map_or(DVec3::ZERO, place);
        let children: Vec<usize> = (0..bones.len()).filter(|child| parent(*child) == Some(at)).collect();
        let mut node = json!({"name": name, "translation": to_gltf_vector(place(at) - from),
            "extras": {"name": skeleton.joint_at(*joint).name}});
        if let Some(tip) = skeleton.joint_at(*joint).tip {
            node["extras"]["tip"] = json!(to_gltf_vector(rest.model_joint_rotation(*joint) * tip));
        }
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        nodes.push(node);
    }
    let mut parts = GlbParts::default();
    let rate = clip.clip_frame_rate();
    let times: Vec<f32> = (0..clip.clip_frame_count())
        .map(|frame| (frame as f64 * rate.frame_time()) as f32)
        .collect();
    let input = parts.add_float_accessor(&times, "SCALAR", 1, None);
    parts.set_accessor_bounds(input, &times, 1);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut add = |node: usize, path: &str, output: usize| {
        channels.push(json!({"sampler": samplers.len(), "target": {"node": node, "path": path}}));
        samplers.push(json!({"input": input, "output": output, "interpolation": "LINEAR"}));
    };
    let poses: Vec<ModelPose> = (0..clip.clip_frame_count())
        .map(|frame| clip.model_pose(frame))
        .collect();
    for (at, (_, joint)) in bones.iter().enumerate() {
        let from_rest = |pose: &ModelPose, at: usize| {
            let joint = bones[at].1;
            pose.model_joint_rotation(joint) * rest.model_joint_rotation(joint).inverse()
        };
        let mut before = DQuat::IDENTITY;
        let mut turns = Vec::with_capacity(4 * poses.len());
        for pose in &poses {
            let above = parent(at).map_or(DQuat::IDENTITY, |parent| from_rest(pose, parent));
            let bone_turn = above.inverse() * from_rest(pose, at);
            let near = if before.dot(bone_turn) < 0.0 {
                -bone_turn
            } else {
                bone_turn
            };
            turns.extend(to_gltf_rotation(near));
            before = near;
        }
        let output = parts.add_float_accessor(&turns, "VEC4", 4, None);
        add(at, "rotation", output);
        if at == hips {
            let place_numbers = poses
                .iter()
                .flat_map(|pose| to_gltf_vector(pose.model_joint_position(*joint)));
            let places: Vec<f32> = place_numbers.collect();
            let output = parts.add_float_accessor(&places, "VEC3", 3, None);
            add(at, "translation", output);
        }
    }
    let (mut presets, mut customs) = (Map::new(), Map::new());
    let mut roots = vec![hips];
    let expressions: Vec<&ExpressionTrack> = face
        .expressions
        .iter()
        .filter(|expression| expression.weights.len() == poses.len())
        .collect();
    let expression_names: Vec<String> = expressions
        .iter()
        .map(|expression| plain_node_name(&expression.name))
        .collect();
    let names = unique_track_names(expression_names.iter().map(String::as_str), "expression");
    for (expression, name) in expressions.into_iter().zip(names) {
        let node = nodes.len();
        let name = plain_node_name(&name);
        let mut made = json!({"name": format!("expression_{name}")});
        if name != expression.name {
            made["extras"] = json!({"name": expression.name});
        }
        nodes.push(made);
        roots.push(node);
        let frame_weights = expression.weights.iter();
        let weights: Vec<f32> = frame_weights
            .flat_map(|weight| [weight.clamp(0.0, 1.0) as f32, 0.0, 0.0])
            .collect();
        let output = parts.add_float_accessor(&weights, "VEC3", 3, None);
        add(node, "translation", output);
        let preset = VRM_PRESET_NAMES.contains(&name.as_str());
        let all = if preset { &mut presets } else { &mut customs };
        all.insert(name, json!({"node": node}));
    }
    let look = (face.gaze.len() == poses.len()).then(|| {
        nodes.push(json!({"name": "look_at"}));
        roots.push(nodes.len() - 1);
        let gaze_turns = face.gaze.iter().map(|gaze| avatar_face::eye_rotation_from_gaze(*gaze));
        let turns: Vec<f32> = gaze_turns.flat_map(to_gltf_rotation).collect();
        let output = parts.add_float_accessor(&turns, "VEC4", 4, None);
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
        extension["lookAt"] = json!({"node": node, "offsetFromHeadBone": EYE_OFFSET_METRES});
    }
    let mut document = json!({
        "asset": {"version": "2.0", "generator": format!("Chereme {}", env!("CARGO_PKG_VERSION"))},
        "extensionsUsed": ["VRMC_vrm_animation"],
        "extensions": {"VRMC_vrm_animation": extension},
        "scene": 0,
        "scenes": [{"name": about.glb_scene_name(), "nodes": roots}],
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
    Ok(pack_glb_container(&document, parts.bytes))
}

/// The bones that VRM requires.
const REQUIRED_VRM_BONES: [&str; 15] = [
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
pub fn missing_vrm_bones(anatomy: &BodyAnatomy) -> Vec<&'static str> {
    let bone_names: Vec<String> = anatomy
        .found_parts()
        .filter_map(|(part, ..)| vrm_bone_name(part))
        .collect();
    let lacks = |bone: &&str| !bone_names.iter().any(|bone_name| bone_name == bone);
    REQUIRED_VRM_BONES.into_iter().filter(lacks).collect()
}

/// Returns whether an expression is one that VRM defines.
#[must_use]
pub fn is_preset(name: &str) -> bool {
    VRM_PRESET_NAMES.contains(&name)
}

/// Returns the name of a part in VRM 1.0.
fn vrm_bone_name(part: BodyPart) -> Option<String> {
    let sided = |side: BodySide, name: &str| match side {
        BodySide::Left => format!("left{name}"),
        BodySide::Right => format!("right{name}"),
    };
    Some(match part {
        BodyPart::Hips => "hips".to_owned(),
        BodyPart::Spine => "spine".to_owned(),
        BodyPart::Chest => "chest".to_owned(),
        BodyPart::Neck => "neck".to_owned(),
        BodyPart::Head => "head".to_owned(),
        BodyPart::Clavicle(side) => sided(side, "Shoulder"),
        BodyPart::UpperArm(side) => sided(side, "UpperArm"),
        BodyPart::Forearm(side) => sided(side, "LowerArm"),
        BodyPart::Hand(side) => sided(side, "Hand"),
        BodyPart::Thigh(side) => sided(side, "UpperLeg"),
        BodyPart::Shin(side) => sided(side, "LowerLeg"),
        BodyPart::Foot(side) => sided(side, "Foot"),
        BodyPart::Toes(side) => sided(side, "Toes"),
        BodyPart::Thumb(side, at) => {
            let end = ["Metacarpal", "Proximal", "Distal"].get(usize::from(at))?;
            sided(side, &format!("Thumb{end}"))
        }
        BodyPart::Finger(side, finger, at) => {
            let end = ["Proximal", "Intermediate", "Distal"].get(usize::from(at).checked_sub(1)?)?;
            let finger = match finger {
                HandFinger::Index => "Index",
                HandFinger::Middle => "Middle",
                HandFinger::Ring => "Ring",
                HandFinger::Little => "Little",
            };
            sided(side, &format!("{finger}{end}"))
        }
        BodyPart::Jaw | BodyPart::Eye(_) => return None,
    })
}
