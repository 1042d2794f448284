//! Widgets for the settings of operators with several settings.

use crate::model::model_handle::legs_of;
use chereme_corpus::recipe::{
    AxisTurn, BodyDirection, ConfigureSettings, OrientSettings, PlaceSettings, PlacementGoal, RecipeDegrees,
    RecipeFactor, RecipeHandPoint, RecipeLength, RecipeSeconds, RetimePace, RetimeSettings, ValueChoice,
};
use chereme_sign::SignComponent;
use eframe::egui::{Id, Ui};

use super::recombine_fields::{self, show_field_caption, show_value_choice};
use super::recombine_settings::{SettingsCard, show_card_transition, show_recipe_text_line};
use super::{recombine_path, spots};
use crate::context::PaneInput;
use crate::words::recombine_words as words;

#[derive(Clone, Copy, PartialEq)]
enum ChoiceKind {
    Value,
    From,
    Keep,
    Best,
}

fn show_configuration_choice(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, value: &mut ValueChoice) -> bool {
    let mut kind = match value {
        ValueChoice::Value(_) => ChoiceKind::Value,
        ValueChoice::From(_) => ChoiceKind::From,
        ValueChoice::Keep => ChoiceKind::Keep,
        ValueChoice::Best(_) => ChoiceKind::Best,
    };
    let all = [
        (ChoiceKind::Value, seen.say_text(words::CHOICE_VALUE)),
        (ChoiceKind::From, seen.say_text(words::FROM_SIGN)),
        (ChoiceKind::Best, seen.say_text(words::CHOICE_BEST)),
        (ChoiceKind::Keep, seen.say_text(words::CHOICE_KEEP)),
    ];
    let mut changed = show_value_choice(ui, seen.say_text(words::WHERE_FROM), &mut kind, &all);
    if changed {
        *value = match kind {
            ChoiceKind::Value => ValueChoice::Value(String::new()),
            ChoiceKind::From => ValueChoice::From(String::new()),
            ChoiceKind::Best => ValueChoice::Best("configuration=U signer=same".into()),
            ChoiceKind::Keep => ValueChoice::Keep,
        };
    }
    match value {
        ValueChoice::Value(text) => {
            changed |= recombine_fields::of_inventory(ui, seen, id, SignComponent::Configuration, text);
        }
        ValueChoice::From(text) => {
            changed |= recombine_fields::show_sign_field(ui, seen, id, seen.say_text(words::FROM_SIGN), text);
        }
        ValueChoice::Best(text) => changed |= show_recipe_text_line(ui, seen.say_text(words::CHOICE_BEST), "", text),
        ValueChoice::Keep => {}
    }
    changed
}

pub(super) fn show_configure_settings(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    at: SettingsCard,
    it: &mut ConfigureSettings,
) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = it.values.len() > 1;
    for (nth, value) in it.values.iter_mut().enumerate() {
        ui.push_id(nth, |ui| {
            ui.horizontal_wrapped(|ui| {
                if nth == 0 {
                    changed |= recombine_fields::show_hands_choice(ui, seen, &mut it.hand, true);
                }
                if several {
                    ui.weak(format!("{}.", nth + 1));
                }
                changed |= show_configuration_choice(ui, seen, at.id.with(nth), value);
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say_text(words::REMOVE))
                        .clicked()
                {
                    gone = Some(nth);
                }
            });
        });
    }
    if let Some(nth) = gone {
        it.values.remove(nth);
        changed = true;
    }
    if !at.whole {
        return changed | show_card_transition(ui, seen, at, &mut it.via);
    }
    ui.horizontal_wrapped(|ui| {
        let more = ui.small_button(seen.say_text(words::ANOTHER_SHAPE));
        if more.on_hover_text(seen.say_text(words::ANOTHER_SHAPE_TIP)).clicked() {
            it.values.push(ValueChoice::Keep);
            changed = true;
        }
    });
    changed | show_card_transition(ui, seen, at, &mut it.via)
}

#[derive(Clone, Copy, PartialEq)]
enum GoalKind {
    By,
    At,
    Point,
    Near,
}

pub(super) fn show_place_settings(ui: &mut Ui, seen: &PaneInput<'_>, at: SettingsCard, it: &mut PlaceSettings) -> bool {
    let mut kind = match it.to {
        PlacementGoal::By(_) => GoalKind::By,
        PlacementGoal::At(_) | PlacementGoal::Best(_) => GoalKind::At,
        PlacementGoal::AtPoint(_) => GoalKind::Point,
        PlacementGoal::Near { .. } => GoalKind::Near,
    };
    let all = [
        (GoalKind::By, seen.say_text(words::GOAL_BY)),
        (GoalKind::At, seen.say_text(words::SPOT_VALUE)),
        (GoalKind::Point, seen.say_text(words::SPOT_POINT)),
        (GoalKind::Near, seen.say_text(words::GOAL_NEAR)),
    ];
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        changed |= recombine_fields::show_hands_choice(ui, seen, &mut it.hand, true);
        if show_value_choice(ui, seen.say_text(words::WHERE_TO), &mut kind, &all) {
            it.to = match kind {
                GoalKind::By => PlacementGoal::By(legs_of([0.0, 0.1, 0.0])),
                GoalKind::At => PlacementGoal::At(String::new()),
                GoalKind::Point => PlacementGoal::AtPoint([0.0, 1.2, 0.4].map(RecipeLength::Metres)),
                GoalKind::Near => PlacementGoal::Near {
                    of: String::new(),
                    by: Vec::new(),
                },
            };
            changed = true;
        }
    });
    match &mut it.to {
        PlacementGoal::By(legs) => changed |= recombine_path::show_offset_field(ui, seen, legs),
        PlacementGoal::At(text) => {
            changed |= recombine_fields::of_inventory(ui, seen, at.id, SignComponent::Placement, text);
        }
        PlacementGoal::AtPoint(point) => changed |= spots::show_point_field(ui, seen, point),
        PlacementGoal::Near { of, by } => {
            changed |= recombine_fields::show_sign_field(ui, seen, at.id, seen.say_text(words::FROM_SIGN), of);
            changed |= recombine_path::show_offset_field(ui, seen, by);
        }
        PlacementGoal::Best(_) => {}
    }
    if matches!(it.to, PlacementGoal::By(_)) || !(at.whole || it.with.is_some()) {
        return changed;
    }
    ui.horizontal_wrapped(|ui| {
        show_field_caption(ui, seen, words::WITH);
        let point_texts = [
            (None, words::PALM),
            (Some(RecipeHandPoint::Wrist), words::WRIST),
            (Some(RecipeHandPoint::Thumb), words::THUMB),
            (Some(RecipeHandPoint::Index), words::INDEX),
            (Some(RecipeHandPoint::Middle), words::MIDDLE),
            (Some(RecipeHandPoint::Ring), words::RING),
            (Some(RecipeHandPoint::Little), words::LITTLE),
        ];
        let points = point_texts.map(|(point, text)| (point, seen.say_text(text)));
        let mut with = it.with.filter(|point| *point != RecipeHandPoint::Palm);
        if show_value_choice(ui, seen.say_text(words::WITH), &mut with, &points) {
            it.with = with;
            changed = true;
        }
    });
    changed
}

pub(super) fn show_orient_settings(ui: &mut Ui, seen: &PaneInput<'_>, it: &mut OrientSettings) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| changed |= recombine_fields::show_hands_choice(ui, seen, &mut it.hand, true));
    for (text, value) in [(words::PALM, &mut it.palm), (words::FINGERS, &mut it.fingers)] {
        show_field_caption(ui, seen, text);
        changed |= ui
            .push_id(text.text_id(), |ui| {
                recombine_fields::show_direction_switches(ui, seen, seen.say_text(text), value)
            })
            .inner;
    }
    let mut gone = None;
    for (at, turn) in it.by.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                let RecipeDegrees(angle) = &mut turn.angle;
                changed |=
                    recombine_fields::show_number_slider(ui, seen.say_text(words::TURN), angle, -180.0..=180.0, "°");
                show_field_caption(ui, seen, words::ABOUT);
                let all = BodyDirection::ALL_BODY_DIRECTIONS
                    .map(|direction| (direction, seen.say_text(recombine_fields::direction_text(direction))));
                changed |= show_value_choice(ui, seen.say_text(words::ABOUT), &mut turn.about, &all);
                if ui
                    .small_button("×")
                    .on_hover_text(seen.say_text(words::REMOVE))
                    .clicked()
                {
                    gone = Some(at);
                }
            });
        });
    }
    if let Some(at) = gone {
        it.by.remove(at);
        changed = true;
    }
    if ui.small_button(seen.say_text(words::ADD_TURN)).clicked() {
        let (angle, about) = (RecipeDegrees(30.0), BodyDirection::Up);
        it.by.push(AxisTurn { angle, about });
        changed = true;
    }
    changed
}

pub(super) fn show_retime_settings(ui: &mut Ui, seen: &PaneInput<'_>, it: &mut RetimeSettings) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = it.paces.len() > 1;
    let kinds = [
        (false, seen.say_text(words::PACE_TIMES)),
        (true, seen.say_text(words::PACE_TO)),
    ];
    for (at, pace) in it.paces.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                if several {
                    ui.weak(format!("{}.", at + 1));
                }
                let mut to = matches!(pace, RetimePace::To(_));
                if show_value_choice(ui, seen.say_text(words::PACE), &mut to, &kinds) {
                    *pace = if to {
                        RetimePace::To(RecipeSeconds(1.0))
                    } else {
                        RetimePace::Times(RecipeFactor(1.5))
                    };
                    changed = true;
                }
                let name = seen.say_text(words::PACE);
                changed |= match pace {
                    RetimePace::Times(RecipeFactor(by)) => {
                        recombine_fields::show_number_slider(ui, name, by, 0.25..=4.0, "×")
                    }
                    RetimePace::To(RecipeSeconds(to)) => {
                        recombine_fields::show_number_slider(ui, name, to, 0.1..=5.0, " s")
                    }
                };
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say_text(words::REMOVE))
                        .clicked()
                {
                    gone = Some(at);
                }
            });
        });
    }
    if let Some(at) = gone {
        it.paces.remove(at);
        changed = true;
    }
    let more = ui.small_button(seen.say_text(words::ANOTHER_PHASE));
    if more.on_hover_text(seen.say_text(words::ANOTHER_PHASE_TIP)).clicked() {
        it.paces.push(RetimePace::Times(RecipeFactor(1.0)));
        changed = true;
    }
    changed
}
