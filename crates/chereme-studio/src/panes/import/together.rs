//! Merging another corpus, such as a copy with somebody else's work, into the open corpus.

use std::collections::BTreeMap;
use std::path::Path;

use chereme_corpus::MergeReport;
use eframe::egui::{Button, ProgressBar, RichText, ScrollArea, Ui};

use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, PaneInput};
use crate::words::{fill, import as words, merge, shell, spoken};
use crate::work::{WorkId, whole_corpus};

/// Returns whether a path names a corpus.
pub(super) fn is_corpus(path: &Path) -> bool {
    path.extension().is_some_and(|it| it == "chereme")
}

/// Shows the offer to merge a corpus, the progress, and the outcome; returns the work when it begins.
pub(super) fn show(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    out: &mut Outbox,
    path: &Path,
    (running, report): (Option<WorkId>, Option<&MergeReport>),
) -> Option<WorkId> {
    ui.label(seen.say(words::MERGE_ABOUT));
    if let Some((id, running)) = running.and_then(|id| Some((id, seen.running.get(&id)?))) {
        ui.horizontal(|ui| {
            match running.far.share() {
                Some(share) => {
                    let bar = ProgressBar::new(share).desired_width(120.0);
                    ui.add(bar.show_percentage());
                }
                None => drop(ui.spinner()),
            }
            if ui.button(seen.say(shell::CANCEL)).clicked() {
                out.send(Command::Stop(id));
            }
        });
        return None;
    }
    let mut begun = None;
    let open = !seen.snapshot.is_read_only();
    let button = Button::new(RichText::new(seen.say(words::MERGE)).strong());
    if ui.add_enabled(open, button).clicked() {
        begun = Some(out.work(whole_corpus::merge(path.to_owned())));
    }
    if let Some(report) = report {
        ui.separator();
        outcome(ui, seen, out, report);
    }
    begun
}

fn outcome(ui: &mut Ui, seen: &PaneInput<'_>, out: &mut Outbox, report: &MergeReport) {
    let lines = lines(report, &|text| seen.say(text));
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for line in lines {
            ui.label(line);
        }
        for note in &report.notes {
            ui.weak(spoken(note, seen.language));
        }
        if report.conflicts.is_empty() {
            ui.label(seen.say(words::MERGE_DONE));
            return;
        }
        let n = report.conflicts.len();
        ui.label(fill(seen.say(words::MERGE_CONFLICTS), &[("n", &n)]));
        if ui.button(seen.say(words::MERGE_DECIDE)).clicked() {
            out.send(Command::Do(Action::ShowHistory));
        }
    });
}

/// Returns a line for each kind of change in a merge.
fn lines(report: &MergeReport, say: &dyn Fn(crate::words::Text) -> &'static str) -> Vec<String> {
    let kinds = [
        (merge::ADDED, &report.added),
        (merge::CHANGED, &report.changed),
        (merge::REMOVED, &report.removed),
    ];
    let counted = |counts: &BTreeMap<String, u64>| {
        let counts = counts.iter();
        let counts = counts.map(|(kind, count)| format!("{count} × {}", say(merge::kind(kind))));
        counts.collect::<Vec<_>>().join(", ")
    };
    let changed = kinds.into_iter().filter(|(_, counts)| !counts.is_empty());
    let lines: Vec<String> = changed
        .map(|(text, counts)| fill(say(text), &[("what", &counted(counts))]))
        .collect();
    if lines.is_empty() {
        return vec![say(merge::NOTHING).to_owned()];
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_brought_by_a_merge_are_counted_by_kind() {
        let mut report = MergeReport::default();
        let say = |text: crate::words::Text| text.of(crate::words::Language::French);
        assert_eq!(lines(&report, &say), ["Rien de nouveau."]);
        report.added.insert("annotation".to_owned(), 3);
        report.added.insert("tier".to_owned(), 1);
        report.removed.insert("annotation".to_owned(), 2);
        assert_eq!(
            lines(&report, &say),
            [
                "ajouté : 3 × annotation, 1 × acteur",
                "supprimé : 2 × annotation"
            ]
        );
        assert!(is_corpus(Path::new("a/b.chereme")) && !is_corpus(Path::new("a.eaf")));
    }
}
