//! Assembles a body from the parts for which a skeleton has joints.

use chereme_motion::{Anatomy, Face, ModelPose, Side, Skeleton, anatomy::Part};
use glam::{Mat3, Quat, Vec3};

use super::clothed::{COLLAR_BACK, Cloth, Clothed, FORE, NECK, SHOULDER, TRUNK, UPPER};
use super::contact::Contact;
use super::group;
use super::hand::{HandAxes, HandFit, Seat};
use super::head::Head;
use super::shape::Paint;
use super::shape::{Assembly, place, rotation};
use super::skin::{Bound, Follower, Rig};
use super::trunk::{ArmRig, TrunkRig, arm_direction, hand_seat};
use super::{Body, Expressive, Skin};
use crate::mesh::{Mesh, Vertex};
use crate::palette::{HandColours, Palette};

/// The arm's length from shoulder to wrist for which the measures below are defined, in metres.
const ARM: f32 = 0.535;
/// The stature for which those measures are defined, in metres.
const STATURE: f32 = 1.756;

/// A body under construction.
pub(super) struct Builder<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) anatomy: &'a Anatomy,
    pub(super) palette: &'a Palette,
    pub(super) rest: &'a ModelPose,
    /// The size of the body relative to an adult's.
    pub(super) size: f32,
    face: Option<Expressive>,
    pub(super) out: Assembly,
    rig: Rig,
    bound: Vec<Bound>,
    surface: Mesh,
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

impl<'a> Builder<'a> {
    pub(super) fn new(
        skeleton: &'a Skeleton,
        anatomy: &'a Anatomy,
        palette: &'a Palette,
        rest: &'a ModelPose,
    ) -> Self {
        Self {
            skeleton,
            anatomy,
            palette,
            rest,
            size: size(anatomy),
            face: None,
            out: Assembly::default(),
            rig: Rig::default(),
            bound: Vec::new(),
            surface: Mesh::default(),
        }
    }

    pub(super) fn joint(&self, part: Part) -> Option<usize> {
        self.anatomy.joint(part)
    }

    /// Returns the body of everything added.
    pub(super) fn finish(mut self) -> Body {
        let start = self.out.mesh.vertices.len();
        let first = self.out.mesh.triangles.len();
        self.out.mesh.append(&self.surface);
        let skin = (!self.bound.is_empty()).then_some(Skin {
            rig: self.rig,
            bound: self.bound,
            vertices: start..self.out.mesh.vertices.len(),
            triangles: first..self.out.mesh.triangles.len(),
        });
        let mut body = Body {
            template: self.out.mesh,
            elements: self.out.elements,
            skin,
            face: self.face,
            contact: Contact::default(),
        };
        let mut mesh = std::mem::take(&mut body.template);
        body.pose(self.rest, &mut mesh);
        body.template = mesh;
        body.contact = Contact::of(self.skeleton, self.anatomy, &body.template, self.size);
        body
    }

    /// Adds the whole signer.
    pub(super) fn signer(&mut self) {
        let dressed = Side::BOTH
            .iter()
            .all(|&side| self.anatomy.arm(side).is_some());
        if dressed {
            self.dressed();
        } else {
            self.plain_torso();
            for side in Side::BOTH {
                self.plain_arm(side);
                self.hand(side);
            }
        }
        self.head(dressed);
        for side in Side::BOTH {
            self.leg(side);
        }
    }

    /// Adds the hand of `side` without an arm; adds nothing if there is no wrist.
    pub(super) fn hand(&mut self, side: Side) {
        let place_of = usize::from(side == Side::Left);
        let seat = Seat {
            wrist: Vec3::ZERO,
            axes: hand_seat(side),
        };
        if let Some(arm) = ArmRig::of(self.anatomy, side, self.rest, Vec3::ZERO) {
            let seat = Seat {
                wrist: arm.places[2],
                ..seat
            };
            let axes = arm.hand_axes();
            self.rig.arms[place_of] = Some(arm);
            let hand = self.rig.add(Follower::Hand(place_of));
            let cuff = self.rig.add(Follower::Fore(place_of, 1.0));
            self.fit(side, (axes, seat), [hand, cuff]);
            return;
        }
        let Some(wrist) = self.joint(Part::Hand(side)) else {
            return;
        };
        let neutral = self.anatomy.body_frame(self.rest);
        let neutral = neutral.map_or(Vec3::Z, |frame| frame.forward.as_vec3());
        let Some(axes) = HandAxes::of(self.anatomy, side, self.rest, neutral) else {
            return;
        };
        let turned = rotation(self.rest, wrist);
        let own = super::hand::frame(side, turned * axes.along, turned * axes.palm);
        let turn = Quat::from_mat3(&(seat.axes * own.transpose())).normalize();
        let bound_to = |joint: usize, at: Vec3| Follower::Joint {
            joint,
            turn: rotation(self.rest, joint).inverse() * turn.inverse(),
            at,
        };
        let hand = bound_to(wrist, Vec3::ZERO);
        let cuff = match self.joint(Part::Forearm(side)) {
            Some(fore) => {
                let bone = place(self.rest, fore) - place(self.rest, wrist);
                bound_to(fore, turn * bone)
            }
            None => hand.clone(),
        };
        let (hand, cuff) = (self.rig.add(hand), self.rig.add(cuff));
        self.fit(side, (axes, seat), [hand, cuff]);
    }

    fn fit(&mut self, side: Side, (axes, seat): (HandAxes, Seat), [hand, cuff]: [usize; 2]) {
        let colours = colours(self.palette, side);
        HandFit {
            skeleton: self.skeleton,
            anatomy: self.anatomy,
            side,
            axes,
            seat,
            hand,
            cuff,
        }
        .add(&mut self.rig, &mut self.bound, &mut self.surface, colours);
    }

    /// Adds trunk, arms and hands as one skin.
    fn dressed(&mut self) {
        let measures = self.anatomy.measures();
        let trunk = measures.map_or(0.5, |it| it.trunk as f32);
        let wide = measures.map_or(0.344, |it| it.shoulder_width as f32);
        let known = (self.size, trunk);
        let found = TrunkRig::of(self.skeleton, self.anatomy, self.rest, known);
        let arms = Side::BOTH.map(|side| {
            let shoulder = Vec3::X * (wide * 0.5 * side.sign() as f32);
            ArmRig::of(self.anatomy, side, self.rest, shoulder)
        });
        let [Some(_), Some(_)] = &arms else { return };
        self.rig.trunk = found;
        self.rig.arms = arms;
        let pelvis = self.rig.add(Follower::Pelvis);
        let chest = self.rig.add(Follower::Chest);
        let shoulders = [0, 1].map(|side| self.rig.add(Follower::Shoulder(side)));
        let limbs = [0, 1].map(|side| self.arm_followers(side, chest));
        let collar = self.chin().map_or(self.size, |chin| {
            // The collar ends below the chin.
            ((chin - 0.012 * self.size) / 0.088).clamp(self.size * 0.25, self.size)
        });
        let thighs = Side::BOTH.map(|side| self.joint(Part::Thigh(side)));
        let hips = match thighs {
            [Some(right), Some(left)] => {
                let apart = place(self.rest, right).distance(place(self.rest, left));
                // Skeletons whose bones all lie in one line at rest show the breadth in the bones from the pelvis.
                let bones = [right, left].map(|it| self.skeleton.joint(it).offset.length() as f32);
                let apart = match apart < 0.03 * self.size {
                    true => bones.iter().sum(),
                    false => apart,
                };
                (apart * 0.5 + 0.080 * self.size) / 0.160
            }
            _ => self.size,
        };
        let neck = self.neck_line();
        let head = neck.as_ref().map_or(chest, |neck| {
            let (joint, turn, at) = neck.head;
            self.rig.add(Follower::Joint { joint, turn, at })
        });
        let legs = [0, 1].map(|side| self.thigh_follower(thighs[side], pelvis));
        let shape = Shape {
            trunk,
            wide,
            collar,
            hips: hips.clamp(self.size, self.size * 1.4),
            neck: neck.clone(),
        };
        self.clothes(&shape, [pelvis, chest, head], (legs, shoulders), &limbs);
        if let Some(neck) = neck {
            self.neck(&neck, [chest, head]);
        }
        for side in Side::BOTH {
            let at = usize::from(side == Side::Left);
            let Some(arm) = &self.rig.arms[at] else {
                continue;
            };
            let (axes, wrist) = (arm.hand_axes(), arm.places[2]);
            let seat = Seat {
                wrist,
                axes: hand_seat(side),
            };
            self.fit(side, (axes, seat), [limbs[at].hand, limbs[at].fore[3]]);
        }
    }

    fn arm_followers(&mut self, side: usize, chest: usize) -> ArmFollowers {
        let places = self.rig.arms[side]
            .as_ref()
            .map_or([Vec3::ZERO; 3], |arm| arm.places);
        let along = (places[1] - places[0]).normalize_or(Vec3::X);
        let rig = &mut self.rig;
        let upper = [0.0, 0.5, 1.0].map(|share| rig.add(Follower::Upper(side, share)));
        let fore =
            [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(|share| rig.add(Follower::Fore(side, share)));
        let half = |parent, child, at, swell| Follower::Half {
            parent,
            child,
            at,
            along,
            swell,
        };
        ArmFollowers {
            upper,
            fore,
            armpit: rig.add(half(chest, upper[0], places[0], 0.0)),
            elbow: rig.add(half(upper[2], fore[0], places[1], 0.08)),
            hand: rig.add(Follower::Hand(side)),
        }
    }

    /// Returns the follower of a thigh that moves the seat of the clothes; the pelvis if the skeleton has no thigh.
    fn thigh_follower(&mut self, thigh: Option<usize>, pelvis: usize) -> usize {
        let standing = self.rig.trunk.as_ref().filter(|trunk| trunk.stands());
        let (Some(joint), Some(trunk)) = (thigh, standing) else {
            return pelvis;
        };
        let seat = trunk.posed(self.rest).pelvis;
        let back = seat.turn.inverse();
        self.rig.add(Follower::Joint {
            joint,
            turn: (rotation(self.rest, joint).inverse() * seat.turn).normalize(),
            at: back * (place(self.rest, joint) - seat.to) + seat.from,
        })
    }

    /// Adds the canonical clothes, fitted to the body.
    fn clothes(
        &mut self,
        shape: &Shape,
        [pelvis, chest, head]: [usize; 3],
        (legs, shoulders): ([usize; 2], [usize; 2]),
        limbs: &[ArmFollowers; 2],
    ) {
        let clothed = Clothed::get();
        let base = self.surface.vertices.len() as u32;
        let size = self.size;
        for cloth in &clothed.cloths {
            let at = usize::from(cloth.side == Side::Left);
            let (limb, shares) = (limbs[at], cloth.shares);
            let places = self.rig.arms[at]
                .as_ref()
                .map_or([Vec3::ZERO; 3], |arm| arm.places);
            let own = shape.place(cloth, size, places);
            let nod = shape.nod(cloth, own);
            let [right, left] = shares.thighs.map(|share| share * shares.pelvis);
            let mut all = vec![
                (pelvis, shares.pelvis - right - left),
                (legs[0], right),
                (legs[1], left),
                (chest, shares.chest * (1.0 - nod)),
                (head, (shares.chest + shares.shoulder) * nod),
                (shoulders[at], shares.shoulder * (1.0 - nod)),
                (limb.armpit, shares.armpit),
                (limb.elbow, shares.elbow),
            ];
            all.extend(between(&limb.upper, shares.upper_turn, shares.upper));
            all.extend(between(&limb.fore, shares.fore_turn, shares.fore));
            self.bound.push(Bound::new(own, &all));
            let share = ((cloth.along - 60.0) / 80.0).clamp(0.0, 1.0);
            let colour = self.palette.torso.mixed(self.palette.sleeves, share);
            let light = if cloth.hem { 0.88 } else { cloth.open };
            self.surface.vertices.push(Vertex {
                position: own,
                normal: Vec3::Y,
                colour: colour.scaled(light),
                group: if cloth.along > 120.0 {
                    group::arm(cloth.side)
                } else {
                    group::TORSO
                },
            });
        }
        let moved = clothed.triangles.iter().map(|t| t.map(|i| i + base));
        self.surface.triangles.extend(moved);
    }

    /// Adds head and neck.
    fn head(&mut self, dressed: bool) {
        let Some(joint) = self.joint(Part::Head) else {
            return;
        };
        if let Some(neck) = self.joint(Part::Neck).filter(|_| !dressed) {
            let paint = Paint::plain(self.palette.face.scaled(0.9), group::HEAD);
            self.limb(neck, joint, [0.050, 0.047, 0.046], paint);
        }
        let Some(head) = self.head_form(joint) else {
            return;
        };
        let start = self.out.mesh.vertices.len();
        self.out
            .rigid(joint, &head.mesh(self.palette, &Face::default()));
        self.face = Some(Expressive {
            joint,
            head,
            palette: *self.palette,
            vertices: start..self.out.mesh.vertices.len(),
        });
    }
}

impl Builder<'_> {
    /// Returns the head in its joint's space, if skeleton and measures have one.
    fn head_form(&self, joint: usize) -> Option<Head> {
        let axes = self.anatomy.head_axes(self.rest);
        let (axes, measures) = (axes?, self.anatomy.measures()?);
        let axes = Mat3::from_cols_array_2d(&axes.map(|axis| axis.as_vec3().to_array()));
        let height = measures.head as f32;
        let top = self.anatomy.landmark(self.skeleton, self.rest, "head-top");
        let up = axes.y_axis;
        let top = top.map_or_else(
            || up * (measures.head_top as f32),
            |top| top.as_vec3() - place(self.rest, joint),
        );
        let turn = rotation(self.rest, joint).inverse();
        Some(Head {
            centre: turn * (top - up * height * 0.5),
            height,
            axes: Mat3::from_quat(turn) * axes,
        })
    }

    /// Returns the position of the head's joint in bind space, and the rotation from bind space to the joint's space.
    fn head_seat(&self, joint: usize, head: &Head) -> (Vec3, Quat) {
        let turn = Quat::from_mat3(&head.axes).normalize();
        let standing = self.rig.trunk.as_ref().filter(|trunk| trunk.stands());
        let at = match standing.map(|trunk| trunk.posed(self.rest).chest) {
            Some(chest) => chest.turn.inverse() * (place(self.rest, joint) - chest.to) + chest.from,
            None => Vec3::Y * (0.117 * STATURE * self.size) - turn.inverse() * head.centre,
        };
        (at, turn)
    }

    /// Returns the height of the chin in bind space, if there is a head.
    fn chin(&self) -> Option<f32> {
        let joint = self.joint(Part::Head)?;
        let head = self.head_form(joint)?;
        let (at, turn) = self.head_seat(joint, &head);
        Some((at + turn.inverse() * head.centre).y - head.height * 0.5)
    }

    /// Returns the neck, if there is a head.
    fn neck_line(&self) -> Option<NeckLine> {
        let joint = self.joint(Part::Head)?;
        let head = self.head_form(joint)?;
        let (at, turn) = self.head_seat(joint, &head);
        let middle = at + turn.inverse() * head.centre;
        let size = self.size * 0.001;
        Some(NeckLine {
            head: (joint, turn, at),
            low: (Vec3::new(0.0, 12.0, -16.0) * size, 48.0 * size),
            high: (
                middle + Vec3::new(0.0, -0.22, -0.04) * head.height,
                0.215 * head.height,
            ),
        })
    }

    /// Adds the skin between chest and head.
    fn neck(&mut self, neck: &NeckLine, [chest, head]: [usize; 2]) {
        const RINGS: usize = 6;
        let grid = crate::mesh::Grid::new(20, RINGS);
        let base = self.surface.vertices.len() as u32;
        let skin = self.palette.face;
        let mut add = |at: Vec3, share: f32| {
            self.bound
                .push(Bound::new(at, &[(chest, 1.0 - share), (head, share)]));
            let shade = 0.97 - 0.20 * ((share - 0.35) / 0.5).clamp(0.0, 1.0);
            self.surface.vertices.push(Vertex {
                position: at,
                normal: Vec3::Y,
                colour: skin.scaled(shade),
                group: group::HEAD,
            });
        };
        add(neck.low.0, 0.0);
        for ring in 0..RINGS {
            let share = ring as f32 / (RINGS - 1) as f32;
            let (centre, radius) = neck.at(share);
            for spoke in &grid.circle {
                add(centre + Vec3::new(spoke.x, 0.0, -spoke.y) * radius, share);
            }
        }
        add(neck.high.0, 1.0);
        self.surface.triangles.extend(grid.triangles(base));
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
    fn at(&self, share: f32) -> (Vec3, f32) {
        let waist = 1.0 - 0.10 * (std::f32::consts::PI * share).sin();
        let radius = self.low.1 + (self.high.1 - self.low.1) * share;
        (self.low.0.lerp(self.high.0, share), radius * waist)
    }

    /// Returns the share of the way up at a height.
    fn share(&self, height: f32) -> f32 {
        let whole = (self.high.0.y - self.low.0.y).max(1e-3);
        ((height - self.low.0.y) / whole).clamp(0.0, 1.0)
    }
}

/// The measures of the clothes, in metres.
struct Shape {
    trunk: f32,
    wide: f32,
    /// The factor on heights above the shoulders.
    collar: f32,
    /// The factor on breadths of the hips.
    hips: f32,
    neck: Option<NeckLine>,
}

impl Shape {
    /// Returns how much a vertex of the clothes in bind space moves with the head, as the neck does there.
    fn nod(&self, cloth: &Cloth, at: Vec3) -> f32 {
        let neck = self.neck.as_ref();
        neck.map_or(0.0, |neck| cloth.shares.neck * neck.share(at.y))
    }

    /// Returns the position of a vertex of the clothes in bind space.
    fn place(&self, cloth: &Cloth, size: f32, places: [Vec3; 3]) -> Vec3 {
        let metre = 0.001;
        let low = ((-cloth.at.y - 120.0) / 300.0).clamp(0.0, 1.0);
        let wide = self.wide / (2.0 * SHOULDER * metre);
        let wide = wide.clamp(size * 0.6, size * 1.5);
        let across = wide + (self.hips - wide) * low;
        let tall = if cloth.at.y < 0.0 {
            self.trunk / (TRUNK * metre)
        } else {
            self.collar
        };
        let mut trunk = cloth.at * Vec3::new(across, tall, size) * metre;
        if let Some(neck) = self.neck.as_ref().filter(|_| cloth.shares.neck > 0.0) {
            // The collar stands around the neck, wherever that leads.
            let (middle, radius) = neck.at(neck.share(trunk.y));
            let [x, z] = [cloth.at.x, cloth.at.z - COLLAR_BACK].map(|it| it * radius / NECK);
            let around = Vec3::new(x, trunk.y, middle.z + z);
            trunk = trunk.lerp(around, cloth.shares.neck);
        }
        let along = arm_direction(cloth.side);
        let from = Vec3::X * (SHOULDER * cloth.side.sign() as f32);
        let lengths = [places[0].distance(places[1]), places[1].distance(places[2])];
        let s = cloth.along;
        let reach = if s < UPPER {
            s / UPPER * lengths[0]
        } else {
            lengths[0] + (s - UPPER) / FORE * lengths[1]
        };
        let arm = places[0] + along * reach + (cloth.at - from - along * s) * size * metre;
        trunk.lerp(arm, cloth.arm)
    }
}

/// Returns the shares of two neighbours in a row of followers, for a place `at` from 0 to 1 along the row.
fn between(row: &[usize], at: f32, share: f32) -> [(usize, f32); 2] {
    let last = row.len() - 1;
    let at = at.clamp(0.0, 1.0) * last as f32;
    let piece = (at as usize).min(last - 1);
    let on = at - piece as f32;
    [
        (row[piece], share * (1.0 - on)),
        (row[piece + 1], share * on),
    ]
}

/// Returns the size of a body relative to an adult's, from its arms and its stature.
fn size(anatomy: &Anatomy) -> f32 {
    let Some(measures) = anatomy.measures() else {
        return 1.0;
    };
    let (arm, stature) = (measures.arm as f32 / ARM, measures.stature as f32 / STATURE);
    match (arm > 1e-6, stature > 1e-6) {
        (true, true) => arm * 0.5 + stature.clamp(arm * 0.7, arm * 1.4) * 0.5,
        (true, false) => arm,
        (false, true) => stature,
        (false, false) => 1.0,
    }
}

fn colours(palette: &Palette, side: Side) -> HandColours {
    match side {
        Side::Right => palette.right,
        Side::Left => palette.left,
    }
}
