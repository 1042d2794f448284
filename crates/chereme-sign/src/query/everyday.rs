//! Translates everyday words into a query: "handshape U", "main droite configuration plate", "chin".

use super::{Pattern, Query, words};
use crate::component::{Component, HandRef};
use crate::inventory::Inventory;
use crate::text::fold;

/// Characters of the query language; a text with one of them is already a query.
const WRITTEN: &[char] = &[
    '=', ':', '<', '>', '(', ')', '"', '[', ']', '~', ',', '!', '@', '*',
];
/// The most words of a value's name.
const MOST: usize = 3;
/// Words without meaning between a component and its value.
const BETWEEN: [&str; 8] = ["is", "est", "at", "à", "of", "de", "la", "le"];
/// Further words without meaning next to values.
const BESIDE: [&str; 12] = [
    "a", "an", "the", "on", "in", "with", "un", "une", "au", "sur", "dans", "avec",
];

/// Returns the query for everyday words in which components come before their values from these inventories.
///
/// Other words stay unchanged. Returns `None` if no word names a component, or if the text is already a query.
#[must_use]
pub fn meant(text: &str, inventories: &[&Inventory]) -> Option<String> {
    read(text, &[], |words| named(words, inventories))
}

/// Does the same as [`meant`], but also accepts values without their components.
#[must_use]
pub fn guessed(text: &str, inventories: &[&Inventory]) -> Option<String> {
    let idle = [&BETWEEN[..], &BESIDE[..]].concat();
    read(text, &idle, |words| {
        named(words, inventories).or_else(|| bare(words, inventories))
    })
}

/// A field, a value, and the number of words that name them.
type Found = (String, String, usize);

/// Reads a text word by word; `idle` words that name nothing are left out.
fn read(text: &str, idle: &[&str], find: impl Fn(&[String]) -> Option<Found>) -> Option<String> {
    if text.contains(WRITTEN) {
        return None;
    }
    let whole: Vec<&str> = text.split_whitespace().collect();
    let folded: Vec<String> = whole.iter().map(|it| fold(it)).collect();
    let (mut terms, mut at, mut understood) = (Vec::new(), 0, false);
    while at < whole.len() {
        match find(&folded[at..]) {
            Some((field, value, words)) => {
                terms.push(format!("{field}={}", Pattern::literal(value)));
                (at, understood) = (at + words, true);
            }
            None => {
                if !is_one_of(&folded[at], idle) {
                    terms.push(whole[at].to_owned());
                }
                at += 1;
            }
        }
    }
    let query = terms.join(" ");
    (understood && Query::parse(&query).is_ok()).then_some(query)
}

/// Finds a component with a value at the start; a hand may come before the component or the value.
fn named(words: &[String], inventories: &[&Inventory]) -> Option<Found> {
    let (hand, mut at) = hand(words);
    let component = component(words.get(at)?)?;
    at += 1;
    while words.get(at).is_some_and(|it| is_one_of(it, &BETWEEN)) {
        at += 1;
    }
    let (hand, at) = match hand {
        Some(hand) => (Some(hand), at),
        None => {
            let (hand, more) = self::hand(&words[at..]);
            (hand, at + more)
        }
    };
    let (field, value, more) = value(&words[at..], inventories, Some(component))?;
    let field = match hand {
        Some(hand) => format!("{}.{field}", hand.names()[0]),
        None => field,
    };
    Some((field, value, at + more))
}

/// Finds a value without its component at the start; a hand may come before a value of a hand.
fn bare(words: &[String], inventories: &[&Inventory]) -> Option<Found> {
    let (hand, before) = hand(words);
    let of_hand = hand.and_then(|hand| {
        let manual = Component::ALL.into_iter().filter(|it| it.is_manual());
        let rest = &words[before..];
        let mut found = manual.filter_map(|it| value(rest, inventories, Some(it)));
        let (field, value, more) = found.next()?;
        Some((format!("{}.{field}", hand.names()[0]), value, before + more))
    });
    of_hand.or_else(|| value(words, inventories, None))
}

/// Finds the value whose name has the most words at the start; returns its field, its id, and the number of words.
fn value(
    words: &[String],
    inventories: &[&Inventory],
    component: Option<Component>,
) -> Option<Found> {
    let ordered = Component::ALL
        .into_iter()
        .filter(|it| component.is_none_or(|wanted| wanted == *it));
    let most = words.len().min(MOST);
    let spelt = (1..=most).rev().find_map(|count| {
        let texts = [" ", "-"].map(|between| fold(&words[..count].join(between)));
        ordered.clone().find_map(|component| {
            let fits = inventories.iter().filter(|it| it.component == component);
            let mut all = fits.flat_map(|it| it.values.iter().map(move |value| (it, value)));
            let is = |it: &str| texts.contains(&fold(it));
            let mut exact = all.clone();
            let (inventory, value) = exact
                .find(|(_, value)| value.spellings().any(is))
                .or_else(|| all.find(|(_, value)| value.spellings().any(|it| is(head(it)))))?;
            let field = match &inventory.feature {
                Some(feature) => format!("{}.{feature}", component.name()),
                None => component.name().to_owned(),
            };
            Some((field, value.id.clone(), count))
        })
    });
    spelt.or_else(|| described(words.first()?, inventories, component?))
}

/// Returns the part of a name before its details: "main plate" of "main plate, pouce le long".
fn head(name: &str) -> &str {
    name.split([',', ':']).next().unwrap_or(name)
}

/// Finds the first value of a component with a word in its name that begins with `word`: "plat" in "main plate, pouce
/// le long".
fn described(word: &str, inventories: &[&Inventory], component: Component) -> Option<Found> {
    let mut fits = inventories.iter();
    let plain = fits.find(|it| it.component == component && it.feature.is_none())?;
    let value = plain.values.iter().find(|value| {
        value.spellings().any(|name| {
            let name = fold(name);
            let mut words = name.split(|letter: char| !letter.is_alphanumeric());
            word.chars().count() > 3 && words.any(|it| it.starts_with(word))
        })
    })?;
    Some((component.name().to_owned(), value.id.clone(), 1))
}

fn component(word: &str) -> Option<Component> {
    let mut all = Component::ALL.into_iter();
    all.find(|it| says(word, it.names()))
}

/// Returns the hand at the start, and the number of words that name it.
fn hand(words: &[String]) -> (Option<HandRef>, usize) {
    let of = |word: &String| {
        let mut all = HandRef::ALL.into_iter();
        all.find(|it| says(word, it.names()))
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
fn says(word: &str, names: &[&str]) -> bool {
    is_one_of(word, names) || names.contains(&words::part(word).as_str())
}

fn is_one_of(word: &str, all: &[&str]) -> bool {
    all.iter().any(|it| fold(it) == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inventories() -> Vec<&'static Inventory> {
        crate::inventory::builtin().iter().collect()
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
            assert_eq!(meant(text, &all).as_deref(), wanted, "{text}");
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
            (
                "main plate sur la poitrine",
                Some("configuration=flat placement=chest"),
            ),
            (
                "right hand flat chin",
                Some("right.configuration=flat placement=chin"),
            ),
            ("la main", None),
            ("ESCARGOT", None),
        ] {
            assert_eq!(guessed(text, &all).as_deref(), wanted, "{text}");
        }
    }
}
