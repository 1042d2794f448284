//! Translates everyday words into a query: "handshape U", "main droite configuration plate", "chin".

use super::{TextPattern, TokenQuery, query_words};
use crate::component::{HandRef, SignComponent};
use crate::inventory::ComponentInventory;
use crate::text::fold_text;

/// Characters of the query language; a text with one of them is already a query.
const QUERY_SYNTAX_CHARS: &[char] = &['=', ':', '<', '>', '(', ')', '"', '[', ']', '~', ',', '!', '@', '*'];
/// The most words of a value's name.
const MAX_NAME_WORDS: usize = 3;
/// Words without meaning between a component and its value.
const WORDS_BEFORE_VALUE: [&str; 8] = ["is", "est", "at", "à", "of", "de", "la", "le"];
/// Further words without meaning next to values.
const WORDS_BESIDE_VALUE: [&str; 12] = [
    "a", "an", "the", "on", "in", "with", "un", "une", "au", "sur", "dans", "avec",
];

/// Returns the query for everyday words in which components come before their values from these inventories.
///
/// Other words stay unchanged. Returns `None` if no word names a component, or if the text is already a query.
#[must_use]
pub fn query_from_everyday_words(text: &str, inventories: &[&ComponentInventory]) -> Option<String> {
    translate_everyday_words(text, &[], |words| find_named_component(words, inventories))
}

/// Does the same as [`query_from_everyday_words`], but also accepts values without their components.
#[must_use]
pub fn guess_everyday_query(text: &str, inventories: &[&ComponentInventory]) -> Option<String> {
    let idle = [&WORDS_BEFORE_VALUE[..], &WORDS_BESIDE_VALUE[..]].concat();
    translate_everyday_words(text, &idle, |words| {
        find_named_component(words, inventories).or_else(|| find_bare_value(words, inventories))
    })
}

/// A field, a value, and the number of words that name them.
type FoundFieldValue = (String, String, usize);

/// Reads a text word by word; `idle` words that name nothing are left out.
fn translate_everyday_words(
    text: &str,
    idle: &[&str],
    find: impl Fn(&[String]) -> Option<FoundFieldValue>,
) -> Option<String> {
    if text.contains(QUERY_SYNTAX_CHARS) {
        return None;
    }
    let typed_words: Vec<&str> = text.split_whitespace().collect();
    let folded: Vec<String> = typed_words.iter().map(|word| fold_text(word)).collect();
    let (mut terms, mut at, mut understood) = (Vec::new(), 0, false);
    while at < typed_words.len() {
        match find(&folded[at..]) {
            Some((field, value, words)) => {
                terms.push(format!("{field}={}", TextPattern::literal_pattern(value)));
                (at, understood) = (at + words, true);
            }
            None => {
                if !is_one_of(&folded[at], idle) {
                    terms.push(typed_words[at].to_owned());
                }
                at += 1;
            }
        }
    }
    let query = terms.join(" ");
    (understood && TokenQuery::parse_query(&query).is_ok()).then_some(query)
}

/// Finds a component with a value at the start; a hand may come before the component or the value.
fn find_named_component(words: &[String], inventories: &[&ComponentInventory]) -> Option<FoundFieldValue> {
    let (hand, mut at) = leading_hand_words(words);
    let component = component_of_word(words.get(at)?)?;
    at += 1;
    while words.get(at).is_some_and(|word| is_one_of(word, &WORDS_BEFORE_VALUE)) {
        at += 1;
    }
    let (hand, at) = match hand {
        Some(hand) => (Some(hand), at),
        None => {
            let (hand, more) = self::leading_hand_words(&words[at..]);
            (hand, at + more)
        }
    };
    let (field, value, more) = find_longest_value(&words[at..], inventories, Some(component))?;
    let field = match hand {
        Some(hand) => format!("{}.{field}", hand.hand_ref_spellings()[0]),
        None => field,
    };
    Some((field, value, at + more))
}

/// Finds a value without its component at the start; a hand may come before a value of a hand.
fn find_bare_value(words: &[String], inventories: &[&ComponentInventory]) -> Option<FoundFieldValue> {
    let (hand, before) = leading_hand_words(words);
    let of_hand = hand.and_then(|hand| {
        let manual = SignComponent::ALL_COMPONENTS
            .into_iter()
            .filter(|component| component.is_manual());
        let rest = &words[before..];
        let mut candidates = manual.filter_map(|component| find_longest_value(rest, inventories, Some(component)));
        let (field, value, more) = candidates.next()?;
        Some((
            format!("{}.{field}", hand.hand_ref_spellings()[0]),
            value,
            before + more,
        ))
    });
    of_hand.or_else(|| find_longest_value(words, inventories, None))
}

/// Finds the value whose name has the most words at the start; returns its field, its id, and the number of words.
fn find_longest_value(
    words: &[String],
    inventories: &[&ComponentInventory],
    component: Option<SignComponent>,
) -> Option<FoundFieldValue> {
    let ordered = SignComponent::ALL_COMPONENTS
        .into_iter()
        .filter(|candidate| component.is_none_or(|wanted| wanted == *candidate));
    let most = words.len().min(MAX_NAME_WORDS);
    let spelt = (1..=most).rev().find_map(|count| {
        let texts = [" ", "-"].map(|between| fold_text(&words[..count].join(between)));
        ordered.clone().find_map(|component| {
            let fits = inventories.iter().filter(|inventory| inventory.component == component);
            let mut all = fits.flat_map(|inventory| inventory.values.iter().map(move |value| (inventory, value)));
            let is = |spelling: &str| texts.contains(&fold_text(spelling));
            let mut exact = all.clone();
            let (inventory, value) = exact.find(|(_, value)| value.value_spellings().any(is)).or_else(|| {
                all.find(|(_, value)| value.value_spellings().any(|spelling| is(value_name_head(spelling))))
            })?;
            let field = match &inventory.feature {
                Some(feature) => format!("{}.{feature}", component.component_name()),
                None => component.component_name().to_owned(),
            };
            Some((field, value.id.clone(), count))
        })
    });
    spelt.or_else(|| find_described_value(words.first()?, inventories, component?))
}

/// Returns the part of a name before its details: "main plate" of "main plate, pouce le long".
fn value_name_head(name: &str) -> &str {
    name.split([',', ':']).next().unwrap_or(name)
}

/// Finds the first value of a component with a word in its name that begins with `word`: "plat" in "main plate, pouce
/// le long".
fn find_described_value(
    word: &str,
    inventories: &[&ComponentInventory],
    component: SignComponent,
) -> Option<FoundFieldValue> {
    let mut fits = inventories.iter();
    let plain = fits.find(|inventory| inventory.component == component && inventory.feature.is_none())?;
    let value = plain.values.iter().find(|value| {
        value.value_spellings().any(|name| {
            let name = fold_text(name);
            let mut words = name.split(|letter: char| !letter.is_alphanumeric());
            word.chars().count() > 3 && words.any(|name_word| name_word.starts_with(word))
        })
    })?;
    Some((component.component_name().to_owned(), value.id.clone(), 1))
}

fn component_of_word(word: &str) -> Option<SignComponent> {
    let mut all = SignComponent::ALL_COMPONENTS.into_iter();
    all.find(|component| is_one_of_words(word, component.component_spellings()))
}

/// Returns the hand at the start, and the number of words that name it.
fn leading_hand_words(words: &[String]) -> (Option<HandRef>, usize) {
    let of = |word: &String| {
        let mut all = HandRef::ALL_HAND_REFS.into_iter();
        all.find(|hand_ref| is_one_of_words(word, hand_ref.hand_ref_spellings()))
    };
    let is_hand = |word: &String| is_one_of(word, &["hand", "main"]);
    match words {
        [first, second, ..] if is_hand(first) && of(second).is_some() => (of(second), 2),
        [first, second, ..] if of(first).is_some() && is_hand(second) => (of(first), 2),
        [first, ..] if of(first).is_some() => (of(first), 1),
        _ => (None, 0),
    }
}

/// Returns whether a word is one of these names, or French for one of them.
fn is_one_of_words(word: &str, names: &[&str]) -> bool {
    is_one_of(word, names) || names.contains(&query_words::canonical_part_name(word).as_str())
}

fn is_one_of(word: &str, all: &[&str]) -> bool {
    all.iter().any(|other| fold_text(other) == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inventories() -> Vec<&'static ComponentInventory> {
        crate::inventory::builtin_inventories().iter().collect()
    }

    #[test]
    fn components_are_understood_in_everyday_words() {
        let all = inventories();
        for (text, wanted) in [
            ("handshape U", Some("configuration=U")),
            ("Handshape is u", Some("configuration=U")),
            ("configuration U", Some("configuration=U")),
            ("right hand handshape U", Some("right.configuration=U")),
            ("configuration main gauche U", Some("left.configuration=U")),
            ("emplacement menton gloss", Some("placement=chin gloss")),
            (
                "handshape U placement upper chest",
                Some("configuration=U placement=upper-chest"),
            ),
            ("la main", None),
            ("configuration plate", Some("configuration=flat")),
            ("configuration plat", Some("configuration=flat")),
            (
                "configuration main plate emplacement menton",
                Some("configuration=flat placement=chin"),
            ),
            ("handshape nonsense", None),
            ("handshape", None),
            ("chat", None),
            ("U", None),
            ("handshape=U", None),
            ("", None),
        ] {
            assert_eq!(query_from_everyday_words(text, &all).as_deref(), wanted, "{text}");
        }
    }

    #[test]
    fn values_alone_are_guessed() {
        let all = inventories();
        for (text, wanted) in [
            ("U", Some("configuration=U")),
            ("chin", Some("placement=chin")),
            ("menton", Some("placement=chin")),
            ("U menton", Some("configuration=U placement=chin")),
            ("fist chin", Some("configuration=A placement=chin")),
            ("poing au menton", Some("configuration=A placement=chin")),
            ("main plate sur la poitrine", Some("configuration=flat placement=chest")),
            ("right hand flat chin", Some("right.configuration=flat placement=chin")),
            ("la main", None),
            ("ESCARGOT", None),
        ] {
            assert_eq!(guess_everyday_query(text, &all).as_deref(), wanted, "{text}");
        }
    }
}
