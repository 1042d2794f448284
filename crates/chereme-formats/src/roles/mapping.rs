//! A file that maps tiers and columns to their meanings.

use super::{AnnotatedHands, is_same_folded};
use chereme_sign::text::{did_you_mean, nearest_candidate};
use chereme_sign::{RoleError, SignPhase, TierRole, TierTopic};
use serde_json::Value;

/// The meaning of tiers and columns, by name or pattern.
///
/// The file is JSON with two lists, both optional:
///
/// ```json
/// {
///   "tiers": { "Config MD": "right.configuration", "*_G": "left.gloss", "Traduction": "translation" },
///   "columns": { "Lieu": "placement", "Forme": "dominant.configuration", "Remarques": "note" }
/// }
/// ```
///
/// `*` stands for any text and `?` for one character; case and accents do not count. An entry without a
/// pattern comes before those with one, and among patterns the first counts. A value is one of
/// [`TierRole::PLAIN_TIER_ROLES`] (or `note` and `attribute` of a column), or a component as queries
/// spell it, with an optional hand before it and an optional feature after it: `both.gloss`,
/// `nonmanual.brows`, `weak.configuration`, `translation.en` of a column.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TierMapping {
    tiers: Vec<(String, MappingTarget)>,
    columns: Vec<(String, MappingTarget)>,
}

/// The meaning in one entry of a [`TierMapping`].
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MappingTarget {
    /// The role of the annotations or values; `None` to leave them alone.
    pub role: Option<TierRole>,
    /// The hand that they describe.
    pub hand: Option<AnnotatedHands>,
    /// The phase of a column's values: initial, middle or final.
    pub phase: Option<SignPhase>,
    /// The language of a gloss or translation, of a column.
    pub language: Option<String>,
    /// Whether a column holds an attribute of the sign, a number or a text.
    pub attribute: bool,
}

/// The reason why a mapping file could not be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MappingError {
    /// The file is not JSON.
    #[error("line {line}, column {column}: the mapping is not JSON: {message}")]
    Json {
        /// The line, counted from 1.
        line: usize,
        /// The column, counted from 1.
        column: usize,
        /// The problem.
        message: String,
    },
    /// The file is JSON of another structure.
    #[error("{place}: a mapping is {{\"tiers\": {{\"NAME\": \"ROLE\"}}, \"columns\": {{\"NAME\": \"ROLE\"}}}}{}", did_you_mean(nearest.as_deref()))]
    Form {
        /// The key at which the structure differs.
        place: String,
        /// The most similar valid key.
        nearest: Option<String>,
    },
    /// An entry's value is not valid.
    #[error("{entry:?}: {source}")]
    Role {
        /// The entry's name or pattern.
        entry: String,
        /// The reason.
        source: RoleError,
    },
}

impl TierMapping {
    /// Reads a mapping file.
    ///
    /// # Errors
    /// [`MappingError`] if the text is not JSON, does not have the mapping's structure, or an entry is not
    /// valid; it names the entry.
    pub fn from_json(text: &str) -> Result<Self, MappingError> {
        let file: Value = serde_json::from_str(text).map_err(|error| MappingError::Json {
            line: error.line(),
            column: error.column(),
            message: error.to_string(),
        })?;
        let form = |place: &str| MappingError::Form {
            place: place.to_owned(),
            nearest: nearest_candidate(place, ["tiers", "columns"]).map(str::to_owned),
        };
        let mut mapping = Self::default();
        for (key, entries) in file.as_object().ok_or_else(|| form("the file"))? {
            let list = match &**key {
                "tiers" => &mut mapping.tiers,
                "columns" => &mut mapping.columns,
                _ => return Err(form(key)),
            };
            for (name, value) in entries.as_object().ok_or_else(|| form(key))? {
                let text = value.as_str().ok_or_else(|| form(name))?;
                let target = match &**key {
                    "columns" => MappingTarget::of_column(name, text)?,
                    _ => MappingTarget::parse_mapping_target(name, text)?,
                };
                list.push((name.clone(), target));
            }
        }
        Ok(mapping)
    }

    /// Returns this mapping, extended by the tier entries of `other` for names that it does not have.
    #[must_use]
    pub fn completed_by(&self, other: &Self) -> Self {
        let mut both = self.clone();
        let new = |(name, _): &&(String, MappingTarget)| self.tier_mapping_entry(name).is_none();
        both.tiers.extend(other.tiers.iter().filter(new).cloned());
        both
    }

    /// Returns the names and patterns of tiers and columns that the mapping has entries for.
    pub fn mapping_entry_names(&self) -> impl Iterator<Item = &str> {
        let all = self.tiers.iter().chain(&self.columns);
        all.map(|(entry, _)| entry.as_str())
    }

    /// Returns the entry for a tier of this name, with its meaning.
    #[must_use]
    pub fn tier_mapping_entry(&self, name: &str) -> Option<(&str, &MappingTarget)> {
        find_mapping_entry(&self.tiers, name)
    }

    /// Returns the entry for a column of this name, with its meaning.
    #[must_use]
    pub fn column_mapping_entry(&self, name: &str) -> Option<(&str, &MappingTarget)> {
        find_mapping_entry(&self.columns, name)
    }
}

fn find_mapping_entry<'m>(entries: &'m [(String, MappingTarget)], name: &str) -> Option<(&'m str, &'m MappingTarget)> {
    let exact = entries.iter().find(|(entry, _)| is_same_folded(entry, name));
    let matched_entry = exact.or_else(|| {
        let name = chereme_sign::text::fold_text(name);
        entries
            .iter()
            .find(|(entry, _)| is_wildcard_match(&chereme_sign::text::fold_text(entry), &name))
    });
    matched_entry.map(|(entry, target)| (&**entry, target))
}

/// Returns whether a pattern of `*` and `?` fits the whole of `name`.
fn is_wildcard_match(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n, mut star) = (0, 0, None);
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(c) if *c == '?' || *c == name[n] => {
                p += 1;
                n += 1;
            }
            _ => {
                let Some((at, from)) = star else { return false };
                star = Some((at, from + 1));
                p = at + 1;
                n = from + 1;
            }
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

impl MappingTarget {
    /// Reads a column title that states its own meaning: `right.configuration`.
    pub(crate) fn of_title(title: &str) -> Option<Self> {
        Self::parse_mapping_target(title, title).ok()
    }

    /// Reads the value of the entry `entry` for a column.
    fn of_column(entry: &str, text: &str) -> Result<Self, MappingError> {
        if text.trim().eq_ignore_ascii_case("attribute") {
            return Ok(Self {
                attribute: true,
                ..Self::default()
            });
        }
        Self::parse_mapping_target(entry, text)
    }

    /// Reads the value of the entry `entry`.
    pub(crate) fn parse_mapping_target(entry: &str, text: &str) -> Result<Self, MappingError> {
        if let Some((first, language)) = text.trim().split_once('.')
            && let Ok(role) = first.parse::<TierRole>()
            && role.role_component().is_none()
        {
            return Ok(Self {
                role: Some(role),
                language: Some(language.to_lowercase()),
                ..Self::default()
            });
        }
        let (topic, phase) = TierTopic::with_phase(text).map_err(|source| MappingError::Role {
            entry: entry.to_owned(),
            source,
        })?;
        Ok(Self {
            role: Some(topic.role),
            hand: topic.hand,
            phase,
            ..Self::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_match_by_name_and_by_pattern() {
        let mapping = TierMapping::from_json(
            r#"{"tiers": {"*": "free", "config ?D*": "right.configuration", "Été": "both.gloss"}, "columns": {"EN*": "translation.en"}}"#,
        )
        .expect("a mapping");
        for (name, entry) in [("ete", "Été"), ("Config MD 2", "*"), ("anything", "*")] {
            assert_eq!(mapping.tier_mapping_entry(name).map(|it| it.0), Some(entry), "{name}");
        }
        assert_eq!(
            mapping.tier_mapping_entry("ÉTÉ").and_then(|it| it.1.hand),
            Some(AnnotatedHands::Both)
        );
        assert_eq!(
            mapping
                .column_mapping_entry("EN gloss")
                .and_then(|it| it.1.language.as_deref()),
            Some("en")
        );
        assert_eq!(mapping.column_mapping_entry("NL gloss"), None);
    }

    #[test]
    fn own_entries_take_precedence_over_those_of_the_completing_mapping() {
        let mapping = |text| TierMapping::from_json(text).expect("a mapping");
        let own = mapping(r#"{"tiers": {"K*": "left.configuration"}}"#);
        let other = mapping(r#"{"tiers": {"K1": "right.gloss", "L1": "right.gloss"}}"#);
        let both = own.completed_by(&other);
        for (name, entry) in [("K1", Some("K*")), ("L1", Some("L1")), ("M1", None)] {
            assert_eq!(both.tier_mapping_entry(name).map(|it| it.0), entry, "{name}");
        }
    }

    #[test]
    fn patterns_match_with_stars_and_question_marks() {
        for (pattern, name, fits) in [
            ("", "", true),
            ("*", "", true),
            ("?", "", false),
            ("a*b*c", "a-b-b-c", true),
            ("a*b*c", "a-b-b-", false),
            ("**?", "ab", true),
            ("rh_*", "rh_config", true),
            ("rh_*", "lh_config", false),
        ] {
            assert_eq!(is_wildcard_match(pattern, name), fits, "{pattern} {name}");
        }
    }

    #[test]
    fn errors_name_the_entry_and_suggest_a_correction() {
        for (text, message) in [
            ("{\"tiers\": {", "line 1, column 11: the mapping is not JSON"),
            ("[]", "the file: a mapping is"),
            (
                "{\"tires\": {}}",
                "tires: a mapping is {\"tiers\": {\"NAME\": \"ROLE\"}, \"columns\": {\"NAME\": \"ROLE\"}}; did you mean \"tiers\"?",
            ),
            ("{\"tiers\": {\"RH\": 3}}", "RH: a mapping is"),
            (
                "{\"tiers\": {\"RH\": \"right.handshap\"}}",
                "\"RH\": \"right.handshap\" is no role; write gloss",
            ),
            (
                "{\"tiers\": {\"RH\": \"rigth.handshape\"}}",
                "\"RH\": \"rigth.handshape\" is no role",
            ),
        ] {
            let error = TierMapping::from_json(text).expect_err(text).to_string();
            assert!(error.starts_with(message), "{error}");
        }
        let error = TierMapping::from_json("{\"tiers\": {\"RH\": \"right.handshap\"}}").expect_err("no role");
        assert!(error.to_string().ends_with("did you mean \"handshape\"?"), "{error}");
    }
}
