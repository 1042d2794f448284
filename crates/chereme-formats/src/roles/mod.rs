//! Infers the roles of tiers and columns in people's files, from their names or a mapping file.
//!
//! Names are looked up in `schema/tier_words.json`, a table of the words that projects use in several
//! languages; a [`TierMapping`] overrides these guesses.

mod mapping;
mod roles_words;

pub use chereme_sign::AnnotatedHands;
pub use mapping::{MappingError, MappingTarget, TierMapping};
pub(crate) use roles_words::normalize_tier_name;

use crate::transcript::AnnotationTranscript;
use crate::transcript::{ELEMENT_TIER_TYPE, POINT_TIER_KIND, TranscriptTier};
use chereme_sign::text::fold_text;
use chereme_sign::{HandRef, SignComponent, TierRole, TierStereotype, TierTopic};
use roles_words::{ROLE_WORD_TABLE, RoleWordMatch};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// The properties of a tier that its role is inferred from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TierRoleEvidence<'a> {
    /// The tier's name.
    pub name: &'a str,
    /// The name of its ELAN tier type.
    pub kind: &'a str,
    /// The tier above, as an index into the list.
    pub parent: Option<usize>,
    /// Whether each of its annotations belongs to one of the tier above, with its time (ELAN's
    /// Symbolic_Association).
    pub one_to_one: bool,
    /// Whether its annotations have no values of their own, only those of the tiers below it.
    pub is_track: bool,
    /// The part of the name that states the role, if the rest is the name of the tier above.
    pub subject: Option<&'a str>,
}

/// The inferred role of a tier.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TierGuess {
    /// The tier's name.
    pub tier: String,
    /// The role of its annotations; `None` if unknown.
    pub role: Option<TierRole>,
    /// The hand that they describe.
    pub hand: Option<AnnotatedHands>,
    /// The confidence, from 0 to 1; 1 for tiers of a mapping.
    pub confidence: f64,
    /// The evidence for the role.
    pub why: String,
}

/// The confidence of a role that neither name nor type states.
const HAND_ONLY_CONFIDENCE: f64 = 0.5;

/// The highest confidence of a role that a person should confirm.
const MAX_DOUBTED_CONFIDENCE: f64 = 0.5;

impl TierGuess {
    /// Returns whether no word of the file states the role, so that a person should confirm it.
    #[must_use]
    pub fn is_doubted_guess(&self) -> bool {
        self.role.is_some() && self.confidence <= MAX_DOUBTED_CONFIDENCE
    }

    /// Returns role and hand together, as mappings spell them; nothing if the role is unknown.
    #[must_use]
    pub fn guessed_tier_topic(&self) -> Option<TierTopic> {
        let role = self.role.clone()?;
        let hand = self.hand;
        Some(TierTopic { role, hand })
    }
}

/// Returns the inferred role of each tier of a transcript; see [`guess_roles`].
#[must_use]
pub fn guess_tiers(transcript: &AnnotationTranscript, mapping: &TierMapping) -> Vec<TierGuess> {
    let tracks = anvil_track_tiers(transcript);
    let names = transcript.tiers.iter().enumerate().map(|(at, tier)| TierRoleEvidence {
        name: &tier.name,
        kind: &tier.kind,
        parent: tier.parent,
        one_to_one: tier.stereotype == Some(TierStereotype::SymbolicAssociation),
        is_track: tracks.contains(&at),
        subject: tier_attribute_name(tier, transcript, &tracks),
    });
    guess_roles(&names.collect::<Vec<_>>(), mapping)
}

/// Returns the tiers that hold the elements of ANVIL's tracks, whose attributes have tiers of their own.
fn anvil_track_tiers(transcript: &AnnotationTranscript) -> BTreeSet<usize> {
    let tiers = &transcript.tiers;
    let child = |tier: &TranscriptTier| tier.parent.filter(|above| is_attribute(tier, *above, tiers));
    let above: BTreeSet<usize> = tiers.iter().filter_map(child).collect();
    let is_track = |at: &usize| {
        tiers[*at].kind == ELEMENT_TIER_TYPE
            || tiers[*at]
                .annotations
                .iter()
                .all(|annotation| annotation.value.is_empty())
    };
    above.into_iter().filter(is_track).collect()
}

/// Returns whether a tier is named as that of an attribute below the tier of a track.
fn is_attribute(tier: &TranscriptTier, above: usize, tiers: &[TranscriptTier]) -> bool {
    let Some(above) = tiers.get(above) else {
        return false;
    };
    let name_rest = tier.name.strip_prefix(&above.name);
    let is_track = above.kind == ELEMENT_TIER_TYPE || above.kind == POINT_TIER_KIND;
    is_track && name_rest.and_then(|own| own.strip_prefix('.')) == Some(&*tier.kind)
}

/// Returns the name of the attribute whose values a tier holds.
fn tier_attribute_name<'t>(
    tier: &'t TranscriptTier,
    transcript: &AnnotationTranscript,
    tracks: &BTreeSet<usize>,
) -> Option<&'t str> {
    let above = tier.parent.filter(|above| tracks.contains(above))?;
    is_attribute(tier, above, &transcript.tiers).then_some(&*tier.kind)
}

/// Returns the inferred role of each tier, in the same order.
///
/// The mapping comes first, then the words of the tier's own name, then those of its type. A tier that
/// names only a hand is a gloss tier; one without a hand takes the hand of the tier above. `MD` is the
/// right hand (*main droite*) unless other tiers name the weak one `MND`; the same holds for `D` if there
/// is an `ND`. A gloss tier with a one-to-one relation to another gloss tier above it holds a second
/// reading of the same signs: glosses of that hand if its name states the same hand, such as types beside
/// lexemes, else a translation. One whose name has only a hand may hold anything about the signs, and
/// stays without a role.
#[must_use]
pub fn guess_roles(tiers: &[TierRoleEvidence<'_>], mapping: &TierMapping) -> Vec<TierGuess> {
    let context = TierAbbreviations::new(tiers.iter().map(|tier| tier.name));
    let mut guesses: Vec<TierGuess> = tiers
        .iter()
        .map(|tier| guess_tier_role(tier, mapping, &context))
        .collect();
    share_track_role(tiers, &mut guesses);
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
            let (hand_above, above) = (guesses[above].hand, guesses[above].tier.clone());
            let guess = &mut guesses[at];
            guess.why = format!("{}, but each is one of the glosses above, {above:?}", guess.why);
            if guess.confidence <= HAND_ONLY_CONFIDENCE {
                (guess.role, guess.confidence) = (None, 0.0);
            } else if guess.hand.is_none() || guess.hand != hand_above {
                (guess.role, guess.hand) = (Some(TierRole::Translation), None);
                guess.confidence = MAX_DOUBTED_CONFIDENCE;
                second_readings.insert(at);
            }
        }
    }
    for (at, tier) in tiers.iter().enumerate() {
        let manual = matches!(&guesses[at].role, Some(TierRole::Component { component, .. }) if component.is_manual());
        let above = tier
            .parent
            .and_then(|parent| guesses.get(parent))
            .and_then(|parent| parent.hand.map(|hand| (hand, parent.tier.clone())));
        if let (true, None, Some((hand, name))) = (manual, guesses[at].hand, above) {
            let guess = &mut guesses[at];
            guess.hand = Some(hand);
            // A hand from the tier above is a little less sure than one in the name.
            guess.confidence -= 0.1;
            guess.why = format!("{}; {hand} as the tier above, {name:?}", guess.why);
        }
    }
    guesses
}

/// Gives the role of a track to its first attribute, unless an attribute names that role itself; a track has no values.
/// Further attributes that name glosses of the same hand are second readings.
fn share_track_role(tiers: &[TierRoleEvidence<'_>], guesses: &mut [TierGuess]) {
    let mut attributes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (at, tier) in tiers.iter().enumerate() {
        if let Some(above) = tier.parent.filter(|_| tier.subject.is_some()) {
            attributes.entry(above).or_default().push(at);
        }
    }
    for (track, attributes) in attributes {
        let mut hands = Vec::new();
        for &at in &attributes {
            let guess = &mut guesses[at];
            if guess.role == Some(TierRole::Gloss) && guess.confidence < 1.0 {
                if hands.contains(&guess.hand) {
                    guess.why = format!("{}, but another attribute has the glosses", guess.why);
                    (guess.role, guess.hand) = (Some(TierRole::Translation), None);
                } else {
                    hands.push(guess.hand);
                }
            }
        }
        // A role that a person stated is kept.
        if !tiers[track].is_track || guesses[track].confidence >= 1.0 {
            continue;
        }
        let role = guesses[track].role.take();
        if role.is_none() || attributes.iter().any(|at| guesses[*at].role == role) {
            continue;
        }
        let unknown = attributes.into_iter().find(|at| guesses[*at].role.is_none());
        if let Some(first) = unknown.filter(|at| guesses[*at].confidence < 1.0) {
            let why = format!("{}; it is that of its track", guesses[track].why);
            let hand = guesses[track].hand;
            let guess = &mut guesses[first];
            (guess.role, guess.confidence, guess.why) = (role, 0.5, why);
            guess.hand = guess.hand.or(hand);
        }
    }
}

/// The abbreviations in the tiers of one file.
struct TierAbbreviations {
    /// The dominant hand is `MD` or `D`, because the weak one is `MND` or `ND`.
    dominance: bool,
}

impl TierAbbreviations {
    fn new<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let pieces: BTreeSet<String> = names.flat_map(roles_words::split_tier_name).collect();
        Self {
            dominance: pieces.contains("mnd") || pieces.contains("nd"),
        }
    }

    fn abbreviated_hand(&self, word: &str) -> Option<AnnotatedHands> {
        if matches!(word, "md" | "d") {
            let right = if self.dominance {
                HandRef::Dominant
            } else {
                HandRef::Right
            };
            return Some(AnnotatedHands::One(right));
        }
        ROLE_WORD_TABLE.hand_word_meaning(word)
    }
}

/// Returns the hand that each title of a table states, if it states one.
pub(crate) fn stated_hands(titles: &[String]) -> Vec<Option<AnnotatedHands>> {
    let context = TierAbbreviations::new(titles.iter().map(String::as_str));
    let hand = |title: &String| {
        ROLE_WORD_TABLE
            .match_name_words(title, |word| context.abbreviated_hand(word))
            .hand
    };
    let all = titles.iter().map(hand);
    all.map(|found| found.map(|(hand, _)| hand)).collect()
}

/// Returns whether words, written as one, mean a hand and nothing else: `weakhand`.
pub(crate) fn is_hand(words: &str) -> bool {
    ROLE_WORD_TABLE.hand_word_meaning(words).is_some()
}

fn guess_tier_role(tier: &TierRoleEvidence<'_>, mapping: &TierMapping, context: &TierAbbreviations) -> TierGuess {
    let name = tier.name.to_owned();
    if let Some((entry, target)) = mapping.tier_mapping_entry(tier.name) {
        let why = format!("the mapping says so ({entry:?})");
        return TierGuess {
            tier: name,
            role: target.role.clone(),
            hand: target.hand,
            confidence: 1.0,
            why,
        };
    }
    let mut name_match = ROLE_WORD_TABLE.match_name_words(tier.name, |word| context.abbreviated_hand(word));
    if let Some(subject) = tier.subject {
        // The hand may be that of the track; the role is that of the attribute, unless that names only a hand.
        let attribute = ROLE_WORD_TABLE.match_name_words(subject, |word| context.abbreviated_hand(word));
        let has_other_words = !attribute.roles.is_empty() || !attribute.unknown.is_empty();
        if has_other_words || attribute.hand.is_none() {
            name_match.roles = attribute.roles;
            name_match.unknown = vec![subject.to_owned()];
        }
    }
    // A single letter such as "d" or "g" in the name of a type does not mean a hand.
    let spelt = |word: &str| context.abbreviated_hand(word).filter(|_| word.chars().count() > 2);
    let kind = ROLE_WORD_TABLE.match_name_words(tier.kind, spelt);
    let hand = name_match.hand.as_ref().or(kind.hand.as_ref()).map(|(hand, _)| *hand);
    let (role, confidence, why) = if let Some((role, word)) = role_of(&name_match) {
        (
            Some(role),
            if word.chars().count() > 3 { 0.9 } else { 0.75 },
            format!("{word:?} in its name"),
        )
    } else if let Some((role, word)) = role_of(&kind) {
        (Some(role), 0.6, format!("{word:?} in its type {:?}", tier.kind))
    } else if let Some(role) = ROLE_WORD_TABLE.tier_code_role(tier.subject.unwrap_or(tier.name)) {
        (Some(role), 0.4, "a code used for this in other corpora".to_owned())
    } else if let Some((_, word)) = name_match.hand.as_ref().filter(|_| name_match.unknown.is_empty()) {
        (
            Some(TierRole::Gloss),
            HAND_ONLY_CONFIDENCE,
            format!("its name has only a hand, {word:?}"),
        )
    } else {
        (None, 0.0, "no word of its name or type is known".to_owned())
    };
    let manual = role.as_ref().is_none_or(|role| {
        let component = role.role_component().map(|(component, _)| component);
        !role.is_prose() && component != Some(SignComponent::NonManual)
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
fn role_of(found: &RoleWordMatch) -> Option<(TierRole, String)> {
    let rank = |role: &TierRole| match role {
        TierRole::Translation => 1,
        TierRole::Component {
            component: SignComponent::Placement,
            feature: None,
        } => 2,
        TierRole::Component {
            component: SignComponent::NonManual,
            feature,
        } => 3 + usize::from(feature.is_none()),
        TierRole::Component { feature: Some(_), .. } => 5,
        TierRole::Component { .. } => 6,
        TierRole::Gloss => 7,
        // A comment on glosses is a comment, and their parts of speech are not glosses.
        _ => 0,
    };
    // Beside a part of the body, "pos" abbreviates its position, not a part of speech.
    let of_body = |(role, _): &(TierRole, String)| match role {
        TierRole::Component { component, feature } => {
            *component == SignComponent::NonManual && feature.as_deref() != Some("mouthing")
        }
        _ => false,
    };
    let is_position = |word: &str| word == "pos" && found.roles.iter().any(of_body);
    let mut roles: Vec<&(TierRole, String)> = found.roles.iter().filter(|(_, word)| !is_position(word)).collect();
    roles.sort_by_key(|(role, word)| (rank(role), std::cmp::Reverse(word.chars().count())));
    roles.first().map(|role| (*role).clone())
}

/// Returns whether texts are equal after [`fold`].
pub(crate) fn is_same_folded(a: &str, b: &str) -> bool {
    a == b || fold_text(a) == fold_text(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the tiers' roles; those with a number are one to one below the tier of that place.
    fn roles_of(tiers: &[(&str, Option<usize>)]) -> Vec<String> {
        let mut evidence = Vec::new();
        for &(name, parent) in tiers {
            evidence.push(TierRoleEvidence {
                name,
                parent,
                one_to_one: parent.is_some(),
                ..TierRoleEvidence::default()
            });
        }
        let guesses = guess_roles(&evidence, &TierMapping::default());
        let shown = |guess: &TierGuess| {
            let topic = guess.guessed_tier_topic();
            topic.map_or_else(|| "unknown".to_owned(), |topic| topic.to_string())
        };
        guesses.iter().map(shown).collect()
    }

    #[test]
    fn tiers_of_american_and_german_corpora_have_the_roles_of_their_values() {
        let head = ["head pos", "head pos: turn", "head pos: tilt", "head pos: jut"];
        for name in head {
            assert_eq!(roles_of(&[(name, None)]), ["nonmanual.head"], "{name}");
        }
        for name in ["POS", "Gloss RH part of speech", "POS of gloss", "mouthing POS"] {
            assert!(roles_of(&[(name, None)])[0].ends_with("free"), "{name}");
        }
        let german = [
            ("Lexem_Gebärde_r_A", None),
            ("Gebärde_r_A", Some(0)),
            ("Lexeme_Sign_r_A", Some(0)),
            ("Sign_r_A", Some(2)),
            ("Gloss", None),
            ("Gloss English", Some(4)),
        ];
        let gloss = "right.gloss";
        assert_eq!(roles_of(&german), [gloss, gloss, gloss, gloss, "gloss", "translation"]);
        let by_hand = [
            ("Gloss", None),
            ("MG-dom", Some(0)),
            ("MG-nondom", Some(0)),
            ("left", None),
        ];
        assert_eq!(roles_of(&by_hand), ["gloss", "unknown", "unknown", "left.gloss"]);
    }
}
