//! French text to phones, by rules of spelling and a list of words (`schema/cues/french-spelling.json`).
//!
//! Liaison and the schwa between words are switches of [`PronunciationOptions`]; uncertain mid vowels are marked.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use regex::Regex;
use serde::Deserialize;

use super::cue_numbers;
use super::written::{WrittenPart, split_written_text};
use super::{CueFinding, PronunciationDictionary};

/// Choices of pronunciation that the spelling leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PronunciationOptions {
    /// Whether a silent last consonant is pronounced before a vowel, as in *les amis*.
    pub liaison: bool,
    /// The condition under which an *e* at the end of a word is pronounced.
    pub schwa: SchwaCondition,
}

impl Default for PronunciationOptions {
    fn default() -> Self {
        Self {
            liaison: true,
            schwa: SchwaCondition::Usual,
        }
    }
}

/// The condition under which an *e* at the end of a word is pronounced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SchwaCondition {
    /// Never.
    Dropped,
    /// Between two consonants such as *tr* and a consonant of the next word, as in *maître corbeau*, and where four
    /// consonants would meet, as in *quelque grain*.
    #[default]
    Usual,
    /// Before every consonant, as in verse.
    Said,
}

/// The pronunciation of a text.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FrenchPronunciation {
    /// The words in the order of the text; pauses are words without letters.
    pub words: Vec<FrenchWord>,
    /// The parts that could not be read.
    pub findings: Vec<CueFinding>,
}

/// A word and its pronunciation.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FrenchWord {
    /// The letters as written, in lower case; empty for a pause.
    pub text: String,
    /// The phones in SAMPA; `#` for a pause.
    pub phones: Vec<String>,
    /// The positions in `phones` of phones that speakers pronounce in two ways: mid vowels before the last syllable.
    pub doubtful: Vec<usize>,
    /// Whether a hyphen joins it to the word before, as in *dit-elle*.
    pub hyphened: bool,
    /// Whether the text itself states its phones, as in `fils{f i l}`.
    pub is_chosen: bool,
}

impl FrenchPronunciation {
    /// Returns the phones of all words.
    pub fn spoken_phones(&self) -> impl Iterator<Item = &str> {
        self.words
            .iter()
            .flat_map(|word| word.phones.iter().map(String::as_str))
    }
}

/// The words that stand between a subject and its verb.
const VERB_PRONOUNS: [&str; 18] = [
    "ne", "n'", "se", "s'", "me", "m'", "te", "t'", "le", "la", "les", "l'", "lui", "leur", "y", "en", "nous", "vous",
];

impl FrenchWord {
    /// Returns a word with these phones.
    pub(super) fn said_word(text: &str, phones: Vec<String>) -> Self {
        Self {
            text: text.to_owned(),
            phones,
            ..Self::default()
        }
    }
}

/// Returns the pronunciation of French `text`.
#[must_use]
pub fn pronounce_french_text(text: &str, options: PronunciationOptions) -> FrenchPronunciation {
    pronounce_with_dictionary(text, options, None)
}

/// Returns the pronunciation of French `text`; words of the dictionary are said as it says.
#[must_use]
pub fn pronounce_with_dictionary(
    text: &str,
    options: PronunciationOptions,
    dictionary: Option<&PronunciationDictionary>,
) -> FrenchPronunciation {
    let rules = &*FRENCH_SPELLING_RULES;
    let mut spoken = FrenchPronunciation::default();
    for written in split_written_text(text) {
        match written {
            WrittenPart::Pause => spoken.words.push(FrenchWord {
                phones: vec!["#".to_owned()],
                ..FrenchWord::default()
            }),
            WrittenPart::Word(text, hyphened) => {
                let listed = dictionary.and_then(|dictionary| dictionary.find_pronunciation(&text));
                let word = match listed {
                    Some(phones) => FrenchWord::said_word(&text, phones.to_vec()),
                    None => rules.pronounce_french_word(text, &mut spoken.findings),
                };
                spoken.words.push(FrenchWord { hyphened, ..word });
            }
            WrittenPart::Phones(phones, true) if spoken.words.last().is_some_and(|word| !word.text.is_empty()) => {
                if let Some(word) = spoken.words.last_mut() {
                    word.is_chosen = true;
                    (word.phones, word.doubtful) = (phones, Vec::new());
                }
            }
            WrittenPart::Phones(phones, _) => {
                let word = FrenchWord::said_word(&phones.join(" "), phones);
                spoken.words.push(FrenchWord {
                    is_chosen: true,
                    ..word
                });
            }
            WrittenPart::Letters(text) => spoken.words.push(rules.spelled(text)),
            WrittenPart::Acronym(text) => spoken.words.push(rules.acronym(text)),
            WrittenPart::Other(text) => spoken.findings.push(CueFinding::NotAWord { text }),
        }
    }
    rules.follow_subjects(&mut spoken.words);
    rules.report_two_readings(&mut spoken);
    for at in 1..spoken.words.len() {
        let (before, after) = spoken.words.split_at_mut(at);
        let (earlier, word) = before.split_at_mut(at - 1);
        let (word, next) = (&mut word[0], &after[0]);
        // Numbers come first: their words break the rules by which other words are joined.
        let settled = cue_numbers::join_number_word(earlier.last(), word, next, rules.begins_with_vowel(next));
        if !settled {
            rules.join_next_word(word, next, options);
        }
    }
    spoken
}

struct SpellingRule {
    left: Regex,
    letters: String,
    right: Regex,
    phones: Vec<String>,
    verb_ending: bool,
}

/// The file `cues/french-spelling.json`, and what is looked up in it by another key.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpellingRules {
    #[serde(rename = "about")]
    _about: String,
    pub(super) vowels: String,
    consonants: String,
    nasal_ent: String,
    #[serde(rename = "er_is_ER")]
    er_is_said: BTreeSet<String>,
    elided: BTreeMap<String, String>,
    pub(super) words: BTreeMap<String, String>,
    /// Words by the consonant that links them to the next word.
    liaison: BTreeMap<String, Vec<String>>,
    /// Endings of verbs by the linking consonant that they have.
    linked_endings: BTreeMap<String, Vec<String>>,
    /// Words with such an ending that are not verbs.
    never_linked: BTreeSet<String>,
    /// The other pronunciation of words that are said in two ways.
    homographs: BTreeMap<String, String>,
    /// The pronunciation of adjectives that changes before a vowel, such as *bon* and *premier*.
    before_vowels: BTreeMap<String, String>,
    aspirated_h: BTreeSet<String>,
    /// The beginnings of words whose first letter is such an *h*.
    aspirated_stems: Vec<String>,
    /// The names of letters.
    letters: BTreeMap<char, String>,
    /// Words in capitals that are spelled although they have vowels, such as *EDF*.
    pub(super) spelled: BTreeSet<String>,
    /// Words in capitals whose pronunciation the rules of spelling do not give, such as *ENA*.
    pub(super) acronyms: BTreeMap<String, String>,
    /// Words of two letters, which are said as words in capitals, too.
    pub(super) short_words: BTreeSet<String>,
    /// The consonants with which a word can begin, if they are several.
    pub(super) beginnings: BTreeSet<String>,
    /// The pairs of consonants with which a word can end.
    pub(super) ending_pairs: BTreeSet<String>,
    /// The months in their order.
    pub(super) months: Vec<String>,
    /// Signs and short forms behind a number, and the words that they stand for.
    pub(super) units: BTreeMap<String, String>,
    /// Signs that are said as words anywhere.
    pub(super) symbols: BTreeMap<char, String>,
    /// Short forms and the words that they stand for.
    pub(super) abbreviations: BTreeMap<String, String>,
    rules: Vec<Vec<String>>,
    #[serde(skip)]
    nasal_pattern: Option<Regex>,
    /// The consonant that links each word of `liaison`.
    #[serde(skip)]
    linking_sounds: BTreeMap<String, String>,
    /// The rules by their first letter, in the order of the file.
    #[serde(skip)]
    by_letter: BTreeMap<char, Vec<SpellingRule>>,
}

pub(super) static FRENCH_SPELLING_RULES: LazyLock<SpellingRules> = LazyLock::new(|| {
    let text = chereme_data::schema_text("cues/french-spelling.json");
    let file: SpellingRules = serde_json::from_str(text).unwrap_or_default();
    file.with_lookup_tables()
});

impl SpellingRules {
    fn with_lookup_tables(mut self) -> Self {
        for row in &self.rules {
            let Some((rule, first)) = parse_spelling_rule(row, &self) else {
                continue;
            };
            self.by_letter.entry(first).or_default().push(rule);
        }
        for (sound, words) in &self.liaison {
            for word in words {
                self.linking_sounds.insert(word.clone(), sound.clone());
            }
        }
        self.nasal_pattern = Regex::new(&self.nasal_ent).ok();
        self
    }

    fn pronounce_french_word(&self, text: String, findings: &mut Vec<CueFinding>) -> FrenchWord {
        let split = |phones: &str| phones.split_whitespace().map(str::to_owned).collect();
        // *Soeur* and *oeil* are written without a ligature as often as with it.
        let joined = text.replace("oeu", "œu").replace("oeil", "œil");
        // The plural of a word sounds like the word, unless it has a pronunciation of its own.
        let singular = joined.strip_suffix('s').filter(|stem| stem.chars().count() > 2);
        let listed = self.words.get(&text).or_else(|| self.words.get(&joined));
        let listed = listed.or_else(|| self.words.get(singular?));
        let elided = || text.strip_suffix('\'').and_then(|rest| self.elided.get(rest));
        if let Some(phones) = listed.or_else(elided) {
            return FrenchWord::said_word(&text, split(phones));
        }
        let phones = self.apply_spelling_rules(&joined, findings);
        FrenchWord {
            doubtful: doubtful(&phones),
            ..FrenchWord::said_word(&text, phones)
        }
    }

    /// Says a word letter by letter.
    fn spelled(&self, text: String) -> FrenchWord {
        let names = text.chars().filter_map(|letter| self.letters.get(&letter));
        let phones = names.flat_map(|name| name.split_whitespace());
        FrenchWord {
            phones: phones.map(str::to_owned).collect(),
            text,
            ..FrenchWord::default()
        }
    }

    /// Says a word in capitals that has a pronunciation of its own.
    fn acronym(&self, text: String) -> FrenchWord {
        let phones = self.acronyms.get(&text).map_or("", String::as_str);
        FrenchWord {
            phones: phones.split(' ').map(str::to_owned).collect(),
            text,
            ..FrenchWord::default()
        }
    }

    /// Returns whether no word begins or ends with the consonants of this one, so that it must be said letter by
    /// letter, such as *TVA* and *CDI*.
    pub(super) fn is_unpronounceable(&self, word: &str) -> bool {
        let is_consonant = |letter: &char| !self.vowels.contains(*letter);
        let begins: String = word.chars().take_while(is_consonant).collect();
        let mut ends: Vec<char> = word.chars().rev().take_while(is_consonant).collect();
        ends.reverse();
        let long = begins.chars().count() > 1;
        let pair = |pair: &[char]| self.ending_pairs.contains(&pair.iter().collect::<String>());
        (long && !self.beginnings.contains(&begins)) || !ends.windows(2).all(pair)
    }

    /// Applies the rules to a word from left to right.
    fn apply_spelling_rules(&self, word: &str, findings: &mut Vec<CueFinding>) -> Vec<String> {
        let marked = format!("#{word}#");
        let mut phones: Vec<String> = Vec::new();
        let mut letter_start = 1;
        while let Some(letter) = marked[letter_start..].chars().next() {
            // The closing mark is there for rules about ends of words, and is no letter itself.
            if letter_start + 1 == marked.len() {
                break;
            }
            let (left, rest) = marked.split_at(letter_start);
            let fits = |rule: &&SpellingRule| {
                rest.strip_prefix(rule.letters.as_str())
                    .is_some_and(|right| rule.left.is_match(left) && rule.right.is_match(right))
            };
            let of_letter = self.by_letter.get(&letter);
            let Some(rule) = of_letter.and_then(|rules| rules.iter().find(fits)) else {
                // An apostrophe only parts words; a letter is silent if it has rules and no rule fits.
                if of_letter.is_none() && letter != '\'' {
                    findings.push(CueFinding::UnknownLetter {
                        letter,
                        word: word.to_owned(),
                    });
                }
                letter_start += letter.len_utf8();
                continue;
            };
            letter_start += rule.letters.len();
            let is_nasal = self
                .nasal_pattern
                .as_ref()
                .is_some_and(|pattern| pattern.is_match(word));
            if rule.verb_ending && is_nasal {
                phones.push("A~".to_owned());
            } else {
                phones.extend(rule.phones.iter().cloned());
            }
        }
        // Few words sound their final r, such as *mer* and *hiver*; the rules give all others the ending of verbs.
        let singular = word.strip_suffix('s').unwrap_or(word);
        if singular.ends_with("er") && [word, singular].iter().any(|form| self.er_is_said.contains(*form)) {
            phones.pop();
            phones.extend(["E".to_owned(), "R".to_owned()]);
        }
        // At the end of a word o is always closed: *numéro*, *trop*.
        if let Some(last) = phones.last_mut().filter(|last| *last == "O") {
            "o".clone_into(last);
        }
        phones
    }

    /// Says words as verbs that also are nouns or adjectives, if their subject stands before them: *ils content*, *nous
    /// portions*.
    fn follow_subjects(&self, words: &mut [FrenchWord]) {
        for at in 1..words.len() {
            let (before, word) = words.split_at_mut(at);
            let word = &mut word[0];
            let near_words = before.iter().rev();
            // Pronouns may stand between subject and verb: *ils nous le content*.
            let mut near = near_words.take_while(|neighbour| {
                let text = neighbour.text.as_str();
                VERB_PRONOUNS.contains(&text) || ["ils", "elles"].contains(&text)
            });
            let mut is_subject =
                |names: &[&str]| near.any(|neighbour| !neighbour.hyphened && names.contains(&neighbour.text.as_str()));
            let ends = |phones: &[&str]| {
                word.phones
                    .ends_with(&phones.iter().map(|phone| (*phone).to_owned()).collect::<Vec<_>>())
            };
            if let Some(stem) = word.text.strip_suffix("nt")
                && stem.ends_with('e')
                // Words in -ment may be adverbs, as in *elles seulement*, and keep their nasal vowel.
                && !stem.ends_with("me")
                && ends(&["A~"])
                && is_subject(&["ils", "elles"])
            {
                word.phones = self.apply_spelling_rules(stem, &mut Vec::new());
                word.doubtful = doubtful(&word.phones);
            } else if word.text.ends_with("tions") && ends(&["s", "j", "O~"]) && is_subject(&["nous"]) {
                let phone_index = word.phones.len() - 3;
                "t".clone_into(&mut word.phones[phone_index]);
            }
        }
    }

    /// Reports words that are said in two ways, each once, unless the text states their phones.
    fn report_two_readings(&self, spoken: &mut FrenchPronunciation) {
        let mut reported = BTreeSet::new();
        for word in spoken.words.iter().filter(|word| !word.is_chosen) {
            let Some(listed) = self.homographs.get(&word.text) else {
                continue;
            };
            let said = word.phones.join(" ");
            // The verb after its subject is said as the list says; then the noun is the other reading.
            let other = match *listed == said {
                true => self.words.get(&word.text).cloned(),
                false => Some(listed.clone()),
            };
            if let Some(other) = other.filter(|other| *other != said)
                && reported.insert(&word.text)
            {
                spoken.findings.push(CueFinding::TwoReadings {
                    word: word.text.clone(),
                    choice: format!("{}{{{other}}}", word.text),
                    said,
                    other,
                });
            }
        }
    }

    /// Adds to a word the sound that the next word requires: a linking consonant, or a schwa.
    fn join_next_word(&self, word: &mut FrenchWord, next: &FrenchWord, options: PronunciationOptions) {
        if next.text.is_empty() || word.text.is_empty() || word.is_chosen {
            return;
        }
        if self.begins_with_vowel(next) {
            if !options.liaison {
                return;
            }
            // *Bon ami*, but not *bon et*.
            let apart = ["et", "ou", "est", "a", "à", "en"].contains(&next.text.as_str());
            if let Some(phones) = self.before_vowels.get(&word.text) {
                if apart {
                    return;
                }
                word.phones = phones.split(' ').map(str::to_owned).collect();
            }
            if let Some(sound) = self.linking(word, next) {
                if sound == "z" && word.phones.last().is_some_and(|last| last == "s") {
                    word.phones.pop();
                }
                if word.phones.last().map(String::as_str) != Some(sound) {
                    word.phones.push(sound.to_owned());
                }
            }
            return;
        }
        let silent_e = word.text.ends_with('e') || word.text.ends_with("es");
        let mut last = word.phones.iter().rev();
        let (Some(end), Some(before)) = (last.next(), last.next()) else {
            return;
        };
        let is_vowel = |phone: &str| "aAeEiouOyYU29@".contains(&phone[..1]);
        let cluster =
            ["l", "R"].contains(&end.as_str()) && ["p", "b", "t", "d", "k", "g", "f", "v"].contains(&before.as_str());
        let says = match options.schwa {
            SchwaCondition::Dropped => false,
            SchwaCondition::Usual => {
                let mut first = next.phones.iter().take(2);
                let two = first.len() == 2 && first.all(|phone| !is_vowel(phone));
                cluster || (two && !is_vowel(end) && !is_vowel(before))
            }
            SchwaCondition::Said => true,
        };
        if silent_e && says && !is_vowel(end) {
            word.phones.push("@".to_owned());
        }
    }

    /// Returns the consonant that links a word to the next, which begins with a vowel: from the lists, else that of a
    /// verb before its pronoun (*dit-elle*, *allez-y*), or that of a verb's ending (*tenait en*).
    fn linking(&self, word: &FrenchWord, next: &FrenchWord) -> Option<&str> {
        let text = word.text.as_str();
        if next.hyphened {
            let ends = |letters: &[char]| text.ends_with(letters);
            match next.text.as_str() {
                "il" | "elle" | "on" | "ils" | "elles" if ends(&['t', 'd']) => return Some("t"),
                "y" | "en" if ends(&['s', 'z']) => return Some("z"),
                // *Arcs-en-ciel* and *pieds-à-terre* do not link; *États-Unis*, *Champs-Élysées* and *vis-à-vis* do.
                "en" | "et" | "à" | "a" | "au" if text != "vis" => {}
                _ if ends(&['s', 'x']) => return Some("z"),
                _ => {}
            }
        }
        // A pronoun after its verb does not link to what follows: *faisiez-vous au*.
        let is_subject = matches!(text, "nous" | "vous" | "ils" | "elles" | "on");
        if word.hyphened && is_subject && !next.hyphened {
            return None;
        }
        if let Some(sound) = self.linking_sounds.get(text) {
            return Some(sound);
        }
        if self.never_linked.contains(text) {
            return None;
        }
        let longer = |ending: &&String| text.len() > ending.len() && text.ends_with(ending.as_str());
        let mut endings = self.linked_endings.iter();
        let matched_ending = endings.find(|(_, endings)| endings.iter().any(|ending| longer(&ending)));
        matched_ending.map(|(sound, _)| sound.as_str())
    }

    fn begins_with_vowel(&self, word: &FrenchWord) -> bool {
        let text = word.text.as_str();
        // The names of *F*, *L*, *M*, *N*, *R*, *S* and *X* begin with a vowel: *un SMS*.
        if text.starts_with(['f', 'l', 'm', 'n', 'r', 's', 'x']) && word.phones == self.spelled(text.to_owned()).phones
        {
            return true;
        }
        let singular = text.strip_suffix(['s', 'x']).unwrap_or(text);
        if [text, singular].iter().any(|stem| self.aspirated_h.contains(*stem))
            || self.aspirated_stems.iter().any(|stem| text.starts_with(stem.as_str()))
        {
            return false;
        }
        let mut letters = word.text.chars();
        match (letters.next(), letters.next()) {
            (Some('h'), _) => true,
            (Some('y'), Some(second)) => !self.vowels.contains(second) || word.text == "yeux",
            (Some(first), _) => self.vowels.contains(first),
            _ => false,
        }
    }
}

/// Reads a row of the file; V and C stand for the letters of the file.
fn parse_spelling_rule(row: &[String], file: &SpellingRules) -> Option<(SpellingRule, char)> {
    let [left, letters, right, phones, ..] = row else {
        return None;
    };
    let expand = |pattern: &str| {
        let mut pattern_text = String::new();
        let mut inside = false;
        for letter in pattern.chars() {
            match letter {
                '[' => inside = true,
                ']' => inside = false,
                _ => {}
            }
            match letter {
                'V' if inside => pattern_text.push_str(&file.vowels),
                'C' if inside => pattern_text.push_str(&file.consonants),
                'V' => pattern_text.push_str(&format!("[{}]", file.vowels)),
                'C' => pattern_text.push_str(&format!("[{}]", file.consonants)),
                '#' => pattern_text.push_str(r"\#"),
                _ => pattern_text.push(letter),
            }
        }
        pattern_text
    };
    let rule = SpellingRule {
        left: Regex::new(&format!("(?:{})$", expand(left))).ok()?,
        right: Regex::new(&format!("^(?:{})", expand(right))).ok()?,
        letters: letters.clone(),
        phones: phones.split_whitespace().map(str::to_owned).collect(),
        verb_ending: row.len() > 4,
    };
    let first = letters.chars().next()?;
    Some((rule, first))
}

/// Returns the positions of mid vowels before the last vowel of a word.
fn doubtful(phones: &[String]) -> Vec<usize> {
    let is_vowel = |phone: &String| {
        let nasal = phone.ends_with('~');
        nasal || ["a", "A", "e", "E", "i", "o", "O", "u", "y", "2", "9", "@"].contains(&phone.as_str())
    };
    let is_mid = |phone: &String| ["e", "E", "o", "O", "2", "9"].contains(&phone.as_str());
    let last = phones.iter().rposition(is_vowel).unwrap_or(0);
    (0..last).filter(|at| is_mid(&phones[*at])).collect()
}
