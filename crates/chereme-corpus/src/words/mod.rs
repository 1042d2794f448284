//! Words shared by the command line and the window, in English and French.
//!
//! A text is a constant of its table; `{name}` in it is filled by [`fill`]. To add one, write a line
//! into the table of its part; to add a table, name it in `TABLES` of the tests below.

use std::fmt::Display;

pub use chereme_sign::words::{Language, Text};
pub use count::{counted, counted_in, numbered};
pub use guides::{guide, guide_among};
pub use messages::{Forms, forms, message, message_among};

/// Declares the texts of one part.
macro_rules! texts {
    ($($name:ident: $en:literal, $fr:literal;)*) => {
        $(
            #[doc = concat!("“", $en, "”")]
            pub const $name: crate::words::Text = crate::words::Text { en: $en, fr: $fr };
        )*
        #[cfg(test)]
        pub(super) const ALL: &[(&str, crate::words::Text)] = &[$((stringify!($name), $name)),*];
    };
}

mod agreeing;
mod asking;
mod captures;
mod coding;
mod composing;
mod count;
mod counting;
pub mod deeds;
pub mod deletion;
mod documents;
mod editing;
mod filming;
mod findings;
mod foreign;
#[cfg(test)]
#[path = "tests/french.rs"]
mod french;
mod guides;
pub mod history;
mod importing;
mod lines;
pub mod merge;
mod messages;
mod moving;
mod notes;
mod parts;
mod pointed;
mod publishing;
mod queries;
mod reading;
pub mod reporting;
mod studies;
pub mod trouble;

/// Returns `text` with each `{name}` replaced by its value in `values`.
#[must_use]
pub fn fill(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut filled = text.to_owned();
    for (name, value) in values {
        filled = filled.replace(&format!("{{{name}}}"), &value.to_string());
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLES: [&[(&str, Text)]; 6] = [
        deeds::ALL,
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
    }
}
