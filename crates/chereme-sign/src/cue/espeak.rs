//! The phones that the program `espeak-ng` prints in IPA, cut into the symbols that a code knows.

use super::{Alphabet, CueCode};

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
        let letters = bare(line, french);
        let mut at = 0;
        let mut own: Vec<String> = Vec::new();
        while at < letters.len() {
            const LONGEST: usize = 4;
            let most = LONGEST.min(letters.len() - at);
            let fits = |count: &usize| {
                let label: String = letters[at..at + count].iter().collect();
                let known = !label.contains(' ') && code.symbols(&label, Alphabet::Ipa).is_some();
                known.then_some(label)
            };
            match (1..=most)
                .rev()
                .find_map(|count| Some((count, fits(&count)?)))
            {
                Some((count, label)) => {
                    own.push(label);
                    at += count;
                }
                None => {
                    if letters[at] != ' ' {
                        unknown.push(letters[at]);
                    }
                    at += 1;
                }
            }
        }
        if french {
            glide(&mut own);
        }
        if !own.is_empty() {
            phones.extend(own);
            phones.push("#".to_owned());
        }
    }
    (phones.join(" "), unknown)
}

/// Returns the letters of a line without marks and names of languages; blanks stay as word boundaries.
fn bare(line: &str, french: bool) -> Vec<char> {
    let mut inside = false;
    let mut letters = Vec::new();
    for letter in line.chars() {
        match letter {
            '(' => inside = true,
            ')' => inside = false,
            _ if inside => {}
            'ˈ' | 'ˌ' | '.' | '-' | '_' | '\u{200d}' | '\u{361}' => {}
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
            .is_some_and(|it| "aeiouyɑɔɛœøə".contains(it))
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
    use super::super::code;
    use super::*;

    #[test]
    fn printed_lines_become_phones_of_the_code() {
        let french = code("french").expect("French");
        let (phones, unknown) =
            of_espeak(" lə ʃˈa dˈɔʁ\n nyˈi rjˈɛ̃ lə-z-ɑ̃fˈɑ̃\n (en)ɹ(fr)\n", french);
        assert_eq!(phones, "l ə ʃ a d ɔ ʁ # n ɥ i r j ɛ̃ l ə z ɑ̃ f ɑ̃ #");
        assert_eq!(unknown, ['ɹ']);
        let english = code("en-US").expect("American");
        let (phones, unknown) = of_espeak("hˈaʊs ɪz fˈiːt tʃˈɛɹ", english);
        assert_eq!(phones, "h aʊ s ɪ z f iː t tʃ ɛ ɹ #");
        assert!(unknown.is_empty());
        assert_eq!(of_espeak("", english), (String::new(), Vec::new()));
    }
}
