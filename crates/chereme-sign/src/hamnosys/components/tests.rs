//! Notation in the inventories' words, sign by sign.

use super::super::direction::{Compass, Direction};
use super::super::tree::*;
use super::super::{Act, NonmanualPart, Notated};
use super::*;
use crate::inventory::builtin;

fn flat() -> Handshape {
    shape(HandClass::Flat, None, None)
}

fn shape(class: HandClass, thumb: Option<ThumbPosition>, bend: Option<Bend>) -> Handshape {
    let form = Form {
        class,
        thumb,
        bend,
        opening: None,
    };
    Handshape {
        form,
        ..Handshape::default()
    }
}

fn at(at: BodyLocation, side: Option<Side>, contact: Option<Contact>) -> Place {
    let site = Some(Site {
        at,
        side,
        approx: false,
    });
    Place::Body(BodyPlace {
        site,
        contact,
        ..BodyPlace::default()
    })
}

fn toward(direction: Direction, size: Option<Size>) -> Motion {
    let size = Amount {
        first: size,
        second: None,
    };
    Motion::new(MotionKind::Directed(Directed {
        direction,
        second: None,
        size,
        curve: None,
        zigzag: None,
        ellipse: None,
    }))
}

/// Returns values and losses of a sign of one part, as one line each.
fn said(part: Manual) -> (Vec<String>, Vec<String>) {
    let sign = Sign { parts: vec![part] };
    let mapped = Mapper::new(builtin()).map(&Notated {
        sign,
        ..Notated::default()
    });
    let line = |it: &MappedValue| {
        format!(
            "{}{}{}",
            it.field,
            if it.exact { "=" } else { "~" },
            it.value
        )
    };
    (mapped.values.iter().map(line).collect(), mapped.lost)
}

fn posture(shape: Handshape, place: Place) -> Posture {
    Posture {
        shape: Each::Shared(shape),
        place: Some(place),
        ..Posture::default()
    }
}

#[test]
fn a_hand_that_follows_by_symmetry_has_values_of_its_own() {
    let mut start = posture(
        flat(),
        at(
            BodyLocation::Chest,
            Some(Side::RightAt),
            Some(Contact::Touch),
        ),
    );
    start.extended = Each::Shared(Aim::at(Direction::LEFT));
    start.palm = Each::Shared(Aim::at(Compass::Dl));
    let symmetry = Symmetry {
        left_right: true,
        ..Symmetry::default()
    };
    let part = Manual {
        hands: HandsUsed::Both(symmetry),
        posture: start,
        actions: vec![toward(Direction::RIGHT, Some(Size::Small))],
        ..Manual::default()
    };
    assert_eq!(
        said(part),
        (
            [
                "dominant.configuration=flat",
                "dominant.orientation.fingers=left",
                "dominant.orientation.palm=down-left",
                "dominant.placement=chest-ipsi",
                "dominant.movement=straight",
                "dominant.movement.direction=right",
                "dominant.movement.size=small",
                "dominant.movement.repetition=once",
                "weak.configuration=flat",
                "weak.orientation.fingers=right",
                "weak.orientation.palm=down-right",
                "weak.placement=chest-ipsi",
                "weak.movement=straight",
                "weak.movement.direction=left",
                "weak.movement.size=small",
                "weak.movement.repetition=once",
            ]
            .map(str::to_owned)
            .to_vec(),
            vec![]
        )
    );
}

#[test]
fn targets_and_replacements_are_final_values() {
    let target = posture(
        shape(HandClass::Fist, None, None),
        at(BodyLocation::Chin, None, Some(Contact::Touch)),
    );
    let closing = Motion::new(MotionKind::Target {
        motion: None,
        posture: Box::new(target),
    });
    let repetition = Repetition::plain(Repeat::FromStart);
    let part = Manual {
        posture: posture(
            flat(),
            at(
                BodyLocation::Forehead,
                Some(Side::RightAt),
                Some(Contact::Close),
            ),
        ),
        actions: vec![Motion::new(MotionKind::Repeated {
            motion: Box::new(closing),
            repetition,
        })],
        ..Manual::default()
    };
    let (values, lost) = said(part);
    assert_eq!(
        values,
        [
            "initial.dominant.configuration=flat",
            "final.dominant.configuration=A",
            "initial.dominant.placement=temple",
            "final.dominant.placement=chin",
            "dominant.movement=closing",
            "dominant.movement=tap",
            "dominant.movement.repetition=twice",
        ]
    );
    assert_eq!(lost, [""; 0]);
}

#[test]
fn places_without_contact_at_the_trunk_are_in_space() {
    for (location, side, contact, expected) in [
        (BodyLocation::Shoulders, None, None, "=high"),
        (
            BodyLocation::Shoulders,
            Some(Side::RightBeside),
            Some(Contact::Close),
            "=high-right-near",
        ),
        (
            BodyLocation::Shoulders,
            Some(Side::RightAt),
            None,
            "~high-right",
        ),
        (
            BodyLocation::Shoulders,
            Some(Side::LeftAt),
            Some(Contact::Touch),
            "=shoulder-contra",
        ),
        (BodyLocation::Chest, None, None, "=neutral"),
        (BodyLocation::Chest, None, Some(Contact::Touch), "=chest"),
        (
            BodyLocation::Stomach,
            Some(Side::LeftBeside),
            Some(Contact::ArmExtended),
            "=low-left-far",
        ),
        (
            BodyLocation::Cheek,
            Some(Side::LeftAt),
            None,
            "=cheek-contra",
        ),
        (BodyLocation::Ear, Some(Side::LeftAt), None, "~ear"),
        (BodyLocation::Nose, Some(Side::RightAt), None, "~nose"),
        (BodyLocation::UpperLip, None, None, "~mouth"),
        (
            BodyLocation::Head,
            Some(Side::RightBeside),
            None,
            "=beside-head",
        ),
    ] {
        let part = Manual {
            posture: posture(flat(), at(location, side, contact)),
            ..Manual::default()
        };
        let (values, _) = said(part);
        assert_eq!(
            values[1],
            format!("dominant.placement{expected}"),
            "{location:?} {side:?} {contact:?}"
        );
    }
}

#[test]
fn handshapes_without_a_value_get_the_nearest_one() {
    for (shape, expected) in [
        (
            shape(HandClass::Flat, Some(ThumbPosition::Across), None),
            "=B",
        ),
        (
            shape(HandClass::Pinch12, Some(ThumbPosition::Across), None),
            "=pinch",
        ),
        (shape(HandClass::Finger2, None, Some(Bend::Hooked)), "~X"),
        (
            Handshape {
                special: Digits(vec![Digit::Little]),
                ..shape(HandClass::Finger2, Some(ThumbPosition::Across), None)
            },
            "=I",
        ),
        (
            Handshape {
                between: Some(flat().form),
                ..shape(HandClass::Flat, None, Some(Bend::Round))
            },
            "~B-round",
        ),
        (
            Handshape {
                form: Form {
                    opening: Some(Opening::Slack),
                    ..Form::default()
                },
                ..shape(HandClass::Fist, None, None)
            },
            "=A",
        ),
    ] {
        let part = Manual {
            posture: posture(shape, at(BodyLocation::Chin, None, None)),
            ..Manual::default()
        };
        assert_eq!(said(part).0[0], format!("dominant.configuration{expected}"));
    }
}

#[test]
fn values_of_a_left_handed_signer_are_the_signers_own_left_and_right() {
    let shown = |place: Place, left_handed: bool| {
        let mut start = posture(flat(), place);
        start.extended = Each::Shared(Aim::at(Direction::LEFT));
        start.palm = Each::Shared(Aim::at(Compass::Dl));
        let part = Manual {
            posture: start,
            actions: vec![toward(Direction::RIGHT, None)],
            ..Manual::default()
        };
        let mut notated = Notated::default();
        notated.sign.parts.push(part);
        let gaze = Act::new(NonmanualPart::Gaze, "LE");
        notated
            .nonmanual
            .push(NonmanualPart::Gaze.tier(), vec![gaze]);
        let mapper = Mapper::new(builtin()).of_left_handed(left_handed);
        let mapped = mapper.map(&notated);
        assert_eq!(mapped.lost, [""; 0]);
        let said = |name: &str| {
            let mut values = mapped.values.iter();
            let value = values.find(|it| it.field.to_string() == name);
            value.map_or("", |it| &it.value).to_owned()
        };
        [
            "dominant.configuration",
            "dominant.orientation.fingers",
            "dominant.orientation.palm",
            "dominant.placement",
            "dominant.movement.direction",
            "nonmanual.gaze",
        ]
        .map(said)
    };
    for (place, right_handed, left_handed) in [
        // In space a side is the signer's own; on the body it counts from the acting hand.
        (
            at(BodyLocation::Shoulders, Some(Side::LeftBeside), None),
            "high-left",
            "high-right",
        ),
        (
            at(BodyLocation::Chest, Some(Side::RightBeside), None),
            "right",
            "left",
        ),
        (
            at(
                BodyLocation::Cheek,
                Some(Side::LeftAt),
                Some(Contact::Touch),
            ),
            "cheek-contra",
            "cheek-contra",
        ),
        (at(BodyLocation::Chin, None, None), "chin", "chin"),
    ] {
        assert_eq!(
            shown(place.clone(), false),
            ["flat", "left", "down-left", right_handed, "right", "left"]
        );
        assert_eq!(
            shown(place, true),
            ["flat", "right", "down-right", left_handed, "left", "left"]
        );
    }
}

#[test]
fn face_and_body_get_values_and_unknown_ones_are_reported() {
    let mut notated = Notated::default();
    for (part, tag) in [
        (NonmanualPart::Brows, "RB_both_eyebrows_raised"),
        (NonmanualPart::Head, "SH"),
        (NonmanualPart::Head, "ND"),
        (NonmanualPart::MouthGesture, "L04"),
        (NonmanualPart::MouthPicture, "hi:r"),
        (NonmanualPart::Gaze, "DN"),
    ] {
        notated
            .nonmanual
            .push(part.tier(), vec![Act::new(part, tag)]);
    }
    let mapped = Mapper::new(builtin()).map(&notated);
    let values: Vec<String> = mapped
        .values
        .iter()
        .map(|it| format!("{}={}", it.field, it.value))
        .collect();
    assert_eq!(
        values,
        [
            "nonmanual.brows=raised",
            "nonmanual.gaze=down",
            "nonmanual.head=shaking",
            "nonmanual.mouth=L04",
            "nonmanual.mouthing=word"
        ]
    );
    assert_eq!(mapped.lost, ["nonmanual.head has no ND"]);
}
