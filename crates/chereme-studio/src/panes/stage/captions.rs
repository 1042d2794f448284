//! Texts over the stage's pictures: the signer of the original, and notes about the whole stage.

use eframe::egui::{self, Align2, Rect, TextStyle, Ui, vec2};

use super::Stage;
use super::data::{StagePart, Who};
use crate::context::PaneInput;
use crate::panes::timeline;
use crate::words::{fill, stage as words};

/// In a picture narrower than this, texts would cover the signer.
pub(super) const NARROW: f32 = 300.0;

/// Shows whose original is visible, or how a piece without an original was generated.
pub(super) fn who(stage: &Stage, ui: &Ui, seen: &PaneInput<'_>, part: &StagePart) {
    if part.who == Who::Signer {
        return;
    }
    let at = seen.shown.on_stage().playhead();
    let text = match stage.original.piece(at) {
        Some(piece) if piece.shown.is_some() && part.rect.width() < NARROW => {
            seen.say(words::ORIGINAL).to_owned()
        }
        Some(piece) if piece.shown.is_some() => {
            fill(seen.say(words::ORIGINAL_OF), &[("name", &piece.part.gloss)])
        }
        Some(piece) => no_original(seen, &piece.part.from),
        None => return,
    };
    // The choice of the view is above.
    let (at, anchor) = if part.rect.width() < NARROW {
        (
            part.rect.left_bottom() + vec2(8.0, -8.0),
            Align2::LEFT_BOTTOM,
        )
    } else {
        (part.rect.right_top() + vec2(-8.0, 8.0), Align2::RIGHT_TOP)
    };
    chip(ui, at, anchor, &text);
}

fn no_original(seen: &PaneInput<'_>, made_by: &str) -> String {
    let mut short: String = made_by.chars().take(36).collect();
    if short.len() < made_by.len() {
        short.push('…');
    }
    fill(seen.say(words::NO_ORIGINAL), &[("made", &short)])
}

pub(super) fn chip(ui: &Ui, at: egui::Pos2, anchor: Align2, text: &str) {
    chip_on(ui.painter(), ui, at, anchor, text);
}

/// Writes a few words on a separate background.
pub(super) fn chip_on(
    painter: &egui::Painter,
    ui: &Ui,
    at: egui::Pos2,
    anchor: Align2,
    text: &str,
) {
    let font = TextStyle::Small.resolve(ui.style());
    let colour = ui.visuals().text_color();
    let galley = painter.layout_no_wrap(text.to_owned(), font, colour);
    let rect = anchor.anchor_size(at, galley.size() + vec2(12.0, 6.0));
    let fill = ui.visuals().panel_fill.gamma_multiply(0.9);
    painter.rect_filled(rect, 5.0, fill);
    painter.galley(rect.min + vec2(6.0, 3.0), galley, colour);
}

/// Shows notes about the whole stage, for example that a moment is being loaded, or that the hands have no fingers.
pub(super) fn notes(stage: &Stage, ui: &Ui, seen: &PaneInput<'_>, whole: Rect) {
    let at = whole.center_bottom() - vec2(0.0, 8.0);
    let whole_top = whole.center_top() + vec2(0.0, 8.0);
    let without_fingers = stage
        .signer
        .as_ref()
        .is_some_and(|it| it.1.is_without_fingers());
    let points = match stage.points.note() {
        _ if stage.signer.is_some() && !stage.points.are_in_room() => None,
        Some("estimated from film, no depth") => Some(words::ESTIMATED_FLAT),
        Some("no depth") => Some(words::NO_DEPTH),
        Some("estimated") => Some(words::ESTIMATED_POINTS),
        Some(_) => Some(words::ESTIMATED),
        None => None,
    };
    if let Some(at) = stage.previews {
        let loops = seen.shown.player.previewed().is_some_and(|it| it.loops);
        let time = timeline::data::time_text(at);
        let text = if loops {
            seen.say(words::PREVIEW_LOOP).to_owned()
        } else {
            fill(seen.say(words::PREVIEW), &[("time", &time)])
        };
        chip(ui, whole_top, Align2::CENTER_TOP, &seen.keys.named(&text));
    }
    if stage.coming {
        chip(ui, at, Align2::CENTER_BOTTOM, seen.say(words::COMING));
    } else if let Some(points) = points.filter(|_| stage.signer.is_none() || stage.shows.points) {
        chip(ui, at, Align2::CENTER_BOTTOM, seen.say(points));
    } else if without_fingers {
        chip(ui, at, Align2::CENTER_BOTTOM, seen.say(words::NO_FINGERS));
    } else if let Some(made_by) = stage.original.made_by() {
        chip(ui, at, Align2::CENTER_BOTTOM, &no_original(seen, made_by));
    }
}
