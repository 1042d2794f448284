//! The consent of signers: who may see their movement, its annotation, and signs made from it.

mod unnamed;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::str::FromStr;

use chereme_sign::Remedy;
use chereme_sign::text::fold;
use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use crate::Corpus;
use crate::address::{self, Address};
use crate::db::recordings::RecordingRow;
use crate::db::{consents, edits, recordings};
use crate::error::{Error, Result};
use crate::merge;
use crate::sources::notation::OWN_BODY;
use crate::words::effect::OperationEffect;

/// The people who may see something, from the fewest to the most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Audience {
    /// Nobody beyond those who keep the corpus.
    Nobody,
    /// People who do research with the corpus.
    Research,
    /// Everybody.
    Public,
}

impl Audience {
    /// All of them, from the most people to the fewest.
    pub const ALL: [Self; 3] = [Self::Public, Self::Research, Self::Nobody];

    /// Returns its name, such as `public`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Public => "public",
            Self::Research => "research",
            Self::Nobody => "nobody",
        }
    }
}

impl fmt::Display for Audience {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Audience {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let found = Self::ALL.into_iter().find(|it| it.name() == text.trim());
        found.ok_or_else(|| {
            Error::wrong(format!("{text:?} is no audience"))
                .at(text)
                .advise("write public, research or nobody")
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
    pub const ALL: [Self; 3] = [Self::Movement, Self::Annotation, Self::Derived];
}

/// The consent of a person. A missing entry is unknown, which differs from a refusal but is not published either.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Consent {
    /// Who may see the recorded movement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub movement: Option<Audience>,
    /// Who may see what annotators wrote about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub annotation: Option<Audience>,
    /// Who may see signs made from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derived: Option<Audience>,
    /// The day of the agreement, as `2026-11-27`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub day: Option<String>,
    /// What was signed: the version of a form, its language.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<String>,
}

impl Consent {
    /// Returns who may see something; `None` if it is unknown.
    #[must_use]
    pub fn of(&self, kind: ConsentKind) -> Option<Audience> {
        match kind {
            ConsentKind::Movement => self.movement,
            ConsentKind::Annotation => self.annotation,
            ConsentKind::Derived => self.derived,
        }
    }

    fn read(json: Option<&str>, place: &str) -> Result<Self> {
        let Some(json) = json else {
            return Ok(Self::default());
        };
        serde_json::from_str(json).map_err(|error| Error::Damaged {
            place: format!("the consent of {place}"),
            reason: error.to_string(),
        })
    }

    fn json(&self) -> Option<String> {
        // Words and texts only.
        let json = serde_json::to_string(self).unwrap_or_default();
        (*self != Self::default()).then_some(json)
    }
}

/// A change of consents; a missing field stays as it is, and `Some(None)` makes it unknown.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ConsentChange {
    /// Who may see the recorded movement.
    pub movement: Option<Option<Audience>>,
    /// Who may see what annotators wrote about it.
    pub annotation: Option<Option<Audience>>,
    /// Who may see signs made from it.
    pub derived: Option<Option<Audience>>,
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
    pub consent: Consent,
}

/// The longest form that is kept, in bytes.
const LONGEST: usize = 2000;

impl Corpus {
    /// Returns the consents of all signers, and those that belong to single recordings.
    ///
    /// # Errors
    /// Fails if the database fails or a stored consent is damaged.
    pub fn consents(&self) -> Result<Vec<ConsentRow>> {
        let connection = self.store.read();
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
    pub fn consents_of(&self, of: &[Address]) -> Result<Vec<ConsentRow>> {
        let connection = self.store.read();
        let each = of.iter().map(|it| Ok(stored(connection, it)?.0));
        each.collect()
    }

    /// Changes the consents of signers and recordings in one operation, and returns them.
    ///
    /// # Errors
    /// Fails if a signer or recording does not exist, an address names something else, or a text is too long.
    pub fn change_consent(
        &mut self,
        of: &[Address],
        change: &ConsentChange,
    ) -> Result<Vec<ConsentRow>> {
        for text in [&change.day, &change.form].into_iter().flatten().flatten() {
            if text.len() > LONGEST {
                return Err(Error::wrong(format!(
                    "a text of a consent has at most {LONGEST} bytes"
                )));
            }
        }
        let day = change.day.iter().flatten().map(String::as_str);
        if let Some(day) = day.clone().find(|day| !is_day(day)) {
            return Err(Error::wrong(format!("{day:?} is no day"))
                .at(day)
                .advise("write it as 2026-11-27"));
        }
        self.store.operation(|connection| {
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
        let all = text.len() == digits && text.bytes().all(|it| it.is_ascii_digit());
        text.parse::<u32>().ok().filter(|_| all)
    };
    match &parts[..] {
        [year, month, day] => {
            number(year, 4).is_some()
                && number(month, 2).is_some_and(|it| (1..=12).contains(&it))
                && number(day, 2).is_some_and(|it| (1..=31).contains(&it))
        }
        _ => false,
    }
}

fn consent_row(of: &'static str, row: consents::ConsentColumn) -> Result<ConsentRow> {
    let place = format!("{of}:{:?}", row.name);
    Ok(ConsentRow {
        of,
        id: row.id,
        consent: Consent::read(row.consent.as_deref(), &place)?,
        name: row.name,
    })
}

/// Returns the consent at an address, and its JSON.
fn stored(connection: &Connection, address: &Address) -> Result<(ConsentRow, Option<String>)> {
    let (of, id) = match address {
        Address::Signer(name) => ("signer", address::signer(connection, name)?.id),
        Address::Recording(name) => ("recording", address::recording(connection, name)?.id),
        other => {
            return Err(
                Error::wrong(format!("{other} is neither a signer nor a recording"))
                    .at(other.to_string())
                    .advise("write signer:NAME or recording:NAME"),
            );
        }
    };
    let all = match of {
        "signer" => consents::of_signers(connection)?,
        _ => consents::of_recordings(connection)?,
    };
    let known = all.into_iter().find(|it| it.id == id);
    let known = known.ok_or_else(|| Error::wrong(format!("there is no {of}:{id}")))?;
    let old = known.consent.clone();
    Ok((consent_row(of, known)?, old))
}

fn change_one(
    connection: &Connection,
    address: &Address,
    change: &ConsentChange,
) -> Result<ConsentRow> {
    let (mut row, old) = stored(connection, address)?;
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
    let new = it.json();
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
fn state_terms(connection: &Connection, (of, id): (&str, i64), licence: &str) -> Result<()> {
    let licence = licence.trim();
    if licence.is_empty() || licence.len() > LONGEST {
        return Err(Error::wrong(format!(
            "terms of use are a text of at most {LONGEST} bytes"
        )));
    }
    let own = match of {
        "signer" => edits::recordings_of_signer(connection, id)?,
        _ => vec![id],
    };
    for recording in own {
        let mut row = recordings::recording(connection, recording)?;
        if row.licence.as_deref().is_none_or(|it| it.trim().is_empty()) {
            row.licence = Some(licence.to_owned());
            edits::update_recording(connection, &row)?;
        }
    }
    Ok(())
}

/// A reason why something may not be published.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Withheld {
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
pub(crate) struct Permissions {
    recordings: BTreeMap<i64, RecordingRow>,
    /// Whether everybody may see a recording, by kind: the narrowest of the consents that apply.
    agreed: BTreeMap<i64, [std::result::Result<(), Withheld>; 3]>,
    /// The subjects that recordings themselves refuse to everybody.
    refused: BTreeSet<(i64, ConsentKind)>,
    /// The recordings that a generated one takes movement from; `None` if one of them is gone or not known.
    inputs: BTreeMap<i64, Option<BTreeSet<i64>>>,
    /// Recordings in which a person moves or a signer is named.
    personal: BTreeSet<i64>,
    /// Terms of what has none of its own and shows nobody.
    terms: Option<String>,
}

impl Permissions {
    /// Reads the permissions of a corpus; `terms` hold for what has none of its own and shows nobody.
    pub(crate) fn of(connection: &Connection, terms: Option<&str>) -> Result<Self> {
        let mut signers: BTreeMap<i64, (String, Consent)> = BTreeMap::new();
        for row in consents::of_signers(connection)? {
            let row = consent_row("signer", row)?;
            signers.insert(row.id, (row.name, row.consent));
        }
        let mut own: BTreeMap<i64, Consent> = BTreeMap::new();
        for row in consents::of_recordings(connection)? {
            let row = consent_row("recording", row)?;
            own.insert(row.id, row.consent);
        }
        let mut named: BTreeMap<i64, BTreeSet<String>> = BTreeMap::new();
        for (recording, name) in consents::participants(connection)? {
            named.entry(recording).or_default().insert(name);
        }
        let mut inputs: BTreeMap<i64, Option<BTreeSet<i64>>> = BTreeMap::new();
        for (made, input, token) in consents::inputs(connection, OWN_BODY)? {
            let all = inputs.entry(made).or_insert_with(|| Some(BTreeSet::new()));
            match input {
                Some(input) => drop(all.as_mut().map(|it| it.insert(input))),
                None if token => {}
                None => *all = None,
            }
        }
        let rows = recordings::recordings(connection)?;
        unnamed::complete(connection, &rows, &mut inputs)?;
        let doubts = doubts(connection)?;
        // A participant written in other letters is the same person.
        let mut by_name: BTreeMap<String, Vec<i64>> = BTreeMap::new();
        for (id, (name, _)) in &signers {
            by_name.entry(fold(name.trim())).or_default().push(*id);
        }
        let mut refused = BTreeSet::new();
        let (mut agreed, mut personal) = (BTreeMap::new(), BTreeSet::new());
        let mut all = BTreeMap::new();
        for row in rows {
            let mut people: Vec<Option<i64>> = row.signer_id.map(Some).into_iter().collect();
            for name in named.get(&row.id).into_iter().flatten() {
                match by_name.get(&fold(name)) {
                    Some(known) => people.extend(known.iter().copied().map(Some)),
                    None => people.push(None),
                }
            }
            let shows = row.origin == crate::Origin::Captured || !people.is_empty();
            if shows {
                personal.insert(row.id);
            }
            if row.origin == crate::Origin::Made {
                // Without a recipe nobody knows whose movement it is.
                inputs.entry(row.id).or_insert(None);
            }
            let consent = own.get(&row.id);
            let each: Vec<Option<&Consent>> = people
                .iter()
                .map(|it| it.and_then(|id| signers.get(&id)).map(|(_, it)| it))
                .collect();
            agreed.insert(
                row.id,
                ConsentKind::ALL.map(|kind| {
                    let own = consent.and_then(|it| it.of(kind));
                    if own.is_some_and(|it| it < Audience::Public) {
                        refused.insert((row.id, kind));
                    }
                    let doubted = doubts.contains(&("recording", row.id, kind));
                    let mut people = people.iter().flatten();
                    let doubted =
                        doubted || people.any(|it| doubts.contains(&("signer", *it, kind)));
                    match narrowest(consent, &each, kind) {
                        Some(Audience::Nobody | Audience::Research) => Err(Withheld::NotPublic),
                        None if shows => Err(Withheld::ConsentUnknown),
                        _ if doubted => Err(Withheld::Undecided),
                        Some(Audience::Public) | None => Ok(()),
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
    pub(crate) fn of_entry(&self) -> std::result::Result<BTreeSet<String>, Withheld> {
        let terms = self.terms.clone().ok_or(Withheld::NoTerms)?;
        Ok(BTreeSet::from([terms]))
    }

    /// Returns the terms under which a recording may be published, those of all its inputs included.
    pub(crate) fn of_recording(
        &self,
        recording: i64,
        kind: ConsentKind,
    ) -> std::result::Result<BTreeSet<String>, Withheld> {
        let (mut terms, mut known) = (BTreeSet::new(), BTreeSet::from([recording]));
        let mut waiting = vec![(recording, kind)];
        while let Some((at, kind)) = waiting.pop() {
            let row = self.recordings.get(&at).ok_or(Withheld::InputGone)?;
            let inputs = match self.inputs.get(&at) {
                Some(None) => return Err(Withheld::InputGone),
                Some(Some(inputs)) => Some(inputs),
                None => None,
            };
            let licence = row.licence.as_deref().map(str::trim);
            let licence = licence.filter(|it| !it.is_empty());
            let personal = self.personal.contains(&at);
            let from_others = inputs.is_some_and(|it| !it.is_empty());
            if self.refused.contains(&(at, kind)) {
                return Err(Withheld::NotPublic);
            }
            let kind = if from_others {
                ConsentKind::Derived
            } else {
                kind
            };
            let index = ConsentKind::ALL.iter().position(|it| *it == kind);
            let agreed = self.agreed.get(&at).zip(index);
            agreed.map_or(Err(Withheld::ConsentUnknown), |(all, index)| all[index])?;
            match licence {
                Some(it) => {
                    terms.insert(it.to_owned());
                }
                // A sign made from others has their terms.
                None if from_others => {}
                None if !personal => terms.extend(self.of_entry()?),
                None => return Err(Withheld::NoTerms),
            }
            if at != recording && licence.is_some_and(forbids_derivatives) {
                return Err(Withheld::NoDerivatives);
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
    pub(crate) fn person(&self, recording: i64) -> Option<(bool, i64)> {
        let row = self.recordings.get(&recording)?;
        match row.signer_id {
            Some(signer) => Some((true, signer)),
            None => self
                .personal
                .contains(&recording)
                .then_some((false, recording)),
        }
    }
}

/// Returns the consents that may not stand: another copy of the corpus allows less, and nobody has decided.
fn doubts(connection: &Connection) -> Result<BTreeSet<(&'static str, i64, ConsentKind)>> {
    let mut doubts = BTreeSet::new();
    for dispute in merge::disputes(connection)? {
        let differs = |column: &str| dispute.mine.get(column) != dispute.theirs.get(column);
        let other = dispute.theirs.get("consent").and_then(|it| it.as_str());
        // A consent that cannot be read allows nothing.
        let other = Consent::read(other, dispute.table).unwrap_or_default();
        for kind in ConsentKind::ALL {
            let whole = match dispute.table {
                _ if dispute.theirs.is_empty() => true,
                "signer" => false,
                "tier" => differs("participant"),
                _ => ["signer_id", "origin", "licence"].into_iter().any(differs),
            };
            let less = differs("consent") && other.of(kind) != Some(Audience::Public);
            match dispute.table {
                "signer" if whole || less => drop(doubts.insert(("signer", dispute.id, kind))),
                "recording" if whole || less => {
                    doubts.insert(("recording", dispute.id, kind));
                }
                "tier" if whole => doubts.extend(
                    dispute
                        .recording
                        .map(|recording| ("recording", recording, kind)),
                ),
                _ => {}
            }
        }
    }
    Ok(doubts)
}

/// Returns the narrowest consent of a recording and its people; `None` if a person's is unknown and the recording has
/// none, or if nothing is known.
fn narrowest(
    own: Option<&Consent>,
    people: &[Option<&Consent>],
    kind: ConsentKind,
) -> Option<Audience> {
    let own = own.and_then(|it| it.of(kind));
    let each: Vec<Option<Audience>> = people
        .iter()
        .map(|it| it.and_then(|it| it.of(kind)))
        .collect();
    let least = each.iter().copied().flatten().chain(own).min();
    // A refusal holds whatever else is unknown.
    if least.is_some_and(|it| it < Audience::Public) {
        return least;
    }
    match own {
        Some(own) => least.or(Some(own)),
        None if each.is_empty() || each.contains(&None) => None,
        None => least,
    }
}

/// Reports whether terms of use forbid that something is made from it, as the ND licences of Creative Commons do.
fn forbids_derivatives(licence: &str) -> bool {
    let licence = licence.to_lowercase();
    let words = licence.split(|it: char| !it.is_alphanumeric());
    let nd = words.clone().any(|word| word == "nd");
    nd || licence.contains("noderiv") || licence.contains("no deriv")
}

/// Returns the remedy for something that was withheld.
pub(crate) fn remedy(reason: Withheld) -> Remedy {
    match reason {
        Withheld::ConsentUnknown => Remedy::command(
            "state what the signers agreed to: `chereme consent CORPUS signer:NAME --all public`",
        ),
        Withheld::NotPublic => "the signers did not agree that everybody sees it".into(),
        Withheld::NoTerms => Remedy::command(
            "state the terms of recordings with `chereme consent CORPUS signer:NAME --licence TERMS`, those of entries that show nobody with --terms TERMS",
        ),
        Withheld::NoDerivatives => "a recording that they were made from may not be changed".into(),
        Withheld::Undecided => Remedy::command(
            "two copies of the corpus disagree about it: `chereme conflicts CORPUS` lists what is to be decided",
        ),
        Withheld::InputGone => {
            "a recording that they were made from is not known, or was deleted".into()
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
