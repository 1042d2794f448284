//! Conflicts of merges above the history: both candidates, and a button for each decision.

use chereme_corpus::{ConflictCandidate, ConflictDecision, CorpusConflict};
use chereme_motion::{RecordingInstant, TimeSpan};
use eframe::egui::{CollapsingHeader, RichText, ScrollArea, Ui};

use crate::command::{CommandOutbox, WindowCommand};
use crate::context::PaneInput;
use crate::words::merge_words as words;
use crate::work::whole_corpus;

/// The greatest height of the list, as a share of the pane's height.
const MAX_CONFLICTS_HEIGHT_SHARE: f32 = 0.6;

/// Shows the open conflicts, if there are any.
pub(super) fn show_open_conflicts(ui: &mut Ui, seen: &PaneInput<'_>) {
    let all = &seen.snapshot.overview.conflicts;
    if all.is_empty() {
        return;
    }
    let title = format!("{} ({})", seen.say_text(words::TITLE), all.len());
    let height = ui.available_height() * MAX_CONFLICTS_HEIGHT_SHARE;
    let header = CollapsingHeader::new(RichText::new(title).strong())
        .id_salt("conflicts")
        .default_open(true);
    header.show(ui, |ui| {
        ScrollArea::vertical()
            .id_salt("conflicts")
            .max_height(height)
            .show(ui, |ui| {
                for conflict in all {
                    show_conflict_row(ui, seen, conflict);
                    ui.separator();
                }
            });
    });
}

/// Shows the recording of a conflict, at the annotation if the conflict is about one.
fn show_there(out: &CommandOutbox, recording: i64, conflict: &CorpusConflict) {
    let sides = [&conflict.mine, &conflict.theirs].into_iter().flatten();
    let mut spans = sides.filter_map(|side| side.start_us.zip(side.end_us));
    let span = spans.next();
    out.send_command(match span {
        Some((start, end)) if start <= end => {
            let [start, end] = [start, end].map(RecordingInstant::from_micros);
            WindowCommand::Place(recording, TimeSpan::span_between(start, end))
        }
        _ => WindowCommand::Recording(recording),
    });
    out.send_command(WindowCommand::Look);
}

fn show_conflict_row(ui: &mut Ui, seen: &PaneInput<'_>, conflict: &CorpusConflict) {
    let about = format!(
        "{}. {} · {} {}",
        conflict.number,
        conflict.place,
        seen.say_text(words::FROM),
        conflict.from
    );
    match conflict.recording {
        Some(recording) => {
            let link = ui.link(about).on_hover_text(seen.say_text(words::SHOW));
            if link.clicked() {
                show_there(seen.out, recording, conflict);
            }
        }
        None => drop(ui.weak(about)),
    }
    let shown = |side: &Option<ConflictCandidate>| match side {
        Some(side) => side.to_string(),
        None => seen.say_text(words::GONE).to_owned(),
    };
    let sides = [
        (ConflictDecision::Mine, Some(shown(&conflict.mine))),
        (ConflictDecision::Theirs, Some(shown(&conflict.theirs))),
        (
            ConflictDecision::Both,
            // Only two annotations can both stay; other things have one state.
            (conflict.what == "annotation" && conflict.theirs.is_some()).then(String::new),
        ),
    ];
    for (decision, text) in sides {
        let Some(text) = text else { continue };
        ui.horizontal_wrapped(|ui| {
            let label = seen.say_text(words::decision_word(decision));
            let button = ui.button(label).on_hover_text(seen.say_text(words::TIP));
            if button.clicked() {
                seen.request_work(whole_corpus::decide_conflict_job(conflict.number, decision));
            }
            ui.label(text);
        });
    }
}
