//! The settings: language, theme, scale.

use eframe::egui::{Align2, Context, DragValue, Grid, Id, Slider, Ui, Window};

use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::key_chord::DefaultKeymap;
use crate::player::SteppingSettings;
use crate::settings::{StudioSettings, ThemeChoice};
use crate::words::{InterfaceLanguage, shell as words};

/// The window with the settings.
#[derive(Debug, Default)]
pub(crate) struct SettingsWindow {
    open: bool,
    /// The scale while it is being dragged.
    scale: Option<f32>,
}

impl SettingsWindow {
    pub(crate) fn toggle_settings_window(&mut self) {
        self.open = !self.open;
    }

    pub(crate) fn ui(&mut self, ctx: &Context, settings: &StudioSettings, out: &CommandOutbox) {
        if !self.open {
            return;
        }
        let mut changed = settings.clone();
        let mut open = true;
        let language = settings.language;
        let window = Window::new(words::SETTINGS_TITLE.text_in_language(language))
            .id(Id::unique("settings"))
            .open(&mut open)
            .pivot(Align2::CENTER_CENTER)
            .default_pos(ctx.content_rect().center())
            .resizable(false);
        window.show(ctx, |ui| {
            Grid::new("settings")
                .num_columns(2)
                .spacing([16.0, 10.0])
                .show(ui, |ui| {
                    ui.label(words::LANGUAGE.text_in_language(language));
                    ui.horizontal(|ui| {
                        for (it, name) in InterfaceLanguage::all_listed() {
                            ui.selectable_value(&mut changed.language, it, name);
                        }
                    });
                    ui.end_row();
                    ui.label(words::THEME.text_in_language(language));
                    ui.horizontal(|ui| {
                        for (it, text) in [
                            (ThemeChoice::System, words::THEME_SYSTEM),
                            (ThemeChoice::Light, words::THEME_LIGHT),
                            (ThemeChoice::Dark, words::THEME_DARK),
                        ] {
                            ui.selectable_value(&mut changed.theme, it, text.text_in_language(language));
                        }
                    });
                    ui.end_row();
                    let label = ui.label(words::SCALE.text_in_language(language));
                    let mut scale = self.scale.unwrap_or(settings.scale);
                    let scale_slider = ui.add(Slider::new(&mut scale, 0.5..=3.0).step_by(0.1));
                    let slider = scale_slider.labelled_by(label.id);
                    self.scale = slider.dragged().then_some(scale);
                    if slider.drag_stopped() || (slider.changed() && !slider.dragged()) {
                        changed.scale = scale;
                    }
                    ui.end_row();
                    ui.label(words::KEYMAP.text_in_language(language));
                    ui.horizontal(|ui| {
                        for (it, text) in DefaultKeymap::ALL_KEYMAPS {
                            ui.selectable_value(&mut changed.keymap, it, text.text_in_language(language));
                        }
                    });
                    ui.end_row();
                    ui.label(Action::StepAndRepeat.action_row().name.text_in_language(language));
                    stepping(ui, language, &mut changed.stepping);
                    ui.end_row();
                });
        });
        if changed != *settings {
            out.send_command(WindowCommand::Settings(Box::new(changed)));
        }
        self.open = open && !super::take_escape_key(ctx);
    }
}

/// Shows the settings of step-and-repeat playback.
fn stepping(ui: &mut Ui, language: InterfaceLanguage, how: &mut SteppingSettings) {
    let values = [
        (words::STEP_PIECE, &mut how.piece, 0.2..=60.0),
        (words::STEP_BY, &mut how.step, 0.1..=60.0),
        (words::STEP_REST, &mut how.rest, 0.0..=10.0),
    ];
    Grid::new("stepping").num_columns(2).show(ui, |ui| {
        for (name, value, range) in values {
            let label = ui.label(name.text_in_language(language));
            let field = DragValue::new(value).range(range).speed(0.05).suffix(" s");
            ui.add(field.max_decimals(2)).labelled_by(label.id);
            ui.end_row();
        }
        let label = ui.label(words::STEP_TIMES.text_in_language(language));
        let field = DragValue::new(&mut how.times).range(1..=20).suffix(" ×");
        ui.add(field.speed(0.05)).labelled_by(label.id);
        ui.end_row();
    });
}
