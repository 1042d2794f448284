//! HamNoSys drawn symbol by symbol, for people without its font.

use chereme_sign::hamnosys::Symbol;
use chereme_sign::hamnosys::drawing::{self, Drawing, GAP, Ink, WIDTHS};
use eframe::egui::{Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

/// How high a symbol is.
const EM: f32 = 26.0;

/// Draws symbols in rows as wide as there is room, each with its name when pointed at; `label` is what is
/// told of them all to those who do not see them.
pub(crate) fn strip(ui: &mut Ui, symbols: &[Symbol], label: &str) {
    let gap = GAP * EM;
    let drawn: Vec<(Symbol, Drawing)> = (symbols.iter())
        .map(|symbol| (*symbol, drawing::drawing(*symbol)))
        .collect();
    let places = places(&drawn, ui.available_width(), gap);
    let below = places.iter().map(|place| place.bottom()).fold(EM, f32::max);
    let right = places.iter().map(|place| place.right()).fold(0.0, f32::max);
    let (whole, answer) = ui.allocate_exact_size(vec2(right, below + gap), Sense::hover());
    answer.widget_info(|| WidgetInfo::labeled(Role::Label, true, label));
    for ((symbol, drawing), place) in drawn.iter().zip(places) {
        let place = place.translate(whole.min.to_vec2());
        paint(ui, ui.painter(), drawing, place.min);
        ui.interact(
            place.expand(gap / 2.0),
            answer.id.with(place.min.x as i32).with(place.min.y as i32),
            Sense::hover(),
        )
        .on_hover_text(symbol.name());
    }
}

/// Returns where each symbol stands, from the top left.
fn places(drawn: &[(Symbol, Drawing)], room: f32, gap: f32) -> Vec<Rect> {
    let mut at = pos2(0.0, gap / 2.0);
    let place = |(_, drawing): &(Symbol, Drawing)| {
        let width = drawing.width * EM;
        if at.x > 0.0 && at.x + width > room {
            at = pos2(0.0, at.y + EM + 1.5 * gap);
        }
        let place = Rect::from_min_size(at, vec2(width, EM));
        at.x += width + gap;
        place
    };
    drawn.iter().map(place).collect()
}

fn paint(ui: &Ui, painter: &Painter, drawing: &Drawing, at: Pos2) {
    let strong = ui.visuals().text_color();
    for stroke in &drawing.strokes {
        let points: Vec<Pos2> = (stroke.points.iter())
            .map(|[x, y]| at + vec2(*x, *y) * EM)
            .collect();
        painter.add(match stroke.ink {
            Ink::Solid => Shape::convex_polygon(points, strong, Stroke::NONE),
            Ink::Line => Shape::line(points, Stroke::new(WIDTHS[1] * EM, strong)),
            Ink::Thin => Shape::line(
                points,
                Stroke::new(WIDTHS[0] * EM, ui.visuals().weak_text_color()),
            ),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_stand_beside_each_other_and_below_where_there_is_no_room() {
        let drawn = drawing::drawn("hamfinger2 hamextfingeru hampalml hamchest").expect("HamNoSys");
        let all = places(&drawn, 60.0, 4.0);
        assert_eq!(all.len(), 4);
        assert!(all.iter().all(|place| place.right() <= 60.0));
        for (number, one) in all.iter().enumerate() {
            assert!(
                all[..number].iter().all(|other| !one.intersects(*other)),
                "{number}"
            );
        }
        assert!(all[3].top() > all[0].bottom());
        assert_eq!(places(&drawn, 1.0, 4.0).len(), 4, "however narrow");
    }
}
