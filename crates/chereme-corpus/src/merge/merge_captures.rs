//! Captures that both sides imported separately: files with the same bytes make them one recording.

use serde_json::Value;

use super::MergeWork;
use crate::db::stored_merge::{self as db, RowImage, TableRowKey};
use crate::db::stored_recordings;
use crate::error::CorpusResult;

impl MergeWork<'_> {
    /// Merges a new row of the other side with the one of this side that came from the same bytes: a recording, or a file
    /// or track of such a recording. Returns whether there is one.
    pub(super) fn join_same_capture(
        &mut self,
        key: &TableRowKey,
        theirs: &RowImage,
        local: &RowImage,
    ) -> CorpusResult<bool> {
        let recording = local.get("recording_id").and_then(Value::as_i64);
        let is_joined = recording.is_some_and(|id| self.joined_captures.contains(&id));
        let there = match key.0.as_str() {
            "recording" => self.find_same_capture(&key.1, local)?,
            "track" if is_joined => match self.theirs.find_row_id("track", &key.1)? {
                Some(id) => {
                    let connection = self.theirs.connection;
                    db::find_equal_track(db::StoredRowPlace { connection, id }, self.connection, local)?
                }
                None => None,
            },
            "source_file" if is_joined => db::find_equal_file(self.connection, local)?,
            _ => None,
        };
        let Some(there) = there else { return Ok(false) };
        match key.0.as_str() {
            // Each side has the file from a path of its own.
            "source_file" => self.mine.remember_row_uid(&key.0, &key.1, Some(there))?,
            "recording" => {
                self.joined_captures.insert(there);
                let name = stored_recordings::load_recording_row(self.connection, there)?.name;
                self.report.notes.push(format!(
                    "both imported the recording {name:?} from the same file: it is one recording here"
                ));
                self.join_same_named_row(key, &[], theirs, there)?;
            }
            _ => self.join_same_named_row(key, &[], theirs, there)?,
        }
        Ok(true)
    }

    /// Returns the recording of this side that the other side does not have and that came from the same bytes as one of
    /// the other side, preferably of the same name. Without a capture both have the same name and annotation file.
    fn find_same_capture(&self, uid: &str, local: &RowImage) -> CorpusResult<Option<i64>> {
        let Some(id) = self.theirs.find_row_id("recording", uid)? else {
            return Ok(None);
        };
        let name = local.get("name").and_then(Value::as_str).unwrap_or_default();
        let files = stored_recordings::source_files(self.theirs.connection, id)?;
        let has_capture = files.iter().any(|file| file.is_capture());
        let mut same_capture = None;
        // Without a capture, only equal annotation files can show that two recordings are one.
        for file in files.iter().filter(|file| !has_capture || file.is_capture()) {
            for own_file in stored_recordings::source_files_of_hash(self.connection, &file.hash)? {
                let Some(recording) = own_file.recording_id.filter(|_| own_file.kind == file.kind) else {
                    continue;
                };
                let own_uid = db::uid_of(self.connection, "recording", recording)?.unwrap_or_default();
                // A recording that both sides know already by its uid is another one.
                let is_shared = self.theirs.find_row_id("recording", &own_uid)?.is_some();
                if is_shared || self.joined_captures.contains(&recording) {
                    continue;
                }
                if stored_recordings::load_recording_row(self.connection, recording)?.name == name {
                    return Ok(Some(recording));
                }
                // Two names for one capture are one take; one annotation file may well lie beside two.
                same_capture = same_capture.or(Some(recording).filter(|_| has_capture));
            }
        }
        Ok(same_capture)
    }
}
