//! Contacts of hands with each other and with the body: kept, reported, or lost without a report.

use chereme_motion::glam::DVec3;
use chereme_motion::{BodySide, Clip};

use crate::Result;
use crate::capture::Capture;
use crate::shelf::Shelf;
use crate::table::markdown;

/// Distances below which hands touch: between points of both hands, and between a hand's point and a place on the body
/// (m).
const NEAR: [f64; 2] = [0.035, 0.06];
/// Additional distance (m) at which a contact still counts as kept.
const SLACK: f64 = 0.005;
/// Contacts with a shorter pause than this (s) between them count as one.
const PAUSE: f64 = 0.1;

const POINTS: [&str; 6] = ["palm", "thumb-tip", "index-tip", "middle-tip", "ring-tip", "little-tip"];
const PLACES: [&str; 8] = [
    "forehead",
    "nose",
    "left-cheek",
    "right-cheek",
    "mouth",
    "chin",
    "throat",
    "chest",
];
const STEPS: [(&str, bool); 6] = [
    ("configure both fist", true),
    ("orient right by 30deg about up", true),
    ("amplify both 1.3", true),
    ("place both by up 10cm", false),
    ("place both by forward 25cm", false),
    ("place right by right 15cm", false),
];

/// A contact at its nearest frame.
struct Contact {
    side: BodySide,
    other: Option<BodySide>,
    place: &'static str,
    frame: usize,
}

pub(crate) fn tables(captures: &[Capture]) -> Result<String> {
    let mut rows = Vec::new();
    let two: Vec<&Capture> = captures.iter().filter(|c| c.sides().len() == 2).collect();
    let sources: Vec<Vec<Contact>> = two.iter().map(|capture| contacts(capture)).collect();
    for (step, keeps_body) in STEPS {
        let mut counts = [[0usize; 3]; 2];
        for (capture, contacts) in two.iter().zip(&sources) {
            if contacts.is_empty() {
                continue;
            }
            // Some bodies have no fingers for another shape, or arms that do not reach so far.
            let Ok(made) = Shelf::new(capture.clip.clone(), &capture.anatomy).make(step) else {
                continue;
            };
            for contact in contacts {
                let kept = touches(capture, &made.clip, contact);
                let reported = made.report.contacts.iter().any(|text| is_about(text, contact));
                let what = if kept {
                    0
                } else if reported {
                    1
                } else {
                    2
                };
                counts[usize::from(contact.other.is_none())][what] += 1;
            }
        }
        let cell = |n: [usize; 3]| format!("{} · {} · {}", n[0], n[1], n[2]);
        let asks = if keeps_body {
            "hands and body"
        } else if step.contains("both") {
            "hands"
        } else {
            "none"
        };
        rows.push([format!("`{step}`"), asks.into(), cell(counts[0]), cell(counts[1])]);
    }
    let with = two.iter().zip(&sources).filter(|(_, found)| !found.is_empty());
    let named: Vec<String> = with.map(|(c, found)| format!("{} {}", c.name, found.len())).collect();
    Ok(format!(
        "### Contacts\n\nIn the sources ({}): points of hands within {:.1} cm of each other, or within \
         {:.0} cm of a place on the body. Where they were nearest: still touch · the report says that \
         they do not · neither.\n\n{}",
        named.join(", "),
        NEAR[0] * 100.0,
        NEAR[1] * 100.0,
        markdown(&["operator", "is to keep", "hand and hand", "hand and body"], rows)
    ))
}

/// Returns whether the report mentions this contact of the hand.
fn is_about(text: &str, contact: &Contact) -> bool {
    let (side, hand) = (contact.side, contact.side.opposite_side());
    let is_hand = POINTS
        .iter()
        .any(|point| text.contains(&format!("touched {}-{point}", hand.body_side_name())));
    POINTS
        .iter()
        .any(|point| text.contains(&format!("{}-{point} touched", side.body_side_name())))
        && is_hand == contact.other.is_some()
}

fn touches(capture: &Capture, clip: &Clip, contact: &Contact) -> bool {
    let near = NEAR[usize::from(contact.other.is_none())];
    let at = places(capture, clip, contact.side, contact.other, contact.frame).into_iter();
    at.filter(|(place, _)| contact.other.is_some() || *place == contact.place)
        .any(|(_, distance)| distance < near + SLACK)
}

/// Returns the distance of the hand's nearest point from each thing that it may touch.
fn places(
    capture: &Capture,
    clip: &Clip,
    side: BodySide,
    other: Option<BodySide>,
    frame: usize,
) -> Vec<(&'static str, f64)> {
    let model = clip.model_pose(frame);
    let at = |name: &str| {
        capture
            .anatomy
            .landmark_place_position(clip.clip_skeleton(), &model, name)
    };
    let of = |side: BodySide| POINTS.map(|point| at(&format!("{}-{point}", side.body_side_name())));
    let hand: Vec<DVec3> = of(side).into_iter().flatten().collect();
    let things: Vec<(&'static str, Option<DVec3>)> = match other {
        Some(other) => POINTS.into_iter().zip(of(other)).collect(),
        None => PLACES.map(|place| (place, at(place))).into(),
    };
    let near = |to: DVec3| {
        hand.iter()
            .map(move |from| from.distance(to))
            .fold(f64::INFINITY, f64::min)
    };
    things
        .into_iter()
        .filter_map(|(name, to)| Some((name, near(to?))))
        .collect()
}

fn contacts(capture: &Capture) -> Vec<Contact> {
    let clip = &capture.clip;
    let pause = (PAUSE * clip.clip_frame_rate().per_second()).round().max(1.0) as usize;
    let mut found = Vec::new();
    for (side, other) in [
        (BodySide::Right, Some(BodySide::Left)),
        (BodySide::Right, None),
        (BodySide::Left, None),
    ] {
        let limit = NEAR[usize::from(other.is_none())];
        let close = (0..clip.clip_frame_count()).filter_map(|frame| {
            let all = places(capture, clip, side, other, frame).into_iter();
            let (place, distance) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
            (distance < limit).then_some((frame, place, distance))
        });
        let close: Vec<(usize, &'static str, f64)> = close.collect();
        for run in close.chunk_by(|a, b| b.0 - a.0 <= pause) {
            let nearest = run.iter().min_by(|a, b| a.2.total_cmp(&b.2));
            found.extend(nearest.map(|&(frame, place, _)| Contact {
                side,
                other,
                place,
                frame,
            }));
        }
    }
    found
}
