//! Gamma (Mathet, Widlöcher and Métivier 2015) and gamma_cat (Mathet 2017): units of all annotators are aligned so that
//! the disorder is least, and the disorder is compared with that of random units.

use std::collections::BTreeMap;

use super::assignment::{Edges, assign};
use super::resample::Interval;
use super::{Continuum, Measure, Undefined, Unit};
use crate::random::Random;

/// The most pairs that are compared, and the most candidates among them: 4 million take seconds.
const MOST_PAIRS: usize = 20_000_000;
const MOST_CANDIDATES: usize = 4_000_000;
/// The most steps of the search for an alignment of three or more annotators.
const MOST_STEPS: u64 = 20_000_000;

/// The costs of an alignment.
#[derive(Clone, Copy)]
pub struct Costs<'a> {
    /// The weight of distances in time, α.
    pub time: f64,
    /// The weight of different values, β.
    pub value: f64,
    /// The cost of a unit without a partner, Δ∅.
    pub alone: f64,
    /// The distance of two values, from 0 to 1; `None`: 1 if they differ.
    pub distance: Option<&'a dyn Fn(usize, usize) -> f64>,
}

impl Default for Costs<'_> {
    fn default() -> Self {
        Self {
            time: 1.0,
            value: 1.0,
            alone: 1.0,
            distance: None,
        }
    }
}

impl Costs<'_> {
    /// Returns the dissimilarity of the places of two units: the square of the distances of starts and ends over the
    /// sum of the lengths.
    #[must_use]
    pub fn apart(&self, a: &Unit, b: &Unit) -> f64 {
        let distance = (a.start - b.start).abs() + (a.end - b.end).abs();
        let length = (a.length() + b.length()).max(1);
        (distance as f64 / length as f64).powi(2)
    }

    /// Returns the dissimilarity of two values.
    #[must_use]
    pub fn differ(&self, a: &Unit, b: &Unit) -> f64 {
        match self.distance {
            _ if a.value == b.value => 0.0,
            Some(distance) => distance(a.value, b.value),
            None => 1.0,
        }
    }

    /// Returns the cost of aligning two units.
    #[must_use]
    pub fn pair(&self, a: &Unit, b: &Unit) -> f64 {
        self.alone * (self.time * self.apart(a, b) + self.value * self.differ(a, b))
    }
}

/// Units that are taken for one: the place of the unit in the tier of each annotator.
pub type Aligned = Vec<Option<usize>>;

/// The alignment of least disorder.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// The groups of units, by time.
    pub groups: Vec<Aligned>,
    /// The sum of the costs of the groups.
    pub cost: f64,
    /// The mean number of units of an annotator.
    pub units: f64,
}

impl Alignment {
    /// Returns the disorder: the costs over the mean number of units.
    #[must_use]
    pub fn disorder(&self) -> f64 {
        self.cost / self.units
    }
}

/// Returns the alignment of least disorder: exact, by assignment for two annotators and by branch and bound for more.
///
/// # Errors
/// [`Undefined::BothEmpty`], [`Undefined::Missing`] for fewer than two annotators, [`Undefined::TooMany`].
pub fn align(continuum: &Continuum, costs: &Costs<'_>) -> Result<Alignment, Undefined> {
    if continuum.units() == 0 {
        return Err(Undefined::BothEmpty);
    }
    let tiers = continuum.tiers();
    let mut groups = match tiers {
        [] | [_] => return Err(Undefined::Missing),
        [first, second] => pairwise(first, second, costs)?,
        several => searched(several, costs)?,
    };
    let begins = |group: &Aligned| {
        let starts = group.iter().zip(tiers);
        starts
            .filter_map(|(at, tier)| Some(tier[(*at)?].start))
            .min()
    };
    groups.sort_by_cached_key(|group| (begins(group), group.clone()));
    let cost = groups.iter().map(|it| group_cost(it, tiers, costs)).sum();
    Ok(Alignment {
        groups,
        cost,
        units: continuum.units() as f64 / tiers.len() as f64,
    })
}

/// Returns the mean cost of the pairs of a group.
fn group_cost(group: &Aligned, tiers: &[Vec<Unit>], costs: &Costs<'_>) -> f64 {
    let (mut sum, mut pairs) = (0.0, 0.0);
    for (nth, a) in group.iter().enumerate() {
        for (other, b) in group.iter().enumerate().skip(nth + 1) {
            pairs += 1.0;
            sum += match (a, b) {
                (Some(a), Some(b)) => costs.pair(&tiers[nth][*a], &tiers[other][*b]),
                (None, None) => costs.alone,
                _ => costs.alone,
            };
        }
    }
    sum / pairs
}

/// Returns the candidates of each unit in the other tier: pairs that cost less than the two units alone.
fn candidates(first: &[Unit], second: &[Unit], costs: &Costs<'_>) -> Result<Edges, Undefined> {
    let both = 2.0 * costs.alone;
    let longest = second.iter().map(Unit::length).max().unwrap_or(0);
    // Of a pair worth its cost, the starts and ends lie together at most this share of both lengths apart.
    let reach = (2.0 / costs.time.max(1e-9)).sqrt();
    let (mut edges, mut compared, mut kept) = (Vec::with_capacity(first.len()), 0_usize, 0_usize);
    for a in first {
        let within = (reach * (a.length() + longest) as f64).ceil() as i64;
        let from = second.partition_point(|b| b.start < a.start.saturating_sub(within));
        let to = second.partition_point(|b| b.start <= a.start.saturating_add(within));
        compared += to - from;
        if compared > MOST_PAIRS {
            return Err(Undefined::TooMany);
        }
        let near = second[from..to].iter().enumerate();
        let edge = |(at, b)| (from + at, costs.pair(a, b) - both);
        let own: Vec<(usize, f64)> = near.map(edge).filter(|(_, cost)| *cost < 0.0).collect();
        kept += own.len();
        if kept > MOST_CANDIDATES {
            return Err(Undefined::TooMany);
        }
        edges.push(own);
    }
    Ok(edges)
}

fn pairwise(first: &[Unit], second: &[Unit], costs: &Costs<'_>) -> Result<Vec<Aligned>, Undefined> {
    let edges = candidates(first, second, costs)?;
    let columns = assign(&edges, second.len());
    let mut alone = vec![true; second.len()];
    let mut groups: Vec<Aligned> = Vec::with_capacity(first.len());
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
fn searched(tiers: &[Vec<Unit>], costs: &Costs<'_>) -> Result<Vec<Aligned>, Undefined> {
    let alone = costs.alone;
    let mut offsets = vec![0];
    for tier in tiers {
        offsets.push(offsets[offsets.len() - 1] + tier.len());
    }
    let units = offsets[tiers.len()];
    let mut groups: Vec<(Aligned, f64)> = Vec::new();
    let mut steps = 0_u64;
    for (first, tier) in tiers.iter().enumerate() {
        for at in 0..tier.len() {
            let mut group: Aligned = vec![None; tiers.len()];
            group[first] = Some(at);
            grow(
                &mut group,
                first + 1,
                (tiers, costs),
                &mut groups,
                &mut steps,
            )?;
        }
    }
    // Each group under its first unit, and the least share of each unit.
    let mut of_unit: Vec<Vec<(Vec<usize>, f64, usize)>> = vec![Vec::new(); units];
    let mut least = vec![alone; units];
    for (nth, (group, cost)) in groups.iter().enumerate() {
        let places = group.iter().zip(&offsets);
        let members: Vec<usize> = places
            .filter_map(|(at, from)| Some(from + (*at)?))
            .collect();
        let share = cost / members.len() as f64;
        for member in &members {
            least[*member] = least[*member].min(share);
            of_unit[*member].push((members.clone(), *cost, nth));
        }
    }
    for own in &mut of_unit {
        own.sort_by(|a, b| {
            let share = |it: &(Vec<usize>, f64, usize)| it.1 / it.0.len() as f64;
            share(a).total_cmp(&share(b))
        });
    }
    let mut chosen = Vec::new();
    for component in components(&of_unit) {
        let mut search = Search {
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
        search.go(0, 0.0, bound)?;
        chosen.extend(search.found);
    }
    Ok(chosen
        .into_iter()
        .map(|nth| groups[nth].0.clone())
        .collect())
}

/// Adds all groups that extend `group` by units of the annotators from `from` on, unless they cost more than their
/// units alone.
fn grow(
    group: &mut Aligned,
    from: usize,
    (tiers, costs): (&[Vec<Unit>], &Costs<'_>),
    groups: &mut Vec<(Aligned, f64)>,
    steps: &mut u64,
) -> Result<(), Undefined> {
    if from == tiers.len() {
        let cost = group_cost(group, tiers, costs);
        if cost <= costs.alone * group.iter().flatten().count() as f64 {
            groups.push((group.clone(), cost));
        }
        return Ok(());
    }
    grow(group, from + 1, (tiers, costs), groups, steps)?;
    let annotators = tiers.len() as f64;
    let pairs = annotators * (annotators - 1.0) / 2.0;
    for at in 0..tiers[from].len() {
        *steps += 1;
        if *steps > MOST_STEPS {
            return Err(Undefined::TooMany);
        }
        let unit = &tiers[from][at];
        let known = group.iter().zip(tiers);
        let with = known.filter_map(|(at, tier)| Some(costs.pair(&tier[(*at)?], unit)));
        // One such pair alone makes the group dearer than its units.
        if with.fold(0.0, f64::max) / pairs > costs.alone * annotators {
            continue;
        }
        group[from] = Some(at);
        grow(group, from + 1, (tiers, costs), groups, steps)?;
        group[from] = None;
    }
    Ok(())
}

/// Returns the units that groups connect, each component by number.
fn components(of_unit: &[Vec<(Vec<usize>, f64, usize)>]) -> Vec<Vec<usize>> {
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

struct Search<'a> {
    of_unit: &'a [Vec<(Vec<usize>, f64, usize)>],
    least: &'a [f64],
    order: Vec<usize>,
    covered: Vec<bool>,
    chosen: Vec<usize>,
    best: f64,
    found: Vec<usize>,
    steps: &'a mut u64,
}

impl Search<'_> {
    fn go(&mut self, mut at: usize, cost: f64, bound: f64) -> Result<(), Undefined> {
        *self.steps += 1;
        if *self.steps > MOST_STEPS {
            return Err(Undefined::TooMany);
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
            let freed: f64 = members.iter().map(|it| self.least[*it]).sum();
            let is_free = members.iter().all(|it| !self.covered[*it]);
            if !is_free || cost + own + bound - freed >= self.best - 1e-12 {
                continue;
            }
            members.iter().for_each(|it| self.covered[*it] = true);
            self.chosen.push(*nth);
            self.go(at + 1, cost + own, bound - freed)?;
            self.chosen.pop();
            members.iter().for_each(|it| self.covered[*it] = false);
        }
        Ok(())
    }
}

/// The settings of gamma's chance: how many random continua, and their seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// The number of random continua, at least 30.
    pub samples: usize,
    /// More are drawn until the mean disorder is this exact, with 95 % confidence: 0.02 is 2 %.
    pub precision: Option<f64>,
    /// The seed.
    pub seed: u64,
}

impl Default for Sampling {
    fn default() -> Self {
        Self {
            samples: 30,
            precision: None,
            seed: 1,
        }
    }
}

/// The most random continua that a wish for precision can ask for.
const MOST_SAMPLES: usize = 1000;

/// Gamma with its parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Gamma {
    /// Gamma: 1 less the observed disorder over the expected one.
    pub gamma: Measure,
    /// Gamma of the values of aligned units.
    pub categorical: Measure,
    /// The observed disorder.
    pub observed: f64,
    /// The mean disorder of random continua.
    pub expected: f64,
    /// The number of random continua.
    pub samples: usize,
    /// The interval of gamma that follows from the standard error of the expected disorder.
    pub interval: Option<Interval>,
}

/// Returns gamma over several continua, such as recordings: their disorders are added up before they are divided.
///
/// Random units are drawn as in pygamma-agreement: number, gaps and lengths from normal distributions with the mean and
/// standard deviation of the real ones, values by their shares. The paper shifts the real units instead. Gaps, lengths
/// and values are those of all continua; the number of units is that of each. `step` is called before each sample.
///
/// # Errors
/// [`Undefined::BothEmpty`], [`Undefined::TooMany`], or the error of `step`.
pub fn gamma<E: From<Undefined>>(
    continua: &[Continuum],
    costs: &Costs<'_>,
    sampling: &Sampling,
    mut step: impl FnMut(usize) -> Result<(), E>,
) -> Result<Gamma, E> {
    let filled: Vec<&Continuum> = continua.iter().filter(|it| it.units() > 0).collect();
    if filled.is_empty() {
        return Err(Undefined::BothEmpty.into());
    }
    let (mut observed, mut values) = (Mean::default(), Mean::default());
    for continuum in &filled {
        add(continuum, costs, &mut observed, &mut values)?;
    }
    let source = Source::of(&filled);
    let mut random = Random::new(sampling.seed);
    let (mut disorders, mut of_values): (Vec<f64>, Vec<f64>) = Default::default();
    let mut wanted = sampling.samples.max(30);
    while disorders.len() < wanted {
        step(disorders.len())?;
        let (mut whole, mut cat) = (Mean::default(), Mean::default());
        for continuum in &filled {
            let drawn = source.draw(continuum, &mut random);
            add(&drawn, costs, &mut whole, &mut cat)?;
        }
        disorders.extend(whole.value());
        of_values.extend(cat.value());
        if let (true, Some(precision)) = (disorders.len() == wanted, sampling.precision) {
            let (mean, deviation) = moments(&disorders);
            let needed = (1.96 * deviation / (mean * precision)).powi(2).ceil();
            wanted = wanted.max(needed.min(MOST_SAMPLES as f64) as usize);
        }
    }
    let (expected, deviation) = moments(&disorders);
    let seen = observed.value().unwrap_or(0.0);
    let error = 1.96 * deviation / (disorders.len() as f64).sqrt();
    let at = |expected: f64| 1.0 - seen / expected;
    let is_chance = expected > 1e-12;
    let (chance_of_values, _) = moments(&of_values);
    Ok(Gamma {
        gamma: match is_chance {
            true => Ok(at(expected)),
            false => Err(Undefined::NoChance),
        },
        categorical: match values.value() {
            _ if source.values.len() < 2 => Err(Undefined::OneValue),
            None => Err(Undefined::NoPair),
            Some(_) if chance_of_values <= 1e-12 => Err(Undefined::NoChance),
            Some(values) => Ok(1.0 - values / chance_of_values),
        },
        observed: seen,
        expected,
        samples: disorders.len(),
        interval: (is_chance && expected > error).then(|| Interval {
            low: at(expected - error),
            high: at(expected + error),
            draws: disorders.len(),
        }),
    })
}

/// A weighted mean that is added up.
#[derive(Default)]
struct Mean {
    sum: f64,
    weight: f64,
}

impl Mean {
    fn value(&self) -> Option<f64> {
        (self.weight > 0.0).then(|| self.sum / self.weight)
    }
}

/// Adds the disorder of a continuum, and the disorder of the values of its aligned units.
///
/// A pair of units weighs more the nearer they lie to each other: `max(0, 1 - apart) / (units of the group - 1)`.
fn add(
    continuum: &Continuum,
    costs: &Costs<'_>,
    whole: &mut Mean,
    values: &mut Mean,
) -> Result<(), Undefined> {
    let aligned = align(continuum, costs)?;
    whole.sum += aligned.cost;
    whole.weight += aligned.units;
    let tiers = continuum.tiers();
    for group in &aligned.groups {
        let units = group.iter().zip(tiers);
        let units: Vec<&Unit> = units.filter_map(|(at, tier)| tier.get((*at)?)).collect();
        for (nth, a) in units.iter().enumerate() {
            for b in &units[nth + 1..] {
                let near = (1.0 - costs.apart(a, b)).max(0.0);
                let weight = near / (units.len() - 1) as f64;
                values.sum += weight * costs.differ(a, b);
                values.weight += weight;
            }
        }
    }
    Ok(())
}

/// Returns mean and standard deviation.
fn moments(all: &[f64]) -> (f64, f64) {
    if all.is_empty() {
        return (0.0, 0.0);
    }
    let count = all.len() as f64;
    let mean = all.iter().sum::<f64>() / count;
    let square = all.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / count;
    (mean, square.sqrt())
}

/// The numbers from which random units are drawn.
struct Source {
    gap: (f64, f64),
    length: (f64, f64),
    /// Each value with the share of units up to it.
    values: Vec<(usize, f64)>,
}

impl Source {
    fn of(continua: &[&Continuum]) -> Self {
        let (mut gaps, mut lengths) = (Vec::new(), Vec::new());
        let mut counts: BTreeMap<usize, f64> = BTreeMap::new();
        for continuum in continua {
            for tier in continuum.tiers() {
                let first = tier.first().map(|it| (it.start - continuum.start()) as f64);
                gaps.extend(first.filter(|gap| *gap > 0.0));
                gaps.extend(tier.windows(2).map(|it| (it[1].start - it[0].end) as f64));
                lengths.extend(tier.iter().map(|it| it.length() as f64));
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
            gap: moments(&gaps),
            length: moments(&lengths),
        }
    }

    /// Draws random units for the annotators of a continuum.
    fn draw(&self, like: &Continuum, random: &mut Random) -> Continuum {
        let counts: Vec<f64> = like.tiers().iter().map(|it| it.len() as f64).collect();
        let (mean, deviation) = moments(&counts);
        let most = 2.0 * counts.iter().sum::<f64>();
        let tier = |_: &Vec<Unit>| {
            let count = (mean + deviation * random.normal()).clamp(1.0, most) as usize;
            let mut end = 0.0;
            let unit = |_| {
                let start = end + self.gap.0 + self.gap.1 * random.normal();
                let length = (self.length.0 + self.length.1 * random.normal()).abs();
                end = start + length.max(1.0);
                let share = random.share();
                let nth = self.values.partition_point(|(_, upto)| *upto < share);
                let value = self.values.get(nth).or(self.values.last());
                let value = value.map_or(0, |it| it.0);
                Unit::new(
                    start.round() as i64,
                    (end.round() as i64).max(start.round() as i64 + 1),
                    value,
                )
            };
            (0..count).map(unit).collect()
        };
        let tiers = like.tiers().iter().map(tier).collect();
        Continuum::new((0, 0), tiers)
    }
}
