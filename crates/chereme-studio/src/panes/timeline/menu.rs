//! The context menu of a lane.

use std::collections::BTreeSet;

use chereme_corpus::Contents;
use eframe::egui::{Rect, Response, ScrollArea, Ui};

use super::ui::Drawing;
use super::{bar, data};
use crate::action::Action;
use crate::command::Command;
use crate::words::timeline as words;

/// The part of the window's height that the menu leaves free, in points.
const MARGIN: f32 = 30.0;

const VALUE: [Action; 2] = [Action::EditValue, Action::PictureValue];
const CLIP: [Action; 6] = [
    Action::Cut,
    Action::Copy,
    Action::CopyWithBelow,
    Action::Paste,
    Action::PasteHere,
    Action::Duplicate,
];
const NEW: [Action; 4] = [
    Action::NewAnnotation,
    Action::NewBefore,
    Action::NewAfter,
    Action::NewBelow,
];
const SHAPE: [Action; 5] = [
    Action::SplitAnnotation,
    Action::MergeAnnotation,
    Action::MergePrevious,
    Action::StartToNeighbour,
    Action::EndToNeighbour,
];
const AWAY: [Action; 3] = [
    Action::CopyToTier,
    Action::MoveToTier,
    Action::DeleteAnnotation,
];

impl Drawing<'_, '_> {
    /// Shows the menu for the annotation under the pointer, or for all selected ones if it is among them. If there is
    /// no annotation, moves the playhead there.
    pub(super) fn lane_menu(
        &mut self,
        response: &Response,
        contents: &Contents,
        at: usize,
        lane: Rect,
    ) {
        // There are hundreds of annotations, and one menu.
        if !response.secondary_clicked() && !response.context_menu_opened() {
            return;
        }
        let tier = &contents.tiers[at];
        if response.secondary_clicked()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let here = self.instant(pointer.x - lane.left());
            let under = data::at(&tier.annotations, here.micros());
            let under = under.map(|under| tier.annotations.ids[under]);
            self.out.send(Command::Tier(Some(tier.row.id)));
            match under {
                Some(id) if self.seen.shown.annotations.contains(&id) => {}
                Some(id) => self.out.send(Command::Annotations(BTreeSet::from([id]))),
                None => {
                    self.out.send(Command::Annotations(BTreeSet::new()));
                    self.out.seek(here);
                }
            }
        }
        response.context_menu(|ui| {
            let room = ui.ctx().content_rect().height() - MARGIN;
            ScrollArea::vertical()
                .max_height(room)
                .min_scrolled_height(room)
                .show(ui, |ui| self.entries(ui));
        });
    }

    fn entries(&mut self, ui: &mut Ui) {
        bar::actions(ui, self.seen, &VALUE, self.out);
        ui.separator();
        bar::actions(ui, self.seen, &CLIP, self.out);
        ui.separator();
        for (title, part) in [(words::MENU_NEW, &NEW[..]), (words::MENU_BESIDE, &SHAPE)] {
            ui.menu_button(self.seen.say(title), |ui| {
                bar::actions(ui, self.seen, part, self.out);
            });
        }
        ui.separator();
        bar::actions(ui, self.seen, &AWAY, self.out);
    }
}
