//! Remedies for errors and findings, typed by the programs in which they can be followed.

use std::borrow::Cow;
use std::fmt;

use serde::{Serialize, Serializer};

/// A remedy for an error or a finding.
///
/// Every remedy has a text for the command line. Another program shows [`ErrorRemedy::Advice`] as it is, offers its own form
/// of a [`ErrorRemedy::Choice`], and leaves a [`ErrorRemedy::Command`] out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ErrorRemedy {
    /// Advice that holds in every program.
    Advice(Cow<'static, str>),
    /// Advice that names a command or an option of the command line, for which no other program has a counterpart.
    Command(Cow<'static, str>),
    /// A choice that each program offers in its own form, and the text of the command line.
    Choice(RemedyChoice, Cow<'static, str>),
}

/// A choice that each program offers in its own form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RemedyChoice {
    /// The part of the body for each joint.
    JointRoles,
    /// The order of the root's columns in a motion file.
    RootOrder,
    /// The unit of length of a motion file.
    Unit,
    /// The axes of a motion file.
    Axes,
    /// The role of each tier of an annotation file.
    TierRoles,
    /// Another recording whose tiers are copied.
    TiersLike,
    /// The common ancestor of two corpora.
    CommonAncestor,
    /// The side whose changes win when a changed file is imported again.
    Side,
    /// The evidence that joins files into one recording.
    Joining,
    /// Another file to open as a corpus.
    OtherCorpus,
    /// The check of the corpus.
    Check,
    /// The consent of a person or a recording.
    Consent,
    /// The notation of a sign, or movement for it.
    Notation,
}

impl ErrorRemedy {
    /// Returns a remedy that names a command or an option of the command line.
    pub fn command_remedy(text: impl Into<Cow<'static, str>>) -> Self {
        Self::Command(text.into())
    }

    /// Returns a remedy that each program offers in its own form; `text` is that of the command line.
    pub fn choice_remedy(choice: RemedyChoice, text: impl Into<Cow<'static, str>>) -> Self {
        Self::Choice(choice, text.into())
    }

    /// Returns the text for the command line.
    #[must_use]
    pub fn remedy_text(&self) -> &str {
        match self {
            Self::Advice(text) | Self::Command(text) | Self::Choice(_, text) => text,
        }
    }

    /// Returns whether there is no text.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.remedy_text().is_empty()
    }

    /// Returns the text if it holds in every program.
    #[must_use]
    pub fn remedy_advice(&self) -> Option<&str> {
        match self {
            Self::Advice(text) => Some(text),
            Self::Command(_) | Self::Choice(..) => None,
        }
    }
}

impl Default for ErrorRemedy {
    /// Returns no advice.
    fn default() -> Self {
        Self::Advice(Cow::Borrowed(""))
    }
}

impl From<&str> for ErrorRemedy {
    fn from(text: &str) -> Self {
        Self::Advice(text.to_owned().into())
    }
}

impl From<String> for ErrorRemedy {
    fn from(text: String) -> Self {
        Self::Advice(text.into())
    }
}

impl fmt::Display for ErrorRemedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.remedy_text())
    }
}

impl Serialize for ErrorRemedy {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.remedy_text())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn documents_hold_the_text_of_the_command_line() {
        let remedies = [
            ErrorRemedy::from("name it"),
            ErrorRemedy::command_remedy("`chereme log CORPUS` lists them"),
            ErrorRemedy::choice_remedy(RemedyChoice::Unit, "give the unit with --unit"),
        ];
        let json = serde_json::to_string(&remedies).expect("plain texts");
        let texts = "[\"name it\",\"`chereme log CORPUS` lists them\",\"give the unit with --unit\"]";
        assert_eq!(json, texts);
        assert_eq!(
            remedies.each_ref().map(ErrorRemedy::remedy_advice),
            [Some("name it"), None, None]
        );
    }
}
