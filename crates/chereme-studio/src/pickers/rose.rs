//! Roses of directions: for palm and finger orientations, and for directions of movement.
//!
//! Drawn from the signer's point of view, as in HamNoSys: the signer's right is on the right.

use chereme_sign::inventory::InventoryValue;
use eframe::egui::{Align2, Color32, Painter, Rect, RichText, Sense, TextStyle, Ui, Vec2, vec2};

use super::glyph::{self, GlyphLine};
use super::pickers_cells::{PickerCell, PickerCells};
use super::{ValuePicker, pickers_paint};
use crate::words::pickers as words;

/// Returns the place of a value in the roses: which of the three (away from the signer, level, towards), and the column
/// and row relative to its centre.
pub(crate) fn rose_place_of_value(value: &InventoryValue) -> Option<(usize, [i32; 2])> {
    let sign = |part: f64| {
        if part.abs() < 0.2 { 0 } else { part.signum() as i32 }
    };
    if let Some([left, up, forward]) = value.direction {
        let rose = (1 - sign(forward)) as usize;
        return Some((rose, [-sign(left), -sign(up)]));
    }
    // The palm faces down at 0, then to the signer's right, up, and to the left.
    let roll = value.roll?;
    Some((1, [sign(roll.sin()), sign(roll.cos())]))
}

/// Draws the roses that the inventory needs.
pub(super) fn show_direction_roses(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
) -> Option<String> {
    let values = &cells.inventory.values;
    let places: Vec<Option<(usize, [i32; 2])>> = values.iter().map(rose_place_of_value).collect();
    let used: Vec<usize> = (0..3)
        .filter(|rose| places.iter().flatten().any(|(of, _)| of == rose))
        .collect();
    ui.label(RichText::new(cells.seen.say_text(words::AS_SIGNER)).small());
    let gap = 18.0;
    let room = ui.available_width() - gap * (used.len() as f32 - 1.0);
    let side = (room / used.len() as f32).clamp(96.0, 150.0);
    let head = 20.0;
    let rose_size = vec2(side * used.len() as f32 + gap * (used.len() as f32 - 1.0), side + head);
    let (area, _) = ui.allocate_exact_size(rose_size, Sense::hover());
    let mut all = Vec::new();
    for (column, rose) in used.iter().enumerate() {
        let left = area.left() + column as f32 * (side + gap);
        let square = Rect::from_min_size(eframe::egui::pos2(left, area.top() + head), Vec2::splat(side));
        if used.len() > 1 {
            let name = [words::AWAY, words::LEVEL, words::TOWARDS][*rose];
            let text_position = square.center_top() - vec2(0.0, 4.0);
            let font = TextStyle::Small.resolve(ui.style());
            let colour = ui.visuals().text_color();
            let name = cells.seen.say_text(name);
            ui.painter()
                .text(text_position, Align2::CENTER_BOTTOM, name, font, colour);
        }
        // A rose is a field of three by three: eight directions around the one along the line of sight.
        let third = side / 3.0;
        for (value, place) in places.iter().enumerate() {
            let Some((_, [x, y])) = place.filter(|(of, _)| of == rose) else {
                continue;
            };
            let centre = square.center() + vec2(x as f32, y as f32) * third;
            all.push(PickerCell {
                value,
                rect: Rect::from_center_size(centre, Vec2::splat(third - 3.0)),
            });
        }
    }
    // Values that the filter hides keep their place empty, so that directions do not move.
    all.retain(|cell| shown.contains(&cell.value));
    let colours = cells.seen.pane_colours();
    cells.show_picker_cells(ui, picker, &all, |ui, cell, state| {
        let painter = ui.painter();
        painter.rect_filled(
            cell.rect,
            5.0,
            pickers_paint::picture_background_colour(cells.seen.dark),
        );
        let colour = ui.visuals().text_color();
        paint_direction_arrow(painter, cell.rect, &values[cell.value], colour);
        pickers_paint::paint_cell_frame(painter, cell.rect, &state, colours.accent, colours.rule);
    })
}

/// Paints the arrow of a direction; returns whether the value has one.
pub(super) fn paint_direction_arrow(painter: &Painter, rect: Rect, value: &InventoryValue, colour: Color32) -> bool {
    let Some((rose, [x, y])) = rose_place_of_value(value) else {
        return false;
    };
    let to = vec2(x as f32, y as f32).normalized();
    if x != 0 || y != 0 {
        let line = GlyphLine {
            points: vec![to * -0.7, to * 0.8],
            arrow: true,
            weight: 1.0,
        };
        glyph::draw_glyph_line(painter, rect, &line, colour);
    }
    // The convention of technical drawings: a point for an arrow towards the viewer, feathers for one that goes away.
    let half = rect.width().min(rect.height()) * 0.42;
    let end = rect.center() - to * (half * 0.7);
    let size = if x == 0 && y == 0 { 0.5 } else { 0.22 } * half;
    match (rose, value.roll) {
        (0, None) => {
            painter.circle_stroke(end, size, (1.5, colour));
            for diagonal in [vec2(1.0, 1.0), vec2(1.0, -1.0)] {
                let arm = diagonal.normalized() * size;
                painter.line_segment([end - arm, end + arm], (1.5, colour));
            }
        }
        (2, None) => {
            painter.circle_stroke(end, size, (1.5, colour));
            painter.circle_filled(end, size * 0.4, colour);
        }
        _ => {}
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_by_id;
    use std::collections::BTreeSet;

    #[test]
    fn every_direction_has_a_distinct_position() {
        for name in ["palm", "fingers", "directions"] {
            let inventory = builtin_by_id(name).expect("of the house");
            let places: BTreeSet<_> = inventory.values.iter().filter_map(rose_place_of_value).collect();
            assert_eq!(places.len(), inventory.values.len(), "{name}");
        }
        let at = |inventory, id| {
            let inventory = builtin_by_id(inventory).expect("of the house");
            rose_place_of_value(inventory.value_by_id(id).expect("a value"))
        };
        assert_eq!(at("fingers", "right"), Some((1, [1, 0])));
        assert_eq!(at("fingers", "up-out-left"), Some((0, [-1, -1])));
        assert_eq!(at("directions", "in"), Some((2, [0, 0])));
        assert_eq!(at("palm", "up"), Some((1, [0, -1])));
        assert_eq!(at("palm", "right"), Some((1, [1, 0])));
        assert_eq!(at("palm", "down-left"), Some((1, [-1, 1])));
    }
}
