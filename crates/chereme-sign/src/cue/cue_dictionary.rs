//! Pronunciations that people bring themselves: a list of words with their phones, in the formats of aligners and of Lexique.

use std::collections::BTreeMap;

use super::{CueCode, PhoneAlphabet, espeak};

/// The most words of a dictionary; the largest ones of aligners have some 300,000.
const MAX_DICTIONARY_WORDS: usize = 1 << 20;

/// The pronunciations of words.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PronunciationDictionary {
    /// The phones in SAMPA by the word in lower case.
    words: BTreeMap<String, Vec<String>>,
    /// The number of lines whose phones the code does not know.
    pub left_out: usize,
    /// The first such line, counted from 1.
    pub first_left_out: usize,
}

/// The reason why a dictionary cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DictionaryError {
    /// No line is a word with phones of the code.
    #[error("no line of the dictionary is a word with phones that the code {code:?} knows")]
    NoWords {
        /// The code.
        code: String,
    },
    /// The dictionary is larger than any language's.
    #[error("the dictionary has more than {limit} words")]
    Large {
        /// The limit.
        limit: usize,
    },
}

/// A line of a dictionary: a word, its phones as they are written, and how often it is said.
struct DictionaryLine<'l> {
    number: usize,
    word: &'l str,
    phones: Vec<&'l str>,
    frequency: f64,
}

/// The columns of Lexique, by their titles.
struct LexiqueColumns {
    word: usize,
    phones: usize,
    frequency: Option<usize>,
}

impl PronunciationDictionary {
    /// Reads a dictionary: a word and its phones on each line, with a tab, comma or semicolon between them (then phones may
    /// be written together), or blanks; the same with probabilities between them, as the Montreal Forced Aligner
    /// writes it; with the word again in brackets, as SPPAS does; or Lexique's table, by its titles. The first
    /// pronunciation of a word counts, in Lexique the most frequent one.
    ///
    /// ```
    /// use chereme_sign::cue::{PronunciationDictionary, find_cue_code};
    /// let code = find_cue_code("french").expect("a code");
    /// for text in ["fils\tf i s", "fils\t0.99\t0.1\t1.0\t1.0\tf i s", "fils [fils] f i s", "fils,fis", "ortho\tphon\nfils\tfis"] {
    ///     let dictionary = PronunciationDictionary::read_dictionary(text, code)?;
    ///     assert_eq!(dictionary.find_pronunciation("fils").map(|phones| phones.join(" ")).as_deref(), Some("f i s"));
    /// }
    /// # Ok::<(), chereme_sign::cue::DictionaryError>(())
    /// ```
    ///
    /// # Errors
    /// [`DictionaryError`] if no line can be read, or there are more than a million words.
    pub fn read_dictionary(text: &str, code: &CueCode) -> Result<Self, DictionaryError> {
        let text = text.trim_start_matches('\u{feff}');
        let columns = text.lines().next().and_then(lexique_columns);
        let skipped = usize::from(columns.is_some());
        let numbered = (1..).zip(text.lines()).skip(skipped);
        let lines: Vec<DictionaryLine<'_>> = numbered
            .filter_map(|(number, line)| match &columns {
                Some(columns) => split_lexique_line(line, number, columns),
                None => split_dictionary_line(line, number),
            })
            .collect();
        if lines.len() > MAX_DICTIONARY_WORDS {
            return Err(DictionaryError::Large {
                limit: MAX_DICTIONARY_WORDS,
            });
        }
        let mut dictionary = Self::default();
        let lexique = code.alphabets.get("lexique").filter(|_| columns.is_some());
        let alphabet = dictionary_alphabet(&lines, code);
        let mut frequencies: BTreeMap<String, f64> = BTreeMap::new();
        for line in &lines {
            let spoken = match lexique {
                Some(table) => lexique_phones(line.phones.first().unwrap_or(&""), table),
                None => sampa_phones(&line.phones, code, alphabet),
            };
            let Some(phones) = spoken.filter(|phones| phones.iter().all(|phone| code.knows_sound(phone))) else {
                dictionary.left_out += 1;
                if dictionary.left_out == 1 {
                    dictionary.first_left_out = line.number;
                }
                continue;
            };
            let word = line.word.to_lowercase().replace('\u{2019}', "'");
            let is_best = frequencies.get(&word).is_none_or(|known| line.frequency > *known);
            if is_best {
                frequencies.insert(word.clone(), line.frequency);
                dictionary.words.insert(word, phones);
            }
        }
        if dictionary.words.is_empty() {
            return Err(DictionaryError::NoWords { code: code.id.clone() });
        }
        Ok(dictionary)
    }

    /// Returns the phones of a word in lower case, in SAMPA.
    #[must_use]
    pub fn find_pronunciation(&self, word: &str) -> Option<&[String]> {
        self.words.get(word).map(Vec::as_slice)
    }

    /// Returns the number of words.
    #[must_use]
    pub fn dictionary_word_count(&self) -> usize {
        self.words.len()
    }
}

/// Returns the columns of Lexique's table, if this is its first line: `ortho` and `phon`, in old versions with numbers.
fn lexique_columns(first_line: &str) -> Option<LexiqueColumns> {
    let bare = |title: &str| {
        title
            .trim_start_matches(|c: char| c.is_ascii_digit() || c == '_')
            .trim()
            .to_owned()
    };
    let titles: Vec<String> = first_line.split('\t').map(bare).collect();
    let position = |wanted: &str| titles.iter().position(|title| title == wanted);
    Some(LexiqueColumns {
        word: position("ortho")?,
        phones: position("phon")?,
        frequency: position("freqfilms2"),
    })
}

fn split_lexique_line<'l>(line: &'l str, number: usize, columns: &LexiqueColumns) -> Option<DictionaryLine<'l>> {
    let cells: Vec<&str> = line.split('\t').map(str::trim).collect();
    let stated_frequency = columns
        .frequency
        .and_then(|column| cells.get(column)?.replace(',', ".").parse().ok());
    Some(DictionaryLine {
        number,
        word: cells.get(columns.word).filter(|word| !word.is_empty())?,
        phones: vec![cells.get(columns.phones)?],
        frequency: stated_frequency.unwrap_or_default(),
    })
}

/// Splits a line at tabs, commas or semicolons, else at blanks; comments (`#`, `;;;`) and lines without phones give nothing.
fn split_dictionary_line(line: &str, number: usize) -> Option<DictionaryLine<'_>> {
    let line = line.trim();
    if line.starts_with('#') || line.starts_with(";;;") {
        return None;
    }
    let (word, rest) = line.split_once(['\t', ',', ';']).or_else(|| line.split_once(' '))?;
    let is_probability = |part: &&str| part.contains('.') && part.parse::<f64>().is_ok();
    let is_repeated = |part: &&str| part.starts_with('[') && part.ends_with(']');
    let parts = rest.split_whitespace();
    let phones: Vec<&str> = parts
        .skip_while(is_probability)
        .filter(|part| !is_repeated(part))
        .collect();
    // `fils(2)` is another pronunciation of the same word.
    let is_bare = !word.is_empty() && !word.ends_with(')') && !phones.is_empty();
    is_bare.then_some(DictionaryLine {
        number,
        word,
        phones,
        frequency: 0.0,
    })
}

/// Returns the alphabet that knows most lines; in a tie SAMPA before IPA before MFA.
fn dictionary_alphabet(lines: &[DictionaryLine<'_>], code: &CueCode) -> PhoneAlphabet {
    const TRIED_LINES: usize = 1000;
    let knows = |alphabet: &PhoneAlphabet| {
        let tried = lines.iter().take(TRIED_LINES);
        tried
            .filter(|line| sampa_phones(&line.phones, code, *alphabet).is_some())
            .count()
    };
    let all = PhoneAlphabet::ALL_ALPHABETS.into_iter().rev();
    all.max_by_key(knows).unwrap_or_default()
}

/// Returns labels, or labels written together, in SAMPA; `None` if the code does not know one.
pub(super) fn sampa_phones(labels: &[&str], code: &CueCode, alphabet: PhoneAlphabet) -> Option<Vec<String>> {
    let mut phones = Vec::new();
    for label in labels {
        for symbol in espeak::cut_joined_phones(label, code, alphabet)? {
            phones.extend(code.sampa_symbols(&symbol, alphabet)?);
        }
    }
    (!phones.is_empty()).then_some(phones)
}

/// Returns the phones of Lexique, one letter each.
fn lexique_phones(written: &str, table: &BTreeMap<String, String>) -> Option<Vec<String>> {
    let letters = written.chars().map(String::from);
    let phones: Vec<String> = letters
        .map(|letter| table.get(&letter).cloned().unwrap_or(letter))
        .collect();
    (!phones.is_empty()).then_some(phones)
}
