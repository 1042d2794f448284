use chereme_sign::hamnosys::{HamnosysSign, from_names, parse_hamnosys, sign_hamnosys_text, to_names};

use super::*;

pub(in super::super) fn sign(movement: &str) -> HamnosysSign {
    let names: Vec<String> = movement.split(' ').map(|word| format!("ham{word}")).collect();
    let text = from_names(names.iter().map(String::as_str)).expect("symbols");
    parse_hamnosys(&text).expect("a movement").sign
}

/// Returns the symbols of actions, without their first three letters.
pub(in super::super) fn named(actions: Vec<NotatedMotion>) -> String {
    let mut sign = HamnosysSign::default();
    sign.parts.resize_with(1, Default::default);
    sign.parts[0].actions = actions;
    let names = to_names(&sign_hamnosys_text(&sign)).expect("symbols").join(" ");
    names.replace("ham", "")
}

#[test]
fn similar_readings_differ_in_one_property() {
    let cases: [(&str, &[&str]); 6] = [
        (
            "moveo",
            &[
                "moveo smallmod",
                "moveo largemod",
                "moveol",
                "moveo arcu smallmod",
                "moveo slow",
                "moveo repeatfromstart",
            ],
        ),
        (
            "moveo arcu",
            &["moveo", "moveo arcu smallmod", "moveo largemod arcu", "moveo arcu arcl"],
        ),
        (
            "circleo smallmod clockul repeatfromstart",
            &[
                "circleo clockul repeatfromstart",
                "circleo smallmod repeatfromstart",
                "circleo smallmod clocku repeatfromstart",
                "circleol smallmod clockul repeatfromstart",
                "circleo smallmod clockul repeatfromstartseveral",
                "circleo smallmod clockul",
            ],
        ),
        (
            "moveo smallmod fast chest touch",
            &[
                "moveo fast chest touch",
                "moveo smallmod chest touch",
                "moveo smallmod fast",
            ],
        ),
        (
            "parbegin moveo replace extfingeru palml parend",
            &[
                "parbegin moveo replace palml parend",
                "parbegin moveo replace extfingeru parend",
                "parbegin moveo replace extfingerul palml parend",
                "parbegin moveo replace extfingeru palmul parend",
                "replace extfingeru palml",
            ],
        ),
        (
            "nodding moveo",
            &["swinging moveo", "nodding smallmod moveo", "nodding moveuo"],
        ),
    ];
    for (movement, expected) in cases {
        let of = sign(movement).parts.swap_remove(0).actions;
        let all: Vec<String> = similar_action_lists(&of).into_iter().map(named).collect();
        for other in expected {
            assert!(
                all.iter().any(|reading| reading == other),
                "{movement}: no {other} in {all:?}"
            );
        }
        assert!(!all.iter().any(|reading| reading == movement), "{movement}: {all:?}");
        let mut unlike = all.clone();
        unlike.sort();
        unlike.dedup();
        assert_eq!(unlike.len(), all.len(), "{movement}: {all:?}");
    }
    assert_eq!(similar_action_lists(&sign("nomotion").parts[0].actions).len(), 5 + 5);
}

#[test]
fn a_path_ends_at_another_place() {
    let cases = [
        ("moveo", "moveo chin touch"),
        ("moveo chest touch", "moveo chin touch"),
        (
            "moveo smallmod repeatfromstart",
            "moveo smallmod chin touch repeatfromstart",
        ),
    ];
    let target = sign("moveo chin touch").parts.swap_remove(0).actions;
    let MotionKind::Target { posture, .. } = &target[0].kind else {
        panic!("{target:?}");
    };
    let place = posture.place.as_ref().expect("a place");
    for (movement, expected) in cases {
        let of = sign(movement).parts.swap_remove(0).actions;
        let other = with_target_place(&of[0], place).expect("a path");
        assert_eq!(named(vec![other]), expected);
    }
    let free = target.iter().map(without_target_place).collect();
    assert_eq!(named(free), "moveo");
    assert_eq!(with_target_place(&sign("nodding").parts[0].actions[0], place), None);
}
