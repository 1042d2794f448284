//! The windows above the panes: notices, the command palette, the keys, the settings.

pub(crate) mod notices;
pub(crate) mod overlay_export;
pub(crate) mod overlay_keys;
pub(crate) mod overlay_palette;
pub(crate) mod overlay_settings;
pub(crate) mod overlay_steps;
pub(crate) mod overlay_tiers;
pub(crate) mod overlay_trouble;
mod tier_round_form;
pub(crate) mod typed_path;

use eframe::egui::{Align2, Context, Id, Key, Modifiers, ScrollArea, Ui, Window};

/// All windows above the panes.
#[derive(Default)]
pub(crate) struct WindowOverlays {
    pub(crate) notices: notices::NoticeBoard,
    pub(crate) palette: overlay_palette::ActionPalette,
    pub(crate) keys: overlay_keys::KeysHelp,
    pub(crate) settings: overlay_settings::SettingsWindow,
    pub(crate) steps: overlay_steps::FirstSteps,
    pub(crate) export: overlay_export::ExportWindow,
    pub(crate) tiers: overlay_tiers::TierRoundWindow,
    pub(crate) typed_path: typed_path::TypedPath,
}

impl WindowOverlays {
    /// Returns whether one of them takes all keys now.
    pub(crate) fn takes_keys(&self) -> bool {
        self.palette.is_palette_open() || self.keys.is_listening()
    }
}

/// Shows a form in a window of its own, which scrolls if it is higher than the screen; returns whether it stays open.
fn show_form_window(ctx: &Context, title: &str, id: &str, form: impl FnOnce(&mut Ui)) -> bool {
    /// The height of the window's title and edges, in points.
    const FORM_HEAD_HEIGHT: f32 = 56.0;
    /// The width of the bar that scrolls, in points.
    const FORM_SCROLL_BAR_WIDTH: f32 = 10.0;
    const FORM_WIDTH: f32 = 440.0;
    let screen = ctx.content_rect();
    let mut open = true;
    let window = Window::new(title)
        .id(Id::unique(id))
        .open(&mut open)
        .pivot(Align2::CENTER_CENTER)
        .default_pos(screen.center())
        .default_width(FORM_WIDTH)
        .resizable(false);
    window.show(ctx, |ui| {
        ui.set_width(FORM_WIDTH.min(screen.width() - 60.0));
        let high = (screen.height() - FORM_HEAD_HEIGHT).max(120.0);
        // Without a least height the window would keep the height of the first form in it.
        let area = ScrollArea::vertical().auto_shrink([false, true]);
        let area = area.min_scrolled_height(high).max_height(high);
        area.show(ui, |ui| {
            // The bar that scrolls covers no field.
            ui.set_max_width(ui.available_width() - FORM_SCROLL_BAR_WIDTH);
            form(ui);
        });
    });
    open
}

/// Returns whether Escape was pressed, and removes it from the input.
fn take_escape_key(ctx: &Context) -> bool {
    ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
}
