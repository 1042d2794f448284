//! Titles of columns that name a point and its axis.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::QualityMeaning;

use super::points_rows::PointColumns;
use crate::tracks::metres_of_unit;

/// The part of a point that a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PointPart {
    /// A coordinate: 0 for x, 1 for y, 2 for z.
    Axis(usize),
    /// The fourth number of a rotation.
    Fourth,
    Sure(QualityMeaning),
}

/// Where a title has its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AxisTitleStyle {
    /// `wrist_x`, `wrist.X`, `wrist X`, `wrist:x`
    After,
    /// `x_wrist`, `X.wrist`
    Before,
    /// `x1`, `v12`
    Number,
    /// `wristX`, `wristx`
    Joined,
}

const TITLE_SEPARATORS: [char; 6] = ['_', '.', ' ', ':', '-', '/'];

/// Words of columns that hold no places, though they have axes.
const NO_PLACES: &str = "acc accel acceleration accelerometer linacc gyro gyr gyroscope mag magnetometer vel velocity speed \
    jerk rot rotation rotate euler angle angles angular angvel orientation orient quat quaternion force \
    forces moment moments torque gaze dir direction normal scale gravity grav emg std sd mean average avg \
    median min max range peak sum var delta onset offset velocities omega magnetic grf cop error f v q w";

/// Returns the part that a word such as `x`, `likelihood` or `v` stands for.
pub(super) fn parse_point_part(word: &str) -> Option<PointPart> {
    Some(match word.to_lowercase().as_str() {
        "x" => PointPart::Axis(0),
        "y" => PointPart::Axis(1),
        "z" => PointPart::Axis(2),
        "w" => PointPart::Fourth,
        "confidence" | "conf" | "c" | "likelihood" | "visibility" | "vis" | "v" | "presence" | "score" | "prob"
        | "probability" => PointPart::Sure(QualityMeaning::Confidence),
        "residual" => PointPart::Sure(QualityMeaning::Residual),
        _ => return None,
    })
}

/// A title that names a point.
struct PointTitle {
    stem: String,
    part: PointPart,
}

impl AxisTitleStyle {
    fn parse_point_title(self, title: &str) -> Option<PointTitle> {
        let made = |stem: &str, part: PointPart| {
            Some(PointTitle {
                stem: stem.trim_matches(TITLE_SEPARATORS).to_owned(),
                part,
            })
        };
        if let Some(part) = parse_point_part(title).filter(|_| title.len() == 1 || title.len() > 3) {
            return made("", part);
        }
        match self {
            Self::After => {
                let (stem, word) = title.rsplit_once(TITLE_SEPARATORS)?;
                made(stem, parse_point_part(word)?).filter(|title| !title.stem.is_empty())
            }
            Self::Before => {
                let (word, stem) = title.split_once(TITLE_SEPARATORS)?;
                made(stem, parse_point_part(word)?).filter(|title| !title.stem.is_empty())
            }
            Self::Number => {
                let digits = title.find(|character: char| character.is_ascii_digit())?;
                let (word, digits) = title.split_at(digits);
                let are_digits = digits.bytes().all(|byte| byte.is_ascii_digit());
                made(digits, parse_point_part(word)?).filter(|_| are_digits)
            }
            Self::Joined => {
                let (at, last) = title.char_indices().next_back()?;
                let stem = &title[..at];
                let letters = stem.chars().filter(|character| character.is_alphanumeric()).count();
                let part = parse_point_part(last.encode_utf8(&mut [0; 4]))?;
                // In `wrist_ax` and `pose_Rx` a letter for another quantity stands before the axis.
                let last = stem.rsplit(TITLE_SEPARATORS).next().unwrap_or_default();
                let letters_of_others = ["a", "f", "g", "m", "q", "r", "v", "w"];
                let is_other = letters_of_others.contains(&last.to_lowercase().as_str());
                let is_axis = matches!(part, PointPart::Axis(_)) && !stem.ends_with(TITLE_SEPARATORS) && !is_other;
                (letters >= 3 && is_axis).then(|| made(stem, part)).flatten()
            }
        }
    }
}

/// The points that the titles of a table name.
#[derive(Debug, Default, PartialEq)]
pub(super) struct TitledPoints {
    pub(super) points: Vec<PointColumns>,
    pub(super) quality: Option<QualityMeaning>,
    /// The columns of the points.
    pub(super) used: BTreeSet<usize>,
    /// Metres of the unit that the titles state.
    pub(super) unit: Option<f64>,
    /// Whether the unit that they state is pixels.
    pub(super) pixels: bool,
}

/// Returns the points that titles name, in the style that names most of them.
pub(super) fn find_titled_points(titles: &[&str]) -> TitledPoints {
    let bare: Vec<(&str, Option<&str>)> = titles.iter().map(|title| without_unit(title)).collect();
    let styles = [
        AxisTitleStyle::After,
        AxisTitleStyle::Before,
        AxisTitleStyle::Number,
        AxisTitleStyle::Joined,
    ];
    let read = styles.map(|style| in_style(&bare, style));
    // Of equally good styles the first counts.
    let best = read.into_iter().rev().max_by_key(|named| named.used.len());
    best.unwrap_or_default()
}

/// Splits off the unit at the end of a title, such as ` [mm]`, `(m)` or `_cm`.
fn without_unit(title: &str) -> (&str, Option<&str>) {
    let title = title.trim();
    let is_unit = |unit: &str| metres_of_unit(unit).is_some() || is_pixels(unit);
    let open = title.rfind(['[', '(']).filter(|_| title.ends_with([']', ')']));
    if let Some(open) = open {
        let unit = &title[open + 1..title.len() - 1];
        return match is_unit(unit) {
            true => (title[..open].trim_end_matches([' ', '_']), Some(unit)),
            false => (title, None),
        };
    }
    match title.rsplit_once('_') {
        Some((rest, unit)) if is_unit(unit) && is_axis_at_end(rest) => (rest, Some(unit)),
        _ => (title, None),
    }
}

fn is_pixels(unit: &str) -> bool {
    ["px", "pix", "pixel", "pixels"].contains(&unit.to_lowercase().as_str())
}

fn is_axis_at_end(title: &str) -> bool {
    let word = title.rsplit(TITLE_SEPARATORS).next().unwrap_or_default();
    matches!(parse_point_part(word), Some(PointPart::Axis(_)))
}

/// The columns of one name, as they are found.
#[derive(Default)]
struct TitledPointColumns {
    stem: String,
    axes: [Option<usize>; 3],
    sure: Option<(usize, QualityMeaning)>,
    is_rotation: bool,
}

fn in_style(titles: &[(&str, Option<&str>)], style: AxisTitleStyle) -> TitledPoints {
    let mut found_points: Vec<TitledPointColumns> = Vec::new();
    // The last columns with a name, so that a name that occurs again begins a point of its own.
    let mut last: BTreeMap<String, usize> = BTreeMap::new();
    for (at, (title, _)) in titles.iter().enumerate() {
        let Some(PointTitle { stem, part }) = style.parse_point_title(title) else {
            continue;
        };
        let earlier_index = last.get(&stem).copied().filter(|known| {
            let open_point = &found_points[*known];
            match part {
                PointPart::Axis(axis) => open_point.axes[axis].is_none(),
                PointPart::Fourth => true,
                PointPart::Sure(_) => open_point.sure.is_none(),
            }
        });
        let place = earlier_index.unwrap_or_else(|| {
            last.insert(stem.clone(), found_points.len());
            found_points.push(TitledPointColumns {
                stem,
                ..TitledPointColumns::default()
            });
            found_points.len() - 1
        });
        let place = &mut found_points[place];
        match part {
            PointPart::Axis(axis) => place.axes[axis] = Some(at),
            PointPart::Fourth => place.is_rotation = true,
            PointPart::Sure(quality) => place.sure = Some((at, quality)),
        }
    }
    found_points.retain(|point| !point.is_rotation && holds_places(&point.stem));
    let wide = match found_points.iter().any(|point| point.axes.iter().all(Option::is_some)) {
        true => 3,
        false => 2,
    };
    let is_whole = |point: &TitledPointColumns| point.axes[..wide].iter().all(Option::is_some);
    let is_flat = |point: &TitledPointColumns| wide == 3 || point.axes[2].is_none();
    found_points.retain(|point| is_whole(point) && is_flat(point));
    let quality = found_points
        .iter()
        .find_map(|point| point.sure)
        .map(|(_, quality)| quality);
    let mut named = TitledPoints {
        quality,
        ..TitledPoints::default()
    };
    let unit = |at: usize| titles[at].1;
    let units: Vec<&str> = found_points
        .iter()
        .flat_map(|point| point.axes.iter().flatten())
        .filter_map(|at| unit(*at))
        .collect();
    if let Some(first) = units.first().filter(|first| units.iter().all(|unit| unit == *first)) {
        named.unit = metres_of_unit(first);
        named.pixels = is_pixels(first);
    }
    let bare: Vec<&str> = found_points.iter().map(|point| of_position(&point.stem)).collect();
    for (it, bare) in found_points.iter().zip(&bare) {
        let axes: Vec<usize> = it.axes[..wide].iter().flatten().copied().collect();
        let mut place = PointColumns::with_grouped_name(if bare.is_empty() { "point" } else { bare }, axes);
        place.quality = it.sure.filter(|(_, own)| Some(*own) == quality).map(|(at, _)| at);
        named.used.extend(&place.axes);
        named.used.extend(place.quality);
        named.points.push(place);
    }
    named
}

/// Returns a name without a word such as `position` at its end.
fn of_position(stem: &str) -> &str {
    let Some((rest, word)) = stem.rsplit_once(TITLE_SEPARATORS) else {
        return stem;
    };
    match ["position", "pos", "translation", "location"].contains(&word.to_lowercase().as_str()) {
        true => rest,
        false => stem,
    }
}

/// Returns whether columns of this name hold places, and no rotations, forces and the like.
fn holds_places(stem: &str) -> bool {
    let mut words: Vec<String> = vec![String::new()];
    let mut was_small = false;
    for letter in stem.chars() {
        let begins = letter.is_uppercase() && was_small || !letter.is_alphanumeric();
        if begins {
            words.push(String::new());
        }
        was_small = letter.is_lowercase();
        if let Some(word) = words.last_mut().filter(|_| letter.is_alphanumeric()) {
            word.extend(letter.to_lowercase());
        }
    }
    let is_known = |word: &String| {
        let bare = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
        let one = bare.strip_suffix('s').unwrap_or(bare);
        NO_PLACES.split(' ').any(|word| word == bare || word == one)
    };
    !words.iter().any(is_known)
}
