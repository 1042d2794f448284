//! Pictures of the stage, drawn on a separate thread, so that the window never waits for one.
//!
//! Only the newest request is drawn; outdated requests are skipped.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use chereme_figure::camera::Camera;
use chereme_figure::mesh::Mesh;
use chereme_figure::raster::{Layer, Raster, Style};
use chereme_figure::{Body, Image};
use chereme_motion::{Face, ModelPose};
use eframe::egui::{Color32, ColorImage};

/// A request for pictures, one for each pane.
pub(super) struct StageRequest {
    pub(super) figures: Vec<Figure>,
    pub(super) panes: Vec<Pane>,
    pub(super) style: Style,
    /// Serial number of the request.
    pub(super) number: u64,
}

/// A body in a posture.
pub(super) struct Figure {
    pub(super) body: Arc<Body>,
    pub(super) pose: ModelPose,
    /// The face, if it is not at rest.
    pub(super) face: Option<Face>,
}

impl Figure {
    /// Returns a body whose face is at rest.
    pub(super) fn at_rest(body: Arc<Body>, pose: ModelPose) -> Self {
        Self {
            body,
            pose,
            face: None,
        }
    }
}

/// A picture from one camera.
pub(super) struct Pane {
    pub(super) camera: Camera,
    /// Columns and rows.
    pub(super) size: [usize; 2],
    /// The sheets to draw, the lowest first.
    pub(super) layers: Vec<Sheet>,
    /// Whether it is a small picture that must be readable: clear lines, many samples.
    pub(super) fine: bool,
}

/// Half the width of lines in small pictures in pixels, their depth step in metres, and their samples.
const FINE: (f32, f32, usize) = (0.9, 0.006, 3);

/// Shapes that are drawn together, above the sheets before.
pub(super) struct Sheet {
    /// Index of the figure among those of the request, if the sheet draws one.
    pub(super) figure: Option<usize>,
    /// Trails or grids.
    pub(super) marks: Option<Arc<Mesh>>,
    pub(super) opacity: f32,
    /// Whether nearer shapes of earlier sheets hide it.
    pub(super) veiled: bool,
}

/// Finished pictures.
pub(super) struct Drawn {
    pub(super) images: Vec<ColorImage>,
    /// The serial number of their request.
    pub(super) number: u64,
    /// The posture of the first figure.
    pub(super) posture: Option<ModelPose>,
    /// How long the drawing took.
    pub(super) took: Duration,
}

/// The handle of the drawing thread.
pub(super) struct Artist {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    wish: Mutex<Wished>,
    wished: Condvar,
    drawn: Mutex<Option<Drawn>>,
    ready: Condvar,
}

#[derive(Default)]
struct Wished {
    next: Option<StageRequest>,
    over: bool,
}

impl Artist {
    /// Starts the thread; it calls `wake` when pictures are ready.
    pub(super) fn new(wake: impl Fn() + Send + 'static) -> Self {
        let shared = Arc::<Shared>::default();
        let own = shared.clone();
        let thread = std::thread::spawn(move || {
            let mut hand = Hand::default();
            while let Some(wish) = own.next() {
                let drawn = hand.draw(&wish);
                *held(&own.drawn) = Some(drawn);
                own.ready.notify_all();
                wake();
            }
        });
        Self {
            shared,
            thread: Some(thread),
        }
    }

    /// Requests pictures; an earlier request that has not been started is dropped.
    pub(super) fn wish(&self, wish: StageRequest) {
        held(&self.shared.wish).next = Some(wish);
        self.shared.wished.notify_one();
    }

    /// Waits until the pictures of that request are ready, at most for `most`.
    pub(super) fn await_newest(&self, number: u64, most: Duration) {
        let waiting =
            |drawn: &mut Option<Drawn>| drawn.as_ref().is_none_or(|it| it.number < number);
        let drawn = held(&self.shared.drawn);
        // Pictures that take longer are shown in a later frame.
        let _ = self.shared.ready.wait_timeout_while(drawn, most, waiting);
    }

    /// Returns the newest pictures, once.
    pub(super) fn take(&self) -> Option<Drawn> {
        held(&self.shared.drawn).take()
    }
}

impl Drop for Artist {
    fn drop(&mut self) {
        held(&self.shared.wish).over = true;
        self.shared.wished.notify_one();
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has nothing left to do.
            let _ = thread.join();
        }
    }
}

impl Shared {
    fn next(&self) -> Option<StageRequest> {
        let mut wish = held(&self.wish);
        loop {
            if wish.over {
                return None;
            }
            if let Some(next) = wish.next.take() {
                return Some(next);
            }
            wish = self
                .wished
                .wait(wish)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Locks shared data, even if another thread panicked with the lock.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Buffers that are kept between pictures.
#[derive(Default)]
struct Hand {
    meshes: Vec<(Option<Arc<Body>>, Mesh)>,
    canvases: Vec<Canvas>,
}

/// The buffers of a pane.
#[derive(Default)]
struct Canvas {
    raster: Raster,
    joined: Mesh,
    ground: Option<Ground>,
}

/// The picture below the figures, with its inputs.
struct Ground {
    mesh: Arc<Mesh>,
    camera: Camera,
    style: Style,
    image: Image,
}

impl Hand {
    fn draw(&mut self, wish: &StageRequest) -> Drawn {
        let begun = Instant::now();
        self.meshes
            .resize_with(wish.figures.len(), Default::default);
        for (Figure { body, pose, face }, (of, mesh)) in wish.figures.iter().zip(&mut self.meshes) {
            if of.as_ref().is_some_and(|of| Arc::ptr_eq(of, body)) {
                body.shape(pose, mesh);
            } else {
                *mesh = body.mesh(pose);
                *of = Some(body.clone());
            }
            if let Some(face) = face {
                body.express(pose, face, mesh);
            }
        }
        Drawn {
            images: self.panes(wish),
            number: wish.number,
            posture: wish.figures.first().map(|figure| figure.pose.clone()),
            took: begun.elapsed(),
        }
    }

    /// Draws every pane: large ones on one thread each, and the small ones one after the other.
    fn panes(&mut self, wish: &StageRequest) -> Vec<ColorImage> {
        self.canvases.resize_with(wish.panes.len(), Canvas::default);
        let meshes = &self.meshes;
        let large = wish.panes.iter().filter(|pane| !pane.fine).count();
        let style = Style {
            threads: (wish.style.threads / large.max(1)).max(1),
            ..wish.style
        };
        let (line, step, samples) = FINE;
        let fine = Style {
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
            of.filter(move |(_, pane)| pane.fine == fine).map(|it| it.0)
        };
        std::thread::scope(|scope| {
            let last = others.pop();
            let others: Vec<_> = others
                .into_iter()
                .map(|(pane, canvas)| scope.spawn(move || canvas.draw(pane, meshes, &style)))
                .collect();
            let small = (!small.is_empty()).then(|| {
                scope.spawn(move || {
                    let drawn = small.into_iter();
                    let drawn = drawn.map(|(pane, canvas)| canvas.draw(pane, meshes, &fine));
                    drawn.collect::<Vec<_>>()
                })
            });
            let last = last.map(|(pane, canvas)| canvas.draw(pane, meshes, &style));
            let others = others.into_iter().map(|it| it.join().ok()).chain([last]);
            for (place, image) in places(false).zip(others) {
                images[place] = image;
            }
            let small = small.and_then(|it| it.join().ok()).unwrap_or_default();
            for (place, image) in places(true).zip(small) {
                images[place] = Some(image);
            }
        });
        let empty = |(image, pane): (Option<ColorImage>, &Pane)| {
            image.unwrap_or_else(|| ColorImage::filled(pane.size, Color32::GRAY))
        };
        images.into_iter().zip(&wish.panes).map(empty).collect()
    }
}

impl Canvas {
    fn draw(
        &mut self,
        pane: &Pane,
        meshes: &[(Option<Arc<Body>>, Mesh)],
        style: &Style,
    ) -> ColorImage {
        let mut image = None;
        for sheet in &pane.layers {
            let figure = sheet.figure.and_then(|at| meshes.get(at));
            let mesh = match (figure, &sheet.marks) {
                (Some((_, figure)), Some(marks)) => {
                    self.joined.clone_from(figure);
                    self.joined.append(marks);
                    &self.joined
                }
                (Some((_, figure)), None) => figure,
                (None, Some(marks)) if image.is_none() => {
                    image = Some(self.on_ground(pane, marks, style));
                    continue;
                }
                (None, Some(marks)) => marks,
                (None, None) => continue,
            };
            let layer = Layer {
                mesh,
                opacity: sheet.opacity,
                veiled: sheet.veiled,
            };
            let image = image.get_or_insert_with(|| paper(pane, style));
            self.raster.draw_over(image, layer, &pane.camera, style);
        }
        let image = image.unwrap_or_else(|| paper(pane, style));
        let pixels = image.pixels().iter();
        let pixels = pixels.map(|it| Color32::from_rgb(it.0[0], it.0[1], it.0[2]));
        ColorImage::new(pane.size, pixels.collect())
    }

    /// Returns the picture below the figures; it is drawn again only if its inputs changed.
    fn on_ground(&mut self, pane: &Pane, mesh: &Arc<Mesh>, style: &Style) -> Image {
        let same = |it: &Ground| {
            let size = [it.image.width(), it.image.height()];
            (it.camera, it.style, size) == (pane.camera, *style, pane.size) && it.mesh == *mesh
        };
        if let Some(ground) = self.ground.as_ref().filter(|it| same(it)) {
            return ground.image.clone();
        }
        let mut image = paper(pane, style);
        let layer = Layer {
            mesh,
            opacity: 1.0,
            veiled: false,
        };
        self.raster
            .draw_over(&mut image, layer, &pane.camera, style);
        self.ground = Some(Ground {
            mesh: mesh.clone(),
            camera: pane.camera,
            style: *style,
            image: image.clone(),
        });
        image
    }
}

fn paper(pane: &Pane, style: &Style) -> Image {
    Image::new(pane.size[0], pane.size[1], style.theme.background())
}
