//! The document that files of points and numbers become: tracks on one clock, and events.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::{
    AxisDirection, CurveTrack, FrameNumberColumn, FrameRate, MarkerTrack, MotionMarker, RecordingInstant, SignerAxes,
    SpaceConvention, TimeSpan,
};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use glam::DVec3;

use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier};

/// The contents of a file of captured points or numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CapturedTracks {
    /// The tracks in the order of the file.
    pub tracks: Vec<FileTrack>,
    /// Named moments of the file as tiers, if it has any.
    pub events: Option<AnnotationTranscript>,
}

/// One track of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct FileTrack {
    /// The name, unique in its document.
    pub name: String,
    /// The time of its first frame, from the start of the file.
    pub offset: RecordingInstant,
    /// The time of day of its own time 0, if the file has timecodes.
    pub clock: Option<RecordingInstant>,
    /// Its frames.
    pub content: CapturedTrackContent,
}

/// The frames of a track.
#[derive(Debug, Clone, PartialEq)]
pub enum CapturedTrackContent {
    /// Named points.
    Markers(MarkerTrack),
    /// Named numbers.
    Curves(CurveTrack),
}

/// Returns the remedy for axes that a file does not state.
pub(crate) fn say_axes() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::Axes,
        "say the axes with --axes, such as --axes +Z,+X: up, and the signer's left",
    )
}

/// Returns the finding that the caller's rate of a film is taken instead of that of its file.
#[must_use]
pub fn another_rate(stated: FrameRate, taken: FrameRate) -> ImportFinding {
    ImportFinding::new_warning_finding(
        None,
        format!("the file states {stated}; the rate that was asked for is taken: {taken}"),
    )
}

impl FileTrack {
    /// Returns a track that begins with its file.
    #[must_use]
    pub fn new(name: impl Into<String>, content: CapturedTrackContent) -> Self {
        Self {
            name: name.into(),
            offset: RecordingInstant::RECORDING_START,
            clock: None,
            content,
        }
    }
}

/// Returns a number of frames per second as a fraction; the 1000/1001 rates of film are recognised.
pub(crate) fn rate_of(per_second: f64) -> Option<FrameRate> {
    if !per_second.is_finite() || per_second <= 0.0 || per_second > 1e6 {
        return None;
    }
    let near = |value: f64| (value - per_second).abs() <= 1e-5 * per_second;
    let whole_rate = per_second.round();
    if whole_rate >= 1.0 && near(whole_rate) {
        return FrameRate::new(whole_rate as u32, 1).ok();
    }
    let film = (per_second * 1.001).round();
    if film >= 1.0 && near(film / 1.001) && film <= 4e6 {
        return FrameRate::new((film * 1000.0) as u32, 1001).ok();
    }
    let scaled = (per_second * 1000.0).round();
    if (1.0..=4e9).contains(&scaled) {
        return FrameRate::new(scaled as u32, 1000).ok();
    }
    None
}

/// Returns the metres of a unit of length by its name, such as `mm`, `(cm)` or `Inches`.
pub(crate) fn metres_of_unit(name: &str) -> Option<f64> {
    let name = name.trim_matches(|letter: char| !letter.is_alphabetic());
    Some(match name.to_lowercase().as_str() {
        "m" | "meter" | "meters" | "metre" | "metres" => 1.0,
        "dm" | "decimeter" | "decimeters" | "decimetre" | "decimetres" => 0.1,
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => 0.01,
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => 0.001,
        "in" | "inch" | "inches" => 0.0254,
        "ft" | "foot" | "feet" => 0.3048,
        _ => return None,
    })
}

/// Returns moments as annotations of one frame each on a tier called `name`.
pub(crate) fn events_to_transcript(
    name: &str,
    moments: &[(RecordingInstant, String)],
    rate: FrameRate,
) -> Option<AnnotationTranscript> {
    if moments.is_empty() {
        return None;
    }
    let mut moments = moments.to_vec();
    moments.sort();
    let frame = RecordingInstant::from_seconds(rate.frame_time())
        .instant_micros()
        .max(1);
    let annotations = (1..).zip(&moments).map(|(number, (at, value))| {
        let next = moments.get(number).map(|(next, _)| *next);
        let frame_end = at.shifted_instant(frame);
        let end = next
            .filter(|next| *next > *at)
            .map_or(frame_end, |next| next.min(frame_end));
        TranscriptAnnotation {
            id: format!("a{number}"),
            span: TimeSpan::span_between(*at, end),
            timing: AnnotationTiming::Own,
            parent: None,
            order: 0,
            value: value.clone(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        }
    });
    let mut annotations: Vec<TranscriptAnnotation> = annotations.collect();
    // Events at the same moment share an annotation: a tier holds only one at a time.
    annotations.dedup_by(|later, before| {
        let same = later.span.span_start_instant() == before.span.span_start_instant();
        if same {
            before.value = format!("{}, {}", before.value, later.value);
        }
        same
    });
    let tier = TranscriptTier {
        name: name.to_owned(),
        kind: name.to_owned(),
        annotations,
        ..TranscriptTier::default()
    };
    Some(AnnotationTranscript {
        tiers: vec![tier],
        ..AnnotationTranscript::default()
    })
}

/// Returns names without repetition; empty ones become `word 1` and so on.
pub(crate) fn unique_track_names<'a>(names: impl Iterator<Item = &'a str>, word: &str) -> Vec<String> {
    let mut seen = BTreeSet::new();
    // The last number of a name, so that a name that occurs a million times is numbered in one pass.
    let mut last: BTreeMap<String, u64> = BTreeMap::new();
    let named = (1..).zip(names).map(|(at, name)| {
        let wanted = if name.is_empty() {
            format!("{word} {at}")
        } else {
            name.to_owned()
        };
        if seen.insert(wanted.clone()) {
            return wanted;
        }
        let mut unique = wanted.clone();
        let count = last.entry(wanted.clone()).or_insert(1);
        while !seen.insert(unique.clone()) {
            *count += 1;
            unique = format!("{wanted} ({count})");
        }
        unique
    });
    named.collect()
}

/// Returns axes with `up` as their vertical; pairs of markers such as LSHO and RSHO show which direction is left.
pub(crate) fn axes_with_up(markers: &[MotionMarker], up: AxisDirection, findings: &mut FindingTally) -> SignerAxes {
    if let Some(axes) = left_of(markers, up).and_then(|left| SignerAxes::new(up, left)) {
        return axes;
    }
    findings.push_note_finding(
        None,
        "no pair of markers such as LSHO and RSHO shows which side is left; the first axis that fits is taken",
    );
    let all = ["+Z,+X", "+Y,+X", "+X,+Y", "-Z,+X", "-Y,+X", "-X,+Y"];
    let fits = all
        .iter()
        .filter_map(|text| text.parse::<SignerAxes>().ok())
        .find(|axes| axes.up_direction() == up);
    fits.unwrap_or(SpaceConvention::MODEL_CONVENTION.axes)
}

/// Returns the direction from the feet to head and shoulders, if markers have such names.
pub(crate) fn up_of(markers: &[MotionMarker]) -> Option<AxisDirection> {
    let high = ["HEAD", "LFHD", "RFHD", "SHO", "C7", "CLAV", "ACR", "STRN", "ACROM"];
    let low = ["HEE", "TOE", "ANK", "FOOT", "CALC", "MTP", "KNE"];
    let mean = |words: &[&str]| {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for marker in markers {
            let name = split_label(&marker.name).1.to_uppercase();
            if !words.iter().any(|word| name.contains(word)) {
                continue;
            }
            let frames = marker.place.first().map_or(0, FrameNumberColumn::len);
            if let Some(at) = (0..frames).find_map(|frame| marker.marker_position(frame)) {
                sum += at;
                count += 1.0;
            }
        }
        (count > 0.0).then(|| sum / count)
    };
    Some(AxisDirection::nearest_axis_direction(mean(&high)? - mean(&low)?))
}

/// Splits a marker's name such as `Anna:LSHO` into the subject with its colon, which may be empty, and the label.
fn split_label(name: &str) -> (&str, &str) {
    name.split_at(name.rfind(':').map_or(0, |colon| colon + 1))
}

/// Returns the direction from right to left, from pairs of markers whose names differ by L and R. A name of a letter and
/// a number does not count as one of a pair: L1 and R1 may be the little and the ring finger, or a vertebra.
fn left_of(markers: &[MotionMarker], up: AxisDirection) -> Option<AxisDirection> {
    let mut sum = DVec3::ZERO;
    let up = up.axis_direction_vector();
    let names: Vec<String> = markers.iter().map(|marker| marker.name.to_lowercase()).collect();
    let mut markers_by_name: BTreeMap<(&str, &str), &MotionMarker> = BTreeMap::new();
    for (marker, name) in markers.iter().zip(&names) {
        markers_by_name.entry((&marker.group, name)).or_insert(marker);
    }
    for (left, name) in markers.iter().zip(&names) {
        let Some(other) = other_side(name) else {
            continue;
        };
        let Some(right) = markers_by_name.get(&(left.group.as_str(), other.as_str())) else {
            continue;
        };
        let frames = left.place.first().map_or(0, FrameNumberColumn::len);
        let both = (0..frames).find_map(|frame| Some(left.marker_position(frame)? - right.marker_position(frame)?));
        sum += both.unwrap_or(DVec3::ZERO).normalize_or_zero();
    }
    let across = sum - up * sum.dot(up);
    (across.length() > 0.5).then(|| AxisDirection::nearest_axis_direction(across))
}

/// Returns the name of the right marker for the name of a left one in small letters.
fn other_side(name: &str) -> Option<String> {
    let (subject, label) = split_label(name);
    let begins = [("left", "right"), ("l", "r")];
    let ends = [("left", "right"), ("_l", "_r"), (".l", ".r"), (" l", " r")];
    let begin = begins
        .iter()
        .find_map(|(left, right)| Some((label.strip_prefix(left)?, *right)));
    let end = ends
        .iter()
        .find_map(|(left, right)| Some((label.strip_suffix(left)?, *right)));
    let (rest, other) = match (begin, end) {
        (_, Some((rest, right))) => (rest, format!("{subject}{rest}{right}")),
        (Some((rest, right)), None) => (rest, format!("{subject}{right}{rest}")),
        (None, None) => return None,
    };
    rest.chars().any(char::is_alphabetic).then_some(other)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marker(name: &str, at: DVec3) -> MotionMarker {
        let place = at
            .to_array()
            .map(|x| FrameNumberColumn::from_double_floats(vec![x]))
            .to_vec();
        MotionMarker::new(name.to_owned(), place)
    }

    #[test]
    fn shoulders_show_which_side_is_left_and_numbered_fingers_do_not() {
        let pair = |left: &str, right: &str| {
            let both = [marker(left, DVec3::Z), marker(right, DVec3::NEG_Z)];
            left_of(&both, "+Y".parse().expect("a direction"))
        };
        assert_eq!(pair("LSHO", "RSHO"), Some("+Z".parse().expect("a direction")));
        assert_eq!(pair("l_wrist", "r_wrist"), Some("+Z".parse().expect("a direction")));
        assert_eq!(pair("Anna:LSHO", "Anna:RSHO"), Some("+Z".parse().expect("a direction")));
        for (left, right) in [
            ("lsho", "rsho"),
            ("anna:lsho", "anna:rsho"),
            ("Sho_L", "Sho_R"),
            ("Shoulder.l", "Shoulder.r"),
            ("shoulder_left", "shoulder_right"),
            ("LeftShoulder", "RightShoulder"),
        ] {
            assert_eq!(pair(left, right), Some("+Z".parse().expect("a direction")), "{left}");
        }
        assert_eq!(pair("L1", "R1"), None);
        assert_eq!(pair("Lena:LSHO", "Rita:RSHO"), None);
    }

    #[test]
    fn the_subject_of_a_label_does_not_show_which_direction_is_up() {
        let markers = [marker("HeeSho:LFHD", DVec3::Y), marker("HeeSho:LTOE", DVec3::NEG_Y)];
        assert_eq!(up_of(&markers), Some("+Y".parse().expect("a direction")));
    }
}
