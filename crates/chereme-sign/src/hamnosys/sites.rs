//! Locations of notation as places on a body: a landmark with an offset, and an outward normal.
//!
//! Offsets and directions are to the signer's left, up and forward; offsets in shoulder widths. The
//! landmarks' names are those of `chereme_motion::BodyAnatomy::landmark_place_position`.

use chereme_motion::BodySide as Half;

use super::hamnosys_language::BodyLanguage;
use super::tree::{BodyLocation, LocationSide, PlaceContact, SidedLocation};

mod sites_points;

pub use sites_points::{DigitFace, NotatedHandPoint, coming_first, digit_joint, from_bone, hand_points, on_palm};

/// The part of the body that a place belongs to; it determines distances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyRegion {
    /// The trunk and the space before it.
    Trunk,
    /// The head.
    Face,
    /// An arm.
    Arm(Half),
}

/// A place on the body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySite {
    /// The landmark's name.
    pub landmark: String,
    /// Offset from the landmark to the place (left, up, forward) in shoulder widths.
    pub offset: [f64; 3],
    /// The outward unit normal there (left, up, forward).
    pub out: [f64; 3],
    /// The part of the body that it belongs to.
    pub region: BodyRegion,
    /// Distance to the left of the middle for a hand that is before the body rather than at it, in
    /// shoulder widths.
    pub lateral: f64,
    /// Whether the place is next to the body. Of these places hands touch only those next to the head,
    /// nearer, as [`HandAt`] says.
    pub beside: bool,
    /// Whether the place is a height of the space before the body, unless a hand touches it: transcribers write the head
    /// so, as they write shoulders and chest.
    pub level: bool,
}

impl BodySite {
    /// Returns the part of the body that determines the distance of a hand with this contact.
    #[must_use]
    pub fn region_for(&self, contact: Option<PlaceContact>) -> BodyRegion {
        region_for(self.region, self.level, contact)
    }
}

/// Returns the part of the body that determines the distance of a hand with a contact, from a place's region and
/// whether it is a height of the space before the body.
#[must_use]
pub fn region_for(region: BodyRegion, level: bool, contact: Option<PlaceContact>) -> BodyRegion {
    match contact {
        None | Some(PlaceContact::Close | PlaceContact::ArmExtended) if level => BodyRegion::Trunk,
        _ => region,
    }
}

/// Returns whether a hand at a place, of which no part is named, is there with the point that meets it first: in contact, and
/// at the head and arms unless the arm is extended; else with the middle of its palm.
#[must_use]
pub fn is_place_of_first_point(region: BodyRegion, contact: Option<PlaceContact>) -> bool {
    match contact {
        None | Some(PlaceContact::Close) => region != BodyRegion::Trunk,
        Some(PlaceContact::ArmExtended) => false,
        Some(_) => true,
    }
}

/// Returns the share of their usual distance from the middle that two hands keep at a place there.
#[must_use]
pub fn hands_apart_share(contact: Option<PlaceContact>) -> f64 {
    match contact {
        Some(PlaceContact::Close) => 0.45,
        _ => 1.0,
    }
}

/// Distance from the middle of the `at` side of the trunk, in shoulder widths.
const AT_SIDE_SHOULDER_WIDTHS: f64 = 0.30;
/// Distance from the middle of a hand before a place at the `at` side, in shoulder widths.
const BEFORE_SIDE_SHOULDER_WIDTHS: f64 = 0.45;
/// Distance from the middle of a hand next to the body, in shoulder widths.
const BESIDE_BODY_SHOULDER_WIDTHS: f64 = 0.85;

/// Inward distance from a place next to the head to the point that a hand touches there, in shoulder
/// widths: at the temple, the cheek, the jaw.
const TOUCHED_BESIDE_HEAD: f64 = 0.12;
/// The same next to the trunk: at its side.
const TOUCHED_BESIDE_TRUNK: f64 = BESIDE_BODY_SHOULDER_WIDTHS - 0.46;
/// Distance from the front of the trunk back to its side, in shoulder widths.
const SIDE_OF_TRUNK_BACK: f64 = 0.30;
/// Distance from the middle of the body to the front of the trunk, in shoulder widths.
pub const TRUNK_FRONT_SHOULDER_WIDTHS: f64 = 0.33;
/// Distance from the bone of an arm to its skin, in lengths of the arm.
pub const FLESH_DEPTH_ARM_LENGTHS: f64 = 0.08;
/// Sideways shift of an extended arm before a place of head or arm, as a share of the place's own distance from the middle.
const SIDEWAYS_SHIFT_SHARE: f64 = 0.5;
/// Share of the usual distance that a hand next to the trunk is in front of it.
const BESIDE_NEARER: f64 = 0.85;

/// The position that a place gives to a hand, from the place or from the middle of the body; lengths in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HandAt {
    /// At the place itself.
    Place,
    /// Away from the place: along its outward normal, and to the left.
    Off {
        /// Along the outward normal; negative inwards.
        out: f64,
        /// To the left.
        left: f64,
    },
    /// In front of the trunk at the level of the place: from the middle of the body to the left and forward.
    Front {
        /// To the left.
        left: f64,
        /// Forward.
        forward: f64,
    },
}

impl HandAt {
    /// Returns the position of a hand with a contact at a place. The region is that for this contact; `arm` and `shoulders`
    /// are the body's lengths in metres.
    ///
    /// `ahead` is the distance (m) of the hand's point before its wrist. In the space before the trunk, a hand that
    /// points away from the signer is farther by that: the forearm decides how far hands are, and an elbow that would
    /// have to go behind the back for a nearer place stays beside the trunk.
    #[must_use]
    pub fn hand_at_place(
        region: BodyRegion,
        lateral: f64,
        beside: bool,
        contact: Option<PlaceContact>,
        language: &BodyLanguage,
        [arm, shoulders]: [f64; 2],
        ahead: f64,
    ) -> Self {
        let trunk = region == BodyRegion::Trunk;
        let far = match contact {
            Some(PlaceContact::ArmExtended) => language.far,
            Some(PlaceContact::Close) if trunk => language.near_trunk,
            Some(PlaceContact::Close) => language.near_face,
            Some(_) if !beside => return Self::Place,
            Some(PlaceContact::Touch) => {
                let inwards = if trunk {
                    TOUCHED_BESIDE_TRUNK
                } else {
                    TOUCHED_BESIDE_HEAD
                };
                let out = -inwards * shoulders;
                return Self::Off { out, left: 0.0 };
            }
            _ if trunk => language.medium_trunk,
            _ => language.medium_face,
        } * arm;
        if trunk {
            let share = if beside { BESIDE_NEARER } else { 1.0 };
            // An extended arm is extended beside the trunk too, and reaches no farther for a hand that points away.
            let (share, ahead) = match contact {
                Some(PlaceContact::ArmExtended) => (1.0, 0.0),
                _ => (share, ahead.max(0.0)),
            };
            return Self::Front {
                left: lateral * shoulders,
                forward: TRUNK_FRONT_SHOULDER_WIDTHS * shoulders + far * share + ahead,
            };
        }
        let left = match contact {
            Some(PlaceContact::ArmExtended) if !beside => SIDEWAYS_SHIFT_SHARE * lateral * shoulders,
            _ => 0.0,
        };
        Self::Off { out: far, left }
    }
}

/// Returns the place that a location of the body means for a hand.
///
/// `acting` is the hand that decides the side of paired places without a notated side; places on arms are
/// then on the other arm. With `mirrored`, left and right in the notation are exchanged.
#[must_use]
pub fn resolve_body_site(site: &SidedLocation<BodyLocation>, acting: Half, mirrored: bool) -> BodySite {
    let half = half_of_side(site.side, mirrored);
    let notated = NotatedSide {
        half,
        is_beside: matches!(site.side, Some(LocationSide::LeftBeside | LocationSide::RightBeside)),
        sign: half.map_or(0.0, Half::side_sign),
        acting_half: half.unwrap_or(acting),
    };
    let NotatedSide { sign, acting_half, .. } = notated;
    let face = |landmark: String, offset: [f64; 3], out: [f64; 3]| notated.face_site(landmark, offset, out);
    let sided = |name: &str| format!("{}-{name}", acting_half.body_side_name());
    let or = |middle: &str, side: &str| match half {
        Some(half) => format!("{}-{side}", half.body_side_name()),
        None => middle.to_owned(),
    };
    let front = [0.35 * sign, 0.0, 1.0];
    // Beside its middle the face falls back a little.
    let shifted = |by: f64| [sign * by, 0.0, if half.is_some() { -0.03 } else { 0.0 }];
    match site.at {
        BodyLocation::NeutralSpace => notated.trunk_site("chest", -0.12),
        BodyLocation::Shoulders => notated.trunk_site("upper-chest", 0.10),
        BodyLocation::Chest => notated.trunk_site("chest", 0.0),
        BodyLocation::Stomach => notated.trunk_site("stomach", 0.0),
        BodyLocation::BelowStomach => notated.trunk_site("abdomen", 0.0),
        BodyLocation::ShoulderTop if notated.is_at_side() => BodySite {
            landmark: sided("shoulder"),
            offset: [-0.08 * sign, 0.20, 0.06],
            out: [0.0, 1.0, 0.0],
            ..notated.trunk_site("throat", 0.0)
        },
        BodyLocation::ShoulderTop => notated.trunk_site("throat", -0.06),
        BodyLocation::Neck if notated.is_at_side() => BodySite {
            landmark: sided("neck-side"),
            offset: [0.0, -0.02, 0.10],
            out: unit_vector_of([0.6 * sign, 0.0, 1.0]),
            ..notated.trunk_site("throat", 0.0)
        },
        BodyLocation::Neck => notated.trunk_site("throat", 0.02),
        BodyLocation::Head => BodySite {
            level: true,
            lateral: notated.trunk_lateral(),
            ..match half {
                Some(_) => face(sided("temple"), [0.0, 0.0, 0.0], [sign, 0.0, 0.3]),
                None => face("eyebrows".into(), [0.0; 3], front),
            }
        },
        BodyLocation::HeadTop => face("head-top".into(), shifted(0.16), [0.25 * sign, 1.0, 0.0]),
        BodyLocation::Forehead => match half {
            // The curve of the skull towards the temple.
            Some(_) => face("forehead".into(), [sign * 0.16, 0.0, -0.10], [0.8 * sign, 0.0, 0.6]),
            None => face("forehead".into(), [0.0; 3], front),
        },
        BodyLocation::Eyebrows => face(or("eyebrows", "eyebrow"), [0.0; 3], front),
        BodyLocation::Eyes => face(or("eyes", "eye"), [0.0; 3], front),
        BodyLocation::UpperEyelid => face(or("eyes", "eye"), [0.0, 0.02, 0.01], front),
        BodyLocation::LowerEyelid => face(or("eyes", "eye"), [0.0, -0.03, 0.01], front),
        BodyLocation::Nose => face("nose".into(), shifted(0.04), front),
        BodyLocation::Nostrils => face(or("nose", "nostril"), [0.0, -0.03, 0.0], [0.0, -0.5, 1.0]),
        BodyLocation::Lips | BodyLocation::Teeth => face(or("mouth", "mouth-corner"), [0.0; 3], front),
        BodyLocation::Tongue => face(or("mouth", "mouth-corner"), [0.0, -0.01, 0.03], front),
        BodyLocation::UpperLip | BodyLocation::UpperTeeth => {
            face(or("mouth", "mouth-corner"), [0.0, 0.025, 0.0], front)
        }
        BodyLocation::LowerLip | BodyLocation::LowerTeeth => {
            face(or("mouth", "mouth-corner"), [0.0, -0.025, 0.0], front)
        }
        BodyLocation::Chin => face("chin".into(), shifted(0.10), front),
        BodyLocation::UnderChin => face("under-chin".into(), shifted(0.08), [0.0, -1.0, 0.35]),
        BodyLocation::Ear => face(sided("ear"), [0.0; 3], [acting_half.side_sign(), 0.0, 0.1]),
        BodyLocation::EarLobe => face(sided("earlobe"), [0.0; 3], [acting_half.side_sign(), -0.2, 0.1]),
        BodyLocation::Cheek => face(sided("cheek"), [0.0; 3], [0.7 * acting_half.side_sign(), 0.0, 0.7]),
        BodyLocation::UpperArm => arm_body_site(site.side, acting, "upper-arm"),
        BodyLocation::Elbow => arm_body_site(site.side, acting, "elbow"),
        BodyLocation::ElbowInside => arm_body_site(Some(site.side.unwrap_or(LocationSide::Front)), acting, "elbow"),
        BodyLocation::LowerArm => arm_body_site(site.side, acting, "forearm"),
    }
}

/// The side of the body that a location names.
#[derive(Clone, Copy)]
struct NotatedSide {
    half: Option<Half>,
    /// Whether it is next to the body.
    is_beside: bool,
    /// 1 to the left, -1 to the right, 0 in the middle.
    sign: f64,
    /// The named half, else that of the acting hand.
    acting_half: Half,
}

impl NotatedSide {
    fn is_at_side(self) -> bool {
        self.half.is_some() && !self.is_beside
    }

    /// Returns the distance to the left of the middle for a hand before the trunk, in shoulder widths.
    fn trunk_lateral(self) -> f64 {
        self.sign
            * match self.is_beside {
                true => BESIDE_BODY_SHOULDER_WIDTHS,
                false => BEFORE_SIDE_SHOULDER_WIDTHS,
            }
    }

    /// Returns a place of the trunk, `up` shoulder widths above a landmark.
    fn trunk_site(self, landmark: &str, up: f64) -> BodySite {
        let (far, back, out) = match self.half {
            Some(_) if self.is_beside => (BESIDE_BODY_SHOULDER_WIDTHS, -SIDE_OF_TRUNK_BACK, [self.sign, 0.0, 0.0]),
            // The chest curves back towards its sides.
            Some(_) => (AT_SIDE_SHOULDER_WIDTHS, -0.04, [0.0, 0.0, 1.0]),
            None => (0.0, 0.0, [0.0, 0.0, 1.0]),
        };
        BodySite {
            landmark: landmark.to_owned(),
            offset: [self.sign * far, up, back],
            out,
            region: BodyRegion::Trunk,
            lateral: self.trunk_lateral(),
            beside: self.is_beside,
            level: false,
        }
    }

    /// Returns a place of the head at an offset from a landmark.
    fn face_site(self, landmark: String, [left, up, forward]: [f64; 3], out: [f64; 3]) -> BodySite {
        let (aside, out, lateral) = match self.is_beside {
            true => (self.sign * 0.20, [self.sign, 0.0, 0.0], 0.62),
            false => (0.0, unit_vector_of(out), 0.30),
        };
        BodySite {
            landmark,
            offset: [left + aside, up, forward],
            out,
            region: BodyRegion::Face,
            lateral: self.sign * lateral,
            beside: self.is_beside,
            level: false,
        }
    }
}

/// Returns a place on the arm that an acting hand reaches for: the other arm, whatever side is notated, as no hand
/// reaches its own.
fn arm_body_site(side: Option<LocationSide>, acting: Half, part: &str) -> BodySite {
    let half = acting.opposite_side();
    let outside = half.side_sign();
    let out = match side {
        Some(LocationSide::Palmar | LocationSide::Front) => [-0.3 * outside, 0.2, 1.0],
        Some(LocationSide::Back) => [0.3 * outside, 0.0, -1.0],
        Some(LocationSide::Ulnar) => [0.0, -1.0, 0.2],
        Some(LocationSide::Radial | LocationSide::Dorsal) => [0.2 * outside, 1.0, 0.4],
        // Without a side a hand meets forearm and elbow from above, and the upper arm from outside.
        _ => match part {
            "forearm" | "elbow" => [0.2 * outside, 1.0, 0.4],
            _ => [0.8 * outside, 0.0, 0.7],
        },
    };
    BodySite {
        landmark: format!("{}-{part}", half.body_side_name()),
        offset: [0.0; 3],
        out: unit_vector_of(out),
        region: BodyRegion::Arm(half),
        lateral: half.side_sign() * BEFORE_SIDE_SHOULDER_WIDTHS,
        beside: false,
        level: false,
    }
}

/// Returns the half of the body that a side means.
#[must_use]
pub fn half_of_side(side: Option<LocationSide>, mirrored: bool) -> Option<Half> {
    let half = match side? {
        LocationSide::LeftAt | LocationSide::LeftBeside => Half::Left,
        LocationSide::RightAt | LocationSide::RightBeside => Half::Right,
        _ => return None,
    };
    Some(if mirrored { half.opposite_side() } else { half })
}

/// Returns a vector of the same direction and length 1.
pub(super) fn unit_vector_of(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|part| part * part).sum::<f64>().sqrt();
    v.map(|part| part / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::BodyAnatomy;

    const ALL: [BodyLocation; 32] = [
        BodyLocation::Head,
        BodyLocation::HeadTop,
        BodyLocation::Forehead,
        BodyLocation::Eyebrows,
        BodyLocation::Eyes,
        BodyLocation::UpperEyelid,
        BodyLocation::LowerEyelid,
        BodyLocation::Nose,
        BodyLocation::Nostrils,
        BodyLocation::Lips,
        BodyLocation::UpperLip,
        BodyLocation::LowerLip,
        BodyLocation::Tongue,
        BodyLocation::Teeth,
        BodyLocation::UpperTeeth,
        BodyLocation::LowerTeeth,
        BodyLocation::Chin,
        BodyLocation::UnderChin,
        BodyLocation::Neck,
        BodyLocation::Shoulders,
        BodyLocation::ShoulderTop,
        BodyLocation::Chest,
        BodyLocation::Stomach,
        BodyLocation::BelowStomach,
        BodyLocation::Ear,
        BodyLocation::EarLobe,
        BodyLocation::Cheek,
        BodyLocation::UpperArm,
        BodyLocation::Elbow,
        BodyLocation::ElbowInside,
        BodyLocation::LowerArm,
        BodyLocation::NeutralSpace,
    ];

    #[test]
    fn the_head_is_a_height_of_the_space_before_the_body_unless_it_is_touched() {
        let site = |at| SidedLocation {
            at,
            side: Some(LocationSide::RightAt),
            approx: false,
        };
        let head = resolve_body_site(&site(BodyLocation::Head), Half::Right, false);
        for (contact, region) in [
            (None, BodyRegion::Trunk),
            (Some(PlaceContact::Close), BodyRegion::Trunk),
            (Some(PlaceContact::ArmExtended), BodyRegion::Trunk),
            (Some(PlaceContact::Touch), BodyRegion::Face),
            (Some(PlaceContact::Brushing), BodyRegion::Face),
        ] {
            assert_eq!(head.region_for(contact), region, "{contact:?}");
        }
        for at in [BodyLocation::Forehead, BodyLocation::Chest] {
            let found = resolve_body_site(&site(at), Half::Right, false);
            assert_eq!(found.region_for(None), found.region);
        }
    }

    #[test]
    fn a_hand_that_points_away_is_farther_before_the_trunk() {
        let language = BodyLanguage::default_body_language();
        let forward = |contact, ahead| match HandAt::hand_at_place(
            BodyRegion::Trunk,
            0.0,
            false,
            contact,
            language,
            [0.5, 0.4],
            ahead,
        ) {
            HandAt::Front { forward, .. } => forward,
            other => panic!("{other:?}"),
        };
        for (contact, far) in [
            (None, language.medium_trunk),
            (Some(PlaceContact::Close), language.near_trunk),
        ] {
            let still = TRUNK_FRONT_SHOULDER_WIDTHS * 0.4 + far * 0.5;
            for (ahead, more) in [(0.0, 0.0), (0.08, 0.08), (-0.08, 0.0)] {
                assert!((forward(contact, ahead) - still - more).abs() < 1e-12);
            }
        }
        let stretched = Some(PlaceContact::ArmExtended);
        assert_eq!(forward(stretched, 0.08), forward(stretched, 0.0));
    }

    #[test]
    fn an_arm_is_extended_beside_the_trunk_as_far_as_before_it() {
        let language = BodyLanguage::default_body_language();
        let forward = |beside, contact| match HandAt::hand_at_place(
            BodyRegion::Trunk,
            0.8,
            beside,
            contact,
            language,
            [0.5, 0.4],
            0.0,
        ) {
            HandAt::Front { forward, .. } => forward,
            other => panic!("{other:?}"),
        };
        let stretched = Some(PlaceContact::ArmExtended);
        assert_eq!(forward(true, stretched), forward(false, stretched));
        assert!(forward(true, None) < forward(false, None));
    }

    #[test]
    fn every_location_has_a_landmark_and_mirrors_to_the_other_side() {
        let landmarks = BodyAnatomy::landmark_names();
        let sides = [
            None,
            Some(LocationSide::LeftAt),
            Some(LocationSide::RightAt),
            Some(LocationSide::LeftBeside),
            Some(LocationSide::RightBeside),
            Some(LocationSide::Front),
        ];
        for at in ALL {
            for side in sides {
                let site = SidedLocation {
                    at,
                    side,
                    approx: false,
                };
                let right = resolve_body_site(&site, Half::Right, false);
                let left = resolve_body_site(&site, Half::Left, true);
                assert!(landmarks.contains(&right.landmark), "{}", right.landmark);
                assert_eq!(
                    right.offset,
                    [-left.offset[0], left.offset[1], left.offset[2]],
                    "{at:?}"
                );
                assert_eq!(right.out, [-left.out[0], left.out[1], left.out[2]], "{at:?}");
                assert_eq!(right.lateral, -left.lateral);
                let length = right.out.iter().map(|x| x * x).sum::<f64>();
                assert!((length - 1.0).abs() < 1e-9);
            }
        }
    }
}
