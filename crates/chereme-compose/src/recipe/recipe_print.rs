//! Prints the tree as text.

use std::fmt::{self, Display, Formatter};

use super::{Recipe, RecipeNode};
use crate::text::QuotedName;

impl Display for Recipe {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.root)
    }
}

impl Display for RecipeNode {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sign(address) => write!(f, "{}", QuotedName(address)),
            Self::Spell(spell) => write!(f, "{spell}"),
            Self::Point(point) => write!(f, "{point}"),
            Self::Cue(cue) => write!(f, "{cue}"),
            Self::Hamnosys(notation) => write!(f, "hamnosys {notation}"),
            Self::Sigml(notation) => write!(f, "sigml {notation}"),
            Self::Pipe(pipe) => {
                write_node_within(f, &pipe.of, matches!(*pipe.of, Self::Then(_)))?;
                pipe.steps.iter().try_for_each(|step| write!(f, " | {step}"))
            }
            Self::Then(then) => {
                write_node_within(f, &then.first, false)?;
                then.next.iter().try_for_each(|joined| {
                    write!(f, " then{} ", joined.via)?;
                    write_node_within(f, &joined.node, matches!(joined.node, Self::Then(_)))
                })
            }
        }
    }
}

fn write_node_within(f: &mut Formatter<'_>, node: &RecipeNode, parentheses: bool) -> fmt::Result {
    if parentheses {
        write!(f, "({node})")
    } else {
        write!(f, "{node}")
    }
}
