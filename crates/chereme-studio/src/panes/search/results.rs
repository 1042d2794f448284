//! Hits as looping little figures, and as a table with their neighbours.

use chereme_corpus::{OpinionStanding, SearchHit, TrackKind, ValueOpinion};
use chereme_motion::BodySide;
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, CursorIcon, FontId, Id, Rect, Response, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use super::hits::{self, HitSort, hit_coding_values};
use super::{ResultsView, SearchPane};
use crate::command::{DraggedToken, WindowCommand};
use crate::context::PaneInput;
use crate::miniatures::{self, MiniatureCell, MiniatureFocus, MiniatureMotion};
use crate::panes::timeline::timeline_paint::hatch_proposal;
use crate::panes::{carry, list_keys, scrolled_to};
use crate::pickers;
use crate::words::{InterfaceText, fill_text_braces, search_words as words};

/// Height of a row of the table, in points.
const RESULT_ROW_HEIGHT_POINTS: f32 = 26.0;
/// Height of the text below a figure, in points.
const FIGURE_FOOT_HEIGHT_POINTS: f32 = 36.0;
/// The least width of a figure, in points.
const MIN_FIGURE_WIDTH_POINTS: f32 = 132.0;
/// The space between two figures, in points.
const FIGURE_GAP_POINTS: f32 = 6.0;

/// Height of the line of proposed and disputed values, in points.
const OPINION_HEIGHT_POINTS: f32 = 18.0;

/// The columns of the table: the title of each, and the order that it sorts by.
const RESULT_TABLE_COLUMNS: [(InterfaceText, HitSort); 5] = [
    (words::BEFORE, HitSort::Before),
    (words::GLOSS, HitSort::Gloss),
    (words::AFTER, HitSort::After),
    (words::PLACE, HitSort::Place),
    (words::DURATION, HitSort::Duration),
];
/// The usual widths of columns as shares of the table's width, and the least share of a column.
const DEFAULT_COLUMN_SHARES: [f32; 5] = [0.21, 0.22, 0.21, 0.23, 0.13];
const MIN_COLUMN_SHARE: f32 = 0.05;
/// The width of the area at a column's edge in which the edge can be dragged, in points.
const COLUMN_EDGE_WIDTH_POINTS: f32 = 8.0;

/// The widths of the table's columns, as shares of its width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ColumnShares([f32; 5]);

impl Default for ColumnShares {
    fn default() -> Self {
        Self(DEFAULT_COLUMN_SHARES)
    }
}

impl ColumnShares {
    /// Widens a column by a share of the table's width, and narrows the next as much; neither becomes too narrow.
    fn widen_table_column(&mut self, column: usize, by: f32) {
        if let [own, next] = &mut self.0[column..column + 2] {
            let by = by.clamp((MIN_COLUMN_SHARE - *own).min(0.0), (*next - MIN_COLUMN_SHARE).max(0.0));
            *own += by;
            *next -= by;
        }
    }
}

/// Draws the hits.
pub(crate) fn show_search_results(search: &mut SearchPane, ui: &mut Ui, seen: &PaneInput<'_>) {
    match search.view {
        ResultsView::Grid => draw_result_grid(search, ui, seen),
        ResultsView::Table => {
            draw_table_head(search, ui, seen);
            draw_result_table(search, ui, seen);
        }
    }
}

fn draw_result_grid(search: &mut SearchPane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let Some(total) = search.found.as_ref().map(|found| found.total) else {
        return;
    };
    let room = ui.available_width() - 12.0;
    let columns = ((room + FIGURE_GAP_POINTS) / (MIN_FIGURE_WIDTH_POINTS + FIGURE_GAP_POINTS))
        .floor()
        .max(1.0) as usize;
    let width = (room + FIGURE_GAP_POINTS) / columns as f32 - FIGURE_GAP_POINTS;
    let height = width.min(190.0) + FIGURE_FOOT_HEIGHT_POINTS;
    let rows = total.div_ceil(columns);
    handle_result_arrow_keys(search, ui, columns, total);
    let area = result_scroll_area(search, ui, "figures", columns, height + FIGURE_GAP_POINTS);
    ui.spacing_mut().item_spacing = Vec2::splat(FIGURE_GAP_POINTS);
    let output = area.show_rows(ui, height, rows, |ui, range| {
        search.request_visible_hits(range.start * columns..range.end * columns, seen.out);
        for row in range {
            ui.horizontal(|ui| {
                for at in row * columns..((row + 1) * columns).min(total) {
                    draw_result_figure(search, ui, seen, at, vec2(width, height));
                }
            });
        }
    });
    search.scrolled = output.state.clamped_offset().y;
}

fn draw_result_figure(search: &mut SearchPane, ui: &mut Ui, seen: &PaneInput<'_>, at: usize, size: Vec2) {
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let Some(hit) = search.found.as_ref().and_then(|found| found.hit_at(at)).cloned() else {
        ui.painter().rect_filled(rect, 6.0, ui.visuals().faint_bg_color);
        return;
    };
    let response = make_hit_clickable(search, ui, seen, rect, at, &hit);
    let picture = Rect::from_min_size(rect.min, vec2(size.x, size.y - FIGURE_FOOT_HEIGHT_POINTS));
    let motion = find_hit_motion(&hit, seen);
    let made = match &motion {
        // Movement from notation is costly, and made only for pictures that are in sight.
        None if ui.is_rect_visible(rect) && seen.snapshot.is_notated(&hit.gloss) => {
            let made = search.notated.notated_clip(hit.token, &hit.gloss, seen.out);
            made.map(MiniatureMotion::Made)
        }
        _ => None,
    };
    let notated = motion.is_none();
    let motion = motion.or(made);
    carry::make_sign_draggable(&response, hit_drag_payload(&hit), motion.clone());
    show_hit_menu(&response, seen, &hit);
    match motion.filter(|motion| !seen.little.is_nothing(motion)) {
        Some(motion) => {
            // The keyboard has the same right to movement as the pointer.
            let playing = search.playing || response.hovered() || response.has_focus();
            let focus = figure_focus(search.close, &search.field.text);
            let mut little = MiniatureCell::new(motion, picture.size()).with_picture_focus(focus);
            if playing {
                little = little.with_playing_clock(miniatures::figure_loop_clock(ui));
            }
            seen.little.paint_figure(ui, seen.language, seen.out, &little, picture);
            if notated {
                paint_coding_pictures(ui, seen, &hit, picture, true);
            }
        }
        None => paint_coded_figure(ui, seen, &hit, picture),
    }
    paint_hit_opinions(
        ui,
        seen,
        &hit,
        picture.with_min_y(picture.bottom() - OPINION_HEIGHT_POINTS),
    );
    let small = TextStyle::Small.resolve(ui.style());
    let body = TextStyle::Body.resolve(ui.style());
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let line = |middle: f32| {
        let center = pos2(rect.center().x, picture.bottom() + middle);
        Rect::from_center_size(center, vec2(rect.width(), 20.0))
    };
    let text = ui.visuals().text_color();
    paint_column_text(ui, line(10.0), &hit.gloss, body, text, false);
    let weak = ui.visuals().weak_text_color();
    let where_to = hits::place_text(&hit, lexicon_hit_text(seen, &hit));
    paint_column_text(ui, line(26.0), &where_to, small, weak, false);
    let alike = hit.score.map(|score| {
        let share = score_to_percent(score);
        fill_text_braces(seen.say_text(words::ALIKE), &[("share", &share)])
    });
    if let Some(text) = hits::order_value_text(&hit, &search.sort, seen.language).or(alike) {
        let score_position = picture.right_top() + vec2(-5.0, 4.0);
        let font = FontId::proportional(12.0);
        let galley = ui
            .painter()
            .layout_no_wrap(text, font, seen.pane_colours().on_annotation);
        let back = Align2::RIGHT_TOP.anchor_size(score_position, galley.size() + vec2(8.0, 2.0));
        painter.rect_filled(back, 4.0, seen.pane_colours().component);
        painter.galley(back.min + vec2(4.0, 1.0), galley, text_colour(seen));
    }
    draw_hit_frame(search, ui, seen, &response, rect, at);
    if response.clicked() {
        search.open_hit_at(at, seen);
    }
}

/// Returns a hit as the payload of a drag.
pub(super) fn hit_drag_payload(hit: &SearchHit) -> DraggedToken {
    DraggedToken {
        token: hit.token,
        gloss: hit.gloss.clone(),
    }
}

fn show_hit_menu(response: &Response, seen: &PaneInput<'_>, hit: &SearchHit) {
    let recording = hit_recording_id(hit, seen);
    if response.double_clicked()
        && let Some((recipe, name)) = recording.and_then(|id| seen.snapshot.recipe_of(id))
    {
        seen.send_command(WindowCommand::Recipe(recipe, Some(name)));
    }
    response.context_menu(|ui| carry::show_sign_menu(ui, seen, hit.token, &hit.gloss, recording));
}

/// Returns the recording that contains a hit.
fn hit_recording_id(hit: &SearchHit, seen: &PaneInput<'_>) -> Option<i64> {
    let name = hit.recording.as_deref()?;
    Some(seen.snapshot.recording_named(name)?.row.id)
}

fn text_colour(seen: &PaneInput<'_>) -> eframe::egui::Color32 {
    seen.pane_colours().on_annotation
}

fn score_to_percent(score: f64) -> i64 {
    (score * 100.0).round() as i64
}

/// Returns the movement or the film of a hit, if it has any.
fn find_hit_motion(hit: &SearchHit, seen: &PaneInput<'_>) -> Option<MiniatureMotion> {
    let (name, span) = hits::hit_recording_span(hit)?;
    let recording = seen.snapshot.recording_named(name)?;
    let is_seen = recording.shown_frames().is_some() || recording.kinds.contains(&TrackKind::Media);
    is_seen.then_some(MiniatureMotion::Span(recording.row.id, span))
}

/// Paints the coding of a sign without movement: a large picture of its handshape, the rest beside it.
fn paint_coded_figure(ui: &Ui, seen: &PaneInput<'_>, hit: &SearchHit, rect: Rect) {
    ui.painter().rect_filled(rect, 6.0, ui.visuals().extreme_bg_color);
    if paint_coding_pictures(ui, seen, hit, rect, false) > 0 {
        return;
    }
    let weak = ui.visuals().weak_text_color();
    let font = TextStyle::Small.resolve(ui.style());
    let values: Vec<String> = hit_coding_values(hit).into_iter().map(|(_, value)| value).collect();
    let text = if values.is_empty() {
        seen.say_text(words::UNCODED).to_owned()
    } else {
        values.join(" · ")
    };
    let galley = ui.painter().layout(text, font, weak, rect.width() - 12.0);
    let text_rect = Align2::CENTER_CENTER.anchor_size(rect.center(), galley.size());
    ui.painter().galley(text_rect.min, galley, weak);
}

/// Returns the words for the reason why a value does not count.
pub(crate) fn standing_text(standing: OpinionStanding) -> InterfaceText {
    match standing {
        OpinionStanding::Proposed => words::PROPOSED,
        OpinionStanding::Rejected => words::REJECTED,
        OpinionStanding::Disputed => words::DISPUTED,
        OpinionStanding::Agreed => words::AGREED,
        OpinionStanding::Replaced => words::REPLACED,
    }
}

/// Returns the values of a hit that do not count, each with the reason.
fn hit_opinions_text(hit: &SearchHit, seen: &PaneInput<'_>) -> Option<String> {
    let others = hit.opinions.iter();
    let others = others.filter(|opinion| opinion.standing != OpinionStanding::Agreed);
    let marked = others.map(|opinion| {
        let mark = seen.say_text(standing_text(opinion.standing));
        format!("{} ({mark})", opinion.value)
    });
    let texts: Vec<String> = marked.collect();
    (!texts.is_empty()).then(|| texts.join(" · "))
}

/// Paints the values of a hit that do not count, on a ground that is hatched, as in the timeline, if a detector
/// proposes some of it.
fn paint_hit_opinions(ui: &Ui, seen: &PaneInput<'_>, hit: &SearchHit, rect: Rect) {
    let Some(text) = hit_opinions_text(hit, seen) else {
        return;
    };
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    let is_proposal = |opinion: &ValueOpinion| opinion.standing == OpinionStanding::Proposed;
    if hit.opinions.iter().any(is_proposal) {
        hatch_proposal(&painter, rect, seen.pane_colours().component.gamma_multiply(0.55));
    }
    let font = TextStyle::Small.resolve(ui.style());
    paint_column_text(ui, rect, &text, font, ui.visuals().text_color(), false);
}

/// Paints pictures of the coding along the right edge: all of them `small`, or the first one large at the left. Returns
/// how many there are.
fn paint_coding_pictures(ui: &Ui, seen: &PaneInput<'_>, hit: &SearchHit, rect: Rect, small: bool) -> usize {
    let side = if small {
        rect.height().min(rect.width()) * 0.25
    } else {
        rect.height().min(rect.width()) * 0.33
    };
    let large = Rect::from_min_size(rect.min, vec2(rect.width() - side, rect.height() * 0.76));
    let mut places: Vec<Rect> = if small { Vec::new() } else { vec![large] };
    let column = (rect.height() / side) as usize;
    places.extend((0..column).map(|n| {
        let corner = pos2(rect.right() - side, rect.top() + side * n as f32);
        Rect::from_min_size(corner, Vec2::splat(side))
    }));
    let all = seen.snapshot.overview.inventories.iter();
    let inventories: Vec<_> = all
        .map(|stored| (stored.inventory.inventory_field().to_string(), &stored.inventory))
        .collect();
    let mut shown = 0;
    for (field, value) in hit_coding_values(hit) {
        let Some(place) = places.get(shown) else {
            break;
        };
        let entry = inventories.iter().find(|(of, _)| *of == field);
        if entry.is_some_and(|(_, it)| pickers::paint_inventory_value(ui, place.shrink(1.0), seen, it, &value)) {
            shown += 1;
        }
    }
    shown
}

fn draw_table_head(search: &mut SearchPane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let width = ui.available_width() - 12.0;
    let (rect, _) = ui.allocate_exact_size(vec2(width, RESULT_ROW_HEIGHT_POINTS), Sense::hover());
    let is_complete = search.found.as_ref().is_some_and(super::hits::QueryAnswer::is_whole);
    let mut left = rect.left();
    for (column, (name, sort)) in RESULT_TABLE_COLUMNS.into_iter().enumerate() {
        let share = search.shares.0[column];
        let place = Rect::from_min_size(pos2(left, rect.top()), vec2(width * share, RESULT_ROW_HEIGHT_POINTS));
        left = place.right();
        let usable = is_complete || !sort.is_local();
        let key = ui.scope_id().with(("column", column));
        let sense = if usable { Sense::click() } else { Sense::hover() };
        let response = ui.interact(place, key, sense);
        let chosen = search.sort == sort;
        let label = fill_text_braces(seen.say_text(words::SORT), &[("column", &seen.say_text(name))]);
        response.widget_info(|| WidgetInfo::selected(Role::Button, usable, chosen, &label));
        let response = if usable {
            response.on_hover_text(&label)
        } else {
            response.on_hover_text(seen.say_text(words::SORT_FEWER))
        };
        let colour = if chosen {
            seen.pane_colours().accent
        } else {
            ui.visuals().weak_text_color()
        };
        let font = TextStyle::Small.resolve(ui.style());
        let mut text = seen.say_text(name).to_owned();
        if chosen {
            text.push_str(" ↓");
        }
        paint_column_text(ui, place, &text, font, colour, sort == HitSort::Before);
        if response.has_focus() {
            let stroke = Stroke::new(1.5, seen.pane_colours().accent);
            ui.painter().rect_stroke(place, 3.0, stroke, StrokeKind::Inside);
        }
        if response.clicked() {
            search.sort_by(if chosen { HitSort::Rank } else { sort }, seen.out);
        }
        if column + 1 < RESULT_TABLE_COLUMNS.len() {
            handle_column_edge(search, ui, seen, place, width, column);
        }
    }
}

/// Makes the right edge of a column draggable.
fn handle_column_edge(search: &mut SearchPane, ui: &Ui, seen: &PaneInput<'_>, place: Rect, width: f32, column: usize) {
    let edge_rect = Rect::from_center_size(
        place.right_center(),
        vec2(COLUMN_EDGE_WIDTH_POINTS, RESULT_ROW_HEIGHT_POINTS),
    );
    let key = ui.scope_id().with(("edge", column));
    let response = ui.interact(edge_rect, key, Sense::click_and_drag());
    let name = fill_text_braces(
        seen.say_text(words::WIDTH_OF),
        &[("column", &seen.say_text(RESULT_TABLE_COLUMNS[column].0))],
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let response = response
        .on_hover_text(seen.say_text(words::WIDER))
        .on_hover_cursor(CursorIcon::ResizeHorizontal);
    if response.double_clicked() {
        search.shares = ColumnShares::default();
    } else if response.dragged() && width > 0.0 {
        search
            .shares
            .widen_table_column(column, response.drag_delta().x / width);
    }
    let is_active = response.hovered() || response.dragged() || response.has_focus();
    let colour = if is_active {
        seen.pane_colours().accent
    } else {
        seen.pane_colours().rule
    };
    let inside = edge_rect.shrink2(vec2(0.0, 5.0));
    ui.painter()
        .vline(edge_rect.center().x, inside.y_range(), Stroke::new(1.0, colour));
}

fn draw_result_table(search: &mut SearchPane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let Some(total) = search.found.as_ref().map(|found| found.total) else {
        return;
    };
    handle_result_arrow_keys(search, ui, 1, total);
    // As wide as the table's head, so that the edges of the columns are aligned.
    let width = ui.available_width() - 12.0;
    let area = result_scroll_area(search, ui, "rows", 1, RESULT_ROW_HEIGHT_POINTS);
    ui.spacing_mut().item_spacing.y = 0.0;
    let output = area.show_rows(ui, RESULT_ROW_HEIGHT_POINTS, total, |ui, range| {
        search.request_visible_hits(range.clone(), seen.out);
        for at in range {
            let (rect, _) = ui.allocate_exact_size(vec2(width, RESULT_ROW_HEIGHT_POINTS), Sense::hover());
            draw_result_line(search, ui, seen, at, rect);
        }
    });
    search.scrolled = output.state.clamped_offset().y;
}

fn draw_result_line(search: &mut SearchPane, ui: &mut Ui, seen: &PaneInput<'_>, at: usize, rect: Rect) {
    let Some(found) = &search.found else { return };
    let Some(hit) = found.hit_at(at).cloned() else {
        ui.weak("…");
        return;
    };
    let around = found.hit_neighbours(hit.token).cloned().unwrap_or_default();
    if at % 2 == 1 {
        ui.painter().rect_filled(rect, 0.0, seen.pane_colours().stripe);
    }
    let response = make_hit_clickable(search, ui, seen, rect, at, &hit);
    draw_hit_frame(search, ui, seen, &response, rect, at);
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    carry::make_sign_draggable(&response, hit_drag_payload(&hit), find_hit_motion(&hit, seen));
    show_hit_menu(&response, seen, &hit);
    if hit.recording.is_none() {
        let pictures = Rect::from_min_max(
            pos2(
                rect.left() + rect.width() * (search.shares.0[0] + search.shares.0[1]),
                rect.top(),
            ),
            rect.max,
        );
        paint_coding_strip(ui, seen, &hit, pictures);
    }
    let columns = [
        (around.before.join(" "), weak),
        (hit.gloss.clone(), text),
        (around.after.join(" "), weak),
        (
            hits::hit_recording_span(&hit).map_or(String::new(), |_| hits::place_text(&hit, "")),
            weak,
        ),
        (hits::duration_text(&hit), weak),
    ];
    let mut left = rect.left();
    let shares = search.shares.0;
    for (((content, colour), (_, sort)), share) in columns.into_iter().zip(RESULT_TABLE_COLUMNS).zip(shares) {
        let mut place = Rect::from_min_size(
            pos2(left, rect.top()),
            vec2(rect.width() * share, RESULT_ROW_HEIGHT_POINTS),
        );
        left = place.right();
        // The similarity, or the value that gives the order, is at the end of the gloss, which is shortened before it.
        let alike = hit.score.map(|score| format!("{} %", score_to_percent(score)));
        let end_text = hits::order_value_text(&hit, &search.sort, seen.language).or(alike);
        if let Some(share) = end_text.filter(|_| sort == HitSort::Gloss) {
            let font = TextStyle::Small.resolve(ui.style());
            let painter = ui.painter().with_clip_rect(place.intersect(ui.clip_rect()));
            let share_position = place.right_center() - vec2(5.0, 0.0);
            let drawn = painter.text(share_position, Align2::RIGHT_CENTER, share, font, weak);
            place.max.x = drawn.left();
        }
        if sort == HitSort::Gloss && !hit.opinions.is_empty() {
            let (half, full) = (place.center().x, place);
            place.max.x = half;
            paint_hit_opinions(ui, seen, &hit, full.with_min_x(half).shrink2(vec2(2.0, 4.0)));
        }
        let font = TextStyle::Body.resolve(ui.style());
        paint_column_text(ui, place, &content, font, colour, sort == HitSort::Before);
    }
    if response.clicked() {
        search.open_hit_at(at, seen);
    }
}

/// Paints the coding of a lexicon entry in a row.
fn paint_coding_strip(ui: &Ui, seen: &PaneInput<'_>, hit: &SearchHit, rect: Rect) {
    let side = rect.height();
    let mut place = Rect::from_min_size(rect.min, Vec2::splat(side));
    for (field, value) in hit_coding_values(hit) {
        let all = seen.snapshot.overview.inventories.iter();
        let inventory = all
            .map(|stored| &stored.inventory)
            .find(|it| it.inventory_field().to_string() == field);
        if place.right() > rect.right() {
            return;
        }
        if inventory.is_some_and(|it| pickers::paint_inventory_value(ui, place.shrink(1.0), seen, it, &value)) {
            place = place.translate(vec2(side + 4.0, 0.0));
        }
    }
}

/// Puts text into a column; the words before a hit are aligned to the hit, and shortened at their far end.
fn paint_column_text(ui: &Ui, rect: Rect, text: &str, font: FontId, colour: eframe::egui::Color32, end: bool) {
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
    let text_rect = align.anchor_size(at, galley.size());
    painter.galley(text_rect.min, galley, colour);
}

/// Returns the text for a hit outside of recordings.
fn lexicon_hit_text(seen: &PaneInput<'_>, hit: &SearchHit) -> &'static str {
    let notated = seen.snapshot.is_notated(&hit.gloss);
    seen.say_text(if notated {
        crate::words::library::NOTATED
    } else {
        words::LEXICON
    })
}

/// Makes a hit clickable and focusable.
fn make_hit_clickable(
    search: &mut SearchPane,
    ui: &Ui,
    seen: &PaneInput<'_>,
    rect: Rect,
    at: usize,
    hit: &SearchHit,
) -> Response {
    let id = Id::unique("hits").with(at);
    let response = ui.interact(rect, id, Sense::click_and_drag());
    let place = hits::place_text(hit, lexicon_hit_text(seen, hit));
    let order_value = hits::order_value_text(hit, &search.sort, seen.language);
    let parts = [
        Some(hit.gloss.clone()),
        Some(place),
        hit_opinions_text(hit, seen),
        order_value,
    ];
    let name = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
    let chosen = search.at == at;
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &name));
    if search.reach == Some(at) {
        search.reach = None;
        response.request_focus();
    }
    if response.has_focus() {
        search.at = at;
        list_keys::keep_arrow_keys(ui, id, true);
    }
    let tip = fill_text_braces(seen.say_text(words::HIT_TIP), &[("hit", &name)]);
    response.on_hover_text(tip)
}

fn draw_hit_frame(search: &SearchPane, ui: &Ui, seen: &PaneInput<'_>, response: &Response, rect: Rect, at: usize) {
    let accent = seen.pane_colours().accent;
    let stroke = if response.has_focus() {
        Stroke::new(2.0, accent)
    } else if search.opened == Some(at) {
        Stroke::new(1.5, accent.gamma_multiply(0.7))
    } else if response.hovered() {
        Stroke::new(1.0, accent)
    } else {
        return;
    };
    ui.painter().rect_stroke(rect, 5.0, stroke, StrokeKind::Inside);
}

/// Takes the arrow keys if a hit has the focus.
fn handle_result_arrow_keys(search: &mut SearchPane, ui: &Ui, columns: usize, total: usize) {
    let focus = ui.memory(|memory| memory.focused());
    if focus != Some(Id::unique("hits").with(search.at)) || total == 0 {
        return;
    }
    if let Some(to) = list_keys::take_grid_keys(ui, search.at, total, columns, 8) {
        search.move_cursor_to_hit(to);
    }
}

/// Returns the scroll area, scrolled to the hit that takes the focus.
fn result_scroll_area(search: &mut SearchPane, ui: &Ui, name: &str, columns: usize, height: f32) -> ScrollArea {
    let area = ScrollArea::vertical().id_salt(name).auto_shrink(false);
    let Some(at) = search.reach else {
        return area;
    };
    let offset = scrolled_to(at / columns, height, search.scrolled, ui.available_height());
    area.vertical_scroll_offset(offset)
}

/// Returns the part of the signer that figures show: the hand named in the query, or the whole signer.
fn figure_focus(close: bool, query: &str) -> MiniatureFocus {
    match (close, query.contains("left.")) {
        (false, _) => MiniatureFocus::Signing,
        (true, false) => MiniatureFocus::Hand(BodySide::Right),
        (true, true) => MiniatureFocus::Hand(BodySide::Left),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widening_a_column_narrows_the_next_and_none_vanishes() {
        let mut shares = ColumnShares::default();
        for (column, by) in [(0, 0.1), (1, -0.9), (3, 5.0), (2, f32::MAX), (0, -3.0)] {
            shares.widen_table_column(column, by);
            let sum: f32 = shares.0.iter().sum();
            // Five additions of numbers below one.
            assert!((sum - 1.0).abs() < 1e-5, "{shares:?}");
            assert!(
                shares.0.iter().all(|share| *share > MIN_COLUMN_SHARE - 1e-5),
                "{shares:?}"
            );
        }
    }
}
