//! Comparisons of groups of trials: tests of all answers and of people's means, effects, intervals and sameness.

use std::collections::BTreeSet;

use chereme_analysis::statistics::{
    Alternative, Description, Effect, Equivalence, Interval, Method, Resamples, Undefined, Zeros,
    equivalence, fisher, friedman, holm, kendall, kruskal_wallis, mann_whitney, mcnemar, spearman,
    wilcoxon,
};

use super::conclude::conclude;
use super::groups::{main_answers, number, trials_of};
use super::{
    Compared, EffectReport, Ends, GroupSummary, MeasurePoint, MeasureReport, Outcome, Overall,
    Pair, PairTest, Pooled, Resampling, Sameness, Stated, TestName,
};
use crate::study::answers::{Answer, Participant};
use crate::study::plan::{
    Comparison, Expectation, Hypothesis, Plan, Question, QuestionKind, Selection,
};

/// The smallest difference of interest if the plan states none, as Cliff's delta: below it an effect is negligible.
pub(super) const SMALLEST: f64 = 0.147;
/// The level of significance of comparisons that no hypothesis asks for.
pub(super) const ALPHA: f64 = 0.05;
/// The most pairs of groups for which participants are resampled.
const MOST_PAIRS: usize = 200;
/// The fewest trials for which a correlation is shown that no hypothesis asks for.
const FEWEST: usize = 4;
/// The most sums that the resampling of one correlation may take.
const MOST_SUMS: usize = 5_000_000_000;

/// The answers of one group: the values of each participant, by the participant's place.
struct Answered {
    label: String,
    by_person: Vec<Vec<f64>>,
}

impl Answered {
    fn of(
        plan: &Plan,
        question: &Question,
        people: &[&Participant],
        label: String,
        wanted: &dyn Fn(&Answer) -> bool,
    ) -> Self {
        let own = |one: &&Participant| {
            let answers = main_answers(one, &question.name).filter(|it| wanted(it));
            answers
                .filter_map(|it| number(plan, question, it))
                .collect()
        };
        Self {
            label,
            by_person: people.iter().map(own).collect(),
        }
    }

    fn pooled(&self) -> Vec<f64> {
        self.by_person.concat()
    }

    /// Returns the mean of each participant; none without an answer.
    fn means(&self) -> Vec<Option<f64>> {
        let mean =
            |it: &Vec<f64>| (!it.is_empty()).then(|| it.iter().sum::<f64>() / it.len() as f64);
        self.by_person.iter().map(mean).collect()
    }

    fn summary(&self) -> GroupSummary {
        GroupSummary {
            label: self.label.clone(),
            people: self.by_person.iter().filter(|it| !it.is_empty()).count(),
            description: Description::of(&self.pooled()).into(),
        }
    }
}

/// The settings of the tests of one comparison.
struct Settings<'a> {
    side: Alternative,
    /// Whether values are right and wrong answers.
    choice: bool,
    alpha: f64,
    bound: f64,
    resampling: &'a Resampling,
}

/// Returns the comparisons of the hypotheses; without any, all pairs of conditions of each question and part, and its
/// correlation with each measure.
pub(super) fn all(plan: &Plan, people: &[&Participant], resampling: &Resampling) -> Vec<Compared> {
    if !plan.hypotheses.is_empty() {
        let known = plan.hypotheses.iter().filter_map(|it| {
            let question = plan.question(&it.question)?;
            Some(of_hypothesis(plan, question, it, people, resampling))
        });
        return known.collect();
    }
    let mut compared = Vec::new();
    for question in &plan.questions {
        let trials = trials_of(plan, question);
        let measures = trials.iter().flat_map(|it| it.measures.keys());
        let measures: BTreeSet<&String> = measures.collect();
        let mut parts: Vec<(&str, Vec<&str>)> = Vec::new();
        for trial in trials {
            let place = parts.iter().position(|it| it.0 == trial.part);
            let at = place.unwrap_or_else(|| {
                parts.push((&trial.part, Vec::new()));
                parts.len() - 1
            });
            if !parts[at].1.contains(&trial.condition.as_str()) {
                parts[at].1.push(&trial.condition);
            }
        }
        for (part, conditions) in parts.iter().filter(|it| it.1.len() > 1) {
            let group = |condition: &&str| {
                let wanted = |it: &Answer| it.part == *part && it.condition == *condition;
                Answered::of(plan, question, people, (*condition).to_owned(), &wanted)
            };
            let groups: Vec<Answered> = conditions.iter().map(group).collect();
            let settings = Settings {
                side: Alternative::TwoSided,
                choice: is_choice(question),
                alpha: ALPHA,
                bound: SMALLEST,
                resampling,
            };
            let empty = groups.iter().all(|it| it.pooled().is_empty());
            if !empty {
                let mut own = between(question, &groups, &settings, false);
                own.part = (*part).to_owned();
                compared.push(own);
            }
        }
        for measure in measures {
            let own = with_measure(plan, question, measure, people, resampling);
            if own.points.len() >= FEWEST {
                compared.push(Compared {
                    measure: Some(own),
                    ..empty(question, Alternative::TwoSided)
                });
            }
        }
    }
    compared
}

fn is_choice(question: &Question) -> bool {
    matches!(question.kind, QuestionKind::Choice { .. })
}

fn of_hypothesis(
    plan: &Plan,
    question: &Question,
    hypothesis: &Hypothesis,
    people: &[&Participant],
    resampling: &Resampling,
) -> Compared {
    let bound = match hypothesis.expects {
        Expectation::SameWithin(bound) => bound,
        Expectation::Difference => SMALLEST,
    };
    let trend = matches!(hypothesis.compares, Comparison::Trend(_));
    let settings = Settings {
        side: if trend {
            Alternative::Less
        } else {
            Alternative::TwoSided
        },
        choice: is_choice(question),
        alpha: hypothesis.alpha,
        bound,
        resampling,
    };
    let mut compared = match &hypothesis.compares {
        Comparison::Between(selections) | Comparison::Trend(selections) => {
            let group = |selection: &Selection| {
                let wanted = |it: &Answer| selection.holds(&it.part, &it.item, &it.condition);
                Answered::of(
                    plan,
                    question,
                    people,
                    label(selection, selections),
                    &wanted,
                )
            };
            let groups: Vec<Answered> = selections.iter().map(group).collect();
            Compared {
                part: common_part(selections),
                ..between(question, &groups, &settings, trend)
            }
        }
        Comparison::Measure(measure) => Compared {
            measure: Some(with_measure(plan, question, measure, people, resampling)),
            ..empty(question, settings.side)
        },
    };
    let stated = Stated {
        name: hypothesis.name.clone(),
        text: hypothesis.text.clone(),
        expects: hypothesis.expects,
        alpha: hypothesis.alpha,
    };
    compared.conclusion = Some(conclude(&compared, &stated, trend));
    compared.hypothesis = Some(stated);
    compared
}

/// Returns the words for one of several selections: its items, conditions and parts, as far as they differ from others.
fn label(selection: &Selection, all: &[Selection]) -> String {
    let lists: [fn(&Selection) -> &Vec<String>; 3] =
        [|it| &it.items, |it| &it.conditions, |it| &it.parts];
    let differs = |list: &&fn(&Selection) -> &Vec<String>| {
        all.len() < 2 || all.iter().any(|it| list(it) != list(selection))
    };
    let own = lists
        .iter()
        .filter(differs)
        .map(|list| list(selection).join(" + "));
    let own: Vec<String> = own.filter(|it| !it.is_empty()).collect();
    if own.is_empty() {
        "*".to_owned()
    } else {
        own.join(", ")
    }
}

/// Returns the part of the study that all selections name.
fn common_part(selections: &[Selection]) -> String {
    match selections {
        [first, rest @ ..] if rest.iter().all(|it| it.parts == first.parts) => {
            first.parts.join(" + ")
        }
        _ => String::new(),
    }
}

fn empty(question: &Question, side: Alternative) -> Compared {
    Compared {
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
fn between(question: &Question, groups: &[Answered], settings: &Settings, trend: bool) -> Compared {
    let mut places = Vec::new();
    for i in 0..groups.len() {
        let last = if trend {
            (i + 2).min(groups.len())
        } else {
            groups.len()
        };
        places.extend((i + 1..last).map(|j| [i, j]));
    }
    let resampled = places.len() <= MOST_PAIRS;
    let mut pairs: Vec<Pair> = places
        .into_iter()
        .map(|[i, j]| pair([i, j], [&groups[i], &groups[j]], settings, resampled))
        .collect();
    correct(pairs.iter_mut().map(|it| &mut it.pooled));
    correct(pairs.iter_mut().map(|it| &mut it.people));
    Compared {
        groups: groups.iter().map(Answered::summary).collect(),
        overall: (groups.len() > 2).then(|| overall(groups)),
        pairs,
        ..empty(question, settings.side)
    }
}

/// Corrects the p of tests for their number.
fn correct<'a>(tests: impl Iterator<Item = &'a mut Outcome<PairTest>>) {
    let found = tests.filter_map(|it| match it {
        Outcome::Found(test) => Some(test),
        Outcome::Nothing { .. } => None,
    });
    let found: Vec<&mut PairTest> = found.collect();
    let corrected = holm(&found.iter().map(|it| it.p).collect::<Vec<_>>());
    for (test, p) in found.into_iter().zip(corrected) {
        test.p_holm = p;
    }
}

fn overall(groups: &[Answered]) -> Overall {
    let pooled: Vec<Vec<f64>> = groups.iter().map(Answered::pooled).collect();
    let pooled: Vec<&[f64]> = pooled.iter().map(Vec::as_slice).collect();
    let pooled = kruskal_wallis(&pooled).map(|it| Pooled {
        h: it.h,
        df: it.df,
        p: it.p,
        epsilon_squared: it.epsilon_squared,
    });
    let means: Vec<Vec<Option<f64>>> = groups.iter().map(Answered::means).collect();
    let people = means.first().map_or(0, Vec::len);
    let row = |person: usize| means.iter().map(|group| group[person]).collect();
    let rows: Vec<Vec<f64>> = (0..people).filter_map(row).collect();
    Overall {
        pooled: pooled.into(),
        people: friedman(&rows).into(),
    }
}

fn pair(places: [usize; 2], groups: [&Answered; 2], settings: &Settings, resampled: bool) -> Pair {
    let [first, second] = groups.map(Answered::pooled);
    let both = paired(groups);
    let differences: Vec<f64> = both.iter().map(|[x, y]| difference(*x, *y)).collect();
    let resamples = if resampled {
        resample(groups, settings.resampling)
    } else {
        Err(Undefined::TooMany)
    };
    let level = settings.resampling.level;
    let effect = Effect::of(&first, &second).map(|it| EffectReport {
        delta: it.delta,
        size: it.size(),
        a12: it.a12,
        shift: it.shift,
        interval: resamples
            .as_ref()
            .map_err(|why| *why)
            .and_then(|it| ends(it, level))
            .into(),
    });
    let sameness = resamples.and_then(|it| sameness(&it, settings));
    let mean = both.iter().map(|[x, y]| x - y).sum::<f64>() / both.len() as f64;
    Pair {
        groups: places,
        pooled: pooled_test(&first, &second, settings).into(),
        effect: effect.into(),
        people: people_test(groups, &both, &differences, settings).into(),
        mean_difference: Some(mean).filter(|it| it.is_finite()),
        sameness: sameness.into(),
    }
}

/// Returns a difference without the rounding of means, so that equal differences are equal.
fn difference(x: f64, y: f64) -> f64 {
    ((x - y) * 1e9).round() / 1e9
}

/// Returns the means of the participants who are in both groups.
fn paired([first, second]: [&Answered; 2]) -> Vec<[f64; 2]> {
    let means = first.means().into_iter().zip(second.means());
    means.filter_map(|(x, y)| Some([x?, y?])).collect()
}

fn pooled_test(first: &[f64], second: &[f64], settings: &Settings) -> Result<PairTest, Undefined> {
    let n = [first.len(), second.len()];
    if settings.choice && settings.side == Alternative::TwoSided {
        let row = |values: &[f64]| {
            let right = values.iter().filter(|it| **it == 1.0).count() as u64;
            [right, values.len() as u64 - right]
        };
        let found = match fisher([row(first), row(second)]) {
            // Nobody was right, or nobody was wrong.
            Err(Undefined::Empty) if n.iter().all(|n| *n > 0) => Err(Undefined::NoSpread),
            found => found,
        }?;
        return Ok(PairTest {
            test: TestName::Fisher,
            n,
            statistic: found.odds_ratio,
            method: Method::Exact,
            p: found.p,
            p_holm: found.p,
        });
    }
    let found = mann_whitney(first, second, settings.side, None)?;
    Ok(of_mann_whitney(found.n, found.u, found.method, found.p))
}

fn of_mann_whitney(n: [usize; 2], u: f64, method: Method, p: f64) -> PairTest {
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
    groups: [&Answered; 2],
    both: &[[f64; 2]],
    differences: &[f64],
    settings: &Settings,
) -> Result<PairTest, Undefined> {
    if both.is_empty() {
        let means = groups.map(|it| it.means().into_iter().flatten().collect::<Vec<f64>>());
        let found = mann_whitney(&means[0], &means[1], settings.side, None)?;
        return Ok(of_mann_whitney(found.n, found.u, found.method, found.p));
    }
    let n = [both.len(); 2];
    let single = groups
        .iter()
        .all(|it| it.by_person.iter().all(|own| own.len() < 2));
    if settings.choice && single && settings.side == Alternative::TwoSided {
        let only = |own: usize| both.iter().filter(|it| it[own] > it[1 - own]).count() as u64;
        let p = mcnemar(only(0), only(1))?;
        return Ok(PairTest {
            test: TestName::Mcnemar,
            n,
            statistic: Some(only(0) as f64),
            method: Method::Exact,
            p,
            p_holm: p,
        });
    }
    let zero = vec![0.0; differences.len()];
    let found = wilcoxon(differences, &zero, Zeros::Wilcox, settings.side, None)?;
    Ok(PairTest {
        test: TestName::Wilcoxon,
        n,
        statistic: Some(found.plus),
        method: found.method,
        p: found.p,
        p_holm: found.p,
    })
}

/// Returns Cliff's delta of resampled participants.
fn resample(groups: [&Answered; 2], settings: &Resampling) -> Result<Resamples, Undefined> {
    let mut values = groups.map(Answered::pooled).concat();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let histogram = |own: &Vec<f64>| {
        let mut counts = vec![0.0; values.len()];
        for value in own {
            counts[values.partition_point(|it| it < value)] += 1.0;
        }
        counts
    };
    let by_person = groups.map(|it| it.by_person.iter().map(histogram).collect::<Vec<_>>());
    let answering: Vec<usize> = (0..by_person[0].len())
        .filter(|one| groups.iter().any(|it| !it.by_person[*one].is_empty()))
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
    Resamples::draw(answering.len(), settings.times, settings.seed, statistic)
}

/// Returns Cliff's delta from the counts of each value, lowest first.
fn delta_of(first: &[f64], second: &[f64]) -> Result<f64, Undefined> {
    let (n, m): (f64, f64) = (first.iter().sum(), second.iter().sum());
    if n == 0.0 || m == 0.0 {
        return Err(Undefined::Empty);
    }
    let (mut balance, mut below) = (0.0, 0.0);
    for (x, y) in first.iter().zip(second) {
        balance += x * (2.0 * below + y - m);
        below += y;
    }
    Ok(balance / (n * m))
}

/// Returns the corrected interval; the plain one where the correction has no value.
fn ends(resamples: &Resamples, level: f64) -> Result<Ends, Undefined> {
    let of = |kind| {
        let [low, high] = resamples.interval(kind, level)?;
        Ok(Ends {
            kind,
            level,
            low,
            high,
        })
    };
    match of(Interval::Bca) {
        Err(Undefined::NoSpread) => of(Interval::Percentile),
        found => found,
    }
}

/// Returns whether the groups are the same within the bound.
///
/// Nobody is called the same by fewer people than a sign test needs to be significant, or by resamples that are all
/// equal: these know nothing of the people who were not asked.
fn sameness(resamples: &Resamples, settings: &Settings) -> Result<Sameness, Undefined> {
    let ends = ends(resamples, 1.0 - 2.0 * settings.alpha)?;
    let result = equivalence([ends.low, ends.high], settings.bound)?;
    if result == Equivalence::Equivalent {
        let people = i32::try_from(resamples.jackknife.len()).unwrap_or(i32::MAX);
        if 0.5_f64.powi(people) > settings.alpha {
            return Err(Undefined::TooFew);
        }
        if resamples.values.first() == resamples.values.last() {
            return Err(Undefined::NoSpread);
        }
    }
    Ok(Sameness {
        bound: settings.bound,
        ends,
        result,
    })
}

fn with_measure(
    plan: &Plan,
    question: &Question,
    measure: &str,
    people: &[&Participant],
    resampling: &Resampling,
) -> MeasureReport {
    let mut points = Vec::new();
    let mut answers: Vec<Answered> = Vec::new();
    for trial in trials_of(plan, question) {
        let Some(value) = trial.measures.get(measure) else {
            continue;
        };
        let wanted = |it: &Answer| {
            it.part == trial.part && it.item == trial.item && it.condition == trial.condition
        };
        let names = [&trial.item, &trial.condition, &trial.part];
        let names: Vec<&str> = names
            .into_iter()
            .map(String::as_str)
            .filter(|it| !it.is_empty())
            .collect();
        let own = Answered::of(plan, question, people, names.join(", "), &wanted);
        if let Ok(description) = Description::of(&own.pooled()) {
            points.push(MeasurePoint {
                label: own.label.clone(),
                measure: *value,
                mean: description.mean,
            });
            answers.push(own);
        }
    }
    let values: Vec<f64> = points.iter().map(|it| it.measure).collect();
    let means: Vec<f64> = points.iter().map(|it| it.mean).collect();
    MeasureReport {
        measure: measure.to_owned(),
        spearman: spearman(&values, &means).into(),
        kendall: kendall(&values, &means).into(),
        interval: correlation_interval(&values, &answers, resampling).into(),
        points,
    }
}

fn correlation_interval(
    values: &[f64],
    answers: &[Answered],
    settings: &Resampling,
) -> Result<Ends, Undefined> {
    let people = answers.first().map_or(0, |it| it.by_person.len());
    let sums = people
        .saturating_mul(answers.len())
        .saturating_mul(settings.times);
    if sums > MOST_SUMS {
        return Err(Undefined::TooMany);
    }
    let total = |own: &Vec<f64>| (own.iter().sum::<f64>(), own.len() as f64);
    let totals: Vec<Vec<(f64, f64)>> = answers
        .iter()
        .map(|it| it.by_person.iter().map(total).collect())
        .collect();
    let statistic = |drawn: &[usize]| {
        let (mut own, mut means) = (Vec::new(), Vec::new());
        for (value, by_person) in values.iter().zip(&totals) {
            let (sum, n) = drawn.iter().fold((0.0, 0.0), |(sum, n), one| {
                (sum + by_person[*one].0, n + by_person[*one].1)
            });
            if n > 0.0 {
                own.push(*value);
                means.push(sum / n);
            }
        }
        spearman(&own, &means).map(|it| it.coefficient)
    };
    ends(
        &Resamples::draw(people, settings.times, settings.seed, statistic)?,
        settings.level,
    )
}
