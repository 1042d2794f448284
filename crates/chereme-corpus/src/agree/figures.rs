//! The measures of all pairs of tiers together, and of each pair.

use std::collections::{BTreeMap, BTreeSet};

use chereme_analysis::agreement::gamma::{Costs, Gamma, Sampling, gamma};
use chereme_analysis::agreement::items::{Counts, Item, Scale, alpha};
use chereme_analysis::agreement::matching::{Row, Table, matched, overlap_ratio, rows};
use chereme_analysis::agreement::resample::{Interval, bootstrap};
use chereme_analysis::agreement::segments::{Edits, edits};
use chereme_analysis::agreement::unitizing::{alpha_u, disagreements, frames, u_alpha};
use chereme_analysis::agreement::{Continuum, Measure, Undefined, Unit};
use serde::Serialize;

use super::disagreements::{Distances, list, tally};
use super::tiers::{Coded, TierPair};
use super::{AgreeOptions, Agreement, PairAgreement, UnitCounts};
use crate::error::{Error, Result};
use crate::face::Quartiles;
use crate::progress::{Progress, Step, Unit as Amount};

/// The names of all measures, in the order in which they are reported.
///
/// - `kappa_ipf`: modified kappa of Holle and Rein over all units; `raw`, `kappa`, `kappa_max`: the same table's share of
///   agreement, kappa with ordinary chance, and largest kappa; `matched`: share of units with a partner.
/// - `alpha_u`: Krippendorff's alpha of spans and values; `u_alpha`, `u_alpha_spans`, `cu_alpha`: those of 2016.
/// - `gamma`, `gamma_cat`: Mathet's, by alignment; `label_…`: values of matched units alone.
/// - `overlap_a`, `overlap_b`: ELAN's ratio, which depends on the first tier; `frames_…`: 10 ms each, gaps are a value.
/// - `boundaries`: boundary similarity of tiers without gaps, at 40 ms.
pub const MEASURES: [&str; 23] = [
    "kappa_ipf",
    "raw",
    "matched",
    "kappa",
    "kappa_max",
    "alpha_u",
    "u_alpha",
    "u_alpha_spans",
    "cu_alpha",
    "gamma",
    "gamma_cat",
    "label_raw",
    "label_kappa",
    "label_pi",
    "label_ac1",
    "label_alpha",
    "label_alpha_features",
    "overlap_a",
    "overlap_b",
    "frames_raw",
    "frames_kappa",
    "frames_alpha",
    "boundaries",
];

/// The measures that are shown to people who ask for no others.
pub const USUAL_MEASURES: [&str; 5] = ["kappa_ipf", "raw", "matched", "alpha_u", "gamma"];

/// The length of a frame of the measures of frames, in milliseconds.
const FRAME: i64 = 10;
/// The step of boundary similarity in milliseconds, and how many steps apart two boundaries are two.
const STEP: i64 = 40;
const NEAR: usize = 3;
/// From so many recordings on, recordings are drawn for intervals instead of units.
const RECORDINGS: usize = 10;

/// A measure: its value, or the reason why it has none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// The value.
    pub value: Option<f64>,
    /// The reason why there is no value.
    pub why: Option<String>,
    /// The interval of 95 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<FigureInterval>,
}

/// The interval of a measure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FigureInterval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// How many draws it comes from.
    pub draws: usize,
    /// What was drawn: `units`, `recordings`, or the `samples` of gamma's chance, whose interval says nothing about other
    /// recordings.
    pub of: &'static str,
}

impl Figure {
    /// Returns the value with three decimals, never as -0.000.
    #[must_use]
    pub fn text(&self) -> Option<String> {
        // Adding 0 turns a rounded -0 into 0.
        self.value
            .map(|value| format!("{:.3}", (1e3 * value).round() / 1e3 + 0.0))
    }
}

impl From<Measure> for Figure {
    fn from(measure: Measure) -> Self {
        Self {
            value: measure.ok(),
            why: measure.err().map(|it| it.to_string()),
            interval: None,
        }
    }
}

pub(super) fn in_order<S: serde::Serializer>(
    measures: &[(&'static str, Figure)],
    out: S,
) -> std::result::Result<S::Ok, S::Error> {
    out.collect_map(measures.iter().map(|(name, figure)| (name, figure)))
}

/// The agreement on one value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueAgreement {
    /// The value.
    pub value: String,
    /// The units of the first with it.
    pub a: u64,
    /// The units of the second with it.
    pub b: u64,
    /// The matched pairs in which both gave it.
    pub both: u64,
    /// The matched pairs in which only one gave it.
    pub other: u64,
    /// The units with it that nobody else has.
    pub alone: u64,
    /// Modified kappa's table of the value against all others: the share of agreement.
    pub raw: Figure,
    /// Kappa of that table.
    pub kappa: Figure,
    /// Alpha_U of the value.
    pub alpha_u: Figure,
}

/// Two values that the annotators gave to matched units.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Confusion {
    /// The value of the first.
    pub a: String,
    /// The value of the second.
    pub b: String,
    /// How often.
    pub count: u64,
    /// The features that only the first value has.
    pub only_a: Vec<String>,
    /// The features that only the second value has.
    pub only_b: Vec<String>,
}

/// The matched units of a pair of tiers.
struct Matched<'a> {
    first: &'a [Unit],
    second: &'a [Unit],
    pairs: Vec<(usize, usize)>,
    rows: Vec<Row>,
}

impl<'a> Matched<'a> {
    fn of(pair: &'a TierPair, share: f64) -> Self {
        let (first, second) = sides(&pair.continuum);
        let pairs = matched(first, second, share);
        let rows = rows(first, second, &pairs);
        Self {
            first,
            second,
            pairs,
            rows,
        }
    }

    fn counts(&self, left_out: [u64; 2]) -> UnitCounts {
        let equal = self.pairs.iter();
        let equal = equal.filter(|(a, b)| self.first[*a].value == self.second[*b].value);
        let matched = self.pairs.len();
        UnitCounts {
            units_a: self.first.len() as u64,
            units_b: self.second.len() as u64,
            matched: matched as u64,
            equal: equal.count() as u64,
            unmatched_a: (self.first.len() - matched) as u64,
            unmatched_b: (self.second.len() - matched) as u64,
            left_out_a: left_out[0],
            left_out_b: left_out[1],
        }
    }
}

/// Returns the units of the two annotators.
pub(super) fn sides(continuum: &Continuum) -> (&[Unit], &[Unit]) {
    match continuum.tiers() {
        [first, second, ..] => (first, second),
        _ => (&[], &[]),
    }
}

/// Returns the agreement over all pairs of tiers, and of each.
pub(super) fn agreement(
    coded: &Coded,
    options: &AgreeOptions,
    progress: &mut Progress<'_>,
) -> Result<Agreement> {
    let all: Vec<Matched<'_>> = coded
        .pairs
        .iter()
        .map(|it| Matched::of(it, options.share))
        .collect();
    let mut counts = UnitCounts::default();
    let mut pairs = Vec::new();
    for (pair, matched) in coded.pairs.iter().zip(&all) {
        let own = matched.counts(pair.left_out);
        counts.add(&own);
        let measures = match coded.pairs.len() {
            1 => Vec::new(),
            _ => measures(&[pair], std::slice::from_ref(matched), coded, options),
        };
        pairs.push(PairAgreement {
            recording: pair.recording.name.clone(),
            tier_a: pair.a.name.clone(),
            tier_b: pair.b.name.clone(),
            counts: own,
            measures,
        });
    }
    let every: Vec<&TierPair> = coded.pairs.iter().collect();
    let mut figures = measures(&every, &all, coded, options);
    if let [only] = &mut pairs[..] {
        only.measures.clone_from(&figures);
    }
    add_intervals(&mut figures, &all, coded, options, progress)?;
    add_gamma(&mut figures, coded, options, progress)?;
    let place = |name: &str| MEASURES.iter().position(|it| *it == name);
    figures.sort_by_key(|(name, _)| place(name));
    let distances = Distances::of(coded);
    let mut findings = coded.findings.clone();
    let list = list(coded, &distances, options, &mut findings);
    let moved = |of: fn(&Unit) -> i64| {
        let apart = |it: &Matched<'_>| -> Vec<f64> {
            let pairs = it.pairs.iter();
            pairs
                .map(|(a, b)| (of(&it.second[*b]) - of(&it.first[*a])) as f64 / 1000.0)
                .collect()
        };
        Quartiles::of(all.iter().flat_map(apart).collect())
    };
    if counts.left_out_a + counts.left_out_b > 0 {
        findings.push(format!(
            "annotations without a value are left out: {} of {:?}, {} of {:?}",
            counts.left_out_a, options.a, counts.left_out_b, options.b
        ));
    }
    Ok(Agreement {
        a: options.a.clone(),
        b: options.b.clone(),
        values: if coded.spans_only {
            0
        } else {
            coded.values.len()
        },
        counts_only: counts.are_few() || coded.values.len() < 2,
        counts,
        measures: figures,
        onset_s: moved(|it| it.start),
        offset_s: moved(|it| it.end),
        by_value: by_value(coded, &all),
        disagreements: tally(&list),
        pairs,
        findings,
        confusion: confusion(coded, &all),
        list,
    })
}

/// Returns the measures without gamma and intervals.
fn measures(
    pairs: &[&TierPair],
    all: &[Matched<'_>],
    coded: &Coded,
    options: &AgreeOptions,
) -> Vec<(&'static str, Figure)> {
    let mut figures: Vec<(&'static str, Figure)> = Vec::new();
    let mut add = |name: &'static str, measure: Measure| {
        if options.wants(name) {
            figures.push((name, measure.into()));
        }
    };
    let table = Table::of(
        all.iter().flat_map(|it| it.rows.iter().copied()),
        coded.values.len(),
    );
    for (name, measure) in of_table(&table, coded.values.len()) {
        add(name, measure);
    }
    let wants = |names: &[&str]| names.iter().any(|it| options.wants(it));
    if coded.are_handshapes && options.wants("label_alpha_features") {
        let items: Vec<Item> = matched_values(all)
            .map(|(a, b)| vec![Some(a), Some(b)])
            .collect();
        let distances = Distances::of(coded);
        let distance = |a: usize, b: usize| distances.between(a, b);
        add(
            "label_alpha_features",
            alpha(&items, Scale::Distance(&distance)),
        );
    }
    let (mut there, mut back, mut units) = (0.0, 0.0, 0.0);
    if wants(&["overlap_a", "overlap_b"]) {
        for (one, pair) in all.iter().zip(pairs) {
            // The mean over all pairs of tiers, weighted by their units.
            let weight = pair.continuum.units() as f64;
            if let (Ok(ab), Ok(ba)) = (
                overlap_ratio(one.first, one.second),
                overlap_ratio(one.second, one.first),
            ) {
                there += ab * weight;
                back += ba * weight;
                units += weight;
            }
        }
        let mean = |sum: f64| match units {
            0.0 => Err(Undefined::BothEmpty),
            units => Ok(sum / units),
        };
        add("overlap_a", mean(there));
        add("overlap_b", mean(back));
    }
    let one_by_one: Vec<Continuum> = pairs.iter().map(|it| it.continuum.clone()).collect();
    let joined = Continuum::joined(&one_by_one);
    if options.wants("alpha_u") {
        add("alpha_u", alpha_u(&joined));
    }
    if wants(&["u_alpha", "u_alpha_spans", "cu_alpha"]) {
        let family = u_alpha(&joined);
        add("u_alpha", family.all);
        add("u_alpha_spans", family.spans);
        add("cu_alpha", family.values);
    }
    if wants(&["frames_raw", "frames_kappa", "frames_alpha"]) {
        let found = match joined.units() {
            0 => None,
            _ => Some(frames(&joined, FRAME)),
        };
        let empty = Err(Undefined::BothEmpty);
        add("frames_raw", found.map_or(empty, |it| it.raw));
        add("frames_kappa", found.map_or(empty, |it| it.kappa));
        add("frames_alpha", found.map_or(empty, |it| it.alpha));
    }
    if options.wants("boundaries") {
        add("boundaries", boundaries(all));
    }
    figures
}

/// Returns the measures that follow from the table of Holle and Rein; with one value chance explains all.
fn of_table(table: &Table, values: usize) -> [(&'static str, Measure); 10] {
    let inner: &Counts = table.matched();
    let kappa_ipf = match values {
        0 => Err(Undefined::BothEmpty),
        1 => Err(Undefined::OneValue),
        _ => table.kappa_ipf(),
    };
    let matched = match table.total() {
        0.0 => Err(Undefined::BothEmpty),
        total => Ok(2.0 * inner.total() / total),
    };
    [
        ("kappa_ipf", kappa_ipf),
        ("raw", table.raw()),
        ("matched", matched),
        ("kappa", table.kappa()),
        ("kappa_max", table.kappa_max()),
        ("label_raw", inner.raw()),
        ("label_kappa", inner.cohen()),
        ("label_pi", inner.scott()),
        ("label_ac1", inner.gwet()),
        ("label_alpha", inner.alpha()),
    ]
}

/// Returns the values of matched units.
fn matched_values(all: &[Matched<'_>]) -> impl Iterator<Item = (usize, usize)> {
    let pairs = |it: &Matched<'_>| -> Vec<(usize, usize)> {
        let pairs = it.pairs.iter();
        pairs
            .map(|(a, b)| (it.first[*a].value, it.second[*b].value))
            .collect()
    };
    all.iter().flat_map(pairs)
}

/// Returns the boundary similarity of tiers whose units follow each other.
fn boundaries(all: &[Matched<'_>]) -> Measure {
    let mut sum = Edits::default();
    for one in all
        .iter()
        .filter(|it| !it.first.is_empty() || !it.second.is_empty())
    {
        for units in [one.first, one.second] {
            let apart = |pair: &[Unit]| pair[1].start - pair[0].end >= STEP;
            if units.is_empty() || units.windows(2).any(apart) {
                return Err(Undefined::Gaps);
            }
        }
        let start = one.first[0].start.min(one.second[0].start);
        let end = one
            .first
            .iter()
            .chain(one.second)
            .map(|it| it.end)
            .max()
            .unwrap_or(start);
        let frame = |time: i64| ((time - start + STEP / 2) / STEP) as usize;
        let masses = |units: &[Unit]| -> Vec<usize> {
            let mut places: Vec<usize> = units.iter().map(|it| frame(it.start)).collect();
            places[0] = 0;
            places.push(frame(end));
            places
                .windows(2)
                .map(|it| it[1].saturating_sub(it[0]))
                .collect()
        };
        sum.add(&edits(&masses(one.first), &masses(one.second), NEAR));
    }
    sum.boundary_similarity(NEAR)
}

/// Adds the percentile intervals of the measures of the table: units are drawn again, or recordings if there are many,
/// which gives alpha_U an interval, too.
fn add_intervals(
    figures: &mut [(&'static str, Figure)],
    all: &[Matched<'_>],
    coded: &Coded,
    options: &AgreeOptions,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let filled: Vec<&Matched<'_>> = all.iter().filter(|it| !it.rows.is_empty()).collect();
    let by_recording = filled.len() >= RECORDINGS;
    let every: Vec<Row> = filled
        .iter()
        .flat_map(|it| it.rows.iter().copied())
        .collect();
    let count = if by_recording {
        filled.len()
    } else {
        every.len()
    };
    if count < 2 || options.draws == 0 {
        return Ok(());
    }
    let values = coded.values.len();
    let pairs = coded.pairs.iter().filter(|it| it.continuum.units() > 0);
    let continua: Vec<&Continuum> = pairs.map(|it| &it.continuum).collect();
    let over_time = by_recording && options.wants("alpha_u");
    let mut drawn: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    let (mut done, mut stopped) = (0_u64, Ok(()));
    bootstrap(count, options.draws, options.seed, |places| {
        if stopped.is_err() {
            return;
        }
        done += 1;
        if done % 64 == 0 {
            stopped = step(progress, "intervals", done, options.draws);
        }
        let table = match by_recording {
            true => {
                let rows = places
                    .iter()
                    .flat_map(|at| filled[*at].rows.iter().copied());
                Table::of(rows, values)
            }
            false => Table::of(places.iter().map(|at| every[*at]), values),
        };
        let alpha = over_time.then(|| {
            let again: Vec<Continuum> = places.iter().map(|at| continua[*at].clone()).collect();
            ("alpha_u", alpha_u(&Continuum::joined(&again)))
        });
        for (name, measure) in of_table(&table, values).into_iter().chain(alpha) {
            // Draws of a maximum over margins lie below it, so that their percentiles can miss it.
            if let (true, Ok(value)) = (name != "kappa_max", measure) {
                drawn.entry(name).or_default().push(value);
            }
        }
    });
    stopped?;
    for (name, figure) in figures.iter_mut().filter(|(_, it)| it.value.is_some()) {
        let interval = drawn.remove(name).and_then(Interval::of);
        let of = if by_recording { "recordings" } else { "units" };
        figure.interval = interval.map(|it| interval_of(it, of));
    }
    Ok(())
}

fn interval_of(it: Interval, of: &'static str) -> FigureInterval {
    FigureInterval {
        low: it.low,
        high: it.high,
        draws: it.draws,
        of,
    }
}

fn step(progress: &mut Progress<'_>, task: &str, done: u64, total: usize) -> Result<()> {
    progress.report(Step {
        task,
        done,
        total: Some(total as u64),
        unit: Amount::Items,
    })
}

/// The end of the search for gamma: it is undefined, or the user stopped it.
enum Halt {
    Undefined(Undefined),
    Failed(Error),
}

impl From<Undefined> for Halt {
    fn from(reason: Undefined) -> Self {
        Self::Undefined(reason)
    }
}

/// Adds gamma and gamma_cat, if they are asked for.
fn add_gamma(
    figures: &mut Vec<(&'static str, Figure)>,
    coded: &Coded,
    options: &AgreeOptions,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let wanted = ["gamma", "gamma_cat"].map(|it| options.wants(it));
    if options.samples == 0 || wanted == [false, false] {
        return Ok(());
    }
    let continua: Vec<Continuum> = coded.pairs.iter().map(|it| it.continuum.clone()).collect();
    let sampling = Sampling {
        samples: options.samples,
        precision: None,
        seed: options.seed,
    };
    let hear = |done: usize| {
        step(progress, "random continua", done as u64, options.samples).map_err(Halt::Failed)
    };
    let (measure, categorical, interval) =
        match gamma(&continua, &Costs::default(), &sampling, hear) {
            Ok(Gamma {
                gamma,
                categorical,
                interval,
                ..
            }) => (gamma, categorical, interval),
            Err(Halt::Undefined(reason)) => (Err(reason), Err(reason), None),
            Err(Halt::Failed(error)) => return Err(error),
        };
    let mut found = [
        ("gamma", Figure::from(measure)),
        ("gamma_cat", categorical.into()),
    ];
    found[0].1.interval = interval.map(|it| interval_of(it, "samples"));
    let found = found.into_iter().zip(wanted);
    figures.extend(found.filter(|(_, wanted)| *wanted).map(|(it, _)| it));
    Ok(())
}

/// Returns the agreement on each value.
fn by_value(coded: &Coded, all: &[Matched<'_>]) -> Vec<ValueAgreement> {
    if coded.spans_only {
        return Vec::new();
    }
    let table = Table::of(
        all.iter().flat_map(|it| it.rows.iter().copied()),
        coded.values.len(),
    );
    let continua: Vec<Continuum> = coded.pairs.iter().map(|it| it.continuum.clone()).collect();
    let over_time = disagreements(&Continuum::joined(&continua));
    let mut counts = vec![[0_u64; 5]; coded.values.len()];
    for row in all.iter().flat_map(|it| &it.rows) {
        let [a, b, both, other, alone] = [0, 1, 2, 3, 4];
        for (value, side) in [(row.0, a), (row.1, b)] {
            if let Some(value) = value {
                counts[value][side] += 1;
            }
        }
        match *row {
            (Some(one), Some(two)) if one == two => counts[one][both] += 1,
            (Some(one), Some(two)) => {
                counts[one][other] += 1;
                counts[two][other] += 1;
            }
            (Some(only), None) | (None, Some(only)) => counts[only][alone] += 1,
            (None, None) => {}
        }
    }
    let value = |(number, name): (usize, &String)| {
        let [a, b, both, other, alone] = counts[number];
        let own = table.value(number);
        let alpha_u = over_time
            .get(&number)
            .map_or(Err(Undefined::BothEmpty), |it| it.alpha());
        ValueAgreement {
            value: name.clone(),
            a,
            b,
            both,
            other,
            alone,
            raw: own.raw().into(),
            kappa: own.kappa().into(),
            alpha_u: alpha_u.into(),
        }
    };
    let mut rows: Vec<ValueAgreement> = coded.values.iter().enumerate().map(value).collect();
    rows.sort_by(|x, y| (y.a + y.b).cmp(&(x.a + x.b)).then(x.value.cmp(&y.value)));
    rows
}

/// Returns the pairs of different values of matched units.
fn confusion(coded: &Coded, all: &[Matched<'_>]) -> Vec<Confusion> {
    let mut counts: BTreeMap<(usize, usize), u64> = BTreeMap::new();
    for pair in matched_values(all).filter(|(a, b)| a != b) {
        *counts.entry(pair).or_default() += 1;
    }
    let row = |((a, b), count): ((usize, usize), u64)| {
        let less = |own: usize, other: usize| -> Vec<String> {
            let (own, other): (&BTreeSet<String>, _) =
                (&coded.features[own], &coded.features[other]);
            own.difference(other).cloned().collect()
        };
        Confusion {
            a: coded.values[a].clone(),
            b: coded.values[b].clone(),
            count,
            only_a: less(a, b),
            only_b: less(b, a),
        }
    };
    let mut rows: Vec<Confusion> = counts.into_iter().map(row).collect();
    rows.sort_by(|x, y| y.count.cmp(&x.count).then((&x.a, &x.b).cmp(&(&y.a, &y.b))));
    rows
}
