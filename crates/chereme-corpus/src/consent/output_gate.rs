//! For whom something is written, and what is left out for them.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use rusqlite::Connection;
use serde::Serialize;

use super::consent_gate::{PublishPermissions, TERMS_NOT_STATED, WithheldReason, withheld_remedy};
use super::{ConsentAudience, ConsentKind};
use crate::error::{CorpusError, CorpusResult};

/// The number of people whom a sentence names.
const MAX_NAMED_PEOPLE: usize = 6;

/// The people for whom a file, a film or a picture is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum OutputAudience {
    /// Those who keep the corpus: everything is written.
    #[default]
    Me,
    /// People who do research.
    Research,
    /// Everybody.
    Public,
}

impl OutputAudience {
    /// Returns the people beyond those who keep the corpus, if it is for others.
    pub(crate) fn consent_audience(self) -> Option<ConsentAudience> {
        match self {
            Self::Me => None,
            Self::Research => Some(ConsentAudience::Research),
            Self::Public => Some(ConsentAudience::Public),
        }
    }
}

impl fmt::Display for OutputAudience {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.consent_audience().map_or("me", ConsentAudience::audience_name))
    }
}

impl FromStr for OutputAudience {
    type Err = CorpusError;

    fn from_str(text: &str) -> CorpusResult<Self> {
        let mut all = [Self::Me, Self::Research, Self::Public].into_iter();
        let named_audience = all.find(|audience| audience.to_string() == text.trim());
        named_audience.ok_or_else(|| {
            CorpusError::from_wrong_message(format!("{text:?} is no audience"))
                .with_error_place(text)
                .with_advice("write public, research or me")
        })
    }
}

/// Something that was left out of an output, because somebody did not agree to it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct WithheldOutput {
    /// The name of the recording, or what a study shows.
    pub name: String,
    /// The person who did not agree, or the recording of a person without a name.
    pub who: String,
    /// The reason.
    pub why: WithheldReason,
}

impl WithheldOutput {
    /// Returns the sentence that says what is withheld from whom, and because of whom.
    #[must_use]
    pub fn withheld_sentence(&self, audience: OutputAudience) -> String {
        let (name, why, who) = (&self.name, self.why.reason_words(), &self.who);
        format!("{name:?} is withheld from {audience} because of {who}: {why}")
    }
}

/// The gate through which an output passes.
pub(crate) struct OutputGate {
    audience: OutputAudience,
    permissions: PublishPermissions,
}

impl OutputGate {
    /// Opens the gate for an audience.
    pub(crate) fn open_output_gate(connection: &Connection, audience: OutputAudience) -> CorpusResult<Self> {
        // For those who keep the corpus, the gate only says what others may not see.
        let consent_audience = audience.consent_audience().unwrap_or(ConsentAudience::Public);
        // Exports may lack terms, and say so; only a publication needs them.
        let terms = Some(TERMS_NOT_STATED);
        Ok(Self {
            audience,
            permissions: PublishPermissions::read_permissions_for(connection, terms, consent_audience)?,
        })
    }

    /// Reports whether everything passes.
    pub(crate) fn passes_everything(&self) -> bool {
        self.audience == OutputAudience::Me
    }

    /// Returns why a recording is withheld from an output that shows these kinds; `None` if it passes.
    pub(crate) fn withheld_output(&self, recording: i64, kinds: &[ConsentKind]) -> Option<WithheldOutput> {
        if self.passes_everything() {
            return None;
        }
        self.not_agreed(recording, kinds)
    }

    fn not_agreed(&self, recording: i64, kinds: &[ConsentKind]) -> Option<WithheldOutput> {
        let refused = |kind: &ConsentKind| self.permissions.contributed_terms(recording, *kind).err();
        let withheld = kinds.iter().find_map(refused)?;
        Some(WithheldOutput {
            name: self.permissions.recording_name(recording),
            who: self.permissions.withheld_because_of(&withheld),
            why: withheld.reason,
        })
    }

    /// Returns the recordings that are withheld from a copy of the whole corpus.
    pub(crate) fn withheld_recordings(&self) -> Vec<(i64, WithheldOutput)> {
        let all = self.permissions.all_recordings().into_iter();
        let kinds = [ConsentKind::Movement, ConsentKind::Annotation];
        all.filter_map(|recording| Some((recording, self.withheld_output(recording, &kinds)?)))
            .collect()
    }

    /// Returns a sentence that names those who have not agreed that everybody sees these recordings, if they are
    /// written for those who keep the corpus; all recordings of the corpus without a list.
    pub(crate) fn for_me_sentence(&self, recordings: Option<&BTreeSet<i64>>) -> Option<String> {
        if !self.passes_everything() {
            return None;
        }
        let everything = self.permissions.all_recordings();
        let kinds = [ConsentKind::Movement, ConsentKind::Annotation];
        let shown = recordings.unwrap_or(&everything).iter();
        not_agreed_sentence(shown.filter_map(|recording| self.not_agreed(*recording, &kinds)))
    }

    /// Returns the same sentence for a sign that is not stored: it names the person because of whom it is refused, and
    /// those who did not agree to these kinds for one of its sources.
    pub(crate) fn unstored_sign_sentence(
        &self,
        refused: Option<WithheldOutput>,
        sources: &BTreeSet<i64>,
        kinds: &[ConsentKind],
    ) -> Option<String> {
        let others = sources.iter().filter_map(|source| self.not_agreed(*source, kinds));
        not_agreed_sentence(refused.into_iter().chain(others))
    }

    /// Returns the terms of a recording, as a reader finds them in a file.
    pub(crate) fn terms_text(&self, recording: i64) -> String {
        self.permissions.recording_terms_text(recording)
    }
}

/// Returns a sentence that names those because of whom something is for its keepers alone; `None` if it names nobody.
fn not_agreed_sentence(withheld: impl Iterator<Item = WithheldOutput>) -> Option<String> {
    // Missing terms are no refusal of a person.
    let refused = withheld.filter(|one| one.why != WithheldReason::NoTerms);
    let people: BTreeSet<String> = refused.map(|one| one.who).collect();
    if people.is_empty() {
        return None;
    }
    let mut names = people.iter().take(MAX_NAMED_PEOPLE).cloned().collect::<Vec<_>>();
    if people.len() > MAX_NAMED_PEOPLE {
        names.push("…".to_owned());
    }
    Some(format!(
        "this is for you alone: not everybody agreed that others see it: {}",
        names.join(", ")
    ))
}

/// Returns the error if nothing of an output passes.
pub(crate) fn nothing_passes_error(withheld: &[WithheldOutput], audience: OutputAudience) -> CorpusError {
    let Some(first) = withheld.first() else {
        return CorpusError::from_wrong_message("there is nothing to write");
    };
    let sentence = first.withheld_sentence(audience);
    let message = match withheld.len() {
        1 => sentence,
        count => format!("all {count} are withheld; the first: {sentence}"),
    };
    CorpusError::from_wrong_message(message)
        .with_error_place(first.name.clone())
        .with_advice(withheld_remedy(first.why))
}
