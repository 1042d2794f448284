//! Fits the canonical hand to a skeleton's hand, whatever joints it has.

use chereme_motion::{BodyAnatomy, BodySide, HandFinger, ModelPose, Skeleton, anatomy::BodyPart};
use glam::{Mat3, Quat, Vec3};

use super::body_shape::{posed_joint_position, posed_joint_rotation};
use super::glove::{
    CUFF_FOLLOWER, CanonicalHand, FIRST_HALF_JOINT, HAND_BONE_COUNT, HAND_FOLLOWER_COUNT, PALM_ARCH_BONES, PALM_BONE,
    digit_bone_index,
};
use super::group;
use super::skin::{BoundSkinVertex, SkinFollower, SkinRig};
use crate::mesh::{MeshVertex, TriangleMesh};
use crate::palette::{HandColours, RgbColour};

/// The length of the canonical hand from wrist to fingertip, in millimetres.
const CANONICAL_HAND_LENGTH_MM: f32 = 190.0;

/// The directions of a hand: towards the thumb, along it, out of the palm; for a left hand they form a left-handed
/// system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HandAxes {
    /// The direction along the hand, in the space of its joint.
    pub(super) along: Vec3,
    pub(super) palm: Vec3,
}

impl HandAxes {
    /// Returns the directions of a hand at rest. `neutral` is the direction of the thumb in model space, for a hand
    /// without fingers.
    pub(super) fn hand_axes_at_rest(
        anatomy: &BodyAnatomy,
        side: BodySide,
        rest: &ModelPose,
        neutral: Vec3,
    ) -> Option<Self> {
        let joint = anatomy.part_joint(BodyPart::Hand(side))?;
        let back = posed_joint_rotation(rest, joint).inverse();
        let along = anatomy.hand_direction(side, rest)?.as_vec3();
        let raw_palm = anatomy.palm_normal(side, rest).map(|palm| palm.as_vec3());
        // Without fingers no joint shows the palm, so the thumb's usual direction stands in for it.
        let palm = raw_palm.unwrap_or_else(|| neutral.cross(along) * -side.side_sign() as f32);
        // Only the part across the hand counts: the three axes have to be orthogonal.
        let palm = palm - along * along.dot(palm);
        Some(Self {
            along: back * along,
            palm: back * palm.try_normalize().unwrap_or(along.any_orthonormal_vector()),
        })
    }
}

/// Returns the axes of a hand as columns: towards the thumb, along it, out of the palm.
pub(super) fn hand_axes_frame(side: BodySide, along: Vec3, palm: Vec3) -> Mat3 {
    // The axes of a left hand form a left-handed system, hence the sign.
    let thumb = along.cross(palm) * -side.side_sign() as f32;
    Mat3::from_cols(thumb, along, palm)
}

/// A hand's position in bind space: its wrist and its axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct HandSeat {
    pub(super) wrist: Vec3,
    pub(super) axes: Mat3,
}

/// A bone of the fitted hand.
#[derive(Clone, Copy)]
struct FittedHandBone {
    joint: Option<usize>,
    from: Vec3,
    axes: Mat3,
    /// The scale across, along and out of the palm.
    scale: Vec3,
}

/// The way from model space, with the hand in the posture in which it was built, to bind space.
struct HandBinding<'a> {
    bind: &'a ModelPose,
    wrist: Vec3,
    frame: Mat3,
    seat: HandSeat,
}

impl HandBinding<'_> {
    fn bind_place(&self, at: Vec3) -> Vec3 {
        self.seat.wrist + self.seat.axes * (self.frame.transpose() * (at - self.wrist))
    }

    fn bind_rotation(&self) -> Quat {
        Quat::from_mat3(&(self.seat.axes * self.frame.transpose())).normalize()
    }
}

/// A fit of the canonical hand to one side, to be added to a skin.
#[derive(Debug)]
pub(super) struct HandFit<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) anatomy: &'a BodyAnatomy,
    pub(super) side: BodySide,
    pub(super) axes: HandAxes,
    pub(super) seat: HandSeat,
    /// The index of the follower that is the hand.
    pub(super) hand: usize,
    /// The index of the follower that is the forearm at the wrist.
    pub(super) cuff: usize,
}

impl HandFit<'_> {
    /// Adds the hand's surface and followers.
    pub(super) fn add_hand_surface(
        &self,
        rig: &mut SkinRig,
        bound: &mut Vec<BoundSkinVertex>,
        mesh: &mut TriangleMesh,
        colours: HandColours,
    ) {
        let glove = CanonicalHand::shared_hand();
        let skeleton = self.skeleton;
        let mut local = skeleton.rest_pose();
        let angles = CanonicalHand::built_hand_angles();
        // Fingers bind in the spread posture of the canonical hand, since at rest they may touch or be curled.
        self.anatomy.set_hand_angles(skeleton, self.side, &angles, &mut local);
        let bind = ModelPose::from_local_pose(skeleton, &local);
        let Some(wrist) = self.anatomy.part_joint(BodyPart::Hand(self.side)) else {
            return;
        };
        let turned = posed_joint_rotation(&bind, wrist);
        let hand_frame = hand_axes_frame(self.side, turned * self.axes.along, turned * self.axes.palm);
        let binding = HandBinding {
            bind: &bind,
            wrist: posed_joint_position(&bind, wrist),
            frame: hand_frame,
            seat: self.seat,
        };
        let (bones, size) = self.fit_hand_bones(glove, &bind, wrist, hand_frame);
        let first = rig.followers.len();
        self.followers(rig, glove, &bones, &binding, first);
        let warp = PalmWarp::new(glove, &bones);
        let base = mesh.vertices.len() as u32;
        for skin in &glove.skins {
            let mut skinned_place = Vec3::ZERO;
            for (follower, weight) in skin.weights {
                let part = |index: usize| {
                    if index == PALM_BONE {
                        warp.warp_palm_place(skin.place)
                    } else {
                        let (fitted, made) = (bones[index], glove.bones[index]);
                        let from = made.axes.transpose() * (skin.place - made.from);
                        fitted.from + fitted.axes * (from * fitted.scale)
                    }
                };
                let part_place = match follower {
                    // Cuff, arches and the wrist's half joint have the shape of the palm.
                    CUFF_FOLLOWER => part(PALM_BONE),
                    f if PALM_ARCH_BONES.contains(&f) => part(PALM_BONE),
                    f if f == FIRST_HALF_JOINT + PALM_BONE => part(PALM_BONE),
                    f if f >= FIRST_HALF_JOINT => {
                        // A half joint takes the mean of where its two bones would put the vertex.
                        (part(f - FIRST_HALF_JOINT) + part(bone_before(f - FIRST_HALF_JOINT))) * 0.5
                    }
                    f => part(f),
                };
                skinned_place += part_place * weight;
            }
            let shares = skin.weights.map(|(follower, weight)| (first + follower, weight));
            bound.push(BoundSkinVertex::new(binding.bind_place(skinned_place), &shares));
            mesh.vertices.push(MeshVertex {
                position: skinned_place,
                normal: Vec3::Y,
                colour: hand_vertex_colour(skin, colours),
                group: skin.digit.map_or(group::palm_group(self.side), |digit| {
                    group::digit_group(self.side, digit)
                }),
            });
        }
        debug_assert!(size > 0.0);
        // The canonical hand is a right one: mirroring turns its triangles inside out.
        let flip = self.side == BodySide::Left;
        mesh.triangles.extend(glove.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| i + base);
            if flip { [a, c, b] } else { [a, b, c] }
        }));
    }

    /// Returns the fitted bones in model space, in the posture in which the hand is built, and the hand's size.
    fn fit_hand_bones(
        &self,
        glove: &CanonicalHand,
        bind: &ModelPose,
        wrist: usize,
        own: Mat3,
    ) -> ([FittedHandBone; HAND_BONE_COUNT], f32) {
        let side = self.side;
        let joint = |part| self.anatomy.part_joint(part);
        let odd_tip = |joint: usize| self.anatomy.odd_tip(self.skeleton, joint).is_some();
        let knuckle =
            |finger: HandFinger| joint(BodyPart::Finger(side, finger, 1)).map(|j| posed_joint_position(bind, j));
        let root = posed_joint_position(bind, wrist);
        let measured = self
            .anatomy
            .anatomy_measures()
            .map_or(CANONICAL_HAND_LENGTH_MM / 1000.0, |measures| measures.hand as f32);
        // A hand of no length or of any unit still gives a finite, positive size.
        let size = (measured * 1000.0 / CANONICAL_HAND_LENGTH_MM).clamp(1e-6, 1e6) / 1000.0;
        let made = |at: Vec3| at - glove.bones[PALM_BONE].from;
        let knuckles: Vec<(Vec3, Vec3)> = HandFinger::ALL_FINGERS
            .into_iter()
            .filter_map(|finger| {
                let to = own.transpose() * (knuckle(finger)? - root);
                let from = made(glove.bones[digit_bone_index(finger.index() + 1, 0)].from);
                Some((glove.bones[PALM_BONE].axes.transpose() * from, to))
            })
            .collect();
        let ratio = |from: f32, to: f32| {
            let ratio = to / from;
            if ratio.is_finite() {
                // Odd skeletons place knuckles anywhere: the palm follows them only within a human range.
                ratio.clamp(size * 0.6, size * 1.6)
            } else {
                size
            }
        };
        let long = if knuckles.is_empty() {
            size
        } else {
            ratio(
                knuckles.iter().map(|k| k.0.y).sum(),
                knuckles.iter().map(|k| k.1.y).sum(),
            )
        };
        let wide = match (knuckles.first(), knuckles.last()) {
            // One knuckle says nothing about the breadth of the palm.
            (Some(a), Some(b)) if knuckles.len() > 1 => ratio(a.0.x - b.0.x, a.1.x - b.1.x),
            _ => long,
        };
        // The skeleton says nothing about thickness, which follows length and breadth as a mean.
        let thick = (long * wide).sqrt().clamp(size * 0.8, size * 1.3);
        let palm = FittedHandBone {
            joint: Some(wrist),
            from: root,
            axes: own,
            scale: Vec3::new(wide, long, thick),
        };
        let mut bones = [palm; HAND_BONE_COUNT];
        for digit in 0..5 {
            for at in 0..3 {
                let part = match digit {
                    0 => BodyPart::Thumb(side, at as u8),
                    n => BodyPart::Finger(side, HandFinger::ALL_FINGERS[n - 1], at as u8 + 1),
                };
                let index = digit_bone_index(digit, at);
                let made = glove.bones[index];
                let parent = bone_before(index);
                let within = |point: Vec3| {
                    // Without a joint, the bone keeps its canonical position relative to the one before it.
                    let (fitted, made) = (bones[parent], glove.bones[parent]);
                    fitted.from + fitted.axes * (made.axes.transpose() * (point - made.from) * fitted.scale)
                };
                let part_joint = joint(part);
                let from = part_joint.map_or_else(|| within(made.from), |joint| posed_joint_position(bind, joint));
                let length = made.from.distance(made.to);
                let next = match (part_joint, at) {
                    (Some(_), 0 | 1) => joint(match digit {
                        0 => BodyPart::Thumb(side, at as u8 + 1),
                        n => BodyPart::Finger(side, HandFinger::ALL_FINGERS[n - 1], at as u8 + 2),
                    })
                    .map(|joint| posed_joint_position(bind, joint)),
                    _ => None,
                };
                let bone_end = match (next, part_joint) {
                    (Some(next), _) => Some(next),
                    (None, Some(joint)) => self.anatomy.digit_end(self.skeleton, joint).map(|end| {
                        posed_joint_position(bind, joint) + posed_joint_rotation(bind, joint) * end.as_vec3()
                    }),
                    (None, None) => None,
                };
                let end = bone_end.filter(|end| {
                    // Ends outside this range are no bone's length and would draw out a spike.
                    let share = end.distance(from) / (length * thick);
                    share.is_finite() && (0.45..1.8).contains(&share)
                });
                let towards = own * (glove.bones[PALM_BONE].axes.transpose() * made.axes.y_axis);
                let (along, long) = match (end, part_joint) {
                    (Some(end), _) => ((end - from).normalize_or(towards), end.distance(from) / length),
                    // An end site that points aside says nothing: the last bone goes on straight.
                    (None, Some(joint)) if at > 0 && odd_tip(joint) => (bones[parent].axes.y_axis, thick),
                    (None, Some(_)) => (towards, thick),
                    (None, None) => {
                        let (fitted, made_parent) = (bones[parent], glove.bones[parent]);
                        let along = fitted.axes * (made_parent.axes.transpose() * made.axes.y_axis);
                        (along.normalize_or(towards), thick)
                    }
                };
                let raw_pad = own * (glove.bones[PALM_BONE].axes.transpose() * made.axes.z_axis);
                let pad = (raw_pad - along * along.dot(raw_pad)).normalize_or(own.z_axis);
                // The first axis points to the thumb's side on both hands.
                let aside = along.cross(pad) * if self.side == BodySide::Left { -1.0 } else { 1.0 };
                bones[index] = FittedHandBone {
                    joint: part_joint,
                    from,
                    axes: Mat3::from_cols(aside, along, pad),
                    scale: Vec3::new(thick, long, thick),
                };
            }
        }
        (bones, size)
    }

    fn followers(
        &self,
        rig: &mut SkinRig,
        glove: &CanonicalHand,
        bones: &[FittedHandBone; HAND_BONE_COUNT],
        binding: &HandBinding<'_>,
        first: usize,
    ) {
        let (bind, turn) = (binding.bind, binding.bind_rotation());
        let of = |joint: usize| SkinFollower::Joint {
            joint,
            turn: posed_joint_rotation(bind, joint).inverse() * turn.inverse(),
            at: binding.bind_place(posed_joint_position(bind, joint)),
        };
        let mut all: Vec<SkinFollower> = Vec::with_capacity(HAND_FOLLOWER_COUNT);
        // Index 0 is the palm, which is the whole hand's follower.
        all.push(SkinFollower::Same(self.hand));
        for (index, fitted) in bones.iter().enumerate().skip(1) {
            // A bone that the skeleton lacks moves with the one before it.
            all.push(fitted.joint.map_or(SkinFollower::Same(first + bone_before(index)), of));
        }
        for (index, fitted) in bones.iter().enumerate() {
            let bone_place = binding.bind_place(fitted.from);
            all.push(if index == PALM_BONE {
                SkinFollower::Half {
                    parent: self.cuff,
                    child: self.hand,
                    at: self.seat.wrist,
                    along: self.seat.axes.y_axis,
                    // A wrist swells less than a knuckle when it bends.
                    swell: 0.10,
                }
            } else if fitted.joint.is_some() {
                SkinFollower::Half {
                    parent: first + bone_before(index),
                    child: first + index,
                    at: bone_place,
                    along: turn * fitted.axes.y_axis,
                    // The thumb's base moves inside its ball, where a swelling would show as a lump.
                    swell: if glove.bones[index].from == glove.bones[digit_bone_index(0, 0)].from {
                        0.0
                    } else {
                        0.12
                    },
                }
            } else {
                SkinFollower::Same(first + bone_before(index))
            });
        }
        all.push(SkinFollower::Same(self.cuff));
        for finger in [HandFinger::Ring, HandFinger::Little] {
            let inner = self.anatomy.part_joint(BodyPart::Finger(self.side, finger, 0));
            let wrist = self.anatomy.part_joint(BodyPart::Hand(self.side));
            // A joint of the palm counts only if it hangs on the wrist itself.
            let inner = inner.filter(|&joint| self.skeleton.joint_parent(joint) == wrist);
            all.push(inner.map_or(SkinFollower::Same(self.hand), of));
        }
        debug_assert_eq!(all.len(), HAND_FOLLOWER_COUNT);
        rig.followers.extend(all);
    }
}

/// Returns the index of the bone before another.
fn bone_before(index: usize) -> usize {
    if index == PALM_BONE || (index - 1).is_multiple_of(3) {
        PALM_BONE
    } else {
        index - 1
    }
}

/// The fit of the palm: scaled to the hand, and moved so that knuckles and thumb match those of the skeleton.
struct PalmWarp {
    from: Mat3,
    palm: FittedHandBone,
    pulls: Vec<(Vec3, Vec3)>,
}

impl PalmWarp {
    fn new(glove: &CanonicalHand, bones: &[FittedHandBone; HAND_BONE_COUNT]) -> Self {
        let mut warp = Self {
            from: glove.bones[PALM_BONE].axes.transpose(),
            palm: bones[PALM_BONE],
            pulls: Vec::new(),
        };
        let pulls: Vec<(Vec3, Vec3)> = (0..5)
            .filter(|&digit| bones[digit_bone_index(digit, 0)].joint.is_some())
            .map(|digit| {
                let made = glove.bones[digit_bone_index(digit, 0)].from;
                (
                    made,
                    bones[digit_bone_index(digit, 0)].from - warp.warp_palm_place(made),
                )
            })
            .collect();
        warp.pulls = pulls;
        warp
    }

    fn warp_palm_place(&self, at: Vec3) -> Vec3 {
        let plain = self.palm.from + self.palm.axes * (self.from * at * self.palm.scale);
        // The wrist, at the origin, counts as a place without pull and stays.
        let mut sum = 1.0 / (at.length_squared() + 60.0);
        let mut pull = Vec3::ZERO;
        for (from, by) in &self.pulls {
            let weight = 1.0 / (at.distance_squared(*from) + 60.0);
            pull += *by * weight;
            // The 60 square millimetres keep the weight finite at the knuckle itself.
            sum += weight;
        }
        plain + pull / sum
    }
}

fn hand_vertex_colour(skin: &super::glove::HandVertex, colours: HandColours) -> RgbColour {
    let mixed = colours.back.mix_colour(colours.palm, skin.palmar);
    let shaded = mixed.scale_colour(skin.open);
    // A nail lets a little of the skin's colour shine through.
    shaded.mix_colour(colours.nail, skin.nail * 0.85)
}
