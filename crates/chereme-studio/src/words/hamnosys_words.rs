//! Descriptions of the HamNoSys symbols, shown on hover.

use chereme_sign::hamnosys::SymbolClass;
use chereme_sign::words::folders::phrase_text;

use super::{InterfaceLanguage, InterfaceText, fill_text_braces};

pub(crate) use super::texts::hamnosys::*;

/// The classes of symbols in the order in which a sign is written, with their titles.
pub(crate) const SYMBOL_CLASS_TITLES: [(SymbolClass, InterfaceText); 16] = [
    (SymbolClass::Operator, HANDS_AND_LINKS),
    (SymbolClass::Handshape, HANDSHAPES),
    (SymbolClass::HandshapeMark, THUMB_AND_BENDS),
    (SymbolClass::ExtendedFinger, FINGERS_POINT),
    (SymbolClass::Palm, PALM_FACES),
    (SymbolClass::Location, PLACES),
    (SymbolClass::LocationMark, ABOUT_PLACES),
    (SymbolClass::HandPart, HAND_PARTS),
    (SymbolClass::Digit, DIGITS),
    (SymbolClass::FingerPart, FINGER_PARTS),
    (SymbolClass::Contact, CONTACTS),
    (SymbolClass::Movement, MOVEMENTS),
    (SymbolClass::MovementMark, ABOUT_MOVEMENTS),
    (SymbolClass::Manner, MANNER),
    (SymbolClass::Repetition, REPETITION),
    (SymbolClass::Bracket, BRACKETS),
];

/// Returns the meaning of a symbol, given its name without `ham`.
pub(crate) fn symbol_meaning(name: &str, language: InterfaceLanguage) -> Option<String> {
    if let Some(text) = phrase_text(&format!("window-symbol-{name}"), language) {
        return Some(text.to_owned());
    }
    let families = [
        ("extfinger", EXTFINGER),
        ("move", MOVE),
        ("palm", PALM),
        ("circle", CIRCLE),
        ("clock", CLOCK),
    ];
    families.iter().find_map(|(start, text)| {
        let letters = name.strip_prefix(start)?.chars();
        let directions = letters.map(|letter| phrase_text(&format!("window-direction-{letter}"), language));
        let directions: Option<Vec<&str>> = directions.collect();
        let and = match language {
            InterfaceLanguage::French => " et ",
            InterfaceLanguage::English | InterfaceLanguage::Other(_) => " and ",
        };
        let direction = directions.filter(|directions| !directions.is_empty())?.join(and);
        Some(fill_text_braces(
            text.text_in_language(language),
            &[("way", &direction)],
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::hamnosys::HamnosysSymbol;

    #[test]
    fn every_symbol_has_a_description_in_both_languages() {
        for symbol in HamnosysSymbol::all_symbols() {
            let name = symbol.symbol_name().strip_prefix("ham").expect("as all names");
            for language in [InterfaceLanguage::English, InterfaceLanguage::French] {
                let text = symbol_meaning(name, language).unwrap_or_default();
                assert!(!text.is_empty(), "{name}");
            }
        }
        assert_eq!(
            symbol_meaning("moveol", InterfaceLanguage::English).as_deref(),
            Some("moves outwards and left")
        );
        assert_eq!(symbol_meaning("nothing", InterfaceLanguage::French), None);
    }
}
