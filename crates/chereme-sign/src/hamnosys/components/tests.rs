//! Notation in the inventories' words, sign by sign.

use super::super::direction::{CompassDirection, SpatialDirection};
use super::super::tree::*;
use super::super::{NonmanualAct, NonmanualPart, NotatedSign};
use super::*;
use crate::inventory::builtin_inventories;

fn flat() -> Handshape {
    shape(HandClass::Flat, None, None)
}

fn shape(class: HandClass, thumb: Option<ThumbPosition>, bend: Option<FingerBend>) -> Handshape {
    let form = HandshapeForm {
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

fn at(at: BodyLocation, side: Option<LocationSide>, contact: Option<PlaceContact>) -> HandPlace {
    let site = Some(SidedLocation {
        at,
        side,
        approx: false,
    });
    HandPlace::Body(BodyPlace {
        site,
        contact,
        ..BodyPlace::default()
    })
}

fn toward(direction: SpatialDirection, size: Option<MotionSize>) -> NotatedMotion {
    let size = SizeAmount {
        first: size,
        second: None,
    };
    NotatedMotion::new(MotionKind::Directed(DirectedPath {
        direction,
        second: None,
        size,
        curve: None,
        zigzag: None,
        ellipse: None,
    }))
}

/// Returns values and losses of a sign of one part, as one line each.
fn said(part: ManualPart) -> (Vec<String>, Vec<String>) {
    let sign = HamnosysSign { parts: vec![part] };
    let mapped = SignMapper::new(builtin_inventories()).map_sign_components(&NotatedSign {
        sign,
        ..NotatedSign::default()
    });
    let line = |it: &MappedValue| format!("{}{}{}", it.field, if it.exact { "=" } else { "~" }, it.value);
    (mapped.values.iter().map(line).collect(), mapped.lost)
}

fn posture(shape: Handshape, place: HandPlace) -> NotatedPosture {
    NotatedPosture {
        shape: EachHand::Shared(shape),
        place: Some(place),
        ..NotatedPosture::default()
    }
}

#[test]
fn a_hand_that_follows_by_symmetry_has_values_of_its_own() {
    let mut start = posture(
        flat(),
        at(
            BodyLocation::Chest,
            Some(LocationSide::RightAt),
            Some(PlaceContact::Touch),
        ),
    );
    start.extended = EachHand::Shared(DirectionAim::aim_at(SpatialDirection::LEFT_DIRECTION));
    start.palm = EachHand::Shared(DirectionAim::aim_at(CompassDirection::Dl));
    let symmetry = HandSymmetry {
        left_right: true,
        ..HandSymmetry::default()
    };
    let part = ManualPart {
        hands: HandsUsed::Both(symmetry),
        posture: start,
        actions: vec![toward(SpatialDirection::RIGHT_DIRECTION, Some(MotionSize::Small))],
        ..ManualPart::default()
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
        at(BodyLocation::Chin, None, Some(PlaceContact::Touch)),
    );
    let closing = NotatedMotion::new(MotionKind::Target {
        motion: None,
        posture: Box::new(target),
    });
    let repetition = MotionRepetition::plain_repetition(RepeatKind::FromStart);
    let part = ManualPart {
        posture: posture(
            flat(),
            at(
                BodyLocation::Forehead,
                Some(LocationSide::RightAt),
                Some(PlaceContact::Close),
            ),
        ),
        actions: vec![NotatedMotion::new(MotionKind::Repeated {
            motion: Box::new(closing),
            repetition,
        })],
        ..ManualPart::default()
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
            Some(LocationSide::RightBeside),
            Some(PlaceContact::Close),
            "=high-right-near",
        ),
        (
            BodyLocation::Shoulders,
            Some(LocationSide::RightAt),
            None,
            "~high-right",
        ),
        (
            BodyLocation::Shoulders,
            Some(LocationSide::LeftAt),
            Some(PlaceContact::Touch),
            "=shoulder-contra",
        ),
        (BodyLocation::Chest, None, None, "=neutral"),
        (BodyLocation::Chest, None, Some(PlaceContact::Touch), "=chest"),
        (
            BodyLocation::Stomach,
            Some(LocationSide::LeftBeside),
            Some(PlaceContact::ArmExtended),
            "=low-left-far",
        ),
        (BodyLocation::Cheek, Some(LocationSide::LeftAt), None, "=cheek-contra"),
        (BodyLocation::Ear, Some(LocationSide::LeftAt), None, "~ear"),
        (BodyLocation::Nose, Some(LocationSide::RightAt), None, "~nose"),
        (BodyLocation::UpperLip, None, None, "~mouth"),
        (
            BodyLocation::Head,
            Some(LocationSide::RightBeside),
            None,
            "=beside-head",
        ),
    ] {
        let part = ManualPart {
            posture: posture(flat(), at(location, side, contact)),
            ..ManualPart::default()
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
        (shape(HandClass::Flat, Some(ThumbPosition::Across), None), "=B"),
        (shape(HandClass::Pinch12, Some(ThumbPosition::Across), None), "=pinch"),
        (shape(HandClass::Finger2, None, Some(FingerBend::Hooked)), "~X"),
        (
            Handshape {
                special: DigitList(vec![HandDigit::Little]),
                ..shape(HandClass::Finger2, Some(ThumbPosition::Across), None)
            },
            "=I",
        ),
        (
            Handshape {
                between: Some(flat().form),
                ..shape(HandClass::Flat, None, Some(FingerBend::Round))
            },
            "~B-round",
        ),
        (
            Handshape {
                form: HandshapeForm {
                    opening: Some(CeeOpening::Slack),
                    ..HandshapeForm::default()
                },
                ..shape(HandClass::Fist, None, None)
            },
            "=A",
        ),
    ] {
        let part = ManualPart {
            posture: posture(shape, at(BodyLocation::Chin, None, None)),
            ..ManualPart::default()
        };
        assert_eq!(said(part).0[0], format!("dominant.configuration{expected}"));
    }
}

#[test]
fn values_of_a_left_handed_signer_are_the_signers_own_left_and_right() {
    let shown = |place: HandPlace, left_handed: bool| {
        let mut start = posture(flat(), place);
        start.extended = EachHand::Shared(DirectionAim::aim_at(SpatialDirection::LEFT_DIRECTION));
        start.palm = EachHand::Shared(DirectionAim::aim_at(CompassDirection::Dl));
        let part = ManualPart {
            posture: start,
            actions: vec![toward(SpatialDirection::RIGHT_DIRECTION, None)],
            ..ManualPart::default()
        };
        let mut notated = NotatedSign::default();
        notated.sign.parts.push(part);
        let gaze = NonmanualAct::new(NonmanualPart::Gaze, "LE");
        notated
            .nonmanual
            .push_act_group(NonmanualPart::Gaze.sigml_tier(), vec![gaze]);
        let mapper = SignMapper::new(builtin_inventories()).of_left_handed(left_handed);
        let mapped = mapper.map_sign_components(&notated);
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
            at(BodyLocation::Shoulders, Some(LocationSide::LeftBeside), None),
            "high-left",
            "high-right",
        ),
        (
            at(BodyLocation::Chest, Some(LocationSide::RightBeside), None),
            "right",
            "left",
        ),
        (
            at(
                BodyLocation::Cheek,
                Some(LocationSide::LeftAt),
                Some(PlaceContact::Touch),
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
    let mut notated = NotatedSign::default();
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
            .push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, tag)]);
    }
    let mapped = SignMapper::new(builtin_inventories()).map_sign_components(&notated);
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
