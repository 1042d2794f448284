//! Candidate places: single ones, and those half-way between two.

use chereme_sign::hamnosys::sites::{BodyRegion, region_for};
use chereme_sign::hamnosys::{BodyLocation, LocationSide, PlaceContact, SidedLocation};
use glam::DVec3;

use crate::transcribe::transcribe_tuned::tuned;

/// The places that a hand's position can distinguish; finer ones (teeth, eyelids) are beyond the
/// measurement.
const DISTINGUISHABLE_PLACES: [BodyLocation; 24] = [
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
const PLACE_SIDES: [Option<LocationSide>; 5] = [
    None,
    Some(LocationSide::RightAt),
    Some(LocationSide::LeftAt),
    Some(LocationSide::RightBeside),
    Some(LocationSide::LeftBeside),
];

/// A place on the body, with the normal along which a hand is put before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodySpot {
    pub(super) site: SidedLocation<BodyLocation>,
    /// The point on the body, in metres (left, up, forward).
    pub(super) at: DVec3,
    /// The outward unit normal there.
    pub(super) out: DVec3,
    pub(super) region: BodyRegion,
    /// Distance to the left of the middle, in shoulder widths.
    pub(super) lateral: f64,
    pub(super) beside: bool,
    /// Whether it is a height of the space before the body, unless a hand touches it.
    pub(super) level: bool,
}

impl BodySpot {
    /// Returns the part of the body that determines the distance of a hand with a contact.
    pub(super) fn region_for(&self, contact: Option<PlaceContact>) -> BodyRegion {
        region_for(self.region, self.level, contact)
    }

    /// Returns the same for a hand that touches nothing.
    fn free_spot_region(&self) -> BodyRegion {
        self.region_for(None)
    }
}

/// A candidate place: a single one, or half-way between two.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaceChoice {
    pub(super) spot: BodySpot,
    pub(super) second: Option<SidedLocation<BodyLocation>>,
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
pub(super) fn all_place_choices(spot: impl Fn(&SidedLocation<BodyLocation>) -> Option<BodySpot>) -> Vec<PlaceChoice> {
    let spots = spots(spot);
    let mut all = Vec::new();
    let plain: Vec<&BodySpot> = spots.iter().filter(|spot| !is_rare(spot) && !is_top(spot)).collect();
    for (k, first) in spots.iter().enumerate() {
        all.push(build_place_choice(first, None));
        for second in &spots[k + 1..] {
            let far = !is_neighbouring_spot(first, second);
            if far && !distant(first, second) {
                continue;
            }
            let skip_penalty = if !(is_top(first) && is_top(second)) && skips(first, second, &plain) {
                tuned().choice.skips
            } else {
                0.0
            };
            let more = skip_penalty + if far { tuned().choice.distant } else { 0.0 };
            let mut add = |a: &BodySpot, b: &BodySpot| {
                let mut both = build_place_choice(a, Some(b));
                both.cost += more;
                both.far = far;
                all.push(both);
            };
            add(first, second);
            // The first of the two regions determines the usual distance of the hand.
            if first.free_spot_region() != second.free_spot_region() {
                add(second, first);
            }
        }
    }
    all
}

fn spots(spot: impl Fn(&SidedLocation<BodyLocation>) -> Option<BodySpot>) -> Vec<BodySpot> {
    let mut spots: Vec<BodySpot> = Vec::new();
    for at in DISTINGUISHABLE_PLACES {
        for side in PLACE_SIDES {
            let approx = false;
            let Some(spot) = spot(&SidedLocation { at, side, approx }) else {
                continue;
            };
            // A place without sides is one point, whatever side is asked for.
            let same = |old: &BodySpot| {
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
fn is_neighbouring_spot(a: &BodySpot, b: &BodySpot) -> bool {
    let apart = a.at.distance(b.at);
    let opposite = a.lateral * b.lateral < 0.0;
    let arms = matches!(a.region, BodyRegion::Arm(_)) || matches!(b.region, BodyRegion::Arm(_));
    let high = |spot: &BodySpot| {
        spot.region == BodyRegion::Face || matches!(spot.site.at, BodyLocation::Neck | BodyLocation::ShoulderTop)
    };
    let most = match a.free_spot_region() == b.free_spot_region() {
        true if a.site.at == b.site.at => tuned().choice.aside,
        true => tuned().choice.apart,
        false if high(a) && high(b) => tuned().choice.above,
        false => 0.0,
    };
    apart > 1e-3 && apart < most && !opposite && !arms
}

/// Returns whether two distant places may be joined: both in one region, even on opposite sides of the
/// middle.
fn distant(a: &BodySpot, b: &BodySpot) -> bool {
    let apart = a.at.distance(b.at);
    let arms = matches!(a.region, BodyRegion::Arm(_));
    apart > 1e-3 && apart < tuned().choice.aside && a.free_spot_region() == b.free_spot_region() && !arms
}

/// Returns whether a common place lies between two.
fn skips(a: &BodySpot, b: &BodySpot, plain: &[&BodySpot]) -> bool {
    let middle = a.at.midpoint(b.at);
    let reach = tuned().choice.between_them * a.at.distance(middle);
    let others = plain.iter().filter(|spot| spot.site != a.site && spot.site != b.site);
    let mut near = others.filter(|spot| spot.at.distance(middle) < reach);
    near.next().is_some()
}

/// Returns whether a place is the top of the shoulder, which hands touch: they are hardly half-way to it
/// without contact.
fn is_top(spot: &BodySpot) -> bool {
    spot.site.at == BodyLocation::ShoulderTop
}

/// Returns whether annotators rarely write a place, because its neighbours have nearly the same meaning.
fn is_rare(spot: &BodySpot) -> bool {
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
fn build_place_choice(first: &BodySpot, second: Option<&BodySpot>) -> PlaceChoice {
    let both = || [Some(first), second].into_iter().flatten();
    let dearer = both().map(side_place_penalty).fold(0.0, f64::max);
    let mean = both().map(place_frequency_penalty).sum::<f64>() / both().count() as f64;
    let wide = second.map_or(0.0, |second| first.at.distance(second.at) / tuned().choice.apart);
    let across = second.is_some_and(|second| second.free_spot_region() != first.free_spot_region());
    PlaceChoice {
        spot: second.map_or(*first, |second| middle_spot(first, second)),
        second: second.map(|second| second.site),
        cost: dearer
            + mean
            + second.map_or(0.0, |second| {
                let level = second.site.at != first.site.at;
                let side = second.site.side != first.site.side;
                tuned().choice.between + if level && side { tuned().choice.oblique } else { 0.0 }
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
fn side_place_penalty(spot: &BodySpot) -> f64 {
    match spot.site.side {
        Some(LocationSide::LeftAt) => tuned().choice.across,
        Some(LocationSide::RightBeside) => tuned().choice.beside,
        Some(LocationSide::LeftBeside) => tuned().choice.across + tuned().choice.beside,
        _ => 0.0,
    }
}

/// Returns the penalty (nepers) of a place by how often annotators write it.
fn place_frequency_penalty(spot: &BodySpot) -> f64 {
    let usual_penalties = DISTINGUISHABLE_PLACES.iter().zip(tuned().choice.usual);
    let mut matching_penalties = usual_penalties.filter(|(at, _)| **at == spot.site.at);
    matching_penalties.next().map_or(0.0, |(_, penalty)| penalty)
}

/// Returns the distances at which a hand may be before a place.
pub(super) fn possible_place_contacts(choice: &PlaceChoice) -> &'static [Option<PlaceContact>] {
    const ALL_PLACE_CONTACTS: [Option<PlaceContact>; 4] = [
        Some(PlaceContact::Close),
        None,
        Some(PlaceContact::ArmExtended),
        Some(PlaceContact::Touch),
    ];
    match choice.spot.region {
        BodyRegion::Arm(_) => &[Some(PlaceContact::Close), Some(PlaceContact::Touch)],
        // Small places of the head are not referred to from a distance, and the chest lies in front of the
        // space below the chin.
        _ if choice.near => &[Some(PlaceContact::Close), Some(PlaceContact::Touch)],
        _ if choice.spot.beside && choice.spot.region == BodyRegion::Trunk => &ALL_PLACE_CONTACTS[..3],
        _ => &ALL_PLACE_CONTACTS,
    }
}

pub(super) fn middle_spot(a: &BodySpot, b: &BodySpot) -> BodySpot {
    BodySpot {
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
    fn candidates(body: &[(BodyLocation, f64)]) -> Vec<PlaceChoice> {
        all_place_choices(|site| {
            let known = body.iter().find(|(at, _)| *at == site.at)?;
            site.side.is_none().then_some(BodySpot {
                site: *site,
                at: DVec3::Y * known.1,
                out: DVec3::Z,
                region: BodyRegion::Trunk,
                lateral: 0.0,
                beside: false,
                level: false,
            })
        })
    }

    /// Returns the penalty of the place half-way between two.
    fn between(choices: &[PlaceChoice], first: BodyLocation, second: BodyLocation) -> Option<f64> {
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
        assert_eq!(cost(&[(ShoulderTop, step)]), free, "nor does the top of the shoulder");
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
            assert_eq!(choice.cost, place_frequency_penalty(&choice.spot));
            assert_eq!(choice.near, rare);
        }
        let joined: Vec<_> = found.iter().filter(|it| it.second.is_some()).collect();
        assert_eq!(joined.len(), 1, "places that are too far apart have no middle");
        assert!(joined[0].spot.at.distance(DVec3::Y * step / 2.0) < 1e-12);
        let mean = place_frequency_penalty(&single[0].spot).midpoint(place_frequency_penalty(&single[1].spot));
        let cost = mean + tuned().choice.between + tuned().choice.wide * 0.4;
        assert!((joined[0].cost - cost).abs() < 1e-12, "{}", joined[0].cost);
    }
}
