//! Plain forms for skeletons that lack joints of a dressed body: rods, and a slab for the trunk.

use chereme_motion::{BodySide, anatomy::BodyPart};
use glam::Vec3;

use super::body_builder::BodyBuilder;
use super::body_shape::{
    BodyLoft, BodyRod, JointPoint, LoftSection, ShapePaint, posed_joint_position, posed_joint_rotation,
};
use super::group;

/// A reference for points of a trunk without joints, below the middle of the shoulders.
struct TrunkReference {
    joint: usize,
    at: Vec3,
    turn: glam::Quat,
    from: Vec3,
    up: Vec3,
}

impl TrunkReference {
    /// Returns the point `down` metres below the shoulders.
    fn point_below_shoulders(&self, down: f32) -> JointPoint {
        JointPoint {
            joint: self.joint,
            local: self.turn * (self.from - self.up * down - self.at),
        }
    }
}

impl BodyBuilder<'_> {
    /// Adds a rod between two joints; radii are those of an adult.
    pub(super) fn add_limb_rod(&mut self, from: usize, to: usize, radii: [f32; 3], paint: ShapePaint) {
        let bone = posed_joint_rotation(self.rest, from).inverse()
            * (posed_joint_position(self.rest, to) - posed_joint_position(self.rest, from));
        let rod = BodyRod {
            ends: [JointPoint::from_joint_index(from), JointPoint::from_joint_index(to)],
            radii: radii.map(|radius| radius * self.size),
            facing: (from, bone.normalize_or(Vec3::X).any_orthonormal_vector()),
            columns: 20,
        };
        self.out.add_body_rod(rod, paint);
    }

    pub(super) fn plain_arm(&mut self, side: BodySide) {
        let parts = [BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side)];
        let paint = ShapePaint::from_plain_colour(self.palette.sleeves, group::arm_group(side));
        let [Some(upper), Some(forearm), Some(hand)] = parts.map(|part| self.joint_of_part(part)) else {
            return;
        };
        self.add_limb_rod(upper, forearm, [0.058, 0.050, 0.043], paint);
        self.add_limb_rod(forearm, hand, [0.043, 0.038, 0.026], paint);
    }

    pub(super) fn add_leg_rods(&mut self, side: BodySide) {
        let paint = ShapePaint::from_plain_colour(self.palette.legs, group::REMAINING_BODY_GROUP);
        let parts = [
            BodyPart::Thigh(side),
            BodyPart::Shin(side),
            BodyPart::Foot(side),
            BodyPart::Toes(side),
        ];
        let radii = [[0.050, 0.068, 0.052], [0.055, 0.052, 0.038], [0.038, 0.035, 0.030]];
        for (pair, radii) in parts.windows(2).zip(radii) {
            if let (Some(from), Some(to)) = (self.joint_of_part(pair[0]), self.joint_of_part(pair[1])) {
                self.add_limb_rod(from, to, radii, paint);
            }
        }
    }

    pub(super) fn plain_torso(&mut self) {
        let paint = ShapePaint::from_plain_colour(self.palette.torso, group::TORSO_GROUP);
        let upper = BodySide::BOTH_SIDES.map(|side| self.joint_of_part(BodyPart::UpperArm(side)));
        let [Some(right), Some(left)] = upper else {
            return;
        };
        let size = self.size;
        let hang = self.trunk_reference(right, left);
        let top = self
            .joint_of_part(BodyPart::Neck)
            .or(self.joint_of_part(BodyPart::Head));
        let neck = top.map_or_else(
            || hang.point_below_shoulders(-0.09 * size),
            JointPoint::from_joint_index,
        );
        let hips = self
            .joint_of_part(BodyPart::Hips)
            .filter(|&hips| posed_joint_position(self.rest, hips).distance(hang.from) > 0.25 * size);
        let middle = match (hips, top) {
            (Some(hips), Some(top)) => JointPoint::from_joint_index(self.spine_middle(hips, top)),
            (Some(hips), None) => {
                let far = posed_joint_position(self.rest, hips).distance(hang.from);
                hang.point_below_shoulders(far * 0.5)
            }
            (None, _) => hang.point_below_shoulders(0.25 * size),
        };
        let section = |middle: &[(JointPoint, f32)], half: f32, measures: [f32; 4]| {
            let [beyond, front, back, shift] = measures.map(|measure| measure * size);
            let point = |sign: f32| {
                let mut mix: Vec<(JointPoint, f32)> = middle.to_vec();
                mix.push((JointPoint::from_joint_index(left), sign * half));
                mix.push((JointPoint::from_joint_index(right), -sign * half));
                mix
            };
            LoftSection {
                spine: vec![point(-1.0), point(0.0), point(1.0)],
                beyond,
                thickness: [front, back],
                shift,
            }
        };
        let thighs = BodySide::BOTH_SIDES.map(|side| self.joint_of_part(BodyPart::Thigh(side)));
        let seat = match thighs {
            [Some(r), Some(l)] => vec![
                (JointPoint::from_joint_index(r), 0.5),
                (JointPoint::from_joint_index(l), 0.5),
            ],
            _ => vec![(
                hips.map_or_else(|| hang.point_below_shoulders(0.5 * size), JointPoint::from_joint_index),
                1.0,
            )],
        };
        let between = |share: f32| {
            vec![
                (middle, 1.0 - share),
                (JointPoint::from_joint_index(left), share / 2.0),
                (JointPoint::from_joint_index(right), share / 2.0),
            ]
        };
        let sections = vec![
            section(&seat, 0.26, [0.050, 0.080, 0.085, -0.075]),
            section(&seat, 0.32, [0.070, 0.110, 0.115, 0.0]),
            section(&seat, 0.29, [0.070, 0.110, 0.110, 0.09]),
            section(&between(0.0), 0.26, [0.055, 0.105, 0.095, 0.0]),
            section(&between(0.5), 0.33, [0.050, 0.115, 0.105, 0.0]),
            section(&between(0.85), 0.38, [0.030, 0.100, 0.098, 0.0]),
            section(&between(1.0), 0.34, [0.020, 0.068, 0.078, 0.03]),
            section(
                &[
                    (JointPoint::from_joint_index(left), 0.3),
                    (JointPoint::from_joint_index(right), 0.3),
                    (neck, 0.4),
                ],
                0.18,
                [0.045, 0.048, 0.06, 0.025],
            ),
        ];
        self.out.add_body_loft(
            BodyLoft {
                sections,
                columns: 32,
                roundness: 0.8,
            },
            paint,
        );
        for shoulder in [left, right] {
            let rod = BodyRod {
                ends: [JointPoint::from_joint_index(shoulder), neck],
                radii: [0.046 * size, 0.050 * size, 0.040 * size],
                facing: (shoulder, Vec3::Z),
                columns: 20,
            };
            self.out.add_body_rod(rod, paint);
        }
    }

    /// Returns the reference for the trunk's points if it lacks joints: the joint that carries both arms.
    fn trunk_reference(&self, right: usize, left: usize) -> TrunkReference {
        let above: Vec<usize> = self.skeleton.joint_ancestors(right).collect();
        let shared = self
            .skeleton
            .joint_ancestors(left)
            .find(|ancestor| above.contains(ancestor));
        let joint = self.joint_of_part(BodyPart::Chest).or(shared).unwrap_or(0);
        let body_axes = self.anatomy.body_frame(self.rest);
        let up = body_axes.map_or(Vec3::Y, |frame| frame.up.as_vec3());
        TrunkReference {
            joint,
            at: posed_joint_position(self.rest, joint),
            turn: posed_joint_rotation(self.rest, joint).inverse(),
            from: (posed_joint_position(self.rest, right) + posed_joint_position(self.rest, left)) * 0.5,
            up,
        }
    }

    /// Returns the joint of the spine nearest the middle between hips and neck at rest.
    fn spine_middle(&self, hips: usize, neck: usize) -> usize {
        let target = (posed_joint_position(self.rest, hips) + posed_joint_position(self.rest, neck)) * 0.5;
        let distance = |joint: usize| posed_joint_position(self.rest, joint).distance_squared(target);
        let chain = self.skeleton.joint_ancestors(neck).skip(1);
        chain
            .take_while(|&joint| joint != hips)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(hips)
    }

    /// Adds every bone of a skeleton that is not a known body.
    pub(super) fn add_bone_rods(&mut self) {
        let paint = ShapePaint::from_plain_colour(self.palette.face, group::REMAINING_BODY_GROUP);
        let places: Vec<Vec3> = (0..self.skeleton.len())
            .map(|j| posed_joint_position(self.rest, j))
            .collect();
        let box_ = places
            .iter()
            .fold((places[0], places[0]), |(low, high), &at| (low.min(at), high.max(at)));
        let thick = (box_.1 - box_.0).length().max(0.1) * 0.03;
        let rod = |ends: [JointPoint; 2], length: f32| {
            let radius = (length * 0.14).clamp(thick * 0.15, thick);
            BodyRod {
                ends,
                radii: [radius, radius * 0.85, radius * 0.7],
                facing: (ends[0].joint, Vec3::Z),
                columns: 12,
            }
        };
        for (index, joint) in self.skeleton.skeleton_joints().iter().enumerate() {
            if let Some(parent) = joint.parent {
                let ends = [
                    JointPoint::from_joint_index(parent),
                    JointPoint::from_joint_index(index),
                ];
                self.out.add_body_rod(rod(ends, joint.offset.length() as f32), paint);
            }
            if let Some(tip) = joint.tip {
                let local = tip.as_vec3();
                let end = JointPoint { joint: index, local };
                self.out
                    .add_body_rod(rod([JointPoint::from_joint_index(index), end], local.length()), paint);
            }
            if self.skeleton.len() == 1 && joint.tip.is_none() {
                let ends = [JointPoint::from_joint_index(0), JointPoint::from_joint_index(0)];
                self.out.add_body_rod(rod(ends, 0.1), paint);
            }
        }
    }
}
