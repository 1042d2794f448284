//! `from … to …`: moves directional verbs to other places.

use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use chereme_motion::BodySide;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::words::InterfaceText;
use chereme_sign::{SignComponent, SignerHandedness};
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::arm::{self, WristReach};
use crate::body::arm_length;
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::{RecipeError, StepError};
use crate::ops::place_operator::{self, describe_reach};
use crate::ops::travel::{STILL_WRIST_MOVEMENT_M, withdraw_moved_notes, wrist_path};
use crate::ops::{
    FieldSetting, OperatorDescription, OperatorField, OperatorSyntax, StepOperator, StepOutcome, component_notes,
};
use crate::outcome::NoteSubject;
use crate::recipe_inputs::PlaceInput;
use crate::recipe_settings::{ArmSolverMethod, SigningSpot};
use crate::sources::MaterialSigner;
use crate::stroke::SignStroke;
use crate::text::{ParsedText, RecipeParser, write_option, write_separated_list};
use crate::units::{BodyDirection, HandChoice};
use crate::work::{JointColumns, WorkingClip};

/// Settings of `from me to left`: the new start and end of a directional verb.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IndicateSettings {
    /// The hands that move; a hand that stays still, away from the other, keeps its place.
    #[serde(default = "crate::recipe_settings::both_hands_choice")]
    pub hand: HandChoice,
    /// The start of the movement; `None` keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<SigningSpot>,
    /// The end of the movement; `None` keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<SigningSpot>,
}

/// The places of start and end, if inventories name them.
const INDICATE_END_SLOTS: [AnswerSlot<PlaceInput>; 2] =
    [AnswerSlot::new("indicate/from"), AnswerSlot::new("indicate/to")];

impl OperatorSyntax for IndicateSettings {
    const OPERATOR_NAME: &'static str = "indicate";
    const OPERATOR_WORDS: &'static [&'static str] = &["from", "to"];
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "indicate",
        "directional-verb-between": "from me to left"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, word: &str) -> ParsedText<Self> {
        let from = (word == "from").then(|| parser.parse_signing_spot()).transpose()?;
        let has_target = word == "to" || parser.accept_word("to");
        let to = has_target.then(|| parser.parse_signing_spot()).transpose()?;
        let hand = if parser.accept_word("with") {
            parser
                .parse_hand_choice()
                .ok_or_else(|| parser.expected_text_error("a hand", &[]))?
        } else {
            HandChoice::Both
        };
        Ok(Self { hand, from, to })
    }

    fn default_operator() -> Self {
        Self {
            hand: HandChoice::Both,
            from: None,
            to: Some(SigningSpot::Towards(vec![BodyDirection::Left])),
        }
    }
}

impl Display for IndicateSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let from = self.from.as_ref().map(|spot| format!("from {spot}"));
        let to = self.to.as_ref().map(|spot| format!("to {spot}"));
        write_separated_list(f, from.into_iter().chain(to), " ")?;
        let hand = (self.hand != HandChoice::Both).then(|| self.hand.hand_choice_name());
        write_option(f, "with", hand)
    }
}

impl StepOperator for IndicateSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        if self.from.is_none() && self.to.is_none() {
            return Err(RecipeError::Empty {
                step: Self::OPERATOR_NAME,
                what: "neither where it starts nor where it ends is given",
            });
        }
        let mut spots = self.from.iter().chain(&self.to);
        spots.try_for_each(|at| check::check_step_spot(Self::OPERATOR_NAME, at))
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        for (slot, spot) in INDICATE_END_SLOTS.iter().zip([&self.from, &self.to]) {
            if let Some(spot) = spot {
                ask.ask_spot_place(slot, spot)?;
            }
        }
        Ok(())
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let places = INDICATE_END_SLOTS.each_ref().map(|slot| given.get_answer(slot));
        indicate_places(work, self, places, given.text)
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((
            ContactEffect::Same,
            ContactsToKeep::contacts_between_sides(self.hand.chosen_sides(handedness)),
        ))
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |id, spot| FieldSetting::new(InterfaceText::from_id(id), OperatorField::Spot(spot));
        vec![
            FieldSetting::hands_field_setting(&mut self.hand),
            setting("setting-from-spot", &mut self.from),
            setting("setting-to-spot", &mut self.to),
        ]
    }
}

/// A hand that a directional verb moves.
struct IndicatingHand {
    side: BodySide,
    path: Vec<DVec3>,
    shoulders: [DVec3; 2],
    arm: f64,
}

impl IndicatingHand {
    /// Follows a hand from the first of two frames to the second.
    fn follow_indicating_hand(work: &WorkingClip, side: BodySide, ends: [usize; 2]) -> Result<Self, StepError> {
        let chain = work.anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?;
        let columns = JointColumns::joint_columns_of(work, [chain.upper, chain.hand]);
        let shoulder = columns.joint_positions(chain.upper);
        Ok(Self {
            side,
            path: columns.joint_positions(chain.hand).to_vec(),
            shoulders: ends.map(|frame| shoulder[frame]),
            arm: arm_length(work, side).ok_or(StepError::NoArm(side))?,
        })
    }

    fn is_still(&self) -> bool {
        self.path
            .iter()
            .all(|at| at.distance(self.path[0]) < STILL_WRIST_MOVEMENT_M)
    }

    /// Returns the largest share of the line from `near` to `far` at which the wrist is within the arm's reach. `end`
    /// is 0 for the start of the movement and 1 for its end; `beside` is the wrist's offset from the hands' middle.
    fn reachable_line_share(&self, end: usize, beside: DVec3, near: DVec3, far: DVec3) -> f64 {
        let most = MAX_DIRECTION_REACH * self.arm;
        let within = |share: f64| (near.lerp(far, share) + beside).distance(self.shoulders[end]) <= most;
        (0..=20)
            .rev()
            .map(|n| f64::from(n) / 20.0)
            .find(|&candidate| within(candidate))
            .unwrap_or(0.0)
    }
}

/// The largest extension of an arm towards a mere direction, as a share of its length.
const MAX_DIRECTION_REACH: f64 = 0.95;

/// Returns the hands to move: of two hands only the moving one, if the other stays still and away from it.
fn sent(work: &WorkingClip, sides: &[BodySide], ends: [usize; 2]) -> Result<Vec<IndicatingHand>, StepError> {
    let sent_hands = sides
        .iter()
        .map(|&side| IndicatingHand::follow_indicating_hand(work, side, ends));
    let mut all = sent_hands.collect::<Result<Vec<_>, _>>()?;
    if let [one, other] = all.as_slice() {
        let pairs = one.path.iter().zip(&other.path);
        let nearest = pairs.map(|(a, b)| a.distance(*b)).fold(f64::MAX, f64::min);
        if one.is_still() != other.is_still() && nearest > 0.3 * one.arm {
            all.retain(|hand| !hand.is_still());
        }
    }
    Ok(all)
}

/// Moves the start and the end of the hands' movement: the path between is rotated and stretched with its ends, and the
/// hands rotate about the vertical with it.
///
/// A mere direction, such as `left` or `you`, means a place within the arms' reach. A hand that hangs or lies still
/// while the other one moves stays in its place.
pub(crate) fn indicate_places(
    work: &mut WorkingClip,
    settings: &IndicateSettings,
    places: [Option<&PlaceInput>; 2],
    operator: &str,
) -> Result<StepOutcome, StepError> {
    let stroke = SignStroke::of_work(work)?;
    let ends = [stroke.frames.start, stroke.frames.end - 1];
    let hands = sent(work, settings.hand.chosen_sides(work.handedness), ends)?;
    let sides: Vec<BodySide> = hands.iter().map(|hand| hand.side).collect();
    let frame = place_operator::signer_body_frame(work, &sides)?;
    let middle = |f: usize| hands.iter().map(|hand| hand.path[f]).sum::<DVec3>() / hands.len() as f64;
    let [start, end] = ends.map(middle);
    let mut did = Vec::new();
    let mut spot = |at: usize, now: DVec3| -> Result<DVec3, StepError> {
        let Some(spot) = [&settings.from, &settings.to][at].as_ref() else {
            return Ok(now);
        };
        let find = |spot| frame.hand_spot_position(work, spot, places[at].map(|input| &input.at), sides[0]);
        let goal_spot = find(spot).ok_or(StepError::NoMeaning {
            value: spot.to_string(),
            what: "landmark that this skeleton has",
        })?;
        // A place is meant exactly; a direction has no distance, so that it may be nearer.
        if !matches!(spot, SigningSpot::Towards(_) | SigningSpot::You) {
            return Ok(goal_spot);
        }
        let near = find(&SigningSpot::Me).unwrap_or(goal_spot);
        let shares = hands
            .iter()
            .map(|hand| hand.reachable_line_share(at, hand.path[ends[at]] - now, near, goal_spot));
        let share = shares.fold(1.0, f64::min);
        if share < 1.0 {
            did.push(format!(
                "{spot} is {:.0} cm nearer, as far as the arms reach",
                near.distance(goal_spot) * (1.0 - share) * 100.0
            ));
        }
        Ok(near.lerp(goal_spot, share))
    };
    let (from, to) = (spot(0, start)?, spot(1, end)?);
    let shares = travelled(&stroke.frames.clone().map(middle).collect::<Vec<_>>());
    let turn = level_turn(end - start, to - from);
    let mut worst = WristReach::default();
    for IndicatingHand { side, path, .. } in &hands {
        let side = *side;
        let chain = work.anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?;
        let columns = JointColumns::joint_columns_of(work, [chain.hand]);
        let turned: Vec<DQuat> = columns
            .joint_rotations(chain.hand)
            .iter()
            .enumerate()
            .map(|(frame, hand)| stroke.turn_share(frame, turn) * *hand)
            .collect();
        let targets: Vec<DVec3> = (0..work.frames)
            .map(|frame| {
                let nearest = stroke.nearest_frame(frame);
                let share = shares[nearest - stroke.frames.start];
                // The path is carried along by the line between its ends, and keeps how it bows from it.
                let (old, new) = (start.lerp(end, share), from.lerp(to, share));
                let moved = new + turn * (path[nearest] - old) - path[nearest];
                stroke.point_between(frame, path[frame], path[frame] + moved)
            })
            .collect();
        let solver = ArmSolverMethod::Analytic;
        let reach =
            arm::move_wrist(work, side, &columns, &targets, Some(&turned), solver).ok_or(StepError::NoArm(side))?;
        place_operator::check_wrist_reach(side, &reach)?;
        worst = worst.worse_reach(reach);
    }
    withdraw_moved_notes(work, &sides, operator);
    for (at, input) in places.into_iter().enumerate() {
        let value = input.and_then(|input| input.value.as_deref());
        let Some(value) = value else { continue };
        for &side in &sides {
            let frames = still_stroke_frames(work, side, &stroke, at == 1)?;
            let what = NoteSubject::Component(SignComponent::Placement, None);
            component_notes::record_component_value(work, side, what, value, frames, operator);
        }
    }
    did.push(format!(
        "the path of {:.0} cm became {:.0} cm",
        start.distance(end) * 100.0,
        from.distance(to) * 100.0
    ));
    did.extend(stroke.describe_rests(work));
    did.extend(describe_reach(&worst));
    Ok(StepOutcome::with_residual(did, worst.residual))
}

/// Returns the frames at the start, or at the end, of the stroke in which a wrist keeps its position.
fn still_stroke_frames(
    work: &WorkingClip,
    side: BodySide,
    stroke: &SignStroke,
    end: bool,
) -> Result<Range<usize>, StepError> {
    let frames = stroke.frames.clone();
    let path = &wrist_path(work, side)?[frames.clone()];
    let near = |from: DVec3| move |at: &&DVec3| at.distance(from) < 2.0 * STILL_WRIST_MOVEMENT_M;
    Ok(if end {
        let last = path[path.len() - 1];
        let count = path.iter().rev().take_while(near(last)).count();
        frames.end - count..frames.end
    } else {
        let count = path.iter().take_while(near(path[0])).count();
        frames.start..frames.start + count
    })
}

/// Returns the share of a path's length at each frame; the share of its time if it has no length.
fn travelled(path: &[DVec3]) -> Vec<f64> {
    let mut shares = vec![0.0];
    for pair in path.windows(2) {
        shares.push(shares[shares.len() - 1] + pair[0].distance(pair[1]));
    }
    let total_length = shares[shares.len() - 1];
    let last = shares.len().saturating_sub(1).max(1) as f64;
    shares
        .iter()
        .enumerate()
        .map(|(n, share)| {
            if total_length > 1e-6 {
                share / total_length
            } else {
                n as f64 / last
            }
        })
        .collect()
}

/// Returns the rotation about the vertical from one vector to another; the identity if either is nearly vertical or
/// short.
fn level_turn(from: DVec3, to: DVec3) -> DQuat {
    let level = |v: DVec3| DVec3::new(v.x, 0.0, v.z);
    let (a, b) = (level(from), level(to));
    if a.length() < 0.05 || b.length() < 0.05 {
        return DQuat::IDENTITY;
    }
    DQuat::from_rotation_y(b.x.atan2(b.z) - a.x.atan2(a.z))
}
