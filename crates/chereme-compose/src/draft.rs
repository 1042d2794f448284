//! A recipe in progress: a change evaluates only the parts that it touches.

use crate::draft_stages::KeptStages;
use crate::error::MakeError;
use crate::evaluate;
use crate::outcome::GeneratedMovement;
use crate::recipe::Recipe;
use crate::resolve::{self, ResolvedRecipe};
use crate::sources::RecipeSources;

/// A recipe that is evaluated repeatedly while it changes.
///
/// Movement is stored after every source, operator and join, so that only the parts after a change are evaluated again;
/// the result equals that of [`resolve_recipe`](crate::resolve_recipe()) and [`evaluate_recipe`](crate::evaluate_recipe()), bit by bit. The answers
/// for a part of the recipe are reused as long as that part does not change: call [`forget_draft_results`](Self::forget_draft_results) if the
/// corpus changed.
#[derive(Debug, Default)]
pub struct RecipeDraft {
    resolved: Option<ResolvedRecipe>,
    kept: KeptStages,
}

impl RecipeDraft {
    /// Generates the movement of a recipe; between two steps `goes_on` is asked whether the result is still wanted.
    ///
    /// # Errors
    /// Those of [`resolve_recipe`](crate::resolve_recipe()) and [`evaluate_recipe`](crate::evaluate_recipe()), and
    /// [`StepError::Stopped`](crate::StepError::Stopped) if the result is no longer wanted; the next call reuses the steps
    /// evaluated by then.
    pub fn generate_draft(
        &mut self,
        recipe: &Recipe,
        sources: &dyn RecipeSources,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<GeneratedMovement, MakeError> {
        let resolved = resolve::resolve_after_change(recipe, sources, self.resolved.as_ref())?;
        self.kept.begin_round();
        let made = evaluate::evaluate_with_kept(&resolved, Some(&mut self.kept), goes_on);
        // After an interruption the steps of earlier rounds may still be of use.
        if made.is_ok() {
            self.kept.drop_unused();
        }
        self.resolved = Some(resolved);
        made
    }

    /// Discards all results, so that the next evaluation starts from scratch.
    pub fn forget_draft_results(&mut self) {
        *self = Self::default();
    }
}
