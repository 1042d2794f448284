//! The line above the stage: the number of views, the extras beside the signer, and the comparison with the original.

use eframe::egui::{
    Align, Button, DragValue, Label, Layout, Rect, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};

use super::StagePane;
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::settings::stage_settings::OriginalComparison;
use crate::words::{fill_text_braces, stage_words as words};

/// The width of a generated sign's name, in points.
const GENERATED_NAME_WIDTH_POINTS: f32 = 220.0;

/// Shows the switches for extras of the picture and for the number of views.
pub(super) fn show_stage_tools(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>) {
    ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
    ui.horizontal_wrapped(|ui| {
        for (count, text) in [(1, words::SPLIT_1), (2, words::SPLIT_2), (4, words::SPLIT_4)] {
            let keys = seen.keys.action_keys_text(Action::StageSplit);
            if split_button(ui, stage.eyes.len() == count, count, seen.say_text(text), &keys) {
                stage.split_stage_views(count);
                stage.asked = None;
            }
        }
        ui.add_space(6.0);
        let toggles = [
            (
                words::TRAILS,
                words::TRAILS_HINT,
                Action::StageTrails,
                stage.shows.trails.is_some(),
            ),
            (
                words::GHOSTS,
                words::GHOSTS_HINT,
                Action::StageGhosts,
                stage.shows.ghosts,
            ),
            (words::PLACES, words::PLACES_HINT, Action::StagePlaces, stage.places),
            (words::HANDS, words::HANDS_HINT, Action::StageHands, stage.insets.hands),
            (
                words::PALMS,
                words::PALMS_HINT,
                Action::StagePalms,
                stage.insets.hands && stage.insets.palms,
            ),
            (words::FACE, words::FACE_HINT, Action::StageFace, stage.insets.face),
            (words::GRID, words::GRID_HINT, Action::StageGrid, stage.shows.grid),
        ];
        for (text, hint, action, on) in toggles {
            let hint = format!("{} ({})", seen.say_text(hint), seen.keys.action_keys_text(action));
            let button = Button::selectable(on, seen.say_text(text));
            if ui.add(button).on_hover_text(hint).clicked() {
                seen.send_command(WindowCommand::Do(action));
            }
        }
        if stage.points.are_there() && stage.signer.is_some() {
            let points_button = Button::selectable(stage.shows.points, seen.say_text(words::POINTS));
            let button = ui.add(points_button).on_hover_text(seen.say_text(words::POINTS_HINT));
            if button.clicked() {
                stage.shows.points = !stage.shows.points;
                stage.asked = None;
            }
        }
        // This comes after all buttons, so that they keep their places when one is clicked.
        if stage.shows.trails.is_some() {
            show_trail_reach(stage, ui, seen);
        }
        if stage.original.is_there() {
            ui.add_space(6.0);
            show_comparison_choice(stage, ui, seen);
        }
        ui.add_space(6.0);
        ui.menu_button(seen.say_text(words::SHARE), |ui| {
            for action in [
                Action::ShareFilm,
                Action::ShareGif,
                Action::SharePicture,
                Action::ShareGlb,
            ] {
                if ui.button(seen.say_text(action.action_row().name)).clicked() {
                    seen.send_command(WindowCommand::Do(action));
                    ui.close();
                }
            }
        });
        if let Some(showing) = &seen.shown.made {
            ui.add_space(6.0);
            let keys = seen.keys.action_keys_text(Action::StageRecording);
            let back_text = match seen.shown.recording {
                Some(_) => words::BACK,
                None => words::PUT_AWAY,
            };
            let back = ui.small_button(seen.say_text(back_text)).on_hover_text(keys);
            if back.clicked() {
                seen.send_command(WindowCommand::Made(None));
            }
            let made_name = fill_text_braces(seen.say_text(words::MADE_OF), &[("name", &showing.made.name)]);
            let name = RichText::new(made_name).color(seen.pane_colours().accent);
            // The width is fixed, so that the stage keeps its place whatever the recipe.
            let size = vec2(GENERATED_NAME_WIDTH_POINTS, ui.spacing().interact_size.y);
            ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(size.x);
                ui.add(Label::new(name).truncate());
            });
        }
    });
    ui.add_space(4.0);
}

fn show_trail_reach(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let value = DragValue::new(&mut stage.reach)
        .range(0.1..=2.0)
        .speed(0.02)
        .fixed_decimals(1)
        .suffix(" s");
    let response = ui.add(value);
    let name = seen.say_text(words::REACH);
    let seconds = stage.reach;
    response.widget_info(|| WidgetInfo::slider(true, seconds, name));
    if response.on_hover_text(name).changed() {
        stage.shows.trails = Some(stage.reach);
    }
}

fn show_comparison_choice(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let keys = seen.keys.action_keys_text(Action::StageCompare);
    // The name is as high as the buttons after it, so that a row broken here stays aligned.
    let name = Button::new(RichText::new(seen.say_text(words::ORIGINAL_HOW)).weak()).frame(false);
    ui.add(name.sense(Sense::hover()));
    for mode in OriginalComparison::ALL_COMPARISONS {
        let text = match mode {
            OriginalComparison::Beside => words::BESIDE,
            OriginalComparison::Over => words::OVER,
            OriginalComparison::Alone => words::ALONE,
        };
        let hint = format!("{} ({keys})", seen.say_text(words::COMPARE));
        let button = Button::selectable(stage.compare == mode, seen.say_text(text));
        if ui.add(button).on_hover_text(hint).clicked() {
            stage.compare = mode;
            stage.asked = None;
        }
    }
}

/// Shows a button with a drawing of the stage divided into `count` panes.
fn split_button(ui: &mut Ui, on: bool, count: usize, name: &str, keys: &str) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(28.0, 24.0), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, name));
    let visuals = ui.style().interact_selectable(&response, on);
    let painter = ui.painter();
    if on || response.hovered() || response.has_focus() {
        let fill = visuals.weak_bg_fill;
        painter.rect(rect, 5.0, fill, visuals.bg_stroke, StrokeKind::Inside);
    }
    let screen = Rect::from_center_size(rect.center(), vec2(16.0, 12.0));
    let stroke = Stroke::new(1.2, visuals.text_color());
    painter.rect_stroke(screen, 1.5, stroke, StrokeKind::Middle);
    if count > 1 {
        painter.vline(screen.center().x, screen.y_range(), stroke);
    }
    if count > 2 {
        painter.hline(screen.x_range(), screen.center().y, stroke);
    }
    response.on_hover_text(format!("{name} ({keys})")).clicked()
}
