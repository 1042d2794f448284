//! Agreement of spans and values over time: Krippendorff's alpha_U (1995), the u-alpha family (Krippendorff, Mathet, Bouvry and
//! Widlöcher 2016), and frames.

use std::collections::BTreeMap;

use super::{Continuum, Measure, Undefined, Unit, below_chance, beyond_chance};

/// The disagreements of one value in alpha_U, observed and expected by chance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Disagreement {
    /// Observed.
    pub observed: f64,
    /// Expected.
    pub expected: f64,
}

impl Disagreement {
    /// Returns alpha.
    ///
    /// # Errors
    /// [`Undefined::NoChance`].
    pub fn alpha(&self) -> Measure {
        below_chance(self.observed, self.expected, Undefined::NoChance)
    }
}

/// Returns the disagreements of each value in alpha_U.
///
/// Two overlapping units of a value differ by the squares of the distances of their starts and of their ends; a unit
/// during which the other annotator has no unit of that value costs the square of its length.
#[must_use]
pub fn disagreements(continuum: &Continuum) -> BTreeMap<usize, Disagreement> {
    let mut by_value: BTreeMap<usize, Vec<Vec<Unit>>> = BTreeMap::new();
    let annotators = continuum.tiers().len();
    for (at, units) in continuum.tiers().iter().enumerate() {
        for unit in units {
            let tiers = by_value
                .entry(unit.value)
                .or_insert_with(|| vec![Vec::new(); annotators]);
            tiers[at].push(*unit);
        }
    }
    let disagreement = |tiers: &Vec<Vec<Unit>>| Disagreement {
        observed: observed(tiers, (continuum.end() - continuum.start()) as f64),
        expected: expected(tiers, continuum),
    };
    let all = by_value.iter();
    all.map(|(value, tiers)| (*value, disagreement(tiers)))
        .collect()
}

/// Returns alpha_U over all values.
///
/// # Errors
/// [`Undefined::BothEmpty`], [`Undefined::NoChance`], [`Undefined::Missing`] for fewer than two annotators.
pub fn alpha_u(continuum: &Continuum) -> Measure {
    if continuum.tiers().len() < 2 {
        return Err(Undefined::Missing);
    }
    let all = disagreements(continuum);
    if all.is_empty() {
        return Err(Undefined::BothEmpty);
    }
    let mut sum = Disagreement::default();
    for one in all.values() {
        sum.observed += one.observed;
        sum.expected += one.expected;
    }
    sum.alpha()
}

fn observed(tiers: &[Vec<Unit>], length: f64) -> f64 {
    let mut sum = 0.0;
    for (at, first) in tiers.iter().enumerate() {
        for second in &tiers[at + 1..] {
            sum += difference(first, second);
        }
    }
    let annotators = tiers.len() as f64;
    2.0 * sum / (annotators * (annotators - 1.0) * length * length)
}

/// Returns the squared differences of the units of one value by two annotators.
fn difference(first: &[Unit], second: &[Unit]) -> f64 {
    let square = |time: i64| (time as f64).powi(2);
    let mut alone = vec![true; second.len()];
    let mut sum = 0.0;
    let mut begin = 0;
    for unit in first {
        while begin < second.len() && second[begin].end <= unit.start {
            begin += 1;
        }
        let mut found = false;
        for (at, other) in second.iter().enumerate().skip(begin) {
            if other.start >= unit.end {
                break;
            }
            if unit.shared(other) > 0 {
                (found, alone[at]) = (true, false);
                sum += square(unit.start - other.start) + square(unit.end - other.end);
            }
        }
        if !found {
            sum += square(unit.length());
        }
    }
    let rest = second.iter().zip(&alone).filter(|(_, alone)| **alone);
    sum + rest.map(|(it, _)| square(it.length())).sum::<f64>()
}

fn expected(tiers: &[Vec<Unit>], continuum: &Continuum) -> f64 {
    let length = (continuum.end() - continuum.start()) as f64;
    let mut gaps: Vec<i64> = Vec::new();
    for units in tiers {
        let mut end = continuum.start();
        for unit in units {
            gaps.push(unit.start - end);
            end = end.max(unit.end);
        }
        gaps.push(continuum.end() - end);
    }
    gaps.retain(|gap| *gap > 0);
    gaps.sort_unstable();
    // The sums of all gaps from each on.
    let mut sums = vec![0.0; gaps.len() + 1];
    for (at, gap) in gaps.iter().enumerate().rev() {
        sums[at] = sums[at + 1] + *gap as f64;
    }
    let count: usize = tiers.iter().map(Vec::len).sum();
    let (mut sum, mut own) = (0.0, 0.0);
    for unit in tiers.iter().flatten() {
        let l = unit.length() as f64;
        let from = gaps.partition_point(|gap| *gap < unit.length());
        let fitting = (gaps.len() - from) as f64;
        let others = (count as f64 - 1.0) / 3.0;
        sum += others * (2.0 * l.powi(3) - 3.0 * l * l + l);
        sum += l * l * (sums[from] - fitting * (l - 1.0));
        own += l * (l - 1.0);
    }
    let whole = tiers.len() as f64 * length;
    let room = whole * (whole - 1.0) - own;
    if room <= 0.0 || length <= 0.0 {
        return 0.0;
    }
    2.0 / length * sum / room
}

/// A piece of time during which no annotator's value changes.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Slice {
    start: i64,
    end: i64,
    /// The value of each annotator; `None` in a gap.
    values: Vec<Option<usize>>,
}

/// Cuts the time at every start and end; where units of an annotator overlap, the earlier one counts.
fn slices(continuum: &Continuum) -> Vec<Slice> {
    let mut cuts: Vec<i64> = vec![continuum.start(), continuum.end()];
    cuts.extend(
        continuum
            .tiers()
            .iter()
            .flatten()
            .flat_map(|it| [it.start, it.end]),
    );
    cuts.sort_unstable();
    cuts.dedup();
    let mut at = vec![0; continuum.tiers().len()];
    let mut slices = Vec::with_capacity(cuts.len());
    for pair in cuts.windows(2) {
        let value = |(tier, at): (&Vec<Unit>, &mut usize)| {
            while *at < tier.len() && tier[*at].end <= pair[0] {
                *at += 1;
            }
            let unit = tier.get(*at).filter(|it| it.start <= pair[0]);
            unit.map(|it| it.value)
        };
        slices.push(Slice {
            start: pair[0],
            end: pair[1],
            values: continuum.tiers().iter().zip(&mut at).map(value).collect(),
        });
    }
    slices
}

/// Agreement of frames, in which a gap is a value.
///
/// Long units dominate it, and so do long gaps: it should never be the only figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frames {
    /// The share of equal pairs.
    pub raw: Measure,
    /// Cohen's kappa, for two annotators.
    pub kappa: Measure,
    /// Krippendorff's nominal alpha.
    pub alpha: Measure,
}

/// Returns the agreement of frames of this length; a frame has the value that holds at its start.
#[must_use]
pub fn frames(continuum: &Continuum, frame: i64) -> Frames {
    let frame = frame.max(1);
    let annotators = continuum.tiers().len();
    let first = |time: i64| (time - continuum.start() + frame - 1).div_euclid(frame);
    let mut counts: Vec<BTreeMap<Option<usize>, f64>> = vec![BTreeMap::new(); annotators];
    let (mut all, mut equal) = (0.0, 0.0);
    for slice in slices(continuum) {
        let number = (first(slice.end) - first(slice.start)) as f64;
        for (nth, (value, counts)) in slice.values.iter().zip(&mut counts).enumerate() {
            *counts.entry(*value).or_default() += number;
            let same = slice.values[nth + 1..].iter().filter(|it| *it == value);
            equal += number * same.count() as f64;
        }
        all += number * (annotators * annotators.saturating_sub(1) / 2) as f64;
    }
    if all == 0.0 {
        return Frames {
            raw: Err(Undefined::NoPair),
            kappa: Err(Undefined::NoPair),
            alpha: Err(Undefined::NoPair),
        };
    }
    let raw = equal / all;
    let kappa = match &counts[..] {
        [first, second] => {
            let total: f64 = first.values().sum();
            let chance = |(value, n): (&Option<usize>, &f64)| n * second.get(value).unwrap_or(&0.0);
            let chance: f64 = first.iter().map(chance).sum();
            beyond_chance(raw, chance / (total * total))
        }
        _ => Err(Undefined::Missing),
    };
    let mut pooled: BTreeMap<Option<usize>, f64> = BTreeMap::new();
    for (value, count) in counts.iter().flatten() {
        *pooled.entry(*value).or_default() += count;
    }
    let values: f64 = pooled.values().sum();
    let alike: f64 = pooled.values().map(|count| count * (count - 1.0)).sum();
    let alpha = match pooled.values().filter(|count| **count > 0.0).count() {
        0 | 1 => Err(Undefined::OneValue),
        _ => below_chance(
            1.0 - raw,
            1.0 - alike / (values * (values - 1.0)),
            Undefined::OneValue,
        ),
    };
    Frames {
        raw: Ok(raw),
        kappa,
        alpha,
    }
}

/// The u-alpha family: agreement of intersections of units.
///
/// Intersections can't show a cut between touching units of one value. The expected term of `values` is the limit of
/// units that can be divided at will.
#[derive(Debug, Clone, PartialEq)]
pub struct UAlpha {
    /// uα: spans and values, gaps too.
    pub all: Measure,
    /// |uα: spans alone.
    pub spans: Measure,
    /// cuα: values where both have a unit.
    pub values: Measure,
    /// (k)uα: each value against everything else.
    pub each: BTreeMap<usize, Measure>,
}

/// Returns the u-alpha family.
#[must_use]
pub fn u_alpha(continuum: &Continuum) -> UAlpha {
    if continuum.units() == 0 || continuum.tiers().len() < 2 {
        let none = match continuum.units() {
            0 => Err(Undefined::BothEmpty),
            _ => Err(Undefined::Missing),
        };
        return UAlpha {
            all: none,
            spans: none,
            values: none,
            each: BTreeMap::new(),
        };
    }
    let merge = |it: &Vec<Unit>| it.iter().map(|it| Unit { value: 0, ..*it }).collect();
    let merged = continuum.tiers().iter().map(merge).collect();
    let merged = Continuum::new((continuum.start(), continuum.end()), merged);
    let shares = Shares::of(continuum);
    UAlpha {
        all: shares.alpha(),
        spans: Shares::of(&merged).alpha(),
        values: shares.alpha_of_values(),
        each: shares.alpha_of_each(),
    }
}

/// The lengths of intersections by value, gaps under `None`.
#[derive(Default)]
struct Shares {
    /// The length of each value, l_c.
    lengths: BTreeMap<Option<usize>, f64>,
    /// The length of intersections of equal values, l_cc.
    equal: BTreeMap<Option<usize>, f64>,
    /// The lengths of each value among intersections of two units.
    valued: BTreeMap<usize, f64>,
    /// The weight of the units of each value, Σ w_g.
    own: BTreeMap<Option<usize>, f64>,
    total: f64,
}

impl Shares {
    fn of(continuum: &Continuum) -> Self {
        let mut shares = Self::default();
        let annotators = continuum.tiers().len();
        for slice in slices(continuum) {
            let length = (slice.end - slice.start) as f64;
            let part = length / (annotators as f64 - 1.0);
            for (nth, value) in slice.values.iter().enumerate() {
                *shares.lengths.entry(*value).or_default() += length;
                shares.total += length;
                if value.is_none() {
                    *shares.own.entry(None).or_default() += length;
                }
                let others = slice.values.iter().enumerate();
                for (_, other) in others.filter(|(at, _)| *at != nth) {
                    if other == value {
                        *shares.equal.entry(*value).or_default() += part;
                    }
                    if let (Some(value), Some(_)) = (value, other) {
                        *shares.valued.entry(*value).or_default() += part;
                    }
                }
            }
        }
        for unit in continuum.tiers().iter().flatten() {
            *shares.own.entry(Some(unit.value)).or_default() += (unit.length() as f64).powi(2);
        }
        shares
    }

    /// Returns the length of equal intersections that chance gives a value, ε_cc.
    fn expected(&self, value: &Option<usize>) -> f64 {
        let own: f64 = self.own.values().sum();
        let room = self.total * self.total - own;
        let (length, weight) = (
            self.lengths.get(value).unwrap_or(&0.0),
            self.own.get(value).unwrap_or(&0.0),
        );
        if room <= 0.0 {
            return *length;
        }
        self.total * (length * length - weight) / room
    }

    fn alpha(&self) -> Measure {
        let equal: f64 = self.equal.values().sum();
        let expected: f64 = self.lengths.keys().map(|value| self.expected(value)).sum();
        let room = self.total - expected;
        if room.abs() < 1e-9 * self.total {
            return Err(Undefined::NoChance);
        }
        Ok(1.0 - (self.total - equal) / room)
    }

    fn alpha_of_values(&self) -> Measure {
        let total: f64 = self.valued.values().sum();
        if total == 0.0 {
            return Err(Undefined::NoPair);
        }
        let valued = self.equal.iter().filter(|(value, _)| value.is_some());
        let equal: f64 = valued.map(|(_, length)| length).sum();
        let alike: f64 = self.valued.values().map(|it| it * it / total).sum();
        if (total - alike).abs() < 1e-9 * total {
            return Err(Undefined::OneValue);
        }
        Ok(1.0 - (total - equal) / (total - alike))
    }

    fn alpha_of_each(&self) -> BTreeMap<usize, Measure> {
        let each = self.lengths.iter().filter_map(|(value, length)| {
            let equal = self.equal.get(value).unwrap_or(&0.0);
            let room = length - self.expected(value);
            let alpha = below_chance(length - equal, room, Undefined::NoChance);
            Some(((*value)?, alpha))
        });
        each.collect()
    }
}
