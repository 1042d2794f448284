//! Two tiers as ELAN 6 compares them: the ratio of overlap to extent, and the modified kappa of Holle and Rein (2015).

use super::items::Counts;
use super::{Measure, Undefined, Unit, beyond_chance};

/// The share of the longer of two units that must overlap for a match, if nobody chooses another: ELAN's 60 %.
pub const SHARE: f64 = 0.6;

/// The rounds of proportional fitting, and the number in place of zeros, as in ELAN.
const ROUNDS: usize = 20;
const NEARLY_ZERO: f64 = 0.001;

/// Returns ELAN's average ratio of overlap to extent; 0 for unmatched units.
///
/// Goes through the first tier in the order of time: the unused unit of the second tier with the largest overlap is the
/// partner. Hence the two directions can differ.
///
/// # Errors
/// [`Undefined::BothEmpty`].
pub fn overlap_ratio(first: &[Unit], second: &[Unit]) -> Measure {
    let mut used = vec![false; second.len()];
    let (mut sum, mut matched) = (0.0, 0_usize);
    let near = Near::new(second);
    for unit in first {
        let mut best: Option<usize> = None;
        for at in near.overlapping(unit) {
            let larger = |known: usize| unit.shared(&second[at]) > unit.shared(&second[known]);
            if !used[at] && best.is_none_or(larger) {
                best = Some(at);
            }
        }
        if let Some(at) = best {
            let other = &second[at];
            used[at] = true;
            matched += 1;
            let extent = unit.end.max(other.end) - unit.start.min(other.start);
            sum += unit.shared(other) as f64 / extent as f64;
        }
    }
    let all = first.len() + second.len() - matched;
    if all == 0 {
        return Err(Undefined::BothEmpty);
    }
    Ok(sum / all as f64)
}

/// The units of a tier by time, for looking up those that overlap.
struct Near<'a> {
    units: &'a [Unit],
    /// The latest end of the units up to each.
    ends: Vec<i64>,
}

impl<'a> Near<'a> {
    fn new(units: &'a [Unit]) -> Self {
        let latest = |end: &mut i64, unit: &Unit| {
            *end = unit.end.max(*end);
            Some(*end)
        };
        let ends = units.iter().scan(i64::MIN, latest).collect();
        Self { units, ends }
    }

    fn overlapping(&self, unit: &Unit) -> impl Iterator<Item = usize> + use<'_> {
        let first = self.ends.partition_point(|end| *end <= unit.start);
        let last = self.units.partition_point(|it| it.start < unit.end);
        let unit = *unit;
        (first..last.max(first)).filter(move |at| unit.shared(&self.units[*at]) > 0)
    }
}

/// Returns the matched units, as places in the two tiers: the overlap is at least that `share` of the longer unit.
///
/// Units of one tier do not overlap as a rule; then no unit has two candidates if `share` is above one half, and the
/// match does not depend on the order of the tiers. Of overlapping units the largest share is matched first.
#[must_use]
pub fn matched(first: &[Unit], second: &[Unit], share: f64) -> Vec<(usize, usize)> {
    let near = Near::new(second);
    let mut found: Vec<(f64, i64, usize, usize)> = Vec::new();
    for (at, unit) in first.iter().enumerate() {
        for other in near.overlapping(unit) {
            let shared = unit.shared(&second[other]);
            let longer = unit.length().max(second[other].length());
            let part = shared as f64 / longer as f64;
            if part >= share {
                found.push((part, shared, at, other));
            }
        }
    }
    found.sort_by(|a, b| {
        let larger = b.0.total_cmp(&a.0).then(b.1.cmp(&a.1));
        larger.then((a.2, a.3).cmp(&(b.2, b.3)))
    });
    let (mut of_first, mut of_second) = (vec![false; first.len()], vec![false; second.len()]);
    let mut pairs = Vec::new();
    for (_, _, a, b) in found {
        if !of_first[a] && !of_second[b] {
            (of_first[a], of_second[b]) = (true, true);
            pairs.push((a, b));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// An item of the table of Holle and Rein: the values of a matched pair, or of one unit alone.
pub type Row = (Option<usize>, Option<usize>);

/// Returns the items of two tiers for matched pairs: the pairs first, then the units alone.
#[must_use]
pub fn rows(first: &[Unit], second: &[Unit], pairs: &[(usize, usize)]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::with_capacity(first.len() + second.len());
    let (mut of_first, mut of_second) = (vec![false; first.len()], vec![false; second.len()]);
    for &(a, b) in pairs {
        rows.push((Some(first[a].value), Some(second[b].value)));
        (of_first[a], of_second[b]) = (true, true);
    }
    let alone = |units: &[Unit], used: &[bool]| -> Vec<usize> {
        let all = units.iter().zip(used);
        all.filter(|(_, used)| !**used)
            .map(|(it, _)| it.value)
            .collect()
    };
    rows.extend(alone(first, &of_first).iter().map(|it| (Some(*it), None)));
    rows.extend(alone(second, &of_second).iter().map(|it| (None, Some(*it))));
    rows
}

/// The table of Holle and Rein as margins and diagonal: a matched pair counts twice, a unit alone once, so that the
/// total is the number of annotations. The last place is *unmatched*.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    counts: Counts,
    inner: Counts,
}

impl Table {
    /// Returns the table of items with so many values.
    pub fn of(rows: impl IntoIterator<Item = Row>, values: usize) -> Self {
        let mut table = Self {
            counts: Counts::none(values + 1),
            inner: Counts::none(values),
        };
        for row in rows {
            match row {
                (Some(a), Some(b)) => {
                    table.counts.add(a, b, 2.0);
                    table.inner.add(a, b, 1.0);
                }
                (Some(a), None) => table.counts.add(a, values, 1.0),
                (None, Some(b)) => table.counts.add(values, b, 1.0),
                (None, None) => {}
            }
        }
        table
    }

    /// Returns the counts of matched pairs alone, each once.
    #[must_use]
    pub fn matched(&self) -> &Counts {
        &self.inner
    }

    /// Returns the number of annotations.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.counts.total()
    }

    /// Returns the agreement with unmatched units: the share of annotations that are matched and equal.
    ///
    /// # Errors
    /// [`Undefined::BothEmpty`].
    pub fn raw(&self) -> Measure {
        self.counts.raw().map_err(|_| Undefined::BothEmpty)
    }

    /// Returns kappa with unmatched units and ordinary chance.
    ///
    /// # Errors
    /// [`Undefined::BothEmpty`], [`Undefined::OneValue`].
    pub fn kappa(&self) -> Measure {
        beyond_chance(self.raw()?, self.counts.chance())
    }

    /// Returns the agreement that chance gives if two annotators can't both have no unit: the diagonal of a table that
    /// proportional fitting brings to these margins.
    ///
    /// The table begins with ones and a last cell near 0, and each round scales rows, then columns; so it stays a product
    /// of a number for each row and each column, and no cell is stored.
    ///
    /// # Errors
    /// [`Undefined::BothEmpty`].
    pub fn chance_ipf(&self) -> Measure {
        let total = self.total();
        if total == 0.0 {
            return Err(Undefined::BothEmpty);
        }
        let filled = |sums: &[f64]| -> Vec<f64> {
            let fill = |it: &f64| if *it == 0.0 { NEARLY_ZERO } else { *it };
            sums.iter().map(fill).collect()
        };
        let (rows, columns) = (filled(&self.counts.rows), filled(&self.counts.columns));
        let last = rows.len() - 1;
        let (mut of_rows, mut of_columns) = (vec![1.0; rows.len()], vec![1.0; columns.len()]);
        let scale = |wanted: &[f64], own: &mut [f64], other: &[f64]| {
            let sum: f64 = other.iter().sum();
            for (at, (own, wanted)) in own.iter_mut().zip(wanted).enumerate() {
                let whole = if at == last {
                    sum - other[last] * (1.0 - NEARLY_ZERO)
                } else {
                    sum
                };
                *own = wanted / whole;
            }
        };
        for _ in 0..ROUNDS {
            scale(&rows, &mut of_rows, &of_columns);
            scale(&columns, &mut of_columns, &of_rows);
        }
        let diagonal = of_rows[..last].iter().zip(&of_columns);
        Ok(diagonal.map(|(a, b)| a * b).sum::<f64>() / total)
    }

    /// Returns the modified kappa of Holle and Rein, as ELAN computes it: after 20 rounds of fitting the last digits depend on
    /// who is the first annotator.
    ///
    /// # Errors
    /// [`Undefined::BothEmpty`], [`Undefined::OneValue`].
    pub fn kappa_ipf(&self) -> Measure {
        beyond_chance(self.raw()?, self.chance_ipf()?)
    }

    /// Returns the largest kappa that these margins permit.
    ///
    /// # Errors
    /// [`Undefined::BothEmpty`], [`Undefined::OneValue`].
    pub fn kappa_max(&self) -> Measure {
        self.raw()?;
        let both = self.counts.rows.iter().zip(&self.counts.columns);
        let most: f64 = both.map(|(a, b)| a.min(*b)).sum();
        beyond_chance(most / self.total(), self.counts.chance())
    }

    /// Returns the table of one value against all others: both, the second alone, the first alone, neither.
    #[must_use]
    pub fn value(&self, value: usize) -> TwoByTwo {
        let both = self.counts.equal[value];
        let first = self.counts.rows[value] - both;
        let second = self.counts.columns[value] - both;
        TwoByTwo {
            both,
            second,
            first,
            neither: self.total() - both - first - second,
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
    /// [`Undefined::BothEmpty`].
    pub fn raw(&self) -> Measure {
        let total = self.both + self.second + self.first + self.neither;
        if total == 0.0 {
            return Err(Undefined::BothEmpty);
        }
        Ok((self.both + self.neither) / total)
    }

    /// Returns kappa of the value against all others.
    ///
    /// # Errors
    /// [`Undefined::BothEmpty`], [`Undefined::OneValue`].
    pub fn kappa(&self) -> Measure {
        let raw = self.raw()?;
        let total = self.both + self.second + self.first + self.neither;
        let (of_first, of_second) = (self.both + self.first, self.both + self.second);
        let others = (total - of_first) * (total - of_second);
        beyond_chance(raw, (of_first * of_second + others) / (total * total))
    }
}
