//! Fonts of the computer for letters that our fonts lack, and a placeholder for letters without any font.

use std::collections::BTreeSet;
use std::sync::Arc;

use chereme_figure::letters::{CODE_HEIGHT, SystemFonts, code_width, draw_code};
use eframe::egui::epaint::text::{
    FallbackRequest, FontInsert, FontPriority, FontProvider, GlyphBitmap, GlyphRasterizer, GlyphRasterizerRequest,
    InsertFontFamily, RasterizedGlyph,
};
use eframe::egui::{Color32, ColorImage, Context, FontData, vec2};

use crate::words::{InterfaceLanguage, InterfaceText, scripts as words};

/// Installs the fonts of this computer in a context; their names are read in the background.
pub(super) fn install_system_fonts(ctx: &Context) {
    SystemFonts::prepare_system_fonts();
    ctx.add_font_provider(Arc::new(OfComputer));
    ctx.add_glyph_rasterizer(GlyphRasterizer::new(
        "number of a letter without a font",
        draw_character_code,
    ));
}

struct OfComputer;

impl FontProvider for OfComputer {
    fn font_for(&self, request: &FallbackRequest<'_>) -> Option<FontInsert> {
        let letter = request.cluster.chars().next()?;
        let font = SystemFonts::shared_system_fonts().find_letter_font(letter)?;
        let family = InsertFontFamily {
            family: request.family.clone(),
            priority: FontPriority::Lowest,
        };
        let (name, index) = (font.name.clone(), font.index);
        let data = FontData::from_blob(font, index);
        Some(FontInsert::new(&name, data, vec![family]))
    }
}

/// Draws the code number of a letter that no font has.
#[allow(clippy::unnecessary_wraps, reason = "it is what egui asks")]
fn draw_character_code(request: &GlyphRasterizerRequest<'_>) -> Option<RasterizedGlyph> {
    let letter = request.cluster.chars().next()?;
    // The digits are sharp at whole pixels only.
    let scale = ((request.font_size_px / 14.0).round() as usize).clamp(1, 16);
    let (width, height) = (code_width(letter) * scale, CODE_HEIGHT * scale);
    let mut image = ColorImage::filled([width, height], Color32::TRANSPARENT);
    draw_code(letter, |x, y| {
        for i in 0..scale {
            for j in 0..scale {
                image.pixels[(y * scale + j) * width + x * scale + i] = Color32::WHITE;
            }
        }
    });
    let above = (request.font_size_px * 0.9).round();
    Some(RasterizedGlyph {
        bitmap: GlyphBitmap {
            image,
            offset_px: vec2(0.0, -above),
            is_color: false,
        },
        advance_px: width as f32,
    })
}

/// Scripts, by the first and last character of their blocks.
const SCRIPT_BLOCKS: [(char, char, InterfaceText); 17] = [
    ('\u{370}', '\u{3ff}', words::GREEK),
    ('\u{400}', '\u{52f}', words::CYRILLIC),
    ('\u{530}', '\u{58f}', words::ARMENIAN),
    ('\u{590}', '\u{5ff}', words::HEBREW),
    ('\u{600}', '\u{6ff}', words::ARABIC),
    ('\u{750}', '\u{77f}', words::ARABIC),
    ('\u{900}', '\u{97f}', words::DEVANAGARI),
    ('\u{980}', '\u{9ff}', words::BENGALI),
    ('\u{b80}', '\u{bff}', words::TAMIL),
    ('\u{e00}', '\u{e7f}', words::THAI),
    ('\u{10a0}', '\u{10ff}', words::GEORGIAN),
    ('\u{1200}', '\u{137f}', words::ETHIOPIC),
    ('\u{3040}', '\u{30ff}', words::JAPANESE),
    ('\u{3400}', '\u{9fff}', words::CHINESE),
    ('\u{ac00}', '\u{d7af}', words::KOREAN),
    ('\u{1100}', '\u{11ff}', words::KOREAN),
    ('\u{fb50}', '\u{fefc}', words::ARABIC),
];

/// The scripts without a font that have been reported, each once.
#[derive(Debug, Default)]
pub(crate) struct UnreportedScripts {
    reported: BTreeSet<String>,
}

impl UnreportedScripts {
    /// Returns a notice and a remedy for letters without a font that were shown since the last call.
    pub(crate) fn take_missing_font_notice(&mut self, language: InterfaceLanguage) -> Option<(String, &'static str)> {
        let missing = SystemFonts::ready_system_fonts()?.take_missing();
        self.notice_for_missing_letters(&missing, language)
    }

    fn notice_for_missing_letters(
        &mut self,
        missing: &BTreeSet<char>,
        language: InterfaceLanguage,
    ) -> Option<(String, &'static str)> {
        let names: BTreeSet<&'static str> = missing
            .iter()
            .filter_map(|letter| {
                let within = |(first, last, _): &&(char, char, InterfaceText)| (*first..=*last).contains(letter);
                let (_, _, name) = SCRIPT_BLOCKS.iter().find(within)?;
                Some(name.text_in_language(language))
            })
            .filter(|name| self.reported.insert((*name).to_owned()))
            .collect();
        if names.is_empty() {
            return None;
        }
        let names = Vec::from_iter(names).join(", ");
        let text = crate::words::fill_text_braces(words::NO_FONT.text_in_language(language), &[("scripts", &names)]);
        Some((text, words::NO_FONT_HELP.text_in_language(language)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_without_a_font_are_reported_once_by_name() {
        let mut unreported = UnreportedScripts::default();
        let letters = BTreeSet::from(['ع', 'غ', 'Ж', '\u{e000}']);
        let (text, _) = unreported
            .notice_for_missing_letters(&letters, InterfaceLanguage::English)
            .expect("news");
        assert!(text.contains("Arabic, Cyrillic"), "{text}");
        assert!(
            unreported
                .notice_for_missing_letters(&letters, InterfaceLanguage::English)
                .is_none()
        );
        let (text, _) = unreported
            .notice_for_missing_letters(&BTreeSet::from(['א']), InterfaceLanguage::French)
            .expect("news");
        assert!(text.contains("hébreu"), "{text}");
    }

    #[test]
    fn a_letter_without_a_font_is_drawn_as_its_code() {
        let request = |cluster| GlyphRasterizerRequest {
            cluster,
            family: &eframe::egui::FontFamily::Proportional,
            font_size_px: 28.0,
            subpixel_offset_px: 0.0,
        };
        let ain = draw_character_code(&request("ع")).expect("a picture");
        let ghain = draw_character_code(&request("غ")).expect("a picture");
        assert_eq!(ain.bitmap.image.size, [24, 30]);
        assert_ne!(ain.bitmap.image.pixels, ghain.bitmap.image.pixels);
    }
}
