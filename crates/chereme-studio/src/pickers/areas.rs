//! Areas on a picture of the body: each consists of the points that are nearest to one place, and lights up as a whole.
//!
//! They are computed on a separate thread, once per picture and set of places.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::{Arc, Mutex, PoisonError};

use chereme_corpus::value_pictures::{PanelView, PlacePanel};
use chereme_figure::PaperTheme;
use chereme_sign::ComponentInventory;
use eframe::egui::{
    Color32, ColorImage, Context, Id, Painter, Pos2, Rect, TextureHandle, TextureOptions, Vec2, pos2, vec2,
};

use super::pickers_places::{self, PanelZone};

/// Half of the least distance between the middles of two areas, in points.
const MIN_AREA_RADIUS_POINTS: f32 = 9.0;
/// How far an area extends on the body, on the head and its surroundings, and off the body, as a share of the picture's height.
const BODY_AREA_REACH_SHARE: f32 = 0.2;
const ON_HEAD: f32 = 0.11;
const OFF_BODY_REACH_SHARE: f32 = 0.05;
/// The same in the picture of the space, which has no body to fill.
const IN_SPACE: f32 = 0.1;
/// Width of a pixel of the area grid, in points.
const AREA_GRAIN_POINTS: f32 = 1.5;

/// The areas of a picture.
#[derive(Debug)]
pub(super) struct PictureAreas {
    /// The places; number `n` in `ids` is the place at index `n - 1`.
    pub(super) zones: Vec<PanelZone>,
    size: [usize; 2],
    /// For each pixel, the number of its area; 0 for none.
    ids: Vec<u8>,
    /// For each area, the bounds of its pixels: first column, first row, last column, last row.
    bounds: Vec<[usize; 4]>,
}

/// The request for areas: the panel and its direction of view, the places, and the size in points.
#[derive(Debug, Clone)]
pub(super) struct WantedAreas {
    pub(super) view: PanelView,
    pub(super) values: Vec<usize>,
    pub(super) size: Vec2,
}

impl PictureAreas {
    /// Computes the areas; too slow for the window's thread. `None` if there is no picture.
    fn compute_picture_areas(inventory: &ComponentInventory, wanted: &WantedAreas) -> Option<Self> {
        let scene = pickers_places::load_body_scene()?;
        let rect = Rect::from_min_size(Pos2::ZERO, wanted.size);
        let values = scene.in_sight(inventory, &wanted.values, wanted.view);
        let zones =
            pickers_places::place_panel_zones(scene, inventory, &values, wanted.view, rect, MIN_AREA_RADIUS_POINTS);
        let size = [wanted.size.x, wanted.size.y].map(|side| ((side / AREA_GRAIN_POINTS) as usize).max(1));
        let picture = scene.draw_body_panel(wanted.view.panel, wanted.view.turned, size, PaperTheme::Light)?;
        let paper = PaperTheme::Light.theme_paper_colour();
        let body: Vec<bool> = picture.image_pixels().iter().map(|pixel| *pixel != paper).collect();
        Some(Self::areas_from_zones(zones, &body, size, wanted))
    }

    /// Returns the areas around the middles of `zones`; `body` marks the pixels that show the body.
    fn areas_from_zones(mut zones: Vec<PanelZone>, body: &[bool], size: [usize; 2], wanted: &WantedAreas) -> Self {
        zones.truncate(usize::from(u8::MAX));
        let high = wanted.size.y;
        let off = (OFF_BODY_REACH_SHARE * high).max(MIN_AREA_RADIUS_POINTS);
        let (on, off) = match wanted.view.panel {
            PlacePanel::Space => (IN_SPACE * high, IN_SPACE * high),
            // Below the chin the body goes on, which the picture of the trunk shows.
            PlacePanel::Head => (ON_HEAD * high, off),
            PlacePanel::Trunk | PlacePanel::Hand => (BODY_AREA_REACH_SHARE * high, off),
        };
        let mut ids = vec![0; body.len()];
        let mut bounds = vec![[usize::MAX, usize::MAX, 0, 0]; zones.len()];
        for (at, (id, shown)) in ids.iter_mut().zip(body).enumerate() {
            let (column, row) = (at % size[0], at / size[0]);
            let point = pos2(column as f32 + 0.5, row as f32 + 0.5) * AREA_GRAIN_POINTS;
            let nearest = zones
                .iter()
                .enumerate()
                .map(|(nth, zone)| (zone.centre.distance_sq(point), nth))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let reach = if *shown { on } else { off };
            let Some((_, nth)) = nearest.filter(|candidate| candidate.0 <= reach * reach) else {
                continue;
            };
            *id = nth as u8 + 1;
            let room = &mut bounds[nth];
            *room = [
                room[0].min(column),
                room[1].min(row),
                room[2].max(column),
                room[3].max(row),
            ];
        }
        Self {
            zones,
            size,
            ids,
            bounds,
        }
    }

    /// Returns the index of the zone at a point of the picture, which fills `rect`.
    pub(super) fn zone_index_at(&self, rect: Rect, point: Pos2) -> Option<usize> {
        let share = (point - rect.min) / rect.size();
        let column = (share.x * self.size[0] as f32).floor();
        let row = (share.y * self.size[1] as f32).floor();
        let inside = column >= 0.0 && row >= 0.0;
        let (column, row) = (column as usize, row as usize);
        if !inside || column >= self.size[0] || row >= self.size[1] {
            return None;
        }
        usize::from(self.ids[row * self.size[0] + column]).checked_sub(1)
    }

    /// Returns a picture of all areas: faint fillings, and lines between them.
    fn draw_all_areas(&self, colour: Color32) -> ColorImage {
        let [wide, high] = self.size;
        let id = |column: usize, row: usize| self.ids[row * wide + column];
        let pixel = |at: usize| {
            let (column, row) = (at % wide, at / wide);
            let own_id = id(column, row);
            let right = id((column + 1).min(wide - 1), row);
            let below = id(column, (row + 1).min(high - 1));
            let line = own_id != right || own_id != below;
            match (line, own_id) {
                (true, _) => colour.gamma_multiply(0.55),
                (false, 0) => Color32::TRANSPARENT,
                (false, _) => colour.gamma_multiply(0.1),
            }
        };
        ColorImage::new(self.size, (0..wide * high).map(pixel).collect())
    }

    /// Returns a picture of one area, and its rectangle as shares of the whole picture.
    fn draw_one_area(&self, zone: usize, colour: Color32) -> Option<(ColorImage, Rect)> {
        let [left, top, right, bottom] = *self.bounds.get(zone)?;
        if left > right || top > bottom {
            return None;
        }
        let size = [right - left + 1, bottom - top + 1];
        let zone_id = zone as u8 + 1;
        let pixel = |at: usize| {
            let place = (top + at / size[0]) * self.size[0] + left + at % size[0];
            if self.ids[place] == zone_id {
                colour
            } else {
                Color32::TRANSPARENT
            }
        };
        let image = ColorImage::new(size, (0..size[0] * size[1]).map(pixel).collect());
        let full_size = vec2(self.size[0] as f32, self.size[1] as f32);
        let part = Rect::from_min_size(
            (vec2(left as f32, top as f32) / full_size).to_pos2(),
            vec2(size[0] as f32, size[1] as f32) / full_size,
        );
        Some((image, part))
    }
}

/// The computed areas, and their pictures.
#[derive(Default)]
struct AreaAtlas {
    /// `None` while the areas are being computed.
    areas: BTreeMap<u64, Option<Arc<PictureAreas>>>,
    textures: BTreeMap<(u64, usize, RgbaKey), (TextureHandle, Rect)>,
}

/// A colour as a map key: red, green, blue and opacity.
type RgbaKey = [u8; 4];

fn atlas(ctx: &Context) -> Arc<Mutex<AreaAtlas>> {
    ctx.data_mut(|data| {
        data.get_temp_mut_or_insert_with(Id::unique("atlas of places"), Arc::<Mutex<AreaAtlas>>::default)
            .clone()
    })
}

/// Returns the areas of that key once they are computed; the first call starts the computation.
pub(super) fn find_computed_areas(
    ctx: &Context,
    key: u64,
    inventory: &ComponentInventory,
    wanted: &WantedAreas,
) -> Option<Arc<PictureAreas>> {
    let shared = atlas(ctx);
    let mut atlas = shared.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = atlas.areas.get(&key) {
        return known.clone();
    }
    atlas.areas.insert(key, None);
    drop(atlas);
    let (ctx, inventory, wanted) = (ctx.clone(), inventory.clone(), wanted.clone());
    std::thread::spawn(move || {
        if let Some(areas) = PictureAreas::compute_picture_areas(&inventory, &wanted) {
            let mut atlas = shared.lock().unwrap_or_else(PoisonError::into_inner);
            atlas.areas.insert(key, Some(Arc::new(areas)));
            drop(atlas);
            ctx.request_repaint();
        }
    });
    None
}

/// Paints all areas, or one of them, over the picture in `rect`.
pub(super) fn paint_picture_areas(
    painter: &Painter,
    key: u64,
    areas: &PictureAreas,
    zone: Option<usize>,
    colour: Color32,
    rect: Rect,
) {
    let shared = atlas(painter.ctx());
    let mut atlas = shared.lock().unwrap_or_else(PoisonError::into_inner);
    let name = (key, zone.map_or(0, |zone| zone + 1), colour.to_array());
    let (texture, part) = match atlas.textures.entry(name) {
        Entry::Occupied(known) => known.into_mut(),
        Entry::Vacant(free) => {
            let full_uv = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
            let drawn = match zone {
                None => Some((areas.draw_all_areas(colour), full_uv)),
                Some(zone) => areas.draw_one_area(zone, colour),
            };
            let Some((image, part)) = drawn else { return };
            let ctx = painter.ctx();
            let texture = ctx.load_texture("area", image, TextureOptions::LINEAR);
            free.insert((texture, part))
        }
    };
    let place = Rect::from_min_max(
        rect.min + part.min.to_vec2() * rect.size(),
        rect.min + part.max.to_vec2() * rect.size(),
    );
    let full_uv = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    painter.image(texture.id(), place, full_uv, Color32::WHITE);
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_by_id;

    #[test]
    fn every_visible_place_has_its_own_area_under_the_pointer() {
        let inventory = builtin_by_id("placements").expect("of the house");
        for (panel, turned) in [
            (PlacePanel::Head, false),
            (PlacePanel::Head, true),
            (PlacePanel::Trunk, false),
            (PlacePanel::Hand, false),
        ] {
            let values: Vec<usize> = (0..inventory.values.len())
                .filter(|at| {
                    let value = &inventory.values[*at];
                    let landmark = value.landmark.as_ref();
                    landmark.map(PlacePanel::panel_of_landmark) == Some(panel)
                        && !pickers_places::is_part(inventory, &value.id)
                })
                .collect();
            let high = 330.0;
            let size = vec2(high * panel.panel_aspect_ratio(), high);
            let wanted = WantedAreas {
                view: PanelView { panel, turned },
                values,
                size,
            };
            let areas = PictureAreas::compute_picture_areas(inventory, &wanted).expect("areas");
            assert!(areas.zones.len() > 3, "{panel:?} {turned}");
            let rect = Rect::from_min_size(pos2(30.0, 20.0), size);
            for (nth, zone) in areas.zones.iter().enumerate() {
                let id = &inventory.values[zone.value].id;
                let at = rect.min + zone.centre.to_vec2();
                assert_eq!(areas.zone_index_at(rect, at), Some(nth), "{panel:?} {turned} {id}");
                let own = nth as u8 + 1;
                let pixels = areas.ids.iter().filter(|it| **it == own).count();
                assert!(pixels > 80, "{panel:?} {turned} {id}: {pixels} pixels");
            }
            assert_eq!(areas.zone_index_at(rect, pos2(0.0, 0.0)), None);
        }
    }
}
