//! Names of the points of OpenPose and MediaPipe, and the limbs between them.

use std::collections::BTreeMap;

use chereme_motion::MotionMarker;

const BODY_25: [&str; 25] = [
    "Nose",
    "Neck",
    "RShoulder",
    "RElbow",
    "RWrist",
    "LShoulder",
    "LElbow",
    "LWrist",
    "MidHip",
    "RHip",
    "RKnee",
    "RAnkle",
    "LHip",
    "LKnee",
    "LAnkle",
    "REye",
    "LEye",
    "REar",
    "LEar",
    "LBigToe",
    "LSmallToe",
    "LHeel",
    "RBigToe",
    "RSmallToe",
    "RHeel",
];
const COCO_POINT_NAMES: [&str; 18] = [
    "Nose",
    "Neck",
    "RShoulder",
    "RElbow",
    "RWrist",
    "LShoulder",
    "LElbow",
    "LWrist",
    "RHip",
    "RKnee",
    "RAnkle",
    "LHip",
    "LKnee",
    "LAnkle",
    "REye",
    "LEye",
    "REar",
    "LEar",
];
const POSE_33: [&str; 33] = [
    "NOSE",
    "LEFT_EYE_INNER",
    "LEFT_EYE",
    "LEFT_EYE_OUTER",
    "RIGHT_EYE_INNER",
    "RIGHT_EYE",
    "RIGHT_EYE_OUTER",
    "LEFT_EAR",
    "RIGHT_EAR",
    "MOUTH_LEFT",
    "MOUTH_RIGHT",
    "LEFT_SHOULDER",
    "RIGHT_SHOULDER",
    "LEFT_ELBOW",
    "RIGHT_ELBOW",
    "LEFT_WRIST",
    "RIGHT_WRIST",
    "LEFT_PINKY",
    "RIGHT_PINKY",
    "LEFT_INDEX",
    "RIGHT_INDEX",
    "LEFT_THUMB",
    "RIGHT_THUMB",
    "LEFT_HIP",
    "RIGHT_HIP",
    "LEFT_KNEE",
    "RIGHT_KNEE",
    "LEFT_ANKLE",
    "RIGHT_ANKLE",
    "LEFT_HEEL",
    "RIGHT_HEEL",
    "LEFT_FOOT_INDEX",
    "RIGHT_FOOT_INDEX",
];
const HAND_FINGER_NAMES: [&str; 5] = ["THUMB", "INDEX_FINGER", "MIDDLE_FINGER", "RING_FINGER", "PINKY"];
const KEYPOINT_FINGER_SEGMENTS: [&str; 4] = ["MCP", "PIP", "DIP", "TIP"];
const KEYPOINT_THUMB_SEGMENTS: [&str; 4] = ["CMC", "MCP", "IP", "TIP"];

/// Limbs of the body, by the names of their ends.
const BODY_LIMB_NAMES: [(&str, &str); 12] = [
    ("Nose", "Neck"),
    ("Neck", "RShoulder"),
    ("RShoulder", "RElbow"),
    ("RElbow", "RWrist"),
    ("Neck", "LShoulder"),
    ("LShoulder", "LElbow"),
    ("LElbow", "LWrist"),
    ("Neck", "MidHip"),
    ("LEFT_SHOULDER", "RIGHT_SHOULDER"),
    ("LEFT_SHOULDER", "LEFT_ELBOW"),
    ("RIGHT_SHOULDER", "RIGHT_ELBOW"),
    ("LEFT_ELBOW", "LEFT_WRIST"),
];

/// Returns the name of a point of a hand: 0 is the wrist, then four for each finger.
fn keypoint_hand_name(at: usize) -> String {
    match at {
        0 => "WRIST".to_owned(),
        at => {
            let (finger, segment) = ((at - 1) / 4, (at - 1) % 4);
            let word = if finger == 0 {
                KEYPOINT_THUMB_SEGMENTS
            } else {
                KEYPOINT_FINGER_SEGMENTS
            }[segment];
            format!("{}_{word}", HAND_FINGER_NAMES[finger.min(4)])
        }
    }
}

/// Returns the name of a point of OpenPose: that in its list of `count` points, else its number.
pub(super) fn openpose_point_name(group: &str, count: usize, at: usize) -> String {
    let body = group.starts_with("pose");
    match count {
        25 if body => BODY_25[at].to_owned(),
        18 if body => COCO_POINT_NAMES[at].to_owned(),
        21 if group.starts_with("hand") => keypoint_hand_name(at),
        _ => format!("point {at}"),
    }
}

/// Returns the name of a landmark of MediaPipe.
pub(super) fn mediapipe_point_name(group: &str, count: usize, at: usize) -> String {
    let lower = group.to_ascii_lowercase();
    match count {
        33 => POSE_33[at].to_owned(),
        21 if !lower.contains("face") => keypoint_hand_name(at),
        _ => format!("point {at}"),
    }
}

/// Returns the limbs between points of known names, within each group.
pub(super) fn limbs_between_points(points: &[MotionMarker]) -> Vec<[usize; 2]> {
    let points_by_name: BTreeMap<(&str, &str), usize> = points
        .iter()
        .enumerate()
        .map(|(at, point)| ((point.group.as_str(), point.name.as_str()), at))
        .collect();
    let mut limbs = Vec::new();
    let mut groups: Vec<&str> = points.iter().map(|point| point.group.as_str()).collect();
    groups.dedup();
    for group in groups {
        let find = |name: &str| points_by_name.get(&(group, name)).copied();
        let pairs = BODY_LIMB_NAMES.iter().map(|(from, to)| (find(from), find(to)));
        limbs.extend(pairs.filter_map(|(from, to)| Some([from?, to?])));
        for finger in 0..5 {
            let mut before = find("WRIST");
            for segment in 0..4 {
                let next = find(&keypoint_hand_name(1 + 4 * finger + segment));
                if let (Some(from), Some(to)) = (before, next) {
                    limbs.push([from, to]);
                }
                before = next;
            }
        }
    }
    limbs
}
