//! The path of the hand in a recipe, on the stage: a curve that can be drawn, and pulled at its points or between them.

use chereme_figure::camera::CameraProjection;
use chereme_motion::{BodyPart as Joint, ModelPose};
use eframe::egui::{
    CursorIcon, Id, Key, Modifiers, Painter, Pos2, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2,
};
use glam::{DMat3, DVec3};

use super::StagePane;
use super::gizmo::{SightRay, SignerDirections};
use super::stage_data::StagePart;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::panes::recombine::{draw_on_stage, drawing_card_id, lengths_from_position, points_of_line};
use crate::words::{fill_text_braces, recombine_words as words};

/// The side of the square around a point of the path in which a press pulls it, in points of the window.
const PATH_POINT_SIZE_POINTS: f32 = 18.0;
/// The distance from the line within which a press pulls the line, in points of the window.
const PATH_PULL_REACH_POINTS: f32 = 9.0;
/// How far an arrow key moves a point, in metres.
const PATH_KEY_STEP_METRES: f64 = 0.01;
/// The most points of a path; a path with this many takes no more.
const MAX_PULLED_PATH_POINTS: usize = 32;

/// A path as it lies in one picture of the stage.
struct PathInPicture<'a> {
    pane: Rect,
    projection: &'a CameraProjection,
    /// The beginning of the path in model space, and the signer's directions.
    base: DVec3,
    axes: DMat3,
    /// The points that can be pulled, in metres to the left, up and forward of the base.
    points: Vec<DVec3>,
    /// Positions along the path in the window, with the same number of pieces between any two points.
    line: Vec<Pos2>,
    /// The number of the recipe's card that holds the path.
    card: u64,
    /// The index of the camera that shows the picture.
    eye: usize,
}

/// The point that is being pulled, by its index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PathPull {
    point: usize,
}

/// Shows the path over a picture of generated movement, and handles drags of it.
pub(super) fn show_stage_path(
    stage: &mut StagePane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    pane: &StagePart,
    projection: CameraProjection,
    pose: &ModelPose,
) {
    let (Some(course), Some(showing)) = (&seen.shown.course, &seen.shown.made) else {
        stage.pull = None;
        return;
    };
    let made = &showing.made;
    let Some(directions) = SignerDirections::directions_from_clip(&made.clip, &made.anatomy) else {
        return;
    };
    let sides = course.travel.hand.chosen_sides(made.handedness);
    let dominant = made.handedness.signer_dominant_side();
    let side = sides.iter().find(|side| **side == dominant);
    let Some(side) = side.or(sides.first()).copied() else {
        return;
    };
    // A posture of the skeleton before has other joints.
    if made.clip.clip_frame_count() == 0 || pose.model_joint_positions().len() < made.clip.clip_skeleton().len() {
        return;
    }
    let Some(wrist) = made.anatomy.part_joint(Joint::Hand(side)) else {
        return;
    };
    let base = made.clip.model_pose(0).model_joint_position(wrist);
    let axes = directions.axes;
    let places = course.course_positions(directions.arm);
    let spot = |at: DVec3| project_path_position(&projection, pane.rect, base + axes * at);
    let layout = PathInPicture {
        pane: pane.rect,
        projection: &projection,
        base,
        axes,
        line: places.into_iter().map(spot).collect(),
        points: course.course_points(directions.arm),
        card: course.card,
        eye: pane.eye,
    };
    let painter = ui.painter().with_clip_rect(pane.rect);
    paint_stage_path(&painter, seen, &layout);
    // While a new path is drawn, the old one must not be pulled.
    if drawing_card_id(ui.ctx()) == Some(course.card) {
        draw_new_path(ui, seen, &layout);
        return;
    }
    pull_line(stage, ui, seen, &layout);
    for point in 0..layout.points.len() {
        pull_point(stage, ui, seen, &layout, point);
    }
}

/// Returns the point in the window for a position in model space.
fn project_path_position(projection: &CameraProjection, pane: Rect, at: DVec3) -> Pos2 {
    let seen = projection.project_point(at.as_vec3());
    pane.min + vec2(seen.x, seen.y)
}

/// Draws the path with a ring at its beginning and an arrow at its end.
fn paint_stage_path(painter: &Painter, seen: &PaneInput<'_>, laid: &PathInPicture<'_>) {
    let colours = seen.pane_colours();
    painter.line(
        laid.line.clone(),
        Stroke::new(5.0, colours.on_annotation.gamma_multiply(0.35)),
    );
    let stroke = Stroke::new(3.0, colours.playhead);
    if let [.., before, last] = laid.line[..] {
        painter.arrow(last, (last - before).normalized() * 14.0, stroke);
    }
    painter.line(laid.line.clone(), stroke);
    if let Some(first) = laid.line.first() {
        painter.circle_stroke(*first, 5.0, stroke);
    }
}

/// Handles a point of the path: it can be pulled, moved by keys, or removed by a click with the secondary button.
fn pull_point(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>, laid: &PathInPicture<'_>, point: usize) {
    let place = laid.base + laid.axes * laid.points[point];
    let screen_point = project_path_position(laid.projection, laid.pane, place);
    if !laid.pane.contains(screen_point) {
        return;
    }
    let id = path_widget_id(ui, laid).with(("point", point));
    let room = Rect::from_center_size(screen_point, Vec2::splat(PATH_POINT_SIZE_POINTS));
    let response = ui.interact(room, id, Sense::click_and_drag());
    let name = fill_text_braces(seen.say_text(words::COURSE_POINT), &[("n", &(point + 1))]);
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, &name));
    let lit = response.hovered() || response.dragged() || response.has_focus();
    let colours = seen.pane_colours();
    let painter = ui.painter().with_clip_rect(laid.pane);
    let radius = if lit { 8.0 } else { 6.0 };
    let stroke = Stroke::new(2.0, colours.on_chosen);
    painter.circle(screen_point, radius, colours.playhead, stroke);
    if response.clicked() {
        response.request_focus();
    }
    let mut points = laid.points.clone();
    // A path needs one point at least.
    if response.secondary_clicked() && points.len() > 1 {
        points.remove(point);
        return send_path_points(laid, &points, seen.out);
    }
    if response.dragged() {
        stage.pull = Some(PathPull { point });
        if let Some(to) = pulled_path_position(ui, laid, place) {
            points[point] = to;
            send_path_points(laid, &points, seen.out);
        }
    }
    if response.drag_stopped() {
        stage.pull = None;
    }
    if response.has_focus()
        && let Some(by) = path_key_step(ui, &response.id)
    {
        points[point] += by;
        send_path_points(laid, &points, seen.out);
    }
}

/// Handles pulls between the points: they insert a new point.
fn pull_line(stage: &mut StagePane, ui: &mut Ui, seen: &PaneInput<'_>, laid: &PathInPicture<'_>) {
    let id = path_widget_id(ui, laid).with("line");
    let pointer = ui.input(|input| input.pointer.interact_pos());
    let Some(pointer) = pointer.filter(|at| laid.pane.contains(*at)) else {
        return;
    };
    let dragged = ui.ctx().is_being_dragged(id);
    let line_points = laid.line.iter().enumerate();
    let near = line_points.map(|(nth, at)| (at.distance(pointer), nth));
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
    // A drag goes on even if the pointer leaves the line.
    if !dragged && nearest.is_none_or(|(far, _)| far > PATH_PULL_REACH_POINTS) {
        return;
    }
    let room = Rect::from_center_size(pointer, Vec2::splat(PATH_POINT_SIZE_POINTS));
    let response = ui.interact(room, id, Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, seen.say_text(words::COURSE_LINE)));
    let response = response.on_hover_cursor(CursorIcon::Grab);
    let mut points = laid.points.clone();
    if response.drag_started()
        && points.len() < MAX_PULLED_PATH_POINTS
        && let Some((_, nth)) = nearest
    {
        // The line has the same number of pieces between any two points.
        let pieces = (laid.line.len() - 1) / points.len().max(1);
        let point_index = (nth.saturating_sub(1) / pieces.max(1)).min(points.len());
        let origin = points.get(point_index).copied().unwrap_or_default();
        let place = laid.base + laid.axes * origin;
        if let Some(to) = pulled_path_position(ui, laid, place) {
            points.insert(point_index, to);
            stage.pull = Some(PathPull { point: point_index });
            return send_path_points(laid, &points, seen.out);
        }
    }
    if response.dragged()
        && let Some(pull) = stage.pull
        && let Some(point) = points.get(pull.point).copied()
    {
        let place = laid.base + laid.axes * point;
        if let Some(to) = pulled_path_position(ui, laid, place) {
            points[pull.point] = to;
            send_path_points(laid, &points, seen.out);
        }
    }
    if response.drag_stopped() {
        stage.pull = None;
    }
}

/// Draws a new path with the pointer, in the plane through its beginning that is perpendicular to the line of sight.
fn draw_new_path(ui: &mut Ui, seen: &PaneInput<'_>, laid: &PathInPicture<'_>) {
    let id = path_widget_id(ui, laid).with("draw");
    let response = ui.interact(laid.pane, id, Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, seen.say_text(words::DRAW_ON_STAGE)));
    let response = response.on_hover_cursor(CursorIcon::Crosshair);
    let mut line: Vec<Pos2> = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if response.drag_started() {
        line.clear();
    }
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged())
        // Closer points add nothing to a line on the screen.
        && line.last().is_none_or(|last| last.distance(at) > 2.0)
    {
        line.push(at);
    }
    let painter = ui.painter().with_clip_rect(laid.pane);
    painter.line(line.clone(), Stroke::new(3.0, seen.pane_colours().accent));
    if response.drag_stopped() {
        let sight = laid.projection.sight_direction().as_dvec3();
        let deep = line.iter().filter_map(|at| {
            let [x, y] = (*at - laid.pane.min).into();
            let place = SightRay::ray_through_point(laid.projection, [x, y]).on_plane(laid.base, sight)?;
            Some(laid.axes.transpose() * (place - laid.base))
        });
        let points = points_of_line(&deep.collect::<Vec<_>>());
        if !points.is_empty() {
            seen.send_command(WindowCommand::Travelled(laid.card, points));
            draw_on_stage(ui.ctx(), None);
        }
        line.clear();
    }
    ui.data_mut(|data| data.insert_temp(id, line));
}

/// Returns the position to which the pointer has pulled `place`, in the plane perpendicular to the line of sight; to
/// the left, up and forward of the base.
fn pulled_path_position(ui: &Ui, laid: &PathInPicture<'_>, place: DVec3) -> Option<DVec3> {
    let pointer = ui.input(|input| input.pointer.interact_pos())?;
    let [x, y] = (pointer - laid.pane.min).into();
    let sight = laid.projection.sight_direction().as_dvec3();
    let to = SightRay::ray_through_point(laid.projection, [x, y]).on_plane(place, sight)?;
    Some(laid.axes.transpose() * (to - laid.base))
}

/// Returns the distance by which a key moves a focused point, in metres to the left, up and forward: arrow keys, and
/// Page Up and Page Down for the depth.
fn path_key_step(ui: &Ui, id: &Id) -> Option<DVec3> {
    ui.memory_mut(|memory| {
        memory.set_focus_lock_filter(
            *id,
            eframe::egui::EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..eframe::egui::EventFilter::default()
            },
        );
    });
    let keys = [
        (Key::ArrowRight, DVec3::X),
        (Key::ArrowLeft, DVec3::NEG_X),
        (Key::ArrowUp, DVec3::Y),
        (Key::ArrowDown, DVec3::NEG_Y),
        (Key::PageDown, DVec3::Z),
        (Key::PageUp, DVec3::NEG_Z),
    ];
    ui.input_mut(|input| {
        let pressed = keys
            .into_iter()
            .find(|(key, _)| input.consume_key(Modifiers::NONE, *key));
        pressed.map(|(_, direction)| direction * PATH_KEY_STEP_METRES)
    })
}

/// Sends the path with these points to its card.
fn send_path_points(laid: &PathInPicture<'_>, points: &[DVec3], out: &CommandOutbox) {
    let points = points.iter().map(|at| lengths_from_position(*at)).collect();
    out.send_command(WindowCommand::Travelled(laid.card, points));
}

fn path_widget_id(ui: &Ui, laid: &PathInPicture<'_>) -> Id {
    ui.scope_id().with(("course", laid.eye))
}
