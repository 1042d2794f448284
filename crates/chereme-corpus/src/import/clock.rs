//! Aligns tracks of one take by timecode: the time of day at which each began.

use std::ops::Range;

use chereme_motion::Instant;
use chereme_sign::Remedy;

use super::report::ReportFinding;
use super::{FileReport, Job};
use crate::db::recordings;
use crate::db::tracks::{self, TrackRow};
use crate::error::Result;

/// A day in microseconds.
const DAY: i64 = 86_400_000_000;
/// The smallest share of the shorter track that two tracks of one take have in common.
const SHARED: f64 = 0.5;

/// Returns the span of a track within the day.
fn day(row: &TrackRow) -> Option<Range<i64>> {
    let start = row.clock_us?;
    Some(start..start.saturating_add(row.duration_us.unwrap_or_default()))
}

/// Returns the overlap of two spans as a share of the shorter one; one of them may cross midnight.
fn shared(a: &Range<i64>, b: &Range<i64>) -> f64 {
    let least = (a.end - a.start).min(b.end - b.start).max(1) as f64;
    let common = [-DAY, 0, DAY].map(|day| {
        let start = a.start.max(b.start.saturating_add(day));
        a.end.min(b.end.saturating_add(day)).saturating_sub(start)
    });
    common.into_iter().max().unwrap_or_default().max(0) as f64 / least
}

/// Returns the recording near this file whose tracks were captured at the same time of day, if there is exactly one.
pub(super) fn take_of(
    job: &Job<'_>,
    days: &[Range<i64>],
    report: &mut FileReport,
) -> Result<Option<i64>> {
    if days.is_empty() || job.options.into.is_some() {
        return Ok(None);
    }
    let mut fitting = Vec::new();
    for id in job.places.near(&job.place) {
        let rows = tracks::tracks(job.connection, id)?;
        let known = rows.iter().filter_map(day);
        if known
            .flat_map(|known| days.iter().map(move |own| shared(own, &known)))
            .any(|share| share >= SHARED)
        {
            fitting.push(id);
        }
    }
    let mut names = Vec::with_capacity(fitting.len());
    for id in &fitting {
        names.push(format!(
            "{:?}",
            recordings::recording(job.connection, *id)?.name
        ));
    }
    match fitting.as_slice() {
        [] => Ok(None),
        [one] => {
            report.findings.push(ReportFinding::note(format!(
                "its timecodes are those of the recording {}: it is taken for the same take",
                names.concat()
            )));
            Ok(Some(*one))
        }
        _ => {
            report.findings.push(ReportFinding::warning(
                format!(
                    "its timecodes are those of several recordings: {}",
                    names.join(", ")
                ),
                Remedy::command("say which one it belongs to: import CORPUS FILE --into RECORDING"),
            ));
            Ok(None)
        }
    }
}

/// Moves new tracks of a recording so that their times of day agree with the other tracks, unless the caller gave an
/// offset.
pub(super) fn place(
    job: &Job<'_>,
    recording: i64,
    new: &[i64],
    report: &mut FileReport,
) -> Result<()> {
    if job.options.offset_us != 0 {
        return Ok(());
    }
    let rows = tracks::tracks(job.connection, recording)?;
    let known = |row: &&TrackRow| row.clock_us.is_some();
    let Some(other) = rows.iter().filter(known).find(|row| !new.contains(&row.id)) else {
        return Ok(());
    };
    let Some(zero) = other
        .clock_us
        .map(|clock| clock.saturating_sub(other.offset_us))
    else {
        return Ok(());
    };
    for row in rows
        .iter()
        .filter(known)
        .filter(|row| new.contains(&row.id))
    {
        let (Some(own), Some(theirs)) = (day(row), day(other)) else {
            continue;
        };
        let mut apart = own.start.saturating_sub(zero);
        if apart.abs() > DAY / 2 {
            apart -= apart.signum() * DAY;
        }
        if shared(&own, &theirs) <= 0.0 {
            report.findings.push(ReportFinding::warning(
                format!(
                    "its timecodes begin {} after those of the track {:?} and share no moment with them: both start \
                     together",
                    Instant::from_micros(apart),
                    other.name
                ),
                Remedy::command("if they are of one take, say where it starts: track CORPUS RECORDING NAME --offset TIME"),
            ));
            continue;
        }
        tracks::set_offset(job.connection, row.id, apart)?;
        recordings::lengthen(
            job.connection,
            recording,
            apart.saturating_add(row.duration_us.unwrap_or_default()),
        )?;
        report.findings.push(ReportFinding::note(format!(
            "by timecode it starts {} from the start of the recording",
            Instant::from_micros(apart)
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
            (DAY - 5 * second..DAY + 5 * second, 0..5 * second, 1.0),
            (0..second, 2 * second..3 * second, 0.0),
        ] {
            assert!((shared(&a, &b) - share).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
}
