//! The widgets of films: their pictures, and the controls that place them on the recording's clock.

use std::path::PathBuf;

use chereme_corpus::{RowName, TrackChange};
use chereme_motion::RecordingInstant;
use eframe::egui::{
    self, Align2, Button, Color32, DragValue, Label, Rect, RichText, Role, Sense, TextStyle, TextWrapMode, Ui,
    UiBuilder, WidgetInfo, WidgetText, pos2, vec2,
};

use crate::command::{ChooserPurpose, CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::film::projector::FilmFileState;
use crate::film::screen::FilmScreen;
use crate::model::InspectedThing;
use crate::window_remedy;
use crate::words::{fill_text_braces, film_words as words, translate_library_message};
use crate::work::recordings_jobs;

/// The height of the line of controls below a film, in points.
const CONTROL_LINE_HEIGHT: f32 = 26.0;
/// The least room for the button that holds a film and the film's start, in points.
const HOLD_BUTTON_WIDTH: f32 = 116.0;
/// The gap between films, in points.
const FILM_GAP_POINTS: f32 = 6.0;
/// The largest size of a picture in pixels; larger areas show it scaled.
const MAX_PICTURE_PIXELS: [usize; 2] = [1280, 1280];

/// Shows films next to each other, or above each other if that makes them larger.
pub(crate) fn show_film_screens(ui: &mut Ui, seen: &PaneInput<'_>, rect: Rect) {
    let mut screens = seen.films.borrow_screens();
    // Films that cannot be shown take a line each, below those that can.
    let shown = screens.iter().filter(|screen| !screen.is_missing()).count();
    let lines = match shown {
        0 => 0,
        shown => screens.len() - shown,
    };
    let (whole, foot) = rect.split_top_bottom_at_y(rect.bottom() - CONTROL_LINE_HEIGHT * lines as f32);
    let mut line = Rect::from_min_size(foot.min, vec2(foot.width(), CONTROL_LINE_HEIGHT));
    let mut screens: Vec<&mut FilmScreen> = screens.iter_mut().collect();
    if shown > 0 {
        screens.retain_mut(|screen| {
            if screen.is_missing() {
                show_missing_film_line(screen, ui, seen, line);
                line = line.translate(vec2(0.0, CONTROL_LINE_HEIGHT));
            }
            !screen.is_missing()
        });
    }
    let (count, rect) = (screens.len(), whole);
    if count == 0 {
        return;
    }
    let columns = best_column_count(count, rect.size());
    let rows = count.div_ceil(columns);
    let size = vec2(
        (rect.width() - FILM_GAP_POINTS * (columns - 1) as f32) / columns as f32,
        (rect.height() - FILM_GAP_POINTS * (rows - 1) as f32) / rows as f32,
    );
    for (at, screen) in screens.into_iter().enumerate() {
        let (column, row) = (at % columns, at / columns);
        let corner = vec2(
            column as f32 * (size.x + FILM_GAP_POINTS),
            row as f32 * (size.y + FILM_GAP_POINTS),
        );
        let cell = Rect::from_min_size(rect.min + corner, size);
        show_one_film(screen, ui, seen, cell);
    }
}

/// Returns how many columns make wide films largest.
fn best_column_count(count: usize, room: egui::Vec2) -> usize {
    let width = |columns: usize| {
        let rows = count.div_ceil(columns) as f32;
        let (wide, high) = (room.x / columns as f32, room.y / rows - CONTROL_LINE_HEIGHT);
        wide.min(high * 16.0 / 9.0)
    };
    let best = (1..=count).max_by(|a, b| width(*a).total_cmp(&width(*b)));
    best.unwrap_or(1)
}

fn show_one_film(screen: &mut FilmScreen, ui: &mut Ui, seen: &PaneInput<'_>, cell: Rect) {
    let player = &seen.shown.player;
    let current_time = player.player_playhead();
    let line = Rect::from_min_max(pos2(cell.left(), cell.bottom() - CONTROL_LINE_HEIGHT), cell.max);
    let room = cell.with_max_y(line.top() - 2.0);
    let scale = ui.ctx().pixels_per_point();
    let pixels = |side: f32, most: usize| ((side * scale) as usize / 16 * 16).clamp(64, most);
    let within = [
        pixels(room.width(), MAX_PICTURE_PIXELS[0]),
        pixels(room.height(), MAX_PICTURE_PIXELS[1]),
    ];
    let frame = screen.screen_frame_at(current_time);
    let playing = player.playback_direction() > 0.0 && seen.shown.made.is_none();
    screen.fetch_projected_picture(frame, within, playing, ui.ctx());
    let id = ui.unique_id().with(("film", screen.track.id));
    let response = ui.interact(room, id, Sense::click());
    let name = file_name_of_url(&screen.track.url);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name.clone()));
    ui.painter().rect_filled(room, 3.0, Color32::BLACK);
    match (&screen.news.known, frame) {
        (FilmFileState::Open(..), Some(frame)) => show_film_picture(screen, ui, seen, room, frame),
        (FilmFileState::Open(_, times), None) => {
            let film_time = current_time.instant_micros() - screen.film_offset_micros();
            let text = if film_time < times.film_frame_start(0) {
                words::NOT_BEGUN
            } else {
                words::IS_OVER
            };
            write_text(ui, room, seen.say_text(text));
        }
        (FilmFileState::Coming, _) => write_text(ui, room, seen.say_text(words::COMING)),
        (FilmFileState::Gone(_) | FilmFileState::Refused(..), _) => {
            write_text(ui, room, &unshown_film_reason(screen, seen))
        }
    }
    let mut builder = UiBuilder::new().max_rect(line);
    builder = builder.id_salt(("film line", screen.track.id));
    ui.scope_builder(builder, |ui| {
        ui.set_clip_rect(line.intersect(ui.clip_rect()));
        ui.horizontal(|ui| match screen.news.known {
            FilmFileState::Open(..) => controls(screen, ui, seen, current_time),
            FilmFileState::Coming => {}
            _ => offer_missing_film_remedies(screen, ui, seen),
        });
    });
}

/// Returns the reason why a film cannot be shown, and the remedy.
fn unshown_film_reason(screen: &FilmScreen, seen: &PaneInput<'_>) -> String {
    match &screen.news.known {
        FilmFileState::Gone(path) => {
            // Without the `.` of relative paths.
            let path = path.as_ref().map_or_else(
                || screen.track.url.clone(),
                |path| path.components().collect::<PathBuf>().display().to_string(),
            );
            fill_text_braces(seen.say_text(words::GONE), &[("path", &path)])
        }
        FilmFileState::Refused(why, remedy) => {
            let raw_remedy = remedy.as_ref();
            let remedy = raw_remedy.and_then(|remedy| window_remedy::window_remedy_text(remedy, seen.language));
            let parts = [Some(translate_library_message(why, seen.language)), remedy];
            let shown: Vec<String> = parts.into_iter().flatten().collect();
            shown.join("\n\n")
        }
        FilmFileState::Coming | FilmFileState::Open(..) => String::new(),
    }
}

/// Shows in one line that a film is missing, with the remedies; the reason is in its tip.
fn show_missing_film_line(screen: &mut FilmScreen, ui: &mut Ui, seen: &PaneInput<'_>, line: Rect) {
    // Meanwhile the film may be there again.
    screen.fetch_projected_picture(None, [64; 2], false, ui.ctx());
    let mut builder = UiBuilder::new().max_rect(line);
    builder = builder.id_salt(("missing film", screen.track.id));
    ui.scope_builder(builder, |ui| {
        ui.set_clip_rect(line.intersect(ui.clip_rect()));
        ui.horizontal(|ui| {
            offer_film_file_choice(screen, ui, seen);
            let name = file_name_of_url(&screen.track.url);
            let text = fill_text_braces(seen.say_text(words::MISSING), &[("name", &name)]);
            let label = Label::new(RichText::new(text).small().weak()).truncate();
            ui.add(label).on_hover_text(unshown_film_reason(screen, seen));
        });
    });
}

/// Shows the picture, or the reason for its absence.
fn show_film_picture(screen: &FilmScreen, ui: &Ui, seen: &PaneInput<'_>, room: Rect, frame: usize) {
    if let Some(texture) = &screen.texture {
        let size = texture.size_vec2();
        let share = (room.width() / size.x).min(room.height() / size.y);
        let place = Rect::from_center_size(room.center(), size * share);
        let full_uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture.id(), place, full_uv, Color32::WHITE);
    }
    let damaged = screen.news.damaged.as_ref().filter(|damage| damage.0 == frame);
    if let Some((_, why)) = damaged {
        write_text(ui, room, why);
    }
    if screen.loose.is_some() {
        let stroke = egui::Stroke::new(2.0, seen.pane_colours().accent);
        let inside = egui::StrokeKind::Inside;
        ui.painter().rect_stroke(room, 3.0, stroke, inside);
    }
}

/// Writes a text on the dark background.
fn write_text(ui: &Ui, room: Rect, text: &str) {
    let painter = ui.painter().with_clip_rect(room.intersect(ui.clip_rect()));
    let white = Color32::from_gray(230);
    let styled_galley = |style: TextStyle| {
        let width = (room.width() - 24.0).max(40.0);
        painter.layout(text.to_owned(), style.resolve(ui.style()), white, width)
    };
    let mut galley = styled_galley(TextStyle::Body);
    if galley.size().y > room.height() - 12.0 {
        galley = styled_galley(TextStyle::Small);
    }
    let mut place = Align2::CENTER_CENTER.anchor_size(room.center(), galley.size());
    // A text that is too long still begins in sight.
    let down = (room.top() + 6.0 - place.top()).max(0.0);
    place = place.translate(vec2(0.0, down));
    let back = place.expand(6.0);
    painter.rect_filled(back, 4.0, Color32::from_black_alpha(170));
    painter.galley(place.min, galley, white);
}

/// Offers remedies for a film that cannot be found.
fn offer_missing_film_remedies(screen: &FilmScreen, ui: &mut Ui, seen: &PaneInput<'_>) {
    offer_film_file_choice(screen, ui, seen);
    if ui.small_button(seen.say_text(words::ABOUT)).clicked() {
        seen.send_command(WindowCommand::Inspect(InspectedThing::Recording(
            screen.track.recording_id,
        )));
    }
}

/// Offers to choose the file of a film.
fn offer_film_file_choice(screen: &FilmScreen, ui: &mut Ui, seen: &PaneInput<'_>) {
    if ui.small_button(seen.say_text(words::FIND)).clicked() {
        let (recording, track) = (screen.track.recording_id, screen.track.id);
        seen.send_command(WindowCommand::Choose(ChooserPurpose::Media(recording, Some(track))));
    }
}

/// Shows the controls of the film: step by frames, hold a frame, align the held frame with the playhead, and the film's
/// start.
fn controls(screen: &mut FilmScreen, ui: &mut Ui, seen: &PaneInput<'_>, at: RecordingInstant) {
    let Some(times) = screen.frame_times().cloned() else {
        return;
    };
    ui.spacing_mut().item_spacing.x = 4.0;
    let last = times.film_frame_count().saturating_sub(1);
    for (sign, text, hint) in [(-1_i64, "◀", words::BACK), (1, "▶", words::FORWARD)] {
        let name = seen.say_text(hint);
        let button = ui.add(Button::new(text).small());
        button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
        if !button.on_hover_text(name).clicked() {
            continue;
        }
        match &mut screen.loose {
            Some(frame) => *frame = frame.saturating_add_signed(sign as isize).min(last),
            None => {
                if let Some(next) = screen.step_film_frame(at, sign) {
                    seen.send_command(WindowCommand::Cue(next));
                }
            }
        }
    }
    let is_held = screen.loose.is_some();
    if is_held || ui.available_width() >= HOLD_BUTTON_WIDTH {
        let hold = ui.selectable_label(is_held, seen.say_text(words::HOLD));
        if hold.on_hover_text(seen.say_text(words::HOLD_HINT)).clicked() {
            screen.loose = match is_held {
                true => None,
                false => Some(screen.screen_frame_at(at).unwrap_or_default()),
            };
        }
    }
    if let Some(frame) = screen.loose {
        let here = ui.small_button(seen.say_text(words::HERE));
        let hint = seen.say_text(words::HERE_HINT);
        if here.on_hover_text(hint).clicked()
            && let Some(offset) = screen.offset_for_frame(frame, at)
        {
            lay_film_offset(screen, seen.out, offset);
            screen.loose = None;
        }
    }
    show_film_offset(screen, ui, seen);
    let frame = screen.screen_frame_at(at).map_or(0, |frame| frame + 1);
    let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &frame), ("all", &times.film_frame_count())];
    let long = fill_text_braces(seen.say_text(words::FRAME_OF), &values);
    let fits = |text: &String| {
        let text = WidgetText::from(RichText::new(text).small());
        let galley = text.into_galley(ui, Some(TextWrapMode::Extend), 0.0, TextStyle::Small);
        galley.size().x <= ui.available_width()
    };
    // Without room for the words the numbers are enough, and the tip has the rest.
    let short = format!("{frame} / {}", times.film_frame_count());
    let mut texts = [long.clone(), short].into_iter();
    let text = texts.find(fits).unwrap_or_else(|| "…".to_owned());
    let label = ui.label(RichText::new(text).small().weak());
    label.widget_info(|| WidgetInfo::labeled(Role::Label, true, &long));
    if let FilmFileState::Open(facts, _) = &screen.news.known {
        let findings = facts.findings.join("\n");
        let tip = format!(
            "{}\n{}, {} × {}, {:.3}/s ({})\n{findings}",
            screen.track.url, facts.coding, facts.width, facts.height, facts.rate, facts.decoder
        );
        label.on_hover_text(tip.trim_end());
    }
}

/// Shows the start of the film on the recording's clock, to be dragged or typed; the corpus is changed once, on
/// release.
fn show_film_offset(screen: &mut FilmScreen, ui: &mut Ui, seen: &PaneInput<'_>) {
    let mut seconds = screen.film_offset_micros() as f64 / 1e6;
    let field = DragValue::new(&mut seconds)
        .speed(0.005)
        .fixed_decimals(3)
        .range(-86_400.0..=86_400.0)
        .suffix(" s");
    let response = ui.add(field);
    let name = seen.say_text(words::OFFSET);
    response.widget_info(|| WidgetInfo {
        value: Some(seconds),
        ..WidgetInfo::labeled(Role::SpinButton, true, name)
    });
    if response.changed() {
        screen.dragged = Some((seconds * 1e6).round() as i64);
    }
    let done = response.drag_stopped() || response.lost_focus();
    if done && let Some(offset) = screen.dragged {
        lay_film_offset(screen, seen.out, offset);
    }
    response.on_hover_text(seen.say_text(words::OFFSET_HINT));
}

/// Sets the start of the film, in microseconds on the recording's clock.
fn lay_film_offset(screen: &mut FilmScreen, out: &CommandOutbox, offset: i64) {
    if offset == screen.track.offset_us {
        screen.dragged = None;
        return;
    }
    // The film stays there until the corpus has been changed.
    screen.dragged = Some(offset);
    let recording = RowName::Number(screen.track.recording_id);
    let track = screen.track.name.clone();
    out.request_work(recordings_jobs::change_track(
        recording,
        track,
        TrackChange::Offset(offset),
    ));
}

/// Returns the name of the file at the end of a path or address.
fn file_name_of_url(url: &str) -> String {
    url.rsplit(['/', '\\']).next().unwrap_or(url).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_are_arranged_to_be_as_large_as_possible() {
        assert_eq!(best_column_count(1, vec2(400.0, 300.0)), 1);
        assert_eq!(best_column_count(2, vec2(1200.0, 400.0)), 2);
        assert_eq!(best_column_count(2, vec2(400.0, 900.0)), 1);
        assert_eq!(best_column_count(4, vec2(1280.0, 800.0)), 2);
    }

    #[test]
    fn film_files_are_named_by_the_end_of_their_path() {
        assert_eq!(file_name_of_url("file:///D:/films/a b.mp4"), "a b.mp4");
        assert_eq!(file_name_of_url("D:\\films\\take.mov"), "take.mov");
    }
}
