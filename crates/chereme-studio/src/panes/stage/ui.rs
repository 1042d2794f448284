//! The stage's widgets: the picture, what the mouse does on it, and the transport below.

use chereme_figure::Theme;
use chereme_figure::raster::Style;
use chereme_motion::{Instant, ModelPose};
use eframe::egui::{
    self, Button, Color32, ComboBox, PointerButton, Rect, Response, Role, Sense, Slider,
    TextureOptions, Ui, WidgetInfo, pos2, vec2,
};

use super::Stage;
use super::artist::{Artist, Wish};
use super::data::{self, Look, VIEWS};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::panes::timeline::data::time_text;
use crate::player::SPEEDS;
use crate::words::{Text, stage as words};

/// The largest picture that is drawn, in pixels; larger panes show it scaled.
const LARGEST: [usize; 2] = [1600, 1200];
const TRANSPORT: f32 = 68.0;

pub(super) fn show(stage: &mut Stage, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
    stage.follow(seen);
    let free = ui.available_size();
    let size = vec2(free.x, (free.y - TRANSPORT).max(40.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, seen.say(words::FIGURE)));
    match why_nothing(stage, seen) {
        Some(text) => {
            let font = egui::TextStyle::Body.resolve(ui.style());
            let colour = ui.visuals().weak_text_color();
            ui.painter().text(
                rect.center(),
                egui::Align2::CENTER_CENTER,
                seen.say(text),
                font,
                colour,
            );
        }
        None => {
            turn(stage, ui, &response, rect);
            picture(stage, ui, rect, seen, response.dragged());
        }
    }
    transport(stage, ui, seen, out);
}

/// Returns why there is no signer to be seen, where there is none.
fn why_nothing(stage: &Stage, seen: &Seen<'_>) -> Option<Text> {
    if seen.shown.recording.is_none() {
        Some(words::NO_RECORDING)
    } else if !seen.reel.has_movement() {
        Some(words::NO_MOVEMENT)
    } else if stage.figure.is_none() {
        Some(words::LOADING)
    } else {
        None
    }
}

/// Left drag orbits, right or middle drag pans, the wheel goes nearer, a double click resets.
fn turn(stage: &mut Stage, ui: &Ui, response: &Response, rect: Rect) {
    let moved = response.drag_delta() / rect.height().max(1.0);
    let moved = [moved.x, moved.y];
    if response.dragged_by(PointerButton::Primary) {
        stage.eye.orbit(moved);
    } else if response.dragged() {
        stage.eye.pan(moved);
    }
    if response.contains_pointer() {
        let wheel = ui.input(|input| input.smooth_scroll_delta().y / 300.0);
        let pinch = ui.input(egui::InputState::zoom_delta);
        if wheel != 0.0 || pinch != 1.0 {
            stage.eye.nearer(wheel.exp() * pinch);
        }
    }
    if response.double_clicked() {
        stage.eye = super::Eye::of(stage.eye.view);
    }
}

fn picture(stage: &mut Stage, ui: &mut Ui, rect: Rect, seen: &Seen<'_>, dragging: bool) {
    let artist = stage.artist.get_or_insert_with(|| {
        let ctx = ui.ctx().clone();
        Artist::new(move || ctx.request_repaint())
    });
    if let Some(drawn) = artist.take() {
        stage.took = drawn.took.as_secs_f32() * 1000.0;
        let options = TextureOptions::LINEAR;
        match &mut stage.texture {
            Some(texture) => texture.set(drawn.image, options),
            None => stage.texture = Some(ui.ctx().load_texture("stage", drawn.image, options)),
        }
    }
    let scale = ui.ctx().pixels_per_point();
    let pixels = [rect.width(), rect.height()].map(|side| (side * scale).round().max(1.0) as usize);
    let shrink = pixels
        .iter()
        .zip(LARGEST)
        .map(|(side, most)| most as f32 / *side as f32);
    let shrink = shrink.fold(1.0, f32::min);
    let size = pixels.map(|side| ((side as f32 * shrink) as usize).max(1));
    let look = Look {
        at: seen.shown.player.playhead(),
        eye: stage.eye,
        size,
        dark: seen.dark,
        samples: data::samples(seen.shown.player.is_playing() || dragging, size),
    };
    wish(stage, seen, look);
    if let Some(texture) = &stage.texture {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter()
            .image(texture.id(), rect, whole, Color32::WHITE);
    }
}

/// Wishes for the picture, where it is another than the last and its movement is loaded.
fn wish(stage: &mut Stage, seen: &Seen<'_>, look: Look) {
    let (Some(figure), Some(artist)) = (&stage.figure, &stage.artist) else {
        return;
    };
    if stage.asked == Some(look) {
        return;
    }
    let Some(pose) = seen.reel.pose(look.at) else {
        return;
    };
    let pose = ModelPose::of(figure.of.clip.skeleton(), &pose);
    let aspect = look.size[0] as f32 / look.size[1] as f32;
    let preset = figure
        .framing
        .camera(look.eye.view, aspect, &pose, &figure.of.anatomy);
    let theme = if look.dark { Theme::Dark } else { Theme::Light };
    artist.wish(Wish {
        figures: vec![(figure.body.clone(), pose)],
        camera: look.eye.camera(preset),
        size: look.size,
        style: Style {
            theme,
            samples: look.samples,
            ..Style::default()
        },
    });
    stage.asked = Some(look);
}

fn transport(stage: &mut Stage, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
    ui.add_space(4.0);
    let player = &seen.shown.player;
    let end = player.whole.end().micros();
    let mut at = player.playhead().micros();
    ui.spacing_mut().slider_width = (ui.available_width() - 8.0).max(40.0);
    let slider = Slider::new(&mut at, 0..=end.max(1)).show_value(false);
    let response = ui.add_enabled(end > 0, slider);
    let seconds = at as f64 / 1e6;
    response.widget_info(|| WidgetInfo::slider(true, seconds, seen.say(words::TIME)));
    if response.changed() {
        out.seek(Instant::from_micros(at));
    }
    ui.horizontal(|ui| {
        let (text, action) = (
            if player.is_playing() {
                words::PAUSE
            } else {
                words::PLAY
            },
            Action::Play,
        );
        let button = Button::new(seen.say(text)).min_size(vec2(76.0, 0.0));
        if ui
            .add(button)
            .on_hover_text(seen.keys.text(action))
            .clicked()
        {
            out.send(Command::Do(action));
        }
        let time = format!(
            "{} / {}",
            time_text(player.playhead()),
            time_text(player.whole.end())
        );
        ui.label(egui::RichText::new(time).monospace());
        let mut looping = player.looping;
        if ui.checkbox(&mut looping, seen.say(words::LOOP)).changed() {
            out.send(Command::Do(Action::Loop));
        }
        speeds(ui, seen, out);
        views(stage, ui, seen, out);
        if stage.took > 0.0 {
            ui.weak(format!("{:.1} ms", stage.took));
        }
    });
}

fn speeds(ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
    let now = seen.shown.player.speed;
    let combo = ComboBox::from_id_salt("speed")
        .width(64.0)
        .selected_text(format!("×{now}"));
    let inner = combo.show_ui(ui, |ui| {
        for speed in SPEEDS {
            if ui
                .selectable_label(speed == now, format!("×{speed}"))
                .clicked()
            {
                out.send(Command::Speed(speed));
            }
        }
    });
    name(&inner.response, seen.say(words::SPEED));
}

fn views(stage: &Stage, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
    let now = VIEWS.iter().find(|(view, _)| *view == stage.eye.view);
    let called = |action: Action| seen.say(action.row().name);
    let text = now.map_or("", |(_, action)| called(*action));
    let inner = ComboBox::from_id_salt("view")
        .selected_text(text)
        .show_ui(ui, |ui| {
            for (view, action) in VIEWS {
                let button = Button::selectable(view == stage.eye.view, called(action));
                if ui
                    .add(button.shortcut_text(seen.keys.text(action)))
                    .clicked()
                {
                    out.send(Command::Do(action));
                }
            }
        });
    name(&inner.response, seen.say(words::VIEW));
}

/// Gives a list to choose from the name that assistive tools read.
fn name(response: &Response, name: &str) {
    response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, name));
}
