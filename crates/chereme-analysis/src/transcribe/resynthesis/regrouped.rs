//! Other readings of several actions: as fewer ones, or as one that is repeated.
//!
//! If the first reading cuts a movement at a wrong frame, it has an action too many, or writes each turn of a repeated
//! movement as an action of its own.

use chereme_sign::hamnosys::{MotionKind, NotatedMotion, RepeatKind};

use super::resynthesis_actions::with_motion_repeat;

/// The repetitions that are tried for several actions.
const GROUPED_ACTION_REPEATS: [RepeatKind; 4] = [
    RepeatKind::FromStart,
    RepeatKind::FromStartSeveral,
    RepeatKind::Continue,
    RepeatKind::Reverse,
];

/// The most actions in a row for which one repeated action is tried.
const MAX_GROUPED_ACTIONS: usize = 8;

/// Returns lists of fewer actions: each lacks one of `actions`, or has a repeated one instead of several in a row.
pub(super) fn regroup_action_lists(actions: &[NotatedMotion]) -> Vec<Vec<NotatedMotion>> {
    let mut all = Vec::new();
    // A single action cannot be left out, but its parts can.
    if let [only] = actions {
        let inner = regroup_inner_parts(only).into_iter();
        return inner.map(|other| vec![other]).collect();
    }
    for k in 0..actions.len() {
        let mut other = actions.to_vec();
        other.remove(k);
        all.push(other);
    }
    for first in 0..actions.len() {
        for last in first + 1..actions.len().min(first + MAX_GROUPED_ACTIONS) {
            // The second one is right if the first is cut wrongly.
            for action in &actions[first..=first + 1] {
                let once = unrepeated_motion(action);
                all.extend(GROUPED_ACTION_REPEATS.map(|repeat| {
                    let instead = [with_motion_repeat(once, repeat)];
                    let rest = [&actions[..first], &instead, &actions[last + 1..]];
                    rest.concat()
                }));
            }
        }
    }
    all
}

/// Returns readings of an action whose parts are regrouped.
fn regroup_inner_parts(action: &NotatedMotion) -> Vec<NotatedMotion> {
    let with = |kind| NotatedMotion { kind, ..action.clone() };
    match &action.kind {
        MotionKind::Sequence { motions, fused } => {
            let all = regroup_action_lists(motions).into_iter();
            all.map(|mut motions| match motions.len() {
                1 => motions.remove(0),
                _ => with(MotionKind::Sequence { motions, fused: *fused }),
            })
            .collect()
        }
        MotionKind::Split(own, other) => {
            let of_hand = |hand: &Option<Box<NotatedMotion>>| match hand.as_deref() {
                Some(motion) => regroup_inner_parts(motion).into_iter().map(Box::new).collect(),
                None => Vec::new(),
            };
            let owns = of_hand(own).into_iter();
            let others = of_hand(other).into_iter();
            owns.map(|motion| MotionKind::Split(Some(motion), other.clone()))
                .chain(others.map(|motion| MotionKind::Split(own.clone(), Some(motion))))
                .map(with)
                .collect()
        }
        _ => Vec::new(),
    }
}

/// Returns the motion that is repeated; another motion is returned as it is.
fn unrepeated_motion(motion: &NotatedMotion) -> &NotatedMotion {
    match &motion.kind {
        MotionKind::Repeated { motion, .. } => motion,
        _ => motion,
    }
}

#[cfg(test)]
mod tests {
    use super::super::resynthesis_actions::tests::{named, sign};
    use super::*;

    #[test]
    fn fewer_actions_are_tried() {
        let cases: [(&str, &[&str]); 3] = [
            ("moveo", &[]),
            (
                "moveo movei",
                &[
                    "moveo",
                    "movei",
                    "moveo repeatfromstart",
                    "movei repeatfromstartseveral",
                    "moveo repeatreverse",
                ],
            ),
            (
                "moveo repeatfromstart movei nodding",
                &[
                    "moveo repeatfromstart movei",
                    "moveo repeatfromstart nodding",
                    "moveo repeatfromstartseveral",
                    "moveo repeatcontinue nodding",
                    "moveo repeatfromstart movei repeatreverse",
                ],
            ),
        ];
        for (movement, expected) in cases {
            let of = sign(movement).parts.swap_remove(0).actions;
            let all: Vec<String> = regroup_action_lists(&of).into_iter().map(named).collect();
            for other in expected {
                assert!(all.iter().any(|it| it == other), "{movement}: no {other} in {all:?}");
            }
            assert_eq!(expected.is_empty(), all.is_empty(), "{movement}: {all:?}");
        }
    }
}
