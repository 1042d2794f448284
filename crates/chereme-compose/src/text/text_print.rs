//! Prints names and settings as they stand in a recipe.

use std::fmt::{self, Display, Formatter};

use crate::recipe_settings::*;
use crate::units::{BodyDirection, HandChoice, RecipeLength};

/// Every word with a meaning somewhere in recipes; as a name it is quoted.
#[rustfmt::skip]
const RESERVED_RECIPE_WORDS: [&str; 46] = [
    // Words of several places.
    "then", "via", "with", "on", "hold", "by", "at", "_", "best", "in", "out", "about", "forwards", "backwards",
    // The words that begin sources.
    "spell", "point", "cue", "hamnosys", "sigml",
    // The words that begin operators, which a test compares with the list of operators, and those inside their settings.
    "configure", "place", "orient", "travel", "amplify", "repeat", "reverse", "swap", "mirror", "retime",
    "span", "trim", "from", "to", "nonmanual", "face",
    "near", "using", "palm", "fingers", "scale", "tempo", "gap", "me", "you", "over", "phases",
];

/// A name in the spelling of recipes: plain if possible, else quoted.
pub(crate) struct QuotedName<'a>(pub(crate) &'a str);

impl Display for QuotedName<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let name = self.0;
        if is_plain(name) || is_address(name) {
            return f.write_str(name);
        }
        f.write_str(&quote_recipe_text(name))
    }
}

/// Returns a text in quotes.
pub(crate) fn quote_recipe_text(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn is_plain(name: &str) -> bool {
    let special = |c: char| c.is_whitespace() || "|,()\"".contains(c);
    !name.is_empty()
        && !name.contains(special)
        && !RESERVED_RECIPE_WORDS.contains(&name)
        && BodyDirection::from_word(name).is_none()
        && HandChoice::from_word(name).is_none()
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

impl Display for PostureTransition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_default() {
            return Ok(());
        }
        f.write_str(" via")?;
        write_option(f, "", self.profile.map(TransitionProfile::transition_profile_name))?;
        write_option(f, "", self.time)
    }
}

pub(crate) fn write_option(f: &mut Formatter<'_>, word: &str, value: Option<impl Display>) -> fmt::Result {
    match value {
        Some(value) if word.is_empty() => write!(f, " {value}"),
        Some(value) => write!(f, " {word} {value}"),
        None => Ok(()),
    }
}

impl Display for SpellSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "spell {} {}", QuotedName(&self.word), self.hand.hand_choice_name())?;
        write_option(f, "with", self.alphabet.as_deref().map(QuotedName))?;
        write_option(f, "hold", self.hold)?;
        write!(f, "{}", self.via)?;
        write_option(f, "on", self.on.as_deref().map(QuotedName))
    }
}

impl Display for CueSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "cue {} {}", QuotedName(&self.text), self.hand.hand_choice_name())?;
        write_option(f, "as", self.phones.as_deref().map(QuotedName))?;
        write_option(f, "with", self.code.as_deref().map(QuotedName))?;
        for variant in &self.variants {
            write!(f, " variant {}", QuotedName(variant))?;
        }
        write_option(
            f,
            "by",
            Some(self.phase.phase_rule_name()).filter(|_| !self.phase.is_default()),
        )?;
        write_option(f, "pace", self.pace)?;
        write_option(f, "on", self.on.as_deref().map(QuotedName))
    }
}

impl Display for NotationSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", QuotedName(&self.of))?;
        write_option(f, "with", self.language.as_deref().map(QuotedName))?;
        write_option(f, "on", self.on.as_deref().map(QuotedName))
    }
}

impl Display for PointSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "point {} at {}", self.hand.hand_choice_name(), self.at)?;
        write_option(f, "with", self.with.as_ref())?;
        write_option(f, "hold", self.hold)?;
        write!(f, "{}", self.via)?;
        write_option(f, "on", self.on.as_deref().map(QuotedName))
    }
}

impl Display for ValueChoice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Keep => f.write_str("_"),
            Self::Value(value) => write!(f, "{}", QuotedName(value)),
            Self::From(address) => write!(f, "from {}", QuotedName(address)),
            Self::Best(query) => write!(f, "best({query})"),
        }
    }
}

impl Display for SigningSpot {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Me => f.write_str("me"),
            Self::You => f.write_str("you"),
            Self::Towards(directions) => {
                write_separated_list(f, directions.iter().map(|d| d.body_direction_name()), " ")
            }
            Self::Value(value) => write!(f, "{}", QuotedName(value)),
            Self::Point(point) => point_text(f, point),
        }
    }
}

pub(crate) fn point_text(f: &mut Formatter<'_>, point: &[RecipeLength; 3]) -> fmt::Result {
    write_separated_list(f, point, ",")
}

pub(crate) fn write_separated_list(
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

impl Display for StraightLeg {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_separated_list(f, self.towards.iter().map(|d| d.body_direction_name()), " ")?;
        write!(f, " {}", self.distance)?;
        write_option(f, "in", self.time)
    }
}
