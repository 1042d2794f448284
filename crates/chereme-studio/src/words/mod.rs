//! Every text of the window, in English and French; one file for each part of it.
//!
//! Texts that the command line uses too are in [`chereme_corpus::words`]. A text is a constant of its table;
//! [`fill`] fills `{name}` in it. To add one, write a line into the table of its part; to add a table, name it in
//! `TABLES` of the tests below.

pub use chereme_corpus::words::Language;
pub(crate) use chereme_corpus::words::{Text, fill, history, merge, trouble};

/// Returns a message of the library in a language; unchanged if there is no translation.
pub(crate) fn spoken(text: &str, language: Language) -> String {
    chereme_corpus::words::message(text, language).unwrap_or_else(|| text.to_owned())
}

/// Declares the texts of one part of the window.
macro_rules! texts {
    ($($name:ident: $en:literal, $fr:literal;)*) => {
        $(pub(crate) const $name: crate::words::Text = crate::words::Text::new($en, $fr);)*
        #[cfg(test)]
        pub(super) const ALL: &[(&str, crate::words::Text)] = &[$((stringify!($name), $name)),*];
    };
}

pub(crate) mod actions;
pub(crate) mod agreement;
pub(crate) mod cue;
pub(crate) mod export;
pub(crate) mod faces;
pub(crate) mod film;
pub(crate) mod gestures;
pub(crate) mod hamnosys;
pub(crate) mod import;
pub(crate) mod inspector;
pub(crate) mod key_names;
pub(crate) mod library;
pub(crate) mod map;
pub(crate) mod pickers;
pub(crate) mod recombine;
pub(crate) mod scripts;
pub(crate) mod search;
pub(crate) mod shell;
pub(crate) mod stage;
pub(crate) mod steps;
pub(crate) mod studies;
pub(crate) mod timeline;

#[cfg(test)]
mod tests {
    use super::*;

    const TABLES: [&[(&str, Text)]; 22] = [
        actions::ALL,
        agreement::ALL,
        cue::ALL,
        export::ALL,
        faces::ALL,
        film::ALL,
        hamnosys::ALL,
        import::ALL,
        inspector::ALL,
        key_names::ALL,
        library::ALL,
        map::ALL,
        pickers::ALL,
        recombine::ALL,
        scripts::ALL,
        search::ALL,
        shell::ALL,
        stage::ALL,
        steps::ALL,
        studies::ALL,
        timeline::ALL,
        gestures::ALL,
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
            assert!(
                !text.en.trim().is_empty() && !text.fr.trim().is_empty(),
                "{name}"
            );
            assert_eq!(blanks(text.en), blanks(text.fr), "{name}");
        }
    }
}
