//! The effect of a mouse gesture while the button is held, and when it is released.

use std::collections::BTreeSet;

use chereme_corpus::snap::{SnapGuides, SnapTarget};
use chereme_corpus::{RecordingContents, requests};
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{CursorIcon, Key, Modifiers, Pos2, Rect, Ui};

use super::dragged::{self, DraggedAnnotations};
use super::gesture::{AnnotationDrag, TimelineGesture};
use super::tier_spans::{DragGrip, SpanItem};
use super::timeline_edit::TimelineScene;
use super::timeline_ui::TimelineDrawing;
use super::{ChangeFollowUp, GhostAnnotation, tier_list};
use crate::command::WindowCommand;
use crate::words::timeline as words;

/// The distance within which a time snaps, in points.
const TIME_SNAP_REACH_POINTS: f64 = 8.0;

/// The visible effect of a gesture.
#[derive(Debug, Default)]
pub(super) struct GestureSight {
    pub(super) ghosts: Vec<GhostAnnotation>,
    /// Whether the annotations cannot be there.
    pub(super) refused: bool,
    /// The span whose times are shown beside the pointer.
    pub(super) times: Option<(i64, i64)>,
    /// The time that snapped, and what it snapped to.
    pub(super) caught: Option<(i64, SnapTarget)>,
    pub(super) band: Option<Rect>,
}

impl TimelineDrawing<'_, '_> {
    /// Continues a gesture, ends it when the button is released, and returns its visible effect.
    pub(super) fn continue_timeline_gesture(
        &mut self,
        ui: &Ui,
        contents: &RecordingContents,
        area: Rect,
    ) -> GestureSight {
        let Some(mut gesture) = self.timeline.gesture.take() else {
            return GestureSight::default();
        };
        let (pointer, down) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.latest_pos(), pointer.primary_down())
        });
        // Escape ends the gesture, but the button is still down: nothing may begin until it is released.
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            if let TimelineGesture::Select { .. } = gesture {
                self.seen.send_command(WindowCommand::Span(None));
            }
            self.follow_with(self.timeline.mark);
            gesture = TimelineGesture::Off;
        }
        // Without a pointer nothing is held, and the gesture ends.
        let Some(pointer) = pointer else {
            return GestureSight::default();
        };
        let lane = area.with_min_x(area.left() + self.names);
        self.pan_at_edges(ui, lane, pointer);
        let time = self.window.points_to_micros(pointer.x - lane.left()).round() as i64;
        let sight = match &mut gesture {
            TimelineGesture::Off => GestureSight::default(),
            TimelineGesture::Select { from } => self.select_on(contents, *from, time),
            TimelineGesture::Create { from, tier, span } => {
                let (found, sight) = self.create_on(contents, *tier, *from, time);
                *span = found;
                sight
            }
            TimelineGesture::Drag(dragging) => {
                ui.set_cursor_icon(match dragging.grip {
                    DragGrip::Whole => CursorIcon::Grabbing,
                    _ => CursorIcon::ResizeHorizontal,
                });
                self.drag_on(contents, dragging, time, pointer)
            }
            TimelineGesture::Band { from, time: origin } => self.band_on(contents, *from, *origin, pointer, time),
        };
        if down {
            self.timeline.gesture = Some(gesture);
        } else {
            self.finish_timeline_gesture(contents, gesture);
        }
        sight
    }

    /// Scrolls through time while the pointer is dragged past the edge.
    fn pan_at_edges(&mut self, ui: &Ui, lane: Rect, pointer: Pos2) {
        // Signed: past the right edge forwards, past the left one backwards.
        let past = (pointer.x - lane.right()).max(0.0) - (lane.left() - pointer.x).max(0.0);
        if past != 0.0 && self.timeline.view.window.is_some() {
            let whole_span = self.seen.shown.player.whole;
            self.window = self.window.panned_window(past * 0.2, whole_span, lane.width());
            self.timeline.view.window = Some(self.window);
            ui.ctx().request_repaint();
        }
    }

    fn snap_dragged_time(
        &self,
        contents: &RecordingContents,
        except: &BTreeSet<i64>,
        time: i64,
    ) -> (i64, Option<SnapTarget>) {
        let scene = TimelineScene::new(contents, self.seen);
        // The playhead moves with the drag, so its old place is a mark instead: the moving one would hold the drag
        // back.
        let marks = [self.timeline.mark];
        let snaps = self.seen.settings.timeline.snaps;
        let reach = (TIME_SNAP_REACH_POINTS * self.window.scale) as i64;
        let minima = if snaps.minima {
            // A little beyond the reach, so that minima at its edge are found too.
            self.timeline
                .curves
                .wrist_speed_minima(time - 4 * reach, time + 4 * reach)
        } else {
            Vec::new()
        };
        let guides = SnapGuides {
            snaps,
            tiers: &contents.tiers,
            except,
            marks: &marks,
            minima: &minima,
            frames: scene.recording_frame_times(),
            reach,
        };
        guides.snap_time(time)
    }

    /// Shows the moment of a dragged boundary on the stage, as in ELAN, unless something plays.
    fn follow_with(&mut self, at: i64) {
        let player = &self.seen.shown.player;
        // While something plays the playhead is not dragged away from it.
        if !player.is_playing() && player.player_playhead().instant_micros() != at {
            self.seen.send_seek(RecordingInstant::from_micros(at));
        }
    }

    fn clamp_to_recording(&self, time: i64) -> i64 {
        let whole_span = self.seen.shown.player.whole;
        time.clamp(
            whole_span.span_start_instant().instant_micros(),
            whole_span.span_end_instant().instant_micros(),
        )
    }

    fn select_on(&mut self, contents: &RecordingContents, from: i64, time: i64) -> GestureSight {
        // Both ends snap, so that a span from frame to frame is possible.
        let none = BTreeSet::new();
        let (from, _) = self.snap_dragged_time(contents, &none, from);
        let (to, caught) = self.snap_dragged_time(contents, &none, time);
        let (from, to) = (self.clamp_to_recording(from), self.clamp_to_recording(to));
        let micros = RecordingInstant::from_micros;
        let span = Some(TimeSpan::span_between(micros(from), micros(to))).filter(|span| !span.is_empty());
        self.seen.send_command(WindowCommand::Span(span));
        self.follow_with(to);
        GestureSight {
            times: span.map(|_| (from.min(to), from.max(to))),
            caught: caught.map(|why| (to, why)),
            ..GestureSight::default()
        }
    }

    fn create_on(
        &mut self,
        contents: &RecordingContents,
        tier: i64,
        from: i64,
        time: i64,
    ) -> ((i64, i64), GestureSight) {
        let none = BTreeSet::new();
        let (from, _) = self.snap_dragged_time(contents, &none, from);
        let (to, caught) = self.snap_dragged_time(contents, &none, time);
        let (from, to) = (self.clamp_to_recording(from), self.clamp_to_recording(to));
        self.follow_with(to);
        let wanted = (from.min(to), from.max(to));
        let target_tier = contents.tiers.iter().find(|candidate| candidate.row.id == tier);
        let room = target_tier.and_then(|tier| dragged::room_for_annotation(contents, tier, wanted));
        let (start, end) = room.unwrap_or(wanted);
        let ghost = GhostAnnotation {
            tier,
            id: None,
            start,
            end,
        };
        let sight = GestureSight {
            ghosts: vec![ghost],
            refused: room.is_none(),
            times: Some((start, end)),
            caught: caught.map(|why| (to, why)),
            band: None,
        };
        // Without room the annotation has no length, and the drop does nothing.
        (room.unwrap_or((from, from)), sight)
    }

    fn drag_on(
        &mut self,
        contents: &RecordingContents,
        it: &mut AnnotationDrag,
        time: i64,
        pointer: Pos2,
    ) -> GestureSight {
        let wanted = time - it.from;
        // The boundary that is nearest to a mark snaps; the others move along.
        let settled = it.edges.iter().map(|edge| {
            let (at, why) = self.snap_dragged_time(contents, &it.except, edge + wanted);
            (at - edge, at, why)
        });
        // A boundary that snaps comes first, by the kind of its target, then the nearest one.
        let best = settled.min_by_key(|(by, _, why)| (why.is_none(), *why, (by - wanted).abs()));
        let (by, at, why) = best.unwrap_or((wanted, time, None));
        let mode = self.seen.settings.timeline.mode;
        it.changed = it
            .held
            .iter()
            .map(|held| held.drag_annotations(it.grip, by, mode))
            .collect();
        // On another tier the modes do not apply: only the dragged annotations move.
        it.to = self.other_tier(contents, it, pointer);
        if let Some((to, _)) = it.to {
            let moved = |held: &DraggedAnnotations| -> Vec<SpanItem> {
                let chosen = held.items.iter().filter(|item| held.chosen.contains(&item.id));
                chosen
                    .map(|item| SpanItem {
                        start: item.start + by,
                        end: item.end + by,
                        ..*item
                    })
                    .collect()
            };
            it.changed = it.held.iter().map(moved).collect();
            let scene = TimelineScene::new(contents, self.seen);
            let items: Vec<SpanItem> = it.changed.iter().flatten().copied().collect();
            let chosen = items.iter().map(|item| item.id).collect();
            let fits = scene.tier_of(to).is_some_and(|tier| {
                tier_list::tier_misfit_reason(&scene, tier, &items).is_none() && !requests::has_below(contents, &chosen)
            });
            it.to = Some((to, fits));
        }
        let pairs = it.held.iter().zip(&it.changed);
        let ghosts: Vec<GhostAnnotation> = pairs
            .flat_map(|(held, changed)| {
                let tier = it.to.map_or(held.tier, |(to, _)| to);
                changed
                    .iter()
                    .map(move |item| GhostAnnotation::ghost_from_item(tier, item))
            })
            .collect();
        let dragged_ghost = ghosts.iter().find(|ghost| ghost.id == Some(it.id));
        match (dragged_ghost, it.grip) {
            (Some(own), DragGrip::Start) => self.follow_with(own.start),
            (Some(own), DragGrip::End) => self.follow_with(own.end),
            _ => {}
        }
        // The snapped time is shown only if the limits of the tier let the boundary get there.
        let there = dragged_ghost.is_some_and(|own| own.start == at || own.end == at);
        GestureSight {
            times: dragged_ghost.map(|own| (own.start, own.end)),
            caught: why.filter(|_| there).map(|why| (at, why)),
            refused: it.to.is_some_and(|(_, fits)| !fits),
            ghosts,
            band: None,
        }
    }

    /// Returns the tier under the pointer, if whole annotations of one other tier are dragged.
    fn other_tier(&self, contents: &RecordingContents, it: &AnnotationDrag, pointer: Pos2) -> Option<(i64, bool)> {
        // Annotations of several tiers cannot go to one, nor can an edge.
        if it.grip != DragGrip::Whole || it.held.iter().any(|held| held.tier != it.tier) {
            return None;
        }
        let tier_index = self.timeline.layout.tier_at(pointer.y)?;
        let tier = contents.tiers.get(tier_index)?.row.id;
        (tier != it.tier).then_some((tier, true))
    }

    fn band_on(
        &mut self,
        contents: &RecordingContents,
        from: Pos2,
        time: i64,
        pointer: Pos2,
        now: i64,
    ) -> GestureSight {
        let band = Rect::from_two_pos(from, pointer);
        let (start, end) = (time.min(now), time.max(now));
        let mut all = BTreeSet::new();
        for (at, y) in &self.timeline.layout.rows {
            if y.max < band.top() || y.min > band.bottom() {
                continue;
            }
            let Some(tier) = contents.tiers.get(*at) else {
                continue;
            };
            let columns = &tier.annotations;
            // Starts and ends are in order, so that both sides are found by halving.
            let first = columns.ends.partition_point(|other_end| *other_end <= start);
            let last = columns
                .starts
                .partition_point(|other_start| *other_start < end)
                .max(first);
            all.extend(columns.ids[first..last].iter().copied());
        }
        self.seen.send_command(WindowCommand::Annotations(all));
        GestureSight {
            band: Some(band),
            ..GestureSight::default()
        }
    }

    fn finish_timeline_gesture(&mut self, contents: &RecordingContents, gesture: TimelineGesture) {
        let scene = TimelineScene::new(contents, self.seen);
        match gesture {
            // A click with Alt creates nothing.
            TimelineGesture::Create { tier, span, .. } if span.1 > span.0 => {
                if let Some(tier) = scene.tier_of(tier) {
                    self.begin_value(tier, span);
                }
            }
            TimelineGesture::Drag(it) => self.drop_at(&scene, &it),
            _ => {}
        }
    }

    fn drop_at(&mut self, scene: &TimelineScene<'_>, it: &AnnotationDrag) {
        if let Some((to, fits)) = it.to {
            let items: Vec<SpanItem> = it.changed.iter().flatten().copied().collect();
            if !fits {
                let chosen = items.iter().map(|item| item.id).collect();
                let below = requests::has_below(scene.contents, &chosen);
                let tier = scene.tier_of(to);
                let unfit = tier.and_then(|tier| tier_list::tier_misfit_reason(scene, tier, &items));
                let why = unfit.filter(|_| !below).unwrap_or(words::HAS_BELOW);
                return self.show_gesture_hint(why);
            }
            let asked = requests::to_tier(scene.contents, &items, to, true);
            let ghosts = items
                .iter()
                .map(|item| GhostAnnotation::ghost_from_item(to, item))
                .collect();
            let then = ChangeFollowUp {
                select: items.len() == 1,
                ghosts,
                ..ChangeFollowUp::default()
            };
            self.seen.send_command(WindowCommand::Tier(Some(to)));
            self.timeline.request_annotation_changes(asked, then, self.seen.out);
            return;
        }
        let mut asked = Vec::new();
        let mut ghosts = Vec::new();
        for (held, changed) in it.held.iter().zip(&it.changed) {
            asked.extend(requests::set_times_changes(&held.requested_drag_changes(changed)));
            ghosts.extend(
                changed
                    .iter()
                    .map(|item| GhostAnnotation::ghost_from_item(held.tier, item)),
            );
        }
        // A drag back to its beginning changes nothing.
        if asked.is_empty() {
            return;
        }
        let dragged_ghost = ghosts.iter().find(|ghost| ghost.id == Some(it.id));
        if let Some(own) = dragged_ghost {
            let micros = RecordingInstant::from_micros;
            let span = TimeSpan::span_between(micros(own.start), micros(own.end));
            self.seen.send_command(WindowCommand::Span(Some(span)));
        }
        let then = ChangeFollowUp {
            ghosts,
            ..ChangeFollowUp::default()
        };
        self.timeline.request_annotation_changes(asked, then, self.seen.out);
    }
}
