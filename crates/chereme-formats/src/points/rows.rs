//! The columns of a table of points, and the numbers of its rows.

use std::borrow::Cow;

use chereme_motion::column::Number;
use chereme_motion::{Direction, Instant, Quality};

use super::Error;
use super::lines::{Lines, cells};
use crate::curves::TimeUnit;
use crate::finding::Finding;
use crate::table::{PADDED, is_gap};
use crate::tally::Findings;

/// The most columns of a table.
pub(super) const COLUMNS: usize = 100_000;

/// The columns of a point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Place {
    pub(super) group: String,
    pub(super) name: String,
    /// The columns of its two or three coordinates.
    pub(super) axes: Vec<usize>,
    /// The column of its residual or confidence.
    pub(super) quality: Option<usize>,
}

impl Place {
    /// Returns a place whose name may have a group before a colon, as in `Anna:LSHO`.
    pub(super) fn named(name: &str, axes: Vec<usize>) -> Self {
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
pub(super) struct Layout {
    /// The program that wrote the file, if it is known.
    pub(super) program: &'static str,
    /// The line of the titles.
    pub(super) line: u64,
    /// The lines of the rows: from the first, up to the second if there is one.
    pub(super) rows: (u64, Option<u64>),
    pub(super) delimiter: char,
    /// The cells of a row.
    pub(super) width: usize,
    pub(super) points: Vec<Place>,
    pub(super) frame: Option<usize>,
    pub(super) time: Option<(usize, TimeUnit)>,
    /// Columns of numbers that belong to no point, with their titles.
    pub(super) others: Vec<(String, usize)>,
    pub(super) quality: Option<Quality>,
    /// Frames a second, if they are stated.
    pub(super) rate: Option<f64>,
    /// The number of frames, if it is stated.
    pub(super) frames: Option<usize>,
    /// Metres of a unit of the places, if it is stated.
    pub(super) unit: Option<f64>,
    /// Whether the places are pixels.
    pub(super) pixels: bool,
    /// The direction that the program usually has up.
    pub(super) up: Option<Direction>,
    pub(super) events: Vec<(Instant, String)>,
}

impl Layout {
    /// Returns the number of coordinates of a point.
    pub(super) fn wide(&self) -> usize {
        self.points.first().map_or(3, |point| point.axes.len())
    }
}

/// The numbers of the rows.
#[derive(Default)]
pub(super) struct Rows {
    /// The lines of the rows.
    pub(super) lines: Vec<u64>,
    pub(super) frames: Vec<Option<Number>>,
    pub(super) times: Vec<Option<Number>>,
    /// The coordinates, point by point.
    pub(super) places: Vec<Vec<Option<Number>>>,
    /// The qualities of the points that have one.
    pub(super) quality: Vec<Vec<Option<Number>>>,
    pub(super) others: Vec<Vec<Option<Number>>>,
}

impl Rows {
    pub(super) fn read(
        lines: &Lines<'_>,
        layout: &Layout,
        findings: &mut Findings,
    ) -> Result<Self, Error> {
        if layout.width > COLUMNS {
            return Err(Error::Columns(COLUMNS));
        }
        let wide = layout.wide();
        let axes = layout.points.iter().flat_map(|point| &point.axes);
        let axes: Vec<usize> = axes.copied().collect();
        let sure: Vec<usize> = layout.points.iter().filter_map(|it| it.quality).collect();
        let mut rows = Self {
            places: vec![Vec::new(); layout.points.len() * wide],
            quality: vec![Vec::new(); sure.len()],
            others: vec![Vec::new(); layout.others.len()],
            ..Self::default()
        };
        let has_commas = has_commas(lines, layout);
        if has_commas {
            findings.push(Finding::note(
                layout.rows.0,
                "the numbers have decimal commas",
            ));
        }
        let (first, end) = layout.rows;
        // Beside times or numbers of frames, a row without any number is a blank line.
        let has_clock = layout.frame.is_some() || layout.time.is_some();
        let held = lines.rows(first, !has_clock);
        let held = held.take_while(|(line, _)| end.is_none_or(|end| *line < end));
        let (mut lacking, mut before, mut last) = (0, 0, 0);
        let mut widest = None;
        for (line, text) in held {
            let cells = cells(text, layout.delimiter);
            // A delimiter at the end of every row is no cell; one row alone that is longer has a comma too many.
            let most = *widest.get_or_insert(cells.len().max(layout.width));
            let extra = cells.get(layout.width..).unwrap_or_default();
            if cells.len() > most || extra.iter().any(|cell| !cell.is_empty()) {
                return Err(Error::Width {
                    line,
                    found: cells.len(),
                    expected: layout.width,
                });
            }
            lacking += layout.width.saturating_sub(cells.len());
            if lacking > PADDED {
                return Err(Error::Ragged { line, lacking });
            }
            (before, last) = (last, cells.len());
            let cell = |at: usize| cells.get(at).copied().unwrap_or_default();
            let parse = |at: usize| number(cell(at), line, has_commas);
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
                    findings.add("cells without a number", || {
                        let cell: String = cell(*at).chars().take(40).collect();
                        let text = format!(
                            "{cell:?} of the column {title:?} is no number, and was left out"
                        );
                        Finding::warning(line, text)
                    });
                    None
                }));
            }
        }
        if rows.lines.is_empty() {
            return Err(Error::Empty);
        }
        if !lines.is_whole && end.is_none() && last < before {
            report_cut_row(&rows, (before, last), findings);
        }
        Ok(rows)
    }

    /// Makes gaps of places on a picture at 0 0 whose confidence is 0, as programs write points that they do not see.
    pub(super) fn open_unsure(&mut self, layout: &Layout) {
        let wide = layout.wide();
        if wide != 2 {
            return;
        }
        let is_nought = |number: &Option<Number>| *number == Some(Number::ZERO);
        let sure = layout.points.iter().enumerate();
        let sure = sure.filter(|(_, point)| point.quality.is_some());
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
fn has_commas(lines: &Lines<'_>, layout: &Layout) -> bool {
    const LOOKED_AT: usize = 200;
    if layout.delimiter == ',' {
        return false;
    }
    let held = lines.filled().skip_while(|(line, _)| *line < layout.rows.0);
    let (mut commas, mut points) = (false, false);
    for (_, text) in held.take(LOOKED_AT) {
        commas |= text.contains(',');
        points |= text.contains('.');
    }
    commas && !points
}

/// Reads a cell; an empty one and the words that programs write for a missing number are gaps.
pub(super) fn number(cell: &str, line: u64, has_commas: bool) -> Result<Option<Number>, Error> {
    const WORDS: [&str; 5] = ["null", "none", "-", "--", "#n/a"];
    if is_gap(cell) || WORDS.iter().any(|word| cell.eq_ignore_ascii_case(word)) {
        return Ok(None);
    }
    let point = match has_commas && !cell.contains('.') {
        true => Cow::Owned(cell.replacen(',', ".", 1)),
        false => Cow::Borrowed(cell),
    };
    let parsed = Number::parse(point.as_bytes()).ok();
    let parsed = parsed.filter(|number| number.to_f64().is_finite());
    parsed.map(Some).ok_or_else(|| Error::Number {
        line,
        cell: cell.chars().take(40).collect(),
    })
}

/// Reports a last row without the end of its line that has fewer cells than the row before.
fn report_cut_row(rows: &Rows, (before, last): (usize, usize), findings: &mut Findings) {
    findings.push(
        Finding::warning(
            rows.lines.last().copied(),
            format!(
                "the last row has {last} cells and the row before {before}; the file may be cut short, and the last number of that row too"
            ),
        )
        .with_remedy("export the take again from the program that recorded it"),
    );
}
