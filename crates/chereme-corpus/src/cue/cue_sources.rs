//! Files that utterances come from: tiers of phones, of words and of sentences, and the user's dictionary.

use std::path::Path;
use std::sync::Arc;

use chereme_formats::eaf::eaf_convert::{AnnotationTranscript, TranscriptTier};
use chereme_formats::table;
use chereme_motion::RecordingInstant;
use chereme_sign::cue::{CueCode, CuedUtterance, PhoneAlphabet, PronunciationDictionary, SpokenPhone, TimedText};

use super::{KeysOptions, utterance_read_error};
use crate::compare::read_annotation_document;
use crate::error::{CorpusError, CorpusResult};

/// The names that aligners give to tiers of phones, folded and without punctuation.
const PHONE_TIERS: [&str; 7] = [
    "phones",
    "phone",
    "phonalign",
    "mau",
    "phonemes",
    "phoneme",
    "phonetique",
];
/// Shorter gaps between phones are rounding errors, not pauses.
const SILENCE_MICROS: i64 = 10_000;
/// The largest file of an alignment.
const MOST_FILE_BYTES: u64 = 1 << 28;
/// The names that aligners give to tiers of words, and people to tiers of sentences, without punctuation.
const TEXT_TIERS: [&str; 11] = [
    "tokensalign",
    "words",
    "word",
    "mots",
    "ortmau",
    "tokens",
    "ort",
    "text",
    "texte",
    "transcription",
    "subtitles",
];
/// The share of labels that have to be phones for a tier to be one of phones, whatever its name.
const LEAST_PHONE_SHARE: f64 = 0.9;

/// Reads the user's pronunciations of words for a code, with a warning if lines were left out.
///
/// # Errors
/// Fails if the file cannot be read, is larger than 256 MiB, or no line is a word with phones of the code.
pub fn read_pronunciation_dictionary(
    path: &Path,
    code: &str,
) -> CorpusResult<(Arc<PronunciationDictionary>, Option<String>)> {
    let reading = KeysOptions {
        code: code.to_owned(),
        ..KeysOptions::default()
    };
    let code = reading.reading_code().map_err(utterance_read_error)?;
    let wrong = |message: String| {
        CorpusError::from_wrong_message(message)
            .with_error_place(path.display().to_string())
            .with_advice(
                "give a word and its phones on each line, such as fils<TAB>f i s, or a table of Lexique or of MFA",
            )
    };
    let text = table::decode_table_text(&read_spoken_file(path)?).map_err(|error| wrong(error.to_string()))?;
    let read = PronunciationDictionary::read_dictionary(&text, &code);
    let dictionary = read.map_err(|error| wrong(error.to_string()))?;
    let warning = (dictionary.left_out > 0).then(|| {
        format!(
            "lines of the dictionary with phones that the code {:?} does not know were left out: {}, the first is line {}",
            code.id, dictionary.left_out, dictionary.first_left_out
        )
    });
    Ok((Arc::new(dictionary), warning))
}

fn read_spoken_file(path: &Path) -> CorpusResult<Vec<u8>> {
    let file = |source| CorpusError::from_file_failure(path, source);
    let size = std::fs::metadata(path).map_err(file)?.len();
    if size > MOST_FILE_BYTES {
        return Err(CorpusError::from_wrong_message(format!("the file has {size} bytes"))
            .with_error_place(path.display().to_string())
            .with_advice("give a file of at most 256 MiB"));
    }
    std::fs::read(path).map_err(file)
}

/// Reads the chosen tier of a file; returns it as an utterance with the tier's name and what is odd in the file.
pub(super) fn read_aligned_utterance(
    path: &Path,
    tier: Option<&str>,
    options: &KeysOptions,
) -> CorpusResult<(CuedUtterance, String, Vec<String>)> {
    let bytes = read_spoken_file(path)?;
    let place = path.display().to_string();
    let (transcript, odd, _) = read_annotation_document(&place, &bytes)?;
    let tier = spoken_tier(&transcript, tier).map_err(|error| error.with_error_place(&place))?;
    let mut annotations: Vec<TimedText> = tier.annotations.iter().map(timed_annotation).collect();
    // Annotations in a file need not be sorted by time.
    annotations.sort_by_key(|one| one.span.span_start_instant());
    let code = options.reading_code().map_err(utterance_read_error)?;
    let phones: Vec<SpokenPhone> = annotations.iter().map(phone_of_text).collect();
    let alphabet = options.phones.unwrap_or_else(|| guessed_alphabet(&code, &phones));
    let is_of_phones =
        options.phones.is_some() || is_phone_tier(&tier.name) || are_mostly_phones(&code, &phones, alphabet);
    let read = match is_of_phones {
        true => CuedUtterance::of_phones(code, with_gaps(phones), alphabet),
        false => CuedUtterance::read_timed_texts(&annotations, options).map_err(utterance_read_error)?,
    };
    let findings = odd.iter().map(|finding| finding.message.clone()).collect();
    Ok((read, tier.name.clone(), findings))
}

fn timed_annotation(annotation: &chereme_formats::eaf::eaf_convert::TranscriptAnnotation) -> TimedText {
    TimedText {
        text: annotation.value.trim().to_owned(),
        span: annotation.span,
    }
}

fn phone_of_text(timed: &TimedText) -> SpokenPhone {
    SpokenPhone {
        label: timed.text.clone(),
        span: Some(timed.span),
    }
}

/// Reports whether most labels are sounds of the code; pauses say nothing.
fn are_mostly_phones(code: &CueCode, phones: &[SpokenPhone], alphabet: PhoneAlphabet) -> bool {
    let labels = phones.iter().map(|phone| phone.label.as_str());
    let said: Vec<&str> = labels.filter(|label| !code.is_pause(label)).collect();
    let known = said
        .iter()
        .filter(|label| code.sampa_symbols(label, alphabet).is_some());
    !said.is_empty() && known.count() as f64 >= LEAST_PHONE_SHARE * said.len() as f64
}

/// Returns the alphabet that contains most of the labels; in a tie SAMPA before IPA before MFA.
pub(crate) fn guessed_alphabet(code: &CueCode, phones: &[SpokenPhone]) -> PhoneAlphabet {
    let knows = |alphabet: &PhoneAlphabet| {
        let labels = phones.iter().map(|phone| &phone.label);
        labels
            .filter(|label| code.sampa_symbols(label, *alphabet).is_some())
            .count()
    };
    let rated = PhoneAlphabet::ALL_ALPHABETS
        .iter()
        // Of equal ones the last is taken, so the order is turned for the first alphabet to win.
        .rev()
        .max_by_key(|alphabet| knows(alphabet));
    rated.copied().unwrap_or_default()
}

/// Returns a tier's name without case, accents and punctuation.
fn plain_tier_name(name: &str) -> String {
    let folded = chereme_sign::text::fold_text(name);
    folded.chars().filter(|c| c.is_alphanumeric()).collect()
}

/// Returns whether a tier's name is one that aligners use for phones.
pub(crate) fn is_phone_tier(name: &str) -> bool {
    PHONE_TIERS.iter().any(|known| is_called_like(name, known))
}

fn is_called_like(name: &str, known: &str) -> bool {
    let plain = plain_tier_name(name);
    // Many words end in these letters, so only the whole name counts.
    plain == known || plain.ends_with(known) && known != "mau"
}

/// Returns the wanted tier, or the first one whose name is usual for phones, for words or sentences, or the only one.
fn spoken_tier<'a>(transcript: &'a AnnotationTranscript, wanted: Option<&str>) -> CorpusResult<&'a TranscriptTier> {
    let filled = || transcript.tiers.iter().filter(|tier| !tier.annotations.is_empty());
    let names = || {
        let names: Vec<&str> = transcript.tiers.iter().map(|tier| tier.name.as_str()).collect();
        names.join(", ")
    };
    let chosen_tier = match wanted {
        Some(wanted) => transcript.tiers.iter().find(|tier| tier.name == wanted),
        None => {
            let mut usual = PHONE_TIERS.iter().chain(&TEXT_TIERS);
            let by_name =
                usual.find_map(|known| transcript.tiers.iter().find(|tier| is_called_like(&tier.name, known)));
            by_name.or_else(|| filled().next().filter(|_| filled().count() == 1))
        }
    };
    chosen_tier.ok_or_else(|| match wanted {
        Some(wanted) => CorpusError::from_wrong_message(format!("there is no tier {wanted:?}; there are: {}", names()))
            .with_advice("name one of them"),
        None => CorpusError::from_wrong_message(format!(
            "no tier is called like phones or words; there are: {}",
            names()
        ))
        .with_command_advice("name one with --tier"),
    })
}

/// Inserts a pause into every silence between two phones.
pub(crate) fn with_gaps(phones: Vec<SpokenPhone>) -> Vec<SpokenPhone> {
    let mut spaced: Vec<SpokenPhone> = Vec::with_capacity(phones.len());
    let mut last_end = RecordingInstant::RECORDING_START;
    for phone in phones {
        let Some(span) = phone.span else { continue };
        if span.span_start_instant().instant_micros() - last_end.instant_micros() > SILENCE_MICROS {
            spaced.push(SpokenPhone {
                label: "#".to_owned(),
                span: Some(chereme_motion::TimeSpan::span_between(
                    last_end,
                    span.span_start_instant(),
                )),
            });
        }
        // Phones may overlap, and the pause begins after the last one that ends.
        last_end = last_end.max(span.span_end_instant());
        spaced.push(phone);
    }
    spaced
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cue::{cue_keys_of_file, cue_phones_of_file};

    const PHONES_XRA: &str = "<Document><Tier id=\"a\" tiername=\"PhonAlign\"><Annotation><Location><Interval><Begin midpoint=\"0.5\"/>\
        <End midpoint=\"0.6\"/></Interval></Location><Label><Tag>l</Tag></Label></Annotation><Annotation><Location><Interval>\
        <Begin midpoint=\"0.6\"/><End midpoint=\"0.8\"/></Interval></Location><Label><Tag>O/</Tag></Label></Annotation></Tier></Document>";
    const WORDS_ELAN: &str = "Mots\t\t00:00:00.500\t00:00:00.700\tles\nMots\t\t00:00:00.700\t00:00:01.300\tamis\n";
    const SUBTITLES: &str = "1\n00:00:00,500 --> 00:00:01,300\nLes\namis.\n\n2\n00:00:05,000 --> 00:00:06,000\nfils\n";

    #[test]
    fn phones_words_and_sentences_of_any_annotation_file_give_keys_in_their_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let keys = |name: &str, text: &str, tier: Option<&str>| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).expect("written");
            let found = cue_keys_of_file(&path, tier, &KeysOptions::default())?;
            let keys = found
                .keys
                .iter()
                .map(|key| format!("{}-{}", key.shape, key.placement))
                .collect::<Vec<_>>();
            Ok::<_, CorpusError>((keys.join(" "), found))
        };
        let (found, read) = keys("a.xra", PHONES_XRA, None).expect("keys");
        assert_eq!((found.as_str(), read.alphabet), ("6-chin", Some("sampa")));
        for (name, text) in [("a.elan.txt", WORDS_ELAN), ("a.srt", SUBTITLES)] {
            let (found, read) = keys(name, text, None).expect("keys");
            assert!(found.starts_with("6-throat 2-side 5-mouth"), "{name}: {found}");
            assert_eq!(
                (read.keys[0].start_us, read.keys[2].end_us),
                (Some(500_000), Some(1_300_000)),
                "{name}"
            );
            assert_eq!(read.words[1].text, "amis");
        }
        let (_, read) = keys("a.srt", SUBTITLES, None).expect("keys");
        assert!(read.findings[0].contains("fils{f i l}"), "{:?}", read.findings);
        assert!(read.keys[3].start_us >= Some(5_000_000), "{:?}", read.keys);
        let (phones, _) =
            cue_phones_of_file(&folder.path().join("a.elan.txt"), None, &KeysOptions::default()).expect("phones");
        assert!(phones.starts_with("#=500 l="), "{phones}");
        let error = keys("b.srt", SUBTITLES, Some("Phones")).expect_err("no such tier");
        assert!(error.to_string().contains("there is no tier"), "{error}");
        assert!(keys("b.txt", "neither", None).is_err());
    }

    #[test]
    fn a_dictionary_file_goes_before_the_rules_in_keys_and_in_the_recipe_of_a_cuer() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("own.txt");
        // Tables of Lexique are saved in Latin-1.
        std::fs::write(&path, b"ortho\tphon\nclefs\tklE\n\xe9t\xe9\tet\xa7\nodd\t??\n").expect("written");
        let (dictionary, warning) = read_pronunciation_dictionary(&path, "french").expect("read");
        assert_eq!(dictionary.dictionary_word_count(), 2);
        assert!(warning.expect("a warning").contains("the first is line 4"));
        let reading = KeysOptions {
            dictionary: Some(dictionary),
            ..KeysOptions::default()
        };
        let found = crate::cue::cue_keys("clefs, été", &reading).expect("keys");
        let phones: Vec<&[String]> = found.words.iter().map(|word| word.phones.as_slice()).collect();
        assert_eq!([phones[0].join(" "), phones[1].join(" ")], ["k l E", "e t O~"]);
        std::fs::write(&path, b"nothing").expect("written");
        let error = read_pronunciation_dictionary(&path, "french").expect_err("no words");
        assert!(
            error.error_remedy().is_some() && error.to_string().contains("no line"),
            "{error}"
        );
    }
}
