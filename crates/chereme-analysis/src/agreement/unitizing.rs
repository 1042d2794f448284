//! Agreement of spans and values over time: Krippendorff's alpha_U (1995), the u-alpha family (Krippendorff, Mathet, Bouvry and
//! Widlöcher 2016), and frames.

use std::collections::BTreeMap;

use super::{AgreementMeasure, AnnotatedUnit, AnnotationContinuum, UndefinedAgreement, below_chance, beyond_chance};

/// The disagreements of one value in alpha_U, observed and expected by chance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UnitizingDisagreement {
    /// Observed.
    pub observed: f64,
    /// Expected.
    pub expected: f64,
}

impl UnitizingDisagreement {
    /// Returns alpha.
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoChance`].
    pub fn unitizing_alpha(&self) -> AgreementMeasure {
        below_chance(self.observed, self.expected, UndefinedAgreement::NoChance)
    }
}

/// Returns the disagreements of each value in alpha_U.
///
/// Two overlapping units of a value differ by the squares of the distances of their starts and of their ends; a unit
/// during which the other annotator has no unit of that value costs the square of its length.
#[must_use]
pub fn unitizing_disagreements(continuum: &AnnotationContinuum) -> BTreeMap<usize, UnitizingDisagreement> {
    let mut by_value: BTreeMap<usize, Vec<Vec<AnnotatedUnit>>> = BTreeMap::new();
    let annotators = continuum.annotator_tiers().len();
    for (at, units) in continuum.annotator_tiers().iter().enumerate() {
        for unit in units {
            let tiers = by_value
                .entry(unit.value)
                .or_insert_with(|| vec![Vec::new(); annotators]);
            tiers[at].push(*unit);
        }
    }
    let disagreement = |tiers: &Vec<Vec<AnnotatedUnit>>| UnitizingDisagreement {
        observed: observed(tiers, (continuum.continuum_end() - continuum.continuum_start()) as f64),
        expected: expected_unit_difference(tiers, continuum),
    };
    let all = by_value.iter();
    all.map(|(value, tiers)| (*value, disagreement(tiers))).collect()
}

/// Returns alpha_U over all values.
///
/// # Errors
/// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::NoChance`], [`UndefinedAgreement::Missing`] for fewer than two annotators.
pub fn alpha_u(continuum: &AnnotationContinuum) -> AgreementMeasure {
    if continuum.annotator_tiers().len() < 2 {
        return Err(UndefinedAgreement::Missing);
    }
    let all = unitizing_disagreements(continuum);
    if all.is_empty() {
        return Err(UndefinedAgreement::BothEmpty);
    }
    let mut sum = UnitizingDisagreement::default();
    for one in all.values() {
        sum.observed += one.observed;
        sum.expected += one.expected;
    }
    sum.unitizing_alpha()
}

fn observed(tiers: &[Vec<AnnotatedUnit>], length: f64) -> f64 {
    let mut sum = 0.0;
    for (at, first) in tiers.iter().enumerate() {
        for second in &tiers[at + 1..] {
            sum += observed_unit_difference(first, second);
        }
    }
    let annotators = tiers.len() as f64;
    // Each pair of annotators stands for both of its orders.
    2.0 * sum / (annotators * (annotators - 1.0) * length * length)
}

/// Returns the squared differences of the units of one value by two annotators.
fn observed_unit_difference(first: &[AnnotatedUnit], second: &[AnnotatedUnit]) -> f64 {
    let square = |time: i64| (time as f64).powi(2);
    let mut alone = vec![true; second.len()];
    let mut sum = 0.0;
    let mut begin = 0;
    for unit in first {
        // Units rise by time: one that ends before this one cannot meet a later one.
        while begin < second.len() && second[begin].end <= unit.start {
            begin += 1;
        }
        let mut has_overlap = false;
        for (at, other) in second.iter().enumerate().skip(begin) {
            if other.start >= unit.end {
                break;
            }
            if unit.shared_unit_time(other) > 0 {
                (has_overlap, alone[at]) = (true, false);
                sum += square(unit.start - other.start) + square(unit.end - other.end);
            }
        }
        if !has_overlap {
            sum += square(unit.unit_length());
        }
    }
    let rest = second.iter().zip(&alone).filter(|(_, alone)| **alone);
    sum + rest.map(|(unit, _)| square(unit.unit_length())).sum::<f64>()
}

fn expected_unit_difference(tiers: &[Vec<AnnotatedUnit>], continuum: &AnnotationContinuum) -> f64 {
    let length = (continuum.continuum_end() - continuum.continuum_start()) as f64;
    let mut gaps: Vec<i64> = Vec::new();
    for units in tiers {
        let mut end = continuum.continuum_start();
        for unit in units {
            gaps.push(unit.start - end);
            end = end.max(unit.end);
        }
        gaps.push(continuum.continuum_end() - end);
    }
    // Units that touch or overlap leave no gap between them.
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
        let l = unit.unit_length() as f64;
        let from = gaps.partition_point(|gap| *gap < unit.unit_length());
        let fitting = (gaps.len() - from) as f64;
        // Krippendorff's closed form for two units of one length that chance lays over each other.
        let others = (count as f64 - 1.0) / 3.0;
        sum += others * (2.0 * l.powi(3) - 3.0 * l * l + l);
        // A gap of length `h` holds the unit in `h - l + 1` places.
        sum += l * l * (sums[from] - fitting * (l - 1.0));
        own += l * (l - 1.0);
    }
    let total_length = tiers.len() as f64 * length;
    let room = total_length * (total_length - 1.0) - own;
    if room <= 0.0 || length <= 0.0 {
        return 0.0;
    }
    2.0 / length * sum / room
}

/// A piece of time during which no annotator's value changes.
#[derive(Debug, Clone, PartialEq, Eq)]
struct ConstantValueSlice {
    start: i64,
    end: i64,
    /// The value of each annotator; `None` in a gap.
    values: Vec<Option<usize>>,
}

/// Cuts the time at every start and end; where units of an annotator overlap, the earlier one counts.
fn slices(continuum: &AnnotationContinuum) -> Vec<ConstantValueSlice> {
    let mut cuts: Vec<i64> = vec![continuum.continuum_start(), continuum.continuum_end()];
    cuts.extend(
        continuum
            .annotator_tiers()
            .iter()
            .flatten()
            .flat_map(|unit| [unit.start, unit.end]),
    );
    cuts.sort_unstable();
    cuts.dedup();
    let mut tier_positions = vec![0; continuum.annotator_tiers().len()];
    let mut slices = Vec::with_capacity(cuts.len());
    for pair in cuts.windows(2) {
        let value = |(tier, at): (&Vec<AnnotatedUnit>, &mut usize)| {
            while *at < tier.len() && tier[*at].end <= pair[0] {
                *at += 1;
            }
            let unit = tier.get(*at).filter(|unit| unit.start <= pair[0]);
            unit.map(|unit| unit.value)
        };
        slices.push(ConstantValueSlice {
            start: pair[0],
            end: pair[1],
            values: continuum
                .annotator_tiers()
                .iter()
                .zip(&mut tier_positions)
                .map(value)
                .collect(),
        });
    }
    slices
}

/// Agreement of frames, in which a gap is a value.
///
/// Long units dominate it, and so do long gaps: it should never be the only figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameAgreement {
    /// The share of equal pairs.
    pub raw: AgreementMeasure,
    /// Cohen's kappa, for two annotators.
    pub kappa: AgreementMeasure,
    /// Krippendorff's nominal alpha.
    pub alpha: AgreementMeasure,
}

/// Returns the agreement of frames of this length; a frame has the value that holds at its start.
#[must_use]
pub fn measure_frame_agreement(continuum: &AnnotationContinuum, frame: i64) -> FrameAgreement {
    let frame = frame.max(1);
    let annotators = continuum.annotator_tiers().len();
    // The frames that start before a time; a frame has the value at its start.
    let first = |time: i64| (time - continuum.continuum_start() + frame - 1).div_euclid(frame);
    let mut counts: Vec<BTreeMap<Option<usize>, f64>> = vec![BTreeMap::new(); annotators];
    let (mut all, mut equal) = (0.0, 0.0);
    for slice in slices(continuum) {
        let number = (first(slice.end) - first(slice.start)) as f64;
        for (nth, (value, counts)) in slice.values.iter().zip(&mut counts).enumerate() {
            *counts.entry(*value).or_default() += number;
            let same = slice.values[nth + 1..].iter().filter(|other| *other == value);
            equal += number * same.count() as f64;
        }
        all += number * (annotators * annotators.saturating_sub(1) / 2) as f64;
    }
    if all == 0.0 {
        return FrameAgreement {
            raw: Err(UndefinedAgreement::NoPair),
            kappa: Err(UndefinedAgreement::NoPair),
            alpha: Err(UndefinedAgreement::NoPair),
        };
    }
    let raw = equal / all;
    let kappa = match &counts[..] {
        [first, second] => {
            let total: f64 = first.values().sum();
            let chance_term = |(value, n): (&Option<usize>, &f64)| n * second.get(value).unwrap_or(&0.0);
            let chance: f64 = first.iter().map(chance_term).sum();
            beyond_chance(raw, chance / (total * total))
        }
        _ => Err(UndefinedAgreement::Missing),
    };
    let mut pooled: BTreeMap<Option<usize>, f64> = BTreeMap::new();
    for (value, count) in counts.iter().flatten() {
        *pooled.entry(*value).or_default() += count;
    }
    let values: f64 = pooled.values().sum();
    let alike: f64 = pooled.values().map(|count| count * (count - 1.0)).sum();
    // A unit between the starts of two frames leaves a count of 0.
    let alpha = match pooled.values().filter(|count| **count > 0.0).count() {
        0 | 1 => Err(UndefinedAgreement::OneValue),
        _ => below_chance(
            1.0 - raw,
            1.0 - alike / (values * (values - 1.0)),
            UndefinedAgreement::OneValue,
        ),
    };
    FrameAgreement {
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
pub struct UAlphaAgreement {
    /// uα: spans and values, gaps too.
    pub all: AgreementMeasure,
    /// |uα: spans alone.
    pub spans: AgreementMeasure,
    /// cuα: values where both have a unit.
    pub values: AgreementMeasure,
    /// (k)uα: each value against everything else.
    pub each: BTreeMap<usize, AgreementMeasure>,
}

/// Returns the u-alpha family.
#[must_use]
pub fn u_alpha(continuum: &AnnotationContinuum) -> UAlphaAgreement {
    if continuum.annotated_unit_count() == 0 || continuum.annotator_tiers().len() < 2 {
        let none = match continuum.annotated_unit_count() {
            0 => Err(UndefinedAgreement::BothEmpty),
            _ => Err(UndefinedAgreement::Missing),
        };
        return UAlphaAgreement {
            all: none,
            spans: none,
            values: none,
            each: BTreeMap::new(),
        };
    }
    let merge = |tier: &Vec<AnnotatedUnit>| tier.iter().map(|unit| AnnotatedUnit { value: 0, ..*unit }).collect();
    let merged_tiers = continuum.annotator_tiers().iter().map(merge).collect();
    let merged = AnnotationContinuum::new(continuum.continuum_start()..continuum.continuum_end(), merged_tiers);
    let shares = IntersectionShares::from_unit_intersections(continuum);
    UAlphaAgreement {
        all: shares.intersection_alpha(),
        spans: IntersectionShares::from_unit_intersections(&merged).intersection_alpha(),
        values: shares.alpha_of_values(),
        each: shares.alpha_of_each(),
    }
}

/// The lengths of intersections by value, gaps under `None`.
#[derive(Default)]
struct IntersectionShares {
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

impl IntersectionShares {
    fn from_unit_intersections(continuum: &AnnotationContinuum) -> Self {
        let mut shares = Self::default();
        let annotators = continuum.annotator_tiers().len();
        for slice in slices(continuum) {
            let length = (slice.end - slice.start) as f64;
            // Every annotator is compared with all others, so that equal slices add up to their length.
            let part = length / (annotators as f64 - 1.0);
            for (nth, value) in slice.values.iter().enumerate() {
                *shares.lengths.entry(*value).or_default() += length;
                shares.total += length;
                // A gap counts as units of length 1, whose squares add up to its length.
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
        for unit in continuum.annotator_tiers().iter().flatten() {
            *shares.own.entry(Some(unit.value)).or_default() += (unit.unit_length() as f64).powi(2);
        }
        shares
    }

    /// Returns the length of equal intersections that chance gives a value, ε_cc.
    fn expected_equal_length(&self, value: &Option<usize>) -> f64 {
        let own_sum: f64 = self.own.values().sum();
        let room = self.total * self.total - own_sum;
        let (length, weight) = (
            self.lengths.get(value).unwrap_or(&0.0),
            self.own.get(value).unwrap_or(&0.0),
        );
        if room <= 0.0 {
            return *length;
        }
        self.total * (length * length - weight) / room
    }

    fn intersection_alpha(&self) -> AgreementMeasure {
        let equal: f64 = self.equal.values().sum();
        let expected: f64 = self.lengths.keys().map(|value| self.expected_equal_length(value)).sum();
        let room = self.total - expected;
        if room.abs() < 1e-9 * self.total {
            return Err(UndefinedAgreement::NoChance);
        }
        Ok(1.0 - (self.total - equal) / room)
    }

    fn alpha_of_values(&self) -> AgreementMeasure {
        let total: f64 = self.valued.values().sum();
        if total == 0.0 {
            return Err(UndefinedAgreement::NoPair);
        }
        let valued = self.equal.iter().filter(|(value, _)| value.is_some());
        let equal: f64 = valued.map(|(_, length)| length).sum();
        let alike: f64 = self.valued.values().map(|length| length * length / total).sum();
        if (total - alike).abs() < 1e-9 * total {
            return Err(UndefinedAgreement::OneValue);
        }
        Ok(1.0 - (total - equal) / (total - alike))
    }

    fn alpha_of_each(&self) -> BTreeMap<usize, AgreementMeasure> {
        let each = self.lengths.iter().filter_map(|(value, length)| {
            let equal = self.equal.get(value).unwrap_or(&0.0);
            let room = length - self.expected_equal_length(value);
            let alpha = below_chance(length - equal, room, UndefinedAgreement::NoChance);
            Some(((*value)?, alpha))
        });
        each.collect()
    }
}
