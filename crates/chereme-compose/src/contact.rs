//! Contacts of hands with each other and the body, before and after an operator.

use std::ops::Range;

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;

use crate::outcome::TouchReport;
use crate::recipe_settings::RecipeHandPoint;
use crate::work::WorkingClip;

mod contact_points;
mod contact_restore;

use contact_points::{PointAnchors, PointTracks, SEARCHED_POINTS, TOUCHED_BODY_PLACES, TOUCHING_HAND_POINTS};
pub(crate) use contact_restore::{CONTACT_BLEND_S, ContactsToKeep, blend_shifts, long_repairs, restore_contacts};
use contact_restore::{MAX_OTHER_BODY_SHIFT_M, UNNOTICED_SHIFT};

/// The largest distance between two touching points of hands, in metres. Captures have no skin: in one of the sign for
/// thanks, fingertips that touch the mouth come to 5.5 cm of it, thumbs that touch to 3.1 cm.
const HAND_CONTACT_DISTANCE_M: f64 = 0.035;
/// The largest distance between a hand's point and a place on the body that touch, in metres.
const BODY_CONTACT_DISTANCE_M: f64 = 0.06;
/// The greatest distance of a point of a hand from its palm's middle, in lengths of the hand, and that length in
/// metres if the body does not give it.
const HAND_POINT_REACH: (f64, f64) = (0.9, 0.2);
/// The interval at which contacts are looked for, in seconds.
const CONTACT_SAMPLE_INTERVAL_S: f64 = 1.0 / 60.0;
/// The shortest pause between two separate contacts, in seconds.
const CONTACT_PAUSE_S: f64 = 0.1;
/// The distance in metres that a contact may move and still count as kept.
const KEPT_CONTACT_OFFSET_M: f64 = 0.005;
/// The same for another hand or another time: the two sides of a body are never exactly alike.
const SIMILAR_CONTACT_OFFSET_M: f64 = 0.02;

/// The contacts of a movement.
#[derive(Debug, Clone)]
pub(crate) struct MovementContacts {
    anchors: PointAnchors,
    found: Vec<ContactSpan>,
    /// The longest shift of a wrist, in metres, for which the same point of the hand must touch again.
    same_point_shift: f64,
}

/// A span of time in which a hand touches something.
#[derive(Debug, Clone)]
struct ContactSpan {
    side: BodySide,
    /// The other hand; `None` for the body.
    other: Option<BodySide>,
    /// The hand's point that comes nearest.
    point: usize,
    place: usize,
    frames: Range<usize>,
    /// The vectors from the point to the place at each of these frames.
    offsets: Vec<DVec3>,
    /// The frame at which they are nearest.
    nearest: usize,
    /// The longest shift of a wrist that repaired it, in metres.
    repaired: f64,
}

impl MovementContacts {
    /// Returns the number of contacts.
    pub(crate) fn count_contacts(&self) -> usize {
        self.found.len()
    }

    /// Returns the same contacts for another body that moves alike.
    pub(crate) fn transfer_contacts(self, work: &WorkingClip) -> Self {
        Self {
            anchors: PointAnchors::find_point_anchors(work),
            // On a body of other proportions a sign keeps its touching finger, however far that is from it.
            same_point_shift: MAX_OTHER_BODY_SHIFT_M,
            ..self
        }
    }
}

impl ContactSpan {
    fn contact_offset(&self, tracks: &PointTracks<'_>, frame: usize) -> Option<DVec3> {
        let from = tracks.hand_point_position(self.side, self.point, frame)?;
        Some(tracks.touched_position(self.other, self.place, frame)? - from)
    }

    /// Returns the change of the point's position relative to the place, at the frame where they were nearest.
    fn contact_displacement(&self, tracks: &PointTracks<'_>) -> f64 {
        let was = self.offsets[self.nearest - self.frames.start];
        self.contact_offset(tracks, self.nearest)
            .map_or(0.0, |offset| offset.distance(was))
    }

    fn contact_point_names(&self) -> (String, String) {
        let point = format!("{}-{}", self.side.body_side_name(), TOUCHING_HAND_POINTS[self.point]);
        let place = match self.other {
            Some(side) => format!("{}-{}", side.body_side_name(), TOUCHING_HAND_POINTS[self.place]),
            None => TOUCHED_BODY_PLACES[self.place].to_owned(),
        };
        (point, place)
    }
}

/// The moment at which a hand touches the body, with the hand's point and the place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyTouch {
    pub(crate) frame: usize,
    pub(crate) point: RecipeHandPoint,
    pub(crate) place: &'static str,
}

impl MovementContacts {
    /// Returns the frames in which the hands touch each other.
    pub(crate) fn between_hands(&self) -> impl Iterator<Item = usize> + '_ {
        let between = self.found.iter().filter(|contact| contact.other.is_some());
        between.flat_map(|contact| contact.frames.clone())
    }

    /// Returns the nearest contact of a hand with the body that has a frame in `frames`, if there is one.
    pub(crate) fn with_body(&self, side: BodySide, frames: &Range<usize>) -> Option<BodyTouch> {
        let of_hand = self
            .found
            .iter()
            .filter(|contact| contact.side == side && contact.other.is_none());
        let within = of_hand.filter_map(|contact| {
            let start = contact.frames.start.max(frames.start);
            let end = contact.frames.end.min(frames.end);
            let far = |frame: &usize| contact.offsets[frame - contact.frames.start].length();
            let frame = (start..end).min_by(|a, b| far(a).total_cmp(&far(b)))?;
            Some((far(&frame), contact, frame))
        });
        let (_, contact, frame) = within.min_by(|a, b| a.0.total_cmp(&b.0))?;
        // In the order of the touching points, of which only these are searched.
        let points = [
            RecipeHandPoint::Palm,
            RecipeHandPoint::Thumb,
            RecipeHandPoint::Index,
            RecipeHandPoint::Middle,
            RecipeHandPoint::Ring,
            RecipeHandPoint::Little,
        ];
        Some(BodyTouch {
            frame,
            point: points[contact.point],
            place: TOUCHED_BODY_PLACES[contact.place],
        })
    }
}

/// Returns the contacts in a movement.
pub(crate) fn find_contacts(work: &WorkingClip) -> MovementContacts {
    let anchors = PointAnchors::find_point_anchors(work);
    let tracks = anchors.follow_anchored_points(work);
    let measures = work.anatomy.anatomy_measures();
    let reach = HAND_POINT_REACH.0 * measures.map_or(HAND_POINT_REACH.1, |measures| measures.hand);
    let mut near: [Vec<NearestTouch>; CONTACT_PAIRS.len()] = Default::default();
    let look = (CONTACT_SAMPLE_INTERVAL_S / work.rate.frame_time()).round().max(1.0) as usize;
    for frame in (0..work.frames).step_by(look) {
        let frame_points = FramePositions::from_contact_tracks(&tracks, frame, reach + BODY_CONTACT_DISTANCE_M);
        for (near, (side, other, limit)) in near.iter_mut().zip(CONTACT_PAIRS) {
            let nearest_contact = frame_points.find_nearest_touch(side, other, limit + reach);
            near.extend(nearest_contact.filter(|found| found.distance < limit));
        }
    }
    // At least one look, or every look would find a contact of its own.
    let pause = ((CONTACT_PAUSE_S / work.rate.frame_time()).round() as usize).max(look);
    let mut contacts = Vec::new();
    for (near, (side, other, _)) in near.iter().zip(CONTACT_PAIRS) {
        for run in near.chunk_by(|a, b| b.frame - a.frame <= pause) {
            contacts.extend(merge_contact_run(&tracks, side, other, run));
        }
    }
    drop(tracks);
    MovementContacts {
        anchors,
        found: contacts,
        same_point_shift: UNNOTICED_SHIFT,
    }
}

/// The possible contacts: a hand, the other hand or the body, and the largest distance of a contact in metres.
const CONTACT_PAIRS: [(BodySide, Option<BodySide>, f64); 3] = [
    (BodySide::Right, Some(BodySide::Left), HAND_CONTACT_DISTANCE_M),
    (BodySide::Right, None, BODY_CONTACT_DISTANCE_M),
    (BodySide::Left, None, BODY_CONTACT_DISTANCE_M),
];

/// The point and the place that are nearest in a frame.
#[derive(Debug, Clone, Copy)]
struct NearestTouch {
    frame: usize,
    point: usize,
    place: usize,
    distance: f64,
}

/// Returns the contact over a run of frames, between the point and the place that come nearest in any of them.
fn merge_contact_run(
    tracks: &PointTracks<'_>,
    side: BodySide,
    other: Option<BodySide>,
    run: &[NearestTouch],
) -> Option<ContactSpan> {
    let nearest = run.iter().min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    let mut contact = ContactSpan {
        side,
        other,
        point: nearest.point,
        place: nearest.place,
        frames: run.first()?.frame..run.last()?.frame + 1,
        offsets: Vec::new(),
        nearest: nearest.frame,
        repaired: 0.0,
    };
    let frames = contact.frames.clone();
    let offsets = frames.map(|frame| contact.contact_offset(tracks, frame));
    contact.offsets = offsets.collect::<Option<_>>()?;
    Some(contact)
}

/// Positions in one frame; places on the body only if hands are near them.
struct FramePositions<'a> {
    tracks: &'a PointTracks<'a>,
    frame: usize,
    palms: [Option<DVec3>; 2],
    body: [Option<DVec3>; TOUCHED_BODY_PLACES.len()],
}

impl<'a> FramePositions<'a> {
    fn from_contact_tracks(tracks: &'a PointTracks<'a>, frame: usize, reach: f64) -> Self {
        let palms = BodySide::BOTH_SIDES.map(|side| tracks.hand_point_position(side, 0, frame));
        let body = tracks.body_near(&palms, reach, frame);
        Self {
            tracks,
            frame,
            palms,
            body,
        }
    }

    fn palm_position(&self, side: BodySide) -> Option<DVec3> {
        self.palms[usize::from(side == BodySide::Left)]
    }

    fn hand_point_positions(&self, side: BodySide) -> [Option<DVec3>; SEARCHED_POINTS] {
        std::array::from_fn(|point| self.tracks.hand_point_position(side, point, self.frame))
    }

    /// Returns the point of a hand and the place that are nearest to each other, if the place is
    /// within `reach` of the palm, or the palms within twice that.
    fn find_nearest_touch(&self, side: BodySide, other: Option<BodySide>, reach: f64) -> Option<NearestTouch> {
        let palm = self.palm_position(side);
        let is_far = |to: Option<DVec3>, reach: f64| {
            // A palm that is unknown excludes nothing.
            let far = palm.zip(to).map(|(palm, to)| palm.distance_squared(to));
            far.is_some_and(|far| far > reach * reach)
        };
        // Fingertips are computed only if the palms are near enough.
        let hands = match other {
            Some(other) if is_far(self.palm_position(other), 2.0 * reach) => return None,
            Some(other) => self.hand_point_positions(other),
            None => [None; SEARCHED_POINTS],
        };
        let places: &[Option<DVec3>] = match other {
            Some(_) => &hands,
            None => &self.body,
        };
        let mut points = None;
        let mut best: Option<(usize, usize, f64)> = None;
        for (place, &at) in places.iter().enumerate() {
            // Points of the other hand have passed the test of the palms.
            let Some(to) = at.filter(|_| other.is_some() || !is_far(at, reach)) else {
                continue;
            };
            // Few frames have a place in reach, so that the hand's points wait until one is found.
            let points = points.get_or_insert_with(|| self.hand_point_positions(side));
            for (point, from) in points.iter().enumerate() {
                let Some(square) = from.map(|from| from.distance_squared(to)) else {
                    continue;
                };
                if best.is_none_or(|(.., least)| square < least) {
                    best = Some((point, place, square));
                }
            }
        }
        best.map(|(point, place, square)| NearestTouch {
            frame: self.frame,
            point,
            place,
            distance: square.sqrt(),
        })
    }
}

/// The effect of an operator on contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ContactEffect {
    /// The same hand touches the same place at the same frame.
    Same,
    /// The other hand touches the place on the other side.
    Swapped,
    /// The other hand takes over the contacts of this one.
    Copied(BodySide),
    /// The same contact at any frame.
    Anytime,
}

impl ContactEffect {
    /// Returns the expected contact after the operator; `None` if the arm does something else.
    fn expected_contact(self, contact: &ContactSpan) -> Option<ContactSpan> {
        match (self, contact.other) {
            // Contacts between hands are seen from the right one, so that a swap exchanges point and place.
            (Self::Swapped, Some(_)) => Some(ContactSpan {
                point: contact.place,
                place: contact.point,
                ..contact.clone()
            }),
            (Self::Copied(from), None) if contact.side != from => None,
            (Self::Swapped | Self::Copied(_), None) => Some(ContactSpan {
                side: contact.side.opposite_side(),
                place: contact_points::opposite_place(contact.place),
                ..contact.clone()
            }),
            _ => Some(contact.clone()),
        }
    }

    /// Returns the distance of the expected contact now, and its increase.
    fn contact_drift(self, contact: &ContactSpan, tracks: &PointTracks<'_>, frames: usize) -> Option<(f64, f64)> {
        let was = contact.offsets[contact.nearest - contact.frames.start].length();
        let offset_length = |frame: usize| contact.contact_offset(tracks, frame).map(DVec3::length);
        let is = match self {
            Self::Anytime => (0..frames).filter_map(offset_length).min_by(f64::total_cmp)?,
            _ => offset_length(contact.nearest)?,
        };
        // The same contact may not slide either; another hand's can be compared by distance alone.
        let more = match self {
            Self::Same => contact.contact_displacement(tracks),
            _ => is - was,
        };
        Some((is, more))
    }
}

/// Returns the former contacts with their distances on another body, which moves alike.
pub(crate) fn report_touches(before: &MovementContacts, work: &WorkingClip) -> Vec<TouchReport> {
    let tracks = before.anchors.follow_anchored_points(work);
    let report = |contact: &ContactSpan| {
        let (point, place) = contact.contact_point_names();
        Some(TouchReport {
            point,
            place,
            at: work.rate.frame_start_instant(contact.nearest),
            was_m: contact.offsets[contact.nearest - contact.frames.start].length(),
            now_m: contact.contact_offset(&tracks, contact.nearest)?.length(),
            off_m: contact.contact_displacement(&tracks),
            moved_m: contact.repaired,
        })
    };
    before.found.iter().filter_map(report).collect()
}

/// Describes the former contacts that are lost, with their distances.
pub(crate) fn describe_lost_contacts(
    before: &MovementContacts,
    work: &WorkingClip,
    carry: ContactEffect,
) -> Vec<String> {
    if before.found.is_empty() {
        return Vec::new();
    }
    let tracks = before.anchors.follow_anchored_points(work);
    let describe = |contact: &ContactSpan| {
        let now = carry.expected_contact(contact)?;
        let (is, more) = carry.contact_drift(&now, &tracks, work.frames)?;
        if more
            < if carry == ContactEffect::Same {
                KEPT_CONTACT_OFFSET_M
            } else {
                SIMILAR_CONTACT_OFFSET_M
            }
        {
            return None;
        }
        let [(point, place), (now_point, now_place)] = [contact.contact_point_names(), now.contact_point_names()];
        let nearest_instant = work.rate.frame_start_instant(contact.nearest);
        let is = is * 100.0;
        Some(match carry {
            ContactEffect::Same => format!(
                "{point} touched {place} at {nearest_instant}; it is now {is:.1} cm away, having moved {:.1} cm \
                 against it",
                more * 100.0
            ),
            ContactEffect::Swapped | ContactEffect::Copied(_) => format!(
                "{point} touched {place} at {nearest_instant}; now {now_point} is {is:.1} cm away from {now_place}"
            ),
            ContactEffect::Anytime => {
                format!("{point} touched {place} at {nearest_instant}; it comes to {is:.1} cm of it at the nearest")
            }
        })
    };
    before.found.iter().filter_map(describe).collect()
}
