//! Every text of the window.
//!
//! Texts that the command line uses too are in [`chereme_corpus::words`]. The words of the window lie in the files
//! `schema/words/LANGUAGE/window-PART.ftl`; the build script declares a constant for each phrase of the English ones, in a module
//! for each part. [`fill_text_braces`] fills the variable parts of a text. To add a text, write a line into the file of its part
//! in each language.

pub use chereme_corpus::words::InterfaceLanguage;
pub(crate) use chereme_corpus::words::{InterfaceText, fill_text_braces, history_words, merge_words, trouble_words};

pub(crate) mod hamnosys_words;
pub(crate) mod key_names;
/// The texts of the window, by its parts.
mod texts {
    include!(concat!(env!("OUT_DIR"), "/texts.rs"));
}

pub(crate) use texts::{
    actions as actions_words, agreement, cue as cue_words, export as export_words, faces as faces_words,
    film as film_words, gestures as gestures_words, import as import_words, inspector, library, map as map_words,
    measures as measures_words, pickers, recombine as recombine_words, scripts, search as search_words, shell,
    stage as stage_words, steps as steps_words, studies as studies_words, tier_round as tier_round_words, timeline,
};

/// Returns a message of the library in a language; unchanged if there is no translation.
pub(crate) fn translate_library_message(text: &str, language: InterfaceLanguage) -> String {
    chereme_corpus::words::localized_message(text, language).unwrap_or_else(|| text.to_owned())
}
