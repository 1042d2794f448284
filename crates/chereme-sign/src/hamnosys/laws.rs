//! Tests laws of reading and writing, on random trees and texts.

use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::{select, subsequence};

use super::tree::*;
use super::{Compass, Direction, Symbol, parse, parse_lenient, print};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_printed_sign_reads_back_unchanged(parts in vec(manual(), 1..3)) {
        let sign = Sign { parts };
        let printed = print(&sign);
        let read = parse(&printed.text);
        prop_assert_eq!(read.as_ref().map(|read| &read.sign), Ok(&sign), "{}", names(&printed.text));
        prop_assert_eq!(&printed.losses, &[]);
        let read = read.expect("just seen");
        prop_assert_eq!(&read.findings, &[], "{}", names(&printed.text));
        prop_assert_eq!(read.print(), printed.text);
    }

    #[test]
    fn no_string_of_symbols_panics_and_all_print_as_they_were(
        symbols in vec(0..209_usize, 0..60),
        odd in "[a-z ,{}|?+\u{e0f8}\u{e000}]{0,6}",
    ) {
        let mut text: String = symbols.iter().filter_map(|at| Symbol::all().nth(*at)).map(Symbol::char).collect();
        text.push_str(&odd);
        prop_assert_eq!(parse_lenient(&text).print(), text.clone());
        if let Ok(read) = parse(&text) {
            prop_assert_eq!(read.print(), text);
        }
    }

    #[test]
    fn a_symbol_changed_anywhere_is_read_or_refused_with_its_place(
        part in manual(), at in 0..200_usize, other in 0..209_usize,
    ) {
        let mut text: Vec<char> = print(&Sign { parts: vec![part] }).text.chars().collect();
        let at = at % text.len();
        text[at] = Symbol::all().nth(other).map_or('?', Symbol::char);
        let count = text.len();
        let text: String = text.into_iter().collect();
        match parse(&text) {
            Ok(read) => prop_assert_eq!(read.print(), text),
            Err(error) => {
                prop_assert!(error.index().is_some_and(|index| index <= count), "{error}");
                let read = parse_lenient(&text);
                prop_assert!(read.is_partial());
                prop_assert_eq!(read.print(), text);
            }
        }
    }
}

fn names(text: &str) -> String {
    super::to_names(text).unwrap_or_default().join(" ")
}

fn manual() -> BoxedStrategy<Manual> {
    (hands(), body_action(), vec(motion(), 0..4))
        .prop_flat_map(|(hands, body, actions)| {
            let two = matches!(hands, HandsUsed::Both(_));
            posture(two).prop_map(move |posture| Manual {
                hands,
                body: body.clone(),
                posture,
                actions: actions.clone(),
                ..Manual::default()
            })
        })
        .boxed()
}

fn hands() -> BoxedStrategy<HandsUsed> {
    let symmetry =
        any::<[bool; 5]>().prop_map(|[left_right, up_down, out_in, out_of_phase, real_space]| {
            HandsUsed::Both(Symmetry {
                left_right,
                up_down,
                out_in,
                out_of_phase,
                real_space,
            })
        });
    prop_oneof![
        Just(HandsUsed::Dominant),
        Just(HandsUsed::Nondominant),
        symmetry
    ]
    .boxed()
}

fn body_action() -> BoxedStrategy<Vec<BodyAction>> {
    let part = select(vec![
        BodyLocation::Head,
        BodyLocation::Shoulders,
        BodyLocation::LowerArm,
    ]);
    vec(
        (part, option::of(side()), option::of(simple())).prop_map(|(part, side, kind)| {
            BodyAction {
                part,
                side,
                motion: kind.map(|kind| Box::new(Motion::new(kind))),
            }
        }),
        0..2,
    )
    .boxed()
}

/// A posture with at least a direction, so that fingers of the shape are not read as a place.
fn posture(two: bool) -> BoxedStrategy<Posture> {
    (
        each(shape()),
        option::of(any::<bool>()),
        (
            aim(select(Direction::all().collect::<Vec<_>>())),
            aim(compass()),
        ),
        option::of(place(two)),
    )
        .prop_map(move |(shape, palms, (extended, palm), place)| Posture {
            shape,
            extended: Each::Shared(extended),
            palm: match palms {
                None => Each::Unset,
                Some(true) => Each::Shared(palm),
                Some(false) if two => Each::Split(Some(palm), None),
                Some(false) => Each::Shared(palm),
            },
            place,
        })
        .boxed()
}

fn each<T: Clone + std::fmt::Debug>(
    one: impl Strategy<Value = T> + Clone,
) -> impl Strategy<Value = Each<T>> {
    prop_oneof![
        3 => one.clone().prop_map(Each::Shared),
        1 => (one.clone(), option::of(one)).prop_map(|(a, b)| Each::Split(Some(a), b)),
    ]
}

fn aim<D: Copy + std::fmt::Debug>(
    one: impl Strategy<Value = D> + Clone,
) -> impl Strategy<Value = Aim<D>> {
    (one.clone(), option::of(one), any::<bool>(), any::<bool>()).prop_map(
        |(first, second, approx, relative)| Aim {
            first,
            second,
            approx,
            frame: if relative {
                Frame::Relative
            } else {
                Frame::Plain
            },
        },
    )
}

fn compass() -> impl Strategy<Value = Compass> + Clone {
    select(Compass::ALL.to_vec())
}

fn bend() -> impl Strategy<Value = Bend> + Clone {
    select(vec![
        Bend::Bent,
        Bend::Round,
        Bend::Hooked,
        Bend::DoubleBent,
        Bend::DoubleHooked,
        Bend::Joints([3.0, 1.0, 1.0]),
        Bend::Joints([2.0, 4.0, 2.0]),
    ])
}

fn form() -> BoxedStrategy<Form> {
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
    let thumb = select(vec![
        ThumbPosition::Out,
        ThumbPosition::Across,
        ThumbPosition::Opposed,
    ]);
    (class, option::of(thumb), option::of(bend()))
        .prop_map(|(class, thumb, bend)| {
            let cee = matches!(class, C::Cee12 | C::Cee12Open | C::CeeAll);
            let opening = match thumb {
                Some(ThumbPosition::Across) if cee => Some(Opening::Tight),
                Some(ThumbPosition::Opposed) if cee => Some(Opening::Slack),
                _ => None,
            };
            Form {
                class,
                thumb: thumb.filter(|_| opening.is_none()),
                bend,
                opening,
            }
        })
        .boxed()
}

fn shape() -> BoxedStrategy<Handshape> {
    let digits = subsequence(Digit::ALL[1..].to_vec(), 0..4);
    let contact =
        (digit(), option::of(finger_part()), digit()).prop_map(|(first, part, second)| {
            FingerContact {
                first,
                second,
                part,
            }
        });
    let thumb = prop_oneof![
        (digit(), digit()).prop_map(|(one, two)| ThumbExtra::Between(one, two)),
        Just(ThumbExtra::Enclosed),
        finger_part().prop_map(ThumbExtra::Contact),
    ];
    (
        form(),
        option::weighted(0.3, form()),
        digits,
        (any::<bool>(), any::<bool>()),
        option::weighted(0.3, (digit(), bend())),
        (vec(contact, 0..2), option::weighted(0.2, thumb)),
    )
        .prop_map(
            |(form, between, digits, (approx, opposed), bend, (contacts, thumb))| {
                let (special, exempt) = chosen(&form, between.as_ref(), digits);
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
            },
        )
        .boxed()
}

/// The selected fingers and those that the bend leaves out, as far as the classes allow.
fn chosen(form: &Form, between: Option<&Form>, digits: Vec<Digit>) -> (Digits, Digits) {
    use HandClass as C;
    let bent = form.bend.is_some() || between.is_some_and(|form| form.bend.is_some());
    let exempt = match form.class {
        C::PinchAll | C::CeeAll => true,
        C::Fist | C::Flat | C::Finger2345 => bent,
        C::Finger23 | C::Finger23Spread => digits.len() < 2,
        _ => false,
    };
    let digits = Digits(digits);
    if exempt {
        (Digits::default(), digits)
    } else {
        (digits, Digits::default())
    }
}

fn digit() -> impl Strategy<Value = Digit> + Clone {
    select(Digit::ALL.to_vec())
}

fn finger_part() -> impl Strategy<Value = FingerPart> + Clone {
    use FingerPart as P;
    select(vec![P::Tip, P::Nail, P::Pad, P::MidJoint, P::Base, P::Side])
}

fn side() -> impl Strategy<Value = Side> + Clone {
    select(vec![
        Side::LeftBeside,
        Side::LeftAt,
        Side::RightAt,
        Side::RightBeside,
    ])
}

fn body_site() -> BoxedStrategy<Site<BodyLocation>> {
    use BodyLocation as L;
    let at = select(vec![
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
    (at, option::of(side()), any::<bool>())
        .prop_map(|(at, side, approx)| Site { at, side, approx })
        .boxed()
}

fn contact() -> impl Strategy<Value = Contact> + Clone {
    select(vec![
        Contact::Touch,
        Contact::Close,
        Contact::Cross,
        Contact::ArmExtended,
    ])
}

fn body_place() -> BoxedStrategy<BodyPlace> {
    (
        body_site(),
        option::of(body_site()),
        any::<bool>(),
        option::of((contact(), option::of(hand_site()))),
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

fn hand_site() -> BoxedStrategy<HandSite> {
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
    let digits = subsequence(Digit::ALL.to_vec(), 0..3);
    let sides = prop_oneof![
        side(),
        select(vec![Side::Palmar, Side::Dorsal, Side::Radial, Side::Ulnar])
    ];
    let at = prop_oneof![
        part.prop_map(|part| (Some(part), Vec::new())),
        (finger, digits.clone()).prop_map(|(part, digits)| (Some(part), digits)),
        digit().prop_map(|digit| (None, vec![digit])),
    ];
    (at, option::of(sides), any::<bool>())
        .prop_map(|((at, digits), side, approx)| HandSite {
            at,
            digits: Digits(digits),
            side,
            approx,
            ..HandSite::default()
        })
        .boxed()
}

fn place(two: bool) -> BoxedStrategy<Place> {
    let neutral = option::of(Just(Contact::ArmExtended)).prop_map(|contact| {
        Place::Body(BodyPlace {
            contact,
            ..BodyPlace::default()
        })
    });
    let hand =
        (hand_site(), contact(), option::of(hand_site())).prop_map(|(mut site, contact, by)| {
            site.contact = Some(contact);
            site.by = by.map(Box::new);
            Place::Hand(site)
        });
    let one = prop_oneof![
        4 => body_place().prop_map(Place::Body),
        1 => neutral,
        3 => hand.clone(),
        1 => (1..=5_u8).prop_map(Place::Named),
    ];
    let hands = (
        option::of((hand_site(), hand_site())),
        contact(),
        option::of(body_place()),
    )
        .prop_map(|(sites, contact, at)| {
            let (dominant, other) = sites.map_or((None, None), |(a, b)| (Some(a), Some(b)));
            Constellation {
                dominant,
                other,
                contact: Some(contact),
                at,
                ..Constellation::default()
            }
        })
        .prop_filter("far away is no relation of hands alone", |hands| {
            hands.dominant.is_some() || hands.contact != Some(Contact::ArmExtended)
        });
    let split = (body_place(), option::of(hand)).prop_map(|(body, hand)| {
        Place::Split(Some(Box::new(Place::Body(body))), hand.map(Box::new))
    });
    let hands = hands.prop_map(Place::Hands);
    if two {
        prop_oneof![2 => one, 1 => hands, 1 => split].boxed()
    } else {
        prop_oneof![3 => one, 1 => hands].boxed()
    }
}

fn size() -> impl Strategy<Value = Option<Size>> + Clone {
    select(vec![None, Some(Size::Small), Some(Size::Big)])
}

fn growth() -> impl Strategy<Value = Option<Growth>> + Clone {
    option::weighted(
        0.3,
        (any::<bool>(), size()).prop_map(|(increasing, size)| Growth { increasing, size }),
    )
}

/// A size; always present, so that two successive movements do not read as a corner.
fn amount() -> impl Strategy<Value = Amount> + Clone {
    let some = select(vec![Size::Small, Size::Big]);
    (some.clone(), option::weighted(0.2, some)).prop_map(|(first, second)| Amount {
        first: Some(first),
        second,
    })
}

fn simple() -> BoxedStrategy<MotionKind> {
    let direction = select(Direction::all().collect::<Vec<_>>());
    let curve = (compass(), size()).prop_map(|(to, size)| Curve { to, size });
    let zigzag = (any::<bool>(), size(), growth()).prop_map(|(wavy, size, growth)| Zigzag {
        wavy,
        size,
        growth,
    });
    let ellipse = select(vec![
        Ellipse::Horizontal,
        Ellipse::UpRight,
        Ellipse::Vertical,
        Ellipse::UpLeft,
    ]);
    let clock =
        (option::of(compass()), option::of(compass()), 0..3_u8).prop_map(|(start, end, full)| {
            Clock {
                start,
                end: end.filter(|_| start.is_some()),
                full,
            }
        });
    let directed = (
        direction.clone(),
        option::of(direction.clone()),
        amount(),
        option::of(curve),
        option::of(zigzag.clone()),
        option::of(ellipse.clone()),
    )
        .prop_map(|(direction, second, size, curve, zigzag, ellipse)| {
            MotionKind::Directed(Directed {
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
        amount(),
        option::of((ellipse, size())),
        clock,
        option::of(zigzag),
        growth(),
    )
        .prop_map(|(axis, second, size, ellipse, clock, zigzag, growth)| {
            MotionKind::Circular(Circular {
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
        1 => (wrist, size()).prop_map(|(motion, size)| MotionKind::Wrist { motion, size }),
        1 => any::<bool>().prop_map(|diagonal| MotionKind::Cross { diagonal }),
        1 => Just(MotionKind::Still),
    ]
    .boxed()
}

fn manner() -> BoxedStrategy<Manner> {
    any::<[bool; 7]>()
        .prop_map(
            |[fast, slow, tense, rest, halt, alternating, again]| Manner {
                fast,
                slow,
                tense,
                rest,
                halt,
                alternating,
                second_alternating: alternating && again,
                ..Manner::default()
            },
        )
        .boxed()
}

fn repetition() -> BoxedStrategy<Repetition> {
    use Repeat as R;
    let repeat = select(vec![
        R::FromStart,
        R::FromStartSeveral,
        R::Continue,
        R::ContinueSeveral,
        R::Reverse,
    ]);
    let shift = (
        select(Direction::all().collect::<Vec<_>>()),
        size(),
        growth(),
    );
    (
        repeat.clone(),
        option::weighted(0.2, repeat),
        growth(),
        option::weighted(0.3, shift),
        any::<bool>(),
    )
        .prop_map(|(repeat, second, growth, shift, approx)| Repetition {
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

fn motion() -> BoxedStrategy<Motion> {
    let digits = subsequence(Digit::ALL.to_vec(), 0..3)
        .prop_map(|digits| MotionKind::FingerPlay(Digits(digits)));
    let change = posture(false).prop_map(|posture| MotionKind::Target {
        motion: None,
        posture: Box::new(posture),
    });
    let leaf = prop_oneof![5 => simple(), 1 => digits, 1 => change];
    let leaf = (leaf, manner()).prop_map(with_manner);
    leaf.prop_recursive(3, 12, 3, |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        let group = prop_oneof![
            vec(inner.clone(), 1..4).prop_map(MotionKind::Parallel),
            (vec(inner, 1..4), any::<bool>())
                .prop_map(|(motions, fused)| MotionKind::Sequence { motions, fused }),
            (option::of(boxed.clone()), option::of(boxed.clone()))
                .prop_map(|(one, two)| MotionKind::Split(one, two)),
        ];
        let base = prop_oneof![simple(), group.clone()];
        let target = (base.clone(), manner(), place(false), any::<bool>()).prop_map(
            |(kind, manner, mut place, brushing)| {
                match &mut place {
                    Place::Body(body) if brushing && body.site.is_some() => {
                        body.contact = Some(Contact::Brushing)
                    }
                    Place::Hand(site) if brushing => site.contact = Some(Contact::Brushing),
                    _ => {}
                }
                MotionKind::Target {
                    motion: Some(Box::new(with_manner((kind, manner)))),
                    posture: Box::new(Posture {
                        place: Some(place),
                        ..Posture::default()
                    }),
                }
            },
        );
        let repeated = (prop_oneof![base, target.clone()], manner(), repetition()).prop_map(
            |(kind, manner, repetition)| MotionKind::Repeated {
                motion: Box::new(with_manner((kind, manner))),
                repetition,
            },
        );
        (prop_oneof![group, target, repeated], manner()).prop_map(with_manner)
    })
    .boxed()
}

fn with_manner((kind, manner): (MotionKind, Manner)) -> Motion {
    Motion {
        manner,
        ..Motion::new(kind)
    }
}
