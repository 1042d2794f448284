//! The field that goes to a typed time.

use chereme_corpus::TableMoment;
use chereme_corpus::snap::RecordingFrameTimes;
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{Id, Key, Label, Modifiers, Role, TextEdit, Ui, WidgetInfo, vec2};

use super::TimelinePane;
use super::timeline_data::time_text;
use super::timeline_edit::TimelineScene;
use super::timeline_parts::box_window;
use crate::command::WindowCommand;
use crate::script::script_edit;
use crate::words::{fill_text_braces, shell, timeline as words};

/// The field while it is open.
#[derive(Debug, Default)]
pub(super) struct GoBox {
    text: String,
}

/// Returns the time that a text describes, in microseconds: a time, `f512` for a frame as the stage counts frames, `+2`
/// and `-0.5` relative to `now` in seconds, `50%` of the whole. Returns `None` for other text.
fn parse_time_target(text: &str, now: i64, whole: TimeSpan, frames: Option<RecordingFrameTimes>) -> Option<i64> {
    // Commas are decimal points in German and French.
    let text = text.trim().to_lowercase().replace(',', ".");
    let (from, end) = whole.span_bounds_micros();
    if let Some(share) = text.strip_suffix('%') {
        let typed_share: f64 = share.trim().parse().ok()?;
        let share = Some(typed_share).filter(|share| (0.0..=100.0).contains(share))?;
        return Some(from + ((end - from) as f64 * share / 100.0) as i64);
    }
    let (sign, rest) = match text.as_bytes().first()? {
        b'+' => (Some(1), text[1..].trim()),
        b'-' => (Some(-1), text[1..].trim()),
        _ => (None, text.as_str()),
    };
    let named = ["frame", "image", "#"]
        .into_iter()
        .find_map(|prefix| rest.strip_prefix(prefix));
    let moment: TableMoment = match named {
        Some(number) => format!("f{}", number.trim()).parse().ok()?,
        None => rest.parse().ok()?,
    };
    match (moment, sign) {
        (TableMoment::Time(at), None) => Some(at.instant_micros()),
        (TableMoment::Time(by), Some(sign)) => now.checked_add(by.instant_micros().checked_mul(sign)?),
        (TableMoment::Frame(at), None) => {
            let frames = frames?;
            // Frames are counted from 1 on the stage.
            let frame_index = usize::try_from(at.checked_sub(1)?).ok()?;
            Some(frames.rate.frame_start_instant(frame_index).instant_micros() + frames.offset)
        }
        (TableMoment::Frame(by), Some(sign)) => {
            // A number of frames beyond this would overflow as microseconds.
            let by = i64::try_from(by).ok().filter(|count| *count < 1 << 40)?;
            Some(frames?.stepped_frame_start(now, by * sign))
        }
    }
}

/// Shows the field, and moves the playhead to the entered time.
pub(super) fn show_go_to_time(timeline: &mut TimelinePane, ui: &mut Ui, scene: &TimelineScene<'_>) {
    let Some(mut shown) = timeline.boxes.go_box.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (mut go, mut drop) = (pressed(Key::Enter), pressed(Key::Escape));
    let (say, frames) = (|text| scene.seen.say_text(text), scene.recording_frame_times());
    let player = scene.seen.shown.on_stage();
    let (whole, now) = (player.whole, player.player_playhead().instant_micros());
    let made = scene.seen.shown.made.as_ref();
    // Generated movement counts its own frames from its own beginning.
    let frames = match made {
        Some(showing) => Some(RecordingFrameTimes {
            rate: showing.made.clip.clip_frame_rate(),
            offset: 0,
        }),
        None => frames,
    };
    let mut to = None;
    box_window(say(words::GO_TITLE), "timeline go")
        .fixed_size(vec2(330.0, 120.0))
        .show(ui.ctx(), |ui| {
            let field = TextEdit::singleline(&mut shown.text)
                .id(Id::unique("timeline go field"))
                .hint_text(say(words::GO_FIELD))
                .desired_width(f32::INFINITY);
            let response = script_edit::draw_with_text_edge(ui, |ui| ui.add(field));
            let label = say(words::GO_FIELD);
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, label));
            // The box has one field, and the keyboard belongs to it.
            response.request_focus();
            to = parse_time_target(&shown.text, now, whole, frames);
            let inside = to.is_none_or(|at| {
                at >= whole.span_start_instant().instant_micros() && at <= whole.span_end_instant().instant_micros()
            });
            match to {
                Some(_) if !inside => {
                    let text =
                        fill_text_braces(say(words::GO_BEYOND), &[("time", &time_text(whole.span_end_instant()))]);
                    ui.colored_label(scene.seen.pane_colours().trouble, text);
                }
                Some(at) => drop_label(ui, &format_stage_time(scene, at)),
                None if shown.text.trim().is_empty() => drop_label(ui, say(words::GO_HOW)),
                None => {
                    let text = Label::new(
                        eframe::egui::RichText::new(say(words::GO_HOW)).color(scene.seen.pane_colours().trouble),
                    );
                    ui.add(text.wrap());
                }
            }
            to = to.filter(|_| inside);
            ui.horizontal(|ui| {
                go |= ui
                    .add_enabled(to.is_some(), eframe::egui::Button::new(say(words::GO)))
                    .clicked();
                drop |= ui.button(say(shell::CANCEL)).clicked();
            });
        });
    match to.filter(|_| go) {
        Some(at) => scene
            .seen
            .send_command(WindowCommand::Cue(RecordingInstant::from_micros(at))),
        None if !drop => timeline.boxes.go_box = Some(shown),
        None => {}
    }
}

fn drop_label(ui: &mut Ui, text: &str) {
    ui.add(Label::new(text).wrap());
}

/// Returns a time in the format of the stage.
fn format_stage_time(scene: &TimelineScene<'_>, at: i64) -> String {
    let time = time_text(RecordingInstant::from_micros(at));
    let Some(frames) = scene.recording_frame_times() else {
        return time;
    };
    let clip_time = RecordingInstant::from_micros((at - frames.offset).max(0));
    let frame = frames.rate.nearest_frame_at(clip_time) + 1;
    let values: [(&str, &dyn std::fmt::Display); 2] = [("time", &time), ("frame", &frame)];
    fill_text_braces(scene.seen.say_text(words::GO_THERE), &values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::FrameRate;

    #[test]
    fn times_frames_percentages_and_relative_times_are_read() {
        let whole = TimeSpan::span_between(
            RecordingInstant::RECORDING_START,
            RecordingInstant::from_micros(100_000_000),
        );
        let frames = RecordingFrameTimes {
            rate: FrameRate::new(50, 1).expect("a rate"),
            offset: 1_000_000,
        };
        for (text, want) in [
            ("1:23.4", Some(83_400_000)),
            (" 83,4 ", Some(83_400_000)),
            ("f1", Some(1_000_000)),
            ("Frame 51", Some(2_000_000)),
            ("#0", None),
            ("+2", Some(12_000_000)),
            ("-0.5", Some(9_500_000)),
            ("+f5", Some(10_100_000)),
            ("50 %", Some(50_000_000)),
            ("101%", None),
            ("", None),
            ("soon", None),
            ("f99999999999999999999", None),
        ] {
            let found = parse_time_target(text, 10_000_000, whole, Some(frames));
            assert_eq!(found, want, "{text}");
        }
        assert_eq!(parse_time_target("f3", 0, whole, None), None);
    }
}
