//! Movement for the page's player: the surface of a body once for each skeleton, and the rotations of its bones for each
//! sign, in whole numbers.

use chereme_figure::camera::FigureCamera;
use chereme_figure::{BoneMotion, ClipFraming, FaceMorph, FigureView, PortableBody, PortableBone, SignerBody};
use chereme_motion::glam::{Quat, Vec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, Clip, FacePosture, FrameRate, ModelPose};
use serde_json::{Value, json};

use super::codes::{push_close_row, push_coded_number, push_row};
use crate::error::{CorpusError, CorpusResult};
use crate::page::encode_base64;

/// The most frames per second that the page gets.
const MAX_PUBLISHED_FPS: u32 = 60;
/// The most frames of a sign: a minute at that rate.
const MAX_PUBLISHED_FRAMES: usize = 3600;
/// Whole numbers per unit of a quaternion's part: half a step is 0.007 degrees.
const QUATERNION_SCALE: f32 = 8192.0;
/// Whole numbers per metre of a bone's offset.
const BONE_OFFSET_SCALE: f32 = 5000.0;
/// How far a number of the movement may be from its own: about 0.02 degrees of a rotation, 0.2 millimetres of an offset.
const MOTION_TOLERANCE: i64 = 1;
/// Whole numbers per metre of the surface.
const SURFACE_POINT_SCALE: f32 = 10_000.0;

/// Whole numbers per metre of a change of the face.
const MORPH_OFFSET_SCALE: f32 = 4000.0;
/// Whole numbers per unit of a number of a face.
const FACE_NUMBER_SCALE: f64 = 100.0;

/// Returns the faces of a movement in the frames of `clip`, which has the same length at another rate or its first part.
pub(super) fn published_faces(clip: &Clip, faces: &[FacePosture], rate: FrameRate) -> Vec<FacePosture> {
    let face_at = |frame: usize| {
        let moment = clip.clip_frame_rate().frame_start_instant(frame);
        FacePosture::face_at_moment(faces, rate, moment).unwrap_or_default()
    };
    (0..clip.clip_frame_count()).map(face_at).collect()
}

/// Returns the clip in the frames that the page gets, at most sixty a second and 3,600 in all, and whether it is cut.
pub(super) fn limit_published_frames(clip: &Clip) -> CorpusResult<(Clip, bool)> {
    // Rates such as 60.02 count as sixty, since resampling would only blur them.
    let fast = clip.clip_frame_rate().per_second() > f64::from(MAX_PUBLISHED_FPS) + 0.5;
    let rate =
        FrameRate::new(MAX_PUBLISHED_FPS, 1).map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
    let clip = if fast { clip.resample_clip(rate) } else { clip.clone() };
    let frames = clip.clip_frame_count().min(MAX_PUBLISHED_FRAMES);
    Ok((clip.slice_clip_frames(0..frames), frames < clip.clip_frame_count()))
}

/// Returns the surface of a body as JSON.
pub(super) fn body_surface_json(body: &PortableBody) -> Value {
    let mut bytes = Vec::new();
    for axis in 0..3 {
        let places = body
            .vertices
            .iter()
            .map(|vertex| scale_to_integer(vertex.place[axis], SURFACE_POINT_SCALE));
        push_row(&mut bytes, &places.collect::<Vec<_>>());
    }
    for channel in 0..3 {
        let colours = body.vertices.iter().map(|vertex| i64::from(vertex.colour.0[channel]));
        push_row(&mut bytes, &colours.collect::<Vec<_>>());
    }
    let weights: Vec<[i64; 4]> = body
        .vertices
        .iter()
        .map(|vertex| weight_shares(vertex.weights))
        .collect();
    for slot in 0..4 {
        let bones = body.vertices.iter().map(|vertex| i64::from(vertex.bones[slot]));
        push_row(&mut bytes, &bones.collect::<Vec<_>>());
        let weights = weights.iter().map(|vertex_weights| vertex_weights[slot]);
        push_row(&mut bytes, &weights.collect::<Vec<_>>());
    }
    let mut before = 0;
    for corner in body.triangles.iter().flatten() {
        // Neighbouring corners have similar numbers, so their differences take fewer bytes.
        push_coded_number(&mut bytes, i64::from(*corner) - before);
        before = i64::from(*corner);
    }
    json!({
        "vertices": body.vertices.len(), "triangles": body.triangles.len(),
        "bones": body.bones.iter().map(bone_motion_json).collect::<Vec<_>>(), "data": encode_base64(&bytes),
    })
}

/// Returns the changes of a body's face as JSON.
pub(super) fn face_morphs_json(morphs: &[FaceMorph]) -> Value {
    let mut bytes = Vec::new();
    for morph in morphs {
        let vertices = morph.vertices.iter().map(|vertex| *vertex as i64);
        push_row(&mut bytes, &vertices.collect::<Vec<_>>());
        for axis in 0..3 {
            let offsets = morph
                .offsets
                .iter()
                .map(|offset| scale_to_integer(offset[axis], MORPH_OFFSET_SCALE));
            push_row(&mut bytes, &offsets.collect::<Vec<_>>());
        }
    }
    let morph_json = |morph: &FaceMorph| json!({ "n": morph.number, "s": if morph.is_negative { -1 } else { 1 }, "l": morph.vertices.len() });
    json!({ "morphs": morphs.iter().map(morph_json).collect::<Vec<_>>(), "data": encode_base64(&bytes) })
}

/// Returns weights as whole numbers whose sum is 255: a body one metre above the floor would move by 4 mm for each
/// missing one. The first weight is the largest.
fn weight_shares(weights: [f32; 4]) -> [i64; 4] {
    let mut shares = weights.map(|weight| scale_to_integer(weight, 255.0));
    shares[0] = 255 - shares[1..].iter().sum::<i64>();
    shares
}

fn bone_motion_json(bone: &PortableBone) -> Value {
    let point = |vector: Vec3| vector.to_array().map(|coordinate| round_decimals(coordinate, 6));
    match *bone {
        PortableBone::Keyed { parent, from, at } => json!({
            "k": parent.map_or(-1, |index| index as i64), "f": point(from), "a": point(at)
        }),
        PortableBone::Same(other) => json!({ "s": other }),
        PortableBone::Between { ends, share } => {
            json!({ "b": ends, "t": round_decimals(share, 6) })
        }
        PortableBone::Half {
            parent,
            child,
            at,
            along,
            swell,
        } => json!({
            "h": [parent, child], "a": point(at), "l": point(along), "w": round_decimals(swell, 6)
        }),
    }
}

/// Returns a number with a few decimals, so that the same number is always written the same.
fn round_decimals(number: f32, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    (f64::from(number) * scale).round() / scale + 0.0
}

fn scale_to_integer(number: f32, scale: f32) -> i64 {
    (number * scale).round() as i64
}

/// Returns the movement of a clip on its body as JSON: rate, frames, cameras, the numbers of the face that move, and all
/// numbers in base64. `faces` has a face for each frame.
pub(super) fn coded_motion_json(
    clip: &Clip,
    faces: &[FacePosture],
    anatomy: &BodyAnatomy,
    body: &SignerBody,
    portable: &PortableBody,
) -> Value {
    let frames = clip.clip_frame_count();
    let keyed = |frame: usize| body.bone_motions(portable, &clip.model_pose(frame));
    let mut motions: Vec<Vec<BoneMotion>> = (0..frames).map(keyed).collect();
    continuous(&mut motions);
    let mut bytes = encode_bone_motions(&motions);
    let face_rows: Vec<[f64; FacePosture::FACE_NUMBER_COUNT]> = faces.iter().map(FacePosture::face_numbers).collect();
    let mut moving_numbers = Vec::new();
    for number in 0..FacePosture::FACE_NUMBER_COUNT {
        let values = face_rows
            .iter()
            .map(|row| (row[number] * FACE_NUMBER_SCALE).round() as i64);
        let values: Vec<i64> = values.collect();
        if values.iter().any(|value| *value != 0) {
            moving_numbers.push(number);
            push_close_row(&mut bytes, &values, 1);
        }
    }
    let mut cameras = serde_json::Map::new();
    if let Some((framing, pose)) = shared_framing(clip, anatomy) {
        let views = [
            ("front", FigureView::Addressee),
            ("side", FigureView::Right),
            ("face", FigureView::Face),
        ];
        for (name, view) in views {
            let seen = framing.framing_camera(view, 0.8, &pose, anatomy);
            cameras.insert(name.to_owned(), camera_json(&seen));
        }
        let side = busier(clip, anatomy);
        let seen = framing.framing_camera(FigureView::Hand(side), 0.8, &pose, anatomy);
        cameras.insert("hands".to_owned(), hands_camera(clip, anatomy, &seen));
    }
    json!({
        "rate": round_decimals(clip.clip_frame_rate().per_second() as f32, 4), "frames": frames,
        "cameras": cameras, "face": moving_numbers, "data": encode_base64(&bytes),
    })
}

/// Returns the space that pictures of a movement show, the same for most movements of a body, and the posture of its
/// stroke; nothing without frames.
pub(super) fn shared_framing(clip: &Clip, anatomy: &BodyAnatomy) -> Option<(ClipFraming, ModelPose)> {
    let framing = ClipFraming::framing_from_clip(clip, anatomy)?;
    let pose = clip.model_pose(chereme_figure::stroke_frame(clip, anatomy).min(clip.clip_frame_count() - 1));
    Some((framing.with_usual_signing_room(&pose, anatomy), pose))
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
fn encode_bone_motions(motions: &[Vec<BoneMotion>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for bone in 0..motions.first().map_or(0, Vec::len) {
        let mut push = |part: &dyn Fn(&BoneMotion) -> i64| {
            let row: Vec<i64> = motions.iter().map(|frame| part(&frame[bone])).collect();
            push_close_row(&mut bytes, &row, MOTION_TOLERANCE);
        };
        for axis in 0..4 {
            push(&|motion| scale_to_integer(motion.turn.to_array()[axis], QUATERNION_SCALE));
        }
        for axis in 0..3 {
            push(&|motion| scale_to_integer(motion.off[axis], BONE_OFFSET_SCALE));
        }
    }
    bytes
}

fn camera_json(it: &FigureCamera) -> Value {
    let point = |vector: Vec3| vector.to_array().map(|coordinate| round_decimals(coordinate, 4));
    json!({
        "eye": point(it.eye), "target": point(it.target), "up": point(it.up),
        "half": round_decimals(it.half_height, 4),
    })
}

/// Returns a camera near the hands: it has the direction of a hand's view, and shows both hands if both are up.
fn hands_camera(clip: &Clip, anatomy: &BodyAnatomy, near: &FigureCamera) -> Value {
    let towards = near.eye - near.target;
    let hips = anatomy.part_joint(BodyPart::Hips);
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for frame in 0..clip.clip_frame_count() {
        let pose = clip.model_pose(frame);
        let floor = hips.map(|joint| pose.model_joint_position(joint).y as f32 + 0.08);
        for side in BodySide::BOTH_SIDES {
            let joints = anatomy.part_joint(BodyPart::Hand(side)).into_iter();
            for joint in joints.chain(anatomy.possible_fingers(side)) {
                let place = pose.model_joint_position(joint).as_vec3();
                if floor.is_none_or(|floor| place.y > floor) {
                    (low, high) = (low.min(place), high.max(place));
                }
            }
        }
    }
    if low.cmpgt(high).any() {
        return camera_json(near);
    }
    let size = high - low;
    let hand_half = (size.y / 2.0).max(size.x / 1.6) + 0.06;
    let half = hand_half.max(near.half_height * 0.9);
    let target = (low + high) / 2.0;
    camera_json(&FigureCamera {
        eye: target + towards.normalize_or(Vec3::Z) * (half * 7.0),
        target,
        half_height: half,
        ..*near
    })
}

/// Returns the side whose hand moves farther.
fn busier(clip: &Clip, anatomy: &BodyAnatomy) -> BodySide {
    let travel = |side: BodySide| {
        let hand_path = anatomy
            .part_joint(BodyPart::Hand(side))
            .map(|joint| clip.joint_path(joint));
        let path = hand_path.unwrap_or_default();
        let steps = path.windows(2).map(|pair| pair[0].distance(pair[1]));
        steps.sum::<f64>()
    };
    match travel(BodySide::Left) > 1.2 * travel(BodySide::Right) {
        true => BodySide::Left,
        false => BodySide::Right,
    }
}

#[cfg(test)]
mod tests {
    use super::super::codes::tests::CodeReader;
    use super::*;
    use crate::starter_signs;

    /// Reads the motions back, as the page does.
    fn read(bytes: &[u8], bones: usize, frames: usize) -> Vec<Vec<BoneMotion>> {
        let mut reader = CodeReader(bytes);
        let still = BoneMotion {
            turn: Quat::IDENTITY,
            off: Vec3::ZERO,
        };
        let mut motions = vec![vec![still; bones]; frames];
        for bone in 0..bones {
            let rows: Vec<Vec<i64>> = (0..7).map(|_| reader.decode_number_row(frames)).collect();
            for (frame, motion) in motions.iter_mut().enumerate() {
                let part = |at: usize| rows[at][frame] as f32;
                motion[bone] = BoneMotion {
                    turn: Quat::from_array([0, 1, 2, 3].map(part)).normalize(),
                    off: Vec3::from_array([4, 5, 6].map(part)) / BONE_OFFSET_SCALE,
                };
            }
        }
        assert!(reader.0.is_empty());
        motions
    }

    #[test]
    fn weights_are_complete() {
        for weights in [[1.0, 0.0, 0.0, 0.0], [0.3334, 0.3333, 0.3333, 0.0], [0.25; 4]] {
            let shares = weight_shares(weights);
            assert_eq!(shares.iter().sum::<i64>(), 255);
            for (share, weight) in shares.iter().zip(weights) {
                assert!((*share as f32 / 255.0 - weight).abs() < 0.008);
            }
        }
    }

    #[test]
    fn a_long_movement_is_cut_and_known_to_be() {
        let sign = starter_signs().next().expect("a sign").expect("a sign");
        let (whole, is_cut) = limit_published_frames(&sign.clip).expect("frames");
        assert!(!is_cut && whole.clip_frame_count() == sign.clip.clip_frame_count());
        let long = |frames: usize| {
            let skeleton = sign.clip.clip_skeleton().clone();
            let channels = skeleton.skeleton_joints().iter().map(|_| chereme_motion::JointChannel {
                rotations: vec![chereme_motion::glam::DQuat::IDENTITY; frames],
                translations: None,
            });
            let rate = FrameRate::new(30, 1).expect("a rate");
            Clip::new(skeleton.clone(), rate, channels.collect()).expect("a clip")
        };
        for (frames, cut) in [(MAX_PUBLISHED_FRAMES, false), (MAX_PUBLISHED_FRAMES + 1, true)] {
            let (clip, is_cut) = limit_published_frames(&long(frames)).expect("frames");
            assert_eq!((clip.clip_frame_count(), is_cut), (MAX_PUBLISHED_FRAMES, cut));
        }
    }

    #[test]
    fn coded_movement_is_within_a_tenth_of_a_degree_and_a_millimetre() {
        let (mut angle, mut distance) = (0.0_f32, 0.0_f32);
        for sign in starter_signs().take(3) {
            let sign = sign.expect("a sign");
            let (clip, _) = limit_published_frames(&sign.clip).expect("frames");
            let body = SignerBody::new(clip.clip_skeleton(), &sign.anatomy);
            let portable = body.to_portable_body(clip.clip_skeleton()).expect("two arms");
            let keyed = |frame: usize| body.bone_motions(&portable, &clip.model_pose(frame));
            let mut exact: Vec<_> = (0..clip.clip_frame_count()).map(keyed).collect();
            continuous(&mut exact);
            let bytes = encode_bone_motions(&exact);
            let coded = read(&bytes, exact[0].len(), exact.len());
            for (exact, coded) in exact.iter().zip(&coded).step_by(5) {
                for (a, b) in exact.iter().zip(coded) {
                    angle = angle.max(a.turn.angle_between(b.turn).to_degrees());
                }
                let [a, b] = [exact, coded].map(|it| portable.posed_vertices(it));
                distance = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).fold(distance, f32::max);
            }
        }
        println!("angle {angle} degrees, distance {} mm", distance * 1e3);
        assert!(angle <= 0.1, "{angle} degrees");
        assert!(distance <= 0.001, "{distance} m");
    }
}
