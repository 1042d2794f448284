//! Messages about refused changes, with names of tiers and values of annotations instead of row numbers.

use std::fmt::Write;

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::{EditError, NamedAnnotation, TierViolation};
use rusqlite::Connection;

use super::annotation_row_id;
use crate::address::message_names::{FIRST_FRESH_HANDLE, annotation_named, name_message_ids, quoted_value};
use crate::db::stored_recordings;
use crate::db::stored_tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// Returns an annotation as text, for a list of possible ones.
pub(super) fn describe_annotation_candidate(connection: &Connection, id: i64) -> String {
    match annotation_named(connection, id) {
        Some(name) => format!("annotation:{id} ({name})"),
        None => format!("annotation:{id}"),
    }
}

/// Returns the error for a refused change of a tier, with possible alternatives.
pub(super) fn refused_change_error(connection: &Connection, tier: i64, error: &EditError) -> CorpusResult<CorpusError> {
    let row = rows::load_tier_row(connection, tier)?;
    let recording = stored_recordings::load_recording_row(connection, row.recording_id)?;
    let place = format!("{:?} of {:?}", row.name, recording.name);
    let EditError::Breaks(TierViolation::Overlap {
        annotation,
        span,
        other,
        ..
    }) = error
    else {
        return Ok(
            CorpusError::from_wrong_message(name_message_ids(connection, &error.to_string())).with_error_place(place),
        );
    };
    let other = rows::load_annotation_row(connection, annotation_row_id(*other))?;
    let what = match annotation {
        NamedAnnotation(Some(id)) if id.0 < FIRST_FRESH_HANDLE => {
            quoted_value(&rows::load_annotation_row(connection, annotation_row_id(*id))?)
        }
        _ => "a new annotation".to_owned(),
    };
    let there = other.annotation_row_span();
    let message = format!(
        "{what} from {} to {} overlaps {} ({} to {}) on the tier {:?} of {:?}",
        span.span_start_instant(),
        span.span_end_instant(),
        quoted_value(&other),
        there.span_start_instant(),
        there.span_end_instant(),
        row.name,
        recording.name
    );
    let moves = stored_recordings::body_track(connection, recording.id)?.is_some();
    let length = moves.then_some(recording.duration_us);
    let free = free_near(connection, &row, &other, length)?;
    let remedy = if free.is_empty() {
        "no time next to it is free: move or shorten the other one first".to_owned()
    } else {
        format!("free next to it: {}", free.join(", "))
    };
    Ok(CorpusError::from_wrong_message(message)
        .with_error_place(place)
        .with_advice(remedy))
}

/// Returns the free times nearest before and after an annotation of a tier.
fn free_near(
    connection: &Connection,
    tier: &TierRow,
    other: &AnnotationRow,
    length: Option<i64>,
) -> CorpusResult<Vec<String>> {
    let parent = match other.parent_id.filter(|_| tier.parent_id.is_some()) {
        Some(parent) => Some(rows::load_annotation_row(connection, parent)?.annotation_row_span()),
        None => None,
    };
    let from = parent.map_or(0, |span| span.span_start_instant().instant_micros());
    let to = parent.map(|span| span.span_end_instant().instant_micros()).or(length);
    let all = rows::load_tier_annotation_rows(connection, tier.id)?;
    let within = |row: &&AnnotationRow| row.end_us > from && to.is_none_or(|to| row.start_us < to);
    let taken: Vec<TimeSpan> = all
        .iter()
        .filter(within)
        .map(AnnotationRow::annotation_row_span)
        .collect();
    let micros = RecordingInstant::from_micros;
    let mut edge = micros(from);
    let (mut before, mut after) = (None, None);
    for span in &taken {
        let gap = (edge, Some(span.span_start_instant()));
        if edge < span.span_start_instant() {
            if span.span_start_instant().instant_micros() <= other.start_us {
                before = Some(gap);
            } else {
                after = after.or(Some(gap));
            }
        }
        edge = edge.max(span.span_end_instant());
    }
    if to.is_none_or(|to| edge.instant_micros() < to) {
        after = after.or(Some((edge, to.map(micros))));
    }
    let mut free = Vec::new();
    for (start, end) in before.into_iter().chain(after) {
        let mut text = format!("{start} ");
        let _ = match end {
            Some(end) => write!(text, "to {end}"),
            None => write!(text, "and later"),
        };
        free.push(text);
    }
    Ok(free)
}
