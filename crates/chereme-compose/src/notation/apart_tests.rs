//! Tests of two hands beside each other, and of paths that would lead through the trunk or be lost in a turn.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyPart, BodySide, ModelPose};
use chereme_sign::hamnosys::{
    BodyLanguage, BodyLocation, HandClass, HandConstellation, HandPlace, HandsUsed, MotionKind, NotatedMotion,
    NotatedPosture, NotatedSign, PlaceContact, WristMotion, from_names, parse_hamnosys,
};

use super::notation_stage::StandingBody;
use super::skull::SkullEllipsoid;
use super::tests::{at, directed, mirrored, notated, posture, stage};
use super::*;
use crate::NoteSubject;
use crate::testing::Axes;

/// Animates a sign, given by the names of its symbols, on a body that does not sway.
fn made(names: &str) -> GeneratedMovement {
    let text = from_names(names.split(' ')).expect("names of symbols");
    animated(&NotatedSign {
        sign: parse_hamnosys(&text).expect("HamNoSys").sign,
        ..NotatedSign::default()
    })
}

/// Animates a sign on a body that does not sway.
fn animated(sign: &NotatedSign) -> GeneratedMovement {
    let settings = AnimatorSettings {
        language: BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    };
    animate_signs(&[sign], &stage(Axes::Plain), &settings).expect("it can be animated")
}

/// Returns the postures from the sign's first to its last.
fn postures(made: &GeneratedMovement) -> Vec<ModelPose> {
    let gloss = made.notes.iter().find(|note| note.about == NoteSubject::Gloss);
    let span = gloss.expect("the gloss is noted").span;
    let rate = made.clip.clip_frame_rate();
    let frames = rate.nearest_frame_at(span.span_start_instant())..rate.nearest_frame_at(span.span_end_instant());
    frames.map(|frame| made.clip.model_pose(frame)).collect()
}

/// Returns the least distance (m) of a hand's joints from the signer's middle, to its own side.
fn own_side(made: &GeneratedMovement, side: BodySide) -> f64 {
    let body = StandingBody::body_from_material(&stage(Axes::Plain)).expect("a body");
    let outwards = body.left * side.side_sign();
    let joints = made.anatomy.finger_joints(side);
    let postures = postures(made);
    let all = postures.iter().flat_map(|model| {
        let at = joints.iter().map(|joint| model.model_joint_position(*joint));
        at.map(|at| (at - body.shoulder_middle()).dot(outwards))
    });
    all.fold(f64::INFINITY, f64::min)
}

#[test]
fn two_unlike_hands_at_one_place_are_beside_each_other() {
    let made = made(
        "hamparbegin hamflathand hamextfingero hampalml hamplus hamflathand hamextfingero hampalmu hamparend \
         hamchest hammoved",
    );
    for side in BodySide::BOTH_SIDES {
        let own = own_side(&made, side);
        assert!(own > 0.01, "{side:?}: {own} m");
    }
}

#[test]
fn circles_of_hands_that_are_together_begin_at_each_other() {
    for axis in ["hamcircleo", "hamcirclei", "hamcircleu", "hamcircled"] {
        let made = made(&format!(
            "hamsymmlr hamfinger2 hamextfingeruo hampalmd hamparbegin hamindexfinger hamfingertip hamplus \
             hamindexfinger hamfingertip hamparend hamclose {axis}"
        ));
        for side in BodySide::BOTH_SIDES {
            let least = own_side(&made, side);
            assert!(least > -0.005, "{axis}, {side:?}: {least} m");
        }
        let said = &made.report.warnings;
        let met = said.iter().any(|said| said.contains("go through each other"));
        assert!(!met, "{axis}: {said:?}");
    }
}

#[test]
fn mirrored_fists_lie_beside_each_other_on_the_chest() {
    let made = made("hamsymmlr hamfist hamextfingerl hampalmd hamchest hamtouch hamnomotion");
    for side in BodySide::BOTH_SIDES {
        let least = own_side(&made, side);
        assert!(least > 0.0, "{side:?}: {least} m");
    }
    let said = &made.report.warnings;
    let amiss = |said: &&String| said.contains("deep in each other") || said.contains("short of");
    assert!(!said.iter().any(|said| amiss(&said)), "{said:?}");
}

#[test]
fn palms_that_touch_each_other_stay_together_while_they_move() {
    let made = made(
        "hamsymmlr hamflathand hamextfingeru hampalml hamparbegin hampalm hamplus hampalm hamparend hamtouch \
         hammovedo hamsmallmod hamrepeatfromstart",
    );
    let apart = postures(&made).into_iter().map(|model| {
        let [right, left] = BodySide::BOTH_SIDES.map(|side| {
            let tip = format!("{}-middle-tip", side.body_side_name());
            let skeleton = made.clip.clip_skeleton();
            made.anatomy
                .landmark_place_position(skeleton, &model, &tip)
                .expect("a tip")
        });
        right.distance(left)
    });
    // Tips lean apart a little where the wrists reach their limits.
    let most = apart.fold(0.0, f64::max);
    assert!(most < 0.04, "{most} m");
}

#[test]
fn forearms_in_each_other_are_reported() {
    let arm = StandingBody::body_from_material(&stage(Axes::Plain))
        .expect("a body")
        .arm;
    let wrists = "hamparbegin hamwristback hampalm hamplus hamwristback hampalm hamparend hamcross";
    let mut reported = 0;
    for names in [
        format!("hamsymmlr hamfist hamextfingerul hampalmd {wrists}"),
        format!("hamsymmlr hamflathand hamextfingerul hampalml {wrists}"),
        "hamsymmlr hamflathand hamextfingero hampalmd hamchest hammoveo".to_owned(),
        "hamsymmlr hamfist hamextfingeru hampalml hamshoulders hammoved".to_owned(),
    ] {
        let made = made(&names);
        let frames = 0..made.clip.clip_frame_count();
        let forearms = frames.map(|frame| {
            let model = made.clip.model_pose(frame);
            BodySide::BOTH_SIDES.map(|side| {
                let arm = made.anatomy.arm_chain(side).expect("an arm");
                [arm.forearm, arm.hand].map(|joint| model.model_joint_position(joint))
            })
        });
        // Points on each forearm: the wrist itself belongs to the hand.
        let points = |[elbow, wrist]: [DVec3; 2]| (0..18).map(move |n| elbow.lerp(wrist, 0.05 * f64::from(n)));
        let gaps = forearms.map(|[right, left]| {
            let pairs = points(right).flat_map(|a| points(left).map(move |b| a.distance(b)));
            pairs.fold(f64::INFINITY, f64::min)
        });
        let least = gaps.fold(f64::INFINITY, f64::min);
        let said = made.report.warnings.iter().any(|said| said.contains("forearms remain"));
        // Forearms are a seventh or an eighth as thick as an arm is long, and give way by 2 cm.
        assert!(!said || least < arm / 7.0 - 0.02, "{names}: {least} m apart");
        assert!(said || least > arm / 8.0 - 0.02, "{names}: {least} m apart");
        reported += usize::from(said);
    }
    assert!((1..3).contains(&reported), "{reported}");
}

#[test]
fn a_hand_without_movement_does_not_follow_the_other_to_its_place() {
    let leads = NotatedMotion::new(MotionKind::Split(Some(Box::new(directed("ui"))), None));
    let target = NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(leads)),
        posture: Box::new(NotatedPosture {
            place: Some(at(BodyLocation::Lips, Some(PlaceContact::Touch))),
            ..NotatedPosture::default()
        }),
    });
    let chest = Some(at(BodyLocation::Chest, None));
    let sign = notated(mirrored(), posture(HandClass::Flat, "ol", "l", chest), vec![target]);
    let made = animated(&sign);
    let postures = postures(&made);
    let far = BodySide::BOTH_SIDES.map(|side| {
        let hand = made.anatomy.part_joint(BodyPart::Hand(side)).expect("a hand");
        let [first, last] = [postures.first(), postures.last()];
        first
            .expect("some")
            .model_joint_position(hand)
            .distance(last.expect("some").model_joint_position(hand))
    });
    let [right, left] = far;
    assert!(right > 0.1 && left < 0.01, "{far:?} m");
}

#[test]
fn a_big_level_circle_stays_before_the_trunk_as_a_whole() {
    for start in ["hamclocku", "hamclockr", "hamclockd", "hamclockl"] {
        let made = made(&format!(
            "hamflathand hamextfingerol hampalmd hamchest hamclose hamcircled hamlargemod {start}"
        ));
        let said = made.report.warnings.iter();
        let pushed = said.filter_map(|said| {
            let (_, rest) = said.split_once("was moved ")?;
            rest.split_once(" cm out of the trunk")?.0.parse::<f64>().ok()
        });
        let most = pushed.fold(0.0, f64::max);
        assert!(most < 3.0, "{start}: {most} cm");
    }
}

#[test]
fn a_turn_of_the_hand_does_not_consume_the_path_of_the_wrist() {
    let made = made(
        "hamflathand hamextfingerui hampalmu hamear hamclose hamparbegin hammoveo hamlargemod hamreplace \
         hamextfingero hampalmd hamparend",
    );
    let hand = made
        .anatomy
        .part_joint(BodyPart::Hand(BodySide::Right))
        .expect("a hand");
    let postures = postures(&made);
    let [first, last] = [postures.first(), postures.last()].map(|model| {
        let model = model.expect("some");
        model.model_joint_position(hand)
    });
    let far = first.distance(last);
    assert!(far > 0.12, "{far} m");
}

#[test]
fn fingers_that_play_in_a_pinch_stay_closed() {
    for shape in ["hampinch12", "hampinchall"] {
        let made = made(&format!("{shape} hamextfingero hampalmu hamchest hamfingerplay"));
        let tip = |model: &ModelPose, digit: &str| {
            let skeleton = made.clip.clip_skeleton();
            let name = format!("right-{digit}-tip");
            made.anatomy
                .landmark_place_position(skeleton, model, &name)
                .expect("a tip")
        };
        let gaps: Vec<f64> = postures(&made)
            .iter()
            .map(|model| tip(model, "thumb").distance(tip(model, "index")))
            .collect();
        let most = gaps.iter().copied().fold(0.0, f64::max);
        assert!(most - gaps[0] < 0.006, "{shape}: {} to {most} m", gaps[0]);
    }
}

#[test]
fn two_hands_close_to_each_other_stay_so_at_the_body() {
    let shoulders = || at(BodyLocation::Shoulders, None);
    let near = HandPlace::Hands(HandConstellation {
        contact: Some(PlaceContact::Close),
        at: match shoulders() {
            HandPlace::Body(place) => Some(place),
            _ => None,
        },
        ..HandConstellation::default()
    });
    let target = |place: HandPlace| {
        NotatedMotion::new(MotionKind::Target {
            motion: Some(Box::new(directed("i"))),
            posture: Box::new(NotatedPosture {
                place: Some(place),
                ..NotatedPosture::default()
            }),
        })
    };
    let apart = |first: HandPlace, place: HandPlace| {
        let begun = posture(HandClass::Flat, "u", "l", Some(first));
        let made = animated(&notated(mirrored(), begun, vec![target(place)]));
        let last = postures(&made).pop().expect("some");
        let [right, left] = BodySide::BOTH_SIDES.map(|side| {
            let hand = made.anatomy.part_joint(BodyPart::Hand(side)).expect("a hand");
            last.model_joint_position(hand)
        });
        right.distance(left)
    };
    let chest = at(BodyLocation::Chest, Some(PlaceContact::Close));
    let kept = apart(near, chest.clone());
    let own = apart(shoulders(), chest);
    assert!(kept < own - 0.05, "{kept} m of {own} m");
}

#[test]
fn fingers_go_round_the_head_unless_they_touch_it() {
    let inwards = || vec![directed("i")];
    for (contact, actions, most) in [
        (PlaceContact::Close, inwards(), 0.012),
        (PlaceContact::Touch, vec![], 0.1),
    ] {
        let sign = notated(
            HandsUsed::Dominant,
            posture(HandClass::Flat, "i", "l", Some(at(BodyLocation::Nose, Some(contact)))),
            actions,
        );
        let made = animated(&sign);
        let deep = postures(&made).into_iter().map(|model| {
            let skeleton = made.clip.clip_skeleton();
            let skull = SkullEllipsoid::skull_from_posture(&made.anatomy, skeleton, &model).expect("a head");
            let tip = made
                .anatomy
                .landmark_place_position(skeleton, &model, "right-middle-tip")
                .expect("a tip");
            skull.offset_out_of_skull(tip).length()
        });
        let deep = deep.fold(0.0, f64::max);
        let said = &made.report.warnings;
        let reported = said.iter().any(|said| said.contains("through the head"));
        assert!(deep < most, "{deep} m, {said:?}");
        assert_eq!(reported, contact == PlaceContact::Close, "{said:?}");
    }
}

#[test]
fn a_hand_that_nods_at_the_skin_leaves_it_and_returns() {
    let nods = |contact: PlaceContact| {
        let sign = notated(
            HandsUsed::Dominant,
            posture(HandClass::Flat, "ul", "r", Some(at(BodyLocation::Chest, Some(contact)))),
            vec![NotatedMotion::new(MotionKind::Wrist {
                motion: WristMotion::Nodding,
                size: None,
            })],
        );
        let made = animated(&sign);
        let ahead = postures(&made).into_iter().map(|model| {
            let tip = made
                .anatomy
                .landmark_place_position(made.clip.clip_skeleton(), &model, "right-middle-tip")
                .expect("a tip");
            let frame = made.anatomy.body_frame(&model).expect("a body");
            (tip - frame.origin).dot(frame.forward)
        });
        let all: Vec<f64> = ahead.collect();
        let first = all[0];
        let [least, most] = [f64::min, f64::max].map(|pick| all.iter().map(|at| at - first).fold(0.0, pick));
        [least, most]
    };
    let [least, most] = nods(PlaceContact::Touch);
    assert!(least > -0.01 && most > 0.03, "{least} to {most} m");
    let [least, most] = nods(PlaceContact::ArmExtended);
    assert!(least < -0.02 && most > 0.02, "{least} to {most} m");
}

#[test]
fn a_resting_hand_does_not_take_the_posture_of_the_hand_that_comes_to_it() {
    use chereme_sign::hamnosys::{EachHand, HandLocation, HandSite};
    let chest = || Some(Box::new(at(BodyLocation::Chest, None)));
    let begun = NotatedPosture {
        place: Some(HandPlace::Split(chest(), chest())),
        ..NotatedPosture::default()
    };
    let shape = |class: HandClass| posture(class, "ol", "d", None);
    let [flat, fist] = [HandClass::Flat, HandClass::Fist].map(shape);
    let begun = NotatedPosture {
        shape: EachHand::Split(
            flat.shape.dominant_value().cloned(),
            fist.shape.dominant_value().cloned(),
        ),
        extended: flat.extended.clone(),
        palm: flat.palm.clone(),
        ..begun
    };
    let comes = NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(directed("l"))),
        posture: Box::new(NotatedPosture {
            place: Some(HandPlace::Hand(HandSite {
                at: Some(HandLocation::WristBack),
                contact: Some(PlaceContact::Close),
                ..HandSite::default()
            })),
            ..flat
        }),
    });
    let alone = NotatedMotion::new(MotionKind::Split(Some(Box::new(comes)), None));
    let made = animated(&notated(mirrored(), begun, vec![alone]));
    let postures = postures(&made);
    let bent = |model: &ModelPose| {
        let joint = made
            .anatomy
            .part_joint(BodyPart::Finger(BodySide::Left, chereme_motion::HandFinger::Middle, 2))
            .expect("a finger");
        let hand = made.anatomy.part_joint(BodyPart::Hand(BodySide::Left)).expect("a hand");
        model
            .model_joint_rotation(joint)
            .angle_between(model.model_joint_rotation(hand))
    };
    let [first, last] = [postures.first(), postures.last()].map(|it| bent(it.expect("some")));
    assert!(first > 1.5 && (first - last).abs() < 0.01, "{first} {last}");
}
