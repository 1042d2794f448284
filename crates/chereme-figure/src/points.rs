//! Named points as dots and limbs: optical markers, and points estimated from film.

use std::borrow::Borrow;

use chereme_motion::{Capture, Markers, Quality, Space};
use glam::Vec3;

use crate::body::group::FLAT;
use crate::camera::Camera;
use crate::error::{FigureError, checked_size, checked_view};
use crate::font;
use crate::image::Image;
use crate::mesh::{Mesh, Vertex, trail};
use crate::palette::{Colour, Palette, Theme};
use crate::raster::{Raster, Style};
use crate::sheet::Progress;
use crate::view::View;

/// The number of frames that are sampled to find the space of the points.
const LOOKS: usize = 200;
/// The share of positions at either end of an axis that may be outliers.
const OUTLIERS: f32 = 0.01;
/// A dot's radius as a share of the height of the points' space; in groups with many points a smaller share.
const DOT: f32 = 0.009;
const SMALL_DOT: f32 = 0.0035;
/// The largest number of points in a group whose dots have the full size.
const MANY: usize = 60;
/// The confidence below which a point is drawn faintly.
const UNSURE: f64 = 0.3;
/// The eye's distance relative to half the height of the visible area.
const DISTANCE: f32 = 7.0;
/// The height of a line of small text, in pixels.
const LABEL: usize = 18;
/// The space between pictures, in pixels.
const GAP: usize = 6;

/// The dots and limbs of a track of points, with their space; it holds the points or a reference to them.
#[derive(Debug, Clone)]
pub struct PointCloud<M> {
    markers: M,
    low: Vec3,
    high: Vec3,
    colours: Vec<Colour>,
    radii: Vec<f32>,
    theme: Theme,
}

impl<M: Borrow<Markers>> PointCloud<M> {
    /// Returns the cloud of a track's points; `None` if no frame has any.
    #[must_use]
    pub fn of(held: M, theme: Theme) -> Option<Self> {
        let markers = held.borrow();
        let frames = markers.frames();
        let step = frames.div_ceil(LOOKS).max(1);
        let mut axes: [Vec<f32>; 3] = Default::default();
        for frame in (0..frames).step_by(step) {
            for point in 0..markers.points().len() {
                if let Some(at) = place(markers, point, frame) {
                    for (axis, values) in axes.iter_mut().enumerate() {
                        values.push(at[axis]);
                    }
                }
            }
        }
        let mut ends = axes.map(|mut values| {
            values.sort_by(f32::total_cmp);
            let out = (values.len() as f32 * OUTLIERS) as usize;
            let last = values.len().checked_sub(1 + out)?;
            Some((values[out], values[last]))
        });
        let mut end = |axis: usize| ends[axis].take();
        let (x, y, z) = (end(0)?, end(1)?, end(2)?);
        let (low, high) = (Vec3::new(x.0, y.0, z.0), Vec3::new(x.1, y.1, z.1));
        let height = (high - low).max_element().max(1e-3);
        let palette = Palette::default();
        let points = markers.points();
        let groups = |group: &str| points.iter().filter(|it| it.group == group).count();
        let (colours, radii) = (
            points
                .iter()
                .map(|point| colour(&palette, theme, &point.group, &point.name))
                .collect(),
            points
                .iter()
                .map(
                    |point| match groups(&point.group) > MANY && !point.group.is_empty() {
                        true => SMALL_DOT * height,
                        false => DOT * height,
                    },
                )
                .collect(),
        );
        Some(Self {
            low: low - Vec3::splat(height * 0.04),
            high: high + Vec3::splat(height * 0.04),
            colours,
            radii,
            markers: held,
            theme,
        })
    }

    /// Returns the points.
    #[must_use]
    pub fn markers(&self) -> &Markers {
        self.markers.borrow()
    }

    /// Returns whether the points have no depth, so that only the view from the front shows them.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        !matches!(self.markers.borrow().space(), Space::World(_))
    }

    /// Returns the dots and limbs of a frame; points without a position in it are left out.
    #[must_use]
    pub fn mesh(&self, frame: usize) -> Mesh {
        let mut mesh = Mesh::default();
        let markers = self.markers.borrow();
        let points = markers.points();
        let places: Vec<Option<Vec3>> = (0..points.len())
            .map(|point| place(markers, point, frame))
            .collect();
        let shade = |point: usize| {
            let quality = points[point].quality.as_ref();
            let unsure = markers.quality() == Some(Quality::Confidence)
                && quality
                    .and_then(|column| column.value(frame))
                    .is_some_and(|value| value < UNSURE);
            if unsure {
                self.colours[point].mixed(self.theme.background(), 0.6)
            } else {
                self.colours[point]
            }
        };
        for &[from, to] in markers.limbs() {
            if let (Some(a), Some(b)) = (places[from], places[to]) {
                let radius = self.radii[from].min(self.radii[to]) * 0.35;
                mesh.append(&trail(&[a, b], radius, [shade(from), shade(to)], FLAT));
            }
        }
        for (point, at) in places.iter().enumerate() {
            if let Some(at) = at {
                dot(&mut mesh, *at, self.radii[point], shade(point));
            }
        }
        mesh
    }

    /// Returns the camera of a view for a picture whose width is `aspect` times its height.
    #[must_use]
    pub fn camera(&self, view: View, aspect: f32) -> Camera {
        let (towards, up) = match view {
            View::Left => (Vec3::X, Vec3::Y),
            View::Right => (Vec3::NEG_X, Vec3::Y),
            View::Top => (Vec3::Y, Vec3::Z),
            View::Signer => (Vec3::new(0.0, 0.62, -0.78), Vec3::Y),
            View::Addressee | View::Hand(_) | View::Palm(_) | View::Face => (Vec3::Z, Vec3::Y),
        };
        let half = (self.high - self.low) * 0.5;
        let right = up.cross(towards).normalize_or(Vec3::X);
        let tall = half.dot(right.cross(towards).abs());
        let wide = half.dot(right.abs());
        let deep = half.dot(towards.abs());
        let half_height = tall.max(wide / aspect.max(1e-3)) * 1.02 + deep / DISTANCE * 0.5;
        let target = (self.low + self.high) * 0.5;
        Camera {
            eye: target + towards.normalize_or(Vec3::Z) * (half_height * DISTANCE),
            target,
            up,
            half_height,
            near: 0.0,
        }
    }

    /// Returns the ratio of width to height of a view's visible area.
    pub(crate) fn aspect(&self, view: View) -> f32 {
        let size = self.high - self.low;
        let wide = if matches!(view, View::Left | View::Right) {
            size.z
        } else {
            size.x
        };
        (wide / size.y.max(1e-6)).clamp(0.45, 1.6)
    }

    /// Returns a note for points that were not measured by cameras in a room.
    #[must_use]
    pub fn note(&self) -> Option<&'static str> {
        let estimated = self.markers.borrow().capture() == Capture::Estimated;
        match (estimated, self.markers.borrow().space()) {
            // Landmarks of film, or hidden markers that a model restored.
            (true, Space::World(_)) => Some("estimated"),
            (true, Space::Depth(_)) => Some("estimated from film, depth is a guess"),
            (true, Space::Image(_)) => Some("estimated from film, no depth"),
            (false, Space::World(_)) => None,
            (false, _) => Some("no depth"),
        }
    }
}

fn place(markers: &Markers, point: usize, frame: usize) -> Option<Vec3> {
    let at = markers
        .space()
        .shown(markers.points()[point].at(frame)?)
        .as_vec3();
    at.is_finite().then_some(at)
}

/// Returns the colour of a point: a hand's for points of a hand, by group or name; else that of the face or of text.
fn colour(palette: &Palette, theme: Theme, group: &str, name: &str) -> Colour {
    let upper = group.to_ascii_uppercase();
    let hand = upper.contains("HAND");
    let is = |side: &str| hand && upper.contains(side);
    let bare = name.rsplit(':').next().unwrap_or(name);
    if is("RIGHT") {
        palette.right.back.scaled(0.8)
    } else if is("LEFT") {
        palette.left.back.scaled(0.8)
    } else if upper.contains("FACE") {
        palette.mouth
    } else if bare.starts_with(['R', 'r']) && !bare.to_ascii_lowercase().starts_with("left") {
        palette.right.back.scaled(0.7)
    } else if bare.starts_with(['L', 'l']) {
        palette.left.back.scaled(0.7)
    } else {
        theme.text().mixed(theme.background(), 0.3)
    }
}

/// Adds an octahedron.
fn dot(mesh: &mut Mesh, at: Vec3, radius: f32, colour: Colour) {
    let base = mesh.vertices.len() as u32;
    let axes = [
        Vec3::X,
        Vec3::NEG_X,
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::NEG_Z,
    ];
    mesh.vertices.extend(axes.map(|normal| Vertex {
        position: at + normal * radius,
        normal,
        colour,
        group: FLAT,
    }));
    for x in [0, 1] {
        for y in [2, 3] {
            for z in [4, 5] {
                let even = (x + y + z) % 2 == 0;
                let corners = if even { [x, y, z] } else { [y, x, z] };
                mesh.triangles.push(corners.map(|corner| base + corner));
            }
        }
    }
}

/// Draws a contact sheet of points: `frames` pictures side by side, from the front and, if the points are in a room,
/// from the right; a line below the title says that they are estimated or have no depth.
///
/// # Errors
/// [`FigureError`] if no frame has a point, the sheet would be too large, or `progress` stops it.
pub fn points_sheet(
    markers: &Markers,
    title: &str,
    [frames, cell_height]: [usize; 2],
    style: &Style,
    progress: Progress<'_>,
) -> Result<Image, FigureError> {
    let cloud = PointCloud::of(markers, style.theme).ok_or(FigureError::Empty)?;
    let views = match cloud.is_flat() {
        true => vec![View::Addressee],
        false => vec![View::Addressee, View::Right],
    };
    let aspect = views.iter().map(|&view| cloud.aspect(view));
    let aspect = aspect.fold(0.45, f32::max);
    let cell = checked_view((cell_height as f32 * aspect) as usize, cell_height)?;
    let count = frames.clamp(1, markers.frames().max(1));
    let last = markers.frames().saturating_sub(1);
    let head = 2 * font::HEIGHT + 2 * GAP + LABEL;
    let size = checked_size(
        count.saturating_mul(cell[0] + GAP) + GAP,
        views.len() * (cell[1] + GAP) + head + LABEL,
    )?;
    let theme = style.theme;
    let mut sheet = Image::new(size[0], size[1], theme.rule());
    sheet.fill([0, 0], [size[0] as i64, head as i64], theme.background());
    let fitted = font::fitted(title, (size[0] - 2 * GAP) / 2);
    sheet.text(&fitted, [GAP as i64, GAP as i64], 2, theme.text());
    if let Some(note) = cloud.note() {
        let note = font::fitted(note, size[0] - 2 * GAP);
        let at = [GAP as i64, (2 * font::HEIGHT + GAP + 4) as i64];
        sheet.text(&note, at, 1, theme.text());
    }
    let mut raster = Raster::default();
    for column in 0..count {
        let frame = last * column / (count - 1).max(1);
        let mesh = cloud.mesh(frame);
        let x = GAP + column * (cell[0] + GAP);
        for (row, &view) in views.iter().enumerate() {
            let done = column * views.len() + row;
            let total = count * views.len();
            if progress(done, total).is_break() {
                return Err(FigureError::Stopped { done, total });
            }
            let camera = cloud.camera(view, cell[0] as f32 / cell[1] as f32);
            let mut picture = raster.draw(&mesh, &camera, cell, style);
            if column == 0 {
                let chip = [font::width(view.name()) as i64 + 8, font::HEIGHT as i64 + 3];
                picture.fill([0, 0], chip, theme.background());
                picture.text(view.name(), [4, 0], 1, theme.text());
            }
            sheet.paste(&picture, [x, head + row * (cell[1] + GAP)]);
        }
        let seconds = markers.times().instant(frame).seconds();
        let label = font::fitted(&format!("{seconds:.2} s  #{frame}"), cell[0]);
        let y = head + views.len() * (cell[1] + GAP);
        let inset = (cell[0] - font::width(&label).min(cell[0])) / 2;
        sheet.text(&label, [(x + inset) as i64, y as i64], 1, theme.text());
    }
    Ok(sheet)
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use chereme_motion::markers::Frame;
    use chereme_motion::{Column, Convention, Marker, Rate, Times};

    use super::*;

    fn film() -> Markers {
        let point = |name: &str, x: f64, y: f64| {
            let column = |value: f64| Column::doubles(vec![value, value + 1.0, f64::NAN]);
            Marker {
                quality: Some(Column::doubles(vec![0.9, 0.1, 0.0])),
                group: "RIGHT_HAND_LANDMARKS".into(),
                ..Marker::new(name, vec![column(x), column(y)])
            }
        };
        let space = Space::Image(Frame {
            width: 100.0,
            height: 100.0,
        });
        let times = Times::Even(Rate::new(25, 1).expect("a rate"));
        let points = vec![point("WRIST", 20.0, 80.0), point("TIP", 60.0, 20.0)];
        Markers::new(times, space, points)
            .and_then(|markers| markers.joined(vec![[0, 1]]))
            .expect("two points")
            .captured(Capture::Estimated)
            .rated(Quality::Confidence)
    }

    #[test]
    fn points_and_limbs_have_their_film_positions_and_gaps_are_left_out() {
        let markers = film();
        let cloud = PointCloud::of(&markers, Theme::Light).expect("points");
        assert_eq!(cloud.note(), Some("estimated from film, no depth"));
        let at = [0.1, 1.2, 0.3].map(|value| Column::doubles(vec![value; 3]));
        let tip = Marker::new("TIP", at.to_vec());
        let room = Space::World(Convention::MODEL);
        let restored = Markers::new(markers.times().clone(), room, vec![tip]);
        let restored = restored.expect("markers").captured(Capture::Estimated);
        let solved = PointCloud::of(&restored, Theme::Light).expect("points");
        assert_eq!(solved.note(), Some("estimated"), "of no film");
        let (low, high) = cloud.mesh(0).bounds().expect("dots");
        // A picture stands upright, two metres high: 80 of 100 pixels down is 0.4 m up.
        assert!((low.y - 0.4).abs() < 0.03 && (high.y - 1.6).abs() < 0.03);
        assert!((low.x + 0.6).abs() < 0.03 && (high.x - 0.2).abs() < 0.03);
        let faint = cloud.mesh(1).vertices.last().map(|it| it.colour);
        assert_ne!(faint, cloud.mesh(0).vertices.last().map(|it| it.colour));
    }

    #[test]
    fn a_sheet_of_points_has_ink_in_every_frame_with_points() {
        let mut go = |_, _| ControlFlow::Continue(());
        let sheet = points_sheet(&film(), "film", [2, 120], &Style::default(), &mut go);
        let sheet = sheet.expect("a sheet");
        let paper = Theme::Light.background();
        let half = sheet.width() / 2;
        for columns in [0..half, half..sheet.width()] {
            let ink = columns
                .flat_map(|x| (70..sheet.height() - LABEL).map(move |y| (x, y)))
                .filter(|&(x, y)| sheet.pixel(x, y) != paper)
                .count();
            assert!(ink > 50, "{ink}");
        }
        let empty = Times::Even(Rate::new(25, 1).expect("a rate"));
        let world = Space::World(chereme_motion::Convention::MODEL);
        let gap = || Column::doubles(vec![f64::NAN]);
        let gone = Marker::new("C7", vec![gap(), gap(), gap()]);
        let gone = Markers::new(empty, world, vec![gone]).expect("a track");
        assert!(PointCloud::of(&gone, Theme::Light).is_none());
    }
}
