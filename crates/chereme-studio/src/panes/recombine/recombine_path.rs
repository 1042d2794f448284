//! Offsets and paths of the hands: an offset as three lengths, and a path drawn with the pointer.

use chereme_corpus::recipe::{BodyDirection, MeasuredSpline, RecipeLength, StraightLeg, TravelSettings};
use chereme_motion::glam::DVec3;
use eframe::egui::{
    Align2, Context, Id, Pos2, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::recombine_fields::{self, round_shown_number, show_field_caption, show_value_choice};
use crate::context::PaneInput;
use crate::model::model_handle::{offset_legs, points_of};
use crate::words::{fill_text_braces, recombine_words as words};

/// Width of the space that the drawing board shows, in metres.
const DRAWING_BOARD_WIDTH_METRES: f32 = 0.8;
/// A drawn line smaller than this, in metres, is ignored.
const MIN_DRAWN_LINE_METRES: f64 = 0.02;
/// The most points of a drawn path.
const MAX_DRAWN_PATH_POINTS: usize = 24;

/// Returns the sum of legs in metres to the left, up and forward; `None` if a leg does not follow one axis.
pub(super) fn offset_of(legs: &[StraightLeg]) -> Option<[f64; 3]> {
    let mut sum = DVec3::ZERO;
    for leg in legs {
        let (RecipeLength::Metres(metres), [one], None) = (leg.distance, leg.towards.as_slice(), leg.time) else {
            return None;
        };
        sum += one.direction_unit_vector() * metres;
    }
    Some(sum.to_array().map(|metres| round_shown_number(metres * 100.0) / 100.0))
}

/// Shows an offset as three lengths, or as legs if they do not follow the axes.
pub(super) fn show_offset_field(ui: &mut Ui, seen: &PaneInput<'_>, legs: &mut Vec<StraightLeg>) -> bool {
    let Some(mut offset) = offset_of(legs) else {
        return show_leg_rows(ui, seen, legs, false);
    };
    let names = [words::TO_THE_LEFT, words::UPWARDS, words::IN_FRONT];
    let mut changed = false;
    for (metres, text) in offset.iter_mut().zip(names) {
        ui.horizontal(|ui| {
            ui.scope(|ui| {
                ui.set_min_width(64.0);
                show_field_caption(ui, seen, text);
            });
            let mut cm = round_shown_number(*metres * 100.0);
            if recombine_fields::show_number_slider(ui, seen.say_text(text), &mut cm, -50.0..=50.0, " cm") {
                *metres = round_shown_number(cm) / 100.0;
                changed = true;
            }
        });
    }
    if changed {
        *legs = offset_legs(offset);
    }
    changed
}

/// Shows each leg with its directions, length and time.
fn show_leg_rows(ui: &mut Ui, seen: &PaneInput<'_>, legs: &mut Vec<StraightLeg>, timed: bool) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = legs.len() > 1;
    for (at, leg) in legs.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            let name = format!("{} {}", seen.say_text(words::LEG), at + 1);
            ui.horizontal_wrapped(|ui| {
                ui.weak(format!("{}.", at + 1));
                changed |= recombine_fields::show_direction_switches(ui, seen, &name, &mut leg.towards);
            });
            ui.horizontal_wrapped(|ui| {
                changed |= recombine_fields::show_length_field(ui, seen, &name, &mut leg.distance, 60.0);
                if timed {
                    changed |= recombine_fields::show_time_field(ui, seen, words::IN_TIME, &mut leg.time, 0.4);
                }
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say_text(words::REMOVE))
                        .clicked()
                {
                    gone = Some(at);
                }
            });
            if leg.towards.is_empty() {
                leg.towards.push(BodyDirection::Up);
            }
        });
    }
    if let Some(at) = gone {
        legs.remove(at);
        changed = true;
    }
    changed
}

/// The direction of view of the drawing board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum BoardView {
    /// From the front: the signer's left is to the right.
    #[default]
    Front,
    /// From above, the signer at the top, facing down.
    Above,
    /// From the signer's left, the signer facing left.
    Side,
}

impl BoardView {
    /// Returns the directions to the right and up on the board, and their opposites.
    fn board_axes(self) -> [BodyDirection; 4] {
        match self {
            Self::Front => [
                BodyDirection::Left,
                BodyDirection::Up,
                BodyDirection::Right,
                BodyDirection::Down,
            ],
            Self::Above => [
                BodyDirection::Left,
                BodyDirection::Back,
                BodyDirection::Right,
                BodyDirection::Forward,
            ],
            Self::Side => [
                BodyDirection::Back,
                BodyDirection::Up,
                BodyDirection::Forward,
                BodyDirection::Down,
            ],
        }
    }

    /// Projects an offset onto the board, in metres to the right and down.
    fn project_onto_board(self, offset: DVec3) -> Vec2 {
        let [right, up, ..] = self.board_axes();
        vec2(
            offset.dot(right.direction_unit_vector()) as f32,
            -offset.dot(up.direction_unit_vector()) as f32,
        )
    }

    /// Returns the offset in space (to the left, up and forward) of an offset on the board, in metres to the right and
    /// down.
    fn deep(self, offset: Vec2) -> DVec3 {
        let [right, up, ..] = self.board_axes();
        right.direction_unit_vector() * f64::from(offset.x) - up.direction_unit_vector() * f64::from(offset.y)
    }
}

/// Returns points of a drawn line, in metres to the left, up and forward of its beginning: just enough that the curve
/// through them is nowhere farther from the line than a thirtieth of its size or 5 mm. Returns an empty list if the
/// line is too short.
pub(crate) fn points_of_line(line: &[DVec3]) -> Vec<[RecipeLength; 3]> {
    let Some(first) = line.first() else {
        return Vec::new();
    };
    let line: Vec<DVec3> = line.iter().map(|at| *at - *first).collect();
    let size = line.iter().map(|at| at.length()).fold(0.0, f64::max);
    if size < MIN_DRAWN_LINE_METRES {
        return Vec::new();
    }
    let tolerance = (size / 30.0).max(0.005);
    let mut knots = vec![line.len() - 1];
    while knots.len() < MAX_DRAWN_PATH_POINTS {
        let points: Vec<DVec3> = knots.iter().map(|&at| line[at]).collect();
        let spline = MeasuredSpline::new(&points);
        let off = |at: &DVec3| {
            let far = spline.spline_drawing_points().iter().map(|place| place.distance(*at));
            far.fold(f64::INFINITY, f64::min)
        };
        let all = line.iter().enumerate().map(|(at, place)| (off(place), at));
        let worst = all.max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, at)) = worst.filter(|(far, at)| *far > tolerance && !knots.contains(at)) else {
            break;
        };
        knots.push(at);
        knots.sort_unstable();
    }
    knots.iter().map(|&at| lengths_from_position(line[at])).collect()
}

/// Returns a position as lengths rounded to millimetres, which recipes write in centimetres.
pub(crate) fn lengths_from_position(place: DVec3) -> [RecipeLength; 3] {
    let cm = |value: f64| (value * 1000.0).round() / 10.0 + 0.0;
    place.to_array().map(|value| RecipeLength::Metres(cm(value) / 100.0))
}

/// Returns the id of the card whose path the next drag on the stage draws.
pub(crate) fn drawing_card_id(ctx: &Context) -> Option<u64> {
    ctx.data(|data| data.get_temp(Id::unique(DRAWING_CARD_KEY)))
}

/// Makes the next drag on the stage draw the path of a card; `None` ends that.
pub(crate) fn draw_on_stage(ctx: &Context, card: Option<u64>) {
    ctx.data_mut(|data| match card {
        Some(card) => drop(data.insert_temp(Id::unique(DRAWING_CARD_KEY), card)),
        None => drop(data.remove_temp::<u64>(Id::unique(DRAWING_CARD_KEY))),
    });
}

const DRAWING_CARD_KEY: &str = "path drawn on the stage";

/// Shows a path: a board to draw it on, and below it its legs or the points of its curve.
pub(super) fn show_travel_path(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    card: u64,
    travel: &mut TravelSettings,
) -> bool {
    let on = drawing_card_id(ui.ctx()) == Some(card);
    let button = ui.selectable_label(on, seen.say_text(words::DRAW_ON_STAGE));
    if button.on_hover_text(seen.say_text(words::DRAW_ON_STAGE_HINT)).clicked() {
        draw_on_stage(ui.ctx(), (!on).then_some(card));
    }
    let mut board: u8 = ui.data(|data| data.get_temp(id.with("board"))).unwrap_or(0);
    let boards = [
        (0, seen.say_text(words::BOARD_FRONT)),
        (1, seen.say_text(words::BOARD_ABOVE)),
        (2, seen.say_text(words::BOARD_SIDE)),
    ];
    if show_value_choice(ui, seen.say_text(words::BOARD), &mut board, &boards) {
        ui.data_mut(|data| data.insert_temp(id.with("board"), board));
    }
    let board = [BoardView::Front, BoardView::Above, BoardView::Side][usize::from(board.min(2))];
    let drawn = draw_path_board(ui, seen, id, travel, board);
    let mut changed = drawn.is_some();
    if let Some(points) = drawn {
        // A drawn curve replaces straight legs: a path is one or the other.
        (travel.through, travel.path) = (points, Vec::new());
    }
    if !travel.through.is_empty() {
        ui.horizontal_wrapped(|ui| {
            let count = travel.through.len();
            ui.weak(fill_text_braces(seen.say_text(words::CURVE), &[("n", &count)]));
            changed |= recombine_fields::show_time_field(ui, seen, words::IN_TIME, &mut travel.time, 1.0);
        });
        ui.weak(seen.say_text(words::CURVE_HINT));
        return changed;
    }
    changed |= show_leg_rows(ui, seen, &mut travel.path, true);
    if ui.small_button(seen.say_text(words::ADD_LEG)).clicked() {
        travel.path.push(StraightLeg {
            towards: vec![BodyDirection::Up],
            distance: RecipeLength::Metres(0.1),
            time: None,
        });
        changed = true;
    }
    changed
}

/// Shows the board; returns the points of a newly drawn path.
fn draw_path_board(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    id: Id,
    travel: &TravelSettings,
    board: BoardView,
) -> Option<Vec<[RecipeLength; 3]>> {
    let side = ui.available_width().clamp(80.0, 220.0);
    let (rect, response) = ui.allocate_exact_size(vec2(side, side * 0.7), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, seen.say_text(words::BOARD_DRAW)));
    let (painter, colours) = (ui.painter().with_clip_rect(rect), seen.pane_colours());
    let rule = Stroke::new(1.0, colours.rule);
    painter.rect(rect, 4.0, ui.visuals().extreme_bg_color, rule, StrokeKind::Inside);
    let scale = side / DRAWING_BOARD_WIDTH_METRES;
    for tenth in -4..=4 {
        let x = rect.center().x + tenth as f32 * 0.1 * scale;
        let y = rect.center().y + tenth as f32 * 0.1 * scale;
        painter.vline(x, rect.y_range(), Stroke::new(1.0, colours.stripe));
        painter.hline(rect.x_range(), y, Stroke::new(1.0, colours.stripe));
    }
    if !response.dragged() {
        // The text is in the picture, as a tooltip beside the pointer would cover the legs below.
        let font = TextStyle::Small.resolve(ui.style());
        let text_position = rect.center_bottom() - vec2(0.0, 4.0);
        let weak = ui.visuals().weak_text_color();
        painter.text(
            text_position,
            Align2::CENTER_BOTTOM,
            seen.say_text(words::BOARD_DRAW),
            font,
            weak,
        );
    }
    let line_id = id.with("line");
    let mut line: Vec<Pos2> = ui.data(|data| data.get_temp(line_id)).unwrap_or_default();
    let mut drawn = None;
    if response.drag_started() {
        line.clear();
    }
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        if line.last().is_none_or(|last| last.distance(at) > 2.0) {
            line.push(at);
        }
        ui.data_mut(|data| data.insert_temp(line_id, line.clone()));
    }
    if response.drag_stopped() {
        let metres = line.iter().map(|at| board.deep((*at - line[0]) / scale));
        let points = points_of_line(&metres.collect::<Vec<_>>());
        drawn = Some(points).filter(|points| !points.is_empty());
        line.clear();
        ui.data_mut(|data| data.remove::<Vec<Pos2>>(line_id));
    }
    if line.len() > 1 {
        let stroke = Stroke::new(3.0, colours.playhead);
        painter.line(line, stroke);
        return drawn;
    }
    let points = points_of(travel, 0.6);
    let offsets: Vec<DVec3> = if travel.through.is_empty() {
        std::iter::once(DVec3::ZERO).chain(points).collect()
    } else {
        MeasuredSpline::new(&points).spline_drawing_points().to_vec()
    };
    let flat: Vec<Pos2> = offsets
        .iter()
        .map(|at| board.project_onto_board(*at).to_pos2())
        .collect();
    let shift = rect.center() - (Rect::from_points(&flat).center() * scale);
    let flat: Vec<Pos2> = flat.iter().map(|at| pos2(at.x, at.y) * scale + shift).collect();
    let stroke = Stroke::new(2.5, colours.accent);
    if travel.through.is_empty() {
        for pair in flat.windows(2) {
            painter.arrow(pair[0], pair[1] - pair[0], stroke);
        }
    } else if let [.., before, last] = flat[..] {
        painter.arrow(before, (last - before) * 4.0, stroke);
        painter.line(flat.clone(), stroke);
    }
    if let Some(first) = flat.first() {
        painter.circle_filled(*first, 4.0, colours.accent);
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::model_handle::legs_of;

    #[test]
    fn offsets_convert_to_legs_along_the_axes_and_back() {
        let legs = legs_of([0.25, -0.05, 0.0]);
        let texts: Vec<String> = legs.iter().map(StraightLeg::to_string).collect();
        assert_eq!(texts, ["left 25cm", "down 5cm"]);
        assert_eq!(offset_of(&legs), Some([0.25, -0.05, 0.0]));
        let parsed: chereme_corpus::recipe::Recipe = "A | place both by left up 10cm".parse().expect("a recipe");
        assert!(parsed.to_string().contains("left up"));
        let diagonal = StraightLeg {
            towards: vec![BodyDirection::Left, BodyDirection::Up],
            distance: RecipeLength::Metres(0.1),
            time: None,
        };
        assert_eq!(offset_of(&[diagonal]), None);
        assert_eq!(offset_of(&[]), Some([0.0; 3]));
    }

    #[test]
    fn a_drawn_line_becomes_a_curve_along_it() {
        let loops: Vec<Vec2> = (0..=80)
            .map(|n| n as f32 / 80.0 * std::f32::consts::TAU)
            .map(|a| vec2(0.1 * a.sin(), 0.1 * a.cos() - 0.1))
            .collect();
        for (board, left) in [(BoardView::Front, 0), (BoardView::Above, 0), (BoardView::Side, 2)] {
            let line: Vec<DVec3> = loops.iter().map(|at| board.deep(*at)).collect();
            let points = points_of_line(&line);
            assert!(
                (6..=MAX_DRAWN_PATH_POINTS).contains(&points.len()),
                "{} points",
                points.len()
            );
            let travel = TravelSettings {
                through: points,
                ..straight(Vec::new())
            };
            let spline = MeasuredSpline::new(&points_of(&travel, 0.6));
            assert_eq!(spline.spline_shape_name(), "circle");
            for place in spline.spline_drawing_points() {
                let near = line.iter().map(|at| at.distance(*place));
                let near = near.fold(f64::INFINITY, f64::min);
                assert!(near < 0.012, "{near}");
            }
            let wide = spline
                .spline_drawing_points()
                .iter()
                .map(|at| at.to_array()[left].abs());
            assert!(wide.fold(0.0, f64::max) > 0.08, "{board:?}");
        }
        assert!(points_of_line(&[DVec3::ZERO, DVec3::X * 0.001]).is_empty());
        assert!(points_of_line(&[]).is_empty());
    }

    #[test]
    fn a_path_of_legs_passes_through_their_ends() {
        let legs = legs_of([0.25, -0.05, 0.0]);
        let points = points_of(&straight(legs), 0.6);
        assert_eq!(points.len(), 2);
        assert!(points[1].distance(DVec3::new(0.25, -0.05, 0.0)) < 1e-9);
    }

    fn straight(path: Vec<StraightLeg>) -> TravelSettings {
        TravelSettings {
            hand: chereme_corpus::recipe::HandChoice::Dominant,
            path,
            through: Vec::new(),
            time: None,
            via: chereme_corpus::recipe::PostureTransition::default(),
        }
    }
}
