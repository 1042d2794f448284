//! The report of a study: people, answers, comparisons and conclusions, made from the plan and the answers alone.
//!
//! The same plan and answers give the same report, byte for byte: resamples come from the seed of the plan.

mod charts;
mod conclude;
mod report_compare;
mod report_groups;
pub mod report_numbers;
mod report_page;
mod report_people;
mod report_tables;
pub mod report_words;
#[cfg(test)]
mod tests;

use chereme_analysis::statistics::{
    EffectSize, EquivalenceConclusion, FriedmanResult, GroupDescription, PValueMethod, RankCorrelation,
    ResampleIntervalRule, TestAlternative, UndefinedStatistic, ordinal,
};
use serde::Serialize;

use crate::Corpus;
use crate::error::CorpusResult;

use super::study_answers::StudyParticipant;
use super::study_plan::{ExclusionRule, ExpectedResult, LocalizedTexts, QuestionKind, StudyPlan};

pub use charts::ChartShade;

/// The settings of a report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportOptions {
    /// How often participants are resampled for each interval.
    pub resamples: usize,
    /// The level of intervals.
    pub level: f64,
}

impl Default for ReportOptions {
    fn default() -> Self {
        Self {
            resamples: 10_000,
            level: 0.95,
        }
    }
}

/// The report of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyReport {
    /// `chereme-report`.
    pub format: &'static str,
    /// The version of the format.
    pub version: u32,
    /// The version of the program.
    pub program: &'static str,
    /// The name of the study.
    pub study: String,
    /// Its title.
    pub title: LocalizedTexts,
    /// The SHA-256 of the plan.
    pub plan_sha256: String,
    /// The settings of intervals.
    pub resampling: ResamplingSettings,
    /// The people.
    pub people: ReportPeople,
    /// The questions, in the order of the plan.
    pub questions: Vec<QuestionReport>,
    /// The comparisons: one for each hypothesis, or all pairs of conditions if the plan states none.
    pub comparisons: Vec<GroupComparison>,
}

/// The settings of intervals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResamplingSettings {
    /// How often participants were resampled.
    pub times: usize,
    /// The seed.
    pub seed: u64,
    /// The level of intervals.
    pub level: f64,
}

/// A result, or the reason why it is undefined.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum StatsOutcome<T> {
    /// The result.
    Found(T),
    /// No result.
    Nothing {
        /// The reason.
        why: UndefinedStatistic,
    },
}

impl<T> StatsOutcome<T> {
    /// Returns the result.
    #[must_use]
    pub fn found_result(&self) -> Option<&T> {
        self.result().ok()
    }

    fn result(&self) -> std::result::Result<&T, UndefinedStatistic> {
        match self {
            Self::Found(it) => Ok(it),
            Self::Nothing { why } => Err(*why),
        }
    }
}

impl<T> From<std::result::Result<T, UndefinedStatistic>> for StatsOutcome<T> {
    fn from(result: std::result::Result<T, UndefinedStatistic>) -> Self {
        match result {
            Ok(it) => Self::Found(it),
            Err(why) => Self::Nothing { why },
        }
    }
}

/// The participants: how many came, how many were left out and why, and who they are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportPeople {
    /// How many files of answers there are.
    pub recruited: usize,
    /// How many were left out, by the first reason that applies.
    pub excluded: Vec<ExcludedParticipants>,
    /// How many are analysed.
    pub analysed: usize,
    /// How many of the analysed answered another version of the plan.
    pub other_plan: usize,
    /// The answers about the participants.
    pub profile: Vec<ProfileTable>,
}

/// Participants who were left out for one reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExcludedParticipants {
    /// The reason.
    pub reason: ExclusionReason,
    /// How many.
    pub count: usize,
}

/// The reason why a participant is left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExclusionReason {
    /// The participant did not agree to an analysis.
    NoConsent,
    /// A rule of the plan.
    Rule(ExclusionRule),
    /// An answer about the participant is not among those that are analysed.
    Filter {
        /// The name of the question.
        question: String,
    },
}

/// How many participants gave each answer about themselves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProfileTable {
    /// The name of the question.
    pub question: String,
    /// Its text.
    pub text: LocalizedTexts,
    /// The options of the plan, then other answers, then those who gave none.
    pub rows: Vec<ProfileRow>,
}

/// One answer about participants.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProfileRow {
    /// The name of the option; none for those who gave no answer.
    pub option: Option<String>,
    /// Its text.
    pub text: LocalizedTexts,
    /// How many of all.
    pub recruited: usize,
    /// How many of the analysed.
    pub analysed: usize,
}

/// The answers to one question.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuestionReport {
    /// The name of the question.
    pub name: String,
    /// Its text.
    pub text: LocalizedTexts,
    /// The possible answers.
    pub kind: QuestionKind,
    /// The answers by part and condition.
    pub conditions: Vec<AnswerGroup>,
    /// The answers by part, item and condition.
    pub items: Vec<AnswerGroup>,
    /// Which options were chosen for which right option: for all conditions, and for each if there are several.
    pub confusions: Vec<ConfusionTable>,
    /// The models of answers on a scale, one for each part with several conditions.
    pub models: Vec<ModelReport>,
}

/// The answers of one group of trials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnswerGroup {
    /// The part of the study.
    pub part: String,
    /// The item; none for all of them.
    pub item: Option<String>,
    /// The condition.
    pub condition: String,
    /// How many people answered.
    pub people: usize,
    /// How many answers there are, without `I cannot say`.
    pub answers: usize,
    /// How often the answer was `I cannot say`.
    pub cannot_say: usize,
    /// How often each number of the scale, or each option, was given.
    pub counts: Vec<usize>,
    /// The description of answers on a scale; none for a choice, or without answers.
    pub description: Option<GroupDescription>,
    /// The mean answer of each person on a scale, in ascending order.
    pub person_means: Vec<f64>,
    /// The share of right answers; none if the plan names no right option.
    pub recognition: Option<AnswerShare>,
}

/// A share with Wilson's interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AnswerShare {
    /// How many are right.
    pub right: usize,
    /// How many there are.
    pub of: usize,
    /// The share.
    pub share: f64,
    /// Its interval, as if answers were independent.
    pub interval: [f64; 2],
}

/// Which options were chosen for which right option.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConfusionTable {
    /// The part of the study.
    pub part: String,
    /// The condition; none for all of them.
    pub condition: Option<String>,
    /// The right options, one a row; the items where the plan names no right option.
    pub rows: Vec<String>,
    /// The options.
    pub columns: Vec<String>,
    /// How often each option was chosen, row by row.
    pub counts: Vec<Vec<usize>>,
}

/// A cumulative link model of a question: conditions and items as fixed effects.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelReport {
    /// The part of the study.
    pub part: String,
    /// The condition with which others are compared.
    pub reference: String,
    /// The conditions of the first columns; the columns of items follow.
    pub conditions: Vec<String>,
    /// Whether items are in the model; they are left out if they cannot be separated from conditions.
    pub with_items: bool,
    /// The model; its first coefficients are the conditions in logarithmic odds.
    pub model: StatsOutcome<ordinal::OrdinalModel>,
}

/// The comparison that a hypothesis asks for, or all pairs of conditions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupComparison {
    /// The hypothesis; none if the plan states none, so that nothing is concluded.
    pub hypothesis: Option<StatedHypothesis>,
    /// The name of the question.
    pub question: String,
    /// The part of the study to which all groups belong; empty if they belong to several.
    pub part: String,
    /// The direction of the tests.
    pub side: TestAlternative,
    /// The groups.
    pub groups: Vec<GroupSummary>,
    /// The tests of more than two groups.
    pub overall: Option<OverallTests>,
    /// The pairs of groups.
    pub pairs: Vec<GroupPairComparison>,
    /// The correlation with a measure.
    pub measure: Option<MeasureReport>,
    /// The conclusion.
    pub conclusion: Option<HypothesisConclusion>,
}

/// A hypothesis as the plan states it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StatedHypothesis {
    /// Its name.
    pub name: String,
    /// The statement in words.
    pub text: LocalizedTexts,
    /// The expected result.
    pub expects: ExpectedResult,
    /// The level of significance.
    pub alpha: f64,
}

/// One group of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupSummary {
    /// Its conditions and items, such as `captured` or `cat, captured`.
    pub label: String,
    /// How many people answered.
    pub people: usize,
    /// The answers; shares of right answers count 1 and 0.
    pub description: StatsOutcome<GroupDescription>,
}

/// The tests of more than two groups.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverallTests {
    /// Kruskal-Wallis of all answers, as if they were independent.
    pub pooled: StatsOutcome<PooledAnswersTest>,
    /// Friedman on the means of people who answered in every group.
    pub people: StatsOutcome<FriedmanResult>,
}

/// Kruskal-Wallis of all answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PooledAnswersTest {
    /// H, corrected for ties.
    pub h: f64,
    /// The degrees of freedom.
    pub df: usize,
    /// p.
    pub p: f64,
    /// The effect, from 0 to 1.
    pub epsilon_squared: f64,
}

/// The comparison of two groups.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupPairComparison {
    /// The places of the two groups in the list.
    pub groups: [usize; 2],
    /// The test of all answers, as if they were independent.
    pub pooled: StatsOutcome<PairTest>,
    /// The effect on all answers.
    pub effect: StatsOutcome<EffectReport>,
    /// The test of the means of people.
    pub people: StatsOutcome<PairTest>,
    /// The mean over people of the difference of their means, first minus second; none without people in both groups.
    pub mean_difference: Option<f64>,
    /// Whether the difference is smaller than the smallest of interest.
    pub sameness: StatsOutcome<SamenessTest>,
}

/// One test of two groups.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairTest {
    /// The test.
    pub test: TestName,
    /// How many values each group has; the same number of pairs twice for people who are in both groups.
    pub n: [usize; 2],
    /// U, W+, the number of people right in the first group only, or the odds ratio; none if that is infinite.
    pub statistic: Option<f64>,
    /// The computation of p.
    pub method: PValueMethod,
    /// p of this test alone.
    pub p: f64,
    /// p corrected for the number of pairs by Holm's method.
    pub p_holm: f64,
}

/// The name of a test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TestName {
    /// Mann-Whitney.
    MannWhitney,
    /// Wilcoxon's signed ranks.
    Wilcoxon,
    /// Fisher's exact test.
    Fisher,
    /// McNemar's exact test.
    Mcnemar,
}

/// The effect between two groups.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EffectReport {
    /// Cliff's delta: how much more often the first answer is the higher one; of right answers, the difference of shares.
    pub delta: f64,
    /// The words for its size.
    pub size: EffectSize,
    /// The probability of a higher answer in the first group, ties counted half.
    pub a12: f64,
    /// The median difference.
    pub shift: Option<f64>,
    /// The interval of delta.
    pub interval: StatsOutcome<ResampledInterval>,
}

/// An interval from resampled participants.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResampledInterval {
    /// The rule.
    pub kind: ResampleIntervalRule,
    /// Its level.
    pub level: f64,
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// The test for sameness: whether the interval of delta lies between two bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SamenessTest {
    /// The smallest difference of interest, as Cliff's delta.
    pub bound: f64,
    /// The interval whose level is 1 minus twice the level of significance.
    pub ends: ResampledInterval,
    /// The result.
    pub result: EquivalenceConclusion,
}

/// The correlation of answers with a measure of the trials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureReport {
    /// The name of the measure.
    pub measure: String,
    /// Each trial that has the measure and answers.
    pub points: Vec<MeasurePoint>,
    /// Spearman's coefficient of the measure and the mean answers of trials.
    pub spearman: StatsOutcome<RankCorrelation>,
    /// Kendall's tau-b of the same.
    pub kendall: StatsOutcome<RankCorrelation>,
    /// The interval of Spearman's coefficient.
    pub interval: StatsOutcome<ResampledInterval>,
}

/// A trial with its measure and its mean answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasurePoint {
    /// The part, item and condition.
    pub label: String,
    /// The measure.
    pub measure: f64,
    /// The mean answer.
    pub mean: f64,
}

/// The conclusion about a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HypothesisConclusion {
    /// Whether they support it.
    pub verdict: HypothesisVerdict,
    /// The reason.
    pub because: VerdictReason,
}

/// Whether answers support a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum HypothesisVerdict {
    /// They support it.
    Supported,
    /// They speak against it.
    NotSupported,
    /// They do not decide.
    Undecided,
}

/// The reason of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum VerdictReason {
    /// The test of people's means is significant.
    Significant,
    /// Every interval lies between the bounds.
    WithinBounds,
    /// An interval lies beyond a bound.
    BeyondBounds,
    /// The interval excludes the expected direction.
    OppositeDirection,
    /// The test is not significant, and an interval reaches beyond a bound.
    WideInterval,
    /// The test of a correlation is not significant.
    NotSignificant,
    /// There is no test.
    NoTest(UndefinedStatistic),
}

impl Corpus {
    /// Returns the report of a study with the usual settings.
    ///
    /// # Errors
    /// Fails if there is no study of that name.
    pub fn report_study(&self, name: &str) -> CorpusResult<StudyReport> {
        let study = self.study_with_answers(name)?;
        let options = ReportOptions::default();
        // The stored hash is the one that answers name, also if this version would write the plan in another form.
        let sha256 = study.plan_sha256;
        Ok(report_of(&study.plan, sha256, &study.participants, &options))
    }
}

fn report_of(
    plan: &StudyPlan,
    plan_sha256: String,
    participants: &[StudyParticipant],
    options: &ReportOptions,
) -> StudyReport {
    let (people, analysed) = report_people::sort_out(plan, &plan_sha256, participants);
    let resampling = ResamplingSettings {
        times: options.resamples,
        seed: plan.design.seed,
        level: options.level,
    };
    let questions = plan.questions.iter();
    StudyReport {
        format: "chereme-report",
        version: 1,
        program: env!("CARGO_PKG_VERSION"),
        study: plan.name.clone(),
        title: plan.title.clone(),
        plan_sha256,
        resampling,
        people,
        questions: questions
            .map(|question| report_groups::of_question(plan, question, &analysed))
            .collect(),
        comparisons: report_compare::compare_all_hypotheses(plan, &analysed, &resampling),
    }
}
