//! Signs as notation: those in the corpus, and those in files beside it.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use chereme_formats::{Finding, hns, sigml};
use chereme_sign::hamnosys::Notated;
use chereme_sign::{Choice, Remedy};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::notations::{self, NotationRow};
use crate::db::{damaged, recipes, signs};
use crate::error::{Error, Result};

/// The most bytes of a file that are read to recognise its kind.
const LOOKED_AT: u64 = 1 << 16;
/// The longest file of notation that is read from beside a corpus, in bytes.
const MOST_BYTES: u64 = 1 << 26;

/// A token as notation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Notation {
    /// The row of the token.
    pub token: i64,
    /// `hamnosys` or `sigml`.
    pub system: String,
    /// The file that it came from, without its folder.
    pub file: Option<String>,
    /// The line of the file on which it starts, from 1.
    pub line: Option<i64>,
    /// The HamNoSys text as it was written, if it is HamNoSys.
    pub text: Option<String>,
    /// Actions of hands, face and body, and further contents of the file.
    pub document: Notated,
}

impl Corpus {
    /// Returns the notation of the token at an address, or of a sign: that of its citation form, otherwise that of the
    /// first of its tokens that has one, otherwise that from which it was generated.
    ///
    /// # Errors
    /// Fails if the address names no token or sign, or nothing notated.
    pub fn notation(&self, address: &Address) -> Result<Notation> {
        find(self.store.read(), address)
    }

    /// Returns the notations for a name: those of an imported file with this name (`BABY.sigml`, or `BABY`), in the
    /// order of the file; otherwise that of an address. If the file holds several signs, `BABY` is the one with that
    /// gloss.
    ///
    /// # Errors
    /// Fails if no file has the name, and it names nothing notated.
    pub fn notations(&self, name: &str) -> Result<Vec<Notation>> {
        named(self.store.read(), name)
    }
}

/// Returns the notations of the file of this name, otherwise of an address. If `NAME.sigml` holds several signs and one
/// of them is `NAME`, only that sign is returned.
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

/// Returns the notation of the object at an address, or that from which it was generated.
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
    let ids: Vec<i64> = tokens.iter().map(|token| token.id).collect();
    let mut generated = of_recipes(connection, &ids)?;
    if let Some(found) = ids.iter().find_map(|id| generated.remove(id)) {
        return Ok(found);
    }
    Err(Error::wrong(format!("{address} has no notation"))
        .at(address.to_string())
        .advise(Remedy::choice(Choice::Notation, "import a SiGML file or a HamNoSys lexicon that holds the sign, or `chereme transcribe CORPUS SIGN --store`")))
}

/// Returns the notation of a token, if it has one.
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

/// Returns the notations from which these tokens were generated, by token. A sign that was changed after that, a
/// sequence of signs, and a recording with several tokens have none.
pub(crate) fn of_recipes(
    connection: &Connection,
    tokens: &[i64],
) -> Result<BTreeMap<i64, Notation>> {
    let mut found = BTreeMap::new();
    for ids in tokens.chunks(signs::AT_ONCE) {
        for row in recipes::of_lone_tokens(connection, ids)? {
            let (token, gloss, document) = row;
            let inputs: Value = serde_json::from_str(&document)
                .map_err(|error| damaged(format!("recipe of token {token}"), error.to_string()))?;
            for system in ["hamnosys", "sigml"] {
                let of = inputs["recipe"]["make"].get(system).map(|_| {
                    let answer = &inputs["inputs"][format!("/{system}/of")]["notation"];
                    Vec::<Notated>::deserialize(answer).unwrap_or_default()
                });
                let Some([document]) = of.as_deref() else {
                    continue;
                };
                let document = Notated {
                    gloss: gloss.clone(),
                    ..document.clone()
                };
                let own = Notation {
                    token,
                    system: system.to_owned(),
                    file: None,
                    line: None,
                    text: document.text.clone(),
                    document,
                };
                found.insert(token, own);
            }
        }
    }
    Ok(found)
}

/// Reads the notation of a row.
pub(crate) fn read(row: NotationRow) -> Result<Notation> {
    let document: Notated = serde_json::from_str(&row.document)
        .map_err(|error| damaged(format!("notation {}", row.id), error.to_string()))?;
    // The sign may have another gloss now.
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

/// Format of a notation file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Form {
    /// SiGML, gestural or of symbols.
    Sigml,
    /// HamNoSys, one sign per line.
    Lines,
}

impl Form {
    /// Returns the format of a file, by the ending of its name; for `.xml` and `.txt`, which are ambiguous, by the
    /// first bytes.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "sigml" | "hsigml" => Some(Self::Sigml),
            "hns" => Some(Self::Lines),
            "xml" => (beginning(path).windows(6))
                .any(|six| six.eq_ignore_ascii_case(b"<sigml"))
                .then_some(Self::Sigml),
            "txt" => hns::holds_some(&beginning(path)).then_some(Self::Lines),
            _ => None,
        }
    }
}

/// Returns the first bytes of a file; nothing if it cannot be read.
fn beginning(path: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    if let Ok(file) = File::open(path) {
        // A failure to read is reported when the whole file is read.
        let _ = file.take(LOOKED_AT).read_to_end(&mut bytes);
    }
    bytes
}

/// Signs of a file, each with its line.
pub(crate) type Signs = Vec<(Notated, u64)>;

/// Returns the signs of a file, and findings about it.
pub(crate) fn read_signs(bytes: &[u8], form: Form) -> Result<(Signs, Vec<Finding>)> {
    let wrong = |error: &dyn std::error::Error| Error::wrong(error.to_string());
    Ok(match form {
        Form::Sigml => {
            let (signs, findings) = sigml::read(bytes).map_err(|error| {
                wrong(&error).advise("a SiGML file holds <hamgestural_sign> elements")
            })?;
            let signs = signs.into_iter().map(|entry| (entry.sign, entry.line.0));
            (signs.collect(), findings)
        }
        Form::Lines => {
            let (signs, findings) = hns::read(bytes).map_err(|error| {
                wrong(&error).advise("write a sign a line: the gloss, a tab, and HamNoSys")
            })?;
            let signs = signs.into_iter().map(|entry| (entry.sign, entry.line));
            (signs.collect(), findings)
        }
    })
}

/// Reads the signs of a file, SiGML or lines of HamNoSys, without a corpus, and returns them with findings about the
/// file.
///
/// # Errors
/// Fails if the file cannot be read, or holds no notation.
pub fn read_notation(path: &Path) -> Result<(Vec<Notated>, Vec<Finding>)> {
    let size = fs::metadata(path).map_err(|error| Error::file(path, error))?;
    if size.len() > MOST_BYTES {
        return Err(Error::wrong("it is too long for signs in a row")
            .at(path.display().to_string())
            .advise("import it, then animate its signs by gloss"));
    }
    let bytes = fs::read(path).map_err(|error| Error::file(path, error))?;
    let (signs, findings) = read_signs(&bytes, Form::of(path).unwrap_or(Form::Sigml))
        .map_err(|error| error.at(path.display().to_string()))?;
    Ok((signs.into_iter().map(|(sign, _)| sign).collect(), findings))
}
