//! Imports tables of annotations of recordings that the corpus has, which `annotate from` reads, too.
//!
//! The bytes of a table are not kept: its annotations belong to several recordings, each with a consent of its own.

use std::collections::BTreeSet;
use std::path::Path;

use chereme_formats::table::annotations;
use rusqlite::Connection;

use super::import_captured::read_file_head;
use super::{AnnotationSide, EditOutcome, FileReport, FileStatus, ImportJob, OwnEdit, OwnEdits};
use crate::annotate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, ChangeTableFile, TableAnnotation,
    TableChanges, find_table_annotation, read_table_changes, write_table_changes,
};
use crate::error::CorpusResult;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;

/// The kind of such a table in `source_file.kind`.
pub(super) const CHANGE_TABLE_KIND: &str = "table of changes";

/// Returns whether a file is a table of annotations that names their recordings, or changes annotations.
pub(super) fn is_change_table(path: &Path) -> bool {
    read_file_head(path).is_ok_and(|head| annotations::is_change_table(&head))
}

/// Carries out the changes of a table, with the tiers that it needs.
pub(super) fn import_change_table(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    let unchanged_report = job.report_unchanged_file();
    let connection = job.connection;
    let options = AnnotateOptions {
        add_tiers: true,
        ..AnnotateOptions::default()
    };
    let bytes = job.read_job_bytes()?;
    let table = ChangeTableFile {
        bytes: &bytes,
        name: &job.file_name,
        recording: job.options.into.as_ref(),
    };
    let read = read_table_changes(connection, table, &options)?;
    let own_edits = job.options.own_edits;
    let is_edited = job.places.find_file_at(&job.place, job.kind).is_some();
    let update = plan_table_update(connection, read.changes, is_edited, own_edits == OwnEdits::Merge)?;
    if let Some(mut report) = unchanged_report {
        let is_lacking = |change: &&AnnotationChange| matches!(change.action, AnnotationAction::Add { .. });
        let lacking = update.changes.iter().filter(is_lacking).count() + update.edits.len();
        if lacking > 0 {
            report.findings.push(ReportFinding::finding_note(format!(
                "rows that the corpus does not have as they are: {lacking}"
            )));
        }
        return Ok(report);
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    if matches!(own_edits, OwnEdits::Ask | OwnEdits::Mine) && !update.edits.is_empty() {
        report.refuse_own_edits(own_edits, update.edits);
        return Ok(report);
    }
    let mut notes: Vec<String> = Vec::new();
    if update.known > 0 {
        notes.push(format!("rows that say what the corpus has already: {}", update.known));
    }
    if is_edited {
        report.status = FileStatus::Updated;
        notes.push(
            "annotations whose rows the table does not have any more stay; rows with the action remove take them away"
                .to_owned(),
        );
    }
    let findings = read.findings.iter().cloned();
    report.findings.extend(findings.map(ReportFinding::from));
    report.add_own_edits(update.edits);
    let changes = TableChanges {
        changes: update.changes,
        ..read
    };
    let written = write_table_changes(connection, changes, &job.file_name, &options, progress)?;
    let tiers = written.added_tiers.iter().flat_map(|row| &row.tiers);
    job.count_created_rows("tiers", tiers.clone().count());
    let names: BTreeSet<&str> = tiers.map(String::as_str).collect();
    if !names.is_empty() {
        let names = Vec::from_iter(names).join(", ");
        notes.push(format!(
            "added tiers, whose subject is guessed from their names: {names}"
        ));
    }
    report
        .findings
        .extend(notes.into_iter().map(ReportFinding::finding_note));
    let [added, changed, removed] =
        [written.added, written.changed, written.removed].map(|rows| usize::try_from(rows).unwrap_or_default());
    job.count_created_rows("annotations", added);
    job.counts.count_changed_rows("annotations", changed);
    job.counts.count_removed_rows("annotations", removed);
    job.keep_source_file(None, None)?;
    Ok(report)
}

/// The changes of a table that the corpus lacks.
#[derive(Default)]
struct TableUpdate {
    changes: Vec<AnnotationChange>,
    /// How many added annotations the corpus has already.
    known: usize,
    /// The annotations of the corpus that rows of an edited table contradict.
    edits: Vec<OwnEdit>,
}

/// Plans the changes of a table; if it `is_edited`, a row may change the annotation in its place, unless a merge keeps that.
fn plan_table_update(
    connection: &Connection,
    changes: Vec<AnnotationChange>,
    is_edited: bool,
    merges: bool,
) -> CorpusResult<TableUpdate> {
    let mut update = TableUpdate::default();
    for change in changes {
        match find_table_annotation(connection, &change.action)? {
            Some(known) if known.is_stored => {
                update.known += 1;
                update.changes.extend(naming_change(change));
            }
            Some(known) if is_edited && known.stored.is_some() => {
                update.edits.push(own_edit(&known, merges));
                let replacing = replacing_change(change);
                update.changes.extend(replacing.filter(|_| !merges));
            }
            _ => update.changes.push(change),
        }
    }
    Ok(update)
}

fn place_of_addition(action: &AnnotationAction) -> Option<AnnotationName> {
    match action {
        AnnotationAction::Add {
            tier,
            start: Some(start),
            ..
        } => Some(AnnotationName::At {
            tier: tier.clone(),
            start: *start,
        }),
        _ => None,
    }
}

/// Returns the change that changes nothing and gives an annotation the label of a row, below which others may hang;
/// nothing if the row has none.
fn naming_change(change: AnnotationChange) -> Option<AnnotationChange> {
    let annotation = place_of_addition(&change.action).filter(|_| change.label.is_some())?;
    let action = AnnotationAction::Set {
        annotation,
        start: None,
        end: None,
        value: None,
    };
    Some(AnnotationChange { action, ..change })
}

/// Returns the change that makes of the annotation in the place of a row that of the row.
fn replacing_change(change: AnnotationChange) -> Option<AnnotationChange> {
    let annotation = place_of_addition(&change.action)?;
    let AnnotationAction::Add { end, value, .. } = change.action else {
        return None;
    };
    let action = AnnotationAction::Set {
        annotation,
        start: None,
        end,
        value: Some(value),
    };
    Some(AnnotationChange { action, ..change })
}

fn own_edit(said: &TableAnnotation, merges: bool) -> OwnEdit {
    let side = |start_us, end_us, value: &str| AnnotationSide {
        start_us,
        end_us,
        value: value.to_owned(),
    };
    OwnEdit {
        tier: said.tier.clone(),
        mine: said
            .stored
            .as_ref()
            .map(|row| side(row.start_us, row.end_us, row.file_text())),
        theirs: Some(side(said.start_us, said.end_us, &said.value)),
        outcome: match merges {
            true => EditOutcome::Kept,
            false => EditOutcome::Lost,
        },
    }
}
