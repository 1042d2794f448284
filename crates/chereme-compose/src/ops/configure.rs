//! `configure`: gives the hands other shapes over the spans in which the sign has its own.

use std::ops::Range;

use chereme_motion::glam::DQuat;
use chereme_motion::{Side, Span};
use chereme_sign::words::Text;
use chereme_sign::{Component, Reading};

use crate::course::Course;
use crate::error::Cause;
use crate::ops::say;
use crate::outcome::{About, Note};
use crate::poses::{self, HandPose};
use crate::work::{Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Description, Done, Operator, Syntax};
use crate::recipe::{Choice, Profile, Transition};
use crate::sources::LearnedProfile;
use crate::stroke::SignStroke;
use crate::text::{Parsed, Parser, list};
use crate::units::Hands;

/// Settings of `configure right U`, `configure both from LION`, `configure right U, S`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Configure {
    /// The hands that change.
    #[serde(default = "crate::recipe::dominant")]
    pub hand: Hands,
    /// One value for the whole sign, or one for each of its successive configurations.
    pub values: Vec<Choice>,
    /// The transition into and out of each value, and from one to the next.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
}

/// The postures chosen for each value, on each side.
const VALUES: Slot<Vec<HandPose>> = Slot::new("configure/values");
/// The learned courses of its transitions.
const VIA: Slot<LearnedProfile> = Slot::new("configure/via");

impl Syntax for Configure {
    const NAME: &'static str = "configure";
    const DESCRIPTION: Description = Description {
        title: Text::new("Handshape", "Configuration"),
        hint: Text::new("another shape of the hand", "une autre forme de la main"),
        examples: &[
            (
                "configure right U",
                Text::new("another handshape", "une autre configuration"),
            ),
            (
                "configure both from LION",
                Text::new(
                    "the handshapes of another sign",
                    "les configurations d’un autre signe",
                ),
            ),
            (
                "configure right U, _",
                Text::new(
                    "for each shape that the sign holds in turn; _ keeps one",
                    "pour chaque forme que le signe tient tour à tour ; _ en garde une",
                ),
            ),
            (
                "configure right best(configuration=U signer=same)",
                Text::new(
                    "that of the best hit of a query",
                    "celle du meilleur résultat d’une requête",
                ),
            ),
        ],
        messages: &[
            Text::new(
                "{value} becomes {other} over {span}, from {origin}",
                "{value} devient {other} sur {span}, d’après {origin}",
            ),
            Text::new(
                "the shape changes in {is} s instead of {asked} s: the sign leaves no more time",
                "la forme change en {is} s au lieu de {asked} s : le signe ne laisse pas plus de temps",
            ),
            Text::new("(no value)", "(sans valeur)"),
            Text::new("no value is given", "aucune valeur n’est donnée"),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let hand = parser.hand().unwrap_or(Hands::Dominant);
        let mut values = vec![parser.choice()?];
        while parser.comma() {
            values.push(parser.choice()?);
        }
        let via = parser.via()?.unwrap_or_default();
        Ok(Self { hand, values, via })
    }

    fn usual() -> Self {
        Self {
            hand: Hands::Dominant,
            values: vec![Choice::Value(String::new())],
            via: Transition::default(),
        }
    }
}

impl Display for Configure {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "configure {} ", self.hand.name())?;
        list(f, &self.values, ", ")?;
        write!(f, "{}", self.via)
    }
}

impl Operator for Configure {
    fn check(&self) -> Result<(), RecipeError> {
        check::filled(Self::NAME, &self.values, "no value is given")?;
        let mut values = self.values.iter();
        values.try_for_each(|value| check::choice(Self::NAME, value))?;
        check::via(Self::NAME, &self.via)
    }

    fn resolve(&self, ask: &mut Ask<'_>, setting: &Setting) -> Result<(), Cause> {
        for &side in self.hand.sides(setting.handedness) {
            for (n, choice) in self.values.iter().enumerate() {
                if *choice != Choice::Keep {
                    let poses = poses::choose(ask.sources, choice, side, setting)?;
                    ask.put(&VALUES.of(n, side), poses);
                }
            }
        }
        ask.course(&VIA, &self.via)
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        let course = given.course(&VIA, &self.via, Profile::Sigmoid)?;
        let time = self.via.time.map(|time| time.0);
        let mut did = Vec::new();
        for &side in self.hand.sides(work.handedness) {
            let mut values: Vec<Option<&[HandPose]>> = Vec::with_capacity(self.values.len());
            for (n, choice) in self.values.iter().enumerate() {
                values.push(match choice {
                    Choice::Keep => None,
                    _ => Some(given.need(&VALUES.of(n, side))?)
                        .filter(|poses| !poses.is_empty())
                        .map(Vec::as_slice)
                        .ok_or(Cause::Input)
                        .map(Some)?,
                });
            }
            let fingers = &course.fingers;
            did.extend(configure(work, side, &values, fingers, time, given.text)?);
        }
        Ok(did.into())
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::All(self.hand.sides(handedness))))
    }

    fn is_nothing(&self) -> bool {
        self.values == [Choice::Keep]
    }
}

/// The usual time in which a hand changes its shape, in seconds.
const CHANGE: f64 = 0.2;

/// Gives the hand of `side` the values, one for the whole sign or one for each span; `None` keeps a span's own.
///
/// Only joints below the wrist change. Between two spans the fingers go from one value to the next, in the time that
/// the sign itself takes for it, or `time`; before the first span and after the last they come from and return to the
/// sign's own movement.
pub(crate) fn configure(
    work: &mut Work,
    side: Side,
    values: &[Option<&[HandPose]>],
    course: &Course,
    time: Option<f64>,
    operator: &str,
) -> Result<Vec<String>, Cause> {
    if !work.anatomy.has_fingers(side) {
        return Err(Cause::NoFingers(side));
    }
    if work.held(side, Component::Configuration).is_empty() && work.handedness.dominant() == side {
        // A value of the sign as a whole belongs to the dominant hand.
        for note in &mut work.notes {
            let whole = note.about == About::Component(Component::Configuration, None);
            note.hand = note
                .hand
                .or((whole && note.value.value().is_some()).then_some(side));
        }
    }
    if values.iter().any(Option::is_some) {
        say::withdraw(work, &[side], operator, |component, feature| {
            component == Component::Configuration && feature.is_some_and(|it| it != "handedness")
        });
    }
    let mut held = work.held(side, Component::Configuration);
    if held.is_empty() {
        work.notes.push(Note {
            hand: Some(side),
            about: About::Component(Component::Configuration, None),
            value: Reading::Unset,
            span: work.rate.span(SignStroke::of_work(work)?.frames),
            origin: operator.to_owned(),
        });
        held.push(work.notes.len() - 1);
    }
    let chosen = deal(values, held.len(), side)?;
    let mut did = Vec::new();
    let mut stretches = Vec::with_capacity(held.len());
    for (&note, pose) in held.iter().zip(chosen) {
        let frames = work.rate.frames_in(work.notes[note].span);
        let frames = frames.start.min(work.frames)..frames.end.min(work.frames);
        let joints = match pose {
            None => None,
            Some(pose) => {
                let found = poses::rotations(&work.skeleton, &work.anatomy, side, pose);
                let found = found.ok_or(Cause::NoFingers(side))?;
                did.push(describe(&work.notes[note], pose));
                let note = &mut work.notes[note];
                note.value = pose.value.clone().map_or(Reading::Unset, Reading::Value);
                note.origin = pose.origin.to_string();
                Some(found)
            }
        };
        stretches.push(Stretch { frames, joints });
    }
    let mut shortest = usize::MAX;
    for joint in work.anatomy.fingers(side) {
        let column: Vec<Option<DQuat>> = stretches.iter().map(|s| s.rotation(joint)).collect();
        if column.iter().any(Option::is_some) {
            let least = overwrite(work, joint, &stretches, &column, course, time);
            shortest = shortest.min(least);
        }
    }
    let is = shortest as f64 * work.rate.frame_time();
    if let Some(asked) = time.filter(|asked| is + work.rate.frame_time() < *asked) {
        did.push(format!(
            "the shape changes in {is:.2} s instead of {asked:.2} s: the sign leaves no more time"
        ));
    }
    work.changed([Group::Fingers(side)], operator);
    Ok(did)
}

/// Returns one value for each span.
fn deal<'a>(
    values: &[Option<&'a [HandPose]>],
    held: usize,
    side: Side,
) -> Result<Vec<Option<&'a HandPose>>, Cause> {
    let count = |given| Cause::Count { given, held, side };
    if let [Some(poses)] = values {
        return match poses {
            [one] => Ok(vec![Some(one); held]),
            many if many.len() == held => Ok(many.iter().map(Some).collect()),
            many if held == 1 => Ok(vec![many.first()]),
            many => Err(count(many.len())),
        };
    }
    if values.len() != held {
        return Err(count(values.len()));
    }
    Ok(values
        .iter()
        .map(|poses| poses.and_then(<[HandPose]>::first))
        .collect())
}

struct Stretch {
    frames: Range<usize>,
    joints: Option<Vec<(usize, DQuat)>>,
}

impl Stretch {
    fn rotation(&self, joint: usize) -> Option<DQuat> {
        let joints = self.joints.as_ref()?;
        joints
            .iter()
            .find(|(j, _)| *j == joint)
            .map(|(_, rotation)| *rotation)
    }
}

/// Writes the key values of one joint over their spans, then the transitions between them; returns the frames of the
/// shortest transition, or more than any movement has.
fn overwrite(
    work: &mut Work,
    joint: usize,
    stretches: &[Stretch],
    values: &[Option<DQuat>],
    course: &Course,
    time: Option<f64>,
) -> usize {
    let frames = work.frames;
    let mut shortest = usize::MAX;
    let length = ((time.unwrap_or(CHANGE) / work.rate.frame_time()).round() as usize).max(1);
    let source = work.channels[joint].rotations.clone();
    let column = &mut work.channels[joint].rotations;
    for (stretch, value) in stretches.iter().zip(values) {
        if let Some(value) = value {
            column[stretch.frames.clone()].fill(*value);
        }
    }
    for edge in 0..=stretches.len() {
        let before = edge.checked_sub(1).and_then(|n| values[n]);
        let after = values.get(edge).copied().flatten();
        if before.is_none() && after.is_none() {
            continue;
        }
        let from = edge.checked_sub(1).map_or(0, |n| stretches[n].frames.end);
        let to = stretches
            .get(edge)
            .map_or(frames, |s| s.frames.start)
            .max(from);
        let window = match edge {
            0 => to.saturating_sub(length).max(from)..to,
            _ if edge == stretches.len() => from..(from + length).min(to),
            _ => between(
                from,
                to,
                length,
                time.is_some(),
                &stretches[edge - 1..=edge],
            ),
        };
        if !window.is_empty() || (edge > 0 && edge < stretches.len()) {
            shortest = shortest.min(window.len());
        }
        let steps = (window.len() + 1) as f64;
        for (n, frame) in window.enumerate() {
            let a = before.unwrap_or(source[frame]);
            let b = after.unwrap_or(source[frame]);
            column[frame] = course.rotation(a, b, (n + 1) as f64 / steps);
        }
    }
    shortest
}

/// Returns the frames in which one value becomes the next: the gap between their spans or, if a time is asked for, the
/// middle of the gap; if the gap is too short, also up to a third of each span.
fn between(from: usize, to: usize, length: usize, asked: bool, spans: &[Stretch]) -> Range<usize> {
    let gap = to - from;
    if gap >= length || (gap > 0 && !asked && gap * 2 >= length) {
        let length = if asked { length } else { gap };
        let start = from + (gap - length) / 2;
        return start..start + length;
    }
    let more = (length - gap).div_ceil(2);
    let back = more.min(spans[0].frames.len() / 3);
    let ahead = more.min(spans[1].frames.len() / 3);
    from - back..(to + ahead).min(spans[1].frames.end.max(to))
}

fn describe(note: &Note, pose: &HandPose) -> String {
    let name = |value: Option<&str>| value.map_or("(no value)".to_owned(), str::to_owned);
    format!(
        "{} becomes {} over {}, from {}",
        name(note.value.value()),
        name(pose.value.as_deref()),
        shown(note.span),
        pose.origin
    )
}

fn shown(span: Span) -> String {
    format!("{}–{}", span.start(), span.end())
}
