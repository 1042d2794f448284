//! People: who signs, who takes part and who annotates, under which names, and what the corpus says of them.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::table::people_table::{self, PersonTableRow};
use chereme_motion::BodySide;
use chereme_sign::text::fold_text;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, RowName};
use crate::consent::{ConsentAudience, UnitedConsent};
use crate::db::people::{self, PersonAttribute, PersonContents};
use crate::db::stored_recordings::{self, SignerRow};
use crate::db::{edits, stored_check};
use crate::error::{CorpusError, CorpusResult};
use crate::report_finding::ReportFinding;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// A change of a person; a missing field stays as it is.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PersonChange {
    /// The name, which nobody else may have; the former one becomes another name of the person only if asked for.
    pub name: Option<String>,
    /// Whether the former name stays another name, so that files which say it are understood.
    pub keeps_former_name: bool,
    /// The dominant hand, or nothing if it is unknown.
    pub handedness: Option<Option<BodySide>>,
    /// Remarks, or none.
    pub notes: Option<Option<String>>,
    /// Other names to add.
    pub add_aliases: Vec<String>,
    /// Other names to take away.
    pub remove_aliases: Vec<String>,
    /// What is said of the person from now on, by name; an empty text takes it away.
    pub attributes: BTreeMap<String, String>,
    /// Who may see the attributes that are set; those that are not set keep their audience.
    pub audience: Option<ConsentAudience>,
}

/// The report on people who were made one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct UnitedPeople {
    /// The name that stays.
    pub into: String,
    /// The names that are other names of that person now.
    pub united: Vec<String>,
    /// The recordings that have that signer now and had another.
    pub recordings: u64,
    /// The tiers whose participant or annotator that person is now.
    pub tiers: u64,
    /// Whether the consent of the person became narrower by that of another.
    pub is_consent_narrower: bool,
    /// Whether what one of them agreed to holds for recordings of another who had said nothing.
    pub is_consent_extended: bool,
}

/// The report on a table of people.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct PeopleTableReport {
    /// The people whom the corpus did not know.
    pub added: Vec<String>,
    /// The people of whom the table says something new.
    pub changed: Vec<String>,
    /// How many rows say what the corpus says already.
    pub unchanged: u64,
    /// Oddities of the table.
    pub findings: Vec<ReportFinding>,
}

impl Corpus {
    /// Returns all people by name: signers, participants and annotators.
    ///
    /// # Errors
    /// Fails if the corpus cannot be read.
    pub fn list_people(&self) -> CorpusResult<Vec<PersonContents>> {
        people::load_people(self.store.read_connection())
    }

    /// Changes a person in one operation, and returns what the corpus knows of them. A new name is that of all
    /// participants and annotators with the former one; attributes that are set without an audience are for nobody else.
    ///
    /// # Errors
    /// Fails if there is no such person, somebody else has the name, or there is nothing to take away.
    pub fn change_person(&mut self, person: &RowName, change: &PersonChange) -> CorpusResult<PersonContents> {
        self.store.run_store_operation(|connection| {
            let row = find_person_row(connection, person)?;
            let row = change_person_row(connection, &row, change)?;
            let effect = OperationEffect::ChangePerson {
                person: row.name.clone(),
            };
            Ok((people::load_person(connection, row.id)?, effect))
        })
    }

    /// Makes people one, everywhere, as one operation: recordings, participants, annotators, other names and attributes.
    /// The names that go become other names of the one who stays.
    ///
    /// # Errors
    /// Fails if one of them does not exist, or two of them differ in the dominant hand or in an attribute.
    pub fn unite_people(&mut self, from: &[RowName], into: &RowName) -> CorpusResult<UnitedPeople> {
        self.store.run_store_operation(|connection| {
            let report = unite_person_rows(connection, from, into)?;
            let effect = OperationEffect::UnitePeople {
                names: report.united.clone(),
                person: report.into.clone(),
            };
            Ok((report, effect))
        })
    }

    /// Removes a person of whom the corpus has neither recordings nor tiers, and returns the name.
    ///
    /// # Errors
    /// Fails if there is no such person, or something of them.
    pub fn remove_person(&mut self, person: &RowName) -> CorpusResult<String> {
        self.store.run_store_operation(|connection| {
            let row = find_person_row(connection, person)?;
            let contents = people::load_person(connection, row.id)?;
            if contents.recordings + contents.participant_tiers + contents.annotator_tiers > 0 {
                let text = format!("the corpus has recordings or tiers of {}", row.name);
                return Err(CorpusError::from_wrong_message(text)
                    .with_error_place(row.name)
                    .with_command_advice("forget the person with all of it: `chereme forget CORPUS signer:NAME`, or make them one with somebody: `chereme people CORPUS unite PERSON --into NAME`"));
            }
            people::delete_person(connection, row.id)?;
            let effect = OperationEffect::RemovePerson {
                person: row.name.clone(),
            };
            Ok((row.name, effect))
        })
    }

    /// Reads a table of people (CSV or TSV) as one operation: adds those whom the corpus does not know, and says of the
    /// others what the table says. `table_name` is the name of the table in errors; attributes get the audience, or keep
    /// the one that they have. What the table leaves empty stays as it is.
    ///
    /// # Errors
    /// [`CorpusError::Several`] with every row that cannot be taken; nothing is changed then.
    pub fn import_people_table(
        &mut self,
        bytes: &[u8],
        table_name: &str,
        audience: Option<ConsentAudience>,
        dry_run: bool,
    ) -> CorpusResult<PeopleTableReport> {
        let read = people_table::read_people_table(bytes);
        let (rows, findings) =
            read.map_err(|error| CorpusError::from_wrong_message(error.to_string()).with_error_place(table_name))?;
        if rows.is_empty() {
            return Err(CorpusError::from_wrong_message("the table names nobody")
                .with_error_place(table_name)
                .with_advice("write a row for each person below the row of column names"));
        }
        let take_rows = |connection: &Connection| {
            let mut report = PeopleTableReport {
                findings: findings.iter().cloned().map(ReportFinding::from).collect(),
                ..PeopleTableReport::default()
            };
            let mut faults = Vec::new();
            for row in &rows {
                let place = format!("{table_name}, line {}", row.line);
                if let Err(error) = take_person_row(connection, row, audience, &mut report) {
                    faults.push(error.with_error_place(place));
                }
            }
            match faults.is_empty() {
                true => Ok(report),
                false => Err(CorpusError::from_error_list(faults)),
            }
        };
        self.store.run_store_operation(|connection| {
            let report = match dry_run {
                true => stored_check::run_and_roll_back(connection, || take_rows(connection))?,
                false => take_rows(connection)?,
            };
            let effect = OperationEffect::ImportPeople {
                file: table_name.to_owned(),
                people: (report.added.len() + report.changed.len()) as u64,
            };
            Ok((report, effect))
        })
    }
}

/// Returns the person with this name or number; an error lists those who only take part or annotate, too.
fn find_person_row(connection: &Connection, person: &RowName) -> CorpusResult<SignerRow> {
    address::find_signer_by_name(connection, person).map_err(|error| {
        let known = people::load_people(connection).unwrap_or_default();
        let names: Vec<String> = known.into_iter().map(|person| person.name).collect();
        match names.is_empty() {
            true => error,
            false => error.with_advice(format!("the people are: {}", names.join(", "))),
        }
    })
}

/// Fails if somebody else has this name.
fn check_free_name(connection: &Connection, person: i64, name: &str) -> CorpusResult<()> {
    match stored_recordings::find_signer(connection, name)? {
        Some(other) if other.id != person => Err(CorpusError::from_wrong_message(format!(
            "{name:?} is a name of {}",
            other.name
        ))
        .with_error_place(name)
        .with_command_advice(
            "choose another name, or make the two one: `chereme people CORPUS unite PERSON --into NAME`",
        )),
        _ => Ok(()),
    }
}

pub(crate) fn change_person_row(
    connection: &Connection,
    old: &SignerRow,
    change: &PersonChange,
) -> CorpusResult<SignerRow> {
    let mut row = old.clone();
    if let Some(name) = &change.name {
        row.name = require_person_name(name)?;
        check_free_name(connection, row.id, &row.name)?;
    }
    if let Some(side) = change.handedness {
        row.handedness = side.map(|side| side.body_side_name().to_owned());
    }
    if let Some(notes) = &change.notes {
        row.notes.clone_from(notes);
    }
    if row.name != old.name {
        // A name that the person answers to already is no other name of theirs any more.
        people::remove_person_alias(connection, row.id, &row.name)?;
    }
    if row != *old {
        edits::update_signer(connection, &row)?;
    }
    if row.name != old.name {
        take_over_names(connection, &old.name, &row.name)?;
        if change.keeps_former_name {
            people::insert_person_alias(connection, row.id, &old.name)?;
        }
    }
    for alias in &change.add_aliases {
        let alias = require_person_name(alias)?;
        check_free_name(connection, row.id, &alias)?;
        if stored_recordings::find_signer(connection, &alias)?.is_none() {
            people::insert_person_alias(connection, row.id, &alias)?;
            // Tiers that came under this name before are those of the person, and two readings of one annotator agree.
            if take_over_names(connection, &alias, &row.name)? > 0 {
                let recordings = edits::recordings_of_signer(connection, row.id)?;
                derive_recordings(connection, recordings)?;
                derive_recordings(connection, edits::recordings_of_annotator(connection, &row.name)?)?;
            }
        }
    }
    for alias in &change.remove_aliases {
        if !people::remove_person_alias(connection, row.id, alias.trim())? {
            let known = people::load_person_aliases(connection, row.id)?.join(", ");
            return Err(
                CorpusError::from_wrong_message(format!("{alias:?} is no other name of {}", row.name))
                    .with_error_place(alias)
                    .with_advice(format!("the other names are: {known}")),
            );
        }
    }
    change_attributes(connection, &row, change)?;
    if row.handedness != old.handedness {
        derive_recordings(connection, edits::recordings_of_signer(connection, row.id)?)?;
    }
    Ok(row)
}

fn change_attributes(connection: &Connection, row: &SignerRow, change: &PersonChange) -> CorpusResult<()> {
    let known = people::load_person_attributes(connection, row.id)?;
    for (name, text) in &change.attributes {
        let name = require_person_name(name)?;
        let text = text.trim();
        let former = known.iter().find(|attribute| attribute.name == name);
        if text.is_empty() {
            if !people::remove_person_attribute(connection, row.id, &name)? {
                let names: Vec<&str> = known.iter().map(|attribute| attribute.name.as_str()).collect();
                return Err(
                    CorpusError::from_wrong_message(format!("nothing is said of {} under {name:?}", row.name))
                        .with_error_place(name)
                        .with_advice(format!("said are: {}", names.join(", "))),
                );
            }
            continue;
        }
        let attribute = PersonAttribute {
            number: text.parse().ok().filter(|number: &f64| number.is_finite()),
            text: text.to_owned(),
            // Nobody agreed yet that others see what is new.
            audience: change
                .audience
                .or(former.map(|attribute| attribute.audience))
                .unwrap_or(ConsentAudience::Nobody),
            name,
        };
        people::set_person_attribute(connection, row.id, &attribute)?;
    }
    if let (true, Some(audience)) = (change.attributes.is_empty(), change.audience) {
        for attribute in known {
            people::set_person_attribute(connection, row.id, &PersonAttribute { audience, ..attribute })?;
        }
    }
    Ok(())
}

/// Returns a name without blanks around it.
fn require_person_name(text: &str) -> CorpusResult<String> {
    match text.trim() {
        "" => Err(CorpusError::from_wrong_message("a person needs a name")),
        text => Ok(text.to_owned()),
    }
}

/// Gives the participants and the annotators of tiers, and the preferred annotator, who have one name another. Returns the
/// number of tiers.
fn take_over_names(connection: &Connection, old: &str, new: &str) -> CorpusResult<u64> {
    tokens::rename_preferred_annotator(connection, old, new)?;
    let tiers = edits::rename_participant(connection, old, new)? + edits::rename_annotator(connection, old, new)?;
    Ok(tiers as u64)
}

/// Derives the tokens of recordings again: their hands and the readings that count depend on people.
fn derive_recordings(connection: &Connection, recordings: impl IntoIterator<Item = i64>) -> CorpusResult<()> {
    for recording in recordings {
        let inventories = crate::inventories::load_of(connection, recording)?;
        tokens::update_recording_tokens(connection, recording, None, &inventories)?;
    }
    Ok(())
}

fn unite_person_rows(connection: &Connection, from: &[RowName], into: &RowName) -> CorpusResult<UnitedPeople> {
    let mut kept = find_person_row(connection, into)?;
    let mut gone: Vec<SignerRow> = Vec::new();
    for name in from {
        let row = find_person_row(connection, name)?;
        if row.id != kept.id && gone.iter().all(|other| other.id != row.id) {
            gone.push(row);
        }
    }
    if gone.is_empty() {
        return Err(
            CorpusError::from_wrong_message(format!("there is nobody to make one with {}", kept.name))
                .with_error_place(kept.name)
                .with_advice("name at least one other person"),
        );
    }
    let mut report = UnitedPeople {
        into: kept.name.clone(),
        united: gone.iter().map(|row| row.name.clone()).collect(),
        recordings: 0,
        tiers: 0,
        is_consent_narrower: false,
        is_consent_extended: false,
    };
    let former = kept.clone();
    let mut changed_recordings = BTreeSet::new();
    for row in gone {
        refuse_differences(connection, &kept, &row)?;
        let recordings = edits::recordings_of_signer(connection, row.id)?;
        let contents = people::load_person(connection, row.id)?;
        report.recordings += contents.recordings;
        changed_recordings.extend(recordings);
        // Two readings of one annotator are no disagreement any more.
        changed_recordings.extend(edits::recordings_of_annotator(connection, &row.name)?);
        match crate::consent::unite_consents(connection, row.id, kept.id)? {
            UnitedConsent::Same => {}
            UnitedConsent::Narrower => report.is_consent_narrower = true,
            UnitedConsent::Extended => report.is_consent_extended = true,
        }
        people::move_person_rows(connection, row.id, kept.id)?;
        report.tiers += take_over_names(connection, &row.name, &kept.name)?;
        people::insert_person_alias(connection, kept.id, &row.name)?;
        if kept.handedness.is_none() {
            kept.handedness = row.handedness;
        }
        kept.notes = match (kept.notes.take(), row.notes) {
            (Some(mine), Some(theirs)) if mine != theirs => Some(format!("{mine}\n{theirs}")),
            (mine, theirs) => mine.or(theirs),
        };
    }
    if kept != former {
        edits::update_signer(connection, &kept)?;
    }
    if kept.handedness != former.handedness {
        changed_recordings.extend(edits::recordings_of_signer(connection, kept.id)?);
    }
    derive_recordings(connection, changed_recordings)?;
    Ok(report)
}

/// Fails if two people who are to be one differ in the dominant hand or in an attribute: one of the two would be lost.
fn refuse_differences(connection: &Connection, kept: &SignerRow, gone: &SignerRow) -> CorpusResult<()> {
    let mut differences = Vec::new();
    if let (Some(mine), Some(theirs)) = (&kept.handedness, &gone.handedness)
        && mine != theirs
    {
        differences.push(format!("handedness ({mine}, {theirs})"));
    }
    let mine = people::load_person_attributes(connection, kept.id)?;
    for theirs in people::load_person_attributes(connection, gone.id)? {
        let same_name = mine.iter().find(|attribute| attribute.name == theirs.name);
        if let Some(attribute) = same_name.filter(|attribute| attribute.text != theirs.text) {
            differences.push(format!("{} ({}, {})", theirs.name, attribute.text, theirs.text));
        }
    }
    if differences.is_empty() {
        return Ok(());
    }
    Err(CorpusError::from_wrong_message(format!(
        "{} and {} differ in: {}",
        kept.name,
        gone.name,
        differences.join(", ")
    ))
    .with_error_place(&gone.name)
    .with_command_advice("say of both the one that is true first: `chereme people CORPUS set NAME`"))
}

/// Takes a row of a table of people into the corpus, and counts it in the report.
fn take_person_row(
    connection: &Connection,
    row: &PersonTableRow,
    audience: Option<ConsentAudience>,
    report: &mut PeopleTableReport,
) -> CorpusResult<()> {
    let known = stored_recordings::find_signer(connection, &row.name)?;
    let is_new = known.is_none();
    let person = match known {
        Some(person) => person,
        None => {
            let id = stored_recordings::signer_named(connection, &row.name, None)?;
            address::find_signer_by_name(connection, &RowName::Number(id))?
        }
    };
    let before = people::load_person(connection, person.id)?;
    let change = PersonChange {
        handedness: row.handedness.as_deref().map(parse_handedness).transpose()?.map(Some),
        notes: row.notes.clone().map(Some),
        // What a person answers to already is not new.
        add_aliases: row
            .aliases
            .iter()
            .filter(|alias| **alias != person.name)
            .cloned()
            .collect(),
        ..PersonChange::default()
    };
    change_person_row(connection, &person, &change)?;
    for cell in &row.attributes {
        let former = before.attributes.iter().find(|attribute| attribute.name == cell.title);
        let attribute = PersonAttribute {
            name: cell.title.clone(),
            text: cell.text.clone(),
            number: cell.number,
            audience: audience
                .or(former.map(|attribute| attribute.audience))
                .unwrap_or(ConsentAudience::Nobody),
        };
        people::set_person_attribute(connection, person.id, &attribute)?;
    }
    match (is_new, people::load_person(connection, person.id)? == before) {
        (true, _) => report.added.push(person.name),
        (false, true) => report.unchanged += 1,
        (false, false) => report.changed.push(person.name),
    }
    Ok(())
}

/// Returns the dominant hand that a cell of a table means.
fn parse_handedness(text: &str) -> CorpusResult<BodySide> {
    match fold_text(text).trim() {
        "right" | "r" | "right-handed" | "droite" | "droitier" | "droitiere" => Ok(BodySide::Right),
        "left" | "l" | "left-handed" | "gauche" | "gaucher" | "gauchere" => Ok(BodySide::Left),
        _ => {
            Err(CorpusError::from_wrong_message(format!("{text:?} is no dominant hand"))
                .with_advice("write right or left"))
        }
    }
}

#[cfg(test)]
mod tests;
