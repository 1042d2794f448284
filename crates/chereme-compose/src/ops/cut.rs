//! `span` and `trim`: cut a part out of the movement, or remove rest at its ends.

use std::ops::Range;

use chereme_motion::ends::{self, Ends};
use chereme_motion::{Clip, Instant, Span};

use crate::error::Cause;
use crate::outcome::About;
use crate::work::{Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::words::Text;
use chereme_sign::{Component, Handedness};
use serde::{Deserialize, Serialize};

use crate::answers::Given;
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Description, Done, Field, FieldSetting, Operator, Syntax};
use crate::text::{Parsed, Parser, list};
use crate::units::Seconds;

/// Settings of `span 0.4s..1.9s`, `span 0.4s..`, `span ..1.9s`: the part of the movement to keep.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// The time at which it begins; `None` for the first frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Seconds>,
    /// The time at which it ends; `None` for the end of the last frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<Seconds>,
}

impl Syntax for Cut {
    const NAME: &'static str = "span";
    const DESCRIPTION: Description = Description {
        title: Text::new("Part", "Extrait"),
        hint: Text::new("a part of the movement", "une partie du mouvement"),
        examples: &[
            ("span 0.4s..1.9s", Text::new("a part of it", "une partie")),
            (
                "span 0.4s..",
                Text::new("all from a time on", "tout à partir d’un temps"),
            ),
        ],
        messages: &[
            Text::new("the movement ends at {time}", "le mouvement finit à {time}"),
            Text::new(
                "kept {from} to {to} of {all}: frames {first} to {last}",
                "gardé de {from} à {to} sur {all} : images {first} à {last}",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        parser.cut()
    }

    fn usual() -> Self {
        Self {
            from: Some(Seconds(0.2)),
            to: None,
        }
    }
}

impl Display for Cut {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "span {}", CutEnds(self))
    }
}

/// Prints the two ends alone: `0.4s..1.9s`.
pub(crate) struct CutEnds<'a>(pub(crate) &'a Cut);

impl Display for CutEnds<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        list(f, self.0.from, "")?;
        f.write_str("..")?;
        list(f, self.0.to, "")
    }
}

impl Operator for Cut {
    fn check(&self) -> Result<(), RecipeError> {
        check::part(Self::NAME, self)
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(span(work, self, given.text)?.into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        None
    }

    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |en, fr, field| FieldSetting::new(Text::new(en, fr), field);
        vec![
            setting("from", "à partir de", Field::Time(&mut self.from, 0.2)),
            setting("to", "jusqu’à", Field::Time(&mut self.to, 1.0)),
        ]
    }
}

/// The operator that removes rest at both ends; it has no settings.
pub(crate) struct Trim;

impl Syntax for Trim {
    const NAME: &'static str = "trim";
    const DESCRIPTION: Description = Description {
        title: Text::new("Trim", "Rogner"),
        hint: Text::new(
            "without rest and odd first and last frames",
            "sans repos ni images fausses au début et à la fin",
        ),
        examples: &[(
            "trim",
            Text::new(
                "rest and odd first and last frames cut off",
                "le repos et les images fausses des bouts coupés",
            ),
        )],
        messages: &[
            Text::new(
                "the movement from rest and back to it is left out: the phases of the sign are known",
                "le mouvement depuis le repos et vers lui est laissé de côté : les phases du signe sont connues",
            ),
            Text::new("left out {what}", "laissé de côté : {what}"),
            Text::new(
                "the movement has no rest before or after it",
                "le mouvement n’a pas de repos avant ou après",
            ),
        ],
    };

    fn parse(_parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        Ok(Self)
    }

    fn usual() -> Self {
        Self
    }
}

impl Display for Trim {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAME)
    }
}

impl Operator for Trim {
    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(trim(work, given.text)?.into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        None
    }
}

/// Keeps the frames that begin in a span.
pub(crate) fn span(work: &mut Work, cut: &Cut, operator: &str) -> Result<Vec<String>, Cause> {
    let whole = work.span();
    let at = |seconds: f64| Instant::from_seconds(seconds);
    let from = cut.from.map_or(whole.start(), |it| at(it.0));
    let to = cut.to.map_or(whole.end(), |it| at(it.0));
    let length = whole.seconds();
    let none = || Cause::Cut { length };
    let wanted = Span::new(from, to.max(from)).map_err(|_| none())?;
    let wanted = wanted.intersection(whole).ok_or_else(none)?;
    let frames = work.rate.frames_in(wanted);
    let frames = frames.start..frames.end.min(work.frames);
    if frames.is_empty() {
        return Err(none());
    }
    let mut did = vec![describe(work, &frames)];
    if to > whole.end() {
        did.push(format!("the movement ends at {}", whole.end()));
    }
    keep(work, frames, operator);
    Ok(did)
}

/// Returns the frames of a sign without the movement from rest to its first phase, and from its last one back to rest:
/// only an end with rest whose phases are known is cut.
pub(crate) fn signed(work: &Work) -> Result<Range<usize>, Cause> {
    let all = 0..work.frames;
    let Some(phases) = phases(work) else {
        return Ok(all);
    };
    let channels = work.channels.clone();
    let clip = Clip::new(work.skeleton.clone(), work.rate, channels)?;
    let active = ends::activity(&clip, &work.anatomy).unwrap_or(all);
    Ok(between_rests(work, &active, &phases))
}

/// Returns the frames from the first phase of a hand to the end of the last one; `None` if no phase is known.
fn phases(work: &Work) -> Option<Range<usize>> {
    let about = About::Component(Component::Movement, Some("phase".to_owned()));
    let notes = work.notes.iter().filter(|note| note.about == about);
    let spans: Vec<Span> = notes.map(|note| note.span).collect();
    let from = spans.iter().map(|span| span.start()).min()?;
    let to = spans.iter().map(|span| span.end()).max()?;
    let frames = work.rate.frames_in(Span::new(from, to).ok()?);
    let frames = frames.start.min(work.frames)..frames.end.min(work.frames);
    (!frames.is_empty()).then_some(frames)
}

/// Returns the frames of the phases at each end that has rest, and all frames at the other.
fn between_rests(work: &Work, active: &Range<usize>, phases: &Range<usize>) -> Range<usize> {
    let rests = (active.start > 0, active.end < work.frames);
    let start = if rests.0 { phases.start } else { 0 };
    let end = if rests.1 { phases.end } else { work.frames };
    start..end
}

/// Keeps the active frames; a movement without rest stays unchanged.
pub(crate) fn trim(work: &mut Work, operator: &str) -> Result<Vec<String>, Cause> {
    let channels = work.channels.clone();
    let clip = Clip::new(work.skeleton.clone(), work.rate, channels)?;
    let odd = Ends::of(&clip, &work.anatomy);
    let moving = ends::activity(&clip, &work.anatomy).unwrap_or(odd.sound.clone());
    let signed = phases(work).map(|phases| between_rests(work, &moving, &phases));
    let active = signed.map_or(moving.clone(), |signed| {
        moving.start.max(signed.start)..moving.end.min(signed.end)
    });
    let active = if active.is_empty() {
        moving.clone()
    } else {
        active
    };
    let mut did: Vec<String> = odd
        .odd
        .iter()
        .map(|odd| format!("left out {odd}"))
        .collect();
    if active == (0..work.frames) {
        did.push("the movement has no rest before or after it".to_owned());
        return Ok(did);
    }
    did.push(describe(work, &active));
    if active != moving {
        did.push(
            "the movement from rest and back to it is left out: the phases of the sign are known"
                .to_owned(),
        );
    }
    keep(work, active, operator);
    Ok(did)
}

fn describe(work: &Work, frames: &Range<usize>) -> String {
    let kept = work.rate.span(frames.clone());
    format!(
        "kept {} to {} of {}: frames {} to {}",
        kept.start(),
        kept.end(),
        work.end(),
        frames.start,
        frames.end - 1
    )
}

fn keep(work: &mut Work, frames: Range<usize>, operator: &str) {
    keep_quietly(work, frames);
    work.changed(Group::ALL, operator);
}

/// Keeps some frames, without a word about it in the sources of the channels.
pub(crate) fn keep_quietly(work: &mut Work, frames: Range<usize>) {
    for channel in &mut work.channels {
        channel.rotations = channel.rotations[frames.clone()].to_vec();
        if let Some(places) = &mut channel.translations {
            *places = places[frames.clone()].to_vec();
        }
    }
    for curve in &mut work.curves {
        curve.values = curve.values[frames.clone()].to_vec();
    }
    let kept = work.rate.span(frames.clone());
    let back = -kept.start().micros();
    work.notes.retain_mut(|note| {
        let left = note.span.intersection(kept);
        let left = left.filter(|span| span.micros() > 0);
        note.span = left.unwrap_or(kept).shifted(back);
        left.is_some()
    });
    work.frames = frames.len();
}
