//! Operations as sentences, and the number of steps back to each of them, without a window.

use std::collections::BTreeMap;

use chereme_corpus::words::effect::OperationEffect;
use chereme_corpus::{OperationKind, OperationRow};
use chereme_sign::text::fold_text;

use crate::words::history_words::{self as words, operation_sentence, undo_sentence};
use crate::words::{InterfaceLanguage, fill_text_braces};

/// Whether an operation is in effect, and how many steps lead to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OperationStanding {
    /// It is in effect; after that many undos it is the newest operation in effect.
    Stands(usize),
    /// It was undone; after that many redos it is in effect again.
    Undone(usize),
    /// It was undone, and newer work makes a redo impossible.
    Gone,
}

/// An operation as a row of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct HistoryRow {
    pub(crate) id: i64,
    pub(crate) what: String,
    /// Time and author.
    pub(crate) about: String,
    pub(crate) standing: OperationStanding,
}

/// Returns the operations other than undo and redo, the newest first. `operations` contains all of them, the newest
/// first.
pub(crate) fn history_rows(operations: &[OperationRow], language: InterfaceLanguage, filter: &str) -> Vec<HistoryRow> {
    let standings = standings(operations);
    let wanted = fold_text(filter.trim());
    let row = |operation: &OperationRow| {
        let time_text = operation.at.replace('T', " ");
        HistoryRow {
            id: operation.id,
            what: operation_sentence(&operation.effect, language),
            about: format!("{} · {}", time_text.trim_end_matches('Z'), operation.author),
            standing: standings.get(&operation.id).copied().unwrap_or(OperationStanding::Gone),
        }
    };
    let fits = |row: &HistoryRow| {
        let text = fold_text(&format!("{} {}", row.what, row.about));
        wanted.split_whitespace().all(|word| text.contains(word))
    };
    let done_operations = operations
        .iter()
        .filter(|operation| operation.kind == OperationKind::Do);
    done_operations.map(row).filter(fits).collect()
}

/// Returns the standing of each operation: undo and redo walk along two stacks, and new work empties the stack of
/// undone operations.
fn standings(operations: &[OperationRow]) -> BTreeMap<i64, OperationStanding> {
    let (mut done, mut undone): (Vec<i64>, Vec<i64>) = (Vec::new(), Vec::new());
    for it in operations.iter().rev() {
        match (it.kind, it.target) {
            (OperationKind::Undo, Some(target)) => {
                done.retain(|id| *id != target);
                undone.push(target);
            }
            (OperationKind::Redo, Some(target)) => {
                undone.retain(|id| *id != target);
                done.push(target);
            }
            _ => {
                done.push(it.id);
                undone.clear();
            }
        }
    }
    let stands = done.iter().rev().enumerate();
    let undone_steps = undone.iter().rev().enumerate();
    stands
        .map(|(steps, id)| (*id, OperationStanding::Stands(steps)))
        .chain(undone_steps.map(|(steps, id)| (*id, OperationStanding::Undone(steps + 1))))
        .collect()
}

/// Returns a sentence about the operation that would be undone or redone next.
pub(crate) fn next(operations: &[OperationRow], back: bool, language: InterfaceLanguage) -> Option<String> {
    let wanted = if back {
        OperationStanding::Stands(0)
    } else {
        OperationStanding::Undone(1)
    };
    let (id, _) = standings(operations)
        .into_iter()
        .find(|(_, standing)| *standing == wanted)?;
    let operation = operations.iter().find(|it| it.id == id)?;
    Some(operation_sentence(&operation.effect, language))
}

/// Returns a sentence about the newest operation, if it is newer than those in `before`; for other people's work with
/// the author's name. The user's own work is left out if another notice reports it.
pub(crate) fn newest_operation_news(
    [before, now]: [&[OperationRow]; 2],
    own: bool,
    language: InterfaceLanguage,
) -> Option<String> {
    let newest = now.first()?;
    if before.first().is_some_and(|operation| operation.id >= newest.id) {
        return None;
    }
    if own {
        let reported_already = newest.kind != OperationKind::Do
            || matches!(
                newest.effect,
                OperationEffect::Recombine { .. }
                    | OperationEffect::RecombineAgain { .. }
                    | OperationEffect::Delete { .. }
                    | OperationEffect::Propose(_)
            );
        return (!reported_already).then(|| operation_sentence(&newest.effect, language));
    }
    let what = match newest.kind {
        OperationKind::Undo => undo_sentence(&newest.effect, language),
        _ => operation_sentence(&newest.effect, language),
    };
    let values: [(&str, &dyn std::fmt::Display); 2] = [("who", &newest.author), ("what", &what)];
    Some(fill_text_braces(words::BY_OTHERS.text_in_language(language), &values))
}

/// Returns how many operations are in effect.
pub(crate) fn count_standing_operations(operations: &[OperationRow]) -> usize {
    let all = standings(operations);
    all.values()
        .filter(|standing| matches!(standing, OperationStanding::Stands(_)))
        .count()
}

#[cfg(test)]
mod tests {
    use chereme_corpus::words::effect::{AnnotationDeed, AnnotationEffect, ValuedThing};

    use super::*;

    fn import(file: &str) -> OperationEffect {
        OperationEffect::Import {
            count: 1,
            first: file.into(),
            last: file.into(),
        }
    }

    fn row(id: i64, kind: OperationKind, target: Option<i64>, effect: &OperationEffect) -> OperationRow {
        OperationRow {
            id,
            at: "2026-01-02T03:04:05Z".into(),
            author: "Zoé".into(),
            kind,
            target,
            name: String::new(),
            summary: String::new(),
            effect: effect.clone(),
            changes: 1,
            stands: true,
        }
    }

    #[test]
    fn step_counts_lead_to_every_reachable_operation() {
        let import = import("a");
        let own = |id| row(id, OperationKind::Do, None, &import);
        let undo = |id, of| row(id, OperationKind::Undo, Some(of), &import);
        let redo = |id, of| row(id, OperationKind::Redo, Some(of), &import);
        let mut all = vec![own(1), own(2), own(3), undo(4, 3), undo(5, 2), redo(6, 2)];
        all.reverse();
        let of = |all: &[OperationRow]| -> Vec<(i64, OperationStanding)> {
            history_rows(all, InterfaceLanguage::English, "")
                .iter()
                .map(|row| (row.id, row.standing))
                .collect()
        };
        use OperationStanding::{Gone, Stands, Undone};
        assert_eq!(of(&all), [(3, Undone(1)), (2, Stands(0)), (1, Stands(1))]);
        all.insert(0, own(7));
        assert_eq!(of(&all), [(7, Stands(0)), (3, Gone), (2, Stands(1)), (1, Stands(2))]);
        assert_eq!(count_standing_operations(&all), 3);
    }

    #[test]
    fn new_operations_are_named_with_the_other_author() {
        let before = [row(1, OperationKind::Do, None, &import("a.bvh"))];
        let summary = "3 handshapes changed to U in Un";
        let changed = |deed| AnnotationEffect {
            changes: vec![deed],
            recordings: 1,
            recording: "Un".into(),
        };
        let did = OperationEffect::Annotate(changed(AnnotationDeed::AnnotationsValued {
            count: 3,
            of: ValuedThing::Handshape,
            value: "U".into(),
        }));
        let did = row(2, OperationKind::Do, None, &did);
        let removed = changed(AnnotationDeed::AnnotationsRemoved { count: 2 });
        let removed = OperationEffect::Annotate(removed);
        let undid = row(3, OperationKind::Undo, Some(2), &removed);
        let made = OperationEffect::Recombine {
            gloss: "A".into(),
            recipe: "B".into(),
        };
        let made = row(2, OperationKind::Do, None, &made);
        let proposed = changed(AnnotationDeed::AnnotationsAdded { count: 3 });
        let proposed = OperationEffect::Propose(proposed);
        let proposed = row(2, OperationKind::Do, None, &proposed);
        let said = |now: &OperationRow, own| {
            let now = [now.clone(), before[0].clone()];
            newest_operation_news([&before, &now], own, InterfaceLanguage::English)
        };
        assert_eq!(said(&did, true).as_deref(), Some(summary));
        assert_eq!(
            said(&did, false).as_deref(),
            Some("Zoé changed the corpus in another program: 3 handshapes changed to U in Un")
        );
        assert_eq!(
            said(&undid, false).as_deref(),
            Some("Zoé changed the corpus in another program: 2 annotations restored in Un")
        );
        assert_eq!((said(&undid, true), said(&made, true)), (None, None));
        assert_eq!(said(&proposed, true), None, "its own notice says more");
        assert_eq!(
            newest_operation_news([&before, &before], true, InterfaceLanguage::English),
            None
        );
    }

    #[test]
    fn the_list_is_filtered_by_author_and_operation() {
        let all = [
            row(2, OperationKind::Do, None, &import("chat.bvh")),
            row(1, OperationKind::Do, None, &import("bol.bvh")),
        ];
        let ids = |filter: &str| -> Vec<i64> {
            history_rows(&all, InterfaceLanguage::English, filter)
                .iter()
                .map(|it| it.id)
                .collect()
        };
        assert_eq!(ids("zoe"), [2, 1]);
        assert_eq!(ids("zoe bol"), [1]);
        assert!(ids("nobody").is_empty());
    }
}
