//! Movement of one skeleton on another, part by part through the anatomy.

use std::sync::Arc;

use chereme_motion::glam::DQuat;
use chereme_motion::{Anatomy, Channel, Part, Pose, Rate, Side, Skeleton};

use crate::error::Cause;
use crate::work::{Columns, Work};

/// Puts movement on another skeleton.
///
/// Each part turns in model space, relative to its rest, as its counterpart does, the difference of
/// the bones' directions at rest made up for by the shortest turn; fingers take the joint angles; the
/// root's way is scaled by the arms' length. Joints that are no part stay at rest.
pub(crate) fn retarget(
    work: &Work,
    skeleton: &Arc<Skeleton>,
    anatomy: &Arc<Anatomy>,
) -> Result<Work, Cause> {
    for side in Side::BOTH {
        if anatomy.arm(side).is_some() && work.anatomy.arm(side).is_none() {
            return Err(Cause::NoArm(side));
        }
    }
    let mut out = Work {
        skeleton: Arc::clone(skeleton),
        anatomy: Arc::clone(anatomy),
        channels: skeleton
            .joints()
            .iter()
            .map(|joint| Channel {
                rotations: vec![joint.rest; work.frames],
                translations: None,
            })
            .collect(),
        ..work.clone()
    };
    let pairs = pairs(work, skeleton, anatomy);
    let columns = Columns::of(
        work,
        pairs.iter().flatten().map(|&(from, _)| from).chain([0]),
    );
    let (from_rest, to_rest) = (work.skeleton.rest_model_pose(), skeleton.rest_model_pose());
    let mut model: Vec<Vec<DQuat>> = Vec::with_capacity(skeleton.len());
    for (joint, pair) in pairs.iter().enumerate() {
        let above = skeleton.parent(joint).map(|parent| &model[parent]);
        let parent = |frame: usize| above.map_or(DQuat::IDENTITY, |column| column[frame]);
        let rest = skeleton.joint(joint).rest;
        let column: Vec<DQuat> = match *pair {
            Some((from, part)) => {
                let even = even(work, from, skeleton, joint, anatomy, part);
                let back = from_rest.rotation(from).inverse();
                let onto = even * to_rest.rotation(joint);
                let turned = columns.rotations(from);
                turned
                    .iter()
                    .map(|r| (*r * back * onto).normalize())
                    .collect()
            }
            None => (0..work.frames).map(|frame| parent(frame) * rest).collect(),
        };
        let local =
            (0..work.frames).map(|frame| (parent(frame).inverse() * column[frame]).normalize());
        let local: Vec<DQuat> = local.collect();
        out.channels[joint].rotations = local;
        model.push(column);
    }
    root(work, &mut out);
    fingers(work, &mut out);
    Ok(out)
}

/// Returns for each joint of the new skeleton its counterpart and part; fingers have none.
fn pairs(work: &Work, skeleton: &Skeleton, anatomy: &Anatomy) -> Vec<Option<(usize, Part)>> {
    let mut pairs = vec![None; skeleton.len()];
    for (part, joint, _) in anatomy.found() {
        if !matches!(part, Part::Thumb(..) | Part::Finger(..))
            && let Some(from) = work.anatomy.joint(part)
        {
            pairs[joint] = Some((from, part));
        }
    }
    pairs
}

/// Returns the turn from a bone at rest to its counterpart's direction at rest, for limbs.
fn even(
    work: &Work,
    from: usize,
    skeleton: &Skeleton,
    to: usize,
    anatomy: &Anatomy,
    part: Part,
) -> DQuat {
    let next = match part {
        Part::UpperArm(side) => Part::Forearm(side),
        Part::Forearm(side) => Part::Hand(side),
        Part::Hand(side) => Part::Finger(side, chereme_motion::Finger::Middle, 1),
        Part::Thigh(side) => Part::Shin(side),
        Part::Shin(side) => Part::Foot(side),
        _ => return DQuat::IDENTITY,
    };
    let bone = |skeleton: &Skeleton, anatomy: &Anatomy, joint: usize| {
        let rest = skeleton.rest_model_pose();
        (rest.position(anatomy.joint(next)?) - rest.position(joint)).try_normalize()
    };
    let there = bone(&work.skeleton, &work.anatomy, from);
    match (bone(skeleton, anatomy, to), there) {
        (Some(own), Some(other)) => DQuat::from_rotation_arc(own, other),
        _ => DQuat::IDENTITY,
    }
}

fn root(work: &Work, out: &mut Work) {
    let height = |skeleton: &Skeleton, anatomy: &Anatomy| {
        let model = skeleton.rest_model_pose();
        let hips = anatomy.joint(Part::Hips).unwrap_or(0);
        let foot = anatomy
            .joint(Part::Foot(Side::Left))
            .or(anatomy.joint(Part::Foot(Side::Right)));
        foot.map(|foot| model.position(hips).y - model.position(foot).y)
    };
    let scale = match (
        height(&work.skeleton, &work.anatomy),
        height(&out.skeleton, &out.anatomy),
    ) {
        (Some(from), Some(to)) if from > 1e-3 => to / from,
        _ => 1.0,
    };
    let rest = (work.skeleton.joint(0).offset, out.skeleton.joint(0).offset);
    out.channels[0].translations = work.channels[0].translations.as_ref().map(|places| {
        places
            .iter()
            .map(|&at| rest.1 + (at - rest.0) * scale)
            .collect()
    });
}

fn fingers(work: &Work, out: &mut Work) {
    for side in Side::BOTH {
        let (here, there) = (work.anatomy.fingers(side), out.anatomy.fingers(side));
        if here.is_empty() || there.is_empty() {
            continue;
        }
        let mut source: Pose = work.pose(0);
        let mut target = out.skeleton.rest_pose();
        for frame in 0..work.frames {
            for &joint in &here {
                source.rotations[joint] = work.channels[joint].rotations[frame];
            }
            let angles = work.anatomy.hand_angles(&work.skeleton, side, &source);
            let Some(angles) = angles else { break };
            if !out
                .anatomy
                .set_hand_angles(&out.skeleton, side, &angles, &mut target)
            {
                break;
            }
            for &joint in &there {
                out.channels[joint].rotations[frame] = target.rotations[joint];
            }
        }
    }
}

/// Brings movement to another frame rate.
pub(crate) fn resample(work: &mut Work, rate: Rate) {
    if work.rate == rate || work.frames == 0 {
        return;
    }
    let last = work.rate.instant(work.frames - 1);
    let frames = rate.frame_at(last) + usize::from(rate.instant(rate.frame_at(last)) <= last);
    let from = work.rate.per_second();
    let at: Vec<f64> = (0..frames)
        .map(|f| rate.instant(f).seconds() * from)
        .collect();
    work.sample(&at);
    work.rate = rate;
}
