//! Opens and closes corpora, and takes each newer snapshot of the open one.

use std::path::Path;
use std::sync::Arc;

use chereme_motion::{Instant, Span};

use crate::app::Studio;
use crate::command::Command;
use crate::context::{DisplayState, Outbox};
use crate::draft::Drafts;
use crate::film::Films;
use crate::miniatures::Figures;
use crate::model::Snapshot;
use crate::model::reel::Reel;
use crate::panes::PaneKind;
use crate::panes::history::data as history;
use crate::player::Preview;
use crate::settings::{View, view_of};
use crate::words::{shell as words, timeline};
use crate::work::begin::Begin;
use crate::work::desk::Desk;

impl Studio {
    /// Opens the user's own starter corpus; generates it first if it is missing.
    pub(crate) fn open_starter(&mut self) {
        let language = self.settings.language;
        match &self.folders.data {
            Some(folder) => self
                .out
                .send(Command::Begin(Begin::Starter(folder.join("starter")))),
            None => self.overlays.notices.say(
                words::STARTER_MISSING_PLACE.of(language),
                Some(words::STARTER_MISSING_REMEDY.of(language)),
            ),
        }
    }

    /// Shows the corpus at `path`.
    pub(crate) fn open(&mut self, path: &Path) {
        self.close();
        self.desk = Some(Desk::open(path, &self.author, &self.wake));
        let absolute = std::path::absolute(path);
        let path = absolute.as_deref().unwrap_or(path);
        self.settings.opened(path);
        self.films = Films::of(path);
        let view = view_of(path);
        let known = self.settings.views.get(&view).cloned().unwrap_or_default();
        self.panes.timeline.remember(&known.windows);
        self.settings.timeline.folded = known.folded;
        self.settings.timeline.hidden = known.hidden;
        self.view = Some(view);
        self.drafts = Drafts::of(&self.folders, path);
        if let Some(draft) = self.drafts.read() {
            self.panes.timeline.restore(draft);
            let words = timeline::DRAFT_BACK.of(self.settings.language);
            self.overlays.notices.hint(words);
        }
    }

    /// Stores the view of the corpus in the settings; stores the views of recordings only with `windows`, as they
    /// change all the time.
    pub(crate) fn keep_view(&mut self, windows: bool) {
        let Some(view) = &self.view else { return };
        if !self.settings.views.contains_key(view) {
            self.settings.views.insert(view.clone(), View::default());
        }
        let timeline = &self.settings.timeline;
        let Some(view) = self.settings.views.get_mut(view) else {
            return;
        };
        if (&view.folded, &view.hidden) != (&timeline.folded, &timeline.hidden) {
            (view.folded, view.hidden) = (timeline.folded.clone(), timeline.hidden.clone());
        }
        if windows {
            view.windows = self.panes.timeline.windows();
        }
    }

    /// Closes the corpus. Deletes the file of a corpus that was created for an import, if it received nothing.
    pub(crate) fn leave(&mut self) {
        let untouched = |it: &Snapshot| it.overview.operations.is_empty();
        let unused = self.snapshot.as_ref().is_some_and(untouched);
        let made = self.made_for.take().filter(|_| unused && !self.gone);
        self.desk = None;
        if let Some(path) = made.filter(|path| holds_nothing(path)) {
            self.settings.recent.retain(|it| *it != path);
            // If the file cannot be deleted, an empty corpus remains.
            drop(std::fs::remove_file(path));
        }
    }

    /// Closes the corpus, and forgets everything that belongs to it.
    pub(crate) fn close(&mut self) {
        self.keep_view(true);
        self.start.leave();
        self.view = None;
        self.leave();
        self.gone = false;
        self.overlays.notices.withdraw();
        self.drafts = Drafts::default();
        self.snapshot = None;
        self.shown = DisplayState::default();
        self.reel = Reel::default();
        self.little = Figures::default();
        self.films = Films::default();
        self.panes = crate::panes::Panes::default();
        self.out = Outbox::after(&self.out);
    }

    /// Installs a newer snapshot, and removes missing things from the selection.
    pub(crate) fn take_snapshot(&mut self, snapshot: Snapshot, own: bool) {
        let older = |it: &&Snapshot| it.overview.generation != snapshot.overview.generation;
        if let Some(before) = self.snapshot.as_ref().filter(older) {
            let operations = [&before.overview, &snapshot.overview].map(|it| &it.operations[..]);
            let language = self.settings.language;
            match history::news(operations, own, language) {
                Some(text) if own => self.overlays.notices.did(text),
                Some(text) => self.overlays.notices.warn(text),
                None if !own => {
                    let words = words::NOTICE_CHANGED_ELSEWHERE.of(language);
                    self.overlays.notices.warn(words);
                }
                None => {}
            }
        }
        if let Some(before) = &self.snapshot
            && !Arc::ptr_eq(&before.overview, &snapshot.overview)
        {
            self.little.follow(&before.overview, &snapshot.overview);
        }
        let glance = self.shown.recording.and_then(|id| snapshot.recording(id));
        self.reel.load(glance);
        match glance {
            None => {
                let made = self.shown.made.take();
                self.shown = DisplayState {
                    made,
                    ..DisplayState::default()
                };
            }
            Some(glance) => {
                let end = Instant::from_micros(glance.row.duration_us);
                let end = end.max(self.films.end(glance.row.id));
                self.shown.player.fit(Span::between(Instant::ZERO, end));
            }
        }
        if let Some(open) = &snapshot.open {
            let tiers = &open.contents.tiers;
            self.shown.tier = self
                .shown
                .tier
                .filter(|id| tiers.iter().any(|it| it.row.id == *id));
            self.shown.follow(self.snapshot.as_ref(), &snapshot);
        }
        let wanted = self.panes.timeline.wants();
        let wanted = wanted.filter(|id| snapshot.recording(*id).is_some());
        let first = snapshot.overview.recordings.first().map(|it| it.row.id);
        let first = wanted.or(first);
        if self.snapshot.is_none() && first.is_none() && snapshot.overview.signs.is_empty() {
            let words = words::EMPTY_CORPUS.of(self.settings.language);
            self.overlays.notices.hint(words);
            self.bring(PaneKind::Import);
        }
        if self.snapshot.is_none() && snapshot.is_read_only() {
            let words = words::READ_ONLY_OPENED.of(self.settings.language);
            self.overlays.notices.warn(words);
        }
        self.snapshot = Some(snapshot);
        if let (None, Some(first)) = (self.shown.recording, first) {
            // Generated movement stays on the stage while its sign is stored.
            let made = self.shown.made.take();
            let greeting = self.greeting();
            self.turn_to(greeting.map_or(first, |it| it.0));
            if let Some((_, span)) = greeting {
                self.shown.player.preview(Preview { span, loops: true });
            }
            self.shown.made = made;
        }
    }
}

/// Returns whether the corpus file itself has no operation in its history.
fn holds_nothing(path: &std::path::Path) -> bool {
    let overview = chereme_corpus::Corpus::open(path, "reader").and_then(|it| it.overview(1));
    overview.is_ok_and(|it| it.operations.is_empty() && it.recordings.is_empty())
}
