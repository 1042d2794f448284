//! The stage's widgets: the extras, the pictures, and the gestures of the mouse on them.

use chereme_figure::Theme;
use chereme_figure::camera::{Camera, Projection};
use chereme_figure::mesh::Mesh;
use chereme_figure::raster::Style;
use chereme_motion::ModelPose;
use eframe::egui::emath::GuiRounding;
use eframe::egui::{
    self, Button, Color32, ComboBox, PointerButton, Rect, Response, RichText, Role, Sense, Stroke,
    StrokeKind, TextureOptions, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

use super::artist::{Artist, Figure, Pane, Sheet, StageRequest};
use super::captions::{NARROW, notes, who};
pub(super) use super::captions::{chip, chip_on};
use super::data::{self, Compare, Inset, Look, StagePart, VIEWS, Who};
use super::scene::Subject;
use super::{
    Eye, Stage, course, handle, insets, marks, movement, original, preview, tools, transport,
};
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::film::Films;
use crate::miniatures;
use crate::words::{Text, stage as words};

/// The most pixels that are drawn; larger stages show theirs scaled.
const MOST_PIXELS: f32 = 1_600_000.0;
/// In narrower or lower stages, in points, the tools are behind a button.
const LOW: egui::Vec2 = vec2(480.0, 300.0);
/// How long a frame waits for the picture of a changed recipe, so that the result is visible in the frame in which it
/// is known; short enough for the rest of the window.
const AT_ONCE: std::time::Duration = std::time::Duration::from_millis(12);
/// Factor on the picture's size in the choice of its quality while a recipe changes, compared to playback.
const HASTE: f32 = 3.0;
/// How long after a change of the recipe pictures are drawn as fast as in motion, in seconds.
const SETTLES: f64 = 0.25;

pub(super) fn show(stage: &mut Stage, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let time = ui.input(|input| input.time);
    stage.follow(seen, time, out);
    let frame = egui::Frame::new();
    // If there is little height, the signer gets it.
    let low = ui.available_height() < LOW.y || ui.available_width() < LOW.x;
    if !low {
        egui::Panel::top("stage tools")
            .frame(frame)
            .show_separator_line(false)
            .show(ui, |ui| tools::show(stage, ui, seen, out));
    }
    egui::Panel::bottom("transport")
        .frame(frame)
        .show_separator_line(false)
        .show(ui, |ui| {
            transport::show(ui, seen, out, low, |ui, out| {
                if low {
                    ui.menu_button(seen.say(words::MORE_TOOLS), |ui| {
                        ui.set_min_width(260.0);
                        tools::show(stage, ui, seen, out);
                    });
                }
            });
        });
    let (whole, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let Some(whole) = films(stage, ui, seen, out, whole) else {
        return;
    };
    super::note_place(ui, whole);
    match why_nothing(stage, seen) {
        Some(text) => {
            let next = match text {
                words::ONLY_SIGNS => Some((words::TO_SIGNS, Action::Search)),
                words::NO_MOVEMENT if seen.shown.made.is_none() => {
                    Some((crate::words::library::IMPORT, Action::Import))
                }
                _ => None,
            };
            // The button below needs a separate line.
            let foot = if next.is_some() { 44.0 } else { 0.0 };
            let above = whole.with_max_y(whole.bottom() - foot);
            miniatures::empty(ui, above, seen.say(text));
            if let Some(next) = next {
                lead_on(ui, seen, out, whole, next);
            }
        }
        None => panes(stage, ui, seen, out, whole),
    }
}

/// Shows films on the stage if the film pane is not in sight: on the whole stage if there is no movement, else beside
/// the signer. Returns the rest of the stage.
fn films(
    stage: &Stage,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    whole: Rect,
) -> Option<Rect> {
    let made = seen.shown.made.is_some();
    if made || !seen.films.are_there() || Films::is_pane_seen(ui.ctx()) {
        return Some(whole);
    }
    if why_nothing(stage, seen) == Some(words::NO_MOVEMENT) {
        seen.films.show(ui, seen, out, whole);
        return None;
    }
    // The longer side is divided.
    let half = |from: f32, to: f32| (from + to) / 2.0;
    let (rest, film) = if whole.width() > whole.height() * 1.1 {
        let middle = half(whole.left(), whole.right());
        (
            whole.with_max_x(middle - 2.0),
            whole.with_min_x(middle + 2.0),
        )
    } else {
        let middle = half(whole.top(), whole.bottom());
        (
            whole.with_max_y(middle - 2.0),
            whole.with_min_y(middle + 2.0),
        )
    };
    seen.films.show(ui, seen, out, film);
    Some(rest)
}

/// Returns the reason if no signer is visible.
fn why_nothing(stage: &Stage, seen: &PaneInput<'_>) -> Option<Text> {
    if seen.shown.made.is_some() {
        stage.signer.is_none().then_some(words::NO_MOVEMENT)
    } else if seen.shown.recording.is_none() {
        let overview = &seen.snapshot.overview;
        let only_signs = overview.recordings.is_empty() && !overview.signs.is_empty();
        let empty = overview.recordings.is_empty() && overview.signs.is_empty();
        Some(if empty {
            words::EMPTY
        } else if only_signs {
            words::ONLY_SIGNS
        } else {
            words::NO_RECORDING
        })
    } else if !seen.reel.has_movement() {
        (!stage.points.are_there()).then_some(words::NO_MOVEMENT)
    } else if stage.signer.is_none() {
        Some(words::LOADING)
    } else {
        None
    }
}

/// Shows the next steps if the stage is empty: to the signs of a corpus without recordings, or to the import.
fn lead_on(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    whole: Rect,
    (text, action): (Text, Action),
) {
    let size = vec2(whole.width().min(200.0), 26.0);
    let place = Rect::from_center_size(whole.center_bottom() - vec2(0.0, 28.0), size);
    let response = ui.put(place, Button::new(seen.say(text)));
    if response.on_hover_text(seen.keys.text(action)).clicked() {
        out.send(Command::Do(action));
    }
}

fn panes(stage: &mut Stage, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, whole: Rect) {
    let parts = data::parts(whole, stage.eyes.len(), stage.comparing());
    let mut dragged = false;
    for (index, part) in parts.iter().enumerate() {
        let id = ui.scope_id().with(("stage", index));
        let response = ui.interact(part.rect, id, Sense::click_and_drag());
        response.widget_info(|| {
            let name = format!(
                "{}: {}",
                seen.say(words::FIGURE),
                eye_name(stage, seen, part)
            );
            WidgetInfo::labeled(Role::Image, true, name)
        });
        turn(stage, ui, &response, part);
        dragged |= response.dragged();
    }
    let insets = insets::of(stage, &parts);
    let poses = pictures(stage, ui, seen, (&parts, &insets), dragged);
    insets::show(stage, ui, seen, out, (&insets, parts.len()));
    insets::proposal(ui, seen, &insets);
    let many = stage.eyes.len() > 1;
    stage.holding.begin();
    for part in &parts {
        if stage.places
            && part.who != Who::Original
            && let Some(pose) = &poses
        {
            places(stage, ui, seen, out, part, pose);
        }
        if part.who != Who::Original
            && let Some(pose) = &poses
        {
            handled(stage, ui, seen, out, part, pose);
        }
        labels(stage, ui, seen, part);
        if many && part.eye == stage.active {
            let stroke = Stroke::new(1.5, seen.colours().accent);
            ui.painter()
                .rect_stroke(part.rect, 2.0, stroke, StrokeKind::Inside);
        }
    }
    notes(stage, ui, seen, (whole, &parts));
}

fn eye_name(stage: &Stage, seen: &PaneInput<'_>, part: &StagePart) -> &'static str {
    let eye = stage.eyes[part.eye];
    let found = VIEWS.iter().find(|(view, _)| *view == eye.view);
    found.map_or("", |(_, action)| seen.say(action.row().name))
}

/// Handles the mouse: left drag orbits, right or middle drag pans, the wheel magnifies, a double click resets.
fn turn(stage: &mut Stage, ui: &Ui, response: &Response, part: &StagePart) {
    let eye = &mut stage.eyes[part.eye];
    let moved = response.drag_delta() / part.rect.height().max(1.0);
    let moved = [moved.x, moved.y];
    if response.dragged_by(PointerButton::Primary) && !ui.input(|input| input.modifiers.shift) {
        eye.orbit(moved);
    } else if response.dragged() {
        eye.pan(moved);
    }
    if response.contains_pointer() {
        let wheel = ui.input(|input| input.smooth_scroll_delta().y / 300.0);
        let pinch = ui.input(egui::InputState::zoom_delta);
        if wheel != 0.0 || pinch != 1.0 {
            let at = response.hover_pos().unwrap_or(part.rect.center());
            let away = (at - part.rect.center()) / part.rect.height().max(1.0);
            eye.nearer_at(wheel.exp() * pinch, [away.x, away.y]);
        }
    }
    if response.double_clicked() {
        *eye = Eye::of(eye.view);
    }
    if response.clicked() || response.drag_started() {
        stage.active = part.eye;
    }
}

/// Requests the pictures if their inputs changed, and shows the finished ones; returns the signer's posture in them,
/// for the layers above.
fn pictures(
    stage: &mut Stage,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (parts, insets): (&[StagePart], &[Inset]),
    dragged: bool,
) -> Option<ModelPose> {
    stage.artist.get_or_insert_with(|| {
        let ctx = ui.ctx().clone();
        Artist::new(move || ctx.request_repaint())
    });
    let scale = ui.ctx().pixels_per_point();
    let area: f32 = parts.iter().map(|it| it.rect.area()).sum::<f32>() * scale * scale;
    let shrink = (MOST_PIXELS / area.max(1.0)).sqrt().min(1.0);
    let pixels = |side: f32| ((side * scale * shrink).round() as usize).max(1);
    let player = seen.shown.on_stage();
    let now = ui.input(|input| input.time);
    let preview = preview::moment(&mut stage.stroke, seen, now);
    let loops = player.previewed().is_some_and(|it| it.loops);
    if preview.is_some() && loops {
        ui.ctx().request_repaint();
    }
    stage.previews = preview;
    let at = preview.unwrap_or(player.playhead());
    let changing = stage.replaced.map(|since| SETTLES - (now - since));
    let changing = changing.filter(|rest| *rest > 0.0);
    if let Some(rest) = changing {
        ui.ctx()
            .request_repaint_after(std::time::Duration::from_secs_f64(rest));
    }
    let moving = player.is_playing() || dragged || changing.is_some() || loops;
    let look = Look {
        at,
        insets: insets
            .iter()
            .map(|it| {
                (
                    it.view,
                    it.who,
                    [pixels(it.rect.width()), pixels(it.rect.height())],
                )
            })
            .collect(),
        eyes: stage.eyes.clone(),
        parts: parts
            .iter()
            .map(|it| {
                let rect = it.rect.round_to_pixels(scale);
                let size = [rect.width(), rect.height()].map(pixels);
                (it.eye, it.who, size)
            })
            .collect(),
        shows: stage.shows,
        dark: seen.dark,
        samples: {
            // The result of a change must appear at once.
            let weight = if changing.is_some() { HASTE } else { 1.0 };
            data::samples(moving, [(area * shrink * shrink * weight) as usize, 1])
        },
    };
    let pose = match &stage.signer {
        Some((_, signer)) => movement(seen).pose(&signer.skeleton, at),
        None => None,
    };
    stage.coming = pose.is_none();
    if stage.signer.is_none() {
        let mesh = stage.points.mesh(at, false);
        stage.coming = mesh.is_none();
        if let Some(mesh) = mesh
            && stage.asked.as_ref() != Some(&look)
        {
            wish_points(stage, look, mesh);
        }
    } else if let Some(pose) = &pose
        && stage.asked.as_ref() != Some(&look)
    {
        wish(stage, seen, look, pose);
        if std::mem::take(&mut stage.at_once)
            && let Some(artist) = &stage.artist
        {
            artist.await_newest(stage.wished, AT_ONCE);
        }
    }
    // A pixel of the picture is one of the window, unless the picture would be too large.
    let options = if shrink < 1.0 {
        TextureOptions::LINEAR
    } else {
        TextureOptions::NEAREST
    };
    take_drawn(stage, ui, options);
    let joints = signer_joints(stage);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    for (part, texture) in parts.iter().zip(&stage.textures) {
        ui.painter()
            .image(texture.id(), part.rect, whole, Color32::WHITE);
    }
    let drawn = stage.drawn.as_ref();
    let same = drawn.filter(|it| Some(it.positions().len()) == joints);
    same.cloned().or(pose)
}

/// Shows the newest pictures that are ready.
fn take_drawn(stage: &mut Stage, ui: &Ui, options: TextureOptions) {
    let Some(drawn) = stage.artist.as_ref().and_then(Artist::take) else {
        return;
    };
    stage.took = drawn.took;
    (stage.drawn, stage.shown) = (drawn.posture, drawn.number);
    stage.textures.truncate(drawn.images.len());
    for (index, image) in drawn.images.into_iter().enumerate() {
        match stage.textures.get_mut(index) {
            Some(texture) if texture.size() == image.size => {
                texture.set_partial([0, 0], image, options);
            }
            Some(texture) => texture.set(image, options),
            None => {
                let texture = ui.ctx().load_texture("stage", image, options);
                stage.textures.push(texture);
            }
        }
    }
}

fn signer_joints(stage: &Stage) -> Option<usize> {
    stage.signer.as_ref().map(|(_, it)| it.skeleton.len())
}

fn wish(stage: &mut Stage, seen: &PaneInput<'_>, look: Look, pose: &ModelPose) {
    let theme = if look.dark { Theme::Dark } else { Theme::Light };
    let end = seen.shown.on_stage().whole.end();
    let (Some((_, signer)), Some(artist)) = (&mut stage.signer, &stage.artist) else {
        return;
    };
    let mut figures = vec![Figure {
        face: movement(seen).face(look.at),
        ..Figure::at_rest(signer.body.clone(), pose.clone())
    }];
    let sheet = |figure, marks, opacity| Sheet {
        figure,
        marks,
        opacity,
        veiled: opacity < 1.0,
    };
    let mut ghosts = Vec::new();
    if look.shows.ghosts {
        for (body, pose, opacity) in signer.ghosts(movement(seen), look.at) {
            ghosts.push((figures.len(), opacity));
            figures.push(Figure::at_rest(body, pose));
        }
    }
    let points = look.shows.points.then(|| stage.points.mesh(look.at, true));
    let points = points.flatten().filter(|mesh| !mesh.triangles.is_empty());
    let points = points.map(std::sync::Arc::new);
    let trails = look.shows.trails.map(|reach| {
        let paper = theme.background();
        let mesh = signer.trails(movement(seen), (look.at, end), reach, paper);
        std::sync::Arc::new(mesh)
    });
    if let Some(grab) = &stage.holding.grab {
        ghosts.push((figures.len(), 0.6));
        figures.push(Figure::at_rest(signer.before(), grab.pose.clone()));
    }
    let piece = stage.original.piece(look.at);
    let original = piece.and_then(|piece| {
        let (moving, subject) = piece.shown.as_ref()?;
        let then = original::moment(&piece.part, moving, look.at);
        let movement = super::Movement::Clip(&moving.clip, &moving.faces);
        let pose = movement.pose(&subject.skeleton, then)?;
        figures.push(Figure {
            face: movement.face(then),
            ..Figure::at_rest(subject.body.clone(), pose)
        });
        Some((figures.len() - 1, subject))
    });
    let mut panes = Vec::new();
    let of = |who: &Who| match (who, &original) {
        (Who::Original, Some((figure, subject))) => (*subject, *figure),
        _ => (&*signer, 0),
    };
    for (eye, who, size) in &look.parts {
        let eye = look.eyes[*eye];
        let (subject, at): (&Subject, usize) = of(who);
        let camera = camera(subject, eye, *size, &figures[at].pose);
        let ground = subject.ground(eye.view, theme, look.shows.grid);
        let mut layers = vec![sheet(None, Some(std::sync::Arc::new(ground)), 1.0)];
        if *who == Who::Original {
            layers.extend(original.as_ref().map(|_| sheet(Some(at), None, 1.0)));
        } else {
            layers.push(sheet(Some(0), trails.clone(), 1.0));
            let veiled = false;
            layers.extend(points.clone().map(|points| Sheet {
                veiled,
                ..sheet(None, Some(points), 1.0)
            }));
            layers.extend(ghosts.iter().map(|it| sheet(Some(it.0), None, it.1)));
        }
        if let (Who::Both, Some((figure, _))) = (who, &original) {
            let over = sheet(Some(*figure), None, 0.42);
            layers.push(Sheet {
                veiled: false,
                ..over
            });
        }
        panes.push(Pane {
            camera,
            size: *size,
            layers,
            fine: false,
        });
    }
    for (view, who, size) in &look.insets {
        let (subject, at) = of(who);
        panes.push(Pane {
            camera: camera(subject, Eye::of(*view), *size, &figures[at].pose),
            size: *size,
            layers: vec![sheet(Some(at), None, 1.0)],
            fine: true,
        });
    }
    stage.wished += 1;
    artist.wish(StageRequest {
        number: stage.wished,
        figures,
        panes,
        style: Style {
            theme,
            samples: look.samples,
            threads: threads(),
            ..Style::default()
        },
    });
    stage.asked = Some(look);
}

/// Requests pictures of points alone.
fn wish_points(stage: &mut Stage, look: Look, mesh: Mesh) {
    let theme = if look.dark { Theme::Dark } else { Theme::Light };
    let Some(artist) = &stage.artist else { return };
    let mesh = std::sync::Arc::new(mesh);
    let mut panes = Vec::new();
    for (eye, _, size) in &look.parts {
        let eye = look.eyes[*eye];
        let aspect = size[0] as f32 / size[1] as f32;
        let Some(preset) = stage.points.camera(eye.view, aspect) else {
            return;
        };
        let layer = |mesh| Sheet {
            figure: None,
            marks: Some(mesh),
            opacity: 1.0,
            veiled: false,
        };
        panes.push(Pane {
            camera: eye.camera(preset),
            size: *size,
            // The lowest sheet is the cached background: empty paper here.
            layers: vec![layer(std::sync::Arc::default()), layer(mesh.clone())],
            fine: false,
        });
    }
    stage.wished += 1;
    artist.wish(StageRequest {
        number: stage.wished,
        figures: Vec::new(),
        panes,
        style: Style {
            theme,
            samples: look.samples,
            threads: threads(),
            ..Style::default()
        },
    });
    stage.asked = Some(look);
}

/// Returns the number of drawing threads: half of the processors, so that the window keeps the others.
fn threads() -> usize {
    let all = std::thread::available_parallelism().map_or(2, std::num::NonZero::get);
    all.div_ceil(2).clamp(2, 6)
}

fn camera(subject: &Subject, eye: Eye, size: [usize; 2], pose: &ModelPose) -> Camera {
    let aspect = size[0] as f32 / size[1] as f32;
    let preset = subject
        .framing
        .camera(eye.view, aspect, pose, &subject.anatomy);
    eye.camera(preset)
}

/// Shows the view's name, which opens a menu of views, and the name of the signer.
fn labels(stage: &mut Stage, ui: &mut Ui, seen: &PaneInput<'_>, part: &StagePart) {
    let place = Rect::from_min_size(
        part.rect.min + vec2(6.0, 6.0),
        vec2(part.rect.width() - 12.0, 24.0),
    );
    if part.who != Who::Signer || part.rect.width() < 60.0 {
        who(stage, ui, seen, part);
    }
    let first = data_first(stage, part);
    if !first || part.rect.width() < 60.0 {
        return;
    }
    let now = stage.eyes[part.eye];
    let mut chosen = None;
    let builder = UiBuilder::new().max_rect(place).id_salt(("view", part.eye));
    ui.scope_builder(builder, |ui| {
        let text = eye_name(stage, seen, part);
        let combo = ComboBox::from_id_salt(("view", part.eye));
        // In a narrow picture the name would cover the face.
        let combo = if part.rect.width() < NARROW {
            combo.selected_text("").width(0.0)
        } else {
            combo.selected_text(RichText::new(text).small())
        };
        let inner = combo.show_ui(ui, |ui| {
            for (view, action) in VIEWS {
                let name = seen.say(action.row().name);
                let button = Button::selectable(view == now.view, name);
                if ui
                    .add(button.shortcut_text(seen.keys.text(action)))
                    .clicked()
                {
                    chosen = Some(view);
                }
            }
        });
        let name = seen.say(words::VIEW);
        inner
            .response
            .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, name));
        inner.response.on_hover_text(text);
    });
    if let Some(view) = chosen {
        stage.eyes[part.eye] = Eye::of(view);
        stage.active = part.eye;
    }
}

/// Returns whether a part is the first of its eye.
fn data_first(stage: &Stage, part: &StagePart) -> bool {
    stage.comparing() != Some(Compare::Beside) || part.who == Who::Original
}

/// Returns the projection of the signer in a part, in points from the part's corner.
fn projection(stage: &Stage, part: &StagePart, pose: &ModelPose) -> Option<Projection> {
    let (_, signer) = stage.signer.as_ref()?;
    let size = [part.rect.width(), part.rect.height()].map(|side| side.round().max(1.0) as usize);
    let camera = camera(signer, stage.eyes[part.eye], size, pose);
    Some(camera.projection(size[0], size[1]))
}

/// Shows the handle of the placement that is being edited.
fn handled(
    stage: &mut Stage,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    part: &StagePart,
    pose: &ModelPose,
) {
    let before = stage.holding.grab.is_some();
    if let Some(projection) = projection(stage, part, pose) {
        handle::show(stage, ui, seen, out, (part, projection, pose));
        course::show(stage, ui, seen, out, (part, projection, pose));
        let panned = std::mem::take(&mut stage.holding.panned) / part.rect.height().max(1.0);
        stage.eyes[part.eye].pan([panned.x, panned.y]);
    }
    if before != stage.holding.grab.is_some() {
        stage.asked = None;
    }
}

fn places(
    stage: &mut Stage,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    part: &StagePart,
    pose: &ModelPose,
) {
    let overview = &seen.snapshot.overview;
    let known = stage
        .zones
        .as_ref()
        .is_some_and(|(of, _)| std::sync::Arc::ptr_eq(of, overview));
    if !known {
        stage.zones = Some((overview.clone(), marks::zones(overview)));
    }
    let (Some((_, signer)), Some((_, zones))) = (&stage.signer, &stage.zones) else {
        return;
    };
    let Some(projection) = projection(stage, part, pose) else {
        return;
    };
    let language = seen.language;
    let name = |id: &str| {
        let all = overview.inventories.iter().map(|it| &it.inventory);
        let found = all.flat_map(|it| &it.values).find(|value| value.id == id);
        found.map_or(id.to_owned(), |it| it.name(language.code()).to_owned())
    };
    let marks = marks::marks(signer, pose, zones, name);
    marks::show(ui, seen, out, (part.rect, &projection, 1.0), &marks);
}
