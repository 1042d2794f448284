//! The panes in the window: their tabs, and what a strip of tabs without room for all of them offers.

use eframe::egui::output::OutputEvent;
use eframe::egui::{
    Frame, Id, Popup, Rect, Response, Role, Stroke, StrokeKind, Style, TextStyle, TextWrapMode, Ui, WidgetInfo,
    WidgetText,
};
use egui_tiles::{Behavior, SimplificationOptions, Tabs, Tile, TileId, Tiles, UiResponse};

use crate::context::PaneInput;
use crate::layout::PaneKind;
use crate::panes::{PaneSet, carry, focused_widget};
use crate::words::shell as words;

/// The panes, as drawn by the tile layout.
pub(crate) struct TileWorkbench<'a> {
    pub(crate) panes: &'a mut PaneSet,
    pub(crate) seen: PaneInput<'a>,
    pub(crate) pane: &'a mut Option<PaneKind>,
    /// The text field that has the cursor, or had it when the mouse was pressed, and its pane.
    pub(crate) cursor: &'a mut Option<(PaneKind, Id)>,
    /// The pane whose tab is below the dragged thing.
    pub(crate) under: Option<PaneKind>,
    /// The tab that was chosen in the menu of a strip.
    pub(crate) chosen: Option<TileId>,
}

/// The height of a strip of tabs, which is the width of its arrows, too.
const TAB_STRIP_HEIGHT_POINTS: f32 = 28.0;
/// The number of frames in which a strip is scrolled to its open tab after that changed: its arrows come a frame later.
const STRIP_SCROLL_FRAMES: u8 = 3;

/// The state of a strip at the frame before.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct TabStripState {
    open: Option<TileId>,
    width: f32,
    /// The frames that are left in which it is scrolled.
    frames: u8,
}

/// The margin of a pane; the frame around the pane that has the focus lies in it.
const PANE_MARGIN_POINTS: f32 = 8.0;

/// Returns the widget with the keyboard focus, if it lies in a part of the window, and not above it.
fn focused_in(ui: &Ui, part: Rect) -> Option<Response> {
    let is_inside =
        |response: &Response| response.layer_id == ui.layer_id() && part.contains_rect(response.interact_rect);
    focused_widget(ui).filter(is_inside)
}

impl TileWorkbench<'_> {
    /// Leaves the cursor in the text field of a pane if a button of the pane was pressed; the pane reported what happened
    /// to its widgets after `before` other reports.
    fn keep_cursor(&mut self, ui: &Ui, part: Rect, pane: PaneKind, before: usize) {
        if ui.memory(|memory| memory.focused()).is_some() {
            let field = focused_in(ui, part).filter(|_| ui.ctx().text_edit_focused());
            match (field, &self.cursor) {
                (Some(field), _) => *self.cursor = Some((pane, field.id)),
                (None, Some((of, _))) if *of == pane => *self.cursor = None,
                _ => {}
            }
            return;
        }
        let Some((_, field)) = self.cursor.filter(|(of, _)| *of == pane) else {
            return;
        };
        let is_button = |event: &OutputEvent| {
            let info = event.widget_info();
            let clicked = matches!(event, OutputEvent::Clicked(_));
            clicked && info.role == Role::Button && info.selected.is_none()
        };
        let pressed = ui.output(|output| output.events[before..].iter().any(is_button));
        let touched = ui.input(|input| input.pointer.any_down() || input.pointer.any_released());
        if pressed && !Popup::is_any_open(ui.ctx()) {
            ui.memory_mut(|memory| memory.request_focus(field));
        } else if !touched {
            *self.cursor = None;
        }
    }
}

/// Returns the offset of a strip, `room` wide, that has the tab from `left` to `right` in sight and is nearest to
/// the present one.
fn offset_for(left: f32, right: f32, room: f32, offset: f32) -> f32 {
    offset.max(right - room).min(left)
}

impl Behavior<PaneKind> for TileWorkbench<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _tile: TileId, kind: &mut PaneKind) -> UiResponse {
        Frame::new().inner_margin(PANE_MARGIN_POINTS).show(ui, |ui| {
            let rect = ui.available_rect_before_wrap();
            // A press on a list or a menu above the pane is none on the pane.
            let pressed = ui.input(|input| input.pointer.any_pressed());
            if pressed && ui.rect_contains_pointer(rect)
                || focused_in(ui, rect).is_some_and(|response| response.gained_focus())
            {
                *self.pane = Some(*kind);
            }
            let before = ui.output(|output| output.events.len());
            kind.note_sight(ui.ctx());
            self.panes.get_mut(*kind).ui(ui, &self.seen);
            ui.allocate_space(ui.available_size());
            self.keep_cursor(ui, rect, *kind, before);
            if *self.pane == Some(*kind) {
                let stroke = Stroke::new(1.5, self.seen.pane_colours().accent);
                let around = rect.expand(PANE_MARGIN_POINTS - 1.0);
                ui.painter().rect_stroke(around, 0.0, stroke, StrokeKind::Inside);
            }
        });
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, kind: &PaneKind) -> WidgetText {
        self.seen.say_text(kind.pane_title()).into()
    }

    /// Shows the menu of all tabs if the strip has no room for them, and scrolls to the open tab once it changed.
    fn top_bar_right_ui(&mut self, tiles: &Tiles<PaneKind>, ui: &mut Ui, tile: TileId, tabs: &Tabs, offset: &mut f32) {
        let font = TextStyle::Button.resolve(ui.style());
        let margin = self.tab_title_spacing(ui.visuals());
        let mut end = 0.0;
        let mut titles: Vec<(TileId, WidgetText, (f32, f32))> = Vec::new();
        for child in tabs.children.iter().filter(|child| tiles.is_visible(**child)) {
            let title = self.tab_title_for_tile(tiles, *child);
            let extend = Some(TextWrapMode::Extend);
            let galley = title.clone().into_galley(ui, extend, f32::INFINITY, font.clone());
            let begin = end;
            end += galley.size().x + 2.0 * margin;
            titles.push((*child, title, (begin, end)));
        }
        let width = ui.available_width();
        if end <= width {
            return;
        }
        let menu = ui.menu_button("…", |ui| {
            for (child, title, _) in &titles {
                let open = tabs.is_active(*child);
                if ui.selectable_label(open, title.clone()).clicked() {
                    self.chosen = Some(*child);
                    ui.close();
                }
            }
        });
        let name = self.seen.say_text(words::ALL_TABS);
        let menu = menu.response.on_hover_text(name);
        menu.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));

        let id = ui.scope_id().with(("strip", tile));
        let open = tabs.active;
        let before: TabStripState = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        let same = before.open == open && (before.width - width).abs() < 0.5;
        let frames = if same { before.frames } else { STRIP_SCROLL_FRAMES };
        if frames > 0
            && let Some((_, _, tab)) = titles.iter().find(|entry| Some(entry.0) == open)
        {
            let arrows = 2.0 * (TAB_STRIP_HEIGHT_POINTS + ui.spacing().item_spacing.x);
            *offset = offset_for(tab.0, tab.1, ui.available_width() - arrows, *offset);
            ui.ctx().request_repaint();
        }
        let frames = frames.saturating_sub(1);
        ui.data_mut(|data| {
            data.insert_temp(id, TabStripState { open, width, frames });
        });
    }

    fn on_tab_button(&mut self, tiles: &mut Tiles<PaneKind>, tile: TileId, button: Response) -> Response {
        if button.clicked()
            && let Some(Tile::Pane(kind)) = tiles.get(tile)
        {
            *self.pane = Some(*kind);
        }
        if button.contains_pointer()
            && carry::is_carrying(&button.ctx)
            && let Some(Tile::Pane(kind)) = tiles.get(tile)
        {
            self.under = Some(*kind);
            button.ctx.request_repaint();
        }
        button
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions {
            all_panes_must_have_tabs: true,
            ..SimplificationOptions::default()
        }
    }

    fn tab_bar_height(&self, _style: &Style) -> f32 {
        TAB_STRIP_HEIGHT_POINTS
    }

    fn gap_width(&self, _style: &Style) -> f32 {
        4.0
    }
}

#[cfg(test)]
mod tests {
    use super::offset_for;

    #[test]
    fn a_strip_scrolls_just_as_far_as_the_open_tab_needs() {
        for (tab, offset, wanted) in [
            ((0.0, 60.0), 0.0, 0.0),
            ((220.0, 310.0), 0.0, 110.0),
            ((370.0, 430.0), 110.0, 230.0),
            ((60.0, 120.0), 110.0, 60.0),
            ((120.0, 200.0), 110.0, 110.0),
            // A tab wider than its strip shows its beginning.
            ((100.0, 400.0), 0.0, 100.0),
        ] {
            let found: f32 = offset_for(tab.0, tab.1, 200.0, offset);
            assert!((found - wanted).abs() < 1e-3, "{tab:?} {offset}: {found}");
        }
    }
}
