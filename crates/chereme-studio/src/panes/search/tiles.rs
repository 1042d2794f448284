//! The three tiles that begin a search: a hand, the body, a movement; each opens the pictures of its values.

use chereme_sign::{ComponentInventory, SignComponent};
use eframe::egui::{
    Align2, CornerRadius, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2,
};

use super::search_builder::with_value;
use crate::context::PaneInput;
use crate::miniatures;
use crate::pickers::{self, ValuePicker};
use crate::words::{InterfaceText, search_words as words};

/// The height of a tile, in points.
const TILE_HEIGHT_POINTS: f32 = 92.0;
/// The time for which a tile shows each value, in seconds.
const TILE_VALUE_SECONDS: f64 = 1.6;
/// The space between two tiles, in points.
const TILE_GAP_POINTS: f32 = 8.0;
/// The room on the right for the bar that scrolls the pane.
const TILE_SCROLLBAR_MARGIN_POINTS: f32 = 6.0;

/// A tile: its component, its name, and sample values, which are shown one after the other.
const SAMPLE_TILES: [(SignComponent, InterfaceText, [&str; 4]); 3] = [
    (SignComponent::Configuration, words::TILE_HAND, ["5", "U", "1", "S"]),
    (
        SignComponent::Placement,
        words::TILE_BODY,
        ["forehead", "chest", "chin", "shoulder"],
    ),
    (
        SignComponent::Movement,
        words::TILE_MOVEMENT,
        ["arc", "circle", "straight", "zigzag"],
    ),
];

/// The pickers of the tiles.
#[derive(Debug, Default)]
pub(super) struct TilePickers {
    pickers: [ValuePicker; 3],
}

impl TilePickers {
    /// Shows the tiles; returns the query for the picked value.
    pub(super) fn show_component_tiles(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) -> Option<String> {
        let tiles: Vec<(usize, &ComponentInventory)> = SAMPLE_TILES
            .iter()
            .enumerate()
            .filter_map(|(at, (component, ..))| Some((at, largest_component_inventory(seen, *component)?)))
            .collect();
        if tiles.is_empty() {
            return None;
        }
        let room = ui.available_width() - TILE_SCROLLBAR_MARGIN_POINTS;
        let width = (room + TILE_GAP_POINTS) / tiles.len() as f32 - TILE_GAP_POINTS;
        let mut query = None;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = TILE_GAP_POINTS;
            for (at, inventory) in tiles {
                let (component, name, _) = &SAMPLE_TILES[at];
                let name = seen.say_text(*name);
                let response = tile(ui, seen, at, inventory, name, width);
                let picker = &mut self.pickers[at];
                if let Some(value) = pickers::show_picker_below(ui, &response, picker, seen, inventory, None, name) {
                    query = Some(with_value("", component.component_name(), &value));
                }
                picker.inspect_requested_value(seen);
            }
        });
        ui.add_space(4.0);
        query
    }
}

/// Returns the inventory of a component with the most values.
fn largest_component_inventory<'a>(seen: &PaneInput<'a>, component: SignComponent) -> Option<&'a ComponentInventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|stored| &stored.inventory)
        .filter(|inventory| inventory.component == component && inventory.feature.is_none())
        .max_by_key(|inventory| inventory.values.len())
}

fn tile(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    at: usize,
    inventory: &ComponentInventory,
    name: &str,
    width: f32,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, TILE_HEIGHT_POINTS), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let colours = seen.pane_colours();
    let lit = response.hovered() || response.has_focus();
    let (line, colour) = if lit {
        (2.0, colours.accent)
    } else {
        (1.0, colours.rule)
    };
    let fill = ui.visuals().extreme_bg_color;
    let stroke = Stroke::new(line, colour);
    let corner = CornerRadius::same(8);
    ui.painter().rect(rect, corner, fill, stroke, StrokeKind::Inside);
    let turn = (miniatures::figure_loop_clock(ui) / TILE_VALUE_SECONDS) as usize + at;
    let tile_values = SAMPLE_TILES[at].2.into_iter().cycle().skip(turn % 4).take(4);
    let side = TILE_HEIGHT_POINTS - 34.0;
    let picture = Rect::from_center_size(pos2(rect.center().x, rect.top() + 5.0 + side / 2.0), vec2(side, side));
    for value in tile_values {
        if pickers::paint_inventory_value(ui, picture, seen, inventory, value) {
            break;
        }
    }
    ui.ctx().request_repaint_after_secs(TILE_VALUE_SECONDS as f32 / 4.0);
    let below = pos2(rect.center().x, rect.bottom() - 14.0);
    let text = ui.visuals().text_color();
    let styled_galley = |style: TextStyle| {
        let font = style.resolve(ui.style());
        ui.painter().layout_no_wrap(name.to_owned(), font, text)
    };
    let mut galley = styled_galley(TextStyle::Body);
    if galley.size().x > width - 8.0 {
        galley = styled_galley(TextStyle::Small);
    }
    let text_rect = Align2::CENTER_CENTER.anchor_size(below, galley.size());
    ui.painter().galley(text_rect.min, galley, text);
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_by_id;

    #[test]
    fn each_tile_has_built_in_values_to_show() {
        let ids = ["configurations", "placements", "movements"];
        for ((_, _, values), id) in SAMPLE_TILES.iter().zip(ids) {
            let inventory = builtin_by_id(id).expect("of the house");
            let known = values.iter().filter(|it| inventory.find_inventory_value(it).is_some());
            assert!(known.count() >= 2, "{id}");
        }
    }
}
