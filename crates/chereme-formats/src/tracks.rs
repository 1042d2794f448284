//! The document that files of points and numbers become: tracks on one clock, and events.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::{
    Axes, Column, Convention, Curves, Direction, Instant, Marker, Markers, Rate, Span,
};
use chereme_sign::{Choice, Remedy};
use glam::DVec3;

use crate::eaf::convert::{Annotation, Tier, Timing, Transcript};
use crate::finding::Finding;
use crate::tally::Findings;

/// The contents of a file of captured points or numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracks {
    /// The tracks in the order of the file.
    pub tracks: Vec<FileTrack>,
    /// Named moments of the file as tiers, if it has any.
    pub events: Option<Transcript>,
}

/// One track of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct FileTrack {
    /// The name, unique in its document.
    pub name: String,
    /// The time of its first frame, from the start of the file.
    pub offset: Instant,
    /// The time of day of its own time 0, if the file has timecodes.
    pub clock: Option<Instant>,
    /// Its frames.
    pub content: Content,
}

/// The frames of a track.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Named points.
    Markers(Markers),
    /// Named numbers.
    Curves(Curves),
}

/// Returns the remedy for axes that a file does not state.
pub(crate) fn say_axes() -> Remedy {
    Remedy::choice(
        Choice::Axes,
        "say the axes with --axes, such as --axes +Z,+X: up, and the signer's left",
    )
}

/// Returns the finding that the caller's rate of a film is taken instead of that of its file.
#[must_use]
pub fn another_rate(stated: Rate, taken: Rate) -> Finding {
    Finding::warning(
        None,
        format!("the file states {stated}; the rate that was asked for is taken: {taken}"),
    )
}

impl FileTrack {
    /// Returns a track that begins with its file.
    #[must_use]
    pub fn new(name: impl Into<String>, content: Content) -> Self {
        Self {
            name: name.into(),
            offset: Instant::ZERO,
            clock: None,
            content,
        }
    }
}

/// Returns a number of frames per second as a fraction; the 1000/1001 rates of film are recognised.
pub(crate) fn rate_of(per_second: f64) -> Option<Rate> {
    if !per_second.is_finite() || per_second <= 0.0 || per_second > 1e6 {
        return None;
    }
    let near = |value: f64| (value - per_second).abs() <= 1e-5 * per_second;
    let whole = per_second.round();
    if whole >= 1.0 && near(whole) {
        return Rate::new(whole as u32, 1).ok();
    }
    let film = (per_second * 1.001).round();
    if film >= 1.0 && near(film / 1.001) && film <= 4e6 {
        return Rate::new((film * 1000.0) as u32, 1001).ok();
    }
    let scaled = (per_second * 1000.0).round();
    if (1.0..=4e9).contains(&scaled) {
        return Rate::new(scaled as u32, 1000).ok();
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
pub(crate) fn events(name: &str, moments: &[(Instant, String)], rate: Rate) -> Option<Transcript> {
    if moments.is_empty() {
        return None;
    }
    let mut moments = moments.to_vec();
    moments.sort();
    let frame = Instant::from_seconds(rate.frame_time()).micros().max(1);
    let annotations = (1..).zip(&moments).map(|(number, (at, value))| {
        let next = moments.get(number).map(|(next, _)| *next);
        let end = at.shifted(frame);
        let end = next
            .filter(|next| *next > *at)
            .map_or(end, |next| next.min(end));
        Annotation {
            id: format!("a{number}"),
            span: Span::between(*at, end),
            timing: Timing::Own,
            parent: None,
            order: 0,
            value: value.clone(),
            entry: None,
            language: None,
            external_ref: None,
            millis: None,
        }
    });
    let mut annotations: Vec<Annotation> = annotations.collect();
    // Events at the same moment share an annotation: a tier holds only one at a time.
    annotations.dedup_by(|later, before| {
        let same = later.span.start() == before.span.start();
        if same {
            before.value = format!("{}, {}", before.value, later.value);
        }
        same
    });
    let tier = Tier {
        name: name.to_owned(),
        kind: name.to_owned(),
        annotations,
        ..Tier::default()
    };
    Some(Transcript {
        tiers: vec![tier],
        ..Transcript::default()
    })
}

/// Returns names without repetition; empty ones become `word 1` and so on.
pub(crate) fn unique<'a>(names: impl Iterator<Item = &'a str>, word: &str) -> Vec<String> {
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
pub(crate) fn axes_with_up(markers: &[Marker], up: Direction, findings: &mut Findings) -> Axes {
    if let Some(axes) = left_of(markers, up).and_then(|left| Axes::new(up, left)) {
        return axes;
    }
    findings.push(Finding::note(
        None,
        "no pair of markers such as LSHO and RSHO shows which side is left; the first axis that fits is taken",
    ));
    let all = ["+Z,+X", "+Y,+X", "+X,+Y", "-Z,+X", "-Y,+X", "-X,+Y"];
    let fits = all
        .iter()
        .filter_map(|text| text.parse::<Axes>().ok())
        .find(|axes| axes.up() == up);
    fits.unwrap_or(Convention::MODEL.axes)
}

/// Returns the direction from the feet to head and shoulders, if markers have such names.
pub(crate) fn up_of(markers: &[Marker]) -> Option<Direction> {
    let high = [
        "HEAD", "LFHD", "RFHD", "SHO", "C7", "CLAV", "ACR", "STRN", "ACROM",
    ];
    let low = ["HEE", "TOE", "ANK", "FOOT", "CALC", "MTP", "KNE"];
    let mean = |words: &[&str]| {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for marker in markers {
            let name = split_label(&marker.name).1.to_uppercase();
            if !words.iter().any(|word| name.contains(word)) {
                continue;
            }
            let frames = marker.place.first().map_or(0, Column::len);
            if let Some(at) = (0..frames).find_map(|frame| marker.at(frame)) {
                sum += at;
                count += 1.0;
            }
        }
        (count > 0.0).then(|| sum / count)
    };
    Some(Direction::nearest(mean(&high)? - mean(&low)?))
}

/// Splits a marker's name such as `Anna:LSHO` into the subject with its colon, which may be empty, and the label.
fn split_label(name: &str) -> (&str, &str) {
    name.split_at(name.rfind(':').map_or(0, |colon| colon + 1))
}

/// Returns the direction from right to left, from pairs of markers whose names differ by L and R. A name of a letter and
/// a number does not count as one of a pair: L1 and R1 may be the little and the ring finger, or a vertebra.
fn left_of(markers: &[Marker], up: Direction) -> Option<Direction> {
    let mut sum = DVec3::ZERO;
    let up = up.vector();
    let names: Vec<String> = markers.iter().map(|it| it.name.to_lowercase()).collect();
    let mut known: BTreeMap<(&str, &str), &Marker> = BTreeMap::new();
    for (marker, name) in markers.iter().zip(&names) {
        known.entry((&marker.group, name)).or_insert(marker);
    }
    for (left, name) in markers.iter().zip(&names) {
        let Some(other) = other_side(name) else {
            continue;
        };
        let Some(right) = known.get(&(left.group.as_str(), other.as_str())) else {
            continue;
        };
        let frames = left.place.first().map_or(0, Column::len);
        let both = (0..frames).find_map(|frame| Some(left.at(frame)? - right.at(frame)?));
        sum += both.unwrap_or(DVec3::ZERO).normalize_or_zero();
    }
    let across = sum - up * sum.dot(up);
    (across.length() > 0.5).then(|| Direction::nearest(across))
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

    fn marker(name: &str, at: DVec3) -> Marker {
        let place = at.to_array().map(|x| Column::doubles(vec![x])).to_vec();
        Marker::new(name.to_owned(), place)
    }

    #[test]
    fn shoulders_show_which_side_is_left_and_numbered_fingers_do_not() {
        let pair = |left: &str, right: &str| {
            let both = [marker(left, DVec3::Z), marker(right, DVec3::NEG_Z)];
            left_of(&both, "+Y".parse().expect("a direction"))
        };
        assert_eq!(
            pair("LSHO", "RSHO"),
            Some("+Z".parse().expect("a direction"))
        );
        assert_eq!(
            pair("l_wrist", "r_wrist"),
            Some("+Z".parse().expect("a direction"))
        );
        assert_eq!(
            pair("Anna:LSHO", "Anna:RSHO"),
            Some("+Z".parse().expect("a direction"))
        );
        for (left, right) in [
            ("lsho", "rsho"),
            ("anna:lsho", "anna:rsho"),
            ("Sho_L", "Sho_R"),
            ("Shoulder.l", "Shoulder.r"),
            ("shoulder_left", "shoulder_right"),
            ("LeftShoulder", "RightShoulder"),
        ] {
            assert_eq!(
                pair(left, right),
                Some("+Z".parse().expect("a direction")),
                "{left}"
            );
        }
        assert_eq!(pair("L1", "R1"), None);
        assert_eq!(pair("Lena:LSHO", "Rita:RSHO"), None);
    }

    #[test]
    fn the_subject_of_a_label_does_not_show_which_direction_is_up() {
        let markers = [
            marker("HeeSho:LFHD", DVec3::Y),
            marker("HeeSho:LTOE", DVec3::NEG_Y),
        ];
        assert_eq!(up_of(&markers), Some("+Y".parse().expect("a direction")));
    }
}
