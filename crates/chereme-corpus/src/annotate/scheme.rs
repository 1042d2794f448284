//! Whole sets of tiers for a recording, as a start for annotation.

use chereme_formats::roles::Hands;
use chereme_sign::{HandRef, Stereotype, TierRole};
use rusqlite::Connection;

use super::names::{self, TierName};
use super::tiers::{NewTier, family, new_row};
use crate::Corpus;
use crate::address::{self, Name};
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers::{self as rows, TierRow};
use crate::error::{Error, Result};
use crate::words::effect::OperationEffect;

/// The set of tiers to add to a recording.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Scheme {
    /// Gloss and translation; below the gloss handshape, placement, movement with its direction, palm and
    /// finger direction of either hand, mouth, brows and head; a comment.
    #[default]
    Usual,
    /// The tiers of another recording.
    Like(Name),
    /// Tiers for the components of the hand of a gloss tier, or of both hands if it has none: handshape, placement,
    /// movement with its direction, palm and finger direction, all below that tier.
    ///
    /// If a name is taken, that of the gloss tier is appended.
    Below(TierName),
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
    pub fn add_tiers(&mut self, recording: &Name, scheme: &Scheme) -> Result<Vec<TierRow>> {
        self.store.operation(|connection| {
            let recording = address::recording(connection, recording)?;
            let wanted = match scheme {
                Scheme::Usual => usual(connection, &recording)?,
                Scheme::Like(other) => like(
                    connection,
                    &address::recording(connection, other)?,
                    &recording,
                )?,
                Scheme::Below(tier) => below(connection, &names::tier(connection, tier)?)?,
            };
            let below = matches!(scheme, Scheme::Below(_));
            let added = add(connection, &recording, wanted, below)?;
            let (count, recording) = (added.len() as u64, recording.name);
            Ok((added, OperationEffect::AddTiers { count, recording }))
        })
    }
}

/// A tier to be added, and the row of the tier that it copies, if there is one.
type Wanted = (NewTier, Option<TierRow>);

fn add(
    connection: &Connection,
    recording: &RecordingRow,
    wanted: Vec<Wanted>,
    below: bool,
) -> Result<Vec<TierRow>> {
    let mut added = Vec::new();
    let before = rows::tiers(connection, recording.id)?;
    let free = before.iter().map(|row| row.position + 1).max().unwrap_or(0);
    for (tier, like) in wanted {
        let there = rows::tiers(connection, recording.id)?;
        if there.iter().any(|row| row.name == tier.name) {
            continue;
        }
        let mut row = new_row(connection, recording.id, &tier)?;
        // Tiers below one gloss tier may have the same roles as those below another.
        let same =
            |it: &TierRow| it.topic() == row.topic() && (!below || it.parent_id == row.parent_id);
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
    if added.is_empty() {
        return Err(Error::wrong(format!(
            "the recording {:?} has all of these tiers already",
            recording.name
        ))
        .advise("add single tiers, or copy those of another recording"));
    }
    Ok(added)
}

fn usual(connection: &Connection, recording: &RecordingRow) -> Result<Vec<Wanted>> {
    let participant = signer(connection, recording)?;
    let there = rows::tiers(connection, recording.id)?;
    let gloss = there.into_iter().find(|row| row.role == TierRole::Gloss);
    let gloss = gloss.map_or_else(|| "Gloss".to_owned(), |row| row.name);
    let make = |name: String, role, hand, parent: Option<Stereotype>| {
        let tier = NewTier {
            hand,
            parent: parent.map(|it| (gloss.clone(), it)),
            participant: participant.clone(),
            ..NewTier::new(Name::Number(recording.id), name, role)
        };
        (tier, None)
    };
    let role_of = |field: &str| {
        field
            .parse::<TierRole>()
            .map_err(|error| Error::wrong(error.to_string()))
    };
    let mut all = vec![make(gloss.clone(), TierRole::Gloss, None, None)];
    let whole = Some(Stereotype::SymbolicAssociation);
    all.push(make(
        "Translation".to_owned(),
        TierRole::Translation,
        None,
        whole,
    ));
    let within = Some(Stereotype::IncludedIn);
    for hand in [HandRef::Right, HandRef::Left] {
        let letters = letters(hand);
        for (name, field) in BY_HAND {
            let hand = Some(Hands::One(hand));
            all.push(make(
                format!("{name} {letters}"),
                role_of(field)?,
                hand,
                within,
            ));
        }
    }
    for (name, field) in OF_NO_HAND {
        all.push(make(name.to_owned(), role_of(field)?, None, within));
    }
    all.push(make("Comment".to_owned(), TierRole::Comment, None, None));
    Ok(all)
}

fn below(connection: &Connection, gloss: &TierRow) -> Result<Vec<Wanted>> {
    if gloss.role != TierRole::Gloss {
        let wrong = format!("the tier {:?} holds no glosses", gloss.name);
        return Err(Error::wrong(wrong).advise("name a gloss tier"));
    }
    let there = rows::tiers(connection, gloss.recording_id)?;
    let hands = match gloss.hand {
        Some(Hands::One(hand)) => vec![hand],
        _ => vec![HandRef::Right, HandRef::Left],
    };
    let mut all = Vec::new();
    for hand in hands {
        for (name, field) in BY_HAND {
            let role: TierRole = field
                .parse()
                .map_err(|error| Error::wrong(format!("{error}")))?;
            let mut name = format!("{name} {}", letters(hand));
            // An existing child of that name is not created again.
            let taken = |it: &TierRow| it.name == name && it.parent_id != Some(gloss.id);
            if there.iter().any(taken) {
                name = format!("{name} ({})", gloss.name);
            }
            let tier = NewTier {
                hand: Some(Hands::One(hand)),
                parent: Some((gloss.name.clone(), Stereotype::IncludedIn)),
                participant: gloss.participant.clone(),
                ..NewTier::new(Name::Number(gloss.recording_id), name, role)
            };
            all.push((tier, None));
        }
    }
    Ok(all)
}

/// Returns the suffix of the names of a hand's tiers.
fn letters(hand: HandRef) -> &'static str {
    match hand {
        HandRef::Right => "RH",
        HandRef::Left => "LH",
        HandRef::Dominant => "DH",
        HandRef::Weak => "WH",
    }
}

fn like(
    connection: &Connection,
    other: &RecordingRow,
    recording: &RecordingRow,
) -> Result<Vec<Wanted>> {
    let tiers = rows::tiers(connection, other.id)?;
    if tiers.is_empty() {
        let wrong = format!("the recording {:?} has no tiers to copy", other.name);
        return Err(Error::wrong(wrong).advise("name another, or take the usual tiers"));
    }
    let (from, to) = (signer(connection, other)?, signer(connection, recording)?);
    let roots = tiers.iter().filter(|row| row.parent_id.is_none());
    let parents_first = roots.flat_map(|row| family(&tiers, row));
    let wanted = parents_first.map(|row| {
        let above = tiers.iter().find(|it| Some(it.id) == row.parent_id);
        let tier = NewTier {
            parent: above.map(|it| it.name.clone()).zip(row.stereotype),
            participant: if row.participant == from {
                to.clone()
            } else {
                row.participant.clone()
            },
            language: row.language.clone(),
            ..NewTier::new(
                Name::Number(recording.id),
                row.name.clone(),
                row.role.clone(),
            )
        };
        (tier, Some(row.clone()))
    });
    Ok(wanted.collect())
}

fn signer(connection: &Connection, recording: &RecordingRow) -> Result<Option<String>> {
    let Some(id) = recording.signer_id else {
        return Ok(None);
    };
    Ok(recordings::signer(connection, id)?.map(|signer| signer.name))
}
