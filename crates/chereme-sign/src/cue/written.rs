//! French text divided into words, short forms, numbers and pauses.

use super::french::RULES;
use super::numbers;

/// A part of a text.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Written {
    /// A word in lower case, and whether a hyphen joins it to the word before.
    Word(String, bool),
    /// A word that is said letter by letter, in lower case.
    Letters(String),
    Pause,
    /// A number that is not read.
    Other(String),
}

/// Splits text at blanks, hyphens, apostrophes and punctuation; an apostrophe stays with its word. Numbers and short
/// forms become words.
pub(super) fn split(text: &str) -> Vec<Written> {
    let plain = |letter| if letter == '’' { '\'' } else { letter };
    let letters: Vec<char> = text.chars().map(plain).collect();
    let lower: String = letters.iter().flat_map(|it| it.to_lowercase()).collect();
    let shouted =
        !text.chars().any(char::is_lowercase) && text.trim().contains(char::is_whitespace);
    let mut parts = Vec::new();
    let (mut at, mut hyphen) = (0, false);
    while let Some(&letter) = letters.get(at) {
        let rest = &letters[at..];
        if letter.is_numeric() {
            let (length, words) = numbers::read(rest);
            match words {
                Some(words) => parts.extend(words.into_iter().map(|it| Written::Word(it, false))),
                None => parts.push(Written::Other(rest[..length].iter().collect())),
            }
            at += length;
        } else if let Some((length, word)) = dotted(rest).filter(|_| starts_word(&letters, at)) {
            parts.push(as_written(&word, shouted, false));
            at += length;
        } else if letter.is_alphabetic() {
            let word = word(rest, &lower);
            let short = short(rest, &word, shouted);
            at += word.chars().count() + usize::from(short.is_some_and(|(_, dot)| dot));
            match short {
                Some((long, _)) => {
                    parts.extend(
                        long.split(' ')
                            .map(|it| Written::Word(it.to_owned(), false)),
                    );
                }
                None => parts.push(as_written(&word, shouted, hyphen)),
            }
            hyphen = letters.get(at).is_some_and(|it| is_hyphen(*it));
            continue;
        } else {
            let ends = matches!(
                letter,
                ',' | '.' | ';' | ':' | '!' | '?' | '…' | '—' | '(' | ')' | '\n'
            );
            if ends && !matches!(parts.last(), None | Some(Written::Pause)) {
                parts.push(Written::Pause);
            }
            at += 1;
            hyphen &= is_hyphen(letter);
            continue;
        }
        hyphen = false;
    }
    parts
}

fn is_hyphen(letter: char) -> bool {
    matches!(letter, '-' | '‐' | '‑')
}

fn starts_word(letters: &[char], at: usize) -> bool {
    at == 0 || !(letters[at - 1].is_alphanumeric() || letters[at - 1] == '.')
}

/// Returns the word at the start of `rest`: letters, with the apostrophe behind an elided word or within a known one.
fn word(rest: &[char], text: &str) -> String {
    let mut word = String::new();
    for &letter in rest {
        if letter.is_alphabetic() {
            word.push(letter);
        } else if letter == '\'' {
            word.push(letter);
            if !is_known_start(&word.to_lowercase(), text) {
                break;
            }
        } else {
            break;
        }
    }
    word
}

/// Returns whether a known word with an apostrophe inside begins so and stands in the text, such as *aujourd'hui*.
fn is_known_start(begun: &str, text: &str) -> bool {
    let mut words = RULES.words.keys().filter(|word| word.contains('\''));
    words.any(|word| word.starts_with(begun) && text.contains(word.as_str()))
}

/// Returns capitals with a point behind each, such as *S.N.C.F.*, without the points, and their length in the text.
fn dotted(rest: &[char]) -> Option<(usize, String)> {
    let pairs = rest.chunks(2);
    let capitals =
        pairs.take_while(|pair| pair.len() == 2 && pair[0].is_uppercase() && pair[1] == '.');
    let capitals: String = capitals.map(|pair| pair[0]).collect();
    let count = capitals.chars().count();
    (count > 1).then_some((2 * count, capitals))
}

/// Returns the words that a short form stands for, and whether the point behind it belongs to it.
fn short(rest: &[char], word: &str, shouted: bool) -> Option<(&'static str, bool)> {
    let lower = word.to_lowercase();
    let point = rest.get(word.chars().count()) == Some(&'.');
    // *M.* needs its point, a title its capital, and a unit its small letters.
    let titled = word.starts_with(char::is_uppercase) && !shouted;
    let key = match lower.as_str() {
        "m" if !(point && titled) => return None,
        _ => lower.as_str(),
    };
    let long = RULES.abbreviations.get(key)?;
    let usual = if long.ends_with('s') {
        word == lower
    } else {
        titled || lower == "etc"
    };
    let ends = rest.get(word.chars().count() + 1).is_none();
    usual.then_some((long.as_str(), point && !ends))
}

/// Returns a word as it is said: capitals without a vowel, and some with, letter by letter.
fn as_written(word: &str, shouted: bool, hyphen: bool) -> Written {
    let lower = word.to_lowercase();
    let capitals = lower.chars().count() > 1 && word.chars().all(char::is_uppercase);
    let mute = !lower.chars().any(|letter| RULES.vowels.contains(letter));
    if capitals && (mute || (!shouted && RULES.spelled.contains(&lower))) {
        return Written::Letters(lower);
    }
    Written::Word(lower, hyphen)
}
