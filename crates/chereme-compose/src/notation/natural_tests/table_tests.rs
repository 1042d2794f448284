//! Golden tables of the parts of the animator: paces, paths, the trunk, points of hands, and arms.

use chereme_motion::WristAngles;

use super::super::notation_arm::{ArmBearing, ArmLimits, ArmPosture};
use super::super::notation_path::HandPath;
use super::super::pace::{MovementPace, PaceTables};
use super::*;
use crate::golden::{compare, put};

fn format_vector_list(at: DVec3) -> String {
    let [x, y, z] = (at * 1000.0).to_array();
    format!("{x:?} {y:?} {z:?}")
}

#[test]
fn golden_paces_and_paths() {
    let mut out = String::new();
    let paces = PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
    for pace in [
        MovementPace::Targetted,
        MovementPace::Lax,
        MovementPace::Contact,
        MovementPace::Halt,
        MovementPace::Tense,
        MovementPace::Linear,
        MovementPace::Calm,
    ] {
        let shares: Vec<f64> = (-1..=21)
            .map(|n| paces.pace_path_share(pace, f64::from(n) / 20.0))
            .collect();
        put(
            &mut out,
            format!("{pace:?} peak {:?}: {shares:?}", pace.peak_speed_factor()),
        );
    }
    let (a, b) = (DVec3::new(0.2, 0.05, 0.1), DVec3::new(-0.03, 0.08, 0.02));
    let wave = |wavy: bool| HandPath::Wave {
        side: b,
        waves: 2.5,
        wavy,
        grown: 1.6,
    };
    let paths = [
        HandPath::Line(a),
        HandPath::Late(a),
        HandPath::Arc { chord: a, bow: b },
        wave(true),
        wave(false),
        HandPath::Circle {
            start: DVec3::new(0.0, 0.1, 0.0),
            quarter: DVec3::new(0.06, 0.0, 0.02),
            angle: 7.5,
            grown: 0.7,
        },
        HandPath::Through(vec![a, a + b, b, DVec3::new(0.1, -0.1, 0.0)]),
        HandPath::Spring(b),
    ];
    for path in &paths {
        put(&mut out, format!("## {path:?}"));
        put(
            &mut out,
            format!(
                "length {:?} end {}",
                path.path_length(),
                format_vector_list(path.path_end())
            ),
        );
        for share in [0.0, 0.1, 0.23, 0.5, 0.61, 0.87, 1.0] {
            let heading = path.path_heading(share).map(format_vector_list);
            let turned = path.path_rotation_at(share) * DVec3::new(0.3, 0.5, 0.8);
            let mapped = path
                .map_path_vectors(|at| DVec3::new(-at.x, 2.0 * at.y, at.z))
                .path_point_at(share);
            put(
                &mut out,
                format!(
                    "{share}: {} {heading:?} {} {}",
                    format_vector_list(path.path_point_at(share)),
                    format_vector_list(turned),
                    format_vector_list(mapped)
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
        let body = StandingBody::body_from_material(&stage(axes)).expect("a body");
        let torso = &body.torso;
        put(
            &mut out,
            format!("## {axes:?} {}", format_vector_list(body.shoulder_middle())),
        );
        for height in [1.53, 1.44, 1.3, 1.17, 1.02, 0.8] {
            for aside in [-0.19, -0.13, -0.02, 0.07, 0.15] {
                for ahead in [-0.09, -0.06, -0.015, 0.01, 0.06, 0.13] {
                    let probe_point = DVec3::new(aside, height, ahead);
                    let margin = 0.01 + 0.1 * (ahead + 0.1);
                    let moved = [
                        torso.offset_out_of_trunk(probe_point, margin),
                        torso.offset_aside(probe_point, margin),
                    ];
                    let seen = torso.seen_from(probe_point, DQuat::IDENTITY);
                    let clear = seen.is_some_and(|seen| seen.is_clear(DVec3::ZERO, margin));
                    if moved == [DVec3::ZERO; 2] && clear {
                        continue;
                    }
                    put(
                        &mut out,
                        format!(
                            "{}: out {} aside {} normal {:?} clear {}",
                            format_vector_list(probe_point),
                            format_vector_list(moved[0]),
                            format_vector_list(moved[1]),
                            torso.trunk_front_normal(probe_point).map(format_vector_list),
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
        HandDigit::Thumb,
        HandDigit::Index,
        HandDigit::Middle,
        HandDigit::Ring,
        HandDigit::Little,
    ];
    let faces = [
        DigitFace::Middle,
        DigitFace::Palmar,
        DigitFace::Dorsal,
        DigitFace::Radial,
        DigitFace::Ulnar,
    ];
    let mut points = vec![
        NotatedHandPoint::Palm,
        NotatedHandPoint::Back,
        NotatedHandPoint::Radial,
        NotatedHandPoint::Ulnar,
        NotatedHandPoint::ThumbBall,
        NotatedHandPoint::Elbow,
        NotatedHandPoint::Forearm,
        NotatedHandPoint::UpperArm,
    ];
    for (n, face) in faces.into_iter().enumerate() {
        points.push(NotatedHandPoint::Wrist(face));
        // Each digit with two faces at each of its joints.
        for (m, digit) in digits
            .into_iter()
            .enumerate()
            .filter(|(m, _)| (n + m).is_multiple_of(2))
        {
            points.push(NotatedHandPoint::Tip(digit, faces[(n + m) % 5]));
            points.push(NotatedHandPoint::Middle(digit, face));
            points.push(NotatedHandPoint::Base(digit, face));
        }
    }
    for axes in [Axes::Plain, Axes::Odd] {
        let body = StandingBody::body_from_material(&stage(axes)).expect("a body");
        for (side, class) in [
            (BodySide::Right, HandClass::Finger2),
            (BodySide::Left, HandClass::Cee12),
        ] {
            put(&mut out, format!("## {axes:?} {} {class:?}", side.body_side_name()));
            let mut shape = Handshape::default();
            shape.form.class = class;
            let angles = hand_angles(&shape, BodyLanguage::default_body_language());
            let hand = body.hand_of_side(side).expect("a hand");
            let shape = body.finger_shape(side, &angles);
            put(
                &mut out,
                format!(
                    "outline {} {:?} length {:?}",
                    format_vector_list(shape.outline.middle),
                    shape.outline.radius,
                    hand.staged_hand_length()
                ),
            );
            let across = hand.along.cross(hand.palm);
            let local_point = |at: DVec3| {
                let axis_values = [hand.along, hand.palm, across].map(|axis| at.dot(axis));
                format_vector_list(DVec3::from(axis_values))
            };
            for point in &points {
                let (at, out_of) = (
                    body.hand_point_offset(hand, &shape, *point),
                    body.hand_point_normal(hand, &shape, *point),
                );
                put(
                    &mut out,
                    format!("{point:?}: {} outward {}", local_point(at), local_point(out_of)),
                );
            }
            for digit in digits {
                let last = body.last_joint(hand, &shape, digit).map(local_point);
                let bone = local_point(body.last_bone_direction(hand, &shape, digit));
                put(&mut out, format!("{digit:?} bone {bone} last {last:?}"));
            }
        }
    }
    compare("hand_points", &out);
}

#[test]
fn golden_acts_of_head_trunk_and_shoulders() {
    let mut out = String::new();
    let span = notation_plan::SignSpan {
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
            let mut act = NonmanualAct::new(part, *code);
            if n % 3 == 2 {
                (act.amount, act.speed) = (Some(0.6), Some(1.7));
            }
            let mut sign = notated(HandsUsed::Dominant, flat_hand_posture(None), vec![]);
            sign.nonmanual.push_act_group(part.sigml_tier(), vec![act]);
            let spans = std::slice::from_ref(&span);
            let language = BodyLanguage::default_body_language();
            let (bents, busy) = notation_nonmanual::written_body_bends(&[&sign], spans, language, 50.0, 160);
            put(&mut out, format!("## {part:?} {code}"));
            for frame in [40, 46, 55, 70, 83, 97, 115, 128, 133, 150] {
                put(&mut out, format!("{frame}: {:?} {:?}", bents[frame], busy[frame]));
            }
        }
    }
    compare("acts", &out);
}

fn describe_arm_posture(posed: &ArmPosture) -> String {
    format!(
        "shoulder {} elbow {} wrist {}",
        format_vector_list(posed.shoulder),
        format_vector_list(posed.elbow),
        format_vector_list(posed.wrist)
    )
}

#[test]
fn golden_arms_that_reach() {
    let mut out = String::new();
    let limits = ArmLimits::arm_limits_from_language(BodyLanguage::default_body_language());
    let heights: Vec<f64> = (-5..=5)
        .map(|n| limits.usual_elbow_depth(0.12 * f64::from(n)))
        .collect();
    put(&mut out, format!("below {heights:?}"));
    for axes in [Axes::Plain, Axes::Odd] {
        let body = StandingBody::body_from_material(&stage(axes)).expect("a body");
        for side in BodySide::BOTH_SIDES {
            let hand = body.hand_of_side(side).expect("a hand");
            let rig = &hand.rig;
            put(
                &mut out,
                format!("## {axes:?} {} {:?}", side.body_side_name(), rig.rig_arm_length()),
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
                let wrist = DVec3::new(side.side_sign() * at[0], at[1], at[2]);
                let n = n as f64;
                let bearing = ArmBearing {
                    plane: 0.25 * (n - 3.0),
                    shrug: 0.3 * (n % 3.0) - 0.3,
                };
                let posed = rig.reach_wrist_position(wrist, bearing, &limits);
                put(
                    &mut out,
                    format!("{}: {}", format_vector_list(wrist), describe_arm_posture(&posed)),
                );
                let angles = WristAngles {
                    flexion: 0.2 * n - 0.5,
                    deviation: 0.1 - 0.05 * n,
                    turn: 0.3 * n - 1.0,
                };
                let hand_hold = hand.held_hand_directions();
                let turned = rig.hand_rotation_from_angles(&posed, &angles, &hand_hold);
                let reached_wrist = rig.wrist_angles(&posed, turned, &hand_hold);
                put(
                    &mut out,
                    format!(
                        "  hand {} {} {reached_wrist:?}",
                        format_vector_list(turned * hand.along),
                        format_vector_list(turned * hand.palm)
                    ),
                );
                // The rotations of the joints give the same arm.
                let (back, there) = rig.posture_from_rotations(rig.arm_joint_rotations(&posed, turned));
                assert!(back.elbow.distance(posed.elbow) < 1e-6, "{at:?}");
                assert!(there.angle_between(turned) < 1e-6, "{at:?}");
                let other = rig.move_posed_wrist(&posed, wrist + DVec3::new(0.02, -0.03, 0.01), 0.2);
                put(&mut out, format!("  moved {}", describe_arm_posture(&other)));
            }
        }
    }
    compare("arms", &out);
}
