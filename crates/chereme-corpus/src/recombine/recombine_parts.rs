//! The pieces from which a generated sign was composed, with their times in it.

use chereme_compose::{GeneratedNote, NoteSubject};
use chereme_motion::TimeSpan;
use serde_json::Value;

use super::{SOURCE_TIER_NAME, tier_name};
use crate::Corpus;
use crate::address::CorpusAddress;
use crate::db::stored_tiers;
use crate::error::CorpusResult;

/// A piece of a generated sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MadePart {
    /// Its time in the generated sign.
    pub span: TimeSpan,
    /// The gloss of the sign, or the spelled word.
    pub gloss: String,
    /// The source of its movement: an address, or the part of the recipe that generates it.
    pub from: String,
}

impl MadePart {
    /// Returns the address of its original; `None` if it was spelled, pointed or notated.
    #[must_use]
    pub fn original_address(&self) -> Option<CorpusAddress> {
        let address = self.from.parse().ok()?;
        matches!(address, CorpusAddress::Token(_) | CorpusAddress::Recording(_)).then_some(address)
    }
}

impl Corpus {
    /// Returns the pieces of a stored sign, read from its tiers; none for a recording that was not generated.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn made_parts(&self, recording: i64) -> CorpusResult<Vec<MadePart>> {
        let connection = self.store.read_connection();
        let mut parts = Vec::new();
        for tier in stored_tiers::load_tier_rows(connection, recording)? {
            if tier.name != SOURCE_TIER_NAME {
                continue;
            }
            for row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
                let json = row.source.as_deref();
                let source: Option<Value> = json.and_then(|json| serde_json::from_str(json).ok());
                let from = source.as_ref().and_then(|value| value["from"].as_str());
                let Some(from) = from else { continue };
                parts.push(MadePart {
                    span: row.annotation_row_span(),
                    gloss: row.value,
                    from: from.to_owned(),
                });
            }
        }
        Ok(parts)
    }
}

/// Returns the pieces described by notes.
pub(super) fn made_parts_from_notes(notes: &[GeneratedNote]) -> Vec<MadePart> {
    let gloss = |note: &&GeneratedNote| note.about == NoteSubject::Gloss;
    let part = |note: &GeneratedNote| {
        debug_assert_eq!(tier_name(note), SOURCE_TIER_NAME);
        MadePart {
            span: note.span,
            gloss: note.value.reading_value().unwrap_or_default().to_owned(),
            from: note.origin.clone(),
        }
    };
    let mut parts: Vec<MadePart> = notes.iter().filter(gloss).map(part).collect();
    parts.sort_by_key(|part| part.span.span_start_instant());
    parts
}
