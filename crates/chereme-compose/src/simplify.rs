//! Simplifies pipelines: removes neighbours that cancel out, and merges those that can be one.

use crate::ops::OperatorNeighbours;
use crate::recipe::*;

/// A step to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlannedStep {
    /// Its index in the pipe as written; for merged steps, that of the first.
    pub(crate) index: usize,
    pub(crate) step: Step,
}

/// Returns the steps of a pipe that have an effect.
pub(crate) fn plan_effective_steps(steps: &[Step]) -> Vec<PlannedStep> {
    let mut kept: Vec<PlannedStep> = Vec::with_capacity(steps.len());
    for (index, step) in steps.iter().enumerate() {
        let operator = step.operator();
        if operator.is_nothing() {
            continue;
        }
        let before = kept.last_mut().map(|planned| &mut planned.step);
        match before.map_or(OperatorNeighbours::Apart, |before| {
            operator.relation_to_previous(before)
        }) {
            OperatorNeighbours::Nothing => drop(kept.pop()),
            OperatorNeighbours::One => {}
            OperatorNeighbours::Apart => kept.push(PlannedStep {
                index,
                step: step.clone(),
            }),
        }
    }
    kept
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Returns the recipe that evaluation carries out: that for the same sign with the fewest operators.
    pub(crate) fn simplified_recipe(recipe: &Recipe) -> Recipe {
        Recipe {
            root: simplify_node(&recipe.root),
        }
    }

    fn simplify_node(of: &RecipeNode) -> RecipeNode {
        match of {
            RecipeNode::Pipe(pipe) => {
                let steps: Vec<Step> = plan_effective_steps(&pipe.steps).into_iter().map(|p| p.step).collect();
                let of = simplify_node(&pipe.of);
                if steps.is_empty() {
                    return of;
                }
                RecipeNode::Pipe(OperatorPipe {
                    of: Box::new(of),
                    steps,
                })
            }
            RecipeNode::Then(then) => RecipeNode::Then(RecipeChain {
                first: Box::new(simplify_node(&then.first)),
                next: then
                    .next
                    .iter()
                    .map(|joined| JoinedPiece {
                        via: joined.via,
                        node: simplify_node(&joined.node),
                    })
                    .collect(),
            }),
            leaf => leaf.clone(),
        }
    }

    #[test]
    fn steps_without_effect_are_left_out() {
        for (text, simple) in [
            ("A | reverse | reverse", "A"),
            ("A | swap | reverse | reverse | swap", "A"),
            ("A | reverse | swap | reverse", "A | reverse | swap | reverse"),
            ("A | repeat 1 | retime 100% | amplify 1 | place both by up 0cm", "A"),
            (
                "A | place both by left 60cm | place both by right 60cm",
                "A | place both by left 60cm right 60cm",
            ),
            (
                "A | place both by left 5cm | place right by right 5cm",
                "A | place both by left 5cm | place right by right 5cm",
            ),
            (
                "(A | mirror then B | swap | swap) | reverse",
                "(A | mirror then B) | reverse",
            ),
        ] {
            let recipe: Recipe = text.parse().expect(text);
            assert_eq!(simplified_recipe(&recipe).to_string(), simple);
        }
    }
}
