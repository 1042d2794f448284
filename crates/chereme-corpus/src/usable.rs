//! The frames of recordings that pictures, transcription, comparison and publishing use.

use std::ops::Range;

use chereme_motion::ends::activity;
use chereme_motion::{Anatomy, Span};

use crate::Corpus;
use crate::address::{Address, Stretch};
use crate::db::recordings;
use crate::error::Result;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::picture::Moving;

/// The part of a recording that pictures and measures use.
#[derive(Debug, Clone)]
pub(crate) struct UsableTake {
    /// The frames without odd ones at the ends.
    pub(crate) frames: Range<usize>,
    /// Whether any joint turns in them, besides those that carry the whole body.
    pub(crate) bends: bool,
}

impl UsableTake {
    /// Returns the usable ones of some frames; all of them if none is.
    pub(crate) fn within(&self, frames: Range<usize>) -> Range<usize> {
        let usable = frames.start.max(self.frames.start)..frames.end.min(self.frames.end);
        if usable.is_empty() { frames } else { usable }
    }
}

impl Corpus {
    /// Returns the movement at an address without frames that are left out of measures and pictures.
    ///
    /// # Errors
    /// As [`movement`](Self::movement).
    pub fn usable_movement(&self, address: &Address) -> Result<Moving> {
        let span = self.usable_part(address, None)?;
        self.movement_in(address, Some(span), &ChannelGroup::ALL)
    }

    /// Returns the usable part of the movement at an address, or of a span of it: without frames that are left out of
    /// measures and pictures. All of it if nothing else is there.
    ///
    /// # Errors
    /// Fails if nothing has that address, if several things have it, or if blocks are damaged.
    pub fn usable_part(&self, address: &Address, span: Option<Span>) -> Result<Span> {
        let mut stretch = crate::address::stretch(self.store.read(), address)?;
        if let Some(span) = span {
            stretch.span = stretch.span.intersection(span).unwrap_or_default();
        }
        self.usable_span(&stretch)
    }

    /// Returns the span of a stretch's usable frames; all of it if its recording has no movement.
    pub(crate) fn usable_span(&self, stretch: &Stretch) -> Result<Span> {
        let (connection, recording) = (self.store.read(), &stretch.recording);
        if recordings::body_track(connection, recording.id)?.is_none() {
            return Ok(stretch.span);
        }
        let track = MotionTrack::of(connection, recording.id)?;
        let take = crate::hands::usable_take(connection, &self.hands, recording)?;
        let all = track.frames_in(stretch.span);
        let usable = take.within(all.clone());
        if usable == all {
            return Ok(stretch.span);
        }
        Ok(track.rate.span(usable).shifted(track.row.offset_us))
    }

    /// Returns the frames of a stretch that are read: its usable ones, and of a whole recording those between its rests.
    pub(crate) fn signed_frames(
        &self,
        (track, anatomy): (&MotionTrack, &Anatomy),
        stretch: &Stretch,
    ) -> Result<Range<usize>> {
        let connection = self.store.read();
        let all = track.frames_in(stretch.span);
        let take = crate::hands::usable_take(connection, &self.hands, &stretch.recording)?;
        let usable = take.within(all.clone());
        if stretch.token.is_some() || all != (0..track.frames()) {
            return Ok(usable);
        }
        let clip = track.clip(connection, usable.clone(), &ChannelGroup::ALL)?;
        let active = activity(&clip, anatomy);
        Ok(active.map_or(usable.clone(), |it| {
            it.start + usable.start..it.end + usable.start
        }))
    }
}
