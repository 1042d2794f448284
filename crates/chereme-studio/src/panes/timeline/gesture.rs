//! The mouse on the lanes: select time, move and resize, create, select several.
//!
//! | mouse | does |
//! |---|---|
//! | drag | selects time on the tier, as in ELAN |
//! | drag a selected annotation, or any with Alt | moves it, or its edge |
//! | Alt and drag on a free place | creates an annotation |
//! | Shift and drag | selects the annotations in the frame |
//! | Ctrl and click, or Alt and click | adds to the selection, or removes from it |
//! | Shift and click | selects up to the clicked annotation |
//! | double click | types the value, or creates an annotation on the selection |

use std::collections::BTreeSet;

use chereme_corpus::{RecordingContents, TierContents};
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{CursorIcon, Modifiers, Pos2, Rect, Response, Ui};

use super::dragged::{self, DraggedAnnotations, TierTiming};
use super::tier_spans::{DragGrip, SpanItem};
use super::timeline_edit::TimelineScene;
use super::timeline_ui::TimelineDrawing;
use super::{select, timeline_data, timeline_edit};
use crate::command::WindowCommand;
use crate::panes::ActionOutcome;
use crate::words::{InterfaceText, timeline as words};

/// The distance from an edge within which the edge is grabbed, in points.
const ANNOTATION_EDGE_REACH_POINTS: f32 = 5.0;

/// The running gesture of the mouse.
#[derive(Debug)]
pub(super) enum TimelineGesture {
    /// Selecting time, from this time.
    Select { from: i64 },
    /// Creating an annotation, from this time.
    Create { from: i64, tier: i64, span: (i64, i64) },
    /// Dragging annotations.
    Drag(Box<AnnotationDrag>),
    /// Selecting the annotations in a frame that began at this point and time.
    Band { from: Pos2, time: i64 },
    /// Nothing until the button is released.
    Off,
}

impl TimelineGesture {
    /// Returns the annotations that are drawn at another place meanwhile.
    pub(super) fn moving_annotation_ids(&self) -> Vec<i64> {
        match self {
            Self::Drag(it) => it.changed.iter().flatten().map(|item| item.id).collect(),
            _ => Vec::new(),
        }
    }
}

/// Annotations while they are dragged.
#[derive(Debug)]
pub(super) struct AnnotationDrag {
    pub(super) held: Vec<DraggedAnnotations>,
    pub(super) grip: DragGrip,
    /// The boundaries that snap: one, or both of a whole annotation.
    pub(super) edges: Vec<i64>,
    /// The time where the mouse was pressed.
    pub(super) from: i64,
    /// The tier of the annotation under the mouse.
    pub(super) tier: i64,
    /// The tier that they would move to, and whether they fit there.
    pub(super) to: Option<(i64, bool)>,
    /// The changed annotations, for each of `held`.
    pub(super) changed: Vec<Vec<SpanItem>>,
    /// The annotation under the mouse.
    pub(super) id: i64,
    /// The dragged annotations and their descendants, which are no snapping targets.
    pub(super) except: BTreeSet<i64>,
}

/// Returns the part of an annotation, drawn from `left` to `right`, that is grabbed at `x`.
pub(super) fn grip_at(left: f32, right: f32, x: f32) -> DragGrip {
    // In a narrow annotation a quarter at each side, which leaves half of it to move it as a whole.
    let edge = ANNOTATION_EDGE_REACH_POINTS.min((right - left) / 4.0);
    if x < left + edge {
        DragGrip::Start
    } else if x > right - edge {
        DragGrip::End
    } else {
        DragGrip::Whole
    }
}

impl TimelineDrawing<'_, '_> {
    /// Begins the mouse gestures of a lane, and handles its clicks.
    pub(super) fn lane_mouse(
        &mut self,
        ui: &Ui,
        response: &Response,
        contents: &RecordingContents,
        at: usize,
        lane: Rect,
    ) {
        let modifiers = ui.input(|input| input.modifiers);
        if response.drag_started() {
            let origin = ui.input(|input| input.pointer.press_origin());
            if let Some(origin) = origin {
                self.begin_timeline_gesture(contents, at, lane, origin, modifiers);
            }
        }
        if response.hovered() && self.timeline.gesture.is_none() {
            self.hover(ui, contents, at, lane, modifiers);
        }
        let Some(pointer) = response.interact_pointer_pos() else {
            return;
        };
        if response.double_clicked() {
            self.double_click(contents, at, pointer, lane);
        } else if response.clicked() {
            self.click(contents, at, pointer, lane, modifiers);
        }
    }

    fn under(&self, contents: &RecordingContents, at: usize, lane: Rect, x: f32) -> Option<(usize, DragGrip)> {
        let columns = &contents.tiers[at].annotations;
        let chosen = &self.seen.shown.annotations;
        let time = |x: f32| self.window.points_to_micros(x - lane.left()) as i64;
        // An edge of a selected annotation can be grabbed from just outside it.
        let near = [
            x,
            x - ANNOTATION_EDGE_REACH_POINTS * 0.6,
            x + ANNOTATION_EDGE_REACH_POINTS * 0.6,
        ]
        .into_iter()
        .find_map(|near| {
            let index = timeline_data::annotation_index_at(columns, time(near))?;
            (near == x || chosen.contains(&columns.ids[index])).then_some(index)
        })?;
        let left = lane.left() + self.window.time_to_points(columns.starts[near] as f64);
        let right = lane.left() + self.window.time_to_points(columns.ends[near] as f64);
        Some((near, grip_at(left, right, x)))
    }

    fn hover(&self, ui: &Ui, contents: &RecordingContents, at: usize, lane: Rect, modifiers: Modifiers) {
        let Some(pointer) = ui.input(|input| input.pointer.hover_pos()) else {
            return;
        };
        let hit = self.under(contents, at, lane, pointer.x);
        let ids = &contents.tiers[at].annotations.ids;
        let draggable_hit =
            hit.filter(|(found, _)| modifiers.alt || self.seen.shown.annotations.contains(&ids[*found]));
        match draggable_hit {
            Some((_, DragGrip::Whole)) => ui.set_cursor_icon(CursorIcon::Grab),
            Some(_) => ui.set_cursor_icon(CursorIcon::ResizeHorizontal),
            None if modifiers.alt => ui.set_cursor_icon(CursorIcon::Crosshair),
            None => {}
        }
    }

    fn begin_timeline_gesture(
        &mut self,
        contents: &RecordingContents,
        at: usize,
        lane: Rect,
        origin: Pos2,
        modifiers: Modifiers,
    ) {
        let tier = &contents.tiers[at];
        let from = self.instant_at_x(origin.x - lane.left()).instant_micros();
        // The playhead follows the drag; boundaries snap to its place before the drag.
        self.timeline.mark = self.seen.shown.player.player_playhead().instant_micros();
        let hit = self.under(contents, at, lane, origin.x);
        let id = hit.map(|(found, _)| tier.annotations.ids[found]);
        let is_chosen = id.is_some_and(|id| self.seen.shown.annotations.contains(&id));
        self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
        if modifiers.shift {
            self.timeline.gesture = Some(TimelineGesture::Band {
                from: origin,
                time: from,
            });
            return;
        }
        let tier = tier.row.id;
        // Everything but selecting changes the corpus.
        let changes = modifiers.alt || (hit.is_some() && is_chosen);
        if changes && self.seen.snapshot.is_read_only() {
            self.show_gesture_hint(crate::words::shell::READ_ONLY_WHY);
            self.timeline.gesture = Some(TimelineGesture::Off);
            return;
        }
        match (hit, id) {
            (Some((found, grip)), Some(id)) if is_chosen || modifiers.alt => {
                self.take_hold(contents, at, found, id, grip, from);
            }
            (None, _) if modifiers.alt => {
                self.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
                let span = (from, from);
                self.timeline.gesture = Some(TimelineGesture::Create { from, tier, span });
            }
            _ => {
                self.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
                self.timeline.gesture = Some(TimelineGesture::Select { from });
            }
        }
    }

    fn take_hold(&mut self, contents: &RecordingContents, at: usize, found: usize, id: i64, grip: DragGrip, from: i64) {
        let columns = &contents.tiers[at].annotations;
        let mut chosen = self.seen.shown.annotations.clone();
        // An edge belongs to one annotation, so that the others are deselected.
        if !chosen.contains(&id) || grip != DragGrip::Whole {
            chosen = BTreeSet::from([id]);
            self.seen.send_command(WindowCommand::Annotations(chosen.clone()));
        }
        let scene = TimelineScene::new(contents, self.seen);
        let held_annotations = scene.held_annotations(&chosen);
        // Annotations in lists have no times of their own.
        if held_annotations.iter().all(|held| held.kind == TierTiming::Listed) {
            self.show_gesture_hint(words::NO_TIMES);
            self.timeline.gesture = Some(TimelineGesture::Off);
            return;
        }
        let (start, end) = (columns.starts[found], columns.ends[found]);
        let edges = match grip {
            DragGrip::Start => vec![start],
            DragGrip::End => vec![end],
            DragGrip::Whole => vec![start, end],
        };
        self.timeline.gesture = Some(TimelineGesture::Drag(Box::new(AnnotationDrag {
            changed: vec![Vec::new(); held_annotations.len()],
            held: held_annotations,
            grip,
            edges,
            from,
            tier: contents.tiers[at].row.id,
            to: None,
            id,
            except: dragged::with_below(contents, chosen),
        })));
    }

    fn click(&mut self, contents: &RecordingContents, at: usize, pointer: Pos2, lane: Rect, modifiers: Modifiers) {
        let tier = &contents.tiers[at];
        let here = self.instant_at_x(pointer.x - lane.left());
        let under = timeline_data::annotation_index_at(&tier.annotations, here.instant_micros());
        let chosen = &self.seen.shown.annotations;
        match under {
            Some(under) if modifiers.command || modifiers.alt => {
                let mut chosen = chosen.clone();
                super::timeline_view_settings::toggle_in_set(&mut chosen, tier.annotations.ids[under]);
                self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
                self.seen.send_command(WindowCommand::Annotations(chosen));
            }
            Some(under) if modifiers.shift => {
                let all = select::annotation_range_to(tier, chosen, under);
                self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
                self.seen.send_command(WindowCommand::Annotations(all));
            }
            None if modifiers.shift => {
                // Without a selection, Shift selects from the playhead on.
                let from = self.seen.shown.player.player_playhead();
                let span = self
                    .seen
                    .shown
                    .span
                    .map_or(TimeSpan::span_between(from, here), |span| nearest_side(span, here));
                self.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
                self.seen
                    .send_command(WindowCommand::Span(Some(span).filter(|span| !span.is_empty())));
            }
            Some(under) => {
                select::select_tier_annotation(tier, under, self.seen.out);
                self.seen.send_seek(here);
            }
            None => {
                self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
                self.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
                self.seen.send_seek(here);
            }
        }
    }

    fn double_click(&mut self, contents: &RecordingContents, at: usize, pointer: Pos2, lane: Rect) {
        let tier = &contents.tiers[at];
        let here = self.instant_at_x(pointer.x - lane.left());
        let scene = TimelineScene::new(contents, self.seen);
        if self.seen.snapshot.is_read_only() {
            return self.show_gesture_hint(crate::words::shell::READ_ONLY_WHY);
        }
        if let Some(under) = timeline_data::annotation_index_at(&tier.annotations, here.instant_micros()) {
            self.timeline
                .edit_annotation_values(&scene, BTreeSet::from([tier.annotations.ids[under]]));
            return;
        }
        let Some(span) = self.seen.shown.span.filter(|span| span.has_instant(here)) else {
            return self.show_gesture_hint(crate::words::shell::NEEDS_SELECTION);
        };
        let wanted = span.span_bounds_micros();
        match dragged::room_for_annotation(contents, tier, wanted) {
            Some(room) => self.begin_value(tier, room),
            None => self.show_gesture_hint(timeline_edit::no_room(tier)),
        }
    }

    /// Opens the field for the value of a new annotation, or says why there can be none.
    pub(super) fn begin_value(&mut self, tier: &TierContents, span: (i64, i64)) {
        if let ActionOutcome::Cannot(text) = self.timeline.edit_new(tier, span.0, span.1) {
            self.show_gesture_hint(text);
        }
    }

    pub(super) fn show_gesture_hint(&mut self, text: InterfaceText) {
        self.seen.send_command(WindowCommand::Cannot(text));
    }
}

/// Returns the span with its nearer side moved to a time.
fn nearest_side(span: TimeSpan, at: RecordingInstant) -> TimeSpan {
    let (start, end) = (span.span_start_instant(), span.span_end_instant());
    let to = |edge: RecordingInstant| (edge.instant_micros() - at.instant_micros()).abs();
    if to(start) < to(end) {
        TimeSpan::span_between(at, end)
    } else {
        TimeSpan::span_between(start, at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_can_be_grabbed_if_the_bar_has_room_for_a_middle() {
        for (right, x, want) in [
            (100.0, 2.0, DragGrip::Start),
            (100.0, 98.0, DragGrip::End),
            (100.0, 50.0, DragGrip::Whole),
            (8.0, 4.0, DragGrip::Whole),
            (8.0, 1.0, DragGrip::Start),
            (8.0, 7.5, DragGrip::End),
        ] {
            assert_eq!(grip_at(0.0, right, x), want, "{right} {x}");
        }
    }

    #[test]
    fn shift_click_moves_the_nearer_edge() {
        let micros = RecordingInstant::from_micros;
        let span = TimeSpan::span_between(micros(10), micros(20));
        assert_eq!(
            nearest_side(span, micros(5)),
            TimeSpan::span_between(micros(5), micros(20))
        );
        assert_eq!(
            nearest_side(span, micros(18)),
            TimeSpan::span_between(micros(10), micros(18))
        );
    }
}
