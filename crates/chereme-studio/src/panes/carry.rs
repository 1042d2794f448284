//! Signs carried from lists to recipes: dragged with a little figure under the pointer, or by a menu.

use eframe::egui::{
    Align2, Area, Context, CursorIcon, DragAndDrop, Frame, Id, LayerId, Order, Rect, Response, Stroke, StrokeKind, Ui,
    Vec2, vec2,
};

use crate::action::Action;
use crate::command::{DraggedToken, WindowCommand};
use crate::context::PaneInput;
use crate::layout::PaneKind;
use crate::miniatures::{self, MiniatureCell, MiniatureMotion};
use crate::model::InspectedThing;
use crate::words::{library as words, search_words};

/// Side of the figure under the pointer, in points.
const CARRIED_FIGURE_SIDE: f32 = 96.0;

/// The picture that follows the pointer while a sign is carried.
#[derive(Clone)]
struct CarriedPicture {
    gloss: String,
    motion: Option<MiniatureMotion>,
}

fn picture_id() -> Id {
    Id::unique("carried")
}

/// Makes a row or figure of a list draggable; it must sense drags.
pub(crate) fn make_sign_draggable(response: &Response, carried: DraggedToken, motion: Option<MiniatureMotion>) {
    if !response.drag_started() {
        return;
    }
    let gloss = carried.gloss.clone();
    response.dnd_set_drag_payload(carried);
    let ctx = &response.ctx;
    let picture = CarriedPicture { gloss, motion };
    ctx.data_mut(|data| data.insert_temp(picture_id(), picture));
}

/// Returns whether a sign is being carried.
pub(crate) fn is_carrying(ctx: &Context) -> bool {
    DragAndDrop::has_payload_of_type::<DraggedToken>(ctx)
}

/// Returns the sign that is dropped over `rect`, if no widget there took it; marks the area meanwhile.
pub(crate) fn take_dropped_sign(ui: &Ui, seen: &PaneInput<'_>, rect: Rect) -> Option<DraggedToken> {
    let ctx = ui.ctx();
    let over = ctx.pointer_latest_pos().is_some_and(|at| rect.contains(at));
    if !over || !is_carrying(ctx) {
        return None;
    }
    let stroke = Stroke::new(2.0, seen.pane_colours().accent);
    let painter = ui.painter();
    painter.rect_stroke(rect.expand(6.0), 4.0, stroke, StrokeKind::Inside);
    if !ui.input(|input| input.pointer.any_released()) {
        return None;
    }
    DragAndDrop::take_payload::<DraggedToken>(ctx).map(|payload| (*payload).clone())
}

/// Draws the dragged sign under the pointer, above the panes.
pub(crate) fn show_carried_sign(ctx: &Context, seen: &PaneInput<'_>) {
    if !is_carrying(ctx) {
        return;
    }
    let picture: Option<CarriedPicture> = ctx.data(|data| data.get_temp(picture_id()));
    let (Some(picture), Some(at)) = (picture, ctx.pointer_latest_pos()) else {
        return;
    };
    ctx.set_cursor_icon(CursorIcon::Grabbing);
    let area = Area::new(picture_id())
        .order(Order::Tooltip)
        .interactable(false)
        .pivot(Align2::LEFT_TOP)
        .constrain(false)
        .fixed_pos(at + vec2(14.0, 14.0));
    area.show(ctx, |ui| {
        Frame::popup(ui.style()).inner_margin(4).show(ui, |ui| {
            if let Some(motion) = picture.motion {
                let (rect, _): (Rect, _) =
                    ui.allocate_exact_size(Vec2::splat(CARRIED_FIGURE_SIDE), eframe::egui::Sense::hover());
                let cell =
                    MiniatureCell::new(motion, rect.size()).with_playing_clock(miniatures::figure_loop_clock(ui));
                seen.little.paint_figure(ui, seen.language, seen.out, &cell, rect);
            }
            ui.label(picture.gloss);
        });
    });
    let layer = LayerId::new(Order::Tooltip, picture_id());
    ctx.move_to_top(layer);
}

/// Opens a tab when something is held over it for a while.
#[derive(Debug, Default)]
pub(crate) struct TabSpring(Option<(PaneKind, f64)>);

impl TabSpring {
    /// How long it must be held, in seconds.
    const TAB_HOLD_SECONDS: f64 = 0.35;

    /// Returns the pane whose tab opens now.
    pub(crate) fn pane_to_open(&mut self, under: Option<PaneKind>, now: f64) -> Option<PaneKind> {
        let since = match (self.0, under) {
            (Some((before, since)), Some(under)) if before == under => since,
            _ => now,
        };
        self.0 = under.map(|under| (under, since));
        under.filter(|_| now - since >= Self::TAB_HOLD_SECONDS)
    }
}

/// Draws the menu of a sign in a list.
///
/// `recording` is the recording that contains the sign; if it was made from a recipe, the menu can open that recipe
/// again.
pub(crate) fn show_sign_menu(ui: &mut Ui, seen: &PaneInput<'_>, token: i64, gloss: &str, recording: Option<i64>) {
    let mut entry = |name: &str, command: WindowCommand, keys: String| {
        let button = eframe::egui::Button::new(name).shortcut_text(keys);
        if ui.add(button).clicked() {
            seen.send_command(command);
            ui.close();
        }
    };
    let carried = DraggedToken {
        token,
        gloss: gloss.to_owned(),
    };
    if let Some((recipe, name)) = recording.and_then(|id| seen.snapshot.recipe_of(id)) {
        let open = Action::OpenRecipe;
        let command = WindowCommand::Recipe(recipe, Some(name));
        entry(
            seen.say_text(open.action_row().name),
            command,
            seen.keys.action_keys_text(open),
        );
    }
    let (used, like) = (Action::UseInRecipe, Action::SearchLike);
    let name = seen.say_text(used.action_row().name);
    entry(name, WindowCommand::Use(carried), seen.keys.action_keys_text(used));
    let query = crate::panes::search::like_query(&seen.snapshot.overview, token, gloss);
    entry(
        seen.say_text(search_words::MORE_LIKE),
        WindowCommand::Find(query),
        seen.keys.action_keys_text(like),
    );
    let thing = WindowCommand::Inspect(InspectedThing::Token(token));
    entry(seen.say_text(words::INSPECT), thing, String::new());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tab_opens_after_hovering_and_not_in_passing() {
        let mut sprung = TabSpring::default();
        let pane = Some(PaneKind::Recombine);
        assert_eq!(sprung.pane_to_open(pane, 1.0), None);
        assert_eq!(sprung.pane_to_open(Some(PaneKind::Search), 1.3), None);
        assert_eq!(sprung.pane_to_open(pane, 1.5), None);
        assert_eq!(sprung.pane_to_open(None, 1.7), None);
        assert_eq!(sprung.pane_to_open(pane, 1.9), None);
        assert_eq!(sprung.pane_to_open(pane, 2.3), pane);
    }
}
