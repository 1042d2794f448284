//! Agreement on values of the same items.
//!
//! Values are numbers of categories; for ordinal alpha they are positions in an order, which counts
//! categories that nobody used, too. An item with one value takes part in no pair.

use std::collections::BTreeMap;

use super::{AgreementMeasure, UndefinedAgreement, below_chance, beyond_chance};

/// The values of one item, one place for each annotator.
pub type AnnotatedItem = Vec<Option<usize>>;

/// The squared difference of two values in alpha.
#[derive(Clone, Copy)]
pub enum AlphaScale<'a> {
    /// 0 for equal values, otherwise 1.
    Nominal,
    /// Krippendorff's ordinal difference: the pooled counts of values between the two.
    Ordinal,
    /// The square of the difference of the positions.
    Interval,
    /// Any other; it is not squared again.
    Distance(&'a dyn Fn(usize, usize) -> f64),
}

/// The counts of a square table of two annotators: its margins and its diagonal.
#[derive(Debug, Clone, PartialEq)]
pub struct AgreementCounts {
    /// The sum of each row, by the values of the first.
    pub rows: Vec<f64>,
    /// The sum of each column, by the values of the second.
    pub columns: Vec<f64>,
    /// The cells with equal values.
    pub equal: Vec<f64>,
}

impl AgreementCounts {
    /// Returns counts of zero for so many values.
    #[must_use]
    pub fn with_zero_counts(values: usize) -> Self {
        Self {
            rows: vec![0.0; values],
            columns: vec![0.0; values],
            equal: vec![0.0; values],
        }
    }

    /// Returns the counts of pairs.
    #[must_use]
    pub fn from_value_pairs(pairs: &[(usize, usize)]) -> Self {
        let most = pairs.iter().map(|(a, b)| 1 + a.max(b)).max();
        let mut counts = Self::with_zero_counts(most.unwrap_or(0));
        for (a, b) in pairs {
            counts.add_counted_pair(*a, *b, 1.0);
        }
        counts
    }

    /// Adds a pair so many times.
    pub fn add_counted_pair(&mut self, a: usize, b: usize, times: f64) {
        self.rows[a] += times;
        self.columns[b] += times;
        if a == b {
            self.equal[a] += times;
        }
    }

    /// Returns the number of pairs.
    #[must_use]
    pub fn total_pair_count(&self) -> f64 {
        self.rows.iter().sum()
    }

    /// Returns the share of equal pairs.
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoPair`].
    pub fn counted_raw_agreement(&self) -> AgreementMeasure {
        let total = self.total_pair_count();
        if total == 0.0 {
            return Err(UndefinedAgreement::NoPair);
        }
        Ok(self.equal.iter().sum::<f64>() / total)
    }

    /// Returns the agreement that is expected if each annotator keeps the own shares of values.
    #[must_use]
    pub fn chance_agreement(&self) -> f64 {
        let both = self.rows.iter().zip(&self.columns);
        both.map(|(a, b)| a * b).sum::<f64>() / (self.total_pair_count() * self.total_pair_count())
    }

    /// Returns Cohen's kappa (1960).
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoPair`], [`UndefinedAgreement::OneValue`].
    pub fn cohen_kappa(&self) -> AgreementMeasure {
        beyond_chance(self.counted_raw_agreement()?, self.chance_agreement())
    }

    /// Returns Scott's pi (1955): chance from the shares of both together.
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoPair`], [`UndefinedAgreement::OneValue`].
    pub fn scott_pi(&self) -> AgreementMeasure {
        let (raw, total) = (self.counted_raw_agreement()?, 2.0 * self.total_pair_count());
        let both = self.rows.iter().zip(&self.columns);
        beyond_chance(raw, both.map(|(a, b)| ((a + b) / total).powi(2)).sum())
    }

    /// Returns Gwet's AC1 (2008) of two annotators: chance is `Σ p (1 - p) / (q - 1)` over the q used values.
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoPair`], [`UndefinedAgreement::OneValue`].
    pub fn counted_gwet_ac1(&self) -> AgreementMeasure {
        let (raw, total) = (self.counted_raw_agreement()?, 2.0 * self.total_pair_count());
        let both = self.rows.iter().zip(&self.columns);
        gwet_of(raw, both.map(|(a, b)| (a + b) / total))
    }

    /// Returns Krippendorff's nominal alpha of two annotators.
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoPair`], [`UndefinedAgreement::OneValue`].
    pub fn counted_nominal_alpha(&self) -> AgreementMeasure {
        let (raw, values) = (self.counted_raw_agreement()?, 2.0 * self.total_pair_count());
        let both = self.rows.iter().zip(&self.columns);
        // Krippendorff's chance draws two values without putting the first back.
        let equal: f64 = both.map(|(a, b)| (a + b) * (a + b - 1.0)).sum();
        let expected = 1.0 - equal / (values * (values - 1.0));
        if expected.abs() < 1e-12 {
            return Err(UndefinedAgreement::OneValue);
        }
        below_chance(1.0 - raw, expected, UndefinedAgreement::OneValue)
    }
}

fn gwet_of(raw: f64, shares: impl Iterator<Item = f64>) -> AgreementMeasure {
    // A value that nobody used is not among the q.
    let used: Vec<f64> = shares.filter(|share| *share > 0.0).collect();
    if used.len() < 2 {
        return Err(UndefinedAgreement::OneValue);
    }
    let spread: f64 = used.iter().map(|share| share * (1.0 - share)).sum();
    beyond_chance(raw, spread / (used.len() - 1) as f64)
}

/// Returns Krippendorff's alpha (2011) for any number of annotators and missing values.
///
/// # Errors
/// [`UndefinedAgreement::NoPair`], [`UndefinedAgreement::OneValue`].
pub fn krippendorff_alpha(items: &[AnnotatedItem], scale: AlphaScale<'_>) -> AgreementMeasure {
    let several = |item: &&AnnotatedItem| item.iter().flatten().count() >= 2;
    // A value without a partner in its item has nothing to agree with.
    let items: Vec<AnnotatedItem> = items.iter().filter(several).cloned().collect();
    if items.is_empty() {
        return Err(UndefinedAgreement::NoPair);
    }
    let counts = count_given_values(&items);
    let total: f64 = counts.values().sum();
    let delta = |a: usize, b: usize| -> f64 {
        let apart = a.abs_diff(b) as f64;
        match scale {
            _ if a == b => 0.0,
            AlphaScale::Nominal => 1.0,
            AlphaScale::Interval => apart * apart,
            AlphaScale::Ordinal => {
                let ends = |value: usize| counts.get(&value).copied().unwrap_or(0.0);
                let between: f64 = counts.range(a.min(b)..=a.max(b)).map(|(_, n)| n).sum();
                // The two values themselves count by half.
                (between - (ends(a) + ends(b)) / 2.0).powi(2)
            }
            AlphaScale::Distance(distance) => distance(a, b),
        }
    };
    let mut observed = 0.0;
    for item in &items {
        let values: Vec<usize> = item.iter().flatten().copied().collect();
        let mut sum = 0.0;
        for (nth, a) in values.iter().enumerate() {
            sum += values[nth + 1..].iter().map(|b| delta(*a, *b)).sum::<f64>();
        }
        // An item of many values makes many pairs; divided so, every value weighs the same.
        observed += 2.0 * sum / (values.len() - 1) as f64;
    }
    let mut expected = 0.0;
    // Each pair of values stands for both of its orders.
    for (a, of_a) in &counts {
        for (b, of_b) in counts.range(a + 1..) {
            expected += 2.0 * of_a * of_b * delta(*a, *b);
        }
    }
    below_chance(
        observed / total,
        expected / (total * (total - 1.0)),
        UndefinedAgreement::OneValue,
    )
}

/// Returns how many times each value was given.
fn count_given_values(items: &[AnnotatedItem]) -> BTreeMap<usize, f64> {
    let mut counts = BTreeMap::new();
    for value in items.iter().flatten().flatten() {
        *counts.entry(*value).or_default() += 1.0;
    }
    counts
}
