//! Tests that synthesised movement looks natural.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide};
use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::angles::hand_angles;
use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};
use chereme_sign::hamnosys::{
    BodyLanguage, BodyLocation, DigitList, HandClass, HandDigit, HandLocation, HandPlace, HandSite, HandsUsed,
    Handshape, MotionKind, MotionSize, NonmanualAct, NonmanualPart, NotatedMotion, NotatedPosture, PathZigzag,
    PlaceContact, ThumbPosition,
};

use super::notation_plan::{HandPhase, PhaseKind, SignPlanner};
use super::notation_stage::StandingBody;
use super::tests::{at, directed, mirrored, model, notated, posture, stage};
use super::*;
use crate::outcome::NoteSubject;
use crate::testing::Axes;

mod planned_tests;
mod table_tests;

fn alive(sign: &NotatedSign) -> GeneratedMovement {
    animate_signs(&[sign], &stage(Axes::Odd), &AnimatorSettings::default()).expect("it can be animated")
}

fn sign_phases(sign: &NotatedSign) -> Vec<HandPhase> {
    let material = stage(Axes::Plain);
    let body = StandingBody::body_from_material(&material).expect("a body");
    let paces = pace::PaceTables::pace_tables_from_language(BodyLanguage::default_body_language());
    let language = BodyLanguage::default_body_language();
    let planner = SignPlanner::new(&body, language, &paces, SignerHandedness::Right, 60.0);
    planner.plan_signs(&[sign]).phases
}

fn flat_hand_posture(place: Option<HandPlace>) -> NotatedPosture {
    posture(HandClass::Flat, "ol", "d", place)
}

#[test]
fn a_thumb_across_lies_on_the_finger_or_palm_that_it_crosses() {
    let cases: [(HandClass, &[HandDigit], HandDigit); 6] = [
        (HandClass::Fist, &[], HandDigit::Middle),
        (HandClass::Finger2, &[], HandDigit::Middle),
        (HandClass::Finger2, &[HandDigit::Middle], HandDigit::Index),
        (HandClass::Finger2, &[HandDigit::Little], HandDigit::Middle),
        (HandClass::Finger23, &[], HandDigit::Ring),
        (HandClass::Finger23Spread, &[], HandDigit::Ring),
    ];
    let mut off_their_finger = Vec::new();
    for axes in [Axes::Plain, Axes::Odd] {
        let material = stage(axes);
        let body = StandingBody::body_from_material(&material).expect("a body");
        for side in BodySide::BOTH_SIDES {
            let hand = body.hand_of_side(side).expect("a hand");
            let flesh = 0.042 * hand.staged_hand_length();
            let shaped = |shape: &Handshape| {
                let angles = hand_angles(shape, BodyLanguage::default_body_language());
                thumb::pose_handshape_thumb(&body, side, shape, &angles)
            };
            let mut shape = Handshape::default();
            shape.form.thumb = Some(ThumbPosition::Across);
            for (class, special, on) in cases {
                shape.form.class = class;
                shape.special = DigitList(special.to_vec());
                let posed = shaped(&shape);
                let point = |point| body.hand_point_offset(hand, &posed, point);
                let tip = point(NotatedHandPoint::Tip(HandDigit::Thumb, DigitFace::Middle));
                let joint = point(NotatedHandPoint::Middle(HandDigit::Thumb, DigitFace::Middle));
                let pad = tip - (tip - joint).normalize() * flesh;
                let near = point(NotatedHandPoint::Middle(on, DigitFace::Middle));
                let far = body.last_joint(hand, &posed, on).expect("a joint");
                let share = (pad - near).dot(far - near) / near.distance_squared(far);
                let off = pad - near.lerp(far, share.clamp(0.0, 1.0));
                let gap = off.length() - 2.0 * flesh;
                // This hand's thumb is short: it comes no nearer to the ring finger than 3.1 mm.
                if gap.abs() > 3.2e-3 {
                    off_their_finger.push((class, special, gap * 1e3, posed.angles.thumb));
                }
                assert!(off.dot(hand.palm) > 0.0, "{class:?}: in front of the finger");
            }
            shape.form.class = HandClass::Flat;
            shape.special = DigitList::default();
            let posed = shaped(&shape);
            let tip = body.hand_point_offset(hand, &posed, NotatedHandPoint::Tip(HandDigit::Thumb, DigitFace::Middle));
            let base = body.hand_point_offset(
                hand,
                &posed,
                NotatedHandPoint::Base(HandDigit::Middle, DigitFace::Middle),
            );
            assert!(tip.dot(hand.radial) < base.dot(hand.radial) + 3e-3);
            let height = tip.dot(hand.palm) / hand.staged_hand_length();
            assert!((0.09..0.14).contains(&height), "on the palm: {height}");
        }
    }
    assert!(off_their_finger.is_empty(), "{off_their_finger:#?}");
}

#[test]
fn an_approach_is_no_faster_than_the_stroke_it_leads_to() {
    for size in [None, Some(MotionSize::Big)] {
        let mut up = directed("u");
        if let MotionKind::Directed(directed) = &mut up.kind {
            directed.size.first = size;
        }
        let sign = notated(
            HandsUsed::Dominant,
            flat_hand_posture(Some(at(BodyLocation::Chest, None))),
            vec![up],
        );
        let made = alive(&sign);
        let hand = made
            .anatomy
            .part_joint(BodyPart::Hand(BodySide::Right))
            .expect("a hand");
        let top = |phase: &HandPhase| {
            let frames = (phase.from * 60.0) as usize..(phase.to * 60.0) as usize;
            let hand_position = |frame: usize| made.clip.model_pose(frame).model_joint_position(hand);
            let steps = frames.map(|frame| hand_position(frame).distance(hand_position(frame + 1)) * 60.0);
            steps.fold(0.0, f64::max)
        };
        let phases = sign_phases(&sign);
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
        flat_hand_posture(Some(at(BodyLocation::Chest, None))),
        vec![directed("u")],
    );
    let turned = |made: &GeneratedMovement, part: BodyPart| {
        let joint = made.anatomy.part_joint(part).expect("a joint");
        let first = made.clip.model_pose(0).model_joint_rotation(joint);
        let all = (0..made.clip.clip_frame_count()).map(|frame| {
            let now = made.clip.model_pose(frame).model_joint_rotation(joint);
            now.angle_between(first).to_degrees()
        });
        all.fold(0.0, f64::max)
    };
    let made = alive(&sign);
    for part in [BodyPart::Chest, BodyPart::Head] {
        let most = turned(&made, part);
        assert!((0.2..10.0).contains(&most), "{part:?}: {most}");
    }
    let lid_curve = made.curves.iter().find(|curve| curve.name == "lids.CB");
    let lids = &lid_curve.expect("blinks").values;
    assert_eq!(lids.len(), made.clip.clip_frame_count());
    assert!(lids.iter().any(|lid| *lid > 0.9) && lids[0] == 0.0);
    assert_eq!(made, alive(&sign), "the same again");
    let still_settings = AnimatorSettings {
        language: BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    };
    let still = animate_signs(&[&sign], &stage(Axes::Odd), &still_settings).expect("made");
    for part in [BodyPart::Chest, BodyPart::Head] {
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
            directed.zigzag = Some(PathZigzag {
                wavy: true,
                size: None,
                growth: None,
            });
        }
        let sign = notated(
            HandsUsed::Dominant,
            flat_hand_posture(Some(at(BodyLocation::Chest, None))),
            vec![wave],
        );
        let phases = sign_phases(&sign);
        let stroke_phase = phases.iter().find(|phase| phase.kind == PhaseKind::Stroke);
        let stroke = stroke_phase.expect("a stroke");
        let rate = BodyLanguage::default_body_language().zigzag_waves / (stroke.to - stroke.from);
        assert!((2.5..4.0 + 1e-9).contains(&rate), "{rate}");
    }
}

#[test]
fn a_movement_with_a_target_starts_in_its_direction_and_ends_there() {
    let goal = NotatedPosture {
        place: Some(at(BodyLocation::Chin, Some(PlaceContact::Touch))),
        ..NotatedPosture::default()
    };
    let target = NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(directed("l"))),
        posture: Box::new(goal),
    });
    let begin = posture(HandClass::Finger2, "u", "l", Some(at(BodyLocation::Stomach, None)));
    let made = alive(&notated(HandsUsed::Dominant, begin, vec![target]));
    let tip = |share: f64| {
        let model = model(&made, share);
        let skeleton = made.clip.clip_skeleton();
        made.anatomy
            .landmark_place_position(skeleton, &model, "right-index-tip")
            .expect("a fingertip")
    };
    let offsets = (1..50).map(|n| tip(0.02 * f64::from(n)) - tip(0.0));
    let early_offset = offsets.into_iter().find(|offset| offset.length() > 0.03);
    let early = early_offset.expect("it moves");
    assert!(early.x > early.y.abs(), "to the left: {early}");
    let model = model(&made, 0.9);
    let chin = made
        .anatomy
        .landmark_place_position(made.clip.clip_skeleton(), &model, "chin");
    let off = chin.expect("a chin").distance(tip(0.9));
    // The nearest part of the finger touches, not its tip.
    assert!(off < 0.06, "{off}");
}

#[test]
fn a_hand_at_the_face_follows_the_head() {
    let touch = at(BodyLocation::Chin, Some(PlaceContact::Touch));
    let mut sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Finger2, "ul", "l", Some(touch)),
        vec![],
    );
    let off = |made: &GeneratedMovement| {
        let model = model(made, 0.5);
        let place = |name: &str| {
            let skeleton = made.clip.clip_skeleton();
            made.anatomy
                .landmark_place_position(skeleton, &model, name)
                .expect("a landmark")
        };
        let head = made.anatomy.part_joint(BodyPart::Head).expect("a head");
        let offset: DVec3 = place("right-index-tip") - place("chin");
        model.model_joint_rotation(head).inverse() * offset
    };
    let straight = off(&alive(&sign));
    for tag in ["SL", "TR", "NF"] {
        sign.nonmanual.tiers.clear();
        let act = NonmanualAct::new(NonmanualPart::Head, tag);
        sign.nonmanual
            .push_act_group(NonmanualPart::Head.sigml_tier(), vec![act]);
        let turned = off(&alive(&sign));
        let apart = turned.length() - straight.length();
        assert!(apart.abs() < 0.015, "{tag}: {apart}");
    }
}

#[test]
fn two_hands_do_not_merge() {
    let begin = posture(HandClass::Flat, "o", "d", Some(at(BodyLocation::Chest, None)));
    let mut across = directed("l");
    if let MotionKind::Directed(directed) = &mut across.kind {
        directed.size.first = Some(MotionSize::Small);
    }
    let made = alive(&notated(mirrored(), begin, vec![across.clone(), across]));
    let joints = |side: BodySide, frame: usize| {
        let model = made.clip.model_pose(frame);
        let digits = [1, 2].map(|n| BodyPart::Finger(side, chereme_motion::HandFinger::Index, n));
        digits.map(|part| model.model_joint_position(made.anatomy.part_joint(part).expect("a joint")))
    };
    let nearest = (0..made.clip.clip_frame_count()).flat_map(|frame| {
        let [a, b] = BodySide::BOTH_SIDES.map(|side| joints(side, frame));
        a.into_iter()
            .flat_map(move |a| b.into_iter().map(move |b| a.distance(b)))
    });
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.011, "{nearest}");
}

/// Returns the notated sign of HamNoSys symbol names.
fn sign_from_symbols(names: &str) -> NotatedSign {
    let text = chereme_sign::hamnosys::from_names(names.split(' ')).expect("names of symbols");
    NotatedSign {
        sign: chereme_sign::hamnosys::parse_hamnosys(&text).expect("HamNoSys").sign,
        ..NotatedSign::default()
    }
}

/// Returns the rotations of the right hand from the first stroke on, frame by frame, with the frame rate.
fn right_stroke_rotations(made: &GeneratedMovement) -> Vec<DQuat> {
    let hand = made
        .anatomy
        .part_joint(BodyPart::Hand(BodySide::Right))
        .expect("a hand");
    let gloss = made.notes.iter().find(|note| note.about == NoteSubject::Gloss);
    let span = gloss.expect("a gloss").span;
    let rate = made.clip.clip_frame_rate();
    let frames = rate.nearest_frame_at(span.span_start_instant())..rate.nearest_frame_at(span.span_end_instant());
    frames
        .map(|frame| made.clip.model_pose(frame).model_joint_rotation(hand))
        .collect()
}

/// Returns the positions of the right hand during the first stroke of a sign.
fn stroked(names: &str) -> Vec<DVec3> {
    let sign = sign_from_symbols(names);
    let made = alive(&sign);
    let hand = made
        .anatomy
        .part_joint(BodyPart::Hand(BodySide::Right))
        .expect("a hand");
    let phases = sign_phases(&sign);
    let stroke_phase = phases.iter().find(|phase| phase.kind == PhaseKind::Stroke);
    let stroke = stroke_phase.expect("a stroke");
    let frames = (stroke.from * 60.0).round() as usize..=(stroke.to * 60.0).round() as usize;
    frames
        .map(|frame| made.clip.model_pose(frame).model_joint_position(hand))
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
            let off = path.iter().map(|at| (at - path[0]).reject_from_normalized(chord));
            let far = off.max_by(|a, b| a.length().total_cmp(&b.length()));
            let bend = far.expect("a path").y * sign;
            assert!(bend > 0.004, "{direction}, {arc}: {bend} m");
        }
    }
}

#[test]
fn a_circle_starts_above_whatever_its_axis() {
    for axis in ["o", "i", "il", "ol"] {
        let path = stroked(&format!("hamfist hamextfingerl hampalmd hamchest hamcircle{axis}"));
        let middle = path.iter().map(|at| at.y).sum::<f64>() / path.len() as f64;
        assert!(path[0].y > middle + 0.03, "{axis}: {} and {middle}", path[0].y);
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
        let turned = right_stroke_rotations(&alive(&sign_from_symbols(names)));
        let turn_angles = turned.iter().map(|at| at.angle_between(turned[0]));
        let most = turn_angles.fold(0.0, f64::max).to_degrees();
        assert_eq!(most > 100.0, over, "{names}: {most} degrees");
    }
}

#[test]
fn a_hand_that_turns_far_takes_time_to_turn() {
    let lasts = |palm: &str| {
        let names = "hamflathand hamextfingerl hampalmd hamchest hamreplace hamextfingerl";
        let strokes = sign_phases(&sign_from_symbols(&format!("{names} {palm}")));
        let mut strokes = strokes.iter().filter(|phase| phase.kind == PhaseKind::Stroke);
        let stroke = strokes.next().expect("a stroke");
        stroke.to - stroke.from
    };
    let [quarter, half] = ["hampalml", "hampalmu"].map(lasts);
    assert!((0.2..0.4).contains(&quarter), "{quarter} s for a right angle");
    assert!((0.45..0.6).contains(&half), "{half} s for half a turn");
}

#[test]
fn an_elbow_stays_beside_the_trunk_while_its_hand_rises() {
    let sign = notated(
        HandsUsed::Dominant,
        flat_hand_posture(Some(at(BodyLocation::Chest, None))),
        vec![directed("u")],
    );
    let made = alive(&sign);
    let arm = made.anatomy.arm_chain(BodySide::Right).expect("an arm");
    for frame in 0..made.clip.clip_frame_count() {
        let model = made.clip.model_pose(frame);
        let body = made.anatomy.body_frame(&model).expect("a body");
        let upper = model.model_joint_position(arm.forearm) - model.model_joint_position(arm.upper);
        let back = -upper.dot(body.forward);
        assert!(back < 0.09, "frame {frame}: {back} m behind the shoulder");
    }
}

#[test]
fn what_is_clear_of_the_trunk_is_not_pushed_out_of_it() {
    let body = StandingBody::body_from_material(&stage(Axes::Odd)).expect("a body");
    let middle = body.shoulder_middle();
    let mut clear = 0;
    for n in 0..4000 {
        let part = |by: usize| ((n * by) % 997) as f64 / 996.0 - 0.5;
        let trunk_point = middle + DVec3::new(part(31) * 1.2, part(57) * 1.6 - 0.3, part(83));
        let around = 0.15 * (part(7) + 0.5);
        let seen = body.torso.seen_from(trunk_point, DQuat::from_rotation_y(part(19)));
        if !seen.is_some_and(|seen| seen.is_clear(DVec3::ZERO, around + 0.008)) {
            continue;
        }
        clear += 1;
        let direction = DVec3::new(part(11), part(13), part(17)).normalize_or(DVec3::X);
        let out = body.torso.offset_out_of_trunk(trunk_point + direction * around, 0.008);
        assert_eq!(out, DVec3::ZERO, "{trunk_point} and {around} m along {direction}");
    }
    assert!((500..3800).contains(&clear), "{clear}");
}

#[test]
fn a_hand_that_is_placed_at_the_other_follows_it_to_its_own_place() {
    let tip = |contact: Option<PlaceContact>, by: Option<HandSite>| HandSite {
        at: Some(HandLocation::Tip),
        digits: DigitList(vec![HandDigit::Index]),
        contact,
        by: by.map(Box::new),
        ..HandSite::default()
    };
    let at_other = HandPlace::Hand(tip(Some(PlaceContact::Touch), Some(tip(None, None))));
    let high = at(BodyLocation::Shoulders, Some(PlaceContact::Close));
    for first in [true, false] {
        let mut both = [Some(Box::new(at_other.clone())), Some(Box::new(high.clone()))];
        if !first {
            both.reverse();
        }
        let [a, b] = both;
        let sign = notated(mirrored(), flat_hand_posture(Some(HandPlace::Split(a, b))), Vec::new());
        let made = alive(&sign);
        let posture = model(&made, 0.5);
        let tips = ["left-index-tip", "right-index-tip"].map(|name| {
            let skeleton = made.clip.clip_skeleton();
            let tip = made.anatomy.landmark_place_position(skeleton, &posture, name);
            tip.expect("a landmark")
        });
        let apart = tips[0].distance(tips[1]);
        assert!(apart < 0.02, "dominant first {first}: {apart} m");
    }
}
