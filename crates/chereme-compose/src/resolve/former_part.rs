//! The previous recipe, whose answers are reused for parts that have not changed.

use crate::answers::RecipePath;
use crate::recipe::{JoinedPiece, Recipe, RecipeNode, Step};

/// A part of the previous recipe, with its path there.
#[derive(Debug, Clone)]
pub(super) struct FormerPart<'a> {
    node: &'a RecipeNode,
    pub(super) path: RecipePath,
}

impl<'a> FormerPart<'a> {
    pub(super) fn from_former_recipe(recipe: &'a Recipe) -> Self {
        Self {
            node: &recipe.root,
            path: RecipePath::default(),
        }
    }

    pub(super) fn is_same_node(&self, node: &RecipeNode) -> bool {
        self.node == node
    }

    /// Returns the operand of the operators, or the whole if there is no operator.
    pub(super) fn former_operand(&self) -> Self {
        match self.node {
            RecipeNode::Pipe(pipe) => Self {
                node: &pipe.of,
                path: self.path.operand_path(),
            },
            _ => self.clone(),
        }
    }

    /// Returns the first of several pieces, or the only one, with its operators.
    pub(super) fn first_former_piece(&self) -> Self {
        match self.node {
            RecipeNode::Then(then) => Self {
                node: &then.first,
                path: self.path.first_piece_path(),
            },
            _ => self.clone(),
        }
    }

    /// Returns the first source in it.
    pub(super) fn first_former_source(&self) -> Self {
        match self.node {
            RecipeNode::Pipe(_) => self.former_operand().first_former_source(),
            RecipeNode::Then(_) => self.first_former_piece().first_former_source(),
            _ => self.clone(),
        }
    }

    /// Returns the path of an equal operator.
    pub(super) fn former_step_path(&self, step: &Step) -> Option<RecipePath> {
        let RecipeNode::Pipe(pipe) = self.node else {
            return None;
        };
        let old_index = pipe.steps.iter().position(|old| old == step)?;
        Some(self.path.operator_step_path(old_index))
    }

    /// Returns the equal piece, or else the piece at the same position, among those after the first.
    pub(super) fn find_former_piece(&self, joined: &JoinedPiece, nth: usize) -> Option<Self> {
        let RecipeNode::Then(then) = self.node else {
            return None;
        };
        let same = then.next.iter().position(|old| old.node == joined.node);
        let piece_index = same.unwrap_or(nth);
        Some(Self {
            node: &then.next.get(piece_index)?.node,
            path: self.path.later_piece_path(piece_index).inner_piece_path(),
        })
    }
}
