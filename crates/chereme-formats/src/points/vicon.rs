//! The CSV of Vicon Nexus: sections, each with a title, a rate, and rows of titles.

use chereme_motion::{AxisDirection, RecordingInstant};
use glam::DVec3;

use super::PointTableError;
use super::lines::{TableTextLines, split_line_cells};
use super::points_rows::{PointColumns, PointTableLayout};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::timecode::SECONDS_PER_DAY;
use crate::tracks::metres_of_unit;

/// The section of markers.
const TRAJECTORIES_SECTION_TITLE: &str = "trajectories";
/// Sections that such a file may begin with.
const VICON_SECTION_TITLES: [&str; 8] = [
    TRAJECTORIES_SECTION_TITLE,
    "devices",
    "model outputs",
    "joints",
    "segments",
    "events",
    "force plates",
    "forceplates",
];

/// Returns whether the file begins with a section of Nexus.
pub(super) fn is_vicon_export(lines: &TableTextLines<'_>) -> bool {
    let first = lines.first_filled_lines(5);
    let Some((_, title)) = first.first() else {
        return false;
    };
    let is_frame = |line: &str| {
        let mut cells = line.split([',', ';', '\t']).map(|cell| cell.trim_matches([' ', '"']));
        let first = cells.next().unwrap_or_default();
        let second = cells.next().unwrap_or_default().to_lowercase();
        is_frame_number_title(first) && (second.replace(' ', "") == "subframe" || second == "x")
    };
    let is_section =
        parse_vicon_section(title).is_some_and(|name| VICON_SECTION_TITLES.contains(&name.to_lowercase().as_str()));
    let is_event = |line: &str| line.to_lowercase().starts_with("subject,context");
    is_section && first.iter().any(|(_, line)| is_frame(line) || is_event(line))
}

/// Returns the title of a section: the only cell of its line, which is no number.
fn parse_vicon_section(line: &str) -> Option<&str> {
    let bare = line.trim_matches([',', ';', '\t', ' ', '"']);
    let has_one = !bare.contains([',', ';', '\t']) && bare.len() < 60;
    (has_one && bare.parse::<f64>().is_err() && !bare.is_empty()).then_some(bare)
}

/// Returns the rate of a line that holds nothing else but its unit.
fn parse_vicon_rate(line: &str) -> Option<f64> {
    let trimmed = line.trim_end_matches([',', ';', '\t', ' ', '"']);
    let bare = trimmed.strip_suffix("Hz").unwrap_or(trimmed);
    let bare = bare.trim_matches([',', ';', '\t', ' ', '"']);
    let rate = bare.replacen(',', ".", 1).parse::<f64>().ok()?;
    (rate.is_finite() && rate > 0.0).then_some(rate)
}

/// Returns whether a title is that of the numbers of frames; old versions call them fields.
fn is_frame_number_title(title: &str) -> bool {
    ["frame", "field #", "field"]
        .iter()
        .any(|word| title.eq_ignore_ascii_case(word))
}

pub(super) fn read_vicon_layout(
    lines: &TableTextLines<'_>,
    findings: &mut FindingTally,
) -> Result<PointTableLayout, PointTableError> {
    let mut section_titles: Vec<(u64, &str)> = Vec::new();
    let mut before: Option<(u64, &str)> = None;
    for (line, text) in lines.filled_lines() {
        // Only lines of one cell are compared, so that long rows cost nothing.
        if text.len() < 80 {
            if let (Some((at, title)), Some(_)) = (before, parse_vicon_rate(text)) {
                section_titles.push((at, title));
            }
            before = parse_vicon_section(text).map(|title| (line, title));
        } else {
            before = None;
        }
    }
    let named = |(_, title): &(u64, &str)| title.eq_ignore_ascii_case(TRAJECTORIES_SECTION_TITLE);
    let are_events = |title: &str| title.eq_ignore_ascii_case("events");
    let other_titles = section_titles
        .iter()
        .filter(|entry| !named(entry))
        .map(|(_, title)| *title);
    let others: Vec<&str> = other_titles.filter(|title| !are_events(title)).collect();
    let event_title = section_titles.iter().find(|(_, title)| are_events(title));
    let events = event_title.map_or(Vec::new(), |(line, _)| events_below(lines, *line));
    let Some(at) = section_titles.iter().position(named) else {
        return Err(match others.is_empty() {
            true => PointTableError::Empty,
            false => PointTableError::Sections(others.join(", ")),
        });
    };
    let (begin, _) = section_titles[at];
    let end = section_titles.get(at + 1).map(|(line, _)| *line);
    if section_titles.iter().filter(|entry| named(entry)).count() > 1 {
        let text = "a second section Trajectories is left out";
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                section_titles
                    .iter()
                    .rev()
                    .find(|entry| named(entry))
                    .map(|(line, _)| *line),
                text,
            )
            .with_remedy("put it into a file of its own"),
        );
    }
    if !others.is_empty() {
        let text = format!("sections of other data are left out: {}", others.join(", "));
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(section_titles[0].0, text)
                .with_remedy("export the trial as C3D, which holds analog channels and events, too"),
        );
    }
    let mut rows = lines.filled_lines().skip_while(|(line, _)| *line < begin).skip(1);
    let rate = rows.next().and_then(|(_, text)| parse_vicon_rate(text));
    let (_, names) = rows.next().ok_or(PointTableError::Missing("markers' names"))?;
    let (line, titles) = rows
        .next()
        .ok_or(PointTableError::Missing("axes, which begins with Frame"))?;
    let delimiter = titles
        .chars()
        .find(|character| [',', ';', '\t'].contains(character))
        .unwrap_or(',');
    let (names, titles) = (split_line_cells(names, delimiter), split_line_cells(titles, delimiter));
    if !is_frame_number_title(titles[0]) {
        return Err(PointTableError::Missing("axes, which begins with Frame"));
    }
    let mut unit = None;
    let mut first = line + 1;
    if let Some((line, text)) = rows.next() {
        let units = split_line_cells(text, delimiter);
        if units[0].parse::<f64>().is_err() {
            let stated_unit = units.iter().find(|cell| !cell.is_empty());
            unit = stated_unit.and_then(|cell| metres_of_unit(cell));
            first = line + 1;
        }
    }
    if unit.is_none() {
        findings.push_note_finding(line, "no row of units; millimetres are assumed");
    }
    let points = collect_vicon_points(&names, &titles, findings, line);
    if points.is_empty() {
        return Err(PointTableError::Empty);
    }
    Ok(PointTableLayout {
        program: "Vicon Nexus",
        line,
        rows: (first, end),
        delimiter,
        width: titles.len().max(names.len()),
        points,
        frame: Some(0),
        rate,
        unit: Some(unit.unwrap_or(0.001)),
        up: Some(AxisDirection::nearest_axis_direction(DVec3::Z)),
        events,
        ..PointTableLayout::default()
    })
}

/// Returns the events of the section whose title is at `line`: rows of subject, context, name and seconds.
fn events_below(lines: &TableTextLines<'_>, line: u64) -> Vec<(RecordingInstant, String)> {
    const MAX_VICON_EVENTS: usize = 100_000;
    let rows = lines.filled_lines().skip_while(|(at, _)| *at <= line).skip(2);
    let event = |text: &str| {
        let delimiter = text.chars().find(|character| [',', ';', '\t'].contains(character))?;
        let cells = split_line_cells(text, delimiter);
        let [_, context, name, time, ..] = cells[..] else {
            return None;
        };
        let seconds: f64 = time.parse().ok()?;
        let is_sound = seconds.is_finite() && (0.0..SECONDS_PER_DAY).contains(&seconds) && !name.is_empty();
        let name_parts = [context, name].into_iter().filter(|part| !part.is_empty());
        let name = name_parts.collect::<Vec<_>>().join(" ");
        is_sound.then(|| (RecordingInstant::from_seconds(seconds), name))
    };
    rows.map_while(|(_, text)| event(text)).take(MAX_VICON_EVENTS).collect()
}

/// Returns the markers: a name stands above the first of its columns.
fn collect_vicon_points(names: &[&str], titles: &[&str], findings: &mut FindingTally, line: u64) -> Vec<PointColumns> {
    let mut found_places: Vec<(PointColumns, [Option<usize>; 3])> = Vec::new();
    let mut others = 0;
    for (at, title) in titles.iter().enumerate().skip(1) {
        let name = names.get(at).copied().unwrap_or_default();
        let axis = ["x", "y", "z"]
            .iter()
            .position(|letter| title.eq_ignore_ascii_case(letter));
        let Some(axis) = axis else {
            others += usize::from(!title.is_empty() && !title.to_lowercase().starts_with("sub"));
            continue;
        };
        // An axis that is there already begins the next marker, even without a name.
        let is_new = !name.is_empty() || found_places.last().is_none_or(|(_, axes)| axes[axis].is_some());
        if is_new {
            found_places.push((PointColumns::with_grouped_name(name, Vec::new()), [None; 3]));
        }
        if let Some((_, axes)) = found_places.last_mut() {
            axes[axis] = Some(at);
        }
    }
    if others > 0 {
        let text = format!("columns of trajectories that are no places, such as velocities, are left out: {others}");
        findings.push_note_finding(line, text);
    }
    let whole_places = found_places.into_iter().filter_map(|(place, [x, y, z])| {
        let axes = vec![x?, y?, z?];
        Some(PointColumns { axes, ..place })
    });
    whole_places.collect()
}
