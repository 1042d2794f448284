//! Widgets for the settings of operators with several settings.

use chereme_corpus::recipe::{
    Choice, Configure, Degrees, Direction, Factor, Goal, HandPoint, Length, Orient, Pace, Place,
    Retime, Seconds, Turn,
};
use chereme_sign::Component;
use eframe::egui::{Id, Ui};

use super::fields::{self, caption, choose};
use super::settings::{At, line, transition};
use super::{path, spots};
use crate::context::PaneInput;
use crate::words::recombine as words;

#[derive(Clone, Copy, PartialEq)]
enum ChoiceKind {
    Value,
    From,
    Keep,
    Best,
}

fn choice(ui: &mut Ui, seen: &PaneInput<'_>, id: Id, value: &mut Choice) -> bool {
    let mut kind = match value {
        Choice::Value(_) => ChoiceKind::Value,
        Choice::From(_) => ChoiceKind::From,
        Choice::Keep => ChoiceKind::Keep,
        Choice::Best(_) => ChoiceKind::Best,
    };
    let all = [
        (ChoiceKind::Value, seen.say(words::CHOICE_VALUE)),
        (ChoiceKind::From, seen.say(words::FROM_SIGN)),
        (ChoiceKind::Best, seen.say(words::CHOICE_BEST)),
        (ChoiceKind::Keep, seen.say(words::CHOICE_KEEP)),
    ];
    let mut changed = choose(ui, seen.say(words::WHERE_FROM), &mut kind, &all);
    if changed {
        *value = match kind {
            ChoiceKind::Value => Choice::Value(String::new()),
            ChoiceKind::From => Choice::From(String::new()),
            ChoiceKind::Best => Choice::Best("configuration=U signer=same".into()),
            ChoiceKind::Keep => Choice::Keep,
        };
    }
    match value {
        Choice::Value(text) => {
            changed |= fields::of_inventory(ui, seen, id, Component::Configuration, text);
        }
        Choice::From(text) => {
            changed |= fields::sign(ui, seen, id, seen.say(words::FROM_SIGN), text);
        }
        Choice::Best(text) => changed |= line(ui, seen.say(words::CHOICE_BEST), "", text),
        Choice::Keep => {}
    }
    changed
}

pub(super) fn configure(ui: &mut Ui, seen: &PaneInput<'_>, at: At, it: &mut Configure) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = it.values.len() > 1;
    for (nth, value) in it.values.iter_mut().enumerate() {
        ui.push_id(nth, |ui| {
            ui.horizontal_wrapped(|ui| {
                if nth == 0 {
                    changed |= fields::hands(ui, seen, &mut it.hand, true);
                }
                if several {
                    ui.weak(format!("{}.", nth + 1));
                }
                changed |= choice(ui, seen, at.id.with(nth), value);
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say(words::REMOVE))
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
        return changed | transition(ui, seen, at, &mut it.via);
    }
    ui.horizontal_wrapped(|ui| {
        let more = ui.small_button(seen.say(words::ANOTHER_SHAPE));
        if more
            .on_hover_text(seen.say(words::ANOTHER_SHAPE_TIP))
            .clicked()
        {
            it.values.push(Choice::Keep);
            changed = true;
        }
    });
    changed | transition(ui, seen, at, &mut it.via)
}

#[derive(Clone, Copy, PartialEq)]
enum GoalKind {
    By,
    At,
    Point,
    Near,
}

pub(super) fn place(ui: &mut Ui, seen: &PaneInput<'_>, at: At, it: &mut Place) -> bool {
    let mut kind = match it.to {
        Goal::By(_) => GoalKind::By,
        Goal::At(_) | Goal::Best(_) => GoalKind::At,
        Goal::AtPoint(_) => GoalKind::Point,
        Goal::Near { .. } => GoalKind::Near,
    };
    let all = [
        (GoalKind::By, seen.say(words::GOAL_BY)),
        (GoalKind::At, seen.say(words::SPOT_VALUE)),
        (GoalKind::Point, seen.say(words::SPOT_POINT)),
        (GoalKind::Near, seen.say(words::GOAL_NEAR)),
    ];
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        changed |= fields::hands(ui, seen, &mut it.hand, true);
        if choose(ui, seen.say(words::WHERE_TO), &mut kind, &all) {
            it.to = match kind {
                GoalKind::By => Goal::By(path::legs_of([0.0, 0.1, 0.0])),
                GoalKind::At => Goal::At(String::new()),
                GoalKind::Point => Goal::AtPoint([0.0, 1.2, 0.4].map(Length::Metres)),
                GoalKind::Near => Goal::Near {
                    of: String::new(),
                    by: Vec::new(),
                },
            };
            changed = true;
        }
    });
    match &mut it.to {
        Goal::By(legs) => changed |= path::offset(ui, seen, legs),
        Goal::At(text) => {
            changed |= fields::of_inventory(ui, seen, at.id, Component::Placement, text);
        }
        Goal::AtPoint(point) => changed |= spots::point(ui, seen, point),
        Goal::Near { of, by } => {
            changed |= fields::sign(ui, seen, at.id, seen.say(words::FROM_SIGN), of);
            changed |= path::offset(ui, seen, by);
        }
        Goal::Best(_) => {}
    }
    if matches!(it.to, Goal::By(_)) || !(at.whole || it.with.is_some()) {
        return changed;
    }
    ui.horizontal_wrapped(|ui| {
        caption(ui, seen, words::WITH);
        let points = [
            (None, words::PALM),
            (Some(HandPoint::Wrist), words::WRIST),
            (Some(HandPoint::Thumb), words::THUMB),
            (Some(HandPoint::Index), words::INDEX),
            (Some(HandPoint::Middle), words::MIDDLE),
            (Some(HandPoint::Ring), words::RING),
            (Some(HandPoint::Little), words::LITTLE),
        ];
        let points = points.map(|(point, text)| (point, seen.say(text)));
        let mut with = it.with.filter(|it| *it != HandPoint::Palm);
        if choose(ui, seen.say(words::WITH), &mut with, &points) {
            it.with = with;
            changed = true;
        }
    });
    changed
}

pub(super) fn orient(ui: &mut Ui, seen: &PaneInput<'_>, it: &mut Orient) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| changed |= fields::hands(ui, seen, &mut it.hand, true));
    for (text, value) in [
        (words::PALM, &mut it.palm),
        (words::FINGERS, &mut it.fingers),
    ] {
        caption(ui, seen, text);
        changed |= ui
            .push_id(text.en, |ui| {
                fields::directions(ui, seen, seen.say(text), value)
            })
            .inner;
    }
    let mut gone = None;
    for (at, turn) in it.by.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                let Degrees(angle) = &mut turn.angle;
                changed |= fields::slide(ui, seen.say(words::TURN), angle, -180.0..=180.0, "°");
                caption(ui, seen, words::ABOUT);
                let all = Direction::ALL.map(|it| (it, seen.say(fields::direction_text(it))));
                changed |= choose(ui, seen.say(words::ABOUT), &mut turn.about, &all);
                if ui
                    .small_button("×")
                    .on_hover_text(seen.say(words::REMOVE))
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
    if ui.small_button(seen.say(words::ADD_TURN)).clicked() {
        let (angle, about) = (Degrees(30.0), Direction::Up);
        it.by.push(Turn { angle, about });
        changed = true;
    }
    changed
}

pub(super) fn retime(ui: &mut Ui, seen: &PaneInput<'_>, it: &mut Retime) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = it.paces.len() > 1;
    let kinds = [
        (false, seen.say(words::PACE_TIMES)),
        (true, seen.say(words::PACE_TO)),
    ];
    for (at, pace) in it.paces.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            ui.horizontal_wrapped(|ui| {
                if several {
                    ui.weak(format!("{}.", at + 1));
                }
                let mut to = matches!(pace, Pace::To(_));
                if choose(ui, seen.say(words::PACE), &mut to, &kinds) {
                    *pace = if to {
                        Pace::To(Seconds(1.0))
                    } else {
                        Pace::Times(Factor(1.5))
                    };
                    changed = true;
                }
                let name = seen.say(words::PACE);
                changed |= match pace {
                    Pace::Times(Factor(by)) => fields::slide(ui, name, by, 0.25..=4.0, "×"),
                    Pace::To(Seconds(to)) => fields::slide(ui, name, to, 0.1..=5.0, " s"),
                };
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say(words::REMOVE))
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
    let more = ui.small_button(seen.say(words::ANOTHER_PHASE));
    if more
        .on_hover_text(seen.say(words::ANOTHER_PHASE_TIP))
        .clicked()
    {
        it.paces.push(Pace::Times(Factor(1.0)));
        changed = true;
    }
    changed
}
