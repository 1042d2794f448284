//! Conclusions about hypotheses: supported, not supported, or undecided.
//!
//! A test that is not significant shows no sameness. So a hypothesis of a difference is refused only if the interval
//! excludes every difference of interest, and a hypothesis of sameness holds only if it does.

use chereme_analysis::statistics::{EquivalenceConclusion, UndefinedStatistic};

use super::{
    GroupComparison, HypothesisConclusion, HypothesisVerdict, MeasureReport, StatedHypothesis, StatsOutcome,
    VerdictReason,
};
use crate::study::study_plan::ExpectedResult;

/// Returns the conclusion about a hypothesis from the tests of people's means and the intervals of the effects.
pub(super) fn conclude_hypothesis(
    compared: &GroupComparison,
    stated: &StatedHypothesis,
    trend: bool,
) -> HypothesisConclusion {
    match (&compared.measure, stated.expects) {
        (Some(measure), ExpectedResult::Difference) => of_measure(measure, stated.alpha),
        (Some(measure), ExpectedResult::SameWithin(bound)) => no_correlation(measure, bound),
        (None, ExpectedResult::SameWithin(_)) => of_sameness(compared),
        (None, ExpectedResult::Difference) if trend => of_trend(compared, stated.alpha),
        (None, ExpectedResult::Difference) => of_difference(compared, stated.alpha),
    }
}

fn conclusion_from_verdict(verdict: HypothesisVerdict, because: VerdictReason) -> HypothesisConclusion {
    HypothesisConclusion { verdict, because }
}

/// Returns p of a test; groups that do not differ at all have p = 1.
fn p_of<T>(outcome: &StatsOutcome<T>, p: impl Fn(&T) -> f64) -> Result<f64, UndefinedStatistic> {
    match outcome {
        StatsOutcome::Found(test) => Ok(p(test)),
        StatsOutcome::Nothing {
            why: UndefinedStatistic::NoDifference | UndefinedStatistic::NoSpread,
        } => Ok(1.0),
        StatsOutcome::Nothing { why } => Err(*why),
    }
}

fn of_difference(compared: &GroupComparison, alpha: f64) -> HypothesisConclusion {
    let p = match (&compared.overall, &compared.pairs[..]) {
        (Some(overall), _) => p_of(&overall.people, |test| test.p),
        (None, [pair]) => p_of(&pair.people, |test| test.p),
        _ => Err(UndefinedStatistic::TooFew),
    };
    match p {
        Ok(p) if p < alpha => conclusion_from_verdict(HypothesisVerdict::Supported, VerdictReason::Significant),
        // A test without significance says nothing yet, so the intervals decide.
        Ok(_) if results(compared).all(|result| result == Ok(EquivalenceConclusion::Equivalent)) => {
            conclusion_from_verdict(HypothesisVerdict::NotSupported, VerdictReason::WithinBounds)
        }
        Ok(_) => match results(compared).find_map(Result::err) {
            Some(why @ (UndefinedStatistic::TooFew | UndefinedStatistic::NoSpread)) => {
                conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NoTest(why))
            }
            _ => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::WideInterval),
        },
        Err(why) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NoTest(why)),
    }
}

fn of_sameness(compared: &GroupComparison) -> HypothesisConclusion {
    if compared.pairs.is_empty() {
        return conclusion_from_verdict(
            HypothesisVerdict::Undecided,
            VerdictReason::NoTest(UndefinedStatistic::TooFew),
        );
    }
    // One relevant difference is enough to refute sameness.
    if results(compared).any(|result| result == Ok(EquivalenceConclusion::Relevant)) {
        return conclusion_from_verdict(HypothesisVerdict::NotSupported, VerdictReason::BeyondBounds);
    }
    match results(compared).find_map(Result::err) {
        Some(why) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NoTest(why)),
        None if results(compared).all(|result| result == Ok(EquivalenceConclusion::Equivalent)) => {
            conclusion_from_verdict(HypothesisVerdict::Supported, VerdictReason::WithinBounds)
        }
        None => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::WideInterval),
    }
}

/// Concludes about groups that rise: every step has to be significant by itself (Berger 1982), without a correction.
fn of_trend(compared: &GroupComparison, alpha: f64) -> HypothesisConclusion {
    let step_results = compared.pairs.iter().map(|pair| p_of(&pair.people, |test| test.p));
    let steps: Result<Vec<f64>, UndefinedStatistic> = step_results.collect();
    // A rise makes delta, first minus second, negative.
    let opposite = compared.pairs.iter().any(|pair| {
        let sameness = pair.sameness.found_result();
        sameness.is_some_and(|outcome| outcome.ends.low > -outcome.bound)
    });
    match steps {
        Err(why) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NoTest(why)),
        Ok(steps) if steps.is_empty() => conclusion_from_verdict(
            HypothesisVerdict::Undecided,
            VerdictReason::NoTest(UndefinedStatistic::TooFew),
        ),
        Ok(steps) if steps.iter().all(|p| *p < alpha) => {
            conclusion_from_verdict(HypothesisVerdict::Supported, VerdictReason::Significant)
        }
        Ok(_) if opposite => conclusion_from_verdict(HypothesisVerdict::NotSupported, VerdictReason::OppositeDirection),
        Ok(_) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::WideInterval),
    }
}

fn of_measure(measure: &MeasureReport, alpha: f64) -> HypothesisConclusion {
    let p = match &measure.spearman {
        StatsOutcome::Found(it) => it.p.ok_or(UndefinedStatistic::TooFew),
        StatsOutcome::Nothing { why } => Err(*why),
    };
    match p {
        Ok(p) if p < alpha => conclusion_from_verdict(HypothesisVerdict::Supported, VerdictReason::Significant),
        Ok(_) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NotSignificant),
        Err(why) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NoTest(why)),
    }
}

fn no_correlation(measure: &MeasureReport, bound: f64) -> HypothesisConclusion {
    match &measure.interval {
        StatsOutcome::Found(ends) if ends.low > -bound && ends.high < bound => {
            conclusion_from_verdict(HypothesisVerdict::Supported, VerdictReason::WithinBounds)
        }
        StatsOutcome::Found(ends) if ends.low >= bound || ends.high <= -bound => {
            conclusion_from_verdict(HypothesisVerdict::NotSupported, VerdictReason::BeyondBounds)
        }
        StatsOutcome::Found(_) => conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::WideInterval),
        StatsOutcome::Nothing { why } => {
            conclusion_from_verdict(HypothesisVerdict::Undecided, VerdictReason::NoTest(*why))
        }
    }
}

fn results(compared: &GroupComparison) -> impl Iterator<Item = Result<EquivalenceConclusion, UndefinedStatistic>> {
    compared.pairs.iter().map(|pair| match &pair.sameness {
        StatsOutcome::Found(it) => Ok(it.result),
        StatsOutcome::Nothing { why } => Err(*why),
    })
}
