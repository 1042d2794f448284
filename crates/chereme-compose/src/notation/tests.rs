//! Tests of movement from notation, sign by sign: directions, contacts, timing, and collisions of hands.

use std::sync::Arc;

use chereme_motion::glam::DVec3;
use chereme_motion::{BodyAnatomy, BodySide, Clip, ModelPose};
use chereme_sign::hamnosys::{
    BodyLocation, BodyPlace, DirectedPath, DirectionAim, DirectionFrame, EachHand, HamnosysSign, HandClass,
    HandConstellation, HandLocation, HandPlace, HandSite, HandSymmetry, HandsUsed, Handshape, ManualPart, MotionKind,
    MotionRepetition, MotionSize, NotatedMotion, NotatedPosture, PlaceContact, RepeatKind, SidedLocation,
};
use chereme_sign::{ComponentReading, SignerHandedness};

use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint};

use super::*;
use crate::testing::{Axes, skeleton};
use crate::{GeneratedNote, NoteSubject};

pub(super) fn stage(axes: Axes) -> MovementMaterial {
    let skeleton = Arc::new(skeleton(axes, 1.0));
    let anatomy = Arc::new(BodyAnatomy::detect_anatomy(&skeleton));
    MovementMaterial {
        address: "stage".into(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness: SignerHandedness::Right,
        clip: Clip::from_rest_pose(skeleton, FrameRate::new(60, 1).expect("a rate"), 1),
        anatomy,
        curves: Vec::new(),
        held: Vec::new(),
    }
}

pub(super) fn directed(direction: &str) -> NotatedMotion {
    NotatedMotion::new(MotionKind::Directed(DirectedPath {
        direction: direction.parse().expect("a direction"),
        second: None,
        size: chereme_sign::hamnosys::SizeAmount::default(),
        curve: None,
        zigzag: None,
        ellipse: None,
    }))
}

pub(super) fn posture(class: HandClass, extended: &str, palm: &str, place: Option<HandPlace>) -> NotatedPosture {
    let mut shape = Handshape::default();
    shape.form.class = class;
    NotatedPosture {
        shape: EachHand::Shared(shape),
        extended: EachHand::Shared(DirectionAim::aim_at(extended.parse().expect("a direction"))),
        palm: EachHand::Shared(DirectionAim::aim_at(palm.parse().expect("a palm"))),
        place,
    }
}

pub(super) fn at(location: BodyLocation, contact: Option<PlaceContact>) -> HandPlace {
    HandPlace::Body(BodyPlace {
        site: Some(SidedLocation {
            at: location,
            side: None,
            approx: false,
        }),
        contact,
        ..BodyPlace::default()
    })
}

pub(super) fn notated(hands: HandsUsed, posture: NotatedPosture, actions: Vec<NotatedMotion>) -> NotatedSign {
    NotatedSign {
        gloss: "SIGN".into(),
        sign: HamnosysSign {
            parts: vec![ManualPart {
                hands,
                posture,
                actions,
                ..ManualPart::default()
            }],
        },
        ..NotatedSign::default()
    }
}

pub(super) fn mirrored() -> HandsUsed {
    HandsUsed::Both(HandSymmetry {
        left_right: true,
        ..HandSymmetry::default()
    })
}

fn made(sign: &NotatedSign, axes: Axes) -> GeneratedMovement {
    let settings = AnimatorSettings {
        language: chereme_sign::hamnosys::BodyLanguage::default_body_language().without_life(),
        ..AnimatorSettings::default()
    };
    animate_signs(&[sign], &stage(axes), &settings).expect("it can be animated")
}

/// Returns the position of a landmark at a share of the sign's duration.
fn landmark(made: &GeneratedMovement, share: f64, name: &str) -> DVec3 {
    let model = model(made, share);
    let skeleton = made.clip.clip_skeleton();
    made.anatomy
        .landmark_place_position(skeleton, &model, name)
        .expect("a landmark")
}

pub(super) fn model(made: &GeneratedMovement, share: f64) -> ModelPose {
    let gloss = made.notes.iter().find(|note| note.about == NoteSubject::Gloss);
    let span = gloss.expect("the gloss is noted").span;
    let from = span.span_start_instant().instant_seconds();
    let time = from + (span.span_end_instant().instant_seconds() - from) * share;
    let frame = (time * 60.0).round() as usize;
    made.clip.model_pose(frame.min(made.clip.clip_frame_count() - 1))
}

#[test]
fn hands_point_and_face_as_written_on_any_axes() {
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "ol", "l", Some(at(BodyLocation::Chest, None))),
        vec![],
    );
    for axes in [Axes::Plain, Axes::Odd] {
        let made = made(&sign, axes);
        let model = model(&made, 0.5);
        let along = made.anatomy.hand_direction(BodySide::Right, &model).expect("a hand");
        let palm = made.anatomy.palm_normal(BodySide::Right, &model).expect("a hand");
        let half = 0.5f64.sqrt();
        assert!(along.distance(DVec3::new(half, 0.0, half)) < 1e-6, "{along}");
        assert!(palm.distance(DVec3::new(half, 0.0, -half)) < 1e-6, "{palm}");
    }
}

#[test]
fn parallel_hands_point_alike_and_mirror_their_palms() {
    let hands = HandsUsed::Both(HandSymmetry::default());
    let made = made(
        &notated(hands, posture(HandClass::Flat, "o", "l", None), vec![]),
        Axes::Odd,
    );
    let model = model(&made, 0.5);
    for (side, faces) in [(BodySide::Right, DVec3::X), (BodySide::Left, DVec3::NEG_X)] {
        let along = made.anatomy.hand_direction(side, &model).expect("a hand");
        let palm = made.anatomy.palm_normal(side, &model).expect("a hand");
        assert!(along.distance(DVec3::Z) < 0.05, "{side:?} points to {along}");
        assert!(palm.distance(faces) < 0.05, "{side:?} faces {palm}");
    }
}

#[test]
fn the_founding_example_moves_both_hands_down_twice() {
    let mut down = directed("d");
    if let MotionKind::Directed(directed) = &mut down.kind {
        directed.size.first = Some(MotionSize::Small);
    }
    let twice = NotatedMotion::new(MotionKind::Repeated {
        motion: Box::new(down),
        repetition: MotionRepetition::plain_repetition(RepeatKind::FromStart),
    });
    let place = Some(at(BodyLocation::Stomach, None));
    let here = notated(mirrored(), posture(HandClass::Finger2, "o", "d", place), vec![twice]);
    let made = made(&here, Axes::Odd);
    let heights: Vec<f64> = (0..=100)
        .map(|n| landmark(&made, f64::from(n) / 100.0, "right-palm").y)
        .collect();
    let lows = heights.windows(3).filter(|w| w[1] < w[0] && w[1] <= w[2]).count();
    let (high, low) = (heights[0], heights.iter().copied().fold(f64::INFINITY, f64::min));
    let arm = made.anatomy.anatomy_measures().expect("measures").arm;
    let size = BodyLanguage::default_body_language().move_small * arm;
    assert!((high - low - size).abs() < 1e-3, "{} for {size}", high - low);
    assert!(lows >= 1 && (heights[100] - low).abs() < 1e-3);
    for share in [0.0, 0.3, 0.6, 1.0] {
        let [right, left] = ["right-palm", "left-palm"].map(|name| landmark(&made, share, name));
        assert!(
            right.distance(DVec3::new(-left.x, left.y, left.z)) < 1e-6,
            "mirrored at {share}"
        );
    }
    assert!(lows >= 2, "{lows} times down");
}

#[test]
fn contacts_are_met() {
    let place = HandPlace::Body(BodyPlace {
        by: Some(HandSite {
            at: Some(HandLocation::Tip),
            digits: chereme_sign::hamnosys::DigitList(vec![chereme_sign::hamnosys::HandDigit::Index]),
            ..HandSite::default()
        }),
        site: Some(SidedLocation {
            at: BodyLocation::Nose,
            side: None,
            approx: false,
        }),
        contact: Some(PlaceContact::Touch),
        ..BodyPlace::default()
    });
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Finger2, "ul", "l", Some(place)),
        vec![],
    );
    for axes in [Axes::Plain, Axes::Odd] {
        let made = made(&sign, axes);
        let [tip, chin] = ["right-index-tip", "nose"].map(|name| landmark(&made, 0.5, name));
        assert!(tip.distance(chin) < 2e-3, "{} mm", tip.distance(chin) * 1e3);
    }
    let together = notated(
        mirrored(),
        posture(
            HandClass::Flat,
            "uo",
            "l",
            Some(HandPlace::Hands(HandConstellation {
                contact: Some(PlaceContact::Touch),
                ..HandConstellation::default()
            })),
        ),
        vec![],
    );
    let made = made(&together, Axes::Plain);
    let [right, left] = ["right-palm", "left-palm"].map(|name| landmark(&made, 0.5, name));
    // The thumbs of flat hands are between the palms.
    assert!(right.distance(left) < 6e-3, "{} mm", right.distance(left) * 1e3);
}

#[test]
fn left_handed_signers_mirror_everything() {
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Finger2, "ul", "l", Some(at(BodyLocation::Shoulders, None))),
        vec![directed("ol")],
    );
    let right = animate_signs(&[&sign], &stage(Axes::Plain), &AnimatorSettings::default()).expect("made");
    let mut other = stage(Axes::Plain);
    other.handedness = SignerHandedness::Left;
    let left = animate_signs(&[&sign], &other, &AnimatorSettings::default()).expect("it can be animated");
    assert_eq!(right.clip.clip_frame_count(), left.clip.clip_frame_count());
    for share in [0.0, 0.5, 1.0] {
        let a = landmark(&right, share, "right-index-tip");
        let b = landmark(&left, share, "left-index-tip");
        assert!(a.distance(DVec3::new(-b.x, b.y, b.z)) < 1e-6);
    }
    // The values are the signer's own left and right, as the hand moves.
    for (made, hand, want) in [
        (right, BodySide::Right, ["up-left", "left", "out-left"]),
        (left, BodySide::Left, ["up-right", "right", "out-right"]),
    ] {
        let said = ["fingers", "palm", "direction"].map(|feature| {
            let is =
                |note: &&GeneratedNote| matches!(&note.about, NoteSubject::Component(_, Some(it)) if it == feature);
            let note = made.notes.iter().find(is).expect("a value");
            (note.hand, note.value.clone())
        });
        let want = want.map(|value| (Some(hand), ComponentReading::Value(value.to_owned())));
        assert_eq!(said, want);
    }
}

#[test]
fn sequences_begin_and_end_at_rest_and_are_reproducible() {
    let first = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "u", "d", None),
        vec![directed("r")],
    );
    let second = notated(
        mirrored(),
        posture(HandClass::Fist, "o", "l", None),
        vec![directed("d")],
    );
    let stage = stage(Axes::Odd);
    let make = || animate_signs(&[&first, &second], &stage, &AnimatorSettings::default()).expect("animated");
    let made = make();
    assert_eq!(made, make());
    assert_eq!(
        made.notes
            .iter()
            .filter(|note| note.about == NoteSubject::Gloss)
            .count(),
        2
    );
    let ends = [0, made.clip.clip_frame_count() - 1].map(|frame| made.clip.model_pose(frame));
    for (a, b) in ends[0]
        .model_joint_positions()
        .iter()
        .zip(ends[1].model_joint_positions())
    {
        assert!(a.distance(*b) < 1e-6);
    }
    let rest = made.clip.model_pose(0);
    for frame in 0..made.clip.clip_frame_count() {
        let model = made.clip.model_pose(frame);
        for joint in 1..made.clip.clip_skeleton().len() {
            let parent = made.clip.clip_skeleton().joint_parent(joint).expect("one root");
            let length = |model: &ModelPose| {
                model
                    .model_joint_position(joint)
                    .distance(model.model_joint_position(parent))
            };
            assert!((length(&model) - length(&rest)).abs() < 1e-9);
        }
    }
}

#[test]
fn recipes_take_notation_as_text_and_as_json() {
    let text = "hamnosys \"hamflathand,hamextfingeru,hampalmd\" on signer:1";
    let recipe: crate::Recipe = format!("{text} | reverse").parse().expect("a recipe");
    assert_eq!(recipe.to_string(), format!("{text} | reverse"));
    let json = serde_json::to_string(&recipe).expect("json");
    assert_eq!(serde_json::from_str::<crate::Recipe>(&json).expect("the same"), recipe);
    let file: crate::Recipe = "sigml HUIS then BOL".parse().expect("a recipe");
    assert_eq!(file.to_string(), "sigml HUIS then BOL");
    assert!("hamnosys".parse::<crate::Recipe>().is_err());
}

#[test]
fn recipes_of_notation_are_evaluated_and_stored() {
    let corpus = crate::testing::Shelf::new();
    let flat = chereme_sign::hamnosys::from_names("hamflathand hamextfingeru hampalmd hammover".split(' '));
    let text = flat.expect("names of symbols");
    let recipe: crate::Recipe = format!("hamnosys \"{text}\"").parse().expect("a recipe");
    let resolved = crate::resolve_recipe(&recipe, &corpus).expect("it can be resolved");
    let made = crate::evaluate_recipe(&resolved).expect("it can be made");
    assert!(made.clip.clip_frame_count() > 30);
    let kept = serde_json::to_string(resolved.resolved_inputs()).expect("json");
    let inputs: crate::RecipeInputs = serde_json::from_str(&kept).expect("the same");
    assert_eq!(&inputs, resolved.resolved_inputs());
    let odd: crate::Recipe = "hamnosys \"abc\"".parse().expect("a recipe");
    assert!(crate::resolve_recipe(&odd, &corpus).is_err());
}

/// Returns the top speeds of wrists (m/s) and of arm joints (rad/s).
#[test]
fn a_hand_alone_touches_what_it_was_near() {
    let touch = NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(directed("i"))),
        posture: Box::new(NotatedPosture {
            place: Some(HandPlace::Hands(HandConstellation {
                contact: Some(PlaceContact::Touch),
                ..HandConstellation::default()
            })),
            ..NotatedPosture::default()
        }),
    });
    let by = HandSite {
        at: Some(HandLocation::Tip),
        digits: chereme_sign::hamnosys::DigitList(vec![chereme_sign::hamnosys::HandDigit::Index]),
        ..HandSite::default()
    };
    let mut near = at(BodyLocation::Chin, Some(PlaceContact::Close));
    if let HandPlace::Body(body) = &mut near {
        body.by = Some(by);
    }
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Finger2, "ui", "l", Some(near)),
        vec![touch],
    );
    let made = made(&sign, Axes::Odd);
    let [tip, chin] = ["right-index-tip", "chin"].map(|name| landmark(&made, 0.95, name));
    assert!(tip.distance(chin) < 2e-3, "{} mm", tip.distance(chin) * 1e3);
    let [begin, end] = [0.0, 1.0].map(|share| landmark(&made, share, "left-wrist"));
    assert!(begin.distance(end) < 1e-9, "the other hand rests");
}

#[test]
fn nothing_of_a_hand_enters_the_trunk() {
    let body = StandingBody::body_from_material(&stage(Axes::Plain)).expect("a body");
    let middle = body.shoulder_middle();
    for n in 0..4000 {
        let part = |by: usize| ((n * by) % 997) as f64 / 996.0 - 0.5;
        let at = middle + DVec3::new(part(31) * 0.6, part(57) * 1.2 - 0.3, part(83) * 0.5);
        let out = body.torso.offset_out_of_trunk(at, 0.004);
        let left = body.torso.offset_out_of_trunk(at + out, 0.0);
        assert!(left.length() < 1e-9, "{at}: {left}");
        assert!(out.length() < 0.35 && out.y.abs() < 1e-9, "{at}: {out}");
    }
    let into = notated(
        HandsUsed::Dominant,
        posture(
            HandClass::Flat,
            "il",
            "d",
            Some(at(BodyLocation::Stomach, Some(PlaceContact::Touch))),
        ),
        vec![directed("i"), directed("l")],
    );
    let made = made(&into, Axes::Plain);
    for frame in 0..made.clip.clip_frame_count() {
        let model = made.clip.model_pose(frame);
        for joint in made.anatomy.finger_joints(BodySide::Right) {
            let out = body.torso.offset_out_of_trunk(model.model_joint_position(joint), 0.0);
            assert!(out.length() < 3e-3, "frame {frame}: {} m", out.length());
        }
    }
}

#[test]
fn head_and_trunk_move_as_their_tiers_state() {
    use chereme_sign::hamnosys::{NonmanualAct, NonmanualPart, TierKind};
    let mut sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "ol", "d", Some(at(BodyLocation::Chest, None))),
        vec![],
    );
    let still = made(&sign, Axes::Odd);
    let acts = [
        (NonmanualPart::Head, "SL"),
        (NonmanualPart::Body, "TF"),
        (NonmanualPart::Brows, "RB_both_eyebrows_raised"),
    ];
    for (part, tag) in acts {
        sign.nonmanual
            .push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, tag)]);
    }
    assert_eq!(TierKind::Head, NonmanualPart::Head.sigml_tier());
    let made = made(&sign, Axes::Odd);
    let names: Vec<&str> = made.curves.iter().map(|curve| curve.name.as_str()).collect();
    assert_eq!(names, ["body.TF", "head.SL", "brows.RB"]);
    for curve in &made.curves {
        assert_eq!(curve.values.len(), made.clip.clip_frame_count());
        assert_eq!(curve.values[0], 0.0, "{} has an attack", curve.name);
        assert!(curve.values.contains(&1.0));
    }
    let faces = |made: &GeneratedMovement, share: f64| {
        let model = model(made, share);
        made.anatomy.head_axes(&model).expect("a head")[2]
    };
    let [ahead, turned] = [faces(&still, 0.5), faces(&made, 0.5)];
    assert!(ahead.distance(DVec3::Z) < 1e-6);
    assert!(turned.x > 0.4, "to the left: {turned}");
    let frame = |made: &GeneratedMovement| made.anatomy.body_frame(&model(made, 0.5)).expect("a trunk");
    assert!(frame(&made).up.z > 0.08, "forwards: {}", frame(&made).up);
    let hand = |made: &GeneratedMovement| frame(made).to_body(landmark(made, 0.5, "right-palm"));
    assert!(hand(&made).distance(hand(&still)) < 0.25, "the arms go with the trunk");
}

#[test]
fn the_thumb_is_on_the_radial_side() {
    for axes in [Axes::Plain, Axes::Odd] {
        let body = StandingBody::body_from_material(&stage(axes)).expect("a body");
        for side in BodySide::BOTH_SIDES {
            let hand = body.hand_of_side(side).expect("a hand");
            let shape = body.finger_shape(side, &chereme_motion::HandAngles::default());
            let thumb = NotatedHandPoint::Base(chereme_sign::hamnosys::HandDigit::Thumb, DigitFace::Middle);
            let little = NotatedHandPoint::Base(chereme_sign::hamnosys::HandDigit::Little, DigitFace::Middle);
            let [thumb, little] = [thumb, little].map(|point| body.hand_point_offset(hand, &shape, point));
            assert!((thumb - little).dot(hand.radial) > 0.0, "{side:?}");
        }
    }
}

#[test]
fn a_separate_palm_for_the_other_hand_keeps_its_direction_mirrored() {
    let mut split = posture(HandClass::Flat, "ol", "d", None);
    split.palm = EachHand::Split(
        Some(DirectionAim::aim_at("d".parse().expect("a palm"))),
        Some(DirectionAim::aim_at("u".parse().expect("a palm"))),
    );
    let made = made(&notated(mirrored(), split, vec![]), Axes::Odd);
    let model = model(&made, 0.5);
    let along = made.anatomy.hand_direction(BodySide::Left, &model).expect("a hand");
    let palm = made.anatomy.palm_normal(BodySide::Left, &model).expect("a hand");
    let half = 0.5f64.sqrt();
    // A palm all the way up is at the end of the forearm's range.
    assert!(along.distance(DVec3::new(-half, 0.0, half)) < 0.1, "{along}");
    assert!(palm.y > 0.9, "{palm}");
}

#[test]
fn an_idle_hand_stays_in_place_for_the_other_to_touch() {
    let touch = HandPlace::Hands(HandConstellation {
        contact: Some(PlaceContact::Touch),
        ..HandConstellation::default()
    });
    let close = HandPlace::Hands(HandConstellation {
        contact: Some(PlaceContact::Close),
        ..HandConstellation::default()
    });
    let meet = NotatedMotion::new(MotionKind::Target {
        motion: Some(Box::new(directed("d"))),
        posture: Box::new(NotatedPosture {
            place: Some(touch),
            ..NotatedPosture::default()
        }),
    });
    let sign = notated(
        HandsUsed::Dominant,
        posture(HandClass::Flat, "ol", "d", Some(close)),
        vec![meet],
    );
    let made = made(&sign, Axes::Plain);
    let [begin, end] = [0.0, 1.0].map(|share| landmark(&made, share, "left-wrist"));
    assert!(begin.distance(end) < 1e-2, "{begin} to {end}");
}

#[test]
fn hands_that_would_pass_through_each_other_are_moved_apart_and_reported() {
    let mut across = directed("l");
    if let MotionKind::Directed(directed) = &mut across.kind {
        directed.size.first = Some(MotionSize::Big);
    }
    let posture = posture(HandClass::Fist, "o", "l", Some(at(BodyLocation::Chest, None)));
    let made = made(&notated(mirrored(), posture, vec![across]), Axes::Plain);
    let said = made.report.warnings.iter();
    assert!(
        said.clone().any(|said| said.contains("go through each other")),
        "{:?}",
        made.report.warnings
    );
    let palms = |frame: usize| {
        let model = made.clip.model_pose(frame);
        BodySide::BOTH_SIDES.map(|side| {
            let hand = made.anatomy.part_joint(chereme_motion::BodyPart::Hand(side));
            let along = made.anatomy.hand_direction(side, &model);
            model.model_joint_position(hand.expect("a hand")) + along.expect("a direction") * 0.06
        })
    };
    let nearest = (0..made.clip.clip_frame_count()).map(|frame| {
        let [a, b] = palms(frame);
        a.distance(b)
    });
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.02, "{nearest}");
}

#[test]
fn relative_orientations_turn_with_the_path() {
    let chest = Some(at(BodyLocation::Chest, None));
    let mut begun = posture(HandClass::Flat, "o", "l", chest);
    let small = |direction: &str| {
        let mut motion = directed(direction);
        if let MotionKind::Directed(directed) = &mut motion.kind {
            directed.size.first = Some(MotionSize::Small);
        }
        motion
    };
    let path = vec![small("r"), small("or"), small("il")];
    for frame in [DirectionFrame::Plain, DirectionFrame::Relative] {
        if let EachHand::Shared(aim) = &mut begun.extended {
            aim.frame = frame;
        }
        let made = made(&notated(HandsUsed::Dominant, begun.clone(), path.clone()), Axes::Odd);
        let along = |share: f64| {
            let model = model(&made, share);
            let along = made.anatomy.hand_direction(BodySide::Right, &model);
            along.expect("a hand")
        };
        let half = 0.5f64.sqrt();
        let turned = match frame {
            DirectionFrame::Relative => DVec3::new(half, 0.0, half),
            _ => DVec3::Z,
        };
        assert!(along(0.0).distance(DVec3::Z) < 0.05);
        // The hand returns along the same path without turning around.
        assert!(along(1.0).distance(turned) < 0.1, "{frame:?} {}", along(1.0));
    }
}

#[test]
fn a_touch_beside_the_head_meets_the_head() {
    let far = [PlaceContact::Touch, PlaceContact::Close].map(|contact| {
        let mut place = at(BodyLocation::Forehead, Some(contact));
        if let HandPlace::Body(BodyPlace { site: Some(site), .. }) = &mut place {
            site.side = Some(chereme_sign::hamnosys::LocationSide::RightBeside);
        }
        let begun = posture(HandClass::Finger2, "ul", "d", Some(place));
        let made = made(&notated(HandsUsed::Dominant, begun, vec![]), Axes::Odd);
        let tip = landmark(&made, 0.5, "right-index-tip");
        tip.distance(landmark(&made, 0.5, "right-temple"))
    });
    assert!(far[0] < 0.06 && far[0] + 0.05 < far[1], "{far:?}");
}

#[test]
fn raised_shoulders_do_not_move_a_hand_off_what_it_touches() {
    use chereme_sign::hamnosys::{NonmanualAct, NonmanualPart};
    let place = at(BodyLocation::Forehead, Some(PlaceContact::Touch));
    let begun = posture(HandClass::Finger2, "ul", "dr", Some(place));
    let plain = notated(HandsUsed::Dominant, begun, vec![]);
    let on_head = |made: &GeneratedMovement| {
        let [tip, nose] = ["right-index-tip", "nose"].map(|point| landmark(made, 0.5, point));
        tip - nose
    };
    let still = on_head(&made(&plain, Axes::Odd));
    let shoulder = |made: &GeneratedMovement| {
        let arm = made.anatomy.arm_chain(BodySide::Right).expect("an arm");
        model(made, 0.5).model_joint_position(arm.upper)
    };
    let low = shoulder(&made(&plain, Axes::Odd));
    for tag in ["UB", "UR", "HB", "HR"] {
        let mut sign = plain.clone();
        let part = NonmanualPart::Shoulders;
        sign.nonmanual
            .push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, tag)]);
        let made = made(&sign, Axes::Odd);
        let moved = shoulder(&made).distance(low);
        assert!(moved > 0.02, "{tag} moves the shoulder by {moved} m");
        let off = on_head(&made).distance(still);
        assert!(off < 0.004, "{tag} moves the hand by {off} m");
    }
}

#[test]
fn a_hand_part_that_faces_away_is_replaced_by_the_part_in_front_of_it() {
    let mut place = at(BodyLocation::Chest, Some(PlaceContact::Touch));
    if let HandPlace::Body(body) = &mut place {
        body.by = Some(HandSite {
            at: Some(HandLocation::MidJoint),
            digits: chereme_sign::hamnosys::DigitList(vec![chereme_sign::hamnosys::HandDigit::Middle]),
            side: Some(chereme_sign::hamnosys::LocationSide::Dorsal),
            ..HandSite::default()
        });
    }
    let begun = posture(HandClass::Flat, "l", "d", Some(place));
    let made = made(&notated(HandsUsed::Dominant, begun, vec![]), Axes::Odd);
    let said = made.report.warnings.join("; ");
    assert!(said.contains("the part in front of"), "{said}");
    assert!(!said.contains("short of"), "{said}");
}
