//! The comparisons on the page: tests, effects, sameness and correlations.

use std::fmt::Display;

use chereme_analysis::statistics::{Alternative, Undefined};

use super::Page;
use crate::study::plan::{Expectation, QuestionKind};
use crate::study::report::charts;
use crate::study::report::compare::{ALPHA, SMALLEST};
use crate::study::report::numbers::{self, number};
use crate::study::report::{Compared, Ends, MeasureReport, Outcome, Pair, PairTest, TestName};
use crate::words::{fill, reporting as w};

impl Page<'_> {
    /// Returns the numbers that a conclusion rests on: effects with intervals and the p of people's means.
    pub(super) fn key_numbers(&self, compared: &Compared) -> String {
        let number = |value: f64| number(value, 3, self.language);
        let p = |p: f64| self.equals_p(p);
        let ends = |it: &Ends| self.ends(it);
        if let Some(measure) = &compared.measure {
            let rho = measure.spearman.found();
            let rho = rho.map(|it| (number(it.coefficient), it.p.map_or_else(String::new, p)));
            let Some((rho, p)) = rho else {
                return String::new();
            };
            let ends = measure.interval.found().map_or_else(String::new, ends);
            return format!(
                "rho {rho} {ends} · {p} · n\u{a0}=\u{a0}{}",
                measure.points.len()
            );
        }
        if let Some(overall) = &compared.overall {
            let found = overall.people.found();
            return found.map_or_else(String::new, |it| {
                format!(
                    "Friedman {} · W {} · n\u{a0}=\u{a0}{}",
                    p(it.p),
                    number(it.w),
                    it.n
                )
            });
        }
        let expects = compared.hypothesis.as_ref().map(|it| it.expects);
        let same = matches!(expects, Some(Expectation::SameWithin(_)));
        let pair = |pair: &Pair| {
            let effect = pair.effect.found()?;
            // The interval by which sameness is decided has its own level.
            let interval = match (same, pair.sameness.found()) {
                (true, Some(it)) => format!(
                    "{} ({})",
                    ends(&it.ends),
                    numbers::level(it.ends.level, self.language)
                ),
                _ => effect.interval.found().map_or_else(String::new, ends),
            };
            let test = pair.people.found().map_or_else(String::new, |it| {
                let name = self.say(w::test(it.test));
                format!(" · {name} {} · n\u{a0}=\u{a0}{}", p(it.p), it.n[0])
            });
            Some(format!("delta {} {interval}{test}", number(effect.delta)))
        };
        let pairs: Vec<String> = compared.pairs.iter().filter_map(pair).collect();
        pairs.join("; ")
    }

    /// Returns an interval without a break inside.
    fn ends(&self, ends: &Ends) -> String {
        let [low, high] = [ends.low, ends.high].map(|end| number(end, 3, self.language));
        format!("[{low};\u{a0}{high}]")
    }

    /// Returns `p = 0.012` or `p < 0.0001`, without a break inside.
    fn equals_p(&self, p: f64) -> String {
        let text = numbers::p(p, self.language).replace(' ', "\u{a0}");
        if text.starts_with('<') {
            format!("p\u{a0}{text}")
        } else {
            format!("p\u{a0}=\u{a0}{text}")
        }
    }

    pub(super) fn comparisons(&mut self) {
        self.heading(2, self.say(w::COMPARISONS));
        for compared in &self.report.comparisons {
            let title = match &compared.hypothesis {
                Some(stated) => {
                    let text = self.text_of(&stated.text, "");
                    if text.is_empty() {
                        stated.name.clone()
                    } else {
                        fill(
                            self.say(w::PAIR_OF_TEXTS),
                            &[("a", &stated.name), ("b", &text)],
                        )
                    }
                }
                None => {
                    let names = [compared.question.as_str(), &compared.part];
                    let names: Vec<&str> = names.into_iter().filter(|it| !it.is_empty()).collect();
                    let names = names.join(", ");
                    let measure = compared.measure.as_ref().map_or("", |it| &it.measure);
                    let form = if measure.is_empty() {
                        w::ALL_PAIRS
                    } else {
                        w::WITH_MEASURE
                    };
                    fill(
                        self.say(form),
                        &[("question", &names), ("measure", &measure)],
                    )
                }
            };
            self.heading(3, &title);
            self.comparison(compared);
        }
    }

    fn comparison(&mut self, compared: &Compared) {
        if let Some(measure) = &compared.measure {
            self.measure(measure, &compared.question);
            return;
        }
        let side = if compared.is_one_sided() {
            w::ONE_SIDED
        } else {
            w::TWO_SIDED
        };
        self.paragraph("soft", self.say(side));
        self.group_table(compared);
        if let Some(overall) = &compared.overall {
            let p = |found: Result<f64, Undefined>| match found {
                Ok(p) => self.equals_p(p),
                Err(why) => self.none(why),
            };
            let pooled = p(overall.pooled.result().map(|it| it.p));
            let people = p(overall.people.result().map(|it| it.p));
            let words = fill(
                self.say(w::OVERALL),
                &[("pooled", &pooled), ("people", &people)],
            );
            self.paragraph("", &words);
        }
        self.pairs(compared);
    }

    fn group_table(&mut self, compared: &Compared) {
        let question = self
            .report
            .questions
            .iter()
            .find(|it| it.name == compared.question);
        let choice = question.is_some_and(|it| matches!(it.kind, QuestionKind::Choice { .. }));
        let number = |value: f64, decimals| number(value, decimals, self.language);
        let rows = compared.groups.iter().map(|it| {
            let mut row = vec![it.label.clone(), it.people.to_string()];
            match &it.description {
                Outcome::Found(own) if choice => {
                    row.extend([own.n.to_string(), number(100.0 * own.mean, 1)]);
                }
                Outcome::Found(own) => row.extend([
                    own.n.to_string(),
                    number(own.mean, 3),
                    own.sd.map_or_else(String::new, |sd| number(sd, 3)),
                    number(own.median, 1),
                ]),
                Outcome::Nothing { why } => row.push(self.say(w::undefined(*why)).to_owned()),
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
        let titles: Vec<&str> = titles.into_iter().map(|it| self.say(it)).collect();
        self.table(&titles, &rows);
    }

    fn none(&self, why: Undefined) -> String {
        let why = self.say(w::undefined(why));
        fill(self.say(w::NONE_BECAUSE), &[("why", &why)])
    }

    fn pairs(&mut self, compared: &Compared) {
        let name = |it: &Pair| {
            it.groups
                .map(|at| compared.groups[at].label.clone())
                .join("\u{a0}− ")
        };
        let rows: Vec<(String, f64, Option<Ends>)> = compared
            .pairs
            .iter()
            .filter_map(|it| {
                let effect = it.effect.found()?;
                Some((name(it), effect.delta, effect.interval.found().copied()))
            })
            .collect();
        let bound = compared.bound();
        if !rows.is_empty() {
            let figure = charts::effects(&rows, bound, self.language);
            let resampling = &self.report.resampling;
            let (level, bound) = (
                numbers::level(resampling.level, self.language),
                number(bound, 3, self.language),
            );
            let values: [(&str, &dyn Display); 3] = [
                ("level", &level),
                ("times", &resampling.times),
                ("bound", &bound),
            ];
            let note = fill(self.say(w::EFFECTS_NOTE), &values);
            self.figure(&figure, &note);
        }
        let several = compared.pairs.len() > 1;
        let rows: Vec<Vec<String>> = compared
            .pairs
            .iter()
            .map(|it| self.pair_row(it, name(it), several))
            .collect();
        let bound = number(bound, 3, self.language);
        let sameness = fill(self.say(w::SAMENESS), &[("bound", &bound)]);
        let mut titles = vec![self.say(w::PAIR)];
        for title in [w::POOLED, w::BY_PERSON] {
            titles.push(self.say(title));
            titles.extend(several.then(|| self.say(w::P_HOLM)));
        }
        titles.extend([w::DIFFERENCE, w::SIZE].map(|it| self.say(it)));
        titles.push(&sameness);
        self.table(&titles, &rows);
        let alpha = compared.hypothesis.as_ref().map_or(ALPHA, |it| it.alpha);
        for pair in &compared.pairs {
            if let (Some(pooled), Some(people)) = (pair.pooled.found(), pair.people.found())
                && (pooled.p_holm < alpha) != (people.p_holm < alpha)
            {
                let n = pooled.n[0] + pooled.n[1];
                let words = fill(self.say(w::DISAGREE), &[("n", &n)]);
                let values: [(&str, &dyn Display); 2] = [("a", &name(pair)), ("b", &words)];
                let words = fill(self.say(w::PAIR_OF_TEXTS), &values);
                self.paragraph("soft", &words);
            }
        }
    }

    /// Returns the row of a pair; p corrected for their number have a column if there are `several` pairs.
    fn pair_row(&self, pair: &Pair, name: String, several: bool) -> Vec<String> {
        let mut row = vec![name];
        for test in [&pair.pooled, &pair.people] {
            let (text, holm) = match test.result() {
                Ok(it) => (
                    self.test(it),
                    numbers::p(it.p_holm, self.language).replace(' ', "\u{a0}"),
                ),
                Err(why) => (self.none(why), String::new()),
            };
            row.push(text);
            row.extend(several.then_some(holm));
        }
        let difference = pair.mean_difference;
        row.push(difference.map_or_else(String::new, |it| number(it, 3, self.language)));
        let effect = pair.effect.found();
        row.push(
            effect
                .map_or("", |it| self.say(w::size(it.size)))
                .to_owned(),
        );
        row.push(match pair.sameness.result() {
            Ok(it) => format!(
                "{} {}",
                self.say(w::sameness(it.result)),
                self.ends(&it.ends)
            ),
            Err(why) => self.none(why),
        });
        row
    }

    /// Returns a test with its numbers: `Wilcoxon, W+ = 812.5, n = 57, p = 0.031, exact`.
    fn test(&self, test: &PairTest) -> String {
        let statistic = test.statistic.map_or_else(String::new, |it| {
            let decimals = if (2.0 * it).fract() == 0.0 { 1 } else { 2 };
            let decimals = if it.fract() == 0.0 { 0 } else { decimals };
            let symbol = self.say(w::statistic(test.test));
            format!("{symbol} = {}, ", number(it, decimals, self.language)).replace(' ', "\u{a0}")
        });
        let statistic = statistic.replace(",\u{a0}", ", ");
        let [n, m] = test.n;
        let n = match test.test {
            TestName::Wilcoxon | TestName::Mcnemar => n.to_string(),
            TestName::MannWhitney | TestName::Fisher => format!("{n}\u{a0}+\u{a0}{m}"),
        };
        let name = self.say(w::test(test.test));
        let method = self.say(w::method(test.method));
        format!(
            "{name}, {statistic}n\u{a0}=\u{a0}{n}, {}, {method}",
            self.equals_p(test.p)
        )
    }

    fn measure(&mut self, measure: &MeasureReport, question: &str) {
        let figure =
            charts::correlation(&measure.points, [&measure.measure, question], self.language);
        let coefficient = |found: Result<f64, Undefined>| match found {
            Ok(it) => number(it, 3, self.language),
            Err(why) => self.none(why),
        };
        let rho = coefficient(measure.spearman.result().map(|it| it.coefficient));
        let tau = coefficient(measure.kendall.result().map(|it| it.coefficient));
        let p = measure.spearman.found().and_then(|it| it.p);
        let p = p.map_or_else(|| "p –".to_owned(), |p| self.equals_p(p));
        let interval = match measure.interval.result() {
            Ok(it) => self.ends(it),
            Err(why) => self.none(why),
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
        let note = fill(self.say(w::MEASURE), &values);
        if measure.points.is_empty() {
            self.paragraph("", &note);
        } else {
            self.figure(&figure, &note);
        }
    }
}

impl Compared {
    /// Returns whether its tests look in one direction only.
    #[must_use]
    pub fn is_one_sided(&self) -> bool {
        self.side != Alternative::TwoSided
    }

    /// Returns the smallest difference of interest, as Cliff's delta.
    #[must_use]
    pub fn bound(&self) -> f64 {
        match self.hypothesis.as_ref().map(|it| it.expects) {
            Some(Expectation::SameWithin(bound)) => bound,
            _ => SMALLEST,
        }
    }
}
