//! Joins movement after movement, generates the frames between, and measures the joins.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Part, Side};

use crate::course::{Course, Courses};
use crate::error::Cause;
use crate::outcome::{About, Curve, JoinReport, Note};
use crate::work::{Columns, Group, Work};

/// The most joints times frames of a result: about 300 MB of rotations.
const MOST_CELLS: usize = 10_000_000;

/// Returns an error if `frames` of this skeleton exceed the limit.
pub(crate) fn check_length(work: &Work, frames: usize) -> Result<(), Cause> {
    let most = MOST_CELLS / work.skeleton.len();
    if frames > most {
        return Err(Cause::TooLong { frames, most });
    }
    Ok(())
}

/// The report of a join: its effects, measurements, and lost contacts.
#[derive(Debug, Default)]
pub(crate) struct Done {
    pub(crate) did: Vec<String>,
    pub(crate) joins: Vec<JoinReport>,
    pub(crate) contacts: Vec<String>,
    pub(crate) warnings: Vec<String>,
}

/// The frames at which the channels of one hand leave the first movement and enter the second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cut {
    /// The last frame played from the first movement.
    pub(crate) leave: usize,
    /// The first frame played from the second movement, counted in the second.
    pub(crate) enter: usize,
}

/// The join of two movements with the same skeleton and rate.
pub(crate) struct Seam {
    /// The frame of the result at which the second movement's frame 0 would be.
    pub(crate) offset: usize,
    /// The cut of each side's arm and fingers.
    pub(crate) hands: [Cut; 2],
    /// The cut of everything else.
    pub(crate) body: Cut,
}

impl Seam {
    /// Returns the seam that plays both movements completely, with `gap` frames between.
    pub(crate) fn plain(first: &Work, gap: usize) -> Self {
        let cut = Cut {
            leave: first.frames - 1,
            enter: 0,
        };
        Self {
            offset: first.frames + gap,
            hands: [cut; 2],
            body: cut,
        }
    }

    fn cut(&self, group: Group) -> Cut {
        match group {
            Group::Arm(side) | Group::Fingers(side) => self.hands[usize::from(side == Side::Left)],
            _ => self.body,
        }
    }
}

/// Appends `second` to `first`; both have the same skeleton and rate, and at least one frame.
///
/// Each channel follows the first up to its cut, goes to the second by its course, and follows the
/// second from its cut on. Joints above the hips stay as they are at the first's cut, and the hips make up for that, so
/// that their place and rotation in model space are blended.
pub(crate) fn join(
    first: &mut Work,
    mut second: Work,
    seam: &Seam,
    courses: &Courses,
    what: &str,
) -> Result<Vec<JoinReport>, Cause> {
    let frames = seam.offset + second.frames;
    check_length(first, frames)?;
    hold_above_hips(first, &mut second, seam.body.leave);
    let groups = crate::work::groups(&first.skeleton, &first.anatomy);
    for (joint, group) in groups.iter().enumerate() {
        let cut = seam.cut(*group);
        let course = match group {
            Group::Fingers(_) => &courses.fingers,
            _ => &courses.arms,
        };
        extend(first, &second, joint, cut, seam.offset, course);
    }
    curves(first, &second, seam);
    let shift = first.rate.instant(seam.offset).micros();
    notes(first, &second, seam, shift, what);
    first.frames = frames;
    for (group, from) in second.from {
        let own = first.from.entry(group).or_default();
        if *own != from {
            own.push(format!("then {}", from.join(" | ")));
        }
    }
    let reports: Vec<JoinReport> = Side::BOTH
        .into_iter()
        .filter_map(|side| report(first, side, seam, what))
        .collect();
    for report in &reports {
        let name = || format!("the {} hand", report.hand.name());
        whole(name, report.position, report.velocity)?;
    }
    let trunk = [Part::Chest, Part::Spine, Part::Hips];
    let trunk = trunk.iter().find_map(|&part| first.anatomy.joint(part));
    let [position, velocity, _] = breaks(first, trunk.unwrap_or(0), seam.body, seam.offset);
    whole(|| "the body".to_owned(), position, velocity)?;
    Ok(reports)
}

/// Gives the joints above the hips of `second` the local place and rotation that they have at a frame of `first`; the
/// joints below them keep their place and rotation in model space.
fn hold_above_hips(first: &Work, second: &mut Work, frame: usize) {
    let skeleton = &first.skeleton;
    let Some(hips) = first.anatomy.joint(Part::Hips) else {
        return;
    };
    let mut above: Vec<usize> = skeleton.ancestors(hips).skip(1).collect();
    above.reverse();
    let held = |joint: usize| {
        let place = first.translation(joint, frame);
        (place, first.channels[joint].rotations[frame])
    };
    let as_held = |joint: &usize| {
        let (place, rotation) = held(*joint);
        let mut frames = 0..second.frames;
        frames.all(|frame| {
            let own = second.channels[*joint].rotations[frame];
            (second.translation(*joint, frame), own) == (place, rotation)
        })
    };
    if above.iter().all(as_held) {
        return;
    }
    let before = Columns::of(second, above.iter().copied());
    let mut now = vec![(DVec3::ZERO, DQuat::IDENTITY); skeleton.len()];
    for &joint in &above {
        let (place, rotation) = held(joint);
        let (start, turned) = skeleton
            .parent(joint)
            .map_or(now[joint], |parent| now[parent]);
        now[joint] = (start + turned * place, (turned * rotation).normalize());
    }
    for joint in 0..skeleton.len() {
        let parent = skeleton.parent(joint);
        if above.contains(&joint) {
            let (place, rotation) = held(joint);
            let channel = &mut second.channels[joint];
            channel.rotations.fill(rotation);
            channel.translations = Some(vec![place; second.frames]);
        } else if let Some(parent) = parent.filter(|parent| above.contains(parent)) {
            let (start, turned) = now[parent];
            let back = turned.inverse();
            let (starts, turns) = (before.positions(parent), before.rotations(parent));
            let places = (0..second.frames).map(|frame| {
                let place = second.translation(joint, frame);
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
const MOST: (f64, f64) = (0.5, 20.0);

/// Refuses a join with a larger jump.
fn whole(what: impl Fn() -> String, distance: f64, speed: f64) -> Result<(), Cause> {
    if distance > MOST.0 || speed > MOST.1 {
        let what = what();
        return Err(Cause::Torn {
            what,
            distance,
            speed,
        });
    }
    Ok(())
}

fn extend(first: &mut Work, second: &Work, joint: usize, cut: Cut, offset: usize, course: &Course) {
    let (leave, enter) = (cut.leave, cut.enter);
    let steps = (offset + enter - leave) as f64;
    let shares = || (leave + 1..offset + enter).map(|frame| (frame - leave) as f64 / steps);
    let here = first.skeleton.joint(joint).offset;
    let (from, to) = (
        first.translation(joint, leave),
        second.translation(joint, enter),
    );
    let (channel, next) = (&mut first.channels[joint], &second.channels[joint]);
    let moves = channel.translations.is_some() || next.translations.is_some();
    let (a, b) = (channel.rotations[leave], next.rotations[enter]);
    channel.rotations.truncate(leave + 1);
    channel
        .rotations
        .extend(shares().map(|w| course.rotation(a, b, w)));
    channel
        .rotations
        .extend_from_slice(&next.rotations[enter..]);
    if moves {
        let places = channel
            .translations
            .get_or_insert_with(|| vec![here; leave + 1]);
        places.truncate(leave + 1);
        places.extend(shares().map(|w| from.lerp(to, course.share(w))));
        places.extend((enter..second.frames).map(|frame| second.translation(joint, frame)));
    }
}

/// Moves every curve linearly from its value at the end of the first to its value at the start of the second; a missing
/// curve counts as zero.
fn curves(first: &mut Work, second: &Work, seam: &Seam) {
    let (leave, enter) = (seam.body.leave, seam.body.enter);
    let none = |name: &str, frames: usize| Curve {
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
        let next = second.curves.iter().find(|next| next.name == own.name);
        let next = next.map_or_else(|| vec![0.0; second.frames], |next| next.values.clone());
        let (a, b) = (own.values[leave], next[enter]);
        own.values.truncate(leave + 1);
        let gap = leave + 1..seam.offset + enter;
        own.values
            .extend(gap.map(|frame| a + (b - a) * (frame - leave) as f64 / steps));
        own.values.extend_from_slice(&next[enter..]);
    }
}

fn notes(first: &mut Work, second: &Work, seam: &Seam, shift: i64, what: &str) {
    let rate = first.rate;
    for note in &mut first.notes {
        let cut = note
            .hand
            .map_or(seam.body, |side| seam.cut(Group::Arm(side)));
        note.span = clipped(note.span, first.rate.span(0..cut.leave + 1));
    }
    for note in &second.notes {
        let cut = note
            .hand
            .map_or(seam.body, |side| seam.cut(Group::Arm(side)));
        let span = clipped(note.span, rate.span(cut.enter..second.frames));
        first.notes.push(Note {
            span: span.shifted(shift),
            ..note.clone()
        });
    }
    first.notes.push(Note {
        hand: None,
        about: About::Transition,
        value: chereme_sign::Reading::Unset,
        span: rate.span(seam.body.leave + 1..seam.offset + seam.body.enter),
        origin: what.to_owned(),
    });
}

fn clipped(span: chereme_motion::Span, within: chereme_motion::Span) -> chereme_motion::Span {
    let at = |instant: chereme_motion::Instant| instant.max(within.start()).min(within.end());
    chereme_motion::Span::between(at(span.start()), at(span.end()))
}

/// Measures the smoothness of a wrist's movement at both ends of a transition.
fn report(work: &Work, side: Side, seam: &Seam, what: &str) -> Option<JoinReport> {
    let hand = work.anatomy.arm(side)?.hand;
    let cut = seam.cut(Group::Arm(side));
    let (leave, enter) = (cut.leave, seam.offset + cut.enter);
    let [position, velocity, acceleration] = breaks(work, hand, cut, seam.offset);
    Some(JoinReport {
        what: what.to_owned(),
        hand: side,
        span: work.rate.span(leave + 1..enter),
        position,
        velocity,
        acceleration,
    })
}

/// Measures the smoothness of a joint's movement at both ends of a transition: the distance from the position that its
/// speed predicts, and the changes of its velocity and acceleration; the larger of both ends.
fn breaks(work: &Work, joint: usize, cut: Cut, offset: usize) -> [f64; 3] {
    let (leave, enter) = (cut.leave, offset + cut.enter);
    let start = leave.saturating_sub(4);
    let path = near(work, joint, start..(enter + 5).min(work.frames));
    let mut found: [f64; 3] = [0.0; 3];
    let per_second = work.rate.per_second();
    for frame in [leave, enter] {
        let first = (frame - start).checked_sub(2);
        let Some(&[a, b, c, d, e]) = first.and_then(|n| path.get(n..n + 5)) else {
            continue;
        };
        let (before, after) = ((c - b) * per_second, (d - c) * per_second);
        let bend = |x: DVec3, y: DVec3, z: DVec3| (z - 2.0 * y + x) * (per_second * per_second);
        found[0] = found[0].max((d - (c + (c - b))).length());
        found[1] = found[1].max((after - before).length());
        let change = bend(c, d, e) - bend(a, b, c);
        found[2] = found[2].max(change.length());
    }
    found
}

/// Returns the positions of `joint` over some frames.
fn near(work: &Work, joint: usize, frames: std::ops::Range<usize>) -> Vec<DVec3> {
    let mut up: Vec<usize> = work.skeleton.ancestors(joint).collect();
    up.reverse();
    let place = |frame: usize| {
        let start = (DVec3::ZERO, DQuat::IDENTITY);
        let (place, _) = up.iter().fold(start, |(place, turned), &j| {
            let place = place + turned * work.translation(j, frame);
            (place, turned * work.channels[j].rotations[frame])
        });
        place
    };
    frames.map(place).collect()
}
