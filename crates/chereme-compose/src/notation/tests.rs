//! Tests of movement from notation, sign by sign: directions, contacts, timing, and collisions of hands.

use std::sync::Arc;

use chereme_motion::glam::DVec3;
use chereme_motion::{Anatomy, Clip, ModelPose, Side};
use chereme_sign::hamnosys::{
    Aim, BodyLocation, BodyPlace, Constellation, Contact, Directed, Each, Frame, HandClass,
    HandLocation, HandSite, HandsUsed, Handshape, Manual, Motion, MotionKind, Place, Posture,
    Repeat, Repetition, Sign, Site, Size, Symmetry,
};
use chereme_sign::{Handedness, Reading};

use chereme_sign::hamnosys::sites::{Face, HandPoint};

use super::*;
use crate::testing::{Axes, skeleton};
use crate::{About, Note};

pub(super) fn stage(axes: Axes) -> Material {
    let skeleton = Arc::new(skeleton(axes, 1.0));
    let anatomy = Arc::new(Anatomy::detect(&skeleton));
    Material {
        address: "stage".into(),
        hash: String::new(),
        gloss: String::new(),
        signer: None,
        handedness: Handedness::Right,
        clip: Clip::still(skeleton, Rate::new(60, 1).expect("a rate"), 1),
        anatomy,
        curves: Vec::new(),
        held: Vec::new(),
    }
}

pub(super) fn directed(direction: &str) -> Motion {
    Motion::new(MotionKind::Directed(Directed {
        direction: direction.parse().expect("a direction"),
        second: None,
        size: chereme_sign::hamnosys::Amount::default(),
        curve: None,
        zigzag: None,
        ellipse: None,
    }))
}

pub(super) fn posture(
    class: HandClass,
    extended: &str,
    palm: &str,
    place: Option<Place>,
) -> Posture {
    let mut shape = Handshape::default();
    shape.form.class = class;
    Posture {
        shape: Each::Shared(shape),
        extended: Each::Shared(Aim::at(extended.parse().expect("a direction"))),
        palm: Each::Shared(Aim::at(palm.parse().expect("a palm"))),
        place,
    }
}

pub(super) fn at(location: BodyLocation, contact: Option<Contact>) -> Place {
    Place::Body(BodyPlace {
        site: Some(Site {
            at: location,
            side: None,
            approx: false,
        }),
        contact,
        ..BodyPlace::default()
    })
}

pub(super) fn notated(hands: HandsUsed, posture: Posture, actions: Vec<Motion>) -> Notated {
    Notated {
        gloss: "SIGN".into(),
        sign: Sign {
            parts: vec![Manual {
                hands,
                posture,
                actions,
                ..Manual::default()
            }],
        },
        ..Notated::default()
    }
}

pub(super) fn mirrored() -> HandsUsed {
    HandsUsed::Both(Symmetry {
        left_right: true,
        ..Symmetry::default()
    })
}

fn made(sign: &Notated, axes: Axes) -> Generated {
    let settings = Settings {
        language: chereme_sign::hamnosys::BodyLanguage::usual().without_life(),
        ..Settings::default()
    };
    animate(&[sign], &stage(axes), &settings).expect("it can be animated")
}

/// Returns the position of a landmark at a share of the sign's duration.
fn landmark(made: &Generated, share: f64, name: &str) -> DVec3 {
    let model = model(made, share);
    let skeleton = made.clip.skeleton();
    made.anatomy
        .landmark(skeleton, &model, name)
        .expect("a landmark")
}

pub(super) fn model(made: &Generated, share: f64) -> ModelPose {
    let gloss = made.notes.iter().find(|note| note.about == About::Gloss);
    let span = gloss.expect("the gloss is noted").span;
    let from = span.start().seconds();
    let time = from + (span.end().seconds() - from) * share;
    let frame = (time * 60.0).round() as usize;
    made.clip.model_pose(frame.min(made.clip.frames() - 1))
}

#[test]
fn hands_point_and_face_as_written_on_any_axes() {
    let sign = notated(
        HandsUsed::Dominant,
        posture(
            HandClass::Flat,
            "ol",
            "l",
            Some(at(BodyLocation::Chest, None)),
        ),
        vec![],
    );
    for axes in [Axes::Plain, Axes::Odd] {
        let made = made(&sign, axes);
        let model = model(&made, 0.5);
        let along = made
            .anatomy
            .hand_direction(Side::Right, &model)
            .expect("a hand");
        let palm = made
            .anatomy
            .palm_normal(Side::Right, &model)
            .expect("a hand");
        let half = 0.5f64.sqrt();
        assert!(
            along.distance(DVec3::new(half, 0.0, half)) < 1e-6,
            "{along}"
        );
        assert!(palm.distance(DVec3::new(half, 0.0, -half)) < 1e-6, "{palm}");
    }
}

#[test]
fn the_founding_example_moves_both_hands_down_twice() {
    let mut down = directed("d");
    if let MotionKind::Directed(directed) = &mut down.kind {
        directed.size.first = Some(Size::Small);
    }
    let twice = Motion::new(MotionKind::Repeated {
        motion: Box::new(down),
        repetition: Repetition::plain(Repeat::FromStart),
    });
    let place = Some(at(BodyLocation::Stomach, None));
    let here = notated(
        mirrored(),
        posture(HandClass::Finger2, "o", "d", place),
        vec![twice],
    );
    let made = made(&here, Axes::Odd);
    let heights: Vec<f64> = (0..=100)
        .map(|n| landmark(&made, f64::from(n) / 100.0, "right-palm").y)
        .collect();
    let lows = heights
        .windows(3)
        .filter(|w| w[1] < w[0] && w[1] <= w[2])
        .count();
    let (high, low) = (
        heights[0],
        heights.iter().copied().fold(f64::INFINITY, f64::min),
    );
    let arm = made.anatomy.measures().expect("measures").arm;
    let size = BodyLanguage::usual().move_small * arm;
    assert!(
        (high - low - size).abs() < 1e-3,
        "{} for {size}",
        high - low
    );
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
    let place = Place::Body(BodyPlace {
        by: Some(HandSite {
            at: Some(HandLocation::Tip),
            digits: chereme_sign::hamnosys::Digits(vec![chereme_sign::hamnosys::Digit::Index]),
            ..HandSite::default()
        }),
        site: Some(Site {
            at: BodyLocation::Nose,
            side: None,
            approx: false,
        }),
        contact: Some(Contact::Touch),
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
            Some(Place::Hands(Constellation {
                contact: Some(Contact::Touch),
                ..Constellation::default()
            })),
        ),
        vec![],
    );
    let made = made(&together, Axes::Plain);
    let [right, left] = ["right-palm", "left-palm"].map(|name| landmark(&made, 0.5, name));
    // The thumbs of flat hands are between the palms.
    assert!(
        right.distance(left) < 6e-3,
        "{} mm",
        right.distance(left) * 1e3
    );
}

#[test]
fn left_handed_signers_mirror_everything() {
    let sign = notated(
        HandsUsed::Dominant,
        posture(
            HandClass::Finger2,
            "ul",
            "l",
            Some(at(BodyLocation::Shoulders, None)),
        ),
        vec![directed("ol")],
    );
    let right = animate(&[&sign], &stage(Axes::Plain), &Settings::default()).expect("made");
    let mut other = stage(Axes::Plain);
    other.handedness = Handedness::Left;
    let left = animate(&[&sign], &other, &Settings::default()).expect("it can be animated");
    assert_eq!(right.clip.frames(), left.clip.frames());
    for share in [0.0, 0.5, 1.0] {
        let a = landmark(&right, share, "right-index-tip");
        let b = landmark(&left, share, "left-index-tip");
        assert!(a.distance(DVec3::new(-b.x, b.y, b.z)) < 1e-6);
    }
    // The values are the signer's own left and right, as the hand moves.
    for (made, hand, want) in [
        (right, Side::Right, ["up-left", "left", "out-left"]),
        (left, Side::Left, ["up-right", "right", "out-right"]),
    ] {
        let said = ["fingers", "palm", "direction"].map(|feature| {
            let is = |note: &&Note| matches!(&note.about, About::Component(_, Some(it)) if it == feature);
            let note = made.notes.iter().find(is).expect("a value");
            (note.hand, note.value.clone())
        });
        let want = want.map(|value| (Some(hand), Reading::Value(value.to_owned())));
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
    let make = || animate(&[&first, &second], &stage, &Settings::default()).expect("animated");
    let made = make();
    assert_eq!(made, make());
    assert_eq!(
        made.notes
            .iter()
            .filter(|note| note.about == About::Gloss)
            .count(),
        2
    );
    let ends = [0, made.clip.frames() - 1].map(|frame| made.clip.model_pose(frame));
    for (a, b) in ends[0].positions().iter().zip(ends[1].positions()) {
        assert!(a.distance(*b) < 1e-6);
    }
    let rest = made.clip.model_pose(0);
    for frame in 0..made.clip.frames() {
        let model = made.clip.model_pose(frame);
        for joint in 1..made.clip.skeleton().len() {
            let parent = made.clip.skeleton().parent(joint).expect("one root");
            let length = |model: &ModelPose| model.position(joint).distance(model.position(parent));
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
    assert_eq!(
        serde_json::from_str::<crate::Recipe>(&json).expect("the same"),
        recipe
    );
    let file: crate::Recipe = "sigml HUIS then BOL".parse().expect("a recipe");
    assert_eq!(file.to_string(), "sigml HUIS then BOL");
    assert!("hamnosys".parse::<crate::Recipe>().is_err());
}

#[test]
fn recipes_of_notation_are_evaluated_and_stored() {
    let corpus = crate::testing::Shelf::new();
    let flat = chereme_sign::hamnosys::from_names(
        "hamflathand hamextfingeru hampalmd hammover".split(' '),
    );
    let text = flat.expect("names of symbols");
    let recipe: crate::Recipe = format!("hamnosys \"{text}\"").parse().expect("a recipe");
    let resolved = crate::resolve(&recipe, &corpus).expect("it can be resolved");
    let made = crate::evaluate(&resolved).expect("it can be made");
    assert!(made.clip.frames() > 30);
    let kept = serde_json::to_string(resolved.inputs()).expect("json");
    let inputs: crate::Inputs = serde_json::from_str(&kept).expect("the same");
    assert_eq!(&inputs, resolved.inputs());
    let odd: crate::Recipe = "hamnosys \"abc\"".parse().expect("a recipe");
    assert!(crate::resolve(&odd, &corpus).is_err());
}

/// Returns the top speeds of wrists (m/s) and of arm joints (rad/s).
#[test]
fn a_hand_alone_touches_what_it_was_near() {
    let touch = Motion::new(MotionKind::Target {
        motion: Some(Box::new(directed("i"))),
        posture: Box::new(Posture {
            place: Some(Place::Hands(Constellation {
                contact: Some(Contact::Touch),
                ..Constellation::default()
            })),
            ..Posture::default()
        }),
    });
    let by = HandSite {
        at: Some(HandLocation::Tip),
        digits: chereme_sign::hamnosys::Digits(vec![chereme_sign::hamnosys::Digit::Index]),
        ..HandSite::default()
    };
    let mut near = at(BodyLocation::Chin, Some(Contact::Close));
    if let Place::Body(body) = &mut near {
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
    let body = Stage::of(&stage(Axes::Plain)).expect("a body");
    let middle = body.middle();
    for n in 0..4000 {
        let part = |by: usize| ((n * by) % 997) as f64 / 996.0 - 0.5;
        let at = middle + DVec3::new(part(31) * 0.6, part(57) * 1.2 - 0.3, part(83) * 0.5);
        let out = body.torso.offset_out(at, 0.004);
        let left = body.torso.offset_out(at + out, 0.0);
        assert!(left.length() < 1e-9, "{at}: {left}");
        assert!(out.length() < 0.35 && out.y.abs() < 1e-9, "{at}: {out}");
    }
    let into = notated(
        HandsUsed::Dominant,
        posture(
            HandClass::Flat,
            "il",
            "d",
            Some(at(BodyLocation::Stomach, Some(Contact::Touch))),
        ),
        vec![directed("i"), directed("l")],
    );
    let made = made(&into, Axes::Plain);
    for frame in 0..made.clip.frames() {
        let model = made.clip.model_pose(frame);
        for joint in made.anatomy.fingers(Side::Right) {
            let out = body.torso.offset_out(model.position(joint), 0.0);
            assert!(out.length() < 3e-3, "frame {frame}: {} m", out.length());
        }
    }
}

#[test]
fn head_and_trunk_move_as_their_tiers_state() {
    use chereme_sign::hamnosys::{Act, NonmanualPart, TierKind};
    let mut sign = notated(
        HandsUsed::Dominant,
        posture(
            HandClass::Flat,
            "ol",
            "d",
            Some(at(BodyLocation::Chest, None)),
        ),
        vec![],
    );
    let still = made(&sign, Axes::Odd);
    let acts = [
        (NonmanualPart::Head, "SL"),
        (NonmanualPart::Body, "TF"),
        (NonmanualPart::Brows, "RB_both_eyebrows_raised"),
    ];
    for (part, tag) in acts {
        sign.nonmanual.push(part.tier(), vec![Act::new(part, tag)]);
    }
    assert_eq!(TierKind::Head, NonmanualPart::Head.tier());
    let made = made(&sign, Axes::Odd);
    let names: Vec<&str> = made
        .curves
        .iter()
        .map(|curve| curve.name.as_str())
        .collect();
    assert_eq!(names, ["body.TF", "head.SL", "brows.RB"]);
    for curve in &made.curves {
        assert_eq!(curve.values.len(), made.clip.frames());
        assert_eq!(curve.values[0], 0.0, "{} has an attack", curve.name);
        assert!(curve.values.contains(&1.0));
    }
    let faces = |made: &Generated, share: f64| {
        let model = model(made, share);
        made.anatomy.head_axes(&model).expect("a head")[2]
    };
    let [ahead, turned] = [faces(&still, 0.5), faces(&made, 0.5)];
    assert!(ahead.distance(DVec3::Z) < 1e-6);
    assert!(turned.x > 0.4, "to the left: {turned}");
    let frame = |made: &Generated| made.anatomy.body_frame(&model(made, 0.5)).expect("a trunk");
    assert!(frame(&made).up.z > 0.08, "forwards: {}", frame(&made).up);
    let hand = |made: &Generated| frame(made).to_body(landmark(made, 0.5, "right-palm"));
    assert!(
        hand(&made).distance(hand(&still)) < 0.25,
        "the arms go with the trunk"
    );
}

#[test]
fn the_thumb_is_on_the_radial_side() {
    for axes in [Axes::Plain, Axes::Odd] {
        let body = Stage::of(&stage(axes)).expect("a body");
        for side in Side::BOTH {
            let hand = body.hand(side).expect("a hand");
            let shape = body.shape(side, &chereme_motion::HandAngles::default());
            let thumb = HandPoint::Base(chereme_sign::hamnosys::Digit::Thumb, Face::Middle);
            let little = HandPoint::Base(chereme_sign::hamnosys::Digit::Little, Face::Middle);
            let [thumb, little] = [thumb, little].map(|point| body.point(hand, &shape, point));
            assert!((thumb - little).dot(hand.radial) > 0.0, "{side:?}");
        }
    }
}

#[test]
fn a_separate_palm_for_the_other_hand_keeps_its_direction_mirrored() {
    let mut split = posture(HandClass::Flat, "ol", "d", None);
    split.palm = Each::Split(
        Some(Aim::at("d".parse().expect("a palm"))),
        Some(Aim::at("u".parse().expect("a palm"))),
    );
    let made = made(&notated(mirrored(), split, vec![]), Axes::Odd);
    let model = model(&made, 0.5);
    let along = made
        .anatomy
        .hand_direction(Side::Left, &model)
        .expect("a hand");
    let palm = made
        .anatomy
        .palm_normal(Side::Left, &model)
        .expect("a hand");
    let half = 0.5f64.sqrt();
    // A palm all the way up is at the end of the forearm's range.
    assert!(
        along.distance(DVec3::new(-half, 0.0, half)) < 0.1,
        "{along}"
    );
    assert!(palm.y > 0.9, "{palm}");
}

#[test]
fn an_idle_hand_stays_in_place_for_the_other_to_touch() {
    let touch = Place::Hands(Constellation {
        contact: Some(Contact::Touch),
        ..Constellation::default()
    });
    let close = Place::Hands(Constellation {
        contact: Some(Contact::Close),
        ..Constellation::default()
    });
    let meet = Motion::new(MotionKind::Target {
        motion: Some(Box::new(directed("d"))),
        posture: Box::new(Posture {
            place: Some(touch),
            ..Posture::default()
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
        directed.size.first = Some(Size::Big);
    }
    let posture = posture(
        HandClass::Fist,
        "o",
        "l",
        Some(at(BodyLocation::Chest, None)),
    );
    let made = made(&notated(mirrored(), posture, vec![across]), Axes::Plain);
    let said = made.report.warnings.iter();
    assert!(
        said.clone()
            .any(|said| said.contains("go through each other")),
        "{:?}",
        made.report.warnings
    );
    let palms = |frame: usize| {
        let model = made.clip.model_pose(frame);
        Side::BOTH.map(|side| {
            let hand = made.anatomy.joint(chereme_motion::Part::Hand(side));
            let along = made.anatomy.hand_direction(side, &model);
            model.position(hand.expect("a hand")) + along.expect("a direction") * 0.06
        })
    };
    let nearest = (0..made.clip.frames()).map(|frame| {
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
            directed.size.first = Some(Size::Small);
        }
        motion
    };
    let path = vec![small("r"), small("or"), small("il")];
    for frame in [Frame::Plain, Frame::Relative] {
        if let Each::Shared(aim) = &mut begun.extended {
            aim.frame = frame;
        }
        let made = made(
            &notated(HandsUsed::Dominant, begun.clone(), path.clone()),
            Axes::Odd,
        );
        let along = |share: f64| {
            let model = model(&made, share);
            let along = made.anatomy.hand_direction(Side::Right, &model);
            along.expect("a hand")
        };
        let half = 0.5f64.sqrt();
        let turned = match frame {
            Frame::Relative => DVec3::new(half, 0.0, half),
            _ => DVec3::Z,
        };
        assert!(along(0.0).distance(DVec3::Z) < 0.05);
        // The hand returns along the same path without turning around.
        assert!(
            along(1.0).distance(turned) < 0.1,
            "{frame:?} {}",
            along(1.0)
        );
    }
}

#[test]
fn a_touch_beside_the_head_meets_the_head() {
    let far = [Contact::Touch, Contact::Close].map(|contact| {
        let mut place = at(BodyLocation::Forehead, Some(contact));
        if let Place::Body(BodyPlace {
            site: Some(site), ..
        }) = &mut place
        {
            site.side = Some(chereme_sign::hamnosys::Side::RightBeside);
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
    use chereme_sign::hamnosys::{Act, NonmanualPart};
    let place = at(BodyLocation::Forehead, Some(Contact::Touch));
    let begun = posture(HandClass::Finger2, "ul", "d", Some(place));
    let plain = notated(HandsUsed::Dominant, begun, vec![]);
    let on_head = |made: &Generated| {
        let [tip, nose] = ["right-index-tip", "nose"].map(|point| landmark(made, 0.5, point));
        tip - nose
    };
    let still = on_head(&made(&plain, Axes::Odd));
    let shoulder = |made: &Generated| {
        let arm = made.anatomy.arm(Side::Right).expect("an arm");
        model(made, 0.5).position(arm.upper)
    };
    let low = shoulder(&made(&plain, Axes::Odd));
    for tag in ["UB", "UR", "HB", "HR"] {
        let mut sign = plain.clone();
        let part = NonmanualPart::Shoulders;
        sign.nonmanual.push(part.tier(), vec![Act::new(part, tag)]);
        let made = made(&sign, Axes::Odd);
        let moved = shoulder(&made).distance(low);
        assert!(moved > 0.02, "{tag} moves the shoulder by {moved} m");
        let off = on_head(&made).distance(still);
        assert!(off < 0.004, "{tag} moves the hand by {off} m");
    }
}

#[test]
fn a_hand_part_that_faces_away_is_replaced_by_the_part_in_front_of_it() {
    let mut place = at(BodyLocation::Chest, Some(Contact::Touch));
    if let Place::Body(body) = &mut place {
        body.by = Some(HandSite {
            at: Some(HandLocation::MidJoint),
            digits: chereme_sign::hamnosys::Digits(vec![chereme_sign::hamnosys::Digit::Middle]),
            side: Some(chereme_sign::hamnosys::Side::Dorsal),
            ..HandSite::default()
        });
    }
    let begun = posture(HandClass::Flat, "l", "d", Some(place));
    let made = made(&notated(HandsUsed::Dominant, begun, vec![]), Axes::Odd);
    let said = made.report.warnings.join("; ");
    assert!(said.contains("the part in front of"), "{said}");
    assert!(!said.contains("short of"), "{said}");
}
