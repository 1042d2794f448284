//! Opens and closes corpora, and takes each newer snapshot of the open one.

use std::path::Path;
use std::sync::Arc;

use chereme_motion::{RecordingInstant, TimeSpan};

use super::Studio;
use crate::command::{CommandOutbox, WindowCommand};
use crate::film::RecordingFilms;
use crate::layout::PaneKind;
use crate::miniatures::MiniatureFigures;
use crate::model::CorpusSnapshot;
use crate::model::display_state::DisplayState;
use crate::model::reel::MovementReel;
use crate::panes::history::history_data as history;
use crate::panes::timeline::draft_file::DraftFile;
use crate::player::OpeningPreview;
use crate::settings::{CorpusViewSettings, view_of};
use crate::words::{shell as words, timeline};
use crate::work::begin::CorpusOpening;
use crate::work::desk::CorpusDesk;

impl Studio {
    /// Opens the user's own starter corpus; generates it first if it is missing.
    pub(crate) fn open_starter(&mut self) {
        let language = self.settings.language;
        match &self.folders.data {
            Some(folder) => self
                .out
                .send_command(WindowCommand::Begin(CorpusOpening::Starter(folder.join("starter")))),
            None => self.overlays.notices.add_lasting_notice(
                words::STARTER_MISSING_PLACE.text_in_language(language),
                Some(words::STARTER_MISSING_REMEDY.text_in_language(language)),
            ),
        }
    }

    /// Shows the corpus at `path`.
    pub(crate) fn open_corpus_path(&mut self, path: &Path) {
        self.close_corpus();
        self.desk = Some(CorpusDesk::open_corpus_desk(path, &self.author, &self.wake));
        let absolute = std::path::absolute(path);
        let path = absolute.as_deref().unwrap_or(path);
        self.settings.record_opened_corpus(path);
        self.films = RecordingFilms::films_of_corpus(path);
        let view = view_of(path);
        let saved_view = self.settings.views.get(&view).cloned().unwrap_or_default();
        self.panes.timeline.remember_timeline_windows(&saved_view.windows);
        self.settings.timeline.folded = saved_view.folded;
        self.settings.timeline.hidden = saved_view.hidden;
        self.view = Some(view);
        self.drafts = DraftFile::for_corpus_path(&self.folders, path);
        if let Some(draft) = self.drafts.read_draft() {
            self.panes.timeline.restore_timeline_draft(draft);
            let words = timeline::DRAFT_BACK.text_in_language(self.settings.language);
            self.overlays.notices.add_hint(words);
        }
    }

    /// Stores the view of the corpus in the settings; stores the views of recordings only with `windows`, as they
    /// change all the time.
    pub(crate) fn keep_view(&mut self, windows: bool) {
        let Some(view) = &self.view else { return };
        if !self.settings.views.contains_key(view) {
            self.settings.views.insert(view.clone(), CorpusViewSettings::default());
        }
        let timeline = &self.settings.timeline;
        let Some(view) = self.settings.views.get_mut(view) else {
            return;
        };
        if (&view.folded, &view.hidden) != (&timeline.folded, &timeline.hidden) {
            (view.folded, view.hidden) = (timeline.folded.clone(), timeline.hidden.clone());
        }
        if windows {
            view.windows = self.panes.timeline.timeline_windows();
        }
    }

    /// Closes the corpus. Deletes the file of a corpus that was created for an import, if it received nothing.
    pub(crate) fn leave_corpus(&mut self) {
        let untouched = |snapshot: &CorpusSnapshot| snapshot.overview.operations.is_empty();
        let unused = self.snapshot.as_ref().is_some_and(untouched);
        let made = self.made_for.take().filter(|_| unused && !self.gone);
        self.desk = None;
        if let Some(path) = made.filter(|path| holds_nothing(path)) {
            self.settings.recent.retain(|recent_path| *recent_path != path);
            // If the file cannot be deleted, an empty corpus remains.
            drop(std::fs::remove_file(path));
        }
    }

    /// Closes the corpus, and forgets everything that belongs to it.
    pub(crate) fn close_corpus(&mut self) {
        self.keep_view(true);
        self.start.reset_start_page();
        self.view = None;
        self.leave_corpus();
        self.gone = false;
        self.overlays.notices.withdraw_offers();
        self.drafts = DraftFile::default();
        self.snapshot = None;
        self.shown = DisplayState::default();
        self.reel = MovementReel::default();
        self.little = MiniatureFigures::default();
        self.films = RecordingFilms::default();
        self.panes = crate::panes::PaneSet::default();
        self.overlays.tiers = Default::default();
        self.out = CommandOutbox::after_outbox(&self.out);
    }

    /// Installs a newer snapshot, and removes missing things from the selection.
    pub(crate) fn take_snapshot(&mut self, snapshot: CorpusSnapshot, own: bool) {
        let older = |earlier: &&CorpusSnapshot| earlier.overview.generation != snapshot.overview.generation;
        if let Some(before) = self.snapshot.as_ref().filter(older) {
            let operations = [&before.overview, &snapshot.overview].map(|overview| &overview.operations[..]);
            let language = self.settings.language;
            match history::newest_operation_news(operations, own, language) {
                Some(text) if own => self.overlays.notices.report_own_action(text),
                Some(text) => self.overlays.notices.add_warning(text),
                None if !own => {
                    let words = words::NOTICE_CHANGED_ELSEWHERE.text_in_language(language);
                    self.overlays.notices.add_warning(words);
                }
                None => {}
            }
        }
        if let Some(before) = &self.snapshot
            && !Arc::ptr_eq(&before.overview, &snapshot.overview)
        {
            self.little
                .forget_changed_movement(&before.overview, &snapshot.overview);
        }
        let glance = self.shown.recording.and_then(|id| snapshot.recording_glance(id));
        self.reel.load_recording_reel(glance);
        match glance {
            None => {
                let made = self.shown.made.take();
                self.shown = DisplayState {
                    made,
                    ..DisplayState::default()
                };
            }
            Some(glance) => {
                let movement_end = RecordingInstant::from_micros(glance.row.duration_us);
                let end = movement_end.max(self.films.last_film_end(glance.row.id));
                self.shown
                    .player
                    .fit_player_span(TimeSpan::span_between(RecordingInstant::RECORDING_START, end));
            }
        }
        if let Some(open) = &snapshot.open {
            let tiers = &open.contents.tiers;
            self.shown.tier = self.shown.tier.filter(|id| tiers.iter().any(|tier| tier.row.id == *id));
            self.shown
                .update_selected_annotations(self.snapshot.as_ref(), &snapshot);
        }
        let requested_id = self.panes.timeline.draft_recording_id();
        let wanted = requested_id.filter(|id| snapshot.recording_glance(*id).is_some());
        let first_recording = snapshot.overview.recordings.first().map(|glance| glance.row.id);
        let first = wanted.or(first_recording);
        if self.snapshot.is_none() && first.is_none() && snapshot.overview.signs.is_empty() {
            let words = words::EMPTY_CORPUS.text_in_language(self.settings.language);
            self.overlays.notices.add_hint(words);
            self.bring_pane_forward(PaneKind::Import);
        }
        if self.snapshot.is_none() && snapshot.is_read_only() {
            let words = words::READ_ONLY_OPENED.text_in_language(self.settings.language);
            self.overlays.notices.add_warning(words);
        }
        self.snapshot = Some(snapshot);
        if let (None, Some(first)) = (self.shown.recording, first) {
            // Generated movement stays on the stage while its sign is stored.
            let made = self.shown.made.take();
            let greeting = self.take_greeting_sign();
            self.show_recording_by_id(greeting.map_or(first, |place| place.0));
            if let Some((_, span)) = greeting {
                self.shown
                    .player
                    .set_opening_preview(OpeningPreview { span, loops: true });
            }
            self.shown.made = made;
        }
    }
}

/// Returns whether the corpus file itself has no operation in its history.
fn holds_nothing(path: &std::path::Path) -> bool {
    let overview =
        chereme_corpus::Corpus::open_corpus(path, "reader").and_then(|corpus| corpus.load_corpus_overview(1));
    overview.is_ok_and(|overview| overview.operations.is_empty() && overview.recordings.is_empty())
}
