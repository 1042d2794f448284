//! Drawn HamNoSys, with the meaning of each symbol on hover.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use chereme_sign::hamnosys::drawing::{Drawing, GAP, Ink, WIDTHS, drawing};
use chereme_sign::hamnosys::{Symbol, to_names};
use eframe::egui::{
    Event, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2,
};

use crate::context::PaneInput;
use crate::words::{fill, hamnosys as words};

/// Usual height of a drawn symbol, in points.
pub(crate) const EM: f32 = 28.0;

/// Returns the drawings of all symbols.
pub(super) fn drawings() -> &'static BTreeMap<Symbol, Drawing> {
    static DRAWINGS: OnceLock<BTreeMap<Symbol, Drawing>> = OnceLock::new();
    DRAWINGS.get_or_init(|| Symbol::all().map(|it| (it, drawing(it))).collect())
}

/// Laid-out symbols with their rectangles, and the total size.
struct Laid {
    symbols: Vec<(Symbol, Rect)>,
    size: Vec2,
}

/// Lays out symbols of `em` points in lines of at most `width` points.
fn laid(symbols: &[Symbol], em: f32, width: f32) -> Laid {
    let (gap, high) = (GAP * em, em * (1.0 + 2.0 * GAP));
    let mut at = Pos2::ZERO;
    let mut size = vec2(0.0, high);
    let mut laid = Vec::new();
    for &symbol in symbols {
        let wide = drawings().get(&symbol).map_or(0.0, |it| it.width * em) + gap;
        if at.x > 0.0 && at.x + wide > width {
            at = Pos2::new(0.0, at.y + high);
        }
        let rect = Rect::from_min_size(at, vec2(wide, high));
        laid.push((symbol, rect));
        at.x += wide;
        size = size.max(rect.max.to_vec2());
    }
    Laid {
        symbols: laid,
        size,
    }
}

/// Shows text that is a notation, in symbols or in their names, as a drawing; returns `None` for other text.
pub(crate) fn of_text(ui: &mut Ui, seen: &PaneInput<'_>, text: &str, em: f32) -> Option<Response> {
    let names = to_names(text).ok()?;
    let symbols: Vec<Symbol> = names.into_iter().filter_map(Symbol::from_name).collect();
    (!symbols.is_empty()).then(|| strip(ui, seen, &symbols, em))
}

/// Shows symbols of `em` points. Hovering explains a symbol; a click takes the focus, and Copy copies all of them.
pub(crate) fn strip(ui: &mut Ui, seen: &PaneInput<'_>, symbols: &[Symbol], em: f32) -> Response {
    let laid = laid(symbols, em, ui.available_width().max(em));
    let (rect, response) = ui.allocate_exact_size(laid.size, Sense::click());
    response.widget_info(|| {
        let names: Vec<&str> = symbols.iter().map(|it| short(*it)).collect();
        let label = fill(seen.say(words::STRIP), &[("names", &names.join(" "))]);
        WidgetInfo::labeled(Role::Label, true, label)
    });
    let inside = response.hover_pos().map(|at| at - rect.min.to_vec2());
    let over = inside.and_then(|at| laid.symbols.iter().find(|it| it.1.contains(at)));
    if ui.is_rect_visible(rect) {
        for (symbol, place) in &laid.symbols {
            let place = place.translate(rect.min.to_vec2());
            if over.is_some_and(|it| it.1.translate(rect.min.to_vec2()) == place) {
                let ground = ui.visuals().widgets.hovered.weak_bg_fill;
                ui.painter().rect_filled(place, 3.0, ground);
            }
            paint(
                ui,
                place.min + Vec2::splat(GAP * em) * vec2(0.5, 1.0),
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
            .copy_text(symbols.iter().map(|it| it.char()).collect());
    }
    response.context_menu(|ui| {
        if ui.button(seen.say(words::COPY_SYMBOLS)).clicked() {
            ui.ctx()
                .copy_text(symbols.iter().map(|it| it.char()).collect());
            ui.close();
        }
        if ui.button(seen.say(words::COPY_NAMES)).clicked() {
            let names: Vec<&str> = symbols.iter().map(|it| it.name()).collect();
            ui.ctx().copy_text(names.join(" "));
            ui.close();
        }
    });
    match over {
        Some((symbol, _)) => response.on_hover_ui_at_pointer(|ui| explain(ui, seen, *symbol)),
        None => response,
    }
}

/// Explains a symbol: a large drawing, its name, and its meaning.
pub(super) fn explain(ui: &mut Ui, seen: &PaneInput<'_>, symbol: Symbol) {
    const LARGE: f32 = 48.0;
    ui.horizontal(|ui| {
        let wide = drawings().get(&symbol).map_or(0.0, |it| it.width * LARGE);
        let (rect, _) = ui.allocate_exact_size(vec2(wide, LARGE), Sense::hover());
        paint(ui, rect.min, LARGE, symbol);
        ui.vertical(|ui| {
            ui.strong(symbol.name());
            ui.label(words::meaning(short(symbol), seen.language).unwrap_or_default());
        });
    });
}

pub(super) fn short(symbol: Symbol) -> &'static str {
    let name = symbol.name();
    name.strip_prefix("ham").unwrap_or(name)
}

/// Paints a symbol of `em` points whose upper left corner is `at`.
pub(super) fn paint(ui: &Ui, at: Pos2, em: f32, symbol: Symbol) {
    let Some(drawing) = drawings().get(&symbol) else {
        return;
    };
    let (strong, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    for stroke in &drawing.strokes {
        let points = stroke.points.iter().map(|[x, y]| at + vec2(*x, *y) * em);
        let points: Vec<Pos2> = points.collect();
        ui.painter().add(match stroke.ink {
            Ink::Solid => Shape::convex_polygon(points, strong, Stroke::NONE),
            Ink::Line => Shape::line(points, Stroke::new(WIDTHS[1] * em, strong)),
            Ink::Thin => Shape::line(points, Stroke::new(WIDTHS[0] * em, weak)),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_placed_in_rows_that_wrap() {
        let names = to_names("hamfinger2 hamextfingeru hampalml hamchest").expect("symbols");
        let symbols: Vec<Symbol> = names.into_iter().filter_map(Symbol::from_name).collect();
        let two = laid(&symbols, 20.0, 60.0);
        assert_eq!(two.symbols.len(), 4);
        assert!(two.size.x <= 60.0 && two.size.y > laid(&symbols, 20.0, 900.0).size.y);
        for (number, (_, one)) in two.symbols.iter().enumerate() {
            let mut others = two.symbols[..number].iter();
            assert!(
                others.all(|(_, other)| !one.shrink(0.1).intersects(*other)),
                "{number}"
            );
        }
        assert_eq!(laid(&symbols, 20.0, 1.0).symbols.len(), 4, "however narrow");
    }
}
