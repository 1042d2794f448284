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

mod drawing_hands;
mod drawing_marks;
mod drawing_places;
mod movements;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::symbol::{HamnosysSymbol, SymbolClass, SymbolKind};
use super::to_names;

/// A point in ems: from the left, and from the top down.
pub type DrawingPoint = [f32; 2];

/// The role of a line in a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrokeInk {
    /// The background: the body, the hand.
    Thin,
    /// The meaning.
    Line,
    /// The meaning, as a convex solid; the points are its rim.
    Solid,
}

/// A line through points, or a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingStroke {
    /// Its role.
    pub ink: StrokeInk,
    /// Its points, two or more; each from 0 to 1 from the top, and from 0 to the drawing's width.
    pub points: Vec<DrawingPoint>,
}

/// A drawn symbol, in a box one em high.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SymbolDrawing {
    /// The width of its box, in ems.
    pub width: f32,
    /// Its lines and solids, in drawing order.
    pub strokes: Vec<DrawingStroke>,
}

impl SymbolDrawing {
    fn new(width: f32) -> Self {
        Self {
            width,
            strokes: Vec::new(),
        }
    }

    fn with_stroke(mut self, ink: StrokeInk, points: impl Into<Vec<DrawingPoint>>) -> Self {
        let points = points.into();
        self.strokes.push(DrawingStroke { ink, points });
        self
    }

    fn thin(self, points: impl Into<Vec<DrawingPoint>>) -> Self {
        self.with_stroke(StrokeInk::Thin, points)
    }

    fn with_line(self, points: impl Into<Vec<DrawingPoint>>) -> Self {
        self.with_stroke(StrokeInk::Line, points)
    }

    fn solid(self, points: impl Into<Vec<DrawingPoint>>) -> Self {
        self.with_stroke(StrokeInk::Solid, points)
    }

    fn with_dot(self, at: DrawingPoint) -> Self {
        self.solid(oval(at, [0.07, 0.07]))
    }

    /// Adds the two sides of an arrow's head at the end of a path.
    fn with_arrow_head(self, points: &[DrawingPoint], size: f32) -> Self {
        let [.., before, tip] = points else {
            return self;
        };
        let [x, y] = [tip[0] - before[0], tip[1] - before[1]];
        let length = x.hypot(y).max(1e-6);
        let [x, y] = [x / length * size, y / length * size];
        let side = |to: f32| [tip[0] - x - to * y * 0.7, tip[1] - y + to * x * 0.7];
        self.with_line([side(1.0), *tip, side(-1.0)])
    }

    fn with_arrow(self, points: impl Into<Vec<DrawingPoint>>) -> Self {
        let points = points.into();
        let with = self.with_line(points.clone());
        with.with_arrow_head(&points, ARROW_HEAD_LENGTH_EMS)
    }
}

/// Length of the sides of an arrow's head.
const ARROW_HEAD_LENGTH_EMS: f32 = 0.2;

/// Returns a part of an ellipse between two angles in turns, clockwise from the right.
fn arc_points(centre: DrawingPoint, radii: [f32; 2], from: f32, to: f32) -> Vec<DrawingPoint> {
    const ARC_STEP_COUNT: u8 = 24;
    (0..=ARC_STEP_COUNT)
        .map(|step| {
            let turn = from + (to - from) * f32::from(step) / f32::from(ARC_STEP_COUNT);
            let (sin, cos) = (turn * std::f32::consts::TAU).sin_cos();
            [centre[0] + radii[0] * cos, centre[1] + radii[1] * sin]
        })
        .collect()
}

/// Returns an ellipse.
fn oval(centre: DrawingPoint, radii: [f32; 2]) -> Vec<DrawingPoint> {
    arc_points(centre, radii, 0.0, 1.0)
}

/// Returns a point relative to the middle of the page: to the right, and up.
fn page_point(centre: DrawingPoint, right: f32, up: f32) -> DrawingPoint {
    [centre[0] + right, centre[1] - up]
}

/// Returns the drawing of a symbol.
#[must_use]
pub fn draw_symbol(symbol: HamnosysSymbol) -> SymbolDrawing {
    match symbol.symbol_kind() {
        SymbolKind::Punctuation | SymbolKind::AltBegin | SymbolKind::AltOr | SymbolKind::AltEnd => {
            drawing_marks::draw_punctuation_mark(symbol.symbol_char())
        }
        kind => match symbol.symbol_class() {
            SymbolClass::Handshape | SymbolClass::HandshapeMark => drawing_hands::draw_handshape_symbol(kind),
            SymbolClass::HandPart | SymbolClass::Digit | SymbolClass::FingerPart => drawing_hands::draw_hand_part(kind),
            SymbolClass::Location | SymbolClass::LocationMark => drawing_places::draw_place_symbol(kind),
            SymbolClass::ExtendedFinger | SymbolClass::Palm | SymbolClass::Movement | SymbolClass::MovementMark => {
                movements::draw_movement_symbol(kind)
            }
            _ => drawing_marks::draw_movement_mark(kind),
        },
    }
}

/// Returns the symbols of a text with their drawings, one after the other; `None` if the text is not
/// HamNoSys.
#[must_use]
pub fn draw_hamnosys_text(text: &str) -> Option<Vec<(HamnosysSymbol, SymbolDrawing)>> {
    let names = to_names(text).ok()?;
    let symbols = names.into_iter().filter_map(HamnosysSymbol::from_symbol_name);
    Some(symbols.map(|symbol| (symbol, draw_symbol(symbol))).collect())
}

/// The gap between two symbols, in ems.
pub const SYMBOL_GAP_EMS: f32 = 0.16;
/// Widths of thin and other lines, in ems.
pub const LINE_WIDTHS_EMS: [f32; 2] = [0.03, 0.06];

/// Returns a text of HamNoSys as a picture in SVG, with symbols `em` units high and their names as titles;
/// `None` if the text is not HamNoSys.
#[must_use]
pub fn hamnosys_to_svg(text: &str, em: f32) -> Option<String> {
    let symbols = draw_hamnosys_text(text)?;
    let wide: f32 = symbols.iter().map(|(_, it)| it.width + SYMBOL_GAP_EMS).sum();
    let mut out = String::new();
    let mut left = SYMBOL_GAP_EMS;
    for (symbol, drawing) in symbols {
        write_symbol_svg(&mut out, symbol, &drawing, [left * em, SYMBOL_GAP_EMS * em], em);
        left += drawing.width + SYMBOL_GAP_EMS;
    }
    Some(svg_page(
        (wide + SYMBOL_GAP_EMS) * em,
        (1.0 + 2.0 * SYMBOL_GAP_EMS) * em,
        &out,
    ))
}

/// Returns all 209 symbols with their names as a picture in SVG, class by class.
#[must_use]
pub fn symbol_chart_svg() -> String {
    const CHART_COLUMN_COUNT: usize = 12;
    const CHART_EM_UNITS: f32 = 40.0;
    const CHART_CELL_SIZE: DrawingPoint = [104.0, 76.0];
    let mut classes: BTreeMap<SymbolClass, Vec<HamnosysSymbol>> = BTreeMap::new();
    for symbol in HamnosysSymbol::all_symbols() {
        classes.entry(symbol.symbol_class()).or_default().push(symbol);
    }
    let mut out = String::new();
    let mut top = 0.0;
    for symbols in classes.values() {
        for (number, symbol) in symbols.iter().enumerate() {
            let (column, row) = (number % CHART_COLUMN_COUNT, number / CHART_COLUMN_COUNT);
            let drawing = draw_symbol(*symbol);
            let [left, y] = [
                column as f32 * CHART_CELL_SIZE[0],
                top + row as f32 * CHART_CELL_SIZE[1],
            ];
            let middle = left + CHART_CELL_SIZE[0] / 2.0;
            write_symbol_svg(
                &mut out,
                *symbol,
                &drawing,
                [middle - drawing.width * CHART_EM_UNITS / 2.0, y + 8.0],
                CHART_EM_UNITS,
            );
            let symbol_name = symbol.symbol_name();
            let name = symbol_name.strip_prefix("ham").unwrap_or(symbol_name);
            let _ = writeln!(
                out,
                "<text x=\"{middle:.1}\" y=\"{:.1}\">{name}</text>",
                y + CHART_EM_UNITS + 24.0
            );
        }
        top += symbols.len().div_ceil(CHART_COLUMN_COUNT) as f32 * CHART_CELL_SIZE[1] + 12.0;
    }
    svg_page(CHART_COLUMN_COUNT as f32 * CHART_CELL_SIZE[0], top, &out)
}

fn svg_page(width: f32, height: f32, drawn: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.1}\" height=\"{height:.1}\" \
         viewBox=\"0 0 {width:.1} {height:.1}\" stroke-linecap=\"round\" stroke-linejoin=\"round\" \
         text-anchor=\"middle\" font-family=\"sans-serif\" font-size=\"10\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{drawn}</svg>\n"
    )
}

fn write_symbol_svg(
    out: &mut String,
    symbol: HamnosysSymbol,
    drawing: &SymbolDrawing,
    [left, top]: DrawingPoint,
    em: f32,
) {
    let _ = writeln!(out, "<g><title>{}</title>", symbol.symbol_name());
    for stroke in &drawing.strokes {
        let point_texts: Vec<String> = (stroke.points.iter())
            .map(|[x, y]| format!("{:.1},{:.1}", left + x * em, top + y * em))
            .collect();
        let points = point_texts.join(" ");
        let _ = match stroke.ink {
            StrokeInk::Solid => writeln!(out, "<polygon points=\"{points}\"/>"),
            ink => writeln!(
                out,
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1}\"/>",
                if ink == StrokeInk::Thin { "#888" } else { "#000" },
                LINE_WIDTHS_EMS[usize::from(ink == StrokeInk::Line)] * em
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
        let mut seen: BTreeMap<String, HamnosysSymbol> = BTreeMap::new();
        for symbol in HamnosysSymbol::all_symbols() {
            let drawing = draw_symbol(symbol);
            assert!(drawing.width > 0.1 && drawing.width <= 1.0, "{symbol}");
            assert_eq!(
                drawing.strokes.is_empty(),
                symbol.symbol_kind() == SymbolKind::Space,
                "{symbol}"
            );
            for stroke in &drawing.strokes {
                assert!(stroke.points.len() > 1, "{symbol}");
                for [x, y] in &stroke.points {
                    let inside = (-1e-3..=drawing.width + 1e-3).contains(x) && (-1e-3..=1.001).contains(y);
                    assert!(inside, "{symbol}: {x} {y}");
                }
            }
            if let Some(other) = seen.insert(format!("{drawing:?}"), symbol) {
                // An old name of the same place.
                assert_eq!(
                    (other.symbol_kind(), symbol.symbol_class()),
                    (symbol.symbol_kind(), other.symbol_class())
                );
            }
        }
    }

    #[test]
    fn the_stored_chart_shows_every_symbol_as_it_is_drawn() {
        let chart = symbol_chart_svg();
        assert_eq!(chart.matches("<title>").count(), HamnosysSymbol::all_symbols().len());
        let beside = include_str!("../../../pictures/symbols.svg");
        assert!(
            chart == beside,
            "make it again: `chereme render CORPUS inventory:hamnosys --to crates/chereme-sign/pictures/symbols.svg`"
        );
    }

    #[test]
    fn a_text_is_a_picture_that_names_its_symbols() {
        let picture = hamnosys_to_svg("hamfinger2 hamextfingeru hampalml", 20.0).expect("HamNoSys");
        let titles: Vec<_> = picture.lines().filter(|line| line.contains("<title>")).collect();
        assert_eq!(
            titles,
            [
                "<g><title>hamfinger2</title>",
                "<g><title>hamextfingeru</title>",
                "<g><title>hampalml</title>"
            ]
        );
        assert_eq!(hamnosys_to_svg("no notation", 20.0), None);
        assert_eq!(draw_hamnosys_text("\u{e000}").map(|all| all.len()), Some(1));
    }
}
