//! The builder: each condition of the query as a row that can be changed by looking and clicking.

use std::collections::BTreeMap;
use std::ops::Bound;

use chereme_sign::query::{
    AttributeTest, MissingReason, QueryExpression, QueryTest, TestSubject, TextField, TextPattern, TimeField, TimeTest,
    TokenQuery, WholeTokenProperty,
};
use chereme_sign::{ComponentField, ComponentInventory, HandRef, SignComponent, SignPhase};
use eframe::egui::{Button, ComboBox, DragValue, RichText, Role, Sense, Slider, Ui, Vec2, WidgetInfo};

use super::examples::KnownExamples;
use super::search_builder::{self, ConditionRelation, ConditionSubject, QueryCondition, format_query_pattern};
use crate::context::PaneInput;
use crate::miniatures::{self, MiniatureCell, MiniatureMotion};
use crate::model::TokenSign;
use crate::panes::library::library_data::origin_named;
use crate::pickers::{self, ValuePicker};
use crate::script::script_edit;
use crate::words::{InterfaceText, fill_text_braces, search_words as words};

/// The state of the builder besides the query.
#[derive(Debug, Default)]
pub(crate) struct ConditionRows {
    /// The picker of each value, by the index of its row and its index there.
    pub(super) pickers: BTreeMap<(usize, usize), ValuePicker>,
    /// An added row that is not complete yet.
    draft: Option<QueryCondition>,
    /// Texts that are being typed, by row.
    typing: BTreeMap<usize, String>,
    /// The row that gets a further value.
    more: Option<usize>,
    /// The row that was just added, whose text takes the keyboard next.
    begun: Option<usize>,
}

/// A number of rows above those of any query that somebody reads as rows.
const MAX_SHOWN_ROWS: usize = 1000;
/// Side of an example's figure, in points.
const EXAMPLE_PICTURE_SIZE_POINTS: f32 = 72.0;

/// Draws the rows of `text` and changes it; returns whether it changed.
pub(super) fn show_condition_rows(
    ui: &mut Ui,
    rows: &mut ConditionRows,
    seen: &PaneInput<'_>,
    text: &mut String,
    examples: &KnownExamples,
) -> bool {
    let Ok(query) = TokenQuery::parse_query(text) else {
        ui.label(RichText::new(seen.say_text(words::NO_ROWS)).small().weak());
        return false;
    };
    let mut all = search_builder::rows_from_query(&query);
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
                show_condition_row(ui, rows, seen, at, condition, examples);
                let name = fill_text_braces(seen.say_text(words::REMOVE), &[("row", &(at + 1))]);
                let remove = ui.small_button("×").on_hover_text(&name);
                remove.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
                if remove.clicked() {
                    removed = Some(at);
                }
                if offers && Some(at) == last {
                    added = show_add_condition_button(ui, seen);
                }
            });
        });
    }
    if last.is_none() {
        added = show_add_condition_button(ui, seen);
    }
    if let Some(at) = removed {
        all.remove(at);
        *rows = ConditionRows::default();
    }
    if all.len() > stated && !all.last().is_some_and(is_complete) {
        rows.draft = all.pop();
    }
    if let Some(row) = added {
        // The value is chosen next.
        let pictures = match &row {
            QueryCondition::Values(ConditionSubject::Component(field), ..) => {
                query_field_inventory(seen, field).is_some()
            }
            _ => false,
        };
        if pictures {
            rows.pickers.insert((all.len(), 0), ValuePicker::new_opening_picker());
        }
        rows.begun = Some(all.len());
        rows.draft = Some(row);
    }
    if all == before {
        return false;
    }
    rows.more = None;
    *text = search_builder::query_text_from_rows(&all);
    true
}

/// Returns whether a row shows pictures, and so is higher than others.
fn has_pictures(seen: &PaneInput<'_>, row: &QueryCondition) -> bool {
    match row {
        QueryCondition::Said(value, _) => has_pictures(seen, value),
        QueryCondition::Values(ConditionSubject::Component(field), how, values) => {
            let shown = !matches!(how, ConditionRelation::Has | ConditionRelation::Missing(_)) && !values.is_empty();
            shown && query_field_inventory(seen, field).is_some()
        }
        _ => false,
    }
}

/// Returns whether a row has all its values.
fn is_complete(row: &QueryCondition) -> bool {
    match row {
        QueryCondition::Values(_, how, values) => {
            matches!(how, ConditionRelation::Has | ConditionRelation::Missing(_)) || !values.is_empty()
        }
        QueryCondition::Words(_, values) => !values.is_empty(),
        QueryCondition::Said(value, _) => is_complete(value),
        _ => true,
    }
}

/// Draws the button that adds a row; returns the new, incomplete row.
fn show_add_condition_button(ui: &mut Ui, seen: &PaneInput<'_>) -> Option<QueryCondition> {
    let mut added = None;
    ui.menu_button(seen.say_text(words::ADD), |ui| {
        let mut entry = |ui: &mut Ui, name: String, row: QueryCondition| {
            if ui.button(name).clicked() {
                added = Some(row);
                ui.close();
            }
        };
        let mut fields: Vec<ComponentField> = SignComponent::ALL_COMPONENTS.map(ComponentField::new).to_vec();
        for it in &seen.snapshot.overview.inventories {
            let field = it.inventory.inventory_field();
            if !fields.contains(&field) {
                fields.push(field);
            }
        }
        let order = |field: &ComponentField| SignComponent::ALL_COMPONENTS.iter().position(|c| *c == field.component);
        fields.sort_by_key(order);
        eframe::egui::ScrollArea::vertical().max_height(420.0).show(ui, |ui| {
            for field in fields {
                let name = field_text(&field, seen);
                let subject = ConditionSubject::Component(field);
                entry(
                    ui,
                    name,
                    QueryCondition::Values(subject, ConditionRelation::Is, Vec::new()),
                );
            }
            ui.separator();
            for (text, name) in [
                (TextField::Gloss, words::GLOSS),
                (TextField::Translation, words::TRANSLATION),
                (TextField::Comment, words::COMMENT),
            ] {
                let row = QueryCondition::Words(text, Vec::new());
                entry(ui, seen.say_text(name).to_owned(), row);
            }
            let most = QueryCondition::Time(TimeField::Duration, TimeTest::AtMost(1_000_000));
            entry(ui, seen.say_text(words::DURATION).to_owned(), most);
            for (property, name) in PROPERTY_TEXTS {
                let subject = ConditionSubject::Property(property);
                let row = QueryCondition::Values(subject, ConditionRelation::Is, Vec::new());
                entry(ui, seen.say_text(name).to_owned(), row);
            }
        });
    });
    added
}

const PROPERTY_TEXTS: [(WholeTokenProperty, InterfaceText); 14] = [
    (WholeTokenProperty::Origin, words::ORIGIN),
    (WholeTokenProperty::Signer, words::SIGNER),
    (WholeTokenProperty::Recording, words::RECORDING),
    (WholeTokenProperty::Hand, words::HAND),
    (WholeTokenProperty::Sign, words::SIGN),
    (WholeTokenProperty::Tier, words::TIER),
    (WholeTokenProperty::Inventory, words::INVENTORY),
    (WholeTokenProperty::Lexicon, words::LEXICON),
    (WholeTokenProperty::Language, words::SIGN_LANGUAGE),
    (WholeTokenProperty::File, words::FILE),
    (WholeTokenProperty::Token, words::TOKEN),
    (WholeTokenProperty::Proposed, words::PROPOSED),
    (WholeTokenProperty::Disputed, words::DISPUTED),
    (WholeTokenProperty::By, words::CODED_BY),
];

/// Returns the name of a component.
pub(crate) fn component_text(component: SignComponent) -> InterfaceText {
    match component {
        SignComponent::Configuration => words::CONFIGURATION,
        SignComponent::Placement => words::PLACEMENT,
        SignComponent::Movement => words::MOVEMENT,
        SignComponent::Orientation => words::ORIENTATION,
        SignComponent::NonManual => words::NONMANUAL,
    }
}

/// Features of components that have a name in words.
const FEATURE_TEXTS: [(&str, InterfaceText); 18] = [
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
    let entry = FEATURE_TEXTS.iter().find(|(other, _)| *other == feature);
    entry.map_or(feature, |(_, text)| seen.say_text(*text))
}

/// Returns the name of a field without its hand and phase.
pub(crate) fn field_text(field: &ComponentField, seen: &PaneInput<'_>) -> String {
    let component = seen.say_text(component_text(field.component));
    match &field.feature {
        Some(feature) => format!("{component} · {}", feature_text(feature, seen)),
        None => component.to_owned(),
    }
}

fn show_condition_row(
    ui: &mut Ui,
    rows: &mut ConditionRows,
    seen: &PaneInput<'_>,
    at: usize,
    condition: &mut QueryCondition,
    examples: &KnownExamples,
) {
    match condition {
        QueryCondition::Values(subject, how, values) => {
            let name = subject_ui(ui, seen, subject);
            how_ui(ui, seen, how, &name);
            if !matches!(how, ConditionRelation::Has | ConditionRelation::Missing(_)) {
                values_ui(ui, rows, seen, at, subject, &name, values);
            }
        }
        QueryCondition::Words(field, values) => {
            let name = seen.say_text(match field {
                TextField::Any => words::ANY_TEXT,
                TextField::Gloss => words::GLOSS,
                TextField::Translation => words::TRANSLATION,
                TextField::Comment => words::COMMENT,
            });
            ui.label(name);
            ui.weak(seen.say_text(words::CONTAINS));
            text_ui(ui, rows, at, values, name);
        }
        QueryCondition::Time(field, test) => {
            ui.label(seen.say_text(match field {
                TimeField::Duration => words::DURATION,
                TimeField::Start => words::START,
                TimeField::End => words::END,
            }));
            time_ui(ui, test);
        }
        QueryCondition::Like(example, weights, above) => {
            like_ui(ui, seen, examples.find_known_example(example, seen), weights, above);
        }
        QueryCondition::Said(value, sources) => {
            show_condition_row(ui, rows, seen, at, value, examples);
            ui.weak(seen.say_text(words::VALUE_SAID));
            ui.end_row();
            let mut gone = None;
            ui.vertical(|ui| {
                for (place, source) in sources.iter_mut().enumerate() {
                    ui.push_id(place, |ui| {
                        ui.horizontal(|ui| {
                            // Texts that are being typed are kept by row, and no other row has this number.
                            let row = (at + 1) * MAX_SHOWN_ROWS + place;
                            show_condition_row(ui, rows, seen, row, source, examples);
                            if ui.small_button("−").clicked() {
                                gone = Some(place);
                            }
                        });
                    });
                }
            });
            if let Some(place) = gone {
                sources.remove(place);
            }
        }
        QueryCondition::Written(QueryExpression::Test(QueryTest {
            what:
                TestSubject::Attribute(
                    name,
                    AttributeTest::Number(Bound::Included(least) | Bound::Excluded(least), Bound::Unbounded),
                ),
            ..
        })) => {
            ui.label(format!("{name} >"));
            let field = ui.add(DragValue::new(least).speed(0.01).max_decimals(3));
            let now = *least;
            field.widget_info(|| WidgetInfo::slider(true, now, &*name));
        }
        QueryCondition::Written(expr) => {
            ui.label(RichText::new(expr.to_string()).monospace());
            ui.weak(RichText::new(seen.say_text(words::AS_WRITTEN)).small());
        }
    }
}

/// Draws the subject of a row with its hand and phase; returns the subject's name.
fn subject_ui(ui: &mut Ui, seen: &PaneInput<'_>, subject: &mut ConditionSubject) -> String {
    let field = match subject {
        ConditionSubject::Component(field) => field,
        ConditionSubject::Property(property) => {
            let entry = PROPERTY_TEXTS.iter().find(|(other, _)| other == property);
            let name = entry.map_or(property.property_name(), |(_, name)| seen.say_text(*name));
            ui.label(name);
            return name.to_owned();
        }
        ConditionSubject::Text(text) => {
            let name = match text {
                TextField::Gloss => seen.say_text(words::GLOSS),
                TextField::Translation => seen.say_text(words::TRANSLATION),
                TextField::Comment => seen.say_text(words::COMMENT),
                TextField::Any => seen.say_text(words::ANY_TEXT),
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
                let all = std::iter::once(None).chain(HandRef::ALL_HAND_REFS.map(Some));
                for hand in all {
                    ui.selectable_value(&mut field.hand, hand, hand_text(hand, seen));
                }
            });
    }
    ui.label(&name);
    if let Some(phase) = field.phase {
        let weak = match phase {
            SignPhase::Initial => seen.say_text(words::INITIAL).to_owned(),
            SignPhase::Final => seen.say_text(words::FINAL).to_owned(),
            middle @ SignPhase::Middle(_) => middle.to_string(),
        };
        ui.weak(weak);
    }
    name
}

fn hand_text(hand: Option<HandRef>, seen: &PaneInput<'_>) -> &'static str {
    seen.say_text(match hand {
        None => words::EITHER,
        Some(HandRef::Right) => words::RIGHT,
        Some(HandRef::Left) => words::LEFT,
        Some(HandRef::Dominant) => words::DOMINANT,
        Some(HandRef::Weak) => words::WEAK,
    })
}

fn how_text(how: ConditionRelation) -> InterfaceText {
    match how {
        ConditionRelation::Is => words::IS,
        ConditionRelation::IsNot => words::IS_NOT,
        ConditionRelation::Exactly => words::EXACTLY,
        ConditionRelation::NotAtAll => words::NOT_AT_ALL,
        ConditionRelation::Has => words::HAS,
        ConditionRelation::Missing(MissingReason::Unset) => words::UNSET,
        ConditionRelation::Missing(MissingReason::NotApplicable) => words::NOT_APPLICABLE,
        ConditionRelation::Missing(MissingReason::Unclear) => words::UNCLEAR,
    }
}

fn how_ui(ui: &mut Ui, seen: &PaneInput<'_>, how: &mut ConditionRelation, _name: &str) {
    ComboBox::from_id_salt("how")
        .selected_text(seen.say_text(how_text(*how)))
        .width(10.0)
        .show_ui(ui, |ui| {
            let missing = MissingReason::ALL_MISSING_REASONS.map(ConditionRelation::Missing);
            let all = [
                ConditionRelation::Is,
                ConditionRelation::IsNot,
                ConditionRelation::Exactly,
                ConditionRelation::NotAtAll,
                ConditionRelation::Has,
            ];
            for it in all.into_iter().chain(missing) {
                ui.selectable_value(how, it, seen.say_text(how_text(it)));
            }
        });
}

fn query_field_inventory<'a>(seen: &'a PaneInput<'_>, field: &ComponentField) -> Option<&'a ComponentInventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|stored| &stored.inventory)
        .find(|inventory| inventory.component == field.component && inventory.feature == field.feature)
}

fn values_ui(
    ui: &mut Ui,
    rows: &mut ConditionRows,
    seen: &PaneInput<'_>,
    at: usize,
    subject: &ConditionSubject,
    name: &str,
    values: &mut Vec<TextPattern>,
) {
    let inventory = match subject {
        ConditionSubject::Component(field) => query_field_inventory(seen, field),
        ConditionSubject::Property(property) => {
            let offered: Vec<&str> = match property {
                WholeTokenProperty::Signer => {
                    let all = seen.snapshot.overview.signers.iter();
                    all.map(|signer| signer.name.as_str()).collect()
                }
                WholeTokenProperty::Lexicon => {
                    let all = seen.snapshot.overview.lexicons.iter();
                    all.map(|lexicon| lexicon.name.as_str()).collect()
                }
                other => other.fixed_values().unwrap_or_default().to_vec(),
            };
            if !offered.is_empty() {
                return choice_ui(ui, seen, &offered, values);
            }
            None
        }
        ConditionSubject::Text(_) => None,
    };
    let Some(inventory) = inventory else {
        return text_ui(ui, rows, at, values, name);
    };
    let several = values.len() > 1;
    let mut gone = None;
    for (place, value) in values.iter_mut().enumerate() {
        let label = fill_text_braces(seen.say_text(words::VALUE), &[("field", &name), ("n", &(at + 1))]);
        let picker = rows.pickers.entry((at, place)).or_default();
        let now = format_query_pattern(value);
        if let Some(picked) = pickers::show_picker_button(ui, picker, seen, inventory, Some(&now), &label) {
            *value = TextPattern::literal_pattern(picked);
        }
        if several && ui.small_button("−").clicked() {
            gone = Some(place);
        }
    }
    if let Some(place) = gone {
        values.remove(place);
    }
    if values.is_empty() || rows.more == Some(at) {
        let label = fill_text_braces(seen.say_text(words::PICK), &[("field", &name)]);
        let picker = rows.pickers.entry((at, values.len())).or_default();
        if let Some(picked) = pickers::show_picker_button(ui, picker, seen, inventory, None, &label) {
            values.push(TextPattern::literal_pattern(picked));
        }
    } else if ui.small_button(seen.say_text(words::OR)).clicked() {
        rows.more = Some(at);
    }
}

/// Draws a choice among a few values.
fn choice_ui(ui: &mut Ui, seen: &PaneInput<'_>, offered: &[&str], values: &mut Vec<TextPattern>) {
    let now: Vec<String> = values.iter().map(format_query_pattern).collect();
    let called = |id: &str| match origin_named(id) {
        Some(text) => seen.say_text(text).to_owned(),
        None => id.to_owned(),
    };
    let shown = if now.is_empty() {
        seen.say_text(crate::words::pickers::CHOOSE).to_owned()
    } else {
        let names: Vec<String> = now.iter().map(|id| called(id)).collect();
        names.join(", ")
    };
    ComboBox::from_id_salt("choice").selected_text(shown).show_ui(ui, |ui| {
        for it in offered {
            let chosen = now.iter().any(|value| value == it);
            if ui.add(Button::selectable(chosen, called(it))).clicked() {
                *values = vec![TextPattern::literal_pattern(*it)];
            }
        }
    });
}

/// Draws values as text, which is read when it is entered or left.
fn text_ui(ui: &mut Ui, rows: &mut ConditionRows, at: usize, values: &mut Vec<TextPattern>, name: &str) {
    let written_values: Vec<String> = values.iter().map(format_query_pattern).collect();
    let now = written_values.join(", ");
    let text = rows.typing.entry(at).or_insert_with(|| now.clone());
    let before = text.clone();
    let shown = script_edit::draw_text_line(ui, text, |field| field.desired_width(150.0));
    let response = shown.response.response;
    if rows.begun.take_if(|begun_row| *begun_row == at).is_some() {
        response.request_focus();
    }
    let shown = text.clone();
    response.widget_info(|| WidgetInfo {
        label: Some(name.to_owned()),
        ..WidgetInfo::text_edit(true, &before, &shown, "")
    });
    if response.lost_focus() {
        let typed_parts = text.split(',').map(str::trim).filter(|part| !part.is_empty());
        let typed: Vec<TextPattern> = typed_parts.map(TextPattern::from_glob).collect();
        if typed != *values && !typed.is_empty() {
            *values = typed;
        }
    }
    if !response.has_focus() {
        rows.typing.remove(&at);
    }
}

fn time_ui(ui: &mut Ui, test: &mut TimeTest) {
    const TIME_COMPARISON_SIGNS: [&str; 5] = ["<", "≤", ">", "≥", "…"];
    let (kind, least, most) = match *test {
        TimeTest::Below(most) => (0, 0, most),
        TimeTest::AtMost(most) => (1, 0, most),
        TimeTest::Above(least) => (2, least, least),
        TimeTest::AtLeast(least) => (3, least, least),
        TimeTest::Between(least, most) => (4, least, most),
    };
    let mut now = kind;
    ComboBox::from_id_salt("time")
        .selected_text(TIME_COMPARISON_SIGNS[kind])
        .width(10.0)
        .show_ui(ui, |ui| {
            for (at, name) in TIME_COMPARISON_SIGNS.iter().enumerate() {
                ui.selectable_value(&mut now, at, *name);
            }
        });
    let time_drag = |ui: &mut Ui, micros: i64| {
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
        low = time_drag(ui, least);
    }
    if now < 2 || now == 4 {
        high = time_drag(ui, most);
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
    example: Option<TokenSign>,
    weights: &mut [f64; 5],
    above: &mut Option<f64>,
) {
    let example = example.unwrap_or_default();
    if let Some((recording, span)) = example.place {
        let size = Vec2::splat(EXAMPLE_PICTURE_SIZE_POINTS);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let motion = MiniatureMotion::Span(recording, span);
        let cell = MiniatureCell::new(motion, size).with_playing_clock(miniatures::figure_loop_clock(ui));
        seen.little.paint_figure(ui, seen.language, seen.out, &cell, rect);
    }
    let name = match example.gloss.as_str() {
        "" => "…",
        gloss => gloss,
    };
    ui.vertical(|ui| {
        ui.label(fill_text_braces(seen.say_text(words::LIKE), &[("example", &name)]));
        let before = *weights;
        for (component, weight) in SignComponent::ALL_COMPONENTS.into_iter().zip(weights.iter_mut()) {
            let name = seen.say_text(component_text(component));
            let slider = Slider::new(weight, 0.0..=4.0).step_by(0.5).text(name);
            ui.add(slider);
        }
        let mut least = above.unwrap_or(0.0) * 100.0;
        let plain_slider = Slider::new(&mut least, 0.0..=95.0).step_by(5.0);
        let slider = plain_slider.suffix(" %").text(seen.say_text(words::LEAST_ALIKE));
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
