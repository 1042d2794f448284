//! The CSV of OptiTrack Motive, format versions 1.1 to 1.25 and those after them.
//!
//! The first line holds keys and values. Below it rows name the type, name, id and parent of each column, the kind of
//! its number and its axis; the last of them begins with `Frame`. Source: the pages of OptiTrack on the export of CSV.

use std::collections::BTreeMap;

use chereme_motion::AxisDirection;
use chereme_sign::{ErrorRemedy, RemedyChoice};
use glam::DVec3;

use super::PointTableError;
use super::lines::{TableTextLines, split_line_cells};
use super::points_rows::{PointColumns, PointTableLayout};
use crate::curves::ColumnTimeUnit;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::tracks::metres_of_unit;

/// The most rows of a header.
const MAX_MOTIVE_HEADER_ROWS: usize = 40;

/// Returns whether the first line is that of Motive.
pub(super) fn is_motive_export(lines: &TableTextLines<'_>) -> bool {
    let first_lines = lines.first_filled_lines(1);
    let first = first_lines.first().map_or("", |(_, line)| line);
    let key = first.split([',', ';', '\t']).next().unwrap_or_default();
    key.trim_matches([' ', '"']).eq_ignore_ascii_case("format version")
}

/// The rows of the header, as cells.
struct MotiveHeader<'t> {
    types: Vec<&'t str>,
    names: Vec<&'t str>,
    kinds: Vec<&'t str>,
    axes: Vec<&'t str>,
    /// The line of the axes.
    line: u64,
}

pub(super) fn read_motive_layout(
    lines: &TableTextLines<'_>,
    findings: &mut FindingTally,
) -> Result<PointTableLayout, PointTableError> {
    let first = lines.first_filled_lines(MAX_MOTIVE_HEADER_ROWS);
    let (_, pairs) = *first.first().ok_or(PointTableError::Empty)?;
    // The delimiter is whatever follows the first key.
    let after = pairs.trim_start_matches('"').get("format version".len()..);
    let first_character = after.and_then(|rest| rest.trim_start_matches(['"', ' ']).chars().next());
    let delimiter = first_character
        .filter(|character| [',', ';', '\t'].contains(character))
        .unwrap_or(',');
    let pairs = split_line_cells(pairs, delimiter);
    let stated = |key: &str| {
        let mut stated_values = pairs.chunks(2).filter_map(|pair| match pair {
            [name, value] if name.eq_ignore_ascii_case(key) => Some(*value),
            _ => None,
        });
        stated_values.find(|value| !value.is_empty())
    };
    let header = read_motive_header(&first[1..], delimiter)?;
    let rate = ["Export Frame Rate", "Capture Frame Rate"]
        .into_iter()
        .find_map(&stated);
    let title = |at: usize| header.axes.get(at).copied().unwrap_or_default();
    let is_time = |at: &usize| title(*at).to_lowercase().starts_with("time (");
    // Frame and time are among the first columns.
    let time = (0..header.axes.len().min(3)).find(is_time);
    let is_local = stated("Coordinate Space").is_some_and(|value| value.eq_ignore_ascii_case("local"));
    let points = collect_motive_points(&header, is_local, findings)?;
    if points.is_empty() {
        return Err(PointTableError::Empty);
    }
    let unit = stated("Length Units");
    let metres = unit.and_then(metres_of_unit);
    if metres.is_none() {
        let text = format!("the unit is {:?}; metres are assumed", unit.unwrap_or_default());
        findings.push_counted_finding(ImportFinding::new_warning_finding(1, text).with_remedy(
            ErrorRemedy::choice_remedy(RemedyChoice::Unit, "say the unit with --unit, such as --unit mm"),
        ));
    }
    Ok(PointTableLayout {
        program: "Motive",
        line: header.line,
        rows: (header.line + 1, None),
        delimiter,
        width: header.axes.len(),
        points,
        frame: Some(0),
        time: time.map(|at| (at, ColumnTimeUnit::Seconds(1.0))),
        // The rate may have a decimal comma.
        rate: rate.and_then(|text| text.replacen(',', ".", 1).parse().ok()),
        unit: Some(metres.unwrap_or(1.0)),
        up: Some(AxisDirection::nearest_axis_direction(DVec3::Y)),
        ..PointTableLayout::default()
    })
}

fn read_motive_header<'t>(below: &[(u64, &'t str)], delimiter: char) -> Result<MotiveHeader<'t>, PointTableError> {
    let mut above: Vec<Vec<&str>> = Vec::new();
    for (line, text) in below {
        let cells = split_line_cells(text, delimiter);
        if cells[0].eq_ignore_ascii_case("frame") {
            return sort_motive_header_rows(above, cells, *line);
        }
        above.push(cells);
    }
    Err(PointTableError::Missing("axes, which begins with Frame"))
}

/// Sorts the rows above the axes by what they hold: their own labels, their words, or their order.
fn sort_motive_header_rows<'t>(
    above: Vec<Vec<&'t str>>,
    axes: Vec<&'t str>,
    line: u64,
) -> Result<MotiveHeader<'t>, PointTableError> {
    let holds = |row: &[&str], word: &str| row.iter().skip(2).any(|cell| cell.eq_ignore_ascii_case(word));
    let labelled = |row: &[&str], label: &str| row.iter().take(2).any(|cell| cell.eq_ignore_ascii_case(label));
    let kinds_index = above
        .iter()
        .rposition(|row| holds(row, "position") || holds(row, "rotation"));
    let kinds = kinds_index.ok_or(PointTableError::Missing("Position and Rotation"))?;
    let is_type =
        |row: &Vec<&str>| labelled(row, "type") || ["marker", "rigid body", "bone"].iter().any(|word| holds(row, word));
    let types = above[..kinds]
        .iter()
        .position(is_type)
        .ok_or(PointTableError::Missing("types"))?;
    let named = above[..kinds].iter().position(|row| labelled(row, "name"));
    // Without labels the names are below the types.
    let names = named.unwrap_or(types + 1);
    if names >= kinds {
        return Err(PointTableError::Missing("names"));
    }
    Ok(MotiveHeader {
        types: above[types].clone(),
        names: above[names].clone(),
        kinds: above[kinds].clone(),
        axes,
        line,
    })
}

/// The content of a column of Motive.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum MotiveColumnKind {
    /// Places of seen markers.
    Marker,
    /// Places where a body expects its markers.
    Expected,
    /// Places of bones.
    Bone,
    /// Places of rigid bodies.
    Body,
}

impl MotiveColumnKind {
    fn from_motive_label(text: &str) -> Self {
        let text = text.to_lowercase();
        match text.as_str() {
            "marker" | "" => Self::Marker,
            text if text.contains("marker") => Self::Expected,
            text if text.contains("bone") => Self::Bone,
            _ => Self::Body,
        }
    }

    /// Returns the group of a point of this kind that belongs to `owner`.
    fn point_group_name(self, owner: &str) -> String {
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
fn collect_motive_points(
    header: &MotiveHeader<'_>,
    is_local: bool,
    findings: &mut FindingTally,
) -> Result<Vec<PointColumns>, PointTableError> {
    let cell = |row: &[&'_ str], at: usize| row.get(at).map_or(String::new(), |cell| (*cell).to_owned());
    let mut found_places: Vec<(MotiveColumnKind, PointColumns, [Option<usize>; 3])> = Vec::new();
    let mut before = (String::new(), String::new());
    let mut left_out: BTreeMap<&str, usize> = BTreeMap::new();
    for at in 1..header.axes.len() {
        let (what, axis) = (cell(&header.kinds, at), cell(&header.axes, at));
        let axis = ["x", "y", "z"]
            .iter()
            .position(|letter| axis.eq_ignore_ascii_case(letter));
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
        // A name that comes again with an axis that it has is another point.
        let is_new = key != before || found_places.last().is_none_or(|(_, _, axes)| axes[axis].is_some());
        if is_new {
            let kind = MotiveColumnKind::from_motive_label(&key.0);
            let mut place = PointColumns::with_grouped_name(&key.1, Vec::new());
            place.group = kind.point_group_name(&place.group);
            found_places.push((kind, place, [None; 3]));
            before = key;
        }
        if let Some((_, _, axes)) = found_places.last_mut() {
            axes[axis] = Some(at);
        }
    }
    let has = |wanted: MotiveColumnKind| found_places.iter().any(|(kind, ..)| *kind == wanted);
    let has_seen = has(MotiveColumnKind::Marker);
    let is_left = |kind: MotiveColumnKind| {
        kind == MotiveColumnKind::Expected && has_seen || kind == MotiveColumnKind::Bone && is_local
    };
    if is_local && has(MotiveColumnKind::Bone) && found_places.iter().all(|(kind, ..)| is_left(*kind)) {
        return Err(PointTableError::Local);
    }
    let expected = found_places
        .iter()
        .filter(|(kind, ..)| *kind == MotiveColumnKind::Expected)
        .count();
    if expected > 0 {
        let text = match has_seen {
            true => format!(
                "the places where bodies expect their markers are left out, for the seen markers are there: {expected}"
            ),
            false => format!("its markers are where bodies expect them, not where cameras saw them: {expected}"),
        };
        findings.push_note_finding(header.line, text);
    }
    if is_local && has(MotiveColumnKind::Bone) {
        let text =
            "the places of its bones are relative to their parents (Coordinate Space is Local), and are left out";
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(1, text)
                .with_remedy("export them in global coordinates, or the take as BVH, FBX or C3D"),
        );
    }
    if let Some(count) = left_out.get("rotations") {
        let text = format!(
            "columns of rotations are left out, for a table of points holds the places of bones and rigid bodies alone: {count}"
        );
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(header.line, text)
                .with_remedy("export the take as BVH or FBX, too, for a skeleton that moves"),
        );
    }
    if let Some(count) = left_out.get("errors and qualities") {
        let text = format!("columns of errors and qualities of markers and bodies are left out: {count}");
        findings.push_note_finding(header.line, text);
    }
    let kept_places = found_places.into_iter().filter(|(kind, ..)| !is_left(*kind));
    let whole_places = kept_places.filter_map(|(_, place, axes)| {
        let [x, y, z] = axes;
        let axes = vec![x?, y?, z?];
        Some(PointColumns { axes, ..place })
    });
    Ok(whole_places.collect())
}
