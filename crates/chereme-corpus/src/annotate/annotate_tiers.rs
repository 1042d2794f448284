//! Adding, changing and removing tiers.

use chereme_formats::roles::AnnotatedHands;
use chereme_sign::text::{did_you_mean, nearest_candidate};
use chereme_sign::tier::{TierSet, check_tiers};
use chereme_sign::{TierRole, TierStereotype};
use rusqlite::Connection;
use serde::Serialize;

use super::annotate_names::{self, TierRequestName};
use super::arrange;
use super::is_symbolic;
use super::scope::sign_tier;
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::edits;
use crate::db::people;
use crate::db::stored_recordings;
use crate::db::stored_tiers::{self as rows, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories::{self, StoredInventory};
use crate::tokens;
use crate::words::effect::OperationEffect;
use crate::words::format_noun_count;

/// The source of a tier's values.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum TierValueSource {
    /// The first inventory of the corpus for the tier's component; any text for other tiers.
    #[default]
    Usual,
    /// Any text.
    Free,
    /// The inventory with this id.
    Inventory(String),
}

/// A tier to be added.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewTier {
    /// The recording.
    pub recording: RowName,
    /// The name, which no other tier of the recording may have.
    pub name: String,
    /// The subject of its annotations.
    pub role: TierRole,
    /// The hand or hands that they describe.
    pub hand: Option<AnnotatedHands>,
    /// The name of the parent tier, and the relation to it.
    pub parent: Option<(String, TierStereotype)>,
    /// The source of its values.
    pub values: TierValueSource,
    /// The person who is annotated.
    pub participant: Option<String>,
    /// The annotator.
    pub annotator: Option<String>,
    /// The language of its values.
    pub language: Option<String>,
}

impl NewTier {
    /// Returns a root tier with only a name and a role.
    #[must_use]
    pub fn new(recording: RowName, name: impl Into<String>, role: TierRole) -> Self {
        Self {
            recording,
            name: name.into(),
            role,
            hand: None,
            parent: None,
            values: TierValueSource::Usual,
            participant: None,
            annotator: None,
            language: None,
        }
    }
}

/// A change of a tier; a missing field stays as it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TierPropertyChange {
    /// Its name.
    pub name: Option<String>,
    /// The subject of its annotations.
    pub role: Option<TierRole>,
    /// The hand or hands that they describe, or none.
    pub hand: Option<Option<AnnotatedHands>>,
    /// The source of its values.
    pub values: Option<TierValueSource>,
    /// The name of the parent tier and the relation to it, or none; the annotations must lie inside those of the
    /// parent.
    pub parent: Option<Option<(String, TierStereotype)>>,
    /// Its place among the tiers of the recording, from 0; a number past the end means the end.
    pub place: Option<u32>,
    /// The person who is annotated, or nobody; a missing signer is added.
    pub participant: Option<Option<String>>,
    /// The annotator, or nobody.
    pub annotator: Option<Option<String>>,
    /// The language of its values, or none.
    pub language: Option<Option<String>>,
}

/// The rows that were removed together with a tier.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct RemovedTiers {
    /// The tier and those below it.
    pub tiers: Vec<String>,
    /// How many annotations they had.
    pub annotations: u64,
}

impl Corpus {
    /// Adds a tier to a recording, below its others.
    ///
    /// # Errors
    /// Fails if the name is taken, the parent tier or the inventory does not exist, or a tier with times of its own
    /// would be below one without.
    pub fn add_tier(&mut self, tier: &NewTier) -> CorpusResult<TierRow> {
        self.store.run_store_operation(|connection| {
            let (row, recording) = insert_new_tier(connection, tier)?;
            let tier = row.name.clone();
            Ok((row, OperationEffect::AddTier { tier, recording }))
        })
    }

    /// Changes the name, role, hand, inventory, parent, place, participant, annotator or language of a tier; tokens are
    /// derived again.
    ///
    /// A tier that gets another component loses its inventory unless one is given.
    ///
    /// # Errors
    /// Fails if the name is taken, the inventory does not exist or belongs to another component, the tier has values
    /// that the inventory lacks, or its annotations do not lie inside those of the parent tier.
    pub fn change_tier_properties(
        &mut self,
        tier: &TierRequestName,
        change: &TierPropertyChange,
    ) -> CorpusResult<TierRow> {
        self.store.run_store_operation(|connection| {
            let old = annotate_names::find_named_tier(connection, tier)?;
            let row = change_tier_row(connection, &old, change)?;
            let recording = stored_recordings::load_recording_row(connection, row.recording_id)?.name;
            let tier = row.name.clone();
            Ok((row, OperationEffect::ChangeTier { tier, recording }))
        })
    }

    /// Removes a tier, those below it, and their annotations; tokens are derived again.
    ///
    /// # Errors
    /// Fails if the tier does not exist.
    pub fn remove_tier(&mut self, tier: &TierRequestName) -> CorpusResult<RemovedTiers> {
        self.store.run_store_operation(|connection| {
            let tier = annotate_names::find_named_tier(connection, tier)?;
            let removed = remove_tier_row(connection, &tier)?;
            let recording = stored_recordings::load_recording_row(connection, tier.recording_id)?.name;
            let effect = OperationEffect::RemoveTier {
                tiers: removed.tiers.clone(),
                annotations: removed.annotations,
                recording,
            };
            Ok((removed, effect))
        })
    }
}

/// Gives a tier other properties; returns its new row.
pub(super) fn change_tier_row(
    connection: &Connection,
    old: &TierRow,
    change: &TierPropertyChange,
) -> CorpusResult<TierRow> {
    let inventories = inventories::load_all_inventories(connection)?;
    let mut row = changed_row(connection, old, change, &inventories)?;
    if let Some(parent) = &change.parent {
        row = arrange::hang_tier_below(connection, &row, parent.as_ref())?;
    }
    name_known_people(connection, &mut row)?;
    if row != *old {
        rows::update_tier(connection, &row)?;
        tokens::update_recording_tokens(connection, old.recording_id, None, &inventories)?;
    }
    if let Some(place) = change.place {
        arrange::move_tier_to_place(connection, &row, place)?;
        row = rows::load_tier_row(connection, row.id)?;
    }
    Ok(row)
}

/// Removes a tier, those below it, and their annotations.
pub(super) fn remove_tier_row(connection: &Connection, tier: &TierRow) -> CorpusResult<RemovedTiers> {
    edits::defer_references(connection)?;
    let all = rows::load_tier_rows(connection, tier.recording_id)?;
    let mut removed = RemovedTiers {
        tiers: Vec::new(),
        annotations: 0,
    };
    for row in tier_with_descendants(&all, tier).into_iter().rev() {
        removed.annotations += edits::delete_annotations(connection, row.id)? as u64;
        rows::delete_tier(connection, row.id)?;
        removed.tiers.insert(0, row.name.clone());
    }
    let inventories = inventories::load_of(connection, tier.recording_id)?;
    tokens::update_recording_tokens(connection, tier.recording_id, None, &inventories)?;
    Ok(removed)
}

/// Gives the participant and the annotator of a tier the names that the corpus uses, and adds those whom it does not know.
fn name_known_people(connection: &Connection, row: &mut TierRow) -> CorpusResult<()> {
    row.participant = people::known_person_name(connection, row.participant.as_deref())?;
    row.annotator = people::known_person_name(connection, row.annotator.as_deref())?;
    Ok(())
}

/// Returns a tier and all below it, parents first.
pub(super) fn tier_with_descendants<'t>(all: &'t [TierRow], tier: &'t TierRow) -> Vec<&'t TierRow> {
    let mut family_tiers = vec![tier];
    let mut index = 0;
    while index < family_tiers.len() {
        let above = family_tiers[index].id;
        family_tiers.extend(all.iter().filter(|row| row.parent_id == Some(above)));
        index += 1;
    }
    family_tiers
}

/// Adds a tier below the others of its recording; returns it and the name of the recording.
pub(super) fn insert_new_tier(connection: &Connection, tier: &NewTier) -> CorpusResult<(TierRow, String)> {
    let recording = address::find_recording_by_name(connection, &tier.recording)?;
    let mut row = new_row(connection, recording.id, tier)?;
    name_known_people(connection, &mut row)?;
    let id = rows::insert_tier(connection, &row)?;
    Ok((TierRow { id, ..row }, recording.name))
}

pub(super) fn new_row(connection: &Connection, recording: i64, tier: &NewTier) -> CorpusResult<TierRow> {
    let all = rows::load_tier_rows(connection, recording)?;
    let parent = match &tier.parent {
        Some((name, stereotype)) => {
            let recording = RowName::Number(recording);
            let name = TierRequestName::parse_tier_name(name, Some(&recording))?;
            Some((annotate_names::find_named_tier(connection, &name)?, *stereotype))
        }
        None => None,
    };
    let mut row = TierRow {
        recording_id: recording,
        name: tier.name.trim().to_owned(),
        position: all.iter().map(|row| row.position + 1).max().unwrap_or(0),
        parent_id: parent.as_ref().map(|(parent, _)| parent.id),
        stereotype: parent.as_ref().map(|(_, it)| *it),
        hand: tier.hand,
        participant: tier.participant.clone(),
        annotator: tier.annotator.clone(),
        language: tier.language.clone(),
        ..TierRow::default()
    };
    if let Some((parent, stereotype)) = &parent
        && stereotype.is_alignable()
        && is_symbolic(parent)
    {
        return Err(CorpusError::from_wrong_message(format!(
            "a {stereotype} has times of its own and cannot hang below the symbolic tier {:?}",
            parent.name
        ))
        .with_advice("make it Symbolic_Subdivision or Symbolic_Association"));
    }
    check_name(&all, &row)?;
    row.role.clone_from(&tier.role);
    let inventories = inventories::load_all_inventories(connection)?;
    row.inventory_id = find_tier_inventory(&inventories, &row, &tier.values)?.map(|stored| stored.id);
    let set = TierSet::new(all.iter().chain([&row]).map(sign_tier), []);
    match check_tiers(&set).into_iter().next() {
        Some(violation) => Err(CorpusError::from_wrong_message(violation.to_string())),
        None => Ok(row),
    }
}

fn changed_row(
    connection: &Connection,
    old: &TierRow,
    change: &TierPropertyChange,
    inventories: &[StoredInventory],
) -> CorpusResult<TierRow> {
    let mut row = old.clone();
    if let Some(name) = &change.name {
        name.trim().clone_into(&mut row.name);
        check_name(&rows::load_tier_rows(connection, old.recording_id)?, &row)?;
    }
    if let Some(hand) = change.hand {
        row.hand = hand;
    }
    for (field, change) in [
        (&mut row.participant, &change.participant),
        (&mut row.annotator, &change.annotator),
        (&mut row.language, &change.language),
    ] {
        if let Some(new) = change {
            let text = new.as_deref().map(str::trim);
            *field = text.filter(|text| !text.is_empty()).map(str::to_owned);
        }
    }
    if let Some(role) = &change.role {
        row.role.clone_from(role);
    }
    let other = row.role.role_component() != old.role.role_component();
    match &change.values {
        Some(values) => {
            let stored = find_tier_inventory(inventories, &row, values)?;
            if let Some(stored) = stored {
                check_values(connection, old, stored)?;
            }
            row.inventory_id = stored.map(|stored| stored.id);
        }
        None if other => row.inventory_id = None,
        None => {}
    }
    Ok(row)
}

pub(super) fn check_name(all: &[TierRow], row: &TierRow) -> CorpusResult<()> {
    if row.name.is_empty() {
        return Err(CorpusError::from_wrong_message("a tier needs a name"));
    }
    match all.iter().find(|other| other.name == row.name && other.id != row.id) {
        Some(_) => Err(
            CorpusError::from_wrong_message(format!("the recording has a tier {:?} already", row.name))
                .with_advice("give it another name"),
        ),
        None => Ok(()),
    }
}

fn find_tier_inventory<'i>(
    all: &'i [StoredInventory],
    row: &TierRow,
    values: &TierValueSource,
) -> CorpusResult<Option<&'i StoredInventory>> {
    let component = row.role.role_component();
    let fits = |stored: &&StoredInventory| {
        let stored_inventory = &stored.inventory;
        Some((stored_inventory.component, stored_inventory.feature.as_deref())) == component
    };
    let wanted = match values {
        TierValueSource::Free => return Ok(None),
        TierValueSource::Usual => return Ok(all.iter().find(fits)),
        TierValueSource::Inventory(wanted) => wanted,
    };
    let known_ids = all.iter().map(|stored| stored.inventory.id.as_str());
    let Some(stored) = all.iter().find(|stored| stored.inventory.id == *wanted) else {
        let hint = did_you_mean(nearest_candidate(wanted, known_ids));
        return Err(
            CorpusError::from_wrong_message(format!("there is no inventory {wanted:?}{hint}"))
                .with_error_place(wanted)
                .with_command_advice("`chereme list CORPUS inventories` lists them"),
        );
    };
    if component.is_some() && !fits(&stored) {
        let right: Vec<&str> = all
            .iter()
            .filter(fits)
            .map(|stored| stored.inventory.id.as_str())
            .collect();
        let remedy = match right.as_slice() {
            [] => "change the tier's role, or import an inventory for it".to_owned(),
            right => format!("for this tier there are: {}", right.join(", ")),
        };
        return Err(CorpusError::from_wrong_message(format!(
            "the inventory {wanted:?} is for {}, and the tier {:?} is not",
            stored.inventory.inventory_field(),
            row.name
        ))
        .with_advice(remedy));
    }
    Ok(Some(stored))
}

/// Fails if an inventory lacks values of the tier.
fn check_values(connection: &Connection, tier: &TierRow, stored: &StoredInventory) -> CorpusResult<()> {
    let mut missing = Vec::new();
    for (value, count) in edits::values_of_tier(connection, tier.id)? {
        if !value.trim().is_empty() && stored.inventory.find_inventory_value(value.trim()).is_none() {
            let near = stored.inventory.suggest_value_ids(&value);
            let hint = near.first().map_or(String::new(), |id| format!(", perhaps {id:?}"));
            missing.push(format!("{value:?} ({count} times{hint})"));
        }
    }
    if missing.is_empty() {
        return Ok(());
    }
    let shown = missing.iter().take(8).cloned().collect::<Vec<_>>().join(", ");
    Err(CorpusError::from_wrong_message(format!(
        "the tier {:?} says {} that the inventory {:?} does not have: {shown}",
        tier.name,
        format_noun_count(missing.len() as u64, "values"),
        stored.inventory.id
    ))
    .with_advice("change those annotations first, or leave the tier free"))
}
