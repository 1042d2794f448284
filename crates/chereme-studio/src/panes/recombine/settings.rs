//! Widgets for the settings of each source and operator; a setting without a widget is a line of its text.

use chereme_corpus::recipe::{
    Cue, Factor, Field, FieldSetting, Goal, Hands, Node, PhaseRule, Recipe, Spell, Step, Transition,
};
use eframe::egui::{DragValue, Id, Role, Ui, WidgetInfo};

use super::fields::{self, caption, choose};
use super::stack::What;
use super::{operators, path, spots};
use crate::context::PaneInput;
use crate::panes::button_width;
use crate::pickers::{board, hamnosys};
use crate::script::edit;
use crate::words::recombine as words;

/// The card whose settings are shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    /// The widget id of the card.
    pub(super) id: Id,
    /// The id of the card in the stack.
    pub(super) card: u64,
    /// Whether it is the first card.
    pub(super) first: bool,
    /// Whether to show all settings, not only the important ones.
    pub(super) whole: bool,
}

/// Shows the settings of a card; returns whether the user changed one.
pub(super) fn show(ui: &mut Ui, seen: &PaneInput<'_>, at: At, what: &mut What) -> bool {
    match what {
        What::Source { via, node } => {
            let mut changed = source(ui, seen, at, node);
            changed |= !at.first && transition(ui, seen, at, via);
            changed
        }
        What::Step(step) => operator(ui, seen, at, step),
    }
}

/// Shows a transition if it differs from the default, or if all settings are shown.
pub(super) fn transition(ui: &mut Ui, seen: &PaneInput<'_>, at: At, via: &mut Transition) -> bool {
    (at.whole || !via.is_default()) && fields::transition(ui, seen, via)
}

fn source(ui: &mut Ui, seen: &PaneInput<'_>, at: At, node: &mut Node) -> bool {
    match node {
        Node::Sign(name) => fields::sign(ui, seen, at.id, seen.say(words::SIGN_NAME), name),
        Node::Spell(it) => spell(ui, seen, at, it),
        Node::Point(it) => {
            let mut changed = false;
            ui.horizontal_wrapped(|ui| {
                changed |= fields::hands(ui, seen, &mut it.hand, true);
                caption(ui, seen, words::POINT_AT);
                changed |= spots::spot(ui, seen, at.id, seen.say(words::POINT_AT), &mut it.at);
            });
            ui.horizontal_wrapped(|ui| {
                changed |= fields::time(ui, seen, words::HOLD, &mut it.hold, 0.3);
                changed |= fields::signer(ui, seen, &mut it.on);
            });
            changed
        }
        Node::Cue(it) => cue(ui, seen, it),
        Node::Hamnosys(it) => {
            let mut changed = false;
            ui.horizontal(|ui| {
                let button = button_width(ui, seen.say(crate::words::hamnosys::BOARD));
                let width = ui.available_width() - button - 3.0 * ui.spacing().item_spacing.x;
                let name = seen.say(words::HAMNOSYS_SYMBOLS);
                changed |= wide_line(ui, (name, ""), width, &mut it.of);
                changed |= board::button(ui, seen, &mut it.of);
            });
            hamnosys::of_text(ui, seen, &it.of, hamnosys::EM);
            ui.horizontal_wrapped(|ui| changed |= fields::signer(ui, seen, &mut it.on));
            changed
        }
        Node::Sigml(it) => {
            let mut changed =
                fields::sign(ui, seen, at.id, seen.say(words::SIGML_NAME), &mut it.of);
            ui.horizontal_wrapped(|ui| changed |= fields::signer(ui, seen, &mut it.on));
            changed
        }
        Node::Pipe(_) | Node::Then(_) => {
            let text = node.to_string();
            as_text(ui, seen, at.id, &text, |typed| {
                let recipe: Recipe = typed.parse().ok()?;
                *node = recipe.root().clone();
                Some(())
            })
        }
    }
}

pub(super) fn line(ui: &mut Ui, name: &str, hint: &str, text: &mut String) -> bool {
    let width = (ui.available_width() - 8.0).min(260.0);
    wide_line(ui, (name, hint), width, text)
}

/// Shows a line of that width, in points.
fn wide_line(ui: &mut Ui, (name, hint): (&str, &str), width: f32, text: &mut String) -> bool {
    let field = edit::line(ui, text, |field| field.hint_text(hint).desired_width(width));
    let response = field.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    if fields::takes_focus(ui) {
        response.request_focus();
    }
    response.changed()
}

fn cue(ui: &mut Ui, seen: &PaneInput<'_>, it: &mut Cue) -> bool {
    let (name, hint) = (seen.say(words::CUE_TEXT), seen.say(words::CUE_HINT));
    let mut changed = line(ui, name, hint, &mut it.text);
    ui.horizontal_wrapped(|ui| {
        for (hand, word) in [
            (Hands::Dominant, words::CUE_OWN_HAND),
            (Hands::Left, words::CUE_LEFT),
            (Hands::Right, words::CUE_RIGHT),
        ] {
            changed |= ui
                .selectable_value(&mut it.hand, hand, seen.say(word))
                .changed();
        }
    });
    ui.horizontal_wrapped(|ui| {
        caption(ui, seen, words::CUE_PHASES);
        for rule in PhaseRule::ALL {
            changed |= ui
                .selectable_value(&mut it.phase, rule, rule.name())
                .changed();
        }
    });
    ui.horizontal_wrapped(|ui| {
        caption(ui, seen, words::CUE_PACE);
        let mut pace = it.pace.map_or(1.6, |pace| pace.0);
        let slider = DragValue::new(&mut pace).range(0.5..=4.0).speed(0.02);
        if ui.add(slider).changed() {
            it.pace = Some(Factor(pace));
            changed = true;
        }
        changed |= fields::signer(ui, seen, &mut it.on);
    });
    changed
}

fn spell(ui: &mut Ui, seen: &PaneInput<'_>, at: At, it: &mut Spell) -> bool {
    let mut changed = line(
        ui,
        seen.say(words::LETTERS),
        seen.say(words::LETTERS_HINT),
        &mut it.word,
    );
    ui.horizontal_wrapped(|ui| {
        changed |= fields::hands(ui, seen, &mut it.hand, true);
        let alphabets: Vec<String> = seen
            .snapshot
            .overview
            .inventories
            .iter()
            .filter(|it| {
                it.inventory
                    .values
                    .iter()
                    .any(|value| value.letter.is_some())
            })
            .map(|it| it.inventory.id.clone())
            .collect();
        let mut nth = it
            .alphabet
            .as_ref()
            .map(|id| alphabets.iter().position(|it| it == id));
        if nth != Some(None) && !alphabets.is_empty() {
            let all: Vec<(Option<Option<usize>>, &str)> = [(None, seen.say(words::ANY_ALPHABET))]
                .into_iter()
                .chain(
                    alphabets
                        .iter()
                        .enumerate()
                        .map(|(at, id)| (Some(Some(at)), id.as_str())),
                )
                .collect();
            if choose(ui, seen.say(words::ALPHABET), &mut nth, &all) {
                it.alphabet = nth.flatten().map(|nth| alphabets[nth].clone());
                changed = true;
            }
        }
        changed |= fields::time(ui, seen, words::HOLD, &mut it.hold, 0.2);
        changed |= fields::signer(ui, seen, &mut it.on);
    });
    changed | transition(ui, seen, at, &mut it.via)
}

/// Shows a part of a recipe as text; `take` receives typed text that can be read.
fn as_text(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    text: &str,
    mut take: impl FnMut(&str) -> Option<()>,
) -> bool {
    let mut typed: String = ui
        .data(|data| data.get_temp(id))
        .unwrap_or_else(|| text.to_owned());
    let field = edit::block(ui, &mut typed, |field| {
        field.desired_rows(1).desired_width(f32::INFINITY).id(id)
    });
    let response = field.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say(words::TEXT)));
    let mut changed = false;
    if response.changed() {
        changed = take(&typed).is_some();
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, typed));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    changed
}

/// Shows a step as text.
fn step_as_text(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, step: &mut Step) -> bool {
    let text = step.to_string();
    as_text(ui, seen, id, &text, |typed| {
        let recipe: Recipe = format!("x | {typed}").parse().ok()?;
        let Node::Pipe(pipe) = recipe.root() else {
            return None;
        };
        match pipe.steps.as_slice() {
            [one] => {
                *step = one.clone();
                Some(())
            }
            _ => None,
        }
    })
}

/// Shows the settings of an operator: in a special form if it has one, else as the usual fields of its settings, else
/// as text.
fn operator(ui: &mut Ui, seen: &PaneInput<'_>, at: At, step: &mut Step) -> bool {
    match step {
        Step::Configure(it) => return operators::configure(ui, seen, at, it),
        Step::Place(it) if !matches!(it.to, Goal::Best(_)) => {
            return operators::place(ui, seen, at, it);
        }
        Step::Orient(it) => return operators::orient(ui, seen, it),
        Step::Travel(it) => {
            let mut changed = false;
            ui.horizontal_wrapped(|ui| changed |= fields::hands(ui, seen, &mut it.hand, true));
            changed |= path::show(ui, seen, (at.id, at.card), it);
            return changed | transition(ui, seen, at, &mut it.via);
        }
        Step::Retime(it) => return operators::retime(ui, seen, it),
        _ => {}
    }
    let has_settings = step.to_string() != step.name();
    let fields = step.fields();
    match (fields.is_empty(), has_settings) {
        (false, _) => by_fields(ui, seen, at, fields),
        (true, true) => step_as_text(ui, seen, at.id, step),
        (true, false) => false,
    }
}

/// Shows settings one after another: first those that share a line.
fn by_fields(ui: &mut Ui, seen: &PaneInput<'_>, at: At, all: Vec<FieldSetting<'_>>) -> bool {
    let mut changed = false;
    let mut below = Vec::new();
    ui.horizontal_wrapped(|ui| {
        for setting in all {
            let text = setting.label;
            changed |= match setting.field {
                Field::Hands(hands) => fields::hands(ui, seen, hands, true),
                Field::Hand(hand) => {
                    caption(ui, seen, text);
                    fields::hands(ui, seen, hand, false)
                }
                Field::Count(count, range) => fields::count(ui, seen.say(text), count, range),
                Field::Factor(by, range) => {
                    fields::slide(ui, seen.say(text), &mut by.0, range, "×")
                }
                Field::OptionalFactor(by, usual) => fields::factor(ui, seen, text, by, usual),
                Field::Time(time, usual) => fields::time(ui, seen, text, time, usual),
                Field::Length(..)
                | Field::Directions(_)
                | Field::Spot(_)
                | Field::Sign(_)
                | Field::Via(_) => {
                    below.push(setting);
                    false
                }
            };
        }
    });
    for FieldSetting { label, field } in below {
        let text = seen.say(label);
        let row = ui.push_id(label.en, |ui| match field {
            Field::Length(length, most) => {
                let line = ui.horizontal_wrapped(|ui| {
                    caption(ui, seen, label);
                    fields::length(ui, seen, text, length, most * 100.0)
                });
                line.inner
            }
            Field::Directions(all) => {
                caption(ui, seen, label);
                fields::directions(ui, seen, text, all)
            }
            Field::Spot(spot) => spots::optional_spot(ui, seen, at.id.with(label.en), label, spot),
            Field::Sign(name) => fields::sign(ui, seen, at.id, text, name),
            Field::Via(via) => transition(ui, seen, at, via),
            _ => false,
        });
        changed |= row.inner;
    }
    changed
}
