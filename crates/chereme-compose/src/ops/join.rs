//! Joins movement after movement, generates the frames between, and measures the joins.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide};

use crate::course::{TransitionCourse, TransitionCourses};
use crate::error::StepError;
use crate::outcome::{GeneratedCurve, GeneratedNote, JoinReport, NoteSubject};
use crate::work::{JointColumns, JointGroup, WorkingClip};

/// The most joints times frames of a result: about 300 MB of rotations.
const MAX_WORK_CELLS: usize = 10_000_000;

/// Returns an error if `frames` of this skeleton exceed the limit.
pub(crate) fn check_length(work: &WorkingClip, frames: usize) -> Result<(), StepError> {
    let most = MAX_WORK_CELLS / work.skeleton.len();
    if frames > most {
        return Err(StepError::TooLong { frames, most });
    }
    Ok(())
}

/// The report of a join: its effects, measurements, and lost contacts.
#[derive(Debug, Default)]
pub(crate) struct JoinOutcome {
    pub(crate) did: Vec<String>,
    pub(crate) joins: Vec<JoinReport>,
    pub(crate) contacts: Vec<String>,
    pub(crate) warnings: Vec<String>,
}

/// The frames at which the channels of one hand leave the first movement and enter the second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ChannelCut {
    /// The last frame played from the first movement.
    pub(crate) leave: usize,
    /// The first frame played from the second movement, counted in the second.
    pub(crate) enter: usize,
}

/// The join of two movements with the same skeleton and rate.
pub(crate) struct MovementSeam {
    /// The frame of the result at which the second movement's frame 0 would be.
    pub(crate) offset: usize,
    /// The cut of each side's arm and fingers.
    pub(crate) hands: [ChannelCut; 2],
    /// The cut of everything else.
    pub(crate) body: ChannelCut,
}

impl MovementSeam {
    /// Returns the seam that plays both movements completely, with `gap` frames between.
    pub(crate) fn plain_seam(first: &WorkingClip, gap: usize) -> Self {
        let cut = ChannelCut {
            leave: first.frames - 1,
            enter: 0,
        };
        Self {
            offset: first.frames + gap,
            hands: [cut; 2],
            body: cut,
        }
    }

    fn cut_for_group(&self, group: JointGroup) -> ChannelCut {
        match group {
            JointGroup::Arm(side) | JointGroup::Fingers(side) => self.hands[usize::from(side == BodySide::Left)],
            _ => self.body,
        }
    }
}

/// Appends `second` to `first`; both have the same skeleton and rate, and at least one frame.
///
/// Each channel follows the first up to its cut, goes to the second by its course, and follows the
/// second from its cut on. Joints above the hips stay as they are at the first's cut, and the hips make up for that, so
/// that their place and rotation in model space are blended.
pub(crate) fn join_movements(
    first: &mut WorkingClip,
    mut second: WorkingClip,
    seam: &MovementSeam,
    courses: &TransitionCourses,
    what: &str,
) -> Result<Vec<JoinReport>, StepError> {
    let frames = seam.offset + second.frames;
    check_length(first, frames)?;
    // Nodes above the hips differ from file to file in how they share the place in the room.
    hold_above_hips(first, &mut second, seam.body.leave);
    let groups = crate::work::find_joint_groups(&first.skeleton, &first.anatomy);
    for (joint, group) in groups.iter().enumerate() {
        let cut = seam.cut_for_group(*group);
        let course = match group {
            // Fingers change faster than arms, and have a learned course of their own.
            JointGroup::Fingers(_) => &courses.fingers,
            _ => &courses.arms,
        };
        extend_joint_channel(first, &second, joint, cut, seam.offset, course);
    }
    join_curves(first, &second, seam);
    let shift = first.rate.frame_start_instant(seam.offset).instant_micros();
    join_notes(first, &second, seam, shift, what);
    first.frames = frames;
    for (group, from) in second.from {
        let group_sources = first.from.entry(group).or_default();
        if *group_sources != from {
            group_sources.push(format!("then {}", from.join(" | ")));
        }
    }
    let reports: Vec<JoinReport> = BodySide::BOTH_SIDES
        .into_iter()
        .filter_map(|side| measure_join_smoothness(first, side, seam, what))
        .collect();
    for report in &reports {
        let name = || format!("the {} hand", report.hand.body_side_name());
        refuse_large_jump(name, report.position, report.velocity)?;
    }
    let trunk_parts = [BodyPart::Chest, BodyPart::Spine, BodyPart::Hips];
    let trunk = trunk_parts.iter().find_map(|&part| first.anatomy.part_joint(part));
    let [position, velocity, _] = measure_joint_breaks(first, trunk.unwrap_or(0), seam.body, seam.offset);
    refuse_large_jump(|| "the body".to_owned(), position, velocity)?;
    Ok(reports)
}

/// Gives the joints above the hips of `second` the local place and rotation that they have at a frame of `first`; the
/// joints below them keep their place and rotation in model space.
fn hold_above_hips(first: &WorkingClip, second: &mut WorkingClip, frame: usize) {
    let skeleton = &first.skeleton;
    let Some(hips) = first.anatomy.part_joint(BodyPart::Hips) else {
        return;
    };
    let mut above: Vec<usize> = skeleton.joint_ancestors(hips).skip(1).collect();
    above.reverse();
    let joint_pose = |joint: usize| {
        let place = first.joint_translation_at(joint, frame);
        (place, first.channels[joint].rotations[frame])
    };
    let as_held = |joint: &usize| {
        let (place, rotation) = joint_pose(*joint);
        let mut frames = 0..second.frames;
        frames.all(|frame| {
            let joint_rotation = second.channels[*joint].rotations[frame];
            (second.joint_translation_at(*joint, frame), joint_rotation) == (place, rotation)
        })
    };
    // Movements that already agree above the hips keep their numbers exactly.
    if above.iter().all(as_held) {
        return;
    }
    let before = JointColumns::joint_columns_of(second, above.iter().copied());
    let mut now = vec![(DVec3::ZERO, DQuat::IDENTITY); skeleton.len()];
    for &joint in &above {
        let (place, rotation) = joint_pose(joint);
        let (start, turned) = skeleton.joint_parent(joint).map_or(now[joint], |parent| now[parent]);
        now[joint] = (start + turned * place, (turned * rotation).normalize());
    }
    for joint in 0..skeleton.len() {
        let parent = skeleton.joint_parent(joint);
        if above.contains(&joint) {
            let (place, rotation) = joint_pose(joint);
            let channel = &mut second.channels[joint];
            channel.rotations.fill(rotation);
            channel.translations = Some(vec![place; second.frames]);
        } else if let Some(parent) = parent.filter(|parent| above.contains(parent)) {
            let (start, turned) = now[parent];
            let back = turned.inverse();
            let (starts, turns) = (before.joint_positions(parent), before.joint_rotations(parent));
            let places = (0..second.frames).map(|frame| {
                let place = second.joint_translation_at(joint, frame);
                back * (starts[frame] + turns[frame] * place - start)
            });
            let places = places.collect();
            let channel = &mut second.channels[joint];
            channel.translations = Some(places);
            for (rotation, turn) in channel.rotations.iter_mut().zip(turns) {
                *rotation = (back * *turn * *rotation).normalize();
            }
        }
    }
}

/// The largest jump at a join, in metres and in metres per second.
const MAX_JOIN_JUMP: (f64, f64) = (0.5, 20.0);

/// Refuses a join with a larger jump.
fn refuse_large_jump(what: impl Fn() -> String, distance: f64, speed: f64) -> Result<(), StepError> {
    if distance > MAX_JOIN_JUMP.0 || speed > MAX_JOIN_JUMP.1 {
        let what = what();
        return Err(StepError::Torn { what, distance, speed });
    }
    Ok(())
}

fn extend_joint_channel(
    first: &mut WorkingClip,
    second: &WorkingClip,
    joint: usize,
    cut: ChannelCut,
    offset: usize,
    course: &TransitionCourse,
) {
    let (leave, enter) = (cut.leave, cut.enter);
    let steps = (offset + enter - leave) as f64;
    let shares = || (leave + 1..offset + enter).map(|frame| (frame - leave) as f64 / steps);
    let here = first.skeleton.joint_at(joint).offset;
    let (from, to) = (
        first.joint_translation_at(joint, leave),
        second.joint_translation_at(joint, enter),
    );
    let (channel, next) = (&mut first.channels[joint], &second.channels[joint]);
    let moves = channel.translations.is_some() || next.translations.is_some();
    let (a, b) = (channel.rotations[leave], next.rotations[enter]);
    channel.rotations.truncate(leave + 1);
    channel
        .rotations
        .extend(shares().map(|w| course.rotation_along_course(a, b, w)));
    channel.rotations.extend_from_slice(&next.rotations[enter..]);
    // Where one movement places the joint, the other's constant offset has to be written out.
    if moves {
        let places = channel.translations.get_or_insert_with(|| vec![here; leave + 1]);
        places.truncate(leave + 1);
        places.extend(shares().map(|w| from.lerp(to, course.covered_path_share(w))));
        places.extend((enter..second.frames).map(|frame| second.joint_translation_at(joint, frame)));
    }
}

/// Moves every curve linearly from its value at the end of the first to its value at the start of the second; a missing
/// curve counts as zero.
fn join_curves(first: &mut WorkingClip, second: &WorkingClip, seam: &MovementSeam) {
    let (leave, enter) = (seam.body.leave, seam.body.enter);
    let none = |name: &str, frames: usize| GeneratedCurve {
        name: name.to_owned(),
        values: vec![0.0; frames],
    };
    for next in &second.curves {
        if first.curves.iter().all(|own| own.name != next.name) {
            first.curves.push(none(&next.name, first.frames));
        }
    }
    let steps = (seam.offset + enter - leave) as f64;
    for own in &mut first.curves {
        let next_curve = second.curves.iter().find(|next| next.name == own.name);
        let next = next_curve.map_or_else(|| vec![0.0; second.frames], |next| next.values.clone());
        let (a, b) = (own.values[leave], next[enter]);
        own.values.truncate(leave + 1);
        let gap = leave + 1..seam.offset + enter;
        own.values
            .extend(gap.map(|frame| a + (b - a) * (frame - leave) as f64 / steps));
        own.values.extend_from_slice(&next[enter..]);
    }
}

fn join_notes(first: &mut WorkingClip, second: &WorkingClip, seam: &MovementSeam, shift: i64, what: &str) {
    let rate = first.rate;
    for note in &mut first.notes {
        let cut = note
            .hand
            .map_or(seam.body, |side| seam.cut_for_group(JointGroup::Arm(side)));
        note.span = clip_note_span(note.span, first.rate.frame_range_span(0..cut.leave + 1));
    }
    for note in &second.notes {
        let cut = note
            .hand
            .map_or(seam.body, |side| seam.cut_for_group(JointGroup::Arm(side)));
        let span = clip_note_span(note.span, rate.frame_range_span(cut.enter..second.frames));
        first.notes.push(GeneratedNote {
            span: span.shifted_span(shift),
            ..note.clone()
        });
    }
    first.notes.push(GeneratedNote {
        hand: None,
        about: NoteSubject::Transition,
        value: chereme_sign::ComponentReading::Unset,
        span: rate.frame_range_span(seam.body.leave + 1..seam.offset + seam.body.enter),
        origin: what.to_owned(),
    });
}

fn clip_note_span(span: chereme_motion::TimeSpan, within: chereme_motion::TimeSpan) -> chereme_motion::TimeSpan {
    let clamped_instant = |instant: chereme_motion::RecordingInstant| {
        instant.max(within.span_start_instant()).min(within.span_end_instant())
    };
    chereme_motion::TimeSpan::span_between(
        clamped_instant(span.span_start_instant()),
        clamped_instant(span.span_end_instant()),
    )
}

/// Measures the smoothness of a wrist's movement at both ends of a transition.
fn measure_join_smoothness(work: &WorkingClip, side: BodySide, seam: &MovementSeam, what: &str) -> Option<JoinReport> {
    let hand = work.anatomy.arm_chain(side)?.hand;
    let cut = seam.cut_for_group(JointGroup::Arm(side));
    let (leave, enter) = (cut.leave, seam.offset + cut.enter);
    let [position, velocity, acceleration] = measure_joint_breaks(work, hand, cut, seam.offset);
    Some(JoinReport {
        what: what.to_owned(),
        hand: side,
        span: work.rate.frame_range_span(leave + 1..enter),
        position,
        velocity,
        acceleration,
    })
}

/// Measures the smoothness of a joint's movement at both ends of a transition: the distance from the position that its
/// speed predicts, and the changes of its velocity and acceleration; the larger of both ends.
fn measure_joint_breaks(work: &WorkingClip, joint: usize, cut: ChannelCut, offset: usize) -> [f64; 3] {
    let (leave, enter) = (cut.leave, offset + cut.enter);
    // Only the positions around the two ends are needed, not those of the whole movement.
    let start = leave.saturating_sub(4);
    let path = joint_positions_over(work, joint, start..(enter + 5).min(work.frames));
    let mut break_sizes: [f64; 3] = [0.0; 3];
    let per_second = work.rate.per_second();
    for frame in [leave, enter] {
        let first = (frame - start).checked_sub(2);
        let Some(&[a, b, c, d, e]) = first.and_then(|n| path.get(n..n + 5)) else {
            continue;
        };
        let (before, after) = ((c - b) * per_second, (d - c) * per_second);
        let bend = |x: DVec3, y: DVec3, z: DVec3| (z - 2.0 * y + x) * (per_second * per_second);
        break_sizes[0] = break_sizes[0].max((d - (c + (c - b))).length());
        break_sizes[1] = break_sizes[1].max((after - before).length());
        let change = bend(c, d, e) - bend(a, b, c);
        break_sizes[2] = break_sizes[2].max(change.length());
    }
    break_sizes
}

/// Returns the positions of `joint` over some frames.
fn joint_positions_over(work: &WorkingClip, joint: usize, frames: std::ops::Range<usize>) -> Vec<DVec3> {
    let mut up: Vec<usize> = work.skeleton.joint_ancestors(joint).collect();
    up.reverse();
    let place = |frame: usize| {
        let start = (DVec3::ZERO, DQuat::IDENTITY);
        let (place, _) = up.iter().fold(start, |(place, turned), &j| {
            let place = place + turned * work.joint_translation_at(j, frame);
            (place, turned * work.channels[j].rotations[frame])
        });
        place
    };
    frames.map(place).collect()
}
