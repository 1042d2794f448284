//! Fits the canonical hand to a skeleton's hand, whatever joints it has.

use chereme_motion::{Anatomy, Finger, ModelPose, Side, Skeleton, anatomy::Part};
use glam::{Mat3, Quat, Vec3};

use super::glove::{ARCH, BONES, CUFF, FOLLOWERS, Glove, HALF, PALM, bone};
use super::group;
use super::shape::{place, rotation};
use super::skin::{Bound, Follower, Rig};
use crate::mesh::{Mesh, Vertex};
use crate::palette::{Colour, HandColours};

/// The length of the canonical hand from wrist to fingertip, in millimetres.
const LENGTH: f32 = 190.0;

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
    pub(super) fn of(
        anatomy: &Anatomy,
        side: Side,
        rest: &ModelPose,
        neutral: Vec3,
    ) -> Option<Self> {
        let joint = anatomy.joint(Part::Hand(side))?;
        let back = rotation(rest, joint).inverse();
        let along = anatomy.hand_direction(side, rest)?.as_vec3();
        let palm = anatomy.palm_normal(side, rest).map(|palm| palm.as_vec3());
        let palm = palm.unwrap_or_else(|| neutral.cross(along) * -side.sign() as f32);
        let palm = palm - along * along.dot(palm);
        Some(Self {
            along: back * along,
            palm: back
                * palm
                    .try_normalize()
                    .unwrap_or(along.any_orthonormal_vector()),
        })
    }
}

/// Returns the axes of a hand as columns: towards the thumb, along it, out of the palm.
pub(super) fn frame(side: Side, along: Vec3, palm: Vec3) -> Mat3 {
    let thumb = along.cross(palm) * -side.sign() as f32;
    Mat3::from_cols(thumb, along, palm)
}

/// A hand's position in bind space: its wrist and its axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seat {
    pub(super) wrist: Vec3,
    pub(super) axes: Mat3,
}

/// A bone of the fitted hand.
#[derive(Clone, Copy)]
struct Fitted {
    joint: Option<usize>,
    from: Vec3,
    axes: Mat3,
    /// The scale across, along and out of the palm.
    scale: Vec3,
}

/// A fit of the canonical hand to one side, to be added to a skin.
#[derive(Debug)]
pub(super) struct HandFit<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) anatomy: &'a Anatomy,
    pub(super) side: Side,
    pub(super) axes: HandAxes,
    pub(super) seat: Seat,
    /// The index of the follower that is the hand.
    pub(super) hand: usize,
    /// The index of the follower that is the forearm at the wrist.
    pub(super) cuff: usize,
}

impl HandFit<'_> {
    /// Adds the hand's surface and followers.
    pub(super) fn add(
        &self,
        rig: &mut Rig,
        bound: &mut Vec<Bound>,
        mesh: &mut Mesh,
        colours: HandColours,
    ) {
        let glove = Glove::get();
        let skeleton = self.skeleton;
        let mut local = skeleton.rest_pose();
        let angles = Glove::angles();
        self.anatomy
            .set_hand_angles(skeleton, self.side, &angles, &mut local);
        let bind = ModelPose::of(skeleton, &local);
        let Some(wrist) = self.anatomy.joint(Part::Hand(self.side)) else {
            return;
        };
        let turned = rotation(&bind, wrist);
        let own = frame(self.side, turned * self.axes.along, turned * self.axes.palm);
        // From model space, with the hand in the posture in which it was built, to bind space.
        let to_bind = |at: Vec3| {
            self.seat.wrist + self.seat.axes * (own.transpose() * (at - place(&bind, wrist)))
        };
        let turn = Quat::from_mat3(&(self.seat.axes * own.transpose())).normalize();
        let (bones, size) = self.bones(glove, &bind, wrist, own);
        let first = rig.followers.len();
        self.followers(rig, glove, &bones, (&bind, turn), &to_bind, first);
        let warp = Warp::new(glove, &bones);
        let base = mesh.vertices.len() as u32;
        for skin in &glove.skins {
            let mut at = Vec3::ZERO;
            for (follower, weight) in skin.weights {
                let part = |index: usize| {
                    if index == PALM {
                        warp.place(skin.place)
                    } else {
                        let (fitted, made) = (bones[index], glove.bones[index]);
                        let from = made.axes.transpose() * (skin.place - made.from);
                        fitted.from + fitted.axes * (from * fitted.scale)
                    }
                };
                let own = match follower {
                    CUFF => part(PALM),
                    f if ARCH.contains(&f) => part(PALM),
                    f if f == HALF + PALM => part(PALM),
                    f if f >= HALF => (part(f - HALF) + part(above(f - HALF))) * 0.5,
                    f => part(f),
                };
                at += own * weight;
            }
            let shares = skin
                .weights
                .map(|(follower, weight)| (first + follower, weight));
            bound.push(Bound::new(to_bind(at), &shares));
            mesh.vertices.push(Vertex {
                position: at,
                normal: Vec3::Y,
                colour: colour(skin, colours),
                group: skin.digit.map_or(group::palm(self.side), |digit| {
                    group::digit(self.side, digit)
                }),
            });
        }
        debug_assert!(size > 0.0);
        let flip = self.side == Side::Left;
        mesh.triangles.extend(glove.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| i + base);
            if flip { [a, c, b] } else { [a, b, c] }
        }));
    }

    /// Returns the fitted bones in model space, in the posture in which the hand is built, and the hand's size.
    fn bones(
        &self,
        glove: &Glove,
        bind: &ModelPose,
        wrist: usize,
        own: Mat3,
    ) -> ([Fitted; BONES], f32) {
        let side = self.side;
        let joint = |part| self.anatomy.joint(part);
        let odd_tip = |joint: usize| self.anatomy.odd_tip(self.skeleton, joint).is_some();
        let knuckle = |finger: Finger| joint(Part::Finger(side, finger, 1)).map(|j| place(bind, j));
        let root = place(bind, wrist);
        let measured = self
            .anatomy
            .measures()
            .map_or(LENGTH / 1000.0, |it| it.hand as f32);
        let size = (measured * 1000.0 / LENGTH).clamp(1e-6, 1e6) / 1000.0;
        let made = |at: Vec3| at - glove.bones[PALM].from;
        let knuckles: Vec<(Vec3, Vec3)> = Finger::ALL
            .into_iter()
            .filter_map(|finger| {
                let to = own.transpose() * (knuckle(finger)? - root);
                let from = made(glove.bones[bone(finger.index() + 1, 0)].from);
                Some((glove.bones[PALM].axes.transpose() * from, to))
            })
            .collect();
        let ratio = |from: f32, to: f32| {
            let ratio = to / from;
            if ratio.is_finite() {
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
            (Some(a), Some(b)) if knuckles.len() > 1 => ratio(a.0.x - b.0.x, a.1.x - b.1.x),
            _ => long,
        };
        let thick = (long * wide).sqrt().clamp(size * 0.8, size * 1.3);
        let palm = Fitted {
            joint: Some(wrist),
            from: root,
            axes: own,
            scale: Vec3::new(wide, long, thick),
        };
        let mut bones = [palm; BONES];
        for digit in 0..5 {
            for at in 0..3 {
                let part = match digit {
                    0 => Part::Thumb(side, at as u8),
                    n => Part::Finger(side, Finger::ALL[n - 1], at as u8 + 1),
                };
                let index = bone(digit, at);
                let made = glove.bones[index];
                let parent = above(index);
                let within = |point: Vec3| {
                    // Without a joint, the bone keeps its canonical position relative to the one before it.
                    let (fitted, made) = (bones[parent], glove.bones[parent]);
                    fitted.from
                        + fitted.axes * (made.axes.transpose() * (point - made.from) * fitted.scale)
                };
                let found = joint(part);
                let from = found.map_or_else(|| within(made.from), |joint| place(bind, joint));
                let length = made.from.distance(made.to);
                let next = match (found, at) {
                    (Some(_), 0 | 1) => joint(match digit {
                        0 => Part::Thumb(side, at as u8 + 1),
                        n => Part::Finger(side, Finger::ALL[n - 1], at as u8 + 2),
                    })
                    .map(|joint| place(bind, joint)),
                    _ => None,
                };
                let end = match (next, found) {
                    (Some(next), _) => Some(next),
                    (None, Some(joint)) => self
                        .anatomy
                        .digit_end(self.skeleton, joint)
                        .map(|end| place(bind, joint) + rotation(bind, joint) * end.as_vec3()),
                    (None, None) => None,
                };
                let end = end.filter(|end| {
                    let share = end.distance(from) / (length * thick);
                    share.is_finite() && (0.45..1.8).contains(&share)
                });
                let towards = own * (glove.bones[PALM].axes.transpose() * made.axes.y_axis);
                let (along, long) = match (end, found) {
                    (Some(end), _) => (
                        (end - from).normalize_or(towards),
                        end.distance(from) / length,
                    ),
                    (None, Some(joint)) if at > 0 && odd_tip(joint) => {
                        (bones[parent].axes.y_axis, thick)
                    }
                    (None, Some(_)) => (towards, thick),
                    (None, None) => {
                        let (fitted, made_parent) = (bones[parent], glove.bones[parent]);
                        let along = fitted.axes * (made_parent.axes.transpose() * made.axes.y_axis);
                        (along.normalize_or(towards), thick)
                    }
                };
                let pad = own * (glove.bones[PALM].axes.transpose() * made.axes.z_axis);
                let pad = (pad - along * along.dot(pad)).normalize_or(own.z_axis);
                let aside = along.cross(pad) * if self.side == Side::Left { -1.0 } else { 1.0 };
                bones[index] = Fitted {
                    joint: found,
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
        rig: &mut Rig,
        glove: &Glove,
        bones: &[Fitted; BONES],
        (bind, turn): (&ModelPose, Quat),
        to_bind: &impl Fn(Vec3) -> Vec3,
        first: usize,
    ) {
        let of = |joint: usize| Follower::Joint {
            joint,
            turn: rotation(bind, joint).inverse() * turn.inverse(),
            at: to_bind(place(bind, joint)),
        };
        let mut all: Vec<Follower> = Vec::with_capacity(FOLLOWERS);
        all.push(Follower::Same(self.hand));
        for (index, fitted) in bones.iter().enumerate().skip(1) {
            all.push(
                fitted
                    .joint
                    .map_or(Follower::Same(first + above(index)), of),
            );
        }
        for (index, fitted) in bones.iter().enumerate() {
            let at = to_bind(fitted.from);
            all.push(if index == PALM {
                Follower::Half {
                    parent: self.cuff,
                    child: self.hand,
                    at: self.seat.wrist,
                    along: self.seat.axes.y_axis,
                    swell: 0.10,
                }
            } else if fitted.joint.is_some() {
                Follower::Half {
                    parent: first + above(index),
                    child: first + index,
                    at,
                    along: turn * fitted.axes.y_axis,
                    swell: if glove.bones[index].from == glove.bones[bone(0, 0)].from {
                        0.0
                    } else {
                        0.12
                    },
                }
            } else {
                Follower::Same(first + above(index))
            });
        }
        all.push(Follower::Same(self.cuff));
        for finger in [Finger::Ring, Finger::Little] {
            let inner = self.anatomy.joint(Part::Finger(self.side, finger, 0));
            let wrist = self.anatomy.joint(Part::Hand(self.side));
            let inner = inner.filter(|&it| self.skeleton.parent(it) == wrist);
            all.push(inner.map_or(Follower::Same(self.hand), of));
        }
        debug_assert_eq!(all.len(), FOLLOWERS);
        rig.followers.extend(all);
    }
}

/// Returns the index of the bone before another.
fn above(index: usize) -> usize {
    if index == PALM || (index - 1).is_multiple_of(3) {
        PALM
    } else {
        index - 1
    }
}

/// The fit of the palm: scaled to the hand, and moved so that knuckles and thumb match those of the skeleton.
struct Warp {
    from: Mat3,
    palm: Fitted,
    pulls: Vec<(Vec3, Vec3)>,
}

impl Warp {
    fn new(glove: &Glove, bones: &[Fitted; BONES]) -> Self {
        let mut warp = Self {
            from: glove.bones[PALM].axes.transpose(),
            palm: bones[PALM],
            pulls: Vec::new(),
        };
        let pulls: Vec<(Vec3, Vec3)> = (0..5)
            .filter(|&digit| bones[bone(digit, 0)].joint.is_some())
            .map(|digit| {
                let made = glove.bones[bone(digit, 0)].from;
                (made, bones[bone(digit, 0)].from - warp.place(made))
            })
            .collect();
        warp.pulls = pulls;
        warp
    }

    fn place(&self, at: Vec3) -> Vec3 {
        let plain = self.palm.from + self.palm.axes * (self.from * at * self.palm.scale);
        let mut sum = 1.0 / (at.length_squared() + 60.0);
        let mut pull = Vec3::ZERO;
        for (from, by) in &self.pulls {
            let weight = 1.0 / (at.distance_squared(*from) + 60.0);
            pull += *by * weight;
            sum += weight;
        }
        plain + pull / sum
    }
}

fn colour(skin: &super::glove::Skin, colours: HandColours) -> Colour {
    let mixed = colours.back.mixed(colours.palm, skin.palmar);
    let shaded = mixed.scaled(skin.open);
    shaded.mixed(colours.nail, skin.nail * 0.85)
}
