//! Simplifies pipelines: removes neighbours that cancel out, and merges those that can be one.

use crate::ops::Neighbours;
use crate::recipe::*;

impl Recipe {
    /// Returns the recipe for the same sign with the fewest operators: pairs of `reverse` or `swap` are removed,
    /// displacements of the same hands are merged, and operators without effect are left out.
    ///
    /// Evaluation performs the same reduced steps, so that moving hands out of reach and back loses nothing.
    #[must_use]
    pub fn simplified(&self) -> Self {
        Self {
            root: node(&self.root),
        }
    }
}

/// A step to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Planned {
    /// Its index in the pipe as written; for merged steps, that of the first.
    pub(crate) index: usize,
    pub(crate) step: Step,
}

/// Returns the steps of a pipe that have an effect.
pub(crate) fn plan(steps: &[Step]) -> Vec<Planned> {
    let mut kept: Vec<Planned> = Vec::with_capacity(steps.len());
    for (index, step) in steps.iter().enumerate() {
        let operator = step.operator();
        if operator.is_nothing() {
            continue;
        }
        let before = kept.last_mut().map(|planned| &mut planned.step);
        match before.map_or(Neighbours::Apart, |before| operator.after(before)) {
            Neighbours::Nothing => drop(kept.pop()),
            Neighbours::One => {}
            Neighbours::Apart => kept.push(Planned {
                index,
                step: step.clone(),
            }),
        }
    }
    kept
}

fn node(of: &Node) -> Node {
    match of {
        Node::Pipe(pipe) => {
            let steps: Vec<Step> = plan(&pipe.steps).into_iter().map(|p| p.step).collect();
            let of = node(&pipe.of);
            if steps.is_empty() {
                return of;
            }
            Node::Pipe(Pipe {
                of: Box::new(of),
                steps,
            })
        }
        Node::Then(then) => Node::Then(Then {
            first: Box::new(node(&then.first)),
            next: then
                .next
                .iter()
                .map(|joined| Joined {
                    via: joined.via,
                    node: node(&joined.node),
                })
                .collect(),
        }),
        leaf => leaf.clone(),
    }
}

#[cfg(test)]
mod tests {
    use crate::Recipe;

    #[test]
    fn steps_without_effect_are_left_out() {
        for (text, simple) in [
            ("A | reverse | reverse", "A"),
            ("A | swap | reverse | reverse | swap", "A"),
            (
                "A | reverse | swap | reverse",
                "A | reverse | swap | reverse",
            ),
            (
                "A | repeat 1 | retime 100% | amplify 1 | place both by up 0cm",
                "A",
            ),
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
            assert_eq!(recipe.simplified().to_string(), simple);
        }
    }
}
