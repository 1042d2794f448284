//! The frames of recordings that pictures, transcription, comparison and publishing use.

use std::ops::Range;

use chereme_motion::ends::activity_frames;
use chereme_motion::{BodyAnatomy, TimeSpan};

use crate::Corpus;
use crate::address::{CorpusAddress, RecordingStretch};
use crate::db::stored_recordings;
use crate::error::CorpusResult;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::picture::DisplayedMovement;

impl Corpus {
    /// Returns the movement at an address without frames that are left out of measures and pictures.
    ///
    /// # Errors
    /// As [`movement`](Self::movement_at_address).
    pub fn usable_movement(&self, address: &CorpusAddress) -> CorpusResult<DisplayedMovement> {
        let span = self.usable_part(address, None)?;
        self.movement_in(address, Some(span), &ChannelGroup::ALL_CHANNEL_GROUPS)
    }

    /// Returns the usable part of the movement at an address, or of a span of it: without frames that are left out of
    /// measures and pictures. All of it if nothing else is there.
    ///
    /// # Errors
    /// Fails if nothing has that address, if several things have it, or if blocks are damaged.
    pub fn usable_part(&self, address: &CorpusAddress, span: Option<TimeSpan>) -> CorpusResult<TimeSpan> {
        let mut stretch = crate::address::find_addressed_stretch(self.store.read_connection(), address)?;
        if let Some(span) = span {
            stretch.span = stretch.span.span_intersection(span).unwrap_or_default();
        }
        self.usable_span(&stretch)
    }

    /// Returns the span of a stretch's usable frames; all of it if its recording has no movement.
    pub(crate) fn usable_span(&self, stretch: &RecordingStretch) -> CorpusResult<TimeSpan> {
        let (connection, recording) = (self.store.read_connection(), &stretch.recording);
        if stored_recordings::body_track(connection, recording.id)?.is_none() {
            return Ok(stretch.span);
        }
        let track = MotionTrack::open_motion_track(connection, recording.id)?;
        let take = crate::hands::usable_take(connection, &self.hands, recording)?;
        let all = track.frames_in(stretch.span);
        let usable = take.usable_frames_within(all.clone());
        if usable == all {
            return Ok(stretch.span);
        }
        Ok(track.rate.frame_range_span(usable).shifted_span(track.row.offset_us))
    }

    /// Returns the frames of a stretch that are read: its usable ones, and of a whole recording those between its rests.
    pub(crate) fn signed_frames(
        &self,
        track: &MotionTrack,
        anatomy: &BodyAnatomy,
        stretch: &RecordingStretch,
    ) -> CorpusResult<Range<usize>> {
        let connection = self.store.read_connection();
        let all = track.frames_in(stretch.span);
        let take = crate::hands::usable_take(connection, &self.hands, &stretch.recording)?;
        let usable = take.usable_frames_within(all.clone());
        if stretch.token.is_some() || all != (0..track.motion_frame_count()) {
            return Ok(usable);
        }
        let clip = track.read_motion_clip(connection, usable.clone(), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let active = activity_frames(&clip, anatomy);
        Ok(active.map_or(usable.clone(), |range| {
            range.start + usable.start..range.end + usable.start
        }))
    }
}
