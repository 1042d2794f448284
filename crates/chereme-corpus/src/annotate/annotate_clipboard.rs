//! Annotations as text on the clipboard: a table with tabs, as spreadsheets write and read it.
//!
//! Copied text has the columns `tier`, `start`, `end` and `value`, times in seconds. Pasted text may have them in
//! any order and by other names, or no titles and two times in each line; a single column is values, and a line
//! without tabs one value.

use std::borrow::Cow;

use chereme_formats::table::annotations::TableMoment;
use chereme_formats::table::{tab_rows, write_tab_rows};
use chereme_motion::RecordingInstant;
use chereme_sign::text::fold_text;

/// An annotation in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CopiedAnnotation {
    /// The line of the text, counted from 1.
    pub line: usize,
    /// The name of its tier, if the text has one.
    pub tier: Option<String>,
    /// Its start, in microseconds.
    pub start: i64,
    /// Its end, in microseconds.
    pub end: i64,
    /// Its value, as it is typed.
    pub value: String,
}

/// A line that is not understood, or whose annotation has no place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OddLine {
    /// The line of the text, counted from 1.
    pub line: usize,
    /// The reason.
    pub why: OddReason,
    /// The part of the line that the reason concerns, or the time.
    pub text: String,
    /// The time, if the reason concerns one.
    pub at: Option<RecordingInstant>,
}

/// The reason why a line is not understood, or its annotation has no place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OddReason {
    /// A time is not readable.
    Time,
    /// The line lacks a start or an end.
    Row,
    /// The end is not after the start.
    Ends,
    /// The recording lacks the tier.
    Tier,
    /// The tier does not allow the value.
    Value,
    /// The annotation is not within the recording.
    Outside,
    /// No annotation of the parent tier contains it.
    Parent,
    /// The time is occupied.
    Taken,
    /// More values than annotations.
    Left,
}

impl OddLine {
    /// Returns the fault as a sentence without a full stop.
    #[must_use]
    pub fn odd_line_fault(&self) -> String {
        let text = &self.text;
        match self.why {
            OddReason::Time => format!("{text:?} is no time: write 1.5, 0:01.500 or f12"),
            OddReason::Row => format!("no start and end in {text:?}"),
            OddReason::Ends => format!("it ends at {text}, which is not after its start"),
            OddReason::Tier => format!("the recording has no tier {text:?}"),
            OddReason::Value => format!("{text:?} is no value of its tier"),
            OddReason::Outside => {
                format!("the annotation that begins at {text} is not within the recording")
            }
            OddReason::Parent => format!("no annotation of the parent tier contains {text}"),
            OddReason::Taken => format!("there is an annotation already at {text}"),
            OddReason::Left => format!("no annotation is left for {text:?}"),
        }
    }
}

/// The contents of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ClipboardText {
    /// Annotations, and lines that cannot be read.
    Rows(Vec<CopiedAnnotation>, Vec<OddLine>),
    /// Values, one below the other, each with its line number.
    Values(Vec<(usize, String)>),
}

/// Returns annotations as text, each given as `(tier, start, end, value)` with times in microseconds.
#[must_use]
pub fn write_clipboard_text<'a>(rows: impl Iterator<Item = (&'a str, i64, i64, String)>) -> String {
    let titles = ["tier", "start", "end", "value"].map(Cow::Borrowed);
    let rows = rows.map(|(tier, start, end, value)| {
        let (start, end) = (
            format_clipboard_seconds(start).into(),
            format_clipboard_seconds(end).into(),
        );
        [tier.into(), start, end, value.into()]
    });
    let all: Vec<[Cow<'_, str>; 4]> = std::iter::once(titles).chain(rows).collect();
    write_tab_rows(&all)
}

/// Returns a time in seconds, with microseconds if necessary.
fn format_clipboard_seconds(micros: i64) -> String {
    let sign = if micros < 0 { "-" } else { "" };
    let (whole, part) = (micros.abs() / 1_000_000, micros.abs() % 1_000_000);
    let part = format!("{part:06}");
    let short = part.trim_end_matches('0');
    format!("{sign}{whole}.{}", &part[..short.len().max(3)])
}

/// Reads a text; `frame` returns the time of a frame in microseconds.
pub fn read_clipboard_text(text: &str, frame: impl Fn(u64) -> Option<i64>) -> ClipboardText {
    let raw_rows = tab_rows(text).into_iter();
    let rows: Vec<(usize, Vec<String>)> = raw_rows
        .map(|(line, cells)| (usize::try_from(line).unwrap_or(usize::MAX), cells))
        .collect();
    if rows.iter().all(|(_, cells)| cells.len() == 1) {
        let values = rows.into_iter().map(|(line, mut cells)| (line, cells.remove(0)));
        return ClipboardText::Values(values.collect());
    }
    let mut odd = Vec::new();
    let titled = rows
        .first()
        .and_then(|(_, cells)| ClipboardColumns::columns_from_titles(cells));
    let (columns, rows) = match titled {
        Some(columns) => (columns, &rows[1..]),
        None => {
            let guessed_columns = rows
                .iter()
                .find_map(|(_, cells)| ClipboardColumns::guess_clipboard_columns(cells));
            (guessed_columns.unwrap_or_default(), &rows[..])
        }
    };
    let mut copied = Vec::new();
    for (line, cells) in rows {
        match columns.read_clipboard_row(*line, cells, &frame) {
            Ok(row) => copied.push(row),
            Err(why) => odd.push(why),
        }
    }
    ClipboardText::Rows(copied, odd)
}

/// The columns of a table, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct ClipboardColumns {
    tier: Option<usize>,
    start: Option<usize>,
    end: Option<usize>,
    length: Option<usize>,
    value: Option<usize>,
    /// Whether numbers without a unit are milliseconds.
    millis: bool,
}

impl ClipboardColumns {
    /// Reads a row of column titles, as this program, ELAN and people write them.
    fn columns_from_titles(cells: &[String]) -> Option<Self> {
        const CLIPBOARD_TITLE_NAMES: [&[&str]; 5] = [
            &["tier", "acteur"],
            &["start", "begin", "from", "debut"],
            &["end", "to", "fin"],
            &["duration", "length", "duree"],
            &["value", "annotation", "gloss", "text", "valeur", "glose", "texte"],
        ];
        let mut column_numbers: [Option<usize>; 5] = [None; 5];
        for (column, cell) in cells.iter().enumerate() {
            let name = fold_text(cell.trim());
            let fits = |names: &&[&str]| names.iter().any(|prefix| name.starts_with(prefix));
            if let Some(what) = CLIPBOARD_TITLE_NAMES.iter().position(fits) {
                column_numbers[what].get_or_insert(column);
            }
        }
        let [tier, start, end, length, value] = column_numbers;
        let title = start.and_then(|start| cells.get(start)).map(|cell| fold_text(cell));
        let millis = title.is_some_and(|text| text.contains("msec") || text.contains("(ms)"));
        (start.is_some() && (end.is_some() || length.is_some())).then_some(Self {
            tier,
            start,
            end,
            length,
            value,
            millis,
        })
    }

    /// Finds two times side by side: the tier is before them, and the value after them.
    fn guess_clipboard_columns(cells: &[String]) -> Option<Self> {
        let is_time = |cell: &String| read_clipboard_moment(cell, false).is_some();
        let start = (1..cells.len()).find(|at| is_time(&cells[at - 1]) && is_time(&cells[*at]))? - 1;
        Some(Self {
            tier: start.checked_sub(1),
            start: Some(start),
            end: Some(start + 1),
            value: Some(start + 2),
            ..Self::default()
        })
    }

    fn read_clipboard_row(
        &self,
        line: usize,
        cells: &[String],
        frame: &impl Fn(u64) -> Option<i64>,
    ) -> Result<CopiedAnnotation, OddLine> {
        let cell = |at: Option<usize>| {
            let text = at.and_then(|at| cells.get(at)).map(|cell| cell.trim());
            text.filter(|text| !text.is_empty())
        };
        let odd = |why: OddReason, text: &str| OddLine {
            line,
            why,
            text: text.to_owned(),
            at: None,
        };
        let time = |text: &str| {
            let micros = match read_clipboard_moment(text, self.millis) {
                Some(TableMoment::Time(at)) => Some(at.instant_micros()),
                Some(TableMoment::Frame(at)) => frame(at),
                None => None,
            };
            micros.ok_or_else(|| odd(OddReason::Time, text))
        };
        let (Some(start), Some(end)) = (cell(self.start), cell(self.end).or(cell(self.length))) else {
            return Err(odd(OddReason::Row, cells.join(" ").trim()));
        };
        let (from, mut to) = (time(start)?, time(end)?);
        if cell(self.end).is_none() {
            to = to.saturating_add(from);
        }
        if to <= from {
            return Err(odd(OddReason::Ends, end));
        }
        let value = self.value.and_then(|at| cells.get(at));
        Ok(CopiedAnnotation {
            line,
            tier: cell(self.tier).map(str::to_owned),
            start: from,
            end: to,
            value: value.cloned().unwrap_or_default(),
        })
    }
}

/// Reads a time; the decimals may follow a comma, as in French spreadsheets.
fn read_clipboard_moment(text: &str, millis: bool) -> Option<TableMoment> {
    let text = text.trim().replace(',', ".");
    if millis && text.bytes().all(|byte| byte.is_ascii_digit()) {
        return format!("{text}ms").parse().ok();
    }
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> (Vec<CopiedAnnotation>, Vec<(usize, OddReason)>) {
        match read_clipboard_text(text, |frame| (frame < 100).then_some(frame as i64 * 10_000)) {
            ClipboardText::Rows(rows, odd) => (rows, odd.into_iter().map(|it| (it.line, it.why)).collect()),
            ClipboardText::Values(values) => panic!("{values:?}"),
        }
    }

    fn said(line: usize, tier: Option<&str>, (start, end): (i64, i64), value: &str) -> CopiedAnnotation {
        CopiedAnnotation {
            line,
            tier: tier.map(str::to_owned),
            start,
            end,
            value: value.into(),
        }
    }

    #[test]
    fn copied_annotations_read_back_unchanged() {
        let all = [
            ("Gloss", 1_250_000, 1_500_001, "MAISON"),
            ("Free", 2_000_000, 3_000_000, "two\nlines\tand \"more\""),
            ("Free", 4_000_000, 5_000_000, "\"quoted\""),
            ("Free", 6_000_000, 7_000_000, ""),
        ];
        let text = write_clipboard_text(all.iter().map(|it| (it.0, it.1, it.2, it.3.to_owned())));
        assert!(text.starts_with("\"tier\"\t\"start\"\t"), "{text}");
        let plain = write_clipboard_text(all[..1].iter().map(|it| (it.0, it.1, it.2, it.3.to_owned())));
        assert_eq!(plain, "tier\tstart\tend\tvalue\nGloss\t1.250\t1.500001\tMAISON\n");
        let (found, odd) = rows(&text);
        let want = all.iter().zip([2, 3, 5, 6]);
        let want: Vec<CopiedAnnotation> = want
            .map(|(it, line)| said(line, Some(it.0), (it.1, it.2), it.3))
            .collect();
        assert_eq!((found, odd), (want, vec![]));
    }

    #[test]
    fn foreign_tables_are_read_with_and_without_column_names() {
        let one = |tier: Option<&str>, line| said(line, tier, (1_500_000, 2_000_000), "A");
        for (text, want) in [
            ("1.5\t2\tA", one(None, 1)),
            ("Gloss\t1,5\t0:02\tA\n", one(Some("Gloss"), 1)),
            ("tier\tstart\tend\tvalue\nGloss\t1.5\t2\tA\n", one(Some("Gloss"), 2)),
            ("Value\tEnd\tBegin\r\nA\t2s\t1500ms\r\n", one(None, 2)),
            ("Début\tDurée\tActeur\tGlose\n1.5\t0.5\tG\tA", one(Some("G"), 2)),
            (
                "Tier\tBegin Time - msec\tEnd Time - msec\tAnnotation\nG\t1500\t2000\tA",
                one(Some("G"), 2),
            ),
        ] {
            assert_eq!(rows(text), (vec![want], vec![]), "{text}");
        }
        let (frames, _) = rows("G\tf10\tf20\tB");
        assert_eq!(frames, [said(1, Some("G"), (100_000, 200_000), "B")]);
    }

    #[test]
    fn a_quotation_mark_that_does_not_close_swallows_no_lines() {
        let text =
            "tier\tstart\tend\tvalue\nNotes\t1.7\t1.8\t\"open\nNotes\t1.9\t2.0\t\"Aha!\"\nNotes\t2.1\t2.2\tend\"\n";
        let (found, odd) = rows(text);
        let values: Vec<&str> = found.iter().map(|it| &*it.value).collect();
        assert_eq!((values, odd), (vec!["\"open", "\"Aha!\"", "end\""], vec![]));
        let values = vec![(1, "\"open".to_owned()), (2, "B".to_owned())];
        assert_eq!(
            read_clipboard_text("\"open\nB", |_| None),
            ClipboardText::Values(values)
        );
    }

    #[test]
    fn lines_that_are_no_annotations_are_reported() {
        let text = "start\tend\tvalue\nsoon\t2\tA\n3\t2\tB\n\t\t\n\tx\ty\nf500\tf600\tC\n1\t2\tD";
        let (found, odd) = rows(text);
        assert_eq!(found, [said(7, None, (1_000_000, 2_000_000), "D")]);
        let want = [
            (2, OddReason::Time),
            (3, OddReason::Ends),
            (5, OddReason::Row),
            (6, OddReason::Time),
        ];
        assert_eq!(odd, want);
        assert_eq!(rows("a\tb\nc\td").1.len(), 2);
    }

    #[test]
    fn a_single_column_is_read_as_values() {
        for (text, want) in [
            ("MAISON", vec![(1, "MAISON")]),
            ("A\r\n\r\nB\n", vec![(1, "A"), (3, "B")]),
            ("", vec![]),
        ] {
            let want = want.into_iter().map(|(line, it)| (line, it.to_owned()));
            assert_eq!(
                read_clipboard_text(text, |_| None),
                ClipboardText::Values(want.collect())
            );
        }
    }
}
