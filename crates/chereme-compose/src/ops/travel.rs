//! `travel`: carries the hands along straight legs or a smooth curve.

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::Component;
use chereme_sign::words::Text;

use crate::body::Frame;
use crate::course::Course;
use crate::curve::Spline;
use crate::error::Cause;
use crate::ops::place::{self, describe_reach};
use crate::ops::{retime, say};
use crate::recipe::{Leg, Solver};
use crate::stroke::SignStroke;
use crate::units::{Length, Seconds};
use crate::work::{Columns, Group, Work};
use std::fmt::{self, Display, Formatter};

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Description, Done, Operator, Syntax};
use crate::recipe::{Profile, Transition};
use crate::sources::LearnedProfile;
use crate::text::{Parsed, Parser, list, option, point_text};
use crate::units::{Direction, Hands};

/// Settings of `travel right down 20cm then up 20cm`, and of `travel right through 10cm,5cm,0cm then 20cm,0cm,0cm in
/// 1.2s`: a path of straight legs, or a smooth curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Travel {
    /// The hands that travel.
    #[serde(default = "crate::recipe::dominant")]
    pub hand: Hands,
    /// The legs, one after another; those without a time share the remaining time by their length, no faster than people
    /// sign. The sign becomes longer if it has less time than its path.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<Leg>,
    /// The points of a curve instead of legs: offsets from the hands' usual position to the left, up and forward.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub through: Vec<[Length; 3]>,
    /// The time of the curve; `None` for all of the movement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<Seconds>,
    /// The course along each leg or curve; the default is minimum jerk.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
}

/// The most points of a curve.
const MOST_POINTS: usize = 64;
/// The greatest mean speed, in metres per second, of a path whose time nobody states: the sign becomes longer instead.
const PACE: f64 = 1.2;
/// The greatest mean speeds along a stated leg or curve, in metres per second: beyond the first it is reported, beyond
/// the second no arm can do it.
const FASTEST: (f64, f64) = (1.6, 10.0);
/// The most times that a sign is stretched for its path.
const MOST_STRETCHES: usize = 3;
/// The warning about a time that a path does not have.
const UNUSED: &str =
    "the time after \"via\" is not used: legs and curves have their own, such as left 5cm in 0.2s";
/// The learned courses along the legs.
const VIA: Slot<LearnedProfile> = Slot::new("travel/via");

impl Syntax for Travel {
    const NAME: &'static str = "travel";
    const DESCRIPTION: Description = Description {
        title: Text::new("Path", "Trajet"),
        hint: Text::new(
            "the hands moved along a path",
            "les mains portées le long d’un chemin",
        ),
        examples: &[
            (
                "travel right down 20cm in 0.4s then up 20cm in 0.4s",
                Text::new(
                    "along a path: each leg has its own time",
                    "le long d’un trajet : chaque étape a son temps",
                ),
            ),
            (
                "travel right through 10cm,8cm,0cm then 20cm,0cm,0cm in 1s",
                Text::new(
                    "along a curve: left, up, forward",
                    "le long d’une courbe : gauche, haut, avant",
                ),
            ),
        ],
        messages: &[
            Text::new(
                "the sign became {to} s long instead of {from} s, so that the path has its time",
                "le signe dure {to} s au lieu de {from} s, pour que le trajet ait son temps",
            ),
            Text::new(
                UNUSED,
                "le temps après \"via\" n’est pas utilisé : segments et courbes ont le leur, comme left 5cm in 0.2s",
            ),
            Text::new("the legs take {times}", "les étapes durent {times}"),
            Text::new(
                "{cm} cm in {time} s is faster than people sign",
                "{cm} cm en {time} s, c’est plus vite qu’on ne signe",
            ),
            Text::new("1 leg, {cm} cm in all", "1 étape, {cm} cm en tout"),
            Text::new("{n} legs, {cm} cm in all", "{n} étapes, {cm} cm en tout"),
            Text::new(
                "legs and a curve are given: keep one of them",
                "des segments et une courbe sont donnés : gardez l’un des deux",
            ),
            Text::new(
                "only a curve has a time; each leg has its own, such as left 5cm in 0.2s",
                "seule une courbe a un temps ; chaque segment a le sien, comme left 5cm in 0.2s",
            ),
            Text::new(
                "the curve has more than 64 points",
                "la courbe a plus de 64 points",
            ),
            Text::new(
                "a curve of {cm} cm ({what})",
                "une courbe de {cm} cm ({what})",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let hand = match parser.is_length_next() {
            true => None,
            false => parser.hand(),
        };
        let curved = parser.accept("through");
        let (path, through) = match curved {
            true => (Vec::new(), parser.points()?),
            false => (parser.legs(true)?, Vec::new()),
        };
        let time = match curved && parser.accept("in") {
            true => Some(parser.quantity("a time, such as 0.4s")?),
            false => None,
        };
        let via = parser.via()?.unwrap_or_default();
        Ok(Self {
            hand: hand.unwrap_or(Hands::Dominant),
            path,
            through,
            time,
            via,
        })
    }

    fn usual() -> Self {
        let leg = Leg {
            towards: vec![Direction::Right],
            distance: Length::Metres(0.2),
            time: None,
        };
        Self {
            hand: Hands::Dominant,
            path: vec![leg],
            through: Vec::new(),
            time: None,
            via: Transition::default(),
        }
    }
}

impl Display for Travel {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "travel {} ", self.hand.name())?;
        list(f, &self.path, " then ")?;
        for (n, point) in self.through.iter().enumerate() {
            f.write_str(if n == 0 { "through " } else { " then " })?;
            point_text(f, point)?;
        }
        option(f, "in", self.time)?;
        write!(f, "{}", self.via)
    }
}

impl Operator for Travel {
    fn check(&self) -> Result<(), RecipeError> {
        let step = Self::NAME;
        let refused = |what| Err(RecipeError::Empty { step, what });
        if !self.path.is_empty() && !self.through.is_empty() {
            return refused("legs and a curve are given: keep one of them");
        }
        if self.through.is_empty() {
            check::filled(step, &self.path, "no path is given")?;
            if self.time.is_some() {
                return refused(
                    "only a curve has a time; each leg has its own, such as left 5cm in 0.2s",
                );
            }
        }
        check::legs(step, &self.path)?;
        if self.through.len() > MOST_POINTS {
            return refused("the curve has more than 64 points");
        }
        let mut lengths = self.through.iter().flatten();
        lengths.try_for_each(|it| check::length(step, *it))?;
        check::time(step, "the time", self.time, 600.0)?;
        check::via(step, &self.via)
    }

    fn resolve(&self, ask: &mut Ask<'_>, _setting: &Setting) -> Result<(), Cause> {
        ask.course(&VIA, &self.via)
    }

    fn make_time(&self, work: &mut Work) -> Result<Option<String>, Cause> {
        let sides = self.hand.sides(work.handedness);
        let frame = place::frame(work, sides)?;
        let parts = self.parts(&frame);
        for part in &parts {
            part.check()?;
        }
        let from = work.span().seconds();
        let mut stretched = false;
        // A slower hand counts as resting a little longer, so that the stroke is measured again.
        for _ in 0..MOST_STRETCHES {
            let stroke = SignStroke::of_work(work)?;
            let needed = needed(&parts, stroke.stroke_seconds(work));
            if needed <= stroke.stroke_seconds(work) + 1e-9 {
                break;
            }
            let frames = (needed / work.rate.frame_time() - 1e-6).ceil() + 1.0;
            retime::stretch(work, frames / stroke.frames.len() as f64)?;
            stretched = true;
        }
        if !stretched {
            return Ok(None);
        }
        let to = work.span().seconds();
        Ok(Some(format!(
            "the sign became {to:.2} s long instead of {from:.2} s, so that the path has its time"
        )))
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        let course = given.course(&VIA, &self.via, Profile::MinimumJerk)?;
        let sides = self.hand.sides(work.handedness);
        let parts = self.parts(&place::frame(work, sides)?);
        let warnings = parts.iter().filter_map(Part::warning).collect();
        let mut done: Done = travel(work, self, &course.arms, given.text)?.into();
        if parts.len() > 1 && parts.iter().any(|part| part.time.is_some()) {
            let times = times(&parts, SignStroke::of_work(work)?.stroke_seconds(work));
            let times: Vec<String> = times.iter().map(|time| format!("{time:.2} s")).collect();
            done.did.push(format!("the legs take {}", times.join(", ")));
        }
        done.warnings = warnings;
        if self.via.time.is_some() {
            done.warnings.push(UNUSED.to_owned());
        }
        Ok(done)
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::between(self.hand.sides(handedness))))
    }
}

/// A leg of a path, or a whole curve.
struct Part {
    /// Its length in metres.
    length: f64,
    /// Its stated time in seconds.
    time: Option<f64>,
}

impl Part {
    /// Returns its mean speed, if its time is stated.
    fn speed(&self) -> Option<f64> {
        let time = self.time?;
        (self.length > STANDS).then(|| self.length / time.max(1e-9))
    }

    /// Fails if no arm is as fast as its stated time demands.
    fn check(&self) -> Result<(), Cause> {
        match self.speed() {
            Some(speed) if speed > FASTEST.1 => Err(Cause::TooFast {
                length: self.length,
                time: self.time.unwrap_or_default(),
                least: self.length / PACE,
            }),
            _ => Ok(()),
        }
    }

    fn warning(&self) -> Option<String> {
        let time = self.time.filter(|_| self.speed() > Some(FASTEST.0))?;
        Some(format!(
            "{:.0} cm in {time:.2} s is faster than people sign",
            self.length * 100.0
        ))
    }
}

/// The length in metres below which a leg does not move the hand.
const STANDS: f64 = 1e-6;

impl Travel {
    fn parts(&self, frame: &Frame) -> Vec<Part> {
        if let Some(curve) = curve(frame, &self.through) {
            return vec![Part {
                length: curve.length(),
                time: self.time.map(|time| time.0),
            }];
        }
        let legs = self.path.iter().map(|leg| Part {
            length: leg.distance.metres(frame.arm).abs(),
            time: leg.time.map(|time| time.0),
        });
        legs.collect()
    }
}

/// Returns the time of each part; those without a stated time share what the stated ones leave of `total`, by length.
fn times(parts: &[Part], total: f64) -> Vec<f64> {
    let stated: f64 = parts.iter().filter_map(|part| part.time).sum();
    let left = (total - stated).max(0.0);
    let unstated = unstated(parts).max(1e-9);
    let time = |part: &Part| part.time.unwrap_or(left * (part.length / unstated));
    parts.iter().map(time).collect()
}

/// Returns the length of the parts without a stated time, in metres.
fn unstated(parts: &[Part]) -> f64 {
    let free = parts.iter().filter(|part| part.time.is_none());
    free.map(|part| part.length).sum()
}

/// Returns the time that the whole path needs in a movement of `total` seconds: stated times as they are, the rest no
/// faster than people sign.
fn needed(parts: &[Part], total: f64) -> f64 {
    let stated: f64 = parts.iter().filter_map(|part| part.time).sum();
    let left = (total - stated).max(0.0);
    stated + left.max(unstated(parts) / PACE)
}

/// Carries the hands along a path in addition to their own movement.
pub(crate) fn travel(
    work: &mut Work,
    settings: &Travel,
    course: &Course,
    operator: &str,
) -> Result<(Vec<String>, f64), Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = place::frame(work, sides)?;
    let curve = curve(&frame, &settings.through);
    let stroke = SignStroke::of_work(work)?;
    let times = times(&settings.parts(&frame), stroke.stroke_seconds(work));
    // Seconds since the stroke began: the path begins with it.
    let now = |at: usize| at.saturating_sub(stroke.frames.start) as f64 * work.rate.frame_time();
    let displacements: Vec<DVec3> = match &curve {
        Some(curve) => (0..work.frames)
            .map(|at| curve.at(course.share((now(at) / times[0].max(1e-9)).min(1.0))))
            .collect(),
        None => {
            let legs = legs(&frame, &settings.path, &times);
            (0..work.frames)
                .map(|at| displacement(&legs, now(at), course))
                .collect()
        }
    };
    let before = work.clone();
    let reach = place::wrists(work, sides, Solver::Analytic, &stroke, |_, frame, at| {
        at + displacements[frame]
    })?;
    let still = sides.iter().all(|&side| is_still(&before, side, &stroke));
    moved(work, sides, operator);
    if still {
        drawn(
            work,
            (&frame, &stroke),
            sides,
            (&settings.path, curve.as_ref()),
            operator,
        );
    }
    let legs = settings.path.iter();
    let length: f64 = legs.map(|leg| leg.distance.metres(frame.arm)).sum();
    let path = match (&curve, settings.path.len()) {
        (Some(curve), _) => {
            let cm = curve.length() * 100.0;
            format!("a curve of {cm:.0} cm ({})", curve.shape())
        }
        (None, 1) => format!("1 leg, {:.0} cm in all", length * 100.0),
        (None, count) => format!("{count} legs, {:.0} cm in all", length * 100.0),
    };
    let mut did = vec![path];
    did.extend(stroke.describe_rests(work));
    did.extend(describe_reach(&reach));
    Ok((did, reach.residual))
}

/// Returns the curve through points of body space, in model space; `None` without points.
fn curve(frame: &Frame, through: &[[Length; 3]]) -> Option<Spline> {
    let point = |at: &[Length; 3]| {
        let [left, up, forward] = at.map(|length| length.metres(frame.arm));
        frame.direction(DVec3::new(left, up, forward))
    };
    let points: Vec<DVec3> = through.iter().map(point).collect();
    (!points.is_empty()).then(|| Spline::new(&points))
}

/// A leg of a path in model space.
struct PathLeg {
    /// When it begins, in seconds since the path began.
    start: f64,
    /// How long it takes, in seconds.
    time: f64,
    /// Where it begins, and the way from there.
    from: DVec3,
    by: DVec3,
}

/// Returns the legs one after another; they take these times.
fn legs(frame: &Frame, path: &[Leg], times: &[f64]) -> Vec<PathLeg> {
    let (mut start, mut from) = (0.0, DVec3::ZERO);
    let mut legs = Vec::with_capacity(path.len());
    for (leg, &time) in path.iter().zip(times) {
        let by = frame.leg(leg);
        legs.push(PathLeg {
            start,
            time,
            from,
            by,
        });
        (start, from) = (start + time, from + by);
    }
    legs
}

/// Returns the displacement of the hands `now` seconds after the path began.
fn displacement(legs: &[PathLeg], now: f64, course: &Course) -> DVec3 {
    let begun = legs.iter().rev().find(|leg| now >= leg.start);
    begun.map_or(DVec3::ZERO, |leg| {
        let w = match leg.time > 0.0 {
            true => (now - leg.start) / leg.time,
            false => 1.0,
        };
        leg.from + leg.by * course.share(w)
    })
}

/// The largest movement, in metres, of a wrist that counts as still.
pub(crate) const STILL: f64 = 0.03;

pub(crate) fn wrist_path(work: &Work, side: Side) -> Result<Vec<DVec3>, Cause> {
    let hand = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?.hand;
    Ok(Columns::of(work, [hand]).positions(hand).to_vec())
}

/// Returns whether a wrist keeps its position in the stroke.
fn is_still(work: &Work, side: Side, stroke: &SignStroke) -> bool {
    let path = wrist_path(work, side).unwrap_or_default();
    let path = path.get(stroke.frames.clone()).unwrap_or_default();
    path.iter().all(|at| at.distance(path[0]) < STILL)
}

/// Notes the new path of hands that were still before: straight if it has one leg, else the shape of the curve.
fn drawn(
    work: &mut Work,
    (frame, stroke): (&Frame, &SignStroke),
    sides: &[Side],
    (path, curve): (&[Leg], Option<&Spline>),
    operator: &str,
) {
    let all = stroke.frames.clone();
    for &side in sides {
        let shape = curve.map(Spline::shape);
        let one = match (path, curve) {
            (_, Some(curve)) if shape != Some("circle") && shape != Some("path") => {
                say::direction(frame.to_body(curve.at(1.0)))
            }
            ([leg], _) => say::direction(frame.to_body(frame.leg(leg))),
            _ => None,
        };
        let shape = shape.unwrap_or(if one.is_some() { "straight" } else { "path" });
        let movement = Component::Movement;
        say::record(work, side, (movement, None), shape, all.clone(), operator);
        if let Some(direction) = one {
            let what = (movement, Some("direction"));
            say::record(work, side, what, &direction, all.clone(), operator);
        }
    }
}

/// Withdraws notes on the place and the movement of hands whose movement changed; phases stay.
pub(crate) fn moved(work: &mut Work, sides: &[Side], operator: &str) {
    say::withdraw(
        work,
        sides,
        operator,
        |component, feature| match component {
            Component::Placement => true,
            Component::Movement => feature != Some("phase"),
            _ => false,
        },
    );
    work.changed(sides.iter().map(|&side| Group::Arm(side)), operator);
}
