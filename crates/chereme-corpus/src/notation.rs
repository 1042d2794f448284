//! Signs as notation: those that the corpus holds, and those of files beside it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use chereme_formats::{Finding, sigml};
use chereme_sign::hamnosys::Notated;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::notations::{self, NotationRow};
use crate::db::{damaged, signs};
use crate::error::{Error, Result};

/// A token as notation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Notation {
    /// The token.
    pub token: i64,
    /// `hamnosys` or `sigml`.
    pub system: String,
    /// The file that it came from, without its folder.
    pub file: Option<String>,
    /// The line of the file on which it starts, from 1.
    pub line: Option<i64>,
    /// The HamNoSys text as it was written, where it is HamNoSys.
    pub text: Option<String>,
    /// What hands, face and body do, and what the file said beside it.
    pub document: Notated,
}

impl Corpus {
    /// Returns the notation of what an address names: of a token, or of a sign's citation form, or else
    /// of the first of the sign's tokens that has one.
    ///
    /// # Errors
    /// Where the address names no token or sign, or nothing notated.
    pub fn notation(&self, address: &Address) -> Result<Notation> {
        find(self.store.read(), address)
    }

    /// Returns the notations that a name stands for: those of a file that was imported, by its name
    /// (`BABY.sigml`, or `BABY`), in the order of the file; or else that of an address. Where the file
    /// holds several signs, `BABY` is the one that is glossed so.
    ///
    /// # Errors
    /// Where no file has the name, and it names nothing notated.
    pub fn notations(&self, name: &str) -> Result<Vec<Notation>> {
        named(self.store.read(), name)
    }
}

/// Returns the notations of the file of this name, or else of an address. Where `NAME.sigml` holds
/// several signs and one of them is `NAME`, that sign is meant.
pub(crate) fn named(connection: &Connection, name: &str) -> Result<Vec<Notation>> {
    let name = name.trim();
    let of_file = |file: &str| -> Result<Vec<Notation>> {
        let rows = notations::of_file(connection, file)?;
        rows.into_iter().map(read).collect()
    };
    let whole = of_file(name)?;
    if !whole.is_empty() {
        return Ok(whole);
    }
    let all = of_file(&format!("{name}.sigml"))?;
    if all.is_empty() {
        return Ok(vec![find(connection, &name.parse()?)?]);
    }
    let (sign, others): (Vec<_>, Vec<_>) =
        (all.into_iter()).partition(|found| found.document.gloss == name);
    Ok(if sign.is_empty() { others } else { sign })
}

/// Returns the notation of what an address names.
pub(crate) fn find(connection: &Connection, address: &Address) -> Result<Notation> {
    let sign = match address {
        Address::Sign(Name::Number(id)) => Some(*id),
        Address::Sign(Name::Text(gloss)) | Address::Gloss(gloss) => {
            Some(address::sign(connection, gloss)?)
        }
        _ => None,
    };
    let tokens = match sign {
        Some(sign) => signs::tokens_of_sign(connection, sign)?,
        None => vec![address::token(connection, address)?],
    };
    for token in &tokens {
        if let Some(found) = of_token(connection, token.id)? {
            return Ok(found);
        }
    }
    Err(Error::wrong(format!("{address} has no notation"))
        .at(address.to_string())
        .advise("import a SiGML file or a HamNoSys lexicon that holds the sign"))
}

/// Returns the notation of a token, where it has one.
pub(crate) fn of_token(connection: &Connection, token: i64) -> Result<Option<Notation>> {
    let row = notations::of_token(connection, token)?;
    row.map(read).transpose()
}

/// Returns the notations of these tokens, by token.
pub(crate) fn of_tokens(
    connection: &Connection,
    tokens: &[i64],
) -> Result<BTreeMap<i64, Notation>> {
    let mut found = BTreeMap::new();
    for ids in tokens.chunks(signs::AT_ONCE) {
        for (token, row) in notations::of_tokens(connection, ids)? {
            found.insert(token, read(row)?);
        }
    }
    Ok(found)
}

/// Reads what a row holds.
pub(crate) fn read(row: NotationRow) -> Result<Notation> {
    let document: Notated = serde_json::from_str(&row.document)
        .map_err(|error| damaged(format!("notation {}", row.id), error.to_string()))?;
    // The sign may have another gloss by now.
    let document = Notated {
        gloss: row.gloss,
        ..document
    };
    Ok(Notation {
        token: row.token_id,
        system: row.system,
        file: row.file,
        line: row.line,
        text: row.text,
        document,
    })
}

/// Reads the signs of a SiGML file that need not be in any corpus, and what is odd about it.
///
/// # Errors
/// Where the file cannot be read, or is no SiGML.
pub fn read_notation(path: &Path) -> Result<(Vec<Notated>, Vec<Finding>)> {
    let bytes = fs::read(path).map_err(|error| Error::file(path, error))?;
    let (signs, findings) = sigml::read(&bytes).map_err(|error| {
        Error::wrong(error.to_string())
            .at(path.display().to_string())
            .advise("a SiGML file holds <hamgestural_sign> elements")
    })?;
    Ok((
        signs.into_iter().map(|entry| entry.sign).collect(),
        findings,
    ))
}
