//! Gamma (Mathet, Widlöcher and Métivier 2015) and gamma_cat (Mathet 2017): units of all annotators are aligned so that
//! the disorder is least, and the disorder is compared with that of random units.

use std::collections::BTreeMap;

use super::agreement_resample::BootstrapInterval;
use super::assignment::{AssignmentEdges, assign_least_cost};
use super::{AgreementMeasure, AnnotatedUnit, AnnotationContinuum, UndefinedAgreement};
use crate::random::RandomNumbers;

/// The most pairs that are compared, and the most candidates among them: 4 million take seconds.
const MAX_GAMMA_PAIRS: usize = 20_000_000;
const MOST_CANDIDATES: usize = 4_000_000;
/// The most steps of the search for an alignment of three or more annotators.
const MOST_STEPS: u64 = 20_000_000;

/// The costs of an alignment.
#[derive(Clone, Copy)]
pub struct AlignmentCosts<'a> {
    /// The weight of distances in time, α.
    pub time: f64,
    /// The weight of different values, β.
    pub value: f64,
    /// The cost of a unit without a partner, Δ∅.
    pub alone: f64,
    /// The distance of two values, from 0 to 1; `None`: 1 if they differ.
    pub distance: Option<&'a dyn Fn(usize, usize) -> f64>,
}

impl Default for AlignmentCosts<'_> {
    fn default() -> Self {
        Self {
            time: 1.0,
            value: 1.0,
            alone: 1.0,
            distance: None,
        }
    }
}

impl AlignmentCosts<'_> {
    /// Returns the dissimilarity of the places of two units: the square of the distances of starts and ends over the
    /// sum of the lengths.
    #[must_use]
    pub fn place_dissimilarity(&self, a: &AnnotatedUnit, b: &AnnotatedUnit) -> f64 {
        let distance = (a.start - b.start).abs() + (a.end - b.end).abs();
        let length = (a.unit_length() + b.unit_length()).max(1);
        (distance as f64 / length as f64).powi(2)
    }

    /// Returns the dissimilarity of two values.
    #[must_use]
    pub fn value_dissimilarity(&self, a: &AnnotatedUnit, b: &AnnotatedUnit) -> f64 {
        match self.distance {
            _ if a.value == b.value => 0.0,
            Some(distance) => distance(a.value, b.value),
            None => 1.0,
        }
    }

    /// Returns the cost of aligning two units.
    #[must_use]
    pub fn unit_pair_cost(&self, a: &AnnotatedUnit, b: &AnnotatedUnit) -> f64 {
        self.alone * (self.time * self.place_dissimilarity(a, b) + self.value * self.value_dissimilarity(a, b))
    }
}

/// Units that are taken for one: the place of the unit in the tier of each annotator.
pub type AlignedUnits = Vec<Option<usize>>;

/// The alignment of least disorder.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitAlignment {
    /// The groups of units, by time.
    pub groups: Vec<AlignedUnits>,
    /// The sum of the costs of the groups.
    pub cost: f64,
    /// The mean number of units of an annotator.
    pub units: f64,
}

impl UnitAlignment {
    /// Returns the disorder: the costs over the mean number of units.
    #[must_use]
    pub fn alignment_disorder(&self) -> f64 {
        self.cost / self.units
    }
}

/// Returns the alignment of least disorder: exact, by assignment for two annotators and by branch and bound for more.
///
/// # Errors
/// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::Missing`] for fewer than two annotators, [`UndefinedAgreement::TooMany`].
pub fn align_continuum(
    continuum: &AnnotationContinuum,
    costs: &AlignmentCosts<'_>,
) -> Result<UnitAlignment, UndefinedAgreement> {
    if continuum.annotated_unit_count() == 0 {
        return Err(UndefinedAgreement::BothEmpty);
    }
    let tiers = continuum.annotator_tiers();
    let mut groups = match tiers {
        [] | [_] => return Err(UndefinedAgreement::Missing),
        [first, second] => pairwise(first, second, costs)?,
        several => search_unit_groups(several, costs)?,
    };
    let begins = |group: &AlignedUnits| {
        let starts = group.iter().zip(tiers);
        starts.filter_map(|(at, tier)| Some(tier[(*at)?].start)).min()
    };
    // Groups that begin together are sorted by their units, so that the search leaves no trace.
    groups.sort_by_cached_key(|group| (begins(group), group.clone()));
    let cost = groups.iter().map(|group| group_cost(group, tiers, costs)).sum();
    Ok(UnitAlignment {
        groups,
        cost,
        units: continuum.annotated_unit_count() as f64 / tiers.len() as f64,
    })
}

/// Returns the mean cost of the pairs of a group.
fn group_cost(group: &AlignedUnits, tiers: &[Vec<AnnotatedUnit>], costs: &AlignmentCosts<'_>) -> f64 {
    let (mut sum, mut pairs) = (0.0, 0.0);
    for (nth, a) in group.iter().enumerate() {
        for (other, b) in group.iter().enumerate().skip(nth + 1) {
            pairs += 1.0;
            sum += match (a, b) {
                (Some(a), Some(b)) => costs.unit_pair_cost(&tiers[nth][*a], &tiers[other][*b]),
                (None, None) => costs.alone,
                _ => costs.alone,
            };
        }
    }
    sum / pairs
}

/// Returns the candidates of each unit in the other tier: pairs that cost less than the two units alone.
fn unit_pair_candidates(
    first: &[AnnotatedUnit],
    second: &[AnnotatedUnit],
    costs: &AlignmentCosts<'_>,
) -> Result<AssignmentEdges, UndefinedAgreement> {
    let both = 2.0 * costs.alone;
    let longest = second.iter().map(AnnotatedUnit::unit_length).max().unwrap_or(0);
    // Of a pair worth its cost, the starts and ends lie together at most this share of both lengths apart.
    let reach = (2.0 / costs.time.max(1e-9)).sqrt();
    let (mut edges, mut compared, mut kept) = (Vec::with_capacity(first.len()), 0_usize, 0_usize);
    for a in first {
        let within = (reach * (a.unit_length() + longest) as f64).ceil() as i64;
        let from = second.partition_point(|b| b.start < a.start.saturating_sub(within));
        let to = second.partition_point(|b| b.start <= a.start.saturating_add(within));
        compared += to - from;
        if compared > MAX_GAMMA_PAIRS {
            return Err(UndefinedAgreement::TooMany);
        }
        let near = second[from..to].iter().enumerate();
        let edge = |(at, b)| (from + at, costs.unit_pair_cost(a, b) - both);
        let neighbour_edges: Vec<(usize, f64)> = near.map(edge).filter(|(_, cost)| *cost < 0.0).collect();
        kept += neighbour_edges.len();
        if kept > MOST_CANDIDATES {
            return Err(UndefinedAgreement::TooMany);
        }
        edges.push(neighbour_edges);
    }
    Ok(edges)
}

fn pairwise(
    first: &[AnnotatedUnit],
    second: &[AnnotatedUnit],
    costs: &AlignmentCosts<'_>,
) -> Result<Vec<AlignedUnits>, UndefinedAgreement> {
    let edges = unit_pair_candidates(first, second, costs)?;
    let columns = assign_least_cost(&edges, second.len());
    let mut alone = vec![true; second.len()];
    let mut groups: Vec<AlignedUnits> = Vec::with_capacity(first.len());
    for (at, column) in columns.into_iter().enumerate() {
        if let Some(column) = column {
            alone[column] = false;
        }
        groups.push(vec![Some(at), column]);
    }
    let rest = alone.iter().enumerate().filter(|(_, alone)| **alone);
    groups.extend(rest.map(|(at, _)| vec![None, Some(at)]));
    Ok(groups)
}

/// Returns the groups of least cost for three or more annotators.
///
/// Each unit gets the groups that begin with it, in the order of annotators and units, that cost less than their units
/// alone. Branch and bound covers every unit once; the bound is the least share of any group for each open unit.
fn search_unit_groups(
    tiers: &[Vec<AnnotatedUnit>],
    costs: &AlignmentCosts<'_>,
) -> Result<Vec<AlignedUnits>, UndefinedAgreement> {
    let alone = costs.alone;
    let mut offsets = vec![0];
    for tier in tiers {
        offsets.push(offsets[offsets.len() - 1] + tier.len());
    }
    let units = offsets[tiers.len()];
    let mut groups: Vec<(AlignedUnits, f64)> = Vec::new();
    let mut steps = 0_u64;
    for (first, tier) in tiers.iter().enumerate() {
        for at in 0..tier.len() {
            let mut group: AlignedUnits = vec![None; tiers.len()];
            group[first] = Some(at);
            extend_unit_group(&mut group, first + 1, tiers, costs, &mut groups, &mut steps)?;
        }
    }
    // Each group under its first unit, and the least share of each unit.
    let mut of_unit: Vec<Vec<(Vec<usize>, f64, usize)>> = vec![Vec::new(); units];
    let mut least = vec![alone; units];
    for (nth, (group, cost)) in groups.iter().enumerate() {
        let places = group.iter().zip(&offsets);
        let members: Vec<usize> = places.filter_map(|(at, from)| Some(from + (*at)?)).collect();
        let share = cost / members.len() as f64;
        for member in &members {
            least[*member] = least[*member].min(share);
            of_unit[*member].push((members.clone(), *cost, nth));
        }
    }
    // Cheap groups first, so that a good cover is found early and cuts off the rest.
    for own in &mut of_unit {
        own.sort_by(|a, b| {
            let share = |candidate: &(Vec<usize>, f64, usize)| candidate.1 / candidate.0.len() as f64;
            share(a).total_cmp(&share(b))
        });
    }
    let mut chosen = Vec::new();
    // Components share no unit, so that each is covered alone.
    for component in connect_grouped_units(&of_unit) {
        let mut search = GroupCoverSearch {
            of_unit: &of_unit,
            least: &least,
            order: component,
            covered: vec![false; units],
            chosen: Vec::new(),
            best: f64::INFINITY,
            found: Vec::new(),
            steps: &mut steps,
        };
        let bound = search.order.iter().map(|unit| least[*unit]).sum();
        search.search_group_cover(0, 0.0, bound)?;
        chosen.extend(search.found);
    }
    Ok(chosen.into_iter().map(|nth| groups[nth].0.clone()).collect())
}

/// Adds all groups that extend `group` by units of the annotators from `from` on, unless they cost more than their
/// units alone.
fn extend_unit_group(
    group: &mut AlignedUnits,
    from: usize,
    tiers: &[Vec<AnnotatedUnit>],
    costs: &AlignmentCosts<'_>,
    groups: &mut Vec<(AlignedUnits, f64)>,
    steps: &mut u64,
) -> Result<(), UndefinedAgreement> {
    if from == tiers.len() {
        let cost = group_cost(group, tiers, costs);
        if cost <= costs.alone * group.iter().flatten().count() as f64 {
            groups.push((group.clone(), cost));
        }
        return Ok(());
    }
    // A group may go without this annotator.
    extend_unit_group(group, from + 1, tiers, costs, groups, steps)?;
    let annotators = tiers.len() as f64;
    let pairs = annotators * (annotators - 1.0) / 2.0;
    for at in 0..tiers[from].len() {
        *steps += 1;
        if *steps > MOST_STEPS {
            return Err(UndefinedAgreement::TooMany);
        }
        let unit = &tiers[from][at];
        let member_tiers = group.iter().zip(tiers);
        let with = member_tiers.filter_map(|(at, tier)| Some(costs.unit_pair_cost(&tier[(*at)?], unit)));
        // One such pair alone makes the group dearer than its units.
        if with.fold(0.0, f64::max) / pairs > costs.alone * annotators {
            continue;
        }
        group[from] = Some(at);
        extend_unit_group(group, from + 1, tiers, costs, groups, steps)?;
        group[from] = None;
    }
    Ok(())
}

/// Returns the units that groups connect, each component by number.
fn connect_grouped_units(of_unit: &[Vec<(Vec<usize>, f64, usize)>]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; of_unit.len()];
    let mut all = Vec::new();
    for unit in 0..of_unit.len() {
        if seen[unit] {
            continue;
        }
        seen[unit] = true;
        let (mut component, mut at) = (vec![unit], 0);
        while let Some(open) = component.get(at).copied() {
            at += 1;
            for member in of_unit[open].iter().flat_map(|(members, ..)| members) {
                if !seen[*member] {
                    seen[*member] = true;
                    component.push(*member);
                }
            }
        }
        component.sort_unstable();
        all.push(component);
    }
    all
}

struct GroupCoverSearch<'a> {
    of_unit: &'a [Vec<(Vec<usize>, f64, usize)>],
    least: &'a [f64],
    order: Vec<usize>,
    covered: Vec<bool>,
    chosen: Vec<usize>,
    best: f64,
    found: Vec<usize>,
    steps: &'a mut u64,
}

impl GroupCoverSearch<'_> {
    fn search_group_cover(&mut self, mut at: usize, cost: f64, bound: f64) -> Result<(), UndefinedAgreement> {
        *self.steps += 1;
        if *self.steps > MOST_STEPS {
            return Err(UndefinedAgreement::TooMany);
        }
        while at < self.order.len() && self.covered[self.order[at]] {
            at += 1;
        }
        if at == self.order.len() {
            if cost < self.best {
                self.best = cost;
                self.found.clone_from(&self.chosen);
            }
            return Ok(());
        }
        let all = self.of_unit;
        for (members, own, nth) in &all[self.order[at]] {
            let freed: f64 = members.iter().map(|member| self.least[*member]).sum();
            let is_free = members.iter().all(|member| !self.covered[*member]);
            // Covers that differ by rounding alone are not searched again.
            if !is_free || cost + own + bound - freed >= self.best - 1e-12 {
                continue;
            }
            members.iter().for_each(|member| self.covered[*member] = true);
            self.chosen.push(*nth);
            self.search_group_cover(at + 1, cost + own, bound - freed)?;
            self.chosen.pop();
            members.iter().for_each(|member| self.covered[*member] = false);
        }
        Ok(())
    }
}

/// The settings of gamma's chance: how many random continua, and their seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GammaSampling {
    /// The number of random continua, at least 30.
    pub samples: usize,
    /// More are drawn until the mean disorder is this exact, with 95 % confidence: 0.02 is 2 %.
    pub precision: Option<f64>,
    /// The seed.
    pub seed: u64,
}

impl Default for GammaSampling {
    fn default() -> Self {
        Self {
            samples: 30,
            precision: None,
            seed: 1,
        }
    }
}

/// The most random continua that a wish for precision can ask for.
const MAX_GAMMA_SAMPLES: usize = 1000;

/// Gamma with its parts.
#[derive(Debug, Clone, PartialEq)]
pub struct GammaAgreement {
    /// Gamma: 1 less the observed disorder over the expected one.
    pub gamma: AgreementMeasure,
    /// Gamma of the values of aligned units.
    pub categorical: AgreementMeasure,
    /// The observed disorder.
    pub observed: f64,
    /// The mean disorder of random continua.
    pub expected: f64,
    /// The number of random continua.
    pub samples: usize,
    /// The interval of gamma that follows from the standard error of the expected disorder.
    pub interval: Option<BootstrapInterval>,
}

/// Returns gamma over several continua, such as recordings: their disorders are added up before they are divided.
///
/// Random units are drawn as in pygamma-agreement: number, gaps and lengths from normal distributions with the mean and
/// standard deviation of the real ones, values by their shares. The paper shifts the real units instead. Gaps, lengths
/// and values are those of all continua; the number of units is that of each. `step` is called before each sample.
///
/// # Errors
/// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::TooMany`], or the error of `step`.
pub fn measure_gamma_agreement<E: From<UndefinedAgreement>>(
    continua: &[AnnotationContinuum],
    costs: &AlignmentCosts<'_>,
    sampling: &GammaSampling,
    mut step: impl FnMut(usize) -> Result<(), E>,
) -> Result<GammaAgreement, E> {
    let filled: Vec<&AnnotationContinuum> = continua
        .iter()
        .filter(|continuum| continuum.annotated_unit_count() > 0)
        .collect();
    if filled.is_empty() {
        return Err(UndefinedAgreement::BothEmpty.into());
    }
    let (mut observed, mut values) = (WeightedMean::default(), WeightedMean::default());
    for continuum in &filled {
        add_continuum_disorder(continuum, costs, &mut observed, &mut values)?;
    }
    let source = RandomUnitSource::from_continua(&filled);
    let mut random = RandomNumbers::new(sampling.seed);
    let (mut disorders, mut of_values): (Vec<f64>, Vec<f64>) = Default::default();
    let mut wanted = sampling.samples.max(30);
    while disorders.len() < wanted {
        step(disorders.len())?;
        let (mut whole, mut cat) = (WeightedMean::default(), WeightedMean::default());
        for continuum in &filled {
            let drawn = source.draw_random_units(continuum, &mut random);
            add_continuum_disorder(&drawn, costs, &mut whole, &mut cat)?;
        }
        disorders.extend(whole.weighted_mean_value());
        of_values.extend(cat.weighted_mean_value());
        if let (true, Some(precision)) = (disorders.len() == wanted, sampling.precision) {
            let (mean, deviation) = mean_and_deviation(&disorders);
            // The count that makes the 95 % interval of the mean as narrow as asked, at the spread so far.
            let needed = (1.96 * deviation / (mean * precision)).powi(2).ceil();
            wanted = wanted.max(needed.min(MAX_GAMMA_SAMPLES as f64) as usize);
        }
    }
    let (expected, deviation) = mean_and_deviation(&disorders);
    let seen = observed.weighted_mean_value().unwrap_or(0.0);
    let error = 1.96 * deviation / (disorders.len() as f64).sqrt();
    let gamma_value = |expected: f64| 1.0 - seen / expected;
    let is_chance = expected > 1e-12;
    let (chance_of_values, _) = mean_and_deviation(&of_values);
    Ok(GammaAgreement {
        gamma: match is_chance {
            true => Ok(gamma_value(expected)),
            false => Err(UndefinedAgreement::NoChance),
        },
        categorical: match values.weighted_mean_value() {
            _ if source.values.len() < 2 => Err(UndefinedAgreement::OneValue),
            None => Err(UndefinedAgreement::NoPair),
            Some(_) if chance_of_values <= 1e-12 => Err(UndefinedAgreement::NoChance),
            Some(values) => Ok(1.0 - values / chance_of_values),
        },
        observed: seen,
        expected,
        samples: disorders.len(),
        // An expected disorder that may be 0 leaves gamma without a lower bound.
        interval: (is_chance && expected > error).then(|| BootstrapInterval {
            low: gamma_value(expected - error),
            high: gamma_value(expected + error),
            draws: disorders.len(),
        }),
    })
}

/// A weighted mean that is added up.
#[derive(Default)]
struct WeightedMean {
    sum: f64,
    weight: f64,
}

impl WeightedMean {
    fn weighted_mean_value(&self) -> Option<f64> {
        (self.weight > 0.0).then(|| self.sum / self.weight)
    }
}

/// Adds the disorder of a continuum, and the disorder of the values of its aligned units.
///
/// A pair of units weighs more the nearer they lie to each other: `max(0, 1 - apart) / (units of the group - 1)`.
fn add_continuum_disorder(
    continuum: &AnnotationContinuum,
    costs: &AlignmentCosts<'_>,
    whole: &mut WeightedMean,
    values: &mut WeightedMean,
) -> Result<(), UndefinedAgreement> {
    let aligned = align_continuum(continuum, costs)?;
    whole.sum += aligned.cost;
    whole.weight += aligned.units;
    let tiers = continuum.annotator_tiers();
    for group in &aligned.groups {
        let member_tiers = group.iter().zip(tiers);
        let units: Vec<&AnnotatedUnit> = member_tiers.filter_map(|(at, tier)| tier.get((*at)?)).collect();
        for (nth, a) in units.iter().enumerate() {
            for b in &units[nth + 1..] {
                let near = (1.0 - costs.place_dissimilarity(a, b)).max(0.0);
                let weight = near / (units.len() - 1) as f64;
                values.sum += weight * costs.value_dissimilarity(a, b);
                values.weight += weight;
            }
        }
    }
    Ok(())
}

/// Returns mean and standard deviation.
fn mean_and_deviation(all: &[f64]) -> (f64, f64) {
    if all.is_empty() {
        return (0.0, 0.0);
    }
    let count = all.len() as f64;
    let mean = all.iter().sum::<f64>() / count;
    let square = all.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    (mean, square.sqrt())
}

/// The numbers from which random units are drawn.
struct RandomUnitSource {
    gap: (f64, f64),
    length: (f64, f64),
    /// Each value with the share of units up to it.
    values: Vec<(usize, f64)>,
}

impl RandomUnitSource {
    fn from_continua(continua: &[&AnnotationContinuum]) -> Self {
        let (mut gaps, mut lengths) = (Vec::new(), Vec::new());
        let mut counts: BTreeMap<usize, f64> = BTreeMap::new();
        for continuum in continua {
            for tier in continuum.annotator_tiers() {
                let first = tier
                    .first()
                    .map(|unit| (unit.start - continuum.continuum_start()) as f64);
                // A tier that begins with the continuum has no gap before it.
                gaps.extend(first.filter(|gap| *gap > 0.0));
                gaps.extend(tier.windows(2).map(|pair| (pair[1].start - pair[0].end) as f64));
                lengths.extend(tier.iter().map(|unit| unit.unit_length() as f64));
                for unit in tier {
                    *counts.entry(unit.value).or_default() += 1.0;
                }
            }
        }
        // Sorted numbers have the same sum whoever comes first.
        gaps.sort_by(f64::total_cmp);
        lengths.sort_by(f64::total_cmp);
        let all: f64 = counts.values().sum();
        let mut sum = 0.0;
        let shares = counts.into_iter().map(|(value, count)| {
            sum += count / all;
            (value, sum)
        });
        Self {
            values: shares.collect(),
            gap: mean_and_deviation(&gaps),
            length: mean_and_deviation(&lengths),
        }
    }

    /// Draws random units for the annotators of a continuum.
    fn draw_random_units(&self, like: &AnnotationContinuum, random: &mut RandomNumbers) -> AnnotationContinuum {
        let counts: Vec<f64> = like.annotator_tiers().iter().map(|tier| tier.len() as f64).collect();
        let (mean, deviation) = mean_and_deviation(&counts);
        // A wide spread of counts must not draw many times the real units.
        let most = 2.0 * counts.iter().sum::<f64>();
        let tier = |_: &Vec<AnnotatedUnit>| {
            let count = (mean + deviation * random.random_normal()).clamp(1.0, most) as usize;
            let mut end = 0.0;
            let unit = |_| {
                let start = end + self.gap.0 + self.gap.1 * random.random_normal();
                // A normal distribution also draws negative lengths.
                let length = (self.length.0 + self.length.1 * random.random_normal()).abs();
                end = start + length.max(1.0);
                let share = random.random_share();
                let nth = self.values.partition_point(|(_, upto)| *upto < share);
                // Rounding may leave the last share just below 1.
                let value_entry = self.values.get(nth).or(self.values.last());
                let value = value_entry.map_or(0, |entry| entry.0);
                AnnotatedUnit::new(
                    start.round() as i64,
                    // A unit that rounding leaves without length would be dropped.
                    (end.round() as i64).max(start.round() as i64 + 1),
                    value,
                )
            };
            (0..count).map(unit).collect()
        };
        let tiers = like.annotator_tiers().iter().map(tier).collect();
        AnnotationContinuum::new(0..0, tiers)
    }
}
