//! Rows that search results read in addition to the index.

use std::collections::BTreeMap;

use chereme_sign::tier::AnnotatedHands;
use chereme_sign::{SignComponent, SignPhase, TierRole};
use rusqlite::{Connection, OptionalExtension, Row};

use crate::db::cached_sql::CachedSql;
use crate::db::people::SIGNER_ATTRIBUTE_PREFIX;
use crate::db::signs::IS_OPINION_SQL;
use crate::db::stored_attributes::AttributeRow;
use crate::db::stored_columns::{
    OpinionStanding, RecordOrigin, ValueState, read_phase_columns, read_role_columns, read_word_column, word_or_null,
};
use crate::db::stored_tiers::is_proposal_sql;
use crate::error::CorpusResult;

/// Returns two numbers that change whenever any connection changes a row.
pub(crate) fn database_versions(connection: &Connection) -> CorpusResult<(i64, u64)> {
    let others = connection.read_value("PRAGMA data_version", [])?;
    Ok((others, connection.total_changes()))
}

/// Rows that have a name.
#[derive(Debug, Clone, Copy)]
pub(crate) enum NamedRowKind {
    Signer,
    Recording,
    Sign,
    /// Signs by lexicon and gloss, by gloss and number, or by all of them: `NGT/BOOK`, `BANK#2`, `NGT/BANK#2`.
    LexiconEntry,
}

/// Returns row and name of all such rows, by row.
pub(crate) fn list_row_names(connection: &Connection, named: NamedRowKind) -> CorpusResult<Vec<(i64, String)>> {
    let sql = match named {
        NamedRowKind::Signer => {
            "SELECT id, name FROM signer UNION ALL SELECT signer_id, name FROM person_alias ORDER BY 1"
        }
        NamedRowKind::Recording => "SELECT id, name FROM recording ORDER BY id",
        NamedRowKind::Sign => "SELECT id, gloss FROM sign ORDER BY id",
        NamedRowKind::LexiconEntry => {
            "SELECT s.id, l.name || '/' || x.value FROM sign s JOIN lexicon l ON l.id = s.lexicon_id
             JOIN json_each(json_array(s.gloss, s.gloss || '#' || ifnull(s.homonym, 1))) x
             UNION ALL SELECT id, gloss || '#' || ifnull(homonym, 1) FROM sign ORDER BY 1"
        }
    };
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Returns the name of a row.
pub(crate) fn find_row_name(connection: &Connection, named: NamedRowKind, id: i64) -> CorpusResult<Option<String>> {
    let sql = match named {
        NamedRowKind::Signer => "SELECT name FROM signer WHERE id = ?1",
        NamedRowKind::Recording => "SELECT name FROM recording WHERE id = ?1",
        NamedRowKind::Sign | NamedRowKind::LexiconEntry => "SELECT gloss FROM sign WHERE id = ?1",
    };
    connection.find_value(sql, [id])
}

/// A token as a search result shows it.
pub(crate) struct HitRow {
    pub(crate) gloss: String,
    pub(crate) lexicon: Option<String>,
    pub(crate) recording: Option<String>,
    pub(crate) start_us: Option<i64>,
    pub(crate) end_us: Option<i64>,
    pub(crate) origin: RecordOrigin,
}

/// Returns the token of that row.
pub(crate) fn find_hit_row(connection: &Connection, token: i64) -> CorpusResult<Option<HitRow>> {
    let sql = "SELECT s.label, r.name, t.start_us, t.end_us, t.origin, l.name
             FROM token t JOIN sign s ON s.id = t.sign_id LEFT JOIN lexicon l ON l.id = s.lexicon_id
             LEFT JOIN recording r ON r.id = t.recording_id WHERE t.id = ?1";
    connection.find_row(sql, [token], |row| {
        Ok(HitRow {
            gloss: row.get(0)?,
            recording: row.get(1)?,
            start_us: row.get(2)?,
            end_us: row.get(3)?,
            origin: read_word_column(row, 4)?,
            lexicon: row.get(5)?,
        })
    })
}

/// An annotation or value over a span of a recording or token.
pub(crate) struct CodedRow<'r> {
    /// Start and end; a lexicon entry has none.
    pub(crate) span: Option<(i64, i64)>,
    pub(crate) hand: Option<AnnotatedHands>,
    /// The component; an annotation of a tier that codes no component has none.
    pub(crate) component: Option<SignComponent>,
    pub(crate) part: Option<&'r str>,
    pub(crate) phase: Option<SignPhase>,
    pub(crate) state: ValueState,
    pub(crate) value: Option<&'r str>,
}

impl<'r> CodedRow<'r> {
    fn coded_row_from_columns(row: &'r Row<'_>) -> rusqlite::Result<Self> {
        let text = |column: usize| -> rusqlite::Result<Option<&'r str>> { Ok(row.get_ref(column)?.as_str_or_null()?) };
        let start: Option<i64> = row.get(0)?;
        Ok(Self {
            span: start.zip(row.get(1)?),
            hand: word_or_null(row, 2)?,
            component: word_or_null(row, 3)?,
            part: text(4)?,
            phase: read_phase_columns(row, 5)?,
            state: read_word_column(row, 7)?,
            value: text(8)?,
        })
    }
}

fn each_coded(
    connection: &Connection,
    sql: &str,
    params: impl rusqlite::Params,
    mut take: impl FnMut(CodedRow<'_>),
) -> CorpusResult<()> {
    connection.visit_rows(sql, params, |row| {
        take(CodedRow::coded_row_from_columns(row)?);
        Ok(())
    })
}

/// Calls `take` with the values of a token that count, in the order in which they were written.
pub(crate) fn coded_of_token(connection: &Connection, token: i64, take: impl FnMut(CodedRow<'_>)) -> CorpusResult<()> {
    // The order of writing is kept, since the values of a token by phase follow each other in it.
    let sql = format!(
        "SELECT NULL, NULL, hand, component, feature, phase, position, state, value
         FROM token_value WHERE token_id = ?1 AND NOT ({IS_OPINION_SQL}) ORDER BY id"
    );
    each_coded(connection, &sql, [token], take)
}

/// The statement of an annotation about a token.
pub(crate) struct AnnotationOpinion {
    pub(crate) state: ValueState,
    pub(crate) value: String,
    /// The annotator, or [`DETECTOR_NAME`].
    pub(crate) by: Option<String>,
    pub(crate) confidence: Option<f64>,
    /// The detector that found it, whoever accepted or corrected it.
    pub(crate) detector: Option<String>,
    /// The value that the detector proposed, if a person gave another one.
    pub(crate) proposed: Option<String>,
    /// The standing of an opinion without one.
    pub(crate) usual_standing: OpinionStanding,
}

/// The name under which queries and answers know detectors.
pub(crate) const DETECTOR_NAME: &str = "detector";

/// Returns the opinion that an annotation is.
pub(crate) fn opinion_of_annotation(
    connection: &Connection,
    annotation: i64,
) -> rusqlite::Result<Option<AnnotationOpinion>> {
    connection
        .prepare_cached(concat!(
            "SELECT ",
            is_proposal_sql!(),
            ", a.state, trim(a.value), t.annotator, coalesce(a.confidence, a.source ->> '$.confidence'),
                     a.source ->> '$.detector' || ' ' || (a.source ->> '$.version'), a.source ->> '$.proposed'
                 FROM annotation a JOIN tier t ON t.id = a.tier_id WHERE a.id = ?1"
        ))?
        .query_row([annotation], |row| {
            // A proposal has no annotator whose word could stand against others'.
            let is_proposal: bool = row.get(0)?;
            Ok(AnnotationOpinion {
                state: read_word_column(row, 1)?,
                value: row.get(2)?,
                by: match is_proposal {
                    true => Some(DETECTOR_NAME.to_owned()),
                    false => row.get(3)?,
                },
                confidence: row.get(4)?,
                detector: row.get(5)?,
                proposed: row.get(6)?,
                usual_standing: match is_proposal {
                    true => OpinionStanding::Proposed,
                    false => OpinionStanding::Disputed,
                },
            })
        })
        .optional()
}

/// Who said something, and with which confidence if that was a detector.
#[cfg(feature = "parquet")]
pub(crate) type ValueAuthor = (Option<String>, Option<f64>);

/// Returns the annotators of the values of tokens, by annotation.
#[cfg(feature = "parquet")]
pub(crate) fn load_value_authors(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, ValueAuthor>> {
    let sql = "SELECT a.id, t.annotator, a.confidence FROM token_value v JOIN annotation a ON a.id = v.annotation_id
         JOIN tier t ON t.id = a.tier_id WHERE v.token_id IN (SELECT value FROM json_each(?1))";
    let tokens = crate::db::signs::json_list(tokens);
    connection.read_rows(sql, [tokens], |row| Ok((row.get(0)?, (row.get(1)?, row.get(2)?))))
}

/// Calls `take` with the opinions about a token, each with its field, its standing and its annotation.
pub(crate) fn visit_token_opinions(
    connection: &Connection,
    token: i64,
    mut take: impl FnMut(&CodedRow<'_>, OpinionStanding, AnnotationOpinion),
) -> CorpusResult<()> {
    let sql = format!(
        "SELECT NULL, NULL, hand, component, feature, phase, position, state, value, annotation_id, standing
         FROM token_value WHERE token_id = ?1 AND {IS_OPINION_SQL} ORDER BY id"
    );
    connection.visit_rows(&sql, [token], |row| {
        if let Some(opinion) = opinion_of_annotation(connection, row.get(9)?)? {
            let standing = word_or_null(row, 10)?.unwrap_or(opinion.usual_standing);
            take(&CodedRow::coded_row_from_columns(row)?, standing, opinion);
        }
        Ok(())
    })
}

/// Returns the tokens of which an annotator says something, whether it counts or not, without proposals of detectors.
pub(crate) fn tokens_by_annotator(connection: &Connection, is_meant: &dyn Fn(&str) -> bool) -> CorpusResult<Vec<i64>> {
    let mut tokens = Vec::new();
    for name in annotator_names(connection)?.into_iter().filter(|name| is_meant(name)) {
        let mut statement = connection.prepare_cached(concat!(
            "SELECT v.token_id FROM tier t JOIN annotation a ON a.tier_id = t.id
                 JOIN token_value v ON v.annotation_id = a.id WHERE t.annotator = ?1 AND NOT ",
            is_proposal_sql!()
        ))?;
        let rows = statement.query_map([name], |row| row.get(0))?;
        tokens.extend(rows.collect::<rusqlite::Result<Vec<i64>>>()?);
    }
    tokens.sort_unstable();
    tokens.dedup();
    Ok(tokens)
}

/// Returns the other names of the people who annotated tiers, by the name that the tiers have.
pub(crate) fn annotator_aliases(connection: &Connection) -> CorpusResult<BTreeMap<String, Vec<String>>> {
    // A tier may name a person by an alias, so that the person's own name is another one, too.
    let sql = "SELECT DISTINCT t.annotator, o.name FROM tier t
         JOIN (SELECT id AS person, name FROM signer UNION SELECT signer_id, name FROM person_alias) k ON k.name = t.annotator
         JOIN (SELECT id AS person, name FROM signer UNION SELECT signer_id, name FROM person_alias) o
             ON o.person = k.person AND o.name <> t.annotator";
    let mut aliases: BTreeMap<String, Vec<String>> = BTreeMap::new();
    connection.visit_rows(sql, [], |row| {
        aliases.entry(row.get(0)?).or_default().push(row.get(1)?);
        Ok(())
    })?;
    Ok(aliases)
}

/// Returns the names of the annotators of tiers, each once, by name.
pub(crate) fn annotator_names(connection: &Connection) -> CorpusResult<Vec<String>> {
    let sql = "SELECT DISTINCT annotator FROM tier WHERE annotator <> '' ORDER BY annotator";
    connection.read_values(sql, [])
}

/// Returns the tokens with a value, or an opinion, whose confidence passes.
pub(crate) fn tokens_of_confidence(connection: &Connection, passes: &dyn Fn(f64) -> bool) -> CorpusResult<Vec<i64>> {
    let mut statement = connection.prepare_cached(
        "SELECT v.token_id, a.confidence FROM annotation a JOIN token_value v ON v.annotation_id = a.id
         WHERE a.confidence IS NOT NULL",
    )?;
    let mut rows = statement.query([])?;
    let mut tokens = Vec::new();
    while let Some(row) = rows.next()? {
        if passes(row.get(1)?) {
            tokens.push(row.get(0)?);
        }
    }
    tokens.sort_unstable();
    tokens.dedup();
    Ok(tokens)
}

/// Something that is known of recordings.
#[derive(Debug, Clone, Copy)]
pub(crate) enum RecordingFact {
    Name,
    File,
    /// All names of those who sign or take part.
    Signer,
    /// What is said of them.
    Attribute,
}

/// What is known of recordings, by row.
pub(crate) type SaidOfRecordings = BTreeMap<i64, Vec<AttributeRow>>;

/// Returns what is known of all recordings; the number of a name is that of its row.
pub(crate) fn load_recording_facts(connection: &Connection, fact: RecordingFact) -> CorpusResult<SaidOfRecordings> {
    const PEOPLE_SQL: &str = "(SELECT id recording_id, signer_id FROM recording UNION
        SELECT i.recording_id, s.id FROM tier i JOIN signer s ON s.name = i.participant) w";
    let sql = match fact {
        RecordingFact::Name => "SELECT id, '', name, id FROM recording".to_owned(),
        RecordingFact::File => {
            "SELECT recording_id, '', name, NULL FROM source_file WHERE recording_id IS NOT NULL".to_owned()
        }
        RecordingFact::Signer => format!(
            "SELECT w.recording_id, '', n.name, n.id FROM {PEOPLE_SQL} JOIN (SELECT id, name FROM signer
             UNION ALL SELECT signer_id, name FROM person_alias) n ON n.id = w.signer_id"
        ),
        RecordingFact::Attribute => format!(
            "SELECT w.recording_id, '{SIGNER_ATTRIBUTE_PREFIX}' || v.name, v.text, v.number
             FROM {PEOPLE_SQL} JOIN person_attribute v ON v.signer_id = w.signer_id"
        ),
    };
    let mut statement = connection.prepare_cached(&sql)?;
    let mut rows = statement.query([])?;
    let mut said = SaidOfRecordings::new();
    while let Some(row) = rows.next()? {
        said.entry(row.get(0)?).or_default().push(AttributeRow {
            name: row.get(1)?,
            text: row.get(2)?,
            number: row.get(3)?,
        });
    }
    Ok(said)
}

/// A value of a token, or an opinion about it, with who says so.
pub(crate) struct SaidValue<'r> {
    pub(crate) token: i64,
    pub(crate) coded: CodedRow<'r>,
    /// Why it does not count, unless it does.
    pub(crate) standing: Option<OpinionStanding>,
    /// The annotator, or `detector` of a proposal.
    pub(crate) by: Option<&'r str>,
    pub(crate) confidence: Option<f64>,
    pub(crate) is_left_handed: bool,
}

/// Calls `take` with every value and opinion of a component, until it fails.
pub(crate) fn visit_said_values(
    connection: &Connection,
    component: &str,
    mut take: impl FnMut(&SaidValue<'_>) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let is_proposal = is_proposal_sql!();
    let sql = format!(
        "SELECT NULL, NULL, v.hand, v.component, v.feature, v.phase, v.position,
             iif(v.state = 'unset' AND a.id IS NOT NULL, a.state, v.state),
             iif(v.state = 'unset' AND a.id IS NOT NULL, trim(a.value), v.value),
             v.token_id, v.state = 'unset' AND a.id IS NOT NULL, {is_proposal}, t.annotator, a.confidence,
             coalesce(p.handedness, g.handedness) = 'left', v.standing
         FROM token_value v JOIN token k ON k.id = v.token_id
         LEFT JOIN annotation a ON a.id = v.annotation_id LEFT JOIN tier t ON t.id = a.tier_id
         LEFT JOIN annotation b ON b.id = k.annotation_id LEFT JOIN tier i ON i.id = b.tier_id
         LEFT JOIN signer p ON p.name = i.participant
         LEFT JOIN recording r ON r.id = k.recording_id LEFT JOIN signer g ON g.id = r.signer_id
         WHERE v.component = ?1"
    );
    connection.visit_rows(&sql, [component], |row| {
        let (is_opinion, is_detected): (bool, Option<bool>) = (row.get(10)?, row.get(11)?);
        let standing = match (is_opinion, word_or_null(row, 15)?) {
            (false, _) => None,
            (true, Some(standing)) => Some(standing),
            (true, None) if is_detected == Some(true) => Some(OpinionStanding::Proposed),
            (true, None) => Some(OpinionStanding::Disputed),
        };
        let by = match standing {
            Some(OpinionStanding::Proposed | OpinionStanding::Rejected) => Some(DETECTOR_NAME),
            _ => row.get_ref(12)?.as_str_or_null().map_err(rusqlite::Error::from)?,
        };
        take(&SaidValue {
            token: row.get(9)?,
            coded: CodedRow::coded_row_from_columns(row)?,
            standing,
            by,
            confidence: row.get(13)?,
            is_left_handed: row.get::<_, Option<bool>>(14)?.unwrap_or(false),
        })?;
        Ok(())
    })
}

/// The readings of a recording that a relation looks at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RecordingReadings<'a> {
    pub(crate) component: &'a str,
    /// The values of tokens by phase, each over the span of its annotation, or of its token if it has none.
    pub(crate) phases: bool,
    /// Opinions as well, which do not count.
    pub(crate) opinions: bool,
}

/// Calls `take` with the readings of a component in a recording: the annotations of its tiers, and the values of tokens
/// that come from no annotation; or the values of tokens by phase.
pub(crate) fn coded_in_recording(
    connection: &Connection,
    recording: i64,
    asked: RecordingReadings<'_>,
    take: impl FnMut(CodedRow<'_>),
) -> CorpusResult<()> {
    // A value that is an opinion has its text on the annotation alone, from which it is read then.
    let sql = if asked.phases {
        "SELECT coalesce(a.start_us, t.start_us), coalesce(a.end_us, t.end_us), v.hand, v.component,
             v.feature, v.phase, v.position, iif(v.state = 'unset' AND a.id IS NOT NULL, a.state, v.state),
             iif(v.state = 'unset' AND a.state = 'value', a.value, v.value)
         FROM token t JOIN token_value v ON v.token_id = t.id
         LEFT JOIN annotation a ON a.id = v.annotation_id
         WHERE t.recording_id = ?1 AND v.component = ?2 AND (?3 OR v.state <> 'unset' OR a.id IS NULL)"
    } else {
        concat!(
            "SELECT a.start_us, a.end_us, t.hand, t.component, t.feature, NULL, 0, a.state, a.value
         FROM tier t JOIN annotation a ON a.tier_id = t.id
         WHERE t.recording_id = ?1 AND t.role = 'component' AND t.component = ?2
             AND (?3 OR NOT ",
            is_proposal_sql!(),
            ")
         UNION ALL
         SELECT t.start_us, t.end_us, v.hand, v.component, v.feature, v.phase, v.position, v.state,
             v.value
         FROM token t JOIN token_value v ON v.token_id = t.id
         WHERE t.recording_id = ?1 AND v.component = ?2 AND v.annotation_id IS NULL"
        )
    };
    each_coded(connection, sql, (recording, asked.component, asked.opinions), take)
}

/// Returns whether the signer of a recording is left-handed.
pub(crate) fn left_handed(connection: &Connection, recording: i64) -> CorpusResult<bool> {
    let sql = "SELECT g.handedness = 'left' FROM recording r JOIN signer g ON g.id = r.signer_id
             WHERE r.id = ?1";
    let is_left = connection.find_row(sql, [recording], |row| row.get::<_, Option<bool>>(0))?;
    Ok(is_left.flatten().unwrap_or(false))
}

/// Returns the tiers of a recording, in their order, as row, name and role.
pub(crate) fn list_recording_tier_roles(
    connection: &Connection,
    recording: i64,
) -> CorpusResult<Vec<(i64, String, TierRole)>> {
    let sql = "SELECT id, name, role, component, feature FROM tier WHERE recording_id = ?1 ORDER BY position, id";
    connection.read_rows(sql, [recording], |row| {
        Ok((row.get(0)?, row.get(1)?, read_role_columns(row, 2)?))
    })
}

/// Returns the names of all tiers, each once, by name.
pub(crate) fn tier_names(connection: &Connection) -> CorpusResult<Vec<String>> {
    connection.read_values("SELECT DISTINCT name FROM tier ORDER BY name", [])
}

/// Calls `take` with the annotations of a tier.
pub(crate) fn on_tier(connection: &Connection, tier: i64, take: impl FnMut(CodedRow<'_>)) -> CorpusResult<()> {
    let sql = "SELECT start_us, end_us, NULL, NULL, NULL, NULL, 0, state, value
        FROM annotation WHERE tier_id = ?1 ORDER BY start_us";
    each_coded(connection, sql, [tier], take)
}

/// Returns the translations and remarks for a token: those of its sign, and the annotations that overlap it.
pub(crate) fn texts_of_token(connection: &Connection, token: i64) -> CorpusResult<(Vec<String>, Vec<String>)> {
    // Annotations have no link to tokens of another tier; sharing time with them is what counts.
    let of_sign = "SELECT 'translation', x.text FROM token t
            JOIN sign_text x ON x.sign_id = t.sign_id WHERE t.id = ?1
        UNION ALL SELECT 'comment', s.notes FROM token t
            JOIN sign s ON s.id = t.sign_id WHERE t.id = ?1 AND s.notes IS NOT NULL
        UNION ALL SELECT i.role, a.value FROM token t
            JOIN tier i ON i.recording_id = t.recording_id
            JOIN annotation a ON a.tier_id = i.id
            WHERE t.id = ?1 AND i.role IN ('translation', 'comment')
              AND a.state = 'value' AND a.value <> ''
              AND a.start_us < t.end_us AND a.end_us > t.start_us";
    let mut statement = connection.prepare_cached(of_sign)?;
    let mut rows = statement.query([token])?;
    let (mut translations, mut comments) = (Vec::new(), Vec::new());
    while let Some(row) = rows.next()? {
        let translation = row.get_ref(0)?.as_str().is_ok_and(|role| role == "translation");
        let texts = if translation { &mut translations } else { &mut comments };
        texts.push(row.get(1)?);
    }
    Ok((translations, comments))
}
