//! Pictures of the values of inventories on the program's own body: places, and facial expressions.
//!
//! [`RestingBodyScene`] is the body at rest, [`PlacePanel`] is one view of it. [`RestingBodyScene::draw_place_picture`] and [`RestingBodyScene::draw_expression_picture`] draw small pictures
//! at the size at which they are shown, with a mark that stands out from skin and clothes.

use chereme_figure::camera::FigureCamera;
use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::{FigureRaster, FigureStyle};
use chereme_figure::{FigurePalette, PaperTheme, RasterImage, RgbColour, SignerBody};
use chereme_motion::glam::{DVec3, Quat, Vec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, FacePosture, ModelPose};
use chereme_sign::hamnosys::hamnosys_face::FacialExpression;
use chereme_sign::inventory::{BodyLandmark, InventoryValue};
use chereme_sign::{ComponentInventory, SignComponent};

use crate::error::CorpusResult;
use crate::starter::built_in_body;

/// A view of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum PlacePanel {
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

/// A panel with the direction from which it is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PanelView {
    /// The panel.
    pub panel: PlacePanel,
    /// Whether the body is seen from its side.
    pub turned: bool,
}

impl PlacePanel {
    /// Returns the ratio of width to height.
    #[must_use]
    pub fn panel_aspect_ratio(self) -> f32 {
        match self {
            Self::Trunk => 0.74,
            Self::Head => 0.94,
            Self::Hand => 0.62,
            Self::Space => 0.86,
        }
    }

    /// Returns the panel that shows a place, by its landmark.
    #[must_use]
    pub fn panel_of_landmark(landmark: &BodyLandmark) -> Self {
        const HAND_LANDMARK_WORDS: [&str; 4] = ["palm", "hand-", "-tip", "knuckle"];
        const TRUNK_LANDMARK_WORDS: [&str; 15] = [
            "chest", "shoulder", "throat", "neck", "heart", "stomach", "belly", "abdomen", "waist", "hip", "thigh",
            "knee", "arm", "elbow", "wrist",
        ];
        let (name, _) = landmark.resolve_landmark(DOMINANT_PICTURE_SIDE);
        let holds = |words: &[&str]| words.iter().any(|word| name.contains(word));
        if name == "neutral-space" {
            Self::Space
        } else if holds(&HAND_LANDMARK_WORDS) {
            Self::Hand
        } else if holds(&TRUNK_LANDMARK_WORDS) {
            Self::Trunk
        } else {
            Self::Head
        }
    }
}

/// The dominant hand, which decides the own and the other side in places.
pub const DOMINANT_PICTURE_SIDE: BodySide = BodySide::Right;
/// A place farther than this behind the axis of its part of the body is hidden, in metres.
const HIDDEN_BEHIND_METRES: f32 = 0.045;
/// The same for the mark of a place on the hand, which is thin.
const HAND_BEHIND: f32 = 0.004;
/// The beginning of the names of landmarks on the lower side of a part.
const LOWER_SIDE_PREFIX: &str = "under-";
/// Distance of the camera as a multiple of half the visible height: a long lens.
const CAMERA_DISTANCE_FACTOR: f32 = 9.0;

/// The fill of a mark, and the ring around it.
const PLACE_MARK_COLOURS: [RgbColour; 2] = [RgbColour([0xD4, 0x1A, 0x1A]), RgbColour([0xFF, 0xFF, 0xFF])];
/// The radius of a mark as a share of the picture's side, and its least radius in pixels.
const MARK_RADIUS_SHARE: f32 = 0.085;
const MIN_MARK_RADIUS_PX: f32 = 2.2;
/// The radius of the ring around a mouth that shows teeth or tongue, as such a share.
const MOUTH_RING_RADIUS_SHARE: f32 = 0.17;
/// The radius of the ring around a part of the body, by the least number of places within that part.
const PART_RING_RADII: [(usize, f32); 4] = [(40, 0.44), (15, 0.36), (8, 0.27), (5, 0.19)];

/// The form of a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PlaceMark {
    /// A disc: the place is in sight.
    Disc,
    /// A thick ring: the place is on the far side.
    Hidden,
    /// A ring around a part of the body.
    Around(f32),
}

/// The body at rest.
pub struct RestingBodyScene {
    clip: Clip,
    anatomy: std::sync::Arc<BodyAnatomy>,
    model: ModelPose,
    body: SignerBody,
    hand: SignerBody,
}

impl RestingBodyScene {
    /// Reads the program's own body.
    ///
    /// # Errors
    /// Fails if the program's own file is damaged.
    pub fn new() -> CorpusResult<Self> {
        let (clip, anatomy) = built_in_body()?;
        let skeleton = clip.clip_skeleton();
        Ok(Self {
            model: clip.model_pose(0),
            body: SignerBody::new(skeleton, &anatomy),
            hand: SignerBody::with_single_hand(
                skeleton,
                &anatomy,
                DOMINANT_PICTURE_SIDE.opposite_side(),
                &FigurePalette::default(),
            ),
            anatomy,
            clip,
        })
    }

    /// Returns the position of a place, in model space.
    #[must_use]
    pub fn landmark_position(&self, landmark: &BodyLandmark) -> Option<Vec3> {
        let (name, [left, up, forward]) = landmark.resolve_landmark(DOMINANT_PICTURE_SIDE);
        let skeleton = self.clip.clip_skeleton();
        let landmark_place = self.anatomy.landmark_place_position(skeleton, &self.model, &name)?;
        let frame = self.anatomy.body_frame(&self.model)?;
        let offset = frame.direction_to_model(DVec3::new(left, up, forward)) * frame.scale;
        Some((landmark_place + offset).as_vec3())
    }

    /// Returns those of `values` that a panel shows; the others lie behind the body.
    #[must_use]
    pub fn in_sight(&self, inventory: &ComponentInventory, values: &[usize], view: PanelView) -> Vec<usize> {
        let PanelView { panel, turned } = view;
        let Some(camera) = self.panel_camera(panel, turned) else {
            return values.to_vec();
        };
        let seen = |value: &usize| {
            let landmark = inventory.values[*value].landmark.as_ref();
            let place = landmark.and_then(|landmark| self.landmark_position(landmark));
            place.is_none_or(|at| self.depth_behind_axis(panel, at, &camera) <= HIDDEN_BEHIND_METRES)
        };
        values.iter().copied().filter(seen).collect()
    }

    /// Returns how far a place in a panel lies behind the axis of its part of the body, in metres.
    fn depth_behind_axis(&self, panel: PlacePanel, at: Vec3, camera: &FigureCamera) -> f32 {
        let middle = match panel {
            PlacePanel::Space => None,
            PlacePanel::Head => self.named_landmark_position("head-top").map(|top| (top, Vec3::Y)),
            PlacePanel::Trunk => self.named_landmark_position("hips").map(|hips| (hips, Vec3::Y)),
            PlacePanel::Hand => {
                let side = DOMINANT_PICTURE_SIDE.opposite_side();
                let wrist_joint = self.anatomy.part_joint(BodyPart::Hand(side));
                let wrist = wrist_joint.map(|joint| self.model.model_joint_position(joint).as_vec3());
                let along = self.anatomy.hand_direction(side, &self.model);
                wrist.zip(along.map(|direction| direction.as_vec3()))
            }
        };
        middle.map_or(f32::NEG_INFINITY, |(middle, axis)| {
            let towards = (camera.eye - camera.target).normalize_or(Vec3::Z);
            // The part of the offset that is perpendicular to the axis of this part of the body.
            let away = at - middle;
            -(away - axis * away.dot(axis)).dot(towards)
        })
    }

    fn named_landmark_position(&self, name: &str) -> Option<Vec3> {
        let place = self
            .anatomy
            .landmark_place_position(self.clip.clip_skeleton(), &self.model, name)?;
        Some(place.as_vec3())
    }

    /// Returns the camera of a panel, from the front or, if `turned`, from the signer's right; for the hand, from the
    /// side of the palm or of the back.
    #[must_use]
    pub fn panel_camera(&self, panel: PlacePanel, turned: bool) -> Option<FigureCamera> {
        let frame = self.anatomy.body_frame(&self.model)?;
        let (left, forward) = (frame.left.as_vec3(), frame.forward.as_vec3());
        let towards = if turned { -left } else { forward };
        let top = self.named_landmark_position("head-top")?;
        let chin = self.named_landmark_position("chin")?;
        let hips = self.named_landmark_position("hips")?;
        let middle = |low: f32, high: f32| {
            let centre = (hips.y + (top.y - hips.y) * (low + high) / 2.0, hips.z);
            (
                Vec3::new(hips.x, centre.0, centre.1),
                (top.y - hips.y) * (high - low) / 2.0,
            )
        };
        Some(match panel {
            PlacePanel::Trunk => {
                let (target, half) = middle(-0.34, 1.06);
                long_lens_camera(target, towards, Vec3::Y, half)
            }
            PlacePanel::Space => {
                let (target, half) = middle(-0.25, 1.12);
                // From the side the picture reaches from the back to the far end of the space.
                let ahead = if turned { 0.56 * half } else { 0.12 };
                long_lens_camera(target + forward * ahead, towards, Vec3::Y, half)
            }
            PlacePanel::Head => {
                let half = (top - chin).length() * 0.96;
                let target = Vec3::new(chin.x, (top.y + chin.y) / 2.0 - half * 0.04, chin.z);
                let back = if turned { forward * -half * 0.42 } else { Vec3::ZERO };
                long_lens_camera(target + back, towards, Vec3::Y, half)
            }
            PlacePanel::Hand => {
                let side = DOMINANT_PICTURE_SIDE.opposite_side();
                let palm = self.anatomy.palm_normal(side, &self.model)?.as_vec3();
                let along = self.anatomy.hand_direction(side, &self.model)?.as_vec3();
                let wrist_joint = self.anatomy.part_joint(BodyPart::Hand(side))?;
                let wrist = self.model.model_joint_position(wrist_joint).as_vec3();
                let tip = self.named_landmark_position(&format!("{}-middle-tip", side.body_side_name()))?;
                let target = wrist.lerp(tip, 0.48);
                let towards = if turned { -palm } else { palm };
                long_lens_camera(target, towards, along, (tip - wrist).length() * 0.78)
            }
        })
    }

    /// Draws a panel.
    #[must_use]
    pub fn draw_body_panel(
        &self,
        panel: PlacePanel,
        turned: bool,
        size: [usize; 2],
        theme: PaperTheme,
    ) -> Option<RasterImage> {
        let style = FigureStyle {
            theme,
            ..FigureStyle::default()
        };
        let camera = self.panel_camera(panel, turned)?;
        let mesh = self.panel_mesh(panel, None);
        Some(FigureRaster::default().draw_mesh_picture(&mesh, &camera, size, &style))
    }

    fn panel_mesh(&self, panel: PlacePanel, face: Option<&FacePosture>) -> TriangleMesh {
        let body = match panel {
            PlacePanel::Hand => &self.hand,
            _ => &self.body,
        };
        let mut mesh = body.posed_mesh(&self.model);
        if let Some(face) = face {
            body.apply_face_expression(&self.model, face, &mut mesh);
        }
        mesh
    }

    /// Draws the small picture of a place, `size` pixels wide and high. `None` if the value is no place.
    #[must_use]
    pub fn draw_place_picture(
        &self,
        inventory: &ComponentInventory,
        value: &InventoryValue,
        size: usize,
        theme: PaperTheme,
    ) -> Option<RasterImage> {
        let camera = self.panel_camera(PlacePanel::panel_of_landmark(value.landmark.as_ref()?), false)?;
        self.place_from(inventory, value, &camera, size, theme)
    }

    /// Draws the small picture of a place with another camera.
    #[must_use]
    pub fn place_from(
        &self,
        inventory: &ComponentInventory,
        value: &InventoryValue,
        camera: &FigureCamera,
        size: usize,
        theme: PaperTheme,
    ) -> Option<RasterImage> {
        let landmark = value.landmark.as_ref()?;
        let panel = PlacePanel::panel_of_landmark(landmark);
        let place = self.landmark_position(landmark)?;
        let shown = shown_part(&value.id);
        let mesh = self.panel_mesh(panel, shown.as_ref());
        let mut image =
            FigureRaster::default().draw_mesh_picture(&mesh, camera, [size; 2], &small_picture_style(theme));
        let seen = camera.camera_projection(size, size).project_point(place);
        let within = |other: &&InventoryValue| other.id != value.id && inventory.is_within_value(&other.id, &value.id);
        let count = inventory.values.iter().filter(within).count();
        let around = PART_RING_RADII.iter().find(|(least, _)| count >= *least);
        let hidden = match panel {
            PlacePanel::Hand => HAND_BEHIND,
            _ => HIDDEN_BEHIND_METRES,
        };
        let mark = match around.filter(|_| panel != PlacePanel::Space) {
            Some((_, share)) => PlaceMark::Around(share * size as f32),
            None if shown.is_some() => PlaceMark::Around(MOUTH_RING_RADIUS_SHARE * size as f32),
            // The eye does not see what lies under a part.
            None if landmark.name.starts_with(LOWER_SIDE_PREFIX) => PlaceMark::Hidden,
            None if self.depth_behind_axis(panel, place, camera) > hidden => PlaceMark::Hidden,
            None => PlaceMark::Disc,
        };
        // Nearer marks are larger.
        let forward = landmark.offset[2] as f32;
        let near = match panel {
            PlacePanel::Space => 1.0 - 0.8 * forward,
            _ => 1.0 + 0.9 * (forward - 0.1).max(0.0),
        };
        let radius = (MARK_RADIUS_SHARE * size as f32).max(MIN_MARK_RADIUS_PX) * near;
        draw_place_mark(&mut image, [seen.x, seen.y], radius, mark);
        Some(image)
    }

    /// Draws the small picture of a facial expression, `size` pixels wide and high: the part of the face that `feature`
    /// of an inventory names.
    #[must_use]
    pub fn draw_expression_picture(
        &self,
        face: &FacePosture,
        feature: &str,
        size: usize,
        theme: PaperTheme,
    ) -> Option<RasterImage> {
        let frame = self.anatomy.body_frame(&self.model)?;
        let (left, forward) = (frame.left.as_vec3(), frame.forward.as_vec3());
        let (top, chin) = (
            self.named_landmark_position("head-top")?,
            self.named_landmark_position("chin")?,
        );
        let (up, high) = ((top - chin).normalize_or(Vec3::Y), (top - chin).length());
        // From the chin, as shares of the head.
        let (middle, half) = match feature {
            "mouth" => (0.20, 0.24),
            "brows" | "lids" | "gaze" => (0.55, 0.27),
            "nose" => (0.38, 0.30),
            _ => (0.45, 0.60),
        };
        let target = chin + up * (middle * high) - forward * (0.10 * high);
        let camera = long_lens_camera(target, forward - left * 0.20, up, half * high);
        let mesh = self.panel_mesh(PlacePanel::Head, Some(face));
        Some(FigureRaster::default().draw_mesh_picture(&mesh, &camera, [size; 2], &small_picture_style(theme)))
    }
}

/// Returns the facial expression of a non-manual value; `None` if it is not on the face.
#[must_use]
pub fn facial_expression_of_value(inventory: &ComponentInventory, value: &InventoryValue) -> Option<FacePosture> {
    let feature = inventory.feature.as_deref()?;
    // The values of mouthings are shares of a word, no shapes.
    if inventory.component != SignComponent::NonManual || feature == "mouthing" {
        return None;
    }
    let mut spellings = value.value_spellings();
    let expression = spellings.find_map(|text| FacialExpression::from_nonmanual_code(feature, text));
    let is_resting = value.id == "neutral" && ["brows", "lids", "nose", "mouth"].contains(&feature);
    let resting_face = is_resting.then(FacePosture::default);
    expression.map(|expression| expression.fullest_face()).or(resting_face)
}

/// Returns a camera with a long lens.
fn long_lens_camera(target: Vec3, towards: Vec3, up: Vec3, half_height: f32) -> FigureCamera {
    FigureCamera {
        eye: target + towards.normalize_or(Vec3::Z) * (half_height * CAMERA_DISTANCE_FACTOR),
        target,
        up,
        half_height,
        near: 0.0,
    }
}

/// Returns a camera turned about its target, aside and up, in radians.
#[must_use]
pub fn turned_camera(camera: &FigureCamera, [aside, up]: [f32; 2]) -> FigureCamera {
    let away = camera.eye - camera.target;
    let across = camera.up.cross(away).normalize_or(Vec3::X);
    let turn = Quat::from_axis_angle(camera.up.normalize_or(Vec3::Y), aside);
    let eye = camera.target + turn * Quat::from_axis_angle(across, -up) * away;
    FigureCamera { eye, ..*camera }
}

/// Returns the style of pictures that are drawn at the size at which they are shown.
fn small_picture_style(theme: PaperTheme) -> FigureStyle {
    FigureStyle {
        theme,
        samples: 4,
        ..FigureStyle::default()
    }
}

/// Returns the expression that shows a place inside the mouth.
fn shown_part(place: &str) -> Option<FacePosture> {
    let open = FacePosture {
        parted: 0.7,
        wide: 0.3,
        ..FacePosture::default()
    };
    match place {
        "teeth" => Some(FacePosture { teeth: 1.0, ..open }),
        "tongue" => Some(FacePosture {
            tongue: 1.0,
            jaw: 0.4,
            ..open
        }),
        _ => None,
    }
}

/// Draws a mark, at the edge if its middle lies outside of the picture.
fn draw_place_mark(image: &mut RasterImage, at: [f32; 2], radius: f32, mark: PlaceMark) {
    let size = [image.image_width() as f32, image.image_height() as f32];
    let rim = 0.3 * radius.max(MIN_MARK_RADIUS_PX);
    let reach = match mark {
        PlaceMark::Around(wide) => wide,
        _ => radius + rim,
    };
    let middle = [0, 1].map(|axis| {
        let edge = reach.min(size[axis] * 0.5);
        at[axis].clamp(edge, size[axis] - edge)
    });
    for y in 0..image.image_height() {
        for x in 0..image.image_width() {
            let far = (x as f32 + 0.5 - middle[0]).hypot(y as f32 + 0.5 - middle[1]);
            // The share of the pixel that is inside of a circle.
            let inside = |radius: f32| (radius - far + 0.5).clamp(0.0, 1.0);
            let [fill, ring] = match mark {
                PlaceMark::Disc => [inside(radius), inside(radius + rim)],
                PlaceMark::Hidden => {
                    let hole = inside(radius * 0.45);
                    [inside(radius) - hole, inside(radius + rim) - hole]
                }
                PlaceMark::Around(wide) => {
                    let thick = radius * 0.4;
                    let fill = inside(wide) - inside(wide - thick);
                    [fill, inside(wide + rim) - inside(wide - thick - rim)]
                }
            };
            if ring > 0.0 {
                let below = image.image_pixel_at(x, y);
                let colour = below
                    .mix_colour(PLACE_MARK_COLOURS[1], ring)
                    .mix_colour(PLACE_MARK_COLOURS[0], fill);
                image.set_colour([x, y], colour);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::inventory::builtin_by_id;

    fn scene() -> RestingBodyScene {
        RestingBodyScene::new().expect("the program's own body")
    }

    #[test]
    fn every_place_has_a_small_picture_of_its_own() {
        let (scene, places) = (scene(), builtin_by_id("placements").expect("of the house"));
        let drawn: Vec<(&str, RasterImage)> = places
            .values
            .iter()
            .filter_map(|value| {
                let image = scene.draw_place_picture(places, value, 48, PaperTheme::Light)?;
                Some((value.id.as_str(), image))
            })
            .collect();
        assert_eq!(drawn.len(), places.values.len());
        for (at, (id, image)) in drawn.iter().enumerate() {
            for (other, another) in &drawn[at + 1..] {
                assert_ne!(image.image_pixels(), another.image_pixels(), "{id} and {other}");
            }
        }
    }

    #[test]
    fn a_picture_that_shows_one_movement_is_refused_for_several() {
        use crate::{Corpus, CorpusAddress, PictureOptions, ProgressReceiver, ignore_progress_step};
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = Corpus::create_corpus(&folder.path().join("a.chereme"), "A").expect("made");
        let both: Vec<CorpusAddress> = ["A", "B"].map(|it| it.parse().expect("a gloss")).into();
        for name in ["pair.png", "pair.svg"] {
            let (to, mut hear) = (folder.path().join(name), ignore_progress_step);
            let options = PictureOptions::default();
            let error = corpus
                .draw_together(&both, &to, &options, &mut ProgressReceiver::new(&mut hear))
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
        let drawn = drawn.filter(|value| facial_expression_of_value(mouth, value).is_some());
        assert!(drawn.count() > 70);
        let head = find("head");
        assert!(
            head.values
                .iter()
                .all(|it| facial_expression_of_value(head, it).is_none())
        );
    }

    #[test]
    fn a_place_behind_the_hand_is_marked_by_a_ring() {
        let (scene, places) = (scene(), builtin_by_id("placements").expect("of the house"));
        let camera = scene.panel_camera(PlacePanel::Hand, false).expect("a hand");
        let behind = |id: &str| {
            let landmark = places.value_by_id(id).and_then(|it| it.landmark.as_ref());
            let at = scene
                .landmark_position(landmark.expect("a place"))
                .expect("on the body");
            scene.depth_behind_axis(PlacePanel::Hand, at, &camera) > HAND_BEHIND
        };
        assert!(behind("hand-back") && !behind("palm"));
        let mut image = RasterImage::new(20, 20, RgbColour([0; 3]));
        draw_place_mark(&mut image, [10.0, 10.0], 6.0, PlaceMark::Hidden);
        assert_eq!(image.image_pixel_at(10, 10), RgbColour([0; 3]));
        draw_place_mark(&mut image, [10.0, 10.0], 6.0, PlaceMark::Disc);
        assert_eq!(image.image_pixel_at(10, 10), PLACE_MARK_COLOURS[0]);
    }
}
