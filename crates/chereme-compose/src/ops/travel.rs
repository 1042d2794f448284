//! `travel`: carries the hands along straight legs or a smooth curve.

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::SignComponent;
use chereme_sign::words::InterfaceText;

use crate::body::SignerFrame;
use crate::course::TransitionCourse;
use crate::curve::MeasuredSpline;
use crate::error::StepError;
use crate::ops::place_operator::{self, describe_reach};
use crate::ops::{component_notes, retime};
use crate::outcome::NoteSubject;
use crate::recipe_settings::{ArmSolverMethod, StraightLeg};
use crate::stroke::SignStroke;
use crate::units::{RecipeLength, RecipeSeconds};
use crate::work::{JointColumns, JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{OperatorDescription, OperatorSyntax, StepOperator, StepOutcome};
use crate::recipe_settings::{PostureTransition, TransitionProfile};
use crate::sources::{LearnedProfile, MaterialSigner};
use crate::text::{ParsedText, RecipeParser, point_text, write_option, write_separated_list};
use crate::units::{BodyDirection, HandChoice};

/// Settings of `travel right down 20cm then up 20cm`, and of `travel right through 10cm,5cm,0cm then 20cm,0cm,0cm in
/// 1.2s`: a path of straight legs, or a smooth curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TravelSettings {
    /// The hands that travel.
    #[serde(default = "crate::recipe_settings::dominant_hand_choice")]
    pub hand: HandChoice,
    /// The legs, one after another; those without a time share the remaining time by their length, no faster than people
    /// sign. The sign becomes longer if it has less time than its path.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<StraightLeg>,
    /// The points of a curve instead of legs: offsets from the hands' usual position to the left, up and forward.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub through: Vec<[RecipeLength; 3]>,
    /// The time of the curve; `None` for all of the movement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<RecipeSeconds>,
    /// The course along each leg or curve; the default is minimum jerk.
    #[serde(default, skip_serializing_if = "PostureTransition::is_default")]
    pub via: PostureTransition,
}

/// The most points of a curve.
const MOST_POINTS: usize = 64;
/// The greatest mean speed, in metres per second, of a path whose time nobody states: the sign becomes longer instead.
const MAX_MEAN_TRAVEL_SPEED: f64 = 1.2;
/// The greatest mean speeds along a stated leg or curve, in metres per second: beyond the first it is reported, beyond
/// the second no arm can do it.
const MAX_STATED_TRAVEL_SPEEDS: (f64, f64) = (1.6, 10.0);
/// The most times that a sign is stretched for its path.
const MOST_STRETCHES: usize = 3;
/// The warning about a time that a path does not have.
const UNUSED_TIME_WARNING: &str =
    "the time after \"via\" is not used: legs and curves have their own, such as left 5cm in 0.2s";
/// The learned courses along the legs.
const TRAVEL_COURSE_SLOT: AnswerSlot<LearnedProfile> = AnswerSlot::new("travel/via");

impl OperatorSyntax for TravelSettings {
    const OPERATOR_NAME: &'static str = "travel";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "travel",
        "along-path-each": "travel right down 20cm in 0.4s then up 20cm in 0.4s",
        "along-curve-left": "travel right through 10cm,8cm,0cm then 20cm,0cm,0cm in 1s"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let hand = match parser.is_length_next() {
            true => None,
            false => parser.parse_hand_choice(),
        };
        let curved = parser.accept_word("through");
        let (path, through) = match curved {
            true => (Vec::new(), parser.parse_curve_points()?),
            false => (parser.parse_straight_legs(true)?, Vec::new()),
        };
        let time = match curved && parser.accept_word("in") {
            true => Some(parser.parse_quantity("a time, such as 0.4s")?),
            false => None,
        };
        let via = parser.parse_transition()?.unwrap_or_default();
        Ok(Self {
            hand: hand.unwrap_or(HandChoice::Dominant),
            path,
            through,
            time,
            via,
        })
    }

    fn default_operator() -> Self {
        let leg = StraightLeg {
            towards: vec![BodyDirection::Right],
            distance: RecipeLength::Metres(0.2),
            time: None,
        };
        Self {
            hand: HandChoice::Dominant,
            path: vec![leg],
            through: Vec::new(),
            time: None,
            via: PostureTransition::default(),
        }
    }
}

impl Display for TravelSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "travel {} ", self.hand.hand_choice_name())?;
        write_separated_list(f, &self.path, " then ")?;
        for (n, point) in self.through.iter().enumerate() {
            f.write_str(if n == 0 { "through " } else { " then " })?;
            point_text(f, point)?;
        }
        write_option(f, "in", self.time)?;
        write!(f, "{}", self.via)
    }
}

impl StepOperator for TravelSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        let step = Self::OPERATOR_NAME;
        let refused = |what| Err(RecipeError::Empty { step, what });
        if !self.path.is_empty() && !self.through.is_empty() {
            return refused("legs and a curve are given: keep one of them");
        }
        if self.through.is_empty() {
            check::check_filled_list(step, &self.path, "no path is given")?;
            if self.time.is_some() {
                return refused("only a curve has a time; each leg has its own, such as left 5cm in 0.2s");
            }
        }
        check::check_path_legs(step, &self.path)?;
        if self.through.len() > MOST_POINTS {
            return refused("the curve has more than 64 points");
        }
        let mut lengths = self.through.iter().flatten();
        lengths.try_for_each(|distance| check::check_step_length(step, *distance))?;
        check::check_step_time(step, "the time", self.time, 600.0)?;
        check::check_step_transition(step, &self.via)
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        ask.ask_learned_courses(&TRAVEL_COURSE_SLOT, &self.via)
    }

    fn make_time(&self, work: &mut WorkingClip) -> Result<Option<String>, StepError> {
        let sides = self.hand.chosen_sides(work.handedness);
        let frame = place_operator::signer_body_frame(work, sides)?;
        let parts = self.travel_parts(&frame);
        for part in &parts {
            part.check_part_speed()?;
        }
        let from = work.working_clip_span().span_seconds();
        let mut stretched = false;
        // A slower hand counts as resting a little longer, so that the stroke is measured again.
        for _ in 0..MOST_STRETCHES {
            let stroke = SignStroke::of_work(work)?;
            let needed = needed_travel_time(&parts, stroke.stroke_seconds(work));
            if needed <= stroke.stroke_seconds(work) + 1e-9 {
                break;
            }
            let frames = (needed / work.rate.frame_time() - 1e-6).ceil() + 1.0;
            retime::stretch_movement(work, frames / stroke.frames.len() as f64)?;
            stretched = true;
        }
        if !stretched {
            return Ok(None);
        }
        let to = work.working_clip_span().span_seconds();
        Ok(Some(format!(
            "the sign became {to:.2} s long instead of {from:.2} s, so that the path has its time"
        )))
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let course = given.transition_courses(&TRAVEL_COURSE_SLOT, &self.via, TransitionProfile::MinimumJerk)?;
        let sides = self.hand.chosen_sides(work.handedness);
        let parts = self.travel_parts(&place_operator::signer_body_frame(work, sides)?);
        let warnings = parts.iter().filter_map(TravelPart::part_speed_warning).collect();
        let mut done = travel_along_path(work, self, &course.arms, given.text)?;
        if parts.len() > 1 && parts.iter().any(|part| part.time.is_some()) {
            let leg_times = travel_part_times(&parts, SignStroke::of_work(work)?.stroke_seconds(work));
            let times: Vec<String> = leg_times.iter().map(|time| format!("{time:.2} s")).collect();
            done.did.push(format!("the legs take {}", times.join(", ")));
        }
        done.warnings = warnings;
        if self.via.time.is_some() {
            done.warnings.push(UNUSED_TIME_WARNING.to_owned());
        }
        Ok(done)
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((
            ContactEffect::Same,
            ContactsToKeep::contacts_between_sides(self.hand.chosen_sides(handedness)),
        ))
    }
}

/// A leg of a path, or a whole curve.
struct TravelPart {
    /// Its length in metres.
    length: f64,
    /// Its stated time in seconds.
    time: Option<f64>,
}

impl TravelPart {
    /// Returns its mean speed, if its time is stated.
    fn stated_part_speed(&self) -> Option<f64> {
        let time = self.time?;
        (self.length > STILL_LEG_LENGTH_M).then(|| self.length / time.max(1e-9))
    }

    /// Fails if no arm is as fast as its stated time demands.
    fn check_part_speed(&self) -> Result<(), StepError> {
        match self.stated_part_speed() {
            Some(speed) if speed > MAX_STATED_TRAVEL_SPEEDS.1 => Err(StepError::TooFast {
                length: self.length,
                time: self.time.unwrap_or_default(),
                least: self.length / MAX_MEAN_TRAVEL_SPEED,
            }),
            _ => Ok(()),
        }
    }

    fn part_speed_warning(&self) -> Option<String> {
        let time = self
            .time
            .filter(|_| self.stated_part_speed() > Some(MAX_STATED_TRAVEL_SPEEDS.0))?;
        Some(format!(
            "{:.0} cm in {time:.2} s is faster than people sign",
            self.length * 100.0
        ))
    }
}

/// The length in metres below which a leg does not move the hand.
const STILL_LEG_LENGTH_M: f64 = 1e-6;

impl TravelSettings {
    fn travel_parts(&self, frame: &SignerFrame) -> Vec<TravelPart> {
        if let Some(curve) = body_space_curve(frame, &self.through) {
            return vec![TravelPart {
                length: curve.spline_length(),
                time: self.time.map(|time| time.0),
            }];
        }
        let legs = self.path.iter().map(|leg| TravelPart {
            length: leg.distance.length_in_metres(frame.arm).abs(),
            time: leg.time.map(|time| time.0),
        });
        legs.collect()
    }
}

/// Returns the time of each part; those without a stated time share what the stated ones leave of `total`, by length.
fn travel_part_times(parts: &[TravelPart], total: f64) -> Vec<f64> {
    let stated: f64 = parts.iter().filter_map(|part| part.time).sum();
    let left = (total - stated).max(0.0);
    let unstated = unstated_parts_length(parts).max(1e-9);
    let time = |part: &TravelPart| part.time.unwrap_or(left * (part.length / unstated));
    parts.iter().map(time).collect()
}

/// Returns the length of the parts without a stated time, in metres.
fn unstated_parts_length(parts: &[TravelPart]) -> f64 {
    let free = parts.iter().filter(|part| part.time.is_none());
    free.map(|part| part.length).sum()
}

/// Returns the time that the whole path needs in a movement of `total` seconds: stated times as they are, the rest no
/// faster than people sign.
fn needed_travel_time(parts: &[TravelPart], total: f64) -> f64 {
    let stated: f64 = parts.iter().filter_map(|part| part.time).sum();
    let left = (total - stated).max(0.0);
    stated + left.max(unstated_parts_length(parts) / MAX_MEAN_TRAVEL_SPEED)
}

/// Carries the hands along a path in addition to their own movement.
pub(crate) fn travel_along_path(
    work: &mut WorkingClip,
    settings: &TravelSettings,
    course: &TransitionCourse,
    operator: &str,
) -> Result<StepOutcome, StepError> {
    let sides = settings.hand.chosen_sides(work.handedness);
    let frame = place_operator::signer_body_frame(work, sides)?;
    let curve = body_space_curve(&frame, &settings.through);
    let stroke = SignStroke::of_work(work)?;
    let times = travel_part_times(&settings.travel_parts(&frame), stroke.stroke_seconds(work));
    // Seconds since the stroke began: the path begins with it.
    let now = |at: usize| at.saturating_sub(stroke.frames.start) as f64 * work.rate.frame_time();
    let displacements: Vec<DVec3> = match &curve {
        Some(curve) => (0..work.frames)
            .map(|at| curve.spline_point_at(course.covered_path_share((now(at) / times[0].max(1e-9)).min(1.0))))
            .collect(),
        None => {
            let legs = timed_path_legs(&frame, &settings.path, &times);
            (0..work.frames)
                .map(|at| displacement(&legs, now(at), course))
                .collect()
        }
    };
    let before = work.clone();
    let reach = place_operator::move_wrists_to(work, sides, ArmSolverMethod::Analytic, &stroke, |_, frame, at| {
        at + displacements[frame]
    })?;
    let still = sides.iter().all(|&side| is_still(&before, side, &stroke));
    withdraw_moved_notes(work, sides, operator);
    if still {
        note_drawn_path(work, &frame, &stroke, sides, &settings.path, curve.as_ref(), operator);
    }
    let legs = settings.path.iter();
    let length: f64 = legs.map(|leg| leg.distance.length_in_metres(frame.arm)).sum();
    let path = match (&curve, settings.path.len()) {
        (Some(curve), _) => {
            let cm = curve.spline_length() * 100.0;
            format!("a curve of {cm:.0} cm ({})", curve.spline_shape_name())
        }
        (None, 1) => format!("1 leg, {:.0} cm in all", length * 100.0),
        (None, count) => format!("{count} legs, {:.0} cm in all", length * 100.0),
    };
    let mut did = vec![path];
    did.extend(stroke.describe_rests(work));
    did.extend(describe_reach(&reach));
    Ok(StepOutcome::with_residual(did, reach.residual))
}

/// Returns the curve through points of body space, in model space; `None` without points.
fn body_space_curve(frame: &SignerFrame, through: &[[RecipeLength; 3]]) -> Option<MeasuredSpline> {
    let point = |at: &[RecipeLength; 3]| {
        let [left, up, forward] = at.map(|length| length.length_in_metres(frame.arm));
        frame.model_direction_of(DVec3::new(left, up, forward))
    };
    let points: Vec<DVec3> = through.iter().map(point).collect();
    (!points.is_empty()).then(|| MeasuredSpline::new(&points))
}

/// A leg of a path in model space.
struct PathLeg {
    /// When it begins, in seconds since the path began.
    start: f64,
    /// How long it takes, in seconds.
    time: f64,
    /// Where it begins, and the way from there.
    from: DVec3,
    by: DVec3,
}

/// Returns the legs one after another; they take these times.
fn timed_path_legs(frame: &SignerFrame, path: &[StraightLeg], times: &[f64]) -> Vec<PathLeg> {
    let (mut start, mut from) = (0.0, DVec3::ZERO);
    let mut legs = Vec::with_capacity(path.len());
    for (leg, &time) in path.iter().zip(times) {
        let by = frame.leg_in_model(leg);
        legs.push(PathLeg { start, time, from, by });
        (start, from) = (start + time, from + by);
    }
    legs
}

/// Returns the displacement of the hands `now` seconds after the path began.
fn displacement(legs: &[PathLeg], now: f64, course: &TransitionCourse) -> DVec3 {
    let begun = legs.iter().rev().find(|leg| now >= leg.start);
    begun.map_or(DVec3::ZERO, |leg| {
        let w = match leg.time > 0.0 {
            true => (now - leg.start) / leg.time,
            false => 1.0,
        };
        leg.from + leg.by * course.covered_path_share(w)
    })
}

/// The largest movement, in metres, of a wrist that counts as still.
pub(crate) const STILL_WRIST_MOVEMENT_M: f64 = 0.03;

pub(crate) fn wrist_path(work: &WorkingClip, side: BodySide) -> Result<Vec<DVec3>, StepError> {
    let hand = work.anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?.hand;
    Ok(JointColumns::joint_columns_of(work, [hand])
        .joint_positions(hand)
        .to_vec())
}

/// Returns whether a wrist keeps its position in the stroke.
fn is_still(work: &WorkingClip, side: BodySide, stroke: &SignStroke) -> bool {
    let full_path = wrist_path(work, side).unwrap_or_default();
    let path = full_path.get(stroke.frames.clone()).unwrap_or_default();
    path.iter().all(|at| at.distance(path[0]) < STILL_WRIST_MOVEMENT_M)
}

/// Notes the new path of hands that were still before: straight if it has one leg, else the shape of the curve.
fn note_drawn_path(
    work: &mut WorkingClip,
    frame: &SignerFrame,
    stroke: &SignStroke,
    sides: &[BodySide],
    path: &[StraightLeg],
    curve: Option<&MeasuredSpline>,
    operator: &str,
) {
    let all = stroke.frames.clone();
    for &side in sides {
        let shape = curve.map(MeasuredSpline::spline_shape_name);
        // A circle ends where it began, and a path of several legs has no one direction.
        let one = match (path, curve) {
            (_, Some(curve)) if shape != Some("circle") && shape != Some("path") => {
                component_notes::nearest_direction_name(frame.to_body(curve.spline_point_at(1.0)))
            }
            ([leg], _) => component_notes::nearest_direction_name(frame.to_body(frame.leg_in_model(leg))),
            _ => None,
        };
        let shape = shape.unwrap_or(if one.is_some() { "straight" } else { "path" });
        let movement = |part: Option<&str>| NoteSubject::Component(SignComponent::Movement, part.map(str::to_owned));
        component_notes::record_component_value(work, side, movement(None), shape, all.clone(), operator);
        if let Some(direction) = one {
            let what = movement(Some("direction"));
            component_notes::record_component_value(work, side, what, &direction, all.clone(), operator);
        }
    }
}

/// Withdraws notes on the place and the movement of hands whose movement changed; phases stay.
pub(crate) fn withdraw_moved_notes(work: &mut WorkingClip, sides: &[BodySide], operator: &str) {
    component_notes::withdraw_hand_notes(work, sides, operator, |component, feature| match component {
        SignComponent::Placement => true,
        SignComponent::Movement => feature != Some("phase"),
        _ => false,
    });
    work.note_changed_groups(sides.iter().map(|&side| JointGroup::Arm(side)), operator);
}
