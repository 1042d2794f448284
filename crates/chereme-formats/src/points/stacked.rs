//! Titles over several rows: names above `x`, `y`, `z` or `likelihood`, as DeepLabCut and tables of pandas have them.

use std::collections::BTreeMap;

use chereme_motion::QualityMeaning;

use super::lines::{TableTextLines, detect_column_delimiter, split_line_cells};
use super::points_rows::{PointColumns, PointTableLayout, parse_point_number};
use super::titles::{PointPart, parse_point_part};
use crate::curves::{ColumnTimeUnit, unit_of_time};
use crate::tracks::metres_of_unit;

/// The first lines among which the row of axes is looked for.
const AXES_ROW_SEARCH_LINES: usize = 6;
/// The rows below them that are looked at.
const STACKED_SAMPLE_ROWS: usize = 20;

/// Returns the columns of a table whose titles take several rows; `None` if it has no row of axes below a row of names.
pub(super) fn read_stacked_layout(lines: &TableTextLines<'_>) -> Option<PointTableLayout> {
    let first = lines.first_filled_lines(AXES_ROW_SEARCH_LINES);
    let axes_index = (1..first.len()).find(|at| is_axes(first[*at].1))?;
    let (line, axes) = first[axes_index];
    let delimiter = detect_column_delimiter(axes);
    let axes = split_line_cells(axes, delimiter);
    let names = split_line_cells(first[axes_index - 1].1, delimiter);
    let lead = axes.iter().position(|word| parse_point_part(word).is_some())?;
    if lead > 2
        || !axes[..lead].iter().all(|word| is_lead(word))
        || names
            .iter()
            .skip(lead)
            .all(|cell| cell.is_empty() || cell.parse::<f64>().is_ok())
    {
        return None;
    }
    let above = first[..axes_index]
        .iter()
        .map(|(_, text)| split_line_cells(text, delimiter));
    let people: Option<Vec<&str>> = above.clone().find(|row| row[0].eq_ignore_ascii_case("individuals"));
    let mut first_row = line + 1;
    let mut unit = None;
    if let Some((next, text)) = first.get(axes_index + 1) {
        let units = split_line_cells(text, delimiter);
        let named = units.iter().find(|cell| !cell.is_empty());
        unit = named
            .and_then(|cell| metres_of_unit(cell))
            .filter(|_| units[0].is_empty());
        if unit.is_some() {
            first_row = next + 1;
        }
    }
    let mut layout = PointTableLayout {
        line,
        rows: (first_row, None),
        delimiter,
        width: axes.len().max(names.len()),
        unit,
        ..PointTableLayout::default()
    };
    for title in 0..lead {
        // The label of a row of names stands in the column of the numbers of frames.
        let title_of = |row: &[&str]| row.get(title).map_or(String::new(), |cell| cell.to_lowercase());
        match unit_of_time(&title_of(&axes)) {
            Some(ColumnTimeUnit::Seconds(unit)) => layout.time = Some((title, ColumnTimeUnit::Seconds(unit))),
            _ if layout.frame.is_none() => layout.frame = Some(title),
            _ => {}
        }
    }
    add_stacked_points(&mut layout, &names, &axes, people.as_deref(), lead);
    let later_lines = lines.first_filled_lines(AXES_ROW_SEARCH_LINES + STACKED_SAMPLE_ROWS);
    let below = later_lines.iter().filter(|(line, _)| *line >= layout.rows.0);
    let below: Vec<Vec<&str>> = below.map(|(_, text)| split_line_cells(text, delimiter)).collect();
    // The last one may be cut where the beginning of a file ends.
    let row_count = below.len().saturating_sub(usize::from(below.len() > 1));
    let point_axes = layout.points.iter().flat_map(|point| &point.axes);
    let columns: Vec<usize> = point_axes.copied().collect();
    let is_number = |row: &Vec<&str>| {
        let cell = |at: &usize| row.get(*at).copied().unwrap_or_default();
        columns
            .iter()
            .all(|at| parse_point_number(cell(at), 0, delimiter != ',').is_ok())
    };
    let holds = !layout.points.is_empty() && below[..row_count].iter().all(is_number);
    holds.then_some(layout)
}

/// Returns whether a word may stand beside the axes: that of the row of titles, of frames or of times.
fn is_lead(word: &str) -> bool {
    const LEAD_TITLE_WORDS: [&str; 13] = [
        "",
        "coords",
        "coord",
        "coordinates",
        "axis",
        "axes",
        "frame",
        "frames",
        "sub frame",
        "subframe",
        "index",
        "#",
        "frame#",
    ];
    let word = word.to_lowercase();
    LEAD_TITLE_WORDS.contains(&word.as_str()) || unit_of_time(&word).is_some()
}

/// Returns whether a line holds axes: `x` and `y` and no other words but that of the row, of frames and of times.
fn is_axes(line: &str) -> bool {
    let cells = split_line_cells(line, detect_column_delimiter(line));
    let filled: Vec<&str> = cells.iter().copied().filter(|cell| !cell.is_empty()).collect();
    let count = |axis: usize| {
        filled
            .iter()
            .filter(|cell| parse_point_part(cell) == Some(PointPart::Axis(axis)))
            .count()
    };
    let part_count = filled.iter().filter(|cell| parse_point_part(cell).is_some()).count();
    count(0) > 0 && count(0) == count(1) && part_count + 2 >= filled.len() && filled.len() < 2 * part_count + 1
}

/// Adds the points: a name holds until the next one.
fn add_stacked_points<'t>(
    layout: &mut PointTableLayout,
    names: &[&'t str],
    words: &[&'t str],
    people: Option<&[&'t str]>,
    lead: usize,
) {
    /// The columns of one point.
    #[derive(Default)]
    struct StackedPointColumns {
        axes: [Option<usize>; 3],
        sure: Option<(usize, QualityMeaning)>,
    }
    let mut found_points: Vec<((String, String), StackedPointColumns)> = Vec::new();
    let mut point_indices: BTreeMap<(String, String), usize> = BTreeMap::new();
    let (mut name, mut person) = ("", "");
    for (at, word) in words.iter().enumerate().skip(lead) {
        let filled = |row: &[&'t str]| row.get(at).copied().filter(|cell| !cell.is_empty());
        name = filled(names).unwrap_or(name);
        person = people.and_then(filled).unwrap_or(person);
        let key = (person.to_owned(), name.to_owned());
        let Some(part) = parse_point_part(word) else {
            if !word.is_empty() {
                layout.others.push((format!("{name} {word}"), at));
            }
            continue;
        };
        let free = |point: &StackedPointColumns| match part {
            PointPart::Axis(axis) => point.axes[axis].is_none(),
            PointPart::Fourth => false,
            PointPart::Sure(_) => point.sure.is_none(),
        };
        let free_place = point_indices
            .get(&key)
            .copied()
            .filter(|place| free(&found_points[*place].1));
        let place = free_place.unwrap_or_else(|| {
            point_indices.insert(key.clone(), found_points.len());
            found_points.push((key, StackedPointColumns::default()));
            found_points.len() - 1
        });
        match part {
            PointPart::Axis(axis) => found_points[place].1.axes[axis] = Some(at),
            PointPart::Fourth => {}
            PointPart::Sure(quality) => found_points[place].1.sure = Some((at, quality)),
        }
    }
    let wide = match found_points.iter().any(|(_, it)| it.axes.iter().all(Option::is_some)) {
        true => 3,
        false => 2,
    };
    let quality = found_points
        .iter()
        .find_map(|(_, it)| it.sure)
        .map(|(_, quality)| quality);
    layout.quality = quality;
    for ((person, name), it) in found_points {
        let axes: Vec<usize> = it.axes[..wide].iter().flatten().copied().collect();
        let sure = it.sure.filter(|(_, own)| Some(*own) == quality);
        if axes.len() < wide || wide == 2 && it.axes[2].is_some() {
            let rest = it.axes.iter().flatten().chain(it.sure.iter().map(|(at, _)| at));
            let title = |at: &usize| (format!("{name} {}", words[*at]), *at);
            let rest: Vec<(String, usize)> = rest.map(title).collect();
            layout.others.extend(rest);
            continue;
        }
        let mut place = PointColumns::with_grouped_name(&name, axes);
        if !person.is_empty() {
            place.group = person;
        }
        place.quality = sure.map(|(at, _)| at);
        layout.points.push(place);
    }
}
