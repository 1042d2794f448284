//! Infers the meaning of a table's columns: from the titles, or from the form of ELAN's tables without
//! titles.

use super::super::cells::{Cells, Row, TableError};
use super::NAMES;
use super::moment::{Moment, TimeUnit, is_bare};
use crate::finding::Finding;
use crate::roles::normal;
use crate::tally::Findings;
use chereme_sign::text::{did_you_mean, nearest};

/// Length in microseconds above which an annotation suggests that its times are not in seconds.
const LONG: i64 = 60_000_000;
/// End in microseconds beyond which an annotation suggests that its times are not in seconds.
const LATE: i64 = 3 * 3_600_000_000;
/// The most rows that are examined to recognise the columns.
const LOOKED_AT: usize = 200;

/// A column of times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Time {
    pub(super) column: usize,
    /// The unit of its bare numbers, if its title or form states it.
    pub(super) unit: Option<TimeUnit>,
}

/// The columns of a table by their meaning.
#[derive(Debug, Default)]
pub(super) struct Columns {
    /// The columns of [`NAMES`], except for the times.
    pub(super) at: [Option<usize>; 8],
    pub(super) start: Option<Time>,
    pub(super) end: Option<Time>,
    pub(super) duration: Option<Time>,
    pub(super) participant: Option<usize>,
    /// Columns that are tiers, each cell an annotation.
    pub(super) tiers: Vec<(usize, String)>,
}

/// The meaning of a title.
enum Title {
    Named(usize),
    Start(Option<TimeUnit>),
    End(Option<TimeUnit>),
    Duration(Option<TimeUnit>),
    /// ELAN's exports call the value so; other tables the id.
    Annotation,
    Participant,
    /// Known, but unused.
    Idle,
}

impl Columns {
    /// Recognises columns by their titles; findings name the unused ones.
    pub(super) fn of_titles(header: &[String], findings: &mut Findings) -> Self {
        let mut found = Self::default();
        let (mut unknown, mut annotation) = (Vec::new(), None);
        for (column, title) in header.iter().enumerate() {
            let time = |unit| Time { column, unit };
            let twice = match meaning(title) {
                Some(Title::Named(at)) => put(&mut found.at[at], column),
                Some(Title::Start(unit)) => put(&mut found.start, time(unit)) && unit.is_none(),
                Some(Title::End(unit)) => put(&mut found.end, time(unit)) && unit.is_none(),
                Some(Title::Duration(unit)) => {
                    put(&mut found.duration, time(unit)) && unit.is_none()
                }
                Some(Title::Annotation) => put(&mut annotation, column),
                Some(Title::Participant) => put(&mut found.participant, column),
                Some(Title::Idle) => false,
                None => {
                    unknown.push((column, title.clone()));
                    false
                }
            };
            if twice {
                findings.add("columns given twice", || {
                    Finding::warning(
                        1,
                        format!("the column {title:?} is there twice; the first counts"),
                    )
                });
            }
        }
        if let Some(column) = annotation {
            // If rows name an action, this column identifies the annotation to act on.
            let value = found.at[4].is_none() && found.at[5].is_none();
            put(&mut found.at[if value { 4 } else { 6 }], column);
        }
        let timed = found.start.is_some() && (found.end.is_some() || found.duration.is_some());
        let placed = found.at[1].is_some() || found.at[6].is_some();
        if timed && !placed {
            // Without a column of tiers, a title such as "Gloss" is the name of a tier.
            let is_value = |title: &str| matches!(title, "value" | "valeur" | "annotation");
            let is_tier = |column: &usize| !is_value(&normal(&header[*column]));
            if let Some(column) = found.at[4].take_if(|column| is_tier(column)) {
                unknown.push((column, header[column].clone()));
                unknown.sort();
            }
            if found.at[4].is_none() {
                found.tiers = unknown;
                return found;
            }
        }
        for (_, title) in unknown {
            findings.add("unknown columns", || {
                let names = NAMES.into_iter().chain(["duration"]);
                let meant = did_you_mean(nearest(&normal(&title), names));
                Finding::warning(1, format!("the column {title:?} is not used{meant}"))
            });
        }
        found
    }

    /// Returns whether the rows are the annotations of one recording, with their times, rather than changes of some.
    pub(super) fn holds_annotations(&self) -> bool {
        let timed = self.start.is_some() && (self.end.is_some() || self.duration.is_some());
        let [recording, tier, .., action, id, _] = self.at;
        let changes = recording.or(action).or(id).is_some();
        timed && !changes && (tier.is_some() || !self.tiers.is_empty())
    }

    /// Writes points for the decimal commas of times, in a table whose cells are not separated by commas.
    pub(super) fn mend_commas(&self, table: &mut Cells) {
        if table.delimiter == b',' {
            return;
        }
        let times = [self.start, self.end, self.duration];
        for column in times.into_iter().flatten().map(|time| time.column) {
            for row in &mut table.rows {
                if let Some(cell) = row.cells.get_mut(column)
                    && let Some((whole, part)) = cell.trim().split_once(',')
                    && is_bare(whole)
                    && is_bare(part)
                {
                    *cell = format!("{whole}.{part}");
                }
            }
        }
    }

    /// Recognises the columns of a table without titles, as ELAN exports it: the tier, perhaps the
    /// participant, begin, end and duration in one or several forms, the annotation. `None` for other
    /// tables.
    pub(super) fn of_export(table: &Cells) -> Option<Self> {
        let titles = table.header.iter().skip(1);
        if titles.filter(|cell| form(cell).is_some()).count() < 2 {
            return None;
        }
        let rows: Vec<&[String]> = std::iter::once(table.header.as_slice())
            .chain(table.rows.iter().map(|row| row.cells.as_slice()))
            .take(LOOKED_AT)
            .collect();
        let width = table.header.len();
        let forms: Vec<Option<Form>> = (0..width).map(|column| usual(&rows, column)).collect();
        // At most the participant stands between the tier and the times.
        let begin = (1..width.min(3)).find(|&column| forms[column].is_some())?;
        let run: Vec<Form> = forms[begin..].iter().map_while(|form| *form).collect();
        let times = repeated(&run, begin + run.len() == width)?;
        let value = begin + times.len();
        let alike = |wanted: Form| -> Vec<usize> {
            let own = (begin..).zip(times).filter(|(_, form)| **form == wanted);
            own.map(|(column, _)| column).collect()
        };
        let (form, columns) = [Form::Millis, Form::Seconds, Form::Clock]
            .map(|form| (form, alike(form)))
            .into_iter()
            .find(|(_, columns)| columns.len() >= 2)?;
        let time = |column: usize| Time {
            column,
            unit: form.unit(),
        };
        let ends = columns.len() > 2
            || rows.iter().all(|row| {
                let at = |column: usize| micros(row.get(column)?, form);
                let both = at(columns[0]).zip(at(columns[1]));
                both.is_none_or(|(start, end)| start <= end)
            });
        let second = Some(time(columns[1]));
        let mut found = Self {
            start: Some(time(columns[0])),
            end: second.filter(|_| ends),
            duration: second.filter(|_| !ends),
            ..Self::default()
        };
        found.at[1] = Some(0);
        found.participant = (begin == 2).then_some(1);
        found.at[4] = (value < width).then_some(value);
        Some(found)
    }

    /// Refuses bare whole numbers that would be implausibly long or late annotations, such as milliseconds read as
    /// seconds.
    pub(super) fn check_plausible(&self, rows: &[Row]) -> Result<(), TableError> {
        let (Some(start), Some(end)) = (self.start, self.end) else {
            return Ok(());
        };
        if start.unit.is_some() || end.unit.is_some() {
            return Ok(());
        }
        let mut odd = None;
        for row in rows {
            let cells = row.cells.get(start.column).zip(row.cells.get(end.column));
            let Some((from, to)) = cells.map(|(from, to)| (from.trim(), to.trim())) else {
                continue;
            };
            if from.is_empty() || to.is_empty() {
                continue;
            }
            if !is_bare(from) || !is_bare(to) || from.contains('.') || to.contains('.') {
                return Ok(());
            }
            let at = |text: &str| micros(text, Form::Seconds).unwrap_or_default();
            if odd.is_none() && (at(to) - at(from) > LONG || at(to) > LATE) {
                odd = Some(TableError::Implausible {
                    line: row.line,
                    start: from.to_owned(),
                    end: to.to_owned(),
                });
            }
        }
        odd.map_or(Ok(()), Err)
    }
}

/// Sets a column that is not set yet; returns whether it was set.
fn put<T>(place: &mut Option<T>, column: T) -> bool {
    if place.is_some() {
        return true;
    }
    *place = Some(column);
    false
}

fn meaning(title: &str) -> Option<Title> {
    let whole = normal(title);
    let known = |name: &str| NAMES.iter().position(|known| *known == name);
    match &*whole {
        "annotation" => return Some(Title::Annotation),
        "annotation id" => return Some(Title::Named(6)),
        "gloss" | "glose" | "text" | "texte" | "label" | "annotation value" | "valeur" | "wert" => {
            return Some(Title::Named(4));
        }
        "tier name" | "acteur" | "nom de l acteur" | "piste" | "spur" => {
            return Some(Title::Named(1));
        }
        "enregistrement" => return Some(Title::Named(0)),
        "identifiant" => return Some(Title::Named(6)),
        "participant" => return Some(Title::Participant),
        "annotator" => return Some(Title::Idle),
        _ => {}
    }
    let (name, unit) = unit(&whole);
    match name {
        "start" | "begin" | "start time" | "begin time" | "onset" | "debut" | "anfang"
        | "beginn" => Some(Title::Start(unit)),
        "end" | "stop" | "end time" | "stop time" | "fin" | "ende" => Some(Title::End(unit)),
        "duration" | "length" | "duree" | "dauer" => Some(Title::Duration(unit)),
        _ => known(&whole).map(Title::Named),
    }
}

/// Splits a title into the text before its unit, and the unit.
fn unit(title: &str) -> (&str, Option<TimeUnit>) {
    for (end, unit) in [
        (" hh mm ss ms", None),
        (" hh mm ss msec", None),
        (" ss msec", Some(TimeUnit::Seconds)),
        (" ss ms", Some(TimeUnit::Seconds)),
    ] {
        if let Some(name) = title.strip_suffix(end) {
            // Clock times are never bare numbers; setting the unit marks the form as known.
            return (name, unit.or(Some(TimeUnit::Seconds)));
        }
    }
    let (name, last) = title.rsplit_once(' ').unwrap_or((title, ""));
    let last = last.strip_prefix("in ").unwrap_or(last);
    match TimeUnit::of_word(last) {
        Some(unit) => (name.strip_suffix(" in").unwrap_or(name), Some(unit)),
        None => (title, None),
    }
}

/// ELAN's formats of times.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Clock,
    Seconds,
    Millis,
}

impl Form {
    fn unit(self) -> Option<TimeUnit> {
        match self {
            Self::Clock => None,
            Self::Seconds => Some(TimeUnit::Seconds),
            Self::Millis => Some(TimeUnit::Milliseconds),
        }
    }
}

/// Returns the form of the times in a column: that of at least half of its cells, while the others have none. A damaged
/// time must not change the meaning of the rest.
fn usual(rows: &[&[String]], column: usize) -> Option<Form> {
    let found = rows.iter().filter_map(|row| form(row.get(column)?));
    let found: Vec<Form> = found.collect();
    let first = *found.first()?;
    let alike = found.iter().all(|form| *form == first);
    (alike && 2 * found.len() >= rows.len()).then_some(first)
}

/// Returns the beginning of a run of forms that holds begin, end and perhaps duration, each in the same forms. With
/// `to_end` no column follows the run: its last one holds the values, and all of these are numbers.
fn repeated(run: &[Form], to_end: bool) -> Option<&[Form]> {
    let run = &run[..run.len().saturating_sub(usize::from(to_end))];
    let fits = |&(each, times): &(usize, usize)| {
        let all = each * times;
        all <= run.len()
            && (each..all).all(|at| run[at] == run[at - each])
            && (1..each).all(|at| !run[..at].contains(&run[at]))
    };
    let most = [(3, 3), (2, 3), (3, 2), (2, 2), (1, 3), (1, 2)];
    let (each, times) = most.into_iter().find(fits)?;
    Some(&run[..each * times])
}

fn form(cell: &str) -> Option<Form> {
    let cell = cell.trim();
    let cell = cell.strip_prefix('-').unwrap_or(cell);
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if digits(cell) {
        return Some(Form::Millis);
    }
    if let Some((whole, part)) = cell.split_once('.')
        && digits(whole)
        && digits(part)
    {
        return Some(Form::Seconds);
    }
    let clock = cell.split(':').count() == 3;
    let plain = cell
        .bytes()
        .all(|b| b.is_ascii_digit() || matches!(b, b':' | b'.'));
    (clock && plain && cell.parse::<Moment>().is_ok()).then_some(Form::Clock)
}

fn micros(cell: &str, form: Form) -> Option<i64> {
    let unit = form.unit().unwrap_or(TimeUnit::Seconds);
    match Moment::read(cell, unit).ok()? {
        Moment::Time(time) => Some(time.micros()),
        Moment::Frame(_) => None,
    }
}
