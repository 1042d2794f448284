//! Prints the tree as text.

use std::fmt::{self, Display, Formatter};

use crate::recipe::*;
use crate::units::{Direction, Hands, Length};

impl Display for Recipe {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.root)
    }
}

impl Display for Node {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sign(address) => write!(f, "{}", Name(address)),
            Self::Spell(spell) => write!(f, "{spell}"),
            Self::Point(point) => write!(f, "{point}"),
            Self::Cue(cue) => write!(f, "{cue}"),
            Self::Hamnosys(notation) => write!(f, "hamnosys {notation}"),
            Self::Sigml(notation) => write!(f, "sigml {notation}"),
            Self::Pipe(pipe) => {
                within(f, &pipe.of, matches!(*pipe.of, Self::Then(_)))?;
                pipe.steps
                    .iter()
                    .try_for_each(|step| write!(f, " | {step}"))
            }
            Self::Then(then) => {
                within(f, &then.first, false)?;
                then.next.iter().try_for_each(|joined| {
                    write!(f, " then{} ", joined.via)?;
                    within(f, &joined.node, matches!(joined.node, Self::Then(_)))
                })
            }
        }
    }
}

fn within(f: &mut Formatter<'_>, node: &Node, parentheses: bool) -> fmt::Result {
    if parentheses {
        write!(f, "({node})")
    } else {
        write!(f, "{node}")
    }
}

/// Words with a meaning in several places; as names they are quoted, and so are the words of operators.
const RESERVED: [&str; 14] = [
    "then",
    "via",
    "with",
    "on",
    "hold",
    "by",
    "at",
    "_",
    "best",
    "in",
    "out",
    "about",
    "forwards",
    "backwards",
];

/// Returns whether a word has a meaning somewhere in recipes.
fn is_reserved(word: &str) -> bool {
    let mut operators = Step::SPELLINGS.iter();
    RESERVED.contains(&word)
        || Node::WORDS.contains(&word)
        || operators.any(|(words, keywords)| words.contains(&word) || keywords.contains(&word))
}

/// A name in the spelling of recipes: plain if possible, else quoted.
pub(crate) struct Name<'a>(pub(crate) &'a str);

impl Display for Name<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let name = self.0;
        if is_plain(name) || is_address(name) {
            return f.write_str(name);
        }
        f.write_str("\"")?;
        for c in name.chars() {
            if c == '"' || c == '\\' {
                f.write_str("\\")?;
            }
            write!(f, "{c}")?;
        }
        f.write_str("\"")
    }
}

fn is_plain(name: &str) -> bool {
    let special = |c: char| c.is_whitespace() || "|,()\"".contains(c);
    !name.is_empty()
        && !name.contains(special)
        && !is_reserved(name)
        && Direction::from_word(name).is_none()
        && Hands::from_word(name).is_none()
}

/// Returns whether `name` is an address with a quoted end, such as `recording:"NGT Thanks"`.
fn is_address(name: &str) -> bool {
    let Some((kind, quoted)) = name.split_once(":\"") else {
        return false;
    };
    let Some(inside) = quoted.strip_suffix('"') else {
        return false;
    };
    let mut escaped = false;
    let closed_early = inside.chars().any(|c| {
        let closes = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        closes
    });
    is_plain(kind) && !closed_early && !escaped
}

impl Display for Transition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_default() {
            return Ok(());
        }
        f.write_str(" via")?;
        option(f, "", self.profile.map(Profile::name))?;
        option(f, "", self.time)
    }
}

pub(crate) fn option(
    f: &mut Formatter<'_>,
    word: &str,
    value: Option<impl Display>,
) -> fmt::Result {
    match value {
        Some(value) if word.is_empty() => write!(f, " {value}"),
        Some(value) => write!(f, " {word} {value}"),
        None => Ok(()),
    }
}

impl Display for Spell {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "spell {} {}", Name(&self.word), self.hand.name())?;
        option(f, "with", self.alphabet.as_deref().map(Name))?;
        option(f, "hold", self.hold)?;
        write!(f, "{}", self.via)?;
        option(f, "on", self.on.as_deref().map(Name))
    }
}

impl Display for Cue {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "cue {} {}", Name(&self.text), self.hand.name())?;
        option(f, "as", self.phones.as_deref().map(Name))?;
        option(f, "with", self.code.as_deref().map(Name))?;
        for variant in &self.variants {
            write!(f, " variant {}", Name(variant))?;
        }
        option(
            f,
            "by",
            Some(self.phase.name()).filter(|_| !self.phase.is_default()),
        )?;
        option(f, "pace", self.pace)?;
        option(f, "on", self.on.as_deref().map(Name))
    }
}

impl Display for Notation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", Name(&self.of))?;
        option(f, "with", self.language.as_deref().map(Name))?;
        option(f, "on", self.on.as_deref().map(Name))
    }
}

impl Display for Point {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "point {} at {}", self.hand.name(), self.at)?;
        option(f, "with", self.with.as_ref())?;
        option(f, "hold", self.hold)?;
        write!(f, "{}", self.via)?;
        option(f, "on", self.on.as_deref().map(Name))
    }
}

impl Display for Choice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Keep => f.write_str("_"),
            Self::Value(value) => write!(f, "{}", Name(value)),
            Self::From(address) => write!(f, "from {}", Name(address)),
            Self::Best(query) => write!(f, "best({query})"),
        }
    }
}

impl Display for Spot {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Me => f.write_str("me"),
            Self::You => f.write_str("you"),
            Self::Towards(directions) => list(f, directions.iter().map(|d| d.name()), " "),
            Self::Value(value) => write!(f, "{}", Name(value)),
            Self::Point(point) => point_text(f, point),
        }
    }
}

pub(crate) fn point_text(f: &mut Formatter<'_>, point: &[Length; 3]) -> fmt::Result {
    list(f, point, ",")
}

pub(crate) fn list(
    f: &mut Formatter<'_>,
    items: impl IntoIterator<Item = impl Display>,
    between: &str,
) -> fmt::Result {
    for (n, item) in items.into_iter().enumerate() {
        let before = if n > 0 { between } else { "" };
        write!(f, "{before}{item}")?;
    }
    Ok(())
}

impl Display for Leg {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        list(f, self.towards.iter().map(|d| d.name()), " ")?;
        write!(f, " {}", self.distance)?;
        option(f, "in", self.time)
    }
}
