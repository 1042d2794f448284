//! Creates, opens and upgrades corpus files.

use std::fs;
use std::io::{ErrorKind, Read as _};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use chereme_sign::{ErrorRemedy, RemedyChoice};
use rusqlite::config::DbConfig;
use rusqlite::limits::Limit;
use rusqlite::{Connection, ErrorCode, OpenFlags};

use super::stored_search::SearchIndexState;
use super::unfinished::{UnfinishedFile, remove_leftovers};
use super::{damaged_row_error, seals, stale_log, stored_roles, upgrade};
use crate::error::{CorpusError, CorpusResult};

/// Marks the file as a corpus: the letters `Cher`.
const APPLICATION_ID: i32 = i32::from_be_bytes(*b"Cher");

/// The steps of the schema; a file's `user_version` is the number of steps that it has taken.
const SCHEMA_STEPS_SQL: [&str; 18] = [
    chereme_data::schema_text("sql/0001_corpus.sql"),
    chereme_data::schema_text("sql/0002_notation.sql"),
    chereme_data::schema_text("sql/0003_kept_search.sql"),
    chereme_data::schema_text("sql/0004_curves.sql"),
    chereme_data::schema_text("sql/0005_files.sql"),
    chereme_data::schema_text("sql/0006_attributes.sql"),
    chereme_data::schema_text("sql/0007_tracks.sql"),
    chereme_data::schema_text("sql/0008_clock.sql"),
    chereme_data::schema_text("sql/0009_tier_roles.sql"),
    chereme_data::schema_text("sql/0010_studies.sql"),
    chereme_data::schema_text("sql/0011_consent.sql"),
    chereme_data::schema_text("sql/0012_checksums.sql"),
    chereme_data::schema_text("sql/0013_effect.sql"),
    chereme_data::schema_text("sql/0014_lexicon.sql"),
    chereme_data::schema_text("sql/0015_people.sql"),
    chereme_data::schema_text("sql/0016_entries.sql"),
    chereme_data::schema_text("sql/0017_standings.sql"),
    chereme_data::schema_text("sql/0018_relations.sql"),
];

/// The first version whose operations hold their effects, and not only a summary.
const EFFECTS_STORED_FROM: i32 = 13;

/// The first version whose signs belong to lexicons.
const LEXICONS_SINCE: i32 = 14;

/// The schema version that this code writes.
pub(crate) const SCHEMA_VERSION: i32 = SCHEMA_STEPS_SQL.len() as i32;

/// The size of the largest value that is read, in bytes: all blocks, changeset parts and index files are far smaller.
const LARGEST_VALUE: i32 = 512 << 20;

/// Creates the file; `fill` writes the initial content of every corpus.
///
/// The file is created under another name beside `path` and renamed when it is complete, so that at any moment there is
/// a whole corpus at `path` or nothing.
pub(super) fn create_corpus_file(
    path: &Path,
    fill: impl FnOnce(&Connection) -> CorpusResult<()>,
) -> CorpusResult<Connection> {
    if path.exists() {
        return Err(CorpusError::from_file_failure(path, ErrorKind::AlreadyExists.into()));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        return Err(CorpusError::from_file_failure(folder, ErrorKind::NotFound.into()));
    }
    // A program that was ended while it created a corpus here left its unfinished file behind.
    remove_leftovers(path);
    let making =
        UnfinishedFile::create_unfinished_file(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    // The temporary name says nothing to the caller.
    make_database_file(making.unfinished_path(), fill).map_err(|error| error.of_file(path))?;
    give_file_final_name(&making, path)?;
    drop(making);
    Ok(open_corpus_file(path)?.0)
}

/// Writes all data of `connection` to a new corpus file at `path`, whole or not at all; works even if the file of
/// `connection` was deleted from its folder.
pub(super) fn copy_corpus_file(connection: &Connection, path: &Path) -> CorpusResult<()> {
    if path.exists() {
        return Err(CorpusError::from_file_failure(path, ErrorKind::AlreadyExists.into()));
    }
    let making =
        UnfinishedFile::create_unfinished_file(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    super::dump::copy_database_compactly(connection, making.unfinished_path())?;
    let copy = Connection::open(making.unfinished_path())?;
    // The compact copy does not take over the journal mode of the original.
    copy.pragma_update(None, "journal_mode", "WAL")?;
    copy.close().map_err(|(_, error)| error)?;
    give_file_final_name(&making, path)
}

fn make_database_file(path: &Path, fill: impl FnOnce(&Connection) -> CorpusResult<()>) -> CorpusResult<()> {
    let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let mut connection = Connection::open_with_flags(path, flags)?;
    // The size of pages can be set only before the first table exists.
    connection.execute_batch("PRAGMA page_size = 16384; PRAGMA journal_mode = WAL;")?;
    configure_connection(&mut connection)?;
    connection.pragma_update(None, "application_id", APPLICATION_ID)?;
    raise_schema_version(&mut connection, fill)?;
    connection.close().map_err(|(_, error)| error)?;
    Ok(())
}

/// Gives a complete file its final name if that is free: a link never replaces an existing file.
fn give_file_final_name(making: &UnfinishedFile, path: &Path) -> CorpusResult<()> {
    let published = match fs::hard_link(making.unfinished_path(), path) {
        // Some file systems do not support links.
        Err(error) if error.kind() != ErrorKind::AlreadyExists && !path.exists() => making.rename_unfinished(path),
        other => other,
    };
    published.map_err(|error| CorpusError::from_file_failure(path, error))
}

/// Returns the remedy for a file that is no corpus.
fn choose_corpus_remedy() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::OtherCorpus,
        "choose a file that `chereme new` or `chereme import` made",
    )
}

/// Returns the reason why a file cannot be a complete corpus, judged by its size, and a remedy.
fn outwardly_wrong(path: &Path) -> CorpusResult<Option<(String, ErrorRemedy)>> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    let data = match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let remedy = ErrorRemedy::choice_remedy(
                RemedyChoice::OtherCorpus,
                "check the spelling of the path; `chereme new` makes an empty corpus",
            );
            return Ok(Some(("there is nothing of this name".to_owned(), remedy)));
        }
        other => other.map_err(fault)?,
    };
    if !data.is_file() {
        return Ok(Some(("it is a folder or a device".to_owned(), choose_corpus_remedy())));
    }
    if data.len() == 0 {
        return Ok(Some(("it is empty".to_owned(), choose_corpus_remedy())));
    }
    Ok(None)
}

/// Returns by how much a database is shorter than it says, as a reason to refuse it.
///
/// Only a file that SQLite cannot read is looked at: when a process closes a file that it has opened beside SQLite, it loses
/// the locks of its connections, and other programs then take their log away (<https://www.sqlite.org/howtocorrupt.html>,
/// 2.2).
fn cut_short_reason(path: &Path) -> CorpusResult<Option<String>> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    let length = fs::metadata(path).map_err(fault)?.len();
    let mut head = [0; 100];
    let mut file = fs::File::open(path).map_err(fault)?;
    let is_sqlite = file.read_exact(&mut head).is_ok() && head.starts_with(b"SQLite format 3\0");
    let word = |at: usize| u64::from(u32::from_be_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]));
    // <https://www.sqlite.org/fileformat2.html>, 1.3: the count of pages holds where both words agree; a
    // checkpoint that was cut short has yet to write them, from a log that is still there.
    let page = match u64::from(u16::from_be_bytes([head[16], head[17]])) {
        1 => 65536,
        size => size,
    };
    let size = page * word(28);
    let logged = fs::metadata(stale_log::companion_path(path, "-wal")).is_ok_and(|log| log.len() > 0);
    let is_cut_short = is_sqlite && !logged && word(24) == word(92) && length < size;
    Ok(is_cut_short.then(|| format!("it is cut short: {length} bytes are there of {size}")))
}

/// Opens the database; if nothing may be written beside it, as an immutable file.
fn connect(path: &Path) -> CorpusResult<Connection> {
    let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags)?;
    // SQLite touches the file at the first read only, so opening alone does not show that writing beside it
    // fails.
    let read = connection.pragma_query_value(None, "schema_version", |row| row.get::<_, i32>(0));
    let shut = |code| matches!(code, ErrorCode::ReadOnly | ErrorCode::CannotOpen);
    match read {
        Err(error) if error.sqlite_error_code().is_some_and(shut) => {
            let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX | OpenFlags::SQLITE_OPEN_URI;
            Ok(Connection::open_with_flags(immutable_file_uri(path), flags)?)
        }
        _ => Ok(connection),
    }
}

/// Returns the URI of an immutable file, see <https://www.sqlite.org/uri.html>.
fn immutable_file_uri(path: &Path) -> String {
    let path_text = path.to_string_lossy();
    let mut name = if cfg!(windows) {
        path_text.replace('\\', "/")
    } else {
        path_text.into_owned()
    };
    // The percent sign is first, or it would encode the other codes again.
    for (letter, code) in [("%", "%25"), ("?", "%3f"), ("#", "%23")] {
        name = name.replace(letter, code);
    }
    let root = if cfg!(windows) && path.is_absolute() { "/" } else { "" };
    format!("file:{root}{name}?immutable=1")
}

/// The upgrade of a file of an older version, which happens when it is opened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SchemaUpgrade {
    /// The version of the schema before.
    pub from: i32,
    /// The version of the schema now.
    pub to: i32,
    /// The copy of the file as it was, beside it.
    pub kept: PathBuf,
}

/// Opens the file; one of an older version is copied beside itself, and upgraded.
pub(super) fn open_corpus_file(path: &Path) -> CorpusResult<(Connection, Option<SchemaUpgrade>)> {
    remove_leftovers(path);
    let (mut connection, from) = open_checked_connection(path)?;
    let mut upgrade = None;
    if from < SCHEMA_VERSION {
        // The copy is made before the upgrade, since an older program cannot open the file afterwards.
        let kept = copy_beside(&connection, path, &format!("version-{from}"))?;
        raise_schema_version(&mut connection, |_| Ok(())).map_err(|error| error.of_file(path))?;
        upgrade = Some(SchemaUpgrade {
            from,
            to: SCHEMA_VERSION,
            kept,
        });
    }
    finish_opened_file(&connection, path)?;
    Ok((connection, upgrade))
}

/// Opens somebody else's file, which stays as it is: one of an older version is copied beside the file `own`, and the
/// copy is upgraded; it is removed with the second value.
pub(super) fn open_unchanged(path: &Path, own: &Path) -> CorpusResult<(Connection, Option<UnfinishedFile>)> {
    let (connection, version) = open_checked_connection(path)?;
    if version >= SCHEMA_VERSION {
        finish_opened_file(&connection, path)?;
        return Ok((connection, None));
    }
    let making =
        UnfinishedFile::create_unfinished_file(own).map_err(|error| CorpusError::from_file_failure(own, error))?;
    super::dump::copy_database_compactly(&connection, making.unfinished_path()).map_err(|error| error.of_file(own))?;
    drop(connection);
    let mut copy = connect(making.unfinished_path())?;
    configure_connection(&mut copy)?;
    raise_schema_version(&mut copy, |_| Ok(()))?;
    finish_opened_file(&copy, path)?;
    Ok((copy, Some(making)))
}

/// Copies a file beside itself, under a free name with a mark such as `version-3`, and returns that.
pub(super) fn copy_beside(connection: &Connection, path: &Path, mark: &str) -> CorpusResult<PathBuf> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().map(|suffix| suffix.to_string_lossy());
    let ending = extension.map_or(String::new(), |suffix| format!(".{suffix}"));
    let mut kept = path.with_file_name(format!("{stem}.{mark}{ending}"));
    // The file without a number counts as the first.
    let mut count = 1;
    while kept.exists() {
        count += 1;
        kept = path.with_file_name(format!("{stem}.{mark} ({count}){ending}"));
    }
    copy_corpus_file(connection, &kept).map_err(|error| error.of_file(path))?;
    Ok(kept)
}

/// Returns the connection to a file and the version of its schema; refuses a file that is no corpus, or that a newer
/// program wrote.
fn open_checked_connection(path: &Path) -> CorpusResult<(Connection, i32)> {
    let refuse = |reason: String, remedy: ErrorRemedy| CorpusError::NotACorpus {
        path: path.to_owned(),
        reason,
        remedy,
    };
    if let Some((reason, remedy)) = outwardly_wrong(path)? {
        return Err(refuse(reason, remedy));
    }
    // A log of another file would be read into this one as soon as it is opened.
    stale_log::set_aside(path, &immutable_file_uri(path))?;
    let mut connection = connect(path)?;
    let configured = configure_connection(&mut connection);
    let pragma = |name: &str| connection.pragma_query_value(None, name, |row| row.get::<_, i32>(0));
    let application = configured
        .and_then(|()| Ok(pragma("application_id")?))
        .map_err(|error| {
            let code = match &error {
                CorpusError::Database(fault) => fault.sqlite_error_code(),
                _ => None,
            };
            match code {
                Some(ErrorCode::NotADatabase) => refuse("it is no database".into(), choose_corpus_remedy()),
                Some(ErrorCode::DatabaseCorrupt) if let Ok(Some(reason)) = cut_short_reason(path) => {
                    refuse(reason, "copy it again, or take it from a backup".into())
                }
                _ => error,
            }
        })?;
    if application != APPLICATION_ID {
        return Err(refuse(
            "it is a database of another program".into(),
            choose_corpus_remedy(),
        ));
    }
    let version = pragma("user_version")?;
    if version > SCHEMA_VERSION {
        return Err(refuse(
            format!("its schema is version {version}, and this program knows up to {SCHEMA_VERSION}"),
            "open it with a newer version of Chereme".into(),
        ));
    }
    // A version of 0 with rows is damage; without rows, the program ended before its first commit.
    if version < 1 && holds_rows(&connection)? {
        return Err(refuse(
            format!("its version number is wrong: it is {version}, and the file holds data"),
            "take the file from a backup; keep this one too, as its data are still in it".into(),
        ));
    }
    if version < 1 {
        return Err(refuse(
            "its making was cut short".into(),
            "delete it and create it again".into(),
        ));
    }
    // Triggers and views run when a stranger's file is merely read; those of the search index alone are ours.
    let foreign: i64 = connection.query_row(
        "SELECT count(*) FROM sqlite_schema WHERE type = 'view'
            OR (type = 'trigger' AND name NOT LIKE 'search\\_%' ESCAPE '\\')
            OR (type = 'table' AND sql LIKE 'CREATE VIRTUAL%')",
        [],
        |row| row.get(0),
    )?;
    if foreign > 0 {
        return Err(refuse(
            format!("it holds {foreign} views, triggers or virtual tables that Chereme did not create"),
            "take the file as untrusted: somebody has put code into it".into(),
        ));
    }
    Ok((connection, version))
}

/// Refuses a file of this version with roles of a newer program, and adds the roles that it lacks.
fn finish_opened_file(connection: &Connection, path: &Path) -> CorpusResult<()> {
    let unknown = stored_roles::find_unknown_roles(connection)?;
    if !unknown.is_empty() {
        return Err(CorpusError::NotACorpus {
            path: path.to_owned(),
            reason: format!(
                "its tiers may have roles that this program does not know: {}",
                unknown.join(", ")
            ),
            remedy: "open it with a newer version of Chereme".into(),
        });
    }
    if !connection.is_readonly("main")? {
        stored_roles::add_missing(connection)?;
    }
    Ok(())
}

/// Returns whether any table has a row.
fn holds_rows(connection: &Connection) -> CorpusResult<bool> {
    let sql = "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite\\_%' ESCAPE '\\'";
    let mut statement = connection.prepare(sql)?;
    let mut tables = statement.query([])?;
    while let Some(row) = tables.next()? {
        // The names come from the file, which may be a stranger's; doubled quotes keep them names.
        let table = row.get::<_, String>(0)?.replace('"', "\"\"");
        let sql = format!("SELECT EXISTS (SELECT 1 FROM \"{table}\")");
        if connection.query_row(&sql, [], |row| row.get(0))? {
            return Ok(true);
        }
    }
    Ok(false)
}

static WAITING_REPORT_FUNCTION: OnceLock<fn()> = OnceLock::new();

/// Sets a function that is called when work has waited for one second for another program that writes to the corpus.
///
/// It applies to the whole program, and only the first call has an effect. After 20 seconds of waiting the work fails.
pub fn on_waiting(report: fn()) {
    // A second listener is not an error: the first one reports already.
    let _ = WAITING_REPORT_FUNCTION.set(report);
}

/// The longest pause between two tries, in milliseconds; the first pause is the shortest.
const MAX_RETRY_PAUSE_MS: u64 = 25;
/// The try at which the program reports that it waits: after about one second.
const REPORTED_AFTER: i32 = 44;
/// The last try: after about 20 seconds.
const REFUSED_AFTER: i32 = 804;

/// Waits after a try to lock the database; returns whether to try again. `before` is the number of earlier waits.
fn wait(before: i32) -> bool {
    // It equals one number only, so that the report comes once for each wait.
    if before == REPORTED_AFTER
        && let Some(report) = WAITING_REPORT_FUNCTION.get()
    {
        report();
    }
    // Pauses double from 1 ms up to the longest, so that a short lock costs hardly any time.
    std::thread::sleep(Duration::from_millis(MAX_RETRY_PAUSE_MS.min(1 << before.clamp(0, 5))));
    before < REFUSED_AFTER
}

pub(super) fn configure_connection(connection: &mut Connection) -> CorpusResult<()> {
    connection.busy_handler(Some(wait))?;
    // Both guard against a file whose schema was written to do harm when it is read.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    // Without this flag statements are parsed again whenever a parameter changes.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_QPSG, true)?;
    connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, LARGEST_VALUE)?;
    connection.set_prepared_statement_cache_capacity(128);
    connection.execute_batch(
        "PRAGMA foreign_keys = ON; PRAGMA cell_size_check = ON; PRAGMA synchronous = FULL;
         PRAGMA cache_size = -32768; PRAGMA temp_store = FILE;",
    )?;
    Ok(())
}

/// Brings the schema to this program's version.
///
/// Foreign keys are not enforced meanwhile, because a step may build a table again that others refer to; the steps fail
/// if they leave more broken references than there were.
fn raise_schema_version(
    connection: &mut Connection,
    fill: impl FnOnce(&Connection) -> CorpusResult<()>,
) -> CorpusResult<()> {
    // SQLite ignores this setting within a transaction, so it stands outside of the steps.
    connection.pragma_update(None, "foreign_keys", false)?;
    let raised = take_steps(connection, fill);
    connection.pragma_update(None, "foreign_keys", true)?;
    raised
}

fn take_steps(connection: &mut Connection, fill: impl FnOnce(&Connection) -> CorpusResult<()>) -> CorpusResult<()> {
    let transaction = connection.transaction_with_behavior(rusqlite::TransactionBehavior::Immediate)?;
    let version: i32 = transaction.pragma_query_value(None, "user_version", |row| row.get(0))?;
    let broken_before = broken_references(&transaction)?;
    for step in SCHEMA_STEPS_SQL.iter().skip(usize::try_from(version).unwrap_or(0)) {
        transaction.execute_batch(step)?;
        upgrade::after_step(&transaction)?;
    }
    if version < upgrade::PHASED_SINCE {
        upgrade::begin_before_final(&transaction)?;
    }
    if version < EFFECTS_STORED_FROM {
        upgrade::read_old_summaries(&transaction)?;
    }
    // A new file, at version 0, has no signs yet.
    if version < LEXICONS_SINCE && version > 0 {
        upgrade::give_signs_lexicons(&transaction)?;
        // The index knows no lexicons; the next search builds it again.
        super::stored_search::delete_files(&transaction)?;
        super::stored_search::seal_files(&transaction)?;
        SearchIndexState::record_indexed_changes(&transaction, 0, 0)?;
    }
    upgrade::rewrite_json_rules(&transaction)?;
    stored_roles::add_missing(&transaction)?;
    fill(&transaction)?;
    // The seals cover the rows as the steps left them, so they come after all that writes rows.
    seals::seal_tables(&transaction, seals::sealed_tables())?;
    let broken = broken_references(&transaction)?;
    // A damaged file may come with broken references, which the upgrade neither mends nor answers for.
    if broken > broken_before {
        let reason = format!("its upgrade would break {broken} references between rows");
        return Err(damaged_row_error(format!("schema version {version}"), reason));
    }
    // The version is in the same transaction as the steps, so that no file is half upgraded.
    transaction.pragma_update(None, "user_version", SCHEMA_VERSION)?;
    transaction.commit()?;
    Ok(())
}

/// Returns the number of rows that refer to a row that does not exist.
fn broken_references(connection: &Connection) -> CorpusResult<i64> {
    let sql = "SELECT count(*) FROM pragma_foreign_key_check";
    Ok(connection.query_row(sql, [], |row| row.get(0))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roles_are_rows_that_the_program_adds_and_tiers_have_no_others() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let connection = create_corpus_file(&path, |_| Ok(())).expect("made");
        let run = |sql: &str| connection.execute_batch(sql);
        run("INSERT INTO recording (id, name, origin) VALUES (1, 'A', 'captured')").expect("stored");
        let tier = |role: &str| {
            run(&format!(
                "INSERT INTO tier (recording_id, name, position, role) VALUES (1, '{role}', 0, '{role}')"
            ))
        };
        tier("gloss").expect("stored");
        assert!(tier("unheard").is_err());
        // A role that an earlier version of the program did not know is added when this one opens the corpus.
        run("DELETE FROM tier_role WHERE name = 'comment'").expect("removed");
        assert!(tier("comment").is_err());
        let (again, upgrade) = open_corpus_file(&path).expect("opened");
        assert_eq!(upgrade, None);
        assert_eq!(stored_roles::find_unknown_roles(&again).ok(), Some(Vec::new()));
        tier("comment").expect("stored");
        run("INSERT INTO tier_role (name, note) VALUES ('unheard', 'of a newer program')").expect("stored");
        let error = open_corpus_file(&path).expect_err("a newer program wrote it");
        assert!(error.to_string().contains("does not know: unheard"), "{error}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_that_is_opened_again_keeps_the_locks_of_its_connection() {
        use std::os::unix::fs::MetadataExt;
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let connection = create_corpus_file(&path, |_| Ok(())).expect("made");
        let inode = format!(":{} ", fs::metadata(&path).expect("a file").ino());
        let locks = || {
            let all = fs::read_to_string("/proc/locks").expect("read");
            all.lines()
                .filter(|line| line.contains("POSIX") && line.contains(&inode))
                .count()
        };
        let version = |connection: &Connection| connection.query_row("SELECT count(*) FROM tier", [], |_| Ok(()));
        version(&connection).expect("read");
        assert_ne!(locks(), 0, "an open log of SQLite holds a lock");
        let (again, _) = open_corpus_file(&path).expect("opened");
        version(&again).expect("read");
        drop(again);
        assert_ne!(locks(), 0, "another connection does not end it");
    }

    /// Writes a file of the third version.
    fn write_old(path: &Path) {
        let old = Connection::open(path).expect("made");
        for step in &SCHEMA_STEPS_SQL[..3] {
            old.execute_batch(step).expect("a step");
        }
        old.pragma_update(None, "application_id", APPLICATION_ID)
            .and_then(|()| old.pragma_update(None, "user_version", 3))
            .expect("set");
    }

    fn version(path: &Path) -> i32 {
        let connection = Connection::open(path).expect("opened");
        let version = connection.pragma_query_value(None, "user_version", |row| row.get(0));
        version.expect("a version")
    }

    #[test]
    fn a_file_of_an_older_version_is_kept_beside_the_upgraded_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        for name in ["c.version-3.chereme", "c.version-3 (2).chereme"] {
            // The file may not exist.
            let _ = fs::remove_file(&path);
            write_old(&path);
            let (connection, upgrade) = open_corpus_file(&path).expect("opened");
            drop(connection);
            let kept = folder.path().join(name);
            let (from, to) = (3, SCHEMA_VERSION);
            assert_eq!(
                upgrade,
                Some(SchemaUpgrade {
                    from,
                    to,
                    kept: kept.clone()
                })
            );
            assert_eq!((version(&path), version(&kept)), (SCHEMA_VERSION, 3));
            assert_eq!(open_corpus_file(&path).expect("opened").1, None, "once");
        }
    }

    #[test]
    fn a_file_of_somebody_else_is_read_as_one_of_this_version_and_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let [own, shelf] = ["own", "theirs"].map(|it| folder.path().join(it));
        let files = |folder: &Path| fs::read_dir(folder).expect("a folder").count();
        for folder in [&own, &shelf] {
            fs::create_dir(folder).expect("made");
        }
        let path = shelf.join("c.chereme");
        write_old(&path);
        let bytes = fs::read(&path).expect("read");
        let (theirs, copy) = open_unchanged(&path, &own.join("mine.chereme")).expect("opened");
        let count = theirs.query_row("SELECT count(*) FROM study", [], |row| row.get::<_, i64>(0));
        assert_eq!(count.ok(), Some(0), "a table of a later version");
        drop((theirs, copy));
        assert_eq!(fs::read(&path).expect("read"), bytes);
        assert_eq!((files(&own), files(&shelf)), (0, 1));
    }

    #[test]
    fn only_a_file_without_rows_may_be_deleted_for_its_version_number() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let empty_all = "PRAGMA foreign_keys = OFF;";
        let no_tables = "PRAGMA writable_schema = ON; DELETE FROM sqlite_schema;";
        let one_row = "INSERT INTO recording (id, name, origin) VALUES (1, 'A', 'captured')";
        for (change, version, deletable) in [
            (one_row, 0, false),
            (one_row, -7, false),
            ("", 0, false),
            (empty_all, 0, true),
            (no_tables, 0, true),
        ] {
            // The file may not exist.
            let _ = fs::remove_file(&path);
            drop(create_corpus_file(&path, |_| Ok(())).expect("made"));
            let foreign = Connection::open(&path).expect("opened");
            foreign.execute_batch(change).expect("changed");
            if deletable {
                let left: Vec<String> = foreign
                    .prepare("SELECT name FROM sqlite_schema WHERE type = 'table'")
                    .and_then(|mut it| it.query_map([], |row| row.get(0))?.collect())
                    .expect("listed");
                for table in left.iter().filter(|it| !it.starts_with("sqlite_")) {
                    let sql = format!("DELETE FROM {table}");
                    foreign.execute_batch(&sql).expect("emptied");
                }
            }
            foreign.pragma_update(None, "user_version", version).expect("set");
            drop(foreign);
            let Err(error) = open_corpus_file(&path) else {
                panic!("opened: {change} {version}");
            };
            let message = error.to_string();
            let remedy = error.error_remedy().map(|it| it.to_string()).unwrap_or_default();
            assert_eq!(remedy.contains("delete it"), deletable, "{change}: {remedy}");
            if !deletable {
                assert!(message.contains(&format!("wrong: it is {version}")), "{message}");
                assert!(remedy.contains("from a backup"), "{remedy}");
            }
        }
    }

    #[test]
    fn rules_of_columns_that_may_be_empty_hold_for_older_sqlite_too() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let rules = |path: &Path| -> Vec<String> {
            let (connection, _) = open_corpus_file(path).expect("opened");
            let sql = "SELECT sql FROM sqlite_schema WHERE sql LIKE '%json_valid%'";
            let mut statement = connection.prepare(sql).expect("read");
            let rules = statement.query_map([], |row| row.get(0)).expect("read");
            rules.map(|it| it.expect("a rule")).collect()
        };
        drop(create_corpus_file(&path, |_| Ok(())).expect("made"));
        let new = rules(&path);
        let old = folder.path().join("old.chereme");
        write_old(&old);
        assert_eq!(rules(&old), new);
        let of_mapping = "mapping IS NULL OR json_valid(mapping)";
        assert!(new.iter().any(|it| it.contains(of_mapping)), "{new:#?}");
        let loose = new.iter().flat_map(|it| it.lines());
        let loose: Vec<&str> = loose
            .filter(|it| it.contains("json_valid") && !it.contains("NOT NULL"))
            .collect();
        assert_eq!(loose.len(), 8, "{loose:#?}");
        assert!(
            loose.iter().all(|it| it.contains(" IS NULL OR json_valid(")),
            "{loose:#?}"
        );
        let foreign = Connection::open(&path).expect("opened");
        assert!(
            foreign
                .execute_batch("INSERT INTO signer (name, consent) VALUES ('A', '{')")
                .is_err()
        );
    }

    #[test]
    fn a_file_in_a_read_only_folder_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let shelf = folder.path().join("50% of #1");
        fs::create_dir(&shelf).expect("made");
        let path = shelf.join("c.chereme");
        drop(create_corpus_file(&path, |_| Ok(())).expect("made"));
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI;
        let still = Connection::open_with_flags(immutable_file_uri(&path), flags).expect("opened");
        assert!(still.is_readonly("main").is_ok_and(|it| it));
        drop(still);
        let lock = |file: &Path, locked: bool| {
            let mut permissions = fs::metadata(file).expect("there").permissions();
            permissions.set_readonly(locked);
            fs::set_permissions(file, permissions).expect("set");
        };
        lock(&path, true);
        lock(&shelf, true);
        let opened = open_corpus_file(&path).and_then(|(connection, _)| {
            Ok(connection.query_row("SELECT count(*) FROM sign", [], |row| row.get::<_, i64>(0))?)
        });
        assert_eq!(opened.ok(), Some(0));
        // Restores access so that the folder can be removed.
        lock(&shelf, false);
        lock(&path, false);
    }
}
