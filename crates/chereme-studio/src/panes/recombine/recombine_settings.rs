//! Widgets for the settings of each source and operator; a setting without a widget is a line of its text.

use chereme_corpus::recipe::{
    BUILT_IN_BODY, CueSettings, FieldSetting, HandChoice, OperatorField, PhaseRule, PlacementGoal, PostureTransition,
    Recipe, RecipeFactor, RecipeNode, SpellSettings, Step,
};
use eframe::egui::{DragValue, Id, Role, Ui, WidgetInfo};

use super::recombine_fields::{self, show_field_caption, show_value_choice};
use super::stack::CardContent;
use super::{operators, recombine_face, recombine_path, spots};
use crate::context::PaneInput;
use crate::panes::button_width;
use crate::pickers::{board, pickers_hamnosys};
use crate::script::script_edit;
use crate::words::recombine_words as words;

/// The card whose settings are shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct SettingsCard {
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
pub(super) fn show_card_settings(ui: &mut Ui, seen: &PaneInput<'_>, at: SettingsCard, what: &mut CardContent) -> bool {
    match what {
        CardContent::Source { via, node } => {
            let mut changed = show_source_settings(ui, seen, at, node);
            changed |= !at.first && show_card_transition(ui, seen, at, via);
            changed
        }
        CardContent::Step(step) => show_operator_settings(ui, seen, at, step),
    }
}

/// Shows a transition if it differs from the default, or if all settings are shown.
pub(super) fn show_card_transition(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    at: SettingsCard,
    via: &mut PostureTransition,
) -> bool {
    (at.whole || !via.is_default()) && recombine_fields::show_transition_field(ui, seen, via)
}

fn show_source_settings(ui: &mut Ui, seen: &PaneInput<'_>, at: SettingsCard, node: &mut RecipeNode) -> bool {
    match node {
        RecipeNode::Sign(name) => {
            recombine_fields::show_sign_field(ui, seen, at.id, seen.say_text(words::SIGN_NAME), name)
        }
        RecipeNode::Spell(it) => show_spell_settings(ui, seen, at, it),
        RecipeNode::Point(it) => {
            let mut changed = false;
            ui.horizontal_wrapped(|ui| {
                changed |= recombine_fields::show_hands_choice(ui, seen, &mut it.hand, true);
                show_field_caption(ui, seen, words::POINT_AT);
                changed |= spots::show_spot_field(ui, seen, at.id, seen.say_text(words::POINT_AT), &mut it.at);
            });
            ui.horizontal_wrapped(|ui| {
                changed |= recombine_fields::show_time_field(ui, seen, words::HOLD, &mut it.hold, 0.3);
                changed |= recombine_fields::show_signer_choice(ui, seen, &mut it.on);
            });
            changed
        }
        RecipeNode::Cue(it) => show_cue_source_settings(ui, seen, it),
        RecipeNode::Hamnosys(it) => {
            let mut changed = false;
            ui.horizontal(|ui| {
                let button = button_width(ui, seen.say_text(crate::words::hamnosys_words::BOARD));
                let width = ui.available_width() - button - 3.0 * ui.spacing().item_spacing.x;
                let name = seen.say_text(words::HAMNOSYS_SYMBOLS);
                changed |= wide_line(ui, name, "", width, &mut it.of);
                changed |= board::draw_symbol_board_button(ui, seen, &mut it.of);
            });
            pickers_hamnosys::of_text(ui, seen, &it.of, pickers_hamnosys::DEFAULT_SYMBOL_EM_POINTS);
            ui.horizontal_wrapped(|ui| changed |= recombine_fields::show_signer_choice(ui, seen, &mut it.on));
            changed
        }
        RecipeNode::Sigml(it) => {
            let mut changed =
                recombine_fields::show_sign_field(ui, seen, at.id, seen.say_text(words::SIGML_NAME), &mut it.of);
            ui.horizontal_wrapped(|ui| changed |= recombine_fields::show_signer_choice(ui, seen, &mut it.on));
            changed
        }
        RecipeNode::Pipe(_) | RecipeNode::Then(_) => {
            let text = node.to_string();
            as_text(ui, seen, at.id, &text, |typed| {
                let recipe: Recipe = typed.parse().ok()?;
                *node = recipe.recipe_root().clone();
                Some(())
            })
        }
    }
}

pub(super) fn show_recipe_text_line(ui: &mut Ui, name: &str, hint: &str, text: &mut String) -> bool {
    let width = (ui.available_width() - 8.0).min(260.0);
    wide_line(ui, name, hint, width, text)
}

/// Shows a line of that width, in points.
fn wide_line(ui: &mut Ui, name: &str, hint: &str, width: f32, text: &mut String) -> bool {
    let field = script_edit::draw_text_line(ui, text, |field| field.hint_text(hint).desired_width(width));
    let response = field.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    if recombine_fields::takes_focus(ui) {
        response.request_focus();
    }
    response.changed()
}

fn show_cue_source_settings(ui: &mut Ui, seen: &PaneInput<'_>, it: &mut CueSettings) -> bool {
    let (name, hint) = (seen.say_text(words::CUE_TEXT), seen.say_text(words::CUE_HINT));
    let mut changed = show_recipe_text_line(ui, name, hint, &mut it.text);
    ui.horizontal_wrapped(|ui| {
        for (hand, word) in [
            (HandChoice::Dominant, words::CUE_OWN_HAND),
            (HandChoice::Left, words::CUE_LEFT),
            (HandChoice::Right, words::CUE_RIGHT),
        ] {
            changed |= ui.selectable_value(&mut it.hand, hand, seen.say_text(word)).changed();
        }
    });
    ui.horizontal_wrapped(|ui| {
        show_field_caption(ui, seen, words::CUE_PHASES);
        for rule in PhaseRule::ALL_PHASE_RULES {
            changed |= ui
                .selectable_value(&mut it.phase, rule, rule.phase_rule_name())
                .changed();
        }
    });
    ui.horizontal_wrapped(|ui| {
        show_field_caption(ui, seen, words::CUE_PACE);
        let mut pace = it.pace.map_or(1.6, |pace| pace.0);
        let slider = DragValue::new(&mut pace).range(0.5..=4.0).speed(0.02);
        if ui.add(slider).changed() {
            it.pace = Some(RecipeFactor(pace));
            changed = true;
        }
        changed |= recombine_fields::show_signer_choice(ui, seen, &mut it.on);
    });
    changed
}

fn show_spell_settings(ui: &mut Ui, seen: &PaneInput<'_>, at: SettingsCard, it: &mut SpellSettings) -> bool {
    let mut changed = show_recipe_text_line(
        ui,
        seen.say_text(words::LETTERS),
        seen.say_text(words::LETTERS_HINT),
        &mut it.word,
    );
    ui.horizontal_wrapped(|ui| {
        changed |= recombine_fields::show_hands_choice(ui, seen, &mut it.hand, true);
        let alphabets: Vec<String> = seen
            .snapshot
            .overview
            .inventories
            .iter()
            .filter(|stored| stored.inventory.values.iter().any(|value| value.letter.is_some()))
            .map(|stored| stored.inventory.id.clone())
            .collect();
        let mut nth = it
            .alphabet
            .as_ref()
            .map(|id| alphabets.iter().position(|alphabet| alphabet == id));
        if nth != Some(None) && !alphabets.is_empty() {
            let all: Vec<(Option<Option<usize>>, &str)> = [(None, seen.say_text(words::ANY_ALPHABET))]
                .into_iter()
                .chain(
                    alphabets
                        .iter()
                        .enumerate()
                        .map(|(at, id)| (Some(Some(at)), id.as_str())),
                )
                .collect();
            if show_value_choice(ui, seen.say_text(words::ALPHABET), &mut nth, &all) {
                it.alphabet = nth.flatten().map(|nth| alphabets[nth].clone());
                changed = true;
            }
        }
        changed |= recombine_fields::show_time_field(ui, seen, words::HOLD, &mut it.hold, 0.2);
        changed |= recombine_fields::show_signer_choice(ui, seen, &mut it.on);
    });
    changed | show_card_transition(ui, seen, at, &mut it.via)
}

/// Shows a part of a recipe as text; `take` receives typed text that can be read.
fn as_text(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, text: &str, mut take: impl FnMut(&str) -> Option<()>) -> bool {
    let mut typed: String = ui.data(|data| data.get_temp(id)).unwrap_or_else(|| text.to_owned());
    let field = script_edit::draw_text_block(ui, &mut typed, |field| {
        field.desired_rows(1).desired_width(f32::INFINITY).id(id)
    });
    let response = field.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, seen.say_text(words::TEXT)));
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
        let RecipeNode::Pipe(pipe) = recipe.recipe_root() else {
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
fn show_operator_settings(ui: &mut Ui, seen: &PaneInput<'_>, at: SettingsCard, step: &mut Step) -> bool {
    match step {
        Step::Configure(it) => return operators::show_configure_settings(ui, seen, at, it),
        Step::Place(it) if !matches!(it.to, PlacementGoal::Best(_)) => {
            return operators::show_place_settings(ui, seen, at, it);
        }
        Step::Orient(it) => return operators::show_orient_settings(ui, seen, it),
        Step::Travel(it) => {
            let mut changed = false;
            ui.horizontal_wrapped(|ui| changed |= recombine_fields::show_hands_choice(ui, seen, &mut it.hand, true));
            changed |= recombine_path::show_travel_path(ui, seen, at.id, at.card, it);
            return changed | show_card_transition(ui, seen, at, &mut it.via);
        }
        Step::Retime(it) => return operators::show_retime_settings(ui, seen, it),
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
fn by_fields(ui: &mut Ui, seen: &PaneInput<'_>, at: SettingsCard, all: Vec<FieldSetting<'_>>) -> bool {
    let mut changed = false;
    let mut below = Vec::new();
    ui.horizontal_wrapped(|ui| {
        for setting in all {
            let text = setting.label;
            changed |= match setting.field {
                OperatorField::Hands(hands) => recombine_fields::show_hands_choice(ui, seen, hands, true),
                OperatorField::Hand(hand) => {
                    show_field_caption(ui, seen, text);
                    recombine_fields::show_hands_choice(ui, seen, hand, false)
                }
                OperatorField::Count(count, range) => {
                    recombine_fields::show_repetition_count(ui, seen.say_text(text), count, range)
                }
                OperatorField::Factor(by, range) => {
                    recombine_fields::show_number_slider(ui, seen.say_text(text), &mut by.0, range, "×")
                }
                OperatorField::OptionalFactor(by, usual) => {
                    recombine_fields::show_factor_field(ui, seen, text, by, usual)
                }
                OperatorField::Body(body) => {
                    let mut chosen = Some(std::mem::take(body));
                    let changed = recombine_fields::show_signer_choice(ui, seen, &mut chosen);
                    *body = chosen.unwrap_or_else(|| BUILT_IN_BODY.to_owned());
                    changed
                }
                OperatorField::Time(time, usual) => recombine_fields::show_time_field(ui, seen, text, time, usual),
                OperatorField::Length(..)
                | OperatorField::Directions(_)
                | OperatorField::Spot(_)
                | OperatorField::Sign(_)
                | OperatorField::Face(_)
                | OperatorField::Via(_) => {
                    below.push(setting);
                    false
                }
            };
        }
    });
    for FieldSetting { label, field } in below {
        let text = seen.say_text(label);
        let row = ui.push_id(label.text_id(), |ui| match field {
            OperatorField::Length(length, most) => {
                let line = ui.horizontal_wrapped(|ui| {
                    show_field_caption(ui, seen, label);
                    recombine_fields::show_length_field(ui, seen, text, length, most * 100.0)
                });
                line.inner
            }
            OperatorField::Directions(all) => {
                show_field_caption(ui, seen, label);
                recombine_fields::show_direction_switches(ui, seen, text, all)
            }
            OperatorField::Spot(spot) => spots::optional_spot(ui, seen, at.id.with(label.text_id()), label, spot),
            OperatorField::Sign(name) => recombine_fields::show_sign_field(ui, seen, at.id, text, name),
            OperatorField::Face(show) => recombine_face::show_face_parts(ui, seen, at.id, show),
            OperatorField::Via(via) => show_card_transition(ui, seen, at, via),
            _ => false,
        });
        changed |= row.inner;
    }
    changed
}
