//! Errors of the BVH reader.

use super::NotANumber;

/// The reason why a BVH file can't be read: the line, the text found there, and a correction.
#[derive(Debug, thiserror::Error)]
#[error("line {line}: {kind}; {}", kind.bvh_error_remedy())]
pub struct BvhError {
    /// The line, counted from 1.
    pub line: u64,
    /// The problem.
    pub kind: BvhErrorKind,
}

/// The errors that make a BVH file unreadable.
#[derive(Debug, thiserror::Error)]
pub enum BvhErrorKind {
    /// The bytes could not be read.
    #[error("the file can't be read on: {0}")]
    Io(#[from] std::io::Error),
    /// No bytes, or only blanks.
    #[error("the file is empty")]
    Empty,
    /// Text in sixteen-bit units.
    #[error("the text is UTF-16")]
    Utf16,
    /// No text at all.
    #[error("this is not text")]
    Binary,
    /// Text, but not of this format.
    #[error("the file begins with {found:?}, not with HIERARCHY")]
    NotBvh {
        /// The first word.
        found: String,
    },
    /// A word that the grammar does not allow at this place.
    #[error("found {found:?} where {expected} belongs")]
    Unexpected {
        /// The word found.
        found: String,
        /// The text that may stand there.
        expected: &'static str,
    },
    /// The file ends inside the hierarchy, or MOTION begins there.
    #[error("the brace that joint {joint:?} opened on line {opened} is not closed before {before}")]
    Unclosed {
        /// The innermost joint that is open.
        joint: String,
        /// The line of its brace.
        opened: u64,
        /// The text found instead: `MOTION_FORMATS` or `the end of the file`.
        before: &'static str,
    },
    /// A second skeleton.
    #[error("a second ROOT")]
    SecondRoot,
    /// A channel that the format does not know.
    #[error("the channel {found:?} of joint {joint:?} is unknown")]
    UnknownChannel {
        /// The joint.
        joint: String,
        /// The word found.
        found: String,
    },
    /// Joints nested beyond the limit.
    #[error("joints are nested more than {limit} deep")]
    TooDeep {
        /// The limit.
        limit: usize,
    },
    /// More joints, channels, End Sites or long numbers than the limit.
    #[error("more than {limit} {what}")]
    TooMany {
        /// The limit.
        limit: usize,
        /// Joints, channels, End Sites or bytes of long numbers.
        what: &'static str,
    },
    /// A word or a name beyond the limit.
    #[error("a word of more than {limit} bytes")]
    TooLong {
        /// The limit.
        limit: usize,
    },
    /// A number of the hierarchy or the header that cannot be read.
    #[error("{place}: {found:?} {why}")]
    BadNumber {
        /// The field that it belongs to: `OFFSET of joint "Hips"`, `Frame Time`.
        place: String,
        /// The text found.
        found: String,
        /// The reason.
        why: NotANumber,
    },
    /// A number of the motion that cannot be read.
    #[error("column {column} ({channel} of joint {joint:?}): {found:?} {why}")]
    BadValue {
        /// The column, counted from 1.
        column: usize,
        /// The joint whose column it is.
        joint: String,
        /// The channel whose column it is.
        channel: &'static str,
        /// The text found.
        found: String,
        /// The reason.
        why: NotANumber,
    },
    /// A row whose number of columns differs from the number of channels.
    #[error("the row has {found} numbers, but the hierarchy has {expected} channels")]
    RowWidth {
        /// The numbers in the row.
        found: u64,
        /// The channels of the hierarchy.
        expected: usize,
    },
    /// No frame time, or one that is not positive, in a file of two frames or more.
    #[error("{}", match found { Some(text) => format!("the frame time is {text}"), None => "there is no frame time".into() })]
    NoFrameTime {
        /// The text found there, if any.
        found: Option<String>,
    },
}

impl BvhErrorKind {
    /// Returns the error of this kind at a line.
    #[must_use]
    pub(super) fn error_at_line(self, line: u64) -> BvhError {
        BvhError { line, kind: self }
    }

    /// Returns a correction, or an action for the user.
    #[must_use]
    pub fn bvh_error_remedy(&self) -> &'static str {
        match self {
            Self::Io(_) => "check the disk and the permissions, and try again",
            Self::Empty => "export the recording again",
            Self::Utf16 => "save the file as UTF-8 with a text editor",
            Self::Binary | Self::NotBvh { .. } => "a BVH file is text that begins with the line HIERARCHY",
            Self::Unexpected { .. } => "compare the lines around it with another joint of the file",
            Self::Unclosed { .. } => "add the missing \"}\", or export again if the file was cut off",
            Self::SecondRoot => "split the file: one skeleton with one ROOT each",
            Self::UnknownChannel { .. } => {
                "channels are Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation (Xscale, Yscale, Zscale)"
            }
            Self::TooDeep { .. } | Self::TooMany { .. } => {
                "a file of this shape is taken for damage; export it again with fewer joints or digits"
            }
            Self::TooLong { .. } => "the file is damaged here; export it again",
            Self::BadNumber { why, .. } | Self::BadValue { why, .. } => remedy_for(*why),
            Self::RowWidth { .. } => "each row holds one number per channel; correct the row or the CHANNELS lines",
            Self::NoFrameTime { .. } => {
                "give the seconds per frame in the header, such as \"Frame Time: 0.0083333\" for 120 Hz"
            }
        }
    }
}

fn remedy_for(why: NotANumber) -> &'static str {
    match why {
        NotANumber::NotFinite => {
            "the exporter could not compute it; fill the gap in the capture software and export again"
        }
        NotANumber::Comma => "export with decimal points (set the system's number format to English)",
        NotANumber::TooLarge | NotANumber::Garbage => "a number such as -12.345 or 1.2e-3 belongs here",
    }
}
