//! Ways of the hands: an offset as three lengths, and a path drawn with the pointer.

use chereme_corpus::recipe::{Direction, Leg, Length, towards};
use chereme_motion::glam::DVec3;
use eframe::egui::{
    Align2, Id, Pos2, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, pos2,
    vec2,
};

use super::fields::{self, caption, choose, tidy};
use crate::context::Seen;
use crate::words::recombine as words;

/// How many metres the drawing board shows from edge to edge.
const BOARD: f32 = 0.8;
/// Ways shorter than this in metres are no part of a path.
const LEAST: f64 = 0.02;

/// Returns the legs of an offset to the left, up and forward, in metres; an empty list for a zero offset.
pub(super) fn legs_of(offset: [f64; 3]) -> Vec<Leg> {
    let axes = [
        (Direction::Left, Direction::Right),
        (Direction::Up, Direction::Down),
        (Direction::Forward, Direction::Back),
    ];
    let leg = |(metres, (plus, minus)): (f64, (Direction, Direction))| Leg {
        towards: vec![if metres < 0.0 { minus } else { plus }],
        distance: Length::Metres(metres.abs()),
        time: None,
    };
    let all = offset.into_iter().zip(axes);
    all.filter(|(metres, _)| *metres != 0.0).map(leg).collect()
}

/// Returns the legs of an offset, one of length zero for a zero offset: that is an offset still.
pub(crate) fn offset_legs(offset: [f64; 3]) -> Vec<Leg> {
    let mut legs = legs_of(offset);
    if legs.is_empty() {
        legs.push(Leg {
            towards: vec![Direction::Up],
            distance: Length::Metres(0.0),
            time: None,
        });
    }
    legs
}

/// Returns the sum of ways in metres to the left, up and forward, where each goes along one axis.
pub(super) fn offset_of(legs: &[Leg]) -> Option<[f64; 3]> {
    let mut sum = DVec3::ZERO;
    for leg in legs {
        let (Length::Metres(metres), [one], None) =
            (leg.distance, leg.towards.as_slice(), leg.time)
        else {
            return None;
        };
        sum += one.vector() * metres;
    }
    Some(sum.to_array().map(|metres| tidy(metres * 100.0) / 100.0))
}

/// Shows an offset as three lengths, or as legs if it needs more than that.
pub(super) fn offset(ui: &mut Ui, seen: &Seen<'_>, legs: &mut Vec<Leg>) -> bool {
    let Some(mut offset) = offset_of(legs) else {
        return rows(ui, seen, legs, false);
    };
    let names = [words::TO_THE_LEFT, words::UPWARDS, words::IN_FRONT];
    let mut changed = false;
    for (metres, text) in offset.iter_mut().zip(names) {
        ui.horizontal(|ui| {
            ui.scope(|ui| {
                ui.set_min_width(64.0);
                caption(ui, seen, text);
            });
            let mut cm = tidy(*metres * 100.0);
            if fields::slide(ui, seen.say(text), &mut cm, -50.0..=50.0, " cm") {
                *metres = tidy(cm) / 100.0;
                changed = true;
            }
        });
    }
    if changed {
        *legs = offset_legs(offset);
    }
    changed
}

/// Shows each way with its directions, length and time.
fn rows(ui: &mut Ui, seen: &Seen<'_>, legs: &mut Vec<Leg>, timed: bool) -> bool {
    let mut changed = false;
    let mut gone = None;
    let several = legs.len() > 1;
    for (at, leg) in legs.iter_mut().enumerate() {
        ui.push_id(at, |ui| {
            let name = format!("{} {}", seen.say(words::WAY), at + 1);
            ui.horizontal_wrapped(|ui| {
                ui.weak(format!("{}.", at + 1));
                changed |= fields::directions(ui, seen, &name, &mut leg.towards);
            });
            ui.horizontal_wrapped(|ui| {
                changed |= fields::length(ui, seen, &name, &mut leg.distance, 60.0);
                if timed {
                    changed |= fields::time(ui, seen, words::IN_TIME, &mut leg.time, 0.4);
                }
                if several
                    && ui
                        .small_button("×")
                        .on_hover_text(seen.say(words::REMOVE))
                        .clicked()
                {
                    gone = Some(at);
                }
            });
            if leg.towards.is_empty() {
                leg.towards.push(Direction::Up);
            }
        });
    }
    if let Some(at) = gone {
        legs.remove(at);
        changed = true;
    }
    changed
}

/// From where the drawing board is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Board {
    /// From the front: the signer's left is to the right.
    #[default]
    Front,
    /// From above, the signer at the top, facing down.
    Above,
    /// From the signer's left, the signer facing left.
    Side,
}

impl Board {
    /// Returns the directions to the right and up on the board, and their opposites.
    fn axes(self) -> [Direction; 4] {
        match self {
            Self::Front => [
                Direction::Left,
                Direction::Up,
                Direction::Right,
                Direction::Down,
            ],
            Self::Above => [
                Direction::Left,
                Direction::Back,
                Direction::Right,
                Direction::Forward,
            ],
            Self::Side => [
                Direction::Back,
                Direction::Up,
                Direction::Forward,
                Direction::Down,
            ],
        }
    }

    /// Returns where a way goes on the board, in metres to the right and down.
    fn flat(self, way: DVec3) -> Vec2 {
        let [right, up, ..] = self.axes();
        vec2(way.dot(right.vector()) as f32, -way.dot(up.vector()) as f32)
    }

    /// Returns the way nearest to a stroke of metres to the right and down: along an axis of the
    /// board, or half-way between two; nothing for one that is too short.
    fn leg(self, stroke: Vec2) -> Option<Leg> {
        let length = f64::from(stroke.length());
        if length < LEAST {
            return None;
        }
        let [right, up, left, down] = self.axes();
        let turns = [
            vec![right],
            vec![right, up],
            vec![up],
            vec![left, up],
            vec![left],
            vec![left, down],
            vec![down],
            vec![right, down],
        ];
        let angle = f64::from((-stroke.y).atan2(stroke.x));
        let eighth = (angle / std::f64::consts::FRAC_PI_4)
            .round()
            .rem_euclid(8.0) as usize;
        Some(Leg {
            towards: turns[eighth % 8].clone(),
            distance: Length::Metres((length * 100.0).round() / 100.0),
            time: None,
        })
    }
}

/// Returns the ways of a drawn line, in metres to the right and down on `board`: its corners are
/// those that stand out by more than a fifteenth of its size, and ways in one direction are one.
pub(super) fn legs_of_line(line: &[Vec2], board: Board) -> Vec<Leg> {
    let bounds = Rect::from_points(&line.iter().map(|it| it.to_pos2()).collect::<Vec<Pos2>>());
    let tolerance = (bounds.size().length() / 15.0).max(0.01);
    let mut corners = Vec::new();
    corners_of(line, tolerance, &mut corners);
    corners.extend(line.last());
    let mut legs: Vec<Leg> = Vec::new();
    for pair in corners.windows(2) {
        let Some(leg) = board.leg(pair[1] - pair[0]) else {
            continue;
        };
        match legs.last_mut() {
            Some(last) if last.towards == leg.towards => {
                let metres = last.distance.metres(1.0) + leg.distance.metres(1.0);
                last.distance = Length::Metres((metres * 100.0).round() / 100.0);
            }
            _ => legs.push(leg),
        }
    }
    legs
}

/// Adds the corners of a line but for its last point, after Douglas and Peucker.
fn corners_of(line: &[Vec2], tolerance: f32, corners: &mut Vec<Vec2>) {
    let (Some(first), Some(last)) = (line.first(), line.last()) else {
        return;
    };
    let along = (*last - *first).normalized();
    let off = |point: &Vec2| {
        let way = *point - *first;
        (way - along * way.dot(along)).length()
    };
    let farthest = line
        .iter()
        .enumerate()
        .map(|(at, point)| (at, off(point)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match farthest {
        Some((at, distance)) if distance > tolerance && at > 0 && at + 1 < line.len() => {
            corners_of(&line[..=at], tolerance, corners);
            corners_of(&line[at..], tolerance, corners);
        }
        _ => corners.push(*first),
    }
}

/// Shows a path: a board to draw it on, and its ways below.
pub(super) fn show(ui: &mut Ui, seen: &Seen<'_>, id: Id, path: &mut Vec<Leg>) -> bool {
    let mut board: u8 = ui.data(|data| data.get_temp(id.with("board"))).unwrap_or(0);
    let boards = [
        (0, seen.say(words::BOARD_FRONT)),
        (1, seen.say(words::BOARD_ABOVE)),
        (2, seen.say(words::BOARD_SIDE)),
    ];
    if choose(ui, seen.say(words::BOARD), &mut board, &boards) {
        ui.data_mut(|data| data.insert_temp(id.with("board"), board));
    }
    let board = [Board::Front, Board::Above, Board::Side][usize::from(board.min(2))];
    let drawn = draw(ui, seen, id, path, board);
    let mut changed = drawn.is_some();
    if let Some(legs) = drawn {
        *path = legs;
    }
    changed |= rows(ui, seen, path, true);
    if ui.small_button(seen.say(words::ADD_WAY)).clicked() {
        path.push(Leg {
            towards: vec![Direction::Up],
            distance: Length::Metres(0.1),
            time: None,
        });
        changed = true;
    }
    changed
}

/// Shows the board; returns the path that was drawn on it.
fn draw(ui: &mut Ui, seen: &Seen<'_>, id: Id, path: &[Leg], board: Board) -> Option<Vec<Leg>> {
    let side = ui.available_width().clamp(80.0, 220.0);
    let (rect, response) = ui.allocate_exact_size(vec2(side, side * 0.7), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, seen.say(words::BOARD_DRAW)));
    let (painter, colours) = (ui.painter().with_clip_rect(rect), seen.colours());
    let rule = Stroke::new(1.0, colours.rule);
    painter.rect(
        rect,
        4.0,
        ui.visuals().extreme_bg_color,
        rule,
        StrokeKind::Inside,
    );
    let scale = side / BOARD;
    for tenth in -4..=4 {
        let x = rect.center().x + tenth as f32 * 0.1 * scale;
        let y = rect.center().y + tenth as f32 * 0.1 * scale;
        painter.vline(x, rect.y_range(), Stroke::new(1.0, colours.stripe));
        painter.hline(rect.x_range(), y, Stroke::new(1.0, colours.stripe));
    }
    if !response.dragged() {
        // In the picture, for a tip beside the pointer would lie over the ways below.
        let font = TextStyle::Small.resolve(ui.style());
        let at = rect.center_bottom() - vec2(0.0, 4.0);
        let weak = ui.visuals().weak_text_color();
        painter.text(
            at,
            Align2::CENTER_BOTTOM,
            seen.say(words::BOARD_DRAW),
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
    if let Some(at) = response
        .interact_pointer_pos()
        .filter(|_| response.dragged())
    {
        if line.last().is_none_or(|last| last.distance(at) > 2.0) {
            line.push(at);
        }
        ui.data_mut(|data| data.insert_temp(line_id, line.clone()));
    }
    if response.drag_stopped() {
        let metres: Vec<Vec2> = line.iter().map(|at| (*at - line[0]) / scale).collect();
        drawn = Some(legs_of_line(&metres, board)).filter(|legs| !legs.is_empty());
        line.clear();
        ui.data_mut(|data| data.remove::<Vec<Pos2>>(line_id));
    }
    if line.len() > 1 {
        let stroke = Stroke::new(3.0, colours.playhead);
        painter.line(line, stroke);
        return drawn;
    }
    let points = points_of(path, board);
    let shift = rect.center() - (bounds(&points).center() * scale);
    let points: Vec<Pos2> = points
        .iter()
        .map(|at| pos2(at.x, at.y) * scale + shift)
        .collect();
    for pair in points.windows(2) {
        painter.arrow(pair[0], pair[1] - pair[0], Stroke::new(2.5, colours.accent));
    }
    if let Some(first) = points.first() {
        painter.circle_filled(*first, 4.0, colours.accent);
    }
    drawn
}

/// Returns where each way of a path begins and the last ends on the board, in metres.
fn points_of(path: &[Leg], board: Board) -> Vec<Pos2> {
    let mut at = DVec3::ZERO;
    let mut points = vec![Pos2::ZERO];
    for leg in path {
        at += towards(&leg.towards).unwrap_or_default() * leg.distance.metres(0.6);
        points.push(board.flat(at).to_pos2());
    }
    points
}

fn bounds(points: &[Pos2]) -> Rect {
    Rect::from_points(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_are_ways_along_the_axes_and_back() {
        let legs = legs_of([0.25, -0.05, 0.0]);
        let texts: Vec<String> = legs.iter().map(Leg::to_string).collect();
        assert_eq!(texts, ["left 25cm", "down 5cm"]);
        assert_eq!(offset_of(&legs), Some([0.25, -0.05, 0.0]));
        let parsed: chereme_corpus::recipe::Recipe =
            "A | place both by left up 10cm".parse().expect("a recipe");
        assert!(parsed.to_string().contains("left up"));
        let diagonal = Leg {
            towards: vec![Direction::Left, Direction::Up],
            distance: Length::Metres(0.1),
            time: None,
        };
        assert_eq!(offset_of(&[diagonal]), None);
        assert_eq!(offset_of(&[]), Some([0.0; 3]));
    }

    #[test]
    fn a_drawn_line_becomes_ways_in_eight_directions() {
        let texts = |points: &[(f32, f32)], board| -> Vec<String> {
            let mut line = Vec::new();
            for pair in points.windows(2) {
                for step in 0..20 {
                    let t = step as f32 / 20.0;
                    let mix = |a: f32, b: f32| a + (b - a) * t;
                    line.push(vec2(mix(pair[0].0, pair[1].0), mix(pair[0].1, pair[1].1)));
                }
            }
            line.extend(points.last().map(|(x, y)| vec2(*x, *y)));
            let legs = legs_of_line(&line, board);
            legs.iter().map(Leg::to_string).collect()
        };
        let corner = [(0.0, 0.0), (0.2, 0.01), (0.2, 0.3)];
        assert_eq!(texts(&corner, Board::Front), ["left 20cm", "down 29cm"]);
        assert_eq!(texts(&corner, Board::Above), ["left 20cm", "forward 29cm"]);
        assert_eq!(texts(&corner, Board::Side), ["back 20cm", "down 29cm"]);
        let slope = [(0.0, 0.0), (-0.1, -0.1)];
        assert_eq!(texts(&slope, Board::Front), ["right up 14cm"]);
        assert!(texts(&[(0.0, 0.0), (0.001, 0.0)], Board::Front).is_empty());
    }
}
