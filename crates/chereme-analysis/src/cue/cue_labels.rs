//! The names of the markers: 50 on hand and forearm, 63 on the face.

/// The forearm: FA1-FA5.
pub const FOREARM_MARKERS: std::ops::Range<usize> = 0..5;
/// The back of the hand: HB1-HB4 on the knuckles from index to little finger, HB5-HB7 between them and the wrist.
pub const HAND_BACK_MARKERS: std::ops::Range<usize> = 5..12;
/// The number of hand markers, including those of the forearm.
pub const HAND_MARKER_COUNT: usize = 50;
/// The number of face markers.
pub const FACE_MARKER_COUNT: usize = 63;

/// Returns the index of a finger's first marker; fingers count from 0 (index) to 3 (little finger). There are 3 markers
/// on the first phalange, 3 on the middle one and 2 on the last; the second of the last two is the tip.
#[must_use]
pub fn first_finger_marker(finger: usize) -> usize {
    12 + 8 * finger
}

/// The thumb: T1-T6, two on each part; the last is the tip.
pub const FIRST_THUMB_MARKER: usize = 44;

/// Returns the names of the hand's markers in order.
#[must_use]
pub fn hand_marker_names() -> Vec<String> {
    numbered_marker_names(&[("FA", 5), ("HB", 7), ("I", 8), ("M", 8), ("R", 8), ("L", 8), ("T", 6)])
}

/// Returns the names of the face's markers in order: forehead, nose and ears (rigid), lips, cheeks, jaw, throat.
#[must_use]
pub fn face_marker_names() -> Vec<String> {
    numbered_marker_names(&[
        ("RF", 5),
        ("RN", 2),
        ("RE", 2),
        ("LP", 16),
        ("CK", 12),
        ("JW", 8),
        ("TH", 18),
    ])
}

/// The rigid markers of the head.
pub const RIGID_HEAD_MARKERS: std::ops::Range<usize> = 0..9;
/// The lips: 9 (LP1) and 17 (LP9) are the corners, LP2-LP8 the upper lip, LP10-LP16 the lower.
pub const LIP_MARKERS: std::ops::Range<usize> = 9..25;
/// The cheeks.
pub const CHEEK_MARKERS: std::ops::Range<usize> = 25..37;
/// The jaw.
pub const JAW_MARKERS: std::ops::Range<usize> = 37..45;
/// The throat.
pub const THROAT_MARKERS: std::ops::Range<usize> = 45..63;

fn numbered_marker_names(groups: &[(&str, usize)]) -> Vec<String> {
    let each = groups.iter();
    each.flat_map(|(name, count)| (1..=*count).map(move |n| format!("{name}{n}")))
        .collect()
}

/// Returns the index of each wanted name among the labels of a file, or nothing if the file lacks it. Case, blanks and
/// a subject's name before a colon are ignored.
#[must_use]
pub fn match_cue_labels(wanted: &[String], labels: &[&str]) -> Vec<Option<usize>> {
    let plain = |label: &str| {
        let bare_label = label.rsplit(':').next().unwrap_or(label);
        bare_label.trim().to_lowercase()
    };
    let plain_labels: Vec<String> = labels.iter().map(|label| plain(label)).collect();
    wanted
        .iter()
        .map(|name| plain_labels.iter().position(|label| *label == plain(name)))
        .collect()
}
