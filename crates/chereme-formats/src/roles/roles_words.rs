//! The table of words in tier names.

use super::AnnotatedHands;
use chereme_sign::TierRole;
use chereme_sign::text::fold_text;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// The shipped table.
pub(super) static ROLE_WORD_TABLE: LazyLock<RoleWordTable> = LazyLock::new(|| {
    RoleWordTable::parse_role_words(chereme_data::schema_text("tier_words.json"))
        .expect("the shipped table of words is whole; a test reads it")
});

/// Words with their meanings.
#[derive(Debug, Default)]
pub(super) struct RoleWordTable {
    hands: BTreeMap<String, AnnotatedHands>,
    roles: BTreeMap<String, TierRole>,
    codes: BTreeMap<String, TierRole>,
}

/// The meanings of the words of a name, each with its word.
#[derive(Debug, Default)]
pub(super) struct RoleWordMatch {
    pub(super) hand: Option<(AnnotatedHands, String)>,
    pub(super) roles: Vec<(TierRole, String)>,
    /// Unknown words; single letters and words with digits do not count, as they number people and takes.
    pub(super) unknown: Vec<String>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RoleWordFile {
    hands: BTreeMap<String, Vec<String>>,
    roles: BTreeMap<String, Vec<String>>,
    codes: BTreeMap<String, Vec<String>>,
}

impl RoleWordTable {
    fn parse_role_words(text: &str) -> Result<Self, String> {
        let file: RoleWordFile = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let mut table = Self::default();
        for (name, words) in file.hands {
            let hand = AnnotatedHands::from_hand_name(&name).ok_or_else(|| format!("{name} is no hand"))?;
            table.hands.extend(words.into_iter().map(|word| (word, hand)));
        }
        for (name, words) in file.roles {
            let role: TierRole = name.parse().map_err(|_| format!("{name} is no role"))?;
            table.roles.extend(words.into_iter().map(|word| (word, role.clone())));
        }
        for (name, codes) in file.codes {
            let role: TierRole = name.parse().map_err(|_| format!("{name} is no role"))?;
            table.codes.extend(codes.into_iter().map(|code| (code, role.clone())));
        }
        Ok(table)
    }

    /// Returns the hand that a word means, if it means one.
    pub(super) fn hand_word_meaning(&self, word: &str) -> Option<AnnotatedHands> {
        self.hands.get(word).copied()
    }

    /// Returns the role of a tier whose name is a code, in its own case.
    pub(super) fn tier_code_role(&self, name: &str) -> Option<TierRole> {
        self.codes.get(name.trim()).cloned()
    }

    /// Finds the words of `name`; `hand` says which words are hands.
    pub(super) fn match_name_words(&self, name: &str, hand: impl Fn(&str) -> Option<AnnotatedHands>) -> RoleWordMatch {
        let pieces = split_tier_name(name);
        let mut name_match = RoleWordMatch::default();
        let mut spelt = 0;
        let mut take = |word: &str| {
            if let Some(hand) = hand(word) {
                if word.len() > spelt {
                    spelt = word.len();
                    name_match.hand = Some((hand, word.to_owned()));
                }
                return true;
            }
            self.roles.get(word).is_some_and(|role| {
                name_match.roles.push((role.clone(), word.to_owned()));
                true
            })
        };
        let (mut at, mut unknown) = (0, Vec::new());
        while at < pieces.len() {
            let joined = |n: usize| pieces.get(at..at + n).map(|pieces| pieces.concat());
            if let Some(n) = [3, 2]
                .into_iter()
                .find(|n| joined(*n).is_some_and(|word| word.len() > 3 && take(&word)))
            {
                at += n;
                continue;
            }
            if !take(&pieces[at]) {
                match self.split_compound_word(&pieces[at], &hand) {
                    Some(words) => words.into_iter().for_each(|word| _ = take(word)),
                    None => unknown.push(pieces[at].clone()),
                }
            }
            at += 1;
        }
        let plain = |word: &String| word.chars().count() > 1 && !word.contains(|c: char| c.is_ascii_digit());
        name_match.unknown = unknown.into_iter().filter(plain).collect();
        name_match
    }

    /// Splits a word such as `glossr` or `rhidgloss` into two or three that are known, one of
    /// them of four letters or more.
    fn split_compound_word<'w>(
        &self,
        word: &'w str,
        hand: &impl Fn(&str) -> Option<AnnotatedHands>,
    ) -> Option<Vec<&'w str>> {
        if word.len() > 40 || !word.is_ascii() {
            return None;
        }
        let is_part = |part: &str| hand(part).is_some() || self.roles.contains_key(part);
        let are_parts =
            |parts: &[&str]| parts.iter().all(|part| is_part(part)) && parts.iter().any(|part| part.len() >= 4);
        for first in 1..word.len() {
            let (a, rest) = word.split_at(first);
            if are_parts(&[a, rest]) {
                return Some(vec![a, rest]);
            }
        }
        for first in 1..word.len() {
            let (a, rest) = word.split_at(first);
            for second in (1..rest.len()).filter(|_| is_part(a)) {
                let (b, c) = rest.split_at(second);
                if are_parts(&[a, b, c]) {
                    return Some(vec![a, b, c]);
                }
            }
        }
        None
    }
}

/// Splits a name into its words: folded, split at everything except letters and digits, and without the
/// number that ends a word of four letters or more.
pub(super) fn split_tier_name(name: &str) -> Vec<String> {
    let folded = fold_text(name);
    let words = folded
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty());
    words
        .map(|word| {
            let plain = word.trim_end_matches(|c: char| c.is_ascii_digit());
            if plain.len() >= 4 {
                plain.to_owned()
            } else {
                word.to_owned()
            }
        })
        .collect()
}

/// Returns the words of a name, separated by one blank.
pub(crate) fn normalize_tier_name(name: &str) -> String {
    let folded = fold_text(name);
    let words: Vec<&str> = folded
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_sign::HandRef;

    #[test]
    fn the_built_in_table_is_complete_and_each_word_has_one_meaning() {
        let text = chereme_data::schema_text("tier_words.json");
        let file: RoleWordFile = serde_json::from_str(text).expect("a table");
        let words: Vec<&String> = file.hands.values().chain(file.roles.values()).flatten().collect();
        let mut once = words.clone();
        once.sort();
        once.dedup();
        assert_eq!(words.len(), once.len(), "a word stands twice");
        for word in &words {
            assert_eq!(fold_text(word), **word, "words are folded");
        }
        let table = RoleWordTable::parse_role_words(text).expect("a table");
        assert_eq!(
            table.hand_word_meaning("maindroite"),
            Some(AnnotatedHands::One(HandRef::Right))
        );
    }
}
