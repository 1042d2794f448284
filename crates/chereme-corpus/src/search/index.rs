//! The search index: one document a token, derived from the rows and written in their transaction.
//!
//! | field | holds | asked |
//! |---|---|---|
//! | `id` | the token | which rows the hits are |
//! | `sign`, `recording`, `signer` | row numbers | whose, and where |
//! | `gloss` | the whole gloss, folded | `gloss=BOL-2H`, prefix, wildcard, fuzzy |
//! | `words`, `translation`, `comment` | words of the gloss, of what is said, of remarks | `"slow animal"` |
//! | `reading` | a [term](super::terms::reading_term) a value | `right.configuration=U` |
//! | `facet` | `right.configuration=U` as printed | counts |
//! | `origin`, `start`, `duration` | as in the rows | `origin=made`, `duration<0.8s` |
//!
//! Two counters in `search_state` tell whether the index follows the rows: triggers of the schema
//! count every change of the rows, whoever makes it, and the index writes down what it has seen.

use rusqlite::Connection;
use tantivy::indexer::NoMergePolicy;
use tantivy::schema::{
    FAST, Field, INDEXED, IndexRecordOption, STRING, Schema, TextFieldIndexing, TextOptions,
};
use tantivy::tokenizer::{AsciiFoldingFilter, LowerCaser, SimpleTokenizer, TextAnalyzer};
use tantivy::{Index, IndexReader, IndexWriter, ReloadPolicy, Searcher, TantivyDocument, Term};

use super::directory::MemoryFolder;
use crate::db::search::{self as rows, State, TokenDocument};
use crate::error::Result;

/// Raised whenever documents are made otherwise than before: indexes of other numbers are remade.
const FORMAT: i64 = 1;
const WORDS: &str = "words";
const MEMORY: usize = 64 << 20;
const SMALL_SEGMENT: u32 = 20_000;
const MOST_SMALL_SEGMENTS: usize = 8;

/// The fields of a document.
#[derive(Clone, Copy)]
pub(crate) struct Fields {
    pub(crate) id: Field,
    pub(crate) sign: Field,
    pub(crate) recording: Field,
    pub(crate) signer: Field,
    pub(crate) gloss: Field,
    pub(crate) words: Field,
    pub(crate) translation: Field,
    pub(crate) comment: Field,
    pub(crate) reading: Field,
    pub(crate) facet: Field,
    pub(crate) origin: Field,
    pub(crate) start: Field,
    pub(crate) duration: Field,
}

/// The search index of one open corpus; loaded when first needed.
#[derive(Default)]
pub(crate) struct SearchIndex {
    open: Option<OpenIndex>,
    rebuilt: bool,
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

impl SearchIndex {
    /// Brings the index to where the rows are: nothing to do as a rule, loaded where another
    /// program has written since, made anew where it does not follow the rows.
    pub(crate) fn refresh(&mut self, connection: &Connection) -> Result<()> {
        let state = State::read(connection)?;
        if !follows(&state) {
            let transaction = rows::begin(connection)?;
            self.rebuild(&transaction)?;
            transaction.commit()?;
            self.rebuilt = state.format != 0 || state.content != 0;
            return Ok(());
        }
        if self
            .open
            .as_ref()
            .is_none_or(|open| open.indexed != state.indexed)
        {
            self.open = Some(OpenIndex::load(connection, state.indexed)?);
        }
        Ok(())
    }

    /// Tells whether the index had to be made anew because it did not follow the rows.
    pub(crate) fn was_rebuilt(&self) -> bool {
        self.rebuilt
    }

    /// Returns the searcher and the fields.
    ///
    /// # Panics
    /// Before the first [`refresh`](Self::refresh).
    pub(crate) fn searcher(&self) -> (Searcher, Fields) {
        let open = self
            .open
            .as_ref()
            .expect("refresh loads the index before it is searched");
        (open.reader.searcher(), open.fields)
    }

    /// Returns the words of `text` as the fields of words hold them.
    pub(crate) fn words(&self, text: &str) -> Vec<String> {
        let mut analyzer = analyzer();
        let mut stream = analyzer.token_stream(text);
        let mut words = Vec::new();
        stream.process(&mut |token| words.push(token.text.clone()));
        words
    }

    /// Writes the tokens that the running operation touched into the index, in its transaction.
    pub(crate) fn follow(&mut self, connection: &Connection) -> Result<()> {
        let touched = rows::touched(connection)?;
        let state = State::read(connection)?;
        let before: i64 = state.content - rows::touches(connection)?;
        if state.content == state.indexed {
            return Ok(());
        }
        if state.format != FORMAT || before != state.indexed {
            return self.rebuild(connection);
        }
        if self
            .open
            .as_ref()
            .is_none_or(|open| open.indexed != state.indexed)
        {
            self.open = Some(OpenIndex::load(connection, state.indexed)?);
        }
        let open = self.open.as_mut().expect("just loaded");
        open.write(connection, &touched)?;
        open.save(connection, state.content)
    }

    /// Makes the index anew from all rows, inside the caller's transaction.
    pub(crate) fn rebuild(&mut self, connection: &Connection) -> Result<()> {
        rows::delete_files(connection)?;
        let mut open = OpenIndex::empty()?;
        open.fill(connection)?;
        let state = State::read(connection)?;
        open.save(connection, state.content)?;
        self.open = Some(open);
        Ok(())
    }

    /// Returns how many documents the index holds.
    pub(crate) fn documents(&self) -> u64 {
        self.searcher().0.num_docs()
    }
}

impl OpenIndex {
    fn load(connection: &Connection, indexed: i64) -> Result<Self> {
        let files = rows::files(connection)?;
        if files.is_empty() {
            return Self::empty();
        }
        let folder = MemoryFolder::new(files);
        let index = Index::open(folder.clone())?;
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

    fn write(&mut self, connection: &Connection, touched: &[i64]) -> Result<()> {
        let mut writer = self.writer(MEMORY)?;
        for &token in touched {
            writer.delete_term(Term::from_field_u64(self.fields.id, token as u64));
        }
        rows::each(connection, Some(touched), |token| {
            writer.add_document(self.document(&token))?;
            Ok(())
        })?;
        writer.commit()?;
        self.merge(&mut writer)?;
        writer.garbage_collect_files().wait()?;
        writer.wait_merging_threads()?;
        self.reader.reload()?;
        Ok(())
    }

    fn fill(&mut self, connection: &Connection) -> Result<()> {
        let mut writer = self.writer(4 * MEMORY)?;
        rows::each(connection, None, |token| {
            writer.add_document(self.document(&token))?;
            Ok(())
        })?;
        writer.commit()?;
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
        document.add_text(fields.words, &token.words);
        for text in &token.translations {
            document.add_text(fields.translation, text);
        }
        for text in &token.comments {
            document.add_text(fields.comment, text);
        }
        for term in &token.readings {
            document.add_text(fields.reading, term);
        }
        for facet in &token.facets {
            document.add_text(fields.facet, facet);
        }
        document.add_text(fields.origin, &token.origin);
        if let Some((start, duration)) = token.time {
            document.add_i64(fields.start, start);
            document.add_i64(fields.duration, duration);
        }
        document
    }
}

fn schema() -> (Schema, Fields) {
    let mut builder = Schema::builder();
    let words = TextFieldIndexing::default()
        .set_tokenizer(WORDS)
        .set_index_option(IndexRecordOption::WithFreqsAndPositions);
    let text = TextOptions::default().set_indexing_options(words);
    let term = TextOptions::default().set_indexing_options(
        TextFieldIndexing::default()
            .set_tokenizer("raw")
            .set_fieldnorms(false)
            .set_index_option(IndexRecordOption::Basic),
    );
    let fields = Fields {
        id: builder.add_u64_field("id", INDEXED | FAST),
        sign: builder.add_u64_field("sign", INDEXED),
        recording: builder.add_u64_field("recording", INDEXED),
        signer: builder.add_u64_field("signer", INDEXED),
        gloss: builder.add_text_field("gloss", STRING),
        words: builder.add_text_field("words", text.clone()),
        translation: builder.add_text_field("translation", text.clone()),
        comment: builder.add_text_field("comment", text),
        reading: builder.add_text_field("reading", term.clone()),
        facet: builder.add_text_field("facet", TextOptions::default().set_fast("raw")),
        origin: builder.add_text_field("origin", term),
        start: builder.add_i64_field("start", INDEXED | FAST),
        duration: builder.add_i64_field("duration", INDEXED | FAST),
    };
    (builder.build(), fields)
}

fn analyzer() -> TextAnalyzer {
    TextAnalyzer::builder(SimpleTokenizer::default())
        .filter(LowerCaser)
        .filter(AsciiFoldingFilter)
        .build()
}
