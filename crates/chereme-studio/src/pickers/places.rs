//! The positions of an inventory's places on the built-in body.
//!
//! Plain geometry: a [`Scene`] is the body at rest, a [`Panel`] is one view of it, and [`zones`] returns the position
//! of each place in that view.

use std::sync::OnceLock;

use chereme_corpus::value_pictures::{Panel, Scene};
use chereme_sign::Inventory;
use chereme_sign::inventory::InventoryValue;
use eframe::egui::{Pos2, Rect, Vec2, vec2};

static SCENE: OnceLock<Option<Scene>> = OnceLock::new();

/// Returns the body if it has been read already.
pub(crate) fn ready() -> Option<&'static Scene> {
    SCENE.get()?.as_ref()
}

/// Returns the body, reading it if necessary; too slow for the window's thread.
pub(crate) fn scene() -> Option<&'static Scene> {
    SCENE.get_or_init(|| Scene::new().ok()).as_ref()
}

/// A place in a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Zone {
    /// Index of the value in the inventory.
    pub(crate) value: usize,
    /// The exact position of the place.
    pub(crate) at: Pos2,
    /// The centre of its circle, moved so that circles do not overlap.
    pub(crate) centre: Pos2,
}

/// A value that more than this many other values lie within is a part of the body rather than a place on it.
const PART: usize = 5;

/// Returns whether a value is a whole part of the body, such as the head, by the number of values that lie within it.
pub(crate) fn is_part(inventory: &Inventory, id: &str) -> bool {
    let within = |value: &&InventoryValue| value.id != id && inventory.is_within(&value.id, id);
    inventory.values.iter().filter(within).count() > PART
}

/// Returns the positions of the places `values` in a picture of a panel that fills `rect`, with circles of `radius`.
pub(crate) fn zones(
    scene: &Scene,
    inventory: &Inventory,
    values: &[usize],
    (panel, turned): (Panel, bool),
    rect: Rect,
    radius: f32,
) -> Vec<Zone> {
    let Some(camera) = scene.camera(panel, turned) else {
        return Vec::new();
    };
    let size = [
        rect.width().max(1.0) as usize,
        rect.height().max(1.0) as usize,
    ];
    let projection = camera.projection(size[0], size[1]);
    let mut found: Vec<Zone> = values
        .iter()
        .filter_map(|value| {
            let landmark = inventory.values[*value].landmark.as_ref()?;
            let seen = projection.project(scene.at(landmark)?);
            let at = rect.min + vec2(seen.x, seen.y);
            Some(Zone {
                value: *value,
                at,
                centre: rect.shrink(radius).clamp(at),
            })
        })
        .collect();
    part(&mut found, rect.shrink(radius), radius * 2.0 + 1.0);
    found
}

/// Moves circles apart, as little as necessary, until they hardly overlap.
fn part(zones: &mut [Zone], room: Rect, distance: f32) {
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
    use chereme_sign::inventory::builtin_by_id;
    use eframe::egui::pos2;

    fn placements() -> &'static Inventory {
        builtin_by_id("placements").expect("of the house")
    }

    fn all(panel: Panel) -> Vec<usize> {
        let values = placements().values.iter().enumerate();
        values
            .filter(|(_, value)| value.landmark.as_ref().map(Panel::of) == Some(panel))
            .map(|(at, _)| at)
            .collect()
    }

    #[test]
    fn each_place_is_in_the_panel_that_shows_it_best() {
        let panel_of = |id: &str| {
            let value = placements().get(id).expect("a place");
            Panel::of(value.landmark.as_ref().expect("a landmark"))
        };
        assert_eq!(panel_of("chin"), Panel::Head);
        assert_eq!(panel_of("above-head"), Panel::Head);
        assert_eq!(panel_of("chest"), Panel::Trunk);
        assert_eq!(panel_of("forearm"), Panel::Trunk);
        assert_eq!(panel_of("palm"), Panel::Hand);
        assert_eq!(panel_of("thumb"), Panel::Hand);
        assert_eq!(panel_of("high-left"), Panel::Space);
        assert!(is_part(placements(), "head") && !is_part(placements(), "chin"));
    }

    #[test]
    fn circles_stay_inside_near_their_place_and_apart() {
        let scene = scene().expect("the body of the program");
        for panel in [Panel::Trunk, Panel::Head, Panel::Hand] {
            let height = 280.0;
            let rect = Rect::from_min_size(pos2(20.0, 10.0), vec2(height * panel.aspect(), height));
            let values: Vec<usize> = all(panel)
                .into_iter()
                .filter(|at| !is_part(placements(), &placements().values[*at].id))
                .collect();
            for turned in [false, true] {
                let zones = zones(scene, placements(), &values, (panel, turned), rect, 8.0);
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
        let scene = scene().expect("the body of the program");
        let high = 300.0;
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(high * Panel::Space.aspect(), high));
        for turned in [false, true] {
            let view = (Panel::Space, turned);
            for zone in zones(scene, placements(), &all(Panel::Space), view, rect, 1.0) {
                let id = &placements().values[zone.value].id;
                let room = rect.shrink(0.06 * high);
                assert!(room.contains(zone.at), "{id} {turned}: {:?}", zone.at);
            }
        }
    }

    #[test]
    fn the_signers_left_is_on_the_right_of_the_picture() {
        let scene = scene().expect("the body of the program");
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 250.0));
        let find = |id: &str| placements().values.iter().position(|it| it.id == id);
        let values: Vec<usize> = ["high-left", "low-right"]
            .iter()
            .filter_map(|id| find(id))
            .collect();
        let zones = zones(
            scene,
            placements(),
            &values,
            (Panel::Space, false),
            rect,
            8.0,
        );
        assert!(zones[0].centre.x > zones[1].centre.x + 20.0);
        assert!(zones[0].centre.y < zones[1].centre.y - 20.0);
    }
}
