//! Index terms for the coded properties of a token.
//!
//! A reading is `component|hand and phase|part|value`, such as `placement|ri||chin`. The hand is
//! `r`, `l` (by side), `d`, `w` (by part in signing) or `n` (none); the phase `o` (the only value),
//! `i`, `m1`, `m2` … or `f`. The component of an opinion follows a tilde: `~placement|ri||chin`. A mark is `@kind|value`, such as `@origin|made`.

use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{ComponentReading, HandRef, SignPhase};

use crate::db::stored_columns::ValueState;

/// Values in a term for readings without a value.
mod special {
    pub(super) const NOT_APPLICABLE: &str = "\u{1}n/a";
    pub(super) const UNCLEAR_TERM_TEXT: &str = "\u{1}unclear";
    pub(super) const UNSET_TERM_TEXT: &str = "\u{1}unset";
}

/// A property of a token that is not a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum TokenProperty {
    Origin,
    Hand,
    Tier,
    Inventory,
    Lexicon,
    Language,
    File,
    /// The kinds of text that it has: `translation`, `comment`.
    Has,
    /// `yes` if a detector proposes something that nobody has accepted.
    Proposed,
    /// `yes` if annotators say different things of it.
    Disputed,
}

impl TokenProperty {
    fn token_property_name(self) -> &'static str {
        match self {
            Self::Origin => "@origin",
            Self::Hand => "@hand",
            Self::Tier => "@tier",
            Self::Inventory => "@inventory",
            Self::Lexicon => "@lexicon",
            Self::Language => "@language",
            Self::File => "@file",
            Self::Has => "@has",
            Self::Proposed => "@proposed",
            Self::Disputed => "@disputed",
        }
    }

    /// Returns the term for a value of this mark.
    pub(crate) fn property_value_term(self, value: &str) -> String {
        format!("{}|{value}", self.token_property_name())
    }

    /// Returns the prefix of all terms of this mark.
    pub(crate) fn property_term_prefix(self) -> String {
        self.property_value_term("")
    }
}

/// Returns the prefix of the terms of all readings of a component.
pub(crate) fn component_prefix(component: &str) -> String {
    format!("{component}|")
}

/// Returns the name of a component in the terms of opinions, which do not count unless a query asks for them.
pub(crate) fn opinion_component(component: &str) -> String {
    format!("~{component}")
}

/// Returns the term of a reading.
pub(crate) fn reading_term(component: &str, hand: char, phase: &str, part: Option<&str>, value: &str) -> String {
    // A separator in the name of a part would shift the pieces behind it.
    let part = part.unwrap_or_default().replace('|', "/");
    format!("{component}|{hand}{phase}|{part}|{value}")
}

/// Returns the text in a term for the reading of a row's state and value.
pub(crate) fn reading_text(state: ValueState, value: Option<&str>) -> &str {
    match state {
        ValueState::Value => value.unwrap_or(special::UNSET_TERM_TEXT),
        ValueState::NotApplicable => special::NOT_APPLICABLE,
        ValueState::Unclear => special::UNCLEAR_TERM_TEXT,
        ValueState::Unset => special::UNSET_TERM_TEXT,
    }
}

/// Returns the reading for a row's state and value.
pub(crate) fn reading_from_state(state: ValueState, value: Option<&str>) -> ComponentReading {
    from_text(reading_text(state, value))
}

/// Returns the text in a term for a reading.
pub(crate) fn reading_term_text(reading: &ComponentReading) -> &str {
    match reading {
        ComponentReading::Value(value) => value,
        ComponentReading::NotApplicable => special::NOT_APPLICABLE,
        ComponentReading::Unclear => special::UNCLEAR_TERM_TEXT,
        ComponentReading::Unset => special::UNSET_TERM_TEXT,
    }
}

fn from_text(text: &str) -> ComponentReading {
    match text {
        special::NOT_APPLICABLE => ComponentReading::NotApplicable,
        special::UNCLEAR_TERM_TEXT => ComponentReading::Unclear,
        special::UNSET_TERM_TEXT => ComponentReading::Unset,
        value => ComponentReading::Value(value.to_owned()),
    }
}

/// The parts of a reading's term.
pub(crate) struct ParsedReadingTerm<'a> {
    pub(crate) hand: char,
    pub(crate) phase: &'a str,
    pub(crate) part: Option<&'a str>,
    pub(crate) reading: ComponentReading,
}

/// Parses the term of a reading.
pub(crate) fn parse_reading_term(term: &str) -> Option<ParsedReadingTerm<'_>> {
    // The value comes last and may hold the separator itself, so that only three are split off.
    let mut pieces = term.splitn(4, '|').skip(1);
    let (place, part, value) = (pieces.next()?, pieces.next()?, pieces.next()?);
    let hand = place.chars().next()?;
    Some(ParsedReadingTerm {
        hand,
        phase: &place[hand.len_utf8()..],
        part: (!part.is_empty()).then_some(part),
        reading: from_text(value),
    })
}

/// Returns the code of a row's phase.
pub(crate) fn phase_code(phase: Option<SignPhase>) -> String {
    match phase {
        Some(SignPhase::Initial) => "i".to_owned(),
        Some(SignPhase::Middle(place)) => format!("m{place}"),
        Some(SignPhase::Final) => "f".to_owned(),
        None => "o".to_owned(),
    }
}

/// Returns the codes of a hand, by side and by part in signing: all four for both hands, and `n` for no hand.
pub(crate) fn hand_codes(hand: Option<AnnotatedHands>, left_handed: bool) -> &'static [char] {
    let hand = match hand {
        Some(AnnotatedHands::One(hand)) => hand,
        Some(AnnotatedHands::Both) => return &['r', 'l', 'd', 'w'],
        None => return &['n'],
    };
    match (hand, left_handed) {
        (HandRef::Right | HandRef::Dominant, false) => &['r', 'd'],
        (HandRef::Left | HandRef::Weak, false) => &['l', 'w'],
        (HandRef::Right | HandRef::Weak, true) => &['r', 'w'],
        (HandRef::Left | HandRef::Dominant, true) => &['l', 'd'],
    }
}

/// Returns the codes of the hands that a field stands for.
///
/// Either hand stands for both parts in signing, and for readings without a hand.
pub(crate) fn hands_of(hand: Option<HandRef>) -> &'static [char] {
    match hand {
        Some(HandRef::Right) => &['r'],
        Some(HandRef::Left) => &['l'],
        Some(HandRef::Dominant) => &['d'],
        Some(HandRef::Weak) => &['w'],
        None => &['d', 'w', 'n'],
    }
}

/// Returns whether a value with this phase code matches a query for `phase`: the only value of a sign is both its first
/// and its last.
pub(crate) fn phase_counts(phase: Option<SignPhase>, code: &str) -> bool {
    match phase {
        None => true,
        Some(SignPhase::Initial) => matches!(code, "i" | "o"),
        Some(SignPhase::Final) => matches!(code, "f" | "o"),
        Some(SignPhase::Middle(count)) => code.strip_prefix('m').and_then(|n| n.parse().ok()) == Some(count),
    }
}
