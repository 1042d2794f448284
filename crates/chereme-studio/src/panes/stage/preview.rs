//! The preview of something newly opened: its stroke instead of its rest position, or all of it in a loop.

use chereme_figure::has_hand_up;
use chereme_motion::{ModelPose, RecordingInstant, TimeSpan};

use crate::context::PaneInput;
use crate::player::OpeningPreview;

/// How many moments of a span are examined.
const MAX_EXAMINED_MOMENTS: i64 = 48;
/// The length of a recording's beginning in which its stroke is searched, in microseconds.
const MAX_STROKE_SEARCH_MICROS: i64 = 10_000_000;

/// The stroke of the preview, as far as its movement is loaded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PreviewStroke {
    recording: Option<i64>,
    of: OpeningPreview,
    at: Option<RecordingInstant>,
}

/// Returns the moment that the stage shows instead of the playhead's, if there is a preview. `time` is in seconds of
/// the window's clock.
pub(super) fn preview_stage_moment(
    known: &mut Option<PreviewStroke>,
    seen: &PaneInput<'_>,
    time: f64,
) -> Option<RecordingInstant> {
    let shown = seen.shown;
    // A film shows the playhead, and the signer stays in step with it.
    if shown.made.is_some() || seen.films.are_there() {
        return None;
    }
    let preview = shown.player.current_opening_preview()?;
    let span = preview.span;
    let rate = seen.reel.reel_frame_rate()?;
    if preview.loops && span.span_micros() > 0 {
        let passed = (time * 1e6) as i64;
        let loop_time = span
            .span_start_instant()
            .shifted_instant(passed.rem_euclid(span.span_micros()));
        // The moment is the start of a frame, so that the same picture is not drawn twice.
        return Some(rate.frame_start_instant(rate.nearest_frame_at(loop_time)));
    }
    let same = |stroke: &&PreviewStroke| stroke.recording == shown.recording && stroke.of == preview;
    // The search is repeated only until all moments are loaded.
    if let Some(stroke) = known.as_ref().filter(same) {
        return stroke.at;
    }
    let (at, whole) = find_stroke_middle(seen, span)?;
    let frame_start = at.map(|at| rate.frame_start_instant(rate.nearest_frame_at(at)));
    // A stroke found in half of the moments may still change.
    if whole {
        *known = Some(PreviewStroke {
            recording: shown.recording,
            of: preview,
            at: frame_start,
        });
    }
    frame_start
}

/// Returns the middle of those examined moments of a span in which a hand is raised, and whether all moments are
/// loaded; `None` before anything is loaded.
fn find_stroke_middle(seen: &PaneInput<'_>, span: TimeSpan) -> Option<(Option<RecordingInstant>, bool)> {
    let sample = seen.reel.sample_piece()?;
    let (skeleton, anatomy) = (sample.clip.clip_skeleton(), &sample.anatomy);
    let long = span.span_micros().min(MAX_STROKE_SEARCH_MICROS);
    let moments = (0..MAX_EXAMINED_MOMENTS).map(|n| {
        span.span_start_instant()
            .shifted_instant(long * n / MAX_EXAMINED_MOMENTS)
    });
    let mut up = Vec::new();
    let mut loaded = 0;
    for at in moments {
        let Some(pose) = seen.reel.reel_pose_at(at) else {
            continue;
        };
        loaded += 1;
        if has_hand_up(&ModelPose::from_local_pose(skeleton, &pose), anatomy) {
            up.push(at);
        }
    }
    Some((up.get(up.len() / 2).copied(), loaded == MAX_EXAMINED_MOMENTS))
}
