//! The content of a corpus for display in a window, read at one moment: an overview of everything, and one complete
//! recording.

use chereme_sign::SignerHandedness;
use rusqlite::Connection;

use crate::Corpus;
use crate::curves::face_stage;
use crate::db::lexicons::{self, LexiconRow};
use crate::db::people::{self, PersonContents};
use crate::db::signs::{self, TokenRow};
use crate::db::stored_attributes;
use crate::db::stored_contents as rows;
use crate::db::stored_recordings::{self, MediaTrackRow, RecordingRow, SignerRow};
use crate::db::stored_rows::KeptSearch;
pub use crate::db::stored_rows::{AnnotationColumns, RecordingGlance, ShownFrames, SignGlance};
use crate::db::stored_search::begin_reading;
use crate::db::stored_tiers::{self, TierRow};
use crate::db::stored_tracks::{self, TrackRow};
use crate::db::{OperationRow, history_log};
use crate::error::CorpusResult;
use crate::inventories::{self, EqualValues, StoredInventory};
use crate::merge::CorpusConflict;
use crate::search::saved_search;
use crate::tokens;

/// Overview of a corpus at one moment.
#[derive(Debug, Clone, Default)]
pub struct CorpusOverview {
    /// The moment: [`Corpus::corpus_generation`].
    pub generation: i64,
    /// Whether the file cannot be written, so that every change is refused.
    pub read_only: bool,
    /// The recordings, in the order in which they were stored.
    pub recordings: Vec<RecordingGlance>,
    /// The signs, by gloss.
    pub signs: Vec<SignGlance>,
    /// The lexicons, by name.
    pub lexicons: Vec<LexiconRow>,
    /// The signers, by name.
    pub signers: Vec<SignerRow>,
    /// All people, by name: signers, participants and annotators.
    pub people: Vec<PersonContents>,
    /// The annotator whose readings count before those of others, if the corpus names one.
    pub preferred_annotator: Option<String>,
    /// The inventories, oldest first.
    pub inventories: Vec<StoredInventory>,
    /// The values of different inventories that are one.
    pub equal_values: EqualValues,
    /// The names of the attributes of signs, in order.
    pub attributes: Vec<String>,
    /// The saved searches, by name.
    pub searches: Vec<KeptSearch>,
    /// The newest operations, the newest first.
    pub operations: Vec<OperationRow>,
    /// The conflicts of merges that wait for a decision.
    pub conflicts: Vec<CorpusConflict>,
}

/// The annotations of one recording, at one moment.
#[derive(Debug, Clone)]
pub struct RecordingContents {
    /// The moment: [`Corpus::corpus_generation`].
    pub generation: i64,
    /// The recording.
    pub recording: RecordingRow,
    /// Its tiers in their order, with their annotations.
    pub tiers: Vec<TierContents>,
    /// Its tokens, by time.
    pub tokens: Vec<TokenRow>,
    /// Its media files.
    pub media: Vec<MediaTrackRow>,
    /// Its tracks of every kind.
    pub tracks: Vec<TrackRow>,
    /// Who accepts proposals for it.
    pub acceptor: ProposalAcceptor,
}

/// A tier with its annotations.
#[derive(Debug, Clone, PartialEq)]
pub struct TierContents {
    /// The tier.
    pub row: TierRow,
    /// The annotations, by time.
    pub annotations: AnnotationColumns,
}

/// Who accepts proposals, and for whom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProposalAcceptor {
    /// The annotator.
    pub author: String,
    /// The handedness of the signer, by which a dominant hand is a right or a left one.
    pub handedness: SignerHandedness,
}

/// Adds the frames of faces without a skeleton.
fn with_faces(connection: &Connection, mut recordings: Vec<RecordingGlance>) -> CorpusResult<Vec<RecordingGlance>> {
    let faces = face_stage::shown_alone(connection)?;
    for glance in &mut recordings {
        glance.face_alone = faces.get(&glance.row.id).copied();
    }
    Ok(recordings)
}

impl Corpus {
    /// Returns a number that grows with every change of the corpus, by any program; it is cheap to read.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn corpus_generation(&self) -> CorpusResult<i64> {
        rows::newest_operation_number(self.store.read_connection())
    }

    /// Returns an overview of the corpus, with its newest `operations` operations.
    ///
    /// # Errors
    /// Fails if the database fails or holds invalid rows.
    pub fn load_corpus_overview(&self, operations: usize) -> CorpusResult<CorpusOverview> {
        // All parts must show the same moment, also while another program writes.
        let reading = begin_reading(self.store.read_connection())?;
        Ok(CorpusOverview {
            generation: rows::newest_operation_number(&reading)?,
            read_only: rows::is_read_only(&reading)?,
            recordings: with_faces(&reading, rows::load_recording_glances(&reading)?)?,
            signs: rows::load_sign_glances(&reading)?,
            lexicons: lexicons::load_lexicon_rows(&reading)?,
            signers: stored_recordings::load_signer_rows(&reading)?,
            people: people::load_people(&reading)?,
            preferred_annotator: tokens::preferred_annotator(&reading)?,
            inventories: inventories::load_all_inventories(&reading)?,
            equal_values: EqualValues::load_equal_values(&reading)?,
            attributes: stored_attributes::list_attribute_names(&reading)?,
            searches: saved_search::list_saved_searches(&reading)?,
            operations: history_log(&reading, operations)?,
            conflicts: crate::merge::undecided_conflicts(&reading)?,
        })
    }

    /// Returns the annotations of the recording of that row.
    ///
    /// # Errors
    /// Fails if there is no such recording, or the database fails.
    pub fn load_recording_contents(&self, recording: i64) -> CorpusResult<RecordingContents> {
        // Another program may write between the queries, which must still fit together.
        let reading = begin_reading(self.store.read_connection())?;
        let tiers = stored_tiers::load_tier_rows(&reading, recording)?
            .into_iter()
            .map(|row| {
                Ok(TierContents {
                    annotations: rows::load_annotation_columns(&reading, row.id)?,
                    row,
                })
            });
        Ok(RecordingContents {
            generation: rows::newest_operation_number(&reading)?,
            recording: stored_recordings::load_recording_row(&reading, recording)?,
            tiers: tiers.collect::<CorpusResult<_>>()?,
            tokens: signs::tokens_of_recording(&reading, recording)?,
            media: stored_recordings::media_tracks(&reading, recording)?,
            tracks: stored_tracks::load_track_rows(&reading, recording)?,
            acceptor: self.proposal_acceptor(recording)?,
        })
    }

    /// Returns who accepts proposals for a recording.
    pub(crate) fn proposal_acceptor(&self, recording: i64) -> CorpusResult<ProposalAcceptor> {
        let connection = self.store.read_connection();
        let recording = stored_recordings::load_recording_row(connection, recording)?;
        Ok(ProposalAcceptor {
            author: self.store.store_author().to_owned(),
            handedness: tokens::recording_handedness(connection, &recording)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ValueState;
    use crate::{ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};
    use chereme_sign::TierRole;

    #[test]
    fn the_contents_of_a_recording_equal_its_rows_and_reflect_every_change() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = folder.path().join("starter");
        let paths = unpack_starter(&files).expect("unpacked");
        let two = |path: &std::path::PathBuf| path.file_stem().is_some_and(|stem| stem == "bol" || stem == "lexicon");
        let paths: Vec<_> = paths.into_iter().filter(two).collect();
        let path = folder.path().join("c.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let other = Corpus::open_corpus(&path, "B").expect("opened");
        assert_eq!(other.corpus_generation().expect("read"), 0);
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(&paths, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
            .expect("imported");
        assert_eq!(other.corpus_generation().expect("read"), 1);
        let overview = other.load_corpus_overview(10).expect("read");
        assert_eq!(overview.recordings.len(), 1);
        assert!(overview.recordings[0].frames > 0 && overview.recordings[0].rate.is_some());
        assert!(overview.signs.len() > 1 && overview.signs.iter().all(|s| s.citation.is_some()));
        let recording = overview.recordings[0].row.id;
        let placed = overview.signs.iter().filter_map(|s| Some((&*s.gloss, s.place?.0)));
        assert_eq!(placed.collect::<Vec<_>>(), [("BOL", recording)]);
        assert!(!overview.inventories.is_empty());
        assert_eq!(overview.operations.len(), 1);
        let contents = other
            .load_recording_contents(overview.recordings[0].row.id)
            .expect("read");
        let gloss = contents
            .tiers
            .iter()
            .find(|tier| tier.row.role == TierRole::Gloss)
            .expect("a gloss tier");
        assert_eq!(&*gloss.annotations.values[0], "BOL");
        assert_eq!(gloss.annotations.states[0], ValueState::Value);
        assert!(!gloss.annotations.annotation_span_at(0).is_empty());
        assert!(contents.tiers.iter().all(|tier| {
            let starts = &tier.annotations.starts;
            starts.is_sorted() && starts.len() == tier.annotations.len()
        }));
        assert!(other.load_recording_contents(999).is_err());
        corpus.undo_operation().expect("undone");
        assert_eq!(other.corpus_generation().expect("read"), 2);
    }
}
