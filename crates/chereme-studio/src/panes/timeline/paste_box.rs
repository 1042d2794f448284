//! The list of pasted lines without a place, shown before anything is pasted.

use chereme_corpus::annotate_paste::PastePlan;
use eframe::egui::{Key, Label, Modifiers, ScrollArea, Ui, vec2};

use super::timeline_edit::TimelineScene;
use super::timeline_parts::box_window;
use super::{TimelinePane, timeline_paste};
use crate::words::{fill_text_braces, shell, timeline as words};

/// The most lines in the list.
const MAX_PASTE_LIST_LINES: usize = 200;

/// The list while it is open.
#[derive(Debug)]
pub(super) struct PasteBox {
    pub(super) plan: PastePlan,
}

/// Shows the list, and pastes the other lines if the user agrees.
pub(super) fn show_paste_box(timeline: &mut TimelinePane, ui: &mut Ui, scene: &TimelineScene<'_>) {
    let Some(shown) = timeline.boxes.paste_box.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (mut keep, mut drop) = (pressed(Key::Enter), pressed(Key::Escape));
    let say = |text| scene.seen.say_text(text);
    let PasteBox { plan } = &shown;
    box_window(say(words::PASTE_TITLE), "timeline paste")
        .fixed_size(vec2(380.0, 260.0))
        .show(ui.ctx(), |ui| {
            ui.add(Label::new(say(words::PASTE_ABOUT)).wrap());
            let room = ui.available_height() - ui.spacing().interact_size.y * 1.6;
            ScrollArea::vertical()
                .auto_shrink(false)
                .max_height(room)
                .show(ui, |ui| {
                    for odd in plan.odd.iter().take(MAX_PASTE_LIST_LINES) {
                        let what = timeline_paste::odd_text(scene, odd);
                        let values: [(&str, &dyn std::fmt::Display); 2] = [("n", &odd.line), ("what", &what)];
                        ui.add(Label::new(fill_text_braces(say(words::PASTE_LINE), &values)).wrap());
                    }
                    if let Some(more) = plan.odd.len().checked_sub(MAX_PASTE_LIST_LINES + 1) {
                        ui.weak(fill_text_braces(say(words::PASTE_MORE), &[("n", &(more + 1))]));
                    }
                });
            ui.horizontal(|ui| {
                if !plan.adds.is_empty() {
                    let rest = fill_text_braces(say(words::PASTE_REST), &[("n", &plan.adds.len())]);
                    keep |= ui.button(rest).clicked();
                }
                drop |= ui.button(say(shell::CANCEL)).clicked();
            });
        });
    if keep && !plan.adds.is_empty() {
        timeline_paste::add_pasted_annotations(timeline, &plan.adds, scene.seen.out);
    } else if !drop && !keep {
        timeline.boxes.paste_box = Some(shown);
    }
}
