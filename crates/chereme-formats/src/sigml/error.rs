//! Errors that make a SiGML file unreadable.

/// The reason why a file could not be read as SiGML; every case names the line and a correction.
///
/// Oddities that the reader tolerates are a [`ImportFinding`](crate::ImportFinding) instead.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SigmlError {
    /// The file is not UTF-8.
    #[error(
        "line {line}: the text is in {encoding}, and SiGML is read in UTF-8; \
         open it in a text editor and save it as UTF-8"
    )]
    Encoding {
        /// The encoding that its first bytes or its declaration name, or `an unknown encoding`.
        encoding: String,
        /// The line of the first wrong byte or of the declaration, counted from 1.
        line: u64,
    },
    /// The file holds nothing, or something that isn't XML.
    #[error("line {line}: this is not XML; a SiGML file starts with <sigml>")]
    NotXml {
        /// The line, counted from 1.
        line: u64,
    },
    /// The root element has the wrong name.
    #[error(
        "line {line}: the root element is <{found}>; it should be <sigml>, \
         or a single <hamgestural_sign> or <hns_sign>"
    )]
    Root {
        /// The line, counted from 1.
        line: u64,
        /// The root element found.
        found: String,
    },
    /// The text ends inside an element.
    #[error("line {line}: the file ends inside <{open}>; it was cut short: copy it again")]
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
    /// The file declares entities or a document type of its own.
    #[error(
        "line {line}: a <!DOCTYPE …> with declarations of its own is not read, for entities can \
         hide anything; take away what stands between [ and ]"
    )]
    Entities {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file exceeds a limit of the reader.
    #[error("line {line}: {what}, more than {limit}; no SiGML file needs as many")]
    Limit {
        /// The line, counted from 1.
        line: u64,
        /// The limit that is exceeded, as a sentence.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
}
