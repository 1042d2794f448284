//! Features in words, as tables show them, and in symbols.

use std::fmt::Display;

use chereme_sign::hamnosys::symbol::{MannerMark, SymbolKind};
use chereme_sign::hamnosys::{
    BodyPlace, CompassDirection, DigitList, DirectionAim, EachHand, FingerBend, HamnosysSign, HamnosysSymbol,
    HandConstellation, HandDigit, HandPlace, HandSite, HandsUsed, Handshape, HandshapeForm, LocationSide, ManualPart,
    MotionManner, MotionSize, NotatedMotion, NotatedPosture, PlaceContact, RepeatKind, SidedLocation, SpatialDirection,
    sign_hamnosys_text,
};

/// A value in words and as HamNoSys, which is empty if the value is written by omission.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct WordsAndSymbols {
    pub(super) words: String,
    pub(super) text: String,
}

impl WordsAndSymbols {
    pub(super) fn new(words: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            words: words.into(),
            text: text.into(),
        }
    }

    /// Creates a value with one symbol, or without if the usual value is not written.
    fn from_marked_words(words: &str, mark: Option<SymbolKind>) -> Self {
        let symbol = mark
            .and_then(HamnosysSymbol::from_symbol_kind)
            .map(HamnosysSymbol::symbol_char);
        Self::new(words, symbol.map(String::from).unwrap_or_default())
    }
}

fn manual_hamnosys(part: ManualPart) -> String {
    sign_hamnosys_text(&HamnosysSign { parts: vec![part] })
}

/// Returns the HamNoSys of a posture of the acting hands.
pub(super) fn begun_posture_hamnosys(hands: HandsUsed, posture: NotatedPosture) -> String {
    manual_hamnosys(ManualPart {
        hands,
        posture,
        ..ManualPart::default()
    })
}

fn posture_hamnosys(posture: NotatedPosture) -> String {
    begun_posture_hamnosys(HandsUsed::Dominant, posture)
}

/// Returns the HamNoSys of a motion.
pub(super) fn motion_hamnosys(motion: &NotatedMotion) -> String {
    manual_hamnosys(ManualPart {
        actions: vec![motion.clone()],
        ..ManualPart::default()
    })
}

/// Returns the HamNoSys of the acting hands.
pub(super) fn acting_hands_hamnosys(hands: HandsUsed) -> String {
    manual_hamnosys(ManualPart {
        hands,
        ..ManualPart::default()
    })
}

pub(super) fn describe_aim_direction(aim: &DirectionAim<SpatialDirection>) -> WordsAndSymbols {
    let text = posture_hamnosys(NotatedPosture {
        extended: EachHand::Shared(*aim),
        ..NotatedPosture::default()
    });
    WordsAndSymbols::new(aim_to_text(aim), text)
}

pub(super) fn describe_palm(aim: &DirectionAim<CompassDirection>) -> WordsAndSymbols {
    let text = posture_hamnosys(NotatedPosture {
        palm: EachHand::Shared(*aim),
        ..NotatedPosture::default()
    });
    WordsAndSymbols::new(aim_to_text(aim), text)
}

/// Returns the direction of a movement, or its axis if it is `round`.
pub(super) fn describe_movement_course(aim: &DirectionAim<SpatialDirection>, round: bool) -> WordsAndSymbols {
    let kind = if round { SymbolKind::Circle } else { SymbolKind::Move };
    let text = match aim.first.corner_parts() {
        None => vec![aim.first],
        Some((one, two)) => vec![one, two],
    };
    let symbols = text
        .into_iter()
        .filter_map(|direction| HamnosysSymbol::from_symbol_kind(kind(direction)));
    WordsAndSymbols::new(
        aim_to_text(aim),
        symbols.map(HamnosysSymbol::symbol_char).collect::<String>(),
    )
}

fn aim_to_text<D: Display>(aim: &DirectionAim<D>) -> String {
    match &aim.second {
        Some(second) => format!("{}|{second}", aim.first),
        None => aim.first.to_string(),
    }
}

pub(super) fn describe_handshape(shape: &Handshape) -> WordsAndSymbols {
    let text = posture_hamnosys(NotatedPosture {
        shape: EachHand::Shared(shape.clone()),
        ..NotatedPosture::default()
    });
    WordsAndSymbols::new(shaped(shape), text)
}

fn shaped(shape: &Handshape) -> String {
    let mut words = describe_hand_form(&shape.form);
    if let Some(second) = &shape.between {
        words = format!("{words} | {}", describe_hand_form(second));
    }
    if !shape.special.is_empty() {
        words = format!("{words}, digits {}", describe_digits(&shape.special));
    }
    for (n, bend) in shape.bends.iter().enumerate() {
        if let Some(bend) = bend {
            words = format!("{words}, digit {} {}", n + 1, bend_name(*bend));
        }
    }
    words
}

fn describe_hand_form(form: &HandshapeForm) -> String {
    let mut words = format!("{:?}", form.class).to_lowercase();
    if let Some(thumb) = form.thumb {
        words = format!("{words} thumb {}", format!("{thumb:?}").to_lowercase());
    }
    if let Some(opening) = form.opening {
        words = format!("{words} {}", format!("{opening:?}").to_lowercase());
    }
    if let Some(bend) = form.bend {
        words = format!("{words} {}", bend_name(bend));
    }
    words
}

fn bend_name(bend: FingerBend) -> &'static str {
    match bend {
        FingerBend::Bent => "bent",
        FingerBend::Round => "round",
        FingerBend::Hooked => "hooked",
        FingerBend::DoubleBent => "double-bent",
        FingerBend::DoubleHooked => "double-hooked",
        FingerBend::HalfBent => "half-bent",
        FingerBend::Joints(_) => "bent by joints",
    }
}

fn describe_digits(digits: &DigitList) -> String {
    digits
        .0
        .iter()
        .map(|digit: &HandDigit| digit.digit_number().to_string())
        .collect()
}

/// Returns a place without its contact.
pub(super) fn describe_body_place(place: &BodyPlace) -> WordsAndSymbols {
    let neutral = || "neutral space".to_owned();
    let mut words = place.site.as_ref().map_or_else(neutral, describe_site);
    if let Some(second) = &place.second {
        words = format!("{words} | {}", describe_site(second));
    }
    let alone = BodyPlace {
        site: place.site,
        second: place.second,
        ..BodyPlace::default()
    };
    WordsAndSymbols::new(words, place_hamnosys(HandPlace::Body(alone)))
}

/// Returns the contact at a place, with the part of the hand that is named.
pub(super) fn describe_place_contact(place: &BodyPlace) -> WordsAndSymbols {
    let alone = BodyPlace {
        contact: place.contact,
        by: place.by.clone(),
        ..BodyPlace::default()
    };
    let mut words = contact_word(place.contact).to_owned();
    if let Some(by) = &place.by {
        words = format!("{words} by {}", describe_hand_site(by));
    }
    let says = alone.contact.is_some() || alone.by.is_some();
    let far = alone.contact == Some(PlaceContact::ArmExtended) && alone.by.is_none();
    WordsAndSymbols::new(
        words,
        match (far, says) {
            (true, _) => {
                WordsAndSymbols::from_marked_words("", Some(SymbolKind::Contact(PlaceContact::ArmExtended))).text
            }
            (_, true) => place_hamnosys(HandPlace::Body(alone)),
            _ => String::new(),
        },
    )
}

/// Returns the constellation of the two hands.
pub(super) fn describe_hands_together(hands: &HandConstellation) -> WordsAndSymbols {
    let part = |site: &Option<HandSite>| site.as_ref().map(describe_hand_site).unwrap_or_default();
    let words = format!(
        "{} by {}: {}",
        part(&hands.dominant),
        part(&hands.other),
        contact_word(hands.contact)
    );
    let alone = HandConstellation {
        at: None,
        ..hands.clone()
    };
    WordsAndSymbols::new(words, place_hamnosys(HandPlace::Hands(alone)))
}

fn place_hamnosys(place: HandPlace) -> String {
    posture_hamnosys(NotatedPosture {
        place: Some(place),
        ..NotatedPosture::default()
    })
}

fn describe_site<L: std::fmt::Debug>(site: &SidedLocation<L>) -> String {
    let site_name = format!("{:?}", site.at).to_lowercase();
    match site.side {
        Some(side) => format!("{site_name} {}", side_name(side)),
        None => site_name,
    }
}

fn side_name(side: LocationSide) -> &'static str {
    match side {
        LocationSide::LeftBeside => "left beside",
        LocationSide::LeftAt => "left",
        LocationSide::RightAt => "right",
        LocationSide::RightBeside => "right beside",
        LocationSide::Front => "front",
        LocationSide::Back => "back",
        LocationSide::Dorsal => "dorsal",
        LocationSide::Palmar => "palmar",
        LocationSide::Radial => "radial",
        LocationSide::Ulnar => "ulnar",
    }
}

fn describe_hand_site(site: &HandSite) -> String {
    let mut words = site.at.map(|at| format!("{at:?}").to_lowercase()).unwrap_or_default();
    if !site.digits.is_empty() {
        words = format!("{words} {}", describe_digits(&site.digits));
    }
    if let Some(side) = site.side {
        words = format!("{words} {}", side_name(side));
    }
    words
}

fn contact_word(contact: Option<PlaceContact>) -> &'static str {
    match contact {
        None => "none",
        Some(PlaceContact::Touch) => "touch",
        Some(PlaceContact::Close) => "close",
        Some(PlaceContact::Interlock) => "interlock",
        Some(PlaceContact::Cross) => "cross",
        Some(PlaceContact::ArmExtended) => "arm extended",
        Some(PlaceContact::Brushing) => "brushing",
    }
}

pub(super) fn describe_path_size(size: Option<MotionSize>) -> WordsAndSymbols {
    let words = match size {
        Some(MotionSize::Small) => "small",
        None => "usual",
        Some(MotionSize::Big) => "big",
    };
    WordsAndSymbols::from_marked_words(words, size.map(SymbolKind::Size))
}

pub(super) fn describe_repetition(times: usize, repeat: RepeatKind) -> WordsAndSymbols {
    WordsAndSymbols::from_marked_words(&format!("{times} times"), Some(SymbolKind::Repeat(repeat)))
}

pub(super) fn describe_manner(manner: &MotionManner) -> WordsAndSymbols {
    let mark_rows = [
        (manner.fast, "fast", MannerMark::Fast),
        (manner.slow, "slow", MannerMark::Slow),
        (manner.tense, "tense", MannerMark::Tense),
        (manner.halt, "sudden stop", MannerMark::Halt),
        (manner.rest, "after a rest", MannerMark::Rest),
    ];
    let mut marks = mark_rows.into_iter().filter(|mark| mark.0).peekable();
    let usual = marks.peek().is_none_or(|mark| mark.2 == MannerMark::Rest);
    let (mut words, mut text) = (Vec::new(), String::new());
    words.extend(usual.then_some("usual"));
    for (_, word, mark) in marks {
        words.push(word);
        text.extend(HamnosysSymbol::from_symbol_kind(SymbolKind::Manner(mark)).map(HamnosysSymbol::symbol_char));
    }
    WordsAndSymbols::new(words.join(", "), text)
}
