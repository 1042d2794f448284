//! Points within a span of a recording, for display.

use chereme_motion::{Instant, Markers, Span};

use super::{TrackKind, TrackRow, read};
use crate::Corpus;
use crate::db::tracks;
use crate::error::Result;

/// The frames of a track of points within a span.
#[derive(Debug, Clone, PartialEq)]
pub struct PointsPiece {
    /// The track.
    pub track: TrackRow,
    /// Its points at the frames of the span.
    pub markers: Markers,
    /// The moment of the recording that corresponds to time 0 of these points.
    pub start: Instant,
}

impl PointsPiece {
    /// Returns the frame that is shown at a moment of the recording; `None` before the first and after the last one.
    #[must_use]
    pub fn frame_at(&self, at: Instant) -> Option<usize> {
        let own = at.shifted(-self.start.micros());
        let frames = self.markers.frames();
        let span = self.markers.times().span(frames);
        match own < Instant::ZERO || own > span.end() {
            true => None,
            false => self.markers.times().frame_at(own, frames),
        }
    }
}

impl Corpus {
    /// Returns the points within a span of a recording, for every track of markers that has frames there.
    ///
    /// # Errors
    /// Fails if there is no such recording, or rows or blocks are damaged.
    pub fn points_in(&self, recording: i64, span: Span) -> Result<Vec<PointsPiece>> {
        let connection = self.store.read();
        let mut pieces = Vec::new();
        for track in tracks::tracks(connection, recording)? {
            let meets = track.span().intersection(span).is_some();
            if track.kind != TrackKind::Markers || !meets {
                continue;
            }
            let markers = read::markers(connection, &track, Some(span))?;
            if markers.frames() == 0 {
                continue;
            }
            // Frames at an even rate are counted from the first one of the span.
            let skipped = track.rate.map_or(0, |rate| {
                let first = rate.frames_in(span.shifted(-track.offset_us)).start;
                rate.instant(first).micros()
            });
            pieces.push(PointsPiece {
                start: Instant::from_micros(track.offset_us.saturating_add(skipped)),
                markers,
                track,
            });
        }
        Ok(pieces)
    }
}
