//! Constellations: places of the two hands relative to each other.
//!
//! A constellation names a part of each hand, such as the index fingertip and the palm, and says whether they
//! touch. The candidates are pairs of near parts, and the pairs that notation implies if it names no parts.

use chereme_sign::hamnosys::sites::{BodyRegion, NotatedHandPoint};
use chereme_sign::hamnosys::{BodyLocation, BodyPlace, PlaceContact, SidedLocation};
use glam::DVec3;

use super::place_hand::{HandSpot, PosedHand, hand_point_rank};
use super::spread::FreeHandKind;
use super::{LikelyHandPlace, PosedBody};
use crate::transcribe::transcribe_tuned::tuned;

/// The place of hands whose notation names no place.
const NEUTRAL_SPACE_SITE: SidedLocation<BodyLocation> = SidedLocation {
    at: BodyLocation::NeutralSpace,
    side: None,
    approx: false,
};

/// A constellation: one part of each hand, with their contact.
#[derive(Debug, Clone)]
pub(in crate::transcribe) struct HandsTogether {
    /// The part of the dominant hand, then that of the other.
    pub(in crate::transcribe) parts: [NotatedHandPoint; 2],
    pub(in crate::transcribe) distance: f64,
    /// The positions of the parts.
    pub(in crate::transcribe) at: [DVec3; 2],
    pub(in crate::transcribe) contact: PlaceContact,
    /// The offset from the second part to the first one, less the offset that the contact implies, in metres.
    pub(in crate::transcribe) aside: DVec3,
    /// The penalty (nepers) of that distance.
    pub(in crate::transcribe) unlikely: f64,
    /// Whether the parts differ from the implied ones, so that the notation must name them.
    stated: bool,
    /// Whether the notation names them.
    pub(in crate::transcribe) named: bool,
}

impl HandsTogether {
    /// Returns the penalty (nepers) of the notation itself.
    pub(in crate::transcribe) fn together_notation_penalty(&self) -> f64 {
        match (self.named, self.stated) {
            (false, _) => tuned().together.unnamed[usize::from(self.contact != PlaceContact::Touch)],
            (true, true) => tuned().together.parts + tuned().together.step * ranks(self),
            (true, false) => 0.0,
        }
    }
}

impl PosedBody<'_> {
    /// Returns the constellation of the parts nearest to each other, with its contact and distance in
    /// metres; `None` if the hands are apart.
    pub(in crate::transcribe) fn nearest_hands_together(&self) -> Option<HandsTogether> {
        // Annotators name whole faces of the hand rather than points within them.
        let near = |pair: &HandsTogether| pair.distance + tuned().part.rank * self.scene.slack * ranks(pair);
        self.nearest_part_pairs(1, tuned().together.together, near)
            .into_iter()
            .next()
    }

    /// Returns at most `most` pairs of parts of the two hands within `reach` arm lengths, those with the lowest `penalty`
    /// first.
    fn nearest_part_pairs(
        &self,
        most: usize,
        reach: f64,
        penalty: impl Fn(&HandsTogether) -> f64,
    ) -> Vec<HandsTogether> {
        let [Some(dominant), Some(other)] = &self.hands else {
            return Vec::new();
        };
        let reach = reach * self.scene.arm;
        let mut all: Vec<(f64, HandsTogether)> = Vec::new();
        for own in &dominant.points {
            for other in &other.points {
                if own.at.distance(other.at) < reach {
                    let together = self.by_each_other([own, other]);
                    all.push((penalty(&together), together));
                }
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.truncate(most);
        all.into_iter().map(|(_, together)| together).collect()
    }

    /// Returns the parts of hand `n` that may be next to the other hand, each with its penalty (nepers)
    /// relative to the likeliest; those with a penalty of `most` or more are left out.
    pub(super) fn other_pairs(&self, n: usize, most: f64) -> Vec<(NotatedHandPoint, f64)> {
        let unlikely = |pair: &HandsTogether| pair.unlikely + tuned().together.step * ranks(pair);
        let all = self.nearest_part_pairs(4 * tuned().together.pairs, tuned().together.together, unlikely);
        let best = all.first().map_or(0.0, unlikely);
        let others = all.iter().map(|pair| (pair.parts[n], unlikely(pair) - best));
        others.filter(|(_, less)| *less < most).collect()
    }

    /// Returns the constellation of two parts with the likelier contact: touching, or close.
    fn by_each_other(&self, [own, other]: [&HandSpot; 2]) -> HandsTogether {
        let apart = own.at - other.at;
        let distance = apart.length();
        let arm = self.scene.arm;
        let near = self.scene.language.hands_near * arm;
        // Mirrored hands are next to each other; otherwise the gap lies along the outward normals.
        let facing = (other.out - own.out).normalize_or(DVec3::NEG_X);
        let offsets = [DVec3::NEG_X, facing].map(|direction| apart - direction * near);
        let [aside, out] = offsets.map(|off| self.spread.joined_hands_penalty(off));
        let (close, off) = if aside < out {
            (aside, offsets[0])
        } else {
            (out, offsets[1])
        };
        let touch = self.spread.joined_hands_penalty(apart);
        let touching = distance < tuned().place.touch[2] * arm && touch < close;
        HandsTogether {
            parts: [own.point, other.point],
            at: [own.at, other.at],
            distance,
            contact: if touching {
                PlaceContact::Touch
            } else {
                PlaceContact::Close
            },
            aside: if touching { apart } else { off },
            unlikely: if touching { touch } else { close },
            stated: true,
            named: true,
        }
    }

    /// Returns the pairs of parts that notation implies if it names no parts: the facing parts of mirrored
    /// hands, and those of one hand upon the other, if they are within `reach` arm lengths.
    fn meant_pairs(&self, reach: f64) -> Vec<HandsTogether> {
        let [Some(dominant), Some(other)] = &self.hands else {
            return Vec::new();
        };
        let dominant_spot = dominant.meant_hand_spot(DVec3::NEG_X, BodyRegion::Trunk);
        let mirrored = [dominant_spot, other.meant_hand_spot(DVec3::X, BodyRegion::Trunk)];
        // The dominant hand is above the other one, to its right and a little in front of it.
        let direction = DVec3::new(-0.6, 1.0, 0.3).normalize();
        let below = other.meant_hand_spot(-direction, BodyRegion::Trunk);
        let region = BodyRegion::Arm(self.scene.dominant.opposite_side());
        let upon = [dominant.meant_hand_spot(below.out, region), below];
        let reach = reach * self.scene.arm;
        [mirrored, upon]
            .iter()
            .map(|[own, other]| HandsTogether {
                stated: false,
                ..self.by_each_other([own, other])
            })
            .filter(|together| together.distance < reach)
            .collect()
    }

    /// Returns the likeliest constellation of the two hands with the place they share; `None` if separate
    /// places, whose penalty is `apart` (nepers), are likelier by more than `together.rather`.
    pub(in crate::transcribe) fn likeliest_constellation(
        &self,
        apart: f64,
    ) -> Option<(HandsTogether, LikelyHandPlace)> {
        let reach = tuned().together.together;
        let mut all = self.meant_pairs(reach);
        all.extend(self.nearest_part_pairs(tuned().together.pairs, reach, |pair| {
            pair.unlikely + tuned().together.step * ranks(pair)
        }));
        let nearest = self.nearest_hands_together();
        let touch = nearest.is_some_and(|pair| pair.distance < tuned().together.contact * self.scene.arm);
        let (score, together, placed) = all
            .into_iter()
            .filter_map(|together| {
                let mut placed = self.shared_point_place(together.at[0].midpoint(together.at[1]))?;
                let merely_close = match together.contact {
                    PlaceContact::Close if touch => tuned().together.touches,
                    _ => 0.0,
                };
                placed.residual = placed.residual.max(together.aside.length());
                Some((
                    placed.score + together.unlikely + together.together_notation_penalty() + merely_close,
                    together,
                    placed,
                ))
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let rather = tuned().together.rather[usize::from(together.contact != PlaceContact::Touch)];
        (score < rather + apart).then_some((together, placed))
    }

    /// Returns at most `most` candidate constellations of hands that the animator may have moved apart, the likeliest first;
    /// and always those that notation implies, also as constellations that the notation does not name.
    pub(in crate::transcribe) fn likeliest_pairs(&self, most: usize) -> Vec<HandsTogether> {
        let reach = tuned().together.reach;
        let penalty = |pair: &HandsTogether| pair.unlikely + tuned().together.step * ranks(pair);
        let unnamed = |pair: &HandsTogether| HandsTogether {
            named: false,
            ..pair.clone()
        };
        let named_pairs = self.meant_pairs(reach);
        let mut all = self.nearest_part_pairs(most, reach, penalty);
        all.extend(named_pairs.iter().map(unnamed));
        all.extend(named_pairs);
        all.sort_by(|a, b| {
            (a.together_notation_penalty() + a.unlikely).total_cmp(&(b.together_notation_penalty() + b.unlikely))
        });
        all
    }

    /// Returns the candidate places that the two hands share, at most `most` of them, the likeliest first.
    pub(in crate::transcribe) fn likeliest_shared(
        &self,
        together: &HandsTogether,
        most: usize,
    ) -> Vec<LikelyHandPlace> {
        let hand =
            PosedHand::spot_between_hands(together.at[0].midpoint(together.at[1]), self.dominant_palm_distance());
        let mut all = self.likeliest_of(0, &hand, false, most);
        all.extend(self.shared_point_place(hand.palm));
        for placed in &mut all {
            placed.place.by = None;
        }
        all
    }

    /// Returns the distance (m) of the dominant palm before its wrist: it decides how far the point that both hands
    /// share is from the body.
    fn dominant_palm_distance(&self) -> f64 {
        self.hands[0].as_ref().map_or(0.0, |hand| hand.ahead)
    }

    /// Returns the place nearest to a point that both hands share; empty in neutral space.
    fn shared_point_place(&self, at: DVec3) -> Option<LikelyHandPlace> {
        let ahead = self.dominant_palm_distance();
        let mut placed = self.find_given_hand_place(0, &PosedHand::spot_between_hands(at, ahead), false)?;
        placed.place.by = None;
        let neutral = self.body_spot_at(0, &NEUTRAL_SPACE_SITE)?;
        let off = at - self.hand_point_goal(&neutral, None, 0, ahead, false);
        let score = self.spread.free_hand_penalty(off, FreeHandKind::Between, false) + tuned().choice.neutral;
        if score > placed.score {
            return Some(placed);
        }
        Some(LikelyHandPlace {
            runner_up: Some((placed.place, placed.residual)),
            place: BodyPlace::default(),
            residual: off.length(),
            aside: off,
            score,
            ..placed
        })
    }
}

/// Returns the sum of the parts' ranks.
fn ranks(together: &HandsTogether) -> f64 {
    let [own, other] = together.parts;
    hand_point_rank(own) + hand_point_rank(other)
}
