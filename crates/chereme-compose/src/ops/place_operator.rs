//! `place`: moves the hands elsewhere; they keep their movement and rotations.

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::words::InterfaceText;

use crate::arm::{self, HELP_FROM, WristReach};
use crate::body::{self, SignerFrame};
use crate::error::StepError;
use crate::ops::{OperatorDescription, clear, component_notes};
use crate::recipe_inputs::PlaceInput;
use crate::recipe_settings::{ArmSolverMethod, RecipeHandPoint};
use crate::stroke::SignStroke;
use crate::work::{JointColumns, JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{self, AnswerSlot, CorpusAsker, NodeAnswers};
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{OperatorNeighbours, OperatorSyntax, Step, StepOperator, StepOutcome};
use crate::recipe_settings::StraightLeg;
use crate::sources::{MaterialSigner, MovementMaterial};
use crate::text::{ParsedText, QuotedName, RecipeParser, point_text, write_option, write_separated_list};
use crate::units::{BodyDirection, HandChoice, RecipeLength};

mod anchor;

use anchor::find_placement_anchor;

/// Settings of `place both by left 25cm`, `place right at chin`, `place left near BOL`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceSettings {
    /// The hands that move; two hands move by the same displacement, but each to its own side of a place on both
    /// sides, such as a shoulder.
    #[serde(default = "crate::recipe_settings::both_hands_choice")]
    pub hand: HandChoice,
    /// The goal.
    pub to: PlacementGoal,
    /// The point of the hand that comes to the goal; `None` for the point that touches the body in the sign, else the
    /// palm. With `by`, all points move alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<RecipeHandPoint>,
    /// The method that finds the arm's posture; `using fabrik`.
    #[serde(default, skip_serializing_if = "ArmSolverMethod::is_default")]
    pub solver: ArmSolverMethod,
}

/// The goal of a placement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PlacementGoal {
    /// A displacement by the sum of these, each in the signer's own directions.
    By(Vec<StraightLeg>),
    /// A placement of an inventory.
    At(String),
    /// A point of body space: metres to the left, up from the floor, and forward.
    AtPoint([RecipeLength; 3]),
    /// The hand's position in another sign, by its address, plus a displacement.
    Near {
        /// The other sign.
        of: String,
        /// The displacement from there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        by: Vec<StraightLeg>,
    },
    /// The hand's position in the best answer to a query.
    Best(String),
}

/// The place of the goal.
const PLACE_GOAL_SLOT: AnswerSlot<PlaceInput> = AnswerSlot::new("place/to");

impl OperatorSyntax for PlaceSettings {
    const OPERATOR_NAME: &'static str = "place";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "place",
        "another-place-moved": "place both by left 25cm up 5cm",
        "at-placement-touched": "place right at chin with index",
        "at-point-left": "place right at 0cm,120cm,40cm",
        "at-place-another": "place both near BOL by up 5cm",
        "with-another-solver": "place both by up 10cm using fabrik"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let hand = parser.parse_hand_choice().unwrap_or(HandChoice::Both);
        let mut place = Self {
            hand,
            to: parse_placement_goal(parser)?,
            with: None,
            solver: ArmSolverMethod::Analytic,
        };
        loop {
            if parser.accept_word("with") {
                let points = &RecipeHandPoint::ALL_HAND_POINTS;
                let point = parser.one_of(points, RecipeHandPoint::hand_point_name, "a point of the hand")?;
                place.with = Some(point);
            } else if parser.accept_word("using") {
                place.solver = parser.one_of(
                    &ArmSolverMethod::ALL_ARM_SOLVERS,
                    ArmSolverMethod::arm_solver_name,
                    "a solver",
                )?;
            } else {
                return Ok(place);
            }
        }
    }

    fn default_operator() -> Self {
        let leg = StraightLeg {
            towards: vec![BodyDirection::Up],
            distance: RecipeLength::Metres(0.1),
            time: None,
        };
        Self {
            hand: HandChoice::Both,
            to: PlacementGoal::By(vec![leg]),
            with: None,
            solver: ArmSolverMethod::Analytic,
        }
    }
}

fn parse_placement_goal(parser: &mut RecipeParser<'_>) -> ParsedText<PlacementGoal> {
    if parser.accept_word("by") {
        return parser.parse_straight_legs(false).map(PlacementGoal::By);
    }
    if parser.accept_word("near") || parser.accept_word("from") {
        let of = parser.parse_recipe_name("a sign")?;
        let by = match parser.accept_word("by") {
            true => parser.parse_straight_legs(false)?,
            false => Vec::new(),
        };
        return Ok(PlacementGoal::Near { of, by });
    }
    if !parser.accept_word("at") {
        let words = ["by", "at", "near", "right", "left", "both", "dominant", "weak"];
        return Err(parser.expected_text_error("a hand, \"by\", \"at\" or \"near\"", &words));
    }
    if let Some(query) = parser.parse_query_text()? {
        return Ok(PlacementGoal::Best(query));
    }
    if let Some(point) = parser.spot_point()? {
        return Ok(PlacementGoal::AtPoint(point));
    }
    let named = parser.parse_recipe_name("a placement or a point such as 0cm,120cm,30cm")?;
    Ok(PlacementGoal::At(named))
}

impl Display for PlaceSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "place {} ", self.hand.hand_choice_name())?;
        match &self.to {
            PlacementGoal::By(legs) => {
                f.write_str("by ")?;
                write_separated_list(f, legs, " ")?;
            }
            PlacementGoal::At(value) => write!(f, "at {}", QuotedName(value))?,
            PlacementGoal::AtPoint(point) => {
                f.write_str("at ")?;
                point_text(f, point)?;
            }
            PlacementGoal::Near { of, by } => {
                write!(f, "near {}", QuotedName(of))?;
                if !by.is_empty() {
                    f.write_str(" by ")?;
                    write_separated_list(f, by, " ")?;
                }
            }
            PlacementGoal::Best(query) => write!(f, "at best({query})")?,
        }
        write_option(f, "with", self.with.map(RecipeHandPoint::hand_point_name))?;
        let solver = (!self.solver.is_default()).then(|| self.solver.arm_solver_name());
        write_option(f, "using", solver)
    }
}

impl StepOperator for PlaceSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        let step = Self::OPERATOR_NAME;
        match &self.to {
            PlacementGoal::By(legs) => {
                check::check_filled_list(step, legs, "no path is given")?;
                check::check_path_legs(step, legs)
            }
            PlacementGoal::Near { of, by } => {
                check::check_named_text(step, of, "the name of the sign is empty")?;
                check::check_path_legs(step, by)
            }
            PlacementGoal::At(value) => check::check_named_text(step, value, "the name of the placement is empty"),
            PlacementGoal::Best(query) => check::check_named_text(step, query, "the query is empty"),
            PlacementGoal::AtPoint(point) => point.iter().try_for_each(|&at| check::check_step_length(step, at)),
        }
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, setting: &MaterialSigner) -> Result<(), StepError> {
        let place_input = match &self.to {
            PlacementGoal::By(_) | PlacementGoal::AtPoint(_) => return Ok(()),
            PlacementGoal::At(value) => ask.find_value_place(value)?,
            PlacementGoal::Near { of, .. } => self.shown_in(&ask.sources.find_material(of)?, setting)?,
            PlacementGoal::Best(query) => {
                let best_matches = ask.sources.find_best_examples(query, setting.signer.as_deref())?;
                let Some(first) = best_matches.first() else {
                    return Err(StepError::NothingFound(query.clone()));
                };
                self.shown_in(&ask.sources.find_material(&first.address)?, setting)?
            }
        };
        ask.put_answer(&PLACE_GOAL_SLOT, place_input);
        Ok(())
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        place_working_hands(work, self, given.get_answer(&PLACE_GOAL_SLOT), given.text)
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((
            ContactEffect::Same,
            ContactsToKeep::contacts_between_sides(self.hand.chosen_sides(handedness)),
        ))
    }

    fn is_nothing(&self) -> bool {
        match &self.to {
            PlacementGoal::By(legs) => legs.iter().all(|leg| leg.distance.is_zero()),
            PlacementGoal::At(_) | PlacementGoal::AtPoint(_) | PlacementGoal::Near { .. } | PlacementGoal::Best(_) => {
                false
            }
        }
    }

    fn relation_to_previous(&self, before: &mut Step) -> OperatorNeighbours {
        let Step::Place(before) = before else {
            return OperatorNeighbours::Apart;
        };
        match (&mut before.to, &self.to) {
            (PlacementGoal::By(legs), PlacementGoal::By(more))
                if before.hand == self.hand && before.solver == self.solver =>
            {
                legs.extend(more.iter().cloned());
                OperatorNeighbours::One
            }
            _ => OperatorNeighbours::Apart,
        }
    }
}

impl PlaceSettings {
    /// Returns the position of the hands in another sign.
    fn shown_in(&self, material: &MovementMaterial, setting: &MaterialSigner) -> Result<PlaceInput, StepError> {
        let has = |side: &&BodySide| material.anatomy.arm_chain(**side).is_some();
        let sides = self.hand.chosen_sides(setting.handedness).iter();
        let shown: Vec<BodySide> = sides.filter(has).copied().collect();
        answers::find_shown_place(material, &shown, self.with)
    }
}

/// The distance in metres of one of two hands from the place of their middle, beyond which the hand is not at the place.
const HAND_PLACE_DISTANCE_M: f64 = 0.25;

/// Hands that move together.
struct HandShift<'a> {
    sides: &'a [BodySide],
    by: DVec3,
    /// The frames in which they are at the place.
    frames: Range<usize>,
    /// The goal, and the point of the hands that comes to it; `None` for a mere displacement.
    spot: Option<(DVec3, RecipeHandPoint)>,
}

/// A placement in the making.
struct PlacementPlan<'a> {
    settings: &'a PlaceSettings,
    input: Option<&'a PlaceInput>,
    frame: SignerFrame,
    stroke: SignStroke,
}

impl<'a> PlacementPlan<'a> {
    /// Returns the displacement of hands that move together, and adds the moment that determines it to a description.
    fn placement_hand_shift(
        &self,
        work: &WorkingClip,
        sides: &'a [BodySide],
        did: &mut Vec<String>,
    ) -> Result<HandShift<'a>, StepError> {
        let frame = &self.frame;
        let goal = match (&self.settings.to, self.input) {
            (PlacementGoal::By(legs), _) => {
                return Ok(HandShift {
                    sides,
                    by: frame.sum_path_legs(legs),
                    frames: self.stroke.frames.clone(),
                    spot: None,
                });
            }
            (PlacementGoal::AtPoint(at), _) => frame.body_point_at(at),
            (PlacementGoal::Near { by, .. }, Some(input)) => {
                spatial_place_position(work, frame, input, sides[0])? + frame.sum_path_legs(by)
            }
            (_, Some(input)) => spatial_place_position(work, frame, input, sides[0])?,
            (_, None) => return Err(StepError::Input),
        };
        let anchor = find_placement_anchor(work, &self.stroke, sides, self.settings.with);
        let now = anchor.anchor_position(work, sides).ok_or(StepError::NoArm(sides[0]))?;
        did.extend(anchor.describe_placement_anchor(work));
        Ok(HandShift {
            sides,
            by: goal - now,
            spot: Some((goal, anchor.point)),
            frames: anchor.frames,
        })
    }
}

/// Returns whether a place is on both sides of the body, so that each of two hands has its own. Fails for places on
/// the hands and forearms that move to it.
fn is_sided(place: &PlaceInput) -> Result<bool, StepError> {
    let landmark = &place.at.landmark;
    let sided_names = ["ipsi-", "contra-"].map(|side| landmark.strip_prefix(side));
    let sided = sided_names[0].or(sided_names[1]);
    let arm_points = ["elbow", "forearm", "wrist", "palm"];
    match sided {
        Some(name) if arm_points.contains(&name) || name.contains("hand-") || name.ends_with("-tip") => {
            let value = place.value.clone();
            Err(StepError::BothMove(value.unwrap_or_else(|| name.to_owned())))
        }
        sided => Ok(sided.is_some()),
    }
}

/// Moves the hands.
fn place_working_hands(
    work: &mut WorkingClip,
    settings: &PlaceSettings,
    input: Option<&PlaceInput>,
    operator: &str,
) -> Result<StepOutcome, StepError> {
    let sides = settings.hand.chosen_sides(work.handedness);
    let frame = signer_body_frame(work, sides)?;
    let apart = match input.filter(|_| sides.len() > 1) {
        Some(place) => is_sided(place)?,
        None => false,
    };
    let mut notes = Vec::new();
    let mut shifts = Vec::new();
    let placing = PlacementPlan {
        settings,
        input,
        frame,
        stroke: SignStroke::of_work(work)?,
    };
    for together in sides.chunks(if apart { 1 } else { sides.len() }) {
        shifts.push(placing.placement_hand_shift(work, together, &mut notes)?);
    }
    let near = matches!(&settings.to, PlacementGoal::Near { by, .. } if !by.is_empty());
    // A hand beside the place does not have the place's value.
    let value = input.and_then(|input| input.value.clone()).filter(|_| !near);
    let before = work.clone();
    let (stroke, solver) = (&placing.stroke, settings.solver);
    let rest = stroke.describe_rests(work);
    let mut reach = move_wrists_to(work, sides, solver, stroke, |side, _, at| {
        let side_shift = shifts.iter().find(|shift| shift.sides.contains(&side));
        at + side_shift.map_or(DVec3::ZERO, |shift| shift.by)
    })?;
    let mut kept_out = Vec::new();
    let mut moved = Vec::new();
    for shift in &shifts {
        let (by, frames) = (shift.by, &shift.frames);
        for &side in shift.sides {
            // A mere displacement is taken at its word.
            if !matches!(settings.to, PlacementGoal::By(_))
                && let Some(cleared) = clear::clear_hand_of_body(work, &before, side, settings.solver)
            {
                reach.residual = reach.residual.max(cleared.largest_shift_in(frames));
                kept_out.push(cleared.describe_clearing_shift(work, side, frames));
            }
        }
        for &side in shift.sides {
            // Of two hands far apart only their middle is at the place.
            let away = shift
                .spot
                .filter(|_| shift.sides.len() > 1 && value.is_some())
                .and_then(|(goal, point)| {
                    let hand_point = body::mean_point(work, &[side], point)?;
                    Some(hand_point.distance(goal)).filter(|away| *away > HAND_PLACE_DISTANCE_M)
                });
            if let Some(away) = away {
                notes.push(format!(
                    "the {} hand is {:.1} cm away from the place, so its placement is left open",
                    side.body_side_name(),
                    away * 100.0
                ));
            }
            if by != DVec3::ZERO || value.is_some() {
                let value = value.as_deref().filter(|_| away.is_none());
                component_notes::record_placement_note(work, side, value, frames.clone(), operator);
            }
        }
        if by != DVec3::ZERO {
            let arms = shift.sides.iter().map(|&side| JointGroup::Arm(side));
            work.note_changed_groups(arms, operator);
        }
        let offset = describe_displacement_cm(frame.to_body(by) * 100.0);
        moved.push(match apart {
            true => format!("the {} hand is moved {offset}", shift.sides[0].body_side_name()),
            false => format!("moved {offset}"),
        });
    }
    let mut did = moved;
    did.extend(notes);
    did.extend(kept_out);
    if let Some(input) = input {
        did.push(format!("the place is from {}", input.from));
    }
    did.extend(rest);
    did.extend(describe_reach(&reach));
    let one = shifts.first().filter(|_| !apart);
    Ok(StepOutcome {
        moved: one.map(|shift| frame.to_body(shift.by).to_array()),
        ..StepOutcome::with_residual(did, reach.residual)
    })
}

/// Describes a displacement in centimetres for people, each part with its direction.
fn describe_displacement_cm(cm: DVec3) -> String {
    let part = |length: f64, to: &str, back: &str| {
        let direction = if length < 0.0 { back } else { to };
        format!("{:.1} cm {direction}", length.abs())
    };
    let parts = [
        part(cm.x, "left", "right"),
        part(cm.y, "up", "down"),
        part(cm.z, "forward", "back"),
    ];
    parts.join(", ")
}

fn spatial_place_position(
    work: &WorkingClip,
    frame: &SignerFrame,
    input: &PlaceInput,
    side: BodySide,
) -> Result<DVec3, StepError> {
    frame
        .hand_place_in_model(work, &input.at, side)
        .ok_or_else(|| StepError::NoMeaning {
            value: input.value.clone().unwrap_or_else(|| input.at.landmark.clone()),
            what: "landmark that this skeleton has",
        })
}

/// Returns the body's frame. Fails with the missing arm if the body lacks one.
pub(crate) fn signer_body_frame(work: &WorkingClip, sides: &[BodySide]) -> Result<SignerFrame, StepError> {
    if let Some(&side) = sides.iter().find(|&&side| work.anatomy.arm_chain(side).is_none()) {
        return Err(StepError::NoArm(side));
    }
    SignerFrame::from_mean_posture(work).ok_or(StepError::NoArm(sides[0]))
}

/// Moves wrists to the positions that `target` returns for a hand, a frame and the present position; in rest before and
/// after the stroke they stay.
pub(crate) fn move_wrists_to(
    work: &mut WorkingClip,
    sides: &[BodySide],
    solver: ArmSolverMethod,
    stroke: &SignStroke,
    target: impl Fn(BodySide, usize, DVec3) -> DVec3,
) -> Result<WristReach, StepError> {
    let mut worst = WristReach::default();
    let hand = |side: BodySide| work.anatomy.arm_chain(side).map(|arm| arm.hand);
    let hands: Vec<Option<usize>> = sides.iter().map(|&side| hand(side)).collect();
    let columns = JointColumns::joint_columns_of(work, hands.iter().flatten().copied());
    for (&side, hand) in sides.iter().zip(hands) {
        let hand = hand.ok_or(StepError::NoArm(side))?;
        let hand_positions = columns.joint_positions(hand).iter().enumerate();
        let target = |(frame, &at)| stroke.point_between(frame, at, target(side, frame, at));
        let targets: Vec<DVec3> = hand_positions.map(target).collect();
        let reach = arm::move_wrist(work, side, &columns, &targets, None, solver).ok_or(StepError::NoArm(side))?;
        check_wrist_reach(side, &reach)?;
        worst = worst.worse_reach(reach);
    }
    Ok(worst)
}

/// Refuses targets that are out of reach by half an arm's length or more.
pub(crate) fn check_wrist_reach(side: BodySide, reach: &WristReach) -> Result<(), StepError> {
    if reach.residual > 0.5 * reach.arm && reach.farthest > 1.5 * reach.arm {
        return Err(StepError::TooFar {
            side,
            distance: reach.farthest,
            arm: reach.arm,
        });
    }
    Ok(())
}

/// Describes the limits that an arm met, and the help that it had.
pub(crate) fn describe_reach(reach: &WristReach) -> Vec<String> {
    let mut lines = Vec::new();
    if reach.residual > 1e-3 {
        lines.push(format!(
            "out of reach: the wrist stays {:.1} cm short at frame {}",
            reach.residual * 100.0,
            reach.frame
        ));
    }
    if reach.is_softened() {
        lines.push(format!(
            "the wrist leaves the arm's reach fast: beyond {:.1}% of its length it lags behind, so \
             that the elbow opens smoothly",
            (1.0 - reach.soft) * 100.0
        ));
    }
    if reach.helped > 0 {
        lines.push(format!(
            "the collar bone helped in {} frames, beyond {:.0}% of the arm's length",
            reach.helped,
            HELP_FROM * 100.0
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_is_named_by_its_direction() {
        let text = describe_displacement_cm(DVec3::new(-1.9, 2.0, -0.34));
        assert_eq!(text, "1.9 cm right, 2.0 cm up, 0.3 cm back");
    }
}
