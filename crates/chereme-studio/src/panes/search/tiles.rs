//! The three tiles that begin a search: a hand, the body, a movement; each opens the pictures of its values.

use chereme_sign::{Component, Inventory};
use eframe::egui::{
    Align2, CornerRadius, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};

use super::builder::with_value;
use crate::context::{Outbox, PaneInput};
use crate::miniatures;
use crate::pickers::{self, Picker};
use crate::words::{Text, search as words};

/// The height of a tile, in points.
const HIGH: f32 = 92.0;
/// The time for which a tile shows each value, in seconds.
const TURN: f64 = 1.6;
/// The space between two tiles, in points.
const GAP: f32 = 8.0;
/// The room on the right for the bar that scrolls the pane.
const MARGIN: f32 = 6.0;

/// A tile: its component, its name, and sample values, which are shown one after the other.
const TILES: [(Component, Text, [&str; 4]); 3] = [
    (
        Component::Configuration,
        words::TILE_HAND,
        ["5", "U", "1", "S"],
    ),
    (
        Component::Placement,
        words::TILE_BODY,
        ["forehead", "chest", "chin", "shoulder"],
    ),
    (
        Component::Movement,
        words::TILE_MOVEMENT,
        ["arc", "circle", "straight", "zigzag"],
    ),
];

/// The pickers of the tiles.
#[derive(Debug, Default)]
pub(super) struct Tiles {
    pickers: [Picker; 3],
}

impl Tiles {
    /// Shows the tiles; returns the query for the picked value.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
    ) -> Option<String> {
        let found: Vec<(usize, &Inventory)> = TILES
            .iter()
            .enumerate()
            .filter_map(|(at, (component, ..))| Some((at, inventory(seen, *component)?)))
            .collect();
        if found.is_empty() {
            return None;
        }
        let room = ui.available_width() - MARGIN;
        let width = (room + GAP) / found.len() as f32 - GAP;
        let mut query = None;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            for (at, inventory) in found {
                let (component, name, _) = &TILES[at];
                let name = seen.say(*name);
                let response = tile(ui, seen, (at, inventory), name, width);
                let picker = &mut self.pickers[at];
                let about = (inventory, None, name);
                if let Some(value) = pickers::below(ui, &response, picker, seen, about) {
                    query = Some(with_value("", component.name(), &value));
                }
                picker.inspect(seen, out);
            }
        });
        ui.add_space(4.0);
        query
    }
}

/// Returns the inventory of a component with the most values.
fn inventory<'a>(seen: &PaneInput<'a>, component: Component) -> Option<&'a Inventory> {
    let all = seen.snapshot.overview.inventories.iter();
    all.map(|it| &it.inventory)
        .filter(|it| it.component == component && it.feature.is_none())
        .max_by_key(|it| it.values.len())
}

fn tile(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (at, inventory): (usize, &Inventory),
    name: &str,
    width: f32,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, HIGH), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let colours = seen.colours();
    let lit = response.hovered() || response.has_focus();
    let (line, colour) = if lit {
        (2.0, colours.accent)
    } else {
        (1.0, colours.rule)
    };
    let fill = ui.visuals().extreme_bg_color;
    let stroke = Stroke::new(line, colour);
    let corner = CornerRadius::same(8);
    ui.painter()
        .rect(rect, corner, fill, stroke, StrokeKind::Inside);
    let turn = (miniatures::clock(ui) / TURN) as usize + at;
    let known = TILES[at].2.into_iter().cycle().skip(turn % 4).take(4);
    let side = HIGH - 34.0;
    let picture = Rect::from_center_size(
        pos2(rect.center().x, rect.top() + 5.0 + side / 2.0),
        vec2(side, side),
    );
    for value in known {
        if pickers::picture(ui, picture, seen, inventory, value) {
            break;
        }
    }
    ui.ctx().request_repaint_after_secs(TURN as f32 / 4.0);
    let below = pos2(rect.center().x, rect.bottom() - 14.0);
    let text = ui.visuals().text_color();
    let laid = |style: TextStyle| {
        let font = style.resolve(ui.style());
        ui.painter().layout_no_wrap(name.to_owned(), font, text)
    };
    let mut galley = laid(TextStyle::Body);
    if galley.size().x > width - 8.0 {
        galley = laid(TextStyle::Small);
    }
    let at = Align2::CENTER_CENTER.anchor_size(below, galley.size());
    ui.painter().galley(at.min, galley, text);
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_by_id;

    #[test]
    fn each_tile_has_built_in_values_to_show() {
        let ids = ["configurations", "placements", "movements"];
        for ((_, _, values), id) in TILES.iter().zip(ids) {
            let inventory = builtin_by_id(id).expect("of the house");
            let known = values.iter().filter(|it| inventory.find(it).is_some());
            assert!(known.count() >= 2, "{id}");
        }
    }
}
