//! `hamnosys` and `sigml`: movement from notation as a source of a recipe.

use chereme_sign::hamnosys::{self, Notated};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::error::Cause;
use crate::language::Language;
use crate::notation;
use crate::ops::Done;
use crate::recipe::Notation;
use crate::resolve::MaterialInput;
use crate::work::Work;

/// The two ways to write notation in a recipe.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Written {
    /// The symbols themselves.
    Hamnosys,
    /// The name of a SiGML file, or of a notated sign.
    Sigml,
}

/// The slots of the answers: the body, the signs, and body language that differs from the default one.
struct Slots {
    body: Slot<MaterialInput>,
    signs: Slot<Vec<Notated>>,
    language: Slot<Language>,
}

impl Written {
    const fn slots(self) -> Slots {
        match self {
            Self::Hamnosys => Slots {
                body: Slot::new("hamnosys"),
                signs: Slot::new("hamnosys/of"),
                language: Slot::new("hamnosys/language"),
            },
            Self::Sigml => Slots {
                body: Slot::new("sigml"),
                signs: Slot::new("sigml/of"),
                language: Slot::new("sigml/language"),
            },
        }
    }

    /// Returns the place of the body that signs.
    pub(crate) fn body(self) -> Slot<MaterialInput> {
        self.slots().body
    }

    fn signs(self, settings: &Notation, ask: &Ask<'_>) -> Result<Vec<Notated>, Cause> {
        match self {
            Self::Hamnosys => {
                let read = hamnosys::parse(&settings.of)?;
                Ok(vec![Notated {
                    sign: read.sign,
                    text: Some(settings.of.clone()),
                    ..Notated::default()
                }])
            }
            Self::Sigml => Ok(ask.sources.notation(&settings.of)?),
        }
    }

    /// Asks for the signs, the body and its body language.
    pub(crate) fn resolve(self, settings: &Notation, ask: &mut Ask<'_>) -> Result<Setting, Cause> {
        let slots = self.slots();
        let found = self.signs(settings, ask)?;
        if found.is_empty() {
            return Err(Cause::Empty(settings.of.clone()));
        }
        let setting = ask.body(&slots.body, settings.on.as_deref())?;
        ask.put(&slots.signs, found);
        let named = settings.language.as_deref();
        let language = ask
            .sources
            .body_language(named, setting.signer.as_deref())?;
        if !language.is_usual() {
            ask.put(&slots.language, language);
        }
        Ok(setting)
    }

    /// Generates the movement of the signs.
    pub(crate) fn generate(self, given: &mut Given<'_>) -> Result<(Work, Done), Cause> {
        let slots = self.slots();
        let signs: Vec<_> = given.need(&slots.signs)?.iter().collect();
        let stage = given.material(&slots.body)?;
        let spoken = given.get(&slots.language).cloned();
        let mut settings = notation::Settings {
            rate: stage.clip.rate(),
            ..notation::Settings::default()
        };
        if let Some(language) = &spoken {
            let whole = language.whole();
            settings.language = whole.map_err(|error| Cause::Language(error.to_string()))?;
        }
        let made = notation::animate(&signs, stage, &settings)?;
        let steps = made.report.steps.iter();
        let did = steps.flat_map(|step| step.did.iter().map(|did| format!("{} {did}", step.step)));
        let mut did: Vec<String> = did.collect();
        did.extend(spoken.iter().flat_map(Language::describe));
        did.push(performed_by(&stage.address));
        let residual = made.report.steps.iter().filter_map(|step| step.residual);
        let residual = residual.fold(0.0, f64::max);
        let hands = made.report.steps.first().map(|step| step.hands.clone());
        let done = Done {
            language: spoken,
            hands: hands.unwrap_or_default(),
            warnings: made.report.warnings.clone(),
            ..(did, residual).into()
        };
        Ok((Work::made(made, given.text), done))
    }
}

/// Describes the body that performs a notation.
pub(crate) fn performed_by(address: &str) -> String {
    format!("the notation is performed by the body of {address}")
}
