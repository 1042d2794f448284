//! Integrity check: the faults of a corpus, their places, and remedies.

use std::collections::BTreeMap;

use chereme_formats::bvh::raw::BvhHierarchy;
use chereme_motion::FrameNumberColumn;
use chereme_sign::tier::{self, TierId, TierViolation};
use chereme_sign::{ErrorRemedy, RemedyChoice};
use rusqlite::Connection;
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::IndexedStore;
use crate::address::message_names;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_check as rows;
use crate::db::stored_columns::OpinionStanding;
use crate::db::stored_motion::to_hex_text;
use crate::db::stored_search::{self as index_rows, SearchIndexState};
use crate::db::{notations, people, seals, stored_recordings, stored_studies, stored_tiers, stored_tracks};
use crate::error::{CorpusResult, DatabaseFailureCause};
use crate::inventories;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::notation;
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::search::index::SearchIndex;
use crate::tokens;
use crate::track::{self, TrackKind, TrackRow};
use crate::words::effect::OperationEffect;

#[cfg(test)]
mod tests;

/// The result of a check.
#[derive(Debug, Clone, Default, Serialize)]
pub struct CheckReport {
    /// Whether no damage was found.
    pub ok: bool,
    /// Number of checked objects of each kind.
    pub checked: BTreeMap<&'static str, u64>,
    /// The damage: what is not as the program stored it.
    pub faults: Vec<CorpusFault>,
    /// Questions about the data: annotations and tiers that break the rules of ELAN, as they came from a file.
    pub questions: Vec<CorpusFault>,
    /// Descriptions of the repairs.
    pub mended: Vec<String>,
}

impl CheckReport {
    /// Returns the damage, then the questions.
    pub fn all_findings(&self) -> impl Iterator<Item = &CorpusFault> {
        self.faults.iter().chain(&self.questions)
    }
}

/// A fault in a corpus.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CorpusFault {
    /// `database`, `reference`, `row`, `file`, `block`, `movement`, `skeleton`, `inventory`, `study`, `notation`,
    /// `tier`, `tokens`, `history` or `index`.
    pub kind: &'static str,
    /// The place of the fault.
    pub place: String,
    /// The fault in words.
    pub message: String,
    /// The remedy.
    pub remedy: ErrorRemedy,
}

const RESTORE_BACKUP_ADVICE: &str = "take the file from a backup, or import the recording again";
/// The number of overlaps on one tier that are listed as separate faults; the rest are counted.
const SHOWN_OVERLAPS: u64 = 3;

/// Returns the remedy for rows that are not as they were stored.
fn compare_backup_remedy() -> ErrorRemedy {
    ErrorRemedy::command_remedy(
        "compare it with a backup; if it is right as it is now, `chereme check CORPUS --accept` keeps it so",
    )
}

/// Returns the remedy for an index that the next search builds again.
fn next_search() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::Check,
        "the next search builds it again; so does `chereme check CORPUS --mend`",
    )
}

/// Returns the remedy for derived data with a fault.
fn mend_derived_remedy() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(RemedyChoice::Check, "`chereme check CORPUS --mend` puts it right")
}

impl Corpus {
    /// Checks everything in the corpus: the database, references, rows, files, blocks and their hashes, skeletons,
    /// inventories, notations, tier rules, tokens, history and the search index. Other programs may write meanwhile.
    ///
    /// With `mend`, wrong tokens and the search index are built again.
    ///
    /// # Errors
    /// Fails if the database cannot be read at all, or the work is stopped.
    pub fn check_corpus(&mut self, mend: bool, progress: &mut ProgressReceiver<'_>) -> CorpusResult<CheckReport> {
        let mut report = CheckReport::default();
        let mut looking = CheckRun {
            report: &mut report,
            progress: &mut *progress,
        };
        let looked = looking.database(self.store.read_connection());
        looking.go_on("database", "the file", looked)?;
        let looked = looking.index_files(&mut self.store);
        looking.go_on("database", "search index", looked)?;
        // One state of all rows; foreign keys cannot be switched within it, and the index not be built.
        let reading = index_rows::begin_reading(self.store.read_connection())?;
        let connection: &Connection = &reading;
        let looked = looking.index(connection, self.store.index());
        looking.go_on("database", "search index", looked)?;
        let looked = looking.check_sealed_rows(connection);
        looking.go_on("row", "rows", looked)?;
        let looked = looking.check_stored_files(connection);
        looking.go_on("file", "files", looked)?;
        let looked = looking.check_block_hashes(connection);
        looking.go_on("block", "blocks", looked)?;
        let looked = looking.check_stored_movement(connection);
        looking.go_on("movement", "tracks", looked)?;
        looking.check_all_inventories(connection)?;
        let looked = looking.check_all_notations(connection);
        looking.go_on("notation", "notations", looked)?;
        let looked = looking.check_tier_rules(connection);
        looking.go_on("tier", "recordings", looked)?;
        let looked = looking.check_names_of_people(connection);
        looking.go_on("signer", "people", looked)?;
        match self.store.check_history(looking.progress) {
            Ok(faults) => {
                for fault in faults {
                    looking.report_check_fault("history", "history", fault, RESTORE_BACKUP_ADVICE);
                }
            }
            Err(error) => looking.go_on("history", "history", Err(error))?,
        }
        drop(reading);
        let looked = looking.check_derived_tokens(self.store.read_connection());
        looking.go_on("tier", "recordings", looked)?;
        if mend {
            let mended = self.mend_faults(&mut report, progress);
            CheckRun {
                report: &mut report,
                progress,
            }
            .go_on("database", "derived rows", mended)?;
        }
        report.ok = report.faults.is_empty();
        Ok(report)
    }

    /// Takes the rows as they are now for right, such as after a change by another program.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn accept_rows(&mut self) -> CorpusResult<()> {
        self.store.seal_again(seals::sealed_tables())
    }

    fn mend_faults(&mut self, report: &mut CheckReport, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()> {
        if report.faults.iter().any(|fault| fault.kind == "tokens") {
            self.store.operation_with_progress(progress, |connection, progress| {
                let inventories = inventories::load_all_inventories(connection)?;
                for recording in stored_recordings::load_recording_rows(connection)? {
                    tokens::derive_with_progress(connection, recording.id, None, &inventories, progress)?;
                }
                Ok(((), OperationEffect::Mend {}))
            })?;
            // Changes only continue a seal, so one that was broken from outside would stay broken.
            self.store.seal_again(["token", "token_value"])?;
            report
                .mended
                .push("the tokens were derived again from the tiers".to_owned());
        }
        self.store.rebuild_search_index(progress)?;
        report.mended.push("the search index was built again".to_owned());
        // A mended fault is no longer one of the corpus.
        report.faults.retain(|fault| !["tokens", "index"].contains(&fault.kind));
        Ok(())
    }
}

struct CheckRun<'a, 'p> {
    report: &'a mut CheckReport,
    progress: &'a mut ProgressReceiver<'p>,
}

impl CheckRun<'_, '_> {
    fn report_check_fault(
        &mut self,
        kind: &'static str,
        place: impl Into<String>,
        message: impl Into<String>,
        remedy: impl Into<ErrorRemedy>,
    ) {
        let (place, message, remedy) = (place.into(), message.into(), remedy.into());
        self.report.faults.push(CorpusFault {
            kind,
            place,
            message,
            remedy,
        });
    }

    /// Reports what keeps one part of the check from being done, so that the others follow.
    ///
    /// # Errors
    /// Fails if the work was stopped, or the file cannot be read or written at all.
    fn go_on(&mut self, kind: &'static str, place: &str, looked: CorpusResult<()>) -> CorpusResult<()> {
        let Err(error) = looked else { return Ok(()) };
        let is_of_file = error
            .database_failure_cause()
            // A file that cannot be read at all makes every further part fail in the same way.
            .is_some_and(|cause| cause != DatabaseFailureCause::Damaged);
        if is_of_file || matches!(error, crate::CorpusError::Stopped) {
            return Err(error);
        }
        let message = format!("this part cannot be read: {error}");
        // Tiers that cannot be read have no tokens to be compared either.
        let is_known = |fault: &CorpusFault| fault.place == place && fault.message == message;
        if !self.report.faults.iter().any(is_known) {
            self.report_check_fault(kind, place, message, RESTORE_BACKUP_ADVICE);
        }
        Ok(())
    }

    fn count_checked_object(&mut self, what: &'static str) -> CorpusResult<()> {
        let count = self.report.checked.entry(what).or_default();
        *count += 1;
        // Reporting each of many quick steps would take longer than the steps.
        let quick = matches!(what, "blocks" | "notations" | "skeletons");
        if !quick || count.is_multiple_of(64) {
            let (task, done) = (what, *count);
            self.progress.report_amount(ProgressUnit::Items, task, done, None)?;
        }
        Ok(())
    }

    fn database(&mut self, connection: &Connection) -> CorpusResult<()> {
        let lines = rows::check_sqlite_integrity(connection)?;
        let broken = rows::broken_rows(connection, &lines)?;
        for line in lines {
            let table = rows::table_of(&line);
            // These rows are reported below with their rule, which says more than the line.
            if !broken.iter().any(|row| Some(row.table.as_str()) == table) {
                self.report_check_fault("database", "the file", line, RESTORE_BACKUP_ADVICE);
            }
        }
        for it in broken {
            let place = format!("row {} of {}", it.row, it.table);
            let message = format!("it breaks a rule of its table: {}", it.rule);
            self.report_check_fault("database", place, message, RESTORE_BACKUP_ADVICE);
        }
        for (table, row, other) in rows::broken_references(connection)? {
            let place = format!("row {row} of {table}");
            let message = format!("it refers to a row of {other} that is not there");
            self.report_check_fault("reference", place, message, RESTORE_BACKUP_ADVICE);
        }
        Ok(())
    }

    /// Looks at the files of the search index, and loads it unless they are wrong.
    fn index_files(&mut self, store: &mut IndexedStore) -> CorpusResult<()> {
        let connection = store.read_connection();
        let state = SearchIndexState::read_index_state(connection)?;
        let damaged = index_rows::damaged_files(connection)?;
        // A corpus that was never indexed, such as a copy for others, has no index that could be wrong.
        if state.format == 0 {
            return Ok(());
        }
        if state.content != state.indexed {
            self.report_check_fault(
                "index",
                "search index",
                "the rows were changed without it",
                next_search(),
            );
        } else if let Some(first) = damaged.first() {
            let message = format!("its file {first:?} is not as it was stored");
            self.report_check_fault("index", "search index", message, next_search());
        } else if !index_rows::has_stored_files(connection)? {
            let message = "its files are not those that were stored";
            self.report_check_fault("index", "search index", message, next_search());
        } else {
            store.searchable_connection()?;
        }
        Ok(())
    }

    fn index(&mut self, connection: &Connection, index: &SearchIndex) -> CorpusResult<()> {
        // An index with faults was not loaded, and its faults were reported before.
        if !index.is_current(connection)? {
            return Ok(());
        }
        let (tokens, documents) = (rows::count_all_tokens(connection)?, index.indexed_document_count());
        self.report.checked.insert("index documents", documents);
        if i64::try_from(documents).ok() != Some(tokens) {
            let message = format!("it holds {documents} documents for {tokens} tokens");
            self.report_check_fault("index", "search index", message, mend_derived_remedy());
        }
        Ok(())
    }

    /// Compares all rows with their seals.
    fn check_sealed_rows(&mut self, connection: &Connection) -> CorpusResult<()> {
        for table in seals::sealed_tables() {
            for broken in seals::broken_seals(connection, table)? {
                self.report_check_fault("row", broken.to_string(), seals::NOT_AS_STORED, compare_backup_remedy());
            }
            self.count_checked_object("tables")?;
        }
        Ok(())
    }

    /// Compares stored files and plans of studies with their hashes.
    fn check_stored_files(&mut self, connection: &Connection) -> CorpusResult<()> {
        for file in stored_recordings::all_source_files(connection)? {
            if let Err(error) = stored_recordings::source_bytes(connection, file.id) {
                self.report_check_fault(
                    "file",
                    format!("file {:?}", file.name),
                    error.to_string(),
                    RESTORE_BACKUP_ADVICE,
                );
            }
            self.count_checked_object("files")?;
        }
        for name in stored_studies::list_study_names(connection)? {
            if let Err(error) = stored_studies::find_study_row(connection, &name) {
                self.report_check_fault(
                    "study",
                    format!("study {name:?}"),
                    error.to_string(),
                    RESTORE_BACKUP_ADVICE,
                );
            }
        }
        Ok(())
    }

    fn check_block_hashes(&mut self, connection: &Connection) -> CorpusResult<()> {
        rows::check_each_block(connection, |name, whole| {
            if !whole {
                self.report_check_fault(
                    "block",
                    format!("block {name}"),
                    "its bytes do not match the hash that names it",
                    RESTORE_BACKUP_ADVICE,
                );
            }
            self.count_checked_object("blocks")
        })
    }

    fn check_all_notations(&mut self, connection: &Connection) -> CorpusResult<()> {
        notations::visit_each_notation(connection, |row| {
            let place = format!("notation {}", row.id);
            if let Err(error) = notation::read_notation_row(row) {
                self.report_check_fault("notation", place, error.to_string(), RESTORE_BACKUP_ADVICE);
            }
            self.count_checked_object("notations")
        })
    }

    fn check_stored_movement(&mut self, connection: &Connection) -> CorpusResult<()> {
        for (id, document, hash) in rows::list_skeleton_documents(connection)? {
            let place = format!("skeleton {id}");
            if serde_json::from_str::<BvhHierarchy>(&document).is_err() {
                self.report_check_fault("skeleton", place, "its document cannot be read", RESTORE_BACKUP_ADVICE);
            } else if to_hex_text(&Sha256::digest(document.as_bytes())) != hash {
                self.report_check_fault(
                    "skeleton",
                    place,
                    "its document does not match the hash that names it",
                    RESTORE_BACKUP_ADVICE,
                );
            }
            self.count_checked_object("skeletons")?;
        }
        for row in stored_tracks::all_moving(connection)? {
            if let Err(error) = self.check_track_blocks(connection, &row) {
                if matches!(error, crate::CorpusError::Stopped) {
                    return Err(error);
                }
                self.report_check_fault(
                    "movement",
                    format!("track {} of recording:{}", row.id, row.recording_id),
                    error.to_string(),
                    RESTORE_BACKUP_ADVICE,
                );
            }
            self.count_checked_object("tracks")?;
        }
        Ok(())
    }

    /// Decodes every block of a track and looks for missing frames.
    fn check_track_blocks(&mut self, connection: &Connection, row: &TrackRow) -> CorpusResult<()> {
        // Other tracks are small enough to be read whole.
        if row.kind != TrackKind::Skeleton {
            return track::track_read::read_stored_track(connection, row, None).map(|_| ());
        }
        let track = MotionTrack::of_row(connection, row.id)?;
        track.frame_time()?;
        for group in ChannelGroup::ALL_CHANNEL_GROUPS {
            if track.columns_of(group).is_empty() {
                continue;
            }
            let mut next = 0;
            track.take_frame_blocks(
                connection,
                &[group],
                &(0..track.motion_frame_count()),
                |_, first, columns| {
                    self.progress
                        .report_frames("movement", first, track.motion_frame_count())?;
                    let frames = columns.first().map_or(0, FrameNumberColumn::len);
                    if first != next {
                        let what = format!("frames {next} to {first} of {} are missing", group.channel_group_name());
                        return Err(crate::CorpusError::from_wrong_message(what));
                    }
                    next = first + frames;
                    Ok(())
                },
            )?;
            if next != track.motion_frame_count() {
                let frames = track.motion_frame_count();
                let what = format!("{} has {next} frames of {frames}", group.channel_group_name());
                return Err(crate::CorpusError::from_wrong_message(what));
            }
        }
        Ok(())
    }

    fn check_all_inventories(&mut self, connection: &Connection) -> CorpusResult<()> {
        match inventories::load_all_inventories(connection) {
            Ok(all) => {
                self.report.checked.insert("inventories", all.len() as u64);
            }
            Err(error) => self.report_check_fault("inventory", "inventories", error.to_string(), RESTORE_BACKUP_ADVICE),
        }
        Ok(())
    }

    /// Reports what breaks the rules of tiers as questions: it came so from a file.
    fn check_tier_rules(&mut self, connection: &Connection) -> CorpusResult<()> {
        for recording in stored_recordings::load_recording_rows(connection)? {
            let place = format!("recording {:?}", recording.name);
            let set = match stored_tiers::load_tier_set(connection, recording.id) {
                Ok(set) => set,
                Err(error) => {
                    self.go_on("tier", &place, Err(error))?;
                    continue;
                }
            };
            let mut ask = |message: &str, remedy: ErrorRemedy| {
                self.report.questions.push(CorpusFault {
                    kind: "tier",
                    place: place.clone(),
                    message: message_names::name_message_ids(connection, message),
                    remedy,
                });
            };
            let mut overlaps: BTreeMap<TierId, u64> = BTreeMap::new();
            for violation in tier::check_tier_set(&set) {
                if let TierViolation::Overlap { tier, .. } = violation {
                    let count = overlaps.entry(tier).or_default();
                    *count += 1;
                    // A tier of two signers may have thousands of overlaps, which would bury everything else.
                    if *count > SHOWN_OVERLAPS {
                        continue;
                    }
                }
                ask(&violation.to_string(), violation_remedy(&violation));
            }
            for (tier, count) in overlaps {
                if let Some(more) = count.checked_sub(SHOWN_OVERLAPS).filter(|&more| more > 0) {
                    ask(
                        &format!("further overlapping annotations on {tier}: {more}"),
                        "ELAN allows no overlap within a tier; put one of each two on another tier".into(),
                    );
                }
            }
        }
        Ok(())
    }

    /// Asks about names that two people have: a merge of two corpora leaves them so.
    fn check_names_of_people(&mut self, connection: &Connection) -> CorpusResult<()> {
        for person in people::load_people(connection)? {
            for alias in &person.aliases {
                if stored_recordings::find_signer(connection, alias)?.is_some_and(|other| other.id != person.id) {
                    self.report.questions.push(CorpusFault {
                        kind: "signer",
                        place: format!("signer:{alias}"),
                        message: format!("{alias:?} is another name of {}, and somebody else is called so", person.name),
                        remedy: ErrorRemedy::command_remedy(
                            "make them one: `chereme people CORPUS unite PERSON --into NAME`, or take the name away: `chereme people CORPUS set NAME`",
                        ),
                    });
                }
            }
        }
        Ok(())
    }

    /// Derives the tokens of each recording on trial; each recording is read in one state.
    fn check_derived_tokens(&mut self, connection: &Connection) -> CorpusResult<()> {
        // Inventories that cannot be read were reported before, and do not stop the check.
        let inventories = inventories::load_all_inventories(connection).unwrap_or_default();
        for recording in stored_recordings::load_recording_rows(connection)? {
            let place = format!("recording {:?}", recording.name);
            let derived = rows::run_and_roll_back(connection, || {
                let before = rows::count_recorded_changes(connection)?;
                tokens::derive_with_progress(connection, recording.id, None, &inventories, self.progress)?;
                // A derivation that changes nothing leaves no change in the history.
                Ok(rows::count_recorded_changes(connection)? - before)
            });
            let is_as_derived = match derived {
                Ok(0) => Ok(true),
                Ok(_) => rows::run_and_roll_back(connection, || {
                    let stored = counted_token_values(connection, recording.id)?;
                    tokens::derive_with_progress(connection, recording.id, None, &inventories, self.progress)?;
                    let derived = counted_token_values(connection, recording.id)?;
                    // An older program kept nothing of what others say of a value that counts.
                    Ok(stored.0 == derived.0 && stored.1 == 0)
                }),
                Err(error) => Err(error),
            };
            match is_as_derived {
                Ok(true) => {}
                Ok(false) => self.report_check_fault(
                    "tokens",
                    place,
                    "its tokens do not agree with its tiers",
                    mend_derived_remedy(),
                ),
                Err(error) => {
                    self.go_on("tier", &place, Err(error))?;
                    continue;
                }
            }
            self.count_checked_object("recordings")?;
        }
        Ok(())
    }
}

/// Tokens with their values and opinions.
type ValuedTokens = Vec<(TokenRow, Vec<TokenValueRow>)>;

/// Returns the tokens of a recording with their values and opinions, and apart from them the number of opinions about values
/// that count.
fn counted_token_values(connection: &Connection, recording: i64) -> CorpusResult<(ValuedTokens, usize)> {
    let (mut tokens, mut others) = (Vec::new(), 0);
    for token in signs::tokens_of_recording(connection, recording)? {
        let mut values = signs::load_values_and_opinions(connection, token.id)?;
        let all = values.len();
        values.retain(|row| !matches!(row.standing, Some(OpinionStanding::Agreed | OpinionStanding::Replaced)));
        others += all - values.len();
        tokens.push((token, values));
    }
    Ok((tokens, others))
}

/// Returns what corrects a broken rule of tiers.
fn violation_remedy(violation: &TierViolation) -> ErrorRemedy {
    ErrorRemedy::command_remedy(match violation {
        TierViolation::DuplicateName { .. } => {
            "give it another name: `chereme annotate CORPUS tier TIER --name NAME --in RECORDING`"
        }
        TierViolation::MissingParentTier { .. }
        | TierViolation::ParentCycle { .. }
        | TierViolation::TooDeep { .. }
        | TierViolation::AlignableBelowSymbolic { .. } => {
            "correct the tiers in the file that they come from, and import it again"
        }
        TierViolation::NotInVocabulary { .. } => {
            "correct the value: `chereme annotate CORPUS set ANNOTATION --value TEXT`"
        }
        TierViolation::ZeroLength { .. }
        | TierViolation::Overlap { .. }
        | TierViolation::OutsideParent { .. }
        | TierViolation::Gap { .. }
        | TierViolation::DerivedSpan { .. } => {
            "correct the times: `chereme annotate CORPUS set ANNOTATION --start TIME --end TIME`"
        }
        TierViolation::MissingTier { .. }
        | TierViolation::MissingParent { .. }
        | TierViolation::ParentOfRoot { .. }
        | TierViolation::SecondAssociation { .. }
        | TierViolation::Order { .. } => {
            "correct it in the file that it comes from and import that again, or remove it: `chereme annotate CORPUS remove ANNOTATION`"
        }
    })
}
