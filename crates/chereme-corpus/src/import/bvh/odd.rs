//! Findings about frames that are no part of a movement, or in which the movement was lost.

use std::ops::Range;

use chereme_motion::ends::OddFrames;
use chereme_motion::lapses::{Lapse, Lapses};

use super::*;

/// The number of frames that are examined at once, and of those before and after that are read with them.
const PART: (usize, usize) = (16 * BLOCK_FRAMES, BLOCK_FRAMES);
/// The number of lapses that a finding lists.
const LISTED: usize = 6;
/// The least share of frames that repeat the frame before, if the movement was recorded at another rate.
const REPEATED: f64 = 0.08;

/// Reports bind poses, T-poses and jumps at the ends of a recording, and lapses between them.
pub(in crate::import) fn report_odd_frames(
    job: &Job<'_>,
    recording: i64,
    report: &mut FileReport,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let stored = MotionTrack::of(job.connection, recording)?;
    let anatomy = stored.anatomy(job.connection)?;
    let odd = stored.odd_frames(job.connection, &anatomy)?;
    let texts: Vec<String> = odd.iter().map(ToString::to_string).collect();
    report.understood.odd_frames = Some(texts.clone());
    if !texts.is_empty() {
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: format!(
                "no part of the movement, and left out of measures and pictures: {}",
                texts.join("; ")
            ),
            remedy: Some("a recipe cuts them off: `| trim`, or `| span 0.2s..`".into()),
        });
    }
    let sound = OddFrames::remaining(stored.frames(), &odd);
    let lapses = lapses(job, &stored, &anatomy, sound, progress)?;
    let texts: Vec<String> = lapses.found.iter().map(ToString::to_string).collect();
    if !texts.is_empty() {
        let shown = texts.iter().take(LISTED).cloned().collect::<Vec<_>>();
        let shown = shown.join("; ");
        let message = match texts.len().saturating_sub(LISTED) {
            0 => format!("the movement was probably lost here: {shown}"),
            more => format!("the movement was probably lost here: {shown}; and {more} times more"),
        };
        report.findings.push(ReportFinding::warning(
            message,
            "what is read from these frames may be wrong: look at them, and keep signs clear of them, or mend the capture and import it again",
        ));
    }
    report.understood.lapses = Some(texts);
    if !lapses.bends && stored.frames() > 1 {
        report.findings.push(ReportFinding::warning(
            "no joint of the body turns in this take: its arms and hands stand still",
            "export the take again with the movement of all joints, and import that file; nothing is proposed for this one",
        ));
    }
    let distinct = lapses.moving.saturating_sub(lapses.repeated);
    if lapses.repeated as f64 > REPEATED * lapses.moving as f64 && distinct > 1 {
        let rate = stored.rate.per_second() * distinct as f64 / lapses.moving as f64;
        report.findings.push(ReportFinding::note(format!(
            "frames stand several times: the movement was recorded at about {rate:.0} frames a second"
        )));
    }
    Ok(())
}

/// Returns the lapses of a recording in its `sound` frames, read part by part.
fn lapses(
    job: &Job<'_>,
    stored: &MotionTrack,
    anatomy: &Anatomy,
    sound: Range<usize>,
    progress: &mut Progress<'_>,
) -> Result<Lapses> {
    let (part, beside) = PART;
    let mut lapses = Lapses::default();
    for core in sound.clone().step_by(part) {
        let core = core..(core + part).min(sound.end);
        let read =
            core.start.saturating_sub(beside).max(sound.start)..(core.end + beside).min(sound.end);
        let clip = stored.clip(job.connection, read.clone(), &ChannelGroup::ALL)?;
        let found = Lapses::of(&clip, anatomy);
        let moved = found.found.into_iter().map(|lapse| Lapse {
            frames: lapse.frames.start + read.start..lapse.frames.end + read.start,
            ..lapse
        });
        // Each lapse ends in one part.
        lapses
            .found
            .extend(moved.filter(|lapse| core.contains(&(lapse.frames.end - 1))));
        lapses.repeated += found.repeated;
        lapses.moving += found.moving;
        lapses.bends |= found.bends;
        progress.report(Step {
            task: &job.file_name,
            done: core.end as u64,
            total: Some(sound.end as u64),
            unit: Unit::Frames,
        })?;
    }
    Ok(lapses)
}
