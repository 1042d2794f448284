//! The window: one frame after the other.

mod app_overlays;
mod dispatch;
mod key_queue;
mod menu_and_status;
mod missing_file;
mod opening;
mod share;
mod start_page;

use crate::app::key_queue::KeyQueue;
use crate::app::menu_and_status::MenuWalk;
use crate::app::start_page::StartPage;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use chereme_motion::RecordingInstant;
use eframe::egui::{self, CentralPanel, Context, Frame, Panel, Ui, ViewportCommand};
use egui_tiles::Tree;

use crate::action::Action;
use crate::clipboard::WindowClipboard;
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::file_dialogs::{ChooserResult, FileChooser};
use crate::film::RecordingFilms;
use crate::keys::ActionKeys;
use crate::layout::PaneKind;
use crate::miniatures::MiniatureFigures;
use crate::model::CorpusSnapshot;
use crate::model::display_state::DisplayState;
use crate::model::reel::MovementReel;
use crate::overlay::WindowOverlays;
use crate::panes::PaneSet;
use crate::panes::carry::{self, TabSpring};
use crate::panes::timeline::draft_file::DraftFile;
use crate::script::script_fonts::UnreportedScripts;
use crate::settings::{StudioFolders, StudioSettings};
use crate::words::InterfaceText;
use crate::work::begin::{CorpusOpening, OpeningInProgress};
use crate::work::desk::{CorpusDesk, DeskNews, WindowWaker};
use crate::work::{WorkLane, WorkOutcome, movement_jobs};
use crate::workbench::TileWorkbench;
use crate::{StudioOptions, layout, script, theme};

/// The window's whole state; [`ui`](Self::ui) is one frame of it.
pub struct Studio {
    pub(crate) author: String,
    pub(crate) folders: StudioFolders,
    pub(crate) settings: StudioSettings,
    /// The settings as they are in the file.
    pub(crate) saved: StudioSettings,
    pub(crate) keys: ActionKeys,
    /// Keys that were pressed and not handed out yet.
    pub(crate) waiting: KeyQueue,
    pub(crate) desk: Option<CorpusDesk>,
    pub(crate) beginning: Option<OpeningInProgress>,
    /// The file of the open corpus, if it was created only to receive imported files.
    pub(crate) made_for: Option<PathBuf>,
    /// The gloss to show first in the starter corpus; empty for any.
    pub(crate) greets: Option<String>,
    /// Whether the layout gives the import pane most of the window, for files named at the opening; until they are
    /// imported.
    looking: bool,
    /// Whether the file of the open corpus is missing from its place.
    pub(crate) gone: bool,
    /// Whether the window was to be closed while the file of the corpus is missing.
    pub(crate) close_asked: bool,
    /// `None` before the corpus is first read.
    pub(crate) snapshot: Option<CorpusSnapshot>,
    pub(crate) shown: DisplayState,
    pub(crate) reel: MovementReel,
    pub(crate) little: MiniatureFigures,
    pub(crate) films: RecordingFilms,
    pub(crate) tree: Tree<PaneKind>,
    /// Whether the layout is that of a small window.
    pub(crate) small: bool,
    pub(crate) panes: PaneSet,
    /// The pane that was used last; it has the focus while it is in sight.
    pub(crate) pane: Option<PaneKind>,
    /// The text field that has the cursor, and its pane.
    cursor: Option<(PaneKind, egui::Id)>,
    sprung: TabSpring,
    pub(crate) start: StartPage,
    pub(crate) chooser: FileChooser,
    unreported: UnreportedScripts,
    pub(crate) clipboard: WindowClipboard,
    pub(crate) overlays: WindowOverlays,
    walk: MenuWalk,
    pub(crate) out: CommandOutbox,
    pub(crate) drafts: DraftFile,
    /// Key under which the view of the open corpus is stored in the settings.
    pub(crate) view: Option<String>,
    pub(crate) wake: WindowWaker,
    ctx: Arc<OnceLock<Context>>,
    /// The title of the window.
    title: String,
    /// Time of the last frame, in seconds of the window's clock.
    clock: Option<f64>,
}

impl Studio {
    /// Returns the state of the window before its first frame.
    #[must_use]
    pub fn new(options: StudioOptions) -> Self {
        let StudioOptions {
            corpus,
            author,
            folders,
            language,
            asked_language,
        } = options;
        let usual = StudioSettings {
            language,
            ..StudioSettings::default()
        };
        let file = folders.settings_file();
        let mut settings = file
            .as_deref()
            .and_then(StudioSettings::read_settings_file)
            .unwrap_or(usual);
        // A language for this run is not kept; the file keeps the one of the settings.
        let saved = settings.clone();
        settings.language = asked_language.unwrap_or(settings.language);
        let ctx: Arc<OnceLock<Context>> = Arc::default();
        let waked = ctx.clone();
        // Workers exist before the first frame, which brings the context that they wake.
        let wake: WindowWaker = Arc::new(move || {
            if let Some(ctx) = waked.get() {
                ctx.request_repaint();
            }
        });
        let out = CommandOutbox::default();
        if let Some(path) = corpus {
            out.send_command(WindowCommand::Begin(CorpusOpening::Open(path)));
        }
        Self {
            author,
            folders,
            keys: ActionKeys::new(settings.keymap, &settings.keys, settings.language),
            waiting: KeyQueue::default(),
            tree: layout::remembered_layout(settings.layout.as_ref(), settings.busy, false),
            small: false,
            saved,
            settings,
            desk: None,
            beginning: None,
            made_for: None,
            greets: None,
            looking: false,
            gone: false,
            close_asked: false,
            snapshot: None,
            shown: DisplayState::default(),
            reel: MovementReel::default(),
            little: MiniatureFigures::default(),
            films: RecordingFilms::default(),
            panes: PaneSet::default(),
            pane: None,
            cursor: None,
            sprung: TabSpring::default(),
            start: StartPage::default(),
            chooser: FileChooser::default(),
            unreported: UnreportedScripts::default(),
            clipboard: WindowClipboard::default(),
            overlays: WindowOverlays::default(),
            walk: MenuWalk::default(),
            out,
            drafts: DraftFile::default(),
            view: None,
            wake,
            ctx,
            title: String::new(),
            clock: None,
        }
    }

    /// Draws one frame, collects the commands given in it, and carries them out.
    pub fn ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        if self.ctx.set(ctx.clone()).is_ok() {
            theme::install_studio_theme(&ctx);
            script::install_script_support(&ctx);
        }
        theme::apply_theme_settings(&ctx, &self.settings);
        self.fit_layout_to_window(ctx.content_rect().size());
        self.receive_thread_results();
        self.stay_with_the_corpus(&ctx);
        self.name_window(&ctx);
        self.panes.search.show_animated_hit(&self.out);
        self.panes.library.show_chosen_notated_sign(&self.out);
        self.panes.map.show_animated_map_sign(&self.out);
        self.panes.measures.show_animated_measured_sign(&self.out);
        if self.panes.recombine.has_news() {
            // The pictures requested in this frame must show the new movement.
            self.keep_up(&ctx);
            self.carry_out_commands(&ctx);
        }
        self.hear_chooser(&ctx);
        self.tick(&ctx);
        if let Some((action, text)) = self.clipboard.take_awaited_paste(&ctx) {
            self.paste_text(action, text, &ctx);
            self.carry_out_commands(&ctx);
        }
        self.take_keys(&ctx);
        self.panes.timeline.next_frame();
        self.take_dropped(&ctx);
        // The pane with the handle must be drawn to answer a drag.
        if self.shown.handle.is_some() && !layout::is_pane_in_sight(&self.tree, PaneKind::Recombine) {
            self.shown.handle = None;
        }
        if let Some((text, remedy)) = self.unreported.take_missing_font_notice(self.settings.language) {
            self.overlays.notices.add_lasting_notice(&text, Some(remedy));
        }
        self.show_bars(ui);
        if self.desk.is_some() {
            self.workbench(ui);
        } else {
            CentralPanel::default().show(ui, |ui| self.start_page(ui));
        }
        self.draw_open_overlays(&ctx);
        self.carry_out_commands(&ctx);
        self.save_drafts_and_settings(&ctx);
    }

    /// Returns the playhead.
    #[must_use]
    pub fn playhead_instant(&self) -> RecordingInstant {
        self.shown.player.player_playhead()
    }

    /// Returns how long the latest pictures of the stage took to draw, on their own thread.
    #[must_use]
    pub fn drawing_time(&self) -> Duration {
        self.panes.stage.drawing_time()
    }

    /// Returns whether the stage shows the latest requested pictures.
    #[must_use]
    pub fn is_drawn(&self) -> bool {
        self.panes.stage.is_drawn()
    }

    /// Returns whether every film shows the latest requested frame.
    #[must_use]
    pub fn is_filmed(&self) -> bool {
        self.films.are_pictured()
    }

    /// Returns the name of the movement on the stage, a recipe or a gloss, if the movement comes from a recipe.
    #[must_use]
    pub fn staged_movement_name(&self) -> Option<&str> {
        let showing = self.shown.made.as_ref()?;
        let there = self.panes.stage.is_clip_on_stage(&showing.made);
        there.then_some(showing.made.name.as_str())
    }

    /// Returns the file of the open corpus.
    #[must_use]
    pub fn shown_corpus_path(&self) -> Option<&PathBuf> {
        self.desk.as_ref().map(|desk| &desk.path)
    }

    /// Returns the [`generation`](chereme_corpus::Corpus::corpus_generation) of the corpus that the window shows.
    #[must_use]
    pub fn shown_generation(&self) -> Option<i64> {
        Some(self.snapshot.as_ref()?.overview.generation)
    }

    /// Returns whether the window is idle: no work runs, no corpus is being opened, and the open corpus is read.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        let working = self.desk.as_ref().is_some_and(|desk| !desk.running.is_empty());
        self.beginning.is_none()
            && !self.chooser.is_chooser_open()
            && !self.clipboard.is_waiting()
            && self.waiting.next_event().is_none()
            && !working
            && self.desk.is_some() == self.snapshot.is_some()
    }

    /// Returns the view that panes draw from; `None` without a snapshot.
    pub(crate) fn pane_input(&self, ctx: &Context) -> Option<PaneInput<'_>> {
        Some(PaneInput {
            path: &self.desk.as_ref()?.path,
            snapshot: self.snapshot.as_ref()?,
            shown: &self.shown,
            reel: &self.reel,
            little: &self.little,
            films: &self.films,
            keys: &self.keys,
            settings: &self.settings,
            language: self.settings.language,
            dark: theme::is_dark(ctx),
            running: &self.desk.as_ref()?.running,
            out: &self.out,
        })
    }

    /// Receives the results of the threads.
    fn receive_thread_results(&mut self) {
        let ended = self
            .beginning
            .as_mut()
            .and_then(OpeningInProgress::finished_opening_path);
        if let Some(ended) = ended {
            let begun = self.beginning.take();
            let (look, made) = begun.map(|work| (work.look, work.made)).unwrap_or_default();
            let task = crate::words::shell::TASK_OPENING;
            match ended {
                Ok(path) => {
                    self.open_corpus_path(&path);
                    self.made_for = made;
                    if !look.is_empty() {
                        // Nothing else in the corpus can be shown yet.
                        self.looking = true;
                        self.out.send_command(WindowCommand::Do(Action::LayoutSearch));
                        self.out.send_command(WindowCommand::Import(look));
                    }
                }
                Err(error) => self
                    .overlays
                    .notices
                    .report_work_failure(&error, Some(task), self.settings.language),
            }
        }
        let news = self.desk.as_mut().map(CorpusDesk::take_desk_news).unwrap_or_default();
        for news in news {
            match news {
                DeskNews::Read(snapshot, own) => self.take_snapshot(snapshot, own),
                DeskNews::Unread(error) => {
                    self.overlays
                        .notices
                        .report_work_failure(&error, None, self.settings.language)
                }
                DeskNews::Stands(stands) => self.report_corpus_file_standing(stands),
                DeskNews::Copied(saved) => self.continue_in_saved_copy(saved),
                DeskNews::Far(..) => {}
                DeskNews::Ended(id, ended, about) => {
                    if self.little.handle_miniature_result(id, &ended) {
                        continue;
                    }
                    if ended.is_err() && self.panes.timeline.awaits_change(id) {
                        self.forget_keys();
                    }
                    self.panes.forward_work_result(id, &ended);
                    self.overlays.export.handle_export_result(id, &ended);
                    self.overlays.tiers.handle_tier_round_result(id, &ended);
                    if let Ok(WorkOutcome::Imported(report)) = &ended
                        && !report.dry_run
                        && std::mem::take(&mut self.looking)
                    {
                        self.out.send_command(WindowCommand::Do(Action::LayoutAnnotate));
                    }
                    if !(about.quiet && ended.is_err()) {
                        self.handle_work_outcome(ended, about.task);
                    }
                }
            }
        }
    }

    /// Handles the result of an open file chooser.
    fn hear_chooser(&mut self, ctx: &Context) {
        let now = ctx.input(|input| input.time);
        match self.chooser.take_chooser_result(&self.wake, now) {
            Some(ChooserResult::Command(command)) => self.out.send_command(command),
            Some(ChooserResult::NoChooser(what)) => {
                let corpus = self.shown_corpus_path().cloned();
                self.overlays.typed_path.ask_for_path(what, corpus.as_deref());
            }
            Some(ChooserResult::Nothing) | None => {}
        }
    }

    /// Moves the playhead with the clock, and loads movement at its new place.
    fn tick(&mut self, ctx: &Context) {
        let now = ctx.input(|input| input.time);
        let passed = self.clock.map_or(0.0, |clock| now - clock);
        self.clock = Some(now);
        let player = self.shown.on_stage_mut();
        if player.is_playing() {
            // A window that was hidden for a while continues at its old moment.
            player.advance_playhead(passed.min(0.5));
            ctx.request_repaint();
        }
        self.follow_films(ctx);
        let player = &self.shown.player;
        let (at, direction) = (player.player_playhead(), player.playback_direction());
        let loading = self.desk.as_ref().map_or(0, |desk| {
            let lanes = desk.running.values().map(|work| work.about.lane);
            lanes.filter(|lane| *lane == WorkLane::Movement).count()
        });
        // While the user drags over hours of movement, passed pieces are not loaded.
        if loading < 2
            && let Some((recording, piece, span)) = self.reel.next_wanted_piece(at, direction)
        {
            self.out
                .request_work(movement_jobs::load_movement_job(recording, piece, span));
        }
    }

    fn take_dropped(&mut self, ctx: &Context) {
        let dropped: Vec<PathBuf> = ctx.input(|input| {
            let files = input.raw.dropped_files.iter();
            files.map(|file| file.path().to_owned()).collect()
        });
        let one = match dropped.as_slice() {
            [] => return,
            [one] => Some(one.clone()),
            _ => None,
        };
        if self.desk.is_some()
            && layout::is_pane_in_sight(&self.tree, PaneKind::Studies)
            && self.panes.studies.drop_files(&dropped)
        {
            return;
        }
        let corpus = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "chereme");
        self.out.send_command(match one {
            Some(path) if corpus(&path) => WindowCommand::Begin(CorpusOpening::Open(path)),
            Some(path) if self.desk.is_none() && path.is_dir() => WindowCommand::Begin(CorpusOpening::Folder(path)),
            _ if self.desk.is_none() => WindowCommand::Begin(CorpusOpening::Files(dropped)),
            _ => WindowCommand::Import(dropped),
        });
    }

    fn workbench(&mut self, ui: &mut Ui) {
        CentralPanel::default().frame(Frame::new()).show(ui, |ui| {
            let Self {
                tree,
                panes,
                snapshot,
                shown,
                reel,
                little,
                films,
                keys,
                settings,
                desk,
                out,
                pane,
                cursor,
                sprung,
                ..
            } = self;
            let (Some(snapshot), Some(desk)) = (snapshot.as_ref(), desk.as_ref()) else {
                let words = crate::words::shell::READING.text_in_language(settings.language);
                ui.centered_and_justified(|ui| ui.label(words));
                return;
            };
            let seen = PaneInput {
                path: &desk.path,
                snapshot,
                shown,
                reel,
                little,
                films,
                keys,
                settings,
                language: settings.language,
                dark: theme::is_dark(ui.ctx()),
                running: &desk.running,
                out,
            };
            let mut workbench = TileWorkbench {
                panes,
                seen,
                pane,
                cursor,
                under: None,
                chosen: None,
            };
            tree.ui(&mut workbench, ui);
            layout::settle_pane_shares(tree);
            // A tile is made active only when the tree is no longer being drawn.
            let (under, chosen) = (workbench.under, workbench.chosen);
            if let Some(tile) = chosen {
                tree.make_active(|id, _| id == tile);
            }
            carry::show_carried_sign(ui.ctx(), &seen);
            if let Some(pane) = sprung.pane_to_open(under, ui.input(|input| input.time)) {
                layout::bring_pane_to_front(tree, pane);
            }
        });
    }

    fn show_bars(&mut self, ui: &mut Ui) {
        Panel::top("menus").show(ui, |ui| self.show_menu_bar(ui));
        Panel::bottom("status").show(ui, |ui| self.show_status_line(ui));
    }

    /// Writes unfinished text at once, and changed settings once no pointer button is down.
    fn save_drafts_and_settings(&mut self, ctx: &Context) {
        if self.desk.is_some()
            && let Err(error) = self.drafts.keep_draft(self.panes.timeline.timeline_draft())
        {
            self.overlays
                .notices
                .report_unsaved_settings(&error, self.settings.language);
        }
        if self.desk.is_some() && !self.is_remembered() {
            *self.laid_out() = Some(self.tree.clone());
        }
        self.keep_view(false);
        let settled = !ctx.input(|input| input.pointer.any_down());
        if self.settings == self.saved || !settled {
            return;
        }
        self.saved = self.settings.clone();
        let written = self
            .folders
            .settings_file()
            .map(|file| self.settings.write_settings_file(&file));
        if let Some(Err(error)) = written {
            self.overlays
                .notices
                .report_unsaved_settings(&error, self.settings.language);
        }
    }

    /// Names the window after the open corpus, so that two windows can be distinguished.
    fn name_window(&mut self, ctx: &Context) {
        let title = self.window_title();
        if title != self.title {
            self.title.clone_from(&title);
            ctx.send_viewport_cmd(ViewportCommand::Title(title));
        }
    }

    fn is_remembered(&self) -> bool {
        let layout = if self.small {
            &self.settings.small_layout
        } else {
            &self.settings.layout
        };
        layout.as_ref() == Some(&self.tree)
    }

    /// Returns the settings entry that stores the present layout: that of small windows, or that of large ones.
    fn laid_out(&mut self) -> &mut Option<Tree<PaneKind>> {
        if self.small {
            &mut self.settings.small_layout
        } else {
            &mut self.settings.layout
        }
    }

    /// Switches between the layouts of small and large windows if the window's size calls for it; the pane in use stays
    /// in sight.
    fn fit_layout_to_window(&mut self, size: egui::Vec2) {
        let small = layout::is_small(size);
        if small == self.small {
            return;
        }
        self.small = small;
        let busy = self.settings.busy;
        self.tree = layout::remembered_layout(self.laid_out().as_ref(), busy, small);
        self.panes.timeline.show_tier();
        if let Some(pane) = self.pane {
            layout::bring_pane_to_front(&mut self.tree, pane);
        }
    }

    fn handle_work_outcome(&mut self, ended: Result<WorkOutcome, chereme_corpus::CorpusError>, task: InterfaceText) {
        let language = self.settings.language;
        match ended {
            Err(error) => self.overlays.notices.report_work_failure(&error, Some(task), language),
            Ok(WorkOutcome::Moved {
                recording,
                piece,
                moving,
            }) => self.reel.put_loaded_piece(recording, piece, moving),
            Ok(outcome) => self.overlays.notices.report_work_outcome(&outcome, language),
        }
    }
}

impl Drop for Studio {
    /// Writes the zoom of the timelines when the window closes.
    fn drop(&mut self) {
        self.keep_view(true);
        self.leave_corpus();
        if self.settings != self.saved
            && let Some(file) = self.folders.settings_file()
        {
            drop(self.settings.write_settings_file(&file));
        }
    }
}

impl eframe::App for Studio {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        Self::ui(self, ui);
    }

    /// Returns the background of all panes, which then draw none of their own: in windows drawn by software, each layer
    /// that fills the window takes milliseconds of every frame.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}
