//! The positions of an inventory's places on the built-in body.
//!
//! Plain geometry: a [`Scene`] is the body at rest, a [`Panel`] is one view of it, and [`zones`] returns the position
//! of each place in that view.

use std::sync::OnceLock;

use chereme_corpus::built_in_body;
use chereme_figure::camera::Camera;
use chereme_figure::raster::{Raster, Style};
use chereme_figure::{Body, Palette};
use chereme_motion::glam::{DVec3, Vec3};
use chereme_motion::{Anatomy, Clip, ModelPose, Part, Side};
use chereme_sign::Inventory;
use chereme_sign::inventory::{InventoryValue, Landmark};
use eframe::egui::{Pos2, Rect, Vec2, vec2};

use super::paint;

/// A view of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Panel {
    /// Shoulders to hips, with both arms.
    Trunk,
    /// A close view of the head.
    Head,
    /// The weak hand alone.
    Hand,
    /// The space before the signer.
    Space,
}

impl Panel {
    /// Returns the ratio of width to height.
    pub(crate) fn aspect(self) -> f32 {
        match self {
            Self::Trunk => 0.74,
            Self::Head => 0.94,
            Self::Hand => 0.62,
            Self::Space => 0.86,
        }
    }
}

/// The body at rest.
pub(crate) struct Scene {
    clip: Clip,
    anatomy: std::sync::Arc<Anatomy>,
    model: ModelPose,
}

/// The dominant hand, which decides the own and the other side in places.
const ACTING: Side = Side::Right;
/// A place farther than this behind the axis of its part of the body is hidden, in metres.
const BEHIND: f32 = 0.045;
/// Distance of the camera as a multiple of half the visible height: a long lens.
const DISTANCE: f32 = 9.0;

static SCENE: OnceLock<Option<Scene>> = OnceLock::new();

/// Returns the body if it has been read already.
pub(crate) fn ready() -> Option<&'static Scene> {
    SCENE.get()?.as_ref()
}

/// Returns the body, reading it if necessary; too slow for the window's thread.
pub(crate) fn scene() -> Option<&'static Scene> {
    let read = || {
        let (clip, anatomy) = built_in_body().ok()?;
        let model = (clip.frames() > 0).then(|| clip.model_pose(0))?;
        Some(Scene {
            clip,
            anatomy,
            model,
        })
    };
    SCENE.get_or_init(read).as_ref()
}

impl Scene {
    /// Returns the position of a place, in model space.
    pub(crate) fn at(&self, landmark: &Landmark) -> Option<Vec3> {
        let (name, [left, up, forward]) = landmark.resolve(ACTING);
        let skeleton = self.clip.skeleton();
        let at = self.anatomy.landmark(skeleton, &self.model, &name)?;
        let frame = self.anatomy.body_frame(&self.model)?;
        let offset = frame.direction_to_model(DVec3::new(left, up, forward)) * frame.scale;
        Some((at + offset).as_vec3())
    }

    /// Returns those of `values` that a panel shows; the others lie behind the body.
    pub(crate) fn in_sight(
        &self,
        inventory: &Inventory,
        values: &[usize],
        (panel, turned): (Panel, bool),
    ) -> Vec<usize> {
        let middle = match panel {
            Panel::Space => None,
            Panel::Head => self.landmark("head-top").map(|top| (top, Vec3::Y)),
            Panel::Trunk => self.landmark("hips").map(|hips| (hips, Vec3::Y)),
            Panel::Hand => {
                let side = ACTING.other();
                let wrist = self.anatomy.joint(Part::Hand(side));
                let wrist = wrist.map(|it| self.model.position(it).as_vec3());
                let along = self.anatomy.hand_direction(side, &self.model);
                wrist.zip(along.map(|it| it.as_vec3()))
            }
        };
        let camera = self.camera(panel, turned);
        let Some(((middle, axis), camera)) = middle.zip(camera) else {
            return values.to_vec();
        };
        let towards = (camera.eye - camera.target).normalize_or(Vec3::Z);
        let seen = |at: Vec3| {
            // The part of the offset that is perpendicular to the axis of this part of the body.
            let away = at - middle;
            (away - axis * away.dot(axis)).dot(towards) > -BEHIND
        };
        let place = |value: &usize| self.at(inventory.values[*value].landmark.as_ref()?);
        let values = values.iter().copied();
        values
            .filter(|value| place(value).is_none_or(seen))
            .collect()
    }

    fn landmark(&self, name: &str) -> Option<Vec3> {
        let at = self
            .anatomy
            .landmark(self.clip.skeleton(), &self.model, name)?;
        Some(at.as_vec3())
    }

    /// Returns the camera of a panel, from the front or, if `turned`, from the signer's right; for the hand, from the
    /// side of the palm or of the back.
    pub(crate) fn camera(&self, panel: Panel, turned: bool) -> Option<Camera> {
        let frame = self.anatomy.body_frame(&self.model)?;
        let (left, forward) = (frame.left.as_vec3(), frame.forward.as_vec3());
        let towards = if turned { -left } else { forward };
        let look = |target: Vec3, towards: Vec3, up: Vec3, half_height: f32| Camera {
            eye: target + towards * (half_height * DISTANCE),
            target,
            up,
            half_height,
            near: 0.0,
        };
        let top = self.landmark("head-top")?;
        let chin = self.landmark("chin")?;
        let hips = self.landmark("hips")?;
        let middle = |low: f32, high: f32| {
            let centre = (hips.y + (top.y - hips.y) * (low + high) / 2.0, hips.z);
            (
                Vec3::new(hips.x, centre.0, centre.1),
                (top.y - hips.y) * (high - low) / 2.0,
            )
        };
        Some(match panel {
            Panel::Trunk => {
                let (target, half) = middle(-0.34, 1.06);
                look(target, towards, Vec3::Y, half)
            }
            Panel::Space => {
                let (target, half) = middle(-0.25, 1.12);
                look(target + forward * 0.12, towards, Vec3::Y, half)
            }
            Panel::Head => {
                let half = (top - chin).length() * 0.96;
                let target = Vec3::new(chin.x, (top.y + chin.y) / 2.0 - half * 0.04, chin.z);
                let back = if turned {
                    forward * -half * 0.42
                } else {
                    Vec3::ZERO
                };
                look(target + back, towards, Vec3::Y, half)
            }
            Panel::Hand => {
                let side = ACTING.other();
                let palm = self.anatomy.palm_normal(side, &self.model)?.as_vec3();
                let along = self.anatomy.hand_direction(side, &self.model)?.as_vec3();
                let wrist = self.anatomy.joint(Part::Hand(side))?;
                let wrist = self.model.position(wrist).as_vec3();
                let tip = self.landmark(&format!("{}-middle-tip", side.name()))?;
                let target = wrist.lerp(tip, 0.48);
                let towards = if turned { -palm } else { palm };
                look(target, towards, along, (tip - wrist).length() * 0.78)
            }
        })
    }

    /// Draws a panel.
    pub(crate) fn draw(
        &self,
        panel: Panel,
        turned: bool,
        size: [usize; 2],
        dark: bool,
    ) -> Option<eframe::egui::ColorImage> {
        let skeleton = self.clip.skeleton();
        let body = match panel {
            Panel::Hand => {
                let palette = Palette::default();
                Body::hand(skeleton, &self.anatomy, ACTING.other(), &palette)
            }
            _ => Body::new(skeleton, &self.anatomy),
        };
        let style = Style {
            theme: paint::theme(dark),
            ..Style::default()
        };
        let camera = self.camera(panel, turned)?;
        let mesh = body.mesh(&self.model);
        let image = Raster::default().draw(&mesh, &camera, size, &style);
        Some(paint::colour_image(&image))
    }
}

/// Returns the panel that shows a place, by its landmark.
pub(crate) fn panel(landmark: &Landmark) -> Panel {
    const HAND: [&str; 4] = ["palm", "hand-", "-tip", "knuckle"];
    const TRUNK: [&str; 15] = [
        "chest", "shoulder", "throat", "neck", "heart", "stomach", "belly", "abdomen", "waist",
        "hip", "thigh", "knee", "arm", "elbow", "wrist",
    ];
    let (name, _) = landmark.resolve(ACTING);
    let holds = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if name == "neutral-space" {
        Panel::Space
    } else if holds(&HAND) {
        Panel::Hand
    } else if holds(&TRUNK) {
        Panel::Trunk
    } else {
        Panel::Head
    }
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
                let way = if between.length() < 0.01 {
                    // Both have the same position: each pair moves in another direction.
                    Vec2::angled((a * 7 + b * 3) as f32)
                } else {
                    between.normalized()
                };
                zones[a].centre = room.clamp(zones[a].centre - way * (near / 2.0));
                zones[b].centre = room.clamp(zones[b].centre + way * (near / 2.0));
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
            .filter(|(_, value)| value.landmark.as_ref().map(self::panel) == Some(panel))
            .map(|(at, _)| at)
            .collect()
    }

    #[test]
    fn each_place_is_in_the_panel_that_shows_it_best() {
        let panel_of = |id: &str| {
            let value = placements().get(id).expect("a place");
            panel(value.landmark.as_ref().expect("a landmark"))
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
