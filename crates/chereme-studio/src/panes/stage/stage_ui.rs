//! The stage's widgets: the extras, the pictures, and the gestures of the mouse on them.

use chereme_figure::PaperTheme;
use chereme_figure::camera::{CameraProjection, FigureCamera};
use chereme_figure::mesh::TriangleMesh;
use chereme_figure::raster::FigureStyle;
use chereme_motion::ModelPose;
use eframe::egui::emath::GuiRounding;
use eframe::egui::{
    self, Button, Color32, ComboBox, PointerButton, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind,
    TextureOptions, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

use super::artist::{CameraPicture, PosedFigure, ShapeSheet, StageArtist, StageRequest};
use super::captions::{NARROW_PICTURE_WIDTH_POINTS, show_original_signer, show_stage_notes};
pub(super) use super::captions::{chip_on, paint_caption_chip};
use super::stage_data::{StageInset, StageLook, StagePart, StagePartContent, VIEW_ACTIONS};
use super::stage_scene::StageSubject;
use super::{
    StageEye, StagePane, insets, original, preview, stage_course, stage_data, stage_handle, stage_marks,
    stage_movement_source, tools, transport,
};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::layout::PaneKind;
use crate::miniatures;
use crate::panes::film_screens;
use crate::settings::stage_settings::OriginalComparison;
use crate::words::{InterfaceText, stage_words as words};

/// The most pixels that are drawn; larger stages show theirs scaled.
const MOST_PIXELS: f32 = 1_600_000.0;
/// In narrower or lower stages, in points, the tools are behind a button.
const NARROW_STAGE_SIZE_POINTS: egui::Vec2 = vec2(480.0, 300.0);
/// How long a frame waits for the picture of a changed recipe, so that the result is visible in the frame in which it
/// is known; short enough for the rest of the window.
const RECIPE_PICTURE_WAIT: std::time::Duration = std::time::Duration::from_millis(12);
/// Factor on the picture's size in the choice of its quality while a recipe changes, compared to playback.
const RECIPE_HASTE_FACTOR: f32 = 3.0;
/// How long after a change of the recipe pictures are drawn as fast as in motion, in seconds.
const RECIPE_SETTLE_SECONDS: f64 = 0.25;

pub(super) fn show_stage_pane(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let time = ui.input(|input| input.time);
    stage.rebuild_stage_figures(seen, time);
    let frame = egui::Frame::new();
    // If there is little height, the signer gets it.
    let low = ui.available_height() < NARROW_STAGE_SIZE_POINTS.y || ui.available_width() < NARROW_STAGE_SIZE_POINTS.x;
    if !low {
        egui::Panel::top("stage tools")
            .frame(frame)
            .show_separator_line(false)
            .show(ui, |ui| tools::show_stage_tools(stage, ui, seen));
    }
    egui::Panel::bottom("transport")
        .frame(frame)
        .show_separator_line(false)
        .show(ui, |ui| {
            transport::show_transport_bar(ui, seen, low, |ui| {
                if low {
                    ui.menu_button(seen.say_text(words::MORE_TOOLS), |ui| {
                        ui.set_min_width(260.0);
                        tools::show_stage_tools(stage, ui, seen);
                    });
                }
            });
        });
    let (whole, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let Some(whole) = show_stage_films(stage, ui, seen, whole) else {
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
            miniatures::paint_text_placeholder(ui, above, seen.say_text(text));
            if let Some((text, action)) = next {
                lead_on(ui, seen, whole, text, action);
            }
        }
        None => show_stage_parts(stage, ui, seen, whole),
    }
}

/// Shows films on the stage if the film pane is not in sight: on the whole stage if there is no movement, else beside
/// the signer. Returns the rest of the stage.
fn show_stage_films(stage: &StagePane, ui: &mut Ui, seen: &PaneInput<'_>, whole: Rect) -> Option<Rect> {
    let made = seen.shown.made.is_some();
    if made || !seen.films.are_there() || PaneKind::Film.is_in_sight(ui.ctx()) {
        return Some(whole);
    }
    if why_nothing(stage, seen) == Some(words::NO_MOVEMENT) {
        film_screens::show_film_screens(ui, seen, whole);
        return None;
    }
    // The longer side is divided.
    let half = |from: f32, to: f32| (from + to) / 2.0;
    let (rest, film) = if whole.width() > whole.height() * 1.1 {
        let middle = half(whole.left(), whole.right());
        (whole.with_max_x(middle - 2.0), whole.with_min_x(middle + 2.0))
    } else {
        let middle = half(whole.top(), whole.bottom());
        (whole.with_max_y(middle - 2.0), whole.with_min_y(middle + 2.0))
    };
    film_screens::show_film_screens(ui, seen, film);
    Some(rest)
}

/// Returns the reason if no signer is visible.
fn why_nothing(stage: &StagePane, seen: &PaneInput<'_>) -> Option<InterfaceText> {
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
fn lead_on(ui: &mut Ui, seen: &PaneInput<'_>, whole: Rect, text: InterfaceText, action: Action) {
    let size = vec2(whole.width().min(200.0), 26.0);
    let place = Rect::from_center_size(whole.center_bottom() - vec2(0.0, 28.0), size);
    let response = ui.put(place, Button::new(seen.say_text(text)));
    if response.on_hover_text(seen.keys.action_keys_text(action)).clicked() {
        seen.send_command(WindowCommand::Do(action));
    }
}

fn show_stage_parts(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>, whole: Rect) {
    let parts = stage_data::divide_stage_parts(whole, stage.eyes.len(), stage.comparing());
    let mut dragged = false;
    for (index, part) in parts.iter().enumerate() {
        let id = ui.scope_id().with(("stage", index));
        let response = ui.interact(part.rect, id, Sense::click_and_drag());
        response.widget_info(|| {
            let name = format!("{}: {}", seen.say_text(words::FIGURE), eye_name(stage, seen, part));
            WidgetInfo::labeled(Role::Image, true, name)
        });
        handle_eye_mouse(stage, ui, &response, part);
        dragged |= response.dragged();
    }
    let insets = insets::stage_insets(stage, &parts);
    let poses = update_stage_pictures(stage, ui, seen, &parts, &insets, dragged);
    insets::show_stage_insets(stage, ui, seen, &insets, parts.len());
    insets::show_inset_proposal(ui, seen, &insets);
    let many = stage.eyes.len() > 1;
    stage.holding.forget_handle_widgets();
    for part in &parts {
        if stage.places
            && part.who != StagePartContent::Original
            && let Some(pose) = &poses
        {
            show_part_marks(stage, ui, seen, part, pose);
        }
        if part.who != StagePartContent::Original
            && let Some(pose) = &poses
        {
            handled(stage, ui, seen, part, pose);
        }
        show_part_labels(stage, ui, seen, part);
        if many && part.eye == stage.active {
            let stroke = Stroke::new(1.5, seen.pane_colours().accent);
            ui.painter().rect_stroke(part.rect, 2.0, stroke, StrokeKind::Inside);
        }
    }
    show_stage_notes(stage, ui, seen, whole, &parts);
}

fn eye_name(stage: &StagePane, seen: &PaneInput<'_>, part: &StagePart) -> &'static str {
    let eye = stage.eyes[part.eye];
    let entry = VIEW_ACTIONS.iter().find(|(view, _)| *view == eye.view);
    entry.map_or("", |(_, action)| seen.say_text(action.action_row().name))
}

/// Handles the mouse: left drag orbits, right or middle drag pans, the wheel magnifies, a double click resets.
fn handle_eye_mouse(stage: &mut StagePane, ui: &Ui, response: &Response, part: &StagePart) {
    let eye = &mut stage.eyes[part.eye];
    let moved_share = response.drag_delta() / part.rect.height().max(1.0);
    let moved = [moved_share.x, moved_share.y];
    if response.dragged_by(PointerButton::Primary) && !ui.input(|input| input.modifiers.shift) {
        eye.orbit_eye(moved);
    } else if response.dragged() {
        eye.pan_eye(moved);
    }
    if response.contains_pointer() {
        let wheel = ui.input(|input| input.smooth_scroll_delta().y / 300.0);
        let pinch = ui.input(egui::InputState::zoom_delta);
        if wheel != 0.0 || pinch != 1.0 {
            let pointer = response.hover_pos().unwrap_or(part.rect.center());
            let away = (pointer - part.rect.center()) / part.rect.height().max(1.0);
            eye.nearer_at(wheel.exp() * pinch, [away.x, away.y]);
        }
    }
    if response.double_clicked() {
        *eye = StageEye::from_preset_view(eye.view);
    }
    if response.clicked() || response.drag_started() {
        stage.active = part.eye;
    }
}

/// Requests the pictures if their inputs changed, and shows the finished ones; returns the signer's posture in them,
/// for the layers above.
fn update_stage_pictures(
    stage: &mut StagePane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    parts: &[StagePart],
    insets: &[StageInset],
    dragged: bool,
) -> Option<ModelPose> {
    stage.artist.get_or_insert_with(|| {
        let ctx = ui.ctx().clone();
        StageArtist::new(move || ctx.request_repaint())
    });
    let scale = ui.ctx().pixels_per_point();
    let area: f32 = parts.iter().map(|part| part.rect.area()).sum::<f32>() * scale * scale;
    let shrink = (MOST_PIXELS / area.max(1.0)).sqrt().min(1.0);
    let pixels = |side: f32| ((side * scale * shrink).round() as usize).max(1);
    let player = seen.shown.on_stage();
    let now = ui.input(|input| input.time);
    let preview = preview::preview_stage_moment(&mut stage.stroke, seen, now);
    let loops = player.current_opening_preview().is_some_and(|stretch| stretch.loops);
    if preview.is_some() && loops {
        ui.ctx().request_repaint();
    }
    stage.previews = preview;
    let shown_time = preview.unwrap_or(player.player_playhead());
    let remaining = stage.replaced.map(|since| RECIPE_SETTLE_SECONDS - (now - since));
    let changing = remaining.filter(|rest| *rest > 0.0);
    if let Some(rest) = changing {
        ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(rest));
    }
    let moving = player.is_playing() || dragged || changing.is_some() || loops;
    let look = StageLook {
        at: shown_time,
        insets: insets
            .iter()
            .map(|inset| {
                (
                    inset.view,
                    inset.who,
                    [pixels(inset.rect.width()), pixels(inset.rect.height())],
                )
            })
            .collect(),
        eyes: stage.eyes.clone(),
        parts: parts
            .iter()
            .map(|part| {
                let rect = part.rect.round_to_pixels(scale);
                let size = [rect.width(), rect.height()].map(pixels);
                (part.eye, part.who, size)
            })
            .collect(),
        shows: stage.shows,
        dark: seen.dark,
        samples: {
            // The result of a change must appear at once.
            let weight = if changing.is_some() { RECIPE_HASTE_FACTOR } else { 1.0 };
            stage_data::pixel_sample_count(moving, [(area * shrink * shrink * weight) as usize, 1])
        },
    };
    let pose = match &stage.signer {
        Some((_, signer)) => stage_movement_source(seen).source_pose_at(&signer.skeleton, shown_time),
        None => None,
    };
    stage.coming = pose.is_none();
    if stage.signer.is_none() {
        let mesh = stage.points.point_mesh_at(shown_time, false);
        stage.coming = mesh.is_none();
        if let Some(mesh) = mesh
            && stage.asked.as_ref() != Some(&look)
        {
            wish_points(stage, look, mesh);
        }
    } else if let Some(pose) = &pose
        && stage.asked.as_ref() != Some(&look)
    {
        send_picture_request(stage, seen, look, pose);
        if std::mem::take(&mut stage.at_once)
            && let Some(artist) = &stage.artist
        {
            artist.await_newest(stage.wished, RECIPE_PICTURE_WAIT);
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
    let full_uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    for (part, texture) in parts.iter().zip(&stage.textures) {
        ui.painter().image(texture.id(), part.rect, full_uv, Color32::WHITE);
    }
    let drawn = stage.drawn.as_ref();
    let same = drawn.filter(|drawn_pose| Some(drawn_pose.model_joint_positions().len()) == joints);
    same.cloned().or(pose)
}

/// Shows the newest pictures that are ready.
fn take_drawn(stage: &mut StagePane, ui: &Ui, options: TextureOptions) {
    let Some(drawn) = stage.artist.as_ref().and_then(StageArtist::take_drawn_pictures) else {
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

fn signer_joints(stage: &StagePane) -> Option<usize> {
    stage.signer.as_ref().map(|(_, it)| it.skeleton.len())
}

fn send_picture_request(stage: &mut StagePane, seen: &PaneInput<'_>, look: StageLook, pose: &ModelPose) {
    let theme = if look.dark { PaperTheme::Dark } else { PaperTheme::Light };
    let end = seen.shown.on_stage().whole.span_end_instant();
    let Some((_, signer)) = &mut stage.signer else { return };
    let mut figures = vec![PosedFigure {
        face: stage_movement_source(seen).source_face_at(look.at),
        ..PosedFigure::at_rest(signer.body.clone(), pose.clone())
    }];
    let sheet = |figure, marks, opacity| ShapeSheet {
        figure,
        marks,
        opacity,
        veiled: opacity < 1.0,
    };
    let mut ghosts = Vec::new();
    if look.shows.ghosts {
        for (body, pose, opacity) in signer.ghost_bodies_around(stage_movement_source(seen), look.at) {
            ghosts.push((figures.len(), opacity));
            figures.push(PosedFigure::at_rest(body, pose));
        }
    }
    let point_mesh = look.shows.points.then(|| stage.points.point_mesh_at(look.at, true));
    let points = point_mesh.flatten().filter(|mesh| !mesh.triangles.is_empty());
    let points = points.map(std::sync::Arc::new);
    let trails = look.shows.trails.map(|reach| {
        let paper = theme.theme_paper_colour();
        let mesh = signer.build_trail_mesh(stage_movement_source(seen), look.at, end, reach, paper);
        std::sync::Arc::new(mesh)
    });
    if let Some(grab) = &stage.holding.grab {
        // While something is dragged, the posture before it stays as a shadow.
        ghosts.push((figures.len(), 0.6));
        figures.push(PosedFigure::at_rest(signer.body_before_edit(), grab.pose.clone()));
    }
    let piece = stage.original.original_piece_at(look.at);
    let original = piece.and_then(|piece| {
        let (moving, subject) = piece.shown.as_ref()?;
        let then = original::original_moment_at(&piece.part, moving, look.at);
        let movement = super::PostureSource::Clip(&moving.clip, &moving.faces);
        let pose = movement.source_pose_at(&subject.skeleton, then)?;
        figures.push(PosedFigure {
            face: movement.source_face_at(then),
            ..PosedFigure::at_rest(subject.body.clone(), pose)
        });
        Some((figures.len() - 1, subject))
    });
    let mut panes = Vec::new();
    let of = |who: &StagePartContent| match (who, &original) {
        (StagePartContent::Original, Some((figure, subject))) => (*subject, *figure),
        _ => (&*signer, 0),
    };
    for (eye, who, size) in &look.parts {
        let eye = look.eyes[*eye];
        let (subject, at): (&StageSubject, usize) = of(who);
        let camera = subject_eye_camera(subject, eye, *size, &figures[at].pose);
        let ground = subject.build_ground_mesh(eye.view, theme, look.shows.grid);
        let mut layers = vec![sheet(None, Some(std::sync::Arc::new(ground)), 1.0)];
        if *who == StagePartContent::Original {
            layers.extend(original.as_ref().map(|_| sheet(Some(at), None, 1.0)));
        } else {
            layers.push(sheet(Some(0), trails.clone(), 1.0));
            let veiled = false;
            layers.extend(points.clone().map(|points| ShapeSheet {
                veiled,
                ..sheet(None, Some(points), 1.0)
            }));
            layers.extend(ghosts.iter().map(|ghost| sheet(Some(ghost.0), None, ghost.1)));
        }
        if let (StagePartContent::Both, Some((figure, _))) = (who, &original) {
            // Both movements at once: the original shines through without hiding the other.
            let over = sheet(Some(*figure), None, 0.42);
            layers.push(ShapeSheet { veiled: false, ..over });
        }
        panes.push(CameraPicture {
            camera,
            size: *size,
            layers,
            fine: false,
        });
    }
    for (view, who, size) in &look.insets {
        let (subject, at) = of(who);
        panes.push(CameraPicture {
            camera: subject_eye_camera(subject, StageEye::from_preset_view(*view), *size, &figures[at].pose),
            size: *size,
            layers: vec![sheet(Some(at), None, 1.0)],
            // Insets are small, and show fingers or a face.
            fine: true,
        });
    }
    request_looked_pictures(stage, look, figures, panes);
}

/// Requests pictures of points alone.
fn wish_points(stage: &mut StagePane, look: StageLook, mesh: TriangleMesh) {
    let mesh = std::sync::Arc::new(mesh);
    let mut panes = Vec::new();
    for (eye, _, size) in &look.parts {
        let eye = look.eyes[*eye];
        let aspect = size[0] as f32 / size[1] as f32;
        let Some(preset) = stage.points.point_view_camera(eye.view, aspect) else {
            return;
        };
        let layer = |mesh| ShapeSheet {
            figure: None,
            marks: Some(mesh),
            opacity: 1.0,
            veiled: false,
        };
        panes.push(CameraPicture {
            camera: eye.eye_camera(preset),
            size: *size,
            // The lowest sheet is the cached background: empty paper here.
            layers: vec![layer(std::sync::Arc::default()), layer(mesh.clone())],
            fine: false,
        });
    }
    request_looked_pictures(stage, look, Vec::new(), panes);
}

/// Requests the pictures of a look, and remembers it.
fn request_looked_pictures(
    stage: &mut StagePane,
    look: StageLook,
    figures: Vec<PosedFigure>,
    panes: Vec<CameraPicture>,
) {
    let Some(artist) = &stage.artist else { return };
    stage.wished += 1;
    artist.request_stage_pictures(StageRequest {
        number: stage.wished,
        figures,
        panes,
        style: FigureStyle {
            theme: if look.dark { PaperTheme::Dark } else { PaperTheme::Light },
            samples: look.samples,
            threads: threads(),
            ..FigureStyle::default()
        },
    });
    stage.asked = Some(look);
}

/// Returns the number of drawing threads: half of the processors, so that the window keeps the others.
fn threads() -> usize {
    let all = std::thread::available_parallelism().map_or(2, std::num::NonZero::get);
    all.div_ceil(2).clamp(2, 6)
}

fn subject_eye_camera(subject: &StageSubject, eye: StageEye, size: [usize; 2], pose: &ModelPose) -> FigureCamera {
    let aspect = size[0] as f32 / size[1] as f32;
    let preset = subject.framing.framing_camera(eye.view, aspect, pose, &subject.anatomy);
    eye.eye_camera(preset)
}

/// Shows the view's name, which opens a menu of views, and the name of the signer.
fn show_part_labels(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>, part: &StagePart) {
    let place = Rect::from_min_size(part.rect.min + vec2(6.0, 6.0), vec2(part.rect.width() - 12.0, 24.0));
    if part.who != StagePartContent::Signer || part.rect.width() < 60.0 {
        show_original_signer(stage, ui, seen, part);
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
        let combo_box = ComboBox::from_id_salt(("view", part.eye));
        // In a narrow picture the name would cover the face.
        let combo = if part.rect.width() < NARROW_PICTURE_WIDTH_POINTS {
            combo_box.selected_text("").width(0.0)
        } else {
            combo_box.selected_text(RichText::new(text).small())
        };
        let inner = combo.show_ui(ui, |ui| {
            for (view, action) in VIEW_ACTIONS {
                let name = seen.say_text(action.action_row().name);
                let button = Button::selectable(view == now.view, name);
                if ui
                    .add(button.shortcut_text(seen.keys.action_keys_text(action)))
                    .clicked()
                {
                    chosen = Some(view);
                }
            }
        });
        let name = seen.say_text(words::VIEW);
        inner
            .response
            .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, name));
        inner.response.on_hover_text(text);
    });
    if let Some(view) = chosen {
        stage.eyes[part.eye] = StageEye::from_preset_view(view);
        stage.active = part.eye;
    }
}

/// Returns whether a part is the first of its eye.
fn data_first(stage: &StagePane, part: &StagePart) -> bool {
    stage.comparing() != Some(OriginalComparison::Beside) || part.who == StagePartContent::Original
}

/// Returns the projection of the signer in a part, in points from the part's corner.
fn part_projection(stage: &StagePane, part: &StagePart, pose: &ModelPose) -> Option<CameraProjection> {
    let (_, signer) = stage.signer.as_ref()?;
    let size = [part.rect.width(), part.rect.height()].map(|side| side.round().max(1.0) as usize);
    let camera = subject_eye_camera(signer, stage.eyes[part.eye], size, pose);
    Some(camera.camera_projection(size[0], size[1]))
}

/// Shows the handle of the placement that is being edited.
fn handled(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>, part: &StagePart, pose: &ModelPose) {
    let before = stage.holding.grab.is_some();
    if let Some(projection) = part_projection(stage, part, pose) {
        stage_handle::show_stage_handles(stage, ui, seen, part, projection, pose);
        stage_course::show_stage_path(stage, ui, seen, part, projection, pose);
        let panned = std::mem::take(&mut stage.holding.panned) / part.rect.height().max(1.0);
        stage.eyes[part.eye].pan_eye([panned.x, panned.y]);
    }
    if before != stage.holding.grab.is_some() {
        stage.asked = None;
    }
}

fn show_part_marks(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>, part: &StagePart, pose: &ModelPose) {
    let overview = &seen.snapshot.overview;
    let is_current = stage
        .zones
        .as_ref()
        .is_some_and(|(of, _)| std::sync::Arc::ptr_eq(of, overview));
    if !is_current {
        stage.zones = Some((overview.clone(), stage_marks::placement_zones(overview)));
    }
    let (Some((_, signer)), Some((_, zones))) = (&stage.signer, &stage.zones) else {
        return;
    };
    let Some(projection) = part_projection(stage, part, pose) else {
        return;
    };
    let language = seen.language;
    let name = |id: &str| {
        let all = overview.inventories.iter().map(|stored| &stored.inventory);
        let found_value = all.flat_map(|inventory| &inventory.values).find(|value| value.id == id);
        found_value.map_or(id.to_owned(), |value| {
            value.value_name_in(language.language_code()).to_owned()
        })
    };
    let marks = stage_marks::body_marks(signer, pose, zones, name);
    stage_marks::show_body_marks(ui, seen, part.rect, &projection, 1.0, &marks);
}
