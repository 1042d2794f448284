//! The tools above the ruler: modes, snapping, lanes, tiers.

use std::collections::BTreeSet;

use chereme_corpus::{Name, Scheme};
use eframe::egui::{Button, Color32, ScrollArea, TextStyle, Ui};

use super::edit::Scene;
use super::rows::{hidden_count, rows};
use super::view_settings::TimelineSettings;
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::words::{Text, fill, timeline as words};
use crate::work::editing;

/// The greatest height of the list of recordings, in points.
const LIKE: f32 = 300.0;

/// The gap between tools, in points.
const GAP: f32 = 3.0;

const MODES: [(Action, Text); 3] = [
    (Action::ModeNormal, words::NORMAL),
    (Action::ModeBulldozer, words::BULLDOZER),
    (Action::ModeShift, words::SHIFT),
];
const SNAPS: [(Action, Text); 3] = [
    (Action::SnapFrames, words::FRAMES),
    (Action::SnapBoundaries, words::BOUNDARIES),
    (Action::SnapMinima, words::MINIMA),
];

/// Returns the name of the current mode, for the status line.
pub(crate) fn mode_name(settings: &TimelineSettings) -> Text {
    let on = MODES.iter().find(|(action, _)| settings.is_on(*action));
    on.map_or(words::NORMAL, |(_, text)| *text)
}

pub(super) fn show(ui: &mut Ui, scene: &Scene<'_>, out: &mut Outbox) {
    let seen = scene.seen;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        let tiers_title = tiers_title(scene);
        let spare = ui.available_width() - wanted(ui, seen, &tiers_title);
        if spare >= 0.0 {
            for (action, text) in MODES {
                switch(ui, seen, (action, text), out);
            }
            ui.separator();
            if spare >= width(ui, seen.say(words::SNAPS_TO)) {
                ui.weak(seen.say(words::SNAPS_TO));
            }
            for (action, text) in SNAPS {
                switch(ui, seen, (action, text), out);
            }
            ui.separator();
        } else {
            menu(
                ui,
                seen,
                seen.say(mode_name(&seen.settings.timeline)),
                &MODES,
                out,
            );
            menu(ui, seen, seen.say(words::SNAP), &SNAPS, out);
        }
        let mut lanes = vec![(Action::Overview, words::LANES)];
        lanes.extend(super::lanes::Lane::ALL.map(|(_, action, text)| (action, text)));
        menu(ui, seen, seen.say(words::LANES), &lanes, out);
        tiers(ui, scene, tiers_title, out);
        ui.spacing_mut().item_spacing.x = 8.0;
        let chosen = seen.shown.annotations.len();
        if chosen > 1 {
            ui.weak(fill(seen.say(words::SELECTED_COUNT), &[("n", &chosen)]));
        }
    });
}

/// Returns the width that the tools need with a button for every switch, in points.
fn wanted(ui: &Ui, seen: &PaneInput<'_>, tiers_title: &str) -> f32 {
    let switches = MODES.iter().chain(&SNAPS).map(|(_, text)| seen.say(*text));
    let all = switches.chain([seen.say(words::LANES), tiers_title]);
    let buttons = all.map(|text| width(ui, text)).sum::<f32>();
    // Two separators stand between them.
    buttons + 2.0 * (6.0 + GAP)
}

/// Returns the width of a button with that text and of the gap beside it.
fn width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    galley.size().x + 2.0 * ui.spacing().button_padding.x + GAP
}

fn switch(ui: &mut Ui, seen: &PaneInput<'_>, (action, text): (Action, Text), out: &mut Outbox) {
    let on = seen.settings.timeline.is_on(action);
    let button = ui.add(Button::selectable(on, seen.say(text)));
    let keys = seen.keys.text(action);
    let about = format!("{}  {keys}", seen.say(action.row().name));
    if button.on_hover_text(about).clicked() {
        out.send(Command::Do(action));
    }
}

fn menu(ui: &mut Ui, seen: &PaneInput<'_>, title: &str, rows: &[(Action, Text)], out: &mut Outbox) {
    ui.menu_button(title, |ui| {
        for (action, _) in rows {
            let on = seen.settings.timeline.is_on(*action);
            let button = Button::selectable(on, seen.say(action.row().name))
                .shortcut_text(seen.keys.text(*action));
            if ui.add(button).clicked() {
                out.send(Command::Do(*action));
            }
        }
    });
}

/// Returns how many tiers are hidden.
fn hidden(scene: &Scene<'_>) -> usize {
    let settings = &scene.seen.settings.timeline;
    hidden_count(&scene.contents.tiers, &settings.hidden)
}

fn tiers_title(scene: &Scene<'_>) -> String {
    match hidden(scene) {
        0 => scene.seen.say(words::TIERS).to_owned(),
        n => fill(scene.seen.say(words::TIERS_HIDDEN), &[("n", &n)]),
    }
}

fn tiers(ui: &mut Ui, scene: &Scene<'_>, title: String, out: &mut Outbox) {
    let seen = scene.seen;
    let hidden = hidden(scene);
    ui.menu_button(title, |ui| {
        actions(ui, seen, &[Action::AddTier, Action::UsualTiers], out);
        like(ui, scene, out);
        actions(ui, seen, &[Action::TiersByName, Action::TiersByKind], out);
        ui.separator();
        actions(ui, seen, &[Action::HideEmptyTiers], out);
        if hidden > 0 {
            actions(ui, seen, &[Action::ShowTiers], out);
        }
        shown(ui, scene, out);
    });
}

/// Shows a list of all tiers with their visibility, which can be changed.
fn shown(ui: &mut Ui, scene: &Scene<'_>, out: &mut Outbox) {
    let settings = &scene.seen.settings.timeline;
    let none = BTreeSet::new();
    let all = rows(&scene.contents.tiers, &none, &none);
    ScrollArea::vertical().max_height(LIKE).show(ui, |ui| {
        for row in all {
            let name = &scene.contents.tiers[row.tier].row.name;
            let mut is_shown = !settings.hidden.contains(name);
            ui.horizontal(|ui| {
                ui.add_space(12.0 * row.depth as f32);
                if ui.checkbox(&mut is_shown, name).changed() {
                    let mut settings = settings.clone();
                    super::view_settings::toggle(&mut settings.hidden, name.clone());
                    super::view_settings::change(scene.seen, out, settings);
                }
            });
        }
    });
}

/// Shows the menu of recordings whose tiers can be copied to this one.
pub(super) fn like(ui: &mut Ui, scene: &Scene<'_>, out: &mut Outbox) {
    let here = scene.contents.recording.id;
    let recordings = &scene.seen.snapshot.overview.recordings;
    let mut others = recordings
        .iter()
        .filter(|it| it.tiers > 0 && it.row.id != here)
        .peekable();
    if others.peek().is_none() {
        return;
    }
    ui.menu_button(scene.seen.say(words::TIERS_LIKE), |ui| {
        ScrollArea::vertical().max_height(LIKE).show(ui, |ui| {
            for other in others {
                let name = other.row.name.as_str();
                if ui
                    .add(Button::new(name).shortcut_text(other.tiers.to_string()))
                    .clicked()
                {
                    let scheme = Scheme::Like(Name::Number(other.row.id));
                    out.work(editing::add_tiers(Name::Number(here), scheme));
                    ui.close();
                }
            }
        });
    });
}

/// Shows actions as the entries of a menu.
pub(super) fn actions(ui: &mut Ui, seen: &PaneInput<'_>, all: &[Action], out: &mut Outbox) {
    for action in all {
        let button =
            Button::new(seen.say(action.row().name)).shortcut_text(seen.keys.text(*action));
        let locked = action.changes() && seen.snapshot.is_read_only();
        let button = ui.add_enabled(!locked, button);
        let why = seen.say(crate::words::shell::READ_ONLY_WHY);
        if button.on_disabled_hover_text(why).clicked() {
            out.send(Command::Do(*action));
            ui.close();
        }
    }
}
