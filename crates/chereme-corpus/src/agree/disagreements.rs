//! The list of disagreements: units without a partner, other values, starts and ends apart.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;

use chereme_analysis::agreement::gamma::{AlignedUnits, AlignmentCosts, align_continuum};
use chereme_analysis::agreement::matching::{DEFAULT_OVERLAP_SHARE, match_overlapping_units};
use serde::Serialize;

use super::agree_figures::annotator_units;
use super::agree_tiers::{CodedTierPairs, TierPair};
use super::{AgreeOptions, AnnotatorAgreement};
use crate::atomic_write;
use crate::db::stored_tiers::AnnotationRow;
use crate::error::{CorpusError, CorpusResult};

/// The kind of a disagreement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DisagreementKind {
    /// Only the first has a unit.
    OnlyA,
    /// Only the second has a unit.
    OnlyB,
    /// The values differ.
    Value,
    /// The values are equal, and a start or an end lies further apart than the tolerance.
    Boundary,
}

impl DisagreementKind {
    /// Returns the word of the kind in files and tables.
    #[must_use]
    pub fn disagreement_kind_name(self) -> &'static str {
        match self {
            Self::OnlyA => "only-a",
            Self::OnlyB => "only-b",
            Self::Value => "value",
            Self::Boundary => "boundary",
        }
    }
}

/// How many disagreements there are of each kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct DisagreementCounts {
    /// Units of the first alone.
    pub only_a: u64,
    /// Units of the second alone.
    pub only_b: u64,
    /// Other values.
    pub value: u64,
    /// Starts or ends apart.
    pub boundary: u64,
}

/// One side of a disagreement.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DisagreementSide {
    /// The annotation.
    pub annotation: i64,
    /// Its start in microseconds.
    pub start_us: i64,
    /// The first microsecond after it.
    pub end_us: i64,
    /// Its value, as the inventory spells it.
    pub value: String,
}

/// A disagreement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueDisagreement {
    /// The recording's name.
    pub recording: String,
    /// The recording's number.
    pub recording_id: i64,
    /// The kind.
    pub kind: DisagreementKind,
    /// Its cost in gamma's alignment: 1 for a unit alone; distance of values and distance in time of two units.
    pub cost: f64,
    /// The first moment of either side, in microseconds.
    pub start_us: i64,
    /// The last moment of either side, in microseconds.
    pub end_us: i64,
    /// The side of the first.
    pub a: Option<DisagreementSide>,
    /// The side of the second.
    pub b: Option<DisagreementSide>,
    /// The features in which the values differ.
    pub differs: Vec<String>,
}

/// The distances of values: those of features for handshapes, otherwise 1.
///
/// The weights are which fingers 2, bend 1, thumb 1, spread ½, in the words of the house inventory of handshapes.
pub(super) struct ValueDistances {
    parts: Option<Vec<Option<[BTreeSet<String>; 4]>>>,
}

const HANDSHAPE_FEATURE_WEIGHTS: [f64; 4] = [2.0, 1.0, 1.0, 0.5];
const HANDSHAPE_FINGER_NAMES: [&str; 4] = ["index", "middle", "ring", "little"];

impl ValueDistances {
    pub(super) fn distances_of_coded(coded: &CodedTierPairs) -> Self {
        let parts = |features: &BTreeSet<String>| {
            let mut parts: [BTreeSet<String>; 4] = Default::default();
            for feature in features {
                let part = match feature.as_str() {
                    it if HANDSHAPE_FINGER_NAMES.contains(&it) => 0,
                    it if it.starts_with("thumb") => 2,
                    "spread" | "together" => 3,
                    _ => 1,
                };
                parts[part].insert(feature.clone());
            }
            (!features.is_empty()).then_some(parts)
        };
        Self {
            parts: coded.are_handshapes.then(|| coded.features.iter().map(parts).collect()),
        }
    }

    /// Returns the distance of two values, from 0 to 1.
    pub(super) fn distance_between_values(&self, a: usize, b: usize) -> f64 {
        // Values without features, such as `unclear`, are only equal or not.
        let of = |value: usize| self.parts.as_ref()?.get(value)?.as_ref();
        let (Some(one), Some(other)) = (of(a), of(b)) else {
            return f64::from(u8::from(a != b));
        };
        let parts = one.iter().zip(other).zip(HANDSHAPE_FEATURE_WEIGHTS);
        let differ: f64 = parts.filter(|((a, b), _)| a != b).map(|(_, weight)| weight).sum();
        // Two values with equal features are two values all the same.
        let least = f64::from(u8::from(a != b)) * 0.1;
        (differ / HANDSHAPE_FEATURE_WEIGHTS.iter().sum::<f64>()).max(least)
    }
}

/// Returns the units that belong together, and whether gamma's alignment found them; if too many units overlap to be
/// aligned, they are matched by overlap.
pub(super) fn aligned_unit_groups(pair: &TierPair, costs: &AlignmentCosts<'_>) -> (Vec<AlignedUnits>, bool) {
    if let Ok(found) = align_continuum(&pair.continuum, costs) {
        return (found.groups, true);
    }
    let (first, second) = annotator_units(&pair.continuum);
    let pairs = match_overlapping_units(first, second, DEFAULT_OVERLAP_SHARE);
    let (mut of_a, mut of_b) = (vec![false; first.len()], vec![false; second.len()]);
    let mut groups = Vec::new();
    for (a, b) in pairs {
        (of_a[a], of_b[b]) = (true, true);
        groups.push(vec![Some(a), Some(b)]);
    }
    let alone = |used: Vec<bool>| used.into_iter().enumerate().filter(|(_, used)| !used);
    groups.extend(alone(of_a).map(|(a, _)| vec![Some(a), None]));
    groups.extend(alone(of_b).map(|(b, _)| vec![None, Some(b)]));
    (groups, false)
}

/// Returns the disagreements, the costliest first, then by recording and time; adds a finding for each recording whose
/// units are matched by overlap.
pub(super) fn list_disagreements(
    coded: &CodedTierPairs,
    distances: &ValueDistances,
    options: &AgreeOptions,
    findings: &mut Vec<String>,
) -> Vec<ValueDisagreement> {
    let distance = |a: usize, b: usize| distances.distance_between_values(a, b);
    let costs = AlignmentCosts {
        distance: Some(&distance),
        ..AlignmentCosts::default()
    };
    let mut all = Vec::new();
    for pair in &coded.pairs {
        let (groups, aligned) = aligned_unit_groups(pair, &costs);
        if !aligned {
            findings.push(format!(
                "too many units of {:?} overlap to be aligned: its disagreements are those of units matched by overlap",
                pair.recording.name
            ));
        }
        for group in groups {
            all.extend(disagreement(pair, &group, coded, &costs, options));
        }
    }
    all.sort_by(|a, b| {
        let costlier = b.cost.total_cmp(&a.cost);
        costlier.then((a.recording_id, a.start_us, a.kind).cmp(&(b.recording_id, b.start_us, b.kind)))
    });
    all
}

fn disagreement(
    pair: &TierPair,
    group: &AlignedUnits,
    coded: &CodedTierPairs,
    costs: &AlignmentCosts<'_>,
    options: &AgreeOptions,
) -> Option<ValueDisagreement> {
    let (first, second) = annotator_units(&pair.continuum);
    let [a, b] = [group.first().copied().flatten(), group.get(1).copied().flatten()];
    let rows = [
        a.map(|at| &pair.annotations[0][at]),
        b.map(|at| &pair.annotations[1][at]),
    ];
    let (kind, cost) = match (a, b) {
        (Some(a), Some(b)) => {
            let (one, two) = (&first[a], &second[b]);
            let cost = costs.unit_pair_cost(one, two);
            let [from, to]: [&AnnotationRow; 2] = [rows[0]?, rows[1]?];
            let apart = (from.start_us - to.start_us).abs().max((from.end_us - to.end_us).abs());
            match one.value == two.value {
                false => (DisagreementKind::Value, cost),
                true if apart > options.tolerance_us => (DisagreementKind::Boundary, cost),
                true => return None,
            }
        }
        (Some(_), None) => (DisagreementKind::OnlyA, costs.alone),
        (None, Some(_)) => (DisagreementKind::OnlyB, costs.alone),
        (None, None) => return None,
    };
    let value = |units: &[chereme_analysis::agreement::AnnotatedUnit], at: Option<usize>| Some(units[at?].value);
    let values = [value(first, a), value(second, b)];
    let side = |row: Option<&AnnotationRow>, value: Option<usize>| {
        let row = row?;
        Some(DisagreementSide {
            annotation: row.id,
            start_us: row.start_us,
            end_us: row.end_us,
            value: coded.values.get(value?)?.clone(),
        })
    };
    let differs = match values {
        [Some(a), Some(b)] => {
            let differ = coded.features[a].symmetric_difference(&coded.features[b]);
            differ.cloned().collect()
        }
        _ => Vec::new(),
    };
    let both = || rows.iter().flatten();
    Some(ValueDisagreement {
        recording: pair.recording.name.clone(),
        recording_id: pair.recording.id,
        kind,
        cost: (cost * 1e6).round() / 1e6,
        start_us: both().map(|row| row.start_us).min()?,
        end_us: both().map(|row| row.end_us).max()?,
        a: side(rows[0], values[0]),
        b: side(rows[1], values[1]),
        differs,
    })
}

/// Returns how many disagreements of each kind a list has.
pub(super) fn count_disagreement_kinds(list: &[ValueDisagreement]) -> DisagreementCounts {
    let count = |kind| list.iter().filter(|entry| entry.kind == kind).count() as u64;
    DisagreementCounts {
        only_a: count(DisagreementKind::OnlyA),
        only_b: count(DisagreementKind::OnlyB),
        value: count(DisagreementKind::Value),
        boundary: count(DisagreementKind::Boundary),
    }
}

const DISAGREEMENT_COLUMN_TITLES: [&str; 12] = [
    "recording",
    "kind",
    "cost",
    "start_s",
    "end_s",
    "value_a",
    "value_b",
    "onset_s",
    "offset_s",
    "differs",
    "annotation_a",
    "annotation_b",
];

impl AnnotatorAgreement {
    /// Writes the disagreements as a table of comma-separated values; `onset_s` and `offset_s` are the times of the
    /// second less those of the first.
    ///
    /// # Errors
    /// [`CorpusError::File`] if the file exists and `force` is not set, or if it cannot be written.
    pub fn write_disagreements(&self, to: &Path, force: bool) -> CorpusResult<()> {
        let bytes = disagreement_table(&self.list)?;
        atomic_write::write_atomically(to, force, |out| {
            out.write_all(&bytes)
                .map_err(|error| CorpusError::from_file_failure(to, error))
        })
        .map(drop)
    }
}

/// Returns the disagreements as a table.
fn disagreement_table(list: &[ValueDisagreement]) -> CorpusResult<Vec<u8>> {
    let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let fault = |error: ::csv::Error| CorpusError::from_wrong_message(error.to_string());
    writer.write_record(DISAGREEMENT_COLUMN_TITLES).map_err(fault)?;
    for it in list {
        let value = |side: &Option<DisagreementSide>| {
            side.as_ref()
                .map(|known_side| known_side.value.clone())
                .unwrap_or_default()
        };
        let number = |side: &Option<DisagreementSide>| {
            side.as_ref()
                .map(|known_side| known_side.annotation.to_string())
                .unwrap_or_default()
        };
        let moved = |of: fn(&DisagreementSide) -> i64| match (&it.a, &it.b) {
            (Some(a), Some(b)) => seconds(of(b) - of(a)),
            _ => String::new(),
        };
        let row = [
            it.recording.clone(),
            it.kind.disagreement_kind_name().to_owned(),
            format!("{:.3}", it.cost),
            seconds(it.start_us),
            seconds(it.end_us),
            value(&it.a),
            value(&it.b),
            moved(|side| side.start_us),
            moved(|side| side.end_us),
            it.differs.join(" "),
            number(&it.a),
            number(&it.b),
        ];
        writer.write_record(row).map_err(fault)?;
    }
    writer
        .into_inner()
        .map_err(|error| CorpusError::from_wrong_message(error.to_string()))
}
