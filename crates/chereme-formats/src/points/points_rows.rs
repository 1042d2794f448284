//! The columns of a table of points, and the numbers of its rows.

use std::borrow::Cow;

use chereme_motion::column::FileNumber;
use chereme_motion::{AxisDirection, QualityMeaning, RecordingInstant};

use super::PointTableError;
use super::lines::{TableTextLines, split_line_cells};
use crate::curves::ColumnTimeUnit;
use crate::finding::ImportFinding;
use crate::table::{MAX_PADDED_CELLS, is_gap};
use crate::tally::FindingTally;

/// The most columns of a table.
pub(super) const MAX_POINT_COLUMNS: usize = 100_000;

/// The columns of a point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PointColumns {
    pub(super) group: String,
    pub(super) name: String,
    /// The columns of its two or three coordinates.
    pub(super) axes: Vec<usize>,
    /// The column of its residual or confidence.
    pub(super) quality: Option<usize>,
}

impl PointColumns {
    /// Returns a place whose name may have a group before a colon, as in `Anna:LSHO`.
    pub(super) fn with_grouped_name(name: &str, axes: Vec<usize>) -> Self {
        let (group, name) = match name.rsplit_once(':') {
            Some((group, bare)) if !group.is_empty() && !bare.is_empty() => (group, bare),
            _ => ("", name),
        };
        Self {
            group: group.to_owned(),
            name: name.to_owned(),
            axes,
            quality: None,
        }
    }
}

/// The meaning of the columns of a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PointTableLayout {
    /// The program that wrote the file, if it is known.
    pub(super) program: &'static str,
    /// The line of the titles.
    pub(super) line: u64,
    /// The lines of the rows: from the first, up to the second if there is one.
    pub(super) rows: (u64, Option<u64>),
    pub(super) delimiter: char,
    /// The cells of a row.
    pub(super) width: usize,
    pub(super) points: Vec<PointColumns>,
    pub(super) frame: Option<usize>,
    pub(super) time: Option<(usize, ColumnTimeUnit)>,
    /// Columns of numbers that belong to no point, with their titles.
    pub(super) others: Vec<(String, usize)>,
    pub(super) quality: Option<QualityMeaning>,
    /// Frames a second, if they are stated.
    pub(super) rate: Option<f64>,
    /// The number of frames, if it is stated.
    pub(super) frames: Option<usize>,
    /// Metres of a unit of the places, if it is stated.
    pub(super) unit: Option<f64>,
    /// Whether the places are pixels.
    pub(super) pixels: bool,
    /// The direction that the program usually has up.
    pub(super) up: Option<AxisDirection>,
    pub(super) events: Vec<(RecordingInstant, String)>,
}

impl PointTableLayout {
    /// Returns the number of coordinates of a point.
    pub(super) fn coordinates_per_point(&self) -> usize {
        self.points.first().map_or(3, |point| point.axes.len())
    }
}

/// The numbers of the rows.
#[derive(Default)]
pub(super) struct PointTableRows {
    /// The lines of the rows.
    pub(super) lines: Vec<u64>,
    pub(super) frames: Vec<Option<FileNumber>>,
    pub(super) times: Vec<Option<FileNumber>>,
    /// The coordinates, point by point.
    pub(super) places: Vec<Vec<Option<FileNumber>>>,
    /// The qualities of the points that have one.
    pub(super) quality: Vec<Vec<Option<FileNumber>>>,
    pub(super) others: Vec<Vec<Option<FileNumber>>>,
}

impl PointTableRows {
    pub(super) fn read_point_rows(
        lines: &TableTextLines<'_>,
        layout: &PointTableLayout,
        findings: &mut FindingTally,
    ) -> Result<Self, PointTableError> {
        if layout.width > MAX_POINT_COLUMNS {
            return Err(PointTableError::Columns(MAX_POINT_COLUMNS));
        }
        let wide = layout.coordinates_per_point();
        let point_axes = layout.points.iter().flat_map(|point| &point.axes);
        let axes: Vec<usize> = point_axes.copied().collect();
        let sure: Vec<usize> = layout.points.iter().filter_map(|point| point.quality).collect();
        let mut rows = Self {
            places: vec![Vec::new(); layout.points.len() * wide],
            quality: vec![Vec::new(); sure.len()],
            others: vec![Vec::new(); layout.others.len()],
            ..Self::default()
        };
        let has_commas = has_commas(lines, layout);
        if has_commas {
            findings.push_note_finding(layout.rows.0, "the numbers have decimal commas");
        }
        let (first, end) = layout.rows;
        // Beside times or numbers of frames, a row without any number is a blank line.
        let has_clock = layout.frame.is_some() || layout.time.is_some();
        let all_rows = lines.data_row_lines(first, !has_clock);
        let data_rows = all_rows.take_while(|(line, _)| end.is_none_or(|end| *line < end));
        let (mut lacking, mut before, mut last) = (0, 0, 0);
        let mut widest = None;
        for (line, text) in data_rows {
            let cells = split_line_cells(text, layout.delimiter);
            // A delimiter at the end of every row is no cell; one row alone that is longer has a comma too many.
            let most = *widest.get_or_insert(cells.len().max(layout.width));
            let extra = cells.get(layout.width..).unwrap_or_default();
            if cells.len() > most || extra.iter().any(|cell| !cell.is_empty()) {
                return Err(PointTableError::Width {
                    line,
                    found: cells.len(),
                    expected: layout.width,
                });
            }
            lacking += layout.width.saturating_sub(cells.len());
            if lacking > MAX_PADDED_CELLS {
                return Err(PointTableError::Ragged { line, lacking });
            }
            (before, last) = (last, cells.len());
            let cell = |at: usize| cells.get(at).copied().unwrap_or_default();
            let parse = |at: usize| parse_point_number(cell(at), line, has_commas);
            rows.lines.push(line);
            let frame = layout.frame.map(|at| parse(at).unwrap_or(None));
            rows.frames.push(frame.flatten());
            let time = layout.time.map(|(at, _)| parse(at)).transpose()?;
            rows.times.push(time.flatten());
            for (column, at) in rows.places.iter_mut().zip(&axes) {
                column.push(parse(*at)?);
            }
            for (column, at) in rows.quality.iter_mut().zip(&sure) {
                column.push(parse(*at)?);
            }
            for (column, (title, at)) in rows.others.iter_mut().zip(&layout.others) {
                column.push(parse(*at).unwrap_or_else(|_| {
                    findings.add_limited_finding("cells without a number", || {
                        let cell: String = cell(*at).chars().take(40).collect();
                        let text = format!("{cell:?} of the column {title:?} is no number, and was left out");
                        ImportFinding::new_warning_finding(line, text)
                    });
                    None
                }));
            }
        }
        if rows.lines.is_empty() {
            return Err(PointTableError::Empty);
        }
        if !lines.is_whole && end.is_none() && last < before {
            report_cut_row(&rows, before, last, findings);
        }
        Ok(rows)
    }

    /// Makes gaps of places on a picture at 0 0 whose confidence is 0, as programs write points that they do not see.
    pub(super) fn open_unsure(&mut self, layout: &PointTableLayout) {
        let wide = layout.coordinates_per_point();
        if wide != 2 {
            return;
        }
        let is_nought = |number: &Option<FileNumber>| *number == Some(FileNumber::ZERO_NUMBER);
        let rated_points = layout.points.iter().enumerate();
        let sure = rated_points.filter(|(_, point)| point.quality.is_some());
        let sure: Vec<usize> = sure.map(|(at, _)| at).collect();
        for (at, quality) in sure.into_iter().zip(&self.quality) {
            let [x, y] = &mut self.places[wide * at..wide * at + wide] else {
                continue;
            };
            for ((x, y), quality) in x.iter_mut().zip(y).zip(quality) {
                if [&*x, &*y, quality].into_iter().all(is_nought) {
                    (*x, *y) = (None, None);
                }
            }
        }
    }
}

/// Returns whether the first rows have commas before their decimals, and no points.
fn has_commas(lines: &TableTextLines<'_>, layout: &PointTableLayout) -> bool {
    const COMMA_SAMPLE_LINES: usize = 200;
    if layout.delimiter == ',' {
        return false;
    }
    let data_lines = lines.filled_lines().skip_while(|(line, _)| *line < layout.rows.0);
    let (mut commas, mut points) = (false, false);
    for (_, text) in data_lines.take(COMMA_SAMPLE_LINES) {
        commas |= text.contains(',');
        points |= text.contains('.');
    }
    commas && !points
}

/// Reads a cell; an empty one and the words that programs write for a missing number are gaps.
pub(super) fn parse_point_number(
    cell: &str,
    line: u64,
    has_commas: bool,
) -> Result<Option<FileNumber>, PointTableError> {
    const MISSING_NUMBER_WORDS: [&str; 5] = ["null", "none", "-", "--", "#n/a"];
    if is_gap(cell) || MISSING_NUMBER_WORDS.iter().any(|word| cell.eq_ignore_ascii_case(word)) {
        return Ok(None);
    }
    let point = match has_commas && !cell.contains('.') {
        true => Cow::Owned(cell.replacen(',', ".", 1)),
        false => Cow::Borrowed(cell),
    };
    let parsed_number = FileNumber::parse_file_number(point.as_bytes()).ok();
    let parsed = parsed_number.filter(|number| number.to_f64().is_finite());
    parsed.map(Some).ok_or_else(|| PointTableError::Number {
        line,
        cell: cell.chars().take(40).collect(),
    })
}

/// Reports a last row without the end of its line that has fewer cells than the row before.
fn report_cut_row(rows: &PointTableRows, before: usize, last: usize, findings: &mut FindingTally) {
    findings.push_counted_finding(
        ImportFinding::new_warning_finding(
            rows.lines.last().copied(),
            format!(
                "the last row has {last} cells and the row before {before}; the file may be cut short, and the last number of that row too"
            ),
        )
        .with_remedy("export the take again from the program that recorded it"),
    );
}
