//! Pictures of handshapes: a single hand, built from joint angles, and tables of many.

use std::sync::OnceLock;

use chereme_motion::{BodyAnatomy, BodySide, HandAngles, ModelPose, Skeleton, SkeletonJoint};
use glam::{DVec3, Vec3};

use crate::body::SignerBody;
use crate::camera::FigureCamera;
use crate::error::{FigureError, checked_size, checked_view};
use crate::font;
use crate::image::RasterImage;
use crate::palette::{FigurePalette, HandColours, PaperTheme, RgbColour};
use crate::raster::{FigureRaster, FigureStyle};

/// The direction of view onto a single hand; the fingers point up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HandView {
    /// Into the palm, somewhat from the thumb's side and from above: shows the fingers best.
    #[default]
    ThreeQuarter,
    /// Straight into the palm.
    Palm,
    /// Onto the back of the hand.
    Back,
    /// Onto the thumb's side.
    Thumb,
}

/// Options of the picture of a handshape.
#[derive(Debug, Clone, PartialEq)]
pub struct HandshapeOptions {
    /// The hand.
    pub side: BodySide,
    /// The direction of view.
    pub view: HandView,
    /// Width and height in pixels.
    pub size: usize,
    /// The colours of the hand.
    pub palette: FigurePalette,
    /// Whether the picture is cut close around the largest hand.
    pub tight: bool,
    /// Paper, light and lines.
    pub style: FigureStyle,
}

impl Default for HandshapeOptions {
    fn default() -> Self {
        Self {
            side: BodySide::Right,
            view: HandView::default(),
            size: 128,
            palette: FigurePalette::default(),
            tight: false,
            style: FigureStyle {
                samples: 3,
                step: 0.006,
                ..FigureStyle::default()
            },
        }
    }
}

impl HandshapeOptions {
    /// Returns options for a picture of `size` pixels that is to be read at that size: clear lines, many samples, a
    /// palm much lighter than the back, and a close crop.
    #[must_use]
    pub fn with_small_size(size: usize) -> Self {
        let hand = HandColours {
            palm: RgbColour::from_hex_colour(0xFD_E6_CC),
            back: RgbColour::from_hex_colour(0xB5_7C_4E),
            nail: RgbColour::from_hex_colour(0xFF_EE_E0),
        };
        Self {
            palette: FigurePalette {
                right: hand,
                left: hand,
                ..FigurePalette::default()
            },
            size,
            tight: true,
            style: FigureStyle {
                samples: 4,
                step: 0.006,
                line: 0.9,
                ..FigureStyle::default()
            },
            ..Self::default()
        }
    }
}

/// Draws a hand with the joint angles `angles`, always at the same scale.
///
/// # Errors
/// [`FigureError::Size`] if the picture would be too small or too large.
pub fn handshape_picture(angles: &HandAngles, options: &HandshapeOptions) -> Result<RasterImage, FigureError> {
    let size = checked_view(options.size, options.size)?;
    let mut artist = HandArtist::new(options);
    Ok(artist.draw_hand_angles(angles, size))
}

/// Space around a table's cells, in pixels.
const TABLE_CELL_GAP_PIXELS: usize = 8;

/// Draws many handshapes as a table, `columns` in a row, each above its name.
///
/// # Errors
/// [`FigureError`] if there are no shapes, or the table would be too large.
pub fn handshape_sheet(
    shapes: &[(String, HandAngles)],
    columns: usize,
    options: &HandshapeOptions,
) -> Result<RasterImage, FigureError> {
    if shapes.is_empty() || columns == 0 {
        return Err(FigureError::Nothing { what: "handshape" });
    }
    let mut artist = HandArtist::new(options);
    draw_cell_table(shapes, columns, options.size, options.style.theme, |angles, cell| {
        artist.draw_hand_angles(angles, cell)
    })
}

/// Draws named things as a table of square cells with this number of columns, cell size and paper.
pub(crate) fn draw_cell_table<T>(
    things: &[(String, T)],
    columns: usize,
    size: usize,
    theme: PaperTheme,
    mut draw: impl FnMut(&T, [usize; 2]) -> RasterImage,
) -> Result<RasterImage, FigureError> {
    let cell = checked_view(size, size)?;
    let columns = columns.clamp(1, things.len().max(1));
    let step = [
        cell[0] + TABLE_CELL_GAP_PIXELS,
        cell[1] + font::CELL_HEIGHT_DOTS + TABLE_CELL_GAP_PIXELS,
    ];
    let rows = things.len().div_ceil(columns);
    let size = checked_size(
        columns.saturating_mul(step[0]) + TABLE_CELL_GAP_PIXELS,
        rows.saturating_mul(step[1]) + TABLE_CELL_GAP_PIXELS,
    )?;
    let mut sheet = RasterImage::new(size[0], size[1], theme.theme_paper_colour());
    for (index, (name, thing)) in things.iter().enumerate() {
        let cell_place = [
            TABLE_CELL_GAP_PIXELS + index % columns * step[0],
            TABLE_CELL_GAP_PIXELS + index / columns * step[1],
        ];
        sheet.paste_image(&draw(thing, cell), cell_place);
        let label = font::fit_text_width(name, cell[0]);
        let inset = cell[0].saturating_sub(font::text_width_dots(&label)) / 2;
        let below = [(cell_place[0] + inset) as i64, (cell_place[1] + cell[1]) as i64];
        sheet.draw_image_text(&label, below, 1, theme.theme_text_colour());
    }
    Ok(sheet)
}

/// A hand that can be drawn in any posture.
struct HandArtist<'a> {
    hand: &'static HandFigure,
    body: SignerBody,
    raster: FigureRaster,
    options: &'a HandshapeOptions,
}

impl<'a> HandArtist<'a> {
    fn new(options: &'a HandshapeOptions) -> Self {
        let hand = HandFigure::hand_figure_of(options.side);
        Self {
            hand,
            body: SignerBody::with_single_hand(&hand.skeleton, &hand.anatomy, options.side, &options.palette),
            raster: FigureRaster::default(),
            options,
        }
    }

    fn draw_hand_angles(&mut self, angles: &HandAngles, size: [usize; 2]) -> RasterImage {
        let HandFigure { skeleton, anatomy } = self.hand;
        let mut pose = skeleton.rest_pose();
        anatomy.set_hand_angles(skeleton, self.options.side, angles, &mut pose);
        let mesh = self.body.posed_mesh(&ModelPose::from_local_pose(skeleton, &pose));
        let camera = hand_view_camera(self.options.view, self.options.side, self.options.tight);
        self.raster.draw_mesh_picture(&mesh, &camera, size, &self.options.style)
    }
}

/// Returns the camera of a view; the hand is at the origin, its palm towards +Z.
fn hand_view_camera(view: HandView, side: BodySide, tight: bool) -> FigureCamera {
    // With the palm towards +Z and fingers up, the thumb of a right hand is at +X.
    let thumb = -side.side_sign() as f32;
    let towards = match view {
        HandView::ThreeQuarter => Vec3::new(0.42 * thumb, 0.30, 1.0),
        HandView::Palm => Vec3::Z,
        HandView::Back => Vec3::NEG_Z,
        HandView::Thumb => Vec3::X * thumb,
    };
    // A spread thumb makes the hand reach farther on its side.
    let target = Vec3::new(0.012 * thumb, 0.083, 0.0);
    FigureCamera {
        eye: target + towards.normalize() * 0.9,
        target,
        up: Vec3::Y,
        half_height: if tight { 0.102 } else { 0.116 },
        near: 0.0,
    }
}

/// A skeleton of one hand, fingers up, palm towards +Z, its wrist at the origin.
struct HandFigure {
    skeleton: Skeleton,
    anatomy: BodyAnatomy,
}

/// A finger's name, its base across (towards the thumb) and along the hand, and the lengths of its
/// bones, in millimetres: an adult's hand of 19 cm, rounded.
const FINGER_MEASURES_MM: [(&str, [f64; 2], [f64; 3]); 4] = [
    ("Index", [30.0, 88.0], [43.0, 25.0, 22.0]),
    ("Middle", [9.5, 91.0], [47.0, 29.0, 23.0]),
    ("Ring", [-11.0, 86.0], [43.0, 27.0, 23.0]),
    ("Pinky", [-30.0, 78.0], [34.0, 20.0, 20.0]),
];

impl HandFigure {
    /// Returns the hand of a side; built once.
    fn hand_figure_of(side: BodySide) -> &'static Self {
        static HAND_FIGURES: [OnceLock<HandFigure>; 2] = [OnceLock::new(), OnceLock::new()];
        HAND_FIGURES[side as usize].get_or_init(|| Self::new(side))
    }

    fn new(side: BodySide) -> Self {
        let thumb = -side.side_sign();
        let name = match side {
            BodySide::Right => "Right",
            BodySide::Left => "Left",
        };
        let mut joints: Vec<SkeletonJoint> = Vec::new();
        let mut add = |part: &str, parent: Option<usize>, at: [f64; 3]| {
            let offset = DVec3::new(at[0] * thumb, at[1], at[2]) / 1000.0;
            joints.push(SkeletonJoint::new(format!("{name}{part}"), parent, offset));
            joints.len() - 1
        };
        // The forearm stands before the wrist, so that detection finds an arm.
        let forearm = add("ForeArm", None, [0.0, -250.0, 0.0]);
        let wrist = add("Hand", Some(forearm), [0.0, 250.0, 0.0]);
        let mut last = add("HandThumb1", Some(wrist), [23.0, 22.0, 8.0]);
        for (index, bone) in [[30.0, 33.0, 4.0], [19.0, 27.0, 1.0], [14.0, 22.0, 0.0]]
            .iter()
            .enumerate()
        {
            last = add(&format!("HandThumb{}", index + 2), Some(last), *bone);
        }
        for (finger, [across, along], bones) in FINGER_MEASURES_MM {
            let mut last = add(&format!("Hand{finger}1"), Some(wrist), [across, along, 0.0]);
            for (index, bone) in bones.into_iter().enumerate() {
                last = add(&format!("Hand{finger}{}", index + 2), Some(last), [0.0, bone, 0.0]);
            }
        }
        let skeleton = Skeleton::new(joints).expect("the joints of a hand are one tree");
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        Self { skeleton, anatomy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::BodyPart;
    use chereme_motion::HandFinger;

    #[test]
    fn every_part_of_the_built_in_hand_is_found() {
        for side in BodySide::BOTH_SIDES {
            let hand = HandFigure::hand_figure_of(side);
            for finger in HandFinger::ALL_FINGERS {
                for n in 1..4 {
                    assert!(hand.anatomy.part_joint(BodyPart::Finger(side, finger, n)).is_some());
                }
            }
            for n in 0..3 {
                assert!(hand.anatomy.part_joint(BodyPart::Thumb(side, n)).is_some());
            }
        }
    }

    #[test]
    fn a_fist_is_smaller_than_a_flat_hand_and_mirrors_to_the_other_side() {
        let covered = |image: &RasterImage| {
            let paper = image.image_pixel_at(0, 0);
            image.image_pixels().iter().filter(|&&pixel| pixel != paper).count()
        };
        let flat = HandAngles::default();
        let mut fist = flat;
        for finger in &mut fist.fingers {
            finger.flexion = [1.5; 3];
        }
        let mut options = HandshapeOptions {
            view: HandView::Palm,
            ..HandshapeOptions::default()
        };
        let right = handshape_picture(&flat, &options).expect("a picture");
        let closed = handshape_picture(&fist, &options).expect("a picture");
        assert!(covered(&closed) * 3 < covered(&right) * 2);
        options.side = BodySide::Left;
        let left = handshape_picture(&flat, &options).expect("a picture").mirror_image();
        let paper = left.image_pixel_at(0, 0);
        let pairs = left.image_pixels().iter().zip(right.image_pixels());
        let differ = pairs.filter(|(a, b)| (**a == paper) != (**b == paper)).count();
        assert!(differ * 50 < covered(&right), "{differ} pixels");
    }
}
