//! Addresses: texts that name a recording, token, sign, signer, tier or annotation.

use std::fmt;
use std::str::FromStr;

use chereme_motion::{Instant, Span};
use chereme_sign::text::{fold, nearest};
use chereme_sign::{Choice, Remedy};
use rusqlite::Connection;

use crate::db::notations;
use crate::db::recordings::{self, RecordingRow, SignerRow};
use crate::db::signs::{self, TokenRow};
use crate::error::{Error, Meant, Result};

/// A row by its number or its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Name {
    /// `recording:3`.
    Number(i64),
    /// `recording:"NGT Thanks"`.
    Text(String),
}

impl Name {
    /// Reads the name of a recording where nothing else can be meant: `recording:3`, `recording:"NGT Thanks"`, or the
    /// bare name.
    ///
    /// # Errors
    /// Fails if the text is empty or names something other than a recording.
    pub fn of_recording(text: &str) -> Result<Self> {
        match text.parse()? {
            Address::Recording(name) => Ok(name),
            Address::Gloss(name) => Ok(Self::Text(name)),
            other => Err(Error::wrong(format!("{other} is no recording"))
                .at(text)
                .advise("write recording:3, or the name of a recording")),
        }
    }
}

/// The object that a text such as `token:41` names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Address {
    /// `recording:…`.
    Recording(Name),
    /// `token:…`, always a number.
    Token(i64),
    /// `sign:…`, the gloss or the number.
    Sign(Name),
    /// `signer:…`.
    Signer(Name),
    /// `tier:…`, always a number.
    Tier(i64),
    /// `annotation:…`, always a number.
    Annotation(i64),
    /// A bare gloss: the citation form of the sign; if movement is asked for and no sign has this gloss, a recording of
    /// this name.
    Gloss(String),
}

const FORMS: &str = "write token:41, recording:3, recording:\"NGT Thanks\", sign:LIMACE or a gloss";

impl FromStr for Address {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let text = text.trim();
        let wrong = |message: String| Error::wrong(message).at(text).advise(FORMS);
        let (kind, rest) = match text.split_once(':') {
            Some((kind, rest)) => (kind.to_lowercase(), rest.trim()),
            None => (String::new(), text),
        };
        let name = || {
            let bare = unquoted(rest);
            if bare.is_empty() {
                Err(wrong(format!("{text:?} names nothing after the colon")))
            } else if bare == rest
                && let Ok(number) = rest.parse()
            {
                Ok(Name::Number(number))
            } else {
                Ok(Name::Text(bare.to_owned()))
            }
        };
        let number = || match rest.parse::<i64>() {
            Ok(number) => Ok(number),
            Err(_) => Err(wrong(format!("{rest:?} is no number of a {kind}"))),
        };
        match kind.as_str() {
            "recording" => Ok(Self::Recording(name()?)),
            "sign" => Ok(Self::Sign(name()?)),
            "signer" => Ok(Self::Signer(name()?)),
            "token" => Ok(Self::Token(number()?)),
            "tier" => Ok(Self::Tier(number()?)),
            "annotation" => Ok(Self::Annotation(number()?)),
            _ => match unquoted(text) {
                "" => Err(wrong("an empty text names nothing".to_owned())),
                gloss => Ok(Self::Gloss(gloss.to_owned())),
            },
        }
    }
}

fn unquoted(text: &str) -> &str {
    text.strip_prefix('"')
        .and_then(|text| text.strip_suffix('"'))
        .unwrap_or(text)
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kind, name) = match self {
            Self::Token(number) => return write!(f, "token:{number}"),
            Self::Tier(number) => return write!(f, "tier:{number}"),
            Self::Annotation(number) => return write!(f, "annotation:{number}"),
            Self::Gloss(gloss) => return f.write_str(gloss),
            Self::Recording(name) => ("recording", name),
            Self::Sign(name) => ("sign", name),
            Self::Signer(name) => ("signer", name),
        };
        match name {
            Name::Number(number) => write!(f, "{kind}:{number}"),
            Name::Text(text) => write!(f, "{kind}:\"{text}\""),
        }
    }
}

/// A stretch of a recording that an address names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stretch {
    /// The recording.
    pub recording: RecordingRow,
    /// The named part of the recording.
    pub span: Span,
    /// The token, if the address names one.
    pub token: Option<TokenRow>,
}

/// Returns the token that `address` names: a token, or a sign's citation form.
pub(crate) fn token(connection: &Connection, address: &Address) -> Result<TokenRow> {
    match address {
        Address::Token(id) => signs::token(connection, *id),
        Address::Sign(Name::Number(id)) => citation(connection, *id, address),
        Address::Sign(Name::Text(gloss)) | Address::Gloss(gloss) => {
            citation(connection, sign(connection, gloss)?, address)
        }
        other => Err(Error::wrong(format!("{other} is no token"))
            .at(other.to_string())
            .advise("write token:41 or a gloss")),
    }
}

/// Returns the sign with exactly this gloss, otherwise the only one that differs from it in case and accents alone.
pub(crate) fn sign(connection: &Connection, gloss: &str) -> Result<i64> {
    if let Some(id) = signs::find_sign(connection, gloss)? {
        return Ok(id);
    }
    let glosses = signs::glosses(connection)?;
    let folded = fold(gloss);
    let alike: Vec<&String> = glosses
        .iter()
        .filter(|known| fold(known) == folded)
        .collect();
    match alike.as_slice() {
        [one] => Ok(signs::find_sign(connection, one)?.unwrap_or_default()),
        [] => {
            let near = nearest(gloss, glosses.iter().map(String::as_str));
            if let Some(row) = recordings::recording_named(connection, gloss)? {
                let address = Address::Recording(Name::Text(row.name));
                return Err(Error::wrong(format!("no sign is called {gloss:?}"))
                    .at(gloss)
                    .advise(format!("a recording has this name: write {address}")));
            }
            Err(Error::wrong(format!("no sign is called {gloss:?}"))
                .at(gloss)
                .meaning(meant(gloss, near))
                .advise(Remedy::command(
                    "`chereme list CORPUS signs` lists the glosses",
                )))
        }
        several => Err(ambiguous(
            gloss,
            several.iter().map(|gloss| format!("sign:\"{gloss}\"")),
        )),
    }
}

fn citation(connection: &Connection, sign: i64, address: &Address) -> Result<TokenRow> {
    let tokens = signs::tokens_of_sign(connection, sign)?;
    let cited: Vec<&TokenRow> = tokens.iter().filter(|token| token.citation).collect();
    let moving: Vec<&TokenRow> = cited
        .iter()
        .copied()
        .filter(|token| token.recording_id.is_some())
        .collect();
    match (moving.as_slice(), cited.as_slice(), tokens.as_slice()) {
        ([one], _, _) | ([], [one], _) => Ok((*one).clone()),
        ([], [], [one]) => Ok(one.clone()),
        ([], [], []) => Err(Error::wrong(format!("the sign {address} has no token"))
            .at(address.to_string())
            .advise("import or make one first")),
        _ => Err(ambiguous(
            &address.to_string(),
            tokens.iter().map(candidate),
        )),
    }
}

fn candidate(token: &TokenRow) -> String {
    match (&token.recording, token.start_us) {
        (Some(recording), Some(start)) => {
            format!(
                "token:{} ({recording:?} at {})",
                token.id,
                Instant::from_micros(start)
            )
        }
        _ => format!("token:{} (lexicon)", token.id),
    }
}

fn ambiguous(text: &str, candidates: impl Iterator<Item = String>) -> Error {
    let all: Vec<String> = candidates.collect();
    let shown = all.iter().take(12).cloned().collect::<Vec<_>>().join(", ");
    let more = if all.len() > 12 {
        format!(" and {} more", all.len() - 12)
    } else {
        String::new()
    };
    Error::wrong(format!(
        "{text:?} can mean {} things: {shown}{more}",
        all.len()
    ))
    .at(text)
    .advise("write which one")
}

/// Returns the slip between a name as written and one near to it.
fn meant(written: &str, near: Option<&str>) -> Option<Meant> {
    Some(Meant {
        written: written.to_owned(),
        right: near?.to_owned(),
    })
}

/// Returns the recording with this name or number.
pub(crate) fn recording(connection: &Connection, name: &Name) -> Result<RecordingRow> {
    match name {
        Name::Number(id) => recordings::recording(connection, *id),
        Name::Text(text) => {
            if let Some(row) = recordings::recording_named(connection, text)? {
                return Ok(row);
            }
            let all = recordings::recordings(connection)?;
            let near = nearest(text, all.iter().map(|row| row.name.as_str()));
            Err(Error::wrong(format!("no recording is called {text:?}"))
                .at(text)
                .meaning(meant(text, near))
                .advise(Remedy::command(
                    "`chereme list CORPUS recordings` lists them",
                )))
        }
    }
}

/// Returns the signer with this name or number.
pub(crate) fn signer(connection: &Connection, name: &Name) -> Result<SignerRow> {
    let found = match name {
        Name::Number(id) => recordings::signer(connection, *id)?,
        Name::Text(text) => recordings::find_signer(connection, text)?,
    };
    found.ok_or_else(|| {
        let all = recordings::signers(connection).unwrap_or_default();
        let known: Vec<&str> = all.iter().map(|signer| signer.name.as_str()).collect();
        let address = Address::Signer(name.clone()).to_string();
        let remedy = match known.as_slice() {
            [] => "the corpus knows no signer; a recording's body is recording:NAME".to_owned(),
            known => format!("the signers are: {}", known.join(", ")),
        };
        Error::wrong(format!("there is no {address}"))
            .at(address)
            .advise(remedy)
    })
}

/// Returns the stretch of movement that `address` names; a bare name that belongs to no sign may be a recording's name.
pub(crate) fn stretch(connection: &Connection, address: &Address) -> Result<Stretch> {
    let named = match address {
        Address::Recording(name) => Some(recording(connection, name)?),
        Address::Gloss(name) if sign(connection, name).is_err() => {
            recordings::recording_named(connection, name)?
        }
        _ => None,
    };
    if let Some(recording) = named {
        let span = Span::between(Instant::ZERO, Instant::from_micros(recording.duration_us));
        return Ok(Stretch {
            recording,
            span,
            token: None,
        });
    }
    let token = token(connection, address)?;
    let (Some(recording), Some(start), Some(end)) =
        (token.recording_id, token.start_us, token.end_us)
    else {
        let (known_by, remedy) = if notations::of_token(connection, token.id)?.is_some() {
            let remedy = Remedy::choice(
                Choice::Notation,
                "make it move first: `chereme animate CORPUS GLOSS --as NAME`",
            );
            ("is notation", remedy)
        } else {
            let remedy = Remedy::from("name a token that was recorded, such as token:41");
            ("is a lexicon entry", remedy)
        };
        return Err(
            Error::wrong(format!("{address} {known_by} without movement"))
                .at(address.to_string())
                .advise(remedy)
                .lacking(),
        );
    };
    Ok(Stretch {
        recording: recordings::recording(connection, recording)?,
        span: Span::between(Instant::from_micros(start), Instant::from_micros(end)),
        token: Some(token),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_read_as_written() {
        for (text, want) in [
            ("token:41", Address::Token(41)),
            ("recording:3", Address::Recording(Name::Number(3))),
            (
                "recording:\"NGT Thanks\"",
                Address::Recording(Name::Text("NGT Thanks".into())),
            ),
            (
                "recording:\"3\"",
                Address::Recording(Name::Text("3".into())),
            ),
            (
                "recording:NGT Thanks",
                Address::Recording(Name::Text("NGT Thanks".into())),
            ),
            ("sign:LIMACE", Address::Sign(Name::Text("LIMACE".into()))),
            ("INDEX:1", Address::Gloss("INDEX:1".into())),
            ("\"ÊTRE DÉGOÛTÉ\"", Address::Gloss("ÊTRE DÉGOÛTÉ".into())),
            ("signer:Anna", Address::Signer(Name::Text("Anna".into()))),
        ] {
            assert_eq!(text.parse::<Address>().ok(), Some(want), "{text}");
        }
        for (text, want) in [
            ("recording:3", Some(Name::Number(3))),
            ("recording:\"3\"", Some(Name::Text("3".into()))),
            ("3", Some(Name::Text("3".into()))),
            (" NGT Thanks ", Some(Name::Text("NGT Thanks".into()))),
            ("\"two\"", Some(Name::Text("two".into()))),
            ("token:41", None),
            ("sign:LIMACE", None),
            ("recording:", None),
            (" ", None),
        ] {
            assert_eq!(Name::of_recording(text).ok(), want, "{text}");
        }
        for bad in ["token:x", "recording:", "", "tier:a", "recording:\"\""] {
            assert!(bad.parse::<Address>().is_err(), "{bad}");
        }
    }
}
