//! The same work on the tiers of many recordings, as one operation.

use chereme_sign::ErrorRemedy;
use rusqlite::Connection;
use serde::Serialize;

use super::annotate_tiers::{self, NewTier, TierPropertyChange};
use super::copies::{self, CopiedAnnotations};
use super::replace::{is_meant, plan_tier_shift};
use super::scheme::{self, TierScheme};
use super::{AnnotateOptions, carry_out_changes};
use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::stored_recordings::{self, RecordingRow};
use crate::db::stored_tiers::{self as rows, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;
use crate::words::InterfaceLanguage;
use crate::words::effect::{OperationEffect, TierRoundDeed};
use crate::words::history_words::operation_sentence;

/// The recordings whose tiers are worked on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TierRoundScope {
    /// All of the corpus.
    All,
    /// Those that a query means, as [`Corpus::recordings_of_query`] finds them.
    Query(String),
    /// Those of a signer, or with this name, where `*` stands for any letters; or `recording:3`.
    Pattern(String),
    /// Those with these row ids.
    Recordings(Vec<i64>),
}

/// What is done with the tiers of each recording. Names of tiers are as in [`TierSelection`](super::TierSelection).
#[derive(Debug, Clone)]
pub enum TierRoundWork {
    /// This tier is added; the recording that it names does not matter.
    Add(NewTier),
    /// The tiers of a scheme that the recording lacks are added.
    AddScheme(TierScheme),
    /// Tiers get other properties.
    Change {
        /// The name of the tiers.
        tier: String,
        /// Their new properties.
        change: TierPropertyChange,
    },
    /// Tiers are copied under another name.
    Copy {
        /// The name of the tiers.
        tier: String,
        /// The name of the copies.
        name: String,
        /// The annotations to copy.
        copied: CopiedAnnotations,
    },
    /// Tiers are removed with those below them and all annotations.
    Remove {
        /// The name of the tiers.
        tier: String,
    },
    /// Tiers are moved in time with those below them.
    Shift {
        /// The names of the tiers; empty for all of them.
        tiers: Vec<String>,
        /// The amount in microseconds.
        by_us: i64,
    },
}

/// How work on many recordings is carried out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TierRoundOptions {
    /// The work is tried, and nothing is written.
    pub dry_run: bool,
    /// Recordings that refuse the work are left out; without it nothing is done if one of them refuses.
    pub skip: bool,
}

/// What the work did in a recording, or would do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TierRoundRow {
    /// The recording's row.
    pub recording: i64,
    /// The recording's name.
    pub name: String,
    /// The tiers that were added, changed, removed or moved.
    pub tiers: Vec<String>,
    /// How many annotations were added, removed or moved.
    pub annotations: u64,
    /// Why the recording refuses the work.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
}

/// The result of work on many recordings.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TierRoundReport {
    /// What was done with the tiers.
    pub deed: TierRoundDeed,
    /// Whether nothing was written.
    pub dry_run: bool,
    /// The recordings in which something changes, and those that refuse.
    pub recordings: Vec<TierRoundRow>,
    /// How many recordings have nothing to change.
    pub untouched: u64,
    /// Whether the query is about tokens, so that recordings without one are left out.
    pub only_with_tokens: bool,
}

impl TierRoundReport {
    /// Returns what was done with how many tiers, as a sentence.
    #[must_use]
    pub fn round_sentence(&self, language: InterfaceLanguage) -> String {
        operation_sentence(&self.round_effect(), language)
    }

    fn round_effect(&self) -> OperationEffect {
        let changed: Vec<&TierRoundRow> = self.recordings.iter().filter(|row| row.refused.is_none()).collect();
        OperationEffect::WorkOnTiers {
            deed: self.deed,
            tiers: changed.iter().map(|row| row.tiers.len() as u64).sum(),
            recordings: changed.len() as u64,
        }
    }
}

impl Corpus {
    /// Does the same work on the tiers of many recordings, as one operation.
    ///
    /// A recording without the named tiers, or with all tiers of the scheme, is left as it is. A dry run lists refusals
    /// in its report.
    ///
    /// # Errors
    /// Fails if the scope has no recording or nothing is to be changed in any; [`CorpusError::Several`] with the
    /// recordings that refuse the work, each with its reason. Nothing is changed then.
    pub fn work_on_tiers(
        &mut self,
        scope: &TierRoundScope,
        work: &TierRoundWork,
        options: TierRoundOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<TierRoundReport> {
        let ids = self.tier_round_recordings(scope, progress)?;
        let mut report = TierRoundReport {
            deed: work.round_deed(),
            dry_run: options.dry_run,
            recordings: Vec::new(),
            untouched: 0,
            only_with_tokens: match scope {
                TierRoundScope::Query(query) => self.recordings_without_tokens(query)?.is_none(),
                _ => false,
            },
        };
        let mut is_tried = false;
        let carry = |connection: &Connection, progress: &mut ProgressReceiver<'_>| {
            let mut refusals = Vec::new();
            for (done, id) in ids.iter().enumerate() {
                progress.report_items("recordings", done, ids.len())?;
                let recording = stored_recordings::load_recording_row(connection, *id)?;
                connection.execute_batch("SAVEPOINT round")?;
                match work.run_in_recording(connection, &recording, progress) {
                    Ok(row) if row.tiers.is_empty() => report.untouched += 1,
                    Ok(row) => report.recordings.push(row),
                    Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                    Err(error) => {
                        connection.execute_batch("ROLLBACK TO round")?;
                        report.recordings.push(TierRoundRow {
                            refused: Some(error.to_string()),
                            ..empty_round_row(&recording)
                        });
                        let place = CorpusAddress::Recording(RowName::Number(*id));
                        refusals.push(error.with_error_place(format!("{place} ({:?})", recording.name)));
                    }
                }
                connection.execute_batch("RELEASE round")?;
            }
            let is_listed = options.dry_run || (options.skip && report.recordings.len() > refusals.len());
            if !refusals.is_empty() && !is_listed {
                let skip = ErrorRemedy::command_remedy("--skip leaves out the recordings that refuse");
                return Err(CorpusError::from_error_list(refusals).with_advice(skip));
            }
            if report.recordings.is_empty() {
                return Err(nothing_to_change(ids.len()));
            }
            if options.dry_run {
                // An error rolls the attempt back; who stops it earlier gets no half of a list.
                is_tried = true;
                return Err(CorpusError::Stopped);
            }
            Ok(((), report.round_effect()))
        };
        match self.store.operation_with_progress(progress, carry) {
            Err(CorpusError::Stopped) if is_tried => Ok(report),
            done => done.map(|()| report),
        }
    }

    fn tier_round_recordings(
        &mut self,
        scope: &TierRoundScope,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Vec<i64>> {
        let ids: Vec<i64> = match scope {
            TierRoundScope::Query(query) => self.recordings_of_query(query, progress)?.into_iter().collect(),
            TierRoundScope::All => self.recording_ids_where(|_| true)?,
            TierRoundScope::Recordings(ids) => self.recording_ids_where(|row| ids.contains(&row.id))?,
            TierRoundScope::Pattern(text) => match text.parse() {
                Ok(CorpusAddress::Recording(name)) => {
                    vec![address::find_recording_by_name(self.store.read_connection(), &name)?.id]
                }
                Ok(CorpusAddress::Signer(name)) => {
                    let signer = address::find_signer_by_name(self.store.read_connection(), &name)?;
                    self.recording_ids_where(|row| row.signer_id == Some(signer.id))?
                }
                _ => self.recording_ids_where(|row| is_meant(text, &row.name))?,
            },
        };
        if ids.is_empty() {
            let scope_text = match scope {
                TierRoundScope::All => "the corpus has no recordings".to_owned(),
                TierRoundScope::Recordings(_) => "no recording is named".to_owned(),
                TierRoundScope::Query(text) | TierRoundScope::Pattern(text) => format!("no recording is {text:?}"),
            };
            return Err(CorpusError::from_wrong_message(scope_text)
                .with_command_advice("`chereme list CORPUS recordings` lists them"));
        }
        Ok(ids)
    }

    fn recording_ids_where(&self, is_wanted: impl Fn(&RecordingRow) -> bool) -> CorpusResult<Vec<i64>> {
        let all = stored_recordings::load_recording_rows(self.store.read_connection())?;
        Ok(all.iter().filter(|row| is_wanted(row)).map(|row| row.id).collect())
    }
}

pub(super) fn empty_round_row(recording: &RecordingRow) -> TierRoundRow {
    TierRoundRow {
        recording: recording.id,
        name: recording.name.clone(),
        tiers: Vec::new(),
        annotations: 0,
        refused: None,
    }
}

fn nothing_to_change(recordings: usize) -> CorpusError {
    CorpusError::from_wrong_message(format!("nothing is to be changed in {recordings} recordings"))
        .with_command_advice("`chereme list CORPUS tiers` lists the tiers of all recordings")
}

impl TierRoundWork {
    fn round_deed(&self) -> TierRoundDeed {
        match self {
            Self::Add(_) | Self::AddScheme(_) => TierRoundDeed::Added,
            Self::Change { .. } => TierRoundDeed::Changed,
            Self::Copy { .. } => TierRoundDeed::Copied,
            Self::Remove { .. } => TierRoundDeed::Removed,
            Self::Shift { .. } => TierRoundDeed::Shifted,
        }
    }

    fn run_in_recording(
        &self,
        connection: &Connection,
        recording: &RecordingRow,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<TierRoundRow> {
        let mut done = empty_round_row(recording);
        let named = |text: &str| -> CorpusResult<Vec<TierRow>> {
            let all = rows::load_tier_rows(connection, recording.id)?;
            Ok(all.into_iter().filter(|tier| tier.is_meant_by(text)).collect())
        };
        match self {
            Self::Add(tier) => {
                let recording = RowName::Number(recording.id);
                let tier = NewTier {
                    recording,
                    ..tier.clone()
                };
                done.tiers
                    .push(annotate_tiers::insert_new_tier(connection, &tier)?.0.name);
            }
            Self::AddScheme(scheme) => {
                let added = scheme::add_lacking_tiers(connection, recording, scheme)?;
                done.tiers.extend(added.into_iter().map(|tier| tier.name));
            }
            Self::Change { tier, change } => {
                for old in named(tier)? {
                    if annotate_tiers::change_tier_row(connection, &old, change)? != old {
                        done.tiers.push(old.name);
                    }
                }
            }
            Self::Copy { tier, name, copied } => {
                for from in named(tier)? {
                    let (_, count) = copies::copy_tier_row(connection, &from, name, copied)?;
                    done.annotations += count;
                    done.tiers.push(from.name);
                }
            }
            Self::Remove { tier } => {
                for row in named(tier)? {
                    // A tier below one that was removed is gone already.
                    if !done.tiers.contains(&row.name) {
                        let removed = annotate_tiers::remove_tier_row(connection, &row)?;
                        done.annotations += removed.annotations;
                        done.tiers.extend(removed.tiers);
                    }
                }
            }
            Self::Shift { tiers, by_us } => {
                let all = rows::load_tier_rows(connection, recording.id)?;
                let is_chosen = |tier: &TierRow| tiers.is_empty() || tiers.iter().any(|text| tier.is_meant_by(text));
                let chosen: Vec<(RecordingRow, TierRow)> = all
                    .into_iter()
                    .filter(is_chosen)
                    .map(|tier| (recording.clone(), tier))
                    .collect();
                let changes = plan_tier_shift(connection, &chosen, tiers.is_empty(), *by_us)?;
                if !changes.is_empty() {
                    let options = AnnotateOptions::default();
                    let report = carry_out_changes(connection, &changes, &options, Vec::new(), progress)?;
                    done.annotations = report.changed;
                    done.tiers.extend(chosen.into_iter().map(|(_, tier)| tier.name));
                }
            }
        }
        Ok(done)
    }
}
