//! The one place where commands are carried out, after the frame that asked for them.

use std::sync::Arc;

use chereme_corpus::{MediaChange, RowName};
use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use eframe::egui::{Context, ViewportCommand};

use super::Studio;
use crate::action::{Action, ActionOwner};
use crate::command::{ChooserPurpose, DraggedToken, WindowCommand};
use crate::keys::ActionKeys;
use crate::layout::{self, BusyTask, PaneKind};
use crate::model::CorpusSnapshot;
use crate::model::display_state::{DisplayState, StageMovement};
use crate::model::generated::GeneratedClip;
use crate::panes::{ActionOutcome, recombine};
use crate::player::{OpeningPreview, StagePlayer};
use crate::settings::ThemeChoice;
use crate::theme;
use crate::words::{InterfaceText, shell as words};
use crate::work::begin::{CorpusOpening, OpeningInProgress};
use crate::work::{recordings_jobs, whole_corpus};

const SECOND_MICROS: i64 = 1_000_000;
/// Time added on either side of the selection when playing around it, in microseconds; as in ELAN.
const PLAY_AROUND_MICROS: i64 = 500_000;
/// How many rounds of follow-up commands are carried out within one frame.
const MAX_COMMAND_ROUNDS: usize = 8;
/// Frames per second for stepping in recordings without movement.
const NO_FRAMES: u32 = 25;

impl Studio {
    /// Carries out the requests of this frame.
    pub(crate) fn carry_out_commands(&mut self, ctx: &Context) {
        // Follow-up commands of an action are carried out at once too, so that the next frame shows them.
        for _ in 0..MAX_COMMAND_ROUNDS {
            let commands = self.out.take_commands();
            if commands.is_empty() {
                return;
            }
            ctx.request_repaint();
            for command in commands {
                self.carry_out_command(command, ctx);
            }
        }
    }

    fn carry_out_command(&mut self, command: WindowCommand, ctx: &Context) {
        match command {
            WindowCommand::Do(action) => self.carry_out_action(action, ctx),
            WindowCommand::Work(id, job) => {
                if let Some(desk) = &mut self.desk {
                    desk.give_desk_job(id, job);
                }
            }
            WindowCommand::Stop(id) => {
                if let Some(desk) = &self.desk {
                    desk.stop_desk_work(id);
                }
            }
            WindowCommand::Begin(begin) => self.begin_opening(begin),
            WindowCommand::Choose(what) => {
                let now = ctx.input(|input| input.time);
                self.chooser.ask_for_file(what, self.settings.language, now);
            }
            WindowCommand::StopBeginning => {
                if let Some(beginning) = &self.beginning {
                    beginning.stop_corpus_opening();
                }
            }
            WindowCommand::Recording(id) => {
                self.shown.made = None;
                self.show_recording_by_id(id);
            }
            WindowCommand::Place(id, span) => self.show_recording_span(id, span),
            WindowCommand::Look => self.bring_opened_into_sight(ctx),
            WindowCommand::Tier(tier) => self.shown.tier = tier,
            WindowCommand::Annotations(annotations) => self.shown.annotations = annotations,
            WindowCommand::Span(span) => self.shown.span = span,
            WindowCommand::Seek(at) => {
                self.shown.made = None;
                self.shown.player.seek_player_instant(at);
            }
            WindowCommand::Cue(at) => self.shown.on_stage_mut().seek_player_instant(at),
            WindowCommand::Spot(spot) => self.shown.spot = spot,
            WindowCommand::Speed(speed) => self.shown.on_stage_mut().speed = speed,
            WindowCommand::Made(made) => self.show_generated_clip(made),
            WindowCommand::Handle(handle) => self.shown.handle = handle,
            WindowCommand::Course(course) => self.shown.course = course,
            WindowCommand::Travelled(card, points) => {
                self.panes.recombine.set_travel_points(card, &points);
                self.keep_up(ctx);
            }
            WindowCommand::Placed(card, goal) => {
                self.panes.recombine.place_card_goal(card, goal);
                self.keep_up(ctx);
            }
            WindowCommand::Media(recording, track, path) => {
                let path = path.to_string_lossy().into_owned();
                let change = match track {
                    Some(track) => MediaChange::Move(track, path),
                    None => MediaChange::Add(path),
                };
                self.out
                    .request_work(recordings_jobs::change_media(RowName::Number(recording), change));
            }
            WindowCommand::Studied(ChooserPurpose::Disagreements, paths) => self.panes.agreement.take_paths(paths),
            WindowCommand::Studied(what, paths) => self.panes.studies.take_paths(what, paths),
            WindowCommand::Import(paths) => {
                self.panes.import.propose_import_paths(&paths);
                self.bring_pane_forward(PaneKind::Import);
            }
            WindowCommand::Inspect(thing) => {
                // The inspector comes to the front, but the keyboard focus does not move.
                self.panes.inspector.inspect_thing(thing);
                layout::bring_pane_to_front(&mut self.tree, PaneKind::Inspector);
            }
            WindowCommand::Note(thing) => {
                self.panes.inspector.inspect_thing(thing);
                if !layout::shares_tab_container(&self.tree, PaneKind::Inspector, PaneKind::Stage) {
                    layout::bring_pane_to_front(&mut self.tree, PaneKind::Inspector);
                }
            }
            WindowCommand::Make { recipe, gloss } => self.show_recipe_text(&recipe, None, Some(gloss)),
            WindowCommand::Use(carried) => {
                if let Some(snapshot) = &self.snapshot {
                    self.panes.recombine.take_in(&carried, &snapshot.overview);
                }
                self.bring_pane_forward(PaneKind::Recombine);
            }
            WindowCommand::Find(query) => {
                self.panes.search.search_for_query(query, &self.out);
                self.bring_pane_forward(PaneKind::Search);
            }
            WindowCommand::Recipe(recipe, of) => self.show_recipe_text(&recipe, of.clone(), of),
            WindowCommand::Searches(searches) => self.settings.searches = searches,
            WindowCommand::Stage(stage) => self.settings.stage = *stage,
            WindowCommand::Settings(settings) => {
                self.keys = ActionKeys::new(settings.keymap, &settings.keys, settings.language);
                self.settings = *settings;
            }
            WindowCommand::Cannot(text) => self.overlays.notices.add_warning(self.text_with_keys(text)),
            WindowCommand::SaveCopy(path) => {
                if let Some(desk) = &self.desk {
                    desk.save_copy(crate::work::begin::with_extension(path));
                }
            }
            WindowCommand::Say(text) => self.overlays.notices.add_hint(text),
            WindowCommand::Copy(text) => self.clipboard.put_clipboard_text(ctx, text),
            WindowCommand::Notify(text, remedy) => {
                let remedy = remedy.text_in_language(self.settings.language);
                self.overlays.notices.add_lasting_notice(&text, Some(remedy));
            }
            WindowCommand::Dismiss(notice) => self.overlays.notices.dismiss_notice(notice),
        }
    }

    fn begin_opening(&mut self, begin: CorpusOpening) {
        let starter = matches!(begin, CorpusOpening::Starter(_));
        self.greets = starter.then(|| self.greets.take().unwrap_or_default());
        self.beginning = Some(OpeningInProgress::start_corpus_opening(begin, &self.author, &self.wake));
    }

    fn show_recording_span(&mut self, id: i64, span: TimeSpan) {
        self.show_recording_by_id(id);
        self.shown.made = None;
        self.shown.span = Some(span);
        let player = &mut self.shown.player;
        player.seek_player_instant(span.span_start_instant());
        player.set_opening_preview(OpeningPreview { span, loops: false });
    }

    /// Opens a recipe; `of` is the sign that it made, and `gloss` the one that it is to make.
    fn show_recipe_text(&mut self, recipe: &str, of: Option<String>, gloss: Option<String>) {
        self.panes.recombine.open_recipe_text(recipe, of, gloss);
        self.bring_pane_forward(PaneKind::Recombine);
    }

    /// Returns a text in the language of the window, with the keys that the user has set.
    fn text_with_keys(&self, text: InterfaceText) -> String {
        self.keys
            .name_keys_in_text(text.text_in_language(self.settings.language))
    }

    /// Returns whether the open corpus is read-only.
    pub(crate) fn is_read_only(&self) -> bool {
        self.snapshot.as_ref().is_some_and(CorpusSnapshot::is_read_only)
    }

    /// Has an action carried out by its owner.
    fn carry_out_action(&mut self, action: Action, ctx: &Context) {
        match action.action_row().owner {
            ActionOwner::Window => self.act_on_window(action, ctx),
            ActionOwner::Shows(pane) => self.bring_pane_forward(pane),
            ActionOwner::Player => self.act_on_player(action),
            ActionOwner::WithCorpus if self.may_act(action) => self.act_on_corpus(action, ctx),
            ActionOwner::In(pane) if self.may_act(action) => self.act_in(pane, action, ctx),
            ActionOwner::WithCorpus | ActionOwner::In(_) => {}
        }
    }

    /// Returns whether the action can be carried out: a corpus is open, and the corpus is writable if the action changes
    /// it. Otherwise shows the reason.
    fn may_act(&mut self, action: Action) -> bool {
        let changes = action.changes_corpus();
        if changes && self.desk.is_some() && self.gone {
            self.out.send_command(WindowCommand::Cannot(words::GONE_WHY));
            return false;
        }
        if changes && self.desk.is_some() && self.is_read_only() {
            self.out.send_command(WindowCommand::Cannot(words::READ_ONLY_WHY));
            return false;
        }
        self.desk.is_some()
    }

    fn act_on_corpus(&mut self, action: Action, ctx: &Context) {
        match action {
            Action::Check if self.snapshot.is_some() => {
                self.out
                    .request_work(whole_corpus::check_corpus_job(!self.is_read_only()));
            }
            Action::Undo | Action::Redo => self.walk_one(action == Action::Undo),
            Action::ClearSelection => {
                self.shown.span = None;
                self.shown.annotations.clear();
            }
            Action::TiersOfMany => self.overlays.tiers.toggle_tier_round_window(),
            Action::MergeCorpus => {
                // If no chooser opens, the path can be typed in the import pane.
                self.bring_pane_forward(PaneKind::Import);
                self.out.send_command(WindowCommand::Choose(ChooserPurpose::Merge));
            }
            Action::UseInRecipe => self.use_in_recipe(ctx),
            Action::OpenRecipe => self.open_recipe(),
            Action::Paste | Action::PasteHere => {
                if let Some(text) = self.clipboard.request_pasted_text(ctx, action) {
                    self.paste_text(action, text, ctx);
                }
            }
            Action::NextRecording => self.walk_recordings(1),
            Action::PreviousRecording => self.walk_recordings(-1),
            Action::ShareFilm | Action::ShareGif | Action::SharePicture | Action::ShareGlb => {
                self.share_stage_contents(action, ctx);
            }
            Action::StoreSign => {
                self.bring_pane_forward(PaneKind::Recombine);
                self.act_in(PaneKind::Recombine, action, ctx);
            }
            _ => {}
        }
    }

    /// Evaluates a changed recipe at once, and passes the result to the stage.
    pub(crate) fn keep_up(&mut self, ctx: &Context) {
        if !layout::is_pane_in_sight(&self.tree, PaneKind::Recombine) {
            return;
        }
        let mut panes = std::mem::take(&mut self.panes);
        if let Some(seen) = self.pane_input(ctx) {
            let now = ctx.input(|input| input.time);
            panes.recombine.keep_up(&seen, now);
        }
        self.panes = panes;
    }

    /// Undoes or redoes one step: of the recipe if it changed last and is in sight, else of the corpus.
    fn walk_one(&mut self, back: bool) {
        let snapshot = self.snapshot.as_ref();
        let operations = snapshot.map_or(&[][..], |snapshot| &snapshot.overview.operations);
        if layout::is_pane_in_sight(&self.tree, PaneKind::Recombine)
            && self.panes.recombine.walk_recipe_history(back, operations)
        {
            return;
        }
        self.out.request_work(whole_corpus::undo_or_redo(back));
    }

    /// Opens the recipe of the displayed recording again.
    fn open_recipe(&mut self) {
        let snapshot = self.snapshot.as_ref().zip(self.shown.recording);
        match snapshot.and_then(|(snapshot, recording)| snapshot.recipe_of(recording)) {
            Some((recipe, name)) => self.out.send_command(WindowCommand::Recipe(recipe, Some(name))),
            None => self
                .out
                .send_command(WindowCommand::Cannot(crate::words::actions_words::NO_RECIPE)),
        }
    }

    /// Adds the sign that is selected in the last used pane to the recipe.
    fn use_in_recipe(&mut self, ctx: &Context) {
        let carried = match self.pane {
            Some(PaneKind::Search) => self.panes.search.cursor_hit_token(),
            Some(PaneKind::Library) => self.panes.library.last_chosen_sign(),
            _ => None,
        };
        let selected = || {
            let (token, gloss) = recombine::selected_token(&self.pane_input(ctx)?)?;
            Some(DraggedToken { token, gloss })
        };
        // An opened notated sign is on the stage, whichever pane covers the results.
        let notated = || {
            let made = &self.shown.made.as_ref()?.made;
            let (token, gloss) = (made.token?, made.name.clone());
            Some(DraggedToken { token, gloss })
        };
        match carried.or_else(notated).or_else(selected) {
            Some(carried) => self.out.send_command(WindowCommand::Use(carried)),
            None => self.out.send_command(WindowCommand::Cannot(words::NEEDS_SIGN)),
        }
    }

    /// Pastes a text at the place that the action names.
    pub(crate) fn paste_text(&mut self, action: Action, text: String, ctx: &Context) {
        self.panes.timeline.hold_clip(text);
        self.act_in(PaneKind::Timeline, action, ctx);
    }

    /// Has a pane carry out an action.
    fn act_in(&mut self, pane: PaneKind, action: Action, ctx: &Context) {
        let mut panes = std::mem::take(&mut self.panes);
        if let Some(seen) = self.pane_input(ctx) {
            let acted = panes.get_mut(pane).carry_out_pane_action(action, &seen);
            if let ActionOutcome::Cannot(text) = acted {
                self.overlays.notices.add_warning(self.text_with_keys(text));
            }
        }
        self.panes = panes;
    }

    fn act_on_window(&mut self, action: Action, ctx: &Context) {
        match action {
            Action::OpenStarter => self.open_starter(),
            Action::Open => self.out.send_command(WindowCommand::Choose(ChooserPurpose::Corpus)),
            Action::New => self.out.send_command(WindowCommand::Choose(ChooserPurpose::NewCorpus)),
            Action::ImportFiles => self.out.send_command(WindowCommand::Choose(ChooserPurpose::Files)),
            Action::ImportFolder => self.out.send_command(WindowCommand::Choose(ChooserPurpose::Folder)),
            Action::Close => self.close_corpus(),
            Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Action::Settings => self.overlays.settings.toggle_settings_window(),
            Action::Keys => self.overlays.keys.toggle_keys_help(),
            Action::FirstSteps => self.overlays.steps.toggle_first_steps(),
            Action::Palette => self.overlays.palette.toggle_palette(),
            Action::Theme => {
                let dark = theme::is_dark(ctx);
                self.settings.theme = if dark { ThemeChoice::Light } else { ThemeChoice::Dark };
            }
            Action::Larger => self.change_interface_scale(0.1),
            Action::Smaller => self.change_interface_scale(-0.1),
            Action::LayoutAnnotate => self.lay_out_panes(BusyTask::Annotating),
            Action::LayoutSearch => self.lay_out_panes(BusyTask::Searching),
            Action::LayoutRecombine => self.lay_out_panes(BusyTask::Recombining),
            Action::OnlyPane => {
                let pane = self.pane.unwrap_or(PaneKind::Timeline);
                layout::enlarge_panes(&mut self.tree, &[pane]);
            }
            Action::OnlyAnnotating => {
                layout::enlarge_panes(&mut self.tree, &[PaneKind::Stage, PaneKind::Timeline]);
            }
            Action::Export => self.overlays.export.toggle_export_window(),
            _ => {}
        }
    }

    fn act_on_player(&mut self, action: Action) {
        let made = self
            .shown
            .made
            .as_ref()
            .map(|showing| showing.made.clip.clip_frame_rate());
        let rate = made
            .or_else(|| self.reel.reel_frame_rate())
            .or_else(|| FrameRate::new(NO_FRAMES, 1).ok());
        // A selection belongs to the recording, and says nothing about generated movement.
        let part = self.shown.span.filter(|_| made.is_none());
        let stepping = self.settings.stepping;
        let player = self.shown.on_stage_mut();
        let (at, whole) = (player.player_playhead(), player.whole);
        match action {
            Action::Play => player.toggle_playback(),
            Action::PlaySelection => player.play_part(part.unwrap_or(whole)),
            Action::PlayAround => {
                let span = part.unwrap_or(whole);
                let start = span
                    .span_start_instant()
                    .shifted_instant(-PLAY_AROUND_MICROS)
                    .max(whole.span_start_instant());
                let end = span
                    .span_end_instant()
                    .shifted_instant(PLAY_AROUND_MICROS)
                    .min(whole.span_end_instant());
                player.play_part(TimeSpan::span_between(start, end));
            }
            Action::StepAndRepeat => player.step_and_repeat(part, stepping),
            Action::OtherEnd | Action::ToCentre => {
                let Some(span) = part else { return };
                let middle = span.span_start_instant().shifted_instant(span.span_micros() / 2);
                player.seek_player_instant(match action {
                    Action::ToCentre => middle,
                    _ if at < middle => span.span_end_instant(),
                    _ => span.span_start_instant(),
                });
            }
            Action::Loop => player.looping = !player.looping,
            Action::ShuttleBack => player.shuttle_playback(-1.0),
            Action::ShuttleForward => player.shuttle_playback(1.0),
            Action::ShuttleStop => player.stop_playback(),
            Action::FrameBack | Action::FrameForward => {
                let frames = if action == Action::FrameBack { -1 } else { 1 };
                let filmed = made.is_none() && !self.reel.has_movement();
                // Frames of a film may be uneven, so that it knows its next one itself.
                if filmed && let Some(next) = self.films.step_first_film(at, frames) {
                    player.stop_playback();
                    player.seek_player_instant(next);
                } else if let Some(rate) = rate {
                    player.step_player_frames(frames, rate);
                }
            }
            Action::SecondBack => player.seek_player_instant(at.shifted_instant(-SECOND_MICROS)),
            Action::SecondForward => player.seek_player_instant(at.shifted_instant(SECOND_MICROS)),
            Action::ToStart => player.seek_player_instant(whole.span_start_instant()),
            Action::ToEnd => player.seek_player_instant(whole.span_end_instant()),
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
        self.films.follow_recording(snapshot, self.shown.recording, ctx);
        let whole_span = self.shown.player.whole;
        let end = self.shown.recording.map(|id| self.films.last_film_end(id));
        if let Some(end) = end.filter(|end| *end > whole_span.span_end_instant()) {
            self.shown
                .player
                .fit_player_span(TimeSpan::span_between(whole_span.span_start_instant(), end));
        }
    }

    fn change_interface_scale(&mut self, by: f32) {
        self.settings.scale = ((self.settings.scale + by) * 10.0).round().clamp(5.0, 30.0) / 10.0;
    }

    fn lay_out_panes(&mut self, busy: BusyTask) {
        self.settings.busy = busy;
        self.tree = layout::layout_for_task(busy, self.small);
        self.panes.timeline.show_tier();
    }

    pub(crate) fn bring_pane_forward(&mut self, pane: PaneKind) {
        layout::bring_pane_to_front(&mut self.tree, pane);
        self.pane = Some(pane);
        let others = PaneKind::ALL_PANE_KINDS.into_iter().filter(|other| *other != pane);
        others.for_each(|other| self.panes.get_mut(other).release_pane_keyboard());
        self.panes.get_mut(pane).come();
    }

    /// Brings the opened thing into sight; if that hides the hits it was opened from, a hint names the return to
    /// them.
    fn bring_opened_into_sight(&mut self, ctx: &Context) {
        let from = self.pane;
        layout::bring_stage_into_sight(&mut self.tree);
        let Some(pane) = from.filter(|pane| !layout::is_pane_in_sight(&self.tree, *pane)) else {
            return;
        };
        self.pane = Some(PaneKind::Stage);
        if let Some(focused) = ctx.memory(|memory| memory.focused()) {
            ctx.memory_mut(|memory| memory.surrender_focus(focused));
        }
        if pane == PaneKind::Search {
            self.overlays.notices.add_hint(self.text_with_keys(words::BACK_TO_HITS));
        }
    }

    fn walk_recordings(&mut self, by: isize) {
        let Some(snapshot) = &self.snapshot else {
            return;
        };
        let all = &snapshot.overview.recordings;
        let here = all
            .iter()
            .position(|glance| Some(glance.row.id) == self.shown.recording);
        let next = here.map_or(Some(0), |here| here.checked_add_signed(by));
        if let Some(id) = next.and_then(|next| all.get(next)).map(|glance| glance.row.id) {
            self.show_recording_by_id(id);
        }
    }

    /// Shows a recording; nothing changes if it is shown already.
    pub(crate) fn show_recording_by_id(&mut self, id: i64) {
        let Some(glance) = self
            .snapshot
            .as_ref()
            .and_then(|snapshot| snapshot.recording_glance(id))
        else {
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
        let end = RecordingInstant::from_micros(glance.row.duration_us);
        let span = TimeSpan::span_between(RecordingInstant::RECORDING_START, end);
        self.shown.player.load_player_span(span);
        self.shown
            .player
            .set_opening_preview(OpeningPreview { span, loops: false });
        (self.shown.player.speed, self.shown.player.looping) = (speed, looping);
        self.reel.load_recording_reel(Some(glance));
        if let Some(desk) = &self.desk {
            desk.watch_recording_tiers(Some(id));
        }
    }

    /// Shows generated movement in a loop. New movement of the same length keeps the playhead of the old.
    fn show_generated_clip(&mut self, made: Option<Arc<GeneratedClip>>) {
        let before = self.shown.made.take();
        let Some(made) = made else { return };
        let clip_span = made.clip.clip_span();
        let player = match before {
            Some(showing) if showing.player.whole == clip_span => showing.player,
            before => {
                let mut player = StagePlayer::default();
                player.load_player_span(clip_span);
                player.looping = true;
                player.speed = before.map_or(self.shown.player.speed, |showing| showing.player.speed);
                player.toggle_playback();
                player
            }
        };
        self.shown.player.stop_playback();
        self.shown.made = Some(StageMovement { made, player });
    }
}
