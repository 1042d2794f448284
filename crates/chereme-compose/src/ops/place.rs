//! `place`: the hands elsewhere, moving and turned as they were.

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::Component;

use crate::arm::{self, HELP_FROM, Reach};
use crate::body::{self, Frame};
use crate::contact::{self, Touch};
use crate::error::Cause;
use crate::made::About;
use crate::ops::{clear, say};
use crate::recipe::{Goal, HandPoint, Place, Solver};
use crate::resolve::PlaceInput;
use crate::work::{Columns, Group, Work};

/// Moves the hands; returns a description of the effects, the residual, and the displacement in body space, in
/// metres.
pub(crate) fn place(
    work: &mut Work,
    settings: &Place,
    input: Option<&PlaceInput>,
    operator: &str,
) -> Result<(Vec<String>, f64, DVec3), Cause> {
    let sides = settings.hand.sides(work.handedness);
    let frame = frame(work, sides)?;
    let mut frames = 0..work.frames;
    let mut told_anchor = Vec::new();
    let by = match &settings.to {
        Goal::By(legs) => frame.sum(legs),
        to => {
            let goal = match (to, input) {
                (Goal::AtPoint(at), _) => frame.point(at),
                (Goal::Near { by, .. }, Some(input)) => {
                    spatial(work, &frame, input, sides[0])? + frame.sum(by)
                }
                (_, Some(input)) => spatial(work, &frame, input, sides[0])?,
                (_, None) => return Err(Cause::Input),
            };
            let anchor = anchor(work, sides, settings.with);
            let now = anchor.at(work, sides).ok_or(Cause::NoArm(sides[0]))?;
            told_anchor.extend(anchor.told(work));
            frames = anchor.frames;
            goal - now
        }
    };
    let near = matches!(&settings.to, Goal::Near { by, .. } if !by.is_empty());
    let value = input
        .and_then(|input| input.value.clone())
        .filter(|_| !near);
    let before = work.clone();
    let mut reach = shift(work, sides, by, settings.solver)?;
    let mut kept_out = Vec::new();
    if !matches!(settings.to, Goal::By(_)) {
        for &side in sides {
            let cleared = clear::clear(work, &before, side, settings.solver);
            let Some(cleared) = cleared else { continue };
            reach.residual = reach.residual.max(cleared.at(&frames));
            kept_out.push(cleared.told(work, side, &frames));
        }
    }
    for &side in sides {
        if by != DVec3::ZERO || value.is_some() {
            say::placed(work, side, value.as_deref(), frames.clone(), operator);
        }
    }
    if by != DVec3::ZERO {
        work.changed(sides.iter().map(|&side| Group::Arm(side)), operator);
    }
    let moved = frame.to_body(by);
    let cm = moved * 100.0;
    let mut did = vec![format!("moved {}", directions(cm))];
    did.extend(told_anchor);
    did.extend(kept_out);
    if let Some(input) = input {
        did.push(format!("the place is from {}", input.from));
    }
    did.extend(told(&reach));
    Ok((did, reach.residual, moved))
}

/// Returns a displacement in centimetres as people say it, each part with the direction it goes.
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

/// The moment of a sign whose place counts: frames, and the point of the hand in them.
struct Anchor {
    point: HandPoint,
    frames: std::ops::Range<usize>,
    /// The touched thing.
    touch: Option<Touch>,
}

/// Finds the moment whose place counts. For one hand it is the contact with the body that falls in the span of its
/// own placement, or in the whole sign if no placement is annotated; else the stroke in that span, else the span,
/// else the stroke.
fn anchor(work: &Work, sides: &[Side], with: Option<HandPoint>) -> Anchor {
    let whole = 0..work.frames;
    let point = with.unwrap_or(HandPoint::Palm);
    let [side] = *sides else {
        let spans = sides.iter().filter_map(|&side| body::placed(work, side));
        let frames = spans.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
        return Anchor {
            point,
            frames: frames.unwrap_or(whole),
            touch: None,
        };
    };
    let placed = body::placed(work, side);
    let within = placed.clone().unwrap_or(whole.clone());
    if let Some(touch) = contact::touches(work).with_body(side, &within) {
        return Anchor {
            point: with.unwrap_or(touch.point),
            frames: touch.frame..touch.frame + 1,
            touch: Some(touch),
        };
    }
    let about = About::Component(Component::Movement, Some("phase".to_owned()));
    let strokes = work.notes.iter().filter(|note| {
        let stroke = note.value.value() == Some("stroke");
        stroke && note.about == about && say::is_of(work, note, &[side])
    });
    let strokes = strokes.filter_map(|note| {
        let frames = work.rate.frames_in(note.span);
        let frames = frames.start.max(within.start)..frames.end.min(within.end);
        (!frames.is_empty()).then_some(frames)
    });
    let stroke = strokes.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
    Anchor {
        point,
        frames: match placed {
            Some(placed) => placed,
            None => stroke.unwrap_or(whole),
        },
        touch: None,
    }
}

impl Anchor {
    /// Returns where the point is at that moment; of two hands the middle between them.
    fn at(&self, work: &Work, sides: &[Side]) -> Option<DVec3> {
        if sides.len() > 1 {
            return body::mean_point(work, sides, self.point);
        }
        let point = |model: &_| body::hand_point(work, model, sides[0], self.point);
        body::mean(work, self.frames.clone(), point)
    }

    fn told(&self, work: &Work) -> Option<String> {
        let touch = self.touch?;
        let at = work.rate.instant(touch.frame);
        Some(format!(
            "the place is that of the contact at {at}: the {} at the {}",
            self.point.name(),
            touch.place
        ))
    }
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

/// Returns the body's frame, or an error that names the arm that is missing.
pub(crate) fn frame(work: &Work, sides: &[Side]) -> Result<Frame, Cause> {
    if let Some(&side) = sides.iter().find(|&&side| work.anatomy.arm(side).is_none()) {
        return Err(Cause::NoArm(side));
    }
    Frame::of(work).ok_or(Cause::NoArm(sides[0]))
}

/// Moves wrists by the same way at every frame.
pub(crate) fn shift(
    work: &mut Work,
    sides: &[Side],
    by: DVec3,
    solver: Solver,
) -> Result<Reach, Cause> {
    wrists(work, sides, solver, |_, _, at| at + by)
}

/// Moves wrists to the position that `target` gives for a hand and a frame, starting from its position there.
pub(crate) fn wrists(
    work: &mut Work,
    sides: &[Side],
    solver: Solver,
    target: impl Fn(Side, usize, DVec3) -> DVec3,
) -> Result<Reach, Cause> {
    let mut worst = Reach::default();
    let hand = |side: Side| work.anatomy.arm(side).map(|arm| arm.hand);
    let hands: Vec<Option<usize>> = sides.iter().map(|&side| hand(side)).collect();
    let columns = Columns::of(work, hands.iter().flatten().copied());
    for (&side, hand) in sides.iter().zip(hands) {
        let hand = hand.ok_or(Cause::NoArm(side))?;
        let at = columns.positions(hand).iter().enumerate();
        let targets: Vec<DVec3> = at.map(|(frame, &at)| target(side, frame, at)).collect();
        let reach = arm::move_wrist(work, side, &columns, &targets, None, solver)
            .ok_or(Cause::NoArm(side))?;
        check(side, &reach)?;
        worst = worst.worse(reach);
    }
    Ok(worst)
}

/// Refuses what lies half an arm and more out of reach.
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

/// Says what an arm could not do and what helped it.
pub(crate) fn told(reach: &Reach) -> Vec<String> {
    let mut told = Vec::new();
    if reach.residual > 1e-3 {
        told.push(format!(
            "out of reach: the wrist stays {:.1} cm short at frame {}",
            reach.residual * 100.0,
            reach.frame
        ));
    }
    if reach.is_softened() {
        told.push(format!(
            "the wrist leaves the arm's reach fast: beyond {:.1}% of its length it falls behind, so \
             that the elbow opens calmly",
            (1.0 - reach.soft) * 100.0
        ));
    }
    if reach.helped > 0 {
        told.push(format!(
            "the collar bone helped in {} frames, beyond {:.0}% of the arm's length",
            reach.helped,
            HELP_FROM * 100.0
        ));
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_names_the_direction_it_goes() {
        let text = directions(DVec3::new(-1.9, 2.0, -0.34));
        assert_eq!(text, "1.9 cm right, 2.0 cm up, 0.3 cm back");
    }
}
