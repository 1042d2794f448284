//! Drawings of the symbols of HamNoSys, for people and pictures without its font.
//!
//! Each drawing is our own, made from the symbol's meaning: hands seen from their backs with the extended
//! fingers, the body with the marked place, arrows for paths. The meaning itself is a line or a solid; its
//! background is thin. Right is the signer's right.
//!
//! Directions of hands are wedges, paths are arrows. Those across the body are seen from behind it; those
//! with *out* or *in* from above, the body being the bar below; those up or down as well from the right
//! side, the body being the bar at the left. Circles are seen from behind, above and a little from the
//! right, and turn as they appear from there.

mod hands;
mod marks;
mod movements;
mod places;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::symbol::{Class, Kind, Symbol};
use super::to_names;

/// A point in ems: from the left, and from the top down.
pub type Point = [f32; 2];

/// The role of a line in a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// The background: the body, the hand.
    Thin,
    /// The meaning.
    Line,
    /// The meaning, as a convex solid; the points are its rim.
    Solid,
}

/// A line through points, or a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Its role.
    pub ink: Ink,
    /// Its points, two or more; each from 0 to 1 from the top, and from 0 to the drawing's width.
    pub points: Vec<Point>,
}

/// A drawn symbol, in a box one em high.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// The width of its box, in ems.
    pub width: f32,
    /// Its lines and solids, in drawing order.
    pub strokes: Vec<Stroke>,
}

impl Drawing {
    fn new(width: f32) -> Self {
        Self {
            width,
            strokes: Vec::new(),
        }
    }

    fn with(mut self, ink: Ink, points: impl Into<Vec<Point>>) -> Self {
        let points = points.into();
        self.strokes.push(Stroke { ink, points });
        self
    }

    fn thin(self, points: impl Into<Vec<Point>>) -> Self {
        self.with(Ink::Thin, points)
    }

    fn line(self, points: impl Into<Vec<Point>>) -> Self {
        self.with(Ink::Line, points)
    }

    fn solid(self, points: impl Into<Vec<Point>>) -> Self {
        self.with(Ink::Solid, points)
    }

    fn dot(self, at: Point) -> Self {
        self.solid(oval(at, [0.07, 0.07]))
    }

    /// Adds the two sides of an arrow's head at the end of a path.
    fn head(self, points: &[Point], size: f32) -> Self {
        let [.., before, tip] = points else {
            return self;
        };
        let [x, y] = [tip[0] - before[0], tip[1] - before[1]];
        let length = x.hypot(y).max(1e-6);
        let [x, y] = [x / length * size, y / length * size];
        let side = |to: f32| [tip[0] - x - to * y * 0.7, tip[1] - y + to * x * 0.7];
        self.line([side(1.0), *tip, side(-1.0)])
    }

    fn arrow(self, points: impl Into<Vec<Point>>) -> Self {
        let points = points.into();
        let with = self.line(points.clone());
        with.head(&points, HEAD)
    }
}

/// Length of the sides of an arrow's head.
const HEAD: f32 = 0.2;

/// Returns a part of an ellipse between two angles in turns, clockwise from the right.
fn arc(centre: Point, radii: [f32; 2], from: f32, to: f32) -> Vec<Point> {
    const STEPS: u8 = 24;
    (0..=STEPS)
        .map(|step| {
            let turn = from + (to - from) * f32::from(step) / f32::from(STEPS);
            let (sin, cos) = (turn * std::f32::consts::TAU).sin_cos();
            [centre[0] + radii[0] * cos, centre[1] + radii[1] * sin]
        })
        .collect()
}

/// Returns an ellipse.
fn oval(centre: Point, radii: [f32; 2]) -> Vec<Point> {
    arc(centre, radii, 0.0, 1.0)
}

/// Returns a point relative to the middle of the page: to the right, and up.
fn seen(centre: Point, right: f32, up: f32) -> Point {
    [centre[0] + right, centre[1] - up]
}

/// Returns the drawing of a symbol.
#[must_use]
pub fn drawing(symbol: Symbol) -> Drawing {
    match symbol.kind() {
        Kind::Punctuation | Kind::AltBegin | Kind::AltOr | Kind::AltEnd => {
            marks::punctuation(symbol.char())
        }
        kind => match symbol.class() {
            Class::Handshape | Class::HandshapeMark => hands::shape(kind),
            Class::HandPart | Class::Digit | Class::FingerPart => hands::part(kind),
            Class::Location | Class::LocationMark => places::place(kind),
            Class::ExtendedFinger | Class::Palm | Class::Movement | Class::MovementMark => {
                movements::draw(kind)
            }
            _ => marks::mark(kind),
        },
    }
}

/// Returns the symbols of a text with their drawings, one after the other; `None` if the text is not
/// HamNoSys.
#[must_use]
pub fn drawn(text: &str) -> Option<Vec<(Symbol, Drawing)>> {
    let names = to_names(text).ok()?;
    let symbols = names.into_iter().filter_map(Symbol::from_name);
    Some(symbols.map(|symbol| (symbol, drawing(symbol))).collect())
}

/// The gap between two symbols, in ems.
pub const GAP: f32 = 0.16;
/// Widths of thin and other lines, in ems.
pub const WIDTHS: [f32; 2] = [0.03, 0.06];

/// Returns a text of HamNoSys as a picture in SVG, with symbols `em` units high and their names as titles;
/// `None` if the text is not HamNoSys.
#[must_use]
pub fn svg(text: &str, em: f32) -> Option<String> {
    let symbols = drawn(text)?;
    let wide: f32 = symbols.iter().map(|(_, it)| it.width + GAP).sum();
    let mut out = String::new();
    let mut left = GAP;
    for (symbol, drawing) in symbols {
        draw(&mut out, symbol, &drawing, [left * em, GAP * em], em);
        left += drawing.width + GAP;
    }
    Some(page((wide + GAP) * em, (1.0 + 2.0 * GAP) * em, &out))
}

/// Returns all 209 symbols with their names as a picture in SVG, class by class.
#[must_use]
pub fn chart() -> String {
    const COLUMNS: usize = 12;
    const EM: f32 = 40.0;
    const CELL: Point = [104.0, 76.0];
    let mut classes: BTreeMap<Class, Vec<Symbol>> = BTreeMap::new();
    for symbol in Symbol::all() {
        classes.entry(symbol.class()).or_default().push(symbol);
    }
    let mut out = String::new();
    let mut top = 0.0;
    for symbols in classes.values() {
        for (number, symbol) in symbols.iter().enumerate() {
            let (column, row) = (number % COLUMNS, number / COLUMNS);
            let drawing = drawing(*symbol);
            let [left, y] = [column as f32 * CELL[0], top + row as f32 * CELL[1]];
            let middle = left + CELL[0] / 2.0;
            draw(
                &mut out,
                *symbol,
                &drawing,
                [middle - drawing.width * EM / 2.0, y + 8.0],
                EM,
            );
            let name = symbol.name();
            let name = name.strip_prefix("ham").unwrap_or(name);
            let _ = writeln!(
                out,
                "<text x=\"{middle:.1}\" y=\"{:.1}\">{name}</text>",
                y + EM + 24.0
            );
        }
        top += symbols.len().div_ceil(COLUMNS) as f32 * CELL[1] + 12.0;
    }
    page(COLUMNS as f32 * CELL[0], top, &out)
}

fn page(width: f32, height: f32, drawn: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.1}\" height=\"{height:.1}\" \
         viewBox=\"0 0 {width:.1} {height:.1}\" stroke-linecap=\"round\" stroke-linejoin=\"round\" \
         text-anchor=\"middle\" font-family=\"sans-serif\" font-size=\"10\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{drawn}</svg>\n"
    )
}

fn draw(out: &mut String, symbol: Symbol, drawing: &Drawing, [left, top]: Point, em: f32) {
    let _ = writeln!(out, "<g><title>{}</title>", symbol.name());
    for stroke in &drawing.strokes {
        let points: Vec<String> = (stroke.points.iter())
            .map(|[x, y]| format!("{:.1},{:.1}", left + x * em, top + y * em))
            .collect();
        let points = points.join(" ");
        let _ = match stroke.ink {
            Ink::Solid => writeln!(out, "<polygon points=\"{points}\"/>"),
            ink => writeln!(
                out,
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1}\"/>",
                if ink == Ink::Thin { "#888" } else { "#000" },
                WIDTHS[usize::from(ink == Ink::Line)] * em
            ),
        };
    }
    *out += "</g>\n";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_symbol_is_drawn_inside_its_box_and_unlike_every_other() {
        let mut seen: BTreeMap<String, Symbol> = BTreeMap::new();
        for symbol in Symbol::all() {
            let drawing = drawing(symbol);
            assert!(drawing.width > 0.1 && drawing.width <= 1.0, "{symbol}");
            assert_eq!(
                drawing.strokes.is_empty(),
                symbol.kind() == Kind::Space,
                "{symbol}"
            );
            for stroke in &drawing.strokes {
                assert!(stroke.points.len() > 1, "{symbol}");
                for [x, y] in &stroke.points {
                    let inside =
                        (-1e-3..=drawing.width + 1e-3).contains(x) && (-1e-3..=1.001).contains(y);
                    assert!(inside, "{symbol}: {x} {y}");
                }
            }
            if let Some(other) = seen.insert(format!("{drawing:?}"), symbol) {
                // An old name of the same place.
                assert_eq!(
                    (other.kind(), symbol.class()),
                    (symbol.kind(), other.class())
                );
            }
        }
    }

    #[test]
    fn the_stored_chart_shows_every_symbol_as_it_is_drawn() {
        let chart = chart();
        assert_eq!(chart.matches("<title>").count(), Symbol::all().len());
        let beside = include_str!("../../../pictures/symbols.svg");
        assert!(
            chart == beside,
            "make it again: `chereme render CORPUS inventory:hamnosys --to crates/chereme-sign/pictures/symbols.svg`"
        );
    }

    #[test]
    fn a_text_is_a_picture_that_names_its_symbols() {
        let picture = svg("hamfinger2 hamextfingeru hampalml", 20.0).expect("HamNoSys");
        let titles: Vec<_> = picture
            .lines()
            .filter(|line| line.contains("<title>"))
            .collect();
        assert_eq!(
            titles,
            [
                "<g><title>hamfinger2</title>",
                "<g><title>hamextfingeru</title>",
                "<g><title>hampalml</title>"
            ]
        );
        assert_eq!(svg("no notation", 20.0), None);
        assert_eq!(drawn("\u{e000}").map(|all| all.len()), Some(1));
    }
}
