//! The position of a tier: its place among the tiers of its recording, and its parent.

use chereme_sign::Stereotype;
use chereme_sign::tier::{TierSet, check, check_tiers};
use rusqlite::Connection;

use super::names::{self, TierName};
use super::scope::{annotation, sign_tier};
use crate::address::Name;
use crate::db::edits;
use crate::db::tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{Error, Result};

/// Moves a tier to a place among those of its recording, counted from 0; later tiers move down.
pub(super) fn place(connection: &Connection, tier: &TierRow, place: u32) -> Result<()> {
    let mut all = rows::tiers(connection, tier.recording_id)?;
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
pub(super) fn hang(
    connection: &Connection,
    tier: &TierRow,
    parent: Option<&(String, Stereotype)>,
) -> Result<TierRow> {
    edits::defer_references(connection)?;
    let above = match parent {
        Some((name, stereotype)) => {
            let recording = Name::Number(tier.recording_id);
            let name = TierName::read(name, Some(&recording))?;
            Some((names::tier(connection, &name)?, *stereotype))
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
    let all = rows::tiers(connection, tier.recording_id)?;
    let with = |row: &TierRow| {
        let others = all.iter().filter(|other| other.id != row.id);
        others.chain([row]).map(sign_tier).collect::<Vec<_>>()
    };
    if let Some(violation) = check_tiers(&TierSet::new(with(&row), []))
        .into_iter()
        .next()
    {
        return Err(Error::wrong(violation.to_string())
            .at(tier.name.clone())
            .advise("hang it below another tier, or below none"));
    }
    let parents = match &above {
        Some((above, _)) => rows::annotations(connection, above.id)?,
        None => Vec::new(),
    };
    let own = rows::annotations(connection, tier.id)?;
    let moved = own
        .into_iter()
        .map(|it| below(it, above.is_some(), &parents, tier))
        .collect::<Result<Vec<_>>>()?;
    let annotations = parents.iter().chain(&moved).map(annotation);
    if let Some((above, stereotype)) = &above {
        let pair = [sign_tier(above), sign_tier(&row)].map(|mut it| {
            it.parent = it.parent.filter(|(id, _)| *id == sign_tier(above).id);
            it
        });
        let annotations = annotations.map(|mut it| {
            it.parent = it.parent.filter(|_| it.tier == pair[1].id);
            it
        });
        if let Some(violation) = check(&TierSet::new(pair.clone(), annotations))
            .into_iter()
            .next()
        {
            return Err(Error::wrong(format!(
                "its annotations cannot hang below {:?} as {stereotype}: {violation}",
                above.name
            ))
            .at(tier.name.clone())
            .advise("choose Included_In, or change those annotations first"));
        }
    }
    for row in &moved {
        rows::update_annotation(connection, row)?;
    }
    Ok(row)
}

/// Returns an annotation with the parent annotation that contains its time.
fn below(
    row: AnnotationRow,
    hangs: bool,
    parents: &[AnnotationRow],
    tier: &TierRow,
) -> Result<AnnotationRow> {
    if !hangs {
        return Ok(AnnotationRow {
            parent_id: None,
            position: 0,
            ..row
        });
    }
    let after = parents.partition_point(|parent| parent.start_us <= row.start_us);
    let above = parents[..after]
        .last()
        .filter(|parent| row.end_us <= parent.end_us);
    match above {
        Some(above) => Ok(AnnotationRow {
            parent_id: Some(above.id),
            ..row
        }),
        None => Err(Error::wrong(format!(
            "no annotation above holds the time from {} to {}",
            chereme_motion::Instant::from_micros(row.start_us),
            chereme_motion::Instant::from_micros(row.end_us)
        ))
        .at(tier.name.clone())
        .advise("every annotation of the tier must lie inside one of the tier above")),
    }
}
