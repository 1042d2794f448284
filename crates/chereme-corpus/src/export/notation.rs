//! Exports notated tokens as SiGML and as HamNoSys text.

use std::collections::BTreeMap;
use std::io::Write;

use chereme_formats::{hns, sigml};
use chereme_sign::Remedy;
use chereme_sign::hamnosys::Notated;
use rusqlite::Connection;

use crate::db::signs::AT_ONCE;
use crate::error::{Error, Result};
use crate::notation;
use crate::progress::{Progress, Step, Unit};
use crate::words::counted;

/// Format of written notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Gestural SiGML.
    Gestural,
    /// H-SiGML.
    Symbols,
    /// One line for each sign: the gloss, a tab, and HamNoSys.
    Text,
}

/// Writes the notation of tokens; a note gives the number of tokens without notation.
pub(super) fn write(
    connection: &Connection,
    tokens: &[i64],
    form: Form,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let signs = notated(connection, tokens, progress)?;
    let without = tokens.len() - signs.len();
    if signs.is_empty() {
        return Err(Error::wrong("none of these tokens has a notation")
            .advise(Remedy::command(
                "`chereme list CORPUS tokens --where notation=*` lists those that have one",
            ))
            .lacking());
    }
    if without > 0 {
        notes.push(format!(
            "{} without notation: left out",
            counted(without as u64, "tokens")
        ));
    }
    let (bytes, lost) = match form {
        Form::Gestural => (sigml::write_gestural(&signs), Vec::new()),
        Form::Symbols => sigml::write_symbols(&signs),
        Form::Text => hns::write(&signs),
    };
    note_lost(&signs, &lost, notes);
    out.write_all(&bytes)
        .map_err(|error| Error::wrong(format!("the file cannot be written: {error}")))
}

fn notated(
    connection: &Connection,
    tokens: &[i64],
    progress: &mut Progress<'_>,
) -> Result<Vec<Notated>> {
    let mut signs = Vec::new();
    for (part, ids) in tokens.chunks(AT_ONCE).enumerate() {
        let mut found = notation::of_recipes(connection, ids)?;
        found.extend(notation::of_tokens(connection, ids)?);
        signs.extend(ids.iter().filter_map(|id| Some(found.remove(id)?.document)));
        progress.report(Step {
            task: "notation",
            done: (part * AT_ONCE) as u64,
            total: Some(tokens.len() as u64),
            unit: Unit::Items,
        })?;
    }
    Ok(signs)
}

/// Adds a note for each kind of property that the file cannot hold, with its count and the first sign that has it.
fn note_lost(signs: &[Notated], lost: &[Vec<String>], notes: &mut Vec<String>) {
    let mut kinds: BTreeMap<&str, (usize, &str)> = BTreeMap::new();
    for (sign, own) in signs.iter().zip(lost) {
        for message in own {
            kinds.entry(message).or_insert((0, &sign.gloss)).0 += 1;
        }
    }
    notes.extend(kinds.into_iter().map(|(message, (count, gloss))| {
        format!(
            "left out of {}, the first {gloss}: {message}",
            counted(count as u64, "signs")
        )
    }));
}
