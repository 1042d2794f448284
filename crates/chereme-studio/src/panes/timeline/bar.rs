//! The tools above the ruler: modes, snapping, lanes, tiers.

use std::collections::BTreeSet;

use chereme_corpus::{RowName, TierScheme};
use eframe::egui::{Button, Color32, ScrollArea, TextStyle, Ui};

use super::timeline_edit::TimelineScene;
use super::timeline_rows::{build_timeline_rows, hidden_count};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::settings::timeline_settings::TimelineSettings;
use crate::words::{InterfaceText, fill_text_braces, timeline as words};
use crate::work::editing;

/// The greatest height of the list of recordings, in points.
const MAX_RECORDING_LIST_POINTS: f32 = 300.0;

/// The gap between tools, in points.
const TIMELINE_TOOL_GAP_POINTS: f32 = 3.0;

const TIMELINE_MODE_ACTIONS: [(Action, InterfaceText); 3] = [
    (Action::ModeNormal, words::NORMAL),
    (Action::ModeBulldozer, words::BULLDOZER),
    (Action::ModeShift, words::SHIFT),
];
const SNAP_MODE_ACTIONS: [(Action, InterfaceText); 3] = [
    (Action::SnapFrames, words::FRAMES),
    (Action::SnapBoundaries, words::BOUNDARIES),
    (Action::SnapMinima, words::MINIMA),
];

/// Returns the name of the current mode, for the status line.
pub(crate) fn mode_name(settings: &TimelineSettings) -> InterfaceText {
    let on = TIMELINE_MODE_ACTIONS.iter().find(|(action, _)| settings.is_on(*action));
    on.map_or(words::NORMAL, |(_, text)| *text)
}

pub(super) fn show_timeline_bar(ui: &mut Ui, scene: &TimelineScene<'_>) {
    let seen = scene.seen;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = TIMELINE_TOOL_GAP_POINTS;
        let tiers_title = tiers_title(scene);
        let spare = ui.available_width() - timeline_tools_width(ui, seen, &tiers_title);
        // In a narrow window each group of switches is a menu.
        if spare >= 0.0 {
            for (action, text) in TIMELINE_MODE_ACTIONS {
                show_tool_switch(ui, seen, action, text);
            }
            ui.separator();
            if spare >= tool_button_width(ui, seen.say_text(words::SNAPS_TO)) {
                ui.weak(seen.say_text(words::SNAPS_TO));
            }
            for (action, text) in SNAP_MODE_ACTIONS {
                show_tool_switch(ui, seen, action, text);
            }
            ui.separator();
        } else {
            show_tool_menu(
                ui,
                seen,
                seen.say_text(mode_name(&seen.settings.timeline)),
                &TIMELINE_MODE_ACTIONS,
            );
            show_tool_menu(ui, seen, seen.say_text(words::SNAP), &SNAP_MODE_ACTIONS);
        }
        let mut lanes = vec![(Action::Overview, words::LANES)];
        lanes.extend(super::timeline_lanes::CURVE_LANES.map(|(_, action, text)| (action, text)));
        show_tool_menu(ui, seen, seen.say_text(words::LANES), &lanes);
        show_tiers_menu(ui, scene, tiers_title);
        ui.spacing_mut().item_spacing.x = 8.0;
        let chosen = seen.shown.annotations.len();
        if chosen > 1 {
            ui.weak(fill_text_braces(
                seen.say_text(words::SELECTED_COUNT),
                &[("n", &chosen)],
            ));
        }
    });
}

/// Returns the width that the tools need with a button for every switch, in points.
fn timeline_tools_width(ui: &Ui, seen: &PaneInput<'_>, tiers_title: &str) -> f32 {
    let switches = TIMELINE_MODE_ACTIONS
        .iter()
        .chain(&SNAP_MODE_ACTIONS)
        .map(|(_, text)| seen.say_text(*text));
    let all = switches.chain([seen.say_text(words::LANES), tiers_title]);
    let buttons = all.map(|text| tool_button_width(ui, text)).sum::<f32>();
    // Two separators stand between them.
    buttons + 2.0 * (6.0 + TIMELINE_TOOL_GAP_POINTS)
}

/// Returns the width of a button with that text and of the gap beside it.
fn tool_button_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    galley.size().x + 2.0 * ui.spacing().button_padding.x + TIMELINE_TOOL_GAP_POINTS
}

fn show_tool_switch(ui: &mut Ui, seen: &PaneInput<'_>, action: Action, text: InterfaceText) {
    let on = seen.settings.timeline.is_on(action);
    let button = ui.add(Button::selectable(on, seen.say_text(text)));
    let keys = seen.keys.action_keys_text(action);
    let about = format!("{}  {keys}", seen.say_text(action.action_row().name));
    if button.on_hover_text(about).clicked() {
        seen.send_command(WindowCommand::Do(action));
    }
}

fn show_tool_menu(ui: &mut Ui, seen: &PaneInput<'_>, title: &str, rows: &[(Action, InterfaceText)]) {
    ui.menu_button(title, |ui| {
        for (action, _) in rows {
            let on = seen.settings.timeline.is_on(*action);
            let button = Button::selectable(on, seen.say_text(action.action_row().name))
                .shortcut_text(seen.keys.action_keys_text(*action));
            if ui.add(button).clicked() {
                seen.send_command(WindowCommand::Do(*action));
            }
        }
    });
}

/// Returns how many tiers are hidden.
fn hidden(scene: &TimelineScene<'_>) -> usize {
    let settings = &scene.seen.settings.timeline;
    hidden_count(&scene.contents.tiers, &settings.hidden)
}

fn tiers_title(scene: &TimelineScene<'_>) -> String {
    match hidden(scene) {
        0 => scene.seen.say_text(words::TIERS).to_owned(),
        n => fill_text_braces(scene.seen.say_text(words::TIERS_HIDDEN), &[("n", &n)]),
    }
}

fn show_tiers_menu(ui: &mut Ui, scene: &TimelineScene<'_>, title: String) {
    let seen = scene.seen;
    let hidden = hidden(scene);
    ui.menu_button(title, |ui| {
        show_menu_actions(ui, seen, &[Action::AddTier, Action::UsualTiers]);
        show_copy_tiers_menu(ui, scene);
        show_menu_actions(ui, seen, &[Action::TiersByName, Action::TiersByKind]);
        ui.separator();
        show_menu_actions(ui, seen, &[Action::HideEmptyTiers]);
        if hidden > 0 {
            show_menu_actions(ui, seen, &[Action::ShowTiers]);
        }
        show_tier_visibility(ui, scene);
    });
}

/// Shows a list of all tiers with their visibility, which can be changed.
fn show_tier_visibility(ui: &mut Ui, scene: &TimelineScene<'_>) {
    let settings = &scene.seen.settings.timeline;
    let none = BTreeSet::new();
    let all = build_timeline_rows(&scene.contents.tiers, &none, &none);
    ScrollArea::vertical()
        .max_height(MAX_RECORDING_LIST_POINTS)
        .show(ui, |ui| {
            for row in all {
                let name = &scene.contents.tiers[row.tier].row.name;
                let mut is_shown = !settings.hidden.contains(name);
                ui.horizontal(|ui| {
                    ui.add_space(12.0 * row.depth as f32);
                    if ui.checkbox(&mut is_shown, name).changed() {
                        let mut settings = settings.clone();
                        super::timeline_view_settings::toggle_in_set(&mut settings.hidden, name.clone());
                        super::timeline_view_settings::change_timeline_settings(scene.seen, settings);
                    }
                });
            }
        });
}

/// Shows the menu of recordings whose tiers can be copied to this one.
pub(super) fn show_copy_tiers_menu(ui: &mut Ui, scene: &TimelineScene<'_>) {
    let here = scene.contents.recording.id;
    let recordings = &scene.seen.snapshot.overview.recordings;
    let mut others = recordings
        .iter()
        .filter(|glance| glance.tiers > 0 && glance.row.id != here)
        .peekable();
    if others.peek().is_none() {
        return;
    }
    ui.menu_button(scene.seen.say_text(words::TIERS_LIKE), |ui| {
        ScrollArea::vertical()
            .max_height(MAX_RECORDING_LIST_POINTS)
            .show(ui, |ui| {
                for other in others {
                    let name = other.row.name.as_str();
                    if ui
                        .add(Button::new(name).shortcut_text(other.tiers.to_string()))
                        .clicked()
                    {
                        let scheme = TierScheme::Like(RowName::Number(other.row.id));
                        scene
                            .seen
                            .request_work(editing::add_tiers(RowName::Number(here), scheme));
                        ui.close();
                    }
                }
            });
    });
}

/// Shows actions as the entries of a menu.
pub(super) fn show_menu_actions(ui: &mut Ui, seen: &PaneInput<'_>, all: &[Action]) {
    for action in all {
        let button =
            Button::new(seen.say_text(action.action_row().name)).shortcut_text(seen.keys.action_keys_text(*action));
        let locked = action.changes_corpus() && seen.snapshot.is_read_only();
        let button = ui.add_enabled(!locked, button);
        let why = seen.say_text(crate::words::shell::READ_ONLY_WHY);
        if button.on_disabled_hover_text(why).clicked() {
            seen.send_command(WindowCommand::Do(*action));
            ui.close();
        }
    }
}
