//! Conflicts of merges above the history: both candidates, and a button for each decision.

use chereme_corpus::{Candidate, CorpusConflict, Decision};
use chereme_motion::{Instant, Span};
use eframe::egui::{CollapsingHeader, RichText, ScrollArea, Ui};

use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::words::merge as words;
use crate::work::whole_corpus;

/// The greatest height of the list, as a share of the pane's height.
const SHARE: f32 = 0.6;

/// Shows the open conflicts, if there are any.
pub(super) fn show(ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox) {
    let all = &seen.snapshot.overview.conflicts;
    if all.is_empty() {
        return;
    }
    let title = format!("{} ({})", seen.say(words::TITLE), all.len());
    let height = ui.available_height() * SHARE;
    let header = CollapsingHeader::new(RichText::new(title).strong())
        .id_salt("conflicts")
        .default_open(true);
    header.show(ui, |ui| {
        ScrollArea::vertical()
            .id_salt("conflicts")
            .max_height(height)
            .show(ui, |ui| {
                for conflict in all {
                    row(ui, seen, out, conflict);
                    ui.separator();
                }
            });
    });
}

/// Shows the recording of a conflict, at the annotation if the conflict is about one.
fn show_there(out: &mut Outbox, recording: i64, conflict: &CorpusConflict) {
    let sides = [&conflict.mine, &conflict.theirs].into_iter().flatten();
    let mut spans = sides.filter_map(|it| it.start_us.zip(it.end_us));
    let span = spans.next();
    out.send(match span {
        Some((start, end)) if start <= end => {
            let [start, end] = [start, end].map(Instant::from_micros);
            Command::Place(recording, Span::between(start, end))
        }
        _ => Command::Recording(recording),
    });
    out.send(Command::Look);
}

fn row(ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, conflict: &CorpusConflict) {
    let about = format!(
        "{}. {} · {} {}",
        conflict.number,
        conflict.place,
        seen.say(words::FROM),
        conflict.from
    );
    match conflict.recording {
        Some(recording) => {
            let link = ui.link(about).on_hover_text(seen.say(words::SHOW));
            if link.clicked() {
                show_there(out, recording, conflict);
            }
        }
        None => drop(ui.weak(about)),
    }
    let shown = |side: &Option<Candidate>| match side {
        Some(side) => side.to_string(),
        None => seen.say(words::GONE).to_owned(),
    };
    let sides = [
        (Decision::Mine, Some(shown(&conflict.mine))),
        (Decision::Theirs, Some(shown(&conflict.theirs))),
        (
            Decision::Both,
            (conflict.what == "annotation" && conflict.theirs.is_some()).then(String::new),
        ),
    ];
    for (decision, text) in sides {
        let Some(text) = text else { continue };
        ui.horizontal_wrapped(|ui| {
            let label = seen.say(words::decision(decision));
            let button = ui.button(label).on_hover_text(seen.say(words::TIP));
            if button.clicked() {
                out.work(whole_corpus::decide(conflict.number, decision));
            }
            ui.label(text);
        });
    }
}
