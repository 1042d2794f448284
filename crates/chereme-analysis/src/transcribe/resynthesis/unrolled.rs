//! Other readings of a repeated motion: the way there and the way back, written one after the other.
//!
//! A repeated motion returns to its start as a transition. A motion that was written there and back returns as a stroke,
//! in other time. The first reading hardly sees the difference.

use chereme_sign::hamnosys::{
    DirectedPath, EachHand, MotionKind, MotionRepetition, MotionSize, NotatedMotion, NotatedPosture, RepeatKind,
};

/// The most motions in a sequence that stands for a repeated motion.
const MAX_UNROLLED_MOTIONS: usize = 5;

/// Returns other readings of a repeated motion; `from` is the hands' posture before it. Other motions have none.
pub(super) fn unroll_repeated_motion(action: &NotatedMotion, from: &NotatedPosture) -> Vec<NotatedMotion> {
    if let MotionKind::Split(a, b) = &action.kind {
        let of_hand = |hand: &Option<Box<NotatedMotion>>| match hand.as_deref() {
            Some(motion) => unroll_repeated_motion(motion, from).into_iter().map(Box::new).collect(),
            None => Vec::new(),
        };
        let own_motions = of_hand(a).into_iter();
        let other = of_hand(b).into_iter();
        return own_motions
            .map(|own| MotionKind::Split(Some(own), b.clone()))
            .chain(other.map(|other| MotionKind::Split(a.clone(), Some(other))))
            .map(NotatedMotion::new)
            .collect();
    }
    let MotionKind::Repeated { motion, repetition } = &action.kind else {
        return Vec::new();
    };
    if matches!(repetition.repeat, RepeatKind::Continue | RepeatKind::ContinueSeveral) {
        let times = 2..=MAX_UNROLLED_MOTIONS;
        return times
            .map(|n| motion_sequence(vec![NotatedMotion::clone(motion); n]))
            .collect();
    }
    let Some(back) = reverse_path_motion(motion, from) else {
        return Vec::new();
    };
    let there_and_back = |n: usize, there: &NotatedMotion, back: &NotatedMotion| -> Vec<NotatedMotion> {
        let paths = [there, back].into_iter().cycle().cloned();
        paths.take(n).collect()
    };
    let mut all: Vec<NotatedMotion> = (2..=MAX_UNROLLED_MOTIONS)
        .map(|n| motion_sequence(there_and_back(n, motion, &back)))
        .collect();
    all.extend([RepeatKind::FromStart, RepeatKind::FromStartSeveral].map(|repeat| {
        NotatedMotion::new(MotionKind::Repeated {
            motion: Box::new(motion_sequence(there_and_back(2, motion, &back))),
            repetition: MotionRepetition::plain_repetition(repeat),
        })
    }));
    // From the middle to one end, to and fro, and back to the middle.
    if let (Some(there), Some(back)) = (longer(motion), longer(&back)) {
        for n in 3..=MAX_UNROLLED_MOTIONS {
            let mut motions = there_and_back(n, &there, &back);
            motions[0] = NotatedMotion::clone(motion);
            all.push(motion_sequence(motions.clone()));
            let last = motions.last_mut().expect("three motions or more");
            *last = shorter(last);
            all.push(motion_sequence(motions));
        }
    }
    all
}

fn motion_sequence(motions: Vec<NotatedMotion>) -> NotatedMotion {
    NotatedMotion::new(MotionKind::Sequence { motions, fused: false })
}

/// Returns the way back of a path, to the posture `from`; `None` of other motions.
fn reverse_path_motion(motion: &NotatedMotion, from: &NotatedPosture) -> Option<NotatedMotion> {
    let kind = match &motion.kind {
        MotionKind::Directed(path) => MotionKind::Directed(DirectedPath {
            direction: path.direction.opposite_spatial_direction(),
            second: path.second.map(|second| second.opposite_spatial_direction()),
            ..path.clone()
        }),
        MotionKind::Parallel(all) => {
            let all = all.iter().map(|motion| reverse_path_motion(motion, from));
            MotionKind::Parallel(all.collect::<Option<_>>()?)
        }
        MotionKind::Target { motion, posture } => {
            let motion = match motion {
                Some(motion) => Some(Box::new(reverse_path_motion(motion, from)?)),
                None => None,
            };
            let posture = NotatedPosture {
                shape: as_before(&posture.shape, &from.shape),
                extended: as_before(&posture.extended, &from.extended),
                palm: as_before(&posture.palm, &from.palm),
                place: None,
            };
            match motion {
                Some(motion) if posture.is_empty() => motion.kind,
                motion => MotionKind::Target {
                    motion,
                    posture: Box::new(posture),
                },
            }
        }
        _ => return None,
    };
    Some(NotatedMotion { kind, ..motion.clone() })
}

/// Returns the value of a property before it was changed.
fn as_before<T: Clone>(changed: &EachHand<T>, before: &EachHand<T>) -> EachHand<T> {
    match (changed, before.dominant_value()) {
        (EachHand::Unset, _) | (_, None) => EachHand::Unset,
        (EachHand::Shared(_), Some(own)) => EachHand::Shared(own.clone()),
        (EachHand::Split(..), Some(_)) => before.clone(),
    }
}

/// Returns a path of the next size; `None` for motions without a size, and for big ones.
fn longer(motion: &NotatedMotion) -> Option<NotatedMotion> {
    let mut is_longer = false;
    let other = resize_motion_paths(motion, &mut |size| match size {
        Some(MotionSize::Small) => {
            is_longer = true;
            None
        }
        None => {
            is_longer = true;
            Some(MotionSize::Big)
        }
        big => big,
    });
    is_longer.then_some(other)
}

fn shorter(motion: &NotatedMotion) -> NotatedMotion {
    resize_motion_paths(motion, &mut |size| match size {
        Some(MotionSize::Big) => None,
        _ => Some(MotionSize::Small),
    })
}

/// Returns a motion with other sizes of its straight and curved paths.
fn resize_motion_paths(
    motion: &NotatedMotion,
    size: &mut impl FnMut(Option<MotionSize>) -> Option<MotionSize>,
) -> NotatedMotion {
    let mut other = motion.clone();
    match &mut other.kind {
        MotionKind::Directed(path) => path.size.first = size(path.size.first),
        MotionKind::Parallel(all) => {
            for motion in all {
                *motion = resize_motion_paths(motion, size);
            }
        }
        MotionKind::Target {
            motion: Some(motion), ..
        } => **motion = resize_motion_paths(motion, size),
        _ => {}
    }
    other
}

#[cfg(test)]
mod tests {
    use super::super::resynthesis_actions::tests::{named, sign};
    use super::*;

    #[test]
    fn a_repeated_path_is_written_there_and_back() {
        let cases: [(&str, &[&str], usize); 5] = [
            (
                "moveo repeatfromstart",
                &[
                    "seqbegin moveo movei seqend",
                    "seqbegin moveo movei moveo movei moveo seqend",
                    "seqbegin moveo movei seqend repeatfromstartseveral",
                    "seqbegin moveo movei largemod moveo largemod seqend",
                    "seqbegin moveo movei largemod moveo seqend",
                ],
                4 + 2 + 6,
            ),
            (
                "moveo largemod repeatfromstart",
                &["seqbegin moveo largemod movei largemod moveo largemod seqend"],
                4 + 2,
            ),
            (
                "moved smallmod repeatcontinueseveral",
                &["seqbegin moved smallmod moved smallmod moved smallmod seqend"],
                4,
            ),
            (
                "parbegin moveo replace extfingerl palmd parend repeatfromstart",
                &["seqbegin parbegin moveo replace extfingerl palmd parend \
                     parbegin movei replace extfingeru palml parend seqend"],
                4 + 2 + 6,
            ),
            ("circleo repeatfromstart", &[], 0),
        ];
        let from = sign("moveo replace extfingeru palml");
        let from = match &from.parts[0].actions[1].kind {
            MotionKind::Target { posture, .. } => NotatedPosture::clone(posture),
            other => panic!("{other:?}"),
        };
        for (movement, expected, count) in cases {
            let of = sign(movement).parts.swap_remove(0).actions;
            let all = unroll_repeated_motion(&of[0], &from).into_iter();
            let all: Vec<String> = all.map(|other| named(vec![other])).collect();
            for other in expected {
                assert!(all.iter().any(|it| it == other), "{movement}: no {other} in {all:#?}");
            }
            assert_eq!(all.len(), count, "{movement}: {all:#?}");
        }
    }
}
