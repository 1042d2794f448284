//! Parses symbols into the tree, by recursive descent with one symbol of look-ahead and a bounded depth.
//!
//! A text is read once; if the canonical print of the result differs from the text, it is read a second
//! time, and every part that prints differently from its own symbols remembers them ([`Written`]).
//! Therefore every accepted text prints unchanged.

mod action;
mod place;
mod posture;

use super::error::{Finding, HamnosysError};
use super::lex::{self, Lexed, Token};
use super::print::{self, Write};
use super::symbol::{Bracket, Kind, Symbol};
use super::tree::{Bend, BodyAction, HandsUsed, Manual, Posture, Sign, Size, Symmetry, Written};

/// Largest depth of nested brackets and modifiers.
pub const MAX_DEPTH: usize = 48;

/// A transcription after reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Transcription {
    /// The sign.
    pub sign: Sign,
    /// Oddities of the text; everything that the tree does not hold is listed here.
    pub findings: Vec<Finding>,
    /// The text, if it was not written in the symbols' own characters.
    text: Option<Box<str>>,
}

impl Transcription {
    /// Returns the original text, byte by byte.
    #[must_use]
    pub fn print(&self) -> String {
        match &self.text {
            Some(text) => text.to_string(),
            None => print::text_of(&self.sign),
        }
    }

    /// Returns whether some symbols are in the text only, not in the tree.
    #[must_use]
    pub fn is_partial(&self) -> bool {
        self.findings.iter().any(|finding| finding.dropped)
    }
}

/// Reads a transcription: characters, names of symbols, or both.
///
/// # Errors
/// [`HamnosysError`] for the first symbol that cannot be at its place, with the expected ones.
pub fn parse(text: &str) -> Result<Transcription, HamnosysError> {
    read(text, false)
}

/// Reads the parts of a transcription that can be understood; the findings list the rest. The tree keeps
/// the whole text, so that it prints unchanged.
#[must_use]
pub fn parse_lenient(text: &str) -> Transcription {
    read(text, true).unwrap_or_else(|error| Transcription {
        sign: Sign::default(),
        findings: vec![Finding::from(&error)],
        text: Some(text.into()),
    })
}

impl From<&HamnosysError> for Finding {
    fn from(error: &HamnosysError) -> Self {
        Self {
            index: error.index().unwrap_or_default(),
            // The index stands before the message of a finding.
            message: match error {
                HamnosysError::Unexpected {
                    symbol, expected, ..
                } => format!("{symbol} stands where only {expected} can be"),
                HamnosysError::Ended { expected, .. } => {
                    format!("the text ends, but expected {expected}")
                }
                other => other.to_string(),
            },
            remedy: "mend or remove it",
            dropped: true,
        }
    }
}

fn read(text: &str, lenient: bool) -> Result<Transcription, HamnosysError> {
    let mut lexed = lex::lex(text, lenient)?;
    if lexed.text.trim().is_empty() {
        return Err(HamnosysError::Empty);
    }
    let findings = std::mem::take(&mut lexed.findings);
    let mut parser = Parser::new(&lexed, lenient, false);
    let mut sign = parser.sign()?;
    if print::text_of(&sign) != *lexed.text {
        parser = Parser::new(&lexed, lenient, true);
        sign = parser.sign()?;
    }
    let mut findings = [findings, parser.findings].concat();
    findings.sort_by_key(|finding| finding.index);
    Ok(Transcription {
        sign,
        findings,
        text: (*lexed.text != *text).then(|| text.into()),
    })
}

type Parsed<T> = Result<T, HamnosysError>;

struct Parser<'a> {
    text: &'a str,
    tokens: &'a [Token],
    count: usize,
    at: usize,
    depth: usize,
    lenient: bool,
    /// Whether parts that print differently remember their symbols.
    remember: bool,
    findings: Vec<Finding>,
}

impl<'a> Parser<'a> {
    fn new(lexed: &'a Lexed<'_>, lenient: bool, remember: bool) -> Self {
        Self {
            text: &lexed.text,
            tokens: &lexed.tokens,
            count: lexed.count,
            at: 0,
            depth: 0,
            lenient,
            remember,
            findings: Vec::new(),
        }
    }

    fn sign(&mut self) -> Parsed<Sign> {
        let mut parts: Vec<Manual> = Vec::new();
        let mut from = 0;
        while parts.is_empty() || self.at < self.tokens.len() {
            let start = self.at;
            let mut part = self.manual(parts.is_empty())?;
            if self.at == start && self.at < self.tokens.len() {
                self.unexpected("a handshape, a movement or another part of a sign")?;
            } else if !parts.is_empty() && part == Manual::default() {
                self.missing("another sign after hamplus")?;
            }
            let to = self
                .tokens
                .get(self.at)
                .map_or(self.text.len(), |next| next.start as usize);
            if self.remember {
                let separator = !parts.is_empty();
                let mut out = Write::default();
                out.manual(&part, separator);
                if out.text != self.text[from..to] {
                    part.written = Written(Some(self.text[from..to].into()));
                }
            }
            from = to;
            parts.push(part);
        }
        Ok(Sign { parts })
    }

    fn manual(&mut self, first: bool) -> Parsed<Manual> {
        if !first && !self.eat(Kind::Plus) {
            self.note(
                "another sign begins without hamplus before it",
                "write hamplus between the parts of a compound, or hamreplace before a new handshape",
                false,
            );
        }
        let mut part = Manual {
            hands: self.hands()?,
            ..Manual::default()
        };
        while self.at_body_action() || self.at_body_part() {
            part.body.push(self.body_action()?.0);
        }
        part.posture = self.posture()?;
        part.actions = self.actions()?;
        Ok(part)
    }

    fn hands(&mut self) -> Parsed<HandsUsed> {
        let left_right = match self.peek() {
            Some(Kind::Nondominant) => {
                self.at += 1;
                return Ok(HandsUsed::Nondominant);
            }
            Some(Kind::Symmetry { left_right }) => left_right,
            _ => return Ok(HandsUsed::Dominant),
        };
        self.at += 1;
        let mut symmetry = Symmetry {
            left_right,
            ..Symmetry::default()
        };
        while let Some(kind) = self.peek() {
            let flag = match kind {
                Kind::Size(Size::Big) => &mut symmetry.up_down,
                Kind::Bend(Bend::Bent) => &mut symmetry.out_in,
                Kind::Alternating => &mut symmetry.out_of_phase,
                Kind::RealSpace => &mut symmetry.real_space,
                _ => break,
            };
            if std::mem::replace(flag, true) {
                self.note("the mark is there twice", "write it once", true);
            }
            self.at += 1;
        }
        Ok(HandsUsed::Both(symmetry))
    }

    /// Returns whether an action of the body begins here.
    fn at_body_action(&self) -> bool {
        self.after_body_site()
            .and_then(|at| self.kind(at))
            .is_some_and(is_motion)
    }

    /// Returns whether a held part of the body begins here, before the description of the hands.
    fn at_body_part(&self) -> bool {
        self.after_body_site()
            .is_some_and(|at| match self.kind(at) {
                Some(Kind::Base(_)) => true,
                Some(Kind::Open(Bracket::Par)) => self.is_split_config(at, &Posture::default()),
                _ => false,
            })
    }

    /// Returns the index after a place on the body with its side, if one is here.
    fn after_body_site(&self) -> Option<usize> {
        let side = |at: usize| matches!(self.kind(at), Some(Kind::At | Kind::Beside));
        let mut at = self.at;
        while side(at) {
            at += 1;
        }
        if !matches!(self.kind(at), Some(Kind::Body(_))) {
            return None;
        }
        at += 1;
        while side(at) || matches!(self.kind(at), Some(Kind::Bend(_))) {
            at += 1;
        }
        Some(at)
    }

    fn body_action(&mut self) -> Parsed<(BodyAction, usize)> {
        let site = self.body_site()?;
        let motion = match self.peek() {
            Some(kind) if is_motion(kind) => Some(self.deeper(Self::action)?),
            _ => None,
        };
        let height = 1 + motion.as_ref().map_or(0, |deep| deep.1);
        let action = BodyAction {
            part: site.at,
            side: site.side,
            motion: motion.map(|deep| Box::new(deep.0)),
        };
        Ok((action, height))
    }

    fn kind(&self, at: usize) -> Option<Kind> {
        self.tokens.get(at).map(|token| token.kind)
    }

    fn peek(&self) -> Option<Kind> {
        self.kind(self.at)
    }

    fn next_is(&self, ahead: usize, kind: Kind) -> bool {
        self.kind(self.at + ahead) == Some(kind)
    }

    fn eat(&mut self, kind: Kind) -> bool {
        let there = self.next_is(0, kind);
        self.at += usize::from(there);
        there
    }

    /// Returns the symbols from one token up to another as text.
    fn slice(&self, from: usize, to: usize) -> &'a str {
        let (Some(first), Some(last)) =
            (self.tokens.get(from), self.tokens.get(to.wrapping_sub(1)))
        else {
            return "";
        };
        self.text
            .get(first.start as usize..last.end())
            .unwrap_or_default()
    }

    /// Returns the symbols that a part read since `from` must remember: its own, unless it prints the same
    /// by `write`.
    fn written(&self, from: usize, write: impl FnOnce(&mut Write)) -> Written {
        if !self.remember {
            return Written(None);
        }
        let mut out = Write::default();
        write(&mut out);
        let text = self.slice(from, self.at);
        Written((out.text != text).then(|| text.into()))
    }

    fn index(&self) -> usize {
        self.tokens
            .get(self.at)
            .map_or(self.count, |token| token.index as usize)
    }

    fn wrong(&self, expected: &'static str) -> HamnosysError {
        let index = self.index();
        match self.tokens.get(self.at) {
            Some(token) => HamnosysError::Unexpected {
                index,
                symbol: token.symbol,
                expected,
            },
            None => HamnosysError::Ended { index, expected },
        }
    }

    /// Refuses the next symbol; a lenient reading leaves it out.
    fn unexpected(&mut self, expected: &'static str) -> Parsed<()> {
        self.missing(expected)?;
        self.at += 1;
        Ok(())
    }

    /// Reports that something is missing here; a lenient reading continues without it.
    fn missing(&mut self, expected: &'static str) -> Parsed<()> {
        let error = self.wrong(expected);
        if !self.lenient {
            return Err(error);
        }
        self.findings.push(Finding::from(&error));
        Ok(())
    }

    /// Adds a finding about the next symbol.
    fn note(&mut self, message: &str, remedy: &'static str, dropped: bool) {
        let symbol = self
            .tokens
            .get(self.at)
            .map_or("end", |token| token.symbol.name());
        self.findings.push(Finding {
            index: self.index(),
            message: format!("{symbol}: {message}"),
            remedy,
            dropped,
        });
    }

    /// Leaves out the next symbol, with a finding.
    fn drop(&mut self, message: &str, remedy: &'static str) {
        self.note(message, remedy, true);
        self.at += 1;
    }

    fn close(&mut self, opened: usize, bracket: Bracket) -> Parsed<()> {
        if self.eat(Kind::Close(bracket)) {
            return Ok(());
        }
        let Some(token) = self.tokens.get(opened) else {
            return Ok(());
        };
        let error = HamnosysError::Unclosed {
            index: token.index as usize,
            symbol: token.symbol,
            at: self.index(),
            expected: Symbol::of(Kind::Close(bracket)).map_or("a bracket", Symbol::name),
        };
        if !self.lenient {
            return Err(error);
        }
        self.findings.push(Finding::from(&error));
        Ok(())
    }

    fn deeper<T>(&mut self, inner: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.depth >= MAX_DEPTH {
            return Err(self.too_deep());
        }
        self.depth += 1;
        let result = inner(self);
        self.depth -= 1;
        result
    }

    fn too_deep(&self) -> HamnosysError {
        HamnosysError::TooDeep {
            index: self.index(),
            limit: MAX_DEPTH,
        }
    }

    /// Returns the tokens within the group that opens at `at`, up to its close or the end, and the index
    /// of its own hamplus.
    fn group(&self, at: usize) -> (&'a [Token], Option<usize>) {
        let inside = self.tokens.get(at + 1..).unwrap_or_default();
        let mut depth = 0_usize;
        let mut plus = None;
        for (offset, token) in inside.iter().enumerate() {
            match token.kind {
                Kind::Open(_) => depth += 1,
                Kind::Close(_) if depth == 0 => return (&inside[..offset], plus),
                Kind::Close(_) => depth -= 1,
                Kind::Plus if depth == 0 && plus.is_none() => plus = Some(offset),
                _ => {}
            }
        }
        (inside, plus)
    }
}

/// Returns whether a movement, or a group that can only be one, begins with this symbol.
fn is_motion(kind: Kind) -> bool {
    use Kind as K;
    matches!(
        kind,
        K::Move(_) | K::Circle(_) | K::Wrist(_) | K::FingerPlay | K::Cross { .. } | K::Still
    )
}

#[cfg(test)]
mod tests;
