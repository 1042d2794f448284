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
mod cued_dictionary;
mod cued_restore;
mod cued_say;
mod cued_targets;
mod recognise;
mod slips;

use chereme_sign::cue::{self, CueCode, UtteranceError};

use crate::error::{CorpusError, CorpusResult};

pub use capture::{CuedMarkers, MarkerSet, read_marker_labels};
pub use cued_dictionary::{DictionaryReport, DikeyDictionaryReport, MissingDikey, ScriptCoverage, WorthRecording};
pub use cued_restore::{RestoreOptions, RestoredMarker, RestoredTake};
pub use cued_say::{CueCosts, DictionaryCueOptions, FromDictionary, SentencePiece};
pub use cued_targets::{CuePhaseRow, CuePhaseStatistics, CueTargets, FoundKey};
pub use recognise::{CueConfusion, CueRecognition, MisreadKey};
pub use slips::{CueSlip, CueSlips, SlipKind};

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
    fn load_cue_code(&self) -> CorpusResult<CueCode> {
        let fault = |error: UtteranceError| {
            CorpusError::from_wrong_message(error.to_string()).with_advice(error.utterance_error_remedy())
        };
        let cue_code =
            cue::find_cue_code(&self.code).ok_or_else(|| fault(UtteranceError::NoCode(self.code.clone())))?;
        let variants: Vec<&str> = self.variants.iter().map(String::as_str).collect();
        cue_code.with_variants(&variants).map_err(|error| fault(error.into()))
    }
}

/// Returns the name of a placement from its number in the models.
fn placement_name(number: u8) -> &'static str {
    cue::placement_of_number(usize::from(number)).unwrap_or("unknown")
}

/// Returns a key in the usual notation, such as `mouth-4`.
fn cue_key_name(placement: u8, shape: u8) -> String {
    format!("{}-{shape}", placement_name(placement))
}

fn round_to_decimals(value: f64, decimals: i32) -> f64 {
    let factor = 10f64.powi(decimals);
    (value * factor).round() / factor
}
