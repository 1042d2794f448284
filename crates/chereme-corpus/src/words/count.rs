//! Counts of things as text, in singular and plural.

use super::InterfaceLanguage;
use super::sentences::{filled_sentence, load_message_patterns};

/// Returns `1 token`, `2 tokens`, with the noun given in its plural.
#[must_use]
pub fn format_noun_count(count: u64, noun: &str) -> String {
    counted_in(count, noun, InterfaceLanguage::English)
}

/// Returns a count of things in a language; a noun that the table lacks stays English.
#[must_use]
pub fn counted_in(count: u64, noun: &str, language: InterfaceLanguage) -> String {
    format!("{count} {}", noun_form_for_count(count, noun, language))
}

/// Returns the form of a noun, given in its plural, that goes with a number.
#[must_use]
pub fn noun_form_for_count(count: u64, noun: &str, language: InterfaceLanguage) -> String {
    let id = format!("noun-{}", noun.replace(' ', "-"));
    let counted_sentence = filled_sentence(&id, language, &|_| count.to_string());
    counted_sentence.unwrap_or_else(|| match noun.strip_suffix("ies") {
        // Nouns that no file of words has still follow the rules of English.
        _ if count != 1 => noun.to_owned(),
        Some(stem) => format!("{stem}y"),
        None => noun.strip_suffix('s').unwrap_or(noun).to_owned(),
    })
}

/// Returns whether a number of things takes the singular: French uses the plural from two on.
pub(super) fn is_singular(count: u64, language: InterfaceLanguage) -> bool {
    match language {
        InterfaceLanguage::French => count < 2,
        InterfaceLanguage::English | InterfaceLanguage::Other(_) => count == 1,
    }
}

/// Returns a count in English words, such as `2 tokens`, in French; nothing if the noun is unknown.
pub(super) fn counted_in_french(text: &str) -> Option<String> {
    let (count, noun) = text.split_once(' ')?;
    let count: u64 = count.parse().ok()?;
    let mut ids = load_message_patterns(InterfaceLanguage::English).keys();
    let plural = ids.find_map(|id| {
        let plural = id.strip_prefix("noun-")?.replace('-', " ");
        let fits = noun == plural || noun == noun_form_for_count(1, &plural, InterfaceLanguage::English);
        fits.then_some(plural)
    });
    Some(counted_in(count, &plural?, InterfaceLanguage::French))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_in_messages_are_put_into_french() {
        for (english, french) in [
            ("1 token", Some("1 occurrence")),
            ("12 pairs of frames", Some("12 paires d’images")),
            ("3 fancies", None),
            ("tokens", None),
        ] {
            assert_eq!(counted_in_french(english).as_deref(), french);
        }
    }

    #[test]
    fn nouns_agree_with_their_numbers() {
        for (count, noun, english, french) in [
            (1, "tokens", "1 token", "1 occurrence"),
            (0, "tokens", "0 tokens", "0 occurrence"),
            (2, "inventories", "2 inventories", "2 inventaires"),
            (1, "inventories", "1 inventory", "1 inventaire"),
            (1, "searches", "1 search", "1 recherche"),
            (1, "fancies", "1 fancy", "1 fancy"),
            (
                1,
                "novelties of a kind",
                "1 novelties of a kind",
                "1 novelties of a kind",
            ),
        ] {
            assert_eq!(format_noun_count(count, noun), english);
            assert_eq!(counted_in(count, noun, InterfaceLanguage::French), french);
        }
    }
}
