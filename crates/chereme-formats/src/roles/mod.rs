//! Infers the roles of tiers and columns in people's files, from their names or a mapping file.
//!
//! Names are looked up in `schema/tier_words.json`, a table of the words that projects use in several
//! languages; a [`Mapping`] overrides these guesses.

mod mapping;
mod words;

pub use chereme_sign::Hands;
pub use mapping::{Mapping, MappingError, Target};
pub(crate) use words::normal;

use crate::eaf::Transcript;
use chereme_sign::text::fold;
use chereme_sign::{Component, HandRef, Stereotype, TierRole, TierTopic};
use serde::Serialize;
use std::collections::BTreeSet;
use words::{Match, TABLE};

/// The properties of a tier that its role is inferred from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TierName<'a> {
    /// The tier's name.
    pub name: &'a str,
    /// The name of its ELAN tier type.
    pub kind: &'a str,
    /// The tier above, as an index into the list.
    pub parent: Option<usize>,
    /// Whether each of its annotations belongs to one of the tier above, with its time (ELAN's
    /// Symbolic_Association).
    pub one_to_one: bool,
}

/// The inferred role of a tier.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TierGuess {
    /// The tier's name.
    pub tier: String,
    /// The role of its annotations; `None` if unknown.
    pub role: Option<TierRole>,
    /// The hand that they describe.
    pub hand: Option<Hands>,
    /// The confidence, from 0 to 1; 1 for tiers of a mapping.
    pub confidence: f64,
    /// The evidence for the role.
    pub why: String,
}

impl TierGuess {
    /// Returns role and hand together, as mappings spell them; nothing if the role is unknown.
    #[must_use]
    pub fn topic(&self) -> Option<TierTopic> {
        let role = self.role.clone()?;
        let hand = self.hand;
        Some(TierTopic { role, hand })
    }
}

/// Returns the inferred role of each tier of a transcript; see [`guess_roles`].
#[must_use]
pub fn guess_tiers(transcript: &Transcript, mapping: &Mapping) -> Vec<TierGuess> {
    let names = transcript.tiers.iter().map(|tier| TierName {
        name: &tier.name,
        kind: &tier.kind,
        parent: tier.parent,
        one_to_one: tier.stereotype == Some(Stereotype::SymbolicAssociation),
    });
    guess_roles(&names.collect::<Vec<_>>(), mapping)
}

/// Returns the inferred role of each tier, in the same order.
///
/// The mapping comes first, then the words of the tier's own name, then those of its type. A tier that
/// names only a hand is a gloss tier; one without a hand takes the hand of the tier above. `MD` is the
/// right hand (*main droite*) unless other tiers name the weak one `MND`; the same holds for `D` if there
/// is an `ND`. A gloss tier with a one-to-one relation to another gloss tier above it holds a second
/// reading of the same signs, usually in another language: it is a translation, so that each sign stays
/// one token.
#[must_use]
pub fn guess_roles(tiers: &[TierName<'_>], mapping: &Mapping) -> Vec<TierGuess> {
    let context = Context::new(tiers.iter().map(|tier| tier.name));
    let mut guesses: Vec<TierGuess> = tiers
        .iter()
        .map(|tier| guess(tier, mapping, &context))
        .collect();
    let mut second_readings = BTreeSet::new();
    for (at, tier) in tiers.iter().enumerate() {
        let above = tier.parent.filter(|above| tier.one_to_one && *above != at);
        let reads_signs = |above: &usize| {
            let role = guesses.get(*above).and_then(|above| above.role.as_ref());
            role == Some(&TierRole::Gloss) || second_readings.contains(above)
        };
        if let Some(above) = above.filter(reads_signs)
            && guesses[at].role == Some(TierRole::Gloss)
            && guesses[at].confidence < 1.0
        {
            let above = &guesses[above];
            let why = format!(
                "{}, but each is one of the glosses above, {:?}",
                guesses[at].why, above.tier
            );
            let guess = &mut guesses[at];
            (guess.role, guess.hand, guess.why) = (Some(TierRole::Translation), None, why);
            second_readings.insert(at);
        }
    }
    for (at, tier) in tiers.iter().enumerate() {
        let manual = matches!(&guesses[at].role, Some(TierRole::Component { component, .. }) if component.is_manual());
        let above = tier
            .parent
            .and_then(|parent| guesses.get(parent))
            .and_then(|it| it.hand.map(|hand| (hand, it.tier.clone())));
        if let (true, None, Some((hand, name))) = (manual, guesses[at].hand, above) {
            let guess = &mut guesses[at];
            guess.hand = Some(hand);
            guess.confidence -= 0.1;
            guess.why = format!("{}; {hand} as the tier above, {name:?}", guess.why);
        }
    }
    guesses
}

/// The abbreviations in the tiers of one file.
struct Context {
    /// The dominant hand is `MD` or `D`, because the weak one is `MND` or `ND`.
    dominance: bool,
}

impl Context {
    fn new<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let pieces: BTreeSet<String> = names.flat_map(words::pieces).collect();
        Self {
            dominance: pieces.contains("mnd") || pieces.contains("nd"),
        }
    }

    fn hand(&self, word: &str) -> Option<Hands> {
        if matches!(word, "md" | "d") {
            let right = if self.dominance {
                HandRef::Dominant
            } else {
                HandRef::Right
            };
            return Some(Hands::One(right));
        }
        TABLE.hand(word)
    }
}

/// Returns the hand that each title of a table states, if it states one.
pub(crate) fn stated_hands(titles: &[String]) -> Vec<Option<Hands>> {
    let context = Context::new(titles.iter().map(String::as_str));
    let hand = |title: &String| TABLE.find(title, |word| context.hand(word)).hand;
    let all = titles.iter().map(hand);
    all.map(|found| found.map(|(hand, _)| hand)).collect()
}

/// Returns whether words, written as one, mean a hand and nothing else: `weakhand`.
pub(crate) fn is_hand(words: &str) -> bool {
    TABLE.hand(words).is_some()
}

fn guess(tier: &TierName<'_>, mapping: &Mapping, context: &Context) -> TierGuess {
    let name = tier.name.to_owned();
    if let Some((entry, target)) = mapping.tier(tier.name) {
        let why = format!("the mapping says so ({entry:?})");
        return TierGuess {
            tier: name,
            role: target.role.clone(),
            hand: target.hand,
            confidence: 1.0,
            why,
        };
    }
    let own = TABLE.find(tier.name, |word| context.hand(word));
    // A single letter such as "d" or "g" in the name of a type does not mean a hand.
    let spelt = |word: &str| context.hand(word).filter(|_| word.chars().count() > 2);
    let kind = TABLE.find(tier.kind, spelt);
    let hand = own
        .hand
        .as_ref()
        .or(kind.hand.as_ref())
        .map(|(hand, _)| *hand);
    let (role, confidence, why) = if let Some((role, word)) = role_of(&own) {
        (
            Some(role),
            if word.chars().count() > 3 { 0.9 } else { 0.75 },
            format!("{word:?} in its name"),
        )
    } else if let Some((role, word)) = role_of(&kind) {
        (
            Some(role),
            0.6,
            format!("{word:?} in its type {:?}", tier.kind),
        )
    } else if let Some(role) = TABLE.code(tier.name) {
        (
            Some(role),
            0.4,
            "a code used for this in other corpora".to_owned(),
        )
    } else if let Some((_, word)) = own.hand.as_ref().filter(|_| own.unknown.is_empty()) {
        (
            Some(TierRole::Gloss),
            0.5,
            format!("its name has only a hand, {word:?}"),
        )
    } else {
        (None, 0.0, "no word of its name or type is known".to_owned())
    };
    let manual = role.as_ref().is_none_or(|role| {
        let component = role.component().map(|(component, _)| component);
        !role.is_prose() && component != Some(Component::NonManual)
    });
    TierGuess {
        tier: name,
        role,
        hand: hand.filter(|_| manual),
        confidence,
        why,
    }
}

/// Returns the combined role of the words of a name, and the deciding word.
///
/// A comment on anything is a comment, a translation a translation, and information about signs as words
/// (their part of speech) is free; a placement may be on the head, other movements and orientations of the
/// head are non-manual; a component's gloss is the component.
fn role_of(found: &Match) -> Option<(TierRole, String)> {
    let rank = |role: &TierRole| match role {
        TierRole::Translation => 1,
        TierRole::Component {
            component: Component::Placement,
            feature: None,
        } => 2,
        TierRole::Component {
            component: Component::NonManual,
            feature,
        } => 3 + usize::from(feature.is_none()),
        TierRole::Component {
            feature: Some(_), ..
        } => 5,
        TierRole::Component { .. } => 6,
        TierRole::Gloss => 7,
        // A comment on glosses is a comment, and their parts of speech are not glosses.
        _ => 0,
    };
    let mut roles: Vec<&(TierRole, String)> = found.roles.iter().collect();
    roles.sort_by_key(|(role, word)| (rank(role), std::cmp::Reverse(word.chars().count())));
    roles.first().map(|it| (*it).clone())
}

/// Returns whether texts are equal after [`fold`].
pub(crate) fn same(a: &str, b: &str) -> bool {
    a == b || fold(a) == fold(b)
}
