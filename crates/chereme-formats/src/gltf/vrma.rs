//! A clip as VRMA: movement of a humanoid for avatars (VRMC_vrm_animation 1.0).
//!
//! The file's rest pose is the T-pose without rotations, and a frame's rotations count from there, so that every avatar
//! can use them. Source: the VRM specification of the VRM Consortium.

use std::sync::LazyLock;

use chereme_data::schema_text;
use chereme_motion::{BodyAnatomy, Clip, Skeleton};
use serde_json::{Map, Value, json};

use crate::avatar_rig::{AvatarRig, RigError, RiggedClip};
use crate::reach::TooFar;
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

/// The bones of VRM.
static VRM_RIG: LazyLock<AvatarRig> =
    LazyLock::new(|| AvatarRig::read_rig_table(schema_text("skeletons/vrm.json")).expect("a table of bones"));

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

impl From<RigError> for VrmaWriteError {
    fn from(error: RigError) -> Self {
        match error {
            RigError::NoPart(_) => Self::NoAvatar(error.to_string()),
            RigError::TooFar(error) => Self::TooFar(error),
        }
    }
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
    let rigged = VRM_RIG.put_on_rig(clip, anatomy)?;
    let frames = clip.clip_frame_count();
    let mut animation = VrmaAnimation::new(&rigged, clip);
    for (at, channel) in rigged.clip.joint_channels().iter().enumerate() {
        let turns: Vec<f32> = channel
            .rotations
            .iter()
            .flat_map(|turn| to_gltf_rotation(*turn))
            .collect();
        animation.add_channel(at, "rotation", &turns);
        if at == 0 {
            let positions = (0..frames).map(|frame| rigged.clip.joint_translation(at, frame));
            let places: Vec<f32> = positions.flat_map(to_gltf_vector).collect();
            animation.add_channel(at, "translation", &places);
        }
    }
    let bones = rigged.clip.clip_skeleton().skeleton_joints().iter().enumerate();
    let human = bones.map(|(at, bone)| (bone.name.clone(), json!({"node": at})));
    let mut extension = json!({"specVersion": "1.0", "humanoid": {"humanBones": human.collect::<Map<_, _>>()}});
    if let Some(expressions) = animation.add_expressions(face, frames) {
        extension["expressions"] = expressions;
    }
    if face.gaze.len() == frames {
        let gaze_turns = face.gaze.iter().map(|gaze| avatar_face::eye_rotation_from_gaze(*gaze));
        let turns: Vec<f32> = gaze_turns.flat_map(to_gltf_rotation).collect();
        let node = animation.add_root_node(json!({"name": "look_at"}));
        animation.add_channel(node, "rotation", &turns);
        extension["lookAt"] = json!({"node": node, "offsetFromHeadBone": EYE_OFFSET_METRES});
    }
    Ok(animation.pack_vrma_file(&extension, clip, about))
}

/// Returns the node of a bone, placed from its parent's.
fn bone_node(rigged: &RiggedClip, source: &Skeleton, at: usize) -> Value {
    let skeleton = rigged.clip.clip_skeleton();
    let bone = skeleton.joint_at(at);
    let mut node = json!({"name": bone.name, "translation": to_gltf_vector(bone.offset)});
    if let Some((_, joint)) = rigged.joints[at] {
        node["extras"] = json!({"name": source.joint_at(joint).name});
    }
    if let Some(tip) = bone.tip {
        node["extras"]["tip"] = json!(to_gltf_vector(tip));
    }
    let children = skeleton.joint_children(at);
    if !children.is_empty() {
        node["children"] = json!(children);
    }
    node
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
    fn new(rigged: &RiggedClip, clip: &Clip) -> Self {
        let frame_time = clip.clip_frame_rate().frame_time();
        let times: Vec<f32> = (0..clip.clip_frame_count())
            .map(|frame| (frame as f64 * frame_time) as f32)
            .collect();
        let mut parts = GlbParts::default();
        let input = parts.add_float_accessor(&times, "SCALAR", 1, None);
        parts.set_accessor_bounds(input, &times, 1);
        Self {
            nodes: (0..rigged.joints.len())
                .map(|at| bone_node(rigged, clip.clip_skeleton(), at))
                .collect(),
            roots: vec![0],
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
    let bone_names: Vec<&str> = anatomy
        .found_parts()
        .filter_map(|(part, ..)| VRM_RIG.part_bone(part))
        .collect();
    let lacks = |bone: &&str| !bone_names.contains(bone);
    REQUIRED_VRM_BONES.into_iter().filter(lacks).collect()
}

/// Returns whether an expression is one that VRM defines.
#[must_use]
pub fn is_preset(name: &str) -> bool {
    VRM_PRESET_NAMES.contains(&name)
}
