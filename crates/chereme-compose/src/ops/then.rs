//! `A then B`: joins one piece of movement to another on the first one's body.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, InterpolationKind, JointChannel, ModelPose};
use chereme_sign::SignComponent;

use crate::course::TransitionCourses;
use crate::error::StepError;
use crate::ops::cut;
use crate::ops::join::{self, ChannelCut, MovementSeam};
use crate::ops::retarget::{self, TargetBody};
use crate::outcome::{GeneratedNote, NoteSubject};
use crate::speed::{self, StepSpeeds};
use crate::stroke;
use crate::units::RecipeSeconds;
use crate::work::{JointColumns, JointGroup, WorkingClip};

/// The time at the end of one sign and the start of the next in which cuts are searched for, in seconds; never more
/// than 30 % of either.
const CUT_SEARCH_WINDOW_S: f64 = 0.3;
/// The least and the greatest time of a transition in seconds, and a wrist's mean speed in one, in metres per second.
const TRANSITION_TIME_RANGE: (f64, f64, f64) = (0.15, 0.6, 1.0);
/// The mean speed of hips and feet in a transition in metres per second, which at the peak of a sigmoid's course is that
/// which is not warned of, and the greatest time that they are given for it, in seconds.
const STANCE_TIME: (f64, f64) = (0.2, 1.0);

/// Appends `next` to `work`; returns a description of the effects and of the join.
pub(crate) fn append_next_work(
    work: &mut WorkingClip,
    next: WorkingClip,
    time: Option<RecipeSeconds>,
    courses: &TransitionCourses,
    operator: &str,
) -> Result<join::JoinOutcome, StepError> {
    let (mut did, mut contacts) = (Vec::new(), Vec::new());
    let (mut warnings, mut repairs) = (Vec::new(), Vec::new());
    let mut next = match on_same_body(work, &next) {
        Some(next) => next,
        None => {
            did.push("the second signer's movement is put on the first one's body".to_owned());
            // Only what the other body adds to the speeds is worth a warning.
            let before = StepSpeeds::between_frames(&next);
            let onto = TargetBody {
                skeleton: &work.skeleton,
                anatomy: &work.anatomy,
                idle: work.local_pose_at(work.frames - 1),
            };
            let done = retarget::retarget_with_contacts(&next, &onto, operator)?;
            did.extend(done.kept);
            contacts = done.lost;
            repairs = done.warnings;
            let (before, after) = StepSpeeds::between_frames(&done.work).most_added(&before);
            warnings.extend(speed::check_added(before, after)?);
            done.work
        }
    };
    // Frames of both can be compared only at one rate.
    retarget::resample_work_rate(&mut next, work.rate);
    let ends = without_rest(work, &mut next)?;
    face_alike(work, &mut next);
    let seam = seam(work, &next, time, &ends);
    if ends.returned > 0 {
        did.push("the first sign's return to rest is left out".to_owned());
    }
    if ends.approached > 0 {
        did.push("the second sign's movement from rest is left out".to_owned());
    }
    let held_sides: Vec<BodySide> = BodySide::BOTH_SIDES
        .into_iter()
        .filter(|&side| is_hand_idle_next(work, &next, side))
        .collect();
    for &side in &held_sides {
        let leave = seam.hands[usize::from(side == BodySide::Left)].leave;
        hold_idle_hand(work, &mut next, side, leave, ends.until);
        did.push(format!(
            "the {} hand stays where it is: the second sign does not use it",
            side.body_side_name()
        ));
    }
    for (side, cut) in BodySide::BOTH_SIDES.into_iter().zip(seam.hands) {
        let frames = seam.offset + cut.enter - cut.leave - 1;
        did.push(format!(
            "{} hand: leaves {} frames before the end, enters at frame {}, {} frames between",
            side.body_side_name(),
            ends.returned + work.frames - 1 - cut.leave,
            ends.approached + cut.enter,
            frames
        ));
    }
    let cuts = || seam.hands.into_iter().chain([seam.body]);
    let leaves = cuts().map(|cut| cut.leave);
    let enters = cuts().map(|cut| cut.enter);
    let (latest, earliest) = (
        leaves.clone().fold(0, usize::max),
        enters.clone().fold(next.frames, usize::min),
    );
    // A join may be as fast as the signs on either side of it.
    let pieces = speed::faster_of_both(
        StepSpeeds::between_frames(work).peaks_over(0..latest),
        StepSpeeds::between_frames(&next).peaks_over(earliest..next.frames),
    );
    let joins = join::join_movements(work, next, &seam, courses, operator)?;
    let between = leaves.fold(latest, usize::min)..seam.offset + enters.fold(earliest, usize::max);
    let speeds = StepSpeeds::between_frames(work);
    did.extend(speeds.between_pieces(between.clone()));
    warnings.extend(speed::check_added(pieces, speeds.peaks_over(between))?);
    let warnings = warnings.iter().map(|added| format!("{operator}: {added}"));
    Ok(join::JoinOutcome {
        did,
        joins,
        contacts,
        warnings: repairs.into_iter().chain(warnings).collect(),
    })
}

/// The ends of two signs that were cut off, and the frames beside them in which a hand may leave or enter.
#[derive(Default)]
struct CutSignEnds {
    /// The frames that the end of the first sign has lost, and the start of the second.
    returned: usize,
    approached: usize,
    /// The last frames of the first sign that follow its last phase, if it goes back to rest.
    after: Option<usize>,
    /// The first frames of the second sign that precede its first phase, if it comes from rest.
    before: Option<usize>,
    /// The frame of the second sign at which its hands go back to rest; its end if they do not.
    until: usize,
}

/// Cuts the first sign's return to rest and the second's approach from rest off, except for the frames in which a hand
/// may leave or enter. A sign without rest, or without known phases, stays as it is.
fn without_rest(first: &mut WorkingClip, second: &mut WorkingClip) -> Result<CutSignEnds, StepError> {
    let window = (CUT_SEARCH_WINDOW_S / first.rate.frame_time()).round() as usize;
    let (one, other) = (stroke::signed_frame_range(first)?, stroke::signed_frame_range(second)?);
    let mut ends = CutSignEnds {
        until: other.end,
        ..CutSignEnds::default()
    };
    if one.end < first.frames {
        let after = window.min(first.frames - one.end);
        ends.after = Some(after);
        ends.returned = first.frames - one.end - after;
        cut::keep_quietly(first, 0..one.end + after);
    }
    if other.start > 0 {
        let before = window.min(other.start);
        ends.before = Some(before);
        ends.approached = other.start - before;
        ends.until -= ends.approached;
        cut::keep_quietly(second, ends.approached..second.frames);
    }
    Ok(ends)
}

/// The greatest difference in length between the bones of one signer in two recordings, as a share of the bone.
const SAME_LENGTH: f64 = 0.1;
/// The greatest angle between these bones, or between the rest poses of a joint, in radians: of digits, which are solved
/// from few markers, and of all else, so that a foot is less than 2 cm beside its place.
const SAME_ANGLE: [f64; 2] = [0.1, 0.02];

/// Returns the second movement on the first one's skeleton, with the same local rotations, if both skeletons are the
/// same body: joints of equal names, parents and offsets, except for offsets of joints whose positions both movements
/// give. The bones of one signer may differ a little, and joints that are no parts of the body, such as markers, may be
/// missing: they stay as they are at the end of the first.
pub(crate) fn on_same_body(first: &WorkingClip, second: &WorkingClip) -> Option<WorkingClip> {
    let (a, b) = (&first.skeleton, &second.skeleton);
    let on_first = |channels: Vec<JointChannel>| WorkingClip {
        skeleton: Arc::clone(a),
        anatomy: Arc::clone(&first.anatomy),
        channels,
        ..second.clone()
    };
    if a == b {
        return Some(on_first(second.channels.clone()));
    }
    let same_signer = first.signer.is_some() && first.signer == second.signer;
    if a.len() != b.len() && !same_signer {
        return None;
    }
    let numbered_joints = b.skeleton_joints().iter().enumerate();
    let names: BTreeMap<&str, usize> = numbered_joints.map(|(m, joint)| (joint.name.as_str(), m)).collect();
    let hips = first.anatomy.part_joint(BodyPart::Hips).unwrap_or(0);
    let end = first.local_pose_at(first.frames - 1);
    let constant = |place: DVec3, offset: DVec3| {
        let moved = place != offset;
        moved.then(|| vec![place; second.frames])
    };
    let mut counterparts: Vec<Option<usize>> = Vec::with_capacity(a.len());
    let mut channels = Vec::with_capacity(a.len());
    for (n, joint) in a.skeleton_joints().iter().enumerate() {
        let place = end.translations[n];
        let Some(&m) = names.get(joint.name.as_str()) else {
            if !same_signer || first.anatomy.part_of(n).is_some() {
                return None;
            }
            counterparts.push(None);
            channels.push(JointChannel {
                rotations: vec![end.rotations[n]; second.frames],
                translations: constant(place, joint.offset),
            });
            continue;
        };
        let other = b.joint_at(m);
        // Equal names in another hierarchy belong to another body.
        if joint.parent.map(|parent| counterparts[parent]) != other.parent.map(Some) {
            return None;
        }
        counterparts.push(Some(m));
        let mut channel = second.channels[m].clone();
        // Where both movements place a joint in every frame, the files' offsets say nothing.
        let given = first.channels[n].translations.is_some() && channel.translations.is_some();
        if joint.rest != other.rest || !(given || joint.offset == other.offset) {
            let bone = second.joint_translation_at(m, 0);
            let digit = matches!(
                first.anatomy.part_of(n),
                Some(BodyPart::Thumb(..) | BodyPart::Finger(..))
            );
            let most = SAME_ANGLE[usize::from(!digit)];
            let [one, two] = [place, bone].map(DVec3::normalize_or_zero);
            let longer = (place.length() - bone.length()).abs();
            let alike_bones = longer <= SAME_LENGTH * place.length() && one.distance(two) < most;
            // Joints above the hips only carry the body, wherever they are.
            let leads = a.joint_ancestors(hips).any(|above| above == n);
            let alike = joint.rest.angle_between(other.rest) < most && (leads || alike_bones);
            if !same_signer || !alike {
                return None;
            }
            channel.translations = if leads {
                let places = (0..second.frames).map(|frame| second.joint_translation_at(m, frame));
                Some(places.collect())
            } else {
                constant(place, joint.offset)
            };
        }
        channels.push(channel);
    }
    Some(on_first(channels))
}

/// Returns the spot on which a body stands in a posture, and the direction that it faces there if its joints show it.
///
/// The spot lies between the feet, at the usual height of the lower one. Without feet it is the place of the hips, of
/// the trunk, or of any part that there is.
fn standing_spot(work: &WorkingClip, frame: usize) -> (DVec3, Option<DVec3>) {
    let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(frame));
    let pair = |part: fn(BodySide) -> BodyPart| {
        let joints = BodySide::BOTH_SIDES.map(|side| work.anatomy.part_joint(part(side)));
        Some((joints[0]?, joints[1]?))
    };
    let body = work.anatomy.body_frame(&model);
    let thighs = pair(BodyPart::Thigh).and_then(|(right, left)| {
        let left = model.model_joint_position(left) - model.model_joint_position(right);
        // Left across up is forward.
        left.cross(DVec3::Y).try_normalize()
    });
    // Thighs show where a body faces even if its shoulders are turned.
    let forward = thighs.or(body.map(|body| body.forward));
    if let Some((right, left)) = pair(BodyPart::Foot) {
        let columns = JointColumns::joint_columns_of(work, [right, left]);
        let [a, b] = [right, left].map(|foot| columns.joint_positions(foot));
        let mut heights: Vec<f64> = a.iter().zip(b).map(|(a, b)| a.y.min(b.y)).collect();
        heights.sort_by(f64::total_cmp);
        let between = a[frame].midpoint(b[frame]);
        return (between.with_y(heights[heights.len() / 2]), forward);
    }
    let arms = BodySide::BOTH_SIDES.map(BodyPart::UpperArm);
    let mut parts = [BodyPart::Hips, BodyPart::Chest, BodyPart::Head]
        .into_iter()
        .chain(arms);
    let known_joint = parts.find_map(|part| work.anatomy.part_joint(part));
    (model.model_joint_position(known_joint.unwrap_or(0)), forward)
}

/// Rotates and moves the second movement so that it starts on the spot on which the first ends, on the same floor and
/// facing the same way, regardless of the joints above the hips in their files.
fn face_alike(first: &WorkingClip, second: &mut WorkingClip) {
    let (end, faced) = standing_spot(first, first.frames - 1);
    let (start, facing) = standing_spot(second, 0);
    let yaw = |v: DVec3| v.x.atan2(v.z);
    let angle = faced.zip(facing).map_or(0.0, |(to, from)| yaw(to) - yaw(from));
    let turn = DQuat::from_rotation_y(angle);
    let shift = end - turn * start;
    // A movement that already stands there keeps its numbers exactly.
    let moves = shift.length() > 1e-6 || turn.w.abs() < 1.0 - 1e-9;
    if !moves {
        return;
    }
    let places = (0..second.frames)
        .map(|f| turn * second.joint_translation_at(0, f) + shift)
        .collect();
    let root = &mut second.channels[0];
    root.translations = Some(places);
    for rotation in &mut root.rotations {
        *rotation = (turn * *rotation).normalize();
    }
}

/// Finds for each hand the frames to leave one sign and enter the next with the least cost.
fn seam(first: &WorkingClip, second: &WorkingClip, time: Option<RecipeSeconds>, ends: &CutSignEnds) -> MovementSeam {
    let wrists = BodySide::BOTH_SIDES.map(|side| first.anatomy.arm_chain(side).map(|arm| arm.hand));
    let stance_parts = BodySide::BOTH_SIDES
        .map(BodyPart::Foot)
        .into_iter()
        .chain([BodyPart::Hips]);
    let stance: Vec<usize> = stance_parts.filter_map(|part| first.anatomy.part_joint(part)).collect();
    let joints = || wrists.iter().flatten().chain(&stance).copied();
    let (a, b) = (
        JointColumns::joint_columns_of(first, joints()),
        JointColumns::joint_columns_of(second, joints()),
    );
    let window = |work: &WorkingClip| {
        let frames = (CUT_SEARCH_WINDOW_S / work.rate.frame_time()).round() as usize;
        frames.min(work.frames * 3 / 10)
    };
    // Beside a rest that is cut off, hands leave after the last phase and enter before the first.
    let before = ends.after.unwrap_or_else(|| window(first));
    let after = ends.before.unwrap_or_else(|| window(second));
    let last = first.frames - 1;
    let mut hands = [ChannelCut {
        leave: last - ends.after.unwrap_or(0),
        enter: ends.before.unwrap_or(0),
    }; 2];
    let mut longest: f64 = 0.0;
    // Between two postures of signing, a hand that the second sign does not use sets no pace.
    let signing = ends.after.or(ends.before).is_some();
    let idle = BodySide::BOTH_SIDES
        .map(|side| signing && !is_hand_used(second, side) && is_hand_used(second, side.opposite_side()));
    for ((cut, hand), idle) in hands.iter_mut().zip(wrists).zip(idle) {
        let Some(hand) = hand.filter(|_| !idle) else {
            continue;
        };
        let (pa, pb) = (a.joint_positions(hand), b.joint_positions(hand));
        let usual = *cut;
        let mut least = f64::INFINITY;
        for (leave, &from) in pa.iter().enumerate().skip(last - before) {
            for (enter, &to) in pb.iter().enumerate().take(after + 1) {
                let trimmed_frames = leave.abs_diff(usual.leave) + enter.abs_diff(usual.enter);
                let trimmed = trimmed_frames as f64 / (before + after).max(1) as f64;
                // Of places that are nearly as close, the one that leaves out less: all frames weigh 2 cm.
                let cost = from.distance(to) + 0.02 * trimmed;
                if cost < least {
                    (least, *cut) = (cost, ChannelCut { leave, enter });
                }
            }
        }
        longest = longest.max(pa[cut.leave].distance(pb[cut.enter]));
    }
    // The hand whose cuts leave out the fewest frames sets the pace: its transition takes exactly the wanted time, and
    // trunk, head and legs go with it.
    let left_out = |cut: &ChannelCut| last - cut.leave + cut.enter;
    let [right, left] = hands;
    let body = match idle {
        [true, false] => left,
        [false, true] => right,
        _ if left_out(&left) < left_out(&right) => left,
        _ => right,
    };
    // An idle hand, which leaves nothing out, goes with the hand that signs.
    let hands = [right, left].map(|cut| if left_out(&cut) < left_out(&body) { body } else { cut });
    let shift = |&joint: &usize| a.joint_positions(joint)[body.leave].distance(b.joint_positions(joint)[body.enter]);
    let farthest = stance.iter().map(shift).fold(0.0, f64::max);
    let (least, most, speed) = TRANSITION_TIME_RANGE;
    let speed_seconds = (longest / speed).clamp(least, most);
    let usual = speed_seconds.max((farthest / STANCE_TIME.0).min(STANCE_TIME.1));
    let seconds = time.map_or(usual, |time| time.0);
    let gap = (seconds / first.rate.frame_time()).round().max(1.0) as usize;
    let spare = left_out(&body);
    let offset = (first.frames + gap)
        .saturating_sub(spare)
        .max(first.frames.saturating_sub(spare).max(1));
    MovementSeam { offset, hands, body }
}

/// Returns whether a sign uses a hand.
fn is_hand_used(work: &WorkingClip, side: BodySide) -> bool {
    let mut notes = work.notes.iter();
    notes.any(|note| note.hand == Some(side) && note.value.reading_value().is_some())
}

/// Returns whether a hand of the first sign is idle in the second.
fn is_hand_idle_next(first: &WorkingClip, second: &WorkingClip, side: BodySide) -> bool {
    is_hand_used(first, side) && !is_hand_used(second, side) && is_hand_used(second, side.opposite_side())
}

/// Keeps a hand of the second movement in its posture at the end of the first; from the frame `until` on it goes to the
/// second movement's own last posture.
fn hold_idle_hand(first: &WorkingClip, second: &mut WorkingClip, side: BodySide, leave: usize, until: usize) {
    let groups = crate::work::find_joint_groups(&first.skeleton, &first.anatomy);
    for (joint, group) in groups.iter().enumerate() {
        if *group == JointGroup::Arm(side) || *group == JointGroup::Fingers(side) {
            let rotation = first.channels[joint].rotations[leave];
            let rotations = &mut second.channels[joint].rotations;
            let (until, rest) = (until.min(rotations.len()), rotations[rotations.len() - 1]);
            let steps = (rotations.len() - until) as f64;
            rotations.fill(rotation);
            for (n, own) in rotations[until..].iter_mut().enumerate() {
                *own = InterpolationKind::MinimumJerk.interpolate_rotation(rotation, rest, (n + 1) as f64 / steps);
            }
        }
    }
    // The hand keeps its value at the end of the first sign.
    let end = first.rate.frame_start_instant(leave + 1);
    let shown = first.notes.iter().filter(|note| {
        let about = matches!(
            note.about,
            NoteSubject::Component(SignComponent::Configuration | SignComponent::Orientation, _)
        );
        note.hand == Some(side) && about && note.value.reading_value().is_some()
    });
    let shown = shown.filter(|note| note.span.span_start_instant() < end && note.span.span_end_instant() >= end);
    let span = second.rate.frame_range_span(0..until.min(second.frames));
    let shown_note = shown.map(|note| GeneratedNote { span, ..note.clone() });
    let shown: Vec<GeneratedNote> = shown_note.collect();
    second.notes.retain(|note| note.hand != Some(side));
    second.notes.extend(shown);
}
