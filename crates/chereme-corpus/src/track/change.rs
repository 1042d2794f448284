//! Operations on the tracks of a recording: add, move on the clock, rename, remove.

use chereme_motion::Span;

use super::{NewTrack, Track, TrackRow, read, store};
use crate::Corpus;
use crate::address::{self, Name};
use crate::db::recordings;
use crate::db::tracks;
use crate::error::{Error, Result};
use crate::words::effect::{OperationEffect, TrackEffect};

/// A change of a track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TrackChange {
    /// The time of its own time 0 on the recording's clock, in microseconds.
    Offset(i64),
    /// Its new name.
    Name(String),
    /// It is removed, with all its numbers.
    Remove,
}

impl Corpus {
    /// Returns the tracks of a recording, oldest first.
    ///
    /// # Errors
    /// Fails if there is no such recording, or the database fails.
    pub fn tracks(&self, recording: &Name) -> Result<Vec<TrackRow>> {
        let connection = self.store.read();
        let row = address::recording(connection, recording)?;
        tracks::tracks(connection, row.id)
    }

    /// Returns the content of the track of that row, with each number as in its file: all of it, or the frames within a
    /// span of the recording's clock. Frame 0 is then the first frame of the span.
    ///
    /// # Errors
    /// Fails if there is no such track, or it is damaged.
    pub fn track(&self, track: i64, span: Option<Span>) -> Result<Track> {
        let connection = self.store.read();
        read::track(connection, &tracks::track(connection, track)?, span)
    }

    /// Adds tracks to a recording as one operation, and returns their rows.
    ///
    /// # Errors
    /// Fails if there is no such recording, or a track has no frames.
    pub fn add_tracks(&mut self, recording: &Name, new: &[NewTrack]) -> Result<Vec<TrackRow>> {
        self.store.operation(|connection| {
            let row = address::recording(connection, recording)?;
            let mut added = Vec::with_capacity(new.len());
            for track in new {
                let id = store::store(connection, row.id, track)?;
                added.push(tracks::track(connection, id)?);
            }
            let effect = OperationEffect::AddTracks {
                recording: row.name,
                tracks: added.iter().map(|track| track.name.clone()).collect(),
            };
            Ok((added, effect))
        })
    }

    /// Changes the track of a recording that has this name, and returns the recording's tracks.
    ///
    /// The body of a recording is the track that its annotations and tokens were created on: it can be moved and
    /// removed like the others, and annotations keep their times on the clock.
    ///
    /// # Errors
    /// Fails if there is no such recording or track, or another track has the new name.
    pub fn change_track(
        &mut self,
        recording: &Name,
        track: &str,
        change: &TrackChange,
    ) -> Result<Vec<TrackRow>> {
        self.store.operation(|connection| {
            let row = address::recording(connection, recording)?;
            let before = tracks::tracks(connection, row.id)?;
            let own = named(&before, &row.name, track)?;
            match change {
                TrackChange::Offset(offset_us) => {
                    tracks::set_offset(connection, own.id, *offset_us)?;
                    let end = tracks::track(connection, own.id)?.span().end();
                    recordings::lengthen(connection, row.id, end.micros())?;
                }
                TrackChange::Name(name) => {
                    let name = name.trim();
                    if name.is_empty() {
                        return Err(Error::wrong("a track needs a name"));
                    }
                    if before.iter().any(|it| it.name == name && it.id != own.id) {
                        return Err(Error::wrong(format!("another track is called {name:?}"))
                            .at(name)
                            .advise("give it another name"));
                    }
                    tracks::rename(connection, own.id, name)?;
                }
                TrackChange::Remove => tracks::remove(connection, own.id)?,
            }
            let change = match change {
                TrackChange::Offset(micros) => TrackEffect::Moved {
                    seconds: format!("{:.6}", *micros as f64 / 1e6),
                },
                TrackChange::Name(name) => TrackEffect::Renamed { to: name.clone() },
                TrackChange::Remove => TrackEffect::Removed,
            };
            let effect = OperationEffect::ChangeTrack {
                recording: row.name,
                track: track.to_owned(),
                change,
            };
            Ok((tracks::tracks(connection, row.id)?, effect))
        })
    }
}

/// Returns the track of that name.
pub(super) fn named<'a>(all: &'a [TrackRow], recording: &str, name: &str) -> Result<&'a TrackRow> {
    all.iter().find(|track| track.name == name).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|track| track.name.as_str()).collect();
        let remedy = match names.as_slice() {
            [] => "the recording has no track; import a file into it".to_owned(),
            names => format!("its tracks are: {}", names.join(", ")),
        };
        Error::wrong(format!("{recording:?} has no track {name:?}"))
            .at(name)
            .advise(remedy)
    })
}
