//! The list to choose the detector that proposes annotations.

use chereme_corpus::{ALL_DETECTORS, DetectOptions, ProposeScope};
use eframe::egui::{Button, Key, Label, Modifiers, Ui, vec2};

use super::timeline_edit::TimelineScene;
use super::timeline_parts::box_window;
use super::{TimelinePane, proposals};
use crate::words::{fill_text_braces, shell, timeline as words};
use crate::work::analysis;

/// The list while it is open.
#[derive(Debug, Default)]
pub(super) struct ChooseDetector {
    chosen: usize,
}

/// Shows the list, and runs the chosen detector.
pub(super) fn show_detector_list(timeline: &mut TimelinePane, ui: &mut Ui, scene: &TimelineScene<'_>) {
    let Some(mut list) = timeline.boxes.detectors.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
    let (enter, escape) = (pressed(Key::Enter), pressed(Key::Escape));
    list.chosen = match (up, down) {
        (true, _) => list.chosen.saturating_sub(1),
        (_, true) => (list.chosen + 1).min(ALL_DETECTORS.len().saturating_sub(1)),
        _ => list.chosen,
    };
    let mut done = enter.then_some(list.chosen);
    let mut closed = escape;
    let scope = proposals::current_propose_scope(scene);
    box_window(scene.seen.say_text(words::DETECT_TITLE), "timeline detectors")
        .fixed_size(vec2(360.0, 200.0))
        .show(ui.ctx(), |ui| {
            let text = match &scope {
                ProposeScope::Token(_) => words::DETECT_SIGN,
                ProposeScope::Span(..) => words::DETECT_SPAN,
                ProposeScope::Recording(_) | ProposeScope::Recordings(_) | ProposeScope::All => words::DETECT_RECORDING,
            };
            ui.add(Label::new(scene.seen.say_text(text)).wrap());
            for (at, detector) in ALL_DETECTORS.iter().enumerate() {
                let finds = detector
                    .detector_description()
                    .finds
                    .text_in_language(scene.seen.language);
                let text = fill_text_braces(
                    scene.seen.say_text(words::DETECTOR),
                    &[("name", &detector.detector_name()), ("finds", &finds)],
                );
                let button = Button::selectable(at == list.chosen, text)
                    .wrap()
                    .min_size(vec2(ui.available_width(), 0.0));
                if ui.add(button).clicked() {
                    done = Some(at);
                }
            }
            closed |= ui.button(scene.seen.say_text(shell::CANCEL)).clicked();
        });
    match done.and_then(|at| ALL_DETECTORS.get(at)) {
        Some(detector) => {
            let options = DetectOptions::propose_with(detector.detector_name(), scope);
            let work = scene
                .seen
                .request_work(analysis::run_detector_job(options, scene.seen.language));
            timeline.asked.proposing = Some(work);
        }
        None if !closed => timeline.boxes.detectors = Some(list),
        None => {}
    }
}
