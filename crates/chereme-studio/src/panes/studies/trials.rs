//! The trials of a plan, and the clip of one on the stage.

use std::sync::Arc;

use chereme_corpus::study::StudyClip;
use chereme_corpus::study::plan::Plan;
use chereme_sign::Handedness;
use eframe::egui::{ScrollArea, Ui};

use super::{Studies, data};
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::model::generated::GeneratedClip;
use crate::panes::list_row;
use crate::words::{fill, studies as words};
use crate::work::{WorkId, studying};

/// The clip of a trial that the stage shows next.
#[derive(Default)]
pub(super) struct Clip {
    pub(super) making: Option<WorkId>,
    /// The name and the text of the clip that was asked for last.
    of: Option<(String, String)>,
    pub(super) made: Option<Arc<StudyClip>>,
}

impl Clip {
    /// Returns whether this clip was asked for last.
    pub(super) fn is(&self, name: &str, text: &str) -> bool {
        let of = self.of.as_ref();
        of.is_some_and(|it| (it.0.as_str(), it.1.as_str()) == (name, text))
    }
}

impl Studies {
    /// Asks for the clip of a trial, which is then shown on the stage.
    pub(super) fn show_clip(&mut self, name: &str, text: &str, out: &mut Outbox) {
        if let Some(old) = self.clip.making.take() {
            out.send(Command::Stop(old));
        }
        self.wrong.clear();
        self.clip = Clip {
            making: Some(out.work(studying::clip(text.to_owned()))),
            of: Some((name.to_owned(), text.to_owned())),
            made: None,
        };
    }

    /// Shows the clip on the stage once it is made.
    pub(super) fn give_clip(&mut self, out: &mut Outbox) {
        let Some((made, (name, _))) = self.clip.made.take().zip(self.clip.of.clone()) else {
            return;
        };
        let clip = GeneratedClip {
            name,
            token: None,
            clip: made.clip.clone(),
            faces: made.faces.clone(),
            anatomy: made.anatomy.clone(),
            handedness: Handedness::default(),
            parts: Vec::new(),
        };
        out.send(Command::Made(Some(Arc::new(clip))));
        out.send(Command::Look);
    }

    /// Shows that a clip is being made.
    pub(super) fn making(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if seen.is_running(self.clip.making) {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.weak(seen.say(words::MAKING));
            });
        }
    }

    /// Shows the trials of a plan; a click shows the clip of one on the stage.
    pub(super) fn trials(
        &mut self,
        ui: &mut Ui,
        seen: &PaneInput<'_>,
        plan: &Plan,
        out: &mut Outbox,
    ) {
        let rows = data::trials(plan, seen.language);
        ui.weak(fill(seen.say(words::TRIALS), &[("n", &rows.len())]));
        self.making(ui, seen);
        let height = ui.spacing().interact_size.y * 1.9;
        let whole = height + ui.spacing().item_spacing.y;
        let room = (whole * rows.len() as f32).min(320.0);
        let mut picked = None;
        ScrollArea::vertical()
            .id_salt("trials")
            .max_height(room)
            .auto_shrink([false, true])
            .show_rows(ui, height, rows.len(), |ui, range| {
                for row in &rows[range] {
                    let chosen = self.clip.is(&row.name, &row.clip);
                    if list_row(ui, height, chosen, &row.name, &row.about).clicked() {
                        picked = Some(row);
                    }
                }
            });
        if let Some(row) = picked {
            self.show_clip(&row.name, &row.clip, out);
        }
    }
}
