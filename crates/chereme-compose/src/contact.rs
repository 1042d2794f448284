//! Contacts of hands with each other and the body, before and after an operator.

use std::ops::Range;

use chereme_motion::Side;
use chereme_motion::glam::DVec3;

use crate::recipe::HandPoint;
use crate::work::Work;

mod points;
mod restore;

use points::{Anchors, PLACES, POINTS, SEARCHED_POINTS, Tracks};
pub(crate) use restore::{BLEND, Keep, blended, long_repairs, mend};

/// The largest distance between two touching points of hands, in metres. Captures have no skin: in one of the sign for
/// thanks, fingertips that touch the mouth come to 5.5 cm of it, thumbs that touch to 3.1 cm.
const HANDS: f64 = 0.035;
/// The largest distance between a hand's point and a place on the body that touch, in metres.
const BODY: f64 = 0.06;
/// The greatest distance of a point of a hand from its palm's middle, in lengths of the hand, and that length in
/// metres if the body does not give it.
const HAND: (f64, f64) = (0.9, 0.2);
/// The interval at which contacts are looked for, in seconds.
const LOOK: f64 = 1.0 / 60.0;
/// The shortest pause between two separate contacts, in seconds.
const PAUSE: f64 = 0.1;
/// The distance in metres that a contact may move and still count as kept.
const KEPT: f64 = 0.005;
/// The same for another hand or another time: the two sides of a body are never exactly alike.
const ALIKE: f64 = 0.02;

/// The contacts of a movement.
#[derive(Debug, Clone)]
pub(crate) struct Contacts {
    anchors: Anchors,
    found: Vec<Contact>,
}

/// A span of time in which a hand touches something.
#[derive(Debug, Clone)]
struct Contact {
    side: Side,
    /// The other hand; `None` for the body.
    other: Option<Side>,
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

impl Contacts {
    /// Returns the number of contacts.
    pub(crate) fn count(&self) -> usize {
        self.found.len()
    }

    /// Returns the same contacts for another body that moves alike.
    pub(crate) fn on(self, work: &Work) -> Self {
        Self {
            anchors: Anchors::of(work),
            ..self
        }
    }
}

impl Contact {
    fn offset(&self, tracks: &Tracks<'_>, frame: usize) -> Option<DVec3> {
        let from = tracks.hand(self.side, self.point, frame)?;
        Some(tracks.touched(self.other, self.place, frame)? - from)
    }

    /// Returns the change of the point's position relative to the place, at the frame where they were nearest.
    fn moved(&self, tracks: &Tracks<'_>) -> f64 {
        let was = self.offsets[self.nearest - self.frames.start];
        self.offset(tracks, self.nearest)
            .map_or(0.0, |offset| offset.distance(was))
    }

    fn names(&self) -> (String, String) {
        let point = format!("{}-{}", self.side.name(), POINTS[self.point]);
        let place = match self.other {
            Some(side) => format!("{}-{}", side.name(), POINTS[self.place]),
            None => PLACES[self.place].to_owned(),
        };
        (point, place)
    }
}

/// The moment at which a hand touches the body, with the hand's point and the place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    pub(crate) frame: usize,
    pub(crate) point: HandPoint,
    pub(crate) place: &'static str,
}

impl Contacts {
    /// Returns the frames in which the hands touch each other.
    pub(crate) fn between_hands(&self) -> impl Iterator<Item = usize> + '_ {
        let between = self.found.iter().filter(|contact| contact.other.is_some());
        between.flat_map(|contact| contact.frames.clone())
    }

    /// Returns the nearest contact of a hand with the body that has a frame in `frames`, if there is one.
    pub(crate) fn with_body(&self, side: Side, frames: &Range<usize>) -> Option<Touch> {
        let of_hand = self
            .found
            .iter()
            .filter(|it| it.side == side && it.other.is_none());
        let within = of_hand.filter_map(|contact| {
            let start = contact.frames.start.max(frames.start);
            let end = contact.frames.end.min(frames.end);
            let far = |frame: &usize| contact.offsets[frame - contact.frames.start].length();
            let frame = (start..end).min_by(|a, b| far(a).total_cmp(&far(b)))?;
            Some((far(&frame), contact, frame))
        });
        let (_, contact, frame) = within.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let points = [
            HandPoint::Palm,
            HandPoint::Thumb,
            HandPoint::Index,
            HandPoint::Middle,
            HandPoint::Ring,
            HandPoint::Little,
        ];
        Some(Touch {
            frame,
            point: points[contact.point],
            place: PLACES[contact.place],
        })
    }
}

/// Returns the contacts in a movement.
pub(crate) fn touches(work: &Work) -> Contacts {
    let anchors = Anchors::of(work);
    let tracks = anchors.tracks(work);
    let measures = work.anatomy.measures();
    let reach = HAND.0 * measures.map_or(HAND.1, |measures| measures.hand);
    let mut near: [Vec<Near>; PAIRS.len()] = Default::default();
    let look = (LOOK / work.rate.frame_time()).round().max(1.0) as usize;
    for frame in (0..work.frames).step_by(look) {
        let at = At::of(&tracks, frame, reach + BODY);
        for (near, (side, other, limit)) in near.iter_mut().zip(PAIRS) {
            let found = at.nearest(side, other, limit + reach);
            near.extend(found.filter(|found| found.distance < limit));
        }
    }
    let pause = ((PAUSE / work.rate.frame_time()).round() as usize).max(look);
    let mut found = Vec::new();
    for (near, (side, other, _)) in near.iter().zip(PAIRS) {
        for run in near.chunk_by(|a, b| b.frame - a.frame <= pause) {
            found.extend(contact(&tracks, side, other, run));
        }
    }
    drop(tracks);
    Contacts { anchors, found }
}

/// The possible contacts: a hand, the other hand or the body, and the largest distance of a contact in metres.
const PAIRS: [(Side, Option<Side>, f64); 3] = [
    (Side::Right, Some(Side::Left), HANDS),
    (Side::Right, None, BODY),
    (Side::Left, None, BODY),
];

/// The point and the place that are nearest in a frame.
#[derive(Debug, Clone, Copy)]
struct Near {
    frame: usize,
    point: usize,
    place: usize,
    distance: f64,
}

/// Returns the contact over a run of frames, between the point and the place that come nearest in any of them.
fn contact(tracks: &Tracks<'_>, side: Side, other: Option<Side>, run: &[Near]) -> Option<Contact> {
    let nearest = run
        .iter()
        .min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    let mut contact = Contact {
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
    let offsets = frames.map(|frame| contact.offset(tracks, frame));
    contact.offsets = offsets.collect::<Option<_>>()?;
    Some(contact)
}

/// Positions in one frame; places on the body only if hands are near them.
struct At<'a> {
    tracks: &'a Tracks<'a>,
    frame: usize,
    palms: [Option<DVec3>; 2],
    body: [Option<DVec3>; PLACES.len()],
}

impl<'a> At<'a> {
    fn of(tracks: &'a Tracks<'a>, frame: usize, reach: f64) -> Self {
        let palms = Side::BOTH.map(|side| tracks.hand(side, 0, frame));
        let body = tracks.body_near(&palms, reach, frame);
        Self {
            tracks,
            frame,
            palms,
            body,
        }
    }

    fn palm(&self, side: Side) -> Option<DVec3> {
        self.palms[usize::from(side == Side::Left)]
    }

    fn hand(&self, side: Side) -> [Option<DVec3>; SEARCHED_POINTS] {
        std::array::from_fn(|point| self.tracks.hand(side, point, self.frame))
    }

    /// Returns the point of a hand and the place that are nearest to each other, if the place is
    /// within `reach` of the palm, or the palms within twice that.
    fn nearest(&self, side: Side, other: Option<Side>, reach: f64) -> Option<Near> {
        let palm = self.palm(side);
        let is_far = |to: Option<DVec3>, reach: f64| {
            let far = palm.zip(to).map(|(palm, to)| palm.distance_squared(to));
            far.is_some_and(|far| far > reach * reach)
        };
        let hands = match other {
            Some(other) if is_far(self.palm(other), 2.0 * reach) => return None,
            Some(other) => self.hand(other),
            None => [None; SEARCHED_POINTS],
        };
        let places: &[Option<DVec3>] = match other {
            Some(_) => &hands,
            None => &self.body,
        };
        let mut points = None;
        let mut best: Option<(usize, usize, f64)> = None;
        for (place, &at) in places.iter().enumerate() {
            let Some(to) = at.filter(|_| other.is_some() || !is_far(at, reach)) else {
                continue;
            };
            let points = points.get_or_insert_with(|| self.hand(side));
            for (point, from) in points.iter().enumerate() {
                let Some(square) = from.map(|from| from.distance_squared(to)) else {
                    continue;
                };
                if best.is_none_or(|(.., least)| square < least) {
                    best = Some((point, place, square));
                }
            }
        }
        best.map(|(point, place, square)| Near {
            frame: self.frame,
            point,
            place,
            distance: square.sqrt(),
        })
    }
}

/// The effect of an operator on contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Carry {
    /// The same hand touches the same place at the same frame.
    Same,
    /// The other hand touches the place on the other side.
    Swapped,
    /// The other hand takes over the contacts of this one.
    Copied(Side),
    /// The same contact at any frame.
    Anytime,
}

impl Carry {
    /// Returns the expected contact after the operator; `None` if the arm does something else.
    fn carried(self, contact: &Contact) -> Option<Contact> {
        match (self, contact.other) {
            (Self::Swapped, Some(_)) => Some(Contact {
                point: contact.place,
                place: contact.point,
                ..contact.clone()
            }),
            (Self::Copied(from), None) if contact.side != from => None,
            (Self::Swapped | Self::Copied(_), None) => Some(Contact {
                side: contact.side.other(),
                place: points::across(contact.place),
                ..contact.clone()
            }),
            _ => Some(contact.clone()),
        }
    }

    /// Returns the distance of the expected contact now, and its increase.
    fn off(self, contact: &Contact, tracks: &Tracks<'_>, frames: usize) -> Option<(f64, f64)> {
        let was = contact.offsets[contact.nearest - contact.frames.start].length();
        let at = |frame: usize| contact.offset(tracks, frame).map(DVec3::length);
        let is = match self {
            Self::Anytime => (0..frames).filter_map(at).min_by(f64::total_cmp)?,
            _ => at(contact.nearest)?,
        };
        let more = match self {
            Self::Same => contact.moved(tracks),
            _ => is - was,
        };
        Some((is, more))
    }
}

/// Describes the former contacts that are lost, with their distances.
pub(crate) fn lost(before: &Contacts, work: &Work, carry: Carry) -> Vec<String> {
    if before.found.is_empty() {
        return Vec::new();
    }
    let tracks = before.anchors.tracks(work);
    let describe = |contact: &Contact| {
        let now = carry.carried(contact)?;
        let (is, more) = carry.off(&now, &tracks, work.frames)?;
        if more < if carry == Carry::Same { KEPT } else { ALIKE } {
            return None;
        }
        let [(point, place), (now_point, now_place)] = [contact.names(), now.names()];
        let at = work.rate.instant(contact.nearest);
        let is = is * 100.0;
        Some(match carry {
            Carry::Same => format!(
                "{point} touched {place} at {at}; it is now {is:.1} cm away, having moved {:.1} cm \
                 against it",
                more * 100.0
            ),
            Carry::Swapped | Carry::Copied(_) => format!(
                "{point} touched {place} at {at}; now {now_point} is {is:.1} cm away from {now_place}"
            ),
            Carry::Anytime => format!(
                "{point} touched {place} at {at}; it comes to {is:.1} cm of it at the nearest"
            ),
        })
    };
    before.found.iter().filter_map(describe).collect()
}
