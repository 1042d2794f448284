//! Addresses: texts that name a recording, token, sign, signer, tier or annotation.

pub(crate) mod message_names;

use std::fmt;
use std::str::FromStr;

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::text::{fold_text, nearest_candidate};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use rusqlite::Connection;

use crate::db::edits;
use crate::db::lexicons::{self, LexiconRow};
use crate::db::notations;
use crate::db::signs::{self, SignByLexicon, TokenRow};
use crate::db::stored_recordings::{self, RecordingRow, SignerRow};
use crate::db::stored_tiers;
use crate::error::{CorpusError, CorpusResult, MeantName};

/// A row by its number or its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RowName {
    /// `recording:3`.
    Number(i64),
    /// `recording:"NGT Thanks"`.
    Text(String),
}

impl RowName {
    /// Reads the name of a recording where nothing else can be meant: `recording:3`, `recording:"NGT Thanks"`, or the
    /// bare name.
    ///
    /// # Errors
    /// Fails if the text is empty or names something other than a recording.
    pub fn parse_recording_name(text: &str) -> CorpusResult<Self> {
        match text.parse()? {
            CorpusAddress::Recording(name) => Ok(name),
            CorpusAddress::Gloss(name) => Ok(Self::Text(name)),
            other => Err(CorpusError::from_wrong_message(format!("{other} is no recording"))
                .with_error_place(text)
                .with_advice("write recording:3, or the name of a recording")),
        }
    }
}

/// The object that a text such as `token:41` names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CorpusAddress {
    /// `recording:…`.
    Recording(RowName),
    /// `token:…`, always a number.
    Token(i64),
    /// `sign:…`, the gloss or the number.
    Sign(RowName),
    /// `signer:…`.
    Signer(RowName),
    /// `tier:…`, always a number.
    Tier(i64),
    /// `annotation:…`, always a number.
    Annotation(i64),
    /// A bare gloss: the citation form of the sign; if movement is asked for and no sign has this gloss, a recording of
    /// this name.
    Gloss(String),
}

const ADDRESS_FORMS: &str = "write token:41, recording:3, recording:\"NGT Thanks\", sign:LIMACE or a gloss";

impl FromStr for CorpusAddress {
    type Err = CorpusError;

    fn from_str(text: &str) -> CorpusResult<Self> {
        let text = text.trim();
        let wrong = |message: String| {
            CorpusError::from_wrong_message(message)
                .with_error_place(text)
                .with_advice(ADDRESS_FORMS)
        };
        let (kind, rest) = match text.split_once(':') {
            Some((kind, rest)) => (kind.to_lowercase(), rest.trim()),
            None => (String::new(), text),
        };
        let name = || {
            let bare = unquoted(rest);
            if bare.is_empty() {
                Err(wrong(format!("{text:?} names nothing after the colon")))
            // A number in quotes is a name that consists of digits.
            } else if bare == rest
                && let Ok(number) = rest.parse()
            {
                Ok(RowName::Number(number))
            } else {
                Ok(RowName::Text(bare.to_owned()))
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
            // A gloss may contain a colon, so an unknown kind is part of it.
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

impl fmt::Display for CorpusAddress {
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
            RowName::Number(number) => write!(f, "{kind}:{number}"),
            RowName::Text(text) => write!(f, "{kind}:\"{text}\""),
        }
    }
}

/// A stretch of a recording that an address names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordingStretch {
    /// The recording.
    pub recording: RecordingRow,
    /// The named part of the recording.
    pub span: TimeSpan,
    /// The token, if the address names one.
    pub token: Option<TokenRow>,
}

/// Returns the token that `address` names: a token, or a sign's citation form.
pub(crate) fn find_addressed_token(connection: &Connection, address: &CorpusAddress) -> CorpusResult<TokenRow> {
    match address {
        CorpusAddress::Token(id) => signs::load_token_row(connection, *id),
        CorpusAddress::Sign(RowName::Number(id)) => citation(connection, *id, address),
        CorpusAddress::Sign(RowName::Text(gloss)) | CorpusAddress::Gloss(gloss) => {
            citation(connection, find_sign_by_gloss(connection, gloss)?, address)
        }
        other => Err(CorpusError::from_wrong_message(format!("{other} is no token"))
            .with_error_place(other.to_string())
            .with_advice("write token:41 or a gloss")),
    }
}

/// Returns the sign with this number, or with this gloss.
pub(crate) fn find_sign_by_name(connection: &Connection, name: &RowName) -> CorpusResult<i64> {
    let id = match name {
        RowName::Text(gloss) => return find_sign_by_gloss(connection, gloss),
        RowName::Number(id) => *id,
    };
    match edits::sign_gloss_and_notes(connection, id) {
        Ok(_) => Ok(id),
        // Any other failure says nothing about whether the sign exists.
        Err(CorpusError::Database(rusqlite::Error::QueryReturnedNoRows)) => {
            Err(CorpusError::from_wrong_message(format!("there is no sign:{id}"))
                .with_error_place(format!("sign:{id}"))
                .with_command_advice("`chereme list CORPUS signs` lists them"))
        }
        Err(other) => Err(other),
    }
}

/// Returns the sign with exactly this gloss, otherwise the only one that differs from it in case and accents alone.
///
/// `NGT/BOOK` is the sign of that lexicon and `BOOK#2` the second entry of that gloss, unless a gloss is written so. A
/// gloss that several lexicons or entries have is an error with the candidates.
pub(crate) fn find_sign_by_gloss(connection: &Connection, gloss: &str) -> CorpusResult<i64> {
    // A gloss may itself contain a stroke, so the whole text comes first.
    if let Some(id) = find_only_sign(connection, gloss)? {
        return Ok(id);
    }
    if let Some((lexicon, gloss)) = gloss.split_once('/')
        && let Some(lexicon) = lexicons::find_lexicon(connection, lexicon.trim())?
    {
        return find_lexicon_entry(connection, &lexicon, gloss.trim());
    }
    let glosses = signs::list_all_glosses(connection)?;
    let folded = fold_text(gloss);
    let alike: Vec<&String> = glosses.iter().filter(|known| fold_text(known) == folded).collect();
    match alike.as_slice() {
        [one] => Ok(find_only_sign(connection, one)?.unwrap_or_default()),
        [] => {
            let near = nearest_candidate(gloss, glosses.iter().map(String::as_str));
            // Who names a recording here most likely forgot the kind of address.
            if let Some(row) = stored_recordings::recording_named(connection, gloss)? {
                let address = CorpusAddress::Recording(RowName::Text(row.name));
                return Err(CorpusError::from_wrong_message(format!("no sign is called {gloss:?}"))
                    .with_error_place(gloss)
                    .with_advice(format!("a recording has this name: write {address}")));
            }
            Err(missing_sign_error(gloss, near))
        }
        several => Err(ambiguous_name_error(
            gloss,
            several.iter().map(|gloss| format!("sign:\"{gloss}\"")),
        )),
    }
}

/// Returns the sign with exactly this gloss, if there is one.
///
/// # Errors
/// Fails if several lexicons or entries have it.
fn find_only_sign(connection: &Connection, gloss: &str) -> CorpusResult<Option<i64>> {
    match signs::find_signs_of_gloss(connection, gloss)?.as_slice() {
        [] => Ok(None),
        [one] => Ok(Some(one.id)),
        several => Err(ambiguous_name_error(gloss, lexicon_addresses(several, gloss))),
    }
}

/// Returns the addresses that keep signs of one gloss apart; the one that belongs to no lexicon is known by its number.
pub(crate) fn lexicon_addresses(signs: &[SignByLexicon], gloss: &str) -> impl Iterator<Item = String> {
    signs.iter().map(move |sign| {
        let is_namesake = |other: &SignByLexicon| other.id != sign.id && other.lexicon == sign.lexicon;
        let number = match signs.iter().any(is_namesake) {
            true => format!("#{}", sign.number),
            false => String::new(),
        };
        match &sign.lexicon {
            Some(lexicon) => CorpusAddress::Sign(RowName::Text(format!("{lexicon}/{gloss}{number}"))).to_string(),
            None => format!("sign:{} (in no lexicon)", sign.id),
        }
    })
}

fn find_lexicon_entry(connection: &Connection, lexicon: &LexiconRow, gloss: &str) -> CorpusResult<i64> {
    let mut signs = signs::find_signs_of_gloss(connection, gloss)?;
    signs.retain(|sign| sign.lexicon.as_ref() == Some(&lexicon.name));
    match signs.as_slice() {
        [] => {}
        [one] => return Ok(one.id),
        several => return Err(ambiguous_name_error(gloss, lexicon_addresses(several, gloss))),
    }
    let glosses = signs::glosses_of_lexicon(connection, lexicon.id)?;
    let folded = fold_text(gloss);
    let mut alike = glosses.iter().filter(|known| fold_text(known) == folded);
    if let (Some(one), None) = (alike.next(), alike.next()) {
        return Ok(signs::find_sign(connection, Some(lexicon.id), one)?.unwrap_or_default());
    }
    let near = nearest_candidate(gloss, glosses.iter().map(String::as_str));
    Err(missing_sign_error(gloss, near))
}

fn missing_sign_error(gloss: &str, near: Option<&str>) -> CorpusError {
    CorpusError::from_wrong_message(format!("no sign is called {gloss:?}"))
        .with_error_place(gloss)
        .with_meant_name(meant_name_slip(gloss, near))
        .with_command_advice("`chereme list CORPUS signs` lists the glosses")
}

fn citation(connection: &Connection, sign: i64, address: &CorpusAddress) -> CorpusResult<TokenRow> {
    let tokens = signs::tokens_of_sign(connection, sign)?;
    let cited: Vec<&TokenRow> = tokens.iter().filter(|token| token.citation).collect();
    // Of several citation forms, the one with movement can do everything that the other can.
    let moving: Vec<&TokenRow> = cited
        .iter()
        .copied()
        .filter(|token| token.recording_id.is_some())
        .collect();
    match (moving.as_slice(), cited.as_slice(), tokens.as_slice()) {
        ([one], _, _) | ([], [one], _) => Ok((*one).clone()),
        ([], [], [one]) => Ok(one.clone()),
        ([], [], []) => Err(
            CorpusError::from_wrong_message(format!("the sign {address} has no token"))
                .with_error_place(address.to_string())
                .with_advice("import or make one first"),
        ),
        _ => Err(ambiguous_name_error(
            &address.to_string(),
            tokens.iter().map(describe_token_candidate),
        )),
    }
}

fn describe_token_candidate(token: &TokenRow) -> String {
    match (&token.recording, token.start_us) {
        (Some(recording), Some(start)) => {
            format!(
                "token:{} ({recording:?} at {})",
                token.id,
                RecordingInstant::from_micros(start)
            )
        }
        _ => format!("token:{} (lexicon)", token.id),
    }
}

fn ambiguous_name_error(text: &str, candidates: impl Iterator<Item = String>) -> CorpusError {
    let all: Vec<String> = candidates.collect();
    let shown = all.iter().take(12).cloned().collect::<Vec<_>>().join(", ");
    let more = if all.len() > 12 {
        format!(" and {} more", all.len() - 12)
    } else {
        String::new()
    };
    CorpusError::from_wrong_message(format!("{text:?} can mean {} things: {shown}{more}", all.len()))
        .with_error_place(text)
        .with_advice("write which one")
}

/// Returns the slip between a name as written and one near to it.
fn meant_name_slip(written: &str, near: Option<&str>) -> Option<MeantName> {
    Some(MeantName {
        written: written.to_owned(),
        right: near?.to_owned(),
    })
}

/// Returns the recording with this name or number.
pub(crate) fn find_recording_by_name(connection: &Connection, name: &RowName) -> CorpusResult<RecordingRow> {
    match name {
        RowName::Number(id) => stored_recordings::load_recording_row(connection, *id),
        RowName::Text(text) => {
            if let Some(row) = stored_recordings::recording_named(connection, text)? {
                return Ok(row);
            }
            let all = stored_recordings::load_recording_rows(connection)?;
            let near = nearest_candidate(text, all.iter().map(|row| row.name.as_str()));
            Err(
                CorpusError::from_wrong_message(format!("no recording is called {text:?}"))
                    .with_error_place(text)
                    .with_meant_name(meant_name_slip(text, near))
                    .with_command_advice("`chereme list CORPUS recordings` lists them"),
            )
        }
    }
}

/// Returns the recording that contains the object at an address: a recording, token, tier or annotation.
pub(crate) fn find_addressed_recording(connection: &Connection, address: &CorpusAddress) -> CorpusResult<i64> {
    Ok(match address {
        CorpusAddress::Recording(name) => find_recording_by_name(connection, name)?.id,
        CorpusAddress::Annotation(id) => {
            let row = stored_tiers::load_annotation_row(connection, *id)?;
            stored_tiers::load_tier_row(connection, row.tier_id)?.recording_id
        }
        CorpusAddress::Tier(id) => stored_tiers::load_tier_row(connection, *id)?.recording_id,
        other => find_addressed_stretch(connection, other)?.recording.id,
    })
}

/// Returns the signer with this name or number.
pub(crate) fn find_signer_by_name(connection: &Connection, name: &RowName) -> CorpusResult<SignerRow> {
    let matching_signer = match name {
        RowName::Number(id) => stored_recordings::find_signer_row(connection, *id)?,
        RowName::Text(text) => stored_recordings::find_signer(connection, text)?,
    };
    matching_signer.ok_or_else(|| {
        let all = stored_recordings::load_signer_rows(connection).unwrap_or_default();
        let known_names: Vec<&str> = all.iter().map(|signer| signer.name.as_str()).collect();
        let address = CorpusAddress::Signer(name.clone()).to_string();
        let remedy = match known_names.as_slice() {
            [] => "the corpus knows no signer; a recording's body is recording:NAME".to_owned(),
            known => format!("the signers are: {}", known.join(", ")),
        };
        CorpusError::from_wrong_message(format!("there is no {address}"))
            .with_error_place(address)
            .with_advice(remedy)
    })
}

/// Returns the stretch of movement that `address` names; a bare name that belongs to no sign may be a recording's name.
pub(crate) fn find_addressed_stretch(
    connection: &Connection,
    address: &CorpusAddress,
) -> CorpusResult<RecordingStretch> {
    let named = match address {
        CorpusAddress::Recording(name) => Some(find_recording_by_name(connection, name)?),
        CorpusAddress::Gloss(name) if find_sign_by_gloss(connection, name).is_err() => {
            stored_recordings::recording_named(connection, name)?
        }
        _ => None,
    };
    if let Some(recording) = named {
        let span = TimeSpan::span_between(
            RecordingInstant::RECORDING_START,
            RecordingInstant::from_micros(recording.duration_us),
        );
        return Ok(RecordingStretch {
            recording,
            span,
            token: None,
        });
    }
    let token = find_addressed_token(connection, address)?;
    let (Some(recording), Some(start), Some(end)) = (token.recording_id, token.start_us, token.end_us) else {
        let (known_by, remedy) = if notations::find_token_notation(connection, token.id)?.is_some() {
            let remedy = ErrorRemedy::choice_remedy(
                RemedyChoice::Notation,
                "make it move first: `chereme animate CORPUS GLOSS --as NAME`",
            );
            ("is notation", remedy)
        } else {
            let remedy = ErrorRemedy::from("name a token that was recorded, such as token:41");
            ("is a lexicon entry", remedy)
        };
        return Err(
            CorpusError::from_wrong_message(format!("{address} {known_by} without movement"))
                .with_error_place(address.to_string())
                .with_advice(remedy)
                .into_lacking_content(),
        );
    };
    Ok(RecordingStretch {
        recording: stored_recordings::load_recording_row(connection, recording)?,
        span: TimeSpan::from_span_micros(start, end),
        token: Some(token),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_read_as_written() {
        for (text, want) in [
            ("token:41", CorpusAddress::Token(41)),
            ("recording:3", CorpusAddress::Recording(RowName::Number(3))),
            (
                "recording:\"NGT Thanks\"",
                CorpusAddress::Recording(RowName::Text("NGT Thanks".into())),
            ),
            ("recording:\"3\"", CorpusAddress::Recording(RowName::Text("3".into()))),
            (
                "recording:NGT Thanks",
                CorpusAddress::Recording(RowName::Text("NGT Thanks".into())),
            ),
            ("sign:LIMACE", CorpusAddress::Sign(RowName::Text("LIMACE".into()))),
            ("INDEX:1", CorpusAddress::Gloss("INDEX:1".into())),
            ("\"ÊTRE DÉGOÛTÉ\"", CorpusAddress::Gloss("ÊTRE DÉGOÛTÉ".into())),
            ("signer:Anna", CorpusAddress::Signer(RowName::Text("Anna".into()))),
        ] {
            assert_eq!(text.parse::<CorpusAddress>().ok(), Some(want), "{text}");
        }
        for (text, want) in [
            ("recording:3", Some(RowName::Number(3))),
            ("recording:\"3\"", Some(RowName::Text("3".into()))),
            ("3", Some(RowName::Text("3".into()))),
            (" NGT Thanks ", Some(RowName::Text("NGT Thanks".into()))),
            ("\"two\"", Some(RowName::Text("two".into()))),
            ("token:41", None),
            ("sign:LIMACE", None),
            ("recording:", None),
            (" ", None),
        ] {
            assert_eq!(RowName::parse_recording_name(text).ok(), want, "{text}");
        }
        for bad in ["token:x", "recording:", "", "tier:a", "recording:\"\""] {
            assert!(bad.parse::<CorpusAddress>().is_err(), "{bad}");
        }
    }
}
