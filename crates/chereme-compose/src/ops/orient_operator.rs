//! `orient`: rotates the hands in the world; they keep their movement and their own rotations.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodySide, ModelPose};
use chereme_sign::SignComponent;
use chereme_sign::words::InterfaceText;

use crate::arm::{self, WristReach};
use crate::body::SignerFrame;
use crate::error::StepError;
use crate::ops::{OperatorDescription, component_notes, place_operator};
use crate::outcome::NoteSubject;
use crate::recipe_settings::ArmSolverMethod;
use crate::stroke::SignStroke;
use crate::units::mean_of_directions;
use crate::work::{JointColumns, JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::NodeAnswers;
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{OperatorSyntax, StepOperator, StepOutcome};
use crate::text::{ParsedText, RecipeParser, write_separated_list};
use crate::units::{BodyDirection, HandChoice, RecipeDegrees};

/// Settings of `orient right palm up`, `orient right fingers forward palm down`, `orient both by 30deg about up`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OrientSettings {
    /// The hands that turn.
    #[serde(default = "crate::recipe_settings::dominant_hand_choice")]
    pub hand: HandChoice,
    /// The direction of the palm in the middle of the sign.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub palm: Vec<BodyDirection>,
    /// The direction of straight fingers in the middle of the sign.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fingers: Vec<BodyDirection>,
    /// Rotations about the signer's own directions, right-handed, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by: Vec<AxisTurn>,
}

/// A rotation about one of the signer's directions: `30deg about up`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisTurn {
    /// The angle; positive is counter-clockwise, seen against the direction.
    pub angle: RecipeDegrees,
    /// The axis.
    pub about: BodyDirection,
}

impl OperatorSyntax for OrientSettings {
    const OPERATOR_NAME: &'static str = "orient";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "orient",
        "another-direction-palm": "orient right palm up fingers forward",
        "turned-about-direction": "orient right by 30deg about up"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let mut orient = Self {
            hand: parser.parse_hand_choice().unwrap_or(HandChoice::Dominant),
            palm: Vec::new(),
            fingers: Vec::new(),
            by: Vec::new(),
        };
        let mut some = false;
        loop {
            if parser.accept_word("palm") {
                orient.palm = parser.parse_directions()?;
            } else if parser.accept_word("fingers") {
                orient.fingers = parser.parse_directions()?;
            } else if parser.accept_word("by") {
                let angle = parser.parse_quantity("an angle, such as 30deg")?;
                parser.expect_word("about", "\"about\" and a direction")?;
                let about = parser.parse_direction().ok_or_else(|| parser.no_direction())?;
                orient.by.push(AxisTurn { angle, about });
            } else if some {
                return Ok(orient);
            } else {
                let words = ["palm", "fingers", "by"];
                return Err(parser.expected_text_error("\"palm\", \"fingers\" or \"by\"", &words));
            }
            some = true;
        }
    }

    fn default_operator() -> Self {
        Self {
            hand: HandChoice::Dominant,
            palm: vec![BodyDirection::Up],
            fingers: Vec::new(),
            by: Vec::new(),
        }
    }
}

impl Display for OrientSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "orient {}", self.hand.hand_choice_name())?;
        for (word, directions) in [("palm", &self.palm), ("fingers", &self.fingers)] {
            if !directions.is_empty() {
                write!(f, " {word} ")?;
                write_separated_list(f, directions.iter().map(|d| d.body_direction_name()), " ")?;
            }
        }
        for turn in &self.by {
            write!(f, " by {} about {}", turn.angle, turn.about.body_direction_name())?;
        }
        Ok(())
    }
}

impl StepOperator for OrientSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        if self.palm.is_empty() && self.fingers.is_empty() && self.by.is_empty() {
            return Err(RecipeError::Empty {
                step: Self::OPERATOR_NAME,
                what: "neither palm nor fingers nor a turn is given",
            });
        }
        for directions in [&self.palm, &self.fingers] {
            if !directions.is_empty() {
                check::check_step_directions(Self::OPERATOR_NAME, directions)?;
            }
        }
        if let (Some(palm), Some(fingers)) = (mean_of_directions(&self.palm), mean_of_directions(&self.fingers))
            && palm.cross(fingers).length() < 1e-6
        {
            return Err(RecipeError::Empty {
                step: Self::OPERATOR_NAME,
                what: "the palm faces across the fingers, so both cannot have the same direction or opposite ones",
            });
        }
        let angle = |turn: &AxisTurn| turn.angle.0;
        let mut angles = self.by.iter().map(angle);
        angles.try_for_each(|angle| check::check_step_range(Self::OPERATOR_NAME, "the angle", angle, -360.0, 360.0))
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        orient_hands(work, self, given.text)
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((
            ContactEffect::Same,
            ContactsToKeep::All(self.hand.chosen_sides(handedness)),
        ))
    }
}

/// The largest bend of wrists, in degrees: flexion reaches about 80, extension 70.
const MOST_BEND: f64 = 85.0;

/// Applies one rotation in the world to each hand over the whole stroke, so that in its middle palm and fingers have the
/// wanted directions.
pub(crate) fn orient_hands(
    work: &mut WorkingClip,
    settings: &OrientSettings,
    operator: &str,
) -> Result<StepOutcome, StepError> {
    let sides = settings.hand.chosen_sides(work.handedness);
    let frame = place_operator::signer_body_frame(work, sides)?;
    let stroke = SignStroke::of_work(work)?;
    let middle = stroke.middle_frame();
    let mut worst = WristReach::default();
    let mut did = Vec::new();
    for &side in sides {
        let turn = orienting_rotation(work, &frame, middle, side, settings)?;
        let hand = work.anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?.hand;
        let columns = JointColumns::joint_columns_of(work, [hand]);
        let hand_rotations = columns.joint_rotations(hand).iter().enumerate();
        let hands: Vec<DQuat> = hand_rotations
            .map(|(at, hand)| stroke.turn_share(at, turn) * *hand)
            .collect();
        let targets = columns.joint_positions(hand).to_vec();
        let reach = arm::move_wrist(work, side, &columns, &targets, Some(&hands), ArmSolverMethod::Analytic);
        worst = worst.worse_reach(reach.ok_or(StepError::NoArm(side))?);
        let angle = DQuat::IDENTITY.angle_between(turn).to_degrees();
        did.push(format!("the {} hand is turned by {angle:.0}°", side.body_side_name()));
        let bend = wrist_bend(work, side).to_degrees();
        // The direction was asked for, so that it is made and the bend is only said.
        if bend > MOST_BEND {
            did.push(format!(
                "the {} wrist bends by {bend:.0}°, more than wrists can",
                side.body_side_name()
            ));
        }
    }
    component_notes::withdraw_hand_notes(work, sides, operator, |component, _| {
        component == SignComponent::Orientation
    });
    for &side in sides {
        record_directions(work, &frame, middle, side, operator);
    }
    did.extend(stroke.describe_rests(work));
    work.note_changed_groups(sides.iter().map(|&side| JointGroup::Arm(side)), operator);
    Ok(StepOutcome::with_residual(did, worst.residual))
}

/// The largest rotation away from the hand's directions in the middle of the sign, in radians, at which the values of
/// these directions still hold.
const SAME_DIRECTION_ROTATION_RAD: f64 = 0.5;

/// Notes the directions of palm and fingers around the frame `middle`.
fn record_directions(work: &mut WorkingClip, frame: &SignerFrame, middle: usize, side: BodySide, operator: &str) {
    let directions = |work: &WorkingClip, at: usize| {
        let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(at));
        let fingers = work.anatomy.hand_direction(side, &model)?;
        let palm = work.anatomy.palm_normal(side, &model)?;
        Some([fingers, palm].map(|direction| frame.to_body(direction)))
    };
    let Some([fingers, palm]) = directions(work, middle) else {
        return;
    };
    let same = |at: &usize| {
        directions(work, *at).is_some_and(|[f, p]| {
            f.angle_between(fingers) < SAME_DIRECTION_ROTATION_RAD
                && p.angle_between(palm) < SAME_DIRECTION_ROTATION_RAD
        })
    };
    let start = middle - (0..middle).rev().take_while(same).count();
    let end = middle + (middle..work.frames).take_while(same).count();
    let values = [
        ("fingers", component_notes::nearest_direction_name(fingers)),
        (
            "palm",
            component_notes::palm_direction_name(fingers, palm).map(str::to_owned),
        ),
    ];
    for (feature, value) in values {
        if let Some(value) = value {
            let what = NoteSubject::Component(SignComponent::Orientation, Some(feature.to_owned()));
            component_notes::record_component_value(work, side, what, &value, start..end.max(start + 1), operator);
        }
    }
}

/// Returns the largest angle between a forearm and its hand, in radians.
fn wrist_bend(work: &WorkingClip, side: BodySide) -> f64 {
    let Some(arm) = work.anatomy.arm_chain(side) else {
        return 0.0;
    };
    let rest = work.skeleton.rest_model_pose();
    let Some(along) = work.anatomy.hand_direction(side, &rest) else {
        return 0.0;
    };
    // In the hand's own space, where the direction is the same in every frame.
    let along = rest.model_joint_rotation(arm.hand).inverse() * along;
    let columns = JointColumns::joint_columns_of(work, [arm.hand]);
    let (elbows, wrists) = (columns.joint_positions(arm.forearm), columns.joint_positions(arm.hand));
    let turned = columns.joint_rotations(arm.hand);
    (0..work.frames)
        .map(|f| (wrists[f] - elbows[f]).angle_between(turned[f] * along))
        .filter(|bend| bend.is_finite())
        .fold(0.0, f64::max)
}

/// Returns the rotation in model space for the settings at the frame `middle`.
fn orienting_rotation(
    work: &WorkingClip,
    frame: &SignerFrame,
    middle: usize,
    side: BodySide,
    settings: &OrientSettings,
) -> Result<DQuat, StepError> {
    let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(middle));
    let anatomy = &work.anatomy;
    let hand = anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?.hand;
    let none = || StepError::NoFingers(side);
    let palm = anatomy.palm_normal(side, &model).ok_or_else(none)?;
    let fingers = anatomy.hand_direction(side, &model).ok_or_else(none)?;
    let wanted = |directions: &[_]| mean_of_directions(directions).map(|v| frame.model_direction_of(v));
    let mut turn = match (wanted(&settings.palm), wanted(&settings.fingers)) {
        (None, None) => DQuat::IDENTITY,
        (Some(to), None) => shortest_arc_about(palm, to, fingers),
        (None, Some(to)) => shortest_arc_about(fingers, to, palm),
        (Some(palm_to), Some(to)) => {
            // Fingers are exact; a palm that is not at a right angle to them gives way.
            let across = palm_to.reject_from_normalized(to);
            let rotation = anatomy.hand_rotation(side, to, across).ok_or_else(none)?;
            rotation * model.model_joint_rotation(hand).inverse()
        }
    };
    for step in &settings.by {
        let axis = frame.model_direction_of(step.about.direction_unit_vector());
        turn = DQuat::from_axis_angle(axis, step.angle.0.to_radians()) * turn;
    }
    Ok(turn.normalize())
}

/// Returns the shortest rotation from `from` to `to`; about `axis` if they are opposite.
fn shortest_arc_about(from: DVec3, to: DVec3, axis: DVec3) -> DQuat {
    if from.dot(to) < -1.0 + 1e-9 {
        return DQuat::from_axis_angle(axis, std::f64::consts::PI);
    }
    DQuat::from_rotation_arc(from, to)
}
