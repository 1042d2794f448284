//! Faults of arms: elbows that go where the place does not ask for it, wrists at their limit, detours.

use chereme_motion::{BodyAnatomy, BodySide, ModelPose};

use super::Seen;
use crate::checks::worst;

/// Heights of the wrist above its shoulder, and the height of the elbow that three of four captured ones stay below while
/// the wrist is there, in shoulder widths of 36 cm, as the example program `signing` measures.
const CAPTURED: [[f64; 2]; 4] = [
    [-0.25 / 0.36, -0.24 / 0.36],
    [-0.15 / 0.36, -0.25 / 0.36],
    [-0.05 / 0.36, -0.24 / 0.36],
    [0.05 / 0.36, -0.16 / 0.36],
];
/// Heights of the wrist (shoulder widths) between which captured elbows are known.
const KNOWN: [f64; 2] = [-0.30 / 0.36, 0.10 / 0.36];

pub(super) fn pumping(seen: &Seen<'_>) -> Option<bool> {
    let span = seen.sign()?;
    let arms = BodySide::BOTH_SIDES
        .into_iter()
        .filter_map(|side| seen.made.anatomy.arm_chain(side));
    let paths = arms.map(|arm| [arm.forearm, arm.hand].map(|joint| seen.path(joint, span)));
    Some(
        paths
            .into_iter()
            .any(|[elbow, wrist]| elbow > 0.05 && elbow > 1.5 * wrist),
    )
}

pub(super) fn standing_out(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    Some(stands_out(seen, &seen.models[from..=to], 60.0))
}

/// Returns whether an arm stands akimbo while it rises from rest or goes back.
pub(super) fn akimbo(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    let [rising, falling] = [&seen.models[..from], &seen.models[to..]];
    Some(stands_out(seen, rising, 45.0) || stands_out(seen, falling, 45.0))
}

/// Returns whether an elbow stands out by more than an angle (degrees) while the hand is low.
fn stands_out(seen: &Seen<'_>, models: &[ModelPose], most: f64) -> bool {
    let Some(frame) = seen.made.anatomy.body_frame(&seen.models[0]) else {
        return false;
    };
    let arms = BodySide::BOTH_SIDES
        .into_iter()
        .filter_map(|side| Some((side, seen.made.anatomy.arm_chain(side)?)));
    arms.into_iter().any(|(side, arm)| {
        models.iter().any(|model| {
            let [shoulder, elbow, wrist] = [arm.upper, arm.forearm, arm.hand].map(|j| model.model_joint_position(j));
            let upper = elbow - shoulder;
            let low = shoulder.y - wrist.y > 0.4 * upper.length();
            let aside = upper.dot(frame.left) * side.side_sign();
            low && aside.atan2(-upper.y) > most.to_radians()
        })
    })
}

pub(super) fn raised(seen: &Seen<'_>) -> Option<bool> {
    Some(worst(&seen.made).above > 0.03)
}

pub(super) fn lifted(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    let wide = seen.made.anatomy.body_frame(&seen.models[0])?.scale;
    let usual = |wrist: f64| {
        let next = CAPTURED.partition_point(|row| row[0] < wrist);
        let [a, b] = [next.saturating_sub(1), next].map(|n| CAPTURED[n.min(CAPTURED.len() - 1)]);
        let share = (wrist - a[0]) / (b[0] - a[0]).max(1e-9);
        a[1] + (b[1] - a[1]) * share.clamp(0.0, 1.0)
    };
    let arms = BodySide::BOTH_SIDES
        .into_iter()
        .filter_map(|side| seen.made.anatomy.arm_chain(side));
    let high = arms.into_iter().any(|arm| {
        seen.models[from..=to].iter().any(|model| {
            let [shoulder, elbow, wrist] =
                [arm.upper, arm.forearm, arm.hand].map(|j| model.model_joint_position(j).y / wide);
            let known = (KNOWN[0]..KNOWN[1]).contains(&(wrist - shoulder));
            known && elbow - shoulder > usual(wrist - shoulder) + 0.10 / wide
        })
    });
    Some(high)
}

/// Farthest distance of an elbow behind its shoulder (m): beyond, it stands behind the back.
const BEHIND: f64 = 0.10;

pub(super) fn behind(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    let arms = BodySide::BOTH_SIDES
        .into_iter()
        .filter_map(|side| seen.made.anatomy.arm_chain(side));
    let back = arms.into_iter().any(|arm| {
        seen.models[from..=to].iter().any(|model| {
            let forward = seen.made.anatomy.body_frame(model).map(|frame| frame.forward);
            let [shoulder, elbow] = [arm.upper, arm.forearm].map(|joint| model.model_joint_position(joint));
            forward.is_some_and(|forward| (shoulder - elbow).dot(forward) > BEHIND)
        })
    });
    Some(back)
}

/// Angle between a hand and its forearm (degrees) above which the wrist is near its limit.
const FOLDED: f64 = 65.0;

/// Returns the angle (degrees) between a hand and its forearm towards the palm or the back of the hand.
fn flexed(anatomy: &BodyAnatomy, model: &ModelPose, side: BodySide) -> Option<f64> {
    let arm = anatomy.arm_chain(side)?;
    let along = anatomy.hand_direction(side, model)?;
    let palm = anatomy.palm_normal(side, model)?;
    let forearm = (model.model_joint_position(arm.hand) - model.model_joint_position(arm.forearm)).normalize();
    Some((-forearm.dot(palm)).atan2(forearm.dot(along)).to_degrees())
}

pub(super) fn folded(seen: &Seen<'_>) -> Option<bool> {
    let (from, to) = seen.sign()?;
    let least = (0.2 * seen.rate) as usize;
    let long = BodySide::BOTH_SIDES.into_iter().any(|side| {
        let bent = seen.models[from..=to]
            .iter()
            .map(|model| flexed(&seen.made.anatomy, model, side).is_some_and(|angle| angle.abs() > FOLDED));
        let run = bent.scan(0, |run, bent| {
            *run = if bent { *run + 1 } else { 0 };
            Some(*run)
        });
        run.max().is_some_and(|run| run >= least)
    });
    Some(long)
}

pub(super) fn wandering(seen: &Seen<'_>) -> Option<bool> {
    let arm = seen.made.anatomy.arm_chain(seen.dominant())?;
    let (from, to) = seen.approach()?;
    let [start, end] = [from, to].map(|frame| seen.models[frame].model_joint_position(arm.hand));
    Some(seen.path(arm.hand, (from, to)) > 1.25 * start.distance(end))
}
