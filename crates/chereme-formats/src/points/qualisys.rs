//! The TSV of Qualisys Track Manager: a key and its values on each line, then rows.
//!
//! Source: the manual of QTM on the export of motion data to TSV.

use chereme_motion::{AxisDirection, RecordingInstant};
use glam::DVec3;

use super::PointTableError;
use super::lines::{TableTextLines, split_line_cells};
use super::points_rows::{PointColumns, PointTableLayout, parse_point_number};
use crate::curves::ColumnTimeUnit;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;

/// The most lines of a header.
const MAX_QUALISYS_HEADER_LINES: usize = 4096;

/// Returns whether the file begins with the keys of QTM.
pub(super) fn is_qualisys_export(lines: &TableTextLines<'_>) -> bool {
    let first = lines.first_filled_lines(16);
    let has = |key: &str| first.iter().any(|(_, line)| line.starts_with(key));
    (has("NO_OF_FRAMES") || has("FREQUENCY"))
        && (has("MARKER_NAMES") || has("BODY_NAMES") || has("NO_OF_MARKERS") || has("NO_OF_BODIES"))
}

pub(super) fn read_qualisys_layout(
    lines: &TableTextLines<'_>,
    findings: &mut FindingTally,
) -> Result<PointTableLayout, PointTableError> {
    let first = lines.first_filled_lines(MAX_QUALISYS_HEADER_LINES);
    let delimiter = first.first().map_or('\t', |(_, line)| {
        line.chars()
            .find(|character| ['\t', ',', ';'].contains(character))
            .unwrap_or('\t')
    });
    let mut names: Option<(u64, Vec<&str>)> = None;
    let mut bodies: Option<(u64, Vec<&str>)> = None;
    let mut titles: Option<(u64, Vec<&str>)> = None;
    let (mut rate, mut frames) = (None, None);
    let mut events = Vec::new();
    let mut begin = None;
    for (line, text) in first {
        let cells = split_line_cells(text, delimiter);
        let key = cells[0];
        // The first rows may be gaps alone.
        let is_row =
            |cells: &[&str]| cells.len() > 2 && cells.iter().all(|cell| parse_point_number(cell, line, true).is_ok());
        let is_number = |cell: &&str| parse_point_number(cell, line, true).is_ok_and(|value| value.is_some());
        match key {
            "MARKER_NAMES" => names = Some((line, cells)),
            "BODY_NAMES" => bodies = Some((line, cells)),
            "FREQUENCY" => rate = cells.get(1).and_then(|text| text.replacen(',', ".", 1).parse().ok()),
            "NO_OF_FRAMES" => frames = cells.get(1).and_then(|cell| cell.parse().ok()),
            "EVENT" => events.extend(parse_qualisys_event(&cells)),
            _ if is_row(&cells) || is_number(&key) || key.is_empty() && cells.iter().any(is_number) => {
                begin = Some((line, cells.len()));
                break;
            }
            _ if key.chars().all(|letter| letter.is_ascii_uppercase() || letter == '_') && key.contains('_') => {}
            "DESCRIPTION" => {}
            _ => titles = Some((line, cells)),
        }
    }
    let (begin, wide) = begin.ok_or(PointTableError::Empty)?;
    let (line, points, width, lead) = match (names, bodies) {
        (Some((line, names)), _) => {
            let mut names: Vec<&str> = names[1..].to_vec();
            while names.last().is_some_and(|name| name.is_empty()) {
                names.pop();
            }
            let lead = count_leading_columns(&titles, wide, names.len());
            let point = |(at, name): (usize, &&str)| {
                let first = lead + 3 * at;
                PointColumns::with_grouped_name(name, vec![first, first + 1, first + 2])
            };
            let points: Vec<PointColumns> = names.iter().enumerate().map(point).collect();
            (line, points, lead + 3 * names.len(), lead)
        }
        (None, Some((line, names))) => {
            let points = of_bodies(line, &names[1..], titles.as_ref(), findings)?;
            let lead = lead_of_titles(titles.as_ref().map_or(&[], |(_, cells)| cells));
            let width = titles.as_ref().map_or(0, |(_, cells)| cells.len()).max(wide);
            (line, points, width, lead)
        }
        (None, None) => return Err(PointTableError::Missing("MARKER_NAMES")),
    };
    if points.is_empty() {
        return Err(PointTableError::Empty);
    }
    Ok(PointTableLayout {
        program: "Qualisys",
        line,
        rows: (begin, None),
        delimiter,
        width,
        points,
        frame: (lead > 0).then_some(0),
        time: (lead > 1).then_some((1, ColumnTimeUnit::Seconds(1.0))),
        rate,
        frames,
        unit: Some(0.001),
        up: Some(AxisDirection::nearest_axis_direction(DVec3::Z)),
        events,
        ..PointTableLayout::default()
    })
}

/// Returns an event: its name, and its time after the number of its frame.
fn parse_qualisys_event(cells: &[&str]) -> Option<(RecordingInstant, String)> {
    let [_, name, _, time, ..] = cells else {
        return None;
    };
    let seconds: f64 = time.replacen(',', ".", 1).parse().ok()?;
    let is_sound = (0.0..crate::timecode::SECONDS_PER_DAY).contains(&seconds);
    is_sound.then(|| (RecordingInstant::from_seconds(seconds), (*name).to_owned()))
}

/// Returns how many columns stand before the places: those of the titles, else those that rows have more than markers
/// need.
fn count_leading_columns(titles: &Option<(u64, Vec<&str>)>, wide: usize, markers: usize) -> usize {
    match titles {
        Some((_, cells)) => lead_of_titles(cells),
        None => match wide.saturating_sub(3 * markers) {
            more @ 0..=2 => more,
            _ => 0,
        },
    }
}

/// Returns how many of the first titles are those of frames and times.
fn lead_of_titles(titles: &[&str]) -> usize {
    let is_lead = |title: &&&str| {
        let title = title.to_lowercase();
        title.starts_with("frame") || title.starts_with("time")
    };
    titles.iter().take(2).take_while(is_lead).count()
}

/// Returns the places of rigid bodies: the columns X, Y and Z of each.
fn of_bodies(
    line: u64,
    names: &[&str],
    titles: Option<&(u64, Vec<&str>)>,
    findings: &mut FindingTally,
) -> Result<Vec<PointColumns>, PointTableError> {
    let names: Vec<&&str> = names.iter().filter(|name| !name.is_empty()).collect();
    let (_, titles) = titles.ok_or(PointTableError::Bodies { line })?;
    let ends = |title: &str, axis: &str| {
        let title = title.to_lowercase();
        title == axis || title.ends_with(&format!(" {axis}")) || title.ends_with(&format!("_{axis}"))
    };
    let columns = ["x", "y", "z"].map(|axis| {
        let axis_columns = (0..titles.len()).filter(|at| ends(titles[*at], axis));
        axis_columns.collect::<Vec<usize>>()
    });
    // Bodies have no columns of their own kind: the axes must be there once for each.
    if names.is_empty() || columns.iter().any(|held| held.len() != names.len()) {
        return Err(PointTableError::Bodies { line });
    }
    let places = names.len() * 3 + lead_of_titles(titles);
    let text = format!(
        "columns of rotations are left out, for a table of points holds the places of bones and rigid bodies alone: {}",
        titles.len().saturating_sub(places)
    );
    findings.push_counted_finding(
        ImportFinding::new_warning_finding(line, text)
            .with_remedy("export the take as BVH or FBX, too, for a skeleton that moves"),
    );
    let point = |(at, name): (usize, &&&str)| {
        let mut place = PointColumns::with_grouped_name(name, columns.iter().map(|held| held[at]).collect());
        place.group = match place.group.as_str() {
            "" => "rigid bodies".to_owned(),
            group => format!("{group} rigid bodies"),
        };
        place
    };
    Ok(names.iter().enumerate().map(point).collect())
}
