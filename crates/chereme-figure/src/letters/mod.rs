//! Text in any script on a picture: this crate's small font, and for its missing characters the fonts of
//! the computer.
//!
//! The same text gives the same bytes on every computer if the small font has its
//! characters; others look as in the fonts of the computer, or are a frame with the character's number.

mod letters_code;
mod letters_fonts;
mod letters_order;
mod outline;

use std::sync::Arc;

pub use letters_code::{CODE_HEIGHT, code_width, draw_code};
pub use letters_fonts::{FontFile, SystemFonts};
pub use letters_order::{TextRun, any_from_right, hangs_on, mirror_bracket, reads_from_right, visual_text_runs};

use crate::font;
use outline::PlacedOutline;

/// The size of a system font that matches the small font, in dots.
const SYSTEM_FONT_SIZE_DOTS: f32 = 11.0;
/// The base line of a system font, in dots from the top of a cell.
const BASE_LINE_DOTS: f32 = 10.0;

/// A line of text after layout.
#[derive(Debug, Default)]
pub(crate) struct LaidOutLine {
    pieces: Vec<(usize, LinePiece)>,
    width: usize,
}

#[derive(Debug)]
enum LinePiece {
    Dots(String),
    Code(char),
    Outlines(Arc<FontFile>, Vec<PlacedOutline>),
}

impl LaidOutLine {
    /// Returns the width in dots, without the gap after its last character.
    pub(crate) fn line_width_dots(&self) -> usize {
        self.width.saturating_sub(1)
    }

    /// Paints the line with the top left corner at `at`, each dot `scale` pixels wide; `paint` gets a
    /// pixel and its covered share.
    pub(crate) fn paint_text_line(&self, at: [i64; 2], scale: usize, mut paint: impl FnMut(i64, i64, f32)) {
        let dots = scale as i64;
        for (left, piece) in &self.pieces {
            let x = at[0] + *left as i64 * dots;
            let mut square = |column: usize, row: i64| {
                for i in 0..dots {
                    for j in 0..dots {
                        paint(x + column as i64 * dots + i, at[1] + row * dots + j, 1.0);
                    }
                }
            };
            match piece {
                LinePiece::Dots(text) => font::draw_text_dots(text, |column, row| square(column, row as i64)),
                // The frame is higher than a cell.
                LinePiece::Code(letter) => {
                    draw_code(*letter, |column, row| square(column, row as i64 - 2));
                }
                LinePiece::Outlines(font, placed) => {
                    let base = at[1] as f32 + BASE_LINE_DOTS * scale as f32;
                    let size = SYSTEM_FONT_SIZE_DOTS * scale as f32;
                    outline::fill_text_outlines(font, placed, size, [x as f32, base], &mut paint);
                }
            }
        }
    }
}

/// The font that draws a character.
#[derive(Debug, Clone)]
enum DrawingFont {
    Dots,
    Font(Arc<FontFile>),
    Nothing,
}

impl DrawingFont {
    fn is_same_font(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Dots, Self::Dots) => true,
            (Self::Font(a), Self::Font(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// Returns the layout of a line of text; the fonts of the computer are searched only for characters that the small font
/// lacks.
pub(crate) fn lay_out_line(text: &str) -> LaidOutLine {
    if !text.chars().all(font::has_font_glyph) {
        return lay_out_with_fonts(text, SystemFonts::shared_system_fonts());
    }
    let mut line = LaidOutLine::default();
    line.add_line_part(text, &DrawingFont::Dots, false);
    line
}

/// Returns the layout of a line of text with the given fonts.
fn lay_out_with_fonts(text: &str, fonts: &SystemFonts) -> LaidOutLine {
    let mut line = LaidOutLine::default();
    for run in visual_text_runs(text) {
        let mut parts = split_run_by_font(&text[run.range.clone()], fonts);
        // Parts are in the order of reading, and the line is laid out from the left.
        if run.from_right {
            parts.reverse();
        }
        for (part, drawn) in parts {
            line.add_line_part(part, &drawn, run.from_right);
        }
    }
    line
}

/// Splits a run into parts, each drawn by one font.
fn split_run_by_font<'a>(run: &'a str, fonts: &SystemFonts) -> Vec<(&'a str, DrawingFont)> {
    let mut parts: Vec<(std::ops::Range<usize>, DrawingFont)> = Vec::new();
    for (at, letter) in run.char_indices() {
        let end = at + letter.len_utf8();
        let hangs = hangs_on(letter) && !parts.is_empty();
        let drawn = if font::has_font_glyph(letter) || (hangs_on(letter) && parts.is_empty()) {
            DrawingFont::Dots
        } else if hangs {
            parts.last().map_or(DrawingFont::Nothing, |(_, drawn)| drawn.clone())
        } else {
            fonts
                .find_letter_font(letter)
                .map_or(DrawingFont::Nothing, DrawingFont::Font)
        };
        match parts.last_mut() {
            Some((range, last)) if hangs || last.is_same_font(&drawn) => range.end = end,
            _ => parts.push((at..end, drawn)),
        }
    }
    let text = |(range, drawn)| (&run[std::ops::Range::clone(&range)], drawn);
    parts.into_iter().map(text).collect()
}

impl LaidOutLine {
    fn add_line_part(&mut self, part: &str, drawn: &DrawingFont, from_right: bool) {
        let seen = part
            .chars()
            .filter(|letter| font::has_font_glyph(*letter) || !hangs_on(*letter));
        let (piece, width) = match drawn {
            DrawingFont::Dots => {
                let text: String = match from_right {
                    true => part.chars().rev().map(mirror_bracket).collect(),
                    false => seen.collect(),
                };
                let width = text.chars().count() * font::CELL_WIDTH_DOTS;
                (LinePiece::Dots(text), width)
            }
            DrawingFont::Font(file) => {
                let (placed, wide) = outline::shape_text_outlines(file, part, from_right);
                let width = (wide.max(0.0) * SYSTEM_FONT_SIZE_DOTS).ceil() as usize;
                (LinePiece::Outlines(file.clone(), placed), width + 1)
            }
            DrawingFont::Nothing => {
                let letter = part.chars().next().unwrap_or(char::REPLACEMENT_CHARACTER);
                (LinePiece::Code(letter), code_width(letter))
            }
        };
        self.pieces.push((self.width, piece));
        self.width += width;
    }
}

#[cfg(test)]
mod tests {
    use super::letters_fonts::tests::noto;
    use super::*;

    fn dots(text: &str, fonts: &SystemFonts) -> Vec<(i64, i64, u8)> {
        let mut all = Vec::new();
        lay_out_with_fonts(text, fonts).paint_text_line([0, 4], 1, |x, y, part| all.push((x, y, (part * 255.0) as u8)));
        all
    }

    #[test]
    fn characters_of_the_built_in_font_are_unchanged_and_others_use_system_fonts() {
        let (_folder, fonts) = noto();
        let mut plain = Vec::new();
        font::draw_text_dots("ÉCOLE-2H", |x, y| plain.push((x as i64, y as i64 + 4, 255)));
        assert_eq!(dots("ÉCOLE-2H", &fonts), plain);
        let mixed = lay_out_with_fonts("жук X", &fonts);
        assert!(matches!(mixed.pieces[0].1, LinePiece::Outlines(..)));
        assert!(matches!(&mixed.pieces[1].1, LinePiece::Dots(text) if text == " X"));
        assert!(!dots("жук", &fonts).is_empty());
        assert_ne!(dots("жук", &fonts), dots("зук", &fonts));
    }

    #[test]
    fn letters_without_a_font_show_their_code_in_reading_order() {
        let (_folder, fonts) = noto();
        let line = lay_out_with_fonts("كتاب X", &fonts);
        let codes: Vec<char> = line
            .pieces
            .iter()
            .filter_map(|(_, piece)| match piece {
                LinePiece::Code(letter) => Some(*letter),
                _ => None,
            })
            .collect();
        assert_eq!(codes, ['ب', 'ا', 'ت', 'ك']);
        assert!(matches!(&line.pieces[4].1, LinePiece::Dots(text) if text == " X"));
    }

    #[test]
    fn hostile_text_is_laid_out() {
        let (_folder, fonts) = noto();
        for text in [
            "\u{202e}abc\u{301}\u{301}",
            "\u{301}",
            "\u{0}\n\t\u{7f}",
            "\u{feff}\u{200d}ж\u{200d}",
            "(ع)[ж",
        ] {
            let line = lay_out_with_fonts(text, &fonts);
            assert!(line.line_width_dots() < 400, "{text:?}");
            line.paint_text_line([0, 0], 2, |_, _, _| {});
        }
    }
}
