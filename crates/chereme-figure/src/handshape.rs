//! Pictures of handshapes: a single hand, built from joint angles, and tables of many.

use std::sync::OnceLock;

use chereme_motion::{Anatomy, HandAngles, Joint, ModelPose, Side, Skeleton};
use glam::{DVec3, Vec3};

use crate::body::Body;
use crate::camera::Camera;
use crate::error::{FigureError, checked_size, checked_view};
use crate::font;
use crate::image::Image;
use crate::palette::{Colour, HandColours, Palette, Theme};
use crate::raster::{Raster, Style};

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
    pub side: Side,
    /// The direction of view.
    pub view: HandView,
    /// Width and height in pixels.
    pub size: usize,
    /// The colours of the hand.
    pub palette: Palette,
    /// Whether the picture is cut close around the largest hand.
    pub tight: bool,
    /// Paper, light and lines.
    pub style: Style,
}

impl Default for HandshapeOptions {
    fn default() -> Self {
        Self {
            side: Side::Right,
            view: HandView::default(),
            size: 128,
            palette: Palette::default(),
            tight: false,
            style: Style {
                samples: 3,
                step: 0.006,
                ..Style::default()
            },
        }
    }
}

impl HandshapeOptions {
    /// Returns options for a picture of `size` pixels that is to be read at that size: clear lines, many samples, a
    /// palm much lighter than the back, and a close crop.
    #[must_use]
    pub fn small(size: usize) -> Self {
        let hand = HandColours {
            palm: Colour::hex(0xFD_E6_CC),
            back: Colour::hex(0xB5_7C_4E),
            nail: Colour::hex(0xFF_EE_E0),
        };
        Self {
            palette: Palette {
                right: hand,
                left: hand,
                ..Palette::default()
            },
            size,
            tight: true,
            style: Style {
                samples: 4,
                step: 0.006,
                line: 0.9,
                ..Style::default()
            },
            ..Self::default()
        }
    }
}

/// Draws a hand with the joint angles `angles`, always at the same scale.
///
/// # Errors
/// [`FigureError::Size`] if the picture would be too small or too large.
pub fn handshape_picture(
    angles: &HandAngles,
    options: &HandshapeOptions,
) -> Result<Image, FigureError> {
    let size = checked_view(options.size, options.size)?;
    let mut artist = Artist::new(options);
    Ok(artist.draw(angles, size))
}

/// Space around a table's cells, in pixels.
const GAP: usize = 8;

/// Draws many handshapes as a table, `columns` in a row, each above its name.
///
/// # Errors
/// [`FigureError`] if there are no shapes, or the table would be too large.
pub fn handshape_sheet(
    shapes: &[(String, HandAngles)],
    columns: usize,
    options: &HandshapeOptions,
) -> Result<Image, FigureError> {
    if shapes.is_empty() || columns == 0 {
        return Err(FigureError::Nothing { what: "handshape" });
    }
    let mut artist = Artist::new(options);
    let layout = (columns, options.size, options.style.theme);
    table(shapes, layout, |angles, cell| artist.draw(angles, cell))
}

/// Draws named things as a table of square cells with this number of columns, cell size and paper.
pub(crate) fn table<T>(
    things: &[(String, T)],
    (columns, size, theme): (usize, usize, Theme),
    mut draw: impl FnMut(&T, [usize; 2]) -> Image,
) -> Result<Image, FigureError> {
    let cell = checked_view(size, size)?;
    let columns = columns.clamp(1, things.len().max(1));
    let step = [cell[0] + GAP, cell[1] + font::HEIGHT + GAP];
    let rows = things.len().div_ceil(columns);
    let size = checked_size(
        columns.saturating_mul(step[0]) + GAP,
        rows.saturating_mul(step[1]) + GAP,
    )?;
    let mut sheet = Image::new(size[0], size[1], theme.background());
    for (index, (name, thing)) in things.iter().enumerate() {
        let at = [
            GAP + index % columns * step[0],
            GAP + index / columns * step[1],
        ];
        sheet.paste(&draw(thing, cell), at);
        let label = font::fitted(name, cell[0]);
        let inset = cell[0].saturating_sub(font::width(&label)) / 2;
        let below = [(at[0] + inset) as i64, (at[1] + cell[1]) as i64];
        sheet.text(&label, below, 1, theme.text());
    }
    Ok(sheet)
}

/// A hand that can be drawn in any posture.
struct Artist<'a> {
    hand: &'static Hand,
    body: Body,
    raster: Raster,
    options: &'a HandshapeOptions,
}

impl<'a> Artist<'a> {
    fn new(options: &'a HandshapeOptions) -> Self {
        let hand = Hand::of(options.side);
        Self {
            hand,
            body: Body::hand(
                &hand.skeleton,
                &hand.anatomy,
                options.side,
                &options.palette,
            ),
            raster: Raster::default(),
            options,
        }
    }

    fn draw(&mut self, angles: &HandAngles, size: [usize; 2]) -> Image {
        let Hand { skeleton, anatomy } = self.hand;
        let mut pose = skeleton.rest_pose();
        anatomy.set_hand_angles(skeleton, self.options.side, angles, &mut pose);
        let mesh = self.body.mesh(&ModelPose::of(skeleton, &pose));
        let camera = camera(self.options.view, self.options.side, self.options.tight);
        self.raster.draw(&mesh, &camera, size, &self.options.style)
    }
}

/// Returns the camera of a view; the hand is at the origin, its palm towards +Z.
fn camera(view: HandView, side: Side, tight: bool) -> Camera {
    let thumb = -side.sign() as f32;
    let towards = match view {
        HandView::ThreeQuarter => Vec3::new(0.42 * thumb, 0.30, 1.0),
        HandView::Palm => Vec3::Z,
        HandView::Back => Vec3::NEG_Z,
        HandView::Thumb => Vec3::X * thumb,
    };
    let target = Vec3::new(0.012 * thumb, 0.083, 0.0);
    Camera {
        eye: target + towards.normalize() * 0.9,
        target,
        up: Vec3::Y,
        half_height: if tight { 0.102 } else { 0.116 },
        near: 0.0,
    }
}

/// A skeleton of one hand, fingers up, palm towards +Z, its wrist at the origin.
struct Hand {
    skeleton: Skeleton,
    anatomy: Anatomy,
}

/// A finger's name, its base across (towards the thumb) and along the hand, and the lengths of its
/// bones, in millimetres: an adult's hand of 19 cm, rounded.
const FINGERS: [(&str, [f64; 2], [f64; 3]); 4] = [
    ("Index", [30.0, 88.0], [43.0, 25.0, 22.0]),
    ("Middle", [9.5, 91.0], [47.0, 29.0, 23.0]),
    ("Ring", [-11.0, 86.0], [43.0, 27.0, 23.0]),
    ("Pinky", [-30.0, 78.0], [34.0, 20.0, 20.0]),
];

impl Hand {
    /// Returns the hand of a side; built once.
    fn of(side: Side) -> &'static Self {
        static HANDS: [OnceLock<Hand>; 2] = [OnceLock::new(), OnceLock::new()];
        HANDS[side as usize].get_or_init(|| Self::new(side))
    }

    fn new(side: Side) -> Self {
        let thumb = -side.sign();
        let name = match side {
            Side::Right => "Right",
            Side::Left => "Left",
        };
        let mut joints: Vec<Joint> = Vec::new();
        let mut add = |part: &str, parent: Option<usize>, at: [f64; 3]| {
            let offset = DVec3::new(at[0] * thumb, at[1], at[2]) / 1000.0;
            joints.push(Joint::new(format!("{name}{part}"), parent, offset));
            joints.len() - 1
        };
        let forearm = add("ForeArm", None, [0.0, -250.0, 0.0]);
        let wrist = add("Hand", Some(forearm), [0.0, 250.0, 0.0]);
        let mut last = add("HandThumb1", Some(wrist), [23.0, 22.0, 8.0]);
        for (index, bone) in [[30.0, 33.0, 4.0], [19.0, 27.0, 1.0], [14.0, 22.0, 0.0]]
            .iter()
            .enumerate()
        {
            last = add(&format!("HandThumb{}", index + 2), Some(last), *bone);
        }
        for (finger, [across, along], bones) in FINGERS {
            let mut last = add(&format!("Hand{finger}1"), Some(wrist), [across, along, 0.0]);
            for (index, bone) in bones.into_iter().enumerate() {
                last = add(
                    &format!("Hand{finger}{}", index + 2),
                    Some(last),
                    [0.0, bone, 0.0],
                );
            }
        }
        let skeleton = Skeleton::new(joints).expect("the joints of a hand are one tree");
        let anatomy = Anatomy::detect(&skeleton);
        Self { skeleton, anatomy }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::Finger;
    use chereme_motion::Part;

    #[test]
    fn every_part_of_the_built_in_hand_is_found() {
        for side in Side::BOTH {
            let hand = Hand::of(side);
            for finger in Finger::ALL {
                for n in 1..4 {
                    assert!(hand.anatomy.joint(Part::Finger(side, finger, n)).is_some());
                }
            }
            for n in 0..3 {
                assert!(hand.anatomy.joint(Part::Thumb(side, n)).is_some());
            }
        }
    }

    #[test]
    fn a_fist_is_smaller_than_a_flat_hand_and_mirrors_to_the_other_side() {
        let covered = |image: &Image| {
            let paper = image.pixel(0, 0);
            image
                .pixels()
                .iter()
                .filter(|&&pixel| pixel != paper)
                .count()
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
        options.side = Side::Left;
        let left = handshape_picture(&flat, &options)
            .expect("a picture")
            .mirrored();
        let paper = left.pixel(0, 0);
        let pairs = left.pixels().iter().zip(right.pixels());
        let differ = pairs
            .filter(|(a, b)| (**a == paper) != (**b == paper))
            .count();
        assert!(differ * 50 < covered(&right), "{differ} pixels");
    }
}
