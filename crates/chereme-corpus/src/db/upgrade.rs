//! The parts of schema upgrades that SQL alone cannot do: rows that a step sets aside become rows of another table,
//! also in the history.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use rusqlite::config::DbConfig;
use rusqlite::{Connection, params};
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use super::lexicons;
use super::stored_history;
use super::stored_motion::to_hex_text;
use crate::error::CorpusResult;
use crate::words::old_effect::effect_of_summary;

/// The name of tracks that hold the scalar curves of generated movement.
pub(crate) const NONMANUALS_TRACK_NAME: &str = "nonmanuals";

/// Completes a schema step with the work that its SQL left to the program, if there is any.
pub(super) fn after_step(connection: &Connection) -> CorpusResult<()> {
    let left: i64 = connection.query_row(
        "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = 'old_curve'",
        [],
        |row| row.get(0),
    )?;
    if left > 0 {
        curves_become_tracks(connection)?;
        connection.execute_batch("DROP TABLE old_curve; DROP TABLE old_curve_block;")?;
    }
    Ok(())
}

/// Reads the summaries of operations that an older program stored without their effects.
pub(super) fn read_old_summaries(connection: &Connection) -> CorpusResult<()> {
    let mut statement = connection.prepare("SELECT id, name, summary FROM operation")?;
    let rows = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?
        .collect::<rusqlite::Result<Vec<(i64, String, String)>>>()?;
    for (id, name, summary) in rows {
        if let Some(effect) = effect_of_summary(&name, &summary) {
            let (_, _, json) = effect.stored_texts();
            connection.execute("UPDATE operation SET effect = ?2 WHERE id = ?1", params![id, json])?;
        }
    }
    Ok(())
}

/// Makes each imported table of an older file a lexicon, to which the signs belong that it alone has; signs of several
/// tables belong to none. The recordings of a file with one table are linked to it.
pub(super) fn give_signs_lexicons(connection: &Connection) -> CorpusResult<()> {
    let mut tables_of_signs: BTreeMap<i64, BTreeSet<String>> = BTreeMap::new();
    // An older file names the table in each token alone; cells of a row show that it came from one.
    let sql = "SELECT DISTINCT sign_id, coalesce(source ->> '$.path', source ->> '$.file') AS place FROM token
         WHERE origin = 'lexicon' AND source ->> '$.cells' IS NOT NULL AND place IS NOT NULL";
    let mut statement = connection.prepare(sql)?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        tables_of_signs.entry(row.get(0)?).or_default().insert(row.get(1)?);
    }
    let tables: BTreeSet<String> = tables_of_signs.values().flatten().cloned().collect();
    let mut lexicons: BTreeMap<String, i64> = BTreeMap::new();
    for table in tables {
        let stem = Path::new(&table)
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let name = lexicons::free_lexicon_name(connection, &stem)?;
        let lexicon = lexicons::insert_lexicon(connection, &name)?;
        connection.execute(
            "UPDATE source_file SET lexicon_id = ?1 WHERE kind = 'lexicon' AND coalesce(path, name) = ?2",
            params![lexicon, table],
        )?;
        lexicons.insert(table, lexicon);
    }
    if lexicons.len() > 1 {
        // The first one was the only one for a moment.
        connection.execute("UPDATE recording SET lexicon_id = NULL", [])?;
    }
    for (sign, tables) in &tables_of_signs {
        if let [table] = tables.iter().collect::<Vec<_>>().as_slice() {
            let sql = "UPDATE sign SET lexicon_id = ?2 WHERE id = ?1";
            connection.execute(sql, params![sign, lexicons.get(*table)])?;
        }
    }
    Ok(())
}

/// Columns of JSON that may be empty.
const MISSING_JSON: [&str; 6] = ["roles", "channel_groups", "layout", "source", "consent", "mapping"];

/// Rewrites the rules of columns that may be empty: for SQLite before 3.45 `json_valid` of nothing is false, so that its
/// `integrity_check` would find each such row broken.
pub(super) fn rewrite_json_rules(connection: &Connection) -> CorpusResult<()> {
    // The defensive mode of this connection forbids writing to the schema, also to the program itself.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, false)?;
    connection.pragma_update(None, "writable_schema", true)?;
    let rewritten = MISSING_JSON.iter().try_for_each(|column| {
        // The text of the rule must be the one in the schema steps, letter by letter.
        let rule = format!("TEXT CHECK (json_valid({column}))");
        let other = format!("TEXT CHECK ({column} IS NULL OR json_valid({column}))");
        let sql = "UPDATE sqlite_schema SET sql = replace(sql, ?1, ?2) WHERE type = 'table'";
        connection.execute(sql, [rule, other]).map(|_| ())
    });
    connection.pragma_update(None, "writable_schema", false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    Ok(rewritten?)
}

/// The first version whose imports make a value of a table the initial one beside a final one.
pub(super) const PHASED_SINCE: i32 = 12;

/// Gives values without a phase in rows of imported tables the phase that imports give them since
/// [`PHASED_SINCE`], also in the history.
pub(super) fn begin_before_final(connection: &Connection) -> CorpusResult<()> {
    // A value of one step without a phase begins a change whose end the table states.
    let sql = "SELECT own.id, own.token_id FROM token_value own JOIN token ON token.id = own.token_id
         WHERE own.phase IS NULL AND own.annotation_id IS NULL AND token.origin = 'lexicon'
             AND instr(token.source, '\"cells\":')
             AND (SELECT max(other.phase = 'final') AND NOT max(other.phase = 'initial')
                  FROM token_value other WHERE other.token_id = own.token_id AND other.hand IS own.hand
                      AND other.component = own.component AND other.feature IS own.feature)";
    let begun = connection
        .prepare(sql)?
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?
        .collect::<rusqlite::Result<BTreeMap<i64, i64>>>()?;
    if begun.is_empty() {
        return Ok(());
    }
    for id in begun.keys() {
        connection.execute("UPDATE token_value SET phase = 'initial' WHERE id = ?1", [id])?;
    }
    // Numbers of rows are used again after a deletion, so that the token must agree, too.
    let begin = |image: &mut Value| {
        let number = |name: &str| image[name].as_i64().unwrap_or_default();
        let is_begun = begun.get(&number("id")) == Some(&number("token_id"));
        if is_begun && image["phase"].is_null() {
            image["phase"] = json!("initial");
        }
    };
    for (operation, part) in stored_history::list_changeset_parts(connection)? {
        let text = stored_history::read_part(connection, operation, part)?;
        let lines = text.lines().map(|line| {
            // Parsing is slow; a look at the text leaves out almost every line of a long history.
            let phaseless = line.starts_with("[\"token_value\"") && line.contains("\"phase\":null");
            match phaseless.then(|| ChangesetLine::parse_changeset_line(line)).flatten() {
                Some(mut change) => {
                    begin(&mut change.before);
                    begin(&mut change.after);
                    change.write_changeset_line()
                }
                None => format!("{line}\n"),
            }
        });
        let lines: String = lines.collect();
        if lines != text {
            stored_history::replace_part(connection, operation, part, &lines, 0)?;
        }
    }
    Ok(())
}

/// Converts scalar curves to tracks. Up to version 4 they were rows next to a skeleton's track; now they are a track of
/// their own on the same frames. Changesets refer to rows by id, so the same mapping of ids serves the rows and the
/// history.
fn curves_become_tracks(connection: &Connection) -> CorpusResult<()> {
    let parts = stored_history::list_changeset_parts(connection)?;
    let mut largest = LargestTrackIds::of_rows(connection)?;
    let mut any = largest.curves > 0;
    // Deleted rows keep their numbers in the history, and an undo brings them back under these.
    for (operation, part) in &parts {
        for line in stored_history::read_part(connection, *operation, *part)?.lines() {
            any |= line.starts_with("[\"curve");
            largest.note_changeset_line(line);
        }
    }
    if !any {
        return Ok(());
    }
    let moved = CurveIdOffsets {
        track: largest.track,
        block: largest.block,
    };
    moved.move_curve_rows(connection)?;
    let mut curve_tracks = BTreeMap::new();
    for (operation, part) in parts {
        let text = stored_history::read_part(connection, operation, part)?;
        let (lines, added) = moved.convert_changeset_lines(&text, &mut curve_tracks);
        if lines != text {
            stored_history::replace_part(connection, operation, part, &lines, added)?;
        }
    }
    Ok(())
}

/// The largest ids that tracks and their blocks have ever had.
struct LargestTrackIds {
    track: i64,
    block: i64,
    curves: i64,
}

impl LargestTrackIds {
    fn of_rows(connection: &Connection) -> CorpusResult<Self> {
        Ok(connection.query_row(
            "SELECT coalesce((SELECT max(id) FROM track), 0),
                    coalesce((SELECT max(id) FROM track_block), 0),
                    (SELECT count(*) FROM old_curve)",
            [],
            |row| {
                Ok(Self {
                    track: row.get(0)?,
                    block: row.get(1)?,
                    curves: row.get(2)?,
                })
            },
        )?)
    }

    fn note_changeset_line(&mut self, line: &str) {
        let largest = match () {
            () if line.starts_with("[\"track\"") => &mut self.track,
            () if line.starts_with("[\"track_block\"") => &mut self.block,
            () => return,
        };
        if let Some(change) = ChangesetLine::parse_changeset_line(line) {
            *largest = (*largest).max(change.changed_row_id());
        }
    }
}

/// A line of a changeset.
struct ChangesetLine {
    table: String,
    kind: String,
    before: Value,
    after: Value,
    refs: Value,
}

impl ChangesetLine {
    fn parse_changeset_line(line: &str) -> Option<Self> {
        let (table, kind, before, after, refs) = serde_json::from_str(line).ok()?;
        Some(Self {
            table,
            kind,
            before,
            after,
            refs,
        })
    }

    fn latest_row_value(&self) -> &Value {
        if self.after.is_null() {
            &self.before
        } else {
            &self.after
        }
    }

    fn changed_row_id(&self) -> i64 {
        self.latest_row_value()["id"].as_i64().unwrap_or_default()
    }

    fn write_changeset_line(&self) -> String {
        let Self {
            table,
            kind,
            before,
            after,
            refs,
        } = self;
        format!("{}\n", json!([table, kind, before, after, refs]))
    }
}

/// The latest state of each skeleton track in the history, with the uids that it refers to.
type KnownTrackStates = BTreeMap<i64, (Value, Value)>;

/// Offsets that are added to ids: a curve track has the id of the skeleton's track plus `track`.
struct CurveIdOffsets {
    track: i64,
    block: i64,
}

impl CurveIdOffsets {
    fn move_curve_rows(&self, connection: &Connection) -> CorpusResult<()> {
        let mut statement = connection.prepare(
            "SELECT json_object('id', id, 'uid', hex(uid), 'recording_id', recording_id,
                 'offset_us', offset_us, 'frames', frames, 'rate_frames', rate_frames,
                 'rate_seconds', rate_seconds)
             FROM track WHERE id IN (SELECT track_id FROM old_curve)",
        )?;
        let images = statement
            .query_map([], |row| row.get::<_, String>(0))?
            .collect::<rusqlite::Result<Vec<_>>>()?;
        for image in images {
            let image = serde_json::from_str(&image).unwrap_or_default();
            connection.execute(
                "INSERT INTO track (id, uid, recording_id, kind, name, offset_us, duration_us, frames,
                     rate_frames, rate_seconds)
                 SELECT ?1 ->> 'id', unhex(?1 ->> 'uid'), ?1 ->> 'recording_id', ?1 ->> 'kind',
                     ?1 ->> 'name', ?1 ->> 'offset_us', ?1 ->> 'duration_us', ?1 ->> 'frames',
                     ?1 ->> 'rate_frames', ?1 ->> 'rate_seconds'",
                [self.track_image(&image).to_string()],
            )?;
        }
        connection.execute(
            "INSERT INTO channel (id, uid, track_id, position, channel_group, name)
             SELECT id, uid, track_id + ?1, position, 'curves', name FROM old_curve",
            [self.track],
        )?;
        connection.execute(
            "INSERT INTO track_block (id, track_id, channel_group, first_frame, frames, hash)
             SELECT id + ?2, track_id + ?1, 'curves', first_frame, frames, hash FROM old_curve_block",
            params![self.track, self.block],
        )?;
        Ok(())
    }

    /// Returns the row of the curve track for the row of a skeleton track.
    fn track_image(&self, skeleton: &Value) -> Value {
        let number = |name: &str| skeleton[name].as_i64().unwrap_or_default();
        let uid = skeleton["uid"].as_str().unwrap_or_default();
        // Frames times microseconds may exceed 64 bits; twice the rate rounds to the nearest.
        let duration = number("frames") as i128 * 1_000_000 * i128::from(number("rate_seconds"));
        let rate = i128::from(number("rate_frames").max(1));
        let duration = (duration * 2 + rate).div_euclid(rate * 2);
        let mut image = Map::new();
        for column in [
            "skeleton_id",
            "frame_time",
            "metres_per_unit",
            "axes",
            "root_order",
            "root_scale",
            "roles",
            "channel_groups",
            "layout",
            "media_url",
            "media_type",
        ] {
            image.insert(column.to_owned(), Value::Null);
        }
        image.insert("id".into(), json!(number("id") + self.track));
        image.insert("uid".into(), json!(curves_uid(uid)));
        image.insert("kind".into(), json!("curves"));
        image.insert("name".into(), json!(NONMANUALS_TRACK_NAME));
        image.insert("duration_us".into(), json!(duration as i64));
        for column in ["recording_id", "offset_us", "frames", "rate_frames", "rate_seconds"] {
            image.insert(column.into(), json!(number(column)));
        }
        Value::Object(image)
    }

    /// Returns the lines of a changeset in the new format, and the number of added lines.
    fn convert_changeset_lines(&self, text: &str, known: &mut KnownTrackStates) -> (String, i64) {
        let (mut lines, mut added) = (String::with_capacity(text.len()), 0);
        for line in text.lines() {
            let of_tracks = ["[\"track\"", "[\"curve\"", "[\"curve_block\""];
            let change = of_tracks
                .iter()
                .any(|start| line.starts_with(start))
                .then(|| ChangesetLine::parse_changeset_line(line))
                .flatten();
            match change {
                Some(change) if change.table == "track" => {
                    let row = (change.latest_row_value().clone(), change.refs.clone());
                    known.insert(change.changed_row_id(), row);
                    lines.push_str(line);
                    lines.push('\n');
                }
                Some(change) => {
                    // Position 0 is the first curve of a track, which stands for the new track itself.
                    let first = change.latest_row_value()["position"] == json!(0);
                    let skeleton = change.latest_row_value()["track_id"].as_i64().unwrap_or_default();
                    // The history names curves alone, so that their track needs a change of its own before
                    // theirs.
                    if let Some((row, refs)) = known.get(&skeleton).filter(|_| first) {
                        lines.push_str(&self.track_change(&change, row, refs).write_changeset_line());
                        added += 1;
                    }
                    lines.push_str(&self.row_change(change).write_changeset_line());
                }
                None => {
                    lines.push_str(line);
                    lines.push('\n');
                }
            }
        }
        (lines, added)
    }

    /// Returns the change of the curve track that accompanies the change of its first curve.
    fn track_change(&self, curve: &ChangesetLine, skeleton: &Value, refs: &Value) -> ChangesetLine {
        let image = |of: &Value| match of {
            Value::Null => Value::Null,
            _ => self.track_image(skeleton),
        };
        ChangesetLine {
            table: "track".into(),
            kind: curve.kind.clone(),
            before: image(&curve.before),
            after: image(&curve.after),
            refs: json!({ "recording_id": refs["recording_id"], "skeleton_id": null }),
        }
    }

    fn row_change(&self, change: ChangesetLine) -> ChangesetLine {
        let curve = change.table == "curve";
        let image = |old: Value| {
            let Value::Object(mut row) = old else {
                return old;
            };
            let moved = |row: &Map<String, Value>, name: &str, by: i64| {
                json!(row.get(name).and_then(Value::as_i64).unwrap_or_default() + by)
            };
            row.insert("track_id".into(), moved(&row, "track_id", self.track));
            row.insert("channel_group".into(), json!("curves"));
            if curve {
                row.insert("part".into(), json!(""));
                row.insert("unit".into(), json!(""));
                row.insert("columns".into(), json!(1));
            } else {
                row.insert("id".into(), moved(&row, "id", self.block));
            }
            Value::Object(row)
        };
        let uid = change.refs["track_id"].as_str().unwrap_or_default();
        ChangesetLine {
            table: if curve { "channel" } else { "track_block" }.into(),
            kind: change.kind,
            refs: json!({ "track_id": curves_uid(uid) }),
            before: image(change.before),
            after: image(change.after),
        }
    }
}

/// Returns the uid of the curve track for that of the skeleton track, in hexadecimal.
fn curves_uid(skeleton: &str) -> String {
    // The uid follows from the skeleton's, so that copies of a corpus upgrade to equal rows.
    let digest = Sha256::digest(format!("{NONMANUALS_TRACK_NAME} {skeleton}").as_bytes());
    to_hex_text(&digest[..16]).to_uppercase()
}

/// Makes opinions of the values that an earlier program took from proposals of detectors, also in the history.
pub(super) fn set_proposals_apart(connection: &Connection) -> CorpusResult<()> {
    let sql = "SELECT own.annotation_id FROM annotation JOIN token_value own ON own.annotation_id = annotation.id
         WHERE annotation.origin = 'detector' AND own.state <> 'unset'";
    let mut statement = connection.prepare(sql)?;
    let proposals = statement
        .query_map([], |row| row.get(0))?
        .collect::<rusqlite::Result<BTreeSet<i64>>>()?;
    if proposals.is_empty() {
        return Ok(());
    }
    let transaction = super::stored_search::begin_write_transaction(connection)?;
    for id in &proposals {
        connection.execute(
            "UPDATE token_value SET state = 'unset', value = NULL WHERE annotation_id = ?1",
            [id],
        )?;
    }
    let set_apart = |image: &mut Value| {
        if image["annotation_id"]
            .as_i64()
            .is_some_and(|id| proposals.contains(&id))
        {
            (image["state"], image["value"]) = (json!("unset"), Value::Null);
        }
    };
    for (operation, part) in stored_history::list_changeset_parts(connection)? {
        // An undo would otherwise bring a proposal back as a value that counts.
        let text = stored_history::read_part(connection, operation, part)?;
        let lines = text.lines().map(|line| {
            let of_values = line.starts_with("[\"token_value\"");
            match of_values.then(|| ChangesetLine::parse_changeset_line(line)).flatten() {
                Some(mut change) => {
                    set_apart(&mut change.before);
                    set_apart(&mut change.after);
                    change.write_changeset_line()
                }
                None => format!("{line}\n"),
            }
        });
        let lines: String = lines.collect();
        if lines != text {
            stored_history::replace_part(connection, operation, part, &lines, 0)?;
        }
    }
    super::seals::seal_tables(connection, ["token_value", "changeset"])?;
    Ok(transaction.commit()?)
}
