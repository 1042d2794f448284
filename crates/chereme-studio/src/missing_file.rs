//! The file of the open corpus that is missing: notices, a copy, and a window that stays open.

use std::path::PathBuf;

use eframe::egui::{Context, ViewportCommand};

use crate::app::Studio;
use crate::command::Command;
use crate::file_dialogs::Choose;
use crate::overlay::notices::NoticeOffer;
use crate::words::{fill, shell};
use crate::work::begin::Begin;

impl Studio {
    /// Reports at once if the file of the corpus is missing, and how to save a complete copy.
    pub(crate) fn stands(&mut self, stands: bool) {
        self.gone = !stands;
        self.close_asked = false;
        let language = self.settings.language;
        self.overlays.notices.withdraw();
        if stands {
            let text = shell::BACK_AGAIN.of(language);
            return self.overlays.notices.hint(text);
        }
        let Some(path) = self.corpus().cloned() else {
            return;
        };
        let words = shell::GONE.of(language);
        let text = fill(words, &[("path", &path.display())]);
        let mut offers = vec![(shell::SAVE_COPY, NoticeOffer::Choose(Choose::Copy))];
        if !path.exists() && path.parent().is_some_and(std::path::Path::is_dir) {
            let back = (shell::PUT_BACK, NoticeOffer::SaveCopy(path));
            offers.insert(0, back);
        }
        let remedy = shell::GONE_REMEDY.of(language);
        self.overlays.notices.offer(text, remedy, offers);
    }

    /// Keeps the window open if it is to be closed while the file of the corpus is missing; the second time it closes.
    pub(crate) fn stay_with_the_corpus(&mut self, ctx: &Context) {
        let closes = ctx.input(|input| input.viewport().close_requested());
        if closes && self.gone && self.desk.is_some() && !self.close_asked {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.stands(false);
            self.close_asked = true;
            let words = shell::GONE_CLOSE.of(self.settings.language);
            self.overlays.notices.warn(words);
        }
    }

    /// Continues in the copy that was saved, or reports why it could not be saved.
    pub(crate) fn copied(&mut self, saved: Result<PathBuf, chereme_corpus::Error>) {
        let language = self.settings.language;
        match saved {
            Ok(path) => {
                self.overlays.notices.withdraw();
                let words = shell::COPY_SAVED.of(language);
                let text = fill(words, &[("path", &path.display())]);
                self.overlays.notices.hint(text);
                self.out.send(Command::Begin(Begin::Open(path)));
            }
            Err(error) => {
                let task = Some(shell::TASK_COPY);
                self.overlays.notices.trouble(&error, task, language);
            }
        }
    }
}
