//! The thread that draws little figures, and the state that it shares with the window.

use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use chereme_corpus::Moving;
use chereme_figure::handshape::{HandshapeOptions, handshape_picture};
use chereme_figure::mesh::Mesh;
use chereme_figure::raster::{Raster, Style};
use chereme_figure::{Body, Framing, Image, Theme, View};
use chereme_motion::{Anatomy, Clip, Face, HandAngles, ModelPose, Side, Skeleton};
use eframe::egui::{Color32, ColorImage, Context};

use super::data;
use super::{Focus, Key, Source};
use crate::model::generated::GeneratedClip;

/// Frames of the window after which a figure that was not requested again is no longer drawn.
const PATIENCE: u64 = 20;
/// How many bytes of pictures are kept, and how many of postures.
const PICTURES: usize = 160 << 20;
const POSTURES: usize = 64 << 20;
/// How many body meshes are kept; signers of one corpus share few skeletons.
const BODIES: usize = 8;

/// The state shared by window and thread.
#[derive(Default)]
pub(super) struct Board {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
pub(super) struct State {
    pub(super) films: BTreeMap<Source, Film>,
    pub(super) strips: BTreeMap<Key, Strip>,
    /// The number of the window's current frame.
    pub(super) now: u64,
    pub(super) window: Option<Context>,
    pub(super) over: bool,
}

/// Movement in preparation for drawing.
pub(super) enum Film {
    /// The movement is requested from the corpus.
    Loading,
    /// The movement is loaded.
    Loaded(Movement),
    /// The postures are chosen; the frame in which they were last needed.
    Ready(Arc<Ready>, u64),
    /// A picture of a film takes the place of movement; the frame in which it was last needed.
    Still(Arc<ColorImage>, u64),
    /// There is no movement.
    Nothing,
}

/// Movement from the corpus or from a recipe.
#[derive(Clone)]
pub(super) enum Movement {
    Recorded(Arc<Moving>),
    Made(Arc<GeneratedClip>),
}

/// Movement that can be drawn.
pub(super) struct Ready {
    poses: Vec<ModelPose>,
    /// One face per posture; empty if the face is at rest throughout.
    faces: Vec<Face>,
    pub(super) seconds: f64,
    body: Arc<Body>,
    anatomy: Anatomy,
    framing: Framing,
}

/// The pictures of one movement, with one framing and one size.
#[derive(Default)]
pub(super) struct Strip {
    /// Empty until the number of pictures is known.
    pub(super) pictures: Vec<Option<Arc<ColorImage>>>,
    order: Vec<usize>,
    drawn: usize,
    pub(super) wanted: u64,
}

impl Strip {
    fn bytes(&self) -> usize {
        let one = self.pictures.iter().flatten().next();
        one.map_or(0, |picture| picture.pixels.len() * 4) * self.drawn
    }

    fn lay_out(&mut self, count: usize) {
        self.pictures = vec![None; count];
        self.order = data::order(count);
        self.drawn = 0;
    }

    /// Returns the share of pictures that is drawn; `None` if all are drawn.
    fn share(&self) -> Option<f32> {
        (self.pictures.is_empty() || self.drawn < self.order.len())
            .then(|| self.drawn as f32 / self.order.len().max(1) as f32)
    }
}

impl Ready {
    fn bytes(&self) -> usize {
        let joints = self.poses.first().map_or(0, |pose| pose.positions().len());
        self.poses.len() * joints * 64
    }
}

/// A task of the drawing thread.
enum Task {
    Prepare(Source, Movement),
    Draw(Key, usize, Option<Arc<Ready>>),
}

impl Board {
    /// Locks the shared state, even if a thread panicked with the lock.
    pub(super) fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wakes the drawing thread after a change.
    pub(super) fn wake(&self) {
        self.changed.notify_all();
    }

    /// Draws until the window ends the thread.
    pub(super) fn work(&self) {
        let mut hand = Hand::default();
        while let Some(task) = self.next() {
            match task {
                Task::Prepare(source, movement) => {
                    let ready = hand.prepare(&movement);
                    let mut state = self.state();
                    let film = match ready {
                        Some(ready) => Film::Ready(Arc::new(ready), state.now),
                        None => Film::Nothing,
                    };
                    state.films.insert(source, film);
                }
                Task::Draw(key, index, ready) => {
                    let picture = hand.draw(&key, index, ready.as_deref());
                    self.state().take_in(&key, index, picture);
                }
            }
        }
    }

    fn next(&self) -> Option<Task> {
        let mut state = self.state();
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

impl State {
    /// Returns the most urgent task: the visible loop with the smallest share of drawn pictures.
    fn task(&mut self) -> Option<Task> {
        let since = self.now.saturating_sub(PATIENCE);
        let mut next: Option<(f32, &Key, &mut Strip, Option<Arc<Ready>>)> = None;
        for (key, strip) in &mut self.strips {
            let Some(share) = strip.share().filter(|_| strip.wanted >= since) else {
                continue;
            };
            let ready = match (&key.source, self.films.get_mut(&key.source)) {
                (Source::Hand(..), _) => None,
                (_, Some(Film::Ready(ready, needed))) => {
                    *needed = strip.wanted;
                    Some(ready.clone())
                }
                (_, Some(Film::Loaded(movement))) => {
                    return Some(Task::Prepare(key.source.clone(), movement.clone()));
                }
                _ => continue,
            };
            if next.as_ref().is_none_or(|(least, ..)| share < *least) {
                next = Some((share, key, strip, ready));
            }
        }
        let (_, key, strip, ready) = next?;
        if strip.pictures.is_empty() {
            strip.lay_out(ready.as_ref().map_or(1, |ready| ready.poses.len()));
        }
        let index = *strip.order.get(strip.drawn)?;
        strip.drawn += 1;
        Some(Task::Draw(key.clone(), index, ready))
    }

    fn take_in(&mut self, key: &Key, index: usize, picture: ColorImage) {
        if let Some(strip) = self.strips.get_mut(key)
            && let Some(slot) = strip.pictures.get_mut(index)
        {
            *slot = Some(Arc::new(picture));
        }
        self.let_go();
        if let Some(window) = &self.window {
            window.request_repaint();
        }
    }

    /// Removes the pictures and postures that were wanted longest ago if there are too many.
    fn let_go(&mut self) {
        let since = self.now.saturating_sub(PATIENCE);
        let strips = self.strips.iter();
        let strips = strips.map(|(key, it)| (key.clone(), it.bytes(), it.wanted));
        for key in data::leaving(strips, since, PICTURES) {
            self.strips.remove(&key);
        }
        let films = self.films.iter().filter_map(|(source, film)| match film {
            Film::Ready(ready, needed) => Some((source.clone(), ready.bytes(), *needed)),
            Film::Still(image, needed) => Some((source.clone(), image.pixels.len() * 4, *needed)),
            _ => None,
        });
        for source in data::leaving(films, since, POSTURES) {
            self.films.remove(&source);
        }
    }
}

/// The state that the thread keeps between pictures.
#[derive(Default)]
struct Hand {
    raster: Raster,
    /// The mesh and the body it belongs to.
    mesh: (Option<Arc<Body>>, Mesh),
    bodies: Vec<(Arc<Skeleton>, Anatomy, Arc<Body>)>,
}

impl Hand {
    fn prepare(&mut self, movement: &Movement) -> Option<Ready> {
        let (clip, anatomy, faces): (&Clip, &Anatomy, &[Face]) = match movement {
            Movement::Recorded(moving) => (&moving.clip, &moving.anatomy, &moving.faces),
            Movement::Made(made) => (&made.clip, &made.anatomy, &made.faces),
        };
        if clip.frames() == 0 {
            return None;
        }
        let span = data::shown(clip.span());
        let count = data::count(span.seconds());
        let poses: Vec<ModelPose> = (0..count)
            .map(|index| clip.sample(data::moment(span, index, count)))
            .map(|pose| ModelPose::of(clip.skeleton(), &pose))
            .collect();
        let face = |index| Face::at(faces, clip.rate(), data::moment(span, index, count));
        Some(Ready {
            faces: (0..count).map_while(face).collect(),
            framing: Framing::signing(&poses, anatomy),
            seconds: span.seconds(),
            body: self.body(clip.skeleton(), anatomy),
            anatomy: anatomy.clone(),
            poses,
        })
    }

    fn body(&mut self, skeleton: &Arc<Skeleton>, anatomy: &Anatomy) -> Arc<Body> {
        let same = |it: &&(Arc<Skeleton>, Anatomy, Arc<Body>)| {
            (Arc::ptr_eq(&it.0, skeleton) || it.0 == *skeleton) && it.1 == *anatomy
        };
        if let Some((_, _, body)) = self.bodies.iter().find(same) {
            return body.clone();
        }
        let body = Arc::new(Body::new(skeleton, anatomy));
        if self.bodies.len() >= BODIES {
            self.bodies.remove(0);
        }
        self.bodies
            .push((skeleton.clone(), anatomy.clone(), body.clone()));
        body
    }

    fn draw(&mut self, key: &Key, index: usize, ready: Option<&Ready>) -> ColorImage {
        let size = key.size.map(usize::from);
        let theme = if key.dark { Theme::Dark } else { Theme::Light };
        let style = Style {
            theme,
            ..Style::default()
        };
        let image = match (&key.source, ready) {
            (Source::Hand(left, angles), _) => hand_alone(*left, angles, size, theme),
            (_, Some(ready)) => Some(self.signer(ready, index, key.focus, (size, &style))),
            _ => None,
        };
        image.map_or_else(|| ColorImage::filled(size, paper(theme)), |it| pixels(&it))
    }

    fn signer(
        &mut self,
        ready: &Ready,
        index: usize,
        focus: Focus,
        (size, style): ([usize; 2], &Style),
    ) -> Image {
        let pose = &ready.poses[index];
        let (of, mesh) = &mut self.mesh;
        if of
            .as_ref()
            .is_none_or(|body| !Arc::ptr_eq(body, &ready.body))
        {
            *mesh = ready.body.mesh(pose);
            *of = Some(ready.body.clone());
        } else {
            ready.body.shape(pose, mesh);
        }
        if let Some(face) = ready.faces.get(index) {
            ready.body.express(pose, face, mesh);
        }
        let view = match focus {
            Focus::Signing => View::Addressee,
            Focus::Hand(side) => View::Hand(side),
            Focus::Face => View::Face,
        };
        let aspect = size[0] as f32 / size[1] as f32;
        let camera = ready.framing.camera(view, aspect, pose, &ready.anatomy);
        self.raster.draw(mesh, &camera, size, style)
    }
}

fn hand_alone(
    left: bool,
    angles: &[u64; HandAngles::LEN],
    size: [usize; 2],
    theme: Theme,
) -> Option<Image> {
    let usual = HandshapeOptions::small(size[0].min(size[1]));
    let options = HandshapeOptions {
        side: if left { Side::Left } else { Side::Right },
        style: Style {
            theme,
            ..usual.style
        },
        ..usual
    };
    let angles = HandAngles::from_array(angles.map(f64::from_bits));
    handshape_picture(&angles, &options).ok()
}

fn paper(theme: Theme) -> Color32 {
    let [r, g, b] = theme.background().0;
    Color32::from_rgb(r, g, b)
}

fn pixels(image: &Image) -> ColorImage {
    let pixels = image.pixels().iter();
    let pixels = pixels.map(|it| Color32::from_rgb(it.0[0], it.0[1], it.0[2]));
    ColorImage::new([image.width(), image.height()], pixels.collect())
}
