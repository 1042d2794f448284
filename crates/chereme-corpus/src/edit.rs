//! Small edits of recordings, signers and signs; each is an operation.

use chereme_motion::Side;
use chereme_sign::Remedy;
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::columns::Origin;
use crate::db::edits;
use crate::db::recordings::{self, RecordingRow, SignerRow};
use crate::db::signs::{self, TokenRow};
use crate::error::{Error, Result};
use crate::inventories;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// A change of a recording; a missing field stays as it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecordingChange {
    /// Its name, which no other recording may have.
    pub name: Option<String>,
    /// The signer's name, or nobody; a missing signer is added.
    pub signer: Option<Option<String>>,
    /// Its origin.
    pub origin: Option<Origin>,
    /// The terms under which it may be used, or none.
    pub licence: Option<Option<String>>,
    /// Remarks, or none.
    pub notes: Option<Option<String>>,
}

/// A change of a signer; a missing field stays as it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignerChange {
    /// The name, which no other signer may have.
    pub name: Option<String>,
    /// The dominant hand, or nothing if it is unknown.
    pub handedness: Option<Option<Side>>,
    /// Remarks, or none.
    pub notes: Option<Option<String>>,
}

/// A change of a sign; a missing field stays as it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignChange {
    /// Its gloss, which no other sign may have; annotations with the old gloss are changed too.
    pub gloss: Option<String>,
    /// Remarks, or none.
    pub notes: Option<Option<String>>,
    /// Translations to add, as language and text.
    pub add_texts: Vec<(String, String)>,
    /// Translations to remove, as language and text.
    pub remove_texts: Vec<(String, String)>,
}

impl Corpus {
    /// Changes a recording; if the signer changes, tokens are derived again.
    ///
    /// # Errors
    /// Fails if the recording does not exist, or the name is taken.
    pub fn change_recording(
        &mut self,
        recording: &Name,
        change: &RecordingChange,
    ) -> Result<RecordingRow> {
        self.store.operation(|connection| {
            let old = address::recording(connection, recording)?;
            let mut row = old.clone();
            if let Some(name) = &change.name {
                row.name = named(name, "recording")?;
                let other = recordings::recording_named(connection, &row.name)?;
                if other.is_some_and(|other| other.id != row.id) {
                    return Err(taken("recording", &row.name));
                }
            }
            if let Some(signer) = &change.signer {
                row.signer_id = match signer {
                    Some(name) => {
                        let name = named(name, "signer")?;
                        Some(recordings::signer_named(connection, &name, None)?)
                    }
                    None => None,
                };
            }
            row.origin = change.origin.unwrap_or(row.origin);
            set(&mut row.licence, change.licence.as_ref());
            set(&mut row.notes, change.notes.as_ref());
            if row != old {
                edits::update_recording(connection, &row)?;
            }
            if row.signer_id != old.signer_id {
                derive(connection, &[row.id])?;
            }
            let effect = OperationEffect::ChangeRecording {
                recording: row.name,
            };
            Ok((recordings::recording(connection, row.id)?, effect))
        })
    }

    /// Changes a signer. Tokens of the signer's recordings are derived again for a new handedness, and tiers with the
    /// signer as participant get a new name.
    ///
    /// # Errors
    /// Fails if the signer does not exist, or the name is taken.
    pub fn change_signer(&mut self, signer: &Name, change: &SignerChange) -> Result<SignerRow> {
        self.store.operation(|connection| {
            let old = address::signer(connection, signer)?;
            let mut row = old.clone();
            if let Some(name) = &change.name {
                row.name = named(name, "signer")?;
                let other = recordings::find_signer(connection, &row.name)?;
                if other.is_some_and(|other| other.id != row.id) {
                    return Err(taken("signer", &row.name));
                }
            }
            let hand = change
                .handedness
                .map(|side| side.map(|side| side.name().to_owned()));
            set(&mut row.handedness, hand.as_ref());
            set(&mut row.notes, change.notes.as_ref());
            if row != old {
                edits::update_signer(connection, &row)?;
            }
            if row.name != old.name {
                edits::rename_participant(connection, &old.name, &row.name)?;
            }
            if row.handedness != old.handedness {
                derive(
                    connection,
                    &edits::recordings_of_signer(connection, row.id)?,
                )?;
            }
            let signer = row.name.clone();
            Ok((row, OperationEffect::ChangeSigner { signer }))
        })
    }

    /// Makes a token the citation form of its sign, and returns it.
    ///
    /// # Errors
    /// Fails if the address names no token.
    pub fn set_citation(&mut self, token: &Address) -> Result<TokenRow> {
        self.store.operation(|connection| {
            let row = address::token(connection, token)?;
            edits::cite(connection, row.sign_id, row.id)?;
            let (token, gloss) = (row.id, row.gloss);
            let effect = OperationEffect::SetCitation { token, gloss };
            Ok((signs::token(connection, token)?, effect))
        })
    }

    /// Changes the gloss, notes or translations of a sign, and returns its gloss.
    ///
    /// # Errors
    /// Fails if the sign or a translation to remove does not exist, or the gloss is another sign's.
    pub fn change_sign(&mut self, sign: &Name, change: &SignChange) -> Result<String> {
        self.store.operation(|connection| {
            let id = match sign {
                Name::Number(id) => sign_there(connection, *id)?,
                Name::Text(gloss) => address::sign(connection, gloss)?,
            };
            let (old, mut notes) = edits::sign(connection, id)?;
            let gloss = match &change.gloss {
                Some(gloss) => named(gloss, "sign")?,
                None => old.clone(),
            };
            if signs::find_sign(connection, &gloss)?.is_some_and(|other| other != id) {
                return Err(taken("sign", &gloss));
            }
            set(&mut notes, change.notes.as_ref());
            edits::update_sign(connection, id, &gloss, notes.as_deref())?;
            let renamed = if gloss == old {
                0
            } else {
                edits::regloss(connection, &old, &gloss)?
            };
            for (language, text) in &change.add_texts {
                signs::add_text(
                    connection,
                    id,
                    language.trim(),
                    &named(text, "translation")?,
                )?;
            }
            for (language, text) in &change.remove_texts {
                if !edits::remove_text(connection, id, language.trim(), text.trim())? {
                    return Err(Error::wrong(format!(
                        "{gloss} has no translation {text:?} in {language:?}"
                    ))
                    .at(gloss));
                }
            }
            let effect = OperationEffect::ChangeSign {
                sign: gloss.clone(),
                former: (renamed > 0).then_some(old),
                annotations: renamed as u64,
            };
            Ok((gloss, effect))
        })
    }
}

fn set<T: Clone>(value: &mut Option<T>, change: Option<&Option<T>>) {
    if let Some(new) = change {
        value.clone_from(new);
    }
}

fn derive(connection: &Connection, recordings: &[i64]) -> Result<()> {
    for recording in recordings {
        let inventories = inventories::load_of(connection, *recording)?;
        tokens::derive(connection, *recording, None, &inventories)?;
    }
    Ok(())
}

/// Returns the number of a sign if there is such a sign.
pub(crate) fn sign_there(connection: &Connection, id: i64) -> Result<i64> {
    match edits::sign(connection, id) {
        Ok(_) => Ok(id),
        Err(Error::Database(rusqlite::Error::QueryReturnedNoRows)) => {
            Err(Error::wrong(format!("there is no sign:{id}"))
                .at(format!("sign:{id}"))
                .advise(Remedy::command("`chereme list CORPUS signs` lists them")))
        }
        Err(other) => Err(other),
    }
}

fn named(text: &str, what: &str) -> Result<String> {
    match text.trim() {
        "" => Err(Error::wrong(format!("a {what} needs a name"))),
        text => Ok(text.to_owned()),
    }
}

fn taken(what: &str, name: &str) -> Error {
    Error::wrong(format!("there is another {what} called {name:?}"))
        .at(name)
        .advise("give it another name")
}
