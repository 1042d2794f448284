//! The window: one frame after the other.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use chereme_motion::Instant;
use eframe::egui::{self, CentralPanel, Context, Frame, Panel, Ui, ViewportCommand};
use egui_tiles::Tree;

use crate::Options;
use crate::action::Action;
use crate::clipboard::Clipboard;
use crate::command::Command;
use crate::context::{DisplayState, Outbox, PaneInput};
use crate::draft::Drafts;
use crate::file_dialogs::{Chooser, Chosen};
use crate::film::Films;
use crate::keys::Keys;
use crate::keys::queue::KeyQueue;
use crate::miniatures::Figures;
use crate::model::Snapshot;
use crate::model::reel::Reel;
use crate::overlay::Overlays;
use crate::panes::carry::{self, Sprung};
use crate::panes::{PaneKind, Panes};
use crate::script::fonts::Unreported;
use crate::settings::{Folders, Settings};
use crate::start::Start;
use crate::words::Text;
use crate::work::begin::{Begin, Beginning};
use crate::work::desk::{Desk, News, Wake};
use crate::work::{Lane, Outcome, movement};
use crate::workbench::Workbench;
use crate::{layout, theme};

/// The window's whole state; [`ui`](Self::ui) is one frame of it.
pub struct Studio {
    pub(crate) author: String,
    pub(crate) folders: Folders,
    pub(crate) settings: Settings,
    /// The settings as they are in the file.
    pub(crate) saved: Settings,
    pub(crate) keys: Keys,
    /// Keys that were pressed and not handed out yet.
    pub(crate) waiting: KeyQueue,
    pub(crate) desk: Option<Desk>,
    pub(crate) beginning: Option<Beginning>,
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
    pub(crate) snapshot: Option<Snapshot>,
    pub(crate) shown: DisplayState,
    pub(crate) reel: Reel,
    pub(crate) little: Figures,
    pub(crate) films: Films,
    pub(crate) tree: Tree<PaneKind>,
    /// Whether the layout is that of a small window.
    pub(crate) small: bool,
    pub(crate) panes: Panes,
    /// The pane that was used last; it has the focus while it is in sight.
    pub(crate) pane: Option<PaneKind>,
    /// The text field that has the cursor, and its pane.
    cursor: Option<(PaneKind, egui::Id)>,
    sprung: Sprung,
    pub(crate) start: Start,
    pub(crate) chooser: Chooser,
    unreported: Unreported,
    pub(crate) clipboard: Clipboard,
    pub(crate) overlays: Overlays,
    pub(crate) walk: crate::menu_and_status::Walk,
    pub(crate) out: Outbox,
    pub(crate) drafts: Drafts,
    /// Key under which the view of the open corpus is stored in the settings.
    pub(crate) view: Option<String>,
    pub(crate) wake: Wake,
    ctx: Arc<OnceLock<Context>>,
    /// The title of the window.
    title: String,
    /// Time of the last frame, in seconds of the window's clock.
    clock: Option<f64>,
}

impl Studio {
    /// Returns the state of the window before its first frame.
    #[must_use]
    pub fn new(options: Options) -> Self {
        let Options {
            corpus,
            author,
            folders,
            language,
            asked_language,
        } = options;
        let usual = Settings {
            language,
            ..Settings::default()
        };
        let file = folders.settings_file();
        let mut settings = file.as_deref().and_then(Settings::read).unwrap_or(usual);
        let saved = settings.clone();
        settings.language = asked_language.unwrap_or(settings.language);
        let ctx: Arc<OnceLock<Context>> = Arc::default();
        let waked = ctx.clone();
        let wake: Wake = Arc::new(move || {
            if let Some(ctx) = waked.get() {
                ctx.request_repaint();
            }
        });
        let mut out = Outbox::default();
        if let Some(path) = corpus {
            out.send(Command::Begin(Begin::Open(path)));
        }
        Self {
            author,
            folders,
            keys: Keys::new(settings.keymap, &settings.keys, settings.language),
            waiting: KeyQueue::default(),
            tree: layout::remembered(settings.layout.as_ref(), (settings.busy, false)),
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
            reel: Reel::default(),
            little: Figures::default(),
            films: Films::default(),
            panes: Panes::default(),
            pane: None,
            cursor: None,
            sprung: Sprung::default(),
            start: Start::default(),
            chooser: Chooser::default(),
            unreported: Unreported::default(),
            clipboard: Clipboard::default(),
            overlays: Overlays::default(),
            walk: crate::menu_and_status::Walk::default(),
            out,
            drafts: Drafts::default(),
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
            theme::install(&ctx);
        }
        theme::apply(&ctx, &self.settings);
        self.fit(ctx.content_rect().size());
        self.listen();
        self.stay_with_the_corpus(&ctx);
        self.name_window(&ctx);
        self.panes.search.show_made(&mut self.out);
        self.panes.library.show_made(&mut self.out);
        self.panes.map.show_made(&mut self.out);
        if self.panes.recombine.has_news() {
            // The pictures requested in this frame must show the new movement.
            self.keep_up(&ctx);
            self.carry_out(&ctx);
        }
        self.hear_chooser(&ctx);
        self.tick(&ctx);
        if let Some((action, text)) = self.clipboard.came(&ctx) {
            self.paste(action, text, &ctx);
            self.carry_out(&ctx);
        }
        self.take_keys(&ctx);
        self.panes.timeline.next_frame();
        self.take_dropped(&ctx);
        // The pane with the handle must be drawn to answer a drag.
        if self.shown.handle.is_some() && !layout::shows(&self.tree, PaneKind::Recombine) {
            self.shown.handle = None;
        }
        if let Some((text, remedy)) = self.unreported.news(self.settings.language) {
            self.overlays.notices.say(&text, Some(remedy));
        }
        self.bars(ui);
        if self.desk.is_some() {
            self.workbench(ui);
        } else {
            CentralPanel::default().show(ui, |ui| self.start_page(ui));
        }
        self.overlays(&ctx);
        self.carry_out(&ctx);
        self.remember(&ctx);
    }

    /// Returns the playhead.
    #[must_use]
    pub fn playhead(&self) -> Instant {
        self.shown.player.playhead()
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
    pub fn staged(&self) -> Option<&str> {
        let showing = self.shown.made.as_ref()?;
        let there = self.panes.stage.shows(&showing.made);
        there.then_some(showing.made.name.as_str())
    }

    /// Returns the file of the open corpus.
    #[must_use]
    pub fn corpus(&self) -> Option<&PathBuf> {
        self.desk.as_ref().map(|desk| &desk.path)
    }

    /// Returns the [`generation`](chereme_corpus::Corpus::generation) of the corpus that the window shows.
    #[must_use]
    pub fn generation(&self) -> Option<i64> {
        Some(self.snapshot.as_ref()?.overview.generation)
    }

    /// Returns whether the window is idle: no work runs, no corpus is being opened, and the open corpus is read.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        let working = self
            .desk
            .as_ref()
            .is_some_and(|desk| !desk.running.is_empty());
        self.beginning.is_none()
            && !self.chooser.is_open()
            && !self.clipboard.is_waiting()
            && self.waiting.next_event().is_none()
            && !working
            && self.desk.is_some() == self.snapshot.is_some()
    }

    /// Returns the view that panes draw from; `None` without a snapshot.
    pub(crate) fn seen(&self, ctx: &Context) -> Option<PaneInput<'_>> {
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
        })
    }

    /// Receives the results of the threads.
    fn listen(&mut self) {
        let ended = self.beginning.as_mut().and_then(Beginning::ended);
        if let Some(ended) = ended {
            let begun = self.beginning.take();
            let (look, made) = begun.map(|it| (it.look, it.made)).unwrap_or_default();
            let task = crate::words::shell::TASK_OPENING;
            match ended {
                Ok(path) => {
                    self.open(&path);
                    self.made_for = made;
                    if !look.is_empty() {
                        // Nothing else in the corpus can be shown yet.
                        self.looking = true;
                        self.out.send(Command::Do(Action::LayoutSearch));
                        self.out.send(Command::Import(look));
                    }
                }
                Err(error) => {
                    self.overlays
                        .notices
                        .trouble(&error, Some(task), self.settings.language)
                }
            }
        }
        let news = self.desk.as_mut().map(Desk::news).unwrap_or_default();
        for news in news {
            match news {
                News::Read(snapshot, own) => self.take_snapshot(snapshot, own),
                News::Unread(error) => {
                    self.overlays
                        .notices
                        .trouble(&error, None, self.settings.language)
                }
                News::Stands(stands) => self.stands(stands),
                News::Copied(saved) => self.copied(saved),
                News::Far(..) => {}
                News::Ended(id, ended, about) => {
                    if self.little.hear(id, &ended) {
                        continue;
                    }
                    if ended.is_err() && self.panes.timeline.awaits_change(id) {
                        self.forget_keys();
                    }
                    self.panes.hear(id, &ended);
                    self.overlays.export.hear(id, &ended);
                    if let Ok(Outcome::Imported(report)) = &ended
                        && !report.dry_run
                        && std::mem::take(&mut self.looking)
                    {
                        self.out.send(Command::Do(Action::LayoutAnnotate));
                    }
                    if !(about.quiet && ended.is_err()) {
                        self.hear(ended, about.task);
                    }
                }
            }
        }
    }

    /// Handles the result of an open file chooser.
    fn hear_chooser(&mut self, ctx: &Context) {
        let now = ctx.input(|input| input.time);
        match self.chooser.ended(&self.wake, now) {
            Some(Chosen::Command(command)) => self.out.send(command),
            Some(Chosen::NoChooser(what)) => self.ask_path(what),
            Some(Chosen::Nothing) | None => {}
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
            player.advance(passed.min(0.5));
            ctx.request_repaint();
        }
        self.follow_films(ctx);
        let player = &self.shown.player;
        let (at, direction) = (player.playhead(), player.direction());
        let loading = self.desk.as_ref().map_or(0, |desk| {
            let lanes = desk.running.values().map(|it| it.about.lane);
            lanes.filter(|lane| *lane == Lane::Movement).count()
        });
        // While the user drags over hours of movement, passed pieces are not loaded.
        if loading < 2
            && let Some((recording, piece, span)) = self.reel.wanted(at, direction)
        {
            self.out.work(movement::load(recording, piece, span));
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
            && layout::shows(&self.tree, PaneKind::Studies)
            && self.panes.studies.drop_files(&dropped)
        {
            return;
        }
        let corpus = |path: &PathBuf| path.extension().is_some_and(|it| it == "chereme");
        self.out.send(match one {
            Some(path) if corpus(&path) => Command::Begin(Begin::Open(path)),
            Some(path) if self.desk.is_none() && path.is_dir() => {
                Command::Begin(Begin::Folder(path))
            }
            _ if self.desk.is_none() => Command::Begin(Begin::Files(dropped)),
            _ => Command::Import(dropped),
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
                let words = crate::words::shell::READING.of(settings.language);
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
            };
            let mut workbench = Workbench {
                panes,
                seen,
                out,
                pane,
                cursor,
                under: None,
                chosen: None,
            };
            tree.ui(&mut workbench, ui);
            layout::settle(tree);
            let (under, chosen) = (workbench.under, workbench.chosen);
            if let Some(tile) = chosen {
                tree.make_active(|id, _| id == tile);
            }
            carry::show(ui.ctx(), &seen, out);
            if let Some(pane) = sprung.follow(under, ui.input(|input| input.time)) {
                layout::bring(tree, pane);
            }
        });
    }

    fn bars(&mut self, ui: &mut Ui) {
        Panel::top("menus").show(ui, |ui| self.menus(ui));
        Panel::bottom("status").show(ui, |ui| self.status(ui));
    }

    /// Writes unfinished text at once, and changed settings once no pointer button is down.
    fn remember(&mut self, ctx: &Context) {
        if self.desk.is_some()
            && let Err(error) = self.drafts.keep(self.panes.timeline.draft())
        {
            self.overlays
                .notices
                .unsaved(&error, self.settings.language);
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
            .map(|file| self.settings.write(&file));
        if let Some(Err(error)) = written {
            self.overlays
                .notices
                .unsaved(&error, self.settings.language);
        }
    }

    /// Names the window after the open corpus, so that two windows can be distinguished.
    fn name_window(&mut self, ctx: &Context) {
        let title = self.title();
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
    fn fit(&mut self, size: egui::Vec2) {
        let small = layout::is_small(size);
        if small == self.small {
            return;
        }
        self.small = small;
        let before = (self.settings.busy, small);
        self.tree = layout::remembered(self.laid_out().as_ref(), before);
        self.panes.timeline.show_tier();
        if let Some(pane) = self.pane {
            layout::bring(&mut self.tree, pane);
        }
    }

    fn hear(&mut self, ended: Result<Outcome, chereme_corpus::Error>, task: Text) {
        let language = self.settings.language;
        match ended {
            Err(error) => self.overlays.notices.trouble(&error, Some(task), language),
            Ok(Outcome::Moved {
                recording,
                piece,
                moving,
            }) => self.reel.put(recording, piece, moving),
            Ok(outcome) => self.overlays.notices.of(&outcome, language),
        }
    }
}

impl Drop for Studio {
    /// Writes the zoom of the timelines when the window closes.
    fn drop(&mut self) {
        self.keep_view(true);
        self.leave();
        if self.settings != self.saved
            && let Some(file) = self.folders.settings_file()
        {
            drop(self.settings.write(&file));
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
