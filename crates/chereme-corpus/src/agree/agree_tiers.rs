//! The pairs of tiers that two annotators made, and their units.

use std::collections::{BTreeMap, BTreeSet};

use chereme_analysis::agreement::{AnnotatedUnit, AnnotationContinuum};
use chereme_sign::text::{fold_text, nearest_candidate};
use chereme_sign::{ComponentInventory, ComponentReading, ErrorRemedy, SignComponent, TierRole};
use rusqlite::Connection;

use super::AgreeOptions;
use crate::Corpus;
use crate::address::{self, CorpusAddress};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// Two tiers with what their annotators made.
pub(super) struct TierPair {
    /// The recording of the first tier, to which the list of disagreements leads.
    pub(super) recording: RecordingRow,
    pub(super) a: TierRow,
    pub(super) b: TierRow,
    /// The units in milliseconds.
    pub(super) continuum: AnnotationContinuum,
    /// The annotation of each unit.
    pub(super) annotations: [Vec<AnnotationRow>; 2],
    pub(super) left_out: [u64; 2],
}

/// All pairs of tiers, with the values that occur.
pub(super) struct CodedTierPairs {
    pub(super) pairs: Vec<TierPair>,
    pub(super) values: Vec<String>,
    /// The features of each value, from the inventory of its tier.
    pub(super) features: Vec<BTreeSet<String>>,
    /// Whether the values are handshapes with features.
    pub(super) are_handshapes: bool,
    /// Whether no annotation has a value.
    pub(super) spans_only: bool,
    pub(super) findings: Vec<String>,
}

/// Returns the pairs of tiers that the options name, with their units.
pub(super) fn read_tier_pairs(corpus: &Corpus, options: &AgreeOptions) -> CorpusResult<CodedTierPairs> {
    let connection = corpus.store.read_connection();
    let mut findings = Vec::new();
    let named_pairs = find_tier_pairs(connection, options, &mut findings)?;
    let inventories = corpus.inventories_now()?;
    let inventory = |tier: &TierRow| {
        let stored = inventories
            .iter()
            .find(|candidate| Some(candidate.id) == tier.inventory_id);
        stored.map(|entry| &entry.inventory)
    };
    // All tiers are read first: whether any annotation has a value decides how each is read.
    let mut all: Vec<(RecordingRow, [TierRow; 2], [Vec<AnnotationRow>; 2])> = Vec::new();
    for (recording, a, b) in named_pairs {
        let of_a = rows::load_tier_annotation_rows(connection, a.id)?;
        let of_b = rows::load_tier_annotation_rows(connection, b.id)?;
        all.push((recording, [a, b], [of_a, of_b]));
    }
    let annotations = all.iter().flat_map(|entry| entry.2.iter().flatten());
    let spans_only = !annotations
        .clone()
        .any(|annotation| annotation_coded_value(annotation, None).is_some());
    let mut values = ValueNumbers::default();
    let (mut read, mut handshapes) = (Vec::new(), true);
    for (recording, [a, b], both) in all {
        let both_handshapes = is_handshape(&a) && is_handshape(&b);
        // A vocabulary of a file has no features; inventories of handshapes have them for the same names.
        let usual: Vec<&ComponentInventory> = match both_handshapes {
            true => inventories
                .iter()
                .map(|entry| &entry.inventory)
                .filter(|candidate| is_of_handshapes(candidate))
                .collect(),
            false => Vec::new(),
        };
        // Two tiers with different inventories may spell one value in two ways, and neither spelling is the
        // right one.
        let shared = inventory(&a).filter(|_| a.inventory_id == b.inventory_id);
        handshapes &= both_handshapes;
        let mut tiers = Vec::new();
        let (mut kept, mut left_out) = ([Vec::new(), Vec::new()], [0, 0]);
        for (side, annotations) in both.into_iter().enumerate() {
            // With no values at all, an equal empty one lets the spans be compared.
            let value = |annotation: &AnnotationRow| match spans_only {
                true => Some(String::new()),
                false => annotation_coded_value(annotation, shared),
            };
            let known_inventories = || shared.into_iter().chain(usual.iter().copied());
            let (units, rows, without) = units_from_annotations(annotations, value, |text| {
                values.number_of_value(text, known_inventories)
            });
            left_out[side] = without;
            tiers.push(units);
            kept[side] = rows;
        }
        let extent = annotated_extent_ms(&recording, &tiers, options);
        read.push((recording, [a, b], kept, left_out, extent, tiers));
    }
    // The numbers are known only now, so that units are numbered again after all tiers were read.
    let sorted = values.sort_value_numbers();
    let pairs = read
        .into_iter()
        .map(|(recording, [a, b], mut annotations, left_out, extent, mut tiers)| {
            for (units, rows) in tiers.iter_mut().zip(&mut annotations) {
                renumber(units, rows, &sorted);
            }
            TierPair {
                continuum: AnnotationContinuum::new(extent.0..extent.1, tiers),
                recording,
                a,
                b,
                annotations,
                left_out,
            }
        });
    let pairs: Vec<TierPair> = pairs.collect();
    if spans_only && pairs.iter().any(|pair| pair.continuum.annotated_unit_count() > 0) {
        findings.push("no annotation has a value, so only spans are compared".to_owned());
    }
    let are_handshapes = handshapes && !spans_only && values.features.iter().any(|features| !features.is_empty());
    Ok(CodedTierPairs {
        pairs,
        values: values.names,
        features: values.features,
        are_handshapes,
        spans_only,
        findings,
    })
}

/// Returns the annotations with values as units in order of time, and how many have no value.
fn units_from_annotations(
    annotations: Vec<AnnotationRow>,
    value: impl Fn(&AnnotationRow) -> Option<String>,
    mut number: impl FnMut(String) -> usize,
) -> (Vec<AnnotatedUnit>, Vec<AnnotationRow>, u64) {
    let (mut all, mut left_out): (Vec<(AnnotatedUnit, AnnotationRow)>, u64) = (Vec::new(), 0);
    for row in annotations {
        let Some(value) = value(&row) else {
            left_out += 1;
            continue;
        };
        let (start, end) = (milliseconds(row.start_us), milliseconds(row.end_us));
        // A span of less than a millisecond can round to nothing, and a unit needs a length.
        all.push((AnnotatedUnit::new(start, end.max(start + 1), number(value)), row));
    }
    // The units' order is that of the continuum; the id settles ties so that it never varies.
    all.sort_by_key(|(unit, row)| (*unit, row.id));
    let (units, rows) = all.into_iter().unzip();
    (units, rows, left_out)
}

/// Gives units the new numbers of their values; units with the same span change their order with them, and their
/// annotations follow.
fn renumber(units: &mut Vec<AnnotatedUnit>, rows: &mut Vec<AnnotationRow>, numbers: &[usize]) {
    let mut all: Vec<(AnnotatedUnit, AnnotationRow)> =
        std::mem::take(units).into_iter().zip(std::mem::take(rows)).collect();
    for (unit, _) in &mut all {
        unit.value = numbers[unit.value];
    }
    all.sort_by_key(|(unit, row)| (*unit, row.id));
    (*units, *rows) = all.into_iter().unzip();
}

/// Returns the time that counts as annotated, in milliseconds.
fn annotated_extent_ms(recording: &RecordingRow, tiers: &[Vec<AnnotatedUnit>], options: &AgreeOptions) -> (i64, i64) {
    if options.whole {
        return (0, milliseconds(recording.duration_us));
    }
    let all = || tiers.iter().flatten();
    let start = all().map(|unit| unit.start).min().unwrap_or(0);
    (start, all().map(|unit| unit.end).max().unwrap_or(start))
}

/// Returns whether a tier holds handshapes.
fn is_handshape(tier: &TierRow) -> bool {
    matches!(
        &tier.role,
        TierRole::Component {
            component: SignComponent::Configuration,
            feature: None
        }
    )
}

fn is_of_handshapes(inventory: &ComponentInventory) -> bool {
    inventory.component == SignComponent::Configuration && inventory.feature.is_none()
}

fn milliseconds(micros: i64) -> i64 {
    // Half a millisecond is added so that times are rounded to the nearest, also negative ones.
    micros.saturating_add(500).div_euclid(1000)
}

/// Returns the value of an annotation as an inventory spells it, `n/a` or `unclear`; `None` for an annotation without
/// a value.
fn annotation_coded_value(annotation: &AnnotationRow, inventory: Option<&ComponentInventory>) -> Option<String> {
    match annotation.annotation_reading() {
        ComponentReading::Value(text) => {
            let text = text.trim();
            let known_value = inventory.and_then(|inventory| inventory.find_inventory_value(text));
            let name = known_value.map_or(text, |entry| entry.id.as_str());
            (!name.is_empty()).then(|| name.to_owned())
        }
        ComponentReading::NotApplicable => Some("n/a".to_owned()),
        ComponentReading::Unclear => Some("unclear".to_owned()),
        ComponentReading::Unset => None,
    }
}

/// The numbers of values.
#[derive(Default)]
struct ValueNumbers {
    numbers: BTreeMap<String, usize>,
    names: Vec<String>,
    features: Vec<BTreeSet<String>>,
}

impl ValueNumbers {
    /// Returns the number of a value; a new one has the features that the first of the inventories `known` gives it.
    fn number_of_value<'a, K: Iterator<Item = &'a ComponentInventory>>(
        &mut self,
        value: String,
        known: impl Fn() -> K,
    ) -> usize {
        if let Some(number) = self.numbers.get(&value) {
            return *number;
        }
        let known_features = known()
            .filter_map(|inventory| inventory.find_inventory_value(&value))
            .map(|entry| &entry.features);
        let features = known_features.into_iter().find(|list| !list.is_empty());
        let number = self.names.len();
        self.features.push(features.cloned().unwrap_or_default());
        self.names.push(value.clone());
        self.numbers.insert(value, number);
        number
    }

    /// Puts the values in alphabetical order, so that their numbers do not depend on who comes first; returns the new number
    /// of each old one.
    fn sort_value_numbers(&mut self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.names.len()).collect();
        order.sort_by(|a, b| self.names[*a].cmp(&self.names[*b]));
        let mut numbers = vec![0; order.len()];
        for (new, old) in order.iter().enumerate() {
            numbers[*old] = new;
        }
        self.names = order.iter().map(|old| self.names[*old].clone()).collect();
        self.features = order.iter().map(|old| self.features[*old].clone()).collect();
        numbers
    }
}

/// The forms in which tiers of one annotator are named.
enum WantedTierForm {
    Tier(i64),
    Annotator(String),
    /// A name, or a name with one `*`.
    Name(String),
}

impl WantedTierForm {
    fn read_wanted_tier(text: &str) -> Self {
        let text = text.trim();
        if let Ok(CorpusAddress::Tier(number)) = text.parse() {
            return Self::Tier(number);
        }
        match text.split_once(':') {
            Some((kind, name)) if fold_text(kind) == "annotator" => {
                Self::Annotator(name.trim().trim_matches('"').to_owned())
            }
            _ => Self::Name(text.to_owned()),
        }
    }
}

type FoundTierPair = (RecordingRow, TierRow, TierRow);

/// Returns the pairs of tiers that the options name.
fn find_tier_pairs(
    connection: &Connection,
    options: &AgreeOptions,
    findings: &mut Vec<String>,
) -> CorpusResult<Vec<FoundTierPair>> {
    let (a, b) = (
        WantedTierForm::read_wanted_tier(&options.a),
        WantedTierForm::read_wanted_tier(&options.b),
    );
    if let (WantedTierForm::Tier(a), WantedTierForm::Tier(b)) = (&a, &b) {
        let (a, b) = (
            rows::load_tier_row(connection, *a)?,
            rows::load_tier_row(connection, *b)?,
        );
        if let Some(name) = &options.recording {
            let only = address::find_recording_by_name(connection, name)?.id;
            if a.recording_id != only || b.recording_id != only {
                return Err(no_pair(options, &BTreeSet::new()));
            }
        }
        let recording = stored_recordings::load_recording_row(connection, a.recording_id)?;
        return refuse_same_tier(vec![(recording, a, b)], options);
    }
    let scope = match &options.recording {
        Some(name) => vec![address::find_recording_by_name(connection, name)?],
        None => stored_recordings::load_recording_rows(connection)?,
    };
    // The names are kept for the refusal, which proposes the nearest one.
    let (mut found, mut names, mut annotators) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    for recording in scope {
        let tiers = rows::load_tier_rows(connection, recording.id)?;
        names.extend(tiers.iter().map(|tier| tier.name.clone()));
        annotators.extend(tiers.iter().filter_map(|tier| tier.annotator.clone()));
        let pairs = match (&a, &b) {
            (WantedTierForm::Annotator(a), WantedTierForm::Annotator(b)) => {
                by_annotator(&recording.name, &tiers, a, b, findings)
            }
            (WantedTierForm::Name(a), WantedTierForm::Name(b)) if a.contains('*') && b.contains('*') => {
                by_pattern(&tiers, a, b)
            }
            _ => {
                let one = |wanted: &WantedTierForm| match wanted {
                    WantedTierForm::Tier(id) => tiers.iter().find(|tier| tier.id == *id),
                    WantedTierForm::Name(name) => by_name(&tiers, name),
                    WantedTierForm::Annotator(name) => {
                        let mut annotator_tiers = tiers.iter().filter(|tier| is_by(tier, name));
                        // Of several tiers of one annotator none can be chosen here, so that they count as
                        // missing.
                        annotator_tiers.next().filter(|_| annotator_tiers.next().is_none())
                    }
                };
                one(&a).zip(one(&b)).into_iter().collect()
            }
        };
        for (a, b) in pairs {
            found.push((recording.clone(), a.clone(), b.clone()));
        }
    }
    // An unknown annotator is the likelier mistake, and is named before the missing pair.
    if found.is_empty() {
        for wanted in [&a, &b] {
            if let WantedTierForm::Annotator(name) = wanted {
                known_annotator(name, &annotators)?;
            }
        }
        return Err(no_pair(options, &names));
    }
    refuse_same_tier(found, options)
}

/// Refuses a tier that would be compared with itself.
fn refuse_same_tier(found: Vec<FoundTierPair>, options: &AgreeOptions) -> CorpusResult<Vec<FoundTierPair>> {
    match found.iter().find(|(_, a, b)| a.id == b.id) {
        Some((recording, a, _)) => Err(CorpusError::from_wrong_message(format!(
            "the tier {:?} of {:?} would be compared with itself",
            a.name, recording.name
        ))
        .with_error_place(options.b.as_str())
        .with_advice("name the tier of the other annotator")),
        None => Ok(found),
    }
}

/// Refuses an annotator of no tier.
fn known_annotator(name: &str, annotators: &BTreeSet<String>) -> CorpusResult<()> {
    if annotators
        .iter()
        .any(|annotator| fold_text(annotator.trim()) == fold_text(name))
    {
        return Ok(());
    }
    let hint = chereme_sign::text::did_you_mean(nearest_candidate(name, annotators.iter().map(String::as_str)));
    Err(
        CorpusError::from_wrong_message(format!("no tier has the annotator {name:?}{hint}"))
            .with_error_place(name)
            .with_advice(ErrorRemedy::command_remedy(
                "`chereme list CORPUS tiers` shows the annotator of each tier",
            )),
    )
}

fn no_pair(options: &AgreeOptions, names: &BTreeSet<String>) -> CorpusError {
    // Only a name can be misspelt; a pattern matches or does not.
    let missing = [&options.a, &options.b].into_iter().find(|wanted| {
        matches!(WantedTierForm::read_wanted_tier(wanted), WantedTierForm::Name(name)
            if !name.contains('*') && !names.iter().any(|other| fold_text(other) == fold_text(&name)))
    });
    let place = missing.unwrap_or(&options.a);
    let near = nearest_candidate(place, names.iter().map(String::as_str)).filter(|_| missing.is_some());
    let hint = chereme_sign::text::did_you_mean(near);
    CorpusError::from_wrong_message(format!(
        "no recording has both {:?} and {:?}{hint}",
        options.a, options.b
    ))
    .with_error_place(place.as_str())
    .with_advice(ErrorRemedy::command_remedy(
        "`chereme list CORPUS tiers` lists all tiers; write their names, \"*-A\" and \"*-B\", annotator:NAME, or tier:12",
    ))
}

/// Returns the tier of that name, or the only one that differs from it in case and accents alone.
fn by_name<'a>(tiers: &'a [TierRow], name: &str) -> Option<&'a TierRow> {
    tiers.iter().find(|tier| tier.name == name).or_else(|| {
        let folded = fold_text(name);
        let mut alike = tiers.iter().filter(|tier| fold_text(&tier.name) == folded);
        alike.next().filter(|_| alike.next().is_none())
    })
}

/// Returns the pairs of tiers whose names have the same text at the star of the two patterns.
fn by_pattern<'a>(tiers: &'a [TierRow], a: &str, b: &str) -> Vec<(&'a TierRow, &'a TierRow)> {
    let ((before, after), (first, last)) = (split_tier_pattern(a), split_tier_pattern(b));
    let pairs = tiers.iter().filter_map(|tier| {
        let rest = tier.name.strip_prefix(before)?;
        let shared = rest.strip_suffix(after)?;
        let other_name = format!("{first}{shared}{last}");
        let other = tiers.iter().find(|candidate| candidate.name == other_name)?;
        Some((tier, other))
    });
    // Two equal patterns would pair each tier with itself.
    pairs.filter(|(a, b)| a.id != b.id).collect()
}

fn split_tier_pattern(pattern: &str) -> (&str, &str) {
    pattern.split_once('*').unwrap_or((pattern, ""))
}

fn is_by(tier: &TierRow, annotator: &str) -> bool {
    let tier_annotator = tier.annotator.as_deref().unwrap_or_default().trim();
    !tier_annotator.is_empty() && fold_text(tier_annotator) == fold_text(annotator)
}

/// Returns the pairs of tiers of two annotators that describe the same: the same role and hand, and the same
/// participant. Of several tiers of one kind the names decide: those that only differ in the annotator's name belong
/// together.
fn by_annotator<'a>(
    recording: &str,
    tiers: &'a [TierRow],
    a: &str,
    b: &str,
    findings: &mut Vec<String>,
) -> Vec<(&'a TierRow, &'a TierRow)> {
    let kind = |row: &TierRow| (row.tier_topic(), row.participant.clone());
    // Names such as `Gloss-ANNA` and `Gloss-BEN` are equal once the annotators are taken out.
    let stem = |row: &TierRow, annotator: &str| fold_text(&row.name).replace(&fold_text(annotator), "");
    let mut pairs = Vec::new();
    for tier in tiers.iter().filter(|row| is_by(row, a)) {
        let matching_tiers = tiers.iter().filter(|row| is_by(row, b) && kind(row) == kind(tier));
        let others: Vec<&TierRow> = matching_tiers.collect();
        let own_count = tiers
            .iter()
            .filter(|row| is_by(row, a) && kind(row) == kind(tier))
            .count();
        let same = others.iter().find(|row| stem(row, b) == stem(tier, a));
        match (&others[..], same) {
            // Only one tier of the kind on either side: the names need not be alike.
            ([one], _) if own_count == 1 => pairs.push((tier, *one)),
            (_, Some(same)) => pairs.push((tier, *same)),
            ([], _) => {}
            _ => findings.push(format!(
                "several tiers of {:?} could belong to {:?}: name both by name or number",
                recording, tier.name
            )),
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tier(id: i64, name: &str, annotator: &str) -> TierRow {
        TierRow {
            id,
            name: name.to_owned(),
            annotator: Some(annotator.to_owned()),
            ..TierRow::default()
        }
    }

    #[test]
    fn tiers_are_paired_by_the_star_of_patterns() {
        let tiers = [
            tier(1, "Gloss-A", ""),
            tier(2, "Gloss-B", ""),
            tier(3, "Mouth-A", ""),
            tier(4, "B", ""),
        ];
        let ids = |a, b| -> Vec<(i64, i64)> {
            let pairs = by_pattern(&tiers, a, b);
            pairs.iter().map(|(a, b)| (a.id, b.id)).collect()
        };
        assert_eq!(ids("*-A", "*-B"), [(1, 2)]);
        assert_eq!(ids("*-B", "*-A"), [(2, 1)]);
        assert_eq!(ids("Gloss*", "Gloss*"), []);
        assert_eq!(ids("*Gloss-A", "*B"), [(1, 4)]);
    }

    #[test]
    fn tiers_of_annotators_are_paired_by_subject_and_then_by_name() {
        let pairs = |tiers: &[TierRow]| {
            let mut findings = Vec::new();
            let pairs = by_annotator("R", tiers, "Anna", "ben", &mut findings);
            let ids: Vec<(i64, i64)> = pairs.iter().map(|(a, b)| (a.id, b.id)).collect();
            (ids, findings.len())
        };
        let one = [tier(1, "x", "anna"), tier(2, "y", "Ben")];
        assert_eq!(pairs(&one), (vec![(1, 2)], 0));
        let several = [
            tier(1, "Mouth Anna", "Anna"),
            tier(2, "Brows Anna", "Anna"),
            tier(3, "Brows Ben", "Ben"),
            tier(4, "Other", "Ben"),
        ];
        assert_eq!(pairs(&several), (vec![(2, 3)], 1));
    }
}
