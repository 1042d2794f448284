//! Words of the report of a study.

use chereme_analysis::statistics::{EffectSize, EquivalenceConclusion, PValueMethod, UndefinedStatistic};

use super::{ExclusionReason, HypothesisVerdict, TestName, VerdictReason};
use crate::study::{AnswerListRow, AnswerState};
use crate::words::{InterfaceLanguage, InterfaceText};

pub use crate::words::texts::report::*;

/// Returns the words for the reason why a statistic has no value.
#[must_use]
pub fn undefined_reason_words(why: UndefinedStatistic) -> InterfaceText {
    match why {
        UndefinedStatistic::NotANumber => NOT_A_NUMBER,
        UndefinedStatistic::Empty => EMPTY,
        UndefinedStatistic::TooFew => TOO_FEW,
        UndefinedStatistic::TooMany => TOO_MANY,
        UndefinedStatistic::NoSpread => NO_SPREAD,
        UndefinedStatistic::NoDifference => NO_DIFFERENCE,
        UndefinedStatistic::Separated => SEPARATED,
        UndefinedStatistic::Dependent => DEPENDENT,
        UndefinedStatistic::Infinite => INFINITE,
        UndefinedStatistic::Unequal => UNEQUAL,
        UndefinedStatistic::OutOfRange => OUT_OF_RANGE,
    }
}

/// Returns the words for a verdict.
#[must_use]
pub fn verdict_words(verdict: HypothesisVerdict) -> InterfaceText {
    match verdict {
        HypothesisVerdict::Supported => SUPPORTED,
        HypothesisVerdict::NotSupported => NOT_SUPPORTED,
        HypothesisVerdict::Undecided => UNDECIDED,
    }
}

/// Returns the words for the reason of a verdict, with a blank `{why}` if there is no test.
#[must_use]
pub fn verdict_reason_words(because: VerdictReason) -> InterfaceText {
    match because {
        VerdictReason::Significant => SIGNIFICANT,
        VerdictReason::WithinBounds => WITHIN_BOUNDS,
        VerdictReason::BeyondBounds => BEYOND_BOUNDS,
        VerdictReason::OppositeDirection => OPPOSITE_DIRECTION,
        VerdictReason::WideInterval => WIDE_INTERVAL,
        VerdictReason::NotSignificant => NOT_SIGNIFICANT,
        VerdictReason::NoTest(_) => NO_TEST,
    }
}

/// Returns the words for a reason to leave a participant out, with the blanks `{n}` and `{question}`.
#[must_use]
pub fn exclusion_reason_text(reason: &ExclusionReason) -> InterfaceText {
    use crate::study::study_plan::ExclusionRule;
    match reason {
        ExclusionReason::NoConsent => NOT_CONSENTED,
        ExclusionReason::Rule(ExclusionRule::Unfinished) => UNFINISHED,
        ExclusionReason::Rule(ExclusionRule::ChecksWrong(_)) => CHECKS_WRONG,
        ExclusionReason::Rule(ExclusionRule::OneValue) => ONE_VALUE,
        ExclusionReason::Filter { .. } => FILTERED,
    }
}

/// Returns an answer, or the reason why it is missing.
#[must_use]
pub fn answer_text(row: &AnswerListRow, language: InterfaceLanguage) -> String {
    match row.state {
        AnswerState::Answered => row.answer.clone(),
        AnswerState::CannotSay => CANNOT_SAY.text_in_language(language).to_owned(),
        AnswerState::Skipped => SKIPPED.text_in_language(language).to_owned(),
        AnswerState::NotReached => NOT_REACHED.text_in_language(language).to_owned(),
    }
}

/// Returns the words for the size of an effect.
#[must_use]
pub fn effect_size_words(size: EffectSize) -> InterfaceText {
    match size {
        EffectSize::Negligible => NEGLIGIBLE,
        EffectSize::Small => SMALL,
        EffectSize::Medium => MEDIUM,
        EffectSize::Large => LARGE,
    }
}

/// Returns the name of a test.
#[must_use]
pub fn test_name_text(test: TestName) -> InterfaceText {
    match test {
        TestName::MannWhitney => MANN_WHITNEY,
        TestName::Wilcoxon => WILCOXON,
        TestName::Fisher => FISHER,
        TestName::Mcnemar => MCNEMAR,
    }
}

/// Returns the name of the statistic of a test.
#[must_use]
pub fn test_statistic_name(test: TestName) -> InterfaceText {
    match test {
        TestName::MannWhitney => U,
        TestName::Wilcoxon => W_PLUS,
        TestName::Fisher => ODDS,
        TestName::Mcnemar => B,
    }
}

/// Returns the words for the computation of a p.
#[must_use]
pub fn p_method_words(method: PValueMethod) -> InterfaceText {
    match method {
        PValueMethod::Exact => EXACT,
        PValueMethod::Continuity | PValueMethod::Normal => APPROXIMATE,
    }
}

/// Returns the words for whether a difference is smaller than the smallest of interest.
#[must_use]
pub fn sameness_words(result: EquivalenceConclusion) -> InterfaceText {
    match result {
        EquivalenceConclusion::Equivalent => YES,
        EquivalenceConclusion::Relevant => NO,
        EquivalenceConclusion::Undecided => OPEN,
    }
}
