//! The view of a pane, its requests, and the current display and selection.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_motion::{RecordingInstant, TimeSpan};

use crate::command::WindowCommand;
use crate::film::RecordingFilms;
use crate::keys::ActionKeys;
use crate::miniatures::MiniatureFigures;
use crate::model::CorpusSnapshot;
use crate::model::generated::GeneratedClip;
use crate::model::model_handle::{PlacementHandle, TravelCourse};
use crate::model::reel::MovementReel;
use crate::player::StagePlayer;
use crate::settings::StudioSettings;
use crate::theme::ThemeColours;
use crate::words::{InterfaceLanguage, InterfaceText};
use crate::work::desk::RunningWork;
use crate::work::{CorpusJob, WorkId, WorkProgress};

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
        .reduce(|a, b| {
            TimeSpan::span_between(
                a.span_start_instant().min(b.span_start_instant()),
                a.span_end_instant().max(b.span_end_instant()),
            )
        })
}

/// The read-only input of a pane while it draws.
#[derive(Clone, Copy)]
pub(crate) struct PaneInput<'a> {
    /// The file of the corpus.
    pub(crate) path: &'a Path,
    pub(crate) snapshot: &'a CorpusSnapshot,
    pub(crate) shown: &'a DisplayState,
    pub(crate) reel: &'a MovementReel,
    /// Looping little figures of any movement.
    pub(crate) little: &'a MiniatureFigures,
    /// Films of the recording.
    pub(crate) films: &'a RecordingFilms,
    pub(crate) keys: &'a ActionKeys,
    pub(crate) settings: &'a StudioSettings,
    pub(crate) language: InterfaceLanguage,
    pub(crate) dark: bool,
    /// Work that has been started and has not ended.
    pub(crate) running: &'a BTreeMap<WorkId, RunningWork>,
}

impl PaneInput<'_> {
    /// Returns a text in the window's language.
    pub(crate) fn say_text(&self, text: InterfaceText) -> &'static str {
        text.text_in_language(self.language)
    }

    pub(crate) fn pane_colours(&self) -> &'static ThemeColours {
        ThemeColours::colours_for_theme(self.dark)
    }

    /// Returns the path of a file of that name beside the corpus.
    pub(crate) fn path_beside_corpus(&self, name: &str) -> PathBuf {
        self.path.with_file_name(name)
    }

    /// Returns the progress of a running piece of work.
    pub(crate) fn work_progress(&self, work: WorkId) -> Option<&WorkProgress> {
        self.running.get(&work).map(|task| &task.far)
    }

    pub(crate) fn is_running(&self, work: Option<WorkId>) -> bool {
        work.is_some_and(|id| self.running.contains_key(&id))
    }
}

/// The requests of a frame; carried out after it, in order.
#[derive(Debug, Default)]
pub(crate) struct CommandOutbox {
    commands: Vec<WindowCommand>,
    next: u64,
}

impl CommandOutbox {
    /// Returns an empty outbox that continues the work numbers of `other`.
    pub(crate) fn after_outbox(other: &Self) -> Self {
        Self {
            commands: Vec::new(),
            next: other.next,
        }
    }

    pub(crate) fn send_command(&mut self, command: WindowCommand) {
        self.commands.push(command);
    }

    /// Requests a job, and returns the id that its outcome carries.
    pub(crate) fn request_work(&mut self, job: CorpusJob) -> WorkId {
        self.next += 1;
        let id = WorkId(self.next);
        self.commands.push(WindowCommand::Work(id, job));
        id
    }

    /// Moves the playhead.
    pub(crate) fn send_seek(&mut self, at: RecordingInstant) {
        self.commands.push(WindowCommand::Seek(at));
    }

    pub(crate) fn take_commands(&mut self) -> Vec<WindowCommand> {
        std::mem::take(&mut self.commands)
    }
}

#[cfg(test)]
mod tests {
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
