//! Small edits of recordings, signers and signs; each is an operation.

use chereme_motion::BodySide;
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::edits;
use crate::db::lexicons;
use crate::db::signs::{self, TokenRow};
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_recordings::{self, RecordingRow, SignerRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::people::{self, PersonChange};
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
    pub origin: Option<RecordOrigin>,
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
    pub handedness: Option<Option<BodySide>>,
    /// Remarks, or none.
    pub notes: Option<Option<String>>,
}

impl From<SignerChange> for PersonChange {
    fn from(change: SignerChange) -> Self {
        Self {
            name: change.name,
            handedness: change.handedness,
            notes: change.notes,
            ..Self::default()
        }
    }
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
    pub fn change_recording(&mut self, recording: &RowName, change: &RecordingChange) -> CorpusResult<RecordingRow> {
        self.store.run_store_operation(|connection| {
            let old = address::find_recording_by_name(connection, recording)?;
            let mut row = old.clone();
            if let Some(name) = &change.name {
                row.name = require_trimmed_name(name, "recording")?;
                let other = stored_recordings::recording_named(connection, &row.name)?;
                // Keeping its own name is no conflict.
                if other.is_some_and(|other| other.id != row.id) {
                    return Err(taken("recording", &row.name));
                }
            }
            if let Some(signer) = &change.signer {
                row.signer_id = match signer {
                    Some(name) => {
                        let name = require_trimmed_name(name, "signer")?;
                        Some(stored_recordings::signer_named(connection, &name, None)?)
                    }
                    None => None,
                };
            }
            row.origin = change.origin.unwrap_or(row.origin);
            apply_optional_change(&mut row.licence, change.licence.as_ref());
            apply_optional_change(&mut row.notes, change.notes.as_ref());
            // An unchanged row must not become an entry of the history.
            if row != old {
                edits::update_recording(connection, &row)?;
            }
            // The hands of tokens depend on the dominant hand of the signer.
            if row.signer_id != old.signer_id {
                derive_edited_recordings(connection, &[row.id])?;
            }
            let effect = OperationEffect::ChangeRecording { recording: row.name };
            Ok((stored_recordings::load_recording_row(connection, row.id)?, effect))
        })
    }

    /// Changes a signer. Tokens of the signer's recordings are derived again for a new handedness, and tiers with the
    /// signer as participant or annotator get a new name.
    ///
    /// # Errors
    /// Fails if the signer does not exist, or the name is taken.
    pub fn change_signer(&mut self, signer: &RowName, change: &SignerChange) -> CorpusResult<SignerRow> {
        self.store.run_store_operation(|connection| {
            let old = address::find_signer_by_name(connection, signer)?;
            let row = people::change_person_row(connection, &old, &change.clone().into())?;
            let signer = row.name.clone();
            Ok((row, OperationEffect::ChangeSigner { signer }))
        })
    }

    /// Makes a token the citation form of its sign, and returns it.
    ///
    /// # Errors
    /// Fails if the address names no token.
    pub fn set_citation(&mut self, token: &CorpusAddress) -> CorpusResult<TokenRow> {
        self.store.run_store_operation(|connection| {
            let row = address::find_addressed_token(connection, token)?;
            edits::set_citation_token(connection, row.sign_id, row.id)?;
            let (token, gloss) = (row.id, row.gloss);
            let effect = OperationEffect::SetCitation { token, gloss };
            Ok((signs::load_token_row(connection, token)?, effect))
        })
    }

    /// Changes the gloss, notes or translations of a sign, and returns its gloss. `BANK#2` makes it the second entry with the
    /// gloss of another sign of its lexicon.
    ///
    /// # Errors
    /// Fails if the sign or a translation to remove does not exist, or the gloss is another sign's.
    pub fn change_sign(&mut self, sign: &RowName, change: &SignChange) -> CorpusResult<String> {
        self.store.run_store_operation(|connection| {
            let id = address::find_sign_by_name(connection, sign)?;
            let old = signs::sign_label(connection, id)?;
            let (_, mut notes) = edits::sign_gloss_and_notes(connection, id)?;
            let gloss = match &change.gloss {
                Some(gloss) => require_trimmed_name(gloss, "sign")?,
                None => old.clone(),
            };
            // Signs of different lexicons may share a gloss.
            let lexicon = lexicons::lexicon_of_sign(connection, id)?;
            let entry = match signs::split_entry_label(&gloss) {
                Some(entry) if signs::find_sign(connection, lexicon, entry.0)?.is_some() => entry,
                _ => (gloss.as_str(), 1),
            };
            if signs::find_entry(connection, lexicon, entry.0, Some(entry.1))?.is_some_and(|other| other != id) {
                return Err(taken("sign", &gloss));
            }
            apply_optional_change(&mut notes, change.notes.as_ref());
            edits::update_sign(connection, id, entry, notes.as_deref())?;
            let gloss = signs::sign_label(connection, id)?;
            let renamed = if gloss == old {
                0
            } else {
                edits::replace_gloss_values(connection, id, &old, &gloss)?
            };
            for (language, text) in &change.add_texts {
                signs::add_text(
                    connection,
                    id,
                    language.trim(),
                    &require_trimmed_name(text, "translation")?,
                )?;
            }
            for (language, text) in &change.remove_texts {
                if !edits::remove_text(connection, id, language.trim(), text.trim())? {
                    return Err(CorpusError::from_wrong_message(format!(
                        "{gloss} has no translation {text:?} in {language:?}"
                    ))
                    .with_error_place(gloss));
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

fn apply_optional_change<T: Clone>(value: &mut Option<T>, change: Option<&Option<T>>) {
    if let Some(new) = change {
        value.clone_from(new);
    }
}

fn derive_edited_recordings(connection: &Connection, recordings: &[i64]) -> CorpusResult<()> {
    for recording in recordings {
        let inventories = inventories::load_of(connection, *recording)?;
        tokens::update_recording_tokens(connection, *recording, None, &inventories)?;
    }
    Ok(())
}

fn require_trimmed_name(text: &str, what: &str) -> CorpusResult<String> {
    match text.trim() {
        "" => Err(CorpusError::from_wrong_message(format!("a {what} needs a name"))),
        text => Ok(text.to_owned()),
    }
}

fn taken(what: &str, name: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("there is another {what} called {name:?}"))
        .with_error_place(name)
        .with_advice("give it another name")
}
