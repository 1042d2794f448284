//! Keys of cued speech from text or phones, without a corpus.

use chereme_motion::{Instant, Span};
use chereme_sign::cue::{self, Alphabet, CueCode, Phone, french};
use serde::Serialize;

use crate::error::{Error, Result};

/// How to read an utterance, and which code cues it.
#[derive(Debug, Clone)]
pub struct KeysOptions {
    /// The code's name or language, such as `french` or `en-US`.
    pub code: String,
    /// The alphabet of the phones; nothing if the input is text.
    pub phones: Option<Alphabet>,
    /// Habits of some cuers, by the names that the code gives them.
    pub variants: Vec<String>,
    /// How text is said where spelling leaves it open.
    pub french: french::Options,
    /// How many times longer than usual phones last; nothing leaves keys without times.
    pub pace: Option<f64>,
}

impl Default for KeysOptions {
    fn default() -> Self {
        Self {
            code: "french".to_owned(),
            phones: None,
            variants: Vec::new(),
            french: french::Options::default(),
            pace: None,
        }
    }
}

/// The keys of an utterance.
#[derive(Debug, Clone, Serialize)]
pub struct CueKeys {
    /// The code that was used.
    pub code: String,
    /// The words and how each is said; empty if the input was phones.
    pub words: Vec<SpokenWord>,
    /// The keys in order.
    pub keys: Vec<CueKey>,
    /// What could not be read.
    pub findings: Vec<String>,
}

/// A word of the text and its phones.
#[derive(Debug, Clone, Serialize)]
pub struct SpokenWord {
    /// The word.
    pub text: String,
    /// Its phones in SAMPA.
    pub phones: Vec<String>,
}

/// One key.
#[derive(Debug, Clone, Serialize)]
pub struct CueKey {
    /// The number of the handshape.
    pub shape: u8,
    /// The placement.
    pub placement: String,
    /// The placement if speakers say the vowel in another way, too.
    pub or_placement: Option<String>,
    /// The phones in SAMPA.
    pub phones: Vec<String>,
    /// The beginning in microseconds, if known.
    pub start_us: Option<i64>,
    /// The beginning of the vowel in microseconds, if known.
    pub vowel_us: Option<i64>,
    /// The end in microseconds, if known.
    pub end_us: Option<i64>,
}

/// Longer input is refused: an hour of speech has some 60,000 phones.
const MOST_BYTES: usize = 1 << 20;

/// Returns the keys of `input`, which is text or phones separated by blanks.
///
/// # Errors
/// [`Error::Wrong`] if the code or a variant does not exist, the pace is no positive number, the input is
/// larger than a MiB, or text is given for a code without rules of spelling.
pub fn cue_keys(input: &str, options: &KeysOptions) -> Result<CueKeys> {
    let code = code(options)?;
    if input.len() > MOST_BYTES {
        return Err(Error::wrong(format!("the text has {} bytes", input.len()))
            .advise("give at most 1 MiB at once"));
    }
    let (mut words, mut findings, mut doubtful) = (Vec::new(), Vec::new(), Vec::new());
    let (labels, alphabet): (Vec<String>, _) = match options.phones {
        Some(alphabet) => (
            input.split_whitespace().map(str::to_owned).collect(),
            alphabet,
        ),
        None => {
            let spoken = spoken(input, &code, options)?;
            findings.extend(spoken.findings.iter().map(ToString::to_string));
            let mut labels = Vec::new();
            for word in spoken.words {
                doubtful.extend(word.doubtful.iter().map(|at| at + labels.len()));
                labels.extend(word.phones.iter().cloned());
                if !word.text.is_empty() {
                    words.push(SpokenWord {
                        text: word.text,
                        phones: word.phones,
                    });
                }
            }
            (labels, Alphabet::Sampa)
        }
    };
    let phones = timed(&labels, &code, alphabet, options.pace)?;
    let (mut keys, odd) = code.keys(&phones, alphabet);
    findings.extend(odd.iter().map(ToString::to_string));
    for key in &mut keys {
        mark_doubt(key, &doubtful, &code);
    }
    Ok(CueKeys {
        code: code.id.clone(),
        words,
        keys: keys.iter().map(shown).collect(),
        findings,
    })
}

fn code(options: &KeysOptions) -> Result<CueCode> {
    let known = cue::code(&options.code).ok_or_else(|| {
        let ids: Vec<&str> = cue::codes().iter().map(|code| code.id.as_str()).collect();
        Error::wrong(format!("there is no code {:?}", options.code))
            .advise(format!("the codes are {}", ids.join(" and ")))
    })?;
    let variants: Vec<&str> = options.variants.iter().map(String::as_str).collect();
    known
        .with_variants(&variants)
        .map_err(|error| Error::wrong(error.to_string()))
}

fn spoken(text: &str, code: &CueCode, options: &KeysOptions) -> Result<french::Spoken> {
    if code.language == "fr" {
        return Ok(french::phones(text, options.french));
    }
    Err(
        Error::wrong(format!("the code {:?} has no rules of spelling", code.id))
            .advise("give phones: --phones sampa, ipa or mfa"),
    )
}

/// Gives phones the usual durations of the code, `pace` times as long.
fn timed(
    labels: &[String],
    code: &CueCode,
    alphabet: Alphabet,
    pace: Option<f64>,
) -> Result<Vec<Phone>> {
    let Some(pace) = pace else {
        return Ok(labels.iter().map(Phone::new).collect());
    };
    if !(0.1..=10.0).contains(&pace) {
        return Err(Error::wrong(format!("the pace is {pace}"))
            .advise("a pace from 0.1 to 10; 1.6 is usual for people who cue"));
    }
    if code.durations_ms.is_empty() {
        return Err(
            Error::wrong(format!("the code {:?} has no table of durations", code.id))
                .advise("leave the pace out"),
        );
    }
    let usual = |label: &String| {
        let sounds = code.symbols(label, alphabet).unwrap_or_default();
        let one = |sound: &String| code.durations_ms.get(sound).copied().unwrap_or(100.0);
        sounds.iter().map(one).sum::<f64>()
    };
    let mut at = 0.0;
    let phones = labels.iter().map(|label| {
        let start = at;
        at += usual(label) * pace;
        let instant = |ms: f64| Instant::from_seconds(ms / 1000.0);
        Phone {
            label: label.clone(),
            span: Some(Span::between(instant(start), instant(at))),
        }
    });
    Ok(phones.collect())
}

/// Names the other placement of a key whose vowel is uncertain.
fn mark_doubt(key: &mut cue::Key, doubtful: &[usize], code: &CueCode) {
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

fn shown(key: &cue::Key) -> CueKey {
    let micros = |instant: Instant| instant.micros();
    CueKey {
        shape: key.shape,
        placement: key.placement.clone(),
        or_placement: key.or_at.clone(),
        phones: key.phones.clone(),
        start_us: key.span.map(|span| micros(span.start())),
        vowel_us: key.vowel.map(|span| micros(span.start())),
        end_us: key.span.map(|span| micros(span.end())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(input: &str, options: &KeysOptions) -> String {
        let found = cue_keys(input, options).expect("keys");
        let words = found
            .keys
            .iter()
            .map(|key| format!("{}-{}", key.shape, key.placement));
        words.collect::<Vec<String>>().join(" ")
    }

    #[test]
    fn text_and_phones_give_the_same_keys() {
        let text = KeysOptions::default();
        let expected = "6-side 6-side 1-chin 3-side";
        assert_eq!(plain("le chat dort", &text), expected);
        let phones = KeysOptions {
            phones: Some(Alphabet::Ipa),
            ..KeysOptions::default()
        };
        assert_eq!(plain("l ə ʃ a d ɔ ʁ", &phones), expected);
    }

    #[test]
    fn usual_durations_give_keys_times_that_follow_each_other() {
        let options = KeysOptions {
            pace: Some(1.6),
            ..KeysOptions::default()
        };
        let found = cue_keys("le chat dort", &options).expect("keys");
        let first = &found.keys[0];
        assert_eq!(first.start_us, Some(0));
        assert_eq!(first.vowel_us, Some(139_200), "1.6 times 87 ms");
        assert_eq!(first.end_us, found.keys[1].start_us);
    }

    #[test]
    fn an_uncertain_vowel_names_the_other_placement() {
        let found = cue_keys("maison", &KeysOptions::default()).expect("keys");
        assert_eq!(found.keys[0].placement, "chin");
        assert_eq!(found.keys[0].or_placement.as_deref(), Some("throat"));
    }

    #[test]
    fn input_that_means_nothing_is_refused_with_the_remedy() {
        let refuse = |input: &str, options: KeysOptions| {
            let error = cue_keys(input, &options).expect_err("refused");
            error.remedy().unwrap_or_default().to_owned()
        };
        let code = |code: &str| KeysOptions {
            code: code.to_owned(),
            ..KeysOptions::default()
        };
        assert!(refuse("a", code("klingon")).contains("french and english-us"));
        assert!(refuse("house", code("en-US")).contains("--phones"));
        let pace = |pace| KeysOptions {
            pace: Some(pace),
            ..KeysOptions::default()
        };
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refuse("a", pace(wrong)).contains("0.1 to 10"));
        }
        let long = "a ".repeat(1 << 20);
        assert!(refuse(&long, KeysOptions::default()).contains("1 MiB"));
    }
}
