//! The inventory's placement for a notated place.

use super::super::tree::{
    BodyLocation, BodyPlace, Constellation, Contact, Digit, HandLocation, HandSite, Place, Side,
};
use super::{Lost, Value};

/// The hand that a place is for, and whether a symmetry applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Whose {
    /// Whether it is the dominant hand.
    pub(super) dominant: bool,
    /// Whether left and right are exchanged for it.
    pub(super) mirrored: bool,
}

/// Returns the placement of a hand; `None` if the place does not concern it.
pub(super) fn placement(place: &Place, whose: Whose, lost: &mut Lost) -> Option<Value> {
    match place {
        Place::Body(place) => Some(body(place, whose, lost)),
        Place::Hand(site) => Some(hand(site, lost)),
        Place::Hands(hands) => constellation(hands, whose, lost),
        Place::Split(dominant, other) => {
            let half = if whose.dominant { dominant } else { other };
            let mirrored = false;
            placement(half.as_deref()?, Whose { mirrored, ..whose }, lost)
        }
        Place::Named(_) => {
            lost.add("placement: a place named before");
            None
        }
    }
}

fn constellation(hands: &Constellation, whose: Whose, lost: &mut Lost) -> Option<Value> {
    if let Some(at) = &hands.at {
        if hands.dominant.is_some() || hands.other.is_some() {
            lost.add("placement: the hands by each other");
        }
        return Some(body(at, whose, lost));
    }
    let site = if whose.dominant {
        &hands.other
    } else {
        &hands.dominant
    };
    match site {
        Some(site) if whose.dominant => Some(hand(site, lost)),
        Some(_) => Some(Value::exact("neutral")),
        None => {
            lost.add("placement: the hands by each other");
            None
        }
    }
}

fn body(place: &BodyPlace, whose: Whose, lost: &mut Lost) -> Value {
    let Some(site) = place.site else {
        let far = place.contact == Some(Contact::ArmExtended);
        return Value::exact(if far { "far" } else { "neutral" });
    };
    let mut exact = true;
    let mut miss = |what: &str| {
        lost.add(format!("placement: {what}"));
        exact = false;
    };
    if place.second.is_some_and(|second| second != site) {
        miss("half-way between two");
    }
    if site.approx {
        miss("only roughly there");
    }
    let side = site
        .side
        .map(|side| if whose.mirrored { mirrored(side) } else { side });
    let side = Lateral::of(side, whose.dominant);
    let touching = matches!(place.contact, Some(Contact::Touch | Contact::Brushing));
    let word = match height(site.at) {
        Some(height) if !touching && !place.behind => {
            if side.is_some_and(|side| !side.beside) {
                miss("before the body's side, not beside it");
            }
            if site.at == BodyLocation::BelowStomach {
                miss("below the stomach");
            }
            space(height, side, place.contact)
        }
        _ => on_body(site.at, side, place.behind, &mut miss),
    };
    Value { word, exact }
}

/// A side as the acting hand sees it, and as the signer does.
#[derive(Debug, Clone, Copy)]
struct Lateral {
    own: bool,
    left: bool,
    beside: bool,
}

impl Lateral {
    fn of(side: Option<Side>, dominant: bool) -> Option<Self> {
        let (left, beside) = match side? {
            Side::LeftBeside => (true, true),
            Side::LeftAt => (true, false),
            Side::RightAt => (false, false),
            Side::RightBeside => (false, true),
            _ => return None,
        };
        let own = left != dominant;
        Some(Self { own, left, beside })
    }
}

fn mirrored(side: Side) -> Side {
    match side {
        Side::LeftBeside => Side::RightBeside,
        Side::LeftAt => Side::RightAt,
        Side::RightAt => Side::LeftAt,
        Side::RightBeside => Side::LeftBeside,
        side => side,
    }
}

/// Heights in the space before the signer, for trunk locations without contact.
fn height(at: BodyLocation) -> Option<&'static str> {
    match at {
        BodyLocation::Shoulders => Some("high"),
        BodyLocation::Chest | BodyLocation::NeutralSpace => Some(""),
        BodyLocation::Stomach | BodyLocation::BelowStomach => Some("low"),
        _ => None,
    }
}

fn space(height: &str, side: Option<Lateral>, contact: Option<Contact>) -> String {
    let side = match side {
        Some(side) if side.left => "left",
        Some(_) => "right",
        None => "",
    };
    let distance = match contact {
        Some(Contact::Close) => "near",
        Some(Contact::ArmExtended) => "far",
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

fn on_body(
    at: BodyLocation,
    side: Option<Lateral>,
    behind: bool,
    miss: &mut impl FnMut(&str),
) -> String {
    use BodyLocation as B;
    let own = side.is_some_and(|side| side.own);
    let other = side.is_some_and(|side| !side.own);
    let beside = side.is_some_and(|side| side.beside);
    let mut has_side = true;
    let word = match at {
        B::Head if behind => "head-back",
        B::Head if beside => "beside-head",
        B::HeadTop => "head-top",
        B::Forehead if side.is_some() => "temple",
        B::Cheek if other => "cheek-contra",
        B::Lips if side.is_some() => "mouth-corner",
        B::Neck if side.is_some() => "neck-side",
        B::Shoulders if other => "shoulder-contra",
        B::Shoulders => "shoulder",
        B::ShoulderTop => "shoulder-top",
        B::Chest if own => "chest-ipsi",
        B::Chest if other => "chest-contra",
        B::Ear => "ear",
        B::EarLobe => "earlobe",
        B::Cheek => "cheek",
        B::Eyebrows => "eyebrow",
        B::Eyes => "eye",
        B::Nostrils => "nostril",
        at => {
            has_side = false;
            plain(at, miss)
        }
    };
    if behind && word != "head-back" {
        miss("behind it");
    }
    let names_side = matches!(word, "cheek-contra" | "shoulder-contra" | "chest-contra");
    if side.is_some() && (!has_side || (other && !names_side)) {
        miss("which side of it");
    }
    word.to_owned()
}

fn plain(at: BodyLocation, miss: &mut impl FnMut(&str)) -> &'static str {
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
fn hand(site: &HandSite, lost: &mut Lost) -> Value {
    use HandLocation as H;
    let palmar = site.side == Some(Side::Palmar);
    let thumb = site.digits.contains(Digit::Thumb);
    let (word, exact) = match site.at {
        Some(H::Palm) => ("palm", true),
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
        lost.add("placement: which part of the fingers or hand");
    }
    let exact = exact && site.second.is_none() && !site.approx;
    let word = word.to_owned();
    Value { word, exact }
}
