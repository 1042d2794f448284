//! The skeleton of a glTF document.

use std::collections::BTreeMap;

use chereme_motion::SkeletonJoint;
use chereme_motion::glam::{DMat4, DQuat, DVec3};

use super::error::GltfError;
use super::gltf_figure::FIGURE_MARK;
use super::gltf_model::{FaceNode, GltfDocument, GltfNode};
use super::sample::unit_rotation_from;
use crate::tally::FindingTally;
use crate::tracks::unique_track_names;

/// Largest difference of scales, from 1 or from each other, that count as equal.
pub(super) const SAME_SCALE: f64 = 1e-4;
/// The most nodes of a file.
const MOST_NODES: usize = 20_000;

/// The nodes that are joints, parents before children, with scales folded into offsets.
pub(super) struct GltfRig {
    /// The node of each joint; `None` for a root that joins several trees.
    pub(super) nodes: Vec<Option<usize>>,
    pub(super) joints: Vec<SkeletonJoint>,
    /// The scale of each joint's translations.
    pub(super) scales: Vec<f64>,
}

/// The translation, rotation and scale of a node.
fn transform(node: &GltfNode) -> (DVec3, DQuat, DVec3) {
    if let Some(matrix) = &node.matrix {
        let (scale, rotation, translation) = DMat4::from_cols_array(matrix).to_scale_rotation_translation();
        let sound = scale.is_finite() && rotation.is_finite() && translation.is_finite();
        if sound {
            return (translation, unit_rotation_from(&rotation.to_array()), scale);
        }
    }
    let translation = DVec3::from_array(node.translation.unwrap_or_default());
    let rotation = node
        .rotation
        .map_or(DQuat::IDENTITY, |rotation| unit_rotation_from(&rotation));
    let scale = DVec3::from_array(node.scale.unwrap_or([1.0; 3]));
    (translation, rotation, scale)
}

impl GltfRig {
    /// Returns the joints of skins, animated nodes and all nodes above them.
    ///
    /// # Errors
    /// [`Error`] if a node is missing, has two parents or is below itself, or no node is a joint.
    pub(super) fn rig_from_document(document: &GltfDocument, findings: &mut FindingTally) -> Result<Self, GltfError> {
        let nodes = &document.nodes;
        if nodes.len() > MOST_NODES {
            return Err(GltfError::Skeleton(format!("{} nodes are too many", nodes.len())));
        }
        let mut parents = vec![None; nodes.len()];
        for (at, node) in nodes.iter().enumerate() {
            for child in &node.children {
                let fault = |problem: &str| GltfError::gltf_element_error("nodes", at, problem);
                let parent = parents
                    .get_mut(*child)
                    .ok_or_else(|| fault("has a child that does not exist"))?;
                if parent.replace(at).is_some() {
                    return Err(fault("shares a child with another node"));
                }
            }
        }
        if let Some(at) = below_itself(nodes, &parents) {
            return Err(GltfError::gltf_element_error("nodes", at, "is below itself"));
        }
        let mut kept = mark_kept_nodes(document, &parents, &document.face_nodes())?;
        // A file of a face alone has nothing else to show.
        if !kept.contains(&true) {
            kept = self::mark_kept_nodes(document, &parents, &BTreeMap::new())?;
        }
        let roots: Vec<usize> = (0..nodes.len())
            .filter(|at| kept[*at] && parents[*at].is_none())
            .collect();
        if roots.is_empty() {
            return Err(GltfError::NoSkeleton);
        }
        let mut rig = Self {
            nodes: Vec::new(),
            joints: Vec::new(),
            scales: Vec::new(),
        };
        if roots.len() > 1 {
            rig.nodes.push(None);
            rig.joints.push(SkeletonJoint::new("scene", None, DVec3::ZERO));
            rig.scales.push(1.0);
            findings.push_note_finding(None, format!("{} trees of joints were put below one root", roots.len()));
        }
        let top = (roots.len() > 1).then_some(0);
        // Taken from the end, so that children keep the order of the file; recursion could run out of stack.
        let mut open: Vec<(usize, Option<usize>, f64)> = roots.iter().rev().map(|root| (*root, top, 1.0)).collect();
        while let Some((at, parent, above)) = open.pop() {
            let (translation, rotation, scale) = transform(&nodes[at]);
            let offset = translation * above;
            if !offset.is_finite() || rig.joints.len() > nodes.len() {
                return Err(GltfError::gltf_element_error(
                    "nodes",
                    at,
                    "has a place that is no number",
                ));
            }
            // The scale of a node applies to what is below it, and not to its own place.
            let below = above * uniform(scale, at, &nodes[at], findings);
            rig.joints.push(SkeletonJoint {
                rest: rotation,
                tip: node_bone_tip(nodes, at, &kept).map(|tip| tip * below),
                ..SkeletonJoint::new(original_node_name(&nodes[at], at), parent, offset)
            });
            rig.nodes.push(Some(at));
            rig.scales.push(above);
            let joint = rig.joints.len() - 1;
            let children = nodes[at].children.iter().rev().filter(|child| kept[**child]);
            open.extend(children.map(|child| (*child, Some(joint), below)));
        }
        let names: Vec<String> = rig.joints.iter().map(|joint| joint.name.clone()).collect();
        for (joint, name) in rig
            .joints
            .iter_mut()
            .zip(unique_track_names(names.iter().map(String::as_str), "joint"))
        {
            joint.name = name;
        }
        Ok(rig)
    }
}

/// Returns a node that no root leads to, because it is an ancestor of itself.
fn below_itself(nodes: &[GltfNode], parents: &[Option<usize>]) -> Option<usize> {
    let mut reached = vec![false; nodes.len()];
    let roots = (0..nodes.len()).filter(|at| parents[*at].is_none());
    let mut open: Vec<usize> = roots.collect();
    while let Some(at) = open.pop() {
        reached[at] = true;
        open.extend(&nodes[at].children);
    }
    reached.iter().position(|reached| !reached)
}

/// Returns a node's original name, undoing an exporter's changes.
fn original_node_name(node: &GltfNode, at: usize) -> String {
    let original = node.extras.get("name").and_then(serde_json::Value::as_str);
    let name = original.or(node.name.as_deref()).unwrap_or_default();
    if name.is_empty() {
        format!("node {at}")
    } else {
        name.to_owned()
    }
}

/// Returns the end of a bone without a further joint: the one that [`super::write()`] wrote, or the only child if other
/// programs name it as an end.
fn node_bone_tip(nodes: &[GltfNode], at: usize, kept: &[bool]) -> Option<DVec3> {
    let node = &nodes[at];
    let written = node.extras.get("tip").and_then(|tip| {
        let number = |at: usize| tip.get(at)?.as_f64();
        Some(DVec3::new(number(0)?, number(1)?, number(2)?))
    });
    let child = match *node.children.as_slice() {
        [child] if !kept[child] && is_end(&nodes[child]) => Some(transform(&nodes[child]).0),
        _ => None,
    };
    written.or(child).filter(|tip| tip.is_finite())
}

/// Returns whether a node only marks the end of a bone: `Head_end`, `LeftHandIndex4_end`, `End Site`.
fn is_end(node: &GltfNode) -> bool {
    let name = node.name.as_deref().unwrap_or_default().to_lowercase();
    let marks = ["_end", ".end", "end site", "endsite", "_tip", "_nub"];
    node.mesh.is_none() && node.children.is_empty() && marks.iter().any(|mark| name.ends_with(mark))
}

/// Returns a scale as one number, and reports a scale that differs between axes.
fn uniform(scale: DVec3, at: usize, node: &GltfNode, findings: &mut FindingTally) -> f64 {
    let mean = (scale.x.abs() + scale.y.abs() + scale.z.abs()) / 3.0;
    let even = (scale.abs() - DVec3::splat(mean)).abs().max_element() <= SAME_SCALE * mean.max(1.0);
    if !even || scale.min_element() < 0.0 || !mean.is_finite() {
        let name = original_node_name(node, at);
        findings.add_limited_warning("scales that are not even", None, || {
            format!("the node {name:?} is stretched or mirrored; its mean scale is taken")
        });
    }
    let near_one = (mean - 1.0).abs() <= SAME_SCALE;
    if near_one || !mean.is_finite() { 1.0 } else { mean }
}

/// Marks joints of skins, animated nodes that stand for no part of a face, and all nodes above them.
fn mark_kept_nodes(
    document: &GltfDocument,
    parents: &[Option<usize>],
    face: &BTreeMap<usize, FaceNode>,
) -> Result<Vec<bool>, GltfError> {
    let mut kept = vec![false; parents.len()];
    let of_skins = document.skins.iter().flat_map(|skin| skin.joints.iter().copied());
    let animated_nodes = document.animations.iter().flat_map(|animation| &animation.channels);
    let animated = animated_nodes
        .filter(|channel| channel.target.path != "weights")
        .filter_map(|channel| channel.target.node)
        .filter(|node| !face.contains_key(node));
    // Bones that only carry a visible body are no joints of the movement.
    let of_figure = |node: &usize| {
        document
            .nodes
            .get(*node)
            .is_some_and(|node| node.extras.get(FIGURE_MARK).is_some())
    };
    for node in of_skins.chain(animated).filter(|node| !of_figure(node)) {
        let mut ancestor = Some(node);
        let mut steps = 0;
        while let Some(node) = ancestor {
            let mark = kept
                .get_mut(node)
                .ok_or_else(|| GltfError::gltf_element_error("nodes", node, "does not exist"))?;
            steps += 1;
            if steps > parents.len() {
                return Err(GltfError::gltf_element_error("nodes", node, "is its own ancestor"));
            }
            // All nodes above a marked one are marked already.
            if *mark && steps > 1 {
                break;
            }
            *mark = true;
            ancestor = parents[node];
        }
    }
    Ok(kept)
}
