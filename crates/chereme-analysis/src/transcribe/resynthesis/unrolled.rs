//! Other readings of a repeated motion: the way there and the way back, written one after the other.
//!
//! A repeated motion returns to its start as a transition. A motion that was written there and back returns as a stroke,
//! in other time. The first reading hardly sees the difference.

use chereme_sign::hamnosys::{
    Directed, Each, Motion, MotionKind, Posture, Repeat, Repetition, Size,
};

/// The most motions in a sequence that stands for a repeated motion.
const MOST: usize = 5;

/// Returns other readings of a repeated motion; `from` is the hands' posture before it. Other motions have none.
pub(super) fn unrolled(action: &Motion, from: &Posture) -> Vec<Motion> {
    if let MotionKind::Split(a, b) = &action.kind {
        let of_hand = |hand: &Option<Box<Motion>>| match hand.as_deref() {
            Some(motion) => unrolled(motion, from).into_iter().map(Box::new).collect(),
            None => Vec::new(),
        };
        let own = of_hand(a).into_iter();
        let other = of_hand(b).into_iter();
        return own
            .map(|own| MotionKind::Split(Some(own), b.clone()))
            .chain(other.map(|other| MotionKind::Split(a.clone(), Some(other))))
            .map(Motion::new)
            .collect();
    }
    let MotionKind::Repeated { motion, repetition } = &action.kind else {
        return Vec::new();
    };
    if matches!(
        repetition.repeat,
        Repeat::Continue | Repeat::ContinueSeveral
    ) {
        let times = 2..=MOST;
        return times
            .map(|n| sequence(vec![Motion::clone(motion); n]))
            .collect();
    }
    let Some(back) = back(motion, from) else {
        return Vec::new();
    };
    let there_and_back = |n: usize, there: &Motion, back: &Motion| -> Vec<Motion> {
        let paths = [there, back].into_iter().cycle().cloned();
        paths.take(n).collect()
    };
    let mut all: Vec<Motion> = (2..=MOST)
        .map(|n| sequence(there_and_back(n, motion, &back)))
        .collect();
    all.extend([Repeat::FromStart, Repeat::FromStartSeveral].map(|repeat| {
        Motion::new(MotionKind::Repeated {
            motion: Box::new(sequence(there_and_back(2, motion, &back))),
            repetition: Repetition::plain(repeat),
        })
    }));
    // From the middle to one end, to and fro, and back to the middle.
    if let (Some(there), Some(back)) = (longer(motion), longer(&back)) {
        for n in 3..=MOST {
            let mut motions = there_and_back(n, &there, &back);
            motions[0] = Motion::clone(motion);
            all.push(sequence(motions.clone()));
            let last = motions.last_mut().expect("three motions or more");
            *last = shorter(last);
            all.push(sequence(motions));
        }
    }
    all
}

fn sequence(motions: Vec<Motion>) -> Motion {
    Motion::new(MotionKind::Sequence {
        motions,
        fused: false,
    })
}

/// Returns the way back of a path, to the posture `from`; `None` of other motions.
fn back(motion: &Motion, from: &Posture) -> Option<Motion> {
    let kind = match &motion.kind {
        MotionKind::Directed(path) => MotionKind::Directed(Directed {
            direction: path.direction.opposite(),
            second: path.second.map(|second| second.opposite()),
            ..path.clone()
        }),
        MotionKind::Parallel(all) => {
            let all = all.iter().map(|motion| back(motion, from));
            MotionKind::Parallel(all.collect::<Option<_>>()?)
        }
        MotionKind::Target { motion, posture } => {
            let motion = match motion {
                Some(motion) => Some(Box::new(back(motion, from)?)),
                None => None,
            };
            let posture = Posture {
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
    Some(Motion {
        kind,
        ..motion.clone()
    })
}

/// Returns the value of a property before it was changed.
fn as_before<T: Clone>(changed: &Each<T>, before: &Each<T>) -> Each<T> {
    match (changed, before.dominant()) {
        (Each::Unset, _) | (_, None) => Each::Unset,
        (Each::Shared(_), Some(own)) => Each::Shared(own.clone()),
        (Each::Split(..), Some(_)) => before.clone(),
    }
}

/// Returns a path of the next size; `None` for motions without a size, and for big ones.
fn longer(motion: &Motion) -> Option<Motion> {
    let mut is_longer = false;
    let other = sized(motion, &mut |size| match size {
        Some(Size::Small) => {
            is_longer = true;
            None
        }
        None => {
            is_longer = true;
            Some(Size::Big)
        }
        big => big,
    });
    is_longer.then_some(other)
}

fn shorter(motion: &Motion) -> Motion {
    sized(motion, &mut |size| match size {
        Some(Size::Big) => None,
        _ => Some(Size::Small),
    })
}

/// Returns a motion with other sizes of its straight and curved paths.
fn sized(motion: &Motion, size: &mut impl FnMut(Option<Size>) -> Option<Size>) -> Motion {
    let mut other = motion.clone();
    match &mut other.kind {
        MotionKind::Directed(path) => path.size.first = size(path.size.first),
        MotionKind::Parallel(all) => {
            for motion in all {
                *motion = sized(motion, size);
            }
        }
        MotionKind::Target {
            motion: Some(motion),
            ..
        } => **motion = sized(motion, size),
        _ => {}
    }
    other
}

#[cfg(test)]
mod tests {
    use super::super::actions::tests::{named, sign};
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
            MotionKind::Target { posture, .. } => Posture::clone(posture),
            other => panic!("{other:?}"),
        };
        for (movement, expected, count) in cases {
            let of = sign(movement).parts.swap_remove(0).actions;
            let all = unrolled(&of[0], &from).into_iter();
            let all: Vec<String> = all.map(|other| named(vec![other])).collect();
            for other in expected {
                assert!(
                    all.iter().any(|it| it == other),
                    "{movement}: no {other} in {all:#?}"
                );
            }
            assert_eq!(all.len(), count, "{movement}: {all:#?}");
        }
    }
}
