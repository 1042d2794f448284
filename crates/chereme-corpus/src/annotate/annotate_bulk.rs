//! Changes of annotations from a table.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::ImportFinding;
use chereme_formats::roles::{self, TierMapping, TierRoleEvidence};
use chereme_formats::table::TableError;
use chereme_formats::table::annotations::{self, ChangeAction, ChangeRow, ChangeRowFault};
use chereme_motion::RecordingInstant;
use chereme_sign::TierTopic;
use rusqlite::Connection;

use super::annotate_names::SAME_TIME_MICROS;
use super::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationChangeRun, AnnotationName, NewTier,
    TierRequestName, TierRoundRow, TierValueSource, annotate_names, annotate_tiers, carry_out_changes, tier_rounds,
};
use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::stored_recordings;
use crate::db::stored_tiers::AnnotationRow;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;
use crate::words::effect::OperationEffect;

/// A table of changes of annotations as it lies in a file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChangeTableFile<'a> {
    pub(crate) bytes: &'a [u8],
    /// Its name in errors.
    pub(crate) name: &'a str,
    /// The recording of rows that name none; without it the only one of the corpus.
    pub(crate) recording: Option<&'a RowName>,
}

/// The changes that a table asks for.
pub(crate) struct TableChanges {
    pub(crate) changes: Vec<AnnotationChange>,
    pub(crate) faults: Vec<CorpusError>,
    pub(crate) findings: Vec<ImportFinding>,
}

impl Corpus {
    /// Applies the changes in a table (CSV or TSV) of annotations, as one operation.
    ///
    /// `name` is the name of the table in errors. Rows without a recording apply to `recording`, or to the only one of
    /// the corpus. With [`AnnotateOptions::add_tiers`] recordings get the tiers that they lack, too. An annotation named by its id must be in the recording and on the tier that its row names. The format
    /// is that of [`chereme_formats::table::annotations::read_change_table`].
    ///
    /// # Errors
    /// [`CorpusError::Several`] with every row that cannot be carried out; nothing is changed then.
    pub fn annotate_table(
        &mut self,
        bytes: &[u8],
        name: &str,
        recording: Option<&RowName>,
        options: &AnnotateOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<(AnnotateReport, Vec<ReportFinding>)> {
        let table = ChangeTableFile { bytes, name, recording };
        let read = read_table_changes(self.store.read_connection(), table, options)?;
        let findings = read.findings.iter().cloned().map(ReportFinding::from).collect();
        let work = |connection: &Connection, progress: &mut ProgressReceiver<'_>| {
            let report = write_table_changes(connection, read, name, options, progress)?;
            let effect = OperationEffect::Annotate(report.effect.clone());
            Ok((report, effect))
        };
        Ok((self.store.operation_with_progress(progress, work)?, findings))
    }
}

/// Reads the changes that a table asks for; rows that name the file of a recording mean that recording.
pub(crate) fn read_table_changes(
    connection: &Connection,
    table: ChangeTableFile<'_>,
    options: &AnnotateOptions,
) -> CorpusResult<TableChanges> {
    let name = table.name;
    let (rows, findings) = annotations::read_change_table(table.bytes, options.unit).map_err(|error| {
        let wrong = CorpusError::from_wrong_message(error.to_string()).with_error_place(name);
        match error {
            TableError::Implausible { .. } => wrong.with_command_advice(
                "or name the unit with the table: `chereme annotate CORPUS from FILE --unit ms`, s or frames",
            ),
            _ => wrong,
        }
    })?;
    let all_recordings = stored_recordings::load_recording_rows(connection)?;
    let only = match all_recordings.as_slice() {
        [one] => Some(RowName::Number(one.id)),
        _ => None,
    };
    let recording = table.recording.cloned().or(only);
    let mut faults: Vec<CorpusError> = rows
        .faults
        .iter()
        .map(|problem| change_file_error(name, problem))
        .collect();
    let mut named = BTreeMap::new();
    let mut changes = Vec::with_capacity(rows.rows.len());
    for row in &rows.rows {
        let place = format!("{name}, line {}", row.line);
        let own = row.recording.as_deref().map(|text| {
            let known = named.entry(text);
            &*known.or_insert_with(|| recording_of_cell(connection, text))
        });
        match change_from_row(row, own, recording.as_ref(), &place) {
            Ok(change) => changes.push(change),
            Err(error) => faults.push(error.with_error_place(place)),
        }
    }
    if changes.is_empty() && faults.is_empty() {
        return Err(CorpusError::from_wrong_message("the table asks for nothing")
            .with_error_place(name)
            .with_advice("write a row for each change below the row of column names"));
    }
    Ok(TableChanges {
        changes,
        faults,
        findings,
    })
}

/// Carries out the changes of a table inside the caller's operation: all of them, or none.
pub(crate) fn write_table_changes(
    connection: &Connection,
    read: TableChanges,
    name: &str,
    options: &AnnotateOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<AnnotateReport> {
    let TableChanges {
        changes,
        faults,
        findings,
    } = read;
    let (new, added_tiers) = match options.add_tiers {
        true => plan_lacking_tiers(connection, &changes)?,
        false => Default::default(),
    };
    for tier in &new {
        annotate_tiers::insert_new_tier(connection, tier)?;
    }
    match carry_out_changes(connection, &changes, options, faults, progress) {
        Err(error @ (CorpusError::Wrong { .. } | CorpusError::Follows(_))) => {
            Err(CorpusError::from_error_list(vec![error]))
        }
        Err(CorpusError::Several { mut errors, .. }) => {
            // A column that was not recognised may be the one that the rows lack.
            let unused = findings.iter().filter(|finding| finding.line == Some(1));
            errors.extend(unused.map(|finding| {
                CorpusError::from_wrong_message(finding.message.clone())
                    .with_error_place(format!("{name}, line 1"))
                    .with_advice("the columns are recording, tier, start, end, duration, value, action, id, parent")
            }));
            errors.sort_by_key(error_line_number);
            Err(CorpusError::from_error_list(errors))
        }
        report => Ok(AnnotateReport { added_tiers, ..report? }),
    }
}

/// The annotation that a row of a table adds, beside the one that has its tier and start in the corpus.
pub(crate) struct TableAnnotation {
    pub(crate) tier: String,
    pub(crate) start_us: i64,
    pub(crate) end_us: i64,
    pub(crate) value: String,
    pub(crate) stored: Option<AnnotationRow>,
    /// Whether that one says the same.
    pub(crate) is_stored: bool,
}

/// Finds what the corpus has of an annotation that a table adds; nothing without a start, or if its tier does not exist.
pub(crate) fn find_table_annotation(
    connection: &Connection,
    action: &AnnotationAction,
) -> CorpusResult<Option<TableAnnotation>> {
    let AnnotationAction::Add {
        tier,
        start: Some(start),
        end: Some(end),
        value,
        ..
    } = action
    else {
        return Ok(None);
    };
    let Ok(row) = annotate_names::find_named_tier(connection, tier) else {
        return Ok(None);
    };
    let options = AnnotateOptions::default();
    let mut run = AnnotationChangeRun::new(connection, &options)?;
    // What is wrong with the row is said when it is carried out, with its line.
    let (Ok(reading), Ok(span)) = (
        run.reading_on_tier(&row, value),
        run.span_from_moments(row.id, *start, *end),
    ) else {
        return Ok(None);
    };
    let name = AnnotationName::At {
        tier: tier.clone(),
        start: *start,
    };
    let stored = run.find_requested_annotation(&name).ok();
    let [start_us, end_us] = [span.span_start_instant(), span.span_end_instant()].map(RecordingInstant::instant_micros);
    let is_same = |stored: &AnnotationRow| {
        stored.end_us.abs_diff(end_us) <= SAME_TIME_MICROS && stored.annotation_reading() == reading
    };
    Ok(Some(TableAnnotation {
        tier: row.name,
        start_us,
        end_us,
        value: value.clone(),
        is_stored: stored.as_ref().is_some_and(is_same),
        stored,
    }))
}

/// Returns the tiers to which changes add annotations and which their recordings lack, and their names by recording.
///
/// The name of a tier says what its annotations are about. A recording that does not exist is left to its change.
fn plan_lacking_tiers(
    connection: &Connection,
    changes: &[AnnotationChange],
) -> CorpusResult<(Vec<NewTier>, Vec<TierRoundRow>)> {
    let mut lacking: BTreeMap<i64, TierRoundRow> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for change in changes {
        let AnnotationAction::Add { tier: name, .. } = &change.action else {
            continue;
        };
        let TierRequestName::Of { recording, tier } = name else {
            continue;
        };
        if tier.is_empty() || !seen.insert(name.to_string()) {
            continue;
        }
        let Ok(home) = address::find_recording_by_name(connection, recording) else {
            continue;
        };
        if annotate_names::find_named_tier(connection, name).is_err() {
            let row = lacking
                .entry(home.id)
                .or_insert_with(|| tier_rounds::empty_round_row(&home));
            // Another row may name the recording by its number.
            if !row.tiers.contains(tier) {
                row.tiers.push(tier.clone());
            }
        }
    }
    let names: BTreeSet<&str> = lacking
        .values()
        .flat_map(|row| &row.tiers)
        .map(String::as_str)
        .collect();
    let evidence: Vec<TierRoleEvidence<'_>> = names
        .into_iter()
        .map(|name| TierRoleEvidence {
            name,
            ..TierRoleEvidence::default()
        })
        .collect();
    let topics: BTreeMap<String, TierTopic> = roles::guess_roles(&evidence, &TierMapping::default())
        .into_iter()
        .filter_map(|guess| Some((guess.tier.clone(), guess.guessed_tier_topic()?)))
        .collect();
    let mut new = Vec::new();
    for row in lacking.values() {
        for name in &row.tiers {
            let topic = topics.get(name).cloned().unwrap_or_default();
            let recording = RowName::Number(row.recording);
            new.push(NewTier {
                hand: topic.hand,
                // The values of the table are taken as they are.
                values: TierValueSource::Free,
                ..NewTier::new(recording, name.clone(), topic.role)
            });
        }
    }
    Ok((new, lacking.into_values().collect()))
}

fn error_line_number(error: &CorpusError) -> Option<u64> {
    error.error_place()?.rsplit_once(' ')?.1.parse().ok()
}

fn change_file_error(name: &str, fault: &ChangeRowFault) -> CorpusError {
    CorpusError::from_wrong_message(format!("{}: {}", fault.column, fault.message))
        .with_error_place(format!("{name}, line {}", fault.line))
}

fn change_from_row(
    row: &ChangeRow,
    row_recording: Option<&RowName>,
    recording: Option<&RowName>,
    place: &str,
) -> CorpusResult<AnnotationChange> {
    let recording = row_recording.or(recording);
    let tier = |text: &str| TierRequestName::parse_tier_name(text, recording);
    let named = || match (&row.id, &row.tier, row.start) {
        (Some(id), tier, _) => {
            let annotation = AnnotationName::Placed {
                annotation: Box::new(AnnotationName::parse_annotation_name(id, recording)),
                recording: row_recording.cloned(),
                tier: tier.clone(),
            };
            Ok((annotation, row.start))
        }
        (None, Some(text), Some(start)) => {
            let tier = tier(text)?;
            Ok((AnnotationName::At { tier, start }, None))
        }
        _ => Err(CorpusError::from_wrong_message(
            "name the annotation by its id, or by its tier and start",
        )),
    };
    let action = match row.action {
        ChangeAction::Add => AnnotationAction::Add {
            tier: tier(row.tier.as_deref().unwrap_or_default())?,
            start: row.start,
            end: row.end,
            parent: row
                .parent
                .as_deref()
                .map(|id| AnnotationName::parse_annotation_name(id, recording)),
            order: None,
            value: row.value.clone().unwrap_or_default(),
            confidence: None,
        },
        ChangeAction::Remove => AnnotationAction::Remove { annotation: named()?.0 },
        ChangeAction::Set => {
            let (annotation, start) = named()?;
            AnnotationAction::Set {
                annotation,
                start,
                end: row.end,
                value: row.value.clone(),
            }
        }
    };
    let label = row.id.clone().filter(|_| row.action == ChangeAction::Add);
    Ok(AnnotationChange {
        place: Some(place.to_owned()),
        label,
        action,
    })
}

/// Returns the recording that a cell names: by its address or its name, or by the name of a file, which ELAN writes.
fn recording_of_cell(connection: &Connection, text: &str) -> RowName {
    let name = match text.parse() {
        Ok(CorpusAddress::Recording(name)) => name,
        _ => RowName::Text(text.to_owned()),
    };
    let file_name = text.rsplit(['/', '\\']).next().unwrap_or(text);
    let stem = file_name.rsplit_once('.').map_or(file_name, |(stem, _)| stem);
    match address::find_recording_by_name(connection, &name) {
        Err(_) if stem != text => match stored_recordings::recording_named(connection, stem) {
            Ok(Some(row)) => RowName::Number(row.id),
            _ => name,
        },
        _ => name,
    }
}
