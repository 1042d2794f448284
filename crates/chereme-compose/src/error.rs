//! The faults of recipes: text that cannot be read, answers that a corpus lacks, steps and notation that cannot be done.

use chereme_motion::BodySide;
use chereme_sign::{ErrorRemedy, RemedyChoice, SignComponent};

use crate::units::UnitError;

/// A recipe that cannot be read or held.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecipeError {
    /// The text is no recipe.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The JSON is of a version that this engine does not know.
    #[error("this recipe is of version {found}; this program reads version 1, so a newer one is needed")]
    Version {
        /// The version as written.
        found: String,
    },
    /// A field of the JSON is missing, unknown or of the wrong kind.
    #[error("{message}")]
    Field {
        /// The fault of the field.
        message: String,
    },
    /// A number is out of range.
    #[error("{step}: {what} is {found}; it must lie between {least} and {most}")]
    Range {
        /// The operator.
        step: &'static str,
        /// The setting.
        what: &'static str,
        /// The number or quantity as written.
        found: String,
        /// The least allowed value.
        least: f64,
        /// The greatest allowed value.
        most: f64,
    },
    /// A list that must hold something is empty, or directions cancel out.
    #[error("{step}: {what}")]
    Empty {
        /// The operator.
        step: &'static str,
        /// A description of the missing thing.
        what: &'static str,
    },
    /// A part of the face does not have a value.
    #[error("face: {0}")]
    Face(#[from] UnknownFaceWord),
    /// There are too many operators, or they are nested too deep.
    #[error("a recipe has at most {most} {what}; split it and store the parts as signs")]
    Size {
        /// The kind of thing that exceeds the limit.
        what: &'static str,
        /// The limit.
        most: usize,
    },
}

/// A text that is no recipe: the place of its fault, and the reason.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("character {}: {problem}", at + 1)]
pub struct TextError {
    /// The text that was read.
    pub text: String,
    /// The character, from 0, at which reading stopped.
    pub at: usize,
    /// The fault there.
    pub problem: RecipeTextProblem,
}

impl TextError {
    /// Returns the text with a mark under the character, on two lines.
    #[must_use]
    pub fn mark_fault_character(&self) -> String {
        format!("{}\n{}^", self.text, " ".repeat(self.at))
    }
}

/// The fault at a character of a recipe's text.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RecipeTextProblem {
    /// A word stands where another one was expected.
    #[error(
        "{} where {expected} was expected{}",
        found.as_ref().map_or("the text ends".to_owned(), |found| format!("{found:?} stands")),
        chereme_sign::text::did_you_mean(nearest.as_deref())
    )]
    Expected {
        /// The expected text.
        expected: &'static str,
        /// The word found; `None` at the end.
        found: Option<String>,
        /// A similar word that would be valid.
        nearest: Option<String>,
    },
    /// A quantity cannot be read.
    #[error(transparent)]
    Unit(UnitError),
    /// A quotation mark or parenthesis is not closed.
    #[error("this {0} is never closed")]
    Unclosed(char),
    /// A part of the face, or a value of it, does not exist.
    #[error(transparent)]
    Face(#[from] UnknownFaceWord),
    /// The query in `best(...)` is invalid.
    #[error("the query is not understood: {0}")]
    Query(String),
    /// The text is too long.
    #[error("the text is longer than {0} bytes")]
    TooLong(usize),
    /// Parentheses are nested too deep.
    #[error("parentheses are nested deeper than {0}")]
    TooDeep(usize),
}

/// A part that a face does not have, or a value that a part of it does not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{of} has no {text:?}; write {}", near.join(", "))]
pub struct UnknownFaceWord {
    /// The face, or the part of it as recipes name it.
    pub of: &'static str,
    /// The part or value as written.
    pub text: String,
    /// Similar words that would be valid, or all of them.
    pub near: Vec<String>,
}

/// A recipe that cannot be evaluated: the step at fault, the reason, and a remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{step}: {cause}{}", remedy_after(cause))]
pub struct MakeError {
    /// The path of the step in the recipe's JSON, such as `/pipe/steps/0`.
    pub path: String,
    /// The source or operator as text.
    pub step: String,
    /// The reason.
    #[source]
    pub cause: StepError,
}

/// The reason why a step cannot be done.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The result is no longer wanted.
    #[error("the evaluation was stopped")]
    Stopped,
    /// The corpus has no answer.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// HamNoSys that cannot be read.
    #[error(transparent)]
    Hamnosys(#[from] chereme_sign::hamnosys::HamnosysError),
    /// Text or phones that cannot be cued.
    #[error("{0}")]
    Utterance(Box<chereme_sign::cue::UtteranceError>),
    /// The corpus holds too few captured keys to measure phases on.
    #[error("the corpus has no captured keys with the tier Hand M1 M2")]
    NoPhases,
    /// Notation that cannot be animated.
    #[error(transparent)]
    Notation(#[from] NotationError),
    /// The body language holds text that is not a number.
    #[error("the body language cannot be used: {0}")]
    Language(String),
    /// The skeleton has no such arm.
    #[error("this skeleton has no {} arm (shoulder, elbow, wrist)", .0.body_side_name())]
    NoArm(BodySide),
    /// The hand has no fingers, or too few to define its palm.
    #[error("the {} hand has no fingers in this skeleton", .0.body_side_name())]
    NoFingers(BodySide),
    /// The skeleton has no head that hangs on a chest.
    #[error("there is no head in this skeleton")]
    NoHead,
    /// Both hands are asked to be at a place on the arms that move.
    #[error("both hands cannot be at {0:?}: it moves with them")]
    BothMove(String),
    /// The movement shows no hand that moves.
    #[error("{address:?} has no movement of hands: {what}")]
    HandsStill {
        /// Its address.
        address: String,
        /// What it lacks.
        what: &'static str,
    },
    /// A target is far beyond the body's reach.
    #[error("the target is {:.0} cm away from the {} shoulder, and the arm is {:.0} cm long", distance * 100.0, side.body_side_name(), arm * 100.0)]
    TooFar {
        /// The arm.
        side: BodySide,
        /// From the shoulder to the target, in metres.
        distance: f64,
        /// The arm's length in metres.
        arm: f64,
    },
    /// A list gives neither one value nor one for each span.
    #[error("{given} values are given, but the {} hand holds {held} one after another", side.body_side_name())]
    Count {
        /// The values given.
        given: usize,
        /// The spans that the sign holds.
        held: usize,
        /// The hand.
        side: BodySide,
    },
    /// A list gives neither one pace nor one for each phase.
    #[error("{given} paces are given, but the sign has {phases} phases")]
    Phases {
        /// The paces given.
        given: usize,
        /// The phases of the sign.
        phases: usize,
    },
    /// A value has no meaning for a body, and no token with movement has it.
    #[error("no sign with movement holds {value:?}, and its inventory gives no {what} for it")]
    NoMeaning {
        /// The value.
        value: String,
        /// The missing thing.
        what: &'static str,
    },
    /// The query finds no token with movement.
    #[error("the query {0:?} finds no sign with movement")]
    NothingFound(String),
    /// A sign that should give a value shows none.
    #[error("{address:?} shows no {what} to take")]
    NothingToTake {
        /// The sign.
        address: String,
        /// The thing it should have shown.
        what: &'static str,
    },
    /// The recipe names a part that the movement does not have.
    #[error("the movement lasts {length:.2} s, so that nothing of it is left")]
    Cut {
        /// The length of the movement in seconds.
        length: f64,
    },
    /// A path that no arm can travel in its time.
    #[error("{:.0} cm in {time:.2} s is faster than any arm", length * 100.0)]
    TooFast {
        /// The length of the path or leg, in metres.
        length: f64,
        /// Its time, in seconds.
        time: f64,
        /// The time that it takes people, in seconds.
        least: f64,
    },
    /// A step would move hips, wrists or feet much faster than its source does.
    #[error("too fast: {speed:.1} m/s at {part}, {added:.1} m/s more than before, and at most {most} m/s can be added")]
    Rushed {
        /// The part of the body: `the hips`, `the wrists`, `the feet`.
        part: &'static str,
        /// Its greatest speed after the step, in metres per second.
        speed: f64,
        /// The difference from its greatest speed before.
        added: f64,
        /// The greatest difference allowed.
        most: f64,
    },
    /// Two pieces do not fit together: something would jump at the join.
    #[error("the two pieces do not meet: {what} would leap by {distance:.2} m, at {speed:.0} m/s")]
    Torn {
        /// The part of the body that would jump: `the right hand`, `the body`.
        what: String,
        /// The distance between its two positions, in metres.
        distance: f64,
        /// The difference of its speeds, in metres per second.
        speed: f64,
    },
    /// The movement has no frame.
    #[error("{0:?} has no frames")]
    Empty(String),
    /// The result would be too long to hold.
    #[error("the result would have {frames} frames, and at most {most} can be generated for this skeleton")]
    TooLong {
        /// Its frames.
        frames: usize,
        /// The limit.
        most: usize,
    },
    /// The corpus has not learned a transition.
    #[error("the corpus shows too few transitions to learn their course from")]
    NoProfile,
    /// A source has changed since the recipe was resolved.
    #[error("{address:?} has changed since this sign was generated")]
    Changed {
        /// The source.
        address: String,
    },
    /// The inputs stored with the recipe do not fit it.
    #[error("the stored inputs lack what this step needs")]
    Input,
    /// The generated movement is not a valid clip.
    #[error("the result is not a valid movement: {0}")]
    Clip(#[from] chereme_motion::ClipError),
}

/// Returns a remedy as it stands after a message.
fn remedy_after(cause: &StepError) -> String {
    cause
        .step_remedy()
        .map_or_else(String::new, |remedy| format!("; {remedy}"))
}

/// The name that was most likely meant, and the one that was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeantName {
    /// The name as written, without quotes.
    pub written: String,
    /// What would be right.
    pub right: String,
}

impl MeantName {
    pub(crate) fn from_written_name(written: &str, right: Option<&str>) -> Option<Self> {
        Some(Self {
            written: written.to_owned(),
            right: right?.to_owned(),
        })
    }
}

impl StepError {
    /// Returns the name that was meant, if a name near to one was written.
    #[must_use]
    pub fn step_meant_name(&self) -> Option<MeantName> {
        match self {
            Self::Source(error) => error.source_meant_name(),
            _ => None,
        }
    }

    /// Returns what would work, if that is known.
    #[must_use]
    pub fn step_remedy(&self) -> Option<ErrorRemedy> {
        const RESOLVE_REMEDY: &str = "resolve the recipe again";
        const ROLES_REMEDY: &str = "name its joints in a roles file, or use a recording that has one";
        let text = match self {
            Self::Source(error) => return error.source_remedy(),
            Self::Utterance(error) => return Some(error.utterance_error_remedy()),
            Self::Notation(error) => return error.notation_remedy().map(ErrorRemedy::from),
            Self::TooFast { least, .. } => {
                let least = least.max(0.01);
                return Some(format!("leave the time out, or give it {least:.2} s or more").into());
            }
            Self::TooFar { distance, arm, .. } => {
                let nearer = (distance - arm) * 100.0;
                return Some(format!("move it nearer by {nearer:.0} cm or more").into());
            }
            Self::Count { held: count, .. } | Self::Phases { phases: count, .. } => {
                return Some(format!("give 1 or {count}").into());
            }
            Self::Stopped => "generate it again",
            Self::NoPhases => "name another rule: paper, attina, sppas or duchnowski",
            Self::Language(_) => "generate the sign again",
            Self::NoArm(_) => ROLES_REMEDY,
            Self::NoFingers(_) => "use a recording of the hands, or name its joints in a roles file",
            Self::NoHead => "name its joint in a roles file",
            Self::BothMove(_) => "name one hand, such as `place right at …`",
            Self::HandsStill { .. } => "name a sign in which a hand moves",
            Self::NoMeaning { .. } => "choose another value, or annotate a sign that has it",
            Self::NothingFound(_) => "loosen it",
            Self::NothingToTake { .. } => "choose another sign",
            Self::Cut { .. } => "name times within it",
            Self::Rushed { .. } => "give it more time, or cut wrong first or last frames off before (`| trim`)",
            Self::Torn { .. } => {
                "cut wrong first or last frames off (`| trim`, or `| span 0.2s..1.5s`), or give the transition more time \
                 (`then via 0.4s`, `repeat 2 gap 0.3s`)"
            }
            Self::Empty(_) => "name a recording with movement",
            Self::TooLong { .. } => "make it shorter, or in several signs",
            Self::NoProfile => "import captured movement, or use sigmoid",
            Self::Changed { .. } | Self::Input => RESOLVE_REMEDY,
            Self::Hamnosys(_) | Self::Clip(_) => return None,
        };
        Some(text.into())
    }
}

/// The reason why the corpus has no answer.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SourceError {
    /// Nothing has this address.
    #[error("{address:?} is not in the corpus")]
    Missing {
        /// The address as written.
        address: String,
        /// A similar address.
        nearest: Option<String>,
    },
    /// Something of another kind has this name.
    #[error("{address:?} is {kind}, and {wanted}")]
    OtherKind {
        /// The address as written.
        address: Box<str>,
        /// What has this name: `a recording`.
        kind: &'static str,
        /// What the recipe needs there: `notation is wanted`.
        wanted: &'static str,
        /// The address that would do.
        right: Option<Box<str>>,
    },
    /// Several things have this address.
    #[error("{address:?} could be any of {}", candidates.join(", "))]
    Ambiguous {
        /// The address as written.
        address: String,
        /// Their unambiguous addresses.
        candidates: Vec<String>,
    },
    /// The sign is a lexicon entry without movement.
    #[error("{address:?} has no movement: it is an entry of a lexicon")]
    NoMovement {
        /// The address as written.
        address: String,
    },
    /// Something has no expression with milestones.
    #[error("{address:?} has no expression of the face to transfer: {why}")]
    Expression {
        /// The address as written.
        address: String,
        /// The reason.
        why: String,
        /// The remedy, if one is known.
        remedy: Option<Box<ErrorRemedy>>,
    },
    /// The sign has no notation.
    #[error("{address:?} has no notation")]
    NoNotation {
        /// The address as written.
        address: String,
    },
    /// No inventory has this value.
    #[error("{text:?} is no {component} of any inventory")]
    UnknownValue {
        /// The component.
        component: SignComponent,
        /// The value as written.
        text: String,
        /// A similar value.
        nearest: Option<String>,
    },
    /// No inventory with this name has letters.
    #[error("{name:?} is no manual alphabet")]
    UnknownAlphabet {
        /// The name as written.
        name: String,
        /// The inventories that have letters.
        known: Vec<String>,
    },
    /// An alphabet does not have a letter.
    #[error("{letter:?} is no letter of the manual alphabet {alphabet:?}")]
    UnknownLetter {
        /// The letter.
        letter: String,
        /// The inventory.
        alphabet: String,
        /// The letters that it has.
        known: String,
    },
    /// The file is not a body language.
    #[error("the body language {name:?} cannot be used: {message}")]
    Language {
        /// The name as written.
        name: String,
        /// The fault.
        message: String,
    },
    /// A query is not understood.
    #[error("the query {query:?} is not understood: {message}")]
    Query {
        /// The query.
        query: String,
        /// The fault and its place.
        message: String,
    },
    /// The corpus cannot be read.
    #[error("the corpus cannot be read: {0}")]
    Unreadable(String),
}

impl SourceError {
    /// Returns the name that was meant, if a name near to one was written.
    #[must_use]
    pub fn source_meant_name(&self) -> Option<MeantName> {
        match self {
            Self::Missing { address, nearest } => MeantName::from_written_name(address, nearest.as_deref()),
            Self::OtherKind { address, right, .. } => MeantName::from_written_name(address, right.as_deref()),
            Self::UnknownValue { text, nearest, .. } => MeantName::from_written_name(text, nearest.as_deref()),
            _ => None,
        }
    }

    /// Returns what would work, if that is known.
    #[must_use]
    pub fn source_remedy(&self) -> Option<ErrorRemedy> {
        let text = match self {
            Self::Missing { nearest, .. } | Self::UnknownValue { nearest, .. } => {
                format!("did you mean {:?}?", nearest.as_ref()?)
            }
            Self::OtherKind { right, .. } => format!("write {} instead", right.as_ref()?),
            Self::Ambiguous { .. } => "name one of them".to_owned(),
            Self::NoMovement { .. } => "name a sign that was captured or generated".to_owned(),
            Self::Expression { remedy, .. } => return remedy.as_deref().cloned(),
            Self::NoNotation { address } => {
                return Some(ErrorRemedy::choice_remedy(
                    RemedyChoice::Notation,
                    format!(
                        "import it as SiGML or HamNoSys, or write it from its movement: \
                         `chereme transcribe CORPUS {address} --store`"
                    ),
                ));
            }
            Self::UnknownAlphabet { known, .. } => match known.as_slice() {
                [] => "there is none".to_owned(),
                known => format!("there is {}", known.join(", ")),
            },
            Self::UnknownLetter { known, .. } => format!("spell with {known} only"),
            Self::Language { .. } => "name default, measured, or a file such as \
                 {\"version\": 1, \"values\": {\"move.big\": [0.5, \"arm\", \"mine\"]}}"
                .to_owned(),
            Self::Query { .. } | Self::Unreadable(_) => return None,
        };
        Some(text.into())
    }
}

/// The reason why notation cannot be animated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotationError {
    /// The body has no arm.
    #[error("the body of {0:?} has no arm with shoulder, elbow and wrist")]
    NoArm(String),
    /// The movement would be too long.
    #[error("the movement would last {seconds:.0} s; at most {most:.0} s can be generated at once")]
    Long {
        /// Its duration in seconds.
        seconds: f64,
        /// The longest duration in seconds.
        most: f64,
    },
    /// A number is not finite.
    #[error(transparent)]
    Clip(#[from] chereme_motion::ClipError),
}

impl NotationError {
    /// Returns what would work, if that is known.
    #[must_use]
    pub fn notation_remedy(&self) -> Option<&'static str> {
        match self {
            Self::NoArm(_) => Some("name them in a roles file"),
            Self::Long { .. } => Some("animate its signs one by one"),
            Self::Clip(_) => None,
        }
    }
}
