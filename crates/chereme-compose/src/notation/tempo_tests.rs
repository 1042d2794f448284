//! Tests of the tempo of movement from notation: limits of speed, and motions that are written as fast.

use chereme_sign::hamnosys::{
    BodyLocation, DirectionAim, EachHand, HandClass, HandsUsed, MotionKind, NonmanualAct, NonmanualPart, NotatedMotion,
    NotatedPosture, PlaceContact,
};
use chereme_sign::{ComponentReading, SignComponent};

use super::tests::{at, directed, notated, posture, stage};
use super::*;
use crate::NoteSubject;
use crate::testing::Axes;

fn fastest(made: &GeneratedMovement) -> [f64; 2] {
    let rate = made.clip.clip_frame_rate().per_second();
    let mut fastest = [0.0_f64; 2];
    for frame in 1..made.clip.clip_frame_count() {
        let [a, b] = [frame - 1, frame].map(|frame| made.clip.model_pose(frame));
        for side in BodySide::BOTH_SIDES {
            let arm = made.anatomy.arm_chain(side).expect("an arm");
            let distance = a
                .model_joint_position(arm.hand)
                .distance(b.model_joint_position(arm.hand));
            fastest[0] = fastest[0].max(distance * rate);
            for joint in [arm.upper, arm.forearm, arm.hand] {
                let turn = a
                    .model_joint_rotation(joint)
                    .angle_between(b.model_joint_rotation(joint));
                fastest[1] = fastest[1].max(turn * rate);
            }
        }
    }
    fastest
}

#[test]
fn time_is_stretched_if_arms_would_move_too_fast() {
    let mut flip = directed("l");
    flip.manner.speed = Some(9.0);
    let other = posture(HandClass::Flat, "il", "u", None);
    let turn = NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(flip)),
        posture: Box::new(other),
    });
    let sign = notated(
        HandsUsed::Dominant,
        posture(
            HandClass::Flat,
            "or",
            "d",
            Some(at(BodyLocation::Stomach, Some(PlaceContact::Touch))),
        ),
        vec![turn],
    );
    for language in [None, Some((3.0, 9.0))] {
        let mut settings = AnimatorSettings::default();
        if let Some((wrist, joint)) = language {
            settings.language.speed_wrist = wrist;
            settings.language.speed_joint = joint;
        }
        let made = animate_signs(&[&sign], &stage(Axes::Odd), &settings).expect("it can be animated");
        let arm = made.anatomy.anatomy_measures().expect("measures").arm;
        let [wrist, joint] = fastest(&made);
        assert!(wrist <= settings.language.speed_wrist * arm, "{wrist} m/s");
        assert!(joint <= settings.language.speed_joint, "{joint} rad/s");
    }
}

#[test]
fn a_speed_of_a_whole_sign_out_of_range_is_reported() {
    let place = Some(at(BodyLocation::Chest, None));
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "ol", "d", place),
        vec![directed("o")],
    );
    for (speed, timescale, used) in [
        (Some(1e300), None, Some("10 times")),
        (Some(3.0), None, None),
        (Some(3.0), Some(2.0), None),
        (None, Some(1e300), Some("0.1 times")),
        (None, None, None),
    ] {
        let sign = NotatedSign {
            speed,
            timescale,
            ..sign.clone()
        };
        let made =
            animate_signs(&[&sign], &stage(Axes::Odd), &AnimatorSettings::default()).expect("it can be animated");
        let found = made.report.warnings.iter();
        let found: Vec<&String> = found.filter(|it| it.contains("another speed")).collect();
        assert_eq!(found.len(), usize::from(used.is_some()), "{found:?}");
        assert!(used.is_none_or(|used| found[0].contains(used)), "{found:?}");
    }
}

#[test]
fn a_sign_lasts_as_long_as_its_notation_says_or_reports_it() {
    let place = Some(at(BodyLocation::Chest, None));
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "ol", "d", place),
        vec![directed("o"), directed("i")],
    );
    let lasts = |sign: &NotatedSign| {
        let made = animate_signs(&[sign], &stage(Axes::Plain), &AnimatorSettings::default());
        let made = made.expect("it can be animated");
        let mut glosses = made.notes.iter().filter(|note| note.about == NoteSubject::Gloss);
        let warned = made.report.warnings.iter().any(|warning| warning.contains("asks for"));
        (glosses.next().expect("a sign").span.span_seconds(), warned)
    };
    let (usual, _) = lasts(&sign);
    // The attributes, the wanted duration, and whether it is out of reach.
    for (speed, timescale, duration, wanted, is_far) in [
        (Some(1.25), None, None, usual / 1.25, false),
        (Some(0.5), None, None, usual * 2.0, false),
        (None, Some(2.0), None, usual * 2.0, false),
        (None, None, Some(3.0), 3.0, false),
        (Some(0.5), None, Some(3.0), 3.0, false),
        (None, None, Some(f64::NAN), usual, false),
        (None, None, Some(0.01), 0.01, true),
    ] {
        let sign = NotatedSign {
            speed,
            timescale,
            duration,
            ..sign.clone()
        };
        let (lasts, warned) = lasts(&sign);
        assert_eq!(warned, is_far, "{speed:?} {timescale:?} {duration:?}: {lasts} s");
        assert!(is_far || (lasts / wanted - 1.0).abs() < 0.1, "{lasts} s, not {wanted}");
    }
}

#[test]
fn acts_that_the_animator_does_not_know_are_reported() {
    let mut sign = notated(HandsUsed::Dominant, NotatedPosture::default(), vec![]);
    for (part, tag) in [
        (NonmanualPart::Extra, "X01"),
        (NonmanualPart::Head, "QQ"),
        (NonmanualPart::Head, "NU"),
    ] {
        sign.nonmanual
            .push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, tag)]);
    }
    let made = animate_signs(&[&sign], &stage(Axes::Plain), &AnimatorSettings::default()).expect("animated");
    let reported = made.report.warnings.iter();
    let reported: Vec<_> = reported.filter(|warning| warning.contains("non-manuals")).collect();
    assert_eq!(reported.len(), 1);
    assert!(reported[0].ends_with(": extra.X01, head.QQ"), "{reported:?}");
}

#[test]
fn a_fast_path_stays_fast_beside_a_change_of_handshape_or_orientation() {
    let flat = posture(HandClass::Flat, "ol", "d", Some(at(BodyLocation::Chest, None)));
    let changes = [
        NotatedPosture {
            shape: posture(HandClass::Fist, "ol", "d", None).shape,
            ..NotatedPosture::default()
        },
        NotatedPosture {
            extended: EachHand::Shared(DirectionAim::aim_at("ul".parse().expect("a direction"))),
            ..NotatedPosture::default()
        },
    ];
    for change in changes {
        let lasts = |fast: bool| {
            let mut path = directed("o");
            path.manner.fast = fast;
            let change = NotatedMotion::new(MotionKind::Target {
                motion: None,
                posture: Box::new(change.clone()),
            });
            let both = NotatedMotion::new(MotionKind::Parallel(vec![path, change]));
            let sign = notated(HandsUsed::Dominant, flat.clone(), vec![both]);
            let made =
                animate_signs(&[&sign], &stage(Axes::Plain), &AnimatorSettings::default()).expect("it can be animated");
            let phase = NoteSubject::Component(SignComponent::Movement, Some("phase".into()));
            let stroke = |note: &&crate::GeneratedNote| {
                note.about == phase && note.value == ComponentReading::Value("stroke".into())
            };
            let strokes = made.notes.iter().filter(stroke);
            strokes.map(|note| note.span.span_seconds()).fold(0.0, f64::max)
        };
        let share = lasts(true) / lasts(false);
        assert!(share < 0.75, "{share} of the usual time");
    }
}
