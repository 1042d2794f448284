//! The subject of a tier's annotations, and their hand: one reader and one writer for every file, command and row.

use crate::component::{ComponentField, HandRef, SignComponent, SignPhase};
use crate::text::{did_you_mean, fold_text, nearest_candidate};
use crate::words::InterfaceText;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The subject of a tier's annotations.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TierRole {
    /// The sign; each annotation is a token.
    Gloss,
    /// One component of the sign, or one feature of it.
    Component {
        /// The component.
        component: SignComponent,
        /// The feature, such as `brows` or `palm`; `None` for the whole.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        feature: Option<String>,
    },
    /// The meaning, in a spoken language.
    Translation,
    /// Remarks of the annotators.
    Comment,
    /// Anything else.
    #[default]
    Free,
}

impl TierRole {
    /// The roles without a component, in the order in which lists offer them.
    pub const PLAIN_TIER_ROLES: [Self; 4] = [Self::Gloss, Self::Translation, Self::Comment, Self::Free];

    /// Returns the rank by which the tiers of a recording are ordered: signs, what they mean, their components, remarks,
    /// the rest.
    #[must_use]
    pub const fn role_rank(&self) -> usize {
        match self {
            Self::Gloss => 0,
            Self::Translation => 1,
            Self::Component { .. } => 2,
            Self::Comment => 3,
            Self::Free => 4,
        }
    }

    /// Returns whether its annotations are sentences for people: translations and remarks, which no hand makes.
    #[must_use]
    pub const fn is_prose(&self) -> bool {
        matches!(self, Self::Translation | Self::Comment)
    }

    /// Returns the words for its kind, in files and commands and for people.
    #[must_use]
    pub const fn role_words(&self) -> RoleWords {
        match self {
            Self::Gloss => RoleWords {
                names: &["gloss"],
                name: InterfaceText::from_id("tier-role-gloss"),
                counted: ["de gloses", "de gloses"],
                note: "signs; each value is a token",
            },
            Self::Component { .. } => RoleWords {
                names: &["component"],
                name: InterfaceText::from_id("tier-role-component"),
                counted: ["de composants", "de composants"],
                note: "values of a component of signs, or of a feature of it",
            },
            Self::Translation => RoleWords {
                names: &["translation"],
                name: InterfaceText::from_id("tier-role-translation"),
                counted: ["de traduction", "de traduction"],
                note: "the meaning in a spoken language",
            },
            Self::Comment => RoleWords {
                names: &["comment", "note"],
                name: InterfaceText::from_id("tier-role-comment"),
                counted: ["de remarques", "de remarques"],
                note: "remarks of the annotators",
            },
            Self::Free => RoleWords {
                names: &["free", "ignore"],
                name: InterfaceText::from_id("tier-role-free"),
                counted: ["libre", "libres"],
                note: "anything else",
            },
        }
    }

    /// Returns the words for every kind of role: those without a component, and the one of components.
    pub fn all_words() -> impl Iterator<Item = RoleWords> {
        let coded = Self::Component {
            component: SignComponent::Configuration,
            feature: None,
        };
        Self::PLAIN_TIER_ROLES
            .iter()
            .map(Self::role_words)
            .chain([coded.role_words()])
    }

    /// Lists the kinds of roles without a component: `gloss, translation, comment, free`.
    #[must_use]
    pub fn plain_kinds() -> String {
        Self::PLAIN_TIER_ROLES.each_ref().map(Self::role_kind_name).join(", ")
    }

    /// Returns the kind of role without its component, such as `gloss` or `component`.
    #[must_use]
    pub fn role_kind_name(&self) -> &'static str {
        self.role_words().usual_kind_name()
    }

    /// Returns whether its annotations code signs: glosses and components, whose values may be missing in three ways.
    #[must_use]
    pub fn is_coded(&self) -> bool {
        matches!(self, Self::Gloss | Self::Component { .. })
    }

    /// Returns the component that is coded, and the feature of it.
    #[must_use]
    pub fn role_component(&self) -> Option<(SignComponent, Option<&str>)> {
        match self {
            Self::Component { component, feature } => Some((*component, feature.as_deref())),
            _ => None,
        }
    }

    /// Returns the role of a [`kind`](Self::role_kind_name) with the component and feature that belong to it; a kind that is
    /// not known, or a component that is missing, gives [`Free`](Self::Free).
    #[must_use]
    pub fn of_parts(kind: &str, component: Option<&str>, feature: Option<&str>) -> Self {
        let component = component.and_then(|name| name.parse().ok());
        match (kind, component) {
            ("component", Some(component)) => Self::Component {
                component,
                feature: feature.map(str::to_owned),
            },
            _ => role_from_word(kind).unwrap_or_default(),
        }
    }

    /// Returns the role as text: its kind, or the component as a query spells it, such as `configuration` or
    /// `nonmanual.brows`.
    #[must_use]
    pub fn role_name(&self) -> String {
        match self.role_component() {
            Some((component, feature)) => {
                let field = ComponentField::new(component);
                feature
                    .into_iter()
                    .fold(field, |field, feature| field.with_field_feature(feature))
                    .to_string()
            }
            None => self.role_kind_name().to_owned(),
        }
    }
}

/// The words for a kind of role.
#[derive(Debug, Clone, Copy)]
pub struct RoleWords {
    /// The names in files, commands and the database; the first is the usual one.
    pub names: &'static [&'static str],
    /// The name for people.
    pub name: InterfaceText,
    /// The French words after a number of such tiers: one, and several.
    pub counted: [&'static str; 2],
    /// The content of such tiers, for readers of the database.
    pub note: &'static str,
}

impl RoleWords {
    /// Returns the usual name in files, commands and the database.
    #[must_use]
    pub fn usual_kind_name(&self) -> &'static str {
        self.names.first().copied().unwrap_or_default()
    }
}

/// Returns the role that one word names, besides components.
fn role_from_word(text: &str) -> Option<TierRole> {
    let named = |role: &&TierRole| role.role_words().names.contains(&text);
    TierRole::PLAIN_TIER_ROLES.iter().find(named).cloned()
}

impl FromStr for TierRole {
    type Err = RoleError;

    /// Reads the text that [`name`](Self::role_name) returns. Refuses a hand, which belongs to a [`TierTopic`] instead.
    fn from_str(text: &str) -> Result<Self, RoleError> {
        let topic: TierTopic = text.parse()?;
        match topic.hand {
            None => Ok(topic.role),
            Some(hand) => Err(RoleError::Hand {
                text: text.to_owned(),
                hand,
            }),
        }
    }
}

/// The hand or hands that something is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(into = "&'static str")]
pub enum AnnotatedHands {
    /// One hand.
    One(HandRef),
    /// Both hands at once.
    Both,
}

impl AnnotatedHands {
    /// Every choice: each hand alone, and both.
    pub const ALL_ANNOTATED_HANDS: [Self; 5] = [
        Self::One(HandRef::Right),
        Self::One(HandRef::Left),
        Self::One(HandRef::Dominant),
        Self::One(HandRef::Weak),
        Self::Both,
    ];

    /// Returns `right`, `left`, `dominant`, `weak` or `both`.
    #[must_use]
    pub fn annotated_hands_name(self) -> &'static str {
        match self {
            Self::One(hand) => hand.hand_ref_name(),
            Self::Both => "both",
        }
    }

    /// Returns the hands of that name.
    #[must_use]
    pub fn from_hand_name(name: &str) -> Option<Self> {
        match name {
            "both" => Some(Self::Both),
            one => one.parse().ok().map(Self::One),
        }
    }

    /// Returns the hand, if it is a single one.
    #[must_use]
    pub fn single_hand(self) -> Option<HandRef> {
        match self {
            Self::One(hand) => Some(hand),
            Self::Both => None,
        }
    }
}

impl From<AnnotatedHands> for &'static str {
    fn from(hands: AnnotatedHands) -> Self {
        hands.annotated_hands_name()
    }
}

impl fmt::Display for AnnotatedHands {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.annotated_hands_name())
    }
}

/// The subject of a tier's annotations, and their hand: `right.configuration`, `both.gloss`, `nonmanual.brows`,
/// `translation`.
///
/// The printed form reads back as the same topic.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TierTopic {
    /// The subject of the annotations.
    pub role: TierRole,
    /// The hand that they describe, if they describe one.
    pub hand: Option<AnnotatedHands>,
}

impl TierTopic {
    /// Reads a topic that may include a phase, as the title of a column may: `final.dominant.configuration`.
    ///
    /// # Errors
    /// [`RoleError`] if the text is not a role.
    pub fn with_phase(text: &str) -> Result<(Self, Option<SignPhase>), RoleError> {
        let lower = text.trim().to_lowercase();
        let (first, rest) = lower.split_once('.').unwrap_or((&lower, ""));
        // A hand alone is no topic.
        let hand = AnnotatedHands::from_hand_name(first).filter(|_| !rest.is_empty());
        let named = role_from_word(&lower).map(|role| (None, role));
        let handed = || Some((Some(hand?), role_from_word(rest)?));
        if let Some((hand, role)) = named.or_else(handed) {
            return Ok((Self { role, hand }, None));
        }
        let (both, field) = match hand {
            Some(AnnotatedHands::Both) => (hand, rest),
            _ => (None, &*lower),
        };
        let field: ComponentField = field.parse().map_err(|_| unknown_role_error(text))?;
        // Both hands leave no room for one of them, and a face has no hands.
        if both.is_some() && (field.hand.is_some() || !field.component.is_manual()) {
            return Err(unknown_role_error(text));
        }
        let topic = Self {
            role: TierRole::Component {
                component: field.component,
                feature: field.feature,
            },
            hand: both.or(field.hand.map(AnnotatedHands::One)),
        };
        Ok((topic, field.phase))
    }
}

impl FromStr for TierTopic {
    type Err = RoleError;

    fn from_str(text: &str) -> Result<Self, RoleError> {
        match Self::with_phase(text)? {
            (topic, None) => Ok(topic),
            (_, Some(phase)) => Err(RoleError::Phase {
                text: text.to_owned(),
                phase,
            }),
        }
    }
}

impl fmt::Display for TierTopic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(hand) = self.hand {
            write!(f, "{hand}.")?;
        }
        f.write_str(&self.role.role_name())
    }
}

/// A text that is not a role of a tier or column.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RoleError {
    /// No word of it is known, or the words do not go together.
    #[error("{text:?} is no role; write {}, or a component such as right.configuration or nonmanual.brows{}", TierRole::plain_kinds(), did_you_mean(nearest.as_deref()))]
    Unknown {
        /// The text.
        text: String,
        /// The word that was probably meant.
        nearest: Option<String>,
    },
    /// It names a hand, but a role alone has none.
    #[error("{text:?} names the {hand} hand; a role alone has none")]
    Hand {
        /// The text.
        text: String,
        /// The hand.
        hand: AnnotatedHands,
    },
    /// It names a phase, but a tier has none.
    #[error("{text:?} names a phase, {phase}; a tier holds successive values one after another")]
    Phase {
        /// The text.
        text: String,
        /// The phase.
        phase: SignPhase,
    },
}

fn unknown_role_error(text: &str) -> RoleError {
    let component_names = SignComponent::ALL_COMPONENTS
        .iter()
        .flat_map(|component| component.component_spellings())
        .copied();
    let hands = HandRef::ALL_HAND_REFS
        .iter()
        .flat_map(|hand| hand.hand_ref_spellings())
        .copied();
    let roles = TierRole::PLAIN_TIER_ROLES
        .iter()
        .flat_map(|role| role.role_words().names);
    let others = roles.copied().chain(["both"]);
    let words: Vec<&str> = component_names.chain(hands).chain(others).collect();
    let folded = fold_text(text);
    // The first word that no role has is most probably the misspelt one.
    let wrong = folded
        .split(|c: char| !c.is_alphanumeric())
        .find(|word| !word.is_empty() && !words.contains(word))
        .unwrap_or_default();
    RoleError::Unknown {
        text: text.to_owned(),
        nearest: nearest_candidate(wrong, words.iter().copied()).map(str::to_owned),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::InterfaceLanguage;

    #[test]
    fn a_topic_keeps_its_hand_and_reads_back_as_it_is_printed() {
        for (text, printed, hand) in [
            ("gloss", "gloss", None),
            ("left.gloss", "left.gloss", Some("left")),
            ("both.gloss", "both.gloss", Some("both")),
            ("right.handshape", "right.configuration", Some("right")),
            (" RH.Location ", "right.placement", Some("right")),
            ("both.movement", "both.movement", Some("both")),
            ("weak.orientation.palm", "weak.orientation.palm", Some("weak")),
            ("nonmanual.brows", "nonmanual.brows", None),
            ("note", "comment", None),
            ("right.translation", "right.translation", Some("right")),
        ] {
            let topic: TierTopic = text.parse().expect(text);
            assert_eq!(topic.to_string(), printed, "{text}");
            assert_eq!(topic.hand.map(AnnotatedHands::annotated_hands_name), hand, "{text}");
            assert_eq!(printed.parse(), Ok(topic.clone()), "{text}");
            let role = &topic.role;
            let parts = role.role_component();
            let again = TierRole::of_parts(
                role.role_kind_name(),
                parts.map(|(component, _)| component.component_name()),
                parts.and_then(|(_, feature)| feature),
            );
            assert_eq!(again, topic.role, "{text}");
            assert_eq!(role.role_name().parse(), Ok(topic.role), "{text}");
        }
        let (topic, phase) = TierTopic::with_phase("final.weak.configuration").expect("a column");
        assert_eq!(
            (topic.to_string().as_str(), phase),
            ("weak.configuration", Some(SignPhase::Final))
        );
    }

    #[test]
    fn each_kind_of_role_has_names_of_its_own_and_words_in_both_languages() {
        let all: Vec<RoleWords> = TierRole::all_words().collect();
        let mut names: Vec<&str> = all.iter().flat_map(|it| it.names).copied().collect();
        let many = names.len();
        names.sort_unstable();
        names.dedup();
        assert!(names.len() == many && all.len() > TierRole::PLAIN_TIER_ROLES.len());
        for words in all {
            let name = words.name.text_in_language(InterfaceLanguage::French);
            assert!(!name.starts_with("tier-role"), "{name}");
            let texts = [words.counted[0], words.counted[1], words.note];
            assert!(texts.iter().all(|it| !it.trim().is_empty()), "{words:?}");
        }
    }

    #[test]
    fn an_unknown_role_is_refused_with_the_known_ones() {
        for (text, message) in [
            ("right.configurtion", "did you mean \"configuration\"?"),
            ("rigth.gloss", "is no role; write gloss, translation"),
            ("right.nonmanual.brows", "is no role"),
            ("both.right.placement", "is no role"),
            ("", "is no role"),
            ("right", "is no role"),
            ("initial.placement", "names a phase, initial"),
        ] {
            let error = text.parse::<TierTopic>().expect_err(text).to_string();
            assert!(error.contains(message), "{text}: {error}");
        }
        let error = "right.placement".parse::<TierRole>().expect_err("a hand");
        assert!(error.to_string().contains("names the right hand"));
    }
}
