//! The phones that the program `espeak-ng` prints in IPA, cut into the symbols that a code knows.

use super::{CueCode, PhoneAlphabet};

/// Returns the phones of what `espeak-ng --ipa` printed, separated by blanks with `#` for the end of a line, and the
/// characters that the code does not know.
///
/// Stress, joins and the names of languages in parentheses are left out. In French, `y` before `i` becomes the glide
/// `ɥ`, and `i` before a vowel the glide `j`, as cuers pronounce them.
#[must_use]
pub fn of_espeak(printed: &str, code: &CueCode) -> (String, Vec<char>) {
    let french = code.language == "fr";
    let (mut phones, mut unknown) = (Vec::new(), Vec::new());
    for line in printed.lines() {
        let letters = strip_phone_marks(line, french);
        let mut letter_index = 0;
        let mut read_symbols: Vec<String> = Vec::new();
        while letter_index < letters.len() {
            match longest_leading_symbol(&letters[letter_index..], code, PhoneAlphabet::Ipa) {
                Some(label) => {
                    letter_index += label.chars().count();
                    read_symbols.push(label);
                }
                None => {
                    // Blanks part words, which phones of a sentence do not need.
                    if letters[letter_index] != ' ' {
                        unknown.push(letters[letter_index]);
                    }
                    letter_index += 1;
                }
            }
        }
        if french {
            glide(&mut read_symbols);
        }
        if !read_symbols.is_empty() {
            phones.extend(read_symbols);
            phones.push("#".to_owned());
        }
    }
    (phones.join(" "), unknown)
}

/// Returns the longest symbol of the code with which some letters begin; `None` if it knows none.
fn longest_leading_symbol(letters: &[char], code: &CueCode, alphabet: PhoneAlphabet) -> Option<String> {
    const MAX_SYMBOL_LETTERS: usize = 4;
    (1..=MAX_SYMBOL_LETTERS.min(letters.len())).rev().find_map(|count| {
        let label: String = letters[..count].iter().collect();
        // `eu` and `oe` are labels of one phone by themselves only: `poezi` has an `o` and an `e`.
        let is_joined = alphabet == PhoneAlphabet::Sampa && count > 1;
        let several = is_joined && label.bytes().all(|letter| b"aeiouy".contains(&letter));
        let is_known = !several && !label.contains(' ') && code.sampa_symbols(&label, alphabet).is_some();
        is_known.then_some(label)
    })
}

/// Cuts phones that are written together, such as `bɔ̃ʒuʁ` or `/həˈloʊ/`, into symbols of the code; `None` if the
/// code does not know a part of them. A symbol of the code is not cut.
pub(super) fn cut_joined_phones(word: &str, code: &CueCode, alphabet: PhoneAlphabet) -> Option<Vec<String>> {
    if code.sampa_symbols(word, alphabet).is_some() {
        return Some(vec![word.to_owned()]);
    }
    let letters: Vec<char> = match alphabet {
        PhoneAlphabet::Ipa => strip_phone_marks(word.trim_matches(['/', '[', ']', '\\']), false),
        PhoneAlphabet::Sampa | PhoneAlphabet::Mfa => word.chars().collect(),
    };
    let mut symbols = Vec::new();
    let mut rest = &letters[..];
    while !rest.is_empty() {
        let label = longest_leading_symbol(rest, code, alphabet)?;
        rest = &rest[label.chars().count()..];
        symbols.push(label);
    }
    (!symbols.is_empty()).then_some(symbols)
}

/// Returns the letters of a line without marks and names of languages; blanks stay as word boundaries.
fn strip_phone_marks(line: &str, french: bool) -> Vec<char> {
    let mut inside = false;
    let mut letters = Vec::new();
    for letter in line.chars() {
        match letter {
            '(' => inside = true,
            ')' => inside = false,
            _ if inside => {}
            'ˈ' | 'ˌ' | '.' | '-' | '_' | '‿' | '\u{200d}' | '\u{361}' => {}
            'ː' if french => {}
            _ if letter.is_whitespace() => letters.push(' '),
            _ => letters.push(letter),
        }
    }
    letters
}

fn glide(phones: &mut [String]) {
    let is_vowel = |phone: &str| {
        phone
            .chars()
            .next()
            .is_some_and(|letter| "aeiouyɑɔɛœøə".contains(letter))
    };
    for at in 0..phones.len().saturating_sub(1) {
        let next = phones[at + 1].clone();
        match phones[at].as_str() {
            "y" if next == "i" => "ɥ".clone_into(&mut phones[at]),
            "i" if is_vowel(&next) && next != "i" => "j".clone_into(&mut phones[at]),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cue::find_cue_code;

    #[test]
    fn printed_lines_become_phones_of_the_code() {
        let french = find_cue_code("french").expect("French");
        let (phones, unknown) = of_espeak(" lə ʃˈa dˈɔʁ\n nyˈi rjˈɛ̃ lə-z-ɑ̃fˈɑ̃\n (en)ɹ(fr)\n", french);
        assert_eq!(phones, "l ə ʃ a d ɔ ʁ # n ɥ i r j ɛ̃ l ə z ɑ̃ f ɑ̃ #");
        assert_eq!(unknown, ['ɹ']);
        let english = find_cue_code("en-US").expect("American");
        let (phones, unknown) = of_espeak("hˈaʊs ɪz fˈiːt tʃˈɛɹ", english);
        assert_eq!(phones, "h aʊ s ɪ z f iː t tʃ ɛ ɹ #");
        assert!(unknown.is_empty());
        assert_eq!(of_espeak("", english), (String::new(), Vec::new()));
    }
}
