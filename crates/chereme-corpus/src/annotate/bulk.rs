//! Changes of annotations from a table.

use chereme_formats::table::TableError;
use chereme_formats::table::annotations::{self, Action, ChangeRow, Fault};
use chereme_sign::Remedy;

use super::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName, TierName,
};
use crate::Corpus;
use crate::address::{Address, Name};
use crate::db::recordings;
use crate::error::{Error, Result};
use crate::import::ReportFinding;
use crate::progress::Progress;

impl Corpus {
    /// Applies the changes in a table (CSV or TSV) of annotations, as one operation.
    ///
    /// `name` is the name of the table in errors. Rows without a recording apply to `recording`, or to the only one of
    /// the corpus. An annotation named by its id must be in the recording and on the tier that its row names. The format
    /// is that of [`chereme_formats::table::annotations::read`].
    ///
    /// # Errors
    /// [`Error::Several`] with every row that cannot be carried out; nothing is changed then.
    pub fn annotate_table(
        &mut self,
        bytes: &[u8],
        name: &str,
        recording: Option<&Name>,
        options: &AnnotateOptions,
        progress: &mut Progress<'_>,
    ) -> Result<(AnnotateReport, Vec<ReportFinding>)> {
        let (table, findings) = annotations::read(bytes, options.unit).map_err(|error| {
            let wrong = Error::wrong(error.to_string()).at(name);
            match error {
                TableError::Implausible { .. } => wrong.advise(Remedy::command(
                    "or name the unit with the table: --unit ms, --unit s or --unit frames",
                )),
                _ => wrong,
            }
        })?;
        let only = recordings::recordings(self.store.read())?;
        let only = match only.as_slice() {
            [one] => Some(Name::Number(one.id)),
            _ => None,
        };
        let recording = recording.cloned().or(only);
        let mut faults: Vec<Error> = table.faults.iter().map(|it| fault(name, it)).collect();
        let mut changes = Vec::with_capacity(table.rows.len());
        for row in &table.rows {
            let place = format!("{name}, line {}", row.line);
            match change(row, recording.as_ref(), &place) {
                Ok(change) => changes.push(change),
                Err(error) => faults.push(error.at(place)),
            }
        }
        if changes.is_empty() && faults.is_empty() {
            return Err(Error::wrong("the table asks for nothing")
                .at(name)
                .advise("write a row for each change below the row of column names"));
        }
        let report = match self.annotate_all(&changes, options, faults, progress) {
            Err(error @ (Error::Wrong { .. } | Error::Follows(_))) => {
                return Err(Error::Several {
                    errors: vec![error],
                });
            }
            Err(Error::Several { mut errors }) => {
                // A column that was not recognised may be the one that the rows lack.
                let unused = findings.iter().filter(|it| it.line == Some(1));
                errors.extend(unused.map(|finding| {
                    Error::wrong(finding.message.clone())
                        .at(format!("{name}, line 1"))
                        .advise("the columns are recording, tier, start, end, duration, value, action, id, parent")
                }));
                errors.sort_by_key(line_of);
                return Err(Error::Several { errors });
            }
            other => other?,
        };
        Ok((
            report,
            findings.into_iter().map(ReportFinding::from).collect(),
        ))
    }
}

fn line_of(error: &Error) -> Option<u64> {
    error.place()?.rsplit_once(' ')?.1.parse().ok()
}

fn fault(name: &str, fault: &Fault) -> Error {
    Error::wrong(format!("{}: {}", fault.column, fault.message))
        .at(format!("{name}, line {}", fault.line))
}

fn change(row: &ChangeRow, recording: Option<&Name>, place: &str) -> Result<AnnotationChange> {
    let own = row.recording.as_deref().map(recording_name);
    let recording = own.as_ref().or(recording);
    let tier = |text: &str| TierName::read(text, recording);
    let named = || match (&row.id, &row.tier, row.start) {
        (Some(id), tier, _) => {
            let annotation = AnnotationName::Placed {
                annotation: Box::new(AnnotationName::read(id, recording)),
                recording: own.clone(),
                tier: tier.clone(),
            };
            Ok((annotation, row.start))
        }
        (None, Some(text), Some(start)) => {
            let tier = tier(text)?;
            Ok((AnnotationName::At { tier, start }, None))
        }
        _ => Err(Error::wrong(
            "name the annotation by its id, or by its tier and start",
        )),
    };
    let action = match row.action {
        Action::Add => AnnotationAction::Add {
            tier: tier(row.tier.as_deref().unwrap_or_default())?,
            start: row.start,
            end: row.end,
            parent: row
                .parent
                .as_deref()
                .map(|id| AnnotationName::read(id, recording)),
            order: None,
            value: row.value.clone().unwrap_or_default(),
            confidence: None,
        },
        Action::Remove => AnnotationAction::Remove {
            annotation: named()?.0,
        },
        Action::Set => {
            let (annotation, start) = named()?;
            AnnotationAction::Set {
                annotation,
                start,
                end: row.end,
                value: row.value.clone(),
            }
        }
    };
    let label = row.id.clone().filter(|_| row.action == Action::Add);
    Ok(AnnotationChange {
        place: Some(place.to_owned()),
        label,
        action,
    })
}

fn recording_name(text: &str) -> Name {
    match text.parse() {
        Ok(Address::Recording(name)) => name,
        _ => Name::Text(text.to_owned()),
    }
}
