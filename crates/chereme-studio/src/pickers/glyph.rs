//! Glyphs of movements.

use std::f32::consts::{PI, TAU};

use eframe::egui::{Color32, Painter, Pos2, Rect, Stroke, Vec2, vec2};

/// A line of a glyph, in a square from -1 to 1 with y down.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GlyphLine {
    pub(crate) points: Vec<Vec2>,
    /// Whether the line ends with an arrow head.
    pub(crate) arrow: bool,
    /// Line width relative to the usual.
    pub(crate) weight: f32,
}

fn glyph_line(points: impl IntoIterator<Item = (f32, f32)>) -> GlyphLine {
    GlyphLine {
        points: points.into_iter().map(|(x, y)| vec2(x, y)).collect(),
        arrow: false,
        weight: 1.0,
    }
}

fn glyph_arrow_line(points: impl IntoIterator<Item = (f32, f32)>) -> GlyphLine {
    GlyphLine {
        arrow: true,
        ..glyph_line(points)
    }
}

fn light(line: GlyphLine) -> GlyphLine {
    GlyphLine { weight: 0.55, ..line }
}

/// Returns `steps + 1` points of a curve, evaluated from 0 to 1.
fn sample_glyph_curve(steps: usize, at: impl Fn(f32) -> (f32, f32)) -> Vec<(f32, f32)> {
    (0..=steps).map(|step| at(step as f32 / steps as f32)).collect()
}

/// Returns part of a circle; `from` and `to` are in turns, clockwise from the right.
fn circle_arc_points(centre: (f32, f32), radius: f32, from: f32, to: f32) -> Vec<(f32, f32)> {
    sample_glyph_curve(28, |t| {
        let angle = (from + (to - from) * t) * TAU;
        (centre.0 + radius * angle.cos(), centre.1 + radius * angle.sin())
    })
}

/// Returns the lines of a built-in movement; `None` for others.
pub(crate) fn movement_glyph_lines(movement: &str) -> Option<Vec<GlyphLine>> {
    let hand = || light(glyph_line([(-0.28, 0.85), (-0.28, 0.3), (0.28, 0.3), (0.28, 0.85)]));
    let surface = || light(glyph_line([(-0.8, 0.62), (0.8, 0.62)]));
    Some(match movement {
        "hold" => vec![
            glyph_line([(-0.28, -0.5), (-0.28, 0.5)]),
            glyph_line([(0.28, -0.5), (0.28, 0.5)]),
        ],
        "path" => vec![glyph_arrow_line(sample_glyph_curve(30, |t| {
            (-0.8 + 1.6 * t, 0.45 * (t * 1.25 * PI + 0.6).sin() + 0.05)
        }))],
        "straight" => vec![glyph_arrow_line([(-0.8, 0.0), (0.8, 0.0)])],
        "arc" => vec![glyph_arrow_line(circle_arc_points((0.0, 0.45), 0.8, 0.5, 1.0))],
        "circle" => vec![glyph_arrow_line(circle_arc_points((0.0, 0.0), 0.66, 0.75, 1.68))],
        "zigzag" => vec![glyph_arrow_line([
            (-0.85, 0.35),
            (-0.5, -0.4),
            (-0.15, 0.35),
            (0.2, -0.4),
            (0.55, 0.35),
            (0.85, -0.3),
        ])],
        "wavy" => vec![glyph_arrow_line(sample_glyph_curve(48, |t| {
            (-0.85 + 1.7 * t, 0.36 * (t * 2.25 * TAU).sin())
        }))],
        "spiral" => vec![glyph_arrow_line(sample_glyph_curve(64, |t| {
            let angle = t * 2.3 * TAU;
            ((0.1 + 0.68 * t) * angle.cos(), (0.1 + 0.68 * t) * angle.sin())
        }))],
        "wrist" => vec![
            hand(),
            glyph_arrow_line(circle_arc_points((0.0, 0.3), 0.85, 0.62, 0.75)),
            glyph_arrow_line(circle_arc_points((0.0, 0.3), 0.85, 0.88, 0.76)),
        ],
        "nodding" => vec![
            hand(),
            glyph_arrow_line([(0.0, 0.1), (0.0, -0.8)]),
            glyph_arrow_line([(0.0, -0.5), (0.0, 0.2)]),
        ],
        "swinging" => vec![
            hand(),
            glyph_arrow_line(circle_arc_points((0.0, 0.3), 0.85, 0.75, 0.60)),
            glyph_arrow_line(circle_arc_points((0.0, 0.3), 0.85, 0.75, 0.90)),
        ],
        "twisting" => vec![
            hand(),
            glyph_arrow_line(sample_glyph_curve(24, |t| {
                let angle = (0.5 + 0.95 * t) * TAU;
                (0.6 * angle.cos(), -0.25 + 0.24 * angle.sin())
            })),
        ],
        "stirring" => vec![
            hand(),
            glyph_arrow_line(circle_arc_points((0.0, -0.35), 0.45, 0.25, 1.12)),
        ],
        "finger" => finger_glyph_lines(|_| 0.0),
        "wiggle" => finger_glyph_lines(|finger| if finger % 2 == 0 { 0.22 } else { -0.12 }),
        "opening" => vec![
            glyph_arrow_line([(-0.15, -0.05), (-0.75, -0.65)]),
            glyph_arrow_line([(0.15, -0.05), (0.75, -0.65)]),
            hand(),
        ],
        "closing" => vec![
            glyph_arrow_line([(-0.75, -0.7), (-0.15, -0.1)]),
            glyph_arrow_line([(0.75, -0.7), (0.15, -0.1)]),
            hand(),
        ],
        "bending" => vec![
            hand(),
            glyph_line([(0.0, 0.3), (0.0, -0.35)]),
            glyph_arrow_line(circle_arc_points((0.35, -0.35), 0.35, 0.5, 1.05)),
        ],
        "rubbing" => vec![
            hand(),
            glyph_arrow_line([(-0.1, -0.1), (-0.65, -0.1)]),
            glyph_arrow_line([(0.1, -0.1), (0.65, -0.1)]),
            light(glyph_line([(-0.5, -0.4), (0.5, -0.4)])),
        ],
        "contact" => vec![surface(), glyph_arrow_line([(0.0, -0.75), (0.0, 0.55)])],
        "tap" => vec![
            surface(),
            glyph_arrow_line([(-0.35, -0.6), (-0.35, 0.55)]),
            glyph_arrow_line([(0.35, -0.6), (0.35, 0.55)]),
        ],
        "brush" => vec![
            surface(),
            glyph_arrow_line(sample_glyph_curve(20, |t| (-0.8 + 1.6 * t, -0.5 + 4.0 * t * (1.0 - t)))),
        ],
        "grasp" => vec![
            glyph_line(circle_arc_points((-0.22, 0.0), 0.45, 0.1, 0.9)),
            glyph_line(circle_arc_points((0.22, 0.0), 0.45, 0.6, 1.4)),
        ],
        _ => return None,
    })
}

/// Returns the lines of four fingers, whose ends are set by `end`.
fn finger_glyph_lines(end: impl Fn(usize) -> f32) -> Vec<GlyphLine> {
    let finger = |number: usize| {
        let x = -0.51 + 0.34 * number as f32;
        glyph_arrow_line([(x, 0.6), (x, -0.35 - end(number))])
    };
    (0..4).map(finger).collect()
}

/// Paints a movement's glyph into a square; returns whether there is one.
pub(crate) fn paint_movement_glyph(painter: &Painter, rect: Rect, movement: &str, colour: Color32) -> bool {
    let Some(lines) = movement_glyph_lines(movement) else {
        return false;
    };
    for line in &lines {
        draw_glyph_line(painter, rect, line, colour);
    }
    true
}

/// Draws a line of a glyph into a square.
pub(crate) fn draw_glyph_line(painter: &Painter, rect: Rect, line: &GlyphLine, colour: Color32) {
    let half = rect.width().min(rect.height()) * 0.42;
    let width = (half * 0.1).clamp(1.2, 3.0) * line.weight;
    let stroke = Stroke::new(width, colour);
    let points: Vec<Pos2> = line.points.iter().map(|point| rect.center() + *point * half).collect();
    if line.arrow
        && let [.., before, tip] = points[..]
    {
        let ahead = (tip - before).normalized();
        let head = half * 0.3;
        for side in [-1.0, 1.0] {
            let back = -ahead * head + ahead.rot90() * (side * head * 0.62);
            painter.line_segment([tip, tip + back], stroke);
        }
    }
    painter.line(points, stroke);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_movement_has_a_distinct_glyph_inside_its_square() {
        let movements = chereme_sign::inventory::builtin_by_id("movements").expect("of the house");
        let mut seen: Vec<Vec<GlyphLine>> = Vec::new();
        for value in &movements.values {
            let lines = movement_glyph_lines(&value.id).unwrap_or_default();
            assert!(!lines.is_empty(), "{}", value.id);
            let inside = |point: &Vec2| point.x.abs() <= 1.0 && point.y.abs() <= 1.0;
            let mut points = lines.iter().flat_map(|line| &line.points);
            assert!(points.all(inside), "{}", value.id);
            assert!(!seen.contains(&lines), "{}", value.id);
            seen.push(lines);
        }
        assert_eq!(movement_glyph_lines("jump"), None);
    }
}
