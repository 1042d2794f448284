//! Recognition of shapes and placements of captured keys, with confusion tables.

use chereme_analysis::cue::gauss::{GaussianRecogniser, RecognitionConfusion};
use chereme_analysis::cue::session::{CuerRecognisers, collect_target_examples, find_key_gestures, find_known};
use serde::Serialize;

use super::capture::{KeyedTake, load_keyed_takes};
use super::{CuedOptions, cue_key_name, placement_name, round_to_decimals};
use crate::Corpus;
use crate::address::RowName;
use crate::error::{CorpusError, CorpusResult};

/// Results of the recognition of shapes and placements.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CueRecognition {
    /// The recordings from which the recognisers learned.
    pub trained_on: Vec<String>,
    /// The recordings whose keys were recognised.
    pub tested_on: Vec<String>,
    /// Whether some of the recognised keys also served for learning.
    pub same: bool,
    /// Shapes.
    pub shapes: CueConfusion,
    /// Placements.
    pub placements: CueConfusion,
    /// The keys that were recognised as others.
    pub misread: Vec<MisreadKey>,
    /// Takes without enough frames for their keys.
    pub left_out: Vec<String>,
    /// What hidden markers cost.
    pub findings: Vec<String>,
}

/// Confusion table: how often each class was recognised as each.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CueConfusion {
    /// The classes, in order.
    pub classes: Vec<String>,
    /// For each true class, how often it was recognised as each class.
    pub counts: Vec<Vec<u64>>,
    /// The share of correct recognitions.
    pub rate: f64,
}

/// A key that was recognised as another.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MisreadKey {
    /// The name of the recording.
    pub recording: String,
    /// The time of its target, in microseconds.
    pub at_us: i64,
    /// The key that should be shown.
    pub key: String,
    /// The key that was recognised.
    pub read: String,
}

impl CueConfusion {
    fn from_named_confusion(confusion: &RecognitionConfusion, name: impl Fn(u8) -> String) -> Self {
        let mut classes: Vec<u8> = confusion.counts.keys().flat_map(|(a, b)| [*a, *b]).collect();
        classes.sort_unstable();
        classes.dedup();
        let count = |own: u8, other: u8| confusion.counts.get(&(own, other)).copied().unwrap_or(0) as u64;
        Self {
            counts: classes
                .iter()
                .map(|own| classes.iter().map(|other| count(*own, *other)).collect())
                .collect(),
            classes: classes.into_iter().map(name).collect(),
            rate: round_to_decimals(confusion.correct_recognition_rate(), 4),
        }
    }
}

impl Corpus {
    /// Recognises the shapes and placements of captured keys at their targets.
    ///
    /// The recognisers learn from the recordings `train` and are tested on `test`; without names they learn from and
    /// are tested on every second recording each, in order.
    ///
    /// # Errors
    /// Fails if no recording has a cuer's markers and keys, or they are too few.
    pub fn recognise_cues(
        &self,
        train: &[RowName],
        test: &[RowName],
        options: &CuedOptions,
    ) -> CorpusResult<CueRecognition> {
        let connection = self.store.read_connection();
        let (train, test): (Vec<KeyedTake>, Vec<KeyedTake>) = if train.is_empty() && test.is_empty() {
            let all = load_keyed_takes(connection, &[], options)?;
            if all.len() < 2 {
                (all, Vec::new())
            } else {
                // Every second take, so that learning and test both span all sessions.
                let mut parts = (Vec::new(), Vec::new());
                for (n, one) in all.into_iter().enumerate() {
                    if n % 2 == 0 {
                        parts.0.push(one)
                    } else {
                        parts.1.push(one)
                    }
                }
                parts
            }
        } else {
            let training_takes = load_keyed_takes(connection, train, options)?;
            let other = if test.is_empty() {
                Vec::new()
            } else {
                load_keyed_takes(connection, test, options)?
            };
            (training_takes, other)
        };
        let names = |of: &[KeyedTake]| of.iter().map(|entry| entry.take.row.name.clone()).collect::<Vec<_>>();
        let (known, shown) = train_key_recognisers(&train)?;
        let same = test.is_empty();
        let tested = if same { &train } else { &test };
        let shown = if same {
            shown
        } else {
            test.iter()
                .map(|entry| find_known(&entry.followed, &entry.keys, &known))
                .collect()
        };
        let pairs: Vec<_> = tested.iter().map(KeyedTake::followed_with_keys).collect();
        let (shapes, placements) = collect_target_examples(&pairs, &shown);
        if shapes.is_empty() || placements.is_empty() {
            return Err(
                CorpusError::from_wrong_message("no key has a target whose markers are seen")
                    .with_command_advice("restore the hidden markers first: chereme cued CORPUS restore"),
            );
        }
        let keys: usize = shown.iter().map(Vec::len).sum();
        let unread = [&shapes, &placements].map(|read| keys - read.len().min(keys));
        let mut findings = Vec::new();
        if unread != [0, 0] {
            findings.push(format!(
                "markers are hidden at the targets: {} of {keys} shapes and {} placements are not read and count in no rate; \
                 chereme cued CORPUS restore restores the markers",
                unread[0], unread[1]
            ));
        }
        let (mut misread, mut left_out) = (Vec::new(), Vec::new());
        for (own, shown) in tested.iter().zip(&shown) {
            if shown.is_empty() {
                left_out.push(own.take.row.name.clone());
            }
            for (key, shown) in own.keys.iter().zip(shown) {
                let read = (shown.hand.recognised, shown.fingers.recognised);
                // A part that nobody could read has the number 0, and is hidden rather than misread.
                if read != (key.placement, key.shape) && read.0 != 0 && read.1 != 0 {
                    misread.push(MisreadKey {
                        recording: own.take.row.name.clone(),
                        at_us: own.take.take_time_micros(shown.hand.frame as f64 / own.take.rate),
                        key: cue_key_name(key.placement, key.shape),
                        read: cue_key_name(read.0, read.1),
                    });
                }
            }
        }
        let confusion =
            |recogniser: &GaussianRecogniser, examples| RecognitionConfusion::count_confusions(recogniser, examples);
        Ok(CueRecognition {
            trained_on: names(&train),
            tested_on: names(tested),
            same,
            shapes: CueConfusion::from_named_confusion(&confusion(&known.shapes, &shapes), |n| n.to_string()),
            placements: CueConfusion::from_named_confusion(&confusion(&known.placements, &placements), |n| {
                placement_name(n).to_owned()
            }),
            misread,
            left_out,
            findings,
        })
    }
}

/// Finds the gestures of takes, and trains recognisers on them.
pub(super) fn train_key_recognisers(
    takes: &[KeyedTake],
) -> CorpusResult<(CuerRecognisers, Vec<Vec<chereme_analysis::cue::session::KeyGestures>>)> {
    let pairs: Vec<_> = takes.iter().map(KeyedTake::followed_with_keys).collect();
    find_key_gestures(&pairs).map_err(|error| {
        CorpusError::from_wrong_message(format!("the recognisers cannot learn from these keys: {error}"))
            .with_command_advice(
                "import more takes with keys, or restore their hidden markers first: chereme cued CORPUS restore",
            )
    })
}
