//! Finds the movements and targets of captured keys, writes them as tiers, and computes statistics of their phases.

use std::fmt::Write as _;
use std::path::Path;

use chereme_analysis::cue::cue_phases::measure_key_phases;
use chereme_analysis::cue::cue_targets::GestureQuartiles;
use chereme_analysis::cue::session::{KeyGestures, KeySounds, MeasuredGesture};
use chereme_compose::CueTier;
use chereme_sign::TierRole;
use rusqlite::Connection;
use serde::Serialize;

use super::capture::{KeyedTake, load_keyed_takes};
use super::recognise::train_key_recognisers;
use super::{CuedOptions, cue_key_name, round_to_decimals};
use crate::Corpus;
use crate::address::RowName;
use crate::atomic_write;
use crate::db::edits;
use crate::db::stored_columns::{AnnotationOrigin, ValueState};
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::CorpusResult;
use crate::words::effect::OperationEffect;

/// The targets of the keys of a take.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CueTargets {
    /// The name of the recording.
    pub recording: String,
    /// The keys in order; empty if the take has too few frames for them.
    pub keys: Vec<FoundKey>,
    /// The tiers that were written.
    pub tiers: Vec<String>,
    /// What is only a guess.
    pub findings: Vec<String>,
}

/// A key with its movements, in microseconds of the recording's clock.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundKey {
    /// The key, such as `mouth-4`.
    pub key: String,
    /// Its sounds: `pair`, `vowel` or `consonant`.
    pub kind: &'static str,
    /// The start of its first sound.
    pub a1_us: i64,
    /// The hand's movement to the target; nothing if it is too short or unclear, or if the placement stays the same.
    pub hand_us: Option<[i64; 2]>,
    /// The fingers' movement.
    pub fingers_us: Option<[i64; 2]>,
    /// The frame of the target.
    pub target_us: i64,
    /// The logarithm of the probability of the right placement at the target.
    pub placement_log: f64,
    /// The logarithm of the probability of the right shape.
    pub shape_log: f64,
    /// The time in which the right placement is the most probable one.
    pub placement_extent_us: Option<[i64; 2]>,
    /// The time in which the right shape is the most probable one.
    pub shape_extent_us: Option<[i64; 2]>,
}

/// The times at which hands and fingers begin and arrive relative to the sounds of keys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CuePhaseStatistics {
    /// The names of the recordings.
    pub recordings: Vec<String>,
    /// How many keys they have.
    pub keys: u64,
    /// The statistics, by kind of key.
    pub rows: Vec<CuePhaseRow>,
    /// What is only a guess.
    pub findings: Vec<String>,
}

/// The times at which the hand or the fingers begin and arrive, for keys of one kind.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CuePhaseRow {
    /// `hand` or `fingers`.
    pub part: &'static str,
    /// The sounds of the keys: `pair`, `vowel` or `consonant`.
    pub kind: &'static str,
    /// How many movements were measured.
    pub n: u64,
    /// Begin minus the start of the sound, in milliseconds: first quartile, median, third quartile.
    pub begins_ms: [f64; 3],
    /// Arrival minus the start of the sound, in milliseconds.
    pub arrives_ms: [f64; 3],
    /// The arrival as a share of the consonant for pairs, of the key for others.
    pub share: [f64; 3],
}

/// How many recordings a finding names.
const NAMED_TAKES: usize = 8;

/// Returns a finding about the takes whose markers do not show the bends of the fingers.
fn guessed_arrivals(takes: &[KeyedTake]) -> Option<String> {
    let unbent = takes.iter().filter(|take| !take.followed.has_bends());
    let names: Vec<&str> = unbent.map(|take| take.take.row.name.as_str()).collect();
    let shown = &names[..names.len().min(NAMED_TAKES)];
    (!names.is_empty()).then(|| {
        format!(
            "recordings whose markers do not show how fingers bend: {} ({}); when fingers arrive there is a guess from \
             distances, and may be 20 to 30 ms too early",
            names.len(),
            shown.join(", ")
        )
    })
}

impl Corpus {
    /// Finds the movements and targets of keys in captured takes; with `store` they are written as tiers of their
    /// recordings, in one operation. A tier that a person wrote or changed remains, and the new one gets another name.
    ///
    /// # Errors
    /// Fails if no recording has a cuer's markers and keys, or they are too few.
    pub fn find_cue_targets(
        &mut self,
        recordings: &[RowName],
        store: bool,
        options: &CuedOptions,
    ) -> CorpusResult<Vec<CueTargets>> {
        let takes = load_keyed_takes(self.store.read_connection(), recordings, options)?;
        // Targets lie where the recognisers are most certain, so that they are trained on the same takes
        // first.
        let (_, shown) = train_key_recognisers(&takes)?;
        let mut take_targets: Vec<CueTargets> = takes
            .iter()
            .zip(&shown)
            .map(|(own, shown)| CueTargets {
                recording: own.take.row.name.clone(),
                keys: found_keys(own, shown),
                tiers: Vec::new(),
                findings: guessed_arrivals(std::slice::from_ref(own)).into_iter().collect(),
            })
            .collect();
        if !store {
            return Ok(take_targets);
        }
        let effect = OperationEffect::FindTargets {
            keys: take_targets.iter().map(|target| target.keys.len() as u64).sum(),
            recordings: take_targets.len() as u64,
        };
        let tier_names = self.store.run_store_operation(|connection| {
            edits::defer_references(connection)?;
            let mut names = Vec::new();
            for (own, found) in takes.iter().zip(&take_targets) {
                names.push(write_cue_movement_tiers(connection, own.take.row.id, &found.keys)?);
            }
            Ok((names, effect))
        })?;
        for (found, names) in take_targets.iter_mut().zip(tier_names) {
            found.tiers = names;
        }
        Ok(take_targets)
    }

    /// Returns the times at which hands and fingers begin and arrive relative to the sounds of keys, by kind of key; a
    /// key with the same placement, or the same shape, as the one before does not count.
    ///
    /// # Errors
    /// Fails if no recording has a cuer's markers and keys, or they are too few.
    pub fn cue_phases(&self, recordings: &[RowName], options: &CuedOptions) -> CorpusResult<CuePhaseStatistics> {
        let takes = load_keyed_takes(self.store.read_connection(), recordings, options)?;
        let (_, shown) = train_key_recognisers(&takes)?;
        let pairs = takes.iter().zip(&shown);
        let rows = measure_key_phases(pairs.map(|(own, shown)| (own.keys.as_slice(), shown.as_slice())));
        let ms = |quartiles: &GestureQuartiles| {
            [quartiles.low, quartiles.median, quartiles.high].map(|x| round_to_decimals(x * 1000.0, 1))
        };
        Ok(CuePhaseStatistics {
            recordings: takes.iter().map(|take| take.take.row.name.clone()).collect(),
            keys: takes.iter().map(|take| take.keys.len() as u64).sum(),
            rows: rows
                .iter()
                .map(|row| CuePhaseRow {
                    part: if row.of_fingers { "fingers" } else { "hand" },
                    kind: row.kind.key_sounds_name(),
                    n: row.arrives.n as u64,
                    begins_ms: ms(&row.begins),
                    arrives_ms: ms(&row.arrives),
                    share: [row.share.low, row.share.median, row.share.high].map(|x| round_to_decimals(x, 3)),
                })
                .collect(),
            findings: guessed_arrivals(&takes).into_iter().collect(),
        })
    }
}

impl CuePhaseStatistics {
    /// Draws the phases to an SVG: for each part and kind a box from the first to the third quartile of begin and
    /// arrival, with the median, on an axis from -600 to 600 ms.
    ///
    /// # Errors
    /// Fails if the name does not end in `.svg`, the file exists already and `force` is not set, or it cannot be written.
    pub fn draw_cue_phases(&self, to: &Path, force: bool) -> CorpusResult<()> {
        atomic_write::write_svg(to, force, &self.cue_phases_svg()).map(drop)
    }

    fn cue_phases_svg(&self) -> String {
        const PHASE_CHART_ROW_HEIGHT: usize = 34;
        const PHASE_CHART_LEFT: f64 = 210.0;
        const PHASE_CHART_WIDTH: f64 = 600.0;
        const PHASE_CHART_EDGE_MS: f64 = 600.0;
        let height = 70 + PHASE_CHART_ROW_HEIGHT * self.rows.len();
        let x = |ms: f64| {
            PHASE_CHART_LEFT
                + (ms.clamp(-PHASE_CHART_EDGE_MS, PHASE_CHART_EDGE_MS) + PHASE_CHART_EDGE_MS)
                    / (2.0 * PHASE_CHART_EDGE_MS)
                    * PHASE_CHART_WIDTH
        };
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
             <text x=\"{PHASE_CHART_LEFT}\" y=\"20\">begin (light) and arrival (dark) against the start of the sound [ms]</text>\n",
            PHASE_CHART_LEFT + PHASE_CHART_WIDTH + 40.0
        );
        for mark in [-600.0, -400.0, -200.0, 0.0, 200.0, 400.0, 600.0] {
            let dash = if mark == 0.0 { "" } else { " stroke-dasharray=\"2 4\"" };
            let _ = writeln!(
                text,
                "<line x1=\"{0:.1}\" y1=\"30\" x2=\"{0:.1}\" y2=\"{1}\" stroke=\"#888\"{dash}/>\
                 <text x=\"{0:.1}\" y=\"{2}\" text-anchor=\"middle\">{mark:.0}</text>",
                x(mark),
                height - 22,
                height - 6
            );
        }
        for (n, row) in self.rows.iter().enumerate() {
            let y = 38 + n * PHASE_CHART_ROW_HEIGHT;
            for (of, fill, down) in [(row.begins_ms, "#c6dbef", 0), (row.arrives_ms, "#3182bd", 12)] {
                let [low, median, high] = of.map(x);
                let _ = writeln!(
                    text,
                    "<rect x=\"{low:.1}\" y=\"{0}\" width=\"{1:.1}\" height=\"10\" fill=\"{fill}\" stroke=\"#08306b\"/>\
                     <line x1=\"{median:.1}\" y1=\"{0}\" x2=\"{median:.1}\" y2=\"{2}\" stroke=\"#000\" stroke-width=\"2\"/>",
                    y + down,
                    (high - low).max(1.0),
                    y + down + 10
                );
            }
            let _ = writeln!(
                text,
                "<text x=\"8\" y=\"{}\">{}, {} (n = {})</text>",
                y + 14,
                row.part,
                row.kind,
                row.n
            );
        }
        text.push_str("</svg>\n");
        text
    }
}

fn found_keys(own: &KeyedTake, shown: &[KeyGestures]) -> Vec<FoundKey> {
    let take = &own.take;
    let span = |times: [f64; 2]| times.map(|time| take.take_time_micros(time));
    let time_of = |gesture: &MeasuredGesture| {
        gesture
            .measured
            .then(|| span([gesture.movement.start, gesture.movement.end]))
    };
    let keys = own.keys.iter().zip(shown);
    keys.map(|(key, shown)| FoundKey {
        key: cue_key_name(key.placement, key.shape),
        kind: KeySounds::key_sounds_name(key.kind),
        a1_us: take.take_time_micros(key.a1),
        hand_us: time_of(&shown.hand),
        fingers_us: time_of(&shown.fingers),
        target_us: take.take_time_micros(shown.hand.frame as f64 / take.rate),
        placement_log: round_to_decimals(shown.hand.log, 3),
        shape_log: round_to_decimals(shown.fingers.log, 3),
        placement_extent_us: shown.hand.extent.map(span),
        shape_extent_us: shown.fingers.extent.map(span),
    })
    .collect()
}

/// Writes the tiers of a recording: movements of hand and fingers, and the extents of gestures. Returns their names.
fn write_cue_movement_tiers(connection: &Connection, recording: i64, keys: &[FoundKey]) -> CorpusResult<Vec<String>> {
    let mut hand = Vec::new();
    let mut fingers = Vec::new();
    let (mut places, mut shapes) = (Vec::new(), Vec::new());
    let mut before = "rest-0".to_owned();
    for key in keys {
        let shape = |key: &str| key.rsplit('-').next().unwrap_or_default().to_owned();
        // Placements may have a hyphen of their own; the shape follows the last one.
        let place = |key: &str| {
            key.rsplit_once('-')
                .map_or_else(String::new, |(place, _)| place.to_owned())
        };
        if let Some([from, to]) = key.hand_us {
            hand.push((from, to, format!("{before}>{}", key.key), key.placement_log));
        }
        if let Some([from, to]) = key.fingers_us {
            fingers.push((
                from,
                to,
                format!("{}>{}", shape(&before), shape(&key.key)),
                key.shape_log,
            ));
        }
        if let Some([from, to]) = key.placement_extent_us {
            places.push((from, to, place(&key.key), key.placement_log));
        }
        if let Some([from, to]) = key.shape_extent_us {
            shapes.push((from, to, shape(&key.key), key.shape_log));
        }
        before.clone_from(&key.key);
    }
    let mut names = Vec::new();
    for (name, rows) in [
        (CueTier::Hand.cue_tier_name(), hand),
        (CueTier::Fingers.cue_tier_name(), fingers),
        ("Placement score", places),
        ("Shape score", shapes),
    ] {
        names.push(write_tier(connection, recording, name, &rows)?);
    }
    Ok(names)
}

/// A row of a tier: begin, end, value, and the logarithm of its probability.
pub(super) type ScoredSpan = (i64, i64, String, f64);

/// Writes a tier of a detector and replaces its earlier version; a tier of that name that a person or a file wrote
/// remains.
pub(super) fn write_tier(
    connection: &Connection,
    recording: i64,
    name: &str,
    rows: &[ScoredSpan],
) -> CorpusResult<String> {
    let all = stored_tiers::load_tier_rows(connection, recording)?;
    let mut tier_name = name.to_owned();
    if let Some(old) = all.iter().find(|tier| tier.name == name) {
        let written = stored_tiers::load_tier_annotation_rows(connection, old.id)?;
        if written.iter().any(|row| row.origin != AnnotationOrigin::Detector) {
            tier_name = format!("{name} (found)");
        }
    }
    // A tier that is written again stays where it stood.
    let mut position = all.iter().map(|tier| tier.position + 1).max().unwrap_or(0);
    if let Some(old) = all.iter().find(|tier| tier.name == tier_name) {
        position = old.position;
        edits::delete_annotations(connection, old.id)?;
        stored_tiers::delete_tier(connection, old.id)?;
    }
    let tier = TierRow {
        recording_id: recording,
        name: tier_name.clone(),
        position,
        role: TierRole::Free,
        ..TierRow::default()
    };
    insert_scored_tier(connection, &tier, AnnotationOrigin::Detector, rows)?;
    Ok(tier_name)
}

/// Inserts a tier with its annotations, one after another.
pub(super) fn insert_scored_tier(
    connection: &Connection,
    tier: &TierRow,
    origin: AnnotationOrigin,
    rows: &[ScoredSpan],
) -> CorpusResult<()> {
    let tier = stored_tiers::insert_tier(connection, tier)?;
    let mut free_from = i64::MIN;
    for (start, end, value, log) in rows {
        // Annotations of one tier may not overlap, and predicted movements may; the earlier one keeps its
        // end.
        let start = (*start).max(free_from).max(0);
        if start >= *end {
            continue;
        }
        free_from = *end;
        let row = AnnotationRow {
            tier_id: tier,
            start_us: start,
            end_us: *end,
            state: ValueState::Value,
            value: value.clone(),
            origin,
            confidence: (origin == AnnotationOrigin::Detector).then(|| log.exp().clamp(0.0, 1.0)),
            ..AnnotationRow::default()
        };
        stored_tiers::insert_annotation(connection, &row)?;
    }
    Ok(())
}
