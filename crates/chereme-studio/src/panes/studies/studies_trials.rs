//! The trials of a plan, and the clip of one on the stage.

use std::sync::Arc;

use chereme_corpus::study::StudyClip;
use chereme_corpus::study::study_plan::StudyPlan;
use chereme_sign::SignerHandedness;
use eframe::egui::{ScrollArea, Ui};

use super::{StudiesPane, studies_data};
use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::model::generated::GeneratedClip;
use crate::panes::list_row;
use crate::words::{fill_text_braces, studies_words as words};
use crate::work::{WorkId, studying};

/// The clip of a trial that the stage shows next.
#[derive(Default)]
pub(super) struct RequestedTrialClip {
    pub(super) making: Option<WorkId>,
    /// The name and the text of the clip that was asked for last.
    of: Option<(String, String)>,
    pub(super) made: Option<Arc<StudyClip>>,
}

impl RequestedTrialClip {
    /// Returns whether this clip was asked for last.
    pub(super) fn is_requested_clip(&self, name: &str, text: &str) -> bool {
        let of = self.of.as_ref();
        of.is_some_and(|pair| (pair.0.as_str(), pair.1.as_str()) == (name, text))
    }
}

impl StudiesPane {
    /// Asks for the clip of a trial, which is then shown on the stage.
    pub(super) fn show_clip(&mut self, name: &str, text: &str, out: &CommandOutbox) {
        if let Some(old) = self.clip.making.take() {
            out.send_command(WindowCommand::Stop(old));
        }
        self.wrong.clear();
        self.clip = RequestedTrialClip {
            making: Some(out.request_work(studying::make_trial_clip_job(text.to_owned()))),
            of: Some((name.to_owned(), text.to_owned())),
            made: None,
        };
    }

    /// Shows the clip on the stage once it is made.
    pub(super) fn give_clip(&mut self, out: &CommandOutbox) {
        let Some((made, (name, recipe))) = self.clip.made.take().zip(self.clip.of.clone()) else {
            return;
        };
        let clip = GeneratedClip {
            name,
            recipe,
            token: None,
            clip: made.clip.clone(),
            faces: made.faces.clone(),
            anatomy: made.anatomy.clone(),
            handedness: SignerHandedness::default(),
            parts: Vec::new(),
        };
        out.send_command(WindowCommand::Made(Some(Arc::new(clip))));
        out.send_command(WindowCommand::Look);
    }

    /// Shows that a clip is being made.
    pub(super) fn show_clip_progress(&self, ui: &mut Ui, seen: &PaneInput<'_>) {
        if seen.is_running(self.clip.making) {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.weak(seen.say_text(words::MAKING));
            });
        }
    }

    /// Shows the trials of a plan; a click shows the clip of one on the stage.
    pub(super) fn show_plan_trials(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, plan: &StudyPlan) {
        let rows = studies_data::trial_rows_from_plan(plan, seen.language);
        ui.weak(fill_text_braces(seen.say_text(words::TRIALS), &[("n", &rows.len())]));
        self.show_clip_progress(ui, seen);
        let height = ui.spacing().interact_size.y * 1.9;
        let row_pitch = height + ui.spacing().item_spacing.y;
        let room = (row_pitch * rows.len() as f32).min(320.0);
        let mut picked = None;
        ScrollArea::vertical()
            .id_salt("trials")
            .max_height(room)
            .auto_shrink([false, true])
            .show_rows(ui, height, rows.len(), |ui, range| {
                for row in &rows[range] {
                    let chosen = self.clip.is_requested_clip(&row.name, &row.clip);
                    if list_row(ui, height, chosen, &row.name, &row.about).clicked() {
                        picked = Some(row);
                    }
                }
            });
        if let Some(row) = picked {
            self.show_clip(&row.name, &row.clip, seen.out);
        }
    }
}
