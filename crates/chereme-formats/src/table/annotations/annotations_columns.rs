//! Infers the meaning of a table's columns: from the titles, or from the form of ELAN's tables without
//! titles.

use super::super::table_cells::{TableCells, TableError, TableRow};
use super::ANNOTATION_COLUMN_NAMES;
use super::moment::{TableMoment, TableTimeUnit, is_bare};
use crate::finding::ImportFinding;
use crate::roles::normalize_tier_name;
use crate::tally::FindingTally;
use chereme_sign::text::{did_you_mean, nearest_candidate};

/// Length in microseconds above which an annotation suggests that its times are not in seconds.
const LONG_ANNOTATION_MICROS: i64 = 60_000_000;
/// End in microseconds beyond which an annotation suggests that its times are not in seconds.
const LATE_END_MICROS: i64 = 3 * 3_600_000_000;
/// The most rows that are examined to recognise the columns.
const COLUMN_SAMPLE_ROWS: usize = 200;

/// A column of times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TimeColumn {
    pub(super) column: usize,
    /// The unit of its bare numbers, if its title or form states it.
    pub(super) unit: Option<TableTimeUnit>,
}

/// The columns of a table by their meaning.
#[derive(Debug, Default)]
pub(super) struct ChangeTableColumns {
    /// The columns of [`ANNOTATION_COLUMN_NAMES`], except for the times.
    pub(super) at: [Option<usize>; 8],
    pub(super) start: Option<TimeColumn>,
    pub(super) end: Option<TimeColumn>,
    pub(super) duration: Option<TimeColumn>,
    pub(super) participant: Option<usize>,
    /// Columns that are tiers, each cell an annotation.
    pub(super) tiers: Vec<(usize, String)>,
}

/// The meaning of a title.
enum AnnotationTitle {
    Named(usize),
    Start(Option<TableTimeUnit>),
    End(Option<TableTimeUnit>),
    Duration(Option<TableTimeUnit>),
    /// ELAN's exports call the value so; other tables the id.
    Annotation,
    Participant,
    /// Known, but unused.
    Idle,
}

impl ChangeTableColumns {
    /// Recognises columns by their titles; findings name the unused ones.
    pub(super) fn of_titles(header: &[String], findings: &mut FindingTally) -> Self {
        let mut found_columns = Self::default();
        let (mut unknown, mut annotation) = (Vec::new(), None);
        for (column, title) in header.iter().enumerate() {
            let time = |unit| TimeColumn { column, unit };
            let twice = match parse_annotation_title(title) {
                Some(AnnotationTitle::Named(at)) => set_column_once(&mut found_columns.at[at], column),
                Some(AnnotationTitle::Start(unit)) => {
                    set_column_once(&mut found_columns.start, time(unit)) && unit.is_none()
                }
                Some(AnnotationTitle::End(unit)) => {
                    set_column_once(&mut found_columns.end, time(unit)) && unit.is_none()
                }
                Some(AnnotationTitle::Duration(unit)) => {
                    set_column_once(&mut found_columns.duration, time(unit)) && unit.is_none()
                }
                Some(AnnotationTitle::Annotation) => set_column_once(&mut annotation, column),
                Some(AnnotationTitle::Participant) => set_column_once(&mut found_columns.participant, column),
                Some(AnnotationTitle::Idle) => false,
                None => {
                    unknown.push((column, title.clone()));
                    false
                }
            };
            if twice {
                findings.add_limited_warning("columns given twice", 1, || {
                    format!("the column {title:?} is there twice; the first counts")
                });
            }
        }
        if let Some(column) = annotation {
            // If rows name an action, this column identifies the annotation to act on.
            let value = found_columns.at[4].is_none() && found_columns.at[5].is_none();
            set_column_once(&mut found_columns.at[if value { 4 } else { 6 }], column);
        }
        let timed = found_columns.start.is_some() && (found_columns.end.is_some() || found_columns.duration.is_some());
        let placed = found_columns.at[1].is_some() || found_columns.at[6].is_some();
        if timed && !placed {
            // Without a column of tiers, a title such as "Gloss" is the name of a tier.
            let is_value = |title: &str| matches!(title, "value" | "valeur" | "annotation");
            let is_tier = |column: &usize| !is_value(&normalize_tier_name(&header[*column]));
            if let Some(column) = found_columns.at[4].take_if(|column| is_tier(column)) {
                unknown.push((column, header[column].clone()));
                unknown.sort();
            }
            if found_columns.at[4].is_none() {
                found_columns.tiers = unknown;
                return found_columns;
            }
        }
        for (_, title) in unknown {
            findings.add_limited_finding("unknown columns", || {
                let names = ANNOTATION_COLUMN_NAMES.into_iter().chain(["duration"]);
                let suggestion = did_you_mean(nearest_candidate(&normalize_tier_name(&title), names));
                ImportFinding::new_warning_finding(1, format!("the column {title:?} is not used{suggestion}"))
            });
        }
        found_columns
    }

    /// Returns whether the rows are the annotations of one recording, with their times, rather than changes of some.
    pub(super) fn holds_annotations(&self) -> bool {
        let timed = self.start.is_some() && (self.end.is_some() || self.duration.is_some());
        let [recording, tier, .., action, id, _] = self.at;
        let changes = recording.or(action).or(id).is_some();
        timed && !changes && (tier.is_some() || !self.tiers.is_empty())
    }

    /// Returns whether the rows are changes of recordings that exist: they name a tier and a time or an action, and a
    /// recording, an action or an annotation.
    pub(super) fn holds_changes(&self) -> bool {
        let [recording, tier, _, _, value, action, id, parent] = self.at;
        let says = value.or(action).is_some();
        let placed = self.start.is_some() || action.or(parent).is_some();
        tier.is_some() && says && placed && recording.or(action).or(id).is_some()
    }

    /// Writes points for the decimal commas of times, in a table whose cells are not separated by commas.
    pub(super) fn mend_commas(&self, table: &mut TableCells) {
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
    pub(super) fn of_export(table: &TableCells) -> Option<Self> {
        let titles = table.header.iter().skip(1);
        if titles.filter(|cell| detect_time_form(cell).is_some()).count() < 2 {
            return None;
        }
        let rows: Vec<&[String]> = std::iter::once(table.header.as_slice())
            .chain(table.rows.iter().map(|row| row.cells.as_slice()))
            .take(COLUMN_SAMPLE_ROWS)
            .collect();
        let width = table.header.len();
        let forms: Vec<Option<ElanTimeForm>> = (0..width).map(|column| usual_time_form(&rows, column)).collect();
        // At most the participant stands between the tier and the times.
        let begin = (1..width.min(3)).find(|&column| forms[column].is_some())?;
        let run: Vec<ElanTimeForm> = forms[begin..].iter().map_while(|form| *form).collect();
        let times = repeated_time_forms(&run, begin + run.len() == width)?;
        let value = begin + times.len();
        let alike = |wanted: ElanTimeForm| -> Vec<usize> {
            let time_columns = (begin..).zip(times).filter(|(_, form)| **form == wanted);
            time_columns.map(|(column, _)| column).collect()
        };
        let (form, columns) = [ElanTimeForm::Millis, ElanTimeForm::Seconds, ElanTimeForm::Clock]
            .map(|form| (form, alike(form)))
            .into_iter()
            .find(|(_, columns)| columns.len() >= 2)?;
        let time = |column: usize| TimeColumn {
            column,
            unit: form.time_form_unit(),
        };
        let ends = columns.len() > 2
            || rows.iter().all(|row| {
                let cell_micros = |column: usize| parse_elan_micros(row.get(column)?, form);
                let both = cell_micros(columns[0]).zip(cell_micros(columns[1]));
                both.is_none_or(|(start, end)| start <= end)
            });
        let second = Some(time(columns[1]));
        let mut export_columns = Self {
            start: Some(time(columns[0])),
            end: second.filter(|_| ends),
            duration: second.filter(|_| !ends),
            ..Self::default()
        };
        export_columns.at[1] = Some(0);
        export_columns.participant = (begin == 2).then_some(1);
        export_columns.at[4] = (value < width).then_some(value);
        Some(export_columns)
    }

    /// Refuses bare whole numbers that would be implausibly long or late annotations, such as milliseconds read as
    /// seconds.
    pub(super) fn check_plausible(&self, rows: &[TableRow]) -> Result<(), TableError> {
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
            // One time with a point or a unit proves that the others are seconds.
            if !is_bare(from) || !is_bare(to) || from.contains('.') || to.contains('.') {
                return Ok(());
            }
            let text_micros = |text: &str| parse_elan_micros(text, ElanTimeForm::Seconds).unwrap_or_default();
            if odd.is_none()
                && (text_micros(to) - text_micros(from) > LONG_ANNOTATION_MICROS || text_micros(to) > LATE_END_MICROS)
            {
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
fn set_column_once<T>(place: &mut Option<T>, column: T) -> bool {
    if place.is_some() {
        return true;
    }
    *place = Some(column);
    false
}

fn parse_annotation_title(title: &str) -> Option<AnnotationTitle> {
    let normal_title = normalize_tier_name(title);
    let name_position = |name: &str| ANNOTATION_COLUMN_NAMES.iter().position(|known| *known == name);
    match &*normal_title {
        "annotation" => return Some(AnnotationTitle::Annotation),
        "annotation id" => return Some(AnnotationTitle::Named(6)),
        "gloss" | "glose" | "text" | "texte" | "label" | "annotation value" | "valeur" | "wert" => {
            return Some(AnnotationTitle::Named(4));
        }
        "tier name" | "acteur" | "nom de l acteur" | "piste" | "spur" => {
            return Some(AnnotationTitle::Named(1));
        }
        "recording name" | "enregistrement" | "file" | "file name" | "file path" | "fichier" => {
            return Some(AnnotationTitle::Named(0));
        }
        "identifiant" => return Some(AnnotationTitle::Named(6)),
        "participant" => return Some(AnnotationTitle::Participant),
        "annotator" => return Some(AnnotationTitle::Idle),
        _ => {}
    }
    let (name, unit) = split_title_unit(&normal_title);
    match name {
        "start" | "begin" | "start time" | "begin time" | "onset" | "debut" | "anfang" | "beginn" => {
            Some(AnnotationTitle::Start(unit))
        }
        "end" | "stop" | "end time" | "stop time" | "fin" | "ende" => Some(AnnotationTitle::End(unit)),
        "duration" | "length" | "duree" | "dauer" => Some(AnnotationTitle::Duration(unit)),
        _ => name_position(&normal_title).map(AnnotationTitle::Named),
    }
}

/// Splits a title into the text before its unit, and the unit.
fn split_title_unit(title: &str) -> (&str, Option<TableTimeUnit>) {
    for (end, unit) in [
        (" hh mm ss ms", None),
        (" hh mm ss msec", None),
        (" ss msec", Some(TableTimeUnit::Seconds)),
        (" ss ms", Some(TableTimeUnit::Seconds)),
    ] {
        if let Some(name) = title.strip_suffix(end) {
            // Clock times are never bare numbers; setting the unit marks the form as known.
            return (name, unit.or(Some(TableTimeUnit::Seconds)));
        }
    }
    let (name, last) = title.rsplit_once(' ').unwrap_or((title, ""));
    let last = last.strip_prefix("in ").unwrap_or(last);
    match TableTimeUnit::of_word(last) {
        Some(unit) => (name.strip_suffix(" in").unwrap_or(name), Some(unit)),
        None => (title, None),
    }
}

/// ELAN's formats of times.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ElanTimeForm {
    Clock,
    Seconds,
    Millis,
}

impl ElanTimeForm {
    fn time_form_unit(self) -> Option<TableTimeUnit> {
        match self {
            Self::Clock => None,
            Self::Seconds => Some(TableTimeUnit::Seconds),
            Self::Millis => Some(TableTimeUnit::Milliseconds),
        }
    }
}

/// Returns the form of the times in a column: that of at least half of its cells, while the others have none. A damaged
/// time must not change the meaning of the rest.
fn usual_time_form(rows: &[&[String]], column: usize) -> Option<ElanTimeForm> {
    let row_forms = rows.iter().filter_map(|row| detect_time_form(row.get(column)?));
    let forms: Vec<ElanTimeForm> = row_forms.collect();
    let first = *forms.first()?;
    let alike = forms.iter().all(|form| *form == first);
    (alike && 2 * forms.len() >= rows.len()).then_some(first)
}

/// Returns the beginning of a run of forms that holds begin, end and perhaps duration, each in the same forms. With
/// `to_end` no column follows the run: its last one holds the values, and all of these are numbers.
fn repeated_time_forms(run: &[ElanTimeForm], to_end: bool) -> Option<&[ElanTimeForm]> {
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

fn detect_time_form(cell: &str) -> Option<ElanTimeForm> {
    let trimmed = cell.trim();
    let cell = trimmed.strip_prefix('-').unwrap_or(trimmed);
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if digits(cell) {
        return Some(ElanTimeForm::Millis);
    }
    if let Some((whole, part)) = cell.split_once('.')
        && digits(whole)
        && digits(part)
    {
        return Some(ElanTimeForm::Seconds);
    }
    let clock = cell.split(':').count() == 3;
    let plain = cell.bytes().all(|b| b.is_ascii_digit() || matches!(b, b':' | b'.'));
    (clock && plain && cell.parse::<TableMoment>().is_ok()).then_some(ElanTimeForm::Clock)
}

fn parse_elan_micros(cell: &str, form: ElanTimeForm) -> Option<i64> {
    let unit = form.time_form_unit().unwrap_or(TableTimeUnit::Seconds);
    match TableMoment::parse_table_moment(cell, unit).ok()? {
        TableMoment::Time(time) => Some(time.instant_micros()),
        TableMoment::Frame(_) => None,
    }
}
