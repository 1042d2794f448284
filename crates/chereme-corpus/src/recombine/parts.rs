//! The pieces from which a generated sign was composed, with their times in it.

use chereme_compose::{About, Note};
use chereme_motion::{Instant, Span};
use serde_json::Value;

use super::{SOURCE, tier_name};
use crate::Corpus;
use crate::address::Address;
use crate::db::tiers;
use crate::error::Result;

/// A piece of a generated sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MadePart {
    /// Its time in the generated sign.
    pub span: Span,
    /// The gloss of the sign, or the spelled word.
    pub gloss: String,
    /// The source of its movement: an address, or the part of the recipe that generates it.
    pub from: String,
}

impl MadePart {
    /// Returns the address of its original; `None` if it was spelled, pointed or notated.
    #[must_use]
    pub fn original(&self) -> Option<Address> {
        let address = self.from.parse().ok()?;
        matches!(address, Address::Token(_) | Address::Recording(_)).then_some(address)
    }
}

impl Corpus {
    /// Returns the pieces of a stored sign, read from its tiers; none for a recording that was not generated.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn made_parts(&self, recording: i64) -> Result<Vec<MadePart>> {
        let connection = self.store.read();
        let mut parts = Vec::new();
        for tier in tiers::tiers(connection, recording)? {
            if tier.name != SOURCE {
                continue;
            }
            for row in tiers::annotations(connection, tier.id)? {
                let said: Option<Value> = row.source.and_then(|it| serde_json::from_str(&it).ok());
                let from = said.as_ref().and_then(|it| it["from"].as_str());
                let Some(from) = from else { continue };
                parts.push(MadePart {
                    span: Span::between(
                        Instant::from_micros(row.start_us),
                        Instant::from_micros(row.end_us),
                    ),
                    gloss: row.value,
                    from: from.to_owned(),
                });
            }
        }
        Ok(parts)
    }
}

/// Returns the pieces described by notes.
pub(super) fn of(notes: &[Note]) -> Vec<MadePart> {
    let gloss = |note: &&Note| note.about == About::Gloss;
    let part = |note: &Note| {
        debug_assert_eq!(tier_name(note), SOURCE);
        MadePart {
            span: note.span,
            gloss: note.value.value().unwrap_or_default().to_owned(),
            from: note.origin.clone(),
        }
    };
    let mut parts: Vec<MadePart> = notes.iter().filter(gloss).map(part).collect();
    parts.sort_by_key(|part| part.span.start());
    parts
}
