//! The windows above the panes: notices, the command palette, the keys, the settings.

pub(crate) mod notices;
pub(crate) mod overlay_export;
pub(crate) mod overlay_keys;
pub(crate) mod overlay_palette;
pub(crate) mod overlay_settings;
pub(crate) mod overlay_steps;
pub(crate) mod overlay_trouble;
pub(crate) mod typed_path;

use eframe::egui::{Context, Key, Modifiers};

/// All windows above the panes.
#[derive(Default)]
pub(crate) struct WindowOverlays {
    pub(crate) notices: notices::NoticeBoard,
    pub(crate) palette: overlay_palette::ActionPalette,
    pub(crate) keys: overlay_keys::KeysHelp,
    pub(crate) settings: overlay_settings::SettingsWindow,
    pub(crate) steps: overlay_steps::FirstSteps,
    pub(crate) export: overlay_export::ExportWindow,
    pub(crate) typed_path: typed_path::TypedPath,
}

impl WindowOverlays {
    /// Returns whether one of them takes all keys now.
    pub(crate) fn takes_keys(&self) -> bool {
        self.palette.is_palette_open() || self.keys.is_listening()
    }
}

/// Returns whether Escape was pressed, and removes it from the input.
fn take_escape_key(ctx: &Context) -> bool {
    ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
}
