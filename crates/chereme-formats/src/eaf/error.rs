//! Errors that make an EAF or ECV file unreadable.

/// The reason why a file could not be read as EAF or ECV; every case names the line and a correction.
///
/// Oddities that the reader tolerates are a [`ImportFinding`](crate::finding::ImportFinding) instead.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EafError {
    /// The file is in an encoding that is not read.
    #[error(
        "line {line}: the text is in {encoding}; EAF is read in UTF-8 and UTF-16, and in Latin-1 and Windows-1252 \
         where the file says so: open it in ELAN or a text editor and save it as UTF-8"
    )]
    Encoding {
        /// The encoding that its first bytes or its declaration name, or `an unknown encoding`.
        encoding: String,
        /// The line of the first wrong byte or of the declaration, counted from 1.
        line: u64,
    },
    /// The file holds nothing, or something that isn't XML.
    #[error("line {line}: this is not XML; an EAF file starts with <?xml …?> and <ANNOTATION_DOCUMENT …>")]
    NotXml {
        /// The line, counted from 1.
        line: u64,
    },
    /// The root element has the wrong name.
    #[error("line {line}: the root element is <{found}>; it should be <{expected}>")]
    Root {
        /// The line, counted from 1.
        line: u64,
        /// The root element found.
        found: String,
        /// The expected root element.
        expected: &'static str,
    },
    /// The text ends inside an element.
    #[error(
        "line {line}: the file ends inside <{open}>; it was cut short: \
         copy it again, or take one of ELAN's backups (.001 to .005)"
    )]
    Truncated {
        /// The last line, counted from 1.
        line: u64,
        /// The innermost element that was not closed.
        open: String,
    },
    /// The text breaks the rules of XML.
    #[error("line {line}: {message}")]
    Syntax {
        /// The line, counted from 1.
        line: u64,
        /// The problem, with a correction.
        message: String,
    },
    /// The file declares a document type or entities.
    #[error(
        "line {line}: a <!DOCTYPE …> is not read, for entities can hide anything; remove it, no EAF file needs one"
    )]
    Doctype {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file exceeds a limit of the reader.
    #[error("line {line}: {what}, more than {limit}; no EAF file needs as many")]
    Limit {
        /// The line, counted from 1.
        line: u64,
        /// The limit that is exceeded, as a sentence.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
}
