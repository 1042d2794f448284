//! `retime`: makes movement faster or slower, as a whole or phase by phase.

use chereme_motion::{Instant, Side, Span};
use chereme_sign::Component;
use chereme_sign::words::Text;

use crate::error::Cause;
use crate::ops::{Description, join, say};
use crate::outcome::About;
use crate::work::{Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::Given;
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Done, Operator, Syntax};
use crate::text::{Parsed, Parser, list};
use crate::units::{Factor, Seconds};

/// Settings of `retime 150%`, `retime to 2s`, `retime 100%, 50%, to 1s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Retime {
    /// One pace for the whole sign, or one for each of its successive phases.
    pub paces: Vec<Pace>,
}

/// A new length of time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Pace {
    /// The factor on the old length: 2 makes it twice as long.
    Times(Factor),
    /// The length itself.
    To(Seconds),
}

impl Syntax for Retime {
    const NAME: &'static str = "retime";
    const DESCRIPTION: Description = Description {
        title: Text::new("Speed", "Vitesse"),
        hint: Text::new("slower or faster", "plus lent ou plus vite"),
        examples: &[
            (
                "retime 150%",
                Text::new(
                    "slower: half as long again",
                    "plus lent : une fois et demie la durée",
                ),
            ),
            (
                "retime to 2s",
                Text::new(
                    "as slow or fast as the time demands",
                    "aussi lent ou vite que la durée le veut",
                ),
            ),
            (
                "retime 1, 50%, to 0.3s",
                Text::new("phase by phase", "phase par phase"),
            ),
        ],
        messages: &[
            Text::new("{from} s became {to} s", "{from} s sont devenus {to} s"),
            Text::new("no pace is given", "aucune allure n’est donnée"),
            Text::new(
                "a factor, such as 150%, or \"to\" and a time",
                "un facteur, comme 150%, ou \"to\" et un temps",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let mut paces = Vec::new();
        loop {
            paces.push(if parser.accept("to") {
                Pace::To(parser.quantity("a time, such as 2s")?)
            } else {
                Pace::Times(parser.quantity("a factor, such as 150%, or \"to\" and a time")?)
            });
            if !parser.comma() {
                return Ok(Self { paces });
            }
        }
    }

    fn usual() -> Self {
        Self {
            paces: vec![Pace::Times(Factor(1.5))],
        }
    }
}

impl Display for Retime {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("retime ")?;
        list(f, &self.paces, ", ")
    }
}

impl Display for Pace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Times(factor) => write!(f, "{factor}"),
            Self::To(seconds) => write!(f, "to {seconds}"),
        }
    }
}

impl Operator for Retime {
    fn check(&self) -> Result<(), RecipeError> {
        check::filled(Self::NAME, &self.paces, "no pace is given")?;
        self.paces.iter().try_for_each(|pace| match *pace {
            Pace::Times(by) => check::range(Self::NAME, "the factor", by.0, 0.05, 20.0),
            Pace::To(time) => check::range(Self::NAME, "the time", time.0, 0.01, 600.0),
        })
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        Ok(retime(work, &self.paces, given.text)?.into())
    }

    fn contacts(&self, _handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Anytime, Keep::None))
    }

    fn is_nothing(&self) -> bool {
        self.paces == [Pace::Times(Factor(1.0))]
    }
}

/// Changes the length of the movement, or of each of its phases.
///
/// Phases begin and end with the dominant hand's movements, else with its placements, else with its configurations,
/// whichever of these are annotated.
pub(crate) fn retime(
    work: &mut Work,
    paces: &[Pace],
    operator: &str,
) -> Result<Vec<String>, Cause> {
    let bounds = match paces {
        [_] => vec![0, work.frames],
        _ => phases(work),
    };
    let count = bounds.len() - 1;
    if paces.len() != count {
        return Err(Cause::Phases {
            given: paces.len(),
            phases: count,
        });
    }
    let mut did = Vec::new();
    let mut new = vec![0.0];
    for (pair, pace) in bounds.windows(2).zip(paces) {
        let frames = (pair[1] - pair[0]) as f64;
        let length = match *pace {
            Pace::Times(factor) => frames * factor.0,
            Pace::To(seconds) => seconds.0 / work.rate.frame_time(),
        };
        did.push(format!(
            "{:.2} s became {:.2} s",
            frames * work.rate.frame_time(),
            length * work.rate.frame_time()
        ));
        new.push(new[new.len() - 1] + length);
    }
    let map = Map {
        old: bounds.iter().map(|&bound| bound as f64).collect(),
        new,
    };
    let other = map.new.last() != map.old.last();
    warp(work, &map)?;
    if other {
        say::withdraw(work, &Side::BOTH, operator, |component, feature| {
            component == Component::Movement && feature == Some("manner")
        });
    }
    work.changed(Group::ALL, operator);
    Ok(did)
}

/// Makes the movement `factor` times as long.
pub(crate) fn stretch(work: &mut Work, factor: f64) -> Result<(), Cause> {
    let frames = work.frames as f64;
    warp(
        work,
        &Map {
            old: vec![0.0, frames],
            new: vec![0.0, frames * factor],
        },
    )
}

/// A piecewise linear map between old and new frames.
struct Map {
    old: Vec<f64>,
    new: Vec<f64>,
}

fn through(from: &[f64], to: &[f64], at: f64) -> f64 {
    let n = from
        .partition_point(|&bound| bound <= at)
        .clamp(1, from.len() - 1);
    let (a, b) = (from[n - 1], from[n]);
    let share = if b > a { (at - a) / (b - a) } else { 0.0 };
    to[n - 1] + (to[n] - to[n - 1]) * share
}

fn warp(work: &mut Work, map: &Map) -> Result<(), Cause> {
    let frames = map.new.last().copied().unwrap_or(0.0).round().max(1.0) as usize;
    join::check_length(work, frames)?;
    let same = map.old == map.new;
    if same {
        return Ok(());
    }
    // Frame n covers the time from n to n + 1: middles map to middles.
    let at: Vec<f64> = (0..frames)
        .map(|frame| through(&map.new, &map.old, frame as f64 + 0.5) - 0.5)
        .collect();
    work.sample(&at);
    let rate = work.rate.per_second();
    let moved = |instant: Instant| {
        Instant::from_seconds(through(&map.old, &map.new, instant.seconds() * rate) / rate)
    };
    let end = work.end();
    for note in &mut work.notes {
        let (start, stop) = (
            moved(note.span.start()).min(end),
            moved(note.span.end()).min(end),
        );
        note.span = Span::between(start, stop);
    }
    Ok(())
}

/// Returns the frames at which phases begin, and the last one ends.
fn phases(work: &Work) -> Vec<usize> {
    let dominant = work.handedness.dominant();
    let sides: [Side; 2] = [dominant, dominant.other()];
    let components = [
        Component::Movement,
        Component::Placement,
        Component::Configuration,
    ];
    let found = sides.into_iter().find_map(|side| {
        components.into_iter().find_map(|component| {
            let about = About::Component(component, None);
            let spans: Vec<Span> = work
                .notes
                .iter()
                .filter(|note| note.hand == Some(side) && note.about == about)
                .map(|note| note.span)
                .collect();
            (!spans.is_empty()).then_some(spans)
        })
    });
    let mut bounds = vec![0, work.frames];
    for span in found.into_iter().flatten() {
        bounds.extend([
            work.rate.frame_at(span.start()),
            work.rate.frame_at(span.end()),
        ]);
    }
    bounds.retain(|&bound| bound <= work.frames);
    bounds.sort_unstable();
    bounds.dedup();
    bounds
}
