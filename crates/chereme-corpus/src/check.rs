//! Integrity check: the faults of a corpus, their places, and remedies.

use std::collections::BTreeMap;

use chereme_formats::bvh::raw::Hierarchy;
use chereme_motion::{Column, Instant, Span};
use chereme_sign::Reading;
use chereme_sign::tier::{self, AnnotationId, Hands, TierId, TierSet, Violation};
use chereme_sign::{Choice, Remedy};
use rusqlite::Connection;
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::Store;
use crate::annotate::messages;
use crate::db::check as rows;
use crate::db::motion::hex;
use crate::db::search::{self as index_rows, State};
use crate::db::{notations, recordings, seals, studies, tiers, tracks};
use crate::error::{Cause, Result};
use crate::inventories;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::notation;
use crate::progress::{Progress, Step, Unit};
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
    pub faults: Vec<Fault>,
    /// Questions about the data: annotations and tiers that break the rules of ELAN, as they came from a file.
    pub questions: Vec<Fault>,
    /// Descriptions of the repairs.
    pub mended: Vec<String>,
}

impl CheckReport {
    /// Returns the damage, then the questions.
    pub fn findings(&self) -> impl Iterator<Item = &Fault> {
        self.faults.iter().chain(&self.questions)
    }
}

/// A fault in a corpus.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// `database`, `reference`, `row`, `file`, `block`, `movement`, `skeleton`, `inventory`, `study`, `notation`,
    /// `tier`, `tokens`, `history` or `index`.
    pub kind: &'static str,
    /// The place of the fault.
    pub place: String,
    /// The fault in words.
    pub message: String,
    /// The remedy.
    pub remedy: Remedy,
}

const BACKUP: &str = "take the file from a backup, or import the recording again";
/// The number of overlaps on one tier that are listed as separate faults; the rest are counted.
const SHOWN_OVERLAPS: u64 = 3;

/// Returns the remedy for rows that are not as they were stored.
fn compare() -> Remedy {
    Remedy::command(
        "compare it with a backup; if it is right as it is now, `chereme check CORPUS --accept` keeps it so",
    )
}

/// Returns the remedy for an index that the next search builds again.
fn next_search() -> Remedy {
    Remedy::choice(
        Choice::Check,
        "the next search builds it again; so does `chereme check CORPUS --mend`",
    )
}

/// Returns the remedy for derived data with a fault.
fn mend() -> Remedy {
    Remedy::choice(Choice::Check, "`chereme check CORPUS --mend` puts it right")
}

impl Corpus {
    /// Checks everything in the corpus: the database, references, rows, files, blocks and their hashes, skeletons,
    /// inventories, notations, tier rules, tokens, history and the search index. Other programs may write meanwhile.
    ///
    /// With `mend`, wrong tokens and the search index are built again.
    ///
    /// # Errors
    /// Fails if the database cannot be read at all, or the work is stopped.
    pub fn check(&mut self, mend: bool, progress: &mut Progress<'_>) -> Result<CheckReport> {
        let mut report = CheckReport::default();
        let mut looking = Looking {
            report: &mut report,
            progress: &mut *progress,
        };
        let looked = looking.database(self.store.read());
        looking.go_on("database", "the file", looked)?;
        let looked = looking.index_files(&mut self.store);
        looking.go_on("database", "search index", looked)?;
        // One state of all rows; foreign keys cannot be switched within it, and the index not be built.
        let reading = index_rows::begin_reading(self.store.read())?;
        let connection: &Connection = &reading;
        let looked = looking.index(connection, self.store.index());
        looking.go_on("database", "search index", looked)?;
        let looked = looking.rows(connection);
        looking.go_on("row", "rows", looked)?;
        let looked = looking.files(connection);
        looking.go_on("file", "files", looked)?;
        let looked = looking.blocks(connection);
        looking.go_on("block", "blocks", looked)?;
        let looked = looking.movement(connection);
        looking.go_on("movement", "tracks", looked)?;
        looking.inventories(connection)?;
        let looked = looking.notations(connection);
        looking.go_on("notation", "notations", looked)?;
        let looked = looking.tiers(connection);
        looking.go_on("tier", "recordings", looked)?;
        match self.store.check_history(looking.progress) {
            Ok(faults) => {
                for fault in faults {
                    looking.fault("history", "history", fault, BACKUP);
                }
            }
            Err(error) => looking.go_on("history", "history", Err(error))?,
        }
        drop(reading);
        let looked = looking.tokens(self.store.read());
        looking.go_on("tier", "recordings", looked)?;
        if mend {
            let mended = self.mend(&mut report, progress);
            Looking {
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
    pub fn accept_rows(&mut self) -> Result<()> {
        self.store.seal_again(seals::sealed_tables())
    }

    fn mend(&mut self, report: &mut CheckReport, progress: &mut Progress<'_>) -> Result<()> {
        if report.faults.iter().any(|fault| fault.kind == "tokens") {
            self.store
                .operation_with_progress(progress, |connection, progress| {
                    let inventories = inventories::load(connection)?;
                    for recording in recordings::recordings(connection)? {
                        tokens::derive_with_progress(
                            connection,
                            recording.id,
                            None,
                            &inventories,
                            progress,
                        )?;
                    }
                    Ok(((), OperationEffect::Mend {}))
                })?;
            self.store.seal_again(["token", "token_value"])?;
            report
                .mended
                .push("the tokens were derived again from the tiers".to_owned());
        }
        self.store.reindex(progress)?;
        report
            .mended
            .push("the search index was built again".to_owned());
        report
            .faults
            .retain(|fault| !["tokens", "index"].contains(&fault.kind));
        Ok(())
    }
}

struct Looking<'a, 'p> {
    report: &'a mut CheckReport,
    progress: &'a mut Progress<'p>,
}

impl Looking<'_, '_> {
    fn fault(
        &mut self,
        kind: &'static str,
        place: impl Into<String>,
        message: impl Into<String>,
        remedy: impl Into<Remedy>,
    ) {
        let (place, message, remedy) = (place.into(), message.into(), remedy.into());
        self.report.faults.push(Fault {
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
    fn go_on(&mut self, kind: &'static str, place: &str, looked: Result<()>) -> Result<()> {
        let Err(error) = looked else { return Ok(()) };
        let is_of_file = error.cause().is_some_and(|cause| cause != Cause::Damaged);
        if is_of_file || matches!(error, crate::Error::Stopped) {
            return Err(error);
        }
        let message = format!("this part cannot be read: {error}");
        // Tiers that cannot be read have no tokens to be compared either.
        let is_known = |fault: &Fault| fault.place == place && fault.message == message;
        if !self.report.faults.iter().any(is_known) {
            self.fault(kind, place, message, BACKUP);
        }
        Ok(())
    }

    fn count(&mut self, what: &'static str) -> Result<()> {
        let count = self.report.checked.entry(what).or_default();
        *count += 1;
        let quick = matches!(what, "blocks" | "notations" | "skeletons");
        if !quick || count.is_multiple_of(64) {
            let (task, done) = (what, *count);
            self.progress.report(Step {
                task,
                done,
                total: None,
                unit: Unit::Items,
            })?;
        }
        Ok(())
    }

    fn database(&mut self, connection: &Connection) -> Result<()> {
        let lines = rows::integrity(connection)?;
        let broken = rows::broken_rows(connection, &lines)?;
        for line in lines {
            let table = rows::table_of(&line);
            if !broken.iter().any(|it| Some(it.table.as_str()) == table) {
                self.fault("database", "the file", line, BACKUP);
            }
        }
        for it in broken {
            let place = format!("row {} of {}", it.row, it.table);
            let message = format!("it breaks a rule of its table: {}", it.rule);
            self.fault("database", place, message, BACKUP);
        }
        for (table, row, other) in rows::broken_references(connection)? {
            let place = format!("row {row} of {table}");
            let message = format!("it refers to a row of {other} that is not there");
            self.fault("reference", place, message, BACKUP);
        }
        Ok(())
    }

    /// Looks at the files of the search index, and loads it unless they are wrong.
    fn index_files(&mut self, store: &mut Store) -> Result<()> {
        let connection = store.read();
        let state = State::read(connection)?;
        let damaged = index_rows::damaged_files(connection)?;
        if state.content != state.indexed && state.format != 0 {
            self.fault(
                "index",
                "search index",
                "the rows were changed without it",
                next_search(),
            );
        } else if let Some(first) = damaged.first() {
            let message = format!("its file {first:?} is not as it was stored");
            self.fault("index", "search index", message, next_search());
        } else if !index_rows::has_stored_files(connection)? {
            let message = "its files are not those that were stored";
            self.fault("index", "search index", message, next_search());
        } else {
            store.searchable()?;
        }
        Ok(())
    }

    fn index(&mut self, connection: &Connection, index: &SearchIndex) -> Result<()> {
        if !index.is_current(connection)? {
            return Ok(());
        }
        let (tokens, documents) = (rows::tokens(connection)?, index.documents());
        self.report.checked.insert("index documents", documents);
        if i64::try_from(documents).ok() != Some(tokens) {
            let message = format!("it holds {documents} documents for {tokens} tokens");
            self.fault("index", "search index", message, mend());
        }
        Ok(())
    }

    /// Compares all rows with their seals.
    fn rows(&mut self, connection: &Connection) -> Result<()> {
        for table in seals::sealed_tables() {
            for broken in seals::broken_seals(connection, table)? {
                self.fault("row", broken.to_string(), seals::NOT_AS_STORED, compare());
            }
            self.count("tables")?;
        }
        Ok(())
    }

    /// Compares stored files and plans of studies with their hashes.
    fn files(&mut self, connection: &Connection) -> Result<()> {
        for file in recordings::all_source_files(connection)? {
            if let Err(error) = recordings::source_bytes(connection, file.id) {
                self.fault(
                    "file",
                    format!("file {:?}", file.name),
                    error.to_string(),
                    BACKUP,
                );
            }
            self.count("files")?;
        }
        for name in studies::names(connection)? {
            if let Err(error) = studies::study(connection, &name) {
                self.fault(
                    "study",
                    format!("study {name:?}"),
                    error.to_string(),
                    BACKUP,
                );
            }
        }
        Ok(())
    }

    fn blocks(&mut self, connection: &Connection) -> Result<()> {
        rows::blocks(connection, |name, whole| {
            if !whole {
                self.fault(
                    "block",
                    format!("block {name}"),
                    "its bytes do not match the hash that names it",
                    BACKUP,
                );
            }
            self.count("blocks")
        })
    }

    fn notations(&mut self, connection: &Connection) -> Result<()> {
        notations::each(connection, |row| {
            let place = format!("notation {}", row.id);
            if let Err(error) = notation::read(row) {
                self.fault("notation", place, error.to_string(), BACKUP);
            }
            self.count("notations")
        })
    }

    fn movement(&mut self, connection: &Connection) -> Result<()> {
        for (id, document, hash) in rows::skeletons(connection)? {
            let place = format!("skeleton {id}");
            if serde_json::from_str::<Hierarchy>(&document).is_err() {
                self.fault("skeleton", place, "its document cannot be read", BACKUP);
            } else if hex(&Sha256::digest(document.as_bytes())) != hash {
                self.fault(
                    "skeleton",
                    place,
                    "its document does not match the hash that names it",
                    BACKUP,
                );
            }
            self.count("skeletons")?;
        }
        for row in tracks::all_moving(connection)? {
            if let Err(error) = self.track(connection, &row) {
                if matches!(error, crate::Error::Stopped) {
                    return Err(error);
                }
                self.fault(
                    "movement",
                    format!("track {} of recording:{}", row.id, row.recording_id),
                    error.to_string(),
                    BACKUP,
                );
            }
            self.count("tracks")?;
        }
        Ok(())
    }

    /// Decodes every block of a track and looks for missing frames.
    fn track(&mut self, connection: &Connection, row: &TrackRow) -> Result<()> {
        if row.kind != TrackKind::Skeleton {
            return track::read::track(connection, row, None).map(|_| ());
        }
        let track = MotionTrack::of_row(connection, row.id)?;
        track.frame_time()?;
        for group in ChannelGroup::ALL {
            if track.columns_of(group).is_empty() {
                continue;
            }
            let mut next = 0;
            track.blocks(
                connection,
                &[group],
                &(0..track.frames()),
                |_, first, columns| {
                    self.progress.report(Step {
                        task: "movement",
                        done: first as u64,
                        total: Some(track.frames() as u64),
                        unit: Unit::Frames,
                    })?;
                    let frames = columns.first().map_or(0, Column::len);
                    if first != next {
                        let what =
                            format!("frames {next} to {first} of {} are missing", group.name());
                        return Err(crate::Error::wrong(what));
                    }
                    next = first + frames;
                    Ok(())
                },
            )?;
            if next != track.frames() {
                let frames = track.frames();
                let what = format!("{} has {next} frames of {frames}", group.name());
                return Err(crate::Error::wrong(what));
            }
        }
        Ok(())
    }

    fn inventories(&mut self, connection: &Connection) -> Result<()> {
        match inventories::load(connection) {
            Ok(all) => {
                self.report.checked.insert("inventories", all.len() as u64);
            }
            Err(error) => self.fault("inventory", "inventories", error.to_string(), BACKUP),
        }
        Ok(())
    }

    /// Reports what breaks the rules of tiers as questions: it came so from a file.
    fn tiers(&mut self, connection: &Connection) -> Result<()> {
        for recording in recordings::recordings(connection)? {
            let place = format!("recording {:?}", recording.name);
            let set = match tier_set(connection, recording.id) {
                Ok(set) => set,
                Err(error) => {
                    self.go_on("tier", &place, Err(error))?;
                    continue;
                }
            };
            let mut ask = |message: &str, remedy: Remedy| {
                self.report.questions.push(Fault {
                    kind: "tier",
                    place: place.clone(),
                    message: messages::named(connection, message),
                    remedy,
                });
            };
            let mut overlaps: BTreeMap<TierId, u64> = BTreeMap::new();
            for violation in tier::check(&set) {
                if let Violation::Overlap { tier, .. } = violation {
                    let count = overlaps.entry(tier).or_default();
                    *count += 1;
                    if *count > SHOWN_OVERLAPS {
                        continue;
                    }
                }
                ask(&violation.to_string(), correction(&violation));
            }
            for (tier, count) in overlaps {
                if let Some(more) = count.checked_sub(SHOWN_OVERLAPS).filter(|&more| more > 0) {
                    ask(
                        &format!("further overlapping annotations on {tier}: {more}"),
                        "ELAN allows no overlap within a tier; put one of each two on another tier"
                            .into(),
                    );
                }
            }
        }
        Ok(())
    }

    /// Derives the tokens of each recording on trial; each recording is read in one state.
    fn tokens(&mut self, connection: &Connection) -> Result<()> {
        let inventories = inventories::load(connection).unwrap_or_default();
        for recording in recordings::recordings(connection)? {
            let place = format!("recording {:?}", recording.name);
            let derived = rows::tried(connection, || {
                let before = rows::changes(connection)?;
                tokens::derive_with_progress(
                    connection,
                    recording.id,
                    None,
                    &inventories,
                    self.progress,
                )?;
                Ok(rows::changes(connection)? - before)
            });
            match derived {
                Ok(0) => {}
                Ok(_) => self.fault(
                    "tokens",
                    place,
                    "its tokens do not agree with its tiers",
                    mend(),
                ),
                Err(error) => {
                    self.go_on("tier", &place, Err(error))?;
                    continue;
                }
            }
            self.count("recordings")?;
        }
        Ok(())
    }
}

/// Returns what corrects a broken rule of tiers.
fn correction(violation: &Violation) -> Remedy {
    Remedy::command(match violation {
        Violation::DuplicateName { .. } => {
            "give it another name: `chereme annotate CORPUS tier TIER --name NAME --in RECORDING`"
        }
        Violation::MissingParentTier { .. }
        | Violation::ParentCycle { .. }
        | Violation::TooDeep { .. }
        | Violation::AlignableBelowSymbolic { .. } => {
            "correct the tiers in the file that they come from, and import it again"
        }
        Violation::NotInVocabulary { .. } => {
            "correct the value: `chereme annotate CORPUS set ANNOTATION --value TEXT`"
        }
        Violation::ZeroLength { .. }
        | Violation::Overlap { .. }
        | Violation::OutsideParent { .. }
        | Violation::Gap { .. }
        | Violation::DerivedSpan { .. } => {
            "correct the times: `chereme annotate CORPUS set ANNOTATION --start TIME --end TIME`"
        }
        Violation::MissingTier { .. }
        | Violation::MissingParent { .. }
        | Violation::ParentOfRoot { .. }
        | Violation::SecondAssociation { .. }
        | Violation::Order { .. } => {
            "correct it in the file that it comes from and import that again, or remove it: `chereme annotate CORPUS remove ANNOTATION`"
        }
    })
}

/// Returns the tiers of a recording with all their annotations, for a check of the tier rules.
pub(crate) fn tier_set(connection: &Connection, recording: i64) -> Result<TierSet> {
    let mut annotations = Vec::new();
    let mut all = Vec::new();
    for row in tiers::tiers(connection, recording)? {
        for annotation in tiers::annotations(connection, row.id)? {
            annotations.push(tier::Annotation {
                id: AnnotationId(annotation.id as u64),
                tier: TierId(row.id as u64),
                parent: annotation.parent_id.map(|id| AnnotationId(id as u64)),
                order: u32::try_from(annotation.position).unwrap_or(u32::MAX),
                span: Span::between(
                    Instant::from_micros(annotation.start_us),
                    Instant::from_micros(annotation.end_us),
                ),
                value: Reading::from(annotation.value.as_str()),
            });
        }
        all.push(tier::Tier {
            id: TierId(row.id as u64),
            name: row.name,
            role: row.role,
            hand: row.hand.and_then(Hands::one),
            parent: row
                .parent_id
                .map(|id| TierId(id as u64))
                .zip(row.stereotype),
            vocabulary: None,
        });
    }
    Ok(TierSet::new(all, annotations))
}
