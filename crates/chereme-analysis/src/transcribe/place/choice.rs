//! The places that are told apart, alone and half-way between two.

use chereme_sign::hamnosys::sites::Region;
use chereme_sign::hamnosys::{BodyLocation, Contact, Side, Site};
use glam::DVec3;

/// Places that are told apart; those within them (teeth, eyelids) are said where one is surer.
const PLACES: [BodyLocation; 24] = [
    BodyLocation::Chest,
    BodyLocation::Shoulders,
    BodyLocation::Stomach,
    BodyLocation::BelowStomach,
    BodyLocation::Neck,
    BodyLocation::ShoulderTop,
    BodyLocation::Head,
    BodyLocation::HeadTop,
    BodyLocation::Forehead,
    BodyLocation::Eyebrows,
    BodyLocation::Eyes,
    BodyLocation::Nose,
    BodyLocation::Nostrils,
    BodyLocation::UpperLip,
    BodyLocation::Lips,
    BodyLocation::LowerLip,
    BodyLocation::Chin,
    BodyLocation::UnderChin,
    BodyLocation::Cheek,
    BodyLocation::Ear,
    BodyLocation::EarLobe,
    BodyLocation::UpperArm,
    BodyLocation::Elbow,
    BodyLocation::LowerArm,
];
const SIDES: [Option<Side>; 5] = [
    None,
    Some(Side::RightAt),
    Some(Side::LeftAt),
    Some(Side::RightBeside),
    Some(Side::LeftBeside),
];

/// How much less likely it is, in nepers, that half-way between two places is meant than one of them, and that
/// they differ in height and side; a place that is rarely meant; half-way to the shoulder's top without touching
/// it; the other side, and beside the body; the more, the farther two places are from each other; one at the trunk
/// and one at the head.
const BETWEEN: f64 = 1.2;
const OBLIQUE: f64 = 1.0;
const RARE: f64 = 2.0;
pub(super) const TOP: f64 = 1.0;
const ACROSS: f64 = 1.0;
const BESIDE: f64 = 1.5;
const WIDE: f64 = 0.6;
const REGIONS: f64 = 2.0;
/// Half-way between places that another one lies between costs this besides: that one would be said.
const SKIPS: f64 = 2.0;
/// Half-way between two that are farther from each other, or to either side, costs this besides.
const DISTANT: f64 = 1.5;
/// What lies nearer to the middle of two places than this share of the way to either lies between.
const BETWEEN_THEM: f64 = 0.6;
/// Half-way between two places may be meant that are nearer to each other than this, in metres.
const APART: f64 = 0.2;
/// As above, of one place and beside it.
const ASIDE: f64 = 0.35;
/// As above, where one is at the neck and the other at the head.
const ABOVE: f64 = 0.3;

/// A place on the body: where it is, and where a hand is that is before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) site: Site<BodyLocation>,
    /// On the body; and its way out.
    pub(super) at: DVec3,
    pub(super) out: DVec3,
    pub(super) region: Region,
    /// To the left of the middle, in shoulder widths.
    pub(super) lateral: f64,
    pub(super) beside: bool,
}

/// A place that may be meant: one, or half-way between two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choice {
    pub(super) spot: Spot,
    pub(super) second: Option<Site<BodyLocation>>,
    /// How much less likely it is to be meant than another one, in nepers.
    pub(super) cost: f64,
    pub(super) top: bool,
    /// Whether it is meant from near only.
    near: bool,
    /// Whether the two are farther from each other than such as are mostly said.
    pub(super) far: bool,
}

/// Returns every place that is told apart; `spot` tells where one is.
pub(super) fn all(spot: impl Fn(&Site<BodyLocation>) -> Option<Spot>) -> Vec<Choice> {
    let spots = spots(spot);
    let mut all = Vec::new();
    let plain: Vec<&Spot> = spots
        .iter()
        .filter(|spot| !is_rare(spot) && !is_top(spot))
        .collect();
    for (k, first) in spots.iter().enumerate() {
        all.push(choice(first, None));
        for second in &spots[k + 1..] {
            let far = !neighbours(first, second);
            if far && !distant(first, second) {
                continue;
            }
            let more = if !(is_top(first) && is_top(second)) && skips(first, second, &plain) {
                SKIPS
            } else {
                0.0
            };
            let more = more + if far { DISTANT } else { 0.0 };
            let mut add = |a: &Spot, b: &Spot| {
                let mut both = choice(a, Some(b));
                both.cost += more;
                both.far = far;
                all.push(both);
            };
            add(first, second);
            // From where it is counted tells how far before it a hand is.
            if first.region != second.region {
                add(second, first);
            }
        }
    }
    all
}

fn spots(spot: impl Fn(&Site<BodyLocation>) -> Option<Spot>) -> Vec<Spot> {
    let mut spots: Vec<Spot> = Vec::new();
    for at in PLACES {
        for side in SIDES {
            let approx = false;
            let Some(spot) = spot(&Site { at, side, approx }) else {
                continue;
            };
            let same = |old: &Spot| {
                old.at.distance(spot.at) < 1e-3
                    && old.lateral == spot.lateral
                    && old.region == spot.region
                    && old.out.distance(spot.out) < 1e-3
            };
            if !spots.iter().any(same) {
                spots.push(spot);
            }
        }
    }
    spots
}

/// Whether a place half-way between two can be meant: of one region, or of the neck and the head.
fn neighbours(a: &Spot, b: &Spot) -> bool {
    let apart = a.at.distance(b.at);
    let opposite = a.lateral * b.lateral < 0.0;
    let arms = matches!(a.region, Region::Arm(_)) || matches!(b.region, Region::Arm(_));
    let high = |spot: &Spot| {
        spot.region == Region::Face
            || matches!(spot.site.at, BodyLocation::Neck | BodyLocation::ShoulderTop)
    };
    let most = match a.region == b.region {
        true if a.site.at == b.site.at => ASIDE,
        true => APART,
        false if high(a) && high(b) => ABOVE,
        false => 0.0,
    };
    apart > 1e-3 && apart < most && !opposite && !arms
}

/// Whether a place half-way between two that are farther from each other may be meant: of one region, also to
/// either side of the middle.
fn distant(a: &Spot, b: &Spot) -> bool {
    let apart = a.at.distance(b.at);
    let arms = matches!(a.region, Region::Arm(_));
    apart > 1e-3 && apart < ASIDE && a.region == b.region && !arms
}

/// Whether a plain place lies between two.
fn skips(a: &Spot, b: &Spot, plain: &[&Spot]) -> bool {
    let middle = a.at.midpoint(b.at);
    let reach = BETWEEN_THEM * a.at.distance(middle);
    let others = plain
        .iter()
        .filter(|it| it.site != a.site && it.site != b.site);
    let mut near = others.filter(|it| it.at.distance(middle) < reach);
    near.next().is_some()
}

/// Whether a place is one that hands touch: they are hardly half-way before it.
fn is_top(spot: &Spot) -> bool {
    spot.site.at == BodyLocation::ShoulderTop
}

/// Whether a place is rarely meant: those beside it say as much.
fn is_rare(spot: &Spot) -> bool {
    matches!(
        spot.site.at,
        BodyLocation::Nostrils
            | BodyLocation::UpperLip
            | BodyLocation::LowerLip
            | BodyLocation::EarLobe
            | BodyLocation::Eyebrows
    )
}

/// Takes a place, or half-way to a second one.
fn choice(first: &Spot, second: Option<&Spot>) -> Choice {
    let both = || [Some(first), second].into_iter().flatten();
    let sum = |cost: fn(&Spot) -> f64| both().map(cost).fold(0.0, f64::max);
    let wide = second.map_or(0.0, |second| first.at.distance(second.at) / APART);
    let across = second.is_some_and(|second| second.region != first.region);
    Choice {
        spot: second.map_or(*first, |second| middle(first, second)),
        second: second.map(|second| second.site),
        cost: sum(said)
            + second.map_or(0.0, |second| {
                let level = second.site.at != first.site.at;
                let side = second.site.side != first.site.side;
                BETWEEN + if level && side { OBLIQUE } else { 0.0 }
            })
            + WIDE * wide
            + if across { REGIONS } else { 0.0 },
        top: both().any(is_top) && !both().all(is_top),
        near: both().any(|spot| is_rare(spot) || spot.site.at == BodyLocation::UnderChin),
        far: false,
    }
}

/// Returns how much less likely a place is meant than the plainest.
fn said(spot: &Spot) -> f64 {
    let side = match spot.site.side {
        Some(Side::LeftAt) => ACROSS,
        Some(Side::RightBeside) => BESIDE,
        Some(Side::LeftBeside) => ACROSS + BESIDE,
        _ => 0.0,
    };
    side + if is_rare(spot) { RARE } else { 0.0 }
}

/// How near a hand may be to a place.
pub(super) fn contacts(choice: &Choice) -> &'static [Option<Contact>] {
    const ALL: [Option<Contact>; 4] = [
        Some(Contact::Close),
        None,
        Some(Contact::ArmExtended),
        Some(Contact::Touch),
    ];
    match choice.spot.region {
        Region::Arm(_) => &[Some(Contact::Close), Some(Contact::Touch)],
        // Small places of the head are not meant from afar, and below the chin is the chest.
        _ if choice.near => &[Some(Contact::Close), Some(Contact::Touch)],
        _ if choice.spot.beside && choice.spot.region == Region::Trunk => &ALL[..3],
        _ => &ALL,
    }
}

pub(super) fn middle(a: &Spot, b: &Spot) -> Spot {
    Spot {
        at: (a.at + b.at) / 2.0,
        out: (a.out + b.out).normalize_or(a.out),
        lateral: (a.lateral + b.lateral) / 2.0,
        beside: a.beside && b.beside,
        ..*a
    }
}
