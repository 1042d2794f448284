//! Places picked on a body: areas that light up on large pictures of the head, the body, the weak hand, or the space
//! before the signer, next to a list of all places.

use std::hash::{DefaultHasher, Hash, Hasher};

use chereme_corpus::value_pictures::{PanelView, PlacePanel};
use chereme_sign::inventory::InventoryValue;
use eframe::egui::{Align2, Color32, Painter, Rect, ScrollArea, Sense, TextStyle, TextureId, Ui, Vec2, pos2, vec2};

use super::areas::{self, WantedAreas};
use super::pickers_cells::{CellState, PickerCell, PickerCells};
use super::pickers_places::{self, is_part};
use super::{ValuePicker, gallery, pickers_paint};
use crate::context::PaneInput;
use crate::words::{InterfaceText, pickers as words};

/// The side of the focusable point in the middle of an area, for keyboard and screen readers, in points.
const FOCUS_POINT_SIZE_POINTS: f32 = 8.0;
/// Height of a row of the list, in points.
const PLACE_ROW_HEIGHT_POINTS: f32 = 24.0;
/// Pictures are drawn larger than shown by this factor, for screens with small pixels.
const PICTURE_OVERSIZE_FACTOR: f32 = 1.5;
/// Height of the line with the name of the highlighted place, in points.
const PLACE_NAME_HEIGHT_POINTS: f32 = 26.0;
/// In less width than this, one picture is shown at a time, with the list below it from this height on, in points.
const NARROW_BODY_PICKER_POINTS: f32 = 540.0;
const LIST_BELOW_HEIGHT_POINTS: f32 = 420.0;
/// The least width of a single line of buttons above the pictures, in points.
const SINGLE_BUTTON_LINE_POINTS: f32 = 540.0;
/// The least height of the list below a picture, in points.
const LEAST_LIST: f32 = 76.0;

/// The groups of places to choose from side by side; the first panel stands for its group.
const BODY_PANEL_GROUPS: [(&[PlacePanel], InterfaceText); 3] = [
    (&[PlacePanel::Head, PlacePanel::Trunk], words::ON_BODY),
    (&[PlacePanel::Hand], words::WEAK_HAND),
    (&[PlacePanel::Space], words::IN_SPACE),
];
/// The same one by one.
const SINGLE_BODY_PANELS: [(&[PlacePanel], InterfaceText); 4] = [
    (&[PlacePanel::Head], words::HEAD),
    (&[PlacePanel::Trunk], words::TRUNK),
    (&[PlacePanel::Hand], words::WEAK_HAND),
    (&[PlacePanel::Space], words::IN_SPACE),
];

/// Draws the list and the pictures side by side: several pictures, or one of them without room for more. In a narrow and
/// high area the list is below the picture.
pub(super) fn show_body_picker(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
) -> Option<String> {
    follow_cursor_place(picker, cells);
    let height = (ui.available_height() - 34.0).max(220.0);
    let single = ui.available_width() < NARROW_BODY_PICKER_POINTS;
    if single && height >= LIST_BELOW_HEIGHT_POINTS {
        return show_upright_body_picker(ui, picker, cells, shown, height);
    }
    let listed = (ui.available_width() * 0.26).clamp(110.0, 180.0);
    let height = height.min(470.0);
    let mut picked = None;
    ui.horizontal_top(|ui| {
        let by_list = ui
            .allocate_ui(vec2(listed, height), |ui| {
                ui.set_width(listed);
                draw_place_list(ui, picker, cells, shown)
            })
            .inner;
        let by_picture = ui.vertical(|ui| {
            ui.set_height(height);
            let groups = if single {
                &SINGLE_BODY_PANELS[..]
            } else {
                &BODY_PANEL_GROUPS[..]
            };
            tabs(ui, picker, cells.seen, groups);
            lit(ui, picker, cells);
            let group = groups.iter().find(|(all, _)| all.contains(&picker.panel));
            let panels = match group {
                Some((all, _)) if !single => panel_pictures(all, picker.turned),
                _ => vec![(picker.panel, picker.turned, None)],
            };
            draw_place_pictures(ui, picker, cells, shown, &panels)
        });
        picked = by_list.or(by_picture.inner);
    });
    picked
}

/// Draws one picture, and the list below it.
fn show_upright_body_picker(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
    height: f32,
) -> Option<String> {
    let top = ui.cursor().top();
    tabs(ui, picker, cells.seen, &SINGLE_BODY_PANELS);
    lit(ui, picker, cells);
    let width = ui.available_width();
    let left = height - (ui.cursor().top() - top) - LEAST_LIST;
    let by_picture = ui
        .allocate_ui(vec2(width, left), |ui| {
            ui.set_max_height(left);
            // The name of a single picture is on its button already.
            let panels = [(picker.panel, picker.turned, None)];
            draw_place_pictures(ui, picker, cells, shown, &panels)
        })
        .inner;
    let left = (height - (ui.cursor().top() - top)).max(LEAST_LIST);
    let by_list = ui
        .allocate_ui(vec2(width, left), |ui| {
            ui.set_max_height(left);
            draw_place_list(ui, picker, cells, shown)
        })
        .inner;
    by_list.or(by_picture)
}

/// Returns the pictures of some panels, with the direction of view and the name of each.
fn panel_pictures(all: &[PlacePanel], turned: bool) -> Vec<(PlacePanel, bool, Option<InterfaceText>)> {
    let views = |panel: PlacePanel| match panel {
        PlacePanel::Space => vec![
            (panel, false, Some(words::SPACE_FRONT)),
            (panel, true, Some(words::SPACE_SIDE)),
        ],
        PlacePanel::Head => vec![(panel, turned, Some(words::HEAD))],
        PlacePanel::Trunk => vec![(panel, turned, Some(words::TRUNK))],
        PlacePanel::Hand => vec![(panel, turned, Some(words::WEAK_HAND))],
    };
    all.iter().copied().flat_map(views).collect()
}

/// Switches to the pictures that show the value at the keyboard cursor.
fn follow_cursor_place(picker: &mut ValuePicker, cells: &PickerCells<'_>) {
    let walked = cells.pressed.direction.is_some();
    if walked || !picker.filter.is_empty() || std::mem::take(&mut picker.turns) {
        let marked_value = picker.at.as_deref().and_then(|id| cells.inventory.value_by_id(id));
        let marked_place = marked_value.and_then(|value| Some((value, value.landmark.as_ref()?)));
        if let Some((value, landmark)) = marked_place {
            picker.panel = PlacePanel::panel_of_landmark(landmark);
            if picker.panel == PlacePanel::Space {
                picker.depth = depth_of(value);
            }
        }
    }
}

/// Shows the buttons of the groups of places, and those of the direction of view or, in space, of the distance.
fn tabs(ui: &mut Ui, picker: &mut ValuePicker, seen: &PaneInput<'_>, groups: &[(&[PlacePanel], InterfaceText)]) {
    let single = groups.len() == SINGLE_BODY_PANELS.len();
    let line = !single && ui.available_width() >= SINGLE_BUTTON_LINE_POINTS;
    ui.horizontal_wrapped(|ui| {
        for (group, name) in groups {
            let on = group.contains(&picker.panel);
            if ui.selectable_label(on, seen.say_text(*name)).clicked() && !on {
                picker.panel = group.first().copied().unwrap_or_default();
            }
        }
        // Without room for both groups of buttons in one line, they have one each.
        if line {
            ui.separator();
        } else {
            ui.end_row();
        }
        // Single pictures of the space are seen from the side, too.
        let space = picker.panel == PlacePanel::Space;
        if space && !(single && picker.turned) {
            let depths = [words::NEAR, words::REACH, words::FAR];
            for (depth, name) in depths.into_iter().enumerate() {
                let on = picker.depth == depth;
                if ui.selectable_label(on, seen.say_text(name)).clicked() {
                    picker.depth = depth;
                }
            }
        }
        if !space || single {
            for (turned, name) in [(false, words::FROM_FRONT), (true, words::FROM_SIDE)] {
                let on = picker.turned == turned;
                // In space, the view from the front is the one with the distances.
                let shown = !space || turned || picker.turned;
                if shown && ui.selectable_label(on, seen.say_text(name)).clicked() {
                    picker.turned = turned;
                }
            }
        }
    });
}

/// Writes the name of the highlighted place, always in the same line.
fn lit(ui: &mut Ui, picker: &ValuePicker, cells: &PickerCells<'_>) {
    let size = vec2(ui.available_width(), PLACE_NAME_HEIGHT_POINTS);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let value_id = picker.at.as_deref().or(cells.chosen);
    let value = value_id.and_then(|id| cells.inventory.value_by_id(id));
    let (text, colour) = match value {
        Some(value) => {
            let label = super::pickers_data::inventory_value_label(value, cells.seen.language);
            (label, ui.visuals().strong_text_color())
        }
        None => {
            let text = cells.seen.say_text(words::POINT_AT);
            (text.to_owned(), ui.visuals().weak_text_color())
        }
    };
    let font = TextStyle::Heading.resolve(ui.style());
    let text = pickers_paint::shorten_text_to_width(ui, text, &font, rect.width() - 4.0);
    let text_position = rect.left_center() + vec2(2.0, 0.0);
    ui.painter()
        .text(text_position, Align2::LEFT_CENTER, text, font, colour);
}

/// Draws the list of places; the arrow keys walk through it.
fn draw_place_list(ui: &mut Ui, picker: &mut ValuePicker, cells: &PickerCells<'_>, shown: &[usize]) -> Option<String> {
    ScrollArea::vertical()
        .id_salt("places")
        .auto_shrink(false)
        .show(ui, |ui| {
            let width = ui.available_width() - 10.0;
            let list_size = vec2(width, shown.len() as f32 * PLACE_ROW_HEIGHT_POINTS);
            let (area, _) = ui.allocate_exact_size(list_size, Sense::hover());
            let row = |(n, value): (usize, &usize)| PickerCell {
                value: *value,
                rect: Rect::from_min_size(
                    area.min + vec2(0.0, n as f32 * PLACE_ROW_HEIGHT_POINTS),
                    vec2(width, PLACE_ROW_HEIGHT_POINTS - 1.0),
                ),
            };
            let rows: Vec<PickerCell> = shown.iter().enumerate().map(row).collect();
            cells.show_picker_cells(ui, picker, &rows, |ui, cell, state| {
                let value = &cells.inventory.values[cell.value];
                list_row(ui, cell.rect, cells, value, &state);
            })
        })
        .inner
}

fn list_row(ui: &Ui, rect: Rect, cells: &PickerCells<'_>, value: &InventoryValue, state: &CellState) {
    let colours = cells.seen.pane_colours();
    let depth = cells.inventory.broader_value_chain(&value.id).count().clamp(1, 5) - 1;
    let font = TextStyle::Body.resolve(ui.style());
    let left = 6.0 + 8.0 * depth as f32;
    let full_name = value.value_name_in(cells.seen.language.language_code()).to_owned();
    let name = pickers_paint::shorten_text_to_width(ui, full_name, &font, rect.width() - left - 4.0);
    let text_position = pos2(rect.left() + left, rect.center().y);
    let colour = ui.visuals().text_color();
    ui.painter()
        .text(text_position, Align2::LEFT_CENTER, name, font, colour);
    if state.at || state.chosen || state.hovered {
        pickers_paint::paint_cell_frame(ui.painter(), rect, state, colours.accent, colours.rule);
    }
}

/// Draws the pictures side by side, with their places.
fn draw_place_pictures(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
    panels: &[(PlacePanel, bool, Option<InterfaceText>)],
) -> Option<String> {
    if pickers_places::loaded_body_scene().is_none() {
        gallery::find_gallery_picture(ui.ctx(), hash_picture_key(("scene", 0)), || {
            pickers_places::load_body_scene();
            None
        });
        ui.weak(cells.seen.say_text(words::DRAWING));
        return None;
    }
    let gap = 6.0;
    let aspects: f32 = panels.iter().map(|(panel, ..)| panel.panel_aspect_ratio()).sum();
    let gaps = gap * (panels.len() as f32 - 1.0);
    let room = ui.available_width() - gaps;
    let named = panels.iter().any(|(.., name)| name.is_some());
    let caption = if named { 20.0 } else { 0.0 };
    let most = ui.available_height() - caption - 2.0;
    let height = (room / aspects).min(most).max(80.0);
    let width = aspects * height + gaps;
    let (area, _) = ui.allocate_exact_size(vec2(room + gaps, height + caption), Sense::hover());
    // A single picture is in the middle.
    let spare = if named { 0.0 } else { (area.width() - width) / 2.0 };
    let mut left = area.left() + spare.max(0.0);
    let mut picked = None;
    for (panel, turned, name) in panels {
        let size = vec2(panel.panel_aspect_ratio() * height, height);
        let rect = Rect::from_min_size(pos2(left, area.top() + caption), size);
        left = rect.right() + gap;
        if let Some(name) = name {
            let font = TextStyle::Small.resolve(ui.style());
            let text_position = pos2(rect.left() + 2.0, rect.top() - 3.0);
            let weak = ui.visuals().weak_text_color();
            ui.painter().text(
                text_position,
                Align2::LEFT_BOTTOM,
                cells.seen.say_text(*name),
                font,
                weak,
            );
        }
        if let Some(texture) = find_panel_picture(ui, *panel, *turned, cells.seen.dark) {
            paint_panel_texture(ui.painter(), texture, rect);
        }
        let view = PanelView {
            panel: *panel,
            turned: *turned,
        };
        let by = panel_zones(ui, picker, cells, shown, view, rect);
        picked = picked.or(by);
    }
    picked
}

fn panel_zones(
    ui: &mut Ui,
    picker: &mut ValuePicker,
    cells: &PickerCells<'_>,
    shown: &[usize],
    view: PanelView,
    rect: Rect,
) -> Option<String> {
    let inventory = cells.inventory;
    let here: Vec<usize> = shown
        .iter()
        .copied()
        .filter(|at| is_place_in_panel(&inventory.values[*at], inventory, view, picker.depth))
        .collect();
    let wanted = WantedAreas {
        view,
        values: here,
        size: rect.size().round(),
    };
    let size = [wanted.size.x as u32, wanted.size.y as u32];
    let key = hash_picture_key((
        "areas",
        &inventory.id,
        inventory.values.len(),
        view,
        &wanted.values,
        size,
    ));
    let areas = areas::find_computed_areas(ui.ctx(), key, inventory, &wanted)?;
    let panel_response = ui.interact(rect, ui.scope_id().with(("panel", view)), Sense::click());
    let under = panel_response.hover_pos().and_then(|at| areas.zone_index_at(rect, at));
    let mut picked = None;
    // A pointer at rest must not take the choice away from the arrow keys.
    let moved = ui.input(|input| input.pointer.delta() != eframe::egui::Vec2::ZERO);
    if let Some(zone) = under {
        let id = &inventory.values[areas.zones[zone].value].id;
        if moved {
            picker.at = Some(id.clone());
        }
        if panel_response.clicked() {
            picked = Some(id.clone());
        }
    }
    let colours = cells.seen.pane_colours();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    areas::paint_picture_areas(&painter, key, &areas, None, colours.accent, rect);
    for (nth, zone) in areas.zones.iter().enumerate() {
        let value = &inventory.values[zone.value];
        let on = |id: &str| inventory.is_within_value(&value.id, id);
        let lit = picker.at.as_deref().is_some_and(on);
        let chosen = cells.chosen.is_some_and(on);
        let colour = match (lit, chosen) {
            (true, _) => colours.playhead.gamma_multiply(0.62),
            (false, true) => colours.accent.gamma_multiply(0.5),
            _ => Color32::TRANSPARENT,
        };
        if lit || chosen {
            areas::paint_picture_areas(&painter, key, &areas, Some(nth), colour, rect);
        }
        let spot = Rect::from_center_size(rect.min + zone.centre.to_vec2(), Vec2::splat(FOCUS_POINT_SIZE_POINTS));
        let name = ui.scope_id().with(("zone", &value.id, view.turned));
        let response = cells.make_zone_clickable(ui, spot, name, value);
        if response.hovered() && moved {
            picker.at = Some(value.id.clone());
        }
        if response.clicked() {
            picked = Some(value.id.clone());
        }
    }
    picked
}

/// Returns whether a panel shows a place.
fn is_place_in_panel(
    value: &InventoryValue,
    inventory: &chereme_sign::ComponentInventory,
    view: PanelView,
    depth: usize,
) -> bool {
    let Some(landmark) = &value.landmark else {
        return false;
    };
    if PlacePanel::panel_of_landmark(landmark) != view.panel || is_part(inventory, &value.id) {
        return false;
    }
    if view.panel != PlacePanel::Space {
        return true;
    }
    if view.turned {
        // From the side, the middle column represents all three.
        return landmark.offset[0].abs() < 0.05;
    }
    depth_of(value) == depth
}

/// Returns the depth of a place in space: 0 near, 1 at the usual distance, 2 far.
fn depth_of(value: &InventoryValue) -> usize {
    match value.landmark.as_ref().map_or(0.0, |landmark| landmark.offset[2]) {
        forward if forward < -0.05 => 0,
        forward if forward > 0.05 => 2,
        _ => 1,
    }
}

/// Returns the picture of a panel once it is drawn.
fn find_panel_picture(ui: &Ui, panel: PlacePanel, turned: bool, dark: bool) -> Option<TextureId> {
    gallery::find_gallery_picture(ui.ctx(), hash_picture_key((panel, turned, dark)), move || {
        let height = 300.0 * PICTURE_OVERSIZE_FACTOR;
        let size = [(height * panel.panel_aspect_ratio()) as usize, height as usize];
        let image = pickers_places::load_body_scene()?.draw_body_panel(
            panel,
            turned,
            size,
            pickers_paint::picture_theme(dark),
        )?;
        Some(pickers_paint::colour_image(&image))
    })
}

fn paint_panel_texture(painter: &Painter, texture: TextureId, rect: Rect) {
    let full_uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(texture, rect, full_uv, Color32::WHITE);
}

fn hash_picture_key(of: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    ("body", of).hash(&mut hasher);
    hasher.finish()
}
