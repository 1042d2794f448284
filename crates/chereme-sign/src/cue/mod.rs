//! Cued speech: the keys that a hand shows beside the face while a person speaks.
//!
//! A [`CueCode`] lists the consonants of each handshape and the vowels of each placement. [`CueCode::phones_to_keys`] turns
//! phones into keys; [`french`] turns French text into phones. Codes are data under `schema/cues`.
//!
//! Keys follow Gibert et al. (2004): from the left, a consonant and the vowel after it share one key;
//! a vowel without a consonant takes the shape of [`CueCode::vowel_alone`], a consonant without a
//! vowel the placement of [`CueCode::consonant_alone`]. A pause breaks such pairs; syllables and words
//! do not.

mod cue_code;
mod cue_dictionary;
mod cue_names;
mod cue_numbers;
mod espeak;
pub mod french;
#[cfg(test)]
mod tests;
mod utterance;
mod written;

pub use cue_dictionary::{DictionaryError, PronunciationDictionary};
pub use cue_names::{gloss_cue_key, key_of_label, of_gloss, placement_number, placement_of_number, sppas_key_labels};
pub use espeak::of_espeak;
pub use utterance::{CuedUtterance, TimedText, UtteranceError, UtteranceReading};

pub use cue_code::{
    CueCode, CuePlacement, CueShape, CueVariant, PhoneAlphabet, UnknownVariant, all_cue_codes, find_cue_code,
};

use std::ops::Range;

use chereme_motion::TimeSpan;

/// One phone of an utterance, as its source wrote it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpokenPhone {
    /// The symbol, in the alphabet of the source.
    pub label: String,
    /// The time of the phone, if the source gives it.
    pub span: Option<TimeSpan>,
}

impl SpokenPhone {
    /// Returns a phone without times.
    #[must_use]
    pub fn new(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            span: None,
        }
    }
}

/// One key: a handshape at a placement, for a consonant, a vowel, or both.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HandCueKey {
    /// The number of the handshape.
    pub shape: u8,
    /// The name of the placement, such as `mouth`.
    pub placement: String,
    /// The phones of the key in the code's own symbols, a consonant before a vowel.
    pub phones: Vec<String>,
    /// The positions of those phones in the input.
    pub from: Vec<usize>,
    /// The span from the start of the first phone to the end of the last, if both are known.
    pub span: Option<TimeSpan>,
    /// The span of the vowel, for a key of a consonant and a vowel with times.
    pub vowel: Option<TimeSpan>,
    /// The placement that the key would have with the other pronunciation of an uncertain vowel.
    pub or_at: Option<String>,
}

/// An oddity of phones that did not prevent reading them.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CueFinding {
    /// A symbol that the code does not know; it has no key.
    #[error("phone {position} \"{label}\" is not in the code {code:?}; it has no key")]
    UnknownPhone {
        /// The position in the input, from 1.
        position: usize,
        /// The symbol.
        label: String,
        /// The code.
        code: String,
    },
    /// Two phones that overlap in time or stand in the wrong order.
    #[error("phone {position} \"{label}\" begins before the phone before it ends")]
    Overlap {
        /// The position in the input, from 1.
        position: usize,
        /// The symbol.
        label: String,
    },
    /// A letter that no rule of pronunciation knows.
    #[error("{letter:?} in {word:?} is silent: no rule of pronunciation knows it")]
    UnknownLetter {
        /// The letter.
        letter: char,
        /// The word that holds it.
        word: String,
    },
    /// The code has a part that was not compared with its source.
    #[error("{caution}")]
    Unchecked {
        /// The part and the remedy.
        caution: String,
    },
    /// A word that is said in two ways, which spelling does not distinguish.
    #[error("{word:?} is said {said}, or {other}: to choose, write {choice}")]
    TwoReadings {
        /// The word.
        word: String,
        /// The phones that were taken.
        said: String,
        /// The other phones.
        other: String,
        /// The word with its other phones, as a text has them.
        choice: String,
    },
    /// A word that is in no dictionary, of a language without rules of spelling.
    #[error("the word {word:?} is not in the dictionary; it was left out")]
    NotInDictionary {
        /// The word.
        word: String,
    },
    /// A number or another sign that the pronunciation rules cannot read.
    #[error("{text:?} was left out; write it in words")]
    NotAWord {
        /// The sign.
        text: String,
    },
}

/// The role of a phone in a code: consonant, vowel or pause.
enum CueSound {
    Consonant(u8),
    /// The placements that a vowel passes; a diphthong has two.
    Vowel(Vec<String>),
    Pause,
}

/// A phone in the code's own symbols, with its position in the input.
struct TranslatedPhone {
    symbol: String,
    at: usize,
    sound: CueSound,
}

impl CueCode {
    /// Returns the keys of phones written in `alphabet`, and the phones that have no key.
    #[must_use]
    pub fn phones_to_keys(
        &self,
        phones: &[SpokenPhone],
        alphabet: PhoneAlphabet,
    ) -> (Vec<HandCueKey>, Vec<CueFinding>) {
        let (heard, mut findings) = self.translate_phones(phones, alphabet);
        if let Some(caution) = self.unchecked.clone().filter(|_| !phones.is_empty()) {
            findings.push(CueFinding::Unchecked { caution });
        }
        let mut keys = Vec::new();
        let mut position = 0;
        while let Some(first) = heard.get(position) {
            position += 1;
            match &first.sound {
                CueSound::Pause => {}
                CueSound::Vowel(_) => self.vowel_keys(self.vowel_alone, &heard, position - 1..position, &mut keys),
                CueSound::Consonant(shape) => match heard.get(position) {
                    // A consonant and the vowel after it are one key: its shape by the one, its placement by the
                    // other.
                    Some(next) if matches!(next.sound, CueSound::Vowel(_)) => {
                        position += 1;
                        self.vowel_keys(*shape, &heard, position - 2..position, &mut keys);
                    }
                    _ => keys.push(build_cue_key(
                        *shape,
                        &self.consonant_alone,
                        &heard[position - 1..position],
                    )),
                },
            }
        }
        for key in &mut keys {
            self.set_times(key, phones);
        }
        (keys, findings)
    }

    /// Adds the keys of `sounds`, whose last one is a vowel: two keys for a diphthong.
    fn vowel_keys(&self, shape: u8, heard: &[TranslatedPhone], sounds: Range<usize>, keys: &mut Vec<HandCueKey>) {
        let end = sounds.end;
        let sounds = &heard[sounds];
        let Some(TranslatedPhone {
            symbol,
            sound: CueSound::Vowel(path),
            ..
        }) = sounds.last()
        else {
            return;
        };
        let is_last = heard.get(end).is_none_or(|next| matches!(next.sound, CueSound::Pause));
        let moved = self.final_placements.get(symbol).filter(|_| is_last);
        let Some((first, rest)) = path.split_first() else {
            return;
        };
        keys.push(build_cue_key(shape, moved.unwrap_or(first), sounds));
        for place in rest {
            keys.push(build_cue_key(self.vowel_alone, place, &sounds[sounds.len() - 1..]));
        }
    }

    /// Translates phones into the code's symbols.
    fn translate_phones(
        &self,
        phones: &[SpokenPhone],
        alphabet: PhoneAlphabet,
    ) -> (Vec<TranslatedPhone>, Vec<CueFinding>) {
        let (mut heard, mut findings) = (Vec::with_capacity(phones.len()), Vec::new());
        let mut end = None;
        for (at, phone) in phones.iter().enumerate() {
            if let Some(span) = phone.span {
                if end.is_some_and(|end| span.span_start_instant() < end) {
                    findings.push(CueFinding::Overlap {
                        position: at + 1,
                        label: phone.label.clone(),
                    });
                }
                // Only neighbours are compared, as phones are in order.
                end = Some(span.span_end_instant());
            }
            match self.sampa_symbols(&phone.label, alphabet) {
                Some(symbols) => {
                    for symbol in symbols {
                        if let Some(sound) = self.find_symbol_sound(&symbol) {
                            heard.push(TranslatedPhone { symbol, at, sound });
                        }
                    }
                }
                None => {
                    findings.push(CueFinding::UnknownPhone {
                        position: at + 1,
                        label: phone.label.clone(),
                        code: self.id.clone(),
                    });
                    heard.push(TranslatedPhone {
                        // The sounds around an unknown one must not become one key.
                        symbol: "#".to_owned(),
                        at,
                        sound: CueSound::Pause,
                    });
                }
            }
        }
        (heard, findings)
    }

    fn find_symbol_sound(&self, symbol: &str) -> Option<CueSound> {
        if self.is_pause(symbol) {
            return Some(CueSound::Pause);
        }
        if let Some(shape) = self.shape_of(symbol) {
            return Some(CueSound::Consonant(shape.number));
        }
        self.path_of(symbol).map(CueSound::Vowel)
    }

    /// Gives a key its span, and the vowel's own.
    fn set_times(&self, key: &mut HandCueKey, phones: &[SpokenPhone]) {
        let spans: Vec<TimeSpan> = key.from.iter().filter_map(|at| phones.get(*at)?.span).collect();
        if spans.len() != key.from.len() {
            return;
        }
        let (Some(first), Some(last)) = (spans.first(), spans.last()) else {
            return;
        };
        if first.span_start_instant() > last.span_end_instant() {
            return;
        }
        key.span = Some(TimeSpan::span_between(
            first.span_start_instant(),
            last.span_end_instant(),
        ));
        key.vowel = key
            .phones
            .last()
            .is_some_and(|symbol| self.shape_of(symbol).is_none())
            .then_some(*last);
    }
}

fn build_cue_key(shape: u8, placement: &str, heard: &[TranslatedPhone]) -> HandCueKey {
    HandCueKey {
        shape,
        placement: placement.to_owned(),
        phones: heard.iter().map(|phone| phone.symbol.clone()).collect(),
        from: heard.iter().map(|phone| phone.at).collect(),
        span: None,
        vowel: None,
        or_at: None,
    }
}
