//! Changes of annotations: each list of changes is one operation, carried out completely or not at all.
//!
//! The tier rules are those of [`chereme_sign::tier`]; this module loads the affected rows and writes the resulting
//! changes back.

mod annotate_bulk;
pub mod annotate_clipboard;
mod annotate_messages;
mod annotate_names;
pub mod annotate_paste;
mod annotate_tiers;
mod annotate_write;
mod arrange;
mod copies;
mod deeds;
pub mod drag_limits;
mod make_room;
mod replace;
pub mod requests;
mod scheme;
mod scope;
pub mod snap;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod tier_rounds;
pub mod tier_values;

use std::collections::BTreeMap;

use chereme_formats::table::annotations::{TableMoment, TableTimeUnit};
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::tier_spans::NeighbourMode;
use chereme_sign::tier::{AnnotationId, AskedTierChange, MergeSeam, TierId, plan_tier_change};
use chereme_sign::{ComponentReading, TierRole};
use rusqlite::Connection;
use serde::Serialize;

pub(crate) use annotate_bulk::{
    ChangeTableFile, TableAnnotation, TableChanges, find_table_annotation, read_table_changes, write_table_changes,
};
pub use annotate_names::{AnnotationName, TierRequestName};
pub use annotate_tiers::{NewTier, RemovedTiers, TierPropertyChange, TierValueSource};
pub use copies::CopiedAnnotations;
pub use replace::{ReplacedValue, ReplacementReport, TierSelection, ValueSearch};
pub use scheme::TierScheme;
pub use tier_rounds::{TierRoundOptions, TierRoundReport, TierRoundRow, TierRoundScope, TierRoundWork};

use crate::Corpus;
use crate::address::message_names::FIRST_FRESH_HANDLE;
use crate::db::edits;
use crate::db::stored_columns::AnnotationOrigin;
use crate::db::stored_tiers::{self as tier_rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::StoredInventory;
use crate::progress::ProgressReceiver;
use crate::tokens;
use crate::words::effect::{AnnotationEffect, OperationEffect};
use deeds::AnnotationDeeds;
use scope::AnnotationScope;

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
        tier: TierRequestName,
        /// The start; not needed on a symbolic tier.
        start: Option<TableMoment>,
        /// The end; not needed on a symbolic tier.
        end: Option<TableMoment>,
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
        start: Option<TableMoment>,
        /// The new end.
        end: Option<TableMoment>,
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
        at: TableMoment,
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
    /// The detector that found added annotations, whoever writes them.
    pub detector: Option<&'static str>,
    /// The treatment of annotations in the way of an added or moved one; in normal mode the change is refused.
    pub mode: NeighbourMode,
    /// The unit of bare numbers in a table whose titles name no unit; seconds by default.
    pub unit: Option<TableTimeUnit>,
    /// Whether tiers are added to which a table adds annotations and which its recordings lack.
    pub add_tiers: bool,
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
    /// The tiers that were added for the annotations, by recording.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub added_tiers: Vec<TierRoundRow>,
}

impl Corpus {
    /// Carries out changes of annotations as one operation, in order: all of them, or none.
    ///
    /// Tokens and search are updated. Annotations that a person changes or adds belong to that person from then on, and
    /// moved ones lose the milliseconds of the file they came from.
    ///
    /// # Errors
    /// Fails if changes violate a rule of their tier, name a missing object, or use a value that the tier's inventory
    /// does not have: [`CorpusError::Several`] with each of them if the list has more than one.
    pub fn annotate_corpus(
        &mut self,
        changes: &[AnnotationChange],
        options: &AnnotateOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        self.annotate_with(OperationEffect::Annotate, &[], changes, options, progress)
    }

    /// Adds tiers and changes annotations as one operation, which `effect` describes: all of it, or nothing.
    pub(crate) fn annotate_with(
        &mut self,
        effect: fn(AnnotationEffect) -> OperationEffect,
        new: &[NewTier],
        changes: &[AnnotationChange],
        options: &AnnotateOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let work = |connection: &Connection, progress: &mut ProgressReceiver<'_>| {
            let report = write_tiers(connection, new, changes, options, progress)?;
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
    changes: &[AnnotationChange],
    options: &AnnotateOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<AnnotateReport> {
    for tier in new {
        annotate_tiers::insert_new_tier(connection, tier)?;
    }
    carry_out_changes(connection, changes, options, Vec::new(), progress)
}

/// Carries out changes of annotations.
fn carry_out_changes(
    connection: &Connection,
    changes: &[AnnotationChange],
    options: &AnnotateOptions,
    faults: Vec<CorpusError>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<AnnotateReport> {
    let mut work = AnnotationChangeRun::new(connection, options)?;
    work.faults = faults;
    for (done, change) in changes.iter().enumerate() {
        work.run_annotation_change(change)?;
        // A single change is over before a report could be seen.
        if changes.len() > 1 && done % 64 == 0 {
            progress.report_items("annotating", done, changes.len())?;
        }
    }
    let deeds = std::mem::take(&mut work.deeds);
    let mut report = work.finish_annotation_changes(changes.len(), progress)?;
    report.effect = deeds.collected_deed_effect(&report);
    (_, report.summary, _) = OperationEffect::Annotate(report.effect.clone()).stored_texts();
    Ok(report)
}

/// Removes annotations with all below them, inside the caller's operation, and returns how many were removed.
pub(crate) fn remove_all(
    connection: &Connection,
    annotations: &[i64],
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<u64> {
    let remove = |id: &i64| AnnotationAction::Remove {
        annotation: AnnotationName::Number(*id),
    };
    let changes: Vec<AnnotationChange> = annotations.iter().map(remove).map(Into::into).collect();
    let options = AnnotateOptions::default();
    let report = carry_out_changes(connection, &changes, &options, Vec::new(), progress)?;
    Ok(report.removed)
}

/// State while a list of changes is carried out.
struct AnnotationChangeRun<'a> {
    connection: &'a Connection,
    options: &'a AnnotateOptions,
    scopes: BTreeMap<i64, AnnotationScope>,
    /// Annotations by the labels of the changes that added them; nothing if the change failed.
    labels: BTreeMap<String, Option<i64>>,
    faults: Vec<CorpusError>,
    deeds: AnnotationDeeds,
    report: AnnotateReport,
}

impl<'a> AnnotationChangeRun<'a> {
    fn new(connection: &'a Connection, options: &'a AnnotateOptions) -> CorpusResult<Self> {
        // Tokens refer to annotations that changes may remove before they are derived again.
        edits::defer_references(connection)?;
        Ok(Self {
            connection,
            options,
            scopes: BTreeMap::new(),
            labels: BTreeMap::new(),
            faults: Vec::new(),
            deeds: AnnotationDeeds::default(),
            report: AnnotateReport::default(),
        })
    }

    /// Carries out one change, or records why it cannot be carried out.
    fn run_annotation_change(&mut self, change: &AnnotationChange) -> CorpusResult<()> {
        let done = self.act_on_change(change);
        let annotation = match done {
            Ok(annotation) => Some(annotation),
            // Further faults may exist in later changes, which the user wants to know at once.
            Err(fault @ (CorpusError::Wrong { .. } | CorpusError::Follows(_))) => {
                self.faults.push(match &change.place {
                    Some(place) => fault.with_error_place(place),
                    None => fault,
                });
                None
            }
            Err(other) => return Err(other),
        };
        self.report.annotations.extend(annotation);
        if let Some(label) = &change.label {
            // A failed change leaves its label without an annotation, so that later changes can say why they
            // fail.
            self.labels.insert(label.clone(), annotation);
        }
        Ok(())
    }

    fn finish_annotation_changes(
        mut self,
        changes: usize,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnnotateReport> {
        let failed = self.labels.values().any(Option::is_none);
        self.faults
            // Failures that only follow from another one would distract from it.
            .retain(|fault| !(failed && matches!(fault, CorpusError::Follows(_))));
        match self.faults.len() {
            0 => {}
            1 if changes <= 1 => return Err(self.faults.remove(0)),
            _ => {
                return Err(CorpusError::from_error_list(self.faults));
            }
        }
        for scope in self.scopes.values() {
            scope.close_annotation_scope(self.connection)?;
            if let Some(touched) = scope.touched {
                let recording = scope.recording.id;
                // Only tokens near the changes can differ.
                tokens::derive_with_progress(self.connection, recording, Some(touched), &scope.inventories, progress)?;
                self.report.recordings.push(scope.recording.name.clone());
            }
        }
        Ok(self.report)
    }

    fn act_on_change(&mut self, change: &AnnotationChange) -> CorpusResult<i64> {
        use AnnotationAction::{Add, Remove, Reorder};
        if let Add { .. } | Reorder { .. } | Remove { .. } = change.action {
            self.deeds.does_else();
        }
        match &change.action {
            AnnotationAction::Add { .. } => self.add_planned_annotation(&change.action),
            AnnotationAction::Set {
                annotation,
                start,
                end,
                value,
            } => {
                let row = self.find_requested_annotation(annotation)?;
                self.set_annotation_fields(&row, *start, *end, value.as_deref())
            }
            AnnotationAction::Reorder { annotation, order } => {
                let row = self.find_requested_annotation(annotation)?;
                let annotation = annotation_handle(row.id);
                let order = *order;
                self.carry_out_edit(row.tier_id, &AskedTierChange::Reorder { annotation, order }, None)?;
                Ok(row.id)
            }
            AnnotationAction::Split { annotation, at } => {
                let row = self.find_requested_annotation(annotation)?;
                let snap = self.options.snap;
                let split_instant = self.scope_of(row.tier_id)?.resolve_moment(*at, snap)?;
                let annotation = annotation_handle(row.id);
                let added = self.carry_out_edit(
                    row.tier_id,
                    &AskedTierChange::Split {
                        annotation,
                        at: split_instant,
                    },
                    None,
                )?;
                self.deeds.note_split_annotation(row.id);
                Ok(added.unwrap_or(row.id))
            }
            AnnotationAction::Merge {
                first,
                second,
                value,
                join,
            } => {
                let (first, second) = (
                    self.find_requested_annotation(first)?,
                    self.find_requested_annotation(second)?,
                );
                let tier = self.tier_row(first.tier_id)?;
                let value = value.as_deref().map(|text| self.reading_on_tier(&tier, text));
                let change = AskedTierChange::Merge {
                    first: annotation_handle(first.id),
                    second: annotation_handle(second.id),
                    value: value.transpose()?,
                    seam: if *join { MergeSeam::Join } else { MergeSeam::Keep },
                };
                self.carry_out_edit(first.tier_id, &change, None)?;
                self.deeds.note_merged_annotations(first.id, second.id);
                Ok(first.id)
            }
            AnnotationAction::Remove { annotation } => {
                let row = self.find_requested_annotation(annotation)?;
                let annotation = annotation_handle(row.id);
                self.carry_out_edit(row.tier_id, &AskedTierChange::Remove { annotation }, None)?;
                Ok(row.id)
            }
        }
    }

    fn add_planned_annotation(&mut self, action: &AnnotationAction) -> CorpusResult<i64> {
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
            return Err(CorpusError::from_wrong_message("nothing is to be added"));
        };
        let tier = self.find_work_tier(tier)?;
        let value = self.reading_on_tier(&tier, value)?;
        let times = start.zip(*end);
        let span = match times {
            Some((start, end)) => Some(self.span_from_moments(tier.id, start, end)?),
            None => None,
        };
        let id = TierId(unsigned(tier.id));
        let change = if is_symbolic(&tier) {
            let parent = match (parent, span) {
                (Some(parent), _) => self.find_requested_annotation(parent)?.id,
                (None, Some(span)) => self.find_parent_annotation(&tier, span)?,
                (None, None) => {
                    return Err(CorpusError::from_wrong_message(format!(
                        "an annotation of the symbolic tier {:?} needs one above it",
                        tier.name
                    ))
                    .with_advice("name its parent, or the times of its parent"));
                }
            };
            AskedTierChange::AddBelow {
                tier: id,
                parent: annotation_handle(parent),
                order: *order,
                value,
            }
        } else {
            let span = span.ok_or_else(|| {
                CorpusError::from_wrong_message(format!(
                    "an annotation of the tier {:?} needs a start and an end",
                    tier.name
                ))
                .with_advice("only annotations of symbolic tiers have no times of their own")
            })?;
            self.make_annotation_room(&tier, span)?;
            AskedTierChange::Add { tier: id, span, value }
        };
        let added = self.carry_out_edit(tier.id, &change, *confidence)?;
        added.ok_or_else(|| CorpusError::from_wrong_message("nothing was added"))
    }

    fn set_annotation_fields(
        &mut self,
        row: &AnnotationRow,
        start: Option<TableMoment>,
        end: Option<TableMoment>,
        value: Option<&str>,
    ) -> CorpusResult<i64> {
        let annotation = annotation_handle(row.id);
        let tier = self.tier_row(row.tier_id)?;
        let text = value;
        let reading = value.map(|text| self.reading_on_tier(&tier, text)).transpose()?;
        if start.is_some() || end.is_some() {
            let still = |micros| TableMoment::Time(RecordingInstant::from_micros(micros));
            let start = start.unwrap_or_else(|| still(row.start_us));
            let end = end.unwrap_or_else(|| still(row.end_us));
            let span = self.span_from_moments(row.tier_id, start, end)?;
            // Setting the same times must not move the neighbours.
            if span != row.annotation_row_span() {
                if !self.moved_with_others(row, &tier, span)? {
                    self.carry_out_edit(row.tier_id, &AskedTierChange::Move { annotation, span }, None)?;
                }
                self.deeds.note_moved_annotation(row.id);
            }
        }
        if let Some(value) = reading {
            let shown_value = value.reading_value().or(text).map_or("", str::trim);
            let says = if shown_value.is_empty() { "unset" } else { shown_value };
            self.deeds.note_annotation_value(&tier, row.id, says);
            self.carry_out_edit(row.tier_id, &AskedTierChange::SetValue { annotation, value }, None)?;
        }
        Ok(row.id)
    }

    /// Plans a change among its neighbours, writes the edits, and returns the first added annotation.
    fn carry_out_edit(
        &mut self,
        tier: i64,
        change: &AskedTierChange,
        confidence: Option<f64>,
    ) -> CorpusResult<Option<i64>> {
        let recording = self.scope_of(tier)?.recording.id;
        let scope = self
            .scopes
            .get(&recording)
            .ok_or_else(|| CorpusError::from_wrong_message("the recording is gone"))?;
        let near = scope.load_change_neighbourhood(self.connection, tier, change)?;
        let mut next = FIRST_FRESH_HANDLE;
        let mut fresh = || {
            next += 1;
            AnnotationId(next)
        };
        let edits = match plan_tier_change(&near.set, change, &mut fresh) {
            Ok(edits) => edits,
            Err(error) => {
                return Err(annotate_messages::refused_change_error(self.connection, tier, &error)?);
            }
        };
        let changed_ids: Vec<i64> = change
            .changed_annotations()
            .into_iter()
            .map(annotation_row_id)
            .collect();
        let named = match change {
            AskedTierChange::AddBelow { .. } => Vec::new(),
            _ => changed_ids,
        };
        let says = annotate_write::EditSource {
            origin: self.options.origin,
            detector: self.options.detector,
            confidence,
            named: &named,
        };
        let written = annotate_write::write_annotation_edits(self.connection, &edits, &near.rows, &says)?;
        self.report.added += written.added.len() as u64;
        self.report.changed += written.changed;
        self.report.removed += written.removed;
        if let Some(scope) = self.scopes.get_mut(&recording) {
            scope.extend_touched_span(written.touched);
        }
        Ok(written.added.first().copied())
    }

    /// Returns the reading of `text` on a tier.
    fn reading_on_tier(&mut self, tier: &TierRow, text: &str) -> CorpusResult<ComponentReading> {
        let inventory = self
            .scope_of(tier.id)?
            .inventories
            .iter()
            .find(|stored| Some(stored.id) == tier.inventory_id);
        read_tier_value(tier, inventory, text)
    }

    fn span_from_moments(&mut self, tier: i64, start: TableMoment, end: TableMoment) -> CorpusResult<TimeSpan> {
        let snap = self.options.snap;
        let scope = self.scope_of(tier)?;
        let (start, end) = (scope.resolve_moment(start, snap)?, scope.resolve_moment(end, snap)?);
        scope.check_bounds(start, end)?;
        Ok(TimeSpan::span_between(start, end))
    }

    fn scope_of(&mut self, tier: i64) -> CorpusResult<&AnnotationScope> {
        let recording = tier_rows::load_tier_row(self.connection, tier)?.recording_id;
        if !self.scopes.contains_key(&recording) {
            let scope = AnnotationScope::read_annotation_scope(self.connection, recording)?;
            self.scopes.insert(recording, scope);
        }
        self.scopes
            .get(&recording)
            .ok_or_else(|| CorpusError::from_wrong_message("the recording is gone"))
    }

    fn tier_row(&self, id: i64) -> CorpusResult<TierRow> {
        tier_rows::load_tier_row(self.connection, id)
    }
}

fn unsigned(id: i64) -> u64 {
    u64::try_from(id).unwrap_or_default()
}

fn annotation_handle(id: i64) -> AnnotationId {
    AnnotationId(unsigned(id))
}

fn annotation_row_id(id: AnnotationId) -> i64 {
    i64::try_from(id.0).unwrap_or_default()
}

fn is_symbolic(tier: &TierRow) -> bool {
    tier.stereotype.is_some_and(|stereotype| !stereotype.is_alignable())
}

/// Returns the reading of `text` on a tier with that inventory, as the inventory's own id if it has one.
fn read_tier_value(tier: &TierRow, inventory: Option<&StoredInventory>, text: &str) -> CorpusResult<ComponentReading> {
    let coded = inventory.is_some() || tier.role.is_coded();
    // In free text these words may be meant literally.
    if !coded || text.trim().is_empty() {
        return Ok(ComponentReading::from(text));
    }
    let text = text.trim();
    let known_value = inventory.and_then(|stored| stored.inventory.find_inventory_value(text));
    if let Some(value) = known_value {
        return Ok(ComponentReading::Value(value.id.clone()));
    }
    let lower = text.to_lowercase();
    let word = match tier.role {
        // Glosses are written in capitals, so only the small letters of these words are special.
        TierRole::Gloss => text,
        _ => &lower,
    };
    match (word, inventory) {
        ("unset", _) => Ok(ComponentReading::Unset),
        ("n/a" | "not applicable" | "not-applicable", _) => Ok(ComponentReading::NotApplicable),
        ("unclear" | "?", _) => Ok(ComponentReading::Unclear),
        (_, None) => Ok(ComponentReading::Value(text.to_owned())),
        (_, Some(stored)) => Err(not_in(stored, tier, text)),
    }
}

fn not_in(stored: &StoredInventory, tier: &TierRow, text: &str) -> CorpusError {
    let inventory = &stored.inventory;
    let near = inventory.suggest_value_ids(text);
    let hint = match near.as_slice() {
        [] => String::new(),
        [one] => format!("; did you mean {one:?}?"),
        several => format!("; did you mean one of {}?", several.join(", ")),
    };
    CorpusError::from_wrong_message(format!(
        "{text:?} is no value of the inventory {:?} of the tier {:?}{hint}",
        inventory.id, tier.name
    ))
    .with_advice(format!(
        "`chereme list CORPUS values --where 'inventory={}'` lists the values",
        inventory.id
    ))
}
