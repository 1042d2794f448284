//! Counts of things as text, in singular and plural.

use super::Language;
use super::sentences::{filled_sentence, sentences};

/// Returns `1 token`, `2 tokens`, with the noun given in its plural.
#[must_use]
pub fn counted(count: u64, noun: &str) -> String {
    counted_in(count, noun, Language::English)
}

/// Returns a count of things in a language; a noun that the table lacks stays English.
#[must_use]
pub fn counted_in(count: u64, noun: &str, language: Language) -> String {
    format!("{count} {}", numbered(count, noun, language))
}

/// Returns the form of a noun, given in its plural, that goes with a number.
#[must_use]
pub fn numbered(count: u64, noun: &str, language: Language) -> String {
    let id = format!("noun-{}", noun.replace(' ', "-"));
    let known = filled_sentence(&id, language, &|_| count.to_string());
    known.unwrap_or_else(|| match noun.strip_suffix("ies") {
        _ if count != 1 => noun.to_owned(),
        Some(stem) => format!("{stem}y"),
        None => noun.strip_suffix('s').unwrap_or(noun).to_owned(),
    })
}

/// Returns whether a number of things takes the singular: French uses the plural from two on.
pub(super) fn is_singular(count: u64, language: Language) -> bool {
    match language {
        Language::French => count < 2,
        Language::English | Language::Other(_) => count == 1,
    }
}

/// Returns a count in English words, such as `2 tokens`, in French; nothing if the noun is unknown.
pub(super) fn counted_in_french(text: &str) -> Option<String> {
    let (count, noun) = text.split_once(' ')?;
    let count: u64 = count.parse().ok()?;
    let mut ids = sentences(Language::English).keys();
    let plural = ids.find_map(|id| {
        let plural = id.strip_prefix("noun-")?.replace('-', " ");
        let fits = noun == plural || noun == numbered(1, &plural, Language::English);
        fits.then_some(plural)
    });
    Some(counted_in(count, &plural?, Language::French))
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
            assert_eq!(counted(count, noun), english);
            assert_eq!(counted_in(count, noun, Language::French), french);
        }
    }
}
