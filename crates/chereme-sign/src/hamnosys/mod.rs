//! Signs as notation: the tree that HamNoSys 4 and SiGML both write down.
//!
//! One tree serves both: HamNoSys text (one symbol after another) and gestural SiGML (elements with
//! attributes) are two spellings of it. Everything is from the signer's own point of view, and where
//! a sign is two-handed with symmetry, what is said is about the dominant hand.

pub mod components;
pub mod direction;
mod error;
mod lex;
pub mod nonmanual;
mod notated;
mod parse;
mod print;
pub mod symbol;
pub mod tree;

pub use direction::{Compass, Direction};
pub use error::{Finding, HamnosysError};
pub use lex::{MAX_SYMBOLS, from_names, to_names};
pub use nonmanual::{Act, Nonmanual, NonmanualPart, NonmanualTier, TierEnd, TierKind, TierStart};
pub use notated::Notated;
pub use parse::{MAX_DEPTH, Transcription, parse, parse_lenient};
pub use print::{Loss, Printed, print, text_of};
pub use symbol::{Class, Symbol};
pub use tree::{
    Aim, Amount, Bend, BodyAction, BodyLocation, BodyPlace, Circular, Clock, Constellation,
    Contact, Curve, Digit, Digits, Directed, Each, Ellipse, FingerContact, FingerPart, Form, Frame,
    Growth, HandClass, HandLocation, HandSite, HandsUsed, Handshape, Manner, Manual, Motion,
    MotionKind, Opening, Place, Posture, Repeat, Repetition, Side, Sign, Site, Size, Symmetry,
    ThumbExtra, ThumbPosition, WristMotion, Written, Zigzag,
};

#[cfg(test)]
mod laws;
