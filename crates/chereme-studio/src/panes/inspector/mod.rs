//! The inspector: details of the selection, which can be edited if undo can restore them.

mod about;
pub(crate) mod inspector_data;
mod inspector_edit;
mod inspector_notation;
mod inspector_tier;
mod inspector_token;
mod inspector_ui;

use std::collections::BTreeMap;

use chereme_corpus::{CorpusError, ObjectDetails};
use eframe::egui::{ScrollArea, Ui};

use super::PaneInterface;
use crate::command::CommandOutbox;
use crate::context::PaneInput;
use crate::model::InspectedThing;
use crate::words::inspector as words;
use crate::work::{WorkId, WorkOutcome, WorkResult, recordings_jobs};

/// Row ids of the selected recording, tier and annotation.
type SelectedRowIds = (Option<i64>, Option<i64>, Option<i64>);

/// The pane.
#[derive(Default)]
pub(crate) struct InspectorPane {
    /// The subject, if it is not the selection; cleared when the selection changes.
    turned: Option<InspectedThing>,
    selected: SelectedRowIds,
    /// The corpus generation of `known`.
    generation: i64,
    known: BTreeMap<InspectedThing, Result<ObjectDetails, String>>,
    asked: BTreeMap<WorkId, InspectedThing>,
}

impl InspectorPane {
    /// Shows something until something else is selected.
    pub(crate) fn inspect_thing(&mut self, thing: InspectedThing) {
        self.turned = Some(thing);
    }

    fn follow_inspected_selection(&mut self, seen: &PaneInput<'_>) {
        let shown = seen.shown;
        let selected = (shown.recording, shown.tier, shown.selected_annotation());
        if selected != self.selected {
            self.selected = selected;
            self.turned = None;
        }
        let generation = seen.snapshot.overview.generation;
        if generation != self.generation {
            self.generation = generation;
            self.known.clear();
            self.asked.clear();
        }
    }

    /// Returns the details of something, and requests them if they are missing.
    fn request_thing_details(
        &mut self,
        thing: &InspectedThing,
        out: &CommandOutbox,
    ) -> Option<Result<ObjectDetails, String>> {
        if let Some(known) = self.known.get(thing) {
            return Some(known.clone());
        }
        if !self.asked.values().any(|asked| asked == thing) {
            let id = out.request_work(recordings_jobs::look_up_details_job(thing.clone()));
            self.asked.insert(id, thing.clone());
        }
        None
    }
}

impl PaneInterface for InspectorPane {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>) {
        self.follow_inspected_selection(seen);
        if let Some(thing) = self.turned.clone() {
            if ui.button(seen.say_text(words::BACK)).clicked() {
                self.turned = None;
            }
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                inspector_ui::show_thing_details(self, ui, seen, &thing);
            });
            return;
        }
        if seen.shown.recording.is_none() {
            ui.label(seen.say_text(words::NOTHING));
            return;
        }
        ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| inspector_ui::show_selected_details(self, ui, seen));
    }

    fn receive_work_result(&mut self, id: WorkId, ended: &WorkResult) {
        let Some(thing) = self.asked.remove(&id) else {
            return;
        };
        let lookup_result = match ended {
            Ok(WorkOutcome::Looked(details)) => Ok((**details).clone()),
            Ok(_) => return,
            // It was deleted, united with something else or undone, so that the selection is shown again.
            Err(CorpusError::Wrong { .. }) if self.turned.as_ref() == Some(&thing) => return self.turned = None,
            Err(error) => Err(error.to_string()),
        };
        self.known.insert(thing, lookup_result);
    }
}
