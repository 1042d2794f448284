//! Normalises the tree of a recipe, and refuses recipes that could never be evaluated.

use crate::error::RecipeError;
use crate::recipe::*;
use crate::units::{Hands, Length, Seconds, towards};
use chereme_sign::cue::Alphabet;

/// The deepest nesting of pipes and utterances.
pub const DEEPEST: usize = 32;
/// The most sources and operators.
pub const MOST_PARTS: usize = 1000;
/// The longest time in seconds that a recipe can state: a day.
pub(crate) const LONGEST: f64 = 86_400.0;

impl Recipe {
    /// Returns the recipe of a tree, with nested pipes and utterances flattened.
    ///
    /// # Errors
    /// [`RecipeError`] if a number, list or size is out of range.
    pub fn new(root: Node) -> Result<Self, RecipeError> {
        let mut parts = 0;
        check(&root, 0, &mut parts)?;
        Ok(Self { root: flat(root) })
    }

    /// Returns the tree.
    #[must_use]
    pub fn root(&self) -> &Node {
        &self.root
    }
}

fn flat(node: Node) -> Node {
    match node {
        Node::Pipe(pipe) => {
            let mut steps = pipe.steps;
            match flat(*pipe.of) {
                Node::Pipe(mut inner) => {
                    inner.steps.append(&mut steps);
                    Node::Pipe(inner)
                }
                of if steps.is_empty() => of,
                of => Node::Pipe(Pipe {
                    of: Box::new(of),
                    steps,
                }),
            }
        }
        Node::Then(then) => {
            let mut next: Vec<Joined> = then.next;
            for joined in &mut next {
                joined.node = flat(std::mem::replace(
                    &mut joined.node,
                    Node::Sign(String::new()),
                ));
            }
            match flat(*then.first) {
                Node::Then(mut inner) => {
                    inner.next.append(&mut next);
                    Node::Then(inner)
                }
                first if next.is_empty() => first,
                first => Node::Then(Then {
                    first: Box::new(first),
                    next,
                }),
            }
        }
        leaf => leaf,
    }
}

fn check(node: &Node, depth: usize, parts: &mut usize) -> Result<(), RecipeError> {
    let step = node.name();
    if depth > DEEPEST {
        return Err(RecipeError::Size {
            what: "levels",
            most: DEEPEST,
        });
    }
    count(parts, 1)?;
    match node {
        Node::Sign(address) => named(step, address, "the name of the sign is empty"),
        Node::Spell(spell) => {
            named(step, &spell.word, "the word is empty")?;
            if spell.word.chars().count() > 200 {
                return Err(RecipeError::Size {
                    what: "letters in a word",
                    most: 200,
                });
            }
            optional(
                spell.alphabet.as_deref(),
                step,
                "the name of the alphabet is empty",
            )?;
            optional(spell.on.as_deref(), step, "the name of the signer is empty")?;
            time(step, "hold", spell.hold, 60.0)?;
            via(step, &spell.via)
        }
        Node::Point(point) => {
            spot(step, &point.at)?;
            if let Some(with) = &point.with {
                choice(step, with)?;
            }
            optional(point.on.as_deref(), step, "the name of the signer is empty")?;
            time(step, "hold", point.hold, 60.0)?;
            via(step, &point.via)
        }
        Node::Cue(cue) => {
            named(step, &cue.text, "there is nothing to cue")?;
            for (name, what) in [
                (&cue.phones, "the name of the alphabet is empty"),
                (&cue.code, "the name of the code is empty"),
                (&cue.on, "the name of the signer is empty"),
            ] {
                optional(name.as_deref(), step, what)?;
            }
            if let Some(phones) = &cue.phones
                && !Alphabet::ALL.iter().any(|it| it.name() == phones)
            {
                return Err(RecipeError::Empty {
                    step,
                    what: "phones are written as sampa, ipa or mfa",
                });
            }
            if cue.hand == Hands::Both {
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
        Node::Hamnosys(notation) | Node::Sigml(notation) => {
            named(step, &notation.of, "nothing is notated")?;
            optional(
                notation.language.as_deref(),
                step,
                "the name of the body language is empty",
            )?;
            optional(
                notation.on.as_deref(),
                step,
                "the name of the signer is empty",
            )
        }
        Node::Pipe(pipe) => {
            check(&pipe.of, depth + 1, parts)?;
            count(parts, pipe.steps.len())?;
            pipe.steps.iter().try_for_each(Step::check)
        }
        Node::Then(then) => {
            check(&then.first, depth + 1, parts)?;
            then.next.iter().try_for_each(|joined| {
                via("then", &joined.via)?;
                check(&joined.node, depth + 1, parts)
            })
        }
    }
}

fn count(parts: &mut usize, more: usize) -> Result<(), RecipeError> {
    *parts += more;
    if *parts > MOST_PARTS {
        return Err(RecipeError::Size {
            what: "sources and operators",
            most: MOST_PARTS,
        });
    }
    Ok(())
}

/// Checks the two ends of a part of a movement.
pub(crate) fn part(step: &'static str, cut: &Cut) -> Result<(), RecipeError> {
    time(step, "the start", cut.from, LONGEST)?;
    time(step, "the end", cut.to, LONGEST)?;
    let (from, to) = (cut.from.map_or(0.0, |it| it.0), cut.to.map(|it| it.0));
    if to.is_some_and(|to| to <= from) || (cut.from.is_none() && to.is_none()) {
        let what = "it ends before it begins; write the earlier time first, such as 0.4s..1.9s";
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

/// Checks straight legs.
pub(crate) fn legs(step: &'static str, legs: &[Leg]) -> Result<(), RecipeError> {
    legs.iter().try_for_each(|leg| {
        directions(step, &leg.towards)?;
        length(step, leg.distance)?;
        time(step, "the time", leg.time, 600.0)
    })
}

pub(crate) fn directions(
    step: &'static str,
    directions: &[crate::units::Direction],
) -> Result<(), RecipeError> {
    if towards(directions).is_none() || directions.len() > 6 {
        let what = "the directions are missing, too many, or cancel out";
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

pub(crate) fn length(step: &'static str, length: Length) -> Result<(), RecipeError> {
    match length {
        Length::Metres(metres) => range(step, "the length in metres", metres, -10.0, 10.0),
        Length::Arm(share) => range(step, "the share of the arm", share, -10.0, 10.0),
    }
}

pub(crate) fn time(
    step: &'static str,
    what: &'static str,
    time: Option<Seconds>,
    most: f64,
) -> Result<(), RecipeError> {
    time.map_or(Ok(()), |time| range(step, what, time.0, 0.0, most))
}

pub(crate) fn via(step: &'static str, via: &Transition) -> Result<(), RecipeError> {
    time(step, "the transition's time", via.time, 60.0)
}

pub(crate) fn range(
    step: &'static str,
    what: &'static str,
    found: f64,
    least: f64,
    most: f64,
) -> Result<(), RecipeError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(RecipeError::Range {
        step,
        what,
        found: found.to_string(),
        least,
        most,
    })
}

pub(crate) fn choice(step: &'static str, choice: &Choice) -> Result<(), RecipeError> {
    match choice {
        Choice::Keep => Ok(()),
        Choice::Value(text) => named(step, text, "the value is empty"),
        Choice::From(text) => named(step, text, "the name of the sign is empty"),
        Choice::Best(text) => named(step, text, "the query is empty"),
    }
}

pub(crate) fn spot(step: &'static str, spot: &Spot) -> Result<(), RecipeError> {
    match spot {
        Spot::Me | Spot::You => Ok(()),
        Spot::Towards(all) => directions(step, all),
        Spot::Value(text) => named(step, text, "the name of the placement is empty"),
        Spot::Point(point) => point.iter().try_for_each(|&at| length(step, at)),
    }
}

pub(crate) fn named(step: &'static str, text: &str, what: &'static str) -> Result<(), RecipeError> {
    if text.trim().is_empty() {
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

pub(crate) fn optional(
    text: Option<&str>,
    step: &'static str,
    what: &'static str,
) -> Result<(), RecipeError> {
    text.map_or(Ok(()), |text| named(step, text, what))
}

pub(crate) fn filled<T>(
    step: &'static str,
    list: &[T],
    what: &'static str,
) -> Result<(), RecipeError> {
    if list.is_empty() {
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}
