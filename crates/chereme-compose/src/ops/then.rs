//! `A then B`: one piece of movement after another on the first one's body.

use std::sync::Arc;

use chereme_motion::glam::DQuat;
use chereme_motion::{ModelPose, Side};

use crate::contact::{self, Carry, Keep};
use crate::course::Courses;
use crate::error::Cause;
use crate::ops::join::{self, Cut, Seam};
use crate::ops::retarget;
use crate::units::Seconds;
use crate::work::{Columns, Group, Work};

/// The stretch at the end of one sign and the start of the next in which cuts are looked for, in
/// seconds; never more than 30 % of either.
const WINDOW: f64 = 0.3;
/// The least and most time of a transition, and a wrist's mean speed in one, in metres per second.
const TIMES: (f64, f64, f64) = (0.15, 0.6, 1.0);

/// Puts `next` behind `work`; returns what was done and how the hands meet.
pub(crate) fn then(
    work: &mut Work,
    next: Work,
    time: Option<Seconds>,
    courses: &Courses,
    operator: &str,
) -> Result<join::Done, Cause> {
    let (mut did, mut contacts) = (Vec::new(), Vec::new());
    let mut next = if Arc::ptr_eq(&work.skeleton, &next.skeleton) || work.skeleton == next.skeleton
    {
        next
    } else {
        did.push("the second signer's movement is put on the first one's body".to_owned());
        let touched = contact::touches(&next);
        let mut next = retarget::retarget(&next, &work.skeleton, &work.anatomy)?;
        let mut touched = touched.on(&next);
        let keep = Keep::All(&Side::BOTH);
        did.extend(contact::mend(&mut next, &mut touched, keep, operator));
        contacts = contact::lost(&touched, &next, Carry::Same);
        next
    };
    retarget::resample(&mut next, work.rate);
    face_alike(work, &mut next);
    let seam = seam(work, &next, time);
    let held: Vec<Side> = Side::BOTH
        .into_iter()
        .filter(|&side| stays(work, &next, side))
        .collect();
    for &side in &held {
        hold(
            work,
            &mut next,
            side,
            seam.hands[usize::from(side == Side::Left)].leave,
        );
        did.push(format!(
            "the {} hand stays where it is: the second sign does not use it",
            side.name()
        ));
    }
    for (side, cut) in Side::BOTH.into_iter().zip(seam.hands) {
        let frames = seam.offset + cut.enter - cut.leave - 1;
        did.push(format!(
            "{} hand: leaves {} frames before the end, enters at frame {}, {} frames between",
            side.name(),
            work.frames - 1 - cut.leave,
            cut.enter,
            frames
        ));
    }
    let joins = join::join(work, next, &seam, courses, operator)?;
    Ok(join::Done {
        did,
        joins,
        contacts,
    })
}

/// Turns and moves the second movement on the floor so that it starts where the first ends, facing
/// the same way.
fn face_alike(first: &Work, second: &mut Work) {
    let frame = |work: &Work, frame: usize| {
        let model = ModelPose::of(&work.skeleton, &work.pose(frame));
        work.anatomy.body_frame(&model)
    };
    let (Some(end), Some(start)) = (frame(first, first.frames - 1), frame(second, 0)) else {
        return;
    };
    let yaw = |v: chereme_motion::glam::DVec3| v.x.atan2(v.z);
    let turn = DQuat::from_rotation_y(yaw(end.forward) - yaw(start.forward));
    let mut shift = end.origin - turn * start.origin;
    shift.y = 0.0;
    let moves = shift.length() > 1e-6 || turn.w.abs() < 1.0 - 1e-9;
    if !moves {
        return;
    }
    let places = (0..second.frames)
        .map(|f| turn * second.translation(0, f) + shift)
        .collect();
    let root = &mut second.channels[0];
    root.translations = Some(places);
    for rotation in &mut root.rotations {
        *rotation = (turn * *rotation).normalize();
    }
}

/// Finds for each hand the frames at which leaving one sign and entering the next costs least.
fn seam(first: &Work, second: &Work, time: Option<Seconds>) -> Seam {
    let wrists = Side::BOTH.map(|side| first.anatomy.arm(side).map(|arm| arm.hand));
    let joints = || wrists.iter().flatten().copied();
    let (a, b) = (Columns::of(first, joints()), Columns::of(second, joints()));
    let window = |work: &Work| {
        let frames = (WINDOW / work.rate.frame_time()).round() as usize;
        frames.min(work.frames * 3 / 10)
    };
    let (before, after) = (window(first), window(second));
    let last = first.frames - 1;
    let mut hands = [Cut {
        leave: last,
        enter: 0,
    }; 2];
    let mut longest: f64 = 0.0;
    for (cut, hand) in hands.iter_mut().zip(wrists) {
        let Some(hand) = hand else { continue };
        let (pa, pb) = (a.positions(hand), b.positions(hand));
        let mut least = f64::INFINITY;
        for (leave, &from) in pa.iter().enumerate().skip(last - before) {
            for (enter, &to) in pb.iter().enumerate().take(after + 1) {
                let trimmed = (last - leave + enter) as f64 / (before + after).max(1) as f64;
                let cost = from.distance(to) + 0.02 * trimmed;
                if cost < least {
                    (least, *cut) = (cost, Cut { leave, enter });
                }
            }
        }
        longest = longest.max(pa[cut.leave].distance(pb[cut.enter]));
    }
    let (least, most, speed) = TIMES;
    let seconds = time.map_or((longest / speed).clamp(least, most), |time| time.0);
    let gap = (seconds / first.rate.frame_time()).round().max(1.0) as usize;
    // The slower hand sets the pace: its way takes the time asked for, cuts included.
    let spare = hands
        .iter()
        .map(|cut| last - cut.leave + cut.enter)
        .min()
        .unwrap_or(0);
    let offset = (first.frames + gap)
        .saturating_sub(spare)
        .max(first.frames.saturating_sub(spare).max(1));
    Seam {
        offset,
        hands,
        body: Cut {
            leave: last.min(offset - 1),
            enter: 0,
        },
    }
}

/// Tells whether a hand that the first sign uses has nothing to do in the second.
fn stays(first: &Work, second: &Work, side: Side) -> bool {
    let used = |work: &Work, side: Side| {
        work.notes
            .iter()
            .any(|note| note.hand == Some(side) && note.value.value().is_some())
    };
    used(first, side) && !used(second, side) && used(second, side.other())
}

/// Lets a hand of the second movement stay as the first leaves it.
fn hold(first: &Work, second: &mut Work, side: Side, leave: usize) {
    let groups = crate::work::groups(&first.skeleton, &first.anatomy);
    for (joint, group) in groups.iter().enumerate() {
        if *group == Group::Arm(side) || *group == Group::Fingers(side) {
            let rotation = first.channels[joint].rotations[leave];
            second.channels[joint].rotations.fill(rotation);
        }
    }
}
