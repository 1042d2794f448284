//! Laws of SiGML: any sign reads back equal after writing, and any bytes give a document or an error.

use chereme_formats::sigml;
use chereme_sign::hamnosys::{
    BodyAction, BodyLocation, BodyPlace, CeeOpening, CircularPath, ClockRange, CompassDirection, DigitList,
    DirectedPath, DirectionAim, DirectionFrame, EachHand, EllipseAxis, FingerBend, FingerContact, FingerPart,
    HamnosysSign, HandClass, HandConstellation, HandDigit, HandLocation, HandPlace, HandSite, HandSymmetry, HandsUsed,
    Handshape, HandshapeForm, LocationSide, ManualPart, MotionGrowth, MotionKind, MotionManner, MotionRepetition,
    MotionSize, NonmanualAct, NonmanualActs, NonmanualPart, NonmanualTier, NotatedMotion, NotatedPosture, NotatedSign,
    PathCurve, PathZigzag, PlaceContact, RepeatKind, SidedLocation, SizeAmount, SpatialDirection, ThumbExtra,
    ThumbPosition, TierEnd, TierKind, TierStart, WristMotion,
};
use proptest::prelude::*;
use proptest::sample::select;

fn document(manual: &str) -> String {
    format!(
        "<sigml>\n<hamgestural_sign gloss=\"X\">\n<sign_manual>\n{manual}\n</sign_manual>\n</hamgestural_sign>\n</sigml>\n"
    )
}

fn word<T: Copy + std::fmt::Debug + 'static>(words: &'static [T]) -> impl Strategy<Value = T> {
    select(words)
}

fn maybe<T: std::fmt::Debug>(value: impl Strategy<Value = T>) -> impl Strategy<Value = Option<T>> {
    proptest::option::weighted(0.3, value)
}

fn direction() -> impl Strategy<Value = SpatialDirection> {
    select(SpatialDirection::all_spatial_directions().collect::<Vec<_>>())
}

fn compass() -> impl Strategy<Value = CompassDirection> {
    select(CompassDirection::ALL_COMPASS_DIRECTIONS.to_vec())
}

fn size() -> impl Strategy<Value = Option<MotionSize>> {
    maybe(word(&[MotionSize::Small, MotionSize::Big]))
}

fn digit() -> impl Strategy<Value = HandDigit> {
    select(HandDigit::ALL_HAND_DIGITS.to_vec())
}

fn digits() -> impl Strategy<Value = DigitList> {
    proptest::sample::subsequence(HandDigit::ALL_HAND_DIGITS.to_vec(), 0..=2).prop_map(DigitList)
}

fn side() -> impl Strategy<Value = Option<LocationSide>> {
    maybe(word(&[
        LocationSide::LeftBeside,
        LocationSide::RightAt,
        LocationSide::Front,
        LocationSide::Dorsal,
        LocationSide::Ulnar,
    ]))
}

fn bend() -> BoxedStrategy<FingerBend> {
    prop_oneof![
        word(&[
            FingerBend::Bent,
            FingerBend::Round,
            FingerBend::Hooked,
            FingerBend::DoubleBent,
            FingerBend::DoubleHooked,
            FingerBend::HalfBent
        ]),
        proptest::array::uniform3(0.0..4.0).prop_map(FingerBend::Joints),
        proptest::array::uniform3(0u8..=4).prop_map(|joints| FingerBend::Joints(joints.map(f64::from))),
    ]
    .boxed()
}

fn form() -> BoxedStrategy<HandshapeForm> {
    let class = word(&[
        HandClass::Fist,
        HandClass::Flat,
        HandClass::Pinch12Open,
        HandClass::CeeAll,
    ]);
    let thumb = maybe(word(&[
        ThumbPosition::Out,
        ThumbPosition::Across,
        ThumbPosition::Opposed,
    ]));
    let opening = maybe(word(&[CeeOpening::Tight, CeeOpening::Slack]));
    (class, thumb, maybe(bend()), opening)
        .prop_map(|(class, thumb, bend, opening)| HandshapeForm {
            class,
            thumb,
            bend,
            opening,
        })
        .boxed()
}

fn part_of_finger() -> impl Strategy<Value = FingerPart> {
    word(&[FingerPart::Tip, FingerPart::Nail, FingerPart::MidJoint])
}

fn handshape() -> BoxedStrategy<Handshape> {
    let contact = (digit(), digit(), maybe(part_of_finger()));
    let contact = contact.prop_map(|(first, second, part)| FingerContact { first, second, part });
    let thumb = prop_oneof![
        (digit(), digit()).prop_map(|(a, b)| ThumbExtra::Between(a, b)),
        Just(ThumbExtra::Enclosed),
        part_of_finger().prop_map(ThumbExtra::Contact),
    ];
    let forms = (form(), maybe(form()), any::<bool>(), maybe(0u8..=2));
    let fingers = (
        digits(),
        digits(),
        maybe(digit()),
        proptest::array::uniform5(maybe(bend())),
    );
    let rest = (proptest::collection::vec(contact, 0..=2), maybe(thumb));
    (forms, fingers, rest)
        .prop_map(
            |((form, between, approx, splay), (special, exempt, opposed, bends), (contacts, thumb))| Handshape {
                form,
                between,
                approx,
                splay,
                special,
                exempt,
                opposed,
                bends,
                contacts,
                thumb,
                ..Handshape::default()
            },
        )
        .boxed()
}

fn aim<D: std::fmt::Debug + Clone + 'static>(
    direction: impl Strategy<Value = D> + Clone + 'static,
) -> impl Strategy<Value = DirectionAim<D>> {
    let frame = word(&[
        DirectionFrame::Plain,
        DirectionFrame::Plain,
        DirectionFrame::Absolute,
        DirectionFrame::Relative,
    ]);
    (direction.clone(), maybe(direction), any::<bool>(), frame).prop_map(|(first, second, approx, frame)| {
        DirectionAim {
            first,
            second,
            approx,
            frame,
        }
    })
}

fn each<T: std::fmt::Debug + Clone + 'static>(
    one: impl Strategy<Value = T> + Clone + 'static,
) -> impl Strategy<Value = EachHand<T>> {
    let split = (maybe(one.clone()), maybe(one.clone()));
    prop_oneof![
        Just(EachHand::Unset),
        one.prop_map(EachHand::Shared),
        split.prop_filter_map("a split says something", |(a, b)| {
            (a.is_some() || b.is_some()).then_some(EachHand::Split(a, b))
        }),
    ]
}

fn hand_site() -> BoxedStrategy<HandSite> {
    let at = word(&[
        HandLocation::Palm,
        HandLocation::Tip,
        HandLocation::WristBack,
        HandLocation::Elbow,
    ]);
    let simple = (at, digits(), side(), any::<bool>()).prop_map(|(at, digits, side, approx)| HandSite {
        at: Some(at),
        digits,
        side,
        approx,
        ..HandSite::default()
    });
    let simple = simple.boxed();
    let contact = maybe(word(&[
        PlaceContact::Touch,
        PlaceContact::Close,
        PlaceContact::Interlock,
        PlaceContact::Brushing,
    ]));
    (
        simple.clone(),
        maybe(simple.clone()),
        contact,
        maybe(simple),
        maybe(1u8..=5),
    )
        .prop_map(|(site, second, contact, by, define)| HandSite {
            second: second.map(Box::new),
            contact,
            by: by.map(Box::new),
            define,
            ..site
        })
        .boxed()
}

fn body_place() -> BoxedStrategy<BodyPlace> {
    let site = || {
        let at = word(&[
            BodyLocation::Chin,
            BodyLocation::Chest,
            BodyLocation::NeutralSpace,
            BodyLocation::UpperEyelid,
        ]);
        maybe((at, side(), any::<bool>()).prop_map(|(at, side, approx)| SidedLocation { at, side, approx }))
    };
    let contact = maybe(word(&[
        PlaceContact::Touch,
        PlaceContact::Close,
        PlaceContact::ArmExtended,
        PlaceContact::Brushing,
    ]));
    (
        site(),
        site(),
        any::<bool>(),
        contact,
        maybe(hand_site()),
        maybe(1u8..=5),
    )
        .prop_map(|(site, second, behind, contact, by, define)| BodyPlace {
            site,
            second,
            behind,
            contact,
            by,
            define,
            ..BodyPlace::default()
        })
        .boxed()
}

fn place() -> BoxedStrategy<HandPlace> {
    let hands = (
        maybe(hand_site()),
        maybe(hand_site()),
        maybe(word(&[PlaceContact::Touch, PlaceContact::Cross])),
        maybe(body_place()),
        maybe(1u8..=5),
    );
    let hands = hands.prop_map(|(dominant, other, contact, at, define)| {
        HandPlace::Hands(HandConstellation {
            dominant,
            other,
            contact,
            at,
            define,
            ..HandConstellation::default()
        })
    });
    let one = prop_oneof![
        body_place().prop_map(HandPlace::Body),
        hand_site().prop_map(HandPlace::Hand),
        hands,
        (1u8..=5).prop_map(HandPlace::Named),
    ];
    let one = one.boxed();
    let half = maybe(one.clone().prop_map(Box::new));
    prop_oneof![3 => one.clone(), 1 => (half, maybe(one.prop_map(Box::new))).prop_map(|(a, b)| HandPlace::Split(a, b))]
        .boxed()
}

fn posture() -> BoxedStrategy<NotatedPosture> {
    let shape = each(handshape().boxed());
    let extended = each(aim(direction().boxed()).boxed());
    let palm = each(aim(compass().boxed()).boxed());
    (shape, extended, palm, maybe(place()))
        .prop_map(|(shape, extended, palm, place)| NotatedPosture {
            shape,
            extended,
            palm,
            place,
        })
        .boxed()
}

fn growth() -> BoxedStrategy<Option<MotionGrowth>> {
    maybe((any::<bool>(), size()).prop_map(|(increasing, size)| MotionGrowth { increasing, size })).boxed()
}

fn zigzag() -> BoxedStrategy<Option<PathZigzag>> {
    maybe((any::<bool>(), size(), growth()).prop_map(|(wavy, size, growth)| PathZigzag { wavy, size, growth })).boxed()
}

fn amount() -> impl Strategy<Value = SizeAmount> {
    (size(), size()).prop_map(|(first, second)| SizeAmount { first, second })
}

fn ellipse() -> impl Strategy<Value = Option<EllipseAxis>> {
    maybe(word(&[
        EllipseAxis::Horizontal,
        EllipseAxis::UpRight,
        EllipseAxis::Vertical,
        EllipseAxis::UpLeft,
    ]))
}

fn manner() -> BoxedStrategy<MotionManner> {
    (any::<[bool; 9]>(), maybe(0.1..3.0))
        .prop_map(
            |(
                [
                    fast,
                    slow,
                    tense,
                    rest,
                    halt,
                    bouncing,
                    alternating,
                    second_alternating,
                    absolute,
                ],
                speed,
            )| {
                MotionManner {
                    fast,
                    slow,
                    tense,
                    rest,
                    halt,
                    bouncing,
                    alternating,
                    second_alternating,
                    absolute,
                    speed,
                }
            },
        )
        .boxed()
}

fn simple() -> BoxedStrategy<MotionKind> {
    let curve = maybe((compass(), size()).prop_map(|(to, size)| PathCurve { to, size }));
    let directed = (direction(), maybe(direction()), amount(), curve, zigzag(), ellipse());
    let directed = directed.prop_map(|(direction, second, size, curve, zigzag, ellipse)| {
        MotionKind::Directed(DirectedPath {
            direction,
            second,
            size,
            curve,
            zigzag,
            ellipse,
        })
    });
    let clock =
        (maybe(compass()), maybe(compass()), 0u8..=2).prop_map(|(start, end, full)| ClockRange { start, end, full });
    let circular = (
        direction(),
        maybe(direction()),
        amount(),
        ellipse(),
        size(),
        clock,
        zigzag(),
        growth(),
    );
    let circular = circular.prop_map(|(axis, second, size, ellipse, ellipse_size, clock, zigzag, growth)| {
        MotionKind::Circular(CircularPath {
            axis,
            second,
            size,
            ellipse,
            ellipse_size,
            clock,
            zigzag,
            growth,
        })
    });
    let wrist = (word(&[WristMotion::Nodding, WristMotion::StirCcw]), size());
    prop_oneof![
        directed,
        circular,
        wrist.prop_map(|(motion, size)| MotionKind::Wrist { motion, size }),
        any::<bool>().prop_map(|diagonal| MotionKind::Cross { diagonal }),
        digits().prop_map(MotionKind::FingerPlay),
        Just(MotionKind::Still),
    ]
    .boxed()
}

fn motion() -> BoxedStrategy<NotatedMotion> {
    let with = |kind: BoxedStrategy<MotionKind>| {
        (kind, manner()).prop_map(|(kind, manner)| NotatedMotion {
            manner,
            ..NotatedMotion::new(kind)
        })
    };
    with(simple().boxed())
        .prop_recursive(3, 8, 3, move |inner| {
            let several = proptest::collection::vec(inner.clone(), 2..=3);
            let boxed = inner.clone().prop_map(Box::new).boxed();
            let repeat = word(&[RepeatKind::FromStart, RepeatKind::ContinueSeveral, RepeatKind::Swap]).boxed();
            let repetition = (
                repeat.clone(),
                maybe(repeat),
                growth(),
                maybe(direction()),
                size(),
                growth(),
                any::<bool>(),
            );
            let repetition =
                repetition.prop_map(|(repeat, second, growth, shift, shift_size, shift_growth, approx)| {
                    MotionRepetition {
                        repeat,
                        second,
                        growth,
                        shift,
                        shift_size,
                        shift_growth,
                        approx,
                    }
                });
            let kind = prop_oneof![
                (several.clone(), any::<bool>()).prop_map(|(motions, fused)| MotionKind::Sequence { motions, fused }),
                several.prop_map(MotionKind::Parallel),
                (boxed.clone(), boxed.clone()).prop_map(|(a, b)| MotionKind::Split(Some(a), Some(b))),
                (maybe(boxed.clone()), posture().prop_map(Box::new))
                    .prop_map(|(motion, posture)| MotionKind::Target { motion, posture }),
                (boxed.clone(), repetition)
                    .prop_map(|(motion, repetition)| MotionKind::Repeated { motion, repetition }),
                (maybe(boxed), side()).prop_map(|(motion, side)| {
                    MotionKind::Body(BodyAction {
                        part: BodyLocation::Shoulders,
                        side,
                        motion,
                    })
                }),
            ];
            with(kind.boxed())
        })
        .boxed()
}

fn manual() -> BoxedStrategy<ManualPart> {
    let symmetry = any::<[bool; 5]>().prop_map(|[left_right, up_down, out_in, out_of_phase, real_space]| {
        HandsUsed::Both(HandSymmetry {
            left_right,
            up_down,
            out_in,
            out_of_phase,
            real_space,
        })
    });
    let hands = prop_oneof![Just(HandsUsed::Dominant), Just(HandsUsed::Nondominant), symmetry];
    let body = (side(), maybe(motion().prop_map(Box::new))).prop_map(|(side, motion)| BodyAction {
        part: BodyLocation::Head,
        side,
        motion,
    });
    (
        hands,
        any::<bool>(),
        proptest::collection::vec(body, 0..=1),
        posture(),
        proptest::collection::vec(motion(), 0..=2),
    )
        .prop_map(|(hands, holdover, body, posture, actions)| ManualPart {
            hands,
            holdover,
            body,
            posture,
            actions,
            ..ManualPart::default()
        })
        .boxed()
}

const NONMANUAL_PARTS: [NonmanualPart; 12] = [
    NonmanualPart::Shoulders,
    NonmanualPart::Body,
    NonmanualPart::Head,
    NonmanualPart::Gaze,
    NonmanualPart::Brows,
    NonmanualPart::Lids,
    NonmanualPart::Nose,
    NonmanualPart::MouthGesture,
    NonmanualPart::MouthPicture,
    NonmanualPart::MouthMeta,
    NonmanualPart::Extra,
    NonmanualPart::Neutral,
];

const TIER_KINDS: [TierKind; 7] = [
    TierKind::Shoulder,
    TierKind::Body,
    TierKind::Head,
    TierKind::EyeGaze,
    TierKind::FacialExpr,
    TierKind::Mouthing,
    TierKind::Extra,
];

fn nonmanual() -> BoxedStrategy<NonmanualActs> {
    let act = (
        select(NONMANUAL_PARTS.to_vec()),
        "[A-Z]{2}|[A-Z][0-9]{2}_[a-z]{3}|[a-z:@]{1,4}",
        maybe(0.1..2.0),
        maybe(0.1..2.0),
    );
    let act = act.prop_map(|(part, tag, amount, speed)| NonmanualAct {
        part,
        tag,
        amount,
        speed,
    });
    let start = maybe(word(&[TierStart::SlightDelay, TierStart::StartSlightlyAhead]));
    let end = maybe(word(&[TierEnd::LastsLonger, TierEnd::EndsBefore]));
    let groups = proptest::collection::vec(proptest::collection::vec(act, 1..=3), 1..=3);
    let tier = (start, end, any::<bool>(), groups);
    proptest::collection::btree_map(select(TIER_KINDS.to_vec()), tier, 0..=3)
        .prop_map(|tiers| {
            let tiers = tiers.into_iter().map(|(kind, (start, end, fit, groups))| {
                let fit_picture = fit && kind == TierKind::Mouthing;
                (
                    kind,
                    NonmanualTier {
                        start,
                        end,
                        fit_picture,
                        groups,
                    },
                )
            });
            NonmanualActs { tiers: tiers.collect() }
        })
        .boxed()
}

fn notated() -> BoxedStrategy<NotatedSign> {
    let header = ("[A-Z<>&\"'é]{1,8}", maybe("[a-z]{3}"), maybe(0.1..3.0), maybe(0.1..3.0));
    (header, proptest::collection::vec(manual(), 1..=2), nonmanual())
        .prop_map(|((gloss, language, speed, duration), parts, nonmanual)| NotatedSign {
            gloss,
            sign_language: language.clone(),
            gloss_language: language,
            speed,
            timescale: speed,
            duration,
            text: None,
            sign: HamnosysSign { parts },
            nonmanual,
        })
        .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_sign_reads_back_unchanged_from_gestural_sigml(signs in proptest::collection::vec(notated(), 1..=2)) {
        let text = sigml::write_gestural(&signs);
        let (again, _) = sigml::read_sigml_signs(&text).expect("we wrote it");
        let again: Vec<_> = again.into_iter().map(|entry| entry.sign).collect();
        prop_assert_eq!(again, signs);
    }

    #[test]
    fn any_bytes_are_a_document_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = sigml::read_sigml_signs(&bytes);
    }

    #[test]
    fn any_bytes_within_a_document_are_a_document_or_an_error(at in 0usize..200, bytes in "[ -~<>&;/\"é\n]{1,12}") {
        let mut text = document("<handconfig extfidir=\"u\"/><directedmotion direction=\"ol\" size=\"big\"/>");
        let at = at.min(text.len());
        text.insert_str(at, &bytes);
        let _ = sigml::read_sigml_signs(text.as_bytes());
    }
}
