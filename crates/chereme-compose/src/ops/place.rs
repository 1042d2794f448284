//! `place`: moves the hands elsewhere; they keep their movement and rotations.

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::Component;
use chereme_sign::words::Text;

use crate::arm::{self, HELP_FROM, Reach};
use crate::body::{self, Frame};
use crate::error::Cause;
use crate::ops::{Description, clear, say};
use crate::recipe::{HandPoint, Solver};
use crate::resolve::PlaceInput;
use crate::stroke::SignStroke;
use crate::work::{Columns, Group, Work};
use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use chereme_sign::Handedness;
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::RecipeError;
use crate::ops::{Done, Neighbours, Operator, Step, Syntax};
use crate::recipe::Leg;
use crate::sources::Material;
use crate::text::{Name, Parsed, Parser, list, option, point_text};
use crate::units::{Direction, Hands, Length};

mod anchor;

use anchor::anchor;

/// Settings of `place both by left 25cm`, `place right at chin`, `place left near BOL`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The hands that move; two hands move by the same displacement, but each to its own side of a place on both
    /// sides, such as a shoulder.
    #[serde(default = "crate::recipe::both")]
    pub hand: Hands,
    /// The goal.
    pub to: Goal,
    /// The point of the hand that comes to the goal; `None` for the point that touches the body in the sign, else the
    /// palm. With `by`, all points move alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<HandPoint>,
    /// The method that finds the arm's posture; `using fabrik`.
    #[serde(default, skip_serializing_if = "Solver::is_default")]
    pub solver: Solver,
}

/// The goal of a placement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Goal {
    /// A displacement by the sum of these, each in the signer's own directions.
    By(Vec<Leg>),
    /// A placement of an inventory.
    At(String),
    /// A point of body space: metres to the left, up from the floor, and forward.
    AtPoint([Length; 3]),
    /// The hand's position in another sign, by its address, plus a displacement.
    Near {
        /// The other sign.
        of: String,
        /// The displacement from there.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        by: Vec<Leg>,
    },
    /// The hand's position in the best answer to a query.
    Best(String),
}

/// The place of the goal.
const TO: Slot<PlaceInput> = Slot::new("place/to");

impl Syntax for Place {
    const NAME: &'static str = "place";
    const KEYWORDS: &'static [&'static str] = &["near", "using"];
    const DESCRIPTION: Description = Description {
        title: Text::new("Place", "Emplacement"),
        hint: Text::new("the hands elsewhere", "les mains ailleurs"),
        examples: &[
            (
                "place both by left 25cm up 5cm",
                Text::new("another place: moved", "un autre emplacement : déplacé"),
            ),
            (
                "place right at chin with index",
                Text::new(
                    "at a placement, touched with the index finger",
                    "à un emplacement, touché de l’index",
                ),
            ),
            (
                "place right at 0cm,120cm,40cm",
                Text::new(
                    "at a point: to the left, up from the floor, forward",
                    "à un point : à gauche, au-dessus du sol, en avant",
                ),
            ),
            (
                "place both near BOL by up 5cm",
                Text::new(
                    "at the place of another sign",
                    "à l’emplacement d’un autre signe",
                ),
            ),
            (
                "place both by up 10cm using fabrik",
                Text::new(
                    "with another solver of the arms",
                    "avec une autre méthode pour les bras",
                ),
            ),
        ],
        messages: &[
            Text::new(
                "the place is from {origin}",
                "l’emplacement vient de {origin}",
            ),
            Text::new(
                "what counts is the contact at {time}, where the {part} was at the {place}",
                "ce qui compte est le contact à {time}, où {part} était à : {place}",
            ),
            Text::new(
                "out of reach: the wrist stays {cm} cm short at frame {n}",
                "hors de portée : il manque {cm} cm au poignet à l’image {n}",
            ),
            Text::new(
                "the collar bone helped in {n} frames, beyond {share} of the arm's length",
                "la clavicule a aidé dans {n} images, au-delà de {share} de la longueur du bras",
            ),
            Text::new("moved {way}", "déplacé : {way}"),
            Text::new(
                "the {side} hand is moved {way}",
                "la main {side} est déplacée : {way}",
            ),
            Text::new(
                "the rest before {start} and after {end} stays as it is",
                "le repos avant {start} et après {end} reste tel quel",
            ),
            Text::new(
                "the rest before {time} stays as it is",
                "le repos avant {time} reste tel quel",
            ),
            Text::new(
                "the rest after {time} stays as it is",
                "le repos après {time} reste tel quel",
            ),
            Text::new(
                "the right hand is kept out of head and trunk: moved by up to {rest}",
                "la main droite est tenue hors de la tête et du tronc : déplacée de {rest}",
            ),
            Text::new(
                "the left hand is kept out of head and trunk: moved by up to {rest}",
                "la main gauche est tenue hors de la tête et du tronc : déplacée de {rest}",
            ),
            Text::new(
                "the right hand is {cm} cm away from the place, so its placement is left open",
                "la main droite est à {cm} cm du lieu, son emplacement reste donc ouvert",
            ),
            Text::new(
                "the left hand is {cm} cm away from the place, so its placement is left open",
                "la main gauche est à {cm} cm du lieu, son emplacement reste donc ouvert",
            ),
            Text::new(
                "the place is that of the contact at {time}: the {part} at the mouth",
                "l’emplacement est celui du contact à {time} : {part} à la bouche",
            ),
            Text::new(
                "the place is that of the contact at {time}: the {part} at the chin",
                "l’emplacement est celui du contact à {time} : {part} au menton",
            ),
            Text::new(
                "the place is that of the contact at {time}: the {part} at the chest",
                "l’emplacement est celui du contact à {time} : {part} à la poitrine",
            ),
            Text::new(
                "the place is that of the contact at {time}: the {part} at the {place}",
                "l’emplacement est celui du contact à {time} : {part} à {place}",
            ),
            Text::new(
                "the name of the placement is empty",
                "le nom de l’emplacement est vide",
            ),
            Text::new(
                "a hand, \"by\", \"at\" or \"near\"",
                "une main, \"by\", \"at\" ou \"near\"",
            ),
            Text::new(
                "a placement or a point such as 0cm,120cm,30cm",
                "un emplacement ou un point comme 0cm,120cm,30cm",
            ),
            Text::new(
                "the wrist leaves the arm's reach fast: beyond {share}% of its length it lags behind, so that the elbow opens smoothly",
                "le poignet quitte vite la portée du bras : au-delà de {share} % de sa longueur il prend du retard, pour que le coude s’ouvre sans à-coup",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, _word: &str) -> Parsed<Self> {
        let hand = parser.hand().unwrap_or(Hands::Both);
        let mut place = Self {
            hand,
            to: goal(parser)?,
            with: None,
            solver: Solver::Analytic,
        };
        loop {
            if parser.accept("with") {
                let points = &HandPoint::ALL;
                let point = parser.one_of(points, HandPoint::name, "a point of the hand")?;
                place.with = Some(point);
            } else if parser.accept("using") {
                place.solver = parser.one_of(&Solver::ALL, Solver::name, "a solver")?;
            } else {
                return Ok(place);
            }
        }
    }

    fn usual() -> Self {
        let leg = Leg {
            towards: vec![Direction::Up],
            distance: Length::Metres(0.1),
            time: None,
        };
        Self {
            hand: Hands::Both,
            to: Goal::By(vec![leg]),
            with: None,
            solver: Solver::Analytic,
        }
    }
}

fn goal(parser: &mut Parser<'_>) -> Parsed<Goal> {
    if parser.accept("by") {
        return parser.legs(false).map(Goal::By);
    }
    if parser.accept("near") || parser.accept("from") {
        let of = parser.name("a sign")?;
        let by = match parser.accept("by") {
            true => parser.legs(false)?,
            false => Vec::new(),
        };
        return Ok(Goal::Near { of, by });
    }
    if !parser.accept("at") {
        let words = [
            "by", "at", "near", "right", "left", "both", "dominant", "weak",
        ];
        return Err(parser.expected("a hand, \"by\", \"at\" or \"near\"", &words));
    }
    if let Some(query) = parser.query()? {
        return Ok(Goal::Best(query));
    }
    if let Some(point) = parser.spot_point()? {
        return Ok(Goal::AtPoint(point));
    }
    let named = parser.name("a placement or a point such as 0cm,120cm,30cm")?;
    Ok(Goal::At(named))
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "place {} ", self.hand.name())?;
        match &self.to {
            Goal::By(legs) => {
                f.write_str("by ")?;
                list(f, legs, " ")?;
            }
            Goal::At(value) => write!(f, "at {}", Name(value))?,
            Goal::AtPoint(point) => {
                f.write_str("at ")?;
                point_text(f, point)?;
            }
            Goal::Near { of, by } => {
                write!(f, "near {}", Name(of))?;
                if !by.is_empty() {
                    f.write_str(" by ")?;
                    list(f, by, " ")?;
                }
            }
            Goal::Best(query) => write!(f, "at best({query})")?,
        }
        option(f, "with", self.with.map(HandPoint::name))?;
        let solver = (!self.solver.is_default()).then(|| self.solver.name());
        option(f, "using", solver)
    }
}

impl Operator for Place {
    fn check(&self) -> Result<(), RecipeError> {
        let step = Self::NAME;
        match &self.to {
            Goal::By(legs) => {
                check::filled(step, legs, "no path is given")?;
                check::legs(step, legs)
            }
            Goal::Near { of, by } => {
                check::named(step, of, "the name of the sign is empty")?;
                check::legs(step, by)
            }
            Goal::At(value) => check::named(step, value, "the name of the placement is empty"),
            Goal::Best(query) => check::named(step, query, "the query is empty"),
            Goal::AtPoint(point) => point.iter().try_for_each(|&at| check::length(step, at)),
        }
    }

    fn resolve(&self, ask: &mut Ask<'_>, setting: &Setting) -> Result<(), Cause> {
        let found = match &self.to {
            Goal::By(_) | Goal::AtPoint(_) => return Ok(()),
            Goal::At(value) => ask.place(value)?,
            Goal::Near { of, .. } => self.shown_in(&ask.sources.material(of)?, setting)?,
            Goal::Best(query) => {
                let found = ask.sources.best(query, setting.signer.as_deref())?;
                let Some(first) = found.first() else {
                    return Err(Cause::NothingFound(query.clone()));
                };
                self.shown_in(&ask.sources.material(&first.address)?, setting)?
            }
        };
        ask.put(&TO, found);
        Ok(())
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        place(work, self, given.get(&TO), given.text)
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::between(self.hand.sides(handedness))))
    }

    fn is_nothing(&self) -> bool {
        match &self.to {
            Goal::By(legs) => legs.iter().all(|leg| leg.distance.is_zero()),
            Goal::At(_) | Goal::AtPoint(_) | Goal::Near { .. } | Goal::Best(_) => false,
        }
    }

    fn after(&self, before: &mut Step) -> Neighbours {
        let Step::Place(before) = before else {
            return Neighbours::Apart;
        };
        match (&mut before.to, &self.to) {
            (Goal::By(legs), Goal::By(more))
                if before.hand == self.hand && before.solver == self.solver =>
            {
                legs.extend(more.iter().cloned());
                Neighbours::One
            }
            _ => Neighbours::Apart,
        }
    }
}

impl Place {
    /// Returns the position of the hands in another sign.
    fn shown_in(&self, material: &Material, setting: &Setting) -> Result<PlaceInput, Cause> {
        let has = |side: &&Side| material.anatomy.arm(**side).is_some();
        let sides = self.hand.sides(setting.handedness).iter();
        let shown: Vec<Side> = sides.filter(has).copied().collect();
        shown_by(material, &shown, self.with)
    }
}

/// Returns the placement of the hands throughout another sign, if it has exactly one.
fn held_place(material: &Material, sides: &[Side]) -> Option<String> {
    let dominant = material.handedness.dominant();
    let annotated = material.held.iter().filter(|held| {
        let of = sides.contains(&held.hand.unwrap_or(dominant));
        of && held.component == Component::Placement && held.feature.is_none()
    });
    let mut values = annotated.filter_map(|held| held.value.value());
    let first = values.next()?;
    values.all(|value| value == first).then(|| first.to_owned())
}

/// Returns the position of the hands in the middle of another sign, relative to the signer's chest and arms.
pub(crate) fn shown_by(
    material: &Material,
    sides: &[Side],
    with: Option<HandPoint>,
) -> Result<PlaceInput, Cause> {
    let work = Work::of(material);
    let frame = Frame::of(&work);
    let mean = body::mean_point(&work, sides, with.unwrap_or(HandPoint::Palm));
    let (Some(frame), Some(mean)) = (frame, mean) else {
        let address = material.address.clone();
        let what = "hand's place";
        return Err(Cause::NothingToTake { address, what });
    };
    Ok(PlaceInput {
        value: held_place(material, sides),
        from: material.address.clone(),
        at: frame.spatial(mean),
    })
}

/// The distance in metres of one of two hands from the place of their middle, beyond which the hand is not at the place.
const APART: f64 = 0.25;

/// Hands that move together.
struct HandShift<'a> {
    sides: &'a [Side],
    by: DVec3,
    /// The frames in which they are at the place.
    frames: Range<usize>,
    /// The goal, and the point of the hands that comes to it; `None` for a mere displacement.
    spot: Option<(DVec3, HandPoint)>,
}

/// A placement in the making.
struct PlacementPlan<'a> {
    settings: &'a Place,
    input: Option<&'a PlaceInput>,
    frame: Frame,
    stroke: SignStroke,
}

impl<'a> PlacementPlan<'a> {
    /// Returns the displacement of hands that move together, and adds the moment that determines it to a description.
    fn shift(
        &self,
        work: &Work,
        sides: &'a [Side],
        did: &mut Vec<String>,
    ) -> Result<HandShift<'a>, Cause> {
        let frame = &self.frame;
        let goal = match (&self.settings.to, self.input) {
            (Goal::By(legs), _) => {
                return Ok(HandShift {
                    sides,
                    by: frame.sum(legs),
                    frames: self.stroke.frames.clone(),
                    spot: None,
                });
            }
            (Goal::AtPoint(at), _) => frame.point(at),
            (Goal::Near { by, .. }, Some(input)) => {
                spatial(work, frame, input, sides[0])? + frame.sum(by)
            }
            (_, Some(input)) => spatial(work, frame, input, sides[0])?,
            (_, None) => return Err(Cause::Input),
        };
        let anchor = anchor(work, &self.stroke, sides, self.settings.with);
        let now = anchor.at(work, sides).ok_or(Cause::NoArm(sides[0]))?;
        did.extend(anchor.describe(work));
        Ok(HandShift {
            sides,
            by: goal - now,
            spot: Some((goal, anchor.point)),
            frames: anchor.frames,
        })
    }
}

/// Returns whether a place is on both sides of the body, so that each of two hands has its own. Fails for places on
/// the hands and forearms that move to it.
fn is_sided(place: &PlaceInput) -> Result<bool, Cause> {
    let landmark = &place.at.landmark;
    let sided = ["ipsi-", "contra-"].map(|side| landmark.strip_prefix(side));
    let sided = sided[0].or(sided[1]);
    let own = ["elbow", "forearm", "wrist", "palm"];
    match sided {
        Some(name) if own.contains(&name) || name.contains("hand-") || name.ends_with("-tip") => {
            let value = place.value.clone();
            Err(Cause::BothMove(value.unwrap_or_else(|| name.to_owned())))
        }
        sided => Ok(sided.is_some()),
    }
}

/// Moves the hands.
fn place(
    work: &mut Work,
    settings: &Place,
    input: Option<&PlaceInput>,
    operator: &str,
) -> Result<Done, Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = frame(work, sides)?;
    let apart = match input.filter(|_| sides.len() > 1) {
        Some(place) => is_sided(place)?,
        None => false,
    };
    let mut notes = Vec::new();
    let mut shifts = Vec::new();
    let placing = PlacementPlan {
        settings,
        input,
        frame,
        stroke: SignStroke::of_work(work)?,
    };
    for together in sides.chunks(if apart { 1 } else { sides.len() }) {
        shifts.push(placing.shift(work, together, &mut notes)?);
    }
    let near = matches!(&settings.to, Goal::Near { by, .. } if !by.is_empty());
    let value = input
        .and_then(|input| input.value.clone())
        .filter(|_| !near);
    let before = work.clone();
    let (stroke, solver) = (&placing.stroke, settings.solver);
    let rest = stroke.describe_rests(work);
    let mut reach = wrists(work, sides, solver, stroke, |side, _, at| {
        let own = shifts.iter().find(|shift| shift.sides.contains(&side));
        at + own.map_or(DVec3::ZERO, |shift| shift.by)
    })?;
    let mut kept_out = Vec::new();
    let mut moved = Vec::new();
    for shift in &shifts {
        let (by, frames) = (shift.by, &shift.frames);
        for &side in shift.sides {
            if !matches!(settings.to, Goal::By(_))
                && let Some(cleared) = clear::clear(work, &before, side, settings.solver)
            {
                reach.residual = reach.residual.max(cleared.at(frames));
                kept_out.push(cleared.describe(work, side, frames));
            }
        }
        for &side in shift.sides {
            // Of two hands far apart only their middle is at the place.
            let away = shift
                .spot
                .filter(|_| shift.sides.len() > 1 && value.is_some())
                .and_then(|(goal, point)| {
                    let own = body::mean_point(work, &[side], point)?;
                    Some(own.distance(goal)).filter(|away| *away > APART)
                });
            if let Some(away) = away {
                notes.push(format!(
                    "the {} hand is {:.1} cm away from the place, so its placement is left open",
                    side.name(),
                    away * 100.0
                ));
            }
            if by != DVec3::ZERO || value.is_some() {
                let value = value.as_deref().filter(|_| away.is_none());
                say::placed(work, side, value, frames.clone(), operator);
            }
        }
        if by != DVec3::ZERO {
            let arms = shift.sides.iter().map(|&side| Group::Arm(side));
            work.changed(arms, operator);
        }
        let offset = directions(frame.to_body(by) * 100.0);
        moved.push(match apart {
            true => format!("the {} hand is moved {offset}", shift.sides[0].name()),
            false => format!("moved {offset}"),
        });
    }
    let mut did = moved;
    did.extend(notes);
    did.extend(kept_out);
    if let Some(input) = input {
        did.push(format!("the place is from {}", input.from));
    }
    did.extend(rest);
    did.extend(describe_reach(&reach));
    let one = shifts.first().filter(|_| !apart);
    Ok(Done {
        moved: one.map(|shift| frame.to_body(shift.by).to_array()),
        ..(did, reach.residual).into()
    })
}

/// Describes a displacement in centimetres for people, each part with its direction.
fn directions(cm: DVec3) -> String {
    let part = |length: f64, to: &str, back: &str| {
        let direction = if length < 0.0 { back } else { to };
        format!("{:.1} cm {direction}", length.abs())
    };
    let parts = [
        part(cm.x, "left", "right"),
        part(cm.y, "up", "down"),
        part(cm.z, "forward", "back"),
    ];
    parts.join(", ")
}

fn spatial(work: &Work, frame: &Frame, input: &PlaceInput, side: Side) -> Result<DVec3, Cause> {
    frame
        .place(work, &input.at, side)
        .ok_or_else(|| Cause::NoMeaning {
            value: input
                .value
                .clone()
                .unwrap_or_else(|| input.at.landmark.clone()),
            what: "landmark that this skeleton has",
        })
}

/// Returns the body's frame. Fails with the missing arm if the body lacks one.
pub(crate) fn frame(work: &Work, sides: &[Side]) -> Result<Frame, Cause> {
    if let Some(&side) = sides.iter().find(|&&side| work.anatomy.arm(side).is_none()) {
        return Err(Cause::NoArm(side));
    }
    Frame::of(work).ok_or(Cause::NoArm(sides[0]))
}

/// Moves wrists to the positions that `target` returns for a hand, a frame and the present position; in rest before and
/// after the stroke they stay.
pub(crate) fn wrists(
    work: &mut Work,
    sides: &[Side],
    solver: Solver,
    stroke: &SignStroke,
    target: impl Fn(Side, usize, DVec3) -> DVec3,
) -> Result<Reach, Cause> {
    let mut worst = Reach::default();
    let hand = |side: Side| work.anatomy.arm(side).map(|arm| arm.hand);
    let hands: Vec<Option<usize>> = sides.iter().map(|&side| hand(side)).collect();
    let columns = Columns::of(work, hands.iter().flatten().copied());
    for (&side, hand) in sides.iter().zip(hands) {
        let hand = hand.ok_or(Cause::NoArm(side))?;
        let at = columns.positions(hand).iter().enumerate();
        let target = |(frame, &at)| stroke.point_between(frame, at, target(side, frame, at));
        let targets: Vec<DVec3> = at.map(target).collect();
        let reach = arm::move_wrist(work, side, &columns, &targets, None, solver)
            .ok_or(Cause::NoArm(side))?;
        check(side, &reach)?;
        worst = worst.worse(reach);
    }
    Ok(worst)
}

/// Refuses targets that are out of reach by half an arm's length or more.
pub(crate) fn check(side: Side, reach: &Reach) -> Result<(), Cause> {
    if reach.residual > 0.5 * reach.arm && reach.farthest > 1.5 * reach.arm {
        return Err(Cause::TooFar {
            side,
            distance: reach.farthest,
            arm: reach.arm,
        });
    }
    Ok(())
}

/// Describes the limits that an arm met, and the help that it had.
pub(crate) fn describe_reach(reach: &Reach) -> Vec<String> {
    let mut lines = Vec::new();
    if reach.residual > 1e-3 {
        lines.push(format!(
            "out of reach: the wrist stays {:.1} cm short at frame {}",
            reach.residual * 100.0,
            reach.frame
        ));
    }
    if reach.is_softened() {
        lines.push(format!(
            "the wrist leaves the arm's reach fast: beyond {:.1}% of its length it lags behind, so \
             that the elbow opens smoothly",
            (1.0 - reach.soft) * 100.0
        ));
    }
    if reach.helped > 0 {
        lines.push(format!(
            "the collar bone helped in {} frames, beyond {:.0}% of the arm's length",
            reach.helped,
            HELP_FROM * 100.0
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_is_named_by_its_direction() {
        let text = directions(DVec3::new(-1.9, 2.0, -0.34));
        assert_eq!(text, "1.9 cm right, 2.0 cm up, 0.3 cm back");
    }
}
