//! The content of the pane of cued speech, without a window: words, keys, corrections and exercises.

use std::collections::BTreeMap;

use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{CueOptions, CueSlip, KeysOptions, SlipKind};
use chereme_sign::cue::french::{self, Schwa};
use chereme_sign::cue::{Alphabet, Phone, Utterance, codes};

use crate::words::{Language, Text, cue as words, fill};

/// The longest text, in bytes, that is analysed while it is typed.
const MOST_BYTES: usize = 4000;

/// The settings for cueing a text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Choices {
    /// Index of the code among the program's codes.
    pub(super) code: usize,
    pub(super) liaison: bool,
    /// Whether every e at the end of a word is pronounced.
    pub(super) schwa: bool,
    pub(super) rule: PhaseRule,
    pub(super) pace: f64,
    pub(super) left: bool,
}

impl Default for Choices {
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

impl Choices {
    /// Returns whether the code has spelling rules, so that text can be typed; other codes take phones.
    pub(super) fn spells(&self) -> bool {
        codes()
            .get(self.code)
            .is_some_and(|code| code.language == "fr")
    }

    fn french(&self) -> french::Options {
        french::Options {
            liaison: self.liaison,
            schwa: if self.schwa {
                Schwa::Said
            } else {
                Schwa::Usual
            },
        }
    }

    /// Returns the library's options for the input of a reading.
    pub(super) fn options(&self, reading: &Reading) -> CueOptions {
        let code = codes()
            .get(self.code)
            .map_or("french", |code| code.id.as_str());
        CueOptions {
            reading: KeysOptions {
                code: code.to_owned(),
                phones: reading.as_phones.then_some(Alphabet::Sampa),
                variants: Vec::new(),
                french: self.french(),
                pace: Some(self.pace),
            },
            signer: None,
            phase: self.rule,
            left: self.left,
        }
    }
}

/// A word with its phones; a pause has no text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Word {
    pub(super) text: String,
    pub(super) phones: Vec<String>,
    /// Whether the user changed its phones.
    pub(super) corrected: bool,
}

/// A key, and the phones that it represents.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Key {
    pub(super) placement: String,
    pub(super) shape: u8,
    pub(super) phones: String,
    /// Another common vowel at this place: the index of the word, the index of the phone, the vowel, and its placement.
    pub(super) other: Option<(usize, usize, String, String)>,
}

/// The analysis of a text.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Reading {
    pub(super) words: Vec<Word>,
    pub(super) keys: Vec<Key>,
    pub(super) findings: Vec<String>,
    /// The text, or the phones if the user corrected some.
    pub(super) input: String,
    pub(super) as_phones: bool,
}

/// The user's corrections of phones, by the index and the letters of the word.
pub(super) type Corrections = BTreeMap<(usize, String), Vec<String>>;

/// Analyses a text with the corrections that still match its words.
pub(super) fn read(text: &str, choices: &Choices, corrections: &Corrections) -> Reading {
    let Some(code) = codes().get(choices.code) else {
        return Reading::default();
    };
    let end = (0..=MOST_BYTES.min(text.len()))
        .rev()
        .find(|at| text.is_char_boundary(*at));
    let text = &text[..end.unwrap_or(0)];
    let mut reading = Reading::default();
    let mut doubtful: Vec<Vec<usize>> = Vec::new();
    if choices.spells() {
        let spoken = french::phones(text, choices.french());
        reading
            .findings
            .extend(spoken.findings.iter().map(ToString::to_string));
        for (at, word) in spoken.words.into_iter().enumerate() {
            let corrected = corrections.get(&(at, word.text.clone()));
            doubtful.push(word.doubtful);
            reading.words.push(Word {
                phones: corrected.cloned().unwrap_or(word.phones),
                corrected: corrected.is_some(),
                text: word.text,
            });
        }
    } else {
        let phones = text.split_whitespace().map(str::to_owned).collect();
        reading.words.push(Word {
            text: String::new(),
            phones,
            corrected: false,
        });
        doubtful.push(Vec::new());
    }
    let corrected = reading.words.iter().any(|word| word.corrected);
    reading.as_phones = corrected || !choices.spells();
    let places: Vec<(usize, usize)> = reading
        .words
        .iter()
        .enumerate()
        .flat_map(|(word, own)| (0..own.phones.len()).map(move |at| (word, at)))
        .collect();
    let phones: Vec<Phone> = places
        .iter()
        .map(|(word, at)| Phone::new(reading.words[*word].phones[*at].clone()))
        .collect();
    reading.input = if reading.as_phones {
        let labels: Vec<&str> = phones.iter().map(|phone| phone.label.as_str()).collect();
        labels.join(" ")
    } else {
        text.trim().to_owned()
    };
    let read = Utterance::of_phones(code.clone(), phones, Alphabet::Sampa);
    reading
        .findings
        .extend(read.findings.iter().map(ToString::to_string));
    for key in &read.keys {
        let vowel = key.from.last().and_then(|at| places.get(*at)).copied();
        let other = vowel.and_then(|(word, at)| {
            let own = key.phones.last()?;
            let uncertain = doubtful[word].contains(&at) || reading.words[word].corrected;
            let pair = code
                .doubtful
                .iter()
                .find(|pair| uncertain && pair.contains(own))?;
            let other = pair.iter().find(|it| *it != own)?;
            let place = code.path_of(other)?.into_iter().next()?;
            (place != key.placement).then(|| (word, at, other.clone(), place))
        });
        reading.keys.push(Key {
            placement: key.placement.clone(),
            shape: key.shape,
            phones: key.phones.join(" "),
            other,
        });
    }
    reading
}

/// Returns the name of a placement in a language; names of other codes stay as they are.
pub(super) fn placement(id: &str, language: Language) -> String {
    let text: Option<Text> = match id {
        "side" => Some(words::AT_SIDE),
        "mouth" => Some(words::AT_MOUTH),
        "chin" => Some(words::AT_CHIN),
        "cheek" => Some(words::AT_CHEEK),
        "throat" => Some(words::AT_THROAT),
        "side-forward" => Some(words::AT_SIDE_FORWARD),
        "side-down" => Some(words::AT_SIDE_DOWN),
        _ => None,
    };
    text.map_or_else(|| id.to_owned(), |text| text.of(language).to_owned())
}

/// Returns the spoken name of a key: its placement and the number of its handshape.
pub(super) fn key_name(placement_id: &str, shape: u8, language: Language) -> String {
    format!("{} {shape}", placement(placement_id, language))
}

/// A word to practise: its letters, and the input to cue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Item {
    pub(super) word: String,
    pub(super) input: String,
}

/// Words that look alike on the lips, for each code: by text in French, by phones in English.
const FRENCH: [&[&str]; 9] = [
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
const ENGLISH: [&[(&str, &str)]; 4] = [
    &[("pat", "p { t"), ("bat", "b { t"), ("mat", "m { t")],
    &[("fan", "f { n"), ("van", "v { n")],
    &[("ten", "t E n"), ("den", "d E n")],
    &[("pea", "p i:"), ("bee", "b i:"), ("me", "m i:")],
];

/// Returns the sets of words that a code offers for practice.
pub(super) fn sets(choices: &Choices) -> Vec<Vec<Item>> {
    let item = |word: &str, input: &str| Item {
        word: word.to_owned(),
        input: input.to_owned(),
    };
    if choices.spells() {
        let set = |set: &&[&str]| set.iter().map(|word| item(word, word)).collect();
        FRENCH.iter().map(set).collect()
    } else {
        let set = |set: &&[(&str, &str)]| {
            set.iter()
                .map(|(word, phones)| item(word, phones))
                .collect()
        };
        ENGLISH.iter().map(set).collect()
    }
}

/// Syllables with different handshapes at one place, and syllables with one handshape at different places.
const FRENCH_KEYS: [&[&str]; 2] = [
    &["pa", "ca", "sa", "ba", "ta", "la", "ga", "ya"],
    &["ta", "ti", "tou", "tain", "té"],
];
const ENGLISH_KEYS: [&[&str]; 2] = [
    &[
        "p A:", "k A:", "s A:", "b A:", "t A:", "l A:", "g A:", "j A:",
    ],
    &["t i:", "t E", "t I", "t A:", "t V"],
];

/// Returns the keys that a code offers for practice, by handshape and by placement; each has the name of its key.
pub(super) fn key_sets(choices: &Choices, language: Language) -> [(Text, Vec<Item>); 2] {
    let [shapes, places] = match choices.spells() {
        true => FRENCH_KEYS,
        false => ENGLISH_KEYS,
    };
    let item = |input: &&str| {
        let keys = read(input, choices, &Corrections::new()).keys;
        let [key] = keys.as_slice() else {
            return None;
        };
        Some(Item {
            word: key_name(&key.placement, key.shape, language),
            input: (*input).to_owned(),
        })
    };
    let set = |inputs: &[&str]| inputs.iter().filter_map(item).collect();
    [(words::SHAPES, set(shapes)), (words::PLACES, set(places))]
}

/// Returns the first twelve words of the user's own set, separated by commas; `None` for fewer than two words.
pub(super) fn own_set(text: &str) -> Option<Vec<Item>> {
    let words = text
        .split([',', ';', '\n'])
        .map(str::trim)
        .filter(|word| !word.is_empty());
    let items: Vec<Item> = words
        .take(12)
        .map(|word| Item {
            word: word.to_owned(),
            input: word.to_owned(),
        })
        .collect();
    (items.len() > 1).then_some(items)
}

/// An exercise: the words, the cued one, and the score.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Exercise {
    pub(super) items: Vec<Item>,
    pub(super) now: usize,
    /// The index of the answer to the present word, if given.
    pub(super) answered: Option<usize>,
    pub(super) revealed: bool,
    pub(super) right: u32,
    pub(super) all: u32,
    /// State of the random numbers, which continues from word to word.
    seed: u64,
}

impl Exercise {
    /// Begins with a set of words; `seed` decides their order.
    pub(super) fn of(items: Vec<Item>, seed: u64) -> Self {
        let mut own = Self {
            items,
            seed,
            ..Self::default()
        };
        own.next();
        own
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
    pub(super) fn answer(&mut self, item: usize) {
        if self.answered.is_some() || self.revealed {
            return;
        }
        self.answered = Some(item);
        self.all += 1;
        self.right += u32::from(item == self.now);
    }

    /// Returns the word that is being cued.
    pub(super) fn item(&self) -> Option<&Item> {
        self.items.get(self.now)
    }
}

/// Returns the description of a slip, and its time in microseconds.
pub(super) fn slip(slip: &CueSlip, language: Language) -> (String, Option<i64>) {
    let time = slip
        .at_us
        .map_or_else(|| "?".to_owned(), |at| format!("{:.2}", at as f64 / 1e6));
    let named = |key: &Option<String>| {
        let key = key.as_deref().unwrap_or_default();
        match key.rsplit_once('-') {
            Some((place, shape)) => format!("{} {shape}", placement(place, language)),
            None => key.to_owned(),
        }
    };
    let (produced, predicted) = (named(&slip.produced), named(&slip.predicted));
    let text = match slip.kind {
        SlipKind::Insertion => fill(
            words::INSERTION.of(language),
            &[("time", &time), ("produced", &produced)],
        ),
        SlipKind::Deletion => fill(
            words::DELETION.of(language),
            &[("time", &time), ("predicted", &predicted)],
        ),
        _ => {
            let values: [(&str, &dyn std::fmt::Display); 3] = [
                ("time", &time),
                ("produced", &produced),
                ("predicted", &predicted),
            ];
            fill(words::OTHER.of(language), &values)
        }
    };
    (text, slip.at_us)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(reading: &Reading) -> Vec<String> {
        let keys = reading.keys.iter();
        keys.map(|key| key_name(&key.placement, key.shape, Language::English))
            .collect()
    }

    #[test]
    fn a_correction_applies_only_while_its_word_is_in_the_text() {
        let choices = Choices::default();
        let mut corrections = Corrections::new();
        let plain = read("la maison", &choices, &corrections);
        assert_eq!(
            (plain.as_phones, plain.input.as_str()),
            (false, "la maison")
        );
        assert_eq!(keys(&plain), ["side 6", "chin 5", "mouth 2"]);
        let (word, at, vowel, place) = plain.keys[1].other.clone().expect("speakers differ");
        assert_eq!((word, at, place.as_str()), (1, 1, "throat"));
        let mut phones = plain.words[word].phones.clone();
        phones[at] = vowel;
        corrections.insert((word, "maison".to_owned()), phones);
        let other = read("la maison", &choices, &corrections);
        assert_eq!(keys(&other), ["side 6", "throat 5", "mouth 2"]);
        assert!(
            other.as_phones && other.input.starts_with("l a m e"),
            "{}",
            other.input
        );
        assert!(other.keys[1].other.is_some(), "a click takes it back");
        assert!(!read("ma maison la", &choices, &corrections).words[2].corrected);
        assert!(read("", &choices, &corrections).keys.is_empty());
        let long = "é".repeat(10_000);
        assert!(read(&long, &choices, &corrections).input.len() <= MOST_BYTES);
    }

    #[test]
    fn english_text_is_read_as_phones() {
        let english = Choices {
            code: 1,
            ..Choices::default()
        };
        let reading = read("k { t", &english, &Corrections::new());
        assert!(reading.as_phones);
        assert_eq!(keys(&reading), ["throat 2", "side 5"]);
        assert!(
            !read("k ?? t", &english, &Corrections::new())
                .findings
                .is_empty()
        );
    }

    #[test]
    fn every_word_of_practice_has_keys_and_differs_from_its_neighbours() {
        for code in 0..codes().len() {
            let choices = Choices {
                code,
                ..Choices::default()
            };
            for set in sets(&choices) {
                let all: Vec<Vec<String>> = set
                    .iter()
                    .map(|item| keys(&read(&item.input, &choices, &Corrections::new())))
                    .collect();
                let different: std::collections::BTreeSet<_> = all.iter().collect();
                assert_eq!(different.len(), set.len(), "{set:?} {all:?}");
            }
        }
    }

    #[test]
    fn keys_to_practise_differ_by_shape_or_by_placement() {
        for code in 0..codes().len() {
            let choices = Choices {
                code,
                ..Choices::default()
            };
            let names = |set: &[Item]| -> std::collections::BTreeSet<String> {
                set.iter().map(|item| item.word.clone()).collect()
            };
            let [(_, shapes), (_, places)] = key_sets(&choices, Language::English);
            assert_eq!(names(&shapes).len(), 8, "{code}: {shapes:?}");
            assert_eq!(names(&places).len(), 5, "{code}: {places:?}");
            assert!(places.iter().all(|item| item.word.ends_with(" 5")));
        }
    }

    #[test]
    fn an_exercise_counts_only_the_first_answer() {
        let items = own_set("papa, maman; bébé").expect("three words");
        let mut exercise = Exercise::of(items, 5);
        for _ in 0..20 {
            let wrong = (exercise.now + 1) % 3;
            exercise.answer(exercise.now);
            exercise.answer(wrong);
            exercise.next();
        }
        assert_eq!((exercise.right, exercise.all), (20, 20));
        assert!(own_set("papa").is_none() && own_set(" , ,").is_none());
    }
}
