//! What makes an EAF or ECV file meaningless.

/// Why a file could not be read as EAF or ECV; every case names the line and what would be right.
///
/// What is odd and can be lived with is a [`Finding`](crate::finding::Finding) instead.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The file is not UTF-8.
    #[error(
        "line {line}: the text is in {encoding}, and EAF is read in UTF-8; \
         open it in ELAN or a text editor and save it as UTF-8"
    )]
    Encoding {
        /// The encoding that its first bytes or its declaration name, or `an unknown encoding`.
        encoding: String,
        /// Where the first wrong byte or the declaration is, counted from 1.
        line: u64,
    },
    /// The file holds nothing, or something that isn't XML.
    #[error(
        "line {line}: this is not XML; an EAF file starts with <?xml …?> and <ANNOTATION_DOCUMENT …>"
    )]
    NotXml {
        /// The line, counted from 1.
        line: u64,
    },
    /// The root element is another one.
    #[error("line {line}: the root element is <{found}>; it should be <{expected}>")]
    Root {
        /// The line, counted from 1.
        line: u64,
        /// The element that is there.
        found: String,
        /// The element that should be there.
        expected: &'static str,
    },
    /// The text ends inside an element.
    #[error(
        "line {line}: the file ends inside <{open}>; it was cut short: \
         copy it anew, or take one of ELAN's backups (.001 to .005)"
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
        /// What is wrong there and what would be right.
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
    /// The file goes beyond what is read.
    #[error("line {line}: {what}, more than {limit}; no EAF file needs as many")]
    Limit {
        /// The line, counted from 1.
        line: u64,
        /// What there is too much of, as a sentence.
        what: &'static str,
        /// The most that is read.
        limit: usize,
    },
}
