//! Widgets of little figures: show finished pictures, and request the others.

use std::sync::Arc;

use chereme_motion::{HandAngles, Side};
use eframe::egui::emath::GuiRounding;
use eframe::egui::epaint::RectShape;
use eframe::egui::text::LayoutJob;
use eframe::egui::{
    Align, Color32, ColorImage, Galley, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle,
    TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::draw::{Film, Movement, State};
use super::{Cell, Figures, Focus, Key, Motion, Own, Source, Texture, data};
use crate::context::{Outbox, PaneInput};
use crate::model::generated::GeneratedClip;
use crate::words::{Language, stage as words};
use crate::work::movement;

/// The most movements requested at once, so that figures that scroll out of sight leave no long queue.
const ASKED: usize = 4;
/// Frames after which an unused texture is removed.
const SWEEP: u64 = 60;
/// Interval between repaints of a playing loop, in seconds.
const BEAT: f64 = 1.0 / 30.0;
/// The radius of a picture's corners, in points.
const RADIUS: f32 = 6.0;
/// All of a texture.
const WHOLE: Rect = Rect {
    min: pos2(0.0, 0.0),
    max: pos2(1.0, 1.0),
};

/// The visible content of a cell.
enum Sight {
    Picture(usize, Arc<ColorImage>),
    /// A picture in another form than the cell's, cut to it.
    Still(Arc<ColorImage>),
    Preparing,
    Nothing,
}

impl Figures {
    #[allow(dead_code, reason = "for results and cards")]
    /// Shows a little figure as a clickable widget with the accessible name `name`.
    pub(crate) fn show(
        &self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        cell: &Cell,
        name: &str,
    ) -> Response {
        let (rect, response) = ui.allocate_exact_size(cell.size, Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
        self.paint(ui, seen, out, cell, rect);
        edge(ui, &response, rect);
        response
    }

    /// Paints a little figure over `rect`; the caller handles clicks.
    pub(crate) fn paint(
        &self,
        ui: &Ui,
        seen: &PaneInput<'_>,
        out: &mut Outbox,
        cell: &Cell,
        rect: Rect,
    ) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        let key = key(ui, Source::of(&cell.motion), cell.focus, rect.size());
        self.begin(ui);
        let sight = {
            let mut state = self.board.state();
            self.load(&mut state, &key.source, &cell.motion, out);
            look(&mut state, &key, cell.clock)
        };
        self.board.wake();
        if cell.clock.is_some() {
            ui.ctx().request_repaint_after_secs(BEAT as f32);
        }
        self.put(ui, seen.language, &key, sight, rect);
    }

    /// Paints movement outside of any corpus over `rect`, for the start page.
    pub(crate) fn paint_made(
        &self,
        ui: &Ui,
        language: Language,
        (made, clock): (&Arc<GeneratedClip>, f64),
        rect: Rect,
        focus: Focus,
    ) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        let motion = Motion::Made(made.clone());
        let key = key(ui, Source::of(&motion), focus, rect.size());
        self.begin(ui);
        let sight = {
            let mut state = self.board.state();
            self.load_made(&mut state, &key.source, made);
            look(&mut state, &key, Some(clock))
        };
        self.board.wake();
        ui.ctx().request_repaint_after_secs(BEAT as f32);
        self.put(ui, language, &key, sight, rect);
    }

    /// Shows a posture of one hand, with the accessible name `name`: the picture of a handshape.
    #[allow(dead_code, reason = "for pickers")]
    pub(crate) fn hand(
        &self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        (side, angles): (Side, &HandAngles),
        size: Vec2,
        name: &str,
    ) -> Response {
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
        self.paint_hand(ui, seen.language, (side, angles), rect);
        edge(ui, &response, rect);
        response
    }

    /// Paints a posture of one hand over `rect`.
    pub(crate) fn paint_hand(
        &self,
        ui: &Ui,
        language: Language,
        (side, angles): (Side, &HandAngles),
        rect: Rect,
    ) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        let source = Source::Hand(side == Side::Left, angles.to_array().map(f64::to_bits));
        let square = Vec2::splat(rect.size().min_elem());
        let rect = Rect::from_center_size(rect.center(), square);
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        let key = key(ui, source, Focus::default(), square);
        self.begin(ui);
        let sight = look(&mut self.board.state(), &key, None);
        self.board.wake();
        self.put(ui, language, &key, sight, rect);
    }

    /// Starts the thread if necessary, and gives it the number of the window's frame.
    fn begin(&self, ui: &Ui) {
        let now = ui.ctx().cumulative_pass_nr();
        let mut own = self.own.borrow_mut();
        let mut state = self.board.state();
        state.now = now;
        if own.thread.is_none() {
            state.window = Some(ui.ctx().clone());
            let board = self.board.clone();
            own.thread = Some(std::thread::spawn(move || board.work()));
        }
        if now > own.swept + SWEEP {
            own.swept = now;
            own.textures.retain(|_, it| it.wanted + SWEEP >= now);
            let Own { made, textures, .. } = &mut *own;
            made.retain(|source, _| state.films.contains_key(source));
            let there = |key: &Key| {
                !matches!(key.source, Source::Made(_)) || made.contains_key(&key.source)
            };
            state.strips.retain(|key, _| there(key));
            textures.retain(|key, _| there(key));
        }
    }

    /// Loads the movement, unless it was requested before.
    fn load(&self, state: &mut State, source: &Source, motion: &Motion, out: &mut Outbox) {
        if let Motion::Made(made) = motion {
            return self.load_made(state, source, made);
        }
        if state.films.contains_key(source) {
            return;
        }
        let mut own = self.own.borrow_mut();
        let film = match motion {
            Motion::Made(_) => return,
            Motion::Span(..) if own.asked.len() >= ASKED => return,
            Motion::Span(recording, span) => {
                let job = movement::stretch(*recording, *span);
                own.asked.insert(out.work(job), source.clone());
                Film::Loading
            }
        };
        state.films.insert(source.clone(), film);
    }

    fn load_made(&self, state: &mut State, source: &Source, made: &Arc<GeneratedClip>) {
        if !state.films.contains_key(source) {
            let mut own = self.own.borrow_mut();
            own.made.insert(source.clone(), made.clone());
            let film = Film::Loaded(Movement::Made(made.clone()));
            state.films.insert(source.clone(), film);
        }
    }

    fn put(&self, ui: &Ui, language: Language, key: &Key, sight: Sight, rect: Rect) {
        let pixels = rect.size() * ui.pixels_per_point();
        let mut options = TextureOptions::LINEAR;
        let (index, image, part) = match sight {
            Sight::Picture(index, image) => {
                let exact = data::one_to_one(image.size, [pixels.x, pixels.y]);
                if exact.is_some() {
                    options = TextureOptions::NEAREST;
                }
                (index, image, exact.unwrap_or(WHOLE))
            }
            Sight::Still(image) => {
                let part = data::middle(image.size, [rect.width(), rect.height()]);
                (0, image, part)
            }
            Sight::Preparing => return stand_in(ui, language, rect, true),
            Sight::Nothing => return stand_in(ui, language, rect, false),
        };
        let mut own = self.own.borrow_mut();
        let now = ui.ctx().cumulative_pass_nr();
        let texture = own.textures.entry(key.clone()).or_insert_with(|| Texture {
            handle: ui.ctx().load_texture("little", image.clone(), options),
            picture: index,
            wanted: now,
        });
        if texture.picture != index {
            texture.handle.set_partial([0, 0], image, options);
            texture.picture = index;
        }
        texture.wanted = now;
        let shape = RectShape::filled(rect, RADIUS, Color32::WHITE);
        ui.painter()
            .add(shape.with_texture(texture.handle.id(), part));
    }
}

fn key(ui: &Ui, source: Source, focus: Focus, size: Vec2) -> Key {
    let size = size * ui.ctx().pixels_per_point();
    Key {
        source,
        focus,
        size: data::pixels([size.x, size.y]),
        dark: ui.visuals().dark_mode,
    }
}

/// Returns the visible content of a strip at time `clock`, and marks the strip as wanted.
fn look(state: &mut State, key: &Key, clock: Option<f64>) -> Sight {
    let now = state.now;
    let seconds = match state.films.get_mut(&key.source) {
        Some(Film::Nothing) => return Sight::Nothing,
        Some(Film::Still(image, needed)) => {
            *needed = now;
            return Sight::Still(image.clone());
        }
        Some(Film::Ready(ready, needed)) => {
            *needed = now;
            ready.seconds
        }
        _ => 0.0,
    };
    let strip = state.strips.entry(key.clone()).or_default();
    strip.wanted = now;
    let count = strip.pictures.len();
    if count == 0 {
        return Sight::Preparing;
    }
    let wanted = clock.map_or(count / 2, |clock| data::index(clock, seconds, count));
    let there = |index: usize| strip.pictures[index].is_some();
    let index = data::nearest(there, wanted, count);
    match index.and_then(|index| Some((index, strip.pictures[index].clone()?))) {
        Some((index, image)) => Sight::Picture(index, image),
        None => Sight::Preparing,
    }
}

/// Paints the edge of a clickable cell under the pointer or with the focus.
fn edge(ui: &Ui, response: &Response, rect: Rect) {
    let stroke = if response.has_focus() {
        Stroke::new(2.0, ui.visuals().hyperlink_color)
    } else if response.hovered() {
        ui.visuals().widgets.hovered.bg_stroke
    } else {
        return;
    };
    ui.painter()
        .rect_stroke(rect, RADIUS, stroke, StrokeKind::Inside);
}

/// Paints the placeholder of a missing picture: head and shoulders, faintly.
fn stand_in(ui: &Ui, language: Language, rect: Rect, coming: bool) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, RADIUS, ui.visuals().extreme_bg_color);
    silhouette(ui, rect, coming);
    if !coming && rect.size().min_elem() > 90.0 {
        below(
            ui,
            rect,
            words::LITTLE_NOTHING.of(language),
            TextStyle::Small,
        );
    }
}

/// Paints the placeholder of something without movement.
pub(crate) fn still(ui: &Ui, language: Language, rect: Rect) {
    if ui.is_rect_visible(rect) {
        stand_in(ui, language, rect, false);
    }
}

/// Paints a placeholder of any size with a text.
pub(crate) fn empty(ui: &Ui, rect: Rect, text: &str) {
    let unit = (rect.size().min_elem() * 0.5).min(220.0);
    let figure = Rect::from_center_size(rect.center() - vec2(0.0, unit * 0.2), Vec2::splat(unit));
    silhouette(ui, figure, false);
    let words = centred(ui, text, TextStyle::Body, rect.width() - 36.0);
    let at = figure.center_bottom() + vec2(0.0, 8.0);
    ui.painter()
        .galley(at, words, ui.visuals().weak_text_color());
}

fn silhouette(ui: &Ui, rect: Rect, filled: bool) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let faint = ui.visuals().widgets.inactive.bg_fill;
    let unit = rect.size().min_elem();
    let head = rect.center() - vec2(0.0, unit * 0.2);
    let body = Rect::from_center_size(
        rect.center() + vec2(0.0, unit * 0.36),
        vec2(unit * 0.56, unit * 0.6),
    );
    if filled {
        painter.circle_filled(head, unit * 0.13, faint);
        painter.rect_filled(body, unit * 0.2, faint);
    } else {
        let stroke = Stroke::new(1.5, faint);
        painter.circle_stroke(head, unit * 0.13, stroke);
        painter.rect_stroke(body, unit * 0.2, stroke, StrokeKind::Inside);
    }
}

/// Writes `text` along the lower edge of `rect`.
fn below(ui: &Ui, rect: Rect, text: &str, style: TextStyle) {
    let words = centred(ui, text, style, rect.width() - 12.0);
    let at = rect.center_bottom() - vec2(0.0, words.size().y + 6.0);
    ui.painter()
        .galley(at, words, ui.visuals().weak_text_color());
}

/// Lays out faint text in centred lines; its origin is the middle of its upper edge.
fn centred(ui: &Ui, text: &str, style: TextStyle, width: f32) -> Arc<Galley> {
    let font = style.resolve(ui.style());
    let colour = ui.visuals().weak_text_color();
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, width);
    job.halign = Align::Center;
    ui.painter().layout_job(job)
}
