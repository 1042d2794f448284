//! Changes of annotations: each list of changes is one operation, carried out completely or not at all.
//!
//! The tier rules are those of [`chereme_sign::tier`]; this module loads the affected rows and writes the resulting
//! changes back.

mod arrange;
mod bulk;
pub mod clipboard;
mod copies;
mod deeds;
pub mod drag_limits;
mod make_room;
pub(crate) mod messages;
mod names;
pub mod paste;
mod replace;
pub mod requests;
mod scheme;
mod scope;
pub mod snap;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
pub mod tier_values;
mod tiers;
mod write;

use std::collections::BTreeMap;

use chereme_formats::table::annotations::{Moment, TimeUnit};
use chereme_motion::{Instant, Span};
use chereme_sign::tier::spans::Mode;
use chereme_sign::tier::{AnnotationId, Change, Seam, TierId, plan};
use chereme_sign::{Reading, TierRole};
use rusqlite::Connection;
use serde::Serialize;

pub use copies::Copied;
pub use names::{AnnotationName, TierName};
pub use replace::{Find, Replaced, ReplacedValue, Within};
pub use scheme::Scheme;
pub use tiers::{NewTier, RemovedTiers, TierChange, Values};

use crate::Corpus;
use crate::db::columns::AnnotationOrigin;
use crate::db::edits;
use crate::db::tiers::{self as tier_rows, AnnotationRow, TierRow};
use crate::error::{Error, Result};
use crate::inventories::StoredInventory;
use crate::progress::{Progress, Step, Unit};
use crate::tokens;
use crate::words::effect::{AnnotationEffect, OperationEffect};
use deeds::Deeds;
use scope::Scope;

/// One change of annotations.
#[derive(Debug, Clone, PartialEq)]
pub struct AnnotationChange {
    /// The origin of the request, such as `changes.csv, line 3`; errors name it.
    pub place: Option<String>,
    /// A name by which later changes of the same list can refer to the annotation that this one adds.
    pub label: Option<String>,
    /// The action.
    pub action: AnnotationAction,
}

/// A change of annotations.
///
/// Values are texts: an id, alias or name of the tier's inventory, or any text if it has none. On coded tiers (glosses,
/// components, and those with an inventory) `unset`, `n/a` and `unclear` give the reason for a missing value; a blank
/// text is unset everywhere.
#[derive(Debug, Clone, PartialEq)]
pub enum AnnotationAction {
    /// Adds an annotation.
    Add {
        /// The tier.
        tier: TierName,
        /// The start; not needed on a symbolic tier.
        start: Option<Moment>,
        /// The end; not needed on a symbolic tier.
        end: Option<Moment>,
        /// The parent annotation on a symbolic tier, if the times do not determine it.
        parent: Option<AnnotationName>,
        /// The place among its siblings on a Symbolic_Subdivision, from 0; by default at the end.
        order: Option<u32>,
        /// The value.
        value: String,
        /// The confidence of its origin, from 0 to 1.
        confidence: Option<f64>,
    },
    /// Gives an annotation another time, another value, or both.
    Set {
        /// The annotation.
        annotation: AnnotationName,
        /// The new start.
        start: Option<Moment>,
        /// The new end.
        end: Option<Moment>,
        /// The new value.
        value: Option<String>,
    },
    /// Gives an annotation of a Symbolic_Subdivision another place among its siblings.
    Reorder {
        /// The annotation.
        annotation: AnnotationName,
        /// The place from 0.
        order: u32,
    },
    /// Cuts an annotation in two, both with its value.
    Split {
        /// The annotation, which becomes the first half.
        annotation: AnnotationName,
        /// The cut.
        at: Moment,
    },
    /// Merges two neighbours into one annotation.
    Merge {
        /// The earlier one, which remains.
        first: AnnotationName,
        /// The later one, which is removed.
        second: AnnotationName,
        /// The value of the merged annotation; `None` if both have the same.
        value: Option<String>,
        /// Whether equal children that meet at the seam are merged too.
        join: bool,
    },
    /// Removes an annotation and all its descendants.
    Remove {
        /// The annotation.
        annotation: AnnotationName,
    },
}

impl From<AnnotationAction> for AnnotationChange {
    fn from(action: AnnotationAction) -> Self {
        Self {
            place: None,
            label: None,
            action,
        }
    }
}

/// Options for changes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AnnotateOptions {
    /// Whether times move to the start of the nearest frame of the recording's movement.
    pub snap: bool,
    /// The source of the annotations.
    pub origin: AnnotationOrigin,
    /// The treatment of annotations in the way of an added or moved one; in normal mode the change is refused.
    pub mode: Mode,
    /// The unit of bare numbers in a table whose titles name no unit; seconds by default.
    pub unit: Option<TimeUnit>,
}

/// The result of a list of changes.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct AnnotateReport {
    /// The annotation that each change added, changed or removed.
    pub annotations: Vec<i64>,
    /// The number of added annotations, including those that result from a split.
    pub added: u64,
    /// The number of changed annotations, including those that had to follow others.
    pub changed: u64,
    /// The number of removed annotations, including descendants.
    pub removed: u64,
    /// The recordings, in order.
    pub recordings: Vec<String>,
    /// A summary of the change, as in the history: `1 annotation changed to MINE in take 3`.
    pub summary: String,
    /// What was changed, as in the history.
    #[serde(skip)]
    pub effect: AnnotationEffect,
}

impl Corpus {
    /// Carries out changes of annotations as one operation, in order: all of them, or none.
    ///
    /// Tokens and search are updated. Annotations that a person changes or adds belong to that person from then on, and
    /// moved ones lose the milliseconds of the file they came from.
    ///
    /// # Errors
    /// Fails if changes violate a rule of their tier, name a missing object, or use a value that the tier's inventory
    /// does not have: [`Error::Several`] with each of them if the list has more than one.
    pub fn annotate(
        &mut self,
        changes: &[AnnotationChange],
        options: &AnnotateOptions,
        progress: &mut Progress<'_>,
    ) -> Result<AnnotateReport> {
        self.annotate_all(changes, options, Vec::new(), progress)
    }

    fn annotate_all(
        &mut self,
        changes: &[AnnotationChange],
        options: &AnnotateOptions,
        faults: Vec<Error>,
        progress: &mut Progress<'_>,
    ) -> Result<AnnotateReport> {
        let work = |connection: &Connection, progress: &mut Progress<'_>| {
            let report = carry_out(connection, changes, options, faults, progress)?;
            let effect = OperationEffect::Annotate(report.effect.clone());
            Ok((report, effect))
        };
        self.store.operation_with_progress(progress, work)
    }

    /// Adds tiers and changes annotations as one operation, which `effect` describes: all of it, or nothing.
    pub(crate) fn annotate_with(
        &mut self,
        effect: fn(AnnotationEffect) -> OperationEffect,
        new: &[NewTier],
        (changes, options): (&[AnnotationChange], &AnnotateOptions),
        progress: &mut Progress<'_>,
    ) -> Result<AnnotateReport> {
        let work = |connection: &Connection, progress: &mut Progress<'_>| {
            let report = write_tiers(connection, new, (changes, options), progress)?;
            let effect = effect(report.effect.clone());
            Ok((report, effect))
        };
        self.store.operation_with_progress(progress, work)
    }
}

/// Adds tiers and changes annotations inside the caller's operation.
pub(crate) fn write_tiers(
    connection: &Connection,
    new: &[NewTier],
    (changes, options): (&[AnnotationChange], &AnnotateOptions),
    progress: &mut Progress<'_>,
) -> Result<AnnotateReport> {
    for tier in new {
        tiers::insert(connection, tier)?;
    }
    carry_out(connection, changes, options, Vec::new(), progress)
}

/// Carries out changes of annotations.
fn carry_out(
    connection: &Connection,
    changes: &[AnnotationChange],
    options: &AnnotateOptions,
    faults: Vec<Error>,
    progress: &mut Progress<'_>,
) -> Result<AnnotateReport> {
    let mut work = Work::new(connection, options)?;
    work.faults = faults;
    for (done, change) in changes.iter().enumerate() {
        work.change(change)?;
        if changes.len() > 1 && done % 64 == 0 {
            progress.report(Step {
                task: "annotating",
                done: done as u64,
                total: Some(changes.len() as u64),
                unit: Unit::Items,
            })?;
        }
    }
    let deeds = std::mem::take(&mut work.deeds);
    let mut report = work.finish(changes.len(), progress)?;
    report.effect = deeds.effect(&report);
    (_, report.summary, _) = OperationEffect::Annotate(report.effect.clone()).stored_texts();
    Ok(report)
}

/// Removes annotations with all below them, inside the caller's operation, and returns how many were removed.
pub(crate) fn remove_all(
    connection: &Connection,
    annotations: &[i64],
    progress: &mut Progress<'_>,
) -> Result<u64> {
    let remove = |id: &i64| AnnotationAction::Remove {
        annotation: AnnotationName::Number(*id),
    };
    let changes: Vec<AnnotationChange> = annotations.iter().map(remove).map(Into::into).collect();
    let options = AnnotateOptions::default();
    let report = carry_out(connection, &changes, &options, Vec::new(), progress)?;
    Ok(report.removed)
}

/// State while a list of changes is carried out.
struct Work<'a> {
    connection: &'a Connection,
    options: &'a AnnotateOptions,
    scopes: BTreeMap<i64, Scope>,
    /// Annotations by the labels of the changes that added them; nothing if the change failed.
    labels: BTreeMap<String, Option<i64>>,
    faults: Vec<Error>,
    deeds: Deeds,
    report: AnnotateReport,
}

impl<'a> Work<'a> {
    fn new(connection: &'a Connection, options: &'a AnnotateOptions) -> Result<Self> {
        edits::defer_references(connection)?;
        Ok(Self {
            connection,
            options,
            scopes: BTreeMap::new(),
            labels: BTreeMap::new(),
            faults: Vec::new(),
            deeds: Deeds::default(),
            report: AnnotateReport::default(),
        })
    }

    /// Carries out one change, or records why it cannot be carried out.
    fn change(&mut self, change: &AnnotationChange) -> Result<()> {
        let done = self.act(change);
        let annotation = match done {
            Ok(annotation) => Some(annotation),
            Err(fault @ (Error::Wrong { .. } | Error::Follows(_))) => {
                self.faults.push(match &change.place {
                    Some(place) => fault.at(place),
                    None => fault,
                });
                None
            }
            Err(other) => return Err(other),
        };
        self.report.annotations.extend(annotation);
        if let Some(label) = &change.label {
            self.labels.insert(label.clone(), annotation);
        }
        Ok(())
    }

    fn finish(mut self, changes: usize, progress: &mut Progress<'_>) -> Result<AnnotateReport> {
        let failed = self.labels.values().any(Option::is_none);
        self.faults
            .retain(|fault| !(failed && matches!(fault, Error::Follows(_))));
        match self.faults.len() {
            0 => {}
            1 if changes <= 1 => return Err(self.faults.remove(0)),
            _ => {
                let errors = self.faults;
                return Err(Error::Several { errors });
            }
        }
        for scope in self.scopes.values() {
            scope.close(self.connection)?;
            if let Some(touched) = scope.touched {
                let recording = scope.recording.id;
                tokens::derive_with_progress(
                    self.connection,
                    recording,
                    Some(touched),
                    &scope.inventories,
                    progress,
                )?;
                self.report.recordings.push(scope.recording.name.clone());
            }
        }
        Ok(self.report)
    }

    fn act(&mut self, change: &AnnotationChange) -> Result<i64> {
        use AnnotationAction::{Add, Remove, Reorder};
        if let Add { .. } | Reorder { .. } | Remove { .. } = change.action {
            self.deeds.does_else();
        }
        match &change.action {
            AnnotationAction::Add { .. } => self.add(&change.action),
            AnnotationAction::Set {
                annotation,
                start,
                end,
                value,
            } => {
                let row = self.annotation(annotation)?;
                self.set(&row, *start, *end, value.as_deref())
            }
            AnnotationAction::Reorder { annotation, order } => {
                let row = self.annotation(annotation)?;
                let annotation = handle(row.id);
                let order = *order;
                self.carry_out(row.tier_id, &Change::Reorder { annotation, order }, None)?;
                Ok(row.id)
            }
            AnnotationAction::Split { annotation, at } => {
                let row = self.annotation(annotation)?;
                let snap = self.options.snap;
                let at = self.scope_of(row.tier_id)?.instant(*at, snap)?;
                let annotation = handle(row.id);
                let added = self.carry_out(row.tier_id, &Change::Split { annotation, at }, None)?;
                self.deeds.splits(row.id);
                Ok(added.unwrap_or(row.id))
            }
            AnnotationAction::Merge {
                first,
                second,
                value,
                join,
            } => {
                let (first, second) = (self.annotation(first)?, self.annotation(second)?);
                let tier = self.tier_row(first.tier_id)?;
                let value = value.as_deref().map(|text| self.reading(&tier, text));
                let change = Change::Merge {
                    first: handle(first.id),
                    second: handle(second.id),
                    value: value.transpose()?,
                    seam: if *join { Seam::Join } else { Seam::Keep },
                };
                self.carry_out(first.tier_id, &change, None)?;
                self.deeds.merges(first.id, second.id);
                Ok(first.id)
            }
            AnnotationAction::Remove { annotation } => {
                let row = self.annotation(annotation)?;
                let annotation = handle(row.id);
                self.carry_out(row.tier_id, &Change::Remove { annotation }, None)?;
                Ok(row.id)
            }
        }
    }

    fn add(&mut self, action: &AnnotationAction) -> Result<i64> {
        let AnnotationAction::Add {
            tier,
            start,
            end,
            parent,
            order,
            value,
            confidence,
        } = action
        else {
            return Err(Error::wrong("nothing is to be added"));
        };
        let tier = self.tier(tier)?;
        let value = self.reading(&tier, value)?;
        let times = start.zip(*end);
        let span = match times {
            Some((start, end)) => Some(self.span(tier.id, start, end)?),
            None => None,
        };
        let id = TierId(unsigned(tier.id));
        let change = if is_symbolic(&tier) {
            let parent = match (parent, span) {
                (Some(parent), _) => self.annotation(parent)?.id,
                (None, Some(span)) => self.above(&tier, span)?,
                (None, None) => {
                    return Err(Error::wrong(format!(
                        "an annotation of the symbolic tier {:?} needs one above it",
                        tier.name
                    ))
                    .advise("name its parent, or the times of its parent"));
                }
            };
            Change::AddBelow {
                tier: id,
                parent: handle(parent),
                order: *order,
                value,
            }
        } else {
            let span = span.ok_or_else(|| {
                Error::wrong(format!(
                    "an annotation of the tier {:?} needs a start and an end",
                    tier.name
                ))
                .advise("only annotations of symbolic tiers have no times of their own")
            })?;
            self.make_room(&tier, span)?;
            Change::Add {
                tier: id,
                span,
                value,
            }
        };
        let added = self.carry_out(tier.id, &change, *confidence)?;
        added.ok_or_else(|| Error::wrong("nothing was added"))
    }

    fn set(
        &mut self,
        row: &AnnotationRow,
        start: Option<Moment>,
        end: Option<Moment>,
        value: Option<&str>,
    ) -> Result<i64> {
        let annotation = handle(row.id);
        let tier = self.tier_row(row.tier_id)?;
        let text = value;
        let reading = value.map(|text| self.reading(&tier, text)).transpose()?;
        if start.is_some() || end.is_some() {
            let still = |micros| Moment::Time(Instant::from_micros(micros));
            let start = start.unwrap_or_else(|| still(row.start_us));
            let end = end.unwrap_or_else(|| still(row.end_us));
            let span = self.span(row.tier_id, start, end)?;
            if span != span_of(row) {
                if !self.moved_with_others(row, &tier, span)? {
                    self.carry_out(row.tier_id, &Change::Move { annotation, span }, None)?;
                }
                self.deeds.moves(row.id);
            }
        }
        if let Some(value) = reading {
            let says = value.value().or(text).map_or("", str::trim);
            let says = if says.is_empty() { "unset" } else { says };
            self.deeds.says(&tier, row.id, says);
            self.carry_out(row.tier_id, &Change::SetValue { annotation, value }, None)?;
        }
        Ok(row.id)
    }

    /// Plans a change among its neighbours, writes the edits, and returns the first added annotation.
    fn carry_out(
        &mut self,
        tier: i64,
        change: &Change,
        confidence: Option<f64>,
    ) -> Result<Option<i64>> {
        let recording = self.scope_of(tier)?.recording.id;
        let scope = self
            .scopes
            .get(&recording)
            .ok_or_else(|| Error::wrong("the recording is gone"))?;
        let near = scope.neighbourhood(self.connection, tier, change)?;
        let mut next = FRESH;
        let mut fresh = || {
            next += 1;
            AnnotationId(next)
        };
        let edits = match plan(&near.set, change, &mut fresh) {
            Ok(edits) => edits,
            Err(error) => return Err(messages::refused(self.connection, tier, &error)?),
        };
        let named: Vec<i64> = change.annotations().into_iter().map(signed).collect();
        let named = match change {
            Change::AddBelow { .. } => Vec::new(),
            _ => named,
        };
        let says = write::Says {
            origin: self.options.origin,
            confidence,
            named: &named,
        };
        let written = write::write(self.connection, &edits, &near.rows, &says)?;
        self.report.added += written.added.len() as u64;
        self.report.changed += written.changed;
        self.report.removed += written.removed;
        if let Some(scope) = self.scopes.get_mut(&recording) {
            scope.touch(written.touched);
        }
        Ok(written.added.first().copied())
    }

    /// Returns the reading of `text` on a tier.
    fn reading(&mut self, tier: &TierRow, text: &str) -> Result<Reading> {
        let inventory = self
            .scope_of(tier.id)?
            .inventories
            .iter()
            .find(|stored| Some(stored.id) == tier.inventory_id);
        reading(tier, inventory, text)
    }

    fn span(&mut self, tier: i64, start: Moment, end: Moment) -> Result<Span> {
        let snap = self.options.snap;
        let scope = self.scope_of(tier)?;
        let (start, end) = (scope.instant(start, snap)?, scope.instant(end, snap)?);
        scope.check_bounds(start, end)?;
        Ok(Span::between(start, end))
    }

    fn scope_of(&mut self, tier: i64) -> Result<&Scope> {
        let recording = tier_rows::tier(self.connection, tier)?.recording_id;
        if !self.scopes.contains_key(&recording) {
            let scope = Scope::read(self.connection, recording)?;
            self.scopes.insert(recording, scope);
        }
        self.scopes
            .get(&recording)
            .ok_or_else(|| Error::wrong("the recording is gone"))
    }

    fn tier_row(&self, id: i64) -> Result<TierRow> {
        tier_rows::tier(self.connection, id)
    }
}

/// The first handle for annotations that have no row yet.
const FRESH: u64 = 1 << 62;

fn unsigned(id: i64) -> u64 {
    u64::try_from(id).unwrap_or_default()
}

fn handle(id: i64) -> AnnotationId {
    AnnotationId(unsigned(id))
}

fn signed(id: AnnotationId) -> i64 {
    i64::try_from(id.0).unwrap_or_default()
}

fn span_of(row: &AnnotationRow) -> Span {
    Span::between(
        Instant::from_micros(row.start_us),
        Instant::from_micros(row.end_us),
    )
}

fn is_symbolic(tier: &TierRow) -> bool {
    tier.stereotype
        .is_some_and(|stereotype| !stereotype.is_alignable())
}

/// Returns the reading of `text` on a tier with that inventory, as the inventory's own id if it has one.
fn reading(tier: &TierRow, inventory: Option<&StoredInventory>, text: &str) -> Result<Reading> {
    let coded = inventory.is_some() || tier.role.is_coded();
    if !coded || text.trim().is_empty() {
        return Ok(Reading::from(text));
    }
    let text = text.trim();
    let known = inventory.and_then(|stored| stored.inventory.find(text));
    if let Some(value) = known {
        return Ok(Reading::Value(value.id.clone()));
    }
    let lower = text.to_lowercase();
    let word = match tier.role {
        TierRole::Gloss => text,
        _ => &lower,
    };
    match (word, inventory) {
        ("unset", _) => Ok(Reading::Unset),
        ("n/a" | "not applicable" | "not-applicable", _) => Ok(Reading::NotApplicable),
        ("unclear" | "?", _) => Ok(Reading::Unclear),
        (_, None) => Ok(Reading::Value(text.to_owned())),
        (_, Some(stored)) => Err(not_in(stored, tier, text)),
    }
}

fn not_in(stored: &StoredInventory, tier: &TierRow, text: &str) -> Error {
    let inventory = &stored.inventory;
    let near = inventory.suggest(text);
    let meant = match near.as_slice() {
        [] => String::new(),
        [one] => format!("; did you mean {one:?}?"),
        several => format!("; did you mean one of {}?", several.join(", ")),
    };
    Error::wrong(format!(
        "{text:?} is no value of the inventory {:?} of the tier {:?}{meant}",
        inventory.id, tier.name
    ))
    .advise(format!(
        "`chereme list CORPUS values --where 'inventory={}'` lists the values",
        inventory.id
    ))
}
