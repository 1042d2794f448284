//! Every text of the window, in English and French; one file for each part of it.
//!
//! Texts that the command line uses too are in [`chereme_corpus::words`]. A text is a constant of its table;
//! [`fill`] fills `{name}` in it. To add one, write a line into the table of its part; to add a table, name it in
//! `TABLES` of the tests below.

pub use chereme_corpus::words::InterfaceLanguage;
pub(crate) use chereme_corpus::words::{InterfaceText, fill_text_braces, history_words, merge_words, trouble_words};

/// Returns a message of the library in a language; unchanged if there is no translation.
pub(crate) fn translate_library_message(text: &str, language: InterfaceLanguage) -> String {
    chereme_corpus::words::localized_message(text, language).unwrap_or_else(|| text.to_owned())
}

/// Declares the texts of one part of the window.
macro_rules! texts {
    ($($name:ident: $en:literal, $fr:literal;)*) => {
        $(pub(crate) const $name: crate::words::InterfaceText = crate::words::InterfaceText::new($en, $fr);)*
        #[cfg(test)]
        pub(super) const ALL: &[(&str, crate::words::InterfaceText)] = &[$((stringify!($name), $name)),*];
    };
}

pub(crate) mod actions_words;
pub(crate) mod agreement;
pub(crate) mod cue_words;
pub(crate) mod export_words;
pub(crate) mod faces_words;
pub(crate) mod film_words;
pub(crate) mod gestures_words;
pub(crate) mod hamnosys_words;
pub(crate) mod import_words;
pub(crate) mod inspector;
pub(crate) mod key_names;
pub(crate) mod library;
pub(crate) mod map_words;
pub(crate) mod measures_words;
pub(crate) mod pickers;
pub(crate) mod recombine_words;
pub(crate) mod scripts;
pub(crate) mod search_words;
pub(crate) mod shell;
pub(crate) mod stage_words;
pub(crate) mod steps_words;
pub(crate) mod studies_words;
pub(crate) mod tier_round_words;
pub(crate) mod timeline;

#[cfg(test)]
mod tests {
    use super::*;

    const TABLES: [&[(&str, InterfaceText)]; 24] = [
        actions_words::ALL,
        agreement::ALL,
        cue_words::ALL,
        export_words::ALL,
        faces_words::ALL,
        film_words::ALL,
        hamnosys_words::ALL,
        import_words::ALL,
        inspector::ALL,
        key_names::ALL,
        library::ALL,
        map_words::ALL,
        measures_words::ALL,
        pickers::ALL,
        recombine_words::ALL,
        scripts::ALL,
        search_words::ALL,
        shell::ALL,
        stage_words::ALL,
        steps_words::ALL,
        studies_words::ALL,
        tier_round_words::ALL,
        timeline::ALL,
        gestures_words::ALL,
    ];

    fn blanks(text: &str) -> Vec<&str> {
        let mut names: Vec<&str> = text
            .split('{')
            .skip(1)
            .filter_map(|rest| rest.split_once('}').map(|(name, _)| name))
            .collect();
        names.sort_unstable();
        names
    }

    #[test]
    fn every_text_exists_in_both_languages_with_the_same_blanks() {
        for (name, text) in TABLES.into_iter().flatten() {
            assert!(!text.en.trim().is_empty() && !text.fr.trim().is_empty(), "{name}");
            assert_eq!(blanks(text.en), blanks(text.fr), "{name}");
        }
    }
}
