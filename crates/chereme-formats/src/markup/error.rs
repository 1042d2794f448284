//! Errors that make an annotation file in XML unreadable.

use super::MarkupTool;
use crate::eaf;

/// The reason why an annotation file of another program could not be read; every case names the line and a correction.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MarkupError {
    /// The file is in an encoding that is not read.
    #[error(
        "line {line}: the text is in {encoding}; files of {tool} are read in UTF-8 and UTF-16, and in Latin-1 and \
         Windows-1252 where the file says so: open it in a text editor and save it as UTF-8"
    )]
    Encoding {
        /// The program that writes such files.
        tool: &'static str,
        /// The encoding that its first bytes or its declaration name, or `an unknown encoding`.
        encoding: String,
        /// The line, counted from 1.
        line: u64,
    },
    /// The file holds nothing, or something that isn't XML.
    #[error("line {line}: this is not XML; a file of {tool} starts with <?xml …?> and <{root}>")]
    NotXml {
        /// The program that writes such files.
        tool: &'static str,
        /// The root element of such files.
        root: &'static str,
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
    /// An element that holds the contents is missing.
    #[error("line {line}: <{parent}> has no <{child}>; a file of {tool} has one")]
    Missing {
        /// The program that writes such files.
        tool: &'static str,
        /// The line of the element above, counted from 1.
        line: u64,
        /// The element above.
        parent: &'static str,
        /// The missing element.
        child: &'static str,
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
    /// The file declares entities.
    #[error(
        "line {line}: a <!DOCTYPE …> with declarations of its own is not read, for entities can hide anything; take \
         away what stands between [ and ]"
    )]
    Entities {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file exceeds a limit of the reader.
    #[error("line {line}: {what}, more than {limit}; no file of {tool} needs as many")]
    Limit {
        /// The program that writes such files.
        tool: &'static str,
        /// The line, counted from 1.
        line: u64,
        /// The limit that is exceeded, as a sentence.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// The utterances of a collection lie in different films.
    #[error(
        "its utterances lie in {films} films, each with a time of its own; save the utterances of each film as a \
         collection of its own"
    )]
    Films {
        /// The number of films.
        films: usize,
    },
}

impl MarkupError {
    /// Returns the error of a file of `tool` for one of its XML.
    pub(crate) fn from_eaf_error(tool: MarkupTool, error: eaf::EafError) -> Self {
        let MarkupTool { name: tool, root } = tool;
        match error {
            eaf::EafError::Encoding { encoding, line } => Self::Encoding { tool, encoding, line },
            eaf::EafError::NotXml { line } => Self::NotXml { tool, root, line },
            eaf::EafError::Root { line, found, expected } => Self::Root { line, found, expected },
            eaf::EafError::Truncated { line, open } => Self::Truncated { line, open },
            eaf::EafError::Syntax { line, message } => Self::Syntax { line, message },
            eaf::EafError::Doctype { line } => Self::Entities { line },
            eaf::EafError::Limit { line, what, limit } => Self::Limit {
                tool,
                line,
                what,
                limit,
            },
        }
    }
}
