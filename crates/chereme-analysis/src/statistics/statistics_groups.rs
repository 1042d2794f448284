//! Tests and effects for groups of different people or of pooled answers.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::{
    PValueMethod, TestAlternative, UndefinedStatistic, check_finite_values, exact_p, mid_ranks, normal_p,
    normal_tail_share,
};

/// The largest group for which p can be exact.
const MAX_EXACT_GROUP: usize = 100;
/// The most pairs of different values for which a shift is computed.
const MOST_SHIFTS: usize = 4_000_000;

/// The result of a Mann-Whitney test (Wilcoxon rank sum).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MannWhitney {
    /// The sizes of the two groups.
    pub n: [usize; 2],
    /// U of the first group: in how many pairs its value is higher, ties counted half.
    pub u: f64,
    /// The standard deviation of U if the groups do not differ, corrected for ties.
    pub sd: f64,
    /// The probability of such a U if the groups do not differ.
    pub p: f64,
    /// The computation of p.
    pub method: PValueMethod,
}

/// Tests whether the values of one group tend to be higher than those of another.
///
/// Without a method p is exact up to 100 values in each group, with ties too, and approximate above. The exact p is
/// the share of all assignments of the values to the groups; two-sided by distance from the mean.
/// Source: Mann and Whitney 1947; the variance with ties as in Lehmann, Nonparametrics (1975), section 1.4.
///
/// # Errors
/// [`UndefinedStatistic::Empty`], [`UndefinedStatistic::NotANumber`]; [`UndefinedStatistic::NoSpread`] for [`PValueMethod::Normal`] if all values are
/// equal; [`UndefinedStatistic::TooMany`] for [`PValueMethod::Exact`] with more than 100 values in a group.
pub fn mann_whitney(
    first: &[f64],
    second: &[f64],
    side: TestAlternative,
    method: Option<PValueMethod>,
) -> Result<MannWhitney, UndefinedStatistic> {
    check_finite_values(first)?;
    check_finite_values(second)?;
    let n = [first.len(), second.len()];
    let all = mid_ranks(&[first, second].concat())?;
    let (n1, n2) = (n[0] as f64, n[1] as f64);
    let total = n1 + n2;
    let rank_sum: f64 = all.ranks[..n[0]].iter().sum();
    let u = rank_sum - n1 * (n1 + 1.0) / 2.0;
    let variance = n1 * n2 / 12.0 * (total + 1.0 - all.tie_term() / (total * (total - 1.0)));
    let sd = variance.max(0.0).sqrt();
    let largest = n[0].max(n[1]);
    let method = method.unwrap_or(if largest <= MAX_EXACT_GROUP {
        PValueMethod::Exact
    } else {
        PValueMethod::Continuity
    });
    let p = match method {
        PValueMethod::Exact if largest > MAX_EXACT_GROUP => {
            return Err(UndefinedStatistic::TooMany);
        }
        PValueMethod::Exact => {
            // With ties U may end in a half; twice U is whole.
            let observed = (2.0 * u).round() as usize;
            exact_p(&twice_u_weights(&all.ties, n[0]), observed, 2 * n[0] * n[1], side)
        }
        PValueMethod::Continuity | PValueMethod::Normal => {
            normal_p(u - n1 * n2 / 2.0, sd, side, method == PValueMethod::Continuity)?
        }
    };
    Ok(MannWhitney { n, u, sd, p, method })
}

/// Returns how often each value of 2 U occurs among all assignments of tied values to a first group of `size`.
///
/// The groups of equal values are shared out one after the other: `a` of `t` values can go to the first group in
/// C(t, a) cases, where each is above all earlier values of the second group and level with `t - a`. All counts of two
/// groups of 100 stay below 1e59.
fn twice_u_weights(ties: &[usize], size: usize) -> Vec<f64> {
    let second: usize = ties.iter().sum::<usize>() - size;
    let width = 2 * size * second + 1;
    // `table[k]`: counts of 2 U after the groups so far, with `k` of their values in the first group.
    let mut table = vec![vec![0.0; width]; size + 1];
    table[0][0] = 1.0;
    let mut seen: usize = 0;
    for t in ties {
        // Downwards, so that no value is shared out twice.
        for own in (seen.saturating_sub(second)..=seen.min(size)).rev() {
            let others = seen - own;
            let row = std::mem::replace(&mut table[own], vec![0.0; width]);
            let reached = &row[..=2 * own * others];
            let mut choices = 1.0;
            for a in 0..=(*t).min(size - own) {
                let left = t - a;
                if others + left <= second {
                    let target = table[own + a][2 * a * others + a * left..].iter_mut();
                    for (sum, count) in target.zip(reached) {
                        *sum += choices * count;
                    }
                }
                // The next binomial coefficient follows from this one.
                choices *= left as f64 / (a + 1) as f64;
            }
        }
        seen += t;
    }
    table.pop().unwrap_or_default()
}

/// The words for the size of an effect, by the usual bounds of Cliff's delta: 0.147, 0.33 and 0.474.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EffectSize {
    /// Below 0.147.
    Negligible,
    /// From 0.147.
    Small,
    /// From 0.33.
    Medium,
    /// From 0.474.
    Large,
}

/// The effect of two groups on each other's ranks.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GroupEffect {
    /// The probability that a value of the first group is higher than one of the second, ties counted half (A12).
    pub a12: f64,
    /// Cliff's delta, 2 A12 - 1, which is the rank-biserial correlation: from -1 to 1.
    pub delta: f64,
    /// The median of all differences, first minus second (Hodges and Lehmann); nothing for too many values.
    pub shift: Option<f64>,
}

impl GroupEffect {
    /// Returns the effect between two groups.
    ///
    /// # Errors
    /// [`UndefinedStatistic::Empty`], [`UndefinedStatistic::NotANumber`].
    pub fn measure_group_effect(first: &[f64], second: &[f64]) -> Result<Self, UndefinedStatistic> {
        check_finite_values(first)?;
        check_finite_values(second)?;
        let ranks = mid_ranks(&[first, second].concat())?.ranks;
        let (n1, n2) = (first.len() as f64, second.len() as f64);
        let u = ranks[..first.len()].iter().sum::<f64>() - n1 * (n1 + 1.0) / 2.0;
        let a12 = u / (n1 * n2);
        Ok(Self {
            a12,
            delta: 2.0 * a12 - 1.0,
            shift: median_group_shift(first, second),
        })
    }

    /// Returns the words for the size of the effect.
    #[must_use]
    pub fn effect_size(&self) -> EffectSize {
        match self.delta.abs() {
            delta if delta < 0.147 => EffectSize::Negligible,
            delta if delta < 0.33 => EffectSize::Small,
            delta if delta < 0.474 => EffectSize::Medium,
            _ => EffectSize::Large,
        }
    }
}

/// Returns the median of all differences; equal values are counted once, with their number.
fn median_group_shift(first: &[f64], second: &[f64]) -> Option<f64> {
    let counted = |values: &[f64]| -> Vec<(f64, u64)> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let equal = sorted.chunk_by(|a, b| a == b);
        equal.map(|run| (run[0], run.len() as u64)).collect()
    };
    let (first, second) = (counted(first), counted(second));
    if first.len().saturating_mul(second.len()) > MOST_SHIFTS {
        return None;
    }
    let mut differences: Vec<(f64, u64)> = Vec::new();
    for (x, n) in &first {
        differences.extend(second.iter().map(|(y, m)| (x - y, n * m)));
    }
    differences.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: u64 = differences.iter().map(|(_, n)| n).sum();
    let nth_difference = |place: u64| {
        let mut before = 0;
        let mut remaining = differences.iter().skip_while(|(_, n)| {
            before += n;
            before <= place
        });
        remaining.next().map(|(value, _)| *value)
    };
    Some((nth_difference((all - 1) / 2)? + nth_difference(all / 2)?) / 2.0)
}

/// One comparison of two of several groups.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EffectComparison {
    /// The places of the two groups in the list.
    pub groups: [usize; 2],
    /// Dunn's z: the difference of mean ranks in standard errors.
    pub z: f64,
    /// The two-sided p of this comparison alone.
    pub p: f64,
    /// p corrected for the number of comparisons by Holm's method.
    pub p_holm: f64,
}

/// The result of a Kruskal-Wallis test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KruskalWallis {
    /// The number of all values.
    pub n: usize,
    /// H, corrected for ties.
    pub h: f64,
    /// The degrees of freedom: the number of groups - 1.
    pub df: usize,
    /// The probability of such an H if the groups do not differ (chi-squared).
    pub p: f64,
    /// The effect: H / (n - 1), from 0 to 1.
    pub epsilon_squared: f64,
    /// The mean rank of each group.
    pub mean_ranks: Vec<f64>,
    /// Dunn's comparison of each pair of groups.
    pub comparisons: Vec<EffectComparison>,
}

/// Tests whether any of several groups tends to higher values, and compares each pair.
///
/// Source: Kruskal and Wallis 1952; Dunn 1964, with Holm's correction.
///
/// # Errors
/// [`UndefinedStatistic::TooFew`] for fewer than two groups, [`UndefinedStatistic::Empty`], [`UndefinedStatistic::NotANumber`], and
/// [`UndefinedStatistic::NoSpread`] if all values are equal.
pub fn kruskal_wallis(groups: &[&[f64]]) -> Result<KruskalWallis, UndefinedStatistic> {
    if groups.len() < 2 {
        return Err(UndefinedStatistic::TooFew);
    }
    groups.iter().try_for_each(|group| check_finite_values(group))?;
    let all = mid_ranks(&groups.concat())?;
    let n = all.ranks.len();
    let total = n as f64;
    let correction = 1.0 - all.tie_term() / (total.powi(3) - total);
    if all.ties.len() < 2 {
        return Err(UndefinedStatistic::NoSpread);
    }
    let mut begin = 0;
    let mut mean_ranks = Vec::with_capacity(groups.len());
    for group in groups {
        let group_ranks = &all.ranks[begin..begin + group.len()];
        mean_ranks.push(group_ranks.iter().sum::<f64>() / group_ranks.len() as f64);
        begin += group.len();
    }
    let ranked_groups = mean_ranks.iter().zip(groups);
    let squares: f64 = ranked_groups.map(|(mean, it)| mean * mean * it.len() as f64).sum();
    let h = (12.0 / (total * (total + 1.0)) * squares - 3.0 * (total + 1.0)) / correction;
    let variance = total * (total + 1.0) / 12.0 - all.tie_term() / (12.0 * (total - 1.0));
    let mut comparisons = Vec::new();
    for i in 0..groups.len() {
        for j in i + 1..groups.len() {
            let sizes = 1.0 / groups[i].len() as f64 + 1.0 / groups[j].len() as f64;
            let z = (mean_ranks[i] - mean_ranks[j]) / (variance * sizes).sqrt();
            comparisons.push(EffectComparison {
                groups: [i, j],
                z,
                p: (2.0 * normal_tail_share(z.abs())).min(1.0),
                p_holm: 1.0,
            });
        }
    }
    let corrected = holm_p_values(&comparisons.iter().map(|comparison| comparison.p).collect::<Vec<_>>());
    for (own, p_holm) in comparisons.iter_mut().zip(corrected) {
        own.p_holm = p_holm;
    }
    let df = groups.len() - 1;
    Ok(KruskalWallis {
        n,
        h,
        df,
        p: chi_squared_above(h, df),
        epsilon_squared: h / (total - 1.0),
        mean_ranks,
        comparisons,
    })
}

/// Returns the share of the chi-squared distribution above a value.
pub(super) fn chi_squared_above(value: f64, df: usize) -> f64 {
    let distribution = ChiSquared::new(df as f64).expect("one degree of freedom or more");
    distribution.sf(value.max(0.0))
}

/// Returns p-values corrected for their number by Holm's method, in the order in which they come.
#[must_use]
pub fn holm_p_values(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    let mut corrected = vec![1.0; p.len()];
    let mut most: f64 = 0.0;
    for (place, own) in order.into_iter().enumerate() {
        // No corrected p is below that of a smaller p.
        most = most.max(p[own] * (p.len() - place) as f64).min(1.0);
        corrected[own] = most;
    }
    corrected
}
