//! The comparisons on the page: tests, effects, sameness and correlations.

use std::fmt::Display;

use chereme_analysis::statistics::{TestAlternative, UndefinedStatistic};

use super::ReportPage;
use crate::study::report::charts;
use crate::study::report::report_compare::{SIGNIFICANCE_LEVEL, SMALLEST_INTERESTING_DELTA};
use crate::study::report::report_numbers::{self, format_report_number};
use crate::study::report::report_words as w;
use crate::study::report::{
    GroupComparison, GroupPairComparison, MeasureReport, PairTest, ResampledInterval, StatsOutcome, TestName,
};
use crate::study::study_plan::{ExpectedResult, QuestionKind};
use crate::words::fill_text_braces;

impl ReportPage<'_> {
    /// Returns the numbers that a conclusion rests on: effects with intervals and the p of people's means.
    pub(super) fn key_numbers(&self, compared: &GroupComparison) -> String {
        let number = |value: f64| format_report_number(value, 3, self.language);
        let p = |p: f64| self.equals_p(p);
        let ends = |interval: &ResampledInterval| self.unbroken_interval(interval);
        if let Some(measure) = &compared.measure {
            let spearman = measure.spearman.found_result();
            let rho = spearman.map(|correlation| {
                (
                    number(correlation.coefficient),
                    correlation.p.map_or_else(String::new, p),
                )
            });
            let Some((rho, p)) = rho else {
                return String::new();
            };
            let ends = measure.interval.found_result().map_or_else(String::new, ends);
            return format!("rho {rho} {ends} · {p} · n\u{a0}=\u{a0}{}", measure.points.len());
        }
        if let Some(overall) = &compared.overall {
            let friedman = overall.people.found_result();
            return friedman.map_or_else(String::new, |test| {
                format!(
                    "Friedman {} · W {} · n\u{a0}=\u{a0}{}",
                    p(test.p),
                    number(test.w),
                    test.n
                )
            });
        }
        let expects = compared.hypothesis.as_ref().map(|hypothesis| hypothesis.expects);
        let same = matches!(expects, Some(ExpectedResult::SameWithin(_)));
        let pair = |pair: &GroupPairComparison| {
            let effect = pair.effect.found_result()?;
            // The interval by which sameness is decided has its own level.
            let interval = match (same, pair.sameness.found_result()) {
                (true, Some(it)) => format!(
                    "{} ({})",
                    ends(&it.ends),
                    report_numbers::format_level(it.ends.level, self.language)
                ),
                _ => effect.interval.found_result().map_or_else(String::new, ends),
            };
            let test = pair.people.found_result().map_or_else(String::new, |result| {
                let name = self.say_page_text(w::test_name_text(result.test));
                format!(" · {name} {} · n\u{a0}=\u{a0}{}", p(result.p), result.n[0])
            });
            Some(format!("delta {} {interval}{test}", number(effect.delta)))
        };
        let pairs: Vec<String> = compared.pairs.iter().filter_map(pair).collect();
        pairs.join("; ")
    }

    /// Returns an interval without a break inside.
    fn unbroken_interval(&self, ends: &ResampledInterval) -> String {
        let [low, high] = [ends.low, ends.high].map(|end| format_report_number(end, 3, self.language));
        format!("[{low};\u{a0}{high}]")
    }

    /// Returns `p = 0.012` or `p < 0.0001`, without a break inside.
    fn equals_p(&self, p: f64) -> String {
        let text = report_numbers::format_p_value(p, self.language).replace(' ', "\u{a0}");
        if text.starts_with('<') {
            format!("p\u{a0}{text}")
        } else {
            format!("p\u{a0}=\u{a0}{text}")
        }
    }

    pub(super) fn put_comparisons_section(&mut self) {
        self.put_page_heading(2, self.say_page_text(w::COMPARISONS));
        for compared in &self.report.comparisons {
            let title = match &compared.hypothesis {
                Some(stated) => {
                    let text = self.localized_text_or_name(&stated.text, "");
                    if text.is_empty() {
                        stated.name.clone()
                    } else {
                        fill_text_braces(
                            self.say_page_text(w::PAIR_OF_TEXTS),
                            &[("a", &stated.name), ("b", &text)],
                        )
                    }
                }
                None => {
                    let name_parts = [compared.question.as_str(), &compared.part];
                    let names: Vec<&str> = name_parts.into_iter().filter(|name| !name.is_empty()).collect();
                    let names = names.join(", ");
                    let measure = compared.measure.as_ref().map_or("", |report| &report.measure);
                    let form = if measure.is_empty() {
                        w::ALL_PAIRS
                    } else {
                        w::WITH_MEASURE
                    };
                    fill_text_braces(self.say_page_text(form), &[("question", &names), ("measure", &measure)])
                }
            };
            self.put_page_heading(3, &title);
            self.put_group_comparison(compared);
        }
    }

    fn put_group_comparison(&mut self, compared: &GroupComparison) {
        if let Some(measure) = &compared.measure {
            self.put_measure_correlation(measure, &compared.question);
            return;
        }
        let side = if compared.is_one_sided() {
            w::ONE_SIDED
        } else {
            w::TWO_SIDED
        };
        self.paragraph("soft", self.say_page_text(side));
        self.group_table(compared);
        if let Some(overall) = &compared.overall {
            let p = |found: Result<f64, UndefinedStatistic>| match found {
                Ok(p) => self.equals_p(p),
                Err(why) => self.missing_value_sentence(why),
            };
            let pooled = p(overall.pooled.result().map(|test| test.p));
            let people = p(overall.people.result().map(|test| test.p));
            let words = fill_text_braces(
                self.say_page_text(w::OVERALL),
                &[("pooled", &pooled), ("people", &people)],
            );
            self.paragraph("", &words);
        }
        self.put_pair_comparisons(compared);
    }

    fn group_table(&mut self, compared: &GroupComparison) {
        let question = self
            .report
            .questions
            .iter()
            .find(|question| question.name == compared.question);
        let choice = question.is_some_and(|question| matches!(question.kind, QuestionKind::Choice { .. }));
        let number = |value: f64, decimals| format_report_number(value, decimals, self.language);
        let rows = compared.groups.iter().map(|group| {
            let mut row = vec![group.label.clone(), group.people.to_string()];
            match &group.description {
                StatsOutcome::Found(own) if choice => {
                    row.extend([own.n.to_string(), number(100.0 * own.mean, 1)]);
                }
                StatsOutcome::Found(own) => row.extend([
                    own.n.to_string(),
                    number(own.mean, 3),
                    own.sd.map_or_else(String::new, |sd| number(sd, 3)),
                    number(own.median, 1),
                ]),
                StatsOutcome::Nothing { why } => {
                    row.push(self.say_page_text(w::undefined_reason_words(*why)).to_owned())
                }
            }
            row
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let mut titles = vec![w::GROUP, w::PERSONS, w::ANSWERS];
        if choice {
            titles.push(w::RIGHT_SHARE);
        } else {
            titles.extend([w::MEAN, w::SD, w::MEDIAN]);
        }
        let titles: Vec<&str> = titles.into_iter().map(|phrase| self.say_page_text(phrase)).collect();
        self.put_page_table(&titles, &rows);
    }

    fn missing_value_sentence(&self, why: UndefinedStatistic) -> String {
        let why = self.say_page_text(w::undefined_reason_words(why));
        fill_text_braces(self.say_page_text(w::NONE_BECAUSE), &[("why", &why)])
    }

    fn put_pair_comparisons(&mut self, compared: &GroupComparison) {
        let name =
            |pair: &GroupPairComparison| pair.groups.map(|at| compared.groups[at].label.clone()).join("\u{a0}− ");
        let rows: Vec<(String, f64, Option<ResampledInterval>)> = compared
            .pairs
            .iter()
            .filter_map(|pair| {
                let effect = pair.effect.found_result()?;
                Some((name(pair), effect.delta, effect.interval.found_result().copied()))
            })
            .collect();
        let bound = compared.smallest_interesting_bound();
        if !rows.is_empty() {
            let figure = charts::effect_interval_chart(&rows, bound, self.language);
            let resampling = &self.report.resampling;
            let (level, bound) = (
                report_numbers::format_level(resampling.level, self.language),
                format_report_number(bound, 3, self.language),
            );
            let values: [(&str, &dyn Display); 3] =
                [("level", &level), ("times", &resampling.times), ("bound", &bound)];
            let note = fill_text_braces(self.say_page_text(w::EFFECTS_NOTE), &values);
            self.put_page_figure(&figure, &note);
        }
        let several = compared.pairs.len() > 1;
        let rows: Vec<Vec<String>> = compared
            .pairs
            .iter()
            .map(|pair| self.pair_row(pair, name(pair), several))
            .collect();
        let bound = format_report_number(bound, 3, self.language);
        let sameness = fill_text_braces(self.say_page_text(w::SAMENESS), &[("bound", &bound)]);
        let mut titles = vec![self.say_page_text(w::PAIR)];
        for title in [w::POOLED, w::BY_PERSON] {
            titles.push(self.say_page_text(title));
            titles.extend(several.then(|| self.say_page_text(w::P_HOLM)));
        }
        titles.extend([w::DIFFERENCE, w::SIZE].map(|phrase| self.say_page_text(phrase)));
        titles.push(&sameness);
        self.put_page_table(&titles, &rows);
        let alpha = compared
            .hypothesis
            .as_ref()
            .map_or(SIGNIFICANCE_LEVEL, |hypothesis| hypothesis.alpha);
        for pair in &compared.pairs {
            if let (Some(pooled), Some(people)) = (pair.pooled.found_result(), pair.people.found_result())
                && (pooled.p_holm < alpha) != (people.p_holm < alpha)
            {
                let n = pooled.n[0] + pooled.n[1];
                let words = fill_text_braces(self.say_page_text(w::DISAGREE), &[("n", &n)]);
                let values: [(&str, &dyn Display); 2] = [("a", &name(pair)), ("b", &words)];
                let words = fill_text_braces(self.say_page_text(w::PAIR_OF_TEXTS), &values);
                self.paragraph("soft", &words);
            }
        }
    }

    /// Returns the row of a pair; p corrected for their number have a column if there are `several` pairs.
    fn pair_row(&self, pair: &GroupPairComparison, name: String, several: bool) -> Vec<String> {
        let mut row = vec![name];
        for test in [&pair.pooled, &pair.people] {
            let (text, holm) = match test.result() {
                Ok(it) => (
                    self.test_with_numbers(it),
                    report_numbers::format_p_value(it.p_holm, self.language).replace(' ', "\u{a0}"),
                ),
                Err(why) => (self.missing_value_sentence(why), String::new()),
            };
            row.push(text);
            row.extend(several.then_some(holm));
        }
        let difference = pair.mean_difference;
        row.push(difference.map_or_else(String::new, |value| format_report_number(value, 3, self.language)));
        let effect = pair.effect.found_result();
        row.push(
            effect
                .map_or("", |report| self.say_page_text(w::effect_size_words(report.size)))
                .to_owned(),
        );
        row.push(match pair.sameness.result() {
            Ok(it) => format!(
                "{} {}",
                self.say_page_text(w::sameness_words(it.result)),
                self.unbroken_interval(&it.ends)
            ),
            Err(why) => self.missing_value_sentence(why),
        });
        row
    }

    /// Returns a test with its numbers: `Wilcoxon, W+ = 812.5, n = 57, p = 0.031, exact`.
    fn test_with_numbers(&self, test: &PairTest) -> String {
        let statistic = test.statistic.map_or_else(String::new, |value| {
            let fraction_digits = if (2.0 * value).fract() == 0.0 { 1 } else { 2 };
            let decimals = if value.fract() == 0.0 { 0 } else { fraction_digits };
            let symbol = self.say_page_text(w::test_statistic_name(test.test));
            format!("{symbol} = {}, ", format_report_number(value, decimals, self.language)).replace(' ', "\u{a0}")
        });
        let statistic = statistic.replace(",\u{a0}", ", ");
        let [n, m] = test.n;
        let n = match test.test {
            TestName::Wilcoxon | TestName::Mcnemar => n.to_string(),
            TestName::MannWhitney | TestName::Fisher => format!("{n}\u{a0}+\u{a0}{m}"),
        };
        let name = self.say_page_text(w::test_name_text(test.test));
        let method = self.say_page_text(w::p_method_words(test.method));
        format!(
            "{name}, {statistic}n\u{a0}=\u{a0}{n}, {}, {method}",
            self.equals_p(test.p)
        )
    }

    fn put_measure_correlation(&mut self, measure: &MeasureReport, question: &str) {
        let figure = charts::correlation_chart(&measure.points, [&measure.measure, question], self.language);
        let coefficient = |found: Result<f64, UndefinedStatistic>| match found {
            Ok(it) => format_report_number(it, 3, self.language),
            Err(why) => self.missing_value_sentence(why),
        };
        let rho = coefficient(measure.spearman.result().map(|result| result.coefficient));
        let tau = coefficient(measure.kendall.result().map(|result| result.coefficient));
        let p_value = measure.spearman.found_result().and_then(|result| result.p);
        let p = p_value.map_or_else(|| "p –".to_owned(), |p| self.equals_p(p));
        let interval = match measure.interval.result() {
            Ok(it) => self.unbroken_interval(it),
            Err(why) => self.missing_value_sentence(why),
        };
        let n = measure.points.len();
        let values: [(&str, &dyn Display); 6] = [
            ("measure", &measure.measure),
            ("n", &n),
            ("rho", &rho),
            ("p", &p),
            ("interval", &interval),
            ("tau", &tau),
        ];
        let note = fill_text_braces(self.say_page_text(w::MEASURE), &values);
        if measure.points.is_empty() {
            self.paragraph("", &note);
        } else {
            self.put_page_figure(&figure, &note);
        }
    }
}

impl GroupComparison {
    /// Returns whether its tests look in one direction only.
    #[must_use]
    pub fn is_one_sided(&self) -> bool {
        self.side != TestAlternative::TwoSided
    }

    /// Returns the smallest difference of interest, as Cliff's delta.
    #[must_use]
    pub fn smallest_interesting_bound(&self) -> f64 {
        match self.hypothesis.as_ref().map(|hypothesis| hypothesis.expects) {
            Some(ExpectedResult::SameWithin(bound)) => bound,
            _ => SMALLEST_INTERESTING_DELTA,
        }
    }
}
