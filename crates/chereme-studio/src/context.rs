//! The view of a pane, its requests, and the current display and selection.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_motion::{Instant, Span};

use crate::command::Command;
use crate::film::Films;
use crate::keys::Keys;
use crate::miniatures::Figures;
use crate::model::Snapshot;
use crate::model::generated::GeneratedClip;
use crate::model::handle::{Course, Handle};
use crate::model::reel::Reel;
use crate::player::Player;
use crate::settings::Settings;
use crate::theme::Colours;
use crate::words::{Language, Text};
use crate::work::desk::Running;
use crate::work::{Far, Job, WorkId};

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
    pub(crate) span: Option<Span>,
    /// The playhead and how it moves.
    pub(crate) player: Player,
    /// The placement value that was last clicked on a body.
    pub(crate) spot: Option<String>,
    /// The placement of the open recipe that can be dragged on the stage.
    pub(crate) handle: Option<Handle>,
    /// The path of the open recipe that can be pulled on the stage.
    pub(crate) course: Option<Box<Course>>,
    /// Generated movement, shown instead of the recording, with its own playhead.
    pub(crate) made: Option<Showing>,
}

/// Generated movement on the stage.
#[derive(Debug, Clone)]
pub(crate) struct Showing {
    pub(crate) made: Arc<GeneratedClip>,
    /// Its own playhead; its time starts at 0.
    pub(crate) player: Player,
}

impl DisplayState {
    /// Returns the player of the movement on the stage: that of generated movement if it is shown.
    pub(crate) fn on_stage(&self) -> &Player {
        self.made.as_ref().map_or(&self.player, |it| &it.player)
    }

    /// Returns the same player, to be changed.
    pub(crate) fn on_stage_mut(&mut self) -> &mut Player {
        match &mut self.made {
            Some(showing) => &mut showing.player,
            None => &mut self.player,
        }
    }

    /// Drops annotations that are gone from the selection, and selects again those that came back, for example after an
    /// undo. If the selected time was exactly that of the selected annotations in `before`, it follows their times.
    pub(crate) fn follow(&mut self, before: Option<&Snapshot>, snapshot: &Snapshot) {
        let was = before.and_then(|it| hull(it, &self.annotations));
        if was.is_some() && was == self.span {
            self.span = hull(snapshot, &self.annotations).or(self.span);
        }
        let there = |id: &i64| snapshot.annotation(*id).is_some();
        let before = std::mem::take(&mut self.annotations);
        let (kept, gone): (BTreeSet<i64>, BTreeSet<i64>) = before.into_iter().partition(there);
        self.annotations = kept;
        if !gone.is_empty() {
            self.lost = gone;
        } else if self.annotations.is_empty()
            && !self.lost.is_empty()
            && self.lost.iter().all(there)
        {
            self.annotations = std::mem::take(&mut self.lost);
        }
    }

    /// Returns the selected annotation, if exactly one is selected.
    pub(crate) fn annotation(&self) -> Option<i64> {
        (self.annotations.len() == 1)
            .then(|| self.annotations.first().copied())
            .flatten()
    }
}

/// Returns the span from the start of the first to the end of the last of the annotations that the snapshot holds.
fn hull(snapshot: &Snapshot, annotations: &BTreeSet<i64>) -> Option<Span> {
    let found = annotations.iter().filter_map(|id| snapshot.annotation(*id));
    found
        .map(|it| it.tier.annotations.span(it.at))
        .reduce(|a, b| Span::between(a.start().min(b.start()), a.end().max(b.end())))
}

/// The read-only input of a pane while it draws.
#[derive(Clone, Copy)]
pub(crate) struct PaneInput<'a> {
    /// The file of the corpus.
    pub(crate) path: &'a Path,
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) shown: &'a DisplayState,
    pub(crate) reel: &'a Reel,
    /// Looping little figures of any movement.
    pub(crate) little: &'a Figures,
    /// Films of the recording.
    pub(crate) films: &'a Films,
    pub(crate) keys: &'a Keys,
    pub(crate) settings: &'a Settings,
    pub(crate) language: Language,
    pub(crate) dark: bool,
    /// Work that has been started and has not ended.
    pub(crate) running: &'a BTreeMap<WorkId, Running>,
}

impl PaneInput<'_> {
    /// Returns a text in the window's language.
    pub(crate) fn say(&self, text: Text) -> &'static str {
        text.of(self.language)
    }

    pub(crate) fn colours(&self) -> &'static Colours {
        Colours::of(self.dark)
    }

    /// Returns the path of a file of that name beside the corpus.
    pub(crate) fn beside(&self, name: &str) -> PathBuf {
        self.path.with_file_name(name)
    }

    /// Returns the progress of a running piece of work.
    pub(crate) fn far(&self, work: WorkId) -> Option<&Far> {
        self.running.get(&work).map(|it| &it.far)
    }

    pub(crate) fn is_running(&self, work: Option<WorkId>) -> bool {
        work.is_some_and(|id| self.running.contains_key(&id))
    }
}

/// The requests of a frame; carried out after it, in order.
#[derive(Debug, Default)]
pub(crate) struct Outbox {
    commands: Vec<Command>,
    next: u64,
}

impl Outbox {
    /// Returns an empty outbox that continues the work numbers of `other`.
    pub(crate) fn after(other: &Self) -> Self {
        Self {
            commands: Vec::new(),
            next: other.next,
        }
    }

    pub(crate) fn send(&mut self, command: Command) {
        self.commands.push(command);
    }

    /// Requests a job, and returns the id that its outcome carries.
    pub(crate) fn work(&mut self, job: Job) -> WorkId {
        self.next += 1;
        let id = WorkId(self.next);
        self.commands.push(Command::Work(id, job));
        id
    }

    /// Moves the playhead.
    pub(crate) fn seek(&mut self, at: Instant) {
        self.commands.push(Command::Seek(at));
    }

    pub(crate) fn take(&mut self) -> Vec<Command> {
        std::mem::take(&mut self.commands)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Opened;
    use crate::panes::timeline::contents_of;

    fn snapshot(spans: &[(i64, i64, i64)]) -> Snapshot {
        Snapshot {
            open: Some(Arc::new(Opened::new(contents_of(spans)))),
            ..Snapshot::default()
        }
    }

    fn span(start: i64, end: i64) -> Option<Span> {
        let micros = Instant::from_micros;
        Some(Span::between(micros(start), micros(end)))
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
            shown.follow(Some(&moved), &undone);
            assert_eq!(shown.span, after, "{annotations:?} {before:?}");
        }
        // An annotation that is gone and comes back gets its selected span back.
        let mut shown = shown(&[1], span(30, 40));
        let without = snapshot(&[(2, 50, 60)]);
        shown.follow(Some(&moved), &without);
        shown.follow(Some(&without), &moved);
        assert_eq!((shown.span, shown.annotation()), (span(30, 40), Some(1)));
    }
}
