//! Sharing the contents of the stage with one click: as a film, an animation, a picture or a body, in a file next to
//! the corpus.

use std::path::{Path, PathBuf};

use chereme_corpus::{CorpusAddress, PictureOptions, RowName};
use eframe::egui::Context;

use super::Studio;
use crate::action::Action;
use crate::command::WindowCommand;
use crate::overlay::overlay_export::{ExportObject, file_name};
use crate::panes::recombine::selected_token;
use crate::words::stage_words as words;
use crate::work::CorpusJob;
use crate::work::exchange::{self, SharedMovement};

/// Height of a shared film, in pixels.
const SHARED_FILM_HEIGHT_PIXELS: usize = 720;

impl Studio {
    /// Writes the contents of the stage: generated movement, else the selected sign, else the recording.
    pub(crate) fn share_stage_contents(&mut self, action: Action, ctx: &Context) {
        match self.shared_contents_job(action, ctx) {
            Ok(job) => {
                self.out.request_work(job);
            }
            Err(text) => self.out.send_command(WindowCommand::Cannot(text)),
        }
    }

    fn shared_contents_job(&self, action: Action, ctx: &Context) -> Result<CorpusJob, crate::words::InterfaceText> {
        let nothing = words::SHARE_NOTHING;
        let corpus = self.shown_corpus_path().ok_or(nothing)?;
        let ending = match action {
            Action::ShareFilm => "mp4",
            Action::ShareGif => "gif",
            Action::SharePicture => "png",
            _ => "glb",
        };
        let made = self.shown.made.as_ref().map(|showing| showing.made.clone());
        let (what, name) = match made {
            Some(made) => {
                let name = ExportObject::Recording(0, made.name.clone());
                (SharedMovement::Made(made), name)
            }
            None => {
                let seen = self.pane_input(ctx).ok_or(nothing)?;
                let recording = seen.shown.recording.ok_or(nothing)?;
                if !seen.reel.has_movement() {
                    return Err(nothing);
                }
                // Without a selection the token under the playhead would be a surprise: the recording is meant.
                let selected = seen.shown.selected_annotation().is_some() || seen.shown.span.is_some();
                match selected_token(&seen).filter(|_| selected) {
                    Some((token, gloss)) => (
                        SharedMovement::Stored(CorpusAddress::Token(token)),
                        ExportObject::Token(token, gloss),
                    ),
                    None => {
                        let glance = seen.snapshot.recording_glance(recording).ok_or(nothing)?;
                        let name = glance.row.name.clone();
                        let address = CorpusAddress::Recording(RowName::Number(recording));
                        (
                            SharedMovement::Stored(address),
                            ExportObject::Recording(recording, name),
                        )
                    }
                }
            }
        };
        let to = free_share_path(corpus, &file_name(&name, corpus, Some(ending)));
        // Exports read the store, and this movement is not in it.
        if ending == "glb" && matches!(what, SharedMovement::Made(_)) {
            return Err(words::SHARE_STORE);
        }
        let options = PictureOptions {
            height: (ending == "mp4").then_some(SHARED_FILM_HEIGHT_PIXELS),
            captions: ending != "png",
            ..PictureOptions::default()
        };
        Ok(exchange::share_movement_job(what, to, options))
    }
}

/// Returns a path next to the corpus that no file has yet: `BOL.mp4`, else `BOL 2.mp4` and so on.
fn free_share_path(corpus: &Path, name: &str) -> PathBuf {
    let folder = corpus.parent().unwrap_or(Path::new(""));
    let first = folder.join(name);
    let name = Path::new(name);
    let stem = name.file_stem().unwrap_or_default().to_string_lossy();
    let ending = name.extension().unwrap_or_default().to_string_lossy();
    let others = (2..10_000).map(|number| folder.join(format!("{stem} {number}.{ending}")));
    let mut all = std::iter::once(first.clone()).chain(others);
    all.find(|path| !path.exists()).unwrap_or(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn existing_files_are_never_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = folder.path().join("c.chereme");
        let name = |expected: &str| {
            assert_eq!(free_share_path(&corpus, "BOL.mp4"), folder.path().join(expected));
            std::fs::write(folder.path().join(expected), "").expect("written");
        };
        name("BOL.mp4");
        name("BOL 2.mp4");
        name("BOL 3.mp4");
    }
}
