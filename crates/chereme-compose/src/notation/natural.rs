//! Tests that synthesised movement looks natural.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Part, Side};
use chereme_sign::Handedness;
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::sites::{Face, HandPoint};
use chereme_sign::hamnosys::{
    Act, BodyLanguage, BodyLocation, Contact, Digit, Digits, HandClass, HandLocation, HandSite,
    HandsUsed, Handshape, Motion, MotionKind, NonmanualPart, Place, Posture, Size, ThumbPosition,
    Zigzag,
};

use super::plan::{Phase, PhaseKind, Planner};
use super::stage::Stage;
use super::tests::{at, directed, mirrored, model, notated, posture, stage};
use super::*;
use crate::outcome::About;
use crate::testing::Axes;

mod planned;
mod tables;

fn alive(sign: &Notated) -> Generated {
    animate(&[sign], &stage(Axes::Odd), &Settings::default()).expect("it can be animated")
}

fn phases(sign: &Notated) -> Vec<Phase> {
    let material = stage(Axes::Plain);
    let body = Stage::of(&material).expect("a body");
    let paces = pace::Paces::of(BodyLanguage::usual());
    let language = (BodyLanguage::usual(), &paces);
    let planner = Planner::new(&body, language, Handedness::Right, 60.0);
    planner.signs(&[sign]).phases
}

fn flat(place: Option<Place>) -> Posture {
    posture(HandClass::Flat, "ol", "d", place)
}

#[test]
fn a_thumb_across_lies_on_the_finger_or_palm_that_it_crosses() {
    let cases: [(HandClass, &[Digit], Digit); 6] = [
        (HandClass::Fist, &[], Digit::Middle),
        (HandClass::Finger2, &[], Digit::Middle),
        (HandClass::Finger2, &[Digit::Middle], Digit::Index),
        (HandClass::Finger2, &[Digit::Little], Digit::Middle),
        (HandClass::Finger23, &[], Digit::Ring),
        (HandClass::Finger23Spread, &[], Digit::Ring),
    ];
    let mut off_their_finger = Vec::new();
    for axes in [Axes::Plain, Axes::Odd] {
        let material = stage(axes);
        let body = Stage::of(&material).expect("a body");
        for side in Side::BOTH {
            let hand = body.hand(side).expect("a hand");
            let flesh = 0.042 * hand.length();
            let shaped = |shape: &Handshape| {
                let angles = hand_angles(shape, BodyLanguage::usual());
                thumb::posed(&body, side, shape, &angles)
            };
            let mut shape = Handshape::default();
            shape.form.thumb = Some(ThumbPosition::Across);
            for (class, special, on) in cases {
                shape.form.class = class;
                shape.special = Digits(special.to_vec());
                let posed = shaped(&shape);
                let point = |point| body.point(hand, &posed, point);
                let tip = point(HandPoint::Tip(Digit::Thumb, Face::Middle));
                let joint = point(HandPoint::Middle(Digit::Thumb, Face::Middle));
                let pad = tip - (tip - joint).normalize() * flesh;
                let near = point(HandPoint::Middle(on, Face::Middle));
                let far = body.last_joint(hand, &posed, on).expect("a joint");
                let share = (pad - near).dot(far - near) / near.distance_squared(far);
                let off = pad - near.lerp(far, share.clamp(0.0, 1.0));
                let gap = off.length() - 2.0 * flesh;
                // This hand's thumb is short: it comes no nearer to the ring finger than 3.1 mm.
                if gap.abs() > 3.2e-3 {
                    off_their_finger.push((class, special, gap * 1e3, posed.angles.thumb));
                }
                assert!(
                    off.dot(hand.palm) > 0.0,
                    "{class:?}: in front of the finger"
                );
            }
            shape.form.class = HandClass::Flat;
            shape.special = Digits::default();
            let posed = shaped(&shape);
            let tip = body.point(hand, &posed, HandPoint::Tip(Digit::Thumb, Face::Middle));
            let base = body.point(hand, &posed, HandPoint::Base(Digit::Middle, Face::Middle));
            assert!(tip.dot(hand.radial) < base.dot(hand.radial) + 3e-3);
            let height = tip.dot(hand.palm) / hand.length();
            assert!((0.09..0.14).contains(&height), "on the palm: {height}");
        }
    }
    assert!(off_their_finger.is_empty(), "{off_their_finger:#?}");
}

#[test]
fn an_approach_is_no_faster_than_the_stroke_it_leads_to() {
    for size in [None, Some(Size::Big)] {
        let mut up = directed("u");
        if let MotionKind::Directed(directed) = &mut up.kind {
            directed.size.first = size;
        }
        let sign = notated(
            HandsUsed::Dominant,
            flat(Some(at(BodyLocation::Chest, None))),
            vec![up],
        );
        let made = alive(&sign);
        let hand = made.anatomy.joint(Part::Hand(Side::Right)).expect("a hand");
        let top = |phase: &Phase| {
            let frames = (phase.from * 60.0) as usize..(phase.to * 60.0) as usize;
            let at = |frame: usize| made.clip.model_pose(frame).position(hand);
            let steps = frames.map(|frame| at(frame).distance(at(frame + 1)) * 60.0);
            steps.fold(0.0, f64::max)
        };
        let phases = phases(&sign);
        let of = |kind: PhaseKind| phases.iter().find(|phase| phase.kind == kind);
        let approach = top(of(PhaseKind::Transition).expect("an approach"));
        let stroke = top(of(PhaseKind::Stroke).expect("a stroke"));
        assert!(approach < 1.1 * stroke, "{size:?}: {approach} {stroke}");
    }
}

#[test]
fn a_body_sways_and_blinks_and_can_be_kept_still() {
    let sign = notated(
        HandsUsed::Dominant,
        flat(Some(at(BodyLocation::Chest, None))),
        vec![directed("u")],
    );
    let turned = |made: &Generated, part: Part| {
        let joint = made.anatomy.joint(part).expect("a joint");
        let first = made.clip.model_pose(0).rotation(joint);
        let all = (0..made.clip.frames()).map(|frame| {
            let now = made.clip.model_pose(frame).rotation(joint);
            now.angle_between(first).to_degrees()
        });
        all.fold(0.0, f64::max)
    };
    let made = alive(&sign);
    for part in [Part::Chest, Part::Head] {
        let most = turned(&made, part);
        assert!((0.2..10.0).contains(&most), "{part:?}: {most}");
    }
    let lids = made.curves.iter().find(|curve| curve.name == "lids.CB");
    let lids = &lids.expect("blinks").values;
    assert_eq!(lids.len(), made.clip.frames());
    assert!(lids.iter().any(|lid| *lid > 0.9) && lids[0] == 0.0);
    assert_eq!(made, alive(&sign), "the same again");
    let still = Settings {
        language: BodyLanguage::usual().without_life(),
        ..Settings::default()
    };
    let still = animate(&[&sign], &stage(Axes::Odd), &still).expect("made");
    for part in [Part::Chest, Part::Head] {
        assert!(turned(&still, part) < 1e-6);
    }
    assert!(still.curves.is_empty());
}

#[test]
fn waves_go_to_and_fro_at_most_four_times_a_second() {
    for fast in [false, true] {
        let mut wave = directed("l");
        wave.manner.fast = fast;
        if let MotionKind::Directed(directed) = &mut wave.kind {
            directed.zigzag = Some(Zigzag {
                wavy: true,
                size: None,
                growth: None,
            });
        }
        let sign = notated(
            HandsUsed::Dominant,
            flat(Some(at(BodyLocation::Chest, None))),
            vec![wave],
        );
        let phases = phases(&sign);
        let stroke = phases.iter().find(|phase| phase.kind == PhaseKind::Stroke);
        let stroke = stroke.expect("a stroke");
        let rate = BodyLanguage::usual().zigzag_waves / (stroke.to - stroke.from);
        assert!((2.5..4.0 + 1e-9).contains(&rate), "{rate}");
    }
}

#[test]
fn a_movement_with_a_target_starts_in_its_direction_and_ends_there() {
    let goal = Posture {
        place: Some(at(BodyLocation::Chin, Some(Contact::Touch))),
        ..Posture::default()
    };
    let target = Motion::new(MotionKind::Target {
        motion: Some(Box::new(directed("l"))),
        posture: Box::new(goal),
    });
    let begin = posture(
        HandClass::Finger2,
        "u",
        "l",
        Some(at(BodyLocation::Stomach, None)),
    );
    let made = alive(&notated(HandsUsed::Dominant, begin, vec![target]));
    let tip = |share: f64| {
        let model = model(&made, share);
        let skeleton = made.clip.skeleton();
        made.anatomy
            .landmark(skeleton, &model, "right-index-tip")
            .expect("a fingertip")
    };
    let offsets = (1..50).map(|n| tip(0.02 * f64::from(n)) - tip(0.0));
    let early = offsets.into_iter().find(|offset| offset.length() > 0.03);
    let early = early.expect("it moves");
    assert!(early.x > early.y.abs(), "to the left: {early}");
    let model = model(&made, 0.9);
    let chin = made.anatomy.landmark(made.clip.skeleton(), &model, "chin");
    let off = chin.expect("a chin").distance(tip(0.9));
    // The nearest part of the finger touches, not its tip.
    assert!(off < 0.06, "{off}");
}

#[test]
fn a_hand_at_the_face_follows_the_head() {
    let touch = at(BodyLocation::Chin, Some(Contact::Touch));
    let mut sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Finger2, "ul", "l", Some(touch)),
        vec![],
    );
    let off = |made: &Generated| {
        let model = model(made, 0.5);
        let place = |name: &str| {
            let skeleton = made.clip.skeleton();
            made.anatomy
                .landmark(skeleton, &model, name)
                .expect("a landmark")
        };
        let head = made.anatomy.joint(Part::Head).expect("a head");
        let offset: DVec3 = place("right-index-tip") - place("chin");
        model.rotation(head).inverse() * offset
    };
    let straight = off(&alive(&sign));
    for tag in ["SL", "TR", "NF"] {
        sign.nonmanual.tiers.clear();
        let act = Act::new(NonmanualPart::Head, tag);
        sign.nonmanual.push(NonmanualPart::Head.tier(), vec![act]);
        let turned = off(&alive(&sign));
        let apart = turned.length() - straight.length();
        assert!(apart.abs() < 0.015, "{tag}: {apart}");
    }
}

#[test]
fn two_hands_do_not_merge() {
    let begin = posture(
        HandClass::Flat,
        "o",
        "d",
        Some(at(BodyLocation::Chest, None)),
    );
    let mut across = directed("l");
    if let MotionKind::Directed(directed) = &mut across.kind {
        directed.size.first = Some(Size::Small);
    }
    let made = alive(&notated(mirrored(), begin, vec![across.clone(), across]));
    let joints = |side: Side, frame: usize| {
        let model = made.clip.model_pose(frame);
        let digits = [1, 2].map(|n| Part::Finger(side, chereme_motion::Finger::Index, n));
        digits.map(|part| model.position(made.anatomy.joint(part).expect("a joint")))
    };
    let nearest = (0..made.clip.frames()).flat_map(|frame| {
        let [a, b] = Side::BOTH.map(|side| joints(side, frame));
        a.into_iter()
            .flat_map(move |a| b.into_iter().map(move |b| a.distance(b)))
    });
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.011, "{nearest}");
}

/// Returns the notated sign of HamNoSys symbol names.
fn symbols(names: &str) -> Notated {
    let text = chereme_sign::hamnosys::from_names(names.split(' ')).expect("names of symbols");
    Notated {
        sign: chereme_sign::hamnosys::parse(&text).expect("HamNoSys").sign,
        ..Notated::default()
    }
}

/// Returns the rotations of the right hand from the first stroke on, frame by frame, with the frame rate.
fn rotations(made: &Generated) -> Vec<DQuat> {
    let hand = made.anatomy.joint(Part::Hand(Side::Right)).expect("a hand");
    let gloss = made.notes.iter().find(|note| note.about == About::Gloss);
    let span = gloss.expect("a gloss").span;
    let rate = made.clip.rate();
    let frames = rate.frame_at(span.start())..rate.frame_at(span.end());
    frames
        .map(|frame| made.clip.model_pose(frame).rotation(hand))
        .collect()
}

/// Returns the positions of the right hand during the first stroke of a sign.
fn stroked(names: &str) -> Vec<DVec3> {
    let sign = symbols(names);
    let made = alive(&sign);
    let hand = made.anatomy.joint(Part::Hand(Side::Right)).expect("a hand");
    let phases = phases(&sign);
    let stroke = phases.iter().find(|phase| phase.kind == PhaseKind::Stroke);
    let stroke = stroke.expect("a stroke");
    let frames = (stroke.from * 60.0).round() as usize..=(stroke.to * 60.0).round() as usize;
    frames
        .map(|frame| made.clip.model_pose(frame).position(hand))
        .collect()
}

#[test]
fn an_arc_that_is_written_upwards_bends_upwards_whatever_its_direction() {
    for direction in ["o", "uo", "do", "i", "ui", "di", "il", "ir"] {
        for (arc, sign) in [("u", 1.0), ("d", -1.0)] {
            let path = stroked(&format!(
                "hamfist hamextfingerl hampalmd hamchest hammove{direction} hamarc{arc}"
            ));
            let chord = (path[path.len() - 1] - path[0]).normalize();
            let off = path
                .iter()
                .map(|at| (at - path[0]).reject_from_normalized(chord));
            let far = off.max_by(|a, b| a.length().total_cmp(&b.length()));
            let bend = far.expect("a path").y * sign;
            assert!(bend > 0.004, "{direction}, {arc}: {bend} m");
        }
    }
}

#[test]
fn a_circle_starts_above_whatever_its_axis() {
    for axis in ["o", "i", "il", "ol"] {
        let path = stroked(&format!(
            "hamfist hamextfingerl hampalmd hamchest hamcircle{axis}"
        ));
        let middle = path.iter().map(|at| at.y).sum::<f64>() / path.len() as f64;
        assert!(
            path[0].y > middle + 0.03,
            "{axis}: {} and {middle}",
            path[0].y
        );
    }
}

#[test]
fn an_upright_hand_that_leans_back_does_not_turn_over() {
    // The letter of the palm reads "away" before the vertical and "towards the signer" behind it.
    for (names, over) in [
        (
            "hamflathand hamextfingeru hampalmd hamshoulders hamlrat hamreplace hamextfingerui hampalmd",
            false,
        ),
        (
            "hamflathand hamextfingeru hampalmd hamshoulders hamlrat hamreplace hamextfingeru hampalmu",
            true,
        ),
    ] {
        let turned = rotations(&alive(&symbols(names)));
        let most = turned.iter().map(|at| at.angle_between(turned[0]));
        let most = most.fold(0.0, f64::max).to_degrees();
        assert_eq!(most > 100.0, over, "{names}: {most} degrees");
    }
}

#[test]
fn a_hand_that_turns_far_takes_time_to_turn() {
    let lasts = |palm: &str| {
        let names = "hamflathand hamextfingerl hampalmd hamchest hamreplace hamextfingerl";
        let strokes = phases(&symbols(&format!("{names} {palm}")));
        let mut strokes = strokes
            .iter()
            .filter(|phase| phase.kind == PhaseKind::Stroke);
        let stroke = strokes.next().expect("a stroke");
        stroke.to - stroke.from
    };
    let [quarter, half] = ["hampalml", "hampalmu"].map(lasts);
    assert!(
        (0.2..0.4).contains(&quarter),
        "{quarter} s for a right angle"
    );
    assert!((0.45..0.6).contains(&half), "{half} s for half a turn");
}

#[test]
fn an_elbow_stays_beside_the_trunk_while_its_hand_rises() {
    let sign = notated(
        HandsUsed::Dominant,
        flat(Some(at(BodyLocation::Chest, None))),
        vec![directed("u")],
    );
    let made = alive(&sign);
    let arm = made.anatomy.arm(Side::Right).expect("an arm");
    for frame in 0..made.clip.frames() {
        let model = made.clip.model_pose(frame);
        let body = made.anatomy.body_frame(&model).expect("a body");
        let upper = model.position(arm.forearm) - model.position(arm.upper);
        let back = -upper.dot(body.forward);
        assert!(back < 0.09, "frame {frame}: {back} m behind the shoulder");
    }
}

#[test]
fn what_is_clear_of_the_trunk_is_not_pushed_out_of_it() {
    let body = Stage::of(&stage(Axes::Odd)).expect("a body");
    let middle = body.middle();
    let mut clear = 0;
    for n in 0..4000 {
        let part = |by: usize| ((n * by) % 997) as f64 / 996.0 - 0.5;
        let at = middle + DVec3::new(part(31) * 1.2, part(57) * 1.6 - 0.3, part(83));
        let around = 0.15 * (part(7) + 0.5);
        let seen = body.torso.seen_from(at, DQuat::from_rotation_y(part(19)));
        if !seen.is_some_and(|seen| seen.is_clear(DVec3::ZERO, around + 0.008)) {
            continue;
        }
        clear += 1;
        let direction = DVec3::new(part(11), part(13), part(17)).normalize_or(DVec3::X);
        let out = body.torso.offset_out(at + direction * around, 0.008);
        assert_eq!(out, DVec3::ZERO, "{at} and {around} m along {direction}");
    }
    assert!((500..3800).contains(&clear), "{clear}");
}

#[test]
fn a_hand_that_is_placed_at_the_other_follows_it_to_its_own_place() {
    let tip = |contact: Option<Contact>, by: Option<HandSite>| HandSite {
        at: Some(HandLocation::Tip),
        digits: Digits(vec![Digit::Index]),
        contact,
        by: by.map(Box::new),
        ..HandSite::default()
    };
    let at_other = Place::Hand(tip(Some(Contact::Touch), Some(tip(None, None))));
    let high = at(BodyLocation::Shoulders, Some(Contact::Close));
    for first in [true, false] {
        let mut both = [
            Some(Box::new(at_other.clone())),
            Some(Box::new(high.clone())),
        ];
        if !first {
            both.reverse();
        }
        let [a, b] = both;
        let sign = notated(mirrored(), flat(Some(Place::Split(a, b))), Vec::new());
        let made = alive(&sign);
        let posture = model(&made, 0.5);
        let tips = ["left-index-tip", "right-index-tip"].map(|name| {
            let skeleton = made.clip.skeleton();
            let tip = made.anatomy.landmark(skeleton, &posture, name);
            tip.expect("a landmark")
        });
        let apart = tips[0].distance(tips[1]);
        assert!(apart < 0.02, "dominant first {first}: {apart} m");
    }
}
