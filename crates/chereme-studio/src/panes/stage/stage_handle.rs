//! The handle of a placement on the stage: drawn at the placed wrists, dragged or moved by keys.

use chereme_figure::camera::CameraProjection;
use chereme_motion::{BodyAnatomy, BodyPart as Joint, BodySide, ModelPose};
use eframe::egui::{
    self, Align2, Color32, EventFilter, FontId, Id, Key, Modifiers, PointerButton, Pos2, Rect, Response, Role, Sense,
    Stroke, TextStyle, Ui, Vec2, WidgetInfo, vec2,
};
use glam::{DMat3, DVec3};

use super::gizmo::{self, GizmoDragStart, GizmoLayout, HandlePart, SightRay, SignerDirections};
use super::stage_data::StagePart as Pane;
use super::{MovementIdentity, StagePane, stage_ui};
use crate::action::Action;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::model::model_handle::PlacementHandle;
use crate::words::{fill_text_braces, recombine_words, stage_words as words};

/// The sizes of the middle and of the axes' ends for the pointer, in points.
const HANDLE_MIDDLE_SIZE_POINTS: f32 = 22.0;
const HANDLE_END_SIZE_POINTS: f32 = 24.0;
/// The distance from the handle, in points, within which a press grabs its nearest part instead of turning the eye. It
/// is large enough for a hand that moves while the user reaches for it.
const HANDLE_GRAB_REACH_POINTS: f32 = 34.0;
/// The distance of an arrow key, also with Shift, in metres; a drag with Ctrl snaps to multiples of the first.
const HANDLE_KEY_STEP_METRES: f64 = 0.01;
const FAR_STEP: f64 = 0.05;

/// The state of the handle between frames.
#[derive(Default)]
pub(super) struct HandleState {
    directions: Option<(MovementIdentity, Option<SignerDirections>)>,
    pub(super) grab: Option<HandleGrab>,
    /// The ids of its widgets in this frame.
    middles: Vec<Id>,
    /// The card, and its goal before the last drag or series of key presses.
    before: Option<(u64, chereme_corpus::recipe::PlacementGoal)>,
    /// The distance that the view was dragged with a mouse button other than that for the handle.
    pub(super) panned: Vec2,
}

impl HandleState {
    pub(super) fn has_focus(&self, ctx: &egui::Context) -> bool {
        let focused = ctx.memory(egui::Memory::focused);
        focused.is_some_and(|id| self.middles.contains(&id))
    }

    /// Forgets the widget ids of the last frame.
    pub(super) fn forget_handle_widgets(&mut self) {
        self.middles.clear();
    }
}

/// A drag in progress.
pub(super) struct HandleGrab {
    /// The posture when it began.
    pub(super) pose: ModelPose,
    card: u64,
    side: BodySide,
    begun: GizmoDragStart,
    was_playing: bool,
    /// Whether Escape was pressed, so that the rest of the drag has no effect.
    over: bool,
}

/// A handle in one picture.
struct HandleInView<'a> {
    handle: &'a PlacementHandle,
    directions: SignerDirections,
    value: [f64; 3],
    pane: Rect,
    projection: CameraProjection,
    side: BodySide,
    /// Whether the handle has axes, and not only its middle.
    whole: bool,
    /// The widget with the keyboard input.
    id: Id,
}

/// Shows the handle over a picture of generated movement.
pub(super) fn show_stage_handles(
    stage: &mut StagePane,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    pane: &Pane,
    projection: CameraProjection,
    pose: &ModelPose,
) {
    let (Some(handle), Some(showing)) = (&seen.shown.handle, &seen.shown.made) else {
        stage.holding.grab = None;
        return;
    };
    let made = &showing.made;
    let of = MovementIdentity(std::sync::Arc::as_ptr(made) as usize);
    // The directions of a movement are computed once, since they need many of its postures.
    if stage.holding.directions.as_ref().map(|entry| entry.0) != Some(of) {
        let directions = SignerDirections::directions_from_clip(&made.clip, &made.anatomy);
        stage.holding.directions = Some((of, directions));
    }
    let Some((_, Some(directions))) = stage.holding.directions else {
        return;
    };
    let Some(value) = handle.handle_offset_value(directions.arm) else {
        return;
    };
    let sides = handle.hand.chosen_sides(made.handedness);
    let dominant_side = sides
        .iter()
        .copied()
        .find(|side| *side == made.handedness.signer_dominant_side());
    let first = dominant_side.or(sides.first().copied());
    for &side in sides {
        let view_handle = HandleInView {
            handle,
            directions,
            value,
            pane: pane.rect,
            projection,
            side,
            // One of both hands has the axes: two crosses of arrows could not be distinguished.
            whole: Some(side) == first,
            id: handle_widget_id(ui, pane, side),
        };
        show_hand_handle(&mut stage.holding, ui, seen, &view_handle, &made.anatomy, pose);
    }
}

/// Returns the widget's id, which does not depend on the place of the picture: the line above the picture may become
/// higher while keys move a hand.
fn handle_widget_id(ui: &Ui, pane: &Pane, side: BodySide) -> Id {
    ui.scope_id().with(("handle", pane.eye, side.body_side_name()))
}

/// Shows the handle of one hand, and handles its drags.
fn show_hand_handle(
    holding: &mut HandleState,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    held: &HandleInView<'_>,
    anatomy: &BodyAnatomy,
    pose: &ModelPose,
) {
    let Some(wrist) = anatomy.part_joint(Joint::Hand(held.side)) else {
        return;
    };
    let wrist = pose.model_joint_position(wrist);
    let axes = held.directions.axes;
    let own_grab = holding.grab.as_ref().filter(|grab| grab.side == held.side);
    // During a drag the handle follows the value at once, while the posture comes later.
    let handle_origin = own_grab.map_or(wrist, |grab| grab.begun.gizmo_handle_position(held.value, axes));
    let Some(laid) = gizmo::lay_out_gizmo(&held.projection, handle_origin, axes) else {
        return;
    };
    let base = held.pane.min;
    let spot = |[x, y]: [f32; 2]| base + vec2(x, y);
    let middle = spot(laid.middle);
    if !held.pane.contains(middle) {
        return;
    }
    let id = held.id;
    let near = handle_grab_rect(held, &laid);
    let zone = ui.interact(near, id.with("near"), Sense::drag());
    // Other buttons move the picture even on the handle, which would swallow them.
    if zone.dragged() && !zone.dragged_by(PointerButton::Primary) {
        holding.panned = zone.drag_delta();
    }
    let mut ends = [None, None, None];
    if held.whole {
        for (nth, end) in laid.ends.iter().enumerate() {
            let Some(end) = end else { continue };
            let rect = Rect::from_center_size(spot(*end), Vec2::splat(HANDLE_END_SIZE_POINTS));
            let response = ui.interact(rect, id.with(("end", nth)), Sense::DRAG);
            let name = format!("{}, {}", hand_handle_name(seen, held.side), axis_name(seen, nth));
            let cm = held.value[nth] * 100.0;
            response.widget_info(|| WidgetInfo::slider(true, cm, &name));
            assisted(ui, seen.out, held, nth, response.id);
            ends[nth] = Some(response);
        }
    }
    let rect = Rect::from_center_size(middle, Vec2::splat(HANDLE_MIDDLE_SIZE_POINTS));
    let response = ui.interact(rect, id, Sense::click_and_drag());
    holding.middles.push(response.id);
    let text = value_text(seen, held);
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::Slider, true, hand_handle_name(seen, held.side));
        info.current_text_value = Some(text.clone());
        info
    });
    if response.clicked() {
        response.request_focus();
    }
    let pointer = ui.input(|input| input.pointer.interact_pos());
    let nearest = pointer.map_or(HandlePart::Middle, |at| nearest_handle_part(held, &laid, at));
    // A grabbed part stays grabbed, regardless of the pointer's position.
    let taken = own_part(holding, held).unwrap_or(nearest);
    let parts = ends
        .iter()
        .enumerate()
        .filter_map(|(nth, it)| Some((HandlePart::Axis(nth), it.as_ref()?)))
        .chain([(HandlePart::Middle, &response), (taken, &zone)]);
    let mut lit = None;
    for (part, response) in parts {
        if response.hovered() || response.dragged() {
            lit = Some(part);
        }
        let touched = TouchedHandle {
            part,
            response,
            origin: handle_origin,
            pose,
        };
        continue_handle_drag(holding, ui, seen, held, &touched);
    }
    handle_gizmo_keys(holding, ui, seen.out, held, &response);
    let grabbed = holding.grab.as_ref().filter(|grab| grab.side == held.side);
    let dragged = grabbed.map(|grab| (grab.begun.part, grab.begun.origin));
    paint_stage_handle(ui, seen, held, &laid, lit, response.has_focus(), dragged);
    if lit.is_some() || response.has_focus() {
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let near = pointer.filter(|_| dragged.is_some()).unwrap_or(middle);
        let below = near + vec2(14.0, 20.0);
        stage_ui::paint_caption_chip(ui, keep_in(held.pane, below), Align2::LEFT_TOP, &text);
    }
    response.on_hover_text(seen.say_text(words::HANDLE_HINT));
}

fn own_part(holding: &HandleState, held: &HandleInView<'_>) -> Option<HandlePart> {
    let grab = holding.grab.as_ref().filter(|grab| grab.side == held.side)?;
    Some(grab.begun.part)
}

/// Returns the parts of a handle in the picture, each as a line.
fn handle_part_lines(held: &HandleInView<'_>, laid: &GizmoLayout) -> impl Iterator<Item = (HandlePart, [Pos2; 2])> {
    let spot = |[x, y]: [f32; 2]| held.pane.min + vec2(x, y);
    let middle = spot(laid.middle);
    let ends = laid.ends.map(|end| end.filter(|_| held.whole).map(spot));
    let axis_ends = ends.into_iter().enumerate();
    let axes = axis_ends.filter_map(move |(nth, end)| Some((HandlePart::Axis(nth), [middle, end?])));
    axes.chain([(HandlePart::Middle, [middle, middle])])
}

/// Returns the rectangle around a handle in which a press can grab it.
fn handle_grab_rect(held: &HandleInView<'_>, laid: &GizmoLayout) -> Rect {
    let line_points = handle_part_lines(held, laid).flat_map(|(_, line)| line);
    let all: Vec<Pos2> = line_points.collect();
    Rect::from_points(&all)
        .expand(HANDLE_GRAB_REACH_POINTS)
        .intersect(held.pane)
}

/// Returns the part of a handle that is nearest to a point; of an axis, only the outer half is considered.
fn nearest_handle_part(held: &HandleInView<'_>, laid: &GizmoLayout, at: Pos2) -> HandlePart {
    let away = |[from, to]: [Pos2; 2]| {
        let along = to - from;
        let raw_share = (at - from).dot(along) / along.length_sq().max(1e-6);
        // The inner half of an axis is the middle's, which would be hard to hit otherwise.
        let share = if from == to { 0.0 } else { raw_share.clamp(0.5, 1.0) };
        (from + along * share).distance(at)
    };
    let parts = handle_part_lines(held, laid).map(|(part, line)| (part, away(line)));
    let nearest = parts.min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map_or(HandlePart::Middle, |pair| pair.0)
}

/// Lets assistive technology move the handle along an axis, in steps.
fn assisted(ui: &Ui, out: &CommandOutbox, held: &HandleInView<'_>, nth: usize, id: Id) {
    use egui::accesskit::Action::{Decrement, Increment};
    ui.ctx().accesskit_node_builder(id, |node| {
        node.add_action(Increment);
        node.add_action(Decrement);
    });
    let asked = |action| ui.input(|input| input.num_accesskit_action_requests(id, action));
    let steps = asked(Increment) as f64 - asked(Decrement) as f64;
    if steps != 0.0 {
        let mut value = held.value;
        value[nth] = gizmo::snap_gizmo_length(value[nth] + steps * HANDLE_KEY_STEP_METRES, None);
        send_handle_value(held, value, out);
    }
}

/// Moves the position of a text into the picture if necessary.
fn keep_in(pane: Rect, at: Pos2) -> Pos2 {
    let (x, y) = (pane.max.x - 210.0, pane.max.y - 26.0);
    egui::pos2(at.x.min(x).max(pane.min.x), at.y.min(y).max(pane.min.y))
}

fn hand_handle_name(seen: &PaneInput<'_>, side: BodySide) -> String {
    let hand = match side {
        BodySide::Right => recombine_words::RIGHT_HAND,
        BodySide::Left => recombine_words::LEFT_HAND,
    };
    fill_text_braces(seen.say_text(words::HANDLE), &[("hand", &seen.say_text(hand))])
}

fn axis_name(seen: &PaneInput<'_>, nth: usize) -> &'static str {
    seen.say_text(
        [
            recombine_words::TO_THE_LEFT,
            recombine_words::UPWARDS,
            recombine_words::IN_FRONT,
        ][nth],
    )
}

/// Returns the value as text: `left 3.2 · up 10.0 · back 0.5 cm`.
fn value_text(seen: &PaneInput<'_>, held: &HandleInView<'_>) -> String {
    let directions = [
        [recombine_words::LEFT, recombine_words::RIGHT],
        [recombine_words::UP, recombine_words::DOWN],
        [recombine_words::FORWARD, recombine_words::BACK],
    ];
    let parts = held
        .value
        .iter()
        .zip(directions)
        .enumerate()
        .map(|(nth, (metres, directions))| {
            let cm = metres.abs() * 100.0;
            let direction = if held.handle.is_point() && nth == 1 {
                recombine_words::ABOVE_FLOOR
            } else {
                directions[usize::from(*metres < 0.0)]
            };
            format!("{} {cm:.1}", seen.say_text(direction))
        });
    let parts: Vec<String> = parts.collect();
    format!("{} cm", parts.join(" · "))
}

/// A part of a handle with what the pointer does to it, the middle of the handle, and the body's posture.
struct TouchedHandle<'a> {
    part: HandlePart,
    response: &'a Response,
    origin: DVec3,
    pose: &'a ModelPose,
}

fn continue_handle_drag(
    holding: &mut HandleState,
    ui: &Ui,
    seen: &PaneInput<'_>,
    held: &HandleInView<'_>,
    touched: &TouchedHandle<'_>,
) {
    let (part, response) = (touched.part, touched.response);
    let ray = |place: Pos2| {
        let place = place - held.pane.min;
        SightRay::ray_through_point(&held.projection, [place.x, place.y])
    };
    // Playback stops as soon as the handle is pressed, and not only when it is dragged.
    let pressed = ui.input(|input| input.pointer.button_pressed(PointerButton::Primary));
    if pressed
        && response.is_pointer_button_down_on()
        && let Some(press) = ui.input(|input| input.pointer.press_origin())
    {
        ui.memory_mut(|memory| memory.request_focus(held.id));
        let was_playing = seen.shown.on_stage().is_playing();
        if was_playing {
            seen.send_command(WindowCommand::Do(Action::ShuttleStop));
        }
        holding.before = Some((held.handle.card, held.handle.to.clone()));
        holding.grab = Some(HandleGrab {
            pose: touched.pose.clone(),
            card: held.handle.card,
            side: held.side,
            begun: GizmoDragStart {
                part,
                origin: touched.origin,
                value: held.value,
                ray: ray(press),
                sight: held.projection.sight_direction().as_dvec3(),
            },
            was_playing,
            over: false,
        });
    }
    let Some(grab) = &mut holding.grab else {
        return;
    };
    // Several responses report one press: only that of the grabbed part counts.
    let is_own = grab.side == held.side && grab.begun.part == part && grab.card == held.handle.card;
    if !is_own {
        return;
    }
    if !grab.over && ui.input(|input| input.key_pressed(Key::Escape)) {
        grab.over = true;
        restore_handle_goal(&mut holding.before, held, seen.out);
    } else if !grab.over
        && (response.dragged() || response.is_pointer_button_down_on())
        && let Some(place) = response.interact_pointer_pos()
    {
        let step = ui.input(|input| input.modifiers.command.then_some(HANDLE_KEY_STEP_METRES));
        // A value that did not change needs no new movement.
        if let Some(value) = grab.begun.dragged_gizmo_value(ray(place), held.directions.axes, step)
            && value != held.value
        {
            send_handle_value(held, value, seen.out);
        }
    }
    // A press without a drag ends without an event of its own.
    if response.drag_stopped() || !ui.input(|input| input.pointer.any_down()) {
        if grab.was_playing {
            seen.send_command(WindowCommand::Do(Action::Play));
        }
        holding.grab = None;
    }
}

fn send_handle_value(held: &HandleInView<'_>, value: [f64; 3], out: &CommandOutbox) {
    let goal = held.handle.goal_with_value(value);
    out.send_command(WindowCommand::Placed(held.handle.card, goal));
}

/// Restores the card's goal.
fn restore_handle_goal(
    before: &mut Option<(u64, chereme_corpus::recipe::PlacementGoal)>,
    held: &HandleInView<'_>,
    out: &CommandOutbox,
) {
    if let Some((card, goal)) = before.take().filter(|entry| entry.0 == held.handle.card) {
        out.send_command(WindowCommand::Placed(card, goal));
    }
}

/// Moves with arrow keys in the plane of the picture, with Page Up and Page Down in depth; Escape restores the goal.
fn handle_gizmo_keys(
    holding: &mut HandleState,
    ui: &Ui,
    out: &CommandOutbox,
    held: &HandleInView<'_>,
    response: &Response,
) {
    if !response.has_focus() {
        // The state that Escape restores is kept as long as the handle has the focus.
        if response.lost_focus() {
            holding.before = None;
        }
        return;
    }
    ui.memory_mut(|memory| {
        let filter = EventFilter {
            tab: false,
            horizontal_arrows: true,
            vertical_arrows: true,
            escape: true,
        };
        memory.set_focus_lock_filter(response.id, filter);
    });
    // Keys during a drag would fight with the pointer.
    if holding.grab.is_some() {
        return;
    }
    let mut offset = [0.0; 3];
    let mut escape = false;
    ui.input_mut(|input| {
        // Shift first: a key with Shift would be consumed by the plain one as well.
        for (shift, step) in [(Modifiers::SHIFT, FAR_STEP), (Modifiers::NONE, HANDLE_KEY_STEP_METRES)] {
            for (key, at, sign) in [
                (Key::ArrowRight, 0, 1.0),
                (Key::ArrowLeft, 0, -1.0),
                (Key::ArrowUp, 1, 1.0),
                (Key::ArrowDown, 1, -1.0),
                (Key::PageUp, 2, 1.0),
                (Key::PageDown, 2, -1.0),
            ] {
                let times = input.count_and_consume_key(shift, key);
                offset[at] += sign * step * times as f64;
            }
        }
        escape = input.consume_key(Modifiers::NONE, Key::Escape);
    });
    if offset != [0.0; 3] {
        if holding.before.is_none() {
            holding.before = Some((held.handle.card, held.handle.to.clone()));
        }
        let axes = held.directions.axes;
        send_handle_value(
            held,
            gizmo::step_gizmo_value(held.value, offset, &held.projection, axes),
            out,
        );
    } else if escape {
        // Escape first takes the change back, and only then leaves the handle.
        if holding.before.is_some() {
            restore_handle_goal(&mut holding.before, held, out);
        } else {
            response.surrender_focus();
        }
    }
}

/// Draws the handle: arrows with a letter each, a ring in the middle, and the offset of the drag.
fn paint_stage_handle(
    ui: &Ui,
    seen: &PaneInput<'_>,
    held: &HandleInView<'_>,
    laid: &GizmoLayout,
    lit: Option<HandlePart>,
    focus: bool,
    dragged: Option<(HandlePart, DVec3)>,
) {
    let colours = seen.pane_colours();
    let painter = ui.painter().with_clip_rect(held.pane);
    let spot = |[x, y]: [f32; 2]| held.pane.min + vec2(x, y);
    let middle = spot(laid.middle);
    let paper = ui.visuals().extreme_bg_color;
    // A dashed line shows from where the place was dragged.
    if let Some((_, origin)) = dragged
        && let Some(from) = gizmo::lay_out_gizmo(&held.projection, origin, DMat3::IDENTITY)
    {
        let stroke = Stroke::new(1.5, colours.accent);
        let line = [spot(from.middle), middle];
        painter.extend(egui::Shape::dashed_line(&line, stroke, 5.0, 4.0));
        painter.circle_stroke(spot(from.middle), 4.0, stroke);
    }
    let hues = [colours.accent, colours.good, colours.playhead];
    let letters: Vec<char> = seen.say_text(words::HANDLE_LETTERS).chars().collect();
    if held.whole {
        for (nth, end) in laid.ends.iter().enumerate() {
            let Some(end) = end.map(spot) else { continue };
            let on = lit == Some(HandlePart::Axis(nth));
            paint_handle_arrow(&painter, [middle, end], hues[nth], paper, on);
            let letter = letters.get(nth).copied().unwrap_or(' ');
            let small = TextStyle::Small.resolve(ui.style());
            let font = FontId::new(small.size, small.family);
            painter.text(end, Align2::CENTER_CENTER, letter, font, paper);
        }
    }
    let on = lit == Some(HandlePart::Middle) || focus;
    let radius = if on { 8.0 } else { 6.5 };
    painter.circle(
        middle,
        radius,
        paper.gamma_multiply(0.85),
        Stroke::new(2.5, colours.accent),
    );
    if focus {
        painter.circle_stroke(middle, 12.0, Stroke::new(1.5, colours.accent));
    }
}

/// Draws a line with a disc at its end for a letter.
fn paint_handle_arrow(painter: &egui::Painter, [from, to]: [Pos2; 2], hue: Color32, paper: Color32, on: bool) {
    let width = if on { 4.0 } else { 2.5 };
    painter.line_segment([from, to], Stroke::new(width + 2.0, paper.gamma_multiply(0.7)));
    painter.line_segment([from, to], Stroke::new(width, hue));
    let radius = if on { 10.5 } else { 9.0 };
    painter.circle(to, radius, hue, Stroke::new(1.5, paper));
}
