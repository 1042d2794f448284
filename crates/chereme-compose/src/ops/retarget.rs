//! Transfers movement from one skeleton to another, part by part, through the anatomy.

use std::sync::Arc;

use chereme_motion::glam::{DMat3, DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, FrameRate, JointChannel, LocalPose, ModelPose, Skeleton};

use crate::contact::{self, ContactEffect, ContactsToKeep};
use crate::error::StepError;
use crate::outcome::TouchReport;
use crate::recipe_settings::ArmSolverMethod;
use crate::work::{JointColumns, WorkingClip};
use crate::{arm, body};

/// Movement on another skeleton, and its contacts.
pub(crate) struct TouchingMovement {
    pub(crate) work: WorkingClip,
    /// The number of contacts before.
    pub(crate) contacts: usize,
    /// Those that were kept by moving a wrist.
    pub(crate) kept: Vec<String>,
    /// Those that were lost.
    pub(crate) lost: Vec<String>,
    pub(crate) touches: Vec<TouchReport>,
    /// Those that were kept by moving a wrist far.
    pub(crate) warnings: Vec<String>,
}

/// The body that receives movement.
pub(crate) struct TargetBody<'a> {
    pub(crate) skeleton: &'a Arc<Skeleton>,
    pub(crate) anatomy: &'a Arc<BodyAnatomy>,
    /// The posture of joints that the movement says nothing about.
    pub(crate) idle: LocalPose,
}

impl<'a> TargetBody<'a> {
    /// Returns the body with its rest pose for idle joints.
    pub(crate) fn at_rest(skeleton: &'a Arc<Skeleton>, anatomy: &'a Arc<BodyAnatomy>) -> Self {
        Self {
            skeleton,
            anatomy,
            idle: skeleton.rest_pose(),
        }
    }
}

/// Transfers movement to another skeleton, and moves wrists a little, so that hands touch what they touched.
pub(crate) fn retarget_with_contacts(
    work: &WorkingClip,
    onto: &TargetBody<'_>,
    operator: &str,
) -> Result<TouchingMovement, StepError> {
    let touched = contact::find_contacts(work);
    let mut out = retarget_movement(work, onto)?;
    let mut touched = touched.transfer_contacts(&out);
    let keep = ContactsToKeep::All(&BodySide::BOTH_SIDES);
    let kept = contact::restore_contacts(&mut out, &mut touched, keep, operator);
    Ok(TouchingMovement {
        contacts: touched.count_contacts(),
        touches: contact::report_touches(&touched, &out),
        lost: contact::describe_lost_contacts(&touched, &out, ContactEffect::Same),
        warnings: contact::long_repairs(&touched, operator),
        work: out,
        kept,
    })
}

/// Transfers movement to another skeleton.
///
/// Each part has the directions of its counterpart in model space: its bone and a direction across it (that of the
/// elbow, out of the palm, forward from the body) point where the counterpart's point, whatever the rest poses. Wrists
/// keep their distance from the shoulders' middle in arms' lengths, fingers keep their joint angles and thumbs the
/// directions of their bones, the root's path is scaled by the legs' length, and joints that have no counterpart stay in
/// their idle posture.
pub(crate) fn retarget_movement(work: &WorkingClip, onto: &TargetBody<'_>) -> Result<WorkingClip, StepError> {
    let (skeleton, anatomy) = (onto.skeleton, onto.anatomy);
    for side in BodySide::BOTH_SIDES {
        if anatomy.arm_chain(side).is_some() && work.anatomy.arm_chain(side).is_none() {
            return Err(StepError::NoArm(side));
        }
    }
    let mut out = WorkingClip {
        skeleton: Arc::clone(skeleton),
        anatomy: Arc::clone(anatomy),
        channels: skeleton
            .skeleton_joints()
            .iter()
            .zip(&onto.idle.translations)
            .map(|(joint, &place)| JointChannel {
                rotations: vec![joint.rest; work.frames],
                translations: (place != joint.offset).then(|| vec![place; work.frames]),
            })
            .collect(),
        ..work.clone()
    };
    let pairs = counterpart_joints(work, skeleton, anatomy);
    let placed = |part: BodyPart| work.anatomy.part_joint(next_part(part)?);
    let columns = JointColumns::joint_columns_of(
        work,
        pairs
            .iter()
            .flatten()
            .flat_map(|&(from, part)| [Some(from), placed(part)])
            .flatten()
            .chain([0]),
    );
    let [there, here] =
        [(&work.skeleton, &work.anatomy), (skeleton, anatomy)].map(|(skeleton, anatomy)| ComparedBody {
            skeleton,
            anatomy,
            rest: skeleton.rest_model_pose(),
        });
    let mut model: Vec<Vec<DQuat>> = Vec::with_capacity(skeleton.len());
    for (joint, pair) in pairs.iter().enumerate() {
        // Parents come first, so that their rotations are known here.
        let above = skeleton.joint_parent(joint).map(|parent| &model[parent]);
        let parent = |frame: usize| above.map_or(DQuat::IDENTITY, |column| column[frame]);
        let idle = onto.idle.rotations[joint];
        let column: Vec<DQuat> = match *pair {
            Some((from, part)) => {
                // The turn away from rest carries over; the rest poses themselves differ between the bodies.
                let back = there.compared_part_posture(part).model_joint_rotation(from).inverse();
                let onto = rest_pose_rotation(&there, &here, part)
                    * here.compared_part_posture(part).model_joint_rotation(joint);
                // A file that places the next joint in every frame decides thereby where the bone points.
                let next = placed(part).filter(|&next| work.channels[next].translations.is_some());
                let (posture, starts) = (there.compared_part_posture(part), columns.joint_positions(from));
                let joint_rotations = columns.joint_rotations(from).iter().enumerate();
                let turned = joint_rotations.map(|(frame, turned)| {
                    let off = next.and_then(|next| {
                        let bone = posture.model_joint_position(next) - posture.model_joint_position(from);
                        let turned = (*turned * back * bone).try_normalize()?;
                        let placed = columns.joint_positions(next)[frame] - starts[frame];
                        Some(DQuat::from_rotation_arc(turned, placed.try_normalize()?))
                    });
                    (off.unwrap_or_default() * *turned * back * onto).normalize()
                });
                turned.collect()
            }
            None => (0..work.frames).map(|frame| parent(frame) * idle).collect(),
        };
        let local = (0..work.frames).map(|frame| (parent(frame).inverse() * column[frame]).normalize());
        let local: Vec<DQuat> = local.collect();
        out.channels[joint].rotations = local;
        model.push(column);
    }
    retarget_root(work, &mut out);
    retarget_fingers(work, &mut out);
    retarget_wrists(work, &mut out);
    Ok(out)
}

/// Returns for each joint of the new skeleton its counterpart and part; `None` for fingers.
fn counterpart_joints(
    work: &WorkingClip,
    skeleton: &Skeleton,
    anatomy: &BodyAnatomy,
) -> Vec<Option<(usize, BodyPart)>> {
    let mut pairs = vec![None; skeleton.len()];
    for (part, joint, _) in anatomy.found_parts() {
        if !matches!(part, BodyPart::Thumb(..) | BodyPart::Finger(..))
            && let Some(from) = work.anatomy.part_joint(part)
        {
            pairs[joint] = Some((from, part));
        }
    }
    pairs
}

/// Returns the part in which the bone of a limb's part ends.
fn next_part(part: BodyPart) -> Option<BodyPart> {
    match part {
        BodyPart::Clavicle(side) => Some(BodyPart::UpperArm(side)),
        BodyPart::UpperArm(side) => Some(BodyPart::Forearm(side)),
        BodyPart::Forearm(side) => Some(BodyPart::Hand(side)),
        BodyPart::Thigh(side) => Some(BodyPart::Shin(side)),
        BodyPart::Shin(side) => Some(BodyPart::Foot(side)),
        BodyPart::Foot(side) => Some(BodyPart::Toes(side)),
        _ => None,
    }
}

/// The directions of a part in a body's posture, in model space: along its bone, and one across it.
struct PartAxes {
    along: DVec3,
    across: Option<DVec3>,
}

impl PartAxes {
    /// Returns the axes of a limb's part; `None` for a part of the trunk, which uses the body's axes.
    fn limb_part_axes(body: &ComparedBody<'_>, part: BodyPart) -> Option<Self> {
        let (anatomy, model) = (body.anatomy, body.compared_part_posture(part));
        let joint_position = |part| anatomy.part_joint(part).map(|joint| model.model_joint_position(joint));
        let bone = || (joint_position(next_part(part)?)? - joint_position(part)?).try_normalize();
        let trunk = anatomy.body_frame(model)?;
        let elbow = |side| {
            let upper = anatomy.part_joint(BodyPart::UpperArm(side))?;
            Some(model.model_joint_rotation(upper) * anatomy.elbow_direction(side)?)
        };
        let tip = || {
            let joint = anatomy.part_joint(part)?;
            (model.model_joint_rotation(joint) * last_bone(body.skeleton, anatomy, joint)?).try_normalize()
        };
        let (along, across) = match part {
            BodyPart::Clavicle(_) => (bone()?, Some(trunk.up)),
            BodyPart::UpperArm(side) => (bone()?, elbow(side)),
            BodyPart::Forearm(side) => {
                let along = bone()?;
                let upper = (joint_position(part)? - joint_position(BodyPart::UpperArm(side))?).try_normalize();
                // A forearm has the axis of its elbow, carried over by the bend between the two bones.
                let carried = upper.map(|upper| DQuat::from_rotation_arc(upper, along));
                (along, elbow(side).zip(carried).map(|(out, turn)| turn * out))
            }
            BodyPart::Hand(side) => {
                let palm = anatomy.palm_normal(side, model);
                (anatomy.hand_direction(side, model)?, palm)
            }
            BodyPart::Thigh(_) | BodyPart::Shin(_) => (bone()?, Some(trunk.forward)),
            BodyPart::Foot(_) => {
                let along = bone().or_else(tip);
                (along.unwrap_or(trunk.forward), Some(trunk.up))
            }
            BodyPart::Toes(_) => (tip().unwrap_or(trunk.forward), Some(trunk.up)),
            _ => return None,
        };
        Some(Self { along, across })
    }

    fn part_axes_basis(&self) -> Option<DQuat> {
        let across = self.across?.reject_from_normalized(self.along).try_normalize()?;
        let columns = DMat3::from_cols(self.along, across, self.along.cross(across));
        Some(DQuat::from_mat3(&columns).normalize())
    }
}

/// Returns the end of a limb's last bone in the space of its joint: the tip, else the only joint that hangs on it.
fn last_bone(skeleton: &Skeleton, anatomy: &BodyAnatomy, joint: usize) -> Option<DVec3> {
    let below = match skeleton.joint_children(joint) {
        [child] => Some(skeleton.joint_at(*child).offset),
        _ => None,
    };
    anatomy.joint_tip(skeleton, joint).or(below)
}

/// One of the two bodies.
struct ComparedBody<'a> {
    skeleton: &'a Skeleton,
    anatomy: &'a BodyAnatomy,
    rest: ModelPose,
}

impl ComparedBody<'_> {
    /// Returns the posture in which a part is compared with that of another body: at rest, but standing for the legs.
    /// Where a file keeps every bone along one axis, legs point up at rest, and nothing shows which way feet point.
    fn compared_part_posture(&self, part: BodyPart) -> &ModelPose {
        match part {
            BodyPart::Thigh(_) | BodyPart::Shin(_) | BodyPart::Foot(_) | BodyPart::Toes(_) => {
                self.anatomy.measured_pose()
            }
            _ => &self.rest,
        }
    }

    /// Returns the trunk's rotation at rest, with up along the spine because shoulders may be drawn forward.
    fn trunk_rest_rotation(&self) -> Option<DQuat> {
        let part_position = |part| {
            self.anatomy
                .part_joint(part)
                .map(|joint| self.rest.model_joint_position(joint))
        };
        let up = (part_position(BodyPart::Neck).or(part_position(BodyPart::Head))? - part_position(BodyPart::Hips)?)
            .try_normalize()?;
        let body_left = self.anatomy.body_frame(&self.rest)?.left;
        let left = body_left.reject_from_normalized(up).try_normalize()?;
        let columns = DMat3::from_cols(left, up, left.cross(up));
        Some(DQuat::from_mat3(&columns).normalize())
    }
}

/// Returns the rotation from a part's rest pose on the new body to that on the old one.
fn rest_pose_rotation(from: &ComparedBody<'_>, to: &ComparedBody<'_>, part: BodyPart) -> DQuat {
    let bodies = match (from.trunk_rest_rotation(), to.trunk_rest_rotation()) {
        (Some(from), Some(to)) => from * to.inverse(),
        _ => DQuat::IDENTITY,
    };
    let axes = |body: &ComparedBody<'_>| PartAxes::limb_part_axes(body, part);
    let (Some(there), Some(here)) = (axes(from), axes(to)) else {
        return bodies;
    };
    // Without a direction across, only the bone is certain, and the trunk's turn decides the rest.
    match (there.part_axes_basis(), here.part_axes_basis()) {
        (Some(there), Some(here)) => there * here.inverse(),
        _ => DQuat::from_rotation_arc((bodies * here.along).normalize(), there.along) * bodies,
    }
}

fn retarget_root(work: &WorkingClip, out: &mut WorkingClip) {
    let height = |skeleton: &Skeleton, anatomy: &BodyAnatomy| {
        let model = skeleton.rest_model_pose();
        let hips = anatomy.part_joint(BodyPart::Hips).unwrap_or(0);
        let foot = anatomy
            .part_joint(BodyPart::Foot(BodySide::Left))
            .or(anatomy.part_joint(BodyPart::Foot(BodySide::Right)));
        foot.map(|foot| model.model_joint_position(hips).y - model.model_joint_position(foot).y)
    };
    // Legs that do not hang down at rest, because every bone lies along one axis, are measured by their length.
    let size = |work: &WorkingClip| {
        let measures = work.anatomy.anatomy_measures()?;
        let leg = leg_length(&work.skeleton, &work.anatomy);
        // A leg is a little less than half of the stature.
        Some(leg.unwrap_or(measures.stature * 0.49))
    };
    let size_pair = size(work).zip(size(out)).filter(|sizes| sizes.0 > 1e-3);
    let sizes = size_pair.map_or(1.0, |(from, to)| to / from);
    let height_pair = height(&work.skeleton, &work.anatomy).zip(height(&out.skeleton, &out.anatomy));
    let heights = height_pair.filter(|heights| heights.0 > 1e-3);
    let scale = heights.map_or(sizes, |(from, to)| to / from);
    let agree = (0.75..1.35).contains(&(scale / sizes));
    let scale = if agree { scale } else { sizes };
    // The hips' height above the floor is scaled, wherever the roots of the two skeletons are.
    let hips = |work: &WorkingClip| work.anatomy.part_joint(BodyPart::Hips).unwrap_or(0);
    let (from, to) = (hips(work), hips(out));
    let (there, here) = (
        JointColumns::joint_columns_of(work, [from]),
        JointColumns::joint_columns_of(out, [to]),
    );
    let pairs = there.joint_positions(from).iter().zip(here.joint_positions(to));
    let offset = out.skeleton.joint_at(0).offset;
    let places: Vec<DVec3> = pairs.map(|(&at, &now)| offset + (at * scale - now)).collect();
    out.channels[0].translations = Some(places);
}

/// Returns the length of a leg's bones from hip to ankle.
fn leg_length(skeleton: &Skeleton, anatomy: &BodyAnatomy) -> Option<f64> {
    BodySide::BOTH_SIDES.into_iter().find_map(|side| {
        let (foot, thigh) = (
            anatomy.part_joint(BodyPart::Foot(side))?,
            anatomy.part_joint(BodyPart::Thigh(side))?,
        );
        let bones = skeleton.joint_ancestors(foot).take_while(|&joint| joint != thigh);
        let length: f64 = bones.map(|j| skeleton.joint_at(j).offset.length()).sum();
        (length > 1e-3).then_some(length)
    })
}

/// Moves the wrists to the same position relative to the shoulders' middle, in arms' lengths, so that hands that meet
/// still meet on wider shoulders.
fn retarget_wrists(work: &WorkingClip, out: &mut WorkingClip) {
    let arms = |work: &WorkingClip| BodySide::BOTH_SIDES.map(|side| work.anatomy.arm_chain(side));
    let ([Some(r), Some(l)], [Some(right), Some(left)]) = (arms(work), arms(out)) else {
        return;
    };
    let length = |work: &WorkingClip| body::arm_length(work, BodySide::Right).filter(|length| *length > 1e-3);
    let Some(ratio) = length(out).zip(length(work)).map(|(to, from)| to / from) else {
        return;
    };
    let there = JointColumns::joint_columns_of(work, [r.hand, l.hand]);
    // The shoulders before either arm moves: a collar bone that helps one arm must not shift the other.
    let here = JointColumns::joint_columns_of(out, [right.hand, left.hand]);
    let middle = |columns: &JointColumns, a: usize, b: usize, frame: usize| {
        (columns.joint_positions(a)[frame] + columns.joint_positions(b)[frame]) / 2.0
    };
    for (side, hand) in [(BodySide::Right, r.hand), (BodySide::Left, l.hand)] {
        let target = |frame: usize| {
            let offset = there.joint_positions(hand)[frame] - middle(&there, r.upper, l.upper, frame);
            middle(&here, right.upper, left.upper, frame) + offset * ratio
        };
        let targets: Vec<DVec3> = (0..work.frames).map(target).collect();
        arm::move_wrist(out, side, &here, &targets, None, ArmSolverMethod::Analytic);
    }
}

fn retarget_fingers(work: &WorkingClip, out: &mut WorkingClip) {
    for side in BodySide::BOTH_SIDES {
        let (here, there) = (work.anatomy.finger_joints(side), out.anatomy.finger_joints(side));
        if here.is_empty() || there.is_empty() {
            continue;
        }
        let mut source: LocalPose = work.local_pose_at(0);
        let mut target = out.local_pose_at(0);
        for frame in 0..work.frames {
            for &joint in &here {
                source.rotations[joint] = work.channels[joint].rotations[frame];
            }
            let angles = work.anatomy.hand_angles(&work.skeleton, side, &source);
            let Some(angles) = angles else { break };
            if !out.anatomy.set_hand_angles(&out.skeleton, side, &angles, &mut target) {
                break;
            }
            for &joint in &there {
                out.channels[joint].rotations[frame] = target.rotations[joint];
            }
        }
        retarget_thumb(work, out, side);
    }
}

/// A joint of a digit, and the joint in which its bone ends if that hangs on it directly.
#[derive(Clone, Copy)]
struct DigitBone {
    joint: usize,
    next: Option<usize>,
}

impl DigitBone {
    fn thumb_digit_bones(work: &WorkingClip, side: BodySide) -> [Option<Self>; 3] {
        let thumb_joint = |n: u8| work.anatomy.part_joint(BodyPart::Thumb(side, n));
        [0, 1, 2].map(|n| {
            let joint = thumb_joint(n)?;
            let next_joint = (n + 1..3).find_map(thumb_joint);
            let next = next_joint.filter(|&next| work.skeleton.joint_parent(next) == Some(joint));
            Some(Self { joint, next })
        })
    }

    /// Returns the direction of the bone in the space of its joint.
    fn digit_bone_direction(&self, work: &WorkingClip, frame: usize) -> Option<DVec3> {
        let end = match self.next {
            Some(next) => Some(work.joint_translation_at(next, frame)),
            None => last_bone(&work.skeleton, &work.anatomy, self.joint),
        };
        end?.try_normalize()
    }
}

/// Turns the bones of a thumb to the directions that they have in the source: where two skeletons keep a thumb
/// differently at rest, equal angles do not turn it about equal axes.
fn retarget_thumb(work: &WorkingClip, out: &mut WorkingClip, side: BodySide) {
    let from = DigitBone::thumb_digit_bones(work, side);
    let there = JointColumns::joint_columns_of(work, from.iter().flatten().map(|bone| bone.joint));
    for (from, to) in from.into_iter().zip(DigitBone::thumb_digit_bones(out, side)) {
        let (Some(from), Some(to)) = (from, to) else {
            continue;
        };
        let Some(parent) = out.skeleton.joint_parent(to.joint) else {
            continue;
        };
        // Again for each bone, because the bone before it has turned.
        let here = JointColumns::joint_columns_of(out, [parent]);
        for frame in 0..work.frames {
            let wanted = from.digit_bone_direction(work, frame);
            let Some((wanted, bone)) = wanted.zip(to.digit_bone_direction(out, frame)) else {
                break;
            };
            let above = here.joint_rotations(parent)[frame];
            let part_rotation = above * out.channels[to.joint].rotations[frame];
            let wanted = there.joint_rotations(from.joint)[frame] * wanted;
            let turn = DQuat::from_rotation_arc((part_rotation * bone).normalize(), wanted.normalize());
            out.channels[to.joint].rotations[frame] = (above.inverse() * turn * part_rotation).normalize();
        }
    }
}

/// Brings movement to another frame rate.
pub(crate) fn resample_work_rate(work: &mut WorkingClip, rate: FrameRate) {
    if work.rate == rate || work.frames == 0 {
        return;
    }
    let last = work.rate.frame_start_instant(work.frames - 1);
    // A frame that starts after the last old one has nothing to show.
    let frames =
        rate.nearest_frame_at(last) + usize::from(rate.frame_start_instant(rate.nearest_frame_at(last)) <= last);
    let from = work.rate.per_second();
    let sample_positions: Vec<f64> = (0..frames)
        .map(|f| rate.frame_start_instant(f).instant_seconds() * from)
        .collect();
    work.resample_channels(&sample_positions);
    work.rate = rate;
}
