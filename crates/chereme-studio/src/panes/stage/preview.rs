//! The preview of something newly opened: its stroke instead of its rest position, or all of it in a loop.

use chereme_figure::has_hand_up;
use chereme_motion::{Instant, ModelPose, Span};

use crate::context::PaneInput;
use crate::player::Preview;

/// How many moments of a span are examined.
const LOOKS: i64 = 48;
/// The length of a recording's beginning in which its stroke is searched, in microseconds.
const MOST: i64 = 10_000_000;

/// The stroke of the preview, as far as its movement is loaded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    recording: Option<i64>,
    of: Preview,
    at: Option<Instant>,
}

/// Returns the moment that the stage shows instead of the playhead's, if there is a preview. `time` is in seconds of
/// the window's clock.
pub(super) fn moment(
    known: &mut Option<Stroke>,
    seen: &PaneInput<'_>,
    time: f64,
) -> Option<Instant> {
    let shown = seen.shown;
    // A film shows the playhead, and the signer stays in step with it.
    if shown.made.is_some() || seen.films.are_there() {
        return None;
    }
    let preview = shown.player.previewed()?;
    let span = preview.span;
    let rate = seen.reel.rate()?;
    if preview.loops && span.micros() > 0 {
        let passed = (time * 1e6) as i64;
        let at = span.start().shifted(passed.rem_euclid(span.micros()));
        // The moment is the start of a frame, so that the same picture is not drawn twice.
        return Some(rate.instant(rate.frame_at(at)));
    }
    let same = |it: &&Stroke| it.recording == shown.recording && it.of == preview;
    if let Some(stroke) = known.as_ref().filter(same) {
        return stroke.at;
    }
    let (at, whole) = stroke(seen, span)?;
    let at = at.map(|at| rate.instant(rate.frame_at(at)));
    if whole {
        *known = Some(Stroke {
            recording: shown.recording,
            of: preview,
            at,
        });
    }
    at
}

/// Returns the middle of those examined moments of a span in which a hand is raised, and whether all moments are
/// loaded; `None` before anything is loaded.
fn stroke(seen: &PaneInput<'_>, span: Span) -> Option<(Option<Instant>, bool)> {
    let sample = seen.reel.sample()?;
    let (skeleton, anatomy) = (sample.clip.skeleton(), &sample.anatomy);
    let long = span.micros().min(MOST);
    let moments = (0..LOOKS).map(|n| span.start().shifted(long * n / LOOKS));
    let mut up = Vec::new();
    let mut loaded = 0;
    for at in moments {
        let Some(pose) = seen.reel.pose(at) else {
            continue;
        };
        loaded += 1;
        if has_hand_up(&ModelPose::of(skeleton, &pose), anatomy) {
            up.push(at);
        }
    }
    Some((up.get(up.len() / 2).copied(), loaded == LOOKS))
}
