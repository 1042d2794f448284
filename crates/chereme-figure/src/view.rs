//! Camera presets, and the space of a clip's signing.

mod view_reach;

use std::ops::Range;

use chereme_motion::ends::{ClipEnds, activity_frames};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, ModelPose};
use glam::{Mat3, Vec3};

use crate::camera::FigureCamera;

pub use view_reach::SigningReach;

/// A direction of view onto the signer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FigureView {
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
    Hand(BodySide),
    /// The face from the front and nearby, followed as it moves, with the hands in front of it.
    Face,
    /// A hand with its palm towards the eye and its fingers up, whatever its rotation: the same handshape looks the
    /// same everywhere.
    Palm(BodySide),
}

impl FigureView {
    /// Every view.
    pub const ALL_FIGURE_VIEWS: [Self; 10] = [
        Self::Addressee,
        Self::Signer,
        Self::Left,
        Self::Right,
        Self::Top,
        Self::Hand(BodySide::Right),
        Self::Hand(BodySide::Left),
        Self::Face,
        Self::Palm(BodySide::Right),
        Self::Palm(BodySide::Left),
    ];

    /// Returns the name that labels and commands use.
    #[must_use]
    pub const fn figure_view_name(self) -> &'static str {
        match self {
            Self::Addressee => "front",
            Self::Signer => "signer",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Hand(BodySide::Right) => "right hand",
            Self::Hand(BodySide::Left) => "left hand",
            Self::Face => "face",
            Self::Palm(BodySide::Right) => "right palm",
            Self::Palm(BodySide::Left) => "left palm",
        }
    }

    /// Returns the direction towards the eye and the picture's up, in the signer's left, up and forwards.
    const fn view_axes(self) -> [Vec3; 2] {
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
pub struct ClipFraming {
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
const SAMPLED_CLIP_FRAMES: usize = 400;
/// The eye's distance relative to half the height of the visible area: a long lens.
const FRAMING_EYE_DISTANCE: f32 = 7.0;
/// Largest distance of a body from its middle, in metres, before the camera follows it.
const MAX_TRAVEL_METRES: f32 = 0.25;
/// The same in frames that are left out of the space, where programs put the body elsewhere.
const MAX_EXCLUDED_TRAVEL_METRES: f32 = 0.75;
/// Cosine of the largest angle between a body and its mean direction before the camera rotates with it.
const BODY_TURN_COSINE: f32 = 0.5;

impl ClipFraming {
    /// Returns the space of `clip`: from the hips to above the head, and as far as both arms reach while they sign; all
    /// joints if the skeleton is not a known body. Hands at rest below the hips, odd frames at both ends, and the
    /// body's travel and turning are left out. `None` if the clip has no frames.
    #[must_use]
    pub fn framing_from_clip(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Self> {
        let poses = sample_clip_poses(clip, anatomy)?;
        let mut framing = Self::framing_from_signing(&poses, anatomy);
        if let (Some(hips), Some(_)) = (anatomy.part_joint(BodyPart::Hips), anatomy.part_joint(BodyPart::Head)) {
            // Signing may stay high above the hips, where the picture still begins.
            let hips_height = |pose: &ModelPose| framing.relative_joint_position(pose, hips, anatomy).y;
            let hips = poses.iter().map(hips_height).fold(f32::INFINITY, f32::min);
            framing.low.y = framing.low.y.min(hips - framing.hand * 0.2);
        }
        Some(framing)
    }

    /// Returns the space that `poses` take together, at least one posture.
    #[must_use]
    pub fn framing_from_poses(poses: &[ModelPose], anatomy: &BodyAnatomy) -> Self {
        // One mean direction for the clip, so that the camera does not sway with the body.
        let axes = mean_signer_axes(poses, anatomy);
        let turns = poses.iter().any(|pose| {
            let pose_axes = mean_signer_axes(std::slice::from_ref(pose), anatomy);
            pose_axes.z_axis.dot(axes.z_axis) < BODY_TURN_COSINE
        });
        let mut bounds = FramingBounds::default();
        let arms = BodySide::BOTH_SIDES.map(|side| anatomy.arm_chain(side));
        let has_arms = arms.iter().flatten().next().is_some();
        let arm = |side: usize| arms[side].map_or(0.0, |arm| arm_length(&poses[0], arm));
        // 0.53 m is the arm of an adult, for which the margins below are given.
        let size = arm(0).max(arm(1)) / 0.53;
        let travel = find_travel(poses, anatomy);
        let travels = travel.is_some_and(|travel| travel.reach > MAX_TRAVEL_METRES);
        let carrier = travel.map(|travel| (travel.joint, travel.middle));
        for pose in poses {
            let to_own = if turns {
                mean_signer_axes(std::slice::from_ref(pose), anatomy).transpose()
            } else {
                axes.transpose()
            };
            let mut add = |joint: usize, margin: Vec3| {
                let joint_place = to_own * (pose.model_joint_position(joint).as_vec3() - based(carrier, travels, pose));
                bounds.include_bounds_point(joint_place - margin);
                bounds.include_bounds_point(joint_place + margin);
            };
            // Without arms nothing is known of the body: all joints count, without margins.
            if !has_arms {
                (0..pose.model_joint_positions().len()).for_each(|joint| add(joint, Vec3::ZERO));
                continue;
            }
            let body = Vec3::new(0.13, 0.05, 0.14) * size;
            for joint in [anatomy.part_joint(BodyPart::Hips), anatomy.part_joint(BodyPart::Chest)]
                .into_iter()
                .flatten()
            {
                add(joint, body);
            }
            if let Some(head) = anatomy.part_joint(BodyPart::Head) {
                add(head, head_clearance(anatomy, size));
            }
            for (side, arm) in BodySide::BOTH_SIDES.into_iter().zip(arms) {
                let Some(arm) = arm else { continue };
                add(arm.upper, Vec3::splat(0.065) * size);
                add(arm.forearm, Vec3::splat(0.055) * size);
                add(arm.hand, Vec3::splat(0.05) * size);
                let fingers = anatomy.possible_fingers(side);
                let tips = fingers.iter().copied();
                tips.for_each(|joint| add(joint, Vec3::splat(0.035) * size));
                // A hand without fingers has its length beyond the wrist.
                if fingers.is_empty() {
                    add(arm.hand, Vec3::splat(0.16) * size);
                }
            }
        }
        let (low, high) = bounds.0.unwrap_or((Vec3::NEG_ONE, Vec3::ONE));
        let least_extent = if has_arms {
            0.02 * size
        } else {
            ((high - low).length() * 0.03).max(0.02)
        };
        // A clip of one point still has a space with a size.
        let least = Vec3::splat(least_extent.max(1e-3));
        Self {
            axes,
            low: low - least,
            high: high + least,
            hand: if has_arms {
                0.19 * size
            } else {
                (high - low).max_element() * 0.2
            },
            carrier,
            travels,
            turns: turns && has_arms,
            seated: false,
        }
    }

    /// Returns the space of head, shoulders and hands alone, for small pictures: hands that hang at rest below the hips
    /// are left out, unless they always do.
    ///
    /// `poses` must not be empty; for a skeleton that is not a known body, it is the space of all joints.
    #[must_use]
    pub fn framing_from_signing(poses: &[ModelPose], anatomy: &BodyAnatomy) -> Self {
        let full_framing = Self::framing_from_poses(poses, anatomy);
        let arms = BodySide::BOTH_SIDES.map(|side| anatomy.arm_chain(side));
        let Some(size) = arms
            .iter()
            .flatten()
            .map(|&arm| arm_length(&poses[0], arm) / 0.53)
            .reduce(f32::max)
        else {
            return full_framing;
        };
        let joint_place = |pose: &ModelPose, joint| full_framing.relative_joint_position(pose, joint, anatomy);
        let (mut always, mut hands) = (FramingBounds::default(), FramingBounds::default());
        for pose in poses {
            if let Some(head) = anatomy.part_joint(BodyPart::Head) {
                always.include_point_margin(joint_place(pose, head), head_clearance(anatomy, size));
            }
            let hips = anatomy.part_joint(BodyPart::Hips).map(|hips| joint_place(pose, hips).y);
            for (side, arm) in BodySide::BOTH_SIDES.into_iter().zip(arms) {
                let Some(arm) = arm else { continue };
                always.include_point_margin(joint_place(pose, arm.upper), Vec3::new(0.075, 0.32, 0.07) * size);
                always.include_point_margin(joint_place(pose, arm.forearm), Vec3::new(0.07, 0.06, 0.07) * size);
                let hand = joint_place(pose, arm.hand);
                // Hands that hang at rest would make every picture as tall as the legs.
                if hips.is_some_and(|hips| hand.y < hips + 0.1 * size) {
                    continue;
                }
                hands.include_point_margin(hand, Vec3::splat(0.06) * size);
                for joint in anatomy.possible_fingers(side) {
                    hands.include_point_margin(joint_place(pose, joint), Vec3::splat(0.035) * size);
                }
            }
        }
        let (Some((low, high)), hands) = (always.0, hands.0) else {
            return full_framing;
        };
        // Hands that never come up leave head and shoulders alone.
        let (low, high) = hands.map_or((low, high), |bounds| (low.min(bounds.0), high.max(bounds.1)));
        Self {
            low,
            high,
            seated: true,
            ..full_framing
        }
    }

    /// Returns the space together with that of usual signing before the chest, so that pictures of most signs show one body
    /// in one size. A skeleton without arms keeps its space.
    #[must_use]
    pub fn with_usual_signing_room(self, pose: &ModelPose, anatomy: &BodyAnatomy) -> Self {
        let arm_lengths = BodySide::BOTH_SIDES.map(|side| anatomy.arm_chain(side).map(|arm| arm_length(pose, arm)));
        let longest_arm = arm_lengths.into_iter().flatten().reduce(f32::max);
        let (Some(chest), Some(longest_arm)) = (anatomy.part_joint(BodyPart::Chest), longest_arm) else {
            return self;
        };
        let middle = self.relative_joint_position(pose, chest, anatomy);
        // Hands beside the shoulders are two thirds of an arm away from the middle, and so are hands before the chest.
        let room = Vec3::new(0.66, 0.0, 0.66) * longest_arm;
        Self {
            low: self.low.min(middle - room),
            high: self.high.max(middle + room),
            ..self
        }
    }

    /// Returns the camera of a view for a picture whose width is `aspect` times its height; the hand views look at that
    /// hand in `pose`, the face view at the head. A picture too narrow for the space shows more room above the head,
    /// but no legs.
    #[must_use]
    pub fn framing_camera(
        &self,
        view: FigureView,
        aspect: f32,
        pose: &ModelPose,
        anatomy: &BodyAnatomy,
    ) -> FigureCamera {
        // A hand without fingers has no palm to look at.
        let view = match view {
            FigureView::Palm(side) if palm_axes(pose, anatomy, side).is_none() => FigureView::Hand(side),
            view => view,
        };
        let [towards, up] = view.view_axes();
        let turned_framing = Self {
            axes: self.posed_signer_axes(pose, anatomy),
            ..*self
        };
        if let FigureView::Hand(side) = view
            && let Some(target) = hand_middle(pose, anatomy, side)
        {
            // A picture narrower than high needs more height for the same breadth.
            let half_height = self.hand * 0.66 / aspect.clamp(1e-3, 1.0);
            let camera = turned_framing.place_framing_camera(target, [towards, up], half_height);
            return FigureCamera {
                // Parts before the hand, such as the other arm, are cut away by the near plane.
                near: half_height * FRAMING_EYE_DISTANCE - self.hand * 1.2,
                ..camera
            };
        }
        if let FigureView::Palm(side) = view
            && let Some(target) = hand_middle(pose, anatomy, side)
            && let Some((towards, up)) = palm_axes(pose, anatomy, side)
        {
            let half_height = self.hand * 0.6 / aspect.clamp(1e-3, 1.0);
            return FigureCamera {
                eye: target + towards * (half_height * FRAMING_EYE_DISTANCE),
                target,
                up,
                half_height,
                near: half_height * FRAMING_EYE_DISTANCE - self.hand * 1.2,
            };
        }
        if view == FigureView::Face
            && let Some((target, height)) = head_middle(pose, anatomy)
        {
            let half_height = height * 0.62 / aspect.clamp(1e-3, 1.0);
            return turned_framing.place_framing_camera(target, [towards, up], half_height);
        }
        let half = (self.high - self.low) * 0.5;
        let middle = turned_framing.axes * ((self.high + self.low) * 0.5) + based(self.carrier, self.travels, pose);
        let right = up.cross(towards).normalize_or(Vec3::X);
        let tall = half.dot(right.cross(towards).abs());
        let wide = half.dot(right.abs());
        let deep = half.dot(towards.abs());
        // The nearer half of the space looks larger, by the depth over the eye's distance.
        let room = |half: f32| half * 1.02 + deep / FRAMING_EYE_DISTANCE * 0.5;
        // The longer of both sides decides, each in its own direction.
        let half_height = room(tall.max(wide / aspect.max(1e-3)));
        let level = matches!(view, FigureView::Addressee | FigureView::Left | FigureView::Right);
        // Room that is left over goes above the head instead of below the hips.
        let raised = if self.seated && level {
            Vec3::Y * (half_height - room(tall))
        } else {
            Vec3::ZERO
        };
        turned_framing.place_framing_camera(middle + raised, [towards, up], half_height)
    }

    /// Returns the signer's left, up and forwards in a posture, as the camera sees them.
    fn posed_signer_axes(&self, pose: &ModelPose, anatomy: &BodyAnatomy) -> Mat3 {
        if self.turns {
            mean_signer_axes(std::slice::from_ref(pose), anatomy)
        } else {
            self.axes
        }
    }

    fn place_framing_camera(&self, target: Vec3, [towards, up]: [Vec3; 2], half_height: f32) -> FigureCamera {
        FigureCamera {
            eye: target + self.axes * towards.normalize_or(Vec3::Z) * (half_height * FRAMING_EYE_DISTANCE),
            target,
            up: self.axes * up,
            half_height,
            near: 0.0,
        }
    }

    /// Returns the position of a joint relative to the point that the camera follows, along the signer's axes.
    fn relative_joint_position(&self, pose: &ModelPose, joint: usize, anatomy: &BodyAnatomy) -> Vec3 {
        let from = pose.model_joint_position(joint).as_vec3() - based(self.carrier, self.travels, pose);
        self.posed_signer_axes(pose, anatomy).transpose() * from
    }

    /// Returns the signer's left, up and forwards in model space.
    #[must_use]
    pub fn framing_signer_axes(&self) -> Mat3 {
        self.axes
    }

    /// Returns the ratio of width to height of a view's visible area.
    #[must_use]
    pub fn framing_view_aspect(&self, view: FigureView) -> f32 {
        let [towards, up] = view.view_axes();
        if matches!(view, FigureView::Hand(_) | FigureView::Palm(_) | FigureView::Face) {
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
pub fn stroke_frame(clip: &Clip, anatomy: &BodyAnatomy) -> usize {
    let Some(last) = clip.clip_frame_count().checked_sub(1) else {
        return 0;
    };
    let active = active_signing_frames(clip, anatomy);
    let middle = (active.start + active.len() / 2).min(last);
    let mut up = sample_frames_evenly(active);
    // Only frames with a hand up can be the stroke.
    up.retain(|&frame| has_hand_up(&clip.model_pose(frame), anatomy));
    up.get(up.len() / 2).copied().unwrap_or(middle)
}

/// Returns the active frames of `clip`; if no hand is ever active, all usable ones.
#[must_use]
pub fn active_signing_frames(clip: &Clip, anatomy: &BodyAnatomy) -> Range<usize> {
    activity_frames(clip, anatomy).unwrap_or_else(|| ClipEnds::examine_clip_ends(clip, anatomy).sound)
}

/// Returns up to [`SAMPLED_CLIP_FRAMES`] of some frames, evenly spaced.
fn sample_frames_evenly(frames: Range<usize>) -> Vec<usize> {
    let (last, count) = (frames.len().saturating_sub(1), frames.len().min(SAMPLED_CLIP_FRAMES));
    let spaced = (0..count).map(|i| frames.start + last * i / (count - 1).max(1));
    // First and last frame are always among the samples.
    spaced.collect()
}

/// Returns whether a hand is above the lower fifth of the trunk, so that it signs and does not rest. `false` if the
/// skeleton is not a known body.
#[must_use]
pub fn has_hand_up(pose: &ModelPose, anatomy: &BodyAnatomy) -> bool {
    let (Some(hips), Some(size)) = (anatomy.part_joint(BodyPart::Hips), anatomy.anatomy_measures()) else {
        return false;
    };
    let least = pose.model_joint_position(hips).y + 0.2 * size.trunk;
    let hand_joints = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Hand(side)));
    let mut hands = hand_joints.iter().flatten();
    hands.any(|&hand| pose.model_joint_position(hand).y > least)
}

/// Returns the point that the camera follows: the body if it travels, otherwise the origin, moved with a body that is
/// elsewhere.
fn based(carrier: Option<(usize, Vec3)>, travels: bool, pose: &ModelPose) -> Vec3 {
    let Some((joint, middle)) = carrier else {
        return Vec3::ZERO;
    };
    let joint_place = pose.model_joint_position(joint).as_vec3();
    match joint_place - middle {
        _ if travels => joint_place,
        // A body far from its place in odd frames is followed there, so that it is not lost from view.
        off if off.length() > MAX_EXCLUDED_TRAVEL_METRES => off,
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

fn find_travel(poses: &[ModelPose], anatomy: &BodyAnatomy) -> Option<BodyTravel> {
    let parts = [BodyPart::Hips, BodyPart::Spine, BodyPart::Chest];
    // Hips first: the chest moves in signing itself.
    let joint = parts.iter().find_map(|&part| anatomy.part_joint(part))?;
    let mut bounds = FramingBounds::default();
    for pose in poses {
        bounds.include_bounds_point(pose.model_joint_position(joint).as_vec3());
    }
    let (low, high) = bounds.0?;
    Some(BodyTravel {
        joint,
        middle: (low + high) * 0.5,
        reach: (high - low).length() * 0.5,
    })
}

/// Returns postures of a clip, evenly spaced if there are many, without odd first and last frames.
fn sample_clip_poses(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Vec<ModelPose>> {
    clip.clip_frame_count().checked_sub(1)?;
    let frames = sample_frames_evenly(ClipEnds::examine_clip_ends(clip, anatomy).sound).into_iter();
    Some(frames.map(|frame| clip.model_pose(frame)).collect())
}

/// Returns the middle of a hand: between wrist and the joints of the fingers.
fn hand_middle(pose: &ModelPose, anatomy: &BodyAnatomy, side: BodySide) -> Option<Vec3> {
    let wrist = anatomy.part_joint(BodyPart::Hand(side))?;
    let fingers = anatomy.possible_fingers(side);
    let wrist = pose.model_joint_position(wrist).as_vec3();
    if fingers.is_empty() {
        return Some(wrist);
    }
    let sum: Vec3 = fingers
        .iter()
        .map(|&joint| pose.model_joint_position(joint).as_vec3())
        .sum();
    // The middle lies nearer to the fingers, which say more than the wrist does.
    Some(wrist.lerp(sum / fingers.len() as f32, 0.85))
}

/// Returns the direction out of a palm, a little from the thumb's side and from above, and the fingers' direction.
fn palm_axes(pose: &ModelPose, anatomy: &BodyAnatomy, side: BodySide) -> Option<(Vec3, Vec3)> {
    let palm = anatomy.palm_normal(side, pose)?.as_vec3();
    let along = anatomy.hand_direction(side, pose)?.as_vec3();
    let thumb = along.cross(palm) * -side.side_sign() as f32;
    // Straight into the palm fingers hide their bends, so the eye is a little aside and above.
    let towards = (palm + thumb * 0.42 + along * 0.3).try_normalize()?;
    let up = (along - towards * along.dot(towards)).try_normalize()?;
    Some((towards, up))
}

/// Returns the middle of the head and its height, if both are known.
fn head_middle(pose: &ModelPose, anatomy: &BodyAnatomy) -> Option<(Vec3, f32)> {
    let joint = anatomy.part_joint(BodyPart::Head)?;
    let measures = anatomy.anatomy_measures()?;
    let [_, up, _] = anatomy.head_axes(pose)?;
    let middle = up * (measures.head_top - measures.head * 0.5);
    let target = pose.model_joint_position(joint) + middle;
    Some((target.as_vec3(), measures.head as f32))
}

/// Returns the space that a head needs around its joint.
fn head_clearance(anatomy: &BodyAnatomy, size: f32) -> Vec3 {
    let head_top = anatomy
        .anatomy_measures()
        .map_or(0.0, |measures| measures.head_top as f32);
    // A head of odd measures does not make the picture higher than heads are.
    let top = head_top.clamp(0.19 * size, 0.36 * size) + 0.035 * size;
    Vec3::new(0.1 * size, top, 0.14 * size)
}

fn arm_length(pose: &ModelPose, arm: chereme_motion::ArmChain) -> f32 {
    let joint_place = |joint: usize| pose.model_joint_position(joint);
    let upper = (joint_place(arm.forearm) - joint_place(arm.upper)).length();
    (upper + (joint_place(arm.hand) - joint_place(arm.forearm)).length()) as f32
}

/// Returns the signer's left, up and forwards over all postures; up is that of model space.
fn mean_signer_axes(poses: &[ModelPose], anatomy: &BodyAnatomy) -> Mat3 {
    let mut left = Vec3::ZERO;
    for part in [BodyPart::Thigh as fn(BodySide) -> BodyPart, BodyPart::UpperArm] {
        if let [Some(r), Some(l)] = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(part(side))) {
            let across = |pose: &ModelPose| (pose.model_joint_position(l) - pose.model_joint_position(r)).as_vec3();
            left += poses.iter().map(across).sum::<Vec3>() / poses.len() as f32;
        }
    }
    // Leaning is part of signing: up stays that of the room.
    let flat = Vec3::new(left.x, 0.0, left.z).normalize_or(Vec3::X);
    Mat3::from_cols(flat, Vec3::Y, flat.cross(Vec3::Y))
}

#[derive(Default)]
struct FramingBounds(Option<(Vec3, Vec3)>);

impl FramingBounds {
    fn include_point_margin(&mut self, at: Vec3, margin: Vec3) {
        self.include_bounds_point(at - margin);
        self.include_bounds_point(at + margin);
    }

    fn include_bounds_point(&mut self, at: Vec3) {
        let (low, high) = self.0.unwrap_or((at, at));
        self.0 = Some((low.min(at), high.max(at)));
    }
}
