//! Movements between keys cut from captured takes, and those that a script needs in addition.

use std::collections::BTreeMap;

use chereme_analysis::cue::pca::PrincipalComponents;
use chereme_analysis::cue::rigid::RigidMotion;
use chereme_analysis::cue::session::{CuerRecognisers, KeyGestures, bridge_row_gaps, rigid_set};
use chereme_compose::cue::dikey::{DikeyDictionary, DikeyEnd, KeyTransition};
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::cue::{self, CuedUtterance};
use rusqlite::Connection;
use serde::Serialize;

use super::capture::{KeyedTake, load_keyed_takes};
use super::recognise::train_key_recognisers;
use super::{CuedOptions, placement_name, round_to_decimals};
use crate::Corpus;
use crate::address::RowName;
use crate::cue::KeysOptions;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// The number of components kept for the positions of the hand's markers.
const KEPT_HAND_COMPONENTS: usize = 40;
/// The largest number of frames from which the components are computed.
const MOST_LEARNED: usize = 3000;
/// The lever arm that weighs rotations of the head, in millimetres.
const HEAD_LEVER_ARM_MM: f64 = 100.0;
/// The largest number of frames in a dictionary.
const MAX_DICTIONARY_FRAMES: usize = 1_000_000;
/// The number of different dikeys that 41 keys can form.
const ALL_KINDS: u64 = 1680;

/// Report on a dictionary of movements between keys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DictionaryReport {
    /// The recordings from which it was cut.
    pub recordings: Vec<String>,
    /// How many movements it has.
    pub dikeys: u64,
    /// The number of different pairs of keys among them.
    pub kinds: u64,
    /// The number of different pairs that the keys of French can form.
    pub of: u64,
    /// The mean distance between the positions of markers and their reconstruction from the components, in millimetres.
    pub missed_mm: f64,
    /// The pairs of keys with their counts and sources, the most frequent first.
    pub pairs: Vec<DikeyDictionaryReport>,
    /// Recordings that were left out, with the reason.
    pub left_out: Vec<String>,
    /// The coverage of a script, if one was given.
    pub script: Option<ScriptCoverage>,
}

/// The movements between two keys.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DikeyDictionaryReport {
    /// The keys, such as `side-5>mouth-4`.
    pub pair: String,
    /// How many movements there are.
    pub count: u64,
    /// The recordings and frames from which they were cut.
    pub sources: Vec<String>,
}

/// The coverage of a script by a dictionary.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScriptCoverage {
    /// How many sentences the script has.
    pub sentences: u64,
    /// The number of pairs of keys in it.
    pub pairs: u64,
    /// The share of them that the dictionary has.
    pub covered: f64,
    /// The pairs that it lacks, the most frequent first.
    pub missing: Vec<MissingDikey>,
    /// The sentences that would add the most pairs, best first.
    pub worth: Vec<WorthRecording>,
}

/// A pair of keys that a dictionary lacks.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MissingDikey {
    /// The keys.
    pub pair: String,
    /// How often it occurs in the script.
    pub count: u64,
}

/// A sentence that would add to a dictionary.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct WorthRecording {
    /// The line of the script, from 1.
    pub line: u64,
    /// The sentence.
    pub text: String,
    /// How many new pairs it adds after the sentences before it.
    pub adds: u64,
}

/// Returns the name of a key in a dictionary.
pub(super) fn dikey_end_name(end: DikeyEnd) -> String {
    format!("{}-{}", placement_name(end.placement), end.shape)
}

/// Returns the name of a pair of keys in a dictionary.
pub(super) fn pair_name(from: DikeyEnd, to: DikeyEnd) -> String {
    format!("{}>{}", dikey_end_name(from), dikey_end_name(to))
}

/// The key at rest.
pub(super) const REST_DIKEY_END: DikeyEnd = DikeyEnd { placement: 0, shape: 0 };

/// A dictionary with the data needed to generate movement from it and to read that back.
pub(super) struct DikeyBook {
    pub(super) dictionary: DikeyDictionary,
    pub(super) components: PrincipalComponents,
    pub(super) known: CuerRecognisers,
    pub(super) rate: f64,
    /// The usual positions of the head's rigid markers; empty if no take shows a face.
    pub(super) rigid: Vec<DVec3>,
    recordings: Vec<String>,
    left_out: Vec<String>,
    missed_mm: f64,
}

impl DikeyBook {
    /// Returns the hand's markers in head space and the head's motion, for a row of parameters.
    pub(super) fn hand_places_from_row(&self, row: &[f64]) -> (Vec<DVec3>, RigidMotion) {
        let keep = self.components.directions.len();
        let flat = self.components.rebuild_component_row(&row[..keep]);
        let points = flat.chunks_exact(3).map(|at| DVec3::new(at[0], at[1], at[2]));
        let head_values = &row[keep..];
        let head = RigidMotion {
            rotation: DQuat::from_scaled_axis(
                DVec3::new(head_values[0], head_values[1], head_values[2]) / HEAD_LEVER_ARM_MM,
            ),
            translation: DVec3::new(head_values[3], head_values[4], head_values[5]),
        };
        (points.collect(), head)
    }
}

impl Corpus {
    /// Returns the dictionary of movements between keys from captured takes, and the pairs that a script lacks; the
    /// script is a text with one sentence per line.
    ///
    /// # Errors
    /// Fails if no recording has a cuer's markers and keys, if they are too few, if the script cannot be read, or if
    /// `progress` stops the work.
    pub fn cue_dictionary(
        &self,
        recordings: &[RowName],
        script: Option<&str>,
        options: &CuedOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DictionaryReport> {
        let book = cut_dikey_book(self.store.read_connection(), recordings, options, progress)?;
        let mut pairs: BTreeMap<(DikeyEnd, DikeyEnd), Vec<String>> = BTreeMap::new();
        for dikey in book.dictionary.dictionary_dikeys() {
            pairs
                .entry((dikey.from, dikey.to))
                .or_default()
                .push(dikey.source.clone());
        }
        let mut pairs: Vec<DikeyDictionaryReport> = pairs
            .into_iter()
            .map(|((from, to), sources)| DikeyDictionaryReport {
                pair: pair_name(from, to),
                count: sources.len() as u64,
                sources,
            })
            .collect();
        pairs.sort_by(|a, b| b.count.cmp(&a.count).then(a.pair.cmp(&b.pair)));
        Ok(DictionaryReport {
            dikeys: book.dictionary.dictionary_dikeys().len() as u64,
            kinds: book.dictionary.count_dikey_kinds() as u64,
            of: ALL_KINDS,
            missed_mm: round_to_decimals(book.missed_mm, 2),
            script: script
                .map(|script| coverage(&book.dictionary, script, options))
                .transpose()?,
            pairs,
            recordings: book.recordings,
            left_out: book.left_out,
        })
    }
}

/// The largest number of sentences that are listed as worth recording.
const MOST_WORTH: usize = 20;

fn coverage(dictionary: &DikeyDictionary, script: &str, options: &CuedOptions) -> CorpusResult<ScriptCoverage> {
    let reading = KeysOptions {
        code: options.code.clone(),
        variants: options.variants.clone(),
        ..KeysOptions::default()
    };
    let mut lines = Vec::new();
    for (line, text) in (1u64..).zip(script.lines()) {
        let text = text.trim();
        if text.is_empty() {
            continue;
        }
        let read = CuedUtterance::read_cued_utterance(text, &reading).map_err(|error| {
            CorpusError::from_wrong_message(error.to_string())
                .with_error_place(format!("line {line}"))
                .with_advice(error.utterance_error_remedy())
        })?;
        if read.keys.is_empty() {
            continue;
        }
        let keys = read.keys.iter().filter_map(|key| {
            let placement = u8::try_from(cue::placement_number(&key.placement)).ok()?;
            Some(DikeyEnd {
                placement,
                shape: key.shape,
            })
        });
        // Each sentence begins from the hand at rest, which makes a pair with its first key.
        let keys: Vec<DikeyEnd> = [REST_DIKEY_END].into_iter().chain(keys).collect();
        lines.push((line, text, keys));
    }
    let keys: Vec<Vec<DikeyEnd>> = lines.iter().map(|line| line.2.clone()).collect();
    let pairs: u64 = keys.iter().map(|keys| keys.len() as u64 - 1).sum();
    let missing = dictionary.missing_dikeys(&keys);
    let lacking: usize = missing.values().sum();
    let mut missing: Vec<MissingDikey> = missing
        .into_iter()
        .map(|((from, to), count)| MissingDikey {
            pair: pair_name(from, to),
            count: count as u64,
        })
        .collect();
    missing.sort_by(|a, b| b.count.cmp(&a.count).then(a.pair.cmp(&b.pair)));
    let worth = dictionary.worth_recording(&keys, MOST_WORTH);
    Ok(ScriptCoverage {
        sentences: lines.len() as u64,
        pairs,
        covered: round_to_decimals(1.0 - lacking as f64 / pairs.max(1) as f64, 4),
        missing,
        worth: worth
            .into_iter()
            .map(|(n, adds)| WorthRecording {
                line: lines[n].0,
                text: lines[n].1.to_owned(),
                adds: adds as u64,
            })
            .collect(),
    })
}

/// Cuts the dictionary from captured takes.
pub(super) fn cut_dikey_book(
    connection: &Connection,
    recordings: &[RowName],
    options: &CuedOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<DikeyBook> {
    let mut takes = load_keyed_takes(connection, recordings, options)?;
    // Movements of other rates cannot be joined frame by frame; the first take decides.
    let rate = takes[0].take.rate;
    let mut left_out = Vec::new();
    takes.retain(|own| {
        let same = (own.take.rate / rate - 1.0).abs() < 1e-3;
        if !same {
            left_out.push(format!(
                "{}: {} frames a second, others have {rate}",
                own.take.row.name, own.take.rate
            ));
        }
        same
    });
    let total: usize = takes.iter().map(|own| own.take.take_frame_count()).sum();
    if total > MAX_DICTIONARY_FRAMES {
        return Err(CorpusError::from_wrong_message(format!(
            "the takes have {total} frames; a dictionary holds {MAX_DICTIONARY_FRAMES}"
        ))
        .with_advice("name fewer recordings"));
    }
    let (known, shown) = train_key_recognisers(&takes)?;
    let faces = takes.iter().filter(|own| own.take.has_face());
    let rigid = rigid_set(faces.flat_map(|own| own.take.face.iter())).unwrap_or_default();
    let mut all = Vec::new();
    for (n, own) in takes.iter().enumerate() {
        progress.report_items(&own.take.row.name, n, takes.len())?;
        all.push(in_head(own));
    }
    let flat: Vec<&Vec<f64>> = all.iter().flatten().flatten().map(|(hand, _)| hand).collect();
    if flat.len() < 20 {
        return Err(
            CorpusError::from_wrong_message("too few frames show every marker of the hand and the head")
                .with_command_advice("restore the hidden markers first: chereme cued CORPUS restore"),
        );
    }
    // Components change little with more frames; evenly spaced ones stand for all takes.
    let step = flat.len().div_ceil(MOST_LEARNED).max(1);
    let some: Vec<Vec<f64>> = flat.iter().step_by(step).map(|row| (*row).clone()).collect();
    let components = PrincipalComponents::fit_principal_components(&some, KEPT_HAND_COMPONENTS, 0)
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let missed = some
        .iter()
        .map(|row| projection_error_mm(&components, row))
        .sum::<f64>()
        / some.len() as f64;
    let mut dikeys: Vec<KeyTransition> = Vec::new();
    let (mut sums, mut used) = (BTreeMap::new(), Vec::new());
    for ((own, rows), shown) in takes.iter().zip(&all).zip(&shown) {
        if shown.is_empty() {
            left_out.push(format!("{}: its keys have no room in its frames", own.take.row.name));
            continue;
        }
        let parameters: Vec<Vec<f64>> = rows
            .iter()
            .map(|row| match row {
                Some((hand, head)) => {
                    let mut parameters = components.project_component_row(hand);
                    parameters.extend(head);
                    parameters
                }
                // An empty row breaks the take where markers are hidden, and no movement is cut across it.
                None => Vec::new(),
            })
            .collect();
        let goals = find_key_arrivals(own, shown);
        for (key, frame) in &goals {
            if let Some(tip) = own.followed.head_space_fingertip(key.shape, *frame) {
                let sum = sums.entry(key.placement).or_insert((DVec3::ZERO, 0.0));
                sum.0 += tip;
                sum.1 += 1.0;
            }
        }
        dikeys.extend(DikeyDictionary::cut_dikeys(&parameters, &goals, &own.take.row.name));
        used.push(own.take.row.name.clone());
    }
    let places = sums
        .into_iter()
        .map(|(place, (sum, count)): (u8, (DVec3, f64))| (place, (sum / count).to_array()));
    let mut weights = components.variances.clone();
    weights.extend(head_variances(&all));
    Ok(DikeyBook {
        dictionary: DikeyDictionary::new(dikeys, rate, &weights, places.collect()),
        components,
        known,
        rate,
        rigid,
        recordings: used,
        left_out,
        missed_mm: missed,
    })
}

/// The positions of the hand's markers in head space, one coordinate after another, and the head's motion.
type HeadRow = Option<(Vec<f64>, [f64; 6])>;

fn in_head(own: &KeyedTake) -> Vec<HeadRow> {
    let frames = own.take.take_frame_count();
    let heads = &own.followed.head;
    let markers = own.take.hand_points.len();
    // Gaps of up to a quarter of a second are short enough to be bridged by a line.
    let most = (0.25 * own.take.rate) as usize;
    let mut columns: Vec<Vec<Option<DVec3>>> = (0..markers)
        .map(|marker| {
            let places = own.take.hand.iter().zip(heads);
            places
                .map(|(frame, head)| Some(head.as_ref()?.undo_rigid_motion(frame[marker]?)))
                .collect()
        })
        .collect();
    for column in &mut columns {
        bridge_row_gaps(column, most, |a: DVec3, b: DVec3, share| a.lerp(b, share));
    }
    (0..frames)
        .map(|frame| {
            let mut row = Vec::with_capacity(3 * markers);
            for column in &columns {
                row.extend(column[frame]?.to_array());
            }
            let head = heads[frame]?;
            // The lever turns radians into millimetres, so that turns and shifts weigh alike.
            let turn = head.rotation.to_scaled_axis() * HEAD_LEVER_ARM_MM;
            let [a, b, c] = turn.to_array();
            let [x, y, z] = head.translation.to_array();
            Some((row, [a, b, c, x, y, z]))
        })
        .collect()
}

fn head_variances(all: &[Vec<HeadRow>]) -> [f64; 6] {
    let rows: Vec<[f64; 6]> = all.iter().flatten().flatten().map(|(_, head)| *head).collect();
    let count = rows.len().max(1) as f64;
    std::array::from_fn(|k| {
        let mean = rows.iter().map(|row| row[k]).sum::<f64>() / count;
        rows.iter().map(|row| (row[k] - mean).powi(2)).sum::<f64>() / count
    })
}

fn projection_error_mm(components: &PrincipalComponents, row: &[f64]) -> f64 {
    let predicted = components.rebuild_component_row(&components.project_component_row(row));
    let apart = row.chunks_exact(3).zip(predicted.chunks_exact(3));
    let sum: f64 = apart
        .map(|(a, b)| a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt())
        .sum();
    sum / (row.len() / 3).max(1) as f64
}

/// Returns the keys of a take with the frames of the hand's arrival, including the rest before the first movement.
fn find_key_arrivals(own: &KeyedTake, shown: &[KeyGestures]) -> Vec<(DikeyEnd, usize)> {
    let frame_of = |seconds: f64| (seconds * own.take.rate).round().max(0.0) as usize;
    let last = own.take.take_frame_count().saturating_sub(1);
    let mut goals: Vec<(DikeyEnd, usize)> = Vec::with_capacity(shown.len() + 1);
    if let Some(first) = shown.first().filter(|first| first.hand.measured) {
        goals.push((REST_DIKEY_END, frame_of(first.hand.movement.start).min(last)));
    }
    for (key, shown) in own.keys.iter().zip(shown) {
        // A key whose hand hardly moves has no arrival; its target stands for it.
        let arrived = if shown.hand.measured {
            frame_of(shown.hand.movement.end)
        } else {
            shown.hand.frame
        };
        // Each movement needs at least a frame between its ends.
        let least = goals.last().map_or(0, |(_, frame)| frame + 2);
        let end = DikeyEnd {
            placement: key.placement,
            shape: key.shape,
        };
        goals.push((end, arrived.max(least).min(last)));
    }
    goals
}
