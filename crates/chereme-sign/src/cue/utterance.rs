//! Utterances to be cued: text or phones, with times and keys.

use crate::ErrorRemedy;
use crate::cue::find_cue_code;
use chereme_motion::{RecordingInstant, TimeSpan};
use std::sync::Arc;

use super::{
    CueCode, CueFinding, HandCueKey, PhoneAlphabet, PronunciationDictionary, SpokenPhone, all_cue_codes, espeak, french,
};

/// The form of an utterance, and the code that cues it.
#[derive(Debug, Clone)]
pub struct UtteranceReading {
    /// The code's name or language, such as `french` or `en-US`.
    pub code: String,
    /// The alphabet of the phones; `None` if the input is text.
    pub phones: Option<PhoneAlphabet>,
    /// Habits of some cuers, by the names that the code gives them.
    pub variants: Vec<String>,
    /// Pronunciation of French text if the spelling leaves it open.
    pub french: french::PronunciationOptions,
    /// Factor on the usual durations of phones; `None` leaves keys without times.
    pub pace: Option<f64>,
    /// Pronunciations that go before those of the rules.
    pub dictionary: Option<Arc<PronunciationDictionary>>,
}

/// A text with the time in which it is said, such as a subtitle or a word of an alignment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TimedText {
    /// The text.
    pub text: String,
    /// Its time.
    pub span: TimeSpan,
}

impl Default for UtteranceReading {
    fn default() -> Self {
        Self {
            code: "french".to_owned(),
            phones: None,
            variants: Vec::new(),
            french: french::PronunciationOptions::default(),
            pace: None,
            dictionary: None,
        }
    }
}

/// An utterance as it was understood.
#[derive(Debug, Clone)]
pub struct CuedUtterance {
    /// The code, with its variants.
    pub code: CueCode,
    /// The words with their phones in SAMPA, a pause as a word without text; empty if the input was phones.
    pub words: Vec<(String, Vec<String>)>,
    /// The phones, with times if the input has them or a pace is given.
    pub phones: Vec<SpokenPhone>,
    /// The alphabet of the phones.
    pub alphabet: PhoneAlphabet,
    /// The keys in order.
    pub keys: Vec<HandCueKey>,
    /// The parts that could not be read.
    pub findings: Vec<CueFinding>,
}

/// The reason why nothing can be cued.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UtteranceError {
    /// No code has this name.
    #[error("there is no code {0:?}")]
    NoCode(String),
    /// The code has no such variant.
    #[error(transparent)]
    Variant(#[from] super::UnknownVariant),
    /// The input is much longer than an hour of speech.
    #[error("the text has {0} bytes")]
    Long(usize),
    /// Text is given for a code that has no rules of spelling.
    #[error("the code {0:?} has no rules of spelling")]
    NoSpelling(String),
    /// The pace is no number from 0.1 to 10.
    #[error("the pace is {0}")]
    Pace(f64),
    /// The code has no usual durations.
    #[error("the code {0:?} has no table of durations")]
    NoDurations(String),
    /// A duration after a phone is no number of milliseconds.
    #[error("{label:?}: {text:?} is no duration in milliseconds")]
    Duration {
        /// The phone.
        label: String,
        /// The text after the `=`.
        text: String,
    },
}

impl UtteranceError {
    /// Returns a correction.
    #[must_use]
    pub fn utterance_error_remedy(&self) -> ErrorRemedy {
        let text = match self {
            Self::NoCode(_) => {
                let ids: Vec<&str> = all_cue_codes().iter().map(|code| code.id.as_str()).collect();
                format!("the codes are {}", ids.join(" and "))
            }
            Self::Variant(variant) => format!("the variants are {}", variant.known),
            Self::Long(_) => "give at most 1 MiB at once".to_owned(),
            Self::NoSpelling(_) => {
                return ErrorRemedy::command_remedy(
                    "give phones: --phones sampa, ipa or mfa; or the words in a --dictionary; or --espeak, if espeak-ng is installed",
                );
            }
            Self::Pace(_) => "a pace from 0.1 to 10; 1.6 is usual for people who cue".to_owned(),
            Self::NoDurations(_) => {
                "give each phone its milliseconds, such as h=80 aU=240, or leave the pace out".to_owned()
            }
            Self::Duration { .. } => "write for example a=120: from 1 to 60000".to_owned(),
        };
        text.into()
    }
}

/// The most bytes of input; an hour of speech has some 60,000 phones.
const MAX_UTTERANCE_BYTES: usize = 1 << 20;
/// The longest plausible phone, in milliseconds.
const LONGEST_MS: f64 = 60_000.0;
/// A shorter gap between texts is a rounding error, not a pause.
const PAUSE_MICROS: i64 = 10_000;
/// The duration of a sound that the table lacks, in milliseconds.
const USUAL_MS: f64 = 100.0;

impl UtteranceReading {
    /// Returns the code with its variants.
    ///
    /// # Errors
    /// [`UtteranceError`] if there is no such code or variant.
    pub fn reading_code(&self) -> Result<CueCode, UtteranceError> {
        let cue_code = find_cue_code(&self.code).ok_or_else(|| UtteranceError::NoCode(self.code.clone()))?;
        let variants: Vec<&str> = self.variants.iter().map(String::as_str).collect();
        Ok(cue_code.with_variants(&variants)?)
    }

    /// Returns the pronunciation of a text: French by the rules, other languages by the dictionary alone.
    fn pronounce_text(&self, text: &str, code: &CueCode) -> Result<french::FrenchPronunciation, UtteranceError> {
        match self.dictionary.as_deref() {
            dictionary if code.language == "fr" => Ok(french::pronounce_with_dictionary(text, self.french, dictionary)),
            Some(dictionary) => Ok(pronounce_listed_words(text, dictionary)),
            None => Err(UtteranceError::NoSpelling(code.id.clone())),
        }
    }
}

/// Returns the pronunciation of a text by a dictionary alone.
fn pronounce_listed_words(text: &str, dictionary: &PronunciationDictionary) -> french::FrenchPronunciation {
    let mut spoken = french::FrenchPronunciation::default();
    let plain = text.to_lowercase().replace('\u{2019}', "'");
    for piece in plain.split_inclusive(|c: char| !c.is_alphanumeric() && c != '\'') {
        let word = piece.trim_matches(|c: char| !c.is_alphanumeric());
        let pause = piece.ends_with(['.', ',', ';', ':', '!', '?', '\n']);
        match dictionary.find_pronunciation(word) {
            Some(phones) => spoken.words.push(french::FrenchWord::said_word(word, phones.to_vec())),
            None if word.is_empty() => {}
            None => spoken
                .findings
                .push(CueFinding::NotInDictionary { word: word.to_owned() }),
        }
        if pause {
            spoken
                .words
                .push(french::FrenchWord::said_word("", vec!["#".to_owned()]));
        }
    }
    spoken
}

impl CuedUtterance {
    /// Reads texts that have times. Those that follow each other without a pause are pronounced together, so that words
    /// link; the phones of a text share its time by their usual durations.
    ///
    /// # Errors
    /// [`UtteranceError`] if the code or a variant is wrong, or the code has no rules of spelling.
    pub fn read_timed_texts(texts: &[TimedText], reading: &UtteranceReading) -> Result<Self, UtteranceError> {
        let code = reading.reading_code()?;
        let (mut words, mut findings, mut doubtful) = (Vec::new(), Vec::new(), Vec::new());
        let mut phones: Vec<SpokenPhone> = Vec::new();
        let mut last_end = RecordingInstant::RECORDING_START;
        let mut said = texts.to_vec();
        said.retain(|timed| !code.is_pause(timed.text.trim()));
        let pause_micros =
            |end: RecordingInstant, span: TimeSpan| span.span_start_instant().instant_micros() - end.instant_micros();
        let follows =
            |one: &TimedText, next: &TimedText| pause_micros(one.span.span_end_instant(), next.span) <= PAUSE_MICROS;
        for group in said.chunk_by(follows) {
            for (timed, spoken) in group.iter().zip(reading.pronounce_group(group, &code, &mut findings)?) {
                let span = timed.span;
                if pause_micros(last_end, span) > PAUSE_MICROS {
                    phones.push(SpokenPhone {
                        label: "#".to_owned(),
                        span: Some(TimeSpan::span_between(last_end, span.span_start_instant())),
                    });
                }
                last_end = last_end.max(span.span_end_instant());
                let begin = phones.len();
                for word in &spoken {
                    let before: usize = phones.len();
                    doubtful.extend(word.doubtful.iter().map(|at| at + before));
                    phones.extend(word.phones.iter().map(|phone| SpokenPhone::new(phone.clone())));
                }
                share_time(&mut phones[begin..], span, &code);
                words.extend(spoken.into_iter().map(|word| (word.text, word.phones)));
            }
        }
        let mut read = Self::of_phones(code, phones, PhoneAlphabet::Sampa);
        findings.append(&mut read.findings);
        read.findings = findings;
        read.words = words;
        for key in &mut read.keys {
            mark_doubt(key, &doubtful, &read.code);
        }
        Ok(read)
    }

    /// Reads text, or phones, separated by blanks or written together; `a=120` is a phone of 120 ms.
    ///
    /// # Errors
    /// [`UtteranceError`] if the code, a variant, the pace or a duration is wrong, the input is larger than
    /// a MiB, or text is given for a code without rules of spelling.
    pub fn read_cued_utterance(input: &str, reading: &UtteranceReading) -> Result<Self, UtteranceError> {
        let code = reading.reading_code()?;
        if input.len() > MAX_UTTERANCE_BYTES {
            return Err(UtteranceError::Long(input.len()));
        }
        let (mut words, mut findings, mut doubtful) = (Vec::new(), Vec::new(), Vec::new());
        let mut given: Vec<(String, Option<f64>)> = Vec::new();
        let alphabet = match reading.phones {
            Some(alphabet) => {
                for word in input.split_whitespace() {
                    let (label, ms) = with_duration(word)?;
                    // A word with a duration is one phone, however many symbols it has.
                    match espeak::cut_joined_phones(&label, &code, alphabet).filter(|_| ms.is_none()) {
                        Some(symbols) => given.extend(symbols.into_iter().map(|symbol| (symbol, None))),
                        None => given.push((label, ms)),
                    }
                }
                alphabet
            }
            None => {
                let spoken = reading.pronounce_text(input, &code)?;
                findings.extend(spoken.findings);
                for word in spoken.words {
                    doubtful.extend(word.doubtful.iter().map(|at| at + given.len()));
                    given.extend(word.phones.iter().map(|phone| (phone.clone(), None)));
                    words.push((word.text, word.phones));
                }
                PhoneAlphabet::Sampa
            }
        };
        let phones = assign_phone_times(given, &code, alphabet, reading.pace)?;
        let mut read = Self::of_phones(code, phones, alphabet);
        findings.append(&mut read.findings);
        read.findings = findings;
        read.words = words;
        for key in &mut read.keys {
            mark_doubt(key, &doubtful, &read.code);
        }
        Ok(read)
    }

    /// Returns the utterance of phones that have their own times, such as those of an alignment.
    #[must_use]
    pub fn of_phones(code: CueCode, phones: Vec<SpokenPhone>, alphabet: PhoneAlphabet) -> Self {
        let (keys, findings) = code.phones_to_keys(&phones, alphabet);
        Self {
            words: Vec::new(),
            code,
            phones,
            alphabet,
            keys,
            findings,
        }
    }

    /// Returns the phones in SAMPA with their durations in milliseconds, in the form that [`read`](Self::read_cued_utterance) reads;
    /// gaps and phones that the code does not know become pauses.
    #[must_use]
    pub fn write_sampa_phones(&self) -> String {
        let mut out: Vec<String> = Vec::new();
        let mut last_end: Option<RecordingInstant> = None;
        for phone in &self.phones {
            let known_symbols = self.code.sampa_symbols(&phone.label, self.alphabet);
            let symbols = known_symbols.unwrap_or_else(|| vec!["#".to_owned()]);
            let Some(span) = phone.span else {
                out.extend(symbols);
                continue;
            };
            let gap = last_end.map_or(0, |at| span.span_start_instant().instant_micros() - at.instant_micros());
            let mut length = span.span_micros();
            // Gaps up to 10 ms come from rounding of the file and are no pauses.
            if gap > 10_000 {
                out.push(format!("#={}", ms(gap)));
            } else {
                length += gap;
            }
            // A phone of the file may be several sounds of the code, between which no time is known.
            let each = length / symbols.len().max(1) as i64;
            out.extend(symbols.iter().map(|symbol| format!("{symbol}={}", ms(each))));
            last_end = Some(span.span_end_instant());
        }
        out.join(" ")
    }
}

impl UtteranceReading {
    /// Returns the words of each text of a group that is said without a pause, without pauses at the ends of texts.
    fn pronounce_group(
        &self,
        group: &[TimedText],
        code: &CueCode,
        findings: &mut Vec<CueFinding>,
    ) -> Result<Vec<Vec<french::FrenchWord>>, UtteranceError> {
        // A new line within a subtitle, and the joint of a compound of SPPAS, are no pauses.
        let plain = |timed: &TimedText| timed.text.replace(['\n', '_'], " ");
        let texts: Vec<String> = group.iter().map(plain).collect();
        let mut apart = Vec::new();
        for text in &texts {
            apart.push(self.pronounce_text(text, code)?);
        }
        let mut together = self.pronounce_text(&texts.join(" "), code)?;
        let word_count: usize = apart.iter().map(|spoken| spoken.words.len()).sum();
        // Parts of a number that stand in several texts become other words together.
        let is_split = together.words.len() == word_count;
        let mut spoken_words = Vec::new();
        for spoken in apart {
            let mut words = match is_split {
                true => together.words.drain(..spoken.words.len()).collect(),
                false => spoken.words,
            };
            if !is_split {
                findings.extend(spoken.findings);
            }
            while words.last().is_some_and(|word| word.text.is_empty()) {
                words.pop();
            }
            spoken_words.push(words);
        }
        if is_split {
            findings.append(&mut together.findings);
        }
        Ok(spoken_words)
    }
}

/// Gives phones a share of a span each, by their usual durations.
fn share_time(phones: &mut [SpokenPhone], span: TimeSpan, code: &CueCode) {
    let usual = |phone: &SpokenPhone| code.durations_ms.get(&phone.label).copied().unwrap_or(USUAL_MS);
    let total: f64 = phones.iter().map(usual).sum();
    let begin = span.span_start_instant();
    let (mut passed, mut from) = (0.0, begin);
    for phone in phones {
        passed += usual(phone);
        let to = begin.shifted_instant((span.span_micros() as f64 * passed / total).round() as i64);
        phone.span = Some(TimeSpan::span_between(from, to));
        from = to;
    }
}

/// Returns a duration as text in milliseconds: at least 1, without zeros at the end.
fn ms(micros: i64) -> String {
    let text = format!("{:.3}", (micros as f64 / 1000.0).max(1.0));
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn with_duration(word: &str) -> Result<(String, Option<f64>), UtteranceError> {
    let Some((label, text)) = word.rsplit_once('=').filter(|(_, text)| !text.is_empty()) else {
        return Ok((word.to_owned(), None));
    };
    let number = text.parse::<f64>().ok();
    match number.filter(|number| (1.0..=LONGEST_MS).contains(number)) {
        Some(number) => Ok((label.to_owned(), Some(number))),
        None => Err(UtteranceError::Duration {
            label: label.to_owned(),
            text: text.to_owned(),
        }),
    }
}

/// Gives phones times one after another: their own durations, else the usual ones of the code multiplied by `pace`.
fn assign_phone_times(
    given: Vec<(String, Option<f64>)>,
    code: &CueCode,
    alphabet: PhoneAlphabet,
    pace: Option<f64>,
) -> Result<Vec<SpokenPhone>, UtteranceError> {
    if let Some(pace) = pace
        && !(0.1..=10.0).contains(&pace)
    {
        return Err(UtteranceError::Pace(pace));
    }
    // The usual durations fill in as soon as one phone has a duration or a pace is asked for.
    let is_timed = !given.is_empty() && given.iter().all(|(_, ms)| ms.is_some());
    if !is_timed && pace.is_none() && given.iter().all(|(_, ms)| ms.is_none()) {
        return Ok(given.into_iter().map(|(label, _)| SpokenPhone::new(label)).collect());
    }
    if !is_timed && code.durations_ms.is_empty() {
        return Err(UtteranceError::NoDurations(code.id.clone()));
    }
    let usual = |label: &str| {
        let sounds = code.sampa_symbols(label, alphabet).unwrap_or_default();
        let one = |sound: &String| code.durations_ms.get(sound).copied().unwrap_or(USUAL_MS);
        sounds.iter().map(one).sum::<f64>() * pace.unwrap_or(1.0)
    };
    let mut end = 0.0;
    let phones = given.into_iter().map(|(label, ms)| {
        let start = end;
        end += ms.unwrap_or_else(|| usual(&label));
        let instant = |ms: f64| RecordingInstant::from_seconds(ms / 1000.0);
        SpokenPhone {
            label,
            span: Some(TimeSpan::span_between(instant(start), instant(end))),
        }
    });
    Ok(phones.collect())
}

/// Records the other placement of a key whose vowel is uncertain.
fn mark_doubt(key: &mut HandCueKey, doubtful: &[usize], code: &CueCode) {
    let (Some(at), Some(vowel)) = (key.from.last(), key.phones.last()) else {
        return;
    };
    if doubtful.binary_search(at).is_err() {
        return;
    }
    let other = code.doubtful.iter().find_map(|[one, other]| {
        (one == vowel)
            .then_some(other)
            .or_else(|| (other == vowel).then_some(one))
    });
    let path = other.and_then(|other| code.path_of(other));
    key.or_at = path
        .and_then(|path| path.into_iter().next())
        .filter(|place| *place != key.placement);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phones_written_together_are_those_with_blanks_between_them() {
        for (code, alphabet, together, apart) in [
            ("french", PhoneAlphabet::Ipa, "bɔ̃ʒuʁ", "b ɔ̃ ʒ u ʁ"),
            ("french", PhoneAlphabet::Ipa, "/lə.ʃa/ [dɔʁ]", "l ə ʃ a d ɔ ʁ"),
            ("french", PhoneAlphabet::Ipa, "\\œ̃.n‿wa.zo\\", "œ̃ n w a z o"),
            ("french", PhoneAlphabet::Sampa, "bO~ZuR", "b O~ Z u R"),
            ("french", PhoneAlphabet::Sampa, "poezi oe", "p o e z i oe"),
            ("english-us", PhoneAlphabet::Ipa, "həˈloʊ tʃɛɹ", "h ə l oʊ tʃ ɛ ɹ"),
            ("english-us", PhoneAlphabet::Mfa, "HH AH0 L OW1", "HH AH0 L OW1"),
            ("french", PhoneAlphabet::Ipa, "t͡ʃaχ", "t͡ʃaχ"),
            ("french", PhoneAlphabet::Ipa, "bu=300", "bu=300"),
        ] {
            let reading = UtteranceReading {
                code: code.to_owned(),
                phones: Some(alphabet),
                ..UtteranceReading::default()
            };
            let labels = |text: &str| {
                let read = CuedUtterance::read_cued_utterance(text, &reading).expect("read");
                read.phones.into_iter().map(|it| it.label).collect::<Vec<_>>()
            };
            let apart: Vec<String> = apart.split(' ').map(|it| it.replace("=300", "")).collect();
            assert_eq!(labels(together), apart, "{together}");
        }
    }

    #[test]
    fn phones_with_durations_read_back_unchanged() {
        let reading = UtteranceReading {
            phones: Some(PhoneAlphabet::Sampa),
            ..UtteranceReading::default()
        };
        let text = "l=87 @=131 #=250 S=135.5 a=177";
        let read = CuedUtterance::read_cued_utterance(text, &reading).expect("read");
        assert_eq!(read.write_sampa_phones(), text);
        let times: Vec<i64> = read.keys[1].span.map_or(Vec::new(), |span| {
            vec![
                span.span_start_instant().instant_micros(),
                span.span_end_instant().instant_micros(),
            ]
        });
        assert_eq!(times, [468_000, 780_500]);
        for wrong in ["a=x", "a=0", "a=-3", "a=NaN", "a=1e9"] {
            assert!(CuedUtterance::read_cued_utterance(wrong, &reading).is_err(), "{wrong}");
        }
        let mixed = CuedUtterance::read_cued_utterance("l=90 a", &reading).expect("the table has the others");
        assert!(mixed.phones[1].span.is_some());
    }
}
