//! `amplify`, `travel` and directional verbs: the hands' paths grown, carried along, sent elsewhere.

use chereme_motion::Side;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::Component;

use crate::arm::{self, Reach};
use crate::body::{Frame, arm_length};
use crate::course::Course;
use crate::curve::Spline;
use crate::error::Cause;
use crate::ops::place::{self, told};
use crate::ops::say;
use crate::recipe::{Amplify, Indicate, Leg, Solver, Spot, Travel};
use crate::resolve::PlaceInput;
use crate::units::{Length, Seconds};
use crate::work::{Columns, Group, Work};

/// The effects and the largest residual.
type Done = (Vec<String>, f64);

/// Multiplies the distances of the wrists from the middle of their movement.
pub(crate) fn amplify(work: &mut Work, settings: &Amplify, operator: &str) -> Result<Done, Cause> {
    let sides = settings.hand.sides(work.handedness);
    let factor = settings.by.0;
    if factor == 1.0 {
        return Ok((vec!["nothing to do".into()], 0.0));
    }
    let reach = scale(work, sides, factor)?;
    say::withdraw(work, sides, operator, |component, feature| {
        component == Component::Movement && feature == Some("size")
    });
    work.changed(sides.iter().map(|&side| Group::Arm(side)), operator);
    let mut did = vec![format!(
        "the hands' ways are {:.0}% as large",
        factor * 100.0
    )];
    did.extend(told(&reach));
    Ok((did, reach.residual))
}

/// Scales the wrists' paths about their common middle.
pub(crate) fn scale(work: &mut Work, sides: &[Side], factor: f64) -> Result<Reach, Cause> {
    let mut middle = DVec3::ZERO;
    for &side in sides {
        let path = wrist_path(work, side)?;
        middle += path.iter().sum::<DVec3>() / (path.len() * sides.len()) as f64;
    }
    place::wrists(work, sides, Solver::Analytic, |_, _, at| {
        middle + (at - middle) * factor
    })
}

/// Carries the hands along a path while they do what they did.
pub(crate) fn travel(
    work: &mut Work,
    settings: &Travel,
    course: &Course,
    operator: &str,
) -> Result<Done, Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = place::frame(work, sides)?;
    let curve = curve(&frame, &settings.through);
    let way = match &curve {
        Some(curve) => along(work, curve, settings.time, course),
        None => way(work, &frame, &settings.path, course),
    };
    let before = work.clone();
    let reach = place::wrists(work, sides, Solver::Analytic, |_, frame, at| {
        at + way[frame]
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
        did.extend(told(&reach));
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
    did.extend(told(&reach));
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

/// Returns how far along a curve the hands are at each frame; they stay at its end where the movement lasts longer.
fn along(work: &Work, curve: &Spline, time: Option<Seconds>, course: &Course) -> Vec<DVec3> {
    let total = work.frames.saturating_sub(1).max(1) as f64 * work.rate.frame_time();
    let time = time.map_or(total, |time| time.0).max(1e-9);
    let now = |f: usize| f as f64 * work.rate.frame_time();
    (0..work.frames)
        .map(|f| curve.at(course.share((now(f) / time).min(1.0))))
        .collect()
}

/// Returns how far along the path the hands are at each frame.
///
/// Legs without a time share the rest of the movement by their lengths.
fn way(work: &Work, frame: &Frame, path: &[Leg], course: &Course) -> Vec<DVec3> {
    let total = work.frames.saturating_sub(1).max(1) as f64 * work.rate.frame_time();
    let told: f64 = path
        .iter()
        .filter_map(|leg| leg.time)
        .map(|time| time.0)
        .sum();
    let untold: f64 = path
        .iter()
        .filter(|leg| leg.time.is_none())
        .map(|leg| leg.distance.metres(frame.arm).abs())
        .sum();
    let left = (total - told).max(0.0);
    let mut at = (0.0, DVec3::ZERO);
    let mut legs = Vec::with_capacity(path.len());
    for leg in path {
        let share = leg.distance.metres(frame.arm).abs() / untold.max(1e-9);
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

/// A hand that a verb sends elsewhere.
struct Sent {
    side: Side,
    path: Vec<DVec3>,
    shoulders: [DVec3; 2],
    arm: f64,
}

impl Sent {
    fn of(work: &Work, side: Side) -> Result<Self, Cause> {
        let chain = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?;
        let columns = Columns::of(work, [chain.upper, chain.hand]);
        let shoulder = columns.positions(chain.upper);
        Ok(Self {
            side,
            path: columns.positions(chain.hand).to_vec(),
            shoulders: [shoulder[0], shoulder[work.frames - 1]],
            arm: arm_length(work, side).ok_or(Cause::NoArm(side))?,
        })
    }

    fn is_still(&self) -> bool {
        self.path.iter().all(|at| at.distance(self.path[0]) < STILL)
    }

    /// Returns the share of the line from `near` to `far` at which the wrist is within the arm's reach, at the
    /// start or the end, with the wrist `beside` the hands' middle.
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

/// Wrists that stay within this many metres do not move.
const STILL: f64 = 0.03;

/// How far, as a share of its length, an arm is stretched at most towards what is only a direction.
const REACH: f64 = 0.95;

/// Returns the hands that are sent: those that move, if one of them does and the other is not by it.
fn sent(work: &Work, sides: &[Side]) -> Result<Vec<Sent>, Cause> {
    let all = sides.iter().map(|&side| Sent::of(work, side));
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

/// Makes the hands' movement start and end elsewhere: the way between is turned and stretched with
/// its ends, and the hands turn about the vertical with it.
///
/// A mere direction, such as `left` or `you`, lies at the end of the arms' reach. A hand that hangs or lies still
/// while the other one moves stays in its place.
pub(crate) fn indicate(
    work: &mut Work,
    settings: &Indicate,
    places: [Option<&PlaceInput>; 2],
    operator: &str,
) -> Result<Done, Cause> {
    let hands = sent(work, settings.hand.sides(work.handedness))?;
    let sides: Vec<Side> = hands.iter().map(|hand| hand.side).collect();
    let frame = place::frame(work, &sides)?;
    let middle =
        |f: usize| hands.iter().map(|hand| hand.path[f]).sum::<DVec3>() / hands.len() as f64;
    let ends = [0, work.frames - 1];
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
    let shares = travelled(&(0..work.frames).map(middle).collect::<Vec<_>>());
    let turn = level_turn(end - start, to - from);
    let mut worst = Reach::default();
    for Sent { side, path, .. } in &hands {
        let side = *side;
        let chain = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?;
        let columns = Columns::of(work, [chain.hand]);
        let turned: Vec<DQuat> = columns
            .rotations(chain.hand)
            .iter()
            .map(|q| turn * *q)
            .collect();
        let targets: Vec<DVec3> = (0..work.frames)
            .map(|f| {
                let line = start.lerp(end, shares[f]);
                from.lerp(to, shares[f]) + turn * (path[f] - line)
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
            let frames = stays(work, side, at == 1)?;
            let what = (Component::Placement, None);
            say::tell(work, side, what, value, frames, operator);
        }
    }
    did.push(format!(
        "the way of {:.0} cm became {:.0} cm",
        start.distance(end) * 100.0,
        from.distance(to) * 100.0
    ));
    did.extend(told(&worst));
    Ok((did, worst.residual))
}

/// Returns the frames at the start, or at the end, in which a wrist keeps its position.
fn stays(work: &Work, side: Side, end: bool) -> Result<std::ops::Range<usize>, Cause> {
    let path = wrist_path(work, side)?;
    let last = path.len().saturating_sub(1);
    let near = |from: usize| {
        let from = path[from];
        move |at: &&DVec3| at.distance(from) < 2.0 * STILL
    };
    Ok(if end {
        let count = path.iter().rev().take_while(near(last)).count();
        path.len() - count..path.len()
    } else {
        0..path.iter().take_while(near(0)).count()
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

/// Returns the turn about the vertical from one way to another, where both go sideways at all.
fn level_turn(from: DVec3, to: DVec3) -> DQuat {
    let level = |v: DVec3| DVec3::new(v.x, 0.0, v.z);
    let (a, b) = (level(from), level(to));
    if a.length() < 0.05 || b.length() < 0.05 {
        return DQuat::IDENTITY;
    }
    DQuat::from_rotation_y(b.x.atan2(b.z) - a.x.atan2(a.z))
}

fn wrist_path(work: &Work, side: Side) -> Result<Vec<DVec3>, Cause> {
    let hand = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?.hand;
    Ok(Columns::of(work, [hand]).positions(hand).to_vec())
}

/// Returns whether a wrist keeps its position.
fn is_still(work: &Work, side: Side) -> bool {
    let path = wrist_path(work, side).unwrap_or_default();
    path.iter().all(|at| at.distance(path[0]) < STILL)
}

/// Notes the new path of hands that did not move before: straight if it has one leg, the shape of a curve.
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
        say::tell(work, side, (movement, None), shape, all.clone(), operator);
        if let Some(direction) = one {
            let what = (movement, Some("direction"));
            say::tell(work, side, what, &direction, all.clone(), operator);
        }
    }
}

/// Withdraws notes on the place and the movement of hands whose movement changed; phases stay.
fn moved(work: &mut Work, sides: &[Side], operator: &str) {
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
