//! From the tree to text.

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

/// Words that mean something somewhere; as a name each is quoted.
const RESERVED: [&str; 44] = [
    "spell",
    "point",
    "hamnosys",
    "sigml",
    "then",
    "via",
    "with",
    "using",
    "on",
    "hold",
    "by",
    "at",
    "near",
    "_",
    "best",
    "me",
    "you",
    "in",
    "out",
    "about",
    "palm",
    "fingers",
    "scale",
    "tempo",
    "gap",
    "mirror",
    "configure",
    "place",
    "reverse",
    "swap",
    "repeat",
    "orient",
    "amplify",
    "travel",
    "retime",
    "nonmanual",
    "over",
    "phases",
    "span",
    "trim",
    "from",
    "to",
    "forwards",
    "backwards",
];

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
        && !RESERVED.contains(&name)
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

fn option(f: &mut Formatter<'_>, word: &str, value: Option<impl Display>) -> fmt::Result {
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

fn point_text(f: &mut Formatter<'_>, point: &[Length; 3]) -> fmt::Result {
    list(f, point, ",")
}

fn list(
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

impl Display for Nonmanual {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("nonmanual ")?;
        if let Some(function) = &self.function {
            write!(f, "{} ", Name(function))?;
        }
        write!(f, "from {}", Name(&self.from))?;
        match &self.over {
            None => {}
            Some(Over::Part(cut)) => {
                f.write_str(" over ")?;
                list(f, cut.from, "")?;
                f.write_str("..")?;
                list(f, cut.to, "")?;
            }
            Some(Over::At(times)) => {
                f.write_str(" over ")?;
                list(f, times, ", ")?;
            }
        }
        f.write_str(if self.by_phases { " by phases" } else { "" })
    }
}

impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Configure(configure) => {
                write!(f, "configure {} ", configure.hand.name())?;
                list(f, &configure.values, ", ")?;
                write!(f, "{}", configure.via)
            }
            Self::Place(place) => write!(f, "{place}"),
            Self::Reverse | Self::Swap | Self::Trim => f.write_str(self.name()),
            Self::Span(cut) => {
                f.write_str("span ")?;
                list(f, cut.from, "")?;
                f.write_str("..")?;
                list(f, cut.to, "")
            }
            Self::Mirror(mirror) if mirror.from == Hands::Dominant => f.write_str("mirror"),
            Self::Mirror(mirror) => write!(f, "mirror {}", mirror.from.name()),
            Self::Repeat(repeat) => {
                write!(f, "repeat {}", repeat.times)?;
                option(f, "scale", repeat.scale)?;
                option(f, "tempo", repeat.tempo)?;
                option(f, "gap", repeat.gap)?;
                write!(f, "{}", repeat.via)
            }
            Self::Orient(orient) => write!(f, "{orient}"),
            Self::Amplify(amplify) => write!(f, "amplify {} {}", amplify.hand.name(), amplify.by),
            Self::Travel(travel) => {
                write!(f, "travel {} ", travel.hand.name())?;
                list(f, &travel.path, " then ")?;
                for (n, point) in travel.through.iter().enumerate() {
                    f.write_str(if n == 0 { "through " } else { " then " })?;
                    point_text(f, point)?;
                }
                option(f, "in", travel.time)?;
                write!(f, "{}", travel.via)
            }
            Self::Retime(retime) => {
                f.write_str("retime ")?;
                list(f, &retime.paces, ", ")
            }
            Self::Nonmanual(nonmanual) => write!(f, "{nonmanual}"),
            Self::Indicate(indicate) => {
                let from = indicate.from.as_ref().map(|spot| format!("from {spot}"));
                let to = indicate.to.as_ref().map(|spot| format!("to {spot}"));
                list(f, from.into_iter().chain(to), " ")?;
                let hand = (indicate.hand != Hands::Both).then(|| indicate.hand.name());
                option(f, "with", hand)
            }
        }
    }
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "place {} ", self.hand.name())?;
        match &self.to {
            Goal::By(legs) => {
                f.write_str("by ")?;
                list(f, legs, " ")?;
            }
            Goal::At(value) => write!(f, "at {}", Name(value))?,
            Goal::AtPoint(point) => {
                f.write_str("at ")?;
                point_text(f, point)?;
            }
            Goal::Near { of, by } => {
                write!(f, "near {}", Name(of))?;
                if !by.is_empty() {
                    f.write_str(" by ")?;
                    list(f, by, " ")?;
                }
            }
            Goal::Best(query) => write!(f, "at best({query})")?,
        }
        option(f, "with", self.with.map(HandPoint::name))?;
        option(
            f,
            "using",
            (self.solver == Solver::Fabrik).then_some("fabrik"),
        )
    }
}

impl Display for Orient {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "orient {}", self.hand.name())?;
        for (word, directions) in [("palm", &self.palm), ("fingers", &self.fingers)] {
            if !directions.is_empty() {
                write!(f, " {word} ")?;
                list(f, directions.iter().map(|d| d.name()), " ")?;
            }
        }
        for turn in &self.by {
            write!(f, " by {} about {}", turn.angle, turn.about.name())?;
        }
        Ok(())
    }
}

impl Display for Pace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Times(factor) => write!(f, "{factor}"),
            Self::To(seconds) => write!(f, "to {seconds}"),
        }
    }
}
