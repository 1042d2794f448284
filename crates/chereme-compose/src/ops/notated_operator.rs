//! `hamnosys` and `sigml`: movement from notation as a source of a recipe.

use chereme_sign::hamnosys::{self, NotatedSign};

use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::error::StepError;
use crate::language::BodyLanguageChanges;
use crate::notation;
use crate::ops::StepOutcome;
use crate::recipe_inputs::MaterialInput;
use crate::recipe_settings::NotationSettings;
use crate::sources::MaterialSigner;
use crate::work::WorkingClip;

/// The two ways to write notation in a recipe.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NotationSpelling {
    /// The symbols themselves.
    Hamnosys,
    /// The name of a SiGML file, or of a notated sign.
    Sigml,
}

/// The slots of the answers: the body, the signs, and body language that differs from the default one.
struct NotationSlots {
    body: AnswerSlot<MaterialInput>,
    signs: AnswerSlot<Vec<NotatedSign>>,
    language: AnswerSlot<BodyLanguageChanges>,
}

impl NotationSpelling {
    const fn notation_slots(self) -> NotationSlots {
        match self {
            Self::Hamnosys => NotationSlots {
                body: AnswerSlot::new("hamnosys"),
                signs: AnswerSlot::new("hamnosys/of"),
                language: AnswerSlot::new("hamnosys/language"),
            },
            Self::Sigml => NotationSlots {
                body: AnswerSlot::new("sigml"),
                signs: AnswerSlot::new("sigml/of"),
                language: AnswerSlot::new("sigml/language"),
            },
        }
    }

    /// Returns the place of the body that signs.
    pub(crate) fn notation_body_slot(self) -> AnswerSlot<MaterialInput> {
        self.notation_slots().body
    }

    fn notated_signs(self, settings: &NotationSettings, ask: &CorpusAsker<'_>) -> Result<Vec<NotatedSign>, StepError> {
        match self {
            Self::Hamnosys => {
                let read = hamnosys::parse_hamnosys(&settings.of)?;
                Ok(vec![NotatedSign {
                    sign: read.sign,
                    text: Some(settings.of.clone()),
                    ..NotatedSign::default()
                }])
            }
            Self::Sigml => Ok(ask.sources.find_named_notation(&settings.of)?),
        }
    }

    /// Asks for the signs, the body and its body language.
    pub(crate) fn resolve_notation_inputs(
        self,
        settings: &NotationSettings,
        ask: &mut CorpusAsker<'_>,
    ) -> Result<MaterialSigner, StepError> {
        let slots = self.notation_slots();
        let sign_list = self.notated_signs(settings, ask)?;
        if sign_list.is_empty() {
            return Err(StepError::Empty(settings.of.clone()));
        }
        let setting = ask.ask_signer_body(&slots.body, settings.on.as_deref())?;
        ask.put_answer(&slots.signs, sign_list);
        let named = settings.language.as_deref();
        let language = ask.sources.body_language(named, setting.signer.as_deref())?;
        if !language.is_usual() {
            ask.put_answer(&slots.language, language);
        }
        Ok(setting)
    }

    /// Generates the movement of the signs.
    pub(crate) fn generate_from_notation(
        self,
        given: &mut NodeAnswers<'_>,
    ) -> Result<(WorkingClip, StepOutcome), StepError> {
        let slots = self.notation_slots();
        let signs: Vec<_> = given.required_answer(&slots.signs)?.iter().collect();
        let stage = given.answered_material(&slots.body)?;
        let spoken = given.get_answer(&slots.language).cloned();
        let mut settings = notation::AnimatorSettings {
            rate: stage.clip.clip_frame_rate(),
            ..notation::AnimatorSettings::default()
        };
        if let Some(language) = &spoken {
            let complete_language = language.whole_body_language();
            settings.language = complete_language.map_err(|error| StepError::Language(error.to_string()))?;
        }
        let made = notation::animate_signs(&signs, stage, &settings)?;
        let steps = made.report.steps.iter();
        let step_texts = steps.flat_map(|step| step.did.iter().map(|did| format!("{} {did}", step.step)));
        let mut did: Vec<String> = step_texts.collect();
        did.extend(spoken.iter().flat_map(BodyLanguageChanges::describe_body_language));
        did.push(performed_by(&stage.address));
        let step_residuals = made.report.steps.iter().filter_map(|step| step.residual);
        let residual = step_residuals.fold(0.0, f64::max);
        let hands = made.report.steps.first().map(|step| step.hands.clone());
        let done = StepOutcome {
            language: spoken,
            hands: hands.unwrap_or_default(),
            warnings: made.report.warnings.clone(),
            ..StepOutcome::with_residual(did, residual)
        };
        Ok((WorkingClip::from_generated_movement(made, given.text), done))
    }
}

/// Describes the body that performs a notation.
pub(crate) fn performed_by(address: &str) -> String {
    format!("the notation is performed by the body of {address}")
}
