//! A field for a path, with completions.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use chereme_corpus::paths_like;
use eframe::egui::{Id, Ui};

use crate::panes::complete_pane::{CompletionLine, CompletionOutcome, fitting_candidates, show_completion_line};

/// The requested completions of a typed path. Folders are read on a thread of their own, as they need no corpus and may
/// be slow.
#[derive(Default)]
pub(crate) struct PathCompletions {
    of: String,
    asked: Option<Receiver<Vec<String>>>,
    all: Vec<String>,
}

impl PathCompletions {
    /// Shows the field of a path with completions.
    pub(crate) fn show_path_field(
        &mut self,
        ui: &mut Ui,
        id: Id,
        line: CompletionLine<'_>,
        text: &mut String,
    ) -> CompletionOutcome {
        let folder = |text: &str| text.rfind('/').map(|at| text[..=at].to_owned());
        let focused = ui.memory(|memory| memory.has_focus(id));
        if focused
            && let Some(folder) = folder(text)
            && folder != self.of
        {
            self.request_folder_contents(ui, folder);
        }
        self.receive_folder_contents();
        let candidates = |typed: &str| fitting_candidates(self.all.iter().map(String::as_str), typed);
        let line = CompletionLine {
            // A folder is a valid path by itself.
            takes_only: false,
            ..line
        };
        show_completion_line(ui, id, line, text, &candidates)
    }

    /// Begins to read a folder.
    fn request_folder_contents(&mut self, ui: &Ui, folder: String) {
        let (sender, found) = channel();
        let (ctx, typed) = (ui.ctx().clone(), folder.clone());
        std::thread::spawn(move || {
            // The field may have another folder by then.
            let _ = sender.send(paths_like(&typed));
            ctx.request_repaint();
        });
        self.asked = Some(found);
        self.of = folder;
        self.all.clear();
    }

    /// Takes the contents of a folder once they are read.
    fn receive_folder_contents(&mut self) {
        match self.asked.as_ref().map(Receiver::try_recv) {
            Some(Ok(all)) => (self.all, self.asked) = (all, None),
            Some(Err(TryRecvError::Disconnected)) => self.asked = None,
            Some(Err(TryRecvError::Empty)) | None => {}
        }
    }
}
