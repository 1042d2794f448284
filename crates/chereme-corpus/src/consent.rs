//! The consent of signers: who may see their movement, its annotation, and signs made from it.

mod unnamed;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::str::FromStr;

use chereme_sign::ErrorRemedy;
use chereme_sign::text::fold_text;
use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use crate::Corpus;
use crate::address::{self, CorpusAddress};
use crate::db::stored_recordings::RecordingRow;
use crate::db::{consents, edits, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::merge;
use crate::sources::sources_notation::OWN_BODY;
use crate::words::effect::OperationEffect;

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
        for row in consents::of_signers(connection)? {
            all.push(consent_row("signer", row)?);
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
    if new != old {
        match of {
            "signer" => consents::set_of_signer(connection, id, new.as_deref())?,
            _ => consents::set_of_recording(connection, id, new.as_deref())?,
        }
    }
    if let Some(licence) = &change.licence {
        state_terms(connection, (of, id), licence)?;
    }
    Ok(row)
}

/// States the terms of a recording, or of a signer's recordings, that have none.
fn state_terms(connection: &Connection, (of, id): (&str, i64), licence: &str) -> CorpusResult<()> {
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
        if row.licence.as_deref().is_none_or(|text| text.trim().is_empty()) {
            row.licence = Some(licence.to_owned());
            edits::update_recording(connection, &row)?;
        }
    }
    Ok(())
}

/// A reason why something may not be published.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WithheldReason {
    /// Nobody recorded what the signer agreed to.
    ConsentUnknown,
    /// The signer did not agree that everybody sees it.
    NotPublic,
    /// No terms of use are stated.
    NoTerms,
    /// The terms forbid that something is made from it.
    NoDerivatives,
    /// Two copies of the corpus disagree about it, and nobody has decided.
    Undecided,
    /// A recording that it was made from is not known, or no longer there.
    InputGone,
}

/// The permissions of a corpus, read at one moment.
pub(crate) struct PublishPermissions {
    recordings: BTreeMap<i64, RecordingRow>,
    /// Whether everybody may see a recording, by kind: the narrowest of the consents that apply.
    agreed: BTreeMap<i64, [std::result::Result<(), WithheldReason>; 3]>,
    /// The subjects that recordings themselves refuse to everybody.
    refused: BTreeSet<(i64, ConsentKind)>,
    /// The recordings that a generated one takes movement from; `None` if one of them is gone or not known.
    inputs: BTreeMap<i64, Option<BTreeSet<i64>>>,
    /// Recordings in which a person moves or a signer is named.
    personal: BTreeSet<i64>,
    /// Terms of what has none of its own and shows nobody.
    terms: Option<String>,
}

impl PublishPermissions {
    /// Reads the permissions of a corpus; `terms` hold for what has none of its own and shows nobody.
    pub(crate) fn read_publish_permissions(connection: &Connection, terms: Option<&str>) -> CorpusResult<Self> {
        let mut signers: BTreeMap<i64, (String, PersonConsent)> = BTreeMap::new();
        for row in consents::of_signers(connection)? {
            let row = consent_row("signer", row)?;
            signers.insert(row.id, (row.name, row.consent));
        }
        let mut own_consents: BTreeMap<i64, PersonConsent> = BTreeMap::new();
        for row in consents::of_recordings(connection)? {
            let row = consent_row("recording", row)?;
            own_consents.insert(row.id, row.consent);
        }
        let mut named: BTreeMap<i64, BTreeSet<String>> = BTreeMap::new();
        for (recording, name) in consents::list_tier_participants(connection)? {
            named.entry(recording).or_default().insert(name);
        }
        let mut inputs: BTreeMap<i64, Option<BTreeSet<i64>>> = BTreeMap::new();
        for (made, input, token) in consents::list_recipe_movement_inputs(connection, OWN_BODY)? {
            let all = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new()));
            match input {
                Some(input) => drop(all.as_mut().map(|set| set.insert(input))),
                None if token => {}
                None => *all = None,
            }
        }
        let rows = stored_recordings::load_recording_rows(connection)?;
        unnamed::complete_unnamed_inputs(connection, &rows, &mut inputs)?;
        let doubts = doubts(connection)?;
        // A participant written in other letters is the same person.
        let mut by_name: BTreeMap<String, Vec<i64>> = BTreeMap::new();
        for (id, (name, _)) in &signers {
            by_name.entry(fold_text(name.trim())).or_default().push(*id);
        }
        let mut refused = BTreeSet::new();
        let (mut agreed, mut personal) = (BTreeMap::new(), BTreeSet::new());
        let mut all = BTreeMap::new();
        for row in rows {
            let mut people: Vec<Option<i64>> = row.signer_id.map(Some).into_iter().collect();
            for name in named.get(&row.id).into_iter().flatten() {
                match by_name.get(&fold_text(name)) {
                    Some(known) => people.extend(known.iter().copied().map(Some)),
                    None => people.push(None),
                }
            }
            let shows = row.origin == crate::RecordOrigin::Captured || !people.is_empty();
            if shows {
                personal.insert(row.id);
            }
            if row.origin == crate::RecordOrigin::Made {
                // Without a recipe nobody knows whose movement it is.
                inputs.entry(row.id).or_insert(None);
            }
            let consent = own_consents.get(&row.id);
            let each: Vec<Option<&PersonConsent>> = people
                .iter()
                .map(|entry| entry.and_then(|id| signers.get(&id)).map(|(_, it)| it))
                .collect();
            agreed.insert(
                row.id,
                ConsentKind::ALL_CONSENT_KINDS.map(|kind| {
                    let own_audience = consent.and_then(|statement| statement.audience_of_kind(kind));
                    if own_audience.is_some_and(|audience| audience < ConsentAudience::Public) {
                        refused.insert((row.id, kind));
                    }
                    let doubted = doubts.contains(&("recording", row.id, kind));
                    let mut people = people.iter().flatten();
                    let doubted = doubted || people.any(|person| doubts.contains(&("signer", *person, kind)));
                    match narrowest(consent, &each, kind) {
                        Some(ConsentAudience::Nobody | ConsentAudience::Research) => Err(WithheldReason::NotPublic),
                        None if shows => Err(WithheldReason::ConsentUnknown),
                        _ if doubted => Err(WithheldReason::Undecided),
                        Some(ConsentAudience::Public) | None => Ok(()),
                    }
                }),
            );
            all.insert(row.id, row);
        }
        Ok(Self {
            recordings: all,
            agreed,
            refused,
            inputs,
            personal,
            terms: terms.map(str::to_owned),
        })
    }

    /// Returns the terms under which an entry of a table may be published.
    pub(crate) fn of_entry(&self) -> std::result::Result<BTreeSet<String>, WithheldReason> {
        let terms = self.terms.clone().ok_or(WithheldReason::NoTerms)?;
        Ok(BTreeSet::from([terms]))
    }

    /// Returns the terms under which a recording may be published, those of all its inputs included.
    pub(crate) fn recording_publish_terms(
        &self,
        recording: i64,
        kind: ConsentKind,
    ) -> std::result::Result<BTreeSet<String>, WithheldReason> {
        let (mut terms, mut known) = (BTreeSet::new(), BTreeSet::from([recording]));
        let mut waiting = vec![(recording, kind)];
        while let Some((at, kind)) = waiting.pop() {
            let row = self.recordings.get(&at).ok_or(WithheldReason::InputGone)?;
            let inputs = match self.inputs.get(&at) {
                Some(None) => return Err(WithheldReason::InputGone),
                Some(Some(inputs)) => Some(inputs),
                None => None,
            };
            let raw_licence = row.licence.as_deref().map(str::trim);
            let licence = raw_licence.filter(|text| !text.is_empty());
            let personal = self.personal.contains(&at);
            let from_others = inputs.is_some_and(|list| !list.is_empty());
            if self.refused.contains(&(at, kind)) {
                return Err(WithheldReason::NotPublic);
            }
            let kind = if from_others { ConsentKind::Derived } else { kind };
            let index = ConsentKind::ALL_CONSENT_KINDS.iter().position(|other| *other == kind);
            let agreed = self.agreed.get(&at).zip(index);
            agreed.map_or(Err(WithheldReason::ConsentUnknown), |(all, index)| all[index])?;
            match licence {
                Some(it) => {
                    terms.insert(it.to_owned());
                }
                // A sign made from others has their terms.
                None if from_others => {}
                None if !personal => terms.extend(self.of_entry()?),
                None => return Err(WithheldReason::NoTerms),
            }
            if at != recording && licence.is_some_and(forbids_derivatives) {
                return Err(WithheldReason::NoDerivatives);
            }
            for &input in inputs.into_iter().flatten() {
                if known.insert(input) {
                    waiting.push((input, ConsentKind::Derived));
                }
            }
        }
        Ok(terms)
    }

    /// Returns the signer of a recording, or the number of the recording if nobody is named.
    pub(crate) fn recording_person_key(&self, recording: i64) -> Option<(bool, i64)> {
        let row = self.recordings.get(&recording)?;
        match row.signer_id {
            Some(signer) => Some((true, signer)),
            None => self.personal.contains(&recording).then_some((false, recording)),
        }
    }
}

/// Returns the consents that may not stand: another copy of the corpus allows less, and nobody has decided.
fn doubts(connection: &Connection) -> CorpusResult<BTreeSet<(&'static str, i64, ConsentKind)>> {
    let mut doubts = BTreeSet::new();
    for dispute in merge::undecided_disputes(connection)? {
        let differs = |column: &str| dispute.mine.get(column) != dispute.theirs.get(column);
        let other_text = dispute.theirs.get("consent").and_then(|value| value.as_str());
        // A consent that cannot be read allows nothing.
        let other = PersonConsent::parse_consent_json(other_text, dispute.table).unwrap_or_default();
        for kind in ConsentKind::ALL_CONSENT_KINDS {
            let is_whole = match dispute.table {
                _ if dispute.theirs.is_empty() => true,
                "signer" => false,
                "tier" => differs("participant"),
                _ => ["signer_id", "origin", "licence"].into_iter().any(differs),
            };
            let less = differs("consent") && other.audience_of_kind(kind) != Some(ConsentAudience::Public);
            match dispute.table {
                "signer" if is_whole || less => drop(doubts.insert(("signer", dispute.id, kind))),
                "recording" if is_whole || less => {
                    doubts.insert(("recording", dispute.id, kind));
                }
                "tier" if is_whole => doubts.extend(dispute.recording.map(|recording| ("recording", recording, kind))),
                _ => {}
            }
        }
    }
    Ok(doubts)
}

/// Returns the narrowest consent of a recording and its people; `None` if a person's is unknown and the recording has
/// none, or if nothing is known.
fn narrowest(
    own: Option<&PersonConsent>,
    people: &[Option<&PersonConsent>],
    kind: ConsentKind,
) -> Option<ConsentAudience> {
    let own_audience = own.and_then(|consent| consent.audience_of_kind(kind));
    let each: Vec<Option<ConsentAudience>> = people
        .iter()
        .map(|person| person.and_then(|consent| consent.audience_of_kind(kind)))
        .collect();
    let least = each.iter().copied().flatten().chain(own_audience).min();
    // A refusal holds whatever else is unknown.
    if least.is_some_and(|audience| audience < ConsentAudience::Public) {
        return least;
    }
    match own_audience {
        Some(own) => least.or(Some(own)),
        None if each.is_empty() || each.contains(&None) => None,
        None => least,
    }
}

/// Reports whether terms of use forbid that something is made from it, as the ND licences of Creative Commons do.
fn forbids_derivatives(licence: &str) -> bool {
    let licence = licence.to_lowercase();
    let words = licence.split(|letter: char| !letter.is_alphanumeric());
    let nd = words.clone().any(|word| word == "nd");
    nd || licence.contains("noderiv") || licence.contains("no deriv")
}

/// Returns the remedy for something that was withheld.
pub(crate) fn withheld_remedy(reason: WithheldReason) -> ErrorRemedy {
    match reason {
        WithheldReason::ConsentUnknown => ErrorRemedy::command_remedy(
            "state what the signers agreed to: `chereme consent CORPUS signer:NAME --all public`",
        ),
        WithheldReason::NotPublic => "the signers did not agree that everybody sees it".into(),
        WithheldReason::NoTerms => ErrorRemedy::command_remedy(
            "state the terms of recordings with `chereme consent CORPUS signer:NAME --licence TERMS`, those of entries that show nobody with --terms TERMS",
        ),
        WithheldReason::NoDerivatives => "a recording that they were made from may not be changed".into(),
        WithheldReason::Undecided => ErrorRemedy::command_remedy(
            "two copies of the corpus disagree about it: `chereme conflicts CORPUS` lists what is to be decided",
        ),
        WithheldReason::InputGone => "a recording that they were made from is not known, or was deleted".into(),
    }
}

#[cfg(test)]
pub(crate) mod tests;
