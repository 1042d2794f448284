//! The names of tiers and annotations in requests, and the rows that they stand for.

use std::fmt;

use chereme_formats::table::annotations::TableMoment;
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::ErrorRemedy;
use chereme_sign::text::{did_you_mean, fold_text, nearest_candidate};
use rusqlite::Connection;

use super::AnnotationChangeRun;
use crate::address::{self, CorpusAddress, RowName};
use crate::db::stored_tiers::{self as tier_rows, AnnotationRow, TierRow};
use crate::db::{edits, stored_recordings};
use crate::error::{CorpusError, CorpusResult};

/// Times that differ by no more are one, as files have whole milliseconds.
pub(super) const SAME_TIME_MICROS: u64 = 500;

/// A tier in a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TierRequestName {
    /// `tier:12`.
    Number(i64),
    /// By its name within a recording.
    Of {
        /// The recording.
        recording: RowName,
        /// The tier's name.
        tier: String,
    },
}

impl TierRequestName {
    /// Reads `tier:12`, or else the name of a tier of `recording`.
    ///
    /// # Errors
    /// Fails if the text is a name and no recording is given.
    pub fn parse_tier_name(text: &str, recording: Option<&RowName>) -> CorpusResult<Self> {
        match (text.parse(), recording) {
            (Ok(CorpusAddress::Tier(number)), _) => Ok(Self::Number(number)),
            (_, Some(recording)) => Ok(Self::Of {
                recording: recording.clone(),
                tier: text.trim().to_owned(),
            }),
            (_, None) => Err(
                CorpusError::from_wrong_message(format!("which recording's tier is {text:?}?"))
                    .with_error_place(text)
                    .with_advice("name the recording too, or write tier:12"),
            ),
        }
    }
}

impl fmt::Display for TierRequestName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "tier:{number}"),
            Self::Of { recording, tier } => {
                write!(f, "{tier:?} of {}", CorpusAddress::Recording(recording.clone()))
            }
        }
    }
}

/// An annotation in a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AnnotationName {
    /// `annotation:12`.
    Number(i64),
    /// By the label of an earlier change of the same list, its id in the file it came from, or its
    /// number.
    Called {
        /// The recording whose file has the id; nothing for any recording.
        recording: Option<RowName>,
        /// The label or id.
        id: String,
    },
    /// The annotation on a tier with this start, to the millisecond.
    At {
        /// The tier.
        tier: TierRequestName,
        /// Its start.
        start: TableMoment,
    },
    /// An annotation with the recording and the tier that the request says it has; others are refused.
    Placed {
        /// The annotation.
        annotation: Box<Self>,
        /// Its recording, if the request names one.
        recording: Option<RowName>,
        /// Its tier's name or address, if the request names one.
        tier: Option<String>,
    },
}

impl AnnotationName {
    /// Reads `annotation:12`, or else a label, the id of a file, or a bare number.
    #[must_use]
    pub fn parse_annotation_name(text: &str, recording: Option<&RowName>) -> Self {
        match text.parse() {
            Ok(CorpusAddress::Annotation(number)) => Self::Number(number),
            _ => Self::Called {
                recording: recording.cloned(),
                id: text.trim().to_owned(),
            },
        }
    }
}

/// Returns the tier with that name.
pub(super) fn find_named_tier(connection: &Connection, name: &TierRequestName) -> CorpusResult<TierRow> {
    let (recording, wanted) = match name {
        TierRequestName::Number(id) => return tier_rows::load_tier_row(connection, *id),
        TierRequestName::Of { recording, tier } => (address::find_recording_by_name(connection, recording)?, tier),
    };
    let tiers = tier_rows::load_tier_rows(connection, recording.id)?;
    if let Some(tier) = tiers.iter().find(|tier| tier.name == *wanted) {
        return Ok(tier.clone());
    }
    let folded = fold_text(wanted);
    let mut alike = tiers.iter().filter(|tier| fold_text(&tier.name) == folded);
    if let (Some(one), None) = (alike.next(), alike.next()) {
        return Ok(one.clone());
    }
    let names = tiers.iter().map(|tier| tier.name.as_str());
    let hint = did_you_mean(nearest_candidate(wanted, names.clone()));
    let all: Vec<&str> = names.take(20).collect();
    let remedy = if all.is_empty() {
        ErrorRemedy::command_remedy("add one first: `chereme annotate CORPUS --in RECORDING add-tier NAME`")
    } else {
        format!("its tiers are: {}", all.join(", ")).into()
    };
    Err(CorpusError::from_wrong_message(format!(
        "the recording {:?} has no tier {wanted:?}{hint}",
        recording.name
    ))
    .with_error_place(name.to_string())
    .with_advice(remedy))
}

impl AnnotationChangeRun<'_> {
    pub(super) fn find_work_tier(&self, name: &TierRequestName) -> CorpusResult<TierRow> {
        find_named_tier(self.connection, name)
    }

    /// Returns the annotation with that name.
    pub(super) fn find_requested_annotation(&mut self, name: &AnnotationName) -> CorpusResult<AnnotationRow> {
        match name {
            AnnotationName::Number(id) => tier_rows::load_annotation_row(self.connection, *id),
            AnnotationName::Called { recording, id } => self.find_labelled_annotation(recording.as_ref(), id),
            AnnotationName::At { tier, start } => {
                let tier = self.find_work_tier(tier)?;
                let start = self.scope_of(tier.id)?.resolve_moment(*start, false)?;
                self.find_annotation_starting(&tier, start)
            }
            AnnotationName::Placed {
                annotation,
                recording,
                tier,
            } => {
                let row = self.find_requested_annotation(annotation)?;
                self.check_place(&row, recording.as_ref(), tier.as_deref())?;
                Ok(row)
            }
        }
    }

    /// Refuses an annotation that is not in the recording and on the tier that a request names for it.
    fn check_place(&self, row: &AnnotationRow, recording: Option<&RowName>, tier: Option<&str>) -> CorpusResult<()> {
        let there = tier_rows::load_tier_row(self.connection, row.tier_id)?;
        let home = stored_recordings::load_recording_row(self.connection, there.recording_id)?;
        let elsewhere = |named: String| {
            CorpusError::from_wrong_message(format!(
                "the row names {named}, but annotation:{} is on the tier {:?} of recording:{} ({:?})",
                row.id, there.name, home.id, home.name
            ))
            .with_error_place(CorpusAddress::Annotation(row.id).to_string())
            .with_advice("correct the row; a table made from another corpus does not fit this one")
        };
        if let Some(name) = recording {
            let is_home = match name {
                RowName::Number(id) => *id == home.id,
                // Several recordings may have the name.
                RowName::Text(text) if *text == home.name => true,
                RowName::Text(_) => {
                    address::find_recording_by_name(self.connection, name).is_ok_and(|named| named.id == home.id)
                }
            };
            if !is_home {
                return Err(elsewhere(CorpusAddress::Recording(name.clone()).to_string()));
            }
        }
        if let Some(text) = tier {
            let within = RowName::Number(home.id);
            let named =
                TierRequestName::parse_tier_name(text, Some(&within)).and_then(|name| self.find_work_tier(&name));
            if !named.is_ok_and(|named| named.id == there.id) {
                return Err(elsewhere(format!("the tier {text:?}")));
            }
        }
        Ok(())
    }

    fn find_labelled_annotation(&self, recording: Option<&RowName>, id: &str) -> CorpusResult<AnnotationRow> {
        match self.labels.get(id) {
            Some(Some(row)) => return tier_rows::load_annotation_row(self.connection, *row),
            Some(None) => return Err(CorpusError::Follows(format!("{id:?} could not be added"))),
            None => {}
        }
        let recording = recording
            .map(|name| address::find_recording_by_name(self.connection, name))
            .transpose()?;
        let matching_ids = edits::find_annotations_by_id(self.connection, recording.as_ref().map(|row| row.id), id)?;
        match matching_ids.as_slice() {
            [one] => tier_rows::load_annotation_row(self.connection, *one),
            [] if let Ok(number) = id.parse() => tier_rows::load_annotation_row(self.connection, number),
            [] => Err(
                CorpusError::from_wrong_message(format!("no annotation is called {id:?}"))
                    .with_error_place(id)
                    .with_command_advice("write annotation:12; `chereme list CORPUS annotations` lists them"),
            ),
            several => {
                let all: Vec<String> = several
                    .iter()
                    .take(12)
                    .map(|id| super::annotate_messages::describe_annotation_candidate(self.connection, *id))
                    .collect();
                Err(CorpusError::from_wrong_message(format!(
                    "{id:?} can be {} annotations: {}",
                    several.len(),
                    all.join(", ")
                ))
                .with_error_place(id)
                .with_advice("name the recording too, or write which one"))
            }
        }
    }

    fn find_annotation_starting(&self, tier: &TierRow, start: RecordingInstant) -> CorpusResult<AnnotationRow> {
        let at_us = start.instant_micros();
        let within = i64::try_from(SAME_TIME_MICROS).unwrap_or_default();
        let (from, to) = (at_us.saturating_sub(within), at_us.saturating_add(within));
        let near = tier_rows::annotations_near(self.connection, tier.id, from, to)?;
        let distance = |row: &AnnotationRow| row.start_us.abs_diff(at_us);
        let near_rows = near
            .iter()
            .filter(|row| distance(row) <= SAME_TIME_MICROS)
            .min_by_key(|row| distance(row));
        if let Some(row) = near_rows {
            return Ok(row.clone());
        }
        let around = near.first().map_or_else(
            || ErrorRemedy::command_remedy("`chereme list CORPUS annotations` lists those that are there"),
            |row| {
                let starts = RecordingInstant::from_micros(row.start_us);
                format!(
                    "the one there, {}, starts at {starts}",
                    crate::address::message_names::quoted_value(row)
                )
                .into()
            },
        );
        Err(
            CorpusError::from_wrong_message(format!("no annotation of the tier {:?} starts at {start}", tier.name))
                .with_advice(around),
        )
    }

    /// Returns the annotation on the parent of a symbolic tier that contains all of `span`.
    pub(super) fn find_parent_annotation(&self, tier: &TierRow, span: TimeSpan) -> CorpusResult<i64> {
        let above = tier.parent_id.unwrap_or_default();
        let (start, end) = span.span_bounds_micros();
        let near = tier_rows::annotations_near(self.connection, above, start, end)?;
        let holds = |row: &&AnnotationRow| row.start_us <= start && end <= row.end_us;
        near.iter().find(holds).map(|row| row.id).ok_or_else(|| {
            CorpusError::from_wrong_message(format!(
                "no annotation of the tier above {:?} holds the time from {} to {}",
                tier.name,
                span.span_start_instant(),
                span.span_end_instant()
            ))
            .with_advice("name the parent by its id")
        })
    }
}
