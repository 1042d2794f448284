//! Normalises the tree of a recipe, and refuses recipes that could never be evaluated.

use chereme_sign::cue::PhoneAlphabet;

use super::*;
use crate::check::*;
use crate::error::RecipeError;
use crate::units::HandChoice;

/// The deepest nesting of pipes and utterances.
pub const MAX_RECIPE_DEPTH: usize = 32;
/// The most sources and operators.
pub const MOST_PARTS: usize = 1000;

impl Recipe {
    /// Returns the recipe of a tree, with nested pipes and utterances flattened.
    ///
    /// # Errors
    /// [`RecipeError`] if a number, list or size is out of range.
    pub fn new(root: RecipeNode) -> Result<Self, RecipeError> {
        let mut parts = 0;
        check_recipe_node(&root, 0, &mut parts)?;
        Ok(Self {
            root: flatten_recipe_node(root),
        })
    }

    /// Returns the tree.
    #[must_use]
    pub fn recipe_root(&self) -> &RecipeNode {
        &self.root
    }
}

fn flatten_recipe_node(node: RecipeNode) -> RecipeNode {
    match node {
        RecipeNode::Pipe(pipe) => {
            let mut steps = pipe.steps;
            match flatten_recipe_node(*pipe.of) {
                RecipeNode::Pipe(mut inner) => {
                    inner.steps.append(&mut steps);
                    RecipeNode::Pipe(inner)
                }
                of if steps.is_empty() => of,
                of => RecipeNode::Pipe(OperatorPipe {
                    of: Box::new(of),
                    steps,
                }),
            }
        }
        RecipeNode::Then(then) => {
            let mut next: Vec<JoinedPiece> = then.next;
            for joined in &mut next {
                joined.node = flatten_recipe_node(std::mem::replace(&mut joined.node, RecipeNode::Sign(String::new())));
            }
            match flatten_recipe_node(*then.first) {
                RecipeNode::Then(mut inner) => {
                    inner.next.append(&mut next);
                    RecipeNode::Then(inner)
                }
                first if next.is_empty() => first,
                first => RecipeNode::Then(RecipeChain {
                    first: Box::new(first),
                    next,
                }),
            }
        }
        leaf => leaf,
    }
}

fn check_recipe_node(node: &RecipeNode, depth: usize, parts: &mut usize) -> Result<(), RecipeError> {
    let step = node.node_kind_name();
    if depth > MAX_RECIPE_DEPTH {
        return Err(RecipeError::Size {
            what: "levels",
            most: MAX_RECIPE_DEPTH,
        });
    }
    count_recipe_parts(parts, 1)?;
    match node {
        RecipeNode::Sign(address) => check_named_text(step, address, "the name of the sign is empty"),
        RecipeNode::Spell(spell) => {
            check_named_text(step, &spell.word, "the word is empty")?;
            if spell.word.chars().count() > 200 {
                return Err(RecipeError::Size {
                    what: "letters in a word",
                    most: 200,
                });
            }
            check_optional_text(spell.alphabet.as_deref(), step, "the name of the alphabet is empty")?;
            check_optional_text(spell.on.as_deref(), step, "the name of the signer is empty")?;
            check_step_time(step, "hold", spell.hold, 60.0)?;
            check_step_transition(step, &spell.via)
        }
        RecipeNode::Point(point) => {
            check_step_spot(step, &point.at)?;
            if let Some(with) = &point.with {
                check_step_choice(step, with)?;
            }
            check_optional_text(point.on.as_deref(), step, "the name of the signer is empty")?;
            check_step_time(step, "hold", point.hold, 60.0)?;
            check_step_transition(step, &point.via)
        }
        RecipeNode::Cue(cue) => {
            check_named_text(step, &cue.text, "there is nothing to cue")?;
            for (name, what) in [
                (&cue.phones, "the name of the alphabet is empty"),
                (&cue.code, "the name of the code is empty"),
                (&cue.on, "the name of the signer is empty"),
            ] {
                check_optional_text(name.as_deref(), step, what)?;
            }
            if let Some(phones) = &cue.phones
                && !PhoneAlphabet::ALL_ALPHABETS
                    .iter()
                    .any(|alphabet| alphabet.alphabet_name() == phones)
            {
                return Err(RecipeError::Empty {
                    step,
                    what: "phones are written as sampa, ipa or mfa",
                });
            }
            if cue.hand == HandChoice::Both {
                return Err(RecipeError::Empty {
                    step,
                    what: "one hand cues: name right, left, dominant or weak",
                });
            }
            match cue.pace {
                Some(pace) if !(0.1..=10.0).contains(&pace.0) => Err(RecipeError::Range {
                    step,
                    what: "pace",
                    found: pace.0.to_string(),
                    least: 0.1,
                    most: 10.0,
                }),
                _ => Ok(()),
            }
        }
        RecipeNode::Hamnosys(notation) | RecipeNode::Sigml(notation) => {
            check_named_text(step, &notation.of, "nothing is notated")?;
            check_optional_text(
                notation.language.as_deref(),
                step,
                "the name of the body language is empty",
            )?;
            check_optional_text(notation.on.as_deref(), step, "the name of the signer is empty")
        }
        RecipeNode::Pipe(pipe) => {
            check_recipe_node(&pipe.of, depth + 1, parts)?;
            count_recipe_parts(parts, pipe.steps.len())?;
            pipe.steps.iter().try_for_each(Step::check_step_settings)
        }
        RecipeNode::Then(then) => {
            check_recipe_node(&then.first, depth + 1, parts)?;
            then.next.iter().try_for_each(|joined| {
                check_step_transition("then", &joined.via)?;
                check_recipe_node(&joined.node, depth + 1, parts)
            })
        }
    }
}

fn count_recipe_parts(parts: &mut usize, more: usize) -> Result<(), RecipeError> {
    *parts += more;
    if *parts > MOST_PARTS {
        return Err(RecipeError::Size {
            what: "sources and operators",
            most: MOST_PARTS,
        });
    }
    Ok(())
}
