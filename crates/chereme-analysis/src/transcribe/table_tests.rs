//! Tables of postures and movements that are synthesised from their notation, and what is read from each.

use std::f64::consts::TAU;

use chereme_motion::BodySide;
use chereme_sign::hamnosys::{
    CompassDirection, DigitList, DirectedPath, DirectionAim, HandClass, HandDigit, HandPlace, Handshape, ManualPart,
    MotionKind, MotionSize, NotatedPosture, SpatialDirection, ThumbPosition, WristMotion, parse_hamnosys, to_names,
};
use glam::{DQuat, DVec3};

use super::tests::{ARM, Held, before_chest, clip, ease, read};
use super::transcribe_scene::SignerScene;
use super::*;

const DIRECTIONS: [&str; 26] = [
    "u", "ur", "r", "dr", "d", "dl", "l", "ul", "ol", "o", "or", "il", "i", "ir", "ui", "di", "do", "uo", "uor", "dor",
    "dol", "uol", "uir", "dir", "dil", "uil",
];

fn actions(part: &ManualPart) -> Vec<String> {
    let kinds = part.actions.iter();
    kinds.map(|action| format!("{:?}", action.kind)).collect()
}

/// Reads the only movement of the right hand, whose palm is displaced by `by` after a share of the time.
fn movement(seconds: f64, by: impl Fn(f64) -> DVec3) -> MotionKind {
    let own = before_chest(HandClass::Fist);
    let part = read(seconds, |time| [Some(own.moved(by(time))), None]);
    let [motion] = part.actions.as_slice() else {
        panic!("{:?}", actions(&part));
    };
    motion.kind.clone()
}

#[test]
fn hands_are_read_as_they_point_and_face() {
    let mut wrong = Vec::new();
    for (n, along) in DIRECTIONS.into_iter().enumerate() {
        for palm in ["u", "l", "d", "r", "ul", "dr"].into_iter().skip(n % 2).step_by(2) {
            let own = Held::new([-0.15, -0.12, 0.30], along, palm, HandClass::Flat);
            let part = read(0.3, |_| [Some(own.clone()), None]);
            let direction = part.posture.extended.dominant_value().expect("a direction");
            let facing = part.posture.palm.dominant_value().expect("a palm");
            let meant: (SpatialDirection, CompassDirection) =
                (along.parse().expect("a direction"), palm.parse().expect("a palm"));
            if (*direction, *facing) != (DirectionAim::aim_at(meant.0), DirectionAim::aim_at(meant.1)) {
                wrong.push(format!("{along} {palm}: {direction:?} {facing:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn straight_paths_are_read_with_direction_and_size() {
    let l = BodyLanguage::default_body_language();
    let sizes = [
        (l.move_small, Some(MotionSize::Small)),
        (l.move_normal, None),
        (l.move_big, Some(MotionSize::Big)),
    ];
    for (n, text) in DIRECTIONS.into_iter().enumerate() {
        let to: SpatialDirection = text.parse().expect("a direction");
        // A long way inwards would end at the body.
        let (length, size) = sizes[if text.contains('i') { 0 } else { n % 3 }];
        let by = DVec3::from(to.spatial_direction_vector()) * (length * ARM);
        let kind = movement(0.2 + length, |time| by * ease(time));
        let MotionKind::Directed(DirectedPath {
            direction,
            second,
            size: found,
            curve,
            zigzag,
            ..
        }) = &kind
        else {
            panic!("{text}: {kind:?}");
        };
        assert_eq!((*direction, *second), (to, None), "{text}");
        assert_eq!((found.first, found.second), (size, None), "{text}");
        assert!(curve.is_none() && zigzag.is_none(), "{text}: {kind:?}");
    }
}

#[test]
fn arcs_are_read_with_the_direction_of_their_bulge() {
    let l = BodyLanguage::default_body_language();
    let length = l.move_normal * ARM;
    for (along, bulge, compass) in [
        (DVec3::X, DVec3::Y, "u"),
        (DVec3::X, DVec3::NEG_Y, "d"),
        (DVec3::Y, DVec3::X, "l"),
        (DVec3::Y, DVec3::NEG_X, "r"),
        (DVec3::Z, DVec3::Y, "u"),
        (DVec3::Z, DVec3::NEG_X, "r"),
    ] {
        let deep = l.arc_normal * length;
        let radius = (length * length / 4.0 + deep * deep) / (2.0 * deep);
        let half = (length / 2.0 / radius).asin();
        let kind = movement(0.5, |time| {
            let angle = half * (2.0 * ease(time) - 1.0);
            along * (length / 2.0 + radius * angle.sin()) + bulge * (radius * angle.cos() - radius + deep)
        });
        let MotionKind::Directed(directed) = &kind else {
            panic!("{kind:?}");
        };
        let course: DVec3 = directed.direction.spatial_direction_vector().into();
        assert!(course.distance(along) < 1e-9, "{along}: {kind:?}");
        let curve = directed.curve.as_ref().expect("an arc");
        assert_eq!(curve.to.to_string(), compass, "{along} {bulge}");
        assert_eq!(curve.size, None, "{along} {bulge}");
    }
}

#[test]
fn circles_are_read_with_their_axis_and_size() {
    let l = BodyLanguage::default_body_language();
    for (axis, radius, size) in [
        ("o", l.circle_normal, None),
        ("i", l.circle_normal, None),
        ("l", l.circle_normal, None),
        ("r", l.circle_big, Some(MotionSize::Big)),
        ("u", l.circle_small, Some(MotionSize::Small)),
        ("d", l.circle_normal, None),
    ] {
        let to: SpatialDirection = axis.parse().expect("an axis");
        let about: DVec3 = to.spatial_direction_vector().into();
        // A level circle begins at its near end, so that it does not come near the body.
        let start = if about.y.abs() > 0.5 { DVec3::NEG_Z } else { DVec3::Y };
        let kind = movement(0.7, |time| {
            let spoke = start * (radius * ARM);
            DQuat::from_axis_angle(about, TAU * ease(time)) * spoke - spoke
        });
        let MotionKind::Circular(circle) = &kind else {
            panic!("{axis}: {kind:?}");
        };
        assert_eq!((circle.axis, circle.size.first), (to, size), "{axis}");
    }
}

#[test]
fn movements_of_the_wrist_are_distinguished_by_their_axes() {
    let own = before_chest(HandClass::Fist);
    for (wrist, first, second) in [
        (WristMotion::Nodding, DVec3::Z * 0.5, DVec3::ZERO),
        (WristMotion::Swinging, DVec3::X * 0.4, DVec3::ZERO),
        (WristMotion::Twisting, DVec3::Y * 0.6, DVec3::ZERO),
    ] {
        let part = read(0.56, |time| {
            let (sin, cos) = (TAU * 2.0 * time).sin_cos();
            let turn = DQuat::from_scaled_axis(first * sin + second * (cos - 1.0));
            [Some(own.turned(turn)), None]
        });
        let [motion] = part.actions.as_slice() else {
            panic!("{wrist:?}: {:?}", actions(&part));
        };
        let MotionKind::Wrist { motion, .. } = &motion.kind else {
            panic!("{wrist:?}: {:?}", actions(&part));
        };
        assert_eq!(*motion, wrist);
    }
}

#[test]
fn handshapes_are_read_as_they_are_written() {
    let mut wrong = Vec::new();
    let shape = |class: HandClass, thumb: Option<ThumbPosition>, special: &[HandDigit]| {
        let mut shape = Handshape::default();
        (shape.form.class, shape.form.thumb) = (class, thumb);
        shape.special = DigitList(special.to_vec());
        shape
    };
    for meant in [
        shape(HandClass::Fist, None, &[]),
        shape(HandClass::Fist, Some(ThumbPosition::Out), &[]),
        shape(HandClass::Flat, None, &[]),
        shape(HandClass::Flat, Some(ThumbPosition::Out), &[]),
        shape(HandClass::Finger2, None, &[]),
        shape(HandClass::Finger2, Some(ThumbPosition::Out), &[]),
        shape(HandClass::Finger2, None, &[HandDigit::Little]),
        shape(HandClass::Finger23, None, &[]),
        shape(HandClass::Finger23Spread, None, &[]),
        shape(HandClass::Finger2345, None, &[]),
        shape(HandClass::Pinch12, None, &[]),
        shape(HandClass::PinchAll, None, &[]),
        shape(HandClass::Cee12, None, &[]),
        shape(HandClass::CeeAll, None, &[]),
    ] {
        let mut own = before_chest(HandClass::Fist);
        own.shape = meant.clone();
        let part = read(0.3, |_| [Some(own.clone()), None]);
        let found = part.posture.shape.dominant_value().expect("a shape");
        let plain = |shape: &Handshape| (shape.form, shape.special.clone(), shape.between);
        if plain(found) != plain(&meant) {
            wrong.push(format!("{:?}: {:?}", plain(&meant), plain(found)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn features_in_symbols_are_read_back_as_the_same_features() {
    for names in [
        "hamchest",
        "hamchest hamtouch",
        "hamlips hamclose",
        "hamlrat hamshoulders",
        "hamchin hambetween hamlips",
        "hamneutralspace hamarmextended",
    ] {
        let text = chereme_sign::hamnosys::from_names(names.split(' ')).expect("symbols");
        let posture = parse_hamnosys(&text).expect("a place").sign.parts[0].posture.clone();
        let Some(HandPlace::Body(place)) = posture.place else {
            panic!("{names}");
        };
        let again =
            transcribe_words::describe_body_place(&place).text + &transcribe_words::describe_place_contact(&place).text;
        assert_eq!(to_names(&again).expect("symbols").join(" "), names);
    }
    let text = transcribe_words::begun_posture_hamnosys(
        chereme_sign::hamnosys::HandsUsed::Dominant,
        NotatedPosture::default(),
    );
    assert_eq!(text, "");
}

#[test]
fn a_point_of_the_hand_keeps_its_place_in_the_hand_s_own_space() {
    let own = before_chest(HandClass::Flat);
    let (clip, anatomy) = clip(0.3, |time| {
        let turned = own.turned(DQuat::from_rotation_z(0.8 * time));
        [Some(turned.moved(DVec3::new(0.1, -0.05, 0.08) * time)), None]
    });
    let options = TranscribeOptions::synthesised_options();
    let scene = SignerScene::read_signer_scene(&clip, &anatomy, &options).expect("a scene");
    let hands = scene.hands.iter().flatten();
    let track = hands.into_iter().find(|track| track.side == BodySide::Right);
    let track = track.expect("a hand");
    let (first, last) = (0, track.wrist.len() - 1);
    let at = track.wrist[first] + DVec3::new(0.02, 0.11, -0.03);
    let carried = track.carried_point_trajectory(at, first);
    assert!(carried[first].distance(at) < 1e-12);
    let turn = track.turned[last] * track.turned[first].inverse();
    let expected = track.wrist[last] + turn * (at - track.wrist[first]);
    assert!(carried[last].distance(expected) < 1e-12);
    for frame in [first, last / 2, last] {
        let in_hand = acts::to_hand_space(track, &[carried[frame]], frame)[0];
        let at_first = acts::to_hand_space(track, &[at], first)[0];
        assert!(in_hand.distance(at_first) < 1e-12, "frame {frame}");
        assert!((in_hand.length() - at.distance(track.wrist[first])).abs() < 1e-12);
    }
    assert!(turn.to_axis_angle().1 > 0.7, "the hand turned");
}

#[test]
fn handshapes_are_named_with_every_part_that_is_written() {
    for (names, said) in [
        ("hamfist", "fist"),
        ("hamflathand hamthumboutmod", "flat thumb out"),
        ("hamfinger2 hamfingerbendmod", "finger2 round"),
        ("hamfinger2 hamfingerhookmod", "finger2 hooked"),
        ("hamfinger23spread hamdoublebent", "finger23spread double-bent"),
        ("hamfinger2345 hamdoublehooked", "finger2345 double-hooked"),
        ("hamflathand hamfingerstraightmod", "flat bent"),
        ("hamfist hambetween hamflathand", "fist | flat"),
    ] {
        let text = chereme_sign::hamnosys::from_names(names.split(' ')).expect("symbols");
        let posture = parse_hamnosys(&text).expect("a shape").sign.parts[0].posture.clone();
        let shape = posture.shape.dominant_value().expect("a shape");
        let named = transcribe_words::describe_handshape(shape);
        assert_eq!(named.words, said, "{names}");
        assert_eq!(to_names(&named.text).expect("symbols").join(" "), names);
    }
}
