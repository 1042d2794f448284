//! Named points as dots and limbs: optical markers, and points estimated from film.

use std::borrow::Borrow;

use chereme_motion::{CaptureMethod, MarkerSpace, MarkerTrack, QualityMeaning};
use glam::Vec3;

use crate::body::group::FIRST_FLAT_GROUP;
use crate::camera::FigureCamera;
use crate::error::{FigureError, checked_size, checked_view};
use crate::font;
use crate::image::RasterImage;
use crate::mesh::{MeshVertex, TriangleMesh, trail_mesh};
use crate::palette::{FigurePalette, PaperTheme, RgbColour};
use crate::raster::{FigureRaster, FigureStyle};
use crate::sheet::{PictureProgress, draw_column_label, draw_view_name};
use crate::view::FigureView;

/// The number of frames that are sampled to find the space of the points.
const SAMPLED_CLOUD_FRAMES: usize = 200;
/// The share of positions at either end of an axis that may be outliers.
const OUTLIER_SHARE: f32 = 0.01;
/// A dot's radius as a share of the height of the points' space; in groups with many points a smaller share.
const DOT_RADIUS_SHARE: f32 = 0.009;
const SMALL_DOT: f32 = 0.0035;
/// The largest number of points in a group whose dots have the full size.
const MAX_FULL_SIZE_DOTS: usize = 60;
/// The confidence below which a point is drawn faintly.
const UNSURE_POINT_CONFIDENCE: f64 = 0.3;
/// The eye's distance relative to half the height of the visible area.
const CLOUD_EYE_DISTANCE: f32 = 7.0;
/// The height of a line of small text, in pixels.
const CLOUD_LABEL_HEIGHT_PIXELS: usize = 18;
/// The space between pictures, in pixels.
const CLOUD_PICTURE_GAP_PIXELS: usize = 6;

/// The dots and limbs of a track of points, with their space; it holds the points or a reference to them.
#[derive(Debug, Clone)]
pub struct PointCloud<M> {
    markers: M,
    low: Vec3,
    high: Vec3,
    colours: Vec<RgbColour>,
    radii: Vec<f32>,
    theme: PaperTheme,
}

impl<M: Borrow<MarkerTrack>> PointCloud<M> {
    /// Returns the cloud of a track's points; `None` if no frame has any.
    #[must_use]
    pub fn cloud_from_markers(held: M, theme: PaperTheme) -> Option<Self> {
        let markers = held.borrow();
        let frames = markers.marker_frame_count();
        // Every frame of a long recording would take long and show no other space.
        let step = frames.div_ceil(SAMPLED_CLOUD_FRAMES).max(1);
        let mut axes: [Vec<f32>; 3] = Default::default();
        for frame in (0..frames).step_by(step) {
            for point in 0..markers.marker_points().len() {
                if let Some(at) = cloud_point_position(markers, point, frame) {
                    for (axis, values) in axes.iter_mut().enumerate() {
                        values.push(at[axis]);
                    }
                }
            }
        }
        let mut ends = axes.map(|mut values| {
            values.sort_by(f32::total_cmp);
            // A hundredth at either end is left out: a lost marker may be metres away.
            let out = (values.len() as f32 * OUTLIER_SHARE) as usize;
            let last = values.len().checked_sub(1 + out)?;
            Some((values[out], values[last]))
        });
        let mut end = |axis: usize| ends[axis].take();
        let (x, y, z) = (end(0)?, end(1)?, end(2)?);
        let (low, high) = (Vec3::new(x.0, y.0, z.0), Vec3::new(x.1, y.1, z.1));
        // Points in one place still have a space with a size.
        let height = (high - low).max_element().max(1e-3);
        let palette = FigurePalette::default();
        let points = markers.marker_points();
        let groups = |group: &str| points.iter().filter(|marker| marker.group == group).count();
        let (colours, radii) = (
            points
                .iter()
                .map(|point| cloud_point_colour(&palette, theme, &point.group, &point.name))
                .collect(),
            points
                .iter()
                .map(
                    // Hundreds of points, as in a face, would cover each other at full size.
                    |point| match groups(&point.group) > MAX_FULL_SIZE_DOTS && !point.group.is_empty() {
                        true => SMALL_DOT * height,
                        false => DOT_RADIUS_SHARE * height,
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

    /// Returns whether the points have no depth, so that only the view from the front shows them.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        !matches!(self.markers.borrow().marker_space(), MarkerSpace::World(_))
    }

    /// Returns the dots and limbs of a frame; points without a position in it are left out.
    #[must_use]
    pub fn cloud_frame_mesh(&self, frame: usize) -> TriangleMesh {
        let mut mesh = TriangleMesh::default();
        let markers = self.markers.borrow();
        let points = markers.marker_points();
        let places: Vec<Option<Vec3>> = (0..points.len())
            .map(|point| cloud_point_position(markers, point, frame))
            .collect();
        // Doubtful points fade into the paper instead of vanishing.
        let shade = |point: usize| {
            let quality = points[point].quality.as_ref();
            let unsure = markers.marker_quality() == Some(QualityMeaning::Confidence)
                && quality
                    .and_then(|column| column.column_value_at(frame))
                    .is_some_and(|value| value < UNSURE_POINT_CONFIDENCE);
            if unsure {
                self.colours[point].mix_colour(self.theme.theme_paper_colour(), 0.6)
            } else {
                self.colours[point]
            }
        };
        for &[from, to] in markers.marker_limbs() {
            if let (Some(a), Some(b)) = (places[from], places[to]) {
                // A limb is thinner than its smaller dot, which stays visible at its end.
                let radius = self.radii[from].min(self.radii[to]) * 0.35;
                mesh.append_mesh(&trail_mesh(&[a, b], radius, [shade(from), shade(to)], FIRST_FLAT_GROUP));
            }
        }
        for (point, at) in places.iter().enumerate() {
            if let Some(at) = at {
                add_octahedron_dot(&mut mesh, *at, self.radii[point], shade(point));
            }
        }
        mesh
    }

    /// Returns the camera of a view for a picture whose width is `aspect` times its height.
    #[must_use]
    pub fn cloud_camera(&self, view: FigureView, aspect: f32) -> FigureCamera {
        let (towards, up) = match view {
            FigureView::Left => (Vec3::X, Vec3::Y),
            FigureView::Right => (Vec3::NEG_X, Vec3::Y),
            FigureView::Top => (Vec3::Y, Vec3::Z),
            FigureView::Signer => (Vec3::new(0.0, 0.62, -0.78), Vec3::Y),
            FigureView::Addressee | FigureView::Hand(_) | FigureView::Palm(_) | FigureView::Face => (Vec3::Z, Vec3::Y),
        };
        let half = (self.high - self.low) * 0.5;
        let right = up.cross(towards).normalize_or(Vec3::X);
        let tall = half.dot(right.cross(towards).abs());
        let wide = half.dot(right.abs());
        let deep = half.dot(towards.abs());
        let half_height = tall.max(wide / aspect.max(1e-3)) * 1.02 + deep / CLOUD_EYE_DISTANCE * 0.5;
        let target = (self.low + self.high) * 0.5;
        FigureCamera {
            eye: target + towards.normalize_or(Vec3::Z) * (half_height * CLOUD_EYE_DISTANCE),
            target,
            up,
            half_height,
            near: 0.0,
        }
    }

    /// Returns the ratio of width to height of a view's visible area.
    pub(crate) fn cloud_view_aspect(&self, view: FigureView) -> f32 {
        let size = self.high - self.low;
        let wide = if matches!(view, FigureView::Left | FigureView::Right) {
            size.z
        } else {
            size.x
        };
        (wide / size.y.max(1e-6)).clamp(0.45, 1.6)
    }

    /// Returns a note for points that were not measured by cameras in a room.
    #[must_use]
    pub fn cloud_measurement_note(&self) -> Option<&'static str> {
        let estimated = self.markers.borrow().marker_capture() == CaptureMethod::Estimated;
        match (estimated, self.markers.borrow().marker_space()) {
            // Landmarks of film, or hidden markers that a model restored.
            (true, MarkerSpace::World(_)) => Some("estimated"),
            (true, MarkerSpace::Depth(_)) => Some("estimated from film, depth is a guess"),
            (true, MarkerSpace::Image(_)) => Some("estimated from film, no depth"),
            (false, MarkerSpace::World(_)) => None,
            (false, _) => Some("no depth"),
        }
    }
}

fn cloud_point_position(markers: &MarkerTrack, point: usize, frame: usize) -> Option<Vec3> {
    let shown_place = markers
        .marker_space()
        .displayed_position(markers.marker_points()[point].marker_position(frame)?)
        .as_vec3();
    shown_place.is_finite().then_some(shown_place)
}

/// Returns the colour of a point: a hand's for points of a hand, by group or name; else that of the face or of text.
fn cloud_point_colour(palette: &FigurePalette, theme: PaperTheme, group: &str, name: &str) -> RgbColour {
    let upper = group.to_ascii_uppercase();
    let hand = upper.contains("HAND");
    let is = |side: &str| hand && upper.contains(side);
    // Labels have the subject before a colon: the side is named after it.
    let bare = name.rsplit(':').next().unwrap_or(name);
    if is("RIGHT") {
        palette.right.back.scale_colour(0.8)
    } else if is("LEFT") {
        palette.left.back.scale_colour(0.8)
    } else if upper.contains("FACE") {
        palette.mouth
    } else if bare.starts_with(['R', 'r']) {
        palette.right.back.scale_colour(0.7)
    } else if bare.starts_with(['L', 'l']) {
        palette.left.back.scale_colour(0.7)
    } else {
        theme.theme_text_colour().mix_colour(theme.theme_paper_colour(), 0.3)
    }
}

/// Adds an octahedron.
fn add_octahedron_dot(mesh: &mut TriangleMesh, at: Vec3, radius: f32, colour: RgbColour) {
    let base = mesh.vertices.len() as u32;
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    mesh.vertices.extend(axes.map(|normal| MeshVertex {
        position: at + normal * radius,
        normal,
        colour,
        group: FIRST_FLAT_GROUP,
    }));
    for x in [0, 1] {
        for y in [2, 3] {
            for z in [4, 5] {
                // Every second octant is mirrored, so its corners turn the other way.
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
    markers: &MarkerTrack,
    title: &str,
    [frames, cell_height]: [usize; 2],
    style: &FigureStyle,
    progress: PictureProgress<'_>,
) -> Result<RasterImage, FigureError> {
    let cloud = PointCloud::cloud_from_markers(markers, style.theme).ok_or(FigureError::Empty)?;
    let views = match cloud.is_flat() {
        true => vec![FigureView::Addressee],
        false => vec![FigureView::Addressee, FigureView::Right],
    };
    let aspects = views.iter().map(|&view| cloud.cloud_view_aspect(view));
    let aspect = aspects.fold(0.45, f32::max);
    let cell = checked_view((cell_height as f32 * aspect) as usize, cell_height)?;
    let count = frames.clamp(1, markers.marker_frame_count().max(1));
    let last = markers.marker_frame_count().saturating_sub(1);
    let head = 2 * font::CELL_HEIGHT_DOTS + 2 * CLOUD_PICTURE_GAP_PIXELS + CLOUD_LABEL_HEIGHT_PIXELS;
    let size = checked_size(
        count.saturating_mul(cell[0] + CLOUD_PICTURE_GAP_PIXELS) + CLOUD_PICTURE_GAP_PIXELS,
        views.len() * (cell[1] + CLOUD_PICTURE_GAP_PIXELS) + head + CLOUD_LABEL_HEIGHT_PIXELS,
    )?;
    let theme = style.theme;
    let mut sheet = RasterImage::new(size[0], size[1], theme.rule_colour());
    sheet.fill_image_rectangle([0, 0], [size[0] as i64, head as i64], theme.theme_paper_colour());
    let fitted = font::fit_text_width(title, (size[0] - 2 * CLOUD_PICTURE_GAP_PIXELS) / 2);
    sheet.draw_image_text(
        &fitted,
        [CLOUD_PICTURE_GAP_PIXELS as i64, CLOUD_PICTURE_GAP_PIXELS as i64],
        2,
        theme.theme_text_colour(),
    );
    if let Some(note) = cloud.cloud_measurement_note() {
        let note = font::fit_text_width(note, size[0] - 2 * CLOUD_PICTURE_GAP_PIXELS);
        let note_place = [
            CLOUD_PICTURE_GAP_PIXELS as i64,
            (2 * font::CELL_HEIGHT_DOTS + CLOUD_PICTURE_GAP_PIXELS + 4) as i64,
        ];
        sheet.draw_image_text(&note, note_place, 1, theme.theme_text_colour());
    }
    let mut raster = FigureRaster::default();
    for column in 0..count {
        // The first and the last frame are always shown.
        let frame = last * column / (count - 1).max(1);
        let mesh = cloud.cloud_frame_mesh(frame);
        let x = CLOUD_PICTURE_GAP_PIXELS + column * (cell[0] + CLOUD_PICTURE_GAP_PIXELS);
        for (row, &view) in views.iter().enumerate() {
            let done = column * views.len() + row;
            let total = count * views.len();
            if progress(done, total).is_break() {
                return Err(FigureError::Stopped { done, total });
            }
            let camera = cloud.cloud_camera(view, cell[0] as f32 / cell[1] as f32);
            let mut picture = raster.draw_mesh_picture(&mesh, &camera, cell, style);
            // One name for each row is enough.
            if column == 0 {
                draw_view_name(&mut picture, view, theme);
            }
            sheet.paste_image(&picture, [x, head + row * (cell[1] + CLOUD_PICTURE_GAP_PIXELS)]);
        }
        let seconds = markers.marker_times().frame_time_instant(frame).instant_seconds();
        let y = head + views.len() * (cell[1] + CLOUD_PICTURE_GAP_PIXELS);
        draw_column_label(&mut sheet, &format!("{seconds:.2} s  #{frame}"), [x, y], cell[0], theme);
    }
    Ok(sheet)
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use chereme_motion::markers::PointPictureSize;
    use chereme_motion::{FrameNumberColumn, FrameRate, FrameTimes, MotionMarker, SpaceConvention};

    use super::*;

    fn film() -> MarkerTrack {
        let point = |name: &str, x: f64, y: f64| {
            let column = |value: f64| FrameNumberColumn::from_double_floats(vec![value, value + 1.0, f64::NAN]);
            MotionMarker {
                quality: Some(FrameNumberColumn::from_double_floats(vec![0.9, 0.1, 0.0])),
                group: "RIGHT_HAND_LANDMARKS".into(),
                ..MotionMarker::new(name, vec![column(x), column(y)])
            }
        };
        let space = MarkerSpace::Image(PointPictureSize {
            width: 100.0,
            height: 100.0,
        });
        let times = FrameTimes::Even(FrameRate::new(25, 1).expect("a rate"));
        let points = vec![point("WRIST", 20.0, 80.0), point("TIP", 60.0, 20.0)];
        MarkerTrack::new(times, space, points)
            .and_then(|markers| markers.with_marker_limbs(vec![[0, 1]]))
            .expect("two points")
            .with_capture_method(CaptureMethod::Estimated)
            .with_quality_meaning(QualityMeaning::Confidence)
    }

    #[test]
    fn points_and_limbs_have_their_film_positions_and_gaps_are_left_out() {
        let markers = film();
        let cloud = PointCloud::cloud_from_markers(&markers, PaperTheme::Light).expect("points");
        assert_eq!(cloud.cloud_measurement_note(), Some("estimated from film, no depth"));
        let at = [0.1, 1.2, 0.3].map(|value| FrameNumberColumn::from_double_floats(vec![value; 3]));
        let tip = MotionMarker::new("TIP", at.to_vec());
        let room = MarkerSpace::World(SpaceConvention::MODEL_CONVENTION);
        let restored = MarkerTrack::new(markers.marker_times().clone(), room, vec![tip]);
        let restored = restored.expect("markers").with_capture_method(CaptureMethod::Estimated);
        let solved = PointCloud::cloud_from_markers(&restored, PaperTheme::Light).expect("points");
        assert_eq!(solved.cloud_measurement_note(), Some("estimated"), "of no film");
        let dots = cloud.cloud_frame_mesh(0);
        let places = dots.vertices.iter().map(|vertex| vertex.position);
        let (low, high) = places.fold((Vec3::MAX, Vec3::MIN), |(low, high), at| (low.min(at), high.max(at)));
        // A picture stands upright, two metres high: 80 of 100 pixels down is 0.4 m up.
        assert!((low.y - 0.4).abs() < 0.03 && (high.y - 1.6).abs() < 0.03);
        assert!((low.x + 0.6).abs() < 0.03 && (high.x - 0.2).abs() < 0.03);
        let faint = cloud.cloud_frame_mesh(1).vertices.last().map(|it| it.colour);
        assert_ne!(faint, cloud.cloud_frame_mesh(0).vertices.last().map(|it| it.colour));
    }

    #[test]
    fn a_sheet_of_points_has_ink_in_every_frame_with_points() {
        let mut go = |_, _| ControlFlow::Continue(());
        let sheet = points_sheet(&film(), "film", [2, 120], &FigureStyle::default(), &mut go);
        let sheet = sheet.expect("a sheet");
        let paper = PaperTheme::Light.theme_paper_colour();
        let half = sheet.image_width() / 2;
        for columns in [0..half, half..sheet.image_width()] {
            let ink = columns
                .flat_map(|x| (70..sheet.image_height() - CLOUD_LABEL_HEIGHT_PIXELS).map(move |y| (x, y)))
                .filter(|&(x, y)| sheet.image_pixel_at(x, y) != paper)
                .count();
            assert!(ink > 50, "{ink}");
        }
        let empty = FrameTimes::Even(FrameRate::new(25, 1).expect("a rate"));
        let world = MarkerSpace::World(chereme_motion::SpaceConvention::MODEL_CONVENTION);
        let gap = || FrameNumberColumn::from_double_floats(vec![f64::NAN]);
        let gone = MotionMarker::new("C7", vec![gap(), gap(), gap()]);
        let gone = MarkerTrack::new(empty, world, vec![gone]).expect("a track");
        assert!(PointCloud::cloud_from_markers(&gone, PaperTheme::Light).is_none());
    }
}
