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
use crate::ops::say;
use crate::recipe::{Leg, Solver};
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
    /// The legs, one after another; those without a time share the remaining time by their length.
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
                "travel right down 20cm then up 20cm in 0.4s",
                Text::new("along a path", "le long d’un trajet"),
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

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        let course = given.course(&VIA, &self.via, Profile::MinimumJerk)?;
        Ok(travel(work, self, &course.arms, given.text)?.into())
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::between(self.hand.sides(handedness))))
    }
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
    let displacements = match &curve {
        Some(curve) => along(work, curve, settings.time, course),
        None => displacements(work, &frame, &settings.path, course),
    };
    let before = work.clone();
    let reach = place::wrists(work, sides, Solver::Analytic, |_, frame, at| {
        at + displacements[frame]
    })?;
    let still = sides.iter().all(|&side| is_still(&before, side));
    moved(work, sides, operator);
    if still {
        drawn(
            work,
            &frame,
            sides,
            (&settings.path, curve.as_ref()),
            operator,
        );
    }
    if let Some(curve) = curve {
        let length = curve.length() * 100.0;
        let mut did = vec![format!("a curve of {length:.0} cm ({})", curve.shape())];
        did.extend(describe_reach(&reach));
        return Ok((did, reach.residual));
    }
    let length: f64 = settings
        .path
        .iter()
        .map(|leg| leg.distance.metres(frame.arm))
        .sum();
    let mut did = vec![format!(
        "{} {}, {:.0} cm in all",
        settings.path.len(),
        if settings.path.len() == 1 {
            "leg"
        } else {
            "legs"
        },
        length * 100.0
    )];
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

/// Returns the displacement of the hands along a curve at each frame; they stay at its end if the movement lasts
/// longer.
fn along(work: &Work, curve: &Spline, time: Option<Seconds>, course: &Course) -> Vec<DVec3> {
    let total = work.frames.saturating_sub(1).max(1) as f64 * work.rate.frame_time();
    let time = time.map_or(total, |time| time.0).max(1e-9);
    let now = |f: usize| f as f64 * work.rate.frame_time();
    (0..work.frames)
        .map(|f| curve.at(course.share((now(f) / time).min(1.0))))
        .collect()
}

/// Returns the displacement of the hands along the path at each frame.
///
/// Legs without a time share the rest of the movement by their lengths.
fn displacements(work: &Work, frame: &Frame, path: &[Leg], course: &Course) -> Vec<DVec3> {
    let total = work.frames.saturating_sub(1).max(1) as f64 * work.rate.frame_time();
    let stated: f64 = path
        .iter()
        .filter_map(|leg| leg.time)
        .map(|time| time.0)
        .sum();
    let unstated: f64 = path
        .iter()
        .filter(|leg| leg.time.is_none())
        .map(|leg| leg.distance.metres(frame.arm).abs())
        .sum();
    let left = (total - stated).max(0.0);
    let mut at = (0.0, DVec3::ZERO);
    let mut legs = Vec::with_capacity(path.len());
    for leg in path {
        let share = leg.distance.metres(frame.arm).abs() / unstated.max(1e-9);
        let time = leg.time.map_or(left * share, |time| time.0);
        legs.push((at.0, time, at.1, frame.leg(leg)));
        at = (at.0 + time, at.1 + frame.leg(leg));
    }
    (0..work.frames)
        .map(|f| {
            let now = f as f64 * work.rate.frame_time();
            let mut place = DVec3::ZERO;
            for &(start, time, from, by) in &legs {
                if now >= start {
                    let w = if time > 0.0 {
                        (now - start) / time
                    } else {
                        1.0
                    };
                    place = from + by * course.share(w);
                }
            }
            place
        })
        .collect()
}

/// The largest movement, in metres, of a wrist that counts as still.
pub(crate) const STILL: f64 = 0.03;

pub(crate) fn wrist_path(work: &Work, side: Side) -> Result<Vec<DVec3>, Cause> {
    let hand = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?.hand;
    Ok(Columns::of(work, [hand]).positions(hand).to_vec())
}

/// Returns whether a wrist keeps its position.
fn is_still(work: &Work, side: Side) -> bool {
    let path = wrist_path(work, side).unwrap_or_default();
    path.iter().all(|at| at.distance(path[0]) < STILL)
}

/// Notes the new path of hands that were still before: straight if it has one leg, else the shape of the curve.
fn drawn(
    work: &mut Work,
    frame: &Frame,
    sides: &[Side],
    (path, curve): (&[Leg], Option<&Spline>),
    operator: &str,
) {
    let all = 0..work.frames;
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
