//! The CSV of OptiTrack Motive, format versions 1.1 to 1.25 and those after them.
//!
//! The first line holds keys and values. Below it rows name the type, name, id and parent of each column, the kind of
//! its number and its axis; the last of them begins with `Frame`. Source: the pages of OptiTrack on the export of CSV.

use std::collections::BTreeMap;

use chereme_motion::Direction;
use chereme_sign::{Choice, Remedy};
use glam::DVec3;

use super::Error;
use super::lines::{Lines, cells};
use super::rows::{Layout, Place};
use crate::curves::TimeUnit;
use crate::finding::Finding;
use crate::tally::Findings;
use crate::tracks::metres_of_unit;

/// The most rows of a header.
const HEADER: usize = 40;

/// Returns whether the first line is that of Motive.
pub(super) fn begins(lines: &Lines<'_>) -> bool {
    let first = lines.first(1);
    let first = first.first().map_or("", |(_, line)| line);
    let key = first.split([',', ';', '\t']).next().unwrap_or_default();
    key.trim_matches([' ', '"'])
        .eq_ignore_ascii_case("format version")
}

/// The rows of the header, as cells.
struct Header<'t> {
    types: Vec<&'t str>,
    names: Vec<&'t str>,
    kinds: Vec<&'t str>,
    axes: Vec<&'t str>,
    /// The line of the axes.
    line: u64,
}

pub(super) fn layout(lines: &Lines<'_>, findings: &mut Findings) -> Result<Layout, Error> {
    let first = lines.first(HEADER);
    let (_, pairs) = *first.first().ok_or(Error::Empty)?;
    let after = pairs.trim_start_matches('"').get("format version".len()..);
    let delimiter = after.and_then(|it| it.trim_start_matches(['"', ' ']).chars().next());
    let delimiter = delimiter
        .filter(|it| [',', ';', '\t'].contains(it))
        .unwrap_or(',');
    let pairs = cells(pairs, delimiter);
    let stated = |key: &str| {
        let mut found = pairs.chunks(2).filter_map(|pair| match pair {
            [name, value] if name.eq_ignore_ascii_case(key) => Some(*value),
            _ => None,
        });
        found.find(|value| !value.is_empty())
    };
    let header = header(&first[1..], delimiter)?;
    let rate = ["Export Frame Rate", "Capture Frame Rate"]
        .into_iter()
        .find_map(&stated);
    let title = |at: usize| header.axes.get(at).copied().unwrap_or_default();
    let is_time = |at: &usize| title(*at).to_lowercase().starts_with("time (");
    let time = (0..header.axes.len().min(3)).find(is_time);
    let is_local = stated("Coordinate Space").is_some_and(|it| it.eq_ignore_ascii_case("local"));
    let points = points(&header, is_local, findings)?;
    if points.is_empty() {
        return Err(Error::Empty);
    }
    let unit = stated("Length Units");
    let metres = unit.and_then(metres_of_unit);
    if metres.is_none() {
        let text = format!(
            "the unit is {:?}; metres are assumed",
            unit.unwrap_or_default()
        );
        findings.push(Finding::warning(1, text).with_remedy(Remedy::choice(
            Choice::Unit,
            "say the unit with --unit, such as --unit mm",
        )));
    }
    Ok(Layout {
        program: "Motive",
        line: header.line,
        rows: (header.line + 1, None),
        delimiter,
        width: header.axes.len(),
        points,
        frame: Some(0),
        time: time.map(|at| (at, TimeUnit::Seconds(1.0))),
        rate: rate.and_then(|it| it.replacen(',', ".", 1).parse().ok()),
        unit: Some(metres.unwrap_or(1.0)),
        up: Some(Direction::nearest(DVec3::Y)),
        ..Layout::default()
    })
}

fn header<'t>(below: &[(u64, &'t str)], delimiter: char) -> Result<Header<'t>, Error> {
    let mut above: Vec<Vec<&str>> = Vec::new();
    for (line, text) in below {
        let cells = cells(text, delimiter);
        if cells[0].eq_ignore_ascii_case("frame") {
            return sorted(above, cells, *line);
        }
        above.push(cells);
    }
    Err(Error::Missing("axes, which begins with Frame"))
}

/// Sorts the rows above the axes by what they hold: their own labels, their words, or their order.
fn sorted<'t>(
    above: Vec<Vec<&'t str>>,
    axes: Vec<&'t str>,
    line: u64,
) -> Result<Header<'t>, Error> {
    let holds =
        |row: &[&str], word: &str| row.iter().skip(2).any(|it| it.eq_ignore_ascii_case(word));
    let labelled =
        |row: &[&str], label: &str| row.iter().take(2).any(|it| it.eq_ignore_ascii_case(label));
    let kinds = above
        .iter()
        .rposition(|row| holds(row, "position") || holds(row, "rotation"));
    let kinds = kinds.ok_or(Error::Missing("Position and Rotation"))?;
    let is_type = |row: &Vec<&str>| {
        labelled(row, "type")
            || ["marker", "rigid body", "bone"]
                .iter()
                .any(|word| holds(row, word))
    };
    let types = above[..kinds]
        .iter()
        .position(is_type)
        .ok_or(Error::Missing("types"))?;
    let named = above[..kinds].iter().position(|row| labelled(row, "name"));
    let names = named.unwrap_or(types + 1);
    if names >= kinds {
        return Err(Error::Missing("names"));
    }
    Ok(Header {
        types: above[types].clone(),
        names: above[names].clone(),
        kinds: above[kinds].clone(),
        axes,
        line,
    })
}

/// The content of a column of Motive.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// Places of seen markers.
    Marker,
    /// Places where a body expects its markers.
    Expected,
    /// Places of bones.
    Bone,
    /// Places of rigid bodies.
    Body,
}

impl Kind {
    fn of(text: &str) -> Self {
        let text = text.to_lowercase();
        match text.as_str() {
            "marker" | "" => Self::Marker,
            text if text.contains("marker") => Self::Expected,
            text if text.contains("bone") => Self::Bone,
            _ => Self::Body,
        }
    }

    /// Returns the group of a point of this kind that belongs to `owner`.
    fn group(self, owner: &str) -> String {
        let kind = match self {
            Self::Marker | Self::Expected => return owner.to_owned(),
            Self::Bone => "bones",
            Self::Body => "rigid bodies",
        };
        match owner {
            "" => kind.to_owned(),
            owner => format!("{owner} {kind}"),
        }
    }
}

/// Returns the points: seen markers, else expected ones; and places of bones and rigid bodies.
fn points(
    header: &Header<'_>,
    is_local: bool,
    findings: &mut Findings,
) -> Result<Vec<Place>, Error> {
    let cell =
        |row: &[&'_ str], at: usize| row.get(at).map_or(String::new(), |it| (*it).to_owned());
    let mut found: Vec<(Kind, Place, [Option<usize>; 3])> = Vec::new();
    let mut before = (String::new(), String::new());
    let mut left_out: BTreeMap<&str, usize> = BTreeMap::new();
    for at in 1..header.axes.len() {
        let (what, axis) = (cell(&header.kinds, at), cell(&header.axes, at));
        let axis = ["x", "y", "z"]
            .iter()
            .position(|it| axis.eq_ignore_ascii_case(it));
        let what = what.to_lowercase();
        let axis = match (what.as_str(), axis) {
            ("position", Some(axis)) => axis,
            ("" | "position", _) => continue,
            ("rotation", _) => {
                *left_out.entry("rotations").or_default() += 1;
                continue;
            }
            _ => {
                *left_out.entry("errors and qualities").or_default() += 1;
                continue;
            }
        };
        let key = (cell(&header.types, at), cell(&header.names, at));
        let is_new = key != before || found.last().is_none_or(|(_, _, axes)| axes[axis].is_some());
        if is_new {
            let kind = Kind::of(&key.0);
            let mut place = Place::named(&key.1, Vec::new());
            place.group = kind.group(&place.group);
            found.push((kind, place, [None; 3]));
            before = key;
        }
        if let Some((_, _, axes)) = found.last_mut() {
            axes[axis] = Some(at);
        }
    }
    let has = |wanted: Kind| found.iter().any(|(kind, ..)| *kind == wanted);
    let has_seen = has(Kind::Marker);
    let is_left = |kind: Kind| kind == Kind::Expected && has_seen || kind == Kind::Bone && is_local;
    if is_local && has(Kind::Bone) && found.iter().all(|(kind, ..)| is_left(*kind)) {
        return Err(Error::Local);
    }
    let expected = found
        .iter()
        .filter(|(kind, ..)| *kind == Kind::Expected)
        .count();
    if expected > 0 {
        let text = match has_seen {
            true => format!(
                "the places where bodies expect their markers are left out, for the seen markers are there: {expected}"
            ),
            false => format!(
                "its markers are where bodies expect them, not where cameras saw them: {expected}"
            ),
        };
        findings.push(Finding::note(header.line, text));
    }
    if is_local && has(Kind::Bone) {
        let text = "the places of its bones are relative to their parents (Coordinate Space is Local), and are left out";
        findings.push(
            Finding::warning(1, text)
                .with_remedy("export them in global coordinates, or the take as BVH, FBX or C3D"),
        );
    }
    if let Some(count) = left_out.get("rotations") {
        let text = format!(
            "columns of rotations are left out, for a table of points holds the places of bones and rigid bodies alone: {count}"
        );
        findings.push(
            Finding::warning(header.line, text)
                .with_remedy("export the take as BVH or FBX, too, for a skeleton that moves"),
        );
    }
    if let Some(count) = left_out.get("errors and qualities") {
        let text =
            format!("columns of errors and qualities of markers and bodies are left out: {count}");
        findings.push(Finding::note(header.line, text));
    }
    let whole = found.into_iter().filter(|(kind, ..)| !is_left(*kind));
    let whole = whole.filter_map(|(_, place, axes)| {
        let [x, y, z] = axes;
        let axes = vec![x?, y?, z?];
        Some(Place { axes, ..place })
    });
    Ok(whole.collect())
}
