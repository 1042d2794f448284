//! `amplify`: enlarges or shrinks the hands' paths about their middles.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::words::InterfaceText;
use chereme_sign::{SignComponent, SignerHandedness};
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::NodeAnswers;
use crate::arm::WristReach;
use crate::check;
use crate::contact::{self, CONTACT_BLEND_S, ContactEffect, ContactsToKeep, blend_shifts};
use crate::error::{RecipeError, StepError};
use crate::ops::place_operator::{self, describe_reach};
use crate::ops::travel::wrist_path;
use crate::ops::{
    FieldSetting, OperatorDescription, OperatorField, OperatorSyntax, StepOperator, StepOutcome, component_notes,
};
use crate::recipe_settings::ArmSolverMethod;
use crate::stroke::SignStroke;
use crate::text::{ParsedText, RecipeParser};
use crate::units::{HandChoice, RecipeFactor};
use crate::work::{JointGroup, WorkingClip};

/// Settings of `amplify both 1.5`: enlarges the hands' paths about their middles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AmplifySettings {
    /// The hands whose movement changes, each about the middle of its own path; hands that touch each other stay
    /// together.
    #[serde(default = "crate::recipe_settings::both_hands_choice")]
    pub hand: HandChoice,
    /// The factor for distances from the middle of the path.
    pub by: RecipeFactor,
}

impl OperatorSyntax for AmplifySettings {
    const OPERATOR_NAME: &'static str = "amplify";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "amplify",
        "larger-paths": "amplify both 1.5"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        Ok(Self {
            hand: parser.parse_hand_choice().unwrap_or(HandChoice::Both),
            by: parser.parse_quantity("a factor, such as 1.5 or 150%")?,
        })
    }

    fn default_operator() -> Self {
        Self {
            hand: HandChoice::Both,
            by: RecipeFactor(1.5),
        }
    }
}

impl Display for AmplifySettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "amplify {} {}", self.hand.hand_choice_name(), self.by)
    }
}

impl StepOperator for AmplifySettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        check::check_step_range(Self::OPERATOR_NAME, "the factor", self.by.0, 0.0, 20.0)
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        amplify_hand_paths(work, self, given.text)
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((
            ContactEffect::Same,
            ContactsToKeep::All(self.hand.chosen_sides(handedness)),
        ))
    }

    fn is_nothing(&self) -> bool {
        self.by == RecipeFactor(1.0)
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let size = InterfaceText::from_id("setting-size");
        vec![
            FieldSetting::hands_field_setting(&mut self.hand),
            FieldSetting::new(size, OperatorField::Factor(&mut self.by, 0.0..=3.0)),
        ]
    }
}

/// The factor below which a hand hardly moves any more.
const STILL_HAND_FACTOR: f64 = 0.1;

/// Multiplies the distances of the wrists from the middles of their movement.
pub(crate) fn amplify_hand_paths(
    work: &mut WorkingClip,
    settings: &AmplifySettings,
    operator: &str,
) -> Result<StepOutcome, StepError> {
    let sides = settings.hand.chosen_sides(work.handedness);
    let factor = settings.by.0;
    if factor == 1.0 {
        return Ok(StepOutcome::with_residual(vec!["nothing to do".into()], 0.0));
    }
    let rest = SignStroke::of_work(work)?.describe_rests(work);
    let reach = scale_wrist_paths(work, sides, factor)?;
    let stands = factor < STILL_HAND_FACTOR;
    component_notes::withdraw_hand_notes(work, sides, operator, |component, feature| {
        component == SignComponent::Movement && (feature == Some("size") || stands && feature != Some("phase"))
    });
    work.note_changed_groups(sides.iter().map(|&side| JointGroup::Arm(side)), operator);
    let mut did = vec![format!("the hands' paths are {:.0}% as large", factor * 100.0)];
    did.extend(rest);
    did.extend(describe_reach(&reach));
    Ok(StepOutcome::with_residual(did, reach.residual))
}

/// Scales the wrists' paths, each about its own middle, so that parallel paths stay parallel and a resting hand rests.
/// While the hands touch each other, they keep their positions relative to each other.
pub(crate) fn scale_wrist_paths(
    work: &mut WorkingClip,
    sides: &[BodySide],
    factor: f64,
) -> Result<WristReach, StepError> {
    let stroke = SignStroke::of_work(work)?;
    let blend = (CONTACT_BLEND_S / work.rate.frame_time()).round() as usize;
    let mut paths = WristPaths::default();
    for &side in sides {
        let path = wrist_path(work, side)?;
        let middle = path[stroke.frames.clone()].iter().sum::<DVec3>() / stroke.frames.len() as f64;
        let path_offsets = path.iter().map(|at| *at - middle).collect();
        paths.0[usize::from(side == BodySide::Left)] = path_offsets;
    }
    let touching_set: BTreeSet<usize> = contact::find_contacts(work).between_hands().collect();
    let touching: Vec<usize> = touching_set.into_iter().filter(|f| stroke.frames.contains(f)).collect();
    let apart_sum = touching
        .iter()
        .map(|&frame| paths.wrist_separation(frame))
        .sum::<DVec3>();
    let mean = apart_sum / touching.len().max(1) as f64;
    let mut slides = vec![None; work.frames];
    for frame in touching {
        slides[frame] = Some((factor - 1.0) * (paths.wrist_separation(frame) - mean));
    }
    let slides = blend_shifts(&slides, blend);
    let shares = paths.wrist_path_shares(&stroke);
    place_operator::move_wrists_to(work, sides, ArmSolverMethod::Analytic, &stroke, |side, frame, at| {
        let hand = usize::from(side == BodySide::Left);
        let own_shift = (factor - 1.0) * paths.0[hand][frame];
        let relation = (1.0 - factor) * mean - slides[frame];
        at + own_shift + relation * shares[hand]
    })
}

/// The positions of the right and the left wrist relative to the middles of their paths; empty for a hand that keeps
/// its path.
#[derive(Default)]
struct WristPaths([Vec<DVec3>; 2]);

impl WristPaths {
    /// Returns the right wrist's position minus the left one's.
    fn wrist_separation(&self, frame: usize) -> DVec3 {
        let [right, left] = self.0.each_ref().map(|path| path.get(frame).copied());
        right.unwrap_or_default() - left.unwrap_or_default()
    }

    /// Returns the share of each hand in what keeps them together, by the size of their paths; that of the left hand is
    /// negative.
    fn wrist_path_shares(&self, stroke: &SignStroke) -> [f64; 2] {
        let size = |path: &Vec<DVec3>| {
            let frames = path.get(stroke.frames.clone()).unwrap_or_default();
            frames.iter().map(|at| at.length_squared()).sum::<f64>()
        };
        let [right, left] = self.0.each_ref().map(size);
        let all = (right + left).max(f64::MIN_POSITIVE);
        [right / all, -left / all]
    }
}
