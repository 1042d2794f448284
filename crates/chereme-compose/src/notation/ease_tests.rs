//! Tests that arms and heads move within what is comfortable: elbows, wrists, shakes of the head.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyPart, BodySide};
use chereme_sign::hamnosys::{
    BodyLanguage, BodyLocation, BodyPlace, DigitList, HandClass, HandConstellation, HandDigit, HandLocation, HandPlace,
    HandSite, HandsUsed, MotionKind, NonmanualAct, NonmanualPart, NotatedMotion, NotatedPosture, PlaceContact,
    SidedLocation, WristMotion,
};

use super::tests::{at, directed, mirrored, model, notated, posture, stage};
use super::*;
use crate::testing::Axes;

/// Animates a sign on a body that does not sway.
fn still(sign: &NotatedSign) -> GeneratedMovement {
    let settings = AnimatorSettings {
        language: BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    };
    animate_signs(&[sign], &stage(Axes::Plain), &settings).expect("it can be animated")
}

/// Returns the positions of shoulder, elbow and wrist of the right arm at a share of the sign.
fn arm(made: &GeneratedMovement, share: f64) -> [DVec3; 3] {
    let chain = made.anatomy.arm_chain(BodySide::Right).expect("an arm");
    let model = model(made, share);
    [chain.upper, chain.forearm, chain.hand].map(|joint| model.model_joint_position(joint))
}

/// Returns the direction of a hand at a share of the sign.
fn along(made: &GeneratedMovement, side: BodySide, share: f64) -> DVec3 {
    let model = model(made, share);
    made.anatomy.hand_direction(side, &model).expect("a direction")
}

/// Returns the touch of a place in the middle of the body by a part of the hand.
fn touched(location: BodyLocation, by: Option<HandSite>) -> HandPlace {
    match at(location, Some(PlaceContact::Touch)) {
        HandPlace::Body(place) => HandPlace::Body(BodyPlace { by, ..place }),
        other => other,
    }
}

fn placed(location: BodyLocation, side: chereme_sign::hamnosys::LocationSide) -> HandPlace {
    HandPlace::Body(BodyPlace {
        site: Some(SidedLocation {
            at: location,
            side: Some(side),
            approx: false,
        }),
        contact: Some(PlaceContact::Close),
        ..BodyPlace::default()
    })
}

#[test]
fn an_elbow_stays_beside_the_trunk_if_its_hand_points_away_close_to_the_chest() {
    let beside = chereme_sign::hamnosys::LocationSide::RightBeside;
    for palm in ["d", "l", "ul"] {
        let place = Some(placed(BodyLocation::Chest, beside));
        let made = still(&notated(mirrored(), posture(HandClass::Flat, "o", palm, place), vec![]));
        let [shoulder, elbow, _] = arm(&made, 0.5);
        let behind = shoulder.z - elbow.z;
        assert!(behind < 0.05, "{palm}: {behind} m");
    }
}

#[test]
fn an_elbow_goes_out_rather_than_the_wrist_to_its_limit() {
    let place = Some(at(BodyLocation::Shoulders, None));
    let made = still(&notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "l", "dl", place),
        vec![],
    ));
    let [_, elbow, wrist] = arm(&made, 0.5);
    let bent = along(&made, BodySide::Right, 0.5).angle_between(wrist - elbow);
    assert!(bent.to_degrees() < 56.0, "{}", bent.to_degrees());
}

#[test]
fn a_hand_close_to_the_head_is_before_the_face_and_not_beside_the_ear() {
    let place = placed(BodyLocation::Head, chereme_sign::hamnosys::LocationSide::RightAt);
    let made = still(&notated(
        HandsUsed::Dominant,
        posture(HandClass::Fist, "u", "d", Some(place)),
        vec![],
    ));
    let model = model(&made, 0.5);
    let skeleton = made.clip.clip_skeleton();
    let point = |name: &str| {
        let found = made.anatomy.landmark_place_position(skeleton, &model, name);
        found.expect("a landmark")
    };
    let (palm, brows) = (point("right-palm"), point("eyebrows"));
    assert!(palm.z > brows.z + 0.08, "{palm} {brows}");
    assert!((palm.y - brows.y).abs() < 0.03, "{palm} {brows}");
    assert!(palm.x < -0.08, "on the right: {palm}");
}

#[test]
fn a_hand_that_only_turns_leaves_its_wrist_where_it_is() {
    let turned = NotatedMotion::new(MotionKind::Target {
        motion: None,
        posture: Box::new(NotatedPosture {
            place: None,
            ..posture(HandClass::Flat, "uo", "l", None)
        }),
    });
    let made = still(&notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "u", "l", Some(at(BodyLocation::Shoulders, None))),
        vec![turned],
    ));
    let [before, after] = [0.0, 1.0].map(|share| arm(&made, share)[2]);
    assert!(before.distance(after) < 0.015, "{before} {after}");
    let turned = [0.0, 1.0].map(|share| along(&made, BodySide::Right, share));
    assert!(turned[0].angle_between(turned[1]) > 0.5);
}

/// Returns a straight path and what happens at its end.
fn to(direction: &str, then: NotatedPosture) -> NotatedMotion {
    NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(directed(direction))),
        posture: Box::new(then),
    })
}

/// Returns a part of a hand: the tip of the index finger, or a side.
fn part(location: HandLocation, digit: Option<HandDigit>) -> HandSite {
    HandSite {
        at: Some(location),
        digits: DigitList(digit.into_iter().collect()),
        ..HandSite::default()
    }
}

#[test]
fn hands_that_meet_with_other_parts_than_before_stay_where_they_are() {
    let tip = part(HandLocation::Tip, Some(HandDigit::Index));
    let forehead = touched(BodyLocation::Forehead, Some(tip));
    let side = part(HandLocation::PinkySide, None);
    let together = HandConstellation {
        dominant: Some(side.clone()),
        other: Some(side),
        contact: Some(PlaceContact::Touch),
        ..HandConstellation::default()
    };
    let meet = NotatedPosture {
        place: Some(HandPlace::Hands(together)),
        ..NotatedPosture::default()
    };
    let made = still(&notated(
        mirrored(),
        posture(HandClass::Flat, "u", "l", Some(forehead)),
        vec![to("o", meet)],
    ));
    let [before, after] = [0.0, 1.0].map(|share| arm(&made, share)[2].y);
    assert!((after - before).abs() < 0.05, "{before} {after}");
}

#[test]
fn a_hand_that_tips_while_it_leaves_the_skin_takes_its_wrist_along() {
    let tip = part(HandLocation::Tip, Some(HandDigit::Middle));
    let chin = touched(BodyLocation::Chin, Some(tip));
    let tipped = NotatedMotion::new(MotionKind::Target {
        motion: None,
        posture: Box::new(NotatedPosture {
            place: None,
            ..posture(HandClass::Flat, "uo", "u", None)
        }),
    });
    let away = MotionKind::Parallel(vec![directed("o"), tipped]);
    let made = still(&notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "u", "u", Some(chin)),
        vec![NotatedMotion::new(away)],
    ));
    let [before, after] = [0.0, 1.0].map(|share| arm(&made, share)[2].z);
    assert!(after > before + 0.04, "{before} {after}");
}

#[test]
fn a_hand_that_moves_to_touch_the_head_starts_on_the_side_from_which_it_comes() {
    let eyes = |contact| {
        HandPlace::Body(BodyPlace {
            site: Some(SidedLocation {
                at: BodyLocation::Eyes,
                side: Some(chereme_sign::hamnosys::LocationSide::RightAt),
                approx: false,
            }),
            contact: Some(contact),
            by: Some(part(HandLocation::Tip, Some(HandDigit::Index))),
            ..BodyPlace::default()
        })
    };
    let touch = NotatedPosture {
        place: Some(eyes(PlaceContact::Touch)),
        ..NotatedPosture::default()
    };
    let made = still(&notated(
        HandsUsed::Dominant,
        posture(HandClass::Finger2, "u", "l", Some(eyes(PlaceContact::Close))),
        vec![to("l", touch)],
    ));
    let [before, after] = [0.0, 1.0].map(|share| arm(&made, share)[2].x);
    assert!(after > before + 0.03, "to the left: {before} {after}");
}

#[test]
fn a_hand_that_moves_down_to_the_other_one_starts_above_it() {
    let palm = part(HandLocation::Palm, None);
    let near = |contact| {
        Some(HandPlace::Hands(HandConstellation {
            dominant: Some(palm.clone()),
            other: Some(palm.clone()),
            contact: Some(contact),
            ..HandConstellation::default()
        }))
    };
    let touch = NotatedPosture {
        place: near(PlaceContact::Touch),
        ..NotatedPosture::default()
    };
    for (direction, axis) in [("d", DVec3::NEG_Y), ("o", DVec3::Z), ("l", DVec3::X)] {
        let made = still(&notated(
            HandsUsed::Dominant,
            posture(HandClass::Flat, "ol", "l", near(PlaceContact::Close)),
            vec![to(direction, touch.clone())],
        ));
        let [before, after] = [0.0, 1.0].map(|share| arm(&made, share)[2]);
        let along = (after - before).dot(axis);
        assert!(along > 0.03, "{direction}: {along} m");
    }
}

#[test]
fn hands_that_nod_in_turn_nod_to_opposite_sides() {
    let mut nod = NotatedMotion::new(MotionKind::Wrist {
        motion: WristMotion::Nodding,
        size: None,
    });
    nod.manner.alternating = true;
    let chest = Some(at(BodyLocation::Chest, None));
    let sign = notated(mirrored(), posture(HandClass::Flat, "o", "d", chest), vec![nod]);
    let made = still(&sign);
    let heights = |side: BodySide| -> Vec<f64> {
        let shares = (0..60).map(|n| f64::from(n) / 60.0);
        shares.map(|share| along(&made, side, share).y).collect()
    };
    let [right, left] = BodySide::BOTH_SIDES.map(heights);
    let spread =
        |all: &[f64]| all.iter().fold(f64::MIN, |a, b| a.max(*b)) - all.iter().fold(f64::MAX, |a, b| a.min(*b));
    assert!(spread(&right) > 0.2 && spread(&left) > 0.2);
    let sum: Vec<f64> = right.iter().zip(&left).map(|(a, b)| a + b).collect();
    assert!(spread(&sum) < 0.4 * spread(&right), "{}", spread(&sum));
}

#[test]
fn three_shakes_in_one_moment_are_three_shakes_and_no_whip() {
    let mut sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "ol", "d", Some(at(BodyLocation::Chest, None))),
        vec![],
    );
    let part = NonmanualPart::Head;
    let shake = || NonmanualAct::new(part, "SH");
    sign.nonmanual
        .push_act_group(part.sigml_tier(), vec![shake(), shake(), shake()]);
    let made = still(&sign);
    let head = made.anatomy.part_joint(BodyPart::Head).expect("a head");
    let first = made.clip.model_pose(0).model_joint_rotation(head);
    let turned: Vec<f64> = (0..made.clip.clip_frame_count())
        .map(|frame| {
            let now = made.clip.model_pose(frame).model_joint_rotation(head);
            (now * first.inverse()).to_scaled_axis().y.to_degrees()
        })
        .collect();
    let fastest = turned.windows(2).map(|two| (two[1] - two[0]).abs() * 60.0);
    let fastest = fastest.fold(0.0, f64::max);
    assert!((100.0..300.0).contains(&fastest), "{fastest} degrees a second");
    let farthest = turned.iter().fold(0.0_f64, |most, angle| most.max(angle.abs()));
    assert!((10.0..17.0).contains(&farthest), "{farthest} degrees");
    let sides: Vec<bool> = turned
        .iter()
        .filter(|angle| angle.abs() > 4.0)
        .map(|angle| *angle > 0.0)
        .collect();
    let changes = sides.windows(2).filter(|two| two[0] != two[1]).count();
    assert_eq!(changes, 5, "three shakes");
}
