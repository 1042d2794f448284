//! Colours, fonts and spacing.
//!
//! The hues are those of Okabe and Ito, which people with any colour vision can distinguish.

use chereme_corpus::TierRole;
use eframe::egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Style, TextStyle, Theme,
    ThemePreference, Vec2, epaint::Hsva,
};

use crate::settings::{StudioSettings, ThemeChoice};

/// Colours with a fixed meaning.
#[derive(Debug)]
pub(crate) struct ThemeColours {
    /// Selected things, and prompts to the user.
    pub(crate) accent: Color32,
    /// The selected time.
    pub(crate) selection: Color32,
    pub(crate) playhead: Color32,
    /// Annotations, by the role of their tier.
    pub(crate) gloss: Color32,
    pub(crate) component: Color32,
    pub(crate) words: Color32,
    pub(crate) free: Color32,
    /// Text on annotations.
    pub(crate) on_annotation: Color32,
    /// Selected annotations, whatever their tier, and the text on them.
    pub(crate) chosen: Color32,
    pub(crate) on_chosen: Color32,
    /// The edge of a field for text.
    pub(crate) field_edge: Color32,
    /// Lines between tiers, and the background of every other tier.
    pub(crate) rule: Color32,
    pub(crate) stripe: Color32,
    pub(crate) trouble: Color32,
    /// A remark that is not a fault.
    pub(crate) warning: Color32,
    pub(crate) good: Color32,
}

const LIGHT_THEME_COLOURS: ThemeColours = ThemeColours {
    accent: Color32::from_rgb(0x00, 0x62, 0xA3),
    selection: Color32::from_rgb(0xBF, 0xDD, 0xF2),
    playhead: Color32::from_rgb(0xC2, 0x41, 0x00),
    gloss: Color32::from_rgb(0xF2, 0xC9, 0x6B),
    component: Color32::from_rgb(0x9C, 0xCB, 0xEE),
    words: Color32::from_rgb(0x9D, 0xD8, 0xC3),
    free: Color32::from_rgb(0xD5, 0xD2, 0xDB),
    on_annotation: Color32::from_rgb(0x16, 0x1B, 0x22),
    chosen: Color32::from_rgb(0x7A, 0x2A, 0x04),
    on_chosen: Color32::WHITE,
    field_edge: Color32::from_rgb(0x85, 0x8F, 0x9D),
    rule: Color32::from_rgb(0xD3, 0xD8, 0xE0),
    stripe: Color32::from_rgb(0xEE, 0xF1, 0xF4),
    trouble: Color32::from_rgb(0xA8, 0x32, 0x00),
    warning: Color32::from_rgb(0x8A, 0x5C, 0x00),
    good: Color32::from_rgb(0x00, 0x6B, 0x4F),
};

const DARK_THEME_COLOURS: ThemeColours = ThemeColours {
    accent: Color32::from_rgb(0x6D, 0xB9, 0xEA),
    selection: Color32::from_rgb(0x27, 0x4A, 0x66),
    playhead: Color32::from_rgb(0xFF, 0x95, 0x4F),
    gloss: Color32::from_rgb(0xE0, 0xA8, 0x2E),
    component: Color32::from_rgb(0x5F, 0xA8, 0xD9),
    words: Color32::from_rgb(0x3E, 0xAF, 0x8A),
    free: Color32::from_rgb(0x83, 0x87, 0x93),
    on_annotation: Color32::from_rgb(0x0C, 0x0F, 0x14),
    chosen: Color32::from_rgb(0xFF, 0xF1, 0xE2),
    on_chosen: Color32::from_rgb(0x0C, 0x0F, 0x14),
    field_edge: Color32::from_rgb(0x63, 0x6D, 0x7C),
    rule: Color32::from_rgb(0x33, 0x3A, 0x46),
    stripe: Color32::from_rgb(0x20, 0x25, 0x2D),
    trouble: Color32::from_rgb(0xFF, 0x9A, 0x70),
    warning: Color32::from_rgb(0xF5, 0xC9, 0x4B),
    good: Color32::from_rgb(0x5F, 0xD0, 0xA8),
};

impl ThemeColours {
    pub(crate) fn colours_for_theme(dark: bool) -> &'static Self {
        if dark {
            &DARK_THEME_COLOURS
        } else {
            &LIGHT_THEME_COLOURS
        }
    }

    /// Returns the colour of annotations of a tier with that role.
    pub(crate) fn tier_role_colour(&self, role: &TierRole) -> Color32 {
        match role {
            TierRole::Gloss => self.gloss,
            TierRole::Component { .. } => self.component,
            role if role.is_prose() => self.words,
            _ => self.free,
        }
    }
}

/// Returns the colours of the right and the left hand, like those of the figure, strong enough for lines and text.
pub(crate) fn hand_theme_colours(dark: bool) -> [Color32; 2] {
    let palette = chereme_figure::FigurePalette::default().with_hands_apart();
    [palette.right, palette.left].map(|hand| {
        let [r, g, b] = hand.back.0;
        let hue = Hsva::from(Color32::from_rgb(r, g, b));
        let (s, v) = if dark { (0.42, 0.95) } else { (0.80, 0.33) };
        let s = hue.s.max(s);
        Hsva { s, v, ..hue }.into()
    })
}

/// Sets up a context once: our fonts and spacing, and shapes that are cheap to draw.
pub(crate) fn install_studio_theme(ctx: &Context) {
    ctx.set_fonts(fonts());
    // egui's own shortcut quits with Alt held, too; the table of actions has the keys.
    ctx.options_mut(|options| options.quit_shortcuts.clear());
    ctx.add_plugin(crate::pixel_rects::ShapeSimplifier);
    ctx.style_mut_of(Theme::Light, |style| refine(style, false));
    ctx.style_mut_of(Theme::Dark, |style| refine(style, true));
}

/// Applies theme and scale.
pub(crate) fn apply_theme_settings(ctx: &Context, settings: &StudioSettings) {
    ctx.set_theme(match settings.theme {
        ThemeChoice::System => ThemePreference::System,
        ThemeChoice::Light => ThemePreference::Light,
        ThemeChoice::Dark => ThemePreference::Dark,
    });
    if (ctx.zoom_factor() - settings.scale).abs() > 1e-3 {
        ctx.set_zoom_factor(settings.scale);
    }
}

/// Returns the fonts: Noto Sans, which has phonetic letters, before egui's fonts, which have signs that Noto Sans
/// lacks.
fn fonts() -> FontDefinitions {
    const NOTO_FONT_NAME: &str = "Noto Sans";
    let mut fonts = FontDefinitions::default();
    let data = FontData::from_static(notosans::REGULAR_TTF);
    fonts.font_data.insert(NOTO_FONT_NAME.to_owned(), data.into());
    let usual = fonts.families.entry(FontFamily::Proportional).or_default();
    usual.insert(0, NOTO_FONT_NAME.to_owned());
    usual.push("Hack".to_owned());
    let fixed = fonts.families.entry(FontFamily::Monospace).or_default();
    fixed.push(NOTO_FONT_NAME.to_owned());
    fonts
}

fn refine(style: &mut Style, dark: bool) {
    let colours = ThemeColours::colours_for_theme(dark);
    for (text, size) in [
        (TextStyle::Small, 11.5),
        (TextStyle::Body, 14.0),
        (TextStyle::Button, 14.0),
        (TextStyle::Heading, 19.0),
    ] {
        style.text_styles.insert(text, FontId::proportional(size));
    }
    style.text_styles.insert(TextStyle::Monospace, FontId::monospace(13.0));
    style.spacing.item_spacing = Vec2::new(8.0, 6.0);
    style.spacing.button_padding = Vec2::new(8.0, 4.0);
    style.spacing.interact_size.y = 24.0;
    // Long drop-down lists, and visible scroll bars.
    style.spacing.combo_height = 420.0;
    style.spacing.scroll.dormant_handle_opacity = 0.45;
    style.spacing.scroll.dormant_background_opacity = 0.15;
    let visuals = &mut style.visuals;
    visuals.selection.bg_fill = colours.selection;
    visuals.selection.stroke.color = if dark { Color32::WHITE } else { colours.on_annotation };
    visuals.hyperlink_color = colours.accent;
    let (panel, edge, text) = if dark {
        (
            Color32::from_rgb(0x1A, 0x1E, 0x25),
            Color32::from_rgb(0x12, 0x15, 0x1A),
            Color32::from_rgb(0xDF, 0xE4, 0xEA),
        )
    } else {
        (
            Color32::from_rgb(0xF7, 0xF8, 0xFA),
            Color32::WHITE,
            Color32::from_rgb(0x22, 0x29, 0x33),
        )
    };
    visuals.panel_fill = panel;
    visuals.window_fill = panel;
    visuals.extreme_bg_color = edge;
    visuals.widgets.noninteractive.fg_stroke.color = text;
    visuals.widgets.noninteractive.bg_stroke.color = colours.rule;
    visuals.widgets.inactive.fg_stroke.color = text;
    let fills = if dark {
        [0x2A_31_3C, 0x35_3E_4B, 0x40_4B_5A]
    } else {
        [0xE6_EA_EF, 0xD8_DF_E7, 0xC8_D2_DD]
    };
    let widgets = &mut visuals.widgets;
    for (widget, fill) in [
        (&mut widgets.inactive, fills[0]),
        (&mut widgets.hovered, fills[1]),
        (&mut widgets.open, fills[1]),
        (&mut widgets.active, fills[2]),
    ] {
        let [_, r, g, b] = u32::to_be_bytes(fill);
        let fill = Color32::from_rgb(r, g, b);
        (widget.bg_fill, widget.weak_bg_fill) = (fill, fill);
    }
    for widget in [
        &mut visuals.widgets.inactive,
        &mut visuals.widgets.hovered,
        &mut visuals.widgets.active,
    ] {
        widget.corner_radius = CornerRadius::same(5);
    }
    visuals.widgets.active.fg_stroke.color = text;
}

/// Returns whether the context uses the dark theme.
pub(crate) fn is_dark(ctx: &Context) -> bool {
    ctx.theme() == Theme::Dark
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{FontId, RawInput};

    /// Returns the contrast ratio of two colours, as defined by WCAG.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let light = |it: Color32| {
            let it = eframe::egui::Rgba::from(it);
            0.2126 * it.r() + 0.7152 * it.g() + 0.0722 * it.b() + 0.05
        };
        let (a, b) = (light(a), light(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn the_selection_differs_in_lightness_from_every_tier() {
        for dark in [false, true] {
            let colours = ThemeColours::colours_for_theme(dark);
            for role in ["gloss", "configuration", "translation", "free"] {
                let role: TierRole = role.parse().expect("a role");
                let apart = contrast(colours.chosen, colours.tier_role_colour(&role));
                assert!(apart >= 1.8, "{dark} {role:?}: {apart}");
            }
            assert!(contrast(colours.chosen, colours.on_chosen) >= 4.5);
        }
    }

    #[test]
    fn fields_for_text_have_a_visible_edge() {
        for dark in [false, true] {
            let ctx = Context::default();
            install_studio_theme(&ctx);
            let theme = if dark { Theme::Dark } else { Theme::Light };
            let visuals = ctx.style_of(theme).visuals.clone();
            let edge = ThemeColours::colours_for_theme(dark).field_edge;
            for ground in [visuals.panel_fill, visuals.text_edit_bg_color()] {
                let apart = contrast(edge, ground);
                assert!(apart >= 3.0, "{dark} {ground:?}: {apart}");
            }
        }
    }

    #[test]
    fn lines_of_the_two_hands_are_visible_and_distinguishable() {
        for (dark, ground) in [(false, 0xF7), (true, 0x1A)] {
            let [right, left] = hand_theme_colours(dark);
            for hand in [right, left] {
                assert!(contrast(hand, Color32::from_gray(ground)) >= 3.0, "{dark} {hand:?}");
            }
            let warm = |it: Color32| i32::from(it.r()) - i32::from(it.b());
            assert!(warm(right) > 40 && warm(left) < -40, "{dark} {right:?} {left:?}");
        }
    }

    #[test]
    fn the_fonts_cover_phonetic_letters_and_all_texts_of_the_window() {
        let ctx = Context::default();
        install_studio_theme(&ctx);
        ctx.run_ui(RawInput::default(), |_| {}).textures_delta.clear();
        ctx.run_ui(RawInput::default(), |_| {}).textures_delta.clear();
        let text = "ɛɔəʃʒŋθðʔɑɪʊ éèêëàçùœÉŒ …’·→←↑↓×²°±≤≥";
        let missing: Vec<char> = text
            .chars()
            .filter(|letter| {
                !letter.is_whitespace() && !ctx.fonts_mut(|fonts| fonts.has_glyph(&FontId::proportional(14.0), *letter))
            })
            .collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}
