//! Entropy of things that are sorted into classes, and the load that a field of their descriptions carries.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Undefined, jackknife};

/// The most pairs of values that are looked at for contrasts.
const MOST_PAIRS: usize = 5_000_000;

/// Things sorted into classes of equal things.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Classes {
    /// The class of each thing.
    of: Vec<usize>,
    /// The number of things in each class, none of them 0.
    sizes: Vec<usize>,
}

impl Classes {
    /// Sorts things by their keys: things with equal keys are in one class.
    pub fn by<K: Ord>(keys: impl IntoIterator<Item = K>) -> Self {
        let mut known: BTreeMap<K, usize> = BTreeMap::new();
        let mut sizes = Vec::new();
        let class = |key| {
            let next = known.len();
            let class = *known.entry(key).or_insert(next);
            if class == sizes.len() {
                sizes.push(0);
            }
            sizes[class] += 1;
            class
        };
        Self {
            of: keys.into_iter().map(class).collect(),
            sizes,
        }
    }

    /// Returns the number of things.
    #[must_use]
    pub fn things(&self) -> usize {
        self.of.len()
    }

    /// Returns the number of things in each class.
    #[must_use]
    pub fn sizes(&self) -> &[usize] {
        &self.sizes
    }

    /// Returns Shannon's entropy in bits, from the shares of the classes as they are (no correction for rare classes).
    ///
    /// # Errors
    /// [`Undefined::Empty`] without things.
    pub fn entropy(&self) -> Result<f64, Undefined> {
        if self.of.is_empty() {
            return Err(Undefined::Empty);
        }
        Ok(bits(self.of.len(), self.weight()))
    }

    /// Returns the interval of the entropy by the [`jackknife`] over things, cut at 0.
    ///
    /// # Errors
    /// Those of [`jackknife`].
    pub fn entropy_interval(&self, level: f64) -> Result<[f64; 2], Undefined> {
        let [low, high] = jackknife(self.entropy()?, &self.entropies_without(), level)?;
        Ok([low.max(0.0), high])
    }

    /// Returns the sum of c log2 c over the sizes of the classes.
    fn weight(&self) -> f64 {
        self.sizes.iter().map(|size| weight(*size)).sum()
    }

    /// Returns the entropy without each thing in turn; nothing for fewer than two things.
    fn entropies_without(&self) -> Vec<f64> {
        let (n, all) = (self.of.len(), self.weight());
        if n < 2 {
            return Vec::new();
        }
        let without = |size: &usize| bits(n - 1, all - weight(*size) + weight(size - 1));
        let by_class: Vec<f64> = self.sizes.iter().map(without).collect();
        self.of.iter().map(|class| by_class[*class]).collect()
    }
}

/// Returns c log2 c, which is 0 for 0.
fn weight(count: usize) -> f64 {
    match count {
        0 => 0.0,
        count => count as f64 * (count as f64).log2(),
    }
}

/// Returns the entropy of `n` things whose classes have this sum of c log2 c.
fn bits(n: usize, weight: f64) -> f64 {
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
/// [`Undefined::Empty`] without things; [`Undefined::NoSpread`] if all forms are equal; [`Undefined::Unequal`] if the two
/// sort different numbers of things.
pub fn functional_load(forms: &Classes, without: &Classes) -> Result<f64, Undefined> {
    if forms.things() != without.things() {
        return Err(Undefined::Unequal);
    }
    // Classes that are joined with none are the same classes.
    let same = forms.sizes.len() == without.sizes.len();
    load(
        forms.entropy()?,
        if same {
            forms.entropy()?
        } else {
            without.entropy()?
        },
    )
}

fn load(whole: f64, less: f64) -> Result<f64, Undefined> {
    match whole > 0.0 {
        true => Ok((whole - less) / whole),
        false => Err(Undefined::NoSpread),
    }
}

/// Returns the interval of [`functional_load`] by the [`jackknife`] over things, cut at 0 and 1.
///
/// Resamples would not do: an entry that is drawn twice is a homonym that the lexicon does not have.
///
/// # Errors
/// Those of [`functional_load`] and of [`jackknife`].
pub fn functional_load_interval(
    forms: &Classes,
    without: &Classes,
    level: f64,
) -> Result<[f64; 2], Undefined> {
    let estimate = functional_load(forms, without)?;
    let (whole, less) = (forms.entropies_without(), without.entropies_without());
    let both = whole.iter().zip(&less);
    let loads: Vec<f64> = both
        .map(|(whole, less)| load(*whole, *less))
        .collect::<Result<_, _>>()?;
    let [low, high] = jackknife(estimate, &loads, level)?;
    Ok([low.max(0.0), high.min(1.0)])
}

/// Two values of a field that distinguish forms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contrast {
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
/// [`Undefined::Unequal`]; [`Undefined::Empty`] without things; [`Undefined::NoSpread`] if all forms are equal;
/// [`Undefined::TooMany`] if more than 5,000,000 pairs of values meet.
pub fn contrasts(rest: &Classes, values: &[u32]) -> Result<Vec<Contrast>, Undefined> {
    if rest.things() != values.len() {
        return Err(Undefined::Unequal);
    }
    let forms = Classes::by(rest.of.iter().zip(values));
    let whole = forms.entropy()?;
    if whole <= 0.0 {
        return Err(Undefined::NoSpread);
    }
    let mut counts: BTreeMap<(usize, u32), usize> = BTreeMap::new();
    for (class, value) in rest.of.iter().zip(values) {
        *counts.entry((*class, *value)).or_default() += 1;
    }
    let counts: Vec<((usize, u32), usize)> = counts.into_iter().collect();
    let mut found: BTreeMap<[u32; 2], (usize, f64)> = BTreeMap::new();
    let mut looked_at = 0;
    for alike in counts.chunk_by(|a, b| a.0.0 == b.0.0) {
        looked_at += alike.len() * (alike.len() - 1) / 2;
        if looked_at > MOST_PAIRS {
            return Err(Undefined::TooMany);
        }
        for (at, ((_, one), a)) in alike.iter().enumerate() {
            for ((_, other), b) in &alike[at + 1..] {
                let held = found.entry([*one, *other]).or_default();
                held.0 += a * b;
                held.1 += weight(a + b) - weight(*a) - weight(*b);
            }
        }
    }
    let scale = values.len() as f64 * whole;
    let contrast = |(values, (pairs, lost))| Contrast {
        values,
        pairs,
        load: lost / scale,
    };
    let mut found: Vec<Contrast> = found.into_iter().map(contrast).collect();
    found.sort_by(|a, b| b.load.total_cmp(&a.load).then(a.values.cmp(&b.values)));
    Ok(found)
}
