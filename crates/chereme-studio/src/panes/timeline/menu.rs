//! The context menu of a lane.

use std::collections::BTreeSet;

use chereme_corpus::RecordingContents;
use eframe::egui::{Rect, Response, ScrollArea, Ui};

use super::timeline_ui::TimelineDrawing;
use super::{bar, timeline_data};
use crate::action::Action;
use crate::command::WindowCommand;
use crate::words::timeline as words;

/// The part of the window's height that the menu leaves free, in points.
const TIMELINE_MENU_MARGIN_POINTS: f32 = 30.0;

const VALUE_MENU_ACTIONS: [Action; 2] = [Action::EditValue, Action::PictureValue];
const CLIPBOARD_MENU_ACTIONS: [Action; 6] = [
    Action::Cut,
    Action::Copy,
    Action::CopyWithBelow,
    Action::Paste,
    Action::PasteHere,
    Action::Duplicate,
];
const NEW_ANNOTATION_ACTIONS: [Action; 4] = [
    Action::NewAnnotation,
    Action::NewBefore,
    Action::NewAfter,
    Action::NewBelow,
];
const SHAPE_MENU_ACTIONS: [Action; 5] = [
    Action::SplitAnnotation,
    Action::MergeAnnotation,
    Action::MergePrevious,
    Action::StartToNeighbour,
    Action::EndToNeighbour,
];
const REMOVAL_MENU_ACTIONS: [Action; 3] = [Action::CopyToTier, Action::MoveToTier, Action::DeleteAnnotation];

impl TimelineDrawing<'_, '_> {
    /// Shows the menu for the annotation under the pointer, or for all selected ones if it is among them. If there is
    /// no annotation, moves the playhead there.
    pub(super) fn lane_menu(&mut self, response: &Response, contents: &RecordingContents, at: usize, lane: Rect) {
        // There are hundreds of annotations, and one menu.
        if !response.secondary_clicked() && !response.context_menu_opened() {
            return;
        }
        let tier = &contents.tiers[at];
        if response.secondary_clicked()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let here = self.instant_at_x(pointer.x - lane.left());
            let under_index = timeline_data::annotation_index_at(&tier.annotations, here.instant_micros());
            let under = under_index.map(|under| tier.annotations.ids[under]);
            self.seen.send_command(WindowCommand::Tier(Some(tier.row.id)));
            match under {
                // A menu on a selected annotation is for all selected ones.
                Some(id) if self.seen.shown.annotations.contains(&id) => {}
                Some(id) => self.seen.send_command(WindowCommand::Annotations(BTreeSet::from([id]))),
                None => {
                    self.seen.send_command(WindowCommand::Annotations(BTreeSet::new()));
                    self.seen.send_seek(here);
                }
            }
        }
        response.context_menu(|ui| {
            let room = ui.ctx().content_rect().height() - TIMELINE_MENU_MARGIN_POINTS;
            ScrollArea::vertical()
                .max_height(room)
                .min_scrolled_height(room)
                .show(ui, |ui| self.show_annotation_menu_entries(ui));
        });
    }

    fn show_annotation_menu_entries(&mut self, ui: &mut Ui) {
        bar::show_menu_actions(ui, self.seen, &VALUE_MENU_ACTIONS);
        ui.separator();
        bar::show_menu_actions(ui, self.seen, &CLIPBOARD_MENU_ACTIONS);
        ui.separator();
        for (title, part) in [
            (words::MENU_NEW, &NEW_ANNOTATION_ACTIONS[..]),
            (words::MENU_BESIDE, &SHAPE_MENU_ACTIONS),
        ] {
            ui.menu_button(self.seen.say_text(title), |ui| {
                bar::show_menu_actions(ui, self.seen, part);
            });
        }
        ui.separator();
        bar::show_menu_actions(ui, self.seen, &REMOVAL_MENU_ACTIONS);
    }
}
