//! Words shared by the command line and the window, in English and French.
//!
//! Messages, help, titles, guides, menus and the words of pages lie in the files of `schema/words`, one for each room and language. To add one, write it
//! into the file of its room in each language, under the same id. A text of the tables here is a constant; `{name}` in it is
//! filled by [`fill`]. To add one, write a line into the table of its part; to add a table, name it in `TABLES` of the tests below.

use std::fmt::Display;

pub use chereme_sign::words::{Language, Text};
pub use count::{counted, counted_in, numbered};
pub use guides::guide;
use messages::described_messages;
use phrases::Phrase;

/// Declares the texts of one part.
macro_rules! texts {
    ($($name:ident: $en:literal, $fr:literal;)*) => {
        $(
            #[doc = concat!("“", $en, "”")]
            pub const $name: crate::words::Text = crate::words::Text::new($en, $fr);
        )*
        #[cfg(test)]
        pub(super) const ALL: &[(&str, crate::words::Text)] = &[$((stringify!($name), $name)),*];
    };
}

mod count;
pub mod coverage;
pub mod deletion;
pub mod effect;
#[cfg(test)]
#[path = "tests/french.rs"]
mod french;
mod guides;
pub mod history;
pub mod merge;
mod messages;
pub(crate) mod old_effect;
mod parts;
mod phrases;
pub mod reporting;
mod sentences;
pub mod trouble;

/// Returns a message in `language`; nothing if the files of words lack it.
#[must_use]
pub fn message(text: &str, language: Language) -> Option<String> {
    match language {
        Language::Other(_) => phrases::message_from_folder(text, language),
        Language::English | Language::French => messages::message(text, language),
    }
}

/// Returns a text of the help of commands in `language`; nothing for English, or if the files of words lack it.
#[must_use]
pub fn help_text(english: &str, language: Language) -> Option<&'static str> {
    phrases::phrase_book(language)?.fixed_text("help", english)
}

/// Returns the title of a column in `language`; a title that the files of words lack stays as it is.
#[must_use]
pub fn column_title(title: &str, language: Language) -> &str {
    let known = phrases::phrase_book(language).and_then(|book| book.fixed_text("title", title));
    known.unwrap_or(title)
}

/// Returns `text` with each `{name}` replaced by its value in `values`; a value may hold braces itself.
#[must_use]
pub fn fill(text: &str, values: &[(&str, &dyn Display)]) -> String {
    Phrase::from_form(text).filled(|name| {
        let known = values.iter().find(|(known, _)| *known == name);
        known.map_or_else(|| format!("{{{name}}}"), |(_, value)| value.to_string())
    })
}

/// Returns whether the files of words have a message with this English form in `language`.
#[must_use]
pub fn has_message(form: &str, language: Language) -> bool {
    message_form(form, language).is_some()
}

fn message_form(form: &str, language: Language) -> Option<&'static str> {
    let book = phrases::phrase_book(language)?;
    let line = book.fixed_text("line", form.trim_start());
    line.or_else(|| book.fixed_text("message", form.trim_start()))
}

/// Returns the message with this English form in `language`, its blanks filled by `values` in the order of the English
/// form. The values are not looked at, so that people's names stay as they are; the message stays English if the files of
/// words lack it.
#[must_use]
pub fn filled_message(form: &str, values: &[&dyn Display], language: Language) -> String {
    let english = Phrase::from_form(form);
    debug_assert_eq!(english.blank_names().count(), values.len(), "{form}");
    let values: Vec<(&str, &dyn Display)> =
        english.blank_names().zip(values.iter().copied()).collect();
    let indent = &form[..form.len() - form.trim_start().len()];
    match message_form(form, language) {
        Some(other) => format!("{indent}{}", fill(other, &values)),
        None => fill(form, &values),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLES: [&[(&str, Text)]; 5] = [
        deletion::ALL,
        history::ALL,
        merge::ALL,
        reporting::ALL,
        trouble::ALL,
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

    #[test]
    fn blanks_are_filled() {
        assert_eq!(fill("{n} of {all}", &[("n", &2), ("all", &"x")]), "2 of x");
        let names = [("n", &"{all}" as &dyn Display), ("all", &"{n}")];
        assert_eq!(fill("{n} of {all}", &names), "{all} of {n}");
    }

    #[test]
    fn names_in_filled_messages_stay_as_they_are() {
        let form = "  wrote {path}, {size} KB";
        for (language, line) in [
            (Language::English, "  wrote talk, 3 KB to {size}.bvh, 5 KB"),
            (Language::French, "  écrit : talk, 3 KB to {size}.bvh, 5 Ko"),
        ] {
            let name = "talk, 3 KB to {size}.bvh";
            assert_eq!(filled_message(form, &[&name, &5], language), line);
        }
    }
}
