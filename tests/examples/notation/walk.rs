//! Finds motions, places and interlocked hands in the tree of a sign.

use chereme_sign::hamnosys::{BodyPlace, HandPlace, MotionKind, NotatedMotion, NotatedSign, PlaceContact};

/// Returns whether hands interlock or cross somewhere in a sign.
pub(crate) fn interlocked(notated: &NotatedSign) -> bool {
    fn has(place: &HandPlace) -> bool {
        match place {
            HandPlace::Hands(hands) => {
                matches!(hands.contact, Some(PlaceContact::Interlock | PlaceContact::Cross))
            }
            HandPlace::Hand(site) => site.contact == Some(PlaceContact::Interlock),
            HandPlace::Split(a, b) => [a, b].into_iter().flatten().any(|place| has(place)),
            _ => false,
        }
    }
    let mut any = notated
        .sign
        .parts
        .iter()
        .any(|part| part.posture.place.as_ref().is_some_and(has));
    each_motion(notated, &mut |motion| {
        if let MotionKind::Target { posture, .. } = &motion.kind {
            any |= posture.place.as_ref().is_some_and(has);
        }
    });
    any
}

/// Returns the places on the body at which the parts of a sign begin.
pub(crate) fn places(notated: &NotatedSign) -> Vec<&BodyPlace> {
    let firsts = notated.sign.parts.iter().filter_map(|part| part.posture.place.as_ref());
    firsts
        .filter_map(|place| match place {
            HandPlace::Body(body) => Some(body),
            _ => None,
        })
        .collect()
}

/// Visits every motion of a sign, outer ones first.
pub(crate) fn each_motion(notated: &NotatedSign, see: &mut impl FnMut(&NotatedMotion)) {
    fn walk(motion: &NotatedMotion, see: &mut impl FnMut(&NotatedMotion)) {
        see(motion);
        match &motion.kind {
            MotionKind::Split(a, b) => {
                for motion in [a, b].into_iter().flatten() {
                    walk(motion, see);
                }
            }
            MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => {
                for motion in motions {
                    walk(motion, see);
                }
            }
            MotionKind::Target {
                motion: Some(motion), ..
            }
            | MotionKind::Repeated { motion, .. } => walk(motion, see),
            _ => {}
        }
    }
    for part in &notated.sign.parts {
        for motion in &part.actions {
            walk(motion, see);
        }
    }
}

/// Returns the sign with every motion changed, inner ones first.
pub(crate) fn with_motions(notated: &NotatedSign, change: &mut impl FnMut(&mut NotatedMotion)) -> NotatedSign {
    fn walk(motion: &mut NotatedMotion, change: &mut impl FnMut(&mut NotatedMotion)) {
        match &mut motion.kind {
            MotionKind::Split(a, b) => {
                for motion in [a, b].into_iter().flatten() {
                    walk(motion, change);
                }
            }
            MotionKind::Sequence { motions, .. } | MotionKind::Parallel(motions) => {
                for motion in motions {
                    walk(motion, change);
                }
            }
            MotionKind::Target {
                motion: Some(motion), ..
            }
            | MotionKind::Repeated { motion, .. } => walk(motion, change),
            _ => {}
        }
        change(motion);
    }
    let mut changed = notated.clone();
    for part in &mut changed.sign.parts {
        for motion in &mut part.actions {
            walk(motion, change);
        }
    }
    changed
}
