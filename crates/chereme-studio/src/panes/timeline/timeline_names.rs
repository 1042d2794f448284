//! The names of tiers, with their fold marks and menus.

use chereme_corpus::RecordingContents;
use eframe::egui::{
    Color32, CursorIcon, Id, Key, Modifiers, PointerButton, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind,
    TextStyle, TextWrapMode, Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use super::timeline_edit::TimelineScene;
use super::timeline_rows::TimelineRow;
use super::timeline_ui::{TIER_INDENT_POINTS, TimelineDrawing};
use super::{bar, timeline_paint, timeline_tiers};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::words::{fill_text_braces, timeline as words};

impl TimelineDrawing<'_, '_> {
    /// Shows the name of a tier, with its fold mark and a context menu.
    pub(super) fn show_tier_header(
        &mut self,
        ui: &mut Ui,
        contents: &RecordingContents,
        row: &TimelineRow,
        name: Rect,
    ) {
        let tier = &contents.tiers[row.tier];
        let scene = TimelineScene::new(contents, self.seen);
        let chosen = scene
            .edited_tier()
            .is_some_and(|chosen_tier| chosen_tier.row.id == tier.row.id);
        let label = fill_text_braces(self.seen.say_text(words::TIER), &[("name", &tier.row.name)]);
        let response = ui.interact(name, Id::unique(("tier", tier.row.id)), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        if response.clicked() {
            self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
        }
        if response.drag_started_by(PointerButton::Primary) {
            self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
            self.timeline.tier_held = Some(tier.row.id);
        }
        self.header_menu(&response, tier.row.id);
        let colours = self.seen.pane_colours();
        if chosen {
            let mark = name.with_max_x(name.left() + 3.0);
            ui.painter().rect_filled(mark, 0.0, colours.accent);
        }
        let tier_colour = tier.row.elan_display_settings().colour;
        if let Some(colour) = tier_colour.and_then(|text| Color32::from_hex(&text).ok()) {
            let mark = name.with_min_x(name.right() - 4.0).shrink2(vec2(0.5, 2.0));
            ui.painter().rect_filled(mark, 1.0, colour);
        }
        if response.has_focus() {
            let stroke = Stroke::new(1.5, colours.accent);
            ui.painter()
                .rect_stroke(name.shrink(1.0), 3.0, stroke, StrokeKind::Inside);
        }
        let visuals = ui.style().interact_selectable(&response, chosen);
        let text = if chosen {
            ui.visuals().strong_text_color()
        } else {
            visuals.text_color()
        };
        let left = name.left() + 6.0 + TIER_INDENT_POINTS * row.depth as f32;
        if row.has_below {
            self.show_tier_fold(
                ui,
                row,
                tier.row.id,
                &tier.row.name,
                Rect::from_x_y_ranges(left..=left + 14.0, name.y_range()),
            );
        }
        let from = pos2(left + 15.0, name.center().y);
        let room = name.right() - 2.0 - from.x;
        let cut = Some(TextWrapMode::Truncate);
        let title = RichText::new(&tier.row.name).color(text);
        let galley = WidgetText::from(title).into_galley(ui, cut, room, TextStyle::Body);
        let elided = galley.elided;
        let text_position = pos2(from.x, from.y - galley.size().y / 2.0);
        ui.painter_at(name.shrink2(vec2(2.0, 0.0)))
            .galley(text_position, galley, text);
        if elided {
            response.on_hover_text(&tier.row.name);
        }
    }

    /// Scrolls through the rows while something is held above or below them.
    pub(super) fn scroll_held(&mut self, ui: &Ui, y: f32, area: Rect) {
        const NAME_SCROLL_EDGE_POINTS: f32 = 14.0;
        let beyond = if y < area.top() + NAME_SCROLL_EDGE_POINTS {
            y - (area.top() + NAME_SCROLL_EDGE_POINTS)
        } else {
            (y - (area.bottom() - NAME_SCROLL_EDGE_POINTS)).max(0.0)
        };
        if beyond != 0.0 {
            let step = (beyond * 0.35).clamp(-14.0, 14.0);
            let top = self.timeline.layout.top + step;
            self.timeline.layout.scroll_to = Some(top.max(0.0));
            ui.ctx().request_repaint();
        }
    }

    fn show_tier_fold(&mut self, ui: &mut Ui, row: &TimelineRow, id: i64, name: &str, rect: Rect) {
        let words = if row.folded { words::UNFOLD } else { words::FOLD };
        let label = fill_text_braces(self.seen.say_text(words), &[("name", &name)]);
        let response = ui.interact(rect, Id::unique(("fold", id)), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        if response.clicked() {
            self.seen.send_command(WindowCommand::Tier(Some(id)));
            self.seen.send_command(WindowCommand::Do(Action::FoldTier));
        }
        timeline_paint::paint_fold_mark(ui, rect, row.folded, &response);
    }

    fn header_menu(&mut self, response: &Response, tier: i64) {
        const TIER_EDIT_ACTIONS: [Action; 5] = [
            Action::AddTier,
            Action::UsualTiers,
            Action::ChangeTier,
            Action::CopyTier,
            Action::RemoveTier,
        ];
        const TIER_SHOW_ACTIONS: [Action; 6] = [
            Action::TierUp,
            Action::TierDown,
            Action::TiersByName,
            Action::TiersByKind,
            Action::HideTier,
            Action::SelectOnTier,
        ];
        if response.secondary_clicked() {
            self.seen.send_command(WindowCommand::Tier(Some(tier)));
        }
        response.context_menu(|ui| {
            bar::show_menu_actions(ui, self.seen, &TIER_EDIT_ACTIONS);
            ui.separator();
            bar::show_menu_actions(ui, self.seen, &TIER_SHOW_ACTIONS);
        });
    }

    /// Shows the new place of the tier that is dragged by its name, and drops it there.
    pub(super) fn held_tier(&mut self, ui: &Ui, contents: &RecordingContents, area: Rect) {
        let Some(id) = self.timeline.tier_held else {
            return;
        };
        let (pointer, released, escape) = ui.input_mut(|input| {
            let escape = input.consume_key(Modifiers::NONE, Key::Escape);
            let pointer = &input.pointer;
            (pointer.latest_pos(), !pointer.any_down(), escape)
        });
        let Some(pointer) = pointer.filter(|_| !escape) else {
            self.timeline.tier_held = None;
            return;
        };
        let all: Vec<_> = contents
            .tiers
            .iter()
            .map(|tier| (tier.row.id, tier.row.parent_id))
            .collect();
        let parent = all.iter().find(|entry| entry.0 == id).and_then(|entry| entry.1);
        let rows = &self.timeline.layout.rows;
        let mut siblings = rows.iter().filter(|(at, _)| all[*at].1 == parent);
        let next = siblings.clone().find(|(_, y)| pointer.y < y.center());
        let last = siblings.next_back().map(|(at, _)| all[*at].0);
        // The lower end of the last sibling is that of its last descendant.
        let mut family = rows
            .iter()
            .filter(|(at, _)| last.is_some_and(|last| timeline_tiers::is_tier_within(&all, all[*at].0, last)));
        let end = family.next_back().map_or(area.top(), |(_, y)| y.max);
        let y = next.map_or(end, |(_, y)| y.min);
        let before = next.map(|(at, _)| all[*at].0);
        if released {
            self.timeline.tier_held = None;
            // A tier that is dropped in front of itself stays.
            let order = timeline_tiers::order_before_sibling(&all, id, before).filter(|_| before != Some(id));
            if let Some(order) = order {
                let scene = TimelineScene::new(contents, self.seen);
                timeline_tiers::request_tier_order(&scene, order);
            }
            return;
        }
        self.scroll_held(ui, pointer.y, area);
        ui.set_cursor_icon(CursorIcon::Grabbing);
        let colour = self.seen.pane_colours().accent;
        let names = area.with_max_x(area.left() + self.names);
        let painter = ui.painter_at(area);
        painter.hline(names.x_range(), y.min(area.bottom() - 1.0), Stroke::new(2.5, colour));
    }
}
