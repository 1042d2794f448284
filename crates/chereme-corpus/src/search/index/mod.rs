//! The search index: one document for each token, derived from the rows and written in their transaction.
//!
//! | field | content | used for |
//! |---|---|---|
//! | `id` | the token | the rows of the hits |
//! | `sign`, `recording`, `signer` | row numbers | conditions; order and counts |
//! | `gloss` | the whole gloss, folded | `gloss=BOL-2H`, wildcards, slips |
//! | `words`, `translation`, `comment` | words of the gloss, of translations, of remarks | `"slow animal"` |
//! | `reading` | [terms](crate::db::search::terms) of values and of opinions, and marks | `right.configuration=U`, `origin=made` |
//! | `facet` | `right.configuration=U` as printed | counts |
//! | `start`, `end`, `duration` | microseconds | `duration<0.8s`; relations of time |
//!
//! Texts are [folded](chereme_sign::text::fold) before they are indexed; words are sequences of letters and digits.
//! There is no scoring: the order of results depends on the place of a match, not on its frequency.
//!
//! Two counters in `search_state` show whether the index is up to date: triggers of the schema count every change of
//! the rows by any program, and the index records the count that it includes, in the rows and in its own files.

mod any_term;
mod directory;
mod index_read;

use std::cell::{Cell, RefCell, RefMut};

use rusqlite::Connection;
use tantivy::directory::OwnedBytes;
use tantivy::indexer::NoMergePolicy;
use tantivy::schema::{FAST, Field, INDEXED, IndexRecordOption, Schema, TextFieldIndexing, TextOptions};
use tantivy::tokenizer::{SimpleTokenizer, TextAnalyzer};
use tantivy::{Index, IndexReader, IndexWriter, ReloadPolicy, TantivyDocument, TantivyError, Term};

use super::search_known::QueryMemory;
use crate::db::DerivedData;
use crate::db::stored_search::{self as rows, SearchIndexState, TokenDocument};
use crate::error::{CorpusError, CorpusResult};
use crate::foreign_code::catch_panic;
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};

use directory::MemoryFolder;
use index_read::{IndexReading, KnownLabels};

/// The version of the documents' format, raised with every change of it: indexes of other versions are rebuilt.
const INDEX_FORMAT_VERSION: i64 = 5;
/// The name under which the index knows its analyser of words.
const WORD_ANALYZER_NAME: &str = "words";
/// The memory for writing changes to the index, in bytes; a new index takes four times as much.
const INDEX_WRITER_MEMORY_BYTES: usize = 64 << 20;
/// Segments with fewer documents than this are merged if there are more than [`MOST_SMALL_SEGMENTS`] of them.
const SMALL_SEGMENT: u32 = 20_000;
/// The most small segments that are kept apart.
const MOST_SMALL_SEGMENTS: usize = 8;

/// The fields of a document.
#[derive(Clone, Copy)]
struct IndexFields {
    id: Field,
    sign: Field,
    recording: Field,
    signer: Field,
    gloss: Field,
    words: Field,
    translation: Field,
    comment: Field,
    reading: Field,
    facet: Field,
    start: Field,
    end: Field,
    duration: Field,
}

/// The search index of one open corpus; loaded when first needed.
#[derive(Default)]
pub(crate) struct SearchIndex {
    open: Option<OpenIndex>,
    memory: RefCell<QueryMemory>,
    labels: RefCell<KnownLabels>,
    rebuilt: Cell<bool>,
}

struct OpenIndex {
    folder: MemoryFolder,
    index: Index,
    reader: IndexReader,
    fields: IndexFields,
    indexed: i64,
}

fn is_index_state_current(state: &SearchIndexState) -> bool {
    state.content == state.indexed && state.format == INDEX_FORMAT_VERSION
}

/// Returns the result of work with the search engine; if that panics, the index is damaged.
pub(crate) fn catch_index_panic<T>(work: impl FnOnce() -> CorpusResult<T>) -> CorpusResult<T> {
    catch_panic(work).unwrap_or_else(|| Err(CorpusError::Index("it is damaged".into())))
}

impl SearchIndex {
    fn load_open_index(&self, connection: &Connection, indexed: i64) -> CorpusResult<OpenIndex> {
        catch_index_panic(|| OpenIndex::load_index_state(connection, indexed, self.open.as_ref()))
    }

    fn is_open_at(&self, indexed: i64) -> bool {
        self.open.as_ref().is_some_and(|open| open.indexed == indexed)
    }

    /// Rebuilds the index in a transaction of its own.
    fn mend_search_index(&mut self, connection: &Connection, noteworthy: bool) -> CorpusResult<()> {
        let transaction = rows::begin_write_transaction(connection)?;
        self.rebuild_derived_data(&transaction, &mut ProgressReceiver::silent_progress())?;
        transaction.commit()?;
        self.rebuilt.set(self.rebuilt.get() || noteworthy);
        Ok(())
    }

    /// Returns whether the index had to be rebuilt because it was not up to date with the rows.
    #[cfg(test)]
    pub(crate) fn was_rebuilt(&self) -> bool {
        self.rebuilt.get()
    }

    /// Records that the index was rebuilt because it was damaged.
    pub(crate) fn note_rebuilt(&self) {
        self.rebuilt.set(true);
    }

    /// Returns whether the index had to be rebuilt since the last call.
    pub(crate) fn take_rebuilt(&self) -> bool {
        self.rebuilt.take()
    }

    /// Returns the index in its present state, for queries.
    ///
    /// # Panics
    /// Panics before the first [`refresh_derived_data`](Derived::refresh_derived_data).
    pub(crate) fn current_index_reading(&self) -> IndexReading<'_> {
        let open = self
            .open
            .as_ref()
            .expect("refresh loads the index before it is searched");
        IndexReading {
            searcher: open.reader.searcher(),
            fields: open.fields,
            labels: &self.labels,
        }
    }

    /// Returns whether the index is up to date with the rows, as this connection reads them now.
    pub(crate) fn is_current(&self, connection: &Connection) -> CorpusResult<bool> {
        let state = SearchIndexState::read_index_state(connection)?;
        let open = self.open.as_ref();
        Ok(is_index_state_current(&state) && open.is_some_and(|open| open.indexed == state.indexed))
    }

    /// Returns the cache that is shared by queries on the present state of the index.
    pub(crate) fn query_memory(&self) -> RefMut<'_, QueryMemory> {
        let mut memory = self.memory.borrow_mut();
        memory.turn_to_state(self.open.as_ref().map_or(-1, |open| open.indexed));
        memory
    }

    /// Returns the number of documents in the index.
    pub(crate) fn indexed_document_count(&self) -> u64 {
        self.current_index_reading().searcher.num_docs()
    }
}

impl DerivedData for SearchIndex {
    /// Brings the index up to date: usually does nothing, loads it if another program has written since, and rebuilds
    /// it if it does not match the rows.
    fn refresh_derived_data(&mut self, connection: &Connection) -> CorpusResult<()> {
        let state = SearchIndexState::read_index_state(connection)?;
        if !is_index_state_current(&state) {
            // A corpus without changes has no index yet, which is no fault that anybody should hear of.
            return self.mend_search_index(connection, state.content != 0);
        }
        if !self.is_open_at(state.indexed) {
            match self.load_open_index(connection, state.indexed) {
                Ok(open) => self.open = Some(open),
                Err(CorpusError::Index(_)) => return self.mend_search_index(connection, true),
                Err(other) => return Err(other),
            }
        }
        Ok(())
    }

    /// Indexes the tokens that the running operation touched, in its transaction.
    fn follow_operation(&mut self, connection: &Connection, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()> {
        let touched = rows::list_touched_tokens(connection)?;
        let state = SearchIndexState::read_index_state(connection)?;
        // The changes of this operation are counted already, and the index may lack no others.
        let before: i64 = state.content - rows::count_token_touches(connection)?;
        if state.content == state.indexed {
            return Ok(());
        }
        if state.format != INDEX_FORMAT_VERSION || before != state.indexed {
            return self.rebuild_derived_data(connection, progress);
        }
        if !self.is_open_at(state.indexed) {
            match self.load_open_index(connection, state.indexed) {
                Ok(open) => self.open = Some(open),
                Err(CorpusError::Index(_)) => {
                    return self.rebuild_derived_data(connection, progress);
                }
                Err(other) => return Err(other),
            }
        }
        let open = self.open.as_mut().expect("just loaded");
        match catch_index_panic(|| open.write_touched_tokens(connection, &touched, state.content, progress)) {
            Err(CorpusError::Index(_)) => self.rebuild_derived_data(connection, progress),
            written => written.and_then(|()| open.save_index_files(connection, state.content)),
        }
    }

    /// Rebuilds the index from all rows, inside the caller's transaction.
    fn rebuild_derived_data(
        &mut self,
        connection: &Connection,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        rows::delete_files(connection)?;
        let mut open = OpenIndex::create_empty_index()?;
        let state = SearchIndexState::read_index_state(connection)?;
        open.fill_whole_index(connection, state.content, progress)?;
        open.save_index_files(connection, state.content)?;
        self.open = Some(open);
        Ok(())
    }
}

impl OpenIndex {
    /// Loads the index that includes the first `indexed` changes; reuses the files that it has in common with `before`,
    /// an index of another state.
    fn load_index_state(connection: &Connection, indexed: i64, before: Option<&Self>) -> CorpusResult<Self> {
        if !rows::has_stored_files(connection)? {
            return Err(CorpusError::Index("its files are not those that were stored".into()));
        }
        let mut folder = MemoryFolder::default();
        let mut missing = 0;
        for name in rows::file_names(connection)? {
            let known_data = before.and_then(|before| before.folder.unchanging_file(&name));
            match known_data {
                Some(data) => folder.add_saved_file(name, data),
                None => {
                    missing += 1;
                    let data = rows::read_index_file(connection, &name)?;
                    folder.add_saved_file(name, OwnedBytes::new(data));
                }
            }
        }
        if missing == 0 && indexed == 0 {
            return Self::create_empty_index();
        }
        let index = Index::open(folder.clone())?;
        // Files and rows are written together; a difference shows that something else wrote one of them.
        if index.load_metas()?.payload != Some(payload(indexed)) {
            let message = "its files are of another state than the rows";
            return Err(TantivyError::SystemError(message.to_owned()).into());
        }
        Self::from_memory_folder(folder, index, indexed)
    }

    fn create_empty_index() -> CorpusResult<Self> {
        let folder = MemoryFolder::default();
        let index = Index::create(folder.clone(), index_schema().0, tantivy::IndexSettings::default())?;
        Self::from_memory_folder(folder, index, -1)
    }

    fn from_memory_folder(folder: MemoryFolder, index: Index, indexed: i64) -> CorpusResult<Self> {
        index.tokenizers().register(WORD_ANALYZER_NAME, analyzer());
        let reader = index.reader_builder().reload_policy(ReloadPolicy::Manual).try_into()?;
        Ok(Self {
            folder,
            index,
            reader,
            fields: index_schema().1,
            indexed,
        })
    }

    fn writer(&self, memory: usize) -> CorpusResult<IndexWriter> {
        // One thread gives segments in the order of tokens, and equal files for equal rows.
        let writer = self.index.writer_with_num_threads(1, memory)?;
        // Merges in the background would outlive the transaction that must hold their files.
        writer.set_merge_policy(Box::new(NoMergePolicy));
        Ok(writer)
    }

    fn write_touched_tokens(
        &mut self,
        connection: &Connection,
        touched: &[i64],
        content: i64,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let mut writer = self.writer(INDEX_WRITER_MEMORY_BYTES)?;
        // A document cannot be changed: it is deleted, and added again unless its token is gone.
        for &token in touched {
            writer.delete_term(Term::from_field_u64(self.fields.id, token as u64));
        }
        let (mut done, total) = (0, Some(touched.len() as u64));
        rows::visit_token_documents(connection, Some(touched), |token| {
            report_index_step(progress, &mut done, total)?;
            writer.add_document(self.token_index_document(&token))?;
            Ok(())
        })?;
        commit(&mut writer, content)?;
        self.merge_small_segments(&mut writer)?;
        // Files of merged segments would otherwise be saved into the corpus.
        writer.garbage_collect_files().wait()?;
        writer.wait_merging_threads()?;
        self.reader.reload()?;
        Ok(())
    }

    fn fill_whole_index(
        &mut self,
        connection: &Connection,
        content: i64,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        let mut writer = self.writer(4 * INDEX_WRITER_MEMORY_BYTES)?;
        let mut done = 0;
        rows::visit_token_documents(connection, None, |token| {
            report_index_step(progress, &mut done, None)?;
            writer.add_document(self.token_index_document(&token))?;
            Ok(())
        })?;
        commit(&mut writer, content)?;
        // One segment is read fastest, and a whole index is written rarely.
        let all = self.index.searchable_segment_ids()?;
        if all.len() > 1 {
            writer.merge(&all).wait()?;
        }
        writer.garbage_collect_files().wait()?;
        writer.wait_merging_threads()?;
        self.reader.reload()?;
        Ok(())
    }

    fn merge_small_segments(&self, writer: &mut IndexWriter) -> CorpusResult<()> {
        let small: Vec<_> = self
            .index
            .searchable_segment_metas()?
            .iter()
            .filter(|segment| segment.num_docs() < SMALL_SEGMENT)
            .map(tantivy::SegmentMeta::id)
            .collect();
        if small.len() > MOST_SMALL_SEGMENTS {
            writer.merge(&small).wait()?;
        }
        Ok(())
    }

    fn save_index_files(&mut self, connection: &Connection, content: i64) -> CorpusResult<()> {
        let changes = self.folder.take_changes();
        for path in changes.deleted {
            rows::delete_file(connection, &path)?;
        }
        for (path, data) in changes.written {
            rows::write_file(connection, &path, &data)?;
        }
        rows::seal_files(connection)?;
        SearchIndexState::record_indexed_changes(connection, content, INDEX_FORMAT_VERSION)?;
        self.indexed = content;
        Ok(())
    }

    fn token_index_document(&self, token: &TokenDocument) -> TantivyDocument {
        let fields = self.fields;
        let mut document = TantivyDocument::new();
        document.add_u64(fields.id, token.id as u64);
        document.add_u64(fields.sign, token.sign as u64);
        if let Some(recording) = token.recording {
            document.add_u64(fields.recording, recording as u64);
        }
        if let Some(signer) = token.signer {
            document.add_u64(fields.signer, signer as u64);
        }
        document.add_text(fields.gloss, &token.gloss);
        document.add_text(fields.words, &token.gloss);
        for text in &token.translations {
            document.add_text(fields.translation, text);
        }
        for text in &token.comments {
            document.add_text(fields.comment, text);
        }
        for mark in &token.marks {
            document.add_text(fields.reading, mark);
        }
        let mut facets: Vec<&str> = Vec::new();
        for reading in &token.readings {
            for term in &reading.terms {
                document.add_text(fields.reading, term);
            }
            let facet = reading.facet.as_deref();
            // Several readings may be printed alike, and a token counts once for each value.
            facets.extend(facet.filter(|facet| !facets.contains(facet)));
        }
        for facet in facets {
            document.add_text(fields.facet, facet);
        }
        if let Some(hand) = token.hand {
            document.add_text(fields.facet, format!("hand={hand}"));
        }
        for standing in &token.opinions {
            document.add_text(fields.facet, format!("{}=yes", standing.standing_name()));
        }
        if let Some((start, end)) = token.time {
            document.add_i64(fields.start, start);
            document.add_i64(fields.end, end);
            document.add_i64(fields.duration, end - start);
        }
        document
    }
}

/// Reports progress at every 256th token.
fn report_index_step(progress: &mut ProgressReceiver<'_>, done: &mut u64, total: Option<u64>) -> CorpusResult<()> {
    *done += 1;
    if !done.is_multiple_of(256) {
        return Ok(());
    }
    progress.report_step(ProgressStep {
        task: "search index",
        done: *done,
        total,
        unit: ProgressUnit::Items,
    })
}

/// Returns the record of the last count that the index includes, for its own files.
fn payload(content: i64) -> String {
    format!("{INDEX_FORMAT_VERSION}:{content}")
}

fn commit(writer: &mut IndexWriter, content: i64) -> CorpusResult<()> {
    let mut commit = writer.prepare_commit()?;
    commit.set_payload(&payload(content));
    commit.commit()?;
    Ok(())
}

fn index_schema() -> (Schema, IndexFields) {
    let mut builder = Schema::builder();
    let indexing = |option, tokenizer| {
        TextFieldIndexing::default()
            .set_tokenizer(tokenizer)
            .set_fieldnorms(false)
            .set_index_option(option)
    };
    let option = IndexRecordOption::WithFreqsAndPositions;
    let text = TextOptions::default().set_indexing_options(indexing(option, WORD_ANALYZER_NAME));
    let option = IndexRecordOption::Basic;
    let term = TextOptions::default().set_indexing_options(indexing(option, "raw"));
    let fields = IndexFields {
        id: builder.add_u64_field("id", INDEXED | FAST),
        sign: builder.add_u64_field("sign", INDEXED | FAST),
        recording: builder.add_u64_field("recording", INDEXED | FAST),
        signer: builder.add_u64_field("signer", INDEXED | FAST),
        gloss: builder.add_text_field("gloss", term.clone()),
        words: builder.add_text_field("words", text.clone()),
        translation: builder.add_text_field("translation", text.clone()),
        comment: builder.add_text_field("comment", text),
        reading: builder.add_text_field("reading", term),
        facet: builder.add_text_field("facet", TextOptions::default().set_fast("raw")),
        start: builder.add_i64_field("start", FAST),
        end: builder.add_i64_field("end", FAST),
        duration: builder.add_i64_field("duration", FAST),
    };
    (builder.build(), fields)
}

fn analyzer() -> TextAnalyzer {
    TextAnalyzer::from(SimpleTokenizer::default())
}

impl From<TantivyError> for CorpusError {
    fn from(error: TantivyError) -> Self {
        Self::Index(Box::new(error))
    }
}
