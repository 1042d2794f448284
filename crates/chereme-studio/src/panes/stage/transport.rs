//! The transport: a bar with small annotations, and the buttons below it.

use chereme_corpus::TierRole;
use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use eframe::egui::{
    self, Button, Color32, ComboBox, CornerRadius, Key, Painter, Rect, Response, RichText, Role, Sense, Shape, Stroke,
    StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::panes::timeline::timeline_data::time_text;
use crate::player::PLAYBACK_SPEEDS;
use crate::words::{InterfaceText, fill_text_braces, stage_words as words};

const TRANSPORT_BAR_HEIGHT_POINTS: f32 = 26.0;
const TRANSPORT_BUTTON_SIZE_POINTS: Vec2 = vec2(30.0, 26.0);

/// Shows the bar and the buttons; `low` if the stage has little height; `more` is called after the buttons.
pub(super) fn show_transport_bar(ui: &mut Ui, seen: &PaneInput<'_>, low: bool, more: impl FnOnce(&mut Ui)) {
    ui.spacing_mut().item_spacing = vec2(4.0, if low { 2.0 } else { 4.0 });
    ui.add_space(if low { 2.0 } else { 4.0 });
    show_playback_bar(ui, seen);
    ui.horizontal_wrapped(|ui| {
        let player = seen.shown.on_stage();
        let playing = player.is_playing();
        show_transport_button(ui, seen, TransportIcon::Start, Action::ToStart, None);
        show_transport_button(ui, seen, TransportIcon::Back, Action::FrameBack, None);
        let (icon, text) = if playing {
            (TransportIcon::Pause, words::PAUSE)
        } else {
            (TransportIcon::Play, words::PLAY)
        };
        show_transport_button(ui, seen, icon, Action::Play, Some(text));
        show_transport_button(ui, seen, TransportIcon::Forward, Action::FrameForward, None);
        show_transport_button(ui, seen, TransportIcon::End, Action::ToEnd, None);
        let looping = TransportIcon::Loop(player.looping);
        show_transport_button(ui, seen, looping, Action::Loop, Some(words::LOOP));
        show_speed_menu(ui, seen);
        let rate = playback_frame_rate(seen);
        let (now, all) = (
            time_text(player.player_playhead()),
            time_text(player.whole.span_end_instant()),
        );
        go_to(ui, seen, &now);
        if !low || ui.available_size_before_wrap().x > 170.0 {
            ui.label(RichText::new(format!("/ {all}")).monospace().weak());
        }
        if let Some(rate) = rate.filter(|_| !low) {
            let text = match movement_end(seen).filter(|end| player.player_playhead() >= *end) {
                Some(end) => fill_text_braces(seen.say_text(words::NO_MORE), &[("time", &time_text(end))]),
                None => {
                    let (at, made) = (player.player_playhead(), seen.shown.made.as_ref());
                    let (frame, frames) = match made.map(|showing| showing.made.clip.clip_frame_count()) {
                        Some(frames) => ((rate.nearest_frame_at(at) + 1).min(frames), frames),
                        None => seen.reel.frame_number(at),
                    };
                    let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &frame), ("all", &frames)];
                    fill_text_braces(seen.say_text(words::FRAME_OF), &values)
                }
            };
            ui.label(RichText::new(text).small().weak());
        }
        more(ui);
    });
}

/// Shows the time of the playhead; a click lets the user type another.
fn go_to(ui: &mut Ui, seen: &PaneInput<'_>, now: &str) {
    let time = RichText::new(now).monospace().strong();
    let button = ui.add(Button::new(time).frame_when_inactive(false));
    let name = seen.say_text(Action::GoToTime.action_row().name);
    button.widget_info(|| WidgetInfo {
        current_text_value: Some(now.to_owned()),
        ..WidgetInfo::labeled(Role::Button, true, name)
    });
    let keys = seen.keys.action_keys_text(Action::GoToTime);
    if button.on_hover_text(format!("{name} ({keys})")).clicked() {
        seen.send_command(WindowCommand::Do(Action::GoToTime));
    }
}

fn playback_frame_rate(seen: &PaneInput<'_>) -> Option<FrameRate> {
    let made = seen
        .shown
        .made
        .as_ref()
        .map(|showing| showing.made.clip.clip_frame_rate());
    made.or_else(|| seen.reel.reel_frame_rate())
}

/// Returns the end of the recorded movement if annotations continue beyond it.
fn movement_end(seen: &PaneInput<'_>) -> Option<RecordingInstant> {
    if seen.shown.made.is_some() {
        return None;
    }
    let (frames, rate) = (seen.reel.reel_frame_count(), seen.reel.reel_frame_rate()?);
    let end = RecordingInstant::from_micros((frames as f64 / rate.per_second() * 1e6) as i64);
    let whole_end = seen.shown.player.whole.span_end_instant();
    let frame = (1e6 / rate.per_second()) as i64;
    (frames > 0 && end.shifted_instant(2 * frame) < whole_end).then_some(end)
}

/// Returns the annotations that are distinguishable on a bar of that many pixels, as shares of its width.
///
/// `starts` must be in order; annotations within the same pixel are joined.
fn annotation_tick_shares(starts: &[i64], ends: &[i64], whole: TimeSpan, pixels: f32) -> Vec<[f32; 2]> {
    let length = whole.span_micros().max(1) as f64;
    let pixel = (length / f64::from(pixels.max(1.0))) as i64;
    let share = |at: i64| ((at - whole.span_start_instant().instant_micros()) as f64 / length) as f32;
    let mut ticks = Vec::new();
    let mut index = 0;
    while let (Some(&start), Some(&end)) = (starts.get(index), ends.get(index)) {
        ticks.push([share(start), share(end.max(start + pixel))]);
        let beyond = start.saturating_add(pixel.max(1));
        index += starts[index..]
            .partition_point(|later_start| *later_start < beyond)
            .max(1);
    }
    ticks
}

/// Shows the bar: annotations of the chosen tier or of the glosses, the selected time, the playhead.
fn show_playback_bar(ui: &mut Ui, seen: &PaneInput<'_>) {
    let player = seen.shown.on_stage();
    let size = vec2(ui.available_width(), TRANSPORT_BAR_HEIGHT_POINTS);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let seconds = player.player_playhead().instant_seconds();
    response.widget_info(|| WidgetInfo::slider(true, seconds, seen.say_text(words::TIME)));
    let track = rect.shrink2(vec2(6.0, 5.0));
    let length = player.whole.span_micros().max(1) as f64;
    let start = player.whole.span_start_instant().instant_micros();
    let x =
        |at: RecordingInstant| track.left() + track.width() * ((at.instant_micros() - start) as f64 / length) as f32;
    let time = |x: f32| {
        let share = f64::from(((x - track.left()) / track.width().max(1.0)).clamp(0.0, 1.0));
        RecordingInstant::from_micros(start + (length * share) as i64)
    };
    let pressed = response.is_pointer_button_down_on() || response.clicked();
    if let Some(at) = response.interact_pointer_pos().filter(|_| pressed) {
        seen.send_command(WindowCommand::Cue(time(at.x)));
    }
    let colours = seen.pane_colours();
    let painter = ui.painter_at(rect);
    let visuals = ui.visuals();
    painter.rect_filled(track, 4.0, visuals.widgets.inactive.bg_fill);
    if let Some(end) = movement_end(seen) {
        // There is no movement in this part.
        let still = Rect::from_x_y_ranges(x(end)..=track.right(), track.y_range());
        painter.rect_filled(still, 4.0, visuals.extreme_bg_color);
    }
    if seen.shown.made.is_none() {
        if let Some(span) = seen.shown.span {
            let chosen = Rect::from_x_y_ranges(
                x(span.span_start_instant())..=x(span.span_end_instant()),
                track.y_range(),
            );
            painter.rect_filled(chosen, 0.0, colours.selection);
        }
        paint_bar_annotations(&painter, seen, track, player.whole);
    }
    let part = player.part.unwrap_or(player.whole);
    if player.part.is_some() {
        let rect = Rect::from_x_y_ranges(
            x(part.span_start_instant())..=x(part.span_end_instant()),
            rect.y_range(),
        );
        let stroke = Stroke::new(1.0, colours.accent);
        painter.rect_stroke(rect, 3.0, stroke, StrokeKind::Inside);
    }
    let done = Rect::from_min_max(
        pos2(track.left(), track.bottom() - 3.0),
        pos2(x(player.player_playhead()), track.bottom()),
    );
    painter.rect_filled(done, CornerRadius::same(1), colours.playhead);
    let head = x(player.player_playhead());
    painter.vline(head, rect.y_range(), Stroke::new(2.0, colours.playhead));
    painter.circle_filled(pos2(head, rect.top() + 4.0), 4.0, colours.playhead);
    if response.has_focus() {
        let stroke = Stroke::new(1.5, colours.accent);
        painter.rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
        handle_playback_keys(ui, &response, seen.out);
    }
    let hovered = response.hover_pos().filter(|_| !response.dragged());
    if let Some(at) = hovered.filter(|_| player.whole.span_micros() > 0) {
        painter.vline(at.x, track.y_range(), Stroke::new(1.0, visuals.weak_text_color()));
        // The tooltip is above the bar, as the time of the playhead is below.
        let layer = egui::LayerId::new(egui::Order::Tooltip, response.id);
        let above = ui.ctx().layer_painter(layer);
        let edge = 34.0_f32.min(rect.width() / 2.0);
        let x = at.x.clamp(rect.left() + edge, rect.right() - edge);
        let place = pos2(x, rect.top() - 3.0);
        let text = time_text(time(at.x));
        super::stage_ui::chip_on(&above, ui, place, egui::Align2::CENTER_BOTTOM, &text);
    }
}

/// Moves by frames with the arrow keys while the bar has the focus.
fn handle_playback_keys(ui: &Ui, response: &Response, out: &CommandOutbox) {
    ui.memory_mut(|memory| {
        let filter = egui::EventFilter {
            horizontal_arrows: true,
            ..egui::EventFilter::default()
        };
        memory.set_focus_lock_filter(response.id, filter);
    });
    for (key, action) in [
        (Key::ArrowLeft, Action::FrameBack),
        (Key::ArrowRight, Action::FrameForward),
    ] {
        if ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, key)) {
            out.send_command(WindowCommand::Do(action));
        }
    }
}

fn paint_bar_annotations(painter: &Painter, seen: &PaneInput<'_>, track: Rect, whole: TimeSpan) {
    let contents = seen.shown.recording.and_then(|id| seen.snapshot.recording_contents(id));
    let Some(tiers) = contents.map(|contents| &contents.tiers) else {
        return;
    };
    let chosen = tiers.iter().find(|tier| Some(tier.row.id) == seen.shown.tier);
    let tier = chosen.or_else(|| tiers.iter().find(|tier| tier.row.role == TierRole::Gloss));
    let Some(tier) = tier else { return };
    let colour = seen.pane_colours().tier_role_colour(&tier.row.role);
    let columns = &tier.annotations;
    for [from, to] in annotation_tick_shares(&columns.starts, &columns.ends, whole, track.width() / 2.0) {
        let x = |share: f32| track.left() + track.width() * share.clamp(0.0, 1.0);
        let (left, right) = (x(from), (x(to) - 1.0).max(x(from) + 1.0));
        let rows = track.top() + 4.0..=track.bottom() - 4.0;
        let rect = Rect::from_x_y_ranges(left..=right, rows);
        painter.rect_filled(rect, 2.0, colour.gamma_multiply(0.85));
    }
}

#[derive(Clone, Copy, PartialEq)]
enum TransportIcon {
    Start,
    Back,
    Play,
    Pause,
    Forward,
    End,
    Loop(bool),
}

fn show_transport_button(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    icon: TransportIcon,
    action: Action,
    text: Option<InterfaceText>,
) {
    let name = seen.say_text(text.unwrap_or(action.action_row().name));
    let (rect, response) = ui.allocate_exact_size(TRANSPORT_BUTTON_SIZE_POINTS, Sense::click());
    let on = icon == TransportIcon::Loop(true);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, name));
    let visuals = ui.style().interact_selectable(&response, on);
    let (fill, stroke) = (visuals.weak_bg_fill, visuals.bg_stroke);
    let edge = if response.has_focus() {
        Stroke::new(2.0, seen.pane_colours().accent)
    } else {
        stroke
    };
    ui.painter().rect(rect, 5.0, fill, edge, StrokeKind::Inside);
    draw_transport_icon(ui.painter(), icon, rect.center(), visuals.text_color());
    let keys = seen.keys.action_keys_text(action);
    let hint = if keys.is_empty() {
        name.to_owned()
    } else {
        format!("{name} ({keys})")
    };
    if response.on_hover_text(hint).clicked() {
        seen.send_command(WindowCommand::Do(action));
    }
}

fn draw_transport_icon(painter: &Painter, icon: TransportIcon, at: egui::Pos2, colour: Color32) {
    let triangle = |x: f32, sign: f32| {
        let tip = [
            vec2(x + 4.5 * sign, 0.0),
            vec2(x - 3.5 * sign, -5.5),
            vec2(x - 3.5 * sign, 5.5),
        ];
        painter.add(Shape::convex_polygon(
            tip.map(|corner| at + corner).to_vec(),
            colour,
            Stroke::NONE,
        ));
    };
    let bar = |x: f32, width: f32| {
        let rect = Rect::from_center_size(at + vec2(x, 0.0), vec2(width, 11.0));
        painter.rect_filled(rect, 0.5, colour);
    };
    match icon {
        TransportIcon::Play => triangle(0.0, 1.35),
        TransportIcon::Pause => {
            bar(-3.0, 3.0);
            bar(3.0, 3.0);
        }
        TransportIcon::Start => {
            bar(-5.0, 2.0);
            triangle(1.5, -1.0);
        }
        TransportIcon::End => {
            bar(5.0, 2.0);
            triangle(-1.5, 1.0);
        }
        TransportIcon::Back => {
            triangle(-2.0, -1.0);
            bar(4.5, 1.5);
        }
        TransportIcon::Forward => {
            triangle(2.0, 1.0);
            bar(-4.5, 1.5);
        }
        TransportIcon::Loop(_) => {
            let points: Vec<egui::Pos2> = (0..=20)
                .map(|i| (i as f32 / 20.0 * 300.0 - 60.0).to_radians())
                .map(|angle| at + vec2(angle.cos(), angle.sin()) * 5.5)
                .collect();
            let end = at + vec2((-60.0f32).to_radians().cos(), (-60.0f32).to_radians().sin()) * 5.5;
            painter.add(Shape::line(points, Stroke::new(1.8, colour)));
            let tip = [vec2(-4.5, -1.5), vec2(1.5, -4.5), vec2(1.5, 2.5)];
            painter.add(Shape::convex_polygon(
                tip.map(|corner| end + corner).to_vec(),
                colour,
                Stroke::NONE,
            ));
        }
    }
}

fn show_speed_menu(ui: &mut Ui, seen: &PaneInput<'_>) {
    let player = seen.shown.on_stage();
    let now = player.speed;
    let shuttle = player.playback_direction();
    let text = if shuttle.abs() > 1.0 || shuttle < 0.0 {
        format!("×{}", now * shuttle)
    } else {
        format!("×{now}")
    };
    let combo = ComboBox::from_id_salt("speed").width(58.0).selected_text(text);
    let inner = combo.show_ui(ui, |ui| {
        for speed in PLAYBACK_SPEEDS {
            if ui.selectable_label(speed == now, format!("×{speed}")).clicked() {
                seen.send_command(WindowCommand::Speed(speed));
            }
        }
    });
    let name = seen.say_text(words::SPEED);
    inner
        .response
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, name));
    let keys = [Action::Slower, Action::Faster].map(|action| seen.keys.action_keys_text(action));
    inner
        .response
        .on_hover_text(format!("{name} ({} / {})", keys[0], keys[1]));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn annotations_too_close_to_distinguish_share_one_tick() {
        let whole = TimeSpan::span_between(
            RecordingInstant::RECORDING_START,
            RecordingInstant::from_micros(1_000_000),
        );
        assert_eq!(
            annotation_tick_shares(&[0, 500_000], &[250_000, 750_000], whole, 100.0),
            [[0.0, 0.25], [0.5, 0.75]]
        );
        let starts: Vec<i64> = (0..100_000).map(|it| it * 10).collect();
        let ends: Vec<i64> = starts.iter().map(|it| it + 10).collect();
        let many = annotation_tick_shares(&starts, &ends, whole, 300.0);
        assert!((290..=301).contains(&many.len()), "{}", many.len());
        assert!(annotation_tick_shares(&[], &[], whole, 300.0).is_empty());
    }
}
