//! A field for a path, with completions.

use eframe::egui::{Id, Ui};

use crate::context::Outbox;
use crate::panes::complete::{Line, Typed, complete, fitting};
use crate::work::{Ended, Outcome, WorkId, exchange};

/// The requested completions of a typed path.
#[derive(Default)]
pub(crate) struct Paths {
    of: String,
    asked: Option<WorkId>,
    all: Vec<String>,
}

impl Paths {
    /// Shows the field of a path with completions.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        id: Id,
        line: Line<'_>,
        text: &mut String,
        out: &mut Outbox,
    ) -> Typed {
        let folder = |text: &str| text.rfind('/').map(|at| text[..=at].to_owned());
        let focused = ui.memory(|memory| memory.has_focus(id));
        if focused
            && let Some(folder) = folder(text)
            && folder != self.of
        {
            self.asked = Some(out.work(exchange::paths(folder.clone())));
            self.of = folder;
            self.all.clear();
        }
        let candidates = |typed: &str| fitting(self.all.iter().map(String::as_str), typed);
        let line = Line {
            // A folder is a valid path by itself.
            takes_only: false,
            ..line
        };
        complete(ui, id, line, text, &candidates)
    }

    pub(crate) fn hear(&mut self, id: WorkId, ended: &Ended) {
        if self.asked.take_if(|asked| *asked == id).is_some()
            && let Ok(Outcome::Paths(all)) = ended
        {
            self.all.clone_from(all);
        }
    }
}
