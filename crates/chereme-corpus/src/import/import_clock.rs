//! Aligns tracks of one take by timecode: the time of day at which each began.

use std::ops::Range;

use chereme_motion::RecordingInstant;
use chereme_sign::ErrorRemedy;

use super::import_report::ReportFinding;
use super::{FileReport, ImportJob};
use crate::db::stored_recordings;
use crate::db::stored_tracks::{self, TrackRow};
use crate::error::CorpusResult;

/// A day in microseconds.
const DAY_US: i64 = 86_400_000_000;
/// The smallest share of the shorter track that two tracks of one take have in common.
const MIN_SHARED_TRACK_PART: f64 = 0.5;

/// Returns the span of a track within the day.
fn span_within_day(row: &TrackRow) -> Option<Range<i64>> {
    let start = row.clock_us?;
    Some(start..start.saturating_add(row.duration_us.unwrap_or_default()))
}

/// Returns the overlap of two spans as a share of the shorter one; one of them may cross midnight.
fn shared_span_part(a: &Range<i64>, b: &Range<i64>) -> f64 {
    let least = (a.end - a.start).min(b.end - b.start).max(1) as f64;
    let common = [-DAY_US, 0, DAY_US].map(|day| {
        let start = a.start.max(b.start.saturating_add(day));
        a.end.min(b.end.saturating_add(day)).saturating_sub(start)
    });
    common.into_iter().max().unwrap_or_default().max(0) as f64 / least
}

/// Returns the recording near this file whose tracks were captured at the same time of day, if there is exactly one.
pub(super) fn take_of(job: &ImportJob<'_>, days: &[Range<i64>], report: &mut FileReport) -> CorpusResult<Option<i64>> {
    if days.is_empty() || job.options.into.is_some() {
        return Ok(None);
    }
    let mut fitting = Vec::new();
    for id in job.places.recordings_near_file(&job.place) {
        let rows = stored_tracks::load_track_rows(job.connection, id)?;
        let known_days = rows.iter().filter_map(span_within_day);
        if known_days
            .flat_map(|known| days.iter().map(move |own| shared_span_part(own, &known)))
            .any(|share| share >= MIN_SHARED_TRACK_PART)
        {
            fitting.push(id);
        }
    }
    let mut names = Vec::with_capacity(fitting.len());
    for id in &fitting {
        names.push(format!(
            "{:?}",
            stored_recordings::load_recording_row(job.connection, *id)?.name
        ));
    }
    match fitting.as_slice() {
        [] => Ok(None),
        [one] => {
            report.findings.push(ReportFinding::finding_note(format!(
                "its timecodes are those of the recording {}: it is taken for the same take",
                names.concat()
            )));
            Ok(Some(*one))
        }
        _ => {
            report.findings.push(ReportFinding::finding_warning(
                format!("its timecodes are those of several recordings: {}", names.join(", ")),
                ErrorRemedy::command_remedy("say which one it belongs to: import CORPUS FILE --into RECORDING"),
            ));
            Ok(None)
        }
    }
}

/// Moves new tracks of a recording so that their times of day agree with the other tracks, unless the caller gave an
/// offset.
pub(super) fn align_tracks_by_clock(
    job: &ImportJob<'_>,
    recording: i64,
    new: &[i64],
    report: &mut FileReport,
) -> CorpusResult<()> {
    if job.options.offset_us != 0 {
        return Ok(());
    }
    let rows = stored_tracks::load_track_rows(job.connection, recording)?;
    let has_clock = |row: &&TrackRow| row.clock_us.is_some();
    let Some(other) = rows.iter().filter(has_clock).find(|row| !new.contains(&row.id)) else {
        return Ok(());
    };
    let Some(zero) = other.clock_us.map(|clock| clock.saturating_sub(other.offset_us)) else {
        return Ok(());
    };
    for row in rows.iter().filter(has_clock).filter(|row| new.contains(&row.id)) {
        let (Some(own), Some(theirs)) = (span_within_day(row), span_within_day(other)) else {
            continue;
        };
        let mut apart = own.start.saturating_sub(zero);
        if apart.abs() > DAY_US / 2 {
            apart -= apart.signum() * DAY_US;
        }
        if shared_span_part(&own, &theirs) <= 0.0 {
            report.findings.push(ReportFinding::finding_warning(
                format!(
                    "its timecodes begin {} after those of the track {:?} and share no moment with them: both start \
                     together",
                    RecordingInstant::from_micros(apart),
                    other.name
                ),
                ErrorRemedy::command_remedy(
                    "if they are of one take, say where it starts: track CORPUS RECORDING NAME --offset TIME",
                ),
            ));
            continue;
        }
        stored_tracks::set_offset(job.connection, row.id, apart)?;
        stored_recordings::lengthen_recording(
            job.connection,
            recording,
            apart.saturating_add(row.duration_us.unwrap_or_default()),
        )?;
        report.findings.push(ReportFinding::finding_note(format!(
            "by timecode it starts {} from the start of the recording",
            RecordingInstant::from_micros(apart)
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_shared_across_midnight_too() {
        let second = 1_000_000;
        for (a, b, share) in [
            (0..10 * second, 5 * second..20 * second, 0.5),
            (DAY_US - 5 * second..DAY_US + 5 * second, 0..5 * second, 1.0),
            (0..second, 2 * second..3 * second, 0.0),
        ] {
            assert!((shared_span_part(&a, &b) - share).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
}
