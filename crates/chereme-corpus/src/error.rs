//! Errors of work on a corpus, with their place and remedy.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

pub use chereme_compose::MeantName;
use chereme_sign::text::did_you_mean;
use chereme_sign::{ErrorRemedy, RemedyChoice};

use crate::words::{InterfaceLanguage, fill_text_braces, trouble_words};

/// An error in work on a corpus.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CorpusError {
    /// A file could not be read or written.
    #[error("{path}: {}", system_error_message(source))]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The file exists but is not a corpus, or is one that this version cannot open.
    #[error("{path} cannot be opened as a corpus: {reason}")]
    NotACorpus {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
        /// The remedy.
        remedy: ErrorRemedy,
    },
    /// The corpus file was moved, deleted or replaced while work was stored in it.
    #[error("{path} was moved, deleted or replaced meanwhile; the work is saved in {rescued}")]
    Displaced {
        /// Where the corpus was.
        path: PathBuf,
        /// The whole corpus with the work, beside it.
        rescued: PathBuf,
    },
    /// The database refused or failed.
    #[error("the corpus database says: {0}")]
    Database(#[from] rusqlite::Error),
    /// The search index failed.
    #[error("the search index says: {0}")]
    Index(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// A stored row or block with invalid content.
    #[error("{place} is damaged: {reason}")]
    Damaged {
        /// The row or block.
        place: String,
        /// The fault.
        reason: String,
    },
    /// A request of the caller that is invalid in this corpus.
    #[error("{message}{}", did_you_mean(meant.as_ref().map(|correction| correction.right.as_str())))]
    Wrong {
        /// The fault.
        message: String,
        /// The words, file, line or row with the fault.
        place: Option<String>,
        /// The remedy.
        remedy: Option<ErrorRemedy>,
        /// The name that was meant, if one near to a known one was written.
        meant: Option<Box<MeantName>>,
        /// Whether what was named only holds nothing of what is asked for.
        lacks: bool,
    },
    /// A query cannot be understood or answered.
    #[error("{}", .0.drawn)]
    Query(Box<WrongQuery>),
    /// The failure only follows from that of an earlier change of the same work.
    #[error("{0}")]
    Follows(String),
    /// A step of a recipe cannot be done.
    #[error("the recipe cannot be made: {}: {}", .0.step, .0.cause)]
    Step(Box<FailedStep>),
    /// Several parts of a request cannot be carried out; nothing was changed.
    #[error("{}", join_error_messages(errors, InterfaceLanguage::English, &str::to_owned))]
    Several {
        /// The failed changes, each with its place.
        errors: Vec<CorpusError>,
        /// The remedy for all of them; without it that of the first.
        remedy: Option<ErrorRemedy>,
    },
    /// The caller stopped the work; nothing was changed.
    #[error("stopped; the corpus is as it was before")]
    Stopped,
}

/// A query that cannot be understood or answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrongQuery {
    /// The query with a mark below the fault, and the fault.
    pub drawn: String,
    /// The fault alone.
    pub message: String,
    /// The character, from 0, at which the fault begins.
    pub at: usize,
    /// What would be right.
    pub remedy: Option<ErrorRemedy>,
    /// The likeliest meaning, and the query with it.
    pub mended: Option<(String, String)>,
}

/// A step of a recipe that cannot be done.
#[derive(Debug, Clone, PartialEq)]
pub struct FailedStep {
    /// The source or operator as text.
    pub step: String,
    /// Where it stands in the recipe's JSON, such as `/pipe/steps/0`; empty for the whole.
    pub path: String,
    /// Why it cannot be done.
    pub cause: String,
    /// What would work.
    pub remedy: ErrorRemedy,
    /// The name that was meant, if one near to a known one was written.
    pub meant: Option<MeantName>,
}

/// A reason for a failure of the database that the user can remove.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DatabaseFailureCause {
    /// Another program is writing.
    Busy,
    /// The disk is full.
    Full,
    /// The file or its folder is not writable.
    ReadOnly,
    /// The file is damaged.
    Damaged,
}

impl CorpusError {
    /// Returns the reason for a failure of the database, if the user can remove it.
    #[must_use]
    pub fn database_failure_cause(&self) -> Option<DatabaseFailureCause> {
        use rusqlite::ErrorCode;
        let Self::Database(error) = self else {
            return None;
        };
        Some(match error.sqlite_error_code()? {
            ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked => DatabaseFailureCause::Busy,
            ErrorCode::DiskFull => DatabaseFailureCause::Full,
            ErrorCode::ReadOnly | ErrorCode::CannotOpen => DatabaseFailureCause::ReadOnly,
            ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase => DatabaseFailureCause::Damaged,
            _ => return None,
        })
    }

    /// Returns the error with that message, without a place.
    pub fn from_wrong_message(message: impl Into<String>) -> Self {
        Self::Wrong {
            message: message.into(),
            place: None,
            remedy: None,
            meant: None,
            lacks: false,
        }
    }

    /// Returns the error of a request with these faults.
    pub fn from_error_list(errors: Vec<Self>) -> Self {
        Self::Several { errors, remedy: None }
    }

    /// Returns the error as one of a thing that holds nothing of what is asked for, such as a recording without markers.
    /// Work on many things leaves that one out.
    #[must_use]
    pub(crate) fn into_lacking_content(mut self) -> Self {
        if let Self::Wrong { lacks, .. } = &mut self {
            *lacks = true;
        }
        self
    }

    /// Returns whether what was named only holds nothing of what is asked for.
    pub(crate) fn is_lack(&self) -> bool {
        matches!(self, Self::Wrong { lacks: true, .. })
    }

    /// Returns the error for a failure to read or write `path`.
    pub fn from_file_failure(path: impl Into<PathBuf>, source: std::io::Error) -> Self {
        Self::File {
            path: path.into(),
            source,
        }
    }

    /// Returns the failure to write a file that exists already.
    pub fn from_existing_file(path: impl Into<PathBuf>) -> Self {
        Self::from_file_failure(path, std::io::ErrorKind::AlreadyExists.into())
    }

    /// Returns the error with `at` as its place.
    #[must_use]
    pub fn with_error_place(mut self, at: impl Into<String>) -> Self {
        if let Self::Wrong { place, .. } = &mut self {
            *place = Some(at.into());
        }
        self
    }

    /// Returns the error of work on a file: one that the file may not be written names it.
    pub(crate) fn of_file(self, path: &Path) -> Self {
        // SQLite does not say which file it may not write.
        match self.database_failure_cause() {
            Some(DatabaseFailureCause::ReadOnly) => {
                Self::from_file_failure(path, std::io::ErrorKind::PermissionDenied.into())
            }
            _ => self,
        }
    }

    /// Returns the error with advice.
    #[must_use]
    pub fn with_advice(mut self, advice: impl Into<ErrorRemedy>) -> Self {
        if let Self::Wrong { remedy, .. } | Self::Several { remedy, .. } = &mut self {
            *remedy = Some(advice.into());
        }
        self
    }

    /// Returns the error with advice that names a command or an option of the command line.
    #[must_use]
    pub fn with_command_advice(self, advice: impl Into<Cow<'static, str>>) -> Self {
        self.with_advice(ErrorRemedy::command_remedy(advice))
    }

    /// Returns the failure with the name that was meant.
    #[must_use]
    pub fn with_meant_name(mut self, right: Option<MeantName>) -> Self {
        if let Self::Wrong { meant, .. } = &mut self {
            *meant = right.map(Box::new);
        }
        self
    }

    /// Returns the name that was meant, if one near to a known one was written.
    #[must_use]
    pub fn meant_name(&self) -> Option<&MeantName> {
        match self {
            Self::Wrong { meant, .. } => meant.as_deref(),
            Self::Step(step) => step.meant.as_ref(),
            _ => None,
        }
    }

    /// Returns the message in the words of `say`, which gets each part of a list of failures alone.
    pub fn spoken_error_message(&self, language: InterfaceLanguage, say: &dyn Fn(&str) -> String) -> String {
        match self {
            Self::Several { errors, .. } => join_error_messages(errors, language, say),
            other => say(&other.to_string()),
        }
    }

    /// Returns the place of the error: a file, line, row or the caller's words.
    #[must_use]
    pub fn error_place(&self) -> Option<String> {
        match self {
            Self::File { path, .. } | Self::NotACorpus { path, .. } | Self::Displaced { path, .. } => {
                Some(path.display().to_string())
            }
            Self::Damaged { place, .. } => Some(place.clone()),
            Self::Wrong { place, .. } => place.clone(),
            Self::Query(query) => Some(format!("character {}", query.at + 1)),
            Self::Step(step) => Some(match step.path.as_str() {
                "" => step.step.clone(),
                path => format!("{} (at {path})", step.step),
            }),
            Self::Several { errors, .. } => errors.first().and_then(Self::error_place),
            _ => None,
        }
    }

    /// Returns the remedy, if there is one.
    #[must_use]
    pub fn error_remedy(&self) -> Option<ErrorRemedy> {
        match self {
            Self::File { source, .. } => match source.kind() {
                std::io::ErrorKind::NotFound => Some("check the spelling of the path".into()),
                std::io::ErrorKind::PermissionDenied => {
                    Some("the file or its folder may not be read or written by you".into())
                }
                std::io::ErrorKind::AlreadyExists => Some("choose another name, or move the existing one away".into()),
                std::io::ErrorKind::StorageFull | std::io::ErrorKind::QuotaExceeded => {
                    Some(remedy_of(DatabaseFailureCause::Full))
                }
                std::io::ErrorKind::InvalidData if is_encoding(source) => Some("save it as text in UTF-8".into()),
                _ => None,
            },
            Self::NotACorpus { remedy, .. } => Some(remedy.clone()),
            Self::Displaced { .. } => Some("compare the two files, and give the one with the work its name".into()),
            Self::Damaged { .. } => Some(ErrorRemedy::choice_remedy(
                RemedyChoice::Check,
                "`chereme check CORPUS` lists all damage and says how to mend it; a backup may be whole",
            )),
            Self::Database(_) => self.database_failure_cause().map(remedy_of),
            Self::Index(_) => Some(ErrorRemedy::choice_remedy(
                RemedyChoice::Check,
                "`chereme check CORPUS --mend` builds the search index again",
            )),
            Self::Wrong { remedy, .. } => remedy.clone(),
            Self::Query(query) => query.remedy.clone(),
            Self::Step(step) => Some(step.remedy.clone()),
            Self::Several { errors, remedy } => remedy.clone().or_else(|| errors.first()?.error_remedy()),
            Self::Stopped | Self::Follows(_) => None,
        }
    }
}

/// Returns the message of a system error, in plain words if it is common.
fn system_error_message(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is nothing of this name".to_owned(),
        std::io::ErrorKind::AlreadyExists => "something of this name is there already".to_owned(),
        std::io::ErrorKind::PermissionDenied => "it may not be read or written".to_owned(),
        std::io::ErrorKind::InvalidData if is_encoding(error) => "the file is no text in UTF-8".to_owned(),
        _ => error.to_string(),
    }
}

/// Returns whether text in another encoding, or no text at all, was read as UTF-8.
fn is_encoding(error: &std::io::Error) -> bool {
    error.kind() == std::io::ErrorKind::InvalidData && error.to_string().contains("UTF-8")
}

/// Returns the messages of a list of errors, one per line, with each part in the words of `say`.
fn join_error_messages(errors: &[CorpusError], language: InterfaceLanguage, say: &dyn Fn(&str) -> String) -> String {
    const MAX_SHOWN_ERRORS: usize = 20;
    let mut lines = vec![say(&match errors.len() {
        1 => "one change cannot be made, and none was:".to_owned(),
        count => format!("{count} changes cannot be made, and none was:"),
    })];
    lines.extend(errors.iter().take(MAX_SHOWN_ERRORS).map(|error| {
        let remedy = error
            .error_remedy()
            .filter(|_| errors.len() > 1)
            .map_or(String::new(), |remedy| format!(" ({})", say(remedy.remedy_text())));
        let what = format!("{}{remedy}", error.spoken_error_message(language, say));
        match error.error_place() {
            Some(place) => fill_text_braces(
                trouble_words::PLACED.text_in_language(language),
                &[("place", &say(&place)), ("what", &what)],
            ),
            None => what,
        }
    }));
    if errors.len() > MAX_SHOWN_ERRORS {
        lines.push(say(&format!("and {} more", errors.len() - MAX_SHOWN_ERRORS)));
    }
    lines.join("\n")
}

/// Returns the remedy for a failure of the database.
fn remedy_of(cause: DatabaseFailureCause) -> ErrorRemedy {
    let text = match cause {
        DatabaseFailureCause::Busy => {
            "another program has been writing to the corpus for 20 seconds; try again when it is done"
        }
        DatabaseFailureCause::Full => "the disk is full; make room and try again, nothing was lost",
        DatabaseFailureCause::ReadOnly => "the file or its folder may not be written by you",
        DatabaseFailureCause::Damaged => {
            return ErrorRemedy::command_remedy(
                "the file is damaged: take a backup, or save what can still be read with `chereme export CORPUS all --to FOLDER`",
            );
        }
    };
    text.into()
}

/// The result of work on a corpus.
pub type CorpusResult<T> = std::result::Result<T, CorpusError>;
