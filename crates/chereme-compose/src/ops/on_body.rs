//! `on`: puts the movement on another body.

use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use chereme_sign::words::InterfaceText;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::{RecipeError, StepError};
use crate::ops::retarget::{self, TargetBody};
use crate::ops::{
    FieldSetting, OperatorDescription, OperatorField, OperatorNeighbours, OperatorSyntax, Step, StepOperator,
    StepOutcome, then,
};
use crate::recipe_inputs::MaterialInput;
use crate::sources::MaterialSigner;
use crate::text::{ParsedText, QuotedName, RecipeParser};
use crate::work::{JointGroup, WorkingClip};

/// Settings of `on signer:1`, `on recording:5` and `on built-in`: the movement on another body.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OnBodySettings {
    /// The address of the signer or recording whose body moves, or `built-in` for the program's own.
    pub body: String,
}

/// The other body, at rest.
pub(crate) const ON_BODY_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("on/body");
/// The body that comes with the program, in recipes.
pub const BUILT_IN_BODY: &str = "built-in";

impl OperatorSyntax for OnBodySettings {
    const OPERATOR_NAME: &'static str = "on";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "on",
        "another-body": "on signer:1",
        "programs-own-body": "on built-in"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let body = parser.parse_recipe_name("signer:NAME, recording:NAME or built-in")?;
        Ok(Self { body })
    }

    fn default_operator() -> Self {
        Self {
            body: BUILT_IN_BODY.to_owned(),
        }
    }
}

impl Display for OnBodySettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "on {}", QuotedName(&self.body))
    }
}

impl StepOperator for OnBodySettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        check::check_named_text(Self::OPERATOR_NAME, &self.body, "the name of the body is empty")
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        ask.ask_signer_body(&ON_BODY_SLOT, Some(&self.body)).map(|_| ())
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let material = given.answered_material(&ON_BODY_SLOT)?;
        let body = WorkingClip::working_clip_from(material);
        if let Some(same) = then::on_same_body(&body, work) {
            let signer = body.signer;
            *work = WorkingClip { signer, ..same };
            let did = format!(
                "the movement is on this body already and stays as it is: {}",
                material.address
            );
            return Ok(vec![did].into());
        }
        let onto = TargetBody {
            skeleton: &body.skeleton,
            anatomy: &body.anatomy,
            idle: body.local_pose_at(0),
        };
        let done = retarget::retarget_with_contacts(work, &onto, given.text)?;
        let signer = body.signer;
        *work = WorkingClip { signer, ..done.work };
        work.note_changed_groups(JointGroup::ALL_JOINT_GROUPS, given.text);
        let mut did = vec![format!("the movement is put on another body: {}", material.address)];
        did.extend(done.kept);
        Ok(StepOutcome {
            lost: done.lost,
            touches: done.touches,
            ..did.into()
        })
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        // It follows contacts from body to body itself.
        None
    }

    fn relation_to_previous(&self, before: &mut Step) -> OperatorNeighbours {
        match before {
            Step::On(other) if other == self => OperatorNeighbours::One,
            _ => OperatorNeighbours::Apart,
        }
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let field = OperatorField::Body(&mut self.body);
        vec![FieldSetting::new(InterfaceText::from_id("setting-body"), field)]
    }
}
