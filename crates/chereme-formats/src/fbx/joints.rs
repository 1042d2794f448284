//! The nodes of a scene that are joints, and their places at a time.

use std::collections::BTreeSet;

use chereme_motion::SkeletonJoint;
use chereme_motion::glam::{DQuat, DVec3};
use ufbx::{Anim, ElementType, InheritMode, Node, Scene, Transform};

use crate::tally::FindingTally;
use crate::tracks::unique_track_names;

/// Largest difference of scales, from 1 or from each other, that count as equal.
const SAME_SCALE: f64 = 1e-4;

/// The nodes that are joints, parents first.
pub(super) struct FbxRig<'s> {
    /// The node of each joint; `None` for a root that joins several trees.
    nodes: Vec<Option<&'s Node>>,
    pub(super) joints: Vec<SkeletonJoint>,
    /// The channels of translation that each joint has.
    pub(super) moves: Vec<bool>,
}

/// A joint in its parent's space.
#[derive(Debug, Clone, Copy)]
pub(super) struct LocalJointTransform {
    pub(super) place: DVec3,
    pub(super) turn: DQuat,
}

/// The nodes that an animation changes, by element.
#[derive(Default)]
pub(super) struct AnimatedNodes {
    pub(super) nodes: BTreeSet<u32>,
    places: BTreeSet<u32>,
}

impl AnimatedNodes {
    /// Returns the nodes that an animation of layers changes.
    pub(super) fn nodes_of_stack(stack: &ufbx::AnimStack) -> Self {
        let mut animated = Self::default();
        for prop in stack.layers.into_iter().flat_map(|layer| layer.anim_props.iter()) {
            if prop.element.type_ != ElementType::Node {
                continue;
            }
            let id = prop.element.element_id;
            match &*prop.prop_name {
                "Lcl Translation" => {
                    animated.nodes.insert(id);
                    animated.places.insert(id);
                }
                "Lcl Rotation" | "Lcl Scaling" => {
                    animated.nodes.insert(id);
                }
                _ => {}
            }
        }
        animated
    }
}

impl<'s> FbxRig<'s> {
    /// Returns the joints of a scene: bones, animated nodes other than cameras, lights and meshes, and all nodes above
    /// them.
    pub(super) fn rig_from_scene(scene: &'s Scene, animated: &AnimatedNodes, findings: &mut FindingTally) -> Self {
        let is_joint = |node: &Node| match node.attrib_type {
            ElementType::Bone => true,
            ElementType::Unknown | ElementType::Empty | ElementType::Marker => {
                animated.nodes.contains(&node.element.element_id)
            }
            _ => false,
        };
        let mut kept = BTreeSet::new();
        for node in &scene.nodes {
            if node.is_root || !is_joint(node) {
                continue;
            }
            let mut ancestor = Some(node);
            while let Some(node) = ancestor.filter(|node| !node.is_root) {
                if !kept.insert(node.element.element_id) {
                    break;
                }
                ancestor = node.parent.as_deref();
            }
        }
        let kept_below = |node: &'s Node| -> Vec<&'s Node> {
            let children = node.children.into_iter();
            children
                .filter(|child| kept.contains(&child.element.element_id))
                .collect()
        };
        let roots = kept_below(&scene.root_node);
        let mut rig = Self {
            nodes: Vec::new(),
            joints: Vec::new(),
            moves: Vec::new(),
        };
        if roots.len() > 1 {
            rig.nodes.push(None);
            rig.joints.push(SkeletonJoint::new("scene", None, DVec3::ZERO));
            rig.moves.push(false);
            findings.push_note_finding(None, format!("{} trees of joints were put below one root", roots.len()));
        }
        let top = (roots.len() > 1).then_some(0);
        let mut open: Vec<(&Node, Option<usize>)> = roots.into_iter().rev().map(|root| (root, top)).collect();
        while let Some((node, parent)) = open.pop() {
            let name = match &*node.element.name {
                "" => format!("node {}", node.element.typed_id),
                name => name.to_owned(),
            };
            rig.joints.push(SkeletonJoint::new(name, parent, DVec3::ZERO));
            rig.nodes.push(Some(node));
            let id = node.element.element_id;
            rig.moves.push(parent.is_none() || animated.places.contains(&id));
            let joint = rig.joints.len() - 1;
            open.extend(kept_below(node).into_iter().rev().map(|child| (child, Some(joint))));
        }
        let joint_names: Vec<String> = rig.joints.iter().map(|joint| joint.name.clone()).collect();
        let names = unique_track_names(joint_names.iter().map(String::as_str), "joint");
        for (joint, name) in rig.joints.iter_mut().zip(names) {
            joint.name = name;
        }
        // Joints below an animated scale move with it.
        for joint in 0..rig.joints.len() {
            let above = rig.joints[joint].parent.and_then(|parent| rig.nodes[parent]);
            rig.moves[joint] |= above.is_some_and(|node| {
                animated.nodes.contains(&node.element.element_id) && !is_one(node.local_transform.scale)
            });
        }
        rig.set_rest_transforms(findings);
        rig
    }

    /// Gives every joint its place and rotation at rest.
    fn set_rest_transforms(&mut self, findings: &mut FindingTally) {
        for node in self.nodes.iter().flatten() {
            let scale = node.local_transform.scale;
            let mean = mean_scale(scale);
            let even = [scale.x, scale.y, scale.z]
                .iter()
                .all(|scale| (scale - mean).abs() <= SAME_SCALE * mean.max(1.0));
            if !even {
                findings.add_limited_warning("scales that are not even", None, || {
                    format!(
                        "the node {:?} is stretched or mirrored; its mean scale is taken",
                        &*node.element.name
                    )
                });
            }
        }
        let locals = self.locals(|node| node.local_transform);
        for (joint, local) in self.joints.iter_mut().zip(locals) {
            joint.offset = local.place;
            joint.rest = local.turn;
        }
    }

    /// Returns the places and rotations of all joints at a time of an animation, in seconds.
    pub(super) fn joint_transforms_at(&self, anim: &Anim, time: f64) -> Vec<LocalJointTransform> {
        self.locals(|node| ufbx::evaluate_transform(anim, node, time))
    }

    /// Returns every joint in its parent's space; its place includes the scales of the nodes above it.
    fn locals(&self, transform: impl Fn(&Node) -> Transform) -> Vec<LocalJointTransform> {
        let mut scales: Vec<(f64, f64)> = Vec::with_capacity(self.joints.len());
        let mut locals = Vec::with_capacity(self.joints.len());
        for (node, joint) in self.nodes.iter().zip(&self.joints) {
            let (above, own_above) = joint.parent.map_or((1.0, 1.0), |parent| scales[parent]);
            let Some(node) = node else {
                scales.push((1.0, 1.0));
                locals.push(LocalJointTransform {
                    place: DVec3::ZERO,
                    turn: DQuat::IDENTITY,
                });
                continue;
            };
            let local = transform(node);
            let local_scale = mean_scale(local.scale);
            let inherited = match node.inherit_mode {
                InheritMode::IgnoreParentScale if own_above.abs() > 1e-12 => above / own_above,
                _ => above,
            };
            scales.push((inherited * local_scale, local_scale));
            let (place, turn) = (local.translation, local.rotation);
            let turn = DQuat::from_xyzw(turn.x, turn.y, turn.z, turn.w);
            locals.push(LocalJointTransform {
                place: DVec3::new(place.x, place.y, place.z) * above,
                turn: if turn.length() > 1e-9 {
                    turn.normalize()
                } else {
                    DQuat::IDENTITY
                },
            });
        }
        locals
    }
}

fn mean_scale(scale: ufbx::Vec3) -> f64 {
    let mean = (scale.x.abs() + scale.y.abs() + scale.z.abs()) / 3.0;
    if mean.is_finite() { mean } else { 1.0 }
}

fn is_one(scale: ufbx::Vec3) -> bool {
    (mean_scale(scale) - 1.0).abs() <= SAME_SCALE
}
