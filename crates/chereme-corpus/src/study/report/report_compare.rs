//! Comparisons of groups of trials: tests of all answers and of people's means, effects, intervals and sameness.

use std::collections::BTreeSet;

use chereme_analysis::statistics::{
    EquivalenceConclusion, GroupDescription, GroupEffect, PValueMethod, ParticipantResamples, ResampleIntervalRule,
    TestAlternative, UndefinedStatistic, ZeroTreatment, conclude_equivalence, fisher_exact_test, friedman_test,
    holm_p_values, kendall_tau, kruskal_wallis, mann_whitney, mcnemar_exact_test, spearman_correlation, wilcoxon_test,
};

use super::conclude::conclude_hypothesis;
use super::report_groups::{answer_as_number, main_answers, trials_of};
use super::{
    EffectReport, GroupComparison, GroupPairComparison, GroupSummary, MeasurePoint, MeasureReport, OverallTests,
    PairTest, PooledAnswersTest, ResampledInterval, ResamplingSettings, SamenessTest, StatedHypothesis, StatsOutcome,
    TestName,
};
use crate::study::study_answers::{StudyAnswer, StudyParticipant};
use crate::study::study_plan::{
    ExpectedResult, HypothesisComparison, QuestionKind, StudyHypothesis, StudyPlan, StudyQuestion, TrialSelection,
};

/// The smallest difference of interest if the plan states none, as Cliff's delta: below it an effect is negligible.
pub(super) const SMALLEST_INTERESTING_DELTA: f64 = 0.147;
/// The level of significance of comparisons that no hypothesis asks for.
pub(super) const SIGNIFICANCE_LEVEL: f64 = 0.05;
/// The most pairs of groups for which participants are resampled.
const MAX_RESAMPLED_PAIRS: usize = 200;
/// The fewest trials for which a correlation is shown that no hypothesis asks for.
const MIN_CORRELATION_TRIALS: usize = 4;
/// The most sums that the resampling of one correlation may take.
const MOST_SUMS: usize = 5_000_000_000;

/// The answers of one group: the values of each participant, by the participant's place.
struct GroupAnswers {
    label: String,
    by_person: Vec<Vec<f64>>,
}

impl GroupAnswers {
    fn collect_group_answers(
        plan: &StudyPlan,
        question: &StudyQuestion,
        people: &[&StudyParticipant],
        label: String,
        wanted: &dyn Fn(&StudyAnswer) -> bool,
    ) -> Self {
        let person_values = |one: &&StudyParticipant| {
            let answers = main_answers(one, &question.name).filter(|answer| wanted(answer));
            answers
                .filter_map(|answer| answer_as_number(plan, question, answer))
                .collect()
        };
        Self {
            label,
            by_person: people.iter().map(person_values).collect(),
        }
    }

    fn pooled_answers(&self) -> Vec<f64> {
        self.by_person.concat()
    }

    /// Returns the mean of each participant; none without an answer.
    fn participant_means(&self) -> Vec<Option<f64>> {
        let mean = |values: &Vec<f64>| (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64);
        self.by_person.iter().map(mean).collect()
    }

    fn summary(&self) -> GroupSummary {
        GroupSummary {
            label: self.label.clone(),
            people: self.by_person.iter().filter(|values| !values.is_empty()).count(),
            description: GroupDescription::describe_values(&self.pooled_answers()).into(),
        }
    }
}

/// The settings of the tests of one comparison.
struct ComparisonSettings<'a> {
    side: TestAlternative,
    /// Whether values are right and wrong answers.
    choice: bool,
    alpha: f64,
    bound: f64,
    resampling: &'a ResamplingSettings,
}

/// Returns the comparisons of the hypotheses; without any, all pairs of conditions of each question and part, and its
/// correlation with each measure.
pub(super) fn compare_all_hypotheses(
    plan: &StudyPlan,
    people: &[&StudyParticipant],
    resampling: &ResamplingSettings,
) -> Vec<GroupComparison> {
    // A plan with hypotheses is tested for these alone, so that chance finds are not reported.
    if !plan.hypotheses.is_empty() {
        let stated = plan.hypotheses.iter().filter_map(|hypothesis| {
            let question = plan.find_plan_question(&hypothesis.question)?;
            Some(of_hypothesis(plan, question, hypothesis, people, resampling))
        });
        return stated.collect();
    }
    let mut compared = Vec::new();
    for question in &plan.questions {
        let trials = trials_of(plan, question);
        let measure_names = trials.iter().flat_map(|trial| trial.measures.keys());
        let measures: BTreeSet<&String> = measure_names.collect();
        let mut parts: Vec<(&str, Vec<&str>)> = Vec::new();
        for trial in trials {
            let place = parts.iter().position(|entry| entry.0 == trial.part);
            let index = place.unwrap_or_else(|| {
                parts.push((&trial.part, Vec::new()));
                parts.len() - 1
            });
            if !parts[index].1.contains(&trial.condition.as_str()) {
                parts[index].1.push(&trial.condition);
            }
        }
        for (part, conditions) in parts.iter().filter(|entry| entry.1.len() > 1) {
            let group = |condition: &&str| {
                let wanted = |answer: &StudyAnswer| answer.part == *part && answer.condition == *condition;
                GroupAnswers::collect_group_answers(plan, question, people, (*condition).to_owned(), &wanted)
            };
            let groups: Vec<GroupAnswers> = conditions.iter().map(group).collect();
            let settings = ComparisonSettings {
                side: TestAlternative::TwoSided,
                choice: is_choice(question),
                alpha: SIGNIFICANCE_LEVEL,
                bound: SMALLEST_INTERESTING_DELTA,
                resampling,
            };
            let empty = groups.iter().all(|answered| answered.pooled_answers().is_empty());
            if !empty {
                let mut comparison = compare_answer_groups(question, &groups, &settings, false);
                comparison.part = (*part).to_owned();
                compared.push(comparison);
            }
        }
        for measure in measures {
            let measure_report = with_measure(plan, question, measure, people, resampling);
            // With fewer points, a correlation is high by chance.
            if measure_report.points.len() >= MIN_CORRELATION_TRIALS {
                compared.push(GroupComparison {
                    measure: Some(measure_report),
                    ..empty_comparison(question, TestAlternative::TwoSided)
                });
            }
        }
    }
    compared
}

fn is_choice(question: &StudyQuestion) -> bool {
    matches!(question.kind, QuestionKind::Choice { .. })
}

fn of_hypothesis(
    plan: &StudyPlan,
    question: &StudyQuestion,
    hypothesis: &StudyHypothesis,
    people: &[&StudyParticipant],
    resampling: &ResamplingSettings,
) -> GroupComparison {
    let bound = match hypothesis.expects {
        ExpectedResult::SameWithin(bound) => bound,
        ExpectedResult::Difference => SMALLEST_INTERESTING_DELTA,
    };
    let trend = matches!(hypothesis.compares, HypothesisComparison::Trend(_));
    let settings = ComparisonSettings {
        side: if trend {
            TestAlternative::Less
        } else {
            TestAlternative::TwoSided
        },
        choice: is_choice(question),
        alpha: hypothesis.alpha,
        bound,
        resampling,
    };
    let mut compared = match &hypothesis.compares {
        HypothesisComparison::Between(selections) | HypothesisComparison::Trend(selections) => {
            let group = |selection: &TrialSelection| {
                let wanted =
                    |answer: &StudyAnswer| selection.holds_trial(&answer.part, &answer.item, &answer.condition);
                GroupAnswers::collect_group_answers(
                    plan,
                    question,
                    people,
                    selection_label(selection, selections),
                    &wanted,
                )
            };
            let groups: Vec<GroupAnswers> = selections.iter().map(group).collect();
            GroupComparison {
                part: common_part(selections),
                ..compare_answer_groups(question, &groups, &settings, trend)
            }
        }
        HypothesisComparison::Measure(measure) => GroupComparison {
            measure: Some(with_measure(plan, question, measure, people, resampling)),
            ..empty_comparison(question, settings.side)
        },
    };
    let stated = StatedHypothesis {
        name: hypothesis.name.clone(),
        text: hypothesis.text.clone(),
        expects: hypothesis.expects,
        alpha: hypothesis.alpha,
    };
    compared.conclusion = Some(conclude_hypothesis(&compared, &stated, trend));
    compared.hypothesis = Some(stated);
    compared
}

/// Returns the words for one of several selections: its items, conditions and parts, as far as they differ from others.
fn selection_label(selection: &TrialSelection, all: &[TrialSelection]) -> String {
    let lists: [fn(&TrialSelection) -> &Vec<String>; 3] =
        [|other| &other.items, |other| &other.conditions, |other| &other.parts];
    let differs = |list: &&fn(&TrialSelection) -> &Vec<String>| {
        all.len() < 2 || all.iter().any(|other| list(other) != list(selection))
    };
    let differing_lists = lists.iter().filter(differs).map(|list| list(selection).join(" + "));
    let names: Vec<String> = differing_lists.filter(|text| !text.is_empty()).collect();
    if names.is_empty() {
        "*".to_owned()
    } else {
        names.join(", ")
    }
}

/// Returns the part of the study that all selections name.
fn common_part(selections: &[TrialSelection]) -> String {
    match selections {
        [first, rest @ ..] if rest.iter().all(|selection| selection.parts == first.parts) => first.parts.join(" + "),
        _ => String::new(),
    }
}

fn empty_comparison(question: &StudyQuestion, side: TestAlternative) -> GroupComparison {
    GroupComparison {
        hypothesis: None,
        question: question.name.clone(),
        part: String::new(),
        side,
        groups: Vec::new(),
        overall: None,
        pairs: Vec::new(),
        measure: None,
        conclusion: None,
    }
}

/// Compares groups with each other, or, of a trend, each with the next.
fn compare_answer_groups(
    question: &StudyQuestion,
    groups: &[GroupAnswers],
    settings: &ComparisonSettings,
    trend: bool,
) -> GroupComparison {
    let mut places = Vec::new();
    for i in 0..groups.len() {
        // A trend is about neighbours, and further pairs would only weaken the corrected tests.
        let last = if trend { (i + 2).min(groups.len()) } else { groups.len() };
        places.extend((i + 1..last).map(|j| [i, j]));
    }
    // Resampling very many pairs would take longer than anybody waits for a report.
    let resampled = places.len() <= MAX_RESAMPLED_PAIRS;
    let mut pairs: Vec<GroupPairComparison> = places
        .into_iter()
        .map(|[i, j]| compare_group_pair([i, j], [&groups[i], &groups[j]], settings, resampled))
        .collect();
    correct_test_p_values(pairs.iter_mut().map(|pair| &mut pair.pooled));
    correct_test_p_values(pairs.iter_mut().map(|pair| &mut pair.people));
    GroupComparison {
        groups: groups.iter().map(GroupAnswers::summary).collect(),
        overall: (groups.len() > 2).then(|| overall(groups)),
        pairs,
        ..empty_comparison(question, settings.side)
    }
}

/// Corrects the p of tests for their number.
fn correct_test_p_values<'a>(tests: impl Iterator<Item = &'a mut StatsOutcome<PairTest>>) {
    let test_iterator = tests.filter_map(|outcome| match outcome {
        StatsOutcome::Found(test) => Some(test),
        StatsOutcome::Nothing { .. } => None,
    });
    let found_tests: Vec<&mut PairTest> = test_iterator.collect();
    let corrected = holm_p_values(&found_tests.iter().map(|test| test.p).collect::<Vec<_>>());
    for (test, p) in found_tests.into_iter().zip(corrected) {
        test.p_holm = p;
    }
}

fn overall(groups: &[GroupAnswers]) -> OverallTests {
    let pooled_values: Vec<Vec<f64>> = groups.iter().map(GroupAnswers::pooled_answers).collect();
    let pooled: Vec<&[f64]> = pooled_values.iter().map(Vec::as_slice).collect();
    let pooled = kruskal_wallis(&pooled).map(|test| PooledAnswersTest {
        h: test.h,
        df: test.df,
        p: test.p,
        epsilon_squared: test.epsilon_squared,
    });
    let means: Vec<Vec<Option<f64>>> = groups.iter().map(GroupAnswers::participant_means).collect();
    let people = means.first().map_or(0, Vec::len);
    let row = |person: usize| means.iter().map(|group| group[person]).collect();
    // The test compares each person with themselves, so people who lack a group are left out.
    let rows: Vec<Vec<f64>> = (0..people).filter_map(row).collect();
    OverallTests {
        pooled: pooled.into(),
        people: friedman_test(&rows).into(),
    }
}

fn compare_group_pair(
    places: [usize; 2],
    groups: [&GroupAnswers; 2],
    settings: &ComparisonSettings,
    resampled: bool,
) -> GroupPairComparison {
    let [first, second] = groups.map(GroupAnswers::pooled_answers);
    let both = paired_participant_means(groups);
    let differences: Vec<f64> = both.iter().map(|[x, y]| rounded_mean_difference(*x, *y)).collect();
    let resamples = if resampled {
        resample_cliff_delta(groups, settings.resampling)
    } else {
        Err(UndefinedStatistic::TooMany)
    };
    let level = settings.resampling.level;
    let effect = GroupEffect::measure_group_effect(&first, &second).map(|effect| EffectReport {
        delta: effect.delta,
        size: effect.effect_size(),
        a12: effect.a12,
        shift: effect.shift,
        interval: resamples
            .as_ref()
            .map_err(|why| *why)
            .and_then(|samples| resampled_interval_ends(samples, level))
            .into(),
    });
    let sameness = resamples.and_then(|samples| test_group_sameness(&samples, settings));
    let mean = both.iter().map(|[x, y]| x - y).sum::<f64>() / both.len() as f64;
    GroupPairComparison {
        groups: places,
        pooled: pooled_test(&first, &second, settings).into(),
        effect: effect.into(),
        people: people_test(groups, &both, &differences, settings).into(),
        mean_difference: Some(mean).filter(|value| value.is_finite()),
        sameness: sameness.into(),
    }
}

/// Returns a difference without the rounding of means, so that equal differences are equal.
fn rounded_mean_difference(x: f64, y: f64) -> f64 {
    ((x - y) * 1e9).round() / 1e9
}

/// Returns the means of the participants who are in both groups.
fn paired_participant_means([first, second]: [&GroupAnswers; 2]) -> Vec<[f64; 2]> {
    let means = first.participant_means().into_iter().zip(second.participant_means());
    means.filter_map(|(x, y)| Some([x?, y?])).collect()
}

fn pooled_test(first: &[f64], second: &[f64], settings: &ComparisonSettings) -> Result<PairTest, UndefinedStatistic> {
    let n = [first.len(), second.len()];
    if settings.choice && settings.side == TestAlternative::TwoSided {
        let row = |values: &[f64]| {
            let right = values.iter().filter(|value| **value == 1.0).count() as u64;
            [right, values.len() as u64 - right]
        };
        let fisher_result = match fisher_exact_test([row(first), row(second)]) {
            // Nobody was right, or nobody was wrong.
            Err(UndefinedStatistic::Empty) if n.iter().all(|n| *n > 0) => Err(UndefinedStatistic::NoSpread),
            found => found,
        }?;
        return Ok(PairTest {
            test: TestName::Fisher,
            n,
            statistic: fisher_result.odds_ratio,
            method: PValueMethod::Exact,
            p: fisher_result.p,
            p_holm: fisher_result.p,
        });
    }
    let rank_test = mann_whitney(first, second, settings.side, None)?;
    Ok(of_mann_whitney(rank_test.n, rank_test.u, rank_test.method, rank_test.p))
}

fn of_mann_whitney(n: [usize; 2], u: f64, method: PValueMethod, p: f64) -> PairTest {
    PairTest {
        test: TestName::MannWhitney,
        n,
        statistic: Some(u),
        method,
        p,
        p_holm: p,
    }
}

/// Tests the means of people: those in both groups against themselves; without any, the people of the two groups.
fn people_test(
    groups: [&GroupAnswers; 2],
    both: &[[f64; 2]],
    differences: &[f64],
    settings: &ComparisonSettings,
) -> Result<PairTest, UndefinedStatistic> {
    if both.is_empty() {
        let means = groups.map(|answered| answered.participant_means().into_iter().flatten().collect::<Vec<f64>>());
        let rank_test = mann_whitney(&means[0], &means[1], settings.side, None)?;
        return Ok(of_mann_whitney(rank_test.n, rank_test.u, rank_test.method, rank_test.p));
    }
    let n = [both.len(); 2];
    // McNemar's test knows one answer of each person to each group only.
    let single = groups
        .iter()
        .all(|answered| answered.by_person.iter().all(|own| own.len() < 2));
    if settings.choice && single && settings.side == TestAlternative::TwoSided {
        let only = |own: usize| both.iter().filter(|pair| pair[own] > pair[1 - own]).count() as u64;
        let p = mcnemar_exact_test(only(0), only(1))?;
        return Ok(PairTest {
            test: TestName::Mcnemar,
            n,
            statistic: Some(only(0) as f64),
            method: PValueMethod::Exact,
            p,
            p_holm: p,
        });
    }
    let zero = vec![0.0; differences.len()];
    let signed_rank = wilcoxon_test(differences, &zero, ZeroTreatment::Wilcox, settings.side, None)?;
    Ok(PairTest {
        test: TestName::Wilcoxon,
        n,
        statistic: Some(signed_rank.plus),
        method: signed_rank.method,
        p: signed_rank.p,
        p_holm: signed_rank.p,
    })
}

/// Returns Cliff's delta of resampled participants.
fn resample_cliff_delta(
    groups: [&GroupAnswers; 2],
    settings: &ResamplingSettings,
) -> Result<ParticipantResamples, UndefinedStatistic> {
    let mut values = groups.map(GroupAnswers::pooled_answers).concat();
    values.sort_by(f64::total_cmp);
    // Answers have few different values, so counts of these are much faster than pairs of answers.
    values.dedup();
    let histogram = |own: &Vec<f64>| {
        let mut counts = vec![0.0; values.len()];
        for value in own {
            counts[values.partition_point(|other| other < value)] += 1.0;
        }
        counts
    };
    let by_person = groups.map(|answered| answered.by_person.iter().map(histogram).collect::<Vec<_>>());
    let answering: Vec<usize> = (0..by_person[0].len())
        .filter(|one| groups.iter().any(|answered| !answered.by_person[*one].is_empty()))
        .collect();
    let statistic = |drawn: &[usize]| {
        let mut sums = [vec![0.0; values.len()], vec![0.0; values.len()]];
        for one in drawn {
            for (sum, own) in sums.iter_mut().zip(&by_person) {
                for (sum, count) in sum.iter_mut().zip(&own[answering[*one]]) {
                    *sum += count;
                }
            }
        }
        delta_of(&sums[0], &sums[1])
    };
    ParticipantResamples::draw_participants(answering.len(), settings.times, settings.seed, statistic)
}

/// Returns Cliff's delta from the counts of each value, lowest first.
fn delta_of(first: &[f64], second: &[f64]) -> Result<f64, UndefinedStatistic> {
    let (n, m): (f64, f64) = (first.iter().sum(), second.iter().sum());
    if n == 0.0 || m == 0.0 {
        return Err(UndefinedStatistic::Empty);
    }
    let (mut balance, mut below) = (0.0, 0.0);
    for (x, y) in first.iter().zip(second) {
        balance += x * (2.0 * below + y - m);
        below += y;
    }
    Ok(balance / (n * m))
}

/// Returns the corrected interval; the plain one where the correction has no value.
fn resampled_interval_ends(
    resamples: &ParticipantResamples,
    level: f64,
) -> Result<ResampledInterval, UndefinedStatistic> {
    let of = |kind| {
        let [low, high] = resamples.resample_interval(kind, level)?;
        Ok(ResampledInterval { kind, level, low, high })
    };
    match of(ResampleIntervalRule::Bca) {
        // Without spread the correction is undefined, while the plain interval still is a point.
        Err(UndefinedStatistic::NoSpread) => of(ResampleIntervalRule::Percentile),
        found => found,
    }
}

/// Returns whether the groups are the same within the bound.
///
/// Nobody is called the same by fewer people than a sign test needs to be significant, or by resamples that are all
/// equal: these know nothing of the people who were not asked.
fn test_group_sameness(
    resamples: &ParticipantResamples,
    settings: &ComparisonSettings,
) -> Result<SamenessTest, UndefinedStatistic> {
    let ends = resampled_interval_ends(resamples, 1.0 - 2.0 * settings.alpha)?;
    let result = conclude_equivalence([ends.low, ends.high], settings.bound)?;
    if result == EquivalenceConclusion::Equivalent {
        let people = i32::try_from(resamples.jackknife.len()).unwrap_or(i32::MAX);
        // So few people could all agree by chance.
        if 0.5_f64.powi(people) > settings.alpha {
            return Err(UndefinedStatistic::TooFew);
        }
        if resamples.values.first() == resamples.values.last() {
            return Err(UndefinedStatistic::NoSpread);
        }
    }
    Ok(SamenessTest {
        bound: settings.bound,
        ends,
        result,
    })
}

fn with_measure(
    plan: &StudyPlan,
    question: &StudyQuestion,
    measure: &str,
    people: &[&StudyParticipant],
    resampling: &ResamplingSettings,
) -> MeasureReport {
    let mut points = Vec::new();
    let mut answers: Vec<GroupAnswers> = Vec::new();
    for trial in trials_of(plan, question) {
        let Some(value) = trial.measures.get(measure) else {
            continue;
        };
        let wanted = |answer: &StudyAnswer| {
            answer.part == trial.part && answer.item == trial.item && answer.condition == trial.condition
        };
        let name_fields = [&trial.item, &trial.condition, &trial.part];
        let names: Vec<&str> = name_fields
            .into_iter()
            .map(String::as_str)
            .filter(|name| !name.is_empty())
            .collect();
        let answered = GroupAnswers::collect_group_answers(plan, question, people, names.join(", "), &wanted);
        if let Ok(description) = GroupDescription::describe_values(&answered.pooled_answers()) {
            points.push(MeasurePoint {
                label: answered.label.clone(),
                measure: *value,
                mean: description.mean,
            });
            answers.push(answered);
        }
    }
    let values: Vec<f64> = points.iter().map(|point| point.measure).collect();
    let means: Vec<f64> = points.iter().map(|point| point.mean).collect();
    MeasureReport {
        measure: measure.to_owned(),
        spearman: spearman_correlation(&values, &means).into(),
        kendall: kendall_tau(&values, &means).into(),
        interval: correlation_interval(&values, &answers, resampling).into(),
        points,
    }
}

fn correlation_interval(
    values: &[f64],
    answers: &[GroupAnswers],
    settings: &ResamplingSettings,
) -> Result<ResampledInterval, UndefinedStatistic> {
    let people = answers.first().map_or(0, |answered| answered.by_person.len());
    let sums = people.saturating_mul(answers.len()).saturating_mul(settings.times);
    // A study of many people and trials would otherwise block the program for minutes.
    if sums > MOST_SUMS {
        return Err(UndefinedStatistic::TooMany);
    }
    let total = |own: &Vec<f64>| (own.iter().sum::<f64>(), own.len() as f64);
    let totals: Vec<Vec<(f64, f64)>> = answers
        .iter()
        .map(|answered| answered.by_person.iter().map(total).collect())
        .collect();
    let statistic = |drawn: &[usize]| {
        let (mut own, mut means) = (Vec::new(), Vec::new());
        for (value, by_person) in values.iter().zip(&totals) {
            let (sum, n) = drawn.iter().fold((0.0, 0.0), |(sum, n), one| {
                (sum + by_person[*one].0, n + by_person[*one].1)
            });
            // A trial that none of the drawn people answered has no mean.
            if n > 0.0 {
                own.push(*value);
                means.push(sum / n);
            }
        }
        spearman_correlation(&own, &means).map(|result| result.coefficient)
    };
    resampled_interval_ends(
        &ParticipantResamples::draw_participants(people, settings.times, settings.seed, statistic)?,
        settings.level,
    )
}
