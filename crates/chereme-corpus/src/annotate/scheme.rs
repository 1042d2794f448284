//! Whole sets of tiers for a recording, as a start for annotation.

use chereme_formats::roles::AnnotatedHands;
use chereme_sign::{HandRef, TierRole, TierStereotype};
use rusqlite::Connection;

use super::annotate_names::{self, TierRequestName};
use super::annotate_tiers::{NewTier, new_row, tier_with_descendants};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self as rows, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::words::effect::OperationEffect;

/// The set of tiers to add to a recording.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum TierScheme {
    /// Gloss and translation; below the gloss handshape, placement, movement with its direction, palm and
    /// finger direction of either hand, mouth, brows and head; a comment.
    #[default]
    Usual,
    /// The tiers of another recording.
    Like(RowName),
    /// Tiers for the components of the hand of a gloss tier, or of both hands if it has none: handshape, placement,
    /// movement with its direction, palm and finger direction, all below that tier.
    ///
    /// If a name is taken, that of the gloss tier is appended.
    Below(TierRequestName),
}

const BY_HAND: [(&str, &str); 6] = [
    ("Configuration", "configuration"),
    ("Placement", "placement"),
    ("Movement", "movement"),
    ("Movement direction", "movement.direction"),
    ("Palm direction", "orientation.palm"),
    ("Finger direction", "orientation.fingers"),
];

const OF_NO_HAND: [(&str, &str); 3] = [
    ("Mouth", "nonmanual.mouth"),
    ("Brows", "nonmanual.brows"),
    ("Head", "nonmanual.head"),
];

impl Corpus {
    /// Adds the tiers of a scheme that a recording lacks, without annotations, and returns them.
    ///
    /// A tier is lacking if no tier of the recording has its name. If it is not copied from another recording, it is
    /// lacking only if no tier has its role and hands either.
    ///
    /// # Errors
    /// Fails if a recording does not exist, if the model recording has no tiers, if all tiers exist already, or if a
    /// tier cannot be below its parent.
    pub fn add_tiers(&mut self, recording: &RowName, scheme: &TierScheme) -> CorpusResult<Vec<TierRow>> {
        self.store.run_store_operation(|connection| {
            let recording = address::find_recording_by_name(connection, recording)?;
            let added = add_lacking_tiers(connection, &recording, scheme)?;
            if added.is_empty() {
                return Err(CorpusError::from_wrong_message(format!(
                    "the recording {:?} has all of these tiers already",
                    recording.name
                ))
                .with_advice("add single tiers, or copy those of another recording"));
            }
            let (count, recording) = (added.len() as u64, recording.name);
            Ok((added, OperationEffect::AddTiers { count, recording }))
        })
    }
}

/// Adds the tiers of a scheme that a recording lacks, and returns them.
pub(super) fn add_lacking_tiers(
    connection: &Connection,
    recording: &RecordingRow,
    scheme: &TierScheme,
) -> CorpusResult<Vec<TierRow>> {
    let wanted = match scheme {
        TierScheme::Usual => plan_default_tiers(connection, recording)?,
        TierScheme::Like(other) => plan_tiers_like(
            connection,
            &address::find_recording_by_name(connection, other)?,
            recording,
        )?,
        TierScheme::Below(tier) => {
            plan_component_tiers(connection, &annotate_names::find_named_tier(connection, tier)?)?
        }
    };
    let below = matches!(scheme, TierScheme::Below(_));
    add_planned_tiers(connection, recording, wanted, below)
}

/// A tier to be added, and the row of the tier that it copies, if there is one.
type PlannedTier = (NewTier, Option<TierRow>);

fn add_planned_tiers(
    connection: &Connection,
    recording: &RecordingRow,
    wanted: Vec<PlannedTier>,
    below: bool,
) -> CorpusResult<Vec<TierRow>> {
    let mut added = Vec::new();
    let before = rows::load_tier_rows(connection, recording.id)?;
    // Copied tiers come after those that are there.
    let free = before.iter().map(|row| row.position + 1).max().unwrap_or(0);
    for (tier, like) in wanted {
        // A tier that was just added may be the parent of the next one.
        let there = rows::load_tier_rows(connection, recording.id)?;
        if there.iter().any(|row| row.name == tier.name) {
            continue;
        }
        let mut row = new_row(connection, recording.id, &tier)?;
        // Tiers below one gloss tier may have the same roles as those below another.
        let same =
            |other: &TierRow| other.tier_topic() == row.tier_topic() && (!below || other.parent_id == row.parent_id);
        if like.is_none() && there.iter().any(same) {
            continue;
        }
        if let Some(like) = like {
            row.position = free + like.position;
            row.role = like.role;
            row.hand = like.hand;
            row.inventory_id = like.inventory_id;
        }
        row.id = rows::insert_tier(connection, &row)?;
        added.push(row);
    }
    Ok(added)
}

fn plan_default_tiers(connection: &Connection, recording: &RecordingRow) -> CorpusResult<Vec<PlannedTier>> {
    let participant = recording_signer_name(connection, recording)?;
    let there = rows::load_tier_rows(connection, recording.id)?;
    // Components belong below the glosses that are there, whatever their tier is called.
    let gloss_row = there.into_iter().find(TierRow::holds_glosses);
    let gloss = gloss_row.map_or_else(|| "Gloss".to_owned(), |row| row.name);
    let make = |name: String, role, hand, parent: Option<TierStereotype>| {
        let tier = NewTier {
            hand,
            parent: parent.map(|stereotype| (gloss.clone(), stereotype)),
            participant: participant.clone(),
            ..NewTier::new(RowName::Number(recording.id), name, role)
        };
        (tier, None)
    };
    let role_of = |field: &str| {
        field
            .parse::<TierRole>()
            .map_err(|error| CorpusError::from_wrong_message(error.to_string()))
    };
    let mut all = vec![make(gloss.clone(), TierRole::Gloss, None, None)];
    let association = Some(TierStereotype::SymbolicAssociation);
    all.push(make("Translation".to_owned(), TierRole::Translation, None, association));
    let within = Some(TierStereotype::IncludedIn);
    for hand in [HandRef::Right, HandRef::Left] {
        let letters = hand_tier_suffix(hand);
        for (name, field) in BY_HAND {
            let hand = Some(AnnotatedHands::One(hand));
            all.push(make(format!("{name} {letters}"), role_of(field)?, hand, within));
        }
    }
    for (name, field) in OF_NO_HAND {
        all.push(make(name.to_owned(), role_of(field)?, None, within));
    }
    all.push(make("Comment".to_owned(), TierRole::Comment, None, None));
    Ok(all)
}

fn plan_component_tiers(connection: &Connection, gloss: &TierRow) -> CorpusResult<Vec<PlannedTier>> {
    if gloss.role != TierRole::Gloss {
        let wrong = format!("the tier {:?} holds no glosses", gloss.name);
        return Err(CorpusError::from_wrong_message(wrong).with_advice("name a gloss tier"));
    }
    let there = rows::load_tier_rows(connection, gloss.recording_id)?;
    let hands = match gloss.hand {
        Some(AnnotatedHands::One(hand)) => vec![hand],
        _ => vec![HandRef::Right, HandRef::Left],
    };
    let mut all = Vec::new();
    for hand in hands {
        for (name, field) in BY_HAND {
            let role: TierRole = field
                .parse()
                .map_err(|error| CorpusError::from_wrong_message(format!("{error}")))?;
            let mut name = format!("{name} {}", hand_tier_suffix(hand));
            // An existing child of that name is not created again.
            let taken = |other: &TierRow| other.name == name && other.parent_id != Some(gloss.id);
            if there.iter().any(taken) {
                name = format!("{name} ({})", gloss.name);
            }
            let tier = NewTier {
                hand: Some(AnnotatedHands::One(hand)),
                parent: Some((gloss.name.clone(), TierStereotype::IncludedIn)),
                participant: gloss.participant.clone(),
                ..NewTier::new(RowName::Number(gloss.recording_id), name, role)
            };
            all.push((tier, None));
        }
    }
    Ok(all)
}

/// Returns the suffix of the names of a hand's tiers.
fn hand_tier_suffix(hand: HandRef) -> &'static str {
    match hand {
        HandRef::Right => "RH",
        HandRef::Left => "LH",
        HandRef::Dominant => "DH",
        HandRef::Weak => "WH",
    }
}

fn plan_tiers_like(
    connection: &Connection,
    other: &RecordingRow,
    recording: &RecordingRow,
) -> CorpusResult<Vec<PlannedTier>> {
    let tiers = rows::load_tier_rows(connection, other.id)?;
    if tiers.is_empty() {
        let wrong = format!("the recording {:?} has no tiers to copy", other.name);
        return Err(CorpusError::from_wrong_message(wrong).with_advice("name another, or take the usual tiers"));
    }
    let (from, to) = (
        recording_signer_name(connection, other)?,
        recording_signer_name(connection, recording)?,
    );
    let roots = tiers.iter().filter(|row| row.parent_id.is_none());
    // A tier can be added only after its parent.
    let parents_first = roots.flat_map(|row| tier_with_descendants(&tiers, row));
    let wanted = parents_first.map(|row| {
        let above = tiers.iter().find(|candidate| Some(candidate.id) == row.parent_id);
        let tier = NewTier {
            parent: above.map(|parent| parent.name.clone()).zip(row.stereotype),
            // The signer of the other recording is replaced by that of this one.
            participant: if row.participant == from {
                to.clone()
            } else {
                row.participant.clone()
            },
            language: row.language.clone(),
            ..NewTier::new(RowName::Number(recording.id), row.name.clone(), row.role.clone())
        };
        (tier, Some(row.clone()))
    });
    Ok(wanted.collect())
}

fn recording_signer_name(connection: &Connection, recording: &RecordingRow) -> CorpusResult<Option<String>> {
    let Some(id) = recording.signer_id else {
        return Ok(None);
    };
    Ok(stored_recordings::find_signer_row(connection, id)?.map(|signer| signer.name))
}
