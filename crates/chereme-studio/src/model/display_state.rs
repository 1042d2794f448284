//! The state of the display: shown objects, and the selection.

use std::collections::BTreeSet;
use std::sync::Arc;

use chereme_motion::TimeSpan;

use super::CorpusSnapshot;
use super::generated::GeneratedClip;
use super::model_handle::{PlacementHandle, TravelCourse};
use crate::player::StagePlayer;

/// The state of the display and the selection; only commands change it.
#[derive(Debug, Clone, Default)]
pub(crate) struct DisplayState {
    /// The recording.
    pub(crate) recording: Option<i64>,
    /// The tier that edits apply to.
    pub(crate) tier: Option<i64>,
    /// The annotations that edits apply to.
    pub(crate) annotations: BTreeSet<i64>,
    /// Annotations that were selected when they disappeared; they are selected again if they come back.
    pub(crate) lost: BTreeSet<i64>,
    /// The selected span of time, independent of the playhead.
    pub(crate) span: Option<TimeSpan>,
    /// The playhead and how it moves.
    pub(crate) player: StagePlayer,
    /// The placement value that was last clicked on a body.
    pub(crate) spot: Option<String>,
    /// The placement of the open recipe that can be dragged on the stage.
    pub(crate) handle: Option<PlacementHandle>,
    /// The path of the open recipe that can be pulled on the stage.
    pub(crate) course: Option<Box<TravelCourse>>,
    /// Generated movement, shown instead of the recording, with its own playhead.
    pub(crate) made: Option<StageMovement>,
}

/// Generated movement on the stage.
#[derive(Debug, Clone)]
pub(crate) struct StageMovement {
    pub(crate) made: Arc<GeneratedClip>,
    /// Its own playhead; its time starts at 0.
    pub(crate) player: StagePlayer,
}

impl DisplayState {
    /// Returns the player of the movement on the stage: that of generated movement if it is shown.
    pub(crate) fn on_stage(&self) -> &StagePlayer {
        self.made.as_ref().map_or(&self.player, |showing| &showing.player)
    }

    /// Returns the same player, to be changed.
    pub(crate) fn on_stage_mut(&mut self) -> &mut StagePlayer {
        match &mut self.made {
            Some(showing) => &mut showing.player,
            None => &mut self.player,
        }
    }

    /// Drops annotations that are gone from the selection, and selects again those that came back, for example after an
    /// undo. If the selected time was exactly that of the selected annotations in `before`, it follows their times.
    pub(crate) fn update_selected_annotations(&mut self, before: Option<&CorpusSnapshot>, snapshot: &CorpusSnapshot) {
        let was = before.and_then(|earlier| annotations_hull(earlier, &self.annotations));
        // Only a span that was the annotations' own follows them.
        if was.is_some() && was == self.span {
            self.span = annotations_hull(snapshot, &self.annotations).or(self.span);
        }
        let there = |id: &i64| snapshot.find_open_annotation(*id).is_some();
        let before = std::mem::take(&mut self.annotations);
        let (kept, gone): (BTreeSet<i64>, BTreeSet<i64>) = before.into_iter().partition(there);
        self.annotations = kept;
        if !gone.is_empty() {
            self.lost = gone;
        } else if self.annotations.is_empty() && !self.lost.is_empty() && self.lost.iter().all(there) {
            self.annotations = std::mem::take(&mut self.lost);
        }
    }

    /// Returns the selected annotation, if exactly one is selected.
    pub(crate) fn selected_annotation(&self) -> Option<i64> {
        (self.annotations.len() == 1)
            .then(|| self.annotations.first().copied())
            .flatten()
    }
}

/// Returns the span from the start of the first to the end of the last of the annotations that the snapshot holds.
fn annotations_hull(snapshot: &CorpusSnapshot, annotations: &BTreeSet<i64>) -> Option<TimeSpan> {
    let found_annotations = annotations.iter().filter_map(|id| snapshot.find_open_annotation(*id));
    found_annotations
        .map(|annotation| annotation.tier.annotations.annotation_span_at(annotation.at))
        .reduce(|a, b| a.enclosing_span(b))
}

#[cfg(test)]
mod tests {
    use chereme_motion::RecordingInstant;

    use super::*;
    use crate::model::OpenedRecording;
    use crate::panes::timeline::contents_of;

    fn snapshot(spans: &[(i64, i64, i64)]) -> CorpusSnapshot {
        CorpusSnapshot {
            open: Some(Arc::new(OpenedRecording::new(contents_of(spans)))),
            ..CorpusSnapshot::default()
        }
    }

    fn span(start: i64, end: i64) -> Option<TimeSpan> {
        let micros = RecordingInstant::from_micros;
        Some(TimeSpan::span_between(micros(start), micros(end)))
    }

    #[test]
    fn the_selected_time_follows_the_selected_annotations() {
        let moved = snapshot(&[(1, 30, 40), (2, 50, 60)]);
        let undone = snapshot(&[(1, 10, 20), (2, 50, 60)]);
        let shown = |annotations: &[i64], span| DisplayState {
            annotations: annotations.iter().copied().collect(),
            span,
            ..DisplayState::default()
        };
        for (annotations, before, after) in [
            (&[1][..], span(30, 40), span(10, 20)),
            (&[1, 2], span(30, 60), span(10, 60)),
            // A span that the user chose stays, and so does that of annotations that did not move.
            (&[1], span(31, 40), span(31, 40)),
            (&[2], span(50, 60), span(50, 60)),
            (&[], span(30, 40), span(30, 40)),
        ] {
            let mut shown = shown(annotations, before);
            shown.update_selected_annotations(Some(&moved), &undone);
            assert_eq!(shown.span, after, "{annotations:?} {before:?}");
        }
        // An annotation that is gone and comes back gets its selected span back.
        let mut shown = shown(&[1], span(30, 40));
        let without = snapshot(&[(2, 50, 60)]);
        shown.update_selected_annotations(Some(&moved), &without);
        shown.update_selected_annotations(Some(&without), &moved);
        assert_eq!((shown.span, shown.selected_annotation()), (span(30, 40), Some(1)));
    }
}
