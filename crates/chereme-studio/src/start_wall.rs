//! The living wall of the start page: signs of the starter corpus, each in a loop.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use chereme_corpus::{StarterSign, starter_signs};
use chereme_sign::SignerHandedness;
use eframe::egui::{
    Align2, Context, CornerRadius, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
    vec2,
};

use crate::miniatures::{self, MiniatureFigures, MiniatureFocus};
use crate::model::generated::GeneratedClip;
use crate::theme::{self, ThemeColours};
use crate::words::{InterfaceLanguage, fill_text_braces, shell as words};

/// The least side of a sign's picture, and the gap between two, in points.
const MIN_WALL_PICTURE_POINTS: f32 = 132.0;
const WALL_PICTURE_GAP_POINTS: f32 = 10.0;
/// The room for a gloss below its picture.
const WALL_GLOSS_HEIGHT_POINTS: f32 = 22.0;

/// The signs that have been read so far, in order; a thread reads them once.
static STARTER_WALL_SIGNS: OnceLock<Mutex<Vec<Arc<GeneratedClip>>>> = OnceLock::new();

/// Returns the signs of the starter corpus that have been read so far; the first call starts the reading.
pub(crate) fn loaded_starter_signs(ctx: &Context) -> Vec<Arc<GeneratedClip>> {
    let mut fresh = false;
    let signs = STARTER_WALL_SIGNS.get_or_init(|| {
        fresh = true;
        Mutex::default()
    });
    if fresh {
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            for sign in starter_signs().flatten() {
                let made = Arc::new(clip_from_starter_sign(sign));
                let mut all = signs.lock().unwrap_or_else(PoisonError::into_inner);
                all.push(made);
                drop(all);
                ctx.request_repaint();
            }
        });
    }
    signs.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

fn clip_from_starter_sign(sign: StarterSign) -> GeneratedClip {
    GeneratedClip {
        name: sign.gloss,
        // It belongs to no corpus.
        recipe: String::new(),
        token: None,
        clip: sign.clip,
        faces: Vec::new(),
        anatomy: Arc::new(sign.anatomy),
        handedness: SignerHandedness::Right,
        parts: Vec::new(),
    }
}

/// Returns columns, rows and the side of a picture in points for `count` signs in `room`; `None` if not even one fits.
pub(super) fn fit_wall_grid(room: Vec2, count: usize) -> Option<([usize; 2], f32)> {
    let fit = |side: f32, foot: f32| {
        ((side + WALL_PICTURE_GAP_POINTS) / (MIN_WALL_PICTURE_POINTS + foot + WALL_PICTURE_GAP_POINTS)).floor() as usize
    };
    let most = [fit(room.x, 0.0), fit(room.y, WALL_GLOSS_HEIGHT_POINTS)];
    if most.contains(&0) || count == 0 {
        return None;
    }
    // The fewest columns that show as many signs as there is room for, with the largest pictures.
    let shown = count.min(most[0] * most[1]);
    let side = |columns: usize| {
        let rows = shown.div_ceil(columns);
        let wide = (room.x + WALL_PICTURE_GAP_POINTS) / columns as f32 - WALL_PICTURE_GAP_POINTS;
        let high =
            (room.y + WALL_PICTURE_GAP_POINTS) / rows as f32 - WALL_PICTURE_GAP_POINTS - WALL_GLOSS_HEIGHT_POINTS;
        ([columns, rows], wide.min(high))
    };
    (1..=most[0])
        .map(side)
        .filter(|(_, side)| *side >= MIN_WALL_PICTURE_POINTS * 0.9)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Shows the wall in a rectangle; returns the gloss of the sign that was clicked.
pub(super) fn show_sign_wall(
    ui: &mut Ui,
    little: &MiniatureFigures,
    language: InterfaceLanguage,
    room: Rect,
) -> Option<String> {
    let signs = loaded_starter_signs(ui.ctx());
    let ([columns, rows], side) = fit_wall_grid(room.size(), signs.len())?;
    let step = vec2(
        side + WALL_PICTURE_GAP_POINTS,
        side + WALL_GLOSS_HEIGHT_POINTS + WALL_PICTURE_GAP_POINTS,
    );
    let size = vec2(columns as f32 * step.x, rows as f32 * step.y) - Vec2::splat(WALL_PICTURE_GAP_POINTS);
    let first = Align2::CENTER_CENTER.align_size_within_rect(size, room).min;
    let mut chosen = None;
    for (at, made) in signs.iter().take(columns * rows).enumerate() {
        let place = wall_picture_place(at, columns, signs.len());
        let rect = Rect::from_min_size(first + place * step, Vec2::splat(side));
        if show_wall_picture(ui, little, language, at, made, rect).clicked() {
            chosen = Some(made.name.clone());
        }
    }
    chosen
}

/// Returns column and row of a picture; an incomplete last row stands in the middle.
fn wall_picture_place(at: usize, columns: usize, count: usize) -> Vec2 {
    let row = at / columns;
    let in_row = columns.min(count - row * columns);
    let indent = (columns - in_row) as f32 / 2.0;
    vec2((at % columns) as f32 + indent, row as f32)
}

fn show_wall_picture(
    ui: &mut Ui,
    little: &MiniatureFigures,
    language: InterfaceLanguage,
    at: usize,
    made: &Arc<GeneratedClip>,
    rect: Rect,
) -> Response {
    let cell_rect = rect.with_max_y(rect.bottom() + WALL_GLOSS_HEIGHT_POINTS);
    let id = ui.scope_id().with(("wall", at));
    let response = ui.interact(cell_rect, id, Sense::click());
    let name = fill_text_braces(words::START_SIGN.text_in_language(language), &[("gloss", &made.name)]);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let clock = miniatures::figure_loop_clock(ui);
    little.paint_made(ui, language, made, clock, rect, MiniatureFocus::Signing);
    let colours = ThemeColours::colours_for_theme(theme::is_dark(ui.ctx()));
    let lit = response.hovered() || response.has_focus();
    let stroke = if lit {
        Stroke::new(2.0, colours.accent)
    } else {
        Stroke::new(1.0, colours.rule)
    };
    let painter = ui.painter();
    painter.rect_stroke(rect, CornerRadius::same(6), stroke, StrokeKind::Inside);
    let font = TextStyle::Body.resolve(ui.style());
    let below = rect.center_bottom() + vec2(0.0, WALL_GLOSS_HEIGHT_POINTS / 2.0 + 1.0);
    let colour = ui.visuals().text_color();
    painter.text(below, Align2::CENTER_CENTER, &made.name, font, colour);
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wall_fills_its_space_with_pictures_of_sufficient_size() {
        for (room, count, least) in [
            (vec2(640.0, 700.0), 10, 10),
            (vec2(400.0, 560.0), 10, 6),
            (vec2(150.0, 200.0), 10, 1),
            (vec2(900.0, 500.0), 3, 3),
        ] {
            let ([columns, rows], side) = fit_wall_grid(room, count).expect("room");
            assert!(columns * rows >= least, "{room:?}: {columns} by {rows}");
            assert!(side >= MIN_WALL_PICTURE_POINTS * 0.9, "{room:?}: {side}");
            assert!(columns as f32 * (side + WALL_PICTURE_GAP_POINTS) - WALL_PICTURE_GAP_POINTS <= room.x + 0.1);
            assert!(
                rows as f32 * (side + WALL_GLOSS_HEIGHT_POINTS + WALL_PICTURE_GAP_POINTS) - WALL_PICTURE_GAP_POINTS
                    <= room.y + 0.1
            );
        }
        assert_eq!(wall_picture_place(7, 4, 10), vec2(3.0, 1.0));
        assert_eq!(
            wall_picture_place(8, 4, 10),
            vec2(1.0, 2.0),
            "two are centred below four"
        );
        assert_eq!(fit_wall_grid(vec2(90.0, 500.0), 10), None);
        assert_eq!(fit_wall_grid(vec2(900.0, 500.0), 0), None);
    }
}
