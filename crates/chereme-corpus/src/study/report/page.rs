//! The report as one page: HTML with its figures inside, which needs no network.

mod comparisons;

use std::fmt::Write as _;

use super::charts::{self, Bar, BoxRow};
use super::numbers::{because, number, p, percent, reason};
use super::{
    Compared, Conclusion, Confusion, Group, ModelReport, Outcome, ProfileTable, QuestionReport,
    Report, Stated, Verdict,
};
use crate::map::escaped;
use crate::study::plan::{Expectation, QuestionKind, Texts, text_in};
use crate::words::{Language, Text, fill, reporting as w};

const STYLE: &str = include_str!("page.css");

impl Report {
    /// Returns the report as a page of HTML in a language.
    #[must_use]
    pub fn page(&self, language: Language) -> String {
        let mut page = Page {
            report: self,
            language,
            out: String::new(),
        };
        page.whole();
        page.out
    }
}

pub(super) struct Page<'a> {
    report: &'a Report,
    language: Language,
    out: String,
}

impl Page<'_> {
    fn say(&self, text: Text) -> &'static str {
        text.of(self.language)
    }

    fn put(&mut self, html: impl AsRef<str>) {
        self.out.push_str(html.as_ref());
        self.out.push('\n');
    }

    fn heading(&mut self, level: u8, text: &str) {
        self.put(format!("<h{level}>{}</h{level}>", escaped(text)));
    }

    fn paragraph(&mut self, class: &str, text: &str) {
        self.put(format!("<p class=\"{class}\">{}</p>", escaped(text)));
    }

    fn figure(&mut self, svg: &str, note: &str) {
        self.put(format!(
            "<figure>{svg}<figcaption>{}</figcaption></figure>",
            escaped(note)
        ));
    }

    /// Puts a table; cells are texts. Numbers stand at the right, columns with words at the left.
    fn table(&mut self, titles: &[&str], rows: &[Vec<String>]) {
        const LONG: usize = 14;
        let long = |column: usize| {
            let mut cells = rows.iter().filter_map(|row| row.get(column));
            cells.any(|cell| cell.chars().count() > LONG || cell.starts_with(char::is_alphabetic))
        };
        let classes: Vec<&str> = (0..titles.len())
            .map(|column| if long(column) { " class=\"words\"" } else { "" })
            .collect();
        let cells = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let cells = cells.zip(&classes);
            cells.fold(String::new(), |mut row, (cell, class)| {
                // Formatting into a string never fails.
                let _ = write!(row, "<{tag}{class}>{}</{tag}>", escaped(cell));
                row
            })
        };
        let head = cells("th", &mut titles.iter().copied());
        self.put(format!(
            "<div class=\"wide\"><table><thead><tr>{head}</tr></thead><tbody>"
        ));
        for row in rows {
            let row = cells("td", &mut row.iter().map(String::as_str));
            self.put(format!("<tr>{row}</tr>"));
        }
        self.put("</tbody></table></div>");
    }

    fn text_of<'t>(&self, texts: &'t Texts, name: &'t str) -> &'t str {
        text_in(texts, self.language.code()).unwrap_or(name)
    }

    fn whole(&mut self) {
        let report = self.report;
        let title = self.text_of(&report.title, &report.study);
        let code = self.language.code();
        self.put(format!(
            "<!DOCTYPE html>\n<html lang=\"{code}\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n\
             <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>",
            escaped(title)
        ));
        self.heading(1, title);
        let subtitle = format!("{} · {}", self.say(w::SUBTITLE), report.study);
        self.paragraph("soft", &subtitle);
        self.conclusions();
        self.people();
        for question in &report.questions {
            self.question(question);
        }
        self.comparisons();
        self.methods();
        self.put("</body>\n</html>");
    }

    fn conclusions(&mut self) {
        let report = self.report;
        self.heading(2, self.say(w::CONCLUSIONS));
        let stated: Vec<(&Compared, &Stated, &Conclusion)> = report
            .comparisons
            .iter()
            .filter_map(|it| Some((it, it.hypothesis.as_ref()?, it.conclusion.as_ref()?)))
            .collect();
        if stated.is_empty() {
            self.paragraph("", self.say(w::NO_HYPOTHESIS));
            return;
        }
        self.put("<div class=\"cards\">");
        for (compared, stated, conclusion) in stated {
            let (class, mark) = match conclusion.verdict {
                Verdict::Supported => ("supported", "✓"),
                Verdict::NotSupported => ("not-supported", "✗"),
                Verdict::Undecided => ("undecided", "?"),
            };
            let words = self.say(w::verdict(conclusion.verdict));
            let text = escaped(self.text_of(&stated.text, ""));
            let expects = escaped(&self.expectation(compared, stated));
            let found = escaped(&self.key_numbers(compared));
            let because = escaped(&because(conclusion.because, self.language));
            self.put(format!(
                "<div class=\"card {class}\"><strong>{}</strong> <span class=\"badge\">{mark} {words}</span>\
                 <p>{text}</p><p class=\"soft\">{expects}. {because}</p><p class=\"soft\">{found}</p></div>",
                escaped(&stated.name)
            ));
        }
        self.put("</div>");
    }

    /// Returns the text of a hypothesis: its groups, the expected result and its level.
    fn expectation(&self, compared: &Compared, stated: &Stated) -> String {
        let alpha = number(stated.alpha, 3, self.language);
        let alpha = alpha.trim_end_matches('0').trim_end_matches(['.', ',']);
        let level = fill(self.say(w::ALPHA), &[("alpha", &alpha)]);
        let expects = match (&compared.measure, stated.expects) {
            (Some(it), Expectation::Difference) => fill(
                self.say(w::EXPECTS_CORRELATION),
                &[("measure", &it.measure)],
            ),
            (_, Expectation::SameWithin(bound)) => {
                let bound = number(bound, 3, self.language);
                fill(self.say(w::EXPECTS_SAMENESS), &[("bound", &bound)])
            }
            (None, Expectation::Difference) if compared.is_one_sided() => {
                self.say(w::EXPECTS_RISE).to_owned()
            }
            (None, Expectation::Difference) => self.say(w::EXPECTS_DIFFERENCE).to_owned(),
        };
        let groups: Vec<&str> = compared.groups.iter().map(|it| it.label.as_str()).collect();
        let groups = groups.join(if compared.is_one_sided() {
            " → "
        } else {
            " / "
        });
        let parts = [
            compared.question.as_str(),
            &compared.part,
            &groups,
            &expects,
            &level,
        ];
        let parts: Vec<&str> = parts.into_iter().filter(|it| !it.is_empty()).collect();
        parts.join(" · ")
    }

    fn people(&mut self) {
        let people = &self.report.people;
        self.heading(2, self.say(w::PEOPLE));
        let left_out: usize = people.excluded.iter().map(|it| it.count).sum();
        let mut reasons = String::new();
        for it in &people.excluded {
            let why = reason(&it.reason, self.language);
            let words = fill(self.say(w::PAIR_OF_TEXTS), &[("a", &it.count), ("b", &why)]);
            let _ = write!(reasons, "<li>{}</li>", escaped(&words));
        }
        self.put(format!(
            "<div class=\"flow\"><div><b>{}</b>{}</div><div><b>{left_out}</b>{}<ul>{reasons}</ul></div>\
             <div class=\"last\"><b>{}</b>{}</div></div>",
            people.recruited,
            self.say(w::RECRUITED),
            self.say(w::LEFT_OUT),
            people.analysed,
            self.say(w::ANALYSED)
        ));
        if people.other_plan > 0 {
            let words = fill(self.say(w::OTHER_PLAN), &[("n", &people.other_plan)]);
            self.paragraph("soft", &words);
        }
        let silent = |table: &&ProfileTable| {
            let given = table.rows.iter().filter(|row| row.option.is_some());
            given.map(|row| row.recruited).sum::<usize>() == 0
        };
        self.put("<div class=\"tables\">");
        for table in people.profile.iter().filter(|it| !silent(it)) {
            let title = self.text_of(&table.text, &table.question);
            let rows = table.rows.iter().map(|row| {
                let name = row.option.as_deref().unwrap_or(self.say(w::NO_ANSWER));
                let name = self.text_of(&row.text, name).to_owned();
                vec![name, row.recruited.to_string(), row.analysed.to_string()]
            });
            let rows: Vec<Vec<String>> = rows.collect();
            self.put("<div>");
            self.table(
                &[title, self.say(w::EVERYBODY), self.say(w::ANALYSED)],
                &rows,
            );
            self.put("</div>");
        }
        self.put("</div>");
        let unanswered = people.profile.iter().filter(silent);
        let unanswered: Vec<&str> = unanswered.map(|it| it.question.as_str()).collect();
        if !unanswered.is_empty() {
            let words = fill(
                self.say(w::NOBODY_SAID),
                &[("questions", &unanswered.join(", "))],
            );
            self.paragraph("soft", &words);
        }
    }

    fn question(&mut self, question: &QuestionReport) {
        let title = fill(self.say(w::QUESTION), &[("name", &question.name)]);
        self.heading(2, &title);
        let text = self.text_of(&question.text, "").to_owned();
        self.paragraph("", &text);
        let mut parts: Vec<&str> = question
            .conditions
            .iter()
            .map(|it| it.part.as_str())
            .collect();
        parts.dedup();
        if question.conditions.iter().all(|it| it.answers == 0) {
            self.paragraph("soft", self.say(w::NO_ANSWERS));
            return;
        }
        for part in &parts {
            if parts.len() > 1 || !part.is_empty() {
                let words = fill(self.say(w::PART), &[("name", part)]);
                self.heading(3, &words);
            }
            let own = |groups: &'_ [Group]| -> Vec<Group> {
                let own = groups
                    .iter()
                    .filter(|it| it.part == *part && it.answers > 0);
                own.cloned().collect()
            };
            let (conditions, items) = (own(&question.conditions), own(&question.items));
            match &question.kind {
                QuestionKind::Scale { low, high, labels } => {
                    let legend: Vec<String> = (*low..=*high)
                        .take(100)
                        .map(|at| {
                            match labels
                                .get(&at)
                                .and_then(|it| text_in(it, self.language.code()))
                            {
                                Some(text) => format!("{at} {text}"),
                                None => at.to_string(),
                            }
                        })
                        .collect();
                    self.scale(&conditions, &legend, [*low, *high]);
                    self.items(&items, Some(&legend), None);
                    for model in question.models.iter().filter(|it| it.part == *part) {
                        self.model(model);
                    }
                }
                QuestionKind::Choice { options } => {
                    let chance = Some(1.0 / options.len().max(1) as f64);
                    self.choice(&conditions, chance);
                    self.items(&items, None, chance);
                    for table in question.confusions.iter().filter(|it| it.part == *part) {
                        self.confusion(table);
                    }
                }
            }
        }
    }

    fn scale(&mut self, groups: &[Group], legend: &[String], scale: [i64; 2]) {
        let bars: Vec<Bar<'_>> = groups.iter().map(bar_of_condition).collect();
        let figure = charts::diverging(&bars, legend, self.language);
        self.figure(&figure, self.say(w::BARS_NOTE));
        let rows: Vec<BoxRow<'_>> = groups
            .iter()
            .filter_map(|it| {
                Some(BoxRow {
                    label: &it.condition,
                    description: it.description.as_ref()?,
                    means: &it.person_means,
                })
            })
            .collect();
        let figure = charts::boxes(&rows, scale, self.language);
        self.figure(&figure, self.say(w::BOXES_NOTE));
        self.descriptions(groups, false);
    }

    fn descriptions(&mut self, groups: &[Group], by_item: bool) {
        let number = |value: f64, decimals| number(value, decimals, self.language);
        let rows = groups.iter().filter_map(|it| {
            let own = it.description.as_ref()?;
            let mut row = vec![it.item.clone().unwrap_or_default(), it.condition.clone()];
            if !by_item {
                row.remove(0);
            }
            row.extend([
                it.people.to_string(),
                it.answers.to_string(),
                it.cannot_say.to_string(),
                number(own.mean, 3),
                own.sd.map_or_else(String::new, |sd| number(sd, 3)),
                number(own.median, 1),
                format!("{}–{}", number(own.q1, 1), number(own.q3, 1)),
            ]);
            Some(row)
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let mut titles = vec![
            w::ITEM,
            w::CONDITION,
            w::PERSONS,
            w::ANSWERS,
            w::CANNOT_SAY,
            w::MEAN,
        ];
        titles.extend([w::SD, w::MEDIAN, w::QUARTILES]);
        if !by_item {
            titles.remove(0);
        }
        let titles: Vec<&str> = titles.into_iter().map(|it| self.say(it)).collect();
        self.table(&titles, &rows);
    }

    /// Puts the answers to each item, folded; `legend` has the words of a scale, `chance` the share of right guesses.
    fn items(&mut self, items: &[Group], legend: Option<&[String]>, chance: Option<f64>) {
        if items.len() < 2 {
            return;
        }
        let labels: Vec<String> = items
            .iter()
            .map(|it| {
                format!(
                    "{}, {}",
                    it.item.as_deref().unwrap_or_default(),
                    it.condition
                )
            })
            .collect();
        self.put(format!(
            "<details><summary>{}</summary>",
            self.say(w::EACH_ITEM)
        ));
        if let Some(legend) = legend {
            let bars = items.iter().zip(&labels).map(|(it, label)| Bar {
                label,
                counts: &it.counts,
            });
            let figure = charts::diverging(&bars.collect::<Vec<_>>(), legend, self.language);
            self.figure(&figure, self.say(w::BARS_NOTE));
            self.descriptions(items, true);
        } else {
            let rows = items.iter().zip(&labels);
            let rows: Vec<(&str, &super::Share)> = rows
                .filter_map(|(it, label)| Some((label.as_str(), it.recognition.as_ref()?)))
                .collect();
            let figure = charts::shares(&rows, chance, self.language);
            self.figure(&figure, self.say(w::SHARES_NOTE));
        }
        self.put("</details>");
    }

    fn choice(&mut self, groups: &[Group], chance: Option<f64>) {
        let rows: Vec<(&str, &super::Share)> = groups
            .iter()
            .filter_map(|it| Some((it.condition.as_str(), it.recognition.as_ref()?)))
            .collect();
        if rows.is_empty() {
            return;
        }
        let figure = charts::shares(&rows, chance, self.language);
        self.figure(&figure, self.say(w::SHARES_NOTE));
        let table = groups.iter().filter_map(|it| {
            let own = it.recognition?;
            let [low, high] = own.interval.map(|end| percent(end, self.language));
            let share = percent(own.share, self.language);
            let counts = [it.people, it.answers, it.cannot_say, own.right].map(|n| n.to_string());
            let [people, answers, cannot_say, right] = counts;
            let interval = format!("{low}–{high}");
            Some(vec![
                it.condition.clone(),
                people,
                answers,
                cannot_say,
                right,
                share,
                interval,
            ])
        });
        let table: Vec<Vec<String>> = table.collect();
        let titles = [
            w::CONDITION,
            w::PERSONS,
            w::ANSWERS,
            w::CANNOT_SAY,
            w::RECOGNISED,
        ];
        let mut titles: Vec<&str> = titles.into_iter().map(|it| self.say(it)).collect();
        titles.extend(["%", self.say(w::INTERVAL_95)]);
        self.table(&titles, &table);
    }

    fn confusion(&mut self, table: &Confusion) {
        if table.rows.is_empty() {
            return;
        }
        let condition = table
            .condition
            .as_deref()
            .unwrap_or(self.say(w::ALL_CONDITIONS));
        let figure = charts::confusion(table, self.language);
        let note = format!("{condition}. {}", self.say(w::CONFUSION_NOTE));
        let folded = table.condition.is_some();
        if folded {
            self.put(format!(
                "<details><summary>{}</summary>",
                escaped(condition)
            ));
        }
        self.figure(&figure, &note);
        if folded {
            self.put("</details>");
        }
    }

    fn model(&mut self, model: &ModelReport) {
        let found = match &model.model {
            Outcome::Found(found) => found,
            Outcome::Nothing { why } => {
                let why = self.say(w::undefined(*why));
                let words = fill(self.say(w::NO_MODEL), &[("why", &why)]);
                self.paragraph("soft", &words);
                return;
            }
        };
        let mut words = fill(self.say(w::MODEL), &[("reference", &model.reference)]);
        for more in [w::MODEL_ITEMS, w::MODEL_NOTE] {
            if more == w::MODEL_NOTE || model.with_items {
                let _ = write!(words, " {}", self.say(more));
            }
        }
        self.paragraph("soft", &words);
        let rows = model
            .conditions
            .iter()
            .zip(&found.coefficients)
            .map(|(name, it)| {
                let odds = |by: f64| number((it.estimate + by * it.se).exp(), 2, self.language);
                let interval = format!("{}–{}", odds(-1.959_964), odds(1.959_964));
                vec![name.clone(), odds(0.0), interval, p(it.p, self.language)]
            });
        let rows: Vec<Vec<String>> = rows.collect();
        let titles = [w::CONDITION, w::ODDS, w::INTERVAL_95, w::P].map(|it| self.say(it));
        self.table(&titles, &rows);
    }

    fn methods(&mut self) {
        self.heading(2, self.say(w::METHODS));
        for text in [
            w::METHODS_TESTS,
            w::METHODS_SAME,
            w::METHODS_EFFECT,
            w::METHODS_HOLM,
        ] {
            self.paragraph("", self.say(text));
        }
        let report = self.report;
        let values: [(&str, &dyn std::fmt::Display); 3] = [
            ("version", &report.program),
            ("sha", &report.plan_sha256),
            ("seed", &report.resampling.seed),
        ];
        let made = escaped(&fill(self.say(w::MADE), &values));
        self.put(format!("<footer>{made}</footer>"));
    }
}

fn bar_of_condition(group: &Group) -> Bar<'_> {
    Bar {
        label: &group.condition,
        counts: &group.counts,
    }
}
