//! The menu bar above, and the status line below.

use eframe::egui::{Align, Button, Layout, MenuBar, ProgressBar, ScrollArea, Ui};

use crate::action::{ACTIONS, Action, Context, Menu};
use crate::app::Studio;
use crate::command::Command;
use crate::layout::Busy;
use crate::panes::history::data as history;
use crate::panes::timeline::bar;
use crate::words::{fill, shell as words};
use crate::work::Lane;
use crate::work::begin::Begin;

/// What a menu leaves free of the window's height.
const MARGIN: f32 = 60.0;
/// The room that the three layouts want beside the menus.
const LAYOUTS: f32 = 280.0;

/// The entries that begin a group of a menu.
const GROUPS: [Action; 19] = [
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
    pub(crate) fn menus(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        MenuBar::new().ui(ui, |ui| {
            for (menu, title) in Menu::ALL {
                ui.menu_button(title.of(language), |ui| {
                    let room = ui.ctx().content_rect().height() - MARGIN;
                    ScrollArea::vertical()
                        .max_height(room)
                        .min_scrolled_height(room)
                        .show(ui, |ui| {
                            self.menu(ui, menu);
                            if menu == Menu::File {
                                self.recent_menu(ui);
                            }
                        });
                });
            }
            if self.snapshot.is_some() && ui.available_width() > LAYOUTS {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| self.layouts(ui));
            }
        });
    }

    /// Shows what one can be busy with, from right to left.
    fn layouts(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        for (action, text, busy) in [
            (
                Action::LayoutRecombine,
                words::RECOMBINING,
                Busy::Recombining,
            ),
            (Action::LayoutSearch, words::SEARCHING, Busy::Searching),
            (Action::LayoutAnnotate, words::ANNOTATING, Busy::Annotating),
        ] {
            let button = Button::selectable(self.settings.busy == busy, text.of(language));
            let button = ui.add(button).on_hover_ui(|ui| {
                ui.label(action.row().name.of(language));
                ui.weak(self.keys.text(action));
            });
            if button.clicked() {
                self.out.send(Command::Do(action));
            }
        }
    }

    fn menu(&mut self, ui: &mut Ui, menu: Menu) {
        let open = self.snapshot.is_some();
        for row in ACTIONS.iter().filter(|row| row.menu == menu) {
            if GROUPS.contains(&row.action) {
                ui.separator();
            }
            let locked = row.action.changes() && self.is_read_only();
            let counts = (open || row.context == Context::Everywhere) && !locked;
            let name = row.name.of(self.settings.language);
            let button = Button::new(name).shortcut_text(self.keys.text(row.action));
            let mut response = ui.add_enabled(counts, button);
            if locked {
                let why = words::READ_ONLY_WHY.of(self.settings.language);
                response = response.on_disabled_hover_text(why);
            }
            if response.hovered()
                && let Some(what) = self.steps(row.action)
            {
                response = response.on_hover_text(what);
            }
            if response.clicked() {
                self.out.send(Command::Do(row.action));
            }
        }
    }

    /// Returns what a step back or forward would change in the corpus.
    fn steps(&self, action: Action) -> Option<String> {
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
        ui.menu_button(words::RECENT.of(self.settings.language), |ui| {
            for path in &self.settings.recent {
                if ui.button(path.display().to_string()).clicked() {
                    self.out.send(Command::Begin(Begin::Open(path.clone())));
                }
            }
        });
    }

    /// Returns what the window is called: the program, the corpus, and that it may only be read.
    pub(crate) fn title(&self) -> String {
        let name = words::START_TITLE.of(self.settings.language);
        let Some(stem) = self.desk.as_ref().and_then(|desk| desk.path.file_stem()) else {
            return name.to_owned();
        };
        let mut title = format!("{name} · {}", stem.to_string_lossy());
        if self.is_read_only() {
            let locked = words::READ_ONLY.of(self.settings.language);
            title.push_str(&format!(" ({locked})"));
        }
        title
    }

    pub(crate) fn status(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        ui.horizontal(|ui| {
            let (Some(desk), Some(snapshot)) = (&self.desk, &self.snapshot) else {
                let reading = self.desk.is_some() || self.beginning.is_some();
                let text = if reading {
                    words::READING
                } else {
                    words::NOTHING_OPEN
                };
                ui.weak(text.of(language));
                self.overlays.notices.line(ui, language);
                return;
            };
            let name = desk.path.file_name().unwrap_or_default().to_string_lossy();
            ui.label(name)
                .on_hover_text(desk.path.display().to_string());
            if snapshot.is_read_only() {
                ui.strong(words::READ_ONLY.of(language))
                    .on_hover_text(words::READ_ONLY_WHY.of(language));
            }
            let overview = &snapshot.overview;
            let counts: [(&str, &dyn std::fmt::Display); 2] = [
                ("recordings", &overview.recordings.len()),
                ("signs", &overview.signs.len()),
            ];
            ui.weak(fill(words::STATUS_COUNTS.of(language), &counts));
            let mode = bar::mode_name(&self.settings.timeline).of(language);
            ui.weak(fill(words::STATUS_MODE.of(language), &[("mode", &mode)]));
            for (id, running) in &desk.running {
                if matches!(
                    running.lane,
                    Lane::Movement | Lane::Little | Lane::Make | Lane::Draft | Lane::Measure
                ) {
                    continue;
                }
                ui.separator();
                ui.label(running.task.of(language));
                match running.far.share() {
                    Some(share) => drop(ui.add(ProgressBar::new(share).desired_width(120.0))),
                    None => drop(ui.spinner()),
                }
                if ui.small_button(words::CANCEL.of(language)).clicked() {
                    self.out.send(Command::Stop(*id));
                }
            }
            self.overlays.notices.line(ui, language);
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
    use crate::Options;

    #[test]
    fn what_may_only_be_read_says_so_and_why_nothing_can_be_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("locked.chereme");
        drop(Corpus::create(&path, "A").expect("made"));
        let studio = Studio::new(Options {
            corpus: Some(path),
            ..Options::default()
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
        assert_eq!(window.state().title(), "Chereme · locked");
        let snapshot = window.state_mut().snapshot.take();
        let mut locked = snapshot.expect("a snapshot");
        Arc::make_mut(&mut locked.overview).read_only = true;
        window.state_mut().take_snapshot(locked, true);
        window.run_steps(2);
        assert!(window.query_by_label("read only").is_some());
        assert_eq!(window.state().title(), "Chereme · locked (read only)");
        let opened = words::READ_ONLY_OPENED.of(crate::Language::English);
        assert!(window.query_by_label_contains(opened).is_some());
        window.get_by_label("Tier").click();
        window.run_steps(3);
        let adding = window.get_by_label_contains("Add the usual tiers");
        assert!(adding.accesskit_node().is_disabled());
        window.key_press(Key::Escape);
        window.run_steps(2);
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.run_steps(3);
        let why = words::READ_ONLY_WHY.of(crate::Language::English);
        assert!(window.query_by_label_contains(why).is_some());
    }
}
