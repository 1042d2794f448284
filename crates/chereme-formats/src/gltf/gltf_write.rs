//! A clip as GLB: joints as nodes, a skin, bones as a mesh, one animation, annotations as extras.

use chereme_motion::glam::{DMat4, DQuat, DVec3};
use chereme_motion::{Clip, Skeleton};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::gltf_figure::{self, GlbFigure};
use crate::reach::{self, TooFar, skeleton_rest_pose};
use crate::tracks::unique_track_names;

/// An annotation of the movement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MovementNote {
    /// The name of the tier.
    pub tier: String,
    /// The beginning in seconds from the first frame.
    pub begin: f64,
    /// The end in seconds from the first frame.
    pub end: f64,
    /// The text of the annotation.
    pub value: String,
}

/// Descriptions to write into a GLB.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GlbDescription {
    /// The name of the animation, such as the gloss of a sign.
    pub name: String,
    /// The name of the scene, such as the recording and the time in it; without one it is that of the animation.
    pub source: Option<String>,
    /// The terms under which the movement may be used.
    pub licence: Option<String>,
    /// The annotations.
    pub notes: Vec<MovementNote>,
}

impl GlbDescription {
    /// Returns the name of the scene.
    pub(super) fn glb_scene_name(&self) -> &str {
        self.source.as_ref().unwrap_or(&self.name)
    }
}

pub(super) const FLOAT_COMPONENT_TYPE: u32 = 5126;
pub(super) const SHORT_COMPONENT_TYPE: u32 = 5123;
pub(super) const VERTEX_BUFFER_TARGET: u32 = 34_962;
pub(super) const INDEX_BUFFER_TARGET: u32 = 34_963;
/// The thickest part of a bone, as a share of its length.
const BONE_THICKNESS_SHARE: f64 = 0.08;
/// The position of the thickest part along a bone, as a share of its length.
const BONE_SHOULDER_SHARE: f64 = 0.12;
/// Bones shorter than this, in metres, get no mesh.
const MIN_MESH_BONE_METRES: f64 = 1e-4;

/// The parts of a document under construction.
#[derive(Default)]
pub(super) struct GlbParts {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl GlbParts {
    pub(super) fn add_buffer_view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let mut view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.bytes.extend(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    pub(super) fn add_accessor(&mut self, view: usize, kind: (u32, &str), count: usize) -> usize {
        let (component, shape) = kind;
        let accessor = json!({"bufferView": view, "componentType": component, "type": shape, "count": count});
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    pub(super) fn add_float_accessor(
        &mut self,
        values: &[f32],
        shape: &str,
        width: usize,
        target: Option<u32>,
    ) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let view = self.add_buffer_view(&bytes, target);
        self.add_accessor(view, (FLOAT_COMPONENT_TYPE, shape), values.len() / width)
    }

    /// Writes the minimum and maximum of each column into an accessor.
    pub(super) fn set_accessor_bounds(&mut self, accessor: usize, values: &[f32], width: usize) {
        let fold = |start: f32, pick: fn(f32, f32) -> f32| -> Vec<f32> {
            let column = |at: usize| values.iter().skip(at).step_by(width).copied().fold(start, pick);
            (0..width).map(column).collect()
        };
        self.accessors[accessor]["min"] = json!(fold(f32::INFINITY, f32::min));
        self.accessors[accessor]["max"] = json!(fold(f32::NEG_INFINITY, f32::max));
    }
}

/// A script that makes the annotations markers of Blender's timeline; run there after the import as
/// `exec(bpy.context.scene["chereme_markers"])`.
const BLENDER_MARKERS_SCRIPT: &str = r#"import bpy, json
scene = bpy.context.scene
rate = scene.render.fps / scene.render.fps_base
for note in json.loads(scene["chereme_annotations"]):
    name = note["tier"] + (": " + note["value"] if note["value"] else "")
    scene.timeline_markers.new(name, frame=round(note["begin"] * rate))
"#;

/// Returns a clip in metres of model space as a GLB.
///
/// Joints keep their names; one whose name is empty or occurs again gets a unique name, and the node's `extras.name`
/// holds the original one. `extras.tip` is the end of a bone without a further joint. The annotations are a JSON string
/// in `scenes[0].extras.chereme_annotations`, where Blender keeps them, and JSON in `animations[0].extras`, where
/// three.js does. `chereme_markers` in the former is a script that makes them markers of Blender's timeline.
///
/// # Errors
/// [`TooFar`] if a place does not fit into 32-bit numbers.
pub fn write_glb(clip: &Clip, about: &GlbDescription) -> Result<Vec<u8>, TooFar> {
    write_glb_with_figure(clip, about, None)
}

/// Does the same as [`write_glb`], with a visible body instead of bones.
///
/// Its bones are nodes below the joints, with `extras.chereme_figure`: [`read_gltf`](super::read_gltf) passes them over, so
/// that the movement comes back as it was.
///
/// # Errors
/// The same as [`write_glb`]'s.
pub fn write_glb_with_figure(
    clip: &Clip,
    about: &GlbDescription,
    figure: Option<&GlbFigure>,
) -> Result<Vec<u8>, TooFar> {
    reach::check_clip_reach(clip)?;
    let skeleton = clip.clip_skeleton();
    let mut parts = GlbParts::default();
    let mut nodes = nodes(skeleton);
    let mut binds = inverse_binds(skeleton);
    let (mut moved, mut mesh) = (Vec::new(), None);
    if let Some(figure) = figure {
        let (figure_binds, figure_moved) = gltf_figure::add_figure_bones(figure, clip, &mut nodes, &mut parts);
        binds.extend(figure_binds);
        moved = figure_moved;
        let (figure_mesh, shares) = gltf_figure::figure_mesh(figure, skeleton.len(), &mut parts);
        moved.extend(shares.map(|shares| AnimatedNode::new(nodes.len(), "weights", shares)));
        mesh = Some(figure_mesh);
    }
    let animation = animation(clip, about, moved, &mut parts);
    let inverse = parts.add_float_accessor(&binds, "MAT4", 16, None);
    let mesh = mesh.or_else(|| skeleton_bone_mesh(skeleton, &mut parts));
    let joints: Vec<usize> = (0..nodes.len()).collect();
    let mut roots = vec![0];
    if let Some(mesh) = &mesh {
        // A skinned mesh belongs at the root: its own place in the tree is ignored.
        roots.push(nodes.len());
        nodes.push(json!({"name": mesh["name"], "mesh": 0, "skin": 0}));
    }
    let rate = clip.clip_frame_rate();
    let notes = serde_json::to_string(&about.notes).unwrap_or_default();
    let mut document = json!({
        "asset": {"version": "2.0", "generator": format!("Chereme {}", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"name": about.glb_scene_name(), "nodes": roots, "extras": {
            "chereme_annotations": notes,
            "chereme_frames_per_second": rate.per_second(),
            "chereme_markers": BLENDER_MARKERS_SCRIPT,
        }}],
        "nodes": nodes,
        "skins": [{"joints": joints, "skeleton": 0, "inverseBindMatrices": inverse}],
        "buffers": [{"byteLength": parts.bytes.len()}],
        "bufferViews": parts.views,
        "accessors": parts.accessors,
    });
    if let Some(animation) = animation {
        document["animations"] = json!([animation]);
    }
    if let Some(mesh) = mesh {
        document["meshes"] = json!([mesh]);
        // The vertices of a figure have colours of their own.
        let colour = if figure.is_some() {
            [1.0; 4]
        } else {
            [0.8, 0.75, 0.7, 1.0]
        };
        document["materials"] = json!([{"name": "surface", "pbrMetallicRoughness":
            {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.9}}]);
    }
    if let Some(licence) = &about.licence {
        document["asset"]["copyright"] = licence.as_str().into();
    }
    Ok(pack_glb_container(&document, parts.bytes))
}

/// Packs JSON and numbers into the chunks of a GLB.
pub(super) fn pack_glb_container(document: &Value, mut numbers: Vec<u8>) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    numbers.resize(numbers.len().next_multiple_of(4), 0);
    let total = 12 + 8 + text.len() + 8 + numbers.len();
    let mut out = b"glTF".to_vec();
    let word = |out: &mut Vec<u8>, value: usize| out.extend((value as u32).to_le_bytes());
    word(&mut out, 2);
    word(&mut out, total);
    word(&mut out, text.len());
    out.extend(b"JSON");
    out.extend(text);
    word(&mut out, numbers.len());
    out.extend(b"BIN\0");
    out.extend(numbers);
    out
}

/// Replaces all characters except letters, digits and underscores, as some readers change them.
pub(super) fn plain_node_name(name: &str) -> String {
    let change = |letter: char| {
        if letter.is_alphanumeric() { letter } else { '_' }
    };
    name.chars().map(change).collect()
}

fn nodes(skeleton: &Skeleton) -> Vec<Value> {
    let joint_names = skeleton.skeleton_joints().iter().map(|joint| joint.name.as_str());
    let names = unique_track_names(joint_names, "joint");
    let mut nodes: Vec<Value> = Vec::new();
    for (at, (joint, name)) in skeleton.skeleton_joints().iter().zip(names).enumerate() {
        let (mut node, mut extras) = (Map::new(), Map::new());
        if name != joint.name {
            extras.insert("name".into(), json!(joint.name));
        }
        if let Some(tip) = joint.tip {
            extras.insert("tip".into(), json!(to_gltf_vector(tip)));
        }
        if !extras.is_empty() {
            node.insert("extras".into(), extras.into());
        }
        node.insert("name".into(), name.into());
        node.insert("translation".into(), json!(to_gltf_vector(joint.offset)));
        node.insert("rotation".into(), json!(to_gltf_rotation(joint.rest)));
        let children: Vec<usize> = (at + 1..skeleton.len())
            .filter(|child| skeleton.skeleton_joints()[*child].parent == Some(at))
            .collect();
        if !children.is_empty() {
            node.insert("children".into(), json!(children));
        }
        nodes.push(node.into());
    }
    nodes
}

pub(super) fn to_gltf_vector(at: DVec3) -> [f32; 3] {
    at.as_vec3().to_array()
}

/// Returns a rotation as glTF writes it: unit length in 32 bits, x y z w.
pub(super) fn to_gltf_rotation(rotation: DQuat) -> [f32; 4] {
    rotation.normalize().as_quat().normalize().to_array()
}

/// The values that move a node, one for each frame of the clip.
pub(super) struct AnimatedNode {
    node: usize,
    path: &'static str,
    output: usize,
}

impl AnimatedNode {
    pub(super) fn new(node: usize, path: &'static str, output: usize) -> Self {
        Self { node, path, output }
    }
}

/// Returns rotations as numbers. The two quaternions of a rotation interpolate differently; the nearer one is taken.
pub(super) fn near_turns(rotations: &[DQuat]) -> Vec<f32> {
    let mut before = DQuat::IDENTITY;
    let turns = rotations.iter().flat_map(|rotation| {
        before = if before.dot(*rotation) < 0.0 {
            -*rotation
        } else {
            *rotation
        };
        to_gltf_rotation(before)
    });
    turns.collect()
}

fn animation(clip: &Clip, about: &GlbDescription, moved: Vec<AnimatedNode>, parts: &mut GlbParts) -> Option<Value> {
    let frames = clip.clip_frame_count();
    if frames == 0 {
        return None;
    }
    let rate = clip.clip_frame_rate();
    let times: Vec<f32> = (0..frames)
        .map(|frame| (frame as f64 * rate.frame_time()) as f32)
        .collect();
    let input = parts.add_float_accessor(&times, "SCALAR", 1, None);
    parts.set_accessor_bounds(input, &times, 1);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut add = |moved: AnimatedNode| {
        channels.push(json!({"sampler": samplers.len(), "target": {"node": moved.node, "path": moved.path}}));
        samplers.push(json!({"input": input, "output": moved.output, "interpolation": "LINEAR"}));
    };
    for (joint, channel) in clip.joint_channels().iter().enumerate() {
        let output = parts.add_float_accessor(&near_turns(&channel.rotations), "VEC4", 4, None);
        add(AnimatedNode::new(joint, "rotation", output));
        if let Some(places) = &channel.translations {
            let places: Vec<f32> = places.iter().flat_map(|at| to_gltf_vector(*at)).collect();
            let output = parts.add_float_accessor(&places, "VEC3", 3, None);
            add(AnimatedNode::new(joint, "translation", output));
        }
    }
    moved.into_iter().for_each(add);
    Some(json!({
        "name": about.name,
        "channels": channels,
        "samplers": samplers,
        "extras": {"annotations": about.notes, "frames_per_second": rate.per_second()},
    }))
}

fn inverse_binds(skeleton: &Skeleton) -> Vec<f32> {
    let rest = skeleton_rest_pose(skeleton);
    let mut values = Vec::with_capacity(16 * skeleton.len());
    for joint in 0..skeleton.len() {
        let bind = DMat4::from_rotation_translation(rest.model_joint_rotation(joint), rest.model_joint_position(joint));
        let mut inverse = bind.inverse().as_mat4().to_cols_array();
        // The last row of an inverse bind matrix must be exactly 0 0 0 1.
        for (at, value) in [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)] {
            inverse[at] = value;
        }
        values.extend(inverse);
    }
    values
}

/// Returns a mesh with an eight-sided body for each bone; `None` if no bone has a length.
fn skeleton_bone_mesh(skeleton: &Skeleton, parts: &mut GlbParts) -> Option<Value> {
    let rest = skeleton_rest_pose(skeleton);
    let (mut places, mut joints, mut weights, mut indices) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut bone = |joint: usize, from: DVec3, to: DVec3| {
        let along = to - from;
        let length = along.length();
        // Corners are counted with 16 bits.
        if length < MIN_MESH_BONE_METRES || places.len() / 3 + 6 > usize::from(u16::MAX) {
            return;
        }
        let across = along.any_orthonormal_vector() * length * BONE_THICKNESS_SHARE;
        let other = along.normalize().cross(across);
        let middle = from + along * BONE_SHOULDER_SHARE;
        let first = (places.len() / 3) as u16;
        let corners = [
            from,
            middle + across,
            middle + other,
            middle - across,
            middle - other,
            to,
        ];
        for corner in corners {
            places.extend(to_gltf_vector(corner));
            joints.extend([joint as u16, 0, 0, 0]);
            weights.extend([1.0f32, 0.0, 0.0, 0.0]);
        }
        for side in 0..4u16 {
            let (a, b) = (1 + side, 1 + (side + 1) % 4);
            indices.extend([first, first + b, first + a, first + 5, first + a, first + b]);
        }
    };
    for (at, joint) in skeleton.skeleton_joints().iter().enumerate() {
        if let Some(parent) = joint.parent {
            bone(parent, rest.model_joint_position(parent), rest.model_joint_position(at));
        }
        if let Some(tip) = joint.tip {
            bone(at, rest.model_joint_position(at), rest.joint_point_to_model(at, tip));
        }
    }
    if places.is_empty() {
        return None;
    }
    let position = parts.add_float_accessor(&places, "VEC3", 3, Some(VERTEX_BUFFER_TARGET));
    parts.set_accessor_bounds(position, &places, 3);
    let bytes: Vec<u8> = joints.iter().flat_map(|joint| joint.to_le_bytes()).collect();
    let view = parts.add_buffer_view(&bytes, Some(VERTEX_BUFFER_TARGET));
    let joint = parts.add_accessor(view, (SHORT_COMPONENT_TYPE, "VEC4"), joints.len() / 4);
    let weight = parts.add_float_accessor(&weights, "VEC4", 4, Some(VERTEX_BUFFER_TARGET));
    let bytes: Vec<u8> = indices.iter().flat_map(|index: &u16| index.to_le_bytes()).collect();
    let view = parts.add_buffer_view(&bytes, Some(INDEX_BUFFER_TARGET));
    let index = parts.add_accessor(view, (SHORT_COMPONENT_TYPE, "SCALAR"), indices.len());
    Some(json!({"name": "bones", "primitives": [{
        "attributes": {"POSITION": position, "JOINTS_0": joint, "WEIGHTS_0": weight},
        "indices": index, "material": 0, "mode": 4,
    }]}))
}
