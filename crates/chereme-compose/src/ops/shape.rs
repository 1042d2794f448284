//! `amplify`, `travel` and directional verbs: the hands' paths grown, carried along, sent elsewhere.

use chereme_motion::Side;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::{Component, Reading};

use crate::arm::{self, Reach};
use crate::body::Frame;
use crate::course::Course;
use crate::error::Cause;
use crate::made::About;
use crate::ops::place::{self, told};
use crate::recipe::{Amplify, Indicate, Leg, Solver, Travel};
use crate::resolve::PlaceInput;
use crate::work::{Columns, Group, Work};

/// What was done and the largest residual.
type Done = (Vec<String>, f64);

/// Multiplies the distances of the wrists from the middle of their movement.
pub(crate) fn amplify(work: &mut Work, settings: &Amplify, operator: &str) -> Result<Done, Cause> {
    let sides = settings.hand.sides(work.handedness);
    let factor = settings.by.0;
    if factor == 1.0 {
        return Ok((vec!["nothing to do".into()], 0.0));
    }
    let reach = scale(work, sides, factor)?;
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
    let way = way(work, &frame, &settings.path, course);
    let reach = place::wrists(work, sides, Solver::Analytic, |_, frame, at| {
        at + way[frame]
    })?;
    moved(work, sides, operator);
    let length: f64 = settings
        .path
        .iter()
        .map(|leg| leg.distance.metres(frame.arm))
        .sum();
    let mut did = vec![format!(
        "{} ways, {:.0} cm in all",
        settings.path.len(),
        length * 100.0
    )];
    did.extend(told(&reach));
    Ok((did, reach.residual))
}

/// Returns how far along the path the hands are at each frame.
///
/// Legs without a time share what is left of the movement by their lengths.
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

/// Makes the hands' movement start and end elsewhere: the way between is turned and stretched with
/// its ends, and the hands turn about the vertical with it.
pub(crate) fn indicate(
    work: &mut Work,
    settings: &Indicate,
    places: [Option<&PlaceInput>; 2],
    operator: &str,
) -> Result<Done, Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = place::frame(work, sides)?;
    let paths = sides
        .iter()
        .map(|&side| wrist_path(work, side))
        .collect::<Result<Vec<_>, _>>()?;
    let middle = |f: usize| paths.iter().map(|path| path[f]).sum::<DVec3>() / paths.len() as f64;
    let (start, end) = (middle(0), middle(work.frames - 1));
    let spot = |at: usize, now: DVec3| {
        let wanted = [&settings.from, &settings.to][at].as_ref();
        wanted.map_or(Ok(now), |spot| {
            let place = places[at].map(|input| &input.at);
            frame
                .spot(work, spot, place, sides[0])
                .ok_or(Cause::NoMeaning {
                    value: spot.to_string(),
                    what: "landmark that this skeleton has",
                })
        })
    };
    let (from, to) = (spot(0, start)?, spot(1, end)?);
    let shares = travelled(&(0..work.frames).map(middle).collect::<Vec<_>>());
    let turn = level_turn(end - start, to - from);
    let mut worst = Reach::default();
    for (&side, path) in sides.iter().zip(&paths) {
        let chain = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?;
        let columns = Columns::of(work, [chain.hand]);
        let hands: Vec<DQuat> = columns
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
        let reach = arm::move_wrist(
            work,
            side,
            &columns,
            &targets,
            Some(&hands),
            Solver::Analytic,
        )
        .ok_or(Cause::NoArm(side))?;
        place::check(side, &reach)?;
        worst = worst.worse(reach);
    }
    moved(work, sides, operator);
    let mut did = vec![format!(
        "the way of {:.0} cm became {:.0} cm",
        start.distance(end) * 100.0,
        from.distance(to) * 100.0
    )];
    did.extend(told(&worst));
    Ok((did, worst.residual))
}

/// Returns the share of a path's length done at each frame; of its time where it has no length.
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

/// Says of the notes on hands that moved otherwise that their placement and movement are not told.
fn moved(work: &mut Work, sides: &[Side], operator: &str) {
    for note in &mut work.notes {
        let about = matches!(
            note.about,
            About::Component(Component::Placement | Component::Movement, _)
        );
        if about && note.hand.is_some_and(|side| sides.contains(&side)) {
            note.value = Reading::Unset;
            note.origin = format!("{} | {operator}", note.origin);
        }
    }
    work.changed(sides.iter().map(|&side| Group::Arm(side)), operator);
}
