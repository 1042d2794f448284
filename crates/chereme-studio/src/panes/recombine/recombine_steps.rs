//! Undo and redo for the recipe, in one order with the operations on the corpus.

use chereme_corpus::{OperationKind, OperationRow};

/// How many steps are kept.
const MAX_KEPT_STEPS: usize = 200;

/// The history of pages of type `T` and operations.
#[derive(Debug)]
pub(super) struct StepHistory<T> {
    done: Vec<UndoStep<T>>,
    undone: Vec<UndoStep<T>>,
    /// The id of the newest operation of the corpus that is counted.
    newest: Option<i64>,
}

#[derive(Debug, Clone, PartialEq)]
enum UndoStep<T> {
    /// A change from the first page to the second.
    Page(T, T),
    /// An operation of the corpus.
    Corpus,
}

impl<T> Default for StepHistory<T> {
    fn default() -> Self {
        Self {
            done: Vec::new(),
            undone: Vec::new(),
            newest: None,
        }
    }
}

impl<T: Clone> StepHistory<T> {
    /// Records a change of the page.
    pub(super) fn record_page_change(&mut self, before: T, after: T) {
        self.done.push(UndoStep::Page(before, after));
        self.undone.clear();
        if self.done.len() > MAX_KEPT_STEPS {
            self.done.remove(0);
        }
    }

    /// Returns whether the corpus has operations that are not counted yet.
    pub(super) fn is_behind(&self, operations: &[OperationRow]) -> bool {
        self.newest.is_none() || operations.first().map(|operation| operation.id) > self.newest
    }

    /// Counts the new operations on the corpus; `operations` are the newest first.
    pub(super) fn count_new_operations(&mut self, operations: &[OperationRow]) {
        let newest = operations.first().map(|operation| operation.id);
        let Some(known) = self.newest else {
            self.newest = newest.or(Some(0));
            return;
        };
        let new_operations = operations.iter().take_while(|operation| operation.id > known);
        let new: Vec<OperationKind> = new_operations.map(|operation| operation.kind).collect();
        for kind in new.into_iter().rev() {
            match kind {
                OperationKind::Do => {
                    self.done.push(UndoStep::Corpus);
                    self.undone.clear();
                }
                OperationKind::Undo => go_over(&mut self.done, &mut self.undone),
                OperationKind::Redo => go_over(&mut self.undone, &mut self.done),
            }
        }
        self.newest = newest.or(self.newest);
    }

    /// Returns the page to go back to; `None` if the corpus is next.
    pub(super) fn step_page_back(&mut self) -> Option<T> {
        let entry = self.done.pop_if(|undo_step| matches!(undo_step, UndoStep::Page(..)))?;
        self.undone.push(entry.clone());
        match entry {
            UndoStep::Page(before, _) => Some(before),
            UndoStep::Corpus => None,
        }
    }

    /// Returns the page to go forward to; `None` if the corpus is next.
    pub(super) fn step_page_forward(&mut self) -> Option<T> {
        let entry = self
            .undone
            .pop_if(|undo_step| matches!(undo_step, UndoStep::Page(..)))?;
        self.done.push(entry.clone());
        match entry {
            UndoStep::Page(_, after) => Some(after),
            UndoStep::Corpus => None,
        }
    }
}

/// Moves the newest operation of the corpus from one list to the other.
fn go_over<T>(from: &mut Vec<UndoStep<T>>, to: &mut Vec<UndoStep<T>>) {
    if let Some(at) = from.iter().rposition(|undo_step| matches!(undo_step, UndoStep::Corpus)) {
        to.push(from.remove(at));
    }
}

#[cfg(test)]
mod tests {
    use chereme_corpus::words::effect::OperationEffect;

    use super::*;

    /// Returns operations of these kinds, the newest first; ids count up from 1.
    fn operations(kinds: &[OperationKind]) -> Vec<OperationRow> {
        let row = |(at, kind): (usize, &OperationKind)| OperationRow {
            id: at as i64 + 1,
            at: String::new(),
            author: String::new(),
            kind: *kind,
            target: None,
            name: String::new(),
            summary: String::new(),
            effect: OperationEffect::Mend {},
            changes: 1,
            stands: true,
        };
        kinds.iter().enumerate().map(row).rev().collect()
    }

    #[test]
    fn undo_takes_back_steps_of_recipe_and_corpus_in_order() {
        use OperationKind::{Do, Redo, Undo};
        let mut steps: StepHistory<&str> = StepHistory::default();
        steps.count_new_operations(&operations(&[Do]));
        assert_eq!(steps.step_page_back(), None, "what was there before is the corpus's");
        steps.record_page_change("", "A");
        steps.record_page_change("A", "A | swap");
        steps.count_new_operations(&operations(&[Do, Do]));
        steps.record_page_change("A | swap", "A");
        assert_eq!(steps.step_page_back(), Some("A | swap"));
        assert_eq!(steps.step_page_back(), None, "the corpus's turn");
        steps.count_new_operations(&operations(&[Do, Do, Undo]));
        assert_eq!(
            (steps.step_page_back(), steps.step_page_back(), steps.step_page_back()),
            (Some("A"), Some(""), None)
        );
        assert_eq!(
            (steps.step_page_forward(), steps.step_page_forward()),
            (Some("A"), Some("A | swap"))
        );
        assert_eq!(steps.step_page_forward(), None, "the corpus's turn");
        steps.count_new_operations(&operations(&[Do, Do, Undo, Redo]));
        assert_eq!(steps.step_page_forward(), Some("A"));
        steps.step_page_back();
        steps.record_page_change("A | swap", "B");
        assert_eq!(steps.step_page_forward(), None, "what was done instead ends it");
    }
}
