//! Lexicons made one: entries that correspond are joined, all others move.

use rusqlite::Connection;
use serde::Serialize;

use super::entry_match::{self, EntryPlace};
use super::require_lexicon;
use crate::Corpus;
use crate::db::lexicons::{self, LexiconRow};
use crate::db::{edits, sign_relations, signs, stored_delete};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::progress::ProgressReceiver;
use crate::tokens;
use crate::words::effect::OperationEffect;

/// The result of making lexicons one.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct UnitedLexicons {
    /// The lexicon that stays.
    pub into: String,
    /// The lexicons that went.
    pub united: Vec<String>,
    /// The number of entries that moved and were joined with none.
    pub moved: u64,
    /// The number of entries that were joined with one of the lexicon that stays.
    pub joined: u64,
    /// Those of them that are coded differently, by gloss; both codings were kept.
    pub differing: Vec<String>,
    /// Entries that have another number now, as `BANK is BANK#2`.
    pub renumbered: Vec<String>,
}

impl Corpus {
    /// Makes lexicons one as one operation: their entries, the recordings that are linked to them and their files belong to
    /// `into` afterwards. Entries are the same if their rows have the same id, otherwise by gloss and number; the tokens,
    /// translations and remarks of both are kept.
    ///
    /// # Errors
    /// Fails if one of them does not exist, or if they differ in language, version, terms or citation.
    pub fn unite_lexicons(
        &mut self,
        from: &[String],
        into: &str,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<UnitedLexicons> {
        self.store.operation_with_progress(progress, |connection, progress| {
            let mut kept = require_lexicon(connection, into)?;
            let mut report = UnitedLexicons {
                into: kept.name.clone(),
                ..UnitedLexicons::default()
            };
            for name in from {
                let gone = require_lexicon(connection, name)?;
                if gone.id == kept.id {
                    continue;
                }
                take_over_fields(&mut kept, &gone)?;
                let entries = signs::entries_of_lexicon(connection, gone.id)?;
                for (done, sign) in entries.iter().enumerate() {
                    progress.report_items("signs", done, entries.len())?;
                    unite_entry(connection, *sign, kept.id, &mut report)?;
                }
                lexicons::replace_lexicon(connection, gone.id, kept.id)?;
                report.united.push(gone.name);
            }
            if report.united.is_empty() {
                return Err(CorpusError::from_wrong_message(format!(
                    "there is no lexicon to make one with {}",
                    kept.name
                ))
                .with_error_place(&kept.name)
                .with_advice("name at least one other lexicon"));
            }
            lexicons::update_lexicon(connection, &kept)?;
            // Glosses that no lexicon had may be entries now.
            for recording in lexicons::recordings_of_lexicon(connection, kept.id)? {
                let inventories = inventories::load_of(connection, recording)?;
                tokens::derive_with_progress(connection, recording, None, &inventories, progress)?;
            }
            let effect = OperationEffect::UniteLexicons {
                names: report.united.clone(),
                lexicon: kept.name,
            };
            Ok((report, effect))
        })
    }
}

/// Takes what one lexicon says over into another that does not say it.
///
/// # Errors
/// Fails if they say different things: one of the two would be lost.
fn take_over_fields(kept: &mut LexiconRow, gone: &LexiconRow) -> CorpusResult<()> {
    let mut differences = Vec::new();
    for (name, own, other) in [
        ("language", &mut kept.language, &gone.language),
        ("version", &mut kept.version, &gone.version),
        ("terms", &mut kept.terms, &gone.terms),
        ("citation", &mut kept.citation, &gone.citation),
    ] {
        match (&*own, other) {
            (Some(own), Some(other)) if own != other => differences.push(format!("{name} ({own}, {other})")),
            (None, Some(other)) => *own = Some(other.clone()),
            _ => {}
        }
    }
    kept.notes = join_remarks(kept.notes.take(), gone.notes.clone());
    if differences.is_empty() {
        return Ok(());
    }
    let text = format!("{} and {} differ in: {}", kept.name, gone.name, differences.join(", "));
    Err(CorpusError::from_wrong_message(text)
        .with_error_place(&gone.name)
        .with_command_advice(
            "first give both the one that is true: `chereme lexicon CORPUS set NAME --language CODE`; --release, --terms and \
             --citation set the others",
        ))
}

fn join_remarks(own: Option<String>, other: Option<String>) -> Option<String> {
    match (own, other) {
        (Some(own), Some(other)) if own != other => Some(format!("{own}\n{other}")),
        (own, other) => own.or(other),
    }
}

fn unite_entry(connection: &Connection, sign: i64, kept: i64, report: &mut UnitedLexicons) -> CorpusResult<()> {
    let (gloss, notes) = edits::sign_gloss_and_notes(connection, sign)?;
    let label = signs::sign_label(connection, sign)?;
    let number = signs::entry_number(connection, sign)?;
    let ids = entry_match::sign_row_ids(connection, sign)?;
    let place = entry_match::find_entry_place(connection, Some(kept), (&gloss, number), &ids, |_| Ok(true))?;
    let there = match place {
        EntryPlace::Free(number) => {
            signs::move_entry(connection, sign, kept, number)?;
            report.moved += 1;
            sign
        }
        EntryPlace::Same(there) => there,
    };
    let new_label = signs::sign_label(connection, there)?;
    if signs::entry_number(connection, there)? != number {
        // Annotations keep meaning this entry, whose number is another one from now on.
        edits::replace_gloss_values(connection, sign, &label, &new_label)?;
        report.renumbered.push(format!("{label} is {new_label}"));
    }
    if there == sign {
        return Ok(());
    }
    report.joined += 1;
    let mut own_codings = Vec::new();
    for token in entry_match::lexicon_tokens(connection, there)? {
        own_codings.push(signs::load_token_values(connection, token.id)?);
    }
    for token in entry_match::lexicon_tokens(connection, sign)? {
        let values = signs::load_token_values(connection, token.id)?;
        let is_alike = |own: &Vec<_>| entry_match::are_codings_alike(own, &values);
        if !own_codings.is_empty() && !own_codings.iter().any(is_alike) && !report.differing.contains(&new_label) {
            report.differing.push(new_label.clone());
        }
    }
    for (language, text) in signs::list_sign_translations(connection, sign)? {
        signs::add_text(connection, there, &language, &text)?;
    }
    let (own_gloss, own_notes) = edits::sign_gloss_and_notes(connection, there)?;
    let own_number = signs::entry_number(connection, there)?;
    let joined_notes = join_remarks(own_notes, notes);
    edits::update_sign(connection, there, (&own_gloss, own_number), joined_notes.as_deref())?;
    signs::move_tokens(connection, sign, there)?;
    sign_relations::move_relations(connection, sign, there)?;
    stored_delete::delete_sign(connection, sign)
}
