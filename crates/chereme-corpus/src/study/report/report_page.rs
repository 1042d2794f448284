//! The report as one page: HTML with its figures inside, which needs no network.

mod comparisons;

use std::fmt::Write as _;

use super::charts::{self, BarRow, BoxRow};
use super::report_numbers::{
    exclusion_reason_words, format_p_value, format_percent, format_report_number, verdict_reason_sentence,
};
use super::{
    AnswerGroup, ConfusionTable, GroupComparison, HypothesisConclusion, HypothesisVerdict, ModelReport, ProfileTable,
    QuestionReport, StatedHypothesis, StatsOutcome, StudyReport,
};
use crate::map::escape_markup;
use crate::study::report::report_words as w;
use crate::study::study_plan::{ExpectedResult, LocalizedTexts, QuestionKind, text_in};
use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces};

const REPORT_STYLE_CSS: &str = include_str!("page.css");

impl StudyReport {
    /// Returns the report as a page of HTML in a language.
    #[must_use]
    pub fn report_page_html(&self, language: InterfaceLanguage) -> String {
        let mut page = ReportPage {
            report: self,
            language,
            out: String::new(),
        };
        page.put_whole_report();
        page.out
    }
}

pub(super) struct ReportPage<'a> {
    report: &'a StudyReport,
    language: InterfaceLanguage,
    out: String,
}

impl ReportPage<'_> {
    fn say_page_text(&self, text: InterfaceText) -> &'static str {
        text.text_in_language(self.language)
    }

    fn put_page_html(&mut self, html: impl AsRef<str>) {
        self.out.push_str(html.as_ref());
        self.out.push('\n');
    }

    fn put_page_heading(&mut self, level: u8, text: &str) {
        self.put_page_html(format!("<h{level}>{}</h{level}>", escape_markup(text)));
    }

    fn paragraph(&mut self, class: &str, text: &str) {
        self.put_page_html(format!("<p class=\"{class}\">{}</p>", escape_markup(text)));
    }

    fn put_page_figure(&mut self, svg: &str, note: &str) {
        self.put_page_html(format!(
            "<figure>{svg}<figcaption>{}</figcaption></figure>",
            escape_markup(note)
        ));
    }

    /// Puts a table; cells are texts. Numbers stand at the right, columns with words at the left.
    fn put_page_table(&mut self, titles: &[&str], rows: &[Vec<String>]) {
        const MAX_NUMBER_CELL_CHARS: usize = 14;
        let long = |column: usize| {
            let mut cells = rows.iter().filter_map(|row| row.get(column));
            cells.any(|cell| cell.chars().count() > MAX_NUMBER_CELL_CHARS || cell.starts_with(char::is_alphabetic))
        };
        let classes: Vec<&str> = (0..titles.len())
            .map(|column| if long(column) { " class=\"words\"" } else { "" })
            .collect();
        let cells = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let cells = cells.zip(&classes);
            cells.fold(String::new(), |mut row, (cell, class)| {
                // Formatting into a string never fails.
                let _ = write!(row, "<{tag}{class}>{}</{tag}>", escape_markup(cell));
                row
            })
        };
        let head = cells("th", &mut titles.iter().copied());
        self.put_page_html(format!(
            "<div class=\"wide\"><table><thead><tr>{head}</tr></thead><tbody>"
        ));
        for row in rows {
            let row = cells("td", &mut row.iter().map(String::as_str));
            self.put_page_html(format!("<tr>{row}</tr>"));
        }
        self.put_page_html("</tbody></table></div>");
    }

    fn localized_text_or_name<'t>(&self, texts: &'t LocalizedTexts, name: &'t str) -> &'t str {
        text_in(texts, self.language.language_code()).unwrap_or(name)
    }

    fn put_whole_report(&mut self) {
        let report = self.report;
        let title = self.localized_text_or_name(&report.title, &report.study);
        let code = self.language.language_code();
        self.put_page_html(format!(
            "<!DOCTYPE html>\n<html lang=\"{code}\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n\
             <title>{}</title>\n<style>\n{REPORT_STYLE_CSS}</style>\n</head>\n<body>",
            escape_markup(title)
        ));
        self.put_page_heading(1, title);
        let subtitle = format!("{} · {}", self.say_page_text(w::SUBTITLE), report.study);
        self.paragraph("soft", &subtitle);
        self.put_conclusions();
        self.put_people_section();
        for question in &report.questions {
            self.put_question_section(question);
        }
        self.put_comparisons_section();
        self.methods();
        self.put_page_html("</body>\n</html>");
    }

    fn put_conclusions(&mut self) {
        let report = self.report;
        self.put_page_heading(2, self.say_page_text(w::CONCLUSIONS));
        let stated: Vec<(&GroupComparison, &StatedHypothesis, &HypothesisConclusion)> = report
            .comparisons
            .iter()
            .filter_map(|compared| Some((compared, compared.hypothesis.as_ref()?, compared.conclusion.as_ref()?)))
            .collect();
        if stated.is_empty() {
            self.paragraph("", self.say_page_text(w::NO_HYPOTHESIS));
            return;
        }
        self.put_page_html("<div class=\"cards\">");
        for (compared, stated, conclusion) in stated {
            let (class, mark) = match conclusion.verdict {
                HypothesisVerdict::Supported => ("supported", "✓"),
                HypothesisVerdict::NotSupported => ("not-supported", "✗"),
                HypothesisVerdict::Undecided => ("undecided", "?"),
            };
            let words = self.say_page_text(w::verdict_words(conclusion.verdict));
            let text = escape_markup(self.localized_text_or_name(&stated.text, ""));
            let expects = escape_markup(&self.expectation(compared, stated));
            let numbers_text = escape_markup(&self.key_numbers(compared));
            let because = escape_markup(&verdict_reason_sentence(conclusion.because, self.language));
            self.put_page_html(format!(
                "<div class=\"card {class}\"><strong>{}</strong> <span class=\"badge\">{mark} {words}</span>\
                 <p>{text}</p><p class=\"soft\">{expects}. {because}</p><p class=\"soft\">{numbers_text}</p></div>",
                escape_markup(&stated.name)
            ));
        }
        self.put_page_html("</div>");
    }

    /// Returns the text of a hypothesis: its groups, the expected result and its level.
    fn expectation(&self, compared: &GroupComparison, stated: &StatedHypothesis) -> String {
        let alpha_text = format_report_number(stated.alpha, 3, self.language);
        let alpha = alpha_text.trim_end_matches('0').trim_end_matches(['.', ',']);
        let level = fill_text_braces(self.say_page_text(w::ALPHA), &[("alpha", &alpha)]);
        let expects = match (&compared.measure, stated.expects) {
            (Some(it), ExpectedResult::Difference) => {
                fill_text_braces(self.say_page_text(w::EXPECTS_CORRELATION), &[("measure", &it.measure)])
            }
            (_, ExpectedResult::SameWithin(bound)) => {
                let bound = format_report_number(bound, 3, self.language);
                fill_text_braces(self.say_page_text(w::EXPECTS_SAMENESS), &[("bound", &bound)])
            }
            (None, ExpectedResult::Difference) if compared.is_one_sided() => {
                self.say_page_text(w::EXPECTS_RISE).to_owned()
            }
            (None, ExpectedResult::Difference) => self.say_page_text(w::EXPECTS_DIFFERENCE).to_owned(),
        };
        let group_labels: Vec<&str> = compared.groups.iter().map(|group| group.label.as_str()).collect();
        let groups = group_labels.join(if compared.is_one_sided() { " → " } else { " / " });
        let part_texts = [compared.question.as_str(), &compared.part, &groups, &expects, &level];
        let parts: Vec<&str> = part_texts.into_iter().filter(|part| !part.is_empty()).collect();
        parts.join(" · ")
    }

    fn put_people_section(&mut self) {
        let people = &self.report.people;
        self.put_page_heading(2, self.say_page_text(w::PEOPLE));
        let left_out: usize = people.excluded.iter().map(|reason| reason.count).sum();
        let mut reasons = String::new();
        for it in &people.excluded {
            let why = exclusion_reason_words(&it.reason, self.language);
            let words = fill_text_braces(self.say_page_text(w::PAIR_OF_TEXTS), &[("a", &it.count), ("b", &why)]);
            let _ = write!(reasons, "<li>{}</li>", escape_markup(&words));
        }
        self.put_page_html(format!(
            "<div class=\"flow\"><div><b>{}</b>{}</div><div><b>{left_out}</b>{}<ul>{reasons}</ul></div>\
             <div class=\"last\"><b>{}</b>{}</div></div>",
            people.recruited,
            self.say_page_text(w::RECRUITED),
            self.say_page_text(w::LEFT_OUT),
            people.analysed,
            self.say_page_text(w::ANALYSED)
        ));
        if people.other_plan > 0 {
            let words = fill_text_braces(self.say_page_text(w::OTHER_PLAN), &[("n", &people.other_plan)]);
            self.paragraph("soft", &words);
        }
        let silent = |table: &&ProfileTable| {
            let given = table.rows.iter().filter(|row| row.option.is_some());
            given.map(|row| row.recruited).sum::<usize>() == 0
        };
        self.put_page_html("<div class=\"tables\">");
        for table in people.profile.iter().filter(|table| !silent(table)) {
            let title = self.localized_text_or_name(&table.text, &table.question);
            let rows = table.rows.iter().map(|row| {
                let option_name = row.option.as_deref().unwrap_or(self.say_page_text(w::NO_ANSWER));
                let name = self.localized_text_or_name(&row.text, option_name).to_owned();
                vec![name, row.recruited.to_string(), row.analysed.to_string()]
            });
            let rows: Vec<Vec<String>> = rows.collect();
            self.put_page_html("<div>");
            self.put_page_table(
                &[title, self.say_page_text(w::EVERYBODY), self.say_page_text(w::ANALYSED)],
                &rows,
            );
            self.put_page_html("</div>");
        }
        self.put_page_html("</div>");
        let silent_tables = people.profile.iter().filter(silent);
        let unanswered: Vec<&str> = silent_tables.map(|table| table.question.as_str()).collect();
        if !unanswered.is_empty() {
            let words = fill_text_braces(
                self.say_page_text(w::NOBODY_SAID),
                &[("questions", &unanswered.join(", "))],
            );
            self.paragraph("soft", &words);
        }
    }

    fn put_question_section(&mut self, question: &QuestionReport) {
        let title = fill_text_braces(self.say_page_text(w::QUESTION), &[("name", &question.name)]);
        self.put_page_heading(2, &title);
        let text = self.localized_text_or_name(&question.text, "").to_owned();
        self.paragraph("", &text);
        let mut parts: Vec<&str> = question.conditions.iter().map(|group| group.part.as_str()).collect();
        parts.dedup();
        if question.conditions.iter().all(|group| group.answers == 0) {
            self.paragraph("soft", self.say_page_text(w::NO_ANSWERS));
            return;
        }
        for part in &parts {
            if parts.len() > 1 || !part.is_empty() {
                let words = fill_text_braces(self.say_page_text(w::PART), &[("name", part)]);
                self.put_page_heading(3, &words);
            }
            let groups_of_part = |groups: &'_ [AnswerGroup]| -> Vec<AnswerGroup> {
                let part_groups = groups.iter().filter(|group| group.part == *part && group.answers > 0);
                part_groups.cloned().collect()
            };
            let (conditions, items) = (groups_of_part(&question.conditions), groups_of_part(&question.items));
            match &question.kind {
                QuestionKind::Scale { low, high, labels } => {
                    let legend: Vec<String> = (*low..=*high)
                        .take(100)
                        .map(|at| {
                            match labels
                                .get(&at)
                                .and_then(|texts| text_in(texts, self.language.language_code()))
                            {
                                Some(text) => format!("{at} {text}"),
                                None => at.to_string(),
                            }
                        })
                        .collect();
                    self.put_scale_answers(&conditions, &legend, [*low, *high]);
                    self.put_item_answers(&items, Some(&legend), None);
                    for model in question.models.iter().filter(|model| model.part == *part) {
                        self.put_model_section(model);
                    }
                }
                QuestionKind::Choice { options } => {
                    let chance = Some(1.0 / options.len().max(1) as f64);
                    self.put_choice_answers(&conditions, chance);
                    self.put_item_answers(&items, None, chance);
                    for table in question.confusions.iter().filter(|table| table.part == *part) {
                        self.put_confusion_table(table);
                    }
                }
            }
        }
    }

    fn put_scale_answers(&mut self, groups: &[AnswerGroup], legend: &[String], scale: [i64; 2]) {
        let bars: Vec<BarRow<'_>> = groups.iter().map(bar_of_condition).collect();
        let figure = charts::diverging_bar_chart(&bars, legend, self.language);
        self.put_page_figure(&figure, self.say_page_text(w::BARS_NOTE));
        let rows: Vec<BoxRow<'_>> = groups
            .iter()
            .filter_map(|group| {
                Some(BoxRow {
                    label: &group.condition,
                    description: group.description.as_ref()?,
                    means: &group.person_means,
                })
            })
            .collect();
        let figure = charts::box_plot_chart(&rows, scale, self.language);
        self.put_page_figure(&figure, self.say_page_text(w::BOXES_NOTE));
        self.descriptions(groups, false);
    }

    fn descriptions(&mut self, groups: &[AnswerGroup], by_item: bool) {
        let number = |value: f64, decimals| format_report_number(value, decimals, self.language);
        let rows = groups.iter().filter_map(|group| {
            let description = group.description.as_ref()?;
            let mut row = vec![group.item.clone().unwrap_or_default(), group.condition.clone()];
            if !by_item {
                row.remove(0);
            }
            row.extend([
                group.people.to_string(),
                group.answers.to_string(),
                group.cannot_say.to_string(),
                number(description.mean, 3),
                description.sd.map_or_else(String::new, |sd| number(sd, 3)),
                number(description.median, 1),
                format!("{}–{}", number(description.q1, 1), number(description.q3, 1)),
            ]);
            Some(row)
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let mut titles = vec![w::ITEM, w::CONDITION, w::PERSONS, w::ANSWERS, w::CANNOT_SAY, w::MEAN];
        titles.extend([w::SD, w::MEDIAN, w::QUARTILES]);
        if !by_item {
            titles.remove(0);
        }
        let titles: Vec<&str> = titles.into_iter().map(|phrase| self.say_page_text(phrase)).collect();
        self.put_page_table(&titles, &rows);
    }

    /// Puts the answers to each item, folded; `legend` has the words of a scale, `chance` the share of right guesses.
    fn put_item_answers(&mut self, items: &[AnswerGroup], legend: Option<&[String]>, chance: Option<f64>) {
        if items.len() < 2 {
            return;
        }
        let labels: Vec<String> = items
            .iter()
            .map(|item| format!("{}, {}", item.item.as_deref().unwrap_or_default(), item.condition))
            .collect();
        self.put_page_html(format!(
            "<details><summary>{}</summary>",
            self.say_page_text(w::EACH_ITEM)
        ));
        if let Some(legend) = legend {
            let bars = items.iter().zip(&labels).map(|(item, label)| BarRow {
                label,
                counts: &item.counts,
            });
            let figure = charts::diverging_bar_chart(&bars.collect::<Vec<_>>(), legend, self.language);
            self.put_page_figure(&figure, self.say_page_text(w::BARS_NOTE));
            self.descriptions(items, true);
        } else {
            let labelled_items = items.iter().zip(&labels);
            let rows: Vec<(&str, &super::AnswerShare)> = labelled_items
                .filter_map(|(item, label)| Some((label.as_str(), item.recognition.as_ref()?)))
                .collect();
            let figure = charts::share_bar_chart(&rows, chance, self.language);
            self.put_page_figure(&figure, self.say_page_text(w::SHARES_NOTE));
        }
        self.put_page_html("</details>");
    }

    fn put_choice_answers(&mut self, groups: &[AnswerGroup], chance: Option<f64>) {
        let rows: Vec<(&str, &super::AnswerShare)> = groups
            .iter()
            .filter_map(|group| Some((group.condition.as_str(), group.recognition.as_ref()?)))
            .collect();
        if rows.is_empty() {
            return;
        }
        let figure = charts::share_bar_chart(&rows, chance, self.language);
        self.put_page_figure(&figure, self.say_page_text(w::SHARES_NOTE));
        let table = groups.iter().filter_map(|group| {
            let recognition = group.recognition?;
            let [low, high] = recognition.interval.map(|end| format_percent(end, self.language));
            let share = format_percent(recognition.share, self.language);
            let counts = [group.people, group.answers, group.cannot_say, recognition.right].map(|n| n.to_string());
            let [people, answers, cannot_say, right] = counts;
            let interval = format!("{low}–{high}");
            Some(vec![
                group.condition.clone(),
                people,
                answers,
                cannot_say,
                right,
                share,
                interval,
            ])
        });
        let table: Vec<Vec<String>> = table.collect();
        let phrases = [w::CONDITION, w::PERSONS, w::ANSWERS, w::CANNOT_SAY, w::RECOGNISED];
        let mut titles: Vec<&str> = phrases.into_iter().map(|phrase| self.say_page_text(phrase)).collect();
        titles.extend(["%", self.say_page_text(w::INTERVAL_95)]);
        self.put_page_table(&titles, &table);
    }

    fn put_confusion_table(&mut self, table: &ConfusionTable) {
        if table.rows.is_empty() {
            return;
        }
        let condition = table
            .condition
            .as_deref()
            .unwrap_or(self.say_page_text(w::ALL_CONDITIONS));
        let figure = charts::confusion_table_chart(table, self.language);
        let note = format!("{condition}. {}", self.say_page_text(w::CONFUSION_NOTE));
        let folded = table.condition.is_some();
        if folded {
            self.put_page_html(format!("<details><summary>{}</summary>", escape_markup(condition)));
        }
        self.put_page_figure(&figure, &note);
        if folded {
            self.put_page_html("</details>");
        }
    }

    fn put_model_section(&mut self, model: &ModelReport) {
        let fitted = match &model.model {
            StatsOutcome::Found(found) => found,
            StatsOutcome::Nothing { why } => {
                let why = self.say_page_text(w::undefined_reason_words(*why));
                let words = fill_text_braces(self.say_page_text(w::NO_MODEL), &[("why", &why)]);
                self.paragraph("soft", &words);
                return;
            }
        };
        let mut words = fill_text_braces(self.say_page_text(w::MODEL), &[("reference", &model.reference)]);
        for more in [w::MODEL_ITEMS, w::MODEL_NOTE] {
            if more == w::MODEL_NOTE || model.with_items {
                let _ = write!(words, " {}", self.say_page_text(more));
            }
        }
        self.paragraph("soft", &words);
        let rows = model.conditions.iter().zip(&fitted.coefficients).map(|(name, it)| {
            let odds = |by: f64| format_report_number((it.estimate + by * it.se).exp(), 2, self.language);
            let interval = format!("{}–{}", odds(-1.959_964), odds(1.959_964));
            vec![name.clone(), odds(0.0), interval, format_p_value(it.p, self.language)]
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let titles = [w::CONDITION, w::ODDS, w::INTERVAL_95, w::P].map(|phrase| self.say_page_text(phrase));
        self.put_page_table(&titles, &rows);
    }

    fn methods(&mut self) {
        self.put_page_heading(2, self.say_page_text(w::METHODS));
        for text in [w::METHODS_TESTS, w::METHODS_SAME, w::METHODS_EFFECT, w::METHODS_HOLM] {
            self.paragraph("", self.say_page_text(text));
        }
        let report = self.report;
        let values: [(&str, &dyn std::fmt::Display); 3] = [
            ("version", &report.program),
            ("sha", &report.plan_sha256),
            ("seed", &report.resampling.seed),
        ];
        let made = escape_markup(&fill_text_braces(self.say_page_text(w::MADE), &values));
        self.put_page_html(format!("<footer>{made}</footer>"));
    }
}

fn bar_of_condition(group: &AnswerGroup) -> BarRow<'_> {
    BarRow {
        label: &group.condition,
        counts: &group.counts,
    }
}
