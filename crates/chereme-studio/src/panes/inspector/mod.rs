//! The inspector: details of the selection, which can be edited if undo can restore them.

mod about;
pub(crate) mod data;
mod edit;
mod notation;
mod tier;
mod token;
mod ui;

use std::collections::BTreeMap;

use chereme_corpus::Details;
use eframe::egui::{ScrollArea, Ui};

use super::Pane;
use crate::context::{Outbox, PaneInput};
use crate::words::inspector as words;
use crate::work::{Ended, Outcome, WorkId, recordings};

/// Something that the inspector can show.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Thing {
    Token(i64),
    Sign(i64),
    Signer(i64),
    Recording(i64),
    /// A value of the inventory with that row id.
    Value(i64, String),
}

/// Row ids of the selected recording, tier and annotation.
type Selected = (Option<i64>, Option<i64>, Option<i64>);

/// The pane.
#[derive(Default)]
pub(crate) struct Inspector {
    /// The subject, if it is not the selection; cleared when the selection changes.
    turned: Option<Thing>,
    selected: Selected,
    /// The corpus generation of `known`.
    generation: i64,
    known: BTreeMap<Thing, Result<Details, String>>,
    asked: BTreeMap<WorkId, Thing>,
}

impl Inspector {
    /// Shows something until something else is selected.
    pub(crate) fn turn_to(&mut self, thing: Thing) {
        self.turned = Some(thing);
    }

    fn follow(&mut self, seen: &PaneInput<'_>) {
        let shown = seen.shown;
        let selected = (shown.recording, shown.tier, shown.annotation());
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
    fn details(&mut self, thing: &Thing, out: &mut Outbox) -> Option<Result<Details, String>> {
        if let Some(known) = self.known.get(thing) {
            return Some(known.clone());
        }
        if !self.asked.values().any(|asked| asked == thing) {
            let id = out.work(recordings::look(thing.clone()));
            self.asked.insert(id, thing.clone());
        }
        None
    }
}

impl Pane for Inspector {
    fn ui(&mut self, ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
        self.follow(seen);
        if let Some(thing) = self.turned.clone() {
            if ui.button(seen.say(words::BACK)).clicked() {
                self.turned = None;
            }
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                ui::thing(self, ui, seen, &thing, out);
            });
            return;
        }
        if seen.shown.recording.is_none() {
            ui.label(seen.say(words::NOTHING));
            return;
        }
        ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| ui::selected(self, ui, seen, out));
    }

    fn hear(&mut self, id: WorkId, ended: &Ended) {
        let Some(thing) = self.asked.remove(&id) else {
            return;
        };
        let known = match ended {
            Ok(Outcome::Looked(details)) => Ok(details.clone()),
            Ok(_) => return,
            Err(error) => Err(error.to_string()),
        };
        self.known.insert(thing, known);
    }
}
