//! The 209 symbols of HamNoSys 4: character, name and meaning.
//!
//! Characters and names are those of the font that the University of Hamburg publishes (HamNoSys4TeX):
//! 201 code points of the private use area and eight ASCII marks. A name is also the name of the
//! symbol's element in H-SiGML.

use std::fmt;

use super::direction::{CompassDirection, SpatialDirection};
use super::tree::{
    BodyLocation, EllipseAxis, FingerBend, FingerPart, HandClass, HandDigit, HandLocation, LocationSide, MotionSize,
    PlaceContact, RepeatKind, ThumbPosition, WristMotion,
};
use SymbolKind as K;

/// One of the 209 symbols.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HamnosysSymbol(u8);

impl HamnosysSymbol {
    /// Returns every symbol, by code point.
    pub fn all_symbols() -> impl ExactSizeIterator<Item = Self> {
        (0..SYMBOL_TABLE.len()).map(|index| Self(index as u8))
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
            _ => NO_SYMBOL_INDEX,
        };
        (slot != NO_SYMBOL_INDEX).then_some(Self(slot))
    }

    /// Returns the symbol of a name: `hamflathand`, or `flathand`, in any case, and other names in use in
    /// files (`hamcee12open`, `hampinchopen`, `clockplus` ...).
    #[must_use]
    pub fn from_symbol_name(name: &str) -> Option<Self> {
        let lower = name.to_ascii_lowercase();
        let short = lower.strip_prefix("ham").unwrap_or(&lower);
        let plain = SYMBOL_ALIASES
            .iter()
            .find(|(alias, _)| *alias == short)
            .map_or(short, |(_, plain)| plain);
        let index = SYMBOL_TABLE
            .iter()
            .position(|row| row.name["ham".len()..].eq_ignore_ascii_case(plain))?;
        Some(Self(index as u8))
    }

    /// Returns the character.
    #[must_use]
    pub fn symbol_char(self) -> char {
        self.symbol_row().character
    }

    /// Returns the name.
    #[must_use]
    pub fn symbol_name(self) -> &'static str {
        self.symbol_row().name
    }

    /// Returns its meaning.
    #[must_use]
    pub fn symbol_kind(self) -> SymbolKind {
        self.symbol_row().kind
    }

    /// Returns its group.
    #[must_use]
    pub fn symbol_class(self) -> SymbolClass {
        self.symbol_kind().kind_class()
    }

    /// Returns the symbol with a meaning, if one exists.
    #[must_use]
    pub fn from_symbol_kind(kind: SymbolKind) -> Option<Self> {
        let (from, to) = kind.code_point_range();
        BY_CODE[128 + from..128 + to]
            .iter()
            .copied()
            .filter(|slot| *slot != NO_SYMBOL_INDEX)
            .map(Self)
            .find(|symbol| symbol.symbol_kind() == kind)
    }

    fn symbol_row(self) -> &'static SymbolRow {
        &SYMBOL_TABLE[self.0 as usize]
    }
}

impl fmt::Debug for HamnosysSymbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol_name())
    }
}

impl fmt::Display for HamnosysSymbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol_name())
    }
}

/// The meaning of a symbol, unless its position in a transcription decides.
///
/// Five marks mean one thing after a symmetry sign and another elsewhere; they are listed here under
/// the second: [`FingerBend::Bent`] (out and in exchanged), [`MotionSize::Big`] (up and down exchanged),
/// [`SymbolKind::Alternating`] (half a period behind). [`SymbolKind::Between`] joins two of a kind, and
/// [`BracketKind::Seq`] opens a sequence, a contact, a brushing contact or a moving repetition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SymbolKind {
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
    Bend(FingerBend),
    /// The direction of the hand's axis.
    Extended(SpatialDirection),
    /// The direction of the palm.
    Palm(CompassDirection),
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
    WristSide(LocationSide),
    /// A digit.
    Digit(HandDigit),
    /// A part of a digit.
    Part(FingerPart),
    /// A straight movement.
    Move(SpatialDirection),
    /// A circle about an axis.
    Circle(SpatialDirection),
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
    Clock(CompassDirection),
    /// One more turn.
    ClockFull,
    /// A curve.
    Arc(CompassDirection),
    /// To and fro.
    Zigzag {
        /// In waves.
        wavy: bool,
    },
    /// An ellipse.
    Ellipse(EllipseAxis),
    /// Growing or shrinking.
    Growth {
        /// Growing.
        increasing: bool,
    },
    /// A size.
    Size(MotionSize),
    /// A manner of movement.
    Manner(MannerMark),
    /// The nearness of the hand.
    Contact(PlaceContact),
    /// Behind a place.
    Behind,
    /// A repetition.
    Repeat(RepeatKind),
    /// The hands alternate.
    Alternating,
    /// An opening bracket.
    Open(BracketKind),
    /// A closing bracket.
    Close(BracketKind),
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
pub enum MannerMark {
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
pub enum BracketKind {
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
pub enum SymbolClass {
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

impl SymbolKind {
    /// Returns the group.
    #[must_use]
    pub fn kind_class(self) -> SymbolClass {
        match self {
            K::Space | K::Punctuation | K::AltBegin | K::AltOr | K::AltEnd | K::Version => SymbolClass::Punctuation,
            K::Base(_) => SymbolClass::Handshape,
            K::Thumb(_) | K::Bend(_) => SymbolClass::HandshapeMark,
            K::Extended(_) => SymbolClass::ExtendedFinger,
            K::Palm(_) => SymbolClass::Palm,
            K::Body(_) => SymbolClass::Location,
            K::Beside | K::At | K::Define | K::Refer | K::Behind => SymbolClass::LocationMark,
            K::Hand(_) | K::WristSide(_) => SymbolClass::HandPart,
            K::Digit(_) => SymbolClass::Digit,
            K::Part(_) => SymbolClass::FingerPart,
            K::Move(_) | K::Circle(_) | K::FingerPlay | K::Wrist(_) | K::Replace => SymbolClass::Movement,
            K::Cross { .. } | K::Still | K::Mime => SymbolClass::Movement,
            K::Clock(_) | K::ClockFull | K::Arc(_) | K::Zigzag { .. } => SymbolClass::MovementMark,
            K::Ellipse(_) | K::Growth { .. } | K::Size(_) => SymbolClass::MovementMark,
            K::Manner(_) => SymbolClass::Manner,
            K::Contact(_) => SymbolClass::Contact,
            K::Repeat(_) | K::Alternating => SymbolClass::Repetition,
            K::Open(_) | K::Close(_) => SymbolClass::Bracket,
            K::Between | K::Plus | K::Symmetry { .. } | K::Nondominant => SymbolClass::Operator,
            K::RealSpace | K::Approx | K::Relative => SymbolClass::Operator,
        }
    }

    /// The range of code points, relative to E000, of a symbol of this kind.
    fn code_point_range(self) -> (usize, usize) {
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
    kind: SymbolKind,
}

const fn new_symbol_row(character: char, name: &'static str, kind: SymbolKind) -> SymbolRow {
    SymbolRow { character, name, kind }
}

const fn dir(up: i8, out: i8, left: i8) -> SpatialDirection {
    SpatialDirection::from_direction_steps(up, out, left)
}

const NO_SYMBOL_INDEX: u8 = u8::MAX;

/// The index into [`SYMBOL_TABLE`] by code: the ASCII marks, then the private use area from E000 on.
static BY_CODE: [u8; 384] = {
    let mut slots = [NO_SYMBOL_INDEX; 384];
    let mut index = 0;
    while index < SYMBOL_TABLE.len() {
        let code = SYMBOL_TABLE[index].character as usize;
        slots[if code < 128 { code } else { 128 + code - 0xE000 }] = index as u8;
        index += 1;
    }
    slots
};

/// Other names in use, without `ham`: of older converters, of other tables, and slips found in many files.
const SYMBOL_ALIASES: [(&str, &str); 19] = [
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
static SYMBOL_TABLE: [SymbolRow; 209] = [
    new_symbol_row(' ', "hamspace", K::Space),
    new_symbol_row('!', "hamexclaim", K::Punctuation),
    new_symbol_row(',', "hamcomma", K::Punctuation),
    new_symbol_row('.', "hamfullstop", K::Punctuation),
    new_symbol_row('?', "hamquery", K::Punctuation),
    new_symbol_row('{', "hamaltbegin", K::AltBegin),
    new_symbol_row('|', "hammetaalt", K::AltOr),
    new_symbol_row('}', "hamaltend", K::AltEnd),
    new_symbol_row('\u{e000}', "hamfist", K::Base(HandClass::Fist)),
    new_symbol_row('\u{e001}', "hamflathand", K::Base(HandClass::Flat)),
    new_symbol_row('\u{e002}', "hamfinger2", K::Base(HandClass::Finger2)),
    new_symbol_row('\u{e003}', "hamfinger23", K::Base(HandClass::Finger23)),
    new_symbol_row('\u{e004}', "hamfinger23spread", K::Base(HandClass::Finger23Spread)),
    new_symbol_row('\u{e005}', "hamfinger2345", K::Base(HandClass::Finger2345)),
    new_symbol_row('\u{e006}', "hampinch12", K::Base(HandClass::Pinch12)),
    new_symbol_row('\u{e007}', "hampinchall", K::Base(HandClass::PinchAll)),
    new_symbol_row('\u{e008}', "hampinch12open", K::Base(HandClass::Pinch12Open)),
    new_symbol_row('\u{e009}', "hamcee12", K::Base(HandClass::Cee12)),
    new_symbol_row('\u{e00a}', "hamceeall", K::Base(HandClass::CeeAll)),
    new_symbol_row('\u{e00b}', "hamceeopen", K::Base(HandClass::Cee12Open)),
    new_symbol_row('\u{e00c}', "hamthumboutmod", K::Thumb(ThumbPosition::Out)),
    new_symbol_row('\u{e00d}', "hamthumbacrossmod", K::Thumb(ThumbPosition::Across)),
    new_symbol_row('\u{e00e}', "hamthumbopenmod", K::Thumb(ThumbPosition::Opposed)),
    new_symbol_row('\u{e010}', "hamfingerstraightmod", K::Bend(FingerBend::Bent)),
    new_symbol_row('\u{e011}', "hamfingerbendmod", K::Bend(FingerBend::Round)),
    new_symbol_row('\u{e012}', "hamfingerhookmod", K::Bend(FingerBend::Hooked)),
    new_symbol_row('\u{e013}', "hamdoublebent", K::Bend(FingerBend::DoubleBent)),
    new_symbol_row('\u{e014}', "hamdoublehooked", K::Bend(FingerBend::DoubleHooked)),
    new_symbol_row('\u{e020}', "hamextfingeru", K::Extended(dir(1, 0, 0))),
    new_symbol_row('\u{e021}', "hamextfingerur", K::Extended(dir(1, 0, -1))),
    new_symbol_row('\u{e022}', "hamextfingerr", K::Extended(dir(0, 0, -1))),
    new_symbol_row('\u{e023}', "hamextfingerdr", K::Extended(dir(-1, 0, -1))),
    new_symbol_row('\u{e024}', "hamextfingerd", K::Extended(dir(-1, 0, 0))),
    new_symbol_row('\u{e025}', "hamextfingerdl", K::Extended(dir(-1, 0, 1))),
    new_symbol_row('\u{e026}', "hamextfingerl", K::Extended(dir(0, 0, 1))),
    new_symbol_row('\u{e027}', "hamextfingerul", K::Extended(dir(1, 0, 1))),
    new_symbol_row('\u{e028}', "hamextfingerol", K::Extended(dir(0, 1, 1))),
    new_symbol_row('\u{e029}', "hamextfingero", K::Extended(dir(0, 1, 0))),
    new_symbol_row('\u{e02a}', "hamextfingeror", K::Extended(dir(0, 1, -1))),
    new_symbol_row('\u{e02b}', "hamextfingeril", K::Extended(dir(0, -1, 1))),
    new_symbol_row('\u{e02c}', "hamextfingeri", K::Extended(dir(0, -1, 0))),
    new_symbol_row('\u{e02d}', "hamextfingerir", K::Extended(dir(0, -1, -1))),
    new_symbol_row('\u{e02e}', "hamextfingerui", K::Extended(dir(1, -1, 0))),
    new_symbol_row('\u{e02f}', "hamextfingerdi", K::Extended(dir(-1, -1, 0))),
    new_symbol_row('\u{e030}', "hamextfingerdo", K::Extended(dir(-1, 1, 0))),
    new_symbol_row('\u{e031}', "hamextfingeruo", K::Extended(dir(1, 1, 0))),
    new_symbol_row('\u{e038}', "hampalmu", K::Palm(CompassDirection::U)),
    new_symbol_row('\u{e039}', "hampalmur", K::Palm(CompassDirection::Ur)),
    new_symbol_row('\u{e03a}', "hampalmr", K::Palm(CompassDirection::R)),
    new_symbol_row('\u{e03b}', "hampalmdr", K::Palm(CompassDirection::Dr)),
    new_symbol_row('\u{e03c}', "hampalmd", K::Palm(CompassDirection::D)),
    new_symbol_row('\u{e03d}', "hampalmdl", K::Palm(CompassDirection::Dl)),
    new_symbol_row('\u{e03e}', "hampalml", K::Palm(CompassDirection::L)),
    new_symbol_row('\u{e03f}', "hampalmul", K::Palm(CompassDirection::Ul)),
    new_symbol_row('\u{e040}', "hamhead", K::Body(BodyLocation::Head)),
    new_symbol_row('\u{e041}', "hamheadtop", K::Body(BodyLocation::HeadTop)),
    new_symbol_row('\u{e042}', "hamforehead", K::Body(BodyLocation::Forehead)),
    new_symbol_row('\u{e043}', "hameyebrows", K::Body(BodyLocation::Eyebrows)),
    new_symbol_row('\u{e044}', "hameyes", K::Body(BodyLocation::Eyes)),
    new_symbol_row('\u{e045}', "hamnose", K::Body(BodyLocation::Nose)),
    new_symbol_row('\u{e046}', "hamnostrils", K::Body(BodyLocation::Nostrils)),
    new_symbol_row('\u{e047}', "hamear", K::Body(BodyLocation::Ear)),
    new_symbol_row('\u{e048}', "hamearlobe", K::Body(BodyLocation::EarLobe)),
    new_symbol_row('\u{e049}', "hamcheek", K::Body(BodyLocation::Cheek)),
    new_symbol_row('\u{e04a}', "hamlips", K::Body(BodyLocation::Lips)),
    new_symbol_row('\u{e04b}', "hamtongue", K::Body(BodyLocation::Tongue)),
    new_symbol_row('\u{e04c}', "hamteeth", K::Body(BodyLocation::Teeth)),
    new_symbol_row('\u{e04d}', "hamchin", K::Body(BodyLocation::Chin)),
    new_symbol_row('\u{e04e}', "hamunderchin", K::Body(BodyLocation::UnderChin)),
    new_symbol_row('\u{e04f}', "hamneck", K::Body(BodyLocation::Neck)),
    new_symbol_row('\u{e050}', "hamshouldertop", K::Body(BodyLocation::ShoulderTop)),
    new_symbol_row('\u{e051}', "hamshoulders", K::Body(BodyLocation::Shoulders)),
    new_symbol_row('\u{e052}', "hamchest", K::Body(BodyLocation::Chest)),
    new_symbol_row('\u{e053}', "hamstomach", K::Body(BodyLocation::Stomach)),
    new_symbol_row('\u{e054}', "hambelowstomach", K::Body(BodyLocation::BelowStomach)),
    new_symbol_row('\u{e058}', "hamlrbeside", K::Beside),
    new_symbol_row('\u{e059}', "hamlrat", K::At),
    new_symbol_row('\u{e05a}', "hamcoreftag", K::Define),
    new_symbol_row('\u{e05b}', "hamcorefref", K::Refer),
    new_symbol_row('\u{e05f}', "hamneutralspace", K::Body(BodyLocation::NeutralSpace)),
    new_symbol_row('\u{e060}', "hamupperarm", K::Body(BodyLocation::UpperArm)),
    new_symbol_row('\u{e061}', "hamelbow", K::Body(BodyLocation::Elbow)),
    new_symbol_row('\u{e062}', "hamelbowinside", K::Body(BodyLocation::ElbowInside)),
    new_symbol_row('\u{e063}', "hamlowerarm", K::Body(BodyLocation::LowerArm)),
    new_symbol_row('\u{e064}', "hamwristback", K::Hand(HandLocation::WristBack)),
    new_symbol_row('\u{e065}', "hamwristpulse", K::WristSide(LocationSide::Palmar)),
    new_symbol_row('\u{e066}', "hamthumbball", K::Hand(HandLocation::ThumbBall)),
    new_symbol_row('\u{e067}', "hampalm", K::Hand(HandLocation::Palm)),
    new_symbol_row('\u{e068}', "hamhandback", K::Hand(HandLocation::HandBack)),
    new_symbol_row('\u{e069}', "hamthumbside", K::Hand(HandLocation::ThumbSide)),
    new_symbol_row('\u{e06a}', "hampinkyside", K::Hand(HandLocation::PinkySide)),
    new_symbol_row('\u{e070}', "hamthumb", K::Digit(HandDigit::Thumb)),
    new_symbol_row('\u{e071}', "hamindexfinger", K::Digit(HandDigit::Index)),
    new_symbol_row('\u{e072}', "hammiddlefinger", K::Digit(HandDigit::Middle)),
    new_symbol_row('\u{e073}', "hamringfinger", K::Digit(HandDigit::Ring)),
    new_symbol_row('\u{e074}', "hampinky", K::Digit(HandDigit::Little)),
    new_symbol_row('\u{e075}', "hamfingertip", K::Part(FingerPart::Tip)),
    new_symbol_row('\u{e076}', "hamfingernail", K::Part(FingerPart::Nail)),
    new_symbol_row('\u{e077}', "hamfingerpad", K::Part(FingerPart::Pad)),
    new_symbol_row('\u{e078}', "hamfingermidjoint", K::Part(FingerPart::MidJoint)),
    new_symbol_row('\u{e079}', "hamfingerbase", K::Part(FingerPart::Base)),
    new_symbol_row('\u{e07a}', "hamfingerside", K::Part(FingerPart::Side)),
    new_symbol_row('\u{e07c}', "hamwristtopulse", K::WristSide(LocationSide::Palmar)),
    new_symbol_row('\u{e07d}', "hamwristtoback", K::WristSide(LocationSide::Dorsal)),
    new_symbol_row('\u{e07e}', "hamwristtothumb", K::WristSide(LocationSide::Radial)),
    new_symbol_row('\u{e07f}', "hamwristtopinky", K::WristSide(LocationSide::Ulnar)),
    new_symbol_row('\u{e080}', "hammoveu", K::Move(dir(1, 0, 0))),
    new_symbol_row('\u{e081}', "hammoveur", K::Move(dir(1, 0, -1))),
    new_symbol_row('\u{e082}', "hammover", K::Move(dir(0, 0, -1))),
    new_symbol_row('\u{e083}', "hammovedr", K::Move(dir(-1, 0, -1))),
    new_symbol_row('\u{e084}', "hammoved", K::Move(dir(-1, 0, 0))),
    new_symbol_row('\u{e085}', "hammovedl", K::Move(dir(-1, 0, 1))),
    new_symbol_row('\u{e086}', "hammovel", K::Move(dir(0, 0, 1))),
    new_symbol_row('\u{e087}', "hammoveul", K::Move(dir(1, 0, 1))),
    new_symbol_row('\u{e088}', "hammoveol", K::Move(dir(0, 1, 1))),
    new_symbol_row('\u{e089}', "hammoveo", K::Move(dir(0, 1, 0))),
    new_symbol_row('\u{e08a}', "hammoveor", K::Move(dir(0, 1, -1))),
    new_symbol_row('\u{e08b}', "hammoveil", K::Move(dir(0, -1, 1))),
    new_symbol_row('\u{e08c}', "hammovei", K::Move(dir(0, -1, 0))),
    new_symbol_row('\u{e08d}', "hammoveir", K::Move(dir(0, -1, -1))),
    new_symbol_row('\u{e08e}', "hammoveui", K::Move(dir(1, -1, 0))),
    new_symbol_row('\u{e08f}', "hammovedi", K::Move(dir(-1, -1, 0))),
    new_symbol_row('\u{e090}', "hammovedo", K::Move(dir(-1, 1, 0))),
    new_symbol_row('\u{e091}', "hammoveuo", K::Move(dir(1, 1, 0))),
    new_symbol_row('\u{e092}', "hamcircleo", K::Circle(dir(0, 1, 0))),
    new_symbol_row('\u{e093}', "hamcirclei", K::Circle(dir(0, -1, 0))),
    new_symbol_row('\u{e094}', "hamcircled", K::Circle(dir(-1, 0, 0))),
    new_symbol_row('\u{e095}', "hamcircleu", K::Circle(dir(1, 0, 0))),
    new_symbol_row('\u{e096}', "hamcirclel", K::Circle(dir(0, 0, 1))),
    new_symbol_row('\u{e097}', "hamcircler", K::Circle(dir(0, 0, -1))),
    new_symbol_row('\u{e098}', "hamcircleul", K::Circle(dir(1, 0, 1))),
    new_symbol_row('\u{e099}', "hamcircledr", K::Circle(dir(-1, 0, -1))),
    new_symbol_row('\u{e09a}', "hamcircleur", K::Circle(dir(1, 0, -1))),
    new_symbol_row('\u{e09b}', "hamcircledl", K::Circle(dir(-1, 0, 1))),
    new_symbol_row('\u{e09c}', "hamcircleol", K::Circle(dir(0, 1, 1))),
    new_symbol_row('\u{e09d}', "hamcircleir", K::Circle(dir(0, -1, -1))),
    new_symbol_row('\u{e09e}', "hamcircleor", K::Circle(dir(0, 1, -1))),
    new_symbol_row('\u{e09f}', "hamcircleil", K::Circle(dir(0, -1, 1))),
    new_symbol_row('\u{e0a0}', "hamcircleui", K::Circle(dir(1, -1, 0))),
    new_symbol_row('\u{e0a1}', "hamcircledo", K::Circle(dir(-1, 1, 0))),
    new_symbol_row('\u{e0a2}', "hamcircleuo", K::Circle(dir(1, 1, 0))),
    new_symbol_row('\u{e0a3}', "hamcircledi", K::Circle(dir(-1, -1, 0))),
    new_symbol_row('\u{e0a4}', "hamfingerplay", K::FingerPlay),
    new_symbol_row('\u{e0a5}', "hamnodding", K::Wrist(WristMotion::Nodding)),
    new_symbol_row('\u{e0a6}', "hamswinging", K::Wrist(WristMotion::Swinging)),
    new_symbol_row('\u{e0a7}', "hamtwisting", K::Wrist(WristMotion::Twisting)),
    new_symbol_row('\u{e0a8}', "hamstircw", K::Wrist(WristMotion::StirCw)),
    new_symbol_row('\u{e0a9}', "hamstirccw", K::Wrist(WristMotion::StirCcw)),
    new_symbol_row('\u{e0aa}', "hamreplace", K::Replace),
    new_symbol_row('\u{e0ad}', "hammovecross", K::Cross { diagonal: false }),
    new_symbol_row('\u{e0ae}', "hammoveX", K::Cross { diagonal: true }),
    new_symbol_row('\u{e0af}', "hamnomotion", K::Still),
    new_symbol_row('\u{e0b0}', "hamclocku", K::Clock(CompassDirection::U)),
    new_symbol_row('\u{e0b1}', "hamclockul", K::Clock(CompassDirection::Ul)),
    new_symbol_row('\u{e0b2}', "hamclockl", K::Clock(CompassDirection::L)),
    new_symbol_row('\u{e0b3}', "hamclockdl", K::Clock(CompassDirection::Dl)),
    new_symbol_row('\u{e0b4}', "hamclockd", K::Clock(CompassDirection::D)),
    new_symbol_row('\u{e0b5}', "hamclockdr", K::Clock(CompassDirection::Dr)),
    new_symbol_row('\u{e0b6}', "hamclockr", K::Clock(CompassDirection::R)),
    new_symbol_row('\u{e0b7}', "hamclockur", K::Clock(CompassDirection::Ur)),
    new_symbol_row('\u{e0b8}', "hamclockfull", K::ClockFull),
    new_symbol_row('\u{e0b9}', "hamarcl", K::Arc(CompassDirection::L)),
    new_symbol_row('\u{e0ba}', "hamarcu", K::Arc(CompassDirection::U)),
    new_symbol_row('\u{e0bb}', "hamarcr", K::Arc(CompassDirection::R)),
    new_symbol_row('\u{e0bc}', "hamarcd", K::Arc(CompassDirection::D)),
    new_symbol_row('\u{e0bd}', "hamwavy", K::Zigzag { wavy: true }),
    new_symbol_row('\u{e0be}', "hamzigzag", K::Zigzag { wavy: false }),
    new_symbol_row('\u{e0c0}', "hamellipseh", K::Ellipse(EllipseAxis::Horizontal)),
    new_symbol_row('\u{e0c1}', "hamellipseur", K::Ellipse(EllipseAxis::UpRight)),
    new_symbol_row('\u{e0c2}', "hamellipsev", K::Ellipse(EllipseAxis::Vertical)),
    new_symbol_row('\u{e0c3}', "hamellipseul", K::Ellipse(EllipseAxis::UpLeft)),
    new_symbol_row('\u{e0c4}', "hamincreasing", K::Growth { increasing: true }),
    new_symbol_row('\u{e0c5}', "hamdecreasing", K::Growth { increasing: false }),
    new_symbol_row('\u{e0c6}', "hamsmallmod", K::Size(MotionSize::Small)),
    new_symbol_row('\u{e0c7}', "hamlargemod", K::Size(MotionSize::Big)),
    new_symbol_row('\u{e0c8}', "hamfast", K::Manner(MannerMark::Fast)),
    new_symbol_row('\u{e0c9}', "hamslow", K::Manner(MannerMark::Slow)),
    new_symbol_row('\u{e0ca}', "hamtense", K::Manner(MannerMark::Tense)),
    new_symbol_row('\u{e0cb}', "hamrest", K::Manner(MannerMark::Rest)),
    new_symbol_row('\u{e0cc}', "hamhalt", K::Manner(MannerMark::Halt)),
    new_symbol_row('\u{e0d0}', "hamclose", K::Contact(PlaceContact::Close)),
    new_symbol_row('\u{e0d1}', "hamtouch", K::Contact(PlaceContact::Touch)),
    new_symbol_row('\u{e0d2}', "haminterlock", K::Contact(PlaceContact::Interlock)),
    new_symbol_row('\u{e0d3}', "hamcross", K::Contact(PlaceContact::Cross)),
    new_symbol_row('\u{e0d4}', "hamarmextended", K::Contact(PlaceContact::ArmExtended)),
    new_symbol_row('\u{e0d5}', "hambehind", K::Behind),
    new_symbol_row('\u{e0d6}', "hambrushing", K::Contact(PlaceContact::Brushing)),
    new_symbol_row('\u{e0d8}', "hamrepeatfromstart", K::Repeat(RepeatKind::FromStart)),
    new_symbol_row('\u{e0d9}', "hamrepeatfromstartseveral", K::Repeat(RepeatKind::FromStartSeveral)),
    new_symbol_row('\u{e0da}', "hamrepeatcontinue", K::Repeat(RepeatKind::Continue)),
    new_symbol_row('\u{e0db}', "hamrepeatcontinueseveral", K::Repeat(RepeatKind::ContinueSeveral)),
    new_symbol_row('\u{e0dc}', "hamrepeatreverse", K::Repeat(RepeatKind::Reverse)),
    new_symbol_row('\u{e0dd}', "hamalternatingmotion", K::Alternating),
    new_symbol_row('\u{e0e0}', "hamseqbegin", K::Open(BracketKind::Seq)),
    new_symbol_row('\u{e0e1}', "hamseqend", K::Close(BracketKind::Seq)),
    new_symbol_row('\u{e0e2}', "hamparbegin", K::Open(BracketKind::Par)),
    new_symbol_row('\u{e0e3}', "hamparend", K::Close(BracketKind::Par)),
    new_symbol_row('\u{e0e4}', "hamfusionbegin", K::Open(BracketKind::Fusion)),
    new_symbol_row('\u{e0e5}', "hamfusionend", K::Close(BracketKind::Fusion)),
    new_symbol_row('\u{e0e6}', "hambetween", K::Between),
    new_symbol_row('\u{e0e7}', "hamplus", K::Plus),
    new_symbol_row('\u{e0e8}', "hamsymmpar", K::Symmetry { left_right: false }),
    new_symbol_row('\u{e0e9}', "hamsymmlr", K::Symmetry { left_right: true }),
    new_symbol_row('\u{e0ea}', "hamnondominant", K::Nondominant),
    new_symbol_row('\u{e0eb}', "hamnonipsi", K::RealSpace),
    new_symbol_row('\u{e0ec}', "hametc", K::Approx),
    new_symbol_row('\u{e0ed}', "hamorirelative", K::Relative),
    new_symbol_row('\u{e0f0}', "hammime", K::Mime),
    new_symbol_row('\u{e0f1}', "hamversion40", K::Version),
];
