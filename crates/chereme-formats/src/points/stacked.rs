//! Titles over several rows: names above `x`, `y`, `z` or `likelihood`, as DeepLabCut and tables of pandas have them.

use std::collections::BTreeMap;

use chereme_motion::Quality;

use super::lines::{Lines, cells, delimiter};
use super::rows::{Layout, Place, number};
use super::titles::{Part, part};
use crate::curves::{TimeUnit, unit_of_time};
use crate::tracks::metres_of_unit;

/// The first lines among which the row of axes is looked for.
const LOOKED_AT: usize = 6;
/// The rows below them that are looked at.
const ROWS: usize = 20;

/// Returns the columns of a table whose titles take several rows; `None` if it has no row of axes below a row of names.
pub(super) fn layout(lines: &Lines<'_>) -> Option<Layout> {
    let first = lines.first(LOOKED_AT);
    let at = (1..first.len()).find(|at| is_axes(first[*at].1))?;
    let (line, axes) = first[at];
    let delimiter = delimiter(axes);
    let axes = cells(axes, delimiter);
    let names = cells(first[at - 1].1, delimiter);
    let lead = axes.iter().position(|it| part(it).is_some())?;
    if lead > 2
        || !axes[..lead].iter().all(|word| is_lead(word))
        || names
            .iter()
            .skip(lead)
            .all(|it| it.is_empty() || it.parse::<f64>().is_ok())
    {
        return None;
    }
    let above = first[..at].iter().map(|(_, text)| cells(text, delimiter));
    let people: Option<Vec<&str>> = above
        .clone()
        .find(|row| row[0].eq_ignore_ascii_case("individuals"));
    let mut first_row = line + 1;
    let mut unit = None;
    if let Some((next, text)) = first.get(at + 1) {
        let units = cells(text, delimiter);
        let named = units.iter().find(|it| !it.is_empty());
        unit = named
            .and_then(|it| metres_of_unit(it))
            .filter(|_| units[0].is_empty());
        if unit.is_some() {
            first_row = next + 1;
        }
    }
    let mut layout = Layout {
        line,
        rows: (first_row, None),
        delimiter,
        width: axes.len().max(names.len()),
        unit,
        ..Layout::default()
    };
    for title in 0..lead {
        // The label of a row of names stands in the column of the numbers of frames.
        let title_of = |row: &[&str]| row.get(title).map_or(String::new(), |it| it.to_lowercase());
        match unit_of_time(&title_of(&axes)) {
            Some(TimeUnit::Seconds(unit)) => layout.time = Some((title, TimeUnit::Seconds(unit))),
            _ if layout.frame.is_none() => layout.frame = Some(title),
            _ => {}
        }
    }
    points(&mut layout, &names, &axes, people.as_deref(), lead);
    let below = lines.first(LOOKED_AT + ROWS);
    let below = below.iter().filter(|(line, _)| *line >= layout.rows.0);
    let below: Vec<Vec<&str>> = below.map(|(_, text)| cells(text, delimiter)).collect();
    // The last one may be cut where the beginning of a file ends.
    let whole = below.len().saturating_sub(usize::from(below.len() > 1));
    let columns = layout.points.iter().flat_map(|point| &point.axes);
    let columns: Vec<usize> = columns.copied().collect();
    let is_number = |row: &Vec<&str>| {
        let cell = |at: &usize| row.get(*at).copied().unwrap_or_default();
        columns
            .iter()
            .all(|at| number(cell(at), 0, delimiter != ',').is_ok())
    };
    let holds = !layout.points.is_empty() && below[..whole].iter().all(is_number);
    holds.then_some(layout)
}

/// Returns whether a word may stand beside the axes: that of the row of titles, of frames or of times.
fn is_lead(word: &str) -> bool {
    const WORDS: [&str; 13] = [
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
    WORDS.contains(&word.as_str()) || unit_of_time(&word).is_some()
}

/// Returns whether a line holds axes: `x` and `y` and no other words but that of the row, of frames and of times.
fn is_axes(line: &str) -> bool {
    let cells = cells(line, delimiter(line));
    let filled: Vec<&str> = cells.iter().copied().filter(|it| !it.is_empty()).collect();
    let count = |axis: usize| {
        filled
            .iter()
            .filter(|it| part(it) == Some(Part::Axis(axis)))
            .count()
    };
    let known = filled.iter().filter(|it| part(it).is_some()).count();
    count(0) > 0
        && count(0) == count(1)
        && known + 2 >= filled.len()
        && filled.len() < 2 * known + 1
}

/// Adds the points: a name holds until the next one.
fn points<'t>(
    layout: &mut Layout,
    names: &[&'t str],
    words: &[&'t str],
    people: Option<&[&'t str]>,
    lead: usize,
) {
    /// The columns of one point.
    #[derive(Default)]
    struct Found {
        axes: [Option<usize>; 3],
        sure: Option<(usize, Quality)>,
    }
    let mut found: Vec<((String, String), Found)> = Vec::new();
    let mut known: BTreeMap<(String, String), usize> = BTreeMap::new();
    let (mut name, mut person) = ("", "");
    for (at, word) in words.iter().enumerate().skip(lead) {
        let filled = |row: &[&'t str]| row.get(at).copied().filter(|it| !it.is_empty());
        name = filled(names).unwrap_or(name);
        person = people.and_then(filled).unwrap_or(person);
        let key = (person.to_owned(), name.to_owned());
        let Some(part) = part(word) else {
            if !word.is_empty() {
                layout.others.push((format!("{name} {word}"), at));
            }
            continue;
        };
        let free = |it: &Found| match part {
            Part::Axis(axis) => it.axes[axis].is_none(),
            Part::Fourth => false,
            Part::Sure(_) => it.sure.is_none(),
        };
        let place = known
            .get(&key)
            .copied()
            .filter(|place| free(&found[*place].1));
        let place = place.unwrap_or_else(|| {
            known.insert(key.clone(), found.len());
            found.push((key, Found::default()));
            found.len() - 1
        });
        match part {
            Part::Axis(axis) => found[place].1.axes[axis] = Some(at),
            Part::Fourth => {}
            Part::Sure(quality) => found[place].1.sure = Some((at, quality)),
        }
    }
    let wide = match found
        .iter()
        .any(|(_, it)| it.axes.iter().all(Option::is_some))
    {
        true => 3,
        false => 2,
    };
    let quality = found
        .iter()
        .find_map(|(_, it)| it.sure)
        .map(|(_, quality)| quality);
    layout.quality = quality;
    for ((person, name), it) in found {
        let axes: Vec<usize> = it.axes[..wide].iter().flatten().copied().collect();
        let sure = it.sure.filter(|(_, own)| Some(*own) == quality);
        if axes.len() < wide || wide == 2 && it.axes[2].is_some() {
            let rest = it
                .axes
                .iter()
                .flatten()
                .chain(it.sure.iter().map(|(at, _)| at));
            let title = |at: &usize| (format!("{name} {}", words[*at]), *at);
            let rest: Vec<(String, usize)> = rest.map(title).collect();
            layout.others.extend(rest);
            continue;
        }
        let mut place = Place::named(&name, axes);
        if !person.is_empty() {
            place.group = person;
        }
        place.quality = sure.map(|(at, _)| at);
        layout.points.push(place);
    }
}
