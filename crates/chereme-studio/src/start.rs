//! The page without a corpus: the starter corpus, recent ones, a path, a folder to import.

use std::path::PathBuf;

use eframe::egui::{Button, ProgressBar, RichText, ScrollArea, TextEdit, Ui, vec2};

use crate::action::Action;
use crate::app::Studio;
use crate::command::Command;
use crate::words::{Text, shell as words};
use crate::work::begin::Begin;

/// What is typed on the page.
#[derive(Debug, Default)]
pub(crate) struct Start {
    path: String,
}

/// Returns what a typed path can be used for: open it, make it, or import it.
pub(crate) fn uses(path: &str, is_file: bool, is_folder: bool) -> [bool; 3] {
    let typed = !path.trim().is_empty();
    [
        typed && is_file,
        typed && !is_file && !is_folder,
        typed && is_folder,
    ]
}

/// Whether it can be used now, what it is called, a hint, and what it begins.
type Offer = (bool, Text, Text, fn(PathBuf) -> Begin);

const WIDE: f32 = 560.0;

impl Studio {
    pub(crate) fn start_page(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let width = ui.available_width().min(WIDE);
            let left = (ui.available_width() - width) / 2.0;
            ui.horizontal(|ui| {
                ui.add_space(left.max(0.0));
                ui.vertical(|ui| {
                    ui.set_width(width);
                    ui.add_space(56.0);
                    ui.label(
                        RichText::new(words::START_TITLE.of(language))
                            .size(34.0)
                            .strong(),
                    );
                    ui.label(RichText::new(words::START_LEAD.of(language)).size(16.0));
                    ui.add_space(24.0);
                    if self.beginning.is_some() {
                        self.beginning_page(ui);
                        return;
                    }
                    self.starter_part(ui);
                    ui.add_space(20.0);
                    self.path_part(ui);
                    ui.add_space(20.0);
                    self.recent_part(ui);
                });
            });
        });
    }

    fn beginning_page(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let Some(beginning) = &self.beginning else {
            return;
        };
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(words::TASK_OPENING.of(language));
            ui.weak(&beginning.far.task);
        });
        if let Some(share) = beginning.far.share() {
            ui.add(ProgressBar::new(share));
        }
        if ui.button(words::CANCEL.of(language)).clicked() {
            self.out.send(Command::StopBeginning);
        }
    }

    fn starter_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let text = RichText::new(words::START_STARTER.of(language)).size(16.0);
        let button = ui.add(Button::new(text).min_size(vec2(260.0, 36.0)));
        if button.clicked() {
            self.out.send(Command::Do(Action::OpenStarter));
        }
        ui.weak(words::START_STARTER_HINT.of(language));
    }

    fn path_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        let label = ui.label(words::START_PATH.of(language));
        let field = TextEdit::singleline(&mut self.start.path).desired_width(f32::INFINITY);
        ui.add(field).labelled_by(label.id);
        let path = PathBuf::from(self.start.path.trim());
        let [open, make, import] = uses(&self.start.path, path.is_file(), path.is_dir());
        let offers: [Offer; 3] = [
            (open, words::START_OPEN, words::START_OPEN_HINT, Begin::Open),
            (make, words::START_NEW, words::START_OPEN_HINT, Begin::New),
            (
                import,
                words::START_IMPORT,
                words::START_IMPORT_HINT,
                Begin::Folder,
            ),
        ];
        ui.horizontal(|ui| {
            for (can, text, hint, begin) in offers {
                let button = ui.add_enabled(can, Button::new(text.of(language)));
                let hint = hint.of(language);
                if button
                    .on_hover_text(hint)
                    .on_disabled_hover_text(hint)
                    .clicked()
                {
                    self.out.send(Command::Begin(begin(path.clone())));
                }
            }
        });
        ui.weak(words::START_DROP.of(language));
    }

    fn recent_part(&mut self, ui: &mut Ui) {
        let language = self.settings.language;
        ui.strong(words::RECENT.of(language));
        if self.settings.recent.is_empty() {
            ui.weak(words::START_NONE.of(language));
        }
        for path in &self.settings.recent {
            ui.horizontal(|ui| {
                let name = path.display().to_string();
                if path.is_file() {
                    if ui.link(name).clicked() {
                        self.out.send(Command::Begin(Begin::Open(path.clone())));
                    }
                } else {
                    ui.weak(name);
                    ui.weak(words::START_GONE.of(language));
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_offers_what_can_be_done_with_it() {
        assert_eq!(uses("", false, true), [false; 3]);
        assert_eq!(uses("a.chereme", true, false), [true, false, false]);
        assert_eq!(uses("new", false, false), [false, true, false]);
        assert_eq!(uses("folder", false, true), [false, false, true]);
    }
}
