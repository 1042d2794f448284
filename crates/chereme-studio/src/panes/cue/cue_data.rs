//! The content of the pane of cued speech, without a window: words, keys, corrections and exercises.

use std::collections::BTreeMap;

use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{CueOptions, CueSlip, KeysOptions, SlipKind};
use chereme_sign::cue::french::{self, SchwaCondition};
use chereme_sign::cue::{CuedUtterance, PhoneAlphabet, SpokenPhone, all_cue_codes};

use crate::words::{InterfaceLanguage, InterfaceText, cue_words as words, fill_text_braces};

/// The longest text, in bytes, that is analysed while it is typed.
const MAX_CUED_TEXT_BYTES: usize = 4000;

/// The settings for cueing a text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CueChoices {
    /// Index of the code among the program's codes.
    pub(super) code: usize,
    pub(super) liaison: bool,
    /// Whether every e at the end of a word is pronounced.
    pub(super) schwa: bool,
    pub(super) rule: PhaseRule,
    pub(super) pace: f64,
    pub(super) left: bool,
}

impl Default for CueChoices {
    fn default() -> Self {
        Self {
            code: 0,
            liaison: true,
            schwa: false,
            rule: PhaseRule::Paper,
            pace: 1.6,
            left: false,
        }
    }
}

impl CueChoices {
    /// Returns whether the code has spelling rules, so that text can be typed; other codes take phones.
    pub(super) fn has_spelling_rules(&self) -> bool {
        all_cue_codes().get(self.code).is_some_and(|code| code.language == "fr")
    }

    fn french_phone_options(&self) -> french::PronunciationOptions {
        french::PronunciationOptions {
            liaison: self.liaison,
            schwa: if self.schwa {
                SchwaCondition::Said
            } else {
                SchwaCondition::Usual
            },
        }
    }

    /// Returns the library's options for the input of a reading.
    pub(super) fn cue_options_for(&self, reading: &CuedReading) -> CueOptions {
        let code = all_cue_codes().get(self.code).map_or("french", |code| code.id.as_str());
        CueOptions {
            reading: KeysOptions {
                code: code.to_owned(),
                phones: reading.as_phones.then_some(PhoneAlphabet::Sampa),
                variants: Vec::new(),
                french: self.french_phone_options(),
                pace: Some(self.pace),
                dictionary: None,
            },
            signer: None,
            phase: self.rule,
            left: self.left,
        }
    }
}

/// A word with its phones; a pause has no text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CuedWord {
    pub(super) text: String,
    pub(super) phones: Vec<String>,
    /// Whether the user changed its phones.
    pub(super) corrected: bool,
}

/// A key, and the phones that it represents.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CuedKey {
    pub(super) placement: String,
    pub(super) shape: u8,
    pub(super) phones: String,
    /// Another common vowel at this place: the index of the word, the index of the phone, the vowel, and its placement.
    pub(super) other: Option<(usize, usize, String, String)>,
}

/// The analysis of a text.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CuedReading {
    pub(super) words: Vec<CuedWord>,
    pub(super) keys: Vec<CuedKey>,
    pub(super) findings: Vec<String>,
    /// The text, or the phones if the user corrected some.
    pub(super) input: String,
    pub(super) as_phones: bool,
}

/// The user's corrections of phones, by the index and the letters of the word.
pub(super) type PhoneCorrections = BTreeMap<(usize, String), Vec<String>>;

/// Analyses a text with the corrections that still match its words.
pub(super) fn read_cued_text(text: &str, choices: &CueChoices, corrections: &PhoneCorrections) -> CuedReading {
    let Some(code) = all_cue_codes().get(choices.code) else {
        return CuedReading::default();
    };
    let end = (0..=MAX_CUED_TEXT_BYTES.min(text.len()))
        .rev()
        .find(|at| text.is_char_boundary(*at));
    let text = &text[..end.unwrap_or(0)];
    let mut reading = CuedReading::default();
    let mut doubtful: Vec<Vec<usize>> = Vec::new();
    if choices.has_spelling_rules() {
        let spoken = french::pronounce_french_text(text, choices.french_phone_options());
        reading.findings.extend(spoken.findings.iter().map(ToString::to_string));
        for (at, word) in spoken.words.into_iter().enumerate() {
            let corrected = corrections.get(&(at, word.text.clone()));
            doubtful.push(word.doubtful);
            reading.words.push(CuedWord {
                phones: corrected.cloned().unwrap_or(word.phones),
                corrected: corrected.is_some(),
                text: word.text,
            });
        }
    } else {
        let phones = text.split_whitespace().map(str::to_owned).collect();
        reading.words.push(CuedWord {
            text: String::new(),
            phones,
            corrected: false,
        });
        doubtful.push(Vec::new());
    }
    let corrected = reading.words.iter().any(|word| word.corrected);
    // A corrected word cannot be read from its spelling again, so that the whole input is given as phones.
    reading.as_phones = corrected || !choices.has_spelling_rules();
    let places: Vec<(usize, usize)> = reading
        .words
        .iter()
        .enumerate()
        .flat_map(|(word, own)| (0..own.phones.len()).map(move |at| (word, at)))
        .collect();
    let phones: Vec<SpokenPhone> = places
        .iter()
        .map(|(word, at)| SpokenPhone::new(reading.words[*word].phones[*at].clone()))
        .collect();
    reading.input = if reading.as_phones {
        let labels: Vec<&str> = phones.iter().map(|phone| phone.label.as_str()).collect();
        labels.join(" ")
    } else {
        text.trim().to_owned()
    };
    let read = CuedUtterance::of_phones(code.clone(), phones, PhoneAlphabet::Sampa);
    reading.findings.extend(read.findings.iter().map(ToString::to_string));
    for key in &read.keys {
        let vowel = key.from.last().and_then(|at| places.get(*at)).copied();
        let other = vowel.and_then(|(word, at)| {
            let phone = key.phones.last()?;
            // Only vowels that the code gives to two places are worth a question, and only where the spelling leaves
            // them open.
            let uncertain = doubtful[word].contains(&at) || reading.words[word].corrected;
            let pair = code.doubtful.iter().find(|pair| uncertain && pair.contains(phone))?;
            let other = pair.iter().find(|member| *member != phone)?;
            let place = code.path_of(other)?.into_iter().next()?;
            (place != key.placement).then(|| (word, at, other.clone(), place))
        });
        reading.keys.push(CuedKey {
            placement: key.placement.clone(),
            shape: key.shape,
            phones: key.phones.join(" "),
            other,
        });
    }
    reading
}

/// Returns the name of a placement in a language; names of other codes stay as they are.
pub(super) fn cue_placement_title(id: &str, language: InterfaceLanguage) -> String {
    let text: Option<InterfaceText> = match id {
        "side" => Some(words::AT_SIDE),
        "mouth" => Some(words::AT_MOUTH),
        "chin" => Some(words::AT_CHIN),
        "cheek" => Some(words::AT_CHEEK),
        "throat" => Some(words::AT_THROAT),
        "side-forward" => Some(words::AT_SIDE_FORWARD),
        "side-down" => Some(words::AT_SIDE_DOWN),
        _ => None,
    };
    text.map_or_else(|| id.to_owned(), |text| text.text_in_language(language).to_owned())
}

/// Returns the spoken name of a key: its placement and the number of its handshape.
pub(super) fn translated_cue_key_name(placement_id: &str, shape: u8, language: InterfaceLanguage) -> String {
    format!("{} {shape}", cue_placement_title(placement_id, language))
}

/// A word to practise: its letters, and the input to cue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PracticeItem {
    pub(super) word: String,
    pub(super) input: String,
}

/// Words that look alike on the lips, for each code: by text in French, by phones in English.
const FRENCH_LIP_WORDS: [&[&str]; 9] = [
    &["pain", "bain", "main"],
    &["pou", "bout", "mou"],
    &["tout", "doux", "nous"],
    &["chou", "joue"],
    &["fin", "vin"],
    &["poisson", "boisson", "moisson"],
    &["toit", "doigt", "noix"],
    &["car", "gare"],
    &["cadeau", "gâteau"],
];
const ENGLISH_LIP_WORDS: [&[(&str, &str)]; 4] = [
    &[("pat", "p { t"), ("bat", "b { t"), ("mat", "m { t")],
    &[("fan", "f { n"), ("van", "v { n")],
    &[("ten", "t E n"), ("den", "d E n")],
    &[("pea", "p i:"), ("bee", "b i:"), ("me", "m i:")],
];

/// Returns the sets of words that a code offers for practice.
pub(super) fn practice_sets(choices: &CueChoices) -> Vec<Vec<PracticeItem>> {
    let item = |word: &str, input: &str| PracticeItem {
        word: word.to_owned(),
        input: input.to_owned(),
    };
    if choices.has_spelling_rules() {
        let set = |set: &&[&str]| set.iter().map(|word| item(word, word)).collect();
        FRENCH_LIP_WORDS.iter().map(set).collect()
    } else {
        let set = |set: &&[(&str, &str)]| set.iter().map(|(word, phones)| item(word, phones)).collect();
        ENGLISH_LIP_WORDS.iter().map(set).collect()
    }
}

/// Syllables with different handshapes at one place, and syllables with one handshape at different places.
const FRENCH_KEYS: [&[&str]; 2] = [
    &["pa", "ca", "sa", "ba", "ta", "la", "ga", "ya"],
    &["ta", "ti", "tou", "tain", "té"],
];
const ENGLISH_KEYS: [&[&str]; 2] = [
    &["p A:", "k A:", "s A:", "b A:", "t A:", "l A:", "g A:", "j A:"],
    &["t i:", "t E", "t I", "t A:", "t V"],
];

/// Returns the keys that a code offers for practice, by handshape and by placement; each has the name of its key.
pub(super) fn key_sets(choices: &CueChoices, language: InterfaceLanguage) -> [(InterfaceText, Vec<PracticeItem>); 2] {
    let [shapes, places] = match choices.has_spelling_rules() {
        true => FRENCH_KEYS,
        false => ENGLISH_KEYS,
    };
    let item = |input: &&str| {
        let keys = read_cued_text(input, choices, &PhoneCorrections::new()).keys;
        let [key] = keys.as_slice() else {
            return None;
        };
        Some(PracticeItem {
            word: translated_cue_key_name(&key.placement, key.shape, language),
            input: (*input).to_owned(),
        })
    };
    let set = |inputs: &[&str]| inputs.iter().filter_map(item).collect();
    [(words::SHAPES, set(shapes)), (words::PLACES, set(places))]
}

/// Returns the first twelve words of the user's own set, separated by commas; `None` for fewer than two words.
pub(super) fn own_set(text: &str) -> Option<Vec<PracticeItem>> {
    let words = text
        .split([',', ';', '\n'])
        .map(str::trim)
        .filter(|word| !word.is_empty());
    let items: Vec<PracticeItem> = words
        .take(12)
        .map(|word| PracticeItem {
            word: word.to_owned(),
            input: word.to_owned(),
        })
        .collect();
    (items.len() > 1).then_some(items)
}

/// An exercise: the words, the cued one, and the score.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct CueExercise {
    pub(super) items: Vec<PracticeItem>,
    pub(super) now: usize,
    /// The index of the answer to the present word, if given.
    pub(super) answered: Option<usize>,
    pub(super) revealed: bool,
    pub(super) right: u32,
    pub(super) all: u32,
    /// State of the random numbers, which continues from word to word.
    seed: u64,
}

impl CueExercise {
    /// Begins with a set of words; `seed` decides their order.
    pub(super) fn from_practice_items(items: Vec<PracticeItem>, seed: u64) -> Self {
        let mut exercise = Self {
            items,
            seed,
            ..Self::default()
        };
        exercise.next();
        exercise
    }

    /// Goes to the next word, drawn from all of them.
    pub(super) fn next(&mut self) {
        self.seed = self
            .seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let count = self.items.len().max(1) as u64;
        self.now = ((self.seed >> 33) % count) as usize;
        (self.answered, self.revealed) = (None, false);
    }

    /// Records an answer; only the first one to a word counts.
    pub(super) fn record_answer(&mut self, item: usize) {
        if self.answered.is_some() || self.revealed {
            return;
        }
        self.answered = Some(item);
        self.all += 1;
        self.right += u32::from(item == self.now);
    }

    /// Returns the word that is being cued.
    pub(super) fn cued_item(&self) -> Option<&PracticeItem> {
        self.items.get(self.now)
    }
}

/// Returns the description of a slip, and its time in microseconds.
pub(super) fn describe_cue_slip(slip: &CueSlip, language: InterfaceLanguage) -> (String, Option<i64>) {
    let time = slip
        .at_us
        .map_or_else(|| "?".to_owned(), |at| format!("{:.2}", at as f64 / 1e6));
    let named = |key: &Option<String>| {
        let key = key.as_deref().unwrap_or_default();
        match key.rsplit_once('-') {
            Some((place, shape)) => format!("{} {shape}", cue_placement_title(place, language)),
            None => key.to_owned(),
        }
    };
    let (produced, predicted) = (named(&slip.produced), named(&slip.predicted));
    let text = match slip.kind {
        SlipKind::Insertion => fill_text_braces(
            words::INSERTION.text_in_language(language),
            &[("time", &time), ("produced", &produced)],
        ),
        SlipKind::Deletion => fill_text_braces(
            words::DELETION.text_in_language(language),
            &[("time", &time), ("predicted", &predicted)],
        ),
        _ => {
            let values: [(&str, &dyn std::fmt::Display); 3] =
                [("time", &time), ("produced", &produced), ("predicted", &predicted)];
            fill_text_braces(words::OTHER.text_in_language(language), &values)
        }
    };
    (text, slip.at_us)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(reading: &CuedReading) -> Vec<String> {
        let keys = reading.keys.iter();
        keys.map(|key| translated_cue_key_name(&key.placement, key.shape, InterfaceLanguage::English))
            .collect()
    }

    #[test]
    fn a_correction_applies_only_while_its_word_is_in_the_text() {
        let choices = CueChoices::default();
        let mut corrections = PhoneCorrections::new();
        let plain = read_cued_text("la maison", &choices, &corrections);
        assert_eq!((plain.as_phones, plain.input.as_str()), (false, "la maison"));
        assert_eq!(keys(&plain), ["side 6", "chin 5", "mouth 2"]);
        let (word, at, vowel, place) = plain.keys[1].other.clone().expect("speakers differ");
        assert_eq!((word, at, place.as_str()), (1, 1, "throat"));
        let mut phones = plain.words[word].phones.clone();
        phones[at] = vowel;
        corrections.insert((word, "maison".to_owned()), phones);
        let other = read_cued_text("la maison", &choices, &corrections);
        assert_eq!(keys(&other), ["side 6", "throat 5", "mouth 2"]);
        assert!(other.as_phones && other.input.starts_with("l a m e"), "{}", other.input);
        assert!(other.keys[1].other.is_some(), "a click takes it back");
        assert!(!read_cued_text("ma maison la", &choices, &corrections).words[2].corrected);
        assert!(read_cued_text("", &choices, &corrections).keys.is_empty());
        let long = "é".repeat(10_000);
        assert!(read_cued_text(&long, &choices, &corrections).input.len() <= MAX_CUED_TEXT_BYTES);
    }

    #[test]
    fn english_text_is_read_as_phones() {
        let english = CueChoices {
            code: 1,
            ..CueChoices::default()
        };
        let reading = read_cued_text("k { t", &english, &PhoneCorrections::new());
        assert!(reading.as_phones);
        assert_eq!(keys(&reading), ["throat 2", "side 5"]);
        assert!(
            !read_cued_text("k ?? t", &english, &PhoneCorrections::new())
                .findings
                .is_empty()
        );
    }

    #[test]
    fn every_word_of_practice_has_keys_and_differs_from_its_neighbours() {
        for code in 0..all_cue_codes().len() {
            let choices = CueChoices {
                code,
                ..CueChoices::default()
            };
            for set in practice_sets(&choices) {
                let all: Vec<Vec<String>> = set
                    .iter()
                    .map(|item| keys(&read_cued_text(&item.input, &choices, &PhoneCorrections::new())))
                    .collect();
                let different: std::collections::BTreeSet<_> = all.iter().collect();
                assert_eq!(different.len(), set.len(), "{set:?} {all:?}");
            }
        }
    }

    #[test]
    fn keys_to_practise_differ_by_shape_or_by_placement() {
        for code in 0..all_cue_codes().len() {
            let choices = CueChoices {
                code,
                ..CueChoices::default()
            };
            let names = |set: &[PracticeItem]| -> std::collections::BTreeSet<String> {
                set.iter().map(|item| item.word.clone()).collect()
            };
            let [(_, shapes), (_, places)] = key_sets(&choices, InterfaceLanguage::English);
            assert_eq!(names(&shapes).len(), 8, "{code}: {shapes:?}");
            assert_eq!(names(&places).len(), 5, "{code}: {places:?}");
            assert!(places.iter().all(|item| item.word.ends_with(" 5")));
        }
    }

    #[test]
    fn an_exercise_counts_only_the_first_answer() {
        let items = own_set("papa, maman; bébé").expect("three words");
        let mut exercise = CueExercise::from_practice_items(items, 5);
        for _ in 0..20 {
            let wrong = (exercise.now + 1) % 3;
            exercise.record_answer(exercise.now);
            exercise.record_answer(wrong);
            exercise.next();
        }
        assert_eq!((exercise.right, exercise.all), (20, 20));
        assert!(own_set("papa").is_none() && own_set(" , ,").is_none());
    }
}
