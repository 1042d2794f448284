//! The positions of an inventory's places on the built-in body.
//!
//! Plain geometry: a [`Scene`] is the body at rest, a [`Panel`] is one view of it, and [`zones`] returns the position
//! of each place in that view.

use std::sync::OnceLock;

use chereme_corpus::value_pictures::{PanelView, RestingBodyScene};
use chereme_sign::ComponentInventory;
use chereme_sign::inventory::InventoryValue;
use eframe::egui::{Pos2, Rect, Vec2, vec2};

static BODY_SCENE: OnceLock<Option<RestingBodyScene>> = OnceLock::new();

/// Returns the body if it has been read already.
pub(crate) fn loaded_body_scene() -> Option<&'static RestingBodyScene> {
    BODY_SCENE.get()?.as_ref()
}

/// Returns the body, reading it if necessary; too slow for the window's thread.
pub(crate) fn load_body_scene() -> Option<&'static RestingBodyScene> {
    BODY_SCENE.get_or_init(|| RestingBodyScene::new().ok()).as_ref()
}

/// A place in a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PanelZone {
    /// Index of the value in the inventory.
    pub(crate) value: usize,
    /// The exact position of the place.
    pub(crate) at: Pos2,
    /// The centre of its circle, moved so that circles do not overlap.
    pub(crate) centre: Pos2,
}

/// A value that more than this many other values lie within is a part of the body rather than a place on it.
const MAX_VALUES_WITHIN_PLACE: usize = 5;

/// Returns whether a value is a whole part of the body, such as the head, by the number of values that lie within it.
pub(crate) fn is_part(inventory: &ComponentInventory, id: &str) -> bool {
    let within = |value: &&InventoryValue| value.id != id && inventory.is_within_value(&value.id, id);
    inventory.values.iter().filter(within).count() > MAX_VALUES_WITHIN_PLACE
}

/// Returns the positions of the places `values` in a picture of a panel that fills `rect`, with circles of `radius`.
pub(crate) fn place_panel_zones(
    scene: &RestingBodyScene,
    inventory: &ComponentInventory,
    values: &[usize],
    view: PanelView,
    rect: Rect,
    radius: f32,
) -> Vec<PanelZone> {
    let Some(camera) = scene.panel_camera(view.panel, view.turned) else {
        return Vec::new();
    };
    let size = [rect.width().max(1.0) as usize, rect.height().max(1.0) as usize];
    let projection = camera.camera_projection(size[0], size[1]);
    let mut found_zones: Vec<PanelZone> = values
        .iter()
        .filter_map(|value| {
            let landmark = inventory.values[*value].landmark.as_ref()?;
            let seen = projection.project_point(scene.landmark_position(landmark)?);
            let screen_place = rect.min + vec2(seen.x, seen.y);
            Some(PanelZone {
                value: *value,
                at: screen_place,
                centre: rect.shrink(radius).clamp(screen_place),
            })
        })
        .collect();
    separate_zone_circles(&mut found_zones, rect.shrink(radius), radius * 2.0 + 1.0);
    found_zones
}

/// Moves circles apart, as little as necessary, until they hardly overlap.
fn separate_zone_circles(zones: &mut [PanelZone], room: Rect, distance: f32) {
    for round in 0..80 {
        let mut moved = false;
        for a in 0..zones.len() {
            for b in a + 1..zones.len() {
                let between = zones[b].centre - zones[a].centre;
                let near = distance - between.length();
                if near <= 0.01 {
                    continue;
                }
                let direction = if between.length() < 0.01 {
                    // Both have the same position: each pair moves in another direction.
                    Vec2::angled((a * 7 + b * 3) as f32)
                } else {
                    between.normalized()
                };
                zones[a].centre = room.clamp(zones[a].centre - direction * (near / 2.0));
                zones[b].centre = room.clamp(zones[b].centre + direction * (near / 2.0));
                moved = true;
            }
        }
        if !moved {
            return;
        }
        if round < 40 {
            for zone in zones.iter_mut() {
                let home = zone.at - zone.centre;
                zone.centre = room.clamp(zone.centre + home * 0.04);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_corpus::value_pictures::PlacePanel;
    use chereme_sign::inventory::builtin_by_id;
    use eframe::egui::pos2;

    fn placements() -> &'static ComponentInventory {
        builtin_by_id("placements").expect("of the house")
    }

    fn all(panel: PlacePanel) -> Vec<usize> {
        let values = placements().values.iter().enumerate();
        values
            .filter(|(_, value)| value.landmark.as_ref().map(PlacePanel::panel_of_landmark) == Some(panel))
            .map(|(at, _)| at)
            .collect()
    }

    #[test]
    fn each_place_is_in_the_panel_that_shows_it_best() {
        let panel_of = |id: &str| {
            let value = placements().value_by_id(id).expect("a place");
            PlacePanel::panel_of_landmark(value.landmark.as_ref().expect("a landmark"))
        };
        assert_eq!(panel_of("chin"), PlacePanel::Head);
        assert_eq!(panel_of("above-head"), PlacePanel::Head);
        assert_eq!(panel_of("chest"), PlacePanel::Trunk);
        assert_eq!(panel_of("forearm"), PlacePanel::Trunk);
        assert_eq!(panel_of("palm"), PlacePanel::Hand);
        assert_eq!(panel_of("thumb"), PlacePanel::Hand);
        assert_eq!(panel_of("high-left"), PlacePanel::Space);
        assert!(is_part(placements(), "head") && !is_part(placements(), "chin"));
    }

    #[test]
    fn circles_stay_inside_near_their_place_and_apart() {
        let scene = load_body_scene().expect("the body of the program");
        for panel in [PlacePanel::Trunk, PlacePanel::Head, PlacePanel::Hand] {
            let height = 280.0;
            let rect = Rect::from_min_size(pos2(20.0, 10.0), vec2(height * panel.panel_aspect_ratio(), height));
            let values: Vec<usize> = all(panel)
                .into_iter()
                .filter(|at| !is_part(placements(), &placements().values[*at].id))
                .collect();
            for turned in [false, true] {
                let zones = place_panel_zones(scene, placements(), &values, PanelView { panel, turned }, rect, 8.0);
                assert_eq!(zones.len(), values.len());
                for (at, zone) in zones.iter().enumerate() {
                    let id = &placements().values[zone.value].id;
                    assert!(rect.expand(0.5).contains(zone.centre), "{id}");
                    let far = zone.at.distance(zone.centre);
                    assert!(far < 70.0, "{panel:?} {turned} {id}: {far}");
                    for other in &zones[at + 1..] {
                        let apart = zone.centre.distance(other.centre);
                        assert!(apart > 12.0, "{panel:?} {turned} {id}: {apart}");
                    }
                }
            }
        }
    }

    #[test]
    fn each_place_in_space_is_whole_in_its_picture() {
        let scene = load_body_scene().expect("the body of the program");
        let high = 300.0;
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(high * PlacePanel::Space.panel_aspect_ratio(), high));
        for turned in [false, true] {
            let panel = PlacePanel::Space;
            let view = PanelView { panel, turned };
            for zone in place_panel_zones(scene, placements(), &all(PlacePanel::Space), view, rect, 1.0) {
                let id = &placements().values[zone.value].id;
                let room = rect.shrink(0.06 * high);
                assert!(room.contains(zone.at), "{id} {turned}: {:?}", zone.at);
            }
        }
    }

    #[test]
    fn the_signers_left_is_on_the_right_of_the_picture() {
        let scene = load_body_scene().expect("the body of the program");
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 250.0));
        let find = |id: &str| placements().values.iter().position(|it| it.id == id);
        let values: Vec<usize> = ["high-left", "low-right"].iter().filter_map(|id| find(id)).collect();
        let panel = PlacePanel::Space;
        let view = PanelView { panel, turned: false };
        let zones = place_panel_zones(scene, placements(), &values, view, rect, 8.0);
        assert!(zones[0].centre.x > zones[1].centre.x + 20.0);
        assert!(zones[0].centre.y < zones[1].centre.y - 20.0);
    }
}
