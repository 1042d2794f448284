//! Where hands touch each other and the body, before and after an operator.

use std::ops::Range;

use chereme_motion::Side;
use chereme_motion::glam::DVec3;

use crate::work::Work;

mod mend;
mod points;

pub(crate) use mend::{Keep, mend};
use points::{Anchors, PLACES, POINTS, Tracks};

/// How near points of hands are that touch, and a hand's point and a place on the body, in metres.
/// Captures have no skin: in one of the sign for thanks, fingertips that touch the mouth come to
/// 5.5 cm of it, thumbs that touch to 3.1 cm.
const HANDS: f64 = 0.035;
const BODY: f64 = 0.06;
/// The farthest that a point of a hand is from its palm's middle, in metres.
const HAND: f64 = 0.25;
/// Contacts that are apart for less than this are one, in seconds.
const PAUSE: f64 = 0.1;
/// How far a contact may move and still be where it was, in metres.
const KEPT: f64 = 0.005;

/// The contacts of a movement.
pub(crate) struct Contacts {
    anchors: Anchors,
    found: Vec<Contact>,
}

/// A stretch of time in which a hand touches something.
#[derive(Debug, Clone)]
struct Contact {
    side: Side,
    /// The other hand; nothing for the body.
    other: Option<Side>,
    /// What comes nearest: the hand's point, and the other hand's or the body's place.
    point: usize,
    place: usize,
    frames: Range<usize>,
    /// From the point to the place, at each of these frames.
    ways: Vec<DVec3>,
    /// The frame at which they are nearest.
    nearest: usize,
}

impl Contact {
    fn way(&self, tracks: &Tracks, frame: usize) -> Option<DVec3> {
        let from = tracks.hand(self.side)[self.point].as_ref()?;
        let to = tracks.touched(self.other)[self.place].as_ref()?;
        Some(to[frame] - from[frame])
    }

    /// Returns how far the point was moved against the place where they were nearest.
    fn moved(&self, tracks: &Tracks) -> f64 {
        let was = self.ways[self.nearest - self.frames.start];
        self.way(tracks, self.nearest)
            .map_or(0.0, |way| way.distance(was))
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

/// Returns what touches in the movement.
pub(crate) fn touches(work: &Work) -> Contacts {
    let anchors = Anchors::of(work);
    let tracks = anchors.tracks(work);
    let pairs = [
        (Side::Right, Some(Side::Left), HANDS),
        (Side::Right, None, BODY),
        (Side::Left, None, BODY),
    ];
    let mut found = Vec::new();
    for (side, other, near) in pairs {
        let near_frames = (0..work.frames).filter_map(|frame| {
            let (point, place, distance) = nearest(&tracks, side, other, frame)?;
            (distance < near).then_some((frame, point, place, distance))
        });
        let near_frames: Vec<_> = near_frames.collect();
        let pause = (PAUSE / work.rate.frame_time()).round().max(1.0) as usize;
        for run in near_frames.chunk_by(|a, b| b.0 - a.0 <= pause) {
            found.extend(contact(&tracks, side, other, run));
        }
    }
    Contacts { anchors, found }
}

/// Makes one contact of a run of frames with what comes nearest in each.
fn contact(
    tracks: &Tracks,
    side: Side,
    other: Option<Side>,
    run: &[(usize, usize, usize, f64)],
) -> Option<Contact> {
    let &(nearest, point, place, _) = run.iter().min_by(|a, b| a.3.total_cmp(&b.3))?;
    let mut contact = Contact {
        side,
        other,
        point,
        place,
        frames: run.first()?.0..run.last()?.0 + 1,
        ways: Vec::new(),
        nearest,
    };
    let ways = contact
        .frames
        .clone()
        .map(|frame| contact.way(tracks, frame));
    contact.ways = ways.collect::<Option<_>>()?;
    Some(contact)
}

/// Returns the point of a hand and the place that are nearest to each other.
fn nearest(
    tracks: &Tracks,
    side: Side,
    other: Option<Side>,
    frame: usize,
) -> Option<(usize, usize, f64)> {
    let (hand, touched) = (tracks.hand(side), tracks.touched(other));
    let reach = if other.is_some() { 2.0 * HAND } else { HAND };
    let palm = hand[0].as_ref().map(|palm| palm[frame]);
    let mut best: Option<(usize, usize, f64)> = None;
    for (place, track) in touched.iter().enumerate() {
        let Some(to) = track.as_ref().map(|track| track[frame]) else {
            continue;
        };
        if palm.is_some_and(|palm| palm.distance_squared(to) > reach * reach) {
            continue;
        }
        for (point, track) in hand.iter().enumerate() {
            let Some(from) = track.as_ref().map(|track| track[frame]) else {
                continue;
            };
            let distance = from.distance_squared(to);
            if best.is_none_or(|(.., least)| distance < least) {
                best = Some((point, place, distance));
            }
        }
    }
    best.map(|(point, place, square)| (point, place, square.sqrt()))
}

/// Says which contacts of before are gone, and by how far.
pub(crate) fn lost(before: &Contacts, work: &Work) -> Vec<String> {
    if before.found.is_empty() {
        return Vec::new();
    }
    let tracks = before.anchors.tracks(work);
    let gone = before
        .found
        .iter()
        .filter(|contact| contact.moved(&tracks) >= KEPT);
    gone.filter_map(|contact| {
        let (point, place) = contact.names();
        let way = contact.way(&tracks, contact.nearest)?;
        Some(format!(
            "{point} touched {place} at {}; it is now {:.1} cm away, having moved {:.1} cm against it",
            work.rate.instant(contact.nearest),
            way.length() * 100.0,
            contact.moved(&tracks) * 100.0
        ))
    })
    .collect()
}
