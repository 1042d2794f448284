//! HamNoSys for people without its font: the symbols, part by part.

use chereme_sign::hamnosys::{Class, Symbol, to_names};

use crate::words::{Text, inspector as words};

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
    fn text(self) -> Text {
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
    fn after(self, class: Class) -> Option<Self> {
        // Symbols for the target of a movement, and for changes during it, belong to the movement.
        if self == Self::Movement {
            return Some(Self::Movement);
        }
        match class {
            Class::Handshape | Class::HandshapeMark => Some(Self::Handshape),
            Class::ExtendedFinger | Class::Palm => Some(Self::Orientation),
            Class::Location | Class::LocationMark | Class::HandPart | Class::Contact => {
                Some(Self::Location)
            }
            Class::Digit | Class::FingerPart if self <= Self::Handshape => Some(Self::Handshape),
            Class::Digit | Class::FingerPart => Some(Self::Location),
            Class::Movement | Class::MovementMark | Class::Manner | Class::Repetition => {
                Some(Self::Movement)
            }
            Class::Punctuation | Class::Bracket | Class::Operator => None,
        }
    }
}

/// Returns the parts of a notation, each with its symbols; an empty list for text that is not notation.
pub(super) fn parts(text: &str) -> Vec<(Text, Vec<Symbol>)> {
    let Ok(names) = to_names(text) else {
        return Vec::new();
    };
    let mut parts: Vec<(NotationPart, Vec<Symbol>)> = Vec::new();
    let mut now = NotationPart::Hands;
    let mut waiting: Vec<Symbol> = Vec::new();
    for symbol in names.into_iter().filter_map(Symbol::from_name) {
        let opens = symbol.name().ends_with("begin");
        match (now.after(symbol.class()), parts.last_mut()) {
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
        .map(|(part, all)| (part.text(), all))
        .collect()
}

/// Returns the short names of symbols.
pub(super) fn names(symbols: &[Symbol]) -> String {
    let short = |symbol: &Symbol| {
        let name = symbol.name();
        name.strip_prefix("ham").unwrap_or(name)
    };
    symbols.iter().map(short).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::from_names;

    fn said(names: &str) -> Vec<(Text, String)> {
        let parts = parts(&from_names(names.split(' ')).expect("a notation"));
        parts
            .into_iter()
            .map(|(part, symbols)| (part, super::names(&symbols)))
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
        assert!(parts("no notation").is_empty());
    }
}
