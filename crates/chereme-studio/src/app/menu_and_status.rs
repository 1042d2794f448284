//! The menu bar above, and the status line below.

use eframe::egui::{Align, Button, Id, Key, Layout, MenuBar, Modifiers, Popup, ProgressBar, ScrollArea, Ui, Vec2};

use super::Studio;
use crate::action::{ACTIONS, Action, ActionContext, ActionMenu};
use crate::command::WindowCommand;
use crate::layout::BusyTask;
use crate::panes::history::history_data as history;
use crate::panes::timeline::bar;
use crate::words::{InterfaceText, fill_text_braces, shell as words};
use crate::work::WorkLane;
use crate::work::begin::CorpusOpening;

/// State of walking from menu to menu with the arrow keys.
#[derive(Debug, Default)]
pub(crate) struct MenuWalk {
    /// Popups of the menus, in order, as they were drawn last.
    popups: Vec<Id>,
    /// Index of the menu that the keys opened; its first entry gets the keyboard.
    came: Option<usize>,
    /// Whether the menu was opened in this frame: the same key may still move the keyboard focus at the end of the
    /// frame.
    waits: bool,
    /// Whether the pointer has not moved since the keys opened a menu.
    rests: bool,
}

impl MenuWalk {
    /// Opens the neighbour of the open menu if an arrow key was pressed.
    fn take_keys(&mut self, ui: &Ui) {
        let ctx = ui.ctx();
        self.waits = false;
        let open = self.popups.iter().position(|id| Popup::is_id_open(ctx, *id));
        let Some(open) = open else { return };
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let by = match (pressed(Key::ArrowLeft), pressed(Key::ArrowRight)) {
            (true, false) => self.popups.len() - 1,
            (false, true) => 1,
            _ => return,
        };
        let next = (open + by) % self.popups.len();
        Popup::open_id(ctx, self.popups[next]);
        (self.came, self.waits, self.rests) = (Some(next), true, true);
    }

    /// Keeps the menu that the keys opened. Without this, a pointer at rest on another menu's name would open that one.
    fn keep_opened_menu(&mut self, ui: &Ui) {
        /// Key under which egui stores the open menu of a bar.
        const OPEN_MENU_KEY: &str = "egui_menu_bar_open_menu";
        self.rests &= ui.input(|input| input.pointer.delta() == Vec2::ZERO);
        if self.rests {
            let bar_ids = ui.stack().iter().map(|layer| layer.unique_id.with(OPEN_MENU_KEY));
            let bars: Vec<Id> = bar_ids.collect();
            ui.data_mut(|data| bars.into_iter().for_each(|id| data.remove::<Id>(id)));
        }
    }
}

/// The width of the bar that scrolls a menu, in points.
const MENU_SCROLL_BAR_WIDTH: f32 = 10.0;
/// The part of the window's height that a menu leaves free, in points.
const MENU_MARGIN_POINTS: f32 = 60.0;
/// The width that the three layout buttons need beside the menus, in points.
const LAYOUT_BUTTONS_WIDTH: f32 = 280.0;

/// The entries that begin a group of a menu.
const MENU_GROUP_STARTS: [Action; 19] = [
    Action::SplitAnnotation,
    Action::DeleteAnnotation,
    Action::CopyToTier,
    Action::NextAnnotation,
    Action::AlsoNext,
    Action::ToSelection,
    Action::StartEarlier,
    Action::SelectFromHere,
    Action::ModeNormal,
    Action::SnapFrames,
    Action::AddTier,
    Action::TierUp,
    Action::FoldTier,
    Action::StageSplit,
    Action::OrbitLeft,
    Action::Nearer,
    Action::FrameBack,
    Action::Slower,
    Action::NextRecording,
];

impl Studio {
    pub(crate) fn show_menu_bar(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        self.walk.take_keys(ui);
        MenuBar::new().ui(ui, |ui| {
            self.walk.popups.clear();
            // In a narrow window the last names continue on a second line, where they stay in reach.
            ui.horizontal_wrapped(|ui| {
                for (at, (menu, title)) in ActionMenu::ALL_ACTION_MENUS.into_iter().enumerate() {
                    self.menu_name(ui, at, menu, title.text_in_language(language));
                }
                if self.snapshot.is_some() && ui.available_size_before_wrap().x > LAYOUT_BUTTONS_WIDTH {
                    let one_line = Layout::right_to_left(Align::Center);
                    ui.with_layout(one_line, |ui| self.layouts(ui));
                }
            });
        });
    }

    /// Shows the name of a menu in the bar, and below it the menu while it is open.
    fn menu_name(&mut self, ui: &mut Ui, at: usize, menu: ActionMenu, title: &str) {
        self.walk.keep_opened_menu(ui);
        let button = ui.menu_button(title, |ui| {
            let room = ui.ctx().content_rect().height() - MENU_MARGIN_POINTS;
            // The bar that scrolls a long menu covers no keys.
            ui.spacing_mut().scroll.floating_allocated_width = MENU_SCROLL_BAR_WIDTH;
            ScrollArea::vertical()
                .max_height(room)
                .min_scrolled_height(room)
                .show(ui, |ui| {
                    let first = self.walk.came == Some(at) && !self.walk.waits;
                    if self.show_one_menu(ui, menu, first) {
                        self.walk.came = None;
                    }
                    if menu == ActionMenu::File {
                        self.recent_menu(ui);
                    }
                });
        });
        let popup = Popup::default_response_id(&button.response);
        self.walk.popups.push(popup);
    }

    /// Shows the layouts to choose from, from right to left.
    fn layouts(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        for (action, id, busy) in [
            (Action::LayoutRecombine, "menu-bar-recombining", BusyTask::Recombining),
            (Action::LayoutSearch, "menu-bar-searching", BusyTask::Searching),
            (Action::LayoutAnnotate, "menu-bar-annotating", BusyTask::Annotating),
        ] {
            let text = InterfaceText::from_id(id).text_in_language(language);
            let layout_button = Button::selectable(self.settings.busy == busy, text);
            let button = ui.add(layout_button).on_hover_ui(|ui| {
                ui.label(action.action_row().name.text_in_language(language));
                ui.weak(self.keys.action_keys_text(action));
            });
            if button.clicked() {
                self.out.send_command(WindowCommand::Do(action));
            }
        }
    }

    /// Shows the entries of a menu. With `first`, gives the keyboard to the first enabled entry and returns `true`.
    fn show_one_menu(&mut self, ui: &mut Ui, menu: ActionMenu, mut first: bool) -> bool {
        let wanted = first;
        let open = self.snapshot.is_some();
        for row in ACTIONS.iter().filter(|row| row.menu == menu) {
            if MENU_GROUP_STARTS.contains(&row.action) {
                ui.separator();
            }
            let locked = row.action.changes_corpus() && self.is_read_only();
            let counts = (open || row.context == ActionContext::Everywhere) && !locked;
            let name = row.name.text_in_language(self.settings.language);
            let button = Button::new(name).shortcut_text(self.keys.action_keys_text(row.action));
            let mut response = ui.add_enabled(counts, button);
            if locked {
                let why = words::READ_ONLY_WHY.text_in_language(self.settings.language);
                response = response.on_disabled_hover_text(why);
            }
            if response.hovered()
                && let Some(what) = self.history_step_description(row.action)
            {
                response = response.on_hover_text(what);
            }
            if counts && std::mem::take(&mut first) {
                response.request_focus();
            }
            if response.clicked() {
                self.out.send_command(WindowCommand::Do(row.action));
            }
        }
        wanted && !first
    }

    /// Returns a description of what Undo or Redo would change in the corpus; `None` for other actions.
    fn history_step_description(&self, action: Action) -> Option<String> {
        if !matches!(action, Action::Undo | Action::Redo) {
            return None;
        }
        let operations = &self.snapshot.as_ref()?.overview.operations;
        let back = action == Action::Undo;
        history::next(operations, back, self.settings.language)
    }

    fn recent_menu(&mut self, ui: &mut Ui) {
        if self.settings.recent.is_empty() {
            return;
        }
        ui.menu_button(
            InterfaceText::from_id("menu-bar-recent").text_in_language(self.settings.language),
            |ui| {
                for path in &self.settings.recent {
                    if ui.button(path.display().to_string()).clicked() {
                        self.out
                            .send_command(WindowCommand::Begin(CorpusOpening::Open(path.clone())));
                    }
                }
            },
        );
    }

    /// Returns the title of the window: the program, the corpus, and whether the corpus is read-only.
    pub(crate) fn window_title(&self) -> String {
        let name = words::START_TITLE.text_in_language(self.settings.language);
        let Some(stem) = self.desk.as_ref().and_then(|desk| desk.path.file_stem()) else {
            return name.to_owned();
        };
        let mut title = format!("{name} · {}", stem.to_string_lossy());
        if self.is_read_only() {
            let locked = words::READ_ONLY.text_in_language(self.settings.language);
            title.push_str(&format!(" ({locked})"));
        }
        title
    }

    pub(crate) fn show_status_line(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        ui.horizontal(|ui| {
            let (Some(desk), Some(snapshot)) = (&self.desk, &self.snapshot) else {
                let reading = self.desk.is_some() || self.beginning.is_some();
                let text = if reading { words::READING } else { words::NOTHING_OPEN };
                ui.weak(text.text_in_language(language));
                self.overlays.notices.show_status_hint(ui, language);
                return;
            };
            let name = desk.path.file_name().unwrap_or_default().to_string_lossy();
            ui.label(name).on_hover_text(desk.path.display().to_string());
            if snapshot.is_read_only() {
                ui.strong(words::READ_ONLY.text_in_language(language))
                    .on_hover_text(words::READ_ONLY_WHY.text_in_language(language));
            }
            let overview = &snapshot.overview;
            let counts: [(&str, &dyn std::fmt::Display); 2] = [
                ("recordings", &overview.recordings.len()),
                ("signs", &overview.signs.len()),
            ];
            ui.weak(fill_text_braces(
                words::STATUS_COUNTS.text_in_language(language),
                &counts,
            ));
            let mode = bar::mode_name(&self.settings.timeline).text_in_language(language);
            ui.weak(fill_text_braces(
                words::STATUS_MODE.text_in_language(language),
                &[("mode", &mode)],
            ));
            for (id, running) in &desk.running {
                if matches!(
                    running.about.lane,
                    WorkLane::Movement | WorkLane::Little | WorkLane::Make | WorkLane::Draft | WorkLane::Measure
                ) {
                    continue;
                }
                ui.separator();
                ui.label(running.about.task.text_in_language(language));
                match running.far.finished_share() {
                    Some(share) => drop(ui.add(ProgressBar::new(share).desired_width(120.0))),
                    None => drop(ui.spinner()),
                }
                if ui.small_button(words::CANCEL.text_in_language(language)).clicked() {
                    self.out.send_command(WindowCommand::Stop(*id));
                }
            }
            self.overlays.notices.show_status_hint(ui, language);
        });
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use chereme_corpus::Corpus;
    use eframe::egui::{Key, Modifiers};
    use egui_kittest::Harness;
    use egui_kittest::kittest::{NodeT, Queryable};

    use super::*;
    use crate::StudioOptions;

    #[test]
    fn a_read_only_corpus_explains_why_nothing_can_be_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("locked.chereme");
        drop(Corpus::create_corpus(&path, "A").expect("made"));
        let studio = Studio::new(StudioOptions {
            corpus: Some(path),
            ..StudioOptions::default()
        });
        let mut window = Harness::builder()
            .with_size([1280.0, 900.0])
            .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), studio);
        for _ in 0..12_000 {
            window.step();
            if window.state().is_idle() && window.state().desk.is_some() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        assert!(window.query_by_label("read only").is_none());
        assert_eq!(window.state().window_title(), "Chereme · locked");
        let snapshot = window.state_mut().snapshot.take();
        let mut locked = snapshot.expect("a snapshot");
        Arc::make_mut(&mut locked.overview).read_only = true;
        window.state_mut().take_snapshot(locked, true);
        window.run_steps(2);
        assert!(window.query_by_label("read only").is_some());
        assert_eq!(window.state().window_title(), "Chereme · locked (read only)");
        let opened = words::READ_ONLY_OPENED.text_in_language(crate::InterfaceLanguage::English);
        assert!(window.query_by_label_contains(opened).is_some());
        window.get_by_label("Tier").click();
        window.run_steps(3);
        let adding = window.get_by_label_contains("Add the usual tiers");
        assert!(adding.accesskit_node().is_disabled());
        window.key_press(Key::Escape);
        window.run_steps(2);
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.run_steps(3);
        let why = words::READ_ONLY_WHY.text_in_language(crate::InterfaceLanguage::English);
        assert!(window.query_by_label_contains(why).is_some());
    }

    #[test]
    fn arrow_keys_walk_from_menu_to_menu() {
        let studio = Studio::new(StudioOptions::default());
        let mut window = Harness::builder()
            .with_size([1280.0, 900.0])
            .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), studio);
        window.run_steps(3);
        window.get_by_label("File").click();
        window.run_steps(3);
        assert!(window.query_by_label_contains("Quit").is_some());
        window.key_press(Key::ArrowLeft);
        window.run_steps(4);
        assert!(window.query_by_label_contains("Quit").is_none());
        let first = window.get_by_label_contains("Command palette");
        assert!(first.accesskit_node().is_focused());
        window.key_press(Key::ArrowRight);
        window.run_steps(4);
        assert!(window.query_by_label_contains("Quit").is_some());
        let mut first = window.query_all_by_label_contains("Open the starter corpus");
        assert!(first.any(|it| it.accesskit_node().is_focused()));
    }
}
