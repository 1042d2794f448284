//! The list to choose the detector that proposes annotations.

use chereme_corpus::{DETECTORS, DetectOptions, ProposeScope};
use eframe::egui::{Align2, Button, Id, Key, Label, Modifiers, Ui, Window, vec2};

use super::edit::Scene;
use super::{Timeline, proposals};
use crate::context::Outbox;
use crate::words::{fill, shell, timeline as words};
use crate::work::analysis;

/// The list while it is open.
#[derive(Debug, Default)]
pub(super) struct ChooseDetector {
    chosen: usize,
}

/// Shows the list, and runs the chosen detector.
pub(super) fn show(timeline: &mut Timeline, ui: &mut Ui, scene: &Scene<'_>, out: &mut Outbox) {
    let Some(mut list) = timeline.boxes.detectors.take() else {
        return;
    };
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (up, down) = (pressed(Key::ArrowUp), pressed(Key::ArrowDown));
    let (enter, escape) = (pressed(Key::Enter), pressed(Key::Escape));
    list.chosen = match (up, down) {
        (true, _) => list.chosen.saturating_sub(1),
        (_, true) => (list.chosen + 1).min(DETECTORS.len().saturating_sub(1)),
        _ => list.chosen,
    };
    let mut done = enter.then_some(list.chosen);
    let mut closed = escape;
    let scope = proposals::scope(scene);
    Window::new(scene.seen.say(words::DETECT_TITLE))
        .id(Id::unique("timeline detectors"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .fixed_size(vec2(360.0, 200.0))
        .show(ui.ctx(), |ui| {
            let text = match &scope {
                ProposeScope::Token(_) => words::DETECT_SIGN,
                ProposeScope::Span(..) => words::DETECT_SPAN,
                ProposeScope::Recording(_) | ProposeScope::All => words::DETECT_RECORDING,
            };
            ui.add(Label::new(scene.seen.say(text)).wrap());
            for (at, detector) in DETECTORS.iter().enumerate() {
                let finds = detector.description().finds.of(scene.seen.language);
                let text = fill(
                    scene.seen.say(words::DETECTOR),
                    &[("name", &detector.name()), ("finds", &finds)],
                );
                let button = Button::selectable(at == list.chosen, text)
                    .wrap()
                    .min_size(vec2(ui.available_width(), 0.0));
                if ui.add(button).clicked() {
                    done = Some(at);
                }
            }
            closed |= ui.button(scene.seen.say(shell::CANCEL)).clicked();
        });
    match done.and_then(|at| DETECTORS.get(at)) {
        Some(detector) => {
            let options = DetectOptions {
                detector: detector.name().to_owned(),
                scope,
            };
            let work = out.work(analysis::detect(options, scene.seen.language));
            timeline.asked.proposing = Some(work);
        }
        None if !closed => timeline.boxes.detectors = Some(list),
        None => {}
    }
}
