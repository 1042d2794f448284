//! Bringing a tree into its one normal form, and refusing what could never be made.

use crate::error::RecipeError;
use crate::recipe::*;
use crate::units::{Hands, Length, Seconds, towards};
use chereme_sign::cue::Alphabet;

/// The deepest nesting of pipes and utterances.
pub const DEEPEST: usize = 32;
/// The most sources and operators.
pub const MOST_PARTS: usize = 1000;
/// The longest time in seconds that a recipe can name: that of a day.
const LONGEST: f64 = 86_400.0;
/// The most repetitions.
pub const MOST_REPETITIONS: u32 = 1000;

impl Recipe {
    /// Returns the recipe of a tree, with nested pipes and utterances laid out flat.
    ///
    /// # Errors
    /// [`RecipeError`] where a number, list or size is outside of what can be made.
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
    let step = match node {
        Node::Spell(_) => "spell",
        Node::Point(_) => "point",
        Node::Cue(_) => "cue",
        Node::Hamnosys(_) => "hamnosys",
        Node::Sigml(_) => "sigml",
        _ => "sign",
    };
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
            pipe.steps.iter().try_for_each(check_step)
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

fn check_step(step: &Step) -> Result<(), RecipeError> {
    let name = step.name();
    match step {
        Step::Reverse | Step::Swap | Step::Trim => Ok(()),
        Step::Span(cut) => check_cut(name, cut),
        Step::Configure(configure) => {
            filled(name, &configure.values, "no value is given")?;
            configure
                .values
                .iter()
                .try_for_each(|value| choice(name, value))?;
            via(name, &configure.via)
        }
        Step::Place(place) => match &place.to {
            Goal::By(legs) => {
                filled(name, legs, "no way is given")?;
                check_legs(name, legs)
            }
            Goal::Near { of, by } => {
                named(name, of, "the name of the sign is empty")?;
                check_legs(name, by)
            }
            Goal::At(value) => named(name, value, "the name of the placement is empty"),
            Goal::Best(query) => named(name, query, "the query is empty"),
            Goal::AtPoint(point) => point.iter().try_for_each(|&at| length(name, at)),
        },
        Step::Mirror(mirror) if mirror.from == crate::units::Hands::Both => {
            Err(RecipeError::Empty {
                step: name,
                what: "one arm is copied to the other; name right, left, dominant or weak",
            })
        }
        Step::Mirror(_) => Ok(()),
        Step::Repeat(repeat) => {
            let times = f64::from(repeat.times);
            range(
                name,
                "the number of times",
                times,
                1.0,
                f64::from(MOST_REPETITIONS),
            )?;
            for (what, factor) in [("scale", repeat.scale), ("tempo", repeat.tempo)] {
                if let Some(factor) = factor {
                    range(name, what, factor.0, 0.05, 20.0)?;
                }
            }
            time(name, "gap", repeat.gap, 60.0)?;
            via(name, &repeat.via)
        }
        Step::Orient(orient) => {
            if orient.palm.is_empty() && orient.fingers.is_empty() && orient.by.is_empty() {
                let what = "neither palm nor fingers nor a turn is given";
                return Err(RecipeError::Empty { step: name, what });
            }
            for directions in [&orient.palm, &orient.fingers] {
                if !directions.is_empty() {
                    way(name, directions)?;
                }
            }
            orient
                .by
                .iter()
                .try_for_each(|turn| range(name, "the angle", turn.angle.0, -360.0, 360.0))
        }
        Step::Amplify(amplify) => range(name, "the factor", amplify.by.0, 0.0, 20.0),
        Step::Travel(travel) => {
            if !travel.path.is_empty() && !travel.through.is_empty() {
                let what = "it has legs and a curve: keep one of them";
                return Err(RecipeError::Empty { step: name, what });
            }
            if travel.through.is_empty() {
                filled(name, &travel.path, "no way is given")?;
                if travel.time.is_some() {
                    let what =
                        "only a curve has a time; each leg has its own, such as left 5cm in 0.2s";
                    return Err(RecipeError::Empty { step: name, what });
                }
            }
            check_legs(name, &travel.path)?;
            if travel.through.len() > MOST_POINTS {
                let what = "the curve has more than 64 points";
                return Err(RecipeError::Empty { step: name, what });
            }
            for point in &travel.through {
                point.iter().try_for_each(|it| length(name, *it))?;
            }
            time(name, "the time", travel.time, 600.0)?;
            via(name, &travel.via)
        }
        Step::Retime(retime) => {
            filled(name, &retime.paces, "no pace is given")?;
            retime.paces.iter().try_for_each(|pace| match *pace {
                Pace::Times(factor) => range(name, "the factor", factor.0, 0.05, 20.0),
                Pace::To(seconds) => range(name, "the time", seconds.0, 0.01, 600.0),
            })
        }
        Step::Nonmanual(nonmanual) => {
            named(name, &nonmanual.from, "the name of the sign is empty")?;
            optional(
                nonmanual.function.as_deref(),
                name,
                "the name of the function is empty",
            )?;
            match &nonmanual.over {
                None => Ok(()),
                Some(Over::Part(cut)) => check_cut(name, cut),
                Some(Over::At(times)) => {
                    for at in times {
                        range(name, "a milestone", at.0, -LONGEST, LONGEST)?;
                    }
                    if times.windows(2).any(|pair| pair[0].0 > pair[1].0) {
                        let what = "milestones decrease; write M1 to M5 in order of time";
                        return Err(RecipeError::Empty { step: name, what });
                    }
                    Ok(())
                }
            }
        }
        Step::Indicate(indicate) => {
            if indicate.from.is_none() && indicate.to.is_none() {
                let what = "neither where it starts nor where it ends is given";
                return Err(RecipeError::Empty { step: name, what });
            }
            [&indicate.from, &indicate.to]
                .into_iter()
                .flatten()
                .try_for_each(|at| spot(name, at))
        }
    }
}

/// The most points of a curve.
const MOST_POINTS: usize = 64;

fn check_cut(step: &'static str, cut: &Cut) -> Result<(), RecipeError> {
    time(step, "the start", cut.from, LONGEST)?;
    time(step, "the end", cut.to, LONGEST)?;
    let (from, to) = (cut.from.map_or(0.0, |it| it.0), cut.to.map(|it| it.0));
    if to.is_some_and(|to| to <= from) || (cut.from.is_none() && to.is_none()) {
        let what = "it ends before it begins; write the earlier time first, such as 0.4s..1.9s";
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

fn check_legs(step: &'static str, legs: &[Leg]) -> Result<(), RecipeError> {
    legs.iter().try_for_each(|leg| {
        way(step, &leg.towards)?;
        length(step, leg.distance)?;
        time(step, "the time", leg.time, 600.0)
    })
}

fn way(step: &'static str, directions: &[crate::units::Direction]) -> Result<(), RecipeError> {
    if towards(directions).is_none() || directions.len() > 6 {
        let what = "the directions are missing, too many, or cancel out";
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

fn length(step: &'static str, length: Length) -> Result<(), RecipeError> {
    match length {
        Length::Metres(metres) => range(step, "the length in metres", metres, -10.0, 10.0),
        Length::Arm(share) => range(step, "the share of the arm", share, -10.0, 10.0),
    }
}

fn time(
    step: &'static str,
    what: &'static str,
    time: Option<Seconds>,
    most: f64,
) -> Result<(), RecipeError> {
    time.map_or(Ok(()), |time| range(step, what, time.0, 0.0, most))
}

fn via(step: &'static str, via: &Transition) -> Result<(), RecipeError> {
    time(step, "the transition's time", via.time, 60.0)
}

fn range(
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

fn choice(step: &'static str, choice: &Choice) -> Result<(), RecipeError> {
    match choice {
        Choice::Keep => Ok(()),
        Choice::Value(text) => named(step, text, "the value is empty"),
        Choice::From(text) => named(step, text, "the name of the sign is empty"),
        Choice::Best(text) => named(step, text, "the query is empty"),
    }
}

fn spot(step: &'static str, spot: &Spot) -> Result<(), RecipeError> {
    match spot {
        Spot::Me | Spot::You => Ok(()),
        Spot::Towards(directions) => way(step, directions),
        Spot::Value(text) => named(step, text, "the name of the placement is empty"),
        Spot::Point(point) => point.iter().try_for_each(|&at| length(step, at)),
    }
}

fn named(step: &'static str, text: &str, what: &'static str) -> Result<(), RecipeError> {
    if text.trim().is_empty() {
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

fn optional(text: Option<&str>, step: &'static str, what: &'static str) -> Result<(), RecipeError> {
    text.map_or(Ok(()), |text| named(step, text, what))
}

fn filled<T>(step: &'static str, list: &[T], what: &'static str) -> Result<(), RecipeError> {
    if list.is_empty() {
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}
