//! The content of a corpus as a window shows it, read at one moment: an overview of everything, and one recording
//! whole.

use chereme_motion::{Instant, Rate, Span};

use crate::Corpus;
use crate::db::columns::ValueState;
use crate::db::contents as rows;
use crate::db::inventories::inventories as inventory_rows;
use crate::db::recordings::{self, MediaTrackRow, RecordingRow, SignerRow};
use crate::db::search::begin_reading;
use crate::db::signs::{self, TokenRow};
use crate::db::tiers::{self, TierRow};
use crate::db::tracks::TrackKind;
use crate::db::{OperationRow, history_log};
use crate::error::Result;
use crate::inventories::{self, StoredInventory};
use crate::kept::{self, KeptSearch};
use crate::merge::CorpusConflict;

/// A corpus at a glance, at one moment.
#[derive(Debug, Clone, Default)]
pub struct Overview {
    /// The moment: [`Corpus::generation`].
    pub generation: i64,
    /// Whether its file may only be read here, so that every change is refused.
    pub read_only: bool,
    /// The recordings, in the order in which they were stored.
    pub recordings: Vec<RecordingGlance>,
    /// The signs, by gloss.
    pub signs: Vec<SignGlance>,
    /// The signers, by name.
    pub signers: Vec<SignerRow>,
    /// The inventories, oldest first.
    pub inventories: Vec<StoredInventory>,
    /// The searches that are kept, by name.
    pub searches: Vec<KeptSearch>,
    /// The newest operations, the newest first.
    pub operations: Vec<OperationRow>,
    /// The conflicts of merges that wait for a decision.
    pub conflicts: Vec<CorpusConflict>,
}

/// A recording at a glance.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordingGlance {
    /// The recording.
    pub row: RecordingRow,
    /// How many frames of movement it has; 0 where it has none.
    pub frames: u64,
    /// The rate of its frames.
    pub rate: Option<Rate>,
    /// Where its first frame lies on the recording's clock, in microseconds.
    pub offset_us: i64,
    /// The kinds of its tracks, each once.
    pub kinds: Vec<TrackKind>,
    /// How many tiers it has.
    pub tiers: u64,
    /// How many tokens it has.
    pub tokens: u64,
    /// Its recipe, if it was generated.
    pub recipe: Option<String>,
}

/// A sign at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignGlance {
    /// The row.
    pub id: i64,
    /// The gloss.
    pub gloss: String,
    /// Remarks.
    pub notes: Option<String>,
    /// How many tokens it has.
    pub tokens: u64,
    /// The token of its citation form, one with movement before a lexicon entry.
    pub citation: Option<i64>,
    /// The recording that token lies in, and where.
    pub place: Option<(i64, Span)>,
    /// Whether that token is notated.
    pub notated: bool,
}

/// The annotations of one recording, at one moment.
#[derive(Debug, Clone)]
pub struct Contents {
    /// The moment: [`Corpus::generation`].
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
    pub tracks: Vec<crate::TrackRow>,
}

/// A tier with its annotations.
#[derive(Debug, Clone, PartialEq)]
pub struct TierContents {
    /// The tier.
    pub row: TierRow,
    /// The annotations, by time.
    pub annotations: AnnotationColumns,
}

/// Annotations of a tier column by column, by start, all columns equally long.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnnotationColumns {
    /// The rows.
    pub ids: Vec<i64>,
    /// Where they start, in microseconds; never falling.
    pub starts: Vec<i64>,
    /// The first microseconds after them.
    pub ends: Vec<i64>,
    /// Whether they have values.
    pub states: Vec<ValueState>,
    /// What they say.
    pub values: Vec<Box<str>>,
    /// The annotations above.
    pub parents: Vec<Option<i64>>,
    /// How sure their origin is, from 0 to 1, where it says so.
    pub confidences: Vec<Option<f64>>,
}

impl AnnotationColumns {
    /// Returns how many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns whether the list is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Returns the span of the one at `at`.
    ///
    /// # Panics
    /// Where there are not that many.
    #[must_use]
    pub fn span(&self, at: usize) -> Span {
        let micros = Instant::from_micros;
        Span::between(micros(self.starts[at]), micros(self.ends[at]))
    }
}

impl Corpus {
    /// Returns a number that grows with every change of the corpus, by whatever program; cheap.
    ///
    /// # Errors
    /// Where the database fails.
    pub fn generation(&self) -> Result<i64> {
        rows::generation(self.store.read())
    }

    /// Returns the corpus at a glance, with its newest `operations` operations.
    ///
    /// # Errors
    /// Where the database fails or holds what cannot be.
    pub fn overview(&self, operations: usize) -> Result<Overview> {
        let reading = begin_reading(self.store.read())?;
        let inventories = inventory_rows(&reading, None)?;
        Ok(Overview {
            generation: rows::generation(&reading)?,
            read_only: rows::is_read_only(&reading)?,
            recordings: rows::recordings(&reading)?,
            signs: rows::signs(&reading)?,
            signers: recordings::signers(&reading)?,
            inventories: inventories
                .into_iter()
                .map(inventories::read)
                .collect::<Result<_>>()?,
            searches: kept::searches(&reading)?,
            operations: history_log(&reading, operations)?,
            conflicts: crate::merge::waiting(&reading)?,
        })
    }

    /// Returns the annotations of the recording of that row.
    ///
    /// # Errors
    /// Where there is no such recording, or the database fails.
    pub fn contents(&self, recording: i64) -> Result<Contents> {
        let reading = begin_reading(self.store.read())?;
        let tiers = tiers::tiers(&reading, recording)?.into_iter().map(|row| {
            Ok(TierContents {
                annotations: rows::annotations(&reading, row.id)?,
                row,
            })
        });
        Ok(Contents {
            generation: rows::generation(&reading)?,
            recording: recordings::recording(&reading, recording)?,
            tiers: tiers.collect::<Result<_>>()?,
            tokens: signs::tokens_of_recording(&reading, recording)?,
            media: recordings::media_tracks(&reading, recording)?,
            tracks: crate::db::tracks::tracks(&reading, recording)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImportOptions, Progress, unheard, unpack_starter};
    use chereme_sign::TierRole;

    #[test]
    fn a_recording_is_read_as_its_rows_are_and_every_change_is_noticed() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = folder.path().join("starter");
        let paths = unpack_starter(&files).expect("unpacked");
        let two = |path: &std::path::PathBuf| {
            path.file_stem()
                .is_some_and(|stem| stem == "bol" || stem == "lexicon")
        };
        let paths: Vec<_> = paths.into_iter().filter(two).collect();
        let path = folder.path().join("c.chereme");
        let mut corpus = Corpus::create(&path, "A").expect("made");
        let other = Corpus::open(&path, "B").expect("opened");
        assert_eq!(other.generation().expect("read"), 0);
        let mut hear = unheard;
        corpus
            .import(
                &paths,
                &ImportOptions::default(),
                &mut Progress::new(&mut hear),
            )
            .expect("imported");
        assert_eq!(other.generation().expect("read"), 1);
        let overview = other.overview(10).expect("read");
        assert_eq!(overview.recordings.len(), 1);
        assert!(overview.recordings[0].frames > 0 && overview.recordings[0].rate.is_some());
        assert!(overview.signs.len() > 1 && overview.signs.iter().all(|s| s.citation.is_some()));
        let recording = overview.recordings[0].row.id;
        let placed = overview
            .signs
            .iter()
            .filter_map(|s| Some((&*s.gloss, s.place?.0)));
        assert_eq!(placed.collect::<Vec<_>>(), [("BOL", recording)]);
        assert!(!overview.inventories.is_empty());
        assert_eq!(overview.operations.len(), 1);
        let contents = other.contents(overview.recordings[0].row.id).expect("read");
        let gloss = contents
            .tiers
            .iter()
            .find(|tier| tier.row.role == TierRole::Gloss)
            .expect("a gloss tier");
        assert_eq!(&*gloss.annotations.values[0], "BOL");
        assert_eq!(gloss.annotations.states[0], ValueState::Value);
        assert!(!gloss.annotations.span(0).is_empty());
        assert!(contents.tiers.iter().all(|tier| {
            let starts = &tier.annotations.starts;
            starts.is_sorted() && starts.len() == tier.annotations.len()
        }));
        assert!(other.contents(999).is_err());
        corpus.undo().expect("undone");
        assert_eq!(other.generation().expect("read"), 2);
    }
}
