//! Aligns tracks of one take by timecode: the time of day at which each began.

use std::ops::Range;

use chereme_motion::RecordingInstant;
use chereme_sign::ErrorRemedy;

use super::import_joining::{FileJoining, JoinQuestion};
use super::{FileReport, ImportJob, import_tracks};
use crate::db::stored_recordings;
use crate::db::stored_tracks::{self, TrackRow};
use crate::error::CorpusResult;
use crate::report_finding::ReportFinding;

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
    // A track of unknown length has none, and must not divide by zero.
    let least = (a.end - a.start).min(b.end - b.start).max(1) as f64;
    let common = [-DAY_US, 0, DAY_US].map(|day| {
        let start = a.start.max(b.start.saturating_add(day));
        a.end.min(b.end.saturating_add(day)).saturating_sub(start)
    });
    common.into_iter().max().unwrap_or_default().max(0) as f64 / least
}

/// The times of day, in microseconds, at which programs begin that have no clock: they say nothing about a take.
const UNTRUE_CLOCK_STARTS: [i64; 2] = [0, 36_000_000_000];

/// Returns whether a span begins at a time that a clock gave.
fn has_true_start(span: &Range<i64>) -> bool {
    !UNTRUE_CLOCK_STARTS.contains(&span.start)
}

/// Returns whether two spans within the day show that their tracks are of one take: they begin at times that a clock
/// gave, and are about as long as each other.
fn are_true_take_spans(own: &Range<i64>, theirs: &Range<i64>) -> bool {
    let are_alike = import_tracks::are_take_lengths(own.end - own.start, theirs.end - theirs.start);
    has_true_start(own) && has_true_start(theirs) && are_alike
}

/// Returns the recording whose tracks were captured at the same time of day, if there is exactly one in this folder, of
/// no other person and without a file of this kind. A file with annotations of its own is a take of its own. Recordings
/// near this file that only may be the same take are reported as a question.
pub(super) fn find_take_by_timecode(
    job: &ImportJob<'_>,
    days: &[Range<i64>],
    report: &mut FileReport,
) -> CorpusResult<Option<i64>> {
    let joining = job.options.joining;
    if days.is_empty() || job.options.into.is_some() || joining == FileJoining::None {
        return Ok(None);
    }
    let in_folder = job.places.in_folder(&job.place);
    let (mut fitting, mut uncertain) = (Vec::new(), Vec::new());
    for id in job.places.recordings_near_file(&job.place) {
        let rows = stored_tracks::load_track_rows(job.connection, id)?;
        let their_days: Vec<_> = rows.iter().filter_map(span_within_day).collect();
        let span_pairs = days
            .iter()
            .flat_map(|own| their_days.iter().map(move |theirs| (own, theirs)));
        let shared_spans: Vec<_> = span_pairs
            .filter(|(own, theirs)| shared_span_part(own, theirs) >= MIN_SHARED_TRACK_PART)
            .collect();
        if shared_spans.is_empty() || job.is_other_signer(id)? {
            continue;
        }
        let is_true = shared_spans
            .iter()
            .any(|(own, theirs)| are_true_take_spans(own, theirs));
        let is_likely = shared_spans
            .iter()
            .any(|(own, theirs)| has_true_start(own) || has_true_start(theirs));
        let is_near = in_folder.contains(&id);
        let is_of_kind = job.places.has_file_of_kind(id, job.kind);
        // Who joins by timecode asks for it; otherwise every sign of one take must agree.
        if joining == FileJoining::Timecode || (is_true && is_near && !is_of_kind && !job.has_own_annotations) {
            fitting.push(id);
        } else if (is_likely || (is_near && !is_of_kind)) && !job.has_own_annotations {
            uncertain.push(id);
        }
    }
    if let [one] = fitting.as_slice() {
        let name = stored_recordings::load_recording_row(job.connection, *one)?.name;
        report.findings.push(ReportFinding::finding_note(format!(
            "its timecodes are those of the recording {name:?}: it is taken for the same take"
        )));
        return Ok(Some(*one));
    }
    let candidates = if fitting.is_empty() { uncertain } else { fitting };
    job.report_join_question(JoinQuestion::Timecode, &candidates, report)?;
    Ok(None)
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
        // A take over midnight begins on one day and has its other tracks on the next.
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
