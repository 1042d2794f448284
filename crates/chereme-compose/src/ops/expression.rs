//! `nonmanual … over … by phases`: transfers an expression of the face to other signs, phase by phase.

use std::sync::Arc;

use chereme_motion::glam::DQuat;
use chereme_motion::{Instant, Part, Span};
use chereme_sign::Component;
use chereme_sign::milestones::{EDGE, Function, Milestones, milestones};

use crate::error::Cause;
use crate::ops::retarget::{self, TargetBody};
use crate::outcome::{About, Curve, Note};
use crate::recipe::{Nonmanual, Over};
use crate::resolve::ExpressionInput;
use crate::sources::Material;
use crate::work::{Group, Work, groups};

/// The longest time in which an expression fades in or out, in seconds.
const BLEND: f64 = 0.2;
/// The fading time before and after an expression without an onset or offset, in seconds.
const LEAD: f64 = 0.1;
/// The length in seconds below which a phase counts as empty.
const EMPTY: f64 = 1e-6;
/// The value up to which a curve of the mouth counts as at rest.
const QUIET: f64 = 0.05;

/// Gives head, trunk and face an expression from another performance, each phase stretched to the same phase here.
///
/// Outside of the expression nothing changes. A mouth that moves in these signs keeps its own movement. The trunk adds
/// the other's rotations relative to M1 to its own, so that it keeps its posture.
pub(crate) fn expression(
    work: &mut Work,
    donor: &Material,
    settings: &Nonmanual,
    given: &ExpressionInput,
    operator: &str,
) -> Result<Vec<String>, Cause> {
    let own = given.milestones;
    let target = target(work, settings.over, given);
    let course = Course {
        own,
        target,
        by_phases: settings.by_phases,
    };
    let mut other = Work::of(donor);
    if other.skeleton != work.skeleton {
        other = retarget::retarget(&other, &TargetBody::at_rest(&work.skeleton, &work.anatomy))?;
    } else {
        other.skeleton = Arc::clone(&work.skeleton);
    }
    let per_second = other.rate.per_second();
    let mut start = other.clone();
    start.sample(&[own.times()[0].seconds() * per_second]);
    let seconds = |frame: usize| work.rate.instant(frame).seconds();
    let at: Vec<f64> = (0..work.frames)
        .map(|frame| course.moment(seconds(frame)) * per_second)
        .collect();
    let weights: Vec<f64> = (0..work.frames)
        .map(|frame| course.weight(seconds(frame)))
        .collect();
    other.sample(&at);
    let (head, trunk) = turn(work, &other, &start, &weights)?;
    let mouth = blend_curves(work, other.curves, &weights, target.span());
    take_notes(work, &other.notes, &course);
    work.changed([Group::Head, Group::Trunk], operator);
    let mut did = vec![
        format!(
            "{} from {}: {own} onto {target}",
            given.function, donor.address
        ),
        format!("{head} joints of the head and {trunk} of the trunk"),
    ];
    if mouth {
        did.push("the mouth keeps its own movement".to_owned());
    }
    if target.span().start() < Instant::ZERO {
        let before = -target.span().start().seconds();
        did.push(format!(
            "the first {before:.2} s lie before the movement and are not seen"
        ));
    }
    if target.span().end() > work.end() {
        let after = target.span().end().seconds() - work.end().seconds();
        did.push(format!(
            "the last {after:.2} s lie after the movement and are not seen"
        ));
    }
    Ok(did)
}

/// Returns the milestones of the expression in this movement.
fn target(work: &Work, over: Option<Over>, given: &ExpressionInput) -> Milestones {
    let whole = work.span();
    let part = match over {
        Some(Over::At(times)) => {
            return Milestones::of_times(times.map(|at| Instant::from_seconds(at.0)));
        }
        Some(Over::Part(cut)) => Span::between(
            cut.from
                .map_or(whole.start(), |from| Instant::from_seconds(from.0)),
            cut.to.map_or(whole.end(), |to| Instant::from_seconds(to.0)),
        ),
        None => whole,
    };
    signed(work, part, &given.function).unwrap_or_else(|| {
        let own = given.milestones;
        let share = |m3: Instant| {
            let body = own.body();
            (m3.seconds() - body.start().seconds()) / body.seconds().max(1e-9)
        };
        let m3 = own.m3.map(|m3| share(m3).clamp(0.0, 1.0) * part.seconds());
        Milestones {
            m1: part.start().shifted(-EDGE),
            m2: part.start(),
            m3: m3.map(|after| Instant::from_seconds(part.start().seconds() + after)),
            m4: part.end(),
            m5: part.end().shifted(EDGE),
        }
    })
}

/// Returns milestones over the signs whose middles lie in `part`; `None` without such a sign.
fn signed(work: &Work, part: Span, function: &Function) -> Option<Milestones> {
    let glosses = work.notes.iter().filter(|note| note.about == About::Gloss);
    let mut signs: Vec<Span> = glosses.map(|note| note.span).collect();
    signs.sort_by_key(|span| (span.start(), span.end()));
    signs.dedup();
    let middle = |span: &Span| span.start().shifted(span.micros() / 2);
    let inside = |span: &Span| part.contains(middle(span));
    let first = signs.iter().position(inside)?;
    let last = signs.iter().rposition(inside)?;
    milestones(&signs, first..last + 1, function, EDGE)
}

/// Maps times of the movement to times of the expression, and gives its weight.
struct Course {
    own: Milestones,
    target: Milestones,
    by_phases: bool,
}

impl Course {
    /// Returns the time in the expression, in seconds, for a time of the movement; outside, the expression's nearest
    /// end.
    fn moment(&self, seconds: f64) -> f64 {
        let (own, there) = (self.own.times(), self.target.times());
        let [from, to] = [there[0], there[4]].map(Instant::seconds);
        let inside = seconds.clamp(from, to);
        if self.by_phases
            && let Some(moment) = self.own.moment_for(&self.target, inside)
        {
            return moment;
        }
        let share = (inside - from) / (to - from).max(1e-9);
        let [start, end] = [own[0], own[4]].map(Instant::seconds);
        start + share * (end - start)
    }

    /// Returns the weight of the expression at a time, from 0 to 1.
    fn weight(&self, seconds: f64) -> f64 {
        let [m1, m2, _, m4, m5] = self.target.times().map(Instant::seconds);
        let (in_from, in_to) = match m2 - m1 {
            onset if onset < EMPTY => (m1 - LEAD, m1),
            onset => (m1, m1 + onset.min(BLEND)),
        };
        let (out_from, out_to) = match m5 - m4 {
            offset if offset < EMPTY => (m5, m5 + LEAD),
            offset => (m5 - offset.min(BLEND), m5),
        };
        let rise = (seconds - in_from) / (in_to - in_from);
        let fall = (out_to - seconds) / (out_to - out_from);
        smooth(rise).min(smooth(fall))
    }

    /// Returns the time in the movement for a time of the expression.
    fn here(&self, moment: Instant) -> Instant {
        let (own, there) = (self.own.times(), self.target.times());
        let inside = moment.clamp(own[0], own[4]).seconds();
        let back = Self {
            own: self.target,
            target: self.own,
            by_phases: self.by_phases,
        };
        Instant::from_seconds(back.moment(inside)).clamp(there[0], there[4])
    }
}

fn smooth(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Applies the other performance's rotations to head and trunk; returns the number of joints of each.
fn turn(
    work: &mut Work,
    other: &Work,
    start: &Work,
    weights: &[f64],
) -> Result<(usize, usize), Cause> {
    let groups = groups(&work.skeleton, &work.anatomy);
    let hips = work.anatomy.joint(Part::Hips);
    let (mut head, mut trunk) = (0, 0);
    // A frame outside of the expression keeps its rotation to the last bit.
    let seen = |(frame, _): &(usize, &mut DQuat)| weights[*frame] > 0.0;
    for (joint, group) in groups.iter().enumerate() {
        let theirs = &other.channels[joint].rotations;
        let own = &mut work.channels[joint].rotations;
        match group {
            Group::Head => {
                head += 1;
                for (frame, own) in own.iter_mut().enumerate().filter(seen) {
                    *own = own
                        .slerp(near(*own, theirs[frame]), weights[frame])
                        .normalize();
                }
            }
            Group::Trunk if work.skeleton.parent(joint).is_some() && Some(joint) != hips => {
                trunk += 1;
                let back = start.channels[joint].rotations[0].inverse();
                for (frame, own) in own.iter_mut().enumerate().filter(seen) {
                    let turned = near(DQuat::IDENTITY, back * theirs[frame]);
                    let part = DQuat::IDENTITY.slerp(turned, weights[frame]);
                    *own = (*own * part).normalize();
                }
            }
            _ => {}
        }
    }
    match head {
        0 => Err(Cause::NoHead),
        _ => Ok((head, trunk)),
    }
}

/// Returns whichever of the two quaternions of a rotation is nearer to another quaternion.
fn near(to: DQuat, rotation: DQuat) -> DQuat {
    if to.dot(rotation) < 0.0 {
        -rotation
    } else {
        rotation
    }
}

fn is_of_trunk(curve: &Curve) -> bool {
    ["body.", "shoulders."]
        .iter()
        .any(|part| curve.name.starts_with(part))
}

fn is_of_mouth(curve: &Curve) -> bool {
    const NUMBERS: [&str; 7] = [
        "jaw_", "lips_", "mouth_", "lip_", "teeth_", "tongue_", "cheek_",
    ];
    match curve.name.split_once('.') {
        Some(("face", number)) => NUMBERS.iter().any(|part| number.starts_with(part)),
        Some((part, _)) => ["mouth", "mouthing", "teeth", "tongue"].contains(&part),
        None => false,
    }
}

/// Blends the curves of the face by weight; returns whether the mouth kept its own movement.
fn blend_curves(work: &mut Work, theirs: Vec<Curve>, weights: &[f64], span: Span) -> bool {
    let frames = work.rate.frames_in(span);
    let moves = |curve: &Curve| {
        let inside = curve.values.get(frames.start.min(curve.values.len())..);
        let inside = inside.unwrap_or_default().iter().take(frames.len());
        is_of_mouth(curve) && inside.into_iter().any(|value| value.abs() > QUIET)
    };
    let mouth = work.curves.iter().any(moves);
    let stays = |curve: &Curve| is_of_trunk(curve) || (mouth && is_of_mouth(curve));
    for curve in work.curves.iter_mut().filter(|curve| !stays(curve)) {
        for (value, weight) in curve.values.iter_mut().zip(weights) {
            *value *= 1.0 - weight;
        }
    }
    for curve in theirs.into_iter().filter(|curve| !stays(curve)) {
        let parts = curve.values.iter().zip(weights);
        let parts: Vec<f64> = parts.map(|(value, weight)| value * weight).collect();
        match work.curves.iter_mut().find(|own| own.name == curve.name) {
            Some(own) => {
                for (value, part) in own.values.iter_mut().zip(parts) {
                    *value += part;
                }
            }
            None => work.curves.push(Curve {
                name: curve.name,
                values: parts,
            }),
        }
    }
    mouth
}

/// Copies the notes about the expression, at the times that it has in this movement.
fn take_notes(work: &mut Work, theirs: &[Note], course: &Course) {
    let (here, there) = (course.target.span(), course.own.span());
    let is_carried = |note: &Note| match &note.about {
        About::Component(Component::NonManual, feature) => !matches!(
            feature.as_deref(),
            Some("mouth" | "mouthing" | "body" | "shoulders")
        ),
        _ => false,
    };
    work.notes
        .retain(|note| !(is_carried(note) && note.span.overlaps(here)));
    let carried = theirs
        .iter()
        .filter(|note| is_carried(note) && note.span.overlaps(there));
    let moved = carried.map(|note| {
        let ends = [note.span.start(), note.span.end()].map(|at| course.here(at));
        let ends = ends.map(|at| at.clamp(Instant::ZERO, work.rate.instant(work.frames)));
        Note {
            span: Span::between(ends[0], ends[1]),
            ..note.clone()
        }
    });
    let moved: Vec<Note> = moved.filter(|note| !note.span.is_empty()).collect();
    work.notes.extend(moved);
}
