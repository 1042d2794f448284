//! The file of the open corpus that is missing: notices, a copy, and a window that stays open.

use std::path::PathBuf;

use eframe::egui::{Context, ViewportCommand};

use super::Studio;
use crate::command::{ChooserPurpose, WindowCommand};
use crate::overlay::notices::NoticeOffer;
use crate::words::{fill_text_braces, shell};
use crate::work::begin::CorpusOpening;

impl Studio {
    /// Reports at once if the file of the corpus is missing, and how to save a complete copy.
    pub(crate) fn report_corpus_file_standing(&mut self, stands: bool) {
        self.gone = !stands;
        self.close_asked = false;
        let language = self.settings.language;
        self.overlays.notices.withdraw_offers();
        if stands {
            let text = shell::BACK_AGAIN.text_in_language(language);
            return self.overlays.notices.add_hint(text);
        }
        let Some(path) = self.shown_corpus_path().cloned() else {
            return;
        };
        let words = shell::GONE.text_in_language(language);
        let text = fill_text_braces(words, &[("path", &path.display())]);
        let mut offers = vec![(shell::SAVE_COPY, NoticeOffer::Choose(ChooserPurpose::Copy))];
        if !path.exists() && path.parent().is_some_and(std::path::Path::is_dir) {
            let back = (shell::PUT_BACK, NoticeOffer::SaveCopy(path));
            offers.insert(0, back);
        }
        let remedy = shell::GONE_REMEDY.text_in_language(language);
        self.overlays.notices.offer_failure_remedies(text, remedy, offers);
    }

    /// Keeps the window open if it is to be closed while the file of the corpus is missing; the second time it closes.
    pub(crate) fn stay_with_the_corpus(&mut self, ctx: &Context) {
        let closes = ctx.input(|input| input.viewport().close_requested());
        if closes && self.gone && self.desk.is_some() && !self.close_asked {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.report_corpus_file_standing(false);
            self.close_asked = true;
            let words = shell::GONE_CLOSE.text_in_language(self.settings.language);
            self.overlays.notices.add_warning(words);
        }
    }

    /// Continues in the copy that was saved, or reports why it could not be saved.
    pub(crate) fn continue_in_saved_copy(&mut self, saved: Result<PathBuf, chereme_corpus::CorpusError>) {
        let language = self.settings.language;
        match saved {
            Ok(path) => {
                self.overlays.notices.withdraw_offers();
                let words = shell::COPY_SAVED.text_in_language(language);
                let text = fill_text_braces(words, &[("path", &path.display())]);
                self.overlays.notices.add_hint(text);
                self.out.send_command(WindowCommand::Begin(CorpusOpening::Open(path)));
            }
            Err(error) => {
                let task = Some(shell::TASK_COPY);
                self.overlays.notices.report_work_failure(&error, task, language);
            }
        }
    }
}
