//! Imports tables of annotations of recordings that the corpus has, which `annotate from` reads, too.
//!
//! An edited table is imported as the difference to its earlier version. What was edited in the corpus since is treated as
//! with annotation files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use chereme_formats::table::annotations;
use rusqlite::Connection;

use super::import_captured::read_file_head;
use super::{AnnotationSide, EditOutcome, FileReport, FileStatus, ImportJob, OwnEdit, OwnEdits};
use crate::annotate::{
    AnnotateOptions, AnnotationAction, AnnotationChange, AnnotationName, ChangeTableFile, TableAnnotation,
    TableChanges, find_table_annotation, read_table_changes, write_table_changes,
};
use crate::db::stored_recordings;
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
    if let Some(report) = job.report_unchanged_file() {
        return Ok(report);
    }
    let connection = job.connection;
    let options = AnnotateOptions {
        add_tiers: true,
        ..AnnotateOptions::default()
    };
    let read_changes = |bytes: &[u8]| {
        let table = ChangeTableFile {
            bytes,
            name: &job.file_name,
            recording: job.options.into.as_ref(),
        };
        read_table_changes(connection, table, &options)
    };
    let bytes = job.read_job_bytes()?;
    let read = read_changes(&bytes)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let mut earlier = Vec::new();
    if let Some(row) = job.places.find_file_at(&job.place, job.kind) {
        report.status = FileStatus::Updated;
        if let Some(bytes) = stored_recordings::source_bytes(connection, row.id)? {
            earlier = read_changes(&bytes)?.changes;
        }
    }
    let merges = job.options.own_edits == OwnEdits::Merge;
    let update = plan_table_update(connection, earlier, read.changes, merges)?;
    if !merges && job.options.own_edits != OwnEdits::Theirs && !update.edits.is_empty() {
        report.refuse_own_edits(job.options.own_edits, update.edits);
        return Ok(report);
    }
    let mut notes: Vec<String> = Vec::new();
    if update.known > 0 {
        notes.push(format!("rows that say what the corpus has already: {}", update.known));
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
    job.keep_source_file(None, Some(&bytes))?;
    Ok(report)
}

/// The changes by which an edited table differs from its earlier version.
#[derive(Default)]
struct TableUpdate {
    changes: Vec<AnnotationChange>,
    /// How many added annotations the corpus has already.
    known: usize,
    /// The edits of the corpus that the changes would take back, or with a merge those that stay.
    edits: Vec<OwnEdit>,
}

/// Plans the changes from one version of a table to the next; with `merges` edits of the corpus stay.
fn plan_table_update(
    connection: &Connection,
    earlier: Vec<AnnotationChange>,
    later: Vec<AnnotationChange>,
    merges: bool,
) -> CorpusResult<TableUpdate> {
    let action_key = |change: &AnnotationChange| format!("{:?}", change.action);
    let mut gone: BTreeMap<String, AnnotationChange> = earlier
        .into_iter()
        .map(|change| (action_key(&change), change))
        .collect();
    let (kept, mut later): (Vec<_>, Vec<_>) = later
        .into_iter()
        .partition(|change| gone.remove(&action_key(change)).is_some());
    let mut update = TableUpdate::default();
    for change in gone.into_values() {
        let Some(place) = place_of_addition(&change.action) else {
            continue;
        };
        let Some(said) = find_table_annotation(connection, &change.action)? else {
            continue;
        };
        let at = later
            .iter()
            .position(|other| place_of_addition(&other.action).as_ref() == Some(&place));
        let wanted = match at {
            Some(at) => find_table_annotation(connection, &later[at].action)?,
            None => None,
        };
        let is_done = wanted.as_ref().map_or(said.stored.is_none(), |wanted| wanted.is_stored);
        if is_done {
            continue;
        }
        if !said.is_stored {
            update.edits.push(own_edit(&said, wanted.as_ref(), merges));
            if merges {
                at.map(|at| later.remove(at));
                continue;
            }
        }
        if said.stored.is_some() {
            let replaced = at.map(|at| later.remove(at));
            update.changes.push(replacing_change(place, replaced));
        }
    }
    // Below a row that stands already may hang a new one, which names it by its id in the table.
    let labelled = kept.into_iter().filter(|change| change.label.is_some());
    let rows = labelled.map(|change| (change, false));
    for (change, is_new) in rows.chain(later.into_iter().map(|change| (change, true))) {
        match find_table_annotation(connection, &change.action)? {
            Some(known) if known.is_stored => {
                update.known += usize::from(is_new);
                update.changes.extend(naming_change(change));
            }
            _ if is_new => update.changes.push(change),
            _ => {}
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

/// Returns the change that changes nothing and gives an annotation the label of a row; nothing if the row has none.
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

/// Returns the change that makes of an annotation that of the row in its place, or removes it.
fn replacing_change(annotation: AnnotationName, replaced: Option<AnnotationChange>) -> AnnotationChange {
    let Some(mut change) = replaced else {
        return AnnotationAction::Remove { annotation }.into();
    };
    if let AnnotationAction::Add { end, value, .. } = change.action {
        change.action = AnnotationAction::Set {
            annotation,
            start: None,
            end,
            value: Some(value),
        };
    }
    change
}

fn own_edit(said: &TableAnnotation, wanted: Option<&TableAnnotation>, merges: bool) -> OwnEdit {
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
        theirs: wanted.map(|wanted| side(wanted.start_us, wanted.end_us, &wanted.value)),
        outcome: match merges {
            true => EditOutcome::Kept,
            false => EditOutcome::Lost,
        },
    }
}
