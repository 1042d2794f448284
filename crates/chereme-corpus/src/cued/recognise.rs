//! Recognition of shapes and placements of captured keys, with confusion tables.

use chereme_analysis::cue::gauss::{Confusion, Recogniser};
use chereme_analysis::cue::session::{Recognisers, examples, find, find_known};
use chereme_sign::Remedy;
use serde::Serialize;

use super::capture::{Cued, cued};
use super::{CuedOptions, key_name, placement_name, rounded};
use crate::Corpus;
use crate::address::Name;
use crate::error::{Error, Result};

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
    pub misread: Vec<Misread>,
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
pub struct Misread {
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
    fn of(confusion: &Confusion, name: impl Fn(u8) -> String) -> Self {
        let mut classes: Vec<u8> = confusion
            .counts
            .keys()
            .flat_map(|(a, b)| [*a, *b])
            .collect();
        classes.sort_unstable();
        classes.dedup();
        let count =
            |own: u8, other: u8| confusion.counts.get(&(own, other)).copied().unwrap_or(0) as u64;
        Self {
            counts: classes
                .iter()
                .map(|own| classes.iter().map(|other| count(*own, *other)).collect())
                .collect(),
            classes: classes.into_iter().map(name).collect(),
            rate: rounded(confusion.rate(), 4),
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
        train: &[Name],
        test: &[Name],
        options: &CuedOptions,
    ) -> Result<CueRecognition> {
        let connection = self.store.read();
        let (train, test): (Vec<Cued>, Vec<Cued>) = if train.is_empty() && test.is_empty() {
            let all = cued(connection, &[], options)?;
            if all.len() < 2 {
                (all, Vec::new())
            } else {
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
            let own = cued(connection, train, options)?;
            let other = if test.is_empty() {
                Vec::new()
            } else {
                cued(connection, test, options)?
            };
            (own, other)
        };
        let names = |of: &[Cued]| {
            of.iter()
                .map(|it| it.take.row.name.clone())
                .collect::<Vec<_>>()
        };
        let (known, shown) = learned(&train)?;
        let same = test.is_empty();
        let tested = if same { &train } else { &test };
        let shown = if same {
            shown
        } else {
            test.iter()
                .map(|it| find_known(&it.followed, &it.keys, &known))
                .collect()
        };
        let pairs: Vec<_> = tested.iter().map(Cued::pair).collect();
        let (shapes, placements) = examples(&pairs, &shown);
        if shapes.is_empty() || placements.is_empty() {
            return Err(
                Error::wrong("no key has a target whose markers are seen").advise(Remedy::command(
                    "restore the hidden markers first: chereme cued CORPUS restore",
                )),
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
                if read != (key.placement, key.shape) && read.0 != 0 && read.1 != 0 {
                    misread.push(Misread {
                        recording: own.take.row.name.clone(),
                        at_us: own.take.micros(shown.hand.frame as f64 / own.take.rate),
                        key: key_name(key.placement, key.shape),
                        read: key_name(read.0, read.1),
                    });
                }
            }
        }
        let confusion = |recogniser: &Recogniser, examples| Confusion::of(recogniser, examples);
        Ok(CueRecognition {
            trained_on: names(&train),
            tested_on: names(tested),
            same,
            shapes: CueConfusion::of(&confusion(&known.shapes, &shapes), |n| n.to_string()),
            placements: CueConfusion::of(&confusion(&known.placements, &placements), |n| {
                placement_name(n).to_owned()
            }),
            misread,
            left_out,
            findings,
        })
    }
}

/// Finds the gestures of takes, and trains recognisers on them.
pub(super) fn learned(
    takes: &[Cued],
) -> Result<(
    Recognisers,
    Vec<Vec<chereme_analysis::cue::session::KeyGestures>>,
)> {
    let pairs: Vec<_> = takes.iter().map(Cued::pair).collect();
    find(&pairs).map_err(|error| {
        Error::wrong(format!("the recognisers cannot learn from these keys: {error}"))
            .advise(Remedy::command("import more takes with keys, or restore their hidden markers first: chereme cued CORPUS restore"))
    })
}
