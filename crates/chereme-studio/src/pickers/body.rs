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

/// The groups of places to choose from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Tab {
    /// Those on head and body.
    #[default]
    Body,
    /// Those on the weak hand.
    Hand,
    /// Those in space.
    Space,
}

impl Tab {
    const ALL: [(Self, Text); 3] = [
        (Self::Body, words::ON_BODY),
        (Self::Hand, words::WEAK_HAND),
        (Self::Space, words::IN_SPACE),
    ];

    fn of(panel: Panel) -> Self {
        match panel {
            Panel::Head | Panel::Trunk => Self::Body,
            Panel::Hand => Self::Hand,
            Panel::Space => Self::Space,
        }
    }
}

/// Draws the list and the pictures.
pub(super) fn show(
    ui: &mut Ui,
    picker: &mut Picker,
    cells: &Cells<'_>,
    shown: &[usize],
) -> Option<String> {
    let listed = (ui.available_width() * 0.26).clamp(110.0, 180.0);
    let height = (ui.available_height() - 34.0).clamp(220.0, 470.0);
    let mut picked = None;
    follow(picker, cells);
    ui.horizontal_top(|ui| {
        let by_list = ui
            .allocate_ui(vec2(listed, height), |ui| {
                ui.set_width(listed);
                list(ui, picker, cells, shown)
            })
            .inner;
        let by_picture = ui.vertical(|ui| {
            ui.set_height(height);
            tabs(ui, picker, cells.seen);
            lit(ui, picker, cells);
            pictures(ui, picker, cells, shown)
        });
        picked = by_list.or(by_picture.inner);
    });
    picked
}

/// Switches to the pictures that show the value at the keyboard cursor.
fn follow(picker: &mut Picker, cells: &Cells<'_>) {
    let walked = cells.pressed.direction.is_some();
    if walked || !picker.filter.is_empty() || std::mem::take(&mut picker.turns) {
        let at = picker.at.as_deref().and_then(|id| cells.inventory.get(id));
        if let Some(landmark) = at.and_then(|value| value.landmark.as_ref()) {
            picker.tab = Tab::of(Panel::of(landmark));
        }
    }
}

fn tabs(ui: &mut Ui, picker: &mut Picker, seen: &PaneInput<'_>) {
    ui.horizontal(|ui| {
        for (tab, name) in Tab::ALL {
            let on = picker.tab == tab;
            if ui.selectable_label(on, seen.say(name)).clicked() {
                picker.tab = tab;
            }
        }
        ui.separator();
        if picker.tab == Tab::Space {
            for (depth, name) in [words::NEAR, words::REACH, words::FAR]
                .into_iter()
                .enumerate()
            {
                if ui
                    .selectable_label(picker.depth == depth, seen.say(name))
                    .clicked()
                {
                    picker.depth = depth;
                }
            }
        } else {
            for (turned, name) in [(false, words::FROM_FRONT), (true, words::FROM_SIDE)] {
                if ui
                    .selectable_label(picker.turned == turned, seen.say(name))
                    .clicked()
                {
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
) -> Option<String> {
    if places::ready().is_none() {
        gallery::picture(ui.ctx(), key(("scene", 0)), || {
            places::scene();
            None
        });
        ui.weak(cells.seen.say(words::DRAWING));
        return None;
    }
    let panels: &[(Panel, bool, Text)] = &match picker.tab {
        Tab::Space => vec![
            (Panel::Space, false, words::SPACE_FRONT),
            (Panel::Space, true, words::SPACE_SIDE),
        ],
        Tab::Body => vec![
            (Panel::Head, picker.turned, words::HEAD),
            (Panel::Trunk, picker.turned, words::TRUNK),
        ],
        Tab::Hand => vec![(Panel::Hand, picker.turned, words::WEAK_HAND)],
    };
    let gap = 6.0;
    let aspects: f32 = panels.iter().map(|(panel, ..)| panel.aspect()).sum();
    let room = ui.available_width() - gap * (panels.len() as f32 - 1.0);
    let height = (room / aspects).min(ui.available_height() - 22.0).max(80.0);
    let width = aspects * height + gap * (panels.len() as f32 - 1.0);
    let (area, _) = ui.allocate_exact_size(vec2(width, height + 20.0), Sense::hover());
    let mut left = area.left();
    let mut picked = None;
    for (panel, turned, name) in panels {
        let size = vec2(panel.aspect() * height, height);
        let rect = Rect::from_min_size(pos2(left, area.top() + 20.0), size);
        left = rect.right() + gap;
        let font = TextStyle::Small.resolve(ui.style());
        let at = pos2(rect.left() + 2.0, rect.top() - 3.0);
        let weak = ui.visuals().weak_text_color();
        ui.painter()
            .text(at, Align2::LEFT_BOTTOM, cells.seen.say(*name), font, weak);
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
