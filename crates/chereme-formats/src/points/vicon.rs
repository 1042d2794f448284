//! The CSV of Vicon Nexus: sections, each with a title, a rate, and rows of titles.

use chereme_motion::{Direction, Instant};
use glam::DVec3;

use super::Error;
use super::lines::{Lines, cells};
use super::rows::{Layout, Place};
use crate::finding::Finding;
use crate::tally::Findings;
use crate::timecode::DAY;
use crate::tracks::metres_of_unit;

/// The section of markers.
const TRAJECTORIES: &str = "trajectories";
/// Sections that such a file may begin with.
const SECTIONS: [&str; 8] = [
    TRAJECTORIES,
    "devices",
    "model outputs",
    "joints",
    "segments",
    "events",
    "force plates",
    "forceplates",
];

/// Returns whether the file begins with a section of Nexus.
pub(super) fn begins(lines: &Lines<'_>) -> bool {
    let first = lines.first(5);
    let Some((_, title)) = first.first() else {
        return false;
    };
    let is_frame = |line: &str| {
        let mut cells = line
            .split([',', ';', '\t'])
            .map(|it| it.trim_matches([' ', '"']));
        let first = cells.next().unwrap_or_default();
        let second = cells.next().unwrap_or_default().to_lowercase();
        counts(first) && (second.replace(' ', "") == "subframe" || second == "x")
    };
    let known = section(title).is_some_and(|it| SECTIONS.contains(&it.to_lowercase().as_str()));
    let is_event = |line: &str| line.to_lowercase().starts_with("subject,context");
    known
        && first
            .iter()
            .any(|(_, line)| is_frame(line) || is_event(line))
}

/// Returns the title of a section: the only cell of its line, which is no number.
fn section(line: &str) -> Option<&str> {
    let bare = line.trim_matches([',', ';', '\t', ' ', '"']);
    let has_one = !bare.contains([',', ';', '\t']) && bare.len() < 60;
    (has_one && bare.parse::<f64>().is_err() && !bare.is_empty()).then_some(bare)
}

/// Returns the rate of a line that holds nothing else but its unit.
fn rate(line: &str) -> Option<f64> {
    let bare = line.trim_end_matches([',', ';', '\t', ' ', '"']);
    let bare = bare.strip_suffix("Hz").unwrap_or(bare);
    let bare = bare.trim_matches([',', ';', '\t', ' ', '"']);
    let rate = bare.replacen(',', ".", 1).parse::<f64>().ok()?;
    (rate.is_finite() && rate > 0.0).then_some(rate)
}

/// Returns whether a title is that of the numbers of frames; old versions call them fields.
fn counts(title: &str) -> bool {
    ["frame", "field #", "field"]
        .iter()
        .any(|word| title.eq_ignore_ascii_case(word))
}

pub(super) fn layout(lines: &Lines<'_>, findings: &mut Findings) -> Result<Layout, Error> {
    let mut found: Vec<(u64, &str)> = Vec::new();
    let mut before: Option<(u64, &str)> = None;
    for (line, text) in lines.filled() {
        // Only lines of one cell are compared, so that long rows cost nothing.
        if text.len() < 80 {
            if let (Some((at, title)), Some(_)) = (before, rate(text)) {
                found.push((at, title));
            }
            before = section(text).map(|title| (line, title));
        } else {
            before = None;
        }
    }
    let named = |(_, title): &(u64, &str)| title.eq_ignore_ascii_case(TRAJECTORIES);
    let are_events = |title: &str| title.eq_ignore_ascii_case("events");
    let others = found
        .iter()
        .filter(|it| !named(it))
        .map(|(_, title)| *title);
    let others: Vec<&str> = others.filter(|title| !are_events(title)).collect();
    let events = found.iter().find(|(_, title)| are_events(title));
    let events = events.map_or(Vec::new(), |(line, _)| events_below(lines, *line));
    let Some(at) = found.iter().position(named) else {
        return Err(match others.is_empty() {
            true => Error::Empty,
            false => Error::Sections(others.join(", ")),
        });
    };
    let (begin, _) = found[at];
    let end = found.get(at + 1).map(|(line, _)| *line);
    if found.iter().filter(|it| named(it)).count() > 1 {
        let text = "a second section Trajectories is left out";
        findings.push(
            Finding::warning(
                found
                    .iter()
                    .rev()
                    .find(|it| named(it))
                    .map(|(line, _)| *line),
                text,
            )
            .with_remedy("put it into a file of its own"),
        );
    }
    if !others.is_empty() {
        let text = format!("sections of other data are left out: {}", others.join(", "));
        findings.push(
            Finding::warning(found[0].0, text).with_remedy(
                "export the trial as C3D, which holds analog channels and events, too",
            ),
        );
    }
    let mut rows = lines.filled().skip_while(|(line, _)| *line < begin).skip(1);
    let rate = rows.next().and_then(|(_, text)| rate(text));
    let (_, names) = rows.next().ok_or(Error::Missing("markers' names"))?;
    let (line, titles) = rows
        .next()
        .ok_or(Error::Missing("axes, which begins with Frame"))?;
    let delimiter = titles
        .chars()
        .find(|it| [',', ';', '\t'].contains(it))
        .unwrap_or(',');
    let (names, titles) = (cells(names, delimiter), cells(titles, delimiter));
    if !counts(titles[0]) {
        return Err(Error::Missing("axes, which begins with Frame"));
    }
    let mut unit = None;
    let mut first = line + 1;
    if let Some((line, text)) = rows.next() {
        let units = cells(text, delimiter);
        if units[0].parse::<f64>().is_err() {
            let known = units.iter().find(|it| !it.is_empty());
            unit = known.and_then(|it| metres_of_unit(it));
            first = line + 1;
        }
    }
    if unit.is_none() {
        findings.push(Finding::note(
            line,
            "no row of units; millimetres are assumed",
        ));
    }
    let points = points(&names, &titles, findings, line);
    if points.is_empty() {
        return Err(Error::Empty);
    }
    Ok(Layout {
        program: "Vicon Nexus",
        line,
        rows: (first, end),
        delimiter,
        width: titles.len().max(names.len()),
        points,
        frame: Some(0),
        rate,
        unit: Some(unit.unwrap_or(0.001)),
        up: Some(Direction::nearest(DVec3::Z)),
        events,
        ..Layout::default()
    })
}

/// Returns the events of the section whose title is at `line`: rows of subject, context, name and seconds.
fn events_below(lines: &Lines<'_>, line: u64) -> Vec<(Instant, String)> {
    const MOST: usize = 100_000;
    let rows = lines.filled().skip_while(|(at, _)| *at <= line).skip(2);
    let event = |text: &str| {
        let delimiter = text.chars().find(|it| [',', ';', '\t'].contains(it))?;
        let cells = cells(text, delimiter);
        let [_, context, name, time, ..] = cells[..] else {
            return None;
        };
        let seconds: f64 = time.parse().ok()?;
        let is_sound = seconds.is_finite() && (0.0..DAY).contains(&seconds) && !name.is_empty();
        let name = [context, name].into_iter().filter(|it| !it.is_empty());
        let name = name.collect::<Vec<_>>().join(" ");
        is_sound.then(|| (Instant::from_seconds(seconds), name))
    };
    rows.map_while(|(_, text)| event(text)).take(MOST).collect()
}

/// Returns the markers: a name stands above the first of its columns.
fn points(names: &[&str], titles: &[&str], findings: &mut Findings, line: u64) -> Vec<Place> {
    let mut found: Vec<(Place, [Option<usize>; 3])> = Vec::new();
    let mut others = 0;
    for (at, title) in titles.iter().enumerate().skip(1) {
        let name = names.get(at).copied().unwrap_or_default();
        let axis = ["x", "y", "z"]
            .iter()
            .position(|it| title.eq_ignore_ascii_case(it));
        let Some(axis) = axis else {
            others += usize::from(!title.is_empty() && !title.to_lowercase().starts_with("sub"));
            continue;
        };
        let is_new = !name.is_empty() || found.last().is_none_or(|(_, axes)| axes[axis].is_some());
        if is_new {
            found.push((Place::named(name, Vec::new()), [None; 3]));
        }
        if let Some((_, axes)) = found.last_mut() {
            axes[axis] = Some(at);
        }
    }
    if others > 0 {
        let text = format!(
            "columns of trajectories that are no places, such as velocities, are left out: {others}"
        );
        findings.push(Finding::note(line, text));
    }
    let whole = found.into_iter().filter_map(|(place, [x, y, z])| {
        let axes = vec![x?, y?, z?];
        Some(Place { axes, ..place })
    });
    whole.collect()
}
