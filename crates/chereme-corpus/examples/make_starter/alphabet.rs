//! The letters of the French manual alphabet, from the inventory `lsf-alphabet`.

use chereme_motion::Side::Right;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::inventory::{InventoryValue, builtin_by_id};

use super::facing;
use super::score::{Beat, Part, Says, Sign, Tier};
use super::signs;

/// How long a letter is held, and one stroke of a letter that moves, in seconds.
const HOLD: f64 = 0.32;
const STROKE: f64 = 0.30;

/// Returns the letters in the order of the alphabet, each a sign glossed `DS:` and the letter.
pub(crate) fn letters() -> Vec<Sign> {
    let alphabet = builtin_by_id("lsf-alphabet").map_or(&[][..], |inventory| &inventory.values);
    alphabet.iter().filter_map(letter).collect()
}

fn letter(value: &'static InventoryValue) -> Option<Sign> {
    let shape = value.configuration.as_deref()?;
    let facing_ids = value.orientation.as_ref()?;
    let [fingers, palm] = facing::vectors(&facing_ids.fingers, &facing_ids.palm)?;
    let [fingers, palm] = eased([fingers, palm]);
    let moving = value.strokes.len() as f64 * STROKE;
    let length = if moving > 0.0 { moving + 0.25 } else { HOLD };
    let gloss: &'static str = format!("DS:{}", value.id).leak();
    let means = ["fr", "en"].map(|language| value.name(language));
    let mut sign = signs::letter(gloss, means, shape, length);
    let first = seated(sign.right.beats[0], fingers).facing(own(fingers), own(palm));
    let mut beats = vec![first];
    if !value.strokes.is_empty() {
        beats.push(first.again(0.12));
    }
    let (mut palm, mut way) = (palm, DVec3::ZERO);
    for (n, stroke) in (1..).zip(&value.strokes) {
        let direction = stroke.direction.as_deref().and_then(facing::direction);
        way += direction.unwrap_or(DVec3::ZERO) * stroke.size * SHOULDERS;
        palm = DQuat::from_axis_angle(fingers, stroke.turn) * palm;
        let at = Beat {
            offset: (DVec3::from(first.offset) + DVec3::from(own(way)) * 100.0).into(),
            ..first
                .again(0.12 + f64::from(n) * STROKE)
                .facing(own(fingers), own(palm))
        };
        beats.push(at);
    }
    let hold = beats.last().map_or(0.0, |beat| beat.at);
    let last = *beats.last()?;
    beats.push(last.again(length));
    sign.right = Part {
        beats,
        ..sign.right
    };
    sign.hold = hold;
    sign.says.push(match value.id.as_str() {
        "J" => Says(Tier::Movement(Right), "arc", 0.12, hold),
        "Z" => Says(Tier::Movement(Right), "zigzag", 0.12, hold),
        _ => Says(Tier::Movement(Right), "hold", 0.0, length),
    });
    Some(sign)
}

/// The distance of the shoulders of the signer in metres.
const SHOULDERS: f64 = 0.336;

/// Moves the wrist to where the forearm lets the hand point so.
fn seated(beat: Beat, fingers: DVec3) -> Beat {
    let [side, up, forward] = beat.offset;
    if fingers.y < -0.5 {
        Beat {
            offset: [side + 7.0, up + 8.0, forward + 2.0],
            ..beat.raised(0.9)
        }
    } else if fingers.x > 0.5 {
        Beat {
            offset: [side + 2.0, up + 3.0, forward - 1.0],
            ..beat.raised(0.4)
        }
    } else {
        beat.raised(0.05)
    }
}

/// Returns the directions that a wrist bends to with ease for those that are named: a hand that
/// points up or to the side leans out a little, one that points down to the middle and out; all nearer to the
/// directions named than to any other.
fn eased([fingers, palm]: [DVec3; 2]) -> [DVec3; 2] {
    let lean = match fingers.y {
        _ if fingers.x > 0.9 => DVec3::new(0.0, 0.0, 0.33),
        y if y > 0.9 => DVec3::new(0.0, 0.0, 0.18 + 0.17 * palm.x.abs()),
        y if y < -0.9 => DVec3::new(0.25, 0.0, 0.28),
        _ => DVec3::ZERO,
    };
    let leaning = (fingers + lean).normalize();
    let aside = if fingers.y < -0.9 { -0.30 } else { 0.0 };
    let palm = palm + DVec3::X * aside;
    [leaning, palm.reject_from_normalized(leaning).normalize()]
}

/// From model space to the right hand's own side, up and forward.
fn own(v: DVec3) -> [f64; 3] {
    [-v.x, v.y, v.z]
}
