//! Captured cued speech: following, restoring, recognising and measuring a cuer's markers, and cutting them into a
//! dictionary.
//!
//! | module | what it does |
//! |---|---|
//! | [`capture`] | markers and keys of a recording in the form for the models |
//! | [`restore`] | hidden markers estimated by models of hand and face, as a track of their own |
//! | [`recognise`] | recognition of shapes and placements, with confusion tables |
//! | [`targets`] | movements and targets of keys, written as tiers; statistics of phases |
//! | [`dictionary`] | movements between keys cut from the corpus, and those that a script needs in addition |
//! | [`say`] | a sentence composed from the dictionary, and read back |
//! | [`slips`] | comparison of produced and predicted keys |

mod capture;
mod dictionary;
mod recognise;
mod restore;
mod say;
mod slips;
mod targets;

use chereme_sign::cue::{self, CueCode, UtteranceError};

use crate::error::{Error, Result};

pub use capture::{CuedMarkers, MarkerSet, read_marker_labels};
pub use dictionary::{DictionaryReport, Dikeys, MissingDikey, ScriptCoverage, WorthRecording};
pub use recognise::{CueConfusion, CueRecognition, Misread};
pub use restore::{RestoreOptions, RestoredMarker, RestoredTake};
pub use say::{CueCosts, FromDictionary, SentencePiece};
pub use slips::{CueSlip, CueSlips, SlipKind};
pub use targets::{CuePhaseRow, CuePhaseStatistics, CueTargets, FoundKey};

/// The code of the cuer, and the labels of markers in files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CuedOptions {
    /// The code's name or language, such as `french`.
    pub code: String,
    /// Habits of the cuer, by the names that the code gives them.
    pub variants: Vec<String>,
    /// Labels of files for markers: the program's name, such as `HB1`, and the file's.
    pub labels: Vec<(String, String)>,
}

impl Default for CuedOptions {
    fn default() -> Self {
        Self {
            code: "french".to_owned(),
            variants: Vec::new(),
            labels: Vec::new(),
        }
    }
}

impl CuedOptions {
    fn code(&self) -> Result<CueCode> {
        let fault = |error: UtteranceError| Error::wrong(error.to_string()).advise(error.remedy());
        let known = cue::code(&self.code)
            .ok_or_else(|| fault(UtteranceError::NoCode(self.code.clone())))?;
        let variants: Vec<&str> = self.variants.iter().map(String::as_str).collect();
        known
            .with_variants(&variants)
            .map_err(|error| fault(error.into()))
    }
}

/// Returns the name of a placement from its number in the models.
fn placement_name(number: u8) -> &'static str {
    cue::placement_of_number(usize::from(number)).unwrap_or("unknown")
}

/// Returns a key in the usual notation, such as `mouth-4`.
fn key_name(placement: u8, shape: u8) -> String {
    format!("{}-{shape}", placement_name(placement))
}

fn rounded(value: f64, decimals: i32) -> f64 {
    let factor = 10f64.powi(decimals);
    (value * factor).round() / factor
}
