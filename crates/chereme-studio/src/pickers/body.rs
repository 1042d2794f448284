//! Places picked on a body: areas that light up on large pictures of the head, the body, the weak hand, or the space
//! before the signer, next to a list of all places.

use std::hash::{DefaultHasher, Hash, Hasher};

use chereme_corpus::value_pictures::Panel;
use chereme_sign::inventory::InventoryValue;
use eframe::egui::{
    Align2, Color32, Painter, Rect, ScrollArea, Sense, TextStyle, TextureId, Ui, Vec2, pos2, vec2,
};

use super::areas::{self, Wanted};
use super::cells::{Cell, Cells, State};
use super::places::{self, is_part};
use super::{Picker, gallery, paint};
use crate::context::PaneInput;
use crate::words::{Text, pickers as words};

/// The side of the focusable point in the middle of an area, for keyboard and screen readers, in points.
const POINT: f32 = 8.0;
/// Height of a row of the list, in points.
const ROW: f32 = 24.0;
/// Pictures are drawn larger than shown by this factor, for screens with small pixels.
const FINER: f32 = 1.5;
/// Height of the line with the name of the highlighted place, in points.
const NAME: f32 = 26.0;
/// In less width than this, one picture is shown at a time, with the list below it from this height on, in points.
const NARROW: f32 = 540.0;
const HIGH: f32 = 420.0;
/// The least width of a single line of buttons above the pictures, in points.
const LINE: f32 = 540.0;
/// The least height of the list below a picture, in points.
const LEAST_LIST: f32 = 76.0;

/// The groups of places to choose from side by side; the first panel stands for its group.
const GROUPS: [(&[Panel], Text); 3] = [
    (&[Panel::Head, Panel::Trunk], words::ON_BODY),
    (&[Panel::Hand], words::WEAK_HAND),
    (&[Panel::Space], words::IN_SPACE),
];
/// The same one by one.
const SINGLE: [(&[Panel], Text); 4] = [
    (&[Panel::Head], words::HEAD),
    (&[Panel::Trunk], words::TRUNK),
    (&[Panel::Hand], words::WEAK_HAND),
    (&[Panel::Space], words::IN_SPACE),
];

/// Draws the list and the pictures side by side: several pictures, or one of them without room for more. In a narrow and
/// high area the list is below the picture.
pub(super) fn show(
    ui: &mut Ui,
    picker: &mut Picker,
    cells: &Cells<'_>,
    shown: &[usize],
) -> Option<String> {
    follow(picker, cells);
    let height = (ui.available_height() - 34.0).max(220.0);
    let single = ui.available_width() < NARROW;
    if single && height >= HIGH {
        return upright(ui, picker, cells, shown, height);
    }
    let listed = (ui.available_width() * 0.26).clamp(110.0, 180.0);
    let height = height.min(470.0);
    let mut picked = None;
    ui.horizontal_top(|ui| {
        let by_list = ui
            .allocate_ui(vec2(listed, height), |ui| {
                ui.set_width(listed);
                list(ui, picker, cells, shown)
            })
            .inner;
        let by_picture = ui.vertical(|ui| {
            ui.set_height(height);
            let groups = if single { &SINGLE[..] } else { &GROUPS[..] };
            tabs(ui, picker, cells.seen, groups);
            lit(ui, picker, cells);
            let group = groups.iter().find(|(all, _)| all.contains(&picker.panel));
            let panels = match group {
                Some((all, _)) if !single => panels(all, picker.turned),
                _ => vec![(picker.panel, picker.turned, None)],
            };
            pictures(ui, picker, cells, shown, &panels)
        });
        picked = by_list.or(by_picture.inner);
    });
    picked
}

/// Draws one picture, and the list below it.
fn upright(
    ui: &mut Ui,
    picker: &mut Picker,
    cells: &Cells<'_>,
    shown: &[usize],
    height: f32,
) -> Option<String> {
    let top = ui.cursor().top();
    tabs(ui, picker, cells.seen, &SINGLE);
    lit(ui, picker, cells);
    let width = ui.available_width();
    let left = height - (ui.cursor().top() - top) - LEAST_LIST;
    let by_picture = ui
        .allocate_ui(vec2(width, left), |ui| {
            ui.set_max_height(left);
            // The name of a single picture is on its button already.
            let panels = [(picker.panel, picker.turned, None)];
            pictures(ui, picker, cells, shown, &panels)
        })
        .inner;
    let left = (height - (ui.cursor().top() - top)).max(LEAST_LIST);
    let by_list = ui
        .allocate_ui(vec2(width, left), |ui| {
            ui.set_max_height(left);
            list(ui, picker, cells, shown)
        })
        .inner;
    by_list.or(by_picture)
}

/// Returns the pictures of some panels, with the direction of view and the name of each.
fn panels(all: &[Panel], turned: bool) -> Vec<(Panel, bool, Option<Text>)> {
    let views = |panel: Panel| match panel {
        Panel::Space => vec![
            (panel, false, Some(words::SPACE_FRONT)),
            (panel, true, Some(words::SPACE_SIDE)),
        ],
        Panel::Head => vec![(panel, turned, Some(words::HEAD))],
        Panel::Trunk => vec![(panel, turned, Some(words::TRUNK))],
        Panel::Hand => vec![(panel, turned, Some(words::WEAK_HAND))],
    };
    all.iter().copied().flat_map(views).collect()
}

/// Switches to the pictures that show the value at the keyboard cursor.
fn follow(picker: &mut Picker, cells: &Cells<'_>) {
    let walked = cells.pressed.direction.is_some();
    if walked || !picker.filter.is_empty() || std::mem::take(&mut picker.turns) {
        let at = picker.at.as_deref().and_then(|id| cells.inventory.get(id));
        let found = at.and_then(|value| Some((value, value.landmark.as_ref()?)));
        if let Some((value, landmark)) = found {
            picker.panel = Panel::of(landmark);
            if picker.panel == Panel::Space {
                picker.depth = depth_of(value);
            }
        }
    }
}

/// Shows the buttons of the groups of places, and those of the direction of view or, in space, of the distance.
fn tabs(ui: &mut Ui, picker: &mut Picker, seen: &PaneInput<'_>, groups: &[(&[Panel], Text)]) {
    let single = groups.len() == SINGLE.len();
    let line = !single && ui.available_width() >= LINE;
    ui.horizontal_wrapped(|ui| {
        for (group, name) in groups {
            let on = group.contains(&picker.panel);
            if ui.selectable_label(on, seen.say(*name)).clicked() && !on {
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
        let space = picker.panel == Panel::Space;
        if space && !(single && picker.turned) {
            let depths = [words::NEAR, words::REACH, words::FAR];
            for (depth, name) in depths.into_iter().enumerate() {
                let on = picker.depth == depth;
                if ui.selectable_label(on, seen.say(name)).clicked() {
                    picker.depth = depth;
                }
            }
        }
        if !space || single {
            for (turned, name) in [(false, words::FROM_FRONT), (true, words::FROM_SIDE)] {
                let on = picker.turned == turned;
                // In space, the view from the front is the one with the distances.
                let shown = !space || turned || picker.turned;
                if shown && ui.selectable_label(on, seen.say(name)).clicked() {
                    picker.turned = turned;
                }
            }
        }
    });
}

/// Writes the name of the highlighted place, always in the same line.
fn lit(ui: &mut Ui, picker: &Picker, cells: &Cells<'_>) {
    let size = vec2(ui.available_width(), NAME);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let at = picker.at.as_deref().or(cells.chosen);
    let value = at.and_then(|id| cells.inventory.get(id));
    let (text, colour) = match value {
        Some(value) => {
            let label = super::data::label(value, cells.seen.language);
            (label, ui.visuals().strong_text_color())
        }
        None => {
            let text = cells.seen.say(words::POINT_AT);
            (text.to_owned(), ui.visuals().weak_text_color())
        }
    };
    let font = TextStyle::Heading.resolve(ui.style());
    let text = paint::fitted(ui, text, &font, rect.width() - 4.0);
    let at = rect.left_center() + vec2(2.0, 0.0);
    ui.painter()
        .text(at, Align2::LEFT_CENTER, text, font, colour);
}

/// Draws the list of places; the arrow keys walk through it.
fn list(ui: &mut Ui, picker: &mut Picker, cells: &Cells<'_>, shown: &[usize]) -> Option<String> {
    ScrollArea::vertical()
        .id_salt("places")
        .auto_shrink(false)
        .show(ui, |ui| {
            let width = ui.available_width() - 10.0;
            let whole = vec2(width, shown.len() as f32 * ROW);
            let (area, _) = ui.allocate_exact_size(whole, Sense::hover());
            let row = |(n, value): (usize, &usize)| Cell {
                value: *value,
                rect: Rect::from_min_size(
                    area.min + vec2(0.0, n as f32 * ROW),
                    vec2(width, ROW - 1.0),
                ),
            };
            let rows: Vec<Cell> = shown.iter().enumerate().map(row).collect();
            cells.show(ui, picker, &rows, |ui, cell, state| {
                let value = &cells.inventory.values[cell.value];
                list_row(ui, cell.rect, cells, value, &state);
            })
        })
        .inner
}

fn list_row(ui: &Ui, rect: Rect, cells: &Cells<'_>, value: &InventoryValue, state: &State) {
    let colours = cells.seen.colours();
    let depth = cells.inventory.chain(&value.id).count().clamp(1, 5) - 1;
    let font = TextStyle::Body.resolve(ui.style());
    let left = 6.0 + 8.0 * depth as f32;
    let name = value.name(cells.seen.language.code()).to_owned();
    let name = paint::fitted(ui, name, &font, rect.width() - left - 4.0);
    let at = pos2(rect.left() + left, rect.center().y);
    let colour = ui.visuals().text_color();
    ui.painter()
        .text(at, Align2::LEFT_CENTER, name, font, colour);
    if state.at || state.chosen || state.hovered {
        paint::frame(ui.painter(), rect, state, colours.accent, colours.rule);
    }
}

/// Draws the pictures side by side, with their places.
fn pictures(
    ui: &mut Ui,
    picker: &mut Picker,
    cells: &Cells<'_>,
    shown: &[usize],
    panels: &[(Panel, bool, Option<Text>)],
) -> Option<String> {
    if places::ready().is_none() {
        gallery::picture(ui.ctx(), key(("scene", 0)), || {
            places::scene();
            None
        });
        ui.weak(cells.seen.say(words::DRAWING));
        return None;
    }
    let gap = 6.0;
    let aspects: f32 = panels.iter().map(|(panel, ..)| panel.aspect()).sum();
    let gaps = gap * (panels.len() as f32 - 1.0);
    let room = ui.available_width() - gaps;
    let named = panels.iter().any(|(.., name)| name.is_some());
    let caption = if named { 20.0 } else { 0.0 };
    let most = ui.available_height() - caption - 2.0;
    let height = (room / aspects).min(most).max(80.0);
    let width = aspects * height + gaps;
    let (area, _) = ui.allocate_exact_size(vec2(room + gaps, height + caption), Sense::hover());
    // A single picture is in the middle.
    let spare = if named {
        0.0
    } else {
        (area.width() - width) / 2.0
    };
    let mut left = area.left() + spare.max(0.0);
    let mut picked = None;
    for (panel, turned, name) in panels {
        let size = vec2(panel.aspect() * height, height);
        let rect = Rect::from_min_size(pos2(left, area.top() + caption), size);
        left = rect.right() + gap;
        if let Some(name) = name {
            let font = TextStyle::Small.resolve(ui.style());
            let at = pos2(rect.left() + 2.0, rect.top() - 3.0);
            let weak = ui.visuals().weak_text_color();
            ui.painter()
                .text(at, Align2::LEFT_BOTTOM, cells.seen.say(*name), font, weak);
        }
        if let Some(texture) = picture(ui, *panel, *turned, cells.seen.dark) {
            image(ui.painter(), texture, rect);
        }
        let by = panel_zones(ui, picker, cells, shown, (*panel, *turned), rect);
        picked = picked.or(by);
    }
    picked
}

fn panel_zones(
    ui: &mut Ui,
    picker: &mut Picker,
    cells: &Cells<'_>,
    shown: &[usize],
    view: (Panel, bool),
    rect: Rect,
) -> Option<String> {
    let inventory = cells.inventory;
    let here: Vec<usize> = shown
        .iter()
        .copied()
        .filter(|at| belongs(&inventory.values[*at], inventory, view, picker.depth))
        .collect();
    let wanted = Wanted {
        view,
        values: here,
        size: rect.size().round(),
    };
    let size = [wanted.size.x as u32, wanted.size.y as u32];
    let key = key((
        "areas",
        &inventory.id,
        inventory.values.len(),
        view,
        &wanted.values,
        size,
    ));
    let areas = areas::find(ui.ctx(), key, inventory, &wanted)?;
    let whole = ui.interact(rect, ui.scope_id().with(("panel", view)), Sense::click());
    let under = whole.hover_pos().and_then(|at| areas.at(rect, at));
    let mut picked = None;
    let moved = ui.input(|input| input.pointer.delta() != eframe::egui::Vec2::ZERO);
    if let Some(zone) = under {
        let id = &inventory.values[areas.zones[zone].value].id;
        if moved {
            picker.at = Some(id.clone());
        }
        if whole.clicked() {
            picked = Some(id.clone());
        }
    }
    let colours = cells.seen.colours();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    areas::paint(&painter, (key, &areas), None, colours.accent, rect);
    for (nth, zone) in areas.zones.iter().enumerate() {
        let value = &inventory.values[zone.value];
        let on = |id: &str| inventory.is_within(&value.id, id);
        let lit = picker.at.as_deref().is_some_and(on);
        let chosen = cells.chosen.is_some_and(on);
        let colour = match (lit, chosen) {
            (true, _) => colours.playhead.gamma_multiply(0.62),
            (false, true) => colours.accent.gamma_multiply(0.5),
            _ => Color32::TRANSPARENT,
        };
        if lit || chosen {
            areas::paint(&painter, (key, &areas), Some(nth), colour, rect);
        }
        let spot = Rect::from_center_size(rect.min + zone.centre.to_vec2(), Vec2::splat(POINT));
        let name = ui.scope_id().with(("zone", &value.id, view.1));
        let response = cells.zone(ui, spot, name, value);
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
fn belongs(
    value: &InventoryValue,
    inventory: &chereme_sign::Inventory,
    (panel, turned): (Panel, bool),
    depth: usize,
) -> bool {
    let Some(landmark) = &value.landmark else {
        return false;
    };
    if Panel::of(landmark) != panel || is_part(inventory, &value.id) {
        return false;
    }
    if panel != Panel::Space {
        return true;
    }
    if turned {
        // From the side, the middle column represents all three.
        return landmark.offset[0].abs() < 0.05;
    }
    depth_of(value) == depth
}

/// Returns the depth of a place in space: 0 near, 1 at the usual distance, 2 far.
fn depth_of(value: &InventoryValue) -> usize {
    match value.landmark.as_ref().map_or(0.0, |it| it.offset[2]) {
        forward if forward < -0.05 => 0,
        forward if forward > 0.05 => 2,
        _ => 1,
    }
}

/// Returns the picture of a panel once it is drawn.
fn picture(ui: &Ui, panel: Panel, turned: bool, dark: bool) -> Option<TextureId> {
    gallery::picture(ui.ctx(), key((panel, turned, dark)), move || {
        let height = 300.0 * FINER;
        let size = [(height * panel.aspect()) as usize, height as usize];
        let image = places::scene()?.draw(panel, turned, size, paint::theme(dark))?;
        Some(paint::colour_image(&image))
    })
}

fn image(painter: &Painter, texture: TextureId, rect: Rect) {
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(texture, rect, whole, Color32::WHITE);
}

fn key(of: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    ("body", of).hash(&mut hasher);
    hasher.finish()
}
