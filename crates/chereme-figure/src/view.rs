//! Camera presets, and the space of a clip's signing.

mod reach;

use std::ops::Range;

use chereme_motion::ends::{Ends, activity};
use chereme_motion::{Anatomy, Clip, ModelPose, Part, Side};
use glam::{Mat3, Vec3};

use crate::camera::Camera;

pub use reach::Reach;

/// A direction of view onto the signer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum View {
    /// From the front, as the addressee sees it.
    Addressee,
    /// From above and behind the signer's head.
    Signer,
    /// From the signer's left.
    Left,
    /// From the signer's right.
    Right,
    /// From above, the signer's front towards the upper edge.
    Top,
    /// A hand from the front and nearby, followed as it moves; anything that hides it is left out.
    Hand(Side),
    /// The face from the front and nearby, followed as it moves, with the hands in front of it.
    Face,
    /// A hand with its palm towards the eye and its fingers up, whatever its rotation: the same handshape looks the
    /// same everywhere.
    Palm(Side),
}

impl View {
    /// Every view.
    pub const ALL: [Self; 10] = [
        Self::Addressee,
        Self::Signer,
        Self::Left,
        Self::Right,
        Self::Top,
        Self::Hand(Side::Right),
        Self::Hand(Side::Left),
        Self::Face,
        Self::Palm(Side::Right),
        Self::Palm(Side::Left),
    ];

    /// Returns the name that labels and commands use.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Addressee => "front",
            Self::Signer => "signer",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Hand(Side::Right) => "right hand",
            Self::Hand(Side::Left) => "left hand",
            Self::Face => "face",
            Self::Palm(Side::Right) => "right palm",
            Self::Palm(Side::Left) => "left palm",
        }
    }

    /// Returns the direction towards the eye and the picture's up, in the signer's left, up and forwards.
    const fn axes(self) -> [Vec3; 2] {
        match self {
            Self::Addressee | Self::Hand(_) | Self::Palm(_) | Self::Face => [Vec3::Z, Vec3::Y],
            Self::Signer => [Vec3::new(0.0, 0.62, -0.78), Vec3::Y],
            Self::Left => [Vec3::X, Vec3::Y],
            Self::Right => [Vec3::NEG_X, Vec3::Y],
            Self::Top => [Vec3::Y, Vec3::Z],
        }
    }
}

/// The space of a clip's signing, so that one camera serves all its frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framing {
    /// The signer's left, up and forwards.
    axes: Mat3,
    /// The least and the greatest corner along those axes, in metres.
    low: Vec3,
    high: Vec3,
    /// The length of a hand from wrist to fingertip, in metres.
    hand: f32,
    /// The joint that carries the body, and the middle of its way.
    carrier: Option<(usize, Vec3)>,
    /// Whether the corners are relative to that joint, because the body travels: the camera follows it.
    travels: bool,
    /// Whether the camera rotates with the body, because the body turns far.
    turns: bool,
    /// Whether the lower edge stays at the hips if a picture is narrower than the space: legs are not shown.
    seated: bool,
}

/// The number of frames of a clip that are sampled to measure its space.
const LOOKS: usize = 400;
/// The eye's distance relative to half the height of the visible area: a long lens.
const DISTANCE: f32 = 7.0;
/// Largest distance of a body from its middle, in metres, before the camera follows it.
const TRAVELS: f32 = 0.25;
/// The same in frames that are left out of the space, where programs put the body elsewhere.
const ELSEWHERE: f32 = 0.75;
/// Cosine of the largest angle between a body and its mean direction before the camera rotates with it.
const TURNS: f32 = 0.5;

impl Framing {
    /// Returns the space of `clip`: from the hips to above the head, and as far as both arms reach while they sign; all
    /// joints if the skeleton is not a known body. Hands at rest below the hips, odd frames at both ends, and the
    /// body's travel and turning are left out. `None` if the clip has no frames.
    #[must_use]
    pub fn of(clip: &Clip, anatomy: &Anatomy) -> Option<Self> {
        let poses = looks(clip, anatomy)?;
        let mut framing = Self::signing(&poses, anatomy);
        if let (Some(hips), Some(_)) = (anatomy.joint(Part::Hips), anatomy.joint(Part::Head)) {
            let at = |pose: &ModelPose| framing.against(pose, hips, anatomy).y;
            let hips = poses.iter().map(at).fold(f32::INFINITY, f32::min);
            framing.low.y = framing.low.y.min(hips - framing.hand * 0.2);
        }
        Some(framing)
    }

    /// Returns the space that `poses` take together, at least one posture.
    #[must_use]
    pub fn around(poses: &[ModelPose], anatomy: &Anatomy) -> Self {
        let axes = facing(poses, anatomy);
        let turns = poses.iter().any(|pose| {
            let own = facing(std::slice::from_ref(pose), anatomy);
            own.z_axis.dot(axes.z_axis) < TURNS
        });
        let mut found = Bounds::default();
        let arms = Side::BOTH.map(|side| anatomy.arm(side));
        let known = arms.iter().flatten().next().is_some();
        let arm = |side: usize| arms[side].map_or(0.0, |arm| arm_length(&poses[0], arm));
        let size = arm(0).max(arm(1)) / 0.53;
        let travel = find_travel(poses, anatomy);
        let travels = travel.is_some_and(|travel| travel.reach > TRAVELS);
        let carrier = travel.map(|travel| (travel.joint, travel.middle));
        for pose in poses {
            let to_own = if turns {
                facing(std::slice::from_ref(pose), anatomy).transpose()
            } else {
                axes.transpose()
            };
            let mut add = |joint: usize, margin: Vec3| {
                let at = to_own * (pose.position(joint).as_vec3() - based(carrier, travels, pose));
                found.add(at - margin);
                found.add(at + margin);
            };
            if !known {
                (0..pose.positions().len()).for_each(|joint| add(joint, Vec3::ZERO));
                continue;
            }
            let body = Vec3::new(0.13, 0.05, 0.14) * size;
            for joint in [anatomy.joint(Part::Hips), anatomy.joint(Part::Chest)]
                .into_iter()
                .flatten()
            {
                add(joint, body);
            }
            if let Some(head) = anatomy.joint(Part::Head) {
                add(head, above(anatomy, size));
            }
            for (side, arm) in Side::BOTH.into_iter().zip(arms) {
                let Some(arm) = arm else { continue };
                add(arm.upper, Vec3::splat(0.065) * size);
                add(arm.forearm, Vec3::splat(0.055) * size);
                add(arm.hand, Vec3::splat(0.05) * size);
                let fingers = anatomy.possible_fingers(side);
                let tips = fingers.iter().copied();
                tips.for_each(|joint| add(joint, Vec3::splat(0.035) * size));
                if fingers.is_empty() {
                    add(arm.hand, Vec3::splat(0.16) * size);
                }
            }
        }
        let (low, high) = found.0.unwrap_or((Vec3::NEG_ONE, Vec3::ONE));
        let least = if known {
            0.02 * size
        } else {
            ((high - low).length() * 0.03).max(0.02)
        };
        let least = Vec3::splat(least.max(1e-3));
        Self {
            axes,
            low: low - least,
            high: high + least,
            hand: if known {
                0.19 * size
            } else {
                (high - low).max_element() * 0.2
            },
            carrier,
            travels,
            turns: turns && known,
            seated: false,
        }
    }

    /// Returns the space of head, shoulders and hands alone, for small pictures: hands that hang at rest below the hips
    /// are left out, unless they always do.
    ///
    /// `poses` must not be empty; for a skeleton that is not a known body, it is the space of all joints.
    #[must_use]
    pub fn signing(poses: &[ModelPose], anatomy: &Anatomy) -> Self {
        let whole = Self::around(poses, anatomy);
        let arms = Side::BOTH.map(|side| anatomy.arm(side));
        let Some(size) = arms
            .iter()
            .flatten()
            .map(|&arm| arm_length(&poses[0], arm) / 0.53)
            .reduce(f32::max)
        else {
            return whole;
        };
        let at = |pose: &ModelPose, joint| whole.against(pose, joint, anatomy);
        let (mut always, mut hands) = (Bounds::default(), Bounds::default());
        for pose in poses {
            if let Some(head) = anatomy.joint(Part::Head) {
                always.around(at(pose, head), above(anatomy, size));
            }
            let hips = anatomy.joint(Part::Hips).map(|hips| at(pose, hips).y);
            for (side, arm) in Side::BOTH.into_iter().zip(arms) {
                let Some(arm) = arm else { continue };
                always.around(at(pose, arm.upper), Vec3::new(0.075, 0.32, 0.07) * size);
                always.around(at(pose, arm.forearm), Vec3::new(0.07, 0.06, 0.07) * size);
                let hand = at(pose, arm.hand);
                if hips.is_some_and(|hips| hand.y < hips + 0.1 * size) {
                    continue;
                }
                hands.around(hand, Vec3::splat(0.06) * size);
                for joint in anatomy.possible_fingers(side) {
                    hands.around(at(pose, joint), Vec3::splat(0.035) * size);
                }
            }
        }
        let (Some((low, high)), hands) = (always.0, hands.0) else {
            return whole;
        };
        let (low, high) = hands.map_or((low, high), |it| (low.min(it.0), high.max(it.1)));
        Self {
            low,
            high,
            seated: true,
            ..whole
        }
    }

    /// Returns the camera of a view for a picture whose width is `aspect` times its height; the hand views look at that
    /// hand in `pose`, the face view at the head. A picture too narrow for the space shows more room above the head,
    /// but no legs.
    #[must_use]
    pub fn camera(&self, view: View, aspect: f32, pose: &ModelPose, anatomy: &Anatomy) -> Camera {
        let view = match view {
            View::Palm(side) if palm_axes(pose, anatomy, side).is_none() => View::Hand(side),
            view => view,
        };
        let [towards, up] = view.axes();
        let own = Self {
            axes: self.facing(pose, anatomy),
            ..*self
        };
        if let View::Hand(side) = view
            && let Some(target) = hand_middle(pose, anatomy, side)
        {
            let half_height = self.hand * 0.66 / aspect.clamp(1e-3, 1.0);
            let camera = own.place(target, [towards, up], half_height);
            return Camera {
                near: half_height * DISTANCE - self.hand * 1.2,
                ..camera
            };
        }
        if let View::Palm(side) = view
            && let Some(target) = hand_middle(pose, anatomy, side)
            && let Some((towards, up)) = palm_axes(pose, anatomy, side)
        {
            let half_height = self.hand * 0.6 / aspect.clamp(1e-3, 1.0);
            return Camera {
                eye: target + towards * (half_height * DISTANCE),
                target,
                up,
                half_height,
                near: half_height * DISTANCE - self.hand * 1.2,
            };
        }
        if view == View::Face
            && let Some((target, height)) = head_middle(pose, anatomy)
        {
            let half_height = height * 0.62 / aspect.clamp(1e-3, 1.0);
            return own.place(target, [towards, up], half_height);
        }
        let half = (self.high - self.low) * 0.5;
        let middle =
            own.axes * ((self.high + self.low) * 0.5) + based(self.carrier, self.travels, pose);
        let right = up.cross(towards).normalize_or(Vec3::X);
        let tall = half.dot(right.cross(towards).abs());
        let wide = half.dot(right.abs());
        let deep = half.dot(towards.abs());
        let room = |half: f32| half * 1.02 + deep / DISTANCE * 0.5;
        let half_height = room(tall.max(wide / aspect.max(1e-3)));
        let level = matches!(view, View::Addressee | View::Left | View::Right);
        let raised = if self.seated && level {
            Vec3::Y * (half_height - room(tall))
        } else {
            Vec3::ZERO
        };
        own.place(middle + raised, [towards, up], half_height)
    }

    /// Returns the signer's left, up and forwards in a posture, as the camera sees them.
    fn facing(&self, pose: &ModelPose, anatomy: &Anatomy) -> Mat3 {
        if self.turns {
            facing(std::slice::from_ref(pose), anatomy)
        } else {
            self.axes
        }
    }

    fn place(&self, target: Vec3, [towards, up]: [Vec3; 2], half_height: f32) -> Camera {
        Camera {
            eye: target + self.axes * towards.normalize_or(Vec3::Z) * (half_height * DISTANCE),
            target,
            up: self.axes * up,
            half_height,
            near: 0.0,
        }
    }

    /// Returns the position of a joint relative to the point that the camera follows, along the signer's axes.
    fn against(&self, pose: &ModelPose, joint: usize, anatomy: &Anatomy) -> Vec3 {
        let from = pose.position(joint).as_vec3() - based(self.carrier, self.travels, pose);
        self.facing(pose, anatomy).transpose() * from
    }

    /// Returns the signer's left, up and forwards in model space.
    #[must_use]
    pub fn axes(&self) -> Mat3 {
        self.axes
    }

    /// Returns the ratio of width to height of a view's visible area.
    #[must_use]
    pub fn aspect(&self, view: View) -> f32 {
        let [towards, up] = view.axes();
        if matches!(view, View::Hand(_) | View::Palm(_) | View::Face) {
            return 1.0;
        }
        let half = (self.high - self.low) * 0.5;
        let right = up.cross(towards).normalize_or(Vec3::X);
        half.dot(right.abs()) / half.dot(right.cross(towards).abs()).max(1e-6)
    }
}

/// Returns the frame of `clip` to show first: the middle of its signing, when a hand is up; the middle of the clip
/// if none ever is.
#[must_use]
pub fn stroke(clip: &Clip, anatomy: &Anatomy) -> usize {
    let Some(last) = clip.frames().checked_sub(1) else {
        return 0;
    };
    let active = signed(clip, anatomy);
    let middle = (active.start + active.len() / 2).min(last);
    let mut up = evenly(active);
    up.retain(|&frame| has_hand_up(&clip.model_pose(frame), anatomy));
    up.get(up.len() / 2).copied().unwrap_or(middle)
}

/// Returns the active frames of `clip`; if no hand is ever active, all usable ones.
#[must_use]
pub fn signed(clip: &Clip, anatomy: &Anatomy) -> Range<usize> {
    activity(clip, anatomy).unwrap_or_else(|| Ends::of(clip, anatomy).sound)
}

/// Returns up to [`LOOKS`] of some frames, evenly spaced.
fn evenly(frames: Range<usize>) -> Vec<usize> {
    let (last, count) = (frames.len().saturating_sub(1), frames.len().min(LOOKS));
    let spaced = (0..count).map(|i| frames.start + last * i / (count - 1).max(1));
    spaced.collect()
}

/// Returns whether a hand is above the lower fifth of the trunk, so that it signs and does not rest. `false` if the
/// skeleton is not a known body.
#[must_use]
pub fn has_hand_up(pose: &ModelPose, anatomy: &Anatomy) -> bool {
    let (Some(hips), Some(size)) = (anatomy.joint(Part::Hips), anatomy.measures()) else {
        return false;
    };
    let least = pose.position(hips).y + 0.2 * size.trunk;
    let hands = Side::BOTH.map(|side| anatomy.joint(Part::Hand(side)));
    let mut hands = hands.iter().flatten();
    hands.any(|&hand| pose.position(hand).y > least)
}

/// Returns the point that the camera follows: the body if it travels, otherwise the origin, moved with a body that is
/// elsewhere.
fn based(carrier: Option<(usize, Vec3)>, travels: bool, pose: &ModelPose) -> Vec3 {
    let Some((joint, middle)) = carrier else {
        return Vec3::ZERO;
    };
    let at = pose.position(joint).as_vec3();
    match at - middle {
        _ if travels => at,
        off if off.length() > ELSEWHERE => off,
        _ => Vec3::ZERO,
    }
}

/// The travel of the joint that carries a body.
#[derive(Clone, Copy)]
struct BodyTravel {
    joint: usize,
    middle: Vec3,
    /// The greatest distance from the middle.
    reach: f32,
}

fn find_travel(poses: &[ModelPose], anatomy: &Anatomy) -> Option<BodyTravel> {
    let parts = [Part::Hips, Part::Spine, Part::Chest];
    let joint = parts.iter().find_map(|&part| anatomy.joint(part))?;
    let mut bounds = Bounds::default();
    for pose in poses {
        bounds.add(pose.position(joint).as_vec3());
    }
    let (low, high) = bounds.0?;
    Some(BodyTravel {
        joint,
        middle: (low + high) * 0.5,
        reach: (high - low).length() * 0.5,
    })
}

/// Returns postures of a clip, evenly spaced if there are many, without odd first and last frames.
fn looks(clip: &Clip, anatomy: &Anatomy) -> Option<Vec<ModelPose>> {
    clip.frames().checked_sub(1)?;
    let frames = evenly(Ends::of(clip, anatomy).sound).into_iter();
    Some(frames.map(|frame| clip.model_pose(frame)).collect())
}

/// Returns the middle of a hand: between wrist and the joints of the fingers.
fn hand_middle(pose: &ModelPose, anatomy: &Anatomy, side: Side) -> Option<Vec3> {
    let wrist = anatomy.joint(Part::Hand(side))?;
    let fingers = anatomy.possible_fingers(side);
    let wrist = pose.position(wrist).as_vec3();
    if fingers.is_empty() {
        return Some(wrist);
    }
    let sum: Vec3 = fingers
        .iter()
        .map(|&joint| pose.position(joint).as_vec3())
        .sum();
    Some(wrist.lerp(sum / fingers.len() as f32, 0.85))
}

/// Returns the direction out of a palm, a little from the thumb's side and from above, and the fingers' direction.
fn palm_axes(pose: &ModelPose, anatomy: &Anatomy, side: Side) -> Option<(Vec3, Vec3)> {
    let palm = anatomy.palm_normal(side, pose)?.as_vec3();
    let along = anatomy.hand_direction(side, pose)?.as_vec3();
    let thumb = along.cross(palm) * -side.sign() as f32;
    let towards = (palm + thumb * 0.42 + along * 0.3).try_normalize()?;
    let up = (along - towards * along.dot(towards)).try_normalize()?;
    Some((towards, up))
}

/// Returns the middle of the head and its height, if both are known.
fn head_middle(pose: &ModelPose, anatomy: &Anatomy) -> Option<(Vec3, f32)> {
    let joint = anatomy.joint(Part::Head)?;
    let measures = anatomy.measures()?;
    let [_, up, _] = anatomy.head_axes(pose)?;
    let middle = up * (measures.head_top - measures.head * 0.5);
    let target = pose.position(joint) + middle;
    Some((target.as_vec3(), measures.head as f32))
}

/// Returns the space that a head needs around its joint.
fn above(anatomy: &Anatomy, size: f32) -> Vec3 {
    let top = anatomy.measures().map_or(0.0, |it| it.head_top as f32);
    let top = top.clamp(0.19 * size, 0.36 * size) + 0.035 * size;
    Vec3::new(0.1 * size, top, 0.14 * size)
}

fn arm_length(pose: &ModelPose, arm: chereme_motion::ArmChain) -> f32 {
    let at = |joint: usize| pose.position(joint);
    let upper = (at(arm.forearm) - at(arm.upper)).length();
    (upper + (at(arm.hand) - at(arm.forearm)).length()) as f32
}

/// Returns the signer's left, up and forwards over all postures; up is that of model space.
fn facing(poses: &[ModelPose], anatomy: &Anatomy) -> Mat3 {
    let mut left = Vec3::ZERO;
    for part in [Part::Thigh as fn(Side) -> Part, Part::UpperArm] {
        if let [Some(r), Some(l)] = Side::BOTH.map(|side| anatomy.joint(part(side))) {
            let across = |pose: &ModelPose| (pose.position(l) - pose.position(r)).as_vec3();
            left += poses.iter().map(across).sum::<Vec3>() / poses.len() as f32;
        }
    }
    let flat = Vec3::new(left.x, 0.0, left.z).normalize_or(Vec3::X);
    Mat3::from_cols(flat, Vec3::Y, flat.cross(Vec3::Y))
}

#[derive(Default)]
struct Bounds(Option<(Vec3, Vec3)>);

impl Bounds {
    fn around(&mut self, at: Vec3, margin: Vec3) {
        self.add(at - margin);
        self.add(at + margin);
    }

    fn add(&mut self, at: Vec3) {
        let (low, high) = self.0.unwrap_or((at, at));
        self.0 = Some((low.min(at), high.max(at)));
    }
}
