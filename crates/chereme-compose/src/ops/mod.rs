//! The operators, one module each, and the list of all.
//!
//! An operator is a struct of settings with its text and its words ([`OperatorSyntax`]) and its effect ([`StepOperator`]), all in
//! its module. To add one, write that module and a row of the list below; the tree, its JSON, the text's parser and
//! printer, the reserved words, checks, the resolver, the evaluator, the handling of contacts, the help, the French of
//! its report and the window's card follow from the row.

use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use crate::answers::{CorpusAsker, NodeAnswers};
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::{RecipeError, StepError};
use crate::language::BodyLanguageChanges;
use crate::outcome::{HandReport, JoinReport, TouchReport};
use crate::sources::MaterialSigner;
use crate::text::{ParsedText, RecipeParser};
use crate::work::WorkingClip;

pub(crate) mod amplify;
pub(crate) mod clear;
pub(crate) mod component_notes;
pub(crate) mod configure;
pub(crate) mod cut;
mod description;
pub(crate) mod expression_operator;
pub(crate) mod face_operator;
mod field_operator;
pub(crate) mod indicate;
pub(crate) mod join;
pub(crate) mod mirror;
pub(crate) mod nonmanual_operator;
pub(crate) mod notated_operator;
pub(crate) mod on_body;
pub(crate) mod orient_operator;
pub(crate) mod place_operator;
pub(crate) mod point;
pub(crate) mod repeat_operator;
pub(crate) mod retarget;
pub(crate) mod retime;
pub(crate) mod reverse;
pub(crate) mod spell;
pub(crate) mod then;
pub(crate) mod travel;

pub use description::OperatorDescription;
use description::described_operator;
pub use field_operator::{OperatorField, OperatorSetting as FieldSetting};

/// The effect of an operator, and its part in checks, answers and contacts.
pub(crate) trait StepOperator: Display {
    /// Refuses settings that could never be evaluated.
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        Ok(())
    }

    /// Asks the corpus for the inputs of the operator.
    fn resolve_operator_inputs(&self, _ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        Ok(())
    }

    /// Makes the movement long enough for what the operator does with it, before contacts are looked for; returns a
    /// description if it became longer.
    fn make_time(&self, _work: &mut WorkingClip) -> Result<Option<String>, StepError> {
        Ok(None)
    }

    /// Changes the movement.
    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError>;

    /// Returns the effect of the operator on contacts, and those that it must keep; `None` if it cannot lose any, or
    /// handles them itself.
    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)>;

    /// Returns whether the operator leaves every movement as it is.
    fn is_nothing(&self) -> bool {
        false
    }

    /// Returns the relation of this operator to one directly before it, which may absorb this one.
    fn relation_to_previous(&self, _before: &mut Step) -> OperatorNeighbours {
        OperatorNeighbours::Apart
    }

    /// Returns the settings that a form shows with common fields; empty for an operator with a form of its own.
    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        Vec::new()
    }
}

/// The text of an operator. [`parse`](Self::parse) reads the text that its [`Display`] writes.
pub(crate) trait OperatorSyntax: StepOperator + Sized {
    /// The name: the key in JSON, and in most cases the word that begins the text.
    const OPERATOR_NAME: &'static str;
    /// The words about the operator that people read.
    const OPERATOR_DESCRIPTION: OperatorDescription;
    /// The words that begin the text.
    const OPERATOR_WORDS: &'static [&'static str] = &[Self::OPERATOR_NAME];
    /// Further words that begin the text, which stay free as names.
    const OPERATOR_SYNONYMS: &'static [&'static str] = &[];

    /// Reads the settings after `word`, the word that began the operator.
    fn parse_operator_text(parser: &mut RecipeParser<'_>, word: &str) -> ParsedText<Self>;

    /// Returns an operator for a new form, with a visible effect or an empty name.
    fn default_operator() -> Self;
}

/// The relation of two successive operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OperatorNeighbours {
    /// Both are applied.
    Apart,
    /// The first absorbed the second.
    One,
    /// They cancel out.
    Nothing,
}

/// The effect of an operator or source, for the report.
#[derive(Default)]
pub(crate) struct StepOutcome {
    pub(crate) did: Vec<String>,
    pub(crate) residual: Option<f64>,
    pub(crate) moved: Option<[f64; 3]>,
    pub(crate) language: Option<BodyLanguageChanges>,
    pub(crate) hands: Vec<HandReport>,
    pub(crate) touches: Vec<TouchReport>,
    pub(crate) joins: Vec<JoinReport>,
    /// Contacts that it lost.
    pub(crate) lost: Vec<String>,
    pub(crate) warnings: Vec<String>,
}

impl From<Vec<String>> for StepOutcome {
    fn from(did: Vec<String>) -> Self {
        Self { did, ..Self::default() }
    }
}

impl StepOutcome {
    /// Returns the outcome of a step that did this and missed its goal by `residual` metres or radians at most.
    pub(crate) fn with_residual(did: Vec<String>, residual: f64) -> Self {
        Self {
            did,
            residual: Some(residual),
            ..Self::default()
        }
    }
}

impl From<join::JoinOutcome> for StepOutcome {
    fn from(done: join::JoinOutcome) -> Self {
        Self {
            did: done.did,
            joins: done.joins,
            lost: done.contacts,
            warnings: done.warnings,
            ..Self::default()
        }
    }
}

/// Declares the operators. A row holds the name, the struct of settings if there are any, the module, and further
/// public types of the module.
macro_rules! operators {
    ($(
        $(#[$about:meta])*
        $name:ident $(($settings:ident))? in $module:ident $(with $($more:ident),+)?;
    )*) => {
        /// One operator with its settings.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields)]
        pub enum Step {
            $($(#[$about])* $name $(($module::$settings))?,)*
        }

        /// The settings of operators, for the tree.
        pub(crate) mod settings {
            $($(pub use super::$module::$settings;)? $($(pub use super::$module::$more;)+)?)*
        }

        impl Step {
            /// Returns the operator's name.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$name { .. } => <operators!(@type $module $name $($settings)?)>::OPERATOR_NAME,)*
                }
            }

            /// Returns the words about the operator that people read.
            #[must_use]
            pub fn description(&self) -> &'static OperatorDescription {
                match self {
                    $(Self::$name { .. } => {
                        &<operators!(@type $module $name $($settings)?)>::OPERATOR_DESCRIPTION
                    })*
                }
            }

            /// The words about every operator, in the order of the list.
            pub const DESCRIPTIONS: &'static [OperatorDescription] = &[
                $(<operators!(@type $module $name $($settings)?)>::OPERATOR_DESCRIPTION),*
            ];

            /// Returns one of each operator, for a new form: with a visible effect or an empty name.
            #[must_use]
            pub fn usual() -> Vec<Self> {
                vec![$(operators!(@step $module $name $($settings)?)(OperatorSyntax::default_operator())),*]
            }

            /// Returns the settings that a form shows with common fields; empty for operators without settings, and for
            /// those with a form of their own.
            #[must_use]
            pub fn fields(&mut self) -> Vec<FieldSetting<'_>> {
                match self {
                    $(operators!(@pattern $name it $($settings)?) => {
                        operators!(@fields it $($settings)?)
                    })*
                }
            }

            /// Returns the words that begin operators, in the order of the list.
            #[must_use]
            pub fn operator_first_words() -> Vec<&'static str> {
                [$(<operators!(@type $module $name $($settings)?)>::OPERATOR_WORDS),*].concat()
            }

            /// Reads the operator that `word` begins; `None` for other words.
            pub(crate) fn parse(parser: &mut RecipeParser<'_>, word: &str) -> Option<ParsedText<Self>> {
                $(if <operators!(@type $module $name $($settings)?)>::OPERATOR_WORDS.contains(&word)
                    || <operators!(@type $module $name $($settings)?)>::OPERATOR_SYNONYMS.contains(&word)
                {
                    let read = OperatorSyntax::parse_operator_text(parser, word);
                    return Some(read.map(operators!(@step $module $name $($settings)?)));
                })*
                None
            }

            pub(crate) fn operator(&self) -> &dyn StepOperator {
                match self {
                    $(operators!(@pattern $name it $($settings)?) => {
                        operators!(@operator $module $name it $($settings)?)
                    })*
                }
            }
        }
    };
    (@type $module:ident $name:ident) => { $module::$name };
    (@type $module:ident $name:ident $settings:ident) => { $module::$settings };
    (@step $module:ident $name:ident) => { |_: $module::$name| Step::$name };
    (@step $module:ident $name:ident $settings:ident) => { Step::$name };
    (@pattern $name:ident $it:ident) => { Self::$name };
    (@pattern $name:ident $it:ident $settings:ident) => { Self::$name($it) };
    (@operator $module:ident $name:ident $it:ident) => { &$module::$name };
    (@operator $module:ident $name:ident $it:ident $settings:ident) => { $it };
    (@fields $it:ident) => { Vec::new() };
    (@fields $it:ident $settings:ident) => { StepOperator::operator_form_fields($it) };
}

operators! {
    /// Gives the hands other configurations.
    Configure(ConfigureSettings) in configure;
    /// Moves the hands elsewhere.
    Place(PlaceSettings) in place_operator with PlacementGoal;
    /// Turns the hands.
    Orient(OrientSettings) in orient_operator with AxisTurn;
    /// Carries the hands along a path.
    Travel(TravelSettings) in travel;
    /// Makes the hands' movement larger or smaller.
    Amplify(AmplifySettings) in amplify;
    /// Plays the movement several times.
    Repeat(RepeatSettings) in repeat_operator;
    /// Plays the movement backwards.
    Reverse in reverse;
    /// Exchanges the movements of the two arms, mirrored at the body's sagittal plane.
    Swap in mirror;
    /// Gives one arm the mirror image of the other's movement.
    Mirror(MirrorSettings) in mirror;
    /// Makes the movement faster or slower.
    Retime(RetimeSettings) in retime with RetimePace;
    /// Keeps a part of the movement and removes the rest.
    Span(SpanSettings) in cut;
    /// Keeps the active part: removes rest at both ends, and odd first and last frames.
    Trim in cut;
    /// Moves the start or the end of a directional verb.
    Indicate(IndicateSettings) in indicate;
    /// Takes head and face from another sign.
    Nonmanual(NonmanualSettings) in nonmanual_operator with ExpressionTimes;
    /// Gives the face values of its own, or the face of another sign.
    Face(FaceSettings) in face_operator;
    /// Puts the movement on another body.
    On(OnBodySettings) in on_body with BUILT_IN_BODY;
}

impl Step {
    /// Refuses settings that could never be evaluated.
    ///
    /// # Errors
    /// [`RecipeError`] with the setting at fault, and [`RecipeError::Empty`] if one is missing.
    pub fn check_step_settings(&self) -> Result<(), RecipeError> {
        self.operator().check_operator_settings()
    }
}

impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.operator().fmt(f)
    }
}
