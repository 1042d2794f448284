//! The operators, one module each, and the list of all.
//!
//! An operator is a struct of settings with its text and its words ([`Syntax`]) and its effect ([`Operator`]), all in
//! its module. To add one, write that module and a row of the list below; the tree, its JSON, the text's parser and
//! printer, the reserved words, checks, the resolver, the evaluator, the handling of contacts, the help, the French of
//! its report and the window's card follow from the row.

use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting};
use crate::contact::{Carry, Keep};
use crate::error::{Cause, RecipeError};
use crate::language::Language;
use crate::outcome::{HandReport, JoinReport};
use crate::text::{Parsed, Parser};
use crate::work::Work;

pub(crate) mod amplify;
pub(crate) mod clear;
pub(crate) mod configure;
pub(crate) mod cut;
mod description;
pub(crate) mod expression;
mod field;
pub(crate) mod indicate;
pub(crate) mod join;
pub(crate) mod mirror;
pub(crate) mod nonmanual;
pub(crate) mod notated;
pub(crate) mod orient;
pub(crate) mod place;
pub(crate) mod point;
pub(crate) mod repeat;
pub(crate) mod retarget;
pub(crate) mod retime;
pub(crate) mod reverse;
pub(crate) mod say;
pub(crate) mod spell;
pub(crate) mod then;
pub(crate) mod travel;

pub use description::Description;
pub use field::{Field, Setting as FieldSetting};

/// The effect of an operator, and its part in checks, answers and contacts.
pub(crate) trait Operator: Display {
    /// Refuses settings that could never be evaluated.
    fn check(&self) -> Result<(), RecipeError> {
        Ok(())
    }

    /// Asks the corpus for the inputs of the operator.
    fn resolve(&self, _ask: &mut Ask<'_>, _setting: &Setting) -> Result<(), Cause> {
        Ok(())
    }

    /// Makes the movement long enough for what the operator does with it, before contacts are looked for; returns a
    /// description if it became longer.
    fn make_time(&self, _work: &mut Work) -> Result<Option<String>, Cause> {
        Ok(None)
    }

    /// Changes the movement.
    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause>;

    /// Returns the effect of the operator on contacts, and those that it must keep; `None` if it cannot lose any, or
    /// handles them itself.
    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)>;

    /// Returns whether the operator leaves every movement as it is.
    fn is_nothing(&self) -> bool {
        false
    }

    /// Returns the relation of this operator to one directly before it, which may absorb this one.
    fn after(&self, _before: &mut Step) -> Neighbours {
        Neighbours::Apart
    }

    /// Returns the settings that a form shows with common fields; empty for an operator with a form of its own.
    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        Vec::new()
    }
}

/// The text of an operator. [`parse`](Self::parse) reads the text that its [`Display`] writes.
pub(crate) trait Syntax: Operator + Sized {
    /// The name: the key in JSON, and in most cases the word that begins the text.
    const NAME: &'static str;
    /// The words about the operator that people read.
    const DESCRIPTION: Description;
    /// The words that begin the text.
    const WORDS: &'static [&'static str] = &[Self::NAME];
    /// Further words with a meaning; names that equal one of them are quoted.
    const KEYWORDS: &'static [&'static str] = &[];

    /// Reads the settings after `word`, the word that began the operator.
    fn parse(parser: &mut Parser<'_>, word: &str) -> Parsed<Self>;

    /// Returns an operator for a new form, with a visible effect or an empty name.
    fn usual() -> Self;
}

/// The relation of two successive operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Neighbours {
    /// Both are applied.
    Apart,
    /// The first absorbed the second.
    One,
    /// They cancel out.
    Nothing,
}

/// The effect of an operator or source, for the report.
#[derive(Default)]
pub(crate) struct Done {
    pub(crate) did: Vec<String>,
    pub(crate) residual: Option<f64>,
    pub(crate) moved: Option<[f64; 3]>,
    pub(crate) language: Option<Language>,
    pub(crate) hands: Vec<HandReport>,
    pub(crate) joins: Vec<JoinReport>,
    /// Contacts that it lost.
    pub(crate) lost: Vec<String>,
    pub(crate) warnings: Vec<String>,
}

impl From<Vec<String>> for Done {
    fn from(did: Vec<String>) -> Self {
        Self {
            did,
            ..Self::default()
        }
    }
}

impl From<(Vec<String>, f64)> for Done {
    fn from((did, residual): (Vec<String>, f64)) -> Self {
        Self {
            did,
            residual: Some(residual),
            ..Self::default()
        }
    }
}

impl From<join::Done> for Done {
    fn from(done: join::Done) -> Self {
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
                    $(Self::$name { .. } => <operators!(@type $module $name $($settings)?)>::NAME,)*
                }
            }

            /// Returns the words about the operator that people read.
            #[must_use]
            pub fn description(&self) -> &'static Description {
                match self {
                    $(Self::$name { .. } => {
                        &<operators!(@type $module $name $($settings)?)>::DESCRIPTION
                    })*
                }
            }

            /// The words about every operator, in the order of the list.
            pub const DESCRIPTIONS: &'static [Description] = &[
                $(<operators!(@type $module $name $($settings)?)>::DESCRIPTION),*
            ];

            /// Returns one of each operator, for a new form: with a visible effect or an empty name.
            #[must_use]
            pub fn usual() -> Vec<Self> {
                vec![$(operators!(@step $module $name $($settings)?)(Syntax::usual())),*]
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

            /// The words that begin operators, and all other words with a meaning in one.
            pub(crate) const SPELLINGS: &'static [(&'static [&'static str], &'static [&'static str])] = &[
                $((
                    <operators!(@type $module $name $($settings)?)>::WORDS,
                    <operators!(@type $module $name $($settings)?)>::KEYWORDS,
                )),*
            ];

            /// Reads the operator that `word` begins; `None` for other words.
            pub(crate) fn parse(parser: &mut Parser<'_>, word: &str) -> Option<Parsed<Self>> {
                $(if <operators!(@type $module $name $($settings)?)>::WORDS.contains(&word) {
                    let read = Syntax::parse(parser, word);
                    return Some(read.map(operators!(@step $module $name $($settings)?)));
                })*
                None
            }

            pub(crate) fn operator(&self) -> &dyn Operator {
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
    (@fields $it:ident $settings:ident) => { Operator::fields($it) };
}

operators! {
    /// Gives the hands other configurations.
    Configure(Configure) in configure;
    /// Moves the hands elsewhere.
    Place(Place) in place with Goal;
    /// Turns the hands.
    Orient(Orient) in orient with Turn;
    /// Carries the hands along a path.
    Travel(Travel) in travel;
    /// Makes the hands' movement larger or smaller.
    Amplify(Amplify) in amplify;
    /// Plays the movement several times.
    Repeat(Repeat) in repeat;
    /// Plays the movement backwards.
    Reverse in reverse;
    /// Exchanges the movements of the two arms, mirrored at the body's sagittal plane.
    Swap in mirror;
    /// Gives one arm the mirror image of the other's movement.
    Mirror(Mirror) in mirror;
    /// Makes the movement faster or slower.
    Retime(Retime) in retime with Pace;
    /// Keeps a part of the movement and removes the rest.
    Span(Cut) in cut;
    /// Keeps the active part: removes rest at both ends, and odd first and last frames.
    Trim in cut;
    /// Moves the start or the end of a directional verb.
    Indicate(Indicate) in indicate;
    /// Takes head and face from another sign.
    Nonmanual(Nonmanual) in nonmanual with Over;
}

impl Step {
    /// Returns the words that begin operators, in the order of the list.
    #[must_use]
    pub fn words() -> Vec<&'static str> {
        Self::SPELLINGS
            .iter()
            .flat_map(|(words, _)| words.iter().copied())
            .collect()
    }

    /// Refuses settings that could never be evaluated.
    ///
    /// # Errors
    /// [`RecipeError`] with the setting at fault, and [`RecipeError::Empty`] if one is missing.
    pub fn check(&self) -> Result<(), RecipeError> {
        self.operator().check()
    }
}

impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.operator().fmt(f)
    }
}
