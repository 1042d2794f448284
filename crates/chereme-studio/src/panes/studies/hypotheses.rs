//! The hypotheses of a plan: added, changed and removed.

use std::borrow::Cow;

use chereme_corpus::study::plan::{Comparison, Expectation, Hypothesis, Plan, Selection, Texts};
use eframe::egui::{CollapsingHeader, DragValue, Ui};

use super::draft::{line, remove};
use super::drafted::Draft;
use crate::context::PaneInput;
use crate::panes::combo;
use crate::words::{Text, fill, studies as words};

/// The kinds of a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Between,
    Same,
    Trend,
    Measure,
}

const KINDS: [(Kind, Text); 4] = [
    (Kind::Between, words::EXPECT_DIFFERENCE),
    (Kind::Same, words::EXPECT_SAME),
    (Kind::Trend, words::EXPECT_TREND),
    (Kind::Measure, words::EXPECT_MEASURE),
];

/// The usual bound of sameness: below it, Cliff's delta is called negligible.
const NEGLIGIBLE: f64 = 0.147;

impl Kind {
    fn of(it: &Hypothesis) -> Self {
        match (&it.compares, it.expects) {
            (Comparison::Measure(_), _) => Self::Measure,
            (Comparison::Trend(_), _) => Self::Trend,
            (Comparison::Between(_), Expectation::SameWithin(_)) => Self::Same,
            (Comparison::Between(_), Expectation::Difference) => Self::Between,
        }
    }

    /// Gives the hypothesis this kind; its groups stay.
    fn put(self, it: &mut Hypothesis, plan: &Plan) {
        let groups = match std::mem::replace(&mut it.compares, Comparison::Measure(String::new())) {
            Comparison::Between(groups) | Comparison::Trend(groups) => groups,
            Comparison::Measure(_) => plan
                .conditions()
                .iter()
                .map(|name| Selection {
                    conditions: vec![(*name).to_owned()],
                    ..Selection::default()
                })
                .collect(),
        };
        it.compares = match self {
            Self::Between | Self::Same => Comparison::Between(groups),
            Self::Trend => Comparison::Trend(groups),
            Self::Measure => {
                Comparison::Measure(measures(plan).first().cloned().unwrap_or_default())
            }
        };
        it.expects = match self {
            Self::Same => Expectation::SameWithin(NEGLIGIBLE),
            _ => Expectation::Difference,
        };
    }
}

/// Returns the names of measures of trials; distances are measured when the plan is stored.
fn measures(plan: &Plan) -> Vec<String> {
    let names = plan.trials.iter().flat_map(|it| it.measures.keys());
    let names: std::collections::BTreeSet<&String> = names.collect();
    names.into_iter().cloned().collect()
}

/// Shows the hypotheses.
pub(super) fn show(ui: &mut Ui, seen: &PaneInput<'_>, draft: &mut Draft, plan: &Plan) {
    let mut removed = None;
    let count = draft.hypotheses.len();
    let title = fill(seen.say(words::HYPOTHESES), &[("n", &count)]);
    let header = CollapsingHeader::new(title).id_salt("hypotheses");
    header.show(ui, |ui| {
        ui.weak(seen.say(words::HYPOTHESES_HELP));
        let mut plan = Cow::Borrowed(plan);
        if draft.distance_from.is_some() {
            let distance = chereme_corpus::study::DISTANCE.to_owned();
            if let Some(first) = plan.to_mut().trials.first_mut() {
                first.measures.insert(distance, 0.0);
            }
        }
        for (at, it) in draft.hypotheses.iter_mut().enumerate() {
            ui.push_id(at, |ui| {
                ui.separator();
                let name = fill(seen.say(words::HYPOTHESIS), &[("n", &(at + 1))]);
                ui.horizontal_wrapped(|ui| {
                    ui.strong(&name);
                    if remove(ui, seen, &name) {
                        removed = Some(at);
                    }
                });
                one(ui, seen, (&name, it), &plan);
            });
        }
        if ui.button(seen.say(words::ADD_HYPOTHESIS)).clicked() {
            draft.add_hypothesis(&plan);
        }
    });
    if let Some(at) = removed {
        draft.hypotheses.remove(at);
    }
}

/// Returns the text of a language to be changed; an empty one is taken out by [`tidy`].
pub(super) fn text_of<'a>(texts: &'a mut Texts, language: &str) -> &'a mut String {
    texts.entry(language.to_owned()).or_default()
}

/// Takes empty texts out.
pub(super) fn tidy(texts: &mut Texts) {
    texts.retain(|_, text| !text.is_empty());
}

fn one(ui: &mut Ui, seen: &PaneInput<'_>, (title, it): (&str, &mut Hypothesis), plan: &Plan) {
    let named = |text| format!("{title}: {}", seen.say(text));
    line(ui, &named(words::HYPOTHESIS_NAME), "", &mut it.name);
    let language = seen.language.code();
    let text = text_of(&mut it.text, language);
    line(ui, &named(words::HYPOTHESIS_TEXT), "", text);
    tidy(&mut it.text);
    ui.horizontal_wrapped(|ui| {
        let questions: Vec<(String, String)> = plan
            .questions
            .iter()
            .map(|it| (it.name.clone(), it.name.clone()))
            .collect();
        combo::named(
            ui,
            seen.say(words::ABOUT_QUESTION),
            &mut it.question,
            &questions,
        );
        let before = Kind::of(it);
        let mut kind = before;
        let kinds = KINDS.map(|(kind, text)| (kind, seen.say(text).to_owned()));
        combo::named(ui, seen.say(words::EXPECTS), &mut kind, &kinds);
        if kind != before {
            kind.put(it, plan);
        }
        if let Expectation::SameWithin(bound) = &mut it.expects {
            let label = ui.weak(seen.say(words::BOUND));
            let field = DragValue::new(bound).range(0.001..=0.999).speed(0.005);
            ui.add(field.max_decimals(3)).labelled_by(label.id);
        }
        let label = ui.weak(seen.say(words::ALPHA));
        let field = DragValue::new(&mut it.alpha)
            .range(0.0001..=0.5)
            .speed(0.001);
        ui.add(field.max_decimals(4)).labelled_by(label.id);
    });
    match &mut it.compares {
        Comparison::Measure(name) => {
            let all: Vec<(String, String)> = measures(plan)
                .into_iter()
                .map(|it| (it.clone(), it))
                .collect();
            if all.is_empty() {
                ui.weak(seen.say(words::NO_MEASURE));
            }
            combo::named(ui, seen.say(words::MEASURE), name, &all);
        }
        Comparison::Between(groups) | Comparison::Trend(groups) => {
            let mut removed = None;
            let several = groups.len() > 2;
            for (at, group) in groups.iter_mut().enumerate() {
                ui.push_id(("group", at), |ui| {
                    let name = fill(seen.say(words::GROUP), &[("n", &(at + 1))]);
                    ui.horizontal_wrapped(|ui| {
                        ui.weak(&name);
                        toggles(
                            ui,
                            (title, &name),
                            &mut group.conditions,
                            &plan.conditions(),
                        );
                        if several && remove(ui, seen, &name) {
                            removed = Some(at);
                        }
                    });
                    let parts = plan.parts();
                    if parts.len() > 1 || !group.parts.is_empty() {
                        ui.horizontal_wrapped(|ui| {
                            ui.weak(seen.say(words::COLUMN_PART));
                            toggles(ui, (title, &name), &mut group.parts, &parts);
                        });
                    }
                    let text = match group.items.len() {
                        0 => seen.say(words::ALL_SIGNS).to_owned(),
                        n => fill(seen.say(words::SOME_SIGNS), &[("n", &n)]),
                    };
                    let header = CollapsingHeader::new(text).id_salt("items");
                    header.show(ui, |ui| {
                        ui.horizontal_wrapped(|ui| {
                            toggles(ui, (title, &name), &mut group.items, &plan.items());
                        });
                    });
                });
            }
            if let Some(at) = removed {
                groups.remove(at);
            }
            if ui.button(seen.say(words::ADD_GROUP)).clicked() {
                groups.push(Selection::default());
            }
        }
    }
}

/// Shows a button for each name, which is pressed if the list has it; names that the plan lacks can be taken out.
fn toggles(ui: &mut Ui, (title, group): (&str, &str), list: &mut Vec<String>, all: &[&str]) {
    let unknown: Vec<String> = list
        .iter()
        .filter(|it| !all.contains(&it.as_str()))
        .cloned()
        .collect();
    let names = all
        .iter()
        .copied()
        .chain(unknown.iter().map(String::as_str));
    for name in names.filter(|it| !it.is_empty()) {
        let on = list.iter().any(|it| it == name);
        let button = ui.selectable_label(on, name);
        button.widget_info(|| {
            let label = format!("{title}, {group}: {name}");
            eframe::egui::WidgetInfo::selected(eframe::egui::Role::Button, true, on, label)
        });
        if button.clicked() {
            match on {
                true => list.retain(|it| it != name),
                false => list.push(name.to_owned()),
            }
        }
    }
}
