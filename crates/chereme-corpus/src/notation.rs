//! Signs as notation: those in the corpus, and those in files beside it.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use chereme_formats::{ImportFinding, hns, sigml};
use chereme_sign::hamnosys::{NotatedSign, print_hamnosys};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::notations::{self, NotationRow};
use crate::db::{damaged_row_error, recipes, signs};
use crate::error::{CorpusError, CorpusResult};

/// The most bytes of a file that are read to recognise its kind.
const MAX_SNIFFED_BYTES: u64 = 1 << 16;
/// The longest file of notation that is read from beside a corpus, in bytes.
const MAX_NOTATION_FILE_BYTES: u64 = 1 << 26;

/// A token as notation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TokenNotation {
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
    pub document: NotatedSign,
}

impl Corpus {
    /// Returns the notation of the token at an address, or of a sign: that of its citation form, otherwise that of the
    /// first of its tokens that has one, otherwise that from which it was generated.
    ///
    /// # Errors
    /// Fails if the address names no token or sign, or nothing notated.
    pub fn notation_at(&self, address: &CorpusAddress) -> CorpusResult<TokenNotation> {
        find_address_notation(self.store.read_connection(), address)
    }

    /// Returns the notations for a name: those of an imported file with this name (`BABY.sigml`, or `BABY`), in the
    /// order of the file; otherwise that of an address. If the file holds several signs, `BABY` is the one with that
    /// gloss.
    ///
    /// # Errors
    /// Fails if no file has the name, and it names nothing notated.
    pub fn notations_named(&self, name: &str) -> CorpusResult<Vec<TokenNotation>> {
        find_named_notations(self.store.read_connection(), name)
    }
}

/// Returns the notations of the file of this name, otherwise of an address. If `NAME.sigml` holds several signs and one
/// of them is `NAME`, only that sign is returned.
pub(crate) fn find_named_notations(connection: &Connection, name: &str) -> CorpusResult<Vec<TokenNotation>> {
    let name = name.trim();
    let of_file = |file: &str| -> CorpusResult<Vec<TokenNotation>> {
        let rows = notations::of_file(connection, file)?;
        rows.into_iter().map(read_notation_row).collect()
    };
    let file_notations = of_file(name)?;
    if !file_notations.is_empty() {
        return Ok(file_notations);
    }
    let all = of_file(&format!("{name}.sigml"))?;
    if all.is_empty() {
        return Ok(vec![find_address_notation(connection, &name.parse()?)?]);
    }
    let (sign, others): (Vec<_>, Vec<_>) = (all.into_iter()).partition(|found| found.document.gloss == name);
    // A file that holds a sign of its own name means that one.
    Ok(if sign.is_empty() { others } else { sign })
}

/// Returns the notation of the object at an address, or that from which it was generated.
pub(crate) fn find_address_notation(connection: &Connection, address: &CorpusAddress) -> CorpusResult<TokenNotation> {
    let sign = match address {
        CorpusAddress::Sign(RowName::Number(id)) => Some(*id),
        CorpusAddress::Sign(RowName::Text(gloss)) | CorpusAddress::Gloss(gloss) => {
            Some(address::find_sign_by_gloss(connection, gloss)?)
        }
        _ => None,
    };
    let tokens = match sign {
        Some(sign) => signs::tokens_of_sign(connection, sign)?,
        None => vec![address::find_addressed_token(connection, address)?],
    };
    // The citation form comes first among the tokens.
    for token in &tokens {
        if let Some(found) = notation_of_token(connection, token.id)? {
            return Ok(found);
        }
    }
    let ids: Vec<i64> = tokens.iter().map(|token| token.id).collect();
    let mut generated = of_recipes(connection, &ids)?;
    if let Some(found) = ids.iter().find_map(|id| generated.remove(id)) {
        return Ok(found);
    }
    Err(CorpusError::from_wrong_message(format!("{address} has no notation"))
        .with_error_place(address.to_string())
        .with_advice(ErrorRemedy::choice_remedy(RemedyChoice::Notation, "import a SiGML file or a HamNoSys lexicon that holds the sign, or `chereme transcribe CORPUS SIGN --store`")))
}

/// Returns the notation of a token, if it has one.
pub(crate) fn notation_of_token(connection: &Connection, token: i64) -> CorpusResult<Option<TokenNotation>> {
    let row = notations::find_token_notation(connection, token)?;
    row.map(read_notation_row).transpose()
}

/// Returns the notations of these tokens, by token.
pub(crate) fn of_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, TokenNotation>> {
    let mut by_token = BTreeMap::new();
    for ids in tokens.chunks(signs::MAX_ROWS_PER_QUERY) {
        for (token, row) in notations::of_tokens(connection, ids)? {
            by_token.insert(token, read_notation_row(row)?);
        }
    }
    Ok(by_token)
}

/// Returns the notations from which these tokens were generated, by token. A sign that was changed after that, a
/// sequence of signs, and a recording with several tokens have none.
pub(crate) fn of_recipes(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, TokenNotation>> {
    let mut by_token = BTreeMap::new();
    for ids in tokens.chunks(signs::MAX_ROWS_PER_QUERY) {
        for row in recipes::of_lone_tokens(connection, ids)? {
            let (token, gloss, document) = row;
            let inputs: Value = serde_json::from_str(&document)
                .map_err(|error| damaged_row_error(format!("recipe of token {token}"), error.to_string()))?;
            for system in ["hamnosys", "sigml"] {
                let of = inputs["recipe"]["make"].get(system).map(|_| {
                    let answer = &inputs["inputs"][format!("/{system}/of")]["notation"];
                    Vec::<NotatedSign>::deserialize(answer).unwrap_or_default()
                });
                // A sequence of signs is no notation of one token.
                let Some([document]) = of.as_deref() else {
                    continue;
                };
                let document = NotatedSign {
                    gloss: gloss.clone(),
                    ..document.clone()
                };
                let notation = TokenNotation {
                    token,
                    system: system.to_owned(),
                    file: None,
                    line: None,
                    text: document.text.clone(),
                    document,
                };
                by_token.insert(token, notation);
            }
        }
    }
    Ok(by_token)
}

/// Returns the tokens whose notation passes a test as HamNoSys; SiGML is written as HamNoSys for it.
pub(crate) fn tokens_with_notation(connection: &Connection, passes: impl Fn(&str) -> bool) -> CorpusResult<Vec<i64>> {
    let mut tokens = Vec::new();
    notations::visit_each_notation(connection, |row| {
        let token = row.token_id;
        let text = match &row.text {
            Some(text) => text.clone(),
            None => print_hamnosys(&read_notation_row(row)?.document.sign).text,
        };
        tokens.extend(passes(&text).then_some(token));
        Ok(())
    })?;
    Ok(tokens)
}

/// Reads the notation of a row.
pub(crate) fn read_notation_row(row: NotationRow) -> CorpusResult<TokenNotation> {
    let parsed: NotatedSign = serde_json::from_str(&row.document)
        .map_err(|error| damaged_row_error(format!("notation {}", row.id), error.to_string()))?;
    // The sign may have another gloss now.
    let document = NotatedSign {
        gloss: row.gloss,
        ..parsed
    };
    Ok(TokenNotation {
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
pub(crate) enum NotationFormat {
    /// SiGML, gestural or of symbols.
    Sigml,
    /// HamNoSys, one sign per line.
    Lines,
}

impl NotationFormat {
    /// Returns the format of a file, by the ending of its name; for `.xml` and `.txt`, which are ambiguous, by the
    /// first bytes.
    pub(crate) fn from_notation_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "sigml" | "hsigml" => Some(Self::Sigml),
            "hns" => Some(Self::Lines),
            "xml" => (read_notation_beginning(path).windows(6))
                .any(|six| six.eq_ignore_ascii_case(b"<sigml"))
                .then_some(Self::Sigml),
            "txt" => hns::holds_some(&read_notation_beginning(path)).then_some(Self::Lines),
            _ => None,
        }
    }
}

/// Returns the first bytes of a file; nothing if it cannot be read.
fn read_notation_beginning(path: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    if let Ok(file) = File::open(path) {
        // A failure to read is reported when the whole file is read.
        let _ = file.take(MAX_SNIFFED_BYTES).read_to_end(&mut bytes);
    }
    bytes
}

/// Signs of a file, each with its line.
pub(crate) type NotatedSigns = Vec<(NotatedSign, u64)>;

/// Returns the signs of a file, and findings about it.
pub(crate) fn read_signs(bytes: &[u8], form: NotationFormat) -> CorpusResult<(NotatedSigns, Vec<ImportFinding>)> {
    let wrong = |error: &dyn std::error::Error| CorpusError::from_wrong_message(error.to_string());
    Ok(match form {
        NotationFormat::Sigml => {
            let (signs, findings) = sigml::read_sigml_signs(bytes)
                .map_err(|error| wrong(&error).with_advice("a SiGML file holds <hamgestural_sign> elements"))?;
            let signs = signs.into_iter().map(|entry| (entry.sign, entry.line.0));
            (signs.collect(), findings)
        }
        NotationFormat::Lines => {
            let (signs, findings) = hns::read_hns(bytes)
                .map_err(|error| wrong(&error).with_advice("write a sign a line: the gloss, a tab, and HamNoSys"))?;
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
pub fn read_notation(path: &Path) -> CorpusResult<(Vec<NotatedSign>, Vec<ImportFinding>)> {
    let size = fs::metadata(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    // The whole file is read at once.
    if size.len() > MAX_NOTATION_FILE_BYTES {
        return Err(CorpusError::from_wrong_message("it is too long for signs in a row")
            .with_error_place(path.display().to_string())
            .with_advice("import it, then animate its signs by gloss"));
    }
    let bytes = fs::read(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    let (signs, findings) = read_signs(
        &bytes,
        NotationFormat::from_notation_path(path).unwrap_or(NotationFormat::Sigml),
    )
    .map_err(|error| error.with_error_place(path.display().to_string()))?;
    Ok((signs.into_iter().map(|(sign, _)| sign).collect(), findings))
}
