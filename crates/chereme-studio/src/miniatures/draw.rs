//! The thread that draws little figures, and the state that it shares with the window.

use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use chereme_corpus::DisplayedMovement;
use chereme_figure::handshape::{HandshapeOptions, handshape_picture};
use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::{FigureRaster, FigureStyle};
use chereme_figure::{ClipFraming, FigureView, PaperTheme, RasterImage, SignerBody};
use chereme_motion::{BodyAnatomy, BodySide, Clip, FacePosture, HandAngles, ModelPose, Skeleton};
use eframe::egui::{Color32, ColorImage, Context};

use super::{MiniatureFocus, MiniatureSource, PictureStripKey, miniatures_data};
use crate::model::generated::GeneratedClip;

/// Frames of the window after which a figure that was not requested again is no longer drawn.
const UNREQUESTED_FIGURE_FRAMES: u64 = 20;
/// How many bytes of pictures are kept, and how many of postures.
const MAX_PICTURE_BYTES: usize = 160 << 20;
const MAX_POSTURE_BYTES: usize = 64 << 20;
/// How many body meshes are kept; signers of one corpus share few skeletons.
const MAX_BODY_MESHES: usize = 8;

/// The state shared by window and thread.
#[derive(Default)]
pub(super) struct DrawingBoard {
    state: Mutex<DrawingBoardState>,
    changed: Condvar,
}

#[derive(Default)]
pub(super) struct DrawingBoardState {
    pub(super) films: BTreeMap<MiniatureSource, MiniatureFilm>,
    pub(super) strips: BTreeMap<PictureStripKey, PictureStrip>,
    /// The number of the window's current frame.
    pub(super) now: u64,
    pub(super) window: Option<Context>,
    pub(super) over: bool,
}

/// Movement in preparation for drawing.
pub(super) enum MiniatureFilm {
    /// The movement is requested from the corpus.
    Loading,
    /// The movement is loaded.
    Loaded(MiniatureMovement),
    /// The postures are chosen; the frame in which they were last needed.
    Ready(Arc<DrawableMovement>, u64),
    /// A picture of a film takes the place of movement; the frame in which it was last needed.
    Still(Arc<ColorImage>, u64),
    /// There is no movement.
    Nothing,
}

/// Movement from the corpus or from a recipe.
#[derive(Clone)]
pub(super) enum MiniatureMovement {
    Recorded(Arc<DisplayedMovement>),
    Made(Arc<GeneratedClip>),
}

/// Movement that can be drawn.
pub(super) struct DrawableMovement {
    poses: Vec<ModelPose>,
    /// One face per posture; empty if the face is at rest throughout.
    faces: Vec<FacePosture>,
    pub(super) seconds: f64,
    body: Arc<SignerBody>,
    anatomy: BodyAnatomy,
    framing: ClipFraming,
}

/// The pictures of one movement, with one framing and one size.
#[derive(Default)]
pub(super) struct PictureStrip {
    /// Empty until the number of pictures is known.
    pub(super) pictures: Vec<Option<Arc<ColorImage>>>,
    order: Vec<usize>,
    drawn: usize,
    pub(super) wanted: u64,
}

impl PictureStrip {
    fn picture_bytes(&self) -> usize {
        let one = self.pictures.iter().flatten().next();
        one.map_or(0, |picture| picture.pixels.len() * 4) * self.drawn
    }

    fn lay_out_pictures(&mut self, count: usize) {
        self.pictures = vec![None; count];
        self.order = miniatures_data::picture_drawing_order(count);
        self.drawn = 0;
    }

    /// Returns the share of pictures that is drawn; `None` if all are drawn.
    fn drawn_share(&self) -> Option<f32> {
        (self.pictures.is_empty() || self.drawn < self.order.len())
            .then(|| self.drawn as f32 / self.order.len().max(1) as f32)
    }
}

impl DrawableMovement {
    fn posture_bytes(&self) -> usize {
        let joints = self.poses.first().map_or(0, |pose| pose.model_joint_positions().len());
        self.poses.len() * joints * 64
    }
}

/// A task of the drawing thread.
enum DrawingTask {
    Prepare(MiniatureSource, MiniatureMovement),
    Draw(PictureStripKey, usize, Option<Arc<DrawableMovement>>),
}

impl DrawingBoard {
    /// Locks the shared state, even if a thread panicked with the lock.
    pub(super) fn lock_board_state(&self) -> MutexGuard<'_, DrawingBoardState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wakes the drawing thread after a change.
    pub(super) fn wake_drawing_thread(&self) {
        self.changed.notify_all();
    }

    /// Draws until the window ends the thread.
    pub(super) fn run_drawing_tasks(&self) {
        let mut hand = MiniatureDrawer::default();
        while let Some(task) = self.next() {
            match task {
                DrawingTask::Prepare(source, movement) => {
                    let ready = hand.prepare_movement(&movement);
                    let mut state = self.lock_board_state();
                    let film = match ready {
                        Some(ready) => MiniatureFilm::Ready(Arc::new(ready), state.now),
                        None => MiniatureFilm::Nothing,
                    };
                    state.films.insert(source, film);
                }
                DrawingTask::Draw(key, index, ready) => {
                    let picture = hand.draw_strip_picture(&key, index, ready.as_deref());
                    self.lock_board_state().take_in(&key, index, picture);
                }
            }
        }
    }

    fn next(&self) -> Option<DrawingTask> {
        let mut state = self.lock_board_state();
        loop {
            if state.over {
                return None;
            }
            if let Some(task) = state.task() {
                return Some(task);
            }
            let waited = self.changed.wait(state);
            state = waited.unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl DrawingBoardState {
    /// Returns the most urgent task: the visible loop with the smallest share of drawn pictures.
    fn task(&mut self) -> Option<DrawingTask> {
        let since = self.now.saturating_sub(UNREQUESTED_FIGURE_FRAMES);
        let mut next: Option<(f32, &PictureStripKey, &mut PictureStrip, Option<Arc<DrawableMovement>>)> = None;
        for (key, strip) in &mut self.strips {
            // Figures that scrolled out of sight are not drawn on.
            let Some(share) = strip.drawn_share().filter(|_| strip.wanted >= since) else {
                continue;
            };
            let ready = match (&key.source, self.films.get_mut(&key.source)) {
                (MiniatureSource::Hand(..), _) => None,
                (_, Some(MiniatureFilm::Ready(ready, needed))) => {
                    *needed = strip.wanted;
                    Some(ready.clone())
                }
                (_, Some(MiniatureFilm::Loaded(movement))) => {
                    // Postures first, since they decide how many pictures a strip has.
                    return Some(DrawingTask::Prepare(key.source.clone(), movement.clone()));
                }
                _ => continue,
            };
            // The strip with the smallest share is next, so that all visible figures grow evenly.
            if next.as_ref().is_none_or(|(least, ..)| share < *least) {
                next = Some((share, key, strip, ready));
            }
        }
        let (_, key, strip, ready) = next?;
        if strip.pictures.is_empty() {
            // A hand alone is one posture and one picture.
            strip.lay_out_pictures(ready.as_ref().map_or(1, |ready| ready.poses.len()));
        }
        let index = *strip.order.get(strip.drawn)?;
        // Counted already now: the next task must not be the same picture.
        strip.drawn += 1;
        Some(DrawingTask::Draw(key.clone(), index, ready))
    }

    fn take_in(&mut self, key: &PictureStripKey, index: usize, picture: ColorImage) {
        // The strip may have been removed while its picture was drawn.
        if let Some(strip) = self.strips.get_mut(key)
            && let Some(slot) = strip.pictures.get_mut(index)
        {
            *slot = Some(Arc::new(picture));
        }
        self.evict_unwanted_pictures();
        if let Some(window) = &self.window {
            window.request_repaint();
        }
    }

    /// Removes the pictures and postures that were wanted longest ago if there are too many.
    fn evict_unwanted_pictures(&mut self) {
        let since = self.now.saturating_sub(UNREQUESTED_FIGURE_FRAMES);
        let strip_entries = self.strips.iter();
        let strips = strip_entries.map(|(key, it)| (key.clone(), it.picture_bytes(), it.wanted));
        for key in miniatures_data::keys_to_evict(strips, since, MAX_PICTURE_BYTES) {
            self.strips.remove(&key);
        }
        let films = self.films.iter().filter_map(|(source, film)| match film {
            MiniatureFilm::Ready(ready, needed) => Some((source.clone(), ready.posture_bytes(), *needed)),
            MiniatureFilm::Still(image, needed) => Some((source.clone(), image.pixels.len() * 4, *needed)),
            _ => None,
        });
        for source in miniatures_data::keys_to_evict(films, since, MAX_POSTURE_BYTES) {
            self.films.remove(&source);
        }
    }
}

/// The state that the thread keeps between pictures.
#[derive(Default)]
struct MiniatureDrawer {
    raster: FigureRaster,
    /// The mesh and the body it belongs to.
    mesh: (Option<Arc<SignerBody>>, TriangleMesh),
    bodies: Vec<(Arc<Skeleton>, BodyAnatomy, Arc<SignerBody>)>,
}

impl MiniatureDrawer {
    fn prepare_movement(&mut self, movement: &MiniatureMovement) -> Option<DrawableMovement> {
        let (clip, anatomy, faces): (&Clip, &BodyAnatomy, &[FacePosture]) = match movement {
            MiniatureMovement::Recorded(moving) => (&moving.clip, &moving.anatomy, &moving.faces),
            MiniatureMovement::Made(made) => (&made.clip, &made.anatomy, &made.faces),
        };
        if clip.clip_frame_count() == 0 {
            return None;
        }
        let span = miniatures_data::loop_shown_span(clip.clip_span());
        let count = miniatures_data::loop_picture_count(span.span_seconds());
        let poses: Vec<ModelPose> = (0..count)
            .map(|index| clip.sample_pose(miniatures_data::loop_picture_moment(span, index, count)))
            .map(|pose| ModelPose::from_local_pose(clip.clip_skeleton(), &pose))
            .collect();
        let face = |index| {
            FacePosture::face_at_moment(
                faces,
                clip.clip_frame_rate(),
                miniatures_data::loop_picture_moment(span, index, count),
            )
        };
        Some(DrawableMovement {
            faces: (0..count).map_while(face).collect(),
            framing: ClipFraming::framing_from_signing(&poses, anatomy),
            seconds: span.span_seconds(),
            body: self.body_of_skeleton(clip.clip_skeleton(), anatomy),
            anatomy: anatomy.clone(),
            poses,
        })
    }

    fn body_of_skeleton(&mut self, skeleton: &Arc<Skeleton>, anatomy: &BodyAnatomy) -> Arc<SignerBody> {
        let same = |entry: &&(Arc<Skeleton>, BodyAnatomy, Arc<SignerBody>)| {
            (Arc::ptr_eq(&entry.0, skeleton) || entry.0 == *skeleton) && entry.1 == *anatomy
        };
        if let Some((_, _, body)) = self.bodies.iter().find(same) {
            return body.clone();
        }
        let body = Arc::new(SignerBody::new(skeleton, anatomy));
        if self.bodies.len() >= MAX_BODY_MESHES {
            // The oldest body goes; movements that are drawn hold theirs.
            self.bodies.remove(0);
        }
        self.bodies.push((skeleton.clone(), anatomy.clone(), body.clone()));
        body
    }

    fn draw_strip_picture(
        &mut self,
        key: &PictureStripKey,
        index: usize,
        ready: Option<&DrawableMovement>,
    ) -> ColorImage {
        let size = key.size.map(usize::from);
        let theme = if key.dark { PaperTheme::Dark } else { PaperTheme::Light };
        let style = FigureStyle {
            theme,
            ..FigureStyle::default()
        };
        let image = match (&key.source, ready) {
            (MiniatureSource::Hand(left, angles), _) => hand_alone(*left, angles, size, theme),
            (_, Some(ready)) => Some(self.draw_signer_picture(ready, index, key.focus, size, &style)),
            _ => None,
        };
        image.map_or_else(
            || ColorImage::filled(size, paper_colour(theme)),
            |image| color_image_from(&image),
        )
    }

    fn draw_signer_picture(
        &mut self,
        ready: &DrawableMovement,
        index: usize,
        focus: MiniatureFocus,
        size: [usize; 2],
        style: &FigureStyle,
    ) -> RasterImage {
        let pose = &ready.poses[index];
        let (of, mesh) = &mut self.mesh;
        // One mesh serves all figures of a body; another body needs one of its own size.
        if of.as_ref().is_none_or(|body| !Arc::ptr_eq(body, &ready.body)) {
            *mesh = ready.body.posed_mesh(pose);
            *of = Some(ready.body.clone());
        } else {
            ready.body.shape_body_mesh(pose, mesh);
        }
        if let Some(face) = ready.faces.get(index) {
            ready.body.apply_face_expression(pose, face, mesh);
        }
        let view = match focus {
            MiniatureFocus::Signing => FigureView::Addressee,
            MiniatureFocus::Hand(side) => FigureView::Hand(side),
            MiniatureFocus::Face => FigureView::Face,
        };
        let aspect = size[0] as f32 / size[1] as f32;
        let camera = ready.framing.framing_camera(view, aspect, pose, &ready.anatomy);
        self.raster.draw_mesh_picture(mesh, &camera, size, style)
    }
}

fn hand_alone(
    left: bool,
    angles: &[u64; HandAngles::HAND_ANGLE_COUNT],
    size: [usize; 2],
    theme: PaperTheme,
) -> Option<RasterImage> {
    let usual = HandshapeOptions::with_small_size(size[0].min(size[1]));
    let options = HandshapeOptions {
        side: if left { BodySide::Left } else { BodySide::Right },
        style: FigureStyle { theme, ..usual.style },
        ..usual
    };
    let angles = HandAngles::from_array(angles.map(f64::from_bits));
    handshape_picture(&angles, &options).ok()
}

fn paper_colour(theme: PaperTheme) -> Color32 {
    let [r, g, b] = theme.theme_paper_colour().0;
    Color32::from_rgb(r, g, b)
}

fn color_image_from(image: &RasterImage) -> ColorImage {
    let raw_pixels = image.image_pixels().iter();
    let pixels = raw_pixels.map(|pixel| Color32::from_rgb(pixel.0[0], pixel.0[1], pixel.0[2]));
    ColorImage::new([image.image_width(), image.image_height()], pixels.collect())
}
