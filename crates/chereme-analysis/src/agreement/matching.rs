//! Two tiers as ELAN 6 compares them: the ratio of overlap to extent, and the modified kappa of Holle and Rein (2015).

use super::items::AgreementCounts;
use super::{AgreementMeasure, AnnotatedUnit, UndefinedAgreement, beyond_chance};

/// The share of the longer of two units that must overlap for a match, if nobody chooses another: ELAN's 60 %.
pub const DEFAULT_OVERLAP_SHARE: f64 = 0.6;

/// The rounds of proportional fitting, and the number in place of zeros, as in ELAN.
const PROPORTIONAL_FITTING_ROUNDS: usize = 20;
const NEARLY_ZERO: f64 = 0.001;

/// Returns ELAN's average ratio of overlap to extent; 0 for unmatched units.
///
/// Goes through the first tier in the order of time: the unused unit of the second tier with the largest overlap is the
/// partner. Hence the two directions can differ.
///
/// # Errors
/// [`UndefinedAgreement::BothEmpty`].
pub fn overlap_ratio(first: &[AnnotatedUnit], second: &[AnnotatedUnit]) -> AgreementMeasure {
    let mut used = vec![false; second.len()];
    let (mut sum, mut matched) = (0.0, 0_usize);
    let near = TimeSortedUnits::new(second);
    for unit in first {
        let mut best: Option<usize> = None;
        for at in near.find_overlapping_units(unit) {
            let larger = |known: usize| unit.shared_unit_time(&second[at]) > unit.shared_unit_time(&second[known]);
            if !used[at] && best.is_none_or(larger) {
                best = Some(at);
            }
        }
        if let Some(at) = best {
            let other = &second[at];
            used[at] = true;
            matched += 1;
            let extent = unit.end.max(other.end) - unit.start.min(other.start);
            sum += unit.shared_unit_time(other) as f64 / extent as f64;
        }
    }
    // A matched pair counts once in the mean; units alone add a ratio of 0.
    let all = first.len() + second.len() - matched;
    if all == 0 {
        return Err(UndefinedAgreement::BothEmpty);
    }
    Ok(sum / all as f64)
}

/// The units of a tier by time, for looking up those that overlap.
struct TimeSortedUnits<'a> {
    units: &'a [AnnotatedUnit],
    /// The latest end of the units up to each.
    ends: Vec<i64>,
}

impl<'a> TimeSortedUnits<'a> {
    fn new(units: &'a [AnnotatedUnit]) -> Self {
        let latest = |end: &mut i64, unit: &AnnotatedUnit| {
            *end = unit.end.max(*end);
            Some(*end)
        };
        let ends = units.iter().scan(i64::MIN, latest).collect();
        Self { units, ends }
    }

    fn find_overlapping_units(&self, unit: &AnnotatedUnit) -> impl Iterator<Item = usize> + use<'_> {
        // The latest ends rise even if units of one tier overlap, so that they can be searched.
        let first = self.ends.partition_point(|end| *end <= unit.start);
        let last = self.units.partition_point(|other| other.start < unit.end);
        let unit = *unit;
        (first..last.max(first)).filter(move |at| unit.shared_unit_time(&self.units[*at]) > 0)
    }
}

/// Returns the matched units, as places in the two tiers: the overlap is at least that `share` of the longer unit.
///
/// Units of one tier do not overlap as a rule; then no unit has two candidates if `share` is above one half, and the
/// match does not depend on the order of the tiers. Of overlapping units the largest share is matched first.
#[must_use]
pub fn match_overlapping_units(first: &[AnnotatedUnit], second: &[AnnotatedUnit], share: f64) -> Vec<(usize, usize)> {
    let near = TimeSortedUnits::new(second);
    let mut candidates: Vec<(f64, i64, usize, usize)> = Vec::new();
    for (at, unit) in first.iter().enumerate() {
        for other in near.find_overlapping_units(unit) {
            let shared = unit.shared_unit_time(&second[other]);
            let longer = unit.unit_length().max(second[other].unit_length());
            let part = shared as f64 / longer as f64;
            if part >= share {
                candidates.push((part, shared, at, other));
            }
        }
    }
    candidates.sort_by(|a, b| {
        let larger = b.0.total_cmp(&a.0).then(b.1.cmp(&a.1));
        larger.then((a.2, a.3).cmp(&(b.2, b.3)))
    });
    let (mut of_first, mut of_second) = (vec![false; first.len()], vec![false; second.len()]);
    let mut pairs = Vec::new();
    for (_, _, a, b) in candidates {
        if !of_first[a] && !of_second[b] {
            (of_first[a], of_second[b]) = (true, true);
            pairs.push((a, b));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// An item of the table of Holle and Rein: the values of a matched pair, or of one unit alone.
pub type HolleReinRow = (Option<usize>, Option<usize>);

/// Returns the items of two tiers for matched pairs: the pairs first, then the units alone.
#[must_use]
pub fn build_matching_rows(
    first: &[AnnotatedUnit],
    second: &[AnnotatedUnit],
    pairs: &[(usize, usize)],
) -> Vec<HolleReinRow> {
    let mut rows: Vec<HolleReinRow> = Vec::with_capacity(first.len() + second.len());
    let (mut of_first, mut of_second) = (vec![false; first.len()], vec![false; second.len()]);
    for &(a, b) in pairs {
        rows.push((Some(first[a].value), Some(second[b].value)));
        (of_first[a], of_second[b]) = (true, true);
    }
    let alone = |units: &[AnnotatedUnit], used: &[bool]| -> Vec<usize> {
        let all = units.iter().zip(used);
        all.filter(|(_, used)| !**used).map(|(unit, _)| unit.value).collect()
    };
    rows.extend(alone(first, &of_first).iter().map(|value| (Some(*value), None)));
    rows.extend(alone(second, &of_second).iter().map(|value| (None, Some(*value))));
    rows
}

/// The table of Holle and Rein as margins and diagonal: a matched pair counts twice, a unit alone once, so that the
/// total is the number of annotations. The last place is *unmatched*.
#[derive(Debug, Clone, PartialEq)]
pub struct HolleReinTable {
    counts: AgreementCounts,
    inner: AgreementCounts,
}

impl HolleReinTable {
    /// Returns the table of items with so many values.
    pub fn from_matching_rows(rows: impl IntoIterator<Item = HolleReinRow>, values: usize) -> Self {
        let mut table = Self {
            counts: AgreementCounts::with_zero_counts(values + 1),
            inner: AgreementCounts::with_zero_counts(values),
        };
        for row in rows {
            match row {
                (Some(a), Some(b)) => {
                    table.counts.add_counted_pair(a, b, 2.0);
                    table.inner.add_counted_pair(a, b, 1.0);
                }
                (Some(a), None) => table.counts.add_counted_pair(a, values, 1.0),
                (None, Some(b)) => table.counts.add_counted_pair(values, b, 1.0),
                (None, None) => {}
            }
        }
        table
    }

    /// Returns the counts of matched pairs alone, each once.
    #[must_use]
    pub fn matched_pair_counts(&self) -> &AgreementCounts {
        &self.inner
    }

    /// Returns the number of annotations.
    #[must_use]
    pub fn annotation_total(&self) -> f64 {
        self.counts.total_pair_count()
    }

    /// Returns the agreement with unmatched units: the share of annotations that are matched and equal.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn raw_agreement_with_unmatched(&self) -> AgreementMeasure {
        self.counts
            .counted_raw_agreement()
            .map_err(|_| UndefinedAgreement::BothEmpty)
    }

    /// Returns kappa with unmatched units and ordinary chance.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::OneValue`].
    pub fn kappa_with_unmatched(&self) -> AgreementMeasure {
        beyond_chance(self.raw_agreement_with_unmatched()?, self.counts.chance_agreement())
    }

    /// Returns the agreement that chance gives if two annotators can't both have no unit: the diagonal of a table that
    /// proportional fitting brings to these margins.
    ///
    /// The table begins with ones and a last cell near 0, and each round scales rows, then columns; so it stays a product
    /// of a number for each row and each column, and no cell is stored.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn chance_ipf(&self) -> AgreementMeasure {
        let total = self.annotation_total();
        if total == 0.0 {
            return Err(UndefinedAgreement::BothEmpty);
        }
        let filled = |sums: &[f64]| -> Vec<f64> {
            let fill = |number: &f64| if *number == 0.0 { NEARLY_ZERO } else { *number };
            sums.iter().map(fill).collect()
        };
        let (rows, columns) = (filled(&self.counts.rows), filled(&self.counts.columns));
        let last = rows.len() - 1;
        let (mut of_rows, mut of_columns) = (vec![1.0; rows.len()], vec![1.0; columns.len()]);
        let scale = |wanted: &[f64], own: &mut [f64], other: &[f64]| {
            let sum: f64 = other.iter().sum();
            for (at, (own, wanted)) in own.iter_mut().zip(wanted).enumerate() {
                // The last cell begins near 0 instead of 1, because both without a unit is no item.
                let target_sum = if at == last {
                    sum - other[last] * (1.0 - NEARLY_ZERO)
                } else {
                    sum
                };
                *own = wanted / target_sum;
            }
        };
        for _ in 0..PROPORTIONAL_FITTING_ROUNDS {
            scale(&rows, &mut of_rows, &of_columns);
            scale(&columns, &mut of_columns, &of_rows);
        }
        // Both without a unit is no agreement.
        let diagonal = of_rows[..last].iter().zip(&of_columns);
        Ok(diagonal.map(|(a, b)| a * b).sum::<f64>() / total)
    }

    /// Returns the modified kappa of Holle and Rein, as ELAN computes it: after 20 rounds of fitting the last digits depend on
    /// who is the first annotator.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::OneValue`].
    pub fn kappa_ipf(&self) -> AgreementMeasure {
        beyond_chance(self.raw_agreement_with_unmatched()?, self.chance_ipf()?)
    }

    /// Returns the largest kappa that these margins permit.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::OneValue`].
    pub fn kappa_max(&self) -> AgreementMeasure {
        self.raw_agreement_with_unmatched()?;
        let both = self.counts.rows.iter().zip(&self.counts.columns);
        let most: f64 = both.map(|(a, b)| a.min(*b)).sum();
        beyond_chance(most / self.annotation_total(), self.counts.chance_agreement())
    }

    /// Returns the table of one value against all others: both, the second alone, the first alone, neither.
    #[must_use]
    pub fn value_two_by_two(&self, value: usize) -> TwoByTwo {
        let both = self.counts.equal[value];
        let first = self.counts.rows[value] - both;
        let second = self.counts.columns[value] - both;
        TwoByTwo {
            both,
            second,
            first,
            neither: self.annotation_total() - both - first - second,
        }
    }
}

/// The table of one value against all others, in annotations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoByTwo {
    /// Both gave the value.
    pub both: f64,
    /// Only the second gave it.
    pub second: f64,
    /// Only the first gave it.
    pub first: f64,
    /// Nobody gave it.
    pub neither: f64,
}

impl TwoByTwo {
    /// Returns the share on which the two agree.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn two_by_two_agreement(&self) -> AgreementMeasure {
        let total = self.both + self.second + self.first + self.neither;
        if total == 0.0 {
            return Err(UndefinedAgreement::BothEmpty);
        }
        Ok((self.both + self.neither) / total)
    }

    /// Returns kappa of the value against all others.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`], [`UndefinedAgreement::OneValue`].
    pub fn two_by_two_kappa(&self) -> AgreementMeasure {
        let raw = self.two_by_two_agreement()?;
        let total = self.both + self.second + self.first + self.neither;
        let (of_first, of_second) = (self.both + self.first, self.both + self.second);
        let others = (total - of_first) * (total - of_second);
        beyond_chance(raw, (of_first * of_second + others) / (total * total))
    }
}
