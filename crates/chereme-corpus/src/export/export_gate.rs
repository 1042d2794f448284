//! What of an export passes the gate of consent, and what is left out.

use std::collections::BTreeSet;

use rusqlite::Connection;

use super::{ExportWhat, LongTable, SingleFileFormat, selected_export_stretch, selected_export_tokens};
use crate::address::{self, CorpusAddress, RowName};
use crate::consent::{ConsentKind, OutputAudience, OutputGate, WithheldOutput, nothing_passes_error};
use crate::db::{signs, stored_recordings, stored_tiers};
use crate::error::CorpusResult;

/// The number of withheld things of which a note each is written.
const MAX_WITHHELD_NOTES: usize = 12;

/// A part of the corpus that may be written, and what was left out of it.
pub(super) struct PassedExport {
    pub(super) what: ExportWhat,
    pub(super) withheld: Vec<WithheldOutput>,
}

/// The gate of an export, and the note for those who keep the corpus.
pub(super) struct ExportGate {
    gate: Option<OutputGate>,
    audience: OutputAudience,
    pub(super) notes: Vec<String>,
}

impl ExportGate {
    /// Opens the gate for `what`. A damaged corpus can be saved by those who keep it even if its consents cannot be read.
    pub(super) fn open_export_gate(
        connection: &Connection,
        what: &ExportWhat,
        audience: OutputAudience,
    ) -> CorpusResult<Self> {
        let gate = match OutputGate::open_output_gate(connection, audience) {
            Ok(gate) => gate,
            Err(error) if audience == OutputAudience::Me => {
                return Ok(Self {
                    gate: None,
                    audience,
                    notes: vec![format!("what the signers agreed to cannot be read: {error}")],
                });
            }
            Err(error) => return Err(error),
        };
        // What cannot be found is refused by the format.
        let recordings = recordings_shown_by(connection, what).unwrap_or_default();
        let notes = match what {
            // No list of recordings stands for all of them.
            ExportWhat::All => gate.for_me_sentence(None),
            _ => gate.for_me_sentence(Some(&recordings)),
        };
        Ok(Self {
            gate: Some(gate),
            audience,
            notes: notes.into_iter().collect(),
        })
    }

    /// Returns the terms of a recording, as the file states them; `None` if nobody stated any.
    pub(super) fn terms_in_file(&self, recording: &stored_recordings::RecordingRow) -> Option<String> {
        match &self.gate {
            Some(gate) => Some(gate.terms_text(recording.id)).filter(|text| text != crate::consent::TERMS_NOT_STATED),
            None => recording.licence.clone(),
        }
    }

    /// Returns the terms of a recording for a list of all.
    pub(super) fn listed_terms(&self, recording: &stored_recordings::RecordingRow) -> String {
        self.terms_in_file(recording)
            .unwrap_or_else(|| crate::consent::TERMS_NOT_STATED.to_owned())
    }

    /// Returns the recordings that a copy of everything leaves out.
    pub(super) fn withheld_recordings(&self) -> Vec<(i64, WithheldOutput)> {
        self.gate
            .as_ref()
            .map_or_else(Vec::new, OutputGate::withheld_recordings)
    }

    pub(super) fn export_audience(&self) -> OutputAudience {
        self.audience
    }

    /// Returns why a recording is withheld from a file of this format.
    pub(super) fn withheld_from(
        &self,
        recording: i64,
        format: SingleFileFormat<'_>,
        named: bool,
    ) -> Option<WithheldOutput> {
        let mut kinds = format.shown_kinds().to_vec();
        // A table names what is signed, which is annotation even where only movement is shown.
        if named && !kinds.contains(&ConsentKind::Annotation) {
            kinds.push(ConsentKind::Annotation);
        }
        self.gate.as_ref()?.withheld_output(recording, &kinds)
    }

    /// Returns the part of `what` that may be written in a format.
    pub(super) fn pass_export(
        &self,
        connection: &Connection,
        what: &ExportWhat,
        format: SingleFileFormat<'_>,
    ) -> CorpusResult<PassedExport> {
        let mut passed = PassedExport {
            what: what.clone(),
            withheld: Vec::new(),
        };
        // Those who keep the corpus see everything, and an inventory shows nobody.
        if self.audience == OutputAudience::Me || matches!(what, ExportWhat::Inventory(_)) {
            return Ok(passed);
        }
        let several = matches!(what, ExportWhat::All | ExportWhat::Several(_) | ExportWhat::Tokens(_));
        let recordings = match what {
            ExportWhat::Address(CorpusAddress::Recording(_) | CorpusAddress::Tier(_)) => {
                Some(recordings_shown_by(connection, what)?)
            }
            _ if format.lists_tokens() => None,
            ExportWhat::All if matches!(format, SingleFileFormat::Parquet(_)) => {
                return self.pass_all_recordings(connection, format);
            }
            _ if matches!(format, SingleFileFormat::Parquet(_)) => None,
            _ => Some(BTreeSet::from([selected_export_stretch(connection, what)?
                .recording
                .id])),
        };
        match recordings {
            Some(recordings) => {
                let each = recordings.iter();
                passed.withheld = each.filter_map(|id| self.withheld_from(*id, format, false)).collect();
                if !passed.withheld.is_empty() {
                    return Err(nothing_passes_error(&passed.withheld, self.audience));
                }
            }
            None => {
                let mut tokens = Vec::new();
                let mut withheld = BTreeSet::new();
                for id in selected_export_tokens(connection, what)? {
                    let recording = signs::load_token_row(connection, id)?.recording_id;
                    match recording.and_then(|recording| self.withheld_from(recording, format, true)) {
                        Some(one) => drop(withheld.insert(one)),
                        None => tokens.push(id),
                    }
                }
                passed.withheld = withheld.into_iter().collect();
                // An empty file would look as if there were nothing to export.
                if tokens.is_empty() && !passed.withheld.is_empty() {
                    return Err(nothing_passes_error(&passed.withheld, self.audience));
                }
                if several || !passed.withheld.is_empty() {
                    passed.what = ExportWhat::Tokens(tokens);
                }
            }
        }
        Ok(passed)
    }

    /// Returns all recordings that may be written in a format.
    fn pass_all_recordings(&self, connection: &Connection, format: SingleFileFormat<'_>) -> CorpusResult<PassedExport> {
        let (mut addresses, mut withheld) = (Vec::new(), Vec::new());
        for row in stored_recordings::load_recording_rows(connection)? {
            match self.withheld_from(row.id, format, true) {
                Some(one) => withheld.push(one),
                None => addresses.push(CorpusAddress::Recording(RowName::Number(row.id))),
            }
        }
        // Without this, the caller would get an empty file instead of the reason.
        if addresses.is_empty() && !withheld.is_empty() {
            return Err(nothing_passes_error(&withheld, self.audience));
        }
        Ok(PassedExport {
            what: ExportWhat::Several(addresses),
            withheld,
        })
    }

    /// Returns a note on each thing that was left out.
    pub(super) fn withheld_notes(&self, withheld: &[WithheldOutput]) -> Vec<String> {
        let mut notes: Vec<String> = withheld
            .iter()
            .take(MAX_WITHHELD_NOTES)
            .map(|one| one.withheld_sentence(self.audience))
            .collect();
        if let Some(more) = withheld.len().checked_sub(MAX_WITHHELD_NOTES).filter(|more| *more > 0) {
            notes.push(format!("withheld, too: {more} more"));
        }
        notes
    }
}

/// Returns the recordings that an export shows.
fn recordings_shown_by(connection: &Connection, what: &ExportWhat) -> CorpusResult<BTreeSet<i64>> {
    Ok(match what {
        ExportWhat::All | ExportWhat::Inventory(_) => BTreeSet::new(),
        ExportWhat::Address(CorpusAddress::Recording(name)) => {
            BTreeSet::from([address::find_recording_by_name(connection, name)?.id])
        }
        ExportWhat::Address(CorpusAddress::Tier(tier)) => {
            BTreeSet::from([stored_tiers::load_tier_row(connection, *tier)?.recording_id])
        }
        ExportWhat::Several(addresses) => {
            let mut all = BTreeSet::new();
            for one in addresses {
                all.extend(recordings_shown_by(connection, &ExportWhat::Address(one.clone()))?);
            }
            all
        }
        ExportWhat::Address(_) | ExportWhat::Tokens(_) => {
            let tokens = selected_export_tokens(connection, what)?;
            let mut all = BTreeSet::new();
            // A query takes only so many parameters.
            for ids in tokens.chunks(signs::MAX_ROWS_PER_QUERY) {
                let rows = signs::load_token_rows(connection, ids)?;
                all.extend(rows.values().filter_map(|token| token.recording_id));
            }
            all
        }
    })
}

impl SingleFileFormat<'_> {
    /// Returns what a file of the format shows of people.
    fn shown_kinds(self) -> &'static [ConsentKind] {
        match self {
            Self::Bvh(_) | Self::Points(_) | Self::Markers(_) | Self::LiveLink => &[ConsentKind::Movement],
            Self::Glb(..) | Self::Vrma(_) | Self::Curves(_) | Self::Parquet(LongTable::Frames) => {
                &[ConsentKind::Movement, ConsentKind::Annotation]
            }
            Self::Table(_)
            | Self::Eaf
            | Self::Json
            | Self::Parquet(_)
            | Self::TextGrid
            | Self::Xra
            | Self::ElanTable
            | Self::Subtitles(_)
            | Self::Notation(_) => &[ConsentKind::Annotation],
        }
    }

    /// Reports whether a file of the format has a row or a line for each token.
    fn lists_tokens(self) -> bool {
        matches!(
            self,
            Self::Table(_) | Self::Notation(_) | Self::Parquet(LongTable::Tokens | LongTable::Components)
        )
    }
}
