//! Texts over the stage's pictures: the signer of the original, and notes about the whole stage.

use eframe::egui::{self, Align2, Rect, TextStyle, Ui, vec2};

use super::StagePane;
use super::stage_data::{StagePart, StagePartContent};
use crate::context::PaneInput;
use crate::panes::timeline;
use crate::words::{fill_text_braces, stage_words as words};

/// In a picture narrower than this, texts would cover the signer.
pub(super) const NARROW_PICTURE_WIDTH_POINTS: f32 = 300.0;

/// Shows whose original is visible, or how a piece without an original was generated.
pub(super) fn show_original_signer(stage: &StagePane, ui: &Ui, seen: &PaneInput<'_>, part: &StagePart) {
    // Beside the signer's own picture nothing needs a name.
    if part.who == StagePartContent::Signer {
        return;
    }
    let current_time = seen.shown.on_stage().player_playhead();
    let text = match stage.original.original_piece_at(current_time) {
        Some(piece) if piece.shown.is_some() && part.rect.width() < NARROW_PICTURE_WIDTH_POINTS => {
            seen.say_text(words::ORIGINAL).to_owned()
        }
        Some(piece) if piece.shown.is_some() => {
            fill_text_braces(seen.say_text(words::ORIGINAL_OF), &[("name", &piece.part.gloss)])
        }
        Some(piece) => no_original(seen, &piece.part.from),
        None => return,
    };
    // The choice of the view is above.
    let (at, anchor) = if part.rect.width() < NARROW_PICTURE_WIDTH_POINTS {
        (part.rect.left_bottom() + vec2(8.0, -8.0), Align2::LEFT_BOTTOM)
    } else {
        (part.rect.right_top() + vec2(-8.0, 8.0), Align2::RIGHT_TOP)
    };
    paint_caption_chip(ui, at, anchor, &text);
}

fn no_original(seen: &PaneInput<'_>, made_by: &str) -> String {
    // Sources of pieces may be whole notations; the beginning is enough to tell them apart.
    let mut short: String = made_by.chars().take(36).collect();
    if short.len() < made_by.len() {
        short.push('…');
    }
    fill_text_braces(seen.say_text(words::NO_ORIGINAL), &[("made", &short)])
}

/// Returns the width of a text with its background, in points.
fn chip_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Small.resolve(ui.style());
    let colour = ui.visuals().text_color();
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, colour);
    galley.size().x + 12.0
}

/// Half of the width that the face may need, as a share of the picture's height.
const HALF_FACE: f32 = 0.12;
/// The height of a note with its margin, in points.
const STAGE_NOTE_HEIGHT_POINTS: f32 = 26.0;

/// Returns the place of a note in a picture that leaves the signer's face and the name of the view free, and the side
/// of the note that is there: the upper right corner if the note fits beside the face, else below, over the other notes.
fn beside_face(picture: Rect, width: f32) -> (egui::Pos2, Align2) {
    let room = picture.width() / 2.0 - picture.height() * HALF_FACE - 8.0;
    if width <= room {
        let corner = picture.right_top() + vec2(-8.0, 8.0);
        return (corner, Align2::RIGHT_TOP);
    }
    let foot = picture.center_bottom() - vec2(0.0, 8.0 + STAGE_NOTE_HEIGHT_POINTS);
    (foot, Align2::CENTER_BOTTOM)
}

pub(super) fn paint_caption_chip(ui: &Ui, at: egui::Pos2, anchor: Align2, text: &str) {
    chip_on(ui.painter(), ui, at, anchor, text);
}

/// Writes a few words on a separate background.
pub(super) fn chip_on(painter: &egui::Painter, ui: &Ui, at: egui::Pos2, anchor: Align2, text: &str) {
    let font = TextStyle::Small.resolve(ui.style());
    let colour = ui.visuals().text_color();
    let galley = painter.layout_no_wrap(text.to_owned(), font, colour);
    let rect = anchor.anchor_size(at, galley.size() + vec2(12.0, 6.0));
    let fill = ui.visuals().panel_fill.gamma_multiply(0.9);
    painter.rect_filled(rect, 5.0, fill);
    painter.galley(rect.min + vec2(6.0, 3.0), galley, colour);
}

/// Shows notes about the whole stage, for example that a moment is being loaded, or that the hands have no fingers.
pub(super) fn show_stage_notes(stage: &StagePane, ui: &Ui, seen: &PaneInput<'_>, whole: Rect, parts: &[StagePart]) {
    let note_position = whole.center_bottom() - vec2(0.0, 8.0);
    let without_fingers = stage
        .signer
        .as_ref()
        .is_some_and(|signer| signer.1.is_without_fingers());
    let points = match stage.points.point_quality_note() {
        _ if stage.signer.is_some() && !stage.points.are_in_room() => None,
        Some("estimated from film, no depth") => Some(words::ESTIMATED_FLAT),
        Some("no depth") => Some(words::NO_DEPTH),
        Some("estimated") => Some(words::ESTIMATED_POINTS),
        Some(_) => Some(words::ESTIMATED),
        None => None,
    };
    if let Some(at) = stage.previews {
        let loops = seen
            .shown
            .player
            .current_opening_preview()
            .is_some_and(|preview| preview.loops);
        let time = timeline::timeline_data::time_text(at);
        let template = if loops {
            seen.say_text(words::PREVIEW_LOOP).to_owned()
        } else {
            fill_text_braces(seen.say_text(words::PREVIEW), &[("time", &time)])
        };
        let text = seen.keys.name_keys_in_text(&template);
        // The picture in the upper right corner.
        let corner = |part: &&StagePart| (part.rect.right() - part.rect.top()) as i32;
        let picture = parts.iter().max_by_key(corner).map_or(whole, |part| part.rect);
        let (place, anchor) = beside_face(picture, chip_width(ui, &text));
        paint_caption_chip(ui, place, anchor, &text);
    }
    if stage.coming {
        paint_caption_chip(ui, note_position, Align2::CENTER_BOTTOM, seen.say_text(words::COMING));
    } else if let Some(points) = points.filter(|_| stage.signer.is_none() || stage.shows.points) {
        paint_caption_chip(ui, note_position, Align2::CENTER_BOTTOM, seen.say_text(points));
    } else if without_fingers {
        paint_caption_chip(
            ui,
            note_position,
            Align2::CENTER_BOTTOM,
            seen.say_text(words::NO_FINGERS),
        );
    } else if let Some(made_by) = stage.original.made_by() {
        paint_caption_chip(ui, note_position, Align2::CENTER_BOTTOM, &no_original(seen, made_by));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    #[test]
    fn a_note_covers_no_face_in_stages_of_any_shape() {
        for (wide, high) in [(640.0, 290.0), (640.0, 110.0), (300.0, 400.0), (260.0, 120.0)] {
            let whole = Rect::from_min_size(pos2(10.0, 20.0), vec2(wide, high));
            for width in [90.0, 250.0] {
                let (place, anchor) = beside_face(whole, width);
                let note = anchor.anchor_size(place, vec2(width, 20.0));
                let centre = whole.center_top() + vec2(0.0, high * 0.25);
                let face = Rect::from_center_size(centre, vec2(high * 0.2, high * 0.4));
                assert!(!note.intersects(face), "{wide} x {high}: {note}");
                assert!(whole.y_range().contains(note.top()) && note.bottom() < whole.bottom());
            }
        }
    }
}
