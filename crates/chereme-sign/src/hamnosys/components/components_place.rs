//! The inventory's placement for a notated place.

use super::super::tree::{
    BodyLocation, BodyPlace, HandConstellation, HandDigit, HandLocation, HandPlace, HandSite, LocationSide,
    PlaceContact,
};
use super::{ComponentWord, NotationLosses};

/// The hand that a place is for, and whether a symmetry applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PlaceHand {
    /// Whether it is the dominant hand.
    pub(super) dominant: bool,
    /// Whether left and right are exchanged for it.
    pub(super) mirrored: bool,
}

/// Returns the placement of a hand; `None` if the place does not concern it.
pub(super) fn placement_value(place: &HandPlace, whose: PlaceHand, lost: &mut NotationLosses) -> Option<ComponentWord> {
    match place {
        HandPlace::Body(place) => Some(body_place_value(place, whose, lost)),
        HandPlace::Hand(site) => Some(weak_hand_value(site, lost)),
        HandPlace::Hands(hands) => constellation_value(hands, whose, lost),
        HandPlace::Split(dominant, other) => {
            let half = if whose.dominant { dominant } else { other };
            let mirrored = false;
            placement_value(half.as_deref()?, PlaceHand { mirrored, ..whose }, lost)
        }
        HandPlace::Named(_) => {
            lost.add_notation_loss("placement: a place named before");
            None
        }
    }
}

fn constellation_value(
    hands: &HandConstellation,
    whose: PlaceHand,
    lost: &mut NotationLosses,
) -> Option<ComponentWord> {
    if let Some(at) = &hands.at {
        if hands.dominant.is_some() || hands.other.is_some() {
            lost.add_notation_loss("placement: the hands by each other");
        }
        return Some(body_place_value(at, whose, lost));
    }
    let site = if whose.dominant { &hands.other } else { &hands.dominant };
    match site {
        Some(site) if whose.dominant => Some(weak_hand_value(site, lost)),
        Some(_) => Some(ComponentWord::exact_value("neutral")),
        None => {
            lost.add_notation_loss("placement: the hands by each other");
            None
        }
    }
}

fn body_place_value(place: &BodyPlace, whose: PlaceHand, lost: &mut NotationLosses) -> ComponentWord {
    let Some(site) = place.site else {
        let far = place.contact == Some(PlaceContact::ArmExtended);
        return ComponentWord::exact_value(if far { "far" } else { "neutral" });
    };
    let mut exact = true;
    let mut miss = |what: &str| {
        lost.add_notation_loss(format!("placement: {what}"));
        exact = false;
    };
    if place.second.is_some_and(|second| second != site) {
        miss("half-way between two");
    }
    if site.approx {
        miss("only roughly there");
    }
    // Mirrored notation means the other side than it writes.
    let site_side = site.side.map(|side| {
        if whose.mirrored {
            mirrored_notated_side(side)
        } else {
            side
        }
    });
    let side = LateralSide::from_notated_side(site_side, whose.dominant);
    let touching = matches!(place.contact, Some(PlaceContact::Touch | PlaceContact::Brushing));
    let word = match space_height_word(site.at) {
        // A place that no hand touches is a height of the space before the body.
        Some(height) if !touching && !place.behind => {
            if side.is_some_and(|side| !side.beside) {
                miss("before the body's side, not beside it");
            }
            if site.at == BodyLocation::BelowStomach {
                miss("below the stomach");
            }
            space_placement_word(height, side, place.contact)
        }
        _ => on_body(site.at, side, place.behind, &mut miss),
    };
    ComponentWord { word, exact }
}

/// A side as the acting hand sees it, and as the signer does.
#[derive(Debug, Clone, Copy)]
struct LateralSide {
    own: bool,
    left: bool,
    beside: bool,
}

impl LateralSide {
    fn from_notated_side(side: Option<LocationSide>, dominant: bool) -> Option<Self> {
        let (left, beside) = match side? {
            LocationSide::LeftBeside => (true, true),
            LocationSide::LeftAt => (true, false),
            LocationSide::RightAt => (false, false),
            LocationSide::RightBeside => (false, true),
            _ => return None,
        };
        let is_own = left != dominant;
        Some(Self {
            own: is_own,
            left,
            beside,
        })
    }
}

fn mirrored_notated_side(side: LocationSide) -> LocationSide {
    match side {
        LocationSide::LeftBeside => LocationSide::RightBeside,
        LocationSide::LeftAt => LocationSide::RightAt,
        LocationSide::RightAt => LocationSide::LeftAt,
        LocationSide::RightBeside => LocationSide::LeftBeside,
        side => side,
    }
}

/// Heights in the space before the signer, for trunk locations without contact.
fn space_height_word(at: BodyLocation) -> Option<&'static str> {
    match at {
        BodyLocation::Shoulders => Some("high"),
        BodyLocation::Chest | BodyLocation::NeutralSpace => Some(""),
        BodyLocation::Stomach | BodyLocation::BelowStomach => Some("low"),
        _ => None,
    }
}

fn space_placement_word(height: &str, side: Option<LateralSide>, contact: Option<PlaceContact>) -> String {
    let side = match side {
        Some(side) if side.left => "left",
        Some(_) => "right",
        None => "",
    };
    let distance = match contact {
        Some(PlaceContact::Close) => "near",
        Some(PlaceContact::ArmExtended) => "far",
        _ => "",
    };
    let words: Vec<&str> = [height, side, distance]
        .into_iter()
        .filter(|word| !word.is_empty())
        .collect();
    if words.is_empty() {
        "neutral".to_owned()
    } else {
        words.join("-")
    }
}

fn on_body(at: BodyLocation, side: Option<LateralSide>, behind: bool, miss: &mut impl FnMut(&str)) -> String {
    use BodyLocation as B;
    let is_own_side = side.is_some_and(|side| side.own);
    let other = side.is_some_and(|side| !side.own);
    let is_beside = side.is_some_and(|side| side.beside);
    let mut has_side = true;
    let word = match at {
        B::Head if behind => "head-back",
        B::Head if is_beside => "beside-head",
        B::HeadTop => "head-top",
        B::Forehead if side.is_some() => "temple",
        B::Cheek if other => "cheek-contra",
        B::Lips if side.is_some() => "mouth-corner",
        B::Neck if side.is_some() => "neck-side",
        B::Shoulders if other => "shoulder-contra",
        B::Shoulders => "shoulder",
        B::ShoulderTop => "shoulder-top",
        B::Chest if is_own_side => "chest-ipsi",
        B::Chest if other => "chest-contra",
        B::Ear => "ear",
        B::EarLobe => "earlobe",
        B::Cheek => "cheek",
        B::Eyebrows => "eyebrow",
        B::Eyes => "eye",
        B::Nostrils => "nostril",
        at => {
            has_side = false;
            body_location_word(at, miss)
        }
    };
    if behind && word != "head-back" {
        miss("behind it");
    }
    // The other side is a value for few places; elsewhere it cannot be written.
    let names_side = matches!(word, "cheek-contra" | "shoulder-contra" | "chest-contra");
    if side.is_some() && (!has_side || (other && !names_side)) {
        miss("which side of it");
    }
    word.to_owned()
}

fn body_location_word(at: BodyLocation, miss: &mut impl FnMut(&str)) -> &'static str {
    use BodyLocation as B;
    if matches!(
        at,
        B::UpperEyelid | B::LowerEyelid | B::UpperLip | B::LowerLip | B::UpperTeeth | B::LowerTeeth
    ) {
        miss("its upper or lower part");
    }
    match at {
        B::Head => "head",
        B::Forehead => "forehead",
        B::UpperEyelid | B::LowerEyelid => "eye",
        B::Nose => "nose",
        B::Lips | B::UpperLip | B::LowerLip => "mouth",
        B::Tongue => "tongue",
        B::Teeth | B::UpperTeeth | B::LowerTeeth => "teeth",
        B::Chin => "chin",
        B::UnderChin => "under-chin",
        B::Neck => "neck",
        B::Chest => "chest",
        B::Stomach => "belly",
        B::BelowStomach => "below-belly",
        B::UpperArm => "upper-arm",
        B::Elbow => "elbow",
        B::ElbowInside => "elbow-inside",
        B::LowerArm => "forearm",
        _ => "neutral",
    }
}

/// Returns the placement on the weak hand or arm.
fn weak_hand_value(site: &HandSite, lost: &mut NotationLosses) -> ComponentWord {
    use HandLocation as H;
    let palmar = site.side == Some(LocationSide::Palmar);
    let thumb = site.digits.contains_digit(HandDigit::Thumb);
    let (word, exact) = match site.at {
        Some(H::Palm) => ("palm", true),
        // The ball of the thumb has no value of its own.
        Some(H::ThumbBall) => ("palm", false),
        Some(H::HandBack) => ("hand-back", true),
        Some(H::ThumbSide) => ("thumb-side", true),
        Some(H::PinkySide) => ("little-side", true),
        Some(H::WristBack) if palmar => ("wrist-inside", true),
        Some(H::WristBack) => ("wrist", true),
        Some(H::UpperArm) => ("upper-arm", true),
        Some(H::Elbow) => ("elbow", true),
        Some(H::ElbowInside) => ("elbow-inside", true),
        Some(H::LowerArm) => ("forearm", true),
        Some(H::Tip) if thumb => ("thumb", true),
        Some(H::Tip) => ("fingertips", site.digits.is_empty()),
        _ if thumb => ("thumb", site.at.is_none()),
        Some(H::Nail | H::Pad) => ("fingertips", false),
        Some(H::MidJoint | H::Base | H::Side) | None => ("fingers", site.at.is_none()),
    };
    if !exact || site.second.is_some() || site.approx {
        lost.add_notation_loss("placement: which part of the fingers or hand");
    }
    let exact = exact && site.second.is_none() && !site.approx;
    let word = word.to_owned();
    ComponentWord { word, exact }
}
