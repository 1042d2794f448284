//! Candidate places: single ones, and those half-way between two.

use chereme_sign::hamnosys::sites::{Region, region_for};
use chereme_sign::hamnosys::{BodyLocation, Contact, Side, Site};
use glam::DVec3;

use crate::transcribe::tuned::tuned;

/// The places that a hand's position can distinguish; finer ones (teeth, eyelids) are beyond the
/// measurement.
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

/// A place on the body, with the normal along which a hand is put before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) site: Site<BodyLocation>,
    /// The point on the body, in metres (left, up, forward).
    pub(super) at: DVec3,
    /// The outward unit normal there.
    pub(super) out: DVec3,
    pub(super) region: Region,
    /// Distance to the left of the middle, in shoulder widths.
    pub(super) lateral: f64,
    pub(super) beside: bool,
    /// Whether it is a height of the space before the body, unless a hand touches it.
    pub(super) level: bool,
}

impl Spot {
    /// Returns the part of the body that determines the distance of a hand with a contact.
    pub(super) fn region_for(&self, contact: Option<Contact>) -> Region {
        region_for((self.region, self.level), contact)
    }

    /// Returns the same for a hand that touches nothing.
    fn free(&self) -> Region {
        self.region_for(None)
    }
}

/// A candidate place: a single one, or half-way between two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choice {
    pub(super) spot: Spot,
    pub(super) second: Option<Site<BodyLocation>>,
    /// Its penalty in nepers.
    pub(super) cost: f64,
    /// Whether one of the two places, but not the other, is the top of the shoulder.
    pub(super) half_top: bool,
    /// Whether it is the top of the shoulder.
    pub(super) top: bool,
    /// Whether only hands close to it can refer to it.
    near: bool,
    /// Whether the two places are farther apart than those that notation usually joins.
    pub(super) far: bool,
}

/// Returns every candidate place; `spot` returns the position of a single one.
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
                tuned().choice.skips
            } else {
                0.0
            };
            let more = more + if far { tuned().choice.distant } else { 0.0 };
            let mut add = |a: &Spot, b: &Spot| {
                let mut both = choice(a, Some(b));
                both.cost += more;
                both.far = far;
                all.push(both);
            };
            add(first, second);
            // The first of the two regions determines the usual distance of the hand.
            if first.free() != second.free() {
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

/// Returns whether the places half-way between two are usual: both in one region, or at the neck and the
/// head.
fn neighbours(a: &Spot, b: &Spot) -> bool {
    let apart = a.at.distance(b.at);
    let opposite = a.lateral * b.lateral < 0.0;
    let arms = matches!(a.region, Region::Arm(_)) || matches!(b.region, Region::Arm(_));
    let high = |spot: &Spot| {
        spot.region == Region::Face
            || matches!(spot.site.at, BodyLocation::Neck | BodyLocation::ShoulderTop)
    };
    let most = match a.free() == b.free() {
        true if a.site.at == b.site.at => tuned().choice.aside,
        true => tuned().choice.apart,
        false if high(a) && high(b) => tuned().choice.above,
        false => 0.0,
    };
    apart > 1e-3 && apart < most && !opposite && !arms
}

/// Returns whether two distant places may be joined: both in one region, even on opposite sides of the
/// middle.
fn distant(a: &Spot, b: &Spot) -> bool {
    let apart = a.at.distance(b.at);
    let arms = matches!(a.region, Region::Arm(_));
    apart > 1e-3 && apart < tuned().choice.aside && a.free() == b.free() && !arms
}

/// Returns whether a common place lies between two.
fn skips(a: &Spot, b: &Spot, plain: &[&Spot]) -> bool {
    let middle = a.at.midpoint(b.at);
    let reach = tuned().choice.between_them * a.at.distance(middle);
    let others = plain
        .iter()
        .filter(|it| it.site != a.site && it.site != b.site);
    let mut near = others.filter(|it| it.at.distance(middle) < reach);
    near.next().is_some()
}

/// Returns whether a place is the top of the shoulder, which hands touch: they are hardly half-way to it
/// without contact.
fn is_top(spot: &Spot) -> bool {
    spot.site.at == BodyLocation::ShoulderTop
}

/// Returns whether annotators rarely write a place, because its neighbours have nearly the same meaning.
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

/// Builds the candidate for a place, or for the point half-way to a second one.
fn choice(first: &Spot, second: Option<&Spot>) -> Choice {
    let both = || [Some(first), second].into_iter().flatten();
    let dearer = both().map(aside).fold(0.0, f64::max);
    let mean = both().map(usual).sum::<f64>() / both().count() as f64;
    let wide = second.map_or(0.0, |second| {
        first.at.distance(second.at) / tuned().choice.apart
    });
    let across = second.is_some_and(|second| second.free() != first.free());
    Choice {
        spot: second.map_or(*first, |second| middle(first, second)),
        second: second.map(|second| second.site),
        cost: dearer
            + mean
            + second.map_or(0.0, |second| {
                let level = second.site.at != first.site.at;
                let side = second.site.side != first.site.side;
                tuned().choice.between
                    + if level && side {
                        tuned().choice.oblique
                    } else {
                        0.0
                    }
            })
            + tuned().choice.wide * wide
            + if across { tuned().choice.regions } else { 0.0 },
        half_top: both().any(is_top) && !both().all(is_top),
        top: both().all(is_top),
        near: both().any(|spot| is_rare(spot) || spot.site.at == BodyLocation::UnderChin),
        far: false,
    }
}

/// Returns the penalty (nepers) of the side of a place.
fn aside(spot: &Spot) -> f64 {
    match spot.site.side {
        Some(Side::LeftAt) => tuned().choice.across,
        Some(Side::RightBeside) => tuned().choice.beside,
        Some(Side::LeftBeside) => tuned().choice.across + tuned().choice.beside,
        _ => 0.0,
    }
}

/// Returns the penalty (nepers) of a place by how often annotators write it.
fn usual(spot: &Spot) -> f64 {
    let known = PLACES.iter().zip(tuned().choice.usual);
    let mut known = known.filter(|(at, _)| **at == spot.site.at);
    known.next().map_or(0.0, |(_, penalty)| penalty)
}

/// Returns the distances at which a hand may be before a place.
pub(super) fn contacts(choice: &Choice) -> &'static [Option<Contact>] {
    const ALL: [Option<Contact>; 4] = [
        Some(Contact::Close),
        None,
        Some(Contact::ArmExtended),
        Some(Contact::Touch),
    ];
    match choice.spot.region {
        Region::Arm(_) => &[Some(Contact::Close), Some(Contact::Touch)],
        // Small places of the head are not referred to from a distance, and the chest lies in front of the
        // space below the chin.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the candidates of a body that has only these places, along a line up the trunk.
    fn candidates(body: &[(BodyLocation, f64)]) -> Vec<Choice> {
        all(|site| {
            let known = body.iter().find(|(at, _)| *at == site.at)?;
            site.side.is_none().then_some(Spot {
                site: *site,
                at: DVec3::Y * known.1,
                out: DVec3::Z,
                region: Region::Trunk,
                lateral: 0.0,
                beside: false,
                level: false,
            })
        })
    }

    /// Returns the penalty of the place half-way between two.
    fn between(choices: &[Choice], first: BodyLocation, second: BodyLocation) -> Option<f64> {
        let mut both = choices.iter().filter(|choice| {
            let own = (choice.spot.site.at, choice.second.map(|site| site.at));
            own == (first, Some(second))
        });
        both.next().map(|choice| choice.cost)
    }

    #[test]
    fn the_middle_of_two_places_costs_more_if_a_common_place_lies_there() {
        use BodyLocation::{Chest, EarLobe, ShoulderTop, Stomach};
        let step = 0.4 * tuned().choice.apart;
        let ends = [(Chest, 2.0 * step), (Stomach, 0.0)];
        let cost = |more: &[(BodyLocation, f64)]| {
            let body = [&ends, more].concat();
            between(&candidates(&body), Chest, Stomach).expect("a candidate")
        };
        let free = cost(&[]);
        let skipped = cost(&[(BodyLocation::Neck, step)]);
        assert!(
            (skipped - free - tuned().choice.skips).abs() < 1e-12,
            "{skipped} {free}"
        );
        assert_eq!(cost(&[(EarLobe, step)]), free, "rare places do not count");
        assert_eq!(
            cost(&[(ShoulderTop, step)]),
            free,
            "nor does the top of the shoulder"
        );
        let far = [(BodyLocation::Neck, 5.0 * step)];
        assert_eq!(cost(&far), free, "nor does a place beyond them");
    }

    #[test]
    fn each_place_is_a_candidate_and_lies_where_it_is() {
        use BodyLocation::{Chest, EarLobe, Stomach};
        let step = 0.4 * tuned().choice.apart;
        let found = candidates(&[(Chest, step), (Stomach, 0.0), (EarLobe, 9.0 * step)]);
        let single: Vec<_> = found.iter().filter(|it| it.second.is_none()).collect();
        assert_eq!(single.len(), 3);
        for choice in &single {
            let rare = choice.spot.site.at == EarLobe;
            assert_eq!(choice.cost, usual(&choice.spot));
            assert_eq!(choice.near, rare);
        }
        let joined: Vec<_> = found.iter().filter(|it| it.second.is_some()).collect();
        assert_eq!(
            joined.len(),
            1,
            "places that are too far apart have no middle"
        );
        assert!(joined[0].spot.at.distance(DVec3::Y * step / 2.0) < 1e-12);
        let mean = usual(&single[0].spot).midpoint(usual(&single[1].spot));
        let cost = mean + tuned().choice.between + tuned().choice.wide * 0.4;
        assert!((joined[0].cost - cost).abs() < 1e-12, "{}", joined[0].cost);
    }
}
