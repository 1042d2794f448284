//! Tests laws of reading and writing, on random trees and texts.

use crate::hamnosys::parse_hamnosys;
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::{select, subsequence};

use super::tree::*;
use super::{CompassDirection, HamnosysSymbol, SpatialDirection, parse_lenient, print_hamnosys};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_printed_sign_reads_back_unchanged(parts in vec(manual_strategy(), 1..3)) {
        let sign = HamnosysSign { parts };
        let printed = print_hamnosys(&sign);
        let read = parse_hamnosys(&printed.text);
        prop_assert_eq!(read.as_ref().map(|read| &read.sign), Ok(&sign), "{}", symbol_names_text(&printed.text));
        prop_assert_eq!(&printed.losses, &[]);
        let read = read.expect("just seen");
        prop_assert_eq!(&read.findings, &[], "{}", symbol_names_text(&printed.text));
        prop_assert_eq!(read.transcription_text(), printed.text);
    }

    #[test]
    fn no_string_of_symbols_panics_and_all_print_as_they_were(
        symbols in vec(0..209_usize, 0..60),
        odd in "[a-z ,{}|?+\u{e0f8}\u{e000}]{0,6}",
    ) {
        let mut text: String = symbols.iter().filter_map(|at| HamnosysSymbol::all_symbols().nth(*at)).map(HamnosysSymbol::symbol_char).collect();
        text.push_str(&odd);
        prop_assert_eq!(parse_lenient(&text).transcription_text(), text.clone());
        if let Ok(read) = parse_hamnosys(&text) {
            prop_assert_eq!(read.transcription_text(), text);
        }
    }

    #[test]
    fn a_symbol_changed_anywhere_is_read_or_refused_with_its_place(
        part in manual_strategy(), at in 0..200_usize, other in 0..209_usize,
    ) {
        let mut text: Vec<char> = print_hamnosys(&HamnosysSign { parts: vec![part] }).text.chars().collect();
        let position = at % text.len();
        text[position] = HamnosysSymbol::all_symbols().nth(other).map_or('?', HamnosysSymbol::symbol_char);
        let count = text.len();
        let text: String = text.into_iter().collect();
        match parse_hamnosys(&text) {
            Ok(read) => prop_assert_eq!(read.transcription_text(), text),
            Err(error) => {
                prop_assert!(error.index().is_some_and(|index| index <= count), "{error}");
                let read = parse_lenient(&text);
                prop_assert!(read.is_partial());
                prop_assert_eq!(read.transcription_text(), text);
            }
        }
    }
}

fn symbol_names_text(text: &str) -> String {
    super::to_names(text).unwrap_or_default().join(" ")
}

fn manual_strategy() -> BoxedStrategy<ManualPart> {
    (
        hands_used_strategy(),
        body_action_strategy(),
        vec(motion_strategy(), 0..4),
    )
        .prop_flat_map(|(hands, body, actions)| {
            let two = matches!(hands, HandsUsed::Both(_));
            posture_strategy(two).prop_map(move |posture| ManualPart {
                hands,
                body: body.clone(),
                posture,
                actions: actions.clone(),
                ..ManualPart::default()
            })
        })
        .boxed()
}

fn hands_used_strategy() -> BoxedStrategy<HandsUsed> {
    let symmetry = any::<[bool; 5]>().prop_map(|[left_right, up_down, out_in, out_of_phase, real_space]| {
        HandsUsed::Both(HandSymmetry {
            left_right,
            up_down,
            out_in,
            out_of_phase,
            real_space,
        })
    });
    prop_oneof![Just(HandsUsed::Dominant), Just(HandsUsed::Nondominant), symmetry].boxed()
}

fn body_action_strategy() -> BoxedStrategy<Vec<BodyAction>> {
    let part = select(vec![
        BodyLocation::Head,
        BodyLocation::Shoulders,
        BodyLocation::LowerArm,
    ]);
    vec(
        (part, option::of(side_strategy()), option::of(simple_motion_strategy())).prop_map(|(part, side, kind)| {
            BodyAction {
                part,
                side,
                motion: kind.map(|kind| Box::new(NotatedMotion::new(kind))),
            }
        }),
        0..2,
    )
    .boxed()
}

/// A posture with at least a direction, so that fingers of the shape are not read as a place.
fn posture_strategy(two: bool) -> BoxedStrategy<NotatedPosture> {
    (
        each_hand_strategy(handshape_strategy()),
        option::of(any::<bool>()),
        (
            aim_strategy(select(SpatialDirection::all_spatial_directions().collect::<Vec<_>>())),
            aim_strategy(compass_strategy()),
        ),
        option::of(place_strategy(two)),
    )
        .prop_map(move |(shape, palms, (extended, palm), place)| NotatedPosture {
            shape,
            extended: EachHand::Shared(extended),
            palm: match palms {
                None => EachHand::Unset,
                Some(true) => EachHand::Shared(palm),
                Some(false) if two => EachHand::Split(Some(palm), None),
                Some(false) => EachHand::Shared(palm),
            },
            place,
        })
        .boxed()
}

fn each_hand_strategy<T: Clone + std::fmt::Debug>(
    one: impl Strategy<Value = T> + Clone,
) -> impl Strategy<Value = EachHand<T>> {
    prop_oneof![
        3 => one.clone().prop_map(EachHand::Shared),
        1 => (one.clone(), option::of(one)).prop_map(|(a, b)| EachHand::Split(Some(a), b)),
    ]
}

fn aim_strategy<D: Copy + std::fmt::Debug>(
    one: impl Strategy<Value = D> + Clone,
) -> impl Strategy<Value = DirectionAim<D>> {
    (one.clone(), option::of(one), any::<bool>(), any::<bool>()).prop_map(|(first, second, approx, relative)| {
        DirectionAim {
            first,
            second,
            approx,
            frame: if relative {
                DirectionFrame::Relative
            } else {
                DirectionFrame::Plain
            },
        }
    })
}

fn compass_strategy() -> impl Strategy<Value = CompassDirection> + Clone {
    select(CompassDirection::ALL_COMPASS_DIRECTIONS.to_vec())
}

fn bend_strategy() -> impl Strategy<Value = FingerBend> + Clone {
    select(vec![
        FingerBend::Bent,
        FingerBend::Round,
        FingerBend::Hooked,
        FingerBend::DoubleBent,
        FingerBend::DoubleHooked,
        FingerBend::Joints([3.0, 1.0, 1.0]),
        FingerBend::Joints([2.0, 4.0, 2.0]),
    ])
}

fn form_strategy() -> BoxedStrategy<HandshapeForm> {
    use HandClass as C;
    let class = select(vec![
        C::Fist,
        C::Flat,
        C::Finger2,
        C::Finger23,
        C::Finger23Spread,
        C::Finger2345,
        C::Pinch12,
        C::Pinch12Open,
        C::PinchAll,
        C::Cee12,
        C::Cee12Open,
        C::CeeAll,
    ]);
    let thumb = select(vec![ThumbPosition::Out, ThumbPosition::Across, ThumbPosition::Opposed]);
    (class, option::of(thumb), option::of(bend_strategy()))
        .prop_map(|(class, thumb, bend)| {
            let cee = matches!(class, C::Cee12 | C::Cee12Open | C::CeeAll);
            let opening = match thumb {
                Some(ThumbPosition::Across) if cee => Some(CeeOpening::Tight),
                Some(ThumbPosition::Opposed) if cee => Some(CeeOpening::Slack),
                _ => None,
            };
            HandshapeForm {
                class,
                thumb: thumb.filter(|_| opening.is_none()),
                bend,
                opening,
            }
        })
        .boxed()
}

fn handshape_strategy() -> BoxedStrategy<Handshape> {
    let digits = subsequence(HandDigit::ALL_HAND_DIGITS[1..].to_vec(), 0..4);
    let contact = (digit_strategy(), option::of(finger_part()), digit_strategy())
        .prop_map(|(first, part, second)| FingerContact { first, second, part });
    let thumb = prop_oneof![
        (digit_strategy(), digit_strategy()).prop_map(|(one, two)| ThumbExtra::Between(one, two)),
        Just(ThumbExtra::Enclosed),
        finger_part().prop_map(ThumbExtra::Contact),
    ];
    (
        form_strategy(),
        option::weighted(0.3, form_strategy()),
        digits,
        (any::<bool>(), any::<bool>()),
        option::weighted(0.3, (digit_strategy(), bend_strategy())),
        (vec(contact, 0..2), option::weighted(0.2, thumb)),
    )
        .prop_map(|(form, between, digits, (approx, opposed), bend, (contacts, thumb))| {
            let (special, exempt) = split_chosen_digits(&form, between.as_ref(), digits);
            let mut bends = [None; 5];
            if let Some((digit, bend)) = bend {
                bends[digit as usize] = Some(bend);
            }
            let opposed = special.0.first().copied().filter(|_| opposed);
            Handshape {
                form,
                between,
                approx,
                special,
                exempt,
                opposed,
                bends,
                contacts,
                thumb,
                ..Handshape::default()
            }
        })
        .boxed()
}

/// The selected fingers and those that the bend leaves out, as far as the classes allow.
fn split_chosen_digits(
    form: &HandshapeForm,
    between: Option<&HandshapeForm>,
    digits: Vec<HandDigit>,
) -> (DigitList, DigitList) {
    use HandClass as C;
    let bent = form.bend.is_some() || between.is_some_and(|form| form.bend.is_some());
    let exempt = match form.class {
        C::PinchAll | C::CeeAll => true,
        C::Fist | C::Flat | C::Finger2345 => bent,
        C::Finger23 | C::Finger23Spread => digits.len() < 2,
        _ => false,
    };
    let digits = DigitList(digits);
    if exempt {
        (DigitList::default(), digits)
    } else {
        (digits, DigitList::default())
    }
}

fn digit_strategy() -> impl Strategy<Value = HandDigit> + Clone {
    select(HandDigit::ALL_HAND_DIGITS.to_vec())
}

fn finger_part() -> impl Strategy<Value = FingerPart> + Clone {
    use FingerPart as P;
    select(vec![P::Tip, P::Nail, P::Pad, P::MidJoint, P::Base, P::Side])
}

fn side_strategy() -> impl Strategy<Value = LocationSide> + Clone {
    select(vec![
        LocationSide::LeftBeside,
        LocationSide::LeftAt,
        LocationSide::RightAt,
        LocationSide::RightBeside,
    ])
}

fn body_site_strategy() -> BoxedStrategy<SidedLocation<BodyLocation>> {
    use BodyLocation as L;
    let location = select(vec![
        L::Head,
        L::HeadTop,
        L::Eyes,
        L::UpperEyelid,
        L::LowerLip,
        L::Teeth,
        L::Chin,
        L::Neck,
        L::Shoulders,
        L::Chest,
        L::BelowStomach,
        L::Ear,
        L::UpperArm,
        L::ElbowInside,
    ]);
    (location, option::of(side_strategy()), any::<bool>())
        .prop_map(|(at, side, approx)| SidedLocation { at, side, approx })
        .boxed()
}

fn contact_strategy() -> impl Strategy<Value = PlaceContact> + Clone {
    select(vec![
        PlaceContact::Touch,
        PlaceContact::Close,
        PlaceContact::Cross,
        PlaceContact::ArmExtended,
    ])
}

fn body_place_strategy() -> BoxedStrategy<BodyPlace> {
    (
        body_site_strategy(),
        option::of(body_site_strategy()),
        any::<bool>(),
        option::of((contact_strategy(), option::of(hand_site_strategy()))),
        option::of(1..=5_u8),
    )
        .prop_map(|(site, second, behind, contact, define)| {
            let (contact, by) = contact.map_or((None, None), |(contact, by)| (Some(contact), by));
            BodyPlace {
                site: Some(site),
                second,
                behind,
                contact,
                by,
                define,
                ..BodyPlace::default()
            }
        })
        .boxed()
}

fn hand_site_strategy() -> BoxedStrategy<HandSite> {
    (one_hand_site(), option::weighted(0.3, one_hand_site()))
        .prop_map(|(mut site, second)| {
            site.second = second.map(Box::new);
            site
        })
        .boxed()
}

fn one_hand_site() -> BoxedStrategy<HandSite> {
    use HandLocation as H;
    let part = select(vec![
        H::WristBack,
        H::ThumbBall,
        H::Palm,
        H::HandBack,
        H::ThumbSide,
        H::PinkySide,
    ]);
    let finger = select(vec![H::Tip, H::Nail, H::Pad, H::MidJoint, H::Base, H::Side]);
    let digits = subsequence(HandDigit::ALL_HAND_DIGITS.to_vec(), 0..3);
    let sides = prop_oneof![
        side_strategy(),
        select(vec![
            LocationSide::Palmar,
            LocationSide::Dorsal,
            LocationSide::Radial,
            LocationSide::Ulnar
        ])
    ];
    let hand_place = prop_oneof![
        part.prop_map(|part| (Some(part), Vec::new())),
        (finger, digits.clone()).prop_map(|(part, digits)| (Some(part), digits)),
        digit_strategy().prop_map(|digit| (None, vec![digit])),
    ];
    (hand_place, option::of(sides), any::<bool>())
        .prop_map(|((at, digits), side, approx)| HandSite {
            at,
            digits: DigitList(digits),
            side,
            approx,
            ..HandSite::default()
        })
        .boxed()
}

fn place_strategy(two: bool) -> BoxedStrategy<HandPlace> {
    let neutral = option::of(Just(PlaceContact::ArmExtended)).prop_map(|contact| {
        HandPlace::Body(BodyPlace {
            contact,
            ..BodyPlace::default()
        })
    });
    let hand = (
        hand_site_strategy(),
        contact_strategy(),
        option::of(hand_site_strategy()),
    )
        .prop_map(|(mut site, contact, by)| {
            site.contact = Some(contact);
            site.by = by.map(Box::new);
            HandPlace::Hand(site)
        });
    let one = prop_oneof![
        4 => body_place_strategy().prop_map(HandPlace::Body),
        1 => neutral,
        3 => hand.clone(),
        1 => (1..=5_u8).prop_map(HandPlace::Named),
    ];
    let hands = (
        option::of((hand_site_strategy(), hand_site_strategy())),
        contact_strategy(),
        option::of(body_place_strategy()),
    )
        .prop_map(|(sites, contact, at)| {
            let (dominant, other) = sites.map_or((None, None), |(a, b)| (Some(a), Some(b)));
            HandConstellation {
                dominant,
                other,
                contact: Some(contact),
                at,
                ..HandConstellation::default()
            }
        })
        .prop_filter("far away is no relation of hands alone", |hands| {
            hands.dominant.is_some() || hands.contact != Some(PlaceContact::ArmExtended)
        });
    let split = (body_place_strategy(), option::of(hand))
        .prop_map(|(body, hand)| HandPlace::Split(Some(Box::new(HandPlace::Body(body))), hand.map(Box::new)));
    let hands = hands.prop_map(HandPlace::Hands);
    if two {
        prop_oneof![2 => one, 1 => hands, 1 => split].boxed()
    } else {
        prop_oneof![3 => one, 1 => hands].boxed()
    }
}

fn size_strategy() -> impl Strategy<Value = Option<MotionSize>> + Clone {
    select(vec![None, Some(MotionSize::Small), Some(MotionSize::Big)])
}

fn growth_strategy() -> impl Strategy<Value = Option<MotionGrowth>> + Clone {
    option::weighted(
        0.3,
        (any::<bool>(), size_strategy()).prop_map(|(increasing, size)| MotionGrowth { increasing, size }),
    )
}

/// A size; always present, so that two successive movements do not read as a corner.
fn amount_strategy() -> impl Strategy<Value = SizeAmount> + Clone {
    let some = select(vec![MotionSize::Small, MotionSize::Big]);
    (some.clone(), option::weighted(0.2, some)).prop_map(|(first, second)| SizeAmount {
        first: Some(first),
        second,
    })
}

fn simple_motion_strategy() -> BoxedStrategy<MotionKind> {
    let direction = select(SpatialDirection::all_spatial_directions().collect::<Vec<_>>());
    let curve = (compass_strategy(), size_strategy()).prop_map(|(to, size)| PathCurve { to, size });
    let zigzag = (any::<bool>(), size_strategy(), growth_strategy()).prop_map(|(wavy, size, growth)| PathZigzag {
        wavy,
        size,
        growth,
    });
    let ellipse = select(vec![
        EllipseAxis::Horizontal,
        EllipseAxis::UpRight,
        EllipseAxis::Vertical,
        EllipseAxis::UpLeft,
    ]);
    let clock =
        (option::of(compass_strategy()), option::of(compass_strategy()), 0..3_u8).prop_map(|(start, end, full)| {
            ClockRange {
                start,
                end: end.filter(|_| start.is_some()),
                full,
            }
        });
    let directed = (
        direction.clone(),
        option::of(direction.clone()),
        amount_strategy(),
        option::of(curve),
        option::of(zigzag.clone()),
        option::of(ellipse.clone()),
    )
        .prop_map(|(direction, second, size, curve, zigzag, ellipse)| {
            MotionKind::Directed(DirectedPath {
                direction,
                second,
                size,
                curve,
                zigzag,
                ellipse,
            })
        });
    let circular = (
        direction.clone(),
        option::of(direction),
        amount_strategy(),
        option::of((ellipse, size_strategy())),
        clock,
        option::of(zigzag),
        growth_strategy(),
    )
        .prop_map(|(axis, second, size, ellipse, clock, zigzag, growth)| {
            MotionKind::Circular(CircularPath {
                axis,
                second,
                size,
                ellipse: ellipse.map(|(ellipse, _)| ellipse),
                ellipse_size: ellipse.and_then(|(_, size)| size),
                clock,
                zigzag,
                growth: growth.filter(|_| zigzag.is_none()),
            })
        });
    let wrist = select(vec![
        WristMotion::Nodding,
        WristMotion::Swinging,
        WristMotion::Twisting,
        WristMotion::StirCw,
        WristMotion::StirCcw,
    ]);
    prop_oneof![
        4 => directed,
        2 => circular,
        1 => (wrist, size_strategy()).prop_map(|(motion, size)| MotionKind::Wrist { motion, size }),
        1 => any::<bool>().prop_map(|diagonal| MotionKind::Cross { diagonal }),
        1 => Just(MotionKind::Still),
    ]
    .boxed()
}

fn manner_strategy() -> BoxedStrategy<MotionManner> {
    any::<[bool; 7]>()
        .prop_map(|[fast, slow, tense, rest, halt, alternating, again]| MotionManner {
            fast,
            slow,
            tense,
            rest,
            halt,
            alternating,
            second_alternating: alternating && again,
            ..MotionManner::default()
        })
        .boxed()
}

fn repetition_strategy() -> BoxedStrategy<MotionRepetition> {
    use RepeatKind as R;
    let repeat = select(vec![
        R::FromStart,
        R::FromStartSeveral,
        R::Continue,
        R::ContinueSeveral,
        R::Reverse,
    ]);
    let shift = (
        select(SpatialDirection::all_spatial_directions().collect::<Vec<_>>()),
        size_strategy(),
        growth_strategy(),
    );
    (
        repeat.clone(),
        option::weighted(0.2, repeat),
        growth_strategy(),
        option::weighted(0.3, shift),
        any::<bool>(),
    )
        .prop_map(|(repeat, second, growth, shift, approx)| MotionRepetition {
            repeat,
            second,
            growth,
            shift: shift.map(|shift| shift.0),
            shift_size: shift.and_then(|shift| shift.1),
            shift_growth: shift.and_then(|shift| shift.2),
            approx,
        })
        .boxed()
}

fn motion_strategy() -> BoxedStrategy<NotatedMotion> {
    let digits = subsequence(HandDigit::ALL_HAND_DIGITS.to_vec(), 0..3)
        .prop_map(|digits| MotionKind::FingerPlay(DigitList(digits)));
    let change = posture_strategy(false).prop_map(|posture| MotionKind::Target {
        motion: None,
        posture: Box::new(posture),
    });
    let plain_leaf = prop_oneof![5 => simple_motion_strategy(), 1 => digits, 1 => change];
    let leaf = (plain_leaf, manner_strategy()).prop_map(|(kind, manner)| with_manner(kind, manner));
    leaf.prop_recursive(3, 12, 3, |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        let group = prop_oneof![
            vec(inner.clone(), 1..4).prop_map(MotionKind::Parallel),
            (vec(inner, 1..4), any::<bool>()).prop_map(|(motions, fused)| MotionKind::Sequence { motions, fused }),
            (option::of(boxed.clone()), option::of(boxed.clone())).prop_map(|(one, two)| MotionKind::Split(one, two)),
        ];
        let base = prop_oneof![simple_motion_strategy(), group.clone()];
        let target = (base.clone(), manner_strategy(), place_strategy(false), any::<bool>()).prop_map(
            |(kind, manner, mut place, brushing)| {
                match &mut place {
                    HandPlace::Body(body) if brushing && body.site.is_some() => {
                        body.contact = Some(PlaceContact::Brushing)
                    }
                    HandPlace::Hand(site) if brushing => site.contact = Some(PlaceContact::Brushing),
                    _ => {}
                }
                MotionKind::Target {
                    motion: Some(Box::new(with_manner(kind, manner))),
                    posture: Box::new(NotatedPosture {
                        place: Some(place),
                        ..NotatedPosture::default()
                    }),
                }
            },
        );
        let repeated = (
            prop_oneof![base, target.clone()],
            manner_strategy(),
            repetition_strategy(),
        )
            .prop_map(|(kind, manner, repetition)| MotionKind::Repeated {
                motion: Box::new(with_manner(kind, manner)),
                repetition,
            });
        (prop_oneof![group, target, repeated], manner_strategy()).prop_map(|(kind, manner)| with_manner(kind, manner))
    })
    .boxed()
}

fn with_manner(kind: MotionKind, manner: MotionManner) -> NotatedMotion {
    NotatedMotion {
        manner,
        ..NotatedMotion::new(kind)
    }
}
