//! `from … to …`: moves directional verbs to other places.

use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use chereme_motion::Side;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::words::Text;
use chereme_sign::{Component, Handedness};
use serde::{Deserialize, Serialize};

use crate::answers::{Ask, Given, Setting, Slot};
use crate::arm::{self, Reach};
use crate::body::arm_length;
use crate::check;
use crate::contact::{Carry, Keep};
use crate::error::{Cause, RecipeError};
use crate::ops::place::{self, describe_reach};
use crate::ops::travel::{STILL, moved, wrist_path};
use crate::ops::{Description, Done, Field, FieldSetting, Operator, Syntax, say};
use crate::recipe::{Solver, Spot};
use crate::resolve::PlaceInput;
use crate::stroke::SignStroke;
use crate::text::{Parsed, Parser, list, option};
use crate::units::{Direction, Hands};
use crate::work::{Columns, Work};

/// Settings of `from me to left`: the new start and end of a directional verb.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Indicate {
    /// The hands that move; a hand that stays still, away from the other, keeps its place.
    #[serde(default = "crate::recipe::both")]
    pub hand: Hands,
    /// The start of the movement; `None` keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Spot>,
    /// The end of the movement; `None` keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<Spot>,
}

/// The places of start and end, if inventories name them.
const ENDS: [Slot<PlaceInput>; 2] = [Slot::new("indicate/from"), Slot::new("indicate/to")];

impl Syntax for Indicate {
    const NAME: &'static str = "indicate";
    const WORDS: &'static [&'static str] = &["from", "to"];
    const KEYWORDS: &'static [&'static str] = &["me", "you"];
    const DESCRIPTION: Description = Description {
        title: Text::new("Direct", "Diriger"),
        hint: Text::new(
            "between other places, as a directional verb",
            "entre d’autres lieux, comme un verbe directionnel",
        ),
        examples: &[(
            "from me to left",
            Text::new(
                "a directional verb between other places",
                "un verbe directionnel entre d’autres lieux",
            ),
        )],
        messages: &[
            Text::new(
                "{spot} is {cm} cm nearer, as far as the arms reach",
                "{spot} est plus près de {cm} cm, autant que les bras atteignent",
            ),
            Text::new(
                "the path of {from} cm became {to} cm",
                "le trajet de {from} cm est devenu {to} cm",
            ),
            Text::new(
                "neither where it starts nor where it ends is given",
                "ni son départ ni son arrivée ne sont donnés",
            ),
        ],
    };

    fn parse(parser: &mut Parser<'_>, word: &str) -> Parsed<Self> {
        let from = (word == "from").then(|| parser.spot()).transpose()?;
        let to = word == "to" || parser.accept("to");
        let to = to.then(|| parser.spot()).transpose()?;
        let hand = if parser.accept("with") {
            parser
                .hand()
                .ok_or_else(|| parser.expected("a hand", &[]))?
        } else {
            Hands::Both
        };
        Ok(Self { hand, from, to })
    }

    fn usual() -> Self {
        Self {
            hand: Hands::Both,
            from: None,
            to: Some(Spot::Towards(vec![Direction::Left])),
        }
    }
}

impl Display for Indicate {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let from = self.from.as_ref().map(|spot| format!("from {spot}"));
        let to = self.to.as_ref().map(|spot| format!("to {spot}"));
        list(f, from.into_iter().chain(to), " ")?;
        let hand = (self.hand != Hands::Both).then(|| self.hand.name());
        option(f, "with", hand)
    }
}

impl Operator for Indicate {
    fn check(&self) -> Result<(), RecipeError> {
        if self.from.is_none() && self.to.is_none() {
            return Err(RecipeError::Empty {
                step: Self::NAME,
                what: "neither where it starts nor where it ends is given",
            });
        }
        let mut spots = self.from.iter().chain(&self.to);
        spots.try_for_each(|at| check::spot(Self::NAME, at))
    }

    fn resolve(&self, ask: &mut Ask<'_>, _setting: &Setting) -> Result<(), Cause> {
        for (slot, spot) in ENDS.iter().zip([&self.from, &self.to]) {
            if let Some(spot) = spot {
                ask.spot(slot, spot)?;
            }
        }
        Ok(())
    }

    fn apply(&self, work: &mut Work, given: &mut Given<'_>) -> Result<Done, Cause> {
        let places = ENDS.each_ref().map(|slot| given.get(slot));
        Ok(indicate(work, self, places, given.text)?.into())
    }

    fn contacts(&self, handedness: Handedness) -> Option<(Carry, Keep)> {
        Some((Carry::Same, Keep::between(self.hand.sides(handedness))))
    }

    fn fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |en, fr, spot| FieldSetting::new(Text::new(en, fr), Field::Spot(spot));
        vec![
            FieldSetting::hands(&mut self.hand),
            setting("from", "de", &mut self.from),
            setting("to", "à", &mut self.to),
        ]
    }
}

/// A hand that a directional verb moves.
struct Sent {
    side: Side,
    path: Vec<DVec3>,
    shoulders: [DVec3; 2],
    arm: f64,
}

impl Sent {
    /// Follows a hand from the first of two frames to the second.
    fn of(work: &Work, side: Side, ends: [usize; 2]) -> Result<Self, Cause> {
        let chain = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?;
        let columns = Columns::of(work, [chain.upper, chain.hand]);
        let shoulder = columns.positions(chain.upper);
        Ok(Self {
            side,
            path: columns.positions(chain.hand).to_vec(),
            shoulders: ends.map(|frame| shoulder[frame]),
            arm: arm_length(work, side).ok_or(Cause::NoArm(side))?,
        })
    }

    fn is_still(&self) -> bool {
        self.path.iter().all(|at| at.distance(self.path[0]) < STILL)
    }

    /// Returns the largest share of the line from `near` to `far` at which the wrist is within the arm's reach. `end`
    /// is 0 for the start of the movement and 1 for its end; `beside` is the wrist's offset from the hands' middle.
    fn reaches(&self, end: usize, beside: DVec3, near: DVec3, far: DVec3) -> f64 {
        let most = REACH * self.arm;
        let within =
            |share: f64| (near.lerp(far, share) + beside).distance(self.shoulders[end]) <= most;
        (0..=20)
            .rev()
            .map(|n| f64::from(n) / 20.0)
            .find(|&it| within(it))
            .unwrap_or(0.0)
    }
}

/// The largest extension of an arm towards a mere direction, as a share of its length.
const REACH: f64 = 0.95;

/// Returns the hands to move: of two hands only the moving one, if the other stays still and away from it.
fn sent(work: &Work, sides: &[Side], ends: [usize; 2]) -> Result<Vec<Sent>, Cause> {
    let all = sides.iter().map(|&side| Sent::of(work, side, ends));
    let mut all = all.collect::<Result<Vec<_>, _>>()?;
    if let [one, other] = all.as_slice() {
        let pairs = one.path.iter().zip(&other.path);
        let nearest = pairs.map(|(a, b)| a.distance(*b)).fold(f64::MAX, f64::min);
        if one.is_still() != other.is_still() && nearest > 0.3 * one.arm {
            all.retain(|hand| !hand.is_still());
        }
    }
    Ok(all)
}

/// Moves the start and the end of the hands' movement: the path between is rotated and stretched with its ends, and the
/// hands rotate about the vertical with it.
///
/// A mere direction, such as `left` or `you`, means a place within the arms' reach. A hand that hangs or lies still
/// while the other one moves stays in its place.
pub(crate) fn indicate(
    work: &mut Work,
    settings: &Indicate,
    places: [Option<&PlaceInput>; 2],
    operator: &str,
) -> Result<(Vec<String>, f64), Cause> {
    let stroke = SignStroke::of_work(work)?;
    let ends = [stroke.frames.start, stroke.frames.end - 1];
    let hands = sent(work, settings.hand.sides(work.handedness), ends)?;
    let sides: Vec<Side> = hands.iter().map(|hand| hand.side).collect();
    let frame = place::frame(work, &sides)?;
    let middle =
        |f: usize| hands.iter().map(|hand| hand.path[f]).sum::<DVec3>() / hands.len() as f64;
    let [start, end] = ends.map(middle);
    let mut did = Vec::new();
    let mut spot = |at: usize, now: DVec3| -> Result<DVec3, Cause> {
        let Some(spot) = [&settings.from, &settings.to][at].as_ref() else {
            return Ok(now);
        };
        let find = |spot| frame.spot(work, spot, places[at].map(|input| &input.at), sides[0]);
        let whole = find(spot).ok_or(Cause::NoMeaning {
            value: spot.to_string(),
            what: "landmark that this skeleton has",
        })?;
        if !matches!(spot, Spot::Towards(_) | Spot::You) {
            return Ok(whole);
        }
        let near = find(&Spot::Me).unwrap_or(whole);
        let shares = hands
            .iter()
            .map(|hand| hand.reaches(at, hand.path[ends[at]] - now, near, whole));
        let share = shares.fold(1.0, f64::min);
        if share < 1.0 {
            did.push(format!(
                "{spot} is {:.0} cm nearer, as far as the arms reach",
                near.distance(whole) * (1.0 - share) * 100.0
            ));
        }
        Ok(near.lerp(whole, share))
    };
    let (from, to) = (spot(0, start)?, spot(1, end)?);
    let shares = travelled(&stroke.frames.clone().map(middle).collect::<Vec<_>>());
    let turn = level_turn(end - start, to - from);
    let mut worst = Reach::default();
    for Sent { side, path, .. } in &hands {
        let side = *side;
        let chain = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?;
        let columns = Columns::of(work, [chain.hand]);
        let turned: Vec<DQuat> = columns
            .rotations(chain.hand)
            .iter()
            .enumerate()
            .map(|(frame, hand)| stroke.turn_share(frame, turn) * *hand)
            .collect();
        let targets: Vec<DVec3> = (0..work.frames)
            .map(|frame| {
                let nearest = stroke.nearest_frame(frame);
                let share = shares[nearest - stroke.frames.start];
                let (old, new) = (start.lerp(end, share), from.lerp(to, share));
                let moved = new + turn * (path[nearest] - old) - path[nearest];
                stroke.point_between(frame, path[frame], path[frame] + moved)
            })
            .collect();
        let solver = Solver::Analytic;
        let reach = arm::move_wrist(work, side, &columns, &targets, Some(&turned), solver)
            .ok_or(Cause::NoArm(side))?;
        place::check(side, &reach)?;
        worst = worst.worse(reach);
    }
    moved(work, &sides, operator);
    for (at, input) in places.into_iter().enumerate() {
        let value = input.and_then(|input| input.value.as_deref());
        let Some(value) = value else { continue };
        for &side in &sides {
            let frames = stays(work, side, &stroke, at == 1)?;
            let what = (Component::Placement, None);
            say::record(work, side, what, value, frames, operator);
        }
    }
    did.push(format!(
        "the path of {:.0} cm became {:.0} cm",
        start.distance(end) * 100.0,
        from.distance(to) * 100.0
    ));
    did.extend(stroke.describe_rests(work));
    did.extend(describe_reach(&worst));
    Ok((did, worst.residual))
}

/// Returns the frames at the start, or at the end, of the stroke in which a wrist keeps its position.
fn stays(work: &Work, side: Side, stroke: &SignStroke, end: bool) -> Result<Range<usize>, Cause> {
    let frames = stroke.frames.clone();
    let path = &wrist_path(work, side)?[frames.clone()];
    let near = |from: DVec3| move |at: &&DVec3| at.distance(from) < 2.0 * STILL;
    Ok(if end {
        let last = path[path.len() - 1];
        let count = path.iter().rev().take_while(near(last)).count();
        frames.end - count..frames.end
    } else {
        let count = path.iter().take_while(near(path[0])).count();
        frames.start..frames.start + count
    })
}

/// Returns the share of a path's length at each frame; the share of its time if it has no length.
fn travelled(path: &[DVec3]) -> Vec<f64> {
    let mut shares = vec![0.0];
    for pair in path.windows(2) {
        shares.push(shares[shares.len() - 1] + pair[0].distance(pair[1]));
    }
    let whole = shares[shares.len() - 1];
    let last = shares.len().saturating_sub(1).max(1) as f64;
    shares
        .iter()
        .enumerate()
        .map(|(n, share)| {
            if whole > 1e-6 {
                share / whole
            } else {
                n as f64 / last
            }
        })
        .collect()
}

/// Returns the rotation about the vertical from one vector to another; the identity if either is nearly vertical or
/// short.
fn level_turn(from: DVec3, to: DVec3) -> DQuat {
    let level = |v: DVec3| DVec3::new(v.x, 0.0, v.z);
    let (a, b) = (level(from), level(to));
    if a.length() < 0.05 || b.length() < 0.05 {
        return DQuat::IDENTITY;
    }
    DQuat::from_rotation_y(b.x.atan2(b.z) - a.x.atan2(a.z))
}
