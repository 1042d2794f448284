//! Copies of tiers, and the order of tiers.

use chereme_sign::Stereotype;
use chereme_sign::text::fold;
use rusqlite::Connection;

use super::names::{self, TierName};
use super::tiers::check_name;
use crate::Corpus;
use crate::address::{self, Name};
use crate::db::columns::{AnnotationOrigin, ValueState};
use crate::db::tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{Error, Result};
use crate::inventories;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// The annotations to copy with a tier.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Copied {
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
    pub fn copy_tier(&mut self, tier: &TierName, name: &str, copied: &Copied) -> Result<TierRow> {
        self.store.operation(|connection| {
            let from = names::tier(connection, tier)?;
            let row = TierRow {
                id: 0,
                name: name.trim().to_owned(),
                source: None,
                ..from.clone()
            };
            let all = rows::tiers(connection, from.recording_id)?;
            check_name(&all, &row)?;
            let id = rows::insert_tier(connection, &row)?;
            let annotations = rows::annotations(connection, from.id)?;
            let mut count = 0_u64;
            for annotation in annotations {
                if let Some(copy) = copy(annotation, &row, copied) {
                    rows::insert_annotation(
                        connection,
                        &AnnotationRow {
                            tier_id: id,
                            ..copy
                        },
                    )?;
                    count += 1;
                }
            }
            let place = all
                .iter()
                .position(|it| it.id == from.id)
                .map_or(0, |it| it + 1);
            let mut order: Vec<i64> = all.iter().map(|it| it.id).collect();
            order.insert(place, id);
            put_in_order(connection, from.recording_id, &order)?;
            let inventories = inventories::load_of(connection, from.recording_id)?;
            tokens::derive(connection, from.recording_id, None, &inventories)?;
            let recording = crate::db::recordings::recording(connection, from.recording_id)?.name;
            let effect = OperationEffect::CopyTier {
                tier: from.name,
                recording,
                copy: row.name,
                annotations: count,
            };
            Ok((rows::tier(connection, id)?, effect))
        })
    }

    /// Sets the order of a recording's tiers, given by their rows; those that are not listed come after the others in
    /// their present order.
    ///
    /// # Errors
    /// Fails if the recording does not exist, or one of the rows is no tier of it.
    pub fn order_tiers(&mut self, recording: &Name, order: &[i64]) -> Result<()> {
        self.store.operation(|connection| {
            let recording = address::recording(connection, recording)?;
            put_in_order(connection, recording.id, order)?;
            let recording = recording.name;
            Ok(((), OperationEffect::OrderTiers { recording }))
        })
    }
}

/// Returns the copy of an annotation on a copied tier.
fn copy(row: AnnotationRow, tier: &TierRow, copied: &Copied) -> Option<AnnotationRow> {
    let without_gaps = matches!(
        tier.stereotype,
        Some(Stereotype::TimeSubdivision | Stereotype::SymbolicSubdivision)
    );
    let blank = match copied {
        Copied::All => false,
        Copied::Times => true,
        Copied::Nothing => return None,
        Copied::Holding(text) => {
            let holds =
                row.state == ValueState::Value && fold(&row.value).contains(&fold(text.trim()));
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

fn put_in_order(connection: &Connection, recording: i64, order: &[i64]) -> Result<()> {
    let mut left = rows::tiers(connection, recording)?;
    let mut sorted = Vec::with_capacity(left.len());
    for id in order {
        let Some(at) = left.iter().position(|row| row.id == *id) else {
            return Err(Error::wrong(format!(
                "the recording has no tier {id}, or it is named twice"
            ))
            .advise("name each tier of the recording once"));
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
