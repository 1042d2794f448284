//! Drawn HamNoSys, with the meaning of each symbol on hover.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use chereme_sign::hamnosys::drawing::{LINE_WIDTHS_EMS, SYMBOL_GAP_EMS, StrokeInk, SymbolDrawing, draw_symbol};
use chereme_sign::hamnosys::{HamnosysSymbol, to_names};
use eframe::egui::{Event, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2};

use crate::context::PaneInput;
use crate::words::{fill_text_braces, hamnosys_words as words};

/// Usual height of a drawn symbol, in points.
pub(crate) const DEFAULT_SYMBOL_EM_POINTS: f32 = 28.0;

/// Returns the drawings of all symbols.
pub(super) fn all_symbol_drawings() -> &'static BTreeMap<HamnosysSymbol, SymbolDrawing> {
    static SYMBOL_DRAWINGS: OnceLock<BTreeMap<HamnosysSymbol, SymbolDrawing>> = OnceLock::new();
    SYMBOL_DRAWINGS.get_or_init(|| {
        HamnosysSymbol::all_symbols()
            .map(|symbol| (symbol, draw_symbol(symbol)))
            .collect()
    })
}

/// Laid-out symbols with their rectangles, and the total size.
struct SymbolLayout {
    symbols: Vec<(HamnosysSymbol, Rect)>,
    size: Vec2,
}

/// Lays out symbols of `em` points in lines of at most `width` points.
fn lay_out_symbols(symbols: &[HamnosysSymbol], em: f32, width: f32) -> SymbolLayout {
    let (gap, high) = (SYMBOL_GAP_EMS * em, em * (1.0 + 2.0 * SYMBOL_GAP_EMS));
    let mut corner = Pos2::ZERO;
    let mut size = vec2(0.0, high);
    let mut placed_symbols = Vec::new();
    for &symbol in symbols {
        let wide = all_symbol_drawings()
            .get(&symbol)
            .map_or(0.0, |drawing| drawing.width * em)
            + gap;
        if corner.x > 0.0 && corner.x + wide > width {
            corner = Pos2::new(0.0, corner.y + high);
        }
        let rect = Rect::from_min_size(corner, vec2(wide, high));
        placed_symbols.push((symbol, rect));
        corner.x += wide;
        size = size.max(rect.max.to_vec2());
    }
    SymbolLayout {
        symbols: placed_symbols,
        size,
    }
}

/// Shows text that is a notation, in symbols or in their names, as a drawing; returns `None` for other text.
pub(crate) fn of_text(ui: &mut Ui, seen: &PaneInput<'_>, text: &str, em: f32) -> Option<Response> {
    let names = to_names(text).ok()?;
    let symbols: Vec<HamnosysSymbol> = names.into_iter().filter_map(HamnosysSymbol::from_symbol_name).collect();
    (!symbols.is_empty()).then(|| show_symbol_strip(ui, seen, &symbols, em))
}

/// Shows symbols of `em` points. Hovering explains a symbol; a click takes the focus, and Copy copies all of them.
pub(crate) fn show_symbol_strip(ui: &mut Ui, seen: &PaneInput<'_>, symbols: &[HamnosysSymbol], em: f32) -> Response {
    let layout = lay_out_symbols(symbols, em, ui.available_width().max(em));
    let (rect, response) = ui.allocate_exact_size(layout.size, Sense::click());
    response.widget_info(|| {
        let names: Vec<&str> = symbols.iter().map(|symbol| short_symbol_name(*symbol)).collect();
        let label = fill_text_braces(seen.say_text(words::STRIP), &[("names", &names.join(" "))]);
        WidgetInfo::labeled(Role::Label, true, label)
    });
    let inside = response.hover_pos().map(|at| at - rect.min.to_vec2());
    let over = inside.and_then(|at| layout.symbols.iter().find(|placed| placed.1.contains(at)));
    if ui.is_rect_visible(rect) {
        for (symbol, place) in &layout.symbols {
            let place = place.translate(rect.min.to_vec2());
            if over.is_some_and(|placed| placed.1.translate(rect.min.to_vec2()) == place) {
                let ground = ui.visuals().widgets.hovered.weak_bg_fill;
                ui.painter().rect_filled(place, 3.0, ground);
            }
            paint_hamnosys_symbol(
                ui,
                place.min + Vec2::splat(SYMBOL_GAP_EMS * em) * vec2(0.5, 1.0),
                em,
                *symbol,
            );
        }
        if response.has_focus() {
            let stroke = ui.visuals().selection.stroke;
            ui.painter()
                .rect_stroke(rect.expand(2.0), 3.0, stroke, StrokeKind::Outside);
        }
    }
    if response.clicked() {
        response.request_focus();
    }
    let copies = |event: &Event| matches!(event, Event::Copy);
    if response.has_focus() && ui.input(|input| input.events.iter().any(copies)) {
        ui.ctx()
            .copy_text(symbols.iter().map(|symbol| symbol.symbol_char()).collect());
    }
    response.context_menu(|ui| {
        if ui.button(seen.say_text(words::COPY_SYMBOLS)).clicked() {
            ui.ctx()
                .copy_text(symbols.iter().map(|symbol| symbol.symbol_char()).collect());
            ui.close();
        }
        if ui.button(seen.say_text(words::COPY_NAMES)).clicked() {
            let names: Vec<&str> = symbols.iter().map(|symbol| symbol.symbol_name()).collect();
            ui.ctx().copy_text(names.join(" "));
            ui.close();
        }
    });
    match over {
        Some((symbol, _)) => response.on_hover_ui_at_pointer(|ui| explain_hamnosys_symbol(ui, seen, *symbol)),
        None => response,
    }
}

/// Explains a symbol: a large drawing, its name, and its meaning.
pub(super) fn explain_hamnosys_symbol(ui: &mut Ui, seen: &PaneInput<'_>, symbol: HamnosysSymbol) {
    const LARGE_SYMBOL_EM_POINTS: f32 = 48.0;
    ui.horizontal(|ui| {
        let wide = all_symbol_drawings()
            .get(&symbol)
            .map_or(0.0, |drawing| drawing.width * LARGE_SYMBOL_EM_POINTS);
        let (rect, _) = ui.allocate_exact_size(vec2(wide, LARGE_SYMBOL_EM_POINTS), Sense::hover());
        paint_hamnosys_symbol(ui, rect.min, LARGE_SYMBOL_EM_POINTS, symbol);
        ui.vertical(|ui| {
            ui.strong(symbol.symbol_name());
            ui.label(words::symbol_meaning(short_symbol_name(symbol), seen.language).unwrap_or_default());
        });
    });
}

pub(super) fn short_symbol_name(symbol: HamnosysSymbol) -> &'static str {
    let name = symbol.symbol_name();
    name.strip_prefix("ham").unwrap_or(name)
}

/// Paints a symbol of `em` points whose upper left corner is `at`.
pub(super) fn paint_hamnosys_symbol(ui: &Ui, at: Pos2, em: f32, symbol: HamnosysSymbol) {
    let Some(drawing) = all_symbol_drawings().get(&symbol) else {
        return;
    };
    let (strong, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    for stroke in &drawing.strokes {
        let point_iterator = stroke.points.iter().map(|[x, y]| at + vec2(*x, *y) * em);
        let points: Vec<Pos2> = point_iterator.collect();
        ui.painter().add(match stroke.ink {
            StrokeInk::Solid => Shape::convex_polygon(points, strong, Stroke::NONE),
            StrokeInk::Line => Shape::line(points, Stroke::new(LINE_WIDTHS_EMS[1] * em, strong)),
            StrokeInk::Thin => Shape::line(points, Stroke::new(LINE_WIDTHS_EMS[0] * em, weak)),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_placed_in_rows_that_wrap() {
        let names = to_names("hamfinger2 hamextfingeru hampalml hamchest").expect("symbols");
        let symbols: Vec<HamnosysSymbol> = names.into_iter().filter_map(HamnosysSymbol::from_symbol_name).collect();
        let two = lay_out_symbols(&symbols, 20.0, 60.0);
        assert_eq!(two.symbols.len(), 4);
        assert!(two.size.x <= 60.0 && two.size.y > lay_out_symbols(&symbols, 20.0, 900.0).size.y);
        for (number, (_, one)) in two.symbols.iter().enumerate() {
            let mut others = two.symbols[..number].iter();
            assert!(others.all(|(_, other)| !one.shrink(0.1).intersects(*other)), "{number}");
        }
        assert_eq!(lay_out_symbols(&symbols, 20.0, 1.0).symbols.len(), 4, "however narrow");
    }
}
