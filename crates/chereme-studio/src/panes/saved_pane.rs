//! A path with completions and a chooser, and a file that is written from a pane.

use std::path::PathBuf;

use eframe::egui::{Button, Id, Ui};

use super::complete_pane::CompletionLine;
use super::import::PathCompletions;
use crate::command::{ChooserPurpose, WindowCommand};
use crate::context::PaneInput;
use crate::words::{InterfaceText, fill_text_braces, studies_words as words};
use crate::work::WorkId;

/// A path to which something is written, and the work that writes it.
#[derive(Default)]
pub(super) struct SavedTo {
    pub(super) to: String,
    /// Whether a path was proposed; one that is emptied stays empty.
    proposed: bool,
    paths: PathCompletions,
    pub(super) saving: Option<WorkId>,
    /// The file that is being written.
    asked: Option<PathBuf>,
    /// The file that was written, which may be written again.
    own: Option<PathBuf>,
}

impl SavedTo {
    /// Shows the path and the button that writes; returns the path to write, and whether it may be replaced.
    pub(super) fn show_save_path(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        file: SavedFile,
        proposed: &str,
    ) -> Option<(PathBuf, bool)> {
        if self.to.is_empty() && !std::mem::replace(&mut self.proposed, true) {
            self.to = seen.path_beside_corpus(proposed).display().to_string();
        }
        let field = PathField {
            name: file.name,
            hint: "",
            chooser: file.chooser,
        };
        field.show_path_line(ui, seen, &mut self.paths, &mut self.to);
        let ready = !self.to.trim().is_empty() && !seen.is_running(self.saving);
        let save_button = ui.add_enabled(ready, Button::new(seen.say_text(file.button)));
        let save = save_button.on_disabled_hover_text(seen.say_text(words::NEEDS_FILE));
        if let Some(path) = &self.own {
            ui.label(fill_text_braces(
                seen.say_text(words::SAVED),
                &[("path", &path.display())],
            ));
        }
        let to = PathBuf::from(self.to.trim());
        let force = self.own.as_ref() == Some(&to);
        save.clicked().then(|| {
            self.asked = Some(to.clone());
            (to, force)
        })
    }

    /// Notes that the file is written.
    pub(super) fn mark_file_written(&mut self) {
        self.own = self.asked.take();
    }
}

/// A file that a pane writes: its name, the text of the button that writes it, and the chooser of its path.
#[derive(Clone, Copy)]
pub(super) struct SavedFile {
    pub(super) name: InterfaceText,
    pub(super) button: InterfaceText,
    pub(super) chooser: ChooserPurpose,
}

/// A field for a path: its name, the hint in the empty field, and the chooser that fills it.
pub(super) struct PathField<'a> {
    pub(super) name: InterfaceText,
    pub(super) hint: &'a str,
    pub(super) chooser: ChooserPurpose,
}

impl PathField<'_> {
    /// Shows the field with completions, and a button that opens the file chooser.
    pub(super) fn show_path_line(
        &self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        paths: &mut PathCompletions,
        text: &mut String,
    ) {
        ui.weak(seen.say_text(self.name));
        let line = CompletionLine {
            name: seen.say_text(self.name),
            hint: self.hint,
            ..CompletionLine::default()
        };
        paths.show_path_field(ui, Id::unique(("study path", self.name.text_id())), line, text);
        if ui.button(seen.say_text(words::CHOOSE)).clicked() {
            seen.send_command(WindowCommand::Choose(self.chooser));
        }
    }
}
