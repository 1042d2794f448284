//! The visible body of a GLB: a skin over bones below the joints of a clip, and the changes of its face.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, ModelPose};
use serde_json::{Value, json};

use super::gltf_write::{
    AnimatedNode, FLOAT_COMPONENT_TYPE, GlbParts, INDEX_BUFFER_TARGET, SHORT_COMPONENT_TYPE, VERTEX_BUFFER_TARGET,
    near_turns, to_gltf_rotation, to_gltf_vector,
};

/// A visible body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GlbFigure {
    /// The vertices as they are bound.
    pub vertices: Vec<GlbVertex>,
    /// The corners of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The bones; the first joints of the skin are those of the clip.
    pub bones: Vec<GlbFigureBone>,
    /// The changes of the face that the clip shows.
    pub morphs: Vec<GlbFigureMorph>,
}

/// A vertex of a visible body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlbVertex {
    /// The position in metres.
    pub place: [f32; 3],
    /// The outward direction, of length one.
    pub normal: [f32; 3],
    /// The parts of red, green and blue, as screens have them (sRGB).
    pub colour: [u8; 3],
    /// The bones that move it.
    pub bones: [u16; 4],
    /// Their weights, whose sum is 1.
    pub weights: [f32; 4],
}

/// A bone of a visible body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GlbFigureBone {
    /// The joint of the clip below which it hangs.
    pub joint: usize,
    /// Its position where the vertices are bound; it is not rotated there.
    pub bind: [f32; 3],
    /// Its rotations in model space, one for each frame.
    pub turns: Vec<DQuat>,
    /// Its places in model space, one for each frame.
    pub places: Vec<DVec3>,
}

/// A change of a visible face.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GlbFigureMorph {
    /// Its name.
    pub name: String,
    /// The vertices that move, in rising order.
    pub vertices: Vec<u32>,
    /// How far each of them moves, in metres.
    pub offsets: Vec<[f32; 3]>,
    /// The share of the change at each frame.
    pub shares: Vec<f32>,
}

/// The mark of a node that only carries a visible body, in its extras.
pub(super) const FIGURE_MARK: &str = "chereme_figure";
/// The largest rotation in radians, and the largest shift in metres, of a bone that counts as fixed to its joint.
const FIXED_BONE_LIMITS: (f64, f64) = (1e-4, 1e-5);
const INTEGER_COMPONENT_TYPE: u32 = 5125;

/// Adds the bones as nodes below the joints; returns the inverse of each bone's bound place, and the nodes that move.
pub(super) fn add_figure_bones(
    figure: &GlbFigure,
    clip: &Clip,
    nodes: &mut Vec<Value>,
    parts: &mut GlbParts,
) -> (Vec<f32>, Vec<AnimatedNode>) {
    let (mut inverse, mut moved) = (Vec::new(), Vec::new());
    let poses: Vec<ModelPose> = (0..clip.clip_frame_count())
        .map(|frame| clip.model_pose(frame))
        .collect();
    for bone in &figure.bones {
        let [x, y, z] = bone.bind.map(|number| -number);
        inverse.extend([1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0]);
        let back = |frame: usize| poses[frame].model_joint_rotation(bone.joint).inverse();
        let turns: Vec<DQuat> = bone
            .turns
            .iter()
            .enumerate()
            .map(|(frame, turn)| back(frame) * *turn)
            .collect();
        let places = bone.places.iter().enumerate();
        let places: Vec<DVec3> = places
            .map(|(frame, place)| back(frame) * (*place - poses[frame].model_joint_position(bone.joint)))
            .collect();
        let (Some(&turn), Some(&place)) = (turns.first(), places.first()) else {
            continue;
        };
        let node = nodes.len();
        nodes.push(json!({
            "name": format!("figure_{node}"),
            "translation": to_gltf_vector(place),
            "rotation": to_gltf_rotation(turn),
            "extras": {FIGURE_MARK: true},
        }));
        let above = &mut nodes[bone.joint]["children"];
        match above.as_array_mut() {
            Some(children) => children.push(node.into()),
            None => *above = json!([node]),
        }
        // Most bones keep their place below their joint, so that the file needs no keys for them.
        let (most_turn, most_shift) = FIXED_BONE_LIMITS;
        if turns.iter().any(|other| other.angle_between(turn) > most_turn) {
            let output = parts.add_float_accessor(&near_turns(&turns), "VEC4", 4, None);
            moved.push(AnimatedNode::new(node, "rotation", output));
        }
        if places.iter().any(|other| other.distance(place) > most_shift) {
            let numbers: Vec<f32> = places.iter().flat_map(|place| to_gltf_vector(*place)).collect();
            let output = parts.add_float_accessor(&numbers, "VEC3", 3, None);
            moved.push(AnimatedNode::new(node, "translation", output));
        }
    }
    (inverse, moved)
}

/// Returns the mesh of a visible body whose bones follow `first_bone` joints in the skin, and the shares of its face.
pub(super) fn figure_mesh(figure: &GlbFigure, first_bone: usize, parts: &mut GlbParts) -> (Value, Option<usize>) {
    let all = &figure.vertices;
    let numbers = |part: fn(&GlbVertex) -> [f32; 3]| all.iter().flat_map(part).collect::<Vec<f32>>();
    let places = numbers(|vertex| vertex.place);
    let position = parts.add_float_accessor(&places, "VEC3", 3, Some(VERTEX_BUFFER_TARGET));
    parts.set_accessor_bounds(position, &places, 3);
    let normal = parts.add_float_accessor(&numbers(|vertex| vertex.normal), "VEC3", 3, Some(VERTEX_BUFFER_TARGET));
    let colour = numbers(|vertex| vertex.colour.map(linear_colour_share));
    let colour = parts.add_float_accessor(&colour, "VEC3", 3, Some(VERTEX_BUFFER_TARGET));
    // A bone without weight must be the first of the skin.
    let bones = all.iter().flat_map(|vertex| {
        let weighted = vertex.bones.iter().zip(vertex.weights);
        weighted.flat_map(|(bone, weight)| {
            let index = if weight > 0.0 { first_bone as u16 + bone } else { 0 };
            index.to_le_bytes()
        })
    });
    let view = parts.add_buffer_view(&bones.collect::<Vec<u8>>(), Some(VERTEX_BUFFER_TARGET));
    let joint = parts.add_accessor(view, (SHORT_COMPONENT_TYPE, "VEC4"), all.len());
    let weights: Vec<f32> = all.iter().flat_map(|vertex| vertex.weights).collect();
    let weight = parts.add_float_accessor(&weights, "VEC4", 4, Some(VERTEX_BUFFER_TARGET));
    let corners = figure.triangles.iter().flatten();
    let bytes: Vec<u8> = corners.flat_map(|corner| corner.to_le_bytes()).collect();
    let view = parts.add_buffer_view(&bytes, Some(INDEX_BUFFER_TARGET));
    let index = parts.add_accessor(view, (INTEGER_COMPONENT_TYPE, "SCALAR"), figure.triangles.len() * 3);
    let targets: Vec<Value> = figure
        .morphs
        .iter()
        .map(|morph| morph_target(morph, all.len(), parts))
        .collect();
    let mut mesh = json!({"name": "figure", "primitives": [{
        "attributes": {"POSITION": position, "NORMAL": normal, "COLOR_0": colour,
            "JOINTS_0": joint, "WEIGHTS_0": weight},
        "indices": index, "material": 0, "mode": 4,
    }]});
    if targets.is_empty() {
        return (mesh, None);
    }
    let names: Vec<&str> = figure.morphs.iter().map(|morph| morph.name.as_str()).collect();
    mesh["primitives"][0]["targets"] = targets.into();
    mesh["weights"] = vec![0.0; names.len()].into();
    mesh["extras"] = json!({"targetNames": names});
    let frames = figure.morphs[0].shares.len();
    let shares: Vec<f32> = (0..frames)
        .flat_map(|frame| figure.morphs.iter().map(move |morph| morph.shares[frame]))
        .collect();
    (mesh, Some(parts.add_float_accessor(&shares, "SCALAR", 1, None)))
}

/// Returns a morph target that holds the vertices that move and no others.
fn morph_target(morph: &GlbFigureMorph, vertices: usize, parts: &mut GlbParts) -> Value {
    let indices: Vec<u8> = morph.vertices.iter().flat_map(|vertex| vertex.to_le_bytes()).collect();
    let offsets: Vec<f32> = morph.offsets.iter().flatten().copied().collect();
    let bytes: Vec<u8> = offsets.iter().flat_map(|number| number.to_le_bytes()).collect();
    let [index_view, view] = [indices, bytes].map(|bytes| parts.add_buffer_view(&bytes, None));
    parts.accessors.push(json!({
        "componentType": FLOAT_COMPONENT_TYPE, "type": "VEC3", "count": vertices,
        "sparse": {"count": morph.vertices.len(), "values": {"bufferView": view},
            "indices": {"bufferView": index_view, "componentType": INTEGER_COMPONENT_TYPE}},
    }));
    let accessor = parts.accessors.len() - 1;
    // Vertices that stay count for the bounds, too.
    let with_rest: Vec<f32> = offsets.into_iter().chain([0.0; 3]).collect();
    parts.set_accessor_bounds(accessor, &with_rest, 3);
    json!({"POSITION": accessor})
}

/// Returns a part of a colour as glTF keeps those of vertices: in proportion to light.
fn linear_colour_share(part: u8) -> f32 {
    let share = f32::from(part) / 255.0;
    if share <= 0.040_45 {
        share / 12.92
    } else {
        ((share + 0.055) / 1.055).powf(2.4)
    }
}
