//! Crossed fingers, by forward kinematics on bodies with different bones.

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};
use chereme_sign::hamnosys::{BodyLanguage, EachHand, HandDigit, Handshape, parse_hamnosys};

use super::notation_stage::{FINGER_FLESH, StandingBody};
use super::tests::stage;
use super::thumb;
use crate::testing::Axes;

fn handshape(names: &str) -> Handshape {
    let text = format!("{names} hamextfingeru hampalmd");
    let sign = parse_hamnosys(&text).expect("HamNoSys").sign;
    match &sign.parts[0].posture.shape {
        EachHand::Shared(shape) => shape.clone(),
        _ => panic!("one hand"),
    }
}

/// Returns the least distance between points along two fingers, each given by its joints and its tip.
fn apart(a: &[DVec3], b: &[DVec3]) -> f64 {
    let along = |joints: &[DVec3]| -> Vec<DVec3> {
        let bones = joints.windows(2);
        let points = bones.flat_map(|pair| (0..=20).map(|n| pair[0].lerp(pair[1], f64::from(n) / 20.0)));
        points.collect()
    };
    let (a, b) = (along(a), along(b));
    let distances = a.iter().flat_map(|one| b.iter().map(|other| one.distance(*other)));
    distances.fold(f64::INFINITY, f64::min)
}

#[test]
fn tips_of_crossed_fingers_change_sides_and_do_not_meet() {
    let cases = [
        ("hamfinger23 hamthumbacrossmod", false),
        (
            "hamfinger23 hamthumbacrossmod hamindexfinger hamfingernail hammiddlefinger",
            true,
        ),
        (
            "hamfinger23 hamthumbacrossmod hamindexfinger hamcross hammiddlefinger",
            true,
        ),
        (
            "hamfinger23 hamthumbacrossmod hammiddlefinger hamcross hamindexfinger",
            true,
        ),
        ("hamfist hamindexfinger hamfingerpad hammiddlefinger", true),
        ("hamfinger23 hamindexfinger hamfingerside hammiddlefinger", false),
    ];
    for axes in [Axes::Plain, Axes::Odd] {
        let body = StandingBody::body_from_material(&stage(axes)).expect("a body");
        for side in BodySide::BOTH_SIDES {
            let hand = body.hand_of_side(side).expect("a hand");
            let thick = 2.0 * FINGER_FLESH * hand.staged_hand_length();
            for (names, is_crossed) in cases {
                let shape = handshape(names);
                let angles = hand_angles(&shape, BodyLanguage::default_body_language());
                let posed = thumb::pose_handshape_thumb(&body, side, &shape, &angles);
                let joints = [HandDigit::Index, HandDigit::Middle].map(|digit| {
                    let point = |at| body.hand_point_offset(hand, &posed, at);
                    [
                        point(NotatedHandPoint::Base(digit, DigitFace::Middle)),
                        point(NotatedHandPoint::Middle(digit, DigitFace::Middle)),
                        body.last_joint(hand, &posed, digit).expect("a joint"),
                        point(NotatedHandPoint::Tip(digit, DigitFace::Middle)),
                    ]
                });
                let tips = joints[1][3] - joints[0][3];
                let (aside, ahead) = (tips.dot(hand.radial) / thick, tips.dot(hand.palm) / thick);
                let least = apart(&joints[0], &joints[1]) / thick;
                if is_crossed {
                    assert!(aside > 0.7 && ahead.abs() < 0.6, "{names}: {aside} {ahead}");
                    // Flesh gives way by half a finger at most.
                    assert!(least > 0.45, "{names}: {least}");
                } else {
                    assert!(aside < -0.5, "{names}: {aside}");
                }
            }
        }
    }
}
