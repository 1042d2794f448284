//! Operations on the tracks of a recording: add, move on the clock, rename, remove.

use chereme_motion::TimeSpan;

use super::{NewTrack, TrackContent, TrackRow, track_read, track_store};
use crate::Corpus;
use crate::address::{self, RowName};
use crate::db::stored_recordings;
use crate::db::stored_tracks;
use crate::error::{CorpusError, CorpusResult};
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
    pub fn recording_tracks(&self, recording: &RowName) -> CorpusResult<Vec<TrackRow>> {
        let connection = self.store.read_connection();
        let row = address::find_recording_by_name(connection, recording)?;
        stored_tracks::load_track_rows(connection, row.id)
    }

    /// Returns the content of the track of that row, with each number as in its file: all of it, or the frames within a
    /// span of the recording's clock. Frame 0 is then the first frame of the span.
    ///
    /// # Errors
    /// Fails if there is no such track, or it is damaged.
    pub fn read_track_content(&self, track: i64, span: Option<TimeSpan>) -> CorpusResult<TrackContent> {
        let connection = self.store.read_connection();
        track_read::read_stored_track(connection, &stored_tracks::load_track_row(connection, track)?, span)
    }

    /// Adds tracks to a recording as one operation, and returns their rows.
    ///
    /// # Errors
    /// Fails if there is no such recording, or a track has no frames.
    pub fn add_tracks(&mut self, recording: &RowName, new: &[NewTrack]) -> CorpusResult<Vec<TrackRow>> {
        self.store.run_store_operation(|connection| {
            let row = address::find_recording_by_name(connection, recording)?;
            let mut added = Vec::with_capacity(new.len());
            for track in new {
                let id = track_store::store_new_track(connection, row.id, track)?;
                added.push(stored_tracks::load_track_row(connection, id)?);
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
        recording: &RowName,
        track: &str,
        change: &TrackChange,
    ) -> CorpusResult<Vec<TrackRow>> {
        self.store.run_store_operation(|connection| {
            let row = address::find_recording_by_name(connection, recording)?;
            let before = stored_tracks::load_track_rows(connection, row.id)?;
            let changed_track = find_track_named(&before, &row.name, track)?;
            match change {
                TrackChange::Offset(offset_us) => {
                    stored_tracks::set_offset(connection, changed_track.id, *offset_us)?;
                    let end = stored_tracks::load_track_row(connection, changed_track.id)?
                        .track_clock_span()
                        .span_end_instant();
                    stored_recordings::lengthen_recording(connection, row.id, end.instant_micros())?;
                }
                TrackChange::Name(name) => {
                    let name = name.trim();
                    if name.is_empty() {
                        return Err(CorpusError::from_wrong_message("a track needs a name"));
                    }
                    if before
                        .iter()
                        .any(|other| other.name == name && other.id != changed_track.id)
                    {
                        return Err(
                            CorpusError::from_wrong_message(format!("another track is called {name:?}"))
                                .with_error_place(name)
                                .with_advice("give it another name"),
                        );
                    }
                    stored_tracks::rename_track(connection, changed_track.id, name)?;
                }
                TrackChange::Remove => stored_tracks::remove_track(connection, changed_track.id)?,
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
            Ok((stored_tracks::load_track_rows(connection, row.id)?, effect))
        })
    }
}

/// Returns the track of that name.
pub(super) fn find_track_named<'a>(all: &'a [TrackRow], recording: &str, name: &str) -> CorpusResult<&'a TrackRow> {
    all.iter().find(|track| track.name == name).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|track| track.name.as_str()).collect();
        let remedy = match names.as_slice() {
            [] => "the recording has no track; import a file into it".to_owned(),
            names => format!("its tracks are: {}", names.join(", ")),
        };
        CorpusError::from_wrong_message(format!("{recording:?} has no track {name:?}"))
            .with_error_place(name)
            .with_advice(remedy)
    })
}
