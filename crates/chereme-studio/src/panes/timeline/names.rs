//! The names of tiers, with their folds and menus.

use chereme_corpus::Contents;
use eframe::egui::{
    Align2, Id, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, pos2,
    vec2,
};

use super::edit::Scene;
use super::rows::Row;
use super::ui::{Drawing, INDENT};
use super::{bar, paint};
use crate::action::Action;
use crate::command::Command;
use crate::words::{fill, timeline as words};

impl Drawing<'_, '_> {
    /// The name of a tier, with the fold before it and a menu behind the other button.
    pub(super) fn header(&mut self, ui: &mut Ui, contents: &Contents, row: &Row, name: Rect) {
        let tier = &contents.tiers[row.tier];
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        let chosen = scene.tier().is_some_and(|it| it.row.id == tier.row.id);
        let label = fill(self.seen.say(words::TIER), &[("name", &tier.row.name)]);
        let response = ui.interact(name, Id::unique(("tier", tier.row.id)), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
        if response.clicked() {
            self.out.send(Command::Tier(Some(tier.row.id)));
        }
        self.header_menu(&response, tier.row.id);
        let colours = self.seen.colours();
        if chosen {
            let mark = name.with_max_x(name.left() + 3.0);
            ui.painter().rect_filled(mark, 0.0, colours.accent);
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
        let left = name.left() + 6.0 + INDENT * row.depth as f32;
        if row.has_below {
            self.fold(
                ui,
                row,
                (tier.row.id, &tier.row.name),
                Rect::from_x_y_ranges(left..=left + 14.0, name.y_range()),
            );
        }
        let from = pos2(left + 15.0, name.center().y);
        let font = TextStyle::Body.resolve(ui.style());
        let text = ui.painter_at(name.shrink2(vec2(2.0, 0.0))).text(
            from,
            Align2::LEFT_CENTER,
            &tier.row.name,
            font,
            text,
        );
        if text.right() > name.right() - 2.0 {
            response.on_hover_text(&tier.row.name);
        }
    }

    fn fold(&mut self, ui: &mut Ui, row: &Row, (id, name): (i64, &str), rect: Rect) {
        let words = if row.folded {
            words::UNFOLD
        } else {
            words::FOLD
        };
        let label = fill(self.seen.say(words), &[("name", &name)]);
        let response = ui.interact(rect, Id::unique(("fold", id)), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        if response.clicked() {
            self.out.send(Command::Tier(Some(id)));
            self.out.send(Command::Do(Action::FoldTier));
        }
        paint::fold(ui, rect, row.folded, &response);
    }

    fn header_menu(&mut self, response: &Response, tier: i64) {
        const EDIT: [Action; 3] = [Action::AddTier, Action::ChangeTier, Action::RemoveTier];
        const SHOW: [Action; 4] = [
            Action::TierUp,
            Action::TierDown,
            Action::HideTier,
            Action::SelectOnTier,
        ];
        if response.secondary_clicked() {
            self.out.send(Command::Tier(Some(tier)));
        }
        response.context_menu(|ui| {
            bar::actions(ui, self.seen, &EDIT, self.out);
            ui.separator();
            bar::actions(ui, self.seen, &SHOW, self.out);
        });
    }
}
