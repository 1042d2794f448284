//! Points within a span of a recording, for display.

use chereme_motion::{MarkerTrack, RecordingInstant, TimeSpan};

use super::{TrackKind, TrackRow, track_read};
use crate::Corpus;
use crate::db::stored_tracks;
use crate::error::CorpusResult;

/// The frames of a track of points within a span.
#[derive(Debug, Clone, PartialEq)]
pub struct PointsPiece {
    /// The track.
    pub track: TrackRow,
    /// Its points at the frames of the span.
    pub markers: MarkerTrack,
    /// The moment of the recording that corresponds to time 0 of these points.
    pub start: RecordingInstant,
}

impl PointsPiece {
    /// Returns the frame that is shown at a moment of the recording; `None` before the first and after the last one.
    #[must_use]
    pub fn piece_frame_at(&self, at: RecordingInstant) -> Option<usize> {
        let track_time = at.shifted_instant(-self.start.instant_micros());
        let frames = self.markers.marker_frame_count();
        let span = self.markers.marker_times().frame_times_span(frames);
        match track_time < RecordingInstant::RECORDING_START || track_time > span.span_end_instant() {
            true => None,
            false => self.markers.marker_times().shown_frame_at(track_time, frames),
        }
    }
}

impl Corpus {
    /// Returns the points within a span of a recording, for every track of markers that has frames there.
    ///
    /// # Errors
    /// Fails if there is no such recording, or rows or blocks are damaged.
    pub fn points_in(&self, recording: i64, span: TimeSpan) -> CorpusResult<Vec<PointsPiece>> {
        let connection = self.store.read_connection();
        let mut pieces = Vec::new();
        for track in stored_tracks::load_track_rows(connection, recording)? {
            let meets = track.track_clock_span().span_intersection(span).is_some();
            if track.kind != TrackKind::Markers || !meets {
                continue;
            }
            let markers = track_read::read_track_markers(connection, &track, Some(span))?;
            if markers.marker_frame_count() == 0 {
                continue;
            }
            // Frames at an even rate are counted from the first one of the span.
            let skipped = track.rate.map_or(0, |rate| {
                let first = rate.frames_in(span.shifted_span(-track.offset_us)).start;
                rate.frame_start_instant(first).instant_micros()
            });
            pieces.push(PointsPiece {
                start: RecordingInstant::from_micros(track.offset_us.saturating_add(skipped)),
                markers,
                track,
            });
        }
        Ok(pieces)
    }
}
