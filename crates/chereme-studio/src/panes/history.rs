//! What was done, by whom, the newest first; undo and redo.

use chereme_corpus::{OperationKind, OperationRow};
use eframe::egui::{RichText, ScrollArea, Ui};

use super::Pane;
use crate::action::Action;
use crate::command::Command;
use crate::context::{Outbox, Seen};
use crate::words::{fill, history as words};

/// An operation as the list shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) what: String,
    /// When and who.
    pub(crate) about: String,
    pub(crate) stands: bool,
}

/// Returns the operations as rows; `about` says of what an undo or redo is one.
pub(crate) fn rows(
    operations: &[OperationRow],
    about: impl Fn(OperationKind, i64) -> String,
) -> Vec<Row> {
    let row = |it: &OperationRow| {
        let mut what = format!("{} {}: {}", it.id, it.name, it.summary);
        if let Some(target) = it.target.filter(|_| it.kind != OperationKind::Do) {
            what = format!(
                "{} {} · {}: {}",
                it.id,
                about(it.kind, target),
                it.name,
                it.summary
            );
        }
        let at = it.at.replace('T', " ");
        Row {
            what,
            about: format!("{} · {}", at.trim_end_matches('Z'), it.author),
            stands: it.stands,
        }
    };
    operations.iter().map(row).collect()
}

/// The pane.
#[derive(Default)]
pub(crate) struct History;

impl Pane for History {
    fn ui(&mut self, ui: &mut Ui, seen: &Seen<'_>, out: &mut Outbox) {
        ui.horizontal(|ui| {
            for action in [Action::Undo, Action::Redo] {
                let button = ui.button(seen.say(action.row().name));
                if button.on_hover_text(seen.keys.text(action)).clicked() {
                    out.send(Command::Do(action));
                }
            }
        });
        let about = |kind, target: i64| {
            let text = if kind == OperationKind::Undo {
                words::UNDO_OF
            } else {
                words::REDO_OF
            };
            fill(seen.say(text), &[("n", &target)])
        };
        let rows = rows(&seen.snapshot.overview.operations, about);
        if rows.is_empty() {
            ui.label(seen.say(words::EMPTY));
            return;
        }
        let height = ui.spacing().interact_size.y * 1.7;
        ScrollArea::vertical()
            .auto_shrink(false)
            .show_rows(ui, height, rows.len(), |ui, range| {
                for row in &rows[range] {
                    ui.vertical(|ui| {
                        ui.set_height(height);
                        ui.spacing_mut().item_spacing.y = 0.0;
                        let mut what = RichText::new(&row.what);
                        let mut about = row.about.clone();
                        if !row.stands {
                            what = what.strikethrough();
                            about = format!("{about} · {}", seen.say(words::UNDONE));
                        }
                        ui.add(eframe::egui::Label::new(what).truncate());
                        ui.small(about);
                    });
                }
            });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_say_who_did_what_and_what_they_take_back() {
        let row = |id, kind, target| OperationRow {
            id,
            at: "2026-01-02T03:04:05Z".into(),
            author: "Zoé".into(),
            kind,
            target,
            name: "annotate".into(),
            summary: "1 added in Un".into(),
            changes: 1,
            stands: id != 1,
        };
        let all = [
            row(2, OperationKind::Undo, Some(1)),
            row(1, OperationKind::Do, None),
        ];
        let rows = rows(&all, |_, target| format!("undo of {target}"));
        assert_eq!(rows[0].what, "2 undo of 1 · annotate: 1 added in Un");
        assert_eq!(rows[1].what, "1 annotate: 1 added in Un");
        assert_eq!(rows[1].about, "2026-01-02 03:04:05 · Zoé");
        assert!(!rows[1].stands);
    }
}
