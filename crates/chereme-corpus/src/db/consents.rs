//! The consent of signers, as rows.

use std::fmt;
use std::str::FromStr;

use rusqlite::{Connection, params};
use serde::{Deserialize, Serialize};

use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

/// The people who may see something, from the fewest to the most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ConsentAudience {
    /// Nobody beyond those who keep the corpus.
    Nobody,
    /// People who do research with the corpus.
    Research,
    /// Everybody.
    Public,
}

impl ConsentAudience {
    /// All of them, from the most people to the fewest.
    pub const ALL_AUDIENCES: [Self; 3] = [Self::Public, Self::Research, Self::Nobody];

    /// Returns its name, such as `public`.
    #[must_use]
    pub fn audience_name(self) -> &'static str {
        match self {
            Self::Public => "public",
            Self::Research => "research",
            Self::Nobody => "nobody",
        }
    }
}

impl fmt::Display for ConsentAudience {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.audience_name())
    }
}

impl FromStr for ConsentAudience {
    type Err = CorpusError;

    fn from_str(text: &str) -> CorpusResult<Self> {
        let named_audience = Self::ALL_AUDIENCES
            .into_iter()
            .find(|audience| audience.audience_name() == text.trim());
        named_audience.ok_or_else(|| {
            CorpusError::from_wrong_message(format!("{text:?} is no audience"))
                .with_error_place(text)
                .with_advice("write public, research or nobody")
        })
    }
}

/// The consent of a signer, or the one that belongs to a recording.
pub(crate) struct ConsentColumn {
    pub(crate) id: i64,
    pub(crate) name: String,
    /// The consent as JSON.
    pub(crate) consent: Option<String>,
}

/// Returns the consent of every signer, by name.
pub(crate) fn of_signers(connection: &Connection) -> CorpusResult<Vec<ConsentColumn>> {
    read_consent_columns(connection, "SELECT id, name, consent FROM signer ORDER BY name")
}

/// Returns the consent that belongs to each recording, by name.
pub(crate) fn of_recordings(connection: &Connection) -> CorpusResult<Vec<ConsentColumn>> {
    read_consent_columns(connection, "SELECT id, name, consent FROM recording ORDER BY name")
}

fn read_consent_columns(connection: &Connection, sql: &str) -> CorpusResult<Vec<ConsentColumn>> {
    connection.read_rows(sql, [], |row| {
        Ok(ConsentColumn {
            id: row.get(0)?,
            name: row.get(1)?,
            consent: row.get(2)?,
        })
    })
}

/// Stores the consent of a signer.
pub(crate) fn set_of_signer(connection: &Connection, id: i64, consent: Option<&str>) -> CorpusResult<()> {
    connection.change_rows("UPDATE signer SET consent = ?2 WHERE id = ?1", params![id, consent])
}

/// Stores the consent that belongs to a recording.
pub(crate) fn set_of_recording(connection: &Connection, id: i64, consent: Option<&str>) -> CorpusResult<()> {
    connection.change_rows("UPDATE recording SET consent = ?2 WHERE id = ?1", params![id, consent])
}

/// Returns the participants that the tiers of recordings name: recording and name.
pub(crate) fn list_tier_participants(connection: &Connection) -> CorpusResult<Vec<(i64, String)>> {
    // Annotation files pad participants with blanks or leave them empty; neither names another person.
    let sql = "SELECT DISTINCT recording_id, trim(participant) FROM tier
         WHERE trim(coalesce(participant, '')) <> '' ORDER BY 1, 2";
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Returns the inputs of recipes: the generated recording, and the recording that it takes movement from; without one
/// if the input is an entry of a table, the body at the address `own`, or was deleted. The last is whether that is known:
/// a token or `own` stands for the input, or the recipe has none.
pub(crate) fn list_recipe_movement_inputs(
    connection: &Connection,
    own: &str,
) -> CorpusResult<Vec<(i64, Option<i64>, bool)>> {
    // The left join keeps the recipe without any input: it takes nobody's movement, which is known.
    let sql = "SELECT p.recording_id, i.recording_id,
             i.id IS NULL OR i.token_id IS NOT NULL OR i.address = ?1
         FROM recipe p LEFT JOIN recipe_input i ON p.id = i.recipe_id ORDER BY p.recording_id, i.id";
    connection.read_rows(sql, [own], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))
}

/// Returns the generated recordings whose recipes do not name the body that moves: they have no input, or a notation
/// that was stored without its body, as earlier versions of the program did.
pub(crate) fn without_body(connection: &Connection) -> CorpusResult<Vec<i64>> {
    // An input with a token and a hash is a notation; only its material in the document can name the body.
    let sql = "SELECT DISTINCT p.recording_id FROM recipe p
         LEFT JOIN recipe_input i ON i.recipe_id = p.id
         WHERE i.id IS NULL OR (i.recording_id IS NULL AND i.token_id IS NOT NULL
             AND i.hash <> '' AND NOT EXISTS (
             SELECT 1 FROM json_each(p.document, '$.inputs') it
             WHERE it.value ->> '$.material.address' = i.address
                 AND it.value ->> '$.material.body' IS NOT NULL))
         ORDER BY p.recording_id";
    connection.read_rows(sql, [], |row| row.get(0))
}

/// Returns the generated recordings whose documents name tokens that gave a posture or a place, where the inputs of
/// the recipe do not name them, as earlier versions of the program did: the generated recording, and that of the token if it
/// is still there.
pub(crate) fn unnamed_givers(connection: &Connection) -> CorpusResult<Vec<(i64, Option<i64>)>> {
    // Postures and places are kept as addresses deep in the JSON; 7 is the place after the letters `token:`.
    let sql = "SELECT DISTINCT p.recording_id, t.recording_id FROM recipe p, json_tree(p.document, '$.inputs') it
         LEFT JOIN token t ON t.id = CAST(substr(it.atom, 7) AS INTEGER)
         WHERE it.type = 'text' AND it.atom LIKE 'token:%'
             AND it.key IN ('named', 'same-signer', 'other-signer', 'sign', 'from')
             AND (t.id IS NULL OR t.recording_id IS NOT NULL)
             AND NOT EXISTS (SELECT 1 FROM recipe_input i WHERE i.recipe_id = p.id AND i.hash = '')
         ORDER BY 1, 2";
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// The blocks of both arms of a recording's body that begin at a frame.
pub(crate) struct ArmBlocks {
    pub(crate) recording: i64,
    pub(crate) first_frame: i64,
    pub(crate) hashes: Vec<Vec<u8>>,
}

/// Returns the blocks of both arms, by track and frame.
pub(crate) fn list_arm_blocks(connection: &Connection) -> CorpusResult<Vec<ArmBlocks>> {
    let sql = "SELECT t.recording_id, r.first_frame, r.hash, l.hash FROM track_block r
         JOIN track_block l ON l.track_id = r.track_id AND l.channel_group = 'left-arm' AND l.first_frame = r.first_frame
         JOIN track t ON t.id = r.track_id
         WHERE r.channel_group = 'right-arm' ORDER BY r.track_id, r.first_frame";
    connection.read_rows(sql, [], |row| {
        Ok(ArmBlocks {
            recording: row.get(0)?,
            first_frame: row.get(1)?,
            hashes: vec![row.get(2)?, row.get(3)?],
        })
    })
}
