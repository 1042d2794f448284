//! Lists of rows: the columns that each kind of row has, and how lists are filtered, sorted and counted.

use chereme_sign::query::TextPattern;
use chereme_sign::text::fold_text;
use rusqlite::functions::FunctionFlags;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, ToSql};
use serde_json::{Map, Value};

use super::token_marks::{DISPUTED_FIELDS_SQL, PROPOSED_FIELDS_SQL};
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// Type of a column's content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ListColumnContent {
    /// A name or text.
    Text,
    /// A number.
    Number,
    /// Yes or no.
    Flag,
    /// JSON; filters apply to the text that the second expression gives.
    Json(&'static str),
    /// The components of a token, which the caller adds from the row's `id`.
    Components,
    /// The notation of a token, or of a sign's citation form, which the caller adds from the row number that the
    /// expression gives; filters apply to the text that the second expression gives.
    Notation(&'static str),
}

/// A column of a list.
#[derive(Debug)]
pub(crate) struct ListColumn {
    pub(crate) name: &'static str,
    sql: &'static str,
    pub(crate) holds: ListColumnContent,
    /// The kind of row that the text names, if such rows have addresses.
    row: Option<&'static str>,
}

/// A list: its columns, the rows that it shows, and its default order.
#[derive(Debug)]
pub(crate) struct ListTable {
    pub(crate) columns: &'static [ListColumn],
    from: &'static str,
    order: &'static str,
}

const fn text_list_column(name: &'static str, sql: &'static str) -> ListColumn {
    new_list_column(name, sql, ListColumnContent::Text, None)
}

const fn number_list_column(name: &'static str, sql: &'static str) -> ListColumn {
    new_list_column(name, sql, ListColumnContent::Number, None)
}

const fn flag_list_column(name: &'static str, sql: &'static str) -> ListColumn {
    new_list_column(name, sql, ListColumnContent::Flag, None)
}

const fn json_list_column(name: &'static str, sql: &'static str, filter: &'static str) -> ListColumn {
    new_list_column(name, sql, ListColumnContent::Json(filter), None)
}

/// Returns a text column that names a row of the kind `row`.
const fn named_row_column(name: &'static str, sql: &'static str, row: &'static str) -> ListColumn {
    new_list_column(name, sql, ListColumnContent::Text, Some(row))
}

const fn new_list_column(
    name: &'static str,
    sql: &'static str,
    holds: ListColumnContent,
    row: Option<&'static str>,
) -> ListColumn {
    ListColumn { name, sql, holds, row }
}

pub(crate) const RECORDINGS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "r.id"),
        named_row_column("name", "r.name", "r.id"),
        named_row_column("signer", "g.name", "g.id"),
        text_list_column("origin", "r.origin"),
        number_list_column("duration_us", "r.duration_us"),
        number_list_column("frames", "k.frames"),
        number_list_column("rate", "k.rate_frames * 1.0 / k.rate_seconds"),
        number_list_column(
            "curves",
            "(SELECT count(*) FROM channel c JOIN track t ON t.id = c.track_id
              WHERE t.recording_id = r.id AND t.kind = 'curves')",
        ),
        number_list_column("joints", "(SELECT joints FROM skeleton s WHERE s.id = k.skeleton_id)"),
        number_list_column("tracks", "(SELECT count(*) FROM track t WHERE t.recording_id = r.id)"),
        number_list_column("tiers", "(SELECT count(*) FROM tier t WHERE t.recording_id = r.id)"),
        number_list_column(
            "annotations",
            "(SELECT count(*) FROM annotation a JOIN tier t ON t.id = a.tier_id WHERE t.recording_id = r.id)",
        ),
        number_list_column("tokens", "(SELECT count(*) FROM token t WHERE t.recording_id = r.id)"),
        text_list_column("recipe", "(SELECT text FROM recipe p WHERE p.recording_id = r.id)"),
        text_list_column("lexicon", "(SELECT name FROM lexicon l WHERE l.id = r.lexicon_id)"),
        text_list_column("licence", "r.licence"),
        text_list_column("notes", "r.notes"),
        text_list_column("consent", "r.consent"),
    ],
    from: "recording r LEFT JOIN signer g ON g.id = r.signer_id
           LEFT JOIN track k ON k.id = (SELECT id FROM track WHERE recording_id = r.id AND kind = 'skeleton'
                                        ORDER BY name <> 'body', id LIMIT 1)",
    order: "r.id",
};

pub(crate) const TRACKS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "t.id"),
        named_row_column("recording", "r.name", "r.id"),
        text_list_column("kind", "t.kind"),
        named_row_column("name", "t.name", "t.id"),
        number_list_column("rate", "t.rate_frames * 1.0 / t.rate_seconds"),
        number_list_column("offset_us", "t.offset_us"),
        number_list_column(
            "duration_us",
            "coalesce(t.duration_us,
                 CAST(round(t.frames * 1000000.0 * t.rate_seconds / t.rate_frames) AS INTEGER))",
        ),
        number_list_column("frames", "t.frames"),
        number_list_column(
            "channels",
            "CASE t.kind WHEN 'skeleton' THEN (SELECT joints FROM skeleton s WHERE s.id = t.skeleton_id)
                 WHEN 'media' THEN NULL ELSE (SELECT count(*) FROM channel c WHERE c.track_id = t.id) END",
        ),
        text_list_column("space", "t.layout ->> '$.space'"),
        text_list_column("media", "t.media_url"),
        number_list_column("clock_us", "t.clock_us"),
    ],
    from: "track t JOIN recording r ON r.id = t.recording_id",
    order: "t.recording_id, t.id",
};

pub(crate) const SIGNS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "s.id"),
        named_row_column("gloss", "s.label", "s.id"),
        number_list_column("tokens", "(SELECT count(*) FROM token t WHERE t.sign_id = s.id)"),
        number_list_column(
            "citation",
            "(SELECT min(id) FROM token t WHERE t.sign_id = s.id AND t.citation)",
        ),
        json_list_column(
            "translations",
            "(SELECT json_group_array(json_object('language', language, 'text', text) ORDER BY id)
              FROM sign_text x WHERE x.sign_id = s.id)",
            "(SELECT group_concat(text, ' · ' ORDER BY id) FROM sign_text x WHERE x.sign_id = s.id)",
        ),
        new_list_column(
            "notation",
            "(SELECT t.id FROM notation n JOIN token t ON t.id = n.token_id
              WHERE t.sign_id = s.id ORDER BY t.citation DESC, t.id LIMIT 1)",
            ListColumnContent::Notation(
                "(SELECT coalesce(n.text, n.system) FROM notation n JOIN token t ON t.id = n.token_id
                  WHERE t.sign_id = s.id ORDER BY t.citation DESC, t.id LIMIT 1)",
            ),
            None,
        ),
        json_list_column(
            "attributes",
            "(SELECT json_group_object(a.name, a.text) FROM attribute a JOIN token t ON t.id = a.token_id
              WHERE t.sign_id = s.id HAVING count(*) > 0)",
            "(SELECT group_concat(a.name || '=' || a.text, ' ') FROM attribute a
              JOIN token t ON t.id = a.token_id WHERE t.sign_id = s.id)",
        ),
        text_list_column("lexicon", "l.name"),
        number_list_column("homonym", "s.homonym"),
        text_list_column("notes", "s.notes"),
    ],
    from: "sign s LEFT JOIN lexicon l ON l.id = s.lexicon_id",
    order: "s.gloss, s.homonym",
};

pub(crate) const TOKENS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "t.id"),
        named_row_column("gloss", "s.label", "s.id"),
        named_row_column("recording", "r.name", "r.id"),
        number_list_column("start_us", "t.start_us"),
        number_list_column("end_us", "t.end_us"),
        text_list_column("hand", "t.hand"),
        text_list_column("origin", "t.origin"),
        flag_list_column("citation", "t.citation"),
        named_row_column("signer", "g.name", "g.id"),
        text_list_column("disputed", DISPUTED_FIELDS_SQL),
        text_list_column("proposed", PROPOSED_FIELDS_SQL),
        new_list_column("components", "NULL", ListColumnContent::Components, None),
        new_list_column(
            "notation",
            "(SELECT n.token_id FROM notation n WHERE n.token_id = t.id)",
            ListColumnContent::Notation("(SELECT coalesce(n.text, n.system) FROM notation n WHERE n.token_id = t.id)"),
            None,
        ),
    ],
    from: "token t JOIN sign s ON s.id = t.sign_id LEFT JOIN recording r ON r.id = t.recording_id
           LEFT JOIN annotation a ON a.id = t.annotation_id LEFT JOIN tier i ON i.id = a.tier_id
           LEFT JOIN signer p ON p.name = i.participant
           LEFT JOIN signer g ON g.id = coalesce(p.id, r.signer_id)",
    order: "t.id",
};

pub(crate) const TIERS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "t.id"),
        named_row_column("recording", "r.name", "r.id"),
        named_row_column("name", "t.name", "t.id"),
        text_list_column("role", "t.role"),
        text_list_column("component", "t.component"),
        text_list_column("feature", "t.feature"),
        text_list_column("hand", "t.hand"),
        named_row_column("parent", "p.name", "p.id"),
        text_list_column("stereotype", "t.stereotype"),
        text_list_column("inventory", "i.key"),
        number_list_column(
            "annotations",
            "(SELECT count(*) FROM annotation a WHERE a.tier_id = t.id)",
        ),
        text_list_column("participant", "t.participant"),
        text_list_column("annotator", "t.annotator"),
        text_list_column("language", "t.language"),
    ],
    from: "tier t JOIN recording r ON r.id = t.recording_id LEFT JOIN tier p ON p.id = t.parent_id
           LEFT JOIN inventory i ON i.id = t.inventory_id",
    order: "t.recording_id, t.position, t.id",
};

pub(crate) const ANNOTATIONS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "a.id"),
        named_row_column("recording", "r.name", "r.id"),
        named_row_column("tier", "t.name", "t.id"),
        number_list_column("start_us", "a.start_us"),
        number_list_column("end_us", "a.end_us"),
        text_list_column("state", "a.state"),
        text_list_column("value", "a.value"),
        number_list_column("parent", "a.parent_id"),
        number_list_column("position", "a.position"),
        text_list_column("role", "t.role"),
        text_list_column("component", "t.component"),
        text_list_column("hand", "t.hand"),
        text_list_column("origin", "a.origin"),
        number_list_column("confidence", "a.confidence"),
        text_list_column("external_id", "a.external_id"),
    ],
    from: "annotation a JOIN tier t ON t.id = a.tier_id JOIN recording r ON r.id = t.recording_id",
    order: "t.recording_id, t.position, t.id, a.start_us, a.position, a.id",
};

pub(crate) const INVENTORIES_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "i.id"),
        text_list_column("key", "i.key"),
        text_list_column("name", "i.document ->> '$.names.en'"),
        text_list_column("component", "i.component"),
        text_list_column("feature", "i.feature"),
        text_list_column("language", "i.document ->> '$.language'"),
        number_list_column(
            "values",
            "(SELECT count(*) FROM inventory_value v WHERE v.inventory_id = i.id)",
        ),
        number_list_column("tiers", "(SELECT count(*) FROM tier t WHERE t.inventory_id = i.id)"),
        number_list_column(
            "uses",
            "(SELECT count(*) FROM token_value v WHERE v.inventory_id = i.id AND v.state <> 'unset')",
        ),
        text_list_column("description", "i.document ->> '$.description'"),
    ],
    from: "inventory i",
    order: "i.id",
};

/// Counts the tokens that have a value; a token counts once even if several of its hands or phases have it.
const TOKENS_WITH_VALUE: &str = "(SELECT count(DISTINCT u.token_id) FROM token_value u
    WHERE u.component = i.component AND u.value = v.key AND u.inventory_id = i.id)";

/// Counts the annotations on the tiers of an inventory that have a value.
const ANNOTATIONS_WITH_VALUE: &str = "(SELECT count(*) FROM annotation a JOIN tier t ON t.id = a.tier_id
    WHERE t.inventory_id = i.id AND a.state = 'value' AND a.value = v.key)";

/// Counts the tokens that have a value, plus the annotations with it that belong to none of these tokens.
const USES_OF_VALUE: &str = "(SELECT count(DISTINCT u.token_id) FROM token_value u
    WHERE u.component = i.component AND u.value = v.key AND u.inventory_id = i.id)
    + (SELECT count(*) FROM annotation a JOIN tier t ON t.id = a.tier_id
       WHERE t.inventory_id = i.id AND a.state = 'value' AND a.value = v.key
         AND NOT EXISTS (SELECT 1 FROM token_value u WHERE u.annotation_id = a.id
                         AND u.inventory_id = i.id AND u.value = v.key))";

pub(crate) const INVENTORY_VALUES_LIST: ListTable = ListTable {
    columns: &[
        text_list_column("value", "v.key"),
        text_list_column("inventory", "i.key"),
        text_list_column("component", "i.component"),
        text_list_column("feature", "i.feature"),
        json_list_column("names", "v.document -> '$.names'", "v.document ->> '$.names'"),
        json_list_column("features", "v.document -> '$.features'", "v.document ->> '$.features'"),
        text_list_column("hamnosys", "v.document ->> '$.hamnosys'"),
        text_list_column("broader", "v.document ->> '$.broader'"),
        number_list_column("tokens", TOKENS_WITH_VALUE),
        number_list_column("annotations", ANNOTATIONS_WITH_VALUE),
        number_list_column("uses", USES_OF_VALUE),
    ],
    from: "inventory_value v JOIN inventory i ON i.id = v.inventory_id",
    order: "i.id, v.position, v.id",
};

pub(crate) const SIGNERS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "g.id"),
        named_row_column("name", "g.name", "g.id"),
        text_list_column("handedness", "g.handedness"),
        number_list_column(
            "recordings",
            "(SELECT count(*) FROM recording r WHERE r.signer_id = g.id
              OR EXISTS (SELECT 1 FROM tier i WHERE i.recording_id = r.id AND i.participant = g.name))",
        ),
        number_list_column(
            "tokens",
            "(SELECT count(*) FROM token t JOIN recording r ON r.id = t.recording_id
              LEFT JOIN annotation a ON a.id = t.annotation_id LEFT JOIN tier i ON i.id = a.tier_id
              LEFT JOIN signer p ON p.name = i.participant
              WHERE coalesce(p.id, r.signer_id) = g.id)",
        ),
        text_list_column("notes", "g.notes"),
        text_list_column("consent", "g.consent"),
    ],
    from: super::people::SIGNER_ROWS_SQL,
    order: "g.name",
};

pub(crate) const SEARCHES_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "k.id"),
        text_list_column("name", "k.name"),
        text_list_column("query", "k.query"),
    ],
    from: "kept_search k",
    order: "k.name",
};

pub(crate) const STUDIES_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "s.id"),
        text_list_column("name", "s.name"),
        number_list_column("trials", "json_array_length(s.plan, '$.trials')"),
        number_list_column("questions", "json_array_length(s.plan, '$.questions')"),
        number_list_column(
            "participants",
            "(SELECT count(*) FROM study_participant p WHERE p.study_id = s.id)",
        ),
        number_list_column(
            "finished",
            "(SELECT count(*) FROM study_participant p WHERE p.study_id = s.id AND p.finished)",
        ),
        number_list_column(
            "answers",
            "(SELECT count(*) FROM study_answer a JOIN study_participant p ON p.id = a.participant_id
              WHERE p.study_id = s.id)",
        ),
        text_list_column("plan_sha256", "s.plan_sha256"),
    ],
    from: "study s",
    order: "s.name",
};

pub(crate) const OPERATIONS_LIST: ListTable = ListTable {
    columns: &[
        number_list_column("id", "o.id"),
        text_list_column("at", "o.at"),
        text_list_column("author", "o.author"),
        text_list_column("kind", "o.kind"),
        number_list_column("target", "o.target"),
        text_list_column("name", "o.name"),
        text_list_column("summary", "o.summary"),
        number_list_column("changes", "o.changes"),
        flag_list_column(
            "stands",
            "coalesce((SELECT u.kind FROM operation u WHERE u.target = o.id ORDER BY u.id DESC LIMIT 1), '') <> 'undo'",
        ),
    ],
    from: "operation o",
    order: "o.id DESC",
};

/// A condition on a column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ColumnCondition {
    /// The text matches a pattern with `*`; case and accents do not count.
    Like(String),
    /// The number lies between two bounds, inclusive.
    Between(f64, f64),
    /// The flag has this value.
    Is(bool),
    /// The column names this row.
    Row(i64),
    /// The column is empty.
    Nothing,
}

/// A request: conditions, order and page.
#[derive(Debug, Default)]
pub(crate) struct ListRequest {
    /// Columns and their conditions.
    pub(crate) tests: Vec<(usize, ColumnCondition)>,
    /// The column to sort by, and whether the greatest value comes first.
    pub(crate) sort: Option<(usize, bool)>,
    pub(crate) limit: Option<usize>,
    pub(crate) offset: usize,
}

impl ListColumn {
    fn filter_expression(&self) -> &'static str {
        match self.holds {
            ListColumnContent::Json(text) | ListColumnContent::Notation(text) => text,
            _ => self.sql,
        }
    }
}

/// Returns the number of rows that meet the conditions, and the requested ones.
pub(crate) fn query_list_rows(
    connection: &Connection,
    table: &ListTable,
    wanted: &ListRequest,
) -> CorpusResult<(u64, Vec<Map<String, Value>>)> {
    add_functions(connection)?;
    let mut values: Vec<Box<dyn ToSql>> = Vec::new();
    // A list without conditions then needs no clause of its own.
    let mut tests = vec!["TRUE".to_owned()];
    for (column, test) in &wanted.tests {
        tests.push(test_sql(&table.columns[*column], test, &mut values));
    }
    let (from, tests) = (table.from, tests.join(" AND "));
    let parameters = || rusqlite::params_from_iter(values.iter());
    let total: i64 = connection.query_row(
        &format!("SELECT count(*) FROM {from} WHERE {tests}"),
        parameters(),
        |row| row.get(0),
    )?;
    let columns: Vec<&str> = table.columns.iter().map(|column| column.sql).collect();
    let sort = wanted.sort.map(|(column, down)| sort_sql(&table.columns[column], down));
    let sql = format!(
        "SELECT {} FROM {from} WHERE {tests} ORDER BY {}{} LIMIT {} OFFSET {}",
        columns.join(", "),
        // The default order follows, so that rows with equal values always come in the same order.
        sort.unwrap_or_default(),
        table.order,
        wanted
            .limit
            // SQLite takes a negative limit for none.
            .map_or(-1, |limit| i64::try_from(limit).unwrap_or(i64::MAX)),
        i64::try_from(wanted.offset).unwrap_or(i64::MAX),
    );
    let mut statement = connection.prepare(&sql)?;
    let rows = statement
        .query_map(parameters(), |row| {
            let mut map = Map::new();
            for (at, column) in table.columns.iter().enumerate() {
                map.insert(column.name.to_owned(), list_cell_value(row.get_ref(at)?, column.holds));
            }
            Ok(map)
        })?
        .collect::<rusqlite::Result<_>>()?;
    Ok((u64::try_from(total).unwrap_or_default(), rows))
}

fn test_sql(column: &ListColumn, test: &ColumnCondition, values: &mut Vec<Box<dyn ToSql>>) -> String {
    let (row, column) = (column.row.unwrap_or(column.sql), column.filter_expression());
    let mut put = |value: Box<dyn ToSql>| {
        values.push(value);
        values.len()
    };
    match test {
        ColumnCondition::Like(pattern) => {
            // The LIKE of SQLite knows neither accents nor case beyond ASCII.
            format!("chereme_fits(?{}, {column})", put(Box::new(pattern.clone())))
        }
        ColumnCondition::Between(least, most) => {
            let (least, most) = (put(Box::new(*least)), put(Box::new(*most)));
            format!("({column}) BETWEEN ?{least} AND ?{most}")
        }
        ColumnCondition::Is(wanted) => format!("({column}) = ?{}", put(Box::new(*wanted))),
        ColumnCondition::Row(wanted) => format!("{row} = ?{}", put(Box::new(*wanted))),
        // An empty text counts as missing, too.
        ColumnCondition::Nothing => format!("coalesce({column}, '') = ''"),
    }
}

fn sort_sql(column: &ListColumn, down: bool) -> String {
    let direction = if down { "DESC" } else { "ASC" };
    let sql = column.filter_expression();
    match column.holds {
        ListColumnContent::Text | ListColumnContent::Json(_) => {
            // Equal folded texts are put in order by the texts themselves, for a stable order.
            format!("chereme_folded({sql}) {direction} NULLS LAST, {sql} {direction}, ")
        }
        _ => format!("{sql} {direction} NULLS LAST, "),
    }
}

fn list_cell_value(value: ValueRef<'_>, holds: ListColumnContent) -> Value {
    match (value, holds) {
        (ValueRef::Integer(number), ListColumnContent::Flag) => Value::from(number != 0),
        (ValueRef::Integer(number), _) => Value::from(number),
        (ValueRef::Real(number), _) => Value::from(number),
        // A damaged cell must not keep the whole list from being shown.
        (ValueRef::Text(text), ListColumnContent::Json(_)) => serde_json::from_slice(text).unwrap_or(Value::Null),
        (ValueRef::Text(text), _) => Value::from(String::from_utf8_lossy(text)),
        _ => Value::Null,
    }
}

fn add_functions(connection: &Connection) -> CorpusResult<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC | FunctionFlags::SQLITE_DIRECTONLY;
    connection.create_scalar_function("chereme_fits", 2, flags, |context| {
        // The pattern is the same for all rows, so it is parsed once per statement.
        let pattern = context.get_or_create_aux(0, |text| text.as_str().map(TextPattern::from_glob))?;
        Ok(match context.get_raw(1) {
            ValueRef::Text(text) => pattern.matches_text(&String::from_utf8_lossy(text)),
            _ => false,
        })
    })?;
    connection.create_scalar_function("chereme_folded", 1, flags, |context| {
        Ok(match context.get_raw(0) {
            ValueRef::Text(text) => Some(fold_text(&String::from_utf8_lossy(text))),
            _ => None,
        })
    })?;
    Ok(())
}

/// Returns every token, oldest first.
pub(crate) fn token_ids(connection: &Connection) -> CorpusResult<Vec<i64>> {
    query_row_ids(connection, "SELECT id FROM token ORDER BY id", [])
}

/// Returns the tokens of a signer, by recording and time: those on tiers for that participant, and those in the
/// signer's recordings on tiers without a participant who is a signer.
pub(crate) fn token_ids_of_signer(connection: &Connection, signer: i64) -> CorpusResult<Vec<i64>> {
    let sql = "SELECT t.id FROM token t JOIN recording r ON r.id = t.recording_id
               LEFT JOIN annotation a ON a.id = t.annotation_id LEFT JOIN tier i ON i.id = a.tier_id
               LEFT JOIN signer p ON p.name = i.participant
               WHERE coalesce(p.id, r.signer_id) = ?1 ORDER BY r.id, t.start_us, t.id";
    query_row_ids(connection, sql, [signer])
}

fn query_row_ids(connection: &Connection, sql: &str, params: impl rusqlite::Params) -> CorpusResult<Vec<i64>> {
    connection.read_values(sql, params)
}

/// Returns the time of the newest operation.
pub(crate) fn last_change(connection: &Connection) -> CorpusResult<Option<String>> {
    connection.find_value("SELECT at FROM operation ORDER BY id DESC LIMIT 1", [])
}
