//! The names of tiers and annotations in requests, and the rows that they stand for.

use std::fmt;

use chereme_formats::table::annotations::Moment;
use chereme_motion::{Instant, Span};
use chereme_sign::Remedy;
use chereme_sign::text::{did_you_mean, fold, nearest};
use rusqlite::Connection;

use super::Work;
use crate::address::{self, Address, Name};
use crate::db::tiers::{self as tier_rows, AnnotationRow, TierRow};
use crate::db::{edits, recordings};
use crate::error::{Error, Result};

/// A tier in a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TierName {
    /// `tier:12`.
    Number(i64),
    /// By its name within a recording.
    Of {
        /// The recording.
        recording: Name,
        /// The tier's name.
        tier: String,
    },
}

impl TierName {
    /// Reads `tier:12`, or else the name of a tier of `recording`.
    ///
    /// # Errors
    /// Fails if the text is a name and no recording is given.
    pub fn read(text: &str, recording: Option<&Name>) -> Result<Self> {
        match (text.parse(), recording) {
            (Ok(Address::Tier(number)), _) => Ok(Self::Number(number)),
            (_, Some(recording)) => Ok(Self::Of {
                recording: recording.clone(),
                tier: text.trim().to_owned(),
            }),
            (_, None) => Err(Error::wrong(format!("which recording's tier is {text:?}?"))
                .at(text)
                .advise("name the recording too, or write tier:12")),
        }
    }
}

impl fmt::Display for TierName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "tier:{number}"),
            Self::Of { recording, tier } => {
                write!(f, "{tier:?} of {}", Address::Recording(recording.clone()))
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
        recording: Option<Name>,
        /// The label or id.
        id: String,
    },
    /// The annotation on a tier with this start, to the millisecond.
    At {
        /// The tier.
        tier: TierName,
        /// Its start.
        start: Moment,
    },
    /// An annotation with the recording and the tier that the request says it has; others are refused.
    Placed {
        /// The annotation.
        annotation: Box<Self>,
        /// Its recording, if the request names one.
        recording: Option<Name>,
        /// Its tier's name or address, if the request names one.
        tier: Option<String>,
    },
}

impl AnnotationName {
    /// Reads `annotation:12`, or else a label, the id of a file, or a bare number.
    #[must_use]
    pub fn read(text: &str, recording: Option<&Name>) -> Self {
        match text.parse() {
            Ok(Address::Annotation(number)) => Self::Number(number),
            _ => Self::Called {
                recording: recording.cloned(),
                id: text.trim().to_owned(),
            },
        }
    }
}

/// Returns the tier with that name.
pub(super) fn tier(connection: &Connection, name: &TierName) -> Result<TierRow> {
    let (recording, wanted) = match name {
        TierName::Number(id) => return tier_rows::tier(connection, *id),
        TierName::Of { recording, tier } => (address::recording(connection, recording)?, tier),
    };
    let tiers = tier_rows::tiers(connection, recording.id)?;
    if let Some(tier) = tiers.iter().find(|tier| tier.name == *wanted) {
        return Ok(tier.clone());
    }
    let folded = fold(wanted);
    let mut alike = tiers.iter().filter(|tier| fold(&tier.name) == folded);
    if let (Some(one), None) = (alike.next(), alike.next()) {
        return Ok(one.clone());
    }
    let names = tiers.iter().map(|tier| tier.name.as_str());
    let meant = did_you_mean(nearest(wanted, names.clone()));
    let all: Vec<&str> = names.take(20).collect();
    let remedy = if all.is_empty() {
        Remedy::command("add one first: `chereme annotate CORPUS --in RECORDING add-tier NAME`")
    } else {
        format!("its tiers are: {}", all.join(", ")).into()
    };
    Err(Error::wrong(format!(
        "the recording {:?} has no tier {wanted:?}{meant}",
        recording.name
    ))
    .at(name.to_string())
    .advise(remedy))
}

impl Work<'_> {
    pub(super) fn tier(&self, name: &TierName) -> Result<TierRow> {
        tier(self.connection, name)
    }

    /// Returns the annotation with that name.
    pub(super) fn annotation(&mut self, name: &AnnotationName) -> Result<AnnotationRow> {
        match name {
            AnnotationName::Number(id) => tier_rows::annotation(self.connection, *id),
            AnnotationName::Called { recording, id } => self.called(recording.as_ref(), id),
            AnnotationName::At { tier, start } => {
                let tier = self.tier(tier)?;
                let start = self.scope_of(tier.id)?.instant(*start, false)?;
                self.starting(&tier, start)
            }
            AnnotationName::Placed {
                annotation,
                recording,
                tier,
            } => {
                let row = self.annotation(annotation)?;
                self.check_place(&row, recording.as_ref(), tier.as_deref())?;
                Ok(row)
            }
        }
    }

    /// Refuses an annotation that is not in the recording and on the tier that a request names for it.
    fn check_place(
        &self,
        row: &AnnotationRow,
        recording: Option<&Name>,
        tier: Option<&str>,
    ) -> Result<()> {
        let there = tier_rows::tier(self.connection, row.tier_id)?;
        let home = recordings::recording(self.connection, there.recording_id)?;
        let elsewhere = |named: String| {
            Error::wrong(format!(
                "the row names {named}, but annotation:{} is on the tier {:?} of recording:{} ({:?})",
                row.id, there.name, home.id, home.name
            ))
            .at(Address::Annotation(row.id).to_string())
            .advise("correct the row; a table made from another corpus does not fit this one")
        };
        if let Some(name) = recording {
            let is_home = match name {
                Name::Number(id) => *id == home.id,
                // Several recordings may have the name.
                Name::Text(text) if *text == home.name => true,
                Name::Text(_) => {
                    address::recording(self.connection, name).is_ok_and(|named| named.id == home.id)
                }
            };
            if !is_home {
                return Err(elsewhere(Address::Recording(name.clone()).to_string()));
            }
        }
        if let Some(text) = tier {
            let within = Name::Number(home.id);
            let named = TierName::read(text, Some(&within)).and_then(|name| self.tier(&name));
            if !named.is_ok_and(|named| named.id == there.id) {
                return Err(elsewhere(format!("the tier {text:?}")));
            }
        }
        Ok(())
    }

    fn called(&self, recording: Option<&Name>, id: &str) -> Result<AnnotationRow> {
        match self.labels.get(id) {
            Some(Some(row)) => return tier_rows::annotation(self.connection, *row),
            Some(None) => return Err(Error::Follows(format!("{id:?} could not be added"))),
            None => {}
        }
        let recording = recording
            .map(|name| address::recording(self.connection, name))
            .transpose()?;
        let found = edits::called(self.connection, recording.as_ref().map(|row| row.id), id)?;
        match found.as_slice() {
            [one] => tier_rows::annotation(self.connection, *one),
            [] if let Ok(number) = id.parse() => tier_rows::annotation(self.connection, number),
            [] => Err(Error::wrong(format!("no annotation is called {id:?}"))
                .at(id)
                .advise(Remedy::command(
                    "write annotation:12; `chereme list CORPUS annotations` lists them",
                ))),
            several => {
                let all: Vec<String> = several
                    .iter()
                    .take(12)
                    .map(|id| super::messages::candidate(self.connection, *id))
                    .collect();
                Err(Error::wrong(format!(
                    "{id:?} can be {} annotations: {}",
                    several.len(),
                    all.join(", ")
                ))
                .at(id)
                .advise("name the recording too, or write which one"))
            }
        }
    }

    fn starting(&self, tier: &TierRow, start: Instant) -> Result<AnnotationRow> {
        let (from, to) = (start.shifted(-500).micros(), start.shifted(500).micros());
        let near = tier_rows::annotations_near(self.connection, tier.id, from, to)?;
        let distance = |row: &AnnotationRow| row.start_us.abs_diff(start.micros());
        let found = near
            .iter()
            .filter(|row| distance(row) <= 500)
            .min_by_key(|row| distance(row));
        if let Some(row) = found {
            return Ok(row.clone());
        }
        let around = near.first().map_or_else(
            || Remedy::command("`chereme list CORPUS annotations` lists those that are there"),
            |row| {
                let starts = Instant::from_micros(row.start_us);
                format!(
                    "the one there, {}, starts at {starts}",
                    super::messages::quoted_value(row)
                )
                .into()
            },
        );
        Err(Error::wrong(format!(
            "no annotation of the tier {:?} starts at {start}",
            tier.name
        ))
        .advise(around))
    }

    /// Returns the annotation on the parent of a symbolic tier that contains all of `span`.
    pub(super) fn above(&self, tier: &TierRow, span: Span) -> Result<i64> {
        let above = tier.parent_id.unwrap_or_default();
        let (start, end) = (span.start().micros(), span.end().micros());
        let near = tier_rows::annotations_near(self.connection, above, start, end)?;
        let holds = |row: &&AnnotationRow| row.start_us <= start && end <= row.end_us;
        near.iter().find(holds).map(|row| row.id).ok_or_else(|| {
            Error::wrong(format!(
                "no annotation of the tier above {:?} holds the time from {} to {}",
                tier.name,
                span.start(),
                span.end()
            ))
            .advise("name the parent by its id")
        })
    }
}
