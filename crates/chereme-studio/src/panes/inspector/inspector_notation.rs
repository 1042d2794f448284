//! HamNoSys for people without its font: the symbols, part by part.

use chereme_sign::hamnosys::{HamnosysSymbol, SymbolClass, to_names};

use crate::words::{InterfaceText, inspector as words};

/// A part of a notation, in the order of HamNoSys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum NotationPart {
    Hands,
    Handshape,
    Orientation,
    Location,
    Movement,
}

impl NotationPart {
    fn notation_part_text(self) -> InterfaceText {
        match self {
            Self::Hands => words::BOTH_HANDS,
            Self::Handshape => words::CONFIGURATION,
            Self::Orientation => words::ORIENTATION,
            Self::Location => words::PLACEMENT,
            Self::Movement => words::MOVEMENT,
        }
    }

    /// Returns the part of a symbol that follows a symbol of the part `self`; `None` for brackets and connecting signs,
    /// which belong to the same part as their neighbours.
    fn part_after_class(self, class: SymbolClass) -> Option<Self> {
        // Symbols for the target of a movement, and for changes during it, belong to the movement.
        if self == Self::Movement {
            return Some(Self::Movement);
        }
        match class {
            SymbolClass::Handshape | SymbolClass::HandshapeMark => Some(Self::Handshape),
            SymbolClass::ExtendedFinger | SymbolClass::Palm => Some(Self::Orientation),
            SymbolClass::Location | SymbolClass::LocationMark | SymbolClass::HandPart | SymbolClass::Contact => {
                Some(Self::Location)
            }
            SymbolClass::Digit | SymbolClass::FingerPart if self <= Self::Handshape => Some(Self::Handshape),
            SymbolClass::Digit | SymbolClass::FingerPart => Some(Self::Location),
            SymbolClass::Movement | SymbolClass::MovementMark | SymbolClass::Manner | SymbolClass::Repetition => {
                Some(Self::Movement)
            }
            SymbolClass::Punctuation | SymbolClass::Bracket | SymbolClass::Operator => None,
        }
    }
}

/// Returns the parts of a notation, each with its symbols; an empty list for text that is not notation.
pub(super) fn split_notation_parts(text: &str) -> Vec<(InterfaceText, Vec<HamnosysSymbol>)> {
    let Ok(names) = to_names(text) else {
        return Vec::new();
    };
    let mut parts: Vec<(NotationPart, Vec<HamnosysSymbol>)> = Vec::new();
    let mut now = NotationPart::Hands;
    let mut waiting: Vec<HamnosysSymbol> = Vec::new();
    for symbol in names.into_iter().filter_map(HamnosysSymbol::from_symbol_name) {
        // An opening bracket belongs to the part that follows, which only the next symbol shows.
        let opens = symbol.symbol_name().ends_with("begin");
        match (now.part_after_class(symbol.symbol_class()), parts.last_mut()) {
            (Some(next), Some((part, all))) if *part == next => {
                all.append(&mut waiting);
                all.push(symbol);
                now = next;
            }
            (Some(next), _) => {
                let mut all = std::mem::take(&mut waiting);
                all.push(symbol);
                parts.push((next, all));
                now = next;
            }
            (None, Some((_, all))) if !opens => {
                all.append(&mut waiting);
                all.push(symbol);
            }
            (None, None) if !opens => parts.push((NotationPart::Hands, vec![symbol])),
            (None, _) => waiting.push(symbol),
        }
    }
    if let Some((_, all)) = parts.last_mut() {
        all.append(&mut waiting);
    }
    parts
        .into_iter()
        .map(|(part, all)| (part.notation_part_text(), all))
        .collect()
}

/// Returns the short names of symbols.
pub(super) fn short_symbol_names(symbols: &[HamnosysSymbol]) -> String {
    let short = |symbol: &HamnosysSymbol| {
        let name = symbol.symbol_name();
        name.strip_prefix("ham").unwrap_or(name)
    };
    symbols.iter().map(short).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::from_names;

    fn said(names: &str) -> Vec<(InterfaceText, String)> {
        let parts = split_notation_parts(&from_names(names.split(' ')).expect("a notation"));
        parts
            .into_iter()
            .map(|(part, symbols)| (part, super::short_symbol_names(&symbols)))
            .collect()
    }

    #[test]
    fn a_notation_is_described_part_by_part() {
        let simple = said("hamfinger2 hamextfingeru hampalml hamchin hamtouch hammoveo");
        let want = [
            (words::CONFIGURATION, "finger2"),
            (words::ORIENTATION, "extfingeru palml"),
            (words::PLACEMENT, "chin touch"),
            (words::MOVEMENT, "moveo"),
        ];
        assert_eq!(simple, want.map(|(part, text)| (part, text.to_owned())));
        let both = said(
            "hamsymmpar hamfist hamthumboutmod hamextfingeru hampalml hamchest hamparbegin \
             hammoved hamreplace hamfinger2 hamparend",
        );
        let want = [
            (words::BOTH_HANDS, "symmpar"),
            (words::CONFIGURATION, "fist thumboutmod"),
            (words::ORIENTATION, "extfingeru palml"),
            (words::PLACEMENT, "chest"),
            (words::MOVEMENT, "parbegin moved replace finger2 parend"),
        ];
        assert_eq!(both, want.map(|(part, text)| (part, text.to_owned())));
        assert!(split_notation_parts("no notation").is_empty());
    }
}
