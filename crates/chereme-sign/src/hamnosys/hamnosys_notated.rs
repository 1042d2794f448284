//! A sign of a notation file, with the file's other information about it.

use serde::{Deserialize, Serialize};

use super::hamnosys_nonmanual::NonmanualActs;
use super::print::{PrintedSign, print_hamnosys};
use super::tree::HamnosysSign;

/// A notated sign: the actions of the hands, the actions of face and body, and its name.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NotatedSign {
    /// The sign's name; empty if the file gives none.
    pub gloss: String,
    /// The sign language.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sign_language: Option<String>,
    /// The language of the gloss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gloss_language: Option<String>,
    /// A factor on the speed, 1 by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
    /// A factor on its times, 1 by default; present in some files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timescale: Option<f64>,
    /// Its duration in the file's own unit (usually seconds); present in some files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
    /// The HamNoSys text, if it was read from text or symbols.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// The actions of the hands.
    pub sign: HamnosysSign,
    /// The actions of face and body.
    #[serde(skip_serializing_if = "NonmanualActs::is_empty")]
    pub nonmanual: NonmanualActs,
}

impl NotatedSign {
    /// Returns the actions of the hands as HamNoSys: the original text, else the printed tree.
    #[must_use]
    pub fn hamnosys_text(&self) -> PrintedSign {
        match &self.text {
            Some(text) => PrintedSign {
                text: text.clone(),
                losses: Vec::new(),
            },
            None => print_hamnosys(&self.sign),
        }
    }
}
