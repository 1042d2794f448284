//! Copies of tiers, and the order of tiers.

use chereme_sign::TierStereotype;
use chereme_sign::text::fold_text;
use rusqlite::Connection;

use super::annotate_names::{self, TierRequestName};
use super::annotate_tiers::check_name;
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_columns::{AnnotationOrigin, ValueState};
use crate::db::stored_tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// The annotations to copy with a tier.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum CopiedAnnotations {
    /// All of them.
    #[default]
    All,
    /// All of them, without values.
    Times,
    /// None.
    Nothing,
    /// Those whose value contains this text, ignoring case and accents; on tiers without gaps the others are copied
    /// without values.
    Holding(String),
}

impl Corpus {
    /// Copies a tier under another name, with the selected annotations; the copy has the same parent and comes after
    /// it. Tiers below it are not copied.
    ///
    /// # Errors
    /// Fails if the tier does not exist, or the recording has one of that name.
    pub fn copy_tier(
        &mut self,
        tier: &TierRequestName,
        name: &str,
        copied: &CopiedAnnotations,
    ) -> CorpusResult<TierRow> {
        self.store.run_store_operation(|connection| {
            let from = annotate_names::find_named_tier(connection, tier)?;
            let (row, count) = copy_tier_row(connection, &from, name, copied)?;
            let recording = crate::db::stored_recordings::load_recording_row(connection, from.recording_id)?.name;
            let effect = OperationEffect::CopyTier {
                tier: from.name,
                recording,
                copy: row.name.clone(),
                annotations: count,
            };
            Ok((row, effect))
        })
    }

    /// Sets the order of a recording's tiers, given by their rows; those that are not listed come after the others in
    /// their present order.
    ///
    /// # Errors
    /// Fails if the recording does not exist, or one of the rows is no tier of it.
    pub fn order_tiers(&mut self, recording: &RowName, order: &[i64]) -> CorpusResult<()> {
        self.store.run_store_operation(|connection| {
            let recording = address::find_recording_by_name(connection, recording)?;
            put_in_order(connection, recording.id, order)?;
            let recording = recording.name;
            Ok(((), OperationEffect::OrderTiers { recording }))
        })
    }
}

/// Copies a tier; returns the copy and how many annotations it has.
pub(super) fn copy_tier_row(
    connection: &Connection,
    from: &TierRow,
    name: &str,
    copied: &CopiedAnnotations,
) -> CorpusResult<(TierRow, u64)> {
    let row = TierRow {
        id: 0,
        name: name.trim().to_owned(),
        source: None,
        ..from.clone()
    };
    let all = rows::load_tier_rows(connection, from.recording_id)?;
    check_name(&all, &row)?;
    let id = rows::insert_tier(connection, &row)?;
    let annotations = rows::load_tier_annotation_rows(connection, from.id)?;
    let mut count = 0_u64;
    for annotation in annotations {
        if let Some(copy) = copy_annotation_row(annotation, &row, copied) {
            rows::insert_annotation(connection, &AnnotationRow { tier_id: id, ..copy })?;
            count += 1;
        }
    }
    let place = all
        .iter()
        .position(|row| row.id == from.id)
        .map_or(0, |index| index + 1);
    let mut order: Vec<i64> = all.iter().map(|row| row.id).collect();
    order.insert(place, id);
    put_in_order(connection, from.recording_id, &order)?;
    let inventories = inventories::load_of(connection, from.recording_id)?;
    tokens::update_recording_tokens(connection, from.recording_id, None, &inventories)?;
    Ok((rows::load_tier_row(connection, id)?, count))
}

/// Returns the copy of an annotation on a copied tier.
fn copy_annotation_row(row: AnnotationRow, tier: &TierRow, copied: &CopiedAnnotations) -> Option<AnnotationRow> {
    let without_gaps = matches!(
        tier.stereotype,
        Some(TierStereotype::TimeSubdivision | TierStereotype::SymbolicSubdivision)
    );
    let blank = match copied {
        CopiedAnnotations::All => false,
        CopiedAnnotations::Times => true,
        CopiedAnnotations::Nothing => return None,
        CopiedAnnotations::Holding(text) => {
            let holds = row.state == ValueState::Value && fold_text(&row.value).contains(&fold_text(text.trim()));
            if !holds && !without_gaps {
                return None;
            }
            !holds
        }
    };
    let row = AnnotationRow {
        id: 0,
        origin: AnnotationOrigin::Human,
        external_id: None,
        file_start_ms: None,
        file_end_ms: None,
        source: None,
        ..row
    };
    Some(if blank {
        AnnotationRow {
            state: ValueState::Unset,
            value: String::new(),
            confidence: None,
            ..row
        }
    } else {
        row
    })
}

fn put_in_order(connection: &Connection, recording: i64, order: &[i64]) -> CorpusResult<()> {
    let mut left = rows::load_tier_rows(connection, recording)?;
    let mut sorted = Vec::with_capacity(left.len());
    for id in order {
        let Some(at) = left.iter().position(|row| row.id == *id) else {
            return Err(CorpusError::from_wrong_message(format!(
                "the recording has no tier {id}, or it is named twice"
            ))
            .with_advice("name each tier of the recording once"));
        };
        sorted.push(left.remove(at));
    }
    for (position, row) in (0..).zip(sorted.into_iter().chain(left)) {
        if row.position != position {
            rows::update_tier(connection, &TierRow { position, ..row })?;
        }
    }
    Ok(())
}
