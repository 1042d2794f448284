//! Exports notated tokens as SiGML and as HamNoSys text.

use std::collections::BTreeMap;

use chereme_formats::{hns, sigml};
use chereme_sign::hamnosys::NotatedSign;
use rusqlite::Connection;

use super::ExportJob;
use crate::db::signs::MAX_ROWS_PER_QUERY;
use crate::error::{CorpusError, CorpusResult};
use crate::notation;
use crate::progress::ProgressReceiver;
use crate::words::format_noun_count;

/// Format of written notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NotationFileFormat {
    /// Gestural SiGML.
    Gestural,
    /// H-SiGML.
    Symbols,
    /// One line for each sign: the gloss, a tab, and HamNoSys.
    Text,
}

/// Writes the notation of tokens; a note gives the number of tokens without notation.
pub(super) fn write_token_notations(
    job: &mut ExportJob<'_, '_>,
    tokens: &[i64],
    form: NotationFileFormat,
) -> CorpusResult<()> {
    let signs = load_notated_tokens(job.connection, tokens, job.progress)?;
    let without = tokens.len() - signs.len();
    if signs.is_empty() {
        return Err(CorpusError::from_wrong_message("none of these tokens has a notation")
            .with_command_advice("`chereme list CORPUS tokens --where notation=*` lists those that have one")
            .into_lacking_content());
    }
    if without > 0 {
        job.notes.push(format!(
            "{} without notation: left out",
            format_noun_count(without as u64, "tokens")
        ));
    }
    let (bytes, lost) = match form {
        NotationFileFormat::Gestural => (sigml::write_gestural(&signs), Vec::new()),
        NotationFileFormat::Symbols => sigml::write_symbols(&signs),
        NotationFileFormat::Text => hns::write_hns(&signs),
    };
    note_lost(&signs, &lost, job.notes);
    job.out
        .write_all(&bytes)
        .map_err(|error| CorpusError::from_wrong_message(format!("the file cannot be written: {error}")))
}

fn load_notated_tokens(
    connection: &Connection,
    tokens: &[i64],
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<Vec<NotatedSign>> {
    let mut signs = Vec::new();
    for (part, ids) in tokens.chunks(MAX_ROWS_PER_QUERY).enumerate() {
        let mut notations = notation::of_recipes(connection, ids)?;
        // The notation of the token itself counts before the one that it was generated from.
        notations.extend(notation::of_tokens(connection, ids)?);
        signs.extend(ids.iter().filter_map(|id| Some(notations.remove(id)?.document)));
        progress.report_items("notation", part * MAX_ROWS_PER_QUERY, tokens.len())?;
    }
    Ok(signs)
}

/// Adds a note for each kind of property that the file cannot hold, with its count and the first sign that has it.
fn note_lost(signs: &[NotatedSign], lost: &[Vec<String>], notes: &mut Vec<String>) {
    let mut kinds: BTreeMap<&str, (usize, &str)> = BTreeMap::new();
    for (sign, own) in signs.iter().zip(lost) {
        for message in own {
            kinds.entry(message).or_insert((0, &sign.gloss)).0 += 1;
        }
    }
    notes.extend(kinds.into_iter().map(|(message, (count, gloss))| {
        format!(
            "left out of {}, the first {gloss}: {message}",
            format_noun_count(count as u64, "signs")
        )
    }));
}
