//! Pictures of the stage, drawn on a separate thread, so that the window never waits for one.
//!
//! Only the newest request is drawn; outdated requests are skipped.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use chereme_figure::camera::FigureCamera;
use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::{FigureRaster, FigureStyle, RasterLayer};
use chereme_figure::{RasterImage, SignerBody};
use chereme_motion::{FacePosture, ModelPose};
use eframe::egui::{Color32, ColorImage};

/// A request for pictures, one for each pane.
pub(super) struct StageRequest {
    pub(super) figures: Vec<PosedFigure>,
    pub(super) panes: Vec<CameraPicture>,
    pub(super) style: FigureStyle,
    /// Serial number of the request.
    pub(super) number: u64,
}

/// A body in a posture.
pub(super) struct PosedFigure {
    pub(super) body: Arc<SignerBody>,
    pub(super) pose: ModelPose,
    /// The face, if it is not at rest.
    pub(super) face: Option<FacePosture>,
}

impl PosedFigure {
    /// Returns a body whose face is at rest.
    pub(super) fn at_rest(body: Arc<SignerBody>, pose: ModelPose) -> Self {
        Self { body, pose, face: None }
    }
}

/// A picture from one camera.
pub(super) struct CameraPicture {
    pub(super) camera: FigureCamera,
    /// Columns and rows.
    pub(super) size: [usize; 2],
    /// The sheets to draw, the lowest first.
    pub(super) layers: Vec<ShapeSheet>,
    /// Whether it is a small picture that must be readable: clear lines, many samples.
    pub(super) fine: bool,
}

/// Half the width of lines in small pictures in pixels, their depth step in metres, and their samples.
const FINE_LINE_SETTINGS: (f32, f32, usize) = (0.9, 0.006, 3);

/// Shapes that are drawn together, above the sheets before.
pub(super) struct ShapeSheet {
    /// Index of the figure among those of the request, if the sheet draws one.
    pub(super) figure: Option<usize>,
    /// Trails or grids.
    pub(super) marks: Option<Arc<TriangleMesh>>,
    pub(super) opacity: f32,
    /// Whether nearer shapes of earlier sheets hide it.
    pub(super) veiled: bool,
}

/// Finished pictures.
pub(super) struct DrawnPictures {
    pub(super) images: Vec<ColorImage>,
    /// The serial number of their request.
    pub(super) number: u64,
    /// The posture of the first figure.
    pub(super) posture: Option<ModelPose>,
    /// How long the drawing took.
    pub(super) took: Duration,
}

/// The handle of the drawing thread.
pub(super) struct StageArtist {
    shared: Arc<ArtistShared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct ArtistShared {
    wish: Mutex<ArtistWishes>,
    wished: Condvar,
    drawn: Mutex<Option<DrawnPictures>>,
    ready: Condvar,
}

#[derive(Default)]
struct ArtistWishes {
    next: Option<StageRequest>,
    over: bool,
}

impl StageArtist {
    /// Starts the thread; it calls `wake` when pictures are ready.
    pub(super) fn new(wake: impl Fn() + Send + 'static) -> Self {
        let shared = Arc::<ArtistShared>::default();
        let thread_shared = shared.clone();
        let thread = std::thread::spawn(move || {
            let mut hand = DrawingBuffers::default();
            while let Some(wish) = thread_shared.next() {
                let drawn = hand.draw_stage_request(&wish);
                // Only the newest picture is of use; one that nobody took is replaced.
                *lock_shared_data(&thread_shared.drawn) = Some(drawn);
                thread_shared.ready.notify_all();
                wake();
            }
        });
        Self {
            shared,
            thread: Some(thread),
        }
    }

    /// Requests pictures; an earlier request that has not been started is dropped.
    pub(super) fn request_stage_pictures(&self, wish: StageRequest) {
        lock_shared_data(&self.shared.wish).next = Some(wish);
        self.shared.wished.notify_one();
    }

    /// Waits until the pictures of that request are ready, at most for `most`.
    pub(super) fn await_newest(&self, number: u64, most: Duration) {
        // A later picture is as good as the awaited one.
        let waiting = |drawn: &mut Option<DrawnPictures>| drawn.as_ref().is_none_or(|picture| picture.number < number);
        let drawn = lock_shared_data(&self.shared.drawn);
        // Pictures that take longer are shown in a later frame.
        let _ = self.shared.ready.wait_timeout_while(drawn, most, waiting);
    }

    /// Returns the newest pictures, once.
    pub(super) fn take_drawn_pictures(&self) -> Option<DrawnPictures> {
        lock_shared_data(&self.shared.drawn).take()
    }
}

impl Drop for StageArtist {
    fn drop(&mut self) {
        // The thread may be waiting for a request, so it is woken to see the end.
        lock_shared_data(&self.shared.wish).over = true;
        self.shared.wished.notify_one();
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has nothing left to do.
            let _ = thread.join();
        }
    }
}

impl ArtistShared {
    fn next(&self) -> Option<StageRequest> {
        let mut wish = lock_shared_data(&self.wish);
        loop {
            if wish.over {
                return None;
            }
            if let Some(next) = wish.next.take() {
                return Some(next);
            }
            wish = self.wished.wait(wish).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Locks shared data, even if another thread panicked with the lock.
fn lock_shared_data<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Buffers that are kept between pictures.
#[derive(Default)]
struct DrawingBuffers {
    meshes: Vec<(Option<Arc<SignerBody>>, TriangleMesh)>,
    canvases: Vec<PictureCanvas>,
}

/// The buffers of a pane.
#[derive(Default)]
struct PictureCanvas {
    raster: FigureRaster,
    joined: TriangleMesh,
    ground: Option<GroundPicture>,
}

/// The picture below the figures, with its inputs.
struct GroundPicture {
    mesh: Arc<TriangleMesh>,
    camera: FigureCamera,
    style: FigureStyle,
    image: RasterImage,
}

impl DrawingBuffers {
    fn draw_stage_request(&mut self, wish: &StageRequest) -> DrawnPictures {
        let begun = Instant::now();
        self.meshes.resize_with(wish.figures.len(), Default::default);
        for (PosedFigure { body, pose, face }, (of, mesh)) in wish.figures.iter().zip(&mut self.meshes) {
            // A body keeps its mesh from picture to picture; another body needs one of its own size.
            if of.as_ref().is_some_and(|of| Arc::ptr_eq(of, body)) {
                body.shape_body_mesh(pose, mesh);
            } else {
                *mesh = body.posed_mesh(pose);
                *of = Some(body.clone());
            }
            if let Some(face) = face {
                body.apply_face_expression(pose, face, mesh);
            }
        }
        DrawnPictures {
            images: self.draw_request_pictures(wish),
            number: wish.number,
            posture: wish.figures.first().map(|figure| figure.pose.clone()),
            took: begun.elapsed(),
        }
    }

    /// Draws every pane: large ones on one thread each, and the small ones one after the other.
    fn draw_request_pictures(&mut self, wish: &StageRequest) -> Vec<ColorImage> {
        self.canvases.resize_with(wish.panes.len(), PictureCanvas::default);
        let meshes = &self.meshes;
        let large = wish.panes.iter().filter(|pane| !pane.fine).count();
        let style = FigureStyle {
            // Large pictures are drawn at the same time and share the threads.
            threads: (wish.style.threads / large.max(1)).max(1),
            ..wish.style
        };
        let (line, step, samples) = FINE_LINE_SETTINGS;
        let fine = FigureStyle {
            line,
            step,
            samples,
            threads: 1,
            ..wish.style
        };
        let work = wish.panes.iter().zip(&mut self.canvases);
        let (small, mut others): (Vec<_>, Vec<_>) = work.partition(|(pane, _)| pane.fine);
        let mut images: Vec<Option<ColorImage>> = vec![None; wish.panes.len()];
        let places = |fine: bool| {
            let of = wish.panes.iter().enumerate();
            of.filter(move |(_, pane)| pane.fine == fine).map(|entry| entry.0)
        };
        std::thread::scope(|scope| {
            // The last large picture is drawn here, since this thread would only wait.
            let last = others.pop();
            let others: Vec<_> = others
                .into_iter()
                .map(|(pane, canvas)| scope.spawn(move || canvas.draw_canvas_picture(pane, meshes, &style)))
                .collect();
            let small = (!small.is_empty()).then(|| {
                scope.spawn(move || {
                    let small_canvases = small.into_iter();
                    let drawn = small_canvases.map(|(pane, canvas)| canvas.draw_canvas_picture(pane, meshes, &fine));
                    drawn.collect::<Vec<_>>()
                })
            });
            let last = last.map(|(pane, canvas)| canvas.draw_canvas_picture(pane, meshes, &style));
            let others = others.into_iter().map(|thread| thread.join().ok()).chain([last]);
            for (place, image) in places(false).zip(others) {
                images[place] = image;
            }
            let small = small.and_then(|thread| thread.join().ok()).unwrap_or_default();
            for (place, image) in places(true).zip(small) {
                images[place] = Some(image);
            }
        });
        let empty = |(image, pane): (Option<ColorImage>, &CameraPicture)| {
            // A panicked thread leaves its picture grey instead of taking the window with it.
            image.unwrap_or_else(|| ColorImage::filled(pane.size, Color32::GRAY))
        };
        images.into_iter().zip(&wish.panes).map(empty).collect()
    }
}

impl PictureCanvas {
    fn draw_canvas_picture(
        &mut self,
        pane: &CameraPicture,
        meshes: &[(Option<Arc<SignerBody>>, TriangleMesh)],
        style: &FigureStyle,
    ) -> ColorImage {
        let mut image = None;
        for sheet in &pane.layers {
            let figure = sheet.figure.and_then(|at| meshes.get(at));
            let mesh = match (figure, &sheet.marks) {
                (Some((_, figure)), Some(marks)) => {
                    // Marks of a figure are drawn with it, so that both hide each other.
                    self.joined.clone_from(figure);
                    self.joined.append_mesh(marks);
                    &self.joined
                }
                (Some((_, figure)), None) => figure,
                // Only the lowest sheet can be kept: the picture below it is empty paper.
                (None, Some(marks)) if image.is_none() => {
                    image = Some(self.on_ground(pane, marks, style));
                    continue;
                }
                (None, Some(marks)) => marks,
                (None, None) => continue,
            };
            let layer = RasterLayer {
                mesh,
                opacity: sheet.opacity,
                veiled: sheet.veiled,
            };
            let image = image.get_or_insert_with(|| draw_picture_background(pane, style));
            self.raster.draw_over(image, layer, &pane.camera, style);
        }
        let image = image.unwrap_or_else(|| draw_picture_background(pane, style));
        let raw_pixels = image.image_pixels().iter();
        let pixels = raw_pixels.map(|pixel| Color32::from_rgb(pixel.0[0], pixel.0[1], pixel.0[2]));
        ColorImage::new(pane.size, pixels.collect())
    }

    /// Returns the picture below the figures; it is drawn again only if its inputs changed.
    fn on_ground(&mut self, pane: &CameraPicture, mesh: &Arc<TriangleMesh>, style: &FigureStyle) -> RasterImage {
        let same = |ground: &GroundPicture| {
            let size = [ground.image.image_width(), ground.image.image_height()];
            (ground.camera, ground.style, size) == (pane.camera, *style, pane.size) && ground.mesh == *mesh
        };
        if let Some(ground) = self.ground.as_ref().filter(|ground| same(ground)) {
            return ground.image.clone();
        }
        let mut image = draw_picture_background(pane, style);
        let layer = RasterLayer {
            mesh,
            opacity: 1.0,
            veiled: false,
        };
        self.raster.draw_over(&mut image, layer, &pane.camera, style);
        self.ground = Some(GroundPicture {
            mesh: mesh.clone(),
            camera: pane.camera,
            style: *style,
            image: image.clone(),
        });
        image
    }
}

fn draw_picture_background(pane: &CameraPicture, style: &FigureStyle) -> RasterImage {
    RasterImage::new(pane.size[0], pane.size[1], style.theme.theme_paper_colour())
}
