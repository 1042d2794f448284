//! Merging another corpus, such as a copy with somebody else's work, into the open corpus.

use std::collections::BTreeMap;
use std::path::Path;

use chereme_corpus::MergeReport;
use eframe::egui::{Button, RichText, ScrollArea, Ui};

use crate::action::Action;
use crate::command::WindowCommand;
use crate::context::PaneInput;
use crate::panes::show_running_work;
use crate::words::{fill_text_braces, import_words as words, merge_words, translate_library_message};
use crate::work::{WorkId, whole_corpus};

/// Returns whether a path names a corpus.
pub(super) fn is_corpus(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "chereme")
}

/// Shows the offer to merge a corpus, the progress, and the outcome; returns the work when it begins.
pub(super) fn show_corpus_merge(
    ui: &mut Ui,
    seen: &PaneInput<'_>,
    path: &Path,
    running: Option<WorkId>,
    report: Option<&MergeReport>,
) -> Option<WorkId> {
    ui.label(seen.say_text(words::MERGE_ABOUT));
    if ui.horizontal(|ui| show_running_work(ui, seen, running)).inner {
        return None;
    }
    let mut begun = None;
    let open = !seen.snapshot.is_read_only();
    let button = Button::new(RichText::new(seen.say_text(words::MERGE)).strong());
    if ui.add_enabled(open, button).clicked() {
        begun = Some(seen.request_work(whole_corpus::merge_corpus_job(path.to_owned())));
    }
    if let Some(report) = report {
        ui.separator();
        outcome(ui, seen, report);
    }
    begun
}

fn outcome(ui: &mut Ui, seen: &PaneInput<'_>, report: &MergeReport) {
    let lines = merge_report_lines(report, &|text| seen.say_text(text));
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for line in lines {
            ui.label(line);
        }
        for note in &report.notes {
            ui.weak(translate_library_message(note, seen.language));
        }
        if report.conflicts.is_empty() {
            ui.label(seen.say_text(words::MERGE_DONE));
            return;
        }
        let n = report.conflicts.len();
        ui.label(fill_text_braces(seen.say_text(words::MERGE_CONFLICTS), &[("n", &n)]));
        if ui.button(seen.say_text(words::MERGE_DECIDE)).clicked() {
            seen.send_command(WindowCommand::Do(Action::ShowHistory));
        }
    });
}

/// Returns a line for each kind of change in a merge.
fn merge_report_lines(report: &MergeReport, say: &dyn Fn(crate::words::InterfaceText) -> &'static str) -> Vec<String> {
    let kinds = [
        (merge_words::ADDED, &report.added),
        (merge_words::CHANGED, &report.changed),
        (merge_words::REMOVED, &report.removed),
    ];
    let counted = |counts: &BTreeMap<String, u64>| {
        let entries = counts.iter();
        let counts = entries.map(|(kind, count)| format!("{count} × {}", say(merge_words::merged_kind_noun(kind))));
        counts.collect::<Vec<_>>().join(", ")
    };
    let changed = kinds.into_iter().filter(|(_, counts)| !counts.is_empty());
    let lines: Vec<String> = changed
        .map(|(text, counts)| fill_text_braces(say(text), &[("what", &counted(counts))]))
        .collect();
    if lines.is_empty() {
        return vec![say(merge_words::NOTHING).to_owned()];
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_brought_by_a_merge_are_counted_by_kind() {
        let mut report = MergeReport::default();
        let say = |text: crate::words::InterfaceText| text.text_in_language(crate::words::InterfaceLanguage::French);
        assert_eq!(merge_report_lines(&report, &say), ["Rien de nouveau."]);
        report.added.insert("annotation".to_owned(), 3);
        report.added.insert("tier".to_owned(), 1);
        report.removed.insert("annotation".to_owned(), 2);
        assert_eq!(
            merge_report_lines(&report, &say),
            ["ajouté : 3 × annotation, 1 × acteur", "supprimé : 2 × annotation"]
        );
        assert!(is_corpus(Path::new("a/b.chereme")) && !is_corpus(Path::new("a.eaf")));
    }
}
