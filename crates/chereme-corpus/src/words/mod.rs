//! Words shared by the command line and the window.
//!
//! They lie in the files of `schema/words`, one for each room and language. To add a text, write it into the file of its room in
//! each language, under the same id; the build script declares a constant for each text of the files `texts-PART.ftl`, in a
//! module for each part, and [`fill_text_braces`] fills the `{name}` in it.

use std::fmt::Display;

pub use chereme_sign::words::{InterfaceLanguage, InterfaceText};
pub use count::{counted_in, format_noun_count, noun_form_for_count};
pub use guides::translate_guide;
use messages_words::described_messages;
use phrases::BlankedPhrase;

mod count;
pub mod deletion;
pub mod effect;
#[cfg(test)]
#[path = "tests/french.rs"]
mod french;
mod guides;
pub mod history_words;
pub mod merge_words;
mod messages_words;
pub(crate) mod old_effect;
mod parts_words;
mod phrases;
mod sentences;
pub mod trouble_words;
/// The texts that the command line and the window share, by their parts.
pub(crate) mod texts {
    include!(concat!(env!("OUT_DIR"), "/texts.rs"));
}

/// Returns a message in `language`; nothing if the files of words lack it.
#[must_use]
pub fn localized_message(text: &str, language: InterfaceLanguage) -> Option<String> {
    match language {
        InterfaceLanguage::Other(_) => phrases::message_from_folder(text, language),
        InterfaceLanguage::English | InterfaceLanguage::French => {
            messages_words::translate_message_text(text, language)
        }
    }
}

/// Returns a text of the help of commands in `language`; nothing for English, or if the files of words lack it.
#[must_use]
pub fn help_text(english: &str, language: InterfaceLanguage) -> Option<&'static str> {
    phrases::phrase_book(language)?.fixed_text("help", english)
}

/// Returns the title of a column in `language`; a title that the files of words lack stays as it is.
#[must_use]
pub fn column_title(title: &str, language: InterfaceLanguage) -> &str {
    let translated_title = phrases::phrase_book(language).and_then(|book| book.fixed_text("title", title));
    translated_title.unwrap_or(title)
}

/// Returns `text` with each `{name}` replaced by its value in `values`; a value may hold braces itself.
#[must_use]
pub fn fill_text_braces(text: &str, values: &[(&str, &dyn Display)]) -> String {
    BlankedPhrase::from_form(text).fill_phrase_blanks(|name| {
        let value_entry = values.iter().find(|(known, _)| *known == name);
        value_entry.map_or_else(|| format!("{{{name}}}"), |(_, value)| value.to_string())
    })
}

/// Returns whether the files of words have a message with this English form in `language`.
#[must_use]
pub fn has_message(form: &str, language: InterfaceLanguage) -> bool {
    message_form(form, language).is_some()
}

fn message_form(form: &str, language: InterfaceLanguage) -> Option<&'static str> {
    let book = phrases::phrase_book(language)?;
    let line = book.fixed_text("line", form.trim_start());
    line.or_else(|| book.fixed_text("message", form.trim_start()))
}

/// Returns the message with this English form in `language`, its blanks filled by `values` in the order of the English
/// form. The values are not looked at, so that people's names stay as they are; the message stays English if the files of
/// words lack it.
#[must_use]
pub fn filled_message(form: &str, values: &[&dyn Display], language: InterfaceLanguage) -> String {
    let english = BlankedPhrase::from_form(form);
    debug_assert_eq!(english.blank_names().count(), values.len(), "{form}");
    let values: Vec<(&str, &dyn Display)> = english.blank_names().zip(values.iter().copied()).collect();
    let indent = &form[..form.len() - form.trim_start().len()];
    match message_form(form, language) {
        Some(other) => format!("{indent}{}", fill_text_braces(other, &values)),
        None => fill_text_braces(form, &values),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blanks_are_filled() {
        assert_eq!(fill_text_braces("{n} of {all}", &[("n", &2), ("all", &"x")]), "2 of x");
        let names = [("n", &"{all}" as &dyn Display), ("all", &"{n}")];
        assert_eq!(fill_text_braces("{n} of {all}", &names), "{all} of {n}");
    }

    #[test]
    fn names_in_filled_messages_stay_as_they_are() {
        let form = "  wrote {path}, {size} KB";
        for (language, line) in [
            (InterfaceLanguage::English, "  wrote talk, 3 KB to {size}.bvh, 5 KB"),
            (InterfaceLanguage::French, "  écrit : talk, 3 KB to {size}.bvh, 5 Ko"),
        ] {
            let name = "talk, 3 KB to {size}.bvh";
            assert_eq!(filled_message(form, &[&name, &5], language), line);
        }
    }
}
