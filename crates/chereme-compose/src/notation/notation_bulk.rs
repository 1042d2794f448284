//! The bulk of hands: keeps two hands from penetrating each other.

use chereme_motion::glam::{DQuat, DVec3};

use super::hands_apart::PartedMoment;
use super::notation_solve::ease_push_vectors;
use super::notation_stage::{FINGER_FLESH, HandOutline, StagedHand, StandingBody};
use super::notation_track::{HandGoalFrames, SolvedFrames};
use super::notation_tuned::tuned;
use super::outlines::OutlineTrack;

/// Half the thickness of a finger, of the thumb's root, and of a palm, in hand lengths.
const FLESH_RADII: [f64; 3] = [FINGER_FLESH, 0.055, 0.07];
/// Half the mean thickness of a forearm, in arm lengths: 3.7 cm at an arm of 55 cm.
const FOREARM_FLESH_RADIUS: f64 = 0.067;
/// Depth (m) of forearms in each other above which a warning is issued: flesh and sleeves give way by less.
const REPORTED_FOREARM_DEPTH_M: f64 = 0.02;
/// The number of rounds in which hands are moved apart.
const HANDS_APART_ROUNDS: usize = 4;
/// Displacement (m) of each hand above which it is reported.
pub(super) const REPORTED_HAND_SHIFT_M: f64 = 0.005;
/// Further depth (m) above which a warning is issued.
const REPORTED_HAND_DEPTH_M: f64 = 0.001;

/// The point of the outline at the knuckle of the middle finger.
const MIDDLE_KNUCKLE: usize = 8;

/// A bone with its flesh.
#[derive(Debug, Clone, Copy)]
struct FleshTube {
    ends: [DVec3; 2],
    /// The point half-way between its ends.
    middle: DVec3,
    /// Half the distance of its ends, in metres.
    half: f64,
    radius: f64,
}

impl FleshTube {
    fn tube_between_ends(ends: [DVec3; 2], radius: f64) -> Self {
        Self {
            ends,
            middle: (ends[0] + ends[1]) * 0.5,
            half: ends[0].distance(ends[1]) * 0.5,
            radius,
        }
    }
}

/// Moves the goals of two hands apart, each by half, wherever they would penetrate each other. While both hands touch
/// something, at the times in `contacts` (s), they move apart by so little that they still touch. Returns the largest
/// displacement, with its planned time, if it is large enough to report.
pub(crate) fn clear_overlapping_hands(
    stage: &StandingBody,
    hands: [&StagedHand; 2],
    [first, second]: [&mut HandGoalFrames<'_>; 2],
    contacts: &[Vec<(f64, f64)>; 2],
    rate: f64,
) -> Option<PartedMoment> {
    let length = hands[0].staged_hand_length();
    let near = ((tuned().bulk.around * rate).ceil() as usize).max(1);
    let total = first.points.len();
    let mut most: Option<PartedMoment> = None;
    let mut sums = vec![DVec3::ZERO; total];
    for round in 0..=HANDS_APART_ROUNDS {
        let mut displacements = vec![DVec3::ZERO; total];
        let mut same: Option<(usize, DVec3)> = None;
        let mut left = 0.0_f64;
        for (frame, out) in displacements.iter_mut().enumerate() {
            if let Some((n, displacement)) = same
                && has_same_goal(first, frame, n)
                && has_same_goal(second, frame, n)
            {
                *out = displacement;
                continue;
            }
            let displacement = separation(stage, length, first, second, frame);
            left = left.max(displacement.length());
            *out = displacement;
            same = Some((frame, displacement));
        }
        if left <= tuned().bulk.soft || round == HANDS_APART_ROUNDS {
            break;
        }
        for (frame, displacement) in ease_push_vectors(&displacements, near).into_iter().enumerate() {
            let displacement = match is_both_hands_contact(contacts, frame as f64 / rate) {
                true => (sums[frame] * 2.0 + displacement).clamp_length_max(tuned().bulk.touching) - sums[frame] * 2.0,
                false => displacement,
            };
            first.points[frame] += displacement * 0.5;
            second.points[frame] -= displacement * 0.5;
            sums[frame] += displacement * 0.5;
        }
    }
    for (frame, sum) in sums.iter().enumerate() {
        let by = sum.length();
        if by > most.map_or(REPORTED_HAND_SHIFT_M, |most| most.by) {
            let time = frame as f64 / rate;
            most = Some(PartedMoment { time, by });
        }
    }
    most
}

/// Returns the depth (m) by which two hands are in each other in their solved frames, if it is large enough to report.
pub(crate) fn remaining_hand_depth(length: f64, hands: [&SolvedFrames<'_>; 2]) -> Option<f64> {
    let [first, second] = hands.map(SolvedFrames::solved_frame_total);
    let mut deepest = 0.0_f64;
    let mut before = None;
    for frame in 0..first.min(second) {
        if before.is_some_and(|before| hands.iter().all(|hand| hand.is_hand_unchanged(before, frame))) {
            continue;
        }
        before = Some(frame);
        let [Some(a), Some(b)] = hands.map(|hand| hand.placed_hand_at(frame)) else {
            return None;
        };
        deepest = deepest.max(hand_overlap_depth(length, [&a, &b]).map_or(0.0, |(deep, _)| deep));
    }
    (deepest > REPORTED_HAND_DEPTH_M + depth_left()).then_some(deepest)
}

/// Returns the depth (m) by which two forearms are in each other in any frame, if it is large enough to report;
/// `arm` is the arm's length in metres. Near the wrist the bulk of the hands counts instead.
pub(crate) fn remaining_forearm_depth(arm: f64, [first, second]: [&SolvedFrames<'_>; 2]) -> Option<f64> {
    let frames = 0..first.solved_frame_total().min(second.solved_frame_total());
    let gaps = frames.map(|frame| {
        let [a, b] = [first, second].map(|hand| hand.forearm_ends_at(frame));
        shortest_segment_vector(a, b).length()
    });
    let deepest = 2.0 * FOREARM_FLESH_RADIUS * arm - gaps.fold(f64::INFINITY, f64::min);
    (deepest > REPORTED_FOREARM_DEPTH_M).then_some(deepest)
}

/// Returns whether both hands touch something at a time.
fn is_both_hands_contact(contacts: &[Vec<(f64, f64)>; 2], time: f64) -> bool {
    contacts.iter().all(|spans| {
        let mut spans = spans.iter();
        spans.any(|(from, to)| (from - tuned().bulk.beside..=to + tuned().bulk.beside).contains(&time))
    })
}

/// Returns whether the goal of a hand is the same in two frames.
fn has_same_goal(wanted: &HandGoalFrames<'_>, a: usize, b: usize) -> bool {
    wanted.points[a] == wanted.points[b]
        && wanted.turns[a] == wanted.turns[b]
        && wanted.offsets[a] == wanted.offsets[b]
        && wanted.wrist[a] == wanted.wrist[b]
        && std::ptr::eq(
            wanted.outlines.outlines_at_frame(a)[1],
            wanted.outlines.outlines_at_frame(b)[1],
        )
}

/// Returns the displacement by which the first hand leaves the second: as long as the depth of the deepest place, along
/// the mean of the displacements of all places.
fn separation(
    stage: &StandingBody,
    length: f64,
    first: &HandGoalFrames<'_>,
    second: &HandGoalFrames<'_>,
    frame: usize,
) -> DVec3 {
    let [Some(a), Some(b)] = [first, second].map(|wanted| PlacedHand::posed_hand_at_frame(wanted, frame)) else {
        return DVec3::ZERO;
    };
    let Some((deepest, sum)) = hand_overlap_depth(length, [&a, &b]) else {
        return DVec3::ZERO;
    };
    let palms = a.outline_point_at(MIDDLE_KNUCKLE) - b.outline_point_at(MIDDLE_KNUCKLE);
    let usual = stage.forward * 0.8 + DVec3::Y * 0.6;
    let direction = sum.try_normalize().or(palms.try_normalize());
    direction.unwrap_or(usual) * (deepest - depth_left())
}

/// Returns whether two hands penetrate each other in a frame if each moves by half of `apart` (m), the first one along it.
pub(super) fn may_hands_penetrate(
    length: f64,
    [first, second]: [&HandGoalFrames<'_>; 2],
    frame: usize,
    apart: DVec3,
) -> bool {
    let hands = [(first, apart), (second, -apart)];
    let [Some(a), Some(b)] = hands.map(|(wanted, by)| {
        let hand = PlacedHand::posed_hand_at_frame(wanted, frame)?;
        let wrist = hand.wrist + by * 0.5;
        Some(PlacedHand { wrist, ..hand })
    }) else {
        return false;
    };
    hand_overlap_depth(length, [&a, &b]).is_some()
}

/// Returns the depth (m) of the deepest place at which two hands penetrate each other, and the sum of the displacements of
/// all places; `None` if the flesh gives way.
fn hand_overlap_depth(length: f64, [a, b]: [&PlacedHand<'_>; 2]) -> Option<(f64, DVec3)> {
    let palms = a.outline_point_at(MIDDLE_KNUCKLE) - b.outline_point_at(MIDDLE_KNUCKLE);
    let flesh = FLESH_RADII.into_iter().fold(0.0, f64::max) * length;
    let near = a.may_touch(b.outline_box_middle(), b.outline_ball_radius() + 2.0 * flesh);
    if palms.length() > tuned().bulk.far * length || !near {
        return None;
    }
    let (a, b) = (tubes(a, length), tubes(b, length));
    let (mut sum, mut deepest) = (DVec3::ZERO, 0.0_f64);
    for one in &a {
        let half = one.half + one.radius;
        for other in &b {
            let reach = half + other.half + other.radius;
            if one.middle.distance_squared(other.middle) > reach * reach {
                continue;
            }
            let gap = shortest_segment_vector(one.ends, other.ends);
            let deep = one.radius + other.radius - gap.length();
            if deep > tuned().bulk.soft {
                sum += gap.normalize_or(DVec3::ZERO) * deep;
                deepest = deepest.max(deep);
            }
        }
    }
    (deepest > tuned().bulk.soft).then_some((deepest, sum))
}

/// A hand in its intended pose.
pub(super) struct PlacedHand<'a> {
    wrist: DVec3,
    turned: DQuat,
    outline: &'a HandOutline,
}

impl<'a> PlacedHand<'a> {
    /// Returns the hand in a frame; `None` if its skeleton has no fingers.
    pub(super) fn posed_hand_at_frame(wanted: &'a HandGoalFrames<'_>, frame: usize) -> Option<Self> {
        let (turned, offset) = match wanted.wrist[frame] {
            Some(turn) => (wanted.turns[frame] * turn, turn.inverse() * wanted.offsets[frame]),
            None => (wanted.turns[frame], wanted.offsets[frame]),
        };
        let wrist = wanted.points[frame] - turned * offset;
        Self::at_wrist(wrist, turned, &wanted.outlines, frame)
    }

    /// Returns the hand at a place with a rotation; `None` if its skeleton has no fingers.
    pub(super) fn at_wrist(wrist: DVec3, turned: DQuat, outlines: &'a OutlineTrack<'_>, frame: usize) -> Option<Self> {
        let [_, outline] = outlines.outlines_at_frame(frame);
        (outline.points.len() >= 22).then_some(Self { wrist, turned, outline })
    }

    /// Returns the least distance of the outline from a plane through a point with a normal, in the normal's direction.
    pub(super) fn least_plane_distance(&self, point: DVec3, normal: DVec3) -> f64 {
        let local_normal = self.turned.inverse() * normal;
        let points = self.outline.points.iter();
        let least = points.map(|at| at.dot(local_normal)).fold(0.0, f64::min);
        (self.wrist - point).dot(normal) + least
    }

    /// Returns the joints and tips of the fingers.
    pub(super) fn finger_bone_points(&self) -> impl Iterator<Item = DVec3> {
        (2..self.outline.points.len()).map(|n| self.outline_point_at(n))
    }

    /// Returns whether a ball with this middle and radius may touch the outline or the wrist.
    pub(super) fn may_touch(&self, middle: DVec3, radius: f64) -> bool {
        self.outline_box_middle().distance(middle) <= self.outline_ball_radius() + radius
    }

    /// Returns the middle of the smallest box around the outline.
    fn outline_box_middle(&self) -> DVec3 {
        self.wrist + self.turned * self.outline.middle
    }

    /// Returns the radius of a ball about that middle that holds the outline and the wrist.
    fn outline_ball_radius(&self) -> f64 {
        self.outline.radius.max(self.outline.middle.length())
    }

    /// Returns the position of a point of the outline.
    fn outline_point_at(&self, n: usize) -> DVec3 {
        self.wrist + self.turned * self.outline.points[n]
    }
}

/// Returns the depth (m) that remains after hands were moved apart.
fn depth_left() -> f64 {
    tuned().bulk.gives * tuned().bulk.soft
}

/// Returns the bones of a hand, the middle of the palm first.
fn tubes(hand: &PlacedHand<'_>, length: f64) -> [FleshTube; 18] {
    let (wrist, at) = (hand.wrist, |n: usize| hand.outline_point_at(n));
    let [finger, root, palm] = FLESH_RADII.map(|radius| radius * length);
    let knuckle = |digit: usize| at(2 + 3 * digit);
    let tube = |a: DVec3, b: DVec3, radius: f64| FleshTube::tube_between_ends([a, b], radius);
    let mut all = [tube(wrist, wrist, 0.0); 18];
    for (n, digit) in [2, 1, 4].into_iter().enumerate() {
        all[n] = tube(wrist.lerp(knuckle(digit), 0.3), knuckle(digit), palm);
    }
    all[3] = tube(wrist.lerp(knuckle(0), 0.3), knuckle(0), root);
    all[4] = tube(knuckle(0), at(3), finger);
    all[5] = tube(at(3), shorten_fleshy_bone(at(3), at(4), finger), finger);
    for digit in 1..5 {
        let [mid, tip, last] = [3 + 3 * digit, 4 + 3 * digit, 17 + digit].map(at);
        let n = 6 + 3 * (digit - 1);
        all[n] = tube(knuckle(digit), mid, finger);
        all[n + 1] = tube(mid, last, finger);
        all[n + 2] = tube(last, shorten_fleshy_bone(last, tip, finger), finger);
    }
    all
}

/// Returns the end of a bone whose flesh ends at the tip.
fn shorten_fleshy_bone(from: DVec3, tip: DVec3, radius: f64) -> DVec3 {
    tip - (tip - from).clamp_length_max(radius)
}

/// Returns the shortest vector from the second segment to the first.
fn shortest_segment_vector(a: [DVec3; 2], b: [DVec3; 2]) -> DVec3 {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let flat = uu * vv - uv * uv;
    let mut s = match flat > 1e-12 {
        true => ((uv * vw - vv * uw) / flat).clamp(0.0, 1.0),
        false => 0.0,
    };
    let mut t = if vv > 1e-12 { (uv * s + vw) / vv } else { 0.0 };
    if !(0.0..=1.0).contains(&t) {
        t = t.clamp(0.0, 1.0);
        s = match uu > 1e-12 {
            true => ((t * uv - uw) / uu).clamp(0.0, 1.0),
            false => 0.0,
        };
    }
    (a[0] + u * s) - (b[0] + v * t)
}
