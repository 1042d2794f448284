//! Keys of cued speech from text or phones, without a corpus.

mod cue_sources;

use std::path::Path;
use std::process::{Command, Stdio};

use chereme_compose::recipe::{CueSettings, RecipeNode};
use chereme_compose::units::{HandChoice, RecipeFactor};
use chereme_compose::{PhaseRule, RECIPE_TREE_VERSION};
use chereme_motion::RecordingInstant;
use chereme_sign::cue::{self, CuedUtterance, PhoneAlphabet, UtteranceError};
use serde::Serialize;
use serde_json::json;

use crate::Corpus;
use crate::error::{CorpusError, CorpusResult};
use crate::recombine::RecombinationResult;

use cue_sources::read_aligned_utterance;
pub(crate) use cue_sources::{guessed_alphabet, is_phone_tier, with_gaps};

pub use chereme_sign::cue::UtteranceReading as KeysOptions;
pub use cue_sources::read_pronunciation_dictionary;

/// The keys of an utterance.
#[derive(Debug, Clone, Serialize)]
pub struct CueKeys {
    /// The code that was used.
    pub code: String,
    /// The words and their pronunciations; empty if the input was phones.
    pub words: Vec<SpokenWord>,
    /// The keys in order.
    pub keys: Vec<CueKey>,
    /// The parts that could not be read.
    pub findings: Vec<String>,
    /// The tier of the file that the phones come from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tier: Option<String>,
    /// The alphabet of the phones of a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alphabet: Option<&'static str>,
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
    /// The name of the placement.
    pub placement: String,
    /// Another placement, for speakers who pronounce the vowel differently.
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

/// Returns the keys of `input`, which is text or phones separated by blanks; `a=120` is a phone of 120 ms.
///
/// # Errors
/// [`CorpusError::Wrong`] if the code or a variant does not exist, the pace is no positive number, the input is
/// larger than a MiB, text is given for a code without rules of spelling, or there is nothing to cue in the input.
pub fn cue_keys(input: &str, options: &KeysOptions) -> CorpusResult<CueKeys> {
    let read = CuedUtterance::read_cued_utterance(input, options).map_err(utterance_read_error)?;
    let keys = CueKeys::from_read_utterance(&read);
    if keys.keys.is_empty() && keys.findings.is_empty() {
        return Err(nothing_to_cue(input));
    }
    Ok(keys)
}

fn utterance_read_error(error: UtteranceError) -> CorpusError {
    CorpusError::from_wrong_message(error.to_string()).with_advice(error.utterance_error_remedy())
}

impl CueKeys {
    fn from_read_utterance(read: &CuedUtterance) -> Self {
        let words = read.words.iter().filter(|(text, _)| !text.is_empty());
        Self {
            code: read.code.id.clone(),
            words: words
                .map(|(text, phones)| SpokenWord {
                    text: text.clone(),
                    phones: phones.clone(),
                })
                .collect(),
            keys: read.keys.iter().map(cue_key_from_analysis).collect(),
            findings: read.findings.iter().map(ToString::to_string).collect(),
            tier: None,
            alphabet: None,
        }
    }
}

/// Returns the keys for a tier of phones, words or sentences in an annotation file of any kind that is imported, with the
/// times of the tier; subtitles are such files, too.
///
/// The tier is the named one, otherwise the first whose name aligners use for phones, or for words, or the only one.
/// Phones of words share their time. If the options name no alphabet, it is the one that contains most of the labels.
///
/// # Errors
/// Fails if the file cannot be read, or has no such tier, or nothing to cue on it.
pub fn cue_keys_of_file(path: &Path, tier: Option<&str>, options: &KeysOptions) -> CorpusResult<CueKeys> {
    let (read, name, mut findings) = read_aligned_utterance(path, tier, options)?;
    let mut keys = CueKeys::from_read_utterance(&read);
    // Oddities of the file come before those of its phones.
    findings.append(&mut keys.findings);
    keys.findings = findings;
    if keys.keys.is_empty() && keys.findings.is_empty() {
        let text = format!("the tier {name:?} has nothing to cue");
        return Err(CorpusError::from_wrong_message(text)
            .with_error_place(path.display().to_string())
            .with_command_advice("name one with --tier"));
    }
    keys.tier = Some(name);
    keys.alphabet = Some(read.alphabet.alphabet_name()).filter(|_| keys.words.is_empty());
    Ok(keys)
}

/// The largest text or list of phones of a cuer: an hour or so of speech.
const MOST_CUED_BYTES: usize = 1 << 18;

/// Returns the phones of an alignment in the format for recipes: SAMPA with milliseconds, including the first pause;
/// and the parts that could not be read.
///
/// # Errors
/// As [`cue_keys_of_file`].
pub fn cue_phones_of_file(
    path: &Path,
    tier: Option<&str>,
    options: &KeysOptions,
) -> CorpusResult<(String, Vec<String>)> {
    let (read, _, mut findings) = read_aligned_utterance(path, tier, options)?;
    findings.extend(read.findings.iter().map(ToString::to_string));
    Ok((read.write_sampa_phones(), findings))
}

/// The cuer, and the manner of cueing.
#[derive(Debug, Clone, Default)]
pub struct CueOptions {
    /// How the text or phones are read.
    pub reading: KeysOptions,
    /// The name or address of a signer or a recording whose body cues; without one the corpus chooses.
    pub signer: Option<String>,
    /// The rule for the times of the hand relative to the sounds.
    pub phase: PhaseRule,
    /// Whether the left hand cues, regardless of the signer's handedness.
    pub left: bool,
}

impl Corpus {
    /// Generates the movement of a cuer who says `text`, which is text or phones; stores it under `gloss` if one is
    /// given, with tiers for phones, keys, hand and fingers.
    ///
    /// # Errors
    /// Fails if nothing in the text can be cued, or the body has no arm, fingers or head. Nothing incomplete is stored.
    pub fn generate_cued_speech(
        &mut self,
        text: &str,
        options: &CueOptions,
        gloss: Option<&str>,
    ) -> CorpusResult<RecombinationResult> {
        check_size(text)?;
        // A text that means nothing is refused by itself, not as a recipe that holds all of it.
        let read = CuedUtterance::read_cued_utterance(text, &options.reading).map_err(utterance_read_error)?;
        if read.keys.is_empty() {
            return Err(nothing_to_cue(text));
        }
        // A recipe holds its text alone: words that the user's dictionary says become their phones.
        let has_dictionary = options.reading.dictionary.is_some();
        let phones = has_dictionary.then(|| read.write_sampa_phones());
        let mut spoken = options.clone();
        if has_dictionary {
            spoken.reading.phones = Some(PhoneAlphabet::Sampa);
        }
        let signer = options.signer.as_deref();
        let on = signer.map(|name| self.body_address(name)).transpose()?;
        let recipe = cue_recipe(phones.as_deref().unwrap_or(text), &spoken, on);
        match gloss {
            Some(gloss) => self.recombine_recipe(&recipe, gloss),
            None => self.preview_recipe(&recipe),
        }
    }
}

/// Refuses a text by its length, before it is read.
pub(crate) fn check_size(text: &str) -> CorpusResult<()> {
    if text.len() > MOST_CUED_BYTES {
        return Err(
            CorpusError::from_wrong_message(format!("the text has {} bytes", text.len()))
                .with_advice("cue at most 256 KiB at once, about an hour of speech"),
        );
    }
    Ok(())
}

/// Returns the error for a text without any key.
pub(crate) fn nothing_to_cue(text: &str) -> CorpusError {
    const MAX_UNREAD_TEXT_CHARS: usize = 60;
    let mut begin: String = text.trim().chars().take(MAX_UNREAD_TEXT_CHARS).collect();
    if text.trim().chars().nth(MAX_UNREAD_TEXT_CHARS).is_some() {
        begin.push('…');
    }
    CorpusError::from_wrong_message(format!("there is nothing to cue in {begin:?}"))
        .with_command_advice("write words, or phones with --phones")
}

/// Returns the phones of `text` in IPA as the program `espeak-ng` pronounces them, if it is installed, and the
/// characters of its output that have no key; `code` is the name of a code.
///
/// # Errors
/// Fails if the code does not exist, the text is larger than 64 KiB, or `espeak-ng` cannot be run.
pub fn cue_phones_of_espeak(text: &str, code: &str) -> CorpusResult<(String, Vec<char>)> {
    const MAX_ESPEAK_TEXT_BYTES: usize = 1 << 16;
    let cue_code =
        cue::find_cue_code(code).ok_or_else(|| utterance_read_error(UtteranceError::NoCode(code.to_owned())))?;
    if text.len() > MAX_ESPEAK_TEXT_BYTES {
        return Err(
            CorpusError::from_wrong_message(format!("the text has {} bytes", text.len()))
                .with_advice("give at most 64 KiB at once to espeak-ng"),
        );
    }
    let voice = match cue_code.language.as_str() {
        "fr" => "fr-fr",
        "en-US" => "en-us",
        "en-GB" => "en-gb",
        other => other,
    };
    let cannot = |error: std::io::Error| {
        CorpusError::from_wrong_message(format!("espeak-ng cannot be run: {error}"))
            .with_command_advice("install espeak-ng, or give French text without --espeak, or phones with --phones")
    };
    let mut child = Command::new("espeak-ng")
        .args(["-q", "-v", voice, "--ipa", "--stdin"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(cannot)?;
    let mut stdin = child.stdin.take();
    let lines = text.replace(['.', '!', '?', ';'], "\n");
    // A separate thread writes the text while this one reads the output, so that neither blocks the other.
    let writer = std::thread::spawn(move || {
        stdin
            .as_mut()
            .map(|stdin| std::io::Write::write_all(stdin, lines.as_bytes()))
    });
    let output = child.wait_with_output().map_err(cannot)?;
    drop(writer.join());
    if !output.status.success() {
        return Err(CorpusError::from_wrong_message("espeak-ng failed").with_advice(format!(
            "try `espeak-ng -v {voice}` by itself: the voice may be missing"
        )));
    }
    Ok(cue::of_espeak(&String::from_utf8_lossy(&output.stdout), cue_code))
}

/// Returns the recipe, as JSON, for a cuer who says `text`; `on` is the address of a body, and without it the corpus
/// chooses one.
#[must_use]
pub fn cue_recipe(text: &str, options: &CueOptions, on: Option<String>) -> String {
    let french = options.reading.french;
    let mut variants = options.reading.variants.clone();
    if !french.liaison {
        variants.push("no-liaison".to_owned());
    }
    match french.schwa {
        cue::french::SchwaCondition::Usual => {}
        cue::french::SchwaCondition::Said => variants.push("schwa-said".to_owned()),
        cue::french::SchwaCondition::Dropped => variants.push("schwa-dropped".to_owned()),
    }
    let code = Some(options.reading.code.clone()).filter(|code| code != "french");
    let node = RecipeNode::Cue(CueSettings {
        text: text.to_owned(),
        phones: options
            .reading
            .phones
            .map(|alphabet| alphabet.alphabet_name().to_owned()),
        code,
        variants,
        hand: if options.left {
            HandChoice::Left
        } else {
            HandChoice::Dominant
        },
        phase: options.phase,
        pace: options.reading.pace.map(RecipeFactor),
        on,
    });
    json!({"version": RECIPE_TREE_VERSION, "make": node}).to_string()
}

fn cue_key_from_analysis(key: &cue::HandCueKey) -> CueKey {
    let micros = |instant: RecordingInstant| instant.instant_micros();
    CueKey {
        shape: key.shape,
        placement: key.placement.clone(),
        or_placement: key.or_at.clone(),
        phones: key.phones.clone(),
        start_us: key.span.map(|span| micros(span.span_start_instant())),
        vowel_us: key.vowel.map(|span| micros(span.span_start_instant())),
        end_us: key.span.map(|span| micros(span.span_end_instant())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(input: &str, options: &KeysOptions) -> String {
        let found = cue_keys(input, options).expect("keys");
        let words = found.keys.iter().map(|key| format!("{}-{}", key.shape, key.placement));
        words.collect::<Vec<String>>().join(" ")
    }

    #[test]
    fn text_and_phones_give_the_same_keys() {
        let text = KeysOptions::default();
        let expected = "6-side 6-side 1-chin 3-side";
        assert_eq!(plain("le chat dort", &text), expected);
        let phones = KeysOptions {
            phones: Some(PhoneAlphabet::Ipa),
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
            error.error_remedy().unwrap_or_default().to_string()
        };
        let code = |code: &str| KeysOptions {
            code: code.to_owned(),
            ..KeysOptions::default()
        };
        assert!(refuse("a", code("klingon")).contains("french and english-us and english-gb"));
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
        let phones = || KeysOptions {
            phones: Some(PhoneAlphabet::Ipa),
            ..KeysOptions::default()
        };
        for (nothing, options) in [
            ("", KeysOptions::default()),
            (" \n", KeysOptions::default()),
            ("…", KeysOptions::default()),
            ("", phones()),
            ("#", phones()),
        ] {
            assert!(refuse(nothing, options).contains("write words"), "{nothing:?}");
        }
    }
}
