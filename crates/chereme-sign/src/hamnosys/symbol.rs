//! The 209 symbols of HamNoSys 4: character, name and meaning.
//!
//! Characters and names are those of the font that the University of Hamburg publishes (HamNoSys4TeX):
//! 201 code points of the private use area and eight ASCII marks. A name is also the name of the
//! symbol's element in H-SiGML.

use std::fmt;

use super::direction::{Compass, Direction};
use super::tree::{
    Bend, BodyLocation, Contact, Digit, Ellipse, FingerPart, HandClass, HandLocation, Repeat, Side,
    Size, ThumbPosition, WristMotion,
};
use Kind as K;

/// One of the 209 symbols.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(u8);

impl Symbol {
    /// Returns every symbol, by code point.
    pub fn all() -> impl ExactSizeIterator<Item = Self> {
        (0..TABLE.len()).map(|index| Self(index as u8))
    }

    /// Returns the symbol of a character, or of its second code in older tables.
    #[must_use]
    pub fn from_char(character: char) -> Option<Self> {
        let code = character as usize;
        let slot = match code {
            0xE0EE => return Self::from_char('\u{e054}'),
            0xE0EF => return Self::from_char('\u{e058}'),
            0x2B => return Self::from_char('\u{e0e7}'),
            0xE000..=0xE0FF => BY_CODE[128 + (code - 0xE000)],
            0..=0x7F => BY_CODE[code],
            _ => NONE,
        };
        (slot != NONE).then_some(Self(slot))
    }

    /// Returns the symbol of a name: `hamflathand`, or `flathand`, in any case, and other names in use in
    /// files (`hamcee12open`, `hampinchopen`, `clockplus` ...).
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let lower = name.to_ascii_lowercase();
        let short = lower.strip_prefix("ham").unwrap_or(&lower);
        let plain = ALIASES
            .iter()
            .find(|(alias, _)| *alias == short)
            .map_or(short, |(_, plain)| plain);
        let index = TABLE
            .iter()
            .position(|row| row.name["ham".len()..].eq_ignore_ascii_case(plain))?;
        Some(Self(index as u8))
    }

    /// Returns the character.
    #[must_use]
    pub fn char(self) -> char {
        self.row().character
    }

    /// Returns the name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Returns its meaning.
    #[must_use]
    pub fn kind(self) -> Kind {
        self.row().kind
    }

    /// Returns its group.
    #[must_use]
    pub fn class(self) -> Class {
        self.kind().class()
    }

    /// Returns the symbol with a meaning, if one exists.
    #[must_use]
    pub fn of(kind: Kind) -> Option<Self> {
        let (from, to) = kind.codes();
        BY_CODE[128 + from..128 + to]
            .iter()
            .copied()
            .filter(|slot| *slot != NONE)
            .map(Self)
            .find(|symbol| symbol.kind() == kind)
    }

    fn row(self) -> &'static SymbolRow {
        &TABLE[self.0 as usize]
    }
}

impl fmt::Debug for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The meaning of a symbol, unless its position in a transcription decides.
///
/// Five marks mean one thing after a symmetry sign and another elsewhere; they are listed here under
/// the second: [`Bend::Bent`] (out and in exchanged), [`Size::Big`] (up and down exchanged),
/// [`Kind::Alternating`] (half a period behind). [`Kind::Between`] joins two of a kind, and
/// [`Bracket::Seq`] opens a sequence, a contact, a brushing contact or a moving repetition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A blank.
    Space,
    /// A comma, full stop, question or exclamation mark.
    Punctuation,
    /// Opens alternatives.
    AltBegin,
    /// Between two alternatives.
    AltOr,
    /// Closes alternatives.
    AltEnd,
    /// States the version HamNoSys 4.0.
    Version,
    /// A mimed action.
    Mime,
    /// A class of handshapes.
    Base(HandClass),
    /// The position of the thumb.
    Thumb(ThumbPosition),
    /// A bend of fingers.
    Bend(Bend),
    /// The direction of the hand's axis.
    Extended(Direction),
    /// The direction of the palm.
    Palm(Compass),
    /// A place on body or arm, or neutral space.
    Body(BodyLocation),
    /// Next to a place: before it to its left, after it to its right.
    Beside,
    /// At the side of a place: before it the left one, after it the right one.
    At,
    /// Assigns a number to a place.
    Define,
    /// Refers to a numbered place.
    Refer,
    /// A part of the hand.
    Hand(HandLocation),
    /// A side of the wrist.
    WristSide(Side),
    /// A digit.
    Digit(Digit),
    /// A part of a digit.
    Part(FingerPart),
    /// A straight movement.
    Move(Direction),
    /// A circle about an axis.
    Circle(Direction),
    /// The fingers play.
    FingerPlay,
    /// A movement of the wrist.
    Wrist(WristMotion),
    /// The following posture replaces the current one.
    Replace,
    /// A cross is drawn.
    Cross {
        /// Diagonal.
        diagonal: bool,
    },
    /// No movement.
    Still,
    /// A point on the rim of a circle.
    Clock(Compass),
    /// One more turn.
    ClockFull,
    /// A curve.
    Arc(Compass),
    /// To and fro.
    Zigzag {
        /// In waves.
        wavy: bool,
    },
    /// An ellipse.
    Ellipse(Ellipse),
    /// Growing or shrinking.
    Growth {
        /// Growing.
        increasing: bool,
    },
    /// A size.
    Size(Size),
    /// A manner of movement.
    Manner(Mark),
    /// The nearness of the hand.
    Contact(Contact),
    /// Behind a place.
    Behind,
    /// A repetition.
    Repeat(Repeat),
    /// The hands alternate.
    Alternating,
    /// An opening bracket.
    Open(Bracket),
    /// A closing bracket.
    Close(Bracket),
    /// Between the two neighbours.
    Between,
    /// Between the parts of the two hands, or between two signs.
    Plus,
    /// Two hands.
    Symmetry {
        /// Left and right exchanged.
        left_right: bool,
    },
    /// The other hand.
    Nondominant,
    /// In real space.
    RealSpace,
    /// Approximately.
    Approx,
    /// Relative to the movement or the place.
    Relative,
}

/// The marks of manner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Fast.
    Fast,
    /// Slow.
    Slow,
    /// Tense.
    Tense,
    /// A rest.
    Rest,
    /// A sudden stop.
    Halt,
}

/// The kinds of brackets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bracket {
    /// Successive motions; also contacts.
    Seq,
    /// Simultaneous motions; also one part per hand.
    Par,
    /// Motions that run into each other.
    Fusion,
}

/// The groups of symbols.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each is what its name says")]
pub enum Class {
    Punctuation,
    Handshape,
    HandshapeMark,
    ExtendedFinger,
    Palm,
    Location,
    LocationMark,
    HandPart,
    Digit,
    FingerPart,
    Movement,
    MovementMark,
    Manner,
    Contact,
    Repetition,
    Bracket,
    Operator,
}

impl Kind {
    /// Returns the group.
    #[must_use]
    pub fn class(self) -> Class {
        match self {
            K::Space | K::Punctuation | K::AltBegin | K::AltOr | K::AltEnd | K::Version => {
                Class::Punctuation
            }
            K::Base(_) => Class::Handshape,
            K::Thumb(_) | K::Bend(_) => Class::HandshapeMark,
            K::Extended(_) => Class::ExtendedFinger,
            K::Palm(_) => Class::Palm,
            K::Body(_) => Class::Location,
            K::Beside | K::At | K::Define | K::Refer | K::Behind => Class::LocationMark,
            K::Hand(_) | K::WristSide(_) => Class::HandPart,
            K::Digit(_) => Class::Digit,
            K::Part(_) => Class::FingerPart,
            K::Move(_) | K::Circle(_) | K::FingerPlay | K::Wrist(_) | K::Replace => Class::Movement,
            K::Cross { .. } | K::Still | K::Mime => Class::Movement,
            K::Clock(_) | K::ClockFull | K::Arc(_) | K::Zigzag { .. } => Class::MovementMark,
            K::Ellipse(_) | K::Growth { .. } | K::Size(_) => Class::MovementMark,
            K::Manner(_) => Class::Manner,
            K::Contact(_) => Class::Contact,
            K::Repeat(_) | K::Alternating => Class::Repetition,
            K::Open(_) | K::Close(_) => Class::Bracket,
            K::Between | K::Plus | K::Symmetry { .. } | K::Nondominant => Class::Operator,
            K::RealSpace | K::Approx | K::Relative => Class::Operator,
        }
    }

    /// The range of code points, relative to E000, of a symbol of this kind.
    fn codes(self) -> (usize, usize) {
        match self {
            K::Base(_) => (0x00, 0x0C),
            K::Thumb(_) => (0x0C, 0x0F),
            K::Bend(_) => (0x10, 0x15),
            K::Extended(_) => (0x20, 0x32),
            K::Palm(_) => (0x38, 0x40),
            K::Body(_) => (0x40, 0x64),
            K::Beside | K::At | K::Define | K::Refer => (0x58, 0x5C),
            K::Hand(_) | K::WristSide(_) => (0x64, 0x80),
            K::Digit(_) => (0x70, 0x75),
            K::Part(_) => (0x75, 0x7B),
            K::Move(_) => (0x80, 0x92),
            K::Circle(_) => (0x92, 0xA4),
            K::FingerPlay | K::Wrist(_) | K::Replace | K::Cross { .. } | K::Still => (0xA4, 0xB0),
            K::Clock(_) | K::ClockFull | K::Arc(_) | K::Zigzag { .. } => (0xB0, 0xBF),
            K::Ellipse(_) | K::Growth { .. } | K::Size(_) | K::Manner(_) => (0xC0, 0xCD),
            K::Contact(_) | K::Behind => (0xD0, 0xD7),
            K::Repeat(_) | K::Alternating => (0xD8, 0xDE),
            K::Open(_) | K::Close(_) | K::Between | K::Plus => (0xE0, 0xE8),
            K::Space | K::Punctuation | K::AltBegin | K::AltOr | K::AltEnd => (0x00, 0x00),
            _ => (0xE8, 0xF2),
        }
    }
}

#[derive(Debug)]
struct SymbolRow {
    character: char,
    name: &'static str,
    kind: Kind,
}

const fn row(character: char, name: &'static str, kind: Kind) -> SymbolRow {
    SymbolRow {
        character,
        name,
        kind,
    }
}

const fn dir(up: i8, out: i8, left: i8) -> Direction {
    Direction::of(up, out, left)
}

const NONE: u8 = u8::MAX;

/// The index into [`TABLE`] by code: the ASCII marks, then the private use area from E000 on.
static BY_CODE: [u8; 384] = {
    let mut slots = [NONE; 384];
    let mut index = 0;
    while index < TABLE.len() {
        let code = TABLE[index].character as usize;
        slots[if code < 128 {
            code
        } else {
            128 + code - 0xE000
        }] = index as u8;
        index += 1;
    }
    slots
};

/// Other names in use, without `ham`: of older converters, of other tables, and slips found in many files.
const ALIASES: [(&str, &str); 19] = [
    ("asciispace", "space"),
    ("tab", "space"),
    ("linefeed", "space"),
    ("return", "space"),
    ("pagebreak", "space"),
    ("nbs", "space"),
    ("exclam", "exclaim"),
    ("asciiplus", "plus"),
    ("pinchopen", "pinch12open"),
    ("cee12open", "ceeopen"),
    ("fingerhookedmod", "fingerhookmod"),
    ("clockplus", "clockfull"),
    ("neutral", "neutralspace"),
    ("palmud", "palmd"),
    ("moveudl", "movedl"),
    ("indxfinger", "indexfinger"),
    ("flat", "flathand"),
    ("version4", "version40"),
    ("alternating", "alternatingmotion"),
];

/// The symbols by code point.
#[rustfmt::skip]
static TABLE: [SymbolRow; 209] = [
    row(' ', "hamspace", K::Space),
    row('!', "hamexclaim", K::Punctuation),
    row(',', "hamcomma", K::Punctuation),
    row('.', "hamfullstop", K::Punctuation),
    row('?', "hamquery", K::Punctuation),
    row('{', "hamaltbegin", K::AltBegin),
    row('|', "hammetaalt", K::AltOr),
    row('}', "hamaltend", K::AltEnd),
    row('\u{e000}', "hamfist", K::Base(HandClass::Fist)),
    row('\u{e001}', "hamflathand", K::Base(HandClass::Flat)),
    row('\u{e002}', "hamfinger2", K::Base(HandClass::Finger2)),
    row('\u{e003}', "hamfinger23", K::Base(HandClass::Finger23)),
    row('\u{e004}', "hamfinger23spread", K::Base(HandClass::Finger23Spread)),
    row('\u{e005}', "hamfinger2345", K::Base(HandClass::Finger2345)),
    row('\u{e006}', "hampinch12", K::Base(HandClass::Pinch12)),
    row('\u{e007}', "hampinchall", K::Base(HandClass::PinchAll)),
    row('\u{e008}', "hampinch12open", K::Base(HandClass::Pinch12Open)),
    row('\u{e009}', "hamcee12", K::Base(HandClass::Cee12)),
    row('\u{e00a}', "hamceeall", K::Base(HandClass::CeeAll)),
    row('\u{e00b}', "hamceeopen", K::Base(HandClass::Cee12Open)),
    row('\u{e00c}', "hamthumboutmod", K::Thumb(ThumbPosition::Out)),
    row('\u{e00d}', "hamthumbacrossmod", K::Thumb(ThumbPosition::Across)),
    row('\u{e00e}', "hamthumbopenmod", K::Thumb(ThumbPosition::Opposed)),
    row('\u{e010}', "hamfingerstraightmod", K::Bend(Bend::Bent)),
    row('\u{e011}', "hamfingerbendmod", K::Bend(Bend::Round)),
    row('\u{e012}', "hamfingerhookmod", K::Bend(Bend::Hooked)),
    row('\u{e013}', "hamdoublebent", K::Bend(Bend::DoubleBent)),
    row('\u{e014}', "hamdoublehooked", K::Bend(Bend::DoubleHooked)),
    row('\u{e020}', "hamextfingeru", K::Extended(dir(1, 0, 0))),
    row('\u{e021}', "hamextfingerur", K::Extended(dir(1, 0, -1))),
    row('\u{e022}', "hamextfingerr", K::Extended(dir(0, 0, -1))),
    row('\u{e023}', "hamextfingerdr", K::Extended(dir(-1, 0, -1))),
    row('\u{e024}', "hamextfingerd", K::Extended(dir(-1, 0, 0))),
    row('\u{e025}', "hamextfingerdl", K::Extended(dir(-1, 0, 1))),
    row('\u{e026}', "hamextfingerl", K::Extended(dir(0, 0, 1))),
    row('\u{e027}', "hamextfingerul", K::Extended(dir(1, 0, 1))),
    row('\u{e028}', "hamextfingerol", K::Extended(dir(0, 1, 1))),
    row('\u{e029}', "hamextfingero", K::Extended(dir(0, 1, 0))),
    row('\u{e02a}', "hamextfingeror", K::Extended(dir(0, 1, -1))),
    row('\u{e02b}', "hamextfingeril", K::Extended(dir(0, -1, 1))),
    row('\u{e02c}', "hamextfingeri", K::Extended(dir(0, -1, 0))),
    row('\u{e02d}', "hamextfingerir", K::Extended(dir(0, -1, -1))),
    row('\u{e02e}', "hamextfingerui", K::Extended(dir(1, -1, 0))),
    row('\u{e02f}', "hamextfingerdi", K::Extended(dir(-1, -1, 0))),
    row('\u{e030}', "hamextfingerdo", K::Extended(dir(-1, 1, 0))),
    row('\u{e031}', "hamextfingeruo", K::Extended(dir(1, 1, 0))),
    row('\u{e038}', "hampalmu", K::Palm(Compass::U)),
    row('\u{e039}', "hampalmur", K::Palm(Compass::Ur)),
    row('\u{e03a}', "hampalmr", K::Palm(Compass::R)),
    row('\u{e03b}', "hampalmdr", K::Palm(Compass::Dr)),
    row('\u{e03c}', "hampalmd", K::Palm(Compass::D)),
    row('\u{e03d}', "hampalmdl", K::Palm(Compass::Dl)),
    row('\u{e03e}', "hampalml", K::Palm(Compass::L)),
    row('\u{e03f}', "hampalmul", K::Palm(Compass::Ul)),
    row('\u{e040}', "hamhead", K::Body(BodyLocation::Head)),
    row('\u{e041}', "hamheadtop", K::Body(BodyLocation::HeadTop)),
    row('\u{e042}', "hamforehead", K::Body(BodyLocation::Forehead)),
    row('\u{e043}', "hameyebrows", K::Body(BodyLocation::Eyebrows)),
    row('\u{e044}', "hameyes", K::Body(BodyLocation::Eyes)),
    row('\u{e045}', "hamnose", K::Body(BodyLocation::Nose)),
    row('\u{e046}', "hamnostrils", K::Body(BodyLocation::Nostrils)),
    row('\u{e047}', "hamear", K::Body(BodyLocation::Ear)),
    row('\u{e048}', "hamearlobe", K::Body(BodyLocation::EarLobe)),
    row('\u{e049}', "hamcheek", K::Body(BodyLocation::Cheek)),
    row('\u{e04a}', "hamlips", K::Body(BodyLocation::Lips)),
    row('\u{e04b}', "hamtongue", K::Body(BodyLocation::Tongue)),
    row('\u{e04c}', "hamteeth", K::Body(BodyLocation::Teeth)),
    row('\u{e04d}', "hamchin", K::Body(BodyLocation::Chin)),
    row('\u{e04e}', "hamunderchin", K::Body(BodyLocation::UnderChin)),
    row('\u{e04f}', "hamneck", K::Body(BodyLocation::Neck)),
    row('\u{e050}', "hamshouldertop", K::Body(BodyLocation::ShoulderTop)),
    row('\u{e051}', "hamshoulders", K::Body(BodyLocation::Shoulders)),
    row('\u{e052}', "hamchest", K::Body(BodyLocation::Chest)),
    row('\u{e053}', "hamstomach", K::Body(BodyLocation::Stomach)),
    row('\u{e054}', "hambelowstomach", K::Body(BodyLocation::BelowStomach)),
    row('\u{e058}', "hamlrbeside", K::Beside),
    row('\u{e059}', "hamlrat", K::At),
    row('\u{e05a}', "hamcoreftag", K::Define),
    row('\u{e05b}', "hamcorefref", K::Refer),
    row('\u{e05f}', "hamneutralspace", K::Body(BodyLocation::NeutralSpace)),
    row('\u{e060}', "hamupperarm", K::Body(BodyLocation::UpperArm)),
    row('\u{e061}', "hamelbow", K::Body(BodyLocation::Elbow)),
    row('\u{e062}', "hamelbowinside", K::Body(BodyLocation::ElbowInside)),
    row('\u{e063}', "hamlowerarm", K::Body(BodyLocation::LowerArm)),
    row('\u{e064}', "hamwristback", K::Hand(HandLocation::WristBack)),
    row('\u{e065}', "hamwristpulse", K::WristSide(Side::Palmar)),
    row('\u{e066}', "hamthumbball", K::Hand(HandLocation::ThumbBall)),
    row('\u{e067}', "hampalm", K::Hand(HandLocation::Palm)),
    row('\u{e068}', "hamhandback", K::Hand(HandLocation::HandBack)),
    row('\u{e069}', "hamthumbside", K::Hand(HandLocation::ThumbSide)),
    row('\u{e06a}', "hampinkyside", K::Hand(HandLocation::PinkySide)),
    row('\u{e070}', "hamthumb", K::Digit(Digit::Thumb)),
    row('\u{e071}', "hamindexfinger", K::Digit(Digit::Index)),
    row('\u{e072}', "hammiddlefinger", K::Digit(Digit::Middle)),
    row('\u{e073}', "hamringfinger", K::Digit(Digit::Ring)),
    row('\u{e074}', "hampinky", K::Digit(Digit::Little)),
    row('\u{e075}', "hamfingertip", K::Part(FingerPart::Tip)),
    row('\u{e076}', "hamfingernail", K::Part(FingerPart::Nail)),
    row('\u{e077}', "hamfingerpad", K::Part(FingerPart::Pad)),
    row('\u{e078}', "hamfingermidjoint", K::Part(FingerPart::MidJoint)),
    row('\u{e079}', "hamfingerbase", K::Part(FingerPart::Base)),
    row('\u{e07a}', "hamfingerside", K::Part(FingerPart::Side)),
    row('\u{e07c}', "hamwristtopulse", K::WristSide(Side::Palmar)),
    row('\u{e07d}', "hamwristtoback", K::WristSide(Side::Dorsal)),
    row('\u{e07e}', "hamwristtothumb", K::WristSide(Side::Radial)),
    row('\u{e07f}', "hamwristtopinky", K::WristSide(Side::Ulnar)),
    row('\u{e080}', "hammoveu", K::Move(dir(1, 0, 0))),
    row('\u{e081}', "hammoveur", K::Move(dir(1, 0, -1))),
    row('\u{e082}', "hammover", K::Move(dir(0, 0, -1))),
    row('\u{e083}', "hammovedr", K::Move(dir(-1, 0, -1))),
    row('\u{e084}', "hammoved", K::Move(dir(-1, 0, 0))),
    row('\u{e085}', "hammovedl", K::Move(dir(-1, 0, 1))),
    row('\u{e086}', "hammovel", K::Move(dir(0, 0, 1))),
    row('\u{e087}', "hammoveul", K::Move(dir(1, 0, 1))),
    row('\u{e088}', "hammoveol", K::Move(dir(0, 1, 1))),
    row('\u{e089}', "hammoveo", K::Move(dir(0, 1, 0))),
    row('\u{e08a}', "hammoveor", K::Move(dir(0, 1, -1))),
    row('\u{e08b}', "hammoveil", K::Move(dir(0, -1, 1))),
    row('\u{e08c}', "hammovei", K::Move(dir(0, -1, 0))),
    row('\u{e08d}', "hammoveir", K::Move(dir(0, -1, -1))),
    row('\u{e08e}', "hammoveui", K::Move(dir(1, -1, 0))),
    row('\u{e08f}', "hammovedi", K::Move(dir(-1, -1, 0))),
    row('\u{e090}', "hammovedo", K::Move(dir(-1, 1, 0))),
    row('\u{e091}', "hammoveuo", K::Move(dir(1, 1, 0))),
    row('\u{e092}', "hamcircleo", K::Circle(dir(0, 1, 0))),
    row('\u{e093}', "hamcirclei", K::Circle(dir(0, -1, 0))),
    row('\u{e094}', "hamcircled", K::Circle(dir(-1, 0, 0))),
    row('\u{e095}', "hamcircleu", K::Circle(dir(1, 0, 0))),
    row('\u{e096}', "hamcirclel", K::Circle(dir(0, 0, 1))),
    row('\u{e097}', "hamcircler", K::Circle(dir(0, 0, -1))),
    row('\u{e098}', "hamcircleul", K::Circle(dir(1, 0, 1))),
    row('\u{e099}', "hamcircledr", K::Circle(dir(-1, 0, -1))),
    row('\u{e09a}', "hamcircleur", K::Circle(dir(1, 0, -1))),
    row('\u{e09b}', "hamcircledl", K::Circle(dir(-1, 0, 1))),
    row('\u{e09c}', "hamcircleol", K::Circle(dir(0, 1, 1))),
    row('\u{e09d}', "hamcircleir", K::Circle(dir(0, -1, -1))),
    row('\u{e09e}', "hamcircleor", K::Circle(dir(0, 1, -1))),
    row('\u{e09f}', "hamcircleil", K::Circle(dir(0, -1, 1))),
    row('\u{e0a0}', "hamcircleui", K::Circle(dir(1, -1, 0))),
    row('\u{e0a1}', "hamcircledo", K::Circle(dir(-1, 1, 0))),
    row('\u{e0a2}', "hamcircleuo", K::Circle(dir(1, 1, 0))),
    row('\u{e0a3}', "hamcircledi", K::Circle(dir(-1, -1, 0))),
    row('\u{e0a4}', "hamfingerplay", K::FingerPlay),
    row('\u{e0a5}', "hamnodding", K::Wrist(WristMotion::Nodding)),
    row('\u{e0a6}', "hamswinging", K::Wrist(WristMotion::Swinging)),
    row('\u{e0a7}', "hamtwisting", K::Wrist(WristMotion::Twisting)),
    row('\u{e0a8}', "hamstircw", K::Wrist(WristMotion::StirCw)),
    row('\u{e0a9}', "hamstirccw", K::Wrist(WristMotion::StirCcw)),
    row('\u{e0aa}', "hamreplace", K::Replace),
    row('\u{e0ad}', "hammovecross", K::Cross { diagonal: false }),
    row('\u{e0ae}', "hammoveX", K::Cross { diagonal: true }),
    row('\u{e0af}', "hamnomotion", K::Still),
    row('\u{e0b0}', "hamclocku", K::Clock(Compass::U)),
    row('\u{e0b1}', "hamclockul", K::Clock(Compass::Ul)),
    row('\u{e0b2}', "hamclockl", K::Clock(Compass::L)),
    row('\u{e0b3}', "hamclockdl", K::Clock(Compass::Dl)),
    row('\u{e0b4}', "hamclockd", K::Clock(Compass::D)),
    row('\u{e0b5}', "hamclockdr", K::Clock(Compass::Dr)),
    row('\u{e0b6}', "hamclockr", K::Clock(Compass::R)),
    row('\u{e0b7}', "hamclockur", K::Clock(Compass::Ur)),
    row('\u{e0b8}', "hamclockfull", K::ClockFull),
    row('\u{e0b9}', "hamarcl", K::Arc(Compass::L)),
    row('\u{e0ba}', "hamarcu", K::Arc(Compass::U)),
    row('\u{e0bb}', "hamarcr", K::Arc(Compass::R)),
    row('\u{e0bc}', "hamarcd", K::Arc(Compass::D)),
    row('\u{e0bd}', "hamwavy", K::Zigzag { wavy: true }),
    row('\u{e0be}', "hamzigzag", K::Zigzag { wavy: false }),
    row('\u{e0c0}', "hamellipseh", K::Ellipse(Ellipse::Horizontal)),
    row('\u{e0c1}', "hamellipseur", K::Ellipse(Ellipse::UpRight)),
    row('\u{e0c2}', "hamellipsev", K::Ellipse(Ellipse::Vertical)),
    row('\u{e0c3}', "hamellipseul", K::Ellipse(Ellipse::UpLeft)),
    row('\u{e0c4}', "hamincreasing", K::Growth { increasing: true }),
    row('\u{e0c5}', "hamdecreasing", K::Growth { increasing: false }),
    row('\u{e0c6}', "hamsmallmod", K::Size(Size::Small)),
    row('\u{e0c7}', "hamlargemod", K::Size(Size::Big)),
    row('\u{e0c8}', "hamfast", K::Manner(Mark::Fast)),
    row('\u{e0c9}', "hamslow", K::Manner(Mark::Slow)),
    row('\u{e0ca}', "hamtense", K::Manner(Mark::Tense)),
    row('\u{e0cb}', "hamrest", K::Manner(Mark::Rest)),
    row('\u{e0cc}', "hamhalt", K::Manner(Mark::Halt)),
    row('\u{e0d0}', "hamclose", K::Contact(Contact::Close)),
    row('\u{e0d1}', "hamtouch", K::Contact(Contact::Touch)),
    row('\u{e0d2}', "haminterlock", K::Contact(Contact::Interlock)),
    row('\u{e0d3}', "hamcross", K::Contact(Contact::Cross)),
    row('\u{e0d4}', "hamarmextended", K::Contact(Contact::ArmExtended)),
    row('\u{e0d5}', "hambehind", K::Behind),
    row('\u{e0d6}', "hambrushing", K::Contact(Contact::Brushing)),
    row('\u{e0d8}', "hamrepeatfromstart", K::Repeat(Repeat::FromStart)),
    row('\u{e0d9}', "hamrepeatfromstartseveral", K::Repeat(Repeat::FromStartSeveral)),
    row('\u{e0da}', "hamrepeatcontinue", K::Repeat(Repeat::Continue)),
    row('\u{e0db}', "hamrepeatcontinueseveral", K::Repeat(Repeat::ContinueSeveral)),
    row('\u{e0dc}', "hamrepeatreverse", K::Repeat(Repeat::Reverse)),
    row('\u{e0dd}', "hamalternatingmotion", K::Alternating),
    row('\u{e0e0}', "hamseqbegin", K::Open(Bracket::Seq)),
    row('\u{e0e1}', "hamseqend", K::Close(Bracket::Seq)),
    row('\u{e0e2}', "hamparbegin", K::Open(Bracket::Par)),
    row('\u{e0e3}', "hamparend", K::Close(Bracket::Par)),
    row('\u{e0e4}', "hamfusionbegin", K::Open(Bracket::Fusion)),
    row('\u{e0e5}', "hamfusionend", K::Close(Bracket::Fusion)),
    row('\u{e0e6}', "hambetween", K::Between),
    row('\u{e0e7}', "hamplus", K::Plus),
    row('\u{e0e8}', "hamsymmpar", K::Symmetry { left_right: false }),
    row('\u{e0e9}', "hamsymmlr", K::Symmetry { left_right: true }),
    row('\u{e0ea}', "hamnondominant", K::Nondominant),
    row('\u{e0eb}', "hamnonipsi", K::RealSpace),
    row('\u{e0ec}', "hametc", K::Approx),
    row('\u{e0ed}', "hamorirelative", K::Relative),
    row('\u{e0f0}', "hammime", K::Mime),
    row('\u{e0f1}', "hamversion40", K::Version),
];
