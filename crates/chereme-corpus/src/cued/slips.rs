//! Comparison of produced and predicted keys of a take: insertions, deletions, and substitutions of shape or placement.

use chereme_analysis::cue::session::ExpectedCueKey;
use chereme_sign::cue::{self, CuedUtterance, SpokenPhone, UtteranceError};
use serde::Serialize;

use super::capture::{key_tier, keys_from_timed_utterance, load_cuer_take, load_keyed_takes, load_recording_phones};
use super::recognise::train_key_recognisers;
use super::{CuedOptions, cue_key_name};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::cue::KeysOptions;
use crate::error::{CorpusError, CorpusResult};

/// The slips of a take.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CueSlips {
    /// The name of the recording.
    pub recording: String,
    /// The source of the produced keys: `tier` if somebody annotated them, `recognised` from markers.
    pub produced_by: &'static str,
    /// The source of the predicted keys: `phones` or `text`.
    pub predicted_by: &'static str,
    /// How many keys were produced.
    pub produced: u64,
    /// How many keys were predicted.
    pub predicted: u64,
    /// How many are as predicted.
    pub right: u64,
    /// The differences, in order.
    pub slips: Vec<CueSlip>,
}

/// The kind of a slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SlipKind {
    /// A superfluous key.
    Insertion,
    /// A key that is missing.
    Deletion,
    /// The hand is at another placement.
    Placement,
    /// The fingers have another shape.
    Shape,
    /// Both differ.
    Both,
}

impl SlipKind {
    /// Returns the name of the kind.
    #[must_use]
    pub fn slip_kind_name(self) -> &'static str {
        match self {
            Self::Insertion => "insertion",
            Self::Deletion => "deletion",
            Self::Placement => "placement",
            Self::Shape => "shape",
            Self::Both => "both",
        }
    }
}

/// A difference between produced and predicted keys.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CueSlip {
    /// The difference.
    pub kind: SlipKind,
    /// Its time, in microseconds; nothing for a missing key whose time is unknown.
    pub at_us: Option<i64>,
    /// The key that was predicted; nothing for an insertion.
    pub predicted: Option<String>,
    /// The key that was produced; nothing for a deletion.
    pub produced: Option<String>,
}

/// The length of the longest sequences that are compared.
const MAX_COMPARED_KEYS: usize = 5_000;

impl Corpus {
    /// Compares the keys that a take shows with those that its phones, or a text, predict.
    ///
    /// Produced keys are those of its tier of keys. Without one, or with `recognised`, they are those that the
    /// recognisers read at the targets of the keys of its phones: of these keys themselves only substitutions are found,
    /// of the keys of a text all slips.
    ///
    /// # Errors
    /// Fails if there is no such recording, neither phones nor a text predict keys, or a key cannot be read.
    pub fn cue_slips(
        &self,
        recording: &RowName,
        text: Option<&str>,
        recognised: bool,
        options: &CuedOptions,
    ) -> CorpusResult<CueSlips> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        let name = row.name.clone();
        let code = options.load_cue_code()?;
        let (expected, predicted_by) = match text {
            Some(text) => {
                let reading = KeysOptions {
                    code: options.code.clone(),
                    variants: options.variants.clone(),
                    ..KeysOptions::default()
                };
                let fault = |error: UtteranceError| {
                    CorpusError::from_wrong_message(error.to_string()).with_advice(error.utterance_error_remedy())
                };
                let read = CuedUtterance::read_cued_utterance(text, &reading).map_err(fault)?;
                (untimed(&read), "text")
            }
            None => {
                let timed_phones: Option<(Vec<SpokenPhone>, _)> = load_recording_phones(connection, row.id, &code)?;
                let Some((phones, alphabet)) = timed_phones else {
                    return Err(
                        CorpusError::from_wrong_message(format!("{name:?} has no tier of phones"))
                            .with_error_place(name)
                            .with_command_advice(
                                "give the text with --text, or import an alignment with a tier called Phones",
                            ),
                    );
                };
                let read = CuedUtterance::of_phones(code.clone(), phones, alphabet);
                (
                    keys_from_timed_utterance(&read, 0.0)
                        .into_iter()
                        .map(ExpectedKey::from_expected_key)
                        .collect(),
                    "phones",
                )
            }
        };
        let annotated = match recognised {
            true => None,
            false => key_tier(connection, &row, &code)?.filter(|keys| !keys.is_empty()),
        };
        let mut report = CueSlips {
            recording: name.clone(),
            produced_by: "tier",
            predicted_by,
            produced: 0,
            predicted: expected.len() as u64,
            right: 0,
            slips: Vec::new(),
        };
        let comparable = |produced: Vec<ProducedKey>| match produced.len().max(expected.len()) {
            0..=MAX_COMPARED_KEYS => Ok(produced),
            count => Err(
                CorpusError::from_wrong_message(format!("{count} keys are too many to compare"))
                    .with_error_place(name.clone())
                    .with_advice("cut the recording into shorter takes"),
            ),
        };
        if let Some(keys) = annotated {
            // Placement 0 is the hand at rest, which is no produced key.
            let shown = keys.iter().filter(|key| key.placement > 0);
            let produced_keys = shown.map(|key| (key.placement, key.shape, key.row.start_us));
            let produced = comparable(produced_keys.collect())?;
            report.produced = produced.len() as u64;
            (report.right, report.slips) = align_key_sequences(&expected, &produced);
            return Ok(report);
        }
        report.produced_by = "recognised";
        // Its error says what the take itself lacks; a search through all takes would only miss it.
        load_cuer_take(connection, row, options)?;
        // The recognisers learn from all takes, as one rarely shows every key often enough.
        let takes = load_keyed_takes(connection, &[], options)?;
        let (_, shown) = train_key_recognisers(&takes)?;
        let matching_take = takes.iter().zip(&shown).find(|(own, _)| own.take.row.name == name);
        let Some((own, shown)) = matching_take else {
            return Err(
                CorpusError::from_wrong_message(format!("{name:?} has no keys or phones to look for"))
                    .with_error_place(name)
                    .with_advice("import an alignment with a tier called Phones"),
            );
        };
        let produced = shown.iter().map(|shown| {
            let hand_micros = own.take.take_time_micros(shown.hand.frame as f64 / own.take.rate);
            (shown.hand.recognised, shown.fingers.recognised, hand_micros)
        });
        let produced = comparable(produced.collect())?;
        report.produced = produced.len() as u64;
        // Keys that were looked for at the predicted ones answer them one by one.
        let looked_for = own.keys.iter().map(|key| (key.placement, key.shape));
        let is_paired =
            produced.len() == expected.len() && looked_for.eq(expected.iter().map(ExpectedKey::expected_key_parts));
        (report.right, report.slips) = match is_paired {
            true => compare_paired_keys(&expected, &produced),
            false => align_key_sequences(&expected, &produced),
        };
        Ok(report)
    }
}

/// A predicted key: placement, shape, and its start in microseconds if it is known.
struct ExpectedKey {
    placement: u8,
    shape: u8,
    at: Option<i64>,
}

impl ExpectedKey {
    fn from_expected_key(key: ExpectedCueKey) -> Self {
        Self {
            placement: key.placement,
            shape: key.shape,
            at: Some((key.a1 * 1e6).round() as i64),
        }
    }

    fn expected_key_parts(&self) -> (u8, u8) {
        (self.placement, self.shape)
    }
}

/// Compares each predicted key with the produced one of the same number.
fn compare_paired_keys(expected: &[ExpectedKey], produced: &[ProducedKey]) -> (u64, Vec<CueSlip>) {
    let pairs = expected.iter().zip(produced);
    let slips: Vec<CueSlip> = pairs.filter_map(|(own, other)| substitution(own, *other)).collect();
    ((expected.len() - slips.len()) as u64, slips)
}

/// Returns the slip between a predicted and a produced key; `None` if they are equal.
fn substitution(own: &ExpectedKey, other: ProducedKey) -> Option<CueSlip> {
    Some(CueSlip {
        kind: classify_key_slip(own.expected_key_parts(), (other.0, other.1))?,
        at_us: Some(other.2),
        predicted: Some(cue_key_name(own.placement, own.shape)),
        produced: Some(cue_key_name(other.0, other.1)),
    })
}

fn untimed(read: &CuedUtterance) -> Vec<ExpectedKey> {
    let keys = read.keys.iter().filter_map(|key| {
        Some(ExpectedKey {
            placement: u8::try_from(cue::placement_number(&key.placement)).ok()?,
            shape: key.shape,
            at: None,
        })
    });
    keys.collect()
}

/// A produced key: placement, shape, and its start in microseconds.
type ProducedKey = (u8, u8, i64);

fn classify_key_slip(expected: (u8, u8), produced: (u8, u8)) -> Option<SlipKind> {
    match (expected.0 == produced.0, expected.1 == produced.1) {
        (true, true) => None,
        (false, true) => Some(SlipKind::Placement),
        (true, false) => Some(SlipKind::Shape),
        (false, false) => Some(SlipKind::Both),
    }
}

/// Aligns both sequences at the least cost: half for each part of a key that differs, 0.7 for a superfluous or missing
/// key.
fn align_key_sequences(expected: &[ExpectedKey], produced: &[ProducedKey]) -> (u64, Vec<CueSlip>) {
    const KEY_GAP_COST: f32 = 0.7;
    let width = produced.len() + 1;
    let mut costs = vec![0.0f32; (expected.len() + 1) * width];
    let differs = |i: usize, j: usize| {
        let (own, other) = (&expected[i], produced[j]);
        0.5 * f32::from(u8::from(own.placement != other.0) + u8::from(own.shape != other.1))
    };
    for i in 0..=expected.len() {
        for j in 0..=produced.len() {
            costs[i * width + j] = match (i, j) {
                (0, _) => j as f32 * KEY_GAP_COST,
                (_, 0) => i as f32 * KEY_GAP_COST,
                _ => {
                    let both = costs[(i - 1) * width + j - 1] + differs(i - 1, j - 1);
                    let gap = costs[(i - 1) * width + j].min(costs[i * width + j - 1]) + KEY_GAP_COST;
                    both.min(gap)
                }
            };
        }
    }
    // The path is read from its end, so that the slips come out backwards.
    let (mut i, mut j) = (expected.len(), produced.len());
    let (mut right, mut slips) = (0, Vec::new());
    while i > 0 || j > 0 {
        let here = costs[i * width + j];
        // Costs are sums of floats, and equal ones may differ in their last digits.
        let near = |value: f32| (here - value).abs() < 1e-4;
        if i > 0 && j > 0 && near(costs[(i - 1) * width + j - 1] + differs(i - 1, j - 1)) {
            (i, j) = (i - 1, j - 1);
            match substitution(&expected[i], produced[j]) {
                None => right += 1,
                Some(slip) => slips.push(slip),
            }
        } else if i > 0 && near(costs[(i - 1) * width + j] + KEY_GAP_COST) {
            i -= 1;
            slips.push(CueSlip {
                kind: SlipKind::Deletion,
                at_us: expected[i].at,
                predicted: Some(cue_key_name(expected[i].placement, expected[i].shape)),
                produced: None,
            });
        } else {
            j -= 1;
            slips.push(CueSlip {
                kind: SlipKind::Insertion,
                at_us: Some(produced[j].2),
                predicted: None,
                produced: Some(cue_key_name(produced[j].0, produced[j].1)),
            });
        }
    }
    slips.reverse();
    (right, slips)
}

impl CueSlips {
    /// Returns the number of slips of a kind.
    #[must_use]
    pub fn count_slips_of(&self, kind: SlipKind) -> usize {
        self.slips.iter().filter(|slip| slip.kind == kind).count()
    }
}

#[cfg(test)]
mod tests {
    use chereme_analysis::cue::session::KeySounds;

    use super::*;

    fn keys(text: &str) -> Vec<(u8, u8)> {
        let digit = |letter: Option<char>| letter.and_then(|it| it.to_digit(10)).unwrap_or(0) as u8;
        text.split(' ')
            .map(|word| (digit(word.chars().next()), digit(word.chars().nth(1))))
            .collect()
    }

    #[test]
    fn slips_are_omissions_insertions_and_substitutions() {
        let expected: Vec<ExpectedKey> = keys("16 16 31 13 24 55")
            .into_iter()
            .map(|(placement, shape)| ExpectedKey {
                placement,
                shape,
                at: Some(0),
            })
            .collect();
        let produced: Vec<ProducedKey> = keys("16 31 53 24 22 55").into_iter().map(|(a, b)| (a, b, 7)).collect();
        let (right, slips) = align_key_sequences(&expected, &produced);
        assert_eq!(right, 4);
        let kinds: Vec<SlipKind> = slips.iter().map(|slip| slip.kind).collect();
        assert_eq!(kinds, [SlipKind::Deletion, SlipKind::Placement, SlipKind::Insertion]);
        assert_eq!(align_key_sequences(&[], &[]), (0, Vec::new()));
        assert_eq!(align_key_sequences(&expected, &[]).1.len(), 6);
    }

    /// Returns the slips of a recording against the text "papa": one second of the given keys on a tier.
    fn against_papa(keys: [&str; 3]) -> CorpusResult<CueSlips> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("take.TextGrid");
        let intervals = keys.iter().enumerate();
        let intervals = intervals.map(|(n, key)| format!("{n}\n{}\n\"{key}\"\n", n + 1));
        let intervals: String = intervals.collect();
        let text = format!(
            "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n3\n<exists>\n1\n\"IntervalTier\"\n\"Keys\"\n0\n3\n3\n{intervals}"
        );
        std::fs::write(&path, text).expect("written");
        let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
        let mut hear = crate::ignore_progress_step;
        let mut progress = crate::ProgressReceiver::new(&mut hear);
        let done = corpus.import_paths(&[path], &crate::ImportOptions::default(), &mut progress);
        done.expect("taken in");
        let take = RowName::Text("take".to_owned());
        corpus.cue_slips(&take, Some("papa"), false, &CuedOptions::default())
    }

    #[test]
    fn keys_of_a_tier_are_read_in_each_notation_and_no_key_is_an_error() {
        for keys in [
            ["cue:side-1", "", "cue:side-1"],
            ["side-1", "#", "side-1"],
            ["1-s", "", "1-s"],
            ["11", "00", "11"],
        ] {
            let slips = against_papa(keys).expect("keys");
            assert_eq!((slips.right, slips.produced, slips.slips.len()), (2, 2, 0), "{keys:?}");
        }
        let slips = against_papa(["24", "1-s", "chin-1"]).expect("keys");
        assert_eq!((slips.right, slips.produced), (1, 3));
        for keys in [["pa", "pa", ""], ["11", "pa", "x"]] {
            let error = against_papa(keys).expect_err("no keys");
            assert!(
                error.to_string().contains("\"pa\" on the tier Keys is no key"),
                "{error}"
            );
        }
    }

    #[test]
    fn kinds_have_words() {
        let all = [
            SlipKind::Insertion,
            SlipKind::Deletion,
            SlipKind::Placement,
            SlipKind::Shape,
            SlipKind::Both,
        ];
        let words: std::collections::BTreeSet<&str> = all.iter().map(|kind| kind.slip_kind_name()).collect();
        assert_eq!(words.len(), all.len());
        assert_eq!(
            KeySounds::ALL_KEY_SOUNDS.map(KeySounds::key_sounds_name),
            ["pair", "vowel", "consonant"]
        );
    }
}
