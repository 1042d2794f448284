//! The builder: each condition of the query as a row that can be changed by looking and clicking.

use std::collections::BTreeMap;

use chereme_sign::query::{Missing, Pattern, Property, Query, TextField, TimeField, TimeTest};
use chereme_sign::{Component, Field, HandRef, Inventory, Phase};
use eframe::egui::{
    Button, ComboBox, DragValue, RichText, Role, Sense, Slider, Ui, Vec2, WidgetInfo,
};

use super::builder::{self, Condition, How, Subject, written};
use super::examples::Examples;
use crate::context::{Outbox, PaneInput};
use crate::miniatures::{self, Cell, Motion};
use crate::model::Known;
use crate::panes::library::data::origin_named;
use crate::pickers::{self, Picker};
use crate::script::edit;
use crate::words::{Text, fill, search as words};

/// The state of the builder besides the query.
#[derive(Debug, Default)]
pub(crate) struct Rows {
    /// The picker of each value, by the index of its row and its index there.
    pub(super) pickers: BTreeMap<(usize, usize), Picker>,
    /// An added row that is not complete yet.
    draft: Option<Condition>,
    /// Texts that are being typed, by row.
    typing: BTreeMap<usize, String>,
    /// The row that gets a further value.
    more: Option<usize>,
    /// The row that was just added, whose text takes the keyboard next.
    begun: Option<usize>,
}

/// Side of an example's figure, in points.
const PICTURE: f32 = 72.0;

/// Draws the rows of `text` and changes it; returns whether it changed.
pub(super) fn show(
    ui: &mut Ui,
    rows: &mut Rows,
    seen: &PaneInput<'_>,
    text: &mut String,
    (examples, out): (&Examples, &mut Outbox),
) -> bool {
    let Ok(query) = Query::parse(text) else {
        ui.label(RichText::new(seen.say(words::NO_ROWS)).small().weak());
        return false;
    };
    let mut all = builder::rows(&query);
    let before = all.clone();
    let mut removed = None;
    let stated = all.len();
    let drafted = rows.draft.take();
    all.extend(drafted);
    // The button that adds a row stands behind the last row, so that the results have more room.
    let (last, mut added) = (all.len().checked_sub(1), None);
    let offers = all.len() == stated;
    for (at, condition) in all.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                if has_pictures(seen, condition) {
                    ui.set_row_height(36.0);
                }
                row(ui, rows, seen, (at, condition), (examples, out));
                let name = fill(seen.say(words::REMOVE), &[("row", &(at + 1))]);
                let remove = ui.small_button("×").on_hover_text(&name);
                remove.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
                if remove.clicked() {
                    removed = Some(at);
                }
                if offers && Some(at) == last {
                    added = add(ui, seen);
                }
            });
        });
    }
    if last.is_none() {
        added = add(ui, seen);
    }
    if let Some(at) = removed {
        all.remove(at);
        *rows = Rows::default();
    }
    if all.len() > stated && !all.last().is_some_and(is_complete) {
        rows.draft = all.pop();
    }
    if let Some(row) = added {
        // The value is chosen next.
        let pictures = match &row {
            Condition::Values(Subject::Component(field), ..) => inventory(seen, field).is_some(),
            _ => false,
        };
        if pictures {
            rows.pickers.insert((all.len(), 0), Picker::opening());
        }
        rows.begun = Some(all.len());
        rows.draft = Some(row);
    }
    if all == before {
        return false;
    }
    rows.more = None;
    *text = builder::text(&all);
    true
}

/// Returns whether a row shows pictures, and so is higher than others.
fn has_pictures(seen: &PaneInput<'_>, row: &Condition) -> bool {
    match row {
        Condition::Values(Subject::Component(field), how, values) => {
            let shown = !matches!(how, How::Has | How::Missing(_)) && !values.is_empty();
            shown && inventory(seen, field).is_some()
        }
        _ => false,
    }
}

/// Returns whether a row has all its values.
fn is_complete(row: &Condition) -> bool {
    match row {
        Condition::Values(_, how, values) => {
            matches!(how, How::Has | How::Missing(_)) || !values.is_empty()
        }
        Condition::Words(_, values) => !values.is_empty(),
        _ => true,
    }
}

/// Draws the button that adds a row; returns the new, incomplete row.
fn add(ui: &mut Ui, seen: &PaneInput<'_>) -> Option<Condition> {
    let mut added = None;
    ui.menu_button(seen.say(words::ADD), |ui| {
        let mut entry = |ui: &mut Ui, name: String, row: Condition| {
            if ui.button(name).clicked() {
                added = Some(row);
                ui.close();
            }
        };
        let mut fields: Vec<Field> = Component::ALL.map(Field::new).to_vec();
        for it in &seen.snapshot.overview.inventories {
            let field = it.inventory.field();
            if !fields.contains(&field) {
                fields.push(field);
            }
        }
        let order = |it: &Field| Component::ALL.iter().position(|c| *c == it.component);
        fields.sort_by_key(order);
        eframe::egui::ScrollArea::vertical()
            .max_height(420.0)
            .show(ui, |ui| {
                for field in fields {
                    let name = field_text(&field, seen);
                    let subject = Subject::Component(field);
                    entry(ui, name, Condition::Values(subject, How::Is, Vec::new()));
                }
                ui.separator();
                for (text, name) in [
                    (TextField::Gloss, words::GLOSS),
                    (TextField::Translation, words::TRANSLATION),
                    (TextField::Comment, words::COMMENT),
                ] {
                    let row = Condition::Words(text, Vec::new());
                    entry(ui, seen.say(name).to_owned(), row);
                }
                let most = Condition::Time(TimeField::Duration, TimeTest::AtMost(1_000_000));
                entry(ui, seen.say(words::DURATION).to_owned(), most);
                for (property, name) in PROPERTIES {
                    let subject = Subject::Property(property);
                    let row = Condition::Values(subject, How::Is, Vec::new());
                    entry(ui, seen.say(name).to_owned(), row);
                }
            });
    });
    added
}

const PROPERTIES: [(Property, Text); 8] = [
    (Property::Origin, words::ORIGIN),
    (Property::Signer, words::SIGNER),
    (Property::Recording, words::RECORDING),
    (Property::Hand, words::HAND),
    (Property::Sign, words::SIGN),
    (Property::Tier, words::TIER),
    (Property::Inventory, words::INVENTORY),
    (Property::Token, words::TOKEN),
];

/// Returns the name of a component.
pub(crate) fn component_text(component: Component) -> Text {
    match component {
        Component::Configuration => words::CONFIGURATION,
        Component::Placement => words::PLACEMENT,
        Component::Movement => words::MOVEMENT,
        Component::Orientation => words::ORIENTATION,
        Component::NonManual => words::NONMANUAL,
    }
}

/// Features of components that have a name in words.
const FEATURES: [(&str, Text); 18] = [
    ("body", words::FEATURE_BODY),
    ("brows", words::FEATURE_BROWS),
    ("direction", words::FEATURE_DIRECTION),
    ("fingers", words::FEATURE_FINGERS),
    ("gaze", words::FEATURE_GAZE),
    ("head", words::FEATURE_HEAD),
    ("letter", words::FEATURE_LETTER),
    ("lids", words::FEATURE_LIDS),
    ("manner", words::FEATURE_MANNER),
    ("mouth", words::FEATURE_MOUTH),
    ("mouthing", words::FEATURE_MOUTHING),
    ("nose", words::FEATURE_NOSE),
    ("palm", words::FEATURE_PALM),
    ("phase", words::FEATURE_PHASE),
    ("repeated", words::FEATURE_REPEATED),
    ("repetition", words::FEATURE_REPETITION),
    ("shoulders", words::FEATURE_SHOULDERS),
    ("size", words::FEATURE_SIZE),
];

/// Returns the name of a feature of a component; the feature itself if it has no translation.
pub(crate) fn feature_text<'a>(feature: &'a str, seen: &PaneInput<'_>) -> &'a str {
    let known = FEATURES.iter().find(|(it, _)| *it == feature);
    known.map_or(feature, |(_, text)| seen.say(*text))
}

/// Returns the name of a field without its hand and phase.
pub(crate) fn field_text(field: &Field, seen: &PaneInput<'_>) -> String {
    let component = seen.say(component_text(field.component));
    match &field.feature {
        Some(feature) => format!("{component} · {}", feature_text(feature, seen)),
        None => component.to_owned(),
    }
}

fn row(
    ui: &mut Ui,
    rows: &mut Rows,
    seen: &PaneInput<'_>,
    (at, condition): (usize, &mut Condition),
    (examples, out): (&Examples, &mut Outbox),
) {
    match condition {
        Condition::Values(subject, how, values) => {
            let name = subject_ui(ui, seen, subject);
            how_ui(ui, seen, how, &name);
            if !matches!(how, How::Has | How::Missing(_)) {
                values_ui(ui, rows, seen, at, (subject, &name), values);
            }
        }
        Condition::Words(field, values) => {
            let name = seen.say(match field {
                TextField::Any => words::ANY_TEXT,
                TextField::Gloss => words::GLOSS,
                TextField::Translation => words::TRANSLATION,
                TextField::Comment => words::COMMENT,
            });
            ui.label(name);
            ui.weak(seen.say(words::CONTAINS));
            text_ui(ui, rows, at, values, name);
        }
        Condition::Time(field, test) => {
            ui.label(seen.say(match field {
                TimeField::Duration => words::DURATION,
                TimeField::Start => words::START,
                TimeField::End => words::END,
            }));
            time_ui(ui, test);
        }
        Condition::Like(example, weights, above) => {
            like_ui(ui, seen, out, examples.get(example, seen), (weights, above));
        }
        Condition::Written(expr) => {
            ui.label(RichText::new(expr.to_string()).monospace());
            ui.weak(RichText::new(seen.say(words::AS_WRITTEN)).small());
        }
    }
}

/// Draws the subject of a row with its hand and phase; returns the subject's name.
fn subject_ui(ui: &mut Ui, seen: &PaneInput<'_>, subject: &mut Subject) -> String {
    let field = match subject {
        Subject::Component(field) => field,
        Subject::Property(property) => {
            let name = PROPERTIES.iter().find(|(it, _)| it == property);
            let name = name.map_or(property.name(), |(_, name)| seen.say(*name));
            ui.label(name);
            return name.to_owned();
        }
        Subject::Text(text) => {
            let name = match text {
                TextField::Gloss => seen.say(words::GLOSS),
                TextField::Translation => seen.say(words::TRANSLATION),
                TextField::Comment => seen.say(words::COMMENT),
                TextField::Any => seen.say(words::ANY_TEXT),
            };
            ui.label(name);
            return name.to_owned();
        }
    };
    let name = field_text(field, seen);
    if field.component.is_manual() {
        let shown = hand_text(field.hand, seen);
        ComboBox::from_id_salt("hand")
            .selected_text(shown)
            .width(10.0)
            .show_ui(ui, |ui| {
                let all = std::iter::once(None).chain(HandRef::ALL.map(Some));
                for hand in all {
                    ui.selectable_value(&mut field.hand, hand, hand_text(hand, seen));
                }
            });
    }
    ui.label(&name);
    if let Some(phase) = field.phase {
        let weak = match phase {
            Phase::Initial => seen.say(words::INITIAL).to_owned(),
            Phase::Final => seen.say(words::FINAL).to_owned(),
            middle @ Phase::Middle(_) => middle.to_string(),
        };
        ui.weak(weak);
    }
    name
}

fn hand_text(hand: Option<HandRef>, seen: &PaneInput<'_>) -> &'static str {
    seen.say(match hand {
        None => words::EITHER,
        Some(HandRef::Right) => words::RIGHT,
        Some(HandRef::Left) => words::LEFT,
        Some(HandRef::Dominant) => words::DOMINANT,
        Some(HandRef::Weak) => words::WEAK,
    })
}

fn how_text(how: How) -> Text {
    match how {
        How::Is => words::IS,
        How::IsNot => words::IS_NOT,
        How::Exactly => words::EXACTLY,
        How::NotAtAll => words::NOT_AT_ALL,
        How::Has => words::HAS,
        How::Missing(Missing::Unset) => words::UNSET,
        How::Missing(Missing::NotApplicable) => words::NOT_APPLICABLE,
        How::Missing(Missing::Unclear) => words::UNCLEAR,
    }
}

fn how_ui(ui: &mut Ui, seen: &PaneInput<'_>, how: &mut How, _name: &str) {
    ComboBox::from_id_salt("how")
        .selected_text(seen.say(how_text(*how)))
        .width(10.0)
        .show_ui(ui, |ui| {
            let missing = Missing::ALL.map(How::Missing);
            let all = [How::Is, How::IsNot, How::Exactly, How::NotAtAll, How::Has];
            for it in all.into_iter().chain(missing) {
                ui.selectable_value(how, it, seen.say(how_text(it)));
            }
        });
}

fn inventory<'a>(seen: &'a PaneInput<'_>, field: &Field) -> Option<&'a Inventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|it| &it.inventory)
        .find(|it| it.component == field.component && it.feature == field.feature)
}

fn values_ui(
    ui: &mut Ui,
    rows: &mut Rows,
    seen: &PaneInput<'_>,
    at: usize,
    (subject, name): (&Subject, &str),
    values: &mut Vec<Pattern>,
) {
    let inventory = match subject {
        Subject::Component(field) => inventory(seen, field),
        Subject::Property(property) => {
            let offered: Vec<&str> = match property {
                Property::Signer => {
                    let all = seen.snapshot.overview.signers.iter();
                    all.map(|it| it.name.as_str()).collect()
                }
                other => other.fixed_values().unwrap_or_default().to_vec(),
            };
            if !offered.is_empty() {
                return choice_ui(ui, seen, &offered, values);
            }
            None
        }
        Subject::Text(_) => None,
    };
    let Some(inventory) = inventory else {
        return text_ui(ui, rows, at, values, name);
    };
    let several = values.len() > 1;
    let mut gone = None;
    for (place, value) in values.iter_mut().enumerate() {
        let label = fill(
            seen.say(words::VALUE),
            &[("field", &name), ("n", &(at + 1))],
        );
        let picker = rows.pickers.entry((at, place)).or_default();
        let now = written(value);
        if let Some(picked) = pickers::button(ui, picker, seen, inventory, Some(&now), &label) {
            *value = Pattern::literal(picked);
        }
        if several && ui.small_button("−").clicked() {
            gone = Some(place);
        }
    }
    if let Some(place) = gone {
        values.remove(place);
    }
    if values.is_empty() || rows.more == Some(at) {
        let label = fill(seen.say(words::PICK), &[("field", &name)]);
        let picker = rows.pickers.entry((at, values.len())).or_default();
        if let Some(picked) = pickers::button(ui, picker, seen, inventory, None, &label) {
            values.push(Pattern::literal(picked));
        }
    } else if ui.small_button(seen.say(words::OR)).clicked() {
        rows.more = Some(at);
    }
}

/// Draws a choice among a few values.
fn choice_ui(ui: &mut Ui, seen: &PaneInput<'_>, offered: &[&str], values: &mut Vec<Pattern>) {
    let now: Vec<String> = values.iter().map(written).collect();
    let called = |id: &str| match origin_named(id) {
        Some(text) => seen.say(text).to_owned(),
        None => id.to_owned(),
    };
    let shown = if now.is_empty() {
        seen.say(crate::words::pickers::CHOOSE).to_owned()
    } else {
        let names: Vec<String> = now.iter().map(|id| called(id)).collect();
        names.join(", ")
    };
    ComboBox::from_id_salt("choice")
        .selected_text(shown)
        .show_ui(ui, |ui| {
            for it in offered {
                let chosen = now.iter().any(|value| value == it);
                if ui.add(Button::selectable(chosen, called(it))).clicked() {
                    *values = vec![Pattern::literal(*it)];
                }
            }
        });
}

/// Draws values as text, which is read when it is entered or left.
fn text_ui(ui: &mut Ui, rows: &mut Rows, at: usize, values: &mut Vec<Pattern>, name: &str) {
    let now: Vec<String> = values.iter().map(written).collect();
    let now = now.join(", ");
    let text = rows.typing.entry(at).or_insert_with(|| now.clone());
    let before = text.clone();
    let shown = edit::line(ui, text, |field| field.desired_width(150.0));
    let response = shown.response.response;
    if rows.begun.take_if(|it| *it == at).is_some() {
        response.request_focus();
    }
    let shown = text.clone();
    response.widget_info(|| WidgetInfo {
        label: Some(name.to_owned()),
        ..WidgetInfo::text_edit(true, &before, &shown, "")
    });
    if response.lost_focus() {
        let typed = text.split(',').map(str::trim).filter(|it| !it.is_empty());
        let typed: Vec<Pattern> = typed.map(Pattern::from_glob).collect();
        if typed != *values && !typed.is_empty() {
            *values = typed;
        }
    }
    if !response.has_focus() {
        rows.typing.remove(&at);
    }
}

fn time_ui(ui: &mut Ui, test: &mut TimeTest) {
    const NAMES: [&str; 5] = ["<", "≤", ">", "≥", "…"];
    let (kind, least, most) = match *test {
        TimeTest::Below(most) => (0, 0, most),
        TimeTest::AtMost(most) => (1, 0, most),
        TimeTest::Above(least) => (2, least, least),
        TimeTest::AtLeast(least) => (3, least, least),
        TimeTest::Between(least, most) => (4, least, most),
    };
    let mut now = kind;
    ComboBox::from_id_salt("time")
        .selected_text(NAMES[kind])
        .width(10.0)
        .show_ui(ui, |ui| {
            for (at, name) in NAMES.iter().enumerate() {
                ui.selectable_value(&mut now, at, *name);
            }
        });
    let drag = |ui: &mut Ui, micros: i64| {
        let mut seconds = micros as f64 / 1e6;
        let drag = DragValue::new(&mut seconds)
            .range(0.0..=36_000.0)
            .speed(0.02)
            .max_decimals(3)
            .suffix(" s");
        if ui.add(drag).changed() {
            (seconds * 1e6).round() as i64
        } else {
            micros
        }
    };
    let (mut low, mut high) = (least, most);
    if now >= 2 {
        low = drag(ui, least);
    }
    if now < 2 || now == 4 {
        high = drag(ui, most);
    }
    *test = match now {
        0 => TimeTest::Below(high),
        1 => TimeTest::AtMost(high),
        2 => TimeTest::Above(low),
        3 => TimeTest::AtLeast(low),
        _ => TimeTest::Between(low.min(high), high.max(low)),
    };
}

/// Draws the weight of each component of an example.
fn like_ui(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    example: Option<Known>,
    (weights, above): (&mut [f64; 5], &mut Option<f64>),
) {
    let example = example.unwrap_or_default();
    if let Some((recording, span)) = example.place {
        let size = Vec2::splat(PICTURE);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let motion = Motion::Span(recording, span);
        let cell = Cell::new(motion, size).playing(miniatures::clock(ui));
        seen.little.paint(ui, seen, out, &cell, rect);
    }
    let name = match example.gloss.as_str() {
        "" => "…",
        gloss => gloss,
    };
    ui.vertical(|ui| {
        ui.label(fill(seen.say(words::LIKE), &[("example", &name)]));
        let before = *weights;
        for (component, weight) in Component::ALL.into_iter().zip(weights.iter_mut()) {
            let name = seen.say(component_text(component));
            let slider = Slider::new(weight, 0.0..=4.0).step_by(0.5).text(name);
            ui.add(slider);
        }
        let mut least = above.unwrap_or(0.0) * 100.0;
        let slider = Slider::new(&mut least, 0.0..=95.0).step_by(5.0);
        let slider = slider.suffix(" %").text(seen.say(words::LEAST_ALIKE));
        if ui.add(slider).changed() {
            // A least similarity of zero is no condition.
            *above = (least > 0.0).then_some(least / 100.0);
        }
        if weights.iter().all(|weight| *weight == 0.0) {
            // At least one component must have a weight.
            *weights = before;
        }
    });
}
