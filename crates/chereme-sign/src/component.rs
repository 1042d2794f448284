//! The components of a sign, whose hand they belong to, and how a search names one of them.

use chereme_motion::BodySide;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// One of the five kinds of property that distinguish signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SignComponent {
    /// The shape of the hand.
    Configuration,
    /// Where the hand is, on the body or in space.
    Placement,
    /// How the hand moves.
    Movement,
    /// Where the palm and the fingers point.
    Orientation,
    /// The activity of face, head, shoulders and body.
    NonManual,
}

impl SignComponent {
    /// The five components in the order in which they are printed.
    pub const ALL_COMPONENTS: [Self; 5] = [
        Self::Configuration,
        Self::Placement,
        Self::Movement,
        Self::Orientation,
        Self::NonManual,
    ];

    /// Returns the canonical name, as queries spell it.
    #[must_use]
    pub fn component_name(self) -> &'static str {
        self.component_spellings()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn component_spellings(self) -> &'static [&'static str] {
        match self {
            Self::Configuration => &["configuration", "handshape", "shape", "config"],
            Self::Placement => &["placement", "location", "place"],
            Self::Movement => &["movement", "motion"],
            Self::Orientation => &["orientation"],
            Self::NonManual => &["nonmanual", "non-manual", "non_manual", "nmm"],
        }
    }

    /// Returns whether the component belongs to a hand; only the non-manual one does not.
    #[must_use]
    pub fn is_manual(self) -> bool {
        self != Self::NonManual
    }

    fn parse_component_name(text: &str) -> Option<Self> {
        Self::ALL_COMPONENTS
            .into_iter()
            .find(|component| component.component_spellings().contains(&text))
    }
}

impl fmt::Display for SignComponent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.component_name())
    }
}

impl FromStr for SignComponent {
    type Err = FieldError;
    fn from_str(text: &str) -> Result<Self, FieldError> {
        Self::parse_component_name(&text.trim().to_lowercase())
            .ok_or_else(|| FieldError::NoComponent { text: text.to_owned() })
    }
}

/// The hand with which a signer makes one-handed signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SignerHandedness {
    /// Right-handed.
    #[default]
    Right,
    /// Left-handed.
    Left,
}

impl SignerHandedness {
    /// Returns the side of the dominant hand.
    #[must_use]
    pub fn signer_dominant_side(self) -> BodySide {
        match self {
            Self::Right => BodySide::Right,
            Self::Left => BodySide::Left,
        }
    }
}

/// A hand, named by its side or by its part in signing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandRef {
    /// The signer's right hand.
    Right,
    /// The signer's left hand.
    Left,
    /// The hand that signs one-handed signs.
    Dominant,
    /// The other hand.
    Weak,
}

impl HandRef {
    /// The four ways of naming a hand.
    pub const ALL_HAND_REFS: [Self; 4] = [Self::Right, Self::Left, Self::Dominant, Self::Weak];

    /// Returns the canonical name.
    #[must_use]
    pub fn hand_ref_name(self) -> &'static str {
        self.hand_ref_spellings()[0]
    }

    /// Returns every spelling that is understood, the canonical name first.
    #[must_use]
    pub fn hand_ref_spellings(self) -> &'static [&'static str] {
        match self {
            Self::Right => &["right", "rh"],
            Self::Left => &["left", "lh"],
            Self::Dominant => &["dominant", "strong"],
            Self::Weak => &["weak", "nondominant", "non-dominant"],
        }
    }

    /// Returns the side of the body of this hand, for a signer of this handedness.
    #[must_use]
    pub fn resolve_hand_ref(self, handedness: SignerHandedness) -> BodySide {
        match self {
            Self::Right => BodySide::Right,
            Self::Left => BodySide::Left,
            Self::Dominant => handedness.signer_dominant_side(),
            Self::Weak => handedness.signer_dominant_side().opposite_side(),
        }
    }

    fn parse_hand_ref(text: &str) -> Option<Self> {
        Self::ALL_HAND_REFS
            .into_iter()
            .find(|hand| hand.hand_ref_spellings().contains(&text))
    }
}

impl From<BodySide> for HandRef {
    fn from(side: BodySide) -> Self {
        match side {
            BodySide::Right => Self::Right,
            BodySide::Left => Self::Left,
        }
    }
}

impl fmt::Display for HandRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.hand_ref_name())
    }
}

impl FromStr for HandRef {
    type Err = FieldError;
    fn from_str(text: &str) -> Result<Self, FieldError> {
        Self::parse_hand_ref(&text.trim().to_lowercase())
            .ok_or_else(|| FieldError::UnknownHand { text: text.to_owned() })
    }
}

/// A position among several successive values of one sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SignPhase {
    /// The first of several values.
    Initial,
    /// A value between the first and the last, counted from 1; `middle` alone is the first of them.
    Middle(u8),
    /// The last of several values.
    Final,
}

impl SignPhase {
    fn parse_sign_phase(text: &str) -> Option<Self> {
        match text {
            "initial" | "start" => Some(Self::Initial),
            "final" | "end" => Some(Self::Final),
            "middle" => Some(Self::Middle(1)),
            _ => {
                let count = text.strip_prefix("middle")?;
                let canonical = !count.starts_with(['0', '+']);
                count.parse().ok().filter(|_| canonical).map(Self::Middle)
            }
        }
    }
}

impl fmt::Display for SignPhase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Initial => f.write_str("initial"),
            Self::Middle(1) => f.write_str("middle"),
            Self::Middle(count) => write!(f, "middle{count}"),
            Self::Final => f.write_str("final"),
        }
    }
}

impl FromStr for SignPhase {
    type Err = FieldError;
    fn from_str(text: &str) -> Result<Self, FieldError> {
        Self::parse_sign_phase(&text.trim().to_lowercase())
            .ok_or_else(|| FieldError::UnknownPhase { text: text.to_owned() })
    }
}

/// A component of a token as a search names it: `final.right.placement`, `nonmanual.brows`.
///
/// Parsing takes phase and hand in either order before the component, and any of the names and aliases; printing always
/// gives `phase.hand.component.feature` with the canonical names. Without a hand either hand is meant; without a phase,
/// any value of the sign.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct ComponentField {
    /// The hand; `None` for either.
    pub hand: Option<HandRef>,
    /// The component.
    pub component: SignComponent,
    /// The part of the component in lower case, such as `brows` or `palm`; `None` for the whole.
    pub feature: Option<String>,
    /// The position among several successive values; `None` for any.
    pub phase: Option<SignPhase>,
}

impl ComponentField {
    /// Returns the field of `component` on either hand, whole, in any phase.
    #[must_use]
    pub fn new(component: SignComponent) -> Self {
        Self {
            hand: None,
            component,
            feature: None,
            phase: None,
        }
    }

    /// Returns this field on `hand`.
    #[must_use]
    pub fn with_field_hand(mut self, hand: impl Into<HandRef>) -> Self {
        self.hand = Some(hand.into());
        self
    }

    /// Returns this field narrowed to one feature, such as `palm` of the orientation.
    #[must_use]
    pub fn with_field_feature(mut self, feature: impl Into<String>) -> Self {
        self.feature = Some(feature.into());
        self
    }

    /// Returns this field with `dominant` and `weak` turned into `right` and `left`.
    #[must_use]
    pub fn resolve_field_hand(mut self, handedness: SignerHandedness) -> Self {
        self.hand = self.hand.map(|hand| hand.resolve_hand_ref(handedness).into());
        self
    }
}

impl fmt::Display for ComponentField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(phase) = self.phase {
            write!(f, "{phase}.")?;
        }
        if let Some(hand) = self.hand {
            write!(f, "{hand}.")?;
        }
        f.write_str(self.component.component_name())?;
        match &self.feature {
            Some(feature) => write!(f, ".{feature}"),
            None => Ok(()),
        }
    }
}

impl FromStr for ComponentField {
    type Err = FieldError;

    fn from_str(text: &str) -> Result<Self, FieldError> {
        let lower = text.trim().to_lowercase();
        let (mut hand, mut phase) = (None, None);
        let mut parts = lower.split('.');
        let component = loop {
            let Some(part) = parts.next() else {
                return Err(FieldError::NoComponent { text: text.to_owned() });
            };
            if let Some(component) = SignComponent::parse_component_name(part) {
                break component;
            }
            let repeated = if let Some(found) = HandRef::parse_hand_ref(part) {
                hand.replace(found).is_some()
            } else if let Some(found) = SignPhase::parse_sign_phase(part) {
                phase.replace(found).is_some()
            } else {
                return Err(FieldError::unknown_field_part(part));
            };
            if repeated {
                return Err(FieldError::Repeated { part: part.to_owned() });
            }
        };
        let feature = parts.next().map(str::to_owned);
        let legal = |name: &String| !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "-_".contains(c));
        if !feature.iter().all(legal) || parts.next().is_some() {
            return Err(FieldError::Feature { text: text.to_owned() });
        }
        if hand.is_some() && !component.is_manual() {
            return Err(FieldError::HandOfNonManual { text: text.to_owned() });
        }
        Ok(Self {
            hand,
            component,
            feature,
            phase,
        })
    }
}

chereme_motion::keep_as_text!(ComponentField);

/// A text that names no field.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FieldError {
    /// No part of the text is a component.
    #[error("{text:?} names no component: configuration, placement, movement, orientation or nonmanual")]
    NoComponent {
        /// The text as written.
        text: String,
    },
    /// A part before the component is neither a hand nor a phase.
    #[error("{part:?} is no hand, phase or component{}", crate::text::did_you_mean(nearest.as_deref()))]
    UnknownPart {
        /// The part that was not understood.
        part: String,
        /// The known word nearest to it.
        nearest: Option<String>,
    },
    /// A hand or a phase is named twice.
    #[error("{part:?} is the second hand or phase of this field: give one of each")]
    Repeated {
        /// The second one.
        part: String,
    },
    /// The component is followed by something other than one feature name.
    #[error("{text:?}: after the component stands at most one feature, such as orientation.palm")]
    Feature {
        /// The text as written.
        text: String,
    },
    /// A hand is given for a component that belongs to no hand.
    #[error("{text:?}: non-manual components belong to no hand; leave the hand out")]
    HandOfNonManual {
        /// The text as written.
        text: String,
    },
    /// The text names no hand.
    #[error("{text:?} is no hand: right, left, dominant or weak")]
    UnknownHand {
        /// The text as written.
        text: String,
    },
    /// The text names no phase.
    #[error("{text:?} is no phase: initial, middle, middle2 ... or final")]
    UnknownPhase {
        /// The text as written.
        text: String,
    },
}

impl FieldError {
    fn unknown_field_part(part: &str) -> Self {
        let hands = HandRef::ALL_HAND_REFS.into_iter().flat_map(HandRef::hand_ref_spellings);
        let components = SignComponent::ALL_COMPONENTS
            .into_iter()
            .flat_map(SignComponent::component_spellings);
        let words = hands.chain(components).chain(&["initial", "middle", "final"]).copied();
        let nearest = crate::text::nearest_candidate(part, words).map(str::to_owned);
        Self::UnknownPart {
            part: part.to_owned(),
            nearest,
        }
    }
}

/// The state of a component: a value, or one of three different kinds of missing value.
///
/// Two readings are the same value only when both are [`Value`](Self::Value); see
/// [`same_value`](Self::same_value).
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ComponentReading {
    /// The id of an inventory's value, or free text.
    Value(String),
    /// Nobody has coded it yet.
    #[default]
    Unset,
    /// There is nothing to code, such as the weak hand of a one-handed sign.
    NotApplicable,
    /// Somebody looked and could not decide.
    Unclear,
}

impl ComponentReading {
    /// Returns the value, if there is one.
    #[must_use]
    pub fn reading_value(&self) -> Option<&str> {
        match self {
            Self::Value(value) => Some(value),
            _ => None,
        }
    }

    /// Returns whether both readings are values and equal; two missing readings are never the same.
    #[must_use]
    pub fn same_value(&self, other: &Self) -> bool {
        self.reading_value().is_some() && self.reading_value() == other.reading_value()
    }
}

impl From<&str> for ComponentReading {
    /// Makes blank text [`Unset`](Self::Unset) and any other text a value.
    fn from(text: &str) -> Self {
        if text.trim().is_empty() {
            Self::Unset
        } else {
            Self::Value(text.to_owned())
        }
    }
}

impl fmt::Display for ComponentReading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Value(value) => value,
            Self::Unset => "unset",
            Self::NotApplicable => "not applicable",
            Self::Unclear => "unclear",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn fields_parse_and_print_in_one_order() {
        for (text, printed) in [
            ("right.configuration", "right.configuration"),
            ("Right.Handshape", "right.configuration"),
            ("final.placement", "final.placement"),
            ("right.final.location", "final.right.placement"),
            ("final.right.placement", "final.right.placement"),
            ("weak.configuration", "weak.configuration"),
            ("nondominant.shape", "weak.configuration"),
            ("nonmanual.brows", "nonmanual.brows"),
            ("start.nmm.mouth", "initial.nonmanual.mouth"),
            ("orientation.palm", "orientation.palm"),
            ("middle.movement.direction", "middle.movement.direction"),
            ("middle3.movement", "middle3.movement"),
            ("middle1.movement", "middle.movement"),
        ] {
            let field: ComponentField = text.parse().expect(text);
            assert_eq!(field.to_string(), printed);
        }
    }

    #[test]
    fn invalid_fields_are_refused_with_a_reason() {
        for (text, message) in [
            ("", r#""" is no hand, phase or component"#),
            (
                "right",
                r#""right" names no component: configuration, placement, movement, orientation or nonmanual"#,
            ),
            (
                "rihgt.configuration",
                r#""rihgt" is no hand, phase or component; did you mean "right"?"#,
            ),
            (
                "right.placment",
                r#""placment" is no hand, phase or component; did you mean "placement"?"#,
            ),
            (
                "right.left.placement",
                r#""left" is the second hand or phase of this field: give one of each"#,
            ),
            (
                "placement.x.y",
                r#""placement.x.y": after the component stands at most one feature, such as orientation.palm"#,
            ),
            (
                "placement.",
                r#""placement.": after the component stands at most one feature, such as orientation.palm"#,
            ),
            (
                "left.nonmanual.brows",
                r#""left.nonmanual.brows": non-manual components belong to no hand; leave the hand out"#,
            ),
            (
                "middle0.movement",
                r#""middle0" is no hand, phase or component; did you mean "middle"?"#,
            ),
        ] {
            let error = text.parse::<ComponentField>().expect_err(text);
            assert_eq!(error.to_string(), message);
        }
    }

    #[test]
    fn dominance_resolves_through_handedness() {
        assert_eq!(HandRef::Weak.resolve_hand_ref(SignerHandedness::Right), BodySide::Left);
        assert_eq!(
            HandRef::Dominant.resolve_hand_ref(SignerHandedness::Left),
            BodySide::Left
        );
        let field: ComponentField = "weak.placement".parse().expect("a field");
        assert_eq!(
            field.resolve_field_hand(SignerHandedness::Left).to_string(),
            "right.placement"
        );
    }

    #[test]
    fn missing_readings_never_count_as_equal() {
        let missing = [
            ComponentReading::Unset,
            ComponentReading::NotApplicable,
            ComponentReading::Unclear,
        ];
        for a in &missing {
            assert!(missing.iter().all(|b| !a.same_value(b)));
        }
        assert!(ComponentReading::from("U").same_value(&ComponentReading::from("U")));
        assert_eq!(ComponentReading::from("  "), ComponentReading::Unset);
    }

    fn any_field() -> impl Strategy<Value = ComponentField> {
        let hand = proptest::option::of(proptest::sample::select(HandRef::ALL_HAND_REFS.to_vec()));
        let component = proptest::sample::select(SignComponent::ALL_COMPONENTS.to_vec());
        let phase = prop_oneof![
            Just(None),
            Just(Some(SignPhase::Initial)),
            (1u8..).prop_map(|count| Some(SignPhase::Middle(count))),
            Just(Some(SignPhase::Final)),
        ];
        (hand, component, proptest::option::of("[a-z][a-z0-9_-]{0,8}"), phase).prop_map(
            |(hand, component, feature, phase)| ComponentField {
                hand: hand.filter(|_| component.is_manual()),
                component,
                feature,
                phase,
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn printing_then_parsing_gives_the_field_back(field in any_field()) {
            prop_assert_eq!(field.to_string().parse::<ComponentField>(), Ok(field.clone()));
            let json = serde_json::to_string(&field).expect("fields serialise");
            prop_assert_eq!(serde_json::from_str::<ComponentField>(&json).expect("and back"), field);
        }

        #[test]
        fn any_text_is_a_field_or_an_error(text in ".{0,40}") {
            let _ = text.parse::<ComponentField>();
        }
    }
}
