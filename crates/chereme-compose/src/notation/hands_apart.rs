//! Separates two hands that would pass through each other.

use std::ops::Range;

use chereme_motion::glam::DVec3;

use super::notation_bulk;
use super::notation_stage::{StagedHand, StandingBody};
use super::notation_track::HandGoalFrames;
use super::notation_tuned::tuned;

/// The number of rounds of this correction.
const HANDS_APART_TRIES: usize = 3;
/// Step (hand lengths) by which hands move farther aside, until they do not penetrate each other.
const HANDS_APART_STEP: f64 = 0.025;
/// The largest number of such steps.
const MAX_HANDS_APART_STEPS: u32 = 10;
/// Outline points that stand for a hand: palm, and joints and tips of index and middle finger.
const HAND_BONE_POINTS: [usize; 6] = [1, 6, 7, 8, 9, 10];

/// A moment at which two hands move aside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PartedMoment {
    /// The time (s, as planned) at which they are nearest.
    pub(crate) time: f64,
    /// Distance by which each moves aside, in metres.
    pub(crate) by: f64,
}

/// A time span in which two hands are too near to each other.
struct HandMeeting {
    frames: Range<usize>,
    nearest: usize,
    /// The offset between the hands' bones there, from the second hand to the first.
    offset: DVec3,
}

/// Separates hands that would pass through each other, each by half of the distance. Hands that touch, or
/// that approach and part again, stay unchanged.
pub(crate) fn part_passing_hands(
    stage: &StandingBody,
    hands: [&StagedHand; 2],
    [first, second]: [&mut HandGoalFrames<'_>; 2],
    rate: f64,
) -> Option<PartedMoment> {
    let length = hands[0].staged_hand_length();
    let around = ((tuned().hands_apart.around * rate).ceil() as usize).max(1);
    let mut parted: Option<PartedMoment> = None;
    for _ in 0..HANDS_APART_TRIES {
        let mut meetings = meetings(length, first, second);
        let long = (tuned().hands_apart.longest * rate) as usize;
        meetings.retain(|meeting| meeting.frames.len() < long && has_crossed_sides(meeting, first, second));
        if meetings.is_empty() {
            break;
        }
        for meeting in meetings {
            let (n, total) = (meeting.nearest, first.points.len());
            let aside = separation_direction(stage, &meeting, first, second);
            let along = meeting.offset.dot(aside);
            let by = 0.5 * (tuned().hands_apart.near * length * 1.1 - along).max(0.0);
            let frames = meeting.frames.start.saturating_sub(around)..(meeting.frames.end + around).min(total);
            let touches = |frame: usize| first.touch[frame].max(second.touch[frame]) > 0.0;
            let farthest = if frames.clone().any(touches) {
                0
            } else {
                MAX_HANDS_APART_STEPS
            };
            // Fists are thicker than palms.
            let clear = |by: &f64| {
                let mut frames = meeting.frames.clone();
                let apart = aside * (2.0 * by);
                !frames.any(|frame| notation_bulk::may_hands_penetrate(length, [first, second], frame, apart))
            };
            let farther = (0..=farthest).map(|n| by + HANDS_APART_STEP * f64::from(n) * length);
            let by = farther.into_iter().find(clear).unwrap_or(by);
            for frame in frames {
                let before = meeting.frames.start.saturating_sub(frame);
                let after = (frame + 1).saturating_sub(meeting.frames.end);
                let linear_share = 1.0 - before.max(after) as f64 / (around + 1) as f64;
                let share = linear_share * linear_share * (3.0 - 2.0 * linear_share);
                let free = 1.0 - first.touch[frame].max(second.touch[frame]);
                first.points[frame] += aside * (by * share * free);
                second.points[frame] -= aside * (by * share * free);
            }
            let most = parted.map_or(0.0, |parted| parted.by);
            if by > most {
                let time = n as f64 / rate;
                parted = Some(PartedMoment { time, by });
            }
        }
    }
    parted
}

/// Returns whether the hands have changed sides after a meeting.
fn has_crossed_sides(meeting: &HandMeeting, first: &HandGoalFrames<'_>, second: &HandGoalFrames<'_>) -> bool {
    let Range { start, end } = meeting.frames;
    let Some(before) = start.checked_sub(1).filter(|_| end < first.points.len()) else {
        return false;
    };
    let palms = |frame: usize| hand_bone_positions(first, frame)[0] - hand_bone_positions(second, frame)[0];
    palms(before).dot(palms(end)) < 0.0
}

/// Returns the unit vector along which the hands separate: across their paths, in the direction in which
/// they are already apart; failing that, the first before the second.
fn separation_direction(
    stage: &StandingBody,
    meeting: &HandMeeting,
    first: &HandGoalFrames<'_>,
    second: &HandGoalFrames<'_>,
) -> DVec3 {
    let n = meeting.nearest;
    let last = first.points.len() - 1;
    let step = |wanted: &HandGoalFrames<'_>| wanted.points[(n + 1).min(last)] - wanted.points[n.saturating_sub(1)];
    let across = |v: DVec3| match (step(first) - step(second)).try_normalize() {
        Some(going) => v.reject_from_normalized(going),
        None => v,
    };
    let side_offset = across(meeting.offset);
    if side_offset.length() > 4e-3 {
        return side_offset.normalize();
    }
    let usual = across(stage.forward * 0.8 + DVec3::Y * 0.6);
    usual.try_normalize().unwrap_or(DVec3::Y)
}

/// Returns the spans in which hands that do not touch are too near to each other.
fn meetings(length: f64, first: &HandGoalFrames<'_>, second: &HandGoalFrames<'_>) -> Vec<HandMeeting> {
    let mut all: Vec<HandMeeting> = Vec::new();
    let mut least = f64::INFINITY;
    for frame in 0..first.points.len() {
        if first.points[frame].distance(second.points[frame]) > tuned().hands_apart.far * length
            || first.touch[frame].max(second.touch[frame]) > 0.0
        {
            continue;
        }
        let offset = shortest_hand_offset(hand_bone_positions(first, frame), hand_bone_positions(second, frame));
        let apart = offset.length();
        if apart >= tuned().hands_apart.near * length {
            continue;
        }
        match all.last_mut().filter(|last| last.frames.end == frame) {
            Some(last) => {
                last.frames.end = frame + 1;
                if apart < least {
                    (last.nearest, last.offset) = (frame, offset);
                    least = apart;
                }
            }
            None => {
                all.push(HandMeeting {
                    frames: frame..frame + 1,
                    nearest: frame,
                    offset,
                });
                least = apart;
            }
        }
    }
    all
}

/// Returns the shortest offset from a point of the second hand to one of the first.
fn shortest_hand_offset(first: [DVec3; HAND_BONE_POINTS.len()], second: [DVec3; HAND_BONE_POINTS.len()]) -> DVec3 {
    let pairs = first.iter().flat_map(|a| second.iter().map(move |b| *a - *b));
    pairs
        .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .unwrap_or(DVec3::INFINITY)
}

/// Returns the positions of a hand's bones in its intended pose.
fn hand_bone_positions(wanted: &HandGoalFrames<'_>, frame: usize) -> [DVec3; HAND_BONE_POINTS.len()] {
    let [_, outline] = wanted.outlines.outlines_at_frame(frame);
    let turned = wanted.turns[frame];
    let wrist = wanted.points[frame] - turned * wanted.offsets[frame];
    HAND_BONE_POINTS.map(|n| wrist + turned * outline.points.get(n).copied().unwrap_or(DVec3::ZERO))
}
