//! French numbers: digits to words, and the sounds between the words of a number and what follows them.

use super::french::{FRENCH_SPELLING_RULES, FrenchWord};

/// The greatest number that is read.
const MAX_READ_NUMBER: u64 = 999_999_999_999;

const SMALL_NUMBER_WORDS: [&str; 17] = [
    "zéro", "un", "deux", "trois", "quatre", "cinq", "six", "sept", "huit", "neuf", "dix", "onze", "douze", "treize",
    "quatorze", "quinze", "seize",
];
const TENS_NUMBER_WORDS: [&str; 7] = ["", "", "vingt", "trente", "quarante", "cinquante", "soixante"];

/// Reads the number at the start of `rest`; returns its length and its words, or no words if it is not read.
///
/// It reads whole numbers with or without blanks between groups of three digits (*1 200*), decimals (*3,5*), the ordinals
/// *1er*, *1re*, *2e*, *2ème*, hours (*8h30*, *8 h*) and units (*5 %*, *3,50 €*, *20 °C*).
pub(super) fn read_french_number(rest: &[char]) -> (usize, Option<Vec<String>>) {
    let digits = |from: usize| {
        rest[from.min(rest.len())..]
            .iter()
            .take_while(|letter| letter.is_ascii_digit())
            .count()
    };
    let mut length = digits(0);
    if length == 0 {
        return (
            rest.iter().take_while(|letter| letter.is_numeric()).count().max(1),
            None,
        );
    }
    if let Some(read) = read_parted_number(rest) {
        return read;
    }
    let mut digit_text: String = rest[..length].iter().collect();
    // *007*: zeros before a number are said.
    let zeros = digit_text.len() - digit_text.trim_start_matches('0').len();
    if zeros > 0 && length > 1 && rest.get(length) != Some(&'h') {
        let mut words = vec![SMALL_NUMBER_WORDS[0].to_owned(); zeros.min(length - 1)];
        let value = digit_text.parse().ok().filter(|value| *value <= MAX_READ_NUMBER);
        words.extend(value.map(cardinal).unwrap_or_default());
        return (length, value.map(|_| words));
    }
    let groups = length <= 3 && rest[0] != '0';
    while groups && is_blank(rest.get(length)) && digits(length + 1) == 3 {
        digit_text.extend(&rest[length + 1..length + 4]);
        length += 4;
    }
    let value = digit_text.parse().ok().filter(|value| *value <= MAX_READ_NUMBER);
    let Some(value) = value else {
        return (length, None);
    };
    let mut words = cardinal(value);
    let next = |at: usize| rest.get(at).copied().unwrap_or(' ');
    let decimals = digits(length + 1);
    if next(length) == ',' && decimals > 0 {
        words.push("virgule".to_owned());
        let digits = &rest[length + 1..=length + decimals];
        let zeros = digits
            .iter()
            .take_while(|digit| **digit == '0')
            .count()
            .min(decimals - 1);
        words.extend(std::iter::repeat_n("zéro".to_owned(), zeros));
        length += 1 + decimals;
        match digits[zeros..].iter().collect::<String>().parse() {
            Ok(value) if value <= MAX_READ_NUMBER => words.extend(cardinal(value)),
            _ => return (length, None),
        }
        return with_unit(rest, length, words);
    }
    let suffix: String = rest[length..]
        .iter()
        .take_while(|letter| letter.is_alphabetic())
        .collect();
    let after = length + suffix.chars().count();
    match suffix.as_str() {
        "" => {}
        "er" if value == 1 => return (after, Some(vec!["premier".to_owned()])),
        "re" | "ère" if value == 1 => return (after, Some(vec!["première".to_owned()])),
        "e" | "ème" | "eme" if value > 1 => return (after, Some(ordinal(words))),
        "h" if value <= 24 => {
            words = feminine(words);
            words.push(if value < 2 { "heure" } else { "heures" }.to_owned());
            let minutes = digits(after).min(3);
            if minutes == 2 {
                let text: String = rest[after..after + 2].iter().collect();
                let value = text.parse().unwrap_or(0);
                words.extend(if value == 0 {
                    Vec::new()
                } else {
                    feminine(cardinal(value))
                });
                return (after + 2, Some(words));
            }
            return (after, Some(words));
        }
        // A number within a name, such as *3D*.
        _ => {}
    }
    let blank = is_blank(rest.get(length));
    if blank && next(length + 1) == 'h' && !next(length + 2).is_alphanumeric() && value <= 24 {
        words = feminine(words);
        words.push(if value < 2 { "heure" } else { "heures" }.to_owned());
        return (length + 2, Some(words));
    }
    with_unit(rest, length, words)
}

/// Telephone numbers, dates and fractions are shorter than this, in letters.
const MAX_PARTED_LETTERS: usize = 32;

/// Reads a telephone number (*01 23 45 67 89*), a date (*14/07/1789*) or a fraction (*3/4*).
fn read_parted_number(rest: &[char]) -> Option<(usize, Option<Vec<String>>)> {
    let digits = rest
        .iter()
        .take(MAX_PARTED_LETTERS)
        .take_while(|letter| letter.is_ascii_digit() || " ./\u{a0}\u{202f}".contains(**letter));
    let text: String = digits.collect();
    let text = text.trim_end_matches(|letter: char| !letter.is_ascii_digit());
    let length = text.chars().count();
    let parts = |marks: &[char]| {
        text.split(marks)
            .map(|part| (part.len(), part.parse::<u64>().ok()))
            .collect::<Vec<_>>()
    };
    let pairs = parts(&[' ', '.', '\u{a0}', '\u{202f}']);
    if pairs.len() == 5 && text.starts_with('0') && pairs.iter().all(|(width, value)| *width == 2 && value.is_some()) {
        let pair_words = |(_, value): &(usize, Option<u64>)| {
            let value = value.unwrap_or_default();
            let zero = (1..10).contains(&value).then(|| SMALL_NUMBER_WORDS[0].to_owned());
            zero.into_iter().chain(cardinal(value)).collect::<Vec<_>>()
        };
        return Some((length, Some(pairs.iter().flat_map(pair_words).collect())));
    }
    let months = &FRENCH_SPELLING_RULES.months;
    match *parts(&['/']) {
        [(_, Some(day @ 1..=31)), (_, Some(month @ 1..=12)), (2 | 4, Some(year))] => {
            let mut words = if day == 1 {
                vec!["premier".to_owned()]
            } else {
                cardinal(day)
            };
            words.extend(months.get(month as usize - 1).cloned());
            words.extend(cardinal(year));
            Some((length, Some(words)))
        }
        [(_, Some(upper @ 1..=20)), (_, Some(lower @ 2..=20))] => {
            let mut words = cardinal(upper);
            let part = match lower {
                2 => "demi".to_owned(),
                3 => "tiers".to_owned(),
                4 => "quart".to_owned(),
                _ => ordinal(cardinal(lower)).pop().unwrap_or_default(),
            };
            let plural = if upper > 1 && lower != 3 { "s" } else { "" };
            words.push(format!("{part}{plural}"));
            Some((length, Some(words)))
        }
        _ => None,
    }
}

/// Adds the words of the unit behind a number that is `length` letters long, such as *%*, *€* and *km*.
fn with_unit(rest: &[char], length: usize, mut words: Vec<String>) -> (usize, Option<Vec<String>>) {
    let from = length + usize::from(is_blank(rest.get(length)));
    let behind = &rest[from.min(rest.len())..];
    let begins = |unit: &str| {
        let length = unit.chars().count();
        let apart = |next: &char| !next.is_alphanumeric() && *next != '\'' && *next != '/';
        let letters = unit.ends_with(char::is_alphabetic);
        let ends = !letters || behind.get(length).is_none_or(apart);
        (unit.chars().eq(behind.iter().copied().take(length)) && ends).then_some(length)
    };
    let units = FRENCH_SPELLING_RULES.units.iter();
    let unit_matches = units.filter_map(|(unit, long)| Some((begins(unit)?, long)));
    let Some((unit, long)) = unit_matches.max_by_key(|unit_match| unit_match.0) else {
        return (length, Some(words));
    };
    if ["livres", "secondes", "minutes"].contains(&long.as_str()) {
        words = feminine(words);
    }
    words.extend(long.split(' ').map(str::to_owned));
    (from + unit, Some(words))
}

fn is_blank(letter: Option<&char>) -> bool {
    matches!(letter, Some(' ' | '\u{a0}' | '\u{202f}'))
}

/// Returns the words of a whole number.
fn cardinal(value: u64) -> Vec<String> {
    if value == 0 {
        return vec![SMALL_NUMBER_WORDS[0].to_owned()];
    }
    let mut words = Vec::new();
    let mut rest = value;
    for (size, name) in [(1_000_000_000, "milliard"), (1_000_000, "million"), (1_000, "mille")] {
        let count = rest / size;
        rest %= size;
        if count == 0 {
            continue;
        }
        if size > 1_000 || count > 1 {
            below_thousand(count, &mut words, false);
        }
        let plural = if size > 1_000 && count > 1 { "s" } else { "" };
        words.push(format!("{name}{plural}"));
    }
    below_thousand(rest, &mut words, true);
    words
}

/// Adds the words of a number below 1,000; `last` is false before *mille*.
fn below_thousand(value: u64, words: &mut Vec<String>, last: bool) {
    let mut push = |word: &str| words.push(word.to_owned());
    let (hundreds, rest) = (value / 100, (value % 100) as usize);
    if hundreds > 1 {
        push(SMALL_NUMBER_WORDS[hundreds as usize]);
    }
    if hundreds > 0 {
        // *Cents* has its s only at the end: *deux cents*, but *deux cent un* and *deux cent mille*.
        push(if hundreds > 1 && rest == 0 && last {
            "cents"
        } else {
            "cent"
        });
    }
    let (ten, one) = (rest / 10, rest % 10);
    match rest {
        0 => {}
        1..=16 => push(SMALL_NUMBER_WORDS[rest]),
        17..=19 => [SMALL_NUMBER_WORDS[10], SMALL_NUMBER_WORDS[one]]
            .into_iter()
            .for_each(&mut push),
        // *Quatre-vingts* loses its s before another word of the number, as *cents* does.
        80 => ["quatre", if last { "vingts" } else { "vingt" }]
            .into_iter()
            .for_each(&mut push),
        20..=69 => {
            push(TENS_NUMBER_WORDS[ten]);
            match one {
                0 => {}
                1 => ["et", "un"].into_iter().for_each(&mut push),
                _ => push(SMALL_NUMBER_WORDS[one]),
            }
        }
        _ => {
            // From 70 to 79 one counts on from 60, and from 81 to 99 from 80: *soixante-dix-sept*,
            // *quatre-vingt-onze*.
            let above = if rest < 80 {
                push(TENS_NUMBER_WORDS[6]);
                rest - 60
            } else {
                ["quatre", "vingt"].into_iter().for_each(&mut push);
                rest - 80
            };
            // *Soixante et onze* has an *et*, but *quatre-vingt-onze* has none.
            if rest == 71 {
                push("et");
            }
            match above {
                17..=19 => [SMALL_NUMBER_WORDS[10], SMALL_NUMBER_WORDS[above - 10]]
                    .into_iter()
                    .for_each(&mut push),
                _ => push(SMALL_NUMBER_WORDS[above]),
            }
        }
    }
}

/// Makes *un* at the end *une*.
fn feminine(mut words: Vec<String>) -> Vec<String> {
    if let Some(last) = words.last_mut().filter(|last| *last == "un") {
        last.push('e');
    }
    words
}

/// Makes the last word an ordinal.
fn ordinal(mut words: Vec<String>) -> Vec<String> {
    if let Some(last) = words.last_mut() {
        *last = match last.as_str() {
            "cinq" => "cinquième".to_owned(),
            "neuf" => "neuvième".to_owned(),
            "cents" | "vingts" | "millions" | "milliards" => {
                format!("{}ième", &last[..last.len() - 1])
            }
            other => format!("{}ième", other.strip_suffix('e').unwrap_or(other)),
        };
    }
    words
}

/// Settles the sounds between a word of a number and the next word; returns whether nothing else joins them.
///
/// *Six*, *huit* and *dix* lose their consonant before another one, *vingt* has its *t* from 21 to 29, *neuf* its *v*
/// before *ans* and *heures*, and words within a number do not link as before a noun: *cent un*, *quatre-vingt-un*.
pub(super) fn join_number_word(
    before: Option<&FrenchWord>,
    word: &mut FrenchWord,
    next: &FrenchWord,
    vowel: bool,
) -> bool {
    let is_number = |text: &str| SMALL_NUMBER_WORDS.contains(&text) || text == "une";
    let under_ten = |text: &str| SMALL_NUMBER_WORDS[1..10].contains(&text) || text == "une";
    let after_four = before.is_some_and(|previous| previous.text == "quatre");
    let phones = match (word.text.as_str(), next.text.as_str()) {
        (_, "") => return false,
        ("neuf", "ans" | "heures") => "n 9 v",
        ("dix", "sept") => "d i",
        ("dix", "huit" | "neuf") => "d i z",
        // In *quatre-vingt-un* the t of *vingt* is silent, in *vingt et un* it is not.
        ("vingt", next) if after_four && is_number(next) => "v E~",
        ("vingt", next) if under_ten(next) => "v E~ t",
        ("cent", next) if is_number(next) => "s A~",
        ("six", _) if !vowel => "s i",
        ("dix", _) if !vowel => "d i",
        ("huit", _) if !vowel => "H i",
        _ => return false,
    };
    word.phones = phones.split(' ').map(str::to_owned).collect();
    true
}
