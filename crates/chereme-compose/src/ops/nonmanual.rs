//! `nonmanual from`: takes head and face from another sign.

use std::sync::Arc;

use chereme_sign::Component;
use chereme_sign::words::Text;

use crate::error::Cause;
use crate::ops::retarget::{self, TargetBody};
use crate::outcome::{About, Curve, Note};
use crate::sources::Material;
use crate::work::{Group, Work, groups};
use std::fmt::{self, Display, Formatter};

use chereme_motion::Side;
use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::cut::CutEnds;
use crate::ops::{Description, Done, Field, FieldSetting, Operator, Syntax, expression};
use crate::recipe::Cut;
use crate::resolve::{ExpressionInput, MaterialInput};
use crate::text::{Name, Parsed, Parser, list};
use crate::units::Seconds;

/// Settings of `nonmanual from TOKEN`: head and face of another sign, fitted to this one's time, and of `nonmanual wh
/// from recording:3 over 0.4s..1.9s by phases`: an expression transferred phase by phase.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Nonmanual {
    /// The other sign's address.
    pub from: String,
    /// The function of the expression, such as `wh`; `None` for the only expression at the address.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub function: Option<String>,
    /// The part of this movement for the expression; `None` for all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<Over>,
    /// Whether each phase of the expression is stretched to the same phase here; otherwise the whole is stretched
    /// evenly.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub by_phases: bool,
}

/// The times of an expression in a movement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Over {
    /// Over the signs of this part, `0.4s..1.9s`: the milestones follow from them.
    Part(Cut),
    /// With these milestones M1 to M5, `0s, 0.4s, 1.2s, 1.9s, 2.4s`; M3 is M2 if one sign is spanned.
    At([Seconds; 5]),
}

/// The other sign.
const FROM: Slot<MaterialInput> = Slot::new("nonmanual/from");
/// The transferred expression.
const EXPRESSION: Slot<ExpressionInput> = Slot::new("nonmanual/expression");

impl Nonmanual {
    /// Returns head and face of a whole sign, fitted to this one's time.
    #[must_use]
    pub fn of(from: impl Into<String>) -> Self {
        Self {
            from: from.into(),
            ..Self::default()
        }
    }

    /// Returns whether it transfers an expression with milestones, instead of a whole sign.
    #[must_use]
    pub fn is_expression(&self) -> bool {
        self.by_phases || self.over.is_some() || self.function.is_some()
    }
}

impl Syntax for Nonmanual {
    const NAME: &'static str = "nonmanual";
    const KEYWORDS: &'static [&'static str] = &["over", "phases"];
    const DESCRIPTION: Description = Description {
        title: Text::new("Face and head", "Visage et tête"),
        hint: Text::new(
            "head and face of another sign",
            "tête et visage d’un autre signe",
        ),
        examples: &[
            (
                "nonmanual from BOL",
                Text::new(
                    "head and face of another sign",
                    "tête et visage d’un autre signe",
                ),
            ),
            (
                "nonmanual wh from BOL over 0.4s..1.9s by phases",
                Text::new(
                    "an expression, fitted to a part by its milestones",
                    "une expression, ajustée à une partie par ses jalons",
                ),
            ),
        ],
        messages: &[
            Text::new(
                "{n} joints of the head from {sign} ({own} s stretched to {time} s)",
                "{n} articulations de la tête d’après {sign} ({own} s étirées à {time} s)",
            ),
            Text::new(
                "{function} from {sign}: {own} onto {target}",
                "{function} d’après {sign} : {own} sur {target}",
            ),
            Text::new(
                "the name of the function is empty",
                "le nom de la fonction est vide",
            ),
            Text::new(
                "milestones decrease; write M1 to M5 in order of time",
                "les jalons reculent ; écrivez M1 à M5 dans l’ordre du temps",
            ),
            Text::new(
                "a part such as 0.4s..1.9s, or five times with commas between",
                "une partie comme 0.4s..1.9s, ou cinq temps séparés par des virgules",
            ),
            Text::new(
                "the mouth keeps its own movement",
                "la bouche garde son propre mouvement",
            ),
            Text::new(
                "the first {time} s lie before the movement and are not seen",
                "les premières {time} s sont avant le mouvement et ne se voient pas",
            ),
            Text::new(
                "the last {time} s lie after the movement and are not seen",
                "les dernières {time} s sont après le mouvement et ne se voient pas",
            ),
            Text::new(
                "{head} joints of the head and {trunk} of the trunk",
                "{head} articulations de la tête et {trunk} du tronc",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let function = match parser.word() {
            Some("from") => None,
            _ => Some(parser.name("\"from\" and a sign")?),
        };
        parser.expect("from", "\"from\" and a sign")?;
        let from = parser.name("a sign")?;
        let over = parser.accept("over").then(|| over(parser)).transpose()?;
        let by_phases = parser.accept("by");
        if by_phases {
            parser.expect("phases", "\"phases\"")?;
        }
        Ok(Self {
            from,
            function,
            over,
            by_phases,
        })
    }

    fn usual() -> Self {
        Self::default()
    }
}

/// Reads a part of a movement, or the five milestones of an expression.
fn over(parser: &mut Parser<'_>) -> Parsed<Over> {
    let start = parser.place();
    let mut times: Vec<Seconds> = Vec::new();
    while times.len() < 5 {
        let Ok(time) =
            parser.quantity("a part such as 0.4s..1.9s, or five times with commas between")
        else {
            break;
        };
        times.push(time);
        if times.len() < 5 && !parser.comma() {
            break;
        }
    }
    if let Ok(times) = times.try_into() {
        return Ok(Over::At(times));
    }
    parser.back_to(start);
    parser.cut().map(Over::Part)
}

impl Display for Nonmanual {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("nonmanual ")?;
        if let Some(function) = &self.function {
            write!(f, "{} ", Name(function))?;
        }
        write!(f, "from {}", Name(&self.from))?;
        match &self.over {
            None => {}
            Some(Over::Part(cut)) => write!(f, " over {}", CutEnds(cut))?,
            Some(Over::At(times)) => {
                f.write_str(" over ")?;
                list(f, times, ", ")?;
            }
        }
        f.write_str(if self.by_phases { " by phases" } else { "" })
    }
}

impl Operator for Nonmanual {
    fn check(&self) -> Result<(), RecipeError> {
        let (step, function) = (Self::NAME, self.function.as_deref());
        check::named(step, &self.from, "the name of the sign is empty")?;
        check::optional(function, step, "the name of the function is empty")?;
        match &self.over {
            None => Ok(()),
            Some(Over::Part(cut)) => check::part(step, cut),
            Some(Over::At(times)) => {
                for at in times {
                    check::range(step, "a milestone", at.0, -check::LONGEST, check::LONGEST)?;
                }
                if times.windows(2).any(|pair| pair[0].0 > pair[1].0) {
                    let what = "milestones decrease; write M1 to M5 in order of time";
                    return Err(RecipeError::Empty { step, what });
                }
                Ok(())
            }
        }
    }

    fn resolve(&self, ask: &mut Ask<'_>, _setting: &Setting) -> Result<(), Cause> {
        let material = if self.is_expression() {
            let function = self.function.as_deref();
            let found = ask.sources.expression(&self.from, function)?;
            let input = ExpressionInput {
                function: found.function,
                milestones: found.milestones,
            };
            ask.put(&EXPRESSION, input);
            found.material
        } else {
            ask.sources.material(&self.from)?
        };
        ask.keep(&FROM, material).map(|_| ())
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        let donor = given.material(&FROM)?;
        let did = match given.get(&EXPRESSION) {
            Some(found) => expression::expression(work, donor, self, found, given.text)?,
            None => nonmanual(work, donor, given.text)?,
        };
        Ok(did.into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::All(&Side::BOTH)))
    }

    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        let field = Field::Sign(&mut self.from);
        vec![FieldSetting::new(Text::new("from sign", "du signe"), field)]
    }
}

/// Gives head, neck, jaw and eyes their movement from another sign, stretched to this one's time.
pub(crate) fn nonmanual(
    work: &mut Work,
    donor: &Material,
    operator: &str,
) -> Result<Vec<String>, Cause> {
    let mut other = Work::of(donor);
    let (seconds, own) = (other.span().seconds(), work.span().seconds());
    if other.skeleton != work.skeleton {
        other = retarget::retarget(&other, &TargetBody::at_rest(&work.skeleton, &work.anatomy))?;
    } else {
        other.skeleton = Arc::clone(&work.skeleton);
    }
    let last = (other.frames - 1) as f64 / work.frames.saturating_sub(1).max(1) as f64;
    let at: Vec<f64> = (0..work.frames).map(|frame| frame as f64 * last).collect();
    other.sample(&at);
    let groups = groups(&work.skeleton, &work.anatomy);
    let head: Vec<usize> = (0..groups.len())
        .filter(|&j| groups[j] == Group::Head)
        .collect();
    if head.is_empty() {
        return Err(Cause::NoHead);
    }
    for &joint in &head {
        work.channels[joint] = other.channels[joint].clone();
    }
    let is_nonmanual =
        |note: &Note| matches!(note.about, About::Component(Component::NonManual, _));
    work.notes.retain(|note| !is_nonmanual(note));
    let stretch = own / seconds.max(1e-9);
    let scaled = |instant: chereme_motion::Instant| {
        chereme_motion::Instant::from_seconds(instant.seconds() * stretch).min(work.end())
    };
    let notes: Vec<Note> = other
        .notes
        .iter()
        .filter(|note| is_nonmanual(note))
        .map(|note| Note {
            span: chereme_motion::Span::between(scaled(note.span.start()), scaled(note.span.end())),
            ..note.clone()
        })
        .collect();
    work.notes.extend(notes);
    // Trunk and shoulders keep this sign's movement.
    let of_body = |curve: &Curve| {
        ["body.", "shoulders."]
            .iter()
            .any(|part| curve.name.starts_with(part))
    };
    work.curves.retain(of_body);
    work.curves
        .extend(other.curves.into_iter().filter(|curve| !of_body(curve)));
    work.changed([Group::Head], operator);
    Ok(vec![format!(
        "{} joints of the head from {} ({seconds:.2} s stretched to {own:.2} s)",
        head.len(),
        donor.address
    )])
}
