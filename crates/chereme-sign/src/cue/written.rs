//! French text divided into words, short forms, numbers and pauses.

use super::cue_dictionary::sampa_phones;
use super::cue_numbers;
use super::french::FRENCH_SPELLING_RULES;
use super::{PhoneAlphabet, find_cue_code};

/// A part of a text.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum WrittenPart {
    /// A word in lower case, and whether a hyphen joins it to the word before.
    Word(String, bool),
    /// A word that is said letter by letter, in lower case.
    Letters(String),
    /// A word in capitals with a pronunciation of its own, in lower case.
    Acronym(String),
    /// Phones in SAMPA that the text states (`{f i l}`), and whether they are those of the word right before them.
    Phones(Vec<String>, bool),
    Pause,
    /// A number or a sign that is not read.
    Other(String),
}

/// Splits text at blanks, hyphens, apostrophes and punctuation; an apostrophe stays with its word. Numbers and short
/// forms become words.
pub(super) fn split_written_text(text: &str) -> Vec<WrittenPart> {
    let plain = |letter| if letter == '’' { '\'' } else { letter };
    let letters: Vec<char> = text.chars().map(plain).collect();
    let lower: String = letters.iter().flat_map(|letter| letter.to_lowercase()).collect();
    let shouted = !text.chars().any(char::is_lowercase) && text.trim().contains(char::is_whitespace);
    let mut parts = Vec::new();
    let (mut at, mut hyphen) = (0, false);
    while let Some(&letter) = letters.get(at) {
        let rest = &letters[at..];
        if let Some((length, phones)) = stated_phones(rest) {
            let is_of_word = at > 0 && letters[at - 1].is_alphanumeric();
            parts.push(WrittenPart::Phones(phones, is_of_word));
            at += length;
        } else if let Some((length, words)) = starts_word(&letters, at).then(|| roman_number(rest)).flatten() {
            parts.extend(words.into_iter().map(|word| WrittenPart::Word(word, false)));
            at += length;
        } else if letter.is_numeric() {
            let (length, words) = cue_numbers::read_french_number(rest);
            match words {
                Some(words) => parts.extend(words.into_iter().map(|word| WrittenPart::Word(word, false))),
                None => parts.push(WrittenPart::Other(rest[..length].iter().collect())),
            }
            at += length;
        } else if let Some((length, word)) = dotted(rest).filter(|_| starts_word(&letters, at)) {
            parts.push(as_written(&word, shouted, false));
            at += length;
        } else if matches!(letter, 'n' | 'N') && matches!(rest.get(1), Some('°' | 'º')) {
            parts.push(WrittenPart::Word("numéro".to_owned(), false));
            at += 2;
        } else if letter.is_alphabetic() {
            let word = leading_written_word(rest, &lower);
            let enclosed = hyphen && rest.get(1).is_some_and(|next| is_hyphen(*next));
            if word.chars().count() == 1
                && !enclosed
                && !FRENCH_SPELLING_RULES.words.contains_key(&word.to_lowercase())
                && expand_short_form(rest, &word, shouted).is_none()
            {
                parts.push(single(&word, rest));
                at += 1;
                hyphen = letters.get(at).is_some_and(|next| is_hyphen(*next));
                continue;
            }
            let short = expand_short_form(rest, &word, shouted);
            at += word.chars().count() + usize::from(short.is_some_and(|(_, dot)| dot));
            match short {
                Some((long, _)) => {
                    parts.extend(long.split(' ').map(|part| WrittenPart::Word(part.to_owned(), false)));
                }
                None => parts.push(as_written(&word, shouted, hyphen)),
            }
            hyphen = letters.get(at).is_some_and(|next| is_hyphen(*next));
            continue;
        } else {
            let ends = matches!(letter, ',' | '.' | ';' | ':' | '!' | '?' | '…' | '—' | '(' | ')' | '\n');
            let minus = matches!(letter, '-' | '−')
                && rest.get(1).is_some_and(char::is_ascii_digit)
                && (at == 0 || letters[at - 1].is_whitespace());
            let mut length = 1;
            if minus {
                parts.push(WrittenPart::Word("moins".to_owned(), false));
            } else if let Some(words) = FRENCH_SPELLING_RULES.symbols.get(&letter) {
                parts.extend(words.split(' ').map(|part| WrittenPart::Word(part.to_owned(), false)));
            } else if ends {
                if !matches!(parts.last(), None | Some(WrittenPart::Pause)) {
                    parts.push(WrittenPart::Pause);
                }
            } else if !is_silent(letter) {
                // *Étudiant·e·s*: the endings behind a middle dot are no words.
                let run = rest.iter().skip(1);
                length += match letter {
                    '·' => run.take_while(|next| next.is_alphabetic() || **next == '·').count(),
                    _ => run.take_while(|next| **next == letter).count(),
                };
                parts.push(WrittenPart::Other(rest[..length].iter().collect()));
            }
            at += length;
            hyphen &= is_hyphen(letter);
            continue;
        }
        hyphen = false;
    }
    parts
}

/// Returns whether a sign only separates or encloses words.
fn is_silent(letter: char) -> bool {
    letter.is_whitespace()
        || letter.is_control()
        || is_hyphen(letter)
        || matches!(
            letter,
            '\'' | '"'
                | '«'
                | '»'
                | '“'
                | '”'
                | '„'
                | '‹'
                | '›'
                | '‘'
                | '`'
                | '´'
                | '['
                | ']'
                | '{'
                | '}'
                | '/'
                | '–'
                | '\u{ad}'
                | '\u{200b}'
                | '\u{feff}'
        )
}

fn is_hyphen(letter: char) -> bool {
    matches!(letter, '-' | '‐' | '‑')
}

fn starts_word(letters: &[char], at: usize) -> bool {
    at == 0 || !(letters[at - 1].is_alphanumeric() || letters[at - 1] == '.')
}

/// Returns the word at the start of `rest`: letters, with the apostrophe behind an elided word or within a known one.
fn leading_written_word(rest: &[char], text: &str) -> String {
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
    let mut words = FRENCH_SPELLING_RULES.words.keys().filter(|word| word.contains('\''));
    words.any(|word| word.starts_with(begun) && text.contains(word.as_str()))
}

/// Returns capitals with a point behind each, such as *S.N.C.F.*, without the points, and their length in the text.
fn dotted(rest: &[char]) -> Option<(usize, String)> {
    let pairs = rest.chunks(2);
    let capitals = pairs.take_while(|pair| pair.len() == 2 && pair[0].is_uppercase() && pair[1] == '.');
    let capitals: String = capitals.map(|pair| pair[0]).collect();
    let count = capitals.chars().count();
    (count > 1).then_some((2 * count, capitals))
}

/// The longest phones in braces, in letters.
const MAX_STATED_LETTERS: usize = 256;

/// Returns phones in braces, in SAMPA or IPA, apart or together, and their length in the text.
fn stated_phones(rest: &[char]) -> Option<(usize, Vec<String>)> {
    if rest.first() != Some(&'{') {
        return None;
    }
    // Without a limit a text of opening braces alone would be searched whole for each of them.
    let length = rest.iter().take(MAX_STATED_LETTERS).position(|letter| *letter == '}')?;
    let inner: String = rest[1..length].iter().collect();
    let labels: Vec<&str> = inner.split_whitespace().collect();
    let code = find_cue_code("french")?;
    let alphabets = [PhoneAlphabet::Sampa, PhoneAlphabet::Ipa];
    let phones = alphabets
        .into_iter()
        .find_map(|alphabet| sampa_phones(&labels, code, alphabet))?;
    Some((length + 1, phones))
}

/// Returns a Roman number in capitals, its words and its length: *Louis XIV*, *XVIe*, *Ier*. Other letters than I, V and X
/// count only before the ending of an ordinal.
fn roman_number(rest: &[char]) -> Option<(usize, Vec<String>)> {
    const ROMAN_SIGNS: [(&str, u64); 13] = [
        ("M", 1000),
        ("CM", 900),
        ("D", 500),
        ("CD", 400),
        ("C", 100),
        ("XC", 90),
        ("L", 50),
        ("XL", 40),
        ("X", 10),
        ("IX", 9),
        ("V", 5),
        ("IV", 4),
        ("I", 1),
    ];
    let run: String = rest.iter().take_while(|letter| "IVXLCDM".contains(**letter)).collect();
    let (mut left, mut value) = (run.as_str(), 0);
    for (sign, size) in ROMAN_SIGNS {
        // A sign stands three times at most, and those of 4, 5 and 9 once.
        let most = if sign.len() == 1 && !["D", "L", "V"].contains(&sign) {
            3
        } else {
            1
        };
        for _ in 0..most {
            let Some(after) = left.strip_prefix(sign) else { break };
            (left, value) = (after, value + size);
        }
    }
    let ending: String = rest[run.len()..]
        .iter()
        .take_while(|letter| letter.is_alphanumeric())
        .collect();
    let is_small = run.chars().all(|letter| "IVX".contains(letter));
    let is_ordinal = match ending.as_str() {
        "e" | "ème" | "es" => value > 1,
        "er" | "re" | "ère" => value == 1,
        _ => false,
    };
    // *Le* and *Des* are no numbers, and one letter alone is a letter.
    let is_number = match run.len() {
        1 => is_small && is_ordinal,
        _ => is_ordinal || (is_small && ending.is_empty()),
    };
    if run.is_empty() || !left.is_empty() || !is_number {
        return None;
    }
    // The digits with the same ending are read as numbers are.
    let digits: Vec<char> = format!("{value}{}", ending.trim_end_matches('s')).chars().collect();
    let (_, words) = cue_numbers::read_french_number(&digits);
    Some((run.len() + ending.chars().count(), words?))
}

/// Returns the words that a short form stands for, and whether the point behind it belongs to it.
fn expand_short_form(rest: &[char], word: &str, shouted: bool) -> Option<(&'static str, bool)> {
    let lower = word.to_lowercase();
    let point = rest.get(word.chars().count()) == Some(&'.');
    // *M.* needs its point, a title its capital, and a unit its small letters.
    let titled = word.starts_with(char::is_uppercase) && !shouted;
    let key = match lower.as_str() {
        "m" if !(point && titled) => return None,
        _ => lower.as_str(),
    };
    let long = FRENCH_SPELLING_RULES.abbreviations.get(key)?;
    // *BD* in capitals is a comic, not a boulevard.
    if word.chars().count() > 1 && word.chars().all(char::is_uppercase) && !point && key != "etc" {
        return None;
    }
    let usual = if long.ends_with('s') {
        word == lower
    } else {
        titled || lower == "etc"
    };
    let ends = rest.get(word.chars().count() + 1).is_none();
    usual.then_some((long.as_str(), point && !ends))
}

/// Returns a letter that stands alone: an elided word without its apostrophe, as in *l ami*, else the letter's name.
fn single(letter: &str, rest: &[char]) -> WrittenPart {
    let next = match rest {
        [_, ' ', next, ..] => *next,
        _ => ' ',
    };
    let vowel = next == 'h' || FRENCH_SPELLING_RULES.vowels.contains(next.to_ascii_lowercase());
    let elided = ["c", "d", "j", "l", "m", "n", "s", "t"].contains(&letter);
    if vowel && elided {
        return WrittenPart::Word(format!("{letter}'"), false);
    }
    WrittenPart::Letters(letter.to_lowercase())
}

/// Returns a word as it is said: capitals without a vowel, of two letters, or that nobody can say as a word, letter by
/// letter.
fn as_written(word: &str, shouted: bool, hyphen: bool) -> WrittenPart {
    // *Les ONGs* have an ending in small letters.
    let base = word.strip_suffix('s').unwrap_or(word);
    let is_capitals = |word: &str| word.chars().count() > 1 && word.chars().all(char::is_uppercase);
    let word = if is_capitals(base) { base } else { word };
    let lower = word.to_lowercase();
    let mute = !lower
        .chars()
        .any(|letter| FRENCH_SPELLING_RULES.vowels.contains(letter));
    if !is_capitals(word) {
        // *Le dvd* and *LfPC* have no vowel, either; *pfff* and *zzz* repeat a letter.
        let mut pairs = word.as_bytes().windows(2);
        let repeats = pairs.any(|pair| pair[0].eq_ignore_ascii_case(&pair[1]));
        let sound = repeats || lower == "pst" || word.contains('\'');
        return match mute && !sound && lower.is_ascii() && lower.chars().count() > 1 {
            true => WrittenPart::Letters(lower),
            false => WrittenPart::Word(lower, hyphen),
        };
    }
    let two = lower.chars().count() == 2;
    let listed =
        FRENCH_SPELLING_RULES.spelled.contains(&lower) || (two && !FRENCH_SPELLING_RULES.short_words.contains(&lower));
    if FRENCH_SPELLING_RULES.acronyms.contains_key(&lower) && !shouted {
        return WrittenPart::Acronym(lower);
    }
    if mute || (!shouted && listed) || FRENCH_SPELLING_RULES.is_unpronounceable(&lower) {
        return WrittenPart::Letters(lower);
    }
    WrittenPart::Word(lower, hyphen)
}
