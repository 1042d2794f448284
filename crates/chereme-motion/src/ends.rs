//! The usable and the active frames of a clip: without bind poses, T-poses and jumps, and without rest.
//!
//! Capture programs write calibration poses into first and last frames: every bone at rest, the arms stretched out to
//! both sides, the body metres away or turned round. [`ClipEnds`] finds these frames, so that measures and pictures can
//! leave them out; [`activity_frames`] finds the movement between two rests. Neither changes a clip. Trimming, pictures,
//! transcription and all measures ask these two.

use std::fmt;
use std::ops::Range;

use glam::DVec3;

use crate::anatomy::{BodyAnatomy, BodyPart};
use crate::clip::Clip;
use crate::hand::BodySide;
use crate::pose::ModelPose;

/// A range of frames before or after the movement of a clip.
#[derive(Debug, Clone, PartialEq)]
pub struct OddFrames {
    /// The frames, counted from 0.
    pub frames: Range<usize>,
    /// The reason to leave them out.
    pub what: FrameOddity,
}

/// The reason why frames are not part of a movement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrameOddity {
    /// All joints have the skeleton's rest rotations, and a hand jumps to the next frame.
    Bind,
    /// Both arms are straight and stretched out to the sides.
    Tee,
    /// The body is this many metres away from its position in the next (or the last) frame.
    Jump(f64),
    /// The body is turned by this many radians compared with the next (or the last) frame.
    Turn(f64),
    /// A hand is this many metres away from its position in the next (or the last) frame.
    Leap(f64),
}

impl fmt::Display for FrameOddity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bind => f.write_str("the skeleton's own posture (bind pose)"),
            Self::Tee => f.write_str("a T-pose"),
            Self::Jump(metres) => write!(f, "the body jumps {metres:.1} m"),
            Self::Turn(angle) => write!(f, "the body turns by {:.0}° at once", angle.to_degrees()),
            Self::Leap(metres) => write!(f, "a hand jumps {metres:.1} m"),
        }
    }
}

impl fmt::Display for OddFrames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Range { start, end } = self.frames;
        if end - start == 1 {
            write!(f, "frame {start}: {}", self.what)
        } else {
            write!(f, "frames {start} to {}: {}", end - 1, self.what)
        }
    }
}

impl OddFrames {
    /// Returns the frames that remain of `all` frames without odd ones at both ends.
    #[must_use]
    pub fn remaining_frames(all: usize, odd: &[Self]) -> Range<usize> {
        let mut remaining = 0..all;
        for Self { frames, .. } in odd {
            // Ranges come from both ends only, so a start that is not at the front belongs to the end.
            if frames.start <= remaining.start {
                remaining.start = remaining.start.max(frames.end);
            } else {
                remaining.end = remaining.end.min(frames.start);
            }
        }
        remaining
    }
}

/// The sound frames of a clip, and the odd ones before and after them.
#[derive(Debug, Clone, PartialEq)]
pub struct ClipEnds {
    /// The remaining frames; not empty if the clip has frames.
    pub sound: Range<usize>,
    /// The odd frames, in order of time.
    pub odd: Vec<OddFrames>,
}

/// Length of each end in which turns and jumps of hands are searched, in seconds; at most a quarter of the clip. Jumps of
/// the body are searched everywhere.
const END_WINDOW_SECONDS: f64 = 1.0;
/// The share of a jump's least speed above which a step next to it belongs to it: programs spread a jump over several
/// frames.
const JUMP_SPEED_SHARE: f64 = 0.5;
/// A body that returns within this time in seconds, missing its place by at most this share of the jump, was away for a
/// moment: that is a lapse, and its frames stay.
const BODY_ABSENCE_LIMITS: (f64, f64) = (0.15, 0.35);
/// The least distance of a body's jump in metres, and its least speed in metres per second.
const MIN_BODY_JUMP: (f64, f64) = (0.5, 20.0);
/// The same for the body, for its turn in radians, and for a wrist relative to the body.
const MIN_JUMPS_BY_KIND: [(f64, f64); 3] = [MIN_BODY_JUMP, (0.8, 20.0), (0.2, 12.0)];
/// The least jump of a wrist after a bind pose, in metres.
const MIN_UNBIND_JUMP_M: f64 = 0.05;
/// Rotations within this angle of the rest pose, in radians, count as the rest pose.
const REST_POSE_TOLERANCE_RADIANS: f64 = 1e-3;
/// The least distance from shoulder to wrist in a T-pose as a share of the arm's length, and the least cosine of the
/// angle between the arm and the direction to its side.
const T_POSE_LIMITS: (f64, f64) = (0.93, 0.9);
/// The least depth of a resting wrist below its shoulder in arm lengths, and its greatest speed in metres per second.
const WRIST_REST_LIMITS: (f64, f64) = (0.7, 0.15);
/// The least depth of a waiting hand below its shoulder in arm lengths, its greatest drift from its first or last
/// position in metres, and the time in seconds for which both hands must wait.
const HAND_WAIT_LIMITS: (f64, f64, f64) = (0.45, 0.03, 0.3);

/// The least height of a signing wrist above the hips, as a share of the trunk.
const MIN_SIGNING_HEIGHT_SHARE: f64 = 0.2;

impl ClipEnds {
    /// Examines `clip`; `anatomy` belongs to its skeleton. Where the body jumps, the longest piece remains.
    #[must_use]
    pub fn examine_clip_ends(clip: &Clip, anatomy: &BodyAnatomy) -> Self {
        let looks = TakeSnapshots {
            clip,
            anatomy,
            first: 0,
        };
        // The order matters: each step narrows the sound frames in which the next one searches.
        let mut ends = Self::between_jumps(&looks.body_path(), &looks);
        ends.trim_odd_start(&looks);
        ends.tail(&looks);
        ends.odd.sort_by_key(|odd| odd.frames.start);
        ends
    }

    /// Examines a take that is too long for one clip: the `path` of its body over all frames, in metres, and the first and
    /// last `part` frames of the longest piece, which `read` gives.
    ///
    /// # Errors
    /// Those of `read`.
    pub fn of_long_take<E>(
        path: &[DVec3],
        part: usize,
        anatomy: &BodyAnatomy,
        mut read: impl FnMut(Range<usize>) -> Result<Clip, E>,
    ) -> Result<Self, E> {
        let mut look = |frames: Range<usize>, ends: Option<Self>, examine: fn(&mut Self, &TakeSnapshots<'_>)| {
            let looks = TakeSnapshots {
                clip: &read(frames.clone())?,
                anatomy,
                first: frames.start,
            };
            let mut ends = ends.unwrap_or_else(|| Self::between_jumps(path, &looks));
            examine(&mut ends, &looks);
            Ok(ends)
        };
        // The first part is only for the bind pose; the piece that remains decides which frames are read next.
        let ends = look(0..part.min(path.len()), None, |_, _| {})?;
        let Range { start, end } = ends.sound;
        // Where the piece begins is known only now, so the start is read a second time.
        let ends = look(start..(start + part).min(end), Some(ends), Self::trim_odd_start)?;
        let Range { start, end } = ends.sound;
        let mut ends = look(end.saturating_sub(part).max(start)..end, Some(ends), Self::tail)?;
        ends.odd.sort_by_key(|odd| odd.frames.start);
        Ok(ends)
    }

    /// Returns whether no frame is odd.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.odd.is_empty()
    }

    /// Keeps the longest piece between jumps of the body along its path; `looks` has the first frames.
    fn between_jumps(path: &[DVec3], looks: &TakeSnapshots<'_>) -> Self {
        let mut ends = Self {
            sound: 0..path.len(),
            odd: Vec::new(),
        };
        // So few frames have no ends that could be distinguished from the movement.
        if path.len() < 4 {
            return ends;
        }
        let jumps = body_jumps(path, looks.clip.clip_frame_rate().per_second());
        let starts = std::iter::once(0).chain(jumps.iter().map(|jump| jump.steps.end));
        let stops = jumps.iter().map(|jump| jump.steps.start + 1);
        let pieces = starts.zip(stops.chain([path.len()]));
        let longest = pieces.enumerate().max_by_key(|(nth, (start, end))| {
            // Of equal pieces the first.
            (end.saturating_sub(*start), usize::MAX - nth)
        });
        let Some((nth, (start, end))) = longest else {
            return ends;
        };
        if let Some(before) = nth.checked_sub(1) {
            // Frames in the rest pose before a jump are a bind pose, which says more than the jump does.
            let bound = looks.count_bind_frames(0..start);
            ends.leave_out(0..start, jumps[before].what_after(bound));
        }
        if let Some(after) = jumps.get(nth) {
            ends.leave_out(end..path.len(), after.what);
        }
        ends
    }

    /// Leaves frames at one end of the remaining ones out.
    fn leave_out(&mut self, frames: Range<usize>, what: FrameOddity) {
        if frames.is_empty() {
            return;
        }
        if frames.start <= self.sound.start {
            self.sound.start = frames.end;
        } else {
            self.sound.end = frames.start;
        }
        self.odd.push(OddFrames { frames, what });
    }

    /// Leaves odd frames at the start of the remaining ones out; `looks` has them.
    fn trim_odd_start(&mut self, looks: &TakeSnapshots<'_>) {
        let Some(window) = looks.end_window_frames(&self.sound) else {
            return;
        };
        let first = self.sound.start;
        let bound = first + looks.count_bind_frames(self.sound.clone());
        // The last jump of the window counts: all frames before it belong to the calibration.
        let jump = looks.jumps(first..first + window).pop();
        if let Some(jump) = jump {
            self.leave_out(first..jump.steps.end, jump.what_after(bound));
        } else if bound > first && bound - first <= window && looks.unbinds(bound) {
            // Without a jump of the body, a short bind pose still shows by the hand that leaps out of it.
            self.leave_out(first..bound, FrameOddity::Bind);
        }
        let seen = looks.available_frame_range(&self.sound);
        let tee_frames = seen.clone().take_while(|&frame| looks.body_snapshot_at(frame).tee);
        let tee = tee_frames.count();
        // A T-pose through half of the clip is its content, not its calibration.
        if tee > 0 && tee < self.sound.len() / 2 {
            self.leave_out(seen.start..seen.start + tee, FrameOddity::Tee);
        }
        let seen = looks.available_frame_range(&self.sound);
        let start = seen.start;
        // A frame that follows a removed one at jump speed is still the way out of it.
        let snap_frames = (start..seen.end - 1).take_while(|&frame| looks.is_snap(frame));
        let snap = start + snap_frames.take(window).count();
        // Fast steps alone are no fault: they extend an odd range that was already found.
        if let Some(before) = self.odd.iter_mut().find(|odd| odd.frames.end == start) {
            before.frames.end = snap;
            self.sound.start = snap;
        }
    }

    /// Leaves odd frames at the end of the remaining ones out; `looks` has them.
    fn tail(&mut self, looks: &TakeSnapshots<'_>) {
        let Some(window) = looks.end_window_frames(&self.sound) else {
            return;
        };
        let last = self.sound.end;
        // A window of steps has one frame more than steps, hence the one less.
        let first = (last - 1).saturating_sub(window).max(self.sound.start);
        // The first jump of the window counts: all frames after it belong to the calibration.
        if let Some(FrameJump { steps, what }) = looks.jumps(first..last - 1).into_iter().next() {
            self.leave_out(steps.start + 1..last, what);
        }
        let seen = looks.available_frame_range(&self.sound);
        let tee_frames = seen
            .clone()
            .rev()
            .take_while(|&frame| looks.body_snapshot_at(frame).tee);
        let tee = tee_frames.count();
        if tee > 0 && tee < self.sound.len() / 2 {
            self.leave_out(seen.end - tee..seen.end, FrameOddity::Tee);
        }
        let seen = looks.available_frame_range(&self.sound);
        let end = seen.end;
        let snap_frames = (seen.start..end - 1).rev().take_while(|&frame| looks.is_snap(frame));
        let snap = end - snap_frames.take(window).count();
        if let Some(next) = self.odd.iter_mut().find(|odd| odd.frames.start == end) {
            next.frames.start = snap;
            self.sound.end = snap;
        }
    }
}

/// Returns the frames of a clip between the rest before its movement and the rest after it. A hand is at rest while it
/// hangs or lies low and stays still, or while both hands wait in front of the belly at the beginning or end of the
/// clip. Odd frames at the ends are left out, and so are the movement of the arms from a T-pose to the first rest, and
/// hands that stir between two rests without coming up.
/// Returns `None` if no hand is ever active, or if the skeleton has no arm.
#[must_use]
pub fn activity_frames(clip: &Clip, anatomy: &BodyAnatomy) -> Option<Range<usize>> {
    let ends = ClipEnds::examine_clip_ends(clip, anatomy);
    let looks = TakeSnapshots {
        clip,
        anatomy,
        first: 0,
    };
    let poses: Vec<BodySnapshot> = (0..clip.clip_frame_count())
        .map(|frame| looks.body_snapshot_at(frame))
        .collect();
    // Speed is measured over a tenth of a second, so that noise of single frames does not count.
    let step = ((clip.clip_frame_rate().per_second() * 0.05).round() as usize).max(1);
    let speed = |side: usize, frame: usize| {
        let near = frame.saturating_sub(step).max(ends.sound.start)..(frame + step + 1).min(ends.sound.end);
        let (first, last) = (poses.get(near.start)?, poses.get(near.end.checked_sub(1)?)?);
        let distance = last.wrists[side]?.distance(first.wrists[side]?);
        Some(distance * clip.clip_frame_rate().per_second() / (near.len() - 1).max(1) as f64)
    };
    let idle = |frame: usize| {
        (0..2).all(|side| match poses[frame].low[side] {
            // An arm that the skeleton lacks is at rest.
            None => true,
            Some(low) => {
                low > WRIST_REST_LIMITS.0 && speed(side, frame).is_none_or(|speed| speed < WRIST_REST_LIMITS.1)
            }
        })
    };
    // Without an arm nothing distinguishes rest from movement.
    if poses.iter().all(|look| look.low.iter().all(Option::is_none)) {
        return None;
    }
    let tee = |range: &dyn Fn(&OddFrames) -> bool| {
        ends.odd
            .iter()
            .any(|odd| range(odd) && matches!(odd.what, FrameOddity::Tee | FrameOddity::Bind))
    };
    let (mut start, mut end) = (ends.sound.start, ends.sound.end);
    // The rest is searched in the nearer half only, or it could be that of the other end.
    let half = start + ends.sound.len() / 2;
    // After a T-pose the arms come down first, which is not part of the sign.
    if tee(&|odd| odd.frames.end <= ends.sound.start)
        && let Some(rest) = (start..half).find(|&frame| idle(frame))
    {
        start = rest;
    }
    if tee(&|odd| odd.frames.start >= ends.sound.end)
        && let Some(rest) = (half..end).rev().find(|&frame| idle(frame))
    {
        end = rest + 1;
    }
    let first = (start..end).find(|&frame| !idle(frame))?;
    let last = (first..end).rev().find(|&frame| !idle(frame))?;
    // A hand that stirs in its rest, before or after the sign, does not sign.
    let is_up = |&frame: &usize| poses[frame].is_hand_up(anatomy);
    let (first, last) = match ((first..=last).find(is_up), (first..=last).rev().find(is_up)) {
        (Some(rises), Some(sinks)) => {
            let before = (first..rises).rev().find(|&frame| idle(frame));
            let after = (sinks..=last).find(|&frame| idle(frame));
            (
                before.map_or(first, |rest| rest + 1),
                after.map_or(last, |rest| rest - 1),
            )
        }
        // Hands that never come up may sign low: the range stays as it is.
        _ => (first, last),
    };
    // Shorter waits are holds, which belong to the sign.
    let wait = (clip.clip_frame_rate().per_second() * HAND_WAIT_LIMITS.2).ceil() as usize;
    let before = count_waiting_frames(&poses, first..last + 1);
    let first = if before >= wait { first + before } else { first };
    let after = count_waiting_frames(&poses, (first..last + 1).rev());
    let last = if after >= wait { last - after } else { last };
    Some(first..last + 1)
}

/// Counts the frames in which both hands wait low in front of the body, as they do in the first of `frames`.
/// Returns 0 if they wait in all of them: then there is no rest between movements.
fn count_waiting_frames(poses: &[BodySnapshot], mut frames: impl Iterator<Item = usize> + Clone) -> usize {
    let Some(start) = frames.clone().next().map(|frame| &poses[frame]) else {
        return 0;
    };
    let stays = |frame: usize| {
        (0..2).all(|side| {
            let drift = |(here, there): (DVec3, DVec3)| here.distance(there) < HAND_WAIT_LIMITS.1;
            poses[frame].low[side].is_none_or(|low| low > HAND_WAIT_LIMITS.0)
                && poses[frame].wrists[side].zip(start.wrists[side]).is_none_or(drift)
        })
    };
    let mut count = 0;
    loop {
        match frames.next() {
            Some(frame) if stays(frame) => count += 1,
            Some(_) => return count,
            // Everything is waiting: then nothing is a rest between movements.
            None => return 0,
        }
    }
}

/// The data about a body in one frame that decide about its ends.
struct BodySnapshot {
    body: DVec3,
    left: Option<DVec3>,
    /// Positions of the wrists relative to the body.
    wrists: [Option<DVec3>; 2],
    /// The depth of each wrist below its shoulder, in arm lengths.
    low: [Option<f64>; 2],
    tee: bool,
}

impl BodySnapshot {
    /// Returns whether a hand is above the lower fifth of the trunk.
    fn is_hand_up(&self, anatomy: &BodyAnatomy) -> bool {
        let Some(size) = anatomy
            .anatomy_measures()
            .filter(|_| anatomy.part_joint(BodyPart::Hips).is_some())
        else {
            return false;
        };
        let mut wrists = self.wrists.iter().flatten();
        // Wrists are relative to the hips only if there are hips; without them their height says nothing.
        wrists.any(|wrist| wrist.y > MIN_SIGNING_HEIGHT_SHARE * size.trunk)
    }
}

/// Frames of a take: those of a clip, and the number of the first.
struct TakeSnapshots<'a> {
    clip: &'a Clip,
    anatomy: &'a BodyAnatomy,
    first: usize,
}

/// A jump over successive steps: from the frame `steps.start` to the frame `steps.end`.
struct FrameJump {
    steps: Range<usize>,
    what: FrameOddity,
}

impl FrameJump {
    /// Returns what the frames before the jump are, if those before the frame `bound` have the rest pose.
    fn what_after(&self, bound: usize) -> FrameOddity {
        match bound > self.steps.start {
            true => FrameOddity::Bind,
            false => self.what,
        }
    }
}

impl TakeSnapshots<'_> {
    fn body_snapshot_at(&self, frame: usize) -> BodySnapshot {
        let model = self.clip.model_pose(frame - self.first);
        let anatomy = self.anatomy;
        let trunk = anatomy.body_frame(&model);
        let hips = anatomy
            .part_joint(BodyPart::Hips)
            .map(|hips| model.model_joint_position(hips));
        // Hips first: the trunk's origin moves with the shoulders, and signers shrug.
        let body = hips
            .or(trunk.map(|trunk| trunk.origin))
            .unwrap_or_else(|| model.model_joint_position(0));
        let arms = BodySide::BOTH_SIDES.map(|side| anatomy.arm_chain(side));
        let up = trunk.map_or(DVec3::Y, |trunk| trunk.up);
        let low = arms.map(|arm| {
            let arm = arm?;
            let [shoulder, elbow, wrist] =
                [arm.upper, arm.forearm, arm.hand].map(|joint| model.model_joint_position(joint));
            let length = shoulder.distance(elbow) + elbow.distance(wrist);
            // Arms without a length, as in some props, would divide by zero.
            (length > 1e-6).then(|| (shoulder - wrist).dot(up) / length)
        });
        BodySnapshot {
            body,
            left: trunk.map(|trunk| trunk.left),
            wrists: arms.map(|arm| Some(model.model_joint_position(arm?.hand) - body)),
            low,
            tee: self.is_tee(&model),
        }
    }

    fn is_tee(&self, model: &ModelPose) -> bool {
        let Some(trunk) = self.anatomy.body_frame(model) else {
            return false;
        };
        BodySide::BOTH_SIDES.iter().all(|&side| {
            let Some(arm) = self.anatomy.arm_chain(side) else {
                return false;
            };
            let [shoulder, elbow, wrist] =
                [arm.upper, arm.forearm, arm.hand].map(|joint| model.model_joint_position(joint));
            let length = shoulder.distance(elbow) + elbow.distance(wrist);
            // Both have to hold: an arm straight forward reaches far too, and a bent one may point aside.
            let reach = wrist - shoulder;
            reach.length() > T_POSE_LIMITS.0 * length
                && reach.normalize_or_zero().dot(trunk.left * side.side_sign()) > T_POSE_LIMITS.1
        })
    }

    /// Returns the distance of the body, the turn of the trunk and the greater distance of the wrists between two frames.
    fn snapshot_distances(a: &BodySnapshot, b: &BodySnapshot) -> [f64; 3] {
        // A skeleton without a trunk cannot turn.
        let turn = a.left.zip(b.left).map_or(0.0, |(a, b)| a.angle_between(b));
        let leap = (0..2)
            .filter_map(|side| Some(a.wrists[side]?.distance(b.wrists[side]?)))
            .fold(0.0, f64::max);
        [a.body.distance(b.body), turn, leap]
    }

    /// Returns the greatest speed of a step relative to the least one of a jump.
    fn relative_jump_speed(&self, moved: [f64; 3]) -> [f64; 3] {
        let rate = self.clip.clip_frame_rate().per_second();
        std::array::from_fn(|kind| moved[kind] * rate / MIN_JUMPS_BY_KIND[kind].1)
    }

    /// Returns whether the step from a frame to the next is fast enough to belong to a jump.
    fn is_snap(&self, frame: usize) -> bool {
        let moved = Self::snapshot_distances(&self.body_snapshot_at(frame), &self.body_snapshot_at(frame + 1));
        self.relative_jump_speed(moved)
            .iter()
            .any(|speed| *speed > JUMP_SPEED_SHARE)
    }

    /// Returns the jumps in steps, each from its frame to the next, in order.
    fn jumps(&self, steps: Range<usize>) -> Vec<FrameJump> {
        let looks: Vec<BodySnapshot> = (steps.start..=steps.end)
            .map(|frame| self.body_snapshot_at(frame))
            .collect();
        let moved = looks
            .windows(2)
            .map(|pair| Self::snapshot_distances(&pair[0], &pair[1]));
        let speeds: Vec<[f64; 3]> = moved.map(|moved| self.relative_jump_speed(moved)).collect();
        let is_fast = |step: &[f64; 3]| step.iter().any(|speed| *speed > JUMP_SPEED_SHARE);
        let (mut jumps, mut n) = (Vec::new(), 0);
        while n < speeds.len() {
            // Steps next to each other are one jump, which programs spread over several frames.
            let run = n..n + speeds[n..].iter().take_while(|step| is_fast(step)).count();
            n = run.end + 1;
            let mut far = [0.0_f64; 3];
            // The greatest distance within the run, since a jump may overshoot and come back a little.
            for look in &looks[run.start..=run.end] {
                let moved = Self::snapshot_distances(&looks[run.start], look);
                far = std::array::from_fn(|kind| far[kind].max(moved[kind]));
            }
            let jumps_by = |kind: &usize| {
                // A long way needs one step of impossible speed; otherwise it is a fast movement.
                far[*kind] > MIN_JUMPS_BY_KIND[*kind].0 && speeds[run.clone()].iter().any(|step| step[*kind] > 1.0)
            };
            // Body, turn and leap in this order: a jump of the body explains the others.
            let Some(kind) = (0..3).find(jumps_by) else {
                continue;
            };
            let what = [FrameOddity::Jump, FrameOddity::Turn, FrameOddity::Leap][kind](far[kind]);
            let steps = steps.start + run.start..steps.start + run.end;
            jumps.push(FrameJump { steps, what });
        }
        jumps
    }

    /// Returns the path of the body over all frames.
    fn body_path(&self) -> Vec<DVec3> {
        let hips = self.anatomy.part_joint(BodyPart::Hips);
        self.clip.joint_path(hips.unwrap_or(0))
    }

    /// Returns those of some frames that the clip has.
    fn available_frame_range(&self, frames: &Range<usize>) -> Range<usize> {
        frames.start.max(self.first)..frames.end.min(self.first + self.clip.clip_frame_count())
    }

    /// Returns the number of frames at each end in which turns and jumps of hands are searched; `None` if there are too
    /// few.
    fn end_window_frames(&self, sound: &Range<usize>) -> Option<usize> {
        let frames = (END_WINDOW_SECONDS * self.clip.clip_frame_rate().per_second()).round() as usize;
        // A quarter at most, so that both ends together leave the middle of a short clip alone.
        let few = self.available_frame_range(sound).len() / 4;
        (few > 0).then(|| few.min(frames).max(1))
    }

    /// Returns how many of the first frames have all joints except the root at rest.
    fn count_bind_frames(&self, frames: Range<usize>) -> usize {
        let skeleton = self.clip.clip_skeleton();
        let at_rest = |frame: &usize| {
            // The root is left out, since it places the body and is set even in a bind pose.
            (1..skeleton.len()).all(|joint| {
                let turned = self.clip.joint_channel(joint).rotations[*frame - self.first];
                turned.angle_between(skeleton.joint_at(joint).rest) < REST_POSE_TOLERANCE_RADIANS
            })
        };
        self.available_frame_range(&frames).take_while(at_rest).count()
    }

    /// Returns whether a hand jumps from the last frame of a bind pose to the next.
    fn unbinds(&self, bound: usize) -> bool {
        let (a, b) = (self.body_snapshot_at(bound - 1), self.body_snapshot_at(bound));
        let distances = (0..2).filter_map(|side| Some(a.wrists[side]?.distance(b.wrists[side]?)));
        distances.fold(0.0, f64::max) > MIN_UNBIND_JUMP_M
    }
}

/// Returns the jumps of a body along its path, without those from which it returns.
fn body_jumps(path: &[DVec3], rate: f64) -> Vec<FrameJump> {
    let speed = |n: usize| path[n].distance(path[n + 1]) * rate;
    let longest = ((BODY_ABSENCE_LIMITS.0 * rate).ceil() as usize).max(1);
    let (mut jumps, mut n, last) = (Vec::new(), 0, path.len() - 1);
    while n < last {
        let fast_frames = (n..last).take_while(|&n| speed(n) > JUMP_SPEED_SHARE * MIN_BODY_JUMP.1);
        let run = n..n + fast_frames.count();
        n = run.end + 1;
        let far = path[run.start].distance(path[run.end]);
        // Slow drifts may be far and single fast steps short; a jump is both far and fast.
        if far <= MIN_BODY_JUMP.0 || !run.clone().any(|n| speed(n) > MIN_BODY_JUMP.1) {
            continue;
        }
        let mut later = run.end + 1..(run.end + 1 + longest).min(path.len());
        // A body that comes back at once was lost for a moment and belongs to the lapses.
        match later.find(|&at| path[at].distance(path[run.start]) < BODY_ABSENCE_LIMITS.1 * far) {
            Some(back) => n = back,
            None => jumps.push(FrameJump {
                steps: run,
                what: FrameOddity::Jump(far),
            }),
        }
    }
    jumps
}

#[cfg(test)]
mod tests;
