//! Signs as notation: the tree that HamNoSys 4 and SiGML both write down.
//!
//! One tree serves both: HamNoSys text (one symbol after another) and gestural SiGML (elements with
//! attributes) are two spellings of it. Everything is from the signer's own point of view; if both hands
//! act by a symmetry, the notation describes the dominant hand.
//!
//! ```
//! use chereme_sign::hamnosys::{parse_hamnosys, parse_lenient, print_hamnosys};
//!
//! let read = parse_hamnosys("hamsymmlr hamflathand hamextfingero hampalmd hamchest hammovel hamfast")?;
//! assert_eq!(read.sign.parts[0].actions.len(), 1);
//! assert_eq!(print_hamnosys(&read.sign).text, "\u{e0e9}\u{e001}\u{e029}\u{e03c}\u{e052}\u{e086}\u{e0c8}");
//!
//! let error = parse_hamnosys("hamfist hamsmallmod").expect_err("a size of nothing");
//! assert!(error.to_string().starts_with("symbol 2 is hamsmallmod, but expected a movement"));
//! assert_eq!(parse_lenient("hamfist hamsmallmod").sign.parts.len(), 1);
//! # Ok::<(), chereme_sign::hamnosys::HamnosysError>(())
//! ```
//!
//! # Reading and writing text
//!
//! [`parse_hamnosys()`] refuses impossible notation and names the symbol; [`parse_lenient`] leaves such symbols out
//! and reports them. In both modes the tree prints to exactly the bytes that were read: [`print_hamnosys()`] has
//! one canonical order, and each part with another spelling remembers its own symbols ([`WrittenSymbols`]). Text
//! that the tree does not hold is a [`HamnosysFinding`]; a part of the tree that text cannot express is a
//! [`NotationLoss`].
//!
//! The grammar, in canonical order (`?` may be left out, `*` any number, `|` or; capitals are symbols):
//!
//! | what | how it is written |
//! |---|---|
//! | sign | part (PLUS part)* |
//! | part | hands? (site movement?)? posture movement* |
//! | hands | (SYMMPAR or SYMMLR) STRAIGHTMOD? (out and in) LARGEMOD? (up and down) ALTERNATING? NONIPSI? \| NONDOMINANT |
//! | posture | shape extended palm place; parts that differ by hand in one PAR dominant PLUS other PAREND |
//! | shape | form (BETWEEN form)? ETC? (digit LARGEMOD? \| digit bend)* (digit part digit \| digit CROSS digit)* thumb? |
//! | form | class thumb? bend?; bend may be two with BETWEEN: their middle |
//! | digits | selected or left out by the bend, by class; with LARGEMOD the one that the thumb meets |
//! | thumb | BETWEEN digit digit (between them) \| BETWEEN (enclosed) \| part (touched) |
//! | extended, palm | direction (BETWEEN direction)? ETC? RELATIVE?; two symbols `uo ol` are the corner `uol` |
//! | place | body \| hand \| hands \| PAR place? PLUS place? PAREND \| COREFREF (1 to 5 times) |
//! | body | side? location level? side? ETC? (BETWEEN the same)? BEHIND? contact? COREFTAG*; level is DOUBLEBENT (upper), DOUBLEHOOKED (lower) |
//! | hand | side? (part digit* \| digits) (side or PALM, HANDBACK, THUMBSIDE, PINKYSIDE)? ETC? (BETWEEN the same)? contact? |
//! | hands by each other | (PAR hand PLUS hand PAREND)? contact body? |
//! | contact | TOUCH, CLOSE, CROSS, INTERLOCK, ARMEXTENDED \| SEQ contact hand SEQEND |
//! | movement | (way \| circle \| wrist \| play \| cross \| NOMOTION \| REPLACE posture \| group) then manner*, place, repetition, each again |
//! | way | MOVE (BETWEEN MOVE)? size? (ARC ARC? size?)? ((WAVY or ZIGZAG) size? growth?)? ELLIPSE? |
//! | circle | CIRCLE (BETWEEN CIRCLE)? size? (ELLIPSE size?)? CLOCK? CLOCK? CLOCKFULL* zigzag? growth? |
//! | group | SEQ movement* SEQEND \| FUSION movement* FUSIONEND \| PAR movement* PAREND \| PAR movement? PLUS movement? PAREND \| site movement |
//! | brushing | SEQ BRUSHING place SEQEND, the place with its contact |
//! | repetition | repeat repeat? growth? ETC? \| SEQ repeat repeat? growth? ETC? MOVE size? growth? SEQEND |
//! | manner | FAST SLOW TENSE REST HALT ALTERNATING ALTERNATING |
//!
//! Accepted besides: marks in any order, digits before the part of a finger, a bare contact group for
//! both hands alike, configurations without REPLACE, parts without PLUS, blanks anywhere; punctuation,
//! mime and all alternatives but the first stay in the text only.
//!
//! Sources: the symbols of the HamNoSys4TeX font (University of Hamburg); the structures that the
//! University of East Anglia's stylesheet from HamNoSys to SiGML names; openly published lexicons of
//! German, Greek, French, Polish and British Sign Language for the order in which transcribers write.

pub mod angles;
pub mod components;
pub mod direction;
pub mod drawing;
mod error;
mod garbled;
pub mod hamnosys_face;
pub mod hamnosys_language;
mod hamnosys_lex;
pub mod hamnosys_nonmanual;
mod hamnosys_notated;
pub mod orientation;
mod parse;
mod print;
pub mod sites;
pub mod symbol;
pub mod tree;

pub use direction::{CompassDirection, SpatialDirection};
pub use error::{HamnosysError, HamnosysFinding};
pub use garbled::{is_garbled, repair_garbled_symbols};
pub use hamnosys_language::{BodyLanguage, BodyLanguageError, LanguageChanges};
pub use hamnosys_lex::{MAX_SYMBOLS, from_names, in_plain_symbols, spelled_symbols, to_names};
pub use hamnosys_nonmanual::{NonmanualAct, NonmanualActs, NonmanualPart, NonmanualTier, TierEnd, TierKind, TierStart};
pub use hamnosys_notated::NotatedSign;
pub use parse::{HamnosysTranscription, MAX_BRACKET_DEPTH, parse_hamnosys, parse_lenient};
pub use print::{NotationLoss, PrintedSign, print_hamnosys, sign_hamnosys_text};
pub use symbol::{HamnosysSymbol, SymbolClass};
pub use tree::{
    BodyAction, BodyLocation, BodyPlace, CeeOpening, CircularPath, ClockRange, DigitList, DirectedPath, DirectionAim,
    DirectionFrame, EachHand, EllipseAxis, FingerBend, FingerContact, FingerPart, HamnosysSign, HandClass,
    HandConstellation, HandDigit, HandLocation, HandPlace, HandSite, HandSymmetry, HandsUsed, Handshape, HandshapeForm,
    LocationSide, ManualPart, MotionGrowth, MotionKind, MotionManner, MotionRepetition, MotionSize, NotatedMotion,
    NotatedPosture, PathCurve, PathZigzag, PlaceContact, RepeatKind, SidedLocation, SizeAmount, ThumbExtra,
    ThumbPosition, WristMotion, WrittenSymbols,
};

#[cfg(test)]
mod laws_tests;
