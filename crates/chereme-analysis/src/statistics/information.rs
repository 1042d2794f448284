//! Entropy of things that are sorted into classes, and the load that a field of their descriptions carries.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{UndefinedStatistic, jackknife_interval};

/// The most pairs of values that are looked at for contrasts.
const MAX_CONTRAST_PAIRS: usize = 5_000_000;

/// Things sorted into classes of equal things.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EqualityClasses {
    /// The class of each thing.
    of: Vec<usize>,
    /// The number of things in each class, none of them 0.
    sizes: Vec<usize>,
}

impl EqualityClasses {
    /// Sorts things by their keys: things with equal keys are in one class.
    pub fn sort_by_keys<K: Ord>(keys: impl IntoIterator<Item = K>) -> Self {
        let mut class_numbers: BTreeMap<K, usize> = BTreeMap::new();
        let mut sizes = Vec::new();
        let class_number = |key| {
            let next = class_numbers.len();
            let class = *class_numbers.entry(key).or_insert(next);
            if class == sizes.len() {
                sizes.push(0);
            }
            sizes[class] += 1;
            class
        };
        Self {
            of: keys.into_iter().map(class_number).collect(),
            sizes,
        }
    }

    /// Returns the number of things.
    #[must_use]
    pub fn class_thing_count(&self) -> usize {
        self.of.len()
    }

    /// Returns the number of things in each class.
    #[must_use]
    pub fn class_sizes(&self) -> &[usize] {
        &self.sizes
    }

    /// Returns Shannon's entropy in bits, from the shares of the classes as they are (no correction for rare classes).
    ///
    /// # Errors
    /// [`UndefinedStatistic::Empty`] without things.
    pub fn class_entropy(&self) -> Result<f64, UndefinedStatistic> {
        if self.of.is_empty() {
            return Err(UndefinedStatistic::Empty);
        }
        Ok(entropy_bits(self.of.len(), self.class_weight_sum()))
    }

    /// Returns the interval of the entropy by the [`jackknife_interval`] over things, cut at 0.
    ///
    /// # Errors
    /// Those of [`jackknife_interval`].
    pub fn entropy_interval(&self, level: f64) -> Result<[f64; 2], UndefinedStatistic> {
        let [low, high] = jackknife_interval(self.class_entropy()?, &self.entropies_without(), level)?;
        Ok([low.max(0.0), high])
    }

    /// Returns the sum of c log2 c over the sizes of the classes.
    fn class_weight_sum(&self) -> f64 {
        self.sizes.iter().map(|size| count_log_weight(*size)).sum()
    }

    /// Returns the entropy without each thing in turn; nothing for fewer than two things.
    fn entropies_without(&self) -> Vec<f64> {
        let (n, all) = (self.of.len(), self.class_weight_sum());
        if n < 2 {
            return Vec::new();
        }
        let without = |size: &usize| entropy_bits(n - 1, all - count_log_weight(*size) + count_log_weight(size - 1));
        // Whichever thing of a class is left out, the same entropy remains.
        let by_class: Vec<f64> = self.sizes.iter().map(without).collect();
        self.of.iter().map(|class| by_class[*class]).collect()
    }
}

/// Returns c log2 c, which is 0 for 0.
fn count_log_weight(count: usize) -> f64 {
    match count {
        0 => 0.0,
        count => count as f64 * (count as f64).log2(),
    }
}

/// Returns the entropy of `n` things whose classes have this sum of c log2 c.
fn entropy_bits(n: usize, weight: f64) -> f64 {
    // One class gives 0 but for rounding.
    ((n as f64).log2() - weight / n as f64).max(0.0)
}

/// Returns the functional load of a field: the share of the entropy of forms that is lost without it,
/// (H(L) - H(L without the field)) / H(L).
///
/// `forms` sorts things by all fields, `without` by all fields but that one. Source: Hockett 1966 and Surendran and Niyogi
/// 2006, with the forms of a lexicon in place of texts.
///
/// # Errors
/// [`UndefinedStatistic::Empty`] without things; [`UndefinedStatistic::NoSpread`] if all forms are equal; [`UndefinedStatistic::Unequal`] if the two
/// sort different numbers of things.
pub fn functional_load(forms: &EqualityClasses, without: &EqualityClasses) -> Result<f64, UndefinedStatistic> {
    if forms.class_thing_count() != without.class_thing_count() {
        return Err(UndefinedStatistic::Unequal);
    }
    // Classes that are joined with none are the same classes.
    let same = forms.sizes.len() == without.sizes.len();
    relative_entropy_loss(
        forms.class_entropy()?,
        if same {
            forms.class_entropy()?
        } else {
            without.class_entropy()?
        },
    )
}

fn relative_entropy_loss(whole: f64, less: f64) -> Result<f64, UndefinedStatistic> {
    match whole > 0.0 {
        true => Ok((whole - less) / whole),
        false => Err(UndefinedStatistic::NoSpread),
    }
}

/// Returns the interval of [`functional_load`] by the [`jackknife_interval`] over things, cut at 0 and 1.
///
/// Resamples would not do: an entry that is drawn twice is a homonym that the lexicon does not have.
///
/// # Errors
/// Those of [`functional_load`] and of [`jackknife_interval`].
pub fn functional_load_interval(
    forms: &EqualityClasses,
    without: &EqualityClasses,
    level: f64,
) -> Result<[f64; 2], UndefinedStatistic> {
    let estimate = functional_load(forms, without)?;
    let (whole, less) = (forms.entropies_without(), without.entropies_without());
    let both = whole.iter().zip(&less);
    let loads: Vec<f64> = both
        .map(|(whole, less)| relative_entropy_loss(*whole, *less))
        .collect::<Result<_, _>>()?;
    let [low, high] = jackknife_interval(estimate, &loads, level)?;
    Ok([low.max(0.0), high.min(1.0)])
}

/// Two values of a field that distinguish forms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ValueContrast {
    /// The values, the lesser number first.
    pub values: [u32; 2],
    /// The number of pairs of things that differ in nothing but these two values.
    pub pairs: usize,
    /// The share of the entropy of forms that is lost if the two are one value.
    pub load: f64,
}

/// Returns the contrasts of a field that distinguish at least one pair, the strongest first.
///
/// `rest` sorts things by all other fields; `values` has the value of each thing. Source: as [`functional_load`], with two
/// values joined instead of all.
///
/// # Errors
/// [`UndefinedStatistic::Unequal`]; [`UndefinedStatistic::Empty`] without things; [`UndefinedStatistic::NoSpread`] if all forms are equal;
/// [`UndefinedStatistic::TooMany`] if more than 5,000,000 pairs of values meet.
pub fn find_value_contrasts(rest: &EqualityClasses, values: &[u32]) -> Result<Vec<ValueContrast>, UndefinedStatistic> {
    if rest.class_thing_count() != values.len() {
        return Err(UndefinedStatistic::Unequal);
    }
    let forms = EqualityClasses::sort_by_keys(rest.of.iter().zip(values));
    let total_entropy = forms.class_entropy()?;
    if total_entropy <= 0.0 {
        return Err(UndefinedStatistic::NoSpread);
    }
    let mut counts: BTreeMap<(usize, u32), usize> = BTreeMap::new();
    for (class, value) in rest.of.iter().zip(values) {
        *counts.entry((*class, *value)).or_default() += 1;
    }
    // Sorted by class, as the pieces below need.
    let counts: Vec<((usize, u32), usize)> = counts.into_iter().collect();
    let mut pair_sums: BTreeMap<[u32; 2], (usize, f64)> = BTreeMap::new();
    let mut looked_at = 0;
    for alike in counts.chunk_by(|a, b| a.0.0 == b.0.0) {
        looked_at += alike.len() * (alike.len() - 1) / 2;
        if looked_at > MAX_CONTRAST_PAIRS {
            return Err(UndefinedStatistic::TooMany);
        }
        for (at, ((_, one), a)) in alike.iter().enumerate() {
            for ((_, other), b) in &alike[at + 1..] {
                let entry = pair_sums.entry([*one, *other]).or_default();
                entry.0 += a * b;
                // The sum loses exactly this if the two values become one.
                entry.1 += count_log_weight(a + b) - count_log_weight(*a) - count_log_weight(*b);
            }
        }
    }
    let scale = values.len() as f64 * total_entropy;
    let contrast = |(values, (pairs, lost))| ValueContrast {
        values,
        pairs,
        load: lost / scale,
    };
    let mut contrast_list: Vec<ValueContrast> = pair_sums.into_iter().map(contrast).collect();
    contrast_list.sort_by(|a, b| b.load.total_cmp(&a.load).then(a.values.cmp(&b.values)));
    Ok(contrast_list)
}
