//! The timeline's widgets: the tools, the ruler, and the rows.

use std::collections::BTreeSet;
use std::sync::Arc;

use chereme_corpus::RecordingContents;
use chereme_motion::RecordingInstant;
use eframe::egui::{
    Color32, CursorIcon, FontId, Id, Label, Rangef, Rect, RichText, Role, ScrollArea, Sense, TextStyle, Ui, WidgetInfo,
    vec2,
};

use super::timeline_data::time_text;
use super::timeline_edit::TimelineScene;
use super::timeline_rows::TimelineRow;
use super::{
    TimelinePane, bar, detector_list, go_to_time, paste_box, proposals, select, tier_box, tier_list, timeline_data,
    timeline_paint,
};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::model::time_window::TimeWindow;
use crate::words::{fill_text_braces, timeline as words};

/// The least width of the column of tier names in points, and its greatest share of the pane.
const TIER_NAMES_WIDTH_POINTS: f32 = 96.0;
const NAMES_SHARE: f32 = 0.35;
/// How long the rows must rest before the column of names grows for newly visible names, in seconds.
const NAMES_REST_SECONDS: f64 = 0.25;
/// The indent of a child tier's name relative to its parent's, in points.
pub(super) const TIER_INDENT_POINTS: f32 = 12.0;
/// The height of a tier's row, in points.
const TIER_ROW_HEIGHT_POINTS: f32 = 26.0;
/// The height of the ruler of times, in points.
const RULER_HEIGHT_POINTS: f32 = 22.0;
/// Annotations at least this wide, in points, are separate widgets for the keyboard and assistive technology.
const NAMED_ANNOTATION_WIDTH_POINTS: f32 = 8.0;

/// The layout of the rows, kept between frames.
#[derive(Debug, Default)]
pub(super) struct TimelineLayout {
    /// The place of the rows on the screen.
    pub(super) area: Option<Rect>,
    /// The visible tiers, by index in the recording's list, with their vertical ranges.
    pub(super) rows: Vec<(usize, Rangef)>,
    /// All rows, and the inputs that they were computed from.
    all: Vec<TimelineRow>,
    of: Option<(usize, BTreeSet<String>, BTreeSet<String>)>,
    /// The width of the column of names, the width of each tier's name, and the time when names last became wider.
    names: f32,
    widths: Vec<f32>,
    rests: Option<(f32, f64)>,
    /// The scroll offset of the rows, in points.
    pub(super) top: f32,
    /// Whether the rows changed since the last frame.
    grown: bool,
    /// Whether the new rows must be scrolled into sight.
    fresh: bool,
    /// The next scroll offset, in points.
    pub(super) scroll_to: Option<f32>,
    /// The tier that was selected last, and the height of the rows while it was in sight.
    seen: Option<i64>,
    height: Option<f32>,
}

impl TimelineLayout {
    /// Returns the index of the tier whose row contains `y`.
    pub(super) fn tier_at(&self, y: f32) -> Option<usize> {
        let entry = self.rows.iter().find(|(_, range)| range.contains(y));
        entry.map(|(tier, _)| *tier)
    }

    /// Computes the rows and the width of names again if the snapshot, the settings or the pane changed; returns
    /// whether the rows are new.
    fn update_timeline_layout(&mut self, ui: &Ui, contents: &RecordingContents, seen: &PaneInput<'_>) -> bool {
        let settings = &seen.settings.timeline;
        let open = seen.snapshot.open.as_ref();
        let now = open.map_or(0, |open| Arc::as_ptr(open) as usize);
        let same = self
            .of
            .as_ref()
            .is_some_and(|(of, folded, hidden)| *of == now && *folded == settings.folded && *hidden == settings.hidden);
        if same {
            return false;
        }
        let before = std::mem::replace(&mut self.all, select::shown_rows(contents, seen));
        self.of = Some((now, settings.folded.clone(), settings.hidden.clone()));
        let font = TextStyle::Body.resolve(ui.style());
        self.widths = vec![0.0; contents.tiers.len()];
        for row in &self.all {
            let name = contents.tiers[row.tier].row.name.clone();
            let text = ui.painter().layout_no_wrap(name, font.clone(), Color32::WHITE);
            self.widths[row.tier] = text.size().x + 34.0 + TIER_INDENT_POINTS * row.depth as f32;
        }
        if before != self.all {
            let (from, room) = (
                (self.top / TIER_ROW_HEIGHT_POINTS) as usize,
                ui.available_height() / TIER_ROW_HEIGHT_POINTS,
            );
            let in_sight = self.all.iter().skip(from).take(room.ceil() as usize);
            self.names = fitting_column_width(in_sight.map(|row| self.widths[row.tier]));
            self.rows.clear();
            return true;
        }
        false
    }

    /// Widens the column for names that were scrolled into sight, once the scrolling rests: a column that changes all
    /// the time would move every annotation.
    fn widen_name_column(&mut self, ui: &Ui) {
        let widths = self.rows.iter().map(|(tier, _)| self.widths.get(*tier));
        let wanted = fitting_column_width(widths.flatten().copied());
        let now = ui.input(|input| input.time);
        if wanted <= self.names {
            self.rests = None;
            return;
        }
        let since = match self.rests {
            Some((top, since)) if top == self.top => since,
            _ => now,
        };
        self.rests = Some((self.top, since));
        if now - since >= NAMES_REST_SECONDS {
            (self.names, self.rests) = (wanted, None);
        }
        ui.ctx().request_repaint();
    }
}

/// Returns the width of a column that contains names of those widths.
fn fitting_column_width(widths: impl Iterator<Item = f32>) -> f32 {
    widths.fold(TIER_NAMES_WIDTH_POINTS, f32::max)
}

pub(super) fn show_timeline_pane(timeline: &mut TimelinePane, ui: &mut Ui, seen: &PaneInput<'_>) {
    let Some(recording) = seen.shown.recording else {
        if seen.snapshot.overview.recordings.is_empty() {
            return no_recordings(ui, seen);
        }
        ui.label(seen.say_text(words::NO_RECORDING));
        return;
    };
    let Some(scene) = TimelineScene::scene_from_input(seen) else {
        ui.spinner();
        return;
    };
    let fresh = timeline.turn_timeline_to_recording(recording);
    follow_up(timeline, &scene);
    ui.spacing_mut().item_spacing.y = 2.0;
    bar::show_timeline_bar(ui, &scene);
    if let Some(showing) = &seen.shown.made {
        let names: [(&str, &dyn std::fmt::Display); 2] = [
            ("made", &showing.made.name),
            ("recording", &scene.contents.recording.name),
        ];
        let text = fill_text_braces(seen.say_text(words::OTHER_ON_STAGE), &names);
        let label = Label::new(RichText::new(text).small().color(seen.pane_colours().accent));
        ui.add(label.truncate());
        ui.multiply_opacity(0.55);
    }
    // The rows can be scrolled to after the area knows how many there are.
    if std::mem::take(&mut timeline.layout.grown) {
        (timeline.view.reveal, timeline.layout.fresh) = (true, true);
    }
    if timeline.layout.update_timeline_layout(ui, scene.contents, seen) {
        timeline.layout.grown = true;
        ui.ctx().request_repaint();
    }
    timeline.layout.widen_name_column(ui);
    let most = (ui.available_width() * NAMES_SHARE).max(TIER_NAMES_WIDTH_POINTS);
    let names = timeline.layout.names.min(most);
    let width = (ui.available_width() - names).max(40.0);
    timeline.view.width = width;
    if fresh {
        let player = &scene.seen.shown.player;
        let playhead_micros = scene.scene_playhead_micros() as f64;
        timeline.view.window = timeline_data::first_window(&scene.contents.tiers, player.whole, playhead_micros, width);
    }
    let window = follow_playhead_window(timeline, &scene, width);
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut frame = TimelineDrawing {
        timeline,
        window,
        names,
        seen,
    };
    frame.show_timeline_overview(ui, &scene);
    frame.show_ruler_row(ui);
    frame.show_curve_lanes(ui, &scene);
    if scene.contents.tiers.is_empty() {
        frame.show_empty_timeline(ui, scene.contents);
    } else {
        frame.show_tier_rows(ui, scene.contents);
    }
    tier_list::show_tier_chooser(timeline, ui, &scene);
    detector_list::show_detector_list(timeline, ui, &scene);
    tier_box::show_tier_box(timeline, ui, &scene);
    paste_box::show_paste_box(timeline, ui, &scene);
    go_to_time::show_go_to_time(timeline, ui, &scene);
}

/// Shows the next steps in a corpus without recordings.
fn no_recordings(ui: &mut Ui, seen: &PaneInput<'_>) {
    let empty = seen.snapshot.overview.signs.is_empty();
    let (text, actions): (_, &[Action]) = if empty {
        let import = &[Action::ImportFiles, Action::ImportFolder];
        (crate::words::stage_words::EMPTY, import)
    } else {
        let signs = &[Action::ShowLibrary, Action::Search, Action::Import];
        (words::NO_RECORDINGS, signs)
    };
    ui.label(seen.say_text(text));
    ui.horizontal_wrapped(|ui| {
        for action in actions.iter().copied() {
            let button = ui.button(seen.say_text(action.action_row().name));
            if button.on_hover_text(seen.keys.action_keys_text(action)).clicked() {
                seen.send_command(WindowCommand::Do(action));
            }
        }
    });
}

/// Selects added annotations, and forgets ghosts that the snapshot contains.
fn follow_up(timeline: &mut TimelinePane, scene: &TimelineScene<'_>) {
    timeline
        .asked
        .settle_requested_changes(scene.seen.snapshot.open.as_ref());
    // Another recording may have been opened meanwhile.
    let all = std::mem::take(&mut timeline.asked.to_select);
    let first = all.first();
    if let Some(made) = first.and_then(|id| scene.seen.snapshot.find_open_annotation(*id)) {
        let span = made.tier.annotations.annotation_span_at(made.at);
        let whole_span = scene.seen.shown.player.whole;
        timeline
            .view
            .bring_into_sight(made.tier.row.id, span.span_start_instant(), whole_span);
        if timeline.asked.to_edit {
            timeline.edit_annotation_values(scene, all.clone());
        }
        if all.len() == 1 {
            scene.seen.send_command(WindowCommand::Span(Some(span)));
        }
        scene.seen.send_command(WindowCommand::Tier(Some(made.tier.row.id)));
        scene.seen.send_command(WindowCommand::Annotations(all));
    }
    timeline.asked.to_edit = false;
    if std::mem::take(&mut timeline.asked.to_propose) {
        proposals::show_next(timeline, scene);
    }
    let restored = timeline.entry.editing.as_ref().filter(|_| timeline.entry.restored);
    if let Some(tier) = restored.and_then(|target| target.editing_tier(scene)) {
        scene.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
        timeline.entry.restored = false;
    }
    if let Some(name) = &timeline.boxes.tier_named {
        let tiers = &scene.contents.tiers;
        let id = tiers.iter().find(|tier| tier.row.name == *name).map(|tier| tier.row.id);
        if id.is_some() && scene.seen.shown.tier == id {
            (timeline.boxes.tier_named, timeline.view.reveal) = (None, true);
        } else if id.is_some() {
            scene.seen.send_command(WindowCommand::Tier(id));
        }
    }
    let recording = scene.contents.recording.id;
    timeline.entry.begun.take_if(|editing| editing.recording != recording);
}

/// Returns the visible part of the recording; it moves by a page when the playhead leaves it.
fn follow_playhead_window(timeline: &mut TimelinePane, scene: &TimelineScene<'_>, width: f32) -> TimeWindow {
    let player = &scene.seen.shown.player;
    let (whole, playhead) = (player.whole, scene.scene_playhead_micros());
    let moved = std::mem::replace(&mut timeline.view.playhead, playhead) != playhead;
    let mut window = timeline.view.visible_time_window(whole, width);
    if moved && timeline.view.window.is_some() && timeline.gesture.is_none() {
        window = window.window_following_time(playhead as f64, whole, width);
        timeline.view.window = Some(window);
    }
    window
}

pub(super) struct TimelineDrawing<'a, 'b> {
    pub(super) timeline: &'a mut TimelinePane,
    pub(super) window: TimeWindow,
    pub(super) names: f32,
    pub(super) seen: &'a PaneInput<'b>,
}

impl TimelineDrawing<'_, '_> {
    fn show_empty_timeline(&mut self, ui: &mut Ui, contents: &RecordingContents) {
        ui.add_space(8.0);
        ui.label(self.seen.say_text(words::EMPTY));
        ui.horizontal(|ui| {
            let usual = self.seen.say_text(words::USUAL_ARE);
            let adding = self.seen.keys.action_keys_text(Action::AddTier);
            for (action, hint) in [(Action::UsualTiers, usual), (Action::AddTier, &adding)] {
                let button = ui.button(self.seen.say_text(action.action_row().name));
                if button.on_hover_text(hint).clicked() {
                    self.seen.send_command(WindowCommand::Do(action));
                }
            }
            let scene = TimelineScene::new(contents, self.seen);
            bar::show_copy_tiers_menu(ui, &scene);
        });
    }

    fn show_ruler_row(&mut self, ui: &mut Ui) {
        let size = vec2(ui.available_width(), RULER_HEIGHT_POINTS);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let lane = rect.with_min_x(rect.left() + self.names);
        let response = ui.interact(lane, ui.unique_id().with("ruler"), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, self.seen.say_text(words::RULER)));
        let painter = ui.painter_at(lane);
        let font = TextStyle::Small.resolve(ui.style());
        if let Some(span) = self.seen.shown.span {
            timeline_paint::paint_time_selection(&painter, lane, &self.window, span, self.seen);
            let text = fill_text_braces(
                self.seen.say_text(words::SELECTED),
                &[
                    ("start", &time_text(span.span_start_instant())),
                    ("end", &time_text(span.span_end_instant())),
                ],
            );
            response.clone().on_hover_text(text);
        }
        // The times of the ruler are painted over the playhead, so that they stay readable.
        timeline_paint::paint_timeline_playhead(&painter, lane, &self.window, self.seen);
        timeline_paint::paint_time_ruler(&painter, lane, &self.window, self.seen, &font);
        if response.dragged() && ui.input(|input| input.modifiers.alt) {
            ui.set_cursor_icon(CursorIcon::Grabbing);
            let whole_span = self.seen.shown.player.whole;
            let by = -response.drag_delta().x;
            self.timeline.view.window = Some(self.window.panned_window(by, whole_span, lane.width()));
        } else if let Some(at) = response.interact_pointer_pos()
            && (response.dragged() || response.clicked())
        {
            self.seen.send_seek(self.instant_at_x(at.x - lane.left()));
        }
        self.wheel(ui, lane);
    }

    fn show_tier_rows(&mut self, ui: &mut Ui, contents: &RecordingContents) {
        let area = ui.available_rect_before_wrap();
        self.timeline.layout.area = Some(area);
        let all = std::mem::take(&mut self.timeline.layout.all);
        self.timeline.layout.rows.clear();
        let ghosts = std::mem::take(&mut self.timeline.asked.ghosts);
        let mut moving: BTreeSet<i64> = ghosts.iter().filter_map(|ghost| ghost.id).collect();
        if let Some(gesture) = &self.timeline.gesture {
            moving.extend(gesture.moving_annotation_ids());
        }
        // A tier selected elsewhere, such as by a search result, comes into sight, and stays there if the pane changes
        // size.
        let selected = self.seen.shown.tier;
        if selected != self.timeline.layout.seen && !ui.input(|input| input.pointer.any_down()) {
            self.timeline.layout.seen = selected;
            self.timeline.view.reveal |= selected.is_some();
        }
        if let Some((tier, frames)) = self.timeline.view.other_tier {
            self.timeline.view.reveal = true;
            let scrolled = ui.input(|input| input.smooth_scroll_delta().y != 0.0);
            let left = frames.checked_sub(1).filter(|_| !scrolled);
            self.timeline.view.other_tier = left.map(|left| (tier, left));
            ui.ctx().request_repaint();
        }
        let mut scroll = ScrollArea::vertical().auto_shrink(false);
        let scroll_offset = self.timeline.layout.scroll_to.take();
        if let Some(offset) = self.reveal(&all, contents, area.height()).or(scroll_offset) {
            scroll = scroll.vertical_scroll_offset(offset);
        }
        let shown = scroll.show_rows(ui, TIER_ROW_HEIGHT_POINTS, all.len(), |ui, range| {
            for (at, row) in all[range.clone()].iter().enumerate() {
                self.show_tier_row(ui, contents, range.start + at, row, &moving);
            }
        });
        self.timeline.layout.top = shown.state.clamped_offset().y;
        let is = |row: &TimelineRow| Some(contents.tiers[row.tier].row.id) == selected;
        let inside = all.iter().position(is).is_some_and(|number| {
            let top = number as f32 * TIER_ROW_HEIGHT_POINTS - self.timeline.layout.top;
            (0.0..=area.height() - TIER_ROW_HEIGHT_POINTS).contains(&top)
        });
        let before = self.timeline.layout.height.take();
        if !inside && before.is_some_and(|before| before != area.height()) {
            self.timeline.view.reveal = true;
            ui.ctx().request_repaint();
        }
        self.timeline.layout.height = inside.then_some(area.height());
        self.timeline.layout.all = all;
        self.timeline.asked.ghosts = ghosts;
        self.held_tier(ui, contents, area);
        let sight = self.continue_timeline_gesture(ui, contents, area);
        let lane = area.with_min_x(area.left() + self.names);
        let painter = ui.painter_at(lane);
        self.paint_overlay_annotations(ui, contents, lane, &sight);
        let x = lane.left()
            + self
                .window
                .time_to_points(self.seen.shown.player.player_playhead().instant_micros() as f64);
        let stroke = eframe::egui::Stroke::new(1.5, self.seen.pane_colours().playhead);
        painter.vline(x, lane.y_range(), stroke);
        self.wheel(ui, lane);
        self.show_lane_editor(ui, contents, lane);
    }

    /// Returns the distance to scroll to bring the selected tier into sight, on request.
    fn reveal(&mut self, all: &[TimelineRow], contents: &RecordingContents, height: f32) -> Option<f32> {
        if !std::mem::take(&mut self.timeline.view.reveal) {
            return None;
        }
        let other = self.timeline.view.other_tier.map(|entry| entry.0);
        let wanted = other.or(self.seen.shown.tier);
        let is = |row: &TimelineRow| Some(contents.tiers[row.tier].row.id) == wanted;
        let number = all.iter().position(is)?;
        let row_top = number as f32 * TIER_ROW_HEIGHT_POINTS;
        let top = self.timeline.layout.top;
        // Its children are shown as well if there is room for both.
        let below = all[number + 1..].iter();
        let family = below.take_while(|row| row.depth > all[number].depth).count();
        let rows = if self.timeline.layout.fresh { family } else { 0 };
        let end = (row_top + (rows + 1) as f32 * TIER_ROW_HEIGHT_POINTS).min(row_top + height);
        self.timeline.layout.fresh = false;
        if row_top < top {
            Some(row_top)
        } else if end > top + height {
            Some(end - height)
        } else {
            None
        }
    }

    fn show_tier_row(
        &mut self,
        ui: &mut Ui,
        contents: &RecordingContents,
        number: usize,
        row: &TimelineRow,
        moving: &BTreeSet<i64>,
    ) {
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), TIER_ROW_HEIGHT_POINTS), Sense::hover());
        self.timeline.layout.rows.push((row.tier, rect.y_range()));
        if number % 2 == 1 {
            ui.painter().rect_filled(rect, 0.0, self.seen.pane_colours().stripe);
        }
        self.show_tier_header(ui, contents, row, rect.with_max_x(rect.left() + self.names - 4.0));
        self.lane(
            ui,
            contents,
            row.tier,
            rect.with_min_x(rect.left() + self.names),
            moving,
        );
    }

    fn lane(&mut self, ui: &mut Ui, contents: &RecordingContents, at: usize, lane: Rect, moving: &BTreeSet<i64>) {
        let tier = &contents.tiers[at];
        let response = ui.interact(lane, Id::unique(("lane", tier.row.id)), Sense::click_and_drag());
        let label = fill_text_braces(self.seen.say_text(words::LANE), &[("name", &tier.row.name)]);
        response.widget_info(|| WidgetInfo::labeled(Role::Unknown, true, &label));
        let painter = ui.painter_at(lane);
        if let Some(span) = self.seen.shown.span {
            timeline_paint::paint_time_selection(&painter, lane, &self.window, span, self.seen);
        }
        let font: FontId = TextStyle::Body.resolve(ui.style());
        let (from, to) = (
            self.window.start as i64,
            self.window.points_to_micros(lane.width()) as i64 + 1,
        );
        // Annotations narrower than a pixel and a half are drawn as one bar.
        let narrow = (self.window.scale * 1.5) as i64;
        for bar in &timeline_data::join_annotation_bars(&tier.annotations, from, to, narrow.max(1)) {
            let rect = timeline_paint::bar_rect(lane, &self.window, bar);
            let id = tier.annotations.ids[bar.at];
            let faint = bar.count == 1 && moving.contains(&id);
            timeline_paint::paint_annotation_bar(&painter, rect, tier, bar, self.seen, &font, faint);
            let chosen = self.seen.shown.annotations.contains(&id);
            if bar.count == 1 && (rect.width() >= NAMED_ANNOTATION_WIDTH_POINTS || chosen) {
                let here = rect.intersect(lane);
                let bar_response = ui.interact(here, Id::unique(("annotation", id)), Sense::click());
                let says = timeline_paint::bar_text(tier, bar, self.seen);
                let label = format!("{}: {says}", tier.row.name);
                bar_response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &label));
                if bar_response.has_focus() {
                    timeline_paint::paint_annotation_focus(&painter, here, self.seen);
                }
                // A bar lies over its lane and would otherwise keep the mouse from it.
                self.lane_mouse(ui, &bar_response, contents, at, lane);
                self.lane_menu(&bar_response, contents, at, lane);
            }
        }
        self.lane_mouse(ui, &response, contents, at, lane);
        self.lane_menu(&response, contents, at, lane);
    }

    /// Zooms around the pointer with Ctrl and the wheel; pans with Shift and the wheel, or a sideways wheel.
    fn wheel(&mut self, ui: &Ui, lane: Rect) {
        let Some(pointer) = ui.input(|input| input.pointer.hover_pos()) else {
            return;
        };
        if !lane.contains(pointer) || !ui.rect_contains_pointer(lane) {
            return;
        }
        let (zoom, pan) = ui.input(|input| (input.zoom_delta(), input.smooth_scroll_delta().x));
        let (whole, width) = (self.seen.shown.player.whole, lane.width());
        if zoom != 1.0 {
            let around = self.window.points_to_micros(pointer.x - lane.left());
            let window = self.window.zoomed_window(1.0 / f64::from(zoom), around, whole, width);
            self.timeline.view.window = Some(window);
        } else if pan != 0.0 {
            self.timeline.view.window = Some(self.window.panned_window(-pan, whole, width));
        }
    }

    pub(super) fn instant_at_x(&self, x: f32) -> RecordingInstant {
        let whole_span = self.seen.shown.player.whole;
        let micros = self.window.points_to_micros(x).round() as i64;
        let last = whole_span.span_end_instant().instant_micros();
        RecordingInstant::from_micros(micros.clamp(whole_span.span_start_instant().instant_micros(), last))
    }
}
