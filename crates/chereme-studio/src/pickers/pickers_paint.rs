//! Painting of a value: a hand, a place, a glyph, an arrow, or its name.

use std::hash::{DefaultHasher, Hash, Hasher};

use chereme_corpus::value_pictures::facial_expression_of_value;
use chereme_figure::palette::PaperTheme;
use chereme_figure::raster::FigureStyle;
use chereme_figure::{HandshapeOptions, RasterImage, handshape_picture};
use chereme_motion::HandAngles;
use chereme_sign::ComponentInventory;
use chereme_sign::inventory::InventoryValue;
use eframe::egui::emath::GuiRounding;
use eframe::egui::text::LayoutJob;
use eframe::egui::{
    Align, Align2, Color32, ColorImage, FontId, Rect, Stroke, StrokeKind, TextStyle, Ui, Vec2, pos2, vec2,
};

use super::pickers_cells::{CellState, PickerCells};
use super::pickers_data::{self, PickerForm};
use super::{gallery, glyph, pickers_places, rose};
use crate::context::PaneInput;

/// Width and height of a hand's picture, in pixels.
const HAND_PICTURE_SIZE_PIXELS: usize = 144;
/// The height of a line of a name, in points.
const NAME_LINE_HEIGHT_POINTS: f32 = 22.0;
/// The least and the greatest width of the picture of a place or a face, in pixels.
const MIN_PLACE_PICTURE_PIXELS: usize = 16;
const MAX_PLACE_PICTURE_PIXELS: usize = 400;

/// Returns whether a value has a picture.
pub(super) fn has_value_picture(inventory: &ComponentInventory, value: &InventoryValue) -> bool {
    match pickers_data::inventory_picker_form(inventory) {
        PickerForm::Hands => pickers_data::value_hand_angles(value).is_some(),
        PickerForm::Body => value.landmark.is_some(),
        PickerForm::Faces => facial_expression_of_value(inventory, value).is_some(),
        PickerForm::Rose => value.direction.is_some() || value.roll.is_some(),
        PickerForm::Glyphs => glyph::movement_glyph_lines(&value.id).is_some(),
        PickerForm::Names => false,
    }
}

/// Paints a value's picture into `rect`; returns whether it has one.
pub(super) fn paint_value_picture(
    ui: &Ui,
    rect: Rect,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    value: &InventoryValue,
) -> bool {
    let colour = ui.visuals().text_color();
    match pickers_data::inventory_picker_form(inventory) {
        PickerForm::Hands => pickers_data::value_hand_angles(value).is_some_and(|angles| {
            paint_hand_picture(ui, rect, seen.dark, &angles);
            true
        }),
        PickerForm::Body | PickerForm::Faces => paint_small_picture(ui, rect, seen, inventory, value),
        PickerForm::Rose => rose::paint_direction_arrow(ui.painter(), rect, value, colour),
        PickerForm::Glyphs => glyph::paint_movement_glyph(ui.painter(), rect, &value.id, colour),
        PickerForm::Names => false,
    }
}

/// Paints a cell of a table: its picture, its name below, its frame.
pub(super) fn paint_table_cell(
    ui: &Ui,
    rect: Rect,
    cells: &PickerCells<'_>,
    it: &InventoryValue,
    state: &CellState,
    digit: Option<usize>,
) {
    let colours = cells.seen.pane_colours();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let paper = picture_background_colour(cells.seen.dark);
    painter.rect_filled(rect, 5.0, paper);
    if state.chosen {
        // Below the picture, which stays as clear as the others.
        painter.rect_filled(rect, 5.0, colours.accent.gamma_multiply(0.3));
    }
    let name = TextStyle::Body.resolve(ui.style());
    let text = ui.visuals().text_color();
    let foot = 20.0;
    let pictured = has_value_picture(cells.inventory, it);
    if pictured {
        let side = (rect.height() - foot - 2.0).min(rect.width() - 4.0);
        let square = Rect::from_center_size(pos2(rect.center().x, rect.top() + 2.0 + side / 2.0), vec2(side, side));
        paint_value_picture(ui, square, cells.seen, cells.inventory, it);
    }
    let room = rect.width() - 8.0;
    if pictured {
        let full_label = pickers_data::short_name(it, cells.seen.language).to_owned();
        let label = shorten_text_to_width(ui, full_label, &name, room);
        let text_position = pos2(rect.center().x, rect.bottom() - foot / 2.0 - 1.0);
        painter.text(text_position, Align2::CENTER_CENTER, label, name, text);
    } else {
        // A cell as high as those with pictures has room for several lines.
        let label = pickers_data::inventory_value_label(it, cells.seen.language);
        let mut lines = LayoutJob::simple(label, name, text, room);
        lines.wrap.max_rows = ((rect.height() / NAME_LINE_HEIGHT_POINTS) as usize).max(1);
        lines.halign = Align::Center;
        let galley = painter.layout_job(lines);
        let text_position = rect.center() - vec2(0.0, galley.size().y / 2.0);
        painter.galley(text_position, galley, text);
    }
    if let Some(digit) = digit {
        let small = FontId::proportional(10.0);
        let digit_position = rect.left_top() + vec2(5.0, 3.0);
        if pictured {
            let back = Rect::from_min_size(rect.left_top(), vec2(14.0, 17.0));
            painter.rect_filled(back, 5.0, paper.gamma_multiply(0.8));
        }
        let weak = ui.visuals().weak_text_color();
        painter.text(digit_position, Align2::LEFT_TOP, digit, small, weak);
    }
    paint_cell_outline(&painter, rect, state, colours.accent, colours.rule);
}

/// Paints the frame and the filling that show the state of a cell.
pub(super) fn paint_cell_frame(
    painter: &eframe::egui::Painter,
    rect: Rect,
    state: &CellState,
    accent: Color32,
    rule: Color32,
) {
    if state.chosen {
        painter.rect_filled(rect, 5.0, accent.gamma_multiply(0.14));
    }
    paint_cell_outline(painter, rect, state, accent, rule);
}

/// Paints the frame alone.
fn paint_cell_outline(painter: &eframe::egui::Painter, rect: Rect, state: &CellState, accent: Color32, rule: Color32) {
    let stroke = match (state.at || state.hovered, state.chosen) {
        (true, _) => Stroke::new(2.0, accent),
        (false, true) => Stroke::new(1.5, accent.gamma_multiply(0.7)),
        _ => Stroke::new(1.0, rule.gamma_multiply(0.6)),
    };
    painter.rect_stroke(rect, 5.0, stroke, StrokeKind::Inside);
}

/// Returns a text, shortened if necessary to fit into `width` points.
pub(crate) fn shorten_text_to_width(ui: &Ui, text: String, font: &FontId, width: f32) -> String {
    let wide = |text: &str| {
        ui.painter()
            .layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE)
            .size()
            .x
    };
    if wide(&text) <= width {
        return text;
    }
    let mut letters: Vec<char> = text.chars().collect();
    while letters.len() > 1 {
        letters.pop();
        let shorter: String = letters.iter().chain(&['…']).collect();
        if wide(&shorter) <= width {
            return shorter;
        }
    }
    text
}

/// Returns the background colour of pictures of hands and bodies.
pub(super) fn picture_background_colour(dark: bool) -> Color32 {
    let [r, g, b] = picture_theme(dark).theme_paper_colour().0;
    Color32::from_rgb(r, g, b)
}

pub(super) fn picture_theme(dark: bool) -> PaperTheme {
    if dark { PaperTheme::Dark } else { PaperTheme::Light }
}

/// Paints the picture of a place or a face, drawn at the size of `rect`; returns whether the value has one.
fn paint_small_picture(
    ui: &Ui,
    rect: Rect,
    seen: &PaneInput<'_>,
    inventory: &ComponentInventory,
    value: &InventoryValue,
) -> bool {
    let face = facial_expression_of_value(inventory, value);
    if value.landmark.is_none() && face.is_none() {
        return false;
    }
    let scale = ui.pixels_per_point();
    let square = Rect::from_center_size(rect.center(), Vec2::splat(rect.size().min_elem()));
    let rect = square.round_to_pixels(scale);
    let size = ((rect.width() * scale).round() as usize).clamp(MIN_PLACE_PICTURE_PIXELS, MAX_PLACE_PICTURE_PIXELS);
    let mut hasher = DefaultHasher::new();
    ("small", seen.dark, size, &inventory.id, &value.id).hash(&mut hasher);
    // A changed value has another picture.
    format!("{face:?} {:?} {:?}", inventory.feature, value.landmark).hash(&mut hasher);
    let (theme, inventory, value) = (picture_theme(seen.dark), inventory.clone(), value.clone());
    let texture = gallery::find_gallery_picture(ui.ctx(), hasher.finish(), move || {
        let scene = pickers_places::load_body_scene()?;
        let image = match face {
            Some(face) => {
                let feature = inventory.feature.as_deref().unwrap_or_default();
                scene.draw_expression_picture(&face, feature, size, theme)?
            }
            None => scene.draw_place_picture(&inventory, &value, size, theme)?,
        };
        Some(colour_image(&image))
    });
    if let Some(texture) = texture {
        let full_uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture, rect, full_uv, Color32::WHITE);
    }
    true
}

fn paint_hand_picture(ui: &Ui, rect: Rect, dark: bool, angles: &HandAngles) {
    let mut hasher = DefaultHasher::new();
    ("hand", dark).hash(&mut hasher);
    angles.to_array().map(f64::to_bits).hash(&mut hasher);
    let angles = *angles;
    let texture = gallery::find_gallery_picture(ui.ctx(), hasher.finish(), move || {
        let usual = HandshapeOptions::with_small_size(HAND_PICTURE_SIZE_PIXELS);
        let options = HandshapeOptions {
            style: FigureStyle {
                theme: picture_theme(dark),
                ..usual.style
            },
            ..usual
        };
        Some(colour_image(&handshape_picture(&angles, &options).ok()?))
    });
    if let Some(texture) = texture {
        let full_uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture, rect, full_uv, Color32::WHITE);
    }
}

/// Converts a picture to egui's type.
pub(super) fn colour_image(image: &RasterImage) -> ColorImage {
    let pixels = image
        .image_pixels()
        .iter()
        .map(|pixel| Color32::from_rgb(pixel.0[0], pixel.0[1], pixel.0[2]));
    ColorImage::new([image.image_width(), image.image_height()], pixels.collect())
}
