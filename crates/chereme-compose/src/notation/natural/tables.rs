//! Golden tables of the parts of the animator: paces, paths, the trunk, points of hands, and arms.

use chereme_motion::WristAngles;

use super::super::arm::{Bearing, Limits, Posed};
use super::super::pace::{Pace, Paces};
use super::super::path::Path;
use super::*;
use crate::golden::{compare, put};

fn list(at: DVec3) -> String {
    let [x, y, z] = (at * 1000.0).to_array();
    format!("{x:?} {y:?} {z:?}")
}

#[test]
fn golden_paces_and_paths() {
    let mut out = String::new();
    let paces = Paces::of(BodyLanguage::usual());
    for pace in [
        Pace::Targetted,
        Pace::Lax,
        Pace::Contact,
        Pace::Halt,
        Pace::Tense,
        Pace::Linear,
        Pace::Calm,
    ] {
        let shares: Vec<f64> = (-1..=21)
            .map(|n| paces.share(pace, f64::from(n) / 20.0))
            .collect();
        put(
            &mut out,
            format!("{pace:?} peak {:?}: {shares:?}", pace.peak()),
        );
    }
    let (a, b) = (DVec3::new(0.2, 0.05, 0.1), DVec3::new(-0.03, 0.08, 0.02));
    let wave = |wavy: bool| Path::Wave {
        side: b,
        waves: 2.5,
        wavy,
        grown: 1.6,
    };
    let paths = [
        Path::Line(a),
        Path::Late(a),
        Path::Arc { chord: a, bow: b },
        wave(true),
        wave(false),
        Path::Circle {
            start: DVec3::new(0.0, 0.1, 0.0),
            quarter: DVec3::new(0.06, 0.0, 0.02),
            angle: 7.5,
            grown: 0.7,
        },
        Path::Through(vec![a, a + b, b, DVec3::new(0.1, -0.1, 0.0)]),
        Path::Spring(b),
    ];
    for path in &paths {
        put(&mut out, format!("## {path:?}"));
        put(
            &mut out,
            format!("length {:?} end {}", path.length(), list(path.end())),
        );
        for share in [0.0, 0.1, 0.23, 0.5, 0.61, 0.87, 1.0] {
            let heading = path.heading(share).map(list);
            let turned = path.turned(share) * DVec3::new(0.3, 0.5, 0.8);
            let mapped = path.map(|at| DVec3::new(-at.x, 2.0 * at.y, at.z)).at(share);
            put(
                &mut out,
                format!(
                    "{share}: {} {heading:?} {} {}",
                    list(path.at(share)),
                    list(turned),
                    list(mapped)
                ),
            );
        }
    }
    compare("paces_paths", &out);
}

#[test]
fn golden_trunk_as_an_obstacle() {
    let mut out = String::new();
    for axes in [Axes::Plain, Axes::Odd] {
        let body = Stage::of(&stage(axes)).expect("a body");
        let torso = &body.torso;
        put(&mut out, format!("## {axes:?} {}", list(body.middle())));
        for height in [1.53, 1.44, 1.3, 1.17, 1.02, 0.8] {
            for aside in [-0.19, -0.13, -0.02, 0.07, 0.15] {
                for ahead in [-0.09, -0.06, -0.015, 0.01, 0.06, 0.13] {
                    let at = DVec3::new(aside, height, ahead);
                    let margin = 0.01 + 0.1 * (ahead + 0.1);
                    let moved = [torso.offset_out(at, margin), torso.offset_aside(at, margin)];
                    let seen = torso.seen_from(at, DQuat::IDENTITY);
                    let clear = seen.is_some_and(|seen| seen.is_clear(DVec3::ZERO, margin));
                    if moved == [DVec3::ZERO; 2] && clear {
                        continue;
                    }
                    put(
                        &mut out,
                        format!(
                            "{}: out {} aside {} normal {:?} clear {}",
                            list(at),
                            list(moved[0]),
                            list(moved[1]),
                            torso.normal(at).map(list),
                            clear
                        ),
                    );
                }
            }
        }
    }
    compare("trunk", &out);
}

#[test]
fn golden_points_of_hands() {
    let mut out = String::new();
    let digits = [
        Digit::Thumb,
        Digit::Index,
        Digit::Middle,
        Digit::Ring,
        Digit::Little,
    ];
    let faces = [
        Face::Middle,
        Face::Palmar,
        Face::Dorsal,
        Face::Radial,
        Face::Ulnar,
    ];
    let mut points = vec![
        HandPoint::Palm,
        HandPoint::Back,
        HandPoint::Radial,
        HandPoint::Ulnar,
        HandPoint::ThumbBall,
        HandPoint::Elbow,
        HandPoint::Forearm,
        HandPoint::UpperArm,
    ];
    for (n, face) in faces.into_iter().enumerate() {
        points.push(HandPoint::Wrist(face));
        // Each digit with two faces at each of its joints.
        for (m, digit) in digits
            .into_iter()
            .enumerate()
            .filter(|(m, _)| (n + m).is_multiple_of(2))
        {
            points.push(HandPoint::Tip(digit, faces[(n + m) % 5]));
            points.push(HandPoint::Middle(digit, face));
            points.push(HandPoint::Base(digit, face));
        }
    }
    for axes in [Axes::Plain, Axes::Odd] {
        let body = Stage::of(&stage(axes)).expect("a body");
        for (side, class) in [
            (Side::Right, HandClass::Finger2),
            (Side::Left, HandClass::Cee12),
        ] {
            put(&mut out, format!("## {axes:?} {} {class:?}", side.name()));
            let mut shape = Handshape::default();
            shape.form.class = class;
            let angles = hand_angles(&shape, BodyLanguage::usual());
            let hand = body.hand(side).expect("a hand");
            let shape = body.shape(side, &angles);
            put(
                &mut out,
                format!(
                    "outline {} {:?} length {:?}",
                    list(shape.outline.middle),
                    shape.outline.radius,
                    hand.length()
                ),
            );
            let across = hand.along.cross(hand.palm);
            let own = |at: DVec3| {
                let own = [hand.along, hand.palm, across].map(|axis| at.dot(axis));
                list(DVec3::from(own))
            };
            for point in &points {
                let (at, out_of) = (
                    body.point(hand, &shape, *point),
                    body.outward(hand, &shape, *point),
                );
                put(
                    &mut out,
                    format!("{point:?}: {} outward {}", own(at), own(out_of)),
                );
            }
            for digit in digits {
                let last = body.last_joint(hand, &shape, digit).map(own);
                let bone = own(body.bone(hand, &shape, digit));
                put(&mut out, format!("{digit:?} bone {bone} last {last:?}"));
            }
        }
    }
    compare("hand_points", &out);
}

#[test]
fn golden_acts_of_head_trunk_and_shoulders() {
    let mut out = String::new();
    let span = plan::SignSpan {
        gloss: "SIGN".into(),
        from: 1.0,
        to: 2.6,
    };
    let codes: [(NonmanualPart, &[&str]); 3] = [
        (
            NonmanualPart::Head,
            &[
                "NO", "ND", "SH", "SR", "SL", "TR", "TL", "NF", "NB", "PF", "PB", "LI", "NU",
            ],
        ),
        (
            NonmanualPart::Body,
            &["RL", "RR", "TL", "TR", "TF", "TB", "RD", "SI", "HE", "ST"],
        ),
        (
            NonmanualPart::Shoulders,
            &["UR", "UL", "UB", "HR", "HL", "HB", "SR", "SL", "SB"],
        ),
    ];
    for (part, codes) in codes {
        for (n, code) in codes.iter().enumerate() {
            let mut act = Act::new(part, *code);
            if n % 3 == 2 {
                (act.amount, act.speed) = (Some(0.6), Some(1.7));
            }
            let mut sign = notated(HandsUsed::Dominant, flat(None), vec![]);
            sign.nonmanual.push(part.tier(), vec![act]);
            let spans = std::slice::from_ref(&span);
            let language = BodyLanguage::usual();
            let (bents, busy) = nonmanual::bents(&[&sign], spans, language, 50.0, 160);
            put(&mut out, format!("## {part:?} {code}"));
            for frame in [40, 46, 55, 70, 83, 97, 115, 128, 133, 150] {
                put(
                    &mut out,
                    format!("{frame}: {:?} {:?}", bents[frame], busy[frame]),
                );
            }
        }
    }
    compare("acts", &out);
}

fn described(posed: &Posed) -> String {
    format!(
        "shoulder {} elbow {} wrist {}",
        list(posed.shoulder),
        list(posed.elbow),
        list(posed.wrist)
    )
}

#[test]
fn golden_arms_that_reach() {
    let mut out = String::new();
    let limits = Limits::of(BodyLanguage::usual());
    let heights: Vec<f64> = (-5..=5)
        .map(|n| limits.below(0.12 * f64::from(n)))
        .collect();
    put(&mut out, format!("below {heights:?}"));
    for axes in [Axes::Plain, Axes::Odd] {
        let body = Stage::of(&stage(axes)).expect("a body");
        for side in Side::BOTH {
            let hand = body.hand(side).expect("a hand");
            let rig = &hand.rig;
            put(
                &mut out,
                format!("## {axes:?} {} {:?}", side.name(), rig.length()),
            );
            for (n, at) in [
                [0.1, 1.2, 0.3],
                [0.3, 1.45, 0.25],
                [-0.15, 1.3, 0.28],
                [0.05, 1.75, 0.2],
                [0.25, 0.95, 0.15],
                [0.5, 1.4, 0.35],
                [0.2, 1.41, 0.08],
                [-0.3, 1.15, 0.3],
            ]
            .into_iter()
            .enumerate()
            {
                let wrist = DVec3::new(side.sign() * at[0], at[1], at[2]);
                let n = n as f64;
                let bearing = Bearing {
                    plane: 0.25 * (n - 3.0),
                    shrug: 0.3 * (n % 3.0) - 0.3,
                };
                let posed = rig.reach(wrist, bearing, &limits);
                put(&mut out, format!("{}: {}", list(wrist), described(&posed)));
                let angles = WristAngles {
                    flexion: 0.2 * n - 0.5,
                    deviation: 0.1 - 0.05 * n,
                    turn: 0.3 * n - 1.0,
                };
                let held = hand.held();
                let turned = rig.hung(&posed, &angles, &held);
                let again = rig.wrist(&posed, turned, &held);
                put(
                    &mut out,
                    format!(
                        "  hand {} {} {again:?}",
                        list(turned * hand.along),
                        list(turned * hand.palm)
                    ),
                );
                // The rotations of the joints give the same arm.
                let (back, there) = rig.posed(rig.rotations(&posed, turned));
                assert!(back.elbow.distance(posed.elbow) < 1e-6, "{at:?}");
                assert!(there.angle_between(turned) < 1e-6, "{at:?}");
                let other = rig.moved(&posed, wrist + DVec3::new(0.02, -0.03, 0.01), 0.2);
                put(&mut out, format!("  moved {}", described(&other)));
            }
        }
    }
    compare("arms", &out);
}
