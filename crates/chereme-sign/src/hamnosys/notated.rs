//! A sign of a notation file, with what the file says about it beside the notation.

use serde::{Deserialize, Serialize};

use super::nonmanual::Nonmanual;
use super::print::{Printed, print};
use super::tree::Sign;

/// A notated sign: the actions of the hands, the actions of face and body, and its name.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Notated {
    /// The sign's name; empty where the file has none.
    pub gloss: String,
    /// The language that is signed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sign_language: Option<String>,
    /// The language of the gloss.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gloss_language: Option<String>,
    /// A factor of speed, 1 as usual.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
    /// A factor that its times are stretched by, 1 as usual; some files carry it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timescale: Option<f64>,
    /// How long it lasts, in the file's own unit (seconds as a rule); some files carry it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
    /// The HamNoSys text, where it came as text or as symbols.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// What the hands do.
    pub sign: Sign,
    /// The actions of face and body.
    #[serde(skip_serializing_if = "Nonmanual::is_empty")]
    pub nonmanual: Nonmanual,
}

impl Notated {
    /// Returns what the hands do as HamNoSys: the text as it came, else the tree printed.
    #[must_use]
    pub fn hamnosys(&self) -> Printed {
        match &self.text {
            Some(text) => Printed {
                text: text.clone(),
                losses: Vec::new(),
            },
            None => print(&self.sign),
        }
    }
}
