//! The position of a tier: its place among the tiers of its recording, and its parent.

use chereme_sign::TierStereotype;
use chereme_sign::tier::{TierSet, check_tier_set, check_tiers};
use rusqlite::Connection;

use super::annotate_names::{self, TierRequestName};
use super::scope::{rule_annotation_from_row, sign_tier};
use crate::address::RowName;
use crate::db::edits;
use crate::db::stored_tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// Moves a tier to a place among those of its recording, counted from 0; later tiers move down.
pub(super) fn move_tier_to_place(connection: &Connection, tier: &TierRow, place: u32) -> CorpusResult<()> {
    let mut all = rows::load_tier_rows(connection, tier.recording_id)?;
    let Some(here) = all.iter().position(|row| row.id == tier.id) else {
        return Ok(());
    };
    let moved = all.remove(here);
    let place = usize::try_from(place).unwrap_or(usize::MAX).min(all.len());
    all.insert(place, moved);
    for (position, row) in (0..).zip(all) {
        if row.position != position {
            rows::update_tier(connection, &TierRow { position, ..row })?;
        }
    }
    Ok(())
}

/// Puts a tier with its annotations below another, or makes it a root tier; returns the tier's new row.
pub(super) fn hang_tier_below(
    connection: &Connection,
    tier: &TierRow,
    parent: Option<&(String, TierStereotype)>,
) -> CorpusResult<TierRow> {
    edits::defer_references(connection)?;
    let above = match parent {
        Some((name, stereotype)) => {
            let recording = RowName::Number(tier.recording_id);
            let name = TierRequestName::parse_tier_name(name, Some(&recording))?;
            Some((annotate_names::find_named_tier(connection, &name)?, *stereotype))
        }
        None => None,
    };
    let row = TierRow {
        parent_id: above.as_ref().map(|(above, _)| above.id),
        stereotype: above.as_ref().map(|(_, it)| *it),
        ..tier.clone()
    };
    if (&row.parent_id, &row.stereotype) == (&tier.parent_id, &tier.stereotype) {
        return Ok(row);
    }
    let all = rows::load_tier_rows(connection, tier.recording_id)?;
    let with = |row: &TierRow| {
        let others = all.iter().filter(|other| other.id != row.id);
        others.chain([row]).map(sign_tier).collect::<Vec<_>>()
    };
    if let Some(violation) = check_tiers(&TierSet::new(with(&row), [])).into_iter().next() {
        return Err(CorpusError::from_wrong_message(violation.to_string())
            .with_error_place(tier.name.clone())
            .with_advice("hang it below another tier, or below none"));
    }
    let parents = match &above {
        Some((above, _)) => rows::load_tier_annotation_rows(connection, above.id)?,
        None => Vec::new(),
    };
    let tier_annotations = rows::load_tier_annotation_rows(connection, tier.id)?;
    let moved = tier_annotations
        .into_iter()
        .map(|child| annotation_below_parent(child, above.is_some(), &parents, tier))
        .collect::<CorpusResult<Vec<_>>>()?;
    let annotations = parents.iter().chain(&moved).map(rule_annotation_from_row);
    if let Some((above, stereotype)) = &above {
        let pair = [sign_tier(above), sign_tier(&row)].map(|mut entry| {
            entry.parent = entry.parent.filter(|(id, _)| *id == sign_tier(above).id);
            entry
        });
        let annotations = annotations.map(|mut entry| {
            entry.parent = entry.parent.filter(|_| entry.tier == pair[1].id);
            entry
        });
        if let Some(violation) = check_tier_set(&TierSet::new(pair.clone(), annotations))
            .into_iter()
            .next()
        {
            return Err(CorpusError::from_wrong_message(format!(
                "its annotations cannot hang below {:?} as {stereotype}: {violation}",
                above.name
            ))
            .with_error_place(tier.name.clone())
            .with_advice("choose Included_In, or change those annotations first"));
        }
    }
    for row in &moved {
        rows::update_annotation(connection, row)?;
    }
    Ok(row)
}

/// Returns an annotation with the parent annotation that contains its time.
fn annotation_below_parent(
    row: AnnotationRow,
    hangs: bool,
    parents: &[AnnotationRow],
    tier: &TierRow,
) -> CorpusResult<AnnotationRow> {
    if !hangs {
        return Ok(AnnotationRow {
            parent_id: None,
            position: 0,
            ..row
        });
    }
    let after = parents.partition_point(|parent| parent.start_us <= row.start_us);
    let above = parents[..after].last().filter(|parent| row.end_us <= parent.end_us);
    match above {
        Some(above) => Ok(AnnotationRow {
            parent_id: Some(above.id),
            ..row
        }),
        None => Err(CorpusError::from_wrong_message(format!(
            "no annotation above holds the time from {} to {}",
            chereme_motion::RecordingInstant::from_micros(row.start_us),
            chereme_motion::RecordingInstant::from_micros(row.end_us)
        ))
        .with_error_place(tier.name.clone())
        .with_advice("every annotation of the tier must lie inside one of the tier above")),
    }
}
