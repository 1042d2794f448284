//! Titles of columns that name a point and its axis.

use std::collections::{BTreeMap, BTreeSet};

use chereme_motion::Quality;

use super::rows::Place;
use crate::tracks::metres_of_unit;

/// The part of a point that a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// A coordinate: 0 for x, 1 for y, 2 for z.
    Axis(usize),
    /// The fourth number of a rotation.
    Fourth,
    Sure(Quality),
}

/// Where a title has its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Style {
    /// `wrist_x`, `wrist.X`, `wrist X`, `wrist:x`
    After,
    /// `x_wrist`, `X.wrist`
    Before,
    /// `x1`, `v12`
    Number,
    /// `wristX`, `wristx`
    Joined,
}

const SEPARATORS: [char; 6] = ['_', '.', ' ', ':', '-', '/'];

/// Words of columns that hold no places, though they have axes.
const NO_PLACES: &[&str] = &[
    "acc",
    "accel",
    "acceleration",
    "accelerometer",
    "linacc",
    "gyro",
    "gyr",
    "gyroscope",
    "mag",
    "magnetometer",
    "vel",
    "velocity",
    "speed",
    "jerk",
    "rot",
    "rotation",
    "rotate",
    "euler",
    "angle",
    "angles",
    "angular",
    "angvel",
    "orientation",
    "orient",
    "quat",
    "quaternion",
    "force",
    "forces",
    "moment",
    "moments",
    "torque",
    "gaze",
    "dir",
    "direction",
    "normal",
    "scale",
    "gravity",
    "grav",
    "emg",
    "std",
    "sd",
    "mean",
    "average",
    "avg",
    "median",
    "min",
    "max",
    "range",
    "peak",
    "sum",
    "var",
    "delta",
    "onset",
    "offset",
    "velocities",
    "omega",
    "magnetic",
    "grf",
    "cop",
    "error",
    "f",
    "v",
    "q",
    "w",
];

/// Returns the part that a word such as `x`, `likelihood` or `v` stands for.
pub(super) fn part(word: &str) -> Option<Part> {
    Some(match word.to_lowercase().as_str() {
        "x" => Part::Axis(0),
        "y" => Part::Axis(1),
        "z" => Part::Axis(2),
        "w" => Part::Fourth,
        "confidence" | "conf" | "c" | "likelihood" | "visibility" | "vis" | "v" | "presence"
        | "score" | "prob" | "probability" => Part::Sure(Quality::Confidence),
        "residual" => Part::Sure(Quality::Residual),
        _ => return None,
    })
}

/// A title that names a point.
struct Title {
    stem: String,
    part: Part,
}

impl Style {
    fn read(self, title: &str) -> Option<Title> {
        let made = |stem: &str, part: Part| {
            Some(Title {
                stem: stem.trim_matches(SEPARATORS).to_owned(),
                part,
            })
        };
        if let Some(part) = part(title).filter(|_| title.len() == 1 || title.len() > 3) {
            return made("", part);
        }
        match self {
            Self::After => {
                let (stem, word) = title.rsplit_once(SEPARATORS)?;
                made(stem, part(word)?).filter(|it| !it.stem.is_empty())
            }
            Self::Before => {
                let (word, stem) = title.split_once(SEPARATORS)?;
                made(stem, part(word)?).filter(|it| !it.stem.is_empty())
            }
            Self::Number => {
                let digits = title.find(|it: char| it.is_ascii_digit())?;
                let (word, digits) = title.split_at(digits);
                let whole = digits.bytes().all(|it| it.is_ascii_digit());
                made(digits, part(word)?).filter(|_| whole)
            }
            Self::Joined => {
                let (at, last) = title.char_indices().next_back()?;
                let stem = &title[..at];
                let letters = stem.chars().filter(|it| it.is_alphanumeric()).count();
                let part = part(last.encode_utf8(&mut [0; 4]))?;
                // In `wrist_ax` and `pose_Rx` a letter for another quantity stands before the axis.
                let last = stem.rsplit(SEPARATORS).next().unwrap_or_default();
                let letters_of_others = ["a", "f", "g", "m", "q", "r", "v", "w"];
                let is_other = letters_of_others.contains(&last.to_lowercase().as_str());
                let is_axis =
                    matches!(part, Part::Axis(_)) && !stem.ends_with(SEPARATORS) && !is_other;
                (letters >= 3 && is_axis)
                    .then(|| made(stem, part))
                    .flatten()
            }
        }
    }
}

/// The points that the titles of a table name.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Named {
    pub(super) points: Vec<Place>,
    pub(super) quality: Option<Quality>,
    /// The columns of the points.
    pub(super) used: BTreeSet<usize>,
    /// Metres of the unit that the titles state.
    pub(super) unit: Option<f64>,
    /// Whether the unit that they state is pixels.
    pub(super) pixels: bool,
}

/// Returns the points that titles name, in the style that names most of them.
pub(super) fn points(titles: &[&str]) -> Named {
    let bare: Vec<(&str, Option<&str>)> = titles.iter().map(|it| without_unit(it)).collect();
    let styles = [Style::After, Style::Before, Style::Number, Style::Joined];
    let read = styles.map(|style| in_style(&bare, style));
    // Of equally good styles the first counts.
    let best = read.into_iter().rev().max_by_key(|named| named.used.len());
    best.unwrap_or_default()
}

/// Splits off the unit at the end of a title, such as ` [mm]`, `(m)` or `_cm`.
fn without_unit(title: &str) -> (&str, Option<&str>) {
    let title = title.trim();
    let is_unit = |unit: &str| metres_of_unit(unit).is_some() || is_pixels(unit);
    let open = title
        .rfind(['[', '('])
        .filter(|_| title.ends_with([']', ')']));
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
    let word = title.rsplit(SEPARATORS).next().unwrap_or_default();
    matches!(part(word), Some(Part::Axis(_)))
}

/// The columns of one name, as they are found.
#[derive(Default)]
struct Found {
    stem: String,
    axes: [Option<usize>; 3],
    sure: Option<(usize, Quality)>,
    is_rotation: bool,
}

fn in_style(titles: &[(&str, Option<&str>)], style: Style) -> Named {
    let mut found: Vec<Found> = Vec::new();
    // The last columns with a name, so that a name that occurs again begins a point of its own.
    let mut last: BTreeMap<String, usize> = BTreeMap::new();
    for (at, (title, _)) in titles.iter().enumerate() {
        let Some(Title { stem, part }) = style.read(title) else {
            continue;
        };
        let known = last.get(&stem).copied().filter(|known| {
            let known = &found[*known];
            match part {
                Part::Axis(axis) => known.axes[axis].is_none(),
                Part::Fourth => true,
                Part::Sure(_) => known.sure.is_none(),
            }
        });
        let place = known.unwrap_or_else(|| {
            last.insert(stem.clone(), found.len());
            found.push(Found {
                stem,
                ..Found::default()
            });
            found.len() - 1
        });
        let place = &mut found[place];
        match part {
            Part::Axis(axis) => place.axes[axis] = Some(at),
            Part::Fourth => place.is_rotation = true,
            Part::Sure(quality) => place.sure = Some((at, quality)),
        }
    }
    found.retain(|it| !it.is_rotation && holds_places(&it.stem));
    let wide = match found.iter().any(|it| it.axes.iter().all(Option::is_some)) {
        true => 3,
        false => 2,
    };
    let is_whole = |it: &Found| it.axes[..wide].iter().all(Option::is_some);
    let is_flat = |it: &Found| wide == 3 || it.axes[2].is_none();
    found.retain(|it| is_whole(it) && is_flat(it));
    let quality = found
        .iter()
        .find_map(|it| it.sure)
        .map(|(_, quality)| quality);
    let mut named = Named {
        quality,
        ..Named::default()
    };
    let unit = |at: usize| titles[at].1;
    let units: Vec<&str> = found
        .iter()
        .flat_map(|it| it.axes.iter().flatten())
        .filter_map(|at| unit(*at))
        .collect();
    if let Some(first) = units
        .first()
        .filter(|first| units.iter().all(|unit| unit == *first))
    {
        named.unit = metres_of_unit(first);
        named.pixels = is_pixels(first);
    }
    let bare: Vec<&str> = found.iter().map(|it| of_position(&it.stem)).collect();
    for (it, bare) in found.iter().zip(&bare) {
        let axes: Vec<usize> = it.axes[..wide].iter().flatten().copied().collect();
        let mut place = Place::named(if bare.is_empty() { "point" } else { bare }, axes);
        place.quality = it
            .sure
            .filter(|(_, own)| Some(*own) == quality)
            .map(|(at, _)| at);
        named.used.extend(&place.axes);
        named.used.extend(place.quality);
        named.points.push(place);
    }
    named
}

/// Returns a name without a word such as `position` at its end.
fn of_position(stem: &str) -> &str {
    let Some((rest, word)) = stem.rsplit_once(SEPARATORS) else {
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
        NO_PLACES.contains(&bare) || NO_PLACES.contains(&one)
    };
    !words.iter().any(is_known)
}
