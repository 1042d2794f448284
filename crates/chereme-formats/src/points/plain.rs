//! Tables with one row of titles, which name a point and its axis: what people's own scripts write.

use std::collections::BTreeSet;

use super::PointTableError;
use super::lines::{TableTextLines, detect_column_delimiter, split_line_cells};
use super::points_rows::{MAX_POINT_COLUMNS, PointTableLayout, parse_point_number};
use super::titles::{self, TitledPoints};
use crate::curves::{ColumnTimeUnit, unit_of_time};
use crate::faces::FaceSystem;
use crate::finding::ImportFinding;
use crate::tally::FindingTally;

/// The first rows whose cells are looked at.
const PLAIN_SAMPLE_ROWS: usize = 20;

/// The titles of a table.
struct PlainTableTitles<'t> {
    line: u64,
    delimiter: char,
    all: Vec<&'t str>,
    named: TitledPoints,
    frame: Option<usize>,
    time: Option<(usize, ColumnTimeUnit)>,
}

/// Returns the titles of a table: its first line that is neither blank nor a comment.
fn titles<'t>(first: &[(u64, &'t str)]) -> Option<PlainTableTitles<'t>> {
    // Titles may begin with a `#`, too, as `#frame` or `# time`.
    let is_comment =
        |line: &str| line.starts_with('#') && !line[1..].trim_start().to_lowercase().starts_with(['f', 't']);
    let (line, text) = *first.iter().find(|(_, line)| !is_comment(line))?;
    let delimiter = detect_column_delimiter(text);
    let all = split_line_cells(text.trim_start_matches('#'), delimiter);
    if all.len() > MAX_POINT_COLUMNS {
        return None;
    }
    let named = titles::find_titled_points(&all);
    let free = |at: &usize| !named.used.contains(at);
    let unit = |at: usize| Some((at, unit_of_time(all[at])?));
    let time = (0..all.len()).filter(free).find_map(unit);
    let is_frame = |at: &usize| free(at) && counts_frames(all[*at], *at);
    let frame = (0..all.len()).find(is_frame);
    Some(PlainTableTitles {
        line,
        delimiter,
        named,
        frame,
        time,
        all,
    })
}

/// Returns whether a title is that of numbers of frames; the first column of a table may have none.
fn counts_frames(title: &str, at: usize) -> bool {
    let plain: String = title
        .to_lowercase()
        .chars()
        .filter(|character| character.is_alphanumeric())
        .collect();
    let frame_titles = [
        "frame",
        "frames",
        "fnum",
        "framenumber",
        "frameno",
        "framenum",
        "frameid",
        "frameidx",
        "frameindex",
        "index",
        "image",
    ];
    frame_titles.contains(&plain.as_str()) || title.is_empty() && at == 0 || plain == "unnamed0"
}

/// Returns whether a title is that of a lexicon, of annotations or of trials, whose rows are no frames.
fn names_other(title: &str) -> bool {
    const NON_FRAME_TITLE_WORDS: [&str; 15] = [
        "gloss",
        "glosses",
        "idgloss",
        "lemma",
        "sign",
        "signs",
        "word",
        "handshape",
        "tier",
        "annotation",
        "participant",
        "trial",
        "item",
        "condition",
        "stimulus",
    ];
    let title = title.to_lowercase();
    let mut words = title.split(|letter: char| !letter.is_alphanumeric());
    words.any(|word| NON_FRAME_TITLE_WORDS.contains(&word))
}

/// Returns whether a table that begins with these lines holds points: most of its columns are points, and their cells
/// numbers.
pub(super) fn is_plain_point_table(lines: &TableTextLines<'_>) -> bool {
    let first = lines.first_filled_lines(PLAIN_SAMPLE_ROWS + 5);
    let Some(titles) = titles(&first) else {
        return false;
    };
    let (named, width) = (&titles.named, titles.all.len());
    let is_face = FaceSystem::of_names(titles.all.iter().copied()).is_some();
    let is_other = titles.all.iter().any(|title| names_other(title));
    if named.points.is_empty() || is_face || is_other || width < 3 {
        return false;
    }
    let row_lines = first.iter().filter(|(line, _)| *line > titles.line);
    let mut rows: Vec<(u64, Vec<&str>)> = row_lines
        .map(|(line, text)| (*line, split_line_cells(text, titles.delimiter)))
        .collect();
    // The bytes may end within their last row.
    if !lines.is_whole && rows.len() > 1 {
        rows.pop();
    }
    let has_commas = titles.delimiter != ',';
    let read = |line: u64, row: &[&str], at: usize| {
        parse_point_number(row.get(at).copied().unwrap_or_default(), line, has_commas)
    };
    let point_axes = named.points.iter().flat_map(|point| &point.axes);
    let of_points: Vec<usize> = point_axes.copied().collect();
    let is_number = |(line, row): &(u64, Vec<&str>)| of_points.iter().all(|at| read(*line, row, *at).is_ok());
    let has_number =
        |(line, row): &(u64, Vec<&str>)| of_points.iter().any(|at| matches!(read(*line, row, *at), Ok(Some(_))));
    // The first rows of a capture may be gaps alone.
    let is_timed = titles.time.is_some() || titles.frame.is_some();
    if !rows.iter().all(is_number) || !is_timed && !rows.iter().any(has_number) {
        return false;
    }
    let clocks = usize::from(titles.frame.is_some()) + usize::from(titles.time.is_some());
    let others = width - clocks - named.used.len().min(width - clocks);
    let is_text = |at: &usize| rows.iter().any(|(line, row)| read(*line, row, *at).is_err());
    let texts: Vec<usize> = (0..width).filter(is_text).collect();
    // Rows with names of their own are things, not frames.
    let is_named = |at: &usize| {
        let cells = rows.iter().filter_map(|(_, row)| row.get(*at));
        let word_cells = cells.filter(|cell| cell.starts_with(char::is_alphabetic));
        let words: BTreeSet<&&str> = word_cells.collect();
        words.len() > 2 && words.len() == rows.len()
    };
    if texts.iter().any(is_named) {
        return false;
    }
    let texts = texts.len();
    // Without a clock or a quality, a point in space or two on a picture are needed, and no text.
    let least = if named.points[0].axes.len() == 3 { 1 } else { 2 };
    let is_clear = clocks > 0 || named.quality.is_some() || named.points.len() > least;
    let fits = match texts {
        0 => others <= named.used.len(),
        _ => 3 * others <= named.used.len(),
    };
    // Two numbers called x and y among others may be anything.
    let is_alone = least == 2 && named.points.len() == 1 && named.quality.is_none();
    fits && (!is_alone || others == 0) && (is_clear || texts == 0 && least == 1)
}

pub(super) fn read_plain_layout(
    lines: &TableTextLines<'_>,
    findings: &mut FindingTally,
) -> Result<PointTableLayout, PointTableError> {
    let first = lines.first_filled_lines(PLAIN_SAMPLE_ROWS);
    let wide = first
        .iter()
        .any(|(_, line)| split_line_cells(line, detect_column_delimiter(line)).len() > MAX_POINT_COLUMNS);
    let titles = titles(&first).ok_or(if wide {
        PointTableError::Columns(MAX_POINT_COLUMNS)
    } else {
        PointTableError::Empty
    })?;
    if titles.named.points.is_empty() {
        return Err(PointTableError::Unknown);
    }
    refuse_long_table(&titles, &first)?;
    let taken = |at: &usize| {
        titles.named.used.contains(at) || titles.frame == Some(*at) || titles.time.is_some_and(|(time, _)| time == *at)
    };
    let rows: Vec<(u64, Vec<&str>)> = first
        .iter()
        .filter(|(line, _)| *line > titles.line)
        .map(|(line, text)| (*line, split_line_cells(text, titles.delimiter)))
        .collect();
    // A column counts as text if one of its first cells is no number.
    let is_text = |at: usize| {
        rows.iter().any(|(line, row)| {
            let cell = row.get(at).copied().unwrap_or_default();
            parse_point_number(cell, *line, titles.delimiter != ',').is_err()
        })
    };
    let free: Vec<usize> = (0..titles.all.len()).filter(|at| !taken(at)).collect();
    let (texts, others): (Vec<usize>, Vec<usize>) = free.into_iter().partition(|at| is_text(*at));
    if !texts.is_empty() {
        let named: Vec<String> = texts.iter().map(|at| titles.all[*at].to_owned()).collect();
        let text = format!(
            "columns of text are left out: {}",
            crate::table::join_column_names(&named)
        );
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(titles.line, text).with_remedy(
                "annotations are imported from a table with a row for each: its tier, begin, end and value",
            ),
        );
    }
    let others = others.into_iter().map(|at| (titles.all[at].to_owned(), at));
    Ok(PointTableLayout {
        line: titles.line,
        rows: (titles.line + 1, None),
        delimiter: titles.delimiter,
        width: titles.all.len(),
        frame: titles.frame,
        time: titles.time,
        others: others.collect(),
        quality: titles.named.quality,
        unit: titles.named.unit,
        pixels: titles.named.pixels,
        points: titles.named.points,
        ..PointTableLayout::default()
    })
}

/// Refuses a table with a row for each point of a frame.
fn refuse_long_table(titles: &PlainTableTitles<'_>, first: &[(u64, &str)]) -> Result<(), PointTableError> {
    const POINT_TITLE_WORDS: [&str; 8] = [
        "marker", "landmark", "joint", "keypoint", "bodypart", "point", "label", "name",
    ];
    let names = |title: &str| POINT_TITLE_WORDS.iter().any(|name| title.to_lowercase().contains(name));
    let clock = titles.time.map(|(time, _)| time).or(titles.frame);
    let free = |at: &usize| {
        let is_clock = titles.frame == Some(*at) || clock == Some(*at);
        !is_clock && !titles.named.used.contains(at)
    };
    let free: Vec<usize> = (0..titles.all.len()).filter(free).collect();
    let column = free.iter().find(|at| names(titles.all[**at]));
    let (Some(column), Some(clock)) = (column.or(free.first()), clock) else {
        return Ok(());
    };
    let rows = first.iter().filter(|(line, _)| *line > titles.line);
    let frames: Vec<&str> = rows
        .map(|(_, text)| {
            split_line_cells(text, titles.delimiter)
                .get(clock)
                .copied()
                .unwrap_or_default()
        })
        .collect();
    let repeats = frames.windows(2).any(|pair| pair[0] == pair[1] && !pair[0].is_empty());
    match repeats && titles.named.points.len() == 1 {
        true => Err(PointTableError::Long {
            column: titles.all[*column].to_owned(),
        }),
        false => Ok(()),
    }
}
