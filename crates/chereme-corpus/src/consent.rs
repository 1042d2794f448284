//! The consent of signers: who may see their movement, its annotation, and signs made from it.

mod consent_gate;
mod kept_movement;
mod output_gate;
mod unnamed;

use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use crate::address::{self, CorpusAddress};
pub use crate::db::consents::ConsentAudience;
use crate::db::{consents, edits, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::words::effect::OperationEffect;
use crate::{Corpus, RecordOrigin};
pub use consent_gate::WithheldReason;
pub(crate) use consent_gate::{PublishPermissions, TERMS_NOT_STATED, withheld_remedy};
pub(crate) use kept_movement::find_movement_pieces;
pub use output_gate::{OutputAudience, WithheldOutput};
pub(crate) use output_gate::{OutputGate, nothing_passes_error};

/// The subject of a consent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ConsentKind {
    /// The recorded movement. It shows who signs, even without a face.
    Movement,
    /// Its annotation: glosses, translations and component values.
    Annotation,
    /// Signs made from the movement.
    Derived,
}

impl ConsentKind {
    /// All of them.
    pub const ALL_CONSENT_KINDS: [Self; 3] = [Self::Movement, Self::Annotation, Self::Derived];
}

/// The consent of a person. A missing entry is unknown, which differs from a refusal but is not published either.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PersonConsent {
    /// Who may see the recorded movement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub movement: Option<ConsentAudience>,
    /// Who may see what annotators wrote about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub annotation: Option<ConsentAudience>,
    /// Who may see signs made from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derived: Option<ConsentAudience>,
    /// The day of the agreement, as `2026-11-27`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub day: Option<String>,
    /// What was signed: the version of a form, its language.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<String>,
}

impl PersonConsent {
    /// Returns who may see something; `None` if it is unknown.
    #[must_use]
    pub fn audience_of_kind(&self, kind: ConsentKind) -> Option<ConsentAudience> {
        match kind {
            ConsentKind::Movement => self.movement,
            ConsentKind::Annotation => self.annotation,
            ConsentKind::Derived => self.derived,
        }
    }

    fn parse_consent_json(json: Option<&str>, place: &str) -> CorpusResult<Self> {
        let Some(json) = json else {
            return Ok(Self::default());
        };
        serde_json::from_str(json).map_err(|error| CorpusError::Damaged {
            place: format!("the consent of {place}"),
            reason: error.to_string(),
        })
    }

    fn to_consent_json(&self) -> Option<String> {
        // Words and texts only.
        let json = serde_json::to_string(self).unwrap_or_default();
        // A consent that says nothing is the same as none, and is stored as such.
        (*self != Self::default()).then_some(json)
    }
}

/// A change of consents; a missing field stays as it is, and `Some(None)` makes it unknown.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ConsentChange {
    /// Who may see the recorded movement.
    pub movement: Option<Option<ConsentAudience>>,
    /// Who may see what annotators wrote about it.
    pub annotation: Option<Option<ConsentAudience>>,
    /// Who may see signs made from it.
    pub derived: Option<Option<ConsentAudience>>,
    /// The day of the agreement.
    pub day: Option<Option<String>>,
    /// What was signed.
    pub form: Option<Option<String>>,
    /// The terms of the named recordings, and of the signers' recordings, that have none.
    pub licence: Option<String>,
}

/// The consent of a signer, or the one that belongs to a recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ConsentRow {
    /// `signer` or `recording`.
    pub of: &'static str,
    /// The row of the signer or the recording.
    pub id: i64,
    /// The name.
    pub name: String,
    /// What was agreed to.
    #[serde(flatten)]
    pub consent: PersonConsent,
}

/// The longest form that is kept, in bytes.
const MAX_CONSENT_FORM_BYTES: usize = 2000;

impl Corpus {
    /// Returns the consents of all signers, and those that belong to single recordings.
    ///
    /// # Errors
    /// Fails if the database fails or a stored consent is damaged.
    pub fn list_consents(&self) -> CorpusResult<Vec<ConsentRow>> {
        let connection = self.store.read_connection();
        let mut all = Vec::new();
        let signers = stored_recordings::load_signer_rows(connection)?;
        for row in consents::of_signers(connection)? {
            // Nobody asks those who only annotate, but they may have said something.
            if row.consent.is_some() || signers.iter().any(|signer| signer.id == row.id) {
                all.push(consent_row("signer", row)?);
            }
        }
        for row in consents::of_recordings(connection)? {
            if row.consent.is_some() {
                all.push(consent_row("recording", row)?);
            }
        }
        Ok(all)
    }

    /// Returns the consents of signers and recordings, in that order.
    ///
    /// # Errors
    /// As [`change_consent`](Self::change_consent).
    pub fn consents_of(&self, of: &[CorpusAddress]) -> CorpusResult<Vec<ConsentRow>> {
        let connection = self.store.read_connection();
        let each = of.iter().map(|address| Ok(load_stored_consent(connection, address)?.0));
        each.collect()
    }

    /// Changes the consents of signers and recordings in one operation, and returns them.
    ///
    /// # Errors
    /// Fails if a signer or recording does not exist, an address names something else, or a text is too long.
    pub fn change_consent(&mut self, of: &[CorpusAddress], change: &ConsentChange) -> CorpusResult<Vec<ConsentRow>> {
        // Both texts are checked before anything is written, so a fault changes nothing.
        for text in [&change.day, &change.form].into_iter().flatten().flatten() {
            if text.len() > MAX_CONSENT_FORM_BYTES {
                return Err(CorpusError::from_wrong_message(format!(
                    "a text of a consent has at most {MAX_CONSENT_FORM_BYTES} bytes"
                )));
            }
        }
        let day = change.day.iter().flatten().map(String::as_str);
        if let Some(day) = day.clone().find(|day| !is_day(day)) {
            return Err(CorpusError::from_wrong_message(format!("{day:?} is no day"))
                .with_error_place(day)
                .with_advice("write it as 2026-11-27"));
        }
        self.store.run_store_operation(|connection| {
            let mut changed = Vec::new();
            for address in of {
                changed.push(change_one(connection, address, change)?);
            }
            let names = changed.iter().map(|row| row.name.clone()).collect();
            Ok((changed, OperationEffect::ChangeConsent { names }))
        })
    }
}

/// Reports whether a text is a day such as `2026-11-27`.
pub(crate) fn is_day(text: &str) -> bool {
    let parts: Vec<&str> = text.split('-').collect();
    let number = |text: &str, digits: usize| {
        let all = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_digit());
        text.parse::<u32>().ok().filter(|_| all)
    };
    match &parts[..] {
        [year, month, day] => {
            number(year, 4).is_some()
                && number(month, 2).is_some_and(|value| (1..=12).contains(&value))
                && number(day, 2).is_some_and(|value| (1..=31).contains(&value))
        }
        _ => false,
    }
}

fn consent_row(of: &'static str, row: consents::ConsentColumn) -> CorpusResult<ConsentRow> {
    let place = format!("{of}:{:?}", row.name);
    Ok(ConsentRow {
        of,
        id: row.id,
        consent: PersonConsent::parse_consent_json(row.consent.as_deref(), &place)?,
        name: row.name,
    })
}

/// What became of the consents of two people who are one person now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UnitedConsent {
    /// Both had said the same.
    Same,
    /// They had agreed to different things; what both agreed to holds.
    Narrower,
    /// One had said nothing; what the other agreed to holds for the recordings of both.
    Extended,
}

/// Gives a person the consent that two people have in common, before the other becomes the same person. If one of the two
/// said nothing, the other's holds.
pub(crate) fn unite_consents(connection: &Connection, from: i64, into: i64) -> CorpusResult<UnitedConsent> {
    let rows = consents::of_signers(connection)?;
    let read = |id: i64| {
        let row = rows.iter().find(|row| row.id == id);
        PersonConsent::parse_consent_json(row.and_then(|row| row.consent.as_deref()), &format!("signer:{id}"))
    };
    let (theirs, mine) = (read(from)?, read(into)?);
    if theirs == mine {
        return Ok(UnitedConsent::Same);
    }
    let unknown = PersonConsent::default();
    if theirs == unknown {
        return Ok(UnitedConsent::Extended);
    }
    let (common, outcome) = match mine == unknown {
        true => (theirs, UnitedConsent::Extended),
        // An unknown audience is the least of all.
        false => {
            let common = PersonConsent {
                movement: mine.movement.min(theirs.movement),
                annotation: mine.annotation.min(theirs.annotation),
                derived: mine.derived.min(theirs.derived),
                ..mine
            };
            (common, UnitedConsent::Narrower)
        }
    };
    consents::set_of_signer(connection, into, common.to_consent_json().as_deref())?;
    Ok(outcome)
}

/// Returns what the person or the recording at an address agreed to.
pub(crate) fn load_consent(connection: &Connection, address: &CorpusAddress) -> CorpusResult<PersonConsent> {
    Ok(load_stored_consent(connection, address)?.0.consent)
}

/// Returns the consent at an address, and its JSON.
fn load_stored_consent(connection: &Connection, address: &CorpusAddress) -> CorpusResult<(ConsentRow, Option<String>)> {
    let (of, id) = match address {
        CorpusAddress::Signer(name) => ("signer", address::find_signer_by_name(connection, name)?.id),
        CorpusAddress::Recording(name) => ("recording", address::find_recording_by_name(connection, name)?.id),
        other => {
            return Err(
                CorpusError::from_wrong_message(format!("{other} is neither a signer nor a recording"))
                    .with_error_place(other.to_string())
                    .with_advice("write signer:NAME or recording:NAME"),
            );
        }
    };
    let all = match of {
        "signer" => consents::of_signers(connection)?,
        _ => consents::of_recordings(connection)?,
    };
    let possible_row = all.into_iter().find(|row| row.id == id);
    let stored_row = possible_row.ok_or_else(|| CorpusError::from_wrong_message(format!("there is no {of}:{id}")))?;
    let old = stored_row.consent.clone();
    Ok((consent_row(of, stored_row)?, old))
}

fn change_one(connection: &Connection, address: &CorpusAddress, change: &ConsentChange) -> CorpusResult<ConsentRow> {
    let (mut row, old) = load_stored_consent(connection, address)?;
    let (of, id) = (row.of, row.id);
    let it = &mut row.consent;
    it.movement = change.movement.unwrap_or(it.movement);
    it.annotation = change.annotation.unwrap_or(it.annotation);
    it.derived = change.derived.unwrap_or(it.derived);
    if let Some(day) = &change.day {
        it.day.clone_from(day);
    }
    if let Some(form) = &change.form {
        it.form.clone_from(form);
    }
    let new = it.to_consent_json();
    // A change without effect must not become an entry of the history.
    if new != old {
        match of {
            "signer" => consents::set_of_signer(connection, id, new.as_deref())?,
            _ => consents::set_of_recording(connection, id, new.as_deref())?,
        }
    }
    if let Some(licence) = &change.licence {
        state_terms(connection, of, id, licence)?;
    }
    Ok(row)
}

/// States the terms of a recording, or of a signer's recordings, that have none.
fn state_terms(connection: &Connection, of: &str, id: i64, licence: &str) -> CorpusResult<()> {
    let licence = licence.trim();
    if licence.is_empty() || licence.len() > MAX_CONSENT_FORM_BYTES {
        return Err(CorpusError::from_wrong_message(format!(
            "terms of use are a text of at most {MAX_CONSENT_FORM_BYTES} bytes"
        )));
    }
    let recording_ids = match of {
        "signer" => edits::recordings_of_signer(connection, id)?,
        _ => vec![id],
    };
    for recording in recording_ids {
        let mut row = stored_recordings::load_recording_row(connection, recording)?;
        // A generated sign has the terms of all who contributed, and one of them cannot state those of the others.
        if row.origin == RecordOrigin::Made && of == "signer" {
            continue;
        }
        // Terms that somebody stated are never replaced in passing.
        if row.licence.as_deref().is_none_or(|text| text.trim().is_empty()) {
            row.licence = Some(licence.to_owned());
            edits::update_recording(connection, &row)?;
        }
    }
    Ok(())
}

#[cfg(test)]
pub(crate) mod tests;
