//! A path with completions and a chooser, and a file that is written from a pane.

use std::path::PathBuf;

use eframe::egui::{Button, Id, Ui};

use super::complete::Line;
use super::import::Paths;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::file_dialogs::Choose;
use crate::words::{Text, fill, studies as words};
use crate::work::WorkId;

/// A path to which something is written, and the work that writes it.
#[derive(Default)]
pub(super) struct SavedTo {
    pub(super) to: String,
    /// Whether a path was proposed; one that is emptied stays empty.
    proposed: bool,
    paths: Paths,
    pub(super) saving: Option<WorkId>,
    /// The file that is being written.
    asked: Option<PathBuf>,
    /// The file that was written, which may be written again.
    own: Option<PathBuf>,
}

impl SavedTo {
    /// Shows the path and the button that writes; returns the path to write, and whether it may be replaced.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        (name, button, what): (Text, Text, Choose),
        proposed: &str,
        out: &mut Outbox,
    ) -> Option<(PathBuf, bool)> {
        if self.to.is_empty() && !std::mem::replace(&mut self.proposed, true) {
            self.to = seen.beside(proposed).display().to_string();
        }
        let own = (&mut self.paths, &mut self.to);
        path_field(ui, seen, (name, ""), own, what, out);
        let ready = !self.to.trim().is_empty() && !seen.is_running(self.saving);
        let save = ui.add_enabled(ready, Button::new(seen.say(button)));
        let save = save.on_disabled_hover_text(seen.say(words::NEEDS_FILE));
        if let Some(path) = &self.own {
            ui.label(fill(seen.say(words::SAVED), &[("path", &path.display())]));
        }
        let to = PathBuf::from(self.to.trim());
        let force = self.own.as_ref() == Some(&to);
        save.clicked().then(|| {
            self.asked = Some(to.clone());
            (to, force)
        })
    }

    /// Notes that the file is written.
    pub(super) fn written(&mut self) {
        self.own = self.asked.take();
    }
}

/// Shows a field for a path with completions, and a button that opens the file chooser.
pub(super) fn path_field(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    (name, hint): (Text, &str),
    (paths, text): (&mut Paths, &mut String),
    what: Choose,
    out: &mut Outbox,
) {
    ui.weak(seen.say(name));
    let line = Line {
        name: seen.say(name),
        hint,
        ..Line::default()
    };
    paths.show(ui, Id::unique(("study path", name.en)), line, text);
    if ui.button(seen.say(words::CHOOSE)).clicked() {
        out.send(Command::Choose(what));
    }
}
