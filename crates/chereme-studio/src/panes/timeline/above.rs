//! The layer above the rows: annotations at their future places, dragged ones, and the field for values.

use chereme_corpus::{RecordingContents, requests};
use eframe::egui::{Rangef, Rect, TextStyle, Ui};

use super::drag::GestureSight;
use super::timeline_edit::TimelineScene;
use super::timeline_paint::{self, PaintedGhost};
use super::timeline_ui::TimelineDrawing;
use super::{GhostAnnotation, editor};

impl TimelineDrawing<'_, '_> {
    /// Paints annotations that are not in the snapshot: those at their future places, and those being dragged.
    pub(super) fn paint_overlay_annotations(
        &mut self,
        ui: &Ui,
        contents: &RecordingContents,
        lane: Rect,
        sight: &GestureSight,
    ) {
        let painter = ui.painter_at(lane);
        let font = TextStyle::Body.resolve(ui.style());
        let mut all: Vec<(GhostAnnotation, bool)> = Vec::new();
        // While a drag runs, its own annotations replace those that wait for the corpus.
        if sight.ghosts.is_empty() {
            all.extend(self.timeline.asked.ghosts.iter().map(|ghost| (*ghost, false)));
        }
        all.extend(sight.ghosts.iter().map(|ghost| (*ghost, sight.refused)));
        if let Some(ghost) = self.new_ghost(contents) {
            all.push((ghost, false));
        }
        for (ghost, refused) in &all {
            let row = self
                .timeline
                .layout
                .rows
                .iter()
                .find(|(at, _)| contents.tiers.get(*at).is_some_and(|tier| tier.row.id == ghost.tier));
            let Some((at, y)) = row else { continue };
            let ghost_annotation = ghost.id.and_then(|id| self.seen.snapshot.find_open_annotation(id));
            let text = ghost_annotation
                .map(|annotation| requests::typed_annotation_value(&annotation.tier.annotations, annotation.at));
            let row = Rect::from_x_y_ranges(lane.x_range(), *y);
            let painted = PaintedGhost {
                start: ghost.start,
                end: ghost.end,
                tier: &contents.tiers[*at],
                text: text.unwrap_or_default(),
                refused: *refused,
            };
            timeline_paint::paint_ghost_annotation(&painter, row, &self.window, painted, self.seen, &font);
        }
        let pointer = ui.input(|input| input.pointer.latest_pos());
        timeline_paint::paint_gesture_sight(&painter, lane, &self.window, sight, pointer, self.seen);
    }

    /// Returns the annotation that is being typed, or created during playback.
    fn new_ghost(&self, contents: &RecordingContents) -> Option<GhostAnnotation> {
        let scene = TimelineScene::new(contents, self.seen);
        if let Some(begun) = &self.timeline.entry.begun {
            let here = scene.scene_playhead_micros();
            return Some(GhostAnnotation {
                tier: begun.tier,
                id: None,
                start: begun.start.min(here),
                end: begun.start.max(here),
            });
        }
        let editing = self.timeline.entry.editing.as_ref()?;
        match editing.target {
            editor::EditTarget::New { tier, start, end } => Some(GhostAnnotation {
                tier,
                id: None,
                start,
                end,
            }),
            editor::EditTarget::Of(_) => None,
        }
    }

    pub(super) fn show_lane_editor(&mut self, ui: &mut Ui, contents: &RecordingContents, lane: Rect) {
        let scene = TimelineScene::new(contents, self.seen);
        let Some(editing) = &self.timeline.entry.editing else {
            return;
        };
        let span = editing.editing_span_micros(&scene).unwrap_or_default();
        let tier = editing.editing_tier(&scene).map(|tier| tier.row.id);
        let row = self
            .timeline
            .layout
            .rows
            .iter()
            .find(|(at, _)| contents.tiers.get(*at).map(|tier| tier.row.id) == tier);
        // A tier that is folded away has no row; the field is then at the lower edge.
        let y = row.map_or(Rangef::point(lane.bottom()), |(_, y)| *y);
        // A lane may be narrower than the box's least width.
        let raw_x = lane.left() + self.window.time_to_points(span.0 as f64);
        let x = raw_x.min(lane.right() - 40.0).max(lane.left());
        let below = Rect::from_x_y_ranges(x..=x + 1.0, y);
        editor::show_value_field(self.timeline, ui, &scene, below);
    }
}
