//! Captures whose movement the corpus has already, as a stretch of another recording.

use std::collections::{BTreeMap, BTreeSet};

use rusqlite::Connection;

use super::{FileReport, FileStatus};
use crate::consent;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::error::CorpusResult;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;

/// Adds to the reports of new captures whose movement theirs is.
pub(super) fn report_known_movement_pieces(
    connection: &Connection,
    files: &mut [FileReport],
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let rows = stored_recordings::load_recording_rows(connection)?;
    let is_capture = |file: &FileReport| file.status == FileStatus::Imported && file.understood.movement.is_some();
    let new = files.iter().enumerate().filter(|(_, file)| is_capture(file));
    let new: BTreeMap<i64, usize> = new
        .filter_map(|(at, file)| {
            let is_named = |row: &&RecordingRow| Some(&row.name) == file.recording.as_ref();
            Some((rows.iter().find(is_named)?.id, at))
        })
        .collect();
    let (pieces, others): (BTreeSet<i64>, BTreeSet<i64>) =
        rows.iter().map(|row| row.id).partition(|id| new.contains_key(id));
    let takes = pieces.union(&others).copied().collect();
    let mut found = consent::find_movement_pieces(connection, &pieces, &takes, progress)?;
    // A longer recording may hold a whole take that was there before.
    found.extend(consent::find_movement_pieces(connection, &others, &pieces, progress)?);
    for found in found {
        let (is_piece, piece) = (new.contains_key(&found.piece), found.piece);
        let (known, at) = match is_piece {
            true => (found.take, new[&piece]),
            false => (piece, new[&found.take]),
        };
        let row_of = |id: i64| rows.iter().find(|row| row.id == id);
        let own = row_of(if is_piece { piece } else { found.take });
        let Some(take) = row_of(known) else {
            continue;
        };
        // Of one signer, the consents are one already.
        if take.signer_id.is_some() && own.is_some_and(|own| own.signer_id == take.signer_id) {
            continue;
        }
        let (start, end) = (found.span.span_start_instant(), found.span.span_end_instant());
        let (name, signer) = (&take.name, take.signer.as_deref().unwrap_or("-"));
        let message = match is_piece {
            true => format!("its movement is that of the recording {name:?} from {start} to {end}, of {signer}"),
            false => format!("from {start} to {end} it shows the recording {name:?}, of {signer}"),
        };
        files[at].findings.push(ReportFinding::finding_warning(
            message,
            "it shows the same person, so that the narrower consent of the two recordings holds; give both the same \
             signer, or undo the import",
        ));
    }
    Ok(())
}
