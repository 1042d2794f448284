//! Non-manual actions of face and body: the non-manual tiers of SiGML.
//!
//! Tags are kept as written, a short code (`L04`) or a code with its words (`L04_pursed_lips`);
//! [`NonmanualAct::act_code`] returns the code of either. A mouth picture is SAMPA.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The actions of face and body during a sign, tier by tier.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct NonmanualActs {
    /// The tiers with acts.
    pub tiers: BTreeMap<TierKind, NonmanualTier>,
}

impl NonmanualActs {
    /// Returns whether no tier has an action.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tiers.is_empty()
    }

    /// Returns every act with its tier, in the order of tiers and then of time.
    pub fn acts_by_tier(&self) -> impl Iterator<Item = (TierKind, &NonmanualAct)> {
        self.tiers
            .iter()
            .flat_map(|(kind, tier)| tier.groups.iter().flatten().map(move |act| (*kind, act)))
    }

    /// Adds simultaneous acts after the tier's last ones.
    pub fn push_act_group(&mut self, kind: TierKind, group: Vec<NonmanualAct>) {
        self.tiers.entry(kind).or_default().groups.push(group);
    }
}

/// The tiers, in the order in which they are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TierKind {
    /// The shoulders.
    Shoulder,
    /// The trunk.
    Body,
    /// The head.
    Head,
    /// The gaze.
    EyeGaze,
    /// Brows, lids and nose.
    FacialExpr,
    /// The mouth.
    Mouthing,
    /// Anything else.
    Extra,
}

impl TierKind {}

/// One tier: acts one after the other, some at the same time.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NonmanualTier {
    /// The start of the tier, if it differs from that of the hands.
    pub start: Option<TierStart>,
    /// The end of the tier, if it differs from that of the hands.
    pub end: Option<TierEnd>,
    /// Whether a mouth picture is stretched to the time of the hands.
    pub fit_picture: bool,
    /// The acts in their order; those of one group are simultaneous.
    pub groups: Vec<Vec<NonmanualAct>>,
}

impl NonmanualTier {
    /// Returns whether no part of it is set.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// The start of a tier relative to the hands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TierStart {
    /// A little later.
    SlightDelay,
    /// A little earlier.
    StartSlightlyAhead,
}

/// The end of a tier relative to the hands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TierEnd {
    /// Later.
    LastsLonger,
    /// Earlier.
    EndsBefore,
}

/// One act of a part of face or body.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NonmanualAct {
    /// The acting part.
    pub part: NonmanualPart,
    /// The tag as written, or the SAMPA of a mouth picture.
    pub tag: String,
    /// Its intensity, 1 by default; present in some files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amount: Option<f64>,
    /// A factor on its speed, 1 by default; present in some files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
}

impl NonmanualAct {
    /// Returns an act of a part without modifications.
    #[must_use]
    pub fn new(part: NonmanualPart, tag: impl Into<String>) -> Self {
        Self {
            part,
            tag: tag.into(),
            amount: None,
            speed: None,
        }
    }

    /// Returns the code of the tag: the part before the first underscore, or the whole of a mouth picture.
    #[must_use]
    pub fn act_code(&self) -> &str {
        match self.part {
            NonmanualPart::MouthPicture => &self.tag,
            _ => self.tag.split('_').next().unwrap_or_default(),
        }
    }

    /// Returns the name of its curve: the part and the code, such as `head.SR`.
    #[must_use]
    pub fn act_curve_name(&self) -> String {
        let part = match self.part {
            NonmanualPart::Shoulders => "shoulders",
            NonmanualPart::Body => "body",
            NonmanualPart::Head => "head",
            NonmanualPart::Gaze => "gaze",
            NonmanualPart::Brows => "brows",
            NonmanualPart::Lids => "lids",
            NonmanualPart::Nose => "nose",
            NonmanualPart::MouthGesture => "mouth",
            NonmanualPart::MouthPicture => "mouthing",
            NonmanualPart::MouthMeta => "mouth-meta",
            NonmanualPart::Extra => "extra",
            NonmanualPart::Neutral => "neutral",
        };
        format!("{part}.{}", self.act_code())
    }

    /// Returns whether its code is a known one of the part.
    #[must_use]
    pub fn is_listed(&self) -> bool {
        self.part.is_listed(self.act_code())
    }

    fn act_number_bits(&self) -> [Option<u64>; 2] {
        [self.amount, self.speed].map(|number| number.map(f64::to_bits))
    }
}

/// Acts are equal if their parts and codes are equal; words after the code do not count.
impl PartialEq for NonmanualAct {
    fn eq(&self, other: &Self) -> bool {
        self.part == other.part
            && self.act_code() == other.act_code()
            && self.act_number_bits() == other.act_number_bits()
    }
}

impl Eq for NonmanualAct {}

/// The part of face or body that acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NonmanualPart {
    /// The shoulders.
    Shoulders,
    /// The trunk.
    Body,
    /// The head.
    Head,
    /// The eyes' gaze.
    Gaze,
    /// The eyebrows.
    Brows,
    /// The eyelids.
    Lids,
    /// The nose.
    Nose,
    /// The mouth, by a tag.
    MouthGesture,
    /// The mouth, by the sounds that it mouths.
    MouthPicture,
    /// The mouth continues its previous act: `holdprevious` or `stretchprevious`.
    MouthMeta,
    /// Anything else.
    Extra,
    /// Nothing: back to rest.
    Neutral,
}

impl NonmanualPart {
    /// Returns its tier in SiGML.
    #[must_use]
    pub fn sigml_tier(self) -> TierKind {
        match self {
            Self::Shoulders => TierKind::Shoulder,
            Self::Body => TierKind::Body,
            Self::Head => TierKind::Head,
            Self::Gaze => TierKind::EyeGaze,
            Self::Brows | Self::Lids | Self::Nose => TierKind::FacialExpr,
            Self::MouthGesture | Self::MouthPicture | Self::MouthMeta => TierKind::Mouthing,
            Self::Extra | Self::Neutral => TierKind::Extra,
        }
    }

    /// Returns whether SiGML, or its reference engine (`ND` and `NU`), lists a code for the part; always true for parts
    /// with free text.
    #[must_use]
    pub fn is_listed(self, code: &str) -> bool {
        let codes = match self {
            Self::Shoulders => "UL UR UB HL HR HB SL SR SB",
            Self::Body => "RL RR TL TR TF TB SI HE ST RD",
            Self::Head => "NO ND NU SH SR SL TR TL NF NB PF PB LI",
            Self::Gaze => "AD FR HD HI HC UP DN LE RI NO RO LU LD RU RD",
            Self::Brows => "RB RR RL FU",
            Self::Lids => "WB WR WL SB SR SL CB CR CL TB TR TL BB",
            Self::Nose => "WR TW WI",
            Self::MouthMeta => "holdprevious stretchprevious",
            Self::MouthGesture => return is_mouth_gesture(code),
            Self::MouthPicture | Self::Extra | Self::Neutral => return true,
        };
        codes.split(' ').any(|known| known == code)
    }
}

/// Teeth D01 to D09, jaw J01 to J04, lips L01 to L35, cheeks C01 to C13, tongue T01 to T17.
fn is_mouth_gesture(code: &str) -> bool {
    let last = match code.as_bytes().first() {
        Some(b'D') => 9,
        Some(b'J') => 4,
        Some(b'L') => 35,
        Some(b'C') => 13,
        Some(b'T') => 17,
        _ => return false,
    };
    code.len() == 3
        && code[1..].bytes().all(|byte| byte.is_ascii_digit())
        && code[1..].parse().is_ok_and(|number: u8| (1..=last).contains(&number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_compared_by_their_code() {
        let part = NonmanualPart::MouthGesture;
        assert_eq!(
            NonmanualAct::new(part, "L04"),
            NonmanualAct::new(part, "L04_pursed_lips")
        );
        assert_ne!(NonmanualAct::new(part, "L04"), NonmanualAct::new(part, "L05"));
        let picture = NonmanualPart::MouthPicture;
        assert_ne!(NonmanualAct::new(picture, "a_b"), NonmanualAct::new(picture, "a_c"));
    }

    #[test]
    fn listed_codes_are_distinguished_from_unlisted_ones() {
        let listed = |part: NonmanualPart, tag: &str| NonmanualAct::new(part, tag).is_listed();
        assert!(listed(NonmanualPart::Head, "SH_shaking_left_and_right"));
        assert!(listed(NonmanualPart::MouthGesture, "T17"));
        for (part, odd) in [
            (NonmanualPart::Head, "NX"),
            (NonmanualPart::Brows, "DN"),
            (NonmanualPart::MouthGesture, "T18"),
            (NonmanualPart::MouthGesture, "L00"),
            (NonmanualPart::MouthGesture, "Lé"),
            (NonmanualPart::MouthGesture, ""),
        ] {
            assert!(!listed(part, odd), "{odd}");
        }
    }

    #[test]
    fn every_tier_and_part_reads_back_from_json() {
        use NonmanualPart::*;
        let mut said = NonmanualActs::default();
        for part in [
            Shoulders,
            Body,
            Head,
            Gaze,
            Brows,
            Lids,
            Nose,
            MouthGesture,
            MouthPicture,
            MouthMeta,
            Extra,
            Neutral,
        ] {
            said.push_act_group(part.sigml_tier(), vec![NonmanualAct::new(part, "X")]);
        }
        let text = serde_json::to_string(&said).expect("plain data");
        assert_eq!(serde_json::from_str::<NonmanualActs>(&text).ok(), Some(said));
    }
}
