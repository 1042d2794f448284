//! The layer above the rows: annotations at their future places, dragged ones, and the field for values.

use chereme_corpus::{Contents, requests};
use eframe::egui::{Rangef, Rect, TextStyle, Ui};

use super::drag::Sight;
use super::edit::Scene;
use super::ui::Drawing;
use super::{Ghost, editor, paint};

impl Drawing<'_, '_> {
    /// Paints annotations that are not in the snapshot: those at their future places, and those being dragged.
    pub(super) fn overlay(&mut self, ui: &Ui, contents: &Contents, lane: Rect, sight: &Sight) {
        let painter = ui.painter_at(lane);
        let font = TextStyle::Body.resolve(ui.style());
        let mut all: Vec<(Ghost, bool)> = Vec::new();
        if sight.ghosts.is_empty() {
            all.extend(
                self.timeline
                    .asked
                    .ghosts
                    .iter()
                    .map(|ghost| (*ghost, false)),
            );
        }
        all.extend(sight.ghosts.iter().map(|ghost| (*ghost, sight.refused)));
        if let Some(ghost) = self.new_ghost(contents) {
            all.push((ghost, false));
        }
        for (ghost, refused) in &all {
            let row = self.timeline.layout.rows.iter().find(|(at, _)| {
                contents
                    .tiers
                    .get(*at)
                    .is_some_and(|tier| tier.row.id == ghost.tier)
            });
            let Some((at, y)) = row else { continue };
            let text = ghost.id.and_then(|id| self.seen.snapshot.annotation(id));
            let text = text.map(|it| requests::typed(&it.tier.annotations, it.at));
            let row = Rect::from_x_y_ranges(lane.x_range(), *y);
            let tier = &contents.tiers[*at];
            let what = (tier, text.unwrap_or_default(), *refused);
            let span = (ghost.start, ghost.end);
            paint::ghost(&painter, row, &self.window, span, what, (self.seen, &font));
        }
        let at = ui.input(|input| input.pointer.latest_pos());
        paint::sight(&painter, lane, &self.window, (sight, at), self.seen);
    }

    /// Returns the annotation that is being typed, or created during playback.
    fn new_ghost(&self, contents: &Contents) -> Option<Ghost> {
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        if let Some(begun) = &self.timeline.entry.begun {
            let here = scene.playhead();
            return Some(Ghost {
                tier: begun.tier,
                id: None,
                start: begun.start.min(here),
                end: begun.start.max(here),
            });
        }
        let editing = self.timeline.entry.editing.as_ref()?;
        match editing.target {
            editor::Target::New { tier, start, end } => Some(Ghost {
                tier,
                id: None,
                start,
                end,
            }),
            editor::Target::Of(_) => None,
        }
    }

    pub(super) fn editor(&mut self, ui: &mut Ui, contents: &Contents, lane: Rect) {
        let scene = Scene {
            contents,
            seen: self.seen,
        };
        let Some(editing) = &self.timeline.entry.editing else {
            return;
        };
        let span = editing.span(&scene).unwrap_or_default();
        let tier = editing.tier(&scene).map(|tier| tier.row.id);
        let row = self
            .timeline
            .layout
            .rows
            .iter()
            .find(|(at, _)| contents.tiers.get(*at).map(|tier| tier.row.id) == tier);
        let y = row.map_or(Rangef::point(lane.bottom()), |(_, y)| *y);
        // A lane may be narrower than the box's least width.
        let x = lane.left() + self.window.x(span.0 as f64);
        let x = x.min(lane.right() - 40.0).max(lane.left());
        let below = Rect::from_x_y_ranges(x..=x + 1.0, y);
        editor::show(self.timeline, ui, &scene, below, self.out);
    }
}
