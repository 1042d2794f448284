//! Widgets of little figures: show finished pictures, and request the others.

use std::sync::Arc;

use chereme_motion::{BodySide, HandAngles};
use eframe::egui::emath::GuiRounding;
use eframe::egui::epaint::RectShape;
use eframe::egui::text::LayoutJob;
use eframe::egui::{
    Align, Color32, ColorImage, Galley, Rect, Stroke, StrokeKind, TextStyle, TextureOptions, Ui, Vec2, pos2, vec2,
};

use super::draw::{DrawingBoardState, MiniatureFilm, MiniatureMovement};
use super::{
    MiniatureCell, MiniatureFigures, MiniatureFocus, MiniatureMotion, MiniatureSource, MiniatureTexture,
    PictureStripKey, WindowThreadState, miniatures_data,
};
use crate::command::CommandOutbox;
use crate::model::generated::GeneratedClip;
use crate::words::{InterfaceLanguage, stage_words as words};
use crate::work::movement_jobs;

/// The most movements requested at once, so that figures that scroll out of sight leave no long queue.
const MAX_REQUESTED_MOVEMENTS: usize = 4;
/// Frames after which an unused texture is removed.
const TEXTURE_SWEEP_FRAMES: u64 = 60;
/// Interval between repaints of a playing loop, in seconds.
const LOOP_REPAINT_SECONDS: f64 = 1.0 / 30.0;
/// The radius of a picture's corners, in points.
const PICTURE_CORNER_RADIUS: f32 = 6.0;
/// All of a texture.
const WHOLE_TEXTURE_RECT: Rect = Rect {
    min: pos2(0.0, 0.0),
    max: pos2(1.0, 1.0),
};

/// The visible content of a cell.
enum CellSight {
    Picture(usize, Arc<ColorImage>),
    /// A picture in another form than the cell's, cut to it.
    Still(Arc<ColorImage>),
    Preparing,
    Nothing,
}

impl MiniatureFigures {
    /// Paints a little figure over `rect`; the caller handles clicks.
    pub(crate) fn paint_figure(
        &self,
        ui: &Ui,
        language: InterfaceLanguage,
        out: &CommandOutbox,
        cell: &MiniatureCell,
        rect: Rect,
    ) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        // A picture between pixels would be blurred.
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        let key = picture_strip_key(
            ui,
            MiniatureSource::from_miniature_motion(&cell.motion),
            cell.focus,
            rect.size(),
        );
        self.begin_drawing_frame(ui);
        let sight = {
            let mut state = self.board.lock_board_state();
            self.load_figure_movement(&mut state, &key.source, &cell.motion, out);
            strip_sight_at(&mut state, &key, cell.clock)
        };
        self.board.wake_drawing_thread();
        if cell.clock.is_some() {
            ui.ctx().request_repaint_after_secs(LOOP_REPAINT_SECONDS as f32);
        }
        self.put_cell_sight(ui, language, &key, sight, rect);
    }

    /// Paints movement outside of any corpus over `rect`, for the start page.
    pub(crate) fn paint_made(
        &self,
        ui: &Ui,
        language: InterfaceLanguage,
        made: &Arc<GeneratedClip>,
        clock: f64,
        rect: Rect,
        focus: MiniatureFocus,
    ) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        let motion = MiniatureMotion::Made(made.clone());
        let key = picture_strip_key(ui, MiniatureSource::from_miniature_motion(&motion), focus, rect.size());
        self.begin_drawing_frame(ui);
        let sight = {
            let mut state = self.board.lock_board_state();
            self.load_made(&mut state, &key.source, made);
            strip_sight_at(&mut state, &key, Some(clock))
        };
        self.board.wake_drawing_thread();
        ui.ctx().request_repaint_after_secs(LOOP_REPAINT_SECONDS as f32);
        self.put_cell_sight(ui, language, &key, sight, rect);
    }

    /// Paints a posture of one hand over `rect`.
    pub(crate) fn paint_hand(
        &self,
        ui: &Ui,
        language: InterfaceLanguage,
        side: BodySide,
        angles: &HandAngles,
        rect: Rect,
    ) {
        if !ui.is_rect_visible(rect) {
            return;
        }
        let source = MiniatureSource::Hand(side == BodySide::Left, angles.to_array().map(f64::to_bits));
        let square = Vec2::splat(rect.size().min_elem());
        let square_rect = Rect::from_center_size(rect.center(), square);
        let rect = square_rect.round_to_pixels(ui.pixels_per_point());
        let key = picture_strip_key(ui, source, MiniatureFocus::default(), square);
        self.begin_drawing_frame(ui);
        let sight = strip_sight_at(&mut self.board.lock_board_state(), &key, None);
        self.board.wake_drawing_thread();
        self.put_cell_sight(ui, language, &key, sight, rect);
    }

    /// Starts the thread if necessary, and gives it the number of the window's frame.
    fn begin_drawing_frame(&self, ui: &Ui) {
        let now = ui.ctx().cumulative_pass_nr();
        let mut cache = self.own.borrow_mut();
        let mut state = self.board.lock_board_state();
        state.now = now;
        if cache.thread.is_none() {
            state.window = Some(ui.ctx().clone());
            let board = self.board.clone();
            cache.thread = Some(std::thread::spawn(move || board.run_drawing_tasks()));
        }
        if now > cache.swept + TEXTURE_SWEEP_FRAMES {
            cache.swept = now;
            cache.textures.retain(|_, it| it.wanted + TEXTURE_SWEEP_FRAMES >= now);
            let WindowThreadState { made, textures, .. } = &mut *cache;
            // A freed movement's address may become another's, so that its pictures go with it.
            made.retain(|source, _| state.films.contains_key(source));
            let there = |key: &PictureStripKey| {
                !matches!(key.source, MiniatureSource::Made(_)) || made.contains_key(&key.source)
            };
            state.strips.retain(|key, _| there(key));
            textures.retain(|key, _| there(key));
        }
    }

    /// Loads the movement, unless it was requested before.
    fn load_figure_movement(
        &self,
        state: &mut DrawingBoardState,
        source: &MiniatureSource,
        motion: &MiniatureMotion,
        out: &CommandOutbox,
    ) {
        if let MiniatureMotion::Made(made) = motion {
            return self.load_made(state, source, made);
        }
        if state.films.contains_key(source) {
            return;
        }
        let mut cache = self.own.borrow_mut();
        let film = match motion {
            MiniatureMotion::Made(_) => return,
            // Requested later, if the figure is still visible then.
            MiniatureMotion::Span(..) if cache.asked.len() >= MAX_REQUESTED_MOVEMENTS => return,
            MiniatureMotion::Span(recording, span) => {
                let job = movement_jobs::load_stretch_job(*recording, *span, miniatures_data::loop_shown_span);
                cache.asked.insert(out.request_work(job), source.clone());
                MiniatureFilm::Loading
            }
        };
        state.films.insert(source.clone(), film);
    }

    fn load_made(&self, state: &mut DrawingBoardState, source: &MiniatureSource, made: &Arc<GeneratedClip>) {
        if !state.films.contains_key(source) {
            let mut cache = self.own.borrow_mut();
            cache.made.insert(source.clone(), made.clone());
            let film = MiniatureFilm::Loaded(MiniatureMovement::Made(made.clone()));
            state.films.insert(source.clone(), film);
        }
    }

    fn put_cell_sight(
        &self,
        ui: &Ui,
        language: InterfaceLanguage,
        key: &PictureStripKey,
        sight: CellSight,
        rect: Rect,
    ) {
        let pixels = rect.size() * ui.pixels_per_point();
        let mut options = TextureOptions::LINEAR;
        let (index, image, part) = match sight {
            CellSight::Picture(index, image) => {
                let exact = miniatures_data::one_to_one(image.size, [pixels.x, pixels.y]);
                // One picture pixel for each of the window's: smoothing would only blur.
                if exact.is_some() {
                    options = TextureOptions::NEAREST;
                }
                (index, image, exact.unwrap_or(WHOLE_TEXTURE_RECT))
            }
            CellSight::Still(image) => {
                let part = miniatures_data::middle_picture_part(image.size, [rect.width(), rect.height()]);
                (0, image, part)
            }
            CellSight::Preparing => return stand_in(ui, language, rect, true),
            CellSight::Nothing => return stand_in(ui, language, rect, false),
        };
        let mut cache = self.own.borrow_mut();
        let now = ui.ctx().cumulative_pass_nr();
        let texture = cache.textures.entry(key.clone()).or_insert_with(|| MiniatureTexture {
            handle: ui.ctx().load_texture("little", image.clone(), options),
            picture: index,
            wanted: now,
        });
        if texture.picture != index {
            texture.handle.set_partial([0, 0], image, options);
            texture.picture = index;
        }
        texture.wanted = now;
        let shape = RectShape::filled(rect, PICTURE_CORNER_RADIUS, Color32::WHITE);
        ui.painter().add(shape.with_texture(texture.handle.id(), part));
    }
}

fn picture_strip_key(ui: &Ui, source: MiniatureSource, focus: MiniatureFocus, size: Vec2) -> PictureStripKey {
    let size = size * ui.ctx().pixels_per_point();
    PictureStripKey {
        source,
        focus,
        size: miniatures_data::picture_pixel_size([size.x, size.y]),
        dark: ui.visuals().dark_mode,
    }
}

/// Returns the visible content of a strip at time `clock`, and marks the strip as wanted.
fn strip_sight_at(state: &mut DrawingBoardState, key: &PictureStripKey, clock: Option<f64>) -> CellSight {
    let now = state.now;
    let seconds = match state.films.get_mut(&key.source) {
        Some(MiniatureFilm::Nothing) => return CellSight::Nothing,
        Some(MiniatureFilm::Still(image, needed)) => {
            *needed = now;
            return CellSight::Still(image.clone());
        }
        Some(MiniatureFilm::Ready(ready, needed)) => {
            *needed = now;
            ready.seconds
        }
        _ => 0.0,
    };
    let strip = state.strips.entry(key.clone()).or_default();
    strip.wanted = now;
    let count = strip.pictures.len();
    if count == 0 {
        return CellSight::Preparing;
    }
    // A still figure shows the middle of its movement.
    let wanted = clock.map_or(count / 2, |clock| miniatures_data::index(clock, seconds, count));
    let there = |index: usize| strip.pictures[index].is_some();
    let index = miniatures_data::nearest_drawn_picture(there, wanted, count);
    match index.and_then(|index| Some((index, strip.pictures[index].clone()?))) {
        Some((index, image)) => CellSight::Picture(index, image),
        None => CellSight::Preparing,
    }
}

/// Paints the placeholder of a missing picture: head and shoulders, faintly.
fn stand_in(ui: &Ui, language: InterfaceLanguage, rect: Rect, coming: bool) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, PICTURE_CORNER_RADIUS, ui.visuals().extreme_bg_color);
    silhouette(ui, rect, coming);
    if !coming && rect.size().min_elem() > 90.0 {
        paint_text_below(
            ui,
            rect,
            words::LITTLE_NOTHING.text_in_language(language),
            TextStyle::Small,
        );
    }
}

/// Paints the placeholder of something without movement.
pub(crate) fn paint_still_placeholder(ui: &Ui, language: InterfaceLanguage, rect: Rect) {
    if ui.is_rect_visible(rect) {
        stand_in(ui, language, rect, false);
    }
}

/// Paints a placeholder of any size with a text.
pub(crate) fn paint_text_placeholder(ui: &Ui, rect: Rect, text: &str) {
    let unit = (rect.size().min_elem() * 0.5).min(220.0);
    let figure = Rect::from_center_size(rect.center() - vec2(0.0, unit * 0.2), Vec2::splat(unit));
    silhouette(ui, figure, false);
    let words = layout_centred_text(ui, text, TextStyle::Body, rect.width() - 36.0);
    let text_position = figure.center_bottom() + vec2(0.0, 8.0);
    ui.painter()
        .galley(text_position, words, ui.visuals().weak_text_color());
}

fn silhouette(ui: &Ui, rect: Rect, filled: bool) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let faint = ui.visuals().widgets.inactive.bg_fill;
    let unit = rect.size().min_elem();
    let head = rect.center() - vec2(0.0, unit * 0.2);
    let body = Rect::from_center_size(rect.center() + vec2(0.0, unit * 0.36), vec2(unit * 0.56, unit * 0.6));
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
fn paint_text_below(ui: &Ui, rect: Rect, text: &str, style: TextStyle) {
    let words = layout_centred_text(ui, text, style, rect.width() - 12.0);
    let text_position = rect.center_bottom() - vec2(0.0, words.size().y + 6.0);
    ui.painter()
        .galley(text_position, words, ui.visuals().weak_text_color());
}

/// Lays out faint text in centred lines; its origin is the middle of its upper edge.
fn layout_centred_text(ui: &Ui, text: &str, style: TextStyle, width: f32) -> Arc<Galley> {
    let font = style.resolve(ui.style());
    let colour = ui.visuals().weak_text_color();
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, width);
    job.halign = Align::Center;
    ui.painter().layout_job(job)
}
