//! Lexicons: whose entry a sign is, and which lexicon the glosses of a recording mean.

pub(crate) mod entry_match;
mod unite_lexicons;

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::ErrorRemedy;
use chereme_sign::text::nearest_candidate;
use rusqlite::Connection;

use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::lexicons::{self, LexiconContents, LexiconRow};
use crate::db::{signs, stored_recordings};
use crate::error::{CorpusError, CorpusResult, MeantName};
use crate::inventories;
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::tokens;
use crate::words::effect::OperationEffect;

pub use unite_lexicons::UnitedLexicons;

/// The lexicons whose signs are compared, counted or published together.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum LexiconScope {
    /// Those of one lexicon; signs of several are an error that names them.
    #[default]
    Single,
    /// Those of the lexicon of this name.
    Named(String),
    /// Those of all lexicons, as if they were one.
    Across,
}

/// A change of a lexicon; of each field that is given, the new content, nothing to empty it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LexiconChange {
    /// The name.
    pub name: Option<String>,
    /// The sign language, as a code of ISO 639-3.
    pub language: Option<Option<String>>,
    /// The version.
    pub version: Option<Option<String>>,
    /// The terms under which it may be used.
    pub terms: Option<Option<String>>,
    /// How to cite it.
    pub citation: Option<Option<String>>,
    /// Remarks.
    pub notes: Option<Option<String>>,
}

/// The recordings that are linked to a lexicon.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LinkedRecordings {
    /// These.
    Named(Vec<RowName>),
    /// All of the corpus.
    All,
}

impl Corpus {
    /// Returns the lexicons by name, each with what it holds.
    ///
    /// # Errors
    /// Fails if the corpus cannot be read.
    pub fn list_lexicons(&self) -> CorpusResult<Vec<LexiconContents>> {
        lexicons::load_lexicon_contents(self.store.read_connection())
    }

    /// Changes a lexicon, and returns it.
    ///
    /// # Errors
    /// Fails if there is no such lexicon, another has the new name, or the language is no code.
    pub fn change_lexicon(&mut self, name: &str, change: &LexiconChange) -> CorpusResult<LexiconRow> {
        self.store.run_store_operation(|connection| {
            let mut row = require_lexicon(connection, name)?;
            if let Some(new_name) = &change.name {
                let new_name = check_lexicon_name(new_name)?;
                if lexicons::find_lexicon(connection, &new_name)?.is_some_and(|other| other.id != row.id) {
                    return Err(
                        CorpusError::from_wrong_message(format!("another lexicon is called {new_name:?}"))
                            .with_error_place(new_name)
                            .with_advice("choose another name"),
                    );
                }
                row.name = new_name;
            }
            if let Some(code) = &change.language {
                row.language = code.as_deref().map(check_sign_language).transpose()?;
            }
            for (field, new_text) in [
                (&mut row.version, &change.version),
                (&mut row.terms, &change.terms),
                (&mut row.citation, &change.citation),
                (&mut row.notes, &change.notes),
            ] {
                if let Some(new_text) = new_text {
                    field.clone_from(new_text);
                }
            }
            lexicons::update_lexicon(connection, &row)?;
            let effect = OperationEffect::ChangeLexicon {
                lexicon: row.name.clone(),
            };
            Ok((row, effect))
        })
    }

    /// Removes a lexicon to which no sign belongs. Recordings that were linked to it are linked to none.
    ///
    /// # Errors
    /// Fails if there is no such lexicon, or it has signs.
    pub fn remove_lexicon(&mut self, name: &str) -> CorpusResult<LexiconRow> {
        self.store.run_store_operation(|connection| {
            let row = require_lexicon(connection, name)?;
            let contents = lexicons::load_lexicon_contents(connection)?;
            let signs = contents.iter().find(|lexicon| lexicon.lexicon.id == row.id);
            let signs = signs.map_or(0, |lexicon| lexicon.signs);
            if signs > 0 {
                let text = format!("the lexicon {:?} has {signs} signs", row.name);
                return Err(CorpusError::from_wrong_message(text)
                    .with_error_place(&row.name)
                    .with_command_advice("delete its signs first with `chereme delete CORPUS sign:NAME/GLOSS`, make it one with another with `chereme lexicon CORPUS unite NAME --into OTHER`, or import its table again with --lexicon"));
            }
            lexicons::delete_lexicon(connection, row.id)?;
            let effect = OperationEffect::RemoveLexicon {
                lexicon: row.name.clone(),
            };
            Ok((row, effect))
        })
    }

    /// Looks up the glosses of recordings in a lexicon from now on, or in none, and returns the names of the recordings
    /// for which that is new.
    ///
    /// # Errors
    /// Fails if there is no such lexicon or recording.
    pub fn link_lexicon(
        &mut self,
        lexicon: Option<&str>,
        recordings: &LinkedRecordings,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<String>> {
        let ids = self.linked_recording_ids(recordings)?;
        self.store.operation_with_progress(progress, |connection, progress| {
            let lexicon = lexicon.map(|name| require_lexicon(connection, name)).transpose()?;
            let total = Some(ids.len() as u64);
            let mut names = Vec::new();
            for (done, id) in ids.iter().enumerate() {
                progress.report_amount(ProgressUnit::Items, "recordings", done as u64, total)?;
                // A recording that is linked already keeps its tokens.
                if lexicons::link_recording(connection, *id, lexicon.as_ref().map(|row| row.id))? {
                    let inventories = inventories::load_of(connection, *id)?;
                    // The glosses may now be those of other signs.
                    tokens::derive_with_progress(connection, *id, None, &inventories, progress)?;
                    names.push(stored_recordings::load_recording_row(connection, *id)?.name);
                }
            }
            let recordings = names.len() as u64;
            let effect = match lexicon {
                Some(LexiconRow { name: lexicon, .. }) => OperationEffect::LinkLexicon { lexicon, recordings },
                None => OperationEffect::UnlinkLexicon { recordings },
            };
            Ok((names, effect))
        })
    }

    fn linked_recording_ids(&self, recordings: &LinkedRecordings) -> CorpusResult<BTreeSet<i64>> {
        let connection = self.store.read_connection();
        match recordings {
            LinkedRecordings::Named(names) => {
                let found = names
                    .iter()
                    .map(|name| address::find_recording_by_name(connection, name));
                found.map(|row| Ok(row?.id)).collect()
            }
            LinkedRecordings::All => {
                let rows = stored_recordings::load_recording_rows(connection)?;
                Ok(rows.into_iter().map(|row| row.id).collect())
            }
        }
    }
}

/// Returns the lexicon of this name.
pub(crate) fn require_lexicon(connection: &Connection, name: &str) -> CorpusResult<LexiconRow> {
    if let Some(row) = lexicons::find_lexicon(connection, name)? {
        return Ok(row);
    }
    let rows = lexicons::load_lexicon_rows(connection)?;
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    let error = CorpusError::from_wrong_message(format!("no lexicon is called {name:?}"))
        .with_error_place(name)
        .with_meant_name(nearest_candidate(name, names.iter().copied()).map(|near| MeantName {
            written: name.to_owned(),
            right: near.to_owned(),
        }));
    Err(error.with_advice(match names.as_slice() {
        [] => ErrorRemedy::command_remedy("the corpus has no lexicon: import a table or notation with --lexicon NAME"),
        names => ErrorRemedy::from(format!("the lexicons are: {}", names.join(", "))),
    }))
}

/// Returns the name of a lexicon without spaces around it.
///
/// # Errors
/// Fails if nothing is left, or if it has the stroke that parts lexicon and sign in an address.
pub(crate) fn check_lexicon_name(name: &str) -> CorpusResult<String> {
    let name = name.trim();
    // The stroke parts lexicon and sign in an address.
    if name.is_empty() || name.contains('/') {
        return Err(
            CorpusError::from_wrong_message(format!("{name:?} cannot be the name of a lexicon"))
                .with_error_place(name)
                .with_advice("write a name without /, such as NGT; a sign is then NGT/BOOK"),
        );
    }
    Ok(name.to_owned())
}

/// Returns the code of a sign language in small letters.
///
/// # Errors
/// Fails if it has not the form of ISO 639-3: three letters.
pub(crate) fn check_sign_language(code: &str) -> CorpusResult<String> {
    let code = code.trim().to_lowercase();
    if code.len() == 3 && code.bytes().all(|letter| letter.is_ascii_lowercase()) {
        return Ok(code);
    }
    Err(
        CorpusError::from_wrong_message(format!("{code:?} is no code of a sign language"))
            .with_error_place(code)
            .with_advice("write the three letters of ISO 639-3: ase for American, dse for Dutch, fsl for French, gsg for German Sign Language"),
    )
}

/// Returns the rows whose signs belong to the lexicons of a scope. `sign_of` gives the sign of a row.
///
/// # Errors
/// [`LexiconScope::Single`] fails if the rows belong to several lexicons.
pub(crate) fn keep_scope_rows<T>(
    connection: &Connection,
    scope: &LexiconScope,
    mut rows: Vec<T>,
    sign_of: impl Fn(&T) -> i64,
) -> CorpusResult<Vec<T>> {
    if *scope == LexiconScope::Across {
        return Ok(rows);
    }
    let lexicons = lexicons::load_lexicon_rows(connection)?;
    if let LexiconScope::Named(name) = scope {
        let lexicon = require_lexicon(connection, name)?.id;
        let of_signs = signs::lexicons_of_signs(connection)?;
        rows.retain(|row| of_signs.get(&sign_of(row)) == Some(&lexicon));
        return Ok(rows);
    }
    // Without several lexicons the signs cannot be mixed, which spares reading them all.
    if lexicons.len() < 2 {
        return Ok(rows);
    }
    let of_signs = signs::lexicons_of_signs(connection)?;
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for lexicon in rows.iter().filter_map(|row| of_signs.get(&sign_of(row))) {
        *counts.entry(*lexicon).or_default() += 1;
    }
    if counts.len() < 2 {
        return Ok(rows);
    }
    let named = lexicons
        .iter()
        .filter_map(|row| Some((&row.name, counts.get(&row.id)?)));
    let list: Vec<String> = named.map(|(name, count)| format!("{name} ({count})")).collect();
    Err(
        CorpusError::from_wrong_message(format!("these signs belong to several lexicons: {}", list.join(", ")))
            .with_command_advice("choose one with --lexicon NAME, or take all of them as one with --across"),
    )
}
