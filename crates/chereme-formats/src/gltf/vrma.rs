//! A clip as VRMA: movement of a humanoid for avatars (VRMC_vrm_animation 1.0).
//!
//! The file's rest pose is the T-pose without rotations, and a frame's rotations count from there, so that every avatar
//! can use them. Source: the VRM specification of the VRM Consortium.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, HandFinger, ModelPose, Skeleton};
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
    if clip.clip_frame_count() == 0 {
        return Err(VrmaWriteError::NoAvatar("the movement has no frames".to_owned()));
    }
    let avatar = AvatarBones::find_avatar_bones(clip, anatomy)?;
    let poses: Vec<ModelPose> = (0..clip.clip_frame_count())
        .map(|frame| clip.model_pose(frame))
        .collect();
    let mut animation = VrmaAnimation::new(&avatar, clip);
    for (at, (_, joint)) in avatar.bones.iter().enumerate() {
        animation.add_channel(at, "rotation", &avatar.bone_rotations(&poses, at));
        if at == avatar.hips {
            let positions = poses.iter().map(|pose| pose.model_joint_position(*joint));
            let places: Vec<f32> = positions.flat_map(to_gltf_vector).collect();
            animation.add_channel(at, "translation", &places);
        }
    }
    let human = (avatar.bones.iter().enumerate()).map(|(at, (name, _))| (name.clone(), json!({"node": at})));
    let mut extension = json!({"specVersion": "1.0", "humanoid": {"humanBones": human.collect::<Map<_, _>>()}});
    if let Some(expressions) = animation.add_expressions(face, poses.len()) {
        extension["expressions"] = expressions;
    }
    if face.gaze.len() == poses.len() {
        let gaze_turns = face.gaze.iter().map(|gaze| avatar_face::eye_rotation_from_gaze(*gaze));
        let turns: Vec<f32> = gaze_turns.flat_map(to_gltf_rotation).collect();
        let node = animation.add_root_node(json!({"name": "look_at"}));
        animation.add_channel(node, "rotation", &turns);
        extension["lookAt"] = json!({"node": node, "offsetFromHeadBone": EYE_OFFSET_METRES});
    }
    Ok(animation.pack_vrma_file(&extension, clip, about))
}

/// The bones of an avatar in a skeleton, in the order of their joints.
struct AvatarBones<'a> {
    skeleton: &'a Skeleton,
    rest: ModelPose,
    /// The bones' names in VRM, and their joints.
    bones: Vec<(String, usize)>,
    parents: Vec<Option<usize>>,
    hips: usize,
    /// Raises the lowest bone of the rest pose to height 0, in metres.
    lift: f64,
}

impl<'a> AvatarBones<'a> {
    fn find_avatar_bones(clip: &'a Clip, anatomy: &BodyAnatomy) -> Result<Self, VrmaWriteError> {
        let skeleton = clip.clip_skeleton();
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
        let hips = bones.iter().position(|(name, _)| name == "hips").unwrap_or(0);
        let parent = |(at, (_, joint)): (usize, &(String, usize))| {
            let ancestor_joints = skeleton.joint_ancestors(*joint);
            let mut above = ancestor_joints.filter(|ancestor| ancestor != joint);
            let bone = above.find_map(|ancestor| bones.iter().position(|(_, bone)| *bone == ancestor));
            // The hips come first in VRM: other roots hang below them.
            bone.or((at != hips).then_some(hips))
        };
        let heights = bones.iter().map(|(_, joint)| rest.model_joint_position(*joint).y);
        Ok(Self {
            parents: bones.iter().enumerate().map(parent).collect(),
            lift: -heights.fold(f64::INFINITY, f64::min),
            skeleton,
            rest,
            bones,
            hips,
        })
    }

    /// Returns the node of a bone, placed from its parent's.
    fn bone_node(&self, at: usize) -> Value {
        let (name, joint) = &self.bones[at];
        let place = |at: usize| self.rest.model_joint_position(self.bones[at].1) + DVec3::Y * self.lift;
        let from = self.parents[at].map_or(DVec3::ZERO, place);
        let is_child = |child: &usize| self.parents[*child] == Some(at);
        let children: Vec<usize> = (0..self.bones.len()).filter(is_child).collect();
        let mut node = json!({"name": name, "translation": to_gltf_vector(place(at) - from),
            "extras": {"name": self.skeleton.joint_at(*joint).name}});
        if let Some(tip) = self.skeleton.joint_at(*joint).tip {
            node["extras"]["tip"] = json!(to_gltf_vector(self.rest.model_joint_rotation(*joint) * tip));
        }
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    }

    /// Returns the rotations of a bone from rest in each pose, relative to its parent's.
    fn bone_rotations(&self, poses: &[ModelPose], at: usize) -> Vec<f32> {
        let from_rest = |pose: &ModelPose, at: usize| {
            let joint = self.bones[at].1;
            pose.model_joint_rotation(joint) * self.rest.model_joint_rotation(joint).inverse()
        };
        let mut before = DQuat::IDENTITY;
        let mut turns = Vec::with_capacity(4 * poses.len());
        for pose in poses {
            let above = self.parents[at].map_or(DQuat::IDENTITY, |parent| from_rest(pose, parent));
            let bone_turn = above.inverse() * from_rest(pose, at);
            // Players interpolate the four numbers, so that neighbours must lie in one half of their sphere.
            before = if before.dot(bone_turn) < 0.0 {
                -bone_turn
            } else {
                bone_turn
            };
            turns.extend(to_gltf_rotation(before));
        }
        turns
    }
}

/// The nodes of a VRMA file and their movement.
struct VrmaAnimation {
    nodes: Vec<Value>,
    roots: Vec<usize>,
    parts: GlbParts,
    /// The accessor of the times of frames.
    input: usize,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl VrmaAnimation {
    fn new(avatar: &AvatarBones<'_>, clip: &Clip) -> Self {
        let frame_time = clip.clip_frame_rate().frame_time();
        let times: Vec<f32> = (0..clip.clip_frame_count())
            .map(|frame| (frame as f64 * frame_time) as f32)
            .collect();
        let mut parts = GlbParts::default();
        let input = parts.add_float_accessor(&times, "SCALAR", 1, None);
        parts.set_accessor_bounds(input, &times, 1);
        Self {
            nodes: (0..avatar.bones.len()).map(|at| avatar.bone_node(at)).collect(),
            roots: vec![avatar.hips],
            parts,
            input,
            samplers: Vec::new(),
            channels: Vec::new(),
        }
    }

    fn add_root_node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.roots.push(self.nodes.len() - 1);
        self.nodes.len() - 1
    }

    /// Moves a node along `path`, its rotation (quaternions) or translation (vectors), by the numbers of each frame.
    fn add_channel(&mut self, node: usize, path: &str, numbers: &[f32]) {
        let (kind, size) = match path {
            "rotation" => ("VEC4", 4),
            _ => ("VEC3", 3),
        };
        let output = self.parts.add_float_accessor(numbers, kind, size, None);
        let sampler = self.samplers.len();
        self.channels
            .push(json!({"sampler": sampler, "target": {"node": node, "path": path}}));
        self.samplers
            .push(json!({"input": self.input, "output": output, "interpolation": "LINEAR"}));
    }

    /// Adds the expressions that have a weight in each frame; returns how the extension names their nodes.
    fn add_expressions(&mut self, face: &AvatarFace, frames: usize) -> Option<Value> {
        let with_weights = |expression: &&ExpressionTrack| expression.weights.len() == frames;
        let expressions: Vec<&ExpressionTrack> = face.expressions.iter().filter(with_weights).collect();
        let plain_names = expressions.iter().map(|expression| plain_node_name(&expression.name));
        let plain_names: Vec<String> = plain_names.collect();
        let names = unique_track_names(plain_names.iter().map(String::as_str), "expression");
        let (mut presets, mut customs) = (Map::new(), Map::new());
        for (expression, name) in expressions.iter().zip(names) {
            let name = plain_node_name(&name);
            let mut made = json!({"name": format!("expression_{name}")});
            if name != expression.name {
                made["extras"] = json!({"name": expression.name});
            }
            let node = self.add_root_node(made);
            // VRM reads the weight from the translation along x, from 0 to 1.
            let frame_weights = expression.weights.iter();
            let weights = frame_weights.flat_map(|weight| [weight.clamp(0.0, 1.0) as f32, 0.0, 0.0]);
            self.add_channel(node, "translation", &weights.collect::<Vec<_>>());
            let all = if is_preset(&name) { &mut presets } else { &mut customs };
            all.insert(name, json!({"node": node}));
        }
        (!expressions.is_empty()).then(|| json!({"preset": presets, "custom": customs}))
    }

    fn pack_vrma_file(self, extension: &Value, clip: &Clip, about: &GlbDescription) -> Vec<u8> {
        let mut document = json!({
            "asset": {"version": "2.0", "generator": format!("Chereme {}", env!("CARGO_PKG_VERSION"))},
            "extensionsUsed": ["VRMC_vrm_animation"],
            "extensions": {"VRMC_vrm_animation": extension},
            "scene": 0,
            "scenes": [{"name": about.glb_scene_name(), "nodes": self.roots}],
            "nodes": self.nodes,
            "animations": [{
                "name": about.name,
                "channels": self.channels,
                "samplers": self.samplers,
                "extras": {"annotations": about.notes, "frames_per_second": clip.clip_frame_rate().per_second()},
            }],
            "buffers": [{"byteLength": self.parts.bytes.len()}],
            "bufferViews": self.parts.views,
            "accessors": self.parts.accessors,
        });
        if let Some(licence) = &about.licence {
            document["asset"]["copyright"] = licence.as_str().into();
        }
        pack_glb_container(&document, self.parts.bytes)
    }
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
