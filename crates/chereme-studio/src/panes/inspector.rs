//! What is selected, in words.

use chereme_corpus::{RecordingGlance, ValueState};
use chereme_motion::{Instant, Span};
use eframe::egui::{Grid, ScrollArea, Ui};

use super::Pane;
use super::library::origin_text;
use super::timeline::data::{time_text, value_text};
use crate::context::{Outbox, Seen};
use crate::model::Found;
use crate::words::{Text, inspector as words, timeline};

/// A line: what it is called, and what it says.
type Line = (Text, String);

/// Returns what is known of a recording; what nobody said is left out.
pub(crate) fn recording_lines(it: &RecordingGlance, origin: impl Fn(&str) -> String) -> Vec<Line> {
    let frames = match it.rate {
        Some(rate) if it.frames > 0 => Some(format!("{} × {:.3} Hz", it.frames, rate.per_second())),
        _ => None,
    };
    [
        (words::RECORDING, Some(it.row.name.clone())),
        (words::SIGNER, it.row.signer.clone()),
        (words::ORIGIN, Some(origin(&it.row.origin))),
        (
            words::DURATION,
            Some(time_text(Instant::from_micros(it.row.duration_us))),
        ),
        (words::FRAMES, frames),
        (words::RECIPE, it.recipe.clone()),
        (words::LICENCE, it.row.licence.clone()),
        (words::NOTES, it.row.notes.clone()),
    ]
    .into_iter()
    .filter_map(|(text, value)| Some((text, value?)))
    .collect()
}

/// Returns what is known of an annotation.
pub(crate) fn annotation_lines<'a>(
    found: Found<'a>,
    missing: impl Fn(ValueState) -> &'a str,
) -> Vec<Line> {
    let columns = &found.tier.annotations;
    let sure = columns.confidences[found.at].map(|sure| format!("{:.0} %", sure * 100.0));
    [
        (words::TIER, Some(found.tier.row.name.clone())),
        (
            words::VALUE,
            Some(value_text(columns, found.at, missing).to_owned()),
        ),
        (words::SPAN, Some(span_text(columns.span(found.at)))),
        (words::CONFIDENCE, sure),
    ]
    .into_iter()
    .filter_map(|(text, value)| Some((text, value?)))
    .collect()
}

fn span_text(span: Span) -> String {
    format!("{} – {}", time_text(span.start()), time_text(span.end()))
}

/// The pane.
#[derive(Default)]
pub(crate) struct Inspector;

impl Pane for Inspector {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, _out: &mut Outbox) {
        let recording = seen
            .shown
            .recording
            .and_then(|id| seen.snapshot.recording(id));
        let Some(recording) = recording else {
            ui.label(seen.say(words::NOTHING));
            return;
        };
        let origin =
            |name: &str| origin_text(name).map_or(name.to_owned(), |it| seen.say(it).to_owned());
        let missing = |state| match state {
            ValueState::NotApplicable => seen.say(timeline::NOT_APPLICABLE),
            ValueState::Unclear => seen.say(timeline::UNCLEAR),
            _ => seen.say(timeline::UNSET),
        };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if let Some(found) = seen
                .shown
                .annotation()
                .and_then(|id| seen.snapshot.annotation(id))
            {
                grid(ui, "annotation", &annotation_lines(found, missing), seen);
                ui.separator();
            } else if let Some(span) = seen.shown.span {
                grid(ui, "span", &[(words::SPAN, span_text(span))], seen);
                ui.separator();
            }
            grid(ui, "recording", &recording_lines(recording, origin), seen);
        });
    }
}

fn grid(ui: &mut Ui, id: &str, lines: &[Line], seen: &Seen<'_>) {
    Grid::new(id).num_columns(2).show(ui, |ui| {
        for (text, value) in lines {
            ui.weak(seen.say(*text));
            ui.add(eframe::egui::Label::new(value).wrap());
            ui.end_row();
        }
    });
}
