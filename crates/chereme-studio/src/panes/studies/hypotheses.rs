//! The hypotheses of a plan: added, changed and removed.

use std::borrow::Cow;

use chereme_corpus::study::study_plan::{
    ExpectedResult, HypothesisComparison, LocalizedTexts, StudyHypothesis, StudyPlan, TrialSelection,
};
use eframe::egui::{CollapsingHeader, DragValue, Ui};

use super::drafted::StudyDraft;
use super::studies_draft::{show_draft_text_line, show_remove_line_button};
use crate::context::PaneInput;
use crate::panes::combo;
use crate::words::{InterfaceText, fill_text_braces, studies_words as words};

/// The kinds of a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HypothesisKind {
    Between,
    Same,
    Trend,
    Measure,
}

const HYPOTHESIS_KINDS: [(HypothesisKind, InterfaceText); 4] = [
    (HypothesisKind::Between, words::EXPECT_DIFFERENCE),
    (HypothesisKind::Same, words::EXPECT_SAME),
    (HypothesisKind::Trend, words::EXPECT_TREND),
    (HypothesisKind::Measure, words::EXPECT_MEASURE),
];

/// The usual bound of sameness: below it, Cliff's delta is called negligible.
const NEGLIGIBLE_CLIFF_DELTA: f64 = 0.147;

impl HypothesisKind {
    fn kind_from_hypothesis(it: &StudyHypothesis) -> Self {
        match (&it.compares, it.expects) {
            (HypothesisComparison::Measure(_), _) => Self::Measure,
            (HypothesisComparison::Trend(_), _) => Self::Trend,
            (HypothesisComparison::Between(_), ExpectedResult::SameWithin(_)) => Self::Same,
            (HypothesisComparison::Between(_), ExpectedResult::Difference) => Self::Between,
        }
    }

    /// Gives the hypothesis this kind; its groups stay.
    fn put_hypothesis_kind(self, it: &mut StudyHypothesis, plan: &StudyPlan) {
        let groups = match std::mem::replace(&mut it.compares, HypothesisComparison::Measure(String::new())) {
            HypothesisComparison::Between(groups) | HypothesisComparison::Trend(groups) => groups,
            HypothesisComparison::Measure(_) => plan
                .main_conditions()
                .iter()
                .map(|name| TrialSelection {
                    conditions: vec![(*name).to_owned()],
                    ..TrialSelection::default()
                })
                .collect(),
        };
        it.compares = match self {
            Self::Between | Self::Same => HypothesisComparison::Between(groups),
            Self::Trend => HypothesisComparison::Trend(groups),
            Self::Measure => {
                HypothesisComparison::Measure(trial_measure_names(plan).first().cloned().unwrap_or_default())
            }
        };
        it.expects = match self {
            Self::Same => ExpectedResult::SameWithin(NEGLIGIBLE_CLIFF_DELTA),
            _ => ExpectedResult::Difference,
        };
    }
}

/// Returns the names of measures of trials; distances are measured when the plan is stored.
fn trial_measure_names(plan: &StudyPlan) -> Vec<String> {
    let measure_names = plan.trials.iter().flat_map(|trial| trial.measures.keys());
    let names: std::collections::BTreeSet<&String> = measure_names.collect();
    names.into_iter().cloned().collect()
}

/// Shows the hypotheses.
pub(super) fn show_draft_hypotheses(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut StudyDraft, plan: &StudyPlan) {
    let mut removed = None;
    let count = draft.hypotheses.len();
    let title = fill_text_braces(seen.say_text(words::HYPOTHESES), &[("n", &count)]);
    let header = CollapsingHeader::new(title).id_salt("hypotheses");
    header.show(ui, |ui| {
        ui.weak(seen.say_text(words::HYPOTHESES_HELP));
        let mut plan = Cow::Borrowed(plan);
        if draft.distance_from.is_some() {
            let distance = chereme_corpus::study::DISTANCE_MEASURE_NAME.to_owned();
            if let Some(first) = plan.to_mut().trials.first_mut() {
                first.measures.insert(distance, 0.0);
            }
        }
        for (at, it) in draft.hypotheses.iter_mut().enumerate() {
            ui.push_id(at, |ui| {
                ui.separator();
                let name = fill_text_braces(seen.say_text(words::HYPOTHESIS), &[("n", &(at + 1))]);
                ui.horizontal_wrapped(|ui| {
                    ui.strong(&name);
                    if show_remove_line_button(ui, seen, &name) {
                        removed = Some(at);
                    }
                });
                show_one_hypothesis(ui, seen, &name, it, &plan);
            });
        }
        if ui.button(seen.say_text(words::ADD_HYPOTHESIS)).clicked() {
            draft.add_hypothesis(&plan);
        }
    });
    if let Some(at) = removed {
        draft.hypotheses.remove(at);
    }
}

/// Returns the text of a language to be changed; an empty one is taken out by [`remove_empty_texts`].
pub(super) fn language_text_mut<'a>(texts: &'a mut LocalizedTexts, language: &str) -> &'a mut String {
    texts.entry(language.to_owned()).or_default()
}

/// Takes empty texts out.
pub(super) fn remove_empty_texts(texts: &mut LocalizedTexts) {
    texts.retain(|_, text| !text.is_empty());
}

fn show_one_hypothesis(ui: &mut Ui, seen: &PaneInput<'_>, title: &str, it: &mut StudyHypothesis, plan: &StudyPlan) {
    let named = |text| format!("{title}: {}", seen.say_text(text));
    show_draft_text_line(ui, &named(words::HYPOTHESIS_NAME), "", &mut it.name);
    let language = seen.language.language_code();
    let text = language_text_mut(&mut it.text, language);
    show_draft_text_line(ui, &named(words::HYPOTHESIS_TEXT), "", text);
    remove_empty_texts(&mut it.text);
    ui.horizontal_wrapped(|ui| {
        let questions: Vec<(String, String)> = plan
            .questions
            .iter()
            .map(|question| (question.name.clone(), question.name.clone()))
            .collect();
        combo::show_named_combo(ui, seen.say_text(words::ABOUT_QUESTION), &mut it.question, &questions);
        let before = HypothesisKind::kind_from_hypothesis(it);
        let mut kind = before;
        let kinds = HYPOTHESIS_KINDS.map(|(kind, text)| (kind, seen.say_text(text).to_owned()));
        combo::show_named_combo(ui, seen.say_text(words::EXPECTS), &mut kind, &kinds);
        if kind != before {
            kind.put_hypothesis_kind(it, plan);
        }
        if let ExpectedResult::SameWithin(bound) = &mut it.expects {
            let label = ui.weak(seen.say_text(words::BOUND));
            let field = DragValue::new(bound).range(0.001..=0.999).speed(0.005);
            ui.add(field.max_decimals(3)).labelled_by(label.id);
        }
        let label = ui.weak(seen.say_text(words::ALPHA));
        let field = DragValue::new(&mut it.alpha).range(0.0001..=0.5).speed(0.001);
        ui.add(field.max_decimals(4)).labelled_by(label.id);
    });
    match &mut it.compares {
        HypothesisComparison::Measure(name) => {
            let all: Vec<(String, String)> = trial_measure_names(plan)
                .into_iter()
                .map(|name| (name.clone(), name))
                .collect();
            if all.is_empty() {
                ui.weak(seen.say_text(words::NO_MEASURE));
            }
            combo::show_named_combo(ui, seen.say_text(words::MEASURE), name, &all);
        }
        HypothesisComparison::Between(groups) | HypothesisComparison::Trend(groups) => {
            let mut removed = None;
            let several = groups.len() > 2;
            for (at, group) in groups.iter_mut().enumerate() {
                ui.push_id(("group", at), |ui| {
                    let name = fill_text_braces(seen.say_text(words::GROUP), &[("n", &(at + 1))]);
                    ui.horizontal_wrapped(|ui| {
                        ui.weak(&name);
                        toggles(ui, title, &name, &mut group.conditions, &plan.main_conditions());
                        if several && show_remove_line_button(ui, seen, &name) {
                            removed = Some(at);
                        }
                    });
                    let parts = plan.plan_parts();
                    if parts.len() > 1 || !group.parts.is_empty() {
                        ui.horizontal_wrapped(|ui| {
                            ui.weak(seen.say_text(words::COLUMN_PART));
                            toggles(ui, title, &name, &mut group.parts, &parts);
                        });
                    }
                    let text = match group.items.len() {
                        0 => seen.say_text(words::ALL_SIGNS).to_owned(),
                        n => fill_text_braces(seen.say_text(words::SOME_SIGNS), &[("n", &n)]),
                    };
                    let header = CollapsingHeader::new(text).id_salt("items");
                    header.show(ui, |ui| {
                        ui.horizontal_wrapped(|ui| {
                            toggles(ui, title, &name, &mut group.items, &plan.main_items());
                        });
                    });
                });
            }
            if let Some(at) = removed {
                groups.remove(at);
            }
            if ui.button(seen.say_text(words::ADD_GROUP)).clicked() {
                groups.push(TrialSelection::default());
            }
        }
    }
}

/// Shows a button for each name, which is pressed if the list has it; names that the plan lacks can be taken out.
fn toggles(ui: &mut Ui, title: &str, group: &str, list: &mut Vec<String>, all: &[&str]) {
    let unknown: Vec<String> = list
        .iter()
        .filter(|name| !all.contains(&name.as_str()))
        .cloned()
        .collect();
    let names = all.iter().copied().chain(unknown.iter().map(String::as_str));
    for name in names.filter(|name| !name.is_empty()) {
        let on = list.iter().any(|entry| entry == name);
        let button = ui.selectable_label(on, name);
        button.widget_info(|| {
            let label = format!("{title}, {group}: {name}");
            eframe::egui::WidgetInfo::selected(eframe::egui::Role::Button, true, on, label)
        });
        if button.clicked() {
            match on {
                true => list.retain(|entry| entry != name),
                false => list.push(name.to_owned()),
            }
        }
    }
}
