//! Movement for the page's player: the surface of a body once for each skeleton, and the rotations of its bones for each
//! sign, in whole numbers.

use chereme_figure::camera::Camera;
use chereme_figure::{Body, Bone, BoneMotion, Framing, PortableBody, View};
use chereme_motion::glam::{Quat, Vec3};
use chereme_motion::{Anatomy, Clip, Part, Rate, Side};
use serde_json::{Value, json};

use super::codes::{push, push_row};
use crate::error::{Error, Result};
use crate::page::base64;

/// The most frames per second that the page gets.
const FASTEST: u32 = 60;
/// The most frames of a sign: a minute at that rate.
const MOST: usize = 3600;
/// Whole numbers per unit of a quaternion's part: half a step is 0.007 degrees.
const TURN: f32 = 8192.0;
/// Whole numbers per metre of a bone's offset.
const OFF: f32 = 5000.0;
/// Whole numbers per metre of the surface.
const PLACE: f32 = 10_000.0;

/// Returns the clip in the frames that the page gets, at most sixty a second and 3,600 in all, and whether it is cut.
pub(super) fn shown(clip: &Clip) -> Result<(Clip, bool)> {
    let fast = clip.rate().per_second() > f64::from(FASTEST) + 0.5;
    let rate = Rate::new(FASTEST, 1).map_err(|error| Error::wrong(error.to_string()))?;
    let clip = if fast {
        clip.resampled(rate)
    } else {
        clip.clone()
    };
    let frames = clip.frames().min(MOST);
    Ok((clip.slice(0..frames), frames < clip.frames()))
}

/// Returns the surface of a body as JSON.
pub(super) fn surface(body: &PortableBody) -> Value {
    let mut bytes = Vec::new();
    for axis in 0..3 {
        let places = body.vertices.iter().map(|it| whole(it.place[axis], PLACE));
        push_row(&mut bytes, &places.collect::<Vec<_>>());
    }
    for channel in 0..3 {
        let colours = body
            .vertices
            .iter()
            .map(|it| i64::from(it.colour.0[channel]));
        push_row(&mut bytes, &colours.collect::<Vec<_>>());
    }
    let weights: Vec<[i64; 4]> = body.vertices.iter().map(|it| shares(it.weights)).collect();
    for slot in 0..4 {
        let bones = body.vertices.iter().map(|it| i64::from(it.bones[slot]));
        push_row(&mut bytes, &bones.collect::<Vec<_>>());
        let weights = weights.iter().map(|it| it[slot]);
        push_row(&mut bytes, &weights.collect::<Vec<_>>());
    }
    let mut before = 0;
    for corner in body.triangles.iter().flatten() {
        push(&mut bytes, i64::from(*corner) - before);
        before = i64::from(*corner);
    }
    json!({
        "vertices": body.vertices.len(), "triangles": body.triangles.len(),
        "bones": body.bones.iter().map(bone).collect::<Vec<_>>(), "data": base64(&bytes),
    })
}

/// Returns weights as whole numbers whose sum is 255: a body one metre above the floor would move by 4 mm for each
/// missing one. The first weight is the largest.
fn shares(weights: [f32; 4]) -> [i64; 4] {
    let mut shares = weights.map(|it| whole(it, 255.0));
    shares[0] = 255 - shares[1..].iter().sum::<i64>();
    shares
}

fn bone(bone: &Bone) -> Value {
    let point = |it: Vec3| it.to_array().map(|it| rounded(it, 6));
    match *bone {
        Bone::Keyed { parent, from, at } => json!({
            "k": parent.map_or(-1, |it| it as i64), "f": point(from), "a": point(at)
        }),
        Bone::Same(other) => json!({ "s": other }),
        Bone::Between { ends, share } => json!({ "b": ends, "t": rounded(share, 6) }),
        Bone::Half {
            parent,
            child,
            at,
            along,
            swell,
        } => json!({
            "h": [parent, child], "a": point(at), "l": point(along), "w": rounded(swell, 6)
        }),
    }
}

/// Returns a number with a few decimals, so that the same number is always written the same.
fn rounded(number: f32, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    (f64::from(number) * scale).round() / scale + 0.0
}

fn whole(number: f32, scale: f32) -> i64 {
    (number * scale).round() as i64
}

/// Returns the movement of a clip on its body as JSON: rate, frames, cameras, and numbers in base64.
pub(super) fn coded(
    clip: &Clip,
    anatomy: &Anatomy,
    (body, portable): (&Body, &PortableBody),
) -> Value {
    let frames = clip.frames();
    let keyed = |frame: usize| body.bone_motions(portable, &clip.model_pose(frame));
    let mut motions: Vec<Vec<BoneMotion>> = (0..frames).map(keyed).collect();
    continuous(&mut motions);
    let bytes = numbers(&motions);
    let mut cameras = serde_json::Map::new();
    if let Some(framing) = Framing::of(clip, anatomy) {
        let pose = clip.model_pose(chereme_figure::stroke(clip, anatomy).min(frames - 1));
        for (name, view) in [("front", View::Addressee), ("side", View::Right)] {
            let seen = framing.camera(view, 0.8, &pose, anatomy);
            cameras.insert(name.to_owned(), camera(&seen));
        }
        let side = busier(clip, anatomy);
        let seen = framing.camera(View::Hand(side), 0.8, &pose, anatomy);
        cameras.insert("hands".to_owned(), hand(clip, anatomy, &seen));
    }
    json!({
        "rate": rounded(clip.rate().per_second() as f32, 4), "frames": frames,
        "cameras": cameras, "data": base64(&bytes),
    })
}

/// Gives each quaternion the sign that is nearer to the one before it.
fn continuous(motions: &mut [Vec<BoneMotion>]) {
    for frame in 0..motions.len() {
        for bone in 0..motions[frame].len() {
            let before = match frame {
                0 => Quat::IDENTITY,
                _ => motions[frame - 1][bone].turn,
            };
            let turn = &mut motions[frame][bone].turn;
            if before.dot(*turn) < 0.0 {
                *turn = -*turn;
            }
        }
    }
}

/// Returns the motions as rows of numbers, one for each part of each bone.
fn numbers(motions: &[Vec<BoneMotion>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for bone in 0..motions.first().map_or(0, Vec::len) {
        let mut push = |part: &dyn Fn(&BoneMotion) -> i64| {
            let row: Vec<i64> = motions.iter().map(|frame| part(&frame[bone])).collect();
            push_row(&mut bytes, &row);
        };
        for axis in 0..4 {
            push(&|it| whole(it.turn.to_array()[axis], TURN));
        }
        for axis in 0..3 {
            push(&|it| whole(it.off[axis], OFF));
        }
    }
    bytes
}

fn camera(it: &Camera) -> Value {
    let point = |it: Vec3| it.to_array().map(|it| rounded(it, 4));
    json!({
        "eye": point(it.eye), "target": point(it.target), "up": point(it.up),
        "half": rounded(it.half_height, 4),
    })
}

/// Returns a camera near the hands: it has the direction of a hand's view, and shows both hands if both are up.
fn hand(clip: &Clip, anatomy: &Anatomy, near: &Camera) -> Value {
    let towards = near.eye - near.target;
    let hips = anatomy.joint(Part::Hips);
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for frame in 0..clip.frames() {
        let pose = clip.model_pose(frame);
        let floor = hips.map(|it| pose.position(it).y as f32 + 0.08);
        for side in Side::BOTH {
            let joints = anatomy.joint(Part::Hand(side)).into_iter();
            for joint in joints.chain(anatomy.possible_fingers(side)) {
                let at = pose.position(joint).as_vec3();
                if floor.is_none_or(|floor| at.y > floor) {
                    (low, high) = (low.min(at), high.max(at));
                }
            }
        }
    }
    if low.cmpgt(high).any() {
        return camera(near);
    }
    let size = high - low;
    let half = (size.y / 2.0).max(size.x / 1.6) + 0.06;
    let half = half.max(near.half_height * 0.9);
    let target = (low + high) / 2.0;
    camera(&Camera {
        eye: target + towards.normalize_or(Vec3::Z) * (half * 7.0),
        target,
        half_height: half,
        ..*near
    })
}

/// Returns the side whose hand moves farther.
fn busier(clip: &Clip, anatomy: &Anatomy) -> Side {
    let travel = |side: Side| {
        let path = anatomy.joint(Part::Hand(side)).map(|it| clip.path(it));
        let path = path.unwrap_or_default();
        let steps = path.windows(2).map(|it| it[0].distance(it[1]));
        steps.sum::<f64>()
    };
    match travel(Side::Left) > 1.2 * travel(Side::Right) {
        true => Side::Left,
        false => Side::Right,
    }
}

#[cfg(test)]
mod tests {
    use super::super::codes::Reader;
    use super::*;
    use crate::starter_signs;

    /// Reads the motions back, as the page does.
    fn read(bytes: &[u8], bones: usize, frames: usize) -> Vec<Vec<BoneMotion>> {
        let mut reader = Reader(bytes);
        let still = BoneMotion {
            turn: Quat::IDENTITY,
            off: Vec3::ZERO,
        };
        let mut motions = vec![vec![still; bones]; frames];
        for bone in 0..bones {
            let rows: Vec<Vec<i64>> = (0..7).map(|_| reader.row(frames)).collect();
            for (frame, motion) in motions.iter_mut().enumerate() {
                let part = |at: usize| rows[at][frame] as f32;
                motion[bone] = BoneMotion {
                    turn: Quat::from_array([0, 1, 2, 3].map(part)).normalize(),
                    off: Vec3::from_array([4, 5, 6].map(part)) / OFF,
                };
            }
        }
        assert!(reader.0.is_empty());
        motions
    }

    #[test]
    fn weights_are_complete() {
        for weights in [
            [1.0, 0.0, 0.0, 0.0],
            [0.3334, 0.3333, 0.3333, 0.0],
            [0.25; 4],
        ] {
            let shares = shares(weights);
            assert_eq!(shares.iter().sum::<i64>(), 255);
            for (share, weight) in shares.iter().zip(weights) {
                assert!((*share as f32 / 255.0 - weight).abs() < 0.008);
            }
        }
    }

    #[test]
    fn a_long_movement_is_cut_and_known_to_be() {
        let sign = starter_signs().next().expect("a sign").expect("a sign");
        let (whole, is_cut) = shown(&sign.clip).expect("frames");
        assert!(!is_cut && whole.frames() == sign.clip.frames());
        let long = |frames: usize| {
            let skeleton = sign.clip.skeleton().clone();
            let channels = skeleton.joints().iter().map(|_| chereme_motion::Channel {
                rotations: vec![chereme_motion::glam::DQuat::IDENTITY; frames],
                translations: None,
            });
            let rate = Rate::new(30, 1).expect("a rate");
            Clip::new(skeleton.clone(), rate, channels.collect()).expect("a clip")
        };
        for (frames, cut) in [(MOST, false), (MOST + 1, true)] {
            let (clip, is_cut) = shown(&long(frames)).expect("frames");
            assert_eq!((clip.frames(), is_cut), (MOST, cut));
        }
    }

    #[test]
    fn coded_movement_is_within_a_tenth_of_a_degree_and_a_millimetre() {
        let (mut angle, mut distance) = (0.0_f32, 0.0_f32);
        for sign in starter_signs().take(3) {
            let sign = sign.expect("a sign");
            let (clip, _) = shown(&sign.clip).expect("frames");
            let body = Body::new(clip.skeleton(), &sign.anatomy);
            let portable = body.portable(clip.skeleton()).expect("two arms");
            let keyed = |frame: usize| body.bone_motions(&portable, &clip.model_pose(frame));
            let mut exact: Vec<_> = (0..clip.frames()).map(keyed).collect();
            continuous(&mut exact);
            let bytes = numbers(&exact);
            let coded = read(&bytes, exact[0].len(), exact.len());
            for (exact, coded) in exact.iter().zip(&coded).step_by(5) {
                for (a, b) in exact.iter().zip(coded) {
                    angle = angle.max(a.turn.angle_between(b.turn).to_degrees());
                }
                let [a, b] = [exact, coded].map(|it| portable.posed(it));
                distance = a
                    .iter()
                    .zip(&b)
                    .map(|(a, b)| a.distance(*b))
                    .fold(distance, f32::max);
            }
        }
        println!("angle {angle} degrees, distance {} mm", distance * 1e3);
        assert!(angle <= 0.1, "{angle} degrees");
        assert!(distance <= 0.001, "{distance} m");
    }
}
