//! `reverse`: plays the movement backwards; applied twice, it changes nothing.

use chereme_motion::Span;
use chereme_sign::Reading;
use chereme_sign::words::Text;

use crate::ops::say;
use crate::outcome::About;
use crate::work::{Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;

use crate::answers::Given;
use crate::contact::{Carry, Keep};
use crate::error::Cause;
use crate::ops::{Description, Done, Neighbours, Operator, Step, Syntax};
use crate::text::{Parsed, Parser};

/// The operator; it has no settings.
pub(crate) struct Reverse;

impl Syntax for Reverse {
    const NAME: &'static str = "reverse";
    const DESCRIPTION: Description = Description {
        title: Text::new("Reverse", "Inverser"),
        hint: Text::new("backwards", "à l’envers"),
        examples: &[("reverse", Text::new("backwards", "à l’envers"))],
        messages: &[
            Text::new(
                "{n} frames played backwards",
                "{n} images jouées à l’envers",
            ),
            Text::new(
                "{component} {value} is no longer written: it runs the other way",
                "{component} {value} n’est plus dit : il va dans l’autre sens",
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

impl Display for Reverse {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAME)
    }
}

impl Operator for Reverse {
    fn apply(&self, work: &mut Work, _given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(reverse(work).into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        None
    }

    fn after(&self, before: &mut Step) -> Neighbours {
        match before {
            Step::Reverse => Neighbours::Nothing,
            _ => Neighbours::Apart,
        }
    }
}

/// Plays all channels backwards; returns cautions about the result.
pub(crate) fn reverse(work: &mut Work) -> Vec<String> {
    for channel in &mut work.channels {
        channel.rotations.reverse();
        if let Some(places) = &mut channel.translations {
            places.reverse();
        }
    }
    for curve in &mut work.curves {
        curve.values.reverse();
    }
    let end = work.end().micros();
    let mut did = vec![format!("{} frames played backwards", work.frames)];
    for note in &mut work.notes {
        let span = note.span;
        note.span = Span::between(span.end(), span.start()).mirrored(end);
        let (About::Component(component, feature), Some(value)) = (&note.about, note.value.value())
        else {
            continue;
        };
        match say::backwards(*component, feature.as_deref(), value) {
            Some(other) if other == value => {}
            Some(other) => note.value = Reading::Value(other),
            None => {
                did.push(format!(
                    "{component} {value:?} is no longer written: it runs the other way"
                ));
                note.value = Reading::Unset;
            }
        }
    }
    work.notes.sort_by_key(|note| note.span.start());
    work.changed(Group::ALL, "reverse");
    did
}

trait Mirrored {
    fn mirrored(self, end: i64) -> Self;
}

impl Mirrored for Span {
    /// Returns the mirror image of the span in a movement that ends at `end` microseconds.
    fn mirrored(self, end: i64) -> Self {
        let at = |instant: chereme_motion::Instant| {
            chereme_motion::Instant::from_micros(end.saturating_sub(instant.micros()))
        };
        Self::between(at(self.end()), at(self.start()))
    }
}
