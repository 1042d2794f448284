//! Findings about frames that are no part of a movement, or in which the movement was lost.

use std::ops::Range;

use chereme_motion::ends::OddFrames;
use chereme_motion::lapses::{ClipLapses, MotionLapse};

use super::*;

/// The number of frames that are examined at once, and of those before and after that are read with them.
const EXAMINED_PART_FRAMES: (usize, usize) = (16 * BLOCK_FRAMES, BLOCK_FRAMES);
/// The number of lapses that a finding lists.
const MAX_LISTED_LAPSES: usize = 6;
/// The least share of frames that repeat the frame before, if the movement was recorded at another rate.
const MIN_REPEATED_FRAME_SHARE: f64 = 0.08;

/// Reports bind poses, T-poses and jumps at the ends of a recording, and lapses between them.
pub(in crate::import) fn report_odd_frames(
    job: &ImportJob<'_>,
    recording: i64,
    report: &mut FileReport,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let stored = MotionTrack::open_motion_track(job.connection, recording)?;
    let anatomy = stored.track_anatomy(job.connection)?;
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
    let sound = OddFrames::remaining_frames(stored.motion_frame_count(), &odd);
    let lapses = find_recording_lapses(job, &stored, &anatomy, sound, progress)?;
    let texts: Vec<String> = lapses.found.iter().map(ToString::to_string).collect();
    if !texts.is_empty() {
        let shown_texts = texts.iter().take(MAX_LISTED_LAPSES).cloned().collect::<Vec<_>>();
        let shown = shown_texts.join("; ");
        let message = match texts.len().saturating_sub(MAX_LISTED_LAPSES) {
            0 => format!("the movement was probably lost here: {shown}"),
            more => format!("the movement was probably lost here: {shown}; and {more} times more"),
        };
        report.findings.push(ReportFinding::finding_warning(
            message,
            "what is read from these frames may be wrong: look at them, and keep signs clear of them, or mend the capture and import it again",
        ));
    }
    report.understood.lapses = Some(texts);
    if !lapses.bends && stored.motion_frame_count() > 1 {
        report.findings.push(ReportFinding::finding_warning(
            "no joint of the body turns in this take: its arms and hands stand still",
            "export the take again with the movement of all joints, and import that file; nothing is proposed for this one",
        ));
    }
    let distinct = lapses.moving.saturating_sub(lapses.repeated);
    // A few repeated frames are moments of rest in the data; many show a lower rate of the capture.
    if lapses.repeated as f64 > MIN_REPEATED_FRAME_SHARE * lapses.moving as f64 && distinct > 1 {
        let rate = stored.rate.per_second() * distinct as f64 / lapses.moving as f64;
        report.findings.push(ReportFinding::finding_note(format!(
            "frames stand several times: the movement was recorded at about {rate:.0} frames a second"
        )));
    }
    Ok(())
}

/// Returns the lapses of a recording in its `sound` frames, read part by part.
fn find_recording_lapses(
    job: &ImportJob<'_>,
    stored: &MotionTrack,
    anatomy: &BodyAnatomy,
    sound: Range<usize>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<ClipLapses> {
    let (part, beside) = EXAMINED_PART_FRAMES;
    let mut lapses = ClipLapses::default();
    for core in sound.clone().step_by(part) {
        let core = core..(core + part).min(sound.end);
        // Frames on both sides show whether a movement at the border of a part goes on.
        let read = core.start.saturating_sub(beside).max(sound.start)..(core.end + beside).min(sound.end);
        let clip = stored.read_motion_clip(job.connection, read.clone(), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let clip_lapses = ClipLapses::find_clip_lapses(&clip, anatomy);
        let moved = clip_lapses.found.into_iter().map(|lapse| MotionLapse {
            frames: lapse.frames.start + read.start..lapse.frames.end + read.start,
            ..lapse
        });
        // Each lapse ends in one part.
        lapses
            .found
            .extend(moved.filter(|lapse| core.contains(&(lapse.frames.end - 1))));
        lapses.repeated += clip_lapses.repeated;
        lapses.moving += clip_lapses.moving;
        lapses.bends |= clip_lapses.bends;
        progress.report_frames(&job.file_name, core.end, sound.end)?;
    }
    Ok(lapses)
}
