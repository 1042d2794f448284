//! Hits as looping little figures, and as a table with their neighbours.

use chereme_corpus::{Hit, TrackKind};
use chereme_motion::Side;
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, CursorIcon, EventFilter, FontId, Id, Key, Modifiers, Rect, Response, Role, ScrollArea,
    Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::hits::{self, Sort, coding};
use super::{Search, View};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::miniatures::{self, Cell, Focus, Motion};
use crate::panes::{Carried, carry, scrolled_to};
use crate::pickers;
use crate::words::{Text, fill, search as words};

/// Height of a row of the table, in points.
const ROW: f32 = 26.0;
/// Height of the text below a figure, in points.
const FOOT: f32 = 36.0;
/// The least width of a figure, in points.
const FIGURE: f32 = 132.0;
/// The space between two figures, in points.
const GAP: f32 = 6.0;

/// The columns of the table: the title of each, and the order that it sorts by.
const COLUMNS: [(Text, Sort); 5] = [
    (words::BEFORE, Sort::Before),
    (words::GLOSS, Sort::Gloss),
    (words::AFTER, Sort::After),
    (words::PLACE, Sort::Place),
    (words::DURATION, Sort::Duration),
];
/// The usual widths of columns as shares of the table's width, and the least share of a column.
const SHARES: [f32; 5] = [0.21, 0.22, 0.21, 0.23, 0.13];
const LEAST: f32 = 0.05;
/// The width of the area at a column's edge in which the edge can be dragged, in points.
const EDGE: f32 = 8.0;

/// The widths of the table's columns, as shares of its width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shares([f32; 5]);

impl Default for Shares {
    fn default() -> Self {
        Self(SHARES)
    }
}

impl Shares {
    /// Widens a column by a share of the table's width, and narrows the next as much; neither becomes too narrow.
    fn widen(&mut self, column: usize, by: f32) {
        if let [own, next] = &mut self.0[column..column + 2] {
            let by = by.clamp((LEAST - *own).min(0.0), (*next - LEAST).max(0.0));
            *own += by;
            *next -= by;
        }
    }
}

/// Draws the hits.
pub(crate) fn show(search: &mut Search, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    match search.view {
        View::Grid => grid(search, ui, seen, out),
        View::Table => {
            head(search, ui, seen, out);
            table(search, ui, seen, out);
        }
    }
}

fn grid(search: &mut Search, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let Some(total) = search.found.as_ref().map(|found| found.total) else {
        return;
    };
    let room = ui.available_width() - 12.0;
    let columns = ((room + GAP) / (FIGURE + GAP)).floor().max(1.0) as usize;
    let width = (room + GAP) / columns as f32 - GAP;
    let height = width.min(190.0) + FOOT;
    let rows = total.div_ceil(columns);
    keys(search, ui, columns, total);
    let area = scroll(search, ui, "figures", columns, height + GAP);
    ui.spacing_mut().item_spacing = Vec2::splat(GAP);
    let output = area.show_rows(ui, height, rows, |ui, range| {
        search.sight(range.start * columns..range.end * columns, out);
        for row in range {
            ui.horizontal(|ui| {
                for at in row * columns..((row + 1) * columns).min(total) {
                    figure(search, ui, seen, out, at, vec2(width, height));
                }
            });
        }
    });
    search.scrolled = output.state.clamped_offset().y;
}

fn figure(
    search: &mut Search,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    at: usize,
    size: Vec2,
) {
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let Some(hit) = search
        .found
        .as_ref()
        .and_then(|found| found.hit(at))
        .cloned()
    else {
        ui.painter()
            .rect_filled(rect, 6.0, ui.visuals().faint_bg_color);
        return;
    };
    let response = cell(search, ui, seen, rect, at, &hit);
    let picture = Rect::from_min_size(rect.min, vec2(size.x, size.y - FOOT));
    let motion = motion(&hit, seen);
    let made = match &motion {
        None if ui.is_rect_visible(rect) && seen.snapshot.is_notated(&hit.gloss) => {
            let made = search.notated.get(hit.token, &hit.gloss, out);
            made.map(Motion::Made)
        }
        _ => None,
    };
    let notated = motion.is_none();
    let motion = motion.or(made);
    carry::drag(&response, carried(&hit), motion.clone());
    menu(&response, seen, &hit, out);
    match motion.filter(|motion| !seen.little.is_nothing(motion)) {
        Some(motion) => {
            let playing = search.playing || response.hovered() || response.has_focus();
            let focus = focus(search.close, &search.field.text);
            let mut little = Cell::new(motion, picture.size()).focused(focus);
            if playing {
                little = little.playing(miniatures::clock(ui));
            }
            seen.little.paint(ui, seen, out, &little, picture);
            if notated {
                codes(ui, seen, &hit, picture, true);
            }
        }
        None => coded(ui, seen, &hit, picture),
    }
    let small = TextStyle::Small.resolve(ui.style());
    let body = TextStyle::Body.resolve(ui.style());
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let line = |middle: f32| {
        let center = pos2(rect.center().x, picture.bottom() + middle);
        Rect::from_center_size(center, vec2(rect.width(), 20.0))
    };
    let text = ui.visuals().text_color();
    put(ui, line(10.0), &hit.gloss, body, text, false);
    let weak = ui.visuals().weak_text_color();
    let where_to = hits::place_text(&hit, lexicon(seen, &hit));
    put(ui, line(26.0), &where_to, small, weak, false);
    if let Some(score) = hit.score {
        let at = picture.right_top() + vec2(-5.0, 4.0);
        let text = fill(seen.say(words::ALIKE), &[("share", &percent(score))]);
        let font = FontId::proportional(12.0);
        let galley = ui
            .painter()
            .layout_no_wrap(text, font, seen.colours().on_annotation);
        let back = Align2::RIGHT_TOP.anchor_size(at, galley.size() + vec2(8.0, 2.0));
        painter.rect_filled(back, 4.0, seen.colours().component);
        painter.galley(back.min + vec2(4.0, 1.0), galley, text_colour(seen));
    }
    frame(search, ui, seen, &response, rect, at);
    if response.clicked() {
        search.open(at, seen, out);
    }
}

/// Returns a hit as the payload of a drag.
pub(super) fn carried(hit: &Hit) -> Carried {
    Carried {
        token: hit.token,
        gloss: hit.gloss.clone(),
    }
}

fn menu(response: &Response, seen: &PaneInput<'_>, hit: &Hit, out: &mut Outbox) {
    let recording = recording(hit, seen);
    if response.double_clicked()
        && let Some((recipe, name)) = recording.and_then(|it| seen.snapshot.recipe_of(it))
    {
        out.send(Command::Recipe(recipe, Some(name)));
    }
    response.context_menu(|ui| carry::menu(ui, seen, (hit.token, &hit.gloss, recording), out));
}

/// Returns the recording that contains a hit.
fn recording(hit: &Hit, seen: &PaneInput<'_>) -> Option<i64> {
    let name = hit.recording.as_deref()?;
    Some(seen.snapshot.recording_named(name)?.row.id)
}

fn text_colour(seen: &PaneInput<'_>) -> eframe::egui::Color32 {
    seen.colours().on_annotation
}

fn percent(score: f64) -> i64 {
    (score * 100.0).round() as i64
}

/// Returns the movement or the film of a hit, if it has any.
fn motion(hit: &Hit, seen: &PaneInput<'_>) -> Option<Motion> {
    let (name, span) = hits::place(hit)?;
    let recording = seen.snapshot.recording_named(name)?;
    let is_seen = recording.shown().is_some() || recording.kinds.contains(&TrackKind::Media);
    is_seen.then_some(Motion::Span(recording.row.id, span))
}

/// Paints the coding of a sign without movement: a large picture of its handshape, the rest beside it.
fn coded(ui: &Ui, seen: &PaneInput<'_>, hit: &Hit, rect: Rect) {
    ui.painter()
        .rect_filled(rect, 6.0, ui.visuals().extreme_bg_color);
    if codes(ui, seen, hit, rect, false) > 0 {
        return;
    }
    let weak = ui.visuals().weak_text_color();
    let font = TextStyle::Small.resolve(ui.style());
    let values: Vec<String> = coding(hit).into_iter().map(|(_, value)| value).collect();
    let text = if values.is_empty() {
        seen.say(words::UNCODED).to_owned()
    } else {
        values.join(" · ")
    };
    let galley = ui.painter().layout(text, font, weak, rect.width() - 12.0);
    let at = Align2::CENTER_CENTER.anchor_size(rect.center(), galley.size());
    ui.painter().galley(at.min, galley, weak);
}

/// Paints pictures of the coding along the right edge: all of them `small`, or the first one large at the left. Returns
/// how many there are.
fn codes(ui: &Ui, seen: &PaneInput<'_>, hit: &Hit, rect: Rect, small: bool) -> usize {
    let side = if small {
        rect.height().min(rect.width()) * 0.25
    } else {
        rect.height().min(rect.width()) * 0.33
    };
    let large = Rect::from_min_size(rect.min, vec2(rect.width() - side, rect.height() * 0.76));
    let mut places: Vec<Rect> = if small { Vec::new() } else { vec![large] };
    let column = (rect.height() / side) as usize;
    places.extend((0..column).map(|n| {
        let at = pos2(rect.right() - side, rect.top() + side * n as f32);
        Rect::from_min_size(at, Vec2::splat(side))
    }));
    let all = seen.snapshot.overview.inventories.iter();
    let inventories: Vec<_> = all
        .map(|it| (it.inventory.field().to_string(), &it.inventory))
        .collect();
    let mut shown = 0;
    for (field, value) in coding(hit) {
        let Some(place) = places.get(shown) else {
            break;
        };
        let known = inventories.iter().find(|(of, _)| *of == field);
        if known.is_some_and(|(_, it)| pickers::picture(ui, place.shrink(1.0), seen, it, &value)) {
            shown += 1;
        }
    }
    shown
}

fn head(search: &mut Search, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let width = ui.available_width() - 12.0;
    let (rect, _) = ui.allocate_exact_size(vec2(width, ROW), Sense::hover());
    let whole = search
        .found
        .as_ref()
        .is_some_and(super::hits::Found::is_whole);
    let mut left = rect.left();
    for (column, (name, sort)) in COLUMNS.into_iter().enumerate() {
        let share = search.shares.0[column];
        let place = Rect::from_min_size(pos2(left, rect.top()), vec2(width * share, ROW));
        left = place.right();
        let usable = whole || !sort.is_local();
        let key = ui.scope_id().with(("column", sort as usize));
        let sense = if usable {
            Sense::click()
        } else {
            Sense::hover()
        };
        let response = ui.interact(place, key, sense);
        let chosen = search.sort == sort;
        let label = fill(seen.say(words::SORT), &[("column", &seen.say(name))]);
        response.widget_info(|| WidgetInfo::selected(Role::Button, usable, chosen, &label));
        let response = if usable {
            response.on_hover_text(&label)
        } else {
            response.on_hover_text(seen.say(words::SORT_FEWER))
        };
        let colour = if chosen {
            seen.colours().accent
        } else {
            ui.visuals().weak_text_color()
        };
        let font = TextStyle::Small.resolve(ui.style());
        let mut text = seen.say(name).to_owned();
        if chosen {
            text.push_str(" ↓");
        }
        put(ui, place, &text, font, colour, sort == Sort::Before);
        if response.has_focus() {
            let stroke = Stroke::new(1.5, seen.colours().accent);
            ui.painter()
                .rect_stroke(place, 3.0, stroke, StrokeKind::Inside);
        }
        if response.clicked() {
            search.sort_by(if chosen { Sort::Rank } else { sort }, out);
        }
        if column + 1 < COLUMNS.len() {
            edge(search, ui, seen, place, width, column);
        }
    }
}

/// Makes the right edge of a column draggable.
fn edge(
    search: &mut Search,
    ui: &Ui,
    seen: &PaneInput<'_>,
    place: Rect,
    width: f32,
    column: usize,
) {
    let at = Rect::from_center_size(place.right_center(), vec2(EDGE, ROW));
    let key = ui.scope_id().with(("edge", column));
    let response = ui.interact(at, key, Sense::click_and_drag());
    let name = fill(
        seen.say(words::WIDTH_OF),
        &[("column", &seen.say(COLUMNS[column].0))],
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let response = response
        .on_hover_text(seen.say(words::WIDER))
        .on_hover_cursor(CursorIcon::ResizeHorizontal);
    if response.double_clicked() {
        search.shares = Shares::default();
    } else if response.dragged() && width > 0.0 {
        search.shares.widen(column, response.drag_delta().x / width);
    }
    let held = response.hovered() || response.dragged() || response.has_focus();
    let colour = if held {
        seen.colours().accent
    } else {
        seen.colours().rule
    };
    let inside = at.shrink2(vec2(0.0, 5.0));
    ui.painter()
        .vline(at.center().x, inside.y_range(), Stroke::new(1.0, colour));
}

fn table(search: &mut Search, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let Some(total) = search.found.as_ref().map(|found| found.total) else {
        return;
    };
    keys(search, ui, 1, total);
    // As wide as the table's head, so that the edges of the columns are aligned.
    let width = ui.available_width() - 12.0;
    let area = scroll(search, ui, "rows", 1, ROW);
    ui.spacing_mut().item_spacing.y = 0.0;
    let output = area.show_rows(ui, ROW, total, |ui, range| {
        search.sight(range.clone(), out);
        for at in range {
            let (rect, _) = ui.allocate_exact_size(vec2(width, ROW), Sense::hover());
            line(search, ui, seen, out, at, rect);
        }
    });
    search.scrolled = output.state.clamped_offset().y;
}

fn line(
    search: &mut Search,
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    at: usize,
    rect: Rect,
) {
    let Some(found) = &search.found else { return };
    let Some(hit) = found.hit(at).cloned() else {
        ui.weak("…");
        return;
    };
    let around = found.around(hit.token).cloned().unwrap_or_default();
    if at % 2 == 1 {
        ui.painter().rect_filled(rect, 0.0, seen.colours().stripe);
    }
    let response = cell(search, ui, seen, rect, at, &hit);
    frame(search, ui, seen, &response, rect, at);
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    carry::drag(&response, carried(&hit), motion(&hit, seen));
    menu(&response, seen, &hit, out);
    if hit.recording.is_none() {
        let pictures = Rect::from_min_max(
            pos2(
                rect.left() + rect.width() * (search.shares.0[0] + search.shares.0[1]),
                rect.top(),
            ),
            rect.max,
        );
        strip(ui, seen, &hit, pictures);
    }
    let columns = [
        (around.before.join(" "), weak),
        (hit.gloss.clone(), text),
        (around.after.join(" "), weak),
        (
            hits::place(&hit).map_or(String::new(), |_| hits::place_text(&hit, "")),
            weak,
        ),
        (hits::duration_text(&hit), weak),
    ];
    let mut left = rect.left();
    let shares = search.shares.0;
    for (((content, colour), (_, sort)), share) in columns.into_iter().zip(COLUMNS).zip(shares) {
        let mut place =
            Rect::from_min_size(pos2(left, rect.top()), vec2(rect.width() * share, ROW));
        left = place.right();
        // The similarity is at the end of the gloss, which is shortened before it.
        if let Some(score) = hit.score.filter(|_| sort == Sort::Gloss) {
            let share = format!("{} %", percent(score));
            let font = TextStyle::Small.resolve(ui.style());
            let painter = ui.painter().with_clip_rect(place.intersect(ui.clip_rect()));
            let at = place.right_center() - vec2(5.0, 0.0);
            let drawn = painter.text(at, Align2::RIGHT_CENTER, share, font, weak);
            place.max.x = drawn.left();
        }
        let font = TextStyle::Body.resolve(ui.style());
        put(ui, place, &content, font, colour, sort == Sort::Before);
    }
    if response.clicked() {
        search.open(at, seen, out);
    }
}

/// Paints the coding of a lexicon entry in a row.
fn strip(ui: &Ui, seen: &PaneInput<'_>, hit: &Hit, rect: Rect) {
    let side = rect.height();
    let mut place = Rect::from_min_size(rect.min, Vec2::splat(side));
    for (field, value) in coding(hit) {
        let all = seen.snapshot.overview.inventories.iter();
        let known = all
            .map(|it| &it.inventory)
            .find(|it| it.field().to_string() == field);
        if place.right() > rect.right() {
            return;
        }
        if known.is_some_and(|it| pickers::picture(ui, place.shrink(1.0), seen, it, &value)) {
            place = place.translate(vec2(side + 4.0, 0.0));
        }
    }
}

/// Puts text into a column; the words before a hit are aligned to the hit, and shortened at their far end.
fn put(ui: &Ui, rect: Rect, text: &str, font: FontId, colour: eframe::egui::Color32, end: bool) {
    let rect = rect.shrink2(vec2(5.0, 0.0));
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let (at, align) = if end {
        (rect.right_center(), Align2::RIGHT_CENTER)
    } else {
        (rect.left_center(), Align2::LEFT_CENTER)
    };
    let lay_out = |text: String| {
        let mut job = LayoutJob::simple_singleline(text, font.clone(), colour);
        job.wrap = TextWrapping::truncate_at_width(rect.width().max(0.0));
        painter.layout_job(job)
    };
    let mut galley = lay_out(text.to_owned());
    if end && galley.elided {
        // The words farthest from the hit are left out first.
        let rests = text.char_indices().filter(|(_, letter)| *letter == ' ');
        for (at, _) in rests {
            galley = lay_out(format!("…{}", &text[at..]));
            if !galley.elided {
                break;
            }
        }
    }
    let at = align.anchor_size(at, galley.size());
    painter.galley(at.min, galley, colour);
}

/// Returns the text for a hit outside of recordings.
fn lexicon(seen: &PaneInput<'_>, hit: &Hit) -> &'static str {
    let notated = seen.snapshot.is_notated(&hit.gloss);
    seen.say(if notated {
        crate::words::library::NOTATED
    } else {
        words::LEXICON
    })
}

/// Makes a hit clickable and focusable.
fn cell(
    search: &mut Search,
    ui: &Ui,
    seen: &PaneInput<'_>,
    rect: Rect,
    at: usize,
    hit: &Hit,
) -> Response {
    let id = Id::unique("hits").with(at);
    let response = ui.interact(rect, id, Sense::click_and_drag());
    let place = hits::place_text(hit, lexicon(seen, hit));
    let name = format!("{}, {place}", hit.gloss);
    let chosen = search.at == at;
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &name));
    if search.reach == Some(at) {
        search.reach = None;
        response.request_focus();
    }
    if response.has_focus() {
        search.at = at;
        let arrows = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id, arrows));
    }
    let tip = fill(seen.say(words::HIT_TIP), &[("hit", &name)]);
    response.on_hover_text(tip)
}

fn frame(
    search: &Search,
    ui: &Ui,
    seen: &PaneInput<'_>,
    response: &Response,
    rect: Rect,
    at: usize,
) {
    let accent = seen.colours().accent;
    let stroke = if response.has_focus() {
        Stroke::new(2.0, accent)
    } else if search.opened == Some(at) {
        Stroke::new(1.5, accent.gamma_multiply(0.7))
    } else if response.hovered() {
        Stroke::new(1.0, accent)
    } else {
        return;
    };
    ui.painter()
        .rect_stroke(rect, 5.0, stroke, StrokeKind::Inside);
}

/// Takes the arrow keys if a hit has the focus.
fn keys(search: &mut Search, ui: &Ui, columns: usize, total: usize) {
    let focus = ui.memory(|memory| memory.focused());
    if focus != Some(Id::unique("hits").with(search.at)) || total == 0 {
        return;
    }
    let mut step = None;
    ui.input_mut(|input| {
        for (key, by) in [
            (Key::ArrowLeft, [-1, 0]),
            (Key::ArrowRight, [1, 0]),
            (Key::ArrowUp, [0, -1]),
            (Key::ArrowDown, [0, 1]),
            (Key::PageUp, [0, -8]),
            (Key::PageDown, [0, 8]),
        ] {
            if input.consume_key(Modifiers::NONE, key) {
                step = Some(by);
            }
        }
        if input.consume_key(Modifiers::NONE, Key::Home) {
            step = Some([-(search.at as isize), 0]);
        }
        if input.consume_key(Modifiers::NONE, Key::End) {
            step = Some([(total - 1 - search.at) as isize, 0]);
        }
    });
    if let Some(step) = step {
        search.reach(hits::walk(search.at, total, columns, step));
    }
}

/// Returns the scroll area, scrolled to the hit that takes the focus.
fn scroll(search: &mut Search, ui: &Ui, name: &str, columns: usize, height: f32) -> ScrollArea {
    let area = ScrollArea::vertical().id_salt(name).auto_shrink(false);
    let Some(at) = search.reach else {
        return area;
    };
    let offset = scrolled_to(at / columns, height, search.scrolled, ui.available_height());
    area.vertical_scroll_offset(offset)
}

/// Returns the part of the signer that figures show: the hand named in the query, or the whole signer.
fn focus(close: bool, query: &str) -> Focus {
    match (close, query.contains("left.")) {
        (false, _) => Focus::Signing,
        (true, false) => Focus::Hand(Side::Right),
        (true, true) => Focus::Hand(Side::Left),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widening_a_column_narrows_the_next_and_none_vanishes() {
        let mut shares = Shares::default();
        for (column, by) in [(0, 0.1), (1, -0.9), (3, 5.0), (2, f32::MAX), (0, -3.0)] {
            shares.widen(column, by);
            let sum: f32 = shares.0.iter().sum();
            // Five additions of numbers below one.
            assert!((sum - 1.0).abs() < 1e-5, "{shares:?}");
            assert!(
                shares.0.iter().all(|share| *share > LEAST - 1e-5),
                "{shares:?}"
            );
        }
    }
}
