//! The one place where commands are carried out, after the frame that asked for them.

use std::sync::Arc;

use chereme_corpus::MediaChange;
use chereme_motion::{Instant, Rate, Span};
use eframe::egui::{Context, ViewportCommand};

use crate::action::{Action, Owner};
use crate::app::Studio;
use crate::command::Command;
use crate::context::{DisplayState, PaneInput, Showing};
use crate::file_dialogs::Choose;
use crate::keys::Keys;
use crate::layout::{self, Busy};
use crate::model::Snapshot;
use crate::model::generated::GeneratedClip;
use crate::panes::{Acted, Carried, PaneKind, recombine};
use crate::player::{Player, Preview};
use crate::settings::ThemeChoice;
use crate::theme;
use crate::words::{Text, shell as words};
use crate::work::begin::{Begin, Beginning};
use crate::work::{Job, recordings, whole_corpus};

const SECOND: i64 = 1_000_000;
/// Time added on either side of the selection when playing around it, in microseconds; as in ELAN.
const AROUND: i64 = 500_000;
/// How many rounds of follow-up commands are carried out within one frame.
const ROUNDS: usize = 8;
/// Frames per second for stepping in recordings without movement.
const NO_FRAMES: u32 = 25;

impl Studio {
    /// Carries out the requests of this frame.
    pub(crate) fn carry_out(&mut self, ctx: &Context) {
        // Follow-up commands of an action are carried out at once too, so that the next frame shows them.
        for _ in 0..ROUNDS {
            let commands = self.out.take();
            if commands.is_empty() {
                return;
            }
            ctx.request_repaint();
            for command in commands {
                self.command(command, ctx);
            }
        }
    }

    fn command(&mut self, command: Command, ctx: &Context) {
        match command {
            Command::Do(action) => self.act(action, ctx),
            Command::Work(id, job) => {
                if let Some(desk) = &mut self.desk {
                    desk.give(id, job);
                }
            }
            Command::Stop(id) => {
                if let Some(desk) = &self.desk {
                    desk.stop(id);
                }
            }
            Command::Begin(begin) => {
                let starter = matches!(begin, Begin::Starter(_));
                self.greets = starter.then(|| self.greets.take().unwrap_or_default());
                self.beginning = Some(Beginning::start(begin, &self.author, &self.wake));
            }
            Command::Choose(what) => {
                let now = ctx.input(|input| input.time);
                self.chooser.ask(what, self.settings.language, now);
            }
            Command::StopBeginning => {
                if let Some(beginning) = &self.beginning {
                    beginning.stop();
                }
            }
            Command::Recording(id) => {
                self.shown.made = None;
                self.turn_to(id);
            }
            Command::Place(id, span) => {
                self.turn_to(id);
                self.shown.made = None;
                self.shown.span = Some(span);
                self.shown.player.seek(span.start());
                self.shown.player.preview(Preview { span, loops: false });
            }
            Command::Look => self.look(ctx),
            Command::Tier(tier) => self.shown.tier = tier,
            Command::Annotations(annotations) => self.shown.annotations = annotations,
            Command::Span(span) => self.shown.span = span,
            Command::Seek(at) => {
                self.shown.made = None;
                self.shown.player.seek(at);
            }
            Command::Cue(at) => self.shown.on_stage_mut().seek(at),
            Command::Spot(spot) => self.shown.spot = spot,
            Command::Speed(speed) => self.shown.on_stage_mut().speed = speed,
            Command::Made(made) => self.show_made(made),
            Command::Handle(handle) => self.shown.handle = handle,
            Command::Course(course) => self.shown.course = course,
            Command::Travelled(card, points) => {
                self.panes.recombine.travel(card, &points);
                self.keep_up(ctx);
            }
            Command::Placed(card, goal) => {
                self.panes.recombine.place(card, goal);
                self.keep_up(ctx);
            }
            Command::Media(recording, track, path) => {
                let path = path.to_string_lossy().into_owned();
                let change = match track {
                    Some(track) => MediaChange::Move(track, path),
                    None => MediaChange::Add(path),
                };
                let name = chereme_corpus::Name::Number(recording);
                self.out.work(recordings::change_media(name, change));
            }
            Command::Studied(Choose::Disagreements, paths) => {
                self.panes.agreement.take_paths(paths)
            }
            Command::Studied(what, paths) => self.panes.studies.take_paths(what, paths),
            Command::Import(paths) => {
                self.panes.import.propose(&paths);
                self.bring(PaneKind::Import);
            }
            Command::Inspect(thing) => {
                // The inspector comes to the front, but the keyboard focus does not move.
                self.panes.inspector.turn_to(thing);
                layout::bring(&mut self.tree, PaneKind::Inspector);
            }
            Command::Note(thing) => {
                self.panes.inspector.turn_to(thing);
                if !layout::hides(&self.tree, PaneKind::Inspector, PaneKind::Stage) {
                    layout::bring(&mut self.tree, PaneKind::Inspector);
                }
            }
            Command::Make { recipe, gloss } => {
                self.panes.recombine.open(&recipe, None, Some(gloss));
                self.bring(PaneKind::Recombine);
            }
            Command::Use(carried) => {
                if let Some(snapshot) = &self.snapshot {
                    self.panes.recombine.take_in(&carried, &snapshot.overview);
                }
                self.bring(PaneKind::Recombine);
            }
            Command::Find(query) => {
                let mut out = std::mem::take(&mut self.out);
                self.panes.search.find(query, &mut out);
                self.out = out;
                self.bring(PaneKind::Search);
            }
            Command::Recipe(recipe, of) => {
                self.panes.recombine.open(&recipe, of.clone(), of);
                self.bring(PaneKind::Recombine);
            }
            Command::Searches(searches) => self.settings.searches = searches,
            Command::Stage(stage) => self.settings.stage = *stage,
            Command::Settings(settings) => {
                self.settings = *settings;
                let crate::settings::Settings {
                    keymap,
                    keys,
                    language,
                    ..
                } = &self.settings;
                self.keys = Keys::new(*keymap, keys, *language);
            }
            Command::Cannot(text) => {
                let text = self.keys.named(text.of(self.settings.language));
                self.overlays.notices.warn(text);
            }
            Command::SaveCopy(path) => {
                if let Some(desk) = &self.desk {
                    desk.save_copy(crate::work::begin::with_extension(path));
                }
            }
            Command::Say(text) => self.overlays.notices.hint(text),
            Command::Copy(text) => self.clipboard.put(ctx, text),
            Command::Notify(text, remedy) => {
                let remedy = remedy.of(self.settings.language);
                self.overlays.notices.say(&text, Some(remedy));
            }
            Command::Dismiss(notice) => self.overlays.notices.dismiss(notice),
        }
    }

    /// Returns whether the open corpus is read-only.
    pub(crate) fn is_read_only(&self) -> bool {
        self.snapshot.as_ref().is_some_and(Snapshot::is_read_only)
    }

    /// Has an action carried out by its owner.
    fn act(&mut self, action: Action, ctx: &Context) {
        match action.row().owner {
            Owner::Window => self.act_on_window(action, ctx),
            Owner::Shows(pane) => self.bring(pane),
            Owner::Player => self.act_on_player(action),
            Owner::WithCorpus if self.may_act(action) => self.act_on_corpus(action, ctx),
            Owner::In(pane) if self.may_act(action) => self.act_in(pane, action, ctx),
            Owner::Runs(use_case) if self.may_act(action) => self.run_use_case(use_case, ctx),
            Owner::WithCorpus | Owner::In(_) | Owner::Runs(_) => {}
        }
    }

    /// Returns whether the action can be carried out: a corpus is open, and the corpus is writable if the action changes
    /// it. Otherwise shows the reason.
    fn may_act(&mut self, action: Action) -> bool {
        let changes = action.changes();
        if changes && self.desk.is_some() && self.gone {
            self.out.send(Command::Cannot(words::GONE_WHY));
            return false;
        }
        if changes && self.desk.is_some() && self.is_read_only() {
            self.out.send(Command::Cannot(words::READ_ONLY_WHY));
            return false;
        }
        self.desk.is_some()
    }

    /// Runs a use case on the selection, or shows why it cannot be run.
    fn run_use_case(&mut self, use_case: fn(&PaneInput<'_>) -> Result<Job, Text>, ctx: &Context) {
        match self.seen(ctx).map(|seen| use_case(&seen)) {
            Some(Ok(job)) => {
                self.out.work(job);
            }
            Some(Err(text)) => self.out.send(Command::Cannot(text)),
            None => {}
        }
    }

    fn act_on_corpus(&mut self, action: Action, ctx: &Context) {
        match action {
            Action::Undo | Action::Redo => self.walk_one(action == Action::Undo),
            Action::ClearSelection => {
                self.shown.span = None;
                self.shown.annotations.clear();
            }
            Action::MergeCorpus => {
                // If no chooser opens, the path can be typed in the import pane.
                self.bring(PaneKind::Import);
                self.out.send(Command::Choose(Choose::Merge));
            }
            Action::UseInRecipe => self.use_in_recipe(ctx),
            Action::OpenRecipe => self.open_recipe(),
            Action::Paste | Action::PasteHere => {
                if let Some(text) = self.clipboard.given(ctx, action) {
                    self.paste(action, text, ctx);
                }
            }
            Action::NextRecording => self.walk_recordings(1),
            Action::PreviousRecording => self.walk_recordings(-1),
            Action::ShareFilm | Action::ShareGif | Action::SharePicture | Action::ShareGlb => {
                self.share(action, ctx);
            }
            Action::StoreSign => {
                self.bring(PaneKind::Recombine);
                self.act_in(PaneKind::Recombine, action, ctx);
            }
            _ => {}
        }
    }

    /// Evaluates a changed recipe at once, and passes the result to the stage.
    pub(crate) fn keep_up(&mut self, ctx: &Context) {
        if !layout::shows(&self.tree, PaneKind::Recombine) {
            return;
        }
        let mut panes = std::mem::take(&mut self.panes);
        let mut out = std::mem::take(&mut self.out);
        if let Some(seen) = self.seen(ctx) {
            let now = ctx.input(|input| input.time);
            panes.recombine.keep_up(&seen, now, &mut out);
        }
        (self.panes, self.out) = (panes, out);
    }

    /// Undoes or redoes one step: of the recipe if it changed last and is in sight, else of the corpus.
    fn walk_one(&mut self, back: bool) {
        let snapshot = self.snapshot.as_ref();
        let operations = snapshot.map_or(&[][..], |it| &it.overview.operations);
        if layout::shows(&self.tree, PaneKind::Recombine)
            && self.panes.recombine.walk(back, operations)
        {
            return;
        }
        self.out.work(whole_corpus::undo_or_redo(back));
    }

    /// Opens the recipe of the displayed recording again.
    fn open_recipe(&mut self) {
        let snapshot = self.snapshot.as_ref().zip(self.shown.recording);
        match snapshot.and_then(|(snapshot, recording)| snapshot.recipe_of(recording)) {
            Some((recipe, name)) => self.out.send(Command::Recipe(recipe, Some(name))),
            None => self
                .out
                .send(Command::Cannot(crate::words::actions::NO_RECIPE)),
        }
    }

    /// Adds the sign that is selected in the last used pane to the recipe.
    fn use_in_recipe(&mut self, ctx: &Context) {
        let carried = match self.pane {
            Some(PaneKind::Search) => self.panes.search.carried(),
            Some(PaneKind::Library) => self.panes.library.carried(),
            _ => None,
        };
        let selected = || {
            let (token, gloss) = recombine::selected_token(&self.seen(ctx)?)?;
            Some(Carried { token, gloss })
        };
        // An opened notated sign is on the stage, whichever pane covers the results.
        let notated = || {
            let made = &self.shown.made.as_ref()?.made;
            let (token, gloss) = (made.token?, made.name.clone());
            Some(Carried { token, gloss })
        };
        match carried.or_else(notated).or_else(selected) {
            Some(carried) => self.out.send(Command::Use(carried)),
            None => self.out.send(Command::Cannot(words::NEEDS_SIGN)),
        }
    }

    /// Pastes a text at the place that the action names.
    pub(crate) fn paste(&mut self, action: Action, text: String, ctx: &Context) {
        self.panes.timeline.hold_clip(text);
        self.act_in(PaneKind::Timeline, action, ctx);
    }

    /// Has a pane carry out an action.
    fn act_in(&mut self, pane: PaneKind, action: Action, ctx: &Context) {
        let mut panes = std::mem::take(&mut self.panes);
        let mut out = std::mem::take(&mut self.out);
        if let Some(seen) = self.seen(ctx) {
            let acted = panes.get_mut(pane).act(action, &seen, &mut out);
            if let Acted::Cannot(text) = acted {
                let text = self.keys.named(text.of(self.settings.language));
                self.overlays.notices.warn(text);
            }
        }
        (self.panes, self.out) = (panes, out);
    }

    fn act_on_window(&mut self, action: Action, ctx: &Context) {
        match action {
            Action::OpenStarter => self.open_starter(),
            Action::Open => self.out.send(Command::Choose(Choose::Corpus)),
            Action::New => self.out.send(Command::Choose(Choose::NewCorpus)),
            Action::ImportFiles => self.out.send(Command::Choose(Choose::Files)),
            Action::ImportFolder => self.out.send(Command::Choose(Choose::Folder)),
            Action::Close => self.close(),
            Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Action::Settings => self.overlays.settings.toggle(),
            Action::Keys => self.overlays.keys.toggle(),
            Action::FirstSteps => self.overlays.steps.toggle(),
            Action::Palette => self.overlays.palette.toggle(),
            Action::Theme => {
                let dark = theme::is_dark(ctx);
                self.settings.theme = if dark {
                    ThemeChoice::Light
                } else {
                    ThemeChoice::Dark
                };
            }
            Action::Larger => self.scale(0.1),
            Action::Smaller => self.scale(-0.1),
            Action::LayoutAnnotate => self.lay_out(Busy::Annotating),
            Action::LayoutSearch => self.lay_out(Busy::Searching),
            Action::LayoutRecombine => self.lay_out(Busy::Recombining),
            Action::OnlyPane => {
                let pane = self.pane.unwrap_or(PaneKind::Timeline);
                layout::enlarge(&mut self.tree, &[pane]);
            }
            Action::OnlyAnnotating => {
                layout::enlarge(&mut self.tree, &[PaneKind::Stage, PaneKind::Timeline]);
            }
            Action::Export => self.overlays.export.toggle(),
            _ => {}
        }
    }

    fn act_on_player(&mut self, action: Action) {
        let made = self.shown.made.as_ref().map(|it| it.made.clip.rate());
        let rate = made
            .or_else(|| self.reel.rate())
            .or_else(|| Rate::new(NO_FRAMES, 1).ok());
        let part = self.shown.span.filter(|_| made.is_none());
        let stepping = self.settings.stepping;
        let player = self.shown.on_stage_mut();
        let (at, whole) = (player.playhead(), player.whole);
        match action {
            Action::Play => player.toggle(),
            Action::PlaySelection => player.play_part(part.unwrap_or(whole)),
            Action::PlayAround => {
                let span = part.unwrap_or(whole);
                let start = span.start().shifted(-AROUND).max(whole.start());
                let end = span.end().shifted(AROUND).min(whole.end());
                player.play_part(Span::between(start, end));
            }
            Action::StepAndRepeat => player.step_and_repeat(part, stepping),
            Action::OtherEnd | Action::ToCentre => {
                let Some(span) = part else { return };
                let middle = span.start().shifted(span.micros() / 2);
                player.seek(match action {
                    Action::ToCentre => middle,
                    _ if at < middle => span.end(),
                    _ => span.start(),
                });
            }
            Action::Loop => player.looping = !player.looping,
            Action::ShuttleBack => player.shuttle(-1.0),
            Action::ShuttleForward => player.shuttle(1.0),
            Action::ShuttleStop => player.stop(),
            Action::FrameBack | Action::FrameForward => {
                let frames = if action == Action::FrameBack { -1 } else { 1 };
                let filmed = made.is_none() && !self.reel.has_movement();
                if filmed && let Some(next) = self.films.step(at, frames) {
                    player.stop();
                    player.seek(next);
                } else if let Some(rate) = rate {
                    player.step(frames, rate);
                }
            }
            Action::SecondBack => player.seek(at.shifted(-SECOND)),
            Action::SecondForward => player.seek(at.shifted(SECOND)),
            Action::ToStart => player.seek(whole.start()),
            Action::ToEnd => player.seek(whole.end()),
            Action::Slower => player.step_speed(false),
            Action::Faster => player.step_speed(true),
            Action::NormalSpeed => player.speed = 1.0,
            _ => {}
        }
    }

    /// Loads the films of the displayed recording; the recording lasts at least as long as the longest of them.
    pub(crate) fn follow_films(&mut self, ctx: &Context) {
        let Some(snapshot) = &self.snapshot else {
            return;
        };
        self.films.follow(snapshot, self.shown.recording, ctx);
        let whole = self.shown.player.whole;
        let end = self.shown.recording.map(|id| self.films.end(id));
        if let Some(end) = end.filter(|end| *end > whole.end()) {
            self.shown.player.fit(Span::between(whole.start(), end));
        }
    }

    fn scale(&mut self, by: f32) {
        self.settings.scale = ((self.settings.scale + by) * 10.0).round().clamp(5.0, 30.0) / 10.0;
    }

    fn lay_out(&mut self, busy: Busy) {
        self.settings.busy = busy;
        self.tree = layout::of(busy, self.small);
        self.panes.timeline.show_tier();
    }

    pub(crate) fn bring(&mut self, pane: PaneKind) {
        layout::bring(&mut self.tree, pane);
        self.pane = Some(pane);
        let others = PaneKind::ALL.into_iter().filter(|other| *other != pane);
        others.for_each(|other| self.panes.get_mut(other).leave());
        self.panes.get_mut(pane).come();
    }

    /// Brings the opened thing into sight; if that hides the hits it was opened from, a hint names the return to
    /// them.
    fn look(&mut self, ctx: &Context) {
        let from = self.pane;
        layout::look(&mut self.tree);
        let Some(pane) = from.filter(|pane| !layout::shows(&self.tree, *pane)) else {
            return;
        };
        self.pane = Some(PaneKind::Stage);
        if let Some(focused) = ctx.memory(|memory| memory.focused()) {
            ctx.memory_mut(|memory| memory.surrender_focus(focused));
        }
        if pane == PaneKind::Search {
            let text = words::BACK_TO_HITS.of(self.settings.language);
            self.overlays.notices.hint(self.keys.named(text));
        }
    }

    fn walk_recordings(&mut self, by: isize) {
        let Some(snapshot) = &self.snapshot else {
            return;
        };
        let all = &snapshot.overview.recordings;
        let here = all
            .iter()
            .position(|it| Some(it.row.id) == self.shown.recording);
        let next = here.map_or(Some(0), |here| here.checked_add_signed(by));
        if let Some(id) = next.and_then(|next| all.get(next)).map(|it| it.row.id) {
            self.turn_to(id);
        }
    }

    /// Shows a recording; nothing changes if it is shown already.
    pub(crate) fn turn_to(&mut self, id: i64) {
        let Some(glance) = self.snapshot.as_ref().and_then(|it| it.recording(id)) else {
            return;
        };
        if self.shown.recording == Some(id) {
            return;
        }
        let speed = self.shown.player.speed;
        let looping = self.shown.player.looping;
        self.shown = DisplayState {
            recording: Some(id),
            ..DisplayState::default()
        };
        let end = Instant::from_micros(glance.row.duration_us);
        let span = Span::between(Instant::ZERO, end);
        self.shown.player.load(span);
        self.shown.player.preview(Preview { span, loops: false });
        (self.shown.player.speed, self.shown.player.looping) = (speed, looping);
        self.reel.load(Some(glance));
        if let Some(desk) = &self.desk {
            desk.watch(Some(id));
        }
    }

    /// Shows generated movement in a loop. New movement of the same length keeps the playhead of the old.
    fn show_made(&mut self, made: Option<Arc<GeneratedClip>>) {
        let before = self.shown.made.take();
        let Some(made) = made else { return };
        let whole = made.clip.span();
        let player = match before {
            Some(showing) if showing.player.whole == whole => showing.player,
            before => {
                let mut player = Player::default();
                player.load(whole);
                player.looping = true;
                player.speed = before.map_or(self.shown.player.speed, |it| it.player.speed);
                player.toggle();
                player
            }
        };
        self.shown.player.stop();
        self.shown.made = Some(Showing { made, player });
    }
}
