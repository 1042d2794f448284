//! Conclusions about hypotheses: supported, not supported, or undecided.
//!
//! A test that is not significant shows no sameness. So a hypothesis of a difference is refused only if the interval
//! excludes every difference of interest, and a hypothesis of sameness holds only if it does.

use chereme_analysis::statistics::{Equivalence, Undefined};

use super::{Because, Compared, Conclusion, MeasureReport, Outcome, Stated, Verdict};
use crate::study::plan::Expectation;

/// Returns the conclusion about a hypothesis from the tests of people's means and the intervals of the effects.
pub(super) fn conclude(compared: &Compared, stated: &Stated, trend: bool) -> Conclusion {
    match (&compared.measure, stated.expects) {
        (Some(measure), Expectation::Difference) => of_measure(measure, stated.alpha),
        (Some(measure), Expectation::SameWithin(bound)) => no_correlation(measure, bound),
        (None, Expectation::SameWithin(_)) => of_sameness(compared),
        (None, Expectation::Difference) if trend => of_trend(compared, stated.alpha),
        (None, Expectation::Difference) => of_difference(compared, stated.alpha),
    }
}

fn verdict(verdict: Verdict, because: Because) -> Conclusion {
    Conclusion { verdict, because }
}

/// Returns p of a test; groups that do not differ at all have p = 1.
fn p_of<T>(outcome: &Outcome<T>, p: impl Fn(&T) -> f64) -> Result<f64, Undefined> {
    match outcome {
        Outcome::Found(test) => Ok(p(test)),
        Outcome::Nothing {
            why: Undefined::NoDifference | Undefined::NoSpread,
        } => Ok(1.0),
        Outcome::Nothing { why } => Err(*why),
    }
}

fn of_difference(compared: &Compared, alpha: f64) -> Conclusion {
    let p = match (&compared.overall, &compared.pairs[..]) {
        (Some(overall), _) => p_of(&overall.people, |it| it.p),
        (None, [pair]) => p_of(&pair.people, |it| it.p),
        _ => Err(Undefined::TooFew),
    };
    match p {
        Ok(p) if p < alpha => verdict(Verdict::Supported, Because::Significant),
        Ok(_) if results(compared).all(|it| it == Ok(Equivalence::Equivalent)) => {
            verdict(Verdict::NotSupported, Because::WithinBounds)
        }
        Ok(_) => match results(compared).find_map(Result::err) {
            Some(why @ (Undefined::TooFew | Undefined::NoSpread)) => {
                verdict(Verdict::Undecided, Because::NoTest(why))
            }
            _ => verdict(Verdict::Undecided, Because::WideInterval),
        },
        Err(why) => verdict(Verdict::Undecided, Because::NoTest(why)),
    }
}

fn of_sameness(compared: &Compared) -> Conclusion {
    if compared.pairs.is_empty() {
        return verdict(Verdict::Undecided, Because::NoTest(Undefined::TooFew));
    }
    if results(compared).any(|it| it == Ok(Equivalence::Relevant)) {
        return verdict(Verdict::NotSupported, Because::BeyondBounds);
    }
    match results(compared).find_map(Result::err) {
        Some(why) => verdict(Verdict::Undecided, Because::NoTest(why)),
        None if results(compared).all(|it| it == Ok(Equivalence::Equivalent)) => {
            verdict(Verdict::Supported, Because::WithinBounds)
        }
        None => verdict(Verdict::Undecided, Because::WideInterval),
    }
}

/// Concludes about groups that rise: every step has to be significant by itself (Berger 1982), without a correction.
fn of_trend(compared: &Compared, alpha: f64) -> Conclusion {
    let steps = compared
        .pairs
        .iter()
        .map(|it| p_of(&it.people, |test| test.p));
    let steps: Result<Vec<f64>, Undefined> = steps.collect();
    // A rise makes delta, first minus second, negative.
    let opposite = compared.pairs.iter().any(|it| {
        let sameness = it.sameness.found();
        sameness.is_some_and(|it| it.ends.low > -it.bound)
    });
    match steps {
        Err(why) => verdict(Verdict::Undecided, Because::NoTest(why)),
        Ok(steps) if steps.is_empty() => {
            verdict(Verdict::Undecided, Because::NoTest(Undefined::TooFew))
        }
        Ok(steps) if steps.iter().all(|p| *p < alpha) => {
            verdict(Verdict::Supported, Because::Significant)
        }
        Ok(_) if opposite => verdict(Verdict::NotSupported, Because::OppositeDirection),
        Ok(_) => verdict(Verdict::Undecided, Because::WideInterval),
    }
}

fn of_measure(measure: &MeasureReport, alpha: f64) -> Conclusion {
    let p = match &measure.spearman {
        Outcome::Found(it) => it.p.ok_or(Undefined::TooFew),
        Outcome::Nothing { why } => Err(*why),
    };
    match p {
        Ok(p) if p < alpha => verdict(Verdict::Supported, Because::Significant),
        Ok(_) => verdict(Verdict::Undecided, Because::NotSignificant),
        Err(why) => verdict(Verdict::Undecided, Because::NoTest(why)),
    }
}

fn no_correlation(measure: &MeasureReport, bound: f64) -> Conclusion {
    match &measure.interval {
        Outcome::Found(ends) if ends.low > -bound && ends.high < bound => {
            verdict(Verdict::Supported, Because::WithinBounds)
        }
        Outcome::Found(ends) if ends.low >= bound || ends.high <= -bound => {
            verdict(Verdict::NotSupported, Because::BeyondBounds)
        }
        Outcome::Found(_) => verdict(Verdict::Undecided, Because::WideInterval),
        Outcome::Nothing { why } => verdict(Verdict::Undecided, Because::NoTest(*why)),
    }
}

fn results(compared: &Compared) -> impl Iterator<Item = Result<Equivalence, Undefined>> {
    compared.pairs.iter().map(|it| match &it.sameness {
        Outcome::Found(it) => Ok(it.result),
        Outcome::Nothing { why } => Err(*why),
    })
}
