//! Features in words, as tables show them, and in symbols.

use std::fmt::Display;

use chereme_sign::hamnosys::symbol::{Kind, Mark};
use chereme_sign::hamnosys::{
    Aim, Bend, BodyPlace, Compass, Constellation, Contact, Digit, Digits, Direction, Each, Form,
    HandSite, HandsUsed, Handshape, Manner, Manual, Motion, Place, Posture, Repeat, Side, Sign,
    Site, Size, Symbol, text_of,
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
    fn marked(words: &str, mark: Option<Kind>) -> Self {
        let symbol = mark.and_then(Symbol::of).map(Symbol::char);
        Self::new(words, symbol.map(String::from).unwrap_or_default())
    }
}

fn manual(part: Manual) -> String {
    text_of(&Sign { parts: vec![part] })
}

/// Returns the HamNoSys of a posture of the acting hands.
pub(super) fn begun(hands: HandsUsed, posture: Posture) -> String {
    manual(Manual {
        hands,
        posture,
        ..Manual::default()
    })
}

fn posture(posture: Posture) -> String {
    begun(HandsUsed::Dominant, posture)
}

/// Returns the HamNoSys of a motion.
pub(super) fn motion(motion: &Motion) -> String {
    manual(Manual {
        actions: vec![motion.clone()],
        ..Manual::default()
    })
}

/// Returns the HamNoSys of the acting hands.
pub(super) fn hands(hands: HandsUsed) -> String {
    manual(Manual {
        hands,
        ..Manual::default()
    })
}

pub(super) fn direction(aim: &Aim<Direction>) -> WordsAndSymbols {
    let text = posture(Posture {
        extended: Each::Shared(*aim),
        ..Posture::default()
    });
    WordsAndSymbols::new(aimed(aim), text)
}

pub(super) fn palm(aim: &Aim<Compass>) -> WordsAndSymbols {
    let text = posture(Posture {
        palm: Each::Shared(*aim),
        ..Posture::default()
    });
    WordsAndSymbols::new(aimed(aim), text)
}

/// Returns the direction of a movement, or its axis if it is `round`.
pub(super) fn course(aim: &Aim<Direction>, round: bool) -> WordsAndSymbols {
    let kind = if round { Kind::Circle } else { Kind::Move };
    let text = match aim.first.corner_parts() {
        None => vec![aim.first],
        Some((one, two)) => vec![one, two],
    };
    let symbols = text
        .into_iter()
        .filter_map(|direction| Symbol::of(kind(direction)));
    WordsAndSymbols::new(aimed(aim), symbols.map(Symbol::char).collect::<String>())
}

fn aimed<D: Display>(aim: &Aim<D>) -> String {
    match &aim.second {
        Some(second) => format!("{}|{second}", aim.first),
        None => aim.first.to_string(),
    }
}

pub(super) fn shape(shape: &Handshape) -> WordsAndSymbols {
    let text = posture(Posture {
        shape: Each::Shared(shape.clone()),
        ..Posture::default()
    });
    WordsAndSymbols::new(shaped(shape), text)
}

fn shaped(shape: &Handshape) -> String {
    let mut words = form(&shape.form);
    if let Some(second) = &shape.between {
        words = format!("{words} | {}", form(second));
    }
    if !shape.special.is_empty() {
        words = format!("{words}, digits {}", digits(&shape.special));
    }
    for (n, bend) in shape.bends.iter().enumerate() {
        if let Some(bend) = bend {
            words = format!("{words}, digit {} {}", n + 1, bend_name(*bend));
        }
    }
    words
}

fn form(form: &Form) -> String {
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

fn bend_name(bend: Bend) -> &'static str {
    match bend {
        Bend::Bent => "bent",
        Bend::Round => "round",
        Bend::Hooked => "hooked",
        Bend::DoubleBent => "double-bent",
        Bend::DoubleHooked => "double-hooked",
        Bend::HalfBent => "half-bent",
        Bend::Joints(_) => "bent by joints",
    }
}

fn digits(digits: &Digits) -> String {
    digits
        .0
        .iter()
        .map(|digit: &Digit| digit.number().to_string())
        .collect()
}

/// Returns a place without its contact.
pub(super) fn place(place: &BodyPlace) -> WordsAndSymbols {
    let neutral = || "neutral space".to_owned();
    let mut words = place.site.as_ref().map_or_else(neutral, site);
    if let Some(second) = &place.second {
        words = format!("{words} | {}", site(second));
    }
    let alone = BodyPlace {
        site: place.site,
        second: place.second,
        ..BodyPlace::default()
    };
    WordsAndSymbols::new(words, placed(Place::Body(alone)))
}

/// Returns the contact at a place, with the part of the hand that is named.
pub(super) fn nearness(place: &BodyPlace) -> WordsAndSymbols {
    let alone = BodyPlace {
        contact: place.contact,
        by: place.by.clone(),
        ..BodyPlace::default()
    };
    let mut words = contact(place.contact).to_owned();
    if let Some(by) = &place.by {
        words = format!("{words} by {}", hand_site(by));
    }
    let says = alone.contact.is_some() || alone.by.is_some();
    let far = alone.contact == Some(Contact::ArmExtended) && alone.by.is_none();
    WordsAndSymbols::new(
        words,
        match (far, says) {
            (true, _) => {
                WordsAndSymbols::marked("", Some(Kind::Contact(Contact::ArmExtended))).text
            }
            (_, true) => placed(Place::Body(alone)),
            _ => String::new(),
        },
    )
}

/// Returns the constellation of the two hands.
pub(super) fn together(hands: &Constellation) -> WordsAndSymbols {
    let part = |site: &Option<HandSite>| site.as_ref().map(hand_site).unwrap_or_default();
    let words = format!(
        "{} by {}: {}",
        part(&hands.dominant),
        part(&hands.other),
        contact(hands.contact)
    );
    let alone = Constellation {
        at: None,
        ..hands.clone()
    };
    WordsAndSymbols::new(words, placed(Place::Hands(alone)))
}

fn placed(place: Place) -> String {
    posture(Posture {
        place: Some(place),
        ..Posture::default()
    })
}

fn site<L: std::fmt::Debug>(site: &Site<L>) -> String {
    let at = format!("{:?}", site.at).to_lowercase();
    match site.side {
        Some(side) => format!("{at} {}", side_name(side)),
        None => at,
    }
}

fn side_name(side: Side) -> &'static str {
    match side {
        Side::LeftBeside => "left beside",
        Side::LeftAt => "left",
        Side::RightAt => "right",
        Side::RightBeside => "right beside",
        Side::Front => "front",
        Side::Back => "back",
        Side::Dorsal => "dorsal",
        Side::Palmar => "palmar",
        Side::Radial => "radial",
        Side::Ulnar => "ulnar",
    }
}

fn hand_site(site: &HandSite) -> String {
    let mut words = site
        .at
        .map(|at| format!("{at:?}").to_lowercase())
        .unwrap_or_default();
    if !site.digits.is_empty() {
        words = format!("{words} {}", digits(&site.digits));
    }
    if let Some(side) = site.side {
        words = format!("{words} {}", side_name(side));
    }
    words
}

fn contact(contact: Option<Contact>) -> &'static str {
    match contact {
        None => "none",
        Some(Contact::Touch) => "touch",
        Some(Contact::Close) => "close",
        Some(Contact::Interlock) => "interlock",
        Some(Contact::Cross) => "cross",
        Some(Contact::ArmExtended) => "arm extended",
        Some(Contact::Brushing) => "brushing",
    }
}

pub(super) fn size(size: Option<Size>) -> WordsAndSymbols {
    let words = match size {
        Some(Size::Small) => "small",
        None => "usual",
        Some(Size::Big) => "big",
    };
    WordsAndSymbols::marked(words, size.map(Kind::Size))
}

pub(super) fn repetition(times: usize, repeat: Repeat) -> WordsAndSymbols {
    WordsAndSymbols::marked(&format!("{times} times"), Some(Kind::Repeat(repeat)))
}

pub(super) fn manner(manner: &Manner) -> WordsAndSymbols {
    let marks = [
        (manner.fast, "fast", Mark::Fast),
        (manner.slow, "slow", Mark::Slow),
        (manner.tense, "tense", Mark::Tense),
        (manner.halt, "sudden stop", Mark::Halt),
        (manner.rest, "after a rest", Mark::Rest),
    ];
    let mut marks = marks.into_iter().filter(|it| it.0).peekable();
    let usual = marks.peek().is_none_or(|it| it.2 == Mark::Rest);
    let (mut words, mut text) = (Vec::new(), String::new());
    words.extend(usual.then_some("usual"));
    for (_, word, mark) in marks {
        words.push(word);
        text.extend(Symbol::of(Kind::Manner(mark)).map(Symbol::char));
    }
    WordsAndSymbols::new(words.join(", "), text)
}
