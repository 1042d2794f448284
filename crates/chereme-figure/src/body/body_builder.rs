//! Assembles a body from the parts for which a skeleton has joints.

use chereme_motion::{BodyAnatomy, BodySide, FacePosture, ModelPose, Skeleton, anatomy::BodyPart};
use glam::{Mat3, Quat, Vec3};

use super::body_contact::HandContactShade;
use super::body_hand::{HandAxes, HandFit, HandSeat};
use super::body_head::HeadPlacement;
use super::body_shape::ShapePaint;
use super::body_shape::{BodyAssembly, posed_joint_position, posed_joint_rotation};
use super::clothed::{
    COLLAR_BACK, CanonicalClothes, ClothVertex, FOREARM_LENGTH_MM, NECK_RADIUS_MM, SHOULDER_HALF_WIDTH_MM,
    TRUNK_LENGTH_MM, UPPER_ARM_LENGTH_MM,
};
use super::group;
use super::skin::{BoundSkinVertex, SkinFollower, SkinRig};
use super::trunk::{ArmRig, TrunkRig, arm_direction, hand_seat};
use super::{BodySkin, ExpressiveHead, SignerBody};
use crate::mesh::{MeshVertex, TriangleMesh};
use crate::palette::{FigurePalette, HandColours};

/// The arm's length from shoulder to wrist for which the measures below are defined, in metres.
const REFERENCE_ARM_METRES: f32 = 0.535;
/// The stature for which those measures are defined, in metres.
const REFERENCE_STATURE_METRES: f32 = 1.756;

/// A body under construction.
pub(super) struct BodyBuilder<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) anatomy: &'a BodyAnatomy,
    pub(super) palette: &'a FigurePalette,
    pub(super) rest: &'a ModelPose,
    /// The size of the body relative to an adult's.
    pub(super) size: f32,
    face: Option<ExpressiveHead>,
    pub(super) out: BodyAssembly,
    rig: SkinRig,
    bound: Vec<BoundSkinVertex>,
    surface: TriangleMesh,
}

/// Indices of an arm's followers.
#[derive(Clone, Copy)]
struct ArmFollowers {
    upper: [usize; 3],
    fore: [usize; 4],
    armpit: usize,
    elbow: usize,
    hand: usize,
}

impl<'a> BodyBuilder<'a> {
    pub(super) fn new(
        skeleton: &'a Skeleton,
        anatomy: &'a BodyAnatomy,
        palette: &'a FigurePalette,
        rest: &'a ModelPose,
    ) -> Self {
        Self {
            skeleton,
            anatomy,
            palette,
            rest,
            size: relative_body_size(anatomy),
            face: None,
            out: BodyAssembly::default(),
            rig: SkinRig::default(),
            bound: Vec::new(),
            surface: TriangleMesh::default(),
        }
    }

    pub(super) fn joint_of_part(&self, part: BodyPart) -> Option<usize> {
        self.anatomy.part_joint(part)
    }

    /// Returns the body of everything added.
    pub(super) fn finish_body(mut self) -> SignerBody {
        let start = self.out.mesh.vertices.len();
        let first = self.out.mesh.triangles.len();
        // The skin comes last, so that its vertices are one range that postures rewrite.
        self.out.mesh.append_mesh(&self.surface);
        let skin = (!self.bound.is_empty()).then_some(BodySkin {
            rig: self.rig,
            bound: self.bound,
            vertices: start..self.out.mesh.vertices.len(),
            triangles: first..self.out.mesh.triangles.len(),
        });
        let mut body = SignerBody {
            template: self.out.mesh,
            elements: self.out.elements,
            skin,
            face: self.face,
            contact: HandContactShade::default(),
        };
        let mut mesh = std::mem::take(&mut body.template);
        body.pose_body_elements(self.rest, &mut mesh);
        body.template = mesh;
        // The posture at rest is needed first: the shade is found by the places of vertices.
        body.contact = HandContactShade::from_hand_points(self.skeleton, self.anatomy, &body.template, self.size);
        body
    }

    /// Adds the whole signer.
    pub(super) fn add_whole_signer(&mut self) {
        // One skin needs both arms; with one arm missing, plain forms stand for everything.
        let dressed = BodySide::BOTH_SIDES
            .iter()
            .all(|&side| self.anatomy.arm_chain(side).is_some());
        if dressed {
            self.dressed();
        } else {
            self.plain_torso();
            for side in BodySide::BOTH_SIDES {
                self.plain_arm(side);
                self.add_lone_hand(side);
            }
        }
        self.add_head_and_neck(dressed);
        for side in BodySide::BOTH_SIDES {
            self.add_leg_rods(side);
        }
    }

    /// Adds the hand of `side` without an arm; adds nothing if there is no wrist.
    pub(super) fn add_lone_hand(&mut self, side: BodySide) {
        let place_of = usize::from(side == BodySide::Left);
        let seat = HandSeat {
            wrist: Vec3::ZERO,
            axes: hand_seat(side),
        };
        // With an arm the hand follows wrist and forearm; a wrist alone is handled below.
        if let Some(arm) = ArmRig::from_arm_joints(self.anatomy, side, self.rest, Vec3::ZERO) {
            let seat = HandSeat {
                wrist: arm.places[2],
                ..seat
            };
            let axes = arm.hand_axes();
            self.rig.arms[place_of] = Some(arm);
            let hand = self.rig.add_follower(SkinFollower::Hand(place_of));
            let cuff = self.rig.add_follower(SkinFollower::Fore(place_of, 1.0));
            self.add_fitted_hand(side, axes, seat, [hand, cuff]);
            return;
        }
        let Some(wrist) = self.joint_of_part(BodyPart::Hand(side)) else {
            return;
        };
        let body_axes = self.anatomy.body_frame(self.rest);
        let neutral = body_axes.map_or(Vec3::Z, |frame| frame.forward.as_vec3());
        let Some(axes) = HandAxes::hand_axes_at_rest(self.anatomy, side, self.rest, neutral) else {
            return;
        };
        let turned = posed_joint_rotation(self.rest, wrist);
        let hand_frame = super::body_hand::hand_axes_frame(side, turned * axes.along, turned * axes.palm);
        let turn = Quat::from_mat3(&(seat.axes * hand_frame.transpose())).normalize();
        let bound_to = |joint: usize, at: Vec3| SkinFollower::Joint {
            joint,
            turn: posed_joint_rotation(self.rest, joint).inverse() * turn.inverse(),
            at,
        };
        let hand = bound_to(wrist, Vec3::ZERO);
        let cuff = match self.joint_of_part(BodyPart::Forearm(side)) {
            Some(fore) => {
                let bone = posed_joint_position(self.rest, fore) - posed_joint_position(self.rest, wrist);
                bound_to(fore, turn * bone)
            }
            None => hand.clone(),
        };
        let (hand, cuff) = (self.rig.add_follower(hand), self.rig.add_follower(cuff));
        self.add_fitted_hand(side, axes, seat, [hand, cuff]);
    }

    fn add_fitted_hand(&mut self, side: BodySide, axes: HandAxes, seat: HandSeat, [hand, cuff]: [usize; 2]) {
        let colours = hand_colours_of(self.palette, side);
        HandFit {
            skeleton: self.skeleton,
            anatomy: self.anatomy,
            side,
            axes,
            seat,
            hand,
            cuff,
        }
        .add_hand_surface(&mut self.rig, &mut self.bound, &mut self.surface, colours);
    }

    /// Adds trunk, arms and hands as one skin.
    fn dressed(&mut self) {
        let measures = self.anatomy.anatomy_measures();
        // Without measures, the trunk and shoulders of an adult.
        let trunk = measures.map_or(0.5, |measures| measures.trunk as f32);
        let wide = measures.map_or(0.344, |measures| measures.shoulder_width as f32);
        let trunk_rig = TrunkRig::from_trunk_joints(self.skeleton, self.anatomy, self.rest, self.size, trunk);
        let arms = BodySide::BOTH_SIDES.map(|side| {
            let shoulder = Vec3::X * (wide * 0.5 * side.side_sign() as f32);
            ArmRig::from_arm_joints(self.anatomy, side, self.rest, shoulder)
        });
        let [Some(_), Some(_)] = &arms else { return };
        self.rig.trunk = trunk_rig;
        self.rig.arms = arms;
        let pelvis = self.rig.add_follower(SkinFollower::Pelvis);
        let chest = self.rig.add_follower(SkinFollower::Chest);
        let shoulders = [0, 1].map(|side| self.rig.add_follower(SkinFollower::Shoulder(side)));
        let limbs = [0, 1].map(|side| self.arm_followers(side, chest));
        let collar = self.chin().map_or(self.size, |chin| {
            // The collar ends below the chin.
            ((chin - 0.012 * self.size) / 0.088).clamp(self.size * 0.25, self.size)
        });
        let thighs = BodySide::BOTH_SIDES.map(|side| self.joint_of_part(BodyPart::Thigh(side)));
        let hips = match thighs {
            [Some(right), Some(left)] => {
                let apart = posed_joint_position(self.rest, right).distance(posed_joint_position(self.rest, left));
                // Skeletons whose bones all lie in one line at rest show the breadth in the bones from the pelvis.
                let bones = [right, left].map(|joint| self.skeleton.joint_at(joint).offset.length() as f32);
                let apart = match apart < 0.03 * self.size {
                    true => bones.iter().sum(),
                    false => apart,
                };
                // 0.160 is the half breadth of the canonical hips, 0.080 that of flesh beside a thigh.
                (apart * 0.5 + 0.080 * self.size) / 0.160
            }
            _ => self.size,
        };
        let neck = self.neck_line();
        let head = neck.as_ref().map_or(chest, |neck| {
            let (joint, turn, at) = neck.head;
            self.rig.add_follower(SkinFollower::Joint { joint, turn, at })
        });
        let legs = [0, 1].map(|side| self.thigh_follower(thighs[side], pelvis));
        let shape = ClothesShape {
            trunk,
            wide,
            collar,
            hips: hips.clamp(self.size, self.size * 1.4),
            neck: neck.clone(),
        };
        self.clothes(&shape, [pelvis, chest, head], legs, shoulders, &limbs);
        if let Some(neck) = neck {
            self.neck(&neck, [chest, head]);
        }
        for side in BodySide::BOTH_SIDES {
            let side_index = usize::from(side == BodySide::Left);
            // The last forearm follower has the whole turn of the hand, as the cuff has.
            let Some(arm) = &self.rig.arms[side_index] else {
                continue;
            };
            let (axes, wrist) = (arm.hand_axes(), arm.places[2]);
            let seat = HandSeat {
                wrist,
                axes: hand_seat(side),
            };
            self.add_fitted_hand(side, axes, seat, [limbs[side_index].hand, limbs[side_index].fore[3]]);
        }
    }

    fn arm_followers(&mut self, side: usize, chest: usize) -> ArmFollowers {
        let places = self.rig.arms[side].as_ref().map_or([Vec3::ZERO; 3], |arm| arm.places);
        let along = (places[1] - places[0]).normalize_or(Vec3::X);
        let rig = &mut self.rig;
        let upper = [0.0, 0.5, 1.0].map(|share| rig.add_follower(SkinFollower::Upper(side, share)));
        let fore = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(|share| rig.add_follower(SkinFollower::Fore(side, share)));
        // Three followers share the turn of an upper arm evenly, and four that of a forearm.
        let half = |parent, child, at, swell| SkinFollower::Half {
            parent,
            child,
            at,
            along,
            swell,
        };
        ArmFollowers {
            upper,
            fore,
            // The armpit does not swell: it would bulge into the trunk.
            armpit: rig.add_follower(half(chest, upper[0], places[0], 0.0)),
            elbow: rig.add_follower(half(upper[2], fore[0], places[1], 0.08)),
            hand: rig.add_follower(SkinFollower::Hand(side)),
        }
    }

    /// Returns the follower of a thigh that moves the seat of the clothes; the pelvis if the skeleton has no thigh.
    fn thigh_follower(&mut self, thigh: Option<usize>, pelvis: usize) -> usize {
        // A skeleton that does not stand at rest says nothing of where thighs are beside the pelvis.
        let standing = self.rig.trunk.as_ref().filter(|trunk| trunk.is_standing_at_rest());
        let (Some(joint), Some(trunk)) = (thigh, standing) else {
            return pelvis;
        };
        let seat = trunk.pose_trunk(self.rest).pelvis;
        let back = seat.turn.inverse();
        self.rig.add_follower(SkinFollower::Joint {
            joint,
            turn: (posed_joint_rotation(self.rest, joint).inverse() * seat.turn).normalize(),
            at: back * (posed_joint_position(self.rest, joint) - seat.to) + seat.from,
        })
    }

    /// Adds the canonical clothes, fitted to the body.
    fn clothes(
        &mut self,
        shape: &ClothesShape,
        [pelvis, chest, head]: [usize; 3],
        legs: [usize; 2],
        shoulders: [usize; 2],
        limbs: &[ArmFollowers; 2],
    ) {
        let clothed = CanonicalClothes::shared_clothes();
        let base = self.surface.vertices.len() as u32;
        let size = self.size;
        for cloth in &clothed.cloths {
            let side_index = usize::from(cloth.side == BodySide::Left);
            let (limb, shares) = (limbs[side_index], cloth.shares);
            let places = self.rig.arms[side_index]
                .as_ref()
                .map_or([Vec3::ZERO; 3], |arm| arm.places);
            let cloth_place = shape.place_cloth_vertex(cloth, size, places);
            let nod = shape.nod_share(cloth, cloth_place);
            let [right, left] = shares.thighs.map(|share| share * shares.pelvis);
            let mut all = vec![
                (pelvis, shares.pelvis - right - left),
                (legs[0], right),
                (legs[1], left),
                (chest, shares.chest * (1.0 - nod)),
                (head, (shares.chest + shares.shoulder) * nod),
                (shoulders[side_index], shares.shoulder * (1.0 - nod)),
                (limb.armpit, shares.armpit),
                (limb.elbow, shares.elbow),
            ];
            all.extend(neighbour_shares(&limb.upper, shares.upper_turn, shares.upper));
            all.extend(neighbour_shares(&limb.fore, shares.fore_turn, shares.fore));
            self.bound.push(BoundSkinVertex::new(cloth_place, &all));
            // The colour changes from trunk to sleeve over the shoulder, 60 to 140 mm along the arm.
            let share = ((cloth.along - 60.0) / 80.0).clamp(0.0, 1.0);
            let colour = self.palette.torso.mix_colour(self.palette.sleeves, share);
            // Hems show the inside of the cloth, which is darker.
            let light = if cloth.hem { 0.88 } else { cloth.open };
            self.surface.vertices.push(MeshVertex {
                position: cloth_place,
                normal: Vec3::Y,
                colour: colour.scale_colour(light),
                group: if cloth.along > 120.0 {
                    group::arm_group(cloth.side)
                } else {
                    group::TORSO_GROUP
                },
            });
        }
        let moved = clothed.triangles.iter().map(|t| t.map(|i| i + base));
        self.surface.triangles.extend(moved);
    }

    /// Adds head and neck.
    fn add_head_and_neck(&mut self, dressed: bool) {
        let Some(joint) = self.joint_of_part(BodyPart::Head) else {
            return;
        };
        // The dressed body has a neck of its own skin.
        if let Some(neck) = self.joint_of_part(BodyPart::Neck).filter(|_| !dressed) {
            let paint = ShapePaint::from_plain_colour(self.palette.face.scale_colour(0.9), group::HEAD_GROUP);
            self.add_limb_rod(neck, joint, [0.050, 0.047, 0.046], paint);
        }
        let Some(head) = self.head_form(joint) else {
            return;
        };
        let start = self.out.mesh.vertices.len();
        self.out
            .add_rigid_mesh(joint, &head.head_mesh(self.palette, &FacePosture::default()));
        self.face = Some(ExpressiveHead {
            joint,
            head,
            palette: *self.palette,
            vertices: start..self.out.mesh.vertices.len(),
        });
    }
}

impl BodyBuilder<'_> {
    /// Returns the head in its joint's space, if skeleton and measures have one.
    fn head_form(&self, joint: usize) -> Option<HeadPlacement> {
        let axes = self.anatomy.head_axes(self.rest);
        let (axes, measures) = (axes?, self.anatomy.anatomy_measures()?);
        let axes = Mat3::from_cols_array_2d(&axes.map(|axis| axis.as_vec3().to_array()));
        let height = measures.head as f32;
        let top = self
            .anatomy
            .landmark_place_position(self.skeleton, self.rest, "head-top");
        let up = axes.y_axis;
        let top = top.map_or_else(
            || up * (measures.head_top as f32),
            |top| top.as_vec3() - posed_joint_position(self.rest, joint),
        );
        let turn = posed_joint_rotation(self.rest, joint).inverse();
        Some(HeadPlacement {
            centre: turn * (top - up * height * 0.5),
            height,
            axes: Mat3::from_quat(turn) * axes,
        })
    }

    /// Returns the position of the head's joint in bind space, and the rotation from bind space to the joint's space.
    fn head_seat(&self, joint: usize, head: &HeadPlacement) -> (Vec3, Quat) {
        let turn = Quat::from_mat3(&head.axes).normalize();
        let standing = self.rig.trunk.as_ref().filter(|trunk| trunk.is_standing_at_rest());
        let head_place = match standing.map(|trunk| trunk.pose_trunk(self.rest).chest) {
            Some(chest) => chest.turn.inverse() * (posed_joint_position(self.rest, joint) - chest.to) + chest.from,
            // A skeleton that does not stand at rest shows no place: the usual one of a head's middle.
            None => Vec3::Y * (0.117 * REFERENCE_STATURE_METRES * self.size) - turn.inverse() * head.centre,
        };
        (head_place, turn)
    }

    /// Returns the height of the chin in bind space, if there is a head.
    fn chin(&self) -> Option<f32> {
        let joint = self.joint_of_part(BodyPart::Head)?;
        let head = self.head_form(joint)?;
        let (at, turn) = self.head_seat(joint, &head);
        Some((at + turn.inverse() * head.centre).y - head.height * 0.5)
    }

    /// Returns the neck, if there is a head.
    fn neck_line(&self) -> Option<NeckLine> {
        let joint = self.joint_of_part(BodyPart::Head)?;
        let head = self.head_form(joint)?;
        let (at, turn) = self.head_seat(joint, &head);
        let middle = at + turn.inverse() * head.centre;
        let size = self.size * 0.001;
        Some(NeckLine {
            head: (joint, turn, at),
            low: (Vec3::new(0.0, 12.0, -16.0) * size, 48.0 * size),
            high: (middle + Vec3::new(0.0, -0.22, -0.04) * head.height, 0.215 * head.height),
        })
    }

    /// Adds the skin between chest and head.
    fn neck(&mut self, neck: &NeckLine, [chest, head]: [usize; 2]) {
        const NECK_RING_COUNT: usize = 6;
        let grid = crate::mesh::RingGrid::new(20, NECK_RING_COUNT);
        let base = self.surface.vertices.len() as u32;
        let skin = self.palette.face;
        let mut add = |at: Vec3, share: f32| {
            self.bound
                .push(BoundSkinVertex::new(at, &[(chest, 1.0 - share), (head, share)]));
            // The neck is in the shade of the chin, more the higher it is.
            let shade = 0.97 - 0.20 * ((share - 0.35) / 0.5).clamp(0.0, 1.0);
            self.surface.vertices.push(MeshVertex {
                position: at,
                normal: Vec3::Y,
                colour: skin.scale_colour(shade),
                group: group::HEAD_GROUP,
            });
        };
        add(neck.low.0, 0.0);
        for ring in 0..NECK_RING_COUNT {
            let share = ring as f32 / (NECK_RING_COUNT - 1) as f32;
            let (centre, radius) = neck.neck_ring_at(share);
            for spoke in &grid.circle {
                add(centre + Vec3::new(spoke.x, 0.0, -spoke.y) * radius, share);
            }
        }
        add(neck.high.0, 1.0);
        self.surface.triangles.extend(grid.grid_triangles(base));
    }
}

/// The neck in bind space, from the chest to the head.
#[derive(Debug, Clone)]
struct NeckLine {
    /// The head's joint, the rotation from bind space to its space, and its position.
    head: (usize, Quat, Vec3),
    /// The middle and the radius of its lowest and of its highest ring.
    low: (Vec3, f32),
    high: (Vec3, f32),
}

impl NeckLine {
    /// Returns the middle and the radius of the ring at a share of the way up.
    fn neck_ring_at(&self, share: f32) -> (Vec3, f32) {
        let waist = 1.0 - 0.10 * (std::f32::consts::PI * share).sin();
        let radius = self.low.1 + (self.high.1 - self.low.1) * share;
        (self.low.0.lerp(self.high.0, share), radius * waist)
    }

    /// Returns the share of the way up at a height.
    fn neck_share_at(&self, height: f32) -> f32 {
        let height_range = (self.high.0.y - self.low.0.y).max(1e-3);
        ((height - self.low.0.y) / height_range).clamp(0.0, 1.0)
    }
}

/// The measures of the clothes, in metres.
struct ClothesShape {
    trunk: f32,
    wide: f32,
    /// The factor on heights above the shoulders.
    collar: f32,
    /// The factor on breadths of the hips.
    hips: f32,
    neck: Option<NeckLine>,
}

impl ClothesShape {
    /// Returns how much a vertex of the clothes in bind space moves with the head, as the neck does there.
    fn nod_share(&self, cloth: &ClothVertex, at: Vec3) -> f32 {
        let neck = self.neck.as_ref();
        neck.map_or(0.0, |neck| cloth.shares.neck * neck.neck_share_at(at.y))
    }

    /// Returns the position of a vertex of the clothes in bind space.
    fn place_cloth_vertex(&self, cloth: &ClothVertex, size: f32, places: [Vec3; 3]) -> Vec3 {
        let metre = 0.001;
        // Below the waist breadths follow the hips, above it the shoulders.
        let low = ((-cloth.at.y - 120.0) / 300.0).clamp(0.0, 1.0);
        let raw_width = self.wide / (2.0 * SHOULDER_HALF_WIDTH_MM * metre);
        // Shoulders of odd skeletons do not widen or narrow the chest beyond a human range.
        let wide = raw_width.clamp(size * 0.6, size * 1.5);
        let across = wide + (self.hips - wide) * low;
        // Above the shoulders only the collar is left, which ends below the chin.
        let tall = if cloth.at.y < 0.0 {
            self.trunk / (TRUNK_LENGTH_MM * metre)
        } else {
            self.collar
        };
        let mut trunk = cloth.at * Vec3::new(across, tall, size) * metre;
        if let Some(neck) = self.neck.as_ref().filter(|_| cloth.shares.neck > 0.0) {
            // The collar stands around the neck, wherever that leads.
            let (middle, radius) = neck.neck_ring_at(neck.neck_share_at(trunk.y));
            let [x, z] = [cloth.at.x, cloth.at.z - COLLAR_BACK].map(|coordinate| coordinate * radius / NECK_RADIUS_MM);
            let around = Vec3::new(x, trunk.y, middle.z + z);
            trunk = trunk.lerp(around, cloth.shares.neck);
        }
        let along = arm_direction(cloth.side);
        let from = Vec3::X * (SHOULDER_HALF_WIDTH_MM * cloth.side.side_sign() as f32);
        let lengths = [places[0].distance(places[1]), places[1].distance(places[2])];
        let s = cloth.along;
        let reach = if s < UPPER_ARM_LENGTH_MM {
            s / UPPER_ARM_LENGTH_MM * lengths[0]
        } else {
            lengths[0] + (s - UPPER_ARM_LENGTH_MM) / FOREARM_LENGTH_MM * lengths[1]
        };
        // Around the arm the cloth keeps its thickness; only positions along it are stretched.
        let arm = places[0] + along * reach + (cloth.at - from - along * s) * size * metre;
        trunk.lerp(arm, cloth.arm)
    }
}

/// Returns the shares of two neighbours in a row of followers, for a place `at` from 0 to 1 along the row.
fn neighbour_shares(row: &[usize], at: f32, share: f32) -> [(usize, f32); 2] {
    let last = row.len() - 1;
    let row_position = at.clamp(0.0, 1.0) * last as f32;
    let piece = (row_position as usize).min(last - 1);
    let on = row_position - piece as f32;
    [(row[piece], share * (1.0 - on)), (row[piece + 1], share * on)]
}

/// Returns the size of a body relative to an adult's, from its arms and its stature.
fn relative_body_size(anatomy: &BodyAnatomy) -> f32 {
    let Some(measures) = anatomy.anatomy_measures() else {
        return 1.0;
    };
    let (arm, stature) = (
        measures.arm as f32 / REFERENCE_ARM_METRES,
        measures.stature as f32 / REFERENCE_STATURE_METRES,
    );
    match (arm > 1e-6, stature > 1e-6) {
        // Long arms alone do not make a giant: stature counts half, kept near the arms.
        (true, true) => arm * 0.5 + stature.clamp(arm * 0.7, arm * 1.4) * 0.5,
        (true, false) => arm,
        (false, true) => stature,
        (false, false) => 1.0,
    }
}

fn hand_colours_of(palette: &FigurePalette, side: BodySide) -> HandColours {
    match side {
        BodySide::Right => palette.right,
        BodySide::Left => palette.left,
    }
}
