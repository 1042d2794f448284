//! Findings about a query: the values that a condition widened to or matched, or the reason why it matches nothing.

use chereme_sign::SignComponent;
use chereme_sign::query::{QueryPlace, TokenQuery};
use serde::Serialize;
use serde::ser::SerializeMap;

/// The number of names listed in a message.
const MAX_LISTED_FINDING_NAMES: usize = 8;

/// A finding about a condition of a query, for the user.
#[derive(Debug, Clone, PartialEq)]
pub struct QueryFinding {
    /// The condition in its canonical form, such as `placement=head`.
    pub condition: String,
    /// The index of its first character in the query, and of the one after its last; for a condition of a saved search
    /// those of the saved search's name.
    pub at: (usize, usize),
    /// The kind, with its details.
    pub kind: FindingKind,
}

/// A kind of finding, with its details.
#[derive(Debug, Clone, PartialEq)]
pub enum FindingKind {
    /// `=` also matched narrower values than the named one; these are in the corpus. `==` does not match them.
    Widened {
        /// The narrower values, as they are coded.
        values: Vec<String>,
    },
    /// The condition also matched values that are equal to the named one.
    Equal {
        /// The field of the condition, if an alias in an inventory makes them equal; nothing if a person made them one.
        field: Option<String>,
        /// The other values as they are coded, each with the number of its tokens.
        values: Vec<(String, usize)>,
    },
    /// A pattern or a list of features matched these values of the corpus.
    Matched {
        /// The values, as they are coded.
        values: Vec<String>,
    },
    /// No value of this component, or of this part of it, is coded in the corpus.
    NotCoded {
        /// The component.
        component: SignComponent,
        /// The part of it, if the condition names one.
        part: Option<String>,
    },
    /// No token of the corpus can match.
    CannotMatch {
        /// The reason, in one sentence without a full stop.
        why: String,
        /// Possible alternatives: values, names, or whole conditions.
        names: Vec<String>,
    },
    /// Each term matches tokens by itself, but no token has all of them.
    NoneTogether {
        /// The terms, and the number of tokens that each matches by itself.
        terms: Vec<(String, usize)>,
    },
}

impl QueryFinding {
    pub(crate) fn new(condition: String, at: QueryPlace, kind: FindingKind) -> Self {
        let bounds = (at.start, at.end);
        Self {
            condition,
            at: bounds,
            kind,
        }
    }

    /// Returns the name of the kind in JSON, such as `cannot-match`.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self.kind {
            FindingKind::Widened { .. } => "widened",
            FindingKind::Equal { .. } => "equal",
            FindingKind::Matched { .. } => "matched",
            FindingKind::NotCoded { .. } => "not-coded",
            FindingKind::CannotMatch { .. } => "cannot-match",
            FindingKind::NoneTogether { .. } => "none-together",
        }
    }

    /// Returns possible alternatives to a condition that matches nothing: values, names, or whole conditions.
    #[must_use]
    pub fn alternative_names(&self) -> &[String] {
        match &self.kind {
            FindingKind::CannotMatch { names, .. } => names,
            _ => &[],
        }
    }

    /// Returns the query with the condition replaced by one of [`names`](Self::alternative_names); nothing if the condition is not
    /// in the query itself, but in a saved search.
    #[must_use]
    pub fn replace_query_condition(&self, query: &str, name: &str) -> Option<String> {
        // Places count letters, not bytes.
        let letters: Vec<char> = query.chars().collect();
        let (start, end) = self.at;
        let part = |range: std::ops::Range<usize>| -> Option<String> { Some(letters.get(range)?.iter().collect()) };
        let asked = part(start..end)?;
        let is_query = name.contains('=') && TokenQuery::parse_query(name).is_ok();
        let (before, after) = (part(0..start)?, part(end..letters.len())?);
        let changed = if is_query {
            match asked.contains(['=', ':']) {
                true => format!("{before}{name}{after}"),
                false => {
                    // The place is that of the value alone; its field stands before it.
                    let field = before.rfind([' ', '(']).map_or(0, |at| at + 1);
                    format!("{}{name}{after}", &before[..field])
                }
            }
        } else if let Some((tier, value)) = asked.split_once(')').filter(|pair| pair.0.contains('(')) {
            let (word, _) = tier.split_once('(')?;
            format!("{before}{word}({}){value}{after}", quote_finding_name(name))
        } else if let Some(at) = asked.find(['=', ':']) {
            format!("{before}{}{}{after}", &asked[..=at], quote_finding_name(name))
        } else {
            format!("{before}{}{after}", quote_finding_name(name))
        };
        // A replacement that cannot be read would lead the user into an error.
        TokenQuery::parse_query(&changed).is_ok().then_some(changed)
    }

    /// Returns the finding as a sentence.
    #[must_use]
    pub fn finding_message(&self) -> String {
        let condition = &self.condition;
        match &self.kind {
            FindingKind::Widened { values } => format!(
                "{condition} counts narrower values, too: {}; == counts the value alone",
                few(values)
            ),
            FindingKind::Equal { field, values } => {
                let counted = |(value, count): &(String, usize)| format!("{value} ({count})");
                let values = values.iter().map(counted).collect::<Vec<_>>().join(", ");
                match field {
                    Some(field) => format!(
                        "{condition} counts values that are equal to it by an alias, too: {values}; {field}== with one of \
                         these names counts it alone"
                    ),
                    None => format!("{condition} counts values that are one with it, too: {values}"),
                }
            }
            FindingKind::Matched { values } => format!("{condition} matched: {}", few(values)),
            FindingKind::NotCoded { component, part } => {
                let field = part
                    .as_ref()
                    .map_or(component.to_string(), |part| format!("{component}.{part}"));
                format!("{condition}: no {field} is coded in this corpus yet")
            }
            FindingKind::CannotMatch { why, names } if names.is_empty() => {
                format!("{condition} finds nothing: {why}")
            }
            FindingKind::CannotMatch { why, names } => {
                format!("{condition} finds nothing: {why}; there are: {}", few(names))
            }
            FindingKind::NoneTogether { terms } => {
                let terms: Vec<String> = terms.iter().map(|(term, count)| format!("{term} {count}")).collect();
                format!("no token has all of it; alone they find: {}", terms.join(", "))
            }
        }
    }
}

/// Returns a name in the spelling of queries.
pub(crate) fn quote_finding_name(name: &str) -> String {
    let bare = |letter: char| letter.is_alphanumeric() || "-_".contains(letter);
    if !name.is_empty() && name.chars().all(bare) {
        return name.to_owned();
    }
    format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Returns the first names of a list, and the number of remaining ones.
fn few(names: &[String]) -> String {
    let shown = names[..names.len().min(MAX_LISTED_FINDING_NAMES)].join(", ");
    match names.len().saturating_sub(MAX_LISTED_FINDING_NAMES) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

impl Serialize for QueryFinding {
    fn serialize<S: serde::Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        let mut map = out.serialize_map(None)?;
        map.serialize_entry("kind", self.kind_name())?;
        map.serialize_entry("condition", &self.condition)?;
        map.serialize_entry("at", &[self.at.0, self.at.1])?;
        map.serialize_entry("message", &self.finding_message())?;
        match &self.kind {
            FindingKind::Widened { values } | FindingKind::Matched { values } => {
                map.serialize_entry("values", values)?;
            }
            FindingKind::Equal { values, .. } => {
                let names: Vec<&String> = values.iter().map(|(value, _)| value).collect();
                let counts: std::collections::BTreeMap<_, _> = values.iter().cloned().collect();
                map.serialize_entry("values", &names)?;
                map.serialize_entry("counts", &counts)?;
            }
            FindingKind::NotCoded { component, part } => {
                map.serialize_entry("component", component)?;
                map.serialize_entry("part", part)?;
            }
            FindingKind::CannotMatch { names, .. } => map.serialize_entry("names", names)?,
            FindingKind::NoneTogether { terms } => {
                let counts: std::collections::BTreeMap<_, _> = terms.iter().cloned().collect();
                map.serialize_entry("terms", &counts)?;
            }
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_suggested_name_replaces_the_unknown_one_in_the_query() {
        for (query, at, name, changed) in [
            ("gloss=ESCARGUT", (6, 14), "ESCARGOT", "gloss=ESCARGOT"),
            ("a gloss=X b", (8, 9), "WEEK END", "a gloss=\"WEEK END\" b"),
            (
                "overlaps tier(\"nosuch\")=x",
                (9, 25),
                "Gloss RH",
                "overlaps tier(\"Gloss RH\")=x",
            ),
            (
                "(gloss:é movement=circle) or movement=arc",
                (18, 24),
                "movement.shape=circle",
                "(gloss:é movement.shape=circle) or movement=arc",
            ),
            (
                "movement=circle",
                (0, 15),
                "movement.shape=circle",
                "movement.shape=circle",
            ),
        ] {
            let finding = QueryFinding {
                condition: query.to_owned(),
                at,
                kind: FindingKind::CannotMatch {
                    why: "no token has it".to_owned(),
                    names: vec![name.to_owned()],
                },
            };
            assert_eq!(finding.alternative_names(), [name]);
            assert_eq!(finding.replace_query_condition(query, name).as_deref(), Some(changed));
            // Another query may not contain that place, for example one that names a saved search.
            assert_eq!(finding.replace_query_condition("é", name), None);
        }
    }
}
