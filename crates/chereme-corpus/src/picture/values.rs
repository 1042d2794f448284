//! Pictures of the values of inventories on the program's own body: places, and facial expressions.
//!
//! [`Scene`] is the body at rest, [`Panel`] is one view of it. [`Scene::place`] and [`Scene::face`] draw small pictures
//! at the size at which they are shown, with a mark that stands out from skin and clothes.

use chereme_figure::camera::Camera;
use chereme_figure::mesh::Mesh;
use chereme_figure::raster::{Raster, Style};
use chereme_figure::{Body, Colour, Image, Palette, Theme};
use chereme_motion::glam::{DVec3, Quat, Vec3};
use chereme_motion::{Anatomy, Clip, Face, ModelPose, Part, Side};
use chereme_sign::hamnosys::face::Expression;
use chereme_sign::inventory::{InventoryValue, Landmark};
use chereme_sign::{Component, Inventory};

use super::built_in_body;
use crate::error::Result;

/// A view of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Panel {
    /// Shoulders to hips, with both arms.
    Trunk,
    /// A close view of the head.
    #[default]
    Head,
    /// The weak hand alone.
    Hand,
    /// The space before the signer.
    Space,
}

impl Panel {
    /// Returns the ratio of width to height.
    #[must_use]
    pub fn aspect(self) -> f32 {
        match self {
            Self::Trunk => 0.74,
            Self::Head => 0.94,
            Self::Hand => 0.62,
            Self::Space => 0.86,
        }
    }

    /// Returns the panel that shows a place, by its landmark.
    #[must_use]
    pub fn of(landmark: &Landmark) -> Self {
        const HAND: [&str; 4] = ["palm", "hand-", "-tip", "knuckle"];
        const TRUNK: [&str; 15] = [
            "chest", "shoulder", "throat", "neck", "heart", "stomach", "belly", "abdomen", "waist",
            "hip", "thigh", "knee", "arm", "elbow", "wrist",
        ];
        let (name, _) = landmark.resolve(ACTING);
        let holds = |words: &[&str]| words.iter().any(|word| name.contains(word));
        if name == "neutral-space" {
            Self::Space
        } else if holds(&HAND) {
            Self::Hand
        } else if holds(&TRUNK) {
            Self::Trunk
        } else {
            Self::Head
        }
    }
}

/// The dominant hand, which decides the own and the other side in places.
pub const ACTING: Side = Side::Right;
/// A place farther than this behind the axis of its part of the body is hidden, in metres.
const BEHIND: f32 = 0.045;
/// The same for the mark of a place on the hand, which is thin.
const HAND_BEHIND: f32 = 0.004;
/// The beginning of the names of landmarks on the lower side of a part.
const UNDER: &str = "under-";
/// Distance of the camera as a multiple of half the visible height: a long lens.
const DISTANCE: f32 = 9.0;

/// The fill of a mark, and the ring around it.
const MARK: [Colour; 2] = [Colour([0xD4, 0x1A, 0x1A]), Colour([0xFF, 0xFF, 0xFF])];
/// The radius of a mark as a share of the picture's side, and its least radius in pixels.
const RADIUS: f32 = 0.085;
const LEAST: f32 = 2.2;
/// The radius of the ring around a mouth that shows teeth or tongue, as such a share.
const MOUTH: f32 = 0.17;
/// The radius of the ring around a part of the body, by the least number of places within that part.
const PARTS: [(usize, f32); 4] = [(40, 0.44), (15, 0.36), (8, 0.27), (5, 0.19)];

/// The form of a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mark {
    /// A disc: the place is in sight.
    Disc,
    /// A thick ring: the place is on the far side.
    Hidden,
    /// A ring around a part of the body.
    Around(f32),
}

/// The body at rest.
pub struct Scene {
    clip: Clip,
    anatomy: std::sync::Arc<Anatomy>,
    model: ModelPose,
    body: Body,
    hand: Body,
}

impl Scene {
    /// Reads the program's own body.
    ///
    /// # Errors
    /// Fails if the program's own file is damaged.
    pub fn new() -> Result<Self> {
        let (clip, anatomy) = built_in_body()?;
        let skeleton = clip.skeleton();
        Ok(Self {
            model: clip.model_pose(0),
            body: Body::new(skeleton, &anatomy),
            hand: Body::hand(skeleton, &anatomy, ACTING.other(), &Palette::default()),
            anatomy,
            clip,
        })
    }

    /// Returns the position of a place, in model space.
    #[must_use]
    pub fn at(&self, landmark: &Landmark) -> Option<Vec3> {
        let (name, [left, up, forward]) = landmark.resolve(ACTING);
        let skeleton = self.clip.skeleton();
        let at = self.anatomy.landmark(skeleton, &self.model, &name)?;
        let frame = self.anatomy.body_frame(&self.model)?;
        let offset = frame.direction_to_model(DVec3::new(left, up, forward)) * frame.scale;
        Some((at + offset).as_vec3())
    }

    /// Returns those of `values` that a panel shows; the others lie behind the body.
    #[must_use]
    pub fn in_sight(
        &self,
        inventory: &Inventory,
        values: &[usize],
        (panel, turned): (Panel, bool),
    ) -> Vec<usize> {
        let Some(camera) = self.camera(panel, turned) else {
            return values.to_vec();
        };
        let seen = |value: &usize| {
            let landmark = inventory.values[*value].landmark.as_ref();
            let at = landmark.and_then(|it| self.at(it));
            at.is_none_or(|at| self.depth(panel, at, &camera) <= BEHIND)
        };
        values.iter().copied().filter(seen).collect()
    }

    /// Returns how far a place in a panel lies behind the axis of its part of the body, in metres.
    fn depth(&self, panel: Panel, at: Vec3, camera: &Camera) -> f32 {
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
        middle.map_or(f32::NEG_INFINITY, |(middle, axis)| {
            let towards = (camera.eye - camera.target).normalize_or(Vec3::Z);
            // The part of the offset that is perpendicular to the axis of this part of the body.
            let away = at - middle;
            -(away - axis * away.dot(axis)).dot(towards)
        })
    }

    fn landmark(&self, name: &str) -> Option<Vec3> {
        let at = self
            .anatomy
            .landmark(self.clip.skeleton(), &self.model, name)?;
        Some(at.as_vec3())
    }

    /// Returns the camera of a panel, from the front or, if `turned`, from the signer's right; for the hand, from the
    /// side of the palm or of the back.
    #[must_use]
    pub fn camera(&self, panel: Panel, turned: bool) -> Option<Camera> {
        let frame = self.anatomy.body_frame(&self.model)?;
        let (left, forward) = (frame.left.as_vec3(), frame.forward.as_vec3());
        let towards = if turned { -left } else { forward };
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
                // From the side the picture reaches from the back to the far end of the space.
                let ahead = if turned { 0.56 * half } else { 0.12 };
                look(target + forward * ahead, towards, Vec3::Y, half)
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
    #[must_use]
    pub fn draw(
        &self,
        panel: Panel,
        turned: bool,
        size: [usize; 2],
        theme: Theme,
    ) -> Option<Image> {
        let style = Style {
            theme,
            ..Style::default()
        };
        let camera = self.camera(panel, turned)?;
        let mesh = self.mesh(panel, None);
        Some(Raster::default().draw(&mesh, &camera, size, &style))
    }

    fn mesh(&self, panel: Panel, face: Option<&Face>) -> Mesh {
        let body = match panel {
            Panel::Hand => &self.hand,
            _ => &self.body,
        };
        let mut mesh = body.mesh(&self.model);
        if let Some(face) = face {
            body.express(&self.model, face, &mut mesh);
        }
        mesh
    }

    /// Draws the small picture of a place, `size` pixels wide and high. `None` if the value is no place.
    #[must_use]
    pub fn place(
        &self,
        inventory: &Inventory,
        value: &InventoryValue,
        size: usize,
        theme: Theme,
    ) -> Option<Image> {
        let camera = self.camera(Panel::of(value.landmark.as_ref()?), false)?;
        self.place_from((inventory, value), &camera, size, theme)
    }

    /// Draws the small picture of a place with another camera.
    #[must_use]
    pub fn place_from(
        &self,
        (inventory, value): (&Inventory, &InventoryValue),
        camera: &Camera,
        size: usize,
        theme: Theme,
    ) -> Option<Image> {
        let landmark = value.landmark.as_ref()?;
        let panel = Panel::of(landmark);
        let at = self.at(landmark)?;
        let shown = shown_part(&value.id);
        let mesh = self.mesh(panel, shown.as_ref());
        let mut image = Raster::default().draw(&mesh, camera, [size; 2], &small(theme));
        let seen = camera.projection(size, size).project(at);
        let within =
            |it: &&InventoryValue| it.id != value.id && inventory.is_within(&it.id, &value.id);
        let count = inventory.values.iter().filter(within).count();
        let around = PARTS.iter().find(|(least, _)| count >= *least);
        let hidden = match panel {
            Panel::Hand => HAND_BEHIND,
            _ => BEHIND,
        };
        let mark = match around.filter(|_| panel != Panel::Space) {
            Some((_, share)) => Mark::Around(share * size as f32),
            None if shown.is_some() => Mark::Around(MOUTH * size as f32),
            // The eye does not see what lies under a part.
            None if landmark.name.starts_with(UNDER) => Mark::Hidden,
            None if self.depth(panel, at, camera) > hidden => Mark::Hidden,
            None => Mark::Disc,
        };
        // Nearer marks are larger.
        let forward = landmark.offset[2] as f32;
        let near = match panel {
            Panel::Space => 1.0 - 0.8 * forward,
            _ => 1.0 + 0.9 * (forward - 0.1).max(0.0),
        };
        let radius = (RADIUS * size as f32).max(LEAST) * near;
        put(&mut image, [seen.x, seen.y], radius, mark);
        Some(image)
    }

    /// Draws the small picture of a facial expression, `size` pixels wide and high: the part of the face that `feature`
    /// of an inventory names.
    #[must_use]
    pub fn face(&self, face: &Face, feature: &str, size: usize, theme: Theme) -> Option<Image> {
        let frame = self.anatomy.body_frame(&self.model)?;
        let (left, forward) = (frame.left.as_vec3(), frame.forward.as_vec3());
        let (top, chin) = (self.landmark("head-top")?, self.landmark("chin")?);
        let (up, high) = ((top - chin).normalize_or(Vec3::Y), (top - chin).length());
        // From the chin, as shares of the head.
        let (middle, half) = match feature {
            "mouth" => (0.20, 0.24),
            "brows" | "lids" | "gaze" => (0.55, 0.27),
            "nose" => (0.38, 0.30),
            _ => (0.45, 0.60),
        };
        let target = chin + up * (middle * high) - forward * (0.10 * high);
        let camera = look(target, forward - left * 0.20, up, half * high);
        let mesh = self.mesh(Panel::Head, Some(face));
        Some(Raster::default().draw(&mesh, &camera, [size; 2], &small(theme)))
    }
}

/// Returns the facial expression of a non-manual value; `None` if it is not on the face.
#[must_use]
pub fn expression(inventory: &Inventory, value: &InventoryValue) -> Option<Face> {
    let feature = inventory.feature.as_deref()?;
    // The values of mouthings are shares of a word, no shapes.
    if inventory.component != Component::NonManual || feature == "mouthing" {
        return None;
    }
    let mut spellings = value.spellings();
    let found = spellings.find_map(|text| Expression::of(feature, text));
    found.map_or_else(|| plain(feature, &value.id), |it| Some(it.fullest()))
}

/// Returns the expression of a value that has a plain name and no code.
fn plain(feature: &str, id: &str) -> Option<Face> {
    let mut face = Face::default();
    match (feature, id) {
        ("brows" | "lids" | "nose" | "mouth", "neutral") => {}
        ("mouth", "open") => (face.jaw, face.parted) = (0.45, 0.3),
        ("mouth", "wide-open") => (face.jaw, face.parted) = (1.0, 0.4),
        ("mouth", "rounded") => (face.wide, face.parted) = (-1.0, 0.3),
        ("mouth", "spread") => face.wide = 1.0,
        ("mouth", "smile") => (face.corners, face.wide) = ([1.0; 2], 0.4),
        ("mouth", "corners-down") => face.corners = [-1.0; 2],
        ("mouth", "pressed") => face.pressed = 1.0,
        ("mouth", "puffed") => face.cheeks = [1.0; 2],
        ("mouth", "sucked-in") => face.cheeks = [-1.0; 2],
        ("mouth", "tongue-out") => (face.tongue, face.jaw) = (1.0, 0.3),
        ("mouth", "blowing") => (face.pout, face.parted) = (1.0, 0.4),
        _ => return None,
    }
    Some(face)
}

/// Returns a camera with a long lens.
fn look(target: Vec3, towards: Vec3, up: Vec3, half_height: f32) -> Camera {
    Camera {
        eye: target + towards.normalize_or(Vec3::Z) * (half_height * DISTANCE),
        target,
        up,
        half_height,
        near: 0.0,
    }
}

/// Returns a camera turned about its target, aside and up, in radians.
#[must_use]
pub fn turned(camera: &Camera, [aside, up]: [f32; 2]) -> Camera {
    let away = camera.eye - camera.target;
    let across = camera.up.cross(away).normalize_or(Vec3::X);
    let turn = Quat::from_axis_angle(camera.up.normalize_or(Vec3::Y), aside);
    let eye = camera.target + turn * Quat::from_axis_angle(across, -up) * away;
    Camera { eye, ..*camera }
}

/// Returns the style of pictures that are drawn at the size at which they are shown.
fn small(theme: Theme) -> Style {
    Style {
        theme,
        samples: 4,
        ..Style::default()
    }
}

/// Returns the expression that shows a place inside the mouth.
fn shown_part(place: &str) -> Option<Face> {
    let open = Face {
        parted: 0.7,
        wide: 0.3,
        ..Face::default()
    };
    match place {
        "teeth" => Some(Face { teeth: 1.0, ..open }),
        "tongue" => Some(Face {
            tongue: 1.0,
            jaw: 0.4,
            ..open
        }),
        _ => None,
    }
}

/// Draws a mark, at the edge if its middle lies outside of the picture.
fn put(image: &mut Image, at: [f32; 2], radius: f32, mark: Mark) {
    let size = [image.width() as f32, image.height() as f32];
    let rim = 0.3 * radius.max(LEAST);
    let reach = match mark {
        Mark::Around(wide) => wide,
        _ => radius + rim,
    };
    let middle = [0, 1].map(|axis| {
        let edge = reach.min(size[axis] * 0.5);
        at[axis].clamp(edge, size[axis] - edge)
    });
    for y in 0..image.height() {
        for x in 0..image.width() {
            let far = (x as f32 + 0.5 - middle[0]).hypot(y as f32 + 0.5 - middle[1]);
            // The share of the pixel that is inside of a circle.
            let inside = |radius: f32| (radius - far + 0.5).clamp(0.0, 1.0);
            let [fill, ring] = match mark {
                Mark::Disc => [inside(radius), inside(radius + rim)],
                Mark::Hidden => {
                    let hole = inside(radius * 0.45);
                    [inside(radius) - hole, inside(radius + rim) - hole]
                }
                Mark::Around(wide) => {
                    let thick = radius * 0.4;
                    let fill = inside(wide) - inside(wide - thick);
                    [fill, inside(wide + rim) - inside(wide - thick - rim)]
                }
            };
            if ring > 0.0 {
                let below = image.pixel(x, y);
                let colour = below.mixed(MARK[1], ring).mixed(MARK[0], fill);
                image.set_colour([x, y], colour);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_by_id;

    fn scene() -> Scene {
        Scene::new().expect("the program's own body")
    }

    #[test]
    fn every_place_has_a_small_picture_of_its_own() {
        let (scene, places) = (scene(), builtin_by_id("placements").expect("of the house"));
        let drawn: Vec<(&str, Image)> = places
            .values
            .iter()
            .filter_map(|value| {
                let image = scene.place(places, value, 48, Theme::Light)?;
                Some((value.id.as_str(), image))
            })
            .collect();
        assert_eq!(drawn.len(), places.values.len());
        for (at, (id, image)) in drawn.iter().enumerate() {
            for (other, another) in &drawn[at + 1..] {
                assert_ne!(image.pixels(), another.pixels(), "{id} and {other}");
            }
        }
    }

    #[test]
    fn a_picture_that_shows_one_movement_is_refused_for_several() {
        use crate::{Address, Corpus, PictureOptions, Progress, unheard};
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create(&folder.path().join("a.chereme"), "A").expect("made");
        let both: Vec<Address> = ["A", "B"].map(|it| it.parse().expect("a gloss")).into();
        for name in ["pair.png", "pair.svg"] {
            let (to, mut hear) = (folder.path().join(name), unheard);
            let options = PictureOptions::default();
            let error = corpus
                .draw_together(&both, &to, &options, &mut Progress::new(&mut hear))
                .expect_err("several");
            assert_eq!(
                error.to_string(),
                "such a picture shows one movement, and several are named"
            );
        }
    }

    #[test]
    fn mouths_have_pictures_and_heads_have_none() {
        let find = |id| builtin_by_id(id).expect("of the house");
        let mouth = find("mouth");
        let drawn = mouth.values.iter();
        let drawn = drawn.filter(|value| expression(mouth, value).is_some());
        assert!(drawn.count() > 70);
        let head = find("head");
        assert!(head.values.iter().all(|it| expression(head, it).is_none()));
    }

    #[test]
    fn a_place_behind_the_hand_is_marked_by_a_ring() {
        let (scene, places) = (scene(), builtin_by_id("placements").expect("of the house"));
        let camera = scene.camera(Panel::Hand, false).expect("a hand");
        let behind = |id: &str| {
            let landmark = places.get(id).and_then(|it| it.landmark.as_ref());
            let at = scene.at(landmark.expect("a place")).expect("on the body");
            scene.depth(Panel::Hand, at, &camera) > HAND_BEHIND
        };
        assert!(behind("hand-back") && !behind("palm"));
        let mut image = Image::new(20, 20, Colour([0; 3]));
        put(&mut image, [10.0, 10.0], 6.0, Mark::Hidden);
        assert_eq!(image.pixel(10, 10), Colour([0; 3]));
        put(&mut image, [10.0, 10.0], 6.0, Mark::Disc);
        assert_eq!(image.pixel(10, 10), MARK[0]);
    }
}
