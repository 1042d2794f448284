//! `nonmanual … over … by phases`: transfers an expression of the face to other signs, phase by phase.

use chereme_motion::glam::DQuat;
use chereme_motion::interpolation::smooth_step;
use chereme_motion::{BodyPart, RecordingInstant, TimeSpan};
use chereme_sign::SignComponent;
use chereme_sign::milestones::{
    ExpressionFunction, ExpressionMilestones, UTTERANCE_EDGE_MICROS, find_expression_milestones,
};

use crate::error::StepError;
use crate::face_parts::FacePart;
use crate::ops::nonmanual_operator::{ExpressionTimes, NonmanualSettings, donor_on_body};
use crate::outcome::{GeneratedCurve, GeneratedNote, NoteSubject};
use crate::recipe_inputs::ExpressionInput;
use crate::sources::MovementMaterial;
use crate::work::{JointGroup, WorkingClip, find_joint_groups};

/// The longest time in which an expression fades in or out, in seconds.
const EXPRESSION_BLEND_S: f64 = 0.2;
/// The fading time before and after an expression without an onset or offset, in seconds.
const EXPRESSION_LEAD_S: f64 = 0.1;
/// The length in seconds below which a phase counts as empty.
const EMPTY_PHASE_S: f64 = 1e-6;
/// The value up to which a curve of the mouth counts as at rest.
const QUIET_MOUTH_VALUE: f64 = 0.05;

/// Gives head, trunk and face an expression from another performance, each phase stretched to the same phase here.
///
/// Outside of the expression nothing changes. A mouth that moves in these signs keeps its own movement. The trunk adds
/// the other's rotations relative to M1 to its own, so that it keeps its posture.
pub(crate) fn transfer_expression(
    work: &mut WorkingClip,
    donor: &MovementMaterial,
    settings: &NonmanualSettings,
    given: &ExpressionInput,
    operator: &str,
) -> Result<Vec<String>, StepError> {
    let given_milestones = given.milestones;
    let target = target_milestones(work, settings.over, given);
    let course = ExpressionCourse {
        own: given_milestones,
        target,
        by_phases: settings.by_phases,
    };
    let mut other = donor_on_body(work, donor)?;
    let per_second = other.rate.per_second();
    let mut start = other.clone();
    // The posture at M1 is rest: the trunk takes over only how it differs from it.
    start.resample_channels(&[given_milestones.milestone_times()[0].instant_seconds() * per_second]);
    let seconds = |frame: usize| work.rate.frame_start_instant(frame).instant_seconds();
    let sample_positions: Vec<f64> = (0..work.frames)
        .map(|frame| course.expression_moment(seconds(frame)) * per_second)
        .collect();
    let weights: Vec<f64> = (0..work.frames)
        .map(|frame| course.expression_weight(seconds(frame)))
        .collect();
    other.resample_channels(&sample_positions);
    let (head, trunk) = turn_head_and_trunk(work, &other, &start, &weights)?;
    let mouth = moves_mouth(work, target.milestone_span());
    let stays = |curve: &GeneratedCurve| is_of_trunk(curve) || (mouth && is_of_mouth(curve));
    blend_curves(work, other.curves, &weights, stays);
    take_notes(work, &other.notes, &course);
    work.note_changed_groups([JointGroup::Head, JointGroup::Trunk], operator);
    let mut did = vec![
        format!(
            "{} from {}: {given_milestones} onto {target}",
            given.function, donor.address
        ),
        format!("{head} joints of the head and {trunk} of the trunk"),
    ];
    if mouth {
        did.push("the mouth keeps its own movement".to_owned());
    }
    if target.milestone_span().span_start_instant() < RecordingInstant::RECORDING_START {
        let before = -target.milestone_span().span_start_instant().instant_seconds();
        did.push(format!(
            "the first {before:.2} s lie before the movement and are not seen"
        ));
    }
    if target.milestone_span().span_end_instant() > work.working_clip_end() {
        let after =
            target.milestone_span().span_end_instant().instant_seconds() - work.working_clip_end().instant_seconds();
        did.push(format!("the last {after:.2} s lie after the movement and are not seen"));
    }
    Ok(did)
}

/// Returns the milestones of the expression in this movement.
fn target_milestones(
    work: &WorkingClip,
    over: Option<ExpressionTimes>,
    given: &ExpressionInput,
) -> ExpressionMilestones {
    let full_span = work.working_clip_span();
    let part = match over {
        Some(ExpressionTimes::At(times)) => {
            return ExpressionMilestones::of_times(times.map(|at| RecordingInstant::from_seconds(at.0)));
        }
        Some(ExpressionTimes::Part(cut)) => TimeSpan::span_between(
            cut.from.map_or(full_span.span_start_instant(), |from| {
                RecordingInstant::from_seconds(from.0)
            }),
            cut.to
                .map_or(full_span.span_end_instant(), |to| RecordingInstant::from_seconds(to.0)),
        ),
        None => full_span,
    };
    // Without annotated signs the expression spans the part, with the share of its phases kept.
    signed_milestones(work, part, &given.function).unwrap_or_else(|| {
        let given_milestones = given.milestones;
        let share = |m3: RecordingInstant| {
            let body = given_milestones.expression_body_span();
            (m3.instant_seconds() - body.span_start_instant().instant_seconds()) / body.span_seconds().max(1e-9)
        };
        let m3 = given_milestones
            .m3
            .map(|m3| share(m3).clamp(0.0, 1.0) * part.span_seconds());
        ExpressionMilestones {
            // An expression begins before the first sign and fades after the last.
            m1: part.span_start_instant().shifted_instant(-UTTERANCE_EDGE_MICROS),
            m2: part.span_start_instant(),
            m3: m3.map(|after| RecordingInstant::from_seconds(part.span_start_instant().instant_seconds() + after)),
            m4: part.span_end_instant(),
            m5: part.span_end_instant().shifted_instant(UTTERANCE_EDGE_MICROS),
        }
    })
}

/// Returns milestones over the signs whose middles lie in `part`; `None` without such a sign.
fn signed_milestones(
    work: &WorkingClip,
    part: TimeSpan,
    function: &ExpressionFunction,
) -> Option<ExpressionMilestones> {
    let glosses = work.notes.iter().filter(|note| note.about == NoteSubject::Gloss);
    let mut signs: Vec<TimeSpan> = glosses.map(|note| note.span).collect();
    signs.sort_by_key(|span| (span.span_start_instant(), span.span_end_instant()));
    signs.dedup();
    let middle = |span: &TimeSpan| span.span_start_instant().shifted_instant(span.span_micros() / 2);
    let inside = |span: &TimeSpan| part.has_instant(middle(span));
    let first = signs.iter().position(inside)?;
    let last = signs.iter().rposition(inside)?;
    find_expression_milestones(&signs, first..last + 1, function, UTTERANCE_EDGE_MICROS)
}

/// Maps times of the movement to times of the expression, and gives its weight.
struct ExpressionCourse {
    own: ExpressionMilestones,
    target: ExpressionMilestones,
    by_phases: bool,
}

impl ExpressionCourse {
    /// Returns the time in the expression, in seconds, for a time of the movement; outside, the expression's nearest
    /// end.
    fn expression_moment(&self, seconds: f64) -> f64 {
        let (own, there) = (self.own.milestone_times(), self.target.milestone_times());
        let [from, to] = [there[0], there[4]].map(RecordingInstant::instant_seconds);
        let inside = seconds.clamp(from, to);
        if self.by_phases
            && let Some(moment) = self.own.moment_for(&self.target, inside)
        {
            return moment;
        }
        let share = (inside - from) / (to - from).max(1e-9);
        let [start, end] = [own[0], own[4]].map(RecordingInstant::instant_seconds);
        start + share * (end - start)
    }

    /// Returns the weight of the expression at a time, from 0 to 1.
    fn expression_weight(&self, seconds: f64) -> f64 {
        let [m1, m2, _, m4, m5] = self.target.milestone_times().map(RecordingInstant::instant_seconds);
        let (in_from, in_to) = match m2 - m1 {
            onset if onset < EMPTY_PHASE_S => (m1 - EXPRESSION_LEAD_S, m1),
            onset => (m1, m1 + onset.min(EXPRESSION_BLEND_S)),
        };
        let (out_from, out_to) = match m5 - m4 {
            offset if offset < EMPTY_PHASE_S => (m5, m5 + EXPRESSION_LEAD_S),
            offset => (m5 - offset.min(EXPRESSION_BLEND_S), m5),
        };
        let rise = (seconds - in_from) / (in_to - in_from);
        let fall = (out_to - seconds) / (out_to - out_from);
        smooth_step(rise).min(smooth_step(fall))
    }

    /// Returns the time in the movement for a time of the expression.
    fn movement_time_for(&self, moment: RecordingInstant) -> RecordingInstant {
        let (own, there) = (self.own.milestone_times(), self.target.milestone_times());
        let inside = moment.clamp(own[0], own[4]).instant_seconds();
        let back = Self {
            own: self.target,
            target: self.own,
            by_phases: self.by_phases,
        };
        RecordingInstant::from_seconds(back.expression_moment(inside)).clamp(there[0], there[4])
    }
}

/// Applies the other performance's rotations to head and trunk; returns the number of joints of each.
fn turn_head_and_trunk(
    work: &mut WorkingClip,
    other: &WorkingClip,
    start: &WorkingClip,
    weights: &[f64],
) -> Result<(usize, usize), StepError> {
    let groups = find_joint_groups(&work.skeleton, &work.anatomy);
    let hips = work.anatomy.part_joint(BodyPart::Hips);
    let (mut head, mut trunk) = (0, 0);
    // A frame outside of the expression keeps its rotation to the last bit.
    let seen = |(frame, _): &(usize, &mut DQuat)| weights[*frame] > 0.0;
    for (joint, group) in groups.iter().enumerate() {
        let theirs = &other.channels[joint].rotations;
        let joint_rotations = &mut work.channels[joint].rotations;
        match group {
            JointGroup::Head => {
                head += 1;
                for (frame, own) in joint_rotations.iter_mut().enumerate().filter(seen) {
                    *own = own
                        .slerp(nearer_quaternion(*own, theirs[frame]), weights[frame])
                        .normalize();
                }
            }
            JointGroup::Trunk if work.skeleton.joint_parent(joint).is_some() && Some(joint) != hips => {
                trunk += 1;
                let back = start.channels[joint].rotations[0].inverse();
                for (frame, own) in joint_rotations.iter_mut().enumerate().filter(seen) {
                    let turned = nearer_quaternion(DQuat::IDENTITY, back * theirs[frame]);
                    let part = DQuat::IDENTITY.slerp(turned, weights[frame]);
                    *own = (*own * part).normalize();
                }
            }
            _ => {}
        }
    }
    match head {
        0 => Err(StepError::NoHead),
        _ => Ok((head, trunk)),
    }
}

/// Returns whichever of the two quaternions of a rotation is nearer to another quaternion.
fn nearer_quaternion(to: DQuat, rotation: DQuat) -> DQuat {
    if to.dot(rotation) < 0.0 { -rotation } else { rotation }
}

pub(crate) fn is_of_trunk(curve: &GeneratedCurve) -> bool {
    ["body.", "shoulders."].iter().any(|part| curve.name.starts_with(part))
}

fn is_of_mouth(curve: &GeneratedCurve) -> bool {
    matches!(
        FacePart::of_curve_name(&curve.name),
        Some(FacePart::Mouth | FacePart::Cheeks)
    )
}

/// Returns whether the mouth moves in a span.
fn moves_mouth(work: &WorkingClip, span: TimeSpan) -> bool {
    let frames = work.rate.frames_in(span);
    let moves = |curve: &GeneratedCurve| {
        let curve_part = curve.values.get(frames.start.min(curve.values.len())..);
        let inside = curve_part.unwrap_or_default().iter().take(frames.len());
        is_of_mouth(curve) && inside.into_iter().any(|value| value.abs() > QUIET_MOUTH_VALUE)
    };
    work.curves.iter().any(moves)
}

/// Blends curves by weight, but for those that stay as they are.
pub(crate) fn blend_curves(
    work: &mut WorkingClip,
    theirs: Vec<GeneratedCurve>,
    weights: &[f64],
    stays: impl Fn(&GeneratedCurve) -> bool,
) {
    for curve in work.curves.iter_mut().filter(|curve| !stays(curve)) {
        for (value, weight) in curve.values.iter_mut().zip(weights) {
            *value *= 1.0 - weight;
        }
    }
    for curve in theirs.into_iter().filter(|curve| !stays(curve)) {
        let weighted_values = curve.values.iter().zip(weights);
        let parts: Vec<f64> = weighted_values.map(|(value, weight)| value * weight).collect();
        match work.curves.iter_mut().find(|own| own.name == curve.name) {
            Some(own) => {
                for (value, part) in own.values.iter_mut().zip(parts) {
                    *value += part;
                }
            }
            None => work.curves.push(GeneratedCurve {
                name: curve.name,
                values: parts,
            }),
        }
    }
}

/// Copies the notes about the expression, at the times that it has in this movement.
fn take_notes(work: &mut WorkingClip, theirs: &[GeneratedNote], course: &ExpressionCourse) {
    let (here, there) = (course.target.milestone_span(), course.own.milestone_span());
    let is_carried = |note: &GeneratedNote| match &note.about {
        NoteSubject::Component(SignComponent::NonManual, feature) => {
            !matches!(feature.as_deref(), Some("mouth" | "mouthing" | "body" | "shoulders"))
        }
        _ => false,
    };
    work.notes
        .retain(|note| !(is_carried(note) && note.span.is_overlapping_span(here)));
    let carried = theirs
        .iter()
        .filter(|note| is_carried(note) && note.span.is_overlapping_span(there));
    let moved = carried.map(|note| {
        let mapped_ends =
            [note.span.span_start_instant(), note.span.span_end_instant()].map(|at| course.movement_time_for(at));
        let ends = mapped_ends.map(|at| {
            at.clamp(
                RecordingInstant::RECORDING_START,
                work.rate.frame_start_instant(work.frames),
            )
        });
        GeneratedNote {
            span: TimeSpan::span_between(ends[0], ends[1]),
            ..note.clone()
        }
    });
    let moved: Vec<GeneratedNote> = moved.filter(|note| !note.span.is_empty()).collect();
    work.notes.extend(moved);
}
