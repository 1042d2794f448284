//! Parses symbols into the tree, by recursive descent with one symbol of look-ahead and a bounded depth.
//!
//! A text is read once; if the canonical print of the result differs from the text, it is read a second
//! time, and every part that prints differently from its own symbols remembers them ([`WrittenSymbols`]).
//! Therefore every accepted text prints unchanged.

mod parse_action;
mod parse_place;
mod parse_posture;

use super::error::{HamnosysError, HamnosysFinding};
use super::hamnosys_lex::{self, LexedSymbol, LexedText};
use super::print::{self, HamnosysWriter};
use super::symbol::{BracketKind, HamnosysSymbol, SymbolKind};
use super::tree::{
    BodyAction, FingerBend, HamnosysSign, HandSymmetry, HandsUsed, ManualPart, MotionSize, NotatedPosture,
    WrittenSymbols,
};

/// Largest depth of nested brackets and modifiers.
pub const MAX_BRACKET_DEPTH: usize = 48;

/// A transcription after reading.
#[derive(Debug, Clone, PartialEq)]
pub struct HamnosysTranscription {
    /// The sign.
    pub sign: HamnosysSign,
    /// Oddities of the text; everything that the tree does not hold is listed here.
    pub findings: Vec<HamnosysFinding>,
    /// The text, if it was not written in the symbols' own characters.
    text: Option<Box<str>>,
}

impl HamnosysTranscription {
    /// Returns the original text, byte by byte.
    #[must_use]
    pub fn transcription_text(&self) -> String {
        match &self.text {
            Some(text) => text.to_string(),
            None => print::sign_hamnosys_text(&self.sign),
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
pub fn parse_hamnosys(text: &str) -> Result<HamnosysTranscription, HamnosysError> {
    read_transcription(text, false)
}

/// Reads the parts of a transcription that can be understood; the findings list the rest. The tree keeps
/// the whole text, so that it prints unchanged.
#[must_use]
pub fn parse_lenient(text: &str) -> HamnosysTranscription {
    read_transcription(text, true).unwrap_or_else(|error| HamnosysTranscription {
        sign: HamnosysSign::default(),
        findings: vec![HamnosysFinding::from(&error)],
        text: Some(text.into()),
    })
}

impl From<&HamnosysError> for HamnosysFinding {
    fn from(error: &HamnosysError) -> Self {
        Self {
            index: error.index().unwrap_or_default(),
            // The index stands before the message of a finding.
            message: match error {
                HamnosysError::Unexpected { symbol, expected, .. } => {
                    format!("{symbol} stands where only {expected} can be")
                }
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

fn read_transcription(text: &str, lenient: bool) -> Result<HamnosysTranscription, HamnosysError> {
    let mut lexed = hamnosys_lex::lex_hamnosys(text, lenient)?;
    if lexed.text.trim().is_empty() {
        return Err(HamnosysError::Empty);
    }
    let findings = std::mem::take(&mut lexed.findings);
    let mut parser = HamnosysParser::new(&lexed, lenient, false);
    let mut sign = parser.parse_hamnosys_sign()?;
    if print::sign_hamnosys_text(&sign) != *lexed.text {
        parser = HamnosysParser::new(&lexed, lenient, true);
        sign = parser.parse_hamnosys_sign()?;
    }
    let mut findings = [findings, parser.findings].concat();
    findings.sort_by_key(|finding| finding.index);
    Ok(HamnosysTranscription {
        sign,
        findings,
        text: (*lexed.text != *text).then(|| text.into()),
    })
}

type HamnosysParsed<T> = Result<T, HamnosysError>;

struct HamnosysParser<'a> {
    text: &'a str,
    tokens: &'a [LexedSymbol],
    count: usize,
    at: usize,
    depth: usize,
    lenient: bool,
    /// Whether parts that print differently remember their symbols.
    remember: bool,
    findings: Vec<HamnosysFinding>,
}

impl<'a> HamnosysParser<'a> {
    fn new(lexed: &'a LexedText<'_>, lenient: bool, remember: bool) -> Self {
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

    fn parse_hamnosys_sign(&mut self) -> HamnosysParsed<HamnosysSign> {
        let mut parts: Vec<ManualPart> = Vec::new();
        let mut from = 0;
        while parts.is_empty() || self.at < self.tokens.len() {
            let start = self.at;
            let mut part = self.parse_manual_part(parts.is_empty())?;
            // Nothing was read and something is left: it must be taken away, or this would not end.
            if self.at == start && self.at < self.tokens.len() {
                self.refuse_next_symbol("a handshape, a movement or another part of a sign")?;
            } else if !parts.is_empty() && part == ManualPart::default() {
                self.report_missing_symbol("another sign after hamplus")?;
            }
            let to = self
                .tokens
                .get(self.at)
                .map_or(self.text.len(), |next| next.start as usize);
            if self.remember {
                let separator = !parts.is_empty();
                let mut out = HamnosysWriter::default();
                out.write_manual_part(&part, separator);
                // The symbols are kept only where writing the tree would give others.
                if out.text != self.text[from..to] {
                    part.written = WrittenSymbols(Some(self.text[from..to].into()));
                }
            }
            from = to;
            parts.push(part);
        }
        Ok(HamnosysSign { parts })
    }

    fn parse_manual_part(&mut self, first: bool) -> HamnosysParsed<ManualPart> {
        if !first && !self.eat_symbol_kind(SymbolKind::Plus) {
            self.note_symbol_finding(
                "another sign begins without hamplus before it",
                "write hamplus between the parts of a compound, or hamreplace before a new handshape",
                false,
            );
        }
        let mut part = ManualPart {
            hands: self.parse_hands_used()?,
            ..ManualPart::default()
        };
        while self.at_body_action() || self.at_body_part() {
            part.body.push(self.parse_body_action()?.0);
        }
        part.posture = self.parse_hand_posture()?;
        part.actions = self.parse_actions()?;
        Ok(part)
    }

    fn parse_hands_used(&mut self) -> HamnosysParsed<HandsUsed> {
        let left_right = match self.peek_symbol_kind() {
            Some(SymbolKind::Nondominant) => {
                self.at += 1;
                return Ok(HandsUsed::Nondominant);
            }
            Some(SymbolKind::Symmetry { left_right }) => left_right,
            _ => return Ok(HandsUsed::Dominant),
        };
        self.at += 1;
        let mut symmetry = HandSymmetry {
            left_right,
            ..HandSymmetry::default()
        };
        while let Some(kind) = self.peek_symbol_kind() {
            let flag = match kind {
                // Two marks of the symmetry look like others: the larger size is up and down, the bend is out and in.
                SymbolKind::Size(MotionSize::Big) => &mut symmetry.up_down,
                SymbolKind::Bend(FingerBend::Bent) => &mut symmetry.out_in,
                SymbolKind::Alternating => &mut symmetry.out_of_phase,
                SymbolKind::RealSpace => &mut symmetry.real_space,
                _ => break,
            };
            if std::mem::replace(flag, true) {
                self.note_symbol_finding("the mark is there twice", "write it once", true);
            }
            self.at += 1;
        }
        Ok(HandsUsed::Both(symmetry))
    }

    /// Returns whether an action of the body begins here.
    fn at_body_action(&self) -> bool {
        self.after_body_site()
            .and_then(|at| self.symbol_kind_at(at))
            .is_some_and(is_motion)
    }

    /// Returns whether a held part of the body begins here, before the description of the hands.
    fn at_body_part(&self) -> bool {
        self.after_body_site().is_some_and(|at| match self.symbol_kind_at(at) {
            Some(SymbolKind::Base(_)) => true,
            Some(SymbolKind::Open(BracketKind::Par)) => self.is_split_config(at, &NotatedPosture::default()),
            _ => false,
        })
    }

    /// Returns the index after a place on the body with its side, if one is here.
    fn after_body_site(&self) -> Option<usize> {
        let side = |at: usize| matches!(self.symbol_kind_at(at), Some(SymbolKind::At | SymbolKind::Beside));
        let mut position = self.at;
        while side(position) {
            position += 1;
        }
        if !matches!(self.symbol_kind_at(position), Some(SymbolKind::Body(_))) {
            return None;
        }
        position += 1;
        while side(position) || matches!(self.symbol_kind_at(position), Some(SymbolKind::Bend(_))) {
            position += 1;
        }
        Some(position)
    }

    fn parse_body_action(&mut self) -> HamnosysParsed<(BodyAction, usize)> {
        let site = self.parse_body_site()?;
        let motion = match self.peek_symbol_kind() {
            Some(kind) if is_motion(kind) => Some(self.deeper(Self::parse_action)?),
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

    fn symbol_kind_at(&self, at: usize) -> Option<SymbolKind> {
        self.tokens.get(at).map(|token| token.kind)
    }

    fn peek_symbol_kind(&self) -> Option<SymbolKind> {
        self.symbol_kind_at(self.at)
    }

    fn next_is(&self, ahead: usize, kind: SymbolKind) -> bool {
        self.symbol_kind_at(self.at + ahead) == Some(kind)
    }

    fn eat_symbol_kind(&mut self, kind: SymbolKind) -> bool {
        let there = self.next_is(0, kind);
        self.at += usize::from(there);
        there
    }

    /// Returns the symbols from one token up to another as text.
    fn slice_symbol_text(&self, from: usize, to: usize) -> &'a str {
        let (Some(first), Some(last)) = (self.tokens.get(from), self.tokens.get(to.wrapping_sub(1))) else {
            return "";
        };
        self.text
            .get(first.start as usize..last.symbol_end())
            .unwrap_or_default()
    }

    /// Returns the symbols that a part read since `from` must remember: its own, unless it prints the same
    /// by `write`.
    fn written_symbols_since(&self, from: usize, write: impl FnOnce(&mut HamnosysWriter)) -> WrittenSymbols {
        if !self.remember {
            return WrittenSymbols(None);
        }
        let mut out = HamnosysWriter::default();
        write(&mut out);
        let text = self.slice_symbol_text(from, self.at);
        WrittenSymbols((out.text != text).then(|| text.into()))
    }

    fn index(&self) -> usize {
        self.tokens
            .get(self.at)
            .map_or(self.count, |token| token.index as usize)
    }

    fn expected_symbol_error(&self, expected: &'static str) -> HamnosysError {
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
    fn refuse_next_symbol(&mut self, expected: &'static str) -> HamnosysParsed<()> {
        self.report_missing_symbol(expected)?;
        self.at += 1;
        Ok(())
    }

    /// Reports that something is missing here; a lenient reading continues without it.
    fn report_missing_symbol(&mut self, expected: &'static str) -> HamnosysParsed<()> {
        let error = self.expected_symbol_error(expected);
        if !self.lenient {
            return Err(error);
        }
        self.findings.push(HamnosysFinding::from(&error));
        Ok(())
    }

    /// Adds a finding about the next symbol.
    fn note_symbol_finding(&mut self, message: &str, remedy: &'static str, dropped: bool) {
        let symbol = self
            .tokens
            .get(self.at)
            .map_or("end", |token| token.symbol.symbol_name());
        self.findings.push(HamnosysFinding {
            index: self.index(),
            message: format!("{symbol}: {message}"),
            remedy,
            dropped,
        });
    }

    /// Leaves out the next symbol, with a finding.
    fn drop(&mut self, message: &str, remedy: &'static str) {
        self.note_symbol_finding(message, remedy, true);
        self.at += 1;
    }

    fn close_bracket(&mut self, opened: usize, bracket: BracketKind) -> HamnosysParsed<()> {
        if self.eat_symbol_kind(SymbolKind::Close(bracket)) {
            return Ok(());
        }
        let Some(token) = self.tokens.get(opened) else {
            return Ok(());
        };
        let error = HamnosysError::Unclosed {
            index: token.index as usize,
            symbol: token.symbol,
            at: self.index(),
            expected: HamnosysSymbol::from_symbol_kind(SymbolKind::Close(bracket))
                .map_or("a bracket", HamnosysSymbol::symbol_name),
        };
        if !self.lenient {
            return Err(error);
        }
        self.findings.push(HamnosysFinding::from(&error));
        Ok(())
    }

    fn deeper<T>(&mut self, inner: impl FnOnce(&mut Self) -> HamnosysParsed<T>) -> HamnosysParsed<T> {
        if self.depth >= MAX_BRACKET_DEPTH {
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
            limit: MAX_BRACKET_DEPTH,
        }
    }

    /// Returns the tokens within the group that opens at `at`, up to its close or the end, and the index
    /// of its own hamplus.
    fn group_tokens(&self, at: usize) -> (&'a [LexedSymbol], Option<usize>) {
        let inside = self.tokens.get(at + 1..).unwrap_or_default();
        let mut depth = 0_usize;
        let mut plus = None;
        for (offset, token) in inside.iter().enumerate() {
            match token.kind {
                SymbolKind::Open(_) => depth += 1,
                SymbolKind::Close(_) if depth == 0 => return (&inside[..offset], plus),
                SymbolKind::Close(_) => depth -= 1,
                SymbolKind::Plus if depth == 0 && plus.is_none() => plus = Some(offset),
                _ => {}
            }
        }
        (inside, plus)
    }
}

/// Returns whether a movement, or a group that can only be one, begins with this symbol.
fn is_motion(kind: SymbolKind) -> bool {
    use SymbolKind as K;
    matches!(
        kind,
        K::Move(_) | K::Circle(_) | K::Wrist(_) | K::FingerPlay | K::Cross { .. } | K::Still
    )
}

#[cfg(test)]
mod tests;
