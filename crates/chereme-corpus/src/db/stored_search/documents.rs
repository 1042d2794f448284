//! Tokens in the form in which the search index stores them; if all are wanted they are read in one pass.

use std::collections::HashMap;
use std::rc::Rc;

use chereme_sign::text::fold_text;
use chereme_sign::tier as sign_tier;
use rusqlite::fallible_streaming_iterator::FallibleStreamingIterator;
use rusqlite::{Connection, OptionalExtension, Row, Rows};

use super::search_answers::{AnnotationOpinion, opinion_of_annotation};
use super::search_terms::{TokenProperty, hand_codes, opinion_component, phase_code, reading_term, reading_text};
use crate::db::cached_sql::CachedSql;
use crate::db::stored_columns::{self, OpinionStanding, read_word_column, word_or_null};
use crate::error::CorpusResult;

/// A token in the form in which the index stores it; texts are folded.
#[derive(Default)]
pub(crate) struct TokenDocument {
    pub(crate) id: i64,
    pub(crate) sign: i64,
    pub(crate) recording: Option<i64>,
    pub(crate) signer: Option<i64>,
    pub(crate) gloss: Rc<str>,
    pub(crate) translations: Vec<Rc<str>>,
    pub(crate) comments: Vec<Rc<str>>,
    pub(crate) readings: Vec<Rc<ReadingTerms>>,
    pub(crate) marks: Vec<Rc<str>>,
    /// The hands by their part in signing: `dominant`, `weak` or `both`.
    pub(crate) hand: Option<&'static str>,
    /// Start and end.
    pub(crate) time: Option<(i64, i64)>,
    /// The kinds of opinions about it that do not count.
    pub(crate) opinions: Vec<OpinionStanding>,
}

/// The terms of a row of values in the index.
pub(crate) struct ReadingTerms {
    pub(crate) terms: Vec<String>,
    /// `right.configuration=U`, if the row has a value.
    pub(crate) facet: Option<String>,
}

/// Calls `take` with each of the tokens in `only`, or with all of them.
pub(crate) fn visit_token_documents(
    connection: &Connection,
    only: Option<&[i64]>,
    mut take: impl FnMut(TokenDocument) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let mut reader = TokenDocumentReader::new(connection);
    match only {
        Some(tokens) => {
            let mut statement = connection.prepare_cached(&format!("{SELECT_DOCUMENT_TOKENS_SQL} WHERE t.id = ?1"))?;
            let mut values =
                connection.prepare_cached(&format!("{SELECT_DOCUMENT_VALUES_SQL} WHERE token_id = ?1 ORDER BY id"))?;
            for &token in tokens {
                let fields = statement
                    .query_row([token], TokenFields::read_token_fields)
                    .optional()?;
                if let Some(found) = fields {
                    let mut values = TokenValueCursor::new(values.query([token])?);
                    take(reader.read_token_document(&found, &mut values)?)?;
                }
            }
        }
        None => {
            // Tokens and values come in the same order from two statements, and are read side by side.
            let mut statement = connection.prepare(&format!("{SELECT_DOCUMENT_TOKENS_SQL} ORDER BY t.id"))?;
            let mut value_statement =
                connection.prepare(&format!("{SELECT_DOCUMENT_VALUES_SQL} ORDER BY token_id, id"))?;
            let mut values = TokenValueCursor::new(value_statement.query([])?);
            let mut rows = statement.query([])?;
            while let Some(row) = rows.next()? {
                let fields = TokenFields::read_token_fields(row)?;
                take(reader.read_token_document(&fields, &mut values)?)?;
            }
        }
    }
    Ok(())
}

const SELECT_DOCUMENT_TOKENS_SQL: &str = "
    SELECT t.id, t.sign_id, t.recording_id, t.start_us, t.end_us, t.origin, t.hand, a.tier_id,
        p.id, p.handedness, t.source ->> '$.file'
    FROM token t LEFT JOIN annotation a ON a.id = t.annotation_id
    LEFT JOIN tier i ON i.id = a.tier_id LEFT JOIN signer p ON p.name = i.participant";

const SELECT_DOCUMENT_VALUES_SQL: &str = "
    SELECT token_id, hand, component, feature, phase, position, state, value, inventory_id, annotation_id, standing
    FROM token_value";

struct TokenFields {
    id: i64,
    sign: i64,
    recording: Option<i64>,
    time: Option<(i64, i64)>,
    origin: String,
    hand: Option<sign_tier::AnnotatedHands>,
    tier: Option<i64>,
    /// The participant of its tier, if that is a signer, and whether that signer is left-handed.
    participant: Option<(i64, bool)>,
    /// The table or file of notation that it came from.
    file: Option<String>,
}

impl TokenFields {
    fn read_token_fields(row: &Row<'_>) -> rusqlite::Result<Self> {
        let start: Option<i64> = row.get(3)?;
        Ok(Self {
            id: row.get(0)?,
            sign: row.get(1)?,
            recording: row.get(2)?,
            time: start.zip(row.get(4)?),
            origin: row.get(5)?,
            hand: word_or_null(row, 6)?,
            tier: row.get(7)?,
            participant: row
                .get::<_, Option<i64>>(8)?
                .zip(Some(row.get_ref(9)?.as_str() == Ok("left"))),
            file: row.get(10)?,
        })
    }
}

/// Rows of values ordered by token; returns those of one token at a time.
struct TokenValueCursor<'s> {
    rows: Rows<'s>,
    /// The token of the row at the cursor.
    token: Option<i64>,
    started: bool,
}

impl<'s> TokenValueCursor<'s> {
    fn new(rows: Rows<'s>) -> Self {
        Self {
            rows,
            token: None,
            started: false,
        }
    }

    fn advance_cursor(&mut self) -> rusqlite::Result<()> {
        self.started = true;
        FallibleStreamingIterator::advance(&mut self.rows)?;
        self.token = FallibleStreamingIterator::get(&self.rows)
            .map(|row| row.get(0))
            .transpose()?;
        Ok(())
    }

    /// Calls `take` with each row of `token`; skips rows of lesser tokens.
    fn visit_values_of_token(
        &mut self,
        token: i64,
        mut take: impl FnMut(&Row<'_>) -> rusqlite::Result<()>,
    ) -> rusqlite::Result<()> {
        if !self.started {
            self.advance_cursor()?;
        }
        while let Some(next) = self.token.filter(|next| *next <= token) {
            if next == token
                && let Some(row) = FallibleStreamingIterator::get(&self.rows)
            {
                take(row)?;
            }
            self.advance_cursor()?;
        }
        Ok(())
    }
}

/// Cache of data that many tokens share; each part is emptied when it has grown too large.
struct TokenDocumentReader<'c> {
    connection: &'c Connection,
    signs: HashMap<i64, Rc<SignTexts>>,
    recordings: HashMap<i64, Rc<RecordingContext>>,
    tiers: HashMap<i64, Rc<str>>,
    inventories: HashMap<i64, Rc<str>>,
    marks: HashMap<(TokenProperty, String), Rc<str>>,
    terms: HashMap<String, Rc<ReadingTerms>>,
    key: String,
}

const MOST_SIGNS: usize = 100_000;
const MOST_RECORDINGS: usize = 64;
const MOST_TERMS: usize = 100_000;

struct SignTexts {
    gloss: Rc<str>,
    notes: Option<Rc<str>>,
    translations: Vec<Rc<str>>,
    /// The terms for its lexicon and the language of that.
    lexicon_terms: Vec<Rc<str>>,
}

/// The hands of a token: the hand for which it is annotated, otherwise those that have coded values.
#[derive(Default)]
struct TokenHandRoles {
    dominant: bool,
    weak: bool,
}

impl TokenHandRoles {
    fn add_tier_hands(&mut self, hand: Option<sign_tier::AnnotatedHands>, left_handed: bool) {
        let codes = hand_codes(hand, left_handed);
        self.dominant |= codes.contains(&'d');
        self.weak |= codes.contains(&'w');
    }

    fn hand_role_names(&self, left_handed: bool) -> &'static [&'static str] {
        match (self.dominant, self.weak, left_handed) {
            (true, true, _) => &["both"],
            (true, false, false) => &["right", "dominant"],
            (true, false, true) => &["left", "dominant"],
            (false, true, false) => &["left", "weak"],
            (false, true, true) => &["right", "weak"],
            (false, false, _) => &[],
        }
    }
}

/// The context of a recording: its signer, its translations and its remarks, by time.
struct RecordingContext {
    signer: Option<i64>,
    left_handed: bool,
    translations: Vec<TimedText>,
    comments: Vec<TimedText>,
    /// The names of the files that it was imported from.
    files: Vec<String>,
}

struct TimedText {
    start: i64,
    end: i64,
    text: Rc<str>,
}

impl<'c> TokenDocumentReader<'c> {
    fn new(connection: &'c Connection) -> Self {
        Self {
            connection,
            signs: HashMap::new(),
            recordings: HashMap::new(),
            tiers: HashMap::new(),
            inventories: HashMap::new(),
            marks: HashMap::new(),
            terms: HashMap::new(),
            key: String::new(),
        }
    }

    fn read_token_document(
        &mut self,
        token: &TokenFields,
        values: &mut TokenValueCursor<'_>,
    ) -> CorpusResult<TokenDocument> {
        let sign = self.shared_sign_texts(token.sign)?;
        let around = token
            .recording
            .map(|id| self.shared_recording_context(id))
            .transpose()?;
        let surroundings = around.as_ref();
        // In a recording of several people, the tier's participant signs, and not the recording's signer.
        let left_handed = match token.participant {
            Some((_, left_handed)) => left_handed,
            None => surroundings.is_some_and(|around| around.left_handed),
        };
        let signer = token.participant.map(|(signer, _)| signer);
        let mut document = TokenDocument {
            id: token.id,
            sign: token.sign,
            recording: token.recording,
            signer: signer.or(surroundings.and_then(|around| around.signer)),
            gloss: sign.gloss.clone(),
            translations: sign.translations.clone(),
            comments: sign.notes.iter().cloned().collect(),
            time: token.time,
            ..TokenDocument::default()
        };
        if let (Some(around), Some((start, end))) = (&around, token.time) {
            add_overlapping(&around.translations, start, end, &mut document.translations);
            add_overlapping(&around.comments, start, end, &mut document.comments);
        }
        self.add_marks(token, &mut document)?;
        document.marks.extend(sign.lexicon_terms.iter().cloned());
        let files = surroundings.iter().flat_map(|around| &around.files);
        for file in files.chain(&token.file) {
            let term = self.shared_mark_term(TokenProperty::File, file);
            document.marks.push(term);
        }
        let (mut inventories, mut coded) = (Vec::new(), TokenHandRoles::default());
        let mut opinions = Vec::new();
        values.visit_values_of_token(token.id, |row| {
            if let Some(opinion) = self.opinion_of_row(row)? {
                document
                    .readings
                    .push(Rc::new(opinion_terms(row, left_handed, &opinion)?));
                opinions.push(word_or_null(row, 10)?.unwrap_or(opinion.usual_standing));
                return Ok(());
            }
            document.readings.push(self.terms_of(row, left_handed)?);
            if row.get_ref(6)?.as_str() == Ok("value") {
                coded.add_tier_hands(word_or_null(row, 1)?, left_handed);
            }
            let inventory: Option<i64> = row.get(8)?;
            inventories.extend(inventory.filter(|id| !inventories.contains(id)));
            Ok(())
        })?;
        for (standing, mark) in [
            (OpinionStanding::Proposed, TokenProperty::Proposed),
            (OpinionStanding::Disputed, TokenProperty::Disputed),
        ] {
            if opinions.contains(&standing) {
                document.marks.push(self.shared_mark_term(mark, "yes"));
                document.opinions.push(standing);
            }
        }
        for id in inventories {
            let name = self.shared_inventory_key(id)?;
            document
                .marks
                .push(self.shared_mark_term(TokenProperty::Inventory, &name));
        }
        // An annotation of the token as a whole outweighs the hands of its coded values.
        if let Some(hand) = token.hand {
            coded = TokenHandRoles::default();
            coded.add_tier_hands(Some(hand), left_handed);
        }
        let names = coded.hand_role_names(left_handed);
        // The last name is the one by part in signing.
        document.hand = names.last().copied();
        for name in names {
            document.marks.push(self.shared_mark_term(TokenProperty::Hand, name));
        }
        Ok(document)
    }

    fn add_marks(&mut self, token: &TokenFields, document: &mut TokenDocument) -> CorpusResult<()> {
        let mut marks = vec![self.shared_mark_term(TokenProperty::Origin, &token.origin)];
        if let Some(tier) = token.tier {
            let name = self.shared_tier_name(tier)?;
            marks.push(self.shared_mark_term(TokenProperty::Tier, &name));
        }
        if !document.translations.is_empty() {
            marks.push(self.shared_mark_term(TokenProperty::Has, "translation"));
        }
        if !document.comments.is_empty() {
            marks.push(self.shared_mark_term(TokenProperty::Has, "comment"));
        }
        document.marks = marks;
        Ok(())
    }

    fn shared_mark_term(&mut self, mark: TokenProperty, value: &str) -> Rc<str> {
        if self.marks.len() > MOST_TERMS {
            self.marks.clear();
        }
        let made = self.marks.entry((mark, value.to_owned()));
        made.or_insert_with(|| mark.property_value_term(value).into()).clone()
    }

    fn shared_sign_texts(&mut self, id: i64) -> CorpusResult<Rc<SignTexts>> {
        if let Some(known) = self.signs.get(&id) {
            return Ok(known.clone());
        }
        let [gloss, notes, lexicon, language] = self.connection.read_row(
            "SELECT s.gloss, s.notes, l.name, l.language FROM sign s
                 LEFT JOIN lexicon l ON l.id = s.lexicon_id WHERE s.id = ?1",
            [id],
            |row| {
                let column = |at| row.get::<_, Option<String>>(at);
                Ok([column(0)?, column(1)?, column(2)?, column(3)?])
            },
        )?;
        let lexicon = lexicon.map(|name| self.shared_mark_term(TokenProperty::Lexicon, &name));
        let language = language.map(|code| self.shared_mark_term(TokenProperty::Language, &code));
        let mut statement = self
            .connection
            .prepare_cached("SELECT text FROM sign_text WHERE sign_id = ?1 ORDER BY id")?;
        let mut texts = SignTexts {
            gloss: fold_text(&gloss.unwrap_or_default()).into(),
            notes: notes.map(|notes| fold_text(&notes).into()),
            translations: Vec::new(),
            lexicon_terms: lexicon.into_iter().chain(language).collect(),
        };
        let mut rows = statement.query([id])?;
        while let Some(row) = rows.next()? {
            texts
                .translations
                .push(fold_text(row.get_ref(0)?.as_str().unwrap_or_default()).into());
        }
        if self.signs.len() > MOST_SIGNS {
            self.signs.clear();
        }
        let texts = Rc::new(texts);
        self.signs.insert(id, texts.clone());
        Ok(texts)
    }

    fn shared_recording_context(&mut self, id: i64) -> CorpusResult<Rc<RecordingContext>> {
        if let Some(known) = self.recordings.get(&id) {
            return Ok(known.clone());
        }
        let sql = "SELECT r.signer_id, g.handedness FROM recording r
                 LEFT JOIN signer g ON g.id = r.signer_id WHERE r.id = ?1";
        let (signer, handedness) = self
            .connection
            .read_row(sql, [id], |row| Ok((row.get(0)?, row.get::<_, Option<String>>(1)?)))?;
        let around = Rc::new(RecordingContext {
            signer,
            left_handed: handedness.as_deref() == Some("left"),
            translations: self.timed_texts(id, "translation")?,
            comments: self.timed_texts(id, "comment")?,
            files: self.file_names(id)?,
        });
        if self.recordings.len() > MOST_RECORDINGS {
            self.recordings.clear();
        }
        self.recordings.insert(id, around.clone());
        Ok(around)
    }

    fn timed_texts(&self, recording: i64, role: &str) -> CorpusResult<Vec<TimedText>> {
        let sql = "SELECT a.start_us, a.end_us, a.value FROM tier i JOIN annotation a ON a.tier_id = i.id
             WHERE i.recording_id = ?1 AND i.role = ?2 AND a.state = 'value' AND a.value <> ''
             ORDER BY a.start_us, i.position, a.id";
        self.connection.read_rows(sql, (recording, role), |row| {
            Ok(TimedText {
                start: row.get(0)?,
                end: row.get(1)?,
                text: fold_text(row.get_ref(2)?.as_str().unwrap_or_default()).into(),
            })
        })
    }

    fn file_names(&self, recording: i64) -> CorpusResult<Vec<String>> {
        let sql = "SELECT DISTINCT name FROM source_file WHERE recording_id = ?1 ORDER BY name";
        self.connection.read_values(sql, [recording])
    }

    fn shared_tier_name(&mut self, id: i64) -> CorpusResult<Rc<str>> {
        load_shared_name(
            self.connection,
            &mut self.tiers,
            "SELECT name FROM tier WHERE id = ?1",
            id,
        )
    }

    fn shared_inventory_key(&mut self, id: i64) -> CorpusResult<Rc<str>> {
        let sql = "SELECT key FROM inventory WHERE id = ?1";
        load_shared_name(self.connection, &mut self.inventories, sql, id)
    }

    /// Returns the opinion that a row of values stands for; `None` for a value that counts.
    fn opinion_of_row(&self, row: &Row<'_>) -> rusqlite::Result<Option<AnnotationOpinion>> {
        match (row.get_ref(6)?.as_str(), row.get::<_, Option<i64>>(9)?) {
            (Ok("unset"), Some(annotation)) => opinion_of_annotation(self.connection, annotation),
            _ => Ok(None),
        }
    }

    fn terms_of(&mut self, row: &Row<'_>, left_handed: bool) -> rusqlite::Result<Rc<ReadingTerms>> {
        let column_text = |column: usize| row.get_ref(column)?.as_str_or_null().map_err(Into::into);
        let text = |column| -> rusqlite::Result<Option<&str>> { column_text(column) };
        let (hand, component, part, phase) = (text(1)?, text(2)?, text(3)?, text(4)?);
        let position: i64 = row.get(5)?;
        let (state, value) = (text(6)?, text(7)?);
        // One buffer serves all keys, as a key is built for each of millions of values.
        self.key.clear();
        for piece in [hand, component, part, phase, state, value] {
            // Control letters keep a missing piece apart from an empty one, and pieces from each other.
            self.key.push_str(piece.unwrap_or("\u{2}"));
            self.key.push('\u{1}');
        }
        self.key.push(if left_handed { 'l' } else { 'r' });
        self.key.push_str(&position.to_string());
        if let Some(known) = self.terms.get(&self.key) {
            return Ok(known.clone());
        }
        let component = component.unwrap_or_default();
        let reading = reading_text(read_word_column(row, 6)?, value);
        let phase = phase_code(stored_columns::read_phase_columns(row, 4)?);
        let codes = hand_codes(word_or_null(row, 1)?, left_handed).iter();
        let made = Rc::new(ReadingTerms {
            terms: codes
                .map(|&hand| reading_term(component, hand, &phase, part, reading))
                .collect(),
            facet: value.map(|value| {
                let place = hand.map_or(String::new(), |hand| format!("{hand}."));
                let part = part.map_or(String::new(), |part| format!(".{part}"));
                format!("{place}{component}{part}={value}")
            }),
        });
        if self.terms.len() > MOST_TERMS {
            self.terms.clear();
        }
        self.terms.insert(self.key.clone(), made.clone());
        Ok(made)
    }
}

/// Returns the terms of an opinion, which no facet counts.
fn opinion_terms(row: &Row<'_>, left_handed: bool, opinion: &AnnotationOpinion) -> rusqlite::Result<ReadingTerms> {
    let component = opinion_component(row.get_ref(2)?.as_str().unwrap_or_default());
    let part = row.get_ref(3)?.as_str_or_null()?;
    let phase = phase_code(stored_columns::read_phase_columns(row, 4)?);
    let reading = reading_text(opinion.state, Some(&opinion.value));
    let codes = hand_codes(word_or_null(row, 1)?, left_handed).iter();
    Ok(ReadingTerms {
        terms: codes
            .map(|&hand| reading_term(&component, hand, &phase, part, reading))
            .collect(),
        facet: None,
    })
}

fn load_shared_name(
    connection: &Connection,
    known: &mut HashMap<i64, Rc<str>>,
    sql: &str,
    id: i64,
) -> CorpusResult<Rc<str>> {
    if let Some(name) = known.get(&id) {
        return Ok(name.clone());
    }
    let stored_name: String = connection.find_value(sql, [id])?.unwrap_or_default();
    let name: Rc<str> = stored_name.into();
    known.insert(id, name.clone());
    Ok(name)
}

/// Adds the texts that overlap a token in time; `timed` is ordered by start.
fn add_overlapping(timed: &[TimedText], start: i64, end: i64, texts: &mut Vec<Rc<str>>) {
    let until = timed.partition_point(|text| text.start < end);
    let during = timed[..until].iter().filter(|text| text.end > start);
    texts.extend(during.map(|text| text.text.clone()));
}
