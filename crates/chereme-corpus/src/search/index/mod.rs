//! The search index: one document for each token, derived from the rows and written in their transaction.
//!
//! | field | content | used for |
//! |---|---|---|
//! | `id` | the token | the rows of the hits |
//! | `sign`, `recording`, `signer` | row numbers | conditions; order and counts |
//! | `gloss` | the whole gloss, folded | `gloss=BOL-2H`, wildcards, slips |
//! | `words`, `translation`, `comment` | words of the gloss, of translations, of remarks | `"slow animal"` |
//! | `reading` | [terms](crate::db::search::terms) of values, and marks | `right.configuration=U`, `origin=made` |
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
mod read;

use std::cell::{Cell, RefCell, RefMut};

use rusqlite::Connection;
use tantivy::directory::OwnedBytes;
use tantivy::indexer::NoMergePolicy;
use tantivy::schema::{
    FAST, Field, INDEXED, IndexRecordOption, Schema, TextFieldIndexing, TextOptions,
};
use tantivy::tokenizer::{SimpleTokenizer, TextAnalyzer};
use tantivy::{Index, IndexReader, IndexWriter, ReloadPolicy, TantivyDocument, TantivyError, Term};

use super::known::Memory;
use crate::db::Derived;
use crate::db::search::{self as rows, State, TokenDocument};
use crate::error::{Error, Result};
use crate::foreign_code::catch_panic;
use crate::progress::{Progress, Step, Unit, unheard};

use directory::MemoryFolder;
use read::{KnownLabels, Reading};

/// The version of the documents' format, raised with every change of it: indexes of other versions are rebuilt.
const FORMAT: i64 = 3;
/// The name under which the index knows its analyser of words.
const WORDS: &str = "words";
/// The memory for writing changes to the index, in bytes; a new index takes four times as much.
const MEMORY: usize = 64 << 20;
/// Segments with fewer documents than this are merged if there are more than [`MOST_SMALL_SEGMENTS`] of them.
const SMALL_SEGMENT: u32 = 20_000;
/// The most small segments that are kept apart.
const MOST_SMALL_SEGMENTS: usize = 8;

/// The fields of a document.
#[derive(Clone, Copy)]
struct Fields {
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
    memory: RefCell<Memory>,
    labels: RefCell<KnownLabels>,
    rebuilt: Cell<bool>,
}

struct OpenIndex {
    folder: MemoryFolder,
    index: Index,
    reader: IndexReader,
    fields: Fields,
    indexed: i64,
}

fn follows(state: &State) -> bool {
    state.content == state.indexed && state.format == FORMAT
}

/// Returns the result of work with the search engine; if that panics, the index is damaged.
pub(crate) fn unbroken<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    catch_panic(work).unwrap_or_else(|| Err(Error::Index("it is damaged".into())))
}

impl SearchIndex {
    fn load(&self, connection: &Connection, indexed: i64) -> Result<OpenIndex> {
        unbroken(|| OpenIndex::load(connection, indexed, self.open.as_ref()))
    }

    fn is_open_at(&self, indexed: i64) -> bool {
        self.open
            .as_ref()
            .is_some_and(|open| open.indexed == indexed)
    }

    /// Rebuilds the index in a transaction of its own.
    fn mend(&mut self, connection: &Connection, noteworthy: bool) -> Result<()> {
        let transaction = rows::begin(connection)?;
        let mut hear = unheard;
        self.rebuild(&transaction, &mut Progress::new(&mut hear))?;
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
    /// Panics before the first [`refresh`](Derived::refresh).
    pub(crate) fn now(&self) -> Reading<'_> {
        let open = self
            .open
            .as_ref()
            .expect("refresh loads the index before it is searched");
        Reading {
            searcher: open.reader.searcher(),
            fields: open.fields,
            labels: &self.labels,
        }
    }

    /// Returns whether the index is up to date with the rows, as this connection reads them now.
    pub(crate) fn is_current(&self, connection: &Connection) -> Result<bool> {
        let state = State::read(connection)?;
        let open = self.open.as_ref();
        Ok(follows(&state) && open.is_some_and(|open| open.indexed == state.indexed))
    }

    /// Returns the cache that is shared by queries on the present state of the index.
    pub(crate) fn memory(&self) -> RefMut<'_, Memory> {
        let mut memory = self.memory.borrow_mut();
        memory.turn_to(self.open.as_ref().map_or(-1, |open| open.indexed));
        memory
    }

    /// Returns the number of documents in the index.
    pub(crate) fn documents(&self) -> u64 {
        self.now().searcher.num_docs()
    }
}

impl Derived for SearchIndex {
    /// Brings the index up to date: usually does nothing, loads it if another program has written since, and rebuilds
    /// it if it does not match the rows.
    fn refresh(&mut self, connection: &Connection) -> Result<()> {
        let state = State::read(connection)?;
        if !follows(&state) {
            return self.mend(connection, state.content != 0);
        }
        if !self.is_open_at(state.indexed) {
            match self.load(connection, state.indexed) {
                Ok(open) => self.open = Some(open),
                Err(Error::Index(_)) => return self.mend(connection, true),
                Err(other) => return Err(other),
            }
        }
        Ok(())
    }

    /// Indexes the tokens that the running operation touched, in its transaction.
    fn follow(&mut self, connection: &Connection, progress: &mut Progress<'_>) -> Result<()> {
        let touched = rows::touched(connection)?;
        let state = State::read(connection)?;
        let before: i64 = state.content - rows::touches(connection)?;
        if state.content == state.indexed {
            return Ok(());
        }
        if state.format != FORMAT || before != state.indexed {
            return self.rebuild(connection, progress);
        }
        if !self.is_open_at(state.indexed) {
            match self.load(connection, state.indexed) {
                Ok(open) => self.open = Some(open),
                Err(Error::Index(_)) => return self.rebuild(connection, progress),
                Err(other) => return Err(other),
            }
        }
        let open = self.open.as_mut().expect("just loaded");
        match unbroken(|| open.write(connection, &touched, state.content, progress)) {
            Err(Error::Index(_)) => self.rebuild(connection, progress),
            written => written.and_then(|()| open.save(connection, state.content)),
        }
    }

    /// Rebuilds the index from all rows, inside the caller's transaction.
    fn rebuild(&mut self, connection: &Connection, progress: &mut Progress<'_>) -> Result<()> {
        rows::delete_files(connection)?;
        let mut open = OpenIndex::empty()?;
        let state = State::read(connection)?;
        open.fill(connection, state.content, progress)?;
        open.save(connection, state.content)?;
        self.open = Some(open);
        Ok(())
    }
}

impl OpenIndex {
    /// Loads the index that includes the first `indexed` changes; reuses the files that it has in common with `before`,
    /// an index of another state.
    fn load(connection: &Connection, indexed: i64, before: Option<&Self>) -> Result<Self> {
        if !rows::has_stored_files(connection)? {
            return Err(Error::Index(
                "its files are not those that were stored".into(),
            ));
        }
        let mut folder = MemoryFolder::default();
        let mut missing = 0;
        for name in rows::file_names(connection)? {
            let known = before.and_then(|before| before.folder.unchanging(&name));
            match known {
                Some(data) => folder.add(name, data),
                None => {
                    missing += 1;
                    let data = rows::file(connection, &name)?;
                    folder.add(name, OwnedBytes::new(data));
                }
            }
        }
        if missing == 0 && indexed == 0 {
            return Self::empty();
        }
        let index = Index::open(folder.clone())?;
        if index.load_metas()?.payload != Some(payload(indexed)) {
            let message = "its files are of another state than the rows";
            return Err(TantivyError::SystemError(message.to_owned()).into());
        }
        Self::ready(folder, index, indexed)
    }

    fn empty() -> Result<Self> {
        let folder = MemoryFolder::default();
        let index = Index::create(
            folder.clone(),
            schema().0,
            tantivy::IndexSettings::default(),
        )?;
        Self::ready(folder, index, -1)
    }

    fn ready(folder: MemoryFolder, index: Index, indexed: i64) -> Result<Self> {
        index.tokenizers().register(WORDS, analyzer());
        let reader = index
            .reader_builder()
            .reload_policy(ReloadPolicy::Manual)
            .try_into()?;
        Ok(Self {
            folder,
            index,
            reader,
            fields: schema().1,
            indexed,
        })
    }

    fn writer(&self, memory: usize) -> Result<IndexWriter> {
        let writer = self.index.writer_with_num_threads(1, memory)?;
        writer.set_merge_policy(Box::new(NoMergePolicy));
        Ok(writer)
    }

    fn write(
        &mut self,
        connection: &Connection,
        touched: &[i64],
        content: i64,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        let mut writer = self.writer(MEMORY)?;
        for &token in touched {
            writer.delete_term(Term::from_field_u64(self.fields.id, token as u64));
        }
        let (mut done, total) = (0, Some(touched.len() as u64));
        rows::each(connection, Some(touched), |token| {
            step(progress, &mut done, total)?;
            writer.add_document(self.document(&token))?;
            Ok(())
        })?;
        commit(&mut writer, content)?;
        self.merge(&mut writer)?;
        writer.garbage_collect_files().wait()?;
        writer.wait_merging_threads()?;
        self.reader.reload()?;
        Ok(())
    }

    fn fill(
        &mut self,
        connection: &Connection,
        content: i64,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        let mut writer = self.writer(4 * MEMORY)?;
        let mut done = 0;
        rows::each(connection, None, |token| {
            step(progress, &mut done, None)?;
            writer.add_document(self.document(&token))?;
            Ok(())
        })?;
        commit(&mut writer, content)?;
        let all = self.index.searchable_segment_ids()?;
        if all.len() > 1 {
            writer.merge(&all).wait()?;
        }
        writer.garbage_collect_files().wait()?;
        writer.wait_merging_threads()?;
        self.reader.reload()?;
        Ok(())
    }

    fn merge(&self, writer: &mut IndexWriter) -> Result<()> {
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

    fn save(&mut self, connection: &Connection, content: i64) -> Result<()> {
        let changes = self.folder.take_changes();
        for path in changes.deleted {
            rows::delete_file(connection, &path)?;
        }
        for (path, data) in changes.written {
            rows::write_file(connection, &path, &data)?;
        }
        rows::seal_files(connection)?;
        State::seen(connection, content, FORMAT)?;
        self.indexed = content;
        Ok(())
    }

    fn document(&self, token: &TokenDocument) -> TantivyDocument {
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
            facets.extend(facet.filter(|facet| !facets.contains(facet)));
        }
        for facet in facets {
            document.add_text(fields.facet, facet);
        }
        if let Some(hand) = token.hand {
            document.add_text(fields.facet, format!("hand={hand}"));
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
fn step(progress: &mut Progress<'_>, done: &mut u64, total: Option<u64>) -> Result<()> {
    *done += 1;
    if !done.is_multiple_of(256) {
        return Ok(());
    }
    progress.report(Step {
        task: "search index",
        done: *done,
        total,
        unit: Unit::Items,
    })
}

/// Returns the record of the last count that the index includes, for its own files.
fn payload(content: i64) -> String {
    format!("{FORMAT}:{content}")
}

fn commit(writer: &mut IndexWriter, content: i64) -> Result<()> {
    let mut commit = writer.prepare_commit()?;
    commit.set_payload(&payload(content));
    commit.commit()?;
    Ok(())
}

fn schema() -> (Schema, Fields) {
    let mut builder = Schema::builder();
    let indexing = |option, tokenizer| {
        TextFieldIndexing::default()
            .set_tokenizer(tokenizer)
            .set_fieldnorms(false)
            .set_index_option(option)
    };
    let option = IndexRecordOption::WithFreqsAndPositions;
    let text = TextOptions::default().set_indexing_options(indexing(option, WORDS));
    let option = IndexRecordOption::Basic;
    let term = TextOptions::default().set_indexing_options(indexing(option, "raw"));
    let fields = Fields {
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

impl From<TantivyError> for Error {
    fn from(error: TantivyError) -> Self {
        Self::Index(Box::new(error))
    }
}
